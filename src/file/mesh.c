/* See mesh.h. */
#include "file/mesh.h"

#include <errno.h>
#include <inttypes.h>
#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/text.h"
#include "file/bytes.h"
#include "file/mesh_formats.h"

enum { SHOWN = 24 }; /* characters of a wrong word that a message repeats */

bool mesh_source_open(struct mesh_source *s, const char *path, struct arena *a, struct err *e)
{
    struct bytes b;
    if (!bytes_read(path, a, &b, e)) return false;
    *s = (struct mesh_source){.path = path, .start = b.at, .at = b.at, .end = b.at + b.n, .line = 1, .e = e};
    return true;
}

bool mesh_source_bad(const struct mesh_source *s, const char *format, ...)
{
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (s->binary) return err_set(s->e, ERR_SCENE, "%s: byte %td: %s", s->path, s->at - s->start, text);
    return err_set(s->e, ERR_SCENE, "%s:%d: %s", s->path, s->line, text);
}

/* To the next word; with `within`, no further than the end of the line. */
static void skip_blanks(struct mesh_source *s, bool within)
{
    for (; s->at < s->end; s->at++) {
        if (s->remarks && *s->at == '#') s->at += strcspn(s->at, "\n");
        if (s->at >= s->end || !strchr(" \t\r\n", *s->at) || *s->at == '\0' || (within && *s->at == '\n')) return;
        s->line += *s->at == '\n';
    }
}

/* Length of the word there; 0, and an error: the file ends. */
static size_t word(struct mesh_source *s, const char *what)
{
    skip_blanks(s, false);
    if (s->at >= s->end)
        return (size_t)mesh_source_bad(
            s, "the file ends where %s should stand; it was cut off, or its counts are wrong", what);
    size_t n = strcspn(s->at, " \t\r\n");
    return n > 0 ? n : 1;
}

static bool take(struct mesh_source *s, size_t n, unsigned char *to, const char *what)
{
    if ((size_t)(s->end - s->at) < n)
        return mesh_source_bad(s, "the file ends where %s should stand; it was cut off, or its counts are wrong", what);
    memcpy(to, s->at, n);
    s->at += n;
    return true;
}

bool mesh_source_whole(struct mesh_source *s, int bytes, int64_t *v, const char *what)
{
    unsigned char b[8];
    if (s->binary) {
        if (!take(s, (size_t)bytes, b, what)) return false;
        *v = bytes == 4 ? (int32_t)(uint32_t)bytes_word(b, 4) : (int64_t)bytes_word(b, 8);
        return true;
    }
    size_t n = word(s, what), sign = n > 0 && (*s->at == '-' || *s->at == '+'),
           digits = n > 0 ? strspn(s->at + sign, "0123456789") : 0;
    if (n == 0) return false;
    errno = 0;
    *v = digits > 0 && sign + digits == n ? strtoll(s->at, NULL, 10) : 0;
    if (digits == 0 || sign + digits != n || errno != 0)
        return mesh_source_bad(s, "%s is '%.*s', not a whole number%s", what, (int)(n < SHOWN ? n : SHOWN), s->at,
                               errno ? " below 2^63" : "");
    s->at += n;
    return true;
}

bool mesh_source_real(struct mesh_source *s, double *v, const char *what)
{
    if (s->binary) {
        unsigned char b[8];
        if (!take(s, 8, b, what)) return false;
        *v = bytes_f64(b);
    } else {
        size_t n = word(s, what);
        if (n == 0) return false;
        *v = strtod(s->at, NULL);
        if (text_number_length(s->at) != n) *v = NAN;
        if (!isfinite(*v))
            return mesh_source_bad(s, "%s is '%.*s', not a finite number", what, (int)(n < SHOWN ? n : SHOWN), s->at);
        s->at += n;
    }
    return isfinite(*v) || mesh_source_bad(s, "%s is %g, not a finite number", what, *v);
}

bool mesh_source_count(struct mesh_source *s, int bytes, size_t least, size_t *n, const char *what)
{
    int64_t v;
    if (!mesh_source_whole(s, bytes, &v, what)) return false;
    size_t left = (size_t)(s->end - s->at);
    if (v < 0 || (uint64_t)v > (left + 1) / least)
        return mesh_source_bad(
            s,
            "%s is %" PRId64 ", and the %zu bytes that follow cannot hold so many; the file was cut off, or is damaged",
            what, v, left);
    *n = (size_t)v;
    return true;
}

bool mesh_source_on_line(struct mesh_source *s)
{
    skip_blanks(s, true);
    return s->at < s->end && *s->at != '\n';
}

void mesh_source_next_line(struct mesh_source *s)
{
    const char *stop = memchr(s->at, '\n', (size_t)(s->end - s->at));
    s->at = stop ? stop + 1 : s->end;
    s->line++;
}

