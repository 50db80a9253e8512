/* Stages, of which each needs nothing of the next:

   1. For every node of nu and 2400 values of gamma (a step of 0.18 % in frequency): how well measured modes find a
      computed one beside them, and how well computed modes below the highest measured find a measured one. The second
      half matters: without it a gamma so low that computed modes lie everywhere fits anything.
   2. From each of the best places: measured and computed modes are paired in order of frequency by dynamic programming
      (what is left out costs as much as 1 % of frequency), log gamma and nu follow by Gauss and Newton with Cauchy's
      weights, until the pairs stay.
   3. With those pairs, laws of damping over the measured lambda (eq. 4 and others), in logarithms, by robust least
      squares; the one of least BIC is chosen.

   Intervals are the wider of the covariance's (times Birge's ratio, by Student's t) and of a bootstrap over modes;
   gamma's is wider by the error of the mesh and of the object's size: lambda goes with gamma/length^2. */
#include "analysis/material_fit.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sort_double.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "num/noise.h"
#include "num/real.h"

enum { STEPS = 2400, PLACES = 16, ROUNDS = 12, LEAST_MODES = 3, SURE_MODES = 5, MANY = 12 };

static const double near = 0.006;      /* of frequency: a neighbour farther off than that is none */
static const double tolerance = 0.01;  /* of frequency: two farther apart are no pair */
static const double distinct = 0.01;   /* of gamma: another place */
static const double unlike = 1.2;      /* times the cost: less is not unique */
static const double lawless = 0.5;     /* scatter of logarithms about a law */
static const double unsure_mesh = 1.0; /* of the mesh's error, as a standard error (evidence/materials.md) */
static const double hardest = 3.5e8, highest_nu = 0.45, prior_nu[2] = {0.3, 0.5};
static const double absent = 0.25; /* cost of a mode that should show and is not there, to that of a pair's leaving */

/* ------------------------------------------------------------------ computed modes */

struct branch {
    double log_ratio, slope; /* corrected for the mesh */
    int of;
};

static int by_ratio(const void *x, const void *y)
{
    const struct branch *p = x, *q = y;
    if (p->log_ratio != q->log_ratio) return p->log_ratio < q->log_ratio ? -1 : 1;
    return p->of - q->of;
}

struct spectrum {
    int n;
    struct branch *branch; /* [n] by rising ratio */
};

struct work {
    const struct material_problem *p;
    struct arena *arena;
    int objects;
    struct spectrum *now; /* [objects] at one nu */
    double *log_ratio, *slope;
};

static double mesh_error(const struct solid_family *f, int j) { return isnan(f->error[j]) ? 0.0 : f->error[j]; }

static void spectra(struct work *w, double nu)
{
    for (int o = 0; o < w->objects; o++) {
        const struct solid_family *f = &w->p->object[o];
        struct spectrum *s = &w->now[o];
        solid_family_at(f, nu, w->log_ratio, w->slope);
        s->n = f->n;
        for (int j = 0; j < f->n; j++)
            s->branch[j] = (struct branch){w->log_ratio[j] + 2.0 * real_log1p(-mesh_error(f, j)), w->slope[j], j};
        qsort(s->branch, (size_t)s->n, sizeof *s->branch, by_ratio);
    }
}

static double visible(const struct material_set *s, int branch) { return s->visible ? s->visible[branch] : 1.0; }

/* ------------------------------------------------------------------ 1: all of gamma and nu */

/* Mean over measured modes, and computed ones below the highest measured as far as they are visible, of the distance to
   the nearest of the others, as a share of `near`, at most 1. */
