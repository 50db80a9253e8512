#include "response/radiator.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "num/lanes.h"
#include "num/real.h"
#include "num/vecmath.h"

/* One coordinate cut into panels for Gauss-Legendre's rule, fine enough for what turns and for what is nearly singular.
 */
enum { PANELS_MOST = 4096, PANELS_POINTS = 12 /* most in a panel */ };

struct panels {
    double low, high;
    double wave;         /* rad per unit of the coordinate, by which the integrand turns        */
    double foot, height; /* where it is singular: real part, imaginary part of the coordinate   */
    int n;               /* panels */
    double ends[PANELS_MOST + 1];
};

/* Pulsating sphere (Morse and Ingard, Theoretical Acoustics, 7.1; Kinsler et al., Fundamentals of Acoustics, 7.1):
   surface velocity v on a sphere of radius a makes at the distance r > a of its middle the pressure

       p = rho c v (a / r) j k a / (1 + j k a) e^(-j k (r - a)) ,   k = w / c ,

   that is, without the delay (r - a)/c, p = H(s) v with

       H(s) = K s / (s + w) ,   K = rho c a / r (Pa per m/s) ,   w = c / a (1/s) .

   A velocity that is Im sum A_i e^(s_i t) from t = 0 on becomes, by partial fractions, exactly

       p(t) = Im sum A_i H(s_i) e^(s_i t)  +  e^(-w t) Im sum A_i K w / (s_i + w) :

   modes of other gains, and one component of the radiator's own, of 0 Hz. s_i + w = 0 cannot be, as the frequency of no
   mode is 0. No response at 0 Hz (H(0) = 0), so no direct term: modes_direct's sum over all components is 0 but for
   rounding.

   A sampled response stands for the continuous one while it does not decay within a sample. The own component is kept
   while w <= 2.4 rate (a = 3 mm at 48 kHz); of a smaller object it is left out, and modes_direct, whose sum is then Im
   sum A_i K / (s_i + w), puts its whole area at t = 0: K/w = rho a^2 / r is then all that counts, and the pressure is
   the acceleration of a volume. What is lost is the fraction j w_audio / w of that one component. (At 2.4 both ways are
   off alike; a small object's own pole, sampled, would be far too loud: by w / (2 rate).) */

#define FASTEST 2.4 /* own pole over sample rate */

struct radiator_monopole radiator_monopole(double radius, double distance, double density, double sound_speed)
{
    return (struct radiator_monopole){density * sound_speed * radius / distance, sound_speed / radius};
}

/* factor / (s + w) */
static void over(const struct radiator_monopole *m, const double s[2], const double factor[2], double q[2])
{
    double x = s[0] + m->pole, y = s[1], power = x * x + y * y;
    q[0] = (factor[0] * x + factor[1] * y) / power;
    q[1] = (factor[1] * x - factor[0] * y) / power;
}

void radiator_monopole_at(const struct radiator_monopole *m, const double s[2], double h[2])
{
    over(m, s, (const double[2]){m->gain * s[0], m->gain * s[1]}, h);
}

void radiator_monopole_own(const struct radiator_monopole *m, const double s[2], double share[2])
{
    over(m, s, (const double[2]){m->gain * m->pole, 0}, share);
}

bool radiator_monopole_sampled(const struct radiator_monopole *m, double rate) { return m->pole <= FASTEST * rate; }

/* e^(j k x) over a panel of width W needs about W k / 2 points of Gauss-Legendre's rule, and
   then each one more takes the error down by orders of magnitude: 12 points over 4 pi of phase leave 4e-12. A
   singularity j d above or below the panel's middle leaves about (u + sqrt(u^2 + 1))^(-24), u = 2 d / W: 7e-10 at d =
   W/2. */

/* Nodes and weights on [-1, 1] by Newton's method on Legendre's polynomial; its start is within the reach of the root
 * next to it. */
