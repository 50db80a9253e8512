/* Warnings of many scenes that wait for the end, each told once. */
#ifndef CMD_WARNINGS_H
#define CMD_WARNINGS_H
#include <stdbool.h>

#include "base/arena.h"

struct warning {
    const char *text, **files;  /* of the first; files [n] that have it */
    int n, room;
    bool numbers, other;        /* some have it with other numbers; so has the last */
    bool stimuli;               /* files are names of stimuli of a set; the caller's */
    struct warning *next;       /* in the order they came; NULL: last   */
};

/* A warning about a file goes to what tells the same already; else, unless only exactly the same counts, to what tells it of other files with other numbers
   (those that stand by themselves: not of names); else to the end. Texts are not copied. What tells it. */
struct warning *warnings_add(struct warning **all, const char *file, const char *text, bool exact, struct arena *a);

#endif
