/* What `rasp surface info` knows of one file. */
#ifndef CMD_SURFACE_INFO_H
#define CMD_SURFACE_INFO_H
#include "analysis/surface_band.h"
#include "analysis/surface_ends.h"
#include "analysis/surface_heights.h"
#include "base/arena.h"
#include "file/heightfile_doubt.h"
#include "file/heightfile_load.h"

enum { SURFACE_INFO_NOTES = 16, SURFACE_INFO_ALPHAS = 2 };

extern const double surface_info_alphas[SURFACE_INFO_ALPHAS]; /* m: alpha of the limiter, 1/alpha the curvature it lets through */

struct surface_info {
    const char *file;
    struct heightfile h;            /* levelled as asked                                   */
    int levelling;
    struct heightfile_plane tilt;   /* of the map as it is in the file                     */
    struct surface_heights heights;
    struct surface_heights_steps steps;
    struct surface_band band[2];    /* along the rows, down the columns (of a map)         */
    struct surface_ends ends[2];
    struct surface_ends_period period;
    const char *notes[SURFACE_INFO_NOTES]; /* what looks like a fault; NULL-terminated     */
    int n_notes;
    struct arena *arena;
};

/* What looks like a fault, into i->notes. */
void surface_info_notes(struct surface_info *i);
/* A length as text: 4 digits in nm, um, mm or m. */
void surface_info_print(const struct surface_info *i);
/* The report of several files as one object on stdout. ERR_IO */
bool surface_info_json(const struct surface_info *const *list, int n, struct err *e);

#endif
