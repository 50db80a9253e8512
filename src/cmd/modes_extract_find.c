/* From recordings to modes: strikes, the stretches that are fitted, the fit, and what it explains.

   With a force a stretch begins just before its strike, and what rings on from earlier strikes is carried into it
   (analysis/modal_fit.h). Without one it begins a millisecond after the strike, when a hard hammer has left, and has
   gains of its own, which are taken back to the strike by e^(-s t). */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "analysis/modal_complex.h"
#include "cmd/modes_extract.h"
#include "num/fft.h"
#include "num/real.h"

static const double before = 4e-4;     /* s of a stretch before its force */
static const double past = 1e-3;       /* s after a strike without force: the hammer has left */
static const double shortest = 0.01;   /* s of sound that a stretch needs */
static const double lead_least = 0.05; /* s of silence before the first strike that tell the noise */
static const double reach = 1e-4;      /* of the force's greatest power: what lies below is noise */
static const double half = 0.5;        /* of a strike's energy: modes that explain less are not its own */
static const double enough = 0.9;      /* of all strikes' */
static const double single = 0.7;      /* of a mode's energy in all strikes: less than that is in any of them */
static const double much = 0.2;        /* of the energy: what follows the force at once is reported */
static const double fastest[2] = {600.0, 0.05}; /* 1/s, and of the rate: what decays faster than the less of the two is
                                                   no mode unless one asks for it */
static const double slow = 300.0;               /* 1/s, of decays that the median by energy is about */

void modes_extract_find_note(struct modes_extract *x, const char *text)
{
    for (const char *line = text; line && *line; line = strchr(line, '\n') ? strchr(line, '\n') + 1 : NULL) {
        const char *one = arena_format(x->arena, "%.*s", (int)strcspn(line, "\n"), line);
        bool known = false;
        for (int k = 0; k < x->notes; k++)
            known = known || !strcmp(x->note[k], one);
        if (!known && x->notes < MODES_EXTRACT_NOTES) x->note[x->notes++] = one;
    }
}

static void place_note(struct modes_extract *x, const struct modes_extract_place *p, const char *text)
{
    for (const char *line = text; line && *line; line = strchr(line, '\n') ? strchr(line, '\n') + 1 : NULL)
        modes_extract_find_note(x, arena_format(x->arena, "%s: %.*s", p->name, (int)strcspn(line, "\n"), line));
}

/* ------------------------------------------------------------------ strikes */

/* Samples before a response begins: what rises from the hundredth to the fifth of its greatest within 16 samples begins
 * there, if all before is fainter. One more stays, as sample 0. */
static long begins(const double *h, long n, double most)
{
    long at = 0, start, quiet = 0;
    while (at < n && fabs(h[at]) < 0.2 * most)
        at++;
    for (start = at; start > 0 && fabs(h[start - 1]) >= 0.01 * most;)
        start--;
    while (quiet < start && fabs(h[quiet]) < 0.01 * most)
        quiet++;
    return quiet == start && start > 2 && at - start <= 16 ? start - 1 : 0;
}

/* A recording that is a response already: its delay is taken off; if none is given, what is silent before it. */
static bool impulse(struct modes_extract *x, struct modes_extract_place *p, struct err *e)
{
    struct strikes_recording *r = &p->recording;
    double most = 0.0;
    for (long i = 0; i < r->n; i++)
        most = fmax(most, fabs(r->sound.x[i]));
    long shift = isnan(x->given.delay) ? begins(r->sound.x, r->n, most) : (long)rint(x->given.delay * r->rate);
    most = 0.0;
    if (isnan(x->given.delay) && shift)
        place_note(x, p,
                   arena_format(x->arena,
                                "the response begins %.4g ms into the file: that is taken off (--delay 0 ms keeps it)",
                                1e3 * (double)shift / r->rate));
    if ((double)(r->n - shift) < 0.01 * r->rate)
        return err_set(e, ERR_SCENE, "%s lasts %.3g ms%s; a response takes at least 10 ms", r->name,
                       1e3 * (double)(r->n - shift) / r->rate, shift ? " behind --delay" : "");
    for (long i = shift; i < r->n; i++)
        most = fmax(most, fabs(r->sound.x[i]));
    if (most == 0.0)
        return err_set(e, ERR_SCENE, "%s: the response is silent (all samples are 0): is --channel right?", r->name);
    strikes_clip(&r->sound, r->n);
    if (most >= 0.9999 * r->sound.full || r->sound.clip[0] < 0.0 || r->sound.clip[1] > 0.0)
        place_note(x, p, "its greatest sample is as large as the file can hold, or stands in a row: it may be clipped");
    p->delay = (double)shift / r->rate;
    p->strikes = (struct strikes){.n = 1, .strike = ARENA_TAKE(x->arena, struct strikes_one, 1)};
    p->strikes.strike[0] =
        (struct strikes_one){.onset = shift, .over = shift, .end = r->n, .peak = most, .momentum = NAN};
    return true;
}

