/* Stretches on their DFT bins, and a mode's sound on them (modal_fit.h has the equations). */
#include <gsl/gsl_movstat.h>
#include <string.h>

#include "analysis/modal_fit.h"
#include "num/fft.h"
#include "num/lanes.h"

enum { GROUP = 8, PATCH = 256 };

/* Spread of strikes' poles while modes are looked for, of omega/omega. What holds an object moves a mode by a few parts
 * in a thousand (a steel plate that swings); with a narrower one each strike would have its own component for it. */
static const double most_moved = 2e-3;
static const double quietest = 1e-9; /* of a stretch's rms: no noise of a bin is less, as phases are not known better */

/* ------------------------------------------------------------------ spectra */

static void spectrum(const double *x, long n, struct arena *a, double **re, double **im)
{
    struct fft *fft = fft_open((size_t)n);
    double size = 1.0 / sqrt((double)n);
    *re = ARENA_TAKE(a, double, n / 2 + 1);
    *im = ARENA_TAKE(a, double, n / 2 + 1);
    fft_forward(fft, x, *re, *im);
    fft_close(fft);
    for (long k = 0; k <= n / 2; k++) {
        (*re)[k] *= size;
        (*im)[k] *= size;
    }
}

static void open_bins(const struct modal_fit *f, const struct modal_stretch *s, struct modal_bins *b)
{
    double *force = ARENA_TAKE(f->a, double, s->n), *re, *im, sum = 0.0;
    b->width = 2.0 * REAL_PI * f->data->rate / (double)s->n;
    b->first = (long)ceil(f->low / b->width);
    b->first = b->first > 1 ? b->first : 1;
    b->n = (long)floor(f->high / b->width) - b->first + 1;
    b->n = b->first + b->n > s->n / 2 ? s->n / 2 - b->first : b->n;
    b->n = b->n > 0 ? b->n : 0;
    double **reals[] = {&b->er, &b->ei, &b->variance, &b->floor, &b->scale};
    cplx **complexes[] = {&b->y, &b->rest, &b->noise};
    for (size_t i = 0; i < sizeof reals / sizeof *reals; i++)
        *reals[i] = ARENA_TAKE(f->a, double, b->n + 1);
    for (size_t i = 0; i < sizeof complexes / sizeof *complexes; i++)
        *complexes[i] = ARENA_TAKE(f->a, cplx, b->n + 1);
    for (long i = 0; i < s->n; i++)
        sum += s->y[i] * s->y[i] / (double)s->n;
    for (long i = 0; i < s->pulse.n; i++)
        if (s->pulse.at + i >= s->first && s->pulse.at + i < s->first + s->n)
            force[s->pulse.at + i - s->first] = s->pulse.f[i];
    spectrum(force, s->n, f->a, &re, &im);
    b->fr = re + b->first;
    b->fi = im + b->first;
    spectrum(s->y, s->n, f->a, &re, &im);
    for (long k = 0; k < b->n; k++) {
        double turn = 2.0 * (double)(b->first + k) / (double)s->n;
        b->er[k] = real_cospi(turn);
        b->ei[k] = -real_sinpi(turn);
        b->y[k] = (cplx){re[b->first + k], im[b->first + k]};
        b->floor[k] = fmax(fmax(quietest * quietest * sum, s->rounding * s->rounding), 1e-290);
        b->scale[k] = 1.0;
    }
}

/* ------------------------------------------------------------------ noise */

/* The running median over `half` means to each side, of n >= 2 half + 1 means; windows at the ends are as wide as the
 * others. */
static void running_median(const double *x, long n, long half, double *to)
{
    gsl_movstat_workspace *w = gsl_movstat_alloc((size_t)(2 * half + 1));
    gsl_vector_const_view from = gsl_vector_const_view_array(x, (size_t)n);
    gsl_vector_view median = gsl_vector_view_array(to, (size_t)n);
    gsl_movstat_median(GSL_MOVSTAT_END_TRUNCATE, &from.vector, &median.vector, w);
    gsl_movstat_free(w);
    for (long k = 0; k < half; k++) {
        to[k] = to[half];
        to[n - 1 - k] = to[n - 1 - half];
    }
}

/* Of |x|^2: medians of means of 8 bins (of chi squared of 16 degrees the median is 0.9586 of the mean), linear in
 * between. */
