/* FFTW's real transforms to half-complex order, re[0], re[1], ..., im[2], im[1]: as fast as its transforms to split
   arrays, and planned in a fifth of the instructions.

   Plans of up to CACHED_POINTS stay until the program ends, the first CACHED_MOST of them: making one takes about as
   long as a dozen transforms. A plan may be run on other arrays than it was made for, by several threads at once.

   FFTW's planner is one for the whole program: plans are made and given up by one thread at a time.

   Without SIMD the codelets are the same on every CPU. FFTW takes its twiddle factors from libm's sincos, whose last
   bits depend on whether the CPU has fused multiply-add: so there is a function of that name here, on num/real.h. A
   program's own definition comes before libm's when the dynamic linker binds FFTW (and GSL). tests/unit/test_fft.c pins
   the bits. */
#include "num/fft.h"

#include <fftw3.h>
#include <pthread.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/stopwatch.h"
#include "num/real.h"

/* FFTW_UNALIGNED: callers' x may lie anywhere; without SIMD it costs nothing. */
enum { FLAGS = FFTW_ESTIMATE | FFTW_NO_SIMD | FFTW_UNALIGNED, CACHED_MOST = 64 /* plans */, CACHED_POINTS = 1 << 16 };

struct plans {
    size_t n;
    fftw_plan forward, inverse; /* NULL: not wanted yet */
    bool cached;
    struct plans *next; /* of those kept */
};

struct fft {
    size_t n, bins; /* bins = n/2 + 1 */
    struct plans *plans;
    double *half; /* [n], half-complex */
};

static pthread_mutex_t planner = PTHREAD_MUTEX_INITIALIZER;

static struct { /* under the planner's lock only */
    int n;
    struct plans *first;
} keeping;

/* Declared by <math.h>: sin x and cos x, x in radians, at most 1 ulp. */
void sincos(double x, double *s, double *c)
{
    *s = real_sin(x);
    *c = real_cos(x);
}

/* FFTW stops a program that has no memory left with SIGABRT: the function that it calls then is this one. The name, and
   what it is given, are FFTW's (kernel/assert.c); `p` is what its allocation gave. */
void fftw_assertion_failed(const char *what, int line, const char *file);
void fftw_assertion_failed(const char *what, int line, const char *file)
{
    if (strcmp(what, "p") == 0) memory_out("for a plan of FFTW");
    fprintf(stderr, "fftw: %s:%d: assertion failed: %s\n", file, line, what);
    abort();
}

static void *or_end(void *p, size_t n)
{
    if (!p) memory_out("FFT of %zu points", n);
    return p;
}

/* Predicted cycles of a real transform of n points, and of opening one, whose plan may be there. */
#define TRANSFORM(n) (2 * (double)(n)*real_log((double)(n)))
#define OPENED 20000.0

/* One direction, when it is first wanted: who looks at spectra needs one. Wisdom, which FFTW gathers even when it
   estimates, is forgotten first: a plan must not depend on those made before it. */
static fftw_plan plan_of(const struct fft *f, double *x, bool forward)
{
    fftw_iodim64 dim = {.n = (ptrdiff_t)f->n, .is = 1, .os = 1};
    fftw_r2r_kind kind = forward ? FFTW_R2HC : FFTW_HC2R;
    double *in = forward ? x : f->half, *out = forward ? f->half : x;
    pthread_mutex_lock(&planner);
    fftw_plan *p = forward ? &f->plans->forward : &f->plans->inverse;
    if (!*p) {
        fftw_forget_wisdom();
        *p = or_end(fftw_plan_guru64_r2r(1, &dim, 0, NULL, in, out, &kind,
                                         FLAGS | (forward ? FFTW_PRESERVE_INPUT : FFTW_DESTROY_INPUT)),
                    f->n);
    }
    pthread_mutex_unlock(&planner);
    return *p;
}

