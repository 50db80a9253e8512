/* Transfer of a residual to another object (papers/003 D.2, algorithm 1), corrected.

   As printed the algorithm scales a result that its next line overwrites unscaled, writes whole spectrograms in each
   pass, leaves what lies beyond the first and last pair empty, and does not say what P^s and P^t are. Here:

     pairs k = 1..K of modes, by the target's frequency; edges w_0 = 0, w_k = sqrt(f^t_k f^t_(k+1)), w_K = half the rate
     of every bin w between w_(k-1) and w_k, and every frame m:
       w' = w - (f^t_k - f^s_k)   or   w f^s_k/f^t_k        where it is taken from; 0 beyond the source's bins
       m' = onset + (m - onset) d^t_k/d^s_k                  frames that hold the onset itself stay
       A  = (P^t[m,w]/c + e)/(P^s[m',w'] + e)                between 0.01 and 100, smoothed 3 x 3
       R^t[m,w] = c A R^s[m',w']

   e is 1e-4 of the greatest power of a frame of P^s, all bins together. c is by what the pairs' modes are stronger in
   the target: the mean of their log powers by the energy that each has in the strike, so that a mode that was hardly
   struck, and whose gain is noise, does not set the level. (Energies of all modes made residuals up to 7 dB too loud or
   too soft on the very object that was recorded.) Of a body unlike the source, whose pairs' gains scatter, the residual
   comes out louder: by 8 dB of the bracket of scripts/section_e.sh.

   P^s and P^t are the powers of the source's and target's modes, each mode by itself, so that no two cancel. The source
   has four bins for one of the target. Between bins and frames powers are linear: of noise a mean of logarithms would
   lose 1 dB. Within 2 bins of an edge both neighbours' results are mixed. A bin is written once; that is counted.

   Pairs are not defined in the paper either: here the monotone assignment of least cost (dynamic programming). A pair
   costs (log(f^t/f^s)/0.15)^2 + (log(d^t/d^s)/1.5)^2, a mode that is left out 1, each by the fourth root of its share
   of energy. f^s and d^s are first multiplied by what makes one mode of each equal: of the three lowest strong ones the
   two that cost least, within three octaves; or as they are.

   Inverse by phases: those of the source, moved by the same map and referred to the onset, which stays sharp, and 50
   rounds of Griffin and Lim from there. Inverse by noise: the source's first 20 ms, scaled, then noise whose third
   octaves have the powers of R^t, frame by frame. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "num/fft.h"
#include "num/real.h"
#include "num/scaled.h"
#include "num/stft.h"
#include "num/vecmath.h"
#include "response/residual.h"

enum { ROUNDS = 50, STRONG = 3, FADE_BINS = 2, FINE = 4 }; /* FINE: bins of the source for one of the target */

static const double off_frequency = 0.15, off_decay = 1.5; /* of logarithms, for a cost of 1 */
static const double strong = 0.3;                          /* fourth root of energy, of the strongest's */
static const double furthest = 8.0;                        /* ratio of frequencies */
static const double most_stretch = 10.0, longest = 20.0;   /* times, and s */
static const double floor_of = 1e-4, least_scale = 0.01;   /* of the greatest power; of A, and the inverse */
static const double attack = 0.02, joint = 0.005;          /* s */

/* ------------------------------------------------------------------ pairs */

struct point {
    double f, d, weight; /* logarithms */
    int of;
};

static int by_frequency(const void *one, const void *other)
{
    const struct point *p = one, *q = other;
    return p->f != q->f ? (p->f > q->f) - (p->f < q->f) : p->of - q->of;
}

/* Modes that sound, by frequency. */
static int points(const struct residual_modes *m, struct point *p)
{
    double most = 0.0;
    int n = 0;
    for (int i = 0; i < m->n; i++) {
        double energy = m->gain[i] * m->gain[i] / m->decay[i];
        if (!(energy > 0.0 && isfinite(energy) && m->frequency[i] > 0.0)) continue;
        p[n++] = (struct point){real_log(m->frequency[i]), real_log(m->decay[i]), sqrt(sqrt(energy)), i};
        most = fmax(most, sqrt(sqrt(energy)));
    }
    for (int i = 0; i < n; i++)
        p[i].weight /= most;
    qsort(p, (size_t)n, sizeof *p, by_frequency);
    return n;
}

