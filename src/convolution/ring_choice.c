/* What the scene leaves open (surface.moving: auto, surface.convolution: auto) is settled here, where the response has
   been read.

   Reading: poles that are the same everywhere make `fixed`, separate ones `launch`, an object that changes on the way
   `glide`.

   Engine                                     fixed   glide   launch   readout
   resonators (one exact recursion per mode)   x       x
   launch (resonators at nodes)                                x
   overlap-add (responses at nodes)            o               o        x

   x: where nothing else is asked. o: where surface.convolution says so, or the response is cut
   (surface.response_length), or begins softly (surface.gammatone) and launches. Recorded responses go by overlap-add,
   each place's for itself, the force shared between places.

   How finely a response that moves is followed is one knob, accuracy.gain_ramp, n frames:

       resonators    gains and poles are evaluated every n frames, and ramped linearly between
       launch        nodes every 16 sqrt(n) frames, cubic between
       overlap-add   nodes every 32 sqrt(n) frames, cubic between: half as many, as each costs three long FFTs

   A line over n frames errs as n^2, and so does a cubic over c sqrt(n). Hops are whole numbers of 8 frames. */
#include "convolution/ring_choice.h"

#include <math.h>
#include <string.h>

#include "base/file_cache.h"
#include "base/hash.h"
#include "convolution/gammatone.h"
#include "num/lanes.h"
#include "num/real.h"
#include "response/listener.h"
#include "response/object.h"
#include "response/response.h"
#include "response/space.h"
#include "scene/material.h"
#include "stage.h"
#include "trajectory/contact.h"
#include "trajectory/motion.h"
#include "trajectory/trajectory.h"

#define COMPUTED_DB 140.0  /* how far a computed response is followed down */
#define COMPUTED_MOST 60.0 /* s, and how long */

struct ring_choosing {
    const struct contact *contact;
    const struct scene *scene;
    const struct response *given;
    const char *key; /* "surface", "scraper", "ball" */
    struct arena *arena;
    struct ring_choice *to;
};

/* ------------------------------------------------------------------ reading */

struct computed {       /* an object's modes, for every contact that asks for the same */
    struct modes modes; /* the strongest, without those that are too high */
    const char *note;
    int high; /* how many of the strongest that were */
};

struct computed_ask {
    const struct object_given *given;
    const char *key;
    const struct modes_ask *modes;
};

static bool compute(const char *file, const void *how, struct arena *a, void *thing, struct err *e)
{
    const struct computed_ask *ask = (const struct computed_ask *)how;
    const struct modes_ask *m = ask->modes;
    struct computed *to = (struct computed *)thing;
    struct object *o = ARENA_TAKE(a, struct object, 1);
    struct object_given *given = ARENA_TAKE(a, struct object_given, 1); /* the object looks at it as long as it lives */
    const struct object_ask what = {.key = arena_text(a, ask->key),
                                    .low = m->band[0],
                                    .top = m->band[1],
                                    .most = 4 * m->strongest,
                                    .audible = MODES_TOP * m->rate};
    (void)file;
    *given = *ask->given;
    if (!object_make(given, &what, a, o, &to->note, e)) return false;
    object_modes(o, given->origin, NULL, m->strongest, a, &to->modes);
    to->high = modes_drop_above(&to->modes, m->rate);
    return true;
}

/* All that an object's modes follow from, as text: every byte of what is given but addresses, and the material it has
   of the scene's own. */
static const char *computed_from(const struct computed_ask *ask, struct arena *a)
{
    const struct modes_ask *m = ask->modes;
    struct object_given given;
    struct material own = {.name = NULL};
    char hex[HASH_TEXT];
    struct hash h = hash_start();
    memcpy(&given, ask->given, sizeof given);
    if (given.own) {
        own = *given.own;
        hash_text(&h, own.name);
        own.name = own.source = own.damping_source = NULL;
    }
    given.own = NULL;
    hash_add(&h, &given, sizeof given);
    hash_add(&h, &own, sizeof own);
    hash_end(&h, hex);
    return arena_format(a, "%s %s %d %a %a %a", hex, ask->key, m->strongest, m->band[0], m->band[1], m->rate);
}

static bool read_object(struct ring_choosing *c, const struct modes_ask *ask, struct err *e)
{
    static const struct file_cache_kind objects = {"object", sizeof(struct computed), compute, false};
    const struct computed_ask own = {&c->given->object, arena_format(c->arena, "%s.object", c->key), ask};
    const struct computed *made = file_cache_take(
        ask->file_cache, &(struct file_cache_ask){&objects, "", computed_from(&own, c->arena), &own}, c->arena, e);
    if (!made) return err_at(e, "contact '%s'", c->contact->name);
    c->to->modes = made->modes;
    c->to->note = made->note;
    c->to->high = made->high;
    return true;
}

