/* Sampled envelopes of a mode table as slopes: each place's own, or where poles are shared one set of decays for a mode
 * at all places. */
#include "response/mode_table_envelopes.h"

#include "num/real.h"
#include "response/slopes.h"

struct envelopes {
    const struct mode_table_rows *r;
    struct mode_table *t;
    const size_t *from;
    double worst; /* error, relative */
    size_t worst_row;
    int poor; /* above -40 dB */
};

static double decibel(double error) { return 20.0 * real_log10(error); }

static bool lay_out(struct arena *a, const struct envelopes *v, size_t entry, struct slopes_series *s, struct err *e)
{
    size_t n = v->from[entry + 1] - v->from[entry];
    double *time = ARENA_TAKE(a, double, n), *amplitude = ARENA_TAKE(a, double, n);
    for (size_t i = 0; i < n; i++) {
        const double *w = mode_table_rows_values(v->r, v->r->order[v->from[entry] + i]);
        time[i] = w[MODE_TABLE_TIME];
        amplitude[i] = w[MODE_TABLE_AMPLITUDE];
    }
    *s = (struct slopes_series){(int)n, time, amplitude, {0}};
    if (n >= 2) return true;
    err_set(e, ERR_SCENE, "the envelope of mode '%.60s' at place '%.60s' has one sample; give at least 2",
            mode_table_rows_cell(v->r, v->t->entry[entry].row, MODE_TABLE_MODE),
            mode_table_rows_cell(v->r, v->t->entry[entry].row, MODE_TABLE_PLACE));
    return mode_table_rows_bad(v->r, v->t->entry[entry].row, e);
}

static bool judge(struct envelopes *v, size_t row, double error, struct err *e)
{
    v->poor += error > 0.01;
    if (error > v->worst) {
        v->worst = error;
        v->worst_row = row;
    }
    if (!(error > 0.1)) return true;
    err_set(e, ERR_SCENE,
            "the envelope of mode '%.60s' is met by decaying exponentials to %.1f dB only, which is above -20 dB; give "
            "it as it decays, "
            "without what precedes the rise, or as several modes",
            mode_table_rows_cell(v->r, row, MODE_TABLE_MODE), decibel(error));
    return mode_table_rows_bad(v->r, row, e);
}

/* Fits the envelopes of n entries with the same decays. */
static bool fit(struct envelopes *v, struct arena *a, const size_t *entries, int n, struct err *e)
{
    struct slopes_series *s = ARENA_TAKE(a, struct slopes_series, n);
    for (int i = 0; i < n; i++)
        if (!lay_out(a, v, entries[i], &s[i], e)) return false;
    struct slopes_fit f = slopes_fit(s, n);
    for (int i = 0; i < n; i++) {
        struct mode_entry *m = &v->t->entry[entries[i]];
        double phase = mode_table_rows_values(v->r, m->row)[MODE_TABLE_PHASE];
        m->n = f.n;
        m->slope = ARENA_TAKE(a, struct mode_slope, f.n);
        for (int k = 0; k < f.n; k++)
            m->slope[k] = (struct mode_slope){f.decay[k], s[i].gain[k], phase};
    }
    return judge(v, v->t->entry[entries[0]].row, f.error, e);
}

bool mode_table_envelopes_fit(const struct mode_table_rows *r, const size_t *from, struct arena *a,
                              struct mode_table *t, struct err *e)
{
    struct envelopes all = {.r = r, .t = t, .from = from}, *v = &all;
    size_t entries = v->t->first[v->t->places], *same = ARENA_TAKE(a, size_t, v->t->places);
    for (size_t k = 0; k < (v->t->shared ? v->t->modes : entries); k++) {
        for (size_t p = 0; v->t->shared && p < v->t->places; p++)
            same[p] = v->t->first[p] + k; /* every place has every mode */
        if (!fit(v, a, v->t->shared ? same : &k, v->t->shared ? (int)v->t->places : 1, e)) return false;
    }
    if (v->poor)
        v->t->note = arena_format(a,
                                  "%s:%d: the envelope of mode '%.60s' is met by decaying exponentials to %.1f dB "
                                  "only; %d of %zu are not met to -40 dB",
                                  v->r->csv->file, v->r->csv->lines[v->worst_row],
                                  mode_table_rows_cell(v->r, v->worst_row, MODE_TABLE_MODE), decibel(v->worst), v->poor,
                                  v->t->shared ? v->t->modes : entries);
    return true;
}
