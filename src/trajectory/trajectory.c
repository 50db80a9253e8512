/* Motions: a speed law on a path, or a course with its own time. See trajectory.h; paths and courses are in path.c,
   laws in speed.c.

     straight       place = from + u e                              velocity = u' e          acceleration = u'' e
     curved         place = P(u)                                    velocity = u' e(u)       acceleration = u'' e + u'^2
                                                                    de/ds
     own time       place = P(t), velocity and acceleration its derivatives; u = integral of |P'| dt, u' = |P'|, u'' =
                    P' . P'' / |P'|

   The paths and times of papers/000 section 3.2: back_and_forth and four_in_line share one speed over time, circle and
   line another. */
#include "trajectory/trajectory.h"

#include <math.h>

#include "base/stopwatch.h"
#include "num/lanes.h"
#include "num/noise.h"
#include "num/real.h"
#include "stage.h"
#include "trajectory/motion.h"
#include "trajectory/panels.h"
#include "trajectory/path.h"
#include "trajectory/series.h"
#include "trajectory/speed.h"

struct trajectory_state {
    struct path path; /* `at` is NULL on straight paths */
    struct speed speed;
    bool timed; /* own time: the course and u(t)  */
    struct course course;
    struct panels far;
    bool corners; /* the motion rests at corners, where it may turn round */
};

enum { TRAJECTORY_CHUNK = 256 };

/* ------------------------------------------------------------------ at an instant */

static double *advanced(double *x, size_t by) { return x ? x + by : NULL; }

static void at_straight(const struct trajectory *tr, size_t n, const double *t, const struct trajectory_out *out)
{
    const struct speed *law = &tr->state->speed;
    double own[3][TRAJECTORY_CHUNK], *line[3] = {out->u, out->du, out->ddu};
    double *plane[3][2] = {{out->x, out->y}, {out->vx, out->vy}, {out->ax, out->ay}};
    for (int k = 0; k < 3; k++)
        if (!line[k] && (plane[k][0] || plane[k][1])) line[k] = own[k];
    law->at(law, n, t, line[0], line[1], line[2]);
    for (int k = 0; k < 3; k++)
        for (int xy = 0; xy < 2; xy++)
            for (size_t i = 0; plane[k][xy] && i < n; i++)
                plane[k][xy][i] = (k == 0 ? tr->from[xy] : 0) + line[k][i] * tr->e[xy];
}

static void at_curve(const struct trajectory *tr, size_t n, const double *t, const struct trajectory_out *out)
{
    const struct speed *law = &tr->state->speed;
    const struct path *path = &tr->state->path;
    double u[TRAJECTORY_CHUNK], du[TRAJECTORY_CHUNK], ddu[TRAJECTORY_CHUNK], e[2][TRAJECTORY_CHUNK],
        bend[2][TRAJECTORY_CHUNK];
    double *v[2] = {out->vx, out->vy}, *a[2] = {out->ax, out->ay};
    law->at(law, n, t, u, du, ddu);
    for (size_t i = 0; i < n; i++) {
        if (out->u) out->u[i] = u[i];
        if (out->du) out->du[i] = du[i];
        if (out->ddu) out->ddu[i] = ddu[i];
    }
    if (out->x || out->y || v[0] || v[1] || a[0] || a[1])
        path->at(path, n, u, &(struct path_out){.p = {out->x, out->y}, .e = {e[0], e[1]}, .bend = {bend[0], bend[1]}});
    for (int xy = 0; xy < 2; xy++) {
        for (size_t i = 0; v[xy] && i < n; i++)
            v[xy][i] = du[i] * e[xy][i];
        for (size_t i = 0; a[xy] && i < n; i++)
            a[xy][i] = ddu[i] * e[xy][i] + du[i] * du[i] * bend[xy][i];
    }
}

static void at_own_time(const struct trajectory *tr, size_t n, const double *t, const struct trajectory_out *out)
{
    const struct trajectory_state *s = tr->state;
    double own[4][TRAJECTORY_CHUNK];
    struct course_out c = {.p = {out->x, out->y}, .d = {out->vx, out->vy}, .dd = {out->ax, out->ay}};
    for (int xy = 0; xy < 2; xy++) {
        c.d[xy] = c.d[xy] ? c.d[xy] : out->du || out->ddu ? own[xy] : NULL;
        c.dd[xy] = c.dd[xy] ? c.dd[xy] : out->ddu ? own[2 + xy] : NULL;
    }
    s->course.at(&s->course, n, t, &c);
    if (out->u) panels_at(&s->far, n, t, out->u, NULL, NULL);
    for (size_t i = 0; (out->du || out->ddu) && i < n; i++) {
        double speed = sqrt(c.d[0][i] * c.d[0][i] + c.d[1][i] * c.d[1][i]);
        if (out->du) out->du[i] = speed;
        if (out->ddu)
            out->ddu[i] = speed > 0 ? (c.d[0][i] * c.dd[0][i] + c.d[1][i] * c.dd[1][i]) / speed
                                    : sqrt(c.dd[0][i] * c.dd[0][i] + c.dd[1][i] * c.dd[1][i]);
    }
}

