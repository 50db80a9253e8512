/* From stretches to modes: search from narrow bands to wide ones until nothing comes, fit, elimination, then errors. */
#include "analysis/modal.h"

#include <gsl/gsl_sort.h>
#include <stdlib.h>
#include <string.h>

#include "analysis/modal_fit.h"
#include "num/fft.h"
#include "num/noise.h"

enum { ROUNDS = 14, DRAWS = 8, SURVIVES = 7, SEARCHED = 2, GAIN_ROUNDS = 4 };

static const double certain = 100.0;  /* chi squared of 4 degrees with which all draws of noise leave a mode */
static const double step = 300.0;     /* of power, from round to round */
static const double least_fall = 0.3; /* nepers in the longest strike, 2.6 dB: less may be none */
static const double level_fall = 0.1; /* of a mode: less is what a tone looks like that began with the strike */
static const double samples = 128.0;  /* of a band's envelope in the longest stretch, in the narrowest bands */

long modal_length(long n)
{
    for (n -= n % 2; n >= 64; n -= 2)
        if ((long)fft_good_size((size_t)n) == n) return n;
    return 0;
}

/* A note about n of them, if there are any: its text behind the number, of one and of several. */
static void note_number(struct modal_result *r, struct arena *a, int n, const char *one, const char *several)
{
    if (n) r->note = arena_line(a, r->note, arena_format(a, "%d %s", n, n == 1 ? one : several));
}

/* ------------------------------------------------------------------ search */

/* Minus twice the log likelihood of what is left, with a noise of its own in every 64 bins of every stretch, and
 * what each component must be worth. What is 25 dB below a power of `least` counts as noise. *left: the power of
 * what is left. */
static double score(struct modal_fit *f, double least, double *left)
{
    enum { PART = 64 };
    double sum = modal_converge_limit(f, modal_converge_leave) * f->m;
    modal_fit_rest(f);
    modal_fit_noise(f, 0.0);
    *left = 0.0;
    for (int s = 0; s < f->data->stretches; s++) {
        const struct modal_bins *b = &f->bins[s];
        if (!f->data->stretch[s].fitted) continue;
        for (long from = 0; from + PART <= b->n; from += PART) {
            double power = 0.0, noise = 1e-290;
            for (long k = from; k < from + PART; k++) {
                power += cplx_square(b->noise[k]);
                noise += least / step * b->scale[k];
            }
            *left += power;
            sum += 2.0 * PART * real_log(power + noise);
        }
    }
    return sum;
}

/* Round by round down to what is 25 dB weaker than the strongest left, from narrow bands to wide ones: so that a strong
 * fast mode is there before its skirts are taken for slow ones. A round that does not gain likelihood is undone, but
 * where there was nothing yet; what is 25 dB weaker than the round looks for is noise to it: a component may stand for
 * several at first, and its skirts reach far. It ends where two rounds down to the noise, as the widths of bands take
 * turns, bring few components and leave most of what was left. */
static void search(struct modal_fit *f)
{
    double width = samples / f->longest, least = HUGE_VAL, noise;
    int room = f->most + MODAL_BLOCK; /* a band brings less than a block */
    struct modal_component *c = ARENA_TAKE(f->a, struct modal_component, room);
    struct modal_part *part = ARENA_TAKE(f->a, struct modal_part, room * f->data->stretches);
    for (int round = 0, came = 1, last = 0; round < ROUNDS && last < 2 && f->m < f->most; round++) {
        double power = modal_search_round(f, &noise);
        least = fmin(power / step, came > f->m / 10 ? least : least / step);
        least = least > noise ? least : 0.0;
        int before = f->m;
        size_t n = (size_t)before, size = n * (size_t)f->data->stretches * sizeof *part;
        double was_left, left, was = score(f, least, &was_left);
        if (n) memcpy(c, f->c, n * sizeof *c);
        if (n) memcpy(part, f->part, size);
        for (double w = round % 2 ? 2.0 * width : width; w < f->data->rate / 3.0; w *= 4.0) {
            if (modal_search(f, w, least)) modal_converge_sweeps(f, 8, 2);
        }
        if (modal_converge_runaways(f)) modal_converge_sweeps(f, 8, 2);
        modal_converge_runaways(f);
        modal_converge_sweeps(f, 16, 4);
        modal_converge_eliminate(f);
        if (score(f, least, &left) >= was && before) {
            f->m = before;
            left = was_left;
            if (n) memcpy(f->c, c, n * sizeof *c);
            if (n) memcpy(f->part, part, size);
            modal_fit_rest(f);
        }
        came = f->m - before;
        bool little = came <= f->m / 4 && left >= 0.5 * was_left;
        last = least == 0.0 && little ? last + 1 : 0;
    }
}

