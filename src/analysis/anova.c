/* See anova.h. An effect's part of the values is what is left when they are averaged over the factors that it has not
   and centred along those that it has. Its mean over listeners makes the effect's sum of squares, what listeners depart
   from that the error's (Winer, Brown and Michels, Statistical principles in experimental design, 1991, chapter 7).
   Arrays keep their size, so that each square counts as often as it should.

   Greenhouse and Geisser (Psychometrika 24, 1959, 95): epsilon = (tr S)^2/(df tr S^2), S the covariance of those parts
   between cells. tr S^2 is computed from the products of listeners' parts where these are fewer.

   The studentized range (Copenhaver and Holland, J. Statist. Comput. Simul. 30, 1988, 1): with
       W(w) = k integral of phi(z) (Phi(z) - Phi(z - w))^(k-1) dz,  P(Q > q) = integral of f(s) (1 - W(q s)) ds,
   f the density of chi/sqrt(df); both by Gauss and Legendre on panels: |z| <= 9 and |s - 1| <= 9/sqrt(df), beyond which
   less than 1e-17 lies, and q s <= 19, beyond which 1 - W is less than 1e-30. */
#include "analysis/anova.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_pow_int.h>
#include <gsl/gsl_sf_gamma.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "num/real.h"
#include "num/special.h"

/* Along an axis of n values, `stride` apart, each becomes their mean (centre: what it departs from that). */
static void project(double *y, int all, int n, int stride, bool centre)
{
    for (int i = 0; i < all; i++) {
        if (i / stride % n) continue; /* not the first of its line */
        double mean = 0;
        for (int k = 0; k < n; k++)
            mean += y[i + k * stride] / n;
        for (int k = 0; k < n; k++)
            y[i + k * stride] = centre ? y[i + k * stride] - mean : mean;
    }
}

static double squares(const double *y, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += y[i] * y[i];
    return sum;
}

/* The values averaged over the factors that the mask has not, and centred along the others where `centre` says so. */
static double *parts(const struct anova_design *d, unsigned mask, bool centre, struct arena *a)
{
    int all = d->people * d->cells, stride = 1;
    double *y = ARENA_TAKE(a, double, all);
    memcpy(y, d->y, (size_t)all * sizeof *y);
    for (int k = d->factors - 1; k >= 0; stride *= d->levels[k--])
        if (centre || !(mask >> k & 1)) project(y, all, d->levels[k], stride, mask >> k & 1);
    return y;
}

static void effect_of(const struct anova_design *d, struct arena *a, struct anova_effect *e)
{
    int all = d->people * d->cells;
    double *y = parts(d, e->factors, true, a), *mean = ARENA_TAKE(a, double, all), shared = 0;
    memcpy(mean, y, (size_t)all * sizeof *y);
    project(mean, all, d->people, d->cells, false);
    project(y, all, d->people, d->cells, true);
    e->df = 1;
    for (int k = 0; k < d->factors; k++)
        e->df *= e->factors >> k & 1 ? d->levels[k] - 1 : 1;
    e->df_error = e->df * (d->people - 1);
    e->ss = squares(mean, all);
    e->ss_error = squares(y, all);
    double least = 1e-26 * squares(d->y, all); /* what rounding leaves of nothing */
    e->ss = e->ss > least ? e->ss : 0;
    e->ss_error = e->ss_error > least ? e->ss_error : 0;
    e->f = e->ss / e->df / (e->ss_error / e->df_error);
    e->eta = e->ss / (e->ss + e->ss_error);
    bool fewer = d->people < d->cells; /* tr (Y'Y)^2 = tr (YY')^2 */
    int n = fewer ? d->people : d->cells, own = fewer ? d->cells : 1, other = fewer ? 1 : d->cells;
    for (int i = 0; i < n; i++)
        for (int j = 0; j <= i; j++) {
            double product = 0;
            for (int k = 0; k < all / n; k++)
                product += y[i * own + k * other] * y[j * own + k * other];
            shared += (j < i ? 2 : 1) * product * product;
        }
    e->epsilon = e->df == 1 || e->ss_error == 0 ? 1 : e->ss_error * e->ss_error / (e->df * shared);
    e->p = isfinite(e->f) ? gsl_cdf_fdist_Q(e->f, e->df, e->df_error) : isnan(e->f) ? (double)NAN : 0;
    e->p_gg = isfinite(e->f) ? gsl_cdf_fdist_Q(e->f, e->epsilon * e->df, e->epsilon * e->df_error) : e->p;
}

