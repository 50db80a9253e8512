/* From recordings to modes: strikes, the stretches that are fitted, the fit, what it explains, and each mode's gains.

   With a force a stretch begins just before its strike, and what rings on from earlier strikes is carried into it
   (analysis/modal_fit.h), from those too that are left out. What is wrong with a strike is not fitted: of a doubled one
   the stretch begins after the second pulse, of one that clips where that has ended. Without a force it begins a
   millisecond after the strike, when a hard hammer has left, and has gains of its own, which are taken back to the
   strike by e^(-s t).

   A microphone's pressure is, without the sizes of a radiator, taken as proportional to the acceleration of the
   surface, as of a small source: gains then hold what the path through the air did to each mode. With them each mode's
   gain is divided by a monopole's H(s), pressure over velocity (response/radiator.c). */
#include <gsl/gsl_sort_double.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cmd/modes_extract.h"
#include "num/fft.h"
#include "num/real.h"
#include "response/radiator.h"

enum { STRIKES = 250 };

static const double before = 4e-4;     /* s of a stretch before its force */
static const double past = 1e-3;       /* s after a strike without force: the hammer has left */
static const double shortest = 0.01;   /* s of sound that a stretch needs */
static const double lead_least = 0.05; /* s of silence before the first strike that show the noise */
static const double half = 0.5;        /* of a strike's energy: modes that explain less are not its own */
static const double enough = 0.9;      /* of all strikes' */
static const double single = 0.7; /* of a mode's parts of all strikes' energies: less than that is in any of them */
static const double much = 0.2;   /* of the energy: what follows the force at once is reported */
static const double fastest[2] = {600.0, 0.05}; /* 1/s, and of the rate: what decays faster than the less of the two is
                                                   no mode unless one asks for it */
static const double air_density = 1.204, air_speed = 343.2; /* kg/m^3, m/s: as output.listen has them by default */

void modes_extract_find_note(struct modes_extract *x, const struct modes_extract_place *p, const char *text)
{
    for (const char *line = text; line && *line; line = strchr(line, '\n') ? strchr(line, '\n') + 1 : NULL) {
        const char *one =
            arena_format(x->arena, "%s%s%.*s", p ? p->name : "", p ? ": " : "", (int)strcspn(line, "\n"), line);
        int k = 0;
        while (k < x->notes && strcmp(x->note[k], one) != 0)
            k++;
        if (k == x->notes && k < MODES_EXTRACT_NOTES) x->note[x->notes++] = one;
    }
}

#define NOTE(x, ...) modes_extract_find_note(x, NULL, arena_format((x)->arena, __VA_ARGS__))

/* ------------------------------------------------------------------ strikes */

/* --strikes 1,3,5-7: leaves the others out. */
static bool only(const struct modes_extract *x, struct strikes *s, struct err *e)
{
    bool *chosen = ARENA_TAKE(x->arena, bool, s->n);
    for (const char *text = x->given.only; *text;) {
        char *end;
        long from = strtol(text, &end, 10), to = from;
        if (end != text && *end == '-') to = strtol(text = end + 1, &end, 10);
        bool whole = end != text && (!*end || *end == ',');
        if (!whole || from < 1 || to < from)
            return err_set(e, ERR_USAGE, "--strikes: '%s' is not of the form 1,3,5-7", x->given.only);
        if (to > s->n)
            return err_set(e, ERR_USAGE, "--strikes: '%s': the last strike is number %d", x->given.only, s->n);
        for (long k = from; k <= to; k++)
            chosen[k - 1] = true;
        text = *end ? end + 1 : end;
    }
    for (int k = 0; k < s->n; k++)
        if (!chosen[k] && !s->strike[k].left_out) {
            s->strike[k].left_out = "not in --strikes";
            s->used--;
        }
    return true;
}

