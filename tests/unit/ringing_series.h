/* Known responses in noise, and the Cramer-Rao bound of their modes: from the derivatives of every sample, with nothing of rasp's. */
#ifndef RINGING_SERIES_H
#define RINGING_SERIES_H
#include <gsl/gsl_cblas.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

struct truth {                    /* gain e^(-decay t) sin(2 pi frequency t + phase) */
    double frequency, decay, gain, phase;
    double bound_frequency, bound_decay, bound_gain; /* least standard errors that any unbiased estimate has */
    int neighbour;                /* the other of a pair; -1 */
};

enum { SERIES_MODES = 50, SERIES_PAIRS = 5 };

static inline double series_value(const struct truth *m, double t) { return m->gain * exp(-m->decay * t) * sin(2 * M_PI * m->frequency * t + m->phase); }

static inline void series_sum(const struct truth *m, int count, double rate, long n, double *h)
{
    memset(h, 0, (size_t)n * sizeof *h);
    for (int i = 0; i < count; i++)
        for (long k = 0; k < n; k++)
            h[k] += series_value(&m[i], (double)k / rate);
}

static inline void series_noise(gsl_rng *g, double deviation, long n, double *h)
{
    for (long k = 0; k < n; k++)
        h[k] += gsl_ran_gaussian_ziggurat(g, deviation);
}

/* 50 modes, 100 Hz to 12 kHz, evenly spread in the log but for a random part, 30 dB of levels, T60 0.2 to 1.3 s; the last five are 1, 2, 5, 3, 10 Hz above others. */
static inline void series_fifty(gsl_rng *g, struct truth *m)
{
    const double apart[SERIES_PAIRS] = {1, 2, 5, 3, 10};
    int single = SERIES_MODES - SERIES_PAIRS;
    for (int i = 0; i < SERIES_MODES; i++) {
        double at = (i + 0.2 + 0.6 * gsl_rng_uniform(g)) / single;
        m[i] = (struct truth){.frequency = 100 * pow(120, at), .decay = 6.907755 / (0.2 * pow(6.5, gsl_rng_uniform(g))),
                              .gain = pow(10, -1.5 * gsl_rng_uniform(g)), .phase = 2 * M_PI * gsl_rng_uniform(g), .neighbour = -1};
    }
    for (int k = 0; k < SERIES_PAIRS; k++) {
        int of = 5 + 9 * k, i = single + k;
        m[i].frequency = m[of].frequency + apart[k];
        m[i].neighbour = of;
        m[of].neighbour = i;
    }
}

/* rms of the first 0.1 s over what makes that signal-to-noise ratio. */
static inline double series_deviation(const double *h, double rate, double decibel)
{
    double sum = 0;
    long n = (long)(0.1 * rate);
    for (long k = 0; k < n; k++)
        sum += h[k] * h[k];
    return sqrt(sum / (double)n) * pow(10, -decibel / 20);
}

/* Fills the bounds for white noise of that deviation: Fisher's matrix of frequency, decay, and the two parts of the gain of every mode. */
static inline void series_bound(struct truth *m, int count, double rate, long n, double deviation)
{
    enum { CHUNK = 2048 };
    int w = 4 * count;
    double *j = malloc(sizeof(double) * CHUNK * w), *fisher = calloc((size_t)w * w, sizeof(double)), *scale = malloc(sizeof(double) * w);
    for (long from = 0; from < n; from += CHUNK) {
        int rows = (int)(n - from < CHUNK ? n - from : CHUNK);
        for (int k = 0; k < rows; k++)
            for (int i = 0; i < count; i++) {
                double t = (double)(from + k) / rate, size = exp(-m[i].decay * t), angle = 2 * M_PI * m[i].frequency * t + m[i].phase, *row = j + (long)k * w + 4 * i;
                row[0] = 2 * M_PI * t * m[i].gain * size * cos(angle);
                row[1] = -t * m[i].gain * size * sin(angle);
                row[2] = size * sin(angle);
                row[3] = size * cos(angle);
            }
        cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, w, rows, 1, j, w, 1, fisher, w);
    }
    for (int i = 0; i < w; i++)
        scale[i] = 1 / sqrt(fisher[(long)i * w + i]);
    for (long i = 0; i < w; i++)
        for (long k = i; k < w; k++)
            fisher[i * w + k] *= scale[i] * scale[k];
    LAPACKE_dpotrf(LAPACK_COL_MAJOR, 'L', w, fisher, w);
    LAPACKE_dpotri(LAPACK_COL_MAJOR, 'L', w, fisher, w);
    for (int i = 0; i < count; i++) {
        double *out[] = {&m[i].bound_frequency, &m[i].bound_decay, &m[i].bound_gain};
        for (int x = 0; x < 3; x++)
            *out[x] = deviation * scale[4 * i + x] * sqrt(fisher[(long)(4 * i + x) * w + 4 * i + x]);
    }
    free(j);
    free(fisher);
    free(scale);
}

/* For every true mode the nearest estimate that is no other mode's, within `near` Hz and nearer than 0.45 of the way to the other of its pair; -1: none. */
static inline int series_match(const struct truth *m, int count, const double *frequency, int n, double near, int *of)
{
    int found = 0;
    for (int i = 0; i < count; i++) {
        double least = near;
        of[i] = -1;
        for (int k = 0; k < count; k++)
            if (k != i)
                least = fmin(least, 0.45 * fabs(m[k].frequency - m[i].frequency));
        for (int k = 0; k < n; k++)
            if (fabs(frequency[k] - m[i].frequency) < least) {
                least = fabs(frequency[k] - m[i].frequency);
                of[i] = k;
            }
        found += of[i] >= 0;
    }
    return found;
}

#endif