/* Least cost of an assignment with those scales of f and d (logarithms); to[n]: the target's point of each source's, or
   -1. */
static double assign(const struct point *s, int n, const struct point *t, int m, const double scale[2], double *cost,
                     int *to)
{
    double *row = cost;
    for (int j = 0; j <= m; j++)
        row[j] = j ? row[j - 1] + t[j - 1].weight : 0.0;
    for (int i = 1; i <= n; i++) {
        const double *last = row;
        row += m + 1;
        row[0] = last[0] + s[i - 1].weight;
        for (int j = 1; j <= m; j++) {
            double f = (t[j - 1].f - s[i - 1].f - scale[0]) / off_frequency,
                   d = (t[j - 1].d - s[i - 1].d - scale[1]) / off_decay,
                   pair = 0.5 * (s[i - 1].weight + t[j - 1].weight) * (f * f + d * d);
            row[j] = fmin(last[j - 1] + pair, fmin(last[j] + s[i - 1].weight, row[j - 1] + t[j - 1].weight));
        }
    }
    for (int i = n, j = m; i > 0; i--) {
        to[i - 1] = -1;
        while (j > 0 && row[j] == row[j - 1] + t[j - 1].weight && row[j] != row[j - m - 1] + s[i - 1].weight)
            j--;
        if (j > 0 && row[j] != row[j - m - 1] + s[i - 1].weight) to[i - 1] = --j;
        row -= m + 1;
    }
    return cost[(n + 1) * (m + 1) - 1];
}

int residual_transfer_pairs(const struct residual_modes *source, const struct residual_modes *target,
                            struct residual_transferred *t)
{
    struct arena *a = arena_open();
    struct point *p = ARENA_TAKE(a, struct point, source->n + 1), *q = ARENA_TAKE(a, struct point, target->n + 1);
    int n = points(source, p), m = points(target, q);
    int *to = ARENA_TAKE(a, int, n + 1), *best = ARENA_TAKE(a, int, n + 1);
    double *cost = ARENA_TAKE(a, double, (size_t)(n + 1) * (size_t)(m + 1));
    double least = assign(p, n, q, m, (const double[2]){0.0, 0.0}, cost, best);
    for (int i = 0, first = 0; i < n && first < STRONG; first += p[i++].weight >= strong)
        for (int j = 0, second = 0; j < m && second < STRONG; second += q[j++].weight >= strong) {
            double scale[2] = {q[j].f - p[i].f, q[j].d - p[i].d};
            if (p[i].weight < strong || q[j].weight < strong || fabs(scale[0]) > real_log(furthest)) continue;
            double found = assign(p, n, q, m, scale, cost, to);
            if (found >= least) continue;
            least = found;
            memcpy(best, to, (size_t)n * sizeof *to);
        }
    for (double limit = 0.0, next; limit < HUGE_VAL; limit = next) { /* the heaviest stay */
        t->pairs = 0;
        next = HUGE_VAL;
        for (int i = 0; i < n; i++) {
            double weight = best[i] < 0 ? 0.0 : p[i].weight + q[best[i]].weight;
            if (weight <= limit) continue;
            next = fmin(next, weight);
            if (t->pairs < RESIDUAL_PAIRS) {
                t->pair[t->pairs].source = p[i].of;
                t->pair[t->pairs].target = q[best[i]].of;
            }
            t->pairs++;
        }
        if (t->pairs <= RESIDUAL_PAIRS) break;
    }
    arena_close(a);
    return t->pairs;
}

/* ------------------------------------------------------------------ spectrograms */

struct spectra { /* [frames][bins] */
    struct stft *stft;
    double *re, *im, *power; /* of a sound */
    double *modes, most;     /* power of its modes; the greatest of a frame, all bins together */
};

