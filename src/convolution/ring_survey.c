/* How fast a response moves along a motion, and the error that hops make: the formula of hop.h, mode by mode.

   A mode A e^(s tau) of an impulse response that is interpolated over hops of H seconds with a polynomial of p points errs by rms_u[l] H^p
   |d^p/dt^p A e^(s tau)|, l the polynomial's node product over p! (hop.c). To leading order the derivative is (A'/A + s' tau)^p A e^(s tau). s' is all
   but imaginary and A'/A real, so their squares add, and the mean of its square over tau, against that of e^(-sigma tau), is

       2 sigma int (g^2 + |s'|^2 tau^2)^p e^(-2 sigma tau) dtau = sum_j C(p, j) g^(2p-2j) |s'|^2j (2j)! / (2 sigma)^2j ,   g = |A'/A| ,

   of which hop_error (g = 0) is the last term. Where the way passes from one pair (or triangle) of places to the next, interpolation between places
   has a kink: A' and s' jump by D and J. A polynomial of 2 or 4 points over a kink in slope errs by c H^3 in the integral of the square per unit jump,
   on the average over where in the hop it falls, c = 1/90 and 0.00615 (tests/unit/test_ring_survey.c); the jump's square is D^2 + J^2 2/(2 sigma)^2
   after the same mean over tau. Near a gain's zero A'/A means nothing: there A counts as a tenth of the mode's largest on the way.
   Modes are summed by their energy |A|^2 / sigma, instants evenly, or by the square of the speed: a scrape is loud where it is fast. */
#include "convolution/ring_survey.h"

#include <math.h>
#include <string.h>

#include "convolution/hop.h"
#include "num/real.h"

enum { INSTANTS = 257, MOST_INSTANTS = 1025 }; /* of what has kinks always the most */
#define KINK 0.03 /* of the fastest movement: what slopes change by less between two instants is no kink */

static void row_at(const struct modes *m, const struct trajectory *tr, double t, const struct modes_point *p, double place[2])
{
    trajectory_continued(tr, t, place);
    if (m->shared) {
        memcpy(p->frequency, m->frequency, (size_t)m->n * sizeof *p->frequency);
        memcpy(p->decay, m->decay, (size_t)m->n * sizeof *p->decay);
    }
    modes_at(m, &(struct modes_where){place[0], place[1], tr->duration > 0 ? t / tr->duration : 0}, p);
}

static double size2(double x, double y)
{
    return sqrt(x * x + y * y);
}

/* Derivatives from one row to the next, of mode i. */
struct slope {
    double s[2], a[2], size, sigma; /* of pole and gain; |A|, decay between the rows */
};

static struct slope slope_of(const struct modes_point *rows, int k, int i, double step)
{
    const struct modes_point *p = &rows[k], *q = &rows[k + 1];
    return (struct slope){{(q->decay[i] - p->decay[i]) / step, 2 * REAL_PI * (q->frequency[i] - p->frequency[i]) / step},
                          {(q->re[i] - p->re[i]) / step, (q->im[i] - p->im[i]) / step},
                          size2(0.5 * (p->re[i] + q->re[i]), 0.5 * (p->im[i] + q->im[i])), fmax(0.5 * (p->decay[i] + q->decay[i]), 1e-3)};
}

/* |A' + s' A tau|^2, mean over tau as above, over A^2. */
static double movement(double gain, double pole, double scale, double sigma)
{
    return gain * gain / (scale * scale) + pole * pole / (2 * sigma * sigma);
}

struct walk {
    int instants;
    double step, least, limit; /* s; of |A|; of the square of a jump below which it is none */
    const double *loud;
};