/* ------------------------------------------------------------------ stability */

/* The block's data as its modes make it, with noise drawn anew. */
static void redraw(struct modal_block *b, const struct modal_block *was, uint64_t row, struct noise n)
{
    const struct modal_fit *f = b->fit;
    for (int s = 0; s < f->data->stretches; s++) {
        const struct modal_window *w = &was->window[s];
        const struct modal_bins *of = &f->bins[s];
        long bins = w->to - w->from;
        if (bins <= 0) continue;
        struct arena *a = arena_open();
        double *x = ARENA_TAKE(a, double, 2 * bins);
        noise_normal(n, row + (uint64_t)s, (size_t)(2 * bins), x);
        for (long k = 0; k < bins; k++) {
            double size = sqrt(0.5 * w->noise * of->variance[w->from + k]);
            b->window[s].rest[k] =
                cplx_add(cplx_sub(w->rest[k], of->rest[w->from + k]), cplx_scale(size, (cplx){x[2 * k], x[2 * k + 1]}));
        }
        arena_close(a);
    }
}

static bool survives(struct modal_fit *f, int i, double limit)
{
    int surviving = 0;
    struct arena *a = arena_open();
    struct noise source = noise_make(1, "modes that survive");
    int at;
    struct modal_block *was = modal_converge_open(f, i, 8, &at, a);
    modal_block_polish(was, 0);
    for (int k = 0; k < DRAWS; k++) {
        struct modal_block *b = modal_converge_open(f, i, 8, &at, a);
        redraw(b, was, (uint64_t)k << 20 | (uint64_t)i << 32, source);
        modal_block_polish(b, 4);
        double chi = b->chi;
        modal_block_drop(b, at);
        modal_block_polish(b, 5);
        surviving += b->chi - chi >= limit;
    }
    arena_close(a);
    return surviving >= SURVIVES;
}

static int drop_unstable(struct modal_fit *f)
{
    double limit = modal_converge_limit(f, modal_converge_leave), sure = modal_converge_limit(f, certain);
    int dropped = 0;
    for (int i = 0; i < f->m;)
        if (modal_converge_rise(f, i) > sure || survives(f, i, limit)) {
            i++;
        } else {
            modal_converge_drop(f, i, 11);
            dropped++;
        }
    if (dropped) modal_converge(f);
    return dropped;
}

/* ------------------------------------------------------------------ results */

/* Of the recordings times what is left of them, over the strikes that are fitted. */
static double product(const struct modal_fit *f)
{
    double sum = 0.0;
    for (int s = 0; s < f->data->stretches; s++) {
        const struct modal_bins *b = &f->bins[s];
        for (long k = 0; f->data->stretch[s].fitted && k < b->n; k++)
            sum += b->y[k].re * b->rest[k].re + b->y[k].im * b->rest[k].im;
    }
    return sum;
}

/* A component's part of the recordings' energy. */
static double projected(struct modal_fit *f, int i)
{
    double without = product(f);
    modal_fit_put(f, i, 1.0);
    double with = product(f);
    modal_fit_put(f, i, -1.0);
    return fmax(with - without, 0.0);
}