static void rule(int n, double *x, double *w)
{
    for (int k = 0; k < n; k++) {
        double at = real_cospi((k + 0.75) / (n + 0.5)), slope = 1;
        for (int step = 0; step < 8; step++) {
            double p = at, before = 1;
            for (int j = 2; j <= n; j++) {
                double next = ((2 * j - 1) * at * p - (j - 1) * before) / j;
                before = p;
                p = next;
            }
            slope = n * (at * p - before) / (at * at - 1);
            at -= p / slope;
        }
        x[k] = at;
        w[k] = 2 / ((1 - at * at) * slope * slope);
    }
}

static double far_of(const struct panels *x, double low, double high)
{
    double beside = x->foot < low ? low - x->foot : x->foot > high ? x->foot - high : 0;
    return sqrt(beside * beside + x->height * x->height);
}

/* Adds the panels between low and high: each no wider than 4 pi of phase, and no wider than twice its distance from the
   singularity. False: too many. */
static bool panels_split(struct panels *x, double low, double high)
{
    if (x->n == PANELS_MOST) return false;
    double middle = 0.5 * (low + high), width = high - low;
    if (width * x->wave > 4 * REAL_PI || width > 2 * far_of(x, low, high))
        return middle > low && middle < high && panels_split(x, low, middle) && panels_split(x, middle, high);
    x->ends[x->n++] = low;
    x->ends[x->n] = high;
    return true;
}

/* Nodes and weights, `points` to a panel; returns how many there are. */
static int panels_points(const struct panels *x, int points, double *at, double *weight)
{
    double node[PANELS_POINTS], share[PANELS_POINTS];
    rule(points, node, share);
    for (int k = 0; k < x->n; k++)
        for (int i = 0; i < points; i++) {
            double half = 0.5 * (x->ends[k + 1] - x->ends[k]);
            at[k * points + i] = x->ends[k] + half * (1 + node[i]);
            weight[k * points + i] = half * share[i];
        }
    return x->n * points;
}

/* Rayleigh's integral (Rayleigh, Theory of Sound II, 278; Fahy and Gardonio, Sound and Structural Vibration, 3.2): a
   flat surface that moves with the normal velocity v_n(y) e^(s t) in an infinite rigid baffle, z = 0, makes at the
   place x, z > 0, the pressure

       p(x) e^(s t) ,   p(x) = (s rho / 2 pi) int v_n(y) e^(-s R / c) / R dS ,   R = |x - y| ,

   here at each mode's own pole s_i = -decay + j 2 pi f (so that its free decay is exact, not that of the undamped mode
   at j 2 pi f). The modes' gains are made with a reference place l as the one that is heard, A_i(y) = const phi_i(y)
   phi_i(l), hence

       factor_i = (s_i rho / 2 pi) int phi_i(y)/phi_i(l) e^(-s_i (R - R_0) / c) / R dS ,

   R_0 the distance of the object's centre, whose delay R_0/c is left to the caller.

   What is exact. Air that is in motion already: the pressure from the moment on at which the wave of the farthest place
   of the rim has come by, R_max/c after a force has acted. Before that the true pressure grows as one place after the
   other is heard, from R_min/c on; here all of a mode is heard from R_0/c on. A bounded surface at rest makes no
   constant pressure, so the whole response's area is 0; what the early part lacks of it is put in at t = 0 by
   modes_direct, which takes a pressure like an acceleration: it is exact at 0 Hz, and off at frequencies whose waves
   are not long beside the plate, in the first R_max - R_0 of the response.

   Quadrature. Rectangles in x and y, circles in r and angle, Gauss-Legendre's rule of 12 points on panels, each no
   wider than 4 pi of the phase of shape and sound together, and no wider than twice its distance from where R = 0 (in
   the complex plane: the foot of the listening place, z above). Panels are halved until rules of 10 and 12 points
   differ by less than 1e-9 of int |phi_i|/R dS in every mode; measured by refinement the 12 points are then within
   1e-11 of it. */

