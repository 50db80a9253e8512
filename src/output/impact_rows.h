/* The series of impacts as a CSV: time_s,amplitude_n,interval_s,duration_s, one row an impact, %.17g; impact_rows.c is the stage that writes it. */
#ifndef OUTPUT_IMPACT_ROWS_H
#define OUTPUT_IMPACT_ROWS_H
#include <stdio.h>

#include "base/err.h"

struct impact_sink {
    FILE *stream;
};

/* Of an impact's middle (s after the scene's start), N, s, s. ERR_IO: it could not be written. */
bool impact_rows_head(struct impact_sink *k, struct err *e);
bool impact_rows_add(struct impact_sink *k, const double row[4], struct err *e);

#endif
