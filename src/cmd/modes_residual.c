/* rasp modes residual RECORDING TABLE -o FOLDER: what a recorded strike holds besides the modes of the table
   (papers/003 D.1), as a folder that scenes name as surface.residual.

   Each mode of the table is fitted to the strike anew, pole as it is, gain and phase its own (analysis/modal.h): so the
   table may be of several strikes, or of another place. It is represented as far as modes of the fitted object
   (--estimated) match it in frequency and damping: amplitude times R_i (analysis/feature_match.h), all of it without
   --estimated.

   By time, the represented sound is subtracted as a scene makes it (direct term and all), for its phases are known;
   then noise is taken off, as the lead before the strike shows it: each pixel of the spectrogram (num/stft.h) times
   sqrt(1 - P_noise/P), P the mean of 3 x 3, and what is not 6 dB above the noise is 0, nor 3 dB in the mean of 9 x 9:
   of noise alone chance leaves next to nothing (a hundredth where the lead is 0.1 s), where 3 dB in 3 x 3 left a tenth,
   which the division by the force made a hiss. By power, as printed: P_recording - P_represented, where the paper does
   not say that it falls below 0, as it does wherever phases differ; here it stops there, and has the recording's
   phases.

   That is the sound of the strike's own force. What scenes take is a response, as the modes are: where the force was
   recorded, it is divided out (num/deconvolve.h), as far as it reaches. Where it is 40 dB below its strongest the
   response is half of what it was, and fades beyond; how far it holds is measured and reported. */
#include <errno.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "analysis/feature_match.h"
#include "base/interrupt.h"
#include "base/outfile.h"
#include "base/relpath.h"
#include "base/text.h"
#include "cmd/modes_extract.h"
#include "cmd/report.h"
#include "convolution/alias.h"
#include "file/wav.h"
#include "num/deconvolve.h"
#include "num/fft.h"
#include "num/real.h"
#include "num/scaled.h"
#include "num/stft.h"
#include "response/mode_table.h"
#include "response/residual.h"
#include "scene/keys_yaml.h"

enum { BY_TIME, BY_POWER };
enum { LEAD_FRAMES = 4 }; /* that show the noise */

static const double fade = 0.005;   /* s at the end */
static const double nothing = 1e-8; /* of the energy: a tail of less is cut */
#define THIRD_LOWEST 100.0          /* Hz */
#define THIRD 1.2599210498948732    /* 2^(1/3) */
#define OWN 0.97                    /* share of a strike's sound that is its own */
#define AUDIBLE (-20.0)             /* dB, of what earlier strikes left */
#define LITTLE (-1.0)               /* dB that are left: a table of another object */

struct table { /* features of a mode table */
    const char *file, *name;
    char hash[HASH_TEXT];
    int n;
    struct feature *feature;
    bool hum;      /* a recording it is of had one */
    int quantity;  /* enum modes_quantity */
    double radius; /* m, of a monopole that is divided out; NAN: none */
};

struct job {
    struct cmd_call *c;
    struct arena *arena;
    struct modes_extract x;
    struct modes_extract_place *place;
    const char *folder;
    int domain;
    bool keeps_noise;
    struct table table, estimated;
    int outside; /* modes of the table that lie outside the band that is fitted */
    struct feature_match match;
    double *ratio;                                    /* [table.n] R_i; 0 of one outside */
    cplx *gain;                                       /* [table.n][stretches] */
    int stretch;                                      /* of the strike */
    long start, length;                               /* samples of the recording, of the strike's sound */
    double *recorded, *represented, *left, *residual; /* [length] */
    double earlier;                                   /* dB of the recording, what earlier strikes left; NAN: nothing */
    double *response;                                 /* [length] the residual by the strike's force */
    double reach;                                     /* Hz, up to which that is the residual's; NAN: no force */
    double *noise;                                    /* [bins] power; NULL: no lead shows it, or it is kept */
    double variance;                                  /* of the lead; NAN: there is none */
    double sounds, gains;                             /* factors of the response and gains, for the unit */
    double recorded_as;                               /* factor of what the strike sounds, to be as its file is */
    char hashes[4][HASH_TEXT];
    const char *temporary;
};

static const struct modal_stretch *stretch_of(const struct job *j) { return &j->x.data.stretch[j->stretch]; }

static const struct strikes_one *strike_of(const struct job *j)
{
    return &j->place->strikes.strike[stretch_of(j)->strike];
}

/* ------------------------------------------------------------------ tables */

