/* Modes that are not in a fit yet: sub-band ESPRIT (Roy, Kailath 1989) on what it leaves, each band's poles polished
   together on the band's own bins with the smooth columns, and tested before they come in. */
#include <gsl/gsl_blas.h>
#include <gsl/gsl_complex_math.h>
#include <gsl/gsl_eigen.h>
#include <stdlib.h>
#include <string.h>

#include "analysis/modal_fit.h"

enum { SAMPLES = 128, ROWS = 40, ORDER = 12, EDGE = 3, WEAKEST = 3, NEIGHBOURS = 8 };

static const double enter = 38.0; /* chi squared of 4 degrees, chance 1.1e-7 */

/* ------------------------------------------------------------------ bands */

/* Samples of the complex envelope of what is left in a stretch within `half` of `at` rad/s, pi/half seconds apart, with
 * cosine edges of a quarter at each side. */
static int envelope(const struct modal_fit *f, int s, double at, double half, cplx *y)
{
    const struct modal_stretch *st = &f->data->stretch[s];
    const struct modal_bins *b = &f->bins[s];
    double step = REAL_PI / half, samples = step * f->data->rate;
    long first = (long)ceil((double)st->ringing / samples) + EDGE, end = (long)floor((double)st->n / samples) - EDGE,
         from = (long)ceil((at - half) / b->width) - b->first, to = (long)floor((at + half) / b->width) - b->first,
         n = end < first             ? 0
             : end < first + SAMPLES ? end - first
                                     : SAMPLES;
    memset(y, 0, (size_t)n * sizeof *y);
    for (long k = from > 0 ? from : 0; k <= to && k < b->n; k++) {
        double off = (double)(b->first + k) * b->width - at, edge = 2.0 * fabs(off) / half - 1.0,
               w = edge > 0.0 ? 0.5 + 0.5 * real_cospi(edge) : 1.0;
        cplx turn = cplx_exp((cplx){0.0, off}, step),
             z = cplx_mul(b->rest[k], cplx_exp((cplx){0.0, off}, (double)first * step));
        z = cplx_scale(w / sqrt((double)st->n), z);
        for (long i = 0; i < n; i++, z = cplx_mul(z, turn))
            y[i] = cplx_add(y[i], z);
    }
    return (int)n;
}

/* ------------------------------------------------------------------ ESPRIT */

/* Eigenvalues of a complex matrix. GSL has them of real ones: [Re a, -Im a; Im a, Re a] has those of a and their
   conjugates. With j times more than the norm of a added to all of them, a's own are those above the real axis. */
static int eigenvalues(const gsl_matrix_complex *a, cplx *value)
{
    size_t m = a->size1;
    int found = 0;
    double up = 1.0;
    gsl_matrix *real = gsl_matrix_alloc(2 * m, 2 * m);
    gsl_vector_complex *all = gsl_vector_complex_alloc(2 * m);
    gsl_eigen_nonsymm_workspace *w = gsl_eigen_nonsymm_alloc(2 * m);
    for (size_t i = 0; i < m * m; i++) {
        gsl_complex at = gsl_matrix_complex_get(a, i / m, i % m);
        up += fabs(GSL_REAL(at)) + fabs(GSL_IMAG(at));
    }
    for (size_t i = 0; i < m; i++)
        for (size_t j = 0; j < m; j++) {
            gsl_complex at = gsl_complex_add_imag(gsl_matrix_complex_get(a, i, j), i == j ? up : 0.0);
            gsl_matrix_set(real, i, j, GSL_REAL(at));
            gsl_matrix_set(real, m + i, m + j, GSL_REAL(at));
            gsl_matrix_set(real, m + i, j, GSL_IMAG(at));
            gsl_matrix_set(real, i, m + j, -GSL_IMAG(at));
        }
    if (gsl_eigen_nonsymm(real, all, w) == GSL_SUCCESS)
        for (size_t i = 0; i < 2 * m && (size_t)found < m; i++) {
            gsl_complex at = gsl_vector_complex_get(all, i);
            if (GSL_IMAG(at) > 0.0) value[found++] = (cplx){GSL_REAL(at), GSL_IMAG(at) - up};
        }
    gsl_eigen_nonsymm_free(w);
    gsl_vector_complex_free(all);
    gsl_matrix_free(real);
    return found;
}

/* Eigenvalues of psi, U_up psi = U_down by normal equations of orthonormal columns: (I - u u^H) is inverted in closed
 * form, u the last row. */
