/* Quantities against the doubles that the compiler makes of the same decimal number: equal to the last bit (one
   rounding). Degrees against published decimals of pi/6 and, elsewhere, the plain formula within its three roundings.
   Numbers and distances of base/text.c are tested here too. */
#include "scene/units.h"

#include "base/text.h"
#include "unit.h"

static const double pi = 3.14159265358979323846;

static const struct {
    const char *text;
    enum key_dimension dimension;
    double value;
} good[] = {
    {"20 g", KEY_MASS, 0.02},
    {"20g", KEY_MASS, 0.02},
    {"1 kg", KEY_MASS, 1},
    {"0.3 kg", KEY_MASS, 0.3},
    {"7 mg", KEY_MASS, 7e-6},
    {"3 ug", KEY_MASS, 3e-9},
    {"5.6 um", KEY_LENGTH, 5.6e-6},
    {"5.6 \xc2\xb5m", KEY_LENGTH, 5.6e-6},
    {"5.6 \xce\xbcm", KEY_LENGTH, 5.6e-6},
    {"7.5 cm", KEY_LENGTH, 0.075},
    {"2.3 mm", KEY_LENGTH, 2.3e-3},
    {"0.7 nm", KEY_LENGTH, 0.7e-9},
    {"1.1 km", KEY_LENGTH, 1100},
    {"3 m", KEY_LENGTH, 3},
    {"3", KEY_LENGTH, 3},
    {"-3 cm", KEY_LENGTH, -0.03},
    {"+3 cm", KEY_LENGTH, 0.03},
    {".5 m", KEY_LENGTH, 0.5},
    {"5. m", KEY_LENGTH, 5},
    {"1e-3 m", KEY_LENGTH, 1e-3},
    {"1E2 mm", KEY_LENGTH, 0.1},
    {"1e3m", KEY_LENGTH, 1000},
    {"0 m", KEY_LENGTH, 0},
    {"0.0 nm", KEY_LENGTH, 0},
    {"2 Hz", KEY_FREQUENCY, 2},
    {"1 kHz", KEY_FREQUENCY, 1000},
    {"44.1 kHz", KEY_FREQUENCY, 44100},
    {"48 kHz", KEY_FREQUENCY, 48000},
    {"1.5 MHz", KEY_FREQUENCY, 1.5e6},
    {"3 mHz", KEY_FREQUENCY, 3e-3},
    {"2 GHz", KEY_FREQUENCY, 2e9},
    {"10 ms", KEY_TIME, 0.01},
    {"50 us", KEY_TIME, 50e-6},
    {"50 \xc2\xb5s", KEY_TIME, 50e-6},
    {"0.1 s", KEY_TIME, 0.1},
    {"3 ns", KEY_TIME, 3e-9},
    {"1.5 N", KEY_FORCE, 1.5},
    {"1.7 mN", KEY_FORCE, 1.7e-3},
    {"2 kN", KEY_FORCE, 2000},
    {"10 cm/s", KEY_SPEED, 0.1},
    {"3.3 mm/s", KEY_SPEED, 3.3e-3},
    {"3.3 m/s", KEY_SPEED, 3.3},
    {"9.81 m/s^2", KEY_ACCELERATION, 9.81},
    {"9.80665 m/s2", KEY_ACCELERATION, 9.80665},
    {"9.81 m/s\xc2\xb2", KEY_ACCELERATION, 9.81},
    {"5 mm/s^2", KEY_ACCELERATION, 5e-3},
    {"0.3 rad", KEY_ANGLE, 0.3},
    {"3 mrad", KEY_ANGLE, 3e-3},
    {"-3 dB", KEY_DECIBEL, -3},
    {"-3", KEY_DECIBEL, -3},
    {"-23", KEY_LUFS, -23},
    {"-23 LUFS", KEY_LUFS, -23},
    {"0.05", KEY_FORCE_COEFFICIENT, 0.05},
    {"0.05 N s/m", KEY_FORCE_COEFFICIENT, 0.05},
    {"0.05 N (s/m)^beta2", KEY_FORCE_COEFFICIENT, 0.05},
    {"0.01", KEY_OUTPUT, 0.01},
    {"10 mm/s", KEY_OUTPUT, 0.01},
    {"3 um", KEY_OUTPUT, 3e-6},
    {"2 m/s^2", KEY_OUTPUT, 2},
    {"7 um/s", KEY_OUTPUT, 7e-6},
    {"4 nm", KEY_OUTPUT, 4e-9},
    {"0.3", KEY_NONE, 0.3},
    {"-2.4", KEY_NONE, -2.4},
    {"12.7 /mm^2", KEY_PER_AREA, 12.7e6},
    {"3/cm\xc2\xb2", KEY_PER_AREA, 3e4},
    {"0.3 /m2", KEY_PER_AREA, 0.3},
    {"0.07 /um^2", KEY_PER_AREA, 7e10},
    {"12 GPa", KEY_PRESSURE, 12e9},
    {"0.8 MPa", KEY_PRESSURE, 0.8e6},
    {"3 kPa", KEY_PRESSURE, 3000},
    {"20 uPa", KEY_OUTPUT, 20e-6},
    {"650 kg/m^3", KEY_DENSITY, 650},
    {"0.65 g/cm^3", KEY_DENSITY, 650},
    {"0.65 g/cm\xc2\xb3", KEY_DENSITY, 650},
    {"7.1 g/m3", KEY_DENSITY, 7.1e-3},
    {"2.2 kN/m", KEY_FORCE_PER_LENGTH, 2200},
    {"3.3 N/mm", KEY_FORCE_PER_LENGTH, 3300},
    {"7 N/cm", KEY_FORCE_PER_LENGTH, 700},
    {"5 N/m", KEY_FORCE_PER_LENGTH, 5},
    {"12.7 1/s", KEY_PER_TIME, 12.7},
    {"12.7/s", KEY_PER_TIME, 12.7},
    {"12.7 /s", KEY_PER_TIME, 12.7},
    {"12.7", KEY_PER_TIME, 12.7},
    {"2.1 MN/m", KEY_STIFFNESS, 2.1e6},
    {"1.1 GN/m^1.5", KEY_STIFFNESS, 1.1e9},
    {"7 N/m^(3/2)", KEY_STIFFNESS, 7},
    {"3 N/mm", KEY_STIFFNESS, 3000},
    {"5e9 N/(m^1.5 kg)", KEY_STIFFNESS_PER_MASS, 5e9},
    {"2.3 MN/m^1.5/kg", KEY_STIFFNESS_PER_MASS, 2.3e6},
    {"5e7", KEY_STIFFNESS_PER_MASS, 5e7},
    {"0.3 s/m", KEY_PER_SPEED, 0.3},
    {"7 ms/m", KEY_PER_SPEED, 7e-3},
    {"0.1 N s/m^2.5", KEY_DISSIPATION, 0.1},
    {"3 kN*s/m^2.5", KEY_DISSIPATION, 3000},
    {"1.5 N", KEY_OUTPUT, 1.5},
    {"2 kN", KEY_OUTPUT, 2000},
    {"1e-300", KEY_NONE, 1e-300},
    {"0e999", KEY_NONE, 0},
};

