/* What diagnostics rows tell of the motion and the load (columns.def), at the rows' own instants. */
#ifndef OUTPUT_ROW_MOTION_H
#define OUTPUT_ROW_MOTION_H
#include "output/roll_rows.h"
#include "stage.h"
#include "trajectory/load.h"

enum { ROW_MOTION_SOME = 64 };

struct row_motion {
    const bool *wanted;          /* [COLUMNS]                                */
    const struct load_law *load; /* NULL: nothing is pressed on              */
    double alpha;                /* m, where no limiter varies it            */
    long rows, first, n;         /* of the table; those at hand              */
    double value[COLUMNS][ROW_MOTION_SOME];
};

/* Values of a row, which comes behind the one before. */
void row_motion_take(struct row_motion *m, const struct stage_run *r, long row, double value[COLUMNS]);

#endif
