/* Writing a mode table: the format that mode_table.h reads. */
#ifndef RESPONSE_MODE_TABLE_WRITE_H
#define RESPONSE_MODE_TABLE_WRITE_H
#include <stdio.h>

#include "response/modes.h"

/* The columns' line; comments ("# key: value") go before it. */
void mode_table_write_header(FILE *f);

/* One place's rows: modes order[0 .. n-1] of the point, numbered from 1 in that order, numbers with as many digits as
   the place says (zero without sign). Gains have the sign of the mode shapes' product: that of Re A of a displacement,
   Im A of a velocity, -Re A of an acceleration (phases near 0, pi/2, pi). */
struct mode_table_place {
    int digits; /* 12 of closed forms; 9 of what linear algebra on another CPU would give other last digits */
    int id;
    double x, y; /* m */
};
void mode_table_write_place(FILE *f, const struct mode_table_place *place, int n, const int *order,
                            const struct modes_point *p, int quantity);

#endif
