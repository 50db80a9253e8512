/* Finding the strikes of a recording.

   In a channel of the force: a strike is a pulse above the noise (the level that a fiftieth of all hundredths of a
   second stay below) by the threshold and above 2 % of the greatest force. It begins and ends where it stands 0.5 % of
   its peak above the channel's offset just before it: what follows, the undershoot of an amplifier and the hammer's own
   ringing, is not force. Another pulse of at least a fifth of the peak within 50 ms is the same strike doubled.

   In the sound alone: a strike is where the level of the first difference (which favours a strike's high frequencies
   over what still rings) within 1 ms rises by 6 dB above its greatest of the 25 ms before, and above the noise by the
   threshold; it begins where the sound leaves what it was just before. The file's rounding is noise, too: where all
   else is silent, the last bit of what rings out would be the next strike.

   Offset of a channel: the mean of the longest quiet part, in whole tenths of a second, in which hum of 50 or 60 Hz and
   its harmonics has none. Where no tenth is quiet, that of the median and the mean of all which is nearer to 0, if both
   are of one sign: most of a recording of strikes is ringing then, which is as often above as below, but even harmonics
   of a hum move the median, and pulses the mean. It is taken off where it is more than a thousandth of the greatest
   sample and four standard errors: thresholds and energies are about 0.

   Clipping, in files that hold more than they were recorded with (floating point, or scaled afterwards): the greatest
   sample stands several times in a row, and the signal leaves it at once. A slow wave in few bits has such rows too,
   but leaves them by single steps, which are the least difference between neighbours that there is. In other files:
   two neighbours are as large as the file can hold. One alone is what normalising to full scale makes. */
#include "analysis/strikes.h"

#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <string.h>

#include "num/real.h"

static const double least_share = 0.02;   /* of the greatest force: less is no strike */
static const double edge_share = 0.005;   /* of a pulse's peak: where it begins and ends */
static const double double_share = 0.2;   /* of the peak: a second pulse */
static const double doubled_time = 0.05;  /* s, strikes closer than that are one doubled strike (a bouncing hammer) */
static const double one_pulse = 5e-4;     /* s: nearer pulses are one, with what a low-pass makes of its edges */
static const double shortest = 0.01;      /* s of sound that a strike needs behind it */
static const double quiet_share = 0.0316; /* of the loudest sound: 30 dB below it a strike is not what the recording is
                                             about */
static const double fewest_steps = 256.0; /* of the file, that a strike is high */
static const double gap_least = 0.002;    /* s */
static const double longest_delay = 0.02; /* s, from force to sound */
static const double arrival = 0.05;       /* of the greatest step in that time: the sound is there */
static const double clip_share = 0.9999;  /* of what the file can hold */
static const double considerable = 1e-3;  /* of the greatest sample: an offset */

enum { BESIDE = 4 }; /* samples to each side of a pulse that are force too: what a converter's low-pass makes of it */
enum { ROW = 3, STEPS = 4 }; /* of clipping: samples in a row, steps by which it is left */

#define NOTE(s, a, ...) (s)->note = arena_line(a, (s)->note, arena_format(a, __VA_ARGS__))

static double greatest(const double *x, long from, long to)
{
    double most = 0.0;
    for (long i = from; i < to; i++)
        most = fmax(most, fabs(x[i]));
    return most;
}

static long lesser(long a, long b) { return a < b ? a : b; }

static double mean(const double *x, long from, long to)
{
    double sum = 0.0;
    for (long i = from; i < to; i++)
        sum += x[i];
    return to > from ? sum / (double)(to - from) : 0.0;
}

/* The value that `below` of x[n] are not above. */
static double ranked(const double *x, long n, long below)
{
    struct arena *a = arena_open();
    double *work = ARENA_TAKE(a, double, n);
    memcpy(work, x, (size_t)n * sizeof *x);
    double found = n ? gsl_stats_select(work, 1, (size_t)n, (size_t)below) : 0.0;
    arena_close(a);
    return found;
}

static double *differences(const double *x, long n, struct arena *a)
{
    double *step = ARENA_TAKE(a, double, n);
    for (long i = 1; i < n; i++)
        step[i] = x[i] - x[i - 1];
    return step;
}

