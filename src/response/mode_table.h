/* A mode table as it stands in its file, checked: the step between file/csv.h and struct modes. */
#ifndef RESPONSE_MODE_TABLE_H
#define RESPONSE_MODE_TABLE_H
#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "base/err.h"
#include "file/csv.h"

enum mode_table_column {
    MODE_TABLE_PLACE, MODE_TABLE_X, MODE_TABLE_Y, MODE_TABLE_MODE, MODE_TABLE_FREQUENCY, MODE_TABLE_DECAY, MODE_TABLE_GAIN,
    MODE_TABLE_PHASE, MODE_TABLE_COLUMNS
};

struct mode_table {
    struct csv csv;
    int column[MODE_TABLE_COLUMNS];
    int quantity;         /* enum modes_quantity                                      */
    size_t places, modes;
    size_t *place, *mode; /* [rows] index of each, in order of first appearance       */
    size_t *row;          /* [places][modes] row of the CSV                           */
    double *value;        /* [rows][MODE_TABLE_COLUMNS], the numeric ones, SI         */
};

/* Reads and checks everything but the geometry: comments, columns, every (place, mode) exactly once, numbers and their ranges, the
   same frequency and decay of a mode at every place, one point per place. Errors: as csv_read, else ERR_SCENE with file and line. */
bool mode_table_read(const char *path, struct arena *a, struct mode_table *t, struct err *e);

/* The numbers (indexed by enum mode_table_column) of a mode at a place. */
const double *mode_table_values(const struct mode_table *t, size_t place, size_t mode);

/* For an error in the row of that place's first mode: sets ERR_SCENE "file:line: place 'name': text"; returns false. */
bool mode_table_bad_place(const struct mode_table *t, size_t place, const char *text, struct err *e);

#endif