static double score(const struct work *w, double log_gamma)
{
    double all = 0.0, count = 0.0;
    for (int k = 0; k < w->p->sets; k++) {
        const struct material_set *s = &w->p->set[k];
        const struct spectrum *c = &w->now[s->object];
        double there = 0.0, back = 0.0, weight = 0.0, top = s->log_lambda[s->n - 1] + 2.0 * near,
               bottom = s->log_lambda[0] - 0.5;
        for (int i = 0, j = 0; i < s->n; i++) {
            double at = s->log_lambda[i] - log_gamma;
            while (j + 1 < c->n && fabs(c->branch[j + 1].log_ratio - at) <= fabs(c->branch[j].log_ratio - at))
                j++;
            there += fmin(0.5 * fabs(c->branch[j].log_ratio - at) / near, 1.0);
        }
        for (int i = 0, j = 0; j < c->n; j++) {
            double at = c->branch[j].log_ratio + log_gamma, share = visible(s, c->branch[j].of);
            if (at > top) break;
            if (at < bottom) continue;
            while (i + 1 < s->n && fabs(s->log_lambda[i + 1] - at) <= fabs(s->log_lambda[i] - at))
                i++;
            back += share * fmin(0.5 * fabs(s->log_lambda[i] - at) / near, 1.0);
            weight += share;
        }
        all += there + back;
        count += s->n + weight;
    }
    return all / count;
}

struct place {
    double log_gamma, nu, cost;
};

static int by_cost(const void *x, const void *y)
{
    const struct place *p = x, *q = y;
    if (p->cost != q->cost) return p->cost < q->cost ? -1 : 1;
    return (p->log_gamma > q->log_gamma) - (p->log_gamma < q->log_gamma);
}

/* The best minima along gamma of all values of nu, no two close together; returns how many. */
static int scan(struct work *w, struct place *best)
{
    const struct solid_family *f = &w->p->object[0];
    const double low = real_log(w->p->gamma[0]), high = real_log(w->p->gamma[1]);
    bool one = !isnan(w->p->poisson) || f->nodes == 1;
    struct arena *room = arena_open();
    struct place *found = NULL;
    int n = 0, many = 0;
    double s[STEPS];
    for (int i = 0; i < (one ? 1 : f->nodes); i++) {
        double nu = !one ? f->nu[i] : f->nodes == 1 ? 0.0 : w->p->poisson;
        if (nu > highest_nu) break;
        spectra(w, nu);
        for (int k = 0; k < STEPS; k++)
            s[k] = score(w, low + (high - low) * k / (STEPS - 1));
        for (int k = 1; k + 1 < STEPS; k++)
            if (s[k] <= s[k - 1] && s[k] < s[k + 1]) {
                found = arena_more(room, found, n, sizeof *found);
                found[n++] = (struct place){low + (high - low) * k / (STEPS - 1), nu, s[k]};
            }
    }
    qsort(found, (size_t)n, sizeof *found, by_cost);
    for (int i = 0; i < n && many < PLACES; i++) {
        bool new = true;
        for (int k = 0; k < many; k++)
            new = new &&
                  (fabs(found[i].log_gamma - best[k].log_gamma) > distinct || fabs(found[i].nu - best[k].nu) > 0.06);
        if (new) best[many++] = found[i];
    }
    arena_close(room);
    return many;
}

/* ------------------------------------------------------------------ 2: pairs, gamma and nu */

/* Pairs in order of frequency, of least cost: of a pair (difference/tolerance)^2 and what its mode lacks in
   visibility, of a measured mode without one 1, of a computed one in the band without one `absent`. */
static void pair(const struct work *w, double log_gamma, struct material_set *s)
{
    const struct spectrum *c = &w->now[s->object];
    struct arena *room = arena_open();
    int m = s->n, n = c->n;
    double *cost = ARENA_TAKE(room, double, (m + 1) * (n + 1)), top = s->log_lambda[m - 1],
           bottom = s->log_lambda[0] - 0.5;
    unsigned char *from_where = ARENA_TAKE(room, unsigned char, (m + 1) * (n + 1));
    for (int i = 0; i <= m; i++)
        for (int j = 0; j <= n; j++) {
            double *here = &cost[i * (n + 1) + j], least = HUGE_VAL;
            int from = 0;
            if (i > 0) least = here[-(n + 1)] + 1.0;
            if (j > 0) {
                double at = c->branch[j - 1].log_ratio + log_gamma,
                       skip = at < top && at > bottom ? absent * visible(s, c->branch[j - 1].of) : 0.0;
                if (here[-1] + skip < least) {
                    least = here[-1] + skip;
                    from = 1;
                }
                if (i > 0) {
                    double off = 0.5 * (s->log_lambda[i - 1] - at) / tolerance,
                           both = here[-(n + 2)] + off * off + 0.3 * (1.0 - visible(s, c->branch[j - 1].of));
                    if (fabs(off) < 1.0 && both < least) {
                        least = both;
                        from = 2;
                    }
                }
            }
            *here = i || j ? least : 0.0;
            from_where[i * (n + 1) + j] = (unsigned char)from;
        }
    for (int i = m, j = n; i > 0;) {
        int from = from_where[i * (n + 1) + j];
        if (from == 2) {
            s->match[--i] = c->branch[--j].of;
        } else if (from == 1) {
            j--;
        } else {
            s->match[--i] = -1;
        }
    }
    arena_close(room);
}

