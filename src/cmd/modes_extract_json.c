/* The report of `rasp modes extract` as JSON: SI units, null for what is not there. */
#include <math.h>
#include <stdio.h>

#include "cmd/modes_extract.h"
#include "file/json_value.h"
#include "num/real.h"

static json_t *strikes(const struct modes_extract *x, const struct modes_extract_place *p)
{
    json_t *j = json_array();
    for (int k = 0; k < p->strikes.n; k++) {
        const struct strikes_one *v = &p->strikes.strike[k];
        json_array_append_new(j, json_pack("{s:o, s:o, s:o, s:b, s:b, s:b, s:o}", "onset_s", json_value_number((double)v->onset / x->rate), "peak", json_value_number(v->peak), "momentum",
                                           json_value_number(v->momentum), "clipped", v->clipped, "doubled", v->doubled, "used", !isnan(p->response.explained[k]), "explained",
                                           json_value_number(p->response.explained[k])));
    }
    return j;
}

static json_t *place(const struct modes_extract *x, int k)
{
    const struct modes_extract_place *p = &x->place[k];
    const struct spectral_distance *d = &p->distance;
    json_t *distance = json_pack("{s:o, s:o, s:o, s:o}", "third_octave_mean_db", json_value_number(d->third_octave_mean), "third_octave_worst_db", json_value_number(d->third_octave_worst),
                                 "third_octave_worst_hz", json_value_number(d->worst_at), "log_spectral_db", json_value_number(d->log_spectral));
    return json_pack("{s:o, s:s, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "file", json_value_text(p->shown), "sha256", p->hash, "x_m", json_value_number(p->x), "y_m", json_value_number(p->y),
                     "strikes", strikes(x, p), "response_s", json_value_number((double)p->response.n / x->rate), "low_hz", json_value_number(p->response.low), "high_hz", json_value_number(p->response.high),
                     "delay_s", json_value_number(p->response.delay), "regularisation", json_value_number(p->response.regularisation), "explained", json_value_number(x->modes.explained[k]), "noise_rms",
                     json_value_number(x->modes.noise[k]), "distance", distance);
}

static json_t *gains(const struct modes_extract *x, const struct ringing_mode *m)
{
    json_t *j = json_array();
    for (int k = 0; k < x->n; k++) {
        double gain = sqrt(m->re[k] * m->re[k] + m->im[k] * m->im[k]);
        json_array_append_new(j, json_pack("{s:o, s:o, s:o, s:o}", "gain", json_value_number(gain), "gain_error", json_value_number(m->gain_error[k]), "phase_rad",
                                           json_value_number(real_atan2(m->im[k], m->re[k])), "phase_error_rad", json_value_number(m->gain_error[k] / gain)));
    }
    return j;
}

static json_t *modes(const struct modes_extract *x)
{
    json_t *j = json_array();
    for (int i = 0; i < x->modes.n; i++) {
        const struct ringing_mode *m = &x->modes.mode[i];
        json_array_append_new(j, json_pack("{s:i, s:i, s:o, s:o, s:o, s:o, s:o, s:o}", "mode", m->mode, "slope", m->slope, "frequency_hz", json_value_number(m->frequency), "frequency_error",
                                           json_value_number(m->frequency_error), "decay_per_s", json_value_number(m->decay), "decay_error", json_value_number(m->decay_error), "t60_s",
                                           json_value_number(3.0 * real_log(10.0) / m->decay), "places", gains(x, m)));
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
    json_t *j = json_pack("{s:s, s:o, s:s, s:s, s:b, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "table", x->given.output, "sample_rate", json_value_number(x->rate), "method",
                          x->given.spectrogram ? "spectrogram" : "esprit", "quantity", modes_quantity_name(x->quantity), "physical", x->physical, "low_hz", json_value_number(x->low),
                          "high_hz", json_value_number(x->high), "median_decay_per_s", json_value_number(x->median_decay), "median_decay_by_energy_per_s", json_value_number(x->median_by_energy), "places", places, "modes", modes(x), "warnings", notes);
    bool ok = j && json_dumpf(j, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(12)) == 0;
    putchar('\n');
    json_decref(j);
    return ok || err_set(e, ERR_IO, "the report cannot be written as JSON");
}
