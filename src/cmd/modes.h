/* Parts of `rasp modes`: each action is a file of its own, called with its operands only. */
#ifndef CMD_MODES_H
#define CMD_MODES_H
#include <stdio.h>

#include "cmd/cmd.h"
#include "response/object.h"
#include "scene/material.h"

/* --NAME as `count` lengths with commas between, each with a unit or bare in metres, of the form "X,Y"; x is left alone
   when the option is not given. ERR_USAGE */
bool modes_lengths(struct cmd_call *c, const char *name, const char *form, int count, double *x, struct err *e);

/* --quantity, else velocity. ERR_USAGE */
bool modes_quantity(struct cmd_call *c, int *quantity, struct err *e);
const char *modes_per_impulse(int quantity); /* its unit: "(m/s)/(N s)" */

/* --line or --circle with --places, --grid, --at, else what suits the shape: places in the object's coordinates.
 * ERR_USAGE, ERR_SCENE: off the object. */
struct modes_places {
    int n, left_out; /* left_out: of a grid, those off the object */
    double (*xy)[2]; /* m */
    bool chosen;     /* as many as the goal of MODES_FIT_GOAL needs */
    bool line;       /* from, to: of the line; else of the box that holds them */
    double from[2], to[2];
    double ring[2]; /* m: of rings, the radii within which they lie; else 0 */
};
struct modes_fit;
struct modes_ground {
    const void *self;
    double (*off)(const void *self, double x, double y); /* m, how far off the object; INFINITY: there is none */
    bool (*bends)(const void *self, const double from[2],
                  const double to[2]); /* is there an edge between? NULL: none */
    double low[2], high[2];            /* m, box of the places */
    int standard[2];                   /* by default: NX, NY a grid; N, 1 a line in the middle; 1, 1 the place `at` */
    struct modes_fit *fit; /* by default, and on a line, as many places as its goal needs (MODES_FIT_GOAL); NULL: those
                              of `standard` */
    double at[2];
    const char *remark; /* ends a message that a place is beside the object; NULL: nothing */
};
bool modes_places(struct cmd_call *c, const struct modes_ground *g, struct modes_places *p, struct err *e);
/* No two are at one point, to a nanometre: a scene takes no table of such. *bad: the second of two. ERR_SCENE */
bool modes_places_distinct(const struct modes_places *p, struct arena *a, int *bad, struct err *e);
/* The lines of the table's head that tell damping and sources of a material; NULL: all figures are given. */
void modes_damping_write(FILE *f, const double damping[3], const struct material *m, bool own, bool own_damping);

/* What rasp-modes does: compute and material, which need CHOLMOD and LAPACK; `run` are their functions, which rasp does
   not link. Of the other actions GSL's matrices would be OpenBLAS's there, and the bytes those of the CPU. */
int modes_solids_only(struct cmd_call *c, struct err *e, int (*const run[2])(struct cmd_call *c, struct err *e));
int modes_compute_run(struct cmd_call *c, struct err *e);
int modes_material_run(struct cmd_call *c, struct err *e);
int modes_extract_run(struct cmd_call *c, struct err *e);
int modes_object_run(struct cmd_call *c, struct err *e);
int modes_object_list_run(struct cmd_call *c, struct err *e);
int modes_residual_run(struct cmd_call *c, struct err *e);

/* Gains and poles of the object as a table would hold them, at any place in its own coordinates; how far off (m) that
 * is, beyond 1e-9 there is nothing. */
struct modes_fit {
    const void *self;
    double (*at)(const void *self, double x, double y, const struct modes_point *p);
    int n;        /* modes */
    bool shared;  /* poles are the same everywhere */
    double *test; /* work: gains at the places of the test, made once */
    double (*spot)[2];
    int spots;
    struct arena *arena;
};

/* "FILE: 5 modes from 100 to 200 Hz at 3 places (...)", of a grid with what lies beside `what`; the line goes on. */
void modes_places_report(const char *file, const struct modes_places *p, const char *what, double db, int n,
                         const double range[2], struct arena *a);

/* Relative rms over places of the differences of all modes' gains, in dB: see modes_places.c. NAN: there is one place
 * alone, or all gains are 0. */
double modes_places_error(struct modes_fit *f, const struct modes_places *p);

/* The line of the table's head; nothing of NAN. Above the goal where the numbers of
 * places were chosen: a warning (not with --quiet). */
void modes_places_write(FILE *f, double db, const struct modes_places *p, struct arena *a);
void modes_places_warn(struct cmd_call *c, double db, const struct modes_places *p);

/* Of the choice of numbers of places (see modes_places.c). */
#define MODES_FIT_GOAL -40.0
/* The output is not the file that is read, under whatever name (same device and inode; NULL: none is read). ERR_CREATE
 */
bool modes_output_spares(const char *output, const char *input, struct err *e);

/* Can it be created? Nothing is left. ERR_CREATE: a device, pipe or folder, write-protected, its folder is not there.
 */
bool modes_output_possible(const char *output, struct err *e);

#endif
