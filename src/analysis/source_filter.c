#include "analysis/source_filter.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_sort_double.h>
#include <gsl/gsl_statistics_double.h>
#include <stdlib.h>
#include <string.h>

#include "analysis/source_response.h"
#include "num/fft.h"

static const double hides = 10e-3;                  /* s about an impact */
static const double one = 0.6e-3;                   /* s: pulses of one impact */
static const double clicks = 2.5e-3, faded = 1e-3;  /* s of a click in all at least, and of its end that fades */
static const double small = 1.0 / 12, clear = 0.25; /* of another impact nearby, that is one: at last, and at first */
static const double longest = 0.5;                  /* s of a response */
enum { STATES = 240, FIT = 2048, REACH = 65536, MOST = 100000 };

/* ------------------------------------------------------------------ states */

/* state[m] at a frame's first sample: y = sum Im z e^(s t), by least squares. Adds what is left to *rest and its
   samples to *count. false: too few samples. */
static bool state_of(const struct source_filter *f, const struct source_poles_frame *at, cplx *state, double *rest,
                     double *all_of, double *count)
{
    long n = at->n < FIT ? at->n : FIT, all = 2 * f->m;
    if (n < all + all / 4 + 16) return false;
    struct arena *a = arena_open();
    double *basis = ARENA_TAKE(a, double, all *n), *left = ARENA_TAKE(a, double, n);
    for (int i = 0; i < f->m; i++) {
        cplx z = {1, 0}, turn = cplx_exp(source_poles_of(&f->mode[i]), 1 / f->rate);
        for (long t = 0; t < n; t++, z = cplx_mul(z, turn)) {
            basis[2 * i * n + t] = z.im;
            basis[(2 * i + 1) * n + t] = z.re;
        }
    }
    double *gain = ARENA_TAKE(a, double, all);
    memcpy(left, f->x + at->from, (size_t)n * sizeof *left);
    bool ok = source_response_solve(basis, all, n, n, left, gain);
    for (long t = 0; ok && t < n; t++) {
        *rest += left[t] * left[t];
        *all_of += f->x[at->from + t] * f->x[at->from + t];
    }
    if (ok) *count += (double)(n - all);
    for (int i = 0; ok && i < f->m; i++)
        state[i] = (cplx){gain[2 * i], gain[2 * i + 1]};
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
static int find_jumps(struct source_filter *f, struct source_poles_frame *frame, struct jump *jump, struct arena *a)
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
    f->fits = energy_all > 0 ? 1 - rest / energy_all : NAN;
    for (int k = 0, last = -1; k < f->onsets; last = frame[k].known ? k : last, k++) {
        struct jump *j = &jump[jumps];
        if (!frame[k].known) continue; /* what it added is in the next that is known */
        *j = (struct jump){.onset = k, .by = ARENA_TAKE(a, cplx, f->m)};
        for (int i = 0; i < f->m; i++) {
            cplx s = source_poles_of(&f->mode[i]);
            j->by[i] = cplx_mul(state[k * f->m + i], cplx_exp(s, (double)(f->onset[k] - frame[k].from) / f->rate));
            if (last < 0) continue;
            cplx rings = cplx_exp(s, (double)(f->onset[k] - frame[last].from) / f->rate);
            j->by[i] = cplx_sub(j->by[i], cplx_mul(state[last * f->m + i], rings));
        }
        j->energy = energy_of(f, j->by);
        jumps++;
    }
    return jumps;
}

/* ------------------------------------------------------------------ source */