static bool strikes(struct modes_extract *x, struct modes_extract_place *p, struct err *e)
{
    const struct modes_extract_given *g = &x->given;
    struct strikes *s = &p->strikes;
    if (!(g->impulse ? strikes_response(&p->recording, g->delay, x->arena, s, e)
                     : strikes_find(&p->recording, g->threshold, x->arena, s, e)))
        return false;
    modes_extract_find_note(x, p, s->note);
    if (g->only && !only(x, s, e)) return false;
    if (!s->used)
        return err_set(e, ERR_SCENE, "%s: --strikes %s leaves no strike that can be fitted", p->shown, g->only);
    if (g->impulse)
        p->delay = (double)s->strike[0].onset / x->rate;
    else if (g->force_channel)
        p->delay = isnan(g->delay) ? strikes_delay(&p->recording, s) : g->delay;
    return p->delay < (double)p->recording.n / x->rate ||
           err_set(e, ERR_USAGE, "--delay %g s is longer than %s", p->delay, p->shown);
}

/* The way from force to sound is the same for all places, of which none is struck later than another: the median of
   what their recordings show. */
static void same_delay(struct modes_extract *x)
{
    double *delay = ARENA_TAKE(x->arena, double, x->n);
    for (int k = 0; k < x->n; k++)
        delay[k] = x->place[k].delay;
    double median = gsl_stats_median(delay, 1, (size_t)x->n);
    for (int k = 0; k < x->n; k++)
        x->place[k].delay = median;
}

/* ------------------------------------------------------------------ stretches */

/* One before the first strike, where there is room, and one for each strike, with its force as late as the sound comes;
 * without a channel for that with a unit impulse. */
static void add_stretches(struct modes_extract *x, struct modal_stretch *list, struct modes_extract_place *p)
{
    static const double unit[1] = {1.0};
    const struct strikes *s = &p->strikes;
    const struct strikes_recording *r = &p->recording;
    bool force = x->given.force_channel, response = x->given.impulse;
    long late = (long)rint(p->delay * x->rate), early = (long)ceil(before * x->rate),
         longest = (long)(strikes_ringing(r, s) * x->rate);
    p->first = x->data.stretches;
    for (int k = -1; k < s->n; k++) {
        struct modal_stretch st = {.place = (int)(p - x->place), .strike = k, .rounding = r->rounding};
        long end = k + 1 < s->n ? s->strike[k + 1].onset + (force && k >= 0 ? late - early : -early) : r->n;
        if (k < 0 && (response || end <= (long)(lead_least * x->rate))) continue;
        if (k >= 0) {
            const struct strikes_one *v = &s->strike[k];
            st.first = response     ? v->onset + 1
                       : !force     ? v->over + (long)(past * x->rate)
                       : v->doubled ? v->over + late
                                    : v->onset + late - early;
            st.first = st.first > 0 ? st.first : 0;
            end = end < st.first + longest ? end : st.first + longest;
            st.fitted = !v->left_out;
            if (v->clipped && !response) st.first = v->clear > st.first ? v->clear : st.first;
            st.pulse = (struct modal_pulse){response ? v->onset : st.first, 1, unit};
            if (force && !v->clipped) {
                double *f = ARENA_TAKE(x->arena, double, v->over - v->onset);
                st.pulse = (struct modal_pulse){v->onset + late, v->over - v->onset, f};
                st.ringing = v->over + late > st.first ? v->over + late - st.first : 0;
                for (long i = 0; i < st.pulse.n; i++)
                    f[i] = r->force.x[v->onset + i] - v->base;
            }
        }
        st.y = r->sound.x + st.first;
        st.n = modal_length((end < r->n ? end : r->n) - st.first);
        if ((double)(st.n - st.ringing) >= shortest * r->rate) {
            list[x->data.stretches++] = st;
        } else if (st.fitted) {
            p->strikes.strike[k].left_out = "too short";
            p->strikes.used--;
        }
    }
    p->stretches = x->data.stretches - p->first;
}

