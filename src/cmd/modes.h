/* Parts of `rasp modes`: each action is a file of its own, called with its operands only. */
#ifndef CMD_MODES_H
#define CMD_MODES_H
#include <stdio.h>

#include "cmd/cmd.h"
#include "cmd/modes.h"
#include "response/object.h"

/* --NAME as `count` lengths with commas between, each with a unit or bare in metres; x is left alone when the option is
 * not given. ERR_USAGE */
struct modes_lengths {
    const char *name, *form; /* "X,Y" */
    int count;
};
bool modes_lengths(struct cmd_call *c, const struct modes_lengths *want, double *x, struct err *e);

/* --quantity, else velocity. ERR_USAGE */
bool modes_quantity(struct cmd_call *c, int *quantity, struct err *e);
const char *modes_per_impulse(int quantity); /* its unit: "(m/s)/(N s)" */

/* What a body of the operand rings with: the operand is a scene, or a recipe of surface keys. *key: "surface",
 * "scraper" or "ball". */
struct modes_body {
    struct scene scene;
    const struct response *response;
    const char *key;
    const char *title, *remark; /* the recipe's title and source, the scene's title; NULL: none */
};
bool modes_body_read(struct cmd_call *c, const char *file, struct modes_body *b, struct err *e);

/* The object of closed form that it is, with all modes below --top. *note: how far its theory reaches, NULL: nothing to
 * say. ERR_SCENE: it is none. */
bool modes_body_object(struct cmd_call *c, const struct modes_body *b, struct object *o, const char **note,
                       struct err *e);

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
bool modes_places_apart(const struct modes_places *p, struct arena *a, int *bad, struct err *e);
/* fit: as in struct modes_ground. */
bool modes_body_places(struct cmd_call *c, const struct modes_body *b, const struct object *o, struct modes_fit *fit,
                       struct modes_places *p, struct err *e);

/* The actions; exit codes as a command's run. compute needs CHOLMOD and LAPACK: rasp starts rasp-modes for it. */
int modes_dispatch(struct cmd_call *c, int (*compute)(struct cmd_call *c, struct err *e), struct err *e);
int modes_compute_run(struct cmd_call *c, struct err *e);
int modes_extract_run(struct cmd_call *c, struct err *e);
int modes_list_run(struct cmd_call *c, struct err *e);

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

/* Relative rms over places of the differences of all modes' gains, in dB: see modes_places.c. NAN: there is one place
 * alone, or all gains are 0. */
double modes_places_error(struct modes_fit *f, const struct modes_places *p);

/* The line of the table's head, and what the report goes on with; nothing of NAN. Above the goal where the numbers of
 * places were chosen: a warning (not with --quiet). */
void modes_places_write(FILE *f, double db, const struct modes_places *p, struct arena *a);
void modes_places_report(double db, struct arena *a);
void modes_places_warn(struct cmd_call *c, double db, const struct modes_places *p);

/* The least numbers of places, near enough, that keep MODES_FIT_GOAL; set_out lays them out. */
#define MODES_FIT_GOAL -40.0
enum { MODES_FIT_PLACES = 4096, MODES_FIT_ROWS = 500000 };
typedef void modes_fit_lay(const void *self, const int n[2], struct arena *a, struct modes_places *p);

/* The output is not the file that is read, under whatever name (same device and inode; NULL: none is read). ERR_CREATE
 */
bool modes_output_spares(const char *output, const char *input, struct err *e);

/* Can it be created? Nothing is left. ERR_CREATE: a device, pipe or folder, write-protected, its folder is not there.
 */
bool modes_output_possible(const char *output, struct err *e);

#endif
