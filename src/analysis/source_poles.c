#include "analysis/source_poles.h"

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
static const double longest = 0.5;       /* s of a free frame */
static const double shortest = 0.01;     /* s, of one from which poles are taken, of lee */
static const double rings = 0.03;        /* s, of one that adds to what the mean response says */
enum { PREDICT = 64, POLES = 12 };

/* ------------------------------------------------------------------ onsets */

/* What linear prediction does not foresee (autocorrelation method, Levinson and Durbin): while the object rings freely
   next to nothing, but for an impact. With noise added what is weak, and may be noise, is not raised. */
double *source_poles_unforeseen(const double *x, long n, double noise, struct arena *a)
{
    double r[PREDICT + 1], c[PREDICT + 1] = {1}, *y = ARENA_TAKE(a, double, n);
    int order = n / 4 < PREDICT ? (int)(n / 4) : PREDICT;
    for (int k = 0; k <= order; k++) {
        r[k] = 0;
        for (long i = k; i < n; i++)
            r[k] += x[i] * x[i - k];
    }
    double error = r[0] *= 1 + noise;
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
void source_poles_onsets(struct source_filter *f, const double *y, double rise, struct arena *a)
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

/* Behind each onset, until the next, or until something comes that is not foreseen though no onset was seen: more than
   thrice what was left of the onset in the first 2 ms, and than 8 times the median deviation. */
struct source_poles_frame *source_poles_free_frames(const struct source_filter *f, const double *y, struct arena *a)
{
    struct source_poles_frame *list = ARENA_TAKE(a, struct source_poles_frame, f->onsets + 1);
    struct arena *inner = arena_open();
    double *size = ARENA_TAKE(inner, double, f->n / 7 + 1);
    size_t few = 0;
    for (long i = 0; i < f->n; i += 7)
        size[few++] = fabs(y[i]);
    gsl_sort(size, 1, few);
    double quiet = 8 * gsl_stats_median_from_sorted_data(size, 1, few) / 0.6745;
    for (int k = 0; k < f->onsets; k++) {
        long from = f->onset[k] + (long)(SOURCE_PAST * f->rate), first = from + (long)(2e-3 * f->rate),
             to = k + 1 < f->onsets ? f->onset[k + 1] - (long)(SOURCE_MARGIN * f->rate) : f->n,
             most = from + (long)(longest * f->rate);
        double limit = quiet;
        to = to < most ? to : most;
        for (long i = from; i < to; i++) {
            if (i < first)
                limit = fmax(limit, 3 * fabs(y[i]));
            else if (fabs(y[i]) > limit)
                to = i - (long)(SOURCE_MARGIN * f->rate);
        }
        list[k] = (struct source_poles_frame){.onset = k, .from = from, .n = to - from};
        if (to - from > (long)(0.05 * f->rate)) list[k].from += (long)(4e-3 * f->rate), list[k].n = to - list[k].from;
        double part[2] = {0, 0};
        for (long i = 0; i < list[k].n; i++)
            part[2 * i >= list[k].n] += f->x[list[k].from + i] * f->x[list[k].from + i];
        bool falls = part[1] < ((double)list[k].n > 0.02 * f->rate ? 0.7 : 1) * part[0];
        list[k].energy = falls ? part[0] + part[1] : 0; /* what does not fall is driven by what was not seen */
    }
    arena_close(inner);
    return list;
}

struct source_poles_frame *source_poles_frames(const struct source_filter *f, const struct source_response_hits *h,
                                               struct arena *a)
{
    struct source_poles_frame *list = ARENA_TAKE(a, struct source_poles_frame, h->n + 1);
    long past = (long)((SOURCE_MARGIN + SOURCE_PAST) * f->rate), most = (long)(longest * f->rate);
    for (int k = 0; k < h->n; k++) {
        long from = (long)fmax(h->at[k], 0) + past, to = k + 1 < h->n ? (long)h->at[k + 1] : f->n;
        list[k] = (struct source_poles_frame){.onset = k, .from = from, .n = to - from < most ? to - from : most};
        for (long t = from; t < from + list[k].n; t++)
            list[k].energy += f->x[t] * f->x[t];
    }
    return list;
}

/* Of a frame for its poles: their variance falls with its energy and with the square of its length. */
static double worth(const struct source_poles_frame *f) { return f->energy * (double)f->n * (double)f->n; }

static int by_worth(const void *x, const void *y)
{
    double a = worth(x), b = worth(y);
    return (a < b) - (a > b);
}

static int by_onset(const void *x, const void *y)
{
    return ((const struct source_poles_frame *)x)->onset - ((const struct source_poles_frame *)y)->onset;
}

/* ------------------------------------------------------------------ poles */

/* Of all stretches together by ESPRIT and output error (analysis/modal.h); gains are those of the first. */
static bool poles_fitted(struct source_filter *f, const struct source_filter_options *o, struct modal_stretch *st,
                         int stretches, struct arena *a, struct err *e)
{
    static const double unit[1] = {1};
    struct modal_data d = {.rate = f->rate, .places = stretches, .stretches = stretches, .stretch = st};
    struct modal_options options = {.most = o->most, .low = o->low, .high = o->high, .fastest = o->fastest};
    struct modal_result r;
    for (int k = 0; k < stretches; k++) {
        st[k].n = modal_length(st[k].n);
        st[k].place = k;
        st[k].fitted = true;
        st[k].pulse = (struct modal_pulse){st[k].first, 1, unit};
    }
    if (f->m > 0) { /* known */
        cplx *pole = ARENA_TAKE(a, cplx, f->m), *gain = ARENA_TAKE(a, cplx, f->m * stretches);
        for (int i = 0; i < f->m; i++)
            pole[i] = source_poles_of(&f->mode[i]);
        modal_gains(&d, &options, f->m, pole, gain);
        for (int i = 0; i < f->m; i++)
            f->mode[i].gain = gain[i * stretches];
        return true;
    }
    if (!modal_find(&d, &options, a, &r, e)) return false;
    f->m = r.n;
    f->note = r.note;
    f->mode = ARENA_TAKE(a, struct source_filter_mode, r.n + 1);
    for (int i = 0; i < r.n; i++)
        f->mode[i] = (struct source_filter_mode){
            .frequency = r.mode[i].frequency,
            .decay = r.mode[i].decay,
            .frequency_se = fmax(r.mode[i].frequency_se, r.mode[i].frequency_between / sqrt(stretches)),
            .decay_se = fmax(r.mode[i].decay_se, r.mode[i].decay_between / sqrt(stretches)),
            .gain = r.mode[i].gain[0].a};
    return true;
}

/* The best of frame[n] that are that long, in their order. Returns how many. */
static int best_frames(struct source_filter *f, const struct source_poles_frame *frame, int n, double seconds,
                       struct source_poles_frame best[POLES])
{
    struct arena *a = arena_open();
    struct source_poles_frame *list = ARENA_TAKE(a, struct source_poles_frame, n + 1);
    int all = 0;
    for (int k = 0; k < n; k++)
        if ((double)frame[k].n >= seconds * f->rate && modal_length(frame[k].n) && frame[k].energy > 0)
            list[all++] = frame[k];
    qsort(list, (size_t)all, sizeof *list, by_worth);
    all = all < POLES ? all : POLES;
    while (all > 1 && worth(&list[all - 1]) < 0.03 * worth(&list[0])) /* they would add only their noise */
        all--;
    qsort(list, (size_t)all, sizeof *list, by_onset);
    memcpy(best, list, (size_t)all * sizeof *list);
    for (int k = 0; k < all; k++)
        f->longest = fmax(f->longest, (double)list[k].n / f->rate);
    arena_close(a);
    return f->frames = all;
}

/* f->reflected, the strongest reflection in a response: what prediction does not foresee, later than the impact itself,
   stands out of what it mostly is, and is not much less than the impact's. f->free, until the last is over; without a
   strong one until the impact itself is. */
static void find_free(struct source_filter *f, const double *h, long n)
{
    static const double noise = 1e-3, early = 80e-3, own = 3e-3 /* s */, least = 0.05, clear = 0.2, stands_out = 6;
    struct arena *a = arena_open();
    double *x = ARENA_TAKE(a, double, PREDICT + n), most = 0, reflection;
    long last = 0;
    memcpy(x + PREDICT, h, (size_t)n * sizeof *h);
    double *y = source_poles_unforeseen(x, PREDICT + n, noise, a) + PREDICT;
    for (long i = 0; i < n; i++)
        most = fmax(most, y[i] = fabs(y[i]));
    gsl_sort(memcpy(x, y, (size_t)n * sizeof *x), 1, (size_t)n);
    double chance = stands_out * gsl_stats_median_from_sorted_data(x, 1, (size_t)n) / 0.6745;
    f->reflected = NAN;
    f->reflection = reflection = fmax(clear * most, chance);
    for (long i = 0; i < n / 2 && (double)i < early * f->rate; i++) {
        if (y[i] > fmax(least * most, chance)) last = i;
        if (y[i] <= reflection || (double)i < (SOURCE_MARGIN + own) * f->rate) continue;
        f->reflected = (double)i / f->rate - SOURCE_MARGIN;
        f->reflection = (reflection = y[i]) / most;
    }
    if (isnan(f->reflected)) last = 0; /* what is left of many impacts looks like weak ones */
    f->free = floor(fmax(SOURCE_MARGIN * f->rate, (double)last) + SOURCE_PAST * f->rate) / f->rate;
    arena_close(a);
}

bool source_poles_response(struct source_filter *f, const struct source_filter_options *o, const double *h, long n,
                           const struct source_response_hits *hits, struct arena *a, struct err *e)
{
    find_free(f, h, n);
    long past = lrint(f->free * f->rate);
    struct source_poles_frame best[POLES];
    struct modal_stretch st[1 + POLES] = {{.y = h + past, .n = n - past}};
    int frames = best_frames(f, source_poles_frames(f, hits, a), hits->n, rings, best);
    f->longest = fmax(f->longest, (double)n / f->rate);
    for (int k = 0; k < frames; k++)
        st[1 + k] = (struct modal_stretch){.y = f->x + best[k].from, .first = best[k].from, .n = best[k].n};
    struct source_filter_options slow = *o;
    slow.fastest = fmin(o->fastest, 6.9 / f->free); /* by 60 dB until then */
    return poles_fitted(f, &slow, st, 1 + frames, a, e);
}

/* r(l) of the recording, l from SOURCE_PAST on, until it has sunk into what chance makes. */
bool source_poles_correlated(struct source_filter *f, const struct source_filter_options *o, struct arena *a,
                             struct err *e)
{
    long lags = (long)(longest * f->rate), size = (long)fft_good_size((size_t)(f->n + lags)),
         first = (long)(SOURCE_PAST * f->rate);
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
    double chance = 3 * x[0] / sqrt((double)f->n), block = 5e-3 * f->rate;
    long end = first;
    for (double most = HUGE_VAL; most > chance && end < lags && end < f->n / 2;) {
        long to = end + (long)block;
        most = 0;
        for (; end < to; end++)
            most = fmax(most, fabs(x[end]));
    }
    end = end < first + 128 ? first + 128 : end;
    end = end > lags ? lags : end;
    end = end > f->n / 2 ? f->n / 2 : end;
    if (end < first + 128)
        return err_set(e, ERR_SCENE, "%.3g s are too short to tell what rings", (double)f->n / f->rate);
    struct modal_stretch st = {.y = x + first, .n = end - first};
    if (!poles_fitted(f, o, &st, 1, a, e)) return false;
    f->correlated = true;
    for (int i = 0; i < f->m; i++) { /* of a force of white noise r(l) has |A|^2/(4 d) of each */
        struct source_filter_mode *m = &f->mode[i];
        m->gain = (cplx){sqrt(4 * m->decay * cplx_abs(m->gain)), 0};
        m->frequency_se = m->decay_se = NAN;
    }
    return true;
}

enum { BANDS = 8, ORDER = 16 }; /* octaves below half the rate, and the rest */

/* One band of the recording, critically sampled; octaves are upside down. Returns how many times lower its rate is. */
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
static void poles_predicted(struct source_filter *f, const struct source_filter_options *o,
                            const struct source_poles_frame *frame, int frames, struct arena *a)
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

bool source_poles_frames_find(struct source_filter *f, const struct source_filter_options *o,
                              const struct source_poles_frame *frame, struct arena *a, struct err *e)
{
    struct source_poles_frame best[POLES];
    if (!best_frames(f, frame, f->onsets, shortest, best))
        return err_set(e, ERR_SCENE,
                       "no onset is followed by %.3g ms of free ringing, and the method lee goes by contacts that "
                       "break: take --method lagrange",
                       1e3 * shortest);
    poles_predicted(f, o, best, f->frames, a);
    return true;
}
