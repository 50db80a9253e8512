/* Finding the strikes of a recording.

   In a channel of the force: a strike is a pulse above the noise (the level that a fiftieth of all hundredths of a
   second stay below) by the threshold and above 2 % of the greatest force. It begins and ends where it stands 0.5 % of
   its peak above the channel's offset just before it: what follows, the undershoot of an amplifier and the hammer's own
   ringing, is not force. Another pulse of at least a fifth of the peak within the gap is the same strike doubled.

   In the sound alone: a strike is where the level of the first difference (which favours a strike's high frequencies
   over what still rings) within 1 ms rises by 6 dB above its greatest of the 25 ms before, and above the noise by the
   threshold; it begins where the sound leaves what it was just before. The file's rounding is noise, too: where all
   else is silent, the last bit of what rings out would be the next strike. */
#include "analysis/strikes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "analysis/strikes_level.h"
#include "num/real.h"

const struct strikes_options strikes_options = {.threshold = 20.0, .gap = 0.05};

static const double least_share = 0.02; /* of the greatest force: less is no strike */
static const double edge_share = 0.005; /* of a pulse's peak: where it begins and ends */
static const double double_share = 0.2; /* of the peak: a second pulse */
static const double apart = 5e-4;       /* s: nearer pulses are one, with what a low-pass makes of its edges */
static const double shortest = 0.01;    /* s of sound that a strike needs behind it */
static const double quiet_share =
    0.0316; /* of the loudest sound: 30 dB below it a strike is not what the recording is about */
static const double fewest_steps = 256.0; /* of the file, that a strike is high */
static const double gap_least = 0.002;    /* s */
static const double way = 0.02;           /* s, the longest way from force to sound */
static const double arrival = 0.05;       /* of the greatest step in that time: the sound is there */
static const double clip_share = 0.9999;  /* of what the file can hold */

enum {
    BESIDE = 4
}; /* samples to each side of a pulse that are force too: what a converter's low-pass makes of its edges */

struct finder {
    const struct strikes_recording *r;
    const struct strikes_options *o;
    struct arena *a;
    struct strikes *s;
    const double *force; /* upright */
};

static void add(struct finder *f, struct strikes_one v)
{
    struct strikes *s = f->s;
    if ((s->n & (s->n - 1)) == 0) {
        struct strikes_one *more = ARENA_TAKE(f->a, struct strikes_one, s->n ? 2 * s->n : 1);
        if (s->n) memcpy(more, s->strike, (size_t)s->n * sizeof *more);
        s->strike = more;
    }
    s->strike[s->n++] = v;
}

static void note(struct finder *f, const char *text)
{
    f->s->note = f->s->note ? arena_format(f->a, "%s\n%s", f->s->note, text) : text;
}

static double greatest(const double *x, long from, long to)
{
    double most = 0.0;
    for (long i = from; i < to; i++)
        most = fmax(most, fabs(x[i]));
    return most;
}

struct limits {
    double full, offset;
    const double *clip;
};

static bool clips(const double *x, long from, long to, const struct limits *l)
{
    bool any = false;
    for (long i = from; i < to; i++)
        any = any || fabs(x[i] + l->offset) >= clip_share * l->full || (l->clip[0] < 0.0 && x[i] <= l->clip[0]) ||
              (l->clip[1] > 0.0 && x[i] >= l->clip[1]);
    return any;
}

/* ------------------------------------------------------------------ by the force */

/* The pulse whose maximum is at `top`. */
static struct strikes_one pulse(const struct finder *f, long top)
{
    const double *x = f->force, rate = f->r->rate;
    long foot = top, early = (long)(0.003 * rate), late = (long)(0.001 * rate), n = 0;
    struct strikes_one v = {.end = f->r->n};
    while (foot > 0 && x[foot] > 0.1 * x[top])
        foot--;
    for (long i = foot - early > 0 ? foot - early : 0; i < foot - late; i++, n++)
        v.base += x[i];
    v.base = n ? v.base / (double)n : 0.0;
    v.peak = x[top] - v.base;
    for (v.onset = foot; v.onset > 0 && v.onset > foot - late && x[v.onset] - v.base > edge_share * v.peak;)
        v.onset--;
    for (v.over = top; v.over < f->r->n && x[v.over] - v.base > edge_share * v.peak;)
        v.over++;
    v.onset = v.onset > BESIDE ? v.onset - BESIDE : 0;
    v.over = v.over + BESIDE < f->r->n ? v.over + BESIDE : f->r->n;
    return v;
}

/* The first maximum of a stretch above the threshold that begins at `at`; *after: where the stretch ends. */
static long top_of(const struct finder *f, long at, double threshold, long *after)
{
    long top = at, i = at;
    for (; i < f->r->n && f->force[i] > fmax(0.5 * threshold, 0.05 * f->force[top]); i++)
        if (f->force[i] > f->force[top]) top = i;
    *after = i;
    return top;
}

