/* The columns of a manifest: what each is called, what it means, what stands in it. */
#ifndef BATCH_MANIFEST_COLUMNS_H
#define BATCH_MANIFEST_COLUMNS_H
#include "batch/manifest.h"

struct manifest_cell {          /* what a column may be made from */
    const struct set *set;
    int row;                    /* from 0 */
    const struct outcome *is;
    const struct record *record; /* NULL: none                    */
    const char *level;          /* set_level_text */
    FILE *f;
};

struct manifest_column {
    const char *name;           /* NULL: the end; "*": here the factors' columns stand */
    const char *title, *meaning, *unit; /* unit NULL: none */
    void (*put)(const struct manifest_cell *c);
};

extern const struct manifest_column manifest_columns[];

/* The shortest decimal number that reads back as the same; "n/a" of what is not finite. */
void manifest_columns_number(FILE *f, double x);

/* Quoted where RFC 4180 wants it. */
void manifest_columns_text(FILE *f, const char *text);

#endif
