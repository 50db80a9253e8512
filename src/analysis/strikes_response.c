/* The impulse response that the strikes of a recording have in common.

   The sound is x = f * h / rate, f the pulses of all strikes and nothing between them (a force window: between strikes the hammer does not touch), h from its strike on.
   Strikes that ring on into the next are so told apart: h is the least-squares solution over the whole recording (strikes_solve.h). Of strikes that stand alone it is the
   estimator H1 of modal testing, sum conj(F) X / sum |F|^2 (Ewins, Modal Testing, 2000, 3.9), with the regularisation. What a clipped strike's sound holds does not count; its
   pulse stays, as it rings on; so it is with strikes that ring unlike the others, as on another place. Without a force each strike is taken for an impulse as large as its sound's peak.

   h is as long as the ringing (strikes_end.c). Beyond `high` it is faded out over a third octave, for what is left there is the recording's noise divided by nearly nothing; so its beginning is
   smeared by about 3/high.

   noise: the longest quiet stretch of the sound (before the first strike, else below twice the quietest level), with the spectrum that the division gives to noise that is
   independent from strike to strike, sqrt(S) / (S + regularisation), S = sum |F|^2. */
#include "analysis/strikes_response.h"

#include <math.h>
#include <string.h>

#include "analysis/strikes_level.h"
#include "num/fft.h"

static const double alike = 0.3;          /* of a strike's sound: explained by the common response, else it is left out */
static const double arrival = 0.2;        /* of the response's greatest early value: where it begins */
static const double way = 0.02;           /* s, the longest way from force to sound */
static const double quiet_least = 0.03;   /* s of noise that tell its spectrum */
static const double unsolved = 1e-4;      /* of the gradient: more is told */

/* ------------------------------------------------------------------ which strikes */

static bool left_out(const struct strikes_job *j, const struct strikes_one *v, bool doubled)
{
    return v->clipped || (v->doubled && doubled && !j->r->force);
}

/* Which strikes count; of doubled ones alone all. */
static bool choose(struct strikes_job *j, struct err *e)
{
    const struct strikes *s = j->s;
    j->used = ARENA_TAKE(j->a, bool, s->n);
    for (int doubled = 1; doubled >= 0 && j->h->used == 0; doubled--)
        for (int k = 0; k < s->n; k++)
            j->h->used += j->used[k] = !left_out(j, &s->strike[k], doubled);
    return j->h->used > 0 || err_set(e, ERR_SCENE, "%s: no strike can be used: all are clipped", j->r->name);
}

/* ------------------------------------------------------------------ noise, delay */

static void find_quiet(struct strikes_job *j)
{
    const struct strikes_recording *r = j->r;
    struct strikes_level level = strikes_level(r->sound, r->n, r->rate, 0.01, j->a);
    double loud = 0.0;
    long least = (long)(quiet_least * r->rate);
    j->quiet_to = j->s->strike[0].onset - (long)(0.002 * r->rate);
    for (long k = 0; k < level.n; k++)
        loud += level.rms[k] / (double)level.n;
    if (j->quiet_to < least && level.floor < 0.1 * loud)
        strikes_level_quiet(&level, 2.0 * level.floor, &j->quiet_from, &j->quiet_to);
    if (j->quiet_to - j->quiet_from < least)
        j->quiet_from = j->quiet_to = 0;
}

static void take_noise(struct strikes_job *j)
{
    long n = j->quiet_to - j->quiet_from;
    double mean = 0.0;
    if (n == 0)
        return;
    j->h->noise_n = n;
    j->h->noise = ARENA_TAKE(j->a, double, n);
    for (long i = 0; i < n; i++)
        mean += j->r->sound[j->quiet_from + i] / (double)n;
    for (long i = 0; i < n; i++)
        j->h->noise[i] = (j->r->sound[j->quiet_from + i] - mean) * j->r->rate;
    strikes_band_fade(j, j->h->noise, n, true);
}

/* Takes the way off: what is before the arrival is dropped. */
static void take_delay(struct strikes_job *j)
{
    struct strikes_response *h = j->h;
    double most = 0.0, given = j->r->force ? j->r->delay : 0.0;
    long late = (long)(way * j->r->rate), shift = 0;
    if (late > h->length / 2)
        late = h->length / 2;
    for (long i = 0; i < late; i++)
        most = fmax(most, fabs(h->h[i]));
    if (isnan(given))
        while (shift < late && fabs(h->h[shift]) < arrival * most)
            shift++;
    else
        shift = (long)fmin(rint(given * j->r->rate), (double)h->length / 2.0);
    h->delay = (double)shift / j->r->rate;
    h->h += shift;
    h->length -= shift;
}

/* ------------------------------------------------------------------ all */

static void note(struct strikes_job *j, const char *text)
{
    j->h->note = j->h->note ? arena_format(j->a, "%s\n%s", j->h->note, text) : text;
}

