/* What diagnostics rows tell of a ball (columns.def): of ITEM_ROLL, and the angle by which it has turned. */
#ifndef OUTPUT_ROLL_ROWS_H
#define OUTPUT_ROLL_ROWS_H
#include "stage.h"
#include "trajectory/spin.h"

#define COLUMN(id, name, exists, needs, meaning) id,
enum column {
#include "scene/columns.def"
    COLUMNS
};
#undef COLUMN

struct roll_rows {
    struct spin spin;
    double first[ROLL_VALUES]; /* at the first frame of the row being filled */
    double contact, lift_offs; /* sums over it */
};

void roll_rows_make(struct roll_rows *r, const struct contact *c);

/* The column's value comes from ITEM_ROLL. */
bool roll_rows_reads(const struct contact *c, enum column k);

/* One more frame of the row; `first`: it is the row's first. */
void roll_rows_frame(struct roll_rows *r, const double values[ROLL_VALUES], bool first);

/* Into value[COLUMNS], of a row of so many frames; the next row begins empty. */
void roll_rows_take(struct roll_rows *r, long frames, double *value);

/* theta at an instant, from u (m) and du (m/s). */
double roll_rows_angle(const struct roll_rows *r, double u, double du);

#endif