void anova_within(const struct anova_design *d, struct anova_effect *effect)
{
    struct arena *scratch = arena_open();
    for (unsigned m = 1; m < 1u << d->factors; m++) {
        effect[m - 1] = (struct anova_effect){.factors = m};
        effect_of(d, scratch, &effect[m - 1]);
    }
    arena_close(scratch);
}

void anova_means(const struct anova_design *d, unsigned mask, struct arena *a, double *mean, double *sem)
{
    double *y = parts(d, mask, false, a);
    for (int c = 0; c < d->cells; c++) {
        double sum = 0, square = 0;
        for (int i = 0; i < d->people; i++)
            sum += y[i * d->cells + c];
        mean[c] = sum / d->people;
        for (int i = 0; i < d->people; i++)
            square += (y[i * d->cells + c] - mean[c]) * (y[i * d->cells + c] - mean[c]);
        sem[c] = sqrt(square / (d->people - 1) / d->people);
    }
}

/* ------------------------------------------------------------------ Tukey */

enum { POINTS = 16, PANELS = 12 };

struct rule {
    double node[POINTS], weight[POINTS];
    double z[PANELS * POINTS], below[PANELS * POINTS], mass[PANELS * POINTS]; /* Phi(z), phi(z) dz */
};

static void rule_make(struct rule *g)
{
    double half = 9.0 / PANELS;
    special_gauss_legendre(POINTS, g->node, g->weight);
    for (int i = 0; i < PANELS * POINTS; i++) {
        g->z[i] = -9 + half * (2 * (i / POINTS) + 1 + g->node[i % POINTS]);
        g->below[i] = special_normal_cdf(g->z[i]);
        g->mass[i] = half * g->weight[i % POINTS] * special_normal_density(g->z[i]);
    }
}

/* 1 - W(w): the range of k standard normal numbers is more than w. */
static double range_tail(double w, int k, const struct rule *g)
{
    double sum = 0;
    for (int i = 0; i < PANELS * POINTS; i++)
        sum += g->mass[i] * gsl_pow_int(fmax(0, g->below[i] - special_normal_cdf(g->z[i] - w)), k - 1);
    return 1 - k * sum;
}

double anova_studentized_range(double q, int groups, double df)
{
    if (!(q > 0)) return isnan(q) ? (double)NAN : 1;
    struct rule g;
    rule_make(&g);
    double from = fmax(0, 1 - 9 / sqrt(df)), to = fmin(1 + 9 / sqrt(df), 19 / q), sum = 0;
    if (isinf(df)) return fmax(0, range_tail(q, groups, &g));
    double scale = df / 2 * real_log(df) - gsl_sf_lngamma(df / 2) - (df / 2 - 1) * real_log(2);
    for (int p = 0; p < PANELS && to > from; p++)
        for (int i = 0; i < POINTS; i++) {
            double half = (to - from) / 2 / PANELS, s = from + half * (2 * p + 1 + g.node[i]);
            double density = real_exp(scale + (df - 1) * real_log(s) - df * s * s / 2);
            sum += half * g.weight[i] * density * range_tail(q * s, groups, &g);
        }
    return fmin(fmax(0, sum), 1);
}

double anova_tukey(const struct anova_design *d, const struct anova_effect *e, double difference)
{
    int groups = 1;
    for (int k = 0; k < d->factors; k++)
        groups *= e->factors >> k & 1 ? d->levels[k] : 1;
    double each = (double)d->people * d->cells / groups; /* values of each mean */
    return anova_studentized_range(fabs(difference) / sqrt(e->ss_error / e->df_error / each), groups, e->df_error);
}
