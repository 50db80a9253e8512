/* The parameter file of `rasp analyse`: a scene part that a scene includes, and tables of density beside it. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "analysis/frequency_polygon.h"
#include "base/outfile.h"
#include "base/wrap.h"
#include "cmd/analyse.h"
#include "file/csv.h"
#include "num/real.h"
#include "output/mark.h"

static bool name_free(const struct analysis *a, const char *file, struct err *e)
{
    return mark_absent(file, a->force, e);
}

bool analyse_part_free(const struct analysis *a, const char *file, struct err *e)
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
        if (read[i] && stat(file, &there) == 0 && stat(read[i], &was) == 0 && there.st_dev == was.st_dev && there.st_ino == was.st_ino)
            return err_set(e, ERR_CREATE, "%s is what was analysed; give --output another name", file);
    return true;
}

/* ------------------------------------------------------------------ values */

struct part {
    struct analysis *a;
    const char *table[STATISTICS_SERIES]; /* file; NULL: none */
    double least_amplitude, least_interval; /* NAN: not given */
};

/* No value that the keys refuse (scene/keys.def): said here, with what to do. */
static bool value_fits(const char *what, double x, double low, double high, struct err *e)
{
    return (x >= low && x <= high) || err_set(e, ERR_SCENE, "%s is %.6g, and a scene takes %.6g to %.6g: no file is written. Is the unit right, and the series "
                                                              "steady? A part of it may be", what, x, low, high);
}

static bool values_fit(const struct analysis *a, struct err *e)
{
    for (int k = 0; k < STATISTICS_SERIES; k++) {
        const struct series_statistics *s = &a->statistics.series[k];
        if (!value_fits(k ? "a1 of the intervals" : "a1 of the amplitudes", s->a1.value, -0.9999, 0.9999, e) ||
            !value_fits(k ? "b1 of the intervals" : "b1 of the amplitudes", s->b1.value, -10, 10, e) ||
            !value_fits(k ? "mean interval in s" : "mean amplitude in N", s->mean.value, k ? 1e-6 : -1e6, 1e6, e) ||
            !value_fits(k ? "deviation of the intervals in s" : "deviation of the amplitudes in N", s->deviation.value, 0, 1e6, e))
            return false;
    }
    const struct impact_modulation *m = &a->statistics.modulation;
    if (m->found && m->rate > 1000)
        return err_set(e, ERR_SCENE, "the rate of the modulation is %.6g Hz, and a scene takes 0 to 1000: no file is written. If it is a beat of the series with its own grid, "
                                     "--keep-modulation leaves it in the amplitudes; of a force of either sign, --signed may find none", m->rate);
    if (!a->lasts)
        return err_set(e, ERR_SCENE, "%s: no duration is known, and a scene needs one: %s", a->source.file, analyse_notes_unknown(a));
    return value_fits("theta", a->duration.theta, 0, 2, e) && value_fits("zeta in s", a->duration.zeta, 1e-7, 10, e);
}

/* Floors: the least that was seen, of amplitudes if they have one sign, and no more than the mean, which may lie below it: it is estimated with the filter. As both
   are written with the same digits, the floor is not above the mean there either. */
static void floors_find(struct part *p)
{
    const struct impact_events *v = &p->a->source.found.events;
    const double *amplitude = p->a->statistics.demodulated;
    double least = HUGE_VAL, interval = p->a->statistics.series[STATISTICS_INTERVAL].mean.value, mean = p->a->statistics.series[STATISTICS_AMPLITUDE].mean.value;
    for (int i = 0; i < v->n; i++)
        least = fmin(least, amplitude[i]);
    for (int i = 0; i + 1 < v->n; i++)
        interval = fmin(interval, v->time[i + 1] - v->time[i]);
    p->least_amplitude = least > 0 && mean > 0 ? fmin(least / mean, 1) : NAN;
    p->least_interval = fmin(fmax(interval, 1e-6), 1);
}