struct levels {
    long frame, n; /* samples of a frame, frames */
    double *rms;   /* [n] about the frame's own mean */
    double floor;  /* the level that a fiftieth of them stay below: a recording of strikes is quiet for so long at
                      least, or its floor is the ringing's */
};

/* In frames of `seconds`, of at least one sample. */
static struct levels levels(const double *x, const struct strikes_recording *r, double seconds, struct arena *a)
{
    struct levels l = {.frame = (long)fmax(1.0, rint(seconds * r->rate))};
    l.n = r->n / l.frame;
    l.rms = ARENA_TAKE(a, double, l.n);
    for (long k = 0; k < l.n; k++) {
        const double *y = x + k * l.frame;
        l.rms[k] = gsl_stats_sd_with_fixed_mean(y, 1, (size_t)l.frame, mean(y, 0, l.frame));
    }
    l.floor = ranked(l.rms, l.n, l.n / 50);
    return l;
}

/* ------------------------------------------------------------------ channels */

/* *error: its standard error. */
static double offset_of(const double *x, const struct strikes_recording *r, double *error)
{
    struct arena *a = arena_open();
    struct levels l = levels(x, r, 0.1, a);
    long from = 0, to = 0, first = 0; /* frames of the longest quiet part */
    for (long k = 0; k <= l.n; k++) {
        if (k < l.n && l.rms[k] <= 2.0 * l.floor) continue;
        if (k - first > to - from) {
            from = first;
            to = k;
        }
        first = k + 1;
    }
    double offset;
    *error = 0.0;
    if (to > from && l.floor < 0.5 * greatest(l.rms, 0, l.n)) {
        offset = mean(x, from * l.frame, to * l.frame);
        *error = l.floor / sqrt((double)((to - from) * l.frame));
    } else {
        double middle = ranked(x, r->n, r->n / 2), all = mean(x, 0, r->n);
        offset = middle * all <= 0.0 ? 0.0 : fabs(middle) < fabs(all) ? middle : all;
    }
    arena_close(a);
    return offset;
}

/* Does x[n] stand at its extreme of that sign in a row, and leave it at once on both sides? */
static bool stands(const double *x, long n, double extreme, double step)
{
    for (long i = 1, row = 0; i < n; i++) {
        row = x[i] == extreme ? row + 1 : 0;
        if (row >= ROW && i + 1 < n && x[i + 1] != extreme && i > row && fabs(x[i + 1] - extreme) > STEPS * step &&
            fabs(x[i - row] - extreme) > STEPS * step)
            return true;
    }
    return false;
}

/* The least difference between neighbours that there is; infinite: there is none. */
static double least_step(const double *x, long n)
{
    double step = INFINITY;
    for (long i = 1; i < n; i++)
        if (x[i] != x[i - 1]) step = fmin(step, fabs(x[i] - x[i - 1]));
    return step;
}

/* The step that all differences are whole multiples of, as of 8 bits in a file of 16 or of floats; 0: there is none. */
static double grain(const double *x, long n)
{
    double step = least_step(x, n);
    if (isinf(step)) return 0.0;
    for (long i = 1; i < n; i++) {
        double steps = fabs(x[i] - x[i - 1]) / step;
        if (!(fabs(steps - rint(steps)) < 1e-3)) return 0.0;
    }
    return step;
}

/* The levels at which a channel of n samples clips, though the file could hold more. */
static void find_clip(struct strikes_channel *c, long n)
{
    double extreme[2], step = least_step(c->x, n);
    gsl_stats_minmax(&extreme[0], &extreme[1], c->x, 1, (size_t)n);
    for (int k = 0; k < 2; k++)
        c->clip[k] = (k ? extreme[k] > 0.0 : extreme[k] < 0.0) && stands(c->x, n, extreme[k], step) ? extreme[k] : 0.0;
}

/* A copy of the channel, turned over and less its offset. */
static void change(struct strikes_channel *c, long n, double sign, double offset, struct arena *a)
{
    double *to = ARENA_TAKE(a, double, n);
    for (long i = 0; i < n; i++)
        to[i] = sign * c->x[i] - offset;
    c->x = to;
}

