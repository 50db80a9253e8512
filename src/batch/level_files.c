/* See level_files.h. */
#include "batch/level_files.h"

#include <errno.h>
#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "batch/folder.h"
#include "base/memory.h"
#include "file/json_value.h"
#include "file/wav_stream.h"
#include "num/real.h"
#include "output/sound.h"
#include "pipeline/outputs.h"
#include "pipeline/written.h"
#include "scene/scene_read.h"

enum { PIECE = 4096 };
#define RAW ".rasp/raw/"

static bool is(const struct level_files *f, int i, const char *kind)
{
    return !strcmp(f->record->files[i].kind, kind);
}

/* A force is in newtons, whatever the gain. */
static bool is_force(const char *path)
{
    size_t n = strlen(path);
    return n > 10 && !strcmp(path + n - 10, ".force.wav");
}

static bool is_scaled(const struct level_files *f, int i)
{
    return is(f, i, "wav") || (is(f, i, "stem") && !is_force(f->record->files[i].path));
}

/* ------------------------------------------------------------------ sounds */

static bool copy(struct wav_stream *in, struct wav_out *out, double gain, struct err *e)
{
    double x[PIECE];
    long n, most = PIECE / in->channels;
    do {
        if (!wav_stream_read(in, x, most, &n, e))
            return false;
        for (long i = 0; i < n * in->channels; i++)
            x[i] *= gain;
        if (n > 0 && !wav_write(out, x, (size_t)n, e))
            return false;
    } while (n > 0);
    return true;
}

static bool scale(struct level_files *f, int i, struct err *e)
{
    struct wav_stream in;
    char comment[80];
    double gain = sound_known_gain(&f->scene);
    if (!wav_stream_open(&in, f->raw[i], e))
        return false;
    struct track_format t = sound_format(&f->scene, in.frames);
    struct wav_format w = {.rate = t.rate, .channels = t.channels, .bits = t.bits, .title = t.title};
    sound_comment(&f->scene, gain, comment);
    f->sounds[i] = wav_create(f->paths[i], &w, e);
    bool ok = f->sounds[i] && wav_comment(f->sounds[i], comment, e) && copy(&in, f->sounds[i], gain, e) && wav_settle(f->sounds[i], e);
    wav_stream_close(&in);
    if (!ok && e->kind == ERR_SCENE)
        err_at(e, "%s", is(f, i, "wav") ? "level" : "output.stems: a part of the sound may be louder than the whole: use output.encoding: float32, or a lower level");
    return ok;
}

/* ------------------------------------------------------------------ texts */

static bool put_text(struct level_files *f, int i, const char *text, struct err *e)
{
    char hex[HASH_TEXT];
    if (!outfile_open(&f->texts[i], f->paths[i], e))
        return false;
    fputs(text, f->texts[i].stream);
    hash_bytes(text, strlen(text), hex);
    f->made[i].sha256 = is(f, i, "summary") ? NULL : arena_text(f->arena, hex);
    return outfile_settle(&f->texts[i], e);
}

static void set_level(json_t *sound, double gain)
{
    double peak = json_number_value(json_object_get(sound, "peak")), rms = json_number_value(json_object_get(sound, "rms"));
    json_object_set_new(sound, "gain", json_real(gain));
    json_object_set_new(sound, "gain_db", json_real(20 * real_log10(gain)));
    if (peak > 0) {
        json_object_set_new(sound, "peak_dbfs", json_real(20 * real_log10(gain * peak)));
        json_object_set_new(sound, "rms_dbfs", json_real(20 * real_log10(gain * rms)));
    }
}

static void set_hash(json_t *files, const char *sha256)
{
    for (size_t i = 0; i < json_array_size(files); i++) {
        json_t *f = json_array_get(files, i);
        const char *kind = json_string_value(json_object_get(f, "kind"));
        if (kind && !strcmp(kind, "scene"))
            json_object_set_new(f, "sha256", json_string(sha256));
    }
}

