/* See heightfile_doubt.h. Between polished glass (some nm rms) and gravel, and less steep than a wall. */
#include "file/heightfile_doubt.h"

#include <math.h>

const char *heightfile_doubt_length(double x, struct arena *a)
{
    static const struct {
        double from, factor;
        const char *name;
    } units[] = {{1, 1, "m"}, {1e-3, 1e3, "mm"}, {1e-6, 1e6, "um"}, {0, 1e9, "nm"}};
    int k = 0;
    if (isnan(x)) return "unknown";
    while (fabs(x) < units[k].from)
        k++;
    return x == 0 ? "0" : arena_format(a, "%.4g %s", x * units[k].factor, units[k].name);
}

/* Root mean square about the mean, and of the slope along rows; holes (NaN) are left out. */
static void figures(const struct heightfile *h, double *rms, double *slope)
{
    double n = 0, sum = 0, square = 0, steps = 0, rise = 0, low = HUGE_VAL, high = -HUGE_VAL;
    for (size_t i = 0; i < h->rows * h->columns; i++)
        if (!isnan(h->z[i])) {
            n++;
            sum += h->z[i];
            low = fmin(low, h->z[i]);
            high = fmax(high, h->z[i]);
        }
    for (size_t j = 0; j < h->rows; j++)
        for (size_t i = 0; i < h->columns; i++) {
            const double *z = h->z + j * h->columns + i, d = *z - sum / n, step = i > 0 ? z[0] - z[-1] : NAN;
            square += isnan(d) ? 0 : d * d;
            steps += !isnan(step);
            rise += isnan(step) ? 0 : step * step;
        }
    *rms = high > low ? sqrt(square / n) : 0; /* without the rounding of the sum */
    *slope = steps > 0 ? sqrt(rise / steps) / h->pitch_x : 0;
}

int heightfile_doubt(const struct heightfile *h, const struct heightfile_names *names, struct arena *a,
                     const char *texts[HEIGHTFILE_DOUBTS])
{
    const char *key = (names ? names : &heightfile_load_scene_names)->height_scale;
    double rms, slope;
    int n = 0;
    figures(h, &rms, &slope);
    if (rms > 0 && rms < 1e-9)
        texts[n++] = arena_format(a,
                                  "an rms height of %s is finer than polished glass: were micrometres taken for "
                                  "millimetres somewhere? Heights 1000 times as large would be an ordinary surface: "
                                  "check their unit and %s",
                                  heightfile_doubt_length(rms, a), key);
    if (slope > 3)
        texts[n++] = arena_format(
            a,
            "an rms slope of %.3g is steeper than any scraped surface: heights or pitch have the wrong unit: check %s",
            slope, key);
    if (rms > 1e-3 && n < HEIGHTFILE_DOUBTS)
        texts[n++] = arena_format(a, "an rms height of %s is that of gravel: is the unit right? Check %s",
                                  heightfile_doubt_length(rms, a), key);
    return n;
}
