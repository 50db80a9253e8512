/* rasp compare: two sounds or two tables, the first being the reference, or one of them and a hash.

   Of sounds figures come first, then every criterion with its verdict.

   Rates, channels and numbers of frames must agree under every criterion, with one exception: when third-octave bands
   are all that is asked about, rates may differ, and lengths by one frame period of the lower rate. Sounds of different
   rates are not compared sample by sample: equal frame numbers are not equal times. */
#include "cmd/compare.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "analysis/distance.h"
#include "base/hash.h"
#include "base/memory.h"
#include "base/text.h"
#include "cmd/cmd.h"
#include "cmd/report.h"
#include "file/csv.h"
#include "num/real.h"

enum { COMPARE_SOUND_CRITERIA = 5 };

struct criterion {
    const char *name;
    double limit, measured; /* NAN: has none */
    bool met;
    const char *says;
};

struct verdict {
    const struct compare_ask *ask;
    struct wav sound[2];
    char hash[2][HASH_TEXT];
    bool alike, shape;         /* same number of channels; same rate and frames as well */
    bool paired;               /* same channels and rate: sample n of A belongs to sample n of B */
    struct distance_samples d; /* of paired sounds */
    struct distance_bands bands;
    struct criterion criteria[COMPARE_SOUND_CRITERIA];
    int n_criteria;
    bool met, equal;
};

/* "frame 2 (0.000250 s), channel 1: A ..., B ...", "4000 Hz, channel 2: A ... dB, B ... dB". */
static const char *compare_sound_place(const struct verdict *v, const struct distance_place *p)
{
    return arena_format(v->ask->arena, "frame %zu (%.6f s), channel %d: A %.9g, B %.9g", p->frame,
                        (double)p->frame / v->sound[0].rate, p->channel + 1, p->a, p->b);
}

static const char *compare_sound_band(const struct verdict *v)
{
    return arena_format(v->ask->arena, "%g Hz, channel %d: A %.2f dB, B %.2f dB", distance_band_nominal(v->bands.band),
                        v->bands.channel + 1, v->bands.a_db, v->bands.b_db);
}

static void judge(struct verdict *v, struct criterion c)
{
    v->criteria[v->n_criteria++] = c;
    v->met = v->met && c.met;
}

/* Why no sample of A has a partner in B. */
static const char *unpaired(const struct verdict *v)
{
    return v->alike ? "not measured: the sample rates differ" : "not measured: the numbers of channels differ";
}

/* A figure against a limit that it must not pass; sign +1: at most, -1: at least. */
static void judge_limit(struct verdict *v, struct criterion c, double sign, const char *unit_and_where[2])
{
    const char *unit = unit_and_where[0];
    struct arena *a = v->ask->arena;
    c.met = sign * c.measured <= sign * c.limit; /* not when it is NAN: not measured */
    if (isnan(c.measured) && !v->paired)
        c.says = unpaired(v);
    else if (c.met)
        c.says = arena_format(a, "%.6g %s; %s %g %s is asked for", c.measured, unit, sign > 0 ? "at most" : "at least",
                              c.limit, unit);
    else
        c.says = arena_format(a, "%.6g %s is %.6g %s %s the limit of %g %s; the worst at %s", c.measured, unit,
                              fabs(c.measured - c.limit), unit, sign > 0 ? "above" : "below", c.limit, unit,
                              unit_and_where[1]);
    judge(v, c);
}

/* The largest difference in steps of the coarser integer encoding; NAN: there is none. */
static double compare_sound_steps(const struct verdict *v)
{
    double step = distance_step(&v->sound[0], &v->sound[1]);
    return v->paired && step > 0 ? v->d.largest / step : NAN;
}

