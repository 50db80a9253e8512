/* What a trajectory is made of; for trajectory*.c alone. */
#ifndef TRAJECTORY_TRAJECTORY_STATE_H
#define TRAJECTORY_TRAJECTORY_STATE_H
#include "trajectory/course.h"
#include "trajectory/panels.h"
#include "trajectory/path.h"
#include "trajectory/speed.h"

struct trajectory_state {
    struct path path; /* `at` is NULL on straight paths */
    struct speed speed;
    bool timed; /* own time: the course and u(t)  */
    struct course course;
    struct panels far;
    bool corners; /* the motion rests at corners, where it may turn round */
};

#endif
