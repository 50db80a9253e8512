/* Two tetrahedra that share a face, volume 1/6 + 1/6 (in the file's units), written in every format, with a node that
 * nothing uses. */
#ifndef TESTS_UNIT_MESH_FILES_H
#define TESTS_UNIT_MESH_FILES_H
#include "file/mesh.h"
#include "folder.h"

enum { FILES_NODES = 6 };
static const int files_tag[FILES_NODES] = {11, 5, 7, 100, 8, 9}; /* 9: not used */
static const double files_at[FILES_NODES][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {7, 7, 7}};
static const int files_element[2][4] = {{11, 5, 7, 100}, {11, 7, 5, 8}};
static const int files_triangle[2][3] = {{11, 5, 100}, {5, 7, 8}}; /* of the physical surfaces 3, "the top", and 4 */

static inline void files_int(FILE *f, int x) { fwrite(&x, 4, 1, f); }

static inline void files_size(FILE *f, uint64_t x) { fwrite(&x, 8, 1, f); }

static inline void files_start(FILE *f, const char *version, bool binary)
{
    fprintf(f, "$MeshFormat\n%s %d 8\n", version, binary);
    if (binary) {
        files_int(f, 1);
        fputc('\n', f);
    }
    fputs("$EndMeshFormat\n$PhysicalNames\n2\n2 3 \"the top\"\n3 7 \"solid\"\n$EndPhysicalNames\n", f);
}

static inline void files_msh2_binary(FILE *f)
{
    fprintf(f, "$Nodes\n%d\n", FILES_NODES);
    for (int i = 0; i < FILES_NODES; i++) {
        files_int(f, files_tag[i]);
        fwrite(files_at[i], 8, 3, f);
    }
    fputs("\n$EndNodes\n$Elements\n4\n", f);
    for (int i = 0; i < 2; i++) { /* each a run of its own */
        const int head[] = {2, 1, 2, 1 + i, 3 + i, 1};
        fwrite(head, 4, 6, f);
        fwrite(files_triangle[i], 4, 3, f);
    }
    const int head[] = {4, 2, 2};
    fwrite(head, 4, 3, f);
    for (int i = 0; i < 2; i++) {
        const int tags[] = {3 + i, 7, 1};
        fwrite(tags, 4, 3, f);
        fwrite(files_element[i], 4, 4, f);
    }
    fputs("\n$EndElements\n", f);
}

static inline void files_msh2(FILE *f, bool binary)
{
    files_start(f, "2.2", binary);
    if (binary) {
        files_msh2_binary(f);
        return;
    }
    fprintf(f, "$Nodes\n%d\n", FILES_NODES);
    for (int i = 0; i < FILES_NODES; i++)
        fprintf(f, "%d %g %g %g\n", files_tag[i], files_at[i][0], files_at[i][1], files_at[i][2]);
    fputs("$EndNodes\n$Elements\n5\n1 15 2 0 1 11\n", f);
    for (int i = 0; i < 2; i++)
        fprintf(f, "%d 2 2 %d 1 %d %d %d\n", 2 + i, 3 + i, files_triangle[i][0], files_triangle[i][1],
                files_triangle[i][2]);
    for (int i = 0; i < 2; i++)
        fprintf(f, "%d 4 2 7 1 %d %d %d %d\n", 4 + i, files_element[i][0], files_element[i][1], files_element[i][2],
                files_element[i][3]);
    fputs("$EndElements\n", f);
}

/* A number of the width that it has in binary. */
static inline void files_put(FILE *f, bool binary, int bytes, int x)
{
    if (!binary)
        fprintf(f, "%d ", x);
    else if (bytes == 8)
        files_size(f, (uint64_t)x);
    else
        files_int(f, x);
}

static inline void files_reals(FILE *f, bool binary, const double *x, int n)
{
    for (int i = 0; i < n; i++)
        if (binary)
            fwrite(&x[i], 8, 1, f);
        else
            fprintf(f, "%.17g ", x[i]);
}

