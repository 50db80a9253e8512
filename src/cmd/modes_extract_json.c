/* The report of `rasp modes extract` as JSON: SI units, null for what is not there. */
#include <math.h>
#include <stdio.h>

#include "cmd/modes_extract.h"
#include "file/json_value.h"
#include "num/real.h"

#define N json_value_number

static json_t *strikes(const struct modes_extract *x, const struct modes_extract_place *p)
{
    json_t *j = json_array();
    for (int k = 0; k < p->strikes.n; k++) {
        const struct strikes_one *v = &p->strikes.strike[k];
        json_array_append_new(
            j, json_pack("{s:o, s:o, s:o, s:b, s:b, s:b, s:o, s:o}", "onset_s", N((double)v->onset / x->rate), "peak",
                         N(v->peak), "momentum", N(v->momentum), "clipped", v->clipped, "doubled", v->doubled, "used",
                         !v->left_out, "left_out", v->left_out ? json_string(v->left_out) : json_null(), "explained",
                         N(modes_extract_find_explained(x, p, k))));
    }
    return j;
}

static json_t *place(const struct modes_extract *x, int k)
{
    const struct modes_extract_place *p = &x->place[k];
    const struct spectral_distance *d = &p->distance;
    json_t *distance = json_pack("{s:o, s:o, s:o, s:o}", "third_octave_mean_db", N(d->third_octave_mean),
                                 "third_octave_worst_db", N(d->third_octave_worst), "third_octave_worst_hz",
                                 N(d->worst_at), "log_spectral_db", N(d->log_spectral));
    return json_pack("{s:o, s:s, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "file", json_value_text(p->shown),
                     "sha256", p->hash, "x_m", N(p->x), "y_m", N(p->y), "strikes", strikes(x, p), "low_hz", N(p->low),
                     "high_hz", N(p->high), "delay_s", N(p->delay), "explained", N(p->explained), "predicted",
                     N(p->predicted), "noise_rms", N(p->noise), "distance", distance);
}

static json_t *gains(const struct modes_extract *x, const struct modes_extract_mode *m)
{
    json_t *j = json_array();
    for (int k = 0; k < x->n; k++) {
        double gain = sqrt(m->re[k] * m->re[k] + m->im[k] * m->im[k]);
        json_array_append_new(j, json_pack("{s:o, s:o, s:o, s:o}", "gain", N(gain), "gain_se", N(m->gain_se[k]),
                                           "phase_rad", N(real_atan2(m->im[k], m->re[k])), "phase_se_rad",
                                           N(m->gain_se[k] / gain)));
    }
    return j;
}

static json_t *modes(const struct modes_extract *x)
{
    json_t *j = json_array();
    for (int i = 0; i < x->components; i++) {
        const struct modes_extract_mode *m = &x->mode[i];
        json_array_append_new(j, json_pack("{s:i, s:i, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "mode", m->mode,
                                           "slope", m->slope, "frequency_hz", N(m->frequency), "frequency_se",
                                           N(m->frequency_se), "frequency_se_between", N(m->frequency_between),
                                           "decay_per_s", N(m->decay), "decay_se", N(m->decay_se), "decay_se_between",
                                           N(m->decay_between), "t60_s", N(3.0 * real_log(10.0) / m->decay), "share",
                                           N(m->share), "places", gains(x, m)));
    }
    return j;
}

bool modes_extract_json(const struct modes_extract *x, struct err *e)
{
    json_t *places = json_array(), *notes = json_array();
    for (int k = 0; k < x->n; k++)
        json_array_append_new(places, place(x, k));
    for (int k = 0; k < x->notes; k++)
        json_array_append_new(notes, json_value_text(x->note[k]));
    json_t *j =
        json_pack("{s:s, s:o, s:s, s:s, s:b, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "table", x->given.output,
                  "sample_rate", N(x->rate), "method", x->given.spectrogram ? "spectrogram" : "esprit", "quantity",
                  modes_quantity_name(x->quantity), "physical", x->physical, "low_hz", N(x->low), "high_hz", N(x->high),
                  "median_decay_per_s", N(x->median_decay), "median_decay_by_energy_per_s", N(x->median_by_energy),
                  "places", places, "modes", modes(x), "warnings", notes);
    bool ok = j && json_dumpf(j, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(12)) == 0;
    putchar('\n');
    json_decref(j);
    return ok || err_set(e, ERR_IO, "the report cannot be written as JSON");
}