/* Kinks of mode i. One that falls between two instants shows as two jumps one after the other, which are one. */
static double kinks_of(const struct modes_point *rows, int i, const struct walk *w)
{
    double sum = 0, ds[2] = {0, 0}, da[2] = {0, 0};
    int run = 0;
    for (int k = 1; k < w->instants; k++) {
        struct slope now = slope_of(rows, k, i, w->step), before = slope_of(rows, k - 1, i, w->step);
        double scale = fmax(now.size, w->least), js[2], ja[2];
        for (int c = 0; c < 2; c++) {
            js[c] = now.s[c] - before.s[c];
            ja[c] = now.a[c] - before.a[c];
        }
        bool kink = movement(size2(ja[0], ja[1]), size2(js[0], js[1]), scale, now.sigma) > w->limit;
        for (int c = 0; c < 2; c++) {
            ds[c] = kink ? ds[c] + js[c] : ds[c];
            da[c] = kink ? da[c] + ja[c] : da[c];
        }
        run = kink ? run + 1 : 2;
        if (run < 2)
            continue;
        run = 0;
        sum += w->loud[k] * scale * scale / now.sigma * movement(size2(da[0], da[1]), size2(ds[0], ds[1]), scale, now.sigma) / w->step;
        ds[0] = ds[1] = da[0] = da[1] = 0;
    }
    return sum;
}

/* Mode i: what its movement and its kinks come to. */
static void fill(struct ring_survey *s, const struct modes_point *rows, int i, const struct ring_survey_ask *ask)
{
    double step = s->duration / s->instants, largest = 0, fastest = 0;
    for (int k = 0; k <= s->instants; k++)
        largest = fmax(largest, size2(rows[k].re[i], rows[k].im[i]));
    for (int k = 0; k < s->instants; k++) {
        struct slope now = slope_of(rows, k, i, step);
        double scale = fmax(now.size, 0.1 * largest), gain = size2(now.a[0], now.a[1]), pole = size2(now.s[0], now.s[1]);
        int at = k * s->n + i;
        s->pole[at] = pole;
        s->gain[at] = scale > 0 ? gain / scale : 0;
        s->sigma[at] = now.sigma;
        s->weight[at] = s->loud[k] * scale * scale / now.sigma;
        s->energy[i] += s->loud[k] * now.size * now.size / now.sigma;
        fastest = fmax(fastest, scale > 0 ? movement(gain, pole, scale, now.sigma) : 0);
    }
    struct slope last = slope_of(rows, s->instants - 1, i, step);
    double end = fmax(last.size, 0.1 * largest);
    if (ask->stops && largest > 0)
        s->kinks[i] = s->loud[s->instants - 1] * end * end / last.sigma * movement(size2(last.a[0], last.a[1]), size2(last.s[0], last.s[1]), end, last.sigma) / step;
    if (ask->modes->kinks && largest > 0)
        s->kinks[i] += kinks_of(rows, i, &(struct walk){s->instants, step, 0.1 * largest, KINK * KINK * fastest, s->loud});
}

void ring_survey(const struct ring_survey_ask *ask, const struct trajectory *tr, struct arena *a, struct ring_survey *s)
{
    const struct modes *m = ask->modes;
    double span = m->travels ? tr->duration : tr->cycle;
    long asked = m->kinks ? MOST_INSTANTS - 1 : tr->straight ? INSTANTS - 1 : tr->detail;
    int steps = (int)(asked < INSTANTS - 1 ? INSTANTS - 1 : asked > MOST_INSTANTS - 1 ? MOST_INSTANTS - 1 : asked);
    struct modes_point *rows = ARENA_TAKE(a, struct modes_point, steps + 1);
    double even[2], odd[2];
    *s = (struct ring_survey){.n = m->n, .instants = steps, .duration = span};
    s->pole = ARENA_TAKE(a, double, (size_t)steps * m->n);
    s->gain = ARENA_TAKE(a, double, (size_t)steps * m->n);
    s->sigma = ARENA_TAKE(a, double, (size_t)steps * m->n);
    s->weight = ARENA_TAKE(a, double, (size_t)steps * m->n);
    s->energy = ARENA_TAKE(a, double, m->n);
    s->kinks = ARENA_TAKE(a, double, m->n);
    s->loud = ARENA_TAKE(a, double, steps);
    for (int k = 0; k <= steps; k++) {
        double place[2], *before = k % 2 ? even : odd, *now = k % 2 ? odd : even;
        rows[k] = modes_point_make(a, m->n);
        row_at(m, tr, span * k / steps, &rows[k], place);
        memcpy(now, place, sizeof place);
        if (k > 0)
            s->loud[k - 1] = ask->by_speed ? (now[0] - before[0]) * (now[0] - before[0]) + (now[1] - before[1]) * (now[1] - before[1]) : 1;
    }
    for (int i = 0; i < m->n; i++)
        fill(s, rows, i, ask);
}