/* --strikes 1,3,5-7 */
static bool chosen(const struct modes_extract *x, int strike, int strikes, bool *yes, struct err *e)
{
    const char *text = x->given.only;
    *yes = !text;
    while (text && *text) {
        char *end;
        long from = strtol(text, &end, 10), to = from;
        if (end != text && *end == '-') {
            text = end + 1;
            to = strtol(text, &end, 10);
        }
        if (end == text || (*end && *end != ',') || from < 1 || to < from)
            return err_set(e, ERR_USAGE, "--strikes: '%s' is not of the form 1,3,5-7", x->given.only);
        if (to > strikes) return err_set(e, ERR_USAGE, "--strikes: '%s': there are %d strikes", x->given.only, strikes);
        *yes = *yes || (strike + 1 >= from && strike + 1 <= to);
        text = *end ? end + 1 : end;
    }
    return true;
}

static bool strikes(struct modes_extract *x, struct modes_extract_place *p, struct err *e)
{
    int left = 0;
    if (x->given.impulse) return impulse(x, p, e);
    if (!strikes_find(&p->recording, x->given.threshold, x->arena, &p->strikes, e)) return false;
    place_note(x, p, p->strikes.note);
    for (int k = 0; k < p->strikes.n; k++) {
        bool yes;
        if (!chosen(x, k, p->strikes.n, &yes, e)) return false;
        if (!yes && !p->strikes.strike[k].left_out) p->strikes.strike[k].left_out = "not in --strikes";
        left += !p->strikes.strike[k].left_out;
    }
    if (!left)
        return err_set(e, ERR_SCENE, "%s: --strikes %s leaves no strike that can be fitted", p->shown, x->given.only);
    p->delay = !p->recording.force.x    ? 0.0
               : !isnan(x->given.delay) ? x->given.delay
                                        : strikes_delay(&p->recording, &p->strikes);
    return true;
}

/* ------------------------------------------------------------------ stretches */

static int room(const struct modes_extract *x)
{
    int n = 0;
    for (int k = 0; k < x->n; k++)
        n += x->place[k].strikes.n + 1;
    return n;
}

static void add(struct modes_extract *x, struct modal_stretch *list, struct modes_extract_place *p,
                struct modal_stretch s, long end)
{
    const struct strikes_recording *r = &p->recording;
    s.n = modal_length((end < r->n ? end : r->n) - s.first);
    s.y = r->sound.x + s.first;
    s.place = (int)(p - x->place);
    if ((double)(s.n - s.ringing) < shortest * r->rate) return;
    if (p->stretches++ == 0) p->first = x->data.stretches;
    list[x->data.stretches++] = s;
}

/* The force of a strike as late as the sound comes; without a channel for it a unit impulse at that sample. */
static struct modal_pulse pulse(struct modes_extract *x, const struct modes_extract_place *p, int strike, long at)
{
    const struct strikes_one *v = &p->strikes.strike[strike];
    long n = p->recording.force.x ? v->over - v->onset : 1;
    double *f = ARENA_TAKE(x->arena, double, n);
    f[0] = 1.0;
    for (long i = 0; p->recording.force.x && i < n; i++)
        f[i] = p->recording.force.x[v->onset + i] - v->base;
    return (struct modal_pulse){at, n, f};
}

