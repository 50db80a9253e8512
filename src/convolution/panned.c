/* Several responses, each fed with its share of the force: y = sum_k h_k * (w_k f), exact to rounding.

   Uniform partitions of B samples, the sum over responses taken in the spectrum. With f_j the force of block j, zero-padded to 2 B, and H_kq the
   spectrum of samples q B .. q B + B - 1 of h_k, likewise:

       Y_{j+q} += sum_k H_kq FFT(w_k f_j)   for q = 0 .. P - 1, P = ceil(length/B)

   and block j of the sound is the first half of IFFT(Y_j) plus the second half of IFFT(Y_{j-1}). So what the past has still to say is P spectra,
   one set for all responses: a response costs one FFT and P products in a block in which it has a share, and nothing in any other, neither time
   nor memory of its past. Its P spectra are made when it is first needed and then kept: 16 bytes a sample of h.

   Blocks stand at fixed sample numbers and additions run in the order of blocks, then responses: the result does not depend
   on how the sound is cut into calls. */
#include "convolution/panned.h"

#include <stdbool.h>
#include <string.h>

#include "base/arena.h"
#include "convolution/product.h"
#include "num/fft.h"

/* Blocks of 2048 to 16384 cost the same within the noise of a measurement for responses of 1 s at 44.1 kHz (tests/bench/panned.c), 1024 and 32768
   more: transforms grow with log B, products fall with 1/B, and a response that is passed quickly is at work for at least one block. */
enum { BLOCK = PANNED_BLOCK, SIZE = 2 * BLOCK, BINS = BLOCK + 1 };

struct panned {
    struct arena *arena;
    struct fft *fft;
    struct panned_source source;
    size_t parts;
    long now, next;         /* sample about to be given out; next block             */
    struct product_spectrum *h;     /* [n], each [parts][BINS]; re NULL: not needed yet      */
    struct product_spectrum sum;    /* [parts][BINS]: spectra of this and later blocks       */
    bool *used;             /* [parts]: is there anything in it                      */
    struct product_spectrum x;      /* [BINS]                                                */
    double *time, *share;   /* [SIZE], [BLOCK]                                       */
    double *sound, *rest;   /* [BLOCK]: of the block given out, and what it leaves to the next */
};

static struct product_spectrum take(struct arena *a, size_t n)
{
    double *both = ARENA_TAKE(a, double, 2 * n);
    return (struct product_spectrum){both, both + n};
}

static size_t parts_of(size_t length)
{
    return (length + BLOCK - 1) / BLOCK;
}

/* The sum's spectra are one response more. */
double panned_bytes(int n, size_t length)
{
    return (n + 1.0) * (double)parts_of(length) * BINS * 2 * sizeof(double);
}

struct panned *panned_open(const struct panned_source *source)
{
    struct arena *a = arena_open();
    struct panned *p = ARENA_TAKE(a, struct panned, 1);
    *p = (struct panned){.arena = a, .source = *source, .fft = fft_open(SIZE), .parts = parts_of(source->length)};
    p->h = ARENA_TAKE(a, struct product_spectrum, source->n + 1);
    p->sum = take(a, p->parts * BINS);
    p->used = ARENA_TAKE(a, bool, p->parts);
    p->x = take(a, BINS);
    p->time = ARENA_TAKE(a, double, SIZE);
    p->share = ARENA_TAKE(a, double, BLOCK);
    p->sound = ARENA_TAKE(a, double, BLOCK);
    p->rest = ARENA_TAKE(a, double, BLOCK);
    return p;
}

void panned_close(struct panned *p)
{
    fft_close(p->fft);
    arena_close(p->arena);
}

int panned_ahead(const struct panned *p)
{
    (void)p;
    return BLOCK - 1;
}

/* The spectra of response k, divided by SIZE, since FFTW's inverse is not. */
static void prepare(struct panned *p, int k)
{
    size_t length = p->source.length;
    struct arena *a = arena_open();
    double *whole = ARENA_TAKE(a, double, length);
    p->h[k] = take(p->arena, p->parts * BINS);
    p->source.response(p->source.self, k, whole, length);
    for (size_t q = 0; q < p->parts; q++) {
        size_t n = length - q * BLOCK < BLOCK ? length - q * BLOCK : BLOCK;
        memset(p->time, 0, SIZE * sizeof *p->time);
        for (size_t i = 0; i < n; i++)
            p->time[i] = whole[q * BLOCK + i] / SIZE;
        fft_forward(p->fft, p->time, p->h[k].re + q * BINS, p->h[k].im + q * BINS);
    }
    arena_close(a);
}

static bool silent(const double *x)
{
    for (int i = 0; i < BLOCK; i++)
        if (x[i] != 0.0)
            return false;
    return true;
}

/* What response k will say to block `now` of the force. */
static void launch(struct panned *p, int k, const double *f)
{
    if (!p->source.share(p->source.self, p->now, BLOCK, k, p->share))
        return;
    for (int i = 0; i < BLOCK; i++)
        p->share[i] *= f[i];
    if (silent(p->share))
        return;
    if (!p->h[k].re)
        prepare(p, k);
    memcpy(p->time, p->share, BLOCK * sizeof *p->time);
    memset(p->time + BLOCK, 0, BLOCK * sizeof *p->time);
    fft_forward(p->fft, p->time, p->x.re, p->x.im);
    for (size_t q = 0; q < p->parts; q++) {
        size_t slot = ((size_t)p->next + q) % p->parts, H = q * BINS, Y = slot * BINS;
        product_add(BINS, (struct product_spectrum){p->h[k].re + H, p->h[k].im + H}, p->x, (struct product_spectrum){p->sum.re + Y, p->sum.im + Y});
        p->used[slot] = true;
    }
}

/* The block that starts at p->now, whose force f points at. */
static void run_block(struct panned *p, const double *f)
{
    size_t slot = (size_t)p->next % p->parts;
    double *re = p->sum.re + slot * BINS, *im = p->sum.im + slot * BINS;
    if (!silent(f))
        for (int k = 0; k < p->source.n; k++)
            launch(p, k, f);
    memset(p->time, 0, SIZE * sizeof *p->time);
    if (p->used[slot]) {
        fft_inverse(p->fft, re, im, p->time);
        memset(re, 0, BINS * sizeof *re);
        memset(im, 0, BINS * sizeof *im);
        p->used[slot] = false;
    }
    for (int i = 0; i < BLOCK; i++) {
        p->sound[i] = p->rest[i] + p->time[i];
        p->rest[i] = p->time[BLOCK + i];
    }
    p->next++;
}

void panned_run(struct panned *p, const double *f, double *y, long frames)
{
    for (long done = 0; done < frames;) {
        if (p->now == p->next * BLOCK)
            run_block(p, f + done);
        long left = p->next * BLOCK - p->now, n = left < frames - done ? left : frames - done;
        for (long i = 0; i < n; i++)
            y[done + i] += p->sound[BLOCK - left + i];
        p->now += n;
        done += n;
    }
}
