/* accuracy.error: the knobs that a scene leaves unsaid, chosen as the coarsest that keep an error, which is predicted
   before anything is rendered. A preset is an error to aim at (accuracy_target): its knobs are chosen in the same way
   from a sample of the motion, and where it cannot be had, they are what comes nearest.

   The error is that of all knobs that turn the scene, each taken to be independent of the others, so that powers add:

     predicted^2 = sum of e_k^2 <= asked^2

   e of gain_ramp   the sound of the motion at one ramp against the next, which share no harmonic, all else at `draft`
   e of steps       the force of the motion at doubled values against each other, weighed by what of it is audible
                    (error_pilot.h) */
#ifndef PIPELINE_ERROR_BUDGET_H
#define PIPELINE_ERROR_BUDGET_H
#include "base/arena.h"
#include "base/err.h"
#include "scene/scene.h"

struct error_budget_part {
    enum knob knob;
    bool by_user; /* by the scene                             */
    double value;
    double error; /* relative rms that it leaves              */
};

struct error_budget {
    bool asked;              /* the scene has accuracy.error             */
    bool chosen;             /* it left something to choose              */
    bool missed;             /* the preset's error is not had            */
    bool diverges;           /* a ball bounces: the knobs are the preset's own */
    double error, predicted; /* dB, asked or the preset's (NAN: none); predicted NAN: every knob is said */
    struct error_budget_part parts[KNOBS];
    int n;            /* knobs that leave an error                */
    double cpu;       /* s that it took to choose                 */
    double cycles;    /* that it was predicted to take            */
    double read[2];   /* of these, s and cycles before it began: of responses and objects */
    const char *text; /* one line of all this; NULL: not asked    */
};

/* chosen: the scene with every knob settled, and said, its engines chosen (response.choice); at preset reference, or
   with every knob said, as it was asked. p may be NULL. ERR_SCENE: accuracy.error cannot be kept, and what can be
   (err_about accuracy.error); else those of inputs and plans. */
bool error_budget_apply(const struct scene *asked, struct arena *a, struct scene *chosen, struct error_budget *p,
                        struct err *e);

#endif
