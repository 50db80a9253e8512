/* Modified convolution as printed (papers/000 eq. 10, eq. 13), by fast convolution: exact to rounding where
   responses stay, of order hop^4 where one moves.

   Responses that stay, each fed with its share of the force: y = sum_k h_k * (w_k f). Uniform partitions of B samples;
   the sum over responses is taken in the spectrum. With f_j the force of block j, zero-padded to 2 B, and H_kq the
   spectrum of samples q B .. q B + B - 1 of h_k, likewise:

       Y_{j+q} += sum_k H_kq FFT(w_k f_j)   for q = 0 .. P - 1, P = ceil(length/B)

   Block j of the sound is the first half of IFFT(Y_j) plus the second half of IFFT(Y_{j-1}). The past is P spectra, one
   set for all responses. A response costs one FFT and P products in a block in which it has a share, and nothing in any
   other. Its P spectra are made when it is first needed, and kept: 16 bytes a sample of h.

   A response that moves. Nodes stand every `hop` samples, h_k is the response there, and between nodes h is the cubic
   through the four nearest:

       w(u) = (1 - u^2)(2 - |u|)/2          for |u| <= 1     u = n/hop - k
              (1 - |u|)(2 - |u|)(3 - |u|)/6 for |u| > 1

   Launch: of a node the 4 hop samples of force under its window times w, zero-padded FFT, times the FFT of h_k, back,
   added to a ring of sound.

   Readout, its transpose: the 4 hop samples under the window and the length - 1 before them, FFT, times the FFT of h_k,
   back; the first length - 1 samples are wrapped and dropped (overlap-save), the rest is multiplied by w and added.

   Either way the error against a response that moves at every sample is of order hop^4 in h's change: 24 dB per
   halving.

   Blocks and nodes stand at fixed sample numbers, each is complete before its first sample is given out, and additions
   run in their order: the result does not depend on how the sound is cut into calls. */
#include "convolution/overlap_add.h"

#include <math.h>
#include <string.h>

#include "base/arena.h"
#include "num/fft.h"
#include "num/lanes.h"
#include "num/scaled.h"

/* Blocks of 2048 to 16384 cost the same within the noise of a measurement for responses of 1 s at 44.1 kHz
   (tests/bench/overlap_add.c), 1024 and 32768 more: transforms grow with log B, products fall with 1/B, and a response
   that is passed quickly is at work for at least one block. */
enum { BLOCK = OVERLAP_ADD_BLOCK, SIZE = 2 * BLOCK, BINS = BLOCK + 1, ORDER = 4 };

struct spectrum {
    double *re, *im;
};

static struct spectrum take(struct arena *a, size_t n)
{
    double *both = ARENA_TAKE(a, double, 2 * n);
    return (struct spectrum){both, both + n};
}

/* b *= a */
LANES_CLONES
static void multiply(size_t n, struct spectrum a, struct spectrum b)
{
    const double *restrict ar = a.re, *restrict ai = a.im;
    double *restrict br = b.re, *restrict bi = b.im;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double re = fma(ar[i], br[i], -(ai[i] * bi[i]));
        bi[i] = fma(ar[i], bi[i], ai[i] * br[i]);
        br[i] = re;
    }
}

/* c += a b */
LANES_CLONES
static void add_product(size_t n, struct spectrum a, struct spectrum b, struct spectrum c)
{
    const double *restrict ar = a.re, *restrict ai = a.im, *restrict br = b.re, *restrict bi = b.im;
    double *restrict cr = c.re, *restrict ci = c.im;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        cr[i] = fma(ar[i], br[i], fma(-ai[i], bi[i], cr[i]));
        ci[i] = fma(ar[i], bi[i], fma(ai[i], br[i], ci[i]));
    }
}

/* ------------------------------------------------------------------ responses that stay */

struct overlap_add {
    struct arena *arena;
    struct fft *fft;
    struct overlap_add_source source;
    size_t parts;
    long now, next;       /* sample about to be given out; next block                   */
    struct spectrum *h;   /* [n], each [parts][BINS]; re NULL: not needed yet           */
    struct spectrum sum;  /* [parts][BINS]: spectra of this and later blocks            */
    bool *used;           /* [parts]: is there anything in it                           */
    struct spectrum x;    /* [BINS]                                                     */
    double *time, *share; /* [SIZE], [BLOCK]                                            */
    double *sound, *rest; /* [BLOCK]: of the block given out, and what it leaves to the next */
};

struct overlap_add *overlap_add_open(const struct overlap_add_source *source)
{
    struct arena *a = arena_open();
    struct overlap_add *o = ARENA_TAKE(a, struct overlap_add, 1);
    *o = (struct overlap_add){
        .arena = a, .source = *source, .fft = fft_open(SIZE), .parts = (source->length + BLOCK - 1) / BLOCK};
    o->h = ARENA_TAKE(a, struct spectrum, source->n + 1);
    o->sum = take(a, o->parts * BINS);
    o->used = ARENA_TAKE(a, bool, o->parts);
    o->x = take(a, BINS);
    o->time = ARENA_TAKE(a, double, SIZE);
    o->share = ARENA_TAKE(a, double, BLOCK);
    o->sound = ARENA_TAKE(a, double, BLOCK);
    o->rest = ARENA_TAKE(a, double, BLOCK);
    return o;
}

