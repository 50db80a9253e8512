#include "analysis/source_response.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_sort_double.h>
#include <string.h>

#include "num/toeplitz.h"

enum { ROUNDS = 6 };

/* ------------------------------------------------------------------ pulses */

enum { SHIFTS = 512 };

/* Where a template is most like y about `at`, within `reach` samples: *at, and the size. Returns the share of the
   energy there. y has room on both sides. */
static double align(const double *y, const double *pulse, long n, long reach, bool both, double *at, double *size)
{
    double sum[2 * SHIFTS + 1], own = 0, best = 0, energy = 0;
    long middle = (long)rint(*at), top = 0;
    for (long i = 0; i < n; i++)
        own += pulse[i] * pulse[i];
    for (long s = -reach; s <= reach; s++) {
        sum[s + reach] = 0;
        for (long i = 0; i < n; i++)
            sum[s + reach] += pulse[i] * y[middle + s + i];
        if (both ? fabs(sum[s + reach]) <= fabs(best) : sum[s + reach] <= best) continue;
        best = sum[s + reach];
        top = s;
    }
    double u = 0;
    if (top > -reach && top < reach && best != 0) {
        const double *p = &sum[top + reach];
        double bend = p[-1] - 2 * p[0] + p[1], tilt = (p[1] - p[-1]) / 2;
        if (bend * best < 0) u = fmax(-0.5, fmin(-tilt / bend, 0.5));
        best += u * tilt / 2;
    }
    for (long i = 0; i < n; i++)
        energy += y[middle + top + i] * y[middle + top + i];
    *at = (double)(middle + top) + u;
    *size = own > 0 ? best / own : 0;
    return own > 0 && energy > 0 ? best * best / (own * energy) : 0;
}

/* Times and sizes of the onsets' pulses in what prediction does not foresee, which is as short as an impact: beside the
   one pulse that most are like. Those that are not alike, two at once, say, are none. */
void source_response_pulses(const struct source_filter *f, const double *y, bool both, struct source_response_hits *h,
                            struct arena *a)
{
    enum { CANDIDATES = 6 };
    long early = (long)(SOURCE_MARGIN * f->rate), n = (long)((SOURCE_MARGIN + SOURCE_PAST) * f->rate),
         reach = 2 * early < SHIFTS ? 2 * early : SHIFTS, edge = n + reach + 2;
    double *pulse = ARENA_TAKE(a, double, n), *best = ARENA_TAKE(a, double, n),
           *power = ARENA_TAKE(a, double, f->onsets + 1), most = -1;
    int *order = ARENA_TAKE(a, int, f->onsets + 1), inside = 0;
    size_t *rank = ARENA_TAKE(a, size_t, f->onsets + 1);
    for (int k = 0; k < f->onsets; k++)
        if (f->onset[k] > edge && f->onset[k] + edge < f->n) order[inside++] = k;
    for (int k = 0; k < inside; k++)
        for (long i = 0; i < n; i++)
            power[k] += y[f->onset[order[k]] - early + i] * y[f->onset[order[k]] - early + i];
    *h = (struct source_response_hits){.at = ARENA_TAKE(a, double, f->onsets + 1),
                                       .size = ARENA_TAKE(a, double, f->onsets + 1)};
    if (!inside) return;
    gsl_sort_index(rank, power, 1, (size_t)inside);
    for (int c = 0; c < CANDIDATES && c < inside; c++) {
        const double *of = y + f->onset[order[rank[inside - 1 - c * inside / (2 * CANDIDATES)]]] - early;
        double sum = 0, at, size;
        for (int k = 0; k < inside; k++) {
            at = (double)(f->onset[order[k]] - early);
            sum += sqrt(power[k]) * align(y, of, n, reach, both, &at, &size);
        }
        if (sum > most) memcpy(best, of, (size_t)n * sizeof *best);
        most = fmax(most, sum);
    }
    for (int round = 0; round < ROUNDS; round++) {
        double all = 0;
        h->n = 0;
        memset(pulse, 0, (size_t)n * sizeof *pulse);
        for (int k = 0; k < inside; k++) {
            double at = (double)(f->onset[order[k]] - early), size;
            if (!(align(y, best, n, reach, both, &at, &size) > 0.5)) continue;
            long first = (long)floor(at);
            for (long i = 0; i < n; i++)
                pulse[i] += size * source_response_between(y + first + i, at - (double)first);
            all += size * size;
            h->at[h->n] = at + (double)early;
            h->size[h->n++] = size;
        }
        for (long i = 0; i < n && all > 0; i++)
            best[i] = pulse[i] / all;
    }
}

/* ------------------------------------------------------------------ response */

/* h[n] of M h = c, M of the autocorrelation r[n], from the h there is. */
static void solve(const double *r, const double *c, double *h, long n)
{
    struct arena *a = arena_open();
    long size = (long)fft_good_size((size_t)(2 * n));
    double *x = ARENA_TAKE(a, double, size), *re = ARENA_TAKE(a, double, size / 2 + 1),
           *im = ARENA_TAKE(a, double, size / 2 + 1);
    struct toeplitz t = {
        .fft = fft_open((size_t)size), .n = n, .size = size, .spectrum = re, .most = 1000, .enough = 1e-12};
    for (long i = 0; i < n; i++)
        x[i] = x[i ? size - i : 0] = r[i];
    fft_forward(t.fft, x, re, im);
    toeplitz_solve(&t, c, h);
    fft_close(t.fft);
    arena_close(a);
}

