/* See tables.h. Names of columns are those that PsychoPy, R and BIDS take: lower case, with the unit at the end;
 * file_name is what Hugging Face's AudioFolder looks for. */
#include "batch/tables.h"

#include <inttypes.h>
#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/outfile.h"
#include "base/text.h"
#include "num/real.h"
#include "scene/keys.h"

void tables_number(FILE *f, double x)
{
    char text[40];
    if (!isfinite(x)) {
        fputs("n/a", f);
        return;
    }
    if (x == rint(x) && fabs(x) < 1e15) {
        fprintf(f, "%.0f", x + 0.0);
        return;
    }
    for (int digits = 1; digits <= 17; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, x);
        if (strtod(text, NULL) == x) break;
    }
    fputs(text, f);
}

void tables_text(FILE *f, const char *text)
{
    bool quoted = text[strcspn(text, ",\"\r\n")] != '\0' || *text == ' ' || (*text && text[strlen(text) - 1] == ' ');
    if (quoted) fputc('"', f);
    for (; *text; text++) {
        if (*text == '"') fputc('"', f);
        fputc(*text, f);
    }
    if (quoted) fputc('"', f);
}

/* ------------------------------------------------------------------ cells */

struct cell { /* what a column may be made from */
    const struct set *set;
    int row; /* from 0 */
    const struct tables_row *is;
    const struct record *record; /* NULL: none                    */
    const char *level;           /* set_level_text                  */
    const char *text;            /* of the trial; NULL: none        */
    char seed[24];
    FILE *f, *lines; /* the manifest as CSV, and as lines of JSON */
};

struct column {
    const char *name;                          /* NULL: the end; "*": here the factors' columns stand */
    const char *title, *meaning, *unit;        /* unit NULL: none */
    const char *(*text)(const struct cell *c); /* NULL: it is a number; NULL and NAN of it are n/a */
    double (*number)(const struct cell *c);
};

/* Of a stimulus that is complete. */
static const struct record *done(const struct cell *c)
{
    return c->record && c->record->status == RECORD_DONE ? c->record : NULL;
}

/* Of one that has a WAV, too. */
static const struct record *sound_of(const struct cell *c) { return done(c) && c->record->sounds ? c->record : NULL; }

/* Of a sound's record; NAN: there is none. */
#define SOUND(c, field) (sound_of(c) ? (double)sound_of(c)->field : NAN)

static double decibel(double x) { return x > 0 ? 20 * real_log10(x) : NAN; }

static double rounded(double x) { return rint(x * 1e4) / 1e4; }

static const struct record_file *file_of(const struct cell *c, const char *kind)
{
    static const struct record_file none = {0};
    const struct record *r = done(c);
    for (int i = 0; r && i < r->n_files; i++)
        if (!strcmp(r->files[i].kind, kind)) return &r->files[i];
    return &none;
}

static const struct record_file *main_file(const struct cell *c)
{
    static const char *const kinds[] = {"wav", "csv", "npy", "impacts"};
    const struct record_file *f = file_of(c, kinds[0]);
    for (int k = 1; !f->path && k < 4; k++)
        f = file_of(c, kinds[k]);
    return f;
}

static const struct design_stimulus *row_of(const struct cell *c) { return &c->set->design->stimuli[c->row]; }

static const char *file_name(const struct cell *c) { return main_file(c)->path; }
static const char *stimulus_id(const struct cell *c) { return row_of(c)->name; }
static const char *scene_file(const struct cell *c) { return file_of(c, "scene")->path; }
static const char *scene_sha256(const struct cell *c) { return file_of(c, "scene")->sha256; }
static const char *text(const struct cell *c) { return c->text; }
static const char *recording(const struct cell *c)
{
    return row_of(c)->recording ? basename(row_of(c)->recording) : NULL;
}
static const char *seed(const struct cell *c) { return row_of(c)->recording ? NULL : c->seed; }
static const char *encoding(const struct cell *c)
{
    return sound_of(c) ? keys_find("output.encoding")->choices[sound_of(c)->encoding].word : NULL;
}
static const char *level_mode(const struct cell *c) { return c->level; }
static const char *unit(const struct cell *c) { return sound_of(c) ? sound_of(c)->unit : NULL; }
static const char *audio(const struct cell *c) { return sound_of(c) ? sound_of(c)->audio : NULL; }
static const char *file_sha256(const struct cell *c) { return main_file(c)->sha256; }
static const char *job(const struct cell *c) { return c->record ? c->record->key : NULL; }
static const char *version(const struct cell *c) { return c->set->program; }
static const char *error(const struct cell *c) { return c->is->text; }

