/* What `rasp modes compute` works on, and its parts: the solid, the places, the table. */
#ifndef CMD_MODES_COMPUTE_H
#define CMD_MODES_COMPUTE_H
#include "base/hash.h"
#include "cmd/modes.h"
#include "fem/boundary.h"
#include "fem/solid.h"
#include "scene/material.h"

struct compute_material {
    const struct material *named; /* NULL: all figures are given */
    bool own, own_damping;        /* figures of --youngs-modulus ..., of --alpha ... */
    struct elastic elastic;
    double youngs_modulus, poisson; /* for the table; of wood along the grain */
    double alpha, beta, loss;       /* 1/s, s, - */
};

struct compute {
    struct cmd_call *c;
    struct mesh mesh;
    struct boundary boundary;
    struct compute_material material;
    struct solid_fixed *fixed;
    const char **fixed_names; /* [n_held] */
    int n_fixed;
    double top; /* Hz */
    long most, order;
    struct boundary_map map;
    double origin[2]; /* m */
    int quantity;     /* enum modes_quantity */
    int places;
    double (*xy)[2];              /* [places] m, on the chart */
    struct boundary_point *point; /* [places] */
    struct modes_places laid;     /* the same as they were laid out; not those of a list */
    double error;                 /* dB, of interpolation between them; NAN: of none */
    double *phi, *ear_phi;        /* [modes.n] work */
    bool elsewhere;               /* heard at ... */
    struct boundary_point ear;
    struct solid_modes modes;
    int n, overdamped;         /* modes that ring; that do not */
    double *frequency, *decay; /* [n] Hz (damped; where damping is heavy, in another order than the modes), 1/s */
    double least, greatest;    /* Hz, of frequency */
    int *mode;                 /* [n] of modes.lambda */
    bool estimated;
    struct solid_estimate estimate;
    int coarse_elements;
    long coarse_freedoms, coarse_order;
    const char *note; /* lines */
};

/* Operand or --shape, --unit, --material ..., --clamp, --support: all that the modes are computed of. */
bool modes_compute_solid_read(struct compute *k, struct err *e);

/* Parts of that: the mesh file, or the shape, and --unit; --material, a word of the table (named NULL: not given); the
   constants of a wood whose moduli keep their ratios to that along the grain; --clamp, --support. */
bool modes_compute_solid_mesh(struct compute *k, const char *mesh, const char *shape, struct err *e);
bool modes_compute_solid_named(struct compute *k, struct err *e);
bool modes_compute_solid_wooden(const struct material *t, double youngs_modulus, double density,
                                struct elastic *elastic, struct err *e);
bool modes_compute_solid_fixed(struct compute *k, struct err *e);

/* The same solid of longer cells. */
bool modes_compute_solid_coarser(const struct compute *k, const char *shape, struct compute *c, struct err *e);

/* The modes. A pair w^2 = lambda decays with d = (alpha + beta w^2 + loss w)/2 and sounds at sqrt(lambda - d^2)/(2 pi):
   papers/003 equations 4, 5, with a loss factor besides; lambda <= d^2 is overdamped and left out, with a note. */
bool modes_compute_solid_solve(struct compute *k, struct err *e);

/* --estimate: the modes once more, of a coarser mesh of the shape or, of a mesh file, of the order below. */
bool modes_compute_solid_estimate(struct compute *k, struct err *e);
const char *modes_compute_solid_error_text(const struct compute *k);       /* in a few words */
void modes_compute_solid_estimate_write(FILE *f, const struct compute *k); /* "# ..." lines */

#endif
