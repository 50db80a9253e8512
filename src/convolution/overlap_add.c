/* Fast convolution with an impulse response that may move with the contact (papers/000 eq. 13, every force sample launching the
   response of its own place).

   Moving, order p = 1, 2, 4.  Nodes stand every `hop` samples; node k's response is h_k.

       y(n) = sum_k sum_m h_k(n-m) w(m/hop - k) f(m),   w(u) for |u| < p/2:
       p = 1:  1 for -1/2 <= u < 1/2                       (the nearest node's response)
       p = 2:  1 - |u|                                     (linear between nodes)
       p = 4:  (1 - u^2)(2 - |u|)/2          for |u| <= 1  (cubic Lagrange over four nodes)
               (1 - |u|)(2 - |u|)(3 - |u|)/6 for |u| > 1

   The w of all nodes sum to 1 at every sample. The error against a response that moves at every sample is of order hop^p in
   h's change (6, 12, 24 dB per halving). A node: p hop samples of force times w, zero-padded FFT, times the FFT of h_k, back, added
   to a ring of sound. Nodes under whose window there is no force are neither asked for nor computed.

   At rest, order 0.  Uniform partitions of B = 1024 samples, FFT of 2 B, overlap-save: block j of sound is the second half of
   IFFT(sum_q H_q X_{j-q}), X_j the spectrum of force blocks j-1 and j. Exact to rounding.

   Nodes and blocks stand at fixed sample numbers, a block of sound is complete before its first sample is given out, and additions
   run in the order of nodes (partitions): the result does not depend on how the sound is cut into calls. */
#include "convolution/overlap_add.h"

#include <string.h>

#include "convolution/cardinal.h"
#include "convolution/product.h"
#include "num/fft.h"

enum { BLOCK = 1024 };

struct overlap_add {
    struct arena *arena;
    struct fft *fft;
    overlap_add_response *response;
    void *self;
    int order, hop, count;             /* count: samples of force that a node or block takes           */
    size_t length, size, bins;         /* of h; of the FFT; size/2 + 1                                  */
    long now, next;                    /* sample about to be given out; next node or block             */
    double per_size, *x, *h, *re, *im; /* [size] twice, [bins] twice; at rest h is the block given out */
    double *window, *ring, *kr, *ki;   /* moving: [count], [size], [bins] twice                         */
    size_t parts, newest;              /* at rest: partitions; where the newest spectrum is             */
    double *Hr, *Hi, *Xr, *Xi;         /* at rest: [parts][bins]                                        */
};

/* ------------------------------------------------------------------ moving */

static void open_moving(struct overlap_add *o)
{
    o->kr = ARENA_TAKE(o->arena, double, o->bins);
    o->ki = ARENA_TAKE(o->arena, double, o->bins);
    o->window = ARENA_TAKE(o->arena, double, o->count);
    o->ring = ARENA_TAKE(o->arena, double, o->size);
    cardinal_window(o->order, o->hop, o->window);
    while (cardinal_start(o->order, o->hop, o->next) + o->count > 0) /* back to the first node whose window reaches sample 0 */
        o->next--;
    o->next++;
}

/* f points at the force of sample o->now, which is the window's start, or 0 when the window starts before the sound. */
static void run_node(struct overlap_add *o, const double *f)
{
    long k = o->next++;
    int skip = (int)(o->now - cardinal_start(o->order, o->hop, k)), n = o->count - skip;
    if (product_nothing(f, n))
        return;
    memset(o->x, 0, o->size * sizeof *o->x);
    memset(o->h, 0, o->size * sizeof *o->h);
    for (int j = 0; j < n; j++)
        o->x[j] = o->window[skip + j] * f[j];
    o->response(o->self, k, o->h, o->length);
    fft_forward(o->fft, o->x, o->re, o->im);
    fft_forward(o->fft, o->h, o->kr, o->ki);
    product_multiply(o->bins, (struct product_spectrum){o->kr, o->ki}, (struct product_spectrum){o->re, o->im});
    fft_inverse(o->fft, o->re, o->im, o->x);
    size_t at = (size_t)o->now % o->size, used = o->length + (size_t)n - 1;
    for (size_t j = 0; j < used; j++, at = at + 1 == o->size ? 0 : at + 1)
        o->ring[at] += o->x[j] * o->per_size;
}

