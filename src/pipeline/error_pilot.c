/* A kink of the force (a rest, a reversal, a corner, a jump of alpha) makes most of the error of a motion in one block,
   and around it the error is erratic in the knob: what agrees at two settings may differ at the next. So the whole
   motion is run at three settings, and a block's difference is believed to fall by 12 dB at most from one doubling to
   the next.

   At kinks the difference falls slowly, by 6 to 12 dB a doubling, elsewhere by 18. So between three settings each block
   shows its own order. Carried on with that order, the blocks that will matter are those of the greatest d q,

     q = d(2K,4K) / d(K,2K), within [1/64, 1].

   They are run at finer settings, and with them some spread evenly, by which the others are scaled: d of those is
   d q c, where c is the sum of what the spread ones gave over the sum of their d q, at least 1. Beside the whole motion
   the sum is then within 3 dB where it matters (scenes/circle; of 1024 frames, with 32 of the worst
   and none spread, 5 dB too low). */
#include "pipeline/error_pilot.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "convolution/ring_choice.h"
#include "force/strike.h"
#include "num/fft.h"
#include "num/real.h"
#include "pipeline/run.h"
#include "pipeline/stages.h"
#include "response/response.h"
#include "scene/accuracy.h"
#include "scene/params.h"
#include "scene/scene.h"
#include "trajectory/trajectory.h"

enum { FORCE_MOST = 1 << 20 }; /* frames of a force that are kept in memory at most */
enum {
    SETTLED = 64
}; /* frames that a limited trajectory feels where it begins, and that a force lasts after the motion */

/* What of a contact's force is heard: the power of its sound over that of the force, by frequency. */

/* power[bins] of the contact's sound at a place (m) that is touched and left: its response to a unit impulse,
   all listening places together, of the first frames and, by how these fall, of what rings on. Where
   nothing rings, and of a contact whose gain is 0, it is 1: the force itself.
   Errors: those of plans and stages. */
enum { AUDIBLE_FRAMES = 8192, AUDIBLE_ENHANCED = 65536 }; /* what is enhanced rises for as long as it falls */

/* The contact is replaced by a strike far shorter than a sample, and its sound by the scene's own stages: whatever
   rings (modes, recordings, an object, scraper and surface) and however it is heard needs no second formula here.

     |H(f)|^2 = sum over channels |FFT of the sound|^2 / |FFT of the force|^2      means over 1/(bins - 1) of the band

   contact.enhance belongs to it: what it enhances rings longer than the force that it is given. It goes by the modes
   along the whole motion: so its |H|^2 is that of a strike on the contact's own motion, with and without it. */
#define SHORT 1e-7        /* s, of the strike */
#define LEAST_PUSHED 1e-8 /* of the force's power at 0 Hz: the contact smooths, and the decimator has its edge */
enum { FIRST = 64 };      /* frames before it: the decimator's reach and more */
#define FADED 10.0        /* beta from which all is within 10 % of what is under the fade */

/* place NULL: on its own motion, at once. */
static void strike(struct contact *c, const double *place, double duration, double rate, struct arena *a)
{
    double mass = 0.01;
    c->start = 0;
    c->gain = 1; /* the pilot has it */
    c->contact.model = CONTACT_STRIKE;
    *(struct strike *)params_edit(c, strike_stage.params, a) =
        (struct strike){.pulse = PULSE_HALF_SINE,
                        .speed = 1,
                        .stiffness = mass * REAL_PI * REAL_PI / (SHORT * SHORT),
                        .first = place ? FIRST / rate : 0,
                        .count = 1,
                        .interval = NAN,
                        .restitution = NAN};
    c->scraper.mass = mass;
    if (place)
        c->motion = (struct motion){.path = PATH_STILL, .at = {place[0], place[1]}, .duration = duration, .speed = NAN};
}

/* What still rings at the end would leak to where the object does not. */
static double fade(double u)
{
    double c = real_sinpi(0.5 + 0.5 * u);
    return c * c;
}

/* int_0^1 e^(-beta u) sum_k a_k cos(step k pi u) du, k = 0 .. 2. */
static double falling(double beta, const double a[3], int step)
{
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        double w = step * k * REAL_PI, end = (step * k % 2 ? -1 : 1) * real_exp(-beta);
        sum += a[k] * beta * (1 - end) / (beta * beta + w * w);
    }
    return sum;
}