enum { MOST_PLACES = 96, COARSE = 10, FINE = PANELS_POINTS, HALVINGS = 6 };

#define SETTLED 1e-9
#define MOST_POINTS 2e7

/* Cycles of an element dS, of each mode in it, of each product that its shape is the sum of. */
#define ELEMENT 400.0
#define SHAPED 16.0
#define SUMMED 0.25

/* ------------------------------------------------------------------ the outline */

static bool is_round(const struct object *o) { return o->shape == OBJECT_DISK || o->shape == OBJECT_DRUM; }

static double centre(const struct object *o, int axis)
{
    return is_round(o) ? 0 : 0.5 * (o->low[axis] + o->high[axis]);
}

double radiator_plate_distance(const struct object *o, const double origin[2], const double place[3])
{
    double dx = place[0] - origin[0] - centre(o, 0), dy = place[1] - origin[1] - centre(o, 1);
    return sqrt(dx * dx + dy * dy + place[2] * place[2]);
}

/* Places in golden steps over the box, then a bit inside its corners, where a free edge moves most. */
static void candidate(const struct object *o, int k, double place[2])
{
    double share[2] = {0.5 + 0.7548776662466927 * k, 0.5 + 0.5698402909980532 * k};
    for (int i = 0; i < 2; i++) {
        double u = k < MOST_PLACES - 4 ? share[i] - floor(share[i]) : (k >> i & 1) ? 0.997 : 0.003;
        place[i] = o->low[i] + u * (o->high[i] - o->low[i]);
    }
}

void radiator_plate_reference(const struct object *o, struct arena *a, double place[2])
{
    double *phi = ARENA_TAKE(a, double, (size_t)MOST_PLACES * o->n), *most = ARENA_TAKE(a, double, o->n), best = -1;
    bool off[MOST_PLACES];
    for (int k = 0; k < MOST_PLACES; k++) {
        double at[2];
        candidate(o, k, at);
        off[k] = o->shapes(o, at[0], at[1], phi + (size_t)k * o->n) > 0;
        for (int i = 0; i < o->n; i++)
            most[i] = fmax(most[i], fabs(phi[(size_t)k * o->n + i]));
    }
    for (int k = 0; k < MOST_PLACES; k++) {
        double least = HUGE_VAL;
        for (int i = 0; i < o->n; i++)
            least = fmin(least, most[i] > 0 ? fabs(phi[(size_t)k * o->n + i]) / most[i] : 0);
        if (!off[k] && least > best) {
            best = least;
            candidate(o, k, place);
        }
    }
}

/* ------------------------------------------------------------------ the integral */

struct work {
    const struct radiator_plate *given;
    int n;
    double far;              /* m, R_0 */
    struct panels *axes;     /* [2]: x and y, or r and angle */
    double *inverse;         /* [n]: 1/phi(l) */
    double *grow, *turn, *c; /* [n] */
    double *sum[2], *size;   /* [n] */
};

/* Adds the element dS at y (the object's coordinates), where the shapes are phi. */
LANES_CLONES
static void element(const struct work *w, double x, double y, double dS, const double *phi)
{
    const struct radiator_plate *p = w->given;
    const struct modes *m = p->modes;
    double dx = p->place[0] - p->origin[0] - x, dy = p->place[1] - p->origin[1] - y, z = p->place[2];
    double R = sqrt(dx * dx + dy * dy + z * z), late = (R - w->far) / p->sound_speed, share = dS / R;
    double *grow = w->grow, *turn = w->turn, *c = w->c, *re = w->sum[0], *im = w->sum[1], *size = w->size;
#pragma omp simd
    for (int i = 0; i < w->n; i++) {
        grow[i] = m->decay[i] * late;
        turn[i] = 2 * m->frequency[i] * late;
    }
    vecmath_exp((size_t)w->n, grow, grow);
    vecmath_sincospi((size_t)w->n, turn, turn, c);
#pragma omp simd
    for (int i = 0; i < w->n; i++) {
        double v = share * phi[i] * w->inverse[i] * grow[i];
        re[i] += v * c[i];
        im[i] -= v * turn[i];
        size[i] += fabs(v);
    }
}

