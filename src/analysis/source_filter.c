#include "analysis/source_filter.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_poly.h>
#include <gsl/gsl_sort_double.h>
#include <gsl/gsl_statistics_double.h>
#include <stdlib.h>
#include <string.h>

#include "num/fft.h"

static const double hop = 0.25e-3;       /* s, of short-time energies */
enum { AFTER = 4, BEFORE = 7, GAP = 1 }; /* hops whose energies an onset compares */
static const double apart = 2e-3;        /* s, between onsets */
static const double past = 1e-3;         /* s after an onset: what struck has left */
static const double margin = 0.5e-3;     /* s before the next */
static const double longest = 0.5;       /* s of a free frame */
static const double shortest = 0.01;     /* s, of one from which poles are taken */
static const double hides = 10e-3;       /* s about an impact */
static const double lead = 0.5e-3;       /* s of an impact's click before its onset */
static const double clicks = 2.5e-3;     /* s of it in all, the last 1 ms fading */
static const double one = 0.3e-3;        /* s: pulses of one impact */
enum {
    MODES = 128,
    PREDICT = 64,
    POLES = 12,
    STATES = 240,
    FIT = 2048,
    ROUNDS = 6,
    TURNS = 4,
    REACH = 4096,
    MOST = 100000
};

/* ------------------------------------------------------------------ onsets */

/* What linear prediction does not foresee (autocorrelation method, Levinson and Durbin): while the object rings freely next
   to nothing, but for an impact. */
static double *unforeseen(const double *x, long n, struct arena *a)
{
    double r[PREDICT + 1], c[PREDICT + 1] = {1}, *y = ARENA_TAKE(a, double, n);
    int order = n / 4 < PREDICT ? (int)(n / 4) : PREDICT;
    for (int k = 0; k <= order; k++) {
        r[k] = 0;
        for (long i = k; i < n; i++)
            r[k] += x[i] * x[i - k];
    }
    double error = r[0] *= 1 + 1e-10; /* as of noise at -100 dB */
    for (int k = 1; k <= order && error > 0; k++) {
        double sum = 0, before[PREDICT + 1];
        for (int i = 0; i < k; i++)
            sum += c[i] * r[k - i];
        memcpy(before, c, sizeof before);
        for (int i = 1; i <= k; i++)
            c[i] = (i < k ? before[i] : 0) - sum / error * before[k - i];
        error *= 1 - sum / error * (sum / error);
    }
    for (long i = order; i < n; i++)
        for (int k = 0; k <= order; k++)
            y[i] += c[k] * x[i - k];
    return y;
}

static double mean_of(const double *energy, long from, long to)
{
    double sum = 0;
    for (long i = from; i < to; i++)
        sum += energy[i];
    return sum / (double)(to - from);
}

/* Where the energy behind is greatest beside that before, and by `rise` dB greater. What stands out of silence by less
   than 3 dB is none. */
static void find_onsets(struct source_filter *f, const double *y, double rise, struct arena *a)
{
    struct arena *inner = arena_open();
    long h = (long)fmax(1, rint(hop * f->rate)), hops = f->n / h, near = (long)ceil(apart / hop);
    double *energy = ARENA_TAKE(inner, double, hops + 1), *ratio = ARENA_TAKE(inner, double, hops + 1),
           *behind = ARENA_TAKE(inner, double, hops + 1), all = 0;
    for (long i = 0; i < hops; i++) {
        for (long k = i * h; k < (i + 1) * h; k++)
            energy[i] += y[k] * y[k];
        all += energy[i] / (double)hops;
    }
    for (long i = 0; i + AFTER <= hops; i++) {
        long from = i - GAP - BEFORE > 0 ? i - GAP - BEFORE : 0, to = i - GAP;
        behind[i] = mean_of(energy, i, i + AFTER);
        ratio[i] = behind[i] / ((to > from ? mean_of(energy, from, to) : 0) + 1e-9 * all);
    }
    double *sorted = ARENA_TAKE(inner, double, hops + 1), least = real_exp10(rise / 10);
    memcpy(sorted, behind, (size_t)hops * sizeof *sorted);
    gsl_sort(sorted, 1, (size_t)hops);
    double quiet = hops ? 2 * gsl_stats_quantile_from_sorted_data(sorted, 1, (size_t)hops, 0.1) : 0;
    f->onset = ARENA_TAKE(a, long, hops + 1);
    for (long i = 0; i + AFTER <= hops; i++) {
        bool top = ratio[i] >= least && behind[i] > quiet;
        for (long k = i - near > 0 ? i - near : 0; top && k <= i + near && k < hops; k++)
            top = ratio[k] < ratio[i] || (ratio[k] == ratio[i] && k >= i);
        if (!top) continue;
        long at = i * h;
        for (long k = (i - 1 > 0 ? i - 1 : 0) * h; k < (i + AFTER) * h; k++)
            at = fabs(y[k]) > fabs(y[at]) ? k : at;
        if (f->onsets == 0 || at - f->onset[f->onsets - 1] > h) f->onset[f->onsets++] = at;
    }
    arena_close(inner);
}

struct frame {
    int onset;
    long from, n; /* samples */
    double energy;
    bool known; /* its state is */
};

/* Behind each onset, until the next. */
static struct frame *free_frames(const struct source_filter *f, struct arena *a)
{
    struct frame *list = ARENA_TAKE(a, struct frame, f->onsets + 1);
    for (int k = 0; k < f->onsets; k++) {
        long from = f->onset[k] + (long)(past * f->rate),
             to = k + 1 < f->onsets ? f->onset[k + 1] - (long)(margin * f->rate) : f->n,
             most = (long)(longest * f->rate);
        list[k] = (struct frame){.onset = k, .from = from, .n = to - from < most ? to - from : most};
        for (long i = from; i < from + list[k].n; i++)
            list[k].energy += f->x[i] * f->x[i];
    }
    return list;
}

