/* The low-pass that follows a gesture. */
#ifndef FORCE_GESTURE_H
#define FORCE_GESTURE_H
#include "scene/scene.h"

struct gesture { /* section contact.gesture */
    bool given;
    double cutoff, speed; /* Hz at that speed, m/s; in proportion to the speed */
    int order;            /* 1 or 2                                            */
};

/* Does a low-pass on its force follow its speed? It then does what the stage approach does else. */
bool gesture_follows(const struct contact *c);

#endif
