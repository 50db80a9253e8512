/* The starter scenes of `rasp new`. */
#ifndef CMD_STARTERS_H
#define CMD_STARTERS_H
#include <stdio.h>

#include "base/arena.h"
#include "scene/keys_yaml.h"

struct starter {
    const char *name, *summary;
    const char *about;                /* the comment at its head                                   */
    const struct keys_line *head;     /* each array ends with path NULL; NULL: it is a design      */
    const struct keys_line *items[3]; /* several contacts; none: the contact's keys are in head  */
    const struct keys_line *tail;
};

extern const struct starter starters_table[]; /* the first is the default; ends with name NULL */

const struct starter *starters_find(const char *name); /* NULL: none */
/* irs: the folder of the shipped responses, as the scene is to call it. */
void starters_print(FILE *f, const struct starter *s, const char *irs, struct arena *a);

#endif
