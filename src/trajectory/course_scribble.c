/* A hand's wandering loops: on each axis a sum of sines

     x(t) = center + size / 2 sum_k a_k sin(2 pi f_k t + phi_k),   sum_k a_k = 1,   k = 1 .. 4

   f_k = rate 2^(e), e evenly drawn from [-0.7, 0.7], so that no two frequencies have a common period; a_k in proportion
   to numbers evenly drawn from [0.5, 1]; phi_k from a whole turn. All come from the seed alone: a longer scribble
   begins as a shorter one. The box is never left, and filled as time goes on. Sums of sines of a narrow band on both
   axes are near to ellipses at every instant, and an ellipse drawn by two sines obeys the two-thirds power law exactly
   (F. Lacquaniti, C. Terzuolo, P. Viviani, Acta Psychologica 54 (1983) 115).

   The argument of a sine is rounded once: after n loops its phase is off by at most 2 pi n 1.6 2^-53. */
#include <math.h>
#include <stdbool.h>

#include "num/noise.h"
#include "num/real.h"
#include "num/vecmath.h"
#include "trajectory/course.h"

enum { SINES = 4, BREAKS_PER_LOOP = 8 };

struct scribble {
    double center[2], half[2];
    double turns[2][SINES]; /* half turns per s */
    double phase[2][SINES]; /* half turns       */
    double share[2][SINES];
};

/* y[i] = (k == 0 ? start : y[i]) + size * wave[i] */
static void add_wave(size_t n, double *y, bool first, double start, double size, const double *wave)
{
    for (size_t i = 0; y && i < n; i++)
        y[i] = (first ? start : y[i]) + size * wave[i];
}

static void scribble_axis(const struct scribble *s, int xy, size_t n, const double *w, const struct course_out *out,
                          size_t at)
{
    double sine[COURSE_CHUNK], cosine[COURSE_CHUNK];
    for (int k = 0; k < SINES; k++) {
        double size = s->half[xy] * s->share[xy][k], omega = REAL_PI * s->turns[xy][k];
        for (size_t i = 0; i < n; i++)
            sine[i] = s->turns[xy][k] * w[i] + s->phase[xy][k];
        vecmath_sincospi(n, sine, sine, cosine);
        add_wave(n, out->p[xy] ? out->p[xy] + at : NULL, k == 0, s->center[xy], size, sine);
        add_wave(n, out->d[xy] ? out->d[xy] + at : NULL, k == 0, 0, size * omega, cosine);
        add_wave(n, out->dd[xy] ? out->dd[xy] + at : NULL, k == 0, 0, -size * omega * omega, sine);
        add_wave(n, out->ddd[xy] ? out->ddd[xy] + at : NULL, k == 0, 0, -size * omega * omega * omega, cosine);
    }
}

static void scribble_at(const struct course *c, size_t n, const double *w, const struct course_out *out)
{
    for (size_t first = 0; first < n; first += COURSE_CHUNK)
        for (int xy = 0; xy < 2; xy++)
            scribble_axis(c->state, xy, n - first < COURSE_CHUNK ? n - first : COURSE_CHUNK, w + first, out, first);
}

/* Row 3 xy + k of the stream: exponent, share, phase (k = 0, 1, 2), one column for each sine. */
static struct scribble scribble_draw(const struct motion *m, uint64_t seed)
{
    struct noise stream = noise_make(seed, "scribble");
    struct scribble s;
    for (int xy = 0; xy < 2; xy++) {
        double sum = 0;
        s.center[xy] = m->center[xy];
        s.half[xy] = m->size[xy] / 2;
        for (int k = 0; k < SINES; k++) {
            uint64_t row = (uint64_t)(3 * xy), column = (uint64_t)k;
            s.turns[xy][k] = 2 * m->rate * real_pow(2, 0.7 * (2 * noise_uniform(stream, row, column) - 1));
            s.share[xy][k] = 0.5 + 0.5 * noise_uniform(stream, row + 1, column);
            s.phase[xy][k] = 2 * noise_uniform(stream, row + 2, column);
            sum += s.share[xy][k];
        }
        for (int k = 0; k < SINES; k++)
            s.share[xy][k] /= sum;
    }
    return s;
}

void course_scribble(struct course *c, const struct motion *m, uint64_t seed, double end, struct arena *a)
{
    struct scribble *s = ARENA_TAKE(a, struct scribble, 1);
    size_t pieces = (size_t)ceil(end * m->rate * BREAKS_PER_LOOP) + 1;
    double *breaks = ARENA_TAKE(a, double, pieces + 1);
    for (size_t i = 0; i <= pieces; i++)
        breaks[i] = i == pieces ? end : end * (double)i / (double)pieces;
    *s = scribble_draw(m, seed);
    *c = (struct course){.end = end, .breaks = breaks, .n_breaks = pieces + 1, .at = scribble_at, .state = s};
}