static int shifts(const gsl_matrix_complex *v, size_t order, cplx *z)
{
    const gsl_complex one = {{1.0, 0.0}}, none = {{0.0, 0.0}};
    size_t last = v->size1 - 1;
    double square = 0.0;
    if (order == 0) return 0;
    gsl_matrix_complex_const_view above = gsl_matrix_complex_const_submatrix(v, 0, 0, last, order),
                                  below = gsl_matrix_complex_const_submatrix(v, 1, 0, last, order);
    gsl_matrix_complex *psi = gsl_matrix_complex_alloc(order, order);
    gsl_vector_complex *u = gsl_vector_complex_alloc(order), *w = gsl_vector_complex_alloc(order);
    for (size_t i = 0; i < order; i++) {
        gsl_complex at = gsl_complex_conjugate(gsl_matrix_complex_get(v, last, i));
        gsl_vector_complex_set(u, i, at);
        square += gsl_complex_abs2(at);
    }
    gsl_blas_zgemm(CblasConjTrans, CblasNoTrans, one, &above.matrix, &below.matrix, none, psi);
    gsl_blas_zgemv(CblasConjTrans, one, psi, u, none, w);
    if (square < 1.0 - 1e-12) gsl_blas_zgerc((gsl_complex){{1.0 / (1.0 - square), 0.0}}, u, w, psi);
    int found = eigenvalues(psi, z);
    gsl_vector_complex_free(w);
    gsl_vector_complex_free(u);
    gsl_matrix_complex_free(psi);
    return found;
}

/* Poles of a band from all its stretches' envelopes; z per sample of the envelope. */
static int esprit(cplx (*y)[SAMPLES], const int *n, int stretches, cplx *z)
{
    int longest = 0, vectors = 0, order = 0;
    for (int s = 0; s < stretches; s++)
        longest = n[s] > longest ? n[s] : longest;
    int rows = longest / 2 < ROWS ? longest / 2 : ROWS;
    if (rows < 6) return 0;
    gsl_matrix_complex *r = gsl_matrix_complex_calloc((size_t)rows, (size_t)rows),
                       *v = gsl_matrix_complex_alloc((size_t)rows, (size_t)rows);
    gsl_vector *value = gsl_vector_alloc((size_t)rows);
    gsl_eigen_hermv_workspace *w = gsl_eigen_hermv_alloc((size_t)rows);
    for (int s = 0; s < stretches; s++)
        for (int t = 0; t + rows <= n[s]; t++, vectors++) {
            gsl_vector_complex_view x = gsl_vector_complex_view_array(&y[s][t].re, (size_t)rows);
            gsl_blas_zher(CblasLower, 1.0, &x.vector, r);
        }
    if (vectors >= rows / 2) {
        gsl_eigen_hermv(r, value, v, w);
        gsl_eigen_hermv_sort(value, v, GSL_EIGEN_SORT_VAL_DESC);
        double median = fmax(gsl_vector_get(value, (size_t)(rows - 1 - rows / 2)), 1e-13 * gsl_vector_get(value, 0));
        while (order < ORDER && order < rows / 2 && gsl_vector_get(value, (size_t)order) > 3.0 * median)
            order++;
        order = shifts(v, (size_t)order, z);
    }
    gsl_eigen_hermv_free(w);
    gsl_vector_free(value);
    gsl_matrix_complex_free(v);
    gsl_matrix_complex_free(r);
    return order;
}

/* ------------------------------------------------------------------ tests */

double modal_search_round(struct modal_fit *f, double *noise)
{
    double most = 0.0;
    *noise = HUGE_VAL;
    modal_fit_noise(f, 0.0);
    for (int s = 0; s < f->data->stretches; s++) {
        struct modal_bins *b = &f->bins[s];
        for (long k = 0; k < b->n && f->data->stretch[s].fitted; k++) {
            most = fmax(most, cplx_square(b->noise[k]) / b->scale[k]);
            *noise = fmin(*noise, b->variance[k] / b->scale[k]);
        }
    }
    return most;
}

/* The greatest power that a component has in any bin, over the lead's. */
static double power_of(const struct modal_fit *f, cplx s, const struct modal_part *part)
{
    double most = 0.0, x[8][MODAL_CHUNK];
    for (int k = 0; k < f->data->stretches; k++) {
        const struct modal_bins *b = &f->bins[k];
        long at = (long)rint(s.im / b->width) - b->first;
        if (!f->data->stretch[k].fitted || at < 0 || at >= b->n) continue;
        struct modal_line line = modal_fit_line(f, k, s);
        modal_fit_basis(b, &line, at, 1, x);
        most = fmax(most, 0.25 * cplx_square(part[k].gain) * (x[0][0] * x[0][0] + x[1][0] * x[1][0]) / b->scale[at]);
    }
    return most;
}

