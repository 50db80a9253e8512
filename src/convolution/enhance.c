/* The force louder near the frequencies of the surface's modes (`contact.enhance`), as FoleyAutomatic (van den Doel,
   Kry and Pai 2001) has it for what rolls: papers/002 section II-B, "an additional filtering stage that enhances the
   spectral envelope near the object's resonance modes". It prints no filter. Ours:

     f' = f + sum over modes of g_i B_i(f),   g_i = (10^(gain/20) - 1) |a_i| / max |a|

     B_i(z) = (1 - r^2)/2 (1 - z^-2) / (1 - 2 r cos(theta) z^-1 + r^2 z^-2)      r = e^(-sigma_i/rate), theta = 2 pi
       f_i/rate

   B_i has the mode's own poles, hence its bandwidth, and zeros at 0 Hz and half the rate; its gain is 1, without phase,
   at its peak (where cos is 2 r cos(theta)/(1 + r^2): at the mode but for a share (sigma/omega)^2/2), and 2 sigma
   s/(s^2 + 2 sigma s + sigma^2 + omega^2) as the rate grows. |a_i| is the mode's greatest gain on the contact's way (of
   65 instants evenly spaced), in the quantity that its table holds; those of greatest |a| count, `modes` of them. Where
   poles differ from place to place they are those of the place where the mode is strongest. The filter does not move.

   In series with the mode itself B_i is a double pole: what is enhanced begins like sigma t e^(-sigma t), a gammatone
   of gamma 2, which is Hermes' model (gammatone.c): the paper names both for the same reason.

   By the engine of resonators.h, whose modes ring as Im(A p^n): A = G (p - 1/p)/Im p, G = (1 - r^2)/2, and what is left
   of the first sample. */
#include <math.h>
#include <string.h>

#include "convolution/resonators.h"
#include "convolution/ring.h"
#include "num/real.h"
#include "response/response.h"
#include "scene/rows.h"
#include "scene/scene_part.h"
#include "stage.h"
#include "trajectory/trajectory.h"

enum { ENHANCE_INSTANTS = 64, ENHANCE_RAMP = 64 };

/* ------------------------------------------------------------------ parameters */

struct enhance { /* section contact.enhance */
    bool given;
    double gain; /* dB, at the strongest mode */
    int modes;   /* how many of the strongest */
};

static const struct key keys[] = {{ROW_NUMBER(enhance, gain, "contact.enhance.gain"), KEY_DECIBEL, 0, 80, "20 dB", NULL,
                                   "how much louder at the frequency of the strongest mode"},
                                  {ROW_COUNT(enhance, modes, "contact.enhance.modes"), KEY_NONE, 1, 1000, "20", NULL,
                                   "how many of the strongest modes"},
                                  {.path = NULL}};

static void check(const struct scene_part *p, const struct contact *c, const void *own)
{
    (void)own;
    const struct response *r = &c->surface.response;
    const char *path = "contact.enhance";
    if ((response_given(r) && !response_is_recorded(r))) return;
    if (response_is_recorded(r))
        scene_part_refuse(p, path, "surface.response",
                          "give a mode table (.csv), surface.object or surface.space, or remove contact.enhance",
                          " needs the surface's modes, and '%s' is recorded", diag_shown(p->yaml->diag, r->file));
    else
        diag_add(p->yaml->diag, yaml_find(p->map, path)->key->at,
                 "give surface.response (a mode table), surface.object or surface.space, or remove contact.enhance",
                 "%s needs the surface's modes, and the surface has none", scene_part_label(p, path));
}

static const struct params enhance_params = {
    .section = "contact.enhance",
    .meaning = "the force louder near the frequencies of the surface's modes, as FoleyAutomatic has it for what rolls",
    .size = sizeof(struct enhance),
    .keys = keys,
    .check = check,
};

static const struct enhance *enhance_of(const struct contact *c) { return params_of(c, &enhance_params); }

struct enhance_bank {
    struct resonators *bank;
    struct modes_point to;
    double direct; /* factor on the force itself */
    double y[STAGE_BLOCK];
};

/* ------------------------------------------------------------------ which modes, and how much */

/* [n] greatest |a| on the way. */
static double *enhance_sizes(const struct modes *m, const struct trajectory *tr, struct arena *a)
{
    double *size = ARENA_TAKE(a, double, m->n);
    struct modes_point p = modes_point_make(a, m->n);
    for (int k = 0; k <= ENHANCE_INSTANTS; k++) {
        struct modes_where where = ring_where(tr, tr->duration * k / ENHANCE_INSTANTS);
        modes_at(m, &where, &p);
        for (int i = 0; i < m->n; i++)
            size[i] = fmax(size[i], sqrt(p.re[i] * p.re[i] + p.im[i] * p.im[i]));
    }
    return size;
}

/* The next strongest mode, taken out of size[]; -1: none is left that moves and is damped. */
static int enhance_next(const struct modes *m, double *size, double *was)
{
    int best = -1;
    for (int i = 0; i < m->n; i++)
        if (size[i] > 0 && m->decay[i] > 0 && m->frequency[i] > 0 && (best < 0 || size[i] > size[best])) best = i;
    if (best >= 0) {
        *was = size[best];
        size[best] = 0;
    }
    return best;
}

