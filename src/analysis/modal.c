/* From stretches to modes: search from narrow bands to wide ones until nothing comes, fit, elimination, then errors. */
#include "analysis/modal.h"

#include <stdlib.h>
#include <string.h>

#include "analysis/modal_fit.h"
#include "num/fft.h"
#include "num/noise.h"

enum { ROUNDS = 10, DRAWS = 8, SURVIVES = 7, SEARCHED = 2, GAIN_ROUNDS = 8 };

static const double stable = 23.5;   /* chi squared of 4 degrees that a mode must keep under noise drawn anew */
static const double certain = 100.0; /* ... above which all draws do */
static const double step = 300.0;    /* of power, from round to round */
static const double samples = 128.0; /* of a band's envelope in the longest stretch, in the narrowest bands */
static const double model_error[2] = {
    2e-4, 0.05};                 /* of frequency and decay, where there is one strike: stated, not measured */
static const double prior = 3.0; /* strikes that the scatter of all modes together counts as */

long modal_length(long n)
{
    for (n -= n % 2; n >= 64; n -= 2)
        if ((long)fft_good_size((size_t)n) == n) return n;
    return 0;
}

static void note(struct modal_result *r, struct arena *a, const char *text)
{
    r->note = r->note ? arena_format(a, "%s\n%s", r->note, text) : text;
}

/* ------------------------------------------------------------------ search */

/* Round by round down to what is 25 dB weaker than the strongest left, from narrow bands to wide ones: so that a strong
 * fast mode is there before its skirts are taken for slow ones. */
static void search(struct modal_fit *f)
{
    double width = samples / f->longest, least = HUGE_VAL, noise;
    for (int round = 0, came = 1; round < ROUNDS; round++) {
        double power = modal_search_round(f, &noise);
        if ((came <= f->m / 10 && least == 0.0) || f->m >= f->options->most + 10) break;
        least = fmin(power / step, came > f->m / 10 ? least : least / step);
        least = least > noise ? least : 0.0;
        int before = f->m;
        for (double w = width; w < f->data->rate / 3.0; w *= 4.0) {
            int n = modal_search(f, w, least);
            if (n) modal_settle_sweeps(f, 8, 2);
        }
        if (modal_settle_runaways(f)) modal_settle_sweeps(f, 8, 2);
        modal_settle_runaways(f);
        modal_fit_rest(f);
        modal_fit_noise(f, 0.0);
        modal_settle_eliminate(f, modal_settle_limit(f, stable));
        came = f->m - before;
    }
}

/* ------------------------------------------------------------------ stability */

/* The block's data as its modes make it, with noise drawn anew. */
static void redraw(struct modal_block *b, const struct modal_block *was, double noise, uint64_t row, struct noise n)
{
    const struct modal_fit *f = b->fit;
    for (int s = 0; s < f->data->stretches; s++) {
        long bins = b->to[s] - b->from[s];
        if (bins <= 0) continue;
        struct arena *a = arena_open();
        double *x = ARENA_TAKE(a, double, 2 * bins);
        noise_normal(n, row + (uint64_t)s, (size_t)(2 * bins), x);
        for (long k = 0; k < bins; k++) {
            const struct modal_bins *of = &f->bins[s];
            double size = sqrt(0.5 * noise * of->variance[b->from[s] + k]);
            b->r[s][k] = was->r[s][k] - of->rr[b->from[s] + k] + size * x[2 * k];
            b->r[s][bins + k] = was->r[s][bins + k] - of->ri[b->from[s] + k] + size * x[2 * k + 1];
        }
        arena_close(a);
    }
}

static bool survives(struct modal_fit *f, int i, double limit)
{
    int of[MODAL_BLOCK], n = modal_settle_near(f, i, 8, of), kept = 0;
    struct arena *a = arena_open();
    struct modal_block *was = ARENA_TAKE(a, struct modal_block, 1), *b = ARENA_TAKE(a, struct modal_block, 1);
    struct noise source = noise_make(1, "modes that survive");
    double noise = modal_settle_noise(f, f->s[i]);
    modal_block_open(was, f, n, of, NULL, 0, NULL, a);
    for (int k = 0; k < DRAWS; k++) {
        int at = 0;
        modal_block_open(b, f, n, of, NULL, 0, NULL, a);
        redraw(b, was, noise, (uint64_t)k << 20 | (uint64_t)i << 32, source);
        modal_block_polish(b, 4);
        double chi = b->chi;
        while (b->of[at] != i)
            at++;
        modal_block_drop(b, at);
        modal_block_polish(b, b->m ? 5 : 0);
        kept += (b->chi - chi) / noise >= limit;
    }
    arena_close(a);
    return kept >= SURVIVES;
}

