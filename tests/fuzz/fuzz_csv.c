/* The readers of tables, CSV and NPY; every cell is then read as a number. */
#include "file/csv.h"
#include "fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[128];
    fuzz_put(path, "input", data, size);
    struct arena *a = arena_open();
    struct csv t = {0};
    struct err e = {0};
    bool ok = csv_table_read(path, a, &t, &e);
    fuzz_check(ok, &e);
    for (size_t i = 0; ok && i < t.rows * t.columns; i++) {
        struct err not_a_number = {0};
        double x;
        fuzz_check(csv_number(&t, i / t.columns, (int)(i % t.columns), &x, &not_a_number), &not_a_number);
    }
    arena_close(a);
    return 0;
}
