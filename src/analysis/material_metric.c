#include "analysis/material_metric.h"

#include <gsl/gsl_multimin.h>
#include <math.h>
#include <string.h>

#include "num/fft.h"
#include "num/real.h"

enum { WINDOW = 2048, HOP = WINDOW / 4, BANDS = 24, CONTOUR = 29, TRIES = 3, ITERATIONS = 400 };

static const double rate = 44100.0, seconds = 2.0;
static const double reference_power = 4e-10; /* Pa^2: 20 uPa */
static const double smallest = 1e-4;         /* of the simplex */

/* ------------------------------------------------------------------ loudness */

/* ISO 226:2003, table 1: frequency, exponent, transfer (dB), threshold (dB). */
static const double contour[CONTOUR][4] = {
    {20, 0.532, -31.6, 78.5},   {25, 0.506, -27.2, 68.7}, {31.5, 0.480, -23.0, 59.5}, {40, 0.455, -19.1, 51.1},
    {50, 0.432, -15.9, 44.0},   {63, 0.409, -13.0, 37.5}, {80, 0.387, -10.3, 31.5},   {100, 0.367, -8.1, 26.5},
    {125, 0.349, -6.2, 22.1},   {160, 0.330, -4.5, 17.9}, {200, 0.315, -3.1, 14.4},   {250, 0.301, -2.0, 11.4},
    {315, 0.288, -1.1, 8.6},    {400, 0.276, -0.4, 6.2},  {500, 0.267, 0.0, 4.4},     {630, 0.259, 0.3, 3.0},
    {800, 0.253, 0.5, 2.2},     {1000, 0.250, 0.0, 2.4},  {1250, 0.246, -2.7, 3.5},   {1600, 0.244, -4.1, 1.7},
    {2000, 0.243, -1.0, -1.3},  {2500, 0.243, 1.7, -4.2}, {3150, 0.243, 2.5, -6.0},   {4000, 0.242, 1.2, -5.4},
    {5000, 0.242, -2.1, -1.5},  {6300, 0.245, -7.1, 6.0}, {8000, 0.254, -11.2, 12.6}, {10000, 0.271, -10.7, 13.9},
    {12500, 0.301, -3.1, 12.3},
};

/* dB SPL of 40 phon at a row of the table. */
static double forty(int row)
{
    const double *c = contour[row];
    double a = 4.47e-3 * (10.0 - 1.15) + real_pow(0.4 * real_exp10((c[3] + c[2]) / 10.0 - 9.0), c[1]);
    return 10.0 / c[1] * real_log10(a) - c[2] + 94.0;
}

double material_metric_contour(double f)
{
    int k = 0;
    if (f <= contour[0][0]) return forty(0);
    while (k < CONTOUR - 2 && contour[k + 1][0] < f)
        k++;
    double t = fmin(real_log(f / contour[k][0]) / real_log(contour[k + 1][0] / contour[k][0]), 1.0);
    return (1.0 - t) * forty(k) + t * forty(k + 1);
}

static double sone(double power, double level_of_40)
{
    double phon = power > 0.0 ? 10.0 * real_log10(power / reference_power) - level_of_40 + 40.0 : 0.0;
    if (phon <= 0.0) return 0.0;
    return phon >= 40.0 ? real_pow(2.0, (phon - 40.0) / 10.0) : real_pow(phon / 40.0, 2.642);
}

struct material_search {
    struct material_voice voice;
    struct arena *arena;
    struct fft *fft;
    long n; /* samples */
    int frames;
    double window[WINDOW], level[BANDS]; /* dB SPL of 40 phon */
    double share[WINDOW / 2 + 1];        /* of a bin in its lower band */
    int band[WINDOW / 2 + 1];            /* that band; -1: beyond */
    double *sound, *loud, *other, whole; /* [n]; [frames][BANDS] of reference and estimate; sum of squares */
    double scale;                        /* of all sounds: the reference's peak becomes full scale */
    double *log_ratio, *slope;
    struct feature *estimate;
    double *gain;
};

static void lay_bands(struct material_search *s)
{
    for (int k = 0; k <= WINDOW / 2; k++) {
        double low = feature_match_bark(fmax((k - 0.5) * rate / WINDOW, 1.0)),
               high = feature_match_bark((k + 0.5) * rate / WINDOW);
        double edge = floor(fmax(low, 0.0)) + 1.0;
        s->band[k] = high < 0.0 || edge > BANDS ? -1 : (int)edge - 1;
        s->share[k] = high <= edge ? 1.0 : (edge - low) / (high - low);
    }
    for (int b = 0; b < BANDS; b++) { /* Traunmueller's formula turned round, at the band's middle */
        double z = b + 0.5 + 0.53;
        s->level[b] = material_metric_contour(1960.0 * z / (26.81 - z));
    }
}

