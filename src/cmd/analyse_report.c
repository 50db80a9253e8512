/* The report of `rasp analyse` as text. */
#include "cmd/analyse.h"

#include <gsl/gsl_randist.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "analysis/frequency_polygon.h"
#include "base/outfile.h"
#include "base/wrap.h"
#include "file/csv.h"
#include "file/json_value.h"
#include "num/real.h"
#include "output/mark.h"
#include "output/picture.h"

static json_t *estimate(const struct estimate *x);
static json_t *series(const struct analysis *a, int k);
static json_t *statistics(const struct analysis *a);
static json_t *source(const struct analyse_source *s);
static json_t *duration(const struct analysis *a);
static json_t *shape(const struct impact_shape *h);
static void correlation(const char *what, const double *x, int first, double bound, struct gnuplot *g);

/* Intervals are shown in ms. */
static double shown(int series, double x) { return series == STATISTICS_AMPLITUDE ? x : 1e3 * x; }

static const char *plural(long n) { return n == 1 ? "" : "s"; }

static void line(const char *name) { printf("  %-22s ", name); }

/* ------------------------------------------------------------------ what was found */

static void print_source(const struct analyse_source *s, long which)
{
    const struct impact_events *v = &s->found.events;
    if (s->has_force) {
        const struct impact_found *f = &s->found;
        char channel[40] = "";
        if (s->channels > 1) snprintf(channel, sizeof channel, ", channel %ld of %d", which, s->channels);
        printf("%s: a force, %s%s, %.6g s at %.6g Hz, from %.4g to %.4g N\n", s->file, s->kind, channel,
               (double)s->signal.n / s->signal.rate, s->signal.rate, f->least, f->greatest);
        line("impacts");
        printf("%d: %ld stand%s alone, %ld run%s into a neighbour, %ld with a shoulder\n", f->events.n, f->alone,
               f->alone == 1 ? "s" : "", f->touching, f->touching == 1 ? "s" : "", f->merged);
        line("left out");
        printf("%ld maxim%s below the threshold, %ld that %s not prominent\n", f->low, f->low == 1 ? "um" : "a",
               f->ripples, f->ripples == 1 ? "is" : "are");
        line("contact time");
        if (f->feet)
            printf("%.4g times the width at half height (of %ld impact%s; 2: raised cosines, 1.82: Hertz's)\n",
                   f->stretch, f->feet, plural(f->feet));
        else
            printf("taken as twice the width at half height, as of raised cosines (none stands alone, or all are "
                   "short)\n");
    } else {
        printf("%s: %d impact%s in %.6g s", s->file, v->n, plural(v->n), v->time[v->n - 1] - v->time[0]);
        if (s->found.touching)
            printf(", %ld run%s into the one before", s->found.touching, s->found.touching == 1 ? "s" : "");
        putchar('\n');
    }
}

/* ------------------------------------------------------------------ statistics */

static void print_estimates(const struct analysis *a, const char *name, size_t offset)
{
    line(name);
    for (int k = 0; k < STATISTICS_SERIES; k++) {
        const struct estimate *x = (const void *)((const char *)&a->statistics.series[k] + offset);
        double scale =
            offset == offsetof(struct series_statistics, a1) || offset == offsetof(struct series_statistics, b1)
                ? 1
                : shown(k, 1);
        char text[64];
        snprintf(text, sizeof text, "%.4g (%.4g to %.4g)", scale * x->value, scale * x->low, scale * x->high);
        printf(k ? "%s\n" : "%-33s ", text);
    }
}

#define PRINT_PAIR(name, format, ...)                                                                                  \
    do {                                                                                                               \
        line(name);                                                                                                    \
        for (int k = 0; k < STATISTICS_SERIES; k++) {                                                                  \
            const struct series_statistics *s = &a->statistics.series[k];                                              \
            char text[64];                                                                                             \
            snprintf(text, sizeof text, format, __VA_ARGS__);                                                          \
            if (s->flat) snprintf(text, sizeof text, "all alike");                                                     \
            printf(k ? "%s\n" : "%-33s ", text);                                                                       \
        }                                                                                                              \
    } while (0)

