/* Motions over time from a CSV: recorded places, with and without smoothing, and speeds; what is accepted is finite
 * everywhere. */
#include <math.h>

#include "fuzz.h"
#include "trajectory/path.h"
#include "trajectory/speed.h"

enum { POINTS = 33 };

static void check(const double *x)
{
    for (int i = 0; i < POINTS; i++)
        if (!isfinite(x[i])) abort();
}

static void places(const char *path, double cutoff, double duration)
{
    struct arena *a = arena_open();
    struct motion m = {.file = path, .cutoff = cutoff};
    struct course c = {0};
    struct err e = {0};
    double clock, w[POINTS], x[8][POINTS];
    bool ok = path_recorded(&m, duration, a, &c, &clock, &e);
    fuzz_check(ok, &e);
    if (ok) {
        for (int i = 0; i < POINTS; i++)
            w[i] = c.end * (i - 1) / (POINTS - 3); /* a little beyond both ends too */
        c.at(&c, POINTS, w, &(struct course_out){{x[0], x[1]}, {x[2], x[3]}, {x[4], x[5]}, {x[6], x[7]}});
        for (int k = 0; k < 2; k++)
            check(x[k]);
    }
    arena_close(a);
}

static void speeds(const char *path, double fold)
{
    struct arena *a = arena_open();
    struct speed s = {0};
    struct err e = {0};
    double t[POINTS], u[3][POINTS];
    bool ok = speed_given(&s, path, fold, a, &e);
    fuzz_check(ok, &e);
    if (ok) {
        for (int i = 0; i < POINTS; i++)
            t[i] = s.duration * i / (POINTS - 1);
        s.at(&s, POINTS, t, u[0], u[1], u[2]);
        check(u[0]);
        check(u[1]);
    }
    arena_close(a);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[128];
    fuzz_put(path, "input", data, size);
    places(path, 0, NAN);
    places(path, 10, NAN);
    places(path, 0, 0.5);
    speeds(path, NAN);
    speeds(path, 0.03);
    return 0;
}