/* loud[frames][BANDS] of the sound. */
static void loudness(struct material_search *s, double *loud)
{
    double re[WINDOW / 2 + 1], im[WINDOW / 2 + 1], x[WINDOW], square = 0.0;
    for (int i = 0; i < WINDOW; i++)
        square += s->window[i] * s->window[i];
    for (int m = 0; m < s->frames; m++) {
        double power[BANDS] = {0};
        for (int i = 0; i < WINDOW; i++) {
            long at = (long)m * HOP + i;
            x[i] = at < s->n ? s->window[i] * s->sound[at] : 0.0;
        }
        fft_forward(s->fft, x, re, im);
        for (int k = 1; k <= WINDOW / 2; k++) {
            double p = 2.0 * (re[k] * re[k] + im[k] * im[k]) / (WINDOW * square);
            if (s->band[k] < 0) continue;
            power[s->band[k]] += s->share[k] * p;
            if (s->band[k] + 1 < BANDS) power[s->band[k] + 1] += (1.0 - s->share[k]) * p;
        }
        for (int b = 0; b < BANDS; b++)
            loud[m * BANDS + b] = sone(power[b], s->level[b]);
    }
}

/* ------------------------------------------------------------------ sounds */

/* Adds gain e^(-d t) sin(2 pi f t + phase), t from 0, below 0.45 of the rate. */
static void add_mode(struct material_search *s, double frequency, double decay, double gain, double phase)
{
    double w = 2.0 * REAL_PI * frequency / rate, r = real_exp(-decay / rate), c = r * real_cos(w), d = r * real_sin(w),
           x = gain * real_cos(phase), y = gain * real_sin(phase);
    if (frequency >= 0.45 * rate || gain == 0.0) return;
    long last = (long)fmin((double)s->n, 1.0 + 18.0 * rate / decay); /* -156 dB */
    for (long i = 0; i < last; i++) {
        double next = c * x - d * y;
        s->sound[i] += y;
        y = d * x + c * y;
        x = next;
    }
}

static double peak(const struct material_search *s)
{
    double most = 0.0;
    for (long i = 0; i < s->n; i++)
        most = fmax(most, fabs(s->sound[i]));
    return most;
}

struct material_search *material_metric_open(const struct material_voice *v, struct arena *a)
{
    struct material_search *s = ARENA_TAKE(a, struct material_search, 1);
    *s = (struct material_search){.voice = *v, .arena = a, .fft = fft_open(WINDOW), .n = (long)(seconds * rate)};
    s->frames = (int)(s->n / HOP);
    s->sound = ARENA_TAKE(a, double, s->n);
    s->loud = ARENA_TAKE(a, double, s->frames *BANDS);
    s->other = ARENA_TAKE(a, double, s->frames *BANDS);
    s->log_ratio = ARENA_TAKE(a, double, v->family->n);
    s->slope = ARENA_TAKE(a, double, v->family->n);
    s->estimate = ARENA_TAKE(a, struct feature, v->family->n);
    s->gain = ARENA_TAKE(a, double, v->family->n);
    for (int i = 0; i < WINDOW; i++)
        s->window[i] = 0.5 - 0.5 * real_cospi(2.0 * (i + 0.5) / WINDOW);
    lay_bands(s);
    solid_family_at(v->family, v->nu, s->log_ratio, s->slope);
    for (int i = 0; i < v->n; i++)
        add_mode(s, v->feature[i].frequency, v->feature[i].decay, v->gain[i], v->phase[i]);
    double most = peak(s);
    s->scale = most > 0.0 ? 1.0 / most : 1.0;
    for (long i = 0; i < s->n; i++)
        s->sound[i] *= s->scale;
    loudness(s, s->loud);
    for (int i = 0; i < s->frames * BANDS; i++)
        s->whole += s->loud[i] * s->loud[i];
    return s;
}

void material_metric_close(struct material_search *s) { fft_close(s->fft); }