/* File i as a render has it. */
static struct render_file written_file(const struct level_files *f, int i, struct wav_written *w)
{
    size_t n = strlen(f->made[i].path);
    struct render_file file = {.kind = f->made[i].kind, .path = f->made[i].path, .written = w};
    *w = wav_written(f->sounds[i]);
    for (int k = 0; k < STEMS && is(f, i, "stem"); k++) {
        const char *ending = arena_format(f->arena, ".%s.wav", stems_names[k]);
        if (n > strlen(ending) && !strcmp(f->made[i].path + n - strlen(ending), ending))
            file.stem = stems_names[k];
    }
    return file;
}

/* What a render at that gain would have warned of. A raw sound that is silent has been told of. */
static void add_remarks(struct level_files *f, struct record *r)
{
    int n = 0;
    while (r->remarks && r->remarks[n])
        n++;
    const char **all = ARENA_TAKE(f->arena, const char *, n + 2 * f->n + 1);
    for (int i = 0; i < n; i++)
        all[i] = r->remarks[i];
    f->told = n;
    for (int i = 0; i < f->n; i++) {
        struct wav_written w;
        struct render_file file;
        if (!f->sounds[i])
            continue;
        file = written_file(f, i, &w);
        r->beyond = is(f, i, "wav") ? w.beyond : r->beyond;
        const char *silent = r->peak > 0 ? written_silent(&f->scene, &file, r->gain * r->peak, f->arena) : NULL, *beyond = written_beyond(&f->scene, &file, f->arena);
        for (const char **text = (const char *[]){silent, beyond}, **end = text + 2; text < end; text++) {
            bool known = !*text;
            for (int k = 0; k < n && !known; k++)
                known = !strcmp(all[k], *text);
            if (!known)
                all[n++] = *text;
        }
    }
    r->remarks = all;
}

/* The same in the summary, whose warnings are those of the raw sound so far. */
static void tell_written(const struct level_files *f, json_t *summary)
{
    json_t *files = json_object_get(summary, "files"), *warnings = json_object_get(summary, "warnings");
    for (int i = 0; i < f->n; i++) {
        struct wav_written w;
        if (!f->sounds[i])
            continue;
        const struct render_file file = written_file(f, i, &w);
        const char *slash = strrchr(file.path, '/'), *name = slash ? slash + 1 : file.path;
        for (size_t k = 0; k < json_array_size(files); k++) {
            const char *listed = json_string_value(json_object_get(json_array_get(files, k), "name"));
            if (listed && !strcmp(listed, name))
                written_tell(&file, json_array_get(files, k));
        }
        if (is(f, i, "wav"))
            written_tell(&file, json_object_get(summary, "sound"));
    }
    for (int i = f->told; f->record->remarks[i]; i++)
        json_array_append_new(warnings, json_value_shown(f->record->remarks[i]));
}

/* The raw sound's summary, with the gain and the scene that it has now. */
static bool put_summary(struct level_files *f, int i, const char *scene, struct err *e)
{
    json_error_t fault;
    json_t *j = json_load_file(f->raw[i], 0, &fault);
    if (!j)
        return err_set(e, ERR_INPUT, "%s: %s", f->raw[i], fault.text);
    if (json_object_get(j, "sound"))
        set_level(json_object_get(j, "sound"), sound_known_gain(&f->scene));
    tell_written(f, j);
    set_hash(json_object_get(j, "files"), scene);
    char *text = json_dumps(j, JSON_INDENT(2) | JSON_REAL_PRECISION(9) | JSON_ENSURE_ASCII);
    json_decref(j);
    bool ok = put_text(f, i, arena_format(f->arena, "%s\n", text ? text : "{}"), e);
    free(text);
    return ok;
}

static bool read_scene(struct level_files *f, int i, struct err *e)
{
    const char *messages = "";
    if (!scene_read(f->raw[i], NULL, f->arena, &f->scene, &messages, e))
        return false;
    f->scene.inputs_known = true; /* it says what the sound was made of */
    f->scene.output.encoding = f->record->encoding;
    f->scene.output.level.full_scale = f->record->full_scale;
    return true;
}