START_TEST(test_good)
{
    struct arena *a = arena_open();
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        struct units_fault fault = {NULL, NULL};
        double x = -777;
        ck_assert_msg(units_read(good[i].text, good[i].dimension, &x, a, &fault), "%s: %s", good[i].text, fault.text);
        ck_assert_msg(x == good[i].value, "%s: %.17g, not %.17g", good[i].text, x, good[i].value);
    }
    arena_close(a);
}
END_TEST

/* Every thousandth from 0.001 to 20 with each prefix equals the literal with the exponent, which strtod rounds once. */
START_TEST(test_one_rounding)
{
    static const struct {
        const char *unit;
        int power;
    } units[] = {{"nm", -9}, {"um", -6}, {"mm", -3}, {"cm", -2}, {"km", 3}};
    struct arena *a = arena_open();
    int multiplied_differs = 0;
    for (size_t u = 0; u < 5; u++)
        for (int i = 1; i <= 20000; i += 7) {
            char text[64], literal[64];
            struct units_fault fault;
            double x, want;
            snprintf(text, sizeof text, "%d.%03d %s", i / 1000, i % 1000, units[u].unit);
            snprintf(literal, sizeof literal, "%de%d", i, units[u].power - 3);
            want = strtod(literal, NULL);
            ck_assert(units_read(text, KEY_LENGTH, &x, a, &fault));
            ck_assert_msg(x == want, "%s: %.17g, not %.17g", text, x, want);
            multiplied_differs += i / 1000.0 * pow(10, units[u].power) != want;
        }
    ck_assert_int_gt(multiplied_differs, 100); /* so that this test can fail: the plain product does not do it */
    arena_close(a);
}
END_TEST