struct row {                  /* a pair */
    double off, slope, sigma; /* half of log lambda less log ratio; d log f/d nu; standard error of off */
    double mesh;              /* what the mesh's error was taken to be */
    double error;             /* of the measured frequency alone */
    int object, of;           /* whose mode */
};

static int rows(struct work *w, struct row *r)
{
    const struct material_problem *p = w->p;
    int n = 0;
    for (int k = 0; k < p->sets; k++) {
        const struct material_set *s = &p->set[k];
        const struct solid_family *f = &p->object[s->object];
        const struct spectrum *c = &w->now[s->object];
        for (int j = 0; j < c->n; j++) {
            w->log_ratio[c->branch[j].of] = c->branch[j].log_ratio;
            w->slope[c->branch[j].of] = c->branch[j].slope;
        }
        for (int i = 0; i < s->n; i++) {
            int j = s->match[i];
            if (j < 0) continue;
            double mesh = 0.3 * mesh_error(f, j);
            r[n++] = (struct row){0.5 * (s->log_lambda[i] - w->log_ratio[j]),
                                  0.5 * w->slope[j],
                                  sqrt(s->error[i] * s->error[i] + p->model_error * p->model_error + mesh * mesh),
                                  mesh_error(f, j),
                                  s->error[i],
                                  s->object,
                                  j};
        }
    }
    return n;
}

/* One row for each mode of an object: what a computed mode is off by is the same in all its strikes. Returns how
   many. */
static int merged(struct row *r, int n, double model_error)
{
    int rows = 0;
    for (int i = 0; i < n; i++) {
        int k = 0;
        while (k < rows && (r[k].object != r[i].object || r[k].of != r[i].of))
            k++;
        if (k < rows) {
            double one = 1.0 / (r[k].error * r[k].error + 1e-20), other = 1.0 / (r[i].error * r[i].error + 1e-20),
                   mesh = 0.3 * r[k].mesh;
            r[k].off = (one * r[k].off + other * r[i].off) / (one + other);
            r[k].error = 1.0 / sqrt(one + other);
            r[k].sigma = sqrt(r[k].error * r[k].error + model_error * model_error + mesh * mesh);
        } else {
            r[rows++] = r[i];
        }
    }
    return rows;
}

struct solution {
    double log_gamma, nu;
    double covariance[3]; /* of log gamma, both, nu; by sigma alone */
    double chi2, weight;  /* with Cauchy's weights, and their sum */
};

/* One step from (log gamma, nu) over the rows, weighted `times` (NULL: 1 each). */
static void newton(const struct row *r, int n, const double *times, bool nu_free, struct solution *x)
{
    double a = 0.0, b = 0.0, c = 0.0, g = 0.0, h = 0.0;
    x->chi2 = x->weight = 0.0;
    for (int i = 0; i < n; i++) {
        double rest = (r[i].off - 0.5 * x->log_gamma) / r[i].sigma, j = 0.5 / r[i].sigma, k = r[i].slope / r[i].sigma,
               weight = (times ? times[i] : 1.0) / (1.0 + rest * rest / 4.0);
        a += weight * j * j;
        b += weight * j * k;
        c += weight * k * k;
        g += weight * j * rest;
        h += weight * k * rest;
        x->chi2 += weight * rest * rest;
        x->weight += weight;
    }
    if (!nu_free) {
        x->covariance[0] = 1.0 / a;
        x->covariance[1] = x->covariance[2] = 0.0;
        x->log_gamma += g / a;
        return;
    }
    double tight = 1.0 / (prior_nu[1] * prior_nu[1]);
    c += tight; /* where frequencies do not say anything of nu it stays where things are */
    h += tight * (prior_nu[0] - x->nu);
    double det = a * c - b * b;
    x->covariance[0] = c / det;
    x->covariance[1] = -b / det;
    x->covariance[2] = a / det;
    x->log_gamma += (c * g - b * h) / det;
    x->nu = fmin(fmax(x->nu + (a * h - b * g) / det, 0.0), highest_nu);
}

