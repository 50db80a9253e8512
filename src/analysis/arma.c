/* ARMA(1,1) by least squares: papers/002 section IV-E minimises the energy of the whitened series,

     H(z) = (1 + b1/z)/(1 + a1/z),   W = (X - mean)/H,   a1, b1 = argmin sum W_n^2,

   by Gauss and Newton. Ours departs from it where that matters for few impacts, as a1 is about -0.97:

   - The pre-sample values are not 0: W_n are the innovations of the stationary series over their deviations (Brockwell
     and Davis, Time Series: Theory
     and Methods, section 5.3): v_0 = (1 + b1^2 - 2 a1 b1)/(1 - a1^2), v_n = 1 + b1^2 - b1^2/v_(n-1),
     I_n = X_n + a1 X_(n-1) - b1/v_(n-1) I_(n-1), W_n = I_n/sqrt(v_n). Nothing is dropped and nothing decays from a
       wrong start.
   - The mean is that which leaves the least energy: m = sum W U/sum U^2, U the series of ones whitened (generalised
     least squares).
   - The energy is multiplied by (prod v_n . sum U_n^2)^(1/(n-1)): the residual likelihood (Harville, J. Am. Stat.
     Assoc. 72, 1977, 320), in place
     of the plain energy, whose a1 lies nearer to 0 by (1 + 3 |a1|)/n or so; half of that is left. The factor tends to 1
       with n.

   GSL's damped Gauss-Newton steps (Levenberg and Marquardt) in u, v with a1 = EDGE tanh u, b1 = EDGE tanh v: the region
   cannot be left. From the STARTS best points of a grid; the best end is taken. Of more than MANY values the first MANY
   tell the best end, and steps with all go on from there. Where a1 and b1 are alike they cancel: any such pair is white
   noise. a1 = b1 = 0 is taken if the energy is hardly less elsewhere (ARMA_GAIN). The covariance of a1 and b1 is the
   Jacobian's. */
#include "analysis/arma.h"

#include <gsl/gsl_multifit_nlinear.h>
#include <math.h>

#include "num/real.h"

#define EDGE 0.99999
#define EDGE_OF_B 0.9999

enum { GRID = 9, STARTS = 3, STEPS = 200, MANY = 20000 };

struct search {
    const double *x; /* [n] */
    int n;
    double centre, unit; /* taken off x before all else, and x over it: precision, and what GSL takes for converged */
};

struct pass {                /* one filter's start and its sums */
    double mean, energy;     /* of the series less `centre`, in `unit`; what is left */
    double ones, logarithms; /* sum U^2, sum log v */
};

struct innovations { /* of the series and of ones: filter, v, 1/sqrt v, b1/v, and the values before */
    double a, b, v, scale, back, x, one, ix, iy;
};

static void innovations_open(struct innovations *s, double a, double b)
{
    double v = (1 + b * b - 2 * a * b) / (1 - a * a);
    *s = (struct innovations){.a = a, .b = b, .v = v, .scale = 1 / sqrt(v)};
}

/* W and U of the next x. */
static inline void innovations_next(struct innovations *s, double x, double w[2])
{
    s->ix = x + s->a * s->x - s->back * s->ix;
    s->iy = 1 + s->a * s->one - s->back * s->iy;
    s->x = x;
    s->one = 1;
    w[0] = s->ix * s->scale;
    w[1] = s->iy * s->scale;
}

/* v of the next; it ends at 1 to rounding. */
static inline void innovations_step(struct innovations *s)
{
    s->back = s->b / s->v;
    if (s->v == 1) return;
    s->v = 1 + s->b * s->b - s->b * s->back;
    if (!(s->v > 1 + 1e-15)) s->v = 1;
    s->scale = 1 / sqrt(s->v);
}