/* What a mode leaves out under the fade, over what it has under the last window (add_bands): its energy falls like
   e^(-beta u), u in units of the frames that are run. */
static double left_over_end(double beta)
{
    static const double fade2[3] = {0.375, 0.5, 0.125}, window2[3] = {0.375, -0.5, 0.125};
    return (1 / beta - falling(beta, fade2, 1)) / (0.5 * real_exp(-beta / 2) * falling(beta / 2, window2, 2));
}

struct spectra {
    long n; /* frames */
    struct fft *fft;
    double *x, *re, *im;
    double *pushed; /* power of the force */
    int wide;       /* bins of these spectra in a band */
};

/* Adds to each band what the sound has there of the force, from frame `first` on, under a window of so many frames
   that falls, or that rises and falls. */
static void add_bands(struct spectra *s, const double *sound, long first, long frames, bool rises, double *power)
{
    double each = 1.0 / (double)frames;
    memset(s->x, 0, (size_t)s->n * sizeof *s->x);
    for (long i = 0; i < frames; i++)
        s->x[first + i] = sound[first + i] * fade(rises ? 2 * each * (double)i - 1 : each * (double)i);
    fft_forward(s->fft, s->x, s->re, s->im);
    for (long i = 0; i <= s->n / 2; i++)
        power[(i + s->wide / 2) / s->wide] += (s->re[i] * s->re[i] + s->im[i] * s->im[i]) / s->pushed[i];
}

enum { PLAIN, SOUNDING, OWN, ENHANCED, STRIKES }; /* runs; the last two where contact.enhance is given */

/* The spectrum of a strike's force. */
static bool force_spectrum(struct run *r, struct spectra *s, struct err *e)
{
    for (long from = 0; from < s->n; from += STAGE_BLOCK) {
        if (!run_block(r, from + STAGE_BLOCK, e)) return false;
        const double *x = board_at(&r->board, ITEM_FORCE, from);
        for (long i = 0; i < STAGE_BLOCK; i++)
            s->x[from + i] = x[i] * fade((double)(from + i) / (double)s->n);
    }
    fft_forward(s->fft, s->x, s->re, s->im);
    return true;
}

/* What rings longer is added: it falls as it fell from the middle half of what is run to the second half, but at least
   as the sound does in all. */
static bool measure(struct run r[STRIKES], enum item item, bool enhanced, long n, int bins, struct arena *a,
                    double *power, struct err *e)
{
    const struct board *b = &r[SOUNDING].board;
    int channels = item == ITEM_SOUND ? b->channels : 1;
    double *middle = ARENA_TAKE(a, double, bins), *end = ARENA_TAKE(a, double, bins),
           *sound = ARENA_TAKE(a, double, channels *n);
    struct spectra s = {.n = n,
                        .fft = fft_open(n),
                        .x = ARENA_TAKE(a, double, n),
                        .re = ARENA_TAKE(a, double, n / 2 + 1),
                        .im = ARENA_TAKE(a, double, n / 2 + 1),
                        .pushed = ARENA_TAKE(a, double, n / 2 + 1),
                        .wide = (int)(n / 2 / (bins - 1))};
    bool ok = force_spectrum(&r[PLAIN], &s, e);
    for (long i = 0; ok && i <= n / 2; i++)
        s.pushed[i] = fmax(s.re[i] * s.re[i] + s.im[i] * s.im[i], LEAST_PUSHED * s.re[0] * s.re[0]);
    for (int k = OWN; ok && enhanced && k <= ENHANCED; k++) {
        ok = force_spectrum(&r[k], &s, e);
        for (long i = 0; ok && i <= n / 2; i++) {
            double square = fmax(s.re[i] * s.re[i] + s.im[i] * s.im[i], LEAST_PUSHED * s.re[0] * s.re[0]);
            s.pushed[i] = k == OWN ? s.pushed[i] * square : s.pushed[i] / square;
        }
    }
    for (long from = 0; ok && from < n; from += STAGE_BLOCK) {
        ok = run_block(&r[SOUNDING], from + STAGE_BLOCK, e);
        const double *x = ok ? board_at(b, item, from) : NULL;
        for (long i = 0; ok && i < STAGE_BLOCK; i++)
            for (int k = 0; k < channels; k++)
                sound[k * n + from + i] = x[i * channels + k];
    }
    if (!ok) {
        fft_close(s.fft);
        return false;
    }
    memset(power, 0, (size_t)bins * sizeof *power);
    for (int k = 0; k < channels; k++) {
        const double *x = sound + k * n;
        add_bands(&s, x, 0, n, false, power);
        add_bands(&s, x, n / 4, n / 2, true, middle);
        add_bands(&s, x, n / 2, n / 2, true, end);
    }
    fft_close(s.fft);
    double slowest = 18.42 * (double)n / (fmin(b->ring, PILOT_LONGEST) * b->rate); /* 80 dB: e^-18.42 */
    for (int k = 0; k < bins; k++) {
        double beta = middle[k] > 0 && end[k] > 0 ? fmax(-4 * real_log(end[k] / middle[k]), slowest) : FADED;
        if (beta < FADED) power[k] += end[k] * left_over_end(beta);
        power[k] /= k == 0 || k == bins - 1 ? 0.5 * s.wide + 0.5 : s.wide;
    }
    return true;
}

