/* One limited trajectory S along the path, its slope and its height.

     dS'/ds + S'/l = T(c) + kappa S_n       S' = dS/ds, slope of S along the path; s arc length      after papers/000 eq. 4, 5
     dS_n/ds + S_n/l = T(d) - kappa S'      S_n, slope across the path (only where the path is curved)
     dS/ds + S/l = S'                       S, height, m: its deviation from its mean                (read by what rolls; where the way turns: slope_height.c)

     c = e' H e, d = e' H n   second derivatives of z along the unit tangent e, and mixed with the normal n, 1/m; H the surface's Hessian
     l     contact.leak, m    kappa    curvature of the path in the plane, 1/m    T    tanh(alpha c) / alpha

   The paper defines only S'' (equations 4, 5) but uses S' in equation 3 and S in equation 16; the integral of the limited curvature drifts away as a random
   walk, hence the leak l, twice. Slope and height come from one trajectory: the raw slope z' would bring back what the limiter removed. (S', S_n) is one
   vector, the slope of S in the plane; kappa turns it as the path turns, so that a tight turn and a reversal, where S' changes sign, are the same thing in
   the limit. Along a profile that follows the path there is no S_n. All start from 0 at the start of the motion.

   T has a mean although c has none: under a ball long stretches are bent downwards by up to 1/R and short ones upwards by more, and the limiter makes these
   alike. S runs from 0 to l^2 times that mean over the first millimetres, by many times what it varies by later; and where alpha follows a normal force
   that swings, the mean swings with it, and S, opposite to the force. So the same is solved beside it (even for S', lift for S) for two shapes that the mean of T
   may have over alpha, flat: S less what of T goes with these, by least squares over the motion (slope_level), times their lifts has none of them. They are
   T of the curve -1/R that the ball follows over a high point, not limited and limited, over 1/R: 1 and tanh(alpha/R) / (alpha/R). Over ridges, of a profile
   along x or nothing but ridges in the plane, it is bent along their normal x only: c = e_x^2 / R, limited as such.

   On a way that turns the mean of T goes with the heading, and over ridges, where alpha varies, it is of no such shape: there S is made of heights
   (force/slope_height.c), not of S', and the two shapes are those of what is left of T, whatever heading and alpha.

   Over a piece of length h (z = h/l <= 1/16, phi(z) = (1 - e^-z)/z, chi = (1 - phi)/z)

     S'(end)           = (1 - z phi) S' + phi h mean(T) + z (1 - z/2) h moment(T)
     integral of S' ds = h (phi S' + chi h mean(T) - (1 - z/2) h moment(T) + z h (mean(T) - (T_start + T_end)/2) / 60)
     S(end)            = (1 - z phi) (S + h S') + h^2 ((phi - chi) mean(T) - (1 - z) moment(T))

   mean and first moment of T in closed form (surface/limited.c), the last term of the second line as of a parabola. Left out is the leak's weight beyond its straight line: z^2/24 of what
   T varies by within the piece, of S z h^2/12 times it and 9/20 z^2 of the moment's part. The turn of a piece is taken half before, half after it
   (error (kappa h)^2/24 of the piece's part), with kappa h moment(T) of T across it. Where S' changes sign inside a piece it is taken as a parabola
   (power 1) or two straight lines. */
#include "force/slope.h"

#include <math.h>
#include <string.h>

#include "force/crossing.h"
#include "num/real.h"

static void slope_fill(struct slope *s, int upto)
{
    for (; s->filled < upto; s->filled++) {
        s->ends[s->filled] = s->slope;
        s->heights[s->filled] = s->height;
        s->climbs[s->filled] = s->climb;
        for (int k = 0; k < SLOPE_LEVELS && s->rising; k++)
            s->lifts[k][s->filled] = s->lift[k];
    }
}

/* The slope vector as seen from axes turned by the angle of that sine and cosine. */
static void slope_rotate(struct slope *s, double sine, double cosine)
{
    double before = s->slope;
    s->slope = before * cosine + s->across * sine;
    s->across = s->across * cosine - before * sine;
}

/* From the axes the slope is in to those at a point; at once where the path has a corner. */
static void slope_face(struct slope *s, double ex, double ey)
{
    if (s->ex != 0 || s->ey != 0)
        slope_rotate(s, s->ex * ey - s->ey * ex, s->ex * ex + s->ey * ey);
    s->ex = ex;
    s->ey = ey;
}

/* The unit vector half way between the axes at a piece's two ends, which are never opposed (force/way.c). */
static void slope_halfway(const struct way_pieces *p, int i, double *ex, double *ey)
{
    double x = p->ex[p->at[i]] + p->ex[p->at[i] + 1], y = p->ey[p->at[i]] + p->ey[p->at[i] + 1], length = sqrt(x * x + y * y);
    *ex = x / length;
    *ey = y / length;
}

