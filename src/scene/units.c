/* Quantities with units: see units.h; the units themselves stand in units_table.c. */
#include "scene/units.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/text.h"
#include "scene/units_table.h"

enum { LONGEST = 200 /* characters */ };

const char *units_name(enum key_dimension d) { return units_table_dimension(d)->name; }

const char *units_example(enum key_dimension d) { return units_table_dimension(d)->example; }

static bool fault_set(struct units_fault *f, const char *text, const char *cure)
{
    *f = (struct units_fault){text, cure};
    return false;
}

static const char *example_cure(enum key_dimension d, struct arena *a)
{
    return arena_format(a, "write for instance: %s", units_example(d));
}

static bool has_common(enum key_dimension d)
{
    return units_table_dimension(d)->common[0][0] || units_table_dimension(d)->common[1];
}

static const char *unit_cure(const char *number, const char *unit, enum key_dimension d, struct arena *a)
{
    const char *const *common = units_table_dimension(d)->common;
    const char *all = "";
    for (int i = 0; common[i]; i++) {
        if (common[i][0] && strcasecmp(common[i], unit) == 0)
            return arena_format(a, "did you mean %s %s?", number, common[i]);
        all = arena_format(a, "%s%s%s", all, *all ? ", " : "", common[i]);
    }
    return arena_format(a, "units: %s; write for instance: %s", all, units_example(d));
}

static const char *without_article(enum key_dimension d) { return strchr(units_name(d), ' ') + 1; }

static bool unit_fault(struct units_fault *f, const char *number, const char *unit, enum key_dimension d,
                       struct arena *a)
{
    int power;
    const struct units_table_unit *other = units_table_find(unit, &power);
    const char *needs = units_name(d);
    if (other && !has_common(d))
        return fault_set(f, arena_format(a, "needs %s without a unit, not %s", needs, units_name(other->dimension)),
                         arena_format(a, "write: %s", number));
    if (other)
        return fault_set(
            f, arena_format(a, "needs %s; %s is a unit of %s", needs, unit, without_article(other->dimension)),
            example_cure(d, a));
    if (strcmp(unit, "%") == 0)
        return fault_set(f, arena_format(a, "needs %s, not a percentage", needs),
                         "write a share, such as 0.3 for 30 %");
    if (!has_common(d))
        return fault_set(f, arena_format(a, "needs %s; '%s' follows it", needs, unit),
                         arena_format(a, "write: %s", number));
    return fault_set(f, arena_format(a, "needs %s; '%s' is not a unit that is known", needs, unit),
                     unit_cure(number, unit, d, a));
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

static const char *clock_cure(const char *text, enum key_dimension d, struct arena *a)
{
    double minutes, seconds;
    const char *colon = strchr(text, ':');
    if (d == KEY_TIME && text_scaled(text, (size_t)(colon - text), 0, &minutes) && text_double(colon + 1, &seconds))
        return arena_format(a, "write it in seconds: %g s", minutes * 60 + seconds);
    return example_cure(d, a);
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
    if (text[n] == ':') return !fault_set(f, "needs one number, not a clock time or ratio", clock_cure(text, d, a));
    if (strncmp(rest, "1/", 2) == 0 && units_table_find(rest, &power)) return false;
    if ((*rest >= '0' && *rest <= '9') || *rest == '.' || *rest == '+' || *rest == '-')
        return !fault_set(f, arena_format(a, "needs one number; '%s' follows it", rest), example_cure(d, a));
    return false;
}

static bool number_read(const char *text, size_t n, int power, double *x)
{
    char copy[LONGEST + 1];
    if (power != UNITS_TABLE_DEGREES) return text_scaled(text, n, power, x);
    if (!text_scaled(text, n, 0, x)) return false;
    memcpy(copy, text, n);
    copy[n] = '\0';
    *x = (double)(strtold(copy, NULL) * (3.14159265358979323846264338327950288L / 180));
    return true;
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
        const struct units_table_unit *u = units_table_find(unit, &power);
        if (!u || !units_table_fits(u, d)) return unit_fault(f, number, unit, d, a);
    }
    if (number_read(text, n, power, x)) return true;
    return fault_set(f, "is a number too large, too small or too long to be read", example_cure(d, a));
}