static int by_energy(const void *x, const void *y)
{
    double a = ((const struct frame *)x)->energy, b = ((const struct frame *)y)->energy;
    return (a < b) - (a > b);
}

static int by_onset(const void *x, const void *y)
{
    return ((const struct frame *)x)->onset - ((const struct frame *)y)->onset;
}

/* ------------------------------------------------------------------ poles */

/* By ESPRIT and output error: of the frames that hold most energy, or of the autocorrelation. */
static bool poles_fitted(struct source_filter *f, const struct source_filter_options *o, struct frame *frame,
                         int frames, struct arena *a, struct err *e)
{
    static const double unit[1] = {1};
    struct modal_stretch *st = ARENA_TAKE(a, struct modal_stretch, frames);
    struct modal_data d = {.rate = f->rate, .places = frames, .stretches = frames, .stretch = st};
    struct modal_options options = {.most = o->most, .low = o->low, .high = o->high, .fastest = o->fastest};
    struct modal_result r;
    for (int k = 0; k < frames; k++)
        st[k] = (struct modal_stretch){.y = f->x + frame[k].from,
                                       .first = frame[k].from,
                                       .n = modal_length(frame[k].n),
                                       .place = k,
                                       .fitted = true,
                                       .pulse = {frame[k].from, 1, unit}};
    if (!modal_find(&d, &options, a, &r, e)) return false;
    f->m = r.n;
    f->note = r.note;
    f->mode = ARENA_TAKE(a, struct source_filter_mode, r.n + 1);
    for (int i = 0; i < r.n; i++)
        f->mode[i] = (struct source_filter_mode){
            .frequency = r.mode[i].frequency,
            .decay = r.mode[i].decay,
            .frequency_se = fmax(r.mode[i].frequency_se, r.mode[i].frequency_between / sqrt(frames)),
            .decay_se = fmax(r.mode[i].decay_se, r.mode[i].decay_between / sqrt(frames)),
            .gain = r.mode[i].gain[0].a};
    return true;
}

/* r(l) of the recording, l from `past` on, until it has sunk into what chance makes. */
static bool poles_correlated(struct source_filter *f, const struct source_filter_options *o, struct arena *a,
                             struct err *e)
{
    long lags = (long)(longest * f->rate), size = (long)fft_good_size((size_t)(f->n + lags)),
         first = (long)(past * f->rate);
    double *x = ARENA_TAKE(a, double, size), *re = ARENA_TAKE(a, double, size / 2 + 1),
           *im = ARENA_TAKE(a, double, size / 2 + 1);
    struct fft *fft = fft_open((size_t)size);
    memcpy(x, f->x, (size_t)f->n * sizeof *x);
    fft_forward(fft, x, re, im);
    for (long k = 0; k <= size / 2; k++) {
        re[k] = re[k] * re[k] + im[k] * im[k];
        im[k] = 0;
    }
    fft_inverse(fft, re, im, x);
    fft_close(fft);
    double chance = 10 * x[0] / sqrt((double)f->n), block = 5e-3 * f->rate;
    long end = first;
    for (double most = HUGE_VAL; most > chance && end < lags && end < f->n / 2;) {
        long to = end + (long)block;
        most = 0;
        for (; end < to; end++)
            most = fmax(most, fabs(x[end]));
    }
    struct source_filter r = {.x = x, .n = end, .rate = f->rate};
    struct frame whole = {.from = first, .n = end - first};
    if (!poles_fitted(&r, o, &whole, 1, a, e)) return false;
    f->correlated = true;
    f->m = r.m;
    f->mode = r.mode;
    f->note = r.note;
    for (int i = 0; i < f->m; i++) { /* of a force of white noise r(l) has |A|^2/(4 d) of each */
        struct source_filter_mode *m = &f->mode[i];
        m->gain = (cplx){sqrt(4 * m->decay * cplx_abs(m->gain)), 0};
        m->frequency_se = m->decay_se = NAN;
    }
    return true;
}

enum { BANDS = 8, ORDER = 16 }; /* octaves below half the rate, and the rest */

/* One band of the recording, critically sampled; octaves are upside down. Returns by how many times its rate is lower. */
static int band_of(const double *re, const double *im, long bins, int band, double *y)
{
    bool rest = band == BANDS - 1;
    int step = rest ? 1 << band : 2 << band;
    long each = bins / step;
    struct arena *a = arena_open();
    struct fft *fft = fft_open((size_t)(2 * each));
    double *r = ARENA_TAKE(a, double, each + 1), *i = ARENA_TAKE(a, double, each + 1);
    for (long k = 0; k <= each; k++) {
        long from = rest ? k : 2 * each - k;
        r[k] = re[from];
        i[k] = rest ? im[from] : -im[from];
    }
    fft_inverse(fft, r, i, y);
    fft_close(fft);
    arena_close(a);
    return step;
}

static int by_frequency(const void *x, const void *y)
{
    double a = ((const struct source_filter_mode *)x)->frequency, b = ((const struct source_filter_mode *)y)->frequency;
    return (a > b) - (a < b);
}