/* Offset and clipping; a hammer pushes: its greatest force is positive. */
static void prepare(struct strikes_channel *c, const struct strikes_recording *r, struct strikes *s, struct arena *a)
{
    bool force = c == &r->force;
    double least, most = 0.0, error, offset = offset_of(c->x, r, &error);
    for (long i = 0; i < r->n; i++)
        most = fmax(most, fabs(c->x[i] - offset));
    if (fabs(offset) > fmax(considerable * most, 4.0 * error)) {
        change(c, r->n, 1.0, offset, a);
        c->offset = offset;
        NOTE(s, a, "the %s stands beside 0, by %.3g: that offset is taken off", force ? "force" : "sound", offset);
    }
    gsl_stats_minmax(&least, &most, c->x, 1, (size_t)r->n);
    if (force && -least > fmax(most, 0.0)) {
        change(c, r->n, -1.0, 0.0, a);
        c->offset = -c->offset;
        NOTE(s, a, "the force points down in its channel, and is taken the other way round");
    }
    find_clip(c, r->n);
}

/* As large as the file can hold. */
static bool full(const struct strikes_channel *c, long i) { return fabs(c->x[i] + c->offset) >= clip_share * c->full; }

/* The sample after the last that clips; `from`: none does. */
static long clips(const struct strikes_channel *c, long from, long to)
{
    while (to > from &&
           !((to > 1 && full(c, to - 1) && full(c, to - 2)) || (c->clip[0] < 0.0 && c->x[to - 1] <= c->clip[0]) ||
             (c->clip[1] > 0.0 && c->x[to - 1] >= c->clip[1])))
        to--;
    return to;
}

/* ------------------------------------------------------------------ by the force */

/* The pulse whose maximum is at `top`. */
static struct strikes_one pulse(const struct strikes_recording *r, long top)
{
    const double *x = r->force.x;
    long foot = top, early = (long)(0.003 * r->rate), late = (long)(0.001 * r->rate);
    while (foot > 0 && x[foot] > 0.1 * x[top])
        foot--;
    long from = foot - early > 0 ? foot - early : 0;
    struct strikes_one v = {.base = mean(x, from, foot - late)};
    v.peak = x[top] - v.base;
    for (v.onset = foot; v.onset > 0 && v.onset > foot - late && x[v.onset] - v.base > edge_share * v.peak;)
        v.onset--;
    for (v.over = top; v.over < r->n && x[v.over] - v.base > edge_share * v.peak;)
        v.over++;
    v.onset = v.onset > BESIDE ? v.onset - BESIDE : 0;
    v.over = lesser(v.over + BESIDE, r->n);
    return v;
}

static void by_force(const struct strikes_recording *r, double threshold, struct strikes *s, struct arena *a)
{
    const double *x = r->force.x;
    double least = fmax(levels(x, r, 0.01, a).floor * real_exp10(threshold / 20.0), least_share * greatest(x, 0, r->n));
    for (long i = 0; i < r->n; i++) {
        if (x[i] <= least) continue;
        long top = i; /* the first maximum until the force has fallen */
        for (; i < r->n && x[i] > fmax(0.5 * least, 0.05 * x[top]); i++)
            if (x[i] > x[top]) top = i;
        struct strikes_one v = pulse(r, top), *last = s->n ? &s->strike[s->n - 1] : NULL;
        if (!last || (double)(v.onset - last->onset) > doubled_time * r->rate) {
            s->strike[s->n++] = v;
        } else if (v.peak > double_share * last->peak && (double)(v.onset - last->over) > one_pulse * r->rate) {
            last->doubled = true;
            last->over = v.over;
            last->peak = fmax(last->peak, v.peak);
        }
    }
    for (struct strikes_one *v = s->strike; v < s->strike + s->n; v++) {
        for (long i = v->onset; i < v->over; i++)
            v->momentum += (x[i] - v->base) / r->rate;
        v->clipped = clips(&r->force, v->onset, v->over) > v->onset;
    }
}

/* ------------------------------------------------------------------ by the sound */

/* Where the sound departs from what it was in the 2 ms before `from`. */
static long departs(const struct strikes_recording *r, long from, long to)
{
    const double *x = r->sound.x;
    long before = (long)(0.002 * r->rate), first = from - before > 0 ? from - before : 0;
    double middle = mean(x, first, from), swing = 0.0, peak = greatest(x, from, to);
    for (long i = first; i < from; i++)
        swing = fmax(swing, fabs(x[i] - middle));
    while (from < to && fabs(x[from] - middle) <= fmax(1.5 * swing, 0.05 * peak))
        from++;
    return from;
}