double *modes_extract_find_power(const double *y, long n, long size, struct arena *a)
{
    double *re = ARENA_TAKE(a, double, size / 2 + 1), *im = ARENA_TAKE(a, double, size / 2 + 1),
           *padded = ARENA_TAKE(a, double, size);
    struct fft *fft = fft_open((size_t)size);
    memcpy(padded, y, (size_t)(n < size ? n : size) * sizeof *y);
    fft_forward(fft, padded, re, im);
    fft_close(fft);
    for (long i = 0; i <= size / 2; i++)
        re[i] = re[i] * re[i] + im[i] * im[i];
    return re;
}

/* Hz, up to which the force of the strikes that are fitted holds something. */
static double reach_of_force(const struct modes_extract *x, const struct modes_extract_place *p)
{
    struct arena *a = arena_open();
    long n = (long)fft_good_size((size_t)(0.1 * x->rate)), k = n / 2;
    double *power = ARENA_TAKE(a, double, n / 2 + 1);
    for (const struct modal_stretch *st = x->data.stretch + p->first, *end = st + p->stretches; st < end; st++) {
        if (!st->fitted) continue;
        const double *one = modes_extract_find_power(st->pulse.f, st->pulse.n, n, a);
        for (long i = 0; i <= n / 2; i++)
            power[i] += one[i];
    }
    double most = gsl_stats_max(power, 1, (size_t)n / 2 + 1);
    while (k > 0 && power[k] < MODES_EXTRACT_REACH * most)
        k--;
    arena_close(a);
    return fmin(0.49 * x->rate, (double)k * x->rate / (double)n);
}

static bool stretches(struct modes_extract *x, struct err *e)
{
    const struct modes_extract_given *g = &x->given;
    int room = 0;
    for (int k = 0; k < x->n; k++)
        room += x->place[k].strikes.n + 1;
    struct modal_stretch *list = ARENA_TAKE(x->arena, struct modal_stretch, room);
    x->data = (struct modal_data){.rate = x->rate, .places = x->n, .stretch = list};
    x->high = 0.49 * x->rate;
    for (int k = 0; k < x->n; k++) {
        struct modes_extract_place *p = &x->place[k];
        add_stretches(x, list, p);
        if (!p->strikes.used)
            return err_set(e, ERR_SCENE, "%s: no strike has %.3g ms of sound behind it", p->shown, 1e3 * shortest);
        p->high = g->force_channel ? reach_of_force(x, p) : 0.49 * x->rate;
        x->high = fmin(x->high, p->high);
    }
    if (x->data.stretches > STRIKES)
        return err_set(e, ERR_SCENE, "%s: %d strikes are more than the %d that are fitted together; cut the recording",
                       x->place[0].shown, x->data.stretches, STRIKES);
    if (g->high > x->high) NOTE(x, "--high %g Hz lies beyond what the strikes hold, %.6g Hz", g->high, x->high);
    x->low = isnan(g->low) ? 20.0 : fmax(g->low, 1.0);
    x->high = isnan(g->high) ? x->high : fmin(g->high, x->high);
    return x->low < x->high ||
           err_set(e, ERR_SCENE,
                   "nothing lies between %.6g and %.6g Hz: --low and --high, or the hammer's reach, leave no band",
                   x->low, x->high);
}

/* ------------------------------------------------------------------ what it explains */

/* Share (of each stretch: part) of the energy of the strikes [from, to) that are fitted, or not. NAN: there are none.
 */
static double share(const struct modes_extract *x, int from, int to, bool fitted, const double *part)
{
    double all = 0.0, known = 0.0;
    for (int s = from; s < to; s++) {
        const struct modal_stretch *st = &x->data.stretch[s];
        double energy = 0.0;
        if (st->strike < 0 || st->fitted != fitted) continue;
        for (long i = 0; i < st->n; i++)
            energy += st->y[i] * st->y[i];
        all += energy;
        known += energy * part[s];
    }
    return all > 0.0 ? known / all : NAN;
}