static void print_statistics(const struct analysis *a)
{
    const struct impact_statistics *t = &a->statistics;
    const struct impact_modulation *m = &t->modulation;
    putchar('\n');
    line("");
    printf("%-33s %s\n", "amplitude / N", "interval / ms");
    print_estimates(a, "mean", offsetof(struct series_statistics, mean));
    PRINT_PAIR("standard deviation", "%.4g", shown(k, sqrt(s->variance)));
    print_estimates(a, "a1", offsetof(struct series_statistics, a1));
    print_estimates(a, "b1", offsetof(struct series_statistics, b1));
    print_estimates(a, "white: deviation", offsetof(struct series_statistics, deviation));
    PRINT_PAIR("  whiteness", "Q %.3g, p %.3g", s->whiteness, s->whiteness_p);
    PRINT_PAIR("  skewness, kurtosis", "%.3g, %.3g", s->white.skewness, s->white.kurtosis);
    PRINT_PAIR("  normal", "R2 %.3f, distance %.3f%s", s->white.gaussian_r2, s->white.gaussian_distance,
               analyse_tabled(a, k) ? ": table" : "");
    PRINT_PAIR("series, normal", "R2 %.3f, distance %.3f", s->itself.gaussian_r2, s->itself.gaussian_distance);
    PRINT_PAIR("  exponential", isnan(s->itself.exponential_mean) ? "no values above 0" : "mean %.4g, distance %.3f",
               shown(k, s->itself.exponential_mean), s->itself.exponential_distance);
    PRINT_PAIR("  gamma", isnan(s->itself.gamma_shape) ? "values below 0" : "%.3g x %.3g, distance %.3f",
               s->itself.gamma_shape, shown(k, s->itself.gamma_scale), s->itself.gamma_distance);
    line("one process");
    if (isnan(t->one_process))
        puts("not told: a series is constant");
    else
        printf("%s: the whitened series' correlation by ranks is %.3f\n", analyse_one_process(a) ? "yes" : "no",
               t->one_process);
    line("modulation");
    if (m->found)
        printf("depth %.3g at %.4g Hz\n", m->depth, m->rate);
    else if (!m->looked)
        puts("not looked for");
    else if (m->depth == 0)
        puts("none");
    else
        printf("none (the strongest: depth %.3g at %.4g Hz, as strong by chance with probability %.2g)\n", m->depth,
               m->rate, m->probability);
}

/* ------------------------------------------------------------------ durations and shapes */

static void print_duration(const struct analysis *a)
{
    static const char *const from[] = {[ANALYSE_THETA_GIVEN] = "",
                                       [ANALYSE_THETA_FILE] = "single impacts",
                                       [ANALYSE_THETA_ALONE] = "those that stand alone",
                                       [ANALYSE_THETA_NONE] = ""};
    const struct impact_duration *d = &a->duration;
    const char *whose = a->theta == ANALYSE_THETA_ALONE && !a->source.has_force ? "all" : from[a->theta];
    if (!a->lasts) return;
    putchar('\n');
    line("duration, step 1");
    if (d->singles && a->theta != ANALYSE_THETA_NONE) {
        printf("%.4g ms", 1e3 * d->zeta_single);
        if (isnan(d->r2_single))
            printf(", all alike");
        else
            printf(" A^%.4f (+- %.4f), R2 %.4f, of its logarithm %.4f", -d->theta_single, d->theta_error, d->r2_single,
                   d->r2_single_log);
        printf(", over %ld impact%s: %s\n", d->singles, plural(d->singles), whose);
    } else
        printf("theta %.4g, %s\n", d->theta, a->theta == ANALYSE_THETA_GIVEN ? "given" : "since it cannot be told");
    line("duration, step 2");
    printf("%.4g ms", 1e3 * d->zeta);
    if (d->theta > 0) printf(" A^-%.4f, A in N, R2 %.4f, of its logarithm %.4f", d->theta, d->r2, d->r2_log);
    printf(a->constant ? ", the median of %ld impact%s\n" : ", over %ld impact%s\n", d->n, plural(d->n));
}

static void print_shape(const struct analysis *a)
{
    const struct impact_shape *h = &a->shape;
    if (!a->source.has_force) return;
    if (h->fitted == 0) {
        line("shape");
        printf("no impact of %d to %d samples stands alone, to be fitted\n", IMPACT_SHAPE_LEAST, IMPACT_SHAPE_LONGEST);
        return;
    }
    line("raised cosine");
    printf("median R2 %.4f (of %ld impact%s; 5 %%: below %.4f, 95 %%: below %.4f), %.4g times the contact time\n",
           h->r2[0][1], h->fitted, plural(h->fitted), h->r2[0][0], h->r2[0][2], h->stretch);
    line("Meixner window");
    printf("median R2 %.4f (5 %%: below %.4f, 95 %%: below %.4f), ", h->r2[1][1], h->r2[1][0], h->r2[1][2]);
    printf(h->b < 1e4 ? "b %.4g, xi %.4g\n" : "at its limit of large b (xi -> 0)\n", h->b, h->xi);
}

void analyse_report_print(const struct analysis *a)
{
    print_source(&a->source, a->given.channel);
    if (a->single.file) print_source(&a->single, a->given.channel);
    if (a->counted) print_statistics(a);
    print_duration(a);
    print_shape(a);
    for (int i = 0; i < a->n_notes; i++) {
        fputs(i ? "" : "\n", stdout);
        fputs("  note: ", stdout);
        wrap_print(stdout, a->notes[i], 8, "        ");
    }
    for (int i = 0; i < a->n_written; i++)
        printf("%s%s\n", i ? "" : "\nwritten:\n", a->written[i]);
}

/* The report of `rasp analyse` as JSON: SI units, null for what is not there. */

static json_t *list(const double *x, int n)
{
    json_t *j = json_array();
    for (int i = 0; i < n; i++)
        json_array_append_new(j, json_value_number(x[i]));
    return j;
}

static json_t *estimate(const struct estimate *x)
{
    return json_pack("{s:o, s:o, s:o, s:o}", "value", json_value_number(x->value), "error", json_value_number(x->error),
                     "low", json_value_number(x->low), "high", json_value_number(x->high));
}

