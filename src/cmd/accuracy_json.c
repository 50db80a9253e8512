/* The table of `rasp accuracy` as JSON. */
#include <math.h>

#include "cmd/accuracy.h"
#include "file/json_value.h"
#include "num/real.h"
#include "scene/keys.h"

/* JSON has no infinities: null. */
static json_t *error_json(const struct accuracy_render *r)
{
    const struct accuracy_error *o = &r->error;
    if (r->code != 0)
        return json_pack("{s:i, s:o}", "exit_code", r->code, "says", json_value_text(r->words));
    return json_pack("{s:o, s:b, s:o, s:o, s:o, s:o, s:o}",
                     "snr_db", json_value_number(o->snr),
                     "same_samples", isinf(o->snr) && o->snr > 0,
                     "third_octave_db", json_value_number(o->third),
                     "third_octave_hz", json_value_number(o->third_hz),
                     "spectral_db", json_value_number(o->spectral),
                     "level_db", json_value_number(o->level),
                     "follows_s", json_value_number(o->follows));
}

static json_t *cost_json(const struct accuracy_render *r)
{
    if (r->code != 0)
        return json_null();
    return json_pack("{s:o, s:o, s:o, s:o}",
                     "cpu_s", json_value_number(r->cpu),
                     "real_time_factor", json_value_number(r->error.length / fmax(r->cpu, 1e-9)),
                     "peak_bytes", json_value_number(r->peak),
                     "contact_share", json_value_number(r->contact_share));
}

static json_t *row_json(const struct accuracy_sweep *s, const struct accuracy_row *w)
{
    const struct accuracy_render *r = &s->renders[w->total];
    return json_pack("{s:s, s:s, s:b, s:o, s:o, s:o, s:o, s:b, s:b}",
                     "setting", w->name,
                     "value", w->value,
                     "scene", w->chosen,
                     "alone", w->alone >= 0 ? error_json(&s->renders[w->alone]) : json_null(),
                     "order", json_value_number(w->order),
                     "total", error_json(r),
                     "cost", cost_json(r),
                     "front", r->front,
                     "below_reference", accuracy_judge_below(s, r));
}

static json_t *own_json(const struct accuracy_sweep *s)
{
    json_t *own = json_object();
    for (int k = 0; k < KNOBS; k++)
        if (s->knobs & 1u << k)
            json_object_set_new(own, keys_knobs[k].name, json_value_number(s->own[k] > 0.0 ? 20.0 * real_log10(s->own[k]) : NAN));
    return own;
}

bool accuracy_json(const struct accuracy_sweep *s, struct err *e)
{
    json_t *rows = json_array();
    for (int i = 0; i < s->n_rows; i++)
        json_array_append_new(rows, row_json(s, &s->rows[i]));
    json_t *j = json_pack("{s:o, s:s, s:o, s:o, s:i, s:i, s:o, s:o, s:o, s:o}",
                          "scene", json_value_text(s->file),
                          "compared", s->force ? "force" : "sound",
                          "length_s", json_value_number(s->length),
                          "rate_hz", json_value_number(s->rate),
                          "channels", s->channels,
                          "runs", s->runs,
                          "diverges_s", json_value_number(s->until),
                          "reference_error_db", json_value_number(-s->own_db),
                          "reference_errors_db", own_json(s),
                          "settings", rows);
    bool ok = j && json_dumpf(j, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(9)) == 0;
    putchar('\n');
    json_decref(j);
    return ok || err_set(e, ERR_IO, "the report cannot be written as JSON");
}
