/* The report of `rasp compare` on two sounds, as text or as JSON. */
#include <math.h>
#include <stdio.h>

#include "cmd/compare_sound.h"
#include "file/json_value.h"
#include "num/real.h"

static double decibels(double x)
{
    return x > 0 ? 20 * real_log10(x) : -INFINITY;
}

static const char *encoding(const struct wav *w, struct arena *a)
{
    return w->bits ? arena_format(a, "%d-bit integers", w->bits) : "not integers";
}

static void print_form(const struct verdict *v)
{
    const struct wav *a = &v->sound[0], *b = &v->sound[1];
    double short_by = (double)a->frames - (double)b->frames, seconds[2] = {(double)a->frames / a->rate, (double)b->frames / b->rate};
    if (a->rate != b->rate)
        fprintf(v->ask->out, "rate                A %.9g Hz, B %.9g Hz\n", a->rate, b->rate);
    if (a->channels != b->channels)
        fprintf(v->ask->out, "channels            A %d, B %d\n", a->channels, b->channels);
    if (a->rate != b->rate)
        fprintf(v->ask->out, "length              A %.6f s, B %.6f s\n", seconds[0], seconds[1]);
    else if (a->frames != b->frames)
        fprintf(v->ask->out, "frames              A %zu, B %zu: B is %.0f (%.6f s) %s%s\n", a->frames, b->frames, fabs(short_by),
               fabs(seconds[0] - seconds[1]), short_by > 0 ? "shorter" : "longer", v->alike ? "; what both have is compared" : "");
    if (a->bits != b->bits)
        fprintf(v->ask->out, "encoding            A %s, B %s\n", encoding(a, v->ask->arena), encoding(b, v->ask->arena));
}

static void print_samples(const struct verdict *v)
{
    const struct distance_samples *d = &v->d;
    double step = distance_step(&v->sound[0], &v->sound[1]);
    size_t n = d->frames * (size_t)v->sound[0].channels;
    fprintf(v->ask->out, "differing samples   %zu of %zu (%.3g %%)\n", d->differing, n, 100 * (double)d->differing / (double)n);
    if (d->differing) {
        fprintf(v->ask->out, "first difference    %s\n", compare_sound_place(v, &d->first));
        fprintf(v->ask->out, "largest difference  ");
        if (step > 0)
            fprintf(v->ask->out, "%.6g LSB of %d bits, ", d->largest / step, 1 - ilogb(step));
        fprintf(v->ask->out, "%.2f dBFS, at %s\n", decibels(d->largest), compare_sound_place(v, &d->worst));
    }
    fprintf(v->ask->out, "SNR                 %.2f dB\n", d->snr_db);
}

static void print_figures(const struct verdict *v)
{
    if (v->paired)
        print_samples(v);
    else
        fprintf(v->ask->out, "samples             difference, LSB and SNR are left out, because the sample rates differ\n");
    if (v->bands.compared)
        fprintf(v->ask->out, "third-octave bands  at most %.4g dB apart, at %s\n", v->bands.worst_db, compare_sound_band(v));
    else
        fprintf(v->ask->out, "third-octave bands  none to compare\n");
}

void compare_sound_report_text(const struct verdict *v)
{
    const struct wav *a = &v->sound[0];
    fprintf(v->ask->out, "A %s\nB %s\n", v->ask->files[0], v->ask->files[1]);
    fprintf(v->ask->out, "sha256  A %s B %s\n", v->hash[0], v->hash[1]);
    print_form(v);
    if (v->equal)
        fprintf(v->ask->out, "equal: %zu frames (%.6f s), %d channel%s, %.9g Hz\n", a->frames, (double)a->frames / a->rate, a->channels,
               a->channels == 1 ? "" : "s", a->rate);
    else if (v->alike)
        print_figures(v);
    for (int i = 0; i < v->n_criteria && !v->equal; i++)
        fprintf(v->ask->out, "%s %s: %s\n", v->criteria[i].held ? "ok  " : "FAIL", v->criteria[i].name, v->criteria[i].says);
}

