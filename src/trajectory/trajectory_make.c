/* From the scene's motion to a trajectory: the path, how long the motion lasts, the law, and figures of the whole. */
#include <math.h>

#include "scene/rules.h"
#include "trajectory/recorded.h"
#include "trajectory/scan.h"
#include "trajectory/trajectory.h"
#include "trajectory/trajectory_state.h"

struct making {
    const struct motion *m;
    uint64_t seed;
    struct arena *arena;
    struct trajectory *tr;
    struct trajectory_state *s;
    struct err *e;
};

/* ------------------------------------------------------------------ what does not go together */

static bool motion_can(const struct motion *m, struct err *e)
{
    int law = rules_law(m);
    if (m->path == PATH_RECORDED && !m->file)
        return err_set(e, ERR_SCENE, "motion.file must be given where motion.path is recorded");
    if (law == SPEED_GIVEN && !m->profile)
        return err_set(e, ERR_SCENE, "motion.profile must be given where motion.law is given");
    if (law == SPEED_GIVEN && (!isnan(m->duration) || !isnan(m->speed)))
        return err_set(e, ERR_SCENE, "%s: the table motion.profile says how long the motion lasts; leave it out",
                       isnan(m->speed) ? "motion.duration" : "motion.speed");
    if (m->path == PATH_CIRCLE && m->turns == 0) return err_set(e, ERR_SCENE, "motion.turns must not be 0");
    if ((m->path == PATH_POLYLINE || m->path == PATH_SPLINE) && m->n_points < 2)
        return err_set(e, ERR_SCENE, "motion.points must be at least 2 points");
    return rules_law_fits(m, law) || err_set(e, ERR_SCENE,
                                             "motion.law does not fit motion.path: a motion rests at its corners and "
                                             "where it turns round, and a straight line has "
                                             "no curvature; give another law, or motion.corner; what is still, and "
                                             "what moves freely on an incline, has no law");
}

static bool duration_of(const struct making *w, double length, double *duration)
{
    const struct motion *m = w->m;
    *duration = !isnan(m->duration) ? m->duration : length / m->speed;
    return !isnan(*duration) ||
           err_set(w->e, ERR_SCENE, "%s must be given: nothing else says how long this motion lasts",
                   isnan(length) || m->path == PATH_BACK_AND_FORTH || m->path == PATH_RECORDED
                       ? "motion.duration"
                       : "motion.duration or motion.speed");
}

/* ------------------------------------------------------------------ paths and laws */

/* strokes of the same length */
static bool path_straight(struct making *w)
{
    const struct motion *m = w->m;
    double x = m->to[0] - m->from[0], y = m->to[1] - m->from[1], length = sqrt(x * x + y * y);
    size_t n = m->path == PATH_FOUR_IN_LINE ? (size_t)m->strokes : 1;
    if (length < 1e-9)
        return err_set(w->e, ERR_SCENE,
                       "motion.to must differ from motion.from: the ends are to be at least 1 nm apart");
    double *strokes = ARENA_TAKE(w->arena, double, n + 1);
    for (size_t i = 0; i <= n; i++)
        strokes[i] = length * ((double)i / (double)n);
    w->s->path = (struct path){.length = length, .n_strokes = n, .strokes = strokes};
    w->tr->straight = true;
    for (int xy = 0; xy < 2; xy++)
        w->tr->from[xy] = m->from[xy];
    w->tr->e[0] = x / length;
    w->tr->e[1] = y / length;
    return true;
}

static bool path_scribble(struct making *w, double end)
{
    double where;
    course_scribble(&w->s->course, w->m, w->seed, end, w->arena);
    return path_arc(&w->s->path, &w->s->course, w->arena, &where) ||
           err_set(w->e, ERR_SCENE,
                   "motion: this scribble all but stops at %.4g s, and only its own speed can pass there; leave "
                   "motion.law out, or take another seed",
                   where);
}

/* Under a law of its own a recording gives the path only. */
static bool path_recorded(struct making *w)
{
    double where, clock;
    return recorded_read(w->m, NAN, w->arena, &w->s->course, &clock, w->e) &&
           (path_arc(&w->s->path, &w->s->course, w->arena, &where) ||
            err_set(w->e, ERR_SCENE,
                    "%s: the motion all but stops %.6g s after its start, and only its own times can pass there; leave "
                    "motion.law out",
                    w->m->file, where));
}

