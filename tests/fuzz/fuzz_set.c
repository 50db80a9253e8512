/* What `rasp batch` leaves for itself and for `rasp merge`, and the summary that `rasp plot` reads, all JSON: set.json, a line of a journal, NAME.json. */
#include "batch/record.h"
#include "batch/set_file.h"
#include "cmd/plot_summary.h"
#include "fuzz.h"

static void as_set(const char *path)
{
    struct arena *a = arena_open();
    struct set s = {0};
    struct err e = {0};
    bool ok = set_file_load(path, a, &s, &e);
    fuzz_check(ok, &e);
    for (int i = 0; ok && i < s.n; i++)
        for (int k = 0; k < s.n_factors; k++)
            if (!s.rows[i].name || !s.rows[i].values[k])
                abort();
    if (ok && !set_level_text(&s, a))
        abort();
    arena_close(a);
}

/* What is read is read again from what is written of it. */
static void as_record(const char *line, size_t n)
{
    struct arena *a = arena_open();
    struct record r = {0}, again = {0};
    if (record_read(line, n, a, &r)) {
        char *text = record_text(&r, true);
        if (!text || !record_read(text, strlen(text), a, &again) || strcmp(r.name, again.name) != 0 || r.n_files != again.n_files)
            abort();
        free(text);
    }
    arena_close(a);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct fuzz_file f = fuzz_open(data, size);
    struct arena *a = arena_open();
    as_set(f.path);
    as_record((const char *)data, size);
    plot_summary_read(f.path, a);
    arena_close(a);
    close(f.fd);
    return 0;
}