struct filter {
    struct fft *fft;
    long size;
    const double *by_re, *by_im; /* [size/2 + 1] its spectrum */
    double *re, *im;             /* work */
};

/* y[size] by the filter, sign 1, or by its conjugate, -1. */
static void filter(const struct filter *f, double *y, int sign)
{
    fft_forward(f->fft, y, f->re, f->im);
    for (long k = 0; k <= f->size / 2; k++) {
        double re = f->re[k] / (double)f->size, im = f->im[k] / (double)f->size;
        f->re[k] = re * f->by_re[k] - sign * im * f->by_im[k];
        f->im[k] = im * f->by_re[k] + sign * re * f->by_im[k];
    }
    fft_inverse(f->fft, f->re, f->im, y);
}

/* The share given back is of the recording as it is: what its continuation gives does not count. */
double source_response_mean(const double *x, long n, const struct source_response_hits *hits, double *h, long length)
{
    enum { PASSES = 3 };
    static const double ridge = 1e-4; /* of the train's power */
    long size = (long)fft_good_size((size_t)(n + length + 4)), bins = size / 2 + 1;
    struct arena *a = arena_open();
    struct fft *fft = fft_open((size_t)size);
    double *y = ARENA_TAKE(a, double, size), *re = ARENA_TAKE(a, double, bins), *im = ARENA_TAKE(a, double, bins),
           *tr = ARENA_TAKE(a, double, bins), *ti = ARENA_TAKE(a, double, bins), *r = ARENA_TAKE(a, double, length),
           left = 0, all = 0;
    const struct filter train = {fft, size, tr, ti, re, im};
    for (int k = 0; k < hits->n; k++) { /* between samples, as source_response_between */
        long at = (long)floor(hits->at[k]);
        double u = hits->at[k] - (double)at;
        for (long i = -1; at > 0 && at + 2 < n && i <= 2; i++) {
            double one[4] = {0};
            one[2 - i] = 1;
            y[at + i] += hits->size[k] * source_response_between(one + 1, 1 - u);
        }
    }
    fft_forward(fft, y, tr, ti);
    for (long k = 0; k < bins; k++) {
        re[k] = (tr[k] * tr[k] + ti[k] * ti[k]) / (double)size;
        im[k] = 0;
    }
    fft_inverse(fft, re, im, y);
    memcpy(r, y, (size_t)length * sizeof *r);
    r[0] *= 1 + ridge;
    memset(h, 0, (size_t)length * sizeof *h);
    for (int pass = 0; pass < PASSES && r[0] > 0; pass++) { /* behind its end the recording goes on as the last says */
        memset(y, 0, (size_t)size * sizeof *y);
        memcpy(y, h, (size_t)length * sizeof *h);
        filter(&train, y, 1);
        memcpy(y, x, (size_t)n * sizeof *y);
        filter(&train, y, -1);
        solve(r, y, h, length);
    }
    memset(y, 0, (size_t)size * sizeof *y);
    memcpy(y, h, (size_t)length * sizeof *h);
    filter(&train, y, 1);
    for (long i = 0; i < n; i++) {
        left += (x[i] - y[i]) * (x[i] - y[i]);
        all += x[i] * x[i];
    }
    fft_close(fft);
    arena_close(a);
    return all > 0 ? 1 - left / all : 0;
}

bool source_response_solve(const double *basis, long columns, long stride, long n, double *x, double *to)
{
    gsl_matrix *normal = gsl_matrix_alloc((size_t)columns, (size_t)columns);
    gsl_vector *right = gsl_vector_alloc((size_t)columns);
    for (long p = 0; p < columns; p++) {
        double with = 0;
        for (long q = 0; q <= p; q++) {
            double sum = 0;
            for (long t = 0; t < n; t++)
                sum += basis[p * stride + t] * basis[q * stride + t];
            if (p == q) sum = sum * (1 + 1e-9) + 1e-300; /* two modes may be as good as one */
            gsl_matrix_set(normal, (size_t)p, (size_t)q, sum);
            gsl_matrix_set(normal, (size_t)q, (size_t)p, sum);
        }
        for (long t = 0; t < n; t++)
            with += basis[p * stride + t] * x[t];
        gsl_vector_set(right, (size_t)p, with);
    }
    bool ok = gsl_linalg_cholesky_decomp1(normal) == GSL_SUCCESS;
    if (ok) gsl_linalg_cholesky_svx(normal, right);
    for (long p = 0; ok && p < columns; p++) {
        to[p] = gsl_vector_get(right, (size_t)p);
        for (long t = 0; t < n; t++)
            x[t] -= to[p] * basis[p * stride + t];
    }
    gsl_vector_free(right);
    gsl_matrix_free(normal);
    return ok;
}
