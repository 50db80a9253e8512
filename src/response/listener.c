/* Every radiator is a linear filter, and a mode A e^(s t), s = -decay + j 2 pi f, passes one as A H(s) e^(s t):

       quantity      H = s^k, k from -2 to 2: displacement, velocity, acceleration are the mode times 1, s, s^2.
   (Constants of integration are left out: the displacement that a velocity would leave behind, a jump of displacement
   at t = 0. An acceleration's jump of velocity is its direct term, modes_direct.) contact       H = 1: the motion of
   the place that is touched, or what a table holds point         H = 1: the motion of another place; the modes are made
   for it (listener_place) monopole      radiator.c, with a component of its own plate radiator.c: H of
   each mode by quadrature, once

   The way through the air: a channel is later than that of the nearest listening place by d = (r - r_nearest) / c rate
   samples, of which ceil(d) are a delay and the rest an advance, A e^(s (ceil(d) - d) / rate): the delayed response,
   exactly, at every sample (whereas the rest as a delay would begin before it). The way to the nearest place,
   (r_nearest - a) / c of a monopole and R_0 / c of a plate's centre, is left out; objects do not know of each other,
   and each begins at once at the place nearest to it.

   The middle of an object is that of its box, in the plane z = 0; of a shell, which is touched on top, its radius
   below. Of what is no object (a table's, a place in the space of materials) it is the scene's own origin. */
#include "response/listener.h"

#include <math.h>
#include <string.h>

#include "num/real.h"
#include "response/radiator.h"
#include "scene/rows.h"

struct listener {
    int n, radiator, extra, quantity;
    int power; /* of s, from the modes' quantity to the radiator's */
    long delay;
    double advance; /* s */
    struct radiator_monopole monopole;
    double *re, *im; /* [n] of a plate */
};

static int radiator_of(const struct listener_ask *ask)
{
    return ask->output->listen.given ? ask->output->listen.radiator : RADIATOR_CONTACT;
}

static const double *place_of(const struct listener_ask *ask, int channel)
{
    return ask->output->listen.places + 3 * channel;
}

bool listener_place(const struct listener_ask *ask, const struct object *o, struct arena *a, double place[2])
{
    int radiator = radiator_of(ask);
    if (radiator == RADIATOR_PLATE && o->flat) radiator_plate_reference(o, a, place);
    for (int i = 0; i < 2 && radiator == RADIATOR_POINT; i++)
        place[i] = place_of(ask, ask->channel)[i] - ask->origin[i];
    return radiator == RADIATOR_POINT || (radiator == RADIATOR_PLATE && o->flat);
}

/* ------------------------------------------------------------------ what is asked for, and can it be had? */

static double distance(const struct listener_ask *ask, const struct modes *m, int channel)
{
    const struct object *o = m->object;
    const double *p = place_of(ask, channel);
    if (o && o->flat) return radiator_plate_distance(o, ask->origin, p);
    bool shell = o && o->shape == OBJECT_SHELL;
    double dx = p[0] - ask->origin[0] - (o && !shell ? 0.5 * (o->low[0] + o->high[0]) : 0);
    double dy = p[1] - ask->origin[1] - (o && !shell ? 0.5 * (o->low[1] + o->high[1]) : 0),
           dz = p[2] + (shell ? o->radius : 0);
    return sqrt(dx * dx + dy * dy + dz * dz);
}

/* Delay and advance against the nearest listening place. */
static void set_delay(struct listener *l, const struct listener_ask *ask, const struct modes *m)
{
    double nearest = HUGE_VAL;
    for (int k = 0; k < ask->output->listen.n_places; k++)
        nearest = fmin(nearest, distance(ask, m, k));
    double late = (distance(ask, m, ask->channel) - nearest) / ask->output->listen.sound_speed * ask->rate;
    l->delay = (long)ceil(late - 1e-6); /* what is whole but for rounding stays so */
    l->advance = ((double)l->delay - late) / ask->rate;
}

static bool set_monopole(struct listener *l, const struct listener_ask *ask, const struct modes *m, struct err *e)
{
    const struct listen *air = &ask->output->listen;
    double r = distance(ask, m, ask->channel);
    if (isnan(m->radius))
        return err_set(
            e, ERR_SCENE,
            "output.listen.radiator: monopole: %s does not say how large the object is; a mode table may, by a line '# "
            "radius_m: METRES' (of the sphere of the same surface area); else listen to the contact",
            m->name);
    if (!(r > m->radius))
        return err_set(e, ERR_SCENE,
                       "output.listen.places: place %d is %.6g m from the middle of %s, inside the sphere of %.6g m "
                       "radius that stands for it: listen from farther away",
                       ask->channel + 1, r, m->name, m->radius);
    l->monopole = radiator_monopole(m->radius, r, air->density, air->sound_speed);
    l->extra = radiator_monopole_sampled(&l->monopole, ask->rate);
    return true;
}