static void by_sound(const struct strikes_recording *r, double threshold, struct strikes *s, struct arena *a)
{
    const double *step = differences(r->sound.x, r->n, a);
    struct levels fine = levels(step, r, 0.001, a);
    double noise = fmax(levels(step, r, 0.01, a).floor, sqrt(2.0) * r->rounding),
           least = fmax(noise * real_exp10(threshold / 20.0), 1e-3 * greatest(fine.rms, 0, fine.n));
    long ms = (long)fmax(1.0, 0.001 * r->rate);
    for (long k = 0; k < fine.n; k++) {
        if (fine.rms[k] <= least || fine.rms[k] <= 2.0 * greatest(fine.rms, k > 25 ? k - 25 : 0, k)) continue;
        long at = k * fine.frame, to = lesser(at + 3 * ms, r->n), onset = departs(r, at - ms > 0 ? at - ms : 0, to),
             late = lesser(onset + 20 * ms, r->n);
        struct strikes_one *last = s->n ? &s->strike[s->n - 1] : NULL;
        if (last && (double)(onset - last->onset) <= doubled_time * r->rate) {
            last->doubled = last->doubled || (double)(onset - last->onset) > 0.005 * r->rate;
            last->over = last->doubled ? onset : last->over;
        } else
            s->strike[s->n++] = (struct strikes_one){
                .onset = onset, .over = onset, .peak = greatest(r->sound.x, onset, late), .momentum = NAN};
    }
}

/* ------------------------------------------------------------------ which of them */

/* Of a strike that is much quieter than what else the recording holds the rest of the table would be about something
   else. */
static bool choose(const struct strikes_recording *r, struct strikes *s, struct arena *a, struct err *e)
{
    enum { USED, CLIPPED, QUIET, REASONS };
    static const char *const reasons[REASONS] = {NULL, "clipped", "too quiet"};
    int count[REASONS] = {0};
    double least = quiet_share * greatest(r->sound.x, 0, r->n);
    for (struct strikes_one *v = s->strike; v < s->strike + s->n; v++) {
        long soon = lesser(v->onset + (long)(0.05 * r->rate), v->end);
        int why = v->clipped ? CLIPPED : greatest(r->sound.x, v->onset, soon) < least ? QUIET : USED;
        v->left_out = reasons[why];
        count[why]++;
    }
    s->used = count[USED];
    if (count[CLIPPED] == s->n)
        return err_set(e, ERR_SCENE,
                       "%s: %s clipped: no strike keeps below what the file can hold; record it again at a lower level",
                       r->name, s->n == 1 ? "the only strike is" : arena_format(a, "all %d strikes are", s->n));
    if (!s->used)
        return err_set(e, ERR_SCENE,
                       "%s: no strike can be used: %d of %d are clipped, the others more than 30 dB quieter than "
                       "the loudest sound of the recording; cut that out",
                       r->name, count[CLIPPED], s->n);
    if (count[QUIET])
        NOTE(s, a,
             "%d of %d strikes are more than 30 dB quieter than the loudest sound of the recording, and are left "
             "out",
             count[QUIET], s->n);
    return true;
}

/* A run of one value where the sound rings is a gap: a lost block, or a gate. */
static bool no_gap(const struct strikes_recording *r, const struct strikes_one *v, struct err *e)
{
    const double *x = r->sound.x;
    long least = (long)(gap_least * r->rate);
    for (long i = v->over + 1, run = 1; i < v->end && !v->left_out; i++) {
        run = x[i] == x[i - 1] ? run + 1 : 1;
        if (run < least) continue;
        long from = i - run + 1, to = i;
        while (to < v->end && x[to] == x[i])
            to++;
        if (greatest(x, from - least > v->over ? from - least : v->over, from) > 20.0 * r->rounding &&
            greatest(x, to, lesser(to + least, v->end)) > 20.0 * r->rounding)
            return err_set(e, ERR_SCENE,
                           "%s: from %.4g s on the sound stands still for %.3g ms while the object rings: the "
                           "recording has a gap; record it again",
                           r->name, (double)from / r->rate, 1e3 * (double)(to - from) / r->rate);
        i = to;
        run = 1;
    }
    return true;
}

