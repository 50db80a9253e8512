/* Mass and moment of inertia of what rolls, R its outer radius, h the wall's thickness, q = (R - h) / R:

     solid ball    m = 4/3 pi R^3 rho              I = 2/5 m R^2
     hollow ball   m = 4/3 pi R^3 (1 - q^3) rho    I = 2/5 m R^2 (1 - q^5) / (1 - q^3), 2/3 m R^2 of a thin wall
     hoop          m given                         I = m R^2
     wheel         m given                         I = 1/2 m R^2 */
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
    double filled = b->body == BODY_SOLID                           ? 1
                    : b->body == BODY_HOLLOW && b->wall < b->radius ? shell(b->wall / b->radius, 3)
                                                                    : NAN;
    if (!isnan(b->mass)) return b->mass;
    return 4.0 / 3 * REAL_PI * b->radius * b->radius * b->radius * filled * density(&b->response.object);
}

double ball_inertia(const struct contact *c)
{
    const struct ball *b = &c->ball;
    if (!ball_rolls(c)) return 0;
    switch (b->body) {
    case BODY_SOLID:
        return 2.0 / 5;
    case BODY_HOLLOW:
        return isnan(b->wall) ? 2.0 / 3 : 2.0 / 5 * shell(b->wall / b->radius, 5) / shell(b->wall / b->radius, 3);
    case BODY_HOOP:
        return 1;
    default:
        return 1.0 / 2;
    }
}

double ball_gravity(const struct contact *c)
{
    return c->motion.path == PATH_INCLINE ? c->contact.gravity * real_cospi(c->motion.incline / REAL_PI)
                                          : c->contact.gravity;
}

double ball_stiffness(const struct contact *c)
{
    const struct roll *r = &c->contact.roll;
    return !isnan(r->stiffness) ? r->stiffness : r->kappa * c->scraper.mass;
}

void ball_apply(struct contact *c)
{
    const struct ball *b = &c->ball;
    c->motion.gravity = c->contact.gravity;
    c->motion.inertia = ball_inertia(c);
    if (!ball_rolls(c)) return;
    c->scraper = (struct scraper){
        .mass = ball_mass(b), .weight = b->weight, .radius = b->radius, .patch = b->patch, .response = b->response};
}
