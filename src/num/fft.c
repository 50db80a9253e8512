/* FFTW's real transforms through its guru interface for split arrays. One plan has work arrays of its own, because FFTW
   asks that re and im lie as far apart when a plan runs as when it was made, and because its inverse destroys its
   input.

   A program that makes thousands of transforms of a few sizes keeps them (fft_cache_plans): making one takes 19 million
   instructions at 16 000 points, running it 2. A plan may be run on other arrays than it was made for, by several
   threads at once.

   Without SIMD the codelets are the same on every CPU; its twiddle factors, which it takes from sincos, are made so by
   num/sincos.h. tests/unit/test_fft.c pins the bits. */
#include "num/fft.h"

#include <fftw3.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "num/planner.h"
#include "num/sincos.h"

/* FFTW_UNALIGNED: callers' x may lie anywhere; without SIMD it costs nothing. */
enum { FLAGS = FFTW_ESTIMATE | FFTW_NO_SIMD | FFTW_UNALIGNED, CACHED_MOST = 64 /* plans */, CACHED_POINTS = 1 << 16 };

struct plans {
    size_t n;
    fftw_plan forward, inverse;
    bool cached;
    struct plans *next; /* of those kept */
};

struct fft {
    size_t n, bins; /* bins = n/2 + 1 */
    struct plans *plans;
    double *spectrum; /* re[bins], im[bins] */
    double *time;     /* [n] */
};

static struct { /* between planner_lock and planner_unlock only */
    bool on;
    int n;
    struct plans *first;
} keeping;

static void *or_end(void *p, size_t n)
{
    if (!p) memory_out("FFT of %zu points", n);
    return p;
}

/* Wisdom, which FFTW gathers even when it estimates, is forgotten first: a plan must not depend on those made before
 * it. */
static struct plans *plans_make(const struct fft *f)
{
    fftw_iodim64 dim = {.n = (ptrdiff_t)f->n, .is = 1, .os = 1};
    double *re = f->spectrum, *im = f->spectrum + f->bins;
    struct plans *p = or_end(calloc(1, sizeof *p), f->n);
    p->n = f->n;
    fftw_forget_wisdom();
    p->forward =
        or_end(fftw_plan_guru64_split_dft_r2c(1, &dim, 0, NULL, f->time, re, im, FLAGS | FFTW_PRESERVE_INPUT), f->n);
    p->inverse =
        or_end(fftw_plan_guru64_split_dft_c2r(1, &dim, 0, NULL, re, im, f->time, FLAGS | FFTW_DESTROY_INPUT), f->n);
    p->cached = keeping.on && keeping.n < CACHED_MOST && f->n <= CACHED_POINTS;
    if (p->cached) {
        p->next = keeping.first;
        keeping.first = p;
        keeping.n++;
    }
    return p;
}

static struct plans *plans_of(const struct fft *f)
{
    struct plans *p = keeping.first;
    while (p && p->n != f->n)
        p = p->next;
    return p ? p : plans_make(f);
}

static void plans_drop(struct plans *p)
{
    fftw_destroy_plan(p->forward);
    fftw_destroy_plan(p->inverse);
    free(p);
}

void fft_cache_plans(bool on)
{
    planner_lock();
    for (struct plans *p = on ? NULL : keeping.first, *next; p; p = next) {
        next = p->next;
        plans_drop(p);
    }
    if (!on) keeping.first = NULL, keeping.n = 0;
    keeping.on = on;
    planner_unlock();
}

struct fft *fft_open(size_t n)
{
    struct fft *f = or_end(fftw_malloc(sizeof *f), n);
    *f = (struct fft){.n = n, .bins = n / 2 + 1};
    f->spectrum = or_end(fftw_malloc(2 * f->bins * sizeof(double)), n);
    f->time = or_end(fftw_malloc(n * sizeof(double)), n);
    sincos_link();
    planner_lock();
    f->plans = plans_of(f);
    planner_unlock();
    return f;
}

void fft_close(struct fft *f)
{
    if (!f) return;
    if (!f->plans->cached) {
        planner_lock();
        plans_drop(f->plans);
        planner_unlock();
    }
    fftw_free(f->spectrum);
    fftw_free(f->time);
    fftw_free(f);
}

void fft_forward(struct fft *f, const double *x, double *re, double *im)
{
    memcpy(f->time, x, f->n * sizeof *x);
    fftw_execute_split_dft_r2c(f->plans->forward, f->time, f->spectrum, f->spectrum + f->bins);
    memcpy(re, f->spectrum, f->bins * sizeof *re);
    memcpy(im, f->spectrum + f->bins, f->bins * sizeof *im);
}

void fft_inverse(struct fft *f, const double *re, const double *im, double *x)
{
    memcpy(f->spectrum, re, f->bins * sizeof *re);
    memcpy(f->spectrum + f->bins, im, f->bins * sizeof *im);
    fftw_execute_split_dft_c2r(f->plans->inverse, f->spectrum, f->spectrum + f->bins, f->time);
    memcpy(x, f->time, f->n * sizeof *x);
}

static size_t without(size_t n, size_t factor)
{
    while (n % factor == 0)
        n /= factor;
    return n;
}

size_t fft_good_size(size_t n)
{
    size_t m = n < 2 ? 2 : n + n % 2;
    while (without(without(without(m, 2), 3), 5) != 1)
        m += 2;
    return m;
}
