/* The rows of a mode table's CSV: which columns there are, their numbers, and which rows belong together. For
 * mode_table.c. */
#ifndef RESPONSE_MODE_TABLE_ROWS_H
#define RESPONSE_MODE_TABLE_ROWS_H
#include "base/arena.h"
#include "base/err.h"
#include "file/csv.h"

/* In the order of the three forms' columns; those of an envelope table stand in for decay and gain. */
enum {
    MODE_TABLE_PLACE,
    MODE_TABLE_X,
    MODE_TABLE_Y,
    MODE_TABLE_MODE,
    MODE_TABLE_FREQUENCY,
    MODE_TABLE_DECAY,
    MODE_TABLE_GAIN,
    MODE_TABLE_PHASE,
    MODE_TABLE_SLOPE,
    MODE_TABLE_COLUMNS,
    MODE_TABLE_TIME = MODE_TABLE_DECAY,
    MODE_TABLE_AMPLITUDE = MODE_TABLE_GAIN
};

struct mode_table_rows {
    const struct csv *csv;
    bool envelope, slopes; /* the form */
    int column[MODE_TABLE_COLUMNS];
    size_t places, modes;
    size_t *place, *mode; /* [rows] number of each: places by x, then y, modes by lowest frequency, then names */
    double *value;        /* [rows][MODE_TABLE_COLUMNS] numbers, SI */
    size_t *order;        /* [rows] rows by place, mode, then slope or time */
};

/* Columns, numbers and their ranges, one point per place, no row twice. */
bool mode_table_rows_read(const struct csv *csv, struct arena *a, struct mode_table_rows *r, struct err *e);

const double *mode_table_rows_values(const struct mode_table_rows *r, size_t row);
const char *mode_table_rows_cell(const struct mode_table_rows *r, size_t row, int column);

/* The first row of that place, or of that mode (column MODE_TABLE_PLACE or _MODE). */
size_t mode_table_rows_first(const struct mode_table_rows *r, int column, size_t number);

/* Puts "file:line: " before an error; returns false. */
bool mode_table_rows_bad(const struct mode_table_rows *r, size_t row, struct err *e);

#endif
