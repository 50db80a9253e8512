/* Energy of the sound of a stretch of force F, heard by the power |H|^2 (segments.h):

     E = weight  sum over windows, bins of |FFT(w F)|^2 |H|^2 / N        w = sin^2(pi (n + 1/2) / N), N =
       SEGMENTS_WINDOW

   A stretch of one window is one window; a longer one is cut into windows that overlap by half. The squares of w have a
   mean of 3/8: that is what weights undo.

   Instants are drawn as the square of the speed is spread over time (the sound is about as loud as that), one in each
   of n - 1 equal parts of it, not at equal distances (a motion repeats itself); each stands for as much time as the
   spread says. So a rest at the beginning is not mistaken for the motion, and the ratio of two energies is that of the
   motion as a whole. */
#include "pipeline/segments.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/err.h"
#include "convolution/ring_choice.h"
#include "force/strike.h"
#include "num/fft.h"
#include "num/real.h"
#include "pipeline/run.h"
#include "pipeline/stages.h"
#include "response/response.h"
#include "scene/params.h"
#include "scene/scene.h"
#include "trajectory/trajectory.h"

enum { GRID = 1024, SETTLED = 64 };

#define TAPERED 0.375 /* mean of w^2 */

/* What of a contact's force is heard: the power of its sound over that of the force, by frequency. */

/* power[AUDIBLE_BINS] of the contact's sound at a place (m) that is touched and left: its response to a unit impulse,
   all listening places together, of the first AUDIBLE_FRAMES frames (what rings longer is counted less than it rings:
   all of it, by the same bands). Where nothing rings, and of a contact whose gain is 0, it is 1: the force itself.
   Errors: those of plans and stages. */
enum { AUDIBLE_FRAMES = 16384 };

/* The contact is replaced by a strike far shorter than a sample, and its sound by the scene's own stages: whatever
   rings (modes, recordings, an object, scraper and surface) and however it is heard needs no second formula here.

     |H(f)|^2 = sum over channels |FFT of the sound|^2 / (sum of the force's samples)^2      means over 1/512 of the
       band */
#define SHORT 1e-7   /* s, of the strike */
enum { FIRST = 64 }; /* frames before it: the decimator's reach and more */

static void strike(struct contact *c, const double place[2], double rate, struct arena *a)
{
    double mass = 0.01;
    if (c->surface.response.choice && c->surface.response.choice->moves) c->surface.response.choice = NULL;
    c->start = 0;
    c->contact.model = CONTACT_STRIKE;
    *(struct strike *)params_edit(c, strike_stage.params, a) =
        (struct strike){.pulse = PULSE_HALF_SINE,
                        .speed = 1,
                        .stiffness = mass * REAL_PI * REAL_PI / (SHORT * SHORT),
                        .first = FIRST / rate,
                        .count = 1,
                        .interval = NAN,
                        .restitution = NAN};
    c->scraper.mass = mass;
    c->motion = (struct motion){
        .path = PATH_STILL, .at = {place[0], place[1]}, .duration = AUDIBLE_FRAMES / rate, .speed = NAN};
}

