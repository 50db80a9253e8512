/* fft against the sum that defines it, in long double, and against transforms known in closed form. FFTW's error grows
   like sqrt(log n) times the root mean square of the spectrum; UNITS bounds its largest element in those units of
   2^-53. */
#include "num/fft.h"

#include <fftw3.h>
#include <stdint.h>

#include "unit.h"

enum { LARGEST = 4096, BINS = LARGEST / 2 + 1 };
#define UNITS 6
#define FLAGS (FFTW_ESTIMATE | FFTW_NO_SIMD | FFTW_UNALIGNED | FFTW_PRESERVE_INPUT)

static const size_t sizes[] = {2, 4, 6, 30, 64, 1000, 4096};
enum { SIZES = sizeof sizes / sizeof sizes[0] };

static void fill(double *x, size_t n, uint64_t state)
{
    for (size_t i = 0; i < n; i++) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        x[i] = (double)(state >> 11) * 0x1p-52 - 1;
    }
}

static double largest_allowed(size_t n, double rms) { return UNITS * 0x1p-53 * sqrt(log2((double)n)) * rms; }

/* X[k] = sum of x[j] exp(-2 pi i j k/n); the angles from one table of n, exact in j k mod n. */
static void slow(size_t n, const double *x, long double *re, long double *im)
{
    static long double cosine[LARGEST], sine[LARGEST];
    for (size_t j = 0; j < n; j++) {
        cosine[j] = cosl(2 * M_PIl * j / n);
        sine[j] = sinl(2 * M_PIl * j / n);
    }
    for (size_t k = 0; k <= n / 2; k++) {
        re[k] = im[k] = 0;
        for (size_t j = 0; j < n; j++) {
            re[k] += x[j] * cosine[j * k % n];
            im[k] -= x[j] * sine[j * k % n];
        }
    }
}

START_TEST(forward_is_the_sum)
{
    static double x[LARGEST], kept[LARGEST], re[BINS], im[BINS];
    static long double want_re[BINS], want_im[BINS];
    for (int s = 0; s < SIZES; s++) {
        size_t n = sizes[s];
        struct fft *f = fft_open(n);
        double most = 0, allowed = largest_allowed(n, sqrt((double)n / 3));
        fill(x, n, n);
        memcpy(kept, x, sizeof x);
        fft_forward(f, x, re, im);
        ck_assert_mem_eq(kept, x, sizeof x);
        slow(n, x, want_re, want_im);
        for (size_t k = 0; k <= n / 2; k++)
            most = fmax(most, (double)fmaxl(fabsl(re[k] - want_re[k]), fabsl(im[k] - want_im[k])));
        printf("n = %4zu: error %.3g, allowed %.3g\n", n, most, allowed);
        ck_assert_double_le(most, allowed);
        ck_assert(im[0] == 0 && im[n / 2] == 0);
        fft_close(f);
    }
}
END_TEST

START_TEST(inverse_undoes_forward)
{
    static double x[LARGEST], y[LARGEST], re[BINS], im[BINS], kept[2][BINS];
    for (int s = 0; s < SIZES; s++) {
        size_t n = sizes[s];
        struct fft *f = fft_open(n);
        fill(x, n, 7 * n);
        fft_forward(f, x, re, im);
        memcpy(kept[0], re, sizeof re);
        memcpy(kept[1], im, sizeof im);
        fft_inverse(f, re, im, y);
        ck_assert_mem_eq(kept[0], re, sizeof re);
        ck_assert_mem_eq(kept[1], im, sizeof im);
        for (size_t i = 0; i < n; i++) /* two transforms */
            ck_assert_double_le(fabs(y[i] / (double)n - x[i]), 2 * largest_allowed(n, 1));
        fft_close(f);
    }
}
END_TEST

