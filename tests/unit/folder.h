/* A folder of the test's own: made, written to, and gone at the end. */
#ifndef TESTS_UNIT_FOLDER_H
#define TESTS_UNIT_FOLDER_H
#include <unistd.h>

#include "base/arena.h"
#include "unit.h"

static char folder_name[64];
static struct arena *folder_arena;

/* Makes it, and memory that lives as long as it does. */
static inline struct arena *folder_make(void)
{
    strcpy(folder_name, "/tmp/rasp_test_XXXXXX");
    ck_assert_ptr_nonnull(mkdtemp(folder_name));
    folder_arena = arena_open();
    return folder_arena;
}

/* Removes it with all that is in it, and gives the memory back. */
static inline void folder_remove(void)
{
    ck_assert_int_eq(system(arena_format(folder_arena, "rm -r %s", folder_name)), 0);
    arena_close(folder_arena);
}

/* The path of what is called so in it. */
static inline const char *folder_path(const char *name)
{
    return arena_format(folder_arena, "%s/%s", folder_name, name);
}

static inline void folder_write(const char *name, const char *text)
{
    FILE *f = fopen(folder_path(name), "w");
    ck_assert_ptr_nonnull(f);
    fputs(text, f);
    fclose(f);
}

/* Makes it the current folder; leaves and removes it, which must be empty: a file left behind is a failure. */
static inline void folder_enter(void)
{
    folder_make();
    ck_assert_int_eq(chdir(folder_name), 0);
}

static inline void folder_leave(void)
{
    ck_assert_int_eq(chdir("/"), 0);
    ck_assert_int_eq(rmdir(folder_name), 0);
    arena_close(folder_arena);
}

#endif
