/* The report of rasp surface info as JSON: SI units, null for what is not there. */
#include <math.h>
#include <stdio.h>

#include "cmd/surface_info.h"
#include "file/json_value.h"

static json_t *json_heights(const struct surface_heights *s)
{
    return json_pack("{s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}",
                     "mean_m", json_value_number(s->mean),
                     "sa_m", json_value_number(s->sa),
                     "sq_m", json_value_number(s->sq),
                     "ssk", json_value_number(s->ssk),
                     "sku", json_value_number(s->sku),
                     "sz_m", json_value_number(s->sz),
                     "slope_rms_x", json_value_number(s->slope),
                     "slope_rms_y", json_value_number(s->slope_y),
                     "curvature_rms_x_per_m", json_value_number(s->curvature),
                     "curvature_rms_y_per_m", json_value_number(s->curvature_y));
}

static json_t *json_steps(const struct surface_heights_steps *s)
{
    json_t *limits = json_array();
    for (int k = 0; k < SURFACE_INFO_ALPHAS; k++)
        json_array_append_new(limits, json_pack("{s:f, s:f}", "alpha_m", surface_info_alphas[k], "noise_over_limit", s->noise * surface_info_alphas[k]));
    return json_pack("{s:f, s:I, s:I, s:f, s:f, s:o}",
                     "step_m", s->step,
                     "levels", (json_int_t)s->levels,
                     "heights_looked_at", (json_int_t)s->looked_at,
                     "curvature_noise_per_m", s->noise,
                     "curvature_noise_at_knots_per_m", 2.45 * s->noise,
                     "limiter", limits);
}

static json_t *json_band(const struct surface_band *b)
{
    if (b->segments == 0)
        return json_null();
    return json_pack("{s:o, s:b, s:o, s:f, s:o, s:o, s:o, s:o}",
                     "limit_cycles_per_m", json_value_number(b->limit),
                     "limit_is_noise_floor", b->noise,
                     "curvature_above_limit", json_value_number(b->beyond),
                     "nyquist_cycles_per_m", b->nyquist,
                     "oversampling", json_value_number(isnan(b->limit) ? 1 : b->nyquist / b->limit),
                     "exponent", json_value_number(b->exponent),
                     "exponent_from_cycles_per_m", json_value_number(b->from),
                     "exponent_to_cycles_per_m", json_value_number(b->to));
}

static json_t *json_ends(const struct surface_ends *s)
{
    return json_pack("{s:o, s:o, s:o, s:[I, I], s:[o, o]}",
                     "step_rms_m", json_value_number(s->step),
                     "jump_repeated_m", json_value_number(s->jump),
                     "slope_jump_mirrored", json_value_number(s->kink),
                     "fall_samples", (json_int_t)s->fall[0], (json_int_t)s->fall[1],
                     "fall_m", json_value_number(s->drop[0]), json_value_number(s->drop[1]));
}

static json_t *json_period(const struct surface_ends_period *p)
{
    if (isnan(p->peak))
        return json_null();
    return json_pack("{s:I, s:f, s:b}", "lag_samples", (json_int_t)p->lag, "autocorrelation", p->peak, "stands_out", p->stands_out);
}

static json_t *json_one(const struct surface_info *i)
{
    static const char *const levellings[] = {"none", "mean", "plane"};
    const struct heightfile *h = &i->h;
    bool map = h->rows > 1;
    json_t *notes = json_array();
    for (int k = 0; k < i->n_notes; k++)
        json_array_append_new(notes, json_value_text(i->notes[k]));
    return json_pack("{s:o, s:s, s:o, s:I, s:I, s:o, s:o, s:I, s:I, s:s, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}",
                     "file", json_value_text(i->file),
                     "format", h->format,
                     "title", json_value_text(h->title),
                     "columns", (json_int_t)h->columns,
                     "rows", (json_int_t)h->rows,
                     "pitch_x_m", json_value_number(h->pitch_x),
                     "pitch_y_m", json_value_number(map ? h->pitch_y : NAN),
                     "missing", (json_int_t)h->holes,
                     "filled", (json_int_t)h->filled,
                     "levelling", levellings[i->levelling],
                     "slope_x", json_value_number(i->tilt.slope_x),
                     "slope_y", json_value_number(map ? i->tilt.slope_y : NAN),
                     "heights", json_heights(&i->heights),
                     "quantisation", json_steps(&i->steps),
                     "band_x", json_band(&i->band[0]),
                     "band_y", map ? json_band(&i->band[1]) : json_null(),
                     "ends_x", json_ends(&i->ends[0]),
                     "ends_y", map ? json_ends(&i->ends[1]) : json_null(),
                     "repetition", json_period(&i->period),
                     "warnings", notes);
}

bool surface_info_json(const struct surface_info *const *list, int n, struct err *e)
{
    json_t *all = json_array(), *j;
    for (int k = 0; k < n; k++)
        json_array_append_new(all, json_one(list[k]));
    j = json_pack("{s:o}", "surfaces", all);
    bool ok = j && json_dumpf(j, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(12)) == 0;
    putchar('\n');
    json_decref(j);
    return ok || err_set(e, ERR_IO, "the report cannot be written as JSON");
}
