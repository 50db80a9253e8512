/* Nonlinear least squares of h_p(t) = Re sum_i B_pi e^(s_i t), the poles the same at all places, over all samples: Gauss-Newton steps of gains and poles
   together (ringing_normal.c), damped after Levenberg and Marquardt where a step would not lower the weighted sum of squares. Poles keep to decay >= 0 and
   0 < omega < pi rate. The residual is made anew in the time domain at every step, so that what rounding does to the inner products only slows the way. */
#include "analysis/ringing_fit.h"

#include <math.h>
#include <string.h>

#include "analysis/ringing_complex.h"
#include "analysis/ringing_normal.h"
#include "num/real.h"

/* Of a step, in squared deviations of what noise does, of all poles together: a tenth of one; or one of what rounding is taken to do, which it does not. */
static double enough(const struct ringing_fit *f)
{
    bool rounding = true;
    for (int p = 0; p < f->r->places; p++)
        rounding = rounding && f->energy[p] < f->least[p];
    return rounding ? 1 : 1e-2;
}

static double energy_of(const double *y, long n)
{
    double sum = 0;
    for (long i = 0; i < n; i++)
        sum += y[i] * y[i];
    return sum;
}

void ringing_fit_open(struct ringing_fit *f, const struct ringing *r, int most, struct arena *a)
{
    *f = (struct ringing_fit){.r = r, .most = most, .a = a, .m = 1};
    ringing_basis_open(&f->basis, most, r->n, r->rate, a);
    f->decay = ARENA_TAKE(a, double, most);
    f->omega = ARENA_TAKE(a, double, most);
    f->held = ARENA_TAKE(a, bool, most);
    f->tie = ARENA_TAKE(a, int, most);
    f->fresh = ARENA_TAKE(a, bool, most);
    f->guest = ARENA_TAKE(a, bool, most);
    f->origin = ARENA_TAKE(a, int, most);
    f->gain = ARENA_TAKE(a, double complex, (long)most * r->places);
    f->residual = ARENA_TAKE(a, double, r->n * r->places);
    f->weight = ARENA_TAKE(a, double, r->places);
    f->energy = ARENA_TAKE(a, double, r->places);
    f->least = ARENA_TAKE(a, double, r->places);
    f->held[0] = true;
    f->tie[0] = -1;
    for (int p = 0; p < r->places; p++) {
        memcpy(f->residual + p * r->n, r->h[p], (size_t)r->n * sizeof(double));
        f->least[p] = energy_of(r->h[p], r->n) * RINGING_FIT_ROUNDING * RINGING_FIT_ROUNDING;
        if (r->rounding)
            f->least[p] = fmax(f->least[p], (double)r->n * r->rounding[p] * r->rounding[p]);
    }
}

bool ringing_fit_add(struct ringing_fit *f, double decay, double omega)
{
    if (f->m == f->most)
        return false;
    int i = f->m++;
    f->decay[i] = decay;
    f->omega[i] = omega;
    f->held[i] = false;
    f->tie[i] = f->origin[i] = -1;
    f->fresh[i] = true;
    f->guest[i] = false;
    for (int p = 0; p < f->r->places; p++)
        f->gain[(long)p * f->most + i] = 0;
    return true;
}

static void component_copy(struct ringing_fit *f, int from, int to)
{
    f->decay[to] = f->decay[from];
    f->omega[to] = f->omega[from];
    f->held[to] = f->held[from];
    f->tie[to] = f->tie[from];
    f->fresh[to] = f->fresh[from];
    f->guest[to] = f->guest[from];
    f->origin[to] = f->origin[from];
    for (int p = 0; p < f->r->places; p++)
        f->gain[(long)p * f->most + to] = f->gain[(long)p * f->most + from];
}

void ringing_fit_drop(struct ringing_fit *f, const bool *drop)
{
    int kept = 0;
    for (int i = 0; i < f->m; i++)
        if (f->tie[i] >= 0 && drop[f->tie[i]])
            f->tie[i] = -1;
    for (int i = 0; i < f->m; i++) {
        int before = 0;
        for (int k = 0; k < f->tie[i]; k++)
            before += drop[k];
        if (f->tie[i] >= 0)
            f->tie[i] -= before;
    }
    for (int i = 0; i < f->m; i++)
        if (!drop[i])
            component_copy(f, i, kept++);
    f->m = kept;
}

/* Residuals and their weights; returns the weighted sum of squares with the weights as they were. */
static double residual_make(struct ringing_fit *f, const double *weight)
{
    double cost = 0;
    for (int p = 0; p < f->r->places; p++) {
        double *y = f->residual + p * f->r->n;
        ringing_basis_subtract(&f->basis, f->r->h[p], f->gain + (long)p * f->most, y);
        f->energy[p] = energy_of(y, f->r->n);
        f->weight[p] = f->energy[p] > 0 ? (double)f->r->n / fmax(f->energy[p], f->least[p]) : 1;
        cost += f->energy[p] * weight[p];
    }
    return cost;
}

