/* A height map ready for use: in metres, with its pitch, holes filled or refused, levelled, and plausible. What the
   scene's height maps, `rasp surface` and roughness.like share. */
#ifndef FILE_HEIGHTFILE_LOAD_H
#define FILE_HEIGHTFILE_LOAD_H
#include "file/heightfile.h"

/* REFUSE and FILL in the order of enum holes of scene/scene.h. */
enum heightfile_holes { HEIGHTFILE_REFUSE, HEIGHTFILE_FILL, HEIGHTFILE_KEEP };

/* How the caller's user sets these things, for messages. */
struct heightfile_names {
    const char *pitch, *height_scale, *height_range; /* "surface.pitch"                     */
    const char *fill;                                /* "surface.holes: fill", the whole    */
};
extern const struct heightfile_names heightfile_load_scene_names, heightfile_load_option_names;

struct heightfile_options {
    double pitch;        /* m, both ways; NAN: the file says it                                        */
    double height_scale; /* factor on the heights: m per stored unit; NAN or 1: none                   */
    double height_range; /* m that white stands for (PNG); NAN: not given                              */
    int holes;           /* enum heightfile_holes                                                      */
    int levelling;       /* enum heightfile_levelling (heightfile_level.h), as enum levelling of a scene */
    const struct heightfile_names *names; /* NULL: heightfile_load_scene_names                         */
};

/* Fills h: metres; pitch_x, and for a map pitch_y, are numbers. Order: scale, holes, limits, levelling (which leaves
   h->levelled). ERR_INPUT, ERR_SCENE as heightfile_read; and ERR_SCENE: fewer than 4 samples along a direction; pitch
   not known, given and not that of the file, or outside 10 nm to 1 mm; heights that span less than 1 nm (but are not
   all the same) or more than 10 mm: a unit is wrong, and the message says which would make sense; holes; a height range
   that is missing, or given where the file has none. ERR_NUMBERS: filling fails. */
bool heightfile_load(const char *path, const struct heightfile_options *o, struct arena *a, struct heightfile *h,
                     struct err *e);

#endif
