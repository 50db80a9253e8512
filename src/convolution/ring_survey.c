/* Where a motion is looked at to find the error that interpolation makes along it.

   One cycle of the motion is cut into cells. A cell's movement is, mode by mode, that of its gain and of its pole over its decay,

       (|dA|^2/|A|^2 + |ds|^2 / (2 sigma^2)) |A|^2/sigma,   |A| not below a tenth of the mode's largest (near a zero A'/A means nothing),

   times the force's power, each mode's sum over the cycle set to 1. A cell is bent where the way passes from one pair (or triangle) of places to the
   next, or where velocity jumps by a tenth of its largest.

   Instants are drawn from a mixture of densities: even over the motion, by movement, even over the surroundings of bent cells, of the two ends. Each
   stands for 1/(number x density of the mixture there), so sums over them are integrals over time, whatever the mixture is; it only makes them
   converge. Draws are Kronecker's sequences (golden ratio; plastic number in two dimensions), the same in every run. */
#include "convolution/ring_survey.h"

#include <string.h>

#include "num/real.h"

/* Cycles: */
#define PLACED 400.0  /* a place of the contact           */
#define SHARED 8.0    /* a mode there, poles shared       */
#define SEPARATE 60.0 /* ... poles separate               */
#define CELL 500.0    /* a cell                           */
#define COUNTED 30.0  /* a mode in it                     */

enum { STRAIGHT = 1024, MOST = 8192, WORK = 500000, KINKS = 4 };

/* ------------------------------------------------------------------ looking */

struct looking {
    const struct ring_survey_ask *ask;
    struct ring_survey *s;
    int n;
    double *largest, *sum; /* [n] of |A|^2; of the movement */
    double *moved;         /* [cells][n] */
    double (*place)[2];    /* [cells + 1] */
};

static long cells_of(const struct ring_survey_ask *ask)
{
    long detail = ask->trajectory->straight ? STRAIGHT : ask->trajectory->detail, most = WORK / (ask->modes->n + 1);
    detail = detail < STRAIGHT ? STRAIGHT : detail > MOST ? MOST : detail;
    return detail > most ? (most < 64 ? 64 : most) : detail;
}

static double floor_of(const struct ring_survey *s)
{
    return 0.5 / fmax(s->duration, 1e-3);
}

/* Mode i from one row to the next. */
static void look_at(struct looking *k, long cell, const struct modes_point *p, const struct modes_point *q)
{
    double step = k->s->step;
    for (int i = 0; i < k->n; i++) {
        double sigma = fmax(0.5 * (p->decay[i] + q->decay[i]), floor_of(k->s)), dd = p->decay[i] - q->decay[i];
        double dw = 2 * REAL_PI * (q->frequency[i] - p->frequency[i]), dre = q->re[i] - p->re[i], dim = q->im[i] - p->im[i];
        double size = fmax(p->re[i] * p->re[i] + p->im[i] * p->im[i], 0.01 * k->largest[i]), *slope = k->s->slope;
        k->moved[cell * k->n + i] = k->s->loud[cell] * (dre * dre + dim * dim + size * (dd * dd + dw * dw) / (2 * sigma * sigma)) / sigma;
        k->sum[i] += k->moved[cell * k->n + i];
        if (slope) {
            double re = dd / step, im = dw / step, *turned = k->s->turned + 2 * (cell * k->n + i);
            slope[2 * (cell * k->n + i)] = re;
            slope[2 * (cell * k->n + i) + 1] = im;
            turned[2 * k->n] = turned[0] + (re * re - im * im) * step;
            turned[2 * k->n + 1] = turned[1] + 2 * re * im * step;
        }
    }
}

/* The same of poles that are the same everywhere. */
static void look_at_shared(struct looking *k, long cell, const struct modes_point *p, const struct modes_point *q)
{
    const double *decay = k->ask->modes->decay, floor = floor_of(k->s), loud = k->s->loud[cell];
    double *moved = k->moved + cell * k->n;
    for (int i = 0; i < k->n; i++) {
        double sigma = decay[i] > floor ? decay[i] : floor, dre = q->re[i] - p->re[i], dim = q->im[i] - p->im[i];
        moved[i] = loud * (dre * dre + dim * dim) / sigma;
        k->sum[i] += moved[i];
    }
}

static void look_places(struct looking *k)
{
    struct ring_survey *s = k->s;
    double sum = 0;
    for (long c = 0; c <= s->cells; c++)
        trajectory_continued(k->ask->trajectory, (double)c * s->step, k->place[c]);
    for (long c = 0; c < s->cells; c++) {
        double dx = k->place[c + 1][0] - k->place[c][0], dy = k->place[c + 1][1] - k->place[c][1];
        s->loud[c] = k->ask->by_speed ? dx * dx + dy * dy : 1;
        sum += s->loud[c];
    }
    for (long c = 0; c < s->cells; c++)
        s->loud[c] = sum > 0 ? s->loud[c] * (double)s->cells / sum : 1;
}

