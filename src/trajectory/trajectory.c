/* Motions: a speed law on a path, or a course with its own time. See trajectory.h; paths are in path_*.c, laws in
   speed_*.c, courses in course*.c and recorded.c.

     straight       place = from + u e                              velocity = u' e          acceleration = u'' e
     curved         place = P(u)                                    velocity = u' e(u)       acceleration = u'' e + u'^2
                                                                    de/ds
     own time       place = P(t), velocity and acceleration its derivatives; u = integral of |P'| dt, u' = |P'|, u'' =
                    P' . P'' / |P'|

   The paths and times of papers/000 section 3.2: back_and_forth and four_in_line share one speed over time, circle and
   line another. */
#include "trajectory/trajectory.h"

#include <math.h>

#include "num/lanes.h"
#include "num/noise.h"
#include "trajectory/trajectory_state.h"

enum { TRAJECTORY_CHUNK = 256 };

/* ------------------------------------------------------------------ at an instant */

static double *from(double *x, size_t first) { return x ? x + first : NULL; }

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
               &(struct trajectory_out){from(out.u, first), from(out.du, first), from(out.ddu, first),
                                        from(out.x, first), from(out.y, first), from(out.vx, first),
                                        from(out.vy, first), from(out.ax, first), from(out.ay, first)});
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
