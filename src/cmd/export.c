/* rasp export: a rendered set as what programs for listening experiments, and readers of data sets, take. The trials of
   the design are one list (batch/trials.h); a format (export_formats.c) prints it. The folder appears when it is
   complete. */
#include <ctype.h>
#include <errno.h>
#include <fts.h>
#include <inttypes.h>
#include <jansson.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/hash.h"
#include "base/interrupt.h"
#include "base/outfile.h"
#include "base/relpath.h"
#include "base/text.h"
#include "batch/batch.h"
#include "cmd/export.h"
#include "cmd/message.h"
#include "file/bytes.h"
#include "file/wav.h"

static const char sums_name[] = "SHA256SUMS", mark[] = "# rasp export\n"; /* its first line, which sha256sum skips */

/* ------------------------------------------------------------------ files */

bool export_open(struct export *x, const char *name, struct err *e)
{
    const char *path = arena_format(x->arena, "%s/%s", x->temporary, name);
    if (!folder_make_for(x->temporary, name, e)) return false;
    x->files = arena_more(x->arena, x->files, x->n_files, sizeof *x->files);
    x->files[x->n_files++] = arena_text(x->arena, name);
    x->stream = fopen(path, "wx");
    return x->stream || err_set(e, err_system(ERR_CREATE), "%s: cannot be created: %s", path, strerror(errno));
}

bool export_close(struct export *x, struct err *e)
{
    bool bad = ferror(x->stream) != 0;
    errno = 0;
    bad |= fclose(x->stream) != 0;
    return (!bad && !e->kind) || err_set(e, err_system(ERR_IO), "%s: cannot be written: %s", x->files[x->n_files - 1],
                                         errno ? strerror(errno) : "not all of it arrived");
}

bool export_text(struct export *x, const char *name, const char *text, struct err *e)
{
    return export_open(x, name, e) && (fputs(text, x->stream), export_close(x, e));
}

bool export_json(struct export *x, const char *name, json_t *value, struct err *e)
{
    bool open = export_open(x, name, e);
    if (open) json_dumpf(value, x->stream, JSON_INDENT(2) | JSON_ENSURE_ASCII);
    json_decref(value);
    return open && (fputc('\n', x->stream), export_close(x, e));
}

void export_cell(struct export *x, bool first, const char *text)
{
    if (!first) fputc(x->format->tabs ? '\t' : ',', x->stream);
    if (x->format->tabs)
        for (; *text; text++) /* which have no quotes */
            fputc((unsigned char)*text < ' ' ? ' ' : *text, x->stream);
    else
        tables_text(x->stream, text);
}

const char *export_person(const struct export *x, int i, struct arena *a)
{
    return arena_format(a, "%0*d", snprintf(NULL, 0, "%d", x->people < 10 ? 10 : x->people), i);
}

/* ------------------------------------------------------------------ the set */

const char *export_manifest(const struct export *x, int i, const char *column)
{
    return x->manifest.cells[(size_t)i * x->manifest.columns + (size_t)csv_column(&x->manifest, column)];
}

/* What readers of tables take for a number, a truth or nothing: "007" would come back as 7. */
static bool is_lost(const char *word)
{
    static const char *const words[] = {"NA",  "N/A",  "n/a",   "NaN", "nan", "-nan", "null",  "NULL", "None",  "Inf",
                                        "inf", "TRUE", "FALSE", "T",   "F",   "True", "False", "true", "false", NULL};
    return !*word || text_number_length(word) == strlen(word) || text_is_one(word, words);
}