/* Each slope of a mode is a feature: with its pole where it is strongest, and the energy of all places together. */
static bool table_read(struct job *j, const char *file, struct table *to, struct err *e)
{
    struct mode_table t;
    int most = 0;
    to->file = file;
    to->name = strrchr(file, '/') ? strrchr(file, '/') + 1 : file;
    if (!mode_table_read(file, j->arena, &t, e) || !hash_file(file, to->hash, e)) return false;
    to->hum = csv_comment(&t.csv, "hum") != NULL;
    to->quantity = t.quantity;
    to->radius = t.radius;
    for (const struct mode_entry *v = t.entry; v < t.entry + t.first[t.places]; v++)
        most = v->n > most ? v->n : most;
    struct feature *all = ARENA_TAKE(j->arena, struct feature, t.modes * (size_t)most);
    double *strongest = ARENA_TAKE(j->arena, double, t.modes *(size_t)most);
    for (const struct mode_entry *v = t.entry; v < t.entry + t.first[t.places]; v++)
        for (int i = 0; i < v->n; i++) {
            size_t k = v->mode * (size_t)most + (size_t)i;
            double energy = v->slope[i].gain * v->slope[i].gain / (4.0 * v->slope[i].decay);
            if (!(v->slope[i].decay > 0.0 && isfinite(energy)))
                return err_set(e, ERR_SCENE, "%s: a mode at %.6g Hz does not decay, and leaves no residual", file,
                               v->frequency);
            if (all[k].decay == 0.0 || energy > strongest[k]) {
                all[k].frequency = v->frequency;
                all[k].decay = v->slope[i].decay;
                strongest[k] = energy;
            }
            all[k].energy += energy;
        }
    for (size_t k = 0; k < t.modes * (size_t)most; k++)
        if (all[k].decay > 0.0) all[to->n++] = all[k];
    to->feature = all;
    return true;
}

/* ------------------------------------------------------------------ the strike */

/* How much of what sounds from a strike on is its own: 1 less the mean power of the 20 ms before its onset, over that.
 */
static double own_share(const struct job *j, const struct modal_stretch *st)
{
    const double *x = j->place->recording.sound.x;
    long onset = j->place->strikes.strike[st->strike].onset +
                 (j->x.given.force_channel ? (long)rint(j->place->delay * j->x.rate) : 0),
         n = (long)(0.02 * j->x.rate), before = onset < n ? onset : n, length = st->first + st->n - onset;
    if (before < 1) return 1.0;
    double earlier = scaled_squares(x + onset - before, before) / (double)before,
           all = scaled_squares(x + onset, length) / (double)length;
    return fmax(1.0 - earlier / all, 1e-3);
}

/* The loudest that is neither doubled nor clipped nor begins while much of an earlier one rings, else the loudest. */
static void choose(struct job *j)
{
    double most = -1.0;
    j->stretch = -1;
    for (int s = 0; s < j->x.data.stretches; s++) {
        const struct modal_stretch *st = &j->x.data.stretch[s];
        if (st->strike < 0 || !st->fitted) continue;
        const struct strikes_one *v = &j->place->strikes.strike[st->strike];
        double own = own_share(j, st),
               worth = v->peak * (own < OWN ? 1e-3 * own : 1.0) * (v->doubled || v->clipped ? 1e-6 : 1.0);
        if (worth <= most) continue;
        most = worth;
        j->stretch = s;
    }
    const struct modal_stretch *st = stretch_of(j);
    const struct strikes_one *v = strike_of(j);
    bool force = j->x.given.force_channel, response = j->x.given.impulse;
    j->start = v->onset + (force ? (long)rint(j->place->delay * j->x.rate) : 0);
    j->length = st->first + st->n - j->start;
    j->sounds = response ? 1.0 : 1.0 / (force ? v->momentum : v->peak);
    j->recorded_as = isnan(j->x.given.scale) ? 1.0 : 1.0 / (j->x.given.scale * j->place->gain);
    j->gains = response ? 1.0 : force ? j->x.rate : 1.0 / v->peak;
}

/* Seconds by which the sound sets in before the residual begins: in the 30 ms before it reaches a tenth of its peak,
   and twice what it was in the 30 ms before these; 0: it does not. */
static double before_start(const struct job *j)
{
    const double *x = j->place->recording.sound.x;
    long ms = (long)(0.001 * j->x.rate), from = j->start > 30 * ms ? j->start - 30 * ms : 0, first = j->start;
    double peak = 0.0, earlier = 0.0;
    for (long i = j->start; i < j->start + j->length && i < j->start + 50 * ms; i++)
        peak = fmax(peak, fabs(x[i]));
    for (long i = from > 30 * ms ? from - 30 * ms : 0; i < from; i++)
        earlier = fmax(earlier, fabs(x[i]));
    for (long i = j->start - 1; i >= from; i--)
        if (fabs(x[i]) > 0.1 * peak && fabs(x[i]) > 2.0 * earlier) first = i;
    return (double)(j->start - first) / j->x.rate;
}

static double decibel(double power, double reference)
{
    return power > 0.0 && reference > 0.0 ? 10.0 * real_log10(power / reference) : NAN;
}