/* A spectrum that no forward transform made, against the slow sum of the inverse. */
START_TEST(inverse_is_the_sum)
{
    static double re[BINS], im[BINS], x[LARGEST];
    for (int s = 0; s < SIZES - 1; s++) {
        size_t n = sizes[s], last = n / 2;
        struct fft *f = fft_open(n);
        fill(re, last + 1, 3);
        fill(im, last + 1, 4);
        im[0] = im[last] = 0;
        fft_inverse(f, re, im, x);
        for (size_t j = 0; j < n; j++) {
            long double sum = re[0] + (j % 2 ? -re[last] : re[last]);
            for (size_t k = 1; k < last; k++) {
                long double a = 2 * M_PIl * (j * k % n) / n;
                sum += 2 * (re[k] * cosl(a) - im[k] * sinl(a));
            }
            ck_assert_double_le((double)fabsl(x[j] - sum), largest_allowed(n, sqrt((double)n)));
        }
        fft_close(f);
    }
}
END_TEST

/* sum x^2 = (|X[0]|^2 + 2 sum |X[k]|^2 + |X[n/2]|^2)/n. */
START_TEST(parseval)
{
    static double x[LARGEST], re[BINS], im[BINS];
    for (int s = 0; s < SIZES; s++) {
        size_t n = sizes[s];
        struct fft *f = fft_open(n);
        long double time = 0, frequency = 0;
        fill(x, n, 11 * n);
        fft_forward(f, x, re, im);
        for (size_t i = 0; i < n; i++)
            time += (long double)x[i] * x[i];
        for (size_t k = 0; k <= n / 2; k++)
            frequency += (k == 0 || k == n / 2 ? 1 : 2) * ((long double)re[k] * re[k] + (long double)im[k] * im[k]);
        ck_assert_double_le((double)fabsl(frequency / n / time - 1), 1e-15);
        fft_close(f);
    }
}
END_TEST

/* The impulse at d has X[k] = exp(-2 pi i k d/n); at d = 0 every bin is exactly 1. */
START_TEST(impulses)
{
    static double x[LARGEST], re[BINS], im[BINS];
    for (int s = 0; s < SIZES; s++)
        for (size_t d = 0; d < 2; d++) {
            size_t n = sizes[s];
            struct fft *f = fft_open(n);
            memset(x, 0, sizeof x);
            x[d] = 1;
            fft_forward(f, x, re, im);
            for (size_t k = 0; k <= n / 2; k++) {
                long double a = 2 * M_PIl * (d * k) / n;
                double allowed = d ? 1e-15 : 0;
                ck_assert_double_le((double)fabsl(re[k] - cosl(a)), allowed);
                ck_assert_double_le((double)fabsl(im[k] + sinl(a)), allowed);
            }
            fft_close(f);
        }
}
END_TEST

/* Shifting x by d turns bin k by -2 pi k d/n. */
START_TEST(shift)
{
    enum { N = 1000, D = 37 };
    double x[N], y[N], a[2][N / 2 + 1], b[2][N / 2 + 1];
    struct fft *f = fft_open(N);
    fill(x, N, 5);
    for (int i = 0; i < N; i++)
        y[(i + D) % N] = x[i];
    fft_forward(f, x, a[0], a[1]);
    fft_forward(f, y, b[0], b[1]);
    for (int k = 0; k <= N / 2; k++) {
        long double c = cosl(2 * M_PIl * (k * D % N) / N), s = sinl(2 * M_PIl * (k * D % N) / N);
        ck_assert_double_le((double)fabsl(b[0][k] - (a[0][k] * c + a[1][k] * s)),
                            3 * largest_allowed(N, sqrt(N / 3.0)));
        ck_assert_double_le((double)fabsl(b[1][k] - (a[1][k] * c - a[0][k] * s)),
                            3 * largest_allowed(N, sqrt(N / 3.0)));
    }
    fft_close(f);
}
END_TEST