/* Each stimulus has its row, is done, makes a sound, and is what the design says. */
static bool stimulus_check(struct export *x, int i, struct err *e)
{
    const struct design *d = x->design;
    const char *name = d->stimuli[i].name, *status = export_manifest(x, i, "status");
    if (strcmp(status, "ok") != 0)
        return err_set(e, ERR_SCENE, "%s: %s %s: render the set first, by rasp batch", x->set, name,
                       strcmp(status, "failed") ? "is not there yet" : "has failed");
    if (!wav_is_name(export_manifest(x, i, "file_name")))
        return err_set(e, ERR_SCENE, "%s: %s makes no sound", x->set, name);
    if (is_lost(name))
        return err_set(e, ERR_SCENE,
                       "%s: the stimulus '%s' would be read as a number or as nothing from a table: give the design a "
                       "name: with a letter before it, as in s{order}",
                       d->file, name);
    for (int f = 0; f < d->n_factors; f++) {
        const char *value = design_value(d, i, f);
        double number;
        if (csv_column(&x->manifest, d->factors[f].column) < 0 ||
            strcmp(export_manifest(x, i, d->factors[f].column), value) != 0)
            return err_set(e, ERR_SCENE,
                           "%s: %s is not the %s of %s: is it the set of another design, or of an earlier state of it?",
                           x->set, d->factors[f].column, value, name);
        if (d->stimuli[i].level[f] >= 0 && is_lost(value) && !text_double(value, &number))
            return err_set(e, ERR_SCENE,
                           "%s: the label '%s' of %s would be read as something else from a table: give it another",
                           d->file, value, d->factors[f].name);
    }
    if (strcmp(export_manifest(x, i, "split"), d->stimuli[i].split ? d->stimuli[i].split : "n/a") != 0)
        return err_set(e, ERR_SCENE, "%s: %s is of another split in the design: run rasp batch again", x->set, name);
    if (x->format->browser && !strcmp(export_manifest(x, i, "encoding"), "float64"))
        return err_set(e, ERR_SCENE,
                       "%s: %s is float64, which browsers do not play: set: {output.encoding: pcm24} in the design",
                       x->set, name);
    return true;
}

static bool set_read(struct export *x, struct err *e)
{
    static const char *const needed[] = {"stimulus_id", "file_name", "status", "encoding", "file_sha256",
                                         "seed",        "frames",    "split",  NULL};
    const struct design *d = x->design;
    struct csv *m = &x->manifest;
    if (!csv_read(arena_format(x->arena, "%s/manifest.csv", x->set), x->arena, m, e)) return false;
    for (int k = 0; needed[k]; k++)
        if (csv_column(m, needed[k]) < 0)
            return err_set(e, ERR_SCENE, "%s: has no column %s: it is no manifest as rasp batch writes it", m->file,
                           needed[k]);
    for (int i = 0; i < d->n_stimuli; i++) { /* in the order of the design */
        const char *name = d->stimuli[i].name;
        if (m->rows != (size_t)d->n_stimuli || strcmp(export_manifest(x, i, "stimulus_id"), name) != 0)
            return err_set(e, ERR_SCENE, "%s: %zu rows, and not %s in row %d: is it the set of %s, as it is now?",
                           m->file, m->rows, name, i + 1, d->file);
        if (!stimulus_check(x, i, e)) return false;
    }
    return true;
}

/* ------------------------------------------------------------------ the sounds, and the table of them */

static const char *const whole[] = {"train", NULL}; /* of a set that is not divided */

static const char *sounds_folder(const struct export *x, int i, struct arena *a)
{
    const char *split = x->design->stimuli[i].split;
    if (x->format->splits) return split ? split : whole[0];
    return arena_format(a, x->format->sounds, x->name);
}

const char *export_sound(const struct export *x, int i, struct arena *a)
{
    return arena_format(a, "%s/%s", sounds_folder(x, i, a), export_manifest(x, i, "file_name"));
}

static bool sound_copy(struct export *x, int i, struct err *e)
{
    struct arena *a = arena_open();
    const char *from = arena_format(a, "%s/%s", x->set, export_manifest(x, i, "file_name"));
    struct bytes b;
    char hex[HASH_TEXT];
    bool ok = bytes_read(from, a, &b, e);
    if (ok) hash_bytes(b.at, b.n, hex);
    if (ok && strcmp(hex, export_manifest(x, i, "file_sha256")) != 0)
        ok = err_set(e, ERR_INPUT, "%s: was changed since the set was rendered: run rasp batch again", from);
    ok = ok && export_open(x, export_sound(x, i, a), e) && (fwrite(b.at, 1, b.n, x->stream), export_close(x, e));
    arena_close(a);
    return ok;
}

/* The rows of the manifest whose sounds lie in the folder, and its side-car. Seeds have a letter before them, since 64
   bits do not survive where they are read as a number. */
