/* What `rasp batch` leaves for itself, and the summary that `rasp plot` reads: NAME.json as a record, and as a summary.
 */
#include "batch/record.h"
#include "cmd/plot.h"
#include "fuzz.h"

/* What is read is read again from what is written of it, and leads nowhere but to files of the stimulus. */
static void as_record(const char *text, size_t n)
{
    struct arena *a = arena_open();
    struct record r = {0}, again = {0};
    if (record_parse(text, n, "a/b", a, &r)) {
        const char *written = record_text(&r, a);
        if (!record_parse(written, strlen(written), "a/b", a, &again) || strcmp(r.key, again.key) != 0 ||
            r.n_files != again.n_files || r.status != again.status)
            abort();
        for (int i = 0; i < r.n_files; i++)
            if (strcmp(r.files[i].path, again.files[i].path) != 0 ||
                strncmp(r.files[i].path, r.files[i].raw ? ".rasp/raw/a/b." : "a/b.", r.files[i].raw ? 14 : 4) != 0)
                abort();
        if (strcmp(written, record_text(&again, a)) != 0) abort();
    }
    arena_close(a);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[128];
    fuzz_put(path, "input", data, size);
    struct arena *a = arena_open();
    as_record((const char *)data, size);
    plot_summary_read(path, a);
    arena_close(a);
    return 0;
}
