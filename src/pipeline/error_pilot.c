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

#include "base/stopwatch.h"
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
#include "trajectory/contact.h"
#include "trajectory/trajectory.h"

enum { FORCE_MOST = 1 << 20 }; /* frames of a force that are kept in memory at most */
enum {
    SETTLED = 64
}; /* frames that a limited trajectory feels where it begins, and that a force lasts after the motion */

/* What of a contact's force is heard: the power of its sound over that of the force, by frequency. */

/* power[places][bins] of the contact's sound at a place (m) that is touched and left: its response to a unit impulse,
   all listening places together, of the first frames and, by how these fall, of what rings on. Where
   nothing rings, and of a contact whose gain is 0, it is 1: the force itself.

   The contact is replaced by a strike far shorter than a sample, and its sound by the scene's own stages: whatever
   rings (modes, recordings, an object, scraper and surface) and however it is heard needs no second formula here.

     |H(f)|^2 = sum over channels |FFT of the sound|^2 / |FFT of the force|^2      means over 1/(bins - 1) of the band

   contact.enhance belongs to it: what it enhances rings longer than the force that it is given. It goes by the modes
   along the whole motion: so its |H|^2 is that of a strike on the contact's own motion, with and without it. */
enum { AUDIBLE_FRAMES = 8192, AUDIBLE_ENHANCED = 65536 }; /* what is enhanced rises for as long as it falls */
#define SHORT 1e-7                                        /* s, of the strike */
#define LEAST_PUSHED 1e-8 /* of the force's power at 0 Hz: the contact smooths, and the decimator has its edge */
enum { FIRST = 64 };      /* frames before it: the decimator's reach and more */
#define FADED 10.0        /* beta from which all is within 10 % of what is under the fade */

struct strikes {
    const struct scene *scene;
    const struct contact *contact;
    struct arena *arena;
    bool residual, silent; /* silent: what is listened to is the force */
    long n;                /* frames */
    struct fft *fft;
    double *fade; /* [n + 1] cos^2, from 1 to 0: what still rings at the end would leak to where the object does not */
    double *x, *re, *im;
    double *pushed; /* power of the force */
    int bins, wide; /* bins of these spectra in a band */
};