/* The sum over j above: the mean square of the derivative, 1/s^(2p). */
static double moment(int order, double gain, double pole, double sigma)
{
    double sum = 0, term = 1, g2 = gain * gain, step = pole / (2 * sigma); /* j = 0: C(p, 0) 0! */
    for (int j = 0; j <= order; j++) {
        double g = term;
        for (int k = 0; k < order - j; k++)
            g *= g2;
        sum += g;
        term *= (double)(order - j) * 2 * (2 * j + 1) * step * step; /* C(p, j+1) (2j+2)! / (C(p, j) (2j)!) = (p - j) 2 (2j + 1) */
    }
    return sum;
}

/* rms_u[l]: hop_error(p, rho) is rms_u[l] ((2p)!)^(1/2) (rho/2)^p. */
static double node_rms(int order)
{
    double all = 1;
    for (int j = 2; j <= 2 * order; j++)
        all *= j;
    return hop_error(order, 2) / sqrt(all);
}

/* The square of the relative error is even hop^(2 order) + kinks hop^3. */
struct law {
    int order;
    double even, kinks;
};

static double law_square(const struct law *l, double hop)
{
    double even = l->even;
    for (int k = 0; k < 2 * l->order; k++)
        even *= hop;
    return even + l->kinks * hop * hop * hop;
}

static double law_hop(const struct law *l, double error, double most)
{
    double low = 0, high = most;
    if (law_square(l, most) <= error * error)
        return most;
    for (int i = 0; i < 60; i++) {
        double middle = 0.5 * (low + high);
        if (law_square(l, middle) <= error * error)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static double kink_share(int order)
{
    return order == 1 ? 0 : order == 2 ? 1.0 / 90 : 0.00615; /* of order 1 the movement itself is the error */
}

static struct law law_of_all(const struct ring_survey *s, int order)
{
    double sum = 0, kinks = 0, energy = 0, rms = node_rms(order);
    for (int k = 0; k < s->instants * s->n; k++)
        sum += s->weight[k] * moment(order, s->gain[k], s->pole[k], s->sigma[k]);
    for (int i = 0; i < s->n; i++) {
        kinks += s->kinks[i];
        energy += s->energy[i];
    }
    return energy > 0 ? (struct law){order, rms * rms * sum / energy, kink_share(order) * kinks / energy} : (struct law){order, 0, 0};
}

static struct law law_of_mode(const struct ring_survey *s, int order, int i)
{
    double worst = 0, rms = node_rms(order);
    for (int k = 0; k < s->instants; k++)
        worst = fmax(worst, moment(order, s->gain[k * s->n + i], s->pole[k * s->n + i], s->sigma[k * s->n + i]));
    return (struct law){order, rms * rms * worst, s->energy[i] > 0 ? kink_share(order) * s->kinks[i] / s->energy[i] : 0};
}

double ring_survey_error(const struct ring_survey *s, int order, double hop)
{
    struct law l = law_of_all(s, order);
    return sqrt(law_square(&l, hop));
}

double ring_survey_hop(const struct ring_survey *s, int order, double error, double most)
{
    struct law l = law_of_all(s, order);
    return law_hop(&l, error, most);
}

void ring_survey_hops(const struct ring_survey *s, int order, double error, double most, double *hop)
{
    for (int i = 0; i < s->n; i++) {
        struct law l = law_of_mode(s, order, i);
        hop[i] = law_hop(&l, error, most);
    }
}