static void solve(struct strikes_job *j)
{
    double left;
    j->h->h = ARENA_TAKE(j->a, double, j->h->length);
    j->left = ARENA_TAKE(j->a, double, j->r->n);
    strikes_solve(&j->system, j->h->h, &left);
    if (!(left <= unsolved))
        note(j, arena_format(j->a, "strikes are not wholly told apart: the search for the response that they have in common ended "
                             "at %.2g of what it began with, and what is left may look like modes; longer pauses between strikes help", left));
    strikes_solve_sound(&j->system, j->h->h, j->left);
    for (long i = 0; i < j->r->n; i++)
        j->left[i] = j->system.weight[i] > 0.0 ? j->r->sound[i] - j->left[i] : 0.0;
}

static void notes(struct strikes_job *j)
{
    int clipped = 0, doubled = 0, apart = 0;
    for (int k = 0; k < j->s->n; k++) {
        bool twice = j->s->strike[k].doubled && !j->r->force;
        clipped += j->s->strike[k].clipped;
        doubled += twice && !j->used[k] && !j->s->strike[k].clipped;
        apart += !j->used[k] && !j->s->strike[k].clipped && !twice;
    }
    if (clipped)
        note(j, arena_format(j->a, "%d of %d strikes clipped, and left out", clipped, j->s->n));
    if (doubled)
        note(j, arena_format(j->a, "%d of %d strikes doubled, and left out", doubled, j->s->n));
    if (apart)
        note(j, arena_format(j->a, "%d of %d strikes ring unlike the others (the response that all have in common explains less than %.0f %% of their sound), and are left out",
                             apart, j->s->n, 100 * alike));
    if (!j->h->noise)
        note(j, "nothing in the recording is quiet, so its noise is not known: a second of silence before the first strike tells it");
}

/* Mean square where nothing rings: noise, and what hums. */
static double quiet(const struct strikes_job *j)
{
    double sum = 0.0, n = (double)(j->quiet_to - j->quiet_from);
    for (long i = j->quiet_from; i < j->quiet_to; i++)
        sum += j->r->sound[i] * j->r->sound[i] / n;
    return sum;
}

double strikes_response_explained(const struct strikes_job *j, const struct strikes_one *v)
{
    double sound = 0.0, left = 0.0, noise = quiet(j);
    for (long i = v->onset; i < v->end && i < v->onset + j->system.length; i++) {
        sound += j->r->sound[i] * j->r->sound[i] - noise;
        left += j->left[i] * j->left[i] - noise;
    }
    return sound > 0.0 ? 1.0 - fmax(left, 0.0) / sound : 0.0;
}

/* Leaves out the strikes that ring unlike the others, while most agree; true: some were. */
static bool disagree(struct strikes_job *j)
{
    int good = 0, bad = 0;
    for (int k = 0; k < j->s->n; k++) {
        bool poor = j->used[k] && !(strikes_response_explained(j, &j->s->strike[k]) >= alike);
        bad += poor;
        good += j->used[k] && !poor;
    }
    if (bad == 0 || good < 2 || bad > good)
        return false;
    for (int k = 0; k < j->s->n; k++)
        j->used[k] = j->used[k] && strikes_response_explained(j, &j->s->strike[k]) >= alike;
    j->h->used = good;
    return true;
}

static void solve_all(struct strikes_job *j, double regularisation)
{
    do {
        strikes_system(j);
        j->h->regularisation = isnan(regularisation) ? fmax(j->floor / j->most, 1e-6) : regularisation;
        j->system.ridge = j->h->regularisation * j->most;
        solve(j);
    } while (disagree(j));
    for (long i = 0; i < j->h->length; i++)
        j->h->h[i] *= j->r->rate;
}

bool strikes_response(const struct strikes_recording *r, const struct strikes *s, double regularisation, struct arena *a, struct strikes_response *h, struct err *e)
{
    struct strikes_job j = {.r = r, .s = s, .a = a, .h = h};
    *h = (struct strikes_response){.low = 0.0, .high = 0.5 * r->rate};
    if (!choose(&j, e))
        return false;
    find_quiet(&j);
    h->length = strikes_end_length(&j);
    j.size = strikes_solve_size(r->n, h->length);
    j.system.n = r->n;
    j.system.length = h->length;
    j.system.sound = r->sound;
    solve_all(&j, regularisation);
    h->n = h->length - h->length % 2;
    strikes_band(&j);
    strikes_band_fade(&j, h->h, h->length, false);
    take_noise(&j);
    take_delay(&j);
    strikes_end(&j);
    h->rounding = r->rounding * r->rate / sqrt(j.most);
    strikes_band_coherence(&j);
    h->smear = h->high < 0.45 * r->rate ? 3.0 / h->high : 1.0 / r->rate;
    notes(&j);
    return true;
}
