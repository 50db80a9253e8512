/* Quantities with units: see units.h. */
#include "scene/units.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/text.h"

enum { LONGEST = 200 /* characters of a quantity */ };
enum { DEGREES = 1000, MINUTES, HOURS }; /* in place of a power of ten */

static const long double factors[] = {3.14159265358979323846264338327950288L / 180, 60, 3600};

static const struct {
    const char *name, *example;
    const char *common[9]; /* units to name in messages; the first is SI's */
} dimensions[] = {
    [KEY_NONE] = {"a plain number", "0.5", {""}},
    [KEY_LENGTH] = {"a length", "3 cm", {"m", "cm", "mm", "um", "nm"}},
    [KEY_TIME] = {"a time", "10 ms", {"s", "ms", "us", "ns", "min", "h"}},
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

/* What `rasp explain` says where it is not "length (a bare number is in m)". */
static const char *const types[] = {
    [KEY_NONE] = "number",
    [KEY_PER_AREA] = "number per area (a bare number is per m^2)",
    [KEY_DECIBEL] = "level (a bare number is in dB)",
    [KEY_FORCE_COEFFICIENT] = "force coefficient (a bare number is in N (s/m)^beta2)",
    [KEY_OUTPUT] = "length, speed, acceleration, pressure or force, as it is heard (a bare number is SI)",
    [KEY_PER_TIME] = "rate (a bare number is per second)",
    [KEY_STIFFNESS] = "stiffness (a bare number is SI: N/m, or N/m^1.5)",
    [KEY_DISSIPATION] = "dissipation (a bare number is in N s/m^2.5)",
};

static const struct units_unit units[] = {
    {"m", KEY_LENGTH, 0, "numckMG"},
    {"s", KEY_TIME, 0, "numkMG"},
    {"sec", KEY_TIME, 0, ""},
    {"min", KEY_TIME, MINUTES, ""},
    {"h", KEY_TIME, HOURS, ""},
    {"Hz", KEY_FREQUENCY, 0, "numkMG"},
    {"g", KEY_MASS, -3, "numkMG"},
    {"N", KEY_FORCE, 0, "numkMG"},
    {"m/s", KEY_SPEED, 0, "numckMG"},
    {"m/s^2", KEY_ACCELERATION, 0, "numckMG"},
    {"m/s2", KEY_ACCELERATION, 0, "numckMG"},
    {"m/s\xc2\xb2", KEY_ACCELERATION, 0, "numckMG"},
    {"rad", KEY_ANGLE, 0, "num"},
    {"deg", KEY_ANGLE, DEGREES, ""},
    {"\xc2\xb0", KEY_ANGLE, DEGREES, ""},
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

const struct units_unit *units_find(const char *text, int *power)
{
    for (const struct units_unit *u = units; u < units + sizeof units / sizeof *units; u++) {
        *power = u->power;
        if (strcmp(u->name, text) == 0) return u;
        for (size_t i = 0; i < sizeof prefixes / sizeof prefixes[0]; i++) {
            size_t n = strlen(prefixes[i].name);
            *power = u->power + prefixes[i].power;
            if (strncmp(text, prefixes[i].name, n) == 0 && strcmp(text + n, u->name) == 0 &&
                strchr(u->prefixes, prefixes[i].letter))
                return u;
        }
    }
    return NULL;
}

/* May a quantity of the dimension have the unit? KEY_OUTPUT takes those of four dimensions, KEY_STIFFNESS those of a
 * force per length too. */
static bool units_fits(const struct units_unit *u, enum key_dimension d)
{
    if (d == KEY_OUTPUT)
        return u->dimension == KEY_LENGTH || u->dimension == KEY_SPEED || u->dimension == KEY_ACCELERATION ||
               u->dimension == KEY_PRESSURE || u->dimension == KEY_FORCE;
    if (d == KEY_STIFFNESS && u->dimension == KEY_FORCE_PER_LENGTH) return true;
    return u->dimension == d;
}

const char *units_pattern(enum key_dimension d, struct arena *a)
{
    const char *all = "";
    for (const struct units_unit *u = units; u < units + sizeof units / sizeof *units; u++) {
        if (!units_fits(u, d)) continue;
        if (*all) all = arena_format(a, "%s|", all);
        if (*u->prefixes) /* as a class; micro has two more letters */
            all = arena_format(a, "%s[%s%s]?", all, u->prefixes, strchr(u->prefixes, 'u') ? "\xc2\xb5\xce\xbc" : "");
        for (const char *p = u->name; *p; p++)
            all = arena_format(a, "%s%s%c", all, strchr("^$.*+?()[]{}|\\", *p) ? "\\" : "", *p);
    }
    return all;
}

/* ------------------------------------------------------------------ reading */

const char *units_si(enum key_dimension d) { return dimensions[d].common[0]; }

const char *units_type(enum key_dimension d, struct arena *a)
{
    const char *name = dimensions[d].name, *type = types[d];
    return type ? type : arena_format(a, "%s (a bare number is in %s)", strchr(name, ' ') + 1, units_si(d));
}

const char *units_name(enum key_dimension d) { return dimensions[d].name; }

const char *units_example(enum key_dimension d) { return dimensions[d].example; }

static bool fault_set(struct units_fault *f, const char *text, const char *cure)
{
    *f = (struct units_fault){text, cure};
    return false;
}

static const char *example_cure(enum key_dimension d, struct arena *a)
{
    return arena_format(a, "write for instance: %s", units_example(d));
}

static bool has_common(enum key_dimension d) { return dimensions[d].common[0][0] || dimensions[d].common[1]; }

static bool unit_fault(struct units_fault *f, const char *number, const char *unit, enum key_dimension d,
                       struct arena *a)
{
    int power;
    const struct units_unit *other = units_find(unit, &power);
    const char *needs = units_name(d);
    if (other && !has_common(d))
        return fault_set(f, arena_format(a, "needs %s without a unit, not %s", needs, units_name(other->dimension)),
                         arena_format(a, "write: %s", number));
    if (other)
        return fault_set(
            f,
            arena_format(a, "needs %s; %s is a unit of %s", needs, unit, strchr(units_name(other->dimension), ' ') + 1),
            example_cure(d, a));
    if (strcmp(unit, "%") == 0)
        return fault_set(f, arena_format(a, "needs %s, not a percentage", needs),
                         "write a share, such as 0.3 for 30 %");
    if (!has_common(d))
        return fault_set(f, arena_format(a, "needs %s; '%s' follows it", needs, unit),
                         arena_format(a, "write: %s", number));
    const char *says = arena_format(a, "needs %s; '%s' is not a unit that is known", needs, unit), *all = "";
    for (const char *const *common = dimensions[d].common; *common; common++) {
        if (**common && strcasecmp(*common, unit) == 0)
            return fault_set(f, says, arena_format(a, "did you mean %s %s?", number, *common));
        all = arena_format(a, "%s%s%s", all, *all ? ", " : "", *common);
    }
    return fault_set(f, says, arena_format(a, "units: %s; write for instance: %s", all, units_example(d)));
}

/* The text with each character of `of` replaced by `by` (0: left out). */
static const char *replaced(const char *text, char of, char by, struct arena *a)
{
    char *copy = arena_text(a, text), *to = copy;
    for (const char *s = text; *s; s++)
        if (*s != of)
            *to++ = *s;
        else if (by)
            *to++ = by;
    *to = '\0';
    return copy;
}

static bool is_word(const char *text, const char *const *words)
{
    for (; *words; words++)
        if (strcasecmp(text, *words) == 0) return true;
    return false;
}

/* What does not even start with a number. */
static bool word_fault(struct units_fault *f, const char *text, enum key_dimension d, struct arena *a)
{
    static const char *const truths[] = {"yes", "no", "true", "false", "on", "off", "y", "n", NULL};
    static const char *const infinite[] = {".inf", "-.inf", "+.inf",    "inf",       "-inf", "+inf",
                                           ".nan", "nan",   "infinity", "-infinity", NULL};
    const char *needs = units_name(d);
    if (!*text) return fault_set(f, arena_format(a, "has no value; it needs %s", needs), example_cure(d, a));
    if (is_word(text, truths))
        return fault_set(f, arena_format(a, "needs %s, not the yes/no word '%s'", needs, text), example_cure(d, a));
    if (is_word(text, infinite))
        return fault_set(f, arena_format(a, "needs %s that is finite, not '%s'", needs, text), example_cure(d, a));
    return fault_set(f, arena_format(a, "needs %s, not '%s'", needs, text), example_cure(d, a));
}

/* Notations that other readers take for a number in their own way: leading zeros, 0x.., 1_000, 1,5, 1:30, 1 000. */
static bool notation_fault(struct units_fault *f, const char *text, enum key_dimension d, struct arena *a)
{
    size_t sign = *text == '+' || *text == '-', n = text_number_length(text);
    const char *digits = text + sign, *rest = text + n + strspn(text + n, " \t");
    size_t zeros = strspn(digits, "0");
    int power;
    if (digits[0] == '0' && strchr("xXoObB", digits[1]) && digits[1])
        return !fault_set(f, "needs a decimal number, not a hexadecimal, octal or binary one", example_cure(d, a));
    if (zeros > 0 && digits[zeros] >= '0' && digits[zeros] <= '9')
        return !fault_set(f, "needs a number without leading zeros, which some take for octal",
                          arena_format(a, "write: %.*s%s", (int)sign, text, digits + zeros));
    if (digits[0] == '0' && digits[1] == '0')
        return !fault_set(f, "needs a number without leading zeros, which some take for octal", "write: 0");
    if (text[n] == '_')
        return !fault_set(f, "needs a number without underscores",
                          arena_format(a, "write: %s", replaced(text, '_', 0, a)));
    if (text[n] == ',')
        return !fault_set(f, "needs a number with a decimal point, not a comma",
                          arena_format(a, "write: %s", replaced(text, ',', '.', a)));
    if (text[n] == ':') {
        double minutes, seconds;
        bool time = d == KEY_TIME && text_scaled(text, n, 0, &minutes) && text_double(text + n + 1, &seconds);
        return !fault_set(f, "needs one number, not a clock time or ratio",
                          time ? arena_format(a, "write it in seconds: %g s", minutes * 60 + seconds)
                               : example_cure(d, a));
    }
    if (strncmp(rest, "1/", 2) == 0 && units_find(rest, &power)) return false;
    if ((*rest >= '0' && *rest <= '9') || *rest == '.' || *rest == '+' || *rest == '-')
        return !fault_set(f, arena_format(a, "needs one number; '%s' follows it", rest), example_cure(d, a));
    return false;
}

bool units_read(const char *text, enum key_dimension d, double *x, struct arena *a, struct units_fault *f)
{
    size_t n = text_number_length(text);
    const char *unit = text + n + strspn(text + n, " \t");
    const char *number = arena_format(a, "%.*s", (int)n, text);
    int power = 0;
    if (strlen(text) > LONGEST) return fault_set(f, "is too long for a number", example_cure(d, a));
    if (n == 0) return word_fault(f, text, d, a);
    if (notation_fault(f, text, d, a)) return false;
    if (*unit) {
        const struct units_unit *u = units_find(unit, &power);
        if (!u || !units_fits(u, d)) return unit_fault(f, number, unit, d, a);
    }
    if (text_scaled(text, n, power >= DEGREES ? 0 : power, x)) {
        if (power >= DEGREES) *x = (double)(strtold(number, NULL) * factors[power - DEGREES]);
        return true;
    }
    return fault_set(f, "is a number too large, too small or too long to be read", example_cure(d, a));
}

/* ------------------------------------------------------------------ writing */

/* A value with the unit that suits it. Dimensions that stand for several (KEY_OUTPUT, KEY_STIFFNESS) get bare SI
 * numbers. */

/* 0.DIGITS * 10^e in plain notation where that is short. */
static const char *decimal(const char *digits, int e, struct arena *a)
{
    int n = (int)strlen(digits);
    if (e < -3 || e > 15) return arena_format(a, "%c%s%se%d", digits[0], n > 1 ? "." : "", digits + 1, e - 1);
    if (e <= 0) return arena_format(a, "0.%.*s%s", -e, "000", digits);
    if (e >= n) return arena_format(a, "%s%.*s", digits, e - n, "000000000000000");
    return arena_format(a, "%.*s.%s", e, digits, digits + e);
}

const char *units_text(double x, enum key_dimension d, struct arena *a)
{
    char digits[20];
    int exponent, power = 0;
    const char *name = "";
    bool bare = d == KEY_OUTPUT || d == KEY_STIFFNESS || d == KEY_NONE;
    text_digits(fabs(x), digits, &exponent);
    /* The largest common unit that leaves at least 1, else the smallest; SI's for a zero. */
    for (const char *const *common = dimensions[d].common; !bare && x != 0 && *common; common++) {
        int p;
        if (!units_find(*common, &p) || p >= DEGREES || p == -2) continue;
        bool has_rest = exponent - p >= 1, best_has_rest = *name && exponent - power >= 1;
        if (!*name || (has_rest && (!best_has_rest || p > power)) || (!has_rest && !best_has_rest && p < power)) {
            power = p;
            name = *common;
        }
    }
    if (!bare && x == 0) name = dimensions[d].common[0];
    return arena_format(a, "%s%s%s%s", x < 0 ? "-" : "", decimal(digits, exponent - power, a), *name ? " " : "", name);
}
