#include "response/object_kinds.h"

#include <math.h>
#include <string.h>

#include "num/real.h"
#include "num/special.h"
#include "num/vecmath.h"
#include "scene/material.h"

/* What a given object is made of: the material's figures where the scene gives none; whether all that its shape needs
 * is there and fits. */

static double given_or(double given, double material) { return isnan(given) ? material : given; }

/* Isotropic materials follow youngs_modulus and poisson wherever those come from. */
static void material_figures(struct object_body *b, const struct material *m)
{
    const struct object_given *g = b->given;
    bool wood = m && !isnan(m->across) && m->across != m->youngs_modulus;
    b->youngs_modulus = given_or(g->youngs_modulus, m ? m->youngs_modulus : NAN);
    b->poisson = given_or(g->poisson, m ? m->poisson : NAN);
    b->across = given_or(g->youngs_modulus_across, wood ? m->across : b->youngs_modulus);
    double mean = sqrt(b->youngs_modulus * b->across), nu = b->poisson * sqrt(b->across / b->youngs_modulus);
    b->shear = given_or(g->shear_modulus, wood ? m->shear : mean / (2.0 * (1.0 + nu)));
    bool any = m || !isnan(g->alpha) || !isnan(g->beta) || !isnan(g->loss);
    b->alpha = given_or(g->alpha, m ? m->alpha : any ? 0.0 : NAN);
    b->beta = given_or(g->beta, m ? m->beta : any ? 0.0 : NAN);
    b->loss = given_or(g->loss, m ? m->loss : any ? 0.0 : NAN);
}

struct need {
    const char *name;
    double value;
    unsigned shapes; /* bits of enum object_shape */
};

#define ON(shape) (1u << (OBJECT_##shape))
#define STIFF (ON(BAR) | ON(ROD) | ON(STRING) | ON(PLATE) | ON(DISK) | ON(SHELL))
#define SHEET (ON(BAR) | ON(PLATE) | ON(DISK) | ON(MEMBRANE) | ON(DRUM) | ON(SHELL))

enum { SIZES = 6 }; /* of the needs below: the first, what follows is the material */

static bool all_there(const struct object_body *b, struct err *e)
{
    const struct object_given *g = b->given;
    const struct need needs[] = {
        {"length", g->length, ON(BAR) | ON(ROD) | ON(STRING) | ON(PLATE) | ON(MEMBRANE)},
        {"width", g->width, ON(BAR) | ON(PLATE) | ON(MEMBRANE)},
        {"diameter", g->diameter, ON(ROD) | ON(STRING) | ON(DISK) | ON(DRUM) | ON(SHELL)},
        {"thickness", g->thickness, SHEET},
        {"tension", g->tension, ON(STRING)},
        {"surface_tension", g->surface_tension, ON(MEMBRANE) | ON(DRUM)},
        {"density", b->density, ~0u},
        {"youngs_modulus", b->youngs_modulus, STIFF},
        {"poisson", b->poisson, ON(PLATE) | ON(DISK) | ON(SHELL)},
        {"alpha, beta or loss", b->alpha, ~0u},
    };
    for (size_t i = 0; i < sizeof needs / sizeof *needs; i++) {
        if (!(needs[i].shapes >> g->shape & 1u) || !isnan(needs[i].value)) continue;
        if (i < SIZES) return err_set(e, ERR_SCENE, "%s.%s is missing", b->key, needs[i].name);
        return err_set(e, ERR_SCENE, "%s: a custom material needs %s (or name one: %s.material)", b->key, needs[i].name,
                       b->key);
    }
    return true;
}

static bool fits(const struct object_body *b, struct err *e)
{
    const struct object_given *g = b->given;
    double wall = g->thickness;
    if (g->shape == OBJECT_ROD && wall > 0.5 * g->diameter)
        return err_set(
            e, ERR_SCENE,
            "%s.thickness: a wall of %g m does not fit into a rod of %g m diameter; leave it out for a solid rod",
            b->key, wall, g->diameter);
    if (g->shape == OBJECT_SHELL && wall >= 0.5 * g->diameter)
        return err_set(e, ERR_SCENE,
                       "%s.thickness: a wall of %g m does not fit into a shell of %g m diameter; give a thinner one",
                       b->key, wall, g->diameter);
    if (g->shape == OBJECT_DISK && g->edges == EDGES_CANTILEVER)
        return err_set(e, ERR_SCENE, "%s.edges: a disk has one edge all round; cantilever is for bars, rods and plates",
                       b->key);
    return true;
}