static void judge_all(struct verdict *v)
{
    const struct compare_ask *ask = v->ask;
    const char *worst = compare_sound_place(v, &v->d.worst);
    v->met = true;
    const struct wav *a = &v->sound[0], *b = &v->sound[1];

    bool bands_alone = !ask->exact && isnan(ask->snr) && isnan(ask->lsb);
    double off = fabs((double)a->frames / a->rate - (double)b->frames / b->rate);
    bool near = bands_alone && off <= 1.000001 / fmin(a->rate, b->rate);
    bool met = v->alike && (v->shape || near);
    const char *says = arena_format(ask->arena, "the sounds differ in%s%s%s", v->alike ? "" : " channels,",
                                    a->rate == b->rate ? "" : " rate,", off > 0 ? " length," : "");
    says = arena_format(ask->arena, "%.*s", (int)strlen(says) - 1, says); /* without the last comma */
    if (met)
        says = a->rate == b->rate ? "channels, rate and length are as they should be"
                                  : "channels and length are as they should be; rates may differ";
    judge(v, (struct criterion){"form", NAN, NAN, met, says});
    if (ask->exact) {
        met = v->paired && v->d.differing == 0;
        says = !v->paired ? unpaired(v)
               : met      ? "all samples compared are the same"
                          : arena_format(ask->arena, "%zu of %zu samples differ, the first at %s", v->d.differing,
                                         v->d.frames * (size_t)a->channels, compare_sound_place(v, &v->d.first));
        judge(v, (struct criterion){"exact", NAN, v->paired ? (double)v->d.differing : NAN, met, says});
    }
    if (!isnan(ask->snr))
        judge_limit(v, (struct criterion){"snr", ask->snr, v->d.snr_db, false, NULL}, -1,
                    (const char *[]){"dB", worst});
    if (!isnan(ask->lsb))
        judge_limit(v, (struct criterion){"lsb", ask->lsb, compare_sound_steps(v), false, NULL}, 1,
                    (const char *[]){"LSB", worst});
    if (!isnan(ask->third_octave))
        judge_limit(v, (struct criterion){"third_octave", ask->third_octave, v->bands.worst_db, false, NULL}, 1,
                    (const char *[]){"dB", compare_sound_band(v)});
}

/* ------------------------------------------------------------------ the report on two sounds */

static double decibels(double x) { return x > 0 ? 20 * real_log10(x) : -INFINITY; }

/* Of frames or samples that have a partner. */
static long count(const struct verdict *v, size_t n) { return v->paired ? (long)n : -1; }

static void report_place(struct report *r, const char *key, const struct verdict *v, const struct distance_place *p)
{
    if (!v->d.differing)
        report_set(r, "$:0", key);
    else
        report_set(r, "$:{ frame:z time_s:n channel:i a:n b:n }", key, p->frame, (double)p->frame / v->sound[0].rate,
                   p->channel + 1, p->a, p->b);
}

static void report_samples(struct report *r, const struct verdict *v)
{
    const struct distance_samples *d = &v->d;
    double step = distance_step(&v->sound[0], &v->sound[1]), n = (double)d->frames * v->sound[0].channels;
    report_set(r, "frames_compared:c differing_samples:c", count(v, d->frames), count(v, d->differing));
    report_place(r, "first_difference", v, &d->first);
    report_set(r, "largest_difference:n largest_difference_lsb:n largest_difference_dbfs:n",
               v->paired ? d->largest : NAN, compare_sound_steps(v), v->paired ? decibels(d->largest) : NAN);
    report_place(r, "largest_difference_at", v, &d->worst);
    report_set(r, "snr_db:n", d->snr_db);
    if (v->equal || !v->alike) return;
    if (!v->paired) {
        report_text(r, "samples             difference, LSB and SNR are left out, because the sample rates differ\n");
        return;
    }
    report_text(r, "differing samples   %zu of %.0f (%.3g %%)\n", d->differing, n, 100 * (double)d->differing / n);
    if (d->differing) {
        report_text(r, "first difference    %s\n", compare_sound_place(v, &d->first));
        const char *steps =
            step > 0 ? arena_format(v->ask->arena, "%.6g LSB of %d bits, ", d->largest / step, 1 - ilogb(step)) : "";
        report_text(r, "largest difference  %s%.2f dBFS, at %s\n", steps, decibels(d->largest),
                    compare_sound_place(v, &d->worst));
    }
    report_text(r, "SNR                 %.2f dB\n", d->snr_db);
}

