/* surface.residual: besides its modes the surface sounds a residual, what a recording of a strike on an object of its
   material holds besides modes (papers/003 D), transferred to the modes that ring here (response/residual.h).

   A residual is the response to one strike of known momentum, so it is taken as a part of the response: the contact's
   force, whatever makes it, is convolved with it, as with a recorded response. It is made once, when the stage opens,
   for each listening place, from the modes as they are heard there where the motion begins; of a contact that moves
   from their mean squares over the way, as a residual has no nodes. */
#include <jansson.h>
#include <limits.h>
#include <math.h>
#include <string.h>

#include "convolution/overlap_add.h"
#include "convolution/ring.h"
#include "file/json_value.h"
#include "num/real.h"
#include "response/listener.h"
#include "response/residual.h"
#include "response/response.h"
#include "scene/rows.h"
#include "scene/scene_part.h"

/* ------------------------------------------------------------------ parameters */

#define RESIDUAL "surface.residual"

struct surface_residual {
    const char *file; /* NULL: none */
    int inverse, shift;
    double gain;
};

static const struct choice inverses[] = {
    [RESIDUAL_PHASES] = {"phases", "from phases carried along with it, then 50 rounds of Griffin and Lim"},
    [RESIDUAL_NOISE] = {"noise",
                        "the first 20 ms as they are, then noise from the seed, in third octaves that follow it"},
    {NULL, NULL}};

static const struct choice shifts[] = {
    [RESIDUAL_DIFFERENCE] = {"difference", "by the difference of two modes' frequencies, as Ren et al. (2013) have it"},
    [RESIDUAL_RATIO] = {"ratio", "by their ratio, as all frequencies of bodies alike do"},
    {NULL, NULL}};

static const struct key keys[] = {
    {ROW_FILE(surface_residual, file, RESIDUAL), KEY_NONE, 0, 0, "", NULL,
     "what the surface sounds besides its modes: the residual.yaml in a folder that rasp modes residual wrote",
     .shown = "oak/residual.yaml"},
    {ROW_CHOICE(surface_residual, inverse, "surface.residual_inverse"), KEY_NONE, 0, 0, "phases", RESIDUAL,
     "how a sound is made from the spectrogram that is transferred", inverses},
    {ROW_CHOICE(surface_residual, shift, "surface.residual_shift"), KEY_NONE, 0, 0, "ratio", RESIDUAL,
     "how what lies about a mode moves to another frequency", shifts},
    {ROW_NUMBER(surface_residual, gain, "surface.residual_gain"), KEY_NONE, 0, 1000, "1", RESIDUAL,
     "factor on it; 1: for the same force as loud beside the modes as on the object that was recorded"},
    {.path = NULL}};

static void check(const struct scene_part *p, const struct contact *c, const void *own)
{
    const struct surface_residual *s = own;
    const struct response *r = &c->surface.response;
    if (!s->file) return;
    if (!response_given(r))
        scene_part_refuse(p, RESIDUAL, RESIDUAL,
                          "give surface.response (a mode table) or surface.object, or leave it out",
                          " needs the surface's modes, and the surface has none");
    else if (response_is_recorded(r))
        scene_part_refuse(p, RESIDUAL, "surface.response", "leave surface.residual out",
                          " needs modes, and %s is recorded: it holds what is besides modes already",
                          scene_part_label(p, "surface.response"));
    else if (r->gammatone > 1)
        scene_part_refuse(p, RESIDUAL, "surface.gammatone", "leave one of them out",
                          " begins at once, and the modes by %s do not", scene_part_label(p, "surface.gammatone"));
}

static bool given(const struct contact *c);

static const struct params surface_residual_params = {
    .section = RESIDUAL, .size = sizeof(struct surface_residual), .keys = keys, .check = check, .given = given};

static const struct surface_residual *given_of(const struct contact *c)
{
    return params_of(c, &surface_residual_params);
}

static bool given(const struct contact *c) { return given_of(c)->file != NULL; }

/* ------------------------------------------------------------------ the stage */

enum { INSTANTS = 16 }; /* of a contact that moves */

struct residual_output {
    const struct ring_output *voice;
    struct residual_transferred sound;
    struct overlap_add *convolution;
    double energy; /* of what it sounded */
};

struct residual_run {
    struct residual_output *outputs; /* [channels] */
    double modes;                    /* energy of what sounded without it, of the first channel */
    double y[STAGE_BLOCK];
};

static bool wanted(const struct contact *c, const struct scene *s)
{
    return given(c) && given_of(c)->gain > 0 && response_surface_rings(c) && s->output.quantity != QUANTITY_FORCE;
}

/* As of a recorded response of a second (ring_choice.c): how long it is its file says. */
static double work(const struct contact *c, const struct scene *s)
{
    (void)c;
    return (70 + s->output.sample_rate / 200) * listener_channels(&s->output);
}