/* T of a ball's curve over a high point, -1/R, over T of that where alpha is 0; 1 where nothing is limited. */
static void slope_flat(struct slope *s, double alpha)
{
    double bend = alpha / s->radius;
    if (alpha != s->alpha)
        s->flat[1] = bend > 0 ? real_tanh(bend * s->flat[0]) / bend : s->flat[0];
    s->alpha = alpha;
}

/* The same as of slope and height, for T = flat[]. */
static void slope_lift(struct slope *s, double h, int heading, double phi, double chi)
{
    double kept = 1 - h / s->leak * phi;
    for (int k = 0; k < SLOPE_LEVELS; k++) {
        double even = s->even[k] * heading;
        s->lift[k] = kept * (s->lift[k] + h * even) + h * h * (phi - chi) * s->flat[k];
        s->even[k] = heading * (kept * even + phi * h * s->flat[k]);
    }
}

static void slope_weigh(struct slope *s, double h, double mean)
{
    for (int k = 0; k < SLOPE_LEVELS; k++) {
        s->bent[k] += h * mean * s->flat[k];
        for (int j = 0; j <= k; j++)
            s->gone[k][j] += h * s->flat[j] * s->flat[k];
    }
}

/* Height at the piece's end, from the slope at its start in the direction of travel. */
static void slope_rise(struct slope *s, const struct way_pieces *p, int i, double a)
{
    double h = p->length[i], z = s->terms.z[i], phi = s->terms.phi[i], chi = s->terms.chi[i], mean = p->mean[0][i];
    double alpha = s->way.limiter ? p->alpha[0][p->at[i]] : 0;
    slope_flat(s, alpha);
    slope_lift(s, h, p->heading[i], phi, chi);
    if (s->by_height) {
        mean = slope_height_piece(&s->turned, p, &s->terms, i, alpha);
        s->height = s->turned.sum + s->turned.rise;
        s->climb = p->heading[i] * slope_height_climb(&s->turned, p, i, s->leak);
    } else {
        s->height = s->terms.kept[i] * (s->height + h * a) + h * h * ((phi - chi) * mean - (1 - z) * p->moment[0][i]);
    }
    slope_weigh(s, h, mean);
}

/* Length times the sine of the angle by which a piece turns on the way. */
static double slope_turn(const struct way_pieces *p, int i)
{
    int a = p->at[i], b = a + 1;
    return p->length[i] * (p->ex[a] * p->ey[b] - p->ey[a] * p->ex[b]);
}

/* What T varies by within a piece that turns goes partly to the side: T is taken along e half way, and e turns about it. */
static void slope_lean(struct slope *s, const struct way_pieces *p, int i)
{
    double turn = p->heading[i] * slope_turn(p, i);
    s->slope -= turn * p->moment[1][i];
    s->across += turn * p->moment[0][i];
}

/* Slope at the end of a piece of a way that turns, or whose height is asked for. */
static void slope_piece(struct slope *s, const struct way_pieces *p, int i)
{
    double ex, ey;
    slope_fill(s, p->interval[i]);
    if (s->way.curved) {
        slope_halfway(p, i, &ex, &ey);
        slope_face(s, p->ex[p->at[i]], p->ey[p->at[i]]);
        slope_face(s, ex, ey);
        s->across = p->heading[i] * slope_terms_end(&s->terms, 1, i, s->across * p->heading[i]);
    }
    double a = s->terms.start[i] = s->slope * p->heading[i], b = s->terms.end[i] = slope_terms_end(&s->terms, 0, i, a);
    if (s->rising)
        slope_rise(s, p, i, a);
    s->slope = b * p->heading[i];
    s->climb = s->by_height ? s->climb : s->slope;
    if (s->way.curved) {
        slope_lean(s, p, i);
        slope_face(s, p->ex[p->at[i] + 1], p->ey[p->at[i] + 1]);
    }
}

/* The same of a straight way whose slope alone is asked for. Each piece waits for the one before it, for a multiplication and an addition: the sign of the
   direction is taken out of that, and each piece writes its sub-interval's end, the last of them what stays. */
static void slope_straight(struct slope *s, const struct way_pieces *p)
{
    struct slope_terms *t = &s->terms;
    int heading = p->heading[0], last = p->interval[0];
    double along = s->slope * heading;
    slope_fill(s, last);
    for (int i = 0; i < p->n; i++) {
        int k = p->interval[i];
        if (p->heading[i] != heading) {
            heading = -heading;
            along = -along;
        }
        for (int rest = last + 1; rest < k; rest++) /* sub-intervals without a way */
            s->ends[rest] = along * heading;
        t->start[i] = along;
        t->end[i] = along = slope_terms_end(t, 0, i, along);
        s->ends[k] = along * heading;
        last = k;
    }
    s->slope = along * heading;
    s->filled = last;
}

