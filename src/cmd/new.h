/* The starter scenes and designs of `rasp new`. */
#ifndef CMD_NEW_H
#define CMD_NEW_H
#include <stdio.h>

#include "base/arena.h"
#include "scene/keys_yaml.h"

struct new_starter {
    const char *name, *summary;
    const char *about; /* the comment at its head */
    const char *text;  /* "KEY VALUE; #KEY VALUE; ": see new.c; NULL: it is a design */
};

extern const struct new_starter new_starters[]; /* the first is the default; ends with name NULL */

/* What a starter's text says, ends with path NULL; "-": a contact begins; ".": the contacts are over. */
struct keys_line *new_lines(const char *text, struct arena *a);

/* irs: the folder of the shipped responses, as the scene is to call it. */
void new_print(FILE *f, const struct new_starter *s, const char *irs, struct arena *a);

#endif
