/* A promise in the making (promise.c): the parts that rehearse and that share out. */
#ifndef PIPELINE_PROMISE_PARTS_H
#define PIPELINE_PROMISE_PARTS_H
#include "pipeline/excerpts.h"
#include "pipeline/promise.h"
#include "pipeline/promise_curve.h"
#include "pipeline/render_parts.h"

struct promise_making {
    const struct scene *asked;
    struct scene *kept;
    struct arena *arena;
    struct promise *to;
    double whole;                /* relative rms: asked, less the margin */
    struct render_parts parts;
    unsigned used;               /* set of knobs                         */
    bool morphs;                 /* some response moves with an error    */
    double morph;                /* its error at what is planned         */
    struct excerpts *excerpts;   /* [n_contacts] */
    double **force[2];           /* [n_contacts] of the last rehearsal and, [1], the one before */
    double **first;              /* [n_contacts] of the rehearsal with every knob at `draft`, once it has been */
    bool began;                  /* it has                               */
    bool sounds;                 /* some contact sounds; else forces are promised about */
    struct promise_curve curves[KNOBS];
    double work[2];              /* of plans at morph_error for 9 and 1 tenths of the budget's square */
};

/* Does the scene itself give the knob? */
static inline bool promise_said(const struct promise_making *m, int knob)
{
    return m->asked->accuracy.said & 1u << knob;
}

/* Is its error rehearsed? A ramp of gains is measured beforehand, except under a ball that is coupled. */
bool promise_rehearse_is(const struct promise_making *m, int knob);

/* The curves of all knobs whose errors are rehearsed, each until it tells which value has at most that error; 0: until all of them are settled. ERR_SCENE: of a ball that
   bounces; else those of stages. */
bool promise_rehearse(struct promise_making *m, double error, struct err *e);

/* True, with an error: a coupled ball bounces or, where the promise cannot be kept anyway (failed), leaves the surface. */
bool promise_rehearse_chaos(const struct promise_making *m, bool failed, struct err *e);

/* Sets the knobs that the scene leaves open but morph_error, which is free to have so many tenths of the budget's square. False: there are no such values. */
bool promise_share(struct promise_making *m, double *morph_tenths);

enum { PROMISE_TENTHS = 10 };

#endif
