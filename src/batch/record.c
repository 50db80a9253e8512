/* See record.h. */
#include "batch/record.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/outfile.h"
#include "file/bytes.h"
#include "file/json_value.h"
#include "scene/scene.h"

static const char *const statuses[] = {[RECORD_MAKING] = "making", [RECORD_WAITS] = "waits", [RECORD_DONE] = "done"};
static const char before_hash[] = ",\n  \"record\": \"", after_hash[] = "\"\n}\n";

enum { TAIL = sizeof before_hash - 1 + HASH_TEXT - 1 + sizeof after_hash - 1 };

/* The numbers of the sound by their names in the record. */
static const struct {
    const char *name;
    size_t offset;
} numbers[] = {{"peak", offsetof(struct record, peak)},           {"rms", offsetof(struct record, rms)},
               {"lufs", offsetof(struct record, lufs)},           {"gain", offsetof(struct record, gain)},
               {"file_peak", offsetof(struct record, file_peak)}, {"file_rms", offsetof(struct record, file_rms)},
               {"file_lufs", offsetof(struct record, file_lufs)}, {"true_peak", offsetof(struct record, true_peak)},
               {"beyond", offsetof(struct record, beyond)},       {"ramp_s", offsetof(struct record, ramp)}};

static double *number(const struct record *r, size_t k) { return (double *)((char *)r + numbers[k].offset); }

const char *record_path(const char *folder, const char *name, struct arena *a)
{
    return arena_format(a, "%s/%s.json", folder, name);
}

const char *record_file_path(const char *name, const char *file, bool raw, struct arena *a)
{
    return arena_format(a, "%s%.*s%s", raw ? ".rasp/raw/" : "", (int)(basename(name) - name), name, file);
}

/* ------------------------------------------------------------------ writing */

/* What the render's list says of the file, or a new entry. */
static json_t *file_json(const json_t *listed, const struct record_file *f)
{
    const char *name = basename(f->path);
    json_t *j = NULL, *file;
    size_t i;
    json_array_foreach(listed, i, file)
    {
        const char *other = json_string_value(json_object_get(file, "name"));
        if (!j && other && !strcmp(other, name)) j = json_copy(file);
    }
    j = j ? j : json_pack("{s:s, s:s}", "kind", f->kind, "name", name);
    json_object_set_new(j, "sha256", json_value_text(f->sha256));
    json_object_set_new(j, "size", json_integer((json_int_t)f->size));
    if (f->raw)
        json_object_set_new(j, "raw", json_true());
    else
        json_object_del(j, "raw");
    return j;
}

const char *record_text(const struct record *r, struct arena *a)
{
    json_t *render = r->render ? json_loads(r->render, 0, NULL) : NULL, *files = json_array(), *warnings = json_array();
    for (int i = 0; i < r->n_files; i++)
        json_array_append_new(files, file_json(json_object_get(render, "files"), &r->files[i]));
    for (int i = 0; r->warnings && r->warnings[i]; i++)
        json_array_append_new(warnings, json_value_shown(r->warnings[i]));
    json_t *measured = json_value_object("rate_hz:n frames:l", r->rate, r->frames);
    for (size_t k = 0; r->sounds && k < sizeof numbers / sizeof *numbers; k++)
        json_object_set_new(measured, numbers[k].name, json_value_number(*number(r, k)));
    if (r->sounds)
        json_value_set(measured, "channels:i encoding:i unit:s audio_sha256:s", r->channels, r->encoding, r->unit,
                       r->audio);
    json_t *j =
        json_pack("{s:i, s:s, s:s, s:s, s:o, s:o, s:o, s:o, s:o}", "set", 2, "status", statuses[r->status], "key",
                  r->key, "program", r->program, "seen_from", json_value_text(r->seen_from), "full_scale",
                  json_value_number(r->full_scale), "measured", measured, "warnings", warnings, "files", files);
    if (render) json_object_update_missing(j, render);
    json_object_del(j, "record");
    json_decref(render);
    char hex[HASH_TEXT], *text = json_dumps(j, JSON_INDENT(2) | JSON_REAL_PRECISION(17) | JSON_ENSURE_ASCII);
    size_t n = text ? strlen(text) - 2 : 0; /* without its line end and bracket */
    hash_bytes(text, n, hex);
    const char *whole = arena_format(a, "%.*s%s%s%s", (int)n, text ? text : "", before_hash, hex, after_hash);
    free(text);
    json_decref(j);
    return whole;
}