/* It is dear to make, and leaves what is louder, the modes. */
void error_pilot_drop_residual(struct contact *c, struct arena *a)
{
    *(const char **)params_edit(c, surface_residual_stage.params, a) = NULL; /* its file */
}

static bool audible_power(const struct scene *s, const struct contact *c, const double place[2], bool residual,
                          int bins, double *power, struct err *e)
{
    bool enhanced = *(const bool *)params_of(c, enhance_stage.params),
         silent = s->output.quantity == QUANTITY_FORCE || !response_rings(c) || c->gain == 0, ok = true;
    for (int k = 0; k < bins; k++)
        power[k] = 1;
    if (silent && !enhanced) return true;
    struct arena *a = arena_open();
    struct contact struck[STRIKES];
    struct scene own[STRIKES];
    struct plan p[STRIKES];
    struct run r[STRIKES];
    long n = enhanced ? AUDIBLE_ENHANCED : AUDIBLE_FRAMES;
    double rate = s->output.sample_rate;
    int open = 0, all = enhanced ? STRIKES : OWN;
    for (int k = 0; ok && k < all; k++) {
        struck[k] = *c;
        own[k] = *s;
        strike(&struck[k], k < OWN ? place : NULL, (double)n / rate, rate, a);
        if (!residual) error_pilot_drop_residual(&struck[k], a);
        own[k].contacts = &struck[k];
        own[k].n_contacts = 1;
        own[k].output.stems = NULL;
        own[k].output.diagnostics.given = false;
        own[k].output.impacts = LISTING_NONE;
        if (k != SOUNDING || silent) own[k].output.quantity = QUANTITY_FORCE;
        if (k != ENHANCED) *(bool *)params_edit(&struck[k], enhance_stage.params, a) = false;
        ok = plan_make(stages_table, &struck[k], &own[k], a, &p[k], e) && run_open(&r[k], &p[k], &own[k], NULL, e);
        open += ok;
    }
    ok = ok && measure(r, silent ? ITEM_FORCE : ITEM_SOUND, enhanced, n, bins, a, power, e);
    for (int k = 0; k < open; k++)
        run_close(&r[k]);
    arena_close(a);
    return ok;
}

/* ------------------------------------------------------------------ making */

/* Is the force read from the ground wherever the contact is, so that it can begin anywhere? */
static bool begins_anywhere(const struct contact *c)
{
    return (c->contact.model == CONTACT_SCRAPE || c->contact.model == CONTACT_ROLL ||
            c->contact.model == CONTACT_PLAYBACK) &&
           c->motion.path != PATH_STILL;
}

/* Where the fourth power of the speed is greatest over PILOT_STRETCH frames: a ramp's error over the sound grows with
   the square of the speed. */
static long fastest(const struct trajectory *tr, long moving)
{
    enum { N = 512 };
    double t[N], vx[N], vy[N], speed[N], best = -1;
    long at = 0;
    if (moving <= PILOT_STRETCH) return 0;
    for (int i = 0; i < N; i++)
        t[i] = tr->duration * (i + 0.5) / N;
    trajectory_at(tr, N, t, (struct trajectory_out){.vx = vx, .vy = vy});
    for (int i = 0; i < N; i++) {
        double square = vx[i] * vx[i] + vy[i] * vy[i];
        speed[i] = square * square;
    }
    for (int i = 0; i < N; i++) {
        long begin = moving * i / N;
        double sum = 0;
        for (int k = i; k < N && moving * (k - i) / N < PILOT_STRETCH; k++)
            sum += speed[k];
        if (begin > moving - PILOT_STRETCH || sum <= best) continue;
        best = sum;
        at = begin;
    }
    return at;
}

