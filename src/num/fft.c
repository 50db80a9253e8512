/* FFTW's real transforms through its guru interface for split arrays. One plan has work arrays of its own, because FFTW asks that
   re and im lie as far apart when a plan runs as when it was made, and because its inverse destroys its input.

   Without SIMD the codelets are the same on every CPU; its twiddle factors, which it takes from sincos, are made so by
   num/sincos.h. tests/unit/test_fft.c pins the bits. */
#include "num/fft.h"

#include <fftw3.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/err.h"
#include "num/sincos.h"

/* FFTW_UNALIGNED: callers' x may lie anywhere; without SIMD it costs nothing. */
enum { FLAGS = FFTW_ESTIMATE | FFTW_NO_SIMD | FFTW_UNALIGNED };

struct fft {
    size_t n, bins; /* bins = n/2 + 1 */
    fftw_plan forward, inverse;
    double *spectrum; /* re[bins], im[bins] */
    double *time;     /* [n] */
};

static void *or_end(void *p, size_t n)
{
    if (p)
        return p;
    fprintf(stderr, "rasp: error: out of memory (FFT of %zu points)\n", n);
    _exit(ERR_MEMORY);
}

/* Wisdom, which FFTW gathers even when it estimates, is forgotten first: a plan must not depend on those made before it. */
struct fft *fft_open(size_t n)
{
    struct fft *f = or_end(fftw_malloc(sizeof *f), n);
    *f = (struct fft){.n = n, .bins = n / 2 + 1};
    f->spectrum = or_end(fftw_malloc(2 * f->bins * sizeof(double)), n);
    f->time = or_end(fftw_malloc(n * sizeof(double)), n);
    fftw_iodim64 dim = {.n = (ptrdiff_t)n, .is = 1, .os = 1};
    double *re = f->spectrum, *im = f->spectrum + f->bins;
    sincos_keep();
    fftw_forget_wisdom();
    f->forward = or_end(fftw_plan_guru64_split_dft_r2c(1, &dim, 0, NULL, f->time, re, im, FLAGS | FFTW_PRESERVE_INPUT), n);
    f->inverse = or_end(fftw_plan_guru64_split_dft_c2r(1, &dim, 0, NULL, re, im, f->time, FLAGS | FFTW_DESTROY_INPUT), n);
    return f;
}

void fft_close(struct fft *f)
{
    if (!f)
        return;
    fftw_destroy_plan(f->forward);
    fftw_destroy_plan(f->inverse);
    fftw_free(f->spectrum);
    fftw_free(f->time);
    fftw_free(f);
}

void fft_forward(struct fft *f, const double *x, double *re, double *im)
{
    memcpy(f->time, x, f->n * sizeof *x);
    fftw_execute(f->forward);
    memcpy(re, f->spectrum, f->bins * sizeof *re);
    memcpy(im, f->spectrum + f->bins, f->bins * sizeof *im);
}

void fft_inverse(struct fft *f, const double *re, const double *im, double *x)
{
    memcpy(f->spectrum, re, f->bins * sizeof *re);
    memcpy(f->spectrum + f->bins, im, f->bins * sizeof *im);
    fftw_execute(f->inverse);
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