/* n <= TRAJECTORY_CHUNK instants that need not lie within the motion. */
static void at_any(const struct trajectory *tr, size_t n, const double *t, const struct trajectory_out *out)
{
    if (tr->straight)
        at_straight(tr, n, t, out);
    else if (tr->state->timed)
        at_own_time(tr, n, t, out);
    else
        at_curve(tr, n, t, out);
}

LANES_CLONES
static void at_inside(double duration, size_t n, const double *t, double *inside)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++)
        inside[i] = lanes_select(t[i] < 0, 0, lanes_select(t[i] > duration, duration, t[i]));
}

void trajectory_at(const struct trajectory *tr, size_t n, const double *t, struct trajectory_out out)
{
    double inside[TRAJECTORY_CHUNK];
    for (size_t first = 0; first < n; first += TRAJECTORY_CHUNK) {
        size_t some = n - first < TRAJECTORY_CHUNK ? n - first : TRAJECTORY_CHUNK;
        at_inside(tr->duration, some, t + first, inside);
        at_any(tr, some, inside,
               &(struct trajectory_out){advanced(out.u, first), advanced(out.du, first), advanced(out.ddu, first),
                                        advanced(out.x, first), advanced(out.y, first), advanced(out.vx, first),
                                        advanced(out.vy, first), advanced(out.ax, first), advanced(out.ay, first)});
    }
}

void trajectory_continued(const struct trajectory *tr, double t, double place[2])
{
    at_any(tr, 1, &t, &(struct trajectory_out){.x = &place[0], .y = &place[1]});
}

uint64_t trajectory_seed(const struct scene *s, const struct contact *c) { return noise_make(s->seed, c->name).key; }

long trajectory_frames(const struct trajectory *tr, double rate) { return (long)ceil(tr->duration * rate) + 1; }

/* ------------------------------------------------------------------ turning round */

struct instant {
    double v[2], pull; /* velocity; velocity . acceleration */
};

static struct instant instant_at(const struct trajectory *tr, double t)
{
    struct instant s;
    double a[2];
    trajectory_at(tr, 1, &t, (struct trajectory_out){.vx = &s.v[0], .vy = &s.v[1], .ax = &a[0], .ay = &a[1]});
    s.pull = s.v[0] * a[0] + s.v[1] * a[1];
    return s;
}

static double speed_squared(const struct instant *s) { return s->v[0] * s->v[0] + s->v[1] * s->v[1]; }

/* Where the speed is least between two instants of opposite directions: v . a changes its sign there. */
static double plane_turning(const struct trajectory *tr, double t0, double t1)
{
    double low = fmax(t0, 0), high = fmin(t1, tr->duration);
    struct instant a = instant_at(tr, low), b = instant_at(tr, high);
    double slower = fmin(speed_squared(&a), speed_squared(&b));
    if (!(a.v[0] * b.v[0] + a.v[1] * b.v[1] < 0) || !(a.pull < 0) || !(b.pull > 0)) return NAN;
    for (int i = 0; i < 200; i++) {
        double middle = low + 0.5 * (high - low);
        if (middle <= low || middle >= high) break;
        struct instant m = instant_at(tr, middle);
        if (m.pull < 0)
            low = middle;
        else
            high = middle;
    }
    a = instant_at(tr, high);
    return high > t0 && high < t1 && high < tr->duration && speed_squared(&a) < 0.25 * slower ? high : NAN;
}

double trajectory_turning(const struct trajectory *tr, double t0, double t1)
{
    const struct trajectory_state *s = tr->state;
    if (tr->straight) return s->speed.turning ? s->speed.turning(&s->speed, t0, t1) : NAN;
    return s->timed || s->corners ? plane_turning(tr, t0, t1) : NAN;
}

