/* One limited trajectory S along the path, its slope and its height.

     dS'/ds + S'/l = T(c) + kappa S_n     slope along the path, after papers/000 eq. 4, 5
     dS_n/ds + S_n/l = T(d) - kappa S'    slope across the path (only where the path is curved)
     dS/ds + S/l = S'                     height, m (read by what rolls with penetration: paper)

     kappa    1/m, curvature of the path in the plane; the other symbols: path_integral.h

   The paper defines only S'' (equations 4, 5) but uses S' in equation 3 and S in equation 16; the integral of the
   limited curvature drifts away as a random walk, hence the leak l, twice. Slope and height come from one trajectory:
   the raw slope z' would bring back what the limiter removed. (S', S_n) is one vector, the slope of S in the plane;
   kappa turns it as the path turns, so that a tight turn and a reversal, where S' changes sign, are the same thing in
   the limit. Along a profile that follows the path there is no S_n. All start from 0 at the start of the motion.

   Over a cell of length h (z = h/l <= 1/16, phi(z) = (1 - e^-z)/z, chi = (1 - phi)/z)

     S'(end)           = (1 - z phi) S' + phi h mean(T) + z (1 - z/2) h moment(T)
     integral of S' ds = h (phi S' + chi h mean(T) - (1 - z/2) h moment(T) + z h (mean(T) - (T_start + T_end)/2) / 60)
     S(end)            = (1 - z phi) (S + h S') + h^2 ((phi - chi) mean(T) - (1 - z) moment(T))

   mean and first moment of T in closed form (surface/limiter.c), the last term of the second line as of a parabola.
   Left out is the leak's weight beyond its straight line: z^2/24 of what T varies by within the cell, of S z h^2/12
   times it and 9/20 z^2 of the moment's part. The turn of a cell is taken half before, half after it (error (kappa
   h)^2/24 of the cell's part), with kappa h moment(T) of T across it. Where S' changes sign inside a cell it is taken
   as a parabola (power 1) or two straight lines. */
#include "force/path_integral.h"

#include <math.h>
#include <string.h>

#include "force/scrape.h"
#include "num/lanes.h"
#include "num/vecmath.h"

/* ------------------------------------------------------------------ terms */

#define PATH_LEAK 2e-3 /* m, where the scene has no contact.leak: under a ball with contact.force: paper */
#define INLINE static inline __attribute__((always_inline))

/* Up to what channel 0 gains. phi = (1 - e^-z) / z and chi = (1 - phi) / z for 0 <= z <= 1/16: the series' first term
   left out is z^8 / 9! < 1e-15. */
LANES_CLONES
static void terms_first(struct path_terms *t, const struct cells *p, double leak)
{
    const double *mean_t = p->mean[0], *moment_t = p->moment[0], *limited = p->limited[0], *length = p->length;
    const int *at = p->at;
    double per_leak = 1 / leak;
    int n = p->n;
#pragma omp simd
    for (int i = 0; i < n; i++) {
        double h = length[i], z = h * per_leak, third = z * (1.0 / 3), fifth = z * (1.0 / 5), seventh = z * (1.0 / 7);
        double rest = 1 - third * (1 - z / 4 * (1 - fifth * (1 - 0.5 * third * (1 - seventh * (1 - z / 8)))));
        double phi = 1 - z / 2 * rest, chi = 0.5 * rest, moment = (1 - z / 2) * h * moment_t[i];
        double bow = z * h * (mean_t[i] - 0.5 * (limited[at[i]] + limited[at[i] + 1])) * (1.0 / 60);
        t->z[i] = z;
        t->phi[i] = phi;
        t->chi[i] = chi;
        t->decay[i] = 1 - z * phi;
        t->bent[0][i] = phi * h * mean_t[i] + z * moment;
        t->risen[i] = chi * h * mean_t[i] - moment + bow;
    }
}

LANES_CLONES
static void terms_second(struct path_terms *t, const struct cells *p)
{
    int n = p->n;
#pragma omp simd
    for (int i = 0; i < n; i++)
        t->bent[1][i] = p->length[i] * (t->phi[i] * p->mean[1][i] + t->z[i] * (1 - t->z[i] / 2) * p->moment[1][i]);
}

void path_integral_terms(struct path_terms *t, const struct cells *p, int channels, double leak)
{
    terms_first(t, p, leak);
    if (channels == 2) terms_second(t, p);
}

LANES_CLONES
void path_integral_mean(struct path_terms *t, int n)
{
#pragma omp simd
    for (int i = 0; i < n; i++)
        t->mean[i] = t->phi[i] * t->start[i] + t->risen[i];
}

