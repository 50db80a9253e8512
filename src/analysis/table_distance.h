/* How far two tables differ, column by column, each with its own tolerance. */
#ifndef ANALYSIS_TABLE_DISTANCE_H
#define ANALYSIS_TABLE_DISTANCE_H
#include "base/arena.h"
#include "base/err.h"
#include "file/csv.h"

/* Cells a and b agree when their texts are the same, or, unless exact, when both are numbers with |b - a| <= abs + rel
   |a|, or both are NaN, or both the same infinity. */
struct table_distance_tolerance {
    const char *column; /* "*": every column not named otherwise */
    double abs, rel;
    bool exact;
};

struct table_distance_column {
    const char *name;
    int a, b; /* which column it is in either                                           */
    struct table_distance_tolerance tolerance;
    size_t misses;    /* rows that do not agree                                                 */
    size_t worst_row; /* the first of those farthest beyond the tolerance; from 0               */
    double excess;    /* |b - a| - (abs + rel |a|) there; INFINITY: not two finite numbers      */
    double largest;   /* largest |b - a| of finite numbers over all rows                        */
};

struct table_distance {
    size_t rows;                           /* compared: those both have */
    struct table_distance_column *columns; /* that both have            */
    size_t n_columns;
    const char **missing, **extra; /* in a only, in b only      */
    size_t n_missing, n_extra;
    bool reordered;      /* the common columns stand in another order */
    const char *comment; /* the first comment that is not the same in both, "" for one without key; NULL: none */
};

/* tolerances end with a column of NULL; without "*" the other columns are exact. ERR_SCENE: one names a column that a
 * does not have. */
bool table_distance(const struct csv *tables[2], const struct table_distance_tolerance *tolerances, struct arena *arena,
                    struct table_distance *d, struct err *e);

/* Reads a table `column,abs,rel`. ERR_INPUT, ERR_SCENE. The result ends with a column of NULL. */
struct table_distance_tolerance *table_distance_read(const char *path, struct arena *a, struct err *e);

#endif