static bool measure(struct run *r, struct arena *a, double *power, struct err *e)
{
    enum { WIDE = AUDIBLE_FRAMES / 2 / (AUDIBLE_BINS - 1) };
    int channels = r->board.channels;
    double *sound = ARENA_TAKE(a, double, (size_t)channels *AUDIBLE_FRAMES), pushed = 0;
    double *re = ARENA_TAKE(a, double, AUDIBLE_FRAMES / 2 + 1), *im = ARENA_TAKE(a, double, AUDIBLE_FRAMES / 2 + 1);
    for (long from = 0; from < AUDIBLE_FRAMES; from += STAGE_BLOCK) {
        if (!run_block(r, from + STAGE_BLOCK, e)) return false;
        const double *x = board_at(&r->board, ITEM_SOUND, from), *force = board_at(&r->board, ITEM_FORCE, from);
        for (long i = 0; i < STAGE_BLOCK; i++) {
            pushed += force[i];
            for (int k = 0; k < channels; k++)
                sound[k * (long)AUDIBLE_FRAMES + from + i] = x[i * channels + k];
        }
    }
    struct fft *f = fft_open(AUDIBLE_FRAMES);
    memset(power, 0, AUDIBLE_BINS * sizeof *power);
    for (int k = 0; k < channels; k++) { /* each channel's spectrum onto the bands */
        fft_forward(f, sound + k * (long)AUDIBLE_FRAMES, re, im);
        for (int i = 0; i <= AUDIBLE_FRAMES / 2; i++)
            power[(i + WIDE / 2) / WIDE] += re[i] * re[i] + im[i] * im[i];
    }
    fft_close(f);
    for (int k = 0; k < AUDIBLE_BINS; k++)
        power[k] /= pushed * pushed * (k == 0 || k == AUDIBLE_BINS - 1 ? 8.5 : 16);
    return true;
}

static bool audible_power(const struct scene *s, const struct contact *c, const double place[2], double *power,
                          struct err *e)
{
    struct scene own = *s;
    struct contact struck = *c;
    struct plan p;
    struct run r;
    for (int k = 0; k < AUDIBLE_BINS; k++)
        power[k] = 1;
    if (s->output.quantity == QUANTITY_FORCE || !response_rings(c) || c->gain == 0) return true;
    struct arena *a = arena_open();
    strike(&struck, place, s->output.sample_rate, a);
    own.contacts = &struck;
    own.n_contacts = 1;
    own.output.stems = NULL;
    own.output.diagnostics.given = false;
    own.output.impacts = LISTING_NONE;
    bool ok = plan_make(stages_table, &struck, &own, a, &p, e) && run_open(&r, &p, &own, NULL, e);
    if (ok) {
        ok = measure(&r, a, power, e);
        run_close(&r);
    }
    arena_close(a);
    return ok;
}

/* ------------------------------------------------------------------ which */

/* Is the force read from the ground wherever the contact is, so that it can begin anywhere? */
static bool anywhere(const struct contact *c)
{
    return (c->contact.model == CONTACT_SCRAPE || c->contact.model == CONTACT_ROLL ||
            c->contact.model == CONTACT_PLAYBACK) &&
           c->motion.path != PATH_STILL;
}

/* In the order of time; what overlaps another, which stands for it, is left out. */
static void stretch_add(struct segments *x, long from, long frames, double weight)
{
    struct segments_stretch s = {.from = from, .frames = frames, .weight = weight};
    for (int i = 0; i < x->n; i++)
        if (labs(x->stretch[i].from - from) < frames) return;
    int at = x->n++;
    for (; at > 0 && x->stretch[at - 1].from > from; at--)
        x->stretch[at] = x->stretch[at - 1];
    x->stretch[at] = s;
}

static void stretch_at(struct segments *x, const double *sum, double step, int cell, int parts)
{
    double rate = x->scene.output.sample_rate, share = (sum[cell + 1] - sum[cell]) / sum[GRID],
           stands = step / (share * parts);
    long from = (long)rint((cell + 0.5) * step * rate) - SEGMENTS_WINDOW / 2, last = x->moving - SEGMENTS_WINDOW;
    stretch_add(x,
                from < 0      ? 0
                : from > last ? last
                              : from,
                SEGMENTS_WINDOW, stands * rate / (SEGMENTS_WINDOW * TAPERED));
}

/* As many parts as the motion has windows, twelve times over, so that they cost little of it. sum: squares of the
   speed, cumulated, at GRID instants' ends. */