static long count(const struct spectra *s) { return (long)s->stft->frames * s->stft->bins; }

/* Power of Im(A e^(s t)), t >= 0, |A| = gain, in a frame: the mean over the phases of A. work: [3 size + 2 bins]. */
static void frame_power(const struct stft *s, double rate, int frame, const double mode[3], double *work, double *power)
{
    long at = (long)(frame - STFT_ONSET) * s->hop;
    double *size = work, *wave[2] = {work + s->size, work + 2 * s->size}, *re = work + 3 * s->size, *im = re + s->bins;
    for (int j = 0; j < s->size; j++) {
        double t = (double)(at + j) / rate, turns = mode[0] * t;
        wave[0][j] = 2.0 * (turns - floor(turns));
        size[j] = at + j >= 0 ? -mode[1] * t : -HUGE_VAL;
    }
    vecmath_exp((size_t)s->size, size, size);
    vecmath_sincospi((size_t)s->size, wave[0], wave[1], wave[0]);
    memset(power, 0, (size_t)s->bins * sizeof *power);
    memset(s->work, 0, (size_t)s->padded * sizeof *s->work);
    for (int part = 0; part < 2; part++) {
        for (int j = 0; j < s->size; j++)
            s->work[j] = mode[2] * s->window[j] * size[j] * wave[part][j];
        fft_forward(s->fft, s->work, re, im);
        for (int k = 0; k < s->bins; k++)
            power[k] += 0.5 * (re[k] * re[k] + im[k] * im[k]);
    }
}

/* From frame STFT_ONSET on a mode's spectrum only falls; it is followed for 150 dB. */
static void modes_power(struct spectra *s, const struct residual_modes *m, double rate, struct arena *a)
{
    const struct stft *f = s->stft;
    double *work = ARENA_TAKE(a, double, 3 * f->size + 2 * f->bins), *one = ARENA_TAKE(a, double, f->bins);
    s->modes = ARENA_TAKE(a, double, count(s));
    for (int i = 0; i < m->n; i++) {
        double mode[3] = {m->frequency[i], m->decay[i], m->gain[i]}, falls = real_exp(-2.0 * mode[1] * f->hop / rate),
               left = 1.0;
        if (!(mode[0] < 0.5 * rate && mode[2] != 0.0)) continue;
        for (int frame = 0; frame < f->frames && left > 1e-15; frame++) {
            if (frame <= STFT_ONSET)
                frame_power(f, rate, frame, mode, work, one);
            else
                left *= falls;
            scaled_add(s->modes + (long)frame * f->bins, left, one, f->bins);
        }
    }
    for (int frame = 0; frame < f->frames; frame++) {
        double sum = 0.0;
        for (int k = 0; k < f->bins; k++)
            sum += s->modes[(long)frame * f->bins + k];
        s->most = fmax(s->most, sum * f->size / f->padded);
    }
}

/* ------------------------------------------------------------------ the map */

struct region { /* of a pair: bins [from, to) of the target */
    double from, to;
    double offset, factor; /* of bins: w' = factor w - offset */
    double rate;           /* of frames: d^t/d^s */
};

static double source_frame(const struct region *r, int frame)
{
    return frame <= STFT_ONSET ? frame : STFT_ONSET + (frame - STFT_ONSET) * r->rate;
}

/* Power at a place between frames and bins, linear; 0 beyond. */
static double between(const struct spectra *s, const double *power, double frame, double bin)
{
    int m = (int)frame, k = (int)bin, bins = s->stft->bins;
    double u = frame - m, v = bin - k, sum = 0.0;
    if (bin < 0.0 || bin > bins - 1) return 0.0;
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++) {
            double weight = (i ? u : 1.0 - u) * (j ? v : 1.0 - v);
            if (weight > 0.0 && m + i < s->stft->frames && k + j < bins)
                sum += weight * power[(long)(m + i) * bins + k + j];
        }
    return sum;
}

