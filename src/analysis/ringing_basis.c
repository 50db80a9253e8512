/* Damped exponentials e^(s t), s = -decay + j omega, over a whole response. t = j B/rate + k/rate: e^(s t) is a table of B = RINGING_BLOCK steps times a
   factor per block, so that projections and sounds are products of matrices (BLAS), 8 n operations per pole. Inner products are geometric sums,

     sum t^q Re a^n Re b^n = (X + Y)/2,   X = Re sum t^q (a b)^n,   Y = Re sum t^q (a conj b)^n,   and so on,

   and these are had by closed forms where poles are far from each other; these divide by (1 - e^u)^(q + 1), which cancels where poles are near and hardly damped:
   there by doubling, S(2M) = S(M) + e^(u M) S(M) shifted by M. */
#include "analysis/ringing_basis.h"

#include <cblas.h>
#include <stdbool.h>
#include <string.h>

#include "analysis/ringing_complex.h"
#include "num/real.h"

#define FAR 64.0
enum { EXACT = 16 };

static double complex turn(double decay, double omega, double t)
{
    double size = real_exp(-decay * t), angle = omega * t;
    return ringing_complex(size * real_cos(angle), size * real_sin(angle));
}

void ringing_basis_open(struct ringing_basis *b, int most, long n, double rate, struct arena *a)
{
    long blocks = (n + RINGING_BLOCK - 1) / RINGING_BLOCK;
    *b = (struct ringing_basis){.n = n, .rate = rate, .blocks = blocks};
    b->table = ARENA_TAKE(a, double, 2 * most * RINGING_BLOCK);
    b->moment = ARENA_TAKE(a, double, 2 * most * RINGING_BLOCK);
    b->step = ARENA_TAKE(a, double complex, blocks * most);
    b->turned = ARENA_TAKE(a, double complex, blocks);
    b->work = ARENA_TAKE(a, double, blocks * 2 * most);
    b->work1 = ARENA_TAKE(a, double, blocks * 2 * most);
    b->signal = ARENA_TAKE(a, double, blocks * RINGING_BLOCK);
}

/* e^(s k unit), k = 0..n - 1: of every EXACT-th and of the first EXACT one by one, of the rest one's product with the other. */
static void turns(double decay, double omega, double unit, long n, double complex *z)
{
    for (long k = 0; k < n; k++)
        z[k] = k < EXACT || k % EXACT == 0 ? turn(decay, omega, (double)k * unit) : ringing_complex_product(z[k - k % EXACT], z[k % EXACT]);
}

void ringing_basis_set(struct ringing_basis *b, int m, const double *decay, const double *omega)
{
    b->m = m;
    for (int i = 0; i < m; i++) {
        double *row = b->table + (long)2 * i * RINGING_BLOCK, *first = b->moment + (long)2 * i * RINGING_BLOCK;
        double complex table[RINGING_BLOCK];
        turns(decay[i], omega[i], 1 / b->rate, RINGING_BLOCK, table);
        for (int k = 0; k < RINGING_BLOCK; k++) {
            double t = k / b->rate;
            double complex z = table[k];
            row[k] = creal(z);
            row[k + RINGING_BLOCK] = -cimag(z);
            first[k] = t * creal(z);
            first[k + RINGING_BLOCK] = -t * cimag(z);
        }
        turns(decay[i], omega[i], RINGING_BLOCK / b->rate, b->blocks, b->turned);
        for (long j = 0; j < b->blocks; j++)
            b->step[j * m + i] = b->turned[j];
    }
}

static void blocks_fill(struct ringing_basis *b, const double *x)
{
    memcpy(b->signal, x, (size_t)b->n * sizeof *x);
    memset(b->signal + b->n, 0, (size_t)(b->blocks * RINGING_BLOCK - b->n) * sizeof *x);
}

static void blocks_times(const struct ringing_basis *b, const double *table, double *out)
{
    cblas_dgemm(CblasRowMajor, CblasNoTrans, CblasTrans, (int)b->blocks, 2 * b->m, RINGING_BLOCK, 1, b->signal, RINGING_BLOCK, table, RINGING_BLOCK, 0, out,
                2 * b->m);
}

void ringing_basis_project(struct ringing_basis *b, const double *x, double complex *out, double complex *first)
{
    int m = b->m;
    for (int i = 0; i < m; i++)
        out[i] = first[i] = 0;
    if (m == 0)
        return;
    blocks_fill(b, x);
    blocks_times(b, b->table, b->work);
    blocks_times(b, b->moment, b->work1);
    for (long j = 0; j < b->blocks; j++) {
        double t = (double)(j * RINGING_BLOCK) / b->rate;
        for (int i = 0; i < m; i++) {
            const double *c = b->work + j * 2 * m + 2 * i, *d = b->work1 + j * 2 * m + 2 * i;
            double complex back = conj(b->step[j * m + i]);
            out[i] += ringing_complex_product(back, ringing_complex(c[0], c[1]));
            first[i] += ringing_complex_product(back, ringing_complex(t * c[0] + d[0], t * c[1] + d[1]));
        }
    }
}