static const char *status(const struct cell *c)
{
    return done(c) ? "ok" : c->record ? "waits" : c->is->kind ? "failed" : "missing";
}

static double row(const struct cell *c) { return c->row + 1; }
static double replicate(const struct cell *c) { return row_of(c)->recording ? (double)NAN : row_of(c)->replicate; }
static const char *split(const struct cell *c) { return row_of(c)->split; }
static double sample(const struct cell *c) { return row_of(c)->sample ? row_of(c)->sample : (double)NAN; }
static double rate(const struct cell *c) { return c->record ? c->record->rate : NAN; }
static double channels(const struct cell *c) { return SOUND(c, channels); }
static double frames(const struct cell *c) { return c->record ? (double)c->record->frames : NAN; }
static double duration(const struct cell *c) { return frames(c) / rate(c); }
static double gain(const struct cell *c) { return decibel(SOUND(c, gain)); }
static double peak(const struct cell *c) { return decibel(SOUND(c, file_peak)); }
static double silent(const struct cell *c) { return sound_of(c) ? sound_of(c)->file_peak == 0 : NAN; }
static double beyond(const struct cell *c) { return SOUND(c, beyond); }
static double true_peak(const struct cell *c) { return rounded(decibel(SOUND(c, true_peak))); }
static double rms(const struct cell *c) { return decibel(SOUND(c, file_rms)); }
static double lufs(const struct cell *c) { return rounded(SOUND(c, file_lufs)); }
static double ramp(const struct cell *c) { return SOUND(c, ramp); }
static double onset(const struct cell *c) { return ramp(c) * !row_of(c)->recording; }
static double error_code(const struct cell *c) { return c->is->kind; }

static const struct column columns[] = {
    {"file_name", "File", "the stimulus, from the folder of this table: a WAV, or the table of what makes no sound",
     NULL, file_name, NULL},
    {"stimulus_id", "Stimulus", "name of the stimulus, as the design makes it: its files begin with it", NULL,
     stimulus_id, NULL},
    {"plan_row", "Row", "number of the stimulus in the order of the design, from 1", NULL, NULL, row},
    {"scene_file", "Scene",
     "the effective scene, with every parameter spelt out: rendering it gives the same bytes; n/a of a recording", NULL,
     scene_file, NULL},
    {"scene_sha256", "Hash of the scene",
     "SHA-256 of scene_file, which names its inputs as they are seen from its folder: it is another where the folder "
     "lies elsewhere",
     NULL, scene_sha256, NULL},
    {"*", NULL, NULL, NULL, NULL, NULL},
    {"text", "Text", "what the stimulus is, in words for those who listen", NULL, text, NULL},
    {"sample", "Sample",
     "number of the sample, from 1: cells of one sample share all values that are drawn; n/a where none is", NULL, NULL,
     sample},
    {"split", "Split", "part of the set, as for training and tests; n/a where the design has no splits", NULL, split,
     NULL},
    {"replicate", "Replicate",
     "number of the replicate, from 1: replicates differ in their noise alone; n/a of a recording", NULL, NULL,
     replicate},
    {"seed", "Noise seed",
     "seed of the scene's noise, 64 bits: stimuli of one replicate share it, but for samples and factors that are "
     "independent by the design",
     NULL, seed, NULL},
    {"recording", "Recording", "the supplied WAV that this stimulus was made from; n/a of what is rendered", NULL,
     recording, NULL},
    {"sample_rate_hz", "Sample rate", "audio samples per second", "Hz", NULL, rate},
    {"channels", "Channels", "channels of the WAV", NULL, NULL, channels},
    {"frames", "Frames", "samples of each channel", NULL, NULL, frames},
    {"duration_s", "Duration", "length of the file", "s", NULL, duration},
    {"encoding", "Encoding", "how samples are stored", NULL, encoding, NULL},
    {"level_mode", "Level rule",
     "how the level was set: common: one gain for the whole set, such that its greatest stimulus has the level; each: "
     "every stimulus has it; scene: as its scene says",
     NULL, level_mode, NULL},
    {"gain_db", "Gain",
     "file value per unit of the sound's quantity (of a recording: per its own sample value), in decibels", "dB", NULL,
     gain},
    {"gain_per", "Unit of the gain",
     "unit of the sound's quantity, which gain_db is per; n/a where recorded responses do not say theirs, and of a "
     "recording",
     NULL, unit, NULL},
    {"peak_dbfs", "Peak", "greatest sample of the file, re full scale", "dB", NULL, peak},
    {"true_peak_dbtp", "True peak",
     "greatest magnitude of the file between samples, too, re full scale: BS.1770, of four times as many samples "
     "(below 96 kHz)",
     "dB", NULL, true_peak},
    {"rms_dbfs", "Level", "rms of the whole file, re full scale (a square wave of full scale has 0)", "dB", NULL, rms},
    {"loudness_lufs", "Loudness", "integrated loudness of the file, BS.1770, mono counted on two ears; n/a below 0.4 s",
     "LUFS", NULL, lufs},
    {"silent", "Silent", "1: every sample of the file is 0; 0: some is not", NULL, NULL, silent},
    {"samples_beyond_full_scale", "Samples beyond full scale",
     "samples of the file, of all channels, whose magnitude is more than 1, as floating point holds them: whatever "
     "plays them clips",
     NULL, NULL, beyond},
    {"onset_ramp_s", "Onset ramp", "length of the raised-cosine ramp at the beginning", "s", NULL, onset},
    {"offset_ramp_s", "Offset ramp", "length of the raised-cosine ramp at the end", "s", NULL, ramp},
    {"audio_sha256", "Hash of the samples", "SHA-256 of the decoded samples, as rasp compare --hash has it", NULL,
     audio, NULL},
    {"file_sha256", "Hash of the file", "SHA-256 of file_name", NULL, file_sha256, NULL},
    {"job_hash", "Hash of the job",
     "SHA-256 of all that made the stimulus but its name and a gain that is common to the set: effective scene, with "
     "inputs by their hashes and by their names as seen from the design, program, level; the same wherever the output "
     "folder lies",
     NULL, job, NULL},
    {"tool_version", "Program", "the program that made it", NULL, version, NULL},
    {"status", "Status",
     "ok; failed: see error; waits: the common gain is not known while other stimuli are missing; missing: not "
     "rendered yet",
     NULL, status, NULL},
    {"error_code", "Exit code",
     "what a render of this stimulus alone exits with: 0, or as the manual's EXIT STATUS has it", NULL, NULL,
     error_code},
    {"error", "Error", "why it failed; n/a of what did not", NULL, error, NULL},
    {NULL, NULL, NULL, NULL, NULL, NULL},
};

