/* What object.c and the files of the shapes say to each other. A shape lists its modes (frequencies, masses), object.c
   damps and chooses, and the shape then makes tables for the modes that stay, from which its mode shapes are read. */
#ifndef RESPONSE_OBJECT_KINDS_H
#define RESPONSE_OBJECT_KINDS_H
#include <stdbool.h>

#include "base/arena.h"
#include "base/err.h"
#include "response/object.h"

struct object_body { /* sizes as given, the material with the given keys put in */
    const struct object_given *given;
    const char *key;
    double youngs_modulus, across, shear, poisson, density, alpha, beta, loss;
};

struct object_mode {
    double w, mass; /* rad/s, undamped; kg, integral of density phi^2 */
    double excess;  /* by which share the theory, which knows no shear and no rotation of sections, puts w too high */
    int a, b, c;    /* the shape's own */
    double own;
};

struct object_list {
    int n;
    struct object_mode *mode;
    const void *work; /* the shape's own: what it solved for */
    bool capped;      /* most was above what the shape computes */
    int dropped;      /* object.c: how many were overdamped */
};

struct object_limit {
    double w;   /* rad/s: modes below it, */
    int most;   /* of these the lowest `most` */
    double low; /* rad/s: object.c takes out those below */
};

/* list: sorted by w; leaves out rigid motions. bind: o->self is there (object_inside), n and mass are set. */
struct object_kind {
    const char *theory; /* for messages */
    bool (*list)(const struct object_body *, const struct object_limit *, struct arena *, struct object_list *,
                 struct err *);
    void (*bind)(struct arena *, struct object *);
};

struct object_inside { /* what o->self points at */
    const struct object_kind *kind;
    const struct object_body *body;
    struct object_list list; /* [o->n], same order as the object's modes */
    const void *table;       /* bind's */
};

extern const struct object_kind object_kinds_bar, object_kinds_string, object_plate, object_kinds_disk,
    object_kinds_membrane, object_kinds_drum, object_kinds_shell;

/* ------------------------------------------------------------------ object.c */

static inline const struct object_inside *object_inside(const struct object *o)
{
    return (const struct object_inside *)o->self;
}
void object_set_table(struct object *o, struct arena *a, const void *table);

/* Moves (x, y) to the nearest place of the box; returns how far. */
double object_nearest(const struct object *o, double *x, double *y);

/* A growing list, then sorted by w (ties: a, b, c) and cut to `most`. */
void object_list_add(struct object_list *l, struct arena *a, struct object_mode m);
void object_list_cut(struct object_list *l, const struct object_limit *limit);

/* phi = f(pi a x/(2 length)) sin(pi b y/(2 width)), f sin, or cos where c is 1; b = 0: no second
 * factor */
void object_sine_bind(struct arena *a, struct object *o);
/* Modes (m, n) >= 1 of w = law(m pi/length, n pi/width) that rises with both. */
struct object_sine_law {
    double (*w)(const void *self, double kx, double ky);
    double (*excess)(const void *self, double w); /* NULL: none */
    const void *self;
    double mass;
};
void object_sine_list(const struct object_body *b, const struct object_sine_law *law, const struct object_limit *limit,
                      struct arena *a, struct object_list *l);

/* phi = R_ns(r) cos n theta (c = 0) or sin n theta (c = 1), n = a, s = b, lambda = own */
struct object_radial {
    double (*zero)(const struct object_radial *, int n,
                   double lambda); /* changes sign at the lambda of order n, which lie above 0.9 n and 0.1 */
    double (*value)(const struct object_radial *, int n, double lambda, double r);  /* R, r = 0 to 1 of the radius */
    struct object_mode (*mode)(const struct object_radial *, int n, double lambda); /* w, excess, mass as if n were 0 */
    double poisson, radius, stiffness, area_density, thickness;                     /* what these need */
    int edges;
};
void object_radial_list(const struct object_radial *q, const struct object_limit *limit, double lambda_top,
                        struct arena *a, struct object_list *l);
void object_radial_bind(struct arena *a, struct object *o); /* the list's work is the object_radial */

/* sum[0..modes) = sum over t < n of weight[t] row_t, rows [n][modes], in order; n > 0, modes a multiple of OBJECT_SUM
 */
enum { OBJECT_SUM = 16 };

void object_sum(int n, int modes, const double *rows, const double *weight, double *sum);

/* ------------------------------------------------------------------ object_kinds.c */

/* NULL: a needed size or figure is missing, or sizes do not fit, ERR_SCENE */
const struct object_body *object_kinds_body(const struct object_given *given, const char *key, struct arena *a,
                                            struct err *e);

/* Bending of a slender bar, edges not supported: beta L of mode i = 1, 2, ... */
double object_kinds_beam_root(int edges, int i);

/* Shapes of a shell seen from a place that is not the pole */
void object_kinds_shell_from(const struct object *o, const double pole[2], const double place[2], double *phi);

/* ------------------------------------------------------------------ object_plate.c */

/* Modes of a plate with any edges. */
bool object_plate_ritz(const struct object_body *b, const struct object_limit *limit, struct arena *a,
                       struct object_list *l, struct err *e);

#endif