const struct object_body *object_kinds_body(const struct object_given *given, const char *key, struct arena *a,
                                            struct err *e)
{
    struct object_body *b = ARENA_TAKE(a, struct object_body, 1);
    struct object_given *copy = ARENA_TAKE(a, struct object_given, 1);
    const struct material *m = material_given(given);
    *copy = *given;
    *b = (struct object_body){
        .given = copy, .key = arena_text(a, key), .density = given_or(given->density, m ? m->density : NAN)};
    material_figures(b, m);
    return all_there(b, e) && fits(b, e) ? b : NULL;
}

/* Bending of a slender bar with free or clamped ends (Euler and Bernoulli): phi'''' = beta^4 phi, so that (Rayleigh,
   The Theory of Sound, sections 170-175; Blevins, Formulas for Natural Frequency and Mode Shape, 1979, table 8-1), z =
   beta L,

       free, clamped:  cos z cosh z = 1,    cantilever:  cos z cosh z = -1,
       free:           phi = cosh bx + cos bx - s (sinh bx + sin bx),
       clamped:        phi = cosh bx - cos bx - s (sinh bx - sin bx),     s = (cosh z - cos z)/(sinh z - sin z),
       cantilever:     as clamped with                                    s = (sinh z - sin z)/(cosh z + cos z),

   for all of which the mean of phi^2 over the length is 1. cosh - s sinh loses all digits for high modes: with e^z
   divided out,

       cosh bx - s sinh bx = P e^(-b (L - x)) + Q e^(-b x),   Q = (1 + s)/2,
       P = (1 - s) e^z / 2 = (cos z - sin z - e^-z)/(1 - e^-2z - 2 e^-z sin z)      free, clamped
                           = (cos z + sin z + e^-z)/(1 + e^-2z + 2 e^-z cos z)      cantilever,

   nothing overflows or cancels; 1 - s = 2 P e^-z. Roots by Newton on cos z -+ 1/cosh z. Rigid motions of free bars are
   left out. */

struct beam {
    double sign;                /* of the cosine: +1 free, -1 clamped */
    double *k;                  /* [n] beta, 1/m */
    double *near, *far, *slope; /* [n] Q, P, s */
};

enum { CHUNK = 64 };

double object_kinds_beam_root(int edges, int i)
{
    double sign = edges == EDGES_CANTILEVER ? 1.0 : -1.0;
    double z = REAL_PI * (edges == EDGES_CANTILEVER ? i - 0.5 : i + 0.5);
    for (int pass = 0; pass < 8; pass++) {
        double small = real_exp(-z), sech = 2.0 * small / (1.0 + small * small);
        double value = real_cos(z) + sign * sech, derivative = -real_sin(z) - sign * sech * real_tanh(z);
        z -= value / derivative;
    }
    return z;
}

static double beam_shapes(const struct object *o, double x, double y, double *phi)
{
    const struct beam *b = (const struct beam *)object_inside(o)->table;
    double off = object_nearest(o, &x, &y), left = o->high[0] - x;
    for (int i = 0; i < o->n; i += CHUNK) {
        double turn[CHUNK], s[CHUNK], c[CHUNK], near[CHUNK], far[CHUNK];
        int n = o->n - i < CHUNK ? o->n - i : CHUNK;
        for (int k = 0; k < n; k++) {
            turn[k] = b->k[i + k] * x / REAL_PI;
            near[k] = -b->k[i + k] * x;
            far[k] = -b->k[i + k] * left;
        }
        vecmath_sincospi((size_t)n, turn, s, c);
        vecmath_exp((size_t)n, near, near);
        vecmath_exp((size_t)n, far, far);
        for (int k = 0; k < n; k++)
            phi[i + k] = b->near[i + k] * near[k] + b->far[i + k] * far[k] + b->sign * (c[k] - b->slope[i + k] * s[k]);
    }
    return off;
}