static void smooth_power(const cplx *x, long n, long half, double *to)
{
    struct arena *a = arena_open();
    long groups = n / GROUP;
    if (groups < 1) groups = 1;
    double *mean = ARENA_TAKE(a, double, groups), *median = ARENA_TAKE(a, double, groups);
    for (long k = 0; k < groups; k++) {
        long count = 0;
        for (long i = k * GROUP; i < (k + 1) * GROUP && i < n; i++, count++)
            mean[k] += cplx_square(x[i]);
        mean[k] = count ? mean[k] / ((double)count * 0.9586) : 0.0;
    }
    running_median(mean, groups, half < (groups - 1) / 2 ? half : (groups - 1) / 2, median);
    for (long i = 0; i < n; i++) {
        double at = ((double)i - 0.5 * (GROUP - 1)) / GROUP;
        long k = at > 0.0 ? (long)at : 0;
        double part = at > (double)k ? at - (double)k : 0.0;
        to[i] = k + 1 < groups ? median[k] + part * (median[k + 1] - median[k]) : median[groups - 1];
    }
    arena_close(a);
}

void modal_fit_take_smooth_off(const struct modal_bins *b, long from, long n, const cplx *x, cplx *to)
{
    enum { TERMS = 3, N = TERMS + 2 };
    double a[N * N] = {0}, scale[TERMS];
    for (long k = 0; k < n; k++) {
        cplx force = {b->fr[from + k], b->fi[from + k]}, product = cplx_mul(cplx_conj(force), x[k]);
        double power = cplx_square(force), u = 2.0 * (double)k / (double)n - 1.0, row[TERMS] = {1.0, u, u * u};
        for (int i = 0; i < TERMS; i++) {
            for (int j = 0; j < TERMS; j++)
                a[i * N + j] += power * row[i] * row[j];
            a[i * N + TERMS] += row[i] * product.re;
            a[i * N + TERMS + 1] += row[i] * product.im;
        }
    }
    for (int i = 0; i < TERMS; i++)
        scale[i] = a[i * N + i];
    modal_block_sweep(a, N, 0, TERMS, scale);
    for (long k = 0; k < n; k++) {
        double u = 2.0 * (double)k / (double)n - 1.0, row[TERMS] = {1.0, u, u * u};
        cplx c = {0};
        for (int i = 0; i < TERMS; i++)
            c = cplx_add(c, cplx_scale(row[i], (cplx){a[i * N + TERMS], a[i * N + TERMS + 1]}));
        to[k] = cplx_sub(x[k], cplx_mul((cplx){b->fr[from + k], b->fi[from + k]}, c));
    }
}

void modal_fit_noise(struct modal_fit *f, double width)
{
    for (int s = 0; s < f->data->stretches; s++) {
        struct modal_bins *b = &f->bins[s];
        long patch = (long)(4.0 * 2.0 * REAL_PI * width / b->width); /* what is as wide as a band stays */
        patch = patch > PATCH ? patch : PATCH;
        for (long from = 0, n; from < b->n; from += n) {
            n = from + 2 * patch <= b->n ? patch : b->n - from;
            modal_fit_take_smooth_off(b, from, n, b->rest + from, b->noise + from);
        }
        long half = (long)(0.5 * 2.0 * REAL_PI * width / (b->width * GROUP));
        smooth_power(b->noise, b->n, half > 25 ? half : 25, b->variance);
        for (long k = 0; k < b->n; k++)
            b->variance[k] = fmax(b->variance[k], b->floor[k]);
    }
}

/* What the lead of a recording holds, smooth over 40 Hz, is noise in its other stretches, too. It is seen through a
 * Hann window, a sum over neighbouring bins, as the skirts of its hums are no noise. */
static void floors_of_leads(struct modal_fit *f)
{
    const struct modal_data *d = f->data;
    for (int l = 0; l < d->stretches; l++) {
        struct modal_bins *lead = &f->bins[l];
        if (d->stretch[l].strike >= 0 || lead->n < 100) continue;
        struct arena *a = arena_open();
        double *level = ARENA_TAKE(a, double, lead->n);
        cplx *hann = ARENA_TAKE(a, cplx, lead->n);
        for (long k = 1; k + 1 < lead->n; k++)
            hann[k] = cplx_scale(1.0 / sqrt(1.5),
                                 cplx_sub(lead->y[k], cplx_scale(0.5, cplx_add(lead->y[k - 1], lead->y[k + 1]))));
        smooth_power(hann + 1, lead->n - 2, 6, level + 1);
        level[0] = level[1];
        level[lead->n - 1] = level[lead->n - 2];
        for (int s = 0; s < d->stretches; s++)
            for (long k = 0; d->stretch[s].place == d->stretch[l].place && s != l && k < f->bins[s].n; k++) {
                long i = (long)rint((double)(f->bins[s].first + k) * f->bins[s].width / lead->width) - lead->first;
                i = i < 0 ? 0 : i < lead->n ? i : lead->n - 1;
                f->bins[s].scale[k] = fmax(f->bins[s].floor[k], level[i]);
                f->bins[s].floor[k] = fmax(f->bins[s].floor[k], 0.7 * level[i]);
            }
        arena_close(a);
    }
}

