/* Which engine makes a body ring. What the scene leaves open (surface.moving: auto, surface.convolution: auto) is decided here, where the response
   has been read: poles that are the same everywhere make `fixed`, separate ones `launch`, by the cheapest engine that keeps accuracy.morph_error
   (ring_means.c). */
#include "convolution/ring_choice.h"

#include <math.h>

#include "base/stopwatch.h"
#include "convolution/ring_cost.h"
#include "convolution/ring_means.h"
#include "convolution/ring_noted.h"
#include "response/object.h"
#include "response/space.h"
#include "scene/ball.h"
#include "scene/rules.h"
#include "trajectory/trajectory.h"

/* ------------------------------------------------------------------ reading */

static bool read_object(struct ring_choosing *c, const struct modes_ask *ask, struct err *e)
{
    struct object *o = ARENA_TAKE(c->arena, struct object, 1);
    struct object_ask what = {.key = arena_format(c->arena, "%s.object", c->key), .low = ask->band[0], .top = ask->band[1], .most = 4 * ask->strongest,
                              .heard = MODES_TOP * ask->rate};
    if (!object_make(&c->given->object, &what, c->arena, o, &c->to->note, e))
        return err_at(e, "contact '%s'", c->contact->name);
    object_modes(o, c->given->object.origin, NULL, ask->strongest, c->arena, &c->to->modes);
    return true;
}

static bool read_modes(struct ring_choosing *c, struct err *e)
{
    double rate = c->scene->output.sample_rate;
    struct modes_ask ask = {.strongest = c->given->modes, .band = {c->given->band[0], c->given->band[1]}, .pairing = c->given->pairing, .rate = rate, .shelf = c->scene->shelf};
    struct modes *m = &c->to->modes;
    if (c->given->object.given ? !read_object(c, &ask, e)
        : c->given->space.given ? !space_modes(&c->given->space, &ask, c->arena, m, e)
                                : !modes_table(c->given->file, &ask, c->arena, m, e))
        return false;
    c->to->note = c->to->note ? c->to->note : m->note;
    c->to->chosen = m->n;
    c->to->high = modes_drop_above(m, rate);
    return m->n > 0 || err_set(e, ERR_SCENE, "%s: all of its modes in the band lie above %.6g Hz (0.45 times output.sample_rate), and nothing would ring: "
                                             "raise output.sample_rate, %s", m->name, MODES_TOP * rate,
                               c->given->object.given ? "or let the key band begin lower" : "or check that frequency_hz is in Hz");
}

/* ------------------------------------------------------------------ readings */

static bool moves(const struct ring_choosing *c, enum ring_body body)
{
    const struct modes *m = &c->to->modes;
    return body == RING_SURFACE && !ablation_one_place(c->contact) && ((m->moves && c->contact->motion.path != PATH_STILL) || m->travels);
}

static bool choose_reading(struct ring_choosing *c, enum ring_body body, struct err *e)
{
    const struct modes *m = &c->to->modes;
    int asked = body == RING_SURFACE ? c->given->moving : MOVING_AUTO;
    c->to->moves = moves(c, body);
    c->to->reading = asked != MOVING_AUTO ? asked : m->shared ? MOVING_FIXED : m->travels ? MOVING_GLIDE : MOVING_LAUNCH;
    if (asked == MOVING_FIXED && !m->shared && c->to->moves) {
        err_about(e, c->contact->name, "surface.moving");
        return err_set(e, ERR_SCENE, "contact '%s': surface.moving: fixed needs poles that are the same everywhere, and those of %s differ from place to "
                                     "place; leave surface.moving out, or choose launch, glide or readout", c->contact->name, m->name);
    }
    if (!c->to->moves)
        c->to->reading = MOVING_FIXED;
    return true;
}

/* ------------------------------------------------------------------ all */

/* Along the motion, unless it is known. */
static bool choose_along(struct ring_choosing *c, struct err *e)
{
    struct ring_survey_ask ask = {.modes = &c->to->modes, .trajectory = &c->trajectory, .by_speed = c->contact->contact.model == CONTACT_SCRAPE,
                                  .stays = c->to->reading == MOVING_GLIDE || c->to->reading == MOVING_READOUT,
                                  .slopes = ring_choice_glides(c->to)};
    const char *key = ring_noted_key(c->scene, c->contact, c->work);
    if (ring_noted_find(c->scene->shelf, key, c->arena, c->to))
        return true;
    ring_survey(&ask, c->work, &c->survey);
    if (!ring_means_choose(c, e))
        return false;
    ring_noted_add(c->scene->shelf, key, c->to);
    return true;
}