static void beam_bind(struct arena *a, struct object *o)
{
    const struct object_inside *in = object_inside(o);
    struct beam *b = ARENA_TAKE(a, struct beam, 1);
    int edges = in->body->given->edges;
    b->sign = edges == EDGES_FREE ? 1.0 : -1.0;
    b->k = ARENA_TAKE(a, double, o->n);
    b->near = ARENA_TAKE(a, double, o->n);
    b->far = ARENA_TAKE(a, double, o->n);
    b->slope = ARENA_TAKE(a, double, o->n);
    for (int i = 0; i < o->n; i++) {
        double z = object_kinds_beam_root(edges, in->list.mode[i].a), q = real_exp(-z), s = real_sin(z),
               c = real_cos(z);
        b->k[i] = z / in->body->given->length;
        b->far[i] = edges == EDGES_CANTILEVER ? (c + s + q) / (1.0 + q * q + 2.0 * q * c)
                                              : (c - s - q) / (1.0 - q * q - 2.0 * q * s);
        b->slope[i] = 1.0 - 2.0 * b->far[i] * q;
        b->near[i] = 0.5 * (1.0 + b->slope[i]);
    }
    o->shapes = beam_shapes;
    object_set_table(o, a, b);
}

/* Bars (rectangular section, bending across the thickness) and rods (round: solid, or a tube with a wall).

   Bending (Euler and Bernoulli; Rayleigh, The Theory of Sound, chapter VIII): w = beta^2 sqrt(E I/(rho A)), beta from
   object_kinds.c, or i pi/L with sines between simple supports; I = b h^3/12, or pi (D^4 - d^4)/64. Masses: rho A L,
   supported half of it.

   Longitudinal waves: w = k sqrt(E/rho); k = i pi/L with cosines between free ends and sines between held ones (nothing
   turns here: `supported` is the same as `clamped`), k = (i - 1/2) pi/L with sines when x = 0 is held. Masses: rho A
   L/2. The force is then along the bar.

   What this leaves out, to first order: Timoshenko's shear and rotation lower bending frequencies by (beta r)^2/2 (1 +
   E/(kappa G)), r^2 = I/A, kappa = 5/6, 9/10 (solid), 1/2 (thin tube); Rayleigh's lateral inertia longitudinal ones by
   (nu k)^2 r_p^2/2, r_p^2 = polar I/A. */

struct section {
    double area, inertia, polar; /* m^2, m^4 */
    double kappa;
};

static struct section section_of(const struct object_given *g)
{
    if (g->shape == OBJECT_BAR) {
        double area = g->width * g->thickness, i = area * g->thickness * g->thickness / 12.0;
        return (struct section){area, i, i + area * g->width * g->width / 12.0, 5.0 / 6.0};
    }
    double out = g->diameter, in = isnan(g->thickness) ? 0.0 : fmax(out - 2.0 * g->thickness, 0.0);
    double area = REAL_PI / 4.0 * (out * out - in * in),
           i = REAL_PI / 64.0 * (out * out * out * out - in * in * in * in);
    return (struct section){area, i, 2.0 * i, in > 0.5 * out ? 0.5 : 0.9};
}

static bool bends(const struct object_given *g) { return g->waves == WAVES_BENDING; }

static struct object_mode mode_bending(const struct object_body *b, const struct section *s, int i)
{
    const struct object_given *g = b->given;
    bool sine = g->edges == EDGES_SUPPORTED;
    double z = sine ? i * REAL_PI : object_kinds_beam_root(g->edges, i), k = z / g->length;
    double mass = b->density * s->area * g->length, shear = isnan(b->shear) ? b->youngs_modulus / 2.6 : b->shear;
    double k2r2 = k * k * s->inertia / s->area;
    struct object_mode m = {.w = k * k * sqrt(b->youngs_modulus * s->inertia / (b->density * s->area)),
                            .mass = sine ? 0.5 * mass : mass,
                            .a = sine ? 2 * i : i};
    m.excess = 0.5 * k2r2 * (1.0 + b->youngs_modulus / (s->kappa * shear));
    return m;
}

static struct object_mode mode_longitudinal(const struct object_body *b, const struct section *s, int i)
{
    const struct object_given *g = b->given;
    int quarters = g->edges == EDGES_CANTILEVER ? 2 * i - 1 : 2 * i;
    double k = quarters * REAL_PI / (2.0 * g->length), nu = isnan(b->poisson) ? 0.3 : b->poisson;
    struct object_mode m = {.w = k * sqrt(b->youngs_modulus / b->density),
                            .mass = 0.5 * b->density * s->area * g->length,
                            .a = quarters,
                            .c = g->edges == EDGES_FREE};
    m.excess = 0.5 * nu * nu * k * k * s->polar / s->area;
    return m;
}

