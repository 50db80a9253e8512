/* Lines "dotted.path: value" as nested YAML, for the effective scene, the reference scene and the starter scenes. */
#ifndef SCENE_KEYS_YAML_H
#define SCENE_KEYS_YAML_H
#include <stdbool.h>
#include <stdio.h>

#include "base/arena.h"

struct keys_line {
    const char *path;    /* dotted, as of a key; lines of one map stand together          */
    const char *value;   /* YAML text of the value                                           */
    const char *comment; /* written above, wrapped; NULL: none                               */
    bool off;            /* written as a comment that becomes the line when its # is removed */
};

struct keys_style {
    int indent;    /* of the outermost keys                                                  */
    bool item;     /* one entry of a list: "- " stands before the first key                  */
    bool comments; /* sections are explained, with a blank line before those at the top      */
};

void keys_yaml_print(FILE *f, const struct keys_line *lines, int n, const struct keys_style *style);

/* A text as a double-quoted scalar. Bytes that are not UTF-8 are written as they are (YAML has no way to say them, its
 * readers refuse). */
const char *keys_yaml_quoted(const char *text, struct arena *a);
/* The shortest of %.15g, %.16g, %.17g that reads back as the same number. */
const char *keys_yaml_number(double x, struct arena *a);

/* The annotated reference scene: every key there is, in a scene that is valid as it stands. */
void keys_yaml_reference(FILE *f, struct arena *a);

/* The value that the reference scene shows for a key that has no default, or NULL. */
const char *keys_yaml_example(const char *path);

#endif
