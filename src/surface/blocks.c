/* Random profiles: the "depth maps synthesized from statistics" that papers/000 section 2.2 plans.

   The heights are independent blocks of N samples at a pitch of 1/(4 k1), k1 the highest frequency of the density P:
   each a random spectrum of P (Gaussian real and imaginary parts from the counter (block, line)) brought to space by an
   inverse FFT; successive blocks overlap by half under the window w(i) = sin(pi/2 sin^2(pi (i + 1/2) / N)), whose
   squares add to 1, so that the mean square height is the same everywhere. A block spans at least 8 times the longest
   wavelength. Any place can be read without the places before it; nothing repeats (2^64 blocks). The window convolves
   the spectrum with its own, 1.4 lines wide, which is the only departure from P in the mean. It begins and ends with a
   slope of 0: a window with a corner (sin) puts a kink into the profile at every half block, and at exponent -8 400
   times P into the last octave.

   What is drawn are the spline's coefficients: line j is divided by the response (2 + cos(2 pi j / N)) / 3 of reading a
   spline at its knots, so that the heights at the knots have P. */
#include "surface/blocks.h"

#include <math.h>

#include "num/fft.h"
#include "num/real.h"

/* Blocks are kept as long as they fit into KEPT_BYTES: strokes back and forth read the same ones again, and making one
 * costs what 20 000 frames of reading do. */
enum { KEPT_LEAST = 4, KEPT_MOST = 64, KEPT_BYTES = 1 << 19 };

struct block {
    long index;
    bool filled;
    double *c; /* [n]; NULL: not asked for yet */
};

struct blocks {
    long n;                  /* samples of a block, even */
    double *window, *spread; /* [n], [n/2+1]: window; standard deviation of a line's real and imaginary part */
    struct fft *fft;
    struct noise stream;
    struct block *blocks; /* [kept]: block b lies in slot b mod kept */
    long kept;
    struct arena *arena; /* for blocks */
    double *re, *im, *normal;
};

/* Line j of 1/(n pitch) cycles/m carries what P holds within half a line of it, so that all lines together have rms^2:
   line 0 in one number, the others in two, each of which has a quarter of the power in the sum (re + i im) e^(i..) +
   conjugate. */
static void blocks_spread(struct blocks *g, const struct spectrum *s, double pitch)
{
    double dk = 1 / ((double)g->n * pitch);
    for (long j = 0; j < g->n / 2; j++) {
        double power = spectrum_power(s, ((double)j - 0.5) * dk, ((double)j + 0.5) * dk),
               spline = (2 + real_cospi(2 * (double)j / (double)g->n)) / 3;
        g->spread[j] = sqrt(power / (j == 0 ? 1 : 4)) / spline;
    }
}

static void block_fill(struct blocks *g, struct block *b, long index)
{
    if (!b->c) b->c = ARENA_TAKE(g->arena, double, g->n);
    noise_normal(g->stream, (uint64_t)index, (size_t)g->n, g->normal);
    for (long j = 0; j < g->n / 2; j++) {
        g->re[j] = g->normal[2 * j] * g->spread[j];
        g->im[j] = g->normal[2 * j + 1] * g->spread[j];
    }
    g->im[0] = g->re[g->n / 2] = g->im[g->n / 2] = 0;
    fft_inverse(g->fft, g->re, g->im, b->c);
    for (long i = 0; i < g->n; i++)
        b->c[i] *= g->window[i];
    b->index = index;
    b->filled = true;
}

static const double *block_at(struct blocks *g, long index)
{
    struct block *b = &g->blocks[((index % g->kept) + g->kept) % g->kept];
    if (!b->filled || b->index != index) block_fill(g, b, index);
    return b->c;
}

/* Coefficient i is the sum of blocks b = floor(i / half) and b - 1, block b beginning at b half. */
static void blocks_read(struct profile *p, long first, long n, double *c)
{
    struct blocks *g = p->state;
    long half = g->n / 2;
    while (n > 0) {
        long b = first >= 0 ? first / half : -((-first + half - 1) / half), from = first - b * half;
        long some = half - from < n ? half - from : n;
        const double *new = block_at(g, b) + from, *old = block_at(g, b - 1) + half + from;
        for (long i = 0; i < some; i++)
            c[i] = new[i] + old[i];
        c += some;
        first += some;
        n -= some;
    }
}

static void blocks_close(struct profile *p)
{
    struct blocks *g = p->state;
    fft_close(g->fft);
}

static double blocks_window(double share)
{
    double s = real_sinpi(share);
    return real_sinpi(s * s / 2);
}

struct profile *blocks_make(struct arena *a, const struct spectrum *s, struct noise stream)
{
    struct profile *p = ARENA_TAKE(a, struct profile, 1);
    struct blocks *g = ARENA_TAKE(a, struct blocks, 1);
    double pitch = 0.25 / spectrum_top(s), span = 8 / fmax(spectrum_bottom(s), s->k[0]) / pitch;
    long n = (long)fft_good_size((size_t)(span < 4096 ? 4096 : span));
    long kept = KEPT_BYTES / (n * (long)sizeof(double));
    *g = (struct blocks){.n = n,
                         .arena = a,
                         .kept = kept < KEPT_LEAST  ? KEPT_LEAST
                                 : kept > KEPT_MOST ? KEPT_MOST
                                                    : kept,
                         .stream = stream,
                         .fft = fft_open((size_t)n),
                         .window = ARENA_TAKE(a, double, n),
                         .spread = ARENA_TAKE(a, double, n / 2 + 1),
                         .re = ARENA_TAKE(a, double, n / 2 + 1),
                         .im = ARENA_TAKE(a, double, n / 2 + 1),
                         .normal = ARENA_TAKE(a, double, n)};
    g->blocks = ARENA_TAKE(a, struct block, g->kept);
    for (long i = 0; i < n; i++)
        g->window[i] = blocks_window(((double)i + 0.5) / (double)n);
    blocks_spread(g, s, pitch);
    *p = (struct profile){
        .pitch = pitch, .from = -HUGE_VAL, .to = HUGE_VAL, .read = blocks_read, .state = g, .close = blocks_close};
    return p;
}
