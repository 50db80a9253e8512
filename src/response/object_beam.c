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
#include <math.h>

#include "num/real.h"
#include "num/vecmath.h"
#include "response/object_kinds.h"

struct beam {
    double sign;                /* of the cosine: +1 free, -1 clamped */
    double *k;                  /* [n] beta, 1/m */
    double *near, *far, *slope; /* [n] Q, P, s */
};

enum { CHUNK = 64 };

double object_beam_root(int edges, int i)
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

static double shapes(const struct object *o, double x, double y, double *phi)
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

void object_beam_bind(struct arena *a, struct object *o)
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
        double z = object_beam_root(edges, in->list.mode[i].a), q = real_exp(-z), s = real_sin(z), c = real_cos(z);
        b->k[i] = z / in->body->given->length;
        b->far[i] = edges == EDGES_CANTILEVER ? (c + s + q) / (1.0 + q * q + 2.0 * q * c)
                                              : (c - s - q) / (1.0 - q * q - 2.0 * q * s);
        b->slope[i] = 1.0 - 2.0 * b->far[i] * q;
        b->near[i] = 0.5 * (1.0 + b->slope[i]);
    }
    o->shapes = shapes;
    object_keep_table(o, a, b);
}