bool error_pilot_make(const struct scene *s, const struct contact *c, double some, bool moves, bool sampled,
                      struct arena *a, struct error_pilot *p, struct err *e)
{
    struct trajectory tr;
    double rate = s->output.sample_rate;
    *p = (struct error_pilot){.scene = *s,
                              .contact = *c,
                              .arena = a,
                              .gain = c->gain,
                              .drift = 1,
                              .places = moves && !sampled ? PILOT_PLACES : 1,
                              .window = sampled ? PILOT_WINDOW_SAMPLED : PILOT_WINDOW};
    p->hop = p->window / 2;
    p->bins = p->hop + 1;
    p->power = ARENA_TAKE(a, double, p->places * p->bins);
    if (c->gain == 0) /* it is here for its table, which holds its force as it is */
        p->gain = p->contact.gain = 1;
    *(bool *)params_edit(&p->contact, enhance_stage.params, a) = false; /* power has it */
    p->scene.contacts = &p->contact;
    p->scene.n_contacts = 1;
    p->scene.output.quantity = QUANTITY_FORCE;
    p->scene.output.stems = NULL;
    p->scene.output.listen.given = false;
    p->scene.output.channels = 1;
    p->scene.output.diagnostics.given = false;
    p->scene.output.impacts = LISTING_NONE;
    if (!trajectory_make(&c->motion, trajectory_seed(s, c), a, &tr, e)) return err_at(e, "contact '%s'", c->name);
    p->moving = trajectory_frames(&tr, rate);
    p->some = p->moving + SETTLED;
    bool anywhere = begins_anywhere(c);
    p->sampled = sampled;
    p->fastest = anywhere ? fastest(&tr, p->moving) : 0;
    if (c->contact.model == CONTACT_ROLL_COUPLED || (sampled && !anywhere)) {
        long first = (long)ceil(some * rate);
        p->some = first < p->some ? first : p->some;
        p->drift = sampled ? 1 : fmax(1, (double)p->moving / (double)p->some);
    }
    p->blocks = (p->some + p->hop - 1) / p->hop + 1;
    p->last = p->some > FORCE_MOST ? NULL : ARENA_TAKE(a, double, p->some);
    p->distance = ARENA_TAKE(a, double, p->blocks);
    p->older = ARENA_TAKE(a, double, p->blocks);
    p->falls = ARENA_TAKE(a, double, p->blocks);
    if (!plan_make(stages_table, &p->contact, &p->scene, a, &p->plan, e)) return false;
    p->knobs = plan_knobs(&p->plan);
    int spread = p->knobs & KNOB_BIT(tip_heights) ? PILOT_SAMPLED / 2 : PILOT_SAMPLED;
    p->followed = sampled ? spread + PILOT_ENDS : PILOT_FOLLOWED;
    p->follows = anywhere && p->blocks > 2 * p->followed; /* else as dear */
    p->block = p->follows ? ARENA_TAKE(a, struct pilot_block, p->followed) : NULL;
    for (int k = 0; sampled && p->follows && k < p->followed; k++) /* 0, those spread, the last two */
        p->block[k].number = k == 0        ? 0
                             : k <= spread ? p->blocks * (2 * k - 1) / (2 * spread)
                                           : p->blocks - p->followed + k;
    for (int k = 0; k < p->places; k++) { /* of a response that moves, those in the middle of each third */
        double t = tr.duration * (2 * k + 1) / (2 * p->places), place[2];
        trajectory_at(&tr, 1, &t, (struct trajectory_out){.x = &place[0], .y = &place[1]});
        if (!audible_power(s, c, place, !sampled, p->bins, p->power + k * p->bins, e)) return false;
    }
    return true;
}

/* ------------------------------------------------------------------ blocks */

struct hearing {
    struct fft *fft;
    int window;
    double taper[PILOT_WINDOW], x[PILOT_WINDOW], re[PILOT_BINS], im[PILOT_BINS];
};

