/* Values against each other: see scene_sense.h. Each is told at that value among those involved which was laid down
   last: at the command line's rather than the file's. */
#include "scene/scene_sense.h"

#include <math.h>
#include <string.h>

#include "scene/ablation.h"
#include "scene/ball.h"
#include "scene/params.h"
#include "scene/rules.h"
#include "scene/scene_sense_parts.h"

#define NARROWEST_SMOOTHING 1e-9 /* s: far below a sample, and kernels of it would underflow */

/* ------------------------------------------------------------------ load and tip */

static void grip_check(const struct scene_part *p, const struct grip *g)
{
    if (g->given && rules_jams(g))
        diag_add(p->yaml->diag, scene_part_later(p, "grip.angle", "grip.friction"), "lower grip.angle or grip.friction",
                 "%s: the tool jams: friction x tan(angle) is %.4g, and must stay below 0.999",
                 scene_part_label(p, "grip"), 1 - rules_slip(g));
}

double scene_sense_lasts(const struct motion *m)
{
    double x = m->to[0] - m->from[0], y = m->to[1] - m->from[1];
    if (!isnan(m->duration)) return m->duration;
    if (m->path == PATH_CIRCLE) return 2 * M_PI * m->radius * fabs(m->turns) / m->speed;
    if (m->path == PATH_INCLINE) return incline_make(m).end;
    return rules_straight(m) ? sqrt(x * x + y * y) / m->speed : NAN;
}

/* Times that are left to the program are short where there is little time. */
static void lowering_check(const struct scene_part *p, const struct contact *c)
{
    const char *approach = "load.approach", *release = "load.release";
    double taken = (isnan(c->load.approach) ? 0 : c->load.approach) + (isnan(c->load.release) ? 0 : c->load.release);
    double lasts = scene_sense_lasts(&c->motion);
    if (taken > lasts * (1 + 1e-9))
        scene_part_refuse(p, approach, release, "lower them, or let the motion last longer",
                          " and %s take %.4g s together, and the motion lasts %.4g s", scene_part_label(p, release),
                          taken, lasts);
}

static void tip_check(const struct scene_part *p, const struct scraper *s)
{
    if (s->patch >= s->radius)
        scene_part_contradiction(p, "scraper.patch", "scraper.radius", "must be less than",
                                 "lower scraper.patch, or raise scraper.radius");
}

/* ------------------------------------------------------------------ limiter and smoothing */

static void alpha_check(const struct scene_part *p, const struct limiter *l)
{
    if (l->alpha_min > l->alpha_max)
        scene_part_contradiction(p, "contact.limiter.alpha_min", "contact.limiter.alpha_max",
                                 "must not be greater than", "lower alpha_min, or raise alpha_max");
}

/* Defaults stand in every effective scene, so that only another value is one that was meant to do something. */
static void ratio_check(const struct scene_part *p, const struct limiter *l)
{
    const char *path = "contact.limiter.ratio_y", *curve = "contact.limiter.curve";
    if (yaml_find(p->map, path) && l->ratio_y != 1 && scene_part_known(p, curve) && l->curve == LIMITER_NONE &&
        !yaml_find(p->map, "ablation.nonlinearity"))
        diag_add(p->yaml->diag, yaml_find(p->map, path)->key->at, "remove it, or set contact.limiter.curve to tanh",
                 "%s has no effect where %s is none", scene_part_label(p, path), scene_part_label(p, curve));
}

/* The largest alpha there can be along x: that of the force under a constant load. */
static double alpha_along_x(const struct contact *c)
{
    const struct limiter *l = &c->contact.limiter;
    double n = rules_load(c);
    if (!ablation_steady(c) && (c->grip.given || c->load.recorded || (ball_rolls(c) && c->ball.offset > 0)))
        return fmax(l->alpha_max, l->alpha);
    if (isnan(l->force_range[0])) return l->alpha;
    double share = (n - l->force_range[0]) / (l->force_range[1] - l->force_range[0]);
    double nu = real_pow(share < 0 ? 0 : share > 1 ? 1 : share, l->zeta);
    return (1 - nu) * l->alpha_max + nu * l->alpha_min;
}

static double alpha_widest(const struct contact *c)
{
    return alpha_along_x(c) * fmax(1, c->contact.limiter.ratio_y); /* NAN: not the paper's force */
}

/* Told at the smoothing if it is given, else at the alpha that makes it wide. */
static void smoothing_check(const struct scene_part *p, const struct contact *c)
{
    const char *path = "contact.smoothing";
    double sigma = rules_sigma(&c->contact, alpha_widest(c));
    if (c->contact.smoothing > 0 && c->contact.smoothing < NARROWEST_SMOOTHING)
        scene_part_refuse(p, path, path, "0 turns it off; or write for instance: smoothing: 50 us",
                          " must be 0 or at least 1 ns");
    if (sigma > RULES_SMOOTHING_WIDEST)
        diag_add(p->yaml->diag,
                 yaml_find(p->map, path) ? scene_part_later(p, path, path)
                                         : scene_part_later(p, "contact.limiter.alpha", "contact.limiter.alpha_max"),
                 "lower contact.smoothing or the alpha of contact.limiter; smoothing: 0 turns it off",
                 "%s smooths the force with a sigma of %.3g s (smoothing x alpha / 3 cm), and at most %g s make sense",
                 scene_part_label(p, path), sigma, RULES_SMOOTHING_WIDEST);
}

/* ------------------------------------------------------------------ a contact */

/* What follows the surface as far as its limited curvature allows: a scraper, and a ball in the model `roll`. */
static void follower_check(const struct scene_part *p, const struct contact *c)
{
    lowering_check(p, c);
    alpha_check(p, &c->contact.limiter);
    ratio_check(p, &c->contact.limiter);
    smoothing_check(p, c);
}

void scene_sense_contact(const struct scene_part *p)
{
    const struct contact *c = p->to;
    scene_sense_motion(p, &c->motion);
    params_check(p, c);
    if (c->contact.model == CONTACT_SCRAPE) {
        grip_check(p, &c->grip);
        tip_check(p, &c->scraper);
    }
    if (c->contact.model == CONTACT_SCRAPE || c->contact.model == CONTACT_ROLL) follower_check(p, c);
    if (rules_driven(c)) lowering_check(p, c);
    scene_sense_model(p, c);
    scene_sense_response(p, c);
    scene_sense_ablation(p, c);
}

static bool force_stem(const struct output *o)
{
    for (int i = 0; o->stems && o->stems[i]; i++)
        if (strcmp(o->stems[i], "force") == 0) return true;
    return false;
}

void scene_sense_asked(const struct scene_part *p, const struct scene *s)
{
    const struct contact *c = p->to;
    const struct yaml_node *surface = yaml_get(p->map, "surface");
    if (s->output.diagnostics.given || rules_listed(c, &s->output) || rules_audible(c, &s->output) ||
        force_stem(&s->output))
        return;
    diag_add(p->yaml->diag, scene_part_place(p, surface ? surface : p->map),
             arena_format(p->yaml->arena,
                          "give surface.response, surface.object or surface.space (or one of %s) for a sound, set "
                          "output.quantity to force for the sound of "
                          "the force alone, or ask for output.diagnostics, a table of its physics, or the stem force",
                          ball_tool(c)),
             "nothing is asked of %s", scene_part_contact(p, c->name));
}
