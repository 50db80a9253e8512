/* Places on rings round a centre: the part of places.h that is smooth where places are round. */
#ifndef RESPONSE_PLACES_RINGS_H
#define RESPONSE_PLACES_RINGS_H
#include "base/arena.h"
#include "response/places.h"

struct places_rings;

/* Of n places xy [n][2], in the order order[n] of the caller's: the rings that they make, each of RINGS_LEAST or more
   places at equal angles, to `same` (m), round the mean of all places, and maybe one place in the middle; NULL: they
   make none. */
enum { PLACES_RINGS_LEAST = 5 };
struct places_rings *places_rings_make(struct arena *a, int n, const double *xy, const int *order, double same);

/* As places_rows, places_fill, places_smooth_at. */
int places_rings_rows(const struct places_rings *p);
void places_rings_fill(const struct places_rings *p, int n, double *rows);
double places_rings_smooth_at(const struct places_rings *p, double x, double y, struct places_sum *sum);

#endif