/* Time until (x/tau)^(gamma-1) (1 + g x/gamma) e^-x, the mode's own response in series with g B, is 80 dB below its
 * greatest value. */
static double enhance_ring(double g, int gamma, double decay)
{
    double most = 0, x = 20;
    for (int k = 0; k <= 1000; k++) {
        double at = 0.01 * k, level = (1 + g * at / gamma) * real_exp(-at);
        for (int j = 1; j < gamma; j++)
            level *= at;
        most = fmax(most, level);
    }
    for (int k = 0; k < 60; k++)
        x = real_log(1e4 / most) + (gamma - 1) * real_log(fmax(x, 1)) + real_log(1 + g * fmax(x, 1) / gamma);
    return fmax(x, 0) / decay;
}

static void enhance_mode(struct enhance_bank *s, int i, double rate, double g)
{
    double r = real_exp(-s->to.decay[i] / rate), turn = 2 * s->to.frequency[i] / rate, c = real_cospi(turn),
           sine = real_sinpi(turn);
    double half = 0.5 * (1 - r * r), im = half * (r * r + 1) / (r * r);
    s->to.re[i] = g * rate * half * (r * r - 1) * c / (r * r * sine);
    s->to.im[i] = g * rate * im;
    s->direct += g * (half - 0.5 * im);
}

/* ------------------------------------------------------------------ the stage */

static const struct modes *enhance_modes(const struct stage_run *r, int *gamma, struct err *e)
{
    const struct contact *c = r->contact;
    const struct ring_choice *choice = c->surface.response.choice;
    if (!choice && !ring_choice_make(c, r->scene, RING_SURFACE, r->arena, &choice, e)) return NULL;
    if (choice && !choice->recorded) {
        *gamma = choice->gamma;
        return &choice->modes;
    }
    err_set(e, ERR_SCENE,
            "contact '%s': contact.enhance needs the surface's modes, and %s; give surface.response (a mode table), "
            "surface.object or surface.space, or remove "
            "contact.enhance",
            c->name, choice ? "its response is recorded" : "the surface has none");
    return NULL;
}

static bool enhance_open(struct stage_run *r, struct err *e)
{
    struct enhance_bank *s = ARENA_TAKE(r->arena, struct enhance_bank, 1);
    const struct enhance *asked = enhance_of(r->contact);
    double rate = r->board->rate, boost = real_exp10(asked->gain / 20) - 1, was = 0, strongest = 0, ring = 0;
    int gamma = 1, n = 0;
    const struct modes *m = enhance_modes(r, &gamma, e);
    if (!m) return false;
    double *size = enhance_sizes(m, r->board->trajectory, r->arena);
    s->to = modes_point_make(r->arena, m->n);
    s->direct = 1;
    for (int i; n < asked->modes && (i = enhance_next(m, size, &was)) >= 0; n++) {
        strongest = n ? strongest : was;
        s->to.frequency[n] = m->frequency[i];
        s->to.decay[n] = m->decay[i];
        enhance_mode(s, n, rate, boost * was / strongest);
        ring = fmax(ring, enhance_ring(boost * was / strongest, gamma, m->decay[i]));
    }
    if (n == 0)
        return err_set(e, ERR_SCENE,
                       "contact '%s': contact.enhance: no mode of %s that is damped moves where the contact goes; "
                       "remove contact.enhance",
                       r->contact->name, m->name);
    s->bank = resonators_make(r->arena, &(struct resonators_ask){.n = n,
                                                                 .quantity = MODES_VELOCITY,
                                                                 .rate = rate,
                                                                 .frequency = s->to.frequency,
                                                                 .decay = s->to.decay,
                                                                 .ramp = ENHANCE_RAMP});
    resonators_set(s->bank, &s->to);
    r->board->ring = fmax(r->board->ring, ring);
    r->board->lingers = true;
    r->state = s;
    return true;
}

static bool enhance_run(struct stage_run *r, long from, long to, struct err *e)
{
    struct enhance_bank *s = r->state;
    double *f = board_at(r->board, ITEM_FORCE, from);
    (void)e;
    for (long n = 0; n < to - from; n++)
        s->y[n] = s->direct * f[n];
    resonators_run(s->bank, f, s->y, (int)(to - from), &s->to);
    memcpy(f, s->y, (size_t)(to - from) * sizeof *f);
    return true;
}

static double enhance_work(const struct contact *c, const struct scene *s)
{
    (void)s;
    return 5 + 0.8 * fmin(enhance_of(c)->modes, c->surface.response.modes);
}

const struct stage enhance_stage = {
    .name = "enhance",
    .does = "the force louder near the frequencies of the surface's modes",
    .paper = "002 sec. II-B",
    .idle = "no contact.enhance",
    .params = &enhance_params,
    .needs = ITEM_BIT(ITEM_FORCE) | ITEM_BIT(ITEM_MOTION), /* its way */
    .gives = ITEM_BIT(ITEM_FORCE),
    .work = enhance_work,
    .open = enhance_open,
    .run = enhance_run,
};