static struct hearing hearing_open(const struct error_pilot *p)
{
    struct hearing h = {.fft = fft_open(p->window), .window = p->window};
    for (int i = 0; i < p->window; i++) {
        double s = real_sin(REAL_PI * (i + 0.5) / p->window);
        h.taper[i] = s * s;
    }
    return h;
}

static double weighted(const struct error_pilot *p, long block, const double *square)
{
    const double *power = p->power + block * p->places / p->blocks * p->bins;
    double sum = 0;
    for (int k = 0; k < p->bins; k++)
        sum += (k == 0 || k == p->bins - 1 ? 1 : 2) * power[k] * square[k];
    return p->gain * p->gain * sum / p->window;
}

static bool spectrum(struct hearing *h, double *square)
{
    double any = 0;
    for (int i = 0; i < h->window; i++) {
        h->x[i] *= h->taper[i];
        any = fmax(any, fabs(h->x[i]));
    }
    if (any == 0) return false;
    fft_forward(h->fft, h->x, h->re, h->im);
    for (int k = 0; k <= h->window / 2; k++)
        square[k] = h->re[k] * h->re[k] + h->im[k] * h->im[k];
    return true;
}

/* Of the force in a block. A force's mean is often many times what of it rings, and leaks from the window into the bins
   of modes: so each bin has the least of its power and of that of the second difference, for which a mean and a slope
   are nothing, over 16 sin^4(omega/2). */
static double block_energy(const struct error_pilot *p, struct hearing *h, long block, const double *x)
{
    double square[PILOT_BINS], other[PILOT_BINS];
    memcpy(h->x, x, (size_t)p->window * sizeof *x);
    if (!spectrum(h, square)) return 0;
    h->x[0] = h->x[p->window - 1] = 0;
    for (int i = 1; i < p->window - 1; i++)
        h->x[i] = x[i - 1] - 2 * x[i] + x[i + 1];
    bool bends = spectrum(h, other);
    for (int k = 1; k < p->bins; k++) {
        double s = real_sinpi((double)k / p->window), scale = 16 * s * s * s * s;
        square[k] = bends ? fmin(square[k], other[k] / scale) : 0;
    }
    return weighted(p, block, square);
}

/* Of the difference of two; what leaks makes it more. */
static double block_distance(const struct error_pilot *p, struct hearing *h, long block, const double *x,
                             const double *y)
{
    double square[PILOT_BINS];
    for (int i = 0; i < p->window; i++)
        h->x[i] = x[i] - y[i];
    return spectrum(h, square) ? weighted(p, block, square) : 0;
}

static void learn(struct error_pilot *p, const struct run *r)
{
    p->bounces = r->board.roll.bounces > p->bounces ? r->board.roll.bounces : p->bounces;
    p->lift_offs = r->board.roll.lift_offs > p->lift_offs ? r->board.roll.lift_offs : p->lift_offs;
}

/* Where a block begins the limited trajectory begins, too: where the first, coarsest run has it, for all. */
static void take_lead(struct error_pilot *p, const struct run *r)
{
    if (p->lead > 0) return;
    p->lead = SETTLED;
    for (int i = 0; i < r->n; i++)
        p->lead += r->stages[i].back + r->stages[i].ahead;
}

