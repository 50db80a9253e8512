/* A response that is read where the contact is now: y(t) = sum_m h_{x(t)}(t - m) f(m), the whole past sounding through the present response
   (papers/000 equation 13 read literally; not physical: what rings is not retuned but replaced).

   Nodes stand every `hop` samples, h_k is the response there, w_k the cardinal windows of order p = 1, 2, 4 (convolution/cardinal.h), now over
   the sound:

       y(t) = sum_k w_k(t) (h_k * f)(t)

   The error against a response that moves at every sample is of order hop^p in h's change: 6, 12, 24 dB per halving. The transpose of
   overlap_add.c: a node takes the p hop samples of force under its window and the length - 1 before them, one FFT of both, times the
   FFT of h_k, back; the first length - 1 samples are wrapped and dropped (overlap-save), the rest is windowed and added to the sound. Three FFTs
   of length + p hop a node, as there. Nodes that no force reaches are neither asked for nor computed.

   Where h does not move the windows sum to 1 and what is left is (h * f)(t). Nodes stand at fixed sample numbers, each is complete before
   the first sample of its window is given out, and additions run in their order: the result does not depend on how the sound is cut into calls. */
#include "convolution/readout.h"

#include <stdbool.h>
#include <string.h>

#include "convolution/cardinal.h"
#include "convolution/product.h"
#include "num/fft.h"

struct readout {
    struct arena *arena;
    struct fft *fft;
    overlap_add_response *response;
    void *self;
    int order, hop, count;         /* count: samples under a window                                    */
    size_t length, size, bins;     /* of h; of the FFT; size/2 + 1                                      */
    long now, next;                /* sample about to be given out; next node                          */
    double per_size, *x, *h;       /* [size]                                                           */
    double *re, *im, *kr, *ki;     /* [bins]                                                           */
    double *window, *ring;         /* [count]                                                          */
    double *past;                  /* [length - 1] force before `now`, the oldest at `oldest`          */
    size_t oldest;
    long quiet;                    /* samples of zero force before `now`                               */
};

struct readout *readout_open(size_t length, int order, int hop, overlap_add_response *response, void *self)
{
    struct arena *a = arena_open();
    struct readout *r = ARENA_TAKE(a, struct readout, 1);
    *r = (struct readout){.arena = a, .response = response, .self = self, .order = order, .hop = hop, .count = order * hop, .length = length};
    r->size = fft_good_size(length + (size_t)r->count - 1);
    r->bins = r->size / 2 + 1;
    r->per_size = 1.0 / (double)r->size;
    r->fft = fft_open(r->size);
    r->x = ARENA_TAKE(a, double, r->size);
    r->h = ARENA_TAKE(a, double, r->size);
    r->re = ARENA_TAKE(a, double, 4 * r->bins);
    r->im = r->re + r->bins;
    r->kr = r->im + r->bins;
    r->ki = r->kr + r->bins;
    r->window = ARENA_TAKE(a, double, r->count);
    r->ring = ARENA_TAKE(a, double, r->count);
    r->past = ARENA_TAKE(a, double, length);
    r->quiet = (long)length - 1;
    cardinal_window(order, hop, r->window);
    while (cardinal_start(order, hop, r->next) + r->count > 0) /* back to the first node whose window reaches sample 0 */
        r->next--;
    r->next++;
    return r;
}

void readout_close(struct readout *r)
{
    fft_close(r->fft);
    arena_close(r->arena);
}

int readout_ahead(const struct readout *r)
{
    return r->count - 1;
}

/* The force before now, then n samples from f on, to x. */
static void gather(struct readout *r, const double *f, size_t n)
{
    size_t before = r->length - 1, first = before - r->oldest;
    memcpy(r->x, r->past + r->oldest, first * sizeof *r->x);
    memcpy(r->x + first, r->past, r->oldest * sizeof *r->x);
    memcpy(r->x + before, f, n * sizeof *r->x);
    memset(r->x + before + n, 0, (r->size - before - n) * sizeof *r->x);
}

static bool reached(const struct readout *r, const double *f, int n)
{
    for (int i = 0; i < n; i++)
        if (f[i] != 0.0)
            return true;
    return r->quiet < (long)r->length - 1;
}

/* f points at the force of sample r->now, which is the window's start, or 0 when the window starts before the sound. */
static void run_node(struct readout *r, const double *f)
{
    long k = r->next++;
    int skip = (int)(r->now - cardinal_start(r->order, r->hop, k)), n = r->count - skip;
    if (!reached(r, f, n))
        return;
    gather(r, f, (size_t)n);
    memset(r->h, 0, r->size * sizeof *r->h);
    r->response(r->self, k, r->h, r->length);
    fft_forward(r->fft, r->x, r->re, r->im);
    fft_forward(r->fft, r->h, r->kr, r->ki);
    product_multiply(r->bins, (struct product_spectrum){r->kr, r->ki}, (struct product_spectrum){r->re, r->im});
    fft_inverse(r->fft, r->re, r->im, r->x);
    const double *sound = r->x + r->length - 1, *window = r->window + skip;
    long at = r->now % r->count;
    for (int j = 0; j < n; j++, at = at + 1 == r->count ? 0 : at + 1)
        r->ring[at] += window[j] * (sound[j] * r->per_size);
}

static void remember(struct readout *r, const double *f, long n)
{
    size_t before = r->length - 1;
    for (long i = 0; i < n; i++) {
        r->quiet = f[i] != 0.0 ? 0 : r->quiet + 1;
        if (before)
            r->past[r->oldest] = f[i];
        r->oldest = r->oldest + 1 >= before ? 0 : r->oldest + 1;
    }
}

/* Gives out the ring up to the next node, at most `most` frames; returns how many. */
static long give(struct readout *r, const double *f, double *y, long most)
{
    while (cardinal_start(r->order, r->hop, r->next) <= r->now)
        run_node(r, f);
    long until = cardinal_start(r->order, r->hop, r->next) - r->now, n = until < most ? until : most, at = r->now % r->count;
    for (long i = 0; i < n; i++, at = at + 1 == r->count ? 0 : at + 1) {
        y[i] += r->ring[at];
        r->ring[at] = 0.0;
    }
    remember(r, f, n);
    r->now += n;
    return n;
}

void readout_run(struct readout *r, const double *f, double *y, long frames)
{
    for (long done = 0; done < frames;)
        done += give(r, f + done, y + done, frames - done);
}
