/* From recordings to modes: responses, one length and band for all places, the fit, and what it explains.

   A response's first samples are smeared (strikes_response.h), and sample 0 of a sampled response is half of h(0+): the fit begins `skip` samples later, and each mode's
   complex gain is taken back to t = 0 by e^(-s t). */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "analysis/strikes_channel.h"
#include "cmd/modes_extract.h"
#include "num/real.h"

void modes_extract_find_note(struct modes_extract *x, const char *text)
{
    for (const char *line = text; line && *line; line = strchr(line, '\n') ? strchr(line, '\n') + 1 : NULL) {
        const char *one = arena_format(x->arena, "%.*s", (int)strcspn(line, "\n"), line);
        bool known = false;
        for (int k = 0; k < x->notes; k++)
            known = known || !strcmp(x->note[k], one);
        if (!known && x->notes < MODES_EXTRACT_NOTES)
            x->note[x->notes++] = one;
    }
}

static void place_note(struct modes_extract *x, const struct modes_extract_place *p, const char *text)
{
    for (const char *line = text; line && *line; line = strchr(line, '\n') ? strchr(line, '\n') + 1 : NULL)
        modes_extract_find_note(x, arena_format(x->arena, "%s: %.*s", p->name, (int)strcspn(line, "\n"), line));
}

/* ------------------------------------------------------------------ responses */

/* Samples before a response begins: what rises from the hundredth to the fifth of its greatest within 16 samples begins there, if all before is fainter. One more stays, as sample 0. */
static long begins(const double *h, long n, double most)
{
    long at = 0, start, before = 0;
    while (at < n && fabs(h[at]) < 0.2 * most)
        at++;
    for (start = at; start > 0 && fabs(h[start - 1]) >= 0.01 * most;)
        start--;
    while (before < start && fabs(h[before]) < 0.01 * most)
        before++;
    return before == start && start > 2 && at - start <= 16 ? start - 1 : 0;
}

/* A recording that is a response already: its delay is taken off; if none is given, what is silent before it. */
static bool impulse(struct modes_extract *x, struct modes_extract_place *p, struct err *e)
{
    const struct strikes_recording *r = &p->recording;
    double most = 0.0, clip[2];
    for (long i = 0; i < r->n; i++)
        most = fmax(most, fabs(r->sound[i]));
    long shift = isnan(x->given.delay) ? begins(r->sound, r->n, most) : (long)rint(x->given.delay * r->rate);
    most = 0.0;
    if (isnan(x->given.delay) && shift)
        place_note(x, p, arena_format(x->arena, "the response begins %.4g ms into the file: that is taken off (--delay 0 ms keeps it)", 1e3 * (double)shift / r->rate));
    if ((double)(r->n - shift) < 0.01 * r->rate)
        return err_set(e, ERR_SCENE, "%s lasts %.3g ms%s; a response takes at least 10 ms", r->name, 1e3 * (double)(r->n - shift) / r->rate, shift ? " behind --delay" : "");
    for (long i = shift; i < r->n; i++)
        most = fmax(most, fabs(r->sound[i]));
    if (most == 0.0)
        return err_set(e, ERR_SCENE, "%s: the response is silent (all samples are 0): is --channel right?", r->name);
    strikes_channel_clip(r->sound, r->n, clip);
    if (most >= 0.9999 * r->full || clip[0] < 0.0 || clip[1] > 0.0)
        place_note(x, p, "its greatest sample is as large as the file can hold, or stands in a row: it may be clipped");
    p->response = (struct strikes_response){.n = r->n - shift, .length = r->n - shift, .high = 0.5 * r->rate, .delay = (double)shift / r->rate, .smear = 1.0 / r->rate,
                                            .rounding = r->rounding};
    p->response.h = ARENA_TAKE(x->arena, double, p->response.n);
    memcpy(p->response.h, r->sound + shift, (size_t)p->response.n * sizeof *r->sound);
    return true;
}

/* Of what a strike together hold: how far do they agree? */
static void agreement(struct modes_extract *x, const struct modes_extract_place *p)
{
    double sum = 0.0, n = 0.0;
    for (int k = 0; k < p->strikes.n; k++)
        if (!isnan(p->response.explained[k])) {
            sum += p->response.explained[k];
            n++;
        }
    if (n > 1.0 && sum / n < 0.5)
        place_note(x, p, arena_format(x->arena, "the strikes have little in common (the common response explains %.0f %% of their sound): did they fall on one place, and did the "
                                                "microphone stay? Gains are a mean of what differs; frequencies and decays suffer less", 100.0 * sum / n));
}