static bool set_plate(struct listener *l, const struct listener_ask *ask, const struct modes *m, struct arena *a,
                      struct err *e)
{
    const struct listen *air = &ask->output->listen;
    const double *at = place_of(ask, ask->channel);
    struct radiator_plate p = {.modes = m,
                               .object = m->object,
                               .origin = {ask->origin[0], ask->origin[1]},
                               .place = {at[0], at[1], at[2]},
                               .density = air->density,
                               .sound_speed = air->sound_speed};
    if (!m->object || !m->object->flat)
        return err_set(e, ERR_SCENE,
                       "output.listen.radiator: plate: %s is not a plate, disk, membrane or drum, whose mode shapes "
                       "are known: use monopole",
                       m->name);
    if (!ask->listen)
        return err_set(
            e, ERR_SCENE,
            "output.listen.radiator: plate: %s is not the surface, which alone can lie in a baffle: use monopole",
            m->name);
    memcpy(p.reference, ask->listen, sizeof p.reference);
    l->re = ARENA_TAKE(a, double, m->n);
    l->im = ARENA_TAKE(a, double, m->n);
    return radiator_plate(&p, a, l->re, l->im, e);
}

static bool point_possible(const struct listener_ask *ask, const struct modes *m, struct arena *a, struct err *e)
{
    const struct object *o = m->object;
    const double *p = place_of(ask, ask->channel);
    if (!o)
        return err_set(e, ERR_SCENE,
                       "output.listen.radiator: point: %s is not an object whose mode shapes are known everywhere: "
                       "listen to the contact",
                       m->name);
    double off = o->shapes(o, p[0] - ask->origin[0], p[1] - ask->origin[1], ARENA_TAKE(a, double, o->n));
    return off <= 1e-9 || err_set(e, ERR_SCENE,
                                  "output.listen.places: place %d, [%.6g, %.6g] m, is %.3g m beside %s, which lies "
                                  "from [%.6g, %.6g] to [%.6g, %.6g] m: move the place, or the object by its origin",
                                  ask->channel + 1, p[0], p[1], off, m->name, o->low[0] + ask->origin[0],
                                  o->low[1] + ask->origin[1], o->high[0] + ask->origin[0], o->high[1] + ask->origin[1]);
}

static bool set_radiator(struct listener *l, const struct listener_ask *ask, const struct modes *m, struct arena *a,
                         struct err *e)
{
    bool pascals = listener_in_pascals(ask->output);
    int wanted = ask->output->quantity;
    if (l->radiator == RADIATOR_POINT && !point_possible(ask, m, a, e)) return false;
    if (wanted == QUANTITY_FORCE)
        return err_set(e, ERR_SCENE, "output.quantity: a force is no vibration, and what rings cannot give it");
    if (pascals && wanted != QUANTITY_AUTO)
        return err_set(
            e, ERR_SCENE,
            "output.quantity: a radiator's sound is pressure: leave output.quantity out, or listen to the contact");
    l->quantity = pascals ? MODES_PRESSURE : wanted == QUANTITY_AUTO ? m->quantity : wanted - QUANTITY_DISPLACEMENT;
    l->power = (pascals ? MODES_VELOCITY : l->quantity) - m->quantity;
    if (pascals) set_delay(l, ask, m);
    if (l->radiator == RADIATOR_MONOPOLE) return set_monopole(l, ask, m, e);
    return l->radiator != RADIATOR_PLATE || set_plate(l, ask, m, a, e);
}

struct listener *listener_make(struct arena *a, const struct listener_ask *ask, const struct modes *m, struct err *e)
{
    struct listener *l = ARENA_TAKE(a, struct listener, 1);
    l->n = m->n;
    l->radiator = radiator_of(ask);
    return set_radiator(l, ask, m, a, e) ? l : NULL;
}

double listener_cost(const struct output *o, const struct modes *m, const double *origin)
{
    const struct listen *air = &o->listen;
    struct arena *a = arena_open();
    double cycles = 0;
    for (int k = 0; k < air->n_places && air->given && air->radiator == RADIATOR_PLATE && m->object && m->object->flat;
         k++) {
        const double *at = air->places + 3 * k;
        cycles += radiator_plate_cost(&(struct radiator_plate){.modes = m,
                                                               .object = m->object,
                                                               .origin = {origin[0], origin[1]},
                                                               .place = {at[0], at[1], at[2]},
                                                               .density = air->density,
                                                               .sound_speed = air->sound_speed},
                                      a);
    }
    arena_close(a);
    return cycles;
}

