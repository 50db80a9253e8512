/* The measured map under a contact, for stages that go on from it (surface/continuation.c). */
#ifndef SURFACE_HEIGHT_MAP_H
#define SURFACE_HEIGHT_MAP_H
#include <stddef.h>

struct height_map {
    const double *z; /* m, [rows][columns]; rows = 1: a profile */
    size_t columns, rows;
    double pitch[2]; /* m along x (or the path) and y */
};

#endif