/* Seconds that the longest impact would last, at the least |A| that a scene takes (force/impact_law.h), which may be far below what was seen: 10 is the most. */
static bool longest_fits(const struct part *p, struct err *e)
{
    const struct analysis *a = p->a;
    const struct series_statistics *s = &a->statistics.series[STATISTICS_AMPLITUDE];
    double a1 = s->a1.value, b1 = s->b1.value, mean = s->mean.value, depth = a->statistics.modulation.found ? fmin(a->statistics.modulation.depth, 1) : 0;
    double rms = sqrt(mean * mean + s->deviation.value * s->deviation.value * (1 + b1 * b1 - 2 * a1 * b1) / (1 - a1 * a1));
    double least = isnan(p->least_amplitude) ? HUGE_VAL : p->least_amplitude * mean * (1 - depth);
    double lasts = a->duration.zeta * real_pow(fmax(fmin(least, 0.01 * rms), 0.001 * rms), -a->duration.theta);
    return a->duration.theta == 0 || lasts <= 10 || err_set(e, ERR_SCENE, "with theta %.4g an impact of the least amplitude that a scene takes would last %.4g s, and at most 10 s make sense: no file is "
                                                                          "written. Give a lower --theta", a->duration.theta, lasts);
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
        if (*p == '\'')
            fputc('\'', f);
        fputc(*p, f);
    }
    fputc('\'', f);
}

static void put_head(const struct part *p, FILE *f)
{
    const struct analysis *a = p->a;
    const struct impact_found *found = &a->source.found;
    put_comment(f, arena_format(a->arena, "Impacts as those in %s, found by rasp analyse. A scene takes this part by `include:`.", source_name(a)));
    if (a->source.has_force)
        put_comment(f, arena_format(a->arena, "%d impacts in %.6g s of force at %.6g Hz; %ld maxima left out; %ld alone, %ld with a shoulder.",
                                    found->events.n, (double)a->source.signal.n / a->source.signal.rate, a->source.signal.rate, found->events.fewer,
                                    found->alone, found->merged));
    else
        put_comment(f, arena_format(a->arena, "%d impacts.", found->events.n));
    put_comment(f, "After each value its 95 % interval. Deviations are those of the whitened series.");
    for (int i = 0; i < a->n_notes; i++)
        put_comment(f, arena_format(a->arena, "Note: %s", a->notes[i]));
}

static void put_value(FILE *f, const char *key, const struct estimate *x, const char *unit)
{
    fprintf(f, "      %s: %.9g%s%s  # %.4g to %.4g\n", key, x->value, *unit ? " " : "", unit, x->low, x->high);
}

static void put_series(const struct part *p, int k, FILE *f)
{
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
    if (!isnan(p->least_amplitude))
        fprintf(f, "amplitude: %.9g, ", p->least_amplitude);
    fprintf(f, "interval: %.9g s}  # the least that was seen%s\n", p->least_interval, isnan(p->least_amplitude) ? "; amplitudes keep their sign" : "");
    fprintf(f, "    processes: %s  # ", analyse_one_process(a) ? "one" : "two");
    if (isnan(a->statistics.one_process))
        fputs("a series is constant\n", f);
    else
        fprintf(f, "the whitened series' correlation by ranks is %.3f\n", a->statistics.one_process);
}

static void put_part(const struct part *p, FILE *f)
{
    put_head(p, f);
    fputs("contact:\n  model: impacts\n  impacts:\n    prototype: custom\n    unit_force: 1 N\n", f);
    for (int k = 0; k < STATISTICS_SERIES; k++)
        put_series(p, k, f);
    put_rest(p, f);
}

static void put_table(const struct part *p, int k, FILE *f)
{
    const struct analysis *a = p->a;
    struct frequency_polygon t;
    frequency_polygon_make(a->statistics.white[k], a->statistics.n - 1, a->statistics.series[k].deviation.value, a->arena, &t);
    fprintf(f, "# density of the whitened %ss of %s, value in %s\nvalue,density\n", analyse_series_names[k], source_name(a), k ? "s" : "N");
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
    if (!name_free(a, file, e) || !name_other(a, file, e) || !outfile_open(&all->o[all->n], file, e))
        return NULL;
    all->name[all->n] = file;
    return all->o[all->n++].stream;
}

bool analyse_part(struct analysis *a, const char *file, struct analyse_files *all, struct err *e)
{
    struct part p = {.a = a};
    FILE *f;
    const char *slash = strrchr(file, '/');
    long folder = slash ? slash - file + 1 : 0;
    if (!values_fit(a, e))
        return false;
    floors_find(&p);
    if (!longest_fits(&p, e))
        return false;
    for (int k = 0; k < STATISTICS_SERIES && e->kind == ERR_NONE; k++) {
        if (!analyse_tabled(a, k))
            continue;
        const char *table = arena_format(a->arena, "%.*s.%s.csv", (int)strlen(file) - 5, file, analyse_series_names[k]);
        p.table[k] = table + folder;
        if ((f = files_open(a, all, table, e)))
            put_table(&p, k, f);
    }
    if (e->kind == ERR_NONE && (f = files_open(a, all, file, e))) /* the file that names the tables comes last */
        put_part(&p, f);
    return e->kind == ERR_NONE;
}
