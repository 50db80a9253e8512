/* Total response: surface + eta x scraper (papers/000 section 2.4: the scraper's response is "weighted by eta"; its equation 11 omits it). */
#include "convolution/ring.h"

#include <math.h>

#include "scene/rules.h"
#include "trajectory/trajectory.h"

static const struct response *ring_given(const struct contact *c, enum ring_body body)
{
    return body == RING_SURFACE ? &c->surface.response : &c->scraper.response;
}

bool ring_is_table(const struct response *given)
{
    return rules_is_table(given);
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

static bool ring_beyond(const struct ring *g, const struct stage_run *r, const double place[2], double out, struct err *e)
{
    return err_set(e, ERR_SCENE,
                   "contact '%s': the motion reaches [%g m, %g m], %.3g m beyond the places of %s (%g to %g m along their line); "
                   "move it, or set surface.extrapolate: nearest",
                   r->contact->name, place[0], place[1], out, g->given->file, g->modes.along[0], g->modes.along[g->modes.places - 1]);
}

/* The places' hull is convex. A straight motion is inside when its ends are; of a curved one as many instants are looked at as show all of
   its shape: what is left out between two of them is far less than the distance of two places. */
static bool ring_inside(const struct ring *g, const struct stage_run *r, struct err *e)
{
    const struct trajectory *tr = r->board->trajectory;
    double *re = ARENA_TAKE(r->arena, double, g->modes.n), *im = ARENA_TAKE(r->arena, double, g->modes.n);
    long steps = tr->straight ? 1 : tr->detail;
    for (long i = 0; i <= steps; i++) {
        double t = tr->duration * (double)i / (double)steps, p[2];
        if (tr->straight)
            for (int xy = 0; xy < 2; xy++)
                p[xy] = tr->from[xy] + tr->reach[i] * tr->e[xy];
        else
            trajectory_at(tr, 1, &t, (struct trajectory_out){.x = &p[0], .y = &p[1]});
        double out = modes_gains_at(&g->modes, p[0], p[1], re, im);
        if (out > 1e-9)
            return ring_beyond(g, r, p, out, e);
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
    return ring_same_quantity(g, r->board, e) && (!g->moves || g->given->extrapolate != EXTRAPOLATE_ERROR || ring_inside(g, r, e));
}

void ring_gains_at(const struct ring *g, const struct board *b, double t, double *re, double *im)
{
    double place[2] = {0, 0};
    if (g->body == RING_SURFACE) {
        if (g->moves)
            trajectory_continued(b->trajectory, t, place);
        modes_gains_at(&g->modes, place[0], place[1], re, im); /* of one place: its gains, wherever the contact is */
        return;
    }
    for (int i = 0; i < g->modes.n; i++) {
        re[i] = g->weight * g->modes.gain_re[i];
        im[i] = g->weight * g->modes.gain_im[i];
    }
}
