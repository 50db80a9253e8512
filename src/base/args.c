/* See args.h. Values and operands point into argv; only the arrays that hold them are the arena's. */
#include "base/args.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"

struct words {
    char *const *argv;
    int argc, at;
};

static int option_count(const struct args_option *options)
{
    int n = 0;
    while (options[n].name)
        n++;
    return n;
}

static int option_long(const struct args_option *options, const char *name, size_t length)
{
    for (int i = 0; options[i].name; i++)
        if (strlen(options[i].name) == length && !strncmp(options[i].name, name, length)) return i;
    return -1;
}

static int option_named(const struct args *g, const char *name)
{
    int i = option_long(g->options, name, strlen(name));
    if (i < 0) {
        fprintf(stderr, "rasp: option --%s is asked for but in no table\n", name);
        abort();
    }
    return i;
}

/* What was meant is the only option that begins so, else the nearest. */
static bool long_unknown(const struct args_option *options, const char *name, struct arena *a, struct err *e)
{
    const char *meant = NULL;
    int n = option_count(options), hits = 0;
    const char **names = ARENA_TAKE(a, const char *, n + 2);
    for (int i = 0; i < n; i++) {
        names[i] = options[i].name;
        if (!strncmp(names[i], name, strlen(name))) {
            meant = names[i];
            hits++;
        }
    }
    names[n] = "help";
    if (hits != 1) meant = text_nearest(name, names);
    return meant ? err_set(e, ERR_USAGE, "no option --%s; did you mean --%s?", name, meant)
                 : err_set(e, ERR_USAGE, "no option --%s", name);
}

/* Notes that option i was given, with its value if it takes one. */
static bool option_take(struct args *g, int i, const char *value, struct err *e)
{
    if (g->given[i] > 0 && !g->options[i].many) return err_set(e, ERR_USAGE, "--%s is given twice", g->options[i].name);
    g->values[i][g->given[i]++] = value;
    return true;
}

static bool value_missing(const struct args_option *o, struct err *e)
{
    return err_set(e, ERR_USAGE, "--%s needs a value: --%s=%s", o->name, o->name, o->value);
}

static bool long_parse(struct args *g, struct words *w, struct arena *a, struct err *e)
{
    const char *text = w->argv[w->at++] + 2, *equals = strchr(text, '=');
    size_t length = equals ? (size_t)(equals - text) : strlen(text);
    int i = option_long(g->options, text, length);
    if (length == 4 && !strncmp(text, "help", 4) && i < 0) {
        g->help = true;
        return true;
    }
    if (i < 0) return long_unknown(g->options, arena_format(a, "%.*s", (int)length, text), a, e);
    const struct args_option *o = &g->options[i];
    if (!o->value) return equals ? err_set(e, ERR_USAGE, "--%s takes no value", o->name) : option_take(g, i, NULL, e);
    if (equals) return option_take(g, i, equals + 1, e);
    return w->at < w->argc ? option_take(g, i, w->argv[w->at++], e) : value_missing(o, e);
}

static bool letters_parse(struct args *g, struct words *w, struct err *e)
{
    for (const char *p = w->argv[w->at++] + 1; *p && !g->help; p++) {
        const struct args_option *o = g->options;
        while (o->name && o->letter != *p)
            o++;
        int i = (int)(o - g->options);
        if (!o->name && *p == 'h') {
            g->help = true;
            break;
        }
        if (!o->name) return err_set(e, ERR_USAGE, "no option -%c", *p);
        if (!o->value) {
            if (!option_take(g, i, NULL, e)) return false;
            continue;
        }
        if (p[1]) return option_take(g, i, p + 1, e);
        return w->at < w->argc ? option_take(g, i, w->argv[w->at++], e) : value_missing(o, e);
    }
    return true;
}

bool args_parse(struct args *g, const struct args_option *options, int argc, char *const *argv, struct arena *a,
                struct err *e)
{
    struct words w = {argv, argc, 0};
    bool ended = false;
    int n = option_count(options);
    *g = (struct args){.options = options,
                       .values = ARENA_TAKE(a, const char **, n + 1),
                       .given = ARENA_TAKE(a, int, n + 1),
                       .operands = ARENA_TAKE(a, const char *, argc + 1)};
    for (int i = 0; i < n; i++)
        g->values[i] = ARENA_TAKE(a, const char *, argc + 1);
    while (w.at < argc && !g->help) {
        const char *word = argv[w.at];
        if (ended || word[0] != '-' || !word[1]) {
            g->operands[g->n_operands++] = word;
            w.at++;
        } else if (!strcmp(word, "--")) {
            ended = true;
            w.at++;
        } else if (!(word[1] == '-' ? long_parse(g, &w, a, e) : letters_parse(g, &w, e))) {
            return false;
        }
    }
    return true;
}

bool args_given(const struct args *g, const char *name) { return g->given[option_named(g, name)] > 0; }

const char *args_value(const struct args *g, const char *name)
{
    int i = option_named(g, name);
    return g->given[i] ? g->values[i][g->given[i] - 1] : NULL;
}

const char **args_values(const struct args *g, const char *name, int *n)
{
    int i = option_named(g, name);
    *n = g->given[i];
    return g->values[i];
}

bool args_number(const struct args *g, const char *name, const double range[2], double *value, struct err *e)
{
    const char *text = args_value(g, name);
    double x;
    if (!text) return true;
    if (!text_double(text, &x)) return err_set(e, ERR_USAGE, "--%s: '%s' is not a number", name, text);
    if (x < range[0] || x > range[1])
        return err_set(e, ERR_USAGE, "--%s: %s is not between %g and %g", name, text, range[0], range[1]);
    *value = x;
    return true;
}

bool args_whole(const struct args *g, const char *name, const long range[2], long *value, struct err *e)
{
    double x = (double)*value;
    if (!args_number(g, name, (const double[2]){(double)range[0], (double)range[1]}, &x, e)) return false;
    if (x != rint(x)) return err_set(e, ERR_USAGE, "--%s: '%s' is not a whole number", name, args_value(g, name));
    *value = (long)x;
    return true;
}

bool args_word(const struct args *g, const char *name, const char *const *words, int *chosen, struct err *e)
{
    const char *text = args_value(g, name);
    char all[200] = "";
    if (!text) return true;
    for (int k = 0; words[k]; k++) {
        if (!strcmp(words[k], text)) {
            *chosen = k;
            return true;
        }
        size_t n = strlen(all);
        snprintf(all + n, sizeof all - n, "%s%s", k == 0 ? "" : words[k + 1] ? ", " : " or ", words[k]);
    }
    return err_set(e, ERR_USAGE, "--%s: '%s' is not %s", name, text, all);
}
