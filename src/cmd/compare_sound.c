/* rasp compare for sounds: figures first, then every criterion with its verdict, then the report as text or JSON.

   Rates, channels and numbers of frames must agree under every criterion, with one exception: when third-octave bands are all that is
   asked about, rates may differ, and lengths by one frame period of the lower rate. */
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "analysis/distance.h"
#include "cmd/compare.h"
#include "num/real.h"

enum { CRITERIA = 5 };

static const double range_db = 60; /* bands farther below the loudest are not heard beside it */

struct criterion {
    const char *name;
    double limit, measured; /* NAN: has none */
    bool held;
    const char *says;
};

struct verdict {
    const struct compare_ask *ask;
    struct wav sound[2];
    bool alike, shape;         /* same number of channels; same rate and frames as well */
    struct distance_samples d;
    struct distance_bands bands;
    struct criterion criteria[CRITERIA];
    int n_criteria;
    bool held, equal;
};

static double decibels(double x)
{
    return x > 0 ? 20 * real_log10(x) : -INFINITY;
}

static const char *place(const struct verdict *v, const struct distance_place *p)
{
    return arena_format(v->ask->arena, "frame %zu (%.6f s), channel %d: A %.9g, B %.9g", p->frame, (double)p->frame / v->sound[0].rate,
                        p->channel + 1, p->a, p->b);
}

static const char *band_place(const struct verdict *v)
{
    return arena_format(v->ask->arena, "%g Hz, channel %d: A %.2f dB, B %.2f dB", distance_band_nominal(v->bands.band),
                        v->bands.channel + 1, v->bands.a_db, v->bands.b_db);
}

static void judge(struct verdict *v, struct criterion c)
{
    v->criteria[v->n_criteria++] = c;
    v->held = v->held && c.held;
}

static void judge_form(struct verdict *v)
{
    const struct wav *a = &v->sound[0], *b = &v->sound[1];
    const struct compare_ask *ask = v->ask;
    bool bands_alone = !ask->exact && isnan(ask->snr) && isnan(ask->lsb);
    double off = fabs((double)a->frames / a->rate - (double)b->frames / b->rate);
    bool near = bands_alone && off <= 1.000001 / fmin(a->rate, b->rate);
    bool held = v->alike && (v->shape || near);
    const char *says = arena_format(ask->arena, "the sounds differ in%s%s%s", v->alike ? "" : " channels,",
                                    a->rate == b->rate ? "" : " rate,", off > 0 ? " length," : "");
    says = arena_format(ask->arena, "%.*s", (int)strlen(says) - 1, says); /* without the last comma */
    judge(v, (struct criterion){"form", NAN, NAN, held, held ? "channels, rate and length are as they should be" : says});
}

static void judge_exact(struct verdict *v)
{
    size_t n = v->d.frames * (size_t)v->sound[0].channels;
    bool held = v->alike && v->d.differing == 0;
    const char *says = !v->alike ? "not measured: the numbers of channels differ"
                       : held    ? "all samples compared are the same"
                                 : arena_format(v->ask->arena, "%zu of %zu samples differ, the first at %s", v->d.differing, n,
                                                place(v, &v->d.first));
    judge(v, (struct criterion){"exact", NAN, (double)v->d.differing, held, says});
}

/* A figure against a limit that it must not pass; sign +1: at most, -1: at least. */
static void judge_limit(struct verdict *v, struct criterion c, double sign, const char *unit_and_where[2])
{
    const char *unit = unit_and_where[0];
    struct arena *a = v->ask->arena;
    c.held = v->alike && sign * c.measured <= sign * c.limit;
    if (!v->alike)
        c.says = "not measured: the numbers of channels differ";
    else if (c.held)
        c.says = arena_format(a, "%.6g %s; %s %g %s is asked for", c.measured, unit, sign > 0 ? "at most" : "at least", c.limit, unit);
    else
        c.says = arena_format(a, "%.6g %s is %.6g %s %s the limit of %g %s; the worst at %s", c.measured, unit,
                              fabs(c.measured - c.limit), unit, sign > 0 ? "above" : "below", c.limit, unit, unit_and_where[1]);
    judge(v, c);
}

static double largest_in_steps(const struct verdict *v)
{
    double step = distance_step(&v->sound[0], &v->sound[1]);
    return step > 0 ? v->d.largest / step : NAN;
}

