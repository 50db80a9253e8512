/* The report of `rasp analyse` as text. */
#include "cmd/analyse.h"

#include <gsl/gsl_randist.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "analysis/distribution_fit.h"
#include "base/outfile.h"
#include "base/relpath.h"
#include "base/text.h"
#include "cmd/cmd.h"
#include "cmd/report.h"
#include "file/csv.h"
#include "num/real.h"
#include "output/gnuplot.h"
#include "output/mark.h"

/* Intervals are shown in ms. */
static double shown(int series, double x) { return series == STATISTICS_AMPLITUDE ? x : 1e3 * x; }

static const char *plural(long n) { return n == 1 ? "" : "s"; }

static void line(struct report *r, const char *name) { report_text(r, "  %-22s ", name); }

/* ------------------------------------------------------------------ what was found */

static void print_source(struct report *r, const struct analyse_source *s, long which)
{
    const struct impact_events *v = &s->found.events;
    if (s->has_force) {
        const struct impact_found *f = &s->found;
        char channel[40] = "";
        if (s->channels > 1) snprintf(channel, sizeof channel, ", channel %ld of %d", which, s->channels);
        report_text(r, "%s: a force, %s%s, %.6g s at %.6g Hz, from %.4g to %.4g N\n", s->file, s->kind, channel,
                    (double)s->signal.n / s->signal.rate, s->signal.rate, f->least, f->greatest);
        line(r, "impacts");
        report_text(r, "%d: %ld stand%s alone, %ld run%s into a neighbour, %ld with a shoulder\n", f->events.n,
                    f->alone, f->alone == 1 ? "s" : "", f->touching, f->touching == 1 ? "s" : "", f->merged);
        line(r, "left out");
        report_text(r, "%ld maxim%s below the threshold, %ld that %s not prominent\n", f->low, f->low == 1 ? "um" : "a",
                    f->ripples, f->ripples == 1 ? "is" : "are");
        line(r, "contact time");
        if (f->feet)
            report_text(r, "%.4g times the width at half height (of %ld impact%s; 2: raised cosines, 1.82: Hertz's)\n",
                        f->stretch, f->feet, plural(f->feet));
        else
            report_text(r, "taken as twice the width at half height, as of raised cosines (none stands alone, or all "
                           "are short)\n");
    } else {
        report_text(r, "%s: %d impact%s in %.6g s", s->file, v->n, plural(v->n), v->time[v->n - 1] - v->time[0]);
        if (s->found.touching)
            report_text(r, ", %ld run%s into the one before", s->found.touching, s->found.touching == 1 ? "s" : "");
        report_text(r, "\n");
    }
}

/* ------------------------------------------------------------------ statistics */

static void print_estimates(struct report *r, const struct analysis *a, const char *name, size_t offset)
{
    line(r, name);
    for (int k = 0; k < STATISTICS_SERIES; k++) {
        const struct estimate *x = (const void *)((const char *)&a->statistics.series[k] + offset);
        double scale =
            offset == offsetof(struct series_statistics, a1) || offset == offsetof(struct series_statistics, b1)
                ? 1
                : shown(k, 1);
        char text[64];
        snprintf(text, sizeof text, "%.4g (%.4g to %.4g)", scale * x->value, scale * x->low, scale * x->high);
        report_text(r, k ? "%s\n" : "%-33s ", text);
    }
}

#define PRINT_PAIR(name, format, ...)                                                                                  \
    do {                                                                                                               \
        line(r, name);                                                                                                 \
        for (int k = 0; k < STATISTICS_SERIES; k++) {                                                                  \
            const struct series_statistics *s = &a->statistics.series[k];                                              \
            char text[64];                                                                                             \
            snprintf(text, sizeof text, format, __VA_ARGS__);                                                          \
            if (s->flat) snprintf(text, sizeof text, "all alike");                                                     \
            report_text(r, k ? "%s\n" : "%-33s ", text);                                                               \
        }                                                                                                              \
    } while (0)

