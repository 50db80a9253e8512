/* How far a response that is interpolated along a motion is from the one that moves at every frame.

   A mode at the instant t of the motion is h(t, tau) = A(t) e^(s(t) tau); between nodes at t_k, multiples of the hop, it is taken as
   sum_k w_k(t) h(t_k, tau), w_k the polynomials through 1, 2 or 4 nodes (cardinal.h). A white force of power F makes sound and error of energy

       launch    int F(t) int |h|^2 dtau dt                 readout    int int F(t - tau) |h(t, tau)|^2 dtau dt

   with h, and with what its interpolation misses: a sum of 1 + order exponentials, whose integral over tau decaying.h has in closed form. t runs over
   instants of the motion as drawn (ring_survey.h), at whole frames and between the very nodes that will be used. Nothing is expanded: poles,
   gains, kinks, modes that fade, motions of any kind, hops of any length.

   Gains that are ramped (`fixed`) are `launch` of order 2. Discrete poles p = e^(s/rate) that are ramped over n frames (H s) are off by
   p''(t) u (1 - u) H^2/2 inside; over time that adds up in the exponent of what rings to

       E(t) - E(m) = (H^2/12) (1 - 1/n^2) (s'(t) - s'(m) + (1/rate) int_m^t s'^2 dt)

   (Euler and Maclaurin: the trapezium rule against the integral; kinks of s are jumps of s' and count; the second part is the chord that lies inside the
   unit circle): what was launched at m errs by A(m) e^(...) (a + E(t) - E(m)), a what interpolation misses of A. This one is to leading order in H.

   What `launch` makes at t is heard until the sound's end, or until the response that is computed ends: there tau ends, and decays are the modes' own, however
   long after the motion that is. Where neither end is known, and in the other kinds, decays below half a one over the motion's duration count as that: what
   hardly decays is heard no longer than that. */
#include "convolution/ring_error.h"

#include <math.h>
#include <string.h>

#include "convolution/decaying.h"
#include "num/real.h"

enum { MOST = 4 };

/* Cycles of a mode at an instant, by kind; more where it is heard until an end. */
static const double cycles[] = {[RING_ERROR_LAUNCH] = 450, [RING_ERROR_READOUT] = 1000, [RING_ERROR_RAMP] = 200, [RING_ERROR_GLIDE] = 1500};
#define ENDED 1200.0
#define ALIKE 15.0 /* where poles are the same everywhere */

#define HEARD 16.0 /* 2 decay t; of x^8 e^(-x), as interpolation of order 4 errs, 2 % lie beyond */

struct erring {
    const struct ring_survey *s;
    const struct ring_error_ask *ask;
    struct modes_point row[MOST + 1]; /* nodes, then the exact one */
    double weight[MOST];              /* of the nodes */
    struct decaying_points all, part; /* to the end of what rings; to `until` */
    double least;                     /* 1/s, decays count as no less */
    double t;                         /* s */
    bool exact;                       /* the instant is a node */
    long ended;                       /* modes and instants that an end was found for */
};

/* ------------------------------------------------------------------ an instant's nodes */

static void share_nodes(int order, double u, double *w)
{
    const double v = 1 - u;
    if (order == 1) {
        w[0] = 1;
    } else if (order == 2) {
        w[0] = v;
        w[1] = u;
    } else {
        w[0] = -u * v * (1 + v) / 6;
        w[1] = (1 + u) * v * (1 + v) / 2;
        w[2] = u * (1 + u) * (1 + v) / 2;
        w[3] = -u * v * (1 + u) / 6;
    }
}

static void stand_at(struct erring *r, double t)
{
    const struct ring_error_ask *k = r->ask;
    double early = k->kind == RING_ERROR_RAMP || k->kind == RING_ERROR_GLIDE ? 1 : 0, frame = rint(t * k->rate), hop = k->hop;
    double node = k->order == 1 ? floor((frame + 0.5 * hop) / hop) : floor((frame + early) / hop), u = (frame + early) / hop - node;
    r->t = frame / k->rate;
    r->exact = u == 0;
    ring_along_at(&r->s->along, r->t, &r->row[k->order]);
    if (r->exact)
        return;
    share_nodes(k->order, u, r->weight);
    for (int j = 0; j < k->order; j++)
        ring_along_at(&r->s->along, ((node + j - (k->order == 4)) * hop - early) / k->rate, &r->row[j]);
}