static int find(const struct level_files *f, const char *kind)
{
    for (int i = 0; i < f->n; i++)
        if (is(f, i, kind))
            return i;
    return -1;
}

static bool put_texts(struct level_files *f, struct err *e)
{
    int scene = find(f, "scene"), summary = find(f, "summary");
    return put_text(f, scene, outputs_effective(&f->scene, f->paths[scene], f->arena), e) &&
           (summary < 0 || put_summary(f, summary, f->made[scene].sha256, e));
}

/* ------------------------------------------------------------------ all of them */

static void list(struct level_files *f, const struct record *r)
{
    f->n = r->n_files;
    f->made = ARENA_TAKE(f->arena, struct record_file, f->n);
    f->raw = ARENA_TAKE(f->arena, const char *, f->n);
    f->paths = ARENA_TAKE(f->arena, const char *, f->n);
    f->sounds = ARENA_TAKE(f->arena, struct wav_out *, f->n);
    f->texts = ARENA_TAKE(f->arena, struct outfile, f->n);
    for (int i = 0; i < f->n; i++) {
        const char *raw = r->files[i].path, *path = strncmp(raw, RAW, strlen(RAW)) ? raw : raw + strlen(RAW);
        f->made[i] = r->files[i];
        f->made[i].path = path;
        f->raw[i] = arena_format(f->arena, "%s/%s", f->folder, raw);
        f->paths[i] = arena_format(f->arena, "%s/%s", f->folder, path);
        f->texts[i].fd = -1;
    }
}

bool level_files_make(struct level_files *f, const struct job_kit *k, struct record *r, struct arena *a, struct err *e)
{
    *f = (struct level_files){.folder = k->folder, .record = r, .arena = a};
    list(f, r);
    int scene = find(f, "scene");
    if (scene < 0)
        return err_set(e, ERR_INPUT, "%s: its effective scene is not in the journal", r->name);
    if (!folder_make_for(k->folder, r->name, e) || !read_scene(f, scene, e))
        return false;
    r->gain = sound_known_gain(&f->scene);
    for (int i = 0; i < f->n; i++)
        if (is_scaled(f, i) && !scale(f, i, e))
            return false;
    add_remarks(f, r);
    return put_texts(f, e);
}

/* The raw file stays until the record is noted: who is killed before finds it whole. */
static bool copy_file(const char *from, const char *to, struct err *e)
{
    char piece[1 << 16];
    struct outfile o;
    FILE *in = memory_fopen(from, "rb");
    if (!in)
        return err_set(e, err_system(ERR_INPUT), "%s: %s", from, strerror(errno));
    bool ok = outfile_open(&o, to, e);
    for (size_t n; ok && (n = fread(piece, 1, sizeof piece, in)) > 0;)
        outfile_put(&o, piece, n);
    bool read = !ferror(in);
    fclose(in);
    if (ok && read && outfile_commit(&o, e))
        return true;
    if (ok)
        outfile_drop(&o);
    return e->kind ? false : err_set(e, ERR_IO, "%s: cannot be read", from);
}

static bool commit_one(struct level_files *f, int i, struct err *e)
{
    struct wav_out *w = f->sounds[i];
    char hex[HASH_TEXT];
    f->sounds[i] = NULL;
    if (!w)
        return f->texts[i].target[0] ? outfile_commit(&f->texts[i], e) : copy_file(f->raw[i], f->paths[i], e);
    if (!wav_commit(w, e) || !hash_file(f->paths[i], hex, e))
        return false;
    f->made[i].sha256 = arena_text(f->arena, hex);
    return true;
}

bool level_files_commit(struct level_files *f, struct err *e)
{
    for (int i = 0; i < f->n; i++)
        if (!commit_one(f, i, e))
            return false;
    return true;
}

void level_files_drop(struct level_files *f)
{
    for (int i = 0; i < f->n; i++) {
        if (f->sounds[i])
            wav_drop(f->sounds[i]);
        outfile_drop(&f->texts[i]);
    }
}

void level_files_forget(struct level_files *f)
{
    for (int i = 0; i < f->n; i++)
        unlink(f->raw[i]);
}