void overlap_add_close(struct overlap_add *o)
{
    fft_close(o->fft);
    arena_close(o->arena);
}

/* The spectra of response k, divided by SIZE, since FFTW's inverse is not. */
static void prepare(struct overlap_add *o, int k)
{
    size_t length = o->source.length;
    struct arena *a = arena_open();
    double *whole = ARENA_TAKE(a, double, length);
    o->h[k] = take(o->arena, o->parts * BINS);
    o->source.response(o->source.self, k, whole, length);
    for (size_t q = 0; q < o->parts; q++) {
        size_t n = length - q * BLOCK < BLOCK ? length - q * BLOCK : BLOCK;
        memset(o->time, 0, SIZE * sizeof *o->time);
        for (size_t i = 0; i < n; i++)
            o->time[i] = whole[q * BLOCK + i] / SIZE;
        fft_forward(o->fft, o->time, o->h[k].re + q * BINS, o->h[k].im + q * BINS);
    }
    arena_close(a);
}

/* What response k makes of block `now` of the force. */
static void launch(struct overlap_add *o, int k, const double *f)
{
    if (o->source.share && !o->source.share(o->source.self, o->now, BLOCK, k, o->share)) return;
    for (int i = 0; i < BLOCK; i++)
        o->share[i] = o->source.share ? o->share[i] * f[i] : f[i];
    if (scaled_is_zero(o->share, BLOCK)) return;
    if (!o->h[k].re) prepare(o, k);
    memcpy(o->time, o->share, BLOCK * sizeof *o->time);
    memset(o->time + BLOCK, 0, BLOCK * sizeof *o->time);
    fft_forward(o->fft, o->time, o->x.re, o->x.im);
    for (size_t q = 0; q < o->parts; q++) {
        size_t slot = ((size_t)o->next + q) % o->parts, H = q * BINS, Y = slot * BINS;
        add_product(BINS, (struct spectrum){o->h[k].re + H, o->h[k].im + H}, o->x,
                    (struct spectrum){o->sum.re + Y, o->sum.im + Y});
        o->used[slot] = true;
    }
}

/* The block that starts at o->now, whose force f points at. */
static void run_block(struct overlap_add *o, const double *f)
{
    size_t slot = (size_t)o->next % o->parts;
    double *re = o->sum.re + slot * BINS, *im = o->sum.im + slot * BINS;
    if (!scaled_is_zero(f, BLOCK))
        for (int k = 0; k < o->source.n; k++)
            launch(o, k, f);
    memset(o->time, 0, SIZE * sizeof *o->time);
    if (o->used[slot]) {
        fft_inverse(o->fft, re, im, o->time);
        memset(re, 0, BINS * sizeof *re);
        memset(im, 0, BINS * sizeof *im);
        o->used[slot] = false;
    }
    for (int i = 0; i < BLOCK; i++) {
        o->sound[i] = o->rest[i] + o->time[i];
        o->rest[i] = o->time[BLOCK + i];
    }
    o->next++;
}

void overlap_add_run(struct overlap_add *o, const double *f, double *y, long frames)
{
    for (long done = 0; done < frames;) {
        if (o->now == o->next * BLOCK) run_block(o, f + done);
        long left = o->next * BLOCK - o->now, n = left < frames - done ? left : frames - done;
        for (long i = 0; i < n; i++)
            y[done + i] += o->sound[BLOCK - left + i];
        o->now += n;
        done += n;
    }
}

/* ------------------------------------------------------------------ a response that moves */

struct overlap_add_moving {
    struct arena *arena;
    struct fft *fft;
    enum overlap_add_reading reading;
    overlap_add_response *response;
    void *self;
    int hop, count;             /* count: samples under a window                          */
    size_t length, size, bins;  /* of h; of the FFT; size/2 + 1                           */
    long now, next;             /* sample about to be given out; next node                */
    double per_size, *x, *h;    /* [size]                                                 */
    struct spectrum force, own; /* [bins]: of x and of h                                  */
    double *window;             /* [count]                                                */
    double *ring;               /* [room] sound to come                                   */
    size_t room, oldest;
    double *past; /* [length - 1] readout: force before `now`, the oldest at `oldest` */
    long quiet;   /* samples of zero force before `now`                     */
};

/* First sample of node k's window. */
static long window_start(const struct overlap_add_moving *o, long k) { return (k - ORDER / 2) * o->hop; }

