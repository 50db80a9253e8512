/* What the mesh readers read from: a file in memory, numbers as text or as little-endian binary. Nothing is read beyond
 * its end. */
#ifndef FILE_MESH_SOURCE_H
#define FILE_MESH_SOURCE_H
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/arena.h"
#include "base/err.h"

struct mesh_source {
    const char *path, *start, *at, *end; /* *end is 0 */
    int line;                            /* of `at`, from 1; counted in text only */
    bool binary, remarks;                /* remarks: '#' begins one that lasts to the line's end */
    struct err *e;
};

bool mesh_source_open(struct mesh_source *s, const char *path, struct arena *a, struct err *e);

/* ERR_SCENE, "file:line: text" or "file: byte N: text". */
bool mesh_source_bad(const struct mesh_source *s, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The next number. bytes: 4 or 8, of a whole number in binary. What: for the message. A real one must be finite. */
bool mesh_source_whole(struct mesh_source *s, int bytes, int64_t *v, const char *what);
bool mesh_source_real(struct mesh_source *s, double *v, const char *what);

/* A count of things of which each takes at least so many bytes: refused when the file is too short for them. */
bool mesh_source_count(struct mesh_source *s, int bytes, size_t least, size_t *n, const char *what);

/* Text: is there another number on this line? */
bool mesh_source_on_line(struct mesh_source *s);

/* Goes behind "$name" on a line of its own, forwards; false: it is not there (no error is set). */
bool mesh_source_find(struct mesh_source *s, const char *name);

/* Goes behind the end of the line. */
void mesh_source_next_line(struct mesh_source *s);

#endif
