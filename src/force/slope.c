/* One limited trajectory S along the path, its slope and its height.

     dS'/ds + S'/l = T(c) + kappa S_n       S' = dS/ds, slope of S along the path; s arc length      after papers/000 eq. 4, 5
     dS_n/ds + S_n/l = T(d) - kappa S'      S_n, slope across the path (only where the path is curved)
     dS/ds + S/l = S'                       S, height, m: its deviation from its mean                (read by what rolls)

     c = e' H e, d = e' H n   second derivatives of z along the unit tangent e, and mixed with the normal n, 1/m; H the surface's Hessian
     l     contact.leak, m    kappa    curvature of the path in the plane, 1/m    T    tanh(alpha c) / alpha

   The paper defines only S'' (equations 4, 5) but uses S' in equation 3 and S in equation 16; the integral of the limited curvature drifts away as a random
   walk, hence the leak l, twice. Slope and height come from one trajectory: the raw slope z' would bring back what the limiter removed. (S', S_n) is one
   vector, the slope of S in the plane; kappa turns it as the path turns, so that a tight turn and a reversal, where S' changes sign, are the same thing in
   the limit. Along a profile that follows the path there is no S_n. All start from 0 at the start of the motion.

   T has a mean although c has none: under a ball long stretches are bent downwards by up to 1/R and short ones upwards by more, and the limiter makes these
   alike. S runs from 0 to l^2 times that mean over the first millimetres, by many times what it varies by later; and where alpha follows a normal force
   that swings, the mean swings with it, and S, opposite to the force. So the same is solved beside it ((even, sideways) for (S', S_n), lift for S, turned by
   kappa and at corners as they are) for some shapes that the mean of T may have over direction and alpha, (flat, aside) in (c, d): S less what of T goes with
   these, by least squares over the motion (slope_level), times their lifts has none of them. They are, over 1/R,

     [0], [1]  T of the curve -1/R that the ball follows over a high point, not limited and limited, along the path: 1 and tanh(alpha/R) / (alpha/R). Over the
               ridges of a profile that curve is bent along x only: c = e_x^2 / R, limited as such
     [2], [3]  over ridges that the path meets at changing angles, the same of d = -e_x e_y / R. Apart from [0], [1], as a straight way has no use of it
     [2]..[5]  in the plane, where the path turns: what ridges in four directions 45 degrees apart would have, for what has a grain, c and d limited by the
               alpha of a constant force, times [1]. Without these the force of a ball that went round a circle over a grain of 20 swung by several weights

   On a straight way, cut in pieces or not, [0] and [1] alone are left. Turned with the way, ground that is alike in all directions gives the same; pure
   ridges in the plane to 0.4 of the weight, in means over 25 ms.

   Over a piece of length h (z = h/l <= 1/16, phi(z) = (1 - e^-z)/z, chi = (1 - phi)/z)

     S'(end)           = (1 - z phi) S' + phi h mean(T) + z (1 - z/2) h moment(T)
     integral of S' ds = h (phi S' + chi h mean(T) - (1 - z/2) h moment(T))
     S(end)            = (1 - z phi) (S + h S') + h^2 ((phi - chi) mean(T) - (1 - z) moment(T))

   mean and first moment of T in closed form (surface/limited.c). Left out is the leak's weight beyond its straight line: z^2/24 of what
   T varies by within the piece, of S z h^2/12 times it and 9/20 z^2 of the moment's part. The turn of a piece is taken half before, half after it
   (error (kappa h)^2/24 of the piece's part), with kappa h moment(T) of T across it. Where S' changes sign inside a piece it is taken as a parabola
   (power 1) or two straight lines. */
#include "force/slope.h"

#include <math.h>
#include <string.h>

#include "num/real.h"
#include "num/vecmath.h"
#include "surface/limiter.h"

/* (1 - e^-z) / z for 0 <= z <= 1/16: the series' first term left out is z^8 / 9! < 1e-15. */
static double leak_phi(double z)
{
    return 1 - z / 2 * (1 - z / 3 * (1 - z / 4 * (1 - z / 5 * (1 - z / 6 * (1 - z / 7 * (1 - z / 8))))));
}

/* (1 - leak_phi(z)) / z */
static double leak_chi(double z)
{
    return 0.5 * (1 - z / 3 * (1 - z / 4 * (1 - z / 5 * (1 - z / 6 * (1 - z / 7 * (1 - z / 8))))));
}

/* Integral of |S'| over a piece on which S' goes from a to b, with that mean: of the parabola a (1 - q) + b q + bow q (1 - q), which has one zero
   between ends of opposite signs. */
static double crossed_slope(double h, double a, double b, double mean)
{
    double bow = 6 * (mean - 0.5 * (a + b)), p = b - a + bow, root = sqrt(fmax(p * p + 4 * bow * a, 0));
    double s = p < 0 ? p - root : p + root, q = s != 0 ? -2 * a / s : 0;
    if (a * b >= 0)
        return h * fabs(mean);
    if (!(q >= 0 && q <= 1))
        q = s / (2 * bow);
    double before = q * (a + q * (0.5 * p - q * bow / 3));
    return h * (fabs(before) + fabs(mean - before));
}