/* What strike s makes of a mode, times `factor`, is added to y[n], whose first sample is j->start. */
static void ring(const struct job *j, int s, cplx pole, cplx gain, double *y)
{
    const struct modal_stretch *st = &j->x.data.stretch[s];
    cplx p = cplx_exp(pole, 1.0 / j->x.rate), x = {0};
    long from = st->pulse.at, end = j->start + j->length;
    if (!j->x.given.impulse && !j->x.given.force_channel) { /* back to the strike */
        from = j->place->strikes.strike[st->strike].onset;
        gain = cplx_mul(gain, cplx_exp(pole, -(double)(st->pulse.at - from) / j->x.rate));
    }
    for (long n = from; n < end; n++) {
        long k = n - from;
        x = cplx_mul(p, x);
        if (k < st->pulse.n) x.re += st->pulse.f[k];
        if (n >= j->start) y[n - j->start] += gain.re * x.im + gain.im * x.re;
    }
}

/* What a scene makes of the modes besides that, added to y: half of a jump, the direct term of an acceleration or
   pressure, and what sampling folds back is taken out (convolution/resonators.c, alias.c); of an impulse response, of
   which the first sample counts half, the direct term. gain: of the strike. */
static void ring_exactly(const struct job *j, int n, const cplx *pole, const cplx *gain, double *y)
{
    const struct modal_pulse *p = &stretch_of(j)->pulse;
    struct arena *a = arena_open();
    const double per = j->x.given.impulse ? 1.0 : j->x.rate;
    struct alias *alias = alias_make(a, 1, j->x.rate);
    struct modes_point at = modes_point_make(a, n);
    double tap[ALIAS_TAPS] = {0};
    for (int i = 0; i < n; i++) {
        at.frequency[i] = pole[i].im / (2.0 * REAL_PI);
        at.decay[i] = -pole[i].re;
        at.re[i] = gain[i].re * per;
        at.im[i] = gain[i].im * per;
        tap[ALIAS_REACH] -= 0.5 * gain[i].im;
        alias_add(alias, at.frequency[i], at.decay[i], (const double[2]){at.re[i], at.im[i]}, tap);
    }
    double direct = modes_direct(j->x.given.quantity, n, at.frequency, at.decay, &at);
    if (j->x.given.impulse) y[0] += 2.0 * j->x.rate * direct;
    tap[ALIAS_REACH] += direct;
    for (long i = 0; i < p->n && !j->x.given.impulse; i++)
        for (int k = 0; k < ALIAS_TAPS; k++) {
            long at_sample = p->at + i + k - ALIAS_REACH - j->start;
            if (at_sample >= 0 && at_sample < j->length) y[at_sample] += tap[k] * p->f[i];
        }
    arena_close(a);
}

/* Gains of the table's modes, the represented sound, and what it leaves; what earlier strikes left ringing is no
   residual, and is taken off whole. */
static bool subtract(struct job *j, struct modal_options *o, struct err *e)
{
    int n = j->table.n, stretches = j->x.data.stretches, inside = 0, *of = ARENA_TAKE(j->arena, int, n);
    cplx *pole = ARENA_TAKE(j->arena, cplx, n), *gain = ARENA_TAKE(j->arena, cplx, n * stretches),
         *own = ARENA_TAKE(j->arena, cplx, n);
    for (int i = 0; i < n; i++) {
        const struct feature *f = &j->table.feature[i];
        if (f->frequency < j->x.low || f->frequency > j->x.high) continue;
        of[inside] = i;
        pole[inside++] = (cplx){-f->decay, 2.0 * REAL_PI * f->frequency};
    }
    j->outside = n - inside;
    if (!inside)
        return err_set(e, ERR_SCENE, "%s: no mode of %s lies in the band that is fitted, %.6g to %.6g Hz",
                       j->place->shown, j->table.file, j->x.low, j->x.high);
    o->most = inside;
    o->fastest = 1e9; /* of a table any decay is a mode's */
    modal_gains(&j->x.data, o, inside, pole, gain);
    j->gain = ARENA_TAKE(j->arena, cplx, n * stretches);
    j->recorded = ARENA_TAKE(j->arena, double, j->length);
    j->represented = ARENA_TAKE(j->arena, double, j->length);
    j->left = ARENA_TAKE(j->arena, double, j->length);
    memcpy(j->recorded, j->place->recording.sound.x + j->start, (size_t)j->length * sizeof *j->recorded);
    double *earlier = ARENA_TAKE(j->arena, double, j->length);
    for (int i = 0; i < inside; i++) {
        struct feature *f = &j->table.feature[of[i]];
        memcpy(j->gain + of[i] * stretches, gain + i * stretches, (size_t)stretches * sizeof *gain);
        f->energy = cplx_square(gain[i * stretches + j->stretch]) / (4.0 * f->decay);
        for (int s = 0; s < j->stretch; s++)
            if (j->x.data.stretch[s].strike >= 0) ring(j, s, pole[i], gain[i * stretches + s], earlier);
    }
    j->earlier = decibel(scaled_squares(earlier, j->length), scaled_squares(j->recorded, j->length));
    scaled_add(j->recorded, -1.0, earlier, j->length);
    j->ratio = ARENA_TAKE(j->arena, double, n);
    if (j->estimated.file)
        feature_match(j->table.feature, n, j->estimated.feature, j->estimated.n, NULL, j->arena, &j->match);
    for (int i = 0; i < inside; i++)
        j->ratio[of[i]] = j->estimated.file ? j->match.reference[of[i]] : 1.0;
    for (int i = 0; i < inside; i++) {
        own[i] = cplx_scale(j->ratio[of[i]], gain[i * stretches + j->stretch]);
        ring(j, j->stretch, pole[i], own[i], j->represented);
    }
    if (j->x.given.force_channel || j->x.given.impulse) ring_exactly(j, inside, pole, own, j->represented);
    for (long i = 0; i < j->length; i++)
        j->left[i] = j->recorded[i] - j->represented[i];
    return true;
}

