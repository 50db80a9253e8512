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
    double whole; /* relative rms: asked, less the margin */
    struct render_parts parts;
    unsigned used;             /* set of knobs                         */
    struct excerpts *excerpts; /* [n_contacts] */
    double **force[2];         /* [n_contacts] of the last rehearsal and, [1], the one before */
    double **first;            /* [n_contacts] of the rehearsal with every knob at `draft`, once it has been */
    bool began;                /* it has                               */
    bool sounds;               /* some contact sounds; else forces are promised about */
    struct promise_curve curves[KNOBS];
};

/* Does the scene itself give the knob? */
static inline bool promise_said(const struct promise_making *m, int knob)
{
    return m->asked->accuracy.said & 1u << knob;
}

/* Does it turn the scene, so that its error is rehearsed? */
static inline bool promise_used(const struct promise_making *m, int knob) { return m->used & 1u << knob; }

/* The curves of all knobs whose errors are rehearsed, each until it tells which value has at most that error; 0: until
   all of them are settled. ERR_SCENE: of a ball that bounces; else those of stages. */
bool promise_rehearse(struct promise_making *m, double error, struct err *e);

/* True, with an error: a coupled ball bounces or, where the promise cannot be kept anyway (failed), leaves the surface.
 */
bool promise_rehearse_chaos(const struct promise_making *m, bool failed, struct err *e);

/* Sets the knobs that the scene leaves open. False: there are no such values. */
bool promise_share(struct promise_making *m);

#endif