static void take_pulse(struct finder *f, struct strikes_one v)
{
    struct strikes_one *last = f->s->n ? &f->s->strike[f->s->n - 1] : NULL;
    if (!last || (double)(v.onset - last->onset) > f->o->gap * f->r->rate) {
        add(f, v);
    } else if (v.peak > double_share * last->peak && (double)(v.onset - last->over) > apart * f->r->rate) {
        last->doubled = true;
        last->over = v.over;
        last->peak = fmax(last->peak, v.peak);
    }
}

/* N s, and whether the force or the sound reaches what the file holds. */
static void measure(const struct finder *f, struct strikes_one *v)
{
    const struct strikes_recording *r = f->r;
    v->momentum = 0.0;
    for (long i = v->onset; i < v->over; i++)
        v->momentum += (f->force[i] - v->base) / r->rate;
    v->clipped = clips(r->force, v->onset, v->over, &(struct limits){r->force_full, r->force_offset, r->force_clip});
}

static void by_force(struct finder *f)
{
    const struct strikes_recording *r = f->r;
    struct strikes_level level = strikes_level(f->force, r->n, r->rate, 0.01, f->a);
    double most = greatest(f->force, 0, r->n),
           threshold = fmax(level.floor * real_exp10(f->o->threshold / 20.0), least_share * most);
    for (long i = 0, after; i < r->n; i++)
        if (f->force[i] > threshold) {
            take_pulse(f, pulse(f, top_of(f, i, threshold, &after)));
            i = after;
        }
    for (int k = 0; k < f->s->n; k++)
        measure(f, &f->s->strike[k]);
}

/* A hammer pushes: its greatest force is positive. */
static void upright(struct finder *f)
{
    const double *x = f->r->force;
    double up = 0.0, down = 0.0, *other;
    for (long i = 0; i < f->r->n; i++) {
        up = fmax(up, x[i]);
        down = fmax(down, -x[i]);
    }
    f->s->sign = down > up ? -1.0 : 1.0;
    f->force = x;
    if (down <= up) return;
    f->force = other = ARENA_TAKE(f->a, double, f->r->n);
    for (long i = 0; i < f->r->n; i++)
        other[i] = -x[i];
    note(f, "the force points down in its channel, and is taken the other way round");
}

/* ------------------------------------------------------------------ by the sound */

/* Where the sound leaves what it was in the 2 ms before `from`. */
static long leaves(const struct finder *f, long from, long to)
{
    const double *x = f->r->sound;
    long before = (long)(0.002 * f->r->rate), first = from - before > 0 ? from - before : 0;
    double mean = 0.0, swing = 0.0, peak = greatest(x, from, to);
    for (long i = first; i < from; i++)
        mean += x[i] / (double)(from - first);
    for (long i = first; i < from; i++)
        swing = fmax(swing, fabs(x[i] - mean));
    while (from < to && fabs(x[from] - mean) <= fmax(1.5 * swing, 0.05 * peak))
        from++;
    return from;
}

static void take_rise(struct finder *f, long at)
{
    const struct strikes_recording *r = f->r;
    long ms = (long)fmax(1.0, 0.001 * r->rate), to = at + 3 * ms < r->n ? at + 3 * ms : r->n;
    long onset = leaves(f, at - ms > 0 ? at - ms : 0, to), late = onset + 20 * ms < r->n ? onset + 20 * ms : r->n;
    struct strikes_one *last = f->s->n ? &f->s->strike[f->s->n - 1] : NULL;
    if (last && (double)(onset - last->onset) <= f->o->gap * r->rate)
        last->doubled = last->doubled || (double)(onset - last->onset) > 0.005 * r->rate;
    else
        add(f,
            (struct strikes_one){
                .onset = onset, .over = onset, .end = r->n, .peak = greatest(r->sound, onset, late), .momentum = NAN});
}

static void by_sound(struct finder *f)
{
    const struct strikes_recording *r = f->r;
    double *steps = ARENA_TAKE(f->a, double, r->n), factor = real_exp10(f->o->threshold / 20.0);
    for (long i = 1; i < r->n; i++)
        steps[i] = r->sound[i] - r->sound[i - 1];
    struct strikes_level fine = strikes_level(steps, r->n, r->rate, 0.001, f->a),
                         coarse = strikes_level(steps, r->n, r->rate, 0.01, f->a);
    double noise = fmax(coarse.floor, sqrt(2.0) * r->rounding),
           least = fmax(noise * factor, 1e-3 * greatest(fine.rms, 0, fine.n));
    for (long k = 0; k < fine.n; k++) {
        double before = greatest(fine.rms, k > 25 ? k - 25 : 0, k);
        if (fine.rms[k] > least && fine.rms[k] > 2.0 * before) take_rise(f, k * fine.frame);
    }
}

