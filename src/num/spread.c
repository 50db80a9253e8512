/* A Gaussian of variance m + u is one of variance m behind exp(-u omega^2 / 2), and where u is small beside m that is
   hardly anything:

     exp(-u omega^2 / 2) = 1 + u A_1 + u^2 A_2 + u^3 A_3,   A_k = (-1/2)^k omega^2k / k!

   with omega^2 = sum of 2 x^n / (n^2 C(2n, n)), n <= NEAR, x = 4 sin^2(omega/2), which is the taps (-1, 2, -1). So
   elements are taken in runs whose variances lie about the same m of a table, and a run goes through two convolutions
   with constant taps: a short one of x, u x, u^2 x and u^3 x, then a long one, only where an output is wanted, with the
   Gaussian of m joined to the filter behind it. Of these two hardly more is left than of the Gaussian alone.

   An m serves |u| <= 1.25 STEP m, up to which a run goes on, and is 2 STEP from the next: a variance that trembles cuts
   no run to pieces. The power of u left out gives at most 8e-8 of the sum (where m omega^2 = 8); the powers of x left
   out 6e-6 at a quarter of the rate, 2e-7 at a fifth, for the narrowest m, and 5e-7 from m = 4 on. Beyond, which
   counts where each element has its output, they give up to 1e-2 where sigma is below 0.8, as for num/filter.h's own
   kernels, and 1e-3 up to 1.4. From sigma = 8 on differences are taken over `stride` elements, at most a quarter of
   sigma: u omega^2 would else be large where the Gaussian lets nothing through, and its rounding with it.

   Sums do not depend on how elements are handed over: each place of a run is spread once no later element changes it,
   and adds to an output in the order of places, run after run. */
#include "num/spread.h"

#include <math.h>
#include <string.h>

#include "num/lanes.h"
#include "num/phases.h"

#define STEP 0.02 /* of the variance; elements^2 where it is narrow */
enum { ORDER = 3, NEAR = 8, TAPS = 2 * NEAR + 1, MOST = 1024 /* elements of a run */ };
enum { KERNELS_MOST = 1 << 23 }; /* values in memory: 64 MiB */

struct node {
    double middle, stays; /* variance; how far from it a run goes on */
    int stride;
    struct phases kernel; /* made when first wanted; tap NULL: not */
};

struct spread {
    struct filter then;
    int each, nodes, at; /* at: node of the last element */
    int reach, pad;
    struct node *node; /* by rising variance */
    struct arena *kernels;
    size_t values; /* in it */
    double tap[ORDER][TAPS];
    long count, done;              /* elements of the open run; its places that are done, from its first element on */
    double x[MOST], *power[ORDER]; /* of it: x, u^k x between zeros                              */
    double *near;                  /* x spread by its u, between `pad` zeros            */
    double *sorted;                /* what phases_run needs                             */
    double *sum;                   /* outputs so far                                    */
    long room, ahead;              /* of sum: its length; outputs before that of element 0, or 0 later */
    long place;                    /* of the open run's first element, in elements from output sum[0] on */
};

/* C(2n, n + j) */
static double binomial(int n, int j)
{
    double b = 1;
    for (int i = 1; i <= n - j; i++)
        b = b * (2 * n + 1 - i) / i;
    return b;
}

static void differences_make(double tap[ORDER][TAPS])
{
    double power[NEAR + 1] = {1}, next[NEAR + 1], square[NEAR + 1] = {0};
    for (int n = 1; n <= NEAR; n++)
        square[n] = 2 / (n * n * binomial(n, 0));
    for (int k = 0; k < ORDER; k++) {
        memset(next, 0, sizeof next);
        for (int n = 0; n <= NEAR; n++)
            for (int i = 1; n + i <= NEAR; i++)
                next[n + i] += -0.5 / (k + 1) * power[n] * square[i];
        memcpy(power, next, sizeof power);
        for (int n = 1; n <= NEAR; n++)
            for (int j = -n; j <= n; j++)
                tap[k][NEAR + j] += (j % 2 ? -1 : 1) * binomial(n, j < 0 ? -j : j) * power[n];
    }
}

static int stride_of(double variance) { return variance < 64 ? 1 : (int)(sqrt(variance) / 4); }

/* The table of variances up to `widest`. */
static void nodes_make(struct spread *s, double widest, struct arena *a)
{
    double v = 0;
    for (int pass = 0; pass < 2; pass++, v = 0) {
        for (s->nodes = 0; s->nodes == 0 || v < widest; s->nodes++) {
            double d = v < FILTER_NARROW * FILTER_NARROW ? STEP : v * STEP / (1 - STEP);
            if (pass) s->node[s->nodes] = (struct node){v + d, 1.25 * d, stride_of(v + d), {.tap = NULL}};
            v += 2 * d;
        }
        if (!pass) s->node = ARENA_TAKE(a, struct node, s->nodes);
    }
}

static double middle_most(double widest) { return 1.05 * widest + STEP; }

int spread_reach(double widest, const struct filter *then, int each)
{
    double v = middle_most(widest);
    return filter_gaussian_reach(sqrt(v)) + (then ? then->reach : 0) + NEAR * stride_of(v) + each;
}