/* z_m = p_m z_m + A_m f, y = sum Im z_m. Of places A is that of the latest. */
void source_filter_sound(const struct source_filter *f, double *y)
{
    memset(y, 0, (size_t)f->n * sizeof *y);
    for (int i = 0; i < f->m; i++) {
        cplx z = {0, 0}, turn = cplx_exp(source_poles_of(&f->mode[i]), 1 / f->rate), gain = f->mode[i].gain;
        for (long t = 0, place = 0; t < f->n; t++) {
            while (place < f->places && f->place_time[place] * f->rate <= (double)t + 0.5)
                gain = f->place_gain[i * f->places + place++];
            z = cplx_mul(z, turn);
            z = (cplx){fma(f->source[t], gain.re, z.re), fma(f->source[t], gain.im, z.im)};
            y[t] += z.im;
        }
    }
    if (!f->clicks) return;
    long size = (long)fft_good_size((size_t)(f->n + f->clicks)), bins = size / 2 + 1;
    struct arena *a = arena_open();
    double *x = ARENA_TAKE(a, double, size), *re = ARENA_TAKE(a, double, bins), *im = ARENA_TAKE(a, double, bins),
           *cr = ARENA_TAKE(a, double, bins), *ci = ARENA_TAKE(a, double, bins);
    struct fft *fft = fft_open((size_t)size);
    memcpy(x, f->click, (size_t)f->clicks * sizeof *x);
    fft_forward(fft, x, cr, ci);
    memset(x, 0, (size_t)f->clicks * sizeof *x);
    memcpy(x, f->source, (size_t)f->n * sizeof *x);
    fft_forward(fft, x, re, im);
    for (long k = 0; k < bins; k++) {
        cplx z = cplx_mul((cplx){re[k], im[k]}, (cplx){cr[k] / (double)size, ci[k] / (double)size});
        re[k] = z.re;
        im[k] = z.im;
    }
    fft_inverse(fft, re, im, x);
    for (long t = 0; t < f->n; t++)
        y[t] += x[t];
    fft_close(fft);
    arena_close(a);
}

/* So that |h| is at most 1; or with modes given, so that gains are theirs at low frequencies, where an impact is short.
   Impacts in units of the source. */
