/* Laws in closed form, over a stroke of length l in a time T, q = (t - t0) / T from 0 to 1:

     constant       p = q
     harmonic       p = (1 - cos pi q) / 2                  simple harmonic motion from rest to rest, papers/000 section
                                                            2.3
     minimum jerk   p = 10 q^3 - 15 q^4 + 6 q^5             T. Flash, N. Hogan, J. Neurosci. 5 (1985) 1688

   u = u0 + l p. Strokes follow one another without a pause, each with its share of the duration by length, or go there
   and back: then 2 rate strokes a second between u = 0 and l. So the speeds of back_and_forth and of four_in_line with
   strokes of the same length and time are the same functions of time, and so are those of a circle and a line
   (papers/000 section 3.2).

   Phase: there and back t 2 rate is rounded once, so after n strokes it is off by at most n 2^-53 strokes. */
#include <math.h>

#include "num/lanes.h"
#include "num/real.h"
#include "num/vecmath.h"
#include "trajectory/speed.h"

enum { STROKES_CHUNK = 256, STROKE_DETAIL = 64 };

struct strokes {
    int law;
    bool folded;
    double per_second; /* folded                                        */
    double length;     /* m, of each; NAN: not all the same             */
    double time;       /* s, of each                                    */
    size_t n;
    const double *from; /* [n + 1] m; NULL when folded                   */
    double pace;        /* s per m: duration over the whole length       */
};

static size_t stroke_find(const struct strokes *s, double t)
{
    size_t low = 0, high = s->n - 1;
    while (low < high) {
        size_t middle = (low + high + 1) / 2;
        if (s->from[middle] * s->pace <= t)
            low = middle;
        else
            high = middle - 1;
    }
    return low;
}

struct strokes_at {
    size_t n;
    double q[STROKES_CHUNK], p[STROKES_CHUNK], dp[STROKES_CHUNK], ddp[STROKES_CHUNK];
    double from[STROKES_CHUNK], length[STROKES_CHUNK],
        time[STROKES_CHUNK]; /* where the stroke starts, its signed length, m; s */
};

LANES_CLONES
static void stroke_folded(const struct strokes *s, struct strokes_at *a, const double *t)
{
    double per_second = s->per_second, length = s->length, time = s->time;
    size_t n = a->n;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double x = t[i] * per_second, k = lanes_floor(x);
        int back = k / 2 != lanes_floor(k / 2);
        a->from[i] = lanes_select(back, length, 0);
        a->length[i] = lanes_select(back, -length, length);
        a->time[i] = time;
        a->q[i] = x - k;
    }
}

LANES_CLONES
static void stroke_even(const struct strokes *s, struct strokes_at *a, const double *t)
{
    double most = (double)(s->n - 1), length = s->length, time = s->time;
    size_t n = a->n;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double x = t[i] / time, k = lanes_floor(x);
        k = lanes_select(k < 0, 0, lanes_select(k > most, most, k));
        a->from[i] = length * k;
        a->length[i] = length;
        a->time[i] = time;
        a->q[i] = x - k;
    }
}

static void stroke_uneven(const struct strokes *s, struct strokes_at *a, const double *t)
{
    for (size_t i = 0; i < a->n; i++) {
        size_t j = stroke_find(s, t[i]);
        a->from[i] = s->from[j];
        a->length[i] = s->from[j + 1] - s->from[j];
        a->time[i] = a->length[i] * s->pace;
        a->q[i] = (t[i] - a->from[i] * s->pace) / a->time[i];
    }
}

LANES_CLONES
static void shape_harmonic(size_t n, double *restrict p, double *restrict dp, double *restrict ddp)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        p[i] = (1 - ddp[i]) / 2;
        dp[i] *= REAL_PI / 2;
        ddp[i] *= REAL_PI * REAL_PI / 2;
    }
}

static void stroke_shape(int law, size_t n, const double *q, double *p, double *dp, double *ddp)
{
    if (law == SPEED_HARMONIC) {
        vecmath_sincospi(n, q, dp, ddp);
        shape_harmonic(n, p, dp, ddp);
    } else if (law == SPEED_MINIMUM_JERK) {
        for (size_t i = 0; i < n; i++) {
            double x = q[i];
            p[i] = x * x * x * (10 + x * (-15 + x * 6));
            dp[i] = 30 * x * x * (1 - x) * (1 - x);
            ddp[i] = 60 * x * (1 - x) * (1 - 2 * x);
        }
    } else {
        for (size_t i = 0; i < n; i++)
            p[i] = q[i], dp[i] = 1, ddp[i] = 0;
    }
}