/* A strike at a place, or on the contact's own motion (NULL), at once. */
static bool strike_open(struct strikes *k, const double *place, bool force, bool enhanced, struct run *r, struct err *e)
{
    struct contact *c = ARENA_TAKE(k->arena, struct contact, 1);
    struct scene *own = ARENA_TAKE(k->arena, struct scene, 1);
    struct plan *p = ARENA_TAKE(k->arena, struct plan, 1);
    double mass = 0.01, rate = k->scene->output.sample_rate;
    *c = *k->contact;
    c->start = 0;
    c->gain = 1; /* the pilot has it */
    c->contact.model = CONTACT_STRIKE;
    *(struct strike *)params_edit(c, strike_stage.params, k->arena) =
        (struct strike){.pulse = PULSE_HALF_SINE,
                        .speed = 1,
                        .stiffness = mass * REAL_PI * REAL_PI / (SHORT * SHORT),
                        .first = place ? FIRST / rate : 0,
                        .count = 1,
                        .interval = NAN,
                        .restitution = NAN};
    c->scraper.mass = mass;
    if (place)
        c->motion = (struct motion){
            .path = PATH_STILL, .at = {place[0], place[1]}, .duration = (double)k->n / rate, .speed = NAN};
    if (!k->residual) error_pilot_drop_residual(c, k->arena);
    if (!enhanced) *(bool *)params_edit(c, enhance_stage.params, k->arena) = false;
    *own = *k->scene;
    error_pilot_alone(own, c);
    if (force) own->output.quantity = QUANTITY_FORCE;
    return plan_make(stages_table, c, own, k->arena, p, e) && run_open(r, p, own, NULL, e);
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

/* Adds to each band what the sound has there of the force, from frame `first` on, under a window of so many frames
   that falls, or that rises and falls. */
static void add_bands(struct strikes *s, const double *sound, long first, long frames, bool rises, double *power)
{
    long step = (rises ? 2 : 1) * s->n / frames;
    stopwatch_spend(20.0 * (double)s->n);
    memset(s->x, 0, (size_t)s->n * sizeof *s->x);
    for (long i = 0; i < frames; i++)
        s->x[first + i] = sound[first + i] * s->fade[rises ? labs(step * i - s->n) : step * i];
    fft_forward(s->fft, s->x, s->re, s->im);
    for (long i = 0; i <= s->n / 2; i++)
        power[(i + s->wide / 2) / s->wide] += (s->re[i] * s->re[i] + s->im[i] * s->im[i]) / s->pushed[i];
}

/* power[n/2+1] of a strike's force. */
static bool force_power(struct strikes *s, const double *place, bool enhanced, double *power, struct err *e)
{
    struct run r;
    if (!strike_open(s, place, true, enhanced, &r, e)) return false;
    bool ok = true;
    for (long from = 0; ok && from < s->n; from += STAGE_BLOCK) {
        ok = run_block(&r, from + STAGE_BLOCK, e);
        const double *x = ok ? board_at(&r.board, ITEM_FORCE, from) : NULL;
        for (long i = 0; ok && i < STAGE_BLOCK; i++)
            s->x[from + i] = x[i] * s->fade[from + i];
    }
    run_close(&r);
    if (!ok) return false;
    fft_forward(s->fft, s->x, s->re, s->im);
    for (long i = 0; i <= s->n / 2; i++)
        power[i] = fmax(s->re[i] * s->re[i] + s->im[i] * s->im[i], LEAST_PUSHED * s->re[0] * s->re[0]);
    return true;
}

/* What rings longer is added: it falls as it fell from the middle half of what is run to the second half, but at least
   as the sound does in all. */
static bool place_power(struct strikes *s, const double place[2], double *power, struct err *e)
{
    struct run r;
    if (!strike_open(s, place, s->silent, false, &r, e)) return false;
    const struct board *b = &r.board;
    long n = s->n;
    int channels = s->silent ? 1 : b->channels;
    double *middle = ARENA_TAKE(s->arena, double, s->bins), *end = ARENA_TAKE(s->arena, double, s->bins),
           *sound = ARENA_TAKE(s->arena, double, channels *n);
    bool ok = true;
    for (long from = 0; ok && from < n; from += STAGE_BLOCK) {
        ok = run_block(&r, from + STAGE_BLOCK, e);
        const double *x = ok ? board_at(b, s->silent ? ITEM_FORCE : ITEM_SOUND, from) : NULL;
        for (long i = 0; ok && i < STAGE_BLOCK; i++)
            for (int k = 0; k < channels; k++)
                sound[k * n + from + i] = x[i * channels + k];
    }
    double slowest = 18.42 * (double)n / (fmin(b->ring, PILOT_LONGEST) * b->rate); /* 80 dB: e^-18.42 */
    run_close(&r);
    memset(power, 0, (size_t)s->bins * sizeof *power);
    for (int k = 0; ok && k < channels; k++) {
        const double *x = sound + k * n;
        add_bands(s, x, 0, n, false, power);
        add_bands(s, x, n / 4, n / 2, true, middle);
        add_bands(s, x, n / 2, n / 2, true, end);
    }
    for (int k = 0; k < s->bins; k++) {
        double beta = middle[k] > 0 && end[k] > 0 ? fmax(-4 * real_log(end[k] / middle[k]), slowest) : FADED;
        if (beta < FADED) power[k] += end[k] * left_over_end(beta);
        power[k] /= k == 0 || k == s->bins - 1 ? 0.5 * s->wide + 0.5 : s->wide;
    }
    return ok;
}

void error_pilot_alone(struct scene *s, struct contact *c)
{
    s->contacts = c;
    s->n_contacts = 1;
    s->output.stems = NULL;
    s->output.diagnostics.given = false;
    s->output.impacts = LISTING_NONE;
}

/* It is dear to make, and leaves what is louder, the modes. */
void error_pilot_drop_residual(struct contact *c, struct arena *a)
{
    *(const char **)params_edit(c, surface_residual_stage.params, a) = NULL; /* its file */
}

static bool audible_power(const struct scene *s, const struct contact *c, double (*place)[2], int places, bool residual,
                          int bins, double *power, struct err *e)
{
    bool enhanced = *(const bool *)params_of(c, enhance_stage.params),
         silent = s->output.quantity == QUANTITY_FORCE || !response_rings(c) || c->gain == 0;
    for (int k = 0; k < places * bins; k++)
        power[k] = 1;
    if (silent && !enhanced) return true;
    struct arena *a = arena_open();
    long n = enhanced ? AUDIBLE_ENHANCED : AUDIBLE_FRAMES, half = n / 2 + 1;
    struct strikes k = {.scene = s,
                        .contact = c,
                        .arena = a,
                        .residual = residual,
                        .silent = silent,
                        .n = n,
                        .fft = fft_open(n),
                        .fade = ARENA_TAKE(a, double, n + 1),
                        .x = ARENA_TAKE(a, double, n),
                        .re = ARENA_TAKE(a, double, half),
                        .im = ARENA_TAKE(a, double, half),
                        .pushed = ARENA_TAKE(a, double, half),
                        .bins = bins,
                        .wide = (int)(n / 2 / (bins - 1))};
    for (long i = 0; i <= n; i++) {
        double x = real_sinpi(0.5 + 0.5 * (double)i / (double)n);
        k.fade[i] = x * x;
    }
    stopwatch_spend(60.0 * (double)n);
    bool ok = force_power(&k, place[0], false, k.pushed, e); /* it is the same at all places */
    if (ok && enhanced) {
        double *plain = ARENA_TAKE(a, double, half), *full = ARENA_TAKE(a, double, half);
        ok = force_power(&k, NULL, false, plain, e) && force_power(&k, NULL, true, full, e);
        for (long i = 0; ok && i < half; i++)
            k.pushed[i] *= plain[i] / full[i];
    }
    for (int i = 0; ok && i < places; i++)
        ok = place_power(&k, place[i], power + i * bins, e);
    fft_close(k.fft);
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
    double rate = s->output.sample_rate;
    *p = (struct error_pilot){.scene = *s,
                              .contact = *c,
                              .arena = a,
                              .gain = c->gain,
                              .silent = s->output.quantity == QUANTITY_FORCE && c->gain != 0,
                              .drift = 1,
                              .places = moves && !sampled ? PILOT_PLACES : 1,
                              .window = sampled ? PILOT_WINDOW_SAMPLED : PILOT_WINDOW};
    p->hop = p->window / 2;
    p->bins = p->hop + 1;
    p->power = ARENA_TAKE(a, double, p->places * p->bins);
    p->taper = ARENA_TAKE(a, double, p->window);
    for (int i = 0; i < p->window; i++) {
        double x = real_sinpi((i + 0.5) / p->window);
        p->taper[i] = x * x;
    }
    if (c->gain == 0) /* it is here for its table, which holds its force as it is */
        p->gain = p->contact.gain = 1;
    *(bool *)params_edit(&p->contact, enhance_stage.params, a) = false; /* power has it */
    error_pilot_alone(&p->scene, &p->contact);
    p->scene.output.quantity = QUANTITY_FORCE;
    p->scene.output.listen.given = false;
    p->scene.output.channels = 1;
    struct trajectory *tr = ARENA_TAKE(a, struct trajectory, 1);
    if (!trajectory_make(&c->motion, trajectory_seed(s, c), a, tr, e)) return err_at(e, "contact '%s'", c->name);
    p->contact.motion.made = tr;
    p->start = contact_first_frame(c, rate);
    p->moving = trajectory_frames(tr, rate);
    p->some = p->moving + SETTLED;
    bool anywhere = begins_anywhere(c);
    p->sampled = sampled;
    p->fastest = anywhere ? fastest(tr, p->moving) : 0;
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
    /* Else as dear; and of a short motion few blocks say little: one grain may be all of its force. */
    p->follows = anywhere && p->blocks > (sampled ? 4 : 2) * p->followed;
    p->block = p->follows ? ARENA_TAKE(a, struct pilot_block, p->followed) : NULL;
    for (int k = 0; sampled && p->follows && k < p->followed; k++) /* 0, those spread, the last two */
        p->block[k].number = k == 0        ? 0
                             : k <= spread ? p->blocks * (2 * k - 1) / (2 * spread)
                                           : p->blocks - p->followed + k;
    /* Of a response that moves, one in each third. Of the first 40 modes of a string or bar along whose length the
       motion leads, at a steady speed, as minimum jerk or there and back, each has a tenth of its power at these or
       more: none lies on nodes at all three. */
    static const double places_at[PILOT_PLACES] = {0.2 / 3, 1.736 / 3, 2.538 / 3};
    double place[PILOT_PLACES][2];
    for (int k = 0; k < p->places; k++) {
        double t = tr->duration * (p->places == 1 ? 0.5 : places_at[k]);
        trajectory_at(tr, 1, &t, (struct trajectory_out){.x = &place[k][0], .y = &place[k][1]});
    }
    return audible_power(s, c, place, p->places, !sampled, p->bins, p->power, e);
}

/* ------------------------------------------------------------------ blocks */

struct hearing {
    struct fft *fft;
    int window;
    const double *taper;
    double x[PILOT_WINDOW], re[PILOT_BINS], im[PILOT_BINS];
};

static struct hearing hearing_open(const struct error_pilot *p)
{
    return (struct hearing){.fft = fft_open(p->window), .window = p->window, .taper = p->taper};
}

static double weighted(const struct error_pilot *p, long block, const double *square)
{
    const double *power = p->power + block * p->places / p->blocks * p->bins;
    double sum = 0;
    for (int k = 0; k < p->bins; k++)
        sum += (k == 0 || k == p->bins - 1 ? 1 : 2) * power[k] * square[k];
    return p->gain * p->gain * sum / p->window;
}

#define SPECTRUM 25.0 /* predicted cycles of a sample, beside the transform */

static bool spectrum(struct hearing *h, double *square)
{
    double any = 0;
    for (int i = 0; i < h->window; i++) {
        h->x[i] *= h->taper[i];
        any = fmax(any, fabs(h->x[i]));
    }
    stopwatch_spend(SPECTRUM * (double)h->window);
    if (any == 0) return false;
    fft_forward(h->fft, h->x, h->re, h->im);
    for (int k = 0; k <= h->window / 2; k++)
        square[k] = h->re[k] * h->re[k] + h->im[k] * h->im[k];
    return true;
}

double error_pilot_shown(const struct scene *s, long frame)
{
    double ramp = rint(s->output.ramp * s->output.sample_rate),
           left =
               isnan(s->output.duration) ? HUGE_VAL : rint(s->output.duration * s->output.sample_rate) - (double)frame,
           in = fmax(0, fmin(fmin((double)frame + 0.5, left - 0.5), ramp)),
           x = in < ramp ? real_sinpi(0.5 * in / ramp) : 1;
    return left > 0 ? x * x : 0;
}

/* The force of a block under output's ramps; false: they leave all of it. */
static bool fade_block(const struct error_pilot *p, long block, double *x)
{
    long first = p->start + (block - 1) * p->hop, last = first + p->window - 1;
    if (error_pilot_shown(&p->scene, first) == 1 && error_pilot_shown(&p->scene, last) == 1) return false;
    for (int i = 0; i < p->window; i++)
        x[i] *= error_pilot_shown(&p->scene, first + i);
    stopwatch_spend(60.0 * p->window);
    return true;
}

/* Of the force in h->x. A force's mean is often many times what of it rings, and leaks from the window into the bins
   of modes: so each bin has the least of its power and of that of the second difference, for which a mean and a slope
   are nothing, over 16 sin^4(omega/2). */
static double energy_of(const struct error_pilot *p, struct hearing *h, long block)
{
    double square[PILOT_BINS], other[PILOT_BINS], x[PILOT_WINDOW];
    memcpy(x, h->x, (size_t)p->window * sizeof *x);
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

/* energy[2] of a block of force: as it is, and of the force under output's ramps. Where the force is what is listened
   to, it is under them. */
static void block_energy(const struct error_pilot *p, struct hearing *h, long block, const double *x, double energy[2])
{
    memcpy(h->x, x, (size_t)p->window * sizeof *x);
    bool faded = fade_block(p, block, h->x);
    if (faded) energy[1] = energy_of(p, h, block);
    memcpy(h->x, x, (size_t)p->window * sizeof *x);
    energy[0] = faded && p->silent ? energy[1] : energy_of(p, h, block);
    if (!faded) energy[1] = energy[0];
}

/* Of the difference of two; what leaks makes it more. A sound's rings on as a ramp opens: it is as it is without. */
static double block_distance(const struct error_pilot *p, struct hearing *h, long block, const double *x,
                             const double *y)
{
    double square[PILOT_BINS];
    for (int i = 0; i < p->window; i++)
        h->x[i] = x[i] - y[i];
    if (p->silent) fade_block(p, block, h->x);
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
    p->energy = p->shown = 0;
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
        double energy[2];
        block_energy(p, &h, number, now, energy);
        p->energy += energy[0];
        p->shown += energy[1];
        p->distance[number] = finer ? block_distance(p, &h, number, x[1], x[0]) : energy[0];
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
    p->energy = p->shown = 0;
    memset(p->distance, 0, (size_t)p->blocks * sizeof *p->distance);
    for (int k = 0; y && k < p->followed; k++) {
        double each = k == 0 || k > spread ? 1 : (double)(p->blocks - PILOT_ENDS) / spread;
        double energy[2];
        block_energy(p, &h, y[k].number, y[k].x, energy);
        p->energy += each * energy[0];
        p->shown += each * energy[1];
        p->distance[y[k].number] = each * (finer ? block_distance(p, &h, y[k].number, y[k].x, x[k].x) : energy[0]);
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