void modal_fit_open(struct modal_fit *f, const struct modal_data *d, const struct modal_options *o, struct arena *a)
{
    *f = (struct modal_fit){.data = d,
                            .options = o,
                            .a = a,
                            .low = 2.0 * REAL_PI * o->low,
                            .high = 2.0 * REAL_PI * o->high,
                            .typical = {most_moved, modal_converge_stated[1]},
                            .tolerance = 1e-2};
    f->bins = ARENA_TAKE(a, struct modal_bins, d->stretches);
    for (int k = 0; k < d->stretches; k++) {
        open_bins(f, &d->stretch[k], &f->bins[k]);
        if (d->stretch[k].fitted) f->strikes++;
        if (d->stretch[k].fitted) f->longest = fmax(f->longest, (double)d->stretch[k].n / d->rate);
    }
    f->most = (o->most > 50 ? o->most + o->most / 4 : 62) + 10; /* of few that are asked for, the strongest of many */
    f->slowest = 1e-3 / f->longest;
    f->fastest = 1.5 * o->fastest; /* what stands for several fast modes until they are found may be faster than they */
    modal_fit_rest(f);
    floors_of_leads(f);
}

/* ------------------------------------------------------------------ a mode on the bins */

/* H - G of the pole s, and their derivative. */
static void carried(const struct modal_stretch *s, double rate, cplx pole, cplx *value, cplx *slope)
{
    const struct modal_pulse *q = &s->pulse;
    const cplx p = cplx_exp(pole, 1.0 / rate);
    *value = *slope = (cplx){0};
    for (int end = 0; end < 2; end++) { /* what is brought in, less what is carried out */
        long to = end ? s->first + s->n : s->first, n = to - q->at < q->n ? to - q->at : q->n;
        cplx sum = {0}, derivative = {0};
        if (n <= 0) continue;
        for (long k = 0; k < n; k++) {
            derivative = cplx_add(cplx_mul(derivative, p), cplx_scale(1.0 / rate, cplx_mul(sum, p)));
            sum = cplx_mul(sum, p);
            sum.re += q->f[k];
        }
        double t = (double)(to - (q->at + n - 1)) / rate;
        cplx power = cplx_exp(pole, t);
        derivative = cplx_mul(power, cplx_add(derivative, cplx_scale(t, sum)));
        sum = cplx_mul(power, sum);
        *value = end ? cplx_sub(*value, sum) : cplx_add(*value, sum);
        *slope = end ? cplx_sub(*slope, derivative) : cplx_add(*slope, derivative);
    }
}

struct modal_line modal_fit_line(const struct modal_fit *f, int stretch, cplx s)
{
    const struct modal_stretch *st = &f->data->stretch[stretch];
    double rate = f->data->rate, size = 1.0 / sqrt((double)st->n);
    cplx value, slope, p = cplx_exp(s, 1.0 / rate);
    carried(st, rate, s, &value, &slope);
    return (struct modal_line){p, cplx_scale(size, value), cplx_scale(size, slope), 1.0 / rate, 1.0};
}

LANES_CLONES
void modal_fit_half(const struct modal_bins *b, const struct modal_line *l, double sign, long from, long n,
                    double (*x)[MODAL_CHUNK]);
LANES_CLONES
void modal_fit_half(const struct modal_bins *b, const struct modal_line *l, double sign, long from, long n,
                    double (*x)[MODAL_CHUNK])
{
    const double *er = b->er + from, *ei = b->ei + from, *fr = b->fr + from, *fi = b->fi + from;
    const double pr = l->p.re, pi = sign * l->p.im, gr = l->g.re, gi = sign * l->g.im, sr = l->d.re,
                 si = sign * l->d.im, t = l->t, force = l->force;
    double *xr = x[0], *xi = x[1], *dr = x[2], *di = x[3];
#pragma omp simd
    for (long k = 0; k < n; k++) {
        double ur = 1.0 - (pr * er[k] - pi * ei[k]), ui = -(pr * ei[k] + pi * er[k]), q = 1.0 / (ur * ur + ui * ui);
        double nr = force * fr[k] + gr, ni = force * fi[k] + gi, ir = ur * q, ii = -ui * q;
        double vr = nr * ir - ni * ii, vi = nr * ii + ni * ir, wr = t * (1.0 - ur), wi = -t * ui;
        double tr = sr + wr * vr - wi * vi, ti = si + wr * vi + wi * vr;
        xr[k] = vr;
        xi[k] = vi;
        dr[k] = tr * ir - ti * ii;
        di[k] = tr * ii + ti * ir;
    }
}

