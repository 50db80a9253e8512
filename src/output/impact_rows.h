/* The series of impacts as a CSV: time_s,amplitude_n,interval_s,duration_s, one row an impact, %.17g; impact_rows.c is
 * the stage that writes it. */
#ifndef OUTPUT_IMPACT_ROWS_H
#define OUTPUT_IMPACT_ROWS_H
#include <stdio.h>

#include "base/err.h"

struct impact_sink {
    FILE *stream;
};

#endif