/* All of it, with so many points to a panel: row after row in y, or circles' radii at one angle after the other. */
static void integrate(struct work *w, int points, struct arena *a)
{
    const struct object *o = w->given->object;
    double *at[2], *weight[2];
    int n[2];
    for (int k = 0; k < 2; k++) {
        at[k] = ARENA_TAKE(a, double, w->axes[k].n *points);
        weight[k] = ARENA_TAKE(a, double, w->axes[k].n *points);
        n[k] = panels_points(&w->axes[k], points, at[k], weight[k]);
    }
    double *phi = ARENA_TAKE(a, double, (size_t)n[0] * w->n);
    for (int k = 0; k < 2; k++)
        memset(w->sum[k], 0, (size_t)w->n * sizeof *w->sum[k]);
    memset(w->size, 0, (size_t)w->n * sizeof *w->size);
    for (int j = 0; j < n[1]; j++) {
        double v = at[1][j], c = is_round(o) ? real_cos(v) : 0, s = is_round(o) ? real_sin(v) : 0;
        if (o->row) o->row(o, n[0], at[0], v, phi);
        for (int i = 0; i < n[0]; i++) {
            double u = at[0][i], dS = weight[0][i] * weight[1][j], *shape = phi + (size_t)i * w->n;
            double x = is_round(o) ? u * c : u, y = is_round(o) ? u * s : v;
            if (!o->row) o->shapes(o, x, y, shape);
            element(w, x, y, is_round(o) ? u * dS : dS, shape);
        }
    }
}

/* How fast shapes may turn along the axes, rad/m: n modes of an area fill a disk of wave numbers (Weyl), but those of a
 * strip lie on a line. */
static void waves(const struct radiator_plate *p, double wave[2])
{
    const struct object *o = p->object;
    int n = p->modes->n;
    for (int k = 0; k < 2; k++) {
        double length = o->high[k] - o->low[k], other = o->high[1 - k] - o->low[1 - k];
        wave[k] = is_round(o) ? (2 * sqrt((double)n) + 2) / o->high[0]
                              : fmin(n + 1, 2 * sqrt(n * length / (REAL_PI * other)) + 2) * REAL_PI / length;
    }
}

/* The two axes; `fine` multiplies how fast things are taken to turn. False: too many panels. */
static bool axes_make(struct work *w, double fine)
{
    const struct radiator_plate *p = w->given;
    const struct object *o = p->object;
    double x = p->place[0] - p->origin[0], y = p->place[1] - p->origin[1], z = p->place[2], top = 0, wave[2];
    struct panels *u = &w->axes[0], *v = &w->axes[1];
    for (int i = 0; i < w->n; i++)
        top = fmax(top, 2 * REAL_PI * p->modes->frequency[i] / p->sound_speed);
    waves(p, wave);
    u->n = v->n = 0;
    u->low = o->low[0], u->high = o->high[0], u->wave = fine * (wave[0] + top), u->foot = x, u->height = z / fine;
    v->low = o->low[1], v->high = o->high[1], v->wave = fine * (wave[1] + top), v->foot = y, v->height = z / fine;
    if (is_round(o)) {
        double a = o->high[0], r = sqrt(x * x + y * y), rim = fmin(a, sqrt(r * r + z * z));
        double above =
            r > 0 ? (rim * rim + r * r + z * z) / (2 * rim * r) - 1 : 1e6; /* cosh of the imaginary part, less 1 */
        u->low = 0, u->foot = r;
        v->low = real_atan2(y, x) - REAL_PI, v->high = v->low + 2 * REAL_PI;
        v->wave = a * v->wave, v->foot = v->low + REAL_PI,
        v->height = real_log1p(above + sqrt(above * (above + 2))) / fine;
    }
    return panels_split(u, u->low, u->high) && panels_split(v, v->low, v->high) &&
           (double)u->n * v->n * FINE * FINE < MOST_POINTS;
}

