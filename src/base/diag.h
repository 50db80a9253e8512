/* Many errors in texts that people wrote, each with its place, collected and shown together:

       scene.yaml:12:9: error: motion.rate needs a frequency; m is a unit of length
          12 |   rate: 3 m
             |         ^~~
             = help: write for instance: 2 Hz
       1 error

   Lines and columns count from 1, columns in characters. Of a file that another file (or an option) names, the place of
   its name follows the message: "wood.yaml:2:1: error: ... (named at scene.yaml:4:12)". */
#ifndef BASE_DIAG_H
#define BASE_DIAG_H
#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"

struct diag_source;

struct diag_place {
    const struct diag_source *source; /* NULL: no place at all                                  */
    int line, column;                 /* line 0: the source as a whole                          */
    int width;                        /* characters to underline; 0: to the end of the line     */
};

struct diag_source {  /* a file's text, or the text of an option on the command line       */
    const char *name; /* "scene.yaml", "--set motion.rate"                                 */
    const char *text;
    size_t size;
    bool option;             /* has no line numbers                                               */
    bool made;               /* a text of the program's own, of which nothing is shown            */
    int order;               /* sources are shown in this order                                   */
    struct diag_place named; /* where another source names this file; source NULL: none does    */
};

struct diag_error {
    struct diag_place at;
    const char *text, *help;
    int serial;
};

struct diag {
    struct arena *arena;
    struct diag_error *errors; /* the first DIAG_STORED                                           */
    int n;                     /* all that were added                                           */
};

enum { DIAG_SHOWN = 20, DIAG_STORED = 1000 };

struct diag *diag_open(struct arena *a);

/* Adds an error and returns false; help may be NULL. Control characters in the texts are shown as text_show has it. */
bool diag_add(struct diag *d, struct diag_place at, const char *help, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* A text as it may stand in a message: at most 40 characters. */
const char *diag_shown(struct diag *d, const char *text);

/* " (named at scene.yaml:4:12)" of a file that another names, and where that one is named; "" of others. */
const char *diag_named(struct arena *a, const struct diag_source *source);

/* All messages by place, at most DIAG_SHOWN, and their number. */
const char *diag_text(struct diag *d);

/* The first message's first line, for struct err. */
const char *diag_first(struct diag *d);

#endif