static void errors(struct modal_fit *f, int i, struct modal_mode *m)
{
    double se[2];
    struct arena *a = arena_open();
    int at;
    struct modal_block *b = modal_converge_open(f, i, 16, &at, a);
    modal_block_errors(b, at, se, m->gain);
    m->frequency_se = se[0] / (2.0 * REAL_PI);
    m->decay_se = se[1] * m->decay;
    arena_close(a);
}

static int by_share(const void *x, const void *y)
{
    const struct modal_mode *a = x, *b = y;
    return a->share != b->share ? (a->share < b->share) - (a->share > b->share)
                                : (a->frequency > b->frequency) - (a->frequency < b->frequency);
}

static bool are_slopes(const struct modal_mode *a, const struct modal_mode *b)
{
    double se = sqrt(a->frequency_se * a->frequency_se + b->frequency_se * b->frequency_se),
           ratio = a->decay > b->decay ? a->decay / b->decay : b->decay / a->decay;
    return fabs(a->frequency - b->frequency) < 3.0 * se && ratio > 1.5;
}

/* Numbers by falling share; components of which each agrees with each in frequency, and with none in decay, are slopes
 * of one mode. */
static void number(struct modal_result *r, struct arena *a)
{
    qsort(r->mode, (size_t)r->n, sizeof *r->mode, by_share);
    char **decays = arena_take(a, (size_t)r->n + 1, sizeof *decays);
    int *slopes = ARENA_TAKE(a, int, r->n + 1), *first = ARENA_TAKE(a, int, r->n + 1);
    for (int i = 0; i < r->n; i++) {
        struct modal_mode *m = &r->mode[i];
        for (int k = 1; k <= r->modes && !m->mode; k++) {
            bool all = true;
            for (int j = 0; j < i; j++)
                all = all && (r->mode[j].mode != k || are_slopes(m, &r->mode[j]));
            if (all) m->mode = k;
        }
        if (!m->mode) first[m->mode = ++r->modes] = i;
        m->slope = ++slopes[m->mode];
        decays[m->mode] =
            arena_format(a, m->slope == 1 ? "%s%.3g/s" : "%s, %.3g/s", m->slope == 1 ? "" : decays[m->mode], m->decay);
    }
    for (int k = 1; k <= r->modes; k++)
        if (slopes[k] > 1)
            r->note = arena_line(a, r->note,
                                 arena_format(a, "%.6g Hz decays with %s slopes: %s", r->mode[first[k]].frequency,
                                              slopes[k] == 2 ? "two" : arena_format(a, "%d", slopes[k]), decays[k]));
}

struct energies {               /* of a stretch's rest */
    double all, ringing, noise; /* ringing: what does not follow the force at once */
};

static void energies(struct modal_fit *f, struct energies *to)
{
    modal_fit_noise(f, 0.0);
    for (int s = 0; s < f->data->stretches; s++) {
        const struct modal_bins *b = &f->bins[s];
        to[s] = (struct energies){0};
        for (long k = 0; k < b->n; k++) {
            to[s].all += cplx_square(b->rest[k]);
            to[s].ringing += cplx_square(b->noise[k]);
            to[s].noise += b->variance[k];
        }
    }
}

/* Of the energy in the band, hums and noise off, what follows the force at once (direct; NULL: not wanted), and of the
 * others what the modes explain. What follows the force is fitted together with them, so that neither has an energy of
 * its own: what counts is what is left with modes and without. */
