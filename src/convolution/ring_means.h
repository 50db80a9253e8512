/* A choice in the making (ring_choice.c): the part that is about engines. */
#ifndef CONVOLUTION_RING_MEANS_H
#define CONVOLUTION_RING_MEANS_H
#include "convolution/ring_choice.h"
#include "convolution/ring_heard.h"
#include "convolution/ring_survey.h"

struct ring_choosing {
    const struct contact *contact;
    const struct scene *scene;
    const struct response *given;
    const char *key;
    struct arena *arena;
    struct ring_choice *to;
    struct trajectory trajectory;
    struct ring_heard heard;
    struct arena *work;         /* until the choice is made */
    struct ring_survey survey;  /* of a response that moves */
};

/* Sets engine, hops, error and work of c->to, whose modes and reading are known, and c->heard; of what moves, c->trajectory and c->survey too. ERR_SCENE: what is asked
   for cannot be had. */
bool ring_means_choose(struct ring_choosing *c, struct err *e);

/* A knob of scene/accuracy.def; that it was asked for is noted in c->to->knobs: so what the choice depends on is known by itself. */
double ring_means_knob(const struct ring_choosing *c, enum knob k);

#endif