static struct region *regions(const struct residual_ask *ask, const struct residual_transferred *t,
                              const struct stft *f, struct arena *a)
{
    struct region *r = ARENA_TAKE(a, struct region, t->pairs);
    const struct residual_modes *s = &ask->source->modes, *g = ask->target;
    double per_bin = ask->source->rate / f->size;
    for (int k = 0; k < t->pairs; k++) {
        double from = s->frequency[t->pair[k].source], to = g->frequency[t->pair[k].target],
               stretch = s->decay[t->pair[k].source] / g->decay[t->pair[k].target];
        r[k] = (struct region){.to = f->bins, .factor = 1.0, .offset = (to - from) / per_bin};
        if (ask->shift == RESIDUAL_RATIO) r[k].factor = from / to;
        if (ask->shift == RESIDUAL_RATIO) r[k].offset = 0.0;
        r[k].rate = 1.0 / fmin(fmax(stretch, 1.0 / most_stretch), most_stretch);
        if (k == 0) continue;
        r[k].from = ceil(sqrt(to * g->frequency[t->pair[k - 1].target]) / per_bin);
        r[k - 1].to = r[k].from = fmin(fmax(r[k].from, r[k - 1].from), f->bins);
    }
    return r;
}

/* A column of bin w: of its own region, and near an edge with a share of the next. */
struct column {
    const struct region *own, *next;
    double share; /* of `next` */
};

static struct column column_of(const struct region *r, int pairs, int k, int w)
{
    struct column c = {.own = &r[k], .next = &r[k]};
    double down = w + 0.5 - r[k].from, up = r[k].to - (w + 0.5), near = fmin(down, up);
    int next = down < up ? k - 1 : k + 1;
    if (next < 0 || next >= pairs || near >= FADE_BINS) return c;
    c.next = &r[next];
    c.share = 0.5 * (1.0 - near / FADE_BINS);
    return c;
}

static double moved(const struct column *c, const struct spectra *s, const double *power, int frame, int w)
{
    double own = between(s, power, source_frame(c->own, frame), FINE * (c->own->factor * w - c->own->offset));
    if (c->share == 0.0) return own;
    return own +
           c->share *
               (between(s, power, source_frame(c->next, frame), FINE * (c->next->factor * w - c->next->offset)) - own);
}

/* c. */
static double stronger(const struct residual_ask *ask, const struct residual_transferred *t)
{
    const struct residual_modes *s = &ask->source->modes;
    double sum = 0.0, energy = 0.0;
    for (int k = 0; k < t->pairs; k++) {
        int i = t->pair[k].source;
        double share = s->energy ? s->energy[i] : s->gain[i] * s->gain[i] / s->decay[i];
        sum += 2.0 * share * real_log(ask->target->gain[t->pair[k].target] / s->gain[i]);
        energy += share;
    }
    return energy > 0.0 ? real_exp(sum / energy) : 1.0;
}

/* log A of every pixel to scale[], smoothed; A to it. */
static void pixel_scale(const struct spectra *t, double *scale, struct arena *a)
{
    int frames = t->stft->frames, bins = t->stft->bins;
    long n = count(t);
    double *log_of = ARENA_TAKE(a, double, n), limit = -real_log(least_scale);
    vecmath_log((size_t)n, scale, log_of);
    for (long i = 0; i < n; i++)
        log_of[i] = fmin(fmax(log_of[i], -limit), limit);
    for (int m = 0; m < frames; m++)
        for (int k = 0; k < bins; k++) {
            double sum = 0.0;
            int terms = 0;
            for (int i = m > 0 ? m - 1 : 0; i <= m + 1 && i < frames; i++)
                for (int j = k > 0 ? k - 1 : 0; j <= k + 1 && j < bins; j++, terms++)
                    sum += log_of[(long)i * bins + j];
            scale[(long)m * bins + k] = sum / terms;
        }
    vecmath_exp((size_t)n, scale, scale);
}

/* R^t to t->power, and to t->re, t->im the source's phases (of amplitude 1), at the place that each pixel comes from.
   */