static void place_stretches(struct modes_extract *x, struct modal_stretch *list, struct modes_extract_place *p)
{
    const struct strikes *s = &p->strikes;
    const struct strikes_recording *r = &p->recording;
    bool force = r->force.x != NULL;
    long late = (long)rint(p->delay * x->rate), early = (long)ceil(before * x->rate),
         longest = (long)(strikes_ringing(r, s) * x->rate);
    if (!x->given.impulse && s->strike[0].onset - early > (long)(lead_least * x->rate))
        add(x, list, p, (struct modal_stretch){.group = x->data.groups++, .strike = -1}, s->strike[0].onset - early);
    for (int k = 0; k < s->n; k++) {
        const struct strikes_one *v = &s->strike[k];
        struct modal_stretch st = {.first = v->onset + (x->given.impulse ? 1
                                                        : force          ? late - early
                                                                         : (long)(past * x->rate)),
                                   .group = x->data.groups++,
                                   .strike = k,
                                   .fitted = !v->left_out};
        long end = k + 1 < s->n ? s->strike[k + 1].onset + (force ? late - early : -early) : r->n,
             most = st.first + longest;
        st.first = st.first > 0 ? st.first : 0;
        st.ringing = force ? v->over + late - st.first : 0;
        st.pulse = pulse(x, p, k, force ? v->onset + late : x->given.impulse ? v->onset : st.first);
        add(x, list, p, st, end < most ? end : most);
    }
}

/* Where the force of the strikes that are fitted holds something, Hz. */
static void band_of_force(struct modes_extract *x, struct modes_extract_place *p)
{
    struct arena *a = arena_open();
    long n = (long)fft_good_size((size_t)(0.1 * x->rate)), half_n = n / 2;
    double *power = ARENA_TAKE(a, double, half_n + 1), *re = ARENA_TAKE(a, double, half_n + 1),
           *im = ARENA_TAKE(a, double, half_n + 1), *f = ARENA_TAKE(a, double, n), most = 0.0;
    struct fft *fft = fft_open((size_t)n);
    p->low = 0.0;
    p->high = 0.49 * x->rate;
    for (int s = p->first; p->recording.force.x && s < p->first + p->stretches; s++) {
        const struct modal_stretch *st = &x->data.stretch[s];
        if (!st->fitted || st->strike < 0) continue;
        const struct modal_pulse *q = &st->pulse;
        memset(f, 0, (size_t)n * sizeof *f);
        memcpy(f, q->f, (size_t)(q->n < n ? q->n : n) * sizeof *f);
        fft_forward(fft, f, re, im);
        for (long k = 0; k <= half_n; k++)
            power[k] += re[k] * re[k] + im[k] * im[k];
    }
    for (long k = 0; k <= half_n; k++)
        most = fmax(most, power[k]);
    for (long k = half_n; most > 0.0 && k > 0 && power[k] < reach * most; k--)
        p->high = fmin(p->high, (double)(k - 1) * x->rate / (double)n);
    fft_close(fft);
    arena_close(a);
}

static bool stretches(struct modes_extract *x, struct err *e)
{
    const struct modes_extract_given *g = &x->given;
    struct modal_stretch *list = ARENA_TAKE(x->arena, struct modal_stretch, room(x));
    double *rounding = ARENA_TAKE(x->arena, double, x->n);
    int fitted = 0;
    x->data = (struct modal_data){.rate = x->rate, .places = x->n, .stretch = list, .rounding = rounding};
    x->low = 20.0;
    x->high = 0.49 * x->rate;
    for (int k = 0; k < x->n; k++) {
        struct modes_extract_place *p = &x->place[k];
        place_stretches(x, list, p);
        band_of_force(x, p);
        rounding[k] = p->recording.rounding;
        x->low = fmax(x->low, p->low);
        x->high = fmin(x->high, p->high);
    }
    for (int s = 0; s < x->data.stretches; s++)
        fitted += list[s].fitted;
    if (x->data.stretches > MODES_EXTRACT_STRIKES)
        return err_set(e, ERR_SCENE, "%s: %d strikes are more than the %d that are fitted together; cut the recording",
                       x->place[0].shown, x->data.stretches, MODES_EXTRACT_STRIKES);
    if (!fitted)
        return err_set(e, ERR_SCENE, "%s: no strike has %.3g ms of sound behind it", x->place[0].shown, 1e3 * shortest);
    if (g->high > x->high)
        modes_extract_find_note(
            x, arena_format(x->arena, "--high %g Hz lies beyond what the strikes hold, %.6g Hz", g->high, x->high));
    x->low = isnan(g->low) ? x->low : fmax(g->low, 1.0);
    x->high = isnan(g->high) ? x->high : fmin(g->high, x->high);
    return x->low < x->high ||
           err_set(e, ERR_SCENE,
                   "nothing lies between %.6g and %.6g Hz: --low and --high, or the hammer's reach, leave no band",
                   x->low, x->high);
}

/* ------------------------------------------------------------------ what it explains */

