/* How long a contact sounds: what of its responses can be heard at all, and over how many samples a cost is spread. */
#ifndef CONVOLUTION_RING_HEARD_H
#define CONVOLUTION_RING_HEARD_H
#include <stdbool.h>

#include "base/err.h"
#include "scene/scene.h"

struct ring_heard { /* s after the contact's start */
    double force;   /* the motion lasts                                           */
    double sound;   /* the sound lasts, as far as this contact's response tells   */
    double most;    /* it cannot last longer                                      */
};

/* h->force is set. ring: of the contact's response, s until it has decayed by 80 dB. Errors: those of the others' motions. */
bool ring_heard(const struct scene *s, const struct contact *c, double ring, struct ring_heard *h, struct err *e);

#endif