/* Gives out the ring up to the next node, at most `most` frames; returns how many. */
static long give_moving(struct overlap_add *o, const double *f, double *y, long most)
{
    while (cardinal_start(o->order, o->hop, o->next) <= o->now)
        run_node(o, f);
    long until = cardinal_start(o->order, o->hop, o->next) - o->now, n = until < most ? until : most;
    size_t at = (size_t)o->now % o->size;
    for (long i = 0; i < n; i++, at = at + 1 == o->size ? 0 : at + 1) {
        y[i] += o->ring[at];
        o->ring[at] = 0.0;
    }
    return n;
}

/* ------------------------------------------------------------------ at rest */

static void open_at_rest(struct overlap_add *o)
{
    double *whole = ARENA_TAKE(o->arena, double, o->length);
    o->response(o->self, 0, whole, o->length);
    o->parts = (o->length + BLOCK - 1) / BLOCK;
    o->Hr = ARENA_TAKE(o->arena, double, o->parts * o->bins);
    o->Hi = ARENA_TAKE(o->arena, double, o->parts * o->bins);
    o->Xr = ARENA_TAKE(o->arena, double, o->parts * o->bins);
    o->Xi = ARENA_TAKE(o->arena, double, o->parts * o->bins);
    for (size_t q = 0; q < o->parts; q++) {
        size_t n = o->length - q * BLOCK < BLOCK ? o->length - q * BLOCK : BLOCK;
        memset(o->h, 0, o->size * sizeof *o->h);
        for (size_t j = 0; j < n; j++)
            o->h[j] = whole[q * BLOCK + j] * o->per_size;
        fft_forward(o->fft, o->h, o->Hr + q * o->bins, o->Hi + q * o->bins);
    }
}

/* The block that starts at o->now, whose force f points at. */
static void run_block(struct overlap_add *o, const double *f)
{
    o->next++;
    memmove(o->x, o->x + BLOCK, BLOCK * sizeof *o->x);
    memcpy(o->x + BLOCK, f, BLOCK * sizeof *o->x);
    o->newest = (o->newest + o->parts - 1) % o->parts;
    fft_forward(o->fft, o->x, o->Xr + o->newest * o->bins, o->Xi + o->newest * o->bins);
    memset(o->re, 0, o->bins * sizeof *o->re);
    memset(o->im, 0, o->bins * sizeof *o->im);
    for (size_t q = 0; q < o->parts; q++) {
        size_t X = (o->newest + q) % o->parts * o->bins, H = q * o->bins;
        product_add(o->bins, (struct product_spectrum){o->Xr + X, o->Xi + X}, (struct product_spectrum){o->Hr + H, o->Hi + H},
                     (struct product_spectrum){o->re, o->im});
    }
    fft_inverse(o->fft, o->re, o->im, o->h);
}

static long give_at_rest(struct overlap_add *o, const double *f, double *y, long most)
{
    if (o->now == o->next * BLOCK)
        run_block(o, f);
    long left = o->next * BLOCK - o->now, n = left < most ? left : most;
    const double *sound = o->h + 2 * BLOCK - left;
    for (long i = 0; i < n; i++)
        y[i] += sound[i];
    return n;
}

/* ------------------------------------------------------------------ both */

struct overlap_add *overlap_add_open(size_t length, int order, int hop, overlap_add_response *response, void *self)
{
    struct arena *a = arena_open();
    struct overlap_add *o = ARENA_TAKE(a, struct overlap_add, 1);
    *o = (struct overlap_add){.arena = a, .response = response, .self = self, .order = order, .hop = hop, .length = length};
    o->count = order ? order * hop : BLOCK;
    o->size = order ? fft_good_size(length + (size_t)o->count - 1) : 2 * BLOCK;
    o->per_size = 1.0 / (double)o->size;
    o->bins = o->size / 2 + 1;
    o->fft = fft_open(o->size);
    o->x = ARENA_TAKE(a, double, o->size);
    o->h = ARENA_TAKE(a, double, o->size);
    o->re = ARENA_TAKE(a, double, o->bins);
    o->im = ARENA_TAKE(a, double, o->bins);
    if (order == 0)
        open_at_rest(o);
    else
        open_moving(o);
    return o;
}

void overlap_add_close(struct overlap_add *o)
{
    fft_close(o->fft);
    arena_close(o->arena);
}

int overlap_add_ahead(const struct overlap_add *o)
{
    return o->count - 1;
}

void overlap_add_run(struct overlap_add *o, const double *f, double *y, long frames)
{
    for (long done = 0; done < frames;) {
        long n = o->order ? give_moving(o, f + done, y + done, frames - done) : give_at_rest(o, f + done, y + done, frames - done);
        o->now += n;
        done += n;
    }
}