static struct pass pass_make(const struct search *s, double a, double b)
{
    struct innovations i;
    double xx = 0, xy = 0, yy = 0, logarithms = 0, w[2];
    innovations_open(&i, a, b);
    for (int k = 0; k < s->n; k++) {
        innovations_next(&i, (s->x[k] - s->centre) / s->unit, w);
        if (i.v != 1) logarithms += real_log(i.v);
        innovations_step(&i);
        xx += w[0] * w[0];
        xy += w[0] * w[1];
        yy += w[1] * w[1];
    }
    return (struct pass){xy / yy, fmax(xx - xy * xy / yy, 0), yy, logarithms};
}

/* What the residuals are multiplied by: the square root of the energy's factor. */
static double pass_factor(const struct pass *p, int n)
{
    return real_exp((p->logarithms + real_log(p->ones / n)) / (2.0 * (n - 1)));
}

static double cost(const struct search *s, double a, double b)
{
    struct pass p = pass_make(s, a, b);
    double factor = pass_factor(&p, s->n);
    return p.energy * factor * factor;
}

static int residuals(const gsl_vector *at, void *context, gsl_vector *out)
{
    const struct search *s = context;
    double a = EDGE * real_tanh(gsl_vector_get(at, 0)), b = EDGE * real_tanh(gsl_vector_get(at, 1)), w[2];
    struct pass p = pass_make(s, a, b);
    double factor = pass_factor(&p, s->n);
    struct innovations i;
    innovations_open(&i, a, b);
    for (int k = 0; k < s->n; k++) {
        innovations_next(&i, (s->x[k] - s->centre) / s->unit, w);
        innovations_step(&i);
        gsl_vector_set(out, k, (w[0] - p.mean * w[1]) * factor);
    }
    return GSL_SUCCESS;
}

static double atanh_of(double x) { return 0.5 * (real_log1p(x) - real_log1p(-x)); }

struct point {
    double a, b, cost;
};

/* The best STARTS of a grid that is fine towards the edges. */
static void starts_find(const struct search *s, struct point best[STARTS])
{
    for (int i = 0; i < STARTS; i++)
        best[i].cost = HUGE_VAL;
    for (int i = 0; i < GRID * GRID; i++) {
        struct point p = {.a = real_tanh(0.55 * (i / GRID - GRID / 2)), .b = real_tanh(0.55 * (i % GRID - GRID / 2))};
        p.cost = cost(s, p.a, p.b);
        for (int j = 0; j < STARTS; j++)
            if (p.cost < best[j].cost) {
                struct point swapped = best[j];
                best[j] = p;
                p = swapped;
            }
    }
}

/* The inverse of J'J times the mean square that is left, for a1 and b1. Where it has none nothing is known: both may be
   anywhere in the region. A zero at the circle (b1 of 1 or -1: times that keep to a beat) has no curvature by which to
   tell; it is known to some 2/n, and a1 as if it were given. */
static void covariance_make(const gsl_matrix *jacobian, double mean_square, const struct point *p, double covariance[3])
{
    double aa = 0, ab = 0, bb = 0, da = EDGE - p->a * p->a / EDGE, db = EDGE - p->b * p->b / EDGE;
    for (size_t i = 0; i < jacobian->size1; i++) {
        double a = gsl_matrix_get(jacobian, i, 0) / da, b = gsl_matrix_get(jacobian, i, 1) / db;
        aa += a * a;
        ab += a * b;
        bb += b * b;
    }
    double determinant = aa * bb - ab * ab;
    if (fabs(p->b) > EDGE_OF_B && fabs(p->a) < EDGE_OF_B && aa > 0) {
        covariance[0] = mean_square / aa;
        covariance[1] = 0;
        covariance[2] = 4.0 / ((double)jacobian->size1 * (double)jacobian->size1);
        return;
    }
    bool known = determinant > 1e-14 * aa * bb;
    covariance[0] = known ? bb * mean_square / determinant : 1;
    covariance[1] = known ? -ab * mean_square / determinant : 0;
    covariance[2] = known ? aa * mean_square / determinant : 1;
}