static struct decaying term(const struct erring *r, int k, int i)
{
    const struct modes_point *p = &r->row[k];
    double w = k < r->ask->order ? r->weight[k] : -1;
    return (struct decaying){w * p->re[i], w * p->im[i], fmax(p->decay[i], r->least), 2 * REAL_PI * p->frequency[i]};
}

/* ------------------------------------------------------------------ an instant's energies */

struct energies {
    double wrong, whole;
};

static const struct decaying_points *points_of(struct erring *r, double decay)
{
    double range = 2 * decay * r->ask->until;
    if (range >= DECAYING_RANGE)
        return &r->all;
    decaying_points_make(range, &r->part);
    return &r->part;
}

/* Force before t, as loud as it was, or as long ago as the response reaches. */
static struct energies weighted(struct erring *r, int i)
{
    struct decaying x[MOST + 1];
    double loud[DECAYING_POINTS];
    struct energies e;
    int n = 0;
    for (int k = r->exact ? r->ask->order : 0; k <= r->ask->order; k++)
        x[n++] = term(r, k, i);
    const struct decaying_points *p = points_of(r, x[n - 1].decay);
    for (int k = 0; k < DECAYING_POINTS; k++)
        loud[k] = ring_survey_loud(r->s, r->ask->kind == RING_ERROR_READOUT ? r->t - p->x[k] / (2 * x[n - 1].decay) : r->t);
    e.wrong = decaying_energy_weighted(x, n, p, loud, &e.whole);
    if (r->exact)
        e.wrong = 0;
    return e;
}

static double least_decay(const struct decaying *x, int n)
{
    double least = x[0].decay;
    for (int k = 1; k < n; k++)
        least = fmin(least, x[k].decay);
    return least;
}

static struct energies launched(struct erring *r, int i)
{
    struct decaying x[MOST + 1];
    int order = r->ask->order, first = r->exact ? order : 0, n = order + 1 - first;
    double loud = ring_survey_loud(r->s, r->t), end = fmax(fmin(r->ask->until, r->ask->end - r->t), 0);
    bool known = end < HUGE_VAL;
    struct energies e;
    for (int k = first; k <= order; k++) {
        x[k] = term(r, k, i);
        x[k].decay = known ? r->row[k].decay[i] : x[k].decay;
    }
    if (known && 2 * least_decay(x + first, n) * end < HEARD) {
        e.wrong = decaying_energy_until(x + first, n, end, &e.whole);
        r->ended++;
    } else {
        e.whole = decaying_energy(&x[order], 1);
        e.wrong = n > 1 ? decaying_energy(x, n) : 0;
    }
    return (struct energies){n > 1 ? loud * e.wrong : 0, loud * e.whole};
}

/* The same where poles are the same everywhere: what interpolation misses is one exponential, and its energy that of its amplitude. What decaying_energy
   gives for poles that are equal. */
static void launched_shared(struct erring *r, double by, double *wrong, double *whole)
{
    int order = r->ask->order, n = r->s->along.modes->n;
    const struct modes_point *last = &r->row[order];
    double loud = ring_survey_loud(r->s, r->t);
    for (int i = 0; i < n; i++) {
        if (r->ask->skip && r->ask->skip[i])
            continue;
        double re = 0, im = 0, per = 2 * fmax(last->decay[i], r->least);
        for (int k = 0; k < order && !r->exact; k++) {
            re += r->weight[k] * r->row[k].re[i];
            im += r->weight[k] * r->row[k].im[i];
        }
        re -= last->re[i];
        im -= last->im[i];
        wrong[i] += r->exact ? 0 : by * (loud * ((re * re + im * im) / per));
        whole[i] += by * (loud * ((last->re[i] * last->re[i] + last->im[i] * last->im[i]) / per));
    }
}

/* ds/dt and its square's integral since the motion's start, at t; at rest after the end. */
struct drift {
    double re, im, square_re, square_im;
};

static struct drift drift_at(const struct ring_survey *s, int i, double t)
{
    double end = fmin(fmax(t, 0), s->duration), rounds = floor(end / s->cycle), in = fmax(end - rounds * s->cycle, 0) / s->step;
    long n = s->along.modes->n, c = (long)in < s->cells ? (long)in : s->cells - 1;
    const double *slope = s->slope + 2 * (c * n + i), *from = s->turned + 2 * (c * n + i), *to = from + 2 * n;
    const double *all = s->turned + 2 * (s->cells * n + i), u = in - (double)c;
    bool moves = t <= s->duration;
    return (struct drift){moves ? slope[0] : 0, moves ? slope[1] : 0, rounds * all[0] + from[0] + u * (to[0] - from[0]),
                          rounds * all[1] + from[1] + u * (to[1] - from[1])};
}

