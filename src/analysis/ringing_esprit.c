/* Sub-band ESPRIT in rounds. Each round takes what the fit so far has left of the response, splits it into bands (ringing_band.c), finds the poles of each band's central half
   (ringing_poles.c), adds them to the fit, polishes all (ringing_fit.c) and drops what is no more than noise (ringing_select.c). The first rounds have the finest bands and
   the whole length: close and long modes; then bands twice as wide over half of the length, and so on to the undecimated beginning: a mode that decays in a few milliseconds is lost
   in the noise of a long window, and never passes a narrow filter. */
#include <math.h>
#include <string.h>

#include "analysis/ringing_apart.h"
#include "analysis/ringing_band.h"
#include "analysis/ringing_blocks.h"
#include "analysis/ringing_fit.h"
#include "analysis/ringing_poles.h"
#include "analysis/ringing_report.h"
#include "analysis/ringing_select.h"
#include "analysis/ringing_slopes.h"
#include "num/real.h"

enum {
    FINEST = 1024,     /* decimation */
    OUTPUTS = 300,     /* of the first round, at least */
    FOLLOWING = 200,   /* of the others */
    AGAIN = 3,         /* times each decimation, while something is found */
    STEPS = 60,        /* sweeps of a round: without noise, what is not settled would be taken for modes */
    SETTLE = 2        /* ... of the end */
};

#define REACH 1e-7     /* energy of a band's singular vector over the strongest band's: what is weaker waits until that is taken off, its alias is 80 dB down */
#define ABOVE 10.0     /* energy of it over rounding's */
#define MARGIN 0.05    /* of the half bands, which overlap by it */
#define FALLS 1e-5     /* share of the residual's energy by which a round's steps still matter */
#define STILL 1e-3     /* squared deviations by which all poles of a part together may be off in the end */
#define ALMOST 1e-6    /* test of the rounds; the last is the one that is asked for */

struct candidate {
    double decay, omega;
    int band;
};

struct search {
    const struct ringing *r;
    const struct ringing_options *o;
    struct ringing_fit fit;
    struct ringing_noise noise;
    double low, high;      /* rad/s */
    int finest;            /* decimation of the first round */
    int gone;              /* components that the test took out */
};

static void search_open(struct search *s, const struct ringing *r, const struct ringing_options *o, struct arena *a)
{
    *s = (struct search){.r = r, .o = o};
    long room = r->n / 8, wanted = 8L * o->most + 200;
    ringing_fit_open(&s->fit, r, (int)(room < wanted ? room : wanted), a);
    ringing_noise_open(r, a, &s->noise);
    double low = fmax(o->low, r->low), high = r->high > 0 ? r->high : r->rate / 2;
    if (o->high > 0)
        high = fmin(high, o->high);
    s->low = 2 * REAL_PI * fmax(0.9 * low, 0.25 * r->rate / (double)r->n);
    s->high = 2 * REAL_PI * fmin(1.1 * high, 0.49999 * r->rate);
}

static double band_energy(const struct ringing_band *b, int c)
{
    double sum = 0;
    const double complex *y = b->y + (long)c * b->places * b->n;
    for (long i = 0; i < b->places * b->n; i++)
        sum += creal(y[i]) * creal(y[i]) + cimag(y[i]) * cimag(y[i]);
    return sum;
}

/* A pole that grows by little, as noise makes it, begins as one that decays by little. */
static bool candidate_make(const struct search *s, const struct ringing_band *b, double complex zeta, struct candidate *c)
{
    double pole[2], length = (double)(b->n * b->decimation) / s->r->rate;
    double size = creal(zeta) * creal(zeta) + cimag(zeta) * cimag(zeta);
    if (!ringing_band_pole(b, c->band, s->r->rate, zeta, MARGIN, pole) || size < 0.01)
        return false;
    *c = (struct candidate){pole[0], pole[1], c->band};
    if (c->decay < 0.1 / length)
        c->decay = c->decay * length > -3 ? 0.1 / length : -1;
    return c->decay > 0 && c->decay < RINGING_FIT_FASTEST * s->r->rate && c->omega > s->low && c->omega < s->high;
}

/* Found in two bands. */
static bool known(const struct search *s, const struct candidate *list, int n, const struct candidate *c)
{
    double all = (double)s->r->n / s->r->rate;
    for (int i = n - 1; i >= 0 && list[i].band >= c->band - 1; i--) {
        double wide = 0.1 * (list[i].decay + c->decay) + 0.3 / all, x = list[i].decay - c->decay, y = list[i].omega - c->omega;
        if (list[i].band != c->band && x * x + y * y < wide * wide)
            return true;
    }
    return false;
}

static int band_search(const struct search *s, const struct ringing_band *b, double least, struct candidate *list, int n, int most)
{
    struct arena *a = arena_open();
    struct ringing_poles p;
    struct candidate c = {.band = list[n].band};
    ringing_poles_decompose(b->y + (long)c.band * b->places * b->n, b->places, b->n, a, &p);
    int order = ringing_poles_order(&p, least);
    double complex *zeta = ARENA_TAKE(a, double complex, order + 1);
    order = ringing_poles_make(&p, order, a, zeta);
    for (int i = 0; i < order && n < most; i++) {
        int band = c.band;
        if (candidate_make(s, b, zeta[i], &c) && !known(s, list, n, &c))
            list[n++] = c;
        c.band = band;
    }
    arena_close(a);
    return n;
}

static int own_count(const struct ringing_fit *part, bool fresh)
{
    int n = 0;
    for (int i = 1; i < part->m; i++)
        n += part->fresh[i] == fresh && !part->guest[i];
    return n;
}

