/* The units there are: see units_table.h. */
#include "scene/units_table.h"

#include <string.h>

static const struct units_table_dimension dimensions[] = {
    [KEY_NONE] = {"a plain number", "0.5", {""}},
    [KEY_LENGTH] = {"a length", "3 cm", {"m", "cm", "mm", "um", "nm"}},
    [KEY_TIME] = {"a time", "10 ms", {"s", "ms", "us", "ns"}},
    [KEY_FREQUENCY] = {"a frequency", "2 Hz", {"Hz", "kHz", "MHz", "mHz"}},
    [KEY_MASS] = {"a mass", "20 g", {"kg", "g", "mg"}},
    [KEY_FORCE] = {"a force", "1.5 N", {"N", "mN", "kN"}},
    [KEY_SPEED] = {"a speed", "10 cm/s", {"m/s", "cm/s", "mm/s"}},
    [KEY_ACCELERATION] = {"an acceleration", "9.81 m/s^2", {"m/s^2", "mm/s^2"}},
    [KEY_ANGLE] = {"an angle", "30 deg", {"rad", "deg", "mrad"}},
    [KEY_PER_AREA] = {"a number per area", "10 /mm^2", {"/m^2", "/cm^2", "/mm^2"}},
    [KEY_DECIBEL] = {"a level in decibels", "-3 dB", {"dB"}},
    [KEY_LUFS] = {"a loudness", "-23 LUFS", {"LUFS"}},
    [KEY_FORCE_COEFFICIENT] = {"a force coefficient", "0.05 N s/m", {"N s/m", "N (s/m)^beta2"}},
    [KEY_OUTPUT] = {"a length, speed, acceleration, pressure or force",
                    "1 mm/s",
                    {"", "m", "mm", "um", "m/s", "mm/s", "m/s^2", "Pa", "N"}},
    [KEY_PRESSURE] = {"a pressure or modulus", "12 GPa", {"Pa", "kPa", "MPa", "GPa"}},
    [KEY_DENSITY] = {"a density", "650 kg/m^3", {"kg/m^3", "g/cm^3"}},
    [KEY_FORCE_PER_LENGTH] = {"a force per length", "2 kN/m", {"N/m", "kN/m", "N/mm"}},
    [KEY_PER_TIME] = {"a rate per second", "10 1/s", {"1/s", "/s"}},
    [KEY_STIFFNESS] = {"a stiffness", "2 MN/m", {"N/m", "kN/m", "MN/m", "N/m^1.5", "MN/m^1.5", "GN/m^1.5"}},
    [KEY_STIFFNESS_PER_MASS] = {"a stiffness per mass", "5e9 N/(m^1.5 kg)", {"N/(m^1.5 kg)"}},
    [KEY_PER_SPEED] = {"a number per speed", "1 s/m", {"s/m"}},
    [KEY_DISSIPATION] = {"a dissipation of a Hunt-Crossley contact", "0.1 N s/m^2.5", {"N s/m^2.5"}},
};