static int drop_unstable(struct modal_fit *f)
{
    double limit = modal_settle_limit(f, stable), sure = modal_settle_limit(f, certain);
    int dropped = 0;
    for (int i = 0; i < f->m;) {
        int near[MODAL_BLOCK], n, others = 0;
        if (f->hum[i] || modal_settle_rise(f, i) > sure || survives(f, i, limit)) {
            i++;
            continue;
        }
        n = modal_settle_near(f, i, 11, near);
        for (int k = 0; k < n; k++)
            if (near[k] != i) near[others++] = near[k] - (near[k] > i);
        modal_fit_drop(f, i);
        if (others) modal_settle_refine(f, others, near, 20);
        dropped++;
    }
    if (dropped) modal_settle(f);
    return dropped;
}

/* ------------------------------------------------------------------ results */

static void order_by_frequency(struct modal_fit *f)
{
    int groups = f->data->groups;
    struct arena *a = arena_open();
    cplx *g = ARENA_TAKE(a, cplx, groups);
    for (int i = 1; i < f->m; i++)
        for (int k = i; k > 0 && f->s[k].im < f->s[k - 1].im; k--) {
            cplx s = f->s[k];
            bool hum = f->hum[k];
            f->s[k] = f->s[k - 1];
            f->s[k - 1] = s;
            f->hum[k] = f->hum[k - 1];
            f->hum[k - 1] = hum;
            memcpy(g, f->gain + k * groups, (size_t)groups * sizeof *g);
            memcpy(f->gain + k * groups, f->gain + (k - 1) * groups, (size_t)groups * sizeof *g);
            memcpy(f->gain + (k - 1) * groups, g, (size_t)groups * sizeof *g);
        }
    arena_close(a);
}

/* What a component makes on all bins of a stretch, times the recording: its part of the energy. */
static double projected(const struct modal_fit *f, int i)
{
    double sum = 0.0;
    for (int s = 0; s < f->data->stretches; s++) {
        const struct modal_bins *b = &f->bins[s];
        struct arena *a = arena_open();
        double *x[8];
        cplx g = cplx_scale(0.5, f->gain[i * f->data->groups + f->data->stretch[s].group]);
        for (int c = 0; c < 8; c++)
            x[c] = ARENA_TAKE(a, double, b->n + 1);
        if (f->data->stretch[s].fitted && f->data->stretch[s].strike >= 0) {
            struct modal_line line = modal_fit_line(f, s, f->s[i], f->hum[i]);
            modal_fit_basis(b, &line, 0, b->n, x);
            for (long k = 0; k < b->n; k++)
                sum += b->yr[k] * (g.re * (x[0][k] + x[4][k]) - g.im * (x[1][k] - x[5][k])) +
                       b->yi[k] * (g.re * (x[1][k] + x[5][k]) + g.im * (x[0][k] - x[4][k]));
        }
        arena_close(a);
    }
    return fmax(sum, 0.0);
}

static void errors(struct modal_fit *f, int i, struct modal_mode *m)
{
    int of[MODAL_BLOCK], n = modal_settle_near(f, i, 16, of), at = 0;
    double se[2], noise = modal_settle_noise(f, f->s[i]);
    struct arena *a = arena_open();
    struct modal_block *b = ARENA_TAKE(a, struct modal_block, 1);
    modal_block_open(b, f, n, of, NULL, 0, NULL, a);
    while (b->of[at] != i)
        at++;
    modal_block_errors(b, at, se, m->gain_se);
    m->frequency_se = sqrt(noise) * se[0] / (2.0 * REAL_PI);
    m->decay_se = sqrt(noise) * se[1] * m->decay;
    for (int g = 0; g < f->data->groups; g++)
        m->gain_se[g] *= sqrt(noise);
    arena_close(a);
}

static int rising(const void *x, const void *y)
{
    double a = *(const double *)x, b = *(const double *)y;
    return (a > b) - (a < b);
}