static bool nu_free(const struct work *w) { return isnan(w->p->poisson) && w->p->object[0].nodes > 1; }

/* Robust cost of the place: of pairs, of measured modes without one, of computed ones that should show. */
static double cost_of(struct work *w, const struct row *r, int n, const struct solution *x)
{
    const double alone = real_log1p(tolerance * tolerance / (4.0 * w->p->model_error * w->p->model_error));
    double all = 0.0;
    for (int i = 0; i < n; i++) {
        double rest = (r[i].off - 0.5 * x->log_gamma) / r[i].sigma;
        all += real_log1p(rest * rest / 4.0);
    }
    for (int k = 0; k < w->p->sets; k++) {
        const struct material_set *s = &w->p->set[k];
        const struct spectrum *c = &w->now[s->object];
        for (int i = 0; i < s->n; i++)
            all += s->match[i] < 0 ? alone : 0.0;
        for (int j = 0; j < c->n; j++) {
            double at = c->branch[j].log_ratio + x->log_gamma;
            bool found = at > s->log_lambda[s->n - 1] || at < s->log_lambda[0] - 0.5;
            for (int i = 0; !found && i < s->n; i++)
                found = s->match[i] == c->branch[j].of;
            all += found ? 0.0 : absent * alone * visible(s, c->branch[j].of);
        }
    }
    return all;
}

static int count_modes(const struct material_set *set, int sets)
{
    int n = 0;
    for (int k = 0; k < sets; k++)
        n += set[k].n;
    return n;
}

/* From a place to where the pairs stay. */
static double refine(struct work *w, struct solution *x, struct row *r, int *n)
{
    const int all = count_modes(w->p->set, w->p->sets);
    int *last = ARENA_TAKE(w->arena, int, all);
    for (int round = 0; round < ROUNDS; round++) {
        bool same = round > 0;
        spectra(w, x->nu);
        for (int k = 0, at = 0; k < w->p->sets; at += w->p->set[k++].n) {
            struct material_set *s = &w->p->set[k];
            pair(w, x->log_gamma, s);
            for (int i = 0; i < s->n; i++) {
                same = same && last[at + i] == s->match[i];
                last[at + i] = s->match[i];
            }
        }
        *n = rows(w, r);
        if (*n == 0) return INFINITY;
        double before = x->log_gamma;
        for (int i = 0; i < 6; i++) {
            newton(r, *n, NULL, nu_free(w), x);
            spectra(w, x->nu);
            rows(w, r);
        }
        if (same && fabs(x->log_gamma - before) < 1e-9) break;
    }
    return cost_of(w, r, *n, x);
}

/* ------------------------------------------------------------------ 3: damping */

static void warn(struct material_fit *f, struct arena *a, const char *text)
{
    f->warning = arena_line(a, f->warning, text);
}

/* One decay for each mode of an object, the mean of its strikes' by their errors: by what it lies beside a law is its
   own. Returns how many. */
static int decays(const struct material_set *set, int sets, struct material_decay *d, struct arena *room)
{
    struct {
        int object, mode;
    } *whose = arena_take(room, (size_t)count_modes(set, sets) + 1, sizeof *whose);
    int n = 0;
    for (int k = 0; k < sets; k++)
        for (int i = 0; i < set[k].n; i++) {
            struct material_decay one = {real_exp(set[k].log_lambda[i]), real_log(set[k].decay[i]),
                                         fmax(set[k].decay_error[i], 1e-9)};
            int at = 0;
            if (set[k].match[i] < 0) continue;
            while (at < n && (whose[at].object != set[k].object || whose[at].mode != set[k].match[i]))
                at++;
            if (at < n) {
                double before = 1.0 / (d[at].sigma * d[at].sigma), weight = 1.0 / (one.sigma * one.sigma);
                d[at].log_decay = (before * d[at].log_decay + weight * one.log_decay) / (before + weight);
                d[at].sigma = 1.0 / sqrt(before + weight);
                continue;
            }
            whose[n].object = set[k].object;
            whose[n].mode = set[k].match[i];
            d[n++] = one;
        }
    double scatter = material_damping_scatter(d, n);
    for (int i = 0; i < n; i++)
        d[i].sigma = sqrt(d[i].sigma * d[i].sigma + scatter * scatter);
    return n;
}