/* As they are heard by the voice. */
static struct residual_modes modes_of(const struct stage_run *r, const struct ring_output *v)
{
    const struct ring *g = r->board->surface_ring;
    struct modes_point p = modes_point_make(r->arena, v->n), first = modes_point_make(r->arena, v->n);
    double *square = ARENA_TAKE(r->arena, double, v->n), last = (double)r->board->moving;
    int instants = g->moves ? INSTANTS : 1;
    for (int k = 0; k < instants; k++) {
        ring_point_at(g, v, (double)v->delay + last * k / instants, k ? &p : &first);
        for (int i = 0; i < v->n; i++) {
            const struct modes_point *at = k ? &p : &first;
            square[i] += (at->re[i] * at->re[i] + at->im[i] * at->im[i]) / instants;
        }
    }
    for (int i = 0; i < v->n; i++)
        square[i] = sqrt(square[i]);
    return (struct residual_modes){v->n, first.frequency, first.decay, square, NULL};
}

/* The first sample counts half, as of any response (response/ir.h). */
static void response(void *self, long k, double *h, size_t length)
{
    const struct residual_transferred *t = &((const struct residual_output *)self)->sound;
    (void)k;
    memcpy(h, t->x, length * sizeof *h);
    h[0] *= 0.5;
}

static bool open_stage(struct stage_run *r, struct err *e)
{
    r->works = r->board->lingers ? LONG_MAX : r->board->moving;
    const struct surface_residual *given = given_of(r->contact);
    struct residual_run *s = ARENA_TAKE(r->arena, struct residual_run, 1);
    const struct ring *g = r->board->surface_ring;
    struct residual source;
    r->state = s;
    s->outputs = ARENA_TAKE(r->arena, struct residual_output, g->channels);
    if (!residual_read(given->file, r->board->rate, r->arena, &source, e))
        return err_about(e, r->contact->name, RESIDUAL);
    if (source.note) board_warn(r->board, source.note);
    for (int k = 0; k < g->channels; k++) {
        struct residual_output *o = &s->outputs[k];
        o->voice = &g->outputs[k];
        struct residual_modes target = modes_of(r, o->voice);
        struct residual_ask ask = {
            &source, &target, given->inverse, given->shift,
            noise_make(r->scene->seed, arena_format(r->arena, "residual/%s/%d", r->contact->name, k))};
        if (!residual_transfer(&ask, r->arena, &o->sound, e))
            return err_at(e, "contact '%s': %s", r->contact->name, given->file) ||
                   err_about(e, r->contact->name, RESIDUAL);
        for (long i = 0; i < o->sound.n; i++)
            o->sound.x[i] *= given->gain / r->board->rate;
        o->convolution = overlap_add_open(
            &(struct overlap_add_source){.n = 1, .length = (size_t)o->sound.n, .response = response, .self = o});
        r->board->ring = fmax(r->board->ring, (double)o->sound.n / r->board->rate);
        r->back = o->voice->delay > r->back ? (int)o->voice->delay : r->back;
    }
    r->ahead = OVERLAP_ADD_BLOCK - 1;
    return true;
}

static bool run(struct stage_run *r, long from, long to, struct err *e)
{
    struct residual_run *s = r->state;
    const struct ring *g = r->board->surface_ring;
    (void)e;
    for (int k = 0; k < g->channels; k++) {
        double *out = board_at(r->board, ITEM_SURFACE_SOUND, from) + k;
        memset(s->y, 0, (size_t)(to - from) * sizeof *s->y);
        overlap_add_run(s->outputs[k].convolution, ring_force(g, s->outputs[k].voice, from), s->y, to - from);
        for (long n = 0; n < to - from; n++) {
            if (k == 0) s->modes += out[n * g->channels] * out[n * g->channels];
            s->outputs[k].energy += s->y[n] * s->y[n];
            out[n * g->channels] += s->y[n];
        }
    }
    return true;
}

static void close_stage(struct stage_run *r)
{
    const struct residual_run *s = r->state;
    for (int k = 0; s && s->outputs && k < r->board->channels; k++)
        if (s->outputs[k].convolution) overlap_add_close(s->outputs[k].convolution);
}

static struct stage_report report(const struct stage_run *r, struct arena *a)
{
    const struct residual_run *s = r->state;
    const struct residual_transferred *t = &s->outputs->sound;
    double level = 10.0 * real_log10(s->outputs->energy / s->modes);
    json_t *value = json_object();
    json_value_set(value, "pairs:i level_db:n seconds:n", t->pairs, level, (double)t->n / r->board->rate);
    const char *off = "", *loud = isfinite(level)          ? arena_format(a, "%.1f dB beside the modes", level)
                                  : s->outputs->energy > 0 ? "alone"
                                                           : "silent";
    if (isfinite(t->consistency)) {
        json_object_set_new(value, "consistency_db", json_real(t->consistency));
        off = arena_format(a, ", its spectrogram %.1f dB off what was transferred", t->consistency);
    }
    return (struct stage_report){
        "residual",
        value,
        arena_format(a, "residual by %d pair%s of modes, %s%s", t->pairs, t->pairs == 1 ? "" : "s", loud, off),
        {NULL}};
}

const struct stage surface_residual_stage = {
    .name = "surface_residual",
    .does = "what the surface sounds besides its modes: a recording's residual, transferred",
    .paper = "003 D",
    .idle = "no surface.residual, its gain is 0, or the surface does not ring",
    .params = &surface_residual_params,
    .needs = ITEM_BIT(ITEM_FORCE) | ITEM_BIT(ITEM_SURFACE_SOUND),
    .gives = ITEM_BIT(ITEM_SURFACE_SOUND),
    .wanted = wanted,
    .work = work,
    .open = open_stage,
    .run = run,
    .report = report,
    .close = close_stage,
};
