/* The rolling curve (crest.h) as a part of a relief of one coordinate that reads what is under it when and where it is
 * read itself. */
#ifndef SURFACE_CREST_PART_H
#define SURFACE_CREST_PART_H
#include "surface/crest.h"
#include "surface/relief.h"

struct crest_plan {
    double radius; /* m                                                                               */
    double pitch;  /* m between the places where the ground is read, which lie at its multiples; at most 2 R but for
                      readers of heights at those alone */
    double reach;  /* m: ground further from the disc's centre than this need not be looked at; <= radius */
    double span;   /* m between the greatest and least height that reach was made for; HUGE_VAL: any  */
    bool points;   /* the ground has kinks: only its heights there count                              */
    void (*exceeded)(void *); /* called once when the heights read span more; may be NULL                      */
    void *self;
};

/* How many places of the ground are held at a time for a piece of the envelope. */
long crest_part_window(const struct crest_plan *p);

/* Heights and, as it has kinks, slopes and second derivatives of what is between them, kinks left out: for readers of
   heights only. `under` is read as it is then, when and where it is needed, and must live as long; results do not
   depend on the order of reading. */
struct relief_part *crest_part(struct arena *a, const struct relief *under, const struct crest_plan *p);

#endif