static struct plans *plans_make(const struct fft *f)
{
    struct plans *p = or_end(calloc(1, sizeof *p), f->n);
    p->n = f->n;
    p->cached = keeping.n < CACHED_MOST && f->n <= CACHED_POINTS;
    if (p->cached) {
        p->next = keeping.first;
        keeping.first = p;
        keeping.n++;
    }
    return p;
}

static void plans_drop(struct plans *p)
{
    if (p->forward) fftw_destroy_plan(p->forward);
    if (p->inverse) fftw_destroy_plan(p->inverse);
    free(p);
}

struct fft *fft_open(size_t n)
{
    struct fft *f = or_end(fftw_malloc(sizeof *f), n);
    *f = (struct fft){.n = n, .bins = n / 2 + 1};
    stopwatch_spend(OPENED);
    f->half = or_end(fftw_malloc(n * sizeof(double)), n);
    pthread_mutex_lock(&planner);
    for (f->plans = keeping.first; f->plans && f->plans->n != n;)
        f->plans = f->plans->next;
    if (!f->plans) f->plans = plans_make(f);
    pthread_mutex_unlock(&planner);
    return f;
}

void fft_close(struct fft *f)
{
    if (!f) return;
    if (!f->plans->cached) {
        pthread_mutex_lock(&planner);
        plans_drop(f->plans);
        pthread_mutex_unlock(&planner);
    }
    fftw_free(f->half);
    fftw_free(f);
}

void fft_forward(struct fft *f, const double *x, double *re, double *im)
{
    double *in = (double *)(uintptr_t)x; /* is preserved */
    stopwatch_spend(TRANSFORM(f->n));
    fftw_execute_r2r(plan_of(f, in, true), in, f->half);
    memcpy(re, f->half, f->bins * sizeof *re);
    im[0] = im[f->bins - 1] = 0;
    for (size_t k = 1; 2 * k < f->n; k++)
        im[k] = f->half[f->n - k];
}

void fft_inverse(struct fft *f, const double *re, const double *im, double *x)
{
    stopwatch_spend(TRANSFORM(f->n));
    memcpy(f->half, re, f->bins * sizeof *re);
    for (size_t k = 1; 2 * k < f->n; k++)
        f->half[f->n - k] = im[k];
    fftw_execute_r2r(plan_of(f, x, false), f->half, x);
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

static void *or_end_plane(void *p, size_t n)
{
    if (!p) memory_out("FFT of %zu x %zu points", n, n);
    return p;
}

struct fft_plane *fft_plane_open(size_t n)
{
    struct fft_plane *f = or_end_plane(fftw_malloc(sizeof *f), n);
    size_t half = n / 2 + 1;
    f->n = n;
    f->re = or_end_plane(fftw_malloc(2 * n * half * sizeof(double)), n);
    f->im = f->re + n * half;
    f->x = or_end_plane(fftw_malloc(n * n * sizeof(double)), n);
    fftw_iodim64 dims[2] = {{.n = (ptrdiff_t)n, .is = (ptrdiff_t)half, .os = (ptrdiff_t)n},
                            {.n = (ptrdiff_t)n, .is = 1, .os = 1}};
    pthread_mutex_lock(&planner);
    fftw_forget_wisdom();
    f->inverse = or_end_plane(fftw_plan_guru64_split_dft_c2r(2, dims, 0, NULL, f->re, f->im, f->x,
                                                             FFTW_ESTIMATE | FFTW_NO_SIMD | FFTW_DESTROY_INPUT),
                              n);
    pthread_mutex_unlock(&planner);
    return f;
}

void fft_plane_close(struct fft_plane *f)
{
    if (!f) return;
    pthread_mutex_lock(&planner);
    fftw_destroy_plan(f->inverse);
    pthread_mutex_unlock(&planner);
    fftw_free(f->re);
    fftw_free(f->x);
    fftw_free(f);
}

void fft_plane_inverse(struct fft_plane *f)
{
    stopwatch_spend(TRANSFORM(f->n * f->n));
    fftw_execute(f->inverse);
}
