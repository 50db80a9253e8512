/* See record.h. */
#include "batch/record.h"

#include <math.h>
#include <string.h>

#include "file/json_value.h"

static json_t *files_json(const struct record *r)
{
    json_t *all = json_array();
    for (int i = 0; i < r->n_files; i++)
        json_array_append_new(all, json_pack("{s:s, s:s, s:s*}", "kind", r->files[i].kind, "path", r->files[i].path, "sha256", r->files[i].sha256));
    return all;
}

static json_t *remarks_json(const struct record *r)
{
    json_t *all = json_array();
    for (int i = 0; r->remarks && r->remarks[i]; i++)
        json_array_append_new(all, json_value_shown(r->remarks[i]));
    return all;
}

static void add_sound(json_t *j, const struct record *r)
{
    json_t *sound = json_pack("{s:o, s:o, s:o, s:o, s:i, s:i, s:o, s:o, s:o, s:o, s:o, s:s*}", "peak", json_value_number(r->peak), "rms", json_value_number(r->rms), "lufs",
                              json_value_number(r->lufs), "rate", json_value_number(r->rate), "channels", r->channels, "encoding", r->encoding, "gain", json_value_number(r->gain), "file_peak",
                              json_value_number(r->file_peak), "file_rms", json_value_number(r->file_rms), "file_lufs", json_value_number(r->file_lufs), "ramp", json_value_number(r->ramp), "audio", r->audio);
    json_object_set_new(sound, "true_peak", json_value_number(r->true_peak));
    json_object_set_new(sound, "beyond", json_value_number(r->beyond));
    if (r->unit)
        json_object_set_new(sound, "unit", json_string(r->unit));
    if (r->loud)
        json_object_set_new(sound, "loud", json_true());
    json_object_set_new(j, "sound", sound);
}

char *record_text(const struct record *r, bool times)
{
    json_t *j = json_pack("{s:s, s:s, s:s*, s:s, s:s*, s:o, s:I, s:o, s:o}", "name", r->name, "key", r->key, "job", r->job, "build", r->build, "place", r->place, "full_scale",
                          json_value_number(r->full_scale), "frames", (json_int_t)r->frames, "files", files_json(r), "remarks", remarks_json(r));
    if (!j)
        return NULL;
    if (r->sounds)
        add_sound(j, r);
    if (times) {
        json_object_set_new(j, "wall", json_value_number(r->wall));
        json_object_set_new(j, "cpu", json_value_number(r->cpu));
    }
    char *text = json_dumps(j, JSON_COMPACT | JSON_REAL_PRECISION(17) | JSON_ENSURE_ASCII);
    json_decref(j);
    return text;
}

/* ------------------------------------------------------------------ reading */

static bool files_of(const json_t *list, struct arena *a, struct record *r)
{
    bool ok = true;
    r->n_files = (int)json_array_size(list);
    r->files = ARENA_TAKE(a, struct record_file, r->n_files);
    for (int i = 0; i < r->n_files; i++) {
        const json_t *f = json_array_get(list, (size_t)i);
        r->files[i] = (struct record_file){json_value_text_of(f, "kind", a), json_value_text_of(f, "path", a), json_value_text_of(f, "sha256", a)};
        ok = ok && r->files[i].kind && r->files[i].path;
    }
    return ok;
}

static void remarks_of(const json_t *list, struct arena *a, struct record *r)
{
    size_t n = json_array_size(list);
    r->remarks = ARENA_TAKE(a, const char *, n + 1);
    for (size_t i = 0; i < n; i++) {
        const char *s = json_string_value(json_array_get(list, i));
        r->remarks[i] = arena_text(a, s ? s : "");
    }
}

static void sound_of(const json_t *j, struct arena *a, struct record *r)
{
    r->sounds = j != NULL;
    r->peak = json_value_number_of(j, "peak"), r->rms = json_value_number_of(j, "rms"), r->lufs = json_value_number_of(j, "lufs");
    r->rate = json_value_number_of(j, "rate"), r->gain = json_value_number_of(j, "gain"), r->ramp = json_value_number_of(j, "ramp");
    r->channels = (int)json_integer_value(json_object_get(j, "channels"));
    r->encoding = (int)json_integer_value(json_object_get(j, "encoding"));
    r->file_peak = json_value_number_of(j, "file_peak"), r->file_rms = json_value_number_of(j, "file_rms"), r->file_lufs = json_value_number_of(j, "file_lufs");
    r->loud = json_is_true(json_object_get(j, "loud"));
    r->audio = json_value_text_of(j, "audio", a);
    r->unit = json_value_text_of(j, "unit", a);
    r->true_peak = json_value_number_of(j, "true_peak");
    r->beyond = json_value_number_of(j, "beyond");
}

bool record_read(const char *line, size_t n, struct arena *a, struct record *r)
{
    json_error_t fault;
    json_t *j = json_loadb(line, n, 0, &fault);
    *r = (struct record){.name = json_value_text_of(j, "name", a), .key = json_value_text_of(j, "key", a), .job = json_value_text_of(j, "job", a), .build = json_value_text_of(j, "build", a), .place = json_value_text_of(j, "place", a),
                         .full_scale = json_value_number_of(j, "full_scale"), .frames = (long)json_integer_value(json_object_get(j, "frames")),
                         .wall = json_value_number_of(j, "wall"), .cpu = json_value_number_of(j, "cpu")};
    bool ok = j && files_of(json_object_get(j, "files"), a, r) && r->name && r->key && r->build;
    remarks_of(json_object_get(j, "remarks"), a, r);
    sound_of(json_object_get(j, "sound"), a, r);
    json_decref(j);
    return ok;
}