static bool bar_list(const struct object_body *b, const struct object_limit *limit, struct arena *a,
                     struct object_list *l, struct err *e)
{
    (void)e;
    struct section s = section_of(b->given);
    for (int i = 1; i <= limit->most; i++) {
        struct object_mode m = bends(b->given) ? mode_bending(b, &s, i) : mode_longitudinal(b, &s, i);
        if (m.w >= limit->w) break;
        object_list_add(l, a, m);
    }
    return true;
}

static void bar_bind(struct arena *a, struct object *o)
{
    const struct object_given *g = object_inside(o)->body->given;
    double width = g->shape == OBJECT_BAR ? g->width : g->diameter;
    o->high[0] = g->length;
    o->low[1] = g->shape == OBJECT_BAR ? 0.0 : -0.5 * width;
    o->high[1] = g->shape == OBJECT_BAR ? width : 0.5 * width;
    double surface = g->shape == OBJECT_BAR ? 2.0 * (g->length * (width + g->thickness) + width * g->thickness)
                                            : REAL_PI * width * (g->length + 0.5 * width);
    o->radius = sqrt(surface / (4.0 * REAL_PI));
    if (bends(g) && g->edges != EDGES_SUPPORTED)
        beam_bind(a, o);
    else
        object_sine_bind(a, o);
}

const struct object_kind object_kinds_bar = {"slender-bar theory", bar_list, bar_bind};

/* Stretched string with fixed ends and stiffness (H. Fletcher, J. Acoust. Soc. Am. 36, 1964, 203; Morse, Vibration and
   Sound, section 16):

       f_n = n f0 sqrt(1 + B n^2),   f0 = sqrt(T/mu)/(2 L),   B = pi^3 E d^4/(64 T L^2),   mu = rho pi d^2/4,

   shapes sin(n pi x/L) (supported ends), masses mu L/2. The diameter is that of the core that bends, density that of
   all of it. */

static bool string_list(const struct object_body *b, const struct object_limit *limit, struct arena *a,
                        struct object_list *l, struct err *e)
{
    (void)e;
    const struct object_given *g = b->given;
    double d2 = g->diameter * g->diameter, mu = b->density * REAL_PI * d2 / 4.0, length = g->length;
    double stiffness =
        REAL_PI * REAL_PI * REAL_PI * b->youngs_modulus * d2 * d2 / (64.0 * g->tension * length * length);
    for (int n = 1; n <= limit->most; n++) {
        double w = n * REAL_PI / length * sqrt(g->tension / mu) * sqrt(1.0 + stiffness * n * n);
        if (w >= limit->w) break;
        object_list_add(l, a, (struct object_mode){.w = w, .mass = 0.5 * mu * length, .a = 2 * n});
    }
    return true;
}

static void string_bind(struct arena *a, struct object *o)
{
    const struct object_given *g = object_inside(o)->body->given;
    o->high[0] = g->length;
    o->low[1] = -0.5 * g->diameter;
    o->high[1] = 0.5 * g->diameter;
    o->radius = sqrt(0.25 * g->diameter * g->length);
    object_sine_bind(a, o);
}

const struct object_kind object_kinds_string = {"string theory", string_list, string_bind};

/* Stretched rectangular membrane, held at its edges (Rayleigh, The Theory of Sound, section 195): w = sqrt(S/(rho h))
   sqrt(kx^2 + ky^2), kx = m pi/a, ky = n pi/b, shapes sin(kx x) sin(ky y), masses rho h a b/4; S in N/m. No stiffness,
   no air load. */

static double frequency(const void *speed, double kx, double ky)
{
    return *(const double *)speed * sqrt(kx * kx + ky * ky);
}

static bool membrane_list(const struct object_body *b, const struct object_limit *limit, struct arena *a,
                          struct object_list *l, struct err *e)
{
    (void)e;
    const struct object_given *g = b->given;
    double area_density = b->density * g->thickness, speed = sqrt(g->surface_tension / area_density);
    struct object_sine_law law = {frequency, NULL, &speed, 0.25 * area_density * g->length * g->width};
    object_sine_list(b, &law, limit, a, l);
    return true;
}