bool mesh_source_find(struct mesh_source *s, const char *name)
{
    size_t n = strlen(name);
    const char *p = s->at;
    while ((p = memchr(p, '$', (size_t)(s->end - p))) != NULL) {
        if ((size_t)(s->end - p) > n && !memcmp(p + 1, name, n) && strchr(" \t\r\n", p[1 + n])) break;
        p++;
    }
    if (!p) return false;
    for (; s->at < p; s->at++)
        s->line += *s->at == '\n';
    s->at += 1 + n;
    return true;
}

void mesh_raw_expect(struct mesh_raw *r, size_t nodes)
{
    if (r->nodes + nodes < r->node_room) return;
    r->node_room = 2 * (r->nodes + nodes) + 1;
    struct mesh_raw_node *more = ARENA_TAKE(r->arena, struct mesh_raw_node, r->node_room);
    if (r->nodes > 0) memcpy(more, r->node, r->nodes * sizeof *more);
    r->node = more;
}

static int by_tag(const void *p, const void *q)
{
    const struct mesh_raw_node *a = p, *b = q;
    return (a->tag > b->tag) - (a->tag < b->tag);
}

bool mesh_raw_sort(struct mesh_raw *r, const struct mesh_source *s)
{
    if (r->nodes == 0) return mesh_source_bad(s, "there are no nodes before the elements");
    if (r->nodes > INT_MAX / 16)
        return mesh_source_bad(s, "%zu nodes are more than a mesh may have here; make it coarser", r->nodes);
    qsort(r->node, r->nodes, sizeof *r->node, by_tag);
    for (size_t i = 1; i < r->nodes; i++)
        if (r->node[i].tag == r->node[i - 1].tag)
            return mesh_source_bad(s, "node %" PRId64 " is defined twice", r->node[i].tag);
    return true;
}

int mesh_raw_find(const struct mesh_raw *r, int64_t tag, const struct mesh_source *s)
{
    size_t low = 0, high = r->nodes;
    int64_t first = r->node[0].tag, last = r->node[r->nodes - 1].tag;
    if (tag >= first && tag <= last && (uint64_t)last - (uint64_t)first == r->nodes - 1) return (int)(tag - first);
    while (low < high) {
        size_t mid = (low + high) / 2;
        if (r->node[mid].tag < tag)
            low = mid + 1;
        else
            high = mid;
    }
    if (low < r->nodes && r->node[low].tag == tag) return (int)low;
    mesh_source_bad(
        s, "an element has node %" PRId64 ", and no such node is defined (they go from %" PRId64 " to %" PRId64 ")",
        tag, first, last);
    return -1;
}

bool mesh_raw_element(struct mesh_raw *r, int corners, const int node[10], const struct mesh_source *s)
{
    if (r->corners != 0 && r->corners != corners)
        return mesh_source_bad(s, "tetrahedra of 4 and of 10 nodes in one file; make all of one order (gmsh -order 2)");
    if (r->elements >= INT_MAX / 16)
        return mesh_source_bad(s, "more elements than a mesh may have here; make it coarser");
    r->corners = corners;
    r->element = arena_more(r->arena, r->element, (int)r->elements, sizeof *r->element);
    for (int i = 0; i < 10; i++)
        r->element[r->elements][i] = i < corners ? node[i] : -1;
    r->elements++;
    return true;
}

void mesh_raw_face(struct mesh_raw *r, int64_t group, const int corner[3])
{
    r->face = arena_more(r->arena, r->face, (int)r->faces, sizeof *r->face);
    r->face[r->faces].group = group;
    memcpy(r->face[r->faces++].corner, corner, 3 * sizeof *corner);
}

static int by_group(const void *p, const void *q)
{
    const struct mesh_raw_face *a = p, *b = q;
    if (a->group != b->group) return a->group < b->group ? -1 : 1;
    for (int i = 0; i < 3; i++)
        if (a->corner[i] != b->corner[i]) return a->corner[i] < b->corner[i] ? -1 : 1;
    return 0;
}

