/* rasp compare for sounds: figures first, then every criterion with its verdict; compare_sound_report.c prints them.

   Rates, channels and numbers of frames must agree under every criterion, with one exception: when third-octave bands are all that is
   asked about, rates may differ, and lengths by one frame period of the lower rate. Sounds of different rates are not compared sample
   by sample: equal frame numbers are not equal times. */
#include "cmd/compare_sound.h"

#include <math.h>
#include <string.h>

const char *compare_sound_place(const struct verdict *v, const struct distance_place *p)
{
    return arena_format(v->ask->arena, "frame %zu (%.6f s), channel %d: A %.9g, B %.9g", p->frame, (double)p->frame / v->sound[0].rate,
                        p->channel + 1, p->a, p->b);
}

const char *compare_sound_band(const struct verdict *v)
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
    if (held)
        says = a->rate == b->rate ? "channels, rate and length are as they should be" : "channels and length are as they should be; rates may differ";
    judge(v, (struct criterion){"form", NAN, NAN, held, says});
}

/* Why no sample of A has a partner in B. */
static const char *unpaired(const struct verdict *v)
{
    return v->alike ? "not measured: the sample rates differ" : "not measured: the numbers of channels differ";
}

static void judge_exact(struct verdict *v)
{
    size_t n = v->d.frames * (size_t)v->sound[0].channels;
    bool held = v->paired && v->d.differing == 0;
    const char *says = !v->paired ? unpaired(v)
                       : held     ? "all samples compared are the same"
                                  : arena_format(v->ask->arena, "%zu of %zu samples differ, the first at %s", v->d.differing, n,
                                                 compare_sound_place(v, &v->d.first));
    judge(v, (struct criterion){"exact", NAN, v->paired ? (double)v->d.differing : NAN, held, says});
}

/* A figure against a limit that it must not pass; sign +1: at most, -1: at least. */
static void judge_limit(struct verdict *v, struct criterion c, double sign, const char *unit_and_where[2])
{
    const char *unit = unit_and_where[0];
    struct arena *a = v->ask->arena;
    c.held = sign * c.measured <= sign * c.limit; /* not when it is NAN: not measured */
    if (isnan(c.measured) && !v->paired)
        c.says = unpaired(v);
    else if (c.held)
        c.says = arena_format(a, "%.6g %s; %s %g %s is asked for", c.measured, unit, sign > 0 ? "at most" : "at least", c.limit, unit);
    else
        c.says = arena_format(a, "%.6g %s is %.6g %s %s the limit of %g %s; the worst at %s", c.measured, unit,
                              fabs(c.measured - c.limit), unit, sign > 0 ? "above" : "below", c.limit, unit, unit_and_where[1]);
    judge(v, c);
}

double compare_sound_steps(const struct verdict *v)
{
    double step = distance_step(&v->sound[0], &v->sound[1]);
    return v->paired && step > 0 ? v->d.largest / step : NAN;
}

static void judge_all(struct verdict *v)
{
    const struct compare_ask *ask = v->ask;
    const char *worst = compare_sound_place(v, &v->d.worst);
    v->held = true;
    judge_form(v);
    if (ask->exact)
        judge_exact(v);
    if (!isnan(ask->snr))
        judge_limit(v, (struct criterion){"snr", ask->snr, v->d.snr_db, false, NULL}, -1, (const char *[]){"dB", worst});
    if (!isnan(ask->lsb))
        judge_limit(v, (struct criterion){"lsb", ask->lsb, compare_sound_steps(v), false, NULL}, 1, (const char *[]){"LSB", worst});
    if (!isnan(ask->third_octave))
        judge_limit(v, (struct criterion){"third_octave", ask->third_octave, v->bands.worst_db, false, NULL}, 1,
                    (const char *[]){"dB", compare_sound_band(v)});
}

static bool measure(struct verdict *v, struct err *e)
{
    struct wav *a = &v->sound[0], *b = &v->sound[1];
    for (int i = 0; i < 2; i++)
        if (!wav_read(v->ask->files[i], v->ask->arena, &v->sound[i], e))
            return false;
        else
            distance_hash(&v->sound[i], v->hash[i]);
    if (!isnan(v->ask->lsb) && distance_step(a, b) == 0)
        return err_set(e, ERR_USAGE, "--lsb: neither sound holds integers, so there is no step to count in; --snr is for such sounds");
    v->alike = a->channels == b->channels;
    v->paired = v->alike && a->rate == b->rate;
    v->shape = v->paired && a->frames == b->frames;
    v->d.snr_db = v->bands.worst_db = NAN;
    if (v->paired)
        distance_samples(a, b, &v->d);
    v->equal = v->shape && v->d.differing == 0;
    if (v->equal)
        v->bands.worst_db = 0;
    else if (v->alike)
        distance_bands(a, b, v->ask->within, v->ask->arena, &v->bands);
    judge_all(v);
    return true;
}

int compare_sound(const struct compare_ask *ask, struct err *e)
{
    struct verdict *v = ARENA_TAKE(ask->arena, struct verdict, 1);
    v->ask = ask;
    if (!measure(v, e))
        return (int)e->kind;
    if (ask->quiet && v->held)
        return 0;
    if (ask->json && !compare_sound_report_json(v, e))
        return (int)e->kind;
    if (!ask->json)
        compare_sound_report_text(v);
    return v->held ? 0 : ERR_DIFFERS;
}