static void membrane_bind(struct arena *a, struct object *o)
{
    const struct object_given *g = object_inside(o)->body->given;
    o->high[0] = g->length;
    o->high[1] = g->width;
    o->flat = true;
    o->radius = sqrt(g->length * g->width / (2.0 * REAL_PI));
    object_sine_bind(a, o);
}

const struct object_kind object_kinds_membrane = {"membrane theory", membrane_list, membrane_bind};

/* Stretched circular membrane, held at its edge (Rayleigh, The Theory of Sound, sections 200-206): R = J_n(lambda r/a),
   J_n(lambda) = 0, w = lambda/a sqrt(S/(rho h)), S in N/m; mass 2 pi (n = 0) or pi times rho h a^2 J_{n+1}(lambda)^2/2.
   No stiffness, no air load. */

static double drum_zero(const struct object_radial *q, int n, double lambda)
{
    (void)q;
    double j[2];
    special_bessel_j(n, lambda, j);
    return j[0];
}

static double drum_value(const struct object_radial *q, int n, double lambda, double r)
{
    return drum_zero(q, n, lambda * r);
}

static struct object_mode drum_mode(const struct object_radial *q, int n, double lambda)
{
    double j[2], a = q->radius;
    special_bessel_j(n, lambda, j);
    return (struct object_mode){.w = lambda / a * sqrt(q->stiffness / q->area_density),
                                .mass = REAL_PI * q->area_density * a * a * j[1] * j[1]};
}

static bool drum_list(const struct object_body *b, const struct object_limit *limit, struct arena *a,
                      struct object_list *l, struct err *e)
{
    (void)e;
    const struct object_given *g = b->given;
    double radius = 0.5 * g->diameter, h = g->thickness;
    struct object_radial q = {drum_zero,      drum_value, drum_mode,      0.0, radius, g->surface_tension,
                              b->density * h, h,          EDGES_SUPPORTED};
    object_radial_list(&q, limit, limit->w * radius * sqrt(q.area_density / q.stiffness), a, l);
    return true;
}

const struct object_kind object_kinds_drum = {"membrane theory", drum_list, object_radial_bind};

/* Thin circular plate (Kirchhoff), isotropic, radius a (Leissa, Vibration of Plates, NASA SP-160, 1969, chapter 2;
   Rayleigh, The Theory of Sound, sections 218-219a; free edge: K. Itao and S. H. Crandall, J. Appl. Mech. 46, 1979,
   448):

       R = J_n(lambda r/a) + C I_n(lambda r/a)/I_n(lambda),   w = lambda^2/a^2 sqrt(D/(rho h)),   D = E h^3/(12 (1 -
                                                              nu^2)),

   with, at r = a (a = 1; L f = f'' + nu (f' - n^2 f) the bending moment, V f = (laplacian f)' - (1 - nu) n^2 (f' - f)
   the edge's shear force): clamped R = R' = 0, supported R = L R = 0, free L R = V R = 0. Bessel's equation turns f''
   into f, f':

       L = -+lambda^2 f - (1 - nu)(f' - n^2 f),   V = -+lambda^2 f' - (1 - nu) n^2 (f' - f),   - for J, + for I.

   Mass: 2 pi (n = 0) or pi times rho h a^2 int_0^1 R^2 r dr; the integrals of J^2 r, I^2 r and J I r are known (DLMF
   10.22.5, 10.22.4). Rigid motions (n = 0, 1 of a free disk) are left out. What thin-plate theory leaves out: as in
   object_plate.c. */

struct edge {             /* at r = a: J and I/I_n(lambda) */
    double j, dj, lj, vj; /* f, f', L f, V f */
    double di, li, vi;    /* (f is 1) */
};

static struct edge edge_of(const struct object_radial *q, int n, double lambda)
{
    double j[2], i[2], k = 1.0 - q->poisson, n2 = (double)n * n, l2 = lambda * lambda;
    special_bessel_j(n, lambda, j);
    special_bessel_i(n, lambda, i);
    struct edge s = {.j = j[0], .dj = n * j[0] - lambda * j[1], .di = n + lambda * i[1] / i[0]};
    s.lj = -l2 * s.j - k * (s.dj - n2 * s.j);
    s.vj = -l2 * s.dj - k * n2 * (s.dj - s.j);
    s.li = l2 - k * (s.di - n2);
    s.vi = l2 * s.di - k * n2 * (s.di - 1.0);
    return s;
}

