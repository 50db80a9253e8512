/* Total response: surface + eta x scraper (papers/000 section 2.4: the scraper's response is "weighted by eta"; its equation 11 omits it). */
#include "convolution/ring.h"

#include <math.h>
#include <string.h>

#include "trajectory/trajectory.h"

static const struct response *ring_given(const struct contact *c, enum ring_body body)
{
    return body == RING_SURFACE ? &c->surface.response : &c->scraper.response;
}

bool ring_is_table(const struct response *given)
{
    size_t n = strlen(given->file);
    return n > 4 && strcmp(given->file + n - 4, ".csv") == 0;
}

bool ring_wanted(const struct contact *c, enum ring_body body, int engine)
{
    const struct response *given = ring_given(c, body);
    if (!given->file || (body == RING_SCRAPER && c->scraper.weight == 0))
        return false;
    int chosen = given->convolution;
    if (chosen == ENGINE_AUTO)
        chosen = ring_is_table(given) && isnan(given->length) ? ENGINE_RESONATORS : ENGINE_OVERLAP_ADD;
    return chosen == engine;
}

struct ring ring_make(const struct stage_run *r, enum ring_body body)
{
    bool surface = body == RING_SURFACE;
    return (struct ring){.body = body, .given = ring_given(r->contact, body), .key = surface ? "surface" : "scraper",
                         .out = surface ? ITEM_SURFACE_SOUND : ITEM_SCRAPER_SOUND, .weight = surface ? 1 : r->contact->scraper.weight};
}

static bool ring_same_quantity(const struct ring *g, struct board *b, struct err *e)
{
    static const char *const names[] = {"displacement", "velocity", "acceleration"};
    if (b->quantity >= 0 && b->quantity != g->modes.quantity)
        return err_set(e, ERR_SCENE,
                       "%s: this mode table gives %s, but the surface's gives %s: they cannot be summed; use tables of one quantity",
                       g->given->file, names[g->modes.quantity], names[b->quantity]);
    b->quantity = g->modes.quantity;
    return true;
}

/* The hull of places on a line is convex, and so is a straight motion: its two ends tell. */
static bool ring_inside(const struct ring *g, const struct stage_run *r, struct err *e)
{
    const struct motion *m = &r->contact->motion;
    const double *ends[2] = {m->from, m->to};
    double *re = ARENA_TAKE(r->arena, double, g->modes.n), *im = ARENA_TAKE(r->arena, double, g->modes.n);
    for (int k = 0; k < 2 && g->moves && g->given->extrapolate == EXTRAPOLATE_ERROR; k++) {
        double out = modes_gains_at(&g->modes, ends[k][0], ends[k][1], re, im);
        if (out > 1e-9)
            return err_set(e, ERR_SCENE,
                           "contact '%s': the motion reaches [%g m, %g m], %.3g m beyond the places of %s (%g to %g m along their line); "
                           "move it, or set surface.extrapolate: nearest",
                           r->contact->name, ends[k][0], ends[k][1], out, g->given->file, g->modes.along[0],
                           g->modes.along[g->modes.places - 1]);
    }
    return true;
}

bool ring_read_modes(struct ring *g, struct stage_run *r, struct err *e)
{
    if (!modes_read(g->given->file, g->given->modes, r->arena, &g->modes, e))
        return false;
    int high = modes_drop_above(&g->modes, r->board->rate);
    if (g->modes.n == 0)
        return err_set(e, ERR_SCENE, "%s: all of its modes lie above %.6g Hz (0.499 times output.sample_rate), and nothing would ring: raise "
                                     "output.sample_rate, or check that frequency_hz is in Hz",
                       g->given->file, 0.499 * r->board->rate);
    if (high)
        board_warn(r->board, arena_format(r->arena, "%s: %d of its strongest modes lie above 0.499 times the sample rate and do not ring",
                                          g->given->file, high));
    g->moves = g->body == RING_SURFACE && g->modes.places > 1;
    return ring_same_quantity(g, r->board, e) && ring_inside(g, r, e);
}

void ring_gains_at(const struct ring *g, const struct board *b, double t, double *re, double *im)
{
    const struct trajectory *tr = b->trajectory;
    double u = g->moves ? trajectory_continued(tr, t) : 0;
    if (g->body == RING_SURFACE) {
        modes_gains_at(&g->modes, tr->from[0] + u * tr->e[0], tr->from[1] + u * tr->e[1], re, im);
        return;
    }
    for (int i = 0; i < g->modes.n; i++) {
        re[i] = g->weight * g->modes.gain_re[i];
        im[i] = g->weight * g->modes.gain_im[i];
    }
}
