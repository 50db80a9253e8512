/* See stimulus.h. */
#include "batch/stimulus.h"

#include <fcntl.h>
#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/interrupt.h"
#include "base/outfile.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "batch/recording.h"
#include "file/json_value.h"
#include "num/real.h"
#include "output/sound.h"
#include "pipeline/inputs.h"
#include "pipeline/outputs.h"
#include "pipeline/render.h"
#include "pipeline/summary.h"
#include "response/modes.h"
#include "scene/scene_places.h"

const char *const stimulus_states[] = {[STIMULUS_THERE] = "there",
                                       [STIMULUS_NEW] = "new",
                                       [STIMULUS_KEY] = "key",
                                       [STIMULUS_FILE] = "file",
                                       [STIMULUS_GAIN] = "gain"};

struct work { /* one stimulus at work */
    const struct stimulus_set *k;
    int i;
    const char *name, *base; /* base: FOLDER/NAME */
    struct arena *arena;
    struct scene scene; /* of what is rendered */
    const char *file;   /* of a recording; else NULL */
    struct watch inputs;
    const char *key;
    struct record *was; /* NULL: none */
    enum stimulus_state state;
};

/* ------------------------------------------------------------------ the key */

/* ------------------------------------------------------------------ is it there? */

static bool is_later(const struct timespec *a, const struct timespec *b)
{
    return a->tv_sec != b->tv_sec ? a->tv_sec > b->tv_sec : a->tv_nsec > b->tv_nsec;
}

/* Each by its hash, if its times say nothing. What was copied has the times of the copy: once its files have been
   hashed the record is younger than they are. */
static bool has_files(const struct work *w)
{
    struct stat record, s;
    const char *path = record_path(w->k->folder, w->name, w->arena);
    bool hashed = false, there = stat(path, &record) == 0;
    for (int k = 0; k < w->was->n_files && there; k++) {
        const struct record_file *f = &w->was->files[k];
        const char *file = arena_format(w->arena, "%s/%s", w->k->folder, f->path);
        char hex[HASH_TEXT];
        there = stat(file, &s) == 0 && S_ISREG(s.st_mode) && (double)s.st_size == f->size;
        if (!there ||
            !(w->k->unfinished || is_later(&s.st_mtim, &record.st_ctim) || is_later(&s.st_ctim, &record.st_ctim)))
            continue;
        hashed = true;
        there = hash_file(file, hex, &(struct err){0}) && !strcmp(hex, f->sha256);
    }
    if (there && hashed && !w->k->read_only) utimensat(AT_FDCWD, path, NULL, 0);
    return there;
}

/* means: as set_means */
static const char *scene_key(const struct set *s, int i, const char *means, struct arena *a)
{
    const char *waits = !set_waits(s)          ? ""
                        : isnan(s->level.lufs) ? "waits"
                                               : "waits, loudness",
               *seed = arena_format(a, "%llu", (unsigned long long)s->design->stimuli[i].seed),
               *length = arena_format(a, "%a", s->length);
    return set_hash((const char *const[]){"rasp set 2", "stimulus", s->program, waits, means, seed, length}, 7, a);
}

