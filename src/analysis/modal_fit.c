/* Stretches on their DFT bins, and a mode's sound on them (modal_fit.h has the equations). */
#include <gsl/gsl_movstat.h>
#include <string.h>

#include "analysis/modal_fit.h"
#include "num/fft.h"
#include "num/lanes.h"

enum { GROUP = 8, CHUNK = 256, PATCH = 256 };

static const double quietest = 1e-9; /* of a stretch's rms: no noise of a bin is less, as phases are not known better */

/* ------------------------------------------------------------------ spectra */

static void spectrum(const double *x, long n, const struct modal_bins *b, double *re, double *im)
{
    struct arena *a = arena_open();
    struct fft *fft = fft_open((size_t)n);
    double *all[2] = {ARENA_TAKE(a, double, n / 2 + 1), ARENA_TAKE(a, double, n / 2 + 1)}, size = 1.0 / sqrt((double)n);
    fft_forward(fft, x, all[0], all[1]);
    for (long k = 0; k < b->n; k++) {
        re[k] = size * all[0][b->first + k];
        im[k] = size * all[1][b->first + k];
    }
    fft_close(fft);
    arena_close(a);
}

static void open_bins(const struct modal_fit *f, const struct modal_stretch *s, struct modal_bins *b)
{
    double rate = f->data->rate, *force = ARENA_TAKE(f->a, double, s->n), sum = 0.0;
    b->width = 2.0 * REAL_PI * rate / (double)s->n;
    b->first = (long)ceil(f->low / b->width);
    b->first = b->first > 1 ? b->first : 1;
    b->n = (long)floor(f->high / b->width) - b->first + 1;
    b->n = b->first + b->n > s->n / 2 ? s->n / 2 - b->first : b->n;
    b->n = b->n > 0 ? b->n : 0;
    double **to[] = {&b->er, &b->ei,       &b->fr,    &b->fi,    &b->yr, &b->yi, &b->rr,
                     &b->ri, &b->variance, &b->floor, &b->scale, &b->nr, &b->ni};
    for (size_t i = 0; i < sizeof to / sizeof *to; i++)
        *to[i] = ARENA_TAKE(f->a, double, b->n + 1);
    for (long k = 0; k < b->n; k++) {
        double turn = 2.0 * (double)(b->first + k) / (double)s->n;
        b->er[k] = real_cospi(turn);
        b->ei[k] = -real_sinpi(turn);
    }
    for (long i = 0; i < s->pulse.n; i++)
        if (s->pulse.at + i >= s->first && s->pulse.at + i < s->first + s->n)
            force[s->pulse.at + i - s->first] = s->pulse.f[i];
    spectrum(force, s->n, b, b->fr, b->fi);
    spectrum(s->y, s->n, b, b->yr, b->yi);
    for (long i = 0; i < s->n; i++)
        sum += s->y[i] * s->y[i] / (double)s->n;
    double rounding = f->data->rounding ? f->data->rounding[s->place] : 0.0;
    for (long k = 0; k < b->n; k++)
        b->floor[k] = fmax(fmax(quietest * quietest * sum, rounding * rounding), 1e-290);
    for (long k = 0; k < b->n; k++)
        b->scale[k] = 1.0;
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
static void smooth_power(const double *re, const double *im, long n, long half, double *to)
{
    struct arena *a = arena_open();
    long groups = n / GROUP;
    if (groups < 1) groups = 1;
    double *mean = ARENA_TAKE(a, double, groups), *median = ARENA_TAKE(a, double, groups);
    for (long k = 0; k < groups; k++) {
        long count = 0;
        for (long i = k * GROUP; i < (k + 1) * GROUP && i < n; i++, count++)
            mean[k] += re[i] * re[i] + im[i] * im[i];
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

void modal_fit_take_smooth_off(const struct modal_bins *b, long from, long n, const double *re, const double *im,
                               double *to_re, double *to_im)
{
    enum { TERMS = 3, N = TERMS + 2 };
    const double *fr = b->fr + from, *fi = b->fi + from;
    double a[N * N] = {0}, scale[TERMS];
    bool swept[TERMS];
    for (long k = 0; k < n; k++) {
        double power = fr[k] * fr[k] + fi[k] * fi[k], u = 2.0 * (double)k / (double)n - 1.0,
               row[TERMS] = {1.0, u, u * u};
        for (int i = 0; i < TERMS; i++) {
            for (int j = 0; j < TERMS; j++)
                a[i * N + j] += power * row[i] * row[j];
            a[i * N + TERMS] += row[i] * (fr[k] * re[k] + fi[k] * im[k]);
            a[i * N + TERMS + 1] += row[i] * (fr[k] * im[k] - fi[k] * re[k]);
        }
    }
    for (int i = 0; i < TERMS; i++)
        scale[i] = a[i * N + i];
    modal_block_sweep(a, N, 0, TERMS, scale, swept);
    for (long k = 0; k < n; k++) {
        double u = 2.0 * (double)k / (double)n - 1.0, row[TERMS] = {1.0, u, u * u};
        cplx c = {0};
        for (int i = 0; i < TERMS; i++)
            if (swept[i]) c = cplx_add(c, cplx_scale(row[i], (cplx){a[i * N + TERMS], a[i * N + TERMS + 1]}));
        to_re[k] = re[k] - (fr[k] * c.re - fi[k] * c.im);
        to_im[k] = im[k] - (fr[k] * c.im + fi[k] * c.re);
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
            modal_fit_take_smooth_off(b, from, n, b->rr + from, b->ri + from, b->nr + from, b->ni + from);
        }
        long half = (long)(0.5 * 2.0 * REAL_PI * width / (b->width * GROUP));
        smooth_power(b->nr, b->ni, b->n, half > 25 ? half : 25, b->variance);
        for (long k = 0; k < b->n; k++)
            b->variance[k] = fmax(b->variance[k], b->floor[k]);
    }
}

/* What the lead of a recording holds, smooth over 40 Hz, is noise in its other stretches, too. */
static void floors_of_leads(struct modal_fit *f)
{
    const struct modal_data *d = f->data;
    for (int l = 0; l < d->stretches; l++) {
        struct modal_bins *lead = &f->bins[l];
        if (d->stretch[l].strike >= 0 || lead->n < 100) continue;
        struct arena *a = arena_open();
        double *level = ARENA_TAKE(a, double, lead->n);
        smooth_power(lead->yr, lead->yi, lead->n, 6, level);
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
                            .typical = {modal_spread_stated[0], modal_spread_stated[1]},
                            .tolerance = 1e-2};
    f->bins = ARENA_TAKE(a, struct modal_bins, d->stretches);
    for (int k = 0; k < d->stretches; k++) {
        open_bins(f, &d->stretch[k], &f->bins[k]);
        if (d->stretch[k].fitted) f->strikes++;
        if (d->stretch[k].fitted) f->longest = fmax(f->longest, (double)d->stretch[k].n / d->rate);
    }
    f->most = o->most + o->most / 4 + 10;
    f->slowest = 0.02 / f->longest;
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
    return (struct modal_line){p.re,       p.im, size * value.re, size * value.im, size * slope.re, size * slope.im,
                               1.0 / rate, 1.0};
}

LANES_CLONES
void modal_fit_half(const struct modal_bins *b, const struct modal_line *l, double sign, long from, long n,
                    double *const x[4]);
LANES_CLONES
void modal_fit_half(const struct modal_bins *b, const struct modal_line *l, double sign, long from, long n,
                    double *const x[4])
{
    const double *er = b->er + from, *ei = b->ei + from, *fr = b->fr + from, *fi = b->fi + from;
    const double pr = l->pr, pi = sign * l->pi, gr = l->gr, gi = sign * l->gi, sr = l->dr, si = sign * l->di, t = l->t,
                 force = l->force;
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

void modal_fit_basis(const struct modal_bins *b, const struct modal_line *l, long from, long to, double *const x[8])
{
    modal_fit_half(b, l, 1.0, from, to - from, x);
    modal_fit_half(b, l, -1.0, from, to - from, x + 4);
}

/* ------------------------------------------------------------------ components */

void modal_fit_add_line(const struct modal_bins *b, const struct modal_line *line, cplx gain, long from, long to,
                        double *re, double *im)
{
    double room[8][CHUNK], *x[8];
    cplx g = cplx_scale(0.5, gain);
    for (int c = 0; c < 8; c++)
        x[c] = room[c];
    for (long n; from < to; from += n, re += n, im += n) {
        n = from + CHUNK < to ? CHUNK : to - from;
        modal_fit_basis(b, line, from, from + n, x);
        for (long k = 0; k < n; k++) {
            re[k] += g.re * (x[0][k] + x[4][k]) - g.im * (x[1][k] - x[5][k]);
            im[k] += g.re * (x[1][k] + x[5][k]) + g.im * (x[0][k] - x[4][k]);
        }
    }
}

static void add_to_rest(struct modal_bins *b, const struct modal_line *line, cplx gain)
{
    modal_fit_add_line(b, line, gain, 0, b->n, b->rr, b->ri);
}

/* What rings on into a stretch: the state x that earlier strikes of its place have left at its first sample makes x (1
 * - p^n)/(1 - p e^(-jw)). */
static void add_ringing(const struct modal_fit *f, int s, cplx pole, cplx state, double sign)
{
    const struct modal_stretch *st = &f->data->stretch[s];
    double rate = f->data->rate, size = 1.0 / sqrt((double)st->n);
    cplx p = cplx_exp(pole, 1.0 / rate), left = cplx_sub(state, cplx_mul(state, cplx_exp(pole, (double)st->n / rate)));
    struct modal_line line = {p.re, p.im, size, 0.0, 0.0, 0.0, 1.0 / rate, 0.0};
    add_to_rest(&f->bins[s], &line, cplx_scale(sign, left));
}

/* The state at a strike's pulse that its force makes with a gain of 1, and how a state grows from the stretch's first
 * sample to there. */
static cplx forced(const struct modal_fit *f, const struct modal_stretch *st, cplx pole, cplx *grown)
{
    cplx sum = {0}, back = cplx_exp(pole, -1.0 / f->data->rate);
    for (long k = st->pulse.n - 1; k >= 0; k--) {
        sum = cplx_mul(sum, back);
        sum.re += st->pulse.f[k];
    }
    *grown = cplx_exp(pole, (double)(st->pulse.at - st->first) / f->data->rate);
    return sum;
}

/* What rings from strike s on, `after` at its pulse, at the first sample of the next stretch of its place; 0: there is
 * none. */
static cplx rings_on(const struct modal_fit *f, int s, cplx pole, cplx after)
{
    const struct modal_stretch *st = &f->data->stretch[s];
    bool next = s + 1 < f->data->stretches && st[1].place == st->place && st->strike >= 0;
    return next ? cplx_mul(after, cplx_exp(pole, (double)(st[1].first - st->pulse.at) / f->data->rate)) : (cplx){0};
}

/* state[stretches] at their first samples, of what earlier strikes have left. */
static void states(const struct modal_fit *f, int i, cplx *state)
{
    const struct modal_data *d = f->data;
    state[0] = (cplx){0};
    for (int s = 0; s + 1 < d->stretches; s++) {
        const struct modal_part *p = &f->part[i * d->stretches + s];
        cplx grown, force = forced(f, &d->stretch[s], p->pole, &grown);
        state[s + 1] = rings_on(f, s, p->pole, cplx_add(cplx_mul(state[s], grown), cplx_mul(p->gain, force)));
    }
}

void modal_fit_put(struct modal_fit *f, int i, double sign)
{
    const struct modal_data *d = f->data;
    cplx state[MODAL_STRETCHES];
    states(f, i, state);
    for (int s = 0; s < d->stretches; s++) {
        const struct modal_part *p = &f->part[i * d->stretches + s];
        struct modal_line line = modal_fit_line(f, s, p->pole);
        if (cplx_square(p->gain) > 0.0) add_to_rest(&f->bins[s], &line, cplx_scale(sign, p->gain));
        if (d->stretch[s].strike >= 0 && cplx_square(state[s]) > 1e-24 * cplx_square(p->gain))
            add_ringing(f, s, p->pole, state[s], sign);
    }
}

/* The gain with which strike s would make what rings on at its pulse from the state at the stretch's first sample; 0
   where the force hardly drives the pole. In a mode's window the two are alike. */
static cplx ringing_gain(const struct modal_fit *f, int s, cplx pole, cplx state)
{
    static const double blind = 1e-3; /* of the pulse's momentum */
    const struct modal_stretch *st = &f->data->stretch[s];
    cplx grown, force = forced(f, st, pole, &grown);
    double momentum = 0.0;
    for (long k = 0; k < st->pulse.n; k++)
        momentum += fabs(st->pulse.f[k]);
    return st->strike >= 0 && cplx_abs(force) > blind * momentum ? cplx_div(cplx_mul(state, grown), force) : (cplx){0};
}

void modal_fit_sizes(const struct modal_fit *f, int i, double *size)
{
    const struct modal_data *d = f->data;
    cplx state[MODAL_STRETCHES];
    states(f, i, state);
    for (int s = 0; s < d->stretches; s++) {
        const struct modal_part *p = &f->part[i * d->stretches + s];
        cplx grown, force = forced(f, &d->stretch[s], p->pole, &grown);
        size[s] = cplx_abs(cplx_add(cplx_mul(state[s], grown), cplx_mul(p->gain, force)));
    }
}

double modal_fit_lead(const struct modal_fit *f, int stretch, cplx s)
{
    const struct modal_bins *b = &f->bins[stretch];
    double wide = 2.0 * b->width - s.re, sum = 0.0;
    long from = (long)ceil((s.im - wide) / b->width) - b->first, to = (long)floor((s.im + wide) / b->width) - b->first;
    for (long k = from > 0 ? from : 0; k <= to && k < b->n; k++)
        sum += b->yr[k] * b->yr[k] + b->yi[k] * b->yi[k] - b->variance[k];
    return 2.0 * sqrt(fmax(sum, 0.0) / (double)f->data->stretch[stretch].n);
}

void modal_fit_totals(const struct modal_fit *f, int i, struct modal_part *total)
{
    const struct modal_data *d = f->data;
    cplx state[MODAL_STRETCHES];
    states(f, i, state);
    memcpy(total, f->part + i * d->stretches, (size_t)d->stretches * sizeof *total);
    for (int s = 0; s < d->stretches; s++) {
        struct modal_part *p = &total[s];
        p->gain = cplx_add(p->gain, ringing_gain(f, s, p->pole, state[s]));
    }
}

void modal_fit_replace(struct modal_fit *f, int i, cplx pole, const struct modal_part *total)
{
    const struct modal_data *d = f->data;
    struct modal_part *mine = f->part + i * d->stretches;
    cplx state = {0};
    modal_fit_put(f, i, 1.0);
    f->c[i].s = pole;
    memcpy(mine, total, (size_t)d->stretches * sizeof *total);
    for (int s = 0; s < d->stretches; s++) {
        struct modal_part *p = &mine[s];
        cplx grown, force = forced(f, &d->stretch[s], p->pole, &grown);
        p->gain = cplx_sub(p->gain, ringing_gain(f, s, p->pole, state));
        state = rings_on(f, s, p->pole, cplx_add(cplx_mul(state, grown), cplx_mul(p->gain, force)));
    }
    modal_fit_put(f, i, -1.0);
}

void modal_fit_rest(struct modal_fit *f)
{
    for (int s = 0; s < f->data->stretches; s++) {
        memcpy(f->bins[s].rr, f->bins[s].yr, (size_t)f->bins[s].n * sizeof(double));
        memcpy(f->bins[s].ri, f->bins[s].yi, (size_t)f->bins[s].n * sizeof(double));
    }
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
    f->c[i] = (struct modal_component){s, false, {f->typical[0], f->typical[1]}, 1e9};
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
