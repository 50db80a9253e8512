/* The interpolation error of a mode table.

   Complex gains A_i of all modes i at the places x_q of a test, and what the table's places give there by the rules of
   a scene (response/morph.c):

       error^2 = sum_q sum_i |A_i'(x_q) - A_i(x_q)|^2 / sum_q sum_i |A_i(x_q)|^2.

   The test's places are the same in every run: SPOTS of them, by Kronecker's sequence, on the line or over the box of
   the places; those beside the object or beyond the hull of the table's places are left out.

   As many places as needed: from 5 lines each way that axis gets a quarter more lines, two at least, that brings the
   most decibels for the logarithm of the number of places (or both do; and both get them where no step brings STUCK), until the goal is met; then lines are taken
   away two by two as long as it is. The numbers are odd: what is symmetric has a place in its middle. */
#include "cmd/modes_fit.h"

#include <math.h>

#include "cmd/tell.h"
#include "num/real.h"
#include "response/morph_points.h"

enum { SPOTS = 512 };
#define STUCK 1.0 /* dB */

static double share(int i, double ratio)
{
    double x = 0.5 + (i + 1) * ratio;
    return x - floor(x);
}

/* Where the test is made, and the gains there, re and im after each other. */
static void make_test(struct modes_fit *f, const struct modes_places *p)
{
    struct modes_point at = modes_point_make(f->arena, f->n);
    f->test = ARENA_TAKE(f->arena, double, 2 * (size_t)SPOTS * (size_t)f->n);
    f->spot = arena_take(f->arena, SPOTS, sizeof *f->spot);
    for (int q = 0; q < SPOTS; q++) {
        double u = share(q, p->line ? 0.6180339887498949 : 0.7548776662466927),
               v = p->line ? u : share(q, 0.5698402909980532);
        double x = p->from[0] + u * (p->to[0] - p->from[0]), y = p->from[1] + v * (p->to[1] - p->from[1]);
        if (!(f->at(f->self, x, y, &at) <= 1e-9))
            continue;
        f->spot[f->spots][0] = x;
        f->spot[f->spots][1] = y;
        double *to = f->test + 2 * (size_t)f->spots++ * (size_t)f->n;
        for (int i = 0; i < f->n; i++) {
            to[i] = at.re[i];
            to[f->n + i] = at.im[i];
        }
    }
}

static double compare(const struct modes_fit *f, const struct modes *m, struct arena *a)
{
    struct modes_point at = modes_point_make(a, f->n);
    double wrong = 0, whole = 0;
    for (int q = 0; q < f->spots; q++) {
        const double *re = f->test + 2 * (size_t)q * (size_t)f->n, *im = re + f->n;
        if (modes_at(m, &(struct modes_where){.x = f->spot[q][0], .y = f->spot[q][1]}, &at) > 0)
            continue;
        for (int i = 0; i < f->n; i++) {
            double x = at.re[i] - re[i], y = at.im[i] - im[i];
            wrong += x * x + y * y;
            whole += re[i] * re[i] + im[i] * im[i];
        }
    }
    return whole > 0 ? 10 * real_log10(fmax(wrong / whole, 1e-30)) : NAN;
}

double modes_fit_error(struct modes_fit *f, const struct modes_places *p)
{
    struct arena *a = arena_open();
    struct modes_point *at = ARENA_TAKE(a, struct modes_point, p->n);
    struct modes m;
    struct err e = {0};
    double db = NAN;
    if (!f->test)
        make_test(f, p);
    for (int k = 0; k < p->n; k++) {
        at[k] = modes_point_make(a, f->n);
        f->at(f->self, p->xy[k][0], p->xy[k][1], &at[k]);
    }
    if (p->n > 1 &&
        morph_points(&(struct morph_points_ask){f->n, p->n, (const double(*)[2])p->xy, at, f->shared}, a, &m, &e))
        db = compare(f, &m, a);
    arena_close(a);
    return db;
}

static const char *told(double db, struct arena *a)
{
    return db < -200 ? "less than -200 dB" : arena_format(a, "%.1f dB", db);
}