/* Squares of the poles' deviations (Hz, log of decay), strike by strike; n[i]: how many strikes tell. */
static void scatter(struct modal_fit *f, const struct modal_result *r, const int *of_mode, double (*square)[2], int *n)
{
    const struct modal_data *d = f->data;
    for (int j = 0; j < r->n; j++)
        for (int s = 0; s < d->stretches; s++) {
            if (!d->stretch[s].fitted || d->stretch[s].strike < 0) continue;
            struct arena *a = arena_open();
            struct modal_block *b = ARENA_TAKE(a, struct modal_block, 1);
            bool *only = ARENA_TAKE(a, bool, d->stretches);
            int near[MODAL_BLOCK], m = modal_settle_near(f, of_mode[j], 6, near), at = 0;
            double se[2], *gain_se = ARENA_TAKE(a, double, d->groups);
            only[s] = true;
            modal_block_open(b, f, m, near, NULL, 0, only, a);
            while (b->of[at] != of_mode[j])
                at++;
            if (modal_block_polish(b, 6)) {
                double by[2] = {(b->s[at].im - f->s[of_mode[j]].im) / (2.0 * REAL_PI),
                                real_log(b->s[at].re / f->s[of_mode[j]].re)};
                modal_block_errors(b, at, se, gain_se);
                double noise = sqrt(modal_block_noise(b));
                if (se[1] * noise < 0.5 && fabs(by[1]) < 2.0) {
                    square[j][0] += by[0] * by[0];
                    square[j][1] += by[1] * by[1];
                    n[j]++;
                }
            }
            arena_close(a);
        }
}

/* Standard deviations from strike to strike, each mode's own drawn towards the median of all. */
static void between(struct modal_fit *f, struct modal_result *r, const int *of_mode, int strikes, struct arena *a)
{
    double(*square)[2] = arena_take(a, (size_t)r->n + 1, sizeof *square), *list = ARENA_TAKE(a, double, r->n + 1),
    typical[2] = {0};
    int *n = ARENA_TAKE(a, int, r->n + 1);
    if (strikes > 1) scatter(f, r, of_mode, square, n);
    for (int q = 0; q < 2; q++) {
        int count = 0;
        for (int j = 0; j < r->n; j++)
            if (n[j] > 1)
                list[count++] = square[j][q] / (n[j] - 1) / (q ? 1.0 : r->mode[j].frequency * r->mode[j].frequency);
        qsort(list, (size_t)count, sizeof *list, rising);
        typical[q] = count ? list[count / 2] : model_error[q] * model_error[q];
    }
    for (int j = 0; j < r->n; j++) {
        struct modal_mode *m = &r->mode[j];
        double degrees = n[j] > 1 ? n[j] - 1.0 : 0.0,
               own[2] = {degrees > 0.0 ? square[j][0] : 0.0, degrees > 0.0 ? square[j][1] : 0.0};
        m->frequency_between = sqrt((prior * typical[0] * m->frequency * m->frequency + own[0]) / (prior + degrees));
        m->decay_between = m->decay * sqrt((prior * typical[1] + own[1]) / (prior + degrees));
        if (degrees == 0.0) {
            m->frequency_between =
                sqrt(m->frequency_between * m->frequency_between + m->frequency_se * m->frequency_se);
            m->decay_between = sqrt(m->decay_between * m->decay_between + m->decay_se * m->decay_se);
        }
    }
}

static int by_share(const void *x, const void *y)
{
    const struct modal_mode *a = x, *b = y;
    return a->share != b->share ? (a->share < b->share) - (a->share > b->share)
                                : (a->frequency > b->frequency) - (a->frequency < b->frequency);
}

/* Numbers by falling share; components whose frequencies agree and decays do not are slopes of one mode. */
static void number(struct modal_result *r, int most, struct arena *a)
{
    int left_out = 0, n = 0;
    qsort(r->mode, (size_t)r->n, sizeof *r->mode, by_share);
    r->modes = 0;
    for (int i = 0; i < r->n; i++) {
        struct modal_mode *m = &r->mode[i];
        m->mode = 0;
        for (int k = 0; k < n && !m->mode; k++) {
            struct modal_mode *o = &r->mode[k];
            double se = sqrt(m->frequency_se * m->frequency_se + o->frequency_se * o->frequency_se),
                   ratio = m->decay / o->decay;
            if (fabs(m->frequency - o->frequency) < 3.0 * se && (ratio > 1.5 || ratio < 1.0 / 1.5)) {
                m->mode = o->mode;
                m->slope = 2;
                for (int l = k + 1; l < n; l++)
                    m->slope += r->mode[l].mode == o->mode;
            }
        }
        if (!m->mode && r->modes == most) {
            left_out++;
            continue;
        }
        if (!m->mode) {
            m->mode = ++r->modes;
            m->slope = 1;
        }
        if (m->slope == 2)
            for (int k = 0; k < n; k++)
                if (r->mode[k].mode == m->mode && r->mode[k].slope == 1)
                    note(r, a,
                         arena_format(a, "%.6g Hz decays with two slopes: %.3g/s and %.3g/s", r->mode[k].frequency,
                                      r->mode[k].decay, m->decay));
        r->mode[n++] = *m;
    }
    r->n = n;
    if (left_out) note(r, a, arena_format(a, "%d more modes than the %d strongest were found", left_out, most));
}

