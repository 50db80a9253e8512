/* See fft_plane.h, and num/fft.c for why the flags are these. */
#include "num/fft_plane.h"

#include <fftw3.h>

#include "base/memory.h"
#include "num/planner.h"
#include "num/sincos.h"

struct fft_plane {
    size_t n;
    fftw_plan inverse;
    double *re, *im, *x;
};

static void *or_end(void *p, size_t n)
{
    if (!p) memory_out("FFT of %zu x %zu points", n, n);
    return p;
}

struct fft_plane *fft_plane_open(size_t n)
{
    struct fft_plane *f = or_end(fftw_malloc(sizeof *f), n);
    size_t half = n / 2 + 1;
    *f = (struct fft_plane){.n = n};
    f->re = or_end(fftw_malloc(2 * n * half * sizeof(double)), n);
    f->im = f->re + n * half;
    f->x = or_end(fftw_malloc(n * n * sizeof(double)), n);
    fftw_iodim64 dims[2] = {{.n = (ptrdiff_t)n, .is = (ptrdiff_t)half, .os = (ptrdiff_t)n},
                            {.n = (ptrdiff_t)n, .is = 1, .os = 1}};
    sincos_link();
    planner_lock();
    fftw_forget_wisdom();
    f->inverse = or_end(fftw_plan_guru64_split_dft_c2r(2, dims, 0, NULL, f->re, f->im, f->x,
                                                       FFTW_ESTIMATE | FFTW_NO_SIMD | FFTW_DESTROY_INPUT),
                        n);
    planner_unlock();
    return f;
}

void fft_plane_close(struct fft_plane *f)
{
    if (!f) return;
    planner_lock();
    fftw_destroy_plan(f->inverse);
    planner_unlock();
    fftw_free(f->re);
    fftw_free(f->x);
    fftw_free(f);
}

double *fft_plane_re(struct fft_plane *f) { return f->re; }

double *fft_plane_im(struct fft_plane *f) { return f->im; }

const double *fft_plane_inverse(struct fft_plane *f)
{
    fftw_execute(f->inverse);
    return f->x;
}