static void explain(struct modal_fit *f, double *explained, double *direct)
{
    struct energies none[MODAL_STRETCHES], fit[MODAL_STRETCHES];
    for (int i = 0; i < f->m; i++)
        if (!f->c[i].hum) modal_fit_put(f, i, 1.0);
    energies(f, none);
    modal_fit_rest(f);
    energies(f, fit);
    for (int s = 0; s < f->data->stretches; s++) {
        double all = none[s].all - fit[s].noise, rings = none[s].ringing - fit[s].noise;
        if (direct) direct[s] = all > 0.0 ? (all - fmax(rings, 0.0)) / all : 0.0;
        explained[s] = rings > 0.0 ? 1.0 - fmax(fit[s].ringing - fit[s].noise, 0.0) / rings : 0.0;
    }
}

/* The modes' sound, and the noise of each place. */
static void sounds(struct modal_fit *f, struct modal_result *r, struct arena *a)
{
    const struct modal_data *d = f->data;
    double *count = ARENA_TAKE(a, double, d->places);
    for (int i = 0; i < f->m; i++)
        if (f->c[i].hum) modal_fit_put(f, i, 1.0);
    for (int s = 0; s < d->stretches; s++) {
        bool counts = d->stretch[s].fitted || d->stretch[s].strike < 0;
        const struct modal_bins *b = &f->bins[s];
        const struct modal_stretch *st = &d->stretch[s];
        double *re = ARENA_TAKE(a, double, st->n / 2 + 1), *im = ARENA_TAKE(a, double, st->n / 2 + 1);
        for (long k = 0; k < b->n; k++) {
            re[b->first + k] = (b->y[k].re - b->rest[k].re) / sqrt((double)st->n);
            im[b->first + k] = (b->y[k].im - b->rest[k].im) / sqrt((double)st->n);
            r->noise[st->place] += counts ? 2.0 * b->variance[k] : 0.0;
        }
        count[st->place] += counts ? (double)st->n : 0.0;
        r->model[s] = ARENA_TAKE(a, double, st->n);
        struct fft *fft = fft_open((size_t)st->n);
        fft_inverse(fft, re, im, r->model[s]);
        fft_close(fft);
    }
    for (int p = 0; p < d->places; p++)
        r->noise[p] = count[p] > 0.0 ? sqrt(r->noise[p] / count[p]) : 0.0;
}

/* Gains, poles as they are: by blocks of neighbours in turn. */
static void fit_gains(struct modal_fit *f)
{
    const struct modal_data *d = f->data;
    for (int i = 0; i < GAIN_ROUNDS * f->m; i++) {
        struct arena *a = arena_open();
        int of[MODAL_BLOCK], n = modal_converge_near(f, i % f->m, 12, of);
        struct modal_block *b = modal_block_open(f, n, of, NULL, 0, a);
        modal_block_polish(b, 0);
        for (int k = 0; k < n; k++)
            modal_fit_replace(f, of[k], f->c[of[k]].s, b->part + k * d->stretches);
        arena_close(a);
    }
}

static double fast(struct modal_fit *f, int i) { return -f->c[i].s.re > f->options->fastest ? f->c[i].s.re : HUGE_VAL; }

/* Is it a hum? A hum is before the first strike at least half as loud as after most strikes. What does not decay may
   hide in the noise there, which then counts as part of it. Where the recording begins with a strike, a hum is what
   does not decay and is as loud in all strikes, within 12 dB. */
static bool is_hum(const struct modal_fit *f, int i, bool undamped)
{
    double size[MODAL_STRETCHES], of[MODAL_STRETCHES], lead = 0.0;
    bool before = false;
    int n = 0;
    modal_fit_sizes(f, i, size);
    for (int s = 0; s < f->data->stretches; s++) {
        if (f->data->stretch[s].fitted) of[n++] = size[s];
        before = before || f->data->stretch[s].strike < 0;
        if (f->data->stretch[s].strike < 0) lead = fmax(lead, modal_fit_lead(f, s, i, undamped));
    }
    gsl_sort(of, 1, (size_t)n);
    return before ? lead > 0.5 * of[n / 2] : undamped && of[n - 1] < 4.0 * of[0];
}