/* Sums over a stretch's bins of the rest: its energy, and what of that is not smooth but for the force. */
static void energies(struct modal_fit *f, double (*sum)[2])
{
    modal_fit_noise(f, 0.0);
    for (int s = 0; s < f->data->stretches; s++) {
        const struct modal_bins *b = &f->bins[s];
        sum[s][0] = sum[s][1] = 0.0;
        for (long k = 0; k < b->n; k++) {
            sum[s][0] += b->rr[k] * b->rr[k] + b->ri[k] * b->ri[k];
            sum[s][1] += b->nr[k] * b->nr[k] + b->ni[k] * b->ni[k];
        }
    }
}

/* Of the energy in the band, hums and noise off, what follows the force at once, and of the others what the modes
 * explain. The two are fitted together, so that neither has an energy of its own: what counts is what a fit without
 * modes leaves, and what one with them does. */
static void explain(struct modal_fit *f, struct modal_result *r, struct arena *a)
{
    const struct modal_data *d = f->data;
    double *count = ARENA_TAKE(a, double, d->places);
    double(*without)[2] = arena_take(a, (size_t)d->stretches, sizeof *without),
    (*with)[2] = arena_take(a, (size_t)d->stretches, sizeof *with);
    for (int i = 0; i < f->m; i++)
        if (!f->hum[i]) modal_fit_put(f, i, 1.0);
    energies(f, without);
    modal_fit_rest(f);
    energies(f, with);
    for (int i = 0; i < f->m; i++)
        if (f->hum[i]) modal_fit_put(f, i, 1.0);
    for (int s = 0; s < d->stretches; s++) {
        const struct modal_bins *b = &f->bins[s];
        const struct modal_stretch *st = &d->stretch[s];
        double noise = 0.0, *re = ARENA_TAKE(a, double, st->n / 2 + 1), *im = ARENA_TAKE(a, double, st->n / 2 + 1);
        for (long k = 0; k < b->n; k++) {
            noise += b->variance[k];
            re[b->first + k] = (b->yr[k] - b->rr[k]) / sqrt((double)st->n);
            im[b->first + k] = (b->yi[k] - b->ri[k]) / sqrt((double)st->n);
        }
        double all = without[s][0] - noise, rings = without[s][1] - noise;
        r->direct[s] = all > 0.0 ? (all - fmax(rings, 0.0)) / all : 0.0;
        r->explained[s] = rings > 0.0 ? 1.0 - fmax(with[s][1] - noise, 0.0) / rings : 0.0;
        r->noise[st->place] += 2.0 * noise;
        count[st->place] += (double)st->n;
        r->model[s] = ARENA_TAKE(a, double, st->n);
        struct fft *fft = fft_open((size_t)st->n);
        fft_inverse(fft, re, im, r->model[s]);
        fft_close(fft);
    }
    for (int p = 0; p < d->places; p++)
        r->noise[p] = count[p] > 0.0 ? sqrt(r->noise[p] / count[p]) : 0.0;
}

/* Gains of the stretches in only (NULL: of all that are fitted), poles as they are: by blocks of neighbours in turn. */
static void fit_gains(struct modal_fit *f, const bool *only)
{
    const struct modal_data *d = f->data;
    for (int i = 0; i < GAIN_ROUNDS * f->m; i++) {
        struct arena *a = arena_open();
        struct modal_block *b = ARENA_TAKE(a, struct modal_block, 1);
        int of[MODAL_BLOCK], n = modal_settle_near(f, i % f->m, 12, of);
        modal_block_open(b, f, n, of, NULL, 0, only, a);
        modal_block_gains(b);
        for (int k = 0; k < n; k++)
            modal_fit_replace(f, of[k], f->s[of[k]], b->gain + k * d->groups);
        arena_close(a);
    }
}

/* Gains in the strikes that are not fitted. */
static void predict(struct modal_fit *f)
{
    bool *only = ARENA_TAKE(f->a, bool, f->data->stretches), any = false;
    for (int s = 0; s < f->data->stretches; s++)
        any = (only[s] = !f->data->stretch[s].fitted && f->data->stretch[s].strike >= 0) || any;
    if (any) fit_gains(f, only);
}

/* What does not decay by more than chance is a hum that no lead has told, or what a fit of noise needs. */
static void drop_undamped(struct modal_result *r, struct arena *a)
{
    int kept = 0;
    for (int i = 0; i < r->n; i++)
        if (r->mode[i].decay > 2.0 * r->mode[i].decay_se) r->mode[kept++] = r->mode[i];
    if (kept < r->n)
        note(r, a,
             arena_format(a, "%d component%s that decay%s by no more than chance %s left out", r->n - kept,
                          r->n - kept == 1 ? "" : "s", r->n - kept == 1 ? "s" : "", r->n - kept == 1 ? "is" : "are"));
    r->n = kept;
}