static void damping(const struct material_set *set, int sets, struct arena *a, struct material_fit *f)
{
    struct material_decay *d = ARENA_TAKE(a, struct material_decay, count_modes(set, sets) + 1);
    int n = decays(set, sets, d, a);
    f->best = MATERIAL_RAYLEIGH;
    for (int law = 0; law < MATERIAL_LAWS; law++)
        material_damping_fit(law, d, n, &f->damping[law]);
    for (int law = 0; law < MATERIAL_POWER; law++) {
        const struct material_damping *g = &f->damping[law];
        bool whole = n >= 3 * g->n; /* BIC means many modes; and with a term of 0 a law is the one without it */
        for (int k = 0; k < g->n; k++)
            whole = whole && g->figure[k].value > 0.0;
        if (whole && g->bic < f->damping[f->best].bic) f->best = law;
    }
    if (f->damping[f->best].scatter > lawless)
        warn(f, a,
             arena_format(
                 a,
                 "decays lie %.0f %% (rms) beside the likeliest law: they are not of one material; air, support "
                 "and what decays at once are among them (modes extract --modes takes the strongest)",
                 100.0 * f->damping[f->best].scatter));
}

/* No intervals. */
static void unsure(struct material_fit *f)
{
    struct material_figure *all[] = {&f->gamma, &f->nu};
    for (int k = 0; k < 2; k++)
        all[k]->low = all[k]->high = NAN;
    for (int law = 0; law < MATERIAL_LAWS; law++)
        for (int k = 0; k < 3; k++)
            f->damping[law].figure[k].low = f->damping[law].figure[k].high = NAN;
}

/* Modes beside a hum's lines may be the hum's in part. */
static bool without_hum(const struct material_set *set, int sets, struct arena *a, struct material_fit *f)
{
    int undamped = 0;
    for (int k = 0; k < sets; k++)
        undamped += set[k].hum;
    if (undamped)
        warn(
            f, a,
            arena_format(a,
                         "the recordings of %d of %d tables have a hum, which was left out: no intervals; record again "
                         "without it (modes extract says how many lines it has)",
                         undamped, sets));
    return undamped == 0;
}

void material_fit_damping(const struct material_set *set, int sets, struct arena *a, struct material_fit *f)
{
    *f = (struct material_fit){.modes = count_modes(set, sets), .gamma = {NAN, NAN, NAN}, .nu = {NAN, NAN, NAN}};
    f->matched = f->modes;
    for (int k = 0, mode = 0; k < sets; k++) /* which modes of two strikes are the same is not known */
        for (int i = 0; i < set[k].n; i++)
            set[k].match[i] = mode++;
    damping(set, sets, a, f);
    f->sure = without_hum(set, sets, a, f) && f->modes >= SURE_MODES;
    if (f->modes < SURE_MODES)
        warn(f, a, arena_format(a, "%d modes are few, and %d are needed for intervals", f->modes, SURE_MODES));
    if (!f->sure) unsure(f);
}

/* ------------------------------------------------------------------ the whole */

