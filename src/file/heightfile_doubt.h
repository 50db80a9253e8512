/* What of a height map's heights looks like a slip of their unit: told wherever a map is read, in the same words. */
#ifndef FILE_HEIGHTFILE_DOUBT_H
#define FILE_HEIGHTFILE_DOUBT_H
#include "base/arena.h"
#include "file/heightfile_load.h"

enum { HEIGHTFILE_DOUBTS = 2 };

/* The heights, as loaded: told in the names of whoever reads (NULL: a scene's). How many texts there are. */
int heightfile_doubt(const struct heightfile *h, const struct heightfile_names *names, struct arena *a,
                     const char *texts[HEIGHTFILE_DOUBTS]);

/* "5.2 um"; "unknown" of NAN. */
const char *heightfile_doubt_length(double x, struct arena *a);

#endif