/* From the scene's motion to a trajectory: the path, how long the motion lasts, the law, and figures of the whole. */
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
    int law = motion_law(m);
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
    return motion_law_fits(m, law) || err_set(e, ERR_SCENE,
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
static bool straight_path(struct making *w)
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

static bool scribble_path(struct making *w, double end)
{
    double where;
    path_scribble(&w->s->course, w->m, w->seed, end, w->arena);
    return path_arc(&w->s->path, &w->s->course, w->arena, &where) ||
           err_set(w->e, ERR_SCENE,
                   "motion: this scribble all but stops at %.4g s, and only its own speed can pass there; leave "
                   "motion.law out, or take another seed",
                   where);
}

/* Under a law of its own a recording gives the path only. */
static bool recorded_path(struct making *w)
{
    double where, clock;
    return path_recorded(w->m, NAN, w->arena, &w->s->course, &clock, w->e) &&
           (path_arc(&w->s->path, &w->s->course, w->arena, &where) ||
            err_set(w->e, ERR_SCENE,
                    "%s: the motion all but stops %.6g s after its start, and only its own times can pass there; leave "
                    "motion.law out",
                    w->m->file, where));
}

/* A scribble has no end: it is drawn as far as the table leads. */
static bool scribble_as_far(struct making *w, double distance)
{
    double end = w->s->speed.duration;
    if (!scribble_path(w, end)) return false;
    while (w->s->path.length < distance) {
        end *= fmax(1.02 * distance / w->s->path.length, 1.02);
        if (!scribble_path(w, end)) return false;
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
        return scribble_path(w, m->duration);
    case PATH_RECORDED:
        return recorded_path(w);
    default:
        return straight_path(w);
    }
}

static bool given_make(struct making *w)
{
    const struct motion *m = w->m;
    bool folds = m->path == PATH_BACK_AND_FORTH, endless = m->path == PATH_SCRIBBLE || m->path == PATH_CIRCLE;
    if (m->path != PATH_SCRIBBLE && !path_of(w)) return false;
    if (!speed_given(&w->s->speed, m->profile, folds ? w->s->path.length : NAN, w->arena, w->e)) return false;
    if (m->path == PATH_SCRIBBLE && !scribble_as_far(w, w->s->speed.distance)) return false;
    if (endless) w->s->path.length = w->s->speed.distance;
    return folds || endless || speed_given_ends(&w->s->speed, w->s->path.length, m->profile, w->e);
}

static bool law_make(struct making *w)
{
    const struct motion *m = w->m;
    struct trajectory_state *s = w->s;
    int law = motion_law(m);
    double duration;
    if (law == SPEED_GIVEN) return given_make(w);
    if (m->path == PATH_INCLINE) return straight_path(w) && speed_incline(&s->speed, m, w->arena, w->e);
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
        if (!path_recorded(w->m, w->m->duration, w->arena, &s->course, &w->tr->clock, w->e)) return false;
    } else {
        if (!duration_of(w, NAN, &duration)) return false;
        path_scribble(&s->course, w->m, w->seed, duration, w->arena);
    }
    panels_integral(&(struct panels_slope){path_course_speed, &s->course}, s->course.breaks, s->course.n_breaks,
                    w->arena, &s->far);
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
    double *ahead = v[0] != 0 || v[1] != 0 ? v : a, size = sqrt(ahead[0] * ahead[0] + ahead[1] * ahead[1]);
    for (int xy = 0; xy < 2; xy++) {
        tr->from[xy] = p[xy];
        tr->e[xy] = size > 0 ? ahead[xy] / size : xy == 0;
    }
    if (tr->state->path.at)
        tr->state->path.at(&tr->state->path, 1, &zero, &(struct path_out){.e = {&tr->e[0], &tr->e[1]}});
}

static void whole(struct making *w)
{
    struct trajectory *tr = w->tr;
    const struct speed *law = &w->s->speed;
    double ends[2] = {0, motion_cut(w->m, law->duration)}, du[2], range[2];
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
    stopwatch_spend(60000 + (tr->straight ? 0 : 1000.0 * (double)tr->detail));
    for (int xy = 0; xy < 2; xy++) {
        double a = tr->from[xy] + tr->reach[0] * tr->e[xy], b = tr->from[xy] + tr->reach[1] * tr->e[xy];
        range[0] = fmin(a, b);
        range[1] = fmax(a, b);
        if (!tr->straight) series_range(&(struct scan){xy ? scan_y : scan_x, tr}, 0, tr->duration, tr->detail, range);
        tr->box[0][xy] = range[0];
        tr->box[1][xy] = range[1];
    }
    tr->top_speed = law->top;
    if (w->s->timed) {
        series_range(&(struct scan){scan_du, tr}, 0, tr->duration, tr->detail, range);
        tr->top_speed = range[1];
    }
    tr->duration = ends[1]; /* figures are those of the whole motion, and the surface under it is */
    tr->cycle = fmin(tr->cycle, tr->duration);
    trajectory_at(tr, 2, ends, (struct trajectory_out){.du = du});
    tr->starts_at_rest = fabs(du[0]) <= 1e-8 * tr->top_speed;
    tr->ends_at_rest = fabs(du[1]) <= 1e-8 * tr->top_speed;
}

