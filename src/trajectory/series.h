/* Columns of numbers over time, from a CSV: recorded motions, speeds, normal forces. */
#ifndef TRAJECTORY_SERIES_H
#define TRAJECTORY_SERIES_H
#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "base/err.h"

struct series {
    size_t n;
    double *time;     /* [n] s, rising, as the file has it */
    double *x[2];     /* [n] the columns                   */
    const int *lines; /* [n] lines of the file             */
};

/* Reads time_s and the named columns (at most 2; NULL: none) of a file; other columns are left alone. At least 2 rows,
   times rising. ERR_INPUT, ERR_SCENE with file and line. */
bool series_read(const char *file, const char *const columns[2], struct arena *, struct series *, struct err *);

/* For what a cubic is laid through: rows are 1 ns apart or more, so that no slope and no curvature of it is beyond
 * numbers. ERR_SCENE with file and line. */
bool series_spaced(const struct series *, const char *file, struct err *);

#endif