/* ------------------------------------------------------------------ factors without effect */

/* Sorted by the hash of their samples, stimuli that have the same ones stand together, in the order of the design; each
 * is compared with the first of its group. */
struct sound {
    char audio[HASH_TEXT];
    int row;
};

struct search {
    const struct design *design;
    struct sound *sounds;
    int n, found;  /* found: stimuli that differ in some factor from the first of their group */
    bool *factors; /* [n_factors] that they differ in */
    const struct sound *pair[2], *replicates[2]; /* the first in the design: of these, and of a cell's; NULL: none */
};

static int by_audio(const void *a, const void *b)
{
    const struct sound *p = a, *q = b;
    int hashes = strcmp(p->audio, q->audio);
    return hashes ? hashes : (p->row > q->row) - (p->row < q->row);
}

static const char *find_no_effect(struct search *s, struct arena *a)
{
    if (s->n) qsort(s->sounds, (size_t)s->n, sizeof *s->sounds, by_audio);
    for (int i = 1, first = 0; i < s->n; i++) {
        const struct sound *one = &s->sounds[first], *other = &s->sounds[i];
        bool differ = false;
        if (strcmp(one->audio, other->audio) != 0) {
            first = i;
            continue;
        }
        for (int k = 0; k < s->design->n_factors; k++)
            if (strcmp(design_value(s->design, one->row, k), design_value(s->design, other->row, k)) != 0)
                differ = s->factors[k] = true;
        if (differ && (!s->found++ || one->row < s->pair[0]->row)) s->pair[0] = one, s->pair[1] = other;
        if (!differ && (!s->replicates[0] || one->row < s->replicates[0]->row))
            s->replicates[0] = one, s->replicates[1] = other;
    }
    const struct design_stimulus *rows = s->design->stimuli;
    const char *factors = "", *text = "";
    for (int k = 0; k < s->design->n_factors; k++)
        if (s->factors[k])
            factors = arena_format(a, "%s%s%s", factors, *factors ? ", " : "", s->design->factors[k].name);
    if (s->found)
        text = arena_format(a,
                            "%d of %d sounds %s the very samples of another one that differs in %s (%s and %s): what "
                            "the factor's levels set has no effect there",
                            s->found, s->n, s->found == 1 ? "has" : "have", factors, rows[s->pair[0]->row].name,
                            rows[s->pair[1]->row].name);
    if (!s->replicates[0]) return text;
    return arena_format(
        a, "%s%sreplicates have the very samples of each other (%s and %s): nothing is random there, and one would do",
        text, *text ? "; " : "", rows[s->replicates[0]->row].name, rows[s->replicates[1]->row].name);
}