static bool report_sounds(const struct verdict *v, struct err *e)
{
    const struct wav *a = &v->sound[0], *b = &v->sound[1];
    const struct distance_bands *d = &v->bands;
    bool any = d->compared > 0;
    struct report r = report_open(v->ask->out, v->ask->json);
    report_set(&r, "equal:b held:b audio_sha256:t", v->equal, v->met, (const char *const[]){v->hash[0], v->hash[1]}, 2);
    report_text(&r, "A %s\nB %s\nsha256  A %s B %s\n", v->ask->files[0], v->ask->files[1], v->hash[0], v->hash[1]);
    double short_by = (double)a->frames - (double)b->frames, seconds[2];
    const char *encoding[2];
    for (int i = 0; i < 2; i++) {
        const struct wav *w = &v->sound[i];
        seconds[i] = (double)w->frames / w->rate;
        encoding[i] = w->bits ? arena_format(v->ask->arena, "%d-bit integers", w->bits) : "not integers";
        report_set(&r, "$:{ file:s rate_hz:n channels:i frames:z duration_s:n bits:w }", i ? "b" : "a",
                   v->ask->files[i], w->rate, w->channels, w->frames, seconds[i], w->bits);
    }
    if (a->rate != b->rate) report_text(&r, "rate                A %.9g Hz, B %.9g Hz\n", a->rate, b->rate);
    if (a->channels != b->channels) report_text(&r, "channels            A %d, B %d\n", a->channels, b->channels);
    if (a->rate != b->rate)
        report_text(&r, "length              A %.6f s, B %.6f s\n", seconds[0], seconds[1]);
    else if (a->frames != b->frames)
        report_text(&r, "frames              A %zu, B %zu: B is %.0f (%.6f s) %s%s\n", a->frames, b->frames,
                    fabs(short_by), fabs(seconds[0] - seconds[1]), short_by > 0 ? "shorter" : "longer",
                    v->alike ? "; what both have is compared" : "");
    if (a->bits != b->bits) report_text(&r, "encoding            A %s, B %s\n", encoding[0], encoding[1]);
    if (v->equal)
        report_text(&r, "equal: %zu frames (%.6f s), %d channel%s, %.9g Hz\n", a->frames, (double)a->frames / a->rate,
                    a->channels, a->channels == 1 ? "" : "s", a->rate);
    report_samples(&r, v);
    report_set(&r, "third_octave:{ compared:i worst_db:n band_hz:n channel:w a_db:n b_db:n } criteria:[", d->compared,
               d->worst_db, any ? distance_band_nominal(d->band) : NAN, any ? d->channel + 1 : 0, any ? d->a_db : NAN,
               any ? d->b_db : NAN);
    if (!v->equal && v->alike && any)
        report_text(&r, "third-octave bands  at most %.4g dB apart, at %s\n", d->worst_db, compare_sound_band(v));
    else if (!v->equal && v->alike)
        report_text(&r, "third-octave bands  none to compare\n");
    for (int i = 0; i < v->n_criteria; i++) {
        const struct criterion *c = &v->criteria[i];
        report_set(&r, ":{ name:s held:b limit:n measured:n says:s }", c->name, c->met, c->limit, c->measured, c->says);
        if (!v->equal) report_text(&r, "%s %s: %s\n", c->met ? "ok  " : "FAIL", c->name, c->says);
    }
    return report_close(&r, 12, e);
}

int compare_sound(const struct compare_ask *ask, struct err *e)
{
    struct verdict *v = ARENA_TAKE(ask->arena, struct verdict, 1);
    struct wav *a = &v->sound[0], *b = &v->sound[1];
    v->ask = ask;
    for (int i = 0; i < 2; i++) {
        if (!wav_read(ask->files[i], ask->arena, &v->sound[i], e)) return (int)e->kind;
        distance_hash(&v->sound[i], v->hash[i]);
    }
    if (!isnan(ask->lsb) && distance_step(a, b) == 0) {
        err_set(e, ERR_USAGE,
                "--lsb: neither sound holds integers, so there is no step to count in; --snr is for such sounds");
        return (int)e->kind;
    }
    v->alike = a->channels == b->channels;
    v->paired = v->alike && a->rate == b->rate;
    v->shape = v->paired && a->frames == b->frames;
    v->d.snr_db = v->bands.worst_db = NAN;
    if (v->paired) distance_samples(a, b, &v->d);
    v->equal = v->shape && v->d.differing == 0;
    if (v->equal)
        v->bands.worst_db = 0;
    else if (v->alike)
        distance_bands(a, b, ask->within, ask->arena, &v->bands);
    judge_all(v);
    if (!(ask->quiet && v->met) && !report_sounds(v, e)) return (int)e->kind;
    return v->met ? 0 : ERR_DIFFERS;
}