bool trajectory_make(const struct motion *m, uint64_t seed, struct arena *a, struct trajectory *tr, struct err *e)
{
    struct making w = {
        .m = m, .seed = seed, .arena = a, .tr = tr, .s = ARENA_TAKE(a, struct trajectory_state, 1), .e = e};
    if (m->made) {
        *tr = *m->made;
        return true;
    }
    *tr = (struct trajectory){.straight = false};
    if (!motion_can(m, e)) return false;
    if (!(m->path == PATH_STILL                                ? still_make(&w)
          : motion_law(m) == SPEED_AUTO && !motion_straight(m) ? timed_make(&w)
                                                               : law_make(&w)))
        return false;
    whole(&w);
    return true;
}

/* ------------------------------------------------------------------ the stage */

/* The stage that lays the motion on the board. */

static bool stage_wanted(const struct contact *c, const struct scene *s)
{
    (void)c, (void)s;
    return true;
}

static double stage_work(const struct contact *c, const struct scene *s)
{
    static const double cycles[] = {
        [PATH_BACK_AND_FORTH] = 18, [PATH_LINE] = 14,     [PATH_FOUR_IN_LINE] = 18, [PATH_CIRCLE] = 35,
        [PATH_SCRIBBLE] = 100,      [PATH_POLYLINE] = 40, [PATH_SPLINE] = 75,       [PATH_RECORDED] = 65,
        [PATH_STILL] = 5,           [PATH_INCLINE] = 20};
    return cycles[c->motion.path] * s->accuracy.oversampling;
}

/* What is legal, and hardly ever meant: a bare 20 is 20 kg. */
#define MOST_MASS 5.0  /* kg */
#define MOST_RATE 20.0 /* Hz; hands reach 10 */

static bool stage_open(struct stage_run *r, struct err *e)
{
    struct trajectory *tr = ARENA_TAKE(r->arena, struct trajectory, 1);
    if (!trajectory_make(&r->contact->motion, trajectory_seed(r->scene, r->contact), r->arena, tr, e))
        return err_at(e, "contact '%s'", r->contact->name);
    r->board->trajectory = tr;
    r->board->moving = trajectory_frames(tr, r->board->rate);
    const struct contact *c = r->contact;
    if (isgreater(c->scraper.mass, MOST_MASS)) /* NaN where there is none: quiet under traps */
        board_warn(r->board, arena_format(r->arena, "scraper.mass is %.6g kg: are grams meant?", c->scraper.mass));
    if (isgreater(c->motion.rate, MOST_RATE))
        board_warn(r->board, arena_format(r->arena, "motion.rate is %.6g Hz, faster than any hand: is it meant?",
                                          c->motion.rate));
    return true;
}

static const enum item stage_items[] = {ITEM_POSITION, ITEM_VELOCITY, ITEM_ACCELERATION, ITEM_X, ITEM_Y,
                                        ITEM_VX,       ITEM_VY,       ITEM_AX,           ITEM_AY};
enum { STAGE_ITEMS = sizeof stage_items / sizeof stage_items[0] };

static bool stage_fill(struct stage_run *r, long from, long to, struct err *e)
{
    (void)e;
    const struct board *b = r->board;
    double t[TRAJECTORY_CHUNK], *at[STAGE_ITEMS], first = (double)(from * b->over), rate = b->rate * b->over;
    bool read = false; /* by a stage, at the board's instants */
    for (int k = 0; k < STAGE_ITEMS; k++) {
        at[k] = board_has(b, stage_items[k]) ? board_at(b, stage_items[k], from) : NULL;
        read = read || at[k];
    }
    for (long i = 0, some, n = (to - from) * b->over; i < n && read; i += some) {
        some = n - i < TRAJECTORY_CHUNK ? n - i : TRAJECTORY_CHUNK;
        for (int k = 0; k < (int)some; k++)
            t[k] = (first + (double)i + k) / rate;
        trajectory_at(b->trajectory, (size_t)some, t,
                      (struct trajectory_out){at[0], at[1], at[2], at[3], at[4], at[5], at[6], at[7], at[8]});
        for (int k = 0; k < STAGE_ITEMS; k++)
            at[k] = advanced(at[k], (size_t)some);
    }
    return true;
}

const struct stage trajectory_stage = {
    .name = "trajectory",
    .does = "position, velocity and acceleration of the contact",
    .paper = "000 sec. 2.3, 3.2",
    .idle = "",
    .gives = ITEM_BIT(ITEM_MOTION) | ITEM_BIT(ITEM_POSITION) | ITEM_BIT(ITEM_VELOCITY) | ITEM_BIT(ITEM_ACCELERATION) |
             ITEM_BIT(ITEM_X) | ITEM_BIT(ITEM_Y) | ITEM_BIT(ITEM_VX) | ITEM_BIT(ITEM_VY) | ITEM_BIT(ITEM_AX) |
             ITEM_BIT(ITEM_AY),
    .wanted = stage_wanted,
    .work = stage_work,
    .open = stage_open,
    .run = stage_fill,
};