/* What does not decay by more than chance, or has no gain of more, is no mode: a hum, which stays in the fit, or what a
   fit of noise needs. Of those the weakest goes first, the others fitted anew: they may decay without it. What is
   certain, and no hum, stays: it rings longer than the recording shows. */
static double uncertain(struct modal_fit *f, int i)
{
    struct modal_gain gain[MODAL_STRETCHES];
    struct modal_mode m = {.decay = -f->c[i].s.re, .gain = gain};
    if (f->c[i].hum) return HUGE_VAL;
    errors(f, i, &m);
    bool slow = m.decay < 2.0 / f->longest, gains = false,
         undamped = slow ? m.decay <= 2.0 * fmax(m.decay_se, f->slowest) : m.decay <= m.decay_se;
    for (int s = 0; s < f->data->stretches; s++)
        gains =
            gains || (f->data->stretch[s].fitted && cplx_abs(f->part[i * f->data->stretches + s].gain) > gain[s].se);
    f->c[i].hum = is_hum(f, i, slow && undamped);
    bool struck = undamped && gains && modal_converge_rise(f, i) > modal_converge_limit(f, certain);
    return f->c[i].hum || struck || (!undamped && gains) ? HUGE_VAL : projected(f, i);
}

/* A mode whose decay is not known from 0, and which falls by less than 2.6 dB in the longest strike, gets the decay
   that falls by as much. Returns how many such modes there are. */
static int set_least_decay(struct modal_fit *f)
{
    int changed = 0;
    double least = least_fall / f->longest;
    for (int i = 0; i < f->m; i++) {
        struct modal_part total[MODAL_STRETCHES];
        struct modal_gain gain[MODAL_STRETCHES];
        struct modal_mode m = {.decay = -f->c[i].s.re, .gain = gain};
        if (f->c[i].hum || m.decay >= least) continue;
        errors(f, i, &m);
        if (m.decay > 2.0 * m.decay_se) continue;
        modal_fit_totals(f, i, total);
        for (int s = 0; s < f->data->stretches; s++)
            total[s].pole.re = fmin(total[s].pole.re, -least);
        modal_fit_replace(f, i, (cplx){-least, f->c[i].s.im}, total);
        changed++;
    }
    if (changed) fit_gains(f);
    return changed;
}

/* The weakest beyond those that are wanted. */
static double surplus(struct modal_fit *f, int i)
{
    int modes = 0;
    for (int k = 0; k < f->m; k++)
        modes += !f->c[k].hum;
    return f->c[i].hum || modes <= f->options->most ? HUGE_VAL : projected(f, i);
}

