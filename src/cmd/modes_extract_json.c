/* The report of `rasp modes extract` as JSON: SI units, null for what is not there. */
#include <jansson.h>
#include <math.h>
#include <stdio.h>

#include "cmd/modes_extract.h"
#include "num/real.h"

static json_t *number(double x)
{
    return isfinite(x) ? json_real(x) : json_null();
}

static json_t *text(const char *s)
{
    json_t *j = s ? json_string(s) : NULL; /* NULL also for what is not UTF-8 */
    return j ? j : json_null();
}

static json_t *strikes(const struct modes_extract *x, const struct modes_extract_place *p)
{
    json_t *j = json_array();
    for (int k = 0; k < p->strikes.n; k++) {
        const struct strikes_one *v = &p->strikes.strike[k];
        json_array_append_new(j, json_pack("{s:o, s:o, s:o, s:b, s:b, s:b, s:o}", "onset_s", number((double)v->onset / x->rate), "peak", number(v->peak), "momentum",
                                           number(v->momentum), "clipped", v->clipped, "doubled", v->doubled, "used", !isnan(p->response.explained[k]), "explained",
                                           number(p->response.explained[k])));
    }
    return j;
}

static json_t *place(const struct modes_extract *x, int k)
{
    const struct modes_extract_place *p = &x->place[k];
    const struct spectral_distance *d = &p->distance;
    json_t *distance = json_pack("{s:o, s:o, s:o, s:o}", "third_octave_mean_db", number(d->third_octave_mean), "third_octave_worst_db", number(d->third_octave_worst),
                                 "third_octave_worst_hz", number(d->worst_at), "log_spectral_db", number(d->log_spectral));
    return json_pack("{s:o, s:s, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "file", text(p->shown), "sha256", p->hash, "x_m", number(p->x), "y_m", number(p->y),
                     "strikes", strikes(x, p), "response_s", number((double)p->response.n / x->rate), "low_hz", number(p->response.low), "high_hz", number(p->response.high),
                     "delay_s", number(p->response.delay), "regularisation", number(p->response.regularisation), "explained", number(x->modes.explained[k]), "noise_rms",
                     number(x->modes.noise[k]), "distance", distance);
}

static json_t *gains(const struct modes_extract *x, const struct ringing_mode *m)
{
    json_t *j = json_array();
    for (int k = 0; k < x->n; k++) {
        double gain = sqrt(m->re[k] * m->re[k] + m->im[k] * m->im[k]);
        json_array_append_new(j, json_pack("{s:o, s:o, s:o, s:o}", "gain", number(gain), "gain_error", number(m->gain_error[k]), "phase_rad",
                                           number(real_atan2(m->im[k], m->re[k])), "phase_error_rad", number(m->gain_error[k] / gain)));
    }
    return j;
}

static json_t *modes(const struct modes_extract *x)
{
    json_t *j = json_array();
    for (int i = 0; i < x->modes.n; i++) {
        const struct ringing_mode *m = &x->modes.mode[i];
        json_array_append_new(j, json_pack("{s:i, s:i, s:o, s:o, s:o, s:o, s:o, s:o}", "mode", m->mode, "slope", m->slope, "frequency_hz", number(m->frequency), "frequency_error",
                                           number(m->frequency_error), "decay_per_s", number(m->decay), "decay_error", number(m->decay_error), "t60_s",
                                           number(3.0 * real_log(10.0) / m->decay), "places", gains(x, m)));
    }
    return j;
}

bool modes_extract_json(const struct modes_extract *x, struct err *e)
{
    json_t *places = json_array(), *notes = json_array();
    for (int k = 0; k < x->n; k++)
        json_array_append_new(places, place(x, k));
    for (int k = 0; k < x->notes; k++)
        json_array_append_new(notes, text(x->note[k]));
    json_t *j = json_pack("{s:s, s:o, s:s, s:s, s:b, s:o, s:o, s:o, s:o, s:o, s:o}", "table", x->given.output, "sample_rate", number(x->rate), "method",
                          x->given.spectrogram ? "spectrogram" : "esprit", "quantity", modes_quantity_name(x->quantity), "physical", x->physical, "low_hz", number(x->low),
                          "high_hz", number(x->high), "median_decay_per_s", number(x->median_decay), "places", places, "modes", modes(x), "warnings", notes);
    bool ok = j && json_dumpf(j, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(12)) == 0;
    putchar('\n');
    json_decref(j);
    return ok || err_set(e, ERR_IO, "the report cannot be written as JSON");
}