struct spread *spread_open(struct arena *a, double widest, bool still, const struct filter *then, int each,
                           long outputs)
{
    struct spread *s = ARENA_TAKE(a, struct spread, 1);
    if (then) {
        s->then = (struct filter){then->reach, then->taps, ARENA_TAKE(a, double, then->taps)};
        memcpy(s->then.tap, then->tap, (size_t)then->taps * sizeof *then->tap);
    }
    s->each = each;
    nodes_make(s, widest, a);
    if (still) {
        s->nodes = 1;
        s->node[0] = (struct node){.middle = widest, .stride = 1};
    }
    differences_make(s->tap);
    long far = NEAR * stride_of(middle_most(widest));
    s->reach = spread_reach(widest, then, each);
    s->pad = 2 * s->reach + each;
    s->room = outputs + 3 * (s->reach / each + 2);
    for (int k = 0; k < ORDER; k++)
        s->power[k] = ARENA_TAKE(a, double, MOST + 4 * far + PHASES_WIDE) + 2 * far;
    s->near = ARENA_TAKE(a, double, MOST + 2 * far + 2 * s->pad) + s->pad;
    s->sorted = ARENA_TAKE(a, double, MOST + 2 * far + 3 * s->pad + PHASES_WIDE);
    s->sum = ARENA_TAKE(a, double, s->room);
    s->kernels = arena_open();
    spread_restart(s);
    return s;
}

void spread_close(struct spread *s) { arena_close(s->kernels); }

void spread_restart(struct spread *s)
{
    memset(s->sum, 0, (size_t)s->room * sizeof *s->sum);
    s->ahead = s->reach / s->each + 1;
    s->place = s->ahead * s->each;
    s->count = 0;
}

static void kernel_make(struct spread *s, struct node *n)
{
    struct arena *a = arena_open();
    struct filter f = filter_gaussian(a, sqrt(n->middle)), joined = s->then.tap ? filter_joined(a, &f, &s->then) : f;
    s->values += (size_t)joined.taps;
    if (s->values > KERNELS_MOST) { /* all anew */
        arena_close(s->kernels);
        s->kernels = arena_open();
        for (int k = 0; k < s->nodes; k++)
            s->node[k].kernel.tap = NULL;
        s->values = (size_t)joined.taps;
    }
    n->kernel = phases_make(s->kernels, &joined, s->each, (MOST + 2 * NEAR * n->stride + joined.taps) / s->each + 2);
    arena_close(a);
}

/* x times the powers of u over stride^2. */
LANES_CLONES
static void powers(struct spread *s, const struct node *n, const double *x, const double *v, long count)
{
    double *first = s->power[0] + s->count, *second = s->power[1] + s->count, *third = s->power[2] + s->count,
           per = 1.0 / ((double)n->stride * n->stride);
#pragma omp simd
    for (long i = 0; i < count; i++) {
        double u = (v[i] - n->middle) * per;
        first[i] = u * x[i];
        second[i] = u * first[i];
        third[i] = u * second[i];
    }
}

/* What lies at the open run's places below `end`, of its elements and `far` beyond, goes to the outputs. */
static void places_add(struct spread *s, long end)
{
    const struct node *k = &s->node[s->at];
    const struct phases *p = &k->kernel;
    long from = s->done, n = end - from, far = (long)NEAR * k->stride, first = from < 0 ? 0 : from,
         last = end < s->count ? end : s->count;
    if (n <= 0) return;
    memset(s->near, 0, (size_t)(n + s->pad) * sizeof *s->near);
    if (first < last) memcpy(s->near + (first - from), s->x + first, (size_t)(last - first) * sizeof *s->near);
    for (int i = 0; i < ORDER && k->stays > 0; i++)
        phases_add(s->tap[i], TAPS, k->stride, s->power[i] + from - far, n, s->near);
    long at = s->place + from,                       /* of near[0] */
        o = (at + p->reach - p->taps) / s->each + 1, /* the first output that it reaches */
        zeros = at + p->reach - s->each * o, outputs = (at + n - 1 + p->reach) / s->each + 1 - o;
    phases_run(p, s->near - zeros, zeros, zeros + n, outputs, true, s->sum + o, s->sorted);
    s->done = end;
}

static void run_close(struct spread *s)
{
    long far = (long)NEAR * s->node[s->at].stride;
    for (int i = 0; i < ORDER && s->count > 0; i++)
        memset(s->power[i] + s->count, 0, (size_t)(2 * far) * sizeof *s->power[i]);
    if (s->count > 0) places_add(s, s->count + far);
    s->place += s->count;
    s->count = 0;
}

static void run_open(struct spread *s, double v)
{
    while (v > s->node[s->at].middle + s->node[s->at].stays && s->at < s->nodes - 1)
        s->at++;
    while (v < s->node[s->at].middle - s->node[s->at].stays && s->at > 0)
        s->at--;
    if (!s->node[s->at].kernel.tap) kernel_make(s, &s->node[s->at]);
    s->done = -(long)NEAR * s->node[s->at].stride;
}

void spread_add(struct spread *s, const double *x, const double *v, long n)
{
    for (long i = 0, count; i < n; i += count) {
        const struct node *k = &s->node[s->at];
        if (s->count == MOST || fabs(v[i] - k->middle) > k->stays) run_close(s);
        if (s->count == 0) run_open(s, v[i]);
        k = &s->node[s->at];
        for (count = 1; i + count < n && s->count + count < MOST && fabs(v[i + count] - k->middle) <= k->stays;)
            count++;
        memcpy(s->x + s->count, x + i, (size_t)count * sizeof *x);
        powers(s, k, x + i, v + i, count);
        s->count += count;
    }
    places_add(s, s->count - (long)NEAR * s->node[s->at].stride);
}

void spread_take(struct spread *s, double *y, long n)
{
    for (long m = 0; m < s->ahead; m++)
        s->sum[s->ahead + m] += s->sum[s->ahead - 1 - m];
    long used = s->ahead + n;
    memcpy(y, s->sum + s->ahead, (size_t)n * sizeof *y);
    memmove(s->sum, s->sum + used, (size_t)(s->room - used) * sizeof *y);
    memset(s->sum + (s->room - used), 0, (size_t)used * sizeof *y);
    s->place -= used * s->each;
    s->ahead = 0;
}