static void print_statistics(struct report *r, const struct analysis *a)
{
    const struct impact_statistics *t = &a->statistics;
    const struct impact_modulation *m = &t->modulation;
    report_text(r, "\n");
    line(r, "");
    report_text(r, "%-33s %s\n", "amplitude / N", "interval / ms");
    print_estimates(r, a, "mean", offsetof(struct series_statistics, mean));
    PRINT_PAIR("standard deviation", "%.4g", shown(k, sqrt(s->variance)));
    print_estimates(r, a, "a1", offsetof(struct series_statistics, a1));
    print_estimates(r, a, "b1", offsetof(struct series_statistics, b1));
    print_estimates(r, a, "white: deviation", offsetof(struct series_statistics, deviation));
    PRINT_PAIR("  whiteness", "Q %.3g, p %.3g", s->whiteness, s->whiteness_p);
    PRINT_PAIR("  skewness, kurtosis", "%.3g, %.3g", s->white.skewness, s->white.kurtosis);
    PRINT_PAIR("  normal", "R2 %.3f, distance %.3f%s", s->white.gaussian_r2, s->white.gaussian_distance,
               analyse_tabled(a, k) ? ": table" : "");
    PRINT_PAIR("series, normal", "R2 %.3f, distance %.3f", s->itself.gaussian_r2, s->itself.gaussian_distance);
    PRINT_PAIR("  exponential", isnan(s->itself.exponential_mean) ? "no values above 0" : "mean %.4g, distance %.3f",
               shown(k, s->itself.exponential_mean), s->itself.exponential_distance);
    PRINT_PAIR("  gamma", isnan(s->itself.gamma_shape) ? "values below 0" : "%.3g x %.3g, distance %.3f",
               s->itself.gamma_shape, shown(k, s->itself.gamma_scale), s->itself.gamma_distance);
    line(r, "one process");
    if (isnan(t->one_process))
        report_text(r, "not told: a series is constant\n");
    else
        report_text(r, "%s: the whitened series' correlation by ranks is %.3f\n", analyse_one_process(a) ? "yes" : "no",
                    t->one_process);
    line(r, "modulation");
    if (m->found)
        report_text(r, "depth %.3g at %.4g Hz\n", m->depth, m->rate);
    else if (!m->looked)
        report_text(r, "not looked for\n");
    else if (m->depth == 0)
        report_text(r, "none\n");
    else
        report_text(r, "none (the strongest: depth %.3g at %.4g Hz, as strong by chance with probability %.2g)\n",
                    m->depth, m->rate, m->probability);
}

/* ------------------------------------------------------------------ durations and shapes */

static void report_shape(struct report *r, const struct analysis *a)
{
    const struct impact_shape *h = &a->shape;
    if (h->fitted > 0)
        report_set(r,
                   "shape:{ fitted:l cosine_r2_5_50_95:a meixner_r2_5_50_95:a meixner_b:n meixner_xi:n "
                   "cosine_over_contact_time:n time_over_duration:a mean:a deviation:a }",
                   h->fitted, h->r2[0], 3, h->r2[1], 3, h->b, h->xi, h->stretch, h->q, IMPACT_SHAPE_POINTS, h->mean,
                   IMPACT_SHAPE_POINTS, h->deviation, IMPACT_SHAPE_POINTS);
    if (!a->source.has_force) return;
    if (h->fitted == 0) {
        line(r, "shape");
        report_text(r, "no impact of %d to %d samples stands alone, to be fitted\n", IMPACT_SHAPE_LEAST,
                    IMPACT_SHAPE_LONGEST);
        return;
    }
    line(r, "raised cosine");
    report_text(r,
                "median R2 %.4f (of %ld impact%s; 5 %%: below %.4f, 95 %%: below %.4f), %.4g times the contact time\n",
                h->r2[0][1], h->fitted, plural(h->fitted), h->r2[0][0], h->r2[0][2], h->stretch);
    line(r, "Meixner window");
    report_text(r, "median R2 %.4f (5 %%: below %.4f, 95 %%: below %.4f), ", h->r2[1][1], h->r2[1][0], h->r2[1][2]);
    report_text(r, h->b < 1e4 ? "b %.4g, xi %.4g\n" : "at its limit of large b (xi -> 0)\n", h->b, h->xi);
}

/* ------------------------------------------------------------------ JSON alone: SI units, null for what is not there
 */

static void set_estimate(struct report *r, const char *key, const struct estimate *x)
{
    report_set(r, "$:{ value:n error:n low:n high:n }", key, x->value, x->error, x->low, x->high);
}