bool record_write(const char *folder, const char *name, const struct record *r, struct err *e)
{
    struct arena *a = arena_open();
    struct outfile f;
    const char *text = record_text(r, a);
    bool ok = outfile_open(&f, record_path(folder, name, a), e);
    if (ok) {
        outfile_put(&f, text, strlen(text));
        ok = outfile_commit(&f, e);
    }
    arena_close(a);
    return ok;
}

/* ------------------------------------------------------------------ reading */

static bool parse_files(const json_t *list, const char *name, struct arena *a, struct record *r)
{
    json_t *file;
    const char *base = basename(name);
    size_t i, n = strlen(base);
    r->files = ARENA_TAKE(a, struct record_file, json_array_size(list) + 1);
    json_array_foreach(list, i, file)
    {
        const char *own = json_value_text_of(file, "name", a);
        struct record_file *f = &r->files[r->n_files++];
        *f = (struct record_file){.kind = json_value_text_of(file, "kind", a),
                                  .raw = json_is_true(json_object_get(file, "raw")),
                                  .sha256 = json_value_text_of(file, "sha256", a),
                                  .size = (double)json_integer_value(json_object_get(file, "size"))};
        /* called NAME.something: a record that says otherwise leads nowhere */
        if (!f->kind || !f->sha256 || !own || strchr(own, '/') || strncmp(own, base, n) != 0 || own[n] != '.' ||
            !strcmp(own + n, ".json"))
            return false;
        f->path = record_file_path(name, own, f->raw, a);
    }
    return json_is_array(list);
}

bool record_parse(const char *text, size_t n, const char *name, struct arena *a, struct record *r)
{
    json_t *j = json_loadb(text, n, 0, NULL);
    const char *status = json_string_value(json_object_get(j, "status"));
    *r = (struct record){.key = json_value_text_of(j, "key", a),
                         .program = json_value_text_of(j, "program", a),
                         .seen_from = json_value_text_of(j, "seen_from", a),
                         .full_scale = json_value_number_of(j, "full_scale")};
    bool ok = j && json_integer_value(json_object_get(j, "set")) == 2 && status && r->key && r->program &&
              parse_files(json_object_get(j, "files"), name, a, r);
    for (r->status = RECORD_DONE; ok && r->status > RECORD_MAKING && strcmp(status, statuses[r->status]) != 0;
         r->status--)
        ;
    const json_t *measured = json_object_get(j, "measured");
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++)
        *number(r, k) = json_value_number_of(measured, numbers[k].name);
    r->rate = json_value_number_of(measured, "rate_hz");
    r->frames = (long)json_integer_value(json_object_get(measured, "frames"));
    r->channels = (int)json_integer_value(json_object_get(measured, "channels"));
    r->encoding = (int)json_integer_value(json_object_get(measured, "encoding"));
    r->sounds = r->channels > 0;
    r->unit = json_value_text_of(measured, "unit", a);
    r->audio = json_value_text_of(measured, "audio_sha256", a);
    const json_t *warnings = json_object_get(j, "warnings");
    r->warnings = ARENA_TAKE(a, const char *, json_array_size(warnings) + 1);
    for (size_t i = 0; i < json_array_size(warnings); i++) {
        const char *warning = json_string_value(json_array_get(warnings, i));
        r->warnings[i] = arena_text(a, warning ? warning : "");
    }
    ok = ok && r->encoding >= 0 && r->encoding <= ENCODING_FLAC24;
    json_decref(j);
    r->render = ok ? arena_format(a, "%.*s", (int)n, text) : NULL;
    return ok;
}

bool record_read(const char *folder, const char *name, struct arena *a, struct record *r)
{
    char hex[HASH_TEXT];
    struct bytes b;
    if (!bytes_read(record_path(folder, name, a), a, &b, &(struct err){0}) || b.n < TAIL) return false;
    const char *tail = b.at + b.n - TAIL, *end = b.at + b.n - (sizeof after_hash - 1);
    hash_bytes(b.at, b.n - TAIL, hex);
    return !memcmp(tail, before_hash, sizeof before_hash - 1) && !memcmp(end, after_hash, sizeof after_hash - 1) &&
           !memcmp(tail + sizeof before_hash - 1, hex, HASH_TEXT - 1) && record_parse(b.at, b.n, name, a, r);
}