/* A scribble has no end: it is drawn as far as the table leads. */
static bool path_scribble_as_far(struct making *w, double distance)
{
    double end = w->s->speed.duration;
    if (!path_scribble(w, end)) return false;
    while (w->s->path.length < distance) {
        end *= fmax(1.02 * distance / w->s->path.length, 1.02);
        if (!path_scribble(w, end)) return false;
    }
    return true;
}

static bool path_of(struct making *w)
{
    const struct motion *m = w->m;
    switch (m->path) {
    case PATH_CIRCLE:
        path_circle(&w->s->path, m, w->arena);
        return true;
    case PATH_POLYLINE:
        w->s->corners = m->corner == 0 && m->n_points > 2;
        return path_polyline(&w->s->path, m, w->arena, w->e);
    case PATH_SPLINE:
        return path_spline(&w->s->path, m, w->arena, w->e);
    case PATH_SCRIBBLE:
        return path_scribble(w, m->duration);
    case PATH_RECORDED:
        return path_recorded(w);
    default:
        return path_straight(w);
    }
}

static bool given_make(struct making *w)
{
    const struct motion *m = w->m;
    bool folds = m->path == PATH_BACK_AND_FORTH, endless = m->path == PATH_SCRIBBLE || m->path == PATH_CIRCLE;
    if (m->path != PATH_SCRIBBLE && !path_of(w)) return false;
    if (!speed_given(&w->s->speed, m->profile, folds ? w->s->path.length : NAN, w->arena, w->e)) return false;
    if (m->path == PATH_SCRIBBLE && !path_scribble_as_far(w, w->s->speed.distance)) return false;
    if (endless) w->s->path.length = w->s->speed.distance;
    return folds || endless || speed_given_ends(&w->s->speed, w->s->path.length, m->profile, w->e);
}

static bool law_make(struct making *w)
{
    const struct motion *m = w->m;
    struct trajectory_state *s = w->s;
    int law = rules_law(m);
    double duration;
    if (law == SPEED_GIVEN) return given_make(w);
    if (m->path == PATH_INCLINE) return path_straight(w) && speed_incline(&s->speed, m, w->arena, w->e);
    if ((m->path == PATH_SCRIBBLE && !duration_of(w, NAN, &duration)) || !path_of(w) ||
        !duration_of(w, s->path.length, &duration))
        return false;
    if (m->path == PATH_BACK_AND_FORTH)
        speed_strokes_folded(&s->speed, law, s->path.length, m->rate, duration, w->arena);
    else if (law == SPEED_TWO_THIRDS && s->path.curvature)
        speed_two_thirds(&s->speed, &s->path, m->straight, duration, w->arena);
    else
        speed_strokes(&s->speed, law, &s->path, duration, w->arena);
    return true;
}

/* One place, as a straight path along x without length. */
static bool still_make(struct making *w)
{
    static const double nowhere[2] = {0, 0};
    double duration;
    if (!duration_of(w, NAN, &duration)) return false;
    w->s->path = (struct path){.n_strokes = 1, .strokes = nowhere};
    speed_still(&w->s->speed, duration);
    w->tr->straight = true;
    for (int xy = 0; xy < 2; xy++)
        w->tr->from[xy] = w->m->at[xy];
    w->tr->e[0] = 1;
    return true;
}

/* A course with its own time. */
static bool timed_make(struct making *w)
{
    struct trajectory_state *s = w->s;
    double duration;
    s->timed = true;
    if (w->m->path == PATH_RECORDED) {
        if (!recorded_read(w->m, w->m->duration, w->arena, &s->course, &w->tr->clock, w->e)) return false;
    } else {
        if (!duration_of(w, NAN, &duration)) return false;
        course_scribble(&s->course, w->m, w->seed, duration, w->arena);
    }
    panels_integral(&(struct panels_slope){course_speed, &s->course}, s->course.breaks, s->course.n_breaks, w->arena,
                    &s->far);
    s->speed = (struct speed){.duration = s->course.end, .distance = panels_last(&s->far), .cycle = s->course.end};
    s->speed.reach[1] = s->speed.distance;
    s->path.length = s->speed.distance;
    return true;
}