/* The cell's way, a little longer, so that a kink at its very end is seen. */
static bool bends(const struct looking *k, long c, double fastest)
{
    const struct modes *m = k->ask->modes;
    const double *p = k->place[c], *q = k->place[c + 1], way[2] = {q[0] - p[0], q[1] - p[1]};
    double u[KINKS];
    if (c > 0) {
        const double *o = k->place[c - 1], jump[2] = {way[0] - (p[0] - o[0]), way[1] - (p[1] - o[1])};
        if (jump[0] * jump[0] + jump[1] * jump[1] > 0.01 * fastest)
            return true;
    }
    return m->kinks && m->kinks(m, p, (double[2]){q[0] + 0.01 * way[0], q[1] + 0.01 * way[1]}, u, KINKS) > 0;
}

static void look_bends(struct looking *k)
{
    double fastest = 0;
    for (long c = 0; c < k->s->cells; c++) {
        double dx = k->place[c + 1][0] - k->place[c][0], dy = k->place[c + 1][1] - k->place[c][1];
        fastest = fmax(fastest, dx * dx + dy * dy);
    }
    for (long c = 0; c < k->s->cells; c++)
        k->s->bent[c + 1] = k->s->bent[c] + bends(k, c, fastest);
}

static void look_along(struct looking *k, struct arena *a)
{
    struct modes_point row[2] = {modes_point_make(a, k->n), modes_point_make(a, k->n)};
    struct ring_survey *s = k->s;
    for (long c = 0; c <= s->cells; c += 1 + s->cells / 64) {
        ring_along_at(&s->along, (double)c * s->step, &row[0]);
        for (int i = 0; i < k->n; i++)
            k->largest[i] = fmax(k->largest[i], row[0].re[i] * row[0].re[i] + row[0].im[i] * row[0].im[i]);
    }
    for (long c = 0; c <= s->cells; c++) {
        ring_along_at(&s->along, (double)c * s->step, &row[c % 2]);
        if (c > 0)
            (s->along.modes->shared && !s->slope ? look_at_shared : look_at)(k, c - 1, &row[(c - 1) % 2], &row[c % 2]);
    }
}

static void cumulate(struct looking *k)
{
    double *moved = k->s->moved, sum = 0;
    for (long c = 0; c < k->s->cells; c++) {
        moved[c] = sum;
        for (int i = 0; i < k->n; i++)
            sum += k->sum[i] > 0 ? k->moved[c * k->n + i] / k->sum[i] : 0;
    }
    moved[k->s->cells] = sum;
    for (long c = 0; c <= k->s->cells; c++)
        moved[c] = sum > 0 ? moved[c] / sum : (double)c / (double)k->s->cells;
}

void ring_survey(const struct ring_survey_ask *ask, struct arena *a, struct ring_survey *s)
{
    const struct trajectory *tr = ask->trajectory;
    struct arena *work = arena_open();
    int n = ask->modes->n;
    *s = (struct ring_survey){.along = ring_along_make(ask->modes, tr, ask->stays, a), .duration = tr->duration, .cells = cells_of(ask)};
    s->cycle = ask->modes->travels || !(tr->cycle > 0) || tr->cycle > tr->duration ? tr->duration : tr->cycle;
    s->step = s->cycle / (double)s->cells;
    s->loud = ARENA_TAKE(a, double, s->cells);
    s->moved = ARENA_TAKE(a, double, s->cells + 1);
    s->bent = ARENA_TAKE(a, int, s->cells + 1);
    s->slope = ask->slopes ? ARENA_TAKE(a, double, 2 * s->cells * n) : NULL;
    s->turned = ask->slopes ? ARENA_TAKE(a, double, 2 * (s->cells + 1) * n) : NULL;
    struct looking k = {ask, s, n, ARENA_TAKE(work, double, n), ARENA_TAKE(work, double, n), ARENA_TAKE(work, double, s->cells * n),
                        arena_take(work, (size_t)s->cells + 1, sizeof *k.place)};
    look_places(&k);
    look_bends(&k);
    look_along(&k, work);
    cumulate(&k);
    s->looked = ARENA_TAKE(a, double, 1);
    *s->looked = (double)s->cells * (CELL + ring_survey_point(s) + n * COUNTED);
    arena_close(work);
}

double ring_survey_point(const struct ring_survey *s)
{
    return PLACED + s->along.modes->n * (s->along.modes->shared ? SHARED : SEPARATE);
}

/* ------------------------------------------------------------------ drawing */