static void normalise(struct source_filter *f, int m, const struct source_filter_mode *mode)
{
    long n = (long)(0.05 * f->rate) < f->n ? (long)(0.05 * f->rate) : f->n;
    struct source_filter unit = *f;
    double *x = calloc((size_t)n, sizeof *x), *y = calloc((size_t)n, sizeof *y), most = 0, product = 0, square = 0;
    x[0] = 1;
    unit.n = n;
    unit.source = x;
    unit.places = 0;
    source_filter_sound(&unit, y);
    for (long t = 0; t < n; t++)
        most = fmax(most, fabs(y[t]));
    for (int i = 0; i < m && i < f->m; i++) {
        double given = cplx_square(mode[i].gain) / (mode[i].frequency * mode[i].frequency);
        product +=
            given * cplx_abs(f->mode[i].gain) / cplx_abs(mode[i].gain) * real_exp(-f->mode[i].decay * SOURCE_MARGIN);
        square += given;
    }
    most = square > 0 ? product / square : most;
    for (int i = 0; i < f->m && most > 0; i++)
        f->mode[i].gain = cplx_scale(1 / most, f->mode[i].gain);
    for (long k = 0; k < f->clicks && most > 0; k++)
        f->click[k] /= most;
    for (int k = 0; k < f->impacts.n && most > 0; k++)
        f->impacts.amplitude[k] *= most;
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
        cplx p = cplx_exp(source_poles_of(&f->mode[i]), 1 / f->rate), a = f->mode[i].gain, step, z = {1, 0};
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

/* What an impact of 1 becomes, from its middle on, until it has sunk by 60 dB. */
struct pulse {
    double *x; /* [REACH] */
    long n;
};

/* The source, and an impact's pulse in it. snr, floor: see source_filter.h; loud: the recording's power. */
static void divide(struct source_filter *f, double snr, double floor, double loud, struct pulse *pulse)
{
    long size = (long)fft_good_size((size_t)(f->n + (long)fmin(f->rate, (double)f->n) + REACH)), bins = size / 2 + 1;
    struct arena *a = arena_open();
    double *x = ARENA_TAKE(a, double, size), *re = ARENA_TAKE(a, double, bins), *im = ARENA_TAKE(a, double, bins),
           *hr = ARENA_TAKE(a, double, bins), *hi = ARENA_TAKE(a, double, bins), most = 0, mean = 0, eps;
    struct fft *fft = fft_open((size_t)size);
    response_at(f, fft, x, bins, hr, hi);
    memset(x, 0, (size_t)size * sizeof *x);
    memcpy(x, f->x, (size_t)f->n * sizeof *x);
    fft_forward(fft, x, re, im);
    for (long k = 0; k < bins; k++)
        most = fmax(most, hr[k] * hr[k] + hi[k] * hi[k]);
    for (long k = 0; k < bins; k++)
        mean += (hr[k] * hr[k] + hi[k] * hi[k]) / (double)bins; /* of a source of 1 the sound's power */
    if (f->noise == 0) f->noise = 1e-3 * sqrt(loud);
    eps =
        isnan(snr) ? fmax(f->noise * f->noise * mean / loud, floor * most) : most * fmax(real_exp10(-snr / 10), floor);
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
    memcpy(pulse->x, x, REACH * sizeof *x);
    for (pulse->n = REACH; pulse->n > 4 && fabs(x[pulse->n - 1]) < 1e-3 * x[0];)
        pulse->n--;
    fft_close(fft);
    arena_close(a);
}

static double squares(const double *x, long n)
{
    double sum = 0;
    for (long i = 0; i < n; i++)
        sum += x[i] * x[i];
    return sum;
}

/* ------------------------------------------------------------------ impacts */

/* None yet; with room for n. */
static struct impact_events events_open(const struct source_filter *f, int n, struct arena *a)
{
    return (struct impact_events){.time = ARENA_TAKE(a, double, n + 1),
                                  .amplitude = ARENA_TAKE(a, double, n + 1),
                                  .duration = ARENA_TAKE(a, double, n + 1),
                                  .alone = ARENA_TAKE(a, bool, n + 1),
                                  .blur = {0, 1 / f->rate}};
}

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
static double pulse_at(const struct pulse *pulse, double t)
{
    long i = (long)floor(fabs(t));
    double p[4];
    if (i + 2 >= pulse->n) return 0;
    for (long k = -1; k <= 2; k++)
        p[k + 1] = pulse->x[labs(i + k)];
    return source_response_between(p + 1, fabs(t) - (double)i);
}

/* What is less than that share of another within 10 ms may be what that one left. */
static void leave_out_small(struct impact_events *v, double share)
{
    bool *stays = calloc((size_t)v->n + 1, sizeof *stays);
    int n = 0;
    for (int k = 0; k < v->n; k++) {
        double most = 0;
        for (int i = k; i >= 0 && v->time[k] - v->time[i] < hides; i--)
            most = fmax(most, fabs(v->amplitude[i]));
        for (int i = k; i < v->n && v->time[i] - v->time[k] < hides; i++)
            most = fmax(most, fabs(v->amplitude[i]));
        stays[k] = fabs(v->amplitude[k]) >= share * most;
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

/* rest[n] less a pulse. */
static void take_pulse(double *rest, long n, const struct pulse *pulse, double at, double size)
{
    long middle = (long)rint(at), from = middle - pulse->n + 1, to = middle + pulse->n;
    for (long i = from > 0 ? from : 0; i < to && i < n; i++)
        rest[i] -= size * pulse_at(pulse, (double)i - at);
}

/* The greatest of x from a sample to another, between samples by a parabola, as a pulse. */
static struct peak greatest(const double *x, long n, long from, long to, bool both, const struct pulse *pulse)
{
    long at = from = from > 0 ? from : 0;
    for (long i = from; i < to && i < n; i++)
        if (both ? fabs(x[i]) > fabs(x[at]) : x[i] > x[at]) at = i;
    double u = 0, size = x[at];
    if (at > 0 && at + 1 < n) {
        double bend = x[at - 1] - 2 * x[at] + x[at + 1], tilt = (x[at + 1] - x[at - 1]) / 2;
        if (bend * x[at] < 0) u = fmax(-0.5, fmin(-tilt / bend, 0.5));
        size += u * tilt / 2;
    }
    return (struct peak){(double)at + u, size / pulse->x[0]};
}

/* Pulses within `one` as one, in their order. Returns how many. */
static int merge(struct peak *peak, int n, double width)
{
    int all = 0;
    qsort(peak, (size_t)n, sizeof *peak, by_time);
    for (int k = 0; k < n; all++) {
        double sum = 0, weight = 0, time = 0, first = peak[k].at;
        for (; k < n && peak[k].at - first <= width; k++) {
            sum += peak[k].size;
            weight += fabs(peak[k].size);
            time += fabs(peak[k].size) * peak[k].at;
        }
        peak[all] = (struct peak){weight > 0 ? time / weight : first, sum};
    }
    return all;
}

/* The greatest pulse is taken off, and so on, until what is left is as the source is in between, 4.5 times its
   deviation. Pulses within `one` are one impact. Where pulses overlap the greatest is not where an impact is: so each
   is put back in turn, and looked for once more beside all others. */
static void find_impacts(struct source_filter *f, bool both, const struct pulse *pulse, double share, struct arena *a)
{
    enum { PART = 256, SWEEPS = 3 };
    struct arena *inner = arena_open();
    long parts = (f->n + PART - 1) / PART, width = (long)(one * f->rate);
    double *rest = ARENA_TAKE(inner, double, f->n), *room = ARENA_TAKE(inner, double, f->n / 5 + 2),
           *top = ARENA_TAKE(inner, double, parts), energy = squares(f->source, f->n), first = 0;
    struct peak *peak = ARENA_TAKE(inner, struct peak, MOST);
    int n = 0;
    memcpy(rest, f->source, (size_t)f->n * sizeof *rest);
    double least = 4.5 * deviation(rest, f->n, room);
    for (long p = 0; p < parts; p++)
        top[p] = -1; /* not known */
    for (; n < MOST; n++) {
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
        if (n == 0) first = top[best];
        if (!(top[best] > fmax(least, 0.01 * first))) {
            double was = least; /* of what is left, which pulses raise no more */
            least = fmin(was, 8 * deviation(rest, f->n, room));
            if (!(least < 0.9 * was) || !(top[best] > fmax(least, 0.01 * first))) break;
        }
        peak[n] = greatest(rest, f->n, best * PART, (best + 1) * PART, both, pulse);
        take_pulse(rest, f->n, pulse, peak[n].at, peak[n].size);
        long from = (long)peak[n].at - pulse->n, to = (long)peak[n].at + pulse->n;
        for (long p = from > 0 ? from / PART : 0; p < parts && p <= to / PART; p++)
            top[p] = -1;
    }
    for (int sweep = 0; sweep < SWEEPS; sweep++) {
        int all = merge(peak, n, (double)width);
        if (all < n || sweep == 0) {
            memcpy(rest, f->source, (size_t)f->n * sizeof *rest);
            for (int k = 0; k < all; k++)
                take_pulse(rest, f->n, pulse, peak[k].at, peak[k].size);
        }
        n = all;
        for (int k = 0; k < n; k++) {
            take_pulse(rest, f->n, pulse, peak[k].at, -peak[k].size);
            long at = (long)rint(peak[k].at);
            peak[k] = greatest(rest, f->n, at - width, at + width + 1, both, pulse);
            take_pulse(rest, f->n, pulse, peak[k].at, peak[k].size);
        }
    }
    n = merge(peak, n, (double)width);
    f->struck = energy > 0 ? 1 - squares(rest, f->n) / energy : 0;
    struct impact_events *v = &f->impacts;
    *v = events_open(f, n, a);
    for (int k = 0; k < n; k++) {
        if (fabs(peak[k].size) * pulse->x[0] <= least || (!both && peak[k].size <= 0)) continue;
        v->time[v->n] = peak[k].at / f->rate;
        v->amplitude[v->n] = peak[k].size;
        v->duration[v->n++] = NAN;
    }
    leave_out_small(v, share);
    arena_close(inner);
}

static void fade(struct source_filter *f)
{
    long n = f->clicks, fades = (long)(faded * f->rate);
    for (long t = n - fades > 0 ? n - fades : 0; t < n; t++)
        f->click[t] *= 0.5 + 0.5 * real_cospi((double)(t - n + fades) / (double)fades);
}

/* Lee: the onsets are the impacts, and each has gains of its own. */
static void own_gains(struct source_filter *f, struct jump *jump, int jumps, struct arena *a)
{
    struct impact_events *v = &f->impacts;
    double loudest = 0;
    for (int k = 0; k < jumps; k++)
        loudest = fmax(loudest, jump[k].energy);
    *v = events_open(f, jumps, a);
    f->place_time = ARENA_TAKE(a, double, jumps);
    f->place_gain = ARENA_TAKE(a, cplx, jumps * f->m);
    struct source_response_hits h = {.n = jumps, .at = ARENA_TAKE(a, double, jumps), .size = v->amplitude};
    double *rest = ARENA_TAKE(a, double, f->n);
    f->places = jumps;
    for (int k = 0; k < jumps; k++) {
        long at = f->onset[jump[k].onset] - (long)(SOURCE_MARGIN * f->rate);
        double early = (double)(f->onset[jump[k].onset] - (at = at > 0 ? at : 0)) / f->rate;
        h.at[k] = (double)at;
        f->place_time[k] = v->time[k] = h.at[k] / f->rate;
        v->duration[k] = NAN;
        v->amplitude[k] = sqrt(jump[k].energy / loudest);
        f->source[at] = v->amplitude[k];
        for (int i = 0; i < f->m; i++)
            f->place_gain[i * jumps + k] =
                v->amplitude[k] > 0
                    ? cplx_scale(1 / v->amplitude[k],
                                 cplx_mul(jump[k].by[i], cplx_exp(source_poles_of(&f->mode[i]), -early)))
                    : (cplx){0, 0};
    }
    source_filter_sound(f, rest);
    for (long t = 0; t < f->n; t++)
        rest[t] = f->x[t] - rest[t];
    f->clicks = (long)(clicks * f->rate);
    f->click = ARENA_TAKE(a, double, f->clicks);
    source_response_mean(rest, f->n, &h, f->click, f->clicks);
    fade(f);
    v->n = jumps;
    f->struck = 1;
}

/* ------------------------------------------------------------------ all */

static double loudness(const struct source_filter_mode *m) { return cplx_square(m->gain) / m->decay; }

static int by_loudness(const void *x, const void *y)
{
    double p = loudness(x), q = loudness(y);
    return (p < q) - (p > q);
}

/* By falling energy, but for what is 30 dB below a mode nearby, or 90 dB below the strongest: no response is quite the
   mean one, and what is left of a strong mode looks like weak ones about it. */
static void leave_out_skirts(struct source_filter *f)
{
    static const double beside = 25; /* Hz */
    int n = 0;
    qsort(f->mode, (size_t)f->m, sizeof *f->mode, by_loudness);
    for (int i = 0; i < f->m; i++) {
        bool skirt = loudness(&f->mode[i]) < 1e-9 * loudness(&f->mode[0]);
        for (int k = 0; k < n; k++)
            skirt = skirt || (fabs(f->mode[k].frequency - f->mode[i].frequency) < beside &&
                              loudness(&f->mode[i]) < 1e-3 * loudness(&f->mode[k]));
        if (!skirt) f->mode[n++] = f->mode[i];
    }
    f->m = n;
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
    while (f->m > 0 && (f->m > most || loudness(&f->mode[f->m - 1]) < 1e-6 * loudest))
        f->m--;
}

/* The click of the response h[n] to an impact of 1, until the modes alone ring. */
static void take_click(struct source_filter *f, const double *h, long n, double until, struct arena *a)
{
    struct source_filter unit = *f;
    double *x = ARENA_TAKE(a, double, n), *y = ARENA_TAKE(a, double, n);
    x[0] = 1;
    unit.n = n;
    unit.source = x;
    unit.clicks = 0;
    source_filter_sound(&unit, y);
    f->clicks = (long)(until * f->rate) < n ? (long)(until * f->rate) : n;
    f->click = ARENA_TAKE(a, double, f->clicks);
    for (long t = 0; t < f->clicks; t++)
        f->click[t] = h[t] - y[t];
    fade(f);
}

/* Those of the source, SOURCE_MARGIN before their onsets. */
static struct source_response_hits hits_of(const struct source_filter *f, struct arena *a)
{
    struct source_response_hits h = {
        .n = f->impacts.n, .at = ARENA_TAKE(a, double, f->impacts.n + 1), .size = f->impacts.amplitude};
    for (int k = 0; k < h.n; k++)
        h.at[k] = f->impacts.time[k] * f->rate;
    return h;
}

/* What prediction does not foresee is a pulse for each impact: divided by the mean one, as the recording by its
   response. This finds those that stand out of the noise by their shape alone. */
static struct source_response_hits find_pulses(const struct source_filter *f, const struct source_filter_options *o,
                                               const double *unforeseen, struct arena *a)
{
    struct pulse pulse = {.x = ARENA_TAKE(a, double, REACH)};
    struct source_filter first = {.x = unforeseen, .n = f->n, .rate = f->rate, .source = f->source};
    struct source_response_hits h;
    long n = (long)(clicks * f->rate);
    double *response = ARENA_TAKE(a, double, n), loud = squares(unforeseen, f->n) / (double)f->n;
    source_response_pulses(f, unforeseen, o->both, &h, a);
    if (!h.n) return h;
    for (int k = 0; k < h.n; k++)
        h.at[k] -= SOURCE_MARGIN * f->rate;
    double share = source_response_mean(unforeseen, f->n, &h, response, n);
    first.noise = sqrt(fmax(1 - share, 1e-6) * loud);
    take_click(&first, response, n, clicks, a);
    normalise(&first, 0, NULL);
    divide(&first, NAN, 1e-2, loud, &pulse);
    find_impacts(&first, o->both, &pulse, clear, a);
    memset(f->source, 0, (size_t)f->n * sizeof *f->source);
    return hits_of(&first, a);
}

/* Impacts are little of it: the modes of the autocorrelation, or those given, and the source alone. */
static bool find_driven(struct source_filter *f, const struct source_filter_options *o, bool given, struct arena *a,
                        struct err *e)
{
    struct pulse pulse = {.x = ARENA_TAKE(a, double, REACH)};
    double loud = squares(f->x, f->n) / (double)f->n;
    if (given && o->direct != 0) {
        f->clicks = 1;
        f->click = ARENA_TAKE(a, double, 1);
        f->click[0] = o->direct;
    }
    if (!given && !source_poles_correlated(f, o, a, e)) return false;
    if (!f->m)
        return err_set(e, ERR_SCENE, "no mode stands out of the noise between %.6g and %.6g Hz", o->low, o->high);
    f->noise = 0; /* not known: what impacts leave is the force */
    if (!given) normalise(f, 0, NULL);
    divide(f, o->snr, 1e-3, loud, &pulse);
    find_impacts(f, o->both, &pulse, small, a);
    divide(f, o->snr, 1e-4, loud, &pulse);
    return true;
}

/* As they are in hits. */
static struct impact_events events_of(const struct source_filter *f, const struct source_response_hits *h,
                                      struct arena *a)
{
    struct impact_events v = events_open(f, h->n, a);
    for (; v.n < h->n; v.n++) {
        v.time[v.n] = h->at[v.n] / f->rate;
        v.amplitude[v.n] = h->size[v.n];
        v.duration[v.n] = NAN;
    }
    return v;
}

/* Do so many impacts, which give that share of the recording, tell more than fewer? Each gives as much as `small`
   of the others' size would. Any sound is that of one impact and a response, or of many and another: the
   fewest are taken. */
static bool tells_more(double fits, int n, double before, int fewer)
{
    return fits - before >= small * small * before * (n - fewer) / fewer;
}

/* The strongest n of them. */
static struct source_response_hits strongest(const struct source_response_hits *h, int n, struct arena *a)
{
    struct source_response_hits few = {.at = ARENA_TAKE(a, double, n + 1), .size = ARENA_TAKE(a, double, n + 1)};
    double *sorted = ARENA_TAKE(a, double, h->n + 1);
    for (int k = 0; k < h->n; k++)
        sorted[k] = -fabs(h->size[k]);
    gsl_sort(sorted, 1, (size_t)h->n);
    for (int k = 0; k < h->n && few.n < n; k++)
        if (fabs(h->size[k]) >= -sorted[n - 1]) {
            few.at[few.n] = h->at[k];
            few.size[few.n++] = h->size[k];
        }
    return few;
}

/* Of `all` the strongest that tell as much, doubled from those that have a sixteenth of the squares on. *fits: the
   share that they give; response[length]: the mean one. */
static struct source_response_hits fewest(const struct source_filter *f, struct source_response_hits all, double *fits,
                                          double *response, long length, struct arena *a)
{
    double share = source_response_mean(f->x, f->n, &all, response, length);
    for (int n = 1; n < all.n; n *= 2) {
        struct source_response_hits few = strongest(&all, n, a);
        if (squares(few.size, few.n) < squares(all.size, all.n) / 16) continue;
        *fits = source_response_mean(f->x, f->n, &few, response, length);
        if (!tells_more(share, all.n, *fits, few.n)) return few;
    }
    *fits = source_response_mean(f->x, f->n, &all, response, length);
    return all;
}

/* One filter for all impacts: their mean response, its modes, the source divided by them, the impacts in it, and so on,
   until they give no more of the recording. */
static bool find_lagrange(struct source_filter *f, const struct source_filter_options *o, const double *unforeseen,
                          int m, const struct source_filter_mode *mode, struct arena *a, struct err *e)
{
    enum { ROUNDS = 6 };
    static const double alike = 0.35; /* share of the recording, from which on impacts are what drives it */
    const struct source_response_hits none = {0};
    struct source_response_hits all = find_pulses(f, o, unforeseen, a);
    struct pulse pulse = {.x = ARENA_TAKE(a, double, REACH)};
    long length = (long)(fmin(longest * f->rate, (double)f->n / 2));
    double loud = squares(f->x, f->n) / (double)f->n, before = 0, best = 0, left = HUGE_VAL,
           *response = ARENA_TAKE(a, double, length);
    struct source_response_hits h = fewest(f, all, &f->fits, response, length, a);
    f->impacts = events_of(f, &h, a);
    f->mode = ARENA_TAKE(a, struct source_filter_mode, m + 1);
    f->m = m;
    if (mode) memcpy(f->mode, mode, (size_t)m * sizeof *mode);
    struct impact_events kept = f->impacts;
    for (int round = 1;; round++) {
        bool last = round == ROUNDS || f->fits < alike || (round > 2 && f->fits < before + 1e-3);
        before = f->fits;
        if (round == 1 || tells_more(f->fits, h.n, best, kept.n)) {
            kept = f->impacts;
            best = f->fits;
        } else if (last) {
            f->impacts = kept;
            h = hits_of(f, a);
            f->fits = source_response_mean(f->x, f->n, &h, response, length);
        }
        f->noise = sqrt(fmax(1 - f->fits, 1e-6) * loud);
        if (f->fits < alike) return find_driven(f, o, mode != NULL, a, e);
        if (!mode && (last || left > 2 * (1 - f->fits))) { /* anew; until the response is clearly better they do */
            f->m = 0;
            left = 1 - f->fits;
        }
        if (!source_poles_response(f, o, response, length, last ? &h : &none, a, e)) return false;
        if (!f->m) return find_driven(f, o, false, a, e);
        if (!mode) leave_out_skirts(f);
        for (int i = 0; i < f->m; i++)
            f->mode[i].gain = cplx_mul(f->mode[i].gain, cplx_exp(source_poles_of(&f->mode[i]), -f->free));
        take_click(f, response, length, fmax(clicks, f->free + faded), a);
        normalise(f, m, mode);
        divide(f, o->snr, last ? 1e-4 : 1e-2, loud, &pulse);
        if (last) break;
        find_impacts(f, o->both, &pulse, round < 2 ? clear : small, a);
        h = hits_of(f, a);
        f->fits = source_response_mean(f->x, f->n, &h, response, length);
    }
    return true;
}

/* Each impact has gains of its own: what it adds to what rings already. y: what prediction does not foresee. */
static bool find_lee(struct source_filter *f, const struct source_filter_options *o, const double *y, int m,
                     const struct source_filter_mode *mode, struct arena *a, struct err *e)
{
    struct source_poles_frame *frame = source_poles_free_frames(f, y, a);
    struct jump *jump = ARENA_TAKE(a, struct jump, f->onsets + 1);
    if (mode) {
        f->m = m;
        f->mode = memcpy(ARENA_TAKE(a, struct source_filter_mode, m + 1), mode, (size_t)m * sizeof *mode);
    } else if (!source_poles_frames_find(f, o, frame, a, e))
        return false;
    int jumps = find_jumps(f, frame, jump, a);
    if (jumps) prune(f, jump, jumps, o->most);
    jumps = find_jumps(f, frame, jump, a);
    if (!jumps)
        return err_set(e, ERR_SCENE, "no impact rings long enough to tell its gains; fewer modes may do (--modes)");
    own_gains(f, jump, jumps, a);
    return true;
}

bool source_filter_find(const double *x, long n, double rate, const struct source_filter_options *o, int m,
                        const struct source_filter_mode *mode, struct arena *a, struct source_filter *f, struct err *e)
{
    static const double weak = 0.1, next_to_none = 1e-10; /* noise with which prediction is made */
    bool lee = o->method == SOURCE_FILTER_LEE;
    gsl_error_handler_t *handler = gsl_set_error_handler_off();
    *f = (struct source_filter){
        .x = x, .n = n, .rate = rate, .fits = NAN, .reflected = NAN, .source = ARENA_TAKE(a, double, n)};
    double *y = source_poles_unforeseen(x, n, lee ? next_to_none : weak, a);
    source_poles_onsets(f, y, o->rise, a);
    bool ok = lee ? find_lee(f, o, y, m, mode, a, e) : find_lagrange(f, o, y, m, mode, a, e);
    if (ok) {
        double *given = ARENA_TAKE(a, double, n), all = squares(x, n), left = 0;
        source_filter_sound(f, given);
        for (long i = 0; i < n; i++)
            left += (x[i] - given[i]) * (x[i] - given[i]);
        f->rings = all > 0 ? 1 - left / all : 0;
        if (lee && f->rings < 0)
            ok = err_set(
                e, ERR_SCENE,
                "impacts follow each other too closely to tell the gains of each: take --method lagrange, or fewer "
                "modes (--modes)");
    }
    gsl_set_error_handler(handler);
    return ok;
}