static void judge_all(struct verdict *v)
{
    const struct compare_ask *ask = v->ask;
    const char *worst = place(v, &v->d.worst);
    v->held = true;
    judge_form(v);
    if (ask->exact)
        judge_exact(v);
    if (!isnan(ask->snr))
        judge_limit(v, (struct criterion){"snr", ask->snr, v->d.snr_db, false, NULL}, -1, (const char *[]){"dB", worst});
    if (!isnan(ask->lsb))
        judge_limit(v, (struct criterion){"lsb", ask->lsb, largest_in_steps(v), false, NULL}, 1, (const char *[]){"LSB", worst});
    if (!isnan(ask->third_octave))
        judge_limit(v, (struct criterion){"third_octave", ask->third_octave, v->bands.worst_db, false, NULL}, 1,
                    (const char *[]){"dB", band_place(v)});
}

static bool measure(struct verdict *v, struct err *e)
{
    struct wav *a = &v->sound[0], *b = &v->sound[1];
    for (int i = 0; i < 2; i++)
        if (!wav_read(v->ask->files[i], v->ask->arena, &v->sound[i], e))
            return false;
    if (!isnan(v->ask->lsb) && distance_step(a, b) == 0)
        return err_set(e, ERR_USAGE, "--lsb: neither sound holds integers, so there is no step to count in; --snr is for such sounds");
    v->alike = a->channels == b->channels;
    v->shape = v->alike && a->rate == b->rate && a->frames == b->frames;
    v->d.snr_db = v->bands.worst_db = NAN;
    if (v->alike)
        distance_samples(a, b, &v->d);
    v->equal = v->shape && v->d.differing == 0;
    if (v->equal)
        v->bands.worst_db = 0;
    else if (v->alike)
        distance_bands(a, b, range_db, v->ask->arena, &v->bands);
    judge_all(v);
    return true;
}

static const char *encoding(const struct wav *w, struct arena *a)
{
    return w->bits ? arena_format(a, "%d-bit integers", w->bits) : "not integers";
}

static void print_form(const struct verdict *v)
{
    const struct wav *a = &v->sound[0], *b = &v->sound[1];
    double short_by = (double)a->frames - (double)b->frames;
    if (a->rate != b->rate)
        printf("rate                A %.9g Hz, B %.9g Hz\n", a->rate, b->rate);
    if (a->channels != b->channels)
        printf("channels            A %d, B %d\n", a->channels, b->channels);
    if (a->frames != b->frames)
        printf("frames              A %zu, B %zu: B is %.0f (%.6f s) %s%s\n", a->frames, b->frames, fabs(short_by),
               fabs((double)a->frames / a->rate - (double)b->frames / b->rate), short_by > 0 ? "shorter" : "longer",
               v->alike ? "; what both have is compared" : "");
    if (a->bits != b->bits)
        printf("encoding            A %s, B %s\n", encoding(a, v->ask->arena), encoding(b, v->ask->arena));
}

static void print_figures(const struct verdict *v)
{
    const struct distance_samples *d = &v->d;
    double step = distance_step(&v->sound[0], &v->sound[1]);
    size_t n = d->frames * (size_t)v->sound[0].channels;
    printf("differing samples   %zu of %zu (%.3g %%)\n", d->differing, n, 100 * (double)d->differing / (double)n);
    if (d->differing) {
        printf("first difference    %s\n", place(v, &d->first));
        printf("largest difference  ");
        if (step > 0)
            printf("%.6g LSB of %d bits, ", d->largest / step, 1 - ilogb(step));
        printf("%.2f dBFS, at %s\n", decibels(d->largest), place(v, &d->worst));
    }
    printf("SNR                 %.2f dB\n", d->snr_db);
    if (v->bands.compared)
        printf("third-octave bands  at most %.4g dB apart, at %s\n", v->bands.worst_db, band_place(v));
    else
        printf("third-octave bands  none to compare\n");
}

