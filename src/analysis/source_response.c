#include "analysis/source_response.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_sort_double.h>
#include <string.h>

static const double clicks = 2.5e-3; /* s of a click in all, the last 1 ms fading */
enum { ROUNDS = 6, TURNS = 4 };

/* ------------------------------------------------------------------ pulses */

enum { SHIFTS = 512 };

/* Where a template is most like y about `at`, within `reach` samples: *at, and the size. Returns the share of the
   energy there. y has room on both sides. */
static double align(const double *y, const double *pulse, long n, long reach, bool both, double *at, double *size)
{
    double sum[2 * SHIFTS + 1], own = 0, best = 0, energy = 0;
    long middle = (long)rint(*at), top = 0;
    for (long i = 0; i < n; i++)
        own += pulse[i] * pulse[i];
    for (long s = -reach; s <= reach; s++) {
        sum[s + reach] = 0;
        for (long i = 0; i < n; i++)
            sum[s + reach] += pulse[i] * y[middle + s + i];
        if (both ? fabs(sum[s + reach]) <= fabs(best) : sum[s + reach] <= best) continue;
        best = sum[s + reach];
        top = s;
    }
    double u = 0;
    if (top > -reach && top < reach && best != 0) {
        const double *p = &sum[top + reach];
        double bend = p[-1] - 2 * p[0] + p[1], tilt = (p[1] - p[-1]) / 2;
        if (bend * best < 0) u = fmax(-0.5, fmin(-tilt / bend, 0.5));
        best += u * tilt / 2;
    }
    for (long i = 0; i < n; i++)
        energy += y[middle + top + i] * y[middle + top + i];
    *at = (double)(middle + top) + u;
    *size = own > 0 ? best / own : 0;
    return own > 0 && energy > 0 ? best * best / (own * energy) : 0;
}

/* Times and sizes of the onsets' pulses in what prediction does not foresee, which is as short as an impact: beside the
   one pulse that most are like. Those that are not alike, two at once, say, are none. */
void source_response_pulses(struct source_filter *f, const double *y, bool both, struct source_response_hits *h,
                            struct arena *a)
{
    enum { CANDIDATES = 6 };
    long early = (long)(SOURCE_MARGIN * f->rate), n = (long)((SOURCE_MARGIN + SOURCE_PAST) * f->rate),
         reach = 2 * early < SHIFTS ? 2 * early : SHIFTS, edge = n + reach + 2;
    double *pulse = ARENA_TAKE(a, double, n), *best = ARENA_TAKE(a, double, n),
           *power = ARENA_TAKE(a, double, f->onsets + 1), most = -1;
    int *order = ARENA_TAKE(a, int, f->onsets + 1), inside = 0;
    size_t *rank = ARENA_TAKE(a, size_t, f->onsets + 1);
    for (int k = 0; k < f->onsets; k++)
        if (f->onset[k] > edge && f->onset[k] + edge < f->n) order[inside++] = k;
    for (int k = 0; k < inside; k++)
        for (long i = 0; i < n; i++)
            power[k] += y[f->onset[order[k]] - early + i] * y[f->onset[order[k]] - early + i];
    *h = (struct source_response_hits){.at = ARENA_TAKE(a, double, f->onsets + 1),
                                       .size = ARENA_TAKE(a, double, f->onsets + 1)};
    if (!inside) return;
    gsl_sort_index(rank, power, 1, (size_t)inside);
    for (int c = 0; c < CANDIDATES && c < inside; c++) {
        const double *of = y + f->onset[order[rank[inside - 1 - c * inside / (2 * CANDIDATES)]]] - early;
        double sum = 0, at, size;
        for (int k = 0; k < inside; k++) {
            at = (double)(f->onset[order[k]] - early);
            sum += sqrt(power[k]) * align(y, of, n, reach, both, &at, &size);
        }
        if (sum > most) memcpy(best, of, (size_t)n * sizeof *best);
        most = fmax(most, sum);
    }
    for (int round = 0; round < ROUNDS; round++) {
        double all = 0;
        h->n = 0;
        memset(pulse, 0, (size_t)n * sizeof *pulse);
        for (int k = 0; k < inside; k++) {
            double at = (double)(f->onset[order[k]] - early), size;
            if (!(align(y, best, n, reach, both, &at, &size) > 0.5)) continue;
            long first = (long)floor(at);
            for (long i = 0; i < n; i++)
                pulse[i] += size * source_response_between(y + first + i, at - (double)first);
            all += size * size;
            h->at[h->n] = at + (double)early;
            h->size[h->n++] = size;
        }
        for (long i = 0; i < n && all > 0; i++)
            best[i] = pulse[i] / all;
    }
}

/* ------------------------------------------------------------------ gains */

/* to[n] += sum of size e^(s (t - at)), real and imaginary parts. */
static void driven(const struct source_filter *f, cplx s, const struct source_response_hits *h, long from, long n,
                   double *re, double *im)
{
    cplx z = {0, 0}, turn = cplx_exp(s, 1 / f->rate);
    int k = 0;
    for (long t = 0; t < from + n; t++) {
        z = cplx_mul(z, turn);
        for (; k < h->n && h->at[k] <= (double)t; k++)
            z = cplx_add(z, cplx_scale(h->size[k], cplx_exp(s, ((double)t - h->at[k]) / f->rate)));
        if (t < from) continue;
        re[t - from] = z.re;
        im[t - from] = z.im;
    }
}

