/* Diagnostics: a table of the physics of one contact, at a control rate, as CSV or NPY. */
#ifndef OUTPUT_FORCE_TABLE_H
#define OUTPUT_FORCE_TABLE_H
#include <stdio.h>

/* Where the rows go. */
struct table_sink {
    FILE *stream;
};

#endif