/* Enough of the file's steps to tell a mode from their rounding, which follows the sound where that is faint? */
static bool high_enough(const struct strikes_recording *r, double peak, const char *what, struct err *e)
{
    double steps = peak / (r->rounding * sqrt(12.0));
    return r->rounding == 0.0 || steps >= fewest_steps ||
           err_set(e, ERR_SCENE,
                   "%s: the loudest %s is only %.0f of the file's steps high (%.0f are needed): what they "
                   "round away would be taken for modes; record it with more bits, or louder",
                   r->name, what, steps, fewest_steps);
}

bool strikes_find(struct strikes_recording *r, double threshold, struct arena *a, struct strikes *s, struct err *e)
{
    bool force = r->force.x != NULL;
    *s = (struct strikes){.strike = ARENA_TAKE(a, struct strikes_one, (double)r->n / (doubled_time * r->rate) + 2.0)};
    prepare(&r->sound, r, s, a);
    if (force) prepare(&r->force, r, s, a);
    if ((double)r->n < shortest * r->rate)
        return err_set(e, ERR_SCENE, "%s lasts %.3g ms; a strike and what rings after it take at least 10 ms", r->name,
                       1e3 * (double)r->n / r->rate);
    if (greatest(r->sound.x, 0, r->n) <= r->rounding)
        return err_set(e, ERR_SCENE, "%s: the sound is silent (all samples are alike): is --channel right?", r->name);
    if (force && greatest(r->force.x, 0, r->n) == 0.0)
        return err_set(e, ERR_SCENE,
                       "%s: the channel of the force is silent (all samples are alike): is --force-channel right?",
                       r->name);
    r->rounding = fmax(r->rounding, grain(r->sound.x, r->n) / sqrt(12.0));
    if (!high_enough(r, greatest(r->sound.x, 0, r->n), "sound", e)) return false;
    (force ? by_force : by_sound)(r, threshold, s, a);
    if (s->n && (double)(r->n - s->strike[s->n - 1].onset) < shortest * r->rate) {
        s->n--;
        NOTE(s, a, "a strike within the last 10 ms of the recording is left out");
    }
    if (s->n == 0)
        return err_set(e, ERR_SCENE,
                       "%s: no strike is found: nothing in its %s rises %g dB above the noise at once; a lower "
                       "--strike-threshold finds softer ones, "
                       "and a recording that is an impulse response already wants --impulse",
                       r->name, force ? "force" : "sound", threshold);
    for (struct strikes_one *v = s->strike; v < s->strike + s->n; v++) {
        v->end = v + 1 < s->strike + s->n ? v[1].onset - (long)(0.0005 * r->rate) : r->n;
        v->clear = clips(&r->sound, v->onset, v->end);
        v->clipped = v->clipped || v->clear > v->onset;
    }
    if (!choose(r, s, a, e)) return false;
    double peak = 0.0;
    for (const struct strikes_one *v = s->strike; v < s->strike + s->n; v++)
        if (!v->left_out) peak = fmax(peak, greatest(r->sound.x, v->onset, v->end));
    bool ok = high_enough(r, peak, "strike", e);
    for (int k = 0; k < s->n && ok; k++)
        ok = no_gap(r, &s->strike[k], e);
    return ok;
}

/* ------------------------------------------------------------------ a response */

/* Samples before a response begins. It begins where what rises to a fifth of its greatest within 1.5 ms is above the
   hundredth, and half as much again as whatever stands before these 1.5 ms, if that is less than a tenth. One more
   stays, as sample 0. *late: the first fifth, where no beginning is found. */
static long begins(const double *h, long n, double rate, long *late)
{
    double most = greatest(h, 0, n);
    long at = 0, rise = (long)(0.0015 * rate);
    while (at < n && fabs(h[at]) < 0.2 * most)
        at++;
    long start = at, lead = at > rise ? at - rise : 0;
    double least = fmax(0.01 * most, 1.5 * greatest(h, 0, lead));
    while (start > lead && fabs(h[start - 1]) >= least)
        start--;
    bool found = start > lead && start > 2 && least <= 0.1 * most && greatest(h, lead, start) < least;
    *late = found ? 0 : at;
    return found ? start - 1 : 0;
}

