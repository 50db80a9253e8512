/* Straight motions.

     back_and_forth   u(t) = L (1 - cos(2 pi r t)), L = half the distance between the ends: simple harmonic motion from the first end,
                      as papers/000 section 2.3 approximates a hand's ("simple harmonic motion with an angular frequency omega")
     line             u(t) = d p(t / T): constant speed p = q, or minimum jerk p = 10 q^3 - 15 q^4 + 6 q^5 (Flash and Hogan 1985)

   r rate in Hz, d distance between the ends in m, T duration in s. */
#include "trajectory/trajectory.h"

#include "num/real.h"
#include "num/vecmath.h"
#include "stage.h"

struct trajectory trajectory_make(const struct motion *m)
{
    double dx = m->to[0] - m->from[0], dy = m->to[1] - m->from[1], length = sqrt(dx * dx + dy * dy);
    struct trajectory tr = {.path = m->path, .law = m->law, .from = {m->from[0], m->from[1]}, .e = {dx / length, dy / length},
                            .length = length, .rate = m->rate, .duration = m->duration};
    if (m->path == PATH_BACK_AND_FORTH) {
        tr.top_speed = REAL_PI * m->rate * length;
        return tr;
    }
    if (isnan(m->duration))
        tr.duration = length / m->speed;
    tr.top_speed = length / tr.duration * (m->law == SPEED_MINIMUM_JERK ? 1.875 : 1.0);
    return tr;
}

long trajectory_frames(const struct trajectory *tr, double rate)
{
    return (long)ceil(tr->duration * rate) + 1;
}

enum { TRAJECTORY_CHUNK = 256 };

static double instant(const struct trajectory *tr, double t)
{
    return t < 0 ? 0 : t > tr->duration ? tr->duration : t;
}

static void harmonic(const struct trajectory *tr, size_t n, const double *t, double *out[3])
{
    double amplitude = tr->length / 2, omega = 2 * REAL_PI * tr->rate, s[TRAJECTORY_CHUNK], c[TRAJECTORY_CHUNK];
    for (size_t i = 0; i < n; i++)
        s[i] = 2 * tr->rate * instant(tr, t[i]);
    vecmath_sincospi(n, s, s, c);
    for (size_t i = 0; i < n; i++) {
        if (out[0])
            out[0][i] = amplitude * (1 - c[i]);
        if (out[1])
            out[1][i] = amplitude * omega * s[i];
        if (out[2])
            out[2][i] = amplitude * omega * omega * c[i];
    }
}

static void line(const struct trajectory *tr, size_t n, const double *t, double *out[3])
{
    double d = tr->length, v = d / tr->duration;
    bool jerk = tr->law == SPEED_MINIMUM_JERK;
    for (size_t i = 0; i < n; i++) {
        double q = instant(tr, t[i]) / tr->duration;
        if (out[0])
            out[0][i] = jerk ? d * q * q * q * (10 + q * (-15 + q * 6)) : d * q;
        if (out[1])
            out[1][i] = jerk ? 30 * v * q * q * (1 - q) * (1 - q) : v;
        if (out[2])
            out[2][i] = jerk ? 60 * v / tr->duration * q * (1 - q) * (1 - 2 * q) : 0;
    }
}

void trajectory_at(const struct trajectory *tr, size_t n, const double *t, double *u, double *v, double *a)
{
    double *out[3] = {u, v, a};
    while (n > 0) {
        size_t some = n < TRAJECTORY_CHUNK ? n : TRAJECTORY_CHUNK;
        if (tr->path == PATH_BACK_AND_FORTH)
            harmonic(tr, some, t, out);
        else
            line(tr, some, t, out);
        n -= some;
        t += some;
        for (int k = 0; k < 3; k++)
            out[k] = out[k] ? out[k] + some : NULL;
    }
}

double trajectory_continued(const struct trajectory *tr, double t)
{
    struct trajectory endless = *tr;
    double u, q = t / tr->duration;
    if (tr->path != PATH_BACK_AND_FORTH)
        return tr->length * (tr->law == SPEED_MINIMUM_JERK ? q * q * q * (10 + q * (-15 + q * 6)) : q);
    endless.duration = HUGE_VAL;
    t = fabs(t); /* the cosine is even */
    trajectory_at(&endless, 1, &t, &u, NULL, NULL);
    return u;
}

double trajectory_turning(const struct trajectory *tr, double t0, double t1)
{
    if (tr->path != PATH_BACK_AND_FORTH)
        return NAN;
    double turn = (floor(2 * tr->rate * t0) + 1) / (2 * tr->rate);
    return turn > t0 && turn < t1 && turn < tr->duration ? turn : NAN;
}

/* ------------------------------------------------------------------ the stage */

struct trajectory_state {
    struct trajectory tr;
};

static bool trajectory_wanted(const struct contact *c, const struct scene *s)
{
    (void)c, (void)s;
    return true;
}

static double trajectory_work(const struct contact *c, const struct scene *s)
{
    return (c->motion.path == PATH_BACK_AND_FORTH ? 12 : 6) * s->accuracy.oversampling;
}

static bool trajectory_open(struct stage_run *r, struct err *e)
{
    (void)e;
    struct trajectory_state *st = ARENA_TAKE(r->arena, struct trajectory_state, 1);
    st->tr = trajectory_make(&r->contact->motion);
    r->state = st;
    r->board->trajectory = &st->tr;
    r->board->moving = trajectory_frames(&st->tr, r->board->rate);
    return true;
}

static bool trajectory_run(struct stage_run *r, long from, long to, struct err *e)
{
    (void)e;
    const struct board *b = r->board;
    double t[TRAJECTORY_CHUNK];
    long n = (to - from) * b->over, first = from * b->over;
    double *out[3];
    for (int k = 0; k < 3; k++)
        out[k] = board_has(b, (enum item)(ITEM_POSITION + k)) ? board_at(b, (enum item)(ITEM_POSITION + k), from) : NULL;
    for (long i = 0; i < n; i += TRAJECTORY_CHUNK) {
        size_t some = (size_t)(n - i < TRAJECTORY_CHUNK ? n - i : TRAJECTORY_CHUNK);
        for (size_t j = 0; j < some; j++)
            t[j] = (double)(first + i + (long)j) / (b->rate * b->over);
        trajectory_at(b->trajectory, some, t, out[0] ? out[0] + i : NULL, out[1] ? out[1] + i : NULL, out[2] ? out[2] + i : NULL);
    }
    return true;
}

const struct stage trajectory_stage = {
    .name = "trajectory",
    .does = "position, velocity and acceleration of the contact",
    .paper = "000 sec. 2.3",
    .idle = "",
    .gives = ITEM_BIT(ITEM_POSITION) | ITEM_BIT(ITEM_VELOCITY) | ITEM_BIT(ITEM_ACCELERATION),
    .wanted = trajectory_wanted,
    .work = trajectory_work,
    .open = trajectory_open,
    .run = trajectory_run,
};