void modal_fit_basis(const struct modal_bins *b, const struct modal_line *l, long from, long n,
                     double (*x)[MODAL_CHUNK])
{
    modal_fit_half(b, l, 1.0, from, n, x);
    modal_fit_half(b, l, -1.0, from, n, x + 4);
}

/* ------------------------------------------------------------------ components */

void modal_fit_add_line(const struct modal_bins *b, const struct modal_line *line, cplx gain, long from, long n,
                        cplx *to)
{
    double x[8][MODAL_CHUNK];
    cplx g = cplx_scale(0.5, gain);
    for (long done = 0; done < n; done += MODAL_CHUNK) {
        long more = n - done < MODAL_CHUNK ? n - done : MODAL_CHUNK;
        modal_fit_basis(b, line, from + done, more, x);
        for (long k = 0; k < more; k++) {
            to[done + k].re += g.re * (x[0][k] + x[4][k]) - g.im * (x[1][k] - x[5][k]);
            to[done + k].im += g.re * (x[1][k] + x[5][k]) + g.im * (x[0][k] - x[4][k]);
        }
    }
}

/* The state at a strike's pulse that its force makes with a gain of 1. */
static cplx forced(const struct modal_fit *f, const struct modal_pulse *q, cplx pole)
{
    cplx sum = {0}, back = cplx_exp(pole, -1.0 / f->data->rate);
    for (long k = q->n - 1; k >= 0; k--) {
        sum = cplx_mul(sum, back);
        sum.re += q->f[k];
    }
    return sum;
}

/* The gain with which a strike would make what rings on at its pulse; 0 where the force hardly drives the pole. In a
   mode's window the two are alike. */
static cplx ringing_gain(const struct modal_pulse *q, cplx force, cplx rings)
{
    static const double blind = 1e-3; /* of the pulse's momentum */
    double momentum = 0.0;
    for (long k = 0; k < q->n; k++)
        momentum += fabs(q->f[k]);
    return cplx_abs(force) > blind * momentum ? cplx_div(rings, force) : (cplx){0};
}

/* A component from stretch to stretch: what rings on at the first sample of each, of earlier strikes of its place, and
   what rings at its pulse's end (NULL: not wanted). The gains of what rings on, as if the strike had made it, are put
   into (total 1) its own, or taken out (-1). */
static void ring(const struct modal_fit *f, struct modal_part *part, int total, cplx *on, cplx *after)
{
    const struct modal_data *d = f->data;
    on[0] = (cplx){0};
    for (int s = 0; s < d->stretches; s++) {
        const struct modal_stretch *st = &d->stretch[s];
        struct modal_part *p = &part[s];
        cplx force = forced(f, &st->pulse, p->pole),
             rings = cplx_mul(on[s], cplx_exp(p->pole, (double)(st->pulse.at - st->first) / d->rate)),
             extra = ringing_gain(&st->pulse, force, rings);
        if (total < 0) p->gain = cplx_sub(p->gain, extra);
        cplx now = cplx_add(rings, cplx_mul(p->gain, force));
        if (total > 0) p->gain = cplx_add(p->gain, extra);
        if (after) after[s] = now;
        if (s + 1 == d->stretches) break;
        bool next = st[1].place == st->place && st->strike >= 0;
        on[s + 1] = next ? cplx_mul(now, cplx_exp(p->pole, (double)(st[1].first - st->pulse.at) / d->rate)) : (cplx){0};
    }
}

/* What rings on makes x (1 - p^n)/(1 - p e^(-jw)) of a state x at a stretch's first sample. */
void modal_fit_put(struct modal_fit *f, int i, double sign)
{
    const struct modal_data *d = f->data;
    struct modal_part *part = f->part + i * d->stretches;
    cplx on[MODAL_STRETCHES];
    ring(f, part, 0, on, NULL);
    for (int s = 0; s < d->stretches; s++) {
        const struct modal_part *p = &part[s];
        const struct modal_stretch *st = &d->stretch[s];
        struct modal_bins *b = &f->bins[s];
        struct modal_line line = modal_fit_line(f, s, p->pole),
                          free = {line.p, {1.0 / sqrt((double)st->n), 0.0}, {0.0, 0.0}, line.t, 0.0};
        cplx left = cplx_sub(on[s], cplx_mul(on[s], cplx_exp(p->pole, (double)st->n / d->rate)));
        if (cplx_square(p->gain) > 0.0) modal_fit_add_line(b, &line, cplx_scale(sign, p->gain), 0, b->n, b->rest);
        if (st->strike >= 0 && cplx_square(on[s]) > 1e-24 * cplx_square(p->gain))
            modal_fit_add_line(b, &free, cplx_scale(sign, left), 0, b->n, b->rest);
    }
}