START_TEST(test_degrees)
{
    struct arena *a = arena_open();
    struct units_fault fault;
    double x;
    ck_assert(units_read("30 deg", KEY_ANGLE, &x, a, &fault) && x == 0.523598775598298873077107230546583814);
    ck_assert(units_read("180 deg", KEY_ANGLE, &x, a, &fault) && x == pi);
    ck_assert(units_read("-90 \xc2\xb0", KEY_ANGLE, &x, a, &fault) && x == -pi / 2);
    for (int i = 1; i < 3600; i++) {
        char text[32];
        snprintf(text, sizeof text, "%.1f deg", i / 10.0);
        ck_assert(units_read(text, KEY_ANGLE, &x, a, &fault));
        ck_assert_msg(fabs(x - i * pi / 1800) <= 2.3e-16 * x * 2, "%s",
                      text); /* the plain formula rounds three times */
    }
    arena_close(a);
}
END_TEST

static const struct {
    const char *text;
    enum key_dimension dimension;
    const char *says, *cure;
} bad[] = {
    {"3 m", KEY_FREQUENCY, "needs a frequency; m is a unit of length", "2 Hz"},
    {"3 kHz", KEY_LENGTH, "needs a length; kHz is a unit of frequency", "3 cm"},
    {"3 m/s", KEY_ACCELERATION, "unit of speed", "m/s^2"},
    {"20 cm", KEY_MASS, "needs a mass", "20 g"},
    {"2 rad", KEY_NONE, "needs a plain number without a unit", "write: 2"},
    {"2 apples", KEY_NONE, "'apples' follows it", "write: 2"},
    {"2 Hertz", KEY_FREQUENCY, "'Hertz' is not a unit that is known", "Hz, kHz"},
    {"2 hz", KEY_FREQUENCY, "'hz' is not a unit", "did you mean 2 Hz?"},
    {"48 KHz", KEY_FREQUENCY, "'KHz' is not a unit", "did you mean 48 kHz?"},
    {"2 Kg", KEY_MASS, "'Kg' is not", "did you mean 2 kg?"},
    {"3 s", KEY_OUTPUT, "needs a length, speed, acceleration, pressure or force; s is a unit of time", "mm/s"},
    {"2 cg", KEY_MASS, "'cg' is not", "kg, g, mg"},
    {"30 %", KEY_NONE, "not a percentage", "0.3"},
    {"fast", KEY_SPEED, "needs a speed, not 'fast'", "10 cm/s"},
    {"", KEY_TIME, "has no value", "10 ms"},
    {"g", KEY_MASS, "not 'g'", "20 g"},
    {"yes", KEY_NONE, "yes/no word 'yes'", "0.5"},
    {"False", KEY_NONE, "yes/no word 'False'", "0.5"},
    {"off", KEY_TIME, "yes/no word", "10 ms"},
    {"inf", KEY_NONE, "finite", "0.5"},
    {".inf", KEY_NONE, "finite", "0.5"},
    {"-.INF", KEY_NONE, "finite", "0.5"},
    {".nan", KEY_NONE, "finite", "0.5"},
    {"NaN", KEY_NONE, "finite", "0.5"},
    {"infinity", KEY_NONE, "finite", "0.5"},
    {"1e999", KEY_NONE, "too large", "0.5"},
    {"1e-999", KEY_NONE, "too small", "0.5"},
    {"1e308 km", KEY_LENGTH, "too large", "3 cm"},
    {"1e999999999999999999999", KEY_NONE, "too large", "0.5"},
    {"0x10", KEY_NONE, "decimal", "0.5"},
    {"0x1p4 m", KEY_LENGTH, "decimal", "3 cm"},
    {"0o17", KEY_NONE, "decimal", "0.5"},
    {"0b1", KEY_NONE, "decimal", "0.5"},
    {"010", KEY_NONE, "leading zeros", "write: 10"},
    {"-007 m", KEY_LENGTH, "leading zeros", "write: -7 m"},
    {"00", KEY_NONE, "leading zeros", "write: 0"},
    {"1_000", KEY_NONE, "underscores", "write: 1000"},
    {"1,5 m", KEY_LENGTH, "decimal point, not a comma", "write: 1.5 m"},
    {"1:30", KEY_TIME, "clock time", "90 s"},
    {"1:30", KEY_LENGTH, "clock time", "3 cm"},
    {"1 000 m", KEY_LENGTH, "one number; '000 m' follows it", "3 cm"},
    {"1.2.3", KEY_NONE, "one number; '.3' follows it", "0.5"},
    {"1-2 m", KEY_LENGTH, "one number; '-2 m' follows it", "3 cm"},
    {"--3", KEY_NONE, "not '--3'", "0.5"},
    {"1e5e3", KEY_NONE, "'e3' follows it", "write: 1e5"},
    {"3 m m", KEY_LENGTH, "'m m' is not", "3 cm"},
    {"12 gpa", KEY_PRESSURE, "'gpa' is not a unit", "did you mean 12 GPa?"},
    {"12 N/m", KEY_PRESSURE, "needs a pressure or modulus; N/m is a unit of force per length", "12 GPa"},
    {"12 bar", KEY_PRESSURE, "'bar' is not a unit", "Pa, kPa, MPa, GPa"},
    {"650 g", KEY_DENSITY, "needs a density; g is a unit of mass", "650 kg/m^3"},
    {"5 N", KEY_FORCE_PER_LENGTH, "needs a force per length; N is a unit of force", "2 kN/m"},
    {"5 N/m^1.5", KEY_FORCE_PER_LENGTH, "N/m^1.5 is a unit of stiffness", "2 kN/m"},
    {"5 Hz", KEY_PER_TIME, "needs a rate per second; Hz is a unit of frequency", "10 1/s"},
    {"5 1/ms", KEY_PER_TIME, "one number; '1/ms' follows it", "10 1/s"},
    {"5 1/s", KEY_TIME, "needs a time; 1/s is a unit of rate per second", "10 ms"},
    {"5 N/m^2", KEY_STIFFNESS, "'N/m^2' is not a unit", "N/m, kN/m, MN/m, N/m^1.5"},
    {"5 Pa", KEY_STIFFNESS, "needs a stiffness; Pa is a unit of pressure", "2 MN/m"},
};