static void compare(struct modes_extract *x, struct modes_extract_place *p)
{
    double most = -1.0;
    p->explained = share(x, p->first, p->first + p->stretches, true, x->found.explained);
    p->predicted = share(x, p->first, p->first + p->stretches, false, x->found.explained);
    for (int s = p->first; s < p->first + p->stretches; s++) {
        const struct modal_stretch *st = &x->data.stretch[s];
        const struct strikes_one *v = &p->strikes.strike[st->strike < 0 ? 0 : st->strike];
        double worth = st->fitted ? v->peak : 1e6 * v->peak;
        if (st->strike < 0 || (!st->fitted && strcmp(v->left_out, "not in --strikes") != 0) || worth <= most) continue;
        most = worth;
        p->loudest = s;
    }
    const struct modal_stretch *st = &x->data.stretch[p->loudest];
    double noise = x->found.noise[p - x->place];
    p->distance = spectral_distance(st->y + st->ringing, x->found.model[p->loudest] + st->ringing, st->n - st->ringing,
                                    &(struct spectral_distance_band){x->rate, x->low, x->high, noise * noise});
}

/* Is a strike's sound mostly of modes that are loud in one of the strikes alone, in the mean over strikes? As the modes
 * of different objects are. All strikes count alike: one that is louder than all others and rings otherwise is one. */
static bool alone(const struct modes_extract *x)
{
    double all[STRIKES] = {0}, common = 0.0, strikes = 0.0;
    for (int pass = 0; pass < 2; pass++)
        for (const struct modal_mode *m = x->found.mode; m < x->found.mode + x->found.n; m++) {
            double part[STRIKES], most = 0.0, sum = 0.0, square = 0.0; /* of the strike's energy */
            for (int s = 0; s < x->data.stretches; s++)
                square += x->data.stretch[s].fitted ? cplx_square(m->gain[s].a) : 0.0;
            for (int s = 0; s < x->data.stretches; s++) {
                part[s] = x->data.stretch[s].fitted ? m->share * cplx_square(m->gain[s].a) / square : 0.0;
                if (pass == 0)
                    all[s] += part[s];
                else if (all[s] > 0.0)
                    part[s] /= all[s];
                most = fmax(most, part[s]);
                sum += part[s];
            }
            common += pass && most <= single * sum ? sum : 0.0;
            strikes += pass ? sum : 0.0;
        }
    return common < 0.5 * strikes;
}

/* The fit must explain nearly all of what it was made of, and of every strike half at least, or it is none of this
 * object's. */
static bool explains(struct modes_extract *x, struct err *e)
{
    int worst = -1, strikes = 0;
    double direct = 0.0, known = share(x, 0, x->data.stretches, true, x->found.fitted);
    for (int s = 0; s < x->data.stretches; s++) {
        if (!x->data.stretch[s].fitted) continue;
        strikes++;
        worst = worst < 0 || x->found.fitted[s] < x->found.fitted[worst] ? s : worst;
        direct = fmax(direct, x->found.direct[s]);
    }
    const struct modal_stretch *st = &x->data.stretch[worst];
    const char *name = x->place[st->place].shown;
    double percent = 100.0 * fmax(x->found.fitted[worst], 0.0);
    if (direct > much && x->given.force_channel)
        NOTE(x,
             "up to %.0f %% of the sound follows the force at once and is in no mode: the object moves as a whole, or "
             "modes decay faster than --fastest",
             100.0 * direct);
    if (x->given.spectrogram) {
        if (percent < 100.0 * half)
            NOTE(x, "the modes explain only %.0f %% of strike %d: --method esprit finds more", percent, st->strike + 1);
        return true;
    }
    if (percent < 100.0 * half)
        return err_set(
            e, ERR_SCENE,
            "%s: the modes that were found explain only %.0f %% of strike %d, so there is no table: is it one "
            "object, struck and left to ring, and does the sound begin at the strike? Without this strike "
            "(--strikes) or in a narrower band (--low, --high) there may be one",
            name, percent, st->strike + 1);
    if (known < enough)
        return err_set(e, ERR_SCENE,
                       "%s: the modes that were found explain only %.0f %% of what rings, so there is no table: noise "
                       "and speech are explained so far, an object that is struck and left to ring is explained by "
                       "%.0f %% and more; choose strikes (--strikes) or a narrower band (--low, --high)",
                       name, 100.0 * known, 100.0 * enough);
    if (strikes >= 4 && alone(x))
        return err_set(e, ERR_SCENE,
                       "%s: most modes are heard in one of the %d strikes alone, so there is no table: are these "
                       "different objects? Choose the strikes of one (--strikes)",
                       name, strikes);
    return true;
}