static bool table_write(struct export *x, const char *folder, struct err *e)
{
    const struct csv *m = &x->manifest;
    struct arena *a = x->arena;
    const char *called = x->format->tabs ? "stim_file" : "file_name";
    if (!export_open(x, arena_format(a, "%s/%s", folder, x->format->table), e)) return false;
    for (int i = -1; i < x->design->n_stimuli; i++) { /* -1: the names of the columns */
        if (i >= 0 && x->format->splits && sounds_folder(x, i, a) != folder) continue;
        for (size_t c = 0; c < m->columns; c++) {
            const char *text = i < 0 ? m->names[c] : m->cells[(size_t)i * m->columns + c];
            if (i < 0 && !strcmp(m->names[c], "file_name")) text = called;
            if (!strcmp(m->names[c], "seed") && isdigit((unsigned char)*text)) text = arena_format(a, "s%s", text);
            export_cell(x, c == 0, text);
        }
        fputc('\n', x->stream);
    }
    if (!export_close(x, e)) return false;
    json_auto_t *side = json_load_file(arena_format(a, "%s/manifest.json", x->set), 0, NULL);
    if (!json_is_object(side))
        return err_set(e, ERR_INPUT, "%s/manifest.json: is not there, or no side-car of the manifest", x->set);
    json_t *seed = json_object_get(side, "seed"), *file = json_object_get(side, "file_name");
    const char *what = json_string_value(json_object_get(seed, "Description"));
    json_object_set_new(seed, "Description", json_sprintf("the letter s, and the %s", what ? what : "seed"));
    if (x->format->tabs && file) {
        json_object_set(side, called, file);
        json_object_del(side, "file_name");
    }
    return export_json(x, arena_format(a, "%s/%s.json", folder, relpath_stem(x->format->table, a)), json_incref(side),
                       e);
}

static bool interrupted(struct err *e)
{
    return interrupt_seen() && !err_set(e, ERR_INTERRUPTED, "interrupted; nothing was written");
}

static bool sounds_write(struct export *x, struct err *e)
{
    for (int i = 0; i < x->design->n_stimuli; i++)
        if (interrupted(e) || !sound_copy(x, i, e)) return false;
    if (!x->format->splits) return table_write(x, sounds_folder(x, 0, x->arena), e);
    for (const char *const *split = x->design->splits ? x->design->splits : whole; *split; split++) {
        bool used = false;
        for (int i = 0; i < x->design->n_stimuli && !used; i++)
            used = sounds_folder(x, i, x->arena) == *split;
        if (used && !table_write(x, *split, e)) return false;
    }
    return true;
}

/* ------------------------------------------------------------------ the folder */

static bool list_write(struct export *x, int participant, int sitting, struct arena *a, struct err *e)
{
    int sittings = x->trials.n_sessions;
    struct export_list l = {.person = export_person(x, participant, a), .arena = a};
    if (sittings > 1) l.sitting = arena_format(a, "%0*d", snprintf(NULL, 0, "%d", sittings), sitting);
    l.name = arena_format(a, "p%s%s%s", l.person, l.sitting ? "_s" : "", l.sitting ? l.sitting : "");
    l.trials = trials_list(&x->trials, x->seed, participant, sitting, a, &l.n);
    json_auto_t *trials = json_array();
    for (int k = 0; k < l.n && !interrupted(e) && !e->kind; k++)
        json_array_append_new(trials, x->format->trial(x, &l, k, e));
    return !e->kind && x->format->list(x, &l, trials, e);
}

static bool lists_write(struct export *x, struct err *e)
{
    for (int p = 1; x->format->list && p <= x->people; p++)
        for (int s = 1; s <= x->trials.n_sessions; s++) {
            struct arena *a = arena_open();
            bool ok = list_write(x, p, s, a, e);
            arena_close(a);
            if (!ok) return false;
        }
    return true;
}

static int by_text(const void *a, const void *b) { return strcmp(*(const char *const *)a, *(const char *const *)b); }

/* What the export consists of, by name; by it the folder is known as one that may be replaced. */
static bool sums_write(struct export *x, struct err *e)
{
    int n = x->n_files;
    char hex[HASH_TEXT];
    qsort(x->files, (size_t)n, sizeof *x->files, by_text);
    if (!export_open(x, sums_name, e)) return false;
    fputs(mark, x->stream);
    for (int i = 0; i < n && hash_file(arena_format(x->arena, "%s/%s", x->temporary, x->files[i]), hex, e); i++)
        fprintf(x->stream, "%s  %s\n", hex, x->files[i]);
    return export_close(x, e);
}

