#include "analysis/material_set.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "num/real.h"

struct measured {
    double frequency, error, decay, decay_error;
};

static int by_frequency(const void *x, const void *y)
{
    const struct measured *p = x, *q = y;
    return (p->frequency > q->frequency) - (p->frequency < q->frequency);
}

static void read_errors(const struct csv *csv, const char *mode, int slope, double strikes, struct arena *a,
                        struct measured *m)
{
    static const char *const words[] = {"frequency_hz se ", "se_between ", "decay_per_s se ", "se_between "};
    const char *text = csv_comment(csv, arena_format(a, "error %s.%d", mode, slope));
    double x[4];
    m->error = 2e-4;
    m->decay_error = 0.05;
    for (int k = 0; k < 4; k++) {
        text = text ? strstr(text, words[k]) : NULL;
        if (!text) return;
        x[k] = strtod(text + strlen(words[k]), NULL);
        text += strlen(words[k]);
    }
    m->error = sqrt(x[0] * x[0] + x[1] * x[1] / strikes) / m->frequency;
    if (strikes < 2.0) x[3] = 0.0; /* stated, not measured: what decays scatter by shows beside the laws */
    m->decay_error = sqrt(x[2] * x[2] + x[3] * x[3] / strikes) / m->decay;
}

struct material_set material_set_make(const struct mode_table *t, int object, struct arena *a)
{
    const struct csv *csv = &t->csv;
    const int column = csv_column(csv, "mode"), n = (int)(t->first[1] - t->first[0]);
    struct measured *m = ARENA_TAKE(a, struct measured, n);
    double strikes = 0.0;
    for (size_t i = 0; i < csv->n_comments; i++)
        if (!strncmp(csv->comments[i].key, "strikes ", 8)) strikes += strtod(csv->comments[i].value, NULL);
    for (int i = 0; i < n; i++) {
        const struct mode_entry *entry = &t->entry[t->first[0] + (size_t)i];
        int best = 0;
        for (int k = 1; k < entry->n; k++) { /* of several slopes the one of the greatest energy */
            const struct mode_slope *p = &entry->slope[k], *q = &entry->slope[best];
            if (p->gain * p->gain * q->decay > q->gain * q->gain * p->decay) best = k;
        }
        m[i].frequency = entry->frequency;
        m[i].decay = entry->slope[best].decay;
        read_errors(csv, csv->cells[entry->row * csv->columns + (size_t)column], best + 1, fmax(strikes, 1.0), a,
                    &m[i]);
    }
    qsort(m, (size_t)n, sizeof *m, by_frequency);
    struct material_set set = {.object = object, .hum = csv_comment(csv, "hum") != NULL};
    set.log_lambda = ARENA_TAKE(a, double, n);
    set.frequency = ARENA_TAKE(a, double, n);
    set.error = ARENA_TAKE(a, double, n);
    set.decay = ARENA_TAKE(a, double, n);
    set.decay_error = ARENA_TAKE(a, double, n);
    set.match = ARENA_TAKE(a, int, n);
    for (int i = 0; i < n; i++) {
        double w = 2.0 * REAL_PI * m[i].frequency;
        if (!(m[i].decay > 0.0)) continue;
        set.log_lambda[set.n] = real_log(w * w + m[i].decay * m[i].decay);
        set.frequency[set.n] = m[i].frequency;
        set.error[set.n] = m[i].error;
        set.decay[set.n] = m[i].decay;
        set.decay_error[set.n++] = m[i].decay_error;
    }
    return set;
}

double *material_set_visible(const struct solid_family *f, int points, int first, int n, int ear, struct arena *a)
{
    const double *phi = f->phi + (size_t)(f->nodes / 2) * points * f->n;
    double *visible = ARENA_TAKE(a, double, f->n), rms = 0.0;
    if (n == 0) return NULL;
    for (int k = 0; k < f->n; k++) {
        for (int p = first; p < first + n; p++)
            visible[k] = fmax(visible[k], fabs(phi[(size_t)p * f->n + k]));
        if (ear >= 0) visible[k] *= fabs(phi[(size_t)ear * f->n + k]);
        rms += visible[k] * visible[k];
    }
    rms = sqrt(rms / f->n);
    for (int k = 0; k < f->n; k++)
        visible[k] = fmin(visible[k] / (0.5 * rms), 1.0);
    return visible;
}