static json_t *distribution(const struct distribution_fits *d)
{
    return json_pack("{s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "gaussian_r2", json_value_number(d->gaussian_r2),
                     "gaussian_distance", json_value_number(d->gaussian_distance), "exponential_mean",
                     json_value_number(d->exponential_mean), "exponential_distance",
                     json_value_number(d->exponential_distance), "gamma_shape", json_value_number(d->gamma_shape),
                     "gamma_scale", json_value_number(d->gamma_scale), "gamma_distance",
                     json_value_number(d->gamma_distance), "skewness", json_value_number(d->skewness), "kurtosis",
                     json_value_number(d->kurtosis));
}

static json_t *series(const struct analysis *a, int k)
{
    const struct series_statistics *s = &a->statistics.series[k];
    return json_pack("{s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:b, s:b, s:s, s:o, s:o, s:o, s:o}", "mean",
                     estimate(&s->mean), "a1", estimate(&s->a1), "b1", estimate(&s->b1), "white_deviation",
                     estimate(&s->deviation), "variance", json_value_number(s->variance), "whiteness_q",
                     json_value_number(s->whiteness), "whiteness_p", json_value_number(s->whiteness_p), "flat", s->flat,
                     "ridge", s->ridge, "white_distribution", analyse_tabled(a, k) ? "table" : "gaussian", "white",
                     distribution(&s->white), "series", distribution(&s->itself), "correlation",
                     list(s->correlation, STATISTICS_LAGS), "white_correlation",
                     list(s->white_correlation, STATISTICS_LAGS));
}

static json_t *statistics(const struct analysis *a)
{
    const struct impact_statistics *t = &a->statistics;
    const struct impact_modulation *m = &t->modulation;
    if (!a->counted) return json_null();
    json_t *modulation = !m->looked ? json_null()
                                    : json_pack("{s:o, s:o, s:o, s:b}", "depth", json_value_number(m->depth), "rate_hz",
                                                json_value_number(m->rate), "probability",
                                                json_value_number(m->probability), "found", m->found);
    return json_pack("{s:o, s:o, s:o, s:b, s:o, s:o, s:o}", "amplitude_n", series(a, STATISTICS_AMPLITUDE),
                     "interval_s", series(a, STATISTICS_INTERVAL), "one_process", json_value_number(t->one_process),
                     "one_process_taken", analyse_one_process(a), "modulation", modulation, "cross_correlation",
                     list(t->cross, 2 * STATISTICS_LAGS - 1), "white_cross_correlation",
                     list(t->white_cross, 2 * STATISTICS_LAGS - 1));
}

static json_t *source(const struct analyse_source *s)
{
    const struct impact_found *f = &s->found;
    if (!s->file) return json_null();
    json_t *j = json_pack("{s:o, s:s, s:b, s:i, s:I}", "file", json_value_text(s->file), "kind", s->kind, "force",
                          s->has_force, "impacts", f->events.n, "run_into_neighbour", (json_int_t)f->touching);
    if (s->has_force) {
        json_t *more = json_pack(
            "{s:o, s:o, s:o, s:o, s:I, s:I, s:I, s:I, s:I, s:I, s:o}", "rate_hz", json_value_number(s->signal.rate),
            "duration_s", json_value_number((double)s->signal.n / s->signal.rate), "greatest_n",
            json_value_number(f->greatest), "least_n", json_value_number(f->least), "alone", (json_int_t)f->alone,
            "with_shoulder", (json_int_t)f->merged, "left_out_below_threshold", (json_int_t)f->low,
            "left_out_not_prominent", (json_int_t)f->ripples, "both_ends_found", (json_int_t)f->feet,
            "duration_unknown", (json_int_t)f->unknown, "contact_time_over_width", json_value_number(f->stretch));
        json_object_update(j, more);
        json_decref(more);
    }
    return j;
}

static json_t *duration(const struct analysis *a)
{
    static const char *const from[] = {"given", "single", "alone", "none"};
    const struct impact_duration *d = &a->duration;
    if (!a->lasts) return json_null();
    return json_pack("{s:o, s:o, s:s, s:b, s:I, s:o, s:o, s:o, s:o, s:o, s:I, s:o, s:o}", "theta",
                     json_value_number(d->theta), "theta_error", json_value_number(d->theta_error), "theta_from",
                     from[a->theta], "constant", a->constant, "singles", (json_int_t)d->singles, "theta_single",
                     json_value_number(d->theta_single), "zeta_single_s", json_value_number(d->zeta_single),
                     "r2_single", json_value_number(d->r2_single), "r2_single_log", json_value_number(d->r2_single_log),
                     "zeta_s", json_value_number(d->zeta), "impacts", (json_int_t)d->n, "r2", json_value_number(d->r2),
                     "r2_log", json_value_number(d->r2_log));
}

static json_t *shape(const struct impact_shape *h)
{
    if (h->fitted == 0) return json_null();
    return json_pack("{s:I, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "fitted", (json_int_t)h->fitted,
                     "cosine_r2_5_50_95", list(h->r2[0], 3), "meixner_r2_5_50_95", list(h->r2[1], 3), "meixner_b",
                     json_value_number(h->b), "meixner_xi", json_value_number(h->xi), "cosine_over_contact_time",
                     json_value_number(h->stretch), "time_over_duration", list(h->q, IMPACT_SHAPE_POINTS), "mean",
                     list(h->mean, IMPACT_SHAPE_POINTS), "deviation", list(h->deviation, IMPACT_SHAPE_POINTS));
}