static bool read_modes(struct ring_choosing *c, struct err *e)
{
    double rate = c->scene->output.sample_rate;
    struct modes_ask ask = {.strongest = c->given->modes,
                            .band = {c->given->band[0], c->given->band[1]},
                            .pairing = c->given->pairing,
                            .rate = rate,
                            .file_cache = c->scene->file_cache};
    struct modes *m = &c->to->modes;
    if (c->given->object.given  ? !read_object(c, &ask, e)
        : c->given->space.given ? !space_modes(&c->given->space, &ask, c->arena, m, e)
                                : !modes_table(c->given->file, &ask, c->arena, m, e))
        return false;
    c->to->note = c->to->note ? c->to->note : m->note;
    if (!c->given->object.given) c->to->high = modes_drop_above(m, rate);
    c->to->chosen = m->n + c->to->high;
    return m->n > 0 ||
           err_set(e, ERR_SCENE,
                   "%s: all of its modes in the band lie above %.6g Hz (0.45 times output.sample_rate), and nothing "
                   "would ring: "
                   "raise output.sample_rate, %s",
                   m->name, MODES_TOP * rate,
                   c->given->object.given ? "or let the key band begin lower" : "or check that frequency_hz is in Hz");
}

/* ------------------------------------------------------------------ readings */

static bool moves(const struct ring_choosing *c, enum ring_body body)
{
    const struct modes *m = &c->to->modes;
    return body == RING_SURFACE && !contact_one_place(c->contact) &&
           ((m->moves && c->contact->motion.path != PATH_STILL) || m->travels);
}

static bool choose_reading(struct ring_choosing *c, enum ring_body body, struct err *e)
{
    const struct modes *m = &c->to->modes;
    int asked = body == RING_SURFACE ? c->given->moving : MOVING_AUTO;
    c->to->moves = moves(c, body);
    c->to->reading = asked != MOVING_AUTO ? asked
                     : m->shared          ? MOVING_FIXED
                     : m->travels         ? MOVING_GLIDE
                                          : MOVING_LAUNCH;
    if (asked == MOVING_FIXED && !m->shared && c->to->moves) {
        err_about(e, c->contact->name, "surface.moving");
        return err_set(e, ERR_SCENE,
                       "contact '%s': surface.moving: fixed needs poles that are the same everywhere, and those of %s "
                       "differ from place to "
                       "place; leave surface.moving out, or choose launch, glide or readout",
                       c->contact->name, m->name);
    }
    if (!c->to->moves) c->to->reading = MOVING_FIXED;
    return true;
}

/* ------------------------------------------------------------------ gammatones */

static bool undamped(const struct ring_choosing *c, int i, struct err *e)
{
    return err_set(e, ERR_SCENE,
                   "contact '%s': %s.gammatone: %d: the mode at %.6g Hz of %s has no decay, and a gammatone of it "
                   "would grow for ever; give it decay, or leave "
                   "gammatone out",
                   c->contact->name, c->key, c->to->gamma, c->to->modes.frequency[i], c->to->modes.name);
}

static bool gammatone_fits(const struct ring_choosing *c, struct err *e)
{
    int asked = c->given->convolution, reading = c->to->reading;
    const char *name = c->contact->name;
    if (c->to->gamma == 1) return true;
    for (int i = 0; i < c->to->modes.n; i++)
        if (!(c->to->modes.slowest[i] > 0)) return undamped(c, i, e);
    if (reading == MOVING_GLIDE)
        return err_set(e, ERR_SCENE,
                       "contact '%s': surface.gammatone: %d: what glides begins at once%s; set surface.moving to "
                       "launch or readout, or leave gammatone out",
                       name, c->to->gamma,
                       c->given->moving == MOVING_AUTO ? " (surface.moving: auto is glide where surface.space travels)"
                                                       : "");
    if (asked == ENGINE_RESONATORS && reading != MOVING_FIXED)
        return err_set(e, ERR_SCENE,
                       "contact '%s': surface.convolution: resonators cannot do surface.gammatone: %d where poles "
                       "differ from place to place; choose overlap_add, "
                       "or leave surface.convolution out",
                       name, c->to->gamma);
    return true;
}

/* ------------------------------------------------------------------ engines */