/* The greatest power in a band's middle, if that holds more than noise, in a bin or in all of them together; else 0. */
static double stands_out(const struct modal_fit *f, double low, double high)
{
    double excess = 0.0, count = 0.0, most = 0.0, power = 0.0;
    for (int s = 0; s < f->data->stretches; s++) {
        const struct modal_bins *b = &f->bins[s];
        if (!f->data->stretch[s].fitted) continue;
        long from = (long)ceil(low / b->width) - b->first, to = (long)floor(high / b->width) - b->first;
        for (long k = from > 0 ? from : 0; k <= to && k < b->n; k++) {
            double q = cplx_square(b->noise[k]) / b->variance[k];
            excess += q - 1.0;
            count++;
            most = fmax(most, q);
            power = fmax(power, q * b->variance[k] / b->scale[k]);
        }
    }
    return count > 0.0 && (most > 9.0 || excess > 3.0 * sqrt(count)) ? power : 0.0;
}

/* What each component must be worth: `alike` times as much in the window of a stronger one, as what the model leaves of
 * that is no noise. */
static void limits(const struct modal_block *b, double limit, double alike, double *to)
{
    double size[MODAL_BLOCK];
    for (int i = 0; i < b->m; i++)
        size[i] = power_of(b->fit, b->s[i], b->part + i * b->fit->data->stretches);
    for (int i = 0; i < b->m; i++) {
        to[i] = limit;
        for (int k = 0; k < b->m; k++)
            if (size[k] > size[i] &&
                fabs(b->s[k].im - b->s[i].im) < MODAL_REACH * (-b->s[k].re + 4.0 * REAL_PI / b->fit->longest))
                to[i] = alike * limit;
    }
}

/* Drops at once what is too faint for this round, then one by one what the others do without, poles as they are. */
static void rough_only(struct modal_block *b, double limit, double alike, double least)
{
    double worth[MODAL_BLOCK], needed[MODAL_BLOCK];
    for (bool again = true; again && b->m > 0;) {
        int weakest = -1, m = b->m;
        modal_block_worth(b, worth);
        for (int i = b->m - 1; i >= 0; i--)
            if (b->of[i] < 0 && power_of(b->fit, b->s[i], b->part + i * b->fit->data->stretches) < 0.25 * least) {
                modal_block_drop(b, i);
                memmove(worth + i, worth + i + 1, (size_t)(b->m - i) * sizeof *worth);
            }
        limits(b, limit, alike, needed);
        for (int i = 0; i < b->m; i++)
            weakest =
                b->of[i] < 0 && (weakest < 0 || worth[i] * needed[weakest] < worth[weakest] * needed[i]) ? i : weakest;
        again = b->m < m;
        if (!again && weakest >= 0 && worth[weakest] < needed[weakest]) {
            modal_block_drop(b, weakest);
            again = true;
        }
    }
}

/* Drops that of the weakest components without which chi rises least, over what it must, the others fitted anew, until
 * all are needed. */
static void needed_only(struct modal_block *b, double limit, double alike)
{
    struct arena *a = arena_open();
    struct modal_block *try = modal_block_room(b->fit, a), *best = modal_block_room(b->fit, a);
    double worth[MODAL_BLOCK], needed[MODAL_BLOCK];
    while (b->m > 0) {
        double least = HUGE_VAL;
        modal_block_worth(b, worth);
        limits(b, limit, alike, needed);
        for (int i = 0; i < b->m; i++) {
            int less = 0;
            for (int k = 0; k < b->m; k++)
                less += b->of[k] < 0 && worth[k] * needed[i] < worth[i] * needed[k];
            if (b->of[i] >= 0 || worth[i] > 100.0 * needed[i] || less >= WEAKEST) continue;
            modal_block_copy(try, b);
            modal_block_drop(try, i);
            modal_block_polish(try, 3);
            double rise = (try->chi - b->chi) / needed[i];
            if (rise < least) modal_block_copy(best, try);
            least = fmin(least, rise);
        }
        if (least >= 1.0) break;
        modal_block_copy(b, best);
        modal_block_polish(b, 5);
    }
    arena_close(a);
}

static int new_ones(const struct modal_block *b)
{
    int n = 0;
    for (int i = 0; i < b->m; i++)
        n += b->of[i] < 0;
    return n;
}

static bool accepted(const struct modal_block *b, int i, double low, double high, double least)
{
    const struct modal_fit *f = b->fit;
    return b->of[i] < 0 && b->s[i].im >= low && b->s[i].im < high && b->s[i].im > f->low && b->s[i].im < f->high &&
           -b->s[i].re < 0.99 * fmin(f->fastest, high - low) &&
           power_of(f, b->s[i], b->part + i * f->data->stretches) >= least;
}

/* Poles of one band: polished together and with the modes that are there already, tested, added where they lie in its
 * middle. */
