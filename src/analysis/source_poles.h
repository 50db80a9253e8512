/* Parts of source_filter.h: onsets, the frames between them, and the poles of what rings there. */
#ifndef ANALYSIS_SOURCE_POLES_H
#define ANALYSIS_SOURCE_POLES_H
#include "analysis/source_filter.h"

#define SOURCE_PAST 1e-3     /* s after an onset: what struck has left */
#define SOURCE_MARGIN 0.5e-3 /* s before the next */

struct source_poles_frame {
    int onset;
    long from, n; /* samples */
    double energy;
    bool known; /* its state is */
};

/* [n] What linear prediction does not foresee of x. */
double *source_poles_unforeseen(const double *x, long n, struct arena *a);

/* f->onsets, f->onset. y: as above. rise: dB. */
void source_poles_onsets(struct source_filter *f, const double *y, double rise, struct arena *a);

/* One behind each onset. */
struct source_poles_frame *source_poles_frames(const struct source_filter *f, const double *y, struct arena *a);

/* f->m, f->mode and how they were found. ERR_SCENE */
bool source_poles_find(struct source_filter *f, const struct source_filter_options *o,
                       const struct source_poles_frame *frame, struct arena *a, struct err *e);

static inline cplx source_poles_of(const struct source_filter_mode *m)
{
    return (cplx){-m->decay, 2 * REAL_PI * m->frequency};
}

#endif