/* Both settings over the whole motion, the first only where it is not the one of the last run. */
static bool run_whole(struct error_pilot *p, const struct accuracy *set, const struct accuracy *finer, bool going,
                      struct err *e)
{
    const struct accuracy *sets[2] = {going && p->last ? NULL : set, finer}; /* NULL: not run */
    struct scene scene[2] = {p->scene, p->scene};
    struct run r[2];
    bool open[2] = {false, false}, ok = true;
    struct hearing h = hearing_open(p);
    long hop = p->hop;
    double x[2][PILOT_WINDOW] = {{0}}, *now = x[finer != NULL];
    p->energy = 0;
    for (int k = 0; ok && k < 2; k++) {
        if (!sets[k]) continue;
        scene[k].accuracy = *sets[k];
        ok = open[k] = run_open(&r[k], &p->plan, &scene[k], NULL, e);
    }
    if (open[0]) take_lead(p, &r[0]);
    for (long number = 0; ok && number < p->blocks; number++) {
        long from = number * hop, left = p->some - from, frames = left < hop ? left : hop;
        for (int k = 0; k < 2; k++) {
            memcpy(x[k], x[k] + hop, (size_t)hop * sizeof(double));
            memset(x[k] + hop, 0, (size_t)hop * sizeof(double));
        }
        for (int k = 0; ok && k < 2 && frames > 0; k++) {
            if (k == 0 && !open[0] && p->last) memcpy(x[0] + hop, p->last + from, (size_t)frames * sizeof(double));
            for (long at = 0, to; ok && open[k] && at < frames; at = to) {
                to = at + STAGE_BLOCK < frames ? at + STAGE_BLOCK : frames;
                ok = run_block(&r[k], from + to, e);
                if (ok)
                    memcpy(x[k] + hop + at, board_at(&r[k].board, ITEM_FORCE, from + at),
                           (size_t)(to - at) * sizeof(double));
            }
        }
        if (!ok) break;
        if (p->last && frames > 0) memcpy(p->last + from, now + hop, (size_t)frames * sizeof(double));
        double energy = block_energy(p, &h, number, now);
        p->energy += energy;
        p->distance[number] = finer ? block_distance(p, &h, number, x[1], x[0]) : energy;
    }
    for (int k = 0; k < 2; k++) {
        if (!open[k]) continue;
        learn(p, &r[k]);
        run_close(&r[k]);
    }
    fft_close(h.fft);
    return ok;
}

/* ------------------------------------------------------------------ some blocks */

static int by_number(const void *a, const void *b)
{
    long x = ((const struct pilot_block *)a)->number, y = ((const struct pilot_block *)b)->number;
    return (x > y) - (x < y);
}

static bool is_spread(const struct error_pilot *p, long number)
{
    for (int k = 0; k < PILOT_SPREAD; k++)
        if (number == p->blocks * (2 * k + 1) / (2 * PILOT_SPREAD)) return true;
    return false;
}

/* Those spread evenly, and of the others the worst by what is expected of them. */
static void choose_blocks(struct error_pilot *p)
{
    int n = 0;
    for (long b = 0; b < p->blocks; b++) {
        double falls = p->older[b] > 0 ? p->distance[b] / p->older[b] : 1;
        p->falls[b] = fmin(fmax(falls, 1.0 / 64), 1);
        if (is_spread(p, b)) p->block[PILOT_WORST + n++].number = b;
    }
    for (int k = 0; k < PILOT_WORST; k++) {
        long worst = -1;
        for (long b = 0; b < p->blocks; b++) {
            bool taken = is_spread(p, b);
            for (int i = 0; i < k; i++)
                taken = taken || p->block[i].number == b;
            if (!taken && (worst < 0 || p->distance[b] * p->falls[b] > p->distance[worst] * p->falls[worst])) worst = b;
        }
        p->block[k].number = worst;
    }
    qsort(p->block, PILOT_FOLLOWED, sizeof *p->block, by_number);
}

/* The force of the chosen blocks at a setting, to x. */
static bool run_blocks(struct error_pilot *p, const struct accuracy *set, struct pilot_block *to, struct err *e)
{
    struct scene scene = p->scene;
    struct run r;
    scene.accuracy = *set;
    if (!run_open(&r, &p->plan, &scene, NULL, e)) return false;
    take_lead(p, &r);
    bool ok = true;
    long at = 0;
    for (int k = 0; k < p->followed; k++) {
        to[k].number = p->block[k].number;
        memset(to[k].x, 0, sizeof to[k].x);
    }
    for (int k = 0; ok && k < p->followed; k++) {
        long from = (p->block[k].number - 1) * p->hop, end = from + p->window;
        end = end < p->some ? end : p->some;
        if (from - p->lead > at) run_skip(&r, at = from - p->lead, 0);
        for (long next; ok && at < end; at = next) {
            next = at + STAGE_BLOCK < end ? at + STAGE_BLOCK : end;
            ok = run_block(&r, next, e);
            const double *force = ok ? board_at(&r.board, ITEM_FORCE, at) : NULL;
            for (int i = 0; ok && i < p->followed; i++) {
                long begin = (p->block[i].number - 1) * p->hop, first = at > begin ? at : begin,
                     last = next < begin + p->window ? next : begin + p->window;
                if (first < last)
                    memcpy(to[i].x + (first - begin), force + (first - at), (size_t)(last - first) * sizeof(double));
            }
        }
    }
    learn(p, &r);
    run_close(&r);
    return ok;
}