static void set_distribution(struct report *r, const char *key, const struct distribution_fits *d)
{
    report_set(r,
               "$:{ gaussian_r2:n gaussian_distance:n exponential_mean:n exponential_distance:n gamma_shape:n "
               "gamma_scale:n gamma_distance:n skewness:n kurtosis:n }",
               key, d->gaussian_r2, d->gaussian_distance, d->exponential_mean, d->exponential_distance, d->gamma_shape,
               d->gamma_scale, d->gamma_distance, d->skewness, d->kurtosis);
}

static void set_series(struct report *r, const char *key, const struct analysis *a, int k)
{
    const struct series_statistics *s = &a->statistics.series[k];
    report_set(r, "$:{", key);
    set_estimate(r, "mean", &s->mean);
    set_estimate(r, "a1", &s->a1);
    set_estimate(r, "b1", &s->b1);
    set_estimate(r, "white_deviation", &s->deviation);
    report_set(r, "variance:n whiteness_q:n whiteness_p:n flat:b ridge:b white_distribution:s", s->variance,
               s->whiteness, s->whiteness_p, s->flat, s->ridge, analyse_tabled(a, k) ? "table" : "gaussian");
    set_distribution(r, "white", &s->white);
    set_distribution(r, "series", &s->itself);
    report_set(r, "correlation:a white_correlation:a }", s->correlation, STATISTICS_LAGS, s->white_correlation,
               STATISTICS_LAGS);
}

static void set_statistics(struct report *r, const struct analysis *a)
{
    const struct impact_statistics *t = &a->statistics;
    const struct impact_modulation *m = &t->modulation;
    report_set(r, "statistics:{");
    set_series(r, "amplitude_n", a, STATISTICS_AMPLITUDE);
    set_series(r, "interval_s", a, STATISTICS_INTERVAL);
    report_set(r, "one_process:n one_process_taken:b modulation:0", t->one_process, analyse_one_process(a));
    if (m->looked)
        report_set(r, "modulation:{ depth:n rate_hz:n probability:n found:b }", m->depth, m->rate, m->probability,
                   m->found);
    report_set(r, "cross_correlation:a white_cross_correlation:a }", t->cross, 2 * STATISTICS_LAGS - 1, t->white_cross,
               2 * STATISTICS_LAGS - 1);
}

static void set_source(struct report *r, const char *key, const struct analyse_source *s)
{
    const struct impact_found *f = &s->found;
    report_set(r, "$:{ file:s kind:s force:b impacts:i run_into_neighbour:l", key, s->file, s->kind, s->has_force,
               f->events.n, f->touching);
    if (s->has_force)
        report_set(r,
                   "rate_hz:n duration_s:n greatest_n:n least_n:n alone:l with_shoulder:l left_out_below_threshold:l "
                   "left_out_not_prominent:l both_ends_found:l duration_unknown:l contact_time_over_width:n",
                   s->signal.rate, (double)s->signal.n / s->signal.rate, f->greatest, f->least, f->alone, f->merged,
                   f->low, f->ripples, f->feet, f->unknown, f->stretch);
    report_set(r, "}");
}