/* planned: what the scene means is known from when the set was planned, and it is not read. */
static bool begin(struct work *w, const struct stimulus_set *k, int i, bool planned, struct arena *a, struct err *e)
{
    const struct set *set = k->set;
    const struct design_stimulus *x = &set->design->stimuli[i];
    char hex[HASH_TEXT];
    *w = (struct work){.k = k, .i = i, .name = x->name, .arena = a, .file = x->recording};
    w->base = arena_format(a, "%s/%s", k->folder, x->name);
    if (w->file) {
        w->inputs = file_cache_watch(&w->file, 1, a);
        if (!hash_file(w->file, hex, e)) return design_scene_recording(set->design, i, e);
        w->key = recording_key(set, hex, a);
    } else if (planned)
        w->key = scene_key(set, i, set->means[i], a);
    else {
        const char *messages = "";
        if (!design_scene(set->design, i, a, &w->scene, &messages, e)) return false;
        w->scene.file_cache = k->file_cache;
        w->inputs = inputs_watch(&w->scene, a);
        set_means(set, &w->scene, a, hex);
        w->key = scene_key(set, i, hex, a);
        set_lay(set, &w->scene);
        design_scene_places(set->design, &w->scene, a);
    }
    struct record *r = ARENA_TAKE(a, struct record, 1);
    w->was = record_read(k->folder, w->name, a, r) ? r : NULL;
    w->state = !w->was                                           ? STIMULUS_NEW
               : strcmp(w->was->key, w->key) != 0                ? STIMULUS_KEY
               : w->was->status != RECORD_MAKING && has_files(w) ? STIMULUS_THERE
                                                                 : STIMULUS_FILE;
    return true;
}

static void fill(struct stimulus *s, const struct work *w, const struct record *r)
{
    s->waits = r->status == RECORD_WAITS;
    s->full_scale = r->full_scale;
    s->measured = (struct set_measured){r->peak, r->rms, r->lufs, r->encoding, r->sounds && !w->file};
}

bool stimulus_look(const struct stimulus_set *k, int i, struct arena *a, struct stimulus *s, struct err *e)
{
    struct work w;
    *s = (struct stimulus){.full_scale = NAN};
    if (!begin(&w, k, i, true, a, e)) return false;
    s->key = w.key;
    s->state = w.state;
    if (w.state == STIMULUS_THERE) fill(s, &w, w.was);
    return true;
}

/* ------------------------------------------------------------------ commit */

struct made {              /* files that are complete and settled, without names yet */
    struct render *render; /* NULL: none; else that alone */
    struct outfile scene;
    int n;
    struct wav_out *sounds[1 + STEMS];
    struct wav_written written[1 + STEMS];
    struct render_file files[1 + STEMS]; /* the sounds as a render has them */
};

static void drop(struct made *m)
{
    if (m->render) render_drop(m->render);
    outfile_drop(&m->scene);
    for (int k = 0; k < m->n; k++)
        wav_drop(m->sounds[k]);
    m->n = 0;
}

/* Of nothing yet, with room for so many files. */
static struct record begun(const struct work *w, enum record_status status, int n_files)
{
    struct record r = {.status = status, .key = w->key, .program = w->k->set->program, .full_scale = NAN, .rate = NAN};
    r.lufs = r.file_peak = r.file_rms = r.file_lufs = r.true_peak = r.beyond = NAN;
    r.seen_from = w->file ? NULL : w->k->seen_from;
    r.files = ARENA_TAKE(w->arena, struct record_file, n_files + 1);
    return r;
}

/* If all is complete (`whole`), gives the files their names between two records; then *w has the new one as its own. */
static bool commit(struct work *w, const struct record *to, struct made *m, bool whole, struct err *e)
{
    int n = w->was ? w->was->n_files : 0;
    struct record before = begun(w, RECORD_MAKING, n + to->n_files); /* what lies there, and what is about to */
    for (int k = 0; k < n + to->n_files; k++)
        before.files[before.n_files++] = k < n ? w->was->files[k] : to->files[k - n];
    interrupt_hold();
    if (whole && !w->file)
        whole = inputs_still(&w->inputs, e) || scene_places_report(&w->scene, e);
    else if (whole && file_cache_watch_changed(&w->inputs))
        whole = err_set(e, ERR_INPUT, "%s: has changed while it was copied: run the same command again", w->file);
    bool ok = whole && record_write(w->k->folder, w->name, &before, e);
    if (ok) { /* they get their names */
        ok = (!m->render || render_commit(m->render, e)) && (!m->scene.target[0] || outfile_commit(&m->scene, e));
        m->render = NULL;
        for (int k = 0; k < m->n && ok; k++) {
            ok = wav_commit(m->sounds[k], e);
            m->sounds[k] = NULL;
        }
    }
    drop(m);
    for (int k = 0; ok && k < n; k++) { /* what is not written any more goes, unless somebody changed it */
        const struct record_file *f = &w->was->files[k];
        const char *path = arena_format(w->arena, "%s/%s", w->k->folder, f->path);
        char hex[HASH_TEXT];
        bool listed = false;
        for (int i = 0; i < to->n_files; i++)
            listed = listed || !strcmp(to->files[i].path, f->path);
        if (!listed && !folder_inputs_has(w->k->inputs, path) && hash_file(path, hex, &(struct err){0}) &&
            !strcmp(hex, f->sha256))
            unlink(path);
    }
    ok = ok && record_write(w->k->folder, w->name, to, e);
    interrupt_go();
    if (ok) {
        w->was = ARENA_TAKE(w->arena, struct record, 1);
        *w->was = *to;
    }
    return ok;
}