/* By linear prediction (covariance method), all frames of a band in one system of equations. */
static void poles_predicted(struct source_filter *f, const struct source_filter_options *o, const struct frame *frame,
                            int frames, struct arena *a)
{
    long unit = 4 << BANDS, size = unit * (long)fft_good_size((size_t)(f->n / unit + 2));
    double *x = ARENA_TAKE(a, double, size), *re = ARENA_TAKE(a, double, size / 2 + 1),
           *im = ARENA_TAKE(a, double, size / 2 + 1), *y = ARENA_TAKE(a, double, size);
    struct fft *whole = fft_open((size_t)size);
    memcpy(x, f->x, (size_t)f->n * sizeof *x);
    fft_forward(whole, x, re, im);
    f->mode = ARENA_TAKE(a, struct source_filter_mode, BANDS * ORDER);
    gsl_matrix *normal = gsl_matrix_alloc(ORDER, ORDER);
    gsl_vector *right = gsl_vector_alloc(ORDER);
    gsl_poly_complex_workspace *work = gsl_poly_complex_workspace_alloc(ORDER + 1);
    for (int band = 0; band < BANDS; band++) {
        double polynomial[ORDER + 1], root[2 * ORDER];
        int step = band_of(re, im, size / 2, band, y);
        double rate = f->rate / step;
        gsl_matrix_set_zero(normal);
        gsl_vector_set_zero(right);
        for (int k = 0; k < frames; k++)
            for (long i = frame[k].from / step + ORDER; i < (frame[k].from + frame[k].n) / step; i++)
                for (int p = 0; p < ORDER; p++) {
                    for (int q = 0; q < ORDER; q++)
                        *gsl_matrix_ptr(normal, (size_t)p, (size_t)q) += y[i - 1 - p] * y[i - 1 - q];
                    *gsl_vector_ptr(right, (size_t)p) += y[i - 1 - p] * y[i];
                }
        double trace = 0;
        for (size_t p = 0; p < ORDER; p++)
            trace += gsl_matrix_get(normal, p, p);
        for (size_t p = 0; p < ORDER; p++)
            *gsl_matrix_ptr(normal, p, p) += 1e-10 * trace;
        if (!(trace > 0) || gsl_linalg_cholesky_decomp1(normal) != GSL_SUCCESS) continue;
        gsl_linalg_cholesky_svx(normal, right);
        polynomial[ORDER] = 1;
        for (int p = 0; p < ORDER; p++)
            polynomial[ORDER - 1 - p] = -gsl_vector_get(right, (size_t)p);
        if (gsl_poly_complex_solve(polynomial, ORDER + 1, work, root) != GSL_SUCCESS) continue;
        for (int p = 0; p < ORDER; p++) {
            double angle = real_atan2(root[2 * p + 1], root[2 * p]) / REAL_PI,
                   radius = sqrt(root[2 * p] * root[2 * p] + root[2 * p + 1] * root[2 * p + 1]),
                   decay = -real_log(radius) * rate, frequency = (band == BANDS - 1 ? angle : 2 - angle) * rate / 2;
            if (angle > 0.01 && angle < 0.99 && decay > 0 && decay < o->fastest && frequency > o->low &&
                frequency < o->high)
                f->mode[f->m++] = (struct source_filter_mode){
                    .frequency = frequency, .decay = decay, .frequency_se = NAN, .decay_se = NAN};
        }
    }
    gsl_poly_complex_workspace_free(work);
    gsl_vector_free(right);
    gsl_matrix_free(normal);
    fft_close(whole);
    qsort(f->mode, (size_t)f->m, sizeof *f->mode, by_frequency);
}

/* ------------------------------------------------------------------ states */

static cplx pole(const struct source_filter_mode *m) { return (cplx){-m->decay, 2 * REAL_PI * m->frequency}; }

/* state[m] at a frame's first sample: y = sum Im z e^(s t), by least squares. Adds what is left to *rest and its
   samples to *count. false: too few samples. */
static bool state_of(const struct source_filter *f, const struct frame *at, cplx *state, double *rest, double *all_of,
                     double *count)
{
    long n = at->n < FIT ? at->n : FIT, all = 2 * f->m;
    if (n < all + all / 4 + 16) return false;
    struct arena *a = arena_open();
    double *basis = ARENA_TAKE(a, double, all *n), *left = ARENA_TAKE(a, double, n);
    for (int i = 0; i < f->m; i++) {
        cplx z = {1, 0}, turn = cplx_exp(pole(&f->mode[i]), 1 / f->rate);
        for (long t = 0; t < n; t++, z = cplx_mul(z, turn)) {
            basis[2 * i * n + t] = z.im;
            basis[(2 * i + 1) * n + t] = z.re;
        }
    }
    gsl_matrix *normal = gsl_matrix_alloc((size_t)all, (size_t)all);
    gsl_vector *right = gsl_vector_alloc((size_t)all);
    for (long p = 0; p < all; p++) {
        for (long q = 0; q <= p; q++) {
            double sum = 0;
            for (long t = 0; t < n; t++)
                sum += basis[p * n + t] * basis[q * n + t];
            gsl_matrix_set(normal, (size_t)p, (size_t)q, p == q ? sum * (1 + 1e-9) : sum);
            gsl_matrix_set(normal, (size_t)q, (size_t)p, p == q ? sum * (1 + 1e-9) : sum);
        }
        double sum = 0;
        for (long t = 0; t < n; t++)
            sum += basis[p * n + t] * f->x[at->from + t];
        gsl_vector_set(right, (size_t)p, sum);
    }
    bool ok = gsl_linalg_cholesky_decomp1(normal) == GSL_SUCCESS;
    if (ok) {
        gsl_linalg_cholesky_svx(normal, right);
        memcpy(left, f->x + at->from, (size_t)n * sizeof *left);
        for (long p = 0; p < all; p++)
            for (long t = 0; t < n; t++)
                left[t] -= gsl_vector_get(right, (size_t)p) * basis[p * n + t];
        for (long t = 0; t < n; t++) {
            *rest += left[t] * left[t];
            *all_of += f->x[at->from + t] * f->x[at->from + t];
        }
        *count += (double)(n - all);
        for (int i = 0; i < f->m; i++)
            state[i] = (cplx){gsl_vector_get(right, 2 * (size_t)i), gsl_vector_get(right, 2 * (size_t)i + 1)};
    }
    gsl_vector_free(right);
    gsl_matrix_free(normal);
    arena_close(a);
    return ok;
}

struct jump { /* what an impact added */
    int onset;
    cplx *by;      /* [m] at the onset */
    double energy; /* sum of |by|^2/(4 d) */
};

static double energy_of(const struct source_filter *f, const cplx *gain)
{
    double sum = 0;
    for (int i = 0; i < f->m; i++)
        sum += cplx_square(gain[i]) / (4 * f->mode[i].decay);
    return sum;
}

