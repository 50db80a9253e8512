/* The impacts of a contact that take place, and what is to be reported of them. Whoever needs them draws them anew: the
 * force, the listing, the table. */
#ifndef FORCE_IMPACT_TRAIN_H
#define FORCE_IMPACT_TRAIN_H
#include "force/impact_series.h"
#include "stage.h"

struct impact_train {
    struct impact_law law;
    struct impact_series series;
    struct impact next; /* the next one, if there is any            */
    bool any;
    double end;       /* s, of the motion                         */
    double before[2]; /* s: interval and duration of the last one */
    double sums[2];   /* of amplitudes, N, and intervals, s       */
    struct impact_report report;
};

/* Of a stage's contact; the motion is on the board. Errors: those of impact_law_make; ERR_SCENE: impacts that last
 * longer than 10 s. */
bool impact_train_open(const struct stage_run *r, struct impact_train *t, struct err *e);

/* Takes `next`, which there is, and looks for the one after it. The report is that of all that have been taken. */
struct impact impact_train_take(struct impact_train *t);

#endif