static bool response(struct modes_extract *x, struct modes_extract_place *p, struct err *e)
{
    if (x->given.impulse)
        return impulse(x, p, e);
    place_note(x, p, strikes_channel_prepare(&p->recording, x->arena));
    if (!strikes_find(&p->recording, &x->given.strikes, x->arena, &p->strikes, e) ||
        !strikes_response(&p->recording, &p->strikes, x->given.regularisation, x->arena, &p->response, e))
        return false;
    place_note(x, p, p->strikes.note);
    place_note(x, p, p->response.note);
    agreement(x, p);
    return true;
}

/* One length, band and beginning of the fit for all. */
static bool common(struct modes_extract *x, struct err *e)
{
    const struct modes_extract_given *g = &x->given;
    long most = 0, least = x->place[0].response.length;
    double smear = 0.0;
    x->low = 0.0;
    x->high = 0.5 * x->rate;
    for (int k = 0; k < x->n; k++) {
        const struct strikes_response *h = &x->place[k].response;
        most = h->n > most ? h->n : most;
        least = h->length < least ? h->length : least;
        x->low = fmax(x->low, h->low);
        x->high = fmin(x->high, h->high);
        smear = fmax(smear, h->smear);
    }
    x->length = most < least ? most : least;
    x->skip = (long)ceil(smear * x->rate);
    if (g->high > x->high)
        modes_extract_find_note(x, arena_format(x->arena, "--high %g Hz lies beyond what the strikes hold, %.6g Hz", g->high, x->high));
    x->low = isnan(g->low) ? x->low : g->low;
    x->high = isnan(g->high) ? x->high : fmin(g->high, x->high);
    return x->low < x->high || err_set(e, ERR_SCENE, "nothing lies between %.6g and %.6g Hz: --low and --high, or the hammer's reach, leave no band", x->low, x->high);
}

/* ------------------------------------------------------------------ modes */

/* The error's spectrum of a response of p->n samples, of as much energy over the bins of n. */
static const double *unsure(const struct strikes_response *p, long n, struct arena *a)
{
    double *to = ARENA_TAKE(a, double, n / 2 + 1), share = (double)p->n / (double)n;
    for (long i = 0; i <= n / 2; i++) {
        long k = (long)rint((double)i * share);
        to[i] = p->unsure[k < p->n / 2 ? k : p->n / 2] * share;
    }
    return to;
}

static bool fit(struct modes_extract *x, struct err *e)
{
    struct ringing_options o = ringing_options;
    const double **h = arena_take(x->arena, (size_t)x->n, sizeof *h), **noise = arena_take(x->arena, (size_t)x->n, sizeof *noise);
    const double **error = arena_take(x->arena, (size_t)x->n, sizeof *error);
    double *rounding = ARENA_TAKE(x->arena, double, x->n);
    bool several = true;
    struct ringing r = {.places = x->n, .n = x->length - x->skip, .rate = x->rate, .h = h, .low = x->low, .high = x->high, .rounding = rounding};
    long most = 50;
    if (!args_whole(&x->c->args, "modes", (const long[2]){1, 100000}, &most, e))
        return false;
    r.noise_n = x->place[0].response.noise_n;
    for (int k = 0; k < x->n; k++) {
        const struct strikes_response *p = &x->place[k].response;
        h[k] = p->h + x->skip;
        rounding[k] = p->rounding;
        noise[k] = p->noise;
        several = several && p->unsure;
        error[k] = p->unsure ? unsure(p, r.n, x->arena) : NULL;
        r.noise_n = p->noise_n < r.noise_n ? p->noise_n : r.noise_n;
    }
    r.noise = r.noise_n ? noise : NULL;
    r.unsure = several ? error : NULL;
    o.most = (int)most;
    o.low = x->low;
    o.high = x->high;
    if (!x->given.slopes)
        o.slope_test = 0.0;
    return x->given.spectrogram ? ringing_spectrogram(&r, &o, x->arena, &x->heard, e) : ringing_esprit(&r, &o, x->arena, &x->heard, e);
}

/* Modes that have sunk by more than that before the response is sharp are no more than guessed at. */
static const double guessed = 2.0; /* nepers */