/* Of |S'| over a cell on which S' goes from a to b, with that mean: of the parabola a (1 - q) + b q + bow q (1 - q),
   which has one zero between ends of opposite signs. Both outcomes of every question are worked out. */
LANES_CLONES
void path_integral_magnitude(struct path_terms *t, int n)
{
#pragma omp simd
    for (int i = 0; i < n; i++) {
        double a = t->start[i], b = t->end[i], mean = t->mean[i];
        double bow = 6 * (mean - 0.5 * (a + b)), p = b - a + bow, square = p * p + 4 * bow * a;
        double root = sqrt(lanes_select(square > 0, square, 0)), s = lanes_select(p < 0, p - root, p + root);
        double q = lanes_select(s != 0, -2 * a / lanes_select(s != 0, s, 1), 0),
               late = 0.5 * mean + (b - a) * (1.0 / 12);
        int inside = (q >= 0) & (q <= 1);
        q = lanes_select(inside, q, s / lanes_select(inside | (bow == 0), 1, 2 * bow));
        double before = q * (a + q * (0.5 * p - q * bow * (1.0 / 3))),
               lately = q * q * (0.5 * a + q * (p * (1.0 / 3) - 0.25 * q * bow));
        int one_sign = a * b >= 0;
        t->whole[i] = lanes_select(one_sign, fabs(mean), fabs(before) + fabs(mean - before));
        t->late[i] = lanes_select(one_sign, lanes_select(mean < 0, -late, late), fabs(lately) + fabs(late - lately));
    }
}

/* Of |S'|^power over a cell: Simpson's rule, or two powers of straight lines on each side of a zero. */
struct magnitude path_integral_power(const double s[3], double power)
{
    double p[3] = {fabs(s[0]), fabs(s[1]), fabs(s[2])}, q = p[0] / (s[0] * s[2] < 0 ? p[0] + p[2] : 1);
    if (power != 1) vecmath_pow(3, p, power, p);
    double before = p[0] * q / (1 + power), after = p[2] * (1 - q) / (1 + power);
    if (s[0] * s[2] < 0)
        return (struct magnitude){before + after, before * q / (2 + power) + after * (1 - (1 - q) / (2 + power))};
    return (struct magnitude){(p[0] + 4 * p[1] + p[2]) / 6, (2 * p[1] + p[2]) / 6};
}

/* ------------------------------------------------------------------ slope */

/* The slope of S is one vector in the plane, whose axes do not turn: what the leak leaves of it and what each cell
   adds, both known beforehand, are all that waits for the cell before. Along a straight path its first part is dS/du,
   and there is no other. */

static void slope_fill(struct path_integral *s, int upto)
{
    for (; s->filled < upto; s->filled++) {
        s->ends[s->filled] = s->facing;
        s->heights[s->filled] = s->height;
    }
}

/* Of a path that turns: the direction half way, and what the cell adds to the slope. What T varies by within a cell
   that turns goes partly to the side: T is taken along e half way, e turns. */
LANES_CLONES
static void slope_gains_turning(struct path_integral *s, const struct cells *p)
{
    const struct path_terms *t = &s->terms;
    struct slope_cells *c = &s->slopes;
    const double *ex = p->ex, *ey = p->ey;
    int n = p->n;
#pragma omp simd
    for (int i = 0; i < n; i++) {
        int a = p->at[i], b = a + 1;
        double x = ex[a] + ex[b], y = ey[a] + ey[b], per = 1 / sqrt(x * x + y * y), heading = p->heading[i];
        double turn = p->length[i] * (ex[a] * ey[b] - ey[a] * ex[b]);
        double along = heading * (t->bent[0][i] - turn * p->moment[1][i]),
               across = heading * (t->bent[1][i] + turn * p->moment[0][i]);
        x *= per;
        y *= per;
        c->e[0][i] = x;
        c->e[1][i] = y;
        c->gain[0][i] = along * x - across * y;
        c->gain[1][i] = along * y + across * x;
        c->turned[i] = p->length[i] * turn * p->mean[1][i] / 6;
    }
}

LANES_CLONES
static void slope_gains_straight(struct path_integral *s, const struct cells *p)
{
    int n = p->n;
#pragma omp simd
    for (int i = 0; i < n; i++)
        s->slopes.gain[0][i] = p->heading[i] * s->terms.bent[0][i];
}

/* x[i + 1] = decay[i] x[i] + gain[i]. */
LANES_CLONES
static void slope_chain(double *restrict x, const double *decay, const double *gain, int n)
{
    for (int i = 0; i < n; i++)
        x[i + 1] = fma(decay[i], x[i], gain[i]);
}