/* frame: of all onsets, in their order; states of the loudest. */
static int find_jumps(struct source_filter *f, struct frame *frame, struct jump *jump, struct arena *a)
{
    double rest = 0, count = 0, energy_all = 0, *energy = ARENA_TAKE(a, double, f->onsets + 1);
    cplx *state = ARENA_TAKE(a, cplx, f->onsets * f->m);
    int jumps = 0;
    for (int k = 0; k < f->onsets; k++)
        energy[k] = frame[k].energy;
    gsl_sort(energy, 1, (size_t)f->onsets);
    double least = f->onsets > STATES ? energy[f->onsets - STATES] : 0;
    for (int k = 0; k < f->onsets; k++)
        frame[k].known =
            frame[k].energy >= least && state_of(f, &frame[k], state + k * f->m, &rest, &energy_all, &count);
    f->noise = count > 0 ? sqrt(rest / count) : 0;
    f->fits = energy_all > 0 ? 1 - rest / energy_all : 0;
    for (int k = 0; k < f->onsets; k++) {
        struct jump *j = &jump[jumps];
        if (!frame[k].known || (k > 0 && !frame[k - 1].known)) continue;
        *j = (struct jump){.onset = k, .by = ARENA_TAKE(a, cplx, f->m)};
        for (int i = 0; i < f->m; i++) {
            cplx s = pole(&f->mode[i]);
            j->by[i] = cplx_mul(state[k * f->m + i], cplx_exp(s, (double)(f->onset[k] - frame[k].from) / f->rate));
            if (k > 0)
                j->by[i] =
                    cplx_sub(j->by[i], cplx_mul(state[(k - 1) * f->m + i],
                                                cplx_exp(s, (double)(f->onset[k] - frame[k - 1].from) / f->rate)));
        }
        j->energy = energy_of(f, j->by);
        jumps++;
    }
    return jumps;
}

/* ------------------------------------------------------------------ pulses */

struct hits { /* impacts, as they are known so far */
    int n;
    double *at, *size; /* [n] samples; pushes */
};