/* ------------------------------------------------------------------ gains */

/* A of a component at a place: of its strikes that are fitted the mean of sizes, weighted by noise and by how far
 * strikes differ, and the phase of the most certain. */
static struct modal_gain place_gain(const struct modes_extract *x, const struct modal_mode *m,
                                    const struct modes_extract_place *p)
{
    double size[STRIKES], se[STRIKES], of_all[STRIKES], noise = 0.0, least = HUGE_VAL, phase = 0.0;
    int n = 0;
    for (int k = p->first; k < p->first + p->stretches; k++) {
        const struct modal_stretch *st = &x->data.stretch[k];
        const struct modal_gain *g = &m->gain[k];
        double back = 0.0, unit = x->given.impulse ? 1.0 : x->rate;
        if (!st->fitted || !isfinite(g->se) || g->se <= 0.0) continue;
        if (!x->given.impulse && !x->given.force_channel) {
            back = (double)(st->pulse.at - p->strikes.strike[st->strike].onset) / x->rate;
            unit = 1.0 / p->strikes.strike[st->strike].peak;
        }
        cplx a = cplx_mul(g->a, cplx_exp((cplx){-m->decay, 2.0 * REAL_PI * m->frequency}, -back));
        double scale = unit * real_exp(m->decay * back);
        size[n] = cplx_abs(cplx_scale(unit, a));
        se[n] = scale * g->se;
        of_all[n] = scale * g->shared;
        if (se[n] / fmax(size[n], 1e-300) < least) phase = real_atan2(a.im, a.re);
        least = fmin(least, se[n] / fmax(size[n], 1e-300));
        noise += se[n] * se[n];
        n++;
    }
    if (n == 0) return (struct modal_gain){0};
    double between = 0.0, weights = 0.0, mean = 0.0, shared = 0.0;
    if (n > 2) /* of few strikes chance alone makes some */
        between = fmax(gsl_stats_variance(size, 1, (size_t)n) - 2.0 * noise / n, 0.0);
    for (int i = 0; i < n; i++) {
        double w = 1.0 / (se[i] * se[i] + between);
        weights += w;
        mean += w * size[i];
        shared += w * of_all[i];
    }
    mean /= weights;
    shared /= weights;
    return (struct modal_gain){.a = {mean * real_cos(phase), mean * real_sin(phase)},
                               .se = sqrt(1.0 / weights + shared * shared)};
}

/* Of the sound, and of the table's quantity: a monopole's radiation is divided out, if its sizes are given. */
static void gains(struct modes_extract *x)
{
    const struct modes_extract_given *g = &x->given;
    bool divides = g->quantity == MODES_PRESSURE && !isnan(g->radius);
    struct radiator_monopole r = radiator_monopole(g->radius, g->distance, air_density, air_speed);
    x->quantity = g->quantity != MODES_PRESSURE ? g->quantity : divides ? MODES_VELOCITY : MODES_ACCELERATION;
    x->sound = ARENA_TAKE(x->arena, struct modal_gain, x->found.n * x->n);
    x->gain = ARENA_TAKE(x->arena, struct modal_gain, x->found.n * x->n);
    for (int i = 0; i < x->found.n * x->n; i++) {
        const struct modal_mode *m = &x->found.mode[i / x->n];
        struct modal_gain a = x->sound[i] = x->gain[i] = place_gain(x, m, &x->place[i % x->n]);
        double h[2], s[2] = {-m->decay, 2.0 * REAL_PI * m->frequency};
        if (!divides) continue;
        radiator_monopole_at(&r, s, h);
        cplx pressure = {h[0], h[1]};
        x->gain[i] = (struct modal_gain){.a = cplx_div(a.a, pressure), .se = a.se / cplx_abs(pressure)};
    }
}

