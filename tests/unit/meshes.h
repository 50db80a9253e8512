/* Meshes for tests: those of shapes, and a few elements by hand. */
#ifndef TESTS_UNIT_MESHES_H
#define TESTS_UNIT_MESHES_H
#include "base/arena.h"
#include "fem/shapes.h"
#include "unit.h"

static struct arena *meshes_pool;
static inline void meshes_drain(void) { arena_close(meshes_pool); }

static inline struct arena *meshes_arena(void)
{
    if (!meshes_pool) {
        meshes_pool = arena_open();
        atexit(meshes_drain);
    }
    return meshes_pool;
}

static inline struct mesh meshes_shape(const char *text)
{
    struct mesh m;
    struct err e = {0};
    ck_assert_msg(shapes_mesh(text, meshes_arena(), &m, &e), "%s: %s", text, e.text);
    return m;
}

/* The shape at a fineness. */
static inline struct mesh meshes_fine(const char *text, int fineness)
{
    return meshes_shape(arena_format(meshes_arena(), "%s,fineness=%d", text, fineness));
}

static inline const struct mesh_group *meshes_group(const struct mesh *m, const char *name)
{
    for (int i = 0; i < m->groups; i++)
        if (!strcmp(m->group[i].name, name)) return &m->group[i];
    ck_abort_msg("%s has no group %s", m->name, name);
    return NULL;
}

#endif