/* g0^-1 of (sum x conj e) as rows; x[w] scaled in and out. */
static void rows_solve(const struct ringing_normal *n, const double complex *in, double *out)
{
    for (int i = 0; i < n->w; i++)
        out[i] = n->scale[i] * (i % 2 ? cimag(in[i / 2]) : creal(in[i / 2]));
    ringing_normal_solve(n, out);
    for (int i = 0; i < n->w; i++)
        out[i] *= n->scale[i];
}

/* Gains of the poles as they are, from any gains before: by the residual, so that what rounding left of the last is taken off. */
static double gains_make(struct ringing_fit *f, const struct ringing_normal *n, const double *weight, struct arena *a)
{
    double *b = ARENA_TAKE(a, double, n->w);
    double complex *zeroth = ARENA_TAKE(a, double complex, f->m), *first = ARENA_TAKE(a, double complex, f->m);
    residual_make(f, weight);
    for (int p = 0; p < f->r->places; p++) {
        ringing_basis_project(&f->basis, f->residual + p * f->r->n, zeroth, first);
        rows_solve(n, zeroth, b);
        for (int i = 0; i < f->m; i++)
            f->gain[(long)p * f->most + i] += ringing_complex(b[2 * i], b[2 * i + 1]);
    }
    return residual_make(f, weight);
}

void ringing_fit_sound(struct ringing_fit *f)
{
    struct arena *a = arena_open();
    ringing_basis_set(&f->basis, f->m, f->decay, f->omega);
    residual_make(f, ARENA_TAKE(a, double, f->r->places));
    arena_close(a);
}

void ringing_fit_gains(struct ringing_fit *f)
{
    struct arena *a = arena_open();
    struct ringing_normal n;
    double *none = ARENA_TAKE(a, double, f->r->places);
    ringing_basis_set(&f->basis, f->m, f->decay, f->omega);
    ringing_normal_make(f, a, &n);
    gains_make(f, &n, none, a);
    gains_make(f, &n, none, a);
    arena_close(a);
}

struct step {                /* one linearisation */
    double *h, *g;           /* [w][w], [w] of poles */
    double *pole;            /* [w] */
    double *decay, *omega;   /* [m] where it came from */
    double complex *gain;    /* [places][m] */
};

static void step_open(const struct ringing_fit *f, struct step *s, struct arena *a)
{
    long w = 2 * f->m;
    s->h = ARENA_TAKE(a, double, w * w);
    s->g = ARENA_TAKE(a, double, w);
    s->pole = ARENA_TAKE(a, double, w);
    s->decay = ARENA_TAKE(a, double, f->m);
    s->omega = ARENA_TAKE(a, double, f->m);
    s->gain = ARENA_TAKE(a, double complex, f->m * f->r->places);
}

static void step_keep(struct ringing_fit *f, struct step *s, bool back)
{
    size_t m = (size_t)f->m;
    memcpy(back ? f->decay : s->decay, back ? s->decay : f->decay, m * sizeof(double));
    memcpy(back ? f->omega : s->omega, back ? s->omega : f->omega, m * sizeof(double));
    for (int p = 0; p < f->r->places; p++) {
        double complex *there = s->gain + p * f->m, *here = f->gain + (long)p * f->most;
        memcpy(back ? here : there, back ? there : here, m * sizeof *here);
    }
}

/* cross' r, row i, without the scales: what the gains take of the derivative by the pole. */
static double cross_times(const struct ringing_normal *n, int row, const double complex *r)
{
    double sum = 0;
    for (int i = 0; i < n->w; i++)
        sum += n->cross[(long)row * n->w + i] * n->scale[i] * (i % 2 ? cimag(r[i / 2]) : creal(r[i / 2]));
    return n->scale[row] > 0 ? sum / n->scale[row] : 0;
}

static void step_make(struct ringing_fit *f, const struct ringing_normal *n, struct step *s, struct arena *a)
{
    double *weight = ARENA_TAKE(a, double, f->r->places * f->m);
    double complex *zeroth = ARENA_TAKE(a, double complex, f->m), *first = ARENA_TAKE(a, double complex, f->m);
    memset(s->g, 0, (size_t)n->w * sizeof *s->g);
    for (int p = 0; p < f->r->places; p++) {
        const double complex *gain = f->gain + (long)p * f->most;
        ringing_basis_project(&f->basis, f->residual + p * f->r->n, zeroth, first);
        for (int i = 0; i < f->m; i++) {
            double u = creal(first[i]) - cross_times(n, 2 * i, zeroth), v = cimag(first[i]) - cross_times(n, 2 * i + 1, zeroth);
            s->g[2 * i] += f->weight[p] * (creal(gain[i]) * u + cimag(gain[i]) * v);
            s->g[2 * i + 1] += f->weight[p] * (creal(gain[i]) * v - cimag(gain[i]) * u);
            weight[p * f->m + i] = f->weight[p];
        }
    }
    ringing_normal_reduce(f, s->g);
    ringing_normal_poles(f, n, weight, s->h);
}