/* A settled file that is about to be `path` of the folder. */
static bool add_file(struct record *r, const char *kind, const char *path, bool raw, const char *temporary,
                     struct arena *a, struct err *e)
{
    char hex[HASH_TEXT];
    struct stat s;
    if (!hash_file(temporary, hex, e)) return false;
    r->files[r->n_files++] =
        (struct record_file){kind, path, raw, arena_text(a, hex), stat(temporary, &s) == 0 ? (double)s.st_size : 0};
    return true;
}

/* What the WAV holds. */
static bool measure(struct record *r, const char *path, struct arena *a, struct err *e)
{
    struct measure m;
    char text[40];
    if (!recording_measure(path, NULL, true, &m, e)) return false;
    r->channels = m.channels;
    r->file_peak = m.peak, r->file_rms = m.rms, r->file_lufs = m.lufs;
    /* As far as it is the same everywhere: the meter's filter has its coefficients from libm. */
    snprintf(text, sizeof text, "%.8g", m.true_peak);
    r->true_peak = strtod(text, NULL);
    r->audio = arena_text(a, m.audio);
    return true;
}

/* ------------------------------------------------------------------ rendering */

static bool list_render(const struct work *w, const struct render_report *report, struct record *r, struct err *e)
{
    const char *wav = NULL;
    for (int k = 0; k < report->n_files; k++) {
        const struct render_file *f = &report->files[k];
        bool raw = r->status == RECORD_WAITS && f->written;
        if (!add_file(r, f->kind, record_file_path(w->name, basename(f->path), raw, w->arena), raw, f->temporary,
                      w->arena, e))
            return false;
        wav = !strcmp(f->kind, "wav") ? f->temporary : wav;
    }
    bool waits = r->status == RECORD_WAITS; /* a raw sound is measured only as far as the level needs it */
    if (!r->sounds || (waits && isnan(w->k->set->level.lufs))) return true;
    if (!measure(r, wav, w->arena, e)) return false;
    if (waits) {
        r->lufs = r->file_lufs;
        r->file_peak = r->file_rms = r->file_lufs = r->true_peak = NAN;
        r->audio = NULL;
    }
    return true;
}

