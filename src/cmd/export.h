/* What the parts of `rasp export` share: the set, the trials, the folder that is written, and the table of formats. */
#ifndef CMD_EXPORT_H
#define CMD_EXPORT_H
#include <jansson.h>
#include <stdio.h>

#include "batch/trials.h"
#include "cmd/cmd.h"
#include "file/csv.h"

struct export;
struct export_list;

struct export_format {
    const char *name;
    const char *sounds, *table; /* the folder of the WAVs, %s: the study's name, and the table of them in it */
    bool tabs;                  /* cells have tabs between them, not commas */
    bool browser;               /* a browser plays the sounds               */
    bool bare;                  /* a design without trials will do          */
    bool splits;                /* the folder of the WAVs is divided into splits */
    bool (*files)(struct export *x, struct err *e); /* once; NULL: none          */
    /* Trial k, from 0, of a list. an error may be set; what it gives is freed all the same */
    json_t *(*trial)(struct export *x, const struct export_list *l, int k, struct err *e);
    /* Its file, of all of them. NULL: the format has no trials */
    bool (*list)(struct export *x, const struct export_list *l, json_t *trials, struct err *e);
};

struct export_list {              /* the trials of one participant in one sitting */
    const char *name;             /* "p01", or of several sittings "p01_s1"       */
    const char *person, *sitting; /* "01"; "1", NULL: there is one                */
    const struct trial *trials;
    int n;
    struct arena *arena;
};

struct export
{
    const struct design *design;
    const struct export_format *format;
    struct trials trials; /* n 0: the design has none                         */
    struct csv manifest;  /* a row a stimulus, in the order of the design     */
    const char *set;      /* the set's folder                                 */
    const char *name;     /* of the study: letters, digits, _ and -           */
    const char *output, *temporary;
    int people;
    uint64_t seed;
    const char **files; /* [n_files] written so far                          */
    int n_files;
    FILE *stream; /* of the file that is written                              */
    struct arena *arena;
};

/* A file of the folder: open, write to x->stream, close. ERR_CREATE, ERR_IO */
bool export_open(struct export *x, const char *name, struct err *e);
bool export_close(struct export *x, struct err *e);
bool export_text(struct export *x, const char *name, const char *text, struct err *e); /* all three */
bool export_json(struct export *x, const char *name, json_t *value, struct err *e);    /* which is taken */

/* The WAV of stimulus i in the folder, and a cell of the manifest. */
const char *export_sound(const struct export *x, int i, struct arena *a);
const char *export_manifest(const struct export *x, int i, const char *column);

/* A cell of a table, quoted as it needs; the first of a row has no separator before it. */
void export_cell(struct export *x, bool first, const char *text);

/* A participant's number, from 1, with zeros to equal width, two digits at least. */
const char *export_person(const struct export *x, int i, struct arena *a);

/* export_formats.c; ends with name NULL */
extern const struct export_format export_formats_table[];

/* export_pages.c: HTML and JavaScript of the pages. */
extern const char export_pages_study[], export_pages_jspsych[], export_pages_page[];

#endif