/* Energies of the strikes of a place, noise off, that are fitted or not, and what is explained of them. */
static double share(const struct modes_extract *x, int from, int to, bool fitted)
{
    double all = 0.0, known = 0.0;
    for (int s = from; s < to; s++) {
        const struct modal_stretch *st = &x->data.stretch[s];
        double energy = 0.0;
        if (st->strike < 0 || st->fitted != fitted) continue;
        for (long i = 0; i < st->n; i++)
            energy += st->y[i] * st->y[i];
        all += energy;
        known += energy * x->found.explained[s];
    }
    return all > 0.0 ? known / all : NAN;
}

double modes_extract_find_explained(const struct modes_extract *x, const struct modes_extract_place *p, int strike)
{
    for (int s = p->first; s < p->first + p->stretches; s++)
        if (x->data.stretch[s].strike == strike) return x->found.explained[s];
    return NAN;
}

static void compare(struct modes_extract *x)
{
    for (int k = 0; k < x->n; k++) {
        struct modes_extract_place *p = &x->place[k];
        double most = -1.0;
        p->explained = share(x, p->first, p->first + p->stretches, true);
        p->predicted = share(x, p->first, p->first + p->stretches, false);
        p->noise = x->found.noise[k];
        for (int s = p->first; s < p->first + p->stretches; s++) {
            const struct modal_stretch *st = &x->data.stretch[s];
            const struct strikes_one *v = st->strike >= 0 ? &p->strikes.strike[st->strike] : NULL;
            double worth = !v || (!st->fitted && strcmp(v->left_out, "not in --strikes")) ? -1.0
                           : st->fitted                                                   ? v->peak
                                                                                          : 1e6 * v->peak;
            if (worth > most) {
                most = worth;
                p->shown_stretch = s;
            }
        }
        const struct modal_stretch *st = &x->data.stretch[p->shown_stretch];
        p->distance =
            spectral_distance(st->y + st->ringing, x->found.model[p->shown_stretch] + st->ringing, st->n - st->ringing,
                              &(struct spectral_distance_band){x->rate, x->low, x->high, p->noise * p->noise});
    }
}

/* ------------------------------------------------------------------ modes of places */

struct strike_gain {
    double size, se, shared, phase; /* shared: of all strikes alike */
};

/* A of a component in the strikes of a place that are fitted, t from the strike, per N s (without force of a strike
 * whose sound's peak is 1). Returns how many there are. */
static int strike_gains(const struct modes_extract *x, const struct modal_mode *m, const struct modes_extract_place *p,
                        struct strike_gain *g)
{
    int n = 0;
    for (int k = p->first; k < p->first + p->stretches; k++) {
        const struct modal_stretch *st = &x->data.stretch[k];
        if (st->strike < 0 || !st->fitted || !isfinite(m->gain_se[st->group]) || !(m->gain_se[st->group] > 0.0))
            continue;
        const struct strikes_one *v = &p->strikes.strike[st->strike];
        bool alone = !x->given.impulse && !p->recording.force.x;
        double back = alone ? (double)(st->pulse.at - v->onset) / x->rate : 0.0, unit = x->given.impulse ? 1.0
                                                                                        : alone          ? 1.0 / v->peak
                                                                                                         : x->rate;
        cplx a = cplx_scale(unit, cplx_mul((cplx){m->re[st->group], m->im[st->group]},
                                           cplx_exp((cplx){-m->decay, 2.0 * REAL_PI * m->frequency}, -back)));
        double scale = unit * real_exp(m->decay * back);
        g[n++] = (struct strike_gain){cplx_abs(a), scale * m->gain_se[st->group], scale * m->gain_shared[st->group],
                                      real_atan2(a.im, a.re)};
    }
    return n;
}

/* The place's gain: of its strikes the mean of sizes, weighted by noise and by how far strikes differ, and the phase of
 * the most certain. */
