/* Levelling a height map: what is subtracted before its roughness is looked at. Missing points are left out of the fit.
 */
#ifndef FILE_HEIGHTFILE_LEVEL_H
#define FILE_HEIGHTFILE_LEVEL_H
#include "file/heightfile.h"

/* In the order of enum levelling of scene/scene.h. */
enum heightfile_levelling { HEIGHTFILE_LEVEL_NONE, HEIGHTFILE_LEVEL_MEAN, HEIGHTFILE_LEVEL_PLANE };

/* The least-squares plane (of a profile: line) through the heights; a direction without two different places has slope
 * 0. */
struct heightfile_plane heightfile_level_fit(const struct heightfile *h);

/* Subtracts the mean or the plane and says what it was; with NONE nothing. */
struct heightfile_plane heightfile_level(struct heightfile *h, enum heightfile_levelling levelling);

#endif