/* ------------------------------------------------------------------ both */

static void ends(struct finder *f)
{
    struct strikes *s = f->s;
    const struct strikes_recording *r = f->r;
    long margin = (long)(0.0005 * r->rate);
    if (s->n && (double)(r->n - s->strike[s->n - 1].onset) < shortest * r->rate) {
        s->n--;
        note(f, "a strike within the last 10 ms of the recording is left out");
    }
    for (int k = 0; k < s->n; k++) {
        struct strikes_one *v = &s->strike[k];
        v->end = k + 1 < s->n ? s->strike[k + 1].onset - margin : r->n;
        v->clipped = v->clipped || clips(r->sound, v->onset, v->end, &(struct limits){r->full, r->offset, r->clip});
    }
}

static bool worth_looking(const struct strikes_recording *r, struct err *e)
{
    if ((double)r->n < shortest * r->rate)
        return err_set(e, ERR_SCENE, "%s lasts %.3g ms; a strike and what rings after it take at least 10 ms", r->name,
                       1e3 * (double)r->n / r->rate);
    if (greatest(r->sound, 0, r->n) == 0.0)
        return err_set(e, ERR_SCENE, "%s: the sound is silent (all samples are 0): is --channel right?", r->name);
    if (r->force && greatest(r->force, 0, r->n) == 0.0)
        return err_set(e, ERR_SCENE,
                       "%s: the channel of the force is silent (all samples are 0): is --force-channel right?",
                       r->name);
    return true;
}

/* Of doubled strikes without force and of those that are much quieter than what else the recording holds the rest of
 * the table would be about something else. */
static bool choose(struct finder *f, struct err *e)
{
    const struct strikes_recording *r = f->r;
    struct strikes *s = f->s;
    int clipped = 0, quiet = 0, used = 0;
    long soon = (long)(0.05 * r->rate);
    double loudest = greatest(r->sound, 0, r->n);
    if (s->n == 0)
        return err_set(e, ERR_SCENE,
                       "%s: no strike is found: nothing in its %s rises %g dB above the noise at once; a lower "
                       "--strike-threshold finds softer ones, "
                       "and a recording that is an impulse response already wants --impulse",
                       r->name, r->force ? "force" : "sound", f->o->threshold);
    for (int k = 0; k < s->n; k++) {
        struct strikes_one *v = &s->strike[k];
        v->left_out =
            v->clipped ? "clipped"
            : greatest(r->sound, v->onset, v->onset + soon < v->end ? v->onset + soon : v->end) < quiet_share * loudest
                ? "too quiet"
            : v->doubled && !r->force ? "doubled"
                                      : NULL;
        clipped += v->clipped;
        quiet += v->left_out && !strcmp(v->left_out, "too quiet");
        used += !v->left_out;
    }
    for (int k = 0; k < s->n && !used; k++) /* of doubled ones alone all */
        if (!strcmp(s->strike[k].left_out, "doubled")) s->strike[k].left_out = NULL;
    for (int k = 0; k < s->n; k++)
        used += !s->strike[k].left_out;
    if (!used && clipped == s->n)
        return err_set(e, ERR_SCENE,
                       "%s: %s clipped: no strike keeps below what the file can hold; record it again at a lower level",
                       r->name, s->n == 1 ? "the only strike is" : arena_format(f->a, "all %d strikes are", s->n));
    if (quiet)
        note(f, arena_format(f->a,
                             "%d of %d strikes are more than 30 dB quieter than the loudest sound of the recording, "
                             "and are left out",
                             quiet, s->n));
    return used || err_set(e, ERR_SCENE,
                           "%s: no strike can be used: %d of %d are clipped, the others more than 30 dB quieter than "
                           "the loudest sound of the recording; cut that out",
                           r->name, clipped, s->n);
}

/* Enough of the file's steps to tell a mode from their rounding, which follows the sound where that is faint. */
static bool fine_enough(const struct finder *f, struct err *e)
{
    const struct strikes_recording *r = f->r;
    double peak = 0.0, steps;
    for (int k = 0; k < f->s->n; k++)
        peak =
            fmax(peak, f->s->strike[k].left_out ? 0.0 : greatest(r->sound, f->s->strike[k].onset, f->s->strike[k].end));
    steps = r->rounding > 0.0 ? peak / (r->rounding * sqrt(12.0)) : HUGE_VAL;
    return steps >= fewest_steps || err_set(e, ERR_SCENE,
                                            "%s: the loudest strike is only %.0f of the file's steps high (%.0f are "
                                            "needed): what they round away would be taken for modes; "
                                            "record it with more bits, or louder",
                                            r->name, steps, fewest_steps);
}