START_TEST(test_bad)
{
    struct arena *a = arena_open();
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        struct units_fault fault = {"", ""};
        double x = 5;
        ck_assert_msg(!units_read(bad[i].text, bad[i].dimension, &x, a, &fault), "%s is taken as %g", bad[i].text, x);
        ck_assert_msg(strstr(fault.text, bad[i].says) != NULL, "%s: %s", bad[i].text, fault.text);
        ck_assert_msg(strstr(fault.cure, bad[i].cure) != NULL, "%s: %s", bad[i].text, fault.cure);
    }
    arena_close(a);
}
END_TEST

START_TEST(test_long)
{
    struct arena *a = arena_open();
    struct units_fault fault = {"", ""};
    char text[1000];
    double x;
    memset(text, '1', sizeof text);
    text[999] = '\0';
    ck_assert(!units_read(text, KEY_NONE, &x, a, &fault) && strstr(fault.text, "too long"));
    arena_close(a);
}
END_TEST

START_TEST(test_text)
{
    static const struct {
        double x;
        enum key_dimension d;
        const char *text;
    } rows[] = {{0.02, KEY_MASS, "20 g"},     {1e-9, KEY_LENGTH, "1 nm"},
                {50e-6, KEY_TIME, "50 us"},   {48000, KEY_FREQUENCY, "48 kHz"},
                {0, KEY_TIME, "0 s"},         {-0.03, KEY_LENGTH, "-30 mm"},
                {0.5, KEY_NONE, "0.5"},       {1000, KEY_MASS, "1000 kg"},
                {3600, KEY_TIME, "3600 s"},   {-200, KEY_DECIBEL, "-200 dB"},
                {1e-30, KEY_OUTPUT, "1e-30"}, {1.5707, KEY_ANGLE, "1.5707 rad"},
                {1e5, KEY_FORCE, "100 kN"},   {1.5e7, KEY_PER_AREA, "15 /mm^2"},
                {1, KEY_PER_AREA, "1 /m^2"},  {1e6, KEY_FORCE_COEFFICIENT, "1000000 N s/m"}};
    struct arena *a = arena_open();
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        ck_assert_str_eq(units_text(rows[i].x, rows[i].d, a), rows[i].text);
    srand(1);
    for (int i = 0; i < 20000; i++) {
        double x = ldexp(rand() / (double)RAND_MAX - 0.5, rand() % 80 - 40), back;
        struct units_fault fault;
        enum key_dimension d = (enum key_dimension)(rand() % (KEY_OUTPUT + 1));
        const char *text = units_text(x, d, a);
        ck_assert_msg(units_read(text, d, &back, a, &fault), "%s", text);
        ck_assert_msg(back == x, "%.17g written as %s", x, text);
    }
    arena_close(a);
}
END_TEST