/* rasp compare for tables, CSV or NPY: columns by name, each with its tolerance. Comments before the header count only
   where everything has to be exact: they say where a table comes from. */

struct tables {
    const struct compare_ask *ask;
    struct csv a, b;
    struct table_distance d;
    char hash[2][HASH_TEXT];
    bool hashed;     /* both are files, not pipes: their bytes can be read again */
    bool equal, met; /* not the least difference; every criterion met */
};

static void report_names(struct report *r, const char *key, const char *what, const char *const *names, size_t n)
{
    report_set(r, key, names, (int)n);
    for (size_t i = 0; i < n; i++)
        report_text(r, "%s %s", i ? "," : what, names[i]);
    if (n) report_text(r, "\n");
}

static void report_column(struct report *r, const struct tables *t, const struct table_distance_column *c)
{
    const struct table_distance_tolerance *to = &c->tolerance;
    size_t row = c->worst_row;
    char room[2][CSV_ROOM];
    const char *a = c->misses ? csv_text(&t->a, row, c->a, room[0]) : NULL,
               *b = c->misses ? csv_text(&t->b, row, c->b, room[1]) : NULL;
    report_set(r, ":{ name:s exact:b abs:n rel:n misses:z largest_difference:n worst:0", c->name, to->exact,
               to->exact ? 0.0 : to->abs, to->exact ? 0.0 : to->rel, c->misses, c->largest);
    if (c->misses)
        report_set(r, "worst:{ row:z line_a:i line_b:i a:s b:s excess:n }", row + 1, t->a.lines[row], t->b.lines[row],
                   a, b, c->excess);
    report_set(r, "}");
    if (c->misses == 0 && c->largest == 0) return;
    if (c->misses)
        report_text(r, "FAIL %s: %zu of %zu rows differ", c->name, c->misses, t->d.rows);
    else
        report_text(r, "ok   %s: differs by at most %.6g", c->name, c->largest);
    if (!to->exact) report_text(r, "%s abs %g, rel %g", c->misses ? " by more than" : ", within", to->abs, to->rel);
    if (c->misses)
        report_text(r, "; worst in row %zu (line %d, line %d): A '%s', B '%s'", row + 1, t->a.lines[row],
                    t->b.lines[row], a, b);
    if (c->misses && isfinite(c->excess) && !to->exact) report_text(r, ", %.6g beyond the tolerance", c->excess);
    report_text(r, "\n");
}

static bool report_tables(const struct tables *t, struct err *e)
{
    const struct table_distance *d = &t->d;
    struct report r = report_open(t->ask->out, t->ask->json);
    report_set(&r, "equal:b held:b file_sha256:0", t->equal, t->met);
    report_text(&r, "A %s\nB %s\n", t->ask->files[0], t->ask->files[1]);
    if (t->hashed) {
        report_set(&r, "file_sha256:t", (const char *const[]){t->hash[0], t->hash[1]}, 2);
        report_text(&r, "sha256  A %s B %s\n", t->hash[0], t->hash[1]);
    }
    report_set(&r, "a:{ file:s rows:z } b:{ file:s rows:z } rows_compared:z", t->ask->files[0], t->a.rows,
               t->ask->files[1], t->b.rows, d->rows);
    report_names(&r, "missing_columns:t", "FAIL columns: missing in B:", d->missing, d->n_missing);
    report_names(&r, "extra_columns:t", "FAIL columns: only in B:", d->extra, d->n_extra);
    report_set(&r, "columns_reordered:b differing_comment:s", d->reordered, d->comment);
    if (d->reordered) report_text(&r, "FAIL columns: they stand in another order in B\n");
    if (t->a.rows != t->b.rows)
        report_text(&r, "FAIL rows: A has %zu, B has %zu; the first %zu are compared\n", t->a.rows, t->b.rows, d->rows);
    if (d->comment)
        report_text(&r, "%s comments: they differ, first in '%s'\n", t->ask->exact ? "FAIL" : "note", d->comment);
    report_set(&r, "columns:[");
    for (size_t i = 0; i < d->n_columns; i++)
        report_column(&r, t, &d->columns[i]);
    if (t->met)
        report_text(&r, "%s: %zu rows, %zu columns\n", t->equal ? "equal" : "within the tolerances", t->a.rows,
                    t->a.columns);
    return report_close(&r, 12, e);
}

