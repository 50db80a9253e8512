/* The report of `rasp analyse` as JSON: SI units, null for what is not there. */
#include <math.h>
#include <stdio.h>

#include "cmd/analyse.h"
#include "file/json_value.h"

static json_t *list(const double *x, int n)
{
    json_t *j = json_array();
    for (int i = 0; i < n; i++)
        json_array_append_new(j, json_value_number(x[i]));
    return j;
}

static json_t *estimate(const struct estimate *x)
{
    return json_pack("{s:o, s:o, s:o, s:o}", "value", json_value_number(x->value), "error", json_value_number(x->error), "low", json_value_number(x->low), "high", json_value_number(x->high));
}

static json_t *distribution(const struct distribution_fits *d)
{
    return json_pack("{s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "gaussian_r2", json_value_number(d->gaussian_r2), "gaussian_distance", json_value_number(d->gaussian_distance),
                     "exponential_mean", json_value_number(d->exponential_mean), "exponential_distance", json_value_number(d->exponential_distance), "gamma_shape",
                     json_value_number(d->gamma_shape), "gamma_scale", json_value_number(d->gamma_scale), "gamma_distance", json_value_number(d->gamma_distance), "skewness",
                     json_value_number(d->skewness), "kurtosis", json_value_number(d->kurtosis));
}

static json_t *series(const struct analysis *a, int k)
{
    const struct series_statistics *s = &a->statistics.series[k];
    return json_pack("{s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:b, s:b, s:s, s:o, s:o, s:o, s:o}", "mean", estimate(&s->mean), "a1", estimate(&s->a1), "b1",
                     estimate(&s->b1), "white_deviation", estimate(&s->deviation), "variance", json_value_number(s->variance), "whiteness_q", json_value_number(s->whiteness),
                     "whiteness_p", json_value_number(s->whiteness_p), "flat", s->flat, "ridge", s->ridge, "white_distribution",
                     analyse_tabled(a, k) ? "table" : "gaussian", "white", distribution(&s->white), "series", distribution(&s->itself), "correlation",
                     list(s->correlation, STATISTICS_LAGS), "white_correlation", list(s->white_correlation, STATISTICS_LAGS));
}

static json_t *statistics(const struct analysis *a)
{
    const struct impact_statistics *t = &a->statistics;
    const struct impact_modulation *m = &t->modulation;
    if (!a->counted)
        return json_null();
    json_t *modulation = !m->looked ? json_null() : json_pack("{s:o, s:o, s:o, s:b}", "depth", json_value_number(m->depth), "rate_hz", json_value_number(m->rate), "probability", json_value_number(m->probability),
                                   "found", m->found);
    return json_pack("{s:o, s:o, s:o, s:b, s:o, s:o, s:o}", "amplitude_n", series(a, STATISTICS_AMPLITUDE), "interval_s", series(a, STATISTICS_INTERVAL),
                     "one_process", json_value_number(t->one_process), "one_process_taken", analyse_one_process(a), "modulation", modulation, "cross_correlation",
                     list(t->cross, 2 * STATISTICS_LAGS - 1), "white_cross_correlation", list(t->white_cross, 2 * STATISTICS_LAGS - 1));
}

static json_t *source(const struct analyse_source *s)
{
    const struct impact_found *f = &s->found;
    if (!s->file)
        return json_null();
    json_t *j = json_pack("{s:o, s:s, s:b, s:i, s:I}", "file", json_value_text(s->file), "kind", s->kind, "force", s->has_force, "impacts", f->events.n,
                          "run_into_neighbour", (json_int_t)f->touching);
    if (s->has_force) {
        json_t *more = json_pack("{s:o, s:o, s:o, s:o, s:I, s:I, s:I, s:I, s:I, s:I, s:o}", "rate_hz", json_value_number(s->signal.rate), "duration_s",
                                 json_value_number((double)s->signal.n / s->signal.rate), "greatest_n", json_value_number(f->greatest), "least_n", json_value_number(f->least), "alone",
                                 (json_int_t)f->alone, "with_shoulder", (json_int_t)f->merged, "left_out_below_threshold", (json_int_t)f->low,
                                 "left_out_not_prominent", (json_int_t)f->ripples, "both_ends_found", (json_int_t)f->feet, "duration_unknown",
                                 (json_int_t)f->unknown, "contact_time_over_width", json_value_number(f->stretch));
        json_object_update(j, more);
        json_decref(more);
    }
    return j;
}

static json_t *duration(const struct analysis *a)
{
    static const char *const from[] = {"given", "single", "alone", "none"};
    const struct impact_duration *d = &a->duration;
    if (!a->lasts)
        return json_null();
    return json_pack("{s:o, s:o, s:s, s:b, s:I, s:o, s:o, s:o, s:o, s:o, s:I, s:o, s:o}", "theta", json_value_number(d->theta), "theta_error", json_value_number(d->theta_error), "theta_from",
                     from[a->theta], "constant", a->constant, "singles", (json_int_t)d->singles, "theta_single", json_value_number(d->theta_single), "zeta_single_s", json_value_number(d->zeta_single), "r2_single", json_value_number(d->r2_single),
                     "r2_single_log", json_value_number(d->r2_single_log), "zeta_s", json_value_number(d->zeta), "impacts", (json_int_t)d->n, "r2", json_value_number(d->r2), "r2_log",
                     json_value_number(d->r2_log));
}

static json_t *shape(const struct impact_shape *h)
{
    if (h->fitted == 0)
        return json_null();
    return json_pack("{s:I, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "fitted", (json_int_t)h->fitted, "cosine_r2_5_50_95", list(h->r2[0], 3),
                     "meixner_r2_5_50_95", list(h->r2[1], 3), "meixner_b", json_value_number(h->b), "meixner_xi", json_value_number(h->xi), "cosine_over_contact_time",
                     json_value_number(h->stretch), "time_over_duration", list(h->q, IMPACT_SHAPE_POINTS), "mean", list(h->mean, IMPACT_SHAPE_POINTS), "deviation",
                     list(h->deviation, IMPACT_SHAPE_POINTS));
}

bool analyse_json(const struct analysis *a, struct err *e)
{
    json_t *j = json_pack("{s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "source", source(&a->source), "single", source(&a->single), "statistics", statistics(a),
                          "duration", duration(a), "shape", shape(&a->shape), "notes", json_value_texts(a->notes, a->n_notes), "written",
                          json_value_texts(a->written, a->n_written));
    bool ok = j && json_dumpf(j, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(12)) == 0;
    putchar('\n');
    json_decref(j);
    return ok || err_set(e, ERR_IO, "the report cannot be written as JSON");
}