/* The estimate's features and gains; returns their number, overdamped ones left out (eq. 4, 5 and 8). */
static int estimate(struct material_search *s, const double *x, double loss)
{
    const struct material_voice *v = &s->voice;
    double gamma = real_exp(x[MATERIAL_GAMMA]), alpha = real_exp(x[MATERIAL_ALPHA_OF]),
           beta = real_exp(x[MATERIAL_BETA_OF]), sigma = real_exp(x[MATERIAL_SIGMA]);
    int n = 0;
    for (int j = 0; j < v->family->n; j++) {
        double lambda = gamma * real_exp(s->log_ratio[j]), w = sqrt(lambda),
               d = 0.5 * (alpha + beta * lambda + loss * w);
        if (lambda <= d * d) continue;
        double damped = sqrt(lambda - d * d), power = v->power < 0 ? 1.0 / damped : v->power > 0 ? damped : 1.0;
        s->gain[n] = sigma * fabs(v->in[j] * (v->out ? v->out[j] : 1.0)) * power;
        s->estimate[n] = (struct feature){damped / (2.0 * REAL_PI), d, s->gain[n] * s->gain[n] / (4.0 * d)};
        n++;
    }
    return n;
}

double material_metric_strength(struct material_search *s, const double x[MATERIAL_UNKNOWNS], double loss)
{
    double at[MATERIAL_UNKNOWNS], mine = 0.0, its = 0.0;
    memcpy(at, x, sizeof at);
    at[MATERIAL_SIGMA] = 0.0;
    int n = estimate(s, at, loss);
    for (int i = 0; i < n; i++)
        mine += s->estimate[i].energy;
    for (int i = 0; i < s->voice.n; i++)
        its += s->voice.feature[i].energy;
    return mine > 0.0 && its > 0.0 ? 0.5 * real_log(its / mine) : 0.0;
}

struct material_metric material_metric_at(struct material_search *s, const double x[MATERIAL_UNKNOWNS], double loss)
{
    struct arena *room = arena_open();
    struct feature_match match;
    int n = estimate(s, x, loss);
    double phase = s->voice.power < 0 ? 0.0 : s->voice.power == 0 ? REAL_PI / 2.0 : REAL_PI, sum = 0.0;
    memset(s->sound, 0, (size_t)s->n * sizeof *s->sound);
    for (int i = 0; i < n; i++)
        add_mode(s, s->estimate[i].frequency, s->estimate[i].decay, s->scale * s->gain[i], phase);
    loudness(s, s->other);
    for (int i = 0; i < s->frames * BANDS; i++)
        sum += (s->loud[i] - s->other[i]) * (s->loud[i] - s->other[i]);
    feature_match(s->voice.feature, s->voice.n, s->estimate, n, NULL, room, &match);
    struct material_metric metric = {s->whole > 0.0 ? sum / s->whole : 0.0, 1.0 - match.score};
    arena_close(room);
    return metric;
}

/* ------------------------------------------------------------------ search */

struct descent {
    struct material_search *s;
    double loss;
    int count;
};

static double value(const gsl_vector *v, void *self)
{
    struct descent *d = self;
    double x[MATERIAL_UNKNOWNS];
    for (int k = 0; k < MATERIAL_UNKNOWNS; k++) {
        x[k] = gsl_vector_get(v, (size_t)k);
        if (!(fabs(x[k]) < 200.0)) return 1e6;
    }
    struct material_metric m = material_metric_at(d->s, x, d->loss);
    d->count++;
    return m.image + m.feature;
}

int material_metric_descend(struct material_search *s, double x[MATERIAL_UNKNOWNS],
                            const double step[MATERIAL_UNKNOWNS], double loss)
{
    struct descent d = {s, loss, 0};
    gsl_multimin_function f = {value, MATERIAL_UNKNOWNS, &d};
    gsl_multimin_fminimizer *m = gsl_multimin_fminimizer_alloc(gsl_multimin_fminimizer_nmsimplex2, MATERIAL_UNKNOWNS);
    gsl_vector_view at = gsl_vector_view_array(x, MATERIAL_UNKNOWNS);
    gsl_vector_const_view size = gsl_vector_const_view_array(step, MATERIAL_UNKNOWNS);
    for (int t = 0; t < TRIES; t++) {
        gsl_multimin_fminimizer_set(m, &f, &at.vector, &size.vector);
        for (int i = 0; i < ITERATIONS; i++)
            if (gsl_multimin_fminimizer_iterate(m) != 0 || gsl_multimin_fminimizer_size(m) < smallest) break;
        gsl_vector_memcpy(&at.vector, gsl_multimin_fminimizer_x(m));
    }
    gsl_multimin_fminimizer_free(m);
    return d.count;
}
