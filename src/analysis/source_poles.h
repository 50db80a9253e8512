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

struct source_response_hits { /* impacts, as they are known so far, from SOURCE_MARGIN before their onsets on */
    int n;
    double *at, *size; /* [n] samples; pushes */
};

/* [n] What linear prediction does not foresee of x, made as of x with so much white noise added to its power. */
double *source_poles_unforeseen(const double *x, long n, double noise, struct arena *a);

/* f->onsets, f->onset. y: as above. rise: dB. */
void source_poles_onsets(struct source_filter *f, const double *y, double rise, struct arena *a);

/* One behind each of the f->onsets, until the next, or until something comes that y did not foresee. */
struct source_poles_frame *source_poles_free_frames(const struct source_filter *f, const double *y, struct arena *a);

/* One behind each impact, until the next. */
struct source_poles_frame *source_poles_frames(const struct source_filter *f, const struct source_response_hits *h,
                                               struct arena *a);

/* f->m and f->mode. ERR_SCENE

   Of frames, by linear prediction. */
bool source_poles_frames_find(struct source_filter *f, const struct source_filter_options *o,
                              const struct source_poles_frame *frame, struct arena *a, struct err *e);

/* Of a response h[n] to an impact of 1, which begins SOURCE_MARGIN before it, from f->free on, which is found: the last
   early reflection is over; gains are those there. And of what is free for long behind the
   impacts, if there are any, by ESPRIT; of modes that there are (f->m) the gains alone. */
bool source_poles_response(struct source_filter *f, const struct source_filter_options *o, const double *h, long n,
                           const struct source_response_hits *hits, struct arena *a, struct err *e);

/* Of the recording's autocorrelation: f->correlated. */
bool source_poles_correlated(struct source_filter *f, const struct source_filter_options *o, struct arena *a,
                             struct err *e);

static inline cplx source_poles_of(const struct source_filter_mode *m)
{
    return (cplx){-m->decay, 2 * REAL_PI * m->frequency};
}

#endif