/* The same of |S'|^power: Simpson's rule on each side of a zero. */
static double crossed_power(double h, const double s[3], double power)
{
    double p[3] = {fabs(s[0]), fabs(s[1]), fabs(s[2])};
    vecmath_pow(3, p, power, p);
    if (s[0] * s[2] < 0)
        return h * (p[0] * fabs(s[0]) + p[2] * fabs(s[2])) / ((fabs(s[0]) + fabs(s[2])) * (1 + power));
    return h * (p[0] + 4 * p[1] + p[2]) / 6;
}

static void slope_fill(struct slope *s, int upto)
{
    for (; s->filled < upto; s->filled++) {
        s->ends[s->filled] = s->slope;
        s->heights[s->filled] = s->height;
        for (int k = 0; k < s->levels; k++)
            s->lifts[k][s->filled] = s->lift[k];
    }
}

static void vector_rotate(double *along, double *across, double sine, double cosine)
{
    double before = *along;
    *along = before * cosine + *across * sine;
    *across = *across * cosine - before * sine;
}

/* The slope vector, and its level, as seen from axes turned by the angle of that sine and cosine. */
static void slope_rotate(struct slope *s, double sine, double cosine)
{
    vector_rotate(&s->slope, &s->across, sine, cosine);
    for (int k = 0; k < s->levels && s->rising; k++)
        vector_rotate(&s->even[k], &s->sideways[k], sine, cosine);
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

/* Slope at the piece's end from that at its start, both in the direction of travel; the mean of the slope. */
static double slope_step(const struct slope *s, const struct way_pieces *p, int i, int channel, double a, double *mean)
{
    double h = p->length[i], z = h / s->leak, phi = leak_phi(z), moment = (1 - z / 2) * h * p->moment[channel][i];
    *mean = phi * a + leak_chi(z) * h * p->mean[channel][i] - moment;
    return (1 - z * phi) * a + phi * h * p->mean[channel][i] + z * moment;
}

/* T of a curve c/R over T of 1/R where alpha is 0. */
static double slope_limited(double bend, double c)
{
    return bend > 0 ? real_tanh(bend * c) / bend : c;
}

/* Bent along x, 45 degrees from it towards y, along y, and towards -x. */
static void slope_grain(struct slope *s)
{
    double x = s->ex, y = s->ey;
    for (int k = 2; k < SLOPE_LEVELS; k++) {
        s->flat[k] = s->flat[1] * slope_limited(s->bend, x * x);
        s->aside[k] = s->flat[1] * slope_limited(s->bend, -x * y);
        double turned = (x + y) * sqrt(0.5);
        y = (y - x) * sqrt(0.5);
        x = turned;
    }
}

/* T of a ball's curve over a high point, -1/R, over T of that where alpha is 0; 1 where nothing is limited. Over ridges that run along y it is bent along x only. */
static void slope_flat(struct slope *s, double alpha)
{
    double bend = alpha / s->radius;
    if (s->ridges) {
        s->flat[0] = s->ex * s->ex;
        s->aside[2] = -s->ex * s->ey;
        s->aside[3] = slope_limited(bend, s->aside[2]);
    }
    if (s->ridges || alpha != s->alpha)
        s->flat[1] = slope_limited(bend, s->flat[0]);
    if (s->levels > 4)
        slope_grain(s);
    s->alpha = alpha;
}

/* The same as of slope and height, for T(c) = flat[], T(d) = aside[]. */
static void slope_lift(struct slope *s, double h, int heading, double phi, double chi)
{
    double kept = 1 - h / s->leak * phi;
    for (int k = 0; k < s->levels; k++) {
        double even = s->even[k] * heading;
        s->lift[k] = kept * (s->lift[k] + h * even) + h * h * (phi - chi) * s->flat[k];
        s->even[k] = heading * (kept * even + phi * h * s->flat[k]);
        s->sideways[k] = kept * s->sideways[k] + heading * phi * h * s->aside[k];
    }
}

static void slope_weigh(struct slope *s, double h, double along, double across)
{
    for (int k = 0; k < s->levels; k++) {
        s->bent[k] += h * along * s->flat[k] + h * across * s->aside[k];
        for (int j = 0; j <= k; j++)
            s->gone[k][j] += h * s->flat[j] * s->flat[k] + h * s->aside[j] * s->aside[k];
    }
}

/* Height at the piece's end, from the slope at its start in the direction of travel. */
static void slope_rise(struct slope *s, const struct way_pieces *p, int i, double a)
{
    double h = p->length[i], z = h / s->leak, phi = leak_phi(z), chi = leak_chi(z), mean = p->mean[0][i];
    slope_flat(s, s->way.limiter ? p->alpha[0][p->at[i]] : 0);
    slope_lift(s, h, p->heading[i], phi, chi);
    s->height = (1 - z * phi) * (s->height + h * a) + h * h * ((phi - chi) * mean - (1 - z) * p->moment[0][i]);
    slope_weigh(s, h, mean, s->way.curved ? p->mean[1][i] : 0);
}

/* What T varies by within a piece that turns goes partly to the side: T is taken along e half way, and e turns about it. */
static void slope_lean(struct slope *s, const struct way_pieces *p, int i)
{
    int a = p->at[i], b = a + 1;
    double turn = p->length[i] * (p->ex[a] * p->ey[b] - p->ey[a] * p->ex[b]);
    s->slope -= turn * p->moment[1][i];
    s->across += turn * p->moment[0][i];
}

static void slope_piece(struct slope *s, const struct way_pieces *p, int i)
{
    double h = p->length[i], ex, ey, a, mean, sideways;
    slope_fill(s, p->interval[i]);
    if (s->way.curved) {
        slope_halfway(p, i, &ex, &ey);
        slope_face(s, p->ex[p->at[i]], p->ey[p->at[i]]);
        slope_face(s, ex, ey);
        s->across = p->heading[i] * slope_step(s, p, i, 1, s->across * p->heading[i], &sideways);
    }
    a = s->slope * p->heading[i];
    double b = slope_step(s, p, i, 0, a, &mean);
    if (s->rising)
        slope_rise(s, p, i, a);
    s->travelled[p->interval[i]] += h;
    if (s->crossing)
        s->crossed[p->interval[i]] += s->power == 1 ? crossed_slope(h, a, b, mean)
                                                    : crossed_power(h, (double[]){a, 1.5 * mean - 0.25 * (a + b), b}, s->power);
    s->slope = b * p->heading[i];
    if (s->way.curved) {
        slope_lean(s, p, i);
        slope_face(s, p->ex[p->at[i] + 1], p->ey[p->at[i] + 1]);
    }
}

static void slope_use(void *self, const struct way_pieces *p)
{
    for (int i = 0; i < p->n; i++)
        slope_piece(self, p, i);
}

bool slope_make(struct slope *s, struct stage_run *r, struct err *e)
{
    double given = r->contact->contact.leak;
    s->leak = given > 0 ? given : SLOPE_LEAK;
    s->power = r->contact->contact.beta2;
    s->radius = r->contact->scraper.radius;
    s->alpha = -1;
    s->flat[0] = s->flat[1] = 1;
    s->way.use = slope_use;
    s->way.self = s;
    if (!way_make(&s->way, r, WAY_ALONG, s->leak / 16, e))
        return false;
    s->ridges = s->way.curved && r->board->relief->along == ALONG_X;
    s->levels = !s->way.curved ? 2 : s->ridges ? 4 : 6;
    s->bend = s->way.limiter ? limiter_constant(r->contact) / s->radius : 0;
    if (!s->way.curved && r->board->relief->along == ALONG_X)
        s->flat[0] = s->flat[1] = s->way.e[0] * s->way.e[0];
    return true;
}

void slope_run(struct slope *s, const struct stage_run *r, long first, int n)
{
    memset(s->crossed, 0, sizeof s->crossed);
    memset(s->travelled, 0, sizeof s->travelled);
    s->filled = 0;
    way_run(&s->way, r, first, n);
    slope_fill(s, n);
}

/* Of the normal equations' row k what rows before it have is taken out; without a division, and where no more than rounding is left of it, wholly. */
static bool level_row(double g[][SLOPE_LEVELS + 1], const bool *kept, int n, int k)
{
    double whole = g[k][k];
    for (int j = 0; j < k; j++) {
        double pivot = g[j][j], by = g[k][j];
        for (int i = j; i <= n && kept[j]; i++)
            g[k][i] = pivot * g[k][i] - by * g[j][i];
        whole *= kept[j] ? pivot : 1;
    }
    return g[k][k] > 1e-9 * whole;
}

void slope_level(const struct slope *s, double level[SLOPE_LEVELS])
{
    double g[SLOPE_LEVELS][SLOPE_LEVELS + 1];
    bool kept[SLOPE_LEVELS];
    int n = s->levels;
    for (int k = 0; k < n; k++) {
        for (int j = 0; j < n; j++)
            g[k][j] = s->gone[k > j ? k : j][k > j ? j : k];
        g[k][n] = s->bent[k];
    }
    for (int k = 0; k < n; k++)
        kept[k] = level_row(g, kept, n, k);
    for (int k = n - 1; k >= 0; k--) {
        level[k] = kept[k] ? g[k][n] : 0;
        for (int j = k + 1; j < n && kept[k]; j++)
            level[k] -= level[j] * g[k][j];
        level[k] = kept[k] ? level[k] / g[k][k] : 0;
    }
}