static void leave_out_guessed(struct modes_extract *x)
{
    struct ringing_modes *m = &x->heard;
    int kept = 0, last = 0, was = 0;
    for (int i = 0; i < m->n; i++)
        if (m->mode[i].decay * (double)x->skip / x->rate <= guessed)
            m->mode[kept++] = m->mode[i];
    if (kept < m->n)
        modes_extract_find_note(x, arena_format(x->arena, "%d components are left out that die away within the %.2g ms in which the response is not sharp", m->n - kept,
                                           1e3 * (double)x->skip / x->rate));
    m->n = kept;
    m->modes = 0;
    for (int i = 0; i < kept; i++) { /* numbered anew, without gaps */
        bool again = i > 0 && m->mode[i].mode == was;
        was = m->mode[i].mode;
        last = again ? last + 1 : 1;
        m->modes += !again;
        m->mode[i].mode = m->modes;
        m->mode[i].slope = last;
    }
}

/* From the fit's first sample to the strike. */
static void back_to_strike(struct modes_extract *x)
{
    double t = (double)x->skip / x->rate;
    for (int i = 0; i < x->heard.n; i++) {
        struct ringing_mode *m = &x->heard.mode[i];
        double size = real_exp(m->decay * t), c = size * real_cospi(2.0 * m->frequency * t), s = -size * real_sinpi(2.0 * m->frequency * t);
        for (int k = 0; k < x->n; k++) {
            double re = m->re[k], im = m->im[k];
            m->re[k] = re * c - im * s;
            m->im[k] = re * s + im * c;
            m->gain_error[k] *= size;
        }
        m->energy *= size * size;
    }
}

static int rising(const void *a, const void *b)
{
    double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

static double median_decay(const struct modes_extract *x)
{
    int n = x->heard.n;
    double *d = ARENA_TAKE(x->arena, double, n);
    for (int i = 0; i < n; i++)
        d[i] = x->heard.mode[i].decay;
    qsort(d, (size_t)n, sizeof *d, rising);
    return n % 2 ? d[n / 2] : 0.5 * (d[n / 2 - 1] + d[n / 2]);
}

static void compare(struct modes_extract *x)
{
    for (int k = 0; k < x->n; k++) {
        struct modes_extract_place *p = &x->place[k];
        double power = x->heard.noise ? x->heard.noise[k] * x->heard.noise[k] : 0.0;
        p->sound = ARENA_TAKE(x->arena, double, x->length);
        p->rest = ARENA_TAKE(x->arena, double, x->length);
        ringing_sound(&x->heard, k, x->rate, x->length, p->sound);
        p->sound[0] *= 0.5; /* as h */
        for (long i = 0; i < x->length; i++)
            p->rest[i] = p->response.h[i] - p->sound[i];
        p->distance = spectral_distance(p->response.h + x->skip, p->sound + x->skip, x->length - x->skip, &(struct spectral_distance_band){x->rate, x->low, x->high, power});
    }
}

static const double cancels = 1e4; /* energy of a mode over the response's: 40 dB more than there is */

/* Modes that together are no part of the responses are no table. A single place may be so weak that chance decides. */
static bool hold(struct modes_extract *x, struct err *e)
{
    double all = 0.0;
    bool cancel = false;
    for (int k = 0; k < x->n; k++) {
        const double *h = x->place[k].response.h;
        double energy = 0.0;
        for (long i = x->skip; i < x->length; i++)
            energy += h[i] * h[i];
        all += energy * x->heard.explained[k];
        for (int i = 0; i < x->heard.n; i++) {
            const struct ringing_mode *m = &x->heard.mode[i];
            cancel = cancel || (m->re[k] * m->re[k] + m->im[k] * m->im[k]) * x->rate > 4.0 * m->decay * cancels * energy;
        }
        if (x->heard.n > 0 && !(x->heard.explained[k] > 0.0))
            place_note(x, &x->place[k], "the modes do not hold the response: a narrower band (--low, --high) or fewer --modes help");
    }
    return x->heard.n == 0 || (all >= 0.0 && !cancel) || err_set(e, ERR_SCENE, "%s: the modes that were found do not hold the response (they leave more than there is, or are far greater and cancel), so there is no table: does it begin "
                                                    "at the strike (--delay)? Else a narrower band (--low, --high) or fewer --modes help", x->place[0].shown);
}

bool modes_extract_find(struct modes_extract *x, struct err *e)
{
    for (int k = 0; k < x->n; k++)
        if (!response(x, &x->place[k], e))
            return false;
    if (!common(x, e) || !fit(x, e))
        return false;
    if (!hold(x, e))
        return false;
    leave_out_guessed(x);
    if (x->heard.n == 0)
        return err_set(e, ERR_SCENE, "%s: no mode stands out of the noise between %.6g and %.6g Hz", x->place[0].shown, x->low, x->high);
    back_to_strike(x);
    modes_extract_find_note(x, x->heard.note);
    x->median_decay = median_decay(x);
    compare(x);
    return true;
}