/* Faces of nodes that no element uses are left out with those. */
static void make_groups(struct mesh_raw *r, const int *number, const struct mesh_raw_names *names, struct mesh *m)
{
    size_t n = 0, groups = 0;
    for (size_t i = 0; i < r->faces; i++) {
        const int *c = r->face[i].corner;
        if (number[c[0]] >= 0 && number[c[1]] >= 0 && number[c[2]] >= 0) r->face[n++] = r->face[i];
    }
    if (n == 0) return;
    qsort(r->face, n, sizeof *r->face, by_group);
    for (size_t i = 0; i < n; i++)
        groups += i == 0 || r->face[i].group != r->face[i - 1].group;
    m->group = ARENA_TAKE(r->arena, struct mesh_group, groups);
    for (size_t i = 0, end; i < n; i = end) {
        struct mesh_group *g = &m->group[m->groups++];
        for (end = i; end < n && r->face[end].group == r->face[i].group;)
            end++;
        g->name = names ? names->name(names->self, r->face[i].group) : NULL;
        g->name = g->name ? g->name : arena_format(r->arena, "%" PRId64, r->face[i].group);
        g->corner = arena_take(r->arena, end - i, sizeof *g->corner);
        for (size_t k = i; k < end; k++, g->n++)
            for (int c = 0; c < 3; c++)
                g->corner[g->n][c] = number[r->face[k].corner[c]];
    }
}

bool mesh_raw_finish(struct mesh_raw *r, const char *path, double unit, const struct mesh_raw_names *names,
                     struct mesh *m, struct err *e)
{
    if (r->elements == 0 && r->triangles > 0)
        return err_set(e, ERR_SCENE,
                       "%s: no tetrahedra, only %zu triangles: this is a surface; fill the solid inside it with "
                       "elements (gmsh -3, tetgen -pq); where there is a Physical Surface, gmsh saves no elements but "
                       "those of physical groups: give a Physical Volume too",
                       path, r->triangles);
    if (r->elements == 0)
        return err_set(e, ERR_SCENE, "%s: no tetrahedra; fill the solid with elements (gmsh -3, tetgen -pq)", path);
    *m = (struct mesh){.name = arena_text(r->arena, path), .elements = (int)r->elements, .linear = r->corners == 4};
    int *number = ARENA_TAKE(r->arena, int, r->nodes); /* of the nodes that are used, -1: not */
    for (size_t i = 0; i < r->elements; i++)
        for (int k = 0; k < r->corners; k++)
            number[r->element[i][k]] = 1;
    for (size_t i = 0; i < r->nodes; i++)
        number[i] = number[i] ? m->nodes++ : -1;
    m->at = arena_take(r->arena, (size_t)m->nodes, sizeof *m->at);
    for (size_t i = 0; i < r->nodes; i++)
        for (int c = 0; c < 3 && number[i] >= 0; c++) {
            double x = m->at[number[i]][c] = r->node[i].at[c] * unit;
            if (!isfinite(x))
                return err_set(e, ERR_SCENE, "%s: a coordinate of node %" PRId64 " is %g units of %g m, too large",
                               path, r->node[i].tag, r->node[i].at[c], unit);
        }
    for (size_t i = 0; i < r->elements; i++)
        for (int k = 0; k < r->corners; k++)
            r->element[i][k] = number[r->element[i][k]];
    m->element = r->element;
    make_groups(r, number, names, m);
    return true;
}

/* TetGen's files (TetGen manual 1.5, section 5.2); '#' begins a remark, nodes count from 0 or 1.

     NAME.node  nodes, dimension (3), attributes, markers (0, 1); per node: number, x y z, attributes, marker
     NAME.ele   elements, nodes of each (4, 10), attributes (0, 1); per element: number, nodes, attributes
     NAME.face  faces, markers (0, 1); per face: number, 3 nodes (of quadratic meshes 3 more), marker; 0: no group

   The ten nodes are the corners, then midsides of 23 03 01 12 13 02 (as tetgen 1.5 -o2 writes them). */

static bool open_part(struct mesh_source *s, const char *path, const char *ending, struct arena *a, struct err *e)
{
    size_t n = strlen(path), k = strlen(strrchr(path, '.'));
    if (!mesh_source_open(s, arena_format(a, "%.*s%s", (int)(n - k), path, ending), a, e))
        return err_at(e, "TetGen's .node and .ele belong together");
    s->remarks = true;
    return true;
}

/* The first line: a count, then up to three numbers that may be missing. */
static bool read_header(struct mesh_source *s, size_t least, const char *what, size_t *n, int64_t more[3])
{
    if (!mesh_source_count(s, 4, least, n, what)) return false;
    for (int i = 0; i < 3 && mesh_source_on_line(s); i++)
        if (!mesh_source_whole(s, 4, &more[i], "a number of the first line")) return false;
    return true;
}