/* Seconds after the contact's start at which the sound ends, where the scene says so; else HUGE_VAL. */
static double sound_end(const struct contact *c, const struct scene *s)
{
    double end = 0;
    if (!isnan(s->output.duration)) return fmax(s->output.duration - c->start, 0);
    for (int i = 0; i < s->n_contacts; i++) {
        double duration = motion_cut(&s->contacts[i].motion, s->contacts[i].motion.duration);
        end = isnan(duration) ? HUGE_VAL : fmax(end, s->contacts[i].start + duration);
    }
    return isnan(s->output.tail) ? HUGE_VAL : end + s->output.tail - c->start;
}

static bool choose_engine(struct ring_choosing *c, struct err *e)
{
    static const char *const readings[] = {"auto", "fixed", "launch", "glide", "readout"};
    int asked = c->given->convolution, reading = c->to->reading;
    bool cut = !isnan(c->given->length), overlap = asked == ENGINE_OVERLAP_ADD || cut ||
                                                   (c->to->gamma > 1 && reading == MOVING_LAUNCH) ||
                                                   reading == MOVING_READOUT;
    if ((reading == MOVING_GLIDE && asked == ENGINE_OVERLAP_ADD) ||
        (reading == MOVING_READOUT && asked == ENGINE_RESONATORS)) {
        err_about(e, c->contact->name, "surface.convolution");
        return err_set(e, ERR_SCENE,
                       "contact '%s': surface.convolution: %s cannot do surface.moving: %s, which goes by %s; leave "
                       "surface.convolution out",
                       c->contact->name, asked == ENGINE_OVERLAP_ADD ? "overlap_add" : "resonators", readings[reading],
                       asked == ENGINE_OVERLAP_ADD ? "resonators" : "overlap_add");
    }
    c->to->engine = overlap && reading != MOVING_GLIDE ? RING_OVERLAP_ADD
                    : reading == MOVING_LAUNCH         ? RING_LAUNCH
                                                       : RING_RESONATORS;
    double falls = fmin(modes_ring_time(&c->to->modes, gammatone_decibel(c->to->gamma, COMPUTED_DB)), COMPUTED_MOST);
    double end = sound_end(c->contact, c->scene) + 2 / c->scene->output.sample_rate;
    c->to->seconds = fmin(cut ? c->given->length : falls, end);
    return true;
}

int ring_choice_hop(const struct ring_choice *c, const struct accuracy *accuracy)
{
    return 8 * (int)rint((c->engine == RING_OVERLAP_ADD ? 4 : 2) * sqrt(accuracy->gain_ramp));
}

/* ------------------------------------------------------------------ all */

static const struct response *given_of(const struct contact *c, enum ring_body body)
{
    return body == RING_SURFACE ? &c->surface.response : &c->scraper.response;
}

static bool choose_modal(struct ring_choosing *c, enum ring_body body, struct err *e)
{
    static const char *const gammatones[] = {"surface.gammatone", "scraper.gammatone", "ball.gammatone"};
    if (!read_modes(c, e)) return err_about(e, c->contact->name, ring_choice_about(c->contact, body));
    if (!choose_reading(c, body, e)) return false;
    if (!gammatone_fits(c, e))
        return err_about(e, c->contact->name, gammatones[body == RING_SURFACE ? 0 : contact_rolls(c->contact) ? 2 : 1]);
    if (!choose_engine(c, e)) return false;
    return true;
}