bool analyse_report_json(const struct analysis *a, struct err *e)
{
    json_t *j =
        json_pack("{s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "source", source(&a->source), "single", source(&a->single),
                  "statistics", statistics(a), "duration", duration(a), "shape", shape(&a->shape), "notes",
                  json_value_texts(a->notes, a->n_notes), "written", json_value_texts(a->written, a->n_written));
    bool ok = j && json_dumpf(j, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(12)) == 0;
    putchar('\n');
    json_decref(j);
    return ok || err_set(e, ERR_IO, "the report cannot be written as JSON");
}

/* The parameter file of `rasp analyse`: a scene part that a scene includes, and tables of density beside it. */

static bool name_free(const struct analysis *a, const char *file, struct err *e)
{
    return mark_absent(file, a->force, e);
}

bool analyse_report_free(const struct analysis *a, const char *file, struct err *e)
{
    size_t n = strlen(file);
    if (n < 6 || strcmp(file + n - 5, ".yaml") != 0)
        return err_set(e, ERR_USAGE, "--output %s: must end in .yaml", file);
    return name_free(a, file, e);
}

/* What was read is never replaced, whatever its name. */
static bool name_other(const struct analysis *a, const char *file, struct err *e)
{
    const char *const read[2] = {a->source.file, a->single.file};
    struct stat there, was;
    for (int i = 0; i < 2; i++)
        if (read[i] && stat(file, &there) == 0 && stat(read[i], &was) == 0 && there.st_dev == was.st_dev &&
            there.st_ino == was.st_ino)
            return err_set(e, ERR_CREATE, "%s is what was analysed; give --output another name", file);
    return true;
}

/* ------------------------------------------------------------------ values */

struct part {
    struct analysis *a;
    const char *table[STATISTICS_SERIES];   /* file; NULL: none */
    double least_amplitude, least_interval; /* NAN: not given */
};

/* No value that the keys refuse (scene/keys.def): said here, with what to do. */
static bool value_fits(const char *what, double x, double low, double high, struct err *e)
{
    return (x >= low && x <= high) ||
           err_set(e, ERR_SCENE,
                   "%s is %.6g, and a scene takes %.6g to %.6g: no file is written. Is the unit right, and the series "
                   "steady? A part of it may be",
                   what, x, low, high);
}

static bool values_fit(const struct analysis *a, struct err *e)
{
    for (int k = 0; k < STATISTICS_SERIES; k++) {
        const struct series_statistics *s = &a->statistics.series[k];
        if (!value_fits(k ? "a1 of the intervals" : "a1 of the amplitudes", s->a1.value, -0.9999, 0.9999, e) ||
            !value_fits(k ? "b1 of the intervals" : "b1 of the amplitudes", s->b1.value, -10, 10, e) ||
            !value_fits(k ? "mean interval in s" : "mean amplitude in N", s->mean.value, k ? 1e-6 : -1e6, 1e6, e) ||
            !value_fits(k ? "deviation of the intervals in s" : "deviation of the amplitudes in N", s->deviation.value,
                        0, 1e6, e))
            return false;
    }
    const struct impact_modulation *m = &a->statistics.modulation;
    if (m->found && m->rate > 1000)
        return err_set(
            e, ERR_SCENE,
            "the rate of the modulation is %.6g Hz, and a scene takes 0 to 1000: no file is written. If it is a beat "
            "of the series with its own grid, "
            "--keep-modulation leaves it in the amplitudes; of a force of either sign, --signed may find none",
            m->rate);
    if (!a->lasts)
        return err_set(e, ERR_SCENE, "%s: no duration is known, and a scene needs one: %s", a->source.file,
                       analyse_notes_unknown(a));
    return value_fits("theta", a->duration.theta, 0, 2, e) && value_fits("zeta in s", a->duration.zeta, 1e-7, 10, e);
}

/* Seconds that the longest impact would last, at the least |A| that a scene takes (force/impact_law.h), which may be
 * far below what was seen: 10 is the most. */
static bool longest_fits(const struct part *p, struct err *e)
{
    const struct analysis *a = p->a;
    const struct series_statistics *s = &a->statistics.series[STATISTICS_AMPLITUDE];
    double a1 = s->a1.value, b1 = s->b1.value, mean = s->mean.value,
           depth = a->statistics.modulation.found ? fmin(a->statistics.modulation.depth, 1) : 0;
    double rms =
        sqrt(mean * mean + s->deviation.value * s->deviation.value * (1 + b1 * b1 - 2 * a1 * b1) / (1 - a1 * a1));
    double least = isnan(p->least_amplitude) ? HUGE_VAL : p->least_amplitude * mean * (1 - depth);
    double lasts = a->duration.zeta * real_pow(fmax(fmin(least, 0.01 * rms), 0.001 * rms), -a->duration.theta);
    return a->duration.theta == 0 || lasts <= 10 ||
           err_set(e, ERR_SCENE,
                   "with theta %.4g an impact of the least amplitude that a scene takes would last %.4g s, and at most "
                   "10 s make sense: no file is "
                   "written. Give a lower --theta",
                   a->duration.theta, lasts);
}