/* Place, or its first or second derivative over time. */
LANES_CLONES
static void stroke_out(const struct strokes_at *a, int derivative, double *out)
{
    size_t n = a->n;
#pragma omp simd
    for (size_t i = 0; i < (derivative == 0 ? n : 0); i++)
        out[i] = a->from[i] + a->length[i] * a->p[i];
#pragma omp simd
    for (size_t i = 0; i < (derivative == 1 ? n : 0); i++)
        out[i] = a->length[i] / a->time[i] * a->dp[i];
#pragma omp simd
    for (size_t i = 0; i < (derivative == 2 ? n : 0); i++)
        out[i] = a->length[i] / (a->time[i] * a->time[i]) * a->ddp[i];
}

static void strokes_at(const struct speed *speed, size_t n, const double *t, double *u, double *du, double *ddu)
{
    const struct strokes *s = speed->state;
    double *out[3] = {u, du, ddu};
    struct strokes_at a;
    for (size_t first = 0; first < n; first += STROKES_CHUNK) {
        a.n = n - first < STROKES_CHUNK ? n - first : STROKES_CHUNK;
        if (s->folded)
            stroke_folded(s, &a, t + first);
        else if (!isnan(s->length))
            stroke_even(s, &a, t + first);
        else
            stroke_uneven(s, &a, t + first);
        stroke_shape(s->law, a.n, a.q, a.p, a.dp, a.ddp);
        for (int k = 0; k < 3; k++)
            if (out[k]) stroke_out(&a, k, out[k] + first);
    }
}

/* The first border of two strokes behind t0. */
static double folded_turning(const struct speed *speed, double t0, double t1)
{
    const struct strokes *s = speed->state;
    double turn = (floor(s->per_second * t0) + 1) / s->per_second;
    return turn > t0 && turn < t1 && turn < speed->duration ? turn : NAN;
}

static double top_of(int law) { return law == SPEED_HARMONIC ? REAL_PI / 2 : law == SPEED_MINIMUM_JERK ? 1.875 : 1; }

void speed_strokes(struct speed *speed, int law, const struct path *path, double duration, struct arena *a)
{
    struct strokes *s = ARENA_TAKE(a, struct strokes, 1);
    double length = path->length / (double)path->n_strokes;
    *s = (struct strokes){.law = law,
                          .n = path->n_strokes,
                          .from = path->strokes,
                          .pace = duration / path->length,
                          .length = length,
                          .time = duration / (double)path->n_strokes};
    for (size_t i = 0; i < s->n; i++)
        if (fabs(s->from[i] - length * (double)i) > 1e-15 * path->length) s->length = NAN;
    *speed = (struct speed){.duration = duration,
                            .top = path->length / duration * top_of(law),
                            .distance = path->length,
                            .reach = {0, path->length},
                            .cycle = duration,
                            .detail = STROKE_DETAIL * (long)s->n,
                            .at = strokes_at,
                            .state = s};
}

void speed_strokes_folded(struct speed *speed, int law, double length, double rate, double duration, struct arena *a)
{
    struct strokes *s = ARENA_TAKE(a, struct strokes, 1);
    double whole, last, end = duration;
    *s = (struct strokes){
        .law = law, .folded = true, .n = 1, .length = length, .per_second = 2 * rate, .time = 1 / (2 * rate)};
    *speed = (struct speed){.duration = duration,
                            .top = length * 2 * rate * top_of(law),
                            .cycle = fmin(duration, 1 / rate),
                            .detail = 2 * STROKE_DETAIL,
                            .at = strokes_at,
                            .turning = folded_turning,
                            .state = s};
    strokes_at(speed, 1, &end, &last, NULL, NULL);
    whole = floor(duration * s->per_second);
    speed->distance = whole * length + (whole / 2 != floor(whole / 2) ? length - last : last);
    speed->reach[1] = whole >= 1 ? length : last;
}