static void choose_spread(struct segments *x, const struct trajectory *tr)
{
    long windows = x->moving / (12 * SEGMENTS_WINDOW);
    int parts = windows < SEGMENTS_LEAST ? SEGMENTS_LEAST : windows > SEGMENTS_MOST ? SEGMENTS_MOST : (int)windows;
    double sum[GRID + 1] = {0}, most = 0;
    int cell = 0, fastest = 0;
    for (int i = 0; i < GRID; i++) {
        double t = (i + 0.5) * tr->duration / GRID, v;
        trajectory_at(tr, 1, &t, (struct trajectory_out){.du = &v});
        fastest = v * v > most ? i : fastest;
        most = fmax(most, v * v);
        sum[i + 1] = sum[i] + v * v;
    }
    for (int k = 0; k < parts - 1; k++) {
        double golden = 0.6180339887498949 * (k + 1), at = (k + golden - floor(golden)) / (parts - 1);
        while (cell < GRID - 1 && sum[cell + 1] <= at * sum[GRID])
            cell++;
        stretch_at(x, sum, tr->duration / GRID, cell, parts);
    }
    stretch_at(x, sum, tr->duration / GRID, fastest, parts);
}

bool segments_make(const struct scene *s, const struct contact *c, double first, bool moves, struct arena *a,
                   struct segments *x, struct err *e)
{
    struct trajectory tr;
    *x = (struct segments){.lead = SETTLED,
                           .scene = *s,
                           .contact = *c,
                           .gain = c->gain,
                           .power = ARENA_TAKE(a, double, SEGMENTS_PLACES *AUDIBLE_BINS)};
    if (c->gain == 0) /* it is here for its table, which holds its force as it is */
        x->gain = x->contact.gain = 1;
    *(bool *)params_edit(&x->contact, enhance_stage.params, a) = false; /* segments.h has it */
    x->scene.contacts = &x->contact;
    x->scene.n_contacts = 1;
    x->scene.output.quantity = QUANTITY_FORCE;
    x->scene.output.stems = NULL;
    x->scene.output.listen.given = false;
    x->scene.output.channels = 1;
    x->scene.output.diagnostics.given = false;
    x->scene.output.impacts = LISTING_NONE;
    if (!trajectory_make(&c->motion, trajectory_seed(s, c), a, &tr, e)) return err_at(e, "contact '%s'", c->name);
    x->moving = trajectory_frames(&tr, s->output.sample_rate);
    bool any = anywhere(c);
    long some = (long)ceil(first * s->output.sample_rate);
    if (any && tr.top_speed > 0 && x->moving > 2 * SEGMENTS_LEAST * SEGMENTS_WINDOW)
        choose_spread(x, &tr);
    else {
        if (some > x->moving || any) some = x->moving;
        some = some < SEGMENTS_WINDOW ? SEGMENTS_WINDOW : some;
        stretch_add(x, 0, some, (double)x->moving / (double)some / (2 * TAPERED));
    }
    for (int i = 0; i < x->n; i++) {
        struct segments_stretch *at = &x->stretch[i];
        double t = ((double)at->from + 0.5 * (double)at->frames) / s->output.sample_rate;
        trajectory_at(&tr, 1, &t, (struct trajectory_out){.x = &at->place[0], .y = &at->place[1]});
        x->frames += at->frames;
    }
    x->drift = c->contact.model == CONTACT_ROLL_COUPLED ? fmax(1, (double)x->moving / (double)x->frames) : 1;
    if (!plan_make(stages_table, &x->contact, &x->scene, a, &x->plan, e)) return false;
    /* One power for all, or of a response that moves, that in the middle of each third of the stretches. */
    int n = moves && x->n >= SEGMENTS_PLACES ? SEGMENTS_PLACES : 1;
    for (int k = 0; k < n; k++)
        if (!audible_power(s, c, x->stretch[(2 * k + 1) * x->n / (2 * n)].place, x->power + k * AUDIBLE_BINS, e))
            return false;
    for (int i = 0; i < x->n; i++)
        x->stretch[i].weighting = i * n / x->n;
    x->knobs = plan_knobs(&x->plan);
    return true;
}

/* ------------------------------------------------------------------ running */

/* Each stretch begins as many frames before as the stages look back, unless what was run last ends there anyway. Where
   it begins the limited trajectory begins, too, and that is felt for a while: so it is where the first, coarsest run
   has it for all, and SETTLED frames more than that needed. */
