/* See job.h. */
#include "batch/job.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "batch/claim.h"
#include "batch/folder.h"
#include "batch/measure.h"
#include "batch/recording.h"
#include "file/bytes.h"
#include "pipeline/inputs.h"
#include "pipeline/outputs.h"
#include "pipeline/render.h"
#include "pipeline/written.h"
#include "response/modes.h"
#include "scene/scene_places.h"

const char *job_base(const char *folder, const char *name, bool raw, struct arena *a)
{
    return arena_format(a, "%s/%s%s", folder, raw ? ".rasp/raw/" : "", name);
}

const char *job_hash(const char *const *texts, int n, struct arena *a)
{
    char *hex = arena_take(a, HASH_TEXT, 1), length[32];
    struct hash h = hash_start();
    for (int i = 0; i < n; i++) {
        size_t size = strlen(texts[i]);
        hash_add(&h, length, (size_t)snprintf(length, sizeof length, "%zu:", size));
        hash_add(&h, texts[i], size);
    }
    hash_end(&h, hex);
    return hex;
}

/* ------------------------------------------------------------------ the scene */

bool job_scene(const struct job_kit *k, int i, struct arena *a, struct scene *s, struct err *e)
{
    const char *messages = "";
    if (!design_scene(k->design, i, a, s, &messages, e))
        return false;
    set_lay(k->set, s);
    design_scene_places(k->design, s, a);
    s->shelf = k->shelf;
    return true;
}

/* ------------------------------------------------------------------ is it there? */

/* Of what has no hash, for it differs from run to run: NAME.json, which may hold somebody's notes, in whatever form. What a power cut leaves of one is empty, ends anywhere, or
   has zeros. */
static bool is_whole(const char *path)
{
    struct err unreadable = {0};
    struct bytes b;
    json_error_t fault;
    struct arena *a = arena_open();
    bool whole = bytes_read(path, a, &b, &unreadable) && b.at[strspn(b.at, " \t\r\n")] && !memchr(b.at, '\0', b.n);
    json_t *j = whole ? json_loadb(b.at, b.n, JSON_DISABLE_EOF_CHECK, &fault) : NULL;
    whole = j || (whole && (b.at[0] != '{' || (size_t)fault.position < b.n));
    json_decref(j);
    arena_close(a);
    return whole;
}

static const char *file_differs(const char *folder, const struct record_file *f, struct arena *a)
{
    char hex[HASH_TEXT];
    struct stat s;
    struct err unreadable = {0};
    const char *path = arena_format(a, "%s/%s", folder, f->path);
    if (stat(path, &s) != 0)
        return "is missing";
    if (!S_ISREG(s.st_mode))
        return "is no file";
    if (!f->sha256)
        return is_whole(path) ? NULL : "is not whole";
    return !hash_file(path, hex, &unreadable) ? "cannot be read" : strcmp(hex, f->sha256) ? "was changed" : NULL;
}

const char *job_differs(const char *folder, const struct record *r, struct arena *a, const char **file)
{
    const char *how = NULL;
    for (int i = 0; i < r->n_files && !how; i++) {
        how = file_differs(folder, &r->files[i], a);
        *file = r->files[i].path;
    }
    return how;
}

bool job_is_there(const char *folder, const struct record *r, struct arena *a)
{
    const char *file;
    return !job_differs(folder, r, a, &file);
}

/* A common loudness is found from the raw sounds', which a set of another level had no need of; the file's own, rounded to its encoding, would do for a gain that is nearly the same.
   A recording, which lies in no place, has its level already. */
bool job_tells_enough(const struct set *s, const struct record *r)
{
    return !set_waits(s) || isnan(s->level.lufs) || !r->sounds || !r->place || r->loud;
}

/* Complete, or waiting for its gain; its effective scene names the inputs as they are seen from the folder. */
static const struct record *find(const struct job_kit *k, const struct record *asked, struct arena *a, struct journal_ref *ref)
{
    for (int waits = 0; waits <= set_waits(k->set); waits++) {
        const struct record *r = k->force || (k->again && !waits) ? NULL : journal_find(k->journal, asked->key, waits, a, ref);
        if (r && r->place && !strcmp(r->place, asked->place) && job_tells_enough(k->set, r) && job_is_there(k->folder, r, a))
            return r;
    }
    return NULL;
}

/* ------------------------------------------------------------------ rendering */

/* What an earlier raw sound of the name has besides would be told as being there. */
static void clear_raw(const struct scene *s, const char *base, struct arena *a)
{
    const char **older = outputs_older(s, base, a);
    for (int i = 0; older[i]; i++)
        unlink(older[i]);
}

static bool add_file(const char *folder, const struct render_file *f, struct arena *a, struct record *r, struct err *e)
{
    char hex[HASH_TEXT];
    struct record_file *to = &r->files[r->n_files++];
    *to = (struct record_file){f->kind, f->path + strlen(folder) + 1, f->sha256};
    if (f->sha256 || !strcmp(f->kind, "summary"))
        return true;
    if (!hash_file(f->path, hex, e))
        return false;
    to->sha256 = arena_text(a, hex);
    return true;
}

static bool add_files(const char *folder, const struct render_report *report, struct arena *a, struct record *r, struct err *e)
{
    r->files = ARENA_TAKE(a, struct record_file, report->n_files);
    for (int i = 0; i < report->n_files; i++)
        if (!add_file(folder, &report->files[i], a, r, e))
            return false;
    return true;
}