static void figures(struct work *w, struct row *r, int n, const struct solution *x, struct material_fit *f)
{
    const struct material_problem *p = w->p;
    struct arena *room = arena_open();
    const bool free_nu = nu_free(w);
    struct solution once = *x;
    double square = 0.0;
    for (int i = 0; i < n; i++) {
        double rest = r[i].off - 0.5 * x->log_gamma;
        square += rest * rest;
    }
    f->scatter = sqrt(square / n);
    f->distinct = n = merged(r, n, p->model_error);
    newton(r, n, NULL, free_nu, &once);
    double *times = ARENA_TAKE(room, double, n), *gamma = ARENA_TAKE(room, double, MATERIAL_DRAWS),
           *nu = ARENA_TAKE(room, double, MATERIAL_DRAWS), t = material_damping_student(n - 1 - free_nu);
    f->birge = sqrt(once.chi2 / fmax(n - 1 - free_nu, 1));
    for (int i = 0; i < MATERIAL_DRAWS; i++) {
        struct solution one = *x;
        material_damping_resample(i, "modes", n, times);
        /* rows are linear in nu here: what a draw moves is little */
        for (int pass = 0; pass < 4; pass++) {
            struct row *moved = ARENA_TAKE(room, struct row, n);
            for (int j = 0; j < n; j++) {
                moved[j] = r[j];
                moved[j].off -= r[j].slope * (one.nu - x->nu);
            }
            newton(moved, n, times, free_nu, &one);
        }
        gamma[i] = one.log_gamma;
        nu[i] = one.nu;
    }
    /* what the mesh's error is taken to be may be wrong by as much, of all modes alike: what that does to both */
    struct solution moved = *x;
    for (int i = 0; i < n; i++)
        r[i].off += unsure_mesh * r[i].mesh;
    for (int pass = 0; pass < 4; pass++) {
        struct row *there = ARENA_TAKE(room, struct row, n);
        for (int i = 0; i < n; i++) {
            there[i] = r[i];
            there[i].off -= r[i].slope * (moved.nu - x->nu);
        }
        newton(there, n, NULL, free_nu, &moved);
    }
    double half = fmax(t * f->birge * sqrt(once.covariance[0]), material_damping_spread(gamma, x->log_gamma)),
           half_nu = fmax(t * f->birge * sqrt(once.covariance[2]), material_damping_spread(nu, x->nu)),
           size = 1.96 * 2.0 * p->size_error, mesh = 1.96 * (moved.log_gamma - x->log_gamma),
           mesh_nu = 1.96 * (moved.nu - x->nu);
    half = sqrt(half * half + size * size + mesh * mesh);
    half_nu = sqrt(half_nu * half_nu + mesh_nu * mesh_nu);
    f->gamma =
        (struct material_figure){real_exp(x->log_gamma), real_exp(x->log_gamma - half), real_exp(x->log_gamma + half)};
    f->nu = (struct material_figure){x->nu, fmax(x->nu - half_nu, 0.0), fmin(x->nu + half_nu, 0.5)};
    if (!free_nu) f->nu.low = f->nu.high = NAN;
    f->correlation = free_nu ? once.covariance[1] / sqrt(once.covariance[0] * once.covariance[2]) : 0.0;
    f->nu_known = free_nu && half_nu < 0.2;
    f->nu_at_bound = free_nu && (x->nu <= 0.0 || x->nu >= highest_nu);
    arena_close(room);
}

/* Half of the modes may be of something else if those that match are many. Few do not tell a bar that is free from one
   that is clamped: of ten modes six matched within 0.06 %, with E/density 0.8 % off, and Poisson's ratio near 0. */
static void certainty(const struct work *w, struct arena *a, struct material_fit *f)
{
    double edge[2] = {real_log(w->p->gamma[0]), real_log(w->p->gamma[1])}, at = real_log(f->gamma.value);
    f->sure = without_hum(w->p->set, w->p->sets, a, f) && f->distinct >= SURE_MODES && f->unique && !f->nu_at_bound;
    if (f->distinct < SURE_MODES)
        warn(f, a,
             arena_format(a, "%d modes match computed ones, and %d are needed for intervals", f->distinct, SURE_MODES));
    if (!f->unique)
        warn(f, a,
             arena_format(a,
                          "not unique: E/density %.4g m^2/s^2 with Poisson's ratio %.3f fits nearly as well (cost %.3g "
                          "to %.3g); more strikes, another place, or the object's exact sizes may decide",
                          f->next.gamma, f->next.nu, f->next.cost, f->cost));
    if (2 * f->matched < f->modes || (f->matched < MANY && 4 * f->matched < 3 * f->modes)) {
        f->sure = false;
        warn(f, a,
             arena_format(a,
                          "only %d of %d modes match computed ones: is it this object, held like this, of these sizes?",
                          f->matched, f->modes));
    }
    if (f->nu_at_bound)
        warn(f, a,
             arena_format(a, "Poisson's ratio came to the end of what is looked for, %.2f: give --poisson",
                          f->nu.value));
    else if (nu_free(w) && !f->nu_known)
        warn(f, a, "these modes hardly depend on Poisson's ratio: its interval is wide; give --poisson if it is known");
    if (f->gamma.value > hardest) {
        f->sure = false;
        warn(f, a,
             arena_format(a, "E/density %.3g m^2/s^2 is more than diamond's: are the sizes right, and their units?",
                          f->gamma.value));
    }
    if (fabs(at - edge[0]) < 0.01 || fabs(at - edge[1]) < 0.01) {
        f->sure = false;
        warn(f, a, "E/density lies at the end of what is looked for; give --gamma");
    }
    if (f->birge > 4.0)
        warn(
            f, a,
            arena_format(a,
                         "matched modes lie %.2g %% (rms) beside computed ones, more than their errors explain: shape, "
                         "sizes or support differ from the object's",
                         100.0 * f->scatter));
    if (!f->sure) unsure(f);
}