/* ------------------------------------------------------------------ figures of the whole */

static void scan_x(const void *self, size_t n, const double *t, double *y)
{
    trajectory_at(self, n, t, (struct trajectory_out){.x = y});
}

static void scan_y(const void *self, size_t n, const double *t, double *y)
{
    trajectory_at(self, n, t, (struct trajectory_out){.y = y});
}

static void scan_du(const void *self, size_t n, const double *t, double *y)
{
    trajectory_at(self, n, t, (struct trajectory_out){.du = y});
}

/* Instants in which nothing of the motion's shape is missed. */
static long detail_of(const struct making *w)
{
    const struct trajectory_state *s = w->s;
    long detail = s->speed.detail > 256 ? s->speed.detail : 256;
    if (s->timed) return 2 * (long)s->far.n + 256;
    if (w->m->path == PATH_CIRCLE) return detail + 64 * (long)ceil(s->speed.distance / (2 * REAL_PI * w->m->radius));
    return detail + 2 * (long)s->path.n_breaks;
}

static void whole_start(struct trajectory *tr)
{
    double zero = 0, v[2], a[2], p[2];
    trajectory_at(tr, 1, &zero,
                  (struct trajectory_out){.x = &p[0], .y = &p[1], .vx = &v[0], .vy = &v[1], .ax = &a[0], .ay = &a[1]});
    double *way = v[0] != 0 || v[1] != 0 ? v : a, size = sqrt(way[0] * way[0] + way[1] * way[1]);
    for (int xy = 0; xy < 2; xy++) {
        tr->from[xy] = p[xy];
        tr->e[xy] = size > 0 ? way[xy] / size : xy == 0;
    }
    if (tr->state->path.at)
        tr->state->path.at(&tr->state->path, 1, &zero, &(struct path_out){.e = {&tr->e[0], &tr->e[1]}});
}

static void whole_box(struct trajectory *tr)
{
    double range[2];
    for (int xy = 0; xy < 2; xy++) {
        double a = tr->from[xy] + tr->reach[0] * tr->e[xy], b = tr->from[xy] + tr->reach[1] * tr->e[xy];
        range[0] = fmin(a, b);
        range[1] = fmax(a, b);
        if (!tr->straight) scan_range(&(struct scan){xy ? scan_y : scan_x, tr}, 0, tr->duration, tr->detail, range);
        tr->box[0][xy] = range[0];
        tr->box[1][xy] = range[1];
    }
}

static void whole(struct making *w)
{
    struct trajectory *tr = w->tr;
    const struct speed *law = &w->s->speed;
    double ends[2] = {0, law->duration}, du[2], range[2];
    tr->state = w->s;
    tr->length = w->s->path.length;
    tr->duration = law->duration;
    tr->cycle = law->cycle;
    tr->mean_speed = law->distance / law->duration;
    tr->reach[0] = law->reach[0];
    tr->reach[1] = law->reach[1];
    tr->lap = w->m->path == PATH_CIRCLE ? 2 * REAL_PI * w->m->radius : HUGE_VAL;
    tr->detail = detail_of(w);
    if (!tr->straight) whole_start(tr);
    whole_box(tr);
    tr->top_speed = law->top;
    if (w->s->timed) {
        scan_range(&(struct scan){scan_du, tr}, 0, tr->duration, tr->detail, range);
        tr->top_speed = range[1];
    }
    trajectory_at(tr, 2, ends, (struct trajectory_out){.du = du});
    tr->starts_at_rest = fabs(du[0]) <= 1e-8 * tr->top_speed;
    tr->ends_at_rest = fabs(du[1]) <= 1e-8 * tr->top_speed;
}

bool trajectory_make(const struct motion *m, uint64_t seed, struct arena *a, struct trajectory *tr, struct err *e)
{
    struct making w = {
        .m = m, .seed = seed, .arena = a, .tr = tr, .s = ARENA_TAKE(a, struct trajectory_state, 1), .e = e};
    *tr = (struct trajectory){.straight = false};
    if (!motion_can(m, e)) return false;
    if (!(m->path == PATH_STILL                              ? still_make(&w)
          : rules_law(m) == SPEED_AUTO && !rules_straight(m) ? timed_make(&w)
                                                             : law_make(&w)))
        return false;
    whole(&w);
    return true;
}