/* The poles' step with the diagonal raised; returns how far it goes in deviations of the residual, squared. */
static double step_solve(const struct ringing_fit *f, struct step *s, double damping)
{
    struct arena *a = arena_open();
    int w = 2 * f->m;
    double size = 0;
    struct ringing_normal n = {.w = w, .scale = ARENA_TAKE(a, double, w)};
    double *h = n.g[0] = ARENA_TAKE(a, double, (long)w * w);
    for (int i = 0; i < w; i++)
        n.scale[i] = s->h[(long)i * w + i] > 0 ? 1 / sqrt(s->h[(long)i * w + i]) : 0;
    for (int i = 0; i < w; i++)
        for (int k = 0; k < w; k++)
            h[(long)i * w + k] = i == k ? 1 + damping : s->h[(long)i * w + k] * n.scale[i] * n.scale[k];
    for (int i = 0; i < w; i++)
        s->pole[i] = s->g[i] * n.scale[i];
    ringing_normal_factor(h, w);
    ringing_normal_solve(&n, s->pole);
    for (int i = 0; i < w; i++) {
        s->pole[i] *= n.scale[i];
        size += s->pole[i] * s->g[i];
    }
    ringing_normal_expand(f, s->pole);
    arena_close(a);
    return size;
}

/* What would leave the region goes half of the way to its edge. */
static void step_take(struct ringing_fit *f, const struct step *s)
{
    double top = REAL_PI * f->r->rate, fastest = 1.2 * RINGING_FIT_FASTEST * f->r->rate;
    for (int i = 0; i < f->m; i++) {
        if (f->held[i])
            continue;
        double decay = s->decay[i] - s->pole[2 * i], omega = s->omega[i] + s->pole[2 * i + 1];
        f->decay[i] = decay < 0 ? s->decay[i] / 2 : decay > fastest ? (s->decay[i] + fastest) / 2 : decay;
        f->omega[i] = omega <= 0 ? s->omega[i] / 2 : omega >= top ? (s->omega[i] + top) / 2 : omega;
    }
    ringing_basis_set(&f->basis, f->m, f->decay, f->omega);
}

/* One step, damped until it lowers the cost; *now are the equations where the fit stands, *next where it then stands. Returns how far it went; 0: none lowers it, or
   nothing is left to go. */
static double step_try(struct ringing_fit *f, double *damping, const struct ringing_normal *now, struct arena *to, struct ringing_normal *next)
{
    struct arena *a = arena_open();
    struct step s;
    bool better = false, far = true;
    double size = 0;
    double *weight = ARENA_TAKE(a, double, f->r->places), cost = 0;
    for (int p = 0; p < f->r->places; p++)
        cost += f->energy[p] * f->weight[p];
    memcpy(weight, f->weight, (size_t)f->r->places * sizeof *weight);
    step_open(f, &s, a);
    step_make(f, now, &s, a);
    step_keep(f, &s, false);
    for (int tries = 0; !better && far && tries < 8; tries++) {
        size = step_solve(f, &s, *damping);
        far = size > enough(f);
        step_take(f, &s);
        ringing_normal_make(f, to, next);
        better = gains_make(f, next, weight, a) < cost;
        *damping = better ? *damping / 10 : fmax(10 * *damping, 1e-4);
        if (!better)
            step_keep(f, &s, true);
    }
    if (!better) {
        ringing_basis_set(&f->basis, f->m, f->decay, f->omega);
        residual_make(f, weight);
    }
    arena_close(a);
    return better && far ? size : 0;
}

double ringing_fit_polish(struct ringing_fit *f, int steps)
{
    struct arena *a = arena_open();
    struct ringing_normal now;
    double damping = 0, *none = ARENA_TAKE(a, double, f->r->places);
    double first = 0;
    ringing_basis_set(&f->basis, f->m, f->decay, f->omega);
    ringing_normal_make(f, a, &now);
    gains_make(f, &now, none, a);
    gains_make(f, &now, none, a);
    for (int i = 0, on = f->m > 1; on && i < steps; i++) {
        struct arena *b = arena_open();
        struct ringing_normal next;
        double size = step_try(f, &damping, &now, b, &next);
        on = size > 0;
        first = i == 0 ? size : first;
        now = next;
        arena_close(a);
        a = b;
    }
    arena_close(a);
    return first;
}