/* ------------------------------------------------------------------ noise, and power */

/* Mean power of the frames that lie within the lead. */
static void listen(struct job *j)
{
    const struct modal_stretch *lead = &j->x.data.stretch[j->place->first];
    j->variance = NAN;
    if (lead->strike >= 0) return;
    j->variance = scaled_squares(lead->y, lead->n) / (double)lead->n;
    struct arena *a = arena_open();
    struct stft *s = stft_open(lead->n, j->x.rate, 1, a);
    int frames = s->frames - 2 * STFT_ONSET;
    if (frames >= LEAD_FRAMES && !j->keeps_noise) {
        long count = (long)s->frames * s->bins;
        double *re = ARENA_TAKE(a, double, count), *im = ARENA_TAKE(a, double, count);
        stft_forward(s, lead->y, re, im);
        stft_power(re, im, count, re);
        j->noise = ARENA_TAKE(j->arena, double, s->bins);
        for (int m = STFT_ONSET; m < STFT_ONSET + frames; m++)
            scaled_add(j->noise, 1.0 / frames, re + (long)m * s->bins, s->bins);
    }
    stft_close(s);
    arena_close(a);
}

/* Of the pixels up to `far` frames and bins away. */
static double mean_about(const double *power, const struct stft *s, int m, int k, int far)
{
    double sum = 0.0;
    int terms = 0;
    for (int i = m > far ? m - far : 0; i <= m + far && i < s->frames; i++)
        for (int l = k > far ? k - far : 0; l <= k + far && l < s->bins; l++, terms++)
            sum += power[(long)i * s->bins + l];
    return sum / terms;
}

static void compensate(struct job *j)
{
    struct arena *a = arena_open();
    struct stft *s = stft_open(j->length, j->x.rate, 1, a);
    long count = (long)s->frames * s->bins;
    double *re = ARENA_TAKE(a, double, count), *im = ARENA_TAKE(a, double, count),
           *power = ARENA_TAKE(a, double, count), *whole = ARENA_TAKE(a, double, count);
    j->residual = ARENA_TAKE(j->arena, double, j->length);
    if (j->domain == BY_POWER) {
        stft_forward(s, j->represented, re, im);
        stft_power(re, im, count, power);
    }
    stft_forward(s, j->domain == BY_POWER ? j->recorded : j->left, re, im);
    stft_power(re, im, count, whole);
    for (long i = 0; i < count; i++)
        power[i] = fmax(whole[i] - power[i], 0.0);
    for (int m = 0; m < s->frames; m++)
        for (int k = 0; k < s->bins; k++) {
            long i = (long)m * s->bins + k;
            double mean = mean_about(power, s, m, k, 1), noise = j->noise ? j->noise[k] : 0.0;
            bool sounds = mean > 4.0 * noise && whole[i] > 0.0 && mean_about(power, s, m, k, 4) > 2.0 * noise;
            double gain = sounds ? sqrt((1.0 - noise / mean) * power[i] / whole[i]) : 0.0;
            re[i] *= gain;
            im[i] *= gain;
        }
    stft_inverse(s, re, im, j->residual);
    stft_close(s);
    arena_close(a);
    long last = j->length, end = (long)(fade * j->x.rate);
    double tail = 0.0, all = scaled_squares(j->residual, j->length);
    while (last > 2 * end && tail + j->residual[last - 1] * j->residual[last - 1] <= nothing * all)
        tail += j->residual[last - 1] * j->residual[last - 1], last--;
    for (long i = 0; i < end && i < last; i++)
        j->residual[last - 1 - i] *= real_sinpi(0.5 * (double)i / (double)end);
    j->length = last;
}