static bool render(struct work *w, struct stimulus *s, struct err *e)
{
    bool waits = set_waits(w->k->set);
    struct scene made = w->scene;
    struct render_report report;
    const char *raw = waits ? arena_format(w->arena, "%s/.rasp/raw/%s", w->k->folder, w->name) : NULL;
    if (waits) made.output.encoding = ENCODING_FLOAT64;
    if (!folder_make_for(w->k->folder, w->name, e) ||
        (waits && !folder_make_for(w->k->folder, arena_format(w->arena, ".rasp/raw/%s", w->name), e)))
        return false;
    struct made m = {.render = render_make(&made, &(struct render_names){w->base, raw}, w->arena, &report, e),
                     .scene = {.fd = -1}};
    if (!m.render) return scene_places_report(&w->scene, e);
    struct record r = begun(w, waits ? RECORD_WAITS : RECORD_DONE, report.n_files);
    r.rate = report.sounds ? w->scene.output.sample_rate : NAN;
    r.frames = report.frames;
    r.sounds = report.sounds;
    r.peak = report.sound.peak, r.rms = report.sound.rms;
    r.encoding = w->scene.output.encoding;
    r.channels = sound_format(&w->scene, report.frames).channels;
    r.unit = report.quantity >= 0 ? modes_quantity_unit(report.quantity) : NULL;
    r.gain = report.sound.gain, r.ramp = report.sound.ramp;
    r.beyond = report.sounds ? summary_sound(&report)->written->beyond : NAN;
    r.render = report.summary;
    r.warnings = ARENA_TAKE(w->arena, const char *, report.n_warnings + 1);
    for (int k = 0; k < report.n_warnings; k++)
        r.warnings[k] = report.warnings[k];
    if (!commit(w, &r, &m, list_render(w, &report, &r, e), e)) return false;
    s->wall += report.seconds, s->cpu += report.cpu;
    return true;
}

/* ------------------------------------------------------------------ recordings */

static bool copy(struct work *w, struct stimulus *s, struct err *e)
{
    double start[2] = {stopwatch_wall(), stopwatch_cpu()};
    struct made m = {.scene = {.fd = -1}, .n = 1};
    struct record r = begun(w, RECORD_DONE, 1);
    const char *ending = sound_ending(w->k->set->encoding), *path = arena_format(w->arena, "%s%s", w->name, ending);
    r.sounds = true;
    if (!folder_make_for(w->k->folder, w->name, e)) return false;
    struct wav_out *out = m.sounds[0] =
        recording_make(w->k->set, w->file, arena_format(w->arena, "%s%s", w->base, ending), &r, w->arena, e);
    bool whole = out && add_file(&r, "wav", path, false, wav_temporary(out), w->arena, e) &&
                 measure(&r, wav_temporary(out), w->arena, e);
    bool ok = commit(w, &r, &m, whole, e);
    s->wall += stopwatch_wall() - start[0], s->cpu += stopwatch_cpu() - start[1];
    return ok;
}

/* ------------------------------------------------------------------ the effective scene */

/* In the place of the one that the record lists, or before the sounds. */
static bool put_scene(struct outfile *f, const struct work *w, struct record *r, struct err *e)
{
    const char *path = arena_format(w->arena, "%s.scene.yaml", w->base),
               *text = outputs_effective(&w->scene, path, w->arena);
    char hex[HASH_TEXT];
    int k = 0;
    if (!outfile_open(f, path, e)) return false;
    outfile_put(f, text, strlen(text));
    hash_bytes(text, strlen(text), hex);
    while (k < r->n_files && strcmp(r->files[k].kind, "scene") != 0 && strcmp(r->files[k].kind, "wav") != 0 &&
           strcmp(r->files[k].kind, "stem") != 0)
        k++;
    if (k == r->n_files || strcmp(r->files[k].kind, "scene") != 0)
        memmove(&r->files[k + 1], &r->files[k], (size_t)(r->n_files++ - k) * sizeof *r->files);
    r->files[k] = (struct record_file){"scene", arena_format(w->arena, "%s.scene.yaml", w->name), false,
                                       arena_text(w->arena, hex), (double)strlen(text)};
    return outfile_finalise(f, e);
}

/* With room for one more. */
static struct record copy_of(const struct record *r, struct arena *a)
{
    struct record c = *r;
    c.files = ARENA_TAKE(a, struct record_file, r->n_files + 1);
    if (r->n_files) memcpy(c.files, r->files, (size_t)r->n_files * sizeof *c.files);
    return c;
}