/* ------------------------------------------------------------------ the side-car */

/* A BIDS data dictionary. */
static json_t *dictionary(const struct design *d)
{
    json_t *j = json_object();
    for (const struct column *c = columns; c->name; c++) {
        if (strcmp(c->name, "*") != 0)
            json_object_set_new(
                j, c->name,
                json_pack("{s:s, s:s, s:s*}", "LongName", c->title, "Description", c->meaning, "Units", c->unit));
        for (int k = 0; !strcmp(c->name, "*") && k < d->n_factors; k++) {
            const struct design_factor *f = &d->factors[k];
            json_t *levels = f->rule ? NULL : json_object();
            for (const struct design_level *l = f->levels; levels && l < f->levels + f->n_levels; l++)
                json_object_set_new(levels, l->value, json_string(l->text ? l->text : l->label));
            json_object_set_new(j, f->column,
                                json_pack("{s:s, s:s, s:s*, s:s*, s:o*}", "LongName", f->name, "Description",
                                          f->meaning ? f->meaning : "a factor of the design", "Units", f->unit, "Drawn",
                                          f->rule, "Levels", levels));
        }
    }
    return j;
}

/* ------------------------------------------------------------------ all tables */

enum { MANIFEST, LINES, DICTIONARY, TIMINGS, SUMS, TABLES };

static const char *const names[TABLES] = {"manifest.csv", "manifest.jsonl", "manifest.json", "timings.csv",
                                          "SHA256SUMS"};

struct writing {
    const struct tables *t;
    struct outfile files[TABLES];
    struct search search;
    struct cell cell;
    bool timings; /* they are written, too */
};

/* A cell of a row, of the CSV and as a member of its line of JSON. text NULL: a number. */
static void put_cell(const struct cell *cell, const char *name, const char *text, double x, bool first)
{
    if (!first) fputc(',', cell->f);
    char shown[4096] = ""; /* a path in an error may be no UTF-8 */
    json_t *j = text ? json_string(text) : NULL;
    if (text && !j) {
        text_show(text, shown, sizeof shown);
        j = json_string(shown);
    }
    fprintf(cell->lines, "%s\"%s\": ", first ? "{" : ", ", name);
    if (text)
        tables_text(cell->f, text);
    else
        tables_number(cell->f, x);
    if (text && strcmp(text, "n/a") != 0)
        json_dumpf(j, cell->lines, JSON_ENCODE_ANY | JSON_ENSURE_ASCII);
    else if (!text && isfinite(x))
        tables_number(cell->lines, x);
    else
        fputs("null", cell->lines);
    json_decref(j);
}

/* The column of a factor: numbers where all its levels are quantities. */
static void put_factor(const struct cell *cell, int k, bool first)
{
    const struct design_factor *f = &cell->set->design->factors[k];
    const char *value = design_value(cell->set->design, cell->row, k);
    put_cell(cell, f->column, f->numbers && *value != 'n' ? NULL : value, strtod(value, NULL), first);
}

/* The row of a stimulus, in both manifests. */
static void put_row(const struct cell *cell)
{
    const int n = cell->set->design->n_factors;
    for (const struct column *c = columns; c->name; c++) {
        const char *words = c->text ? c->text(cell) : NULL;
        if (strcmp(c->name, "*") != 0)
            put_cell(cell, c->name, c->text && !words ? "n/a" : words, c->text ? 0 : c->number(cell), c == columns);
        for (int k = 0; !strcmp(c->name, "*") && k < n; k++)
            put_factor(cell, k, false);
    }
    fputc('\n', cell->f);
    fputs("}\n", cell->lines);
}

/* The names of the columns. */
static void put_head(const struct design *d, FILE *f)
{
    for (const struct column *c = columns; c->name; c++) {
        if (strcmp(c->name, "*") != 0) fprintf(f, "%s%s", c == columns ? "" : ",", c->name);
        for (int k = 0; !strcmp(c->name, "*") && k < d->n_factors; k++)
            fprintf(f, ",%s", d->factors[k].column);
    }
    fputc('\n', f);
}

