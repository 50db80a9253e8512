/* The surface's and the scraper's modes as resonators (convolution/resonators.h): exact for poles that do not move. Gains are evaluated
   every accuracy.gain_ramp samples, at multiples of it, and ramped linearly between. */
#include <math.h>

#include "convolution/resonators.h"
#include "convolution/ring.h"

struct ring_bank {
    struct ring ring;
    struct resonators *bank;
    int ramp;
    double *re[3], *im[3]; /* gains at the ramp's start, at its end, and where the block ends between */
    long ramp_end;         /* frame; the ramp began at ramp_end - ramp */
};

static bool ring_bank_open(struct stage_run *r, enum ring_body body, struct err *e)
{
    struct ring_bank *s = ARENA_TAKE(r->arena, struct ring_bank, 1);
    s->ring = ring_make(r, body);
    r->state = s;
    if (!ring_is_table(s->ring.given))
        return err_set(e, ERR_SCENE, "%s: resonators need a mode table (.csv): leave %s.convolution out, or set it to overlap_add",
                       s->ring.given->file, s->ring.key);
    if (!isnan(s->ring.given->length))
        return err_set(e, ERR_SCENE, "contact '%s': resonators ring on for ever and cannot be cut: leave %s.response_length out, or set "
                       "%s.convolution to overlap_add", r->contact->name, s->ring.key, s->ring.key);
    if (!ring_read_modes(&s->ring, r, e))
        return false;
    double ring = modes_ring_time(&s->ring.modes, 80);
    r->board->ring = ring > r->board->ring ? ring : r->board->ring;
    s->ramp = s->ring.moves ? (int)r->scene->accuracy.gain_ramp : STAGE_BLOCK;
    s->bank = resonators_make(r->arena, &s->ring.modes, r->board->rate, s->ramp);
    for (int k = 0; k < 3; k++) {
        s->re[k] = ARENA_TAKE(r->arena, double, s->ring.modes.n);
        s->im[k] = ARENA_TAKE(r->arena, double, s->ring.modes.n);
    }
    ring_gains_at(&s->ring, r->board, 0, s->re[1], s->im[1]);
    resonators_set_gains(s->bank, s->re[1], s->im[1]);
    return true;
}

static void ring_next_ramp(struct ring_bank *s, const struct board *b)
{
    double *re = s->re[0], *im = s->im[0];
    s->ramp_end += s->ramp;
    if (!s->ring.moves)
        return;
    s->re[0] = s->re[1], s->re[1] = re;
    s->im[0] = s->im[1], s->im[1] = im;
    ring_gains_at(&s->ring, b, (double)(s->ramp_end - 1) / b->rate, re, im);
}

/* Gains of the last sample before a frame inside the ramp. */
static void ring_between(struct ring_bank *s, long frame)
{
    double share = 1 - (double)(s->ramp_end - frame) / s->ramp;
    for (int i = 0; i < s->ring.modes.n; i++) {
        s->re[2][i] = s->re[0][i] + share * (s->re[1][i] - s->re[0][i]);
        s->im[2][i] = s->im[0][i] + share * (s->im[1][i] - s->im[0][i]);
    }
}

static bool ring_bank_run(struct stage_run *r, long from, long to, struct err *e)
{
    struct ring_bank *s = r->state;
    (void)e;
    double *y = board_at(r->board, s->ring.out, from);
    const double *f = board_at(r->board, ITEM_FORCE, from);
    for (long n = from; n < to; n++)
        y[n - from] = 0;
    for (long n = from, end; n < to; n = end) {
        if (n == s->ramp_end)
            ring_next_ramp(s, r->board);
        end = s->ramp_end < to ? s->ramp_end : to;
        int which = end == s->ramp_end || !s->ring.moves ? 1 : 2;
        if (which == 2)
            ring_between(s, end);
        resonators_run(s->bank, f + (n - from), y + (n - from), (int)(end - n), s->re[which], s->im[which]);
    }
    return true;
}

static double ring_bank_work(const struct contact *c, const struct scene *s)
{
    (void)s;
    return 10 + 2.0 * c->surface.response.modes;
}

static double ring_scraper_work(const struct contact *c, const struct scene *s)
{
    (void)s;
    return 10 + 2.0 * c->scraper.response.modes;
}

static bool surface_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return ring_wanted(c, RING_SURFACE, ENGINE_RESONATORS);
}

static bool scraper_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return ring_wanted(c, RING_SCRAPER, ENGINE_RESONATORS);
}

static bool surface_open(struct stage_run *r, struct err *e)
{
    return ring_bank_open(r, RING_SURFACE, e);
}

static bool scraper_open(struct stage_run *r, struct err *e)
{
    return ring_bank_open(r, RING_SCRAPER, e);
}

const struct stage ring_resonators_surface_stage = {
    .name = "surface_resonators",
    .does = "the surface's modes ring, one exact recursion each, gains following the contact",
    .paper = "000 eq. 10, 13",
    .idle = "no mode table for the surface, or it goes by overlap-add",
    .needs = ITEM_BIT(ITEM_FORCE),
    .gives = ITEM_BIT(ITEM_SURFACE_SOUND),
    .wanted = surface_wanted,
    .work = ring_bank_work,
    .open = surface_open,
    .run = ring_bank_run,
};

const struct stage ring_resonators_scraper_stage = {
    .name = "scraper_resonators",
    .does = "the scraper's modes ring, one exact recursion each",
    .paper = "000 eq. 11",
    .idle = "the scraper is damped (weight 0), has no mode table, or it goes by overlap-add",
    .needs = ITEM_BIT(ITEM_FORCE),
    .gives = ITEM_BIT(ITEM_SCRAPER_SOUND),
    .wanted = scraper_wanted,
    .work = ring_scraper_work,
    .open = scraper_open,
    .run = ring_bank_run,
};