struct overlap_add_moving *overlap_add_moving_open(size_t length, int hop, enum overlap_add_reading reading,
                                                   overlap_add_response *response, void *self)
{
    struct arena *a = arena_open();
    struct overlap_add_moving *o = ARENA_TAKE(a, struct overlap_add_moving, 1);
    *o = (struct overlap_add_moving){.arena = a,
                                     .reading = reading,
                                     .response = response,
                                     .self = self,
                                     .hop = hop,
                                     .count = ORDER * hop,
                                     .length = length};
    o->size = fft_good_size(length + (size_t)o->count - 1);
    o->per_size = 1.0 / (double)o->size;
    o->bins = o->size / 2 + 1;
    o->fft = fft_open(o->size);
    o->x = ARENA_TAKE(a, double, o->size);
    o->h = ARENA_TAKE(a, double, o->size);
    o->force = take(a, o->bins);
    o->own = take(a, o->bins);
    o->window = ARENA_TAKE(a, double, o->count);
    for (int j = 0; j < o->count; j++) { /* Lagrange's cubic between four nodes */
        double u = fabs((double)(j - o->count / 2) / hop);
        o->window[j] = u <= 1.0 ? (1.0 - u * u) * (2.0 - u) / 2.0 : (1.0 - u) * (2.0 - u) * (3.0 - u) / 6.0;
    }
    o->room = reading == OVERLAP_ADD_READOUT ? (size_t)o->count : o->size;
    o->ring = ARENA_TAKE(a, double, o->room);
    o->past = ARENA_TAKE(a, double, length);
    o->quiet = (long)length - 1;
    o->next = 1 - ORDER / 2; /* the first node whose window reaches sample 0 */
    return o;
}

void overlap_add_moving_close(struct overlap_add_moving *o)
{
    fft_close(o->fft);
    arena_close(o->arena);
}

int overlap_add_moving_ahead(const struct overlap_add_moving *o) { return o->count - 1; }

/* The force that a node's response meets, to x; false: there is none. n samples are under the window, the first of them
   f[0]. */
static bool gather(struct overlap_add_moving *o, const double *f, int n, const double *window)
{
    bool readout = o->reading == OVERLAP_ADD_READOUT;
    size_t before = readout ? o->length - 1 : 0, first = before - o->oldest;
    if (scaled_is_zero(f, n) && !(readout && o->quiet < (long)before)) return false;
    memset(o->x, 0, o->size * sizeof *o->x);
    if (readout) {
        memcpy(o->x, o->past + o->oldest, first * sizeof *o->x);
        memcpy(o->x + first, o->past, o->oldest * sizeof *o->x);
    }
    for (int j = 0; j < n; j++)
        o->x[before + (size_t)j] = readout ? f[j] : window[j] * f[j];
    return true;
}

/* f points at the force of sample o->now, which is the window's start, or 0 when the window starts before the sound. */
static void run_node(struct overlap_add_moving *o, const double *f)
{
    long k = o->next++;
    int skip = (int)(o->now - window_start(o, k)), n = o->count - skip;
    const double *window = o->window + skip;
    if (!gather(o, f, n, window)) return;
    memset(o->h, 0, o->size * sizeof *o->h);
    o->response(o->self, k, o->h, o->length);
    fft_forward(o->fft, o->x, o->force.re, o->force.im);
    fft_forward(o->fft, o->h, o->own.re, o->own.im);
    multiply(o->bins, o->own, o->force);
    fft_inverse(o->fft, o->force.re, o->force.im, o->x);
    size_t at = (size_t)o->now % o->room, before = o->length - 1,
           used = o->reading == OVERLAP_ADD_READOUT ? (size_t)n : before + (size_t)n;
    for (size_t j = 0; j < used; j++, at = at + 1 == o->room ? 0 : at + 1)
        o->ring[at] +=
            o->reading == OVERLAP_ADD_READOUT ? window[j] * (o->x[before + j] * o->per_size) : o->x[j] * o->per_size;
}

static void remember(struct overlap_add_moving *o, const double *f, long n)
{
    size_t before = o->length - 1;
    for (long i = 0; o->reading == OVERLAP_ADD_READOUT && i < n; i++) {
        o->quiet = f[i] != 0.0 ? 0 : o->quiet + 1;
        if (before) o->past[o->oldest] = f[i];
        o->oldest = o->oldest + 1 >= before ? 0 : o->oldest + 1;
    }
}

void overlap_add_moving_run(struct overlap_add_moving *o, const double *f, double *y, long frames)
{
    for (long done = 0; done < frames;) {
        while (window_start(o, o->next) <= o->now)
            run_node(o, f + done);
        long until = window_start(o, o->next) - o->now, n = until < frames - done ? until : frames - done;
        size_t at = (size_t)o->now % o->room;
        for (long i = 0; i < n; i++, at = at + 1 == o->room ? 0 : at + 1) {
            y[done + i] += o->ring[at];
            o->ring[at] = 0.0;
        }
        remember(o, f + done, n);
        o->now += n;
        done += n;
    }
}
