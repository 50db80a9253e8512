/* Mass and moment of inertia of what rolls, R its outer radius, h the wall's thickness, q = (R - h) / R:

     solid ball    m = 4/3 pi R^3 rho              I = 2/5 m R^2
     hollow ball   m = 4/3 pi R^3 (1 - q^3) rho    I = 2/5 m R^2 (1 - q^5) / (1 - q^3), 2/3 m R^2 of a thin wall
     hoop          m given                         I = m R^2
     wheel         m given                         I = 1/2 m R^2

   The stiffness of a ball of model roll follows from the rms deviation of its centre (force/roll_rehearsal.c), which takes some way to show: S forgets over
   contact.leak, l, and over a way W the rms of what is as rough as it likes at longer waves is uncertain by sqrt(1.3 l / W) of itself, the stiffness by 1.5
   times that. Measured with 10 seeds on basswood, a ball of 8 mm, l = 2 mm: 24, 13, 12, 6 % of the rms at W = 5, 10, 20, 80 cm. Below some 20 l it is too small
   besides, by a factor of 7 at 2 l: k is then 16 times too great. So W is 60 l at least, 33 l in the plane, where each millimetre costs a lot, and for the
   sake of long leaks, which no way would be enough for, no more than 20 cm. */
#include "scene/ball.h"

#include <math.h>

#include "num/real.h"
#include "scene/material.h"
#include "scene/rules.h"

static double density(const struct object_given *o)
{
    const struct material *m = material_find(o->material);
    return !isnan(o->density) || !m ? o->density : m->density;
}

/* (1 - q^n) for q = 1 - w: the sum w (1 + q + q^2 + ...), which keeps its digits for thin walls. */
static double shell(double w, int n)
{
    double q = 1 - w, sum = 0, power = 1;
    for (int i = 0; i < n; i++, power *= q)
        sum += power;
    return w * sum;
}

double ball_mass(const struct ball *b)
{
    double filled = b->body == BODY_SOLID ? 1 : b->body == BODY_HOLLOW && b->wall < b->radius ? shell(b->wall / b->radius, 3) : NAN;
    if (!isnan(b->mass))
        return b->mass;
    return 4.0 / 3 * REAL_PI * b->radius * b->radius * b->radius * filled * density(&b->response.object);
}

double ball_inertia(const struct contact *c)
{
    const struct ball *b = &c->ball;
    if (!ball_rolls(c))
        return 0;
    switch (b->body) {
    case BODY_SOLID: return 2.0 / 5;
    case BODY_HOLLOW: return isnan(b->wall) ? 2.0 / 3 : 2.0 / 5 * shell(b->wall / b->radius, 5) / shell(b->wall / b->radius, 3);
    case BODY_HOOP: return 1;
    default: return 1.0 / 2;
    }
}

double ball_gravity(const struct contact *c)
{
    return c->motion.path == PATH_INCLINE ? c->contact.gravity * real_cospi(c->motion.incline / REAL_PI) : c->contact.gravity;
}

enum { LEAKS_LINE = 60, LEAKS_PLANE = 33 };

#define GROUND_MOST 0.2 /* m */
#define LEAK 2e-3       /* m, where the scene has no contact.leak (force/slope.h) */

double ball_leak(const struct contact *c)
{
    return c->contact.leak > 0 ? c->contact.leak : LEAK;
}

double ball_ground(const struct contact *c)
{
    return fmin((rules_along(c) == ALONG_PLANE ? LEAKS_PLANE : LEAKS_LINE) * ball_leak(c), GROUND_MOST);
}

double ball_beyond(const struct contact *c, double ground)
{
    const struct roll *r = &c->contact.roll;
    bool has = c->contact.model != CONTACT_ROLL || r->penetration != PENETRATION_DEVIATION || !isnan(ball_stiffness(c));
    return has || !(ground > 0) ? 0 : fmax(ball_ground(c) - ground, 0);
}

double ball_deviation_error(const struct contact *c, double ground)
{
    return sqrt(1.3 * ball_leak(c) / ground);
}

double ball_stiffness(const struct contact *c)
{
    const struct roll *r = &c->contact.roll;
    return !isnan(r->stiffness) ? r->stiffness : r->kappa * c->scraper.mass;
}

void ball_settle(struct contact *c)
{
    const struct ball *b = &c->ball;
    c->motion.gravity = c->contact.gravity;
    c->motion.inertia = ball_inertia(c);
    if (!ball_rolls(c))
        return;
    c->scraper = (struct scraper){.mass = ball_mass(b), .weight = b->weight, .radius = b->radius, .patch = b->patch, .response = b->response};
}