/* ------------------------------------------------------------------ text */

static void put_comment(FILE *f, const char *text)
{
    fputs("# ", f);
    wrap_print(f, text, 2, "#   ");
}

/* A file's name as it may stand in a comment. */
static const char *source_name(const struct analysis *a)
{
    char *name = arena_text(a->arena, a->source.file);
    for (char *p = name; *p; p++)
        *p = (unsigned char)*p < ' ' ? '?' : *p;
    return name;
}

/* As YAML reads it, whatever characters it has. */
static void put_name(FILE *f, const char *name)
{
    fputc('\'', f);
    for (const char *p = name; *p; p++) {
        if (*p == '\'') fputc('\'', f);
        fputc(*p, f);
    }
    fputc('\'', f);
}

static void put_value(FILE *f, const char *key, const struct estimate *x, const char *unit)
{
    fprintf(f, "      %s: %.9g%s%s  # %.4g to %.4g\n", key, x->value, *unit ? " " : "", unit, x->low, x->high);
}

static void put_rest(const struct part *p, FILE *f)
{
    const struct analysis *a = p->a;
    const struct impact_duration *d = &a->duration;
    const struct impact_modulation *m = &a->statistics.modulation;
    fprintf(f, "    duration: {zeta: %.9g s, theta: %.9g}", d->zeta, d->theta);
    if (d->theta > 0)
        fprintf(f, "  # R2 %.4f over %ld impact%s", d->r2, d->n, d->n == 1 ? "" : "s");
    else if (a->constant)
        fprintf(f, "  # no law: the median of %ld impact%s", d->n, d->n == 1 ? "" : "s");
    fputc('\n', f);
    if (m->found)
        fprintf(f, "    modulation: {depth: %.9g, rate: %.9g Hz}\n", fmin(m->depth, 1), m->rate);
    else
        fprintf(f, "    modulation: {depth: 0}  # %s\n", m->looked ? "none found" : "not looked for");
    fprintf(f, "    floor: {");
    if (!isnan(p->least_amplitude)) fprintf(f, "amplitude: %.9g, ", p->least_amplitude);
    fprintf(f, "interval: %.9g s}  # the least that was seen%s\n", p->least_interval,
            isnan(p->least_amplitude) ? "; amplitudes keep their sign" : "");
    fprintf(f, "    processes: %s  # ", analyse_one_process(a) ? "one" : "two");
    if (isnan(a->statistics.one_process))
        fputs("a series is constant\n", f);
    else
        fprintf(f, "the whitened series' correlation by ranks is %.3f\n", a->statistics.one_process);
}

static void put_part(const struct part *p, FILE *f)
{
    const struct analysis *a = p->a;
    const struct impact_found *found = &a->source.found;
    put_comment(f, arena_format(a->arena,
                                "Impacts as those in %s, found by rasp analyse. A scene takes this part by `include:`.",
                                source_name(a)));
    if (a->source.has_force)
        put_comment(
            f, arena_format(
                   a->arena,
                   "%d impacts in %.6g s of force at %.6g Hz; %ld maxima left out; %ld alone, %ld with a shoulder.",
                   found->events.n, (double)a->source.signal.n / a->source.signal.rate, a->source.signal.rate,
                   found->events.fewer, found->alone, found->merged));
    else
        put_comment(f, arena_format(a->arena, "%d impacts.", found->events.n));
    put_comment(f, "After each value its 95 % interval. Deviations are those of the whitened series.");
    for (int i = 0; i < a->n_notes; i++)
        put_comment(f, arena_format(a->arena, "Note: %s", a->notes[i]));
    fputs("contact:\n  model: impacts\n  impacts:\n    prototype: custom\n    unit_force: 1 N\n", f);
    for (int k = 0; k < STATISTICS_SERIES; k++) {
        const struct series_statistics *s = &p->a->statistics.series[k];
        const char *unit = k == STATISTICS_INTERVAL ? "s" : "";
        fprintf(f, "    %s:\n", analyse_series_names[k]);
        put_value(f, "mean", &s->mean, unit);
        if (p->table[k]) {
            fprintf(f, "      distribution: table\n      table: ");
            put_name(f, p->table[k]);
            fprintf(f, "  # standard deviation %.6g%s%s\n", s->deviation.value, *unit ? " " : "", unit);
        } else
            put_value(f, "deviation", &s->deviation, unit);
        put_value(f, "a1", &s->a1, "");
        put_value(f, "b1", &s->b1, "");
    }
    put_rest(p, f);
}

static void put_table(const struct part *p, int k, FILE *f)
{
    const struct analysis *a = p->a;
    struct frequency_polygon t;
    frequency_polygon_make(a->statistics.white[k], a->statistics.n - 1, a->statistics.series[k].deviation.value,
                           a->arena, &t);
    fprintf(f, "# density of the whitened %ss of %s, value in %s\nvalue,density\n", analyse_series_names[k],
            source_name(a), k ? "s" : "N");
    for (int i = 0; i < t.n; i++) {
        csv_put_number(f, t.value[i]);
        fputc(',', f);
        csv_put_number(f, t.density[i]);
        fputc('\n', f);
    }
}