void modes_fit_write(FILE *f, double db, const struct modes_places *p, struct arena *a)
{
    if (p->ring[1] > 0)
        fprintf(f, "# rings: places at radii from %.9g to %.9g m, where the surface has no edge\n", p->ring[0], p->ring[1]);
    if (isnan(db))
        return;
    fprintf(f,
            "# interpolation_error: %s, rms of the differences of all modes' gains at %d places %s, relative to the "
            "gains\n",
            told(db, a), SPOTS, p->line ? "along the line" : "over the box of these, those beside left out");
}

void modes_fit_report(double db, struct arena *a)
{
    if (!isnan(db))
        printf("; between them gains are off by %s", told(db, a));
}

void modes_fit_warn(struct cmd_call *c, double db, const struct modes_places *p)
{
    if (p->chosen && db > MODES_FIT_GOAL && !args_given(&c->args, "quiet"))
        tell_remark(c, "modes",
                    arena_format(c->arena,
                                 "between the places gains are off by %s, and %g dB would take more than %d places or "
                                 "%d rows; fewer modes (--modes, --top) need fewer",
                                 told(db, c->arena), MODES_FIT_GOAL, MODES_FIT_PLACES, MODES_FIT_ROWS));
}

/* ------------------------------------------------------------------ as many as needed */

struct growing {
    struct modes_fit *fit;
    modes_fit_lay *lay;
    const void *self;
    long most;
};

static double error_of(const struct growing *g, const int n[2], int *places)
{
    struct arena *a = arena_open();
    struct modes_places p = {0};
    g->lay(g->self, n, a, &p);
    double db = p.n > g->most ? NAN : p.n > 1 ? modes_fit_error(g->fit, &p) : 0;
    *places = p.n;
    arena_close(a);
    return db;
}

static int more(int n)
{
    return n + 2 * (n / 8 > 1 ? n / 8 : 1);
}

struct step {
    int n[2], places;
    double db;
};

/* One step; false: there is no room for any. */
static bool grow(const struct growing *g, int axes, struct step *now)
{
    struct step best = {.places = 0}, try = *now;
    double most = -HUGE_VAL;
    for (int which = 1; which < 1 << axes; which++) {
        try.n[0] = which & 1 ? more(now->n[0]) : now->n[0];
        try.n[1] = which & 2 ? more(now->n[1]) : now->n[1];
        try.db = error_of(g, try.n, &try.places);
        double brings = (now->db - try.db) / real_log((double)try.places / now->places);
        if (try.places > g->most || isnan(brings) || brings < most)
            continue;
        most = brings;
        best = try;
    }
    if (best.places > 0 && best.db > now->db - STUCK && try.places <= g->most && !isnan(try.db))
        best = try; /* the last, all axes */
    if (best.places > 0)
        *now = best;
    return best.places > 0;
}

static void shrink(const struct growing *g, int axis, int n[2])
{
    while (n[axis] > 5) {
        int of, less[2] = {n[0] - 2 * (axis == 0), n[1] - 2 * (axis == 1)};
        if (!(error_of(g, less, &of) <= MODES_FIT_GOAL))
            return;
        n[axis] = less[axis];
    }
}

void modes_fit_places(struct modes_fit *f, modes_fit_lay *lay, const void *self, bool line, struct modes_places *p)
{
    long rows = MODES_FIT_ROWS / f->n;
    struct growing g = {f, lay, self, rows < 153 ? 153 : rows > MODES_FIT_PLACES ? MODES_FIT_PLACES : rows};
    struct step now = {.n = {5, line ? 1 : 5}};
    int axes = line ? 1 : 2;
    now.db = error_of(&g, now.n, &now.places);
    while (now.db > MODES_FIT_GOAL && grow(&g, axes, &now))
        ;
    for (int axis = axes; axis-- > 0 && now.db <= MODES_FIT_GOAL;)
        shrink(&g, axis, now.n);
    lay(self, now.n, f->arena, p);
    p->chosen = true;
}
