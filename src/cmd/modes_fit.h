/* How well a mode table's places tell an object's gains between them, and how many places it takes. */
#ifndef CMD_MODES_FIT_H
#define CMD_MODES_FIT_H
#include "cmd/modes.h"

/* Gains and poles of the object as a table would hold them, at any place in its own coordinates; how far off (m) that
 * is, beyond 1e-9 there is nothing. */
struct modes_fit {
    const void *self;
    double (*at)(const void *self, double x, double y, const struct modes_point *p);
    int n;               /* modes */
    bool shared;         /* poles are the same everywhere */
    double *test;        /* work: gains at the places of the test, made once */
    double (*spot)[2];
    int spots;
    struct arena *arena;
};

/* Relative rms over places of the differences of all modes' gains, in dB: see modes_fit.c. NAN: there is one place
 * alone, or all gains are 0. */
double modes_fit_error(struct modes_fit *f, const struct modes_places *p);

/* The line of the table's head, and what the report goes on with; nothing of NAN. Above the goal where the numbers of
 * places were chosen: a warning (not with --quiet). */
void modes_fit_write(FILE *f, double db, const struct modes_places *p, struct arena *a);
void modes_fit_report(double db, struct arena *a);
void modes_fit_warn(struct cmd_call *c, double db, const struct modes_places *p);

/* The least numbers of places, near enough, that keep MODES_FIT_GOAL; set_out lays them out. */
#define MODES_FIT_GOAL -40.0
enum { MODES_FIT_PLACES = 4096, MODES_FIT_ROWS = 500000 };
typedef void modes_fit_lay(const void *self, const int n[2], struct arena *a, struct modes_places *p);
void modes_fit_places(struct modes_fit *f, modes_fit_lay *lay, const void *self, bool line, struct modes_places *p);

#endif