/* A folder that is there is replaced if all in it is as an export left it. ERR_CREATE */
static bool may_replace(const struct export *x, struct err *e)
{
    struct stat st;
    struct bytes b;
    struct err none = {0};
    if (lstat(x->output, &st) != 0) return true;
    if (!S_ISDIR(st.st_mode)) return err_set(e, ERR_CREATE, "%s: is there already, and no folder", x->output);
    const char *sums = bytes_read(arena_format(x->arena, "%s/%s", x->output, sums_name), x->arena, &b, &none)
                           ? arena_format(x->arena, "%.*s", (int)b.n, b.at)
                           : "";
    if (strncmp(sums, mark, strlen(mark)) != 0) sums = "";
    FTS *walk = fts_open((char *const[]){arena_text(x->arena, x->output), NULL}, FTS_PHYSICAL | FTS_NOCHDIR, NULL);
    const char *strange = walk ? NULL : ".";
    for (FTSENT *f; walk && !strange && (f = fts_read(walk));) {
        const char *name = f->fts_path + strlen(x->output);
        char hex[HASH_TEXT];
        name += *name == '/';
        if (f->fts_info == FTS_D || f->fts_info == FTS_DP || !strcmp(name, sums_name)) continue;
        if (f->fts_info != FTS_F || !hash_file(f->fts_path, hex, &none) ||
            !strstr(sums, arena_format(x->arena, "\n%s  %s\n", hex, name)))
            strange = arena_text(x->arena, name);
    }
    if (walk) fts_close(walk);
    return !strange || err_set(e, ERR_CREATE,
                               "%s: is there already, and %s in it is not as an export left it: give another folder, "
                               "or move it away",
                               x->output, strange);
}

static bool folder_write(struct export *x, struct err *e)
{
    if (!may_replace(x, e)) return false;
    x->temporary = outfile_folder_open(x->output, x->arena, e);
    if (!x->temporary) return false;
    bool ok =
        sounds_write(x, e) && (!x->format->files || x->format->files(x, e)) && lists_write(x, e) && sums_write(x, e);
    return outfile_folder_close(x->output, x->temporary, ok, x->arena, e);
}

/* ------------------------------------------------------------------ command */

static bool format_read(struct export *x, const struct args *g, struct err *e)
{
    const char *words[16] = {NULL}, *list = "";
    int k = -1;
    for (int i = 0; export_formats_table[i].name; i++) {
        words[i] = export_formats_table[i].name;
        list = arena_format(x->arena, "%s%s%s", list, i ? ", " : "", words[i]);
    }
    if (!args_given(g, "for")) return err_set(e, ERR_USAGE, "--for is needed, one of: %s", list);
    if (!args_word(g, "for", words, &k, e)) return false;
    x->format = &export_formats_table[k];
    return true;
}