static inline void files_entities(FILE *f, bool binary)
{
    static const double box[6] = {0};
    const int counts[4] = {1, 0, 2, 1};
    for (int i = 0; i < 4; i++)
        files_put(f, binary, 8, counts[i]);
    files_put(f, binary, 4, 1);
    files_reals(f, binary, box, 3);
    files_put(f, binary, 8, 0);
    for (int i = 0; i < 3; i++) { /* surface 21 in group 3, surface 22 in groups 3 and 4; the volume */
        files_put(f, binary, 4, 21 + i);
        files_reals(f, binary, box, 6);
        files_put(f, binary, 8, 1 + (i == 1));
        files_put(f, binary, 4, i < 2 ? 3 : 7);
        if (i == 1) files_put(f, binary, 4, 4);
        files_put(f, binary, 8, 1);
        files_put(f, binary, 4, -1);
    }
}

static inline void files_msh4_nodes(FILE *f, bool binary)
{
    const int head[4] = {2, FILES_NODES, 5, 100}, block[2][3] = {{1, 1, 1}, {3, 1, 0}}; /* the first with a parameter */
    for (int i = 0; i < 4; i++)
        files_put(f, binary, 8, head[i]);
    for (int b = 0, from = 0; b < 2; b++) {
        int n = b ? FILES_NODES - 2 : 2;
        for (int i = 0; i < 3; i++)
            files_put(f, binary, 4, block[b][i]);
        files_put(f, binary, 8, n);
        for (int i = 0; i < n; i++)
            files_put(f, binary, 8, files_tag[from + i]);
        for (int i = 0; i < n; i++) {
            files_reals(f, binary, files_at[from + i], 3);
            files_reals(f, binary, &(double){0.5}, b == 0);
        }
        from += n;
    }
}

static inline void files_msh4_elements(FILE *f, bool binary)
{
    const int head[4] = {3, 4, 1, 4}, block[3][4] = {{2, 21, 2, 1}, {2, 22, 2, 1}, {3, 23, 4, 2}};
    for (int i = 0; i < 4; i++)
        files_put(f, binary, 8, head[i]);
    for (int b = 0; b < 3; b++) {
        for (int i = 0; i < 4; i++)
            files_put(f, binary, i < 3 ? 4 : 8, block[b][i]);
        for (int i = 0; i < block[b][3]; i++) {
            files_put(f, binary, 8, 1 + b + i);
            for (int k = 0; k < (b < 2 ? 3 : 4); k++)
                files_put(f, binary, 8, b < 2 ? files_triangle[b][k] : files_element[i][k]);
        }
    }
}

static inline void files_msh4(FILE *f, bool binary)
{
    files_start(f, "4.1", binary);
    fputs("$Entities\n", f);
    files_entities(f, binary);
    fputs("\n$EndEntities\n$Nodes\n", f);
    files_msh4_nodes(f, binary);
    fputs("\n$EndNodes\n$Elements\n", f);
    files_msh4_elements(f, binary);
    fputs("\n$EndElements\n", f);
}

static inline void files_tetgen(const char *name)
{
    FILE *f = fopen(folder_path(arena_format(folder_arena, "%s.node", name)), "w");
    fprintf(f, "# made by hand\n%d 3 1 1\n", FILES_NODES);
    for (int i = 0; i < FILES_NODES; i++)
        fprintf(f, "  %d  %g %g %g  0.5 0 # remark\n", files_tag[i], files_at[i][0], files_at[i][1], files_at[i][2]);
    fclose(f);
    f = fopen(folder_path(arena_format(folder_arena, "%s.ele", name)), "w");
    fputs("2 4 1\n", f);
    for (int i = 0; i < 2; i++)
        fprintf(f, "%d %d %d %d %d -3.5\n", i, files_element[i][0], files_element[i][1], files_element[i][2],
                files_element[i][3]);
    fclose(f);
    f = fopen(folder_path(arena_format(folder_arena, "%s.face", name)), "w");
    fputs("3 1\n", f);
    for (int i = 0; i < 2; i++)
        fprintf(f, "%d %d %d %d %d\n", i, files_triangle[i][0], files_triangle[i][1], files_triangle[i][2], 3 + i);
    fputs("2 11 5 7 0\n", f);
    fclose(f);
}

enum { FILES_KINDS = 4 };
static inline const char *files_msh(int kind)
{
    static const char *const names[FILES_KINDS] = {"two.msh", "two_binary.msh", "four.msh", "four_binary.msh"};
    FILE *f = fopen(folder_path(names[kind]), "wb");
    (kind < 2 ? files_msh2 : files_msh4)(f, kind % 2);
    fclose(f);
    return folder_path(names[kind]);
}

#endif