bool stimulus_make(const struct stimulus_set *k, int i, enum stimulus_how how, struct arena *a, struct stimulus *s,
                   struct err *e)
{
    struct work w;
    *s = (struct stimulus){.full_scale = NAN};
    if (!begin(&w, k, i, false, a, e)) return false;
    s->key = w.key;
    s->state = w.state;
    s->made = how == STIMULUS_ANEW || (how == STIMULUS_IF_NEEDED && w.state != STIMULUS_THERE);
    bool moved = w.state == STIMULUS_THERE && !w.file && !s->made &&
                 strcmp(w.was->seen_from ? w.was->seen_from : "", k->seen_from) != 0;
    if (s->made && w.file && !copy(&w, s, e))
        return e->kind == ERR_INPUT || e->kind == ERR_SCENE ? design_scene_recording(k->set->design, i, e) : false;
    if (s->made && !w.file && !render(&w, s, e)) return false;
    if (moved) { /* the design lies elsewhere by now: the files that the effective scene names are called otherwise */
        struct made m = {.scene = {.fd = -1}};
        struct record r = copy_of(w.was, a);
        r.seen_from = k->seen_from;
        if (!isnan(r.full_scale)) w.scene.output.level.full_scale = r.full_scale;
        if (!commit(&w, &r, &m, r.status == RECORD_WAITS || put_scene(&m.scene, &w, &r, e), e)) return false;
    }
    s->state = s->made ? STIMULUS_THERE : s->state;
    if (s->state == STIMULUS_THERE) fill(s, &w, w.was);
    return true;
}

/* ------------------------------------------------------------------ the gain of the set */

/* One raw WAV, f, into the file that it becomes. */
static bool scale(const struct work *w, struct made *m, struct record_file *f, struct err *e)
{
    struct measure_source in;
    char comment[80] = "rasp: contact force, 1.0 is 1 N";
    bool force = !strcmp(f->kind, "stem") && text_ends(f->path, ".force.wav"); /* in newtons, whatever the gain */
    double gain = force ? 1 : sound_known_gain(&w->scene);
    const char *raw = arena_format(w->arena, "%s/%s", w->k->folder, f->path),
               *path = record_file_path(w->name, basename(f->path), false, w->arena);
    if (!strcmp(f->kind, "wav")) path = arena_format(w->arena, "%s%s", w->name, sound_ending(w->scene.output.encoding));
    if (!recording_open(&in, raw, NULL, e)) return false;
    struct track_format t = sound_format(&w->scene, in.frames);
    struct wav_format format = {
        .rate = t.rate, .channels = in.in.channels, .bits = force ? -32 : t.bits, .title = t.title};
    if (!force) sound_comment(&w->scene, gain, comment);
    struct wav_out *out = wav_create(arena_format(w->arena, "%s/%s", w->k->folder, path), &format, e);
    if (out) m->sounds[m->n++] = out;
    bool ok = out && wav_comment(out, comment, e) && recording_copy(&in, out, gain, e) && wav_finish(out, e);
    wav_stream_close(&in.in);
    if (!ok && e->kind == ERR_SCENE)
        err_at(e, "%s",
               !strcmp(f->kind, "wav") ? "level"
                                       : "output.stems: a part of the sound may be louder than the whole: use "
                                         "output.encoding: float32, or a lower level");
    if (!ok) return false;
    const char *stem = NULL;
    for (int k = 0; k < STEMS && !strcmp(f->kind, "stem") && !stem; k++)
        stem = text_ends(path, arena_format(w->arena, ".%s.wav", stems_names[k])) ? stems_names[k] : NULL;
    m->written[m->n - 1] = wav_written(out);
    m->files[m->n - 1] = (struct render_file){
        .kind = f->kind, .path = path, .stem = stem, .written = &m->written[m->n - 1], .temporary = wav_temporary(out)};
    struct record one = {.files = f};
    return add_file(&one, f->kind, path, false, wav_temporary(out), w->arena, e);
}