static int take(struct modal_fit *f, cplx *pole, int n, double low, double high, double limit, double least)
{
    struct arena *a = arena_open();
    int came = 0, there = 0, of[NEIGHBOURS + 1], stretches = f->data->stretches;
    double quarter = 0.25 * (high - low), at = 0.5 * (low + high);
    for (int i = 0; i < f->m; i++) { /* the nearest to the band's middle */
        int k = there;
        if (f->c[i].s.im <= low - quarter || f->c[i].s.im >= high + quarter) continue;
        for (; k > 0 && fabs(f->c[of[k - 1]].s.im - at) > fabs(f->c[i].s.im - at); k--)
            of[k] = of[k - 1];
        of[k] = i;
        there += there < NEIGHBOURS;
    }
    struct modal_block *b = modal_block_open(f, there, of, pole, n, a);
    b->fastest = fmin(f->fastest, high - low);
    for (int i = 0; i < there; i++) /* those that are there may be faster than the band lets new ones be */
        b->fastest = fmax(b->fastest, -f->c[of[i]].s.re);
    rough_only(b, 0.3 * limit, 1.0, least);
    if (new_ones(b)) modal_block_polish(b, 8);
    double alike = new_ones(b) ? modal_block_alike(b) : 1.0;
    rough_only(b, 0.3 * limit, alike, least);
    if (new_ones(b)) needed_only(b, limit, alike);
    for (int i = 0; i < b->m; i++)
        came += accepted(b, i, low, high, least);
    for (int i = 0; i < b->m && came; i++) {
        if (b->of[i] >= 0) {
            modal_fit_replace(f, b->of[i], b->s[i], b->part + i * stretches);
            f->c[b->of[i]].moved = 1.0;
        } else if (accepted(b, i, low, high, least)) {
            modal_fit_add(f, b->s[i], b->part + i * stretches);
        }
    }
    arena_close(a);
    return came;
}

struct band {
    double centre, power; /* rad/s */
};

static int stronger(const void *x, const void *y)
{
    const struct band *a = x, *b = y;
    return a->power != b->power ? (a->power < b->power) - (a->power > b->power)
                                : (a->centre > b->centre) - (a->centre < b->centre);
}

/* ESPRIT's poles of one band, within `half` of `at`, that may be modes of it. */
static int candidates(const struct modal_fit *f, double at, double half, cplx (*y)[SAMPLES], cplx *pole)
{
    const struct modal_data *d = f->data;
    double step = REAL_PI / half;
    int n[MODAL_STRETCHES], longest = 0, poles = 0;
    cplx z[ORDER];
    for (int s = 0; s < d->stretches; s++) {
        n[s] = d->stretch[s].fitted ? envelope(f, s, at, half, y[s]) : 0;
        longest = n[s] > longest ? n[s] : longest;
    }
    int order = esprit(y, n, d->stretches, z);
    for (int i = 0; i < order; i++) {
        double size = cplx_abs(z[i]), omega = at + real_atan2(z[i].im, z[i].re) / step,
               decay = size > 0.0 ? -real_log(size) / step : HUGE_VAL;
        if (fabs(omega - at) > 0.75 * half || omega <= f->low || omega >= f->high || decay > half ||
            decay < -2.0 / (step * (double)longest))
            continue;
        decay = fmax(decay, 0.3 / (step * (double)longest));
        pole[poles++] = (cplx){-fmin(decay, f->fastest), omega};
    }
    return poles;
}

/* What came is fitted with its neighbours at once, so that the next band sees what is really left. */
static int fit_in(struct modal_fit *f, int from)
{
    for (int i = from; i < f->m; i++) {
        int of[MODAL_BLOCK], near = modal_converge_near(f, i, 8, of);
        if (f->c[i].moved > 1.0) modal_converge_refine(f, near, of, 5);
    }
    int m = f->m;
    return m - from - modal_converge_runaways(f);
}

int modal_search(struct modal_fit *f, double width, double least)
{
    struct arena *a = arena_open();
    cplx(*y)[SAMPLES] = arena_take(a, (size_t)f->data->stretches, sizeof *y);
    int bands = 0, came = 0;
    double limit = modal_converge_limit(f, enter), half = REAL_PI * width, middle = 0.5 * half;
    struct band *band = ARENA_TAKE(a, struct band, (f->high - f->low) / half + 3.0);
    modal_fit_noise(f, 8.0 * width);
    for (double at = f->low; at < f->high + middle; at += half) {
        band[bands] = (struct band){at, stands_out(f, at - middle, at + middle)};
        bands += band[bands].power > 0.0 && band[bands].power >= least;
    }
    qsort(band, (size_t)bands, sizeof *band, stronger);
    for (int k = 0; k < bands && f->m < f->most; k++) {
        double at = band[k].centre;
        cplx pole[ORDER];
        int poles = candidates(f, at, half, y, pole), m = f->m;
        if (poles && take(f, pole, poles, at - middle, at + middle, limit, least)) came += fit_in(f, m);
    }
    arena_close(a);
    return came;
}