static const struct units_table_unit units[] = {
    {"m", KEY_LENGTH, 0, "numckMG"},
    {"s", KEY_TIME, 0, "numkMG"},
    {"Hz", KEY_FREQUENCY, 0, "numkMG"},
    {"g", KEY_MASS, -3, "numkMG"},
    {"N", KEY_FORCE, 0, "numkMG"},
    {"m/s", KEY_SPEED, 0, "numckMG"},
    {"m/s^2", KEY_ACCELERATION, 0, "numckMG"},
    {"m/s2", KEY_ACCELERATION, 0, "numckMG"},
    {"m/s\xc2\xb2", KEY_ACCELERATION, 0, "numckMG"},
    {"rad", KEY_ANGLE, 0, "num"},
    {"deg", KEY_ANGLE, UNITS_TABLE_DEGREES, ""},
    {"\xc2\xb0", KEY_ANGLE, UNITS_TABLE_DEGREES, ""},
    {"/m^2", KEY_PER_AREA, 0, ""},
    {"/m2", KEY_PER_AREA, 0, ""},
    {"/m\xc2\xb2", KEY_PER_AREA, 0, ""},
    {"/cm^2", KEY_PER_AREA, 4, ""},
    {"/cm2", KEY_PER_AREA, 4, ""},
    {"/cm\xc2\xb2", KEY_PER_AREA, 4, ""},
    {"/mm^2", KEY_PER_AREA, 6, ""},
    {"/mm2", KEY_PER_AREA, 6, ""},
    {"/mm\xc2\xb2", KEY_PER_AREA, 6, ""},
    {"/um^2", KEY_PER_AREA, 12, ""},
    {"dB", KEY_DECIBEL, 0, ""},
    {"dBFS", KEY_DECIBEL, 0, ""},
    {"LUFS", KEY_LUFS, 0, ""},
    {"N s/m", KEY_FORCE_COEFFICIENT, 0, "numkMG"},
    {"N*s/m", KEY_FORCE_COEFFICIENT, 0, "numkMG"},
    {"N (s/m)^beta2", KEY_FORCE_COEFFICIENT, 0, "numkMG"},
    {"Pa", KEY_PRESSURE, 0, "numkMG"},
    {"g/m^3", KEY_DENSITY, -3, "mkM"},
    {"g/m3", KEY_DENSITY, -3, "mkM"},
    {"g/m\xc2\xb3", KEY_DENSITY, -3, "mkM"},
    {"g/cm^3", KEY_DENSITY, 3, ""},
    {"g/cm3", KEY_DENSITY, 3, ""},
    {"g/cm\xc2\xb3", KEY_DENSITY, 3, ""},
    {"N/m", KEY_FORCE_PER_LENGTH, 0, "numkMG"},
    {"N/cm", KEY_FORCE_PER_LENGTH, 2, "mkM"},
    {"N/mm", KEY_FORCE_PER_LENGTH, 3, "mkM"},
    {"1/s", KEY_PER_TIME, 0, ""},
    {"/s", KEY_PER_TIME, 0, ""},
    {"N/m^1.5", KEY_STIFFNESS, 0, "mkMG"},
    {"N/m^(3/2)", KEY_STIFFNESS, 0, "mkMG"},
    {"N/(m^1.5 kg)", KEY_STIFFNESS_PER_MASS, 0, "kMG"},
    {"N/m^1.5/kg", KEY_STIFFNESS_PER_MASS, 0, "kMG"},
    {"s/m", KEY_PER_SPEED, 0, "m"},
    {"N s/m^2.5", KEY_DISSIPATION, 0, "mkMG"},
    {"N*s/m^2.5", KEY_DISSIPATION, 0, "mkMG"},
};

static const struct prefix {
    const char *name;
    char letter;
    int power;
} prefixes[] = {{"n", 'n', -9}, {"u", 'u', -6}, {"\xc2\xb5", 'u', -6}, {"\xce\xbc", 'u', -6}, {"m", 'm', -3},
                {"c", 'c', -2}, {"k", 'k', 3},  {"M", 'M', 6},         {"G", 'G', 9}};

const struct units_table_dimension *units_table_dimension(enum key_dimension d) { return &dimensions[d]; }

static bool matches(const struct units_table_unit *u, const char *text, int *power)
{
    *power = u->power;
    if (strcmp(u->name, text) == 0) return true;
    for (size_t i = 0; i < sizeof prefixes / sizeof prefixes[0]; i++) {
        size_t n = strlen(prefixes[i].name);
        *power = u->power + prefixes[i].power;
        if (strncmp(text, prefixes[i].name, n) == 0 && strcmp(text + n, u->name) == 0 &&
            strchr(u->prefixes, prefixes[i].letter))
            return true;
    }
    return false;
}

const struct units_table_unit *units_table_find(const char *text, int *power)
{
    for (size_t i = 0; i < sizeof units / sizeof units[0]; i++)
        if (matches(&units[i], text, power)) return &units[i];
    return NULL;
}

bool units_table_fits(const struct units_table_unit *u, enum key_dimension d)
{
    if (d == KEY_OUTPUT)
        return u->dimension == KEY_LENGTH || u->dimension == KEY_SPEED || u->dimension == KEY_ACCELERATION ||
               u->dimension == KEY_PRESSURE || u->dimension == KEY_FORCE;
    if (d == KEY_STIFFNESS && u->dimension == KEY_FORCE_PER_LENGTH) return true;
    return u->dimension == d;
}

/* A unit's prefixes as a class; micro has two more letters. */
static const char *prefix_pattern(const struct units_table_unit *u, struct arena *a)
{
    if (!*u->prefixes) return "";
    return arena_format(a, "[%s%s]?", u->prefixes, strchr(u->prefixes, 'u') ? "\xc2\xb5\xce\xbc" : "");
}

static const char *escaped(const char *name, struct arena *a)
{
    const char *all = "";
    for (const char *p = name; *p; p++)
        all = arena_format(a, "%s%s%c", all, strchr("^$.*+?()[]{}|\\", *p) ? "\\" : "", *p);
    return all;
}

const char *units_table_pattern(enum key_dimension d, struct arena *a)
{
    const char *all = "";
    for (size_t i = 0; i < sizeof units / sizeof units[0]; i++)
        if (units_table_fits(&units[i], d))
            all = arena_format(a, "%s%s%s%s", all, *all ? "|" : "", prefix_pattern(&units[i], a),
                               escaped(units[i].name, a));
    return all;
}
