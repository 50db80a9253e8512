/* See slope_heading.h. The ground is looked at along a straight line, as long as what a stiffness asks for (ball_ground), through the middle of the motion's box, or along up to
   LINES side by side where the motion turns and itself has as much ground: in all directions at the same places, so that no direction is confused with the few places where
   a way happened to have it, as it would be on a small circle. On ground that is alike in all directions chance makes the mean differ between them, and S the
   larger for it: on a circle of 30 mm over 5.7 um of roughness by 14 % with one line, 8 % with four or sixteen.
   A line goes where the ground is bent most, by the sum of H H' at some places of the motion: across ridges, of which it then meets as many as it can. Places
   are jittered, so that they fall in step with nothing, and count by Hann's window: half a ridge at an end would be 33 1/m times its share of the line, l^2 of
   which lifts S by more than it varies by otherwise. */
#include "force/slope_heading.h"

#include "num/real.h"
#include "num/vecmath.h"
#include "scene/ball.h"
#include "scene/rules.h"
#include "surface/limiter.h"
#include "surface/relief.h"
#include "trajectory/load.h"
#include "trajectory/trajectory.h"

enum { LINES = 4, EACH_LEAST = 512, EACH_MOST = 4096, PLACES = LINES * EACH_MOST, LOOKS = 32 };

#define APART 8.0 /* patches between two lines, at least */
#define APART_ALPHA 0.201 /* by logarithm: 1 to 5 cm, the usual range, at 10; with 1.4, nine over 0.1 mm to 10 m, stiffnesses were up to 46 % off */
#define GOLDEN 0.6180339887498949

struct look {
    int n;
    double x[PLACES], y[PLACES];                /* m                      */
    double xx[PLACES], xy[PLACES], yy[PLACES]; /* 1/m                   */
    double weight[PLACES];                      /* 1, sum 1               */
    double c[PLACES], t[PLACES];                /* alpha c, tanh of it */
};

static double look_share(int i)
{
    return i * GOLDEN - floor(i * GOLDEN);
}

static void look_read(struct look *g, const struct relief *r)
{
    bool plane = r->along == ALONG_PLANE;
    for (int i = 0; i < g->n; i++)
        g->xy[i] = g->yy[i] = 0;
    relief_at(r, &(struct relief_points){(size_t)g->n, g->x, plane ? g->y : NULL},
              &(struct relief_values){.xx = g->xx, .xy = plane ? g->xy : NULL, .yy = plane ? g->yy : NULL});
}

/* The unit vector to[] along which the ground is bent most. */
static void look_across(struct look *g, const struct stage_run *r, double to[2])
{
    double t[LOOKS], p = 0, q = 0;
    for (int i = 0; i < LOOKS; i++)
        t[i] = r->board->trajectory->duration * (i + look_share(i)) / LOOKS;
    trajectory_at(r->board->trajectory, LOOKS, t, (struct trajectory_out){.x = g->x, .y = g->y});
    g->n = LOOKS;
    look_read(g, r->board->relief);
    for (int i = 0; i < LOOKS; i++) {
        p += 0.5 * (g->xx[i] - g->yy[i]) * (g->xx[i] + g->yy[i]);
        q += g->xy[i] * (g->xx[i] + g->yy[i]);
    }
    double most = sqrt(p * p + q * q), a = p + most, length = sqrt(a * a + q * q);
    to[0] = length > 0 ? a / length : most > 0 ? 0 : 1;
    to[1] = length > 0 ? q / length : most > 0 ? 1 : 0;
}

static int look_some(const struct stage_run *r)
{
    double ground = trajectory_ground(r->board->trajectory, r->board->relief->along, ball_leak(r->contact));
    return (int)fmax(1, fmin(LINES, rint(ground / ball_ground(r->contact))));
}

/* Is there but one direction, to[]? */
static bool heading_one(const struct stage_run *r, double to[2])
{
    const struct trajectory *tr = r->board->trajectory;
    bool path = r->board->relief->along == ALONG_PATH;
    to[0] = !path && tr->straight ? tr->e[0] : 1;
    to[1] = !path && tr->straight ? tr->e[1] : 0;
    return path || tr->straight;
}

/* m, the corners of what the motion goes over. */
static void look_box(const struct stage_run *r, double box[2][2])
{
    const struct trajectory *tr = r->board->trajectory;
    bool path = r->board->relief->along == ALONG_PATH;
    for (int k = 0; k < 2; k++) {
        box[k][0] = path ? tr->reach[k] : tr->box[k][0];
        box[k][1] = path ? 0 : tr->box[k][1];
    }
}

