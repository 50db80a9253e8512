/* Thin closed spherical shell, radius R of its middle surface, thickness h, non-torsional modes. With a tangential
   displacement U dP_l/dgamma and a radial one W P_l(cos gamma) the energies of the strains ((u' + w)/R, (u cot + w)/R)
   and of Love's bending (the normal turns by (u - w')/R) are quadratic forms in U, W; with L = l(l+1), g = L (L - 1 +
   nu), k = h^2/(12 R^2), O = w^2 rho R^2 (1 - nu^2)/E:

       [2(1 + nu) + k g,  -(1 + nu) L - k g] [W]       [1  0] [W]
       [-(1 + nu) L - k g,      g (1 + k)  ] [U]  =  O [0  L] [U],

   that is O^2 - (L + 1 + 3 nu + k (L^2 + nu L - 1 + nu)) O + (L - 2)(1 - nu^2 + k (L - 1 + nu)(L - 1 - nu)) = 0: the
   equation of M. C. Junger and D. Feit, Sound, Structures, and Their Interaction (1986), chapter 7, and for k = 0 that
   of W. E. Baker, J. Acoust. Soc. Am. 33, 1961, 1749 (membrane theory). l = 0 breathes, w^2 = 2 E/((1 - nu) rho R^2); l
   = 1 has one mode (the other is rigid); from l = 2 there are two, of which the lower bends. Torsional modes have no
   radial motion and are not excited by a force across the surface.

   The 2 l + 1 modes of one frequency are one here: by the addition theorem they answer a radial force with P_l of the
   angle gamma from its place, as one mode of shape P_l(cos gamma) and mass 4 pi rho h R^2 (1 + L (U/W)^2)/(2 l + 1),
   tangential motion included. The shape thus starts at the place that is touched (object_modes.c). Coordinates: lengths
   along great circles from a pole, x = R gamma cos(azimuth), y = R gamma sin(azimuth), R gamma up to pi R, R the outer
   radius.

   What is left out, shear and rotation, counts as in a plate of wave number l/R, by the share of bending in the energy.
 */
#include <math.h>
#include <string.h>

#include "num/real.h"
#include "response/object_kinds.h"

struct shell {
    double radius, nu, k, unit, mass; /* m; -; -; rad/s at O = 1; rho h R^2 4 pi */
};

static struct shell shell_of(const struct object_body *b)
{
    double h = b->given->thickness, r = 0.5 * (b->given->diameter - h), nu = b->poisson;
    return (struct shell){r, nu, h * h / (12.0 * r * r), sqrt(b->youngs_modulus / (b->density * (1.0 - nu * nu))) / r,
                          4.0 * REAL_PI * b->density * h * r * r};
}

/* The lower or upper mode of order l; w = 0: there is none, or it is rigid. */
static struct object_mode mode_of(const struct shell *s, int l, bool upper)
{
    double big = l * (l + 1.0), nu = s->nu, k = s->k, g = big * (big - 1.0 + nu);
    double half = 0.5 * (big + 1.0 + 3.0 * nu + k * (big * big + nu * big - 1.0 + nu));
    double product = (big - 2.0) * (1.0 - nu * nu + k * (big - 1.0 + nu) * (big - 1.0 - nu));
    double high = half + sqrt(half * half - product), o = upper ? high : product / high;
    double stretch = 2.0 * (1.0 + nu) + k * g, ratio = l ? (stretch - o) / ((1.0 + nu) * big + k * g) : 0.0;
    if (l == 0) o = upper ? 2.0 * (1.0 + nu) : 0.0;
    if (!(o > 0.0)) return (struct object_mode){0};
    double moving = 1.0 + big * ratio * ratio, bending = k * g * (1.0 - ratio) * (1.0 - ratio) / (o * moving);
    struct object_mode m = {.w = s->unit * sqrt(o), .mass = s->mass * moving / (2.0 * l + 1.0), .a = l, .b = upper};
    m.excess = bending * 0.5 * big * k * (1.0 + 2.0 / (5.0 / 6.0 * (1.0 - nu)));
    return m;
}

static bool list(const struct object_body *b, const struct object_limit *limit, struct arena *a, struct object_list *l,
                 struct err *e)
{
    (void)e;
    struct shell s = shell_of(b);
    for (int upper = 0; upper < 2; upper++)
        for (int i = 0; i <= limit->most + 1; i++) {
            struct object_mode m = mode_of(&s, i, upper == 1);
            if (m.w >= limit->w) break;
            if (m.w > 0.0) object_list_add(l, a, m);
        }
    object_list_cut(l, limit);
    return true;
}

/* P_l(c) of all modes; the table holds the modes by rising l. */
static void legendre(const struct object *o, double c, double *phi)
{
    const int *order = (const int *)object_inside(o)->table;
    const struct object_mode *mode = object_inside(o)->list.mode;
    double p = 1.0, below = 0.0;
    int l = 0;
    for (int i = 0; i < o->n; i++) {
        for (; l < mode[order[i]].a; l++) {
            double next = ((2 * l + 1) * c * p - l * below) / (l + 1);
            below = p;
            p = next;
        }
        phi[order[i]] = p;
    }
}

static double shapes(const struct object *o, double x, double y, double *phi)
{
    double from = sqrt(x * x + y * y), turn = fmin(from / o->high[0], 1.0);
    legendre(o, real_cospi(turn), phi);
    return fmax(from - o->high[0], 0.0);
}

/* Unit vector of a place. */
static void direction(const struct object *o, const double place[2], double out[3])
{
    double from = sqrt(place[0] * place[0] + place[1] * place[1]), turn = fmin(from / o->high[0], 1.0);
    double s = from > 0.0 ? real_sinpi(turn) / from : 0.0;
    out[0] = s * place[0];
    out[1] = s * place[1];
    out[2] = real_cospi(turn);
}

void object_shell_from(const struct object *o, const double pole[2], const double place[2], double *phi)
{
    double p[3], q[3];
    direction(o, pole, p);
    direction(o, place, q);
    legendre(o, fmin(fmax(p[0] * q[0] + p[1] * q[1] + p[2] * q[2], -1.0), 1.0), phi);
}

static void bind(struct arena *a, struct object *o)
{
    const struct object_inside *in = object_inside(o);
    double outer = 0.5 * in->body->given->diameter;
    int *order = ARENA_TAKE(a, int, o->n), *start, highest = 0;
    for (int i = 0; i < o->n; i++)
        highest = in->list.mode[i].a > highest ? in->list.mode[i].a : highest;
    start = ARENA_TAKE(a, int, highest + 2);
    for (int i = 0; i < o->n; i++)
        start[in->list.mode[i].a + 1]++;
    for (int l = 0; l < highest; l++)
        start[l + 1] += start[l];
    for (int i = 0; i < o->n; i++)
        order[start[in->list.mode[i].a]++] = i;
    o->low[0] = o->low[1] = -REAL_PI * outer;
    o->high[0] = o->high[1] = REAL_PI * outer;
    o->radius = outer;
    o->shapes = shapes;
    object_keep_table(o, a, order);
}

const struct object_kind object_shell = {"thin-shell theory", list, bind};
