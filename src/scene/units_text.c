/* A value with the unit that suits it: units_text of units.h. Dimensions that stand for several (KEY_OUTPUT,
 * KEY_STIFFNESS) get bare SI numbers. */
#include <math.h>
#include <string.h>

#include "base/text.h"
#include "scene/units.h"
#include "scene/units_table.h"

/* 0.DIGITS * 10^e in plain notation where that is short. */
static const char *decimal(const char *digits, int e, struct arena *a)
{
    int n = (int)strlen(digits);
    if (e < -3 || e > 15) return arena_format(a, "%c%s%se%d", digits[0], n > 1 ? "." : "", digits + 1, e - 1);
    if (e <= 0) return arena_format(a, "0.%.*s%s", -e, "000", digits);
    if (e >= n) return arena_format(a, "%s%.*s", digits, e - n, "000000000000000");
    return arena_format(a, "%.*s.%s", e, digits, digits + e);
}

/* The largest common unit that leaves at least 1, else the smallest; SI's for a zero. */
static const struct units_table_unit *fitting_unit(enum key_dimension d, int exponent, int *power, const char **name)
{
    const struct units_table_unit *best = NULL;
    for (int i = 0; units_table_dimension(d)->common[i]; i++) {
        int p;
        const struct units_table_unit *u = units_table_find(units_table_dimension(d)->common[i], &p);
        if (!u || p == UNITS_TABLE_DEGREES || p == -2) continue;
        bool has_rest = exponent - p >= 1, best_has_rest = best && exponent - *power >= 1;
        if (!best || (has_rest && (!best_has_rest || p > *power)) || (!has_rest && !best_has_rest && p < *power)) {
            best = u;
            *power = p;
            *name = units_table_dimension(d)->common[i];
        }
    }
    return best;
}

const char *units_text(double x, enum key_dimension d, struct arena *a)
{
    char digits[20];
    int exponent, power = 0;
    const char *name = "";
    text_digits(fabs(x), digits, &exponent);
    bool known =
        d != KEY_OUTPUT && d != KEY_STIFFNESS && d != KEY_NONE && fitting_unit(d, x == 0 ? 1 : exponent, &power, &name);
    if (x == 0 && known) {
        power = 0;
        name = units_table_dimension(d)->common[0];
    }
    return arena_format(a, "%s%s%s%s", x < 0 ? "-" : "", decimal(digits, exponent - power, a), known ? " " : "", name);
}