/* JSON has no infinities: null. */
/* Of frames or samples that have a partner: null where none has. */
static json_t *count(const struct verdict *v, size_t n)
{
    return v->paired ? json_integer((json_int_t)n) : json_null();
}

static json_t *name_or_null(const char *s)
{
    json_t *j = json_string(s); /* NULL: not UTF-8 */
    return j ? j : json_null();
}

static json_t *json_sound(const struct verdict *v, int i)
{
    const struct wav *w = &v->sound[i];
    return json_pack("{s:o, s:o, s:i, s:I, s:o, s:o}",
                     "file", name_or_null(v->ask->files[i]),
                     "rate_hz", json_value_number(w->rate),
                     "channels", w->channels,
                     "frames", (json_int_t)w->frames,
                     "duration_s", json_value_number((double)w->frames / w->rate),
                     "bits", w->bits ? json_integer(w->bits) : json_null());
}

static json_t *json_place(const struct verdict *v, const struct distance_place *p)
{
    if (!v->d.differing)
        return json_null();
    return json_pack("{s:I, s:o, s:i, s:o, s:o}",
                     "frame", (json_int_t)p->frame,
                     "time_s", json_value_number((double)p->frame / v->sound[0].rate),
                     "channel", p->channel + 1,
                     "a", json_value_number(p->a),
                     "b", json_value_number(p->b));
}

static json_t *json_bands(const struct verdict *v)
{
    const struct distance_bands *d = &v->bands;
    bool any = d->compared > 0;
    return json_pack("{s:i, s:o, s:o, s:o, s:o, s:o}",
                     "compared", d->compared,
                     "worst_db", json_value_number(d->worst_db),
                     "band_hz", json_value_number(any ? distance_band_nominal(d->band) : NAN),
                     "channel", any ? json_integer(d->channel + 1) : json_null(),
                     "a_db", json_value_number(any ? d->a_db : NAN),
                     "b_db", json_value_number(any ? d->b_db : NAN));
}

static json_t *json_criteria(const struct verdict *v)
{
    json_t *list = json_array();
    for (int i = 0; i < v->n_criteria; i++) {
        const struct criterion *c = &v->criteria[i];
        json_array_append_new(list, json_pack("{s:s, s:b, s:o, s:o, s:o}",
                                              "name", c->name,
                                              "held", c->held,
                                              "limit", json_value_number(c->limit),
                                              "measured", json_value_number(c->measured),
                                              "says", name_or_null(c->says)));
    }
    return list;
}

bool compare_sound_report_json(const struct verdict *v, struct err *e)
{
    const struct distance_samples *d = &v->d;
    json_t *j = json_pack("{s:b, s:b, s:[s, s], s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}",
                          "equal", v->equal,
                          "held", v->held,
                          "audio_sha256", v->hash[0], v->hash[1],
                          "a", json_sound(v, 0),
                          "b", json_sound(v, 1),
                          "frames_compared", count(v, d->frames),
                          "differing_samples", count(v, d->differing),
                          "first_difference", json_place(v, &d->first),
                          "largest_difference", json_value_number(v->paired ? d->largest : NAN),
                          "largest_difference_lsb", json_value_number(compare_sound_steps(v)),
                          "largest_difference_dbfs", json_value_number(v->paired ? decibels(d->largest) : NAN),
                          "largest_difference_at", json_place(v, &d->worst),
                          "snr_db", json_value_number(d->snr_db),
                          "third_octave", json_bands(v),
                          "criteria", json_criteria(v));
    bool ok = j && json_dumpf(j, v->ask->out, JSON_INDENT(2) | JSON_REAL_PRECISION(12)) == 0;
    fputc('\n', v->ask->out);
    json_decref(j);
    return ok || err_set(e, ERR_IO, "the report cannot be written as JSON");
}