int compare_table(const struct compare_ask *ask, struct err *e)
{
    struct tables *t = ARENA_TAKE(ask->arena, struct tables, 1);
    const struct csv *both[2] = {&t->a, &t->b};
    t->ask = ask;
    if (!csv_table_read(ask->files[0], ask->arena, &t->a, e) || !csv_table_read(ask->files[1], ask->arena, &t->b, e))
        return (int)e->kind;
    if (t->a.rows == 0) err_set(e, ERR_SCENE, "%s: has no rows: nothing would be compared", ask->files[0]);
    if (e->kind || !table_distance(both, ask->tolerances, ask->arena, &t->d, e)) return (int)e->kind;
    struct err none = {0};
    t->hashed = hash_file(ask->files[0], t->hash[0], &none) && hash_file(ask->files[1], t->hash[1], &none);
    t->met =
        t->a.rows == t->b.rows && !t->d.n_missing && !t->d.n_extra && !t->d.reordered && !(ask->exact && t->d.comment);
    t->equal = t->met && !t->d.comment;
    for (size_t i = 0; i < t->d.n_columns; i++) {
        t->met = t->met && t->d.columns[i].misses == 0;
        t->equal = t->equal && t->d.columns[i].misses == 0 && t->d.columns[i].largest == 0;
    }
    if (!(ask->quiet && t->met) && !report_tables(t, e)) return (int)e->kind;
    return t->met ? 0 : ERR_DIFFERS;
}

/* rasp compare FILE --hash SHA256: one sound or table against a hash that was kept. */

/* By its first bytes, else by its name; a pipe is a table, for its bytes could not be read twice. ERR_INPUT: not there.
 */
bool compare_is_sound(const char *path, bool *sound, struct err *e)
{
    static const char *const names[] = {".wav", ".w64", ".aif", ".aiff", ".flac", ".caf", ".au", ".mp3", ".ogg", NULL};
    struct stat s;
    char head[4];
    *sound = false;
    if (stat(path, &s) != 0) return err_set(e, ERR_INPUT, "%s: %s", path, strerror(errno));
    FILE *f = S_ISREG(s.st_mode) ? memory_fopen(path, "rb") : NULL;
    if (f) {
        *sound = fread(head, 1, 4, f) == 4 && wav_begins(head);
        fclose(f);
    }
    const char *dot = strrchr(path, '.');
    for (int i = 0; names[i]; i++)
        *sound = *sound || (dot && !strcasecmp(dot, names[i]));
    return true;
}

bool compare_limits(const struct args *g, const char *folder, struct compare_ask *ask, struct err *e)
{
    ask->snr = ask->lsb = ask->third_octave = NAN;
    ask->within = 60;
    if (args_given(g, "within") && !args_given(g, "third-octave"))
        return err_set(e, ERR_USAGE, "--within says which bands --third-octave compares: give both");
    static const double any[2] = {-HUGE_VAL, HUGE_VAL}, positive[2] = {0, HUGE_VAL};
    if (!args_number(g, "snr", any, &ask->snr, e) || !args_number(g, "lsb", positive, &ask->lsb, e) ||
        !args_number(g, "third-octave", positive, &ask->third_octave, e) ||
        !args_number(g, "within", positive, &ask->within, e))
        return false;
    /* Of the tolerances for all others the first counts, of those for one column the last: so the command line
       overrides the file. */
    const struct table_distance_tolerance *file = NULL;
    const char *path = args_value(g, "tolerance");
    int columns, n = 0, rows = 0;
    const char **texts = args_values(g, "column", &columns);
    if (path && folder && *path != '/') path = arena_format(ask->arena, "%s/%s", folder, path);
    if (path && !(file = table_distance_read(path, ask->arena, e))) return false;
    while (file && file[rows].column)
        rows++;
    struct table_distance_tolerance *list = ARENA_TAKE(ask->arena, struct table_distance_tolerance, rows + columns + 2);
    ask->tolerances = list;
    if (args_given(g, "abs") || args_given(g, "rel")) list[n++].column = "*";
    if (!args_number(g, "abs", positive, &list[0].abs, e) || !args_number(g, "rel", positive, &list[0].rel, e))
        return false;
    for (int i = 0; i < rows; i++)
        list[n++] = file[i];
    for (int i = 0; i < columns; i++) { /* NAME=ABS,REL; the name may hold = itself */
        struct table_distance_tolerance *t = &list[n++];
        char *name = arena_text(ask->arena, texts[i]), *equals = strrchr(name, '='),
             *comma = equals ? strchr(equals, ',') : NULL;
        if (comma) *equals = *comma = '\0';
        t->column = name;
        if (!comma || !text_double(equals + 1, &t->abs) || !text_double(comma + 1, &t->rel) || !(t->abs >= 0) ||
            !(t->rel >= 0))
            return err_set(e, ERR_USAGE,
                           "--column: '%s' is not of the form NAME=ABS,REL, as in speed_m_per_s=1e-6,0.001", texts[i]);
    }
    return true;
}