int listener_extra(const struct listener *l) { return l->extra; }

int listener_quantity(const struct listener *l) { return l->quantity; }

long listener_delay(const struct listener *l) { return l->delay; }

void listener_poles(const struct listener *l, double *frequency, double *decay)
{
    for (int i = 0; i < l->extra; i++) {
        frequency[i] = 0;
        decay[i] = l->monopole.pole;
    }
}

/* ------------------------------------------------------------------ gains */

/* A <- A b, or A / b */
static void times(double *re, double *im, const double b[2])
{
    double x = *re, y = *im;
    *re = x * b[0] - y * b[1];
    *im = x * b[1] + y * b[0];
}

static void by(double *re, double *im, const double b[2])
{
    double x = *re, y = *im, power = b[0] * b[0] + b[1] * b[1];
    *re = (x * b[0] + y * b[1]) / power;
    *im = (y * b[0] - x * b[1]) / power;
}

static void advance(const struct listener *l, const double s[2], double *re, double *im)
{
    double grow = real_exp(s[0] * l->advance), turn = s[1] * l->advance;
    times(re, im, (const double[2]){grow * real_cos(turn), grow * real_sin(turn)});
}

/* One mode; what its velocity gives to the radiator's own component is added to *own. */
static void apply_one(const struct listener *l, const double s[2], double *re, double *im, double *own)
{
    double h[2], share[2];
    for (int k = 0; k < l->power; k++)
        times(re, im, s);
    for (int k = 0; k < -l->power; k++)
        by(re, im, s);
    if (l->radiator == RADIATOR_MONOPOLE) {
        radiator_monopole_own(&l->monopole, s, share);
        *own += *re * share[1] + *im * share[0];
        radiator_monopole_at(&l->monopole, s, h);
        times(re, im, h);
    }
    if (l->advance != 0) advance(l, s, re, im);
}

void listener_apply(const struct listener *l, const double *frequency, const double *decay, const struct modes_point *p)
{
    double own = 0;
    bool plain = l->power == 0 && l->advance == 0 && l->radiator != RADIATOR_MONOPOLE;
    for (int i = 0; i < l->n && !plain; i++)
        apply_one(l, (const double[2]){-decay[i], 2 * REAL_PI * frequency[i]}, &p->re[i], &p->im[i], &own);
    for (int i = 0; i < l->n && l->re; i++)
        times(&p->re[i], &p->im[i], (const double[2]){l->re[i], l->im[i]});
    for (int i = l->n; i < l->n + l->extra; i++) {
        p->re[i] = 0;
        p->im[i] = own * real_exp(-l->monopole.pole * l->advance);
        if (p->frequency) listener_poles(l, p->frequency + i, p->decay + i);
    }
}

/* ------------------------------------------------------------------ parameters */

static const struct choice radiators[] = {
    [RADIATOR_CONTACT] = {"contact", "what a mode table holds; of objects the motion of the place that is touched"},
    [RADIATOR_POINT] = {"point", "the motion of an object at other places of it"},
    [RADIATOR_MONOPOLE] = {"monopole", "sound pressure of a pulsating sphere of the object's size"},
    [RADIATOR_PLATE] = {"plate",
                        "sound pressure of a flat object in a baffle, by Rayleigh's integral over its mode shapes"},
    {NULL, NULL}};

static const struct key keys[] = {
    {ROW_CHOICE(scene, output.listen.radiator, "output.listen.radiator"), KEY_NONE, 0, 0, "monopole", NULL,
     "how vibration becomes what is heard", radiators},
    {ROW_PLACES(scene, output.listen.places, "output.listen.places"), KEY_LENGTH, -1000, 1000, NULL,
     "output.listen.radiator=point|monopole|plate",
     "listening places [x, y, z] in the scene's coordinates, z above the surface; each becomes a channel",
     .shown = "[[0 m, 0 m, 1 m], [20 cm, 0 m, 1 m]]"},
    {ROW_NUMBER(scene, output.listen.density, "output.listen.density"), KEY_DENSITY, 1e-3, 1e5, "1.204 kg/m^3",
     "output.listen.radiator=monopole|plate", "density of the air"},
    {ROW_NUMBER(scene, output.listen.sound_speed, "output.listen.sound_speed"), KEY_SPEED, 10, 1e4, "343.2 m/s",
     "output.listen.radiator=monopole|plate", "speed of sound in the air"},
    {.path = NULL}};

const struct params listener_params = {.section = "output.listen",
                                       .keys = keys,
                                       .meaning = "where the sound is heard, and through what",
                                       .flag = offsetof(struct scene, output.listen.given)};