/* ------------------------------------------------------------------ files */

static FILE *files_open(const struct analysis *a, struct analyse_files *all, const char *file, struct err *e)
{
    if (!name_free(a, file, e) || !name_other(a, file, e) || !outfile_open(&all->o[all->n], file, e)) return NULL;
    all->name[all->n] = file;
    return all->o[all->n++].stream;
}

bool analyse_report_part(struct analysis *a, const char *file, struct analyse_files *all, struct err *e)
{
    struct part p = {.a = a};
    FILE *f;
    const char *slash = strrchr(file, '/');
    long folder = slash ? slash - file + 1 : 0;
    if (!values_fit(a, e)) return false;
    /* Floors: the least that was seen, of amplitudes if they have one sign, and no more than the mean, which may lie
   below it: it is estimated with the filter. As both are written with the same digits, the floor is not above the mean
   there either. */
    const struct impact_events *v = &p.a->source.found.events;
    const double *amplitude = p.a->statistics.demodulated;
    double least = HUGE_VAL, interval = p.a->statistics.series[STATISTICS_INTERVAL].mean.value,
           mean = p.a->statistics.series[STATISTICS_AMPLITUDE].mean.value;
    for (int i = 0; i < v->n; i++)
        least = fmin(least, amplitude[i]);
    for (int i = 0; i + 1 < v->n; i++)
        interval = fmin(interval, v->time[i + 1] - v->time[i]);
    p.least_amplitude = least > 0 && mean > 0 ? fmin(least / mean, 1) : NAN;
    p.least_interval = fmin(fmax(interval, 1e-6), 1);
    if (!longest_fits(&p, e)) return false;
    for (int k = 0; k < STATISTICS_SERIES && e->kind == ERR_NONE; k++) {
        if (!analyse_tabled(a, k)) continue;
        const char *table = arena_format(a->arena, "%.*s.%s.csv", (int)strlen(file) - 5, file, analyse_series_names[k]);
        p.table[k] = table + folder;
        if ((f = files_open(a, all, table, e))) put_table(&p, k, f);
    }
    if (e->kind == ERR_NONE && (f = files_open(a, all, file, e))) /* the file that names the tables comes last */
        put_part(&p, f);
    return e->kind == ERR_NONE;
}

/* The plots of `rasp analyse`, after the figures of papers/002:

     correlations   left the series: amplitude with interval, amplitude, interval (figure 4); right the whitened ones
   (figures 6 and 8), with the bounds that 95 % of the lags of white noise keep to distributions  above of the whitened
   series, with the normal density of the same deviation (figure 9); below of the series itself, also with an
   exponential and a gamma density where these are nearer than the normal one duration       over amplitude, both
   logarithmic, with the law (equation 12) shape          the mean impact, with the raised cosine (equation 9) and the
   Meixner window fitted to it */

enum { BARS = 40 };

#define BLUE "#0072b2"
#define RED "#d55e00"
#define GREEN "#009e73"

struct picture {
    const struct analysis *a;
    bool svg;
};

static void head(const struct picture *p, const char *size, struct gnuplot *g)
{
    fprintf(g->in,
            p->svg ? "set terminal svg size %s font 'DejaVu Sans,13' background rgb 'white'\n"
                   : "set terminal pngcairo size %s font 'DejaVu Sans,10' background rgb 'white'\n",
            size);
    fputs("set encoding utf8\nset border linewidth 0.8\nset tics out nomirror scale 0.6\nset style fill solid 1.0 "
          "noborder\n"
          "set key noenhanced top right samplen 2 spacing 1.1\n",
          g->in);
}

static void title(const struct picture *p, const char *what, struct gnuplot *g)
{
    fputs("set title ", g->in);
    gnuplot_put_text(g, arena_format(p->a->arena, "%s: %s", p->a->source.file, what));
    fputs(" noenhanced\n", g->in);
}

/* ------------------------------------------------------------------ correlations */

static void correlation(const char *what, const double *x, int first, double bound, struct gnuplot *g)
{
    int n = first < 0 ? 2 * STATISTICS_LAGS - 1 : STATISTICS_LAGS;
    fputs("$x << END\n", g->in);
    for (int i = 0; i < n; i++)
        fprintf(g->in, "%d %.9g\n", first + i, x[i]);
    fprintf(g->in, "END\nset title '%s'\nset xrange [%d:%d]\n", what, first < 0 ? first : -1, STATISTICS_LAGS - 1);
    if (bound > 0)
        fprintf(
            g->in,
            "set arrow 1 from graph 0, first %.6g to graph 1, first %.6g nohead dashtype 3 linecolor rgb '#888888'\n"
            "set arrow 2 from graph 0, first %.6g to graph 1, first %.6g nohead dashtype 3 linecolor rgb '#888888'\n",
            bound, bound, -bound, -bound);
    fputs("plot $x with impulses linewidth 1.6 linecolor rgb '" BLUE "' notitle\nunset arrow\n", g->in);
}