static void look_along(struct look *g, const struct stage_run *r)
{
    double box[2][2], to[2], way = ball_ground(r->contact), patch = r->contact->scraper.patch;
    int lines = heading_one(r, to) ? 1 : look_some(r), each = (int)fmax(EACH_LEAST, fmin(EACH_MOST, ceil(4 * way / patch)));
    look_box(r, box);
    to[0] = 1, to[1] = 0;
    if (r->board->relief->along == ALONG_PLANE)
        look_across(g, r, to);
    double apart = fmax((fabs(to[1]) * (box[1][0] - box[0][0]) + fabs(to[0]) * (box[1][1] - box[0][1])) / lines, APART * patch);
    g->n = each * lines;
    for (int i = 0; i < g->n; i++) {
        double share = (i % each + look_share(i)) / each, at = way * (share - 0.5), aside = apart * (i / each - 0.5 * (lines - 1));
        g->x[i] = 0.5 * (box[0][0] + box[1][0]) + at * to[0] - aside * to[1];
        g->y[i] = 0.5 * (box[0][1] + box[1][1]) + at * to[1] + aside * to[0];
        g->weight[i] = (1 - real_cospi(2 * share)) / g->n;
    }
    look_read(g, r->board->relief);
}

/* Along the unit vector x, y. Along ridges nothing is bent: share 1. */
static struct slope_part look_part(struct look *g, double x, double y, double alpha)
{
    double all = 0, c = 0, t = 0, cc = 0, tc = 0;
    for (int i = 0; i < g->n; i++)
        g->c[i] = alpha * (x * x * g->xx[i] + 2 * x * y * g->xy[i] + y * y * g->yy[i]);
    vecmath_tanh((size_t)g->n, g->c, g->t);
    for (int i = 0; i < g->n; i++) {
        double w = g->weight[i];
        all += w;
        c += w * g->c[i];
        t += w * g->t[i];
        cc += w * g->c[i] * g->c[i];
        tc += w * g->t[i] * g->c[i];
    }
    double spread = cc - c * c / all, share = spread > 1e-12 * cc ? fmin((tc - t * c / all) / spread, 1) : 1;
    return (struct slope_part){share, (t - share * c) / (all * alpha)};
}

static void heading_alphas(struct slope_heading *h, const struct stage_run *r)
{
    const struct limiter_law *l = r->board->limiter;
    bool varies = l && l->varies, range = varies && l->alpha_min != l->alpha_max;
    double span = range ? fabs(real_log(l->alpha_max / l->alpha_min)) : 0;
    h->alphas = range ? (int)fmin(fmax(ceil(span / APART_ALPHA) + 1, 2), SLOPE_ALPHAS) : 1;
    h->least = real_log(varies ? fmin(l->alpha_min, l->alpha_max) : l ? l->fixed : limiter_constant(r->contact));
    h->step = range ? span / (h->alphas - 1) : 1;
}

/* On a straight way share and mean are the same all along it, unless alpha varies. */
static bool heading_asked(const struct stage_run *r)
{
    const struct limiter_law *l = r->board->limiter;
    double to[2];
    return r->contact->contact.limiter.curve == LIMITER_TANH && ((l && l->varies && l->alpha_min != l->alpha_max) || !heading_one(r, to));
}

/* At the alpha of that number. */
static void heading_fill(struct slope_heading *h, struct look *g, const struct stage_run *r, int k)
{
    double e[2], alpha = real_exp(h->least + k * h->step);
    bool one = h->one = heading_one(r, e);
    struct slope_part p = {1, 0};
    for (int i = 0; i <= SLOPE_HEADINGS; i++) {
        double side = 2.0 * i / SLOPE_HEADINGS, x = 1 - side, y = 1 - fabs(x), length = sqrt(x * x + y * y);
        if (!one || i == 0)
            p = look_part(g, one ? e[0] : x / length, one ? e[1] : y / length, alpha);
        h->share[k][i] = p.share;
        h->mean[k][i] = p.mean;
    }
}

const struct slope_heading *slope_heading_make(const struct stage_run *r, struct arena *a)
{
    if (!heading_asked(r))
        return NULL;
    struct slope_heading *h = ARENA_TAKE(a, struct slope_heading, 1);
    struct arena *own = arena_open();
    struct look *g = ARENA_TAKE(own, struct look, 1);
    heading_alphas(h, r);
    look_along(g, r);
    for (int k = 0; k < h->alphas; k++)
        heading_fill(h, g, r, k);
    arena_close(own);
    return h;
}

static int heading_below(double place, int last)
{
    return place < last ? (int)place : last - 1;
}

double slope_heading_row(const struct slope_heading *h, double alpha)
{
    return h && h->alphas > 1 ? fmin(fmax((real_log(alpha) - h->least) / h->step, 0), h->alphas - 1) : 0;
}

struct slope_part slope_heading_at(const struct slope_heading *h, double ex, double ey, double row)
{
    if (!h)
        return (struct slope_part){1, 0};
    double place = h->one ? 0 : SLOPE_HEADINGS / 2 * (1 - (ey < 0 ? -ex : ex) / (fabs(ex) + fabs(ey)));
    int i = heading_below(place, SLOPE_HEADINGS), k = h->alphas > 1 ? heading_below(row, h->alphas - 1) : 0, up = h->alphas > 1 ? k + 1 : k;
    double f = place - i, low = 1 - (row - k), high = row - k;
    return (struct slope_part){low * ((1 - f) * h->share[k][i] + f * h->share[k][i + 1]) + high * ((1 - f) * h->share[up][i] + f * h->share[up][i + 1]),
                               low * ((1 - f) * h->mean[k][i] + f * h->mean[k][i + 1]) + high * ((1 - f) * h->mean[up][i] + f * h->mean[up][i + 1])};
}