bool job_measure(const char *folder, bool loud, struct record *r, struct err *e)
{
    struct arena *a = arena_open();
    struct measure m = {.lufs = NAN, .true_peak = NAN};
    const char *wav = NULL;
    for (int i = 0; i < r->n_files; i++)
        if (!strcmp(r->files[i].kind, "wav"))
            wav = arena_format(a, "%s/%s", folder, r->files[i].path);
    bool ok = wav && measure_file(wav, loud, &m, e);
    arena_close(a);
    r->channels = m.channels;
    r->file_peak = m.peak, r->file_rms = m.rms, r->file_lufs = m.lufs, r->true_peak = m.true_peak;
    if (ok)
        memcpy((char *)r->audio, m.audio, HASH_TEXT);
    return ok;
}

static void fill(const struct scene *s, const struct render_report *report, struct arena *a, struct record *r)
{
    r->rate = s->output.sample_rate;
    r->encoding = s->output.encoding;
    r->frames = report->frames;
    r->sounds = report->sounds;
    r->unit = report->quantity >= 0 ? modes_quantity_unit(report->quantity) : NULL;
    r->peak = report->sound.peak, r->rms = report->sound.rms;
    r->gain = report->sound.gain;
    r->ramp = report->sound.ramp;
    r->lufs = r->file_peak = r->file_rms = r->file_lufs = r->true_peak = NAN;
    r->beyond = report->sounds ? written_sound(report)->written->beyond : NAN;
    r->full_scale = s->output.level.full_scale;
    r->wall = report->seconds, r->cpu = report->cpu;
    r->remarks = ARENA_TAKE(a, const char *, report->n_warnings + 1);
    for (int i = 0; i < report->n_warnings; i++)
        r->remarks[i] = report->warnings[i];
    r->audio = report->sounds ? arena_take(a, HASH_TEXT, 1) : NULL;
}

/* A raw sound is measured only as far as the level needs it: its peak and rms are known. */
static bool measure(const struct job_kit *k, struct record *r, struct err *e)
{
    bool raw = r->job == NULL;
    if (!r->sounds || (raw && isnan(k->set->level.lufs)))
        return true;
    if (!job_measure(k->folder, true, r, e))
        return false;
    r->loud = raw;
    if (raw)
        r->lufs = r->file_lufs;
    return true;
}

static bool render_once(const struct job_kit *k, const struct scene *s, struct record *r, struct arena *a, struct err *e)
{
    bool raw = r->job == NULL;
    const char *base = job_base(k->folder, r->name, raw, a), *below = raw ? arena_format(a, ".rasp/raw/%s", r->name) : r->name;
    struct scene made = *s;
    struct render_report report;
    if (raw)
        made.output.encoding = ENCODING_FLOAT64;
    if (!folder_make_for(k->folder, below, e))
        return false;
    if (raw)
        clear_raw(&made, base, a);
    if (!render_scene(&made, base, a, &report, e))
        return scene_places_tell(s, e);
    fill(s, &report, a, r);
    return add_files(k->folder, &report, a, r, e) && measure(k, r, e);
}

/* Another batch in the same folder takes the raw sounds away when it has finished. */
static bool was_swept(const struct job_kit *k, const struct record *r, const struct err *e, struct arena *a)
{
    const char *base = job_base(k->folder, r->name, true, a), *slash = strrchr(base, '/');
    bool gone = access(arena_format(a, "%.*s", (int)(slash - base), base), F_OK) != 0;
    return !r->job && (e->kind == ERR_INPUT || ((e->kind == ERR_CREATE || e->kind == ERR_IO) && gone));
}

static bool render(const struct job_kit *k, const struct scene *s, struct record *r, struct arena *a, struct err *e)
{
    const struct record asked = *r;
    for (int tries = 0; tries < 3; tries++) {
        *r = asked;
        *e = (struct err){0};
        if (render_once(k, s, r, a, e))
            return true;
        if (!was_swept(k, r, e, a))
            break;
    }
    return false;
}

bool job_do(const struct job_kit *k, int i, struct arena *a, struct job_result *result, struct err *e)
{
    struct scene s;
    struct record *r = ARENA_TAKE(a, struct record, 1);
    const struct set_row *row = &k->set->rows[i];
    const struct design_stimulus *x = &k->design->stimuli[i];
    *result = (struct job_result){0};
    if (x->recording)
        return recording_do(k, i, a, result, e);
    if (!job_scene(k, i, a, &s, e))
        return false;
    struct watch inputs = inputs_watch(&s, a);
    const char *effective = outputs_effective(&s, k->design->file, a);
    const char *key = job_hash((const char *const[]){"stimulus", row->name, k->set->build, set_waits(k->set) ? "waits" : "", effective}, 5, a);
    *r = (struct record){.name = row->name, .key = key, .job = set_waits(k->set) ? NULL : key, .build = k->set->build, .place = claim_place(k->design->file, k->folder, a)};
    result->record = find(k, r, a, &result->ref);
    result->kept = result->record != NULL;
    if (result->kept)
        return true;
    if (!render(k, &s, r, a, e) || (!inputs_still(&inputs, e) && !scene_places_tell(&s, e)) || !journal_add(k->journal, r, &result->ref, e))
        return false;
    result->record = r;
    return true;
}