static void move(const struct residual_ask *ask, const struct spectra *s, struct spectra *t,
                 struct residual_transferred *to, struct arena *a)
{
    int turns = s->stft->padded, bins = t->stft->bins, frames = t->stft->frames;
    double *scale = ARENA_TAKE(a, double, count(t)), *sine = ARENA_TAKE(a, double, turns),
           *cosine = ARENA_TAKE(a, double, turns);
    const struct region *r = regions(ask, to, t->stft, a);
    double more = stronger(ask, to);
    int *written = ARENA_TAKE(a, int, bins);
    for (int j = 0; j < turns; j++)
        sine[j] = 2.0 * j / turns;
    vecmath_sincospi((size_t)turns, sine, sine, cosine);
    for (int k = 0; k < to->pairs; k++)
        for (int w = (int)r[k].from; w < (int)r[k].to; w++, written[w - 1]++) {
            struct column c = column_of(r, to->pairs, k, w);
            double from = rint(FINE * (c.own->factor * w - c.own->offset));
            bool there = from >= 0.0 && from < s->stft->bins;
            for (int m = 0; m < frames; m++) {
                long at = (long)m * bins + w;
                double source = source_frame(c.own, m), whole = rint(source);
                t->power[at] = moved(&c, s, s->power, m, w);
                scale[at] =
                    (t->modes[at] / more + floor_of * s->most) / (moved(&c, s, s->modes, m, w) + floor_of * s->most);
                t->re[at] = 1.0;
                t->im[at] = 0.0;
                if (!there || whole >= s->stft->frames) continue;
                long pixel = (long)whole * s->stft->bins + (long)from;
                double x = s->re[pixel], y = s->im[pixel], length = sqrt(x * x + y * y);
                /* from the source's frame to the onset by its bin, from there to this frame by this one */
                long turn = ((long)FINE * w * (m - STFT_ONSET) - (long)from * ((long)whole - STFT_ONSET)) *
                            t->stft->hop % turns;
                turn += turn < 0 ? turns : 0;
                if (length > 0.0) {
                    t->re[at] = (x * cosine[turn] - y * sine[turn]) / length;
                    t->im[at] = (x * sine[turn] + y * cosine[turn]) / length;
                }
            }
        }
    to->written[0] = to->written[1] = written[0];
    for (int w = 1; w < bins; w++) {
        to->written[0] = written[w] < to->written[0] ? written[w] : to->written[0];
        to->written[1] = written[w] > to->written[1] ? written[w] : to->written[1];
    }
    pixel_scale(t, scale, a);
    for (long i = 0; i < count(t); i++)
        t->power[i] *= more * scale[i];
}

/* ------------------------------------------------------------------ inverses */

/* Griffin and Lim: to the sound of these phases, and from its phases again. At the end x has the energy asked for. */
static void by_phases(struct spectra *t, struct residual_transferred *to, struct arena *a)
{
    long n = count(t);
    double *size = ARENA_TAKE(a, double, n), wanted = 0.0, off = 0.0, found = 0.0;
    for (long i = 0; i < n; i++) {
        size[i] = sqrt(t->power[i]);
        wanted += t->power[i];
    }
    for (int round = 0; round <= ROUNDS; round++) {
        for (long i = 0; i < n; i++) {
            t->re[i] *= size[i];
            t->im[i] *= size[i];
        }
        stft_inverse(t->stft, t->re, t->im, to->x);
        stft_forward(t->stft, to->x, t->re, t->im);
        for (long i = 0; i < n; i++) {
            double length = sqrt(t->re[i] * t->re[i] + t->im[i] * t->im[i]), less = size[i] - length;
            if (round == ROUNDS) {
                off += less * less;
                found += length * length;
            }
            t->re[i] = length > 0.0 ? t->re[i] / length : 1.0;
            t->im[i] = length > 0.0 ? t->im[i] / length : 0.0;
        }
    }
    to->consistency = off > 0.0 ? 10.0 * real_log10(off / wanted) : -INFINITY;
    double gain = found > 0.0 ? sqrt(wanted / found) : 1.0;
    for (long i = 0; i < to->n; i++)
        to->x[i] *= gain;
}