static void place_gain(const struct modes_extract *x, const struct modal_mode *m, int k, struct modes_extract_mode *to)
{
    const struct modes_extract_place *p = &x->place[k];
    struct arena *a = arena_open();
    struct strike_gain *g = ARENA_TAKE(a, struct strike_gain, p->stretches + 1);
    int n = strike_gains(x, m, p, g), best = 0;
    double mean = 0.0, apart = 0.0, noise = 0.0, weights = 0.0, size = 0.0, shared = 0.0;
    for (int i = 0; i < n; i++)
        mean += g[i].size / n;
    for (int i = 0; i < n; i++) {
        apart += n > 1 ? (g[i].size - mean) * (g[i].size - mean) / (n - 1) : 0.0;
        noise += g[i].se * g[i].se / n;
        best = g[i].se / fmax(g[i].size, 1e-300) < g[best].se / fmax(g[best].size, 1e-300) ? i : best;
    }
    apart = n > 2 ? fmax(apart - 2.0 * noise, 0.0) : 0.0; /* of few strikes chance alone makes some */
    for (int i = 0; i < n; i++) {
        double w = 1.0 / (g[i].se * g[i].se + apart);
        weights += w;
        size += w * g[i].size;
        shared += w * g[i].shared;
    }
    to->re[k] = n ? size / weights * real_cos(g[best].phase) : 0.0;
    to->im[k] = n ? size / weights * real_sin(g[best].phase) : 0.0;
    to->gain_se[k] = n ? sqrt(1.0 / weights + shared * shared / (weights * weights)) : 0.0;
    arena_close(a);
}