/* What is no more than noise goes; whether anything that came stays, or anything that was there goes. */
static bool part_drop(struct ringing_fit *part, void *context)
{
    const struct search *s = context;
    int before = own_count(part, false);
    ringing_select_drop(part, &s->noise, &(struct ringing_select){ALMOST, 1});
    return own_count(part, true) > 0 || own_count(part, false) < before;
}

static bool part_step(struct ringing_fit *part, void *context)
{
    (void)context;
    double before = 0, after = 0;
    for (int p = 0; p < part->r->places; p++)
        before += part->energy[p];
    ringing_fit_polish(part, 4);
    for (int p = 0; p < part->r->places; p++)
        after += part->energy[p];
    return after < (1 - FALLS) * before;
}

/* One round: how many components it has added. What is in blocks with theirs is fresh after it. */
static int round_run(struct search *s, int decimation, long length)
{
    struct arena *a = arena_open();
    struct ringing_band b;
    const double **x = ARENA_TAKE(a, const double *, s->r->places);
    int n = 0, before = s->fit.m, most = s->fit.most - s->fit.m;
    memset(s->fit.fresh, 0, sizeof(bool) * (size_t)s->fit.m);
    struct candidate *list = ARENA_TAKE(a, struct candidate, most + 1);
    double greatest = 0, rounding = 0;
    for (int p = 0; p < s->r->places; p++) {
        x[p] = s->fit.residual + p * s->r->n;
        rounding += s->noise.least[p];
    }
    ringing_band_make(x, s->r->places, length, decimation, a, &b);
    for (int c = 0; c < b.bands; c++)
        greatest = fmax(greatest, band_energy(&b, c));
    for (int c = 0; c < b.bands && greatest > 0; c++) {
        double centre = REAL_PI * c * s->r->rate / decimation, half = REAL_PI * s->r->rate / decimation;
        list[n].band = c;
        if (centre + half >= s->low && centre - half <= s->high && n < most)
            n = band_search(s, &b, fmax(REACH * greatest * (double)(b.n / 3), ABOVE * rounding * (double)b.n), list, n, most);
    }
    for (int i = 0; i < n; i++)
        ringing_fit_add(&s->fit, list[i].decay, list[i].omega);
    arena_close(a);
    if (n == 0)
        return 0;
    ringing_blocks_gains(&s->fit);
    ringing_blocks_run(&s->fit, 1, part_drop, s);
    ringing_blocks_settle(&s->fit, STEPS, part_step, s);
    ringing_blocks_run(&s->fit, 1, part_drop, s);
    return s->fit.m - before;
}

static void rounds_run(struct search *s)
{
    int decimation = FINEST;
    while (decimation > 1 && s->r->n / decimation < OUTPUTS)
        decimation /= 2;
    s->finest = decimation;
    for (bool first = true; decimation >= 1; decimation /= 2, first = false) {
        long length = first ? s->r->n : (long)FOLLOWING * decimation;
        length = length < s->r->n ? length : s->r->n;
        for (int i = 0; i < AGAIN && round_run(s, decimation, length) > 0; i++) {
        }
    }
}

static bool part_polish(struct ringing_fit *part, void *context)
{
    (void)context;
    return ringing_fit_polish(part, 5) > STILL;
}

/* The test that was asked for. */
static bool part_judge(struct ringing_fit *part, void *context)
{
    struct search *s = context;
    struct ringing_select strict = {s->o->confidence / (double)s->r->n, 1};
    int gone = 0;
    bool moved = ringing_fit_polish(part, 5) > STILL;
    for (int now = 1; now > 0; gone += now) {
        now = ringing_select_drop(part, &s->noise, &strict);
        if (now > 0)
            ringing_fit_polish(part, 5);
        now += ringing_apart(part, &s->noise, s->o->confidence);
    }
    s->gone += gone;
    return moved || gone > 0;
}

/* What the test takes out may have hidden something. */
static void finish(struct search *s)
{
    ringing_blocks_renew(&s->fit);
    if (ringing_blocks_many(&s->fit))
        ringing_blocks_run(&s->fit, SETTLE, part_polish, s);
    ringing_blocks_renew(&s->fit);
    for (int i = 0; i < AGAIN; i++) {
        s->gone = 0;
        ringing_blocks_run(&s->fit, 1, part_judge, s);
        if (ringing_blocks_many(&s->fit))
            ringing_blocks_run(&s->fit, SETTLE, part_polish, s);
        if (i == AGAIN - 1 || s->gone == 0 || round_run(s, s->finest, s->r->n) <= 0)
            break;
    }
}

bool ringing_esprit(const struct ringing *r, const struct ringing_options *o, struct arena *a, struct ringing_modes *m, struct err *e)
{
    struct search s;
    bool silent;
    if (!ringing_report_check(r, o, &silent, e))
        return false;
    if (silent) {
        ringing_report_silent(r, a, m);
        return true;
    }
    struct arena *inner = arena_open();
    search_open(&s, r, o, inner);
    rounds_run(&s);
    if (o->slope_test > 0)
        ringing_slopes_find(&s.fit, &s.noise, ALMOST);
    finish(&s);
    ringing_slopes_tie(&s.fit, &s.noise, o->slope_test);
    if (ringing_blocks_many(&s.fit))
        ringing_blocks_run(&s.fit, SETTLE, part_polish, &s);
    ringing_report(&s.fit, &s.noise, o, a, m);
    arena_close(inner);
    return true;
}