static void draw_correlations(void *self, struct gnuplot *g)
{
    const struct picture *p = self;
    const struct impact_statistics *t = &p->a->statistics;
    double bound = 1.96 / sqrt(t->n);
    head(p, "1000,900", g);
    fputs("set multiplot layout 3,2 title ", g->in);
    gnuplot_put_text(g, arena_format(p->a->arena, "%s: correlations over lags", p->a->source.file));
    fputs(" noenhanced\nset yrange [-1:1.05]\nset xzeroaxis linetype 1 linewidth 0.5 linecolor rgb '#888888'\n", g->in);
    correlation("amplitude with interval", t->cross, 1 - STATISTICS_LAGS, 0, g);
    correlation("whitened amplitude with interval", t->white_cross, 1 - STATISTICS_LAGS, bound, g);
    for (int k = 0; k < STATISTICS_SERIES; k++) {
        correlation(analyse_series_names[k], t->series[k].correlation, 0, 0, g);
        correlation(k ? "whitened interval" : "whitened amplitude", t->series[k].white_correlation, 0, bound, g);
    }
    fputs("unset multiplot\n", g->in);
}

/* ------------------------------------------------------------------ distributions */

struct values {
    const double *x;
    int n;
    double mean, deviation, unit; /* unit: what is drawn for 1 */
    const struct distribution_fits *fits;
};

static void plot_distribution(const struct values *v, const char *what, const char *unit, bool white, struct gnuplot *g)
{
    const struct distribution_fits *f = v->fits;
    double low = v->mean - 4 * v->deviation, high = v->mean + 4 * v->deviation;
    /* at, bar, normal, exponential and gamma density, over 4 deviations to each side of the mean */
    double sd = v->deviation, step = 8 * sd / BARS, count[BARS] = {0};

    for (int i = 0; i < v->n; i++) {
        double at = floor((v->x[i] - v->mean) / step + BARS / 2.0);
        if (at >= 0 && at < BARS) count[(int)at]++;
    }
    fputs("$x << END\n", g->in);
    for (int i = 0; i < BARS; i++) {
        double d = (i - BARS / 2.0 + 0.5) * step, at = v->mean + d;
        double exponential = at > 0 ? real_exp(-at / f->exponential_mean) / f->exponential_mean : 0;
        double gamma = at > 0 && f->gamma_shape > 0 ? gsl_ran_gamma_pdf(at, f->gamma_shape, f->gamma_scale) : 0;
        fprintf(g->in, "%.9g %.9g %.9g %.9g %.9g\n", at * v->unit, count[i] / v->n / step / v->unit,
                real_exp(-0.5 * d * d / sd / sd) / sd / sqrt(2 * REAL_PI) / v->unit, exponential / v->unit,
                gamma / v->unit);
    }
    fputs("END\n", g->in);
    fprintf(g->in,
            "set xlabel '%s%s / %s'\nset ylabel 'density / (1/%s)'\nset xrange [%.9g:%.9g]\nset yrange [0:*]\nset "
            "boxwidth %.9g\n",
            white ? "whitened " : "", what, unit, unit, low * v->unit, high * v->unit,
            0.92 * (high - low) / BARS * v->unit);
    fprintf(g->in, "set title 'normal: R² %.3f, Kolmogorov''s distance %.3f' noenhanced\n", f->gaussian_r2,
            f->gaussian_distance);
    fputs("plot $x using 1:2 with boxes linecolor rgb '#9ecae1' notitle, '' using 1:3 smooth csplines linewidth 2 "
          "linecolor rgb '" RED "' title 'normal'",
          g->in);
    if (!white && f->exponential_distance < f->gaussian_distance)
        fprintf(g->in,
                ", '' using 1:4 with lines linewidth 2 linecolor rgb '" BLUE "' title 'exponential, distance %.3f'",
                f->exponential_distance);
    if (!white && f->gamma_distance < f->gaussian_distance) /* NAN: none */
        fprintf(g->in, ", '' using 1:5 with lines linewidth 2 linecolor rgb '" GREEN "' title 'gamma, distance %.3f'",
                f->gamma_distance);
    fputc('\n', g->in);
}

static double spread(double deviation) { return deviation > 0 ? deviation : 1; }

static const double *intervals(const struct analysis *a)
{
    const struct impact_events *v = &a->source.found.events;
    double *x = ARENA_TAKE(a->arena, double, v->n);
    for (int i = 0; i + 1 < v->n; i++)
        x[i] = v->time[i + 1] - v->time[i];
    return x;
}

static void draw_distributions(void *self, struct gnuplot *g)
{
    const struct picture *p = self;
    const struct impact_statistics *t = &p->a->statistics;
    const double *itself[STATISTICS_SERIES] = {t->demodulated, intervals(p->a)};
    head(p, "1000,840", g);
    fputs("set multiplot layout 2,2 title ", g->in);
    gnuplot_put_text(g, arena_format(p->a->arena, "%s: distributions", p->a->source.file));
    fputs(" noenhanced\n", g->in);
    for (int panel = 0; panel < 2 * STATISTICS_SERIES; panel++) {
        int k = panel % STATISTICS_SERIES;
        bool white = panel < STATISTICS_SERIES;
        const struct series_statistics *s = &t->series[k];
        struct values v = {white ? t->white[k] : itself[k],
                           white || k ? t->n - 1 : t->n,
                           white ? 0 : s->mean.value,
                           spread(white ? s->deviation.value : sqrt(s->variance)),
                           k ? 1e3 : 1,
                           white ? &s->white : &s->itself};
        plot_distribution(&v, analyse_series_names[k], k ? "ms" : "N", white, g);
    }
    fputs("unset multiplot\n", g->in);
}