/* Is there a force to divide by? */
static bool divided(const struct job *j) { return j->x.given.force_channel && stretch_of(j)->pulse.n; }

/* |X|^2 of y[n] in third octaves from 100 Hz, up to half the rate; returns how many. */
static int thirds(const struct job *j, const double *y, long n, long size, double *power)
{
    struct arena *a = arena_open();
    const double *bin = modes_extract_find_power(y, n, size, a);
    int bands = 0;
    for (double low = THIRD_LOWEST; low * THIRD < 0.5 * j->x.rate; low *= THIRD, bands++) {
        power[bands] = 0.0;
        for (long k = (long)ceil(low * (double)size / j->x.rate); (double)k < low * THIRD * (double)size / j->x.rate;
             k++)
            power[bands] += bin[k];
    }
    arena_close(a);
    return bands;
}

/* Hz: up to there what the force makes of the response lacks 3 dB at most, in third octaves, of the residual; of those
   within 40 dB of the loudest. NAN: there is none. */
static double reach(const struct job *j, const double *response)
{
    const struct modal_pulse *p = &stretch_of(j)->pulse;
    struct arena *a = arena_open();
    long size = (long)fft_good_size((size_t)(j->length + p->n));
    double *again = ARENA_TAKE(a, double, j->length), found[64], wanted[64], top = NAN, edge = THIRD_LOWEST;
    for (long k = 0; k < p->n; k++)
        if (k < j->length) scaled_add(again + k, p->f[k], response, j->length - k);
    int n = thirds(j, again, j->length, size, found);
    thirds(j, j->residual, j->length, size, wanted);
    double least = n > 0 ? 1e-4 * gsl_stats_max(wanted, 1, (size_t)n) : 0.0;
    for (int i = 0; i < n; i++) {
        edge *= THIRD;
        if (!(wanted[i] > least)) continue;
        if (found[i] < 0.5 * wanted[i]) break;
        top = edge;
    }
    arena_close(a);
    return top;
}

/* The residual as a response: by the force, of amplitude 1 at 0 Hz. Without a force it is as it is. */
static void divide(struct job *j)
{
    const struct modal_pulse *p = &stretch_of(j)->pulse;
    j->response = j->residual;
    j->reach = NAN;
    if (!divided(j)) return;
    double sum = 0.0;
    for (long k = 0; k < p->n; k++)
        sum += p->f[k];
    j->response = ARENA_TAKE(j->arena, double, j->length);
    deconvolve(j->residual, j->length, p->f, p->n, MODES_EXTRACT_REACH, j->response);
    j->reach = reach(j, j->response);
    j->response[0] *= 2.0; /* the first sample of a response counts half (response/ir.h) */
    for (long i = 0; i < j->length; i++)
        j->response[i] *= sum;
}

/* ------------------------------------------------------------------ the folder */

static const char *per(const struct job *j)
{
    return j->x.given.impulse          ? "N s, an impulse response"
           : !j->x.given.force_channel ? "strike whose sound has the peak 1"
           : isnan(j->x.given.scale)   ? "full scale of the force times second"
                                       : "N s";
}

/* What its level lacks to be one per N s; NULL: nothing. */
static const char *why_not(const struct job *j)
{
    if (!j->x.given.impulse && !j->x.given.force_channel) return MODES_EXTRACT_NO_FORCE;
    return isnan(j->x.given.scale) ? "--scale, and with a force --force-scale, are not given" : NULL;
}

static const char *at(const struct job *j, const char *name)
{
    return arena_format(j->arena, "%s/%s", j->temporary, name);
}

/* other: a second channel, or NULL. */
static bool write_sound(struct job *j, const char *name, double factor, const double *x, const double *other,
                        struct err *e)
{
    int channels = other ? 2 : 1;
    struct wav_format f = {
        .rate = j->x.rate, .channels = channels, .bits = -32, .comment = "rasp: by rasp modes residual"};
    double *scaled = ARENA_TAKE(j->arena, double, channels * j->length);
    struct wav_out *w = wav_create(at(j, name), &f, e);
    for (long i = 0; i < j->length; i++) {
        scaled[channels * i] = factor * x[i];
        if (other) scaled[channels * i + 1] = factor * other[i];
    }
    if (!w) return false;
    if (wav_write(w, scaled, (size_t)j->length, e)) return wav_commit(w, e);
    wav_drop(w);
    return false;
}

/* Of a mode, in the strike's sound, times 4. */
static double strike_energy(const struct job *j, int i)
{
    const struct modal_pulse *p = &stretch_of(j)->pulse;
    double turn = 2.0 * REAL_PI * j->table.feature[i].frequency / j->x.rate, re = 0.0, im = 0.0;
    for (long k = 0; k < p->n; k++) {
        re += p->f[k] * real_cos(turn * (double)k);
        im += p->f[k] * real_sin(turn * (double)k);
    }
    return cplx_square(j->gain[i * j->x.data.stretches + j->stretch]) / j->table.feature[i].decay * (re * re + im * im);
}