static void report(struct modal_fit *f, struct arena *a, struct modal_result *r)
{
    const struct modal_data *d = f->data;
    int *of_mode = ARENA_TAKE(a, int, f->m + 1), strikes = 0, hums = 0;
    double all = 0.0;
    r->explained = ARENA_TAKE(a, double, d->stretches);
    r->direct = ARENA_TAKE(a, double, d->stretches);
    r->noise = ARENA_TAKE(a, double, d->places);
    r->model = arena_take(a, (size_t)d->stretches, sizeof *r->model);
    order_by_frequency(f);
    predict(f);
    r->mode = ARENA_TAKE(a, struct modal_mode, f->m + 1);
    for (int i = 0; i < f->m; i++) {
        struct modal_mode *m = &r->mode[r->n];
        if (f->hum[i]) {
            hums++;
            continue;
        }
        of_mode[r->n++] = i;
        *m = (struct modal_mode){
            .frequency = f->s[i].im / (2.0 * REAL_PI), .decay = -f->s[i].re, .share = projected(f, i)};
        m->re = ARENA_TAKE(a, double, d->groups);
        m->im = ARENA_TAKE(a, double, d->groups);
        m->gain_se = ARENA_TAKE(a, double, d->groups);
        for (int g = 0; g < d->groups; g++) {
            m->re[g] = -f->gain[i * d->groups + g].im;
            m->im[g] = f->gain[i * d->groups + g].re;
        }
        errors(f, i, m);
        all += m->share;
    }
    for (int j = 0; j < r->n; j++)
        r->mode[j].share /= all > 0.0 ? all : 1.0;
    for (int s = 0; s < d->stretches; s++)
        strikes += d->stretch[s].fitted && d->stretch[s].strike >= 0;
    between(f, r, of_mode, strikes, a);
    drop_undamped(r, a);
    number(r, f->options->most, a);
    explain(f, r, a);
    if (hums)
        note(r, a,
             arena_format(a, "%d line%s that the recording holds before the first strike (hum) %s fitted and taken out",
                          hums, hums == 1 ? "" : "s", hums == 1 ? "is" : "are"));
}

/* The data with the few loudest strikes alone to be fitted: what those do not tell, none does. */
static struct modal_data loudest_of(const struct modal_data *d, struct arena *a)
{
    struct modal_data to = *d;
    struct modal_stretch *list = ARENA_TAKE(a, struct modal_stretch, d->stretches);
    double *energy = ARENA_TAKE(a, double, d->stretches);
    memcpy(list, d->stretch, (size_t)d->stretches * sizeof *list);
    to.stretch = list;
    for (int s = 0; s < d->stretches; s++)
        for (long i = list[s].ringing; i < list[s].n && list[s].fitted; i++)
            energy[s] += list[s].y[i] * list[s].y[i];
    for (int s = 0; s < d->stretches; s++) {
        int louder = 0;
        for (int k = 0; k < d->stretches; k++)
            louder += list[k].place == list[s].place && (energy[k] > energy[s] || (energy[k] == energy[s] && k < s));
        list[s].fitted = list[s].fitted && louder < SEARCHED;
    }
    return to;
}

bool modal_find(const struct modal_data *d, const struct modal_options *o, struct arena *a, struct modal_result *r,
                struct err *e)
{
    struct modal_fit f;
    struct arena *inner = arena_open();
    *r = (struct modal_result){0};
    modal_fit_open(&f, d, o, inner);
    if (f.longest * (o->high - o->low) < 30.0) {
        arena_close(inner);
        return err_set(e, ERR_SCENE, "between %.6g and %.6g Hz there is too little sound to tell modes: %.3g s", o->low,
                       o->high, f.longest);
    }
    modal_fit_noise(&f, 0.0);
    struct modal_data few = loudest_of(d, inner);
    f.data = &few;
    modal_search_hums(&f);
    if (o->spectrogram)
        modal_spectrogram(&f);
    else
        search(&f);
    f.data = d;
    for (int i = 0; i < f.m; i++)
        f.moved[i] = 1e9;
    fit_gains(&f, NULL);
    modal_fit_noise(&f, 0.0);
    if (!o->spectrogram) {
        modal_settle(&f);
        while (drop_unstable(&f) > 0)
            ;
    }
    report(&f, a, r);
    arena_close(inner);
    return true;
}