void modal_fit_sizes(const struct modal_fit *f, int i, double *size)
{
    cplx on[MODAL_STRETCHES], after[MODAL_STRETCHES];
    ring(f, f->part + i * f->data->stretches, 0, on, after);
    for (int s = 0; s < f->data->stretches; s++)
        size[s] = cplx_abs(after[s]);
}

double modal_fit_lead(const struct modal_fit *f, int stretch, int i, bool noise)
{
    const struct modal_bins *b = &f->bins[stretch];
    cplx s = f->c[i].s;
    double wide = 2.0 * b->width - s.re, sum = 0.0, most = 0.0, at = s.im;
    long from = (long)ceil((s.im - wide) / b->width) - b->first, to = (long)floor((s.im + wide) / b->width) - b->first;
    for (long k = from > 0 ? from : 0; k <= to && k < b->n; k++) {
        double power = cplx_square(b->y[k]);
        sum += noise ? power : power - b->variance[k];
        at = power > most ? (double)(b->first + k) * b->width : at;
        most = fmax(most, power);
    }
    for (int k = 0; k < f->m; k++) {
        double nearer = fabs(s.im - at) - fabs(f->c[k].s.im - at);
        bool slower = -s.re > b->width && f->c[k].s.re > 0.1 * s.re;
        if (nearer > (slower ? -b->width : b->width)) return 0.0;
    }
    return 2.0 * sqrt(fmax(sum, 0.0) / (double)f->data->stretch[stretch].n);
}

void modal_fit_totals(const struct modal_fit *f, int i, struct modal_part *total)
{
    cplx on[MODAL_STRETCHES];
    memcpy(total, f->part + i * f->data->stretches, (size_t)f->data->stretches * sizeof *total);
    ring(f, total, 1, on, NULL);
}

void modal_fit_replace(struct modal_fit *f, int i, cplx pole, const struct modal_part *total)
{
    cplx on[MODAL_STRETCHES];
    struct modal_part *part = f->part + i * f->data->stretches;
    modal_fit_put(f, i, 1.0);
    f->c[i].s = pole;
    memcpy(part, total, (size_t)f->data->stretches * sizeof *total);
    ring(f, part, -1, on, NULL);
    modal_fit_put(f, i, -1.0);
}

void modal_fit_rest(struct modal_fit *f)
{
    for (int s = 0; s < f->data->stretches; s++)
        memcpy(f->bins[s].rest, f->bins[s].y, (size_t)f->bins[s].n * sizeof(cplx));
    for (int i = 0; i < f->m; i++)
        modal_fit_put(f, i, -1.0);
}

void modal_fit_add(struct modal_fit *f, cplx s, const struct modal_part *part)
{
    int stretches = f->data->stretches, i = f->m++;
    if (i == f->room) {
        const struct modal_component *c = f->c;
        const struct modal_part *parts = f->part;
        f->room = i ? 2 * i : 64;
        f->c = ARENA_TAKE(f->a, struct modal_component, f->room);
        f->part = ARENA_TAKE(f->a, struct modal_part, f->room * stretches);
        if (i) memcpy(f->c, c, (size_t)i * sizeof *c);
        if (i) memcpy(f->part, parts, (size_t)(i * stretches) * sizeof *parts);
    }
    f->c[i] = (struct modal_component){s, false, {f->typical[0], f->typical[1]}, 1e9, NAN};
    for (int g = 0; g < stretches; g++)
        f->part[i * stretches + g] = (struct modal_part){{0}, s};
    if (part) modal_fit_replace(f, i, s, part);
}

void modal_fit_drop(struct modal_fit *f, int i)
{
    int stretches = f->data->stretches, after = --f->m - i;
    modal_fit_put(f, i, 1.0);
    memmove(f->c + i, f->c + i + 1, (size_t)after * sizeof *f->c);
    memmove(f->part + i * stretches, f->part + (i + 1) * stretches, (size_t)(after * stretches) * sizeof *f->part);
}
