/* Whose set a folder holds: DIR/.rasp/design, the hash of the design on the first line, on the second where the design lies, seen from the folder, on the third which program rendered it.

   A design is known by its file, unless that is a pipe: edited, it is the same design, and its set goes on from what is there. It is known by its hash, too (struct set): moved, renamed or copied with the
   scenes and files that it builds on, it is the same. Any other is refused, for it would replace tables and stimuli of a set that is not its own. */
#ifndef BATCH_CLAIM_H
#define BATCH_CLAIM_H
#include <stdbool.h>

#include "base/arena.h"
#include "base/err.h"

struct claim {
    const char *folder, *design; /* the design's file, seen from here                                     */
    const char *sha256;          /* of struct set                                                         */
    const char *build;           /* of the program                                                          */
    bool replace;                /* another design's folder is taken over; nothing of it is removed by that */
};

/* folder_enter, unless the folder is another design's, or other programs work in it for another state of this one, or of another build. Those of the same state share it.
   folder_make was called. *entered is set in any case. ERR_CREATE */
bool claim_enter(const struct claim *c, struct arena *a, int *entered, struct err *e);

/* The same for a merge, which knows no design's file: the folder must hold this state of the set, or say nothing. ERR_CREATE; ERR_INPUT: it holds another by now */
bool claim_join(const struct claim *c, struct arena *a, int *entered, struct err *e);

/* Where a design lies, seen from its folder: the hash of a stimulus does not know where the folder is, but the file names in its scene do. UTF-8. What comes through a pipe or
   from stdin is called alike, or each time otherwise, whatever comes, and names its files from nowhere: then it is the folder that is named, "- /where/it/is". */
const char *claim_place(const char *design, const char *folder, struct arena *a);

/* Does the folder say whose it is? If not, nothing in it is a set's. */
bool claim_is_noted(const char *folder, struct arena *a);

/* Does it say that it is this one's? sha256: as of struct claim. */
bool claim_holds(const char *folder, const char *sha256, struct arena *a);

/* Would it be let in? Writes nothing; the folder need not be there. ERR_CREATE */
bool claim_look(const struct claim *c, struct arena *a, struct err *e);

#endif