static bool settled(const struct work *w, const double *re, const double *im)
{
    for (int i = 0; i < w->n; i++) {
        double dx = w->sum[0][i] - re[i], dy = w->sum[1][i] - im[i];
        if (!(dx * dx + dy * dy <= SETTLED * SETTLED * w->size[i] * w->size[i])) return false;
    }
    return true;
}

/* 1/phi(l) */
static bool reference_set(struct work *w, struct err *e)
{
    const struct radiator_plate *p = w->given;
    p->object->shapes(p->object, p->reference[0], p->reference[1], w->inverse);
    for (int i = 0; i < w->n; i++) {
        if (w->inverse[i] == 0)
            return err_set(e, ERR_NUMBERS,
                           "%s: the plate's sound cannot be found: the mode of %.6g Hz is still at every place tried",
                           p->modes->name, p->modes->frequency[i]);
        w->inverse[i] = 1 / w->inverse[i];
    }
    return true;
}

static struct work work_make(const struct radiator_plate *p, struct arena *a)
{
    int n = p->modes->n;
    struct work w = {.given = p,
                     .n = n,
                     .far = radiator_plate_distance(p->object, p->origin, p->place),
                     .axes = ARENA_TAKE(a, struct panels, 2)};
    double **arrays[] = {&w.inverse, &w.grow, &w.turn, &w.c, &w.sum[0], &w.sum[1], &w.size};
    for (size_t k = 0; k < sizeof arrays / sizeof arrays[0]; k++)
        *arrays[k] = ARENA_TAKE(a, double, n);
    return w;
}

/* times s rho / (2 pi) */
static void put(const struct work *w, double *re, double *im)
{
    const struct modes *m = w->given->modes;
    for (int i = 0; i < w->n; i++) {
        double scale = w->given->density / (2 * REAL_PI), x = -m->decay[i] * scale,
               y = m->frequency[i] * w->given->density;
        re[i] = x * w->sum[0][i] - y * w->sum[1][i];
        im[i] = x * w->sum[1][i] + y * w->sum[0][i];
    }
}

bool radiator_plate(const struct radiator_plate *p, struct arena *a, double *re, double *im, struct err *e)
{
    struct work w = work_make(p, a);
    double fine = 1;
    if (!(p->place[2] > 0))
        return err_set(e, ERR_SCENE,
                       "output.listen.places: a plate in a baffle is heard from in front of it only: z must be above 0 "
                       "m, not %.6g m",
                       p->place[2]);
    if (!reference_set(&w, e)) return false;
    for (int k = 0; k < HALVINGS && axes_make(&w, fine); k++, fine *= 2) {
        integrate(&w, COARSE, a);
        memcpy(re, w.sum[0], (size_t)w.n * sizeof *re);
        memcpy(im, w.sum[1], (size_t)w.n * sizeof *im);
        integrate(&w, FINE, a);
        if (settled(&w, re, im)) {
            put(&w, re, im);
            return true;
        }
    }
    return err_set(
        e, ERR_NUMBERS,
        "%s: Rayleigh's integral does not settle at [%.6g, %.6g, %.6g] m: listen from farther away, or use fewer modes",
        p->modes->name, p->place[0], p->place[1], p->place[2]);
}

/* Most integrals settle at once; constants measured with 256-bit vectors. */
double radiator_plate_cost(const struct radiator_plate *p, struct arena *a)
{
    struct work w = {.given = p, .n = p->modes->n, .axes = ARENA_TAKE(a, struct panels, 2)};
    double panels =
        p->place[2] > 0 && axes_make(&w, 1) ? (double)w.axes[0].n * w.axes[1].n : 0; /* else it is refused at once */
    return (panels * (COARSE * COARSE + FINE * FINE) + MOST_PLACES) *
           (ELEMENT + w.n * SHAPED + p->object->terms * SUMMED);
}