static void modes_write(FILE *f, const struct job *j)
{
    double all = 0.0;
    for (int i = 0; i < j->table.n; i++)
        all += strike_energy(j, i);
    fprintf(f, "# quantity: %s per %s\n# source: %s, sha256 %s\n", modes_quantity_name(j->x.given.quantity), per(j),
            text_shown(j->arena, j->table.name), j->table.hash);
    fputs("frequency_hz,decay_per_s,gain,phase_rad,match_ratio,strike_energy\n", f);
    for (int i = 0; i < j->table.n; i++) {
        const struct feature *m = &j->table.feature[i];
        cplx a = cplx_scale(j->gains, j->gain[i * j->x.data.stretches + j->stretch]);
        fprintf(f, "%.9g,%.9g,%.9g,%.9g,%.9g,%.6g\n", m->frequency, m->decay, cplx_abs(a),
                cplx_abs(a) > 0.0 ? real_atan2(a.im, a.re) : 0.0, j->ratio[i], strike_energy(j, i) / all);
    }
}

struct figures { /* of the strike's sound, dB relative to the recording's energy; NAN: not known, or nothing */
    double represented, left, noise, residual, least, mean;
};

static struct figures figures(const struct job *j, long length)
{
    double all = scaled_squares(j->recorded, length), sum = 0.0;
    struct figures f = {decibel(scaled_squares(j->represented, length), all),
                        decibel(scaled_squares(j->left, length), all),
                        decibel(j->variance * (double)length, all),
                        decibel(scaled_squares(j->residual, j->length), all),
                        1.0,
                        0.0};
    for (int i = 0; i < j->table.n; i++) {
        f.least = fmin(f.least, j->ratio[i]);
        sum += j->ratio[i];
    }
    f.mean = sum / j->table.n;
    return f;
}

static void yaml_number(FILE *f, const char *key, double x)
{
    if (!isnan(x)) fprintf(f, "%s: %.6g\n", key, x);
}

static void yaml_file(FILE *f, const struct job *j, const char *name, const char *hash)
{
    fprintf(f, "  - {file: %s, sha256: \"%s\"}\n", keys_yaml_quoted(name, j->arena), hash);
}

static void yaml_write(FILE *f, const struct job *j, const struct figures *g)
{
    static const char *const names[] = {RESIDUAL_WAV, RESIDUAL_MODES, RESIDUAL_STRIKE};
    const struct strikes_one *v = strike_of(j);
    const char *lacks = why_not(j);
    fprintf(
        f,
        "# What a strike sounds besides its modes, by rasp modes residual: for surface.residual of a scene.\n%s: %s\n",
        RESIDUAL_FORMAT, RESIDUAL_VERSION);
    fprintf(f, "sample_rate: %.9g\nquantity: %s\nper: %s\nphysical: %s\n", j->x.rate,
            modes_quantity_name(j->x.given.quantity), per(j), lacks ? "false" : "true");
    if (lacks) fprintf(f, "why_not: %s\n", lacks);
    fprintf(f, "strike: %d\n", stretch_of(j)->strike + 1);
    yaml_number(f, "onset_s", (double)v->onset / j->x.rate);
    yaml_number(f, j->x.given.force_channel ? "momentum" : "peak", j->x.given.force_channel ? v->momentum : v->peak);
    if (j->place->placed) fprintf(f, "place_m: [%.9g, %.9g]\n", j->place->x, j->place->y);
    fprintf(f, "domain: %s\nnoise: %s\n", j->domain == BY_POWER ? "power" : "time", j->noise ? "taken off" : "kept");
    if (!isnan(j->reach))
        fprintf(f, "force_divided_out_to_hz: %.6g  # above, it is more than 3 dB too soft\n", j->reach);
    fprintf(f, "modes: %d\n", j->table.n);
    yaml_number(f, "match_ratio_mean", g->mean);
    yaml_number(f, "match_ratio_least", g->least);
    if (j->estimated.file) yaml_number(f, "match_ratio_by_energy", j->match.represented);
    if (j->estimated.file) yaml_number(f, "match_score", j->match.score);
    yaml_number(f, "earlier_db", j->earlier);
    yaml_number(f, "represented_db", g->represented);
    yaml_number(f, "left_db", g->left);
    yaml_number(f, "noise_db", g->noise);
    yaml_number(f, "residual_db", g->residual);
    fputs("inputs:\n", f);
    yaml_file(f, j, j->place->name, j->place->hash);
    yaml_file(f, j, j->table.name, j->table.hash);
    if (j->estimated.file) yaml_file(f, j, j->estimated.name, j->estimated.hash);
    fputs("files:\n", f);
    for (int k = 0; k < 3; k++)
        yaml_file(f, j, names[k], j->hashes[k]);
}

