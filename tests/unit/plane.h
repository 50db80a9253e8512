/* Surfaces and motions in the plane for tests of the force: a wave as a formula and as a map, a rough map, and scenes
 * around them. */
#ifndef PLANE_H
#define PLANE_H
#include "judge.h"
#include "surface/height_map.h"

/* ------------------------------------------------------------------ surfaces */

static struct {
    double amplitude, length, angle, finest; /* m, m, rad; of the wave A cos(k (x cos angle + y sin angle)) */
} plane_wave;

static inline void plane_wave_add(struct relief_part *part, const struct relief_points *p,
                                  const struct relief_values *v)
{
    double k = 2 * M_PI / plane_wave.length, kx = k * cos(plane_wave.angle), ky = k * sin(plane_wave.angle);
    (void)part;
    for (size_t i = 0; i < p->n; i++) {
        double phase = kx * p->x[i] + (p->y ? ky * p->y[i] : 0), z = plane_wave.amplitude * cos(phase),
               s = -plane_wave.amplitude * sin(phase);
        const double all[6] = {z, kx * s, ky * s, -kx * kx * z, -kx * ky * z, -ky * ky * z};
        double *const to[6] = {v->z, v->x, v->y, v->xx, v->xy, v->yy};
        for (int n = 0; n < 6; n++)
            if (to[n]) to[n][i] += all[n];
    }
}

static inline struct relief_part *plane_wave_part(struct arena *a, const struct contact *c)
{
    struct relief_part *part = ARENA_TAKE(a, struct relief_part, 1);
    (void)c;
    *part = (struct relief_part){.name = "wave",
                                 .finest = plane_wave.finest,
                                 .from = {-HUGE_VAL, -HUGE_VAL},
                                 .to = {HUGE_VAL, HUGE_VAL},
                                 .add = plane_wave_add};
    return part;
}

enum { PLANE_SIDE = 800 };

/* The wave as samples, 200 of them a wave: 4 waves each way, mirrored beyond (a motion must stay inside). */
static inline struct relief_part *plane_wave_map(struct arena *a, const struct contact *c)
{
    double *z = ARENA_TAKE(a, double, PLANE_SIDE *PLANE_SIDE), pitch = plane_wave.length / 200,
           k = 2 * M_PI / plane_wave.length;
    (void)c;
    for (int j = 0; j < PLANE_SIDE; j++)
        for (int i = 0; i < PLANE_SIDE; i++)
            z[j * PLANE_SIDE + i] =
                plane_wave.amplitude * cos(k * pitch * (i * cos(plane_wave.angle) + j * sin(plane_wave.angle)));
    return height_map_part(
        a, height_map_spline(a, &(struct height_map){z, PLANE_SIDE, PLANE_SIDE, {pitch, pitch}}, OFF_MAP_MIRROR),
        (double[]){0, 0}, "wave");
}

/* 200 x 160 samples 5 um x 7 um apart, wrapped: 60 waves of 50 um and more, of random direction, each of 0.2 um. */
static inline struct relief_part *plane_rough_map(struct arena *a, const struct contact *c)
{
    enum { COLUMNS = 200, ROWS = 160 };
    (void)c;
    double *z = ARENA_TAKE(a, double, COLUMNS *ROWS);
    srand48(11);
    for (int w = 0; w < 60; w++) {
        int kx = (int)(41 * drand48()) - 20, ky = (int)(45 * drand48()) - 22;
        double phase = 2 * M_PI * drand48();
        for (int j = 0; j < ROWS; j++)
            for (int i = 0; i < COLUMNS; i++)
                z[j * COLUMNS + i] +=
                    0.2e-6 * cos(2 * M_PI * ((double)(kx * i) / COLUMNS + (double)(ky * j) / ROWS) + phase);
    }
    return height_map_part(a, height_map_spline(a, &(struct height_map){z, COLUMNS, ROWS, {5e-6, 7e-6}}, OFF_MAP_WRAP),
                           (double[]){0, 0}, "rough");
}

/* ------------------------------------------------------------------ scenes */

#define PLANE_HEAD                                                                                                     \
    "rasp: 1\n"                                                                                                        \
    "seed: 5\n"                                                                                                        \
    "output: {diagnostics: {}, sample_rate: 48000}\n"                                                                  \
    "load: {approach: 0, release: 0}\n"                                                                                \
    "scraper: {mass: 20 g}\n"                                                                                          \
    "surface: {roughness: {}, along: plane}\n"

/* The contact and motion are texts; the surface is the test's. */
static inline struct scene plane_scene(struct relief_part *(*relief)(struct arena *, const struct contact *),
                                       const char *rest)
{
    rig_relief = relief;
    return rig_scene(rig_arena(), arena_format(rig_arena(), "%s%s", PLANE_HEAD, rest));
}

#endif
