/* Thin circular plate (Kirchhoff), isotropic, radius a (Leissa, Vibration of Plates, NASA SP-160, 1969, chapter 2;
   Rayleigh, The Theory of Sound, sections 218-219a; free edge: K. Itao and S. H. Crandall, J. Appl. Mech. 46, 1979,
   448):

       R = J_n(lambda r/a) + C I_n(lambda r/a)/I_n(lambda),   w = lambda^2/a^2 sqrt(D/(rho h)),   D = E h^3/(12 (1 -
   nu^2)),

   with, at r = a (a = 1; L f = f'' + nu (f' - n^2 f) the bending moment, V f = (laplacian f)' - (1 - nu) n^2 (f' - f)
   the edge's shear force): clamped R = R' = 0, supported R = L R = 0, free L R = V R = 0. Bessel's equation turns f''
   into f, f':

       L = -+lambda^2 f - (1 - nu)(f' - n^2 f),   V = -+lambda^2 f' - (1 - nu) n^2 (f' - f),   - for J, + for I.

   Mass: 2 pi (n = 0) or pi times rho h a^2 int_0^1 R^2 r dr; the integrals of J^2 r, I^2 r and J I r are known
   (DLMF 10.22.5, 10.22.4). Rigid motions (n = 0, 1 of a free disk) are left out. What thin-plate theory leaves out: as
   in object_plate.c. */
#include <math.h>

#include "num/bessel.h"
#include "num/real.h"
#include "response/object_kinds.h"

struct edge {             /* at r = a: J and I/I_n(lambda) */
    double j, dj, lj, vj; /* f, f', L f, V f */
    double di, li, vi;    /* (f is 1) */
};

static struct edge edge_of(const struct object_radial *q, int n, double lambda)
{
    double j[2], i[2], k = 1.0 - q->poisson, n2 = (double)n * n, l2 = lambda * lambda;
    bessel_j(n, lambda, j);
    bessel_i(n, lambda, i);
    struct edge s = {.j = j[0], .dj = n * j[0] - lambda * j[1], .di = n + lambda * i[1] / i[0]};
    s.lj = -l2 * s.j - k * (s.dj - n2 * s.j);
    s.vj = -l2 * s.dj - k * n2 * (s.dj - s.j);
    s.li = l2 - k * (s.di - n2);
    s.vi = l2 * s.di - k * n2 * (s.di - 1.0);
    return s;
}

static double zero(const struct object_radial *q, int n, double lambda)
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

static double value(const struct object_radial *q, int n, double lambda, double r)
{
    struct edge s = edge_of(q, n, lambda);
    double j[2], at[2], edge[2];
    bessel_j(n, lambda * r, j);
    bessel_i(n, lambda * r, at);
    bessel_i(n, lambda, edge);
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

static struct object_mode mode(const struct object_radial *q, int n, double lambda)
{
    double a = q->radius, h = q->thickness, k = lambda / a;
    struct object_mode m = {.w = k * k * sqrt(q->stiffness / q->area_density),
                            .mass = 2.0 * REAL_PI * q->area_density * a * a * square(q, n, lambda)};
    m.excess = k * k * h * h / 24.0 * (1.0 + 2.0 / (5.0 / 6.0 * (1.0 - q->poisson)));
    return m;
}

static bool list(const struct object_body *b, const struct object_limit *limit, struct arena *a, struct object_list *l,
                 struct err *e)
{
    (void)e;
    const struct object_given *g = b->given;
    double h = g->thickness, nu = b->poisson, radius = 0.5 * g->diameter;
    struct object_radial q = {
        zero,           value, mode,    nu, radius, b->youngs_modulus * h * h * h / (12.0 * (1.0 - nu * nu)),
        b->density * h, h,     g->edges};
    object_radial_list(&q, limit, radius * sqrt(limit->w * sqrt(q.area_density / q.stiffness)), a, l);
    return true;
}

const struct object_kind object_disk = {"thin-plate theory", list, object_radial_bind};