static void report(struct modal_fit *f, struct arena *a, struct modal_result *r)
{
    const struct modal_data *d = f->data;
    double all = 0.0;
    r->undamped = 0;
    r->noise = ARENA_TAKE(a, double, d->places);
    r->model = arena_take(a, (size_t)d->stretches, sizeof *r->model);
    r->mode = ARENA_TAKE(a, struct modal_mode, f->m + 1);
    for (int i = 0; i < f->m; i++) {
        struct modal_mode *m = &r->mode[r->n];
        if (f->c[i].hum) {
            r->undamped++;
            continue;
        }
        r->n++;
        *m = (struct modal_mode){.component = i,
                                 .frequency = f->c[i].s.im / (2.0 * REAL_PI),
                                 .decay = -f->c[i].s.re,
                                 .share = projected(f, i)};
        m->gain = ARENA_TAKE(a, struct modal_gain, d->stretches);
        errors(f, i, m);
        for (int g = 0; g < d->stretches; g++) {
            cplx gain = f->part[i * d->stretches + g].gain;
            m->gain[g].a = (cplx){-gain.im, gain.re};
        }
        all += m->share;
    }
    for (int j = 0; j < r->n; j++)
        r->mode[j].share /= all > 0.0 ? all : 1.0;
    modal_converge_spread(f);
    for (int j = 0; j < r->n; j++) { /* a strike's noise is between strikes, too */
        struct modal_mode *m = &r->mode[j];
        const double *spread = f->c[m->component].spread;
        m->frequency_between =
            sqrt(spread[0] * spread[0] * m->frequency * m->frequency + f->strikes * m->frequency_se * m->frequency_se);
        m->decay_between = sqrt(spread[1] * spread[1] * m->decay * m->decay + f->strikes * m->decay_se * m->decay_se);
    }
    number(r, a);
    explain(f, r->explained, NULL);
    sounds(f, r, a);
    note_number(r, a, r->undamped, "line does not decay (hum) and is left out",
                "lines do not decay (hum) and are left out");
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
        list[s].idle = !list[s].fitted;
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
    if (o->spectrogram)
        modal_spectrogram(&f);
    else
        search(&f);
    f.data = d;
    f.found = true;
    for (int i = 0; i < f.m; i++)
        f.c[i].moved = 1e9;
    fit_gains(&f);
    modal_fit_noise(&f, 0.0);
    if (!o->spectrogram) {
        modal_converge_sweeps(&f, 8, 2);
        modal_converge_spread(&f);
        modal_converge(&f);
        while (drop_unstable(&f) > 0)
            ;
    }
    int too_fast = modal_converge_drop_least(&f, fast, 9), chance = 0;
    for (int n = 1; n; chance += n) {
        n = modal_converge_drop_least(&f, uncertain, 9);
        if (n) modal_converge_sweeps(&f, 8, 4);
    }
    int longer = set_least_decay(&f);
    r->explained = ARENA_TAKE(a, double, d->stretches);
    r->fitted = ARENA_TAKE(a, double, d->stretches);
    r->direct = ARENA_TAKE(a, double, d->stretches);
    explain(&f, r->fitted, r->direct);
    int more = modal_converge_drop_least(&f, surplus, 9);
    report(&f, a, r);
    note_number(r, a, too_fast,
                arena_format(a, "component that decays faster than %.4g/s is left out (--fastest)", o->fastest),
                arena_format(a, "components that decay faster than %.4g/s are left out (--fastest)", o->fastest));
    note_number(r, a, chance, "component is left out, whose decay or gain may be chance",
                "components are left out, whose decays or gains may be chance");
    note_number(r, a, longer,
                arena_format(a, "mode rings longer than the strikes show: its decay is taken as %.3g/s",
                             least_fall / f.longest),
                arena_format(a, "modes ring longer than the strikes show: their decay is taken as %.3g/s",
                             least_fall / f.longest));
    int level = 0;
    for (int j = 0; j < r->n; j++)
        level += r->mode[j].decay < level_fall / f.longest;
    note_number(r, a, level,
                "mode falls by less than 0.9 dB in the longest strike: a tone that began with the strike would look "
                "like it; record for longer",
                "modes fall by less than 0.9 dB in the longest strike: tones that began with the strike would look "
                "like them; record for longer");
    note_number(r, a, more, arena_format(a, "more mode than the %d strongest was found", o->most),
                arena_format(a, "more modes than the %d strongest were found", o->most));
    arena_close(inner);
    return true;
}

void modal_gains(const struct modal_data *d, const struct modal_options *o, int n, const cplx *pole, cplx *gain)
{
    struct modal_fit f;
    struct arena *a = arena_open();
    modal_fit_open(&f, d, o, a);
    f.found = true;
    for (int i = 0; i < n; i++)
        modal_fit_add(&f, pole[i], NULL);
    for (int round = 0; round < 2; round++) { /* noise of what is left of the first */
        modal_fit_noise(&f, 0.0);
        fit_gains(&f);
    }
    for (int i = 0; i < n * d->stretches; i++)
        gain[i] = (cplx){-f.part[i].gain.im, f.part[i].gain.re};
    arena_close(a);
}