static double disk_zero(const struct object_radial *q, int n, double lambda)
{
    struct edge s = edge_of(q, n, lambda);
    if (q->edges == EDGES_CLAMPED) return s.j * s.di - s.dj;
    if (q->edges == EDGES_SUPPORTED) return s.j * s.li - s.lj;
    return s.lj * s.vi - s.li * s.vj;
}

/* C, from the larger of two equations. */
static double share(const struct object_radial *q, const struct edge *s, double lambda)
{
    if (q->edges != EDGES_FREE) return -s->j;
    return fabs(s->li) * lambda > fabs(s->vi) ? -s->lj / s->li : -s->vj / s->vi;
}

static double disk_value(const struct object_radial *q, int n, double lambda, double r)
{
    struct edge s = edge_of(q, n, lambda);
    double j[2], at[2], edge[2];
    special_bessel_j(n, lambda * r, j);
    special_bessel_i(n, lambda * r, at);
    special_bessel_i(n, lambda, edge);
    return j[0] + share(q, &s, lambda) * (at[0] / edge[0]) * real_exp(-lambda * (1.0 - r));
}

/* int_0^1 R^2 r dr */
static double square(const struct object_radial *q, int n, double lambda)
{
    struct edge s = edge_of(q, n, lambda);
    double c = share(q, &s, lambda), l2 = lambda * lambda, n2 = (double)n * n;
    double jj = s.dj * s.dj + (l2 - n2) * s.j * s.j, ii = (l2 + n2) - s.di * s.di, ji = s.j * s.di - s.dj;
    return (jj + c * c * ii + 2.0 * c * ji) / (2.0 * l2);
}

static struct object_mode disk_mode(const struct object_radial *q, int n, double lambda)
{
    double a = q->radius, h = q->thickness, k = lambda / a;
    struct object_mode m = {.w = k * k * sqrt(q->stiffness / q->area_density),
                            .mass = 2.0 * REAL_PI * q->area_density * a * a * square(q, n, lambda)};
    m.excess = k * k * h * h / 24.0 * (1.0 + 2.0 / (5.0 / 6.0 * (1.0 - q->poisson)));
    return m;
}

static bool disk_list(const struct object_body *b, const struct object_limit *limit, struct arena *a,
                      struct object_list *l, struct err *e)
{
    (void)e;
    const struct object_given *g = b->given;
    double h = g->thickness, nu = b->poisson, radius = 0.5 * g->diameter;
    struct object_radial q = {
        disk_zero,      disk_value, disk_mode, nu, radius, b->youngs_modulus * h * h * h / (12.0 * (1.0 - nu * nu)),
        b->density * h, h,          g->edges};
    object_radial_list(&q, limit, radius * sqrt(limit->w * sqrt(q.area_density / q.stiffness)), a, l);
    return true;
}

const struct object_kind object_kinds_disk = {"thin-plate theory", disk_list, object_radial_bind};

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
   tangential motion included. The shape thus starts at the place that is touched (object.c). Coordinates: lengths
   along great circles from a pole, x = R gamma cos(azimuth), y = R gamma sin(azimuth), R gamma up to pi R, R the outer
   radius.

   What is left out, shear and rotation, counts as in a plate of wave number l/R, by the share of bending in the energy.
 */

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

static bool shell_list(const struct object_body *b, const struct object_limit *limit, struct arena *a,
                       struct object_list *l, struct err *e)
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

static double shell_shapes(const struct object *o, double x, double y, double *phi)
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

void object_kinds_shell_from(const struct object *o, const double pole[2], const double place[2], double *phi)
{
    double p[3], q[3];
    direction(o, pole, p);
    direction(o, place, q);
    legendre(o, fmin(fmax(p[0] * q[0] + p[1] * q[1] + p[2] * q[2], -1.0), 1.0), phi);
}

static void shell_bind(struct arena *a, struct object *o)
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
    o->shapes = shell_shapes;
    object_set_table(o, a, order);
}

const struct object_kind object_kinds_shell = {"thin-shell theory", shell_list, shell_bind};
