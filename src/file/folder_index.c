/* See folder_index.h. */
#include "file/folder_index.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "file/csv.h"

static int by_name(const void *a, const void *b) { return strcmp(*(const char *const *)a, *(const char *const *)b); }

const char **folder_index_files(const char *folder, int *n, struct arena *a)
{
    const char *index = arena_format(a, "%s/index.csv", folder);
    struct csv t;
    struct err unreadable = {0};
    *n = 0;
    if (access(index, F_OK) != 0) return NULL;
    int column = csv_read_file(index, a, &t, &unreadable) && t.cells ? csv_column(&t, "file_name") : -1;
    size_t rows = column >= 0 ? t.rows : 0;
    const char **files = ARENA_TAKE(a, const char *, rows + 1);
    files[(*n)++] = index;
    for (size_t i = 0; i < rows; i++)
        files[(*n)++] = arena_format(a, "%s/%s", folder, t.cells[i * t.columns + (size_t)column]);
    qsort(files, (size_t)*n, sizeof *files, by_name);
    return files;
}