/* Plans of other sizes and flags made before must not change the bits (FFTW keeps what it learns). */
START_TEST(earlier_plans_do_not_matter)
{
    static double x[LARGEST], first[2][BINS], again[2][BINS];
    fill(x, LARGEST, 1);
    struct fft *f = fft_open(LARGEST);
    fft_forward(f, x, first[0], first[1]);
    fft_close(f);
    double *in = fftw_malloc(sizeof x), *out = fftw_malloc(sizeof x);
    fftw_destroy_plan(fftw_plan_r2r_1d(LARGEST, in, out, FFTW_R2HC, FLAGS & ~FFTW_ESTIMATE));
    fftw_free(in);
    fftw_free(out);
    for (size_t n = 2; n < 3000; n = 3 * n / 2 + n / 2 % 2)
        fft_close(fft_open(n + n % 2));
    f = fft_open(LARGEST);
    fft_forward(f, x, again[0], again[1]);
    fft_close(f);
    ck_assert_mem_eq(first, again, sizeof first);
}
END_TEST

/* The same plan made here names no SIMD codelet, and fft's bits are its bits (with SIMD they are others). */
START_TEST(no_simd)
{
    static double re[BINS], im[BINS];
    for (int s = 0; s < SIZES; s++) {
        size_t n = sizes[s];
        double *x = fftw_malloc(LARGEST * sizeof(double)), *out = fftw_malloc(LARGEST * sizeof(double));
        fftw_forget_wisdom();
        fftw_plan p = fftw_plan_r2r_1d((int)n, x, out, FFTW_R2HC, FLAGS);
        char *text = fftw_sprint_plan(p);
        ck_assert_msg(!strstr(text, "avx") && !strstr(text, "sse") && !strstr(text, "fv_"), "%s", text);
        fill(x, n, 2);
        fftw_execute(p);
        struct fft *f = fft_open(n);
        fft_forward(f, x, re, im);
        ck_assert_mem_eq(re, out, (n / 2 + 1) * sizeof(double));
        ck_assert(im[0] == 0 && im[n / 2] == 0);
        for (size_t k = 1; k < n / 2; k++)
            ck_assert(im[k] == out[n - k]);
        fft_close(f);
        fftw_destroy_plan(p);
        free(text);
        fftw_free(x);
        fftw_free(out);
    }
}
END_TEST

/* The hash was made by this test with FFTW 3.3.10. It fails if FFTW has its twiddle factors from libm, whose sincos
   gives other bits on CPUs with and without FMA (GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-AVX2 shows it). */
START_TEST(same_bits_everywhere)
{
    static double x[LARGEST], re[BINS], im[BINS];
    uint64_t h = 0xcbf29ce484222325;
    for (size_t n = 2; n <= LARGEST; n = fft_good_size(5 * n / 4 + 1)) {
        struct fft *f = fft_open(n);
        fill(x, n, 6);
        fft_forward(f, x, re, im);
        fft_inverse(f, re, im, x);
        for (size_t i = 0; i < n; i++) {
            uint64_t u;
            memcpy(&u, &x[i], sizeof u);
            h = (h ^ u) * 0x100000001b3;
        }
        fft_close(f);
    }
    printf("hash %016llx\n", (unsigned long long)h);
    ck_assert_uint_eq(h, 0x9db3f7886dbb6012);
}
END_TEST

/* Every product 2^a 3^b 5^c up to a limit is marked, then looked up. */
START_TEST(good_size)
{
    enum { LIMIT = 100000 };
    static char good[LIMIT + 1];
    for (size_t a = 2; a <= LIMIT; a *= 2)
        for (size_t b = a; b <= LIMIT; b *= 3)
            for (size_t c = b; c <= LIMIT; c *= 5)
                good[c] = 1;
    for (size_t n = 0; n <= 98304; n++) {
        size_t m = n;
        while (!good[m])
            m++;
        ck_assert_uint_eq(fft_good_size(n), m);
    }
}
END_TEST

UNIT("fft", forward_is_the_sum, inverse_undoes_forward, inverse_is_the_sum, parseval, impulses, shift,
     earlier_plans_do_not_matter, no_simd, same_bits_everywhere, good_size)