bool ring_choice_make(const struct contact *c, const struct scene *s, enum ring_body body, struct arena *a,
                      const struct ring_choice **choice, struct err *e)
{
    const struct response *given = given_of(c, body);
    *choice = NULL;
    if (!response_given(given) || (body == RING_SCRAPER && c->scraper.weight == 0)) return true;
    struct ring_choice *to = ARENA_TAKE(a, struct ring_choice, 1);
    struct ring_choosing me = {.contact = c,
                               .scene = s,
                               .given = given,
                               .key = body == RING_SURFACE ? "surface" : contact_tool(c),
                               .arena = a,
                               .to = to};
    *choice = to;
    to->arena = a;
    to->made = ARENA_TAKE(a, struct ring_made, listener_channels(&s->output));
    to->gamma = given->gammatone > 1 ? given->gammatone : 1;
    if (given->file && !response_is_table(given)) {
        to->recorded = true;
        to->folder = response_is_folder(given);
        to->reading = MOVING_FIXED;
        to->moves = to->folder && body == RING_SURFACE && c->motion.path != PATH_STILL && !contact_one_place(c);
        to->engine = RING_OVERLAP_ADD;
        to->seconds = isnan(given->length) ? 1 : given->length;
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
    return keys[body == RING_SURFACE ? 0
                : contact_rolls(c)   ? 2
                                     : 1][given->object.given  ? 1
                                        : given->space.given ? 2
                                                             : 0];
}

enum ring_engine ring_choice_engine(const struct contact *c, enum ring_body body)
{
    const struct ring_choice *choice = given_of(c, body)->choice;
    return choice ? choice->engine : RING_NONE;
}

/* ------------------------------------------------------------------ cost: cycles of one core with 256-bit vectors, by
   tests/bench and whole renders, within a factor of 3 */

#define RESONATOR 0.8          /* a mode and sample, poles fixed                   */
#define GLIDING 1.2            /* ... poles ramped                                 */
#define RAMPED 6.0             /* a mode and ramp                                  */
#define PLACED 400.0           /* a place of the contact                           */
#define TURNED 1400.0          /* ... and a run of resonators to there             */
#define FORCED 45.0            /* a sample of force: what its modes beyond the band leave (alias.c) */
#define SHARED 28.0            /* a mode there, poles shared                       */
#define SEPARATE 80.0          /* ... poles separate                               */
#define FREED 250.0            /* a node that leaves the force                     */
#define LAUNCHED 0.22          /* a node that rings and sample                     */
#define TRANSFORM 65.0         /* three FFTs, per sample of them                   */
#define SAMPLED 0.7            /* a mode and sample of an impulse response         */
#define PARTITION (1 / 2500.0) /* a sample of a response that is convolved as it is */

static double recorded_work(double samples) { return 70 + samples * PARTITION; }

/* Nodes that ring at a time: those of each mode until they are dropped. */
static double alive(const struct ring_choice *c, double rate, double hop)
{
    double sum = 0;
    for (int i = 0; i < c->modes.n; i++)
        sum += fmin(-real_log(RING_CHOICE_NODE_FLOOR) / fmax(c->modes.slowest[i], 1e-3), COMPUTED_MOST) * rate / hop;
    return sum;
}

/* Share of the sound in which there is force: none in the tail. */
static double under_force(const struct contact *own, const struct ring_choice *c, const struct scene *s)
{
    double moving = own->motion.made ? own->motion.made->duration : own->motion.duration,
           tail = isnan(s->output.tail) ? fmin(modes_ring_time(&c->modes, 80), COMPUTED_MOST) : s->output.tail;
    return !isnan(moving) && moving > 0 ? moving / (moving + tail) : 1; /* of a speed it is not known here */
}

/* At one listening place. */
static double place_work(const struct contact *own, const struct ring_choice *c, const struct scene *s)
{
    double n = c->modes.n, lanes = LANES * ceil(n / LANES), rate = s->output.sample_rate, length = c->seconds * rate,
           force = under_force(own, c, s);
    double shapes = c->modes.object && c->moves ? c->modes.object->terms : 0,
           point = PLACED + n * (c->modes.shared ? SHARED : SEPARATE) + shapes, hop = ring_choice_hop(c, &s->accuracy);
    if (c->engine == RING_LAUNCH)
        return 20 + 4 * lanes * RESONATOR +
               force * (FORCED + (point + FREED * n) / hop + LAUNCHED * alive(c, rate, hop));
    if (c->engine == RING_OVERLAP_ADD)
        return c->moves ? (TRANSFORM * (length + 4 * hop) + SAMPLED * n * length + point) / hop : recorded_work(length);
    return 10 + FORCED * force + lanes * (ring_choice_glides(c) ? GLIDING : RESONATOR * gammatone_cost(c->gamma)) +
           (c->moves ? (TURNED + point + lanes * RAMPED) / s->accuracy.gain_ramp : 0);
}

static double work_of(const struct contact *c, const struct scene *s, enum ring_body body)
{
    const struct ring_choice *choice = given_of(c, body)->choice;
    if (!choice) return 0;
    if (choice->recorded) return recorded_work((choice->folder ? 2 : 1) * choice->seconds * s->output.sample_rate);
    return place_work(c, choice, s) * listener_channels(&s->output);
}

double ring_choice_surface_work(const struct contact *c, const struct scene *s) { return work_of(c, s, RING_SURFACE); }

double ring_choice_scraper_work(const struct contact *c, const struct scene *s) { return work_of(c, s, RING_SCRAPER); }

static unsigned turns_of(const struct contact *c, enum ring_body body)
{
    const struct ring_choice *choice = given_of(c, body)->choice;
    return choice && choice->moves && !choice->recorded ? KNOB_BIT(gain_ramp) : 0;
}

unsigned ring_choice_surface_turns(const struct contact *c, const struct scene *s)
{
    (void)s;
    return turns_of(c, RING_SURFACE);
}

unsigned ring_choice_scraper_turns(const struct contact *c, const struct scene *s)
{
    (void)s;
    return turns_of(c, RING_SCRAPER);
}
