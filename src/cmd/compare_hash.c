/* rasp compare FILE --hash SHA256: one sound or table against a hash that was kept. */
#include <jansson.h>
#include <stdio.h>
#include <string.h>

#include "analysis/distance.h"
#include "base/hash.h"
#include "cmd/compare.h"
#include "file/table.h"

/* What cannot be compared with a file has no hash to compare either: a table without rows, a sound without samples. */
static bool file_hash(const struct compare_ask *ask, bool sound, char hex[HASH_TEXT], struct err *e)
{
    const char *file = ask->files[0];
    struct wav w;
    struct csv t;
    if (sound) {
        if (!wav_read(file, ask->arena, &w, e))
            return false;
        distance_hash(&w, hex);
        return true;
    }
    if (!table_read(file, ask->arena, &t, e))
        return false;
    if (t.rows == 0)
        return err_set(e, ERR_SCENE, "%s: has no rows: nothing would be compared", file);
    return hash_file(file, hex, e);
}

static bool print_json(const struct compare_ask *ask, const char *key, const char *hex, struct err *e)
{
    json_t *name = json_string(ask->files[0]); /* NULL: not UTF-8 */
    json_t *j = json_pack("{s:b, s:o, s:s, s:s}",
                          "held", strcmp(hex, ask->hash) == 0,
                          "file", name ? name : json_null(),
                          key, hex,
                          "expected", ask->hash);
    bool ok = j && json_dumpf(j, ask->out, JSON_INDENT(2)) == 0;
    fputc('\n', ask->out);
    json_decref(j);
    return ok || err_set(e, ERR_IO, "the report cannot be written as JSON");
}

int compare_hash(const struct compare_ask *ask, bool sound, struct err *e)
{
    char hex[HASH_TEXT];
    if (!file_hash(ask, sound, hex, e))
        return (int)e->kind;
    bool held = strcmp(hex, ask->hash) == 0;
    if (ask->quiet && held)
        return 0;
    if (ask->json && !print_json(ask, sound ? "audio_sha256" : "file_sha256", hex, e))
        return (int)e->kind;
    if (!ask->json)
        fprintf(ask->out, "%s\n%s sha256: %s%s%s\n", ask->files[0], held ? "ok  " : "FAIL", hex, held ? "" : ", where the hash given is ", held ? "" : ask->hash);
    return held ? 0 : ERR_DIFFERS;
}