/* ------------------------------------------------------------------ duration */

static void points(const char *name, const struct impact_events *v, struct gnuplot *g)
{
    fprintf(g->in, "$%s << END\n", name);
    for (int i = 0; i < v->n; i++)
        if (v->duration[i] > 0 && v->amplitude[i] != 0)
            fprintf(g->in, "%.9g %.9g\n", fabs(v->amplitude[i]), 1e3 * v->duration[i]);
    fputs("END\n", g->in);
}

static void draw_duration(void *self, struct gnuplot *g)
{
    const struct picture *p = self;
    const struct analysis *a = p->a;
    const struct impact_duration *d = &a->duration;
    head(p, "760,560", g);
    title(p, "durations", g);
    points("series", &a->source.found.events, g);
    if (a->single.file) points("single", &a->single.found.events, g);
    fprintf(g->in, "set logscale xy\nset xlabel 'amplitude A / N'\nset ylabel 'duration / ms'\nset samples 500\n"
                   "plot $series with points pointtype 7 pointsize 0.35 linecolor rgb '" BLUE "' title 'impacts'");
    if (a->single.file)
        fprintf(g->in,
                ", $single with points pointtype 6 pointsize 0.7 linecolor rgb '" GREEN "' title 'single impacts', "
                "%.9g*x**(-(%.9g)) with lines linewidth 1 dashtype 2 linecolor rgb '" GREEN "' title 'step 1'",
                1e3 * d->zeta_single, d->theta_single);
    fprintf(g->in, ", %.9g*x**(-%.9g) with lines linewidth 2 linecolor rgb '" RED "' title '%.4g ms A^-%.3f'\n",
            1e3 * d->zeta, d->theta, 1e3 * d->zeta, d->theta);
}

/* ------------------------------------------------------------------ shape */

static void draw_shape(void *self, struct gnuplot *g)
{
    const struct picture *p = self;
    const struct impact_shape *h = &p->a->shape;
    head(p, "760,560", g);
    title(p, arena_format(p->a->arena, "mean of %ld impacts", h->fitted), g);
    fputs("$x << END\n", g->in);
    for (int j = 0; j < IMPACT_SHAPE_POINTS; j++)
        fprintf(g->in, "%.9g %.9g %.9g %.9g %.9g %.9g\n", h->q[j], h->mean[j], h->mean[j] - h->deviation[j],
                h->mean[j] + h->deviation[j], h->model[0][j], h->model[1][j]);
    fprintf(g->in,
            "END\nset xlabel 'time from the maximum / duration'\nset ylabel 'force / amplitude'\nset xrange "
            "[-0.75:0.75]\nset yrange [-0.1:1.15]\n"
            "plot $x using 1:3:4 with filledcurves fillcolor rgb '#cfe3f1' title '± 1 standard deviation', '' using "
            "1:2 with lines linewidth 2.5 linecolor "
            "rgb '" BLUE "' title 'mean', '' using 1:5 with lines linewidth 2 dashtype 2 linecolor rgb '" RED
            "' title 'raised cosine, R² of the mean %.4f', "
            "'' using 1:6 with lines linewidth 2 dashtype 4 linecolor rgb '" GREEN
            "' title 'Meixner window, R² of the mean %.4f'\n",
            h->of_mean[0].r2, h->of_mean[1].r2);
}

/* ------------------------------------------------------------------ files */

/* What the files' names begin with. */
static const char *prefix_of(const struct analysis *a, const char *prefix)
{
    struct stat s;
    size_t n = strlen(prefix);
    const char *slash = strrchr(a->source.file, '/'), *name = slash ? slash + 1 : a->source.file,
               *dot = strrchr(name, '.');
    if (!(n > 0 && prefix[n - 1] == '/') && (stat(prefix, &s) != 0 || !S_ISDIR(s.st_mode))) return prefix;
    return arena_format(a->arena, "%s%s%.*s", prefix, n > 0 && prefix[n - 1] == '/' ? "" : "/",
                        (int)(dot ? dot - name : (long)strlen(name)), name);
}

bool analyse_report_plot(struct analysis *a, const char *prefix, bool svg, struct analyse_files *to, struct err *e)
{
    struct picture p = {a, svg};
    const struct {
        const char *name;
        void (*draw)(void *, struct gnuplot *);
        bool there;
    } all[] = {{"correlations", draw_correlations, true},
               {"distributions", draw_distributions, true},
               {"duration", draw_duration, a->lasts},
               {"shape", draw_shape, a->shape.fitted > 0}};
    prefix = prefix_of(a, prefix);
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        const char *file = arena_format(a->arena, "%s.%s.%s", prefix, all[i].name, svg ? "svg" : "png");
        if (!all[i].there) continue;
        if (!mark_permits(file, NULL, a->force, e) || !picture_draw(&to->o[to->n], file, svg, all[i].draw, &p, e))
            return false;
        to->name[to->n++] = file;
    }
    return true;
}