/* start[], end[] and facing[] from the slope before and after each cell. */
LANES_CLONES
static void slope_ends(struct path_integral *s, const struct cells *p)
{
    struct path_terms *t = &s->terms;
    struct slope_cells *c = &s->slopes;
    const double *x = c->slope[0], *y = c->slope[1], *ex = p->ex, *ey = p->ey;
    int turning = s->cells.curved ? p->n : 0, straight = p->n - turning;
#pragma omp simd
    for (int i = 0; i < turning; i++) {
        int b = p->at[i] + 1;
        double start = p->heading[i] * (x[i] * c->e[0][i] + y[i] * c->e[1][i]);
        t->start[i] = start;
        t->end[i] = path_terms_end(t, 0, i, start);
        c->facing[i] = x[i + 1] * ex[b] + y[i + 1] * ey[b];
    }
#pragma omp simd
    for (int i = 0; i < straight; i++) {
        double start = p->heading[i] * x[i];
        t->start[i] = start;
        t->end[i] = path_terms_end(t, 0, i, start);
        c->facing[i] = x[i + 1];
    }
}

/* S at each cell's end, from S' at its start. */
static void slope_heights(struct path_integral *s, const struct cells *p)
{
    const struct path_terms *t = &s->terms;
    double *rise = s->slopes.rise;
    for (int i = 0; i < p->n; i++) {
        double h = p->length[i], z = t->z[i];
        rise[i] = t->decay[i] * (h * t->start[i]) +
                  h * h * ((t->phi[i] - t->chi[i]) * p->mean[0][i] - (1 - z) * p->moment[0][i]);
    }
    slope_chain(s->slopes.height, t->decay, rise, p->n);
}

/* whole[], late[] of |S'|^power. */
static void slope_crossing(struct path_integral *s, int n)
{
    struct path_terms *t = &s->terms;
    if (s->power == 1) {
        path_integral_magnitude(t, n);
        return;
    }
    for (int i = 0; i < n; i++) {
        struct magnitude c = path_integral_power(
            (double[]){t->start[i], 1.5 * t->mean[i] - 0.25 * (t->start[i] + t->end[i]), t->end[i]}, s->power);
        t->whole[i] = c.whole;
        t->late[i] = c.late;
    }
}

/* To the cells' sub-intervals: how far they are, how S' goes over them, S' and S at their ends. */
static void slope_gather(struct path_integral *s, const struct cells *p)
{
    const struct path_terms *t = &s->terms;
    const struct slope_cells *c = &s->slopes;
    bool crossing = s->crossing, curved = s->cells.curved;
    for (int i = 0; i < p->n; i++) {
        double h = p->length[i];
        int k = p->interval[i];
        slope_fill(s, k);
        s->facing = c->facing[i];
        if (s->rising) s->height = c->height[i + 1];
        if (crossing) {
            s->crossed[k] += h * t->whole[i];
            s->crossed_late[k] += h * (s->travelled[k] * t->whole[i] + h * t->late[i]);
        }
        s->climbed[k] += h * t->mean[i] + (curved ? c->turned[i] : 0);
        s->travelled[k] += h;
    }
}

static void slope_use(void *self, const struct cells *p)
{
    struct path_integral *s = self;
    struct slope_cells *c = &s->slopes;
    int parts = s->cells.curved ? 2 : 1;
    path_integral_terms(&s->terms, p, parts, s->leak);
    if (parts == 2)
        slope_gains_turning(s, p);
    else
        slope_gains_straight(s, p);
    for (int k = 0; k < parts; k++)
        slope_chain(c->slope[k], s->terms.decay, c->gain[k], p->n);
    slope_ends(s, p);
    if (s->rising) slope_heights(s, p);
    path_integral_mean(&s->terms, p->n);
    if (s->crossing) slope_crossing(s, p->n);
    slope_gather(s, p);
    for (int k = 0; k < parts; k++)
        c->slope[k][0] = c->slope[k][p->n];
    c->height[0] = c->height[p->n];
}

bool path_integral_make(struct path_integral *s, struct stage_run *r, struct err *e)
{
    const struct scrape_law *law = scrape_law(r->contact);
    s->leak = law->leak > 0 ? law->leak : PATH_LEAK;
    s->power = law->beta2;
    s->cells.integrate = slope_use;
    s->cells.self = s;
    return path_cells_make(&s->cells, r, CELLS_ALONG, s->leak / 16, e);
}

void path_integral_reset(struct path_integral *s)
{
    s->slopes.slope[0][0] = s->slopes.slope[1][0] = s->slopes.height[0] = s->facing = s->height = 0;
}

