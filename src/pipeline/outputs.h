/* The files that a render writes, known before it begins: their names, and whom they would overwrite. */
#ifndef PIPELINE_OUTPUTS_H
#define PIPELINE_OUTPUTS_H
#include <stdbool.h>
#include <sys/types.h>

#include "base/arena.h"
#include "base/err.h"
#include "output/stems.h"
#include "scene/scene.h"

enum output_kind {
    OUTPUT_TABLE,
    OUTPUT_LISTING, /* these two one for each contact */
    OUTPUT_EFFECTIVE,
    OUTPUT_SUMMARY,
    OUTPUT_SOUND,
    OUTPUT_STEM,
    OUTPUT_STEM_LAST = OUTPUT_STEM + STEMS - 1, /* one kind per enum stem, in its order */
    OUTPUT_KINDS
};

struct outputs { /* of one scene */
    const struct scene *scene;
    const char *base;        /* folder and NAME */
    const char **paths;      /* [n] */
    enum output_kind *kinds; /* [n] */
    int n;
};

/* "csv" or "npy", "impacts", "scene", "summary", "wav"; "stem" of all stems */
const char *outputs_kind(const struct scene *s, enum output_kind kind);

/* BASE.csv (or BASE.npy) and BASE.impacts.csv or (of several contacts) BASE.CONTACT.csv and so on, BASE.scene.yaml,
   BASE.json, BASE.wav; the contact matters for the first two only. */
char *outputs_path(const struct scene *s, const char *base, enum output_kind kind, const struct contact *c,
                   struct arena *a);

/* What the scene writes: tables if it asks for diagnostics, series of impacts if it asks for them, a sound if something
 * rings, the stems that it asks for, always the other two. */
struct outputs outputs_make(const struct scene *s, const char *base, struct arena *a);

/* No file is written twice by these n scenes. ERR_USAGE: names the file and both scenes. */
bool outputs_distinct(const struct outputs *o, int n, struct arena *a, struct err *e);

/* No file that these n scenes write is one that any of them reads (the scene, what it includes, every file that it
   names), under whatever name; an effective scene that has the bytes of the file it replaces does no harm. ERR_CREATE:
   names both. */
bool outputs_check_overwrite(const struct outputs *o, int n, struct arena *a, struct err *e);

/* The rule of output/mark.h for all that these n scenes write; an effective scene that has the bytes of the file it
 * replaces does no harm. ERR_CREATE */
bool outputs_replace(const struct outputs *o, int n, bool force, struct arena *a, struct err *e);

struct outputs_source {      /* a file that a scene reads */
    const char *file, *what; /* what: "surface.response", "the scene itself" */
    const struct scene *scene;
    dev_t device;
    ino_t inode;
};

/* Those of one scene that are there: [n]. */
const struct outputs_source *outputs_sources(const struct scene *s, int *n, struct arena *a);

/* Files that a render under this name may write, that this scene's does not, and that are there: of an earlier render,
   most likely. Ends with NULL. Files that the scene reads are none of them. */
const char **outputs_older(const struct scene *s, const char *base, struct arena *a);

/* The effective scene as it stands in a file of that path. */
const char *outputs_effective(const struct scene *s, const char *path, struct arena *a);

#endif