/* A run of one value where the sound rings is a gap: a lost block, or a gate. */
static bool no_gap(const struct finder *f, struct err *e)
{
    const struct strikes_recording *r = f->r;
    long least = (long)(gap_least * r->rate);
    for (int k = 0; k < f->s->n; k++) {
        const struct strikes_one *v = &f->s->strike[k];
        for (long i = v->over + 1, run = 1; i < v->end && !v->left_out; i++) {
            run = r->sound[i] == r->sound[i - 1] ? run + 1 : 1;
            if (run < least) continue;
            long from = i - run + 1, to = i;
            while (to < v->end && r->sound[to] == r->sound[i])
                to++;
            double before = greatest(r->sound, from - least > v->over ? from - least : v->over, from),
                   after = greatest(r->sound, to, to + least < v->end ? to + least : v->end);
            if (before > fmax(20.0 * r->rounding, 0.0) && after > fmax(20.0 * r->rounding, 0.0))
                return err_set(e, ERR_SCENE,
                               "%s: from %.4g s on the sound stands still for %.3g ms while the object rings: the "
                               "recording has a gap; record it again",
                               r->name, (double)from / r->rate, 1e3 * (double)(to - from) / r->rate);
            i = to;
            run = 1;
        }
    }
    return true;
}

/* ------------------------------------------------------------------ length, delay */

static int rising(const void *x, const void *y)
{
    double p = *(const double *)x, q = *(const double *)y;
    return (p > q) - (p < q);
}

double strikes_ringing(const struct strikes_recording *r, const struct strikes *s, struct arena *a)
{
    double *steps = ARENA_TAKE(a, double, r->n), longest = 0.0;
    for (long i = 1; i < r->n; i++)
        steps[i] = r->sound[i] - r->sound[i - 1];
    const double *of[2] = {r->sound, steps}; /* the sound's low modes, its high ones */
    for (int q = 0; q < 2; q++) {
        struct strikes_level l = strikes_level(of[q], r->n, r->rate, 0.01, a);
        double *sorted = ARENA_TAKE(a, double, l.n + 1);
        memcpy(sorted, l.rms, (size_t)l.n * sizeof *sorted);
        qsort(sorted, (size_t)l.n, sizeof *sorted, rising);
        double floor = 1.5 * fmax(sorted[l.n / 5],
                                  r->rounding); /* rumble comes and goes: not the quietest moment, and 50 ms together */
        for (int k = 0; k < s->n; k++) {
            long first = s->strike[k].onset / l.frame, end = s->strike[k].end / l.frame, last = first;
            double peak = greatest(l.rms, first, end), power = HUGE_VAL;
            for (; last + 5 <= end && power > floor * floor; last++) {
                power = 0.0;
                for (long i = last; i < last + 5; i++)
                    power += 0.2 * l.rms[i] * l.rms[i];
            }
            last = power > floor * floor ? end : last;
            double range = peak > floor ? 20.0 * real_log10(peak / floor) : 0.0, more = 1.0 + 20.0 / fmax(range, 13.0);
            if (!s->strike[k].left_out) longest = fmax(longest, more * (double)((last - first) * l.frame) / r->rate);
        }
    }
    return fmax(longest, 0.25);
}

double strikes_delay(const struct strikes_recording *r, const struct strikes *s, struct arena *a)
{
    double *delay = ARENA_TAKE(a, double, s->n + 1);
    int n = 0;
    for (int k = 0; k < s->n; k++) {
        const struct strikes_one *v = &s->strike[k];
        long most = (long)(way * r->rate), to = v->onset + most < v->end ? v->onset + most : v->end, i = v->onset + 1;
        double loudest = 0.0;
        for (long j = i; j < to; j++)
            loudest = fmax(loudest, fabs(r->sound[j] - r->sound[j - 1]));
        while (i < to && fabs(r->sound[i] - r->sound[i - 1]) < arrival * loudest)
            i++;
        if (!v->left_out && i < to) delay[n++] = (double)(i - v->onset - BESIDE) / r->rate;
    }
    qsort(delay, (size_t)n, sizeof *delay, rising);
    return n ? fmax(delay[n / 2], 0.0) : 0.0;
}

/* ------------------------------------------------------------------ all */

bool strikes_find(const struct strikes_recording *r, const struct strikes_options *o, struct arena *a,
                  struct strikes *s, struct err *e)
{
    struct finder f = {.r = r, .o = o, .a = a, .s = s};
    *s = (struct strikes){.sign = 1.0};
    if (!worth_looking(r, e)) return false;
    if (r->force) {
        upright(&f);
        by_force(&f);
    } else {
        by_sound(&f);
    }
    ends(&f);
    return choose(&f, e) && fine_enough(&f, e) && no_gap(&f, e);
}