static bool read_nodes(struct mesh_raw *r, struct mesh_source *s)
{
    size_t n;
    int64_t more[3] = {3, 0, 0};
    double skipped;
    if (!read_header(s, 8, "the number of nodes", &n, more)) return false;
    if (more[0] != 3 || more[1] < 0 || more[1] > 1000 || more[2] < 0 || more[2] > 1)
        return mesh_source_bad(s,
                               "nodes of dimension %" PRId64 " with %" PRId64 " attributes and %" PRId64
                               " markers; nodes have dimension 3, and 0 or 1 markers",
                               more[0], more[1], more[2]);
    mesh_raw_expect(r, n);
    for (size_t i = 0; i < n; i++) {
        struct mesh_raw_node *to = &r->node[r->nodes++];
        if (!mesh_source_whole(s, 4, &to->tag, "the number of a node")) return false;
        for (int c = 0; c < 3; c++)
            if (!mesh_source_real(s, &to->at[c], "a coordinate of a node")) return false;
        for (int64_t k = 0; k < more[1] + more[2]; k++)
            if (!mesh_source_real(s, &skipped, "an attribute of a node")) return false;
    }
    return mesh_raw_sort(r, s);
}

static bool read_elements(struct mesh_raw *r, struct mesh_source *s)
{
    static const int place[10] = {0, 1, 2, 3, 9, 7, 4, 5, 8, 6};
    size_t n;
    int64_t more[3] = {4, 0, 0}, tag;
    double skipped;
    if (!read_header(s, 10, "the number of elements", &n, more)) return false;
    if ((more[0] != 4 && more[0] != 10) || more[1] < 0 || more[1] > 1000)
        return mesh_source_bad(
            s, "elements of %" PRId64 " nodes with %" PRId64 " attributes; tetrahedra have 4 or 10 nodes", more[0],
            more[1]);
    for (size_t i = 0; i < n; i++) {
        int node[10] = {0};
        if (!mesh_source_whole(s, 4, &tag, "the number of an element")) return false;
        for (int k = 0; k < more[0]; k++)
            if (!mesh_source_whole(s, 4, &tag, "a node of an element") ||
                (node[place[k]] = mesh_raw_find(r, tag, s)) < 0)
                return false;
        for (int64_t k = 0; k < more[1]; k++)
            if (!mesh_source_real(s, &skipped, "an attribute of an element")) return false;
        if (!mesh_raw_element(r, (int)more[0], node, s)) return false;
    }
    return true;
}

/* One a line: number, 3 or 6 nodes, marker. */
static bool read_faces(struct mesh_raw *r, struct mesh_source *s)
{
    size_t n;
    int64_t more[3] = {0, 0, 0}, v[8];
    if (!read_header(s, 8, "the number of faces", &n, more)) return false;
    if (more[0] < 0 || more[0] > 1)
        return mesh_source_bad(s, "faces with %" PRId64 " markers; they have 0 or 1", more[0]);
    bool marked = more[0] == 1;
    for (size_t i = 0; i < n; i++) {
        int k = 1, corner[3];
        if (!mesh_source_whole(s, 4, &v[0], "the number of a face")) return false;
        for (; k < 8 && mesh_source_on_line(s); k++)
            if (!mesh_source_whole(s, 4, &v[k], "a node of a face")) return false;
        if (k != 4 + marked && k != 7 + marked)
            return mesh_source_bad(s, "a face of %d numbers; they are its number, 3 or 6 nodes%s", k,
                                   marked ? ", and a marker" : "");
        for (int c = 0; c < 3; c++)
            if ((corner[c] = mesh_raw_find(r, v[1 + c], s)) < 0) return false;
        if (marked && v[k - 1] != 0) mesh_raw_face(r, v[k - 1], corner);
    }
    return true;
}

bool mesh_tetgen_read(const char *path, double unit, struct arena *a, struct mesh *m, struct err *e)
{
    struct mesh_raw r = {.arena = a};
    struct mesh_source nodes, elements, faces;
    size_t name = strlen(path) - strlen(strrchr(path, '.'));
    const char *face = arena_format(a, "%.*s.face", (int)name, path);
    if (!open_part(&nodes, path, ".node", a, e) || !open_part(&elements, path, ".ele", a, e) ||
        !read_nodes(&r, &nodes) || !read_elements(&r, &elements))
        return false;
    if (access(face, F_OK) == 0 && (!open_part(&faces, path, ".face", a, e) || !read_faces(&r, &faces))) return false;
    return mesh_raw_finish(&r, path, unit, NULL, m, e);
}

void mesh_note(struct mesh *m, struct arena *a, const char *text) { m->note = arena_line(a, m->note, text); }

bool mesh_read(const char *path, double unit, struct arena *a, struct mesh *m, struct err *e)
{
    if (!(unit > 0) || !isfinite(unit))
        return err_set(e, ERR_USAGE, "%s: its unit is %g m, and must be above 0", path, unit);
    if (text_ends(path, ".msh")) return mesh_msh_read(path, unit, a, m, e);
    if (text_ends(path, ".node") || text_ends(path, ".ele")) return mesh_tetgen_read(path, unit, a, m, e);
    return err_set(e, ERR_SCENE,
                   "%s: not a mesh by its name; .msh (Gmsh 2.2 or 4.1) and .node with .ele (TetGen) are read", path);
}
