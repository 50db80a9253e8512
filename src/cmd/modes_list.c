/* rasp modes list FILE: the strongest modes of a mode table, or of what a recipe or scene has, one a line.

   Strength is energy summed over the places, sum gain^2/(4 decay) (as where a render keeps the strongest); shown are
   the mode's pole and gain where its gain is largest. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cmd/modes.h"
#include "cmd/tell.h"
#include "num/real.h"
#include "response/mode_table.h"
#include "response/space.h"

static const char *const quantities[] = {
    [MODES_DISPLACEMENT] = "m/(N s)", [MODES_VELOCITY] = "m/s/(N s)", [MODES_ACCELERATION] = "m/s^2/(N s)"};

struct line {
    double energy, frequency, decay, gain, x, y;
};

struct list {
    struct cmd_call *c;
    struct line *line;
    int n, places, quantity;
    bool moves; /* places mean something */
};

static void start(struct list *l, int n, int quantity)
{
    l->n = n;
    l->quantity = quantity;
    l->line = ARENA_TAKE(l->c->arena, struct line, n);
    for (int i = 0; i < n; i++)
        l->line[i].gain = -1.0;
}

static void count(struct line *at, const struct line *one)
{
    double energy = at->energy + (one->gain != 0.0 ? one->gain * one->gain / (4.0 * one->decay) : 0.0);
    if (one->gain > at->gain) *at = *one;
    at->energy = energy;
}

/* A mode of several slopes counts with each. */
static void count_entry(struct list *l, const struct mode_table *t, const struct mode_entry *v)
{
    for (int k = 0; k < v->n; k++)
        count(&l->line[v->mode], &(struct line){0, v->frequency, v->slope[k].decay, fabs(v->slope[k].gain),
                                                t->xy[2 * v->place], t->xy[2 * v->place + 1]});
}

static bool from_table(struct list *l, const char *file, struct err *e)
{
    struct mode_table t;
    if (!mode_table_read(file, l->c->arena, &t, e)) return false;
    start(l, (int)t.modes, t.quantity);
    l->places = (int)t.places;
    l->moves = t.places > 1;
    for (size_t k = 0; k < t.first[t.places]; k++)
        count_entry(l, &t, &t.entry[k]);
    if (t.note) tell_remark(l->c, "modes", t.note);
    return true;
}

/* At one place and share of the way. */
static void count_modes(struct list *l, const struct modes *m, const struct modes_where *where)
{
    struct modes_point p = modes_point_make(l->c->arena, m->n);
    modes_at(m, where, &p);
    for (int i = 0; i < m->n; i++)
        count(&l->line[i],
              &(struct line){0, m->shared ? m->frequency[i] : p.frequency[i], m->shared ? m->decay[i] : p.decay[i],
                             sqrt(p.re[i] * p.re[i] + p.im[i] * p.im[i]), where->x, where->y});
}

static bool from_object(struct list *l, const struct modes_body *b, struct err *e)
{
    struct object o;
    struct modes m;
    struct modes_places places;
    const double *origin = b->response->object.origin;
    const char *note;
    if (!modes_body_object(l->c, b, &o, &note, e) || !modes_body_places(l->c, b, &o, NULL, &places, e)) return false;
    if (note) tell_remark(l->c, "modes", note);
    object_modes(&o, origin, NULL, o.n, l->c->arena, &m);
    start(l, m.n, m.quantity);
    l->places = places.n;
    l->moves = places.n > 1;
    for (int i = 0; i < places.n; i++)
        count_modes(l, &m, &(struct modes_where){.x = places.xy[i][0] + origin[0], .y = places.xy[i][1] + origin[1]});
    return true;
}

static bool from_space(struct list *l, const struct modes_body *b, struct err *e)
{
    struct modes m;
    struct modes_ask ask = {.strongest = b->response->modes,
                            .band = {b->response->band[0], b->response->band[1]},
                            .rate = b->scene.output.sample_rate};
    if (!space_modes(&b->response->space, &ask, l->c->arena, &m, e)) return false;
    start(l, m.n, m.quantity);
    l->places = 1;
    count_modes(l, &m, &(struct modes_where){0});
    return true;
}

static bool ends_in_csv(const char *file)
{
    size_t n = strlen(file);
    return n > 4 && !strcmp(file + n - 4, ".csv");
}

static bool gather(struct list *l, struct err *e)
{
    const char *file = l->c->args.operands[0];
    struct modes_body b;
    if (ends_in_csv(file)) return from_table(l, file, e);
    if (!modes_body_read(l->c, file, &b, e)) return false;
    if (b.response->object.given) return from_object(l, &b, e);
    if (b.response->space.given) return from_space(l, &b, e);
    if (b.response->file && ends_in_csv(b.response->file)) return from_table(l, b.response->file, e);
    return err_set(e, ERR_SCENE,
                   b.response->file ? "%s: %s.response is recorded (%s), and has no modes"
                                    : "%s: its %s has no response%s",
                   file, b.key, b.response->file ? b.response->file : "");
}

static int strongest_first(const void *a, const void *b)
{
    const struct line *p = a, *q = b;
    if (p->energy != q->energy) return p->energy > q->energy ? -1 : 1;
    return (p->frequency > q->frequency) - (p->frequency < q->frequency);
}

static void print(const struct list *l, int shown)
{
    printf("%d mode%s at %d place%s", l->n, l->n == 1 ? "" : "s", l->places, l->places == 1 ? "" : "s");
    printf(shown < l->n ? "; the %d strongest\n" : "\n", shown);
    printf("%14s %12s %14s%s\n", "frequency_hz", "t60_s", "largest_gain", l->moves ? "          x_m          y_m" : "");
    for (int i = 0; i < shown; i++) {
        const struct line *v = &l->line[i];
        printf("%14.6g %12.4g %14.5g", v->frequency, 3.0 * real_log(10.0) / v->decay, v->gain);
        if (l->moves) printf(" %12.6g %12.6g", v->x, v->y);
        putchar('\n');
    }
    printf("gains in %s\n", quantities[l->quantity]);
}

int modes_list_run(struct cmd_call *c, struct err *e)
{
    static const long counts[2] = {1, 100000};
    struct list l = {.c = c};
    long shown = 20;
    if (!args_whole(&c->args, "modes", counts, &shown, e) || !gather(&l, e)) return (int)e->kind;
    qsort(l.line, (size_t)l.n, sizeof *l.line, strongest_first);
    print(&l, shown < l.n ? (int)shown : l.n);
    return 0;
}