static bool options_read(struct export *x, const struct args *g, struct err *e)
{
    const char *output = args_value(g, "output");
    char *made = arena_text(x->arena, relpath_stem(g->operands[0], x->arena));
    long people = 1;
    if (!format_read(x, g, e)) return false;
    if (!output || !*output) return err_set(e, ERR_USAGE, "--output: a folder is needed, as in -o study");
    x->set = batch_folder(x->arena, g->operands[1]);
    x->output = batch_folder(x->arena, output);
    for (char *p = made; *p; p++) /* of what cannot be in a name: _ */
        *p = isalnum((unsigned char)*p) ? *p : '_';
    x->name = args_given(g, "name") ? args_value(g, "name") : made;
    if (!*x->name || x->name[strspn(x->name, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-")])
        return err_set(e, ERR_USAGE, "--name: '%s' is not of letters, digits, _ and - alone", x->name);
    if (!args_whole(g, "participants", (const long[2]){1, TRIALS_PEOPLE}, &people, e)) return false;
    x->people = (int)people;
    return true;
}

/* What the format takes of the design, and of the options that depend on the two. */
static bool trials_read(struct export *x, const struct args *g, struct err *e)
{
    const struct design *d = x->design;
    const struct export_format *f = x->format;
    const char *seed = args_value(g, "seed");
    x->seed = d->seed;
    if (seed && !text_u64(seed, &x->seed))
        return err_set(e, ERR_USAGE, "--seed: '%s' is not a whole number from 0 to 18446744073709551615", seed);
    if (f->list && !d->trials && !f->bare)
        return err_set(e, ERR_SCENE,
                       "%s: has no trials: say what listeners do, as in trials: {task: choose, question: Which "
                       "material is it?, answers: material}; rasp explain trials",
                       g->operands[0]);
    return (!f->list || !d->trials || trials_make(d, x->arena, &x->trials, e)) && set_read(x, e);
}

static int export_run(struct cmd_call *c, struct err *e)
{
    struct export x = {.arena = c->arena};
    struct batch_report r = {.messages = ""};
    const char *file = c->args.operands[0];
    if (!options_read(&x, &c->args, e)) return (int)e->kind;
    message_group(c);
    if (!design_read(file, x.arena, &r.design, &r.messages, e)) {
        batch_message_unread(c, file, &r, e);
        return (int)e->kind;
    }
    x.design = &r.design;
    if (!trials_read(&x, &c->args, e) || !folder_write(&x, e)) return (int)e->kind;
    printf("%s: for %s: %d sounds", x.output, x.format->name, r.design.n_stimuli);
    if (x.trials.n) printf(", %d trials, %d participant%s", x.trials.n, x.people, x.people == 1 ? "" : "s");
    printf("\n");
    return ERR_NONE;
}

static const struct args_option export_options[] = {
    {"for", 0, "webmushra|psychopy|jspsych|page|bids|audiofolder", false, "what the folder is for, see above"},
    {"output", 'o', "FOLDER", false, "the folder that is made; one that an export left is replaced"},
    {"participants", 'p', "N", false, "how many participants have an order of their own, 1 to 10000; default: 1"},
    {"seed", 0, "NUMBER", false, "what orders are drawn from; default: the design's seed"},
    {"name", 0, "WORD", false, "what the study is called in names of files; default: the design's"},
    {0},
};

const struct command export_command = {
    .name = "export",
    .summary = "makes a listening experiment, or a data set, of a rendered set",
    .does = "DESIGN is that of the set in FOLDER, which rasp batch has rendered. Its trials (rasp-design(5)) say what "
            "listeners do. The folder that is made has the sounds, copied, a table of them with the columns of "
            "manifest.csv and its side-car, and what the format asks for.\n"
            "For webmushra: configs/NAME_p01.yaml for each participant. They are added to a copy of webMUSHRA, which "
            "is not part of this (PHP 7, or pymushra), and opened with ?config=NAME_p01.yaml. Trials with a reference "
            "are MUSHRA pages, which want sounds of one length (length: longest). All others are Likert pages. It has "
            "no page for two sounds that are compared, and shuffles the sounds of a page by itself. What its service "
            "writes (results/name_p01/) rasp judge takes with --design DESIGN.\n"
            "For psychopy: conditions_p01.csv, a row a trial, in order (loopType sequential), with file_1, file_2 and "
            "so on.\n"
            "For jspsych: index.html and lists/p01.js, whose trials are timeline variables. The command npm install "
            "fetches jsPsych. For page: the same without any library, with buttons or sliders. Both are opened as "
            "index.html?list=p01, from the disk or from a server of files. They take an answer once its sounds were "
            "heard to their end. They give answers_p01.csv as a download, a row an answer, which rasp judge reads.\n"
            "For bids: stimuli/, and sub-01/beh/ with the trials of each participant, to be filled in, and side-cars "
            "for all columns. For audiofolder: train/metadata.csv with its sounds, as Hugging Face's datasets read "
            "it, or a folder for each of the design's splits.",
    .also = "Where trials have a session, each participant has a list for each (p01_s1). Each session comes at each "
            "place, and behind each other one, equally often. Orders are drawn from the seed: the same seed gives the "
            "same bytes everywhere, and one more participant changes nobody's order. In tables seeds begin with s, "
            "since 64 bits do not survive where they are read as numbers. The folder appears when it is complete. "
            "SHA256SUMS has what is in it.",
    .operands = "DESIGN FOLDER",
    .least = 2,
    .most = 2,
    .options = export_options,
    .examples = "rasp batch scenes/designs/materials_by_rate.yaml -o clips -q\n"
                "rasp export scenes/designs/materials_by_rate.yaml clips --for page -o study --participants 4\n",
    .run = export_run,
};
