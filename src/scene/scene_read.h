/* YAML scene files into struct scene: includes, overrides, units, ranges, defaults; every error at once. */
#ifndef SCENE_SCENE_READ_H
#define SCENE_SCENE_READ_H
#include <stdbool.h>

#include "base/arena.h"
#include "base/err.h"
#include "scene/scene.h"
#include "scene/scene_merge.h"

/* What is added to a scene: keys of another file that builds on it, then what the command line says: `--set
   PATH=VALUE`, in the order given (a later one wins), then `--seed NUMBER`. */
struct scene_overrides {
    const char **set; /* "motion.rate=3 Hz" */
    int n;
    const char *seed;                /* NULL: not given */
    const struct scene_layer *layer; /* NULL: none */
};

/* Reads and checks a scene, resolves includes and file names, applies overrides, defaults and accuracy presets.
   On failure e->kind is ERR_INPUT (the scene or a file it includes cannot be read) or ERR_SCENE, e->text is the first
   message's first line, and *messages, in the arena, is all of them as one string ready to print, with
   file:line:column, source line, caret and cure; on success it is "". Files that the scene names are not opened. */
bool scene_read(const char *file, const struct scene_overrides *over, struct arena *a, struct scene *s,
                const char **messages, struct err *e);

/* The same from memory, as if it stood in a file of that name: includes and file names are resolved against its folder.
 */
bool scene_read_text(const char *text, size_t n, const char *name, const struct scene_overrides *over, struct arena *a,
                     struct scene *s, const char **messages, struct err *e);

/* The same of a text that the program made: messages show no line of it, and file names in it are seen from the current
 * folder. */
bool scene_read_made(const char *text, const char *name, const struct scene_overrides *over, struct arena *a,
                     struct scene *s, const char **messages, struct err *e);

#endif
