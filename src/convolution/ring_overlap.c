/* The surface's and the scraper's responses by fast convolution: an impulse response from a WAV, which does not move, or modes sampled at nodes along
   the motion: overlap_add.h (every place launches its own response) or readout.h (all is heard through the present place's; also without impulse
   responses, by resonators: readout_modes.h). Modes without
   response_length are kept until every one has decayed by 140 dB (more where a smaller error is asked for); with it the response is cut at t0 (papers/000 equation 10). */
#include <math.h>
#include <string.h>

#include "convolution/gammatone.h"
#include "convolution/overlap_add.h"
#include "convolution/readout.h"
#include "convolution/readout_modes.h"
#include "convolution/ring.h"
#include "response/ir.h"

struct overlap_voice {
    const struct ring *ring;
    const struct ring_voice *voice;
    struct ir_sampler *sampler;
    struct modes_point point;
    struct overlap_add *launch; /* one of the three */
    struct readout *readout;
    struct readout_modes *modes;
};

struct ring_overlap {
    struct ring ring;
    struct ir ir;                 /* a WAV's */
    struct overlap_voice *voices; /* [channels]; of a WAV one */
    int n;
};

static void response_wav(void *self, long k, double *h, size_t length)
{
    const struct ring_overlap *s = self;
    (void)k;
    for (size_t i = 0; i < length; i++)
        h[i] = s->ring.weight * s->ir.h[i];
}

static void response_modes(void *self, long k, double *h, size_t length)
{
    struct overlap_voice *v = self;
    ring_point_at(v->ring, v->voice, (double)k * v->ring->choice->hop, &v->point);
    gammatone_sample(v->ring->choice->gamma, v->ring->board->rate, v->sampler, listener_quantity(v->voice->listener), &v->point, h, length);
}

static bool open_wav(struct ring_overlap *s, struct stage_run *r, const struct response *given, struct err *e)
{
    const char *dot = strrchr(given->file, '.');
    if (!ir_read(&(struct ir_ask){given->file, r->board->rate, given->length, r->scene->shelf}, r->arena, &s->ir, e))
        return dot && strcmp(dot, ".wav") == 0 ? false : err_at(e, "a response is a mode table (NAME.csv), a sound file, or a folder of them");
    r->board->unstated = true;
    r->board->ring = fmax(r->board->ring, (double)s->ir.length / r->board->rate);
    s->voices = ARENA_TAKE(r->arena, struct overlap_voice, 1);
    s->voices[0].launch = overlap_add_open(s->ir.length, 0, 0, response_wav, s);
    s->n = 1;
    return true;
}

static void point_modes(void *self, double frame, const struct modes_point *p)
{
    const struct overlap_voice *v = self;
    ring_point_at(v->ring, v->voice, frame, p);
}

/* Readout by resonators: c->hops. */
static void voice_recall(struct overlap_voice *v, struct stage_run *r)
{
    const struct ring_choice *c = v->ring->choice;
    struct readout_modes_ask ask = {.n = v->voice->n, .order = c->order, .rate = r->board->rate, .hop = ring_component_hops(v->ring, v->voice, r->arena),
                                    .decibel = c->forgotten, .seconds = c->seconds, .quantity = listener_quantity(v->voice->listener)};
    v->modes = readout_modes_open(&ask, point_modes, v);
}

static void voice_open(struct ring_overlap *s, struct stage_run *r, int channel, size_t length)
{
    const struct ring_choice *c = s->ring.choice;
    struct overlap_voice *v = &s->voices[channel];
    v->ring = &s->ring;
    v->voice = &s->ring.voices[channel];
    if (c->engine == RING_READOUT && c->hops) {
        voice_recall(v, r);
        return;
    }
    v->sampler = ir_sampler_make(r->arena, v->voice->n, r->board->rate);
    v->point = modes_point_make(r->arena, v->voice->n);
    if (c->engine == RING_READOUT)
        v->readout = readout_open(length, c->order, c->hop, response_modes, v);
    else
        v->launch = overlap_add_open(length, s->ring.moves ? c->order : 0, s->ring.moves ? c->hop : 0, response_modes, v);
}

static bool open_modes(struct ring_overlap *s, struct stage_run *r)
{
    s->voices = ARENA_TAKE(r->arena, struct overlap_voice, s->ring.channels);
    for (; s->n < s->ring.channels; s->n++)
        voice_open(s, r, s->n, ir_length(r->board->rate, s->ring.choice->seconds));
    return true;
}

