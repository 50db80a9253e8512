/* The surface's and the scraper's responses by overlap-add (convolution/overlap_add.h): impulse responses from a WAV, which do not move,
   or sampled from a mode table at nodes along the motion. A mode table without surface.response_length is kept until every mode has
   decayed by 140 dB; with it the response is cut at t0 (papers/000 equation 10). */
#include <math.h>
#include <string.h>

#include "convolution/overlap_add.h"
#include "convolution/ring.h"
#include "response/ir.h"

struct ring_overlap {
    struct ring ring;
    struct overlap_add *engine;
    const struct board *board;
    struct ir ir;               /* a WAV's */
    struct ir_sampler *sampler; /* a mode table's */
    double *re, *im;
    int hop;
};

static void ring_response_wav(void *self, long k, double *h, size_t length)
{
    const struct ring_overlap *s = self;
    (void)k;
    for (size_t i = 0; i < length; i++)
        h[i] = s->ring.weight * s->ir.h[i];
}

static void ring_response_modes(void *self, long k, double *h, size_t length)
{
    struct ring_overlap *s = self;
    ring_gains_at(&s->ring, s->board, (double)(k * s->hop) / s->board->rate, s->re, s->im);
    ir_sample(s->sampler, s->re, s->im, h, length);
}

static bool ring_open_wav(struct ring_overlap *s, struct stage_run *r, struct err *e)
{
    const struct response *given = s->ring.given;
    const char *dot = strrchr(given->file, '.');
    if (!ir_read(given->file, r->board->rate, given->length, r->arena, &s->ir, e))
        return dot && strcmp(dot, ".wav") == 0 ? false : err_at(e, "a response is a mode table (NAME.csv) or a sound file");
    double ring = (double)s->ir.length / r->board->rate;
    r->board->unstated = true;
    r->board->ring = fmax(r->board->ring, ring);
    s->engine = overlap_add_open(s->ir.length, 0, 0, ring_response_wav, s);
    return true;
}

static bool ring_open_table(struct ring_overlap *s, struct stage_run *r, struct err *e)
{
    const struct accuracy *accuracy = &r->scene->accuracy;
    double rate = r->board->rate, length = s->ring.given->length;
    if (!ring_read_modes(&s->ring, r, e))
        return false;
    double t0 = isnan(length) ? fmin(modes_ring_time(&s->ring.modes, 140), 60) : length;
    r->board->ring = fmax(r->board->ring, fmin(t0, modes_ring_time(&s->ring.modes, 80)));
    s->sampler = ir_sampler_make(r->arena, &s->ring.modes, rate);
    s->re = ARENA_TAKE(r->arena, double, s->ring.modes.n);
    s->im = ARENA_TAKE(r->arena, double, s->ring.modes.n);
    s->hop = (int)fmax(rint(accuracy->overlap_hop * rate), 1);
    s->engine = overlap_add_open(ir_length(rate, t0), s->ring.moves ? (int)accuracy->overlap_order : 0, s->hop, ring_response_modes, s);
    return true;
}

static bool ring_overlap_open(struct stage_run *r, enum ring_body body, struct err *e)
{
    struct ring_overlap *s = ARENA_TAKE(r->arena, struct ring_overlap, 1);
    s->ring = ring_make(r, body);
    s->board = r->board;
    r->state = s;
    if (!(ring_is_table(s->ring.given) ? ring_open_table(s, r, e) : ring_open_wav(s, r, e)))
        return false;
    r->ahead = overlap_add_ahead(s->engine);
    return true;
}

static bool ring_overlap_run(struct stage_run *r, long from, long to, struct err *e)
{
    struct ring_overlap *s = r->state;
    double *y = board_at(r->board, s->ring.out, from);
    (void)e;
    for (long n = from; n < to; n++)
        y[n - from] = 0;
    overlap_add_run(s->engine, board_at(r->board, ITEM_FORCE, from), y, to - from);
    return true;
}

static void ring_overlap_close(struct stage_run *r)
{
    struct ring_overlap *s = r->state;
    if (s && s->engine)
        overlap_add_close(s->engine);
}

static double ring_overlap_work(const struct response *given, const struct scene *s)
{
    double hop = s->accuracy.overlap_hop * s->output.sample_rate, length = (isnan(given->length) ? 1 : given->length) * s->output.sample_rate;
    double whole = length + hop * s->accuracy.overlap_order; /* three FFTs of that and the response's modes, each hop */
    return ring_is_table(given) ? (25 * whole + 0.7 * given->modes * length) / hop : 100 + length / 110;
}

static double surface_work(const struct contact *c, const struct scene *s)
{
    return ring_overlap_work(&c->surface.response, s);
}

static double scraper_work(const struct contact *c, const struct scene *s)
{
    (void)s;
    return 100 + (isnan(c->scraper.response.length) ? 1 : c->scraper.response.length) * s->output.sample_rate / 110;
}

static bool surface_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return ring_wanted(c, RING_SURFACE, ENGINE_OVERLAP_ADD);
}

static bool scraper_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return ring_wanted(c, RING_SCRAPER, ENGINE_OVERLAP_ADD);
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
    .idle = "no impulse response for the surface, or its modes go by resonators",
    .needs = ITEM_BIT(ITEM_FORCE),
    .gives = ITEM_BIT(ITEM_SURFACE_SOUND),
    .wanted = surface_wanted,
    .work = surface_work,
    .open = surface_open,
    .run = ring_overlap_run,
    .close = ring_overlap_close,
};

const struct stage ring_overlap_scraper_stage = {
    .name = "scraper_overlap_add",
    .does = "the scraper rings by fast convolution with its impulse response",
    .paper = "000 eq. 11",
    .idle = "the scraper is damped (weight 0), has no impulse response, or its modes go by resonators",
    .needs = ITEM_BIT(ITEM_FORCE),
    .gives = ITEM_BIT(ITEM_SCRAPER_SOUND),
    .wanted = scraper_wanted,
    .work = scraper_work,
    .open = scraper_open,
    .run = ring_overlap_run,
    .close = ring_overlap_close,
};
