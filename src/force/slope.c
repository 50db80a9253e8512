/* One limited trajectory S along the path, its slope and its height.

     dS'/ds + S'/l = T(c) + kappa S_n       S' = dS/ds, slope of S along the path; s arc length      after papers/000
   eq. 4, 5 dS_n/ds + S_n/l = T(d) - kappa S'      S_n, slope across the path (only where the path is curved) dS/ds +
   S/l = S'                       S, height, m           (read by what rolls with penetration: paper)

     c = e' H e, d = e' H n   second derivatives of z along the unit tangent e, and mixed with the normal n, 1/m; H the
   surface's Hessian l     contact.leak, m    kappa    curvature of the path in the plane, 1/m    T    tanh(alpha c) /
   alpha

   The paper defines only S'' (equations 4, 5) but uses S' in equation 3 and S in equation 16; the integral of the
   limited curvature drifts away as a random walk, hence the leak l, twice. Slope and height come from one trajectory:
   the raw slope z' would bring back what the limiter removed. (S', S_n) is one vector, the slope of S in the plane;
   kappa turns it as the path turns, so that a tight turn and a reversal, where S' changes sign, are the same thing in
   the limit. Along a profile that follows the path there is no S_n. All start from 0 at the start of the motion.

   Over a piece of length h (z = h/l <= 1/16, phi(z) = (1 - e^-z)/z, chi = (1 - phi)/z)

     S'(end)           = (1 - z phi) S' + phi h mean(T) + z (1 - z/2) h moment(T)
     integral of S' ds = h (phi S' + chi h mean(T) - (1 - z/2) h moment(T) + z h (mean(T) - (T_start + T_end)/2) / 60)
     S(end)            = (1 - z phi) (S + h S') + h^2 ((phi - chi) mean(T) - (1 - z) moment(T))

   mean and first moment of T in closed form (surface/limited.c), the last term of the second line as of a parabola.
   Left out is the leak's weight beyond its straight line: z^2/24 of what T varies by within the piece, of S z h^2/12
   times it and 9/20 z^2 of the moment's part. The turn of a piece is taken half before, half after it (error (kappa
   h)^2/24 of the piece's part), with kappa h moment(T) of T across it. Where S' changes sign inside a piece it is taken
   as a parabola (power 1) or two straight lines. */
#include "force/slope.h"

#include <math.h>
#include <string.h>

#include "force/crossing.h"

static void slope_fill(struct slope *s, int upto)
{
    for (; s->filled < upto; s->filled++) {
        s->ends[s->filled] = s->slope;
        s->heights[s->filled] = s->height;
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
    if (s->ex != 0 || s->ey != 0) slope_rotate(s, s->ex * ey - s->ey * ex, s->ex * ex + s->ey * ey);
    s->ex = ex;
    s->ey = ey;
}

/* The unit vector half way between the axes at a piece's two ends, which are never opposed (force/way.c). */
static void slope_halfway(const struct way_pieces *p, int i, double *ex, double *ey)
{
    double x = p->ex[p->at[i]] + p->ex[p->at[i] + 1], y = p->ey[p->at[i]] + p->ey[p->at[i] + 1],
           length = sqrt(x * x + y * y);
    *ex = x / length;
    *ey = y / length;
}

/* Height at the piece's end, from the slope at its start in the direction of travel. */
static double slope_rise(const struct slope *s, const struct way_pieces *p, int i, double a)
{
    double h = p->length[i], z = s->terms.z[i], phi = s->terms.phi[i], chi = s->terms.chi[i];
    return s->terms.kept[i] * (s->height + h * a) + h * h * ((phi - chi) * p->mean[0][i] - (1 - z) * p->moment[0][i]);
}

/* Length times the sine of the angle by which a piece turns on the way. */
static double slope_turn(const struct way_pieces *p, int i)
{
    int a = p->at[i], b = a + 1;
    return p->length[i] * (p->ex[a] * p->ey[b] - p->ey[a] * p->ex[b]);
}

/* What T varies by within a piece that turns goes partly to the side: T is taken along e half way, and e turns about
 * it. */
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
    if (s->rising) s->height = slope_rise(s, p, i, a);
    s->slope = b * p->heading[i];
    if (s->way.curved) {
        slope_lean(s, p, i);
        slope_face(s, p->ex[p->at[i] + 1], p->ey[p->at[i] + 1]);
    }
}

/* The same of a straight way whose slope alone is asked for. Each piece waits for the one before it, for a
   multiplication and an addition: the sign of the direction is taken out of that, and each piece writes its
   sub-interval's end, the last of them what stays. */
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
        struct crossing c = crossing_power(
            (double[]){t->start[i], 1.5 * t->mean[i] - 0.25 * (t->start[i] + t->end[i]), t->end[i]}, s->power);
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
    if (s->crossing) slope_crossing(s, p->n);
    slope_gather(s, p);
}

bool slope_make(struct slope *s, struct stage_run *r, struct err *e)
{
    double given = r->contact->contact.leak;
    s->leak = given > 0 ? given : SLOPE_LEAK;
    s->power = r->contact->contact.beta2;
    s->way.use = slope_use;
    s->way.self = s;
    return way_make(&s->way, r, WAY_ALONG, s->leak / 16, e);
}

void slope_forget(struct slope *s) { s->slope = s->across = s->height = s->ex = s->ey = 0; }

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
