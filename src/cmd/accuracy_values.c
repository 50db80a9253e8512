/* --values KNOB=N,N... of `rasp accuracy`: which values of which knobs are rendered besides those of the presets. */
#include <string.h>

#include "base/text.h"
#include "cmd/accuracy.h"
#include "scene/accuracy.h"
#include "scene/keys.h"

static int knob_named(const char *name, size_t n)
{
    for (int k = 0; k < KNOBS; k++)
        if (strlen(keys_knobs[k].name) == n && !strncmp(keys_knobs[k].name, name, n))
            return k;
    return -1;
}

static bool no_knob(const char *name, struct arena *a, struct err *e)
{
    const char **names = ARENA_TAKE(a, const char *, KNOBS + 1), *all = "";
    for (int k = 0; k < KNOBS; k++) {
        names[k] = keys_knobs[k].name;
        all = arena_format(a, "%s%s%s", all, k ? ", " : "", names[k]);
    }
    const char *near = text_nearest(name, names);
    return near ? err_set(e, ERR_USAGE, "--values: there is no knob '%s'; did you mean '%s'?", name, near)
                : err_set(e, ERR_USAGE, "--values: there is no knob '%s'; there are %s", name, all);
}

static bool value_add(struct accuracy_values *to, int knob, const char *word, struct err *e)
{
    const struct key_knob *k = &keys_knobs[knob];
    double x;
    if (!text_double(word, &x))
        return err_set(e, ERR_USAGE, "--values: '%s' is not a number (in KNOB=NUMBER,NUMBER..., without units)", word);
    if (!accuracy_takes((enum knob)knob, x))
        return err_set(e, ERR_USAGE, "--values: accuracy.%s cannot be %s: it takes %snumbers from %g to %g; see rasp explain accuracy.%s", k->name, word,
                       k->whole ? "whole " : "", k->low, k->high, k->name);
    if (to->n == ACCURACY_VALUES)
        return err_set(e, ERR_USAGE, "--values: accuracy.%s is given more than %d values; leave some out", k->name, ACCURACY_VALUES);
    to->x[to->n++] = x;
    return true;
}

static bool values_one(const char *given, struct arena *a, struct accuracy_values *to, struct err *e)
{
    const char *equals = strchr(given, '=');
    if (!equals || !equals[1])
        return err_set(e, ERR_USAGE, "--values: '%s' is not of the form KNOB=NUMBER,NUMBER..., as in oversampling=2,16", given);
    int knob = knob_named(given, (size_t)(equals - given));
    if (knob < 0)
        return no_knob(arena_format(a, "%.*s", (int)(equals - given), given), a, e);
    for (const char *p = equals + 1;; p++) {
        size_t n = strcspn(p, ",");
        if (!value_add(&to[knob], knob, arena_format(a, "%.*s", (int)n, p), e))
            return false;
        p += n;
        if (!*p)
            return true;
    }
}

bool accuracy_values(const struct args *args, struct arena *a, struct accuracy_values *to, struct err *e)
{
    int n;
    const char **given = args_values(args, "values", &n);
    for (int k = 0; k < KNOBS; k++)
        to[k].x = ARENA_TAKE(a, double, ACCURACY_VALUES);
    for (int i = 0; i < n; i++)
        if (!values_one(given[i], a, to, e))
            return false;
    return true;
}