static void print_text(const struct verdict *v)
{
    const struct wav *a = &v->sound[0];
    printf("A %s\nB %s\n", v->ask->files[0], v->ask->files[1]);
    print_form(v);
    if (v->equal)
        printf("equal: %zu frames (%.6f s), %d channel%s, %.9g Hz\n", a->frames, (double)a->frames / a->rate, a->channels,
               a->channels == 1 ? "" : "s", a->rate);
    else if (v->alike)
        print_figures(v);
    for (int i = 0; i < v->n_criteria && !v->equal; i++)
        printf("%s %s: %s\n", v->criteria[i].held ? "ok  " : "FAIL", v->criteria[i].name, v->criteria[i].says);
}

/* JSON has no infinities: null. */
static json_t *number(double x)
{
    return isfinite(x) ? json_real(x) : json_null();
}

static json_t *name_or_null(const char *s)
{
    json_t *j = json_string(s); /* NULL: not UTF-8 */
    return j ? j : json_null();
}

static json_t *json_sound(const struct verdict *v, int i)
{
    const struct wav *w = &v->sound[i];
    return json_pack("{s:o, s:o, s:i, s:I, s:o}",
                     "file", name_or_null(v->ask->files[i]),
                     "rate_hz", number(w->rate),
                     "channels", w->channels,
                     "frames", (json_int_t)w->frames,
                     "bits", w->bits ? json_integer(w->bits) : json_null());
}

static json_t *json_place(const struct verdict *v, const struct distance_place *p)
{
    if (!v->d.differing)
        return json_null();
    return json_pack("{s:I, s:o, s:i, s:o, s:o}",
                     "frame", (json_int_t)p->frame,
                     "time_s", number((double)p->frame / v->sound[0].rate),
                     "channel", p->channel + 1,
                     "a", number(p->a),
                     "b", number(p->b));
}

static json_t *json_bands(const struct verdict *v)
{
    const struct distance_bands *d = &v->bands;
    bool any = d->compared > 0;
    return json_pack("{s:i, s:o, s:o, s:o, s:o, s:o}",
                     "compared", d->compared,
                     "worst_db", number(d->worst_db),
                     "band_hz", number(any ? distance_band_nominal(d->band) : NAN),
                     "channel", any ? json_integer(d->channel + 1) : json_null(),
                     "a_db", number(any ? d->a_db : NAN),
                     "b_db", number(any ? d->b_db : NAN));
}

static json_t *json_criteria(const struct verdict *v)
{
    json_t *list = json_array();
    for (int i = 0; i < v->n_criteria; i++) {
        const struct criterion *c = &v->criteria[i];
        json_array_append_new(list, json_pack("{s:s, s:b, s:o, s:o, s:o}",
                                              "name", c->name,
                                              "held", c->held,
                                              "limit", number(c->limit),
                                              "measured", number(c->measured),
                                              "says", name_or_null(c->says)));
    }
    return list;
}

static bool print_json(const struct verdict *v, struct err *e)
{
    const struct distance_samples *d = &v->d;
    json_t *j = json_pack("{s:b, s:b, s:o, s:o, s:I, s:I, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}",
                          "equal", v->equal,
                          "held", v->held,
                          "a", json_sound(v, 0),
                          "b", json_sound(v, 1),
                          "frames_compared", (json_int_t)d->frames,
                          "differing_samples", (json_int_t)d->differing,
                          "first_difference", json_place(v, &d->first),
                          "largest_difference", number(v->alike ? d->largest : NAN),
                          "largest_difference_lsb", number(v->alike ? largest_in_steps(v) : NAN),
                          "largest_difference_dbfs", number(decibels(d->largest)),
                          "largest_difference_at", json_place(v, &d->worst),
                          "snr_db", number(d->snr_db),
                          "third_octave", json_bands(v),
                          "criteria", json_criteria(v));
    bool ok = j && json_dumpf(j, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(12)) == 0;
    putchar('\n');
    json_decref(j);
    return ok || err_set(e, ERR_IO, "the report cannot be written as JSON");
}

int compare_sound(const struct compare_ask *ask, struct err *e)
{
    struct verdict *v = ARENA_TAKE(ask->arena, struct verdict, 1);
    v->ask = ask;
    if (!measure(v, e))
        return (int)e->kind;
    if (ask->quiet && v->held)
        return 0;
    if (ask->json && !print_json(v, e))
        return (int)e->kind;
    if (!ask->json)
        print_text(v);
    return v->held ? 0 : ERR_DIFFERS;
}