/* The first of those options that was given, or NULL. */
static const char *given_of(const struct args *g, const char *const names[4])
{
    for (int i = 0; i < 4; i++)
        if (args_given(g, names[i])) return names[i];
    return NULL;
}

const char *compare_limit_of_sounds(const struct args *g)
{
    return given_of(g, (const char *const[4]){"snr", "lsb", "third-octave", "within"});
}

const char *compare_limit_of_tables(const struct args *g)
{
    return given_of(g, (const char *const[4]){"tolerance", "column", "abs", "rel"});
}

/* FILE --hash HEX. */
static int compare_run_hash(const struct cmd_call *c, const struct compare_ask *ask, struct err *e)
{
    const char *sounds = compare_limit_of_sounds(&c->args), *tables = compare_limit_of_tables(&c->args);
    const char *other = args_given(&c->args, "exact") ? "exact" : sounds ? sounds : tables;
    char *hex = arena_text(c->arena, args_value(&c->args, "hash")), own[HASH_TEXT];
    bool sound;
    if (c->args.n_operands != 1)
        err_set(e, ERR_USAGE, "--hash takes one file, not two: the hash is the reference");
    else if (other)
        err_set(e, ERR_USAGE, "--hash leaves no room for --%s: a hash is met or it is not", other);
    else if (strlen(hex) != HASH_TEXT - 1 || strspn(hex, "0123456789abcdefABCDEF") != HASH_TEXT - 1)
        err_set(e, ERR_USAGE,
                "--hash: '%s' is not a SHA-256: 64 hexadecimal digits, as `rasp compare FILE FILE` prints them", hex);
    if (e->kind || !compare_is_sound(ask->files[0], &sound, e)) return (int)e->kind;
    for (char *p = hex; *p; p++)
        *p = *p >= 'A' && *p <= 'F' ? (char)(*p + 'a' - 'A') : *p;
    /* What cannot be compared with a file has no hash to compare either: a table without rows, a sound without
       samples. */
    struct wav w;
    struct csv t;
    if (sound && wav_read(ask->files[0], ask->arena, &w, e))
        distance_hash(&w, own);
    else if (!sound && csv_table_read(ask->files[0], ask->arena, &t, e)) {
        if (t.rows == 0) err_set(e, ERR_SCENE, "%s: has no rows: nothing would be compared", ask->files[0]);
        if (e->kind == ERR_NONE) hash_file(ask->files[0], own, e);
    }
    if (e->kind) return (int)e->kind;
    bool met = strcmp(own, hex) == 0;
    if (ask->quiet && met) return 0;
    struct report r = report_open(ask->out, ask->json);
    report_set(&r, sound ? "held:b file:s audio_sha256:s expected:s" : "held:b file:s file_sha256:s expected:s", met,
               ask->files[0], own, hex);
    report_text(&r, "%s\n%s sha256: %s%s%s\n", ask->files[0], met ? "ok  " : "FAIL", own,
                met ? "" : ", where the hash given is ", met ? "" : hex);
    return !report_close(&r, 0, e) ? (int)e->kind : met ? 0 : ERR_DIFFERS;
}