START_TEST(test_numbers)
{
    double x;
    int i;
    uint64_t u;
    ck_assert(text_double("2.5", &x) && x == 2.5 && !text_double("2.5 ", &x) && !text_double("", &x) &&
              !text_double(".", &x) && !text_double("1e", &x));
    ck_assert(text_int("-12", -20, 20, &i) && i == -12 && !text_int("21", -20, 20, &i) &&
              !text_int("1x", -20, 20, &i) && !text_int("99999999999", 0, 9, &i));
    ck_assert(text_u64("18446744073709551615", &u) && u == UINT64_MAX && !text_u64("18446744073709551616", &u) &&
              !text_u64("-1", &u) && !text_u64("", &u));
    ck_assert_uint_eq(text_number_length("1e5m"), 3);
    ck_assert_uint_eq(text_number_length("5em"), 1);
    ck_assert_uint_eq(text_number_length("-.5x"), 3);
}
END_TEST

START_TEST(test_distance)
{
    static const char *const names[] = {"trajectory", "rate", "rasp", "motion", NULL};
    ck_assert_int_eq(text_distance("trajetcory", "trajectory"),
                     1); /* neighbours exchanged: Levenshtein's distance is 2 */
    ck_assert_int_eq(text_distance("kitten", "sitting"), 3);
    ck_assert_int_eq(text_distance("", "abc"), 3);
    ck_assert_int_eq(text_distance("ca", "abc"), 3); /* optimal string alignment */
    ck_assert_int_eq(text_distance("same", "same"), 0);
    ck_assert_str_eq(text_nearest("trajetcory", names), "trajectory");
    ck_assert_str_eq(text_nearest("mtoion", names), "motion");
    ck_assert_ptr_null(text_nearest("loudness", names));
    ck_assert_ptr_null(text_nearest("x", names));
}
END_TEST

START_TEST(test_utf8)
{
    static const struct {
        const char *s;
        int n;
        uint32_t code;
    } rows[] = {{"a", 1, 'a'},
                {"\xc2\xb5", 2, 0xb5},
                {"\xe2\x82\xac", 3, 0x20ac},
                {"\xf0\x9f\x98\x80", 4, 0x1f600},
                {"\xc0\x80", 0, 0},
                {"\x80", 0, 0},
                {"\xed\xa0\x80", 0, 0},
                {"\xf4\x90\x80\x80", 0, 0},
                {"\xe0\x80\xaf", 0, 0},
                {"\xc2", 0, 0},
                {"\xff", 0, 0},
                {"\xf0\x8f\xbf\xbf", 0, 0}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        uint32_t code = 0;
        ck_assert_msg(text_utf8(rows[i].s, strlen(rows[i].s), &code) == rows[i].n && code == rows[i].code, "row %zu",
                      i);
    }
    ck_assert_uint_eq(text_utf8_count("5 \xc2\xb5m\xff", 6), 5);
}
END_TEST

UNIT("units", test_good, test_one_rounding, test_degrees, test_bad, test_long, test_text, test_numbers, test_distance,
     test_utf8)