/* whole[], late[] of |S'|^power. */
static void slope_crossing(struct slope *s, int n)
{
    struct slope_terms *t = &s->terms;
    if (s->power == 1) {
        slope_terms_crossing(t, n);
        return;
    }
    for (int i = 0; i < n; i++) {
        struct crossing c = crossing_power((double[]){t->start[i], 1.5 * t->mean[i] - 0.25 * (t->start[i] + t->end[i]), t->end[i]}, s->power);
        t->whole[i] = c.whole;
        t->late[i] = c.late;
    }
}

/* To the pieces' sub-intervals: how far they are, how S' goes over them. */
static void slope_gather(struct slope *s, const struct way_pieces *p)
{
    const struct slope_terms *t = &s->terms;
    bool curved = s->way.curved, crossing = s->crossing;
    for (int i = 0; i < p->n; i++) {
        double h = p->length[i];
        int k = p->interval[i];
        if (crossing) {
            s->crossed[k] += h * t->whole[i];
            s->crossed_late[k] += h * (s->travelled[k] * t->whole[i] + h * t->late[i]);
        }
        s->climbed[k] += h * t->mean[i] + (curved ? h * slope_turn(p, i) * p->mean[1][i] / 6 : 0);
        s->travelled[k] += h;
    }
}

static void slope_use(void *self, const struct way_pieces *p)
{
    struct slope *s = self;
    slope_terms(&s->terms, p, s->way.curved ? 2 : 1, s->leak);
    if (s->way.curved || s->rising)
        for (int i = 0; i < p->n; i++)
            slope_piece(s, p, i);
    else
        slope_straight(s, p);
    slope_terms_mean(&s->terms, p->n);
    if (s->crossing)
        slope_crossing(s, p->n);
    slope_gather(s, p);
}

/* Of a straight way over what is the same all along a direction, the square of its share across that; else 1. */
static double slope_across(const struct slope *s, const struct stage_run *r)
{
    const struct surface *c = &r->contact->surface;
    bool profile = r->board->relief->along == ALONG_X, beside = c->height_map || c->roughness.given || c->grit.given || c->fractal.given;
    double x = profile ? 1 : real_sin(c->ridges.direction), y = profile ? 0 : -real_cos(c->ridges.direction), across = s->way.e[0] * x + s->way.e[1] * y;
    return s->way.field && !s->way.curved && (profile || (c->ridges.given && !beside)) ? across * across : 1;
}

bool slope_make(struct slope *s, struct stage_run *r, struct err *e)
{
    double given = r->contact->contact.leak;
    s->leak = given > 0 ? given : SLOPE_LEAK;
    s->power = r->contact->contact.beta2;
    s->radius = r->contact->scraper.radius;
    s->alpha = -1;
    s->way.use = slope_use;
    s->way.self = s;
    if (!way_make(&s->way, r, WAY_ALONG, s->leak / 16, e))
        return false;
    s->by_height = s->way.heights = s->rising && (s->way.curved || s->turned.heading);
    s->flat[0] = s->flat[1] = slope_across(s, r);
    return true;
}

void slope_level(const struct slope *s, double level[SLOPE_LEVELS])
{
    double own = s->gone[0][0], both = s->gone[1][0], left = own * s->gone[1][1] - both * both; /* all to the first where no more than rounding is left of the second */
    level[1] = left > 1e-9 * own * s->gone[1][1] ? (own * s->bent[1] - both * s->bent[0]) / left : 0;
    level[0] = own > 0 ? (s->bent[0] - both * level[1]) / own : 0;
}

void slope_forget(struct slope *s)
{
    s->slope = s->across = s->height = s->climb = s->ex = s->ey = 0;
    s->turned = (struct slope_height){.heading = s->turned.heading};
    memset(s->even, 0, sizeof s->even);
    memset(s->lift, 0, sizeof s->lift);
    s->alpha = -1;
}

void slope_run(struct slope *s, const struct stage_run *r, long first, int n)
{
    memset(s->crossed, 0, sizeof s->crossed);
    memset(s->crossed_late, 0, sizeof s->crossed_late);
    memset(s->climbed, 0, sizeof s->climbed);
    memset(s->travelled, 0, sizeof s->travelled);
    s->filled = 0;
    way_run(&s->way, r, first, n);
    slope_fill(s, n);
}