/* One stimulus, into all tables. */
static bool put_stimulus(struct writing *w, int i, struct err *e)
{
    const struct tables *t = w->t;
    const struct design_stimulus *x = &t->set->design->stimuli[i];
    struct arena *a = arena_open();
    struct record r;
    w->cell.row = i;
    w->cell.is = &t->rows[i];
    snprintf(w->cell.seed, sizeof w->cell.seed, "%" PRIu64, x->seed);
    w->cell.text = design_text(t->set->design, i, a);
    w->cell.record = t->rows[i].there && record_read(t->folder, x->name, a, &r) ? &r : NULL;
    bool ok =
        w->cell.record || !t->rows[i].there ||
        err_set(e, ERR_IO, "%s: the record of the stimulus cannot be read again", record_path(t->folder, x->name, a));
    if (ok) put_row(&w->cell);
    for (int k = 0; done(&w->cell) && k < r.n_files; k++) /* names hold nothing that sha256sum would want escaped */
        fprintf(w->files[SUMS].stream, "%s  %s\n", r.files[k].sha256, r.files[k].path);
    if (w->timings && t->rows[i].made) {
        FILE *f = w->files[TIMINGS].stream;
        tables_text(f, x->name);
        fputc(',', f);
        tables_number(f, t->rows[i].wall);
        fputc(',', f);
        tables_number(f, t->rows[i].cpu);
        fputc('\n', f);
    }
    if (sound_of(&w->cell) && r.audio && !x->recording) {
        snprintf(w->search.sounds[w->search.n].audio, HASH_TEXT, "%s", r.audio);
        w->search.sounds[w->search.n++].row = i;
    }
    arena_close(a);
    return ok;
}

/* The hash of a table that is complete, for SHA256SUMS. */
static bool put_own_sum(struct writing *w, int table, struct err *e)
{
    char hex[HASH_TEXT];
    bool ok = outfile_hash(&w->files[table], hex, e);
    if (ok) fprintf(w->files[SUMS].stream, "%s  %s\n", hex, names[table]);
    return ok;
}

bool tables_write(const struct tables *t, const char **no_effect, struct err *e)
{
    const struct design *d = t->set->design;
    struct writing w = {.t = t,
                        .search = {.design = d,
                                   .sounds = ARENA_TAKE(t->arena, struct sound, t->set->n),
                                   .factors = ARENA_TAKE(t->arena, bool, d->n_factors + 1)}};
    bool ok = true;
    w.timings = access(arena_format(t->arena, "%s/%s", t->folder, names[TIMINGS]), F_OK) != 0;
    for (int i = 0; i < t->set->n; i++)
        w.timings = w.timings || t->rows[i].made;
    for (int k = 0; k < TABLES; k++)
        w.files[k].fd = -1;
    for (int k = 0; k < TABLES && ok; k++)
        ok = (k == TIMINGS && !w.timings) ||
             outfile_open(&w.files[k], arena_format(t->arena, "%s/%s", t->folder, names[k]), e);
    w.cell = (struct cell){.set = t->set,
                           .level = set_level_text(t->set, t->arena),
                           .f = w.files[MANIFEST].stream,
                           .lines = w.files[LINES].stream};
    if (ok) put_head(d, w.cell.f);
    if (ok && w.timings) fputs("stimulus_id,wall_s,cpu_s\n", w.files[TIMINGS].stream);
    for (int i = 0; ok && i < t->set->n; i++)
        ok = put_stimulus(&w, i, e);
    if (ok) {
        json_t *j = dictionary(d);
        json_dumpf(j, w.files[DICTIONARY].stream, JSON_INDENT(2) | JSON_ENSURE_ASCII);
        fputc('\n', w.files[DICTIONARY].stream);
        json_decref(j);
        ok = put_own_sum(&w, MANIFEST, e) && put_own_sum(&w, LINES, e) && put_own_sum(&w, DICTIONARY, e);
    }
    for (int k = 0; k < TABLES; k++)
        if (ok && w.files[k].target[0])
            ok = outfile_commit(&w.files[k], e);
        else
            outfile_drop(&w.files[k]);
    *no_effect = ok ? find_no_effect(&w.search, t->arena) : "";
    return ok;
}

void tables_remove(const char *folder, struct arena *a)
{
    static const int stale[] = {SUMS, MANIFEST, LINES, DICTIONARY};
    for (int k = 0; k < 4; k++)
        unlink(arena_format(a, "%s/%s", folder, names[stale[k]]));
}

bool tables_are_there(const char *folder, struct arena *a)
{
    return access(arena_format(a, "%s/%s", folder, names[MANIFEST]), F_OK) == 0 &&
           access(arena_format(a, "%s/%s", folder, names[SUMS]), F_OK) == 0;
}