bool strikes_response(struct strikes_recording *r, double delay, struct arena *a, struct strikes *s, struct err *e)
{
    double length = (double)r->n / r->rate, behind = length - (isnan(delay) ? 0.0 : delay);
    if (behind < shortest)
        return err_set(e, ERR_SCENE, "%s lasts %.4g ms%s; a response takes at least 10 ms", r->name, 1e3 * length,
                       isnan(delay) ? ""
                                    : arena_format(a, ", of which --delay leaves %.3g ms", 1e3 * fmax(behind, 0.0)));
    *s = (struct strikes){.n = 1, .used = 1, .strike = ARENA_TAKE(a, struct strikes_one, 1)};
    prepare(&r->sound, r, s, a);
    const double *x = r->sound.x;
    long late = 0, shift = isnan(delay) ? begins(x, r->n, r->rate, &late) : (long)rint(delay * r->rate);
    double most = greatest(x, shift, r->n);
    *s->strike = (struct strikes_one){.onset = shift, .over = shift, .end = r->n, .peak = most, .momentum = NAN};
    if (isnan(delay) && shift)
        NOTE(s, a, "the response begins %.4g ms into the file: that is taken off (--delay 0 ms keeps it)",
             1e3 * (double)shift / r->rate);
    if ((double)late > 0.0005 * r->rate)
        NOTE(s, a,
             "no clear onset is found: the impulse is taken to be at sample 0, though the response reaches a fifth of "
             "its greatest %.4g ms later only; if it begins later, gains and phases are wrong: give --delay, or cut it",
             1e3 * (double)late / r->rate);
    if ((double)(r->n - shift) < shortest * r->rate)
        return err_set(e, ERR_SCENE, "%s begins %.3g ms before its end; a response takes at least 10 ms", r->name,
                       1e3 * (double)(r->n - shift) / r->rate);
    if (most == 0.0)
        return err_set(e, ERR_SCENE, "%s: the response is silent (all samples are alike): is --channel right?",
                       r->name);
    if (clips(&r->sound, 0, r->n) > 0) /* also before the delay: what is clipped at its onset rings wrongly */
        NOTE(s, a, "its greatest sample is as large as the file can hold, or stands in a row: it may be clipped");
    return true;
}

/* ------------------------------------------------------------------ length, delay */

double strikes_ringing(const struct strikes_recording *r, const struct strikes *s)
{
    struct arena *a = arena_open();
    const double *of[2] = {r->sound.x, differences(r->sound.x, r->n, a)}; /* the sound's low modes, its high ones */
    double longest = 0.25;
    for (int q = 0; q < 2; q++) {
        struct levels l = levels(of[q], r, 0.01, a);
        /* rumble comes and goes: not the quietest moment, and 50 ms together */
        double floor = 1.5 * fmax(ranked(l.rms, l.n, l.n / 5), r->rounding);
        for (int k = 0; k < s->n; k++) {
            long first = s->strike[k].onset / l.frame, end = s->strike[k].end / l.frame, last = first;
            double peak = greatest(l.rms, first, end), power = HUGE_VAL;
            if (s->strike[k].left_out) continue;
            for (; last + 5 <= end && power > floor * floor; last++) {
                power = 0.0;
                for (long i = last; i < last + 5; i++)
                    power += 0.2 * l.rms[i] * l.rms[i];
            }
            last = power > floor * floor ? end : last;
            double range = peak > floor ? 20.0 * real_log10(peak / floor) : 0.0, more = 1.0 + 20.0 / fmax(range, 13.0);
            longest = fmax(longest, more * (double)((last - first) * l.frame) / r->rate);
        }
    }
    arena_close(a);
    return longest;
}

double strikes_delay(const struct strikes_recording *r, const struct strikes *s)
{
    struct arena *a = arena_open();
    double *delay = ARENA_TAKE(a, double, s->n), *step = differences(r->sound.x, r->n, a);
    int n = 0;
    for (const struct strikes_one *v = s->strike; v < s->strike + s->n; v++) {
        long i = v->onset + 1, to = lesser(v->onset + (long)(longest_delay * r->rate), v->end);
        double loudest = greatest(step, i, to);
        while (i < to && fabs(step[i]) < arrival * loudest)
            i++;
        if (!v->left_out && i < to) delay[n++] = (double)(i - v->onset - BESIDE) / r->rate;
    }
    double middle = n ? fmax(ranked(delay, n, n / 2), 0.0) : 0.0;
    arena_close(a);
    return middle;
}