static bool write_files(struct job *j, const struct figures *g, struct err *e)
{
    static const char *const names[] = {RESIDUAL_WAV, RESIDUAL_MODES, RESIDUAL_STRIKE};
    struct outfile *o = ARENA_TAKE(j->arena, struct outfile, 1);
    if (!write_sound(j, RESIDUAL_WAV, j->sounds, j->response, NULL, e) ||
        !write_sound(j, RESIDUAL_STRIKE, j->recorded_as, j->represented, j->residual, e) ||
        !outfile_open(o, at(j, RESIDUAL_MODES), e))
        return false;
    modes_write(o->stream, j);
    if (!outfile_commit(o, e)) return false;
    for (int k = 0; k < 3; k++)
        if (!hash_file(at(j, names[k]), j->hashes[k], e)) return false;
    if (!outfile_open(o, at(j, RESIDUAL_YAML), e)) return false;
    yaml_write(o->stream, j, g);
    return outfile_commit(o, e);
}

/* Whole, and in the place of one that is there, or not at all. */
static bool write_folder(struct job *j, const struct figures *g, struct err *e)
{
    j->temporary = outfile_folder_open(j->folder, j->arena, e);
    return j->temporary && outfile_folder_close(j->folder, j->temporary, write_files(j, g, e), j->arena, e);
}

/* ------------------------------------------------------------------ the report */

static const char *shown(const struct job *j, double x, const char *otherwise)
{
    return isnan(x) ? otherwise : arena_format(j->arena, "%.2f dB", x);
}

static void warn(struct job *j, const struct figures *g)
{
    double early = before_start(j);
    int quantity = j->x.given.quantity, of = quantity; /* of the table that modes extract makes of such a recording */
    if (quantity == MODES_PRESSURE) of = isnan(j->table.radius) ? MODES_ACCELERATION : MODES_VELOCITY;
    if (of != j->table.quantity)
        modes_extract_find_note(
            &j->x, NULL,
            arena_format(j->arena,
                         "the recording is taken as one of %s, and the table is of %s: give --quantity as for modes "
                         "extract, unless the two are of different sensors",
                         modes_quantity_name(quantity), modes_quantity_name(j->table.quantity)));
    if (early > 0.0)
        modes_extract_find_note(
            &j->x, NULL,
            arena_format(j->arena, "the sound sets in %.2g s before the %s%s: what is there is lost", early,
                         j->x.given.force_channel ? "force" : "onset",
                         j->x.given.force_channel && j->place->delay > 0.0 ? " and its delay" : ""));
    if (j->earlier > AUDIBLE)
        modes_extract_find_note(
            &j->x, NULL,
            arena_format(j->arena,
                         "what earlier strikes left ringing is %.1f dB of this one's sound: it is taken off, as far as "
                         "the table's modes hold it; leave more time between strikes, or take the first (--strikes 1)",
                         j->earlier));
    if (strike_of(j)->doubled && !divided(j))
        modes_extract_find_note(&j->x, NULL,
                                "the strike is doubled, and no other can be used: its second blow is in the residual");
    if (j->table.hum && !j->noise && !j->keeps_noise)
        modes_extract_find_note(
            &j->x, NULL,
            "the recording has a hum, and no silence before the strike shows it: it is in the residual, "
            "and would sound with every contact; record again, with 0.3 s before the strike");
    if (isnan(g->residual))
        modes_extract_find_note(&j->x, NULL, "nothing is left above the noise: the residual is silent");
    if (g->left > LITTLE)
        modes_extract_find_note(
            &j->x, NULL,
            "the table's modes take less than a fifth of the sound off: is the table of this object, "
            "and the recording one of a strike?");
}