bool analyse_report(const struct analysis *a, bool json, struct err *e)
{
    struct report r = report_open(stdout, json);
    report_set(&r, "source:0 single:0 statistics:0 duration:0 shape:0 notes:t written:t", a->notes, a->n_notes,
               a->written, a->n_written);
    set_source(&r, "source", &a->source);
    print_source(&r, &a->source, a->given.channel);
    if (a->single.file) {
        set_source(&r, "single", &a->single);
        print_source(&r, &a->single, a->given.channel);
    }
    if (a->counted) {
        set_statistics(&r, a);
        print_statistics(&r, a);
    }
    if (a->lasts) {
        static const char *const theta_from[] = {"given", "single", "alone", "none"};
        static const char *const from[] = {[ANALYSE_THETA_GIVEN] = "",
                                           [ANALYSE_THETA_FILE] = "single impacts",
                                           [ANALYSE_THETA_ALONE] = "those that stand alone",
                                           [ANALYSE_THETA_NONE] = ""};
        const struct impact_duration *d = &a->duration;
        report_set(&r,
                   "duration:{ theta:n theta_error:n theta_from:s constant:b singles:l theta_single:n zeta_single_s:n "
                   "r2_single:n r2_single_log:n zeta_s:n impacts:l r2:n r2_log:n }",
                   d->theta, d->theta_error, theta_from[a->theta], a->constant, d->singles, d->theta_single,
                   d->zeta_single, d->r2_single, d->r2_single_log, d->zeta, d->n, d->r2, d->r2_log);
        const char *whose = a->theta == ANALYSE_THETA_ALONE && !a->source.has_force ? "all" : from[a->theta];
        report_text(&r, "\n");
        line(&r, "duration, step 1");
        if (d->singles && a->theta != ANALYSE_THETA_NONE) {
            report_text(&r, "%.4g ms", 1e3 * d->zeta_single);
            if (isnan(d->r2_single))
                report_text(&r, ", all alike");
            else
                report_text(&r, " A^%.4f (+- %.4f), R2 %.4f, of its logarithm %.4f", -d->theta_single, d->theta_error,
                            d->r2_single, d->r2_single_log);
            report_text(&r, ", over %ld impact%s: %s\n", d->singles, plural(d->singles), whose);
        } else
            report_text(&r, "theta %.4g, %s\n", d->theta,
                        a->theta == ANALYSE_THETA_GIVEN ? "given" : "since it cannot be told");
        line(&r, "duration, step 2");
        report_text(&r, "%.4g ms", 1e3 * d->zeta);
        if (d->theta > 0)
            report_text(&r, " A^-%.4f, A in N, R2 %.4f, of its logarithm %.4f", d->theta, d->r2, d->r2_log);
        report_text(&r, a->constant ? ", the median of %ld impact%s\n" : ", over %ld impact%s\n", d->n, plural(d->n));
    }
    report_shape(&r, a);
    for (int i = 0; i < a->n_notes; i++) {
        report_text(&r, "%s", i ? "" : "\n");
        report_note(&r, "  note: ", a->notes[i]);
    }
    for (int i = 0; i < a->n_written; i++)
        report_text(&r, "%s%s\n", i ? "" : "\nwritten:\n", a->written[i]);
    return report_close(&r, 12, e);
}

/* The parameter file of `rasp analyse`: a scene part that a scene includes, and tables of density beside it. */

/* ------------------------------------------------------------------ values */

struct part {
    struct analysis *a;
    const char *table[STATISTICS_SERIES];   /* file; NULL: none */
    double least_amplitude, least_interval; /* NAN: not given */
};

/* No value that the keys refuse: said here, with what to do. */
static bool value_fits(const char *what, double x, double low, double high, struct err *e)
{
    return (x >= low && x <= high) || err_set(e, ERR_SCENE,
                                              "%s is %.6g, and a scene takes %.6g to %.6g: no file is written. Is the "
                                              "unit right, and the series steady? A part of it may be",
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
        return err_set(e, ERR_SCENE,
                       "the rate of the modulation is %.6g Hz, and a scene takes 0 to 1000: no file is written. If it "
                       "is a beat of the series with its own grid, --keep-modulation leaves it in the amplitudes; of a "
                       "force of either sign, --signed may find none",
                       m->rate);
    if (!a->lasts)
        return err_set(e, ERR_SCENE, "%s: no duration is known, and a scene needs one: %s", a->source.file,
                       analyse_notes_unknown(a));
    return value_fits("theta", a->duration.theta, 0, 2, e) && value_fits("zeta in s", a->duration.zeta, 1e-7, 10, e);
}

/* ------------------------------------------------------------------ text */

static void put_comment(FILE *f, const char *text)
{
    fputs("# ", f);
    text_wrap(f, text, 2, "#   ");
}

/* A file's name as it may stand in a comment. */
static const char *source_name(const struct analysis *a)
{
    char *name = arena_text(a->arena, a->source.file);
    for (char *p = name; *p; p++)
        *p = (unsigned char)*p < ' ' ? '?' : *p;
    return name;
}

static void put_value(FILE *f, const char *key, const struct estimate *x, const char *unit)
{
    fprintf(f, "      %s: %.9g%s%s  # %.4g to %.4g\n", key, x->value, *unit ? " " : "", unit, x->low, x->high);
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
            fputs("      distribution: table\n      table: '", f);
            for (const char *c = p->table[k]; *c; c++) /* as YAML reads it, whatever characters it has */
                fprintf(f, *c == '\'' ? "''" : "%c", *c);
            fputc('\'', f);
            fprintf(f, "  # standard deviation %.6g%s%s\n", s->deviation.value, *unit ? " " : "", unit);
        } else
            put_value(f, "deviation", &s->deviation, unit);
        put_value(f, "a1", &s->a1, "");
        put_value(f, "b1", &s->b1, "");
    }

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

/* ------------------------------------------------------------------ files */

