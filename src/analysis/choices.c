/* See choices.h. */
#include "analysis/choices.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>

#include "num/noise.h"

static double norm(gsl_matrix *m, bool frobenius)
{
    double sum = 0;
    for (size_t i = 0; frobenius && i < m->size1 * m->size2; i++)
        sum += m->data[i] * m->data[i];
    if (frobenius) return sqrt(sum);
    gsl_matrix *v = gsl_matrix_alloc(m->size2, m->size2);
    gsl_vector *s = gsl_vector_alloc(m->size2);
    gsl_linalg_SV_decomp_jacobi(m, v, s);
    double largest = gsl_vector_get(s, 0);
    gsl_matrix_free(v);
    gsl_vector_free(s);
    return largest;
}

double choices_similarity(const double *reference, const double *other, int n, bool frobenius)
{
    gsl_matrix *own = gsl_matrix_alloc(n, n), *off = gsl_matrix_alloc(n, n);
    for (int i = 0; i < n * n; i++) {
        own->data[i] = reference[i];
        off->data[i] = reference[i] - other[i];
    }
    double similarity = 1 - norm(off, frobenius) / norm(own, frobenius);
    gsl_matrix_free(own);
    gsl_matrix_free(off);
    return similarity;
}

void choices_shares(const double *counts, int n, double *shares)
{
    for (int i = 0; i < n; i++) {
        double sum = 0;
        for (int k = 0; k < n; k++)
            sum += counts[i * n + k];
        for (int k = 0; k < n; k++)
            shares[i * n + k] = sum > 0 ? counts[i * n + k] / sum : 0;
    }
}

double choices_deviations(double confidence, int m) { return gsl_cdf_ugaussian_Qinv((1 - confidence) / 2 / m); }

void choices_wilson(double k, double n, double z, double interval[2])
{
    double share = k / n, z2 = z * z, middle = (share + z2 / (2 * n)) / (1 + z2 / n);
    double half = z / (1 + z2 / n) * sqrt(share * (1 - share) / n + z2 / (4 * n * n));
    interval[0] = k > 0 ? middle - half : 0;
    interval[1] = k < n ? middle + half : 1;
}

double choices_chi_squared(const double *a, const double *b, int n, int *df, double *p)
{
    double all[2] = {0, 0}, x = 0;
    for (int k = 0; k < n; k++) {
        all[0] += a[k];
        all[1] += b[k];
    }
    *df = -1;
    for (int k = 0; k < n; k++) {
        if (a[k] + b[k] == 0) continue;
        ++*df;
        for (int r = 0; r < 2; r++) {
            double expected = (a[k] + b[k]) * all[r] / (all[0] + all[1]), off = (r ? b[k] : a[k]) - expected;
            x += off * off / expected;
        }
    }
    *p = *df > 0 ? gsl_cdf_chisq_Q(x, *df) : (double)NAN;
    return x;
}

double choices_permutation(const double *d, int n, long draws, uint64_t seed, bool *all)
{
    struct noise s = noise_make(seed, "permutation");
    double observed = 0, size = 0;
    for (int i = 0; i < n; i++) {
        observed += d[i];
        size += fabs(d[i]);
    }
    *all = n < 40 && 1L << n <= draws;
    long runs = *all ? 1L << n : draws, beyond = 0;
    for (long r = 0; r < runs; r++) {
        double sum = 0;
        uint64_t word[2] = {(uint64_t)r, 0};
        for (int i = 0; i < n; i++) {
            if (!*all && i % 64 == 0) noise_bits(s, (uint64_t)r, (uint64_t)(i / 64), word);
            sum += word[0] >> i % 64 & 1 ? -d[i] : d[i];
        }
        beyond += fabs(sum) >= fabs(observed) - 1e-12 * size; /* equal ones differ by rounding */
    }
    return *all ? (double)beyond / (double)runs : (double)(beyond + 1) / (double)(runs + 1);
}

struct choices_equivalence choices_equivalence(const double *d, int n, double bound)
{
    double mean = gsl_stats_mean(d, 1, n), error = gsl_stats_sd_m(d, 1, n, mean) / sqrt(n);
    double half = error * gsl_cdf_tdist_Pinv(0.95, n - 1);
    struct choices_equivalence e = {mean, mean - half, mean + half, fabs(mean) < bound ? 0 : 1};
    if (error > 0)
        e.p = fmax(gsl_cdf_tdist_Q((mean + bound) / error, n - 1), gsl_cdf_tdist_P((mean - bound) / error, n - 1));
    return e;
}