static void report(const struct job *j, const struct figures *g, bool json, struct err *e)
{
    const struct strikes_one *v = strike_of(j);
    const char *lacks = why_not(j), *strike = "";
    struct report r = report_open(stdout, json);
    double seconds = (double)j->length / j->x.rate, onset = (double)v->onset / j->x.rate;
    report_set(
        &r,
        "folder:s recording:s table:s estimated:s strike:i onset_s:n start_s:n momentum:n peak:n quantity:s per:s "
        "physical:b seconds:n modes:i outside:i",
        j->folder, j->place->shown, j->table.file, j->estimated.file, stretch_of(j)->strike + 1, onset,
        (double)j->start / j->x.rate, v->momentum, v->peak, modes_quantity_name(j->x.given.quantity), per(j), !lacks,
        seconds, j->table.n, j->outside);
    report_set(&r, "force_divided_out_to_hz:n", j->reach);
    report_set(&r, "noise_removed:b match_ratio_mean:n match_ratio_least:n match_ratio_by_energy:n match_score:n",
               j->noise != NULL, g->mean, g->least, j->estimated.file ? j->match.represented : 1.0,
               j->estimated.file ? j->match.score : 1.0);
    report_set(&r, "earlier_db:n represented_db:n left_db:n noise_db:n residual_db:n", j->earlier, g->represented,
               g->left, g->noise, g->residual);
    report_set(&r, "warnings:t", j->x.note, j->x.notes);
    report_list(&r, "match_ratios");
    for (int i = 0; i < j->table.n; i++)
        report_set(&r, ":n", j->ratio[i]);
    report_end(&r);
    if (!j->x.given.impulse) strike = arena_format(j->arena, ", strike %d at %.4f s", stretch_of(j)->strike + 1, onset);
    report_text(&r, "%s%s: %d modes of %s\n", j->place->shown, strike, j->table.n, j->table.file);
    if (j->outside)
        report_text(&r, "%d of them outside of %.5g to %.5g Hz, the band that is fitted: they stay in the residual\n",
                    j->outside, j->x.low, j->x.high);
    if (j->estimated.file)
        report_text(&r, "matched by %s: ratio %.3f by energy, %.3f in the mean, %.3f at least; score %.3f\n",
                    j->estimated.file, j->match.represented, g->mean, g->least, j->match.score);
    report_text(&r, "energy beside the recording's: represented %s, left over %s, noise %s, residual %s%s\n",
                shown(j, g->represented, "nothing"), shown(j, g->left, "nothing"),
                shown(j, g->noise, j->variance == 0.0 ? "none" : "not known"), shown(j, g->residual, "nothing"),
                j->noise         ? ""
                : j->keeps_noise ? " with its noise"
                                 : " with its noise: there is no silence before the strike that shows it");
    report_text(&r, "%s: %.3g s of %s, per %s%s%s\n", j->folder, seconds, modes_quantity_name(j->x.given.quantity),
                per(j), lacks ? "; relative: " : "", lacks ? lacks : "");
    if (!isnan(j->reach))
        report_text(&r, "the strike's force is divided out: the residual holds up to %.5g Hz, and fades above\n",
                    j->reach);
    for (int k = 0; k < j->x.notes; k++)
        report_note(&r, "warning: ", j->x.note[k]);
    report_close(&r, 12, e);
}

/* ------------------------------------------------------------------ all */

/* The folder is not there, or is one of these and --force is given. */
static bool folder_free(const struct job *j, struct err *e)
{
    struct stat s;
    if (!j->folder || !*j->folder) return err_set(e, ERR_USAGE, "-o FOLDER is needed: the folder to write");
    if (lstat(j->folder, &s) != 0) return true;
    const char *wrong = residual_is_folder(j->folder, j->arena);
    if (S_ISLNK(s.st_mode)) wrong = "is a symbolic link";
    if (wrong) return err_set(e, ERR_CREATE, "%s: %s; it is left as it is: choose another name", j->folder, wrong);
    return args_given(&j->c->args, "force") ||
           err_set(e, ERR_CREATE, "%s is there already; --force replaces it", j->folder);
}

int modes_residual_run(struct cmd_call *c, struct err *e)
{
    static const char *const domains[] = {"time", "power", NULL};
    struct job *j = ARENA_TAKE(c->arena, struct job, 1);
    struct modal_options o;
    *j = (struct job){.c = c, .arena = c->arena, .keeps_noise = args_given(&c->args, "keep-noise")};
    j->x.c = c;
    j->x.arena = c->arena;
    const char *folder = args_value(&c->args, "output"), *estimated = args_value(&c->args, "estimated");
    size_t n = folder ? strlen(folder) : 0; /* a folder may be named with a / at its end */
    while (n > 1 && folder[n - 1] == '/')
        n--;
    j->folder = folder ? arena_format(c->arena, "%.*s", (int)n, folder) : NULL;
    if (!modes_extract_options(&j->x, e) || !args_word(&c->args, "residual-domain", domains, &j->domain, e) ||
        !folder_free(j, e) || !modes_extract_recordings(&j->x, 1, e))
        return (int)e->kind;
    if (j->x.n != 1)
        return err_set(e, ERR_USAGE, "%s: a residual is of one recording, not of a folder", c->args.operands[0]),
               (int)e->kind;
    j->place = &j->x.place[0];
    if (!table_read(j, c->args.operands[1], &j->table, e) ||
        (estimated && !table_read(j, estimated, &j->estimated, e)) || !modes_extract_find_strikes(&j->x, &o, e))
        return (int)e->kind;
    choose(j);
    if (!subtract(j, &o, e)) return (int)e->kind;
    listen(j);
    long length = j->length;
    compensate(j);
    divide(j);
    struct figures g = figures(j, length);
    warn(j, &g);
    if (write_folder(j, &g, e) && (args_given(&c->args, "json") || !args_given(&c->args, "quiet")))
        report(j, &g, args_given(&c->args, "json"), e);
    return (int)e->kind;
}