static bool ring_overlap_open(struct stage_run *r, enum ring_body body, struct err *e)
{
    struct ring_overlap *s = ARENA_TAKE(r->arena, struct ring_overlap, 1);
    const struct response *given = body == RING_SURFACE ? &r->contact->surface.response : &r->contact->scraper.response;
    r->state = s;
    if (!ring_open(&s->ring, r, body, e) || !(s->ring.choice->recorded ? open_wav(s, r, given, e) : open_modes(s, r)))
        return false;
    if (!s->voices[0].modes) {
        int ahead = s->voices[0].readout ? readout_ahead(s->voices[0].readout) : overlap_add_ahead(s->voices[0].launch);
        r->ahead = r->ahead > ahead ? r->ahead : ahead;
    }
    return true;
}

static bool ring_overlap_run(struct stage_run *r, long from, long to, struct err *e)
{
    struct ring_overlap *s = r->state;
    (void)e;
    for (int k = 0; k < s->n; k++) {
        const struct overlap_voice *v = &s->voices[k];
        const double *f = v->voice ? ring_force(&s->ring, v->voice, from) : board_at(r->board, ITEM_FORCE, from);
        memset(s->ring.y, 0, (size_t)(to - from) * sizeof *s->ring.y);
        if (v->modes)
            readout_modes_run(v->modes, f, s->ring.y, to - from);
        else if (v->readout)
            readout_run(v->readout, f, s->ring.y, to - from);
        else
            overlap_add_run(v->launch, f, s->ring.y, to - from);
        for (int channel = k; channel < s->ring.channels; channel += s->n)
            ring_put(&s->ring, channel, from, to);
    }
    return true;
}

static void ring_overlap_close(struct stage_run *r)
{
    const struct ring_overlap *s = r->state;
    for (int k = 0; s && k < s->n; k++) {
        if (s->voices[k].launch)
            overlap_add_close(s->voices[k].launch);
        if (s->voices[k].modes)
            readout_modes_close(s->voices[k].modes);
        if (s->voices[k].readout)
            readout_close(s->voices[k].readout);
    }
}

static bool surface_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return ring_choice_engine(c, RING_SURFACE) == RING_OVERLAP;
}

static bool readout_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return ring_choice_engine(c, RING_SURFACE) == RING_READOUT;
}

static bool scraper_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return ring_choice_engine(c, RING_SCRAPER) == RING_OVERLAP;
}

static bool surface_open(struct stage_run *r, struct err *e)
{
    return ring_overlap_open(r, RING_SURFACE, e);
}

static bool scraper_open(struct stage_run *r, struct err *e)
{
    return ring_overlap_open(r, RING_SCRAPER, e);
}

const struct stage ring_overlap_surface_stage = {
    .name = "surface_overlap_add",
    .does = "the surface rings by fast convolution with its impulse response",
    .paper = "000 eq. 10, 13",
    .idle = "no impulse response for the surface, or its modes go by another engine",
    .needs = ITEM_BIT(ITEM_FORCE),
    .gives = ITEM_BIT(ITEM_SURFACE_SOUND),
    .wanted = surface_wanted,
    .turns = ring_choice_surface_turns,
    .work = ring_choice_surface_work,
    .open = surface_open,
    .run = ring_overlap_run,
    .close = ring_overlap_close,
};

const struct stage ring_overlap_readout_stage = {
    .name = "surface_readout",
    .does = "all past force is heard through the surface's response at the present place",
    .paper = "000 eq. 10, 13",
    .idle = "surface.moving is not readout",
    .needs = ITEM_BIT(ITEM_FORCE),
    .gives = ITEM_BIT(ITEM_SURFACE_SOUND),
    .wanted = readout_wanted,
    .turns = ring_choice_surface_turns,
    .work = ring_choice_surface_work,
    .open = surface_open,
    .run = ring_overlap_run,
    .close = ring_overlap_close,
};

const struct stage ring_overlap_scraper_stage = {
    .name = "scraper_overlap_add",
    .does = "the scraper or ball rings by fast convolution with its impulse response",
    .paper = "000 eq. 11",
    .idle = "scraper or ball is damped (weight 0), has no impulse response, or its modes go by resonators",
    .needs = ITEM_BIT(ITEM_FORCE),
    .gives = ITEM_BIT(ITEM_SCRAPER_SOUND),
    .wanted = scraper_wanted,
    .turns = ring_choice_scraper_turns,
    .work = ring_choice_scraper_work,
    .open = scraper_open,
    .run = ring_overlap_run,
    .close = ring_overlap_close,
};
