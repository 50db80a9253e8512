/* The mesh readers: indices are nodes, coordinates are finite; and what mesh_check makes of any mesh that is read. A
   Gmsh file as it is; what does not begin with '$' is TetGen's: .node, .ele and .face, separated by lines "=". */
#include <math.h>
#include <string.h>

#include "fem/boundary.h"
#include "fem/mesh_check.h"
#include "fem/topology.h"
#include "file/mesh_formats.h"
#include "fuzz.h"

static char folder[40];
static void remove_folder(void)
{
    static const char *const endings[] = {"node", "ele", "face"};
    char path[96];
    for (int i = 0; i < 3; i++) {
        snprintf(path, sizeof path, "%s/m.%s", folder, endings[i]);
        unlink(path);
    }
    rmdir(folder);
}

static void write_part(const char *ending, const uint8_t *data, size_t n)
{
    char path[96];
    snprintf(path, sizeof path, "%s/m.%s", folder, ending);
    FILE *f = fopen(path, "wb");
    if (!f || (n > 0 && fwrite(data, 1, n, f) != n) || fclose(f) != 0) abort();
}

static bool read_tetgen(const uint8_t *data, size_t size, struct arena *a, struct mesh *m, struct err *e)
{
    static const char *const endings[] = {"node", "ele", "face"};
    char path[96];
    if (!folder[0]) {
        fuzz_make_folder(folder);
        atexit(remove_folder);
    }
    for (int i = 0; i < 3; i++) {
        const uint8_t *stop = size >= 3 ? memmem(data, size, "\n=\n", 3) : NULL;
        size_t n = stop ? (size_t)(stop - data) : size;
        write_part(endings[i], data, n);
        data += stop ? n + 3 : n;
        size -= stop ? n + 3 : n;
    }
    snprintf(path, sizeof path, "%s/m.node", folder);
    return mesh_tetgen_read(path, 1, a, m, e);
}

static void check_mesh(const struct mesh *m)
{
    for (int i = 0; i < m->nodes; i++)
        for (int c = 0; c < 3; c++)
            if (!isfinite(m->at[i][c])) abort();
    for (int i = 0; i < m->elements; i++)
        for (int k = 0; k < 10; k++)
            if (m->linear && k > 3 ? m->element[i][k] != -1 : m->element[i][k] < 0 || m->element[i][k] >= m->nodes)
                abort();
    for (int g = 0; g < m->groups; g++)
        for (int i = 0; i < 3 * m->group[g].n; i++)
            if (m->group[g].corner[i / 3][i % 3] < 0 || m->group[g].corner[i / 3][i % 3] >= m->nodes) abort();
    if (m->elements == 0) abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct arena *a = arena_open();
    struct mesh m = {0};
    struct err e = {0};
    bool ok;
    if (size > 0 && data[0] == '$') {
        char path[128];
        fuzz_put(path, "input", data, size);
        ok = mesh_msh_read(path, 1, a, &m, &e);
    } else
        ok = read_tetgen(data, size, a, &m, &e);
    fuzz_check(ok, &e);
    if (arena_bytes(a) > 1000 * size + 1000000) abort();
    if (ok) {
        check_mesh(&m);
        ok = mesh_check(&m, a, &e);
        fuzz_check(ok, &e);
    }
    if (ok) {
        struct boundary b;
        topology_elevate(&m, a);
        boundary_make(&m, a, &b);
        if (b.n < 4) abort();
    }
    arena_close(a);
    return 0;
}