static int compare_run(struct cmd_call *c, struct err *e)
{
    const char **files = c->args.operands, *sounds = compare_limit_of_sounds(&c->args),
               *tables = compare_limit_of_tables(&c->args);
    bool a, b, exact = args_given(&c->args, "exact");
    struct compare_ask ask = {.files = {files[0], files[1]},
                              .json = args_given(&c->args, "json"),
                              .quiet = args_given(&c->args, "quiet"),
                              .exact = exact || (!sounds && !tables),
                              .out = stdout,
                              .arena = c->arena};
    if (args_given(&c->args, "hash")) return compare_run_hash(c, &ask, e);
    if (c->args.n_operands < 2) {
        err_set(e, ERR_USAGE, "operands are missing; usage: rasp compare A B, or rasp compare FILE --hash SHA256");
        return (int)e->kind;
    }
    if (!compare_is_sound(files[0], &a, e) || !compare_is_sound(files[1], &b, e)) return (int)e->kind;
    if (a != b)
        err_set(e, ERR_USAGE, "%s is a %s and %s is a %s: they cannot be compared", files[0], a ? "sound" : "table",
                files[1], b ? "sound" : "table");
    else if (a ? tables != NULL : sounds != NULL)
        err_set(e, ERR_USAGE, "--%s is for %s, and these are %s", a ? tables : sounds, a ? "tables" : "sounds",
                a ? "sounds" : "tables");
    else if (exact && tables)
        err_set(e, ERR_USAGE, "--exact leaves no room for --%s", tables);
    if (e->kind || !compare_limits(&c->args, NULL, &ask, e)) return (int)e->kind;
    return a ? compare_sound(&ask, e) : compare_table(&ask, e);
}

static const struct args_option options[] = {
    {"exact", 'e', NULL, false, "every sample or cell must be the same (the default when no limit is given)"},
    COMPARE_SOUND_LIMITS,
    COMPARE_TABLE_LIMITS,
    {"hash", 0, "SHA256", false,
     "checks one FILE against a stored hash of 64 hexadecimal digits; only --json and --quiet may stand beside it"},
    {"json", 'j', NULL, false,
     "prints the figures as one JSON object; null stands for an infinite figure or one that is not there"},
    {"quiet", 'q', NULL, false, "prints nothing when all criteria are met"},
    {0}};

const struct command compare_command = {
    .name = "compare",
    .group = "Looking at results",
    .summary = "compare two sounds or two tables within tolerances",
    .does = "Says whether B is A, the reference, and by how much it is not. Of sounds it gives the number of "
            "differing samples, the first of them, and the largest difference. The signal-to-noise ratio and the "
            "third-octave levels follow. Of tables (CSV, or NPY with named fields) it gives the misses of each column "
            "and the worst of them. Of both it gives a SHA-256.\n"
            "Limits given together must all be met. Cells agree when |B - A| <= ABS + REL |A|. Sounds of different "
            "sample rates are not compared sample by sample: difference, LSB and SNR are left out, and every "
            "criterion but --third-octave fails.\n"
            "The SHA-256 of a sound is that of its audio, not of its file. It is of the rate in Hz, the number of "
            "channels, then all samples frame by frame. Each is a little-endian IEEE 754 double, integers of n bits "
            "being multiples of 2^(1-n), and -0 counts as +0. So A and B have the same exactly when --exact holds. "
            "That of a table is that of the file's bytes. With --hash there is one FILE, which must have the hash "
            "that is given.\n"
            "The exit code is 0 when the criteria are met and 1 when they are not. It is never 0 when a file is "
            "missing or empty.",
    .operands = "A B | FILE --hash SHA256",
    .least = 1,
    .most = 2,
    .options = options,
    .examples = "rasp compare golden.wav new.wav\n"
                "rasp compare --snr 80 --third-octave 0.1 golden.wav new.wav\n"
                "rasp compare --lsb 1 golden.wav new.wav\n"
                "rasp compare --tolerance tolerance.csv golden.csv new.csv\n"
                "rasp compare --abs 1e-9 --rel 1e-6 --column events=0,0 golden.csv new.csv\n"
                "rasp compare --quiet --hash \"$(cat new.sha256)\" new.wav\n",
    .run = compare_run,
};