static bool run_stretches(struct segments *x, struct run *r, double *force, struct err *e)
{
    long at = 0;
    for (int i = 0; !x->settled && i < r->n; i++)
        x->lead += r->stages[i].back + r->stages[i].ahead;
    x->settled = true;
    for (int i = 0; i < x->n; force += x->stretch[i++].frames) {
        const struct segments_stretch *s = &x->stretch[i];
        if (s->from - x->lead > at) run_skip(r, at = s->from - x->lead);
        for (long end, last = s->from + s->frames; at < last; at = end) {
            end = at + STAGE_BLOCK < last ? at + STAGE_BLOCK : last;
            if (!run_block(r, end, e)) return false;
            long first = at > s->from ? at : s->from;
            if (first < end)
                memcpy(force + (first - s->from), board_at(&r->board, ITEM_FORCE, first),
                       (size_t)(end - first) * sizeof *force);
        }
    }
    return true;
}

bool segments_can(struct segments *x, const struct accuracy *set, struct err *e)
{
    struct run r;
    x->scene.accuracy = *set;
    bool ok = run_open(&r, &x->plan, &x->scene, NULL, e);
    if (ok) run_close(&r);
    return ok;
}

bool segments_run(struct segments *x, const struct accuracy *set, double *force, struct err *e)
{
    struct run r;
    x->scene.accuracy = *set;
    if (!run_open(&r, &x->plan, &x->scene, NULL, e)) return false;
    bool ok = run_stretches(x, &r, force, e);
    x->bounces = r.board.roll.bounces > x->bounces ? r.board.roll.bounces : x->bounces;
    x->lift_offs = r.board.roll.lift_offs > x->lift_offs ? r.board.roll.lift_offs : x->lift_offs;
    run_close(&r);
    return ok;
}

/* ------------------------------------------------------------------ hearing */

struct hearing {
    struct fft *fft;
    double taper[SEGMENTS_WINDOW], x[SEGMENTS_WINDOW], re[AUDIBLE_BINS], im[AUDIBLE_BINS];
};

/* The window that begins at `from`, which may lie before the stretch, and end after it. */
static double window_energy(struct hearing *h, const double *force, long frames, long from, const double *power)
{
    double sum = 0, any = 0;
    for (long i = 0; i < SEGMENTS_WINDOW; i++) {
        h->x[i] = from + i >= 0 && from + i < frames ? h->taper[i] * force[from + i] : 0;
        any = fmax(any, fabs(h->x[i]));
    }
    if (any == 0) return 0;
    fft_forward(h->fft, h->x, h->re, h->im);
    for (int k = 0; k < AUDIBLE_BINS; k++)
        sum += (k == 0 || k == AUDIBLE_BINS - 1 ? 1 : 2) * power[k] * (h->re[k] * h->re[k] + h->im[k] * h->im[k]);
    return sum / SEGMENTS_WINDOW;
}

double segments_energy(const struct segments *x, const double *force)
{
    struct hearing h = {.fft = fft_open(SEGMENTS_WINDOW)};
    double all = 0;
    for (int i = 0; i < SEGMENTS_WINDOW; i++) {
        double s = real_sin(REAL_PI * (i + 0.5) / SEGMENTS_WINDOW);
        h.taper[i] = s * s;
    }
    for (int i = 0; i < x->n; force += x->stretch[i++].frames) {
        const struct segments_stretch *s = &x->stretch[i];
        bool one = s->frames == SEGMENTS_WINDOW && x->n > 1;
        double sum = 0;
        for (long from = one ? 0 : -SEGMENTS_WINDOW / 2; from < (one ? 1 : s->frames); from += SEGMENTS_WINDOW / 2)
            sum += window_energy(&h, force, s->frames, from, x->power + s->weighting * AUDIBLE_BINS);
        all += s->weight * sum;
    }
    fft_close(h.fft);
    return x->gain * x->gain * all;
}