/* What a physical level lacks: the last that applies. */
static void level(struct modes_extract *x)
{
    static const char air_note[] = "a microphone's pressure is taken as proportional to the surface's acceleration "
                                   "(--radius and --distance would divide a monopole out)";
    const struct modes_extract_given *g = &x->given;
    bool air = g->quantity == MODES_PRESSURE && isnan(g->radius), force = g->force_channel || g->impulse;
    if (isnan(g->scale))
        x->why_not = g->impulse ? "--scale, what the file's full scale is, is not given"
                                : "--scale and --force-scale, what the channels' full scales are, are not given";
    if (air) x->why_not = air_note;
    if (!force)
        x->why_not = MODES_EXTRACT_NO_FORCE ", so that gains are those of a strike whose sound's peak is 1, and "
                                            "hold the hammer's spectrum";
    if (!force && x->n > 1)
        x->why_not = MODES_EXTRACT_NO_FORCE
            ", so that gains at each place are those of a strike whose sound there "
            "has the peak 1 and the onset 0, and hold the hammer's spectrum: places cannot be compared with "
            "each other; --force-channel, or impulse responses with --impulse and one --delay for all, keep "
            "what is between them";
    if (air && !force) modes_extract_find_note(x, NULL, air_note);
    if (x->why_not) NOTE(x, "the level is relative: %s", x->why_not);
}

/* Of decays. By energy: shares add up to 1 and are none below 0, so that components which cancel do not rule; each
   stands at the middle of its share, and between them it is interpolated, so that two of equal shares do not change
   places by chance. */
static void medians(struct modes_extract *x)
{
    size_t n = (size_t)x->found.n;
    double *decay = ARENA_TAKE(x->arena, double, n), *part = ARENA_TAKE(x->arena, double, n);
    double all = 0.0, below = 0.0, at = 0.0;
    for (size_t i = 0; i < n; i++) {
        decay[i] = x->found.mode[i].decay;
        part[i] = x->found.mode[i].share;
        all += part[i];
    }
    gsl_sort2(decay, 1, part, 1, n);
    x->median_decay = gsl_stats_median_from_sorted_data(decay, 1, n);
    x->median_by_energy = NAN;
    for (size_t i = 0; i < n && (i == 0 || at < 0.5 * all); i++) {
        double last = at;
        at = below + 0.5 * part[i];
        below += part[i];
        x->median_by_energy = i > 0 && at > 0.5 * all
                                  ? decay[i - 1] * real_pow(decay[i] / decay[i - 1], (0.5 * all - last) / (at - last))
                                  : decay[i];
    }
}

/* ------------------------------------------------------------------ all */

bool modes_extract_find_strikes(struct modes_extract *x, struct modal_options *o, struct err *e)
{
    const struct modes_extract_given *g = &x->given;
    for (int k = 0; k < x->n; k++)
        if (!strikes(x, &x->place[k], e)) return false;
    if (g->force_channel) same_delay(x);
    if (!stretches(x, e)) return false;
    *o = (struct modal_options){.most = (int)g->modes,
                                .low = x->low,
                                .high = x->high,
                                .fastest = isnan(g->fastest) ? fmin(fastest[0], fastest[1] * x->rate) : g->fastest,
                                .spectrogram = g->spectrogram};
    return true;
}

bool modes_extract_find(struct modes_extract *x, struct err *e)
{
    struct modal_options o;
    if (!modes_extract_find_strikes(x, &o, e)) return false;
    if (!modal_find(&x->data, &o, x->arena, &x->found, e)) return err_at(e, "%s", x->place[0].shown);
    if (x->found.n == 0)
        return err_set(e, ERR_SCENE, "%s: no mode stands out of the noise between %.6g and %.6g Hz", x->place[0].shown,
                       x->low, x->high);
    if (!explains(x, e)) return false;
    modes_extract_find_note(x, NULL, x->found.note);
    for (int k = 0; k < x->n; k++)
        compare(x, &x->place[k]);
    gains(x);
    level(x);
    medians(x);
    return true;
}