/* What a render at that gain would have warned of. A raw sound that is silent has been warned of. */
static void add_warnings(const struct work *w, const struct made *m, struct record *r)
{
    int n = 0;
    while (r->warnings[n])
        n++;
    const char **all = ARENA_TAKE(w->arena, const char *, n + 2 * m->n + 1);
    for (int k = 0; k < n; k++)
        all[k] = r->warnings[k];
    for (int k = 0; k < m->n; k++) {
        const char *texts[2] = {r->peak > 0 ? summary_silent(&w->scene, &m->files[k], r->gain * r->peak, w->arena)
                                            : NULL,
                                summary_beyond(&w->scene, &m->files[k], w->arena)};
        for (int t = 0; t < 2; t++) {
            bool known = !texts[t];
            for (int i = 0; i < n && !known; i++)
                known = !strcmp(all[i], texts[t]);
            if (!known) all[n++] = texts[t];
        }
    }
    r->warnings = all;
}

/* The render's text, with the gain and the files that it has now. */
static const char *render_text(const struct work *w, const struct made *m, const struct record *r)
{
    json_t *j = json_loads(r->render, 0, NULL), *sound = json_object_get(j, "sound"), *file;
    size_t i;
    if (sound) {
        double peak = json_number_value(json_object_get(sound, "peak")),
               rms = json_number_value(json_object_get(sound, "rms"));
        json_object_set_new(sound, "gain", json_real(r->gain));
        json_object_set_new(sound, "gain_db", json_real(20 * real_log10(r->gain)));
        json_object_set_new(sound, "peak_dbfs", json_value_number(20 * real_log10(r->gain * peak)));
        json_object_set_new(sound, "rms_dbfs", json_value_number(20 * real_log10(r->gain * rms)));
    }
    for (int k = 0; k < m->n; k++) {
        const char *name = basename(m->files[k].path);
        json_array_foreach(json_object_get(j, "files"), i, file)
        {
            const char *listed = json_string_value(json_object_get(file, "name"));
            if (listed && !strcmp(listed, name)) summary_written(&m->files[k], file);
        }
        if (!m->files[k].stem) summary_written(&m->files[k], sound);
    }
    char *text = json_dumps(j, JSON_REAL_PRECISION(17) | JSON_ENSURE_ASCII);
    const char *whole = arena_text(w->arena, text ? text : "{}");
    free(text);
    json_decref(j);
    return whole;
}

static bool make_levelled(const struct work *w, struct made *m, struct record *r, struct err *e)
{
    for (int k = 0; k < r->n_files; k++)
        if (r->files[k].raw && !scale(w, m, &r->files[k], e)) return false;
    for (int k = 0; k < m->n; k++) {
        if (m->files[k].stem) continue;
        r->beyond = m->written[k].beyond;
        if (!measure(r, m->files[k].temporary, w->arena, e)) return false;
    }
    add_warnings(w, m, r);
    r->render = render_text(w, m, r);
    return put_scene(&m->scene, w, r, e);
}

bool stimulus_level(const struct stimulus_set *k, int i, double full_scale, bool may_render, struct arena *a,
                    struct stimulus *s, struct err *e)
{
    struct work w;
    if (!begin(&w, k, i, false, a, e)) return false;
    if (w.state == STIMULUS_KEY)
        return err_set(e, ERR_INPUT,
                       "what it is made of has changed since its level was measured: run the same command again");
    if (w.state != STIMULUS_THERE || w.was->status != RECORD_WAITS) {
        if (!may_render)
            return err_set(e, ERR_INPUT,
                           "its sound before the gain is not there any more: it has to be rendered again");
        if (!render(&w, s, e)) return false;
        s->made = true;
    }
    struct made m = {.scene = {.fd = -1}};
    struct record r = copy_of(w.was, a);
    w.scene.output.level.full_scale = full_scale;
    w.scene.output.level.later = false;
    r.status = RECORD_DONE;
    r.full_scale = full_scale;
    r.gain = sound_known_gain(&w.scene);
    if (!commit(&w, &r, &m, make_levelled(&w, &m, &r, e), e)) return false;
    fill(s, &w, w.was);
    return true;
}