static int rising(const void *a, const void *b)
{
    double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

static double median_decay(const struct modes_extract *x)
{
    int n = x->components;
    double *d = ARENA_TAKE(x->arena, double, n);
    for (int i = 0; i < n; i++)
        d[i] = x->heard[i].decay;
    qsort(d, (size_t)n, sizeof *d, rising);
    return n % 2 ? d[n / 2] : 0.5 * (d[n / 2 - 1] + d[n / 2]);
}

static int slower(const void *a, const void *b)
{
    const struct modes_extract_mode *m = a, *k = b;
    return (m->decay > k->decay) - (m->decay < k->decay);
}

/* Shares add up to 1 and are none below 0, so that components which cancel do not rule. Between modes it is
 * interpolated, so that two of equal shares do not change places by chance. */
static double median_by_energy(const struct modes_extract *x)
{
    struct modes_extract_mode *m = ARENA_TAKE(x->arena, struct modes_extract_mode, x->components);
    double all = 0.0, below = 0.0, at = 0.0, decay = NAN;
    int n = 0;
    for (int k = 0; k < x->components; k++)
        if (x->heard[k].decay <= slow) {
            m[n++] = x->heard[k];
            all += x->heard[k].share;
        }
    qsort(m, (size_t)n, sizeof *m, slower);
    for (int i = 0; i < n && (i == 0 || at < 0.5 * all); i++) {
        double last = at, from = decay;
        at = below + 0.5 * m[i].share;
        below += m[i].share;
        decay = m[i].decay;
        if (i > 0 && at > 0.5 * all) decay = from * real_pow(decay / from, (0.5 * all - last) / (at - last));
    }
    return decay;
}

static void take_modes(struct modes_extract *x)
{
    x->components = x->found.n;
    x->modes = x->found.modes;
    x->heard = ARENA_TAKE(x->arena, struct modes_extract_mode, x->components);
    for (int i = 0; i < x->components; i++) {
        const struct modal_mode *m = &x->found.mode[i];
        struct modes_extract_mode *to = &x->heard[i];
        *to = (struct modes_extract_mode){m->frequency,
                                          m->decay,
                                          m->frequency_se,
                                          m->decay_se,
                                          m->frequency_between,
                                          m->decay_between,
                                          m->share,
                                          NULL,
                                          NULL,
                                          NULL,
                                          m->mode,
                                          m->slope};
        to->re = ARENA_TAKE(x->arena, double, x->n);
        to->im = ARENA_TAKE(x->arena, double, x->n);
        to->gain_se = ARENA_TAKE(x->arena, double, x->n);
        for (int k = 0; k < x->n; k++)
            place_gain(x, m, k, to);
    }
    x->median_decay = median_decay(x);
    x->median_by_energy = median_by_energy(x);
}

/* Of the modes' own energy in the strikes that are fitted what the strike holds that each is loudest in: the median by
   shares. Near 1 each mode is heard in one strike alone. */
static double alone(const struct modes_extract *x, int *strikes)
{
    double *part = ARENA_TAKE(x->arena, double, x->found.n), all = 0.0, below = 0.0;
    for (int i = 0; i < x->found.n; i++) {
        const struct modal_mode *m = &x->found.mode[i];
        double most = 0.0, sum = 0.0;
        *strikes = 0;
        for (int s = 0; s < x->data.stretches; s++) {
            const struct modal_stretch *st = &x->data.stretch[s];
            double power = m->re[st->group] * m->re[st->group] + m->im[st->group] * m->im[st->group];
            if (!st->fitted || st->strike < 0) continue;
            most = fmax(most, power);
            sum += power;
            ++*strikes;
        }
        part[i] = most / sum;
        all += m->share;
    }
    for (double least = 0.0;;) { /* the next greater part, until half of the shares lie below */
        double next = 2.0;
        for (int i = 0; i < x->found.n; i++)
            if (part[i] > least) next = fmin(next, part[i]);
        for (int i = 0; i < x->found.n; i++)
            below += part[i] == next ? x->found.mode[i].share : 0.0;
        if (below >= 0.5 * all || next > 1.0) return next;
        least = next;
    }
}

/* The fit must explain nearly all of what it was made of, and of every strike half at least, or it is none of this
 * object's. */
static bool explains(struct modes_extract *x, struct err *e)
{
    int worst = -1, strikes = 0;
    double direct = 0.0, all = 0.0, known = 0.0;
    for (int s = 0; s < x->data.stretches; s++) {
        const struct modal_stretch *st = &x->data.stretch[s];
        double energy = 0.0;
        if (!st->fitted || st->strike < 0) continue;
        for (long i = 0; i < st->n; i++)
            energy += st->y[i] * st->y[i];
        all += energy;
        known += energy * x->found.fitted[s];
        worst = worst < 0 || x->found.fitted[s] < x->found.fitted[worst] ? s : worst;
        direct = fmax(direct, x->found.direct[s]);
    }
    const struct modal_stretch *st = &x->data.stretch[worst];
    const char *name = x->place[st->place].shown;
    double percent = 100.0 * fmax(x->found.fitted[worst], 0.0);
    if (direct > much && x->given.force_channel)
        modes_extract_find_note(x, arena_format(x->arena,
                                                "up to %.0f %% of the sound follows the force at once and is in no "
                                                "mode: the object moves as a whole, or modes decay faster "
                                                "than --fastest",
                                                100.0 * direct));
    if (x->given.spectrogram) {
        if (percent < 100.0 * half)
            modes_extract_find_note(
                x, arena_format(x->arena, "the modes explain only %.0f %% of strike %d: --method esprit finds more",
                                percent, st->strike + 1));
        return true;
    }
    if (percent < 100.0 * half)
        return err_set(
            e, ERR_SCENE,
            "%s: the modes that were found explain only %.0f %% of strike %d, so there is no table: is it one "
            "object, struck and left to ring, and does the sound begin at the strike? Without this strike "
            "(--strikes) or in a narrower band (--low, --high) there may be one",
            name, percent, st->strike + 1);
    if (known < enough * all)
        return err_set(e, ERR_SCENE,
                       "%s: the modes that were found explain only %.0f %% of what rings, so there is no table: noise "
                       "and speech are explained so far, an object that is struck and left to ring is explained by "
                       "%.0f %% and more; choose strikes (--strikes) or a narrower band (--low, --high)",
                       name, 100.0 * known / all, 100.0 * enough);
    if (alone(x, &strikes) > single && strikes >= 4)
        return err_set(e, ERR_SCENE,
                       "%s: most modes are heard in one of the %d strikes alone, so there is no table: are these "
                       "different objects? Choose the strikes of one (--strikes)",
                       name, strikes);
    return true;
}

/* ------------------------------------------------------------------ all */

bool modes_extract_find(struct modes_extract *x, struct err *e)
{
    long most = 50;
    if (!args_whole(&x->c->args, "modes", (const long[2]){1, 100000}, &most, e)) return false;
    for (int k = 0; k < x->n; k++)
        if (!strikes(x, &x->place[k], e)) return false;
    if (!stretches(x, e)) return false;
    struct modal_options o = {.most = (int)most,
                              .low = x->low,
                              .high = x->high,
                              .fastest =
                                  isnan(x->given.fastest) ? fmin(fastest[0], fastest[1] * x->rate) : x->given.fastest,
                              .spectrogram = x->given.spectrogram,
                              .threshold = 0.1};
    if (!modal_find(&x->data, &o, x->arena, &x->found, e)) return err_at(e, "%s", x->place[0].shown);
    if (x->found.n == 0)
        return err_set(e, ERR_SCENE, "%s: no mode stands out of the noise between %.6g and %.6g Hz", x->place[0].shown,
                       x->low, x->high);
    if (!explains(x, e)) return false;
    take_modes(x);
    modes_extract_find_note(x, x->found.note);
    compare(x);
    return true;
}