bool source_response_solve(const double *basis, long columns, long stride, long n, double *x, double *to)
{
    gsl_matrix *normal = gsl_matrix_alloc((size_t)columns, (size_t)columns);
    gsl_vector *right = gsl_vector_alloc((size_t)columns);
    for (long p = 0; p < columns; p++) {
        double with = 0;
        for (long q = 0; q <= p; q++) {
            double sum = 0;
            for (long t = 0; t < n; t++)
                sum += basis[p * stride + t] * basis[q * stride + t];
            if (p == q) sum = sum * (1 + 1e-9) + 1e-300; /* two modes may be as good as one */
            gsl_matrix_set(normal, (size_t)p, (size_t)q, sum);
            gsl_matrix_set(normal, (size_t)q, (size_t)p, sum);
        }
        for (long t = 0; t < n; t++)
            with += basis[p * stride + t] * x[t];
        gsl_vector_set(right, (size_t)p, with);
    }
    bool ok = gsl_linalg_cholesky_decomp1(normal) == GSL_SUCCESS;
    if (ok) gsl_linalg_cholesky_svx(normal, right);
    for (long p = 0; ok && p < columns; p++) {
        to[p] = gsl_vector_get(right, (size_t)p);
        for (long t = 0; t < n; t++)
            x[t] -= to[p] * basis[p * stride + t];
    }
    gsl_vector_free(right);
    gsl_matrix_free(normal);
    return ok;
}

/* A of all modes at once, by least squares over the recording but for what is near an impact: x = sum Im A z. Of a long
   one over the part of most impacts. */
static bool fit_gains(struct source_filter *f, const struct source_response_hits *h)
{
    enum { LONGEST = 400000 };
    long n = f->n < LONGEST ? f->n : LONGEST, from = 0, used = 0, all = 2 * f->m;
    int most = 0;
    for (int k = 0, last = 0; k < h->n; k++) {
        while (last < h->n && h->at[last] < h->at[k] + (double)n)
            last++;
        if (last - k > most) from = (long)fmax(h->at[k], 0);
        most = last - k > most ? last - k : most;
    }
    from = from + n > f->n ? f->n - n : from;
    struct arena *a = arena_open();
    double *basis = ARENA_TAKE(a, double, all *n), *x = ARENA_TAKE(a, double, n), energy = 0, left = 0;
    bool *near = ARENA_TAKE(a, bool, n);
    for (int k = 0; k < h->n; k++)
        for (long t = (long)(h->at[k] - SOURCE_MARGIN * f->rate); t < (long)(h->at[k] + SOURCE_PAST * f->rate); t++)
            if (t >= from && t < from + n) near[t - from] = true;
    for (int i = 0; i < f->m; i++)
        driven(f, source_poles_of(&f->mode[i]), h, from, n, basis + (2 * i + 1) * n, basis + 2 * i * n);
    for (long t = 0; t < n; t++)
        if (!near[t]) {
            for (long p = 0; p < all; p++)
                basis[p * n + used] = basis[p * n + t];
            x[used] = f->x[from + t];
            energy += x[used] * x[used];
            used++;
        }
    double *gain = ARENA_TAKE(a, double, all);
    bool ok = used > 2 * all && source_response_solve(basis, all, n, used, x, gain);
    for (long t = 0; ok && t < used; t++)
        left += x[t] * x[t];
    for (int i = 0; ok && i < f->m; i++)
        f->mode[i].gain = (cplx){gain[2 * i], gain[2 * i + 1]};
    if (ok) f->noise = sqrt(left / (double)used);
    if (ok) f->fits = energy > 0 ? 1 - left / energy : 0;
    arena_close(a);
    return ok;
}

/* Sizes and times of impacts of a response that is known, each by what is left of the others between 1 and 20 ms behind
   it: what is missing is a part of h and of its derivative. rest [n]: the recording without all of them. */
