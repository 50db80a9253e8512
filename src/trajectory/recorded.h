/* A recorded motion. */
#ifndef TRAJECTORY_RECORDED_H
#define TRAJECTORY_RECORDED_H
#include <stdbool.h>

#include "base/arena.h"
#include "base/err.h"
#include "scene/scene.h"
#include "trajectory/course.h"

/* Reads m->file (time_s, x_m, y_m) and smooths it at m->cutoff. The course's parameter is s after the first row; *clock
   is that row's time. Ends with the file, or earlier after the duration (s; NAN: not said). ERR_INPUT, ERR_SCENE. */
bool recorded_read(const struct motion *m, double duration, struct arena *, struct course *, double *clock,
                   struct err *);

#endif