void ringing_basis_subtract(struct ringing_basis *b, const double *x, const double complex *gain, double *y)
{
    int m = b->m;
    blocks_fill(b, x);
    for (long j = 0; j < b->blocks; j++)
        for (int i = 0; i < m; i++) {
            double complex now = ringing_complex_product(gain[i], b->step[j * m + i]);
            b->work[j * 2 * m + 2 * i] = creal(now);
            b->work[j * 2 * m + 2 * i + 1] = cimag(now);
        }
    if (m > 0)
        cblas_dgemm(CblasRowMajor, CblasNoTrans, CblasNoTrans, (int)b->blocks, RINGING_BLOCK, 2 * m, -1, b->work, 2 * m, b->table, RINGING_BLOCK, 1, b->signal,
                    RINGING_BLOCK);
    memcpy(y, b->signal, (size_t)b->n * sizeof *y);
}

void ringing_basis_sums(double complex u, long n, double rate, double complex sum[3])
{
    double complex q = turn(-creal(u), cimag(u), 1 / rate), now = 1; /* now = e^(u done/rate) */
    long done = 0, bit = 1;
    sum[0] = sum[1] = sum[2] = 0;
    while (bit <= n / 2)
        bit *= 2;
    for (; bit > 0; bit /= 2) {
        double t = (double)done / rate;
        sum[2] += ringing_complex_product(now, t * t * sum[0] + 2 * t * sum[1] + sum[2]);
        sum[1] += ringing_complex_product(now, t * sum[0] + sum[1]);
        sum[0] += ringing_complex_product(now, sum[0]);
        now = ringing_complex_product(now, now);
        done *= 2;
        if (n & bit) {
            t = (double)done / rate;
            sum[0] += now;
            sum[1] += t * now;
            sum[2] += t * t * now;
            now = ringing_complex_product(now, q);
            done++;
        }
    }
}

/* The same by the closed forms, 1/(1 - z)^(q + 1), z = e^(u/rate), end = z^n: true to n/FAR roundings while |1 - z| n > FAR. */
static bool sums_closed(double complex z, double complex end, long n, double rate, double complex sum[3])
{
    double complex under = 1 - z;
    double size = creal(under) * creal(under) + cimag(under) * cimag(under), count = (double)n;
    if (!(size * count * count > FAR * FAR))
        return false;
    double complex inverse = conj(under) / size, last = ringing_complex_product(end, inverse);
    sum[0] = inverse - last;
    double complex part = ringing_complex_product(z, ringing_complex_product(sum[0], inverse));
    sum[1] = (part - count * last) / rate;
    part = ringing_complex_product(1 + z, part) - 2 * count * ringing_complex_product(z, last);
    sum[2] = (ringing_complex_product(part, inverse) - count * count * last) / (rate * rate);
    return true;
}

/* Of the poles s and t; step, end: e^(s/rate), e^(s n/rate) of each. */
static void sums_pair(const struct ringing_basis *b, double complex u, const double complex step[2], const double complex end[2], double complex sum[3])
{
    if (!sums_closed(ringing_complex_product(step[0], step[1]), ringing_complex_product(end[0], end[1]), b->n, b->rate, sum))
        ringing_basis_sums(u, b->n, b->rate, sum);
}

void ringing_basis_gram(int m, const double *decay, const double *omega, const struct ringing_basis *b, double *g[3])
{
    long w = 2 * m;
    struct arena *a = arena_open();
    double complex *step = ARENA_TAKE(a, double complex, m), *end = ARENA_TAKE(a, double complex, m);
    for (int i = 0; i < m; i++) {
        step[i] = turn(decay[i], omega[i], 1 / b->rate);
        end[i] = turn(decay[i], omega[i], (double)b->n / b->rate);
    }
    for (int i = 0; i < m; i++)
        for (int k = 0; k <= i; k++) {
            double complex x[3], y[3];
            sums_pair(b, ringing_complex(-decay[i] - decay[k], omega[i] + omega[k]), (const double complex[]){step[i], step[k]}, (const double complex[]){end[i], end[k]}, x);
            sums_pair(b, ringing_complex(-decay[i] - decay[k], omega[i] - omega[k]), (const double complex[]){step[i], conj(step[k])},
                      (const double complex[]){end[i], conj(end[k])}, y);
            for (int q = 0; q < 3; q++) {
                double *at = g[q];
                at[2 * i * w + 2 * k] = at[2 * k * w + 2 * i] = 0.5 * creal(x[q] + y[q]);
                at[(2 * i + 1) * w + 2 * k + 1] = at[(2 * k + 1) * w + 2 * i + 1] = 0.5 * creal(y[q] - x[q]);
                at[2 * i * w + 2 * k + 1] = at[(2 * k + 1) * w + 2 * i] = 0.5 * cimag(y[q] - x[q]);
                at[(2 * i + 1) * w + 2 * k] = at[2 * k * w + 2 * i + 1] = -0.5 * cimag(x[q] + y[q]);
            }
        }
    arena_close(a);
}