static void count_missing(const struct work *w, const struct solution *x, struct material_fit *f)
{
    for (int k = 0; k < w->p->sets; k++) {
        const struct material_set *s = &w->p->set[k];
        const struct spectrum *c = &w->now[s->object];
        for (int j = 0; j < c->n; j++) {
            double at = c->branch[j].log_ratio + x->log_gamma;
            bool found = at > s->log_lambda[s->n - 1] || at < s->log_lambda[0] || visible(s, c->branch[j].of) < 0.5;
            for (int i = 0; !found && i < s->n; i++)
                found = s->match[i] == c->branch[j].of;
            f->missing += !found;
        }
    }
}

bool material_fit(const struct material_problem *p, struct arena *a, struct material_fit *f, struct err *e)
{
    struct arena *room = arena_open();
    struct work w = {.p = p, .arena = room};
    struct place place[PLACES];
    struct solution best = {0};
    int n = 0, most = 0, all = count_modes(p->set, p->sets), best_at = -1;
    *f = (struct material_fit){.modes = all, .cost = INFINITY, .next.cost = NAN};
    for (int k = 0; k < p->sets; k++)
        w.objects = p->set[k].object + 1 > w.objects ? p->set[k].object + 1 : w.objects;
    w.now = ARENA_TAKE(room, struct spectrum, w.objects);
    for (int o = 0; o < w.objects; o++) {
        w.now[o].branch = ARENA_TAKE(room, struct branch, p->object[o].n);
        most = p->object[o].n > most ? p->object[o].n : most;
    }
    w.log_ratio = ARENA_TAKE(room, double, most);
    w.slope = ARENA_TAKE(room, double, most);
    struct row *r = ARENA_TAKE(room, struct row, all);
    struct solution *at = ARENA_TAKE(room, struct solution, PLACES);
    int places = all >= LEAST_MODES ? scan(&w, place) : 0;
    for (int k = 0; k < places; k++) {
        at[k] = (struct solution){.log_gamma = place[k].log_gamma, .nu = place[k].nu};
        place[k].cost = refine(&w, &at[k], r, &n);
        if (n >= LEAST_MODES && place[k].cost < f->cost) {
            f->cost = place[k].cost;
            best_at = k;
        }
    }
    if (best_at < 0) {
        arena_close(room);
        return err_set(
            e, ERR_SCENE,
            "of %d modes no %d match those of the object for any E/density from %.3g to %.3g m^2/s^2; are its "
            "shape and sizes (and units) right?",
            all, LEAST_MODES, p->gamma[0], p->gamma[1]);
    }
    for (int k = 0; k < places; k++)
        if (fabs(at[k].log_gamma - at[best_at].log_gamma) > distinct && !(place[k].cost >= f->next.cost)) {
            f->next.cost = place[k].cost;
            f->next.gamma = real_exp(at[k].log_gamma);
            f->next.nu = at[k].nu;
        }
    best = at[best_at];
    f->cost = refine(&w, &best, r, &n);
    f->matched = n;
    f->unique = !(f->next.cost < unlike * f->cost);
    figures(&w, r, n, &best, f);
    count_missing(&w, &best, f);
    damping(p->set, p->sets, a, f);
    certainty(&w, a, f);
    arena_close(room);
    return true;
}