/* Noise in third octaves, and the source's attack in its place. */
static void by_noise(const struct residual_ask *ask, const struct spectra *s, struct spectra *t,
                     struct residual_transferred *to)
{
    const struct stft *f = t->stft;
    double rate = ask->source->rate, mine = 0.0, its = 0.0, expected = 0.375 * f->size;
    noise_normal(ask->stream, 0, (size_t)to->n, to->x);
    stft_forward(f, to->x, t->re, t->im);
    for (int m = 0; m < f->frames; m++)
        for (int from = 0, end; from < f->bins; from = end) {
            double power = 0.0;
            end = (int)fmax(ceil(1.2599210498948732 * from), from + 1);
            end = end < f->bins ? end : f->bins;
            for (int k = from; k < end; k++)
                power += t->power[(long)m * f->bins + k] / (end - from);
            for (int k = from; k < end; k++) {
                t->re[(long)m * f->bins + k] *= sqrt(power / expected);
                t->im[(long)m * f->bins + k] *= sqrt(power / expected);
            }
        }
    stft_inverse(f, t->re, t->im, to->x);
    long first = (long)(attack * rate), fade = (long)(joint * rate), frames = first / f->hop + STFT_ONSET;
    for (long i = 0; i < frames * f->bins && i < count(t); i++)
        mine += t->power[i];
    for (long i = 0; i < frames * s->stft->bins && i < count(s); i++)
        its += s->power[i] / FINE;
    double gain = its > 0.0 ? sqrt(mine / its) : 0.0;
    for (long i = 0; i < first && i < to->n; i++) {
        double late = (double)(i - (first - fade)) / (double)fade, share = late > 0.0 ? real_sinpi(0.5 * late) : 0.0,
               x = i < ask->source->n ? gain * ask->source->x[i] : 0.0;
        to->x[i] = share * to->x[i] + sqrt(1.0 - share * share) * x;
    }
}

bool residual_transfer(const struct residual_ask *ask, struct arena *a, struct residual_transferred *t, struct err *e)
{
    const struct residual *source = ask->source;
    struct arena *inner = arena_open();
    struct spectra s = {0}, to = {0};
    double stretch = 0.0;
    *t = (struct residual_transferred){.consistency = NAN};
    if (!residual_transfer_pairs(&source->modes, ask->target, t)) {
        arena_close(inner);
        return err_set(e, ERR_SCENE,
                       "no mode that rings here can be paired with one of the residual's source: they lie "
                       "more than three octaves apart, or none rings");
    }
    for (int k = 0; k < t->pairs; k++)
        stretch = fmax(stretch, source->modes.decay[t->pair[k].source] / ask->target->decay[t->pair[k].target]);
    t->n = (long)fmin(ceil((double)source->n * fmin(fmax(stretch, 1.0 / most_stretch), most_stretch)),
                      fmax(longest * source->rate, (double)source->n));
    t->x = ARENA_TAKE(a, double, t->n);
    s.stft = stft_open(source->n, source->rate, FINE, inner);
    to.stft = stft_open(t->n, source->rate, 1, inner);
    for (struct spectra *one = &s;; one = &to) {
        one->re = ARENA_TAKE(inner, double, count(one));
        one->im = ARENA_TAKE(inner, double, count(one));
        one->power = ARENA_TAKE(inner, double, count(one));
        modes_power(one, one == &s ? &source->modes : ask->target, source->rate, inner);
        if (one == &to) break;
    }
    stft_forward(s.stft, source->x, s.re, s.im);
    stft_power(s.re, s.im, count(&s), s.power);
    move(ask, &s, &to, t, inner);
    if (ask->inverse == RESIDUAL_PHASES)
        by_phases(&to, t, inner);
    else
        by_noise(ask, &s, &to, t);
    stft_close(s.stft);
    stft_close(to.stft);
    arena_close(inner);
    return true;
}