/* Between samples, by the cubic through four: x[at] u on, 0 <= u < 1. */
static double between(const double *x, double u)
{
    return x[0] + u * (x[1] - x[-1] / 3 - x[0] / 2 - x[2] / 6 +
                       u * ((x[-1] + x[1]) / 2 - x[0] + u * ((x[2] - x[-1]) / 6 + (x[0] - x[1]) / 2)));
}

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
        const double *p = sum + top + reach;
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
static void find_pulses(struct source_filter *f, const double *y, bool both, struct hits *h, struct arena *a)
{
    enum { CANDIDATES = 6 };
    long early = (long)(margin * f->rate), n = (long)((margin + past) * f->rate),
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
    *h = (struct hits){.at = ARENA_TAKE(a, double, f->onsets + 1), .size = ARENA_TAKE(a, double, f->onsets + 1)};
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
                pulse[i] += size * between(y + first + i, at - (double)first);
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
static void driven(const struct source_filter *f, cplx s, const struct hits *h, long from, long n, double *re,
                   double *im)
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

/* A of all modes at once, by least squares over the recording but for what is near an impact: x = sum Im A z. Of a long
   one over the part of most impacts. */
static bool fit_gains(struct source_filter *f, const struct hits *h)
{
    enum { LONGEST = 400000 };
    long n = f->n < LONGEST ? f->n : LONGEST, from = 0, used = 0, all = 2 * f->m;
    int most = 0;
    for (int k = 0, last = 0; k < h->n; k++) {
        while (last < h->n && h->at[last] < h->at[k] + (double)n)
            last++;
        if (last - k > most) from = (long)h->at[k];
        most = last - k > most ? last - k : most;
    }
    from = from + n > f->n ? f->n - n : from;
    struct arena *a = arena_open();
    double *basis = ARENA_TAKE(a, double, all *n), *x = ARENA_TAKE(a, double, n), energy = 0, left = 0;
    bool *near = ARENA_TAKE(a, bool, n);
    for (int k = 0; k < h->n; k++)
        for (long t = (long)(h->at[k] - margin * f->rate); t < (long)(h->at[k] + past * f->rate); t++)
            if (t >= from && t < from + n) near[t - from] = true;
    for (int i = 0; i < f->m; i++)
        driven(f, pole(&f->mode[i]), h, from, n, basis + (2 * i + 1) * n, basis + 2 * i * n);
    for (long t = 0; t < n; t++)
        if (!near[t]) {
            for (long p = 0; p < all; p++)
                basis[p * n + used] = basis[p * n + t];
            x[used] = f->x[from + t];
            energy += x[used] * x[used];
            used++;
        }
    gsl_matrix *normal = gsl_matrix_alloc((size_t)all, (size_t)all);
    gsl_vector *right = gsl_vector_alloc((size_t)all);
    for (long p = 0; p < all; p++) {
        for (long q = 0; q <= p; q++) {
            double sum = 0;
            for (long t = 0; t < used; t++)
                sum += basis[p * n + t] * basis[q * n + t];
            gsl_matrix_set(normal, (size_t)p, (size_t)q, p == q ? sum * (1 + 1e-9) + 1e-300 : sum);
            gsl_matrix_set(normal, (size_t)q, (size_t)p, p == q ? sum * (1 + 1e-9) + 1e-300 : sum);
        }
        double sum = 0;
        for (long t = 0; t < used; t++)
            sum += basis[p * n + t] * x[t];
        gsl_vector_set(right, (size_t)p, sum);
    }
    bool ok = used > 2 * all && gsl_linalg_cholesky_decomp1(normal) == GSL_SUCCESS;
    if (ok) {
        gsl_linalg_cholesky_svx(normal, right);
        for (long p = 0; p < all; p++)
            for (long t = 0; t < used; t++)
                x[t] -= gsl_vector_get(right, (size_t)p) * basis[p * n + t];
        for (long t = 0; t < used; t++)
            left += x[t] * x[t];
        for (int i = 0; i < f->m; i++)
            f->mode[i].gain = (cplx){gsl_vector_get(right, 2 * (size_t)i), gsl_vector_get(right, 2 * (size_t)i + 1)};
        f->noise = sqrt(left / (double)used);
        f->fits = energy > 0 ? 1 - left / energy : 0;
    }
    gsl_vector_free(right);
    gsl_matrix_free(normal);
    arena_close(a);
    return ok;
}

/* Sizes and times of impacts of a response that is known, each by what is left of the others between 1 and 20 ms behind
   it: what is missing is a part of h and of its derivative. rest [n]: the recording without all of them. */
static void refine(const struct source_filter *f, struct hits *h, double *rest)
{
    struct arena *a = arena_open();
    long length = (long)(0.3 * f->rate) < f->n ? (long)(0.3 * f->rate) : f->n, near = (long)(past * f->rate),
         far = (long)(20e-3 * f->rate) < length ? (long)(20e-3 * f->rate) : length;
    double *unit = ARENA_TAKE(a, double, length + 4), *slope = ARENA_TAKE(a, double, length + 4),
           *x = ARENA_TAKE(a, double, length), *y = ARENA_TAKE(a, double, length);
    for (int i = 0; i < f->m; i++) {
        cplx s = pole(&f->mode[i]), turn = cplx_exp(s, 1 / f->rate), z = f->mode[i].gain,
             rises = cplx_mul(z, cplx_scale(1 / f->rate, s));
        for (long t = 1; t < length + 4; t++, z = cplx_mul(z, turn), rises = cplx_mul(rises, turn)) {
            unit[t] += z.im;
            slope[t] += rises.im; /* a sample */
        }
    }
    for (int k = 0; k < h->n; k++) {
        long first = (long)ceil(h->at[k]), to = first + length < f->n ? length : f->n - first;
        double u = (double)first - h->at[k], xx = 0, xy = 0, yy = 0, xr = 0, yr = 0;
        for (long t = 0; t < to; t++) {
            x[t] = between(unit + 1 + t, u);
            y[t] = between(slope + 1 + t, u);
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

/* What follows an impact at once and is in no mode: the mean over the impacts of what the modes leave behind their times.
   rest [n]: the recording without its modes. */
static void find_click(struct source_filter *f, const double *rest, struct hits *h, struct arena *a)
{
    double all = 0;
    long n = (long)(clicks * f->rate), fades = (long)(1e-3 * f->rate);
    f->click = ARENA_TAKE(a, double, n);
    f->clicks = n;
    for (int k = 0; k < h->n; k++) {
        long first = (long)floor(h->at[k]);
        if (first < 1 || first + n + 2 > f->n) continue;
        for (long t = 0; t < n; t++)
            f->click[t] += h->size[k] * between(rest + first + t, h->at[k] - (double)first);
        all += h->size[k] * h->size[k];
    }
    for (long t = 0; t < n; t++)
        f->click[t] *=
            all > 0 ? (t < n - fades ? 1 : 0.5 + 0.5 * real_cospi((double)(t - n + fades) / (double)fades)) / all : 0;
}

/* The recording without its modes. */
static void take_off(const struct source_filter *f, const struct hits *h, double *rest, struct arena *a)
{
    double *re = ARENA_TAKE(a, double, f->n), *im = ARENA_TAKE(a, double, f->n);
    memcpy(rest, f->x, (size_t)f->n * sizeof *rest);
    for (int i = 0; i < f->m; i++) {
        cplx gain = f->mode[i].gain;
        driven(f, pole(&f->mode[i]), h, 0, f->n, re, im);
        for (long t = 0; t < f->n; t++)
            rest[t] -= gain.re * im[t] + gain.im * re[t];
    }
}

/* Gains, sizes and times in turn. Then all begins `lead` earlier, for the click, which is before the onset, too. */
static bool respond(struct source_filter *f, struct hits *h, struct arena *a)
{
    struct arena *inner = arena_open();
    double *rest = ARENA_TAKE(inner, double, f->n);
    bool ok = h->n > 0;
    for (int turn = 0; ok && turn < TURNS; turn++) {
        ok = fit_gains(f, h);
        if (!ok) break;
        if (turn + 1 == TURNS) break;
        take_off(f, h, rest, inner);
        refine(f, h, rest);
    }
    for (int k = 0; k < h->n; k++)
        h->at[k] -= lead * f->rate;
    for (int i = 0; ok && i < f->m; i++)
        f->mode[i].gain = cplx_mul(f->mode[i].gain, cplx_exp(pole(&f->mode[i]), -lead));
    if (ok) {
        take_off(f, h, rest, inner);
        find_click(f, rest, h, a);
    }
    arena_close(inner);
    return ok;
}

/* ------------------------------------------------------------------ source */

/* z_m = p_m z_m + A_m f, y = sum Im z_m. Of places A is that of the latest. */
void source_filter_sound(const struct source_filter *f, double *y)
{
    memset(y, 0, (size_t)f->n * sizeof *y);
    for (int i = 0; i < f->m; i++) {
        cplx z = {0, 0}, turn = cplx_exp(pole(&f->mode[i]), 1 / f->rate), gain = f->mode[i].gain;
        for (long t = 0, place = 0; t < f->n; t++) {
            while (place < f->places && f->place_time[place] * f->rate <= (double)t + 0.5)
                gain = f->place_gain[i * f->places + place++];
            z = cplx_mul(z, turn);
            z = (cplx){fma(f->source[t], gain.re, z.re), fma(f->source[t], gain.im, z.im)};
            y[t] += z.im;
        }
    }
    for (long t = 0; f->clicks > 0 && t < f->n; t++)
        for (long k = 0; f->source[t] != 0 && k < f->clicks && t + k < f->n; k++)
            y[t + k] += f->source[t] * f->click[k];
}

/* So that |h| is at most 1. */
static void normalise(struct source_filter *f)
{
    long n = (long)(0.05 * f->rate) < f->n ? (long)(0.05 * f->rate) : f->n;
    struct source_filter unit = *f;
    double *x = calloc((size_t)n, sizeof *x), *y = calloc((size_t)n, sizeof *y), most = 0;
    x[0] = 1;
    unit.n = n;
    unit.source = x;
    unit.places = 0;
    source_filter_sound(&unit, y);
    for (long t = 0; t < n; t++)
        most = fmax(most, fabs(y[t]));
    for (int i = 0; i < f->m && most > 0; i++)
        f->mode[i].gain = cplx_scale(1 / most, f->mode[i].gain);
    for (long k = 0; k < f->clicks && most > 0; k++)
        f->click[k] /= most;
    free(x);
    free(y);
}

/* Of an h as of the gains: re, im [bins]. */
static void response_at(const struct source_filter *f, struct fft *fft, double *x, long bins, double *re, double *im)
{
    memset(x, 0, 2 * (size_t)(bins - 1) * sizeof *x);
    if (f->clicks) memcpy(x, f->click, (size_t)f->clicks * sizeof *x);
    fft_forward(fft, x, re, im);
    for (int i = 0; i < f->m; i++) {
        cplx p = cplx_exp(pole(&f->mode[i]), 1 / f->rate), a = f->mode[i].gain, step, z = {1, 0};
        step = (cplx){real_cospi(1.0 / (double)(bins - 1)), -real_sinpi(1.0 / (double)(bins - 1))};
        for (long k = 0; k < bins; k++, z = cplx_mul(z, step)) { /* (A/(1 - p z) - conj(A)/(1 - conj(p) z))/2j */
            if (k % 1024 == 0)
                z = (cplx){real_cospi((double)k / (double)(bins - 1)), -real_sinpi((double)k / (double)(bins - 1))};
            cplx q = cplx_sub(cplx_div(a, cplx_sub((cplx){1, 0}, cplx_mul(p, z))),
                              cplx_div(cplx_conj(a), cplx_sub((cplx){1, 0}, cplx_mul(cplx_conj(p), z))));
            re[k] += 0.5 * q.im;
            im[k] -= 0.5 * q.re;
        }
    }
}

/* pulse[REACH]: what an impact of 1 becomes, from its middle on. */
static void divide(struct source_filter *f, double snr, double floor, double power, double *pulse, struct arena *a)
{
    long size = (long)fft_good_size((size_t)(f->n + (long)fmin(f->rate, (double)f->n) + REACH)), bins = size / 2 + 1;
    double *x = ARENA_TAKE(a, double, size), *re = ARENA_TAKE(a, double, bins), *im = ARENA_TAKE(a, double, bins),
           *hr = ARENA_TAKE(a, double, bins), *hi = ARENA_TAKE(a, double, bins), most = 0, eps;
    struct fft *fft = fft_open((size_t)size);
    response_at(f, fft, x, bins, hr, hi);
    memset(x, 0, (size_t)size * sizeof *x);
    memcpy(x, f->x, (size_t)f->n * sizeof *x);
    fft_forward(fft, x, re, im);
    for (long k = 0; k < bins; k++)
        most = fmax(most, hr[k] * hr[k] + hi[k] * hi[k]);
    eps = isnan(snr) ? fmax(f->noise * f->noise / power, floor * most) : most * fmax(real_exp10(-snr / 10), floor);
    f->band[0] = f->rate / 2;
    for (long k = 0; k < bins; k++) {
        double square = hr[k] * hr[k] + hi[k] * hi[k], r = re[k], by = 1 / ((square + eps) * (double)size),
               frequency = f->rate * (double)k / (double)size;
        re[k] = (r * hr[k] + im[k] * hi[k]) * by;
        im[k] = (im[k] * hr[k] - r * hi[k]) * by;
        hr[k] = square * by;
        hi[k] = 0;
        if (square > eps) f->band[0] = fmin(f->band[0], frequency);
        if (square > eps) f->band[1] = frequency;
    }
    fft_inverse(fft, re, im, x);
    memcpy(f->source, x, (size_t)f->n * sizeof *x);
    fft_inverse(fft, hr, hi, x);
    memcpy(pulse, x, REACH * sizeof *x);
    fft_close(fft);
}

static double squares(const double *x, long n)
{
    double sum = 0;
    for (long i = 0; i < n; i++)
        sum += x[i] * x[i];
    return sum;
}

/* ------------------------------------------------------------------ impacts */

struct peak {
    double at; /* samples */
    double size;
};

static int by_time(const void *x, const void *y)
{
    double a = ((const struct peak *)x)->at, b = ((const struct peak *)y)->at;
    return (a > b) - (a < b);
}

/* The pulse t samples from its middle. */
static double pulse_at(const double *pulse, double t)
{
    long i = (long)floor(fabs(t));
    double p[4];
    if (i + 2 >= REACH) return 0;
    for (long k = -1; k <= 2; k++)
        p[k + 1] = pulse[labs(i + k)];
    return between(p + 1, fabs(t) - (double)i);
}

/* What is less than a twentieth of another within 10 ms may be what that one left. */
static void leave_out_small(struct impact_events *v)
{
    bool *stays = calloc((size_t)v->n + 1, sizeof *stays);
    int n = 0;
    for (int k = 0; k < v->n; k++) {
        double most = 0;
        for (int i = k; i >= 0 && v->time[k] - v->time[i] < hides; i--)
            most = fmax(most, fabs(v->amplitude[i]));
        for (int i = k; i < v->n && v->time[i] - v->time[k] < hides; i++)
            most = fmax(most, fabs(v->amplitude[i]));
        stays[k] = fabs(v->amplitude[k]) >= most / 20;
    }
    for (int k = 0; k < v->n; k++)
        if (stays[k]) {
            v->time[n] = v->time[k];
            v->amplitude[n++] = v->amplitude[k];
        }
    v->n = n;
    free(stays);
}

/* Of a normal distribution, by the median, which what stands out does not move. room [n / 5 + 1] */
static double deviation(const double *x, long n, double *room)
{
    size_t few = 0;
    for (long i = 0; i < n; i += 5)
        room[few++] = fabs(x[i]);
    gsl_sort(room, 1, few);
    return gsl_stats_median_from_sorted_data(room, 1, few) / 0.6745;
}

/* The greatest pulse is taken off, and so on, until what is left is as the source is in between, 4.5 times its
   deviation. Pulses within `one` are one impact. */
static void find_impacts(struct source_filter *f, bool both, const double *pulse, struct arena *a)
{
    enum { PART = 256 };
    struct arena *inner = arena_open();
    long parts = (f->n + PART - 1) / PART;
    double *rest = ARENA_TAKE(inner, double, f->n), *sizes = ARENA_TAKE(inner, double, f->n / 5 + 2),
           *top = ARENA_TAKE(inner, double, parts), energy = squares(f->source, f->n), first = 0;
    struct peak *peak = ARENA_TAKE(inner, struct peak, MOST);
    int n = 0;
    memcpy(rest, f->source, (size_t)f->n * sizeof *rest);
    double least = 4.5 * deviation(rest, f->n, sizes);
    for (long p = 0; p < parts; p++)
        top[p] = -1; /* not known */
    for (; n < MOST; n++) {
        long at = -1;
        long best = 0;
        for (long p = 0; p < parts; p++) {
            if (top[p] < 0) {
                long end = (p + 1) * PART < f->n ? (p + 1) * PART : f->n;
                top[p] = 0;
                for (long i = p * PART; i < end; i++)
                    top[p] = fmax(top[p], both ? fabs(rest[i]) : rest[i]);
            }
            if (top[p] > top[best]) best = p;
        }
        at = best * PART;
        for (long i = at; i < f->n && i < (best + 1) * PART; i++)
            if (both ? fabs(rest[i]) > fabs(rest[at]) : rest[i] > rest[at]) at = i;
        double u = 0, size = rest[at]; /* the parabola's top */
        if (at > 0 && at + 1 < f->n) {
            double bend = rest[at - 1] - 2 * rest[at] + rest[at + 1], tilt = (rest[at + 1] - rest[at - 1]) / 2;
            if (bend * rest[at] < 0) u = fmax(-0.5, fmin(-tilt / bend, 0.5));
            size += u * tilt / 2;
        }
        double a_k = size / pulse[0];
        if (n == 0) first = fabs(rest[at]);
        if (!(fabs(rest[at]) > fmax(least, 3e-3 * first))) {
            double was = least; /* of what is left, which pulses raise no more */
            least = fmin(was, 8 * deviation(rest, f->n, sizes));
            if (!(least < 0.9 * was) || !(fabs(rest[at]) > fmax(least, 3e-3 * first))) break;
        }
        peak[n] = (struct peak){(double)at + u, a_k};
        long from = at - REACH + 1 > 0 ? at - REACH + 1 : 0, to = at + REACH < f->n ? at + REACH : f->n;
        for (long i = from; i < to; i++)
            rest[i] -= a_k * pulse_at(pulse, (double)(i - at) - u);
        for (long p = from / PART; p <= (to - 1) / PART; p++)
            top[p] = -1;
    }
    f->struck = energy > 0 ? 1 - squares(rest, f->n) / energy : 0;
    qsort(peak, (size_t)n, sizeof *peak, by_time);
    struct impact_events *v = &f->impacts;
    *v = (struct impact_events){.time = ARENA_TAKE(a, double, n + 1),
                                .amplitude = ARENA_TAKE(a, double, n + 1),
                                .duration = ARENA_TAKE(a, double, n + 1),
                                .alone = ARENA_TAKE(a, bool, n + 1)};
    for (int k = 0; k < n;) {
        double sum = 0, weight = 0, time = 0;
        int begin = k;
        for (; k < n && (peak[k].at - peak[begin].at) <= one * f->rate; k++) {
            sum += peak[k].size;
            weight += fabs(peak[k].size);
            time += fabs(peak[k].size) * peak[k].at;
        }
        if (fabs(sum) * pulse[0] <= least || (!both && sum <= 0)) continue;
        v->time[v->n] = time / (weight * f->rate);
        v->amplitude[v->n] = sum;
        v->duration[v->n++] = NAN;
    }
    leave_out_small(v);
    v->blur[1] = 1 / f->rate;
    arena_close(inner);
}

/* Lee: the onsets are the impacts, and each has gains of its own. */
static void own_gains(struct source_filter *f, struct jump *jump, int jumps, struct arena *a)
{
    struct impact_events *v = &f->impacts;
    double loudest = 0;
    for (int k = 0; k < jumps; k++)
        loudest = fmax(loudest, jump[k].energy);
    *v = (struct impact_events){.time = ARENA_TAKE(a, double, jumps),
                                .amplitude = ARENA_TAKE(a, double, jumps),
                                .duration = ARENA_TAKE(a, double, jumps),
                                .alone = ARENA_TAKE(a, bool, jumps)};
    f->place_time = ARENA_TAKE(a, double, jumps);
    f->place_gain = ARENA_TAKE(a, cplx, jumps * f->m);
    struct hits h = {.n = jumps, .at = ARENA_TAKE(a, double, jumps), .size = v->amplitude};
    double *rest = ARENA_TAKE(a, double, f->n);
    f->places = jumps;
    for (int k = 0; k < jumps; k++) {
        long at = f->onset[jump[k].onset] - (long)(lead * f->rate);
        double early = (double)(f->onset[jump[k].onset] - (at = at > 0 ? at : 0)) / f->rate;
        h.at[k] = (double)at;
        f->place_time[k] = v->time[k] = h.at[k] / f->rate;
        v->duration[k] = NAN;
        v->amplitude[k] = sqrt(jump[k].energy / loudest);
        f->source[at] = v->amplitude[k];
        for (int i = 0; i < f->m; i++)
            f->place_gain[i * jumps + k] =
                v->amplitude[k] > 0
                    ? cplx_scale(1 / v->amplitude[k], cplx_mul(jump[k].by[i], cplx_exp(pole(&f->mode[i]), -early)))
                    : (cplx){0, 0};
    }
    source_filter_sound(f, rest);
    for (long t = 0; t < f->n; t++)
        rest[t] = f->x[t] - rest[t];
    find_click(f, rest, &h, a);
    v->n = jumps;
    f->struck = 1;
}

/* ------------------------------------------------------------------ all */

static int by_loudness(const void *x, const void *y)
{
    const struct source_filter_mode *a = x, *b = y;
    double p = cplx_square(a->gain) / a->decay, q = cplx_square(b->gain) / b->decay;
    return (p < q) - (p > q);
}

/* Those whose states hold next to nothing, or that are beyond the number wanted. */
static void prune(struct source_filter *f, const struct jump *jump, int jumps, int most)
{
    double loudest = 0;
    for (int i = 0; i < f->m; i++) {
        double sum = 0;
        for (int k = 0; k < jumps; k++)
            sum += cplx_square(jump[k].by[i]);
        f->mode[i].gain = (cplx){sqrt(sum / jumps), 0};
        loudest = fmax(loudest, sum / jumps / f->mode[i].decay);
    }
    qsort(f->mode, (size_t)f->m, sizeof *f->mode, by_loudness);
    while (f->m > 0 && (f->m > most || cplx_square(f->mode[f->m - 1].gain) / f->mode[f->m - 1].decay < 1e-6 * loudest))
        f->m--;
}

bool source_filter_find(const double *x, long n, double rate, const struct source_filter_options *o, int m,
                        const struct source_filter_mode *mode, struct arena *a, struct source_filter *f, struct err *e)
{
    bool lee = o->method == SOURCE_FILTER_LEE;
    gsl_error_handler_t *handler = gsl_set_error_handler_off();
    *f = (struct source_filter){.x = x, .n = n, .rate = rate, .source = ARENA_TAKE(a, double, n)};
    double *y = unforeseen(x, n, a);
    find_onsets(f, y, o->rise, a);
    struct frame *frame = free_frames(f, a), *best = ARENA_TAKE(a, struct frame, f->onsets + 1);
    for (int k = 0; k < f->onsets; k++) {
        if ((double)frame[k].n < shortest * rate || frame[k].energy == 0) continue;
        best[f->frames++] = frame[k];
        f->longest = fmax(f->longest, (double)frame[k].n / rate);
    }
    qsort(best, (size_t)f->frames, sizeof *best, by_energy);
    f->frames = f->frames < POLES ? f->frames : POLES;
    qsort(best, (size_t)f->frames, sizeof *best, by_onset);
    bool ok = true;
    if (mode) {
        f->m = m;
        f->mode = ARENA_TAKE(a, struct source_filter_mode, m + 1);
        memcpy(f->mode, mode, (size_t)m * sizeof *mode);
        f->clicks = 1;
        f->click = ARENA_TAKE(a, double, 1);
        f->click[0] = o->direct;
    } else if (lee && f->frames > 0)
        poles_predicted(f, o, best, f->frames, a);
    else if (lee)
        ok = err_set(e, ERR_SCENE,
                     "no onset is followed by %.3g ms of free ringing, and the method lee goes by contacts that break: "
                     "take --method lagrange",
                     1e3 * shortest);
    else if (f->frames >= 3)
        ok = poles_fitted(f, o, best, f->frames, a, e);
    else
        ok = poles_correlated(f, o, a, e);
    if (ok && f->m == 0)
        ok = err_set(e, ERR_SCENE, "no mode stands out of the noise between %.6g and %.6g Hz", o->low, o->high);
    struct jump *jump = ARENA_TAKE(a, struct jump, f->onsets + 1);
    int jumps = ok && lee ? find_jumps(f, frame, jump, a) : 0;
    if (ok && lee) {
        if (jumps) prune(f, jump, jumps, o->most);
        jumps = find_jumps(f, frame, jump, a);
        ok = jumps > 0 ||
             err_set(e, ERR_SCENE, "no impact rings long enough to tell its gains; fewer modes may do (--modes)");
        if (ok) own_gains(f, jump, jumps, a);
    } else if (ok) {
        double pulse[REACH], loud = squares(f->x, n) / (double)n;
        struct hits h = {0};
        if (!mode) find_pulses(f, y, o->both, &h, a);
        bool known = mode || f->correlated; /* H is */
        if (f->correlated) normalise(f);
        for (int round = known ? 2 : 0; round < 4; round++) { /* with the impacts of the last; the fourth divides alone */
            static const double floors[] = {1e-2, 1e-2, 1e-3, 1e-4};
            if (round < 3 && !known && respond(f, &h, a)) normalise(f);
            cplx *gain = ARENA_TAKE(a, cplx, f->m);
            for (int i = 0; i < f->m; i++)
                gain[i] = f->mode[i].gain;
            double sound =
                energy_of(f, gain) * rate; /* of a source of 1: the recording's power over it is the source's */
            if (f->noise == 0) f->noise = 1e-3 * sqrt(loud);
            divide(f, o->snr, floors[round], sound > 0 ? loud / sound : 1, pulse, a);
            if (round == 3) break;
            find_impacts(f, o->both, pulse, a);
            h = (struct hits){
                .n = f->impacts.n, .at = ARENA_TAKE(a, double, f->impacts.n + 1), .size = f->impacts.amplitude};
            for (int k = 0; k < h.n; k++)
                h.at[k] = (f->impacts.time[k] + lead) * rate;
        }
        if (!mode) qsort(f->mode, (size_t)f->m, sizeof *f->mode, by_loudness);
    }
    if (ok) {
        double *given = ARENA_TAKE(a, double, n), all = squares(x, n), left = 0;
        source_filter_sound(f, given);
        for (long i = 0; i < n; i++)
            left += (x[i] - given[i]) * (x[i] - given[i]);
        f->rings = all > 0 ? 1 - left / all : 0;
    }
    gsl_set_error_handler(handler);
    return ok;
}