static bool choose_modal(struct ring_choosing *c, enum ring_body body, struct err *e)
{
    if (!read_modes(c, e))
        return err_about(e, c->contact->name, ring_choice_about(c->contact, body));
    if (!choose_reading(c, body, e))
        return false;
    if (!trajectory_make(&c->contact->motion, trajectory_seed(c->scene, c->contact), c->arena, &c->trajectory, e))
        return err_at(e, "contact '%s'", c->contact->name);
    double start = stopwatch_cpu();
    c->heard.force = c->trajectory.duration;
    if (!ring_heard(c->scene, c->contact, modes_ring_time(&c->to->modes, 80), &c->heard, e))
        return false;
    if (!c->to->moves)
        return ring_means_choose(c, e);
    c->work = arena_open();
    bool chosen = choose_along(c, e);
    c->to->cpu = stopwatch_cpu() - start;
    arena_close(c->work);
    return chosen;
}

static void choose_recorded(struct ring_choosing *c, enum ring_body body)
{
    double seconds = isnan(c->given->length) ? 1 : c->given->length, rate = c->scene->output.sample_rate;
    bool folder = rules_is_folder(c->given);
    c->to->recorded = true;
    c->to->reading = MOVING_FIXED;
    c->to->moves = folder && body == RING_SURFACE && c->contact->motion.path != PATH_STILL && !ablation_one_place(c->contact);
    c->to->engine = folder ? RING_PANNED : RING_OVERLAP;
    c->to->work = ring_cost_recorded((folder ? 8 : 1) * seconds * rate);
}

static const struct response *given_of(const struct contact *c, enum ring_body body)
{
    return body == RING_SURFACE ? &c->surface.response : &c->scraper.response;
}

bool ring_choice_make(const struct contact *c, const struct scene *s, enum ring_body body, struct arena *a, const struct ring_choice **choice,
                 struct err *e)
{
    const struct response *given = given_of(c, body);
    *choice = NULL;
    if (!rules_responds(given) || (body == RING_SCRAPER && c->scraper.weight == 0))
        return true;
    struct ring_choice *to = ARENA_TAKE(a, struct ring_choice, 1);
    struct ring_choosing me = {.contact = c, .scene = s, .given = given, .key = body == RING_SURFACE ? "surface" : ball_tool(c), .arena = a, .to = to};
    *choice = to;
    to->gamma = given->gammatone > 1 ? given->gammatone : 1;
    if (given->file && !rules_is_table(given)) {
        choose_recorded(&me, body);
        return true;
    }
    return choose_modal(&me, body, e);
}

const char *ring_choice_about(const struct contact *c, enum ring_body body)
{
    static const char *const keys[3][3] = {{"surface.response", "surface.object", "surface.space"},
                                           {"scraper.response", "scraper.object", "scraper.response"},
                                           {"ball.response", "ball.object", "ball.response"}};
    const struct response *given = given_of(c, body);
    return keys[body == RING_SURFACE ? 0 : ball_rolls(c) ? 2 : 1][given->object.given ? 1 : given->space.given ? 2 : 0];
}

enum ring_engine ring_choice_engine(const struct contact *c, enum ring_body body)
{
    const struct ring_choice *choice = given_of(c, body)->choice;
    return choice ? choice->engine : RING_NONE;
}

static double work_of(const struct contact *c, enum ring_body body)
{
    const struct ring_choice *choice = given_of(c, body)->choice;
    return choice ? choice->work : 0;
}

static unsigned knobs_of(const struct contact *c, enum ring_body body)
{
    const struct ring_choice *choice = given_of(c, body)->choice;
    return choice ? choice->knobs : 0;
}

double ring_choice_surface_work(const struct contact *c, const struct scene *s)
{
    (void)s;
    return work_of(c, RING_SURFACE);
}

double ring_choice_scraper_work(const struct contact *c, const struct scene *s)
{
    (void)s;
    return work_of(c, RING_SCRAPER);
}

unsigned ring_choice_surface_turns(const struct contact *c, const struct scene *s)
{
    (void)s;
    return knobs_of(c, RING_SURFACE);
}

unsigned ring_choice_scraper_turns(const struct contact *c, const struct scene *s)
{
    (void)s;
    return knobs_of(c, RING_SCRAPER);
}
