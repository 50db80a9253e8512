/* Of an object of closed form: phi = shape / sqrt(modal mass), exact, with its sign. A shell's modes come in families,
   one of which answers a force wherever it is with the same gain (object_shell.c): phi = 1/sqrt(mass) everywhere, and
   its pattern goes with the contact. Rigid motions of what is free are left out, as they are of what sounds.

   Of a mode table with shared poles, heard where it is touched: a mode of complex gain A, h(t) = Im(A e^(s t)), is in
   displacement A / s^q, q = 0, 1, 2 of displacement, velocity, acceleration, and with q_i'' + 2 sigma q_i' + |s|^2 q_i
   = phi f, w = phi q_i,

     A / s^q = phi^2 / w_d,   w_d = 2 pi f:   real and positive,   phi = sqrt(w_d Re(A / s^q)).

   Gains at two different places are phi(x) phi(l) / w_d, of either sign, from which phi cannot be told; as coupled to a
   ball they could give out more energy than they take. They are refused: at each of the table's places the phase of A /
   s^q may be off by PHASE rad (a table whose velocity starts as a cosine is off by the loss factor over 2), beyond
   FLOOR of the mode's largest, and of what is off the real part counts. The sign of phi is lost on a table. Between
   places A is what morph.c makes of it: in triangles phi is 0 only where a place lies on a nodal line; where a spline
   of phi^2 comes out a little below 0, beside such a line, phi is 0. */
#include "response/shapes.h"

#include <math.h>

#include "num/real.h"
#include "response/morph.h"
#include "response/object.h"

#define PHASE 0.05
#define FLOOR 1e-6 /* -120 dB, below which morph.c takes a gain for none */

struct shapes_self {
    const double *scale;       /* [n] of an object: 1/sqrt(modal mass), 1/sqrt(kg)         */
    double origin[2];          /* m: where the object's x = y = 0 lies                     */
    bool family;               /* a shell's                                                */
    double *turn_re, *turn_im; /* [n] of a table: w_d / s^q                                */
    struct modes_point point;  /* of a table: work                                         */
};

/* ------------------------------------------------------------------ objects */

static void of_object(const struct modes *m, struct arena *a, struct shapes_self *self)
{
    const struct object *o = m->object;
    double *scale = ARENA_TAKE(a, double, o->n);
    const double *origin = object_modes_origin(m);
    for (int i = 0; i < o->n; i++)
        scale[i] = 1 / sqrt(o->mass[i]);
    *self = (struct shapes_self){.scale = scale, .origin = {origin[0], origin[1]}, .family = o->shape == OBJECT_SHELL};
}

static void object_phi(const struct shapes *s, const struct modes_where *where, double *phi)
{
    const struct shapes_self *self = s->self;
    const struct object *o = s->modes->object;
    if (!self->family) o->shapes(o, where->x - self->origin[0], where->y - self->origin[1], phi);
    for (int i = 0; i < s->n; i++)
        phi[i] = (self->family ? 1 : phi[i]) * self->scale[i];
}

/* ------------------------------------------------------------------ tables */

static void of_table(const struct modes *m, struct arena *a, struct shapes_self *self)
{
    *self = (struct shapes_self){.turn_re = ARENA_TAKE(a, double, m->n),
                                 .turn_im = ARENA_TAKE(a, double, m->n),
                                 .point = modes_point_make(a, m->n)};
    for (int i = 0; i < m->n; i++) {
        double w = 2 * REAL_PI * m->frequency[i], d = m->decay[i], size = w * w + d * d, re = w, im = 0;
        for (int q = 0; q < m->quantity; q++) { /* over s: times (-d - j w) / |s|^2 */
            double turned = (im * w - re * d) / size;
            im = -(re * w + im * d) / size;
            re = turned;
        }
        self->turn_re[i] = re;
        self->turn_im[i] = im;
    }
}

static void table_phi(const struct shapes *s, const struct modes_where *where, double *phi)
{
    const struct shapes_self *self = s->self;
    const struct modes_point *p = &self->point;
    modes_at(s->modes, where, p);
    for (int i = 0; i < s->n; i++)
        phi[i] = sqrt(fmax(p->re[i] * self->turn_re[i] - p->im[i] * self->turn_im[i], 0));
}

static bool gains_elsewhere(const struct modes *m, int i, struct err *e)
{
    return err_set(e, ERR_SCENE,
                   "%s: its gains are those of another listening place than the one that is touched (that of the mode "
                   "at %.6g Hz is no driving point's), and do not "
                   "say how the surface gives way under the ball; give surface.object, or contact.roll.ground: rigid",
                   m->name, m->frequency[i]);
}

/* Of one mode: at every row. */
static bool row_gains(const struct modes *m, const struct shapes_self *self, int rows, const double *re,
                      const double *im, struct err *e)
{
    for (int i = 0; i < m->n; i++) {
        double largest = 0, turn_re = self->turn_re[i], turn_im = self->turn_im[i];
        for (int row = 0; row < rows; row++) {
            double x = re[row * m->n + i], y = im[row * m->n + i];
            largest = fmax(largest, sqrt((x * x + y * y) * (turn_re * turn_re + turn_im * turn_im)));
        }
        for (int row = 0; row < rows; row++) {
            double x = re[row * m->n + i], y = im[row * m->n + i], across = x * turn_im + y * turn_re,
                   along = x * turn_re - y * turn_im;
            if (along < -FLOOR * largest || fabs(across) > PHASE * fmax(along, 0) + FLOOR * largest)
                return gains_elsewhere(m, i, e);
        }
    }
    return true;
}

static bool table_is_driving(const struct modes *m, const struct shapes_self *self, struct err *e)
{
    const struct morph *p = m->self;
    if (m->at == morph_complex) return row_gains(m, self, p->rows, p->re, p->im, e);
    modes_at(m, &(struct modes_where){m->home[0], m->home[1], 0}, &self->point);
    return row_gains(m, self, 1, self->point.re, self->point.im, e);
}

/* ------------------------------------------------------------------ both */

bool shapes_make(const struct modes *m, const char *key, struct arena *a, struct shapes *s, struct err *e)
{
    struct shapes_self *self = ARENA_TAKE(a, struct shapes_self, 1);
    *s = (struct shapes){.n = m->n, .frequency = m->frequency, .decay = m->decay, .modes = m, .self = self};
    if (!m->shared || m->travels)
        return err_set(
            e, ERR_SCENE,
            "%s: %s, and so it cannot give way under a ball; give %s.object or a table with the same frequencies at "
            "all places, or "
            "contact.roll.ground: rigid",
            m->name,
            m->travels ? "its modes change over time" : "its frequencies and decays differ from place to place", key);
    s->moves = m->moves;
    if (m->object) {
        of_object(m, a, self);
        return true;
    }
    if (m->quantity > MODES_ACCELERATION)
        return err_set(e, ERR_SCENE,
                       "%s: it is of no motion of the surface; give %s.object, or contact.roll.ground: rigid", m->name,
                       key);
    of_table(m, a, self);
    return table_is_driving(m, self, e);
}

void shapes_at(const struct shapes *s, const struct modes_where *where, double *phi)
{
    if (s->modes->object)
        object_phi(s, where, phi);
    else
        table_phi(s, where, phi);
}