static void refine(const struct source_filter *f, struct source_response_hits *h, double *rest)
{
    struct arena *a = arena_open();
    long length = (long)(0.3 * f->rate) < f->n ? (long)(0.3 * f->rate) : f->n, near = (long)(SOURCE_PAST * f->rate),
         far = (long)(20e-3 * f->rate) < length ? (long)(20e-3 * f->rate) : length;
    double *unit = ARENA_TAKE(a, double, length + 4), *slope = ARENA_TAKE(a, double, length + 4),
           *x = ARENA_TAKE(a, double, length), *y = ARENA_TAKE(a, double, length);
    for (int i = 0; i < f->m; i++) {
        cplx s = source_poles_of(&f->mode[i]), turn = cplx_exp(s, 1 / f->rate), z = f->mode[i].gain,
             rises = cplx_mul(z, cplx_scale(1 / f->rate, s));
        for (long t = 1; t < length + 4; t++, z = cplx_mul(z, turn), rises = cplx_mul(rises, turn)) {
            unit[t] += z.im;
            slope[t] += rises.im; /* a sample */
        }
    }
    for (int k = 0; k < h->n; k++) {
        long first = (long)fmax(ceil(h->at[k]), 0), to = first + length < f->n ? length : f->n - first;
        double u = (double)first - h->at[k], xx = 0, xy = 0, yy = 0, xr = 0, yr = 0;
        for (long t = 0; t < to; t++) {
            x[t] = source_response_between(unit + 1 + t, u);
            y[t] = source_response_between(slope + 1 + t, u);
        }
        for (long t = near; t < to && t < far; t++) {
            xx += x[t] * x[t];
            xy += x[t] * y[t];
            yy += y[t] * y[t];
            xr += x[t] * rest[first + t];
            yr += y[t] * rest[first + t];
        }
        double det = xx * yy - xy * xy, limit = 0.5; /* samples: what is beyond is no small error */
        if (!(det > 1e-6 * xx * yy) || h->size[k] == 0) continue;
        double more = (xr * yy - yr * xy) / det, by = (yr * xx - xr * xy) / det, late = -by / h->size[k];
        if (fabs(late) > limit || fabs(more) > 0.5 * fabs(h->size[k])) continue;
        h->size[k] += more;
        h->at[k] += late;
        for (long t = 0; t < to; t++)
            rest[first + t] -= more * x[t] + by * y[t];
    }
    arena_close(a);
}

/* What follows an impact at once and is in no mode: the mean over the impacts of what the modes leave behind their
   times. rest [n]: the recording without its modes. */
void source_response_click(struct source_filter *f, const double *rest, struct source_response_hits *h, struct arena *a)
{
    double all = 0;
    long n = (long)(clicks * f->rate), fades = (long)(1e-3 * f->rate);
    f->click = ARENA_TAKE(a, double, n);
    f->clicks = n;
    for (int k = 0; k < h->n; k++) {
        long first = (long)floor(h->at[k]);
        if (first < 1 || first + n + 2 > f->n) continue;
        for (long t = 0; t < n; t++)
            f->click[t] += h->size[k] * source_response_between(rest + first + t, h->at[k] - (double)first);
        all += h->size[k] * h->size[k];
    }
    for (long t = 0; t < n; t++)
        f->click[t] *=
            all > 0 ? (t < n - fades ? 1 : 0.5 + 0.5 * real_cospi((double)(t - n + fades) / (double)fades)) / all : 0;
}

/* The recording without its modes. */
static void take_off(const struct source_filter *f, const struct source_response_hits *h, double *rest, struct arena *a)
{
    double *re = ARENA_TAKE(a, double, f->n), *im = ARENA_TAKE(a, double, f->n);
    memcpy(rest, f->x, (size_t)f->n * sizeof *rest);
    for (int i = 0; i < f->m; i++) {
        cplx gain = f->mode[i].gain;
        driven(f, source_poles_of(&f->mode[i]), h, 0, f->n, re, im);
        for (long t = 0; t < f->n; t++)
            rest[t] -= gain.re * im[t] + gain.im * re[t];
    }
}

/* Sizes by one factor, so that modes whose gains are known are most of the recording. */
static bool scale(struct source_filter *f, struct source_response_hits *h, double *rest, struct arena *a)
{
    double product = 0, own = 0, left = 0;
    take_off(f, h, rest, a);
    for (long t = 0; t < f->n; t++) {
        double y = f->x[t] - rest[t];
        product += f->x[t] * y;
        own += y * y;
    }
    for (int k = 0; k < h->n && own > 0; k++)
        h->size[k] *= product / own;
    for (long t = 0; t < f->n && own > 0; t++) {
        double y = f->x[t] - product / own * (f->x[t] - rest[t]);
        left += y * y;
    }
    f->noise = sqrt(left / (double)f->n);
    return product > 0;
}

/* Gains, sizes and times in turn. Then all begins SOURCE_RESPONSE_LEAD earlier, for the click, which is before the
   onset, too. */
bool source_response_fit(struct source_filter *f, struct source_response_hits *h, bool known, struct arena *a)
{
    struct arena *inner = arena_open();
    double *rest = ARENA_TAKE(inner, double, f->n);
    bool ok = h->n > 0;
    for (int turn = 0; ok && turn < TURNS; turn++) {
        ok = known ? scale(f, h, rest, inner) : fit_gains(f, h);
        if (!ok) break;
        if (turn + 1 == TURNS) break;
        take_off(f, h, rest, inner);
        refine(f, h, rest);
    }
    for (int k = 0; k < h->n; k++)
        h->at[k] -= SOURCE_RESPONSE_LEAD * f->rate;
    for (int i = 0; ok && i < f->m; i++)
        f->mode[i].gain = cplx_mul(f->mode[i].gain, cplx_exp(source_poles_of(&f->mode[i]), -SOURCE_RESPONSE_LEAD));
    if (ok) {
        take_off(f, h, rest, inner);
        source_response_click(f, rest, h, a);
    }
    arena_close(inner);
    return ok;
}