static struct energies glided(struct erring *r, int i)
{
    const struct modes_point *p = &r->row[2];
    struct decaying last = {p->re[i], p->im[i], fmax(p->decay[i], r->least), 0};
    struct drift from = drift_at(r->s, i, r->t);
    double miss[2] = {-p->re[i], -p->im[i]}, square[DECAYING_POINTS], n = r->ask->hop, H = n / r->ask->rate;
    double by = H * H / 12 * (1 - 1 / (n * n)), loud = ring_survey_loud(r->s, r->t);
    struct energies e;
    for (int k = 0; k < 2; k++) {
        miss[0] = r->exact ? 0 : miss[0] + r->weight[k] * r->row[k].re[i];
        miss[1] = r->exact ? 0 : miss[1] + r->weight[k] * r->row[k].im[i];
    }
    for (int k = 0; k < DECAYING_POINTS; k++) {
        struct drift to = drift_at(r->s, i, r->t + r->all.x[k] / (2 * last.decay));
        double re = by * (to.re - from.re + (to.square_re - from.square_re) / r->ask->rate);
        double im = by * (to.im - from.im + (to.square_im - from.square_im) / r->ask->rate);
        double x = miss[0] + p->re[i] * re - p->im[i] * im, y = miss[1] + p->re[i] * im + p->im[i] * re;
        square[k] = loud * (x * x + y * y);
    }
    decaying_energy_weighted(&(struct decaying){1, 0, last.decay, 0}, 1, &r->all, square, &e.wrong);
    for (int k = 0; k < DECAYING_POINTS; k++)
        square[k] = loud;
    decaying_energy_weighted(&last, 1, &r->all, square, &e.whole);
    return e;
}

/* ------------------------------------------------------------------ all */

void ring_error(const struct ring_survey *s, const struct ring_error_ask *ask, double *wrong, double *whole)
{
    static struct energies (*const of[])(struct erring *, int) = {launched, weighted, launched, glided};
    struct arena *a = arena_open();
    struct ring_survey_instant *at = ARENA_TAKE(a, struct ring_survey_instant, RING_SURVEY_INSTANTS);
    struct erring r = {.s = s, .ask = ask, .least = 0.5 / fmax(s->duration, 1e-3)};
    int n = s->along.modes->n, wanted = 0, instants = ring_survey_draw(s, fmax(0.5 * ask->order, 1) * ask->hop / ask->rate, at);
    decaying_points_make(DECAYING_RANGE, &r.all);
    for (int k = 0; k <= ask->order; k++)
        r.row[k] = modes_point_make(a, n);
    for (int i = 0; i < n; i++)
        if (!ask->skip || !ask->skip[i]) {
            wrong[i] = whole[i] = 0;
            wanted++;
        }
    bool shared = s->along.modes->shared && !(ask->until < HUGE_VAL) && !(ask->end < HUGE_VAL) && (ask->kind == RING_ERROR_LAUNCH || ask->kind == RING_ERROR_RAMP);
    for (int k = 0; k < instants; k++) {
        stand_at(&r, at[k].t);
        if (shared) {
            launched_shared(&r, at[k].weight, wrong, whole);
            continue;
        }
        for (int i = 0; i < n; i++)
            if (!ask->skip || !ask->skip[i]) {
                struct energies e = of[ask->kind](&r, i);
                wrong[i] += at[k].weight * e.wrong;
                whole[i] += at[k].weight * e.whole;
            }
    }
    *s->looked += instants * ((ask->order + 1) * ring_survey_point(s) + wanted * (shared ? ALIKE : cycles[ask->kind])) + (double)r.ended * ENDED;
    arena_close(a);
}

double ring_error_all(const struct ring_survey *s, const struct ring_error_ask *ask)
{
    struct arena *a = arena_open();
    int n = s->along.modes->n;
    double *wrong = ARENA_TAKE(a, double, n), *whole = ARENA_TAKE(a, double, n), sum = 0, all = 0;
    ring_error(s, ask, wrong, whole);
    for (int i = 0; i < n; i++) {
        sum += wrong[i];
        all += whole[i];
    }
    arena_close(a);
    return all > 0 ? sqrt(sum / all) : 0;
}