/* Walks down from p to the least energy near it. */
static void descend(struct search *s, struct point *p, struct arma *f)
{
    gsl_multifit_nlinear_parameters how = gsl_multifit_nlinear_default_parameters();
    how.fdtype = GSL_MULTIFIT_NLINEAR_CTRDIFF;
    how.h_df = 1e-6;
    gsl_multifit_nlinear_workspace *w = gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &how, s->n, 2);
    gsl_multifit_nlinear_fdf problem = {.f = residuals, .n = s->n, .p = 2, .params = s};
    double begin[2] = {atanh_of(p->a / EDGE), atanh_of(p->b / EDGE)};
    gsl_vector_view start = gsl_vector_view_array(begin, 2);
    int why;
    gsl_multifit_nlinear_init(&start.vector, &problem, w);
    gsl_multifit_nlinear_driver(STEPS, 1e-9, 1e-10, 0, NULL, NULL, &why, w);
    const gsl_vector *end = gsl_multifit_nlinear_position(w);
    p->a = EDGE * real_tanh(gsl_vector_get(end, 0));
    p->b = EDGE * real_tanh(gsl_vector_get(end, 1));
    p->cost = cost(s, p->a, p->b);
    covariance_make(gsl_multifit_nlinear_jac(w), p->cost / (s->n - 3), p, f->covariance);
    f->iterations = (int)gsl_multifit_nlinear_niter(w);
    gsl_multifit_nlinear_free(w);
}

/* How the variance of the mean, 1/sum U^2, changes with a1 and b1. */
static void path_integral_make(const struct search *s, struct arma *f)
{
    double step = 1e-4 * (1 - fabs(f->a1)), other = 1e-4 * (1 - fabs(f->b1));
    struct pass low = pass_make(s, f->a1 - step, f->b1), high = pass_make(s, f->a1 + step, f->b1);
    f->slope[0] = real_log(low.ones / high.ones) / (2 * step);
    low = pass_make(s, f->a1, f->b1 - other);
    high = pass_make(s, f->a1, f->b1 + other);
    f->slope[1] = real_log(low.ones / high.ones) / (2 * other);
}

void arma_fit(const double *x, int n, struct arma *f)
{
    struct search s = {x, n, 0, 0}, first;
    double square = 0;
    struct point start[STARTS], best = {0};
    struct arma tried = {0};
    for (int i = 0; i < n; i++)
        s.centre += x[i] / n;
    for (int i = 0; i < n; i++)
        square += (x[i] - s.centre) * (x[i] - s.centre) / n;
    s.unit = (square > 0) ? sqrt(square) : 1;
    best.cost = HUGE_VAL;
    first = s;
    first.n = n < MANY ? n : MANY;
    starts_find(&first, start);
    for (int i = 0; i < STARTS; i++) {
        descend(&first, &start[i], &tried);
        if (start[i].cost < best.cost) {
            best = start[i];
            *f = tried;
        }
    }
    if (first.n < n) descend(&s, &best, f);
    f->gain = n * real_log(cost(&s, 0, 0) / best.cost);
    f->white = !(f->gain >= ARMA_GAIN);
    f->a1 = f->white ? 0 : best.a;
    f->b1 = f->white ? 0 : best.b;
    struct pass p = pass_make(&s, f->a1, f->b1);
    f->mean = s.centre + s.unit * p.mean;
    f->deviation = s.unit * sqrt(p.energy / (n - (f->white ? 1 : 3)));
    f->mean_variance = f->deviation * f->deviation / p.ones;
    path_integral_make(&s, f);
}

double arma_whiten(const double *x, int n, double a1, double b1, double *w)
{
    struct innovations i;
    double logarithms = 0, both[2];
    innovations_open(&i, a1, b1);
    for (int k = 0; k < n; k++) {
        innovations_next(&i, x[k], both);
        w[k] = both[0];
        if (i.v != 1) logarithms += real_log(i.v);
        innovations_step(&i);
    }
    return logarithms;
}