/* Of a sampled pilot, the blocks at a setting: run once. */
static const struct pilot_block *sample(struct error_pilot *p, const struct accuracy *set, struct err *e)
{
    for (int i = 0; i < PILOT_SETTINGS; i++) {
        bool same = p->ran[i].set.preset != NULL;
        for (int k = 0; k < KNOBS; k++)
            same = same && accuracy_knob(&p->ran[i].set, (enum knob)k) == accuracy_knob(set, (enum knob)k);
        if (same) return p->ran[i].block;
    }
    struct pilot_sample *to = &p->ran[p->next++ % PILOT_SETTINGS];
    to->set = *set;
    if (!to->block) to->block = ARENA_TAKE(p->arena, struct pilot_block, p->followed);
    return run_blocks(p, set, to->block, e) ? to->block : NULL;
}

/* Each block but those at the ends stands for as many of all. finer NULL: there is none. */
static bool run_sample(struct error_pilot *p, const struct accuracy *set, const struct accuracy *finer, struct err *e)
{
    const struct pilot_block *x = sample(p, set, e), *y = x && finer ? sample(p, finer, e) : x;
    struct hearing h = hearing_open(p);
    int spread = p->followed - PILOT_ENDS;
    p->energy = 0;
    memset(p->distance, 0, (size_t)p->blocks * sizeof *p->distance);
    for (int k = 0; y && k < p->followed; k++) {
        double each = k == 0 || k > spread ? 1 : (double)(p->blocks - PILOT_ENDS) / spread;
        double energy = each * block_energy(p, &h, y[k].number, y[k].x);
        p->energy += energy;
        p->distance[y[k].number] = finer ? each * block_distance(p, &h, y[k].number, y[k].x, x[k].x) : energy;
    }
    fft_close(h.fft);
    return y != NULL;
}

static bool run_some(struct error_pilot *p, const struct accuracy *set, const struct accuracy *finer, struct err *e)
{
    struct arena *a = arena_open();
    struct pilot_block *now = ARENA_TAKE(a, struct pilot_block, PILOT_FOLLOWED);
    bool ok = true;
    if (p->pairs == 3) ok = run_blocks(p, set, p->block, e);
    ok = ok && run_blocks(p, finer, now, e);
    struct hearing h = hearing_open(p);
    double spread = 0, expected = 0;
    for (long b = 0; b < p->blocks; b++)
        p->distance[b] = p->older[b] * p->falls[b];
    for (int k = 0; ok && k < PILOT_FOLLOWED; k++) {
        struct pilot_block *b = &p->block[k];
        double own = block_distance(p, &h, b->number, now[k].x, b->x);
        if (is_spread(p, b->number)) {
            spread += own;
            expected += p->distance[b->number];
        }
        p->distance[b->number] = own;
    }
    double scale = expected > 0 ? fmax(spread / expected, 1) : 1;
    for (long b = 0, k = 0; ok && b < p->blocks; b++)
        if (k < PILOT_FOLLOWED && p->block[k].number == b)
            k++;
        else
            p->distance[b] *= scale;
    memcpy(p->block, now, PILOT_FOLLOWED * sizeof *now);
    fft_close(h.fft);
    arena_close(a);
    return ok;
}

bool error_pilot_run(struct error_pilot *p, const struct accuracy *set, const struct accuracy *finer, bool going,
                     struct err *e)
{
    double *older = p->older;
    p->runs++;
    p->pairs = going ? p->pairs + 1 : 1;
    bool some = p->follows && finer && p->pairs > 2;
    if (some && p->pairs == 3 && !p->sampled) choose_blocks(p);
    p->older = p->distance;
    p->distance = older;
    if (p->sampled && p->follows) return run_sample(p, set, finer, e);
    return some ? run_some(p, set, finer, e) : run_whole(p, set, finer, going, e);
}

double error_pilot_distance(const struct error_pilot *p, bool history)
{
    double sum = 0, part = history ? 1.0 / 16 : 0;
    for (long b = 0; b < p->blocks; b++)
        sum += fmax(p->distance[b], part * p->older[b]);
    return p->drift * p->drift * sum;
}

bool error_pilot_can(struct error_pilot *p, const struct accuracy *set, struct err *e)
{
    struct run r;
    p->scene.accuracy = *set;
    bool ok = run_open(&r, &p->plan, &p->scene, NULL, e);
    if (ok) run_close(&r);
    return ok;
}
