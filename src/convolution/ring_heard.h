/* How long a contact sounds: what of its responses can be heard at all, and over how many samples a cost is spread. */
#ifndef CONVOLUTION_RING_HEARD_H
#define CONVOLUTION_RING_HEARD_H
#include "scene/scene.h"

struct ring_heard { /* s after the contact's start */
    double force;   /* the motion lasts                                                                      */
    double sound;   /* the sound lasts, as far as this contact and the others' motion.duration tell          */
    double most;    /* it cannot last longer; HUGE_VAL: that is not known                                    */
};

/* duration: of the contact's motion; ring: its response's, until it has decayed by 80 dB; both in s. */
struct ring_heard ring_heard(const struct scene *s, const struct contact *c, double duration, double ring);

#endif