/* What was read is never replaced, whatever its name. */
static FILE *files_open(const struct analysis *a, struct analyse_files *all, const char *file, struct err *e)
{
    const char *const read[2] = {a->source.file, a->single.file};
    if (!mark_absent(file, a->force, e)) return NULL;
    for (int i = 0; i < 2; i++)
        if (cmd_same_file(file, read[i]))
            return err_set(e, ERR_CREATE, "%s is what was analysed; give --output another name", file), NULL;
    if (!outfile_open(&all->o[all->n], file, e)) return NULL;
    all->name[all->n] = file;
    return all->o[all->n++].stream;
}

bool analyse_report_part(struct analysis *a, const char *file, struct analyse_files *all, struct err *e)
{
    struct part p = {.a = a};
    FILE *f;
    if (!values_fit(a, e)) return false;
    /* Floors: the least that was seen, of amplitudes if they have one sign, and no more than the mean, which may lie
   below it: it is estimated with the filter. As both are written with the same digits, the floor is not above the mean
   there either. */
    const struct impact_events *v = &a->source.found.events;
    const double *amplitude = a->statistics.demodulated;
    double least = HUGE_VAL, interval = a->statistics.series[STATISTICS_INTERVAL].mean.value,
           mean = a->statistics.series[STATISTICS_AMPLITUDE].mean.value;
    for (int i = 0; i < v->n; i++)
        least = fmin(least, amplitude[i]);
    for (int i = 0; i + 1 < v->n; i++)
        interval = fmin(interval, v->time[i + 1] - v->time[i]);
    p.least_amplitude = least > 0 && mean > 0 ? fmin(least / mean, 1) : NAN;
    p.least_interval = fmin(fmax(interval, 1e-6), 1);
    /* Seconds that the longest impact would last, at the least |A| that a scene takes (force/impact_law.h), which may
       be far below what was seen: 10 is the most. */
    const struct series_statistics *s = &a->statistics.series[STATISTICS_AMPLITUDE];
    double a1 = s->a1.value, b1 = s->b1.value, theta = a->duration.theta,
           depth = a->statistics.modulation.found ? fmin(a->statistics.modulation.depth, 1) : 0;
    double rms =
        sqrt(mean * mean + s->deviation.value * s->deviation.value * (1 + b1 * b1 - 2 * a1 * b1) / (1 - a1 * a1));
    double weakest = isnan(p.least_amplitude) ? HUGE_VAL : p.least_amplitude * mean * (1 - depth);
    double lasts = a->duration.zeta * real_pow(fmax(fmin(weakest, 0.01 * rms), 0.001 * rms), -theta);
    if (theta != 0 && !(lasts <= 10))
        return err_set(e, ERR_SCENE,
                       "with theta %.4g an impact of the least amplitude that a scene takes would last %.4g s, and at "
                       "most 10 s make sense: no file is written. Give a lower --theta",
                       theta, lasts);
    for (int k = 0; k < STATISTICS_SERIES && e->kind == ERR_NONE; k++) {
        if (!analyse_tabled(a, k)) continue;
        const char *table = arena_format(a->arena, "%.*s.%s.csv", (int)strlen(file) - 5, file, analyse_series_names[k]);
        p.table[k] = basename(table);
        if (!(f = files_open(a, all, table, e))) break;
        struct frequency_polygon t;
        distribution_fit_polygon(a->statistics.white[k], a->statistics.n - 1, a->statistics.series[k].deviation.value,
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

static void head(const struct picture *p, int width, int height, struct gnuplot *g)
{
    gnuplot_page(g, p->svg, width, height);
    fputs("set style fill solid 1.0 noborder\nset key noenhanced top right samplen 2 spacing 1.1\n", g->in);
}

static void title(const struct picture *p, const char *setting, const char *what, struct gnuplot *g)
{
    gnuplot_put_setting(g, setting, arena_format(p->a->arena, "%s: %s", p->a->source.file, what));
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
    head(p, 1000, 900, g);
    title(p, "multiplot layout 3,2 title", "correlations over lags", g);
    fputs("set yrange [-1:1.05]\nset xzeroaxis linetype 1 linewidth 0.5 linecolor rgb '#888888'\n", g->in);
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

static void draw_distributions(void *self, struct gnuplot *g)
{
    const struct picture *p = self;
    const struct impact_statistics *t = &p->a->statistics;
    const struct impact_events *events = &p->a->source.found.events;
    double *interval = ARENA_TAKE(p->a->arena, double, events->n);
    for (int i = 0; i + 1 < events->n; i++)
        interval[i] = events->time[i + 1] - events->time[i];
    const double *itself[STATISTICS_SERIES] = {t->demodulated, interval};
    head(p, 1000, 840, g);
    title(p, "multiplot layout 2,2 title", "distributions", g);
    for (int panel = 0; panel < 2 * STATISTICS_SERIES; panel++) {
        int k = panel % STATISTICS_SERIES;
        bool white = panel < STATISTICS_SERIES;
        const struct series_statistics *s = &t->series[k];
        double deviation = white ? s->deviation.value : sqrt(s->variance);
        struct values v = {white ? t->white[k] : itself[k],
                           white || k ? t->n - 1 : t->n,
                           white ? 0 : s->mean.value,
                           deviation > 0 ? deviation : 1,
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
    head(p, 760, 560, g);
    title(p, "title", "durations", g);
    points("series", &a->source.found.events, g);
    if (a->single.file) points("single", &a->single.found.events, g);
    fprintf(g->in, "set logscale xy\nset xlabel 'amplitude A / N'\nset ylabel 'duration / ms'\nset samples 500\n"
                   "plot $series with points pointtype 7 pointsize 0.35 linecolor rgb '" BLUE "' title 'impacts'");
    if (a->single.file)
        fprintf(g->in,
                ", $single with points pointtype 6 pointsize 0.7 linecolor rgb '" GREEN
                "' title 'single impacts', %.9g*x**(-(%.9g)) with lines linewidth 1 dashtype 2 linecolor rgb '" GREEN
                "' title 'step 1'",
                1e3 * d->zeta_single, d->theta_single);
    fprintf(g->in, ", %.9g*x**(-%.9g) with lines linewidth 2 linecolor rgb '" RED "' title '%.4g ms A^-%.3f'\n",
            1e3 * d->zeta, d->theta, 1e3 * d->zeta, d->theta);
}

/* ------------------------------------------------------------------ shape */

static void draw_shape(void *self, struct gnuplot *g)
{
    const struct picture *p = self;
    const struct impact_shape *h = &p->a->shape;
    head(p, 760, 560, g);
    title(p, "title", arena_format(p->a->arena, "mean of %ld impacts", h->fitted), g);
    fputs("$x << END\n", g->in);
    for (int j = 0; j < IMPACT_SHAPE_POINTS; j++)
        fprintf(g->in, "%.9g %.9g %.9g %.9g %.9g %.9g\n", h->q[j], h->mean[j], h->mean[j] - h->deviation[j],
                h->mean[j] + h->deviation[j], h->model[0][j], h->model[1][j]);
    fprintf(g->in,
            "END\nset xlabel 'time from the maximum / duration'\nset ylabel 'force / amplitude'\nset xrange "
            "[-0.75:0.75]\nset yrange [-0.1:1.15]\n"
            "plot $x using 1:3:4 with filledcurves fillcolor rgb '#cfe3f1' title '± 1 standard deviation', '' using "
            "1:2 with lines linewidth 2.5 linecolor rgb '" BLUE
            "' title 'mean', '' using 1:5 with lines linewidth 2 dashtype 2 linecolor rgb '" RED
            "' title 'raised cosine, R² of the mean %.4f', '' using 1:6 with lines linewidth 2 dashtype 4 linecolor "
            "rgb '" GREEN "' title 'Meixner window, R² of the mean %.4f'\n",
            h->of_mean[0].r2, h->of_mean[1].r2);
}

/* ------------------------------------------------------------------ files */

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
    struct stat s;
    size_t n = strlen(prefix);
    bool slash = n > 0 && prefix[n - 1] == '/';
    if (slash || (stat(prefix, &s) == 0 && S_ISDIR(s.st_mode)))
        prefix = arena_format(a->arena, "%s%s%s", prefix, slash ? "" : "/", relpath_stem(a->source.file, a->arena));
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        const char *file = arena_format(a->arena, "%s.%s.%s", prefix, all[i].name, svg ? "svg" : "png");
        if (!all[i].there) continue;
        if (!mark_permits(file, NULL, a->force, e) || !gnuplot_draw(&to->o[to->n], file, svg, all[i].draw, &p, e))
            return false;
        to->name[to->n++] = file;
    }
    return true;
}