static long cell_at(const struct ring_survey *s, double t)
{
    double in = t - floor(t / s->cycle) * s->cycle;
    long c = (long)(in / s->step);
    return c < 0 ? 0 : c >= s->cells ? s->cells - 1 : c;
}

double ring_survey_loud(const struct ring_survey *s, double t)
{
    return t < 0 || t > s->duration ? 0 : s->loud[cell_at(s, t)];
}

/* How often the motion passes an instant of its cycle. */
static double repeats(const struct ring_survey *s, double t)
{
    return fmax(floor((s->duration - t) / s->cycle) + 1, 1);
}

/* Bent cells before cell c, counted on from cycle to cycle. */
static double bent_before(const struct ring_survey *s, double c)
{
    double all = ceil(s->duration / s->step - 1e-6), cells = (double)s->cells;
    c = c < 0 ? 0 : c > all ? all : c;
    double rounds = floor(c / cells);
    return rounds * s->bent[s->cells] + s->bent[(long)(c - rounds * cells)];
}

struct drawing {
    const struct ring_survey *s;
    double reach, bends; /* s; bent cells in all */
};

enum { EVEN, MOVED, BENT, ENDS };
static const int mixture[8] = {EVEN, MOVED, BENT, MOVED, EVEN, MOVED, BENT, ENDS};

static double density(const struct drawing *d, double t)
{
    const struct ring_survey *s = d->s;
    double p[4] = {0}, sum = 0, end = 0.25 / d->reach;
    if (t <= s->duration) {
        long c = cell_at(s, t);
        double in = t - floor(t / s->cycle) * s->cycle;
        p[EVEN] = 1 / s->duration;
        p[MOVED] = (s->moved[c + 1] - s->moved[c]) / s->step / repeats(s, in);
    }
    double near = bent_before(s, floor((t + d->reach) / s->step) + 1) - bent_before(s, floor((t - d->reach) / s->step));
    p[BENT] = d->bends > 0 ? near / d->bends / (s->step + 2 * d->reach) : p[EVEN];
    p[ENDS] = (t <= d->reach ? end : 0) + (t >= s->duration - d->reach ? end : 0);
    for (int k = 0; k < 8; k++)
        sum += p[mixture[k]] / 8;
    return sum;
}

static double share_of(int i, double ratio)
{
    double x = 0.5 + (i + 1) * ratio;
    return x - floor(x);
}

static double draw_moved(const struct ring_survey *s, double v, double w)
{
    long low = 0, high = s->cells;
    while (high - low > 1) {
        long middle = (low + high) / 2;
        *(s->moved[middle] <= v ? &low : &high) = middle;
    }
    double part = s->moved[high] - s->moved[low], t = s->step * ((double)low + (part > 0 ? (v - s->moved[low]) / part : 0.5));
    return t + s->cycle * floor(w * repeats(s, t));
}

static double draw_bent(const struct drawing *d, double v, double w)
{
    const struct ring_survey *s = d->s;
    double number = floor(v * d->bends), rounds = floor(number / s->bent[s->cells]), left = number - rounds * s->bent[s->cells];
    long low = 0, high = s->cells; /* bent[low] <= left < bent[high] */
    while (high - low > 1) {
        long middle = (low + high) / 2;
        *(s->bent[middle] <= left ? &low : &high) = middle;
    }
    return rounds * s->cycle + s->step * (double)low - d->reach + w * (s->step + 2 * d->reach);
}

static double draw(const struct drawing *d, int which, int i)
{
    const struct ring_survey *s = d->s;
    double golden = share_of(i, 0.6180339887498949), v = share_of(i, 0.7548776662466927), w = share_of(i, 0.5698402909980532);
    if (which == MOVED)
        return draw_moved(s, v, w);
    if (which == BENT && d->bends > 0)
        return draw_bent(d, v, w);
    if (which == ENDS)
        return (i % 2 ? s->duration : 0) + d->reach * (2 * golden - 1);
    return golden * s->duration;
}

int ring_survey_draw(const struct ring_survey *s, double reach, struct ring_survey_instant *at)
{
    struct drawing d = {s, fmax(reach, 1e-6), bent_before(s, HUGE_VAL)};
    double last = s->along.stays ? s->duration + d.reach : s->duration;
    int drawn[4] = {0}, n = 0;
    for (int k = 0; k < RING_SURVEY_INSTANTS; k++) {
        int which = mixture[k % 8] == BENT && d.bends == 0 ? EVEN : mixture[k % 8];
        double t = draw(&d, which, drawn[which]++);
        if (t >= 0 && t <= last)
            at[n++] = (struct ring_survey_instant){t, 1 / (RING_SURVEY_INSTANTS * density(&d, t))};
    }
    return n;
}