void path_integral_run(struct path_integral *s, const struct stage_run *r, long first, int n)
{
    memset(s->crossed, 0, sizeof s->crossed);
    memset(s->crossed_late, 0, sizeof s->crossed_late);
    memset(s->climbed, 0, sizeof s->climbed);
    memset(s->travelled, 0, sizeof s->travelled);
    s->filled = 0;
    s->before = s->height;
    s->rising = s->rising || board_has(r->board, ITEM_FOLLOWED);
    path_cells_run(&s->cells, r, first, n);
    slope_fill(s, n);
}

void path_integral_rest(struct path_integral *s, int n)
{
    s->filled = 0;
    s->before = s->height;
    slope_fill(s, n);
}

/* ------------------------------------------------------------------ what diagnostics have of it */

double path_integral_ground(const struct path_integral *s, const struct board *b, long k)
{
    const struct path_cells *w = &s->cells;
    double u = cells_values(b, ITEM_POSITION, k)[0], z;
    double x = w->curved ? cells_values(b, ITEM_X, k)[0] : w->from[0] + u * w->e[0];
    double y = w->curved ? cells_values(b, ITEM_Y, k)[0] : w->from[1] + u * w->e[1];
    const double *across = w->relief->along == ALONG_PLANE ? &y : NULL;
    relief_at(w->relief, &(struct relief_points){1, &x, across}, &(struct relief_values){.z = &z});
    return z;
}

void path_integral_note(const struct path_integral *s, struct board *b, long first, int n)
{
    for (int i = 0; board_has(b, ITEM_FOLLOWED) && i < n; i++) {
        if ((first + i) % b->over != 0) continue;
        double *value = board_at(b, ITEM_FOLLOWED, (first + i) / b->over);
        value[FOLLOWED_GROUND] = path_integral_ground(s, b, first + i);
        value[FOLLOWED_TRAJECTORY] = i > 0 ? s->heights[i - 1] : s->before;
    }
}

/* ------------------------------------------------------------------ lift */

/* The force jumps where the normal force N(t) passes through 0, at the share q0 = a / (a - b) of a
   sub-interval in which N goes from a to b. A force f = f_0 + g q has

     early = integral of (1 - q) f dq = f_0/2 + g/6        late = integral of q f dq = f_0/2 + g/3

   and of these the integrals from 0 to q0, or from q0 to 1, are taken instead. What is left out is f'' dt^2 and N''
   dt^2 over the one sub-interval: a jump, whose place is known to second order. */

const double *path_integral_load(const struct board *b, long first)
{
    return board_has(b, ITEM_LOAD) ? cells_values(b, ITEM_LOAD, first) : NULL;
}

double path_integral_pressed(double a, double b)
{
    double most = fmax(a, b), least = fmin(a, b);
    return least >= 0 ? 1 : most > 0 ? most / (most - least) : 0;
}

void path_integral_cut(double a, double b, double *early, double *late)
{
    double share = path_integral_pressed(a, b), from = a < 0 ? 1 - share : 0, to = a < 0 ? 1 : share;
    if (share == 1) return;
    double start = 4 * *early - 2 * *late, rise = 6 * (*late - *early), square = to * to - from * from,
           cube = to * to * to - from * from * from;
    double whole = start * share + 0.5 * rise * square;
    *late = 0.5 * start * square + rise * cube / 3;
    *early = whole - *late;
}

void path_integral_lifted(struct board *b, long first, int n)
{
    const double *load = path_integral_load(b, first);
    for (int i = 0; load && i < n; i++)
        if ((first + i) / b->over < b->moving - 1)
            b->lifted += (1 - path_integral_pressed(load[i], load[i + 1])) / (b->rate * b->over);
}

/* ------------------------------------------------------------------ bsplines */

void path_integral_add(struct bspline *h, struct board *b, long first, int n)
{
    double *force = cells_values(b, ITEM_SUBFORCE, first);
    const double *load = path_integral_load(b, first);
    if (!load && n > 0) {
        force[0] += h->carried + h->early[0];
        for (int i = 1; i < n; i++)
            force[i] += h->late[i - 1] + h->early[i];
        h->carried = h->late[n - 1];
        return;
    }
    for (int i = 0; i < n; i++) {
        double early = h->early[i], late = h->late[i];
        if (load) path_integral_cut(load[i], load[i + 1], &early, &late);
        force[i] += h->carried + early;
        h->carried = late;
    }
}

void path_integral_lay(struct bspline *h, struct board *b, long first, int n)
{
    double *force = cells_values(b, ITEM_SUBFORCE, first);
    for (int i = 0; i < n; i++)
        force[i] = 0;
    path_integral_add(h, b, first, n);
    path_integral_lifted(b, first, n);
}
