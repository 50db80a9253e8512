/* The fractal profile of the papers on rolling: heights on an even pitch, drawn from a power law, that repeat
 * themselves. */
#ifndef SURFACE_FRACTAL_H
#define SURFACE_FRACTAL_H
#include <stddef.h>

#include "num/noise.h"
#include "scene/scene.h"
#include "surface/relief.h"

enum fractal_spectrum { SPECTRUM_POWER, SPECTRUM_AMPLITUDE };
enum interpolation { INTERPOLATION_NEAREST, INTERPOLATION_LINEAR, INTERPOLATION_SPLINE };

struct fractal { /* section surface.fractal */
    bool given;
    double exponent;   /* beta: the spectrum over spatial frequency ~ k^exponent */
    int spectrum;      /* enum fractal_spectrum: of power or amplitude           */
    double maximum;    /* m, largest height above or below the mean              */
    double pitch;      /* m between its heights                                  */
    double length;     /* m, after which it repeats itself                       */
    int interpolation; /* enum interpolation, between its heights                */
};

/* How many heights a period has: length over pitch, to the nearest even number. */
double fractal_size(const struct fractal *f);

/* The heights of one period, m: z[fractal_size(f)]. */
void fractal_heights(const struct fractal *f, struct noise stream, double *z);

/* The profile as a part of a relief of one coordinate, height number 0 lies at x = 0. */
struct relief_part *fractal_part(struct arena *a, const struct fractal *f, struct noise stream);

#endif
