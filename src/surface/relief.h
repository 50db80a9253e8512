/* A surface as a contact meets it: heights z and derivatives, read at batches of points, as the sum of parts (a
   measured map, roughness, ridges ...) that stages add. Every part has continuous second derivatives (C2), but for
   those with kinks.

   Coordinates, by relief->along:
     ALONG_PATH   x is the signed distance u along the motion (0 where it starts); nothing depends on y
     ALONG_X      x is the scene's x; nothing depends on y (extruded)
     ALONG_PLANE  x and y are the scene's                                                                      all in m
   Parts lie in the surface's own coordinates, which begin at relief->origin of the scene (except along the path). */
#ifndef SURFACE_RELIEF_H
#define SURFACE_RELIEF_H
#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "scene/params.h"
#include "trajectory/motion.h"

struct relief_points {
    size_t n;
    const double *x, *y; /* y: NULL unless along is ALONG_PLANE */
};

struct relief_values {    /* [n] each; NULL: not asked for. y, xy, yy: NULL unless along is ALONG_PLANE */
    double *z;            /* m   */
    double *x, *y;        /* dz/dx, dz/dy */
    double *xx, *xy, *yy; /* 1/m */
};

struct relief_part {
    const char *name;
    double pitch[2], origin[2]; /* m: third derivatives may jump at origin + i pitch (knots); pitch 0: nowhere */
    bool linear;                /* z'' is a straight line between knots (a cubic spline of one coordinate)           */
    double finest;              /* m: second derivatives do not vary on scales much shorter than this                */
    double kinks; /* m: z itself may have kinks or steps at its multiples; 0: C2. Read by its heights, under a tip,
                     alone */
    double from[2], to[2]; /* m: where the part is given; -HUGE_VAL, HUGE_VAL: everywhere                     */
    void (*add)(struct relief_part *, const struct relief_points *,
                const struct relief_values *); /* adds its values to those there */
    void (*close)(struct relief_part *);       /* may be NULL */
    double reading;                            /* predicted cycles of a point that is read */
    void *state;
    struct relief_part *next;
};

struct relief {
    int along;        /* enum along; ALONG_AUTO until a part or relief_decide decides */
    double origin[2]; /* m, surface.origin: where the surface's own x = y = 0 lies in the scene; not along a path */
    struct relief_part *first;
    const struct relief *under; /* what a round tip goes over, if first is its way; NULL: no tip */
};

/* Adds a part, behind those there. */
void relief_add(struct relief *, struct relief_part *);

/* A part that is given everywhere, without knots. */
struct relief_part *relief_endless(struct arena *, const char *name, double finest,
                                   void (*add)(struct relief_part *, const struct relief_points *,
                                               const struct relief_values *),
                                   void *state);

/* Closes the part that is a stage's state. */
struct stage_run;
void relief_close(struct stage_run *);

/* What is subtracted from the scene's coordinate to get the surface's: origin[axis], or 0 where the surface does not
 * follow it. */
double relief_shift(const struct relief *, int axis);

/* All asked-for values, set to the sum of the parts. The points are in the scene's coordinates (along a path: u). */
void relief_at(const struct relief *, const struct relief_points *, const struct relief_values *);

/* Decides along where the scene left it auto and no map did: relief_along. */
void relief_decide(struct relief *, const struct contact *);

/* The finest scale (m) and the smallest pitch of all parts; HUGE_VAL: none. */
double relief_finest(const struct relief *);

/* The smallest `kinks` there is; 0: none. */
double relief_kinks(const struct relief *);

/* ------------------------------------------------------------------ what the scene tells */

/* Does a round tip or a ball go over the surface, not a point? */
static inline bool relief_tipped(const struct contact *c) { return !isnan(c->scraper.radius) && !c->ball.point; }

/* Is no place of the surface come back to? A round tip keeps the heights that it has read. */
static inline bool relief_once(const struct contact *c)
{
    return relief_tipped(c) || (motion_straight(&c->motion) && c->motion.path != PATH_BACK_AND_FORTH);
}

/* Which coordinates the surface follows (enum along); ALONG_AUTO where only a height map's number of rows will tell. */
static inline int relief_along(const struct contact *c)
{
    const struct surface *s = &c->surface;
    int directed = params_directed(c);
    if (s->along != ALONG_AUTO || directed < 0) return s->along;
    return directed || !motion_straight(&c->motion) ? ALONG_PLANE : ALONG_PATH;
}

/* May the surface turn out to lie in the plane? */
static inline bool relief_plane(const struct contact *c)
{
    return relief_along(c) == ALONG_PLANE || relief_along(c) == ALONG_AUTO;
}

/* ------------------------------------------------------------------ how often a surface is read, for predicted work */

#define RELIEF_MAP_PITCH 5e-6 /* m, of a map whose file says it */
#define RELIEF_MAP_SPAN 20e-6 /* m between greatest and least height, of any map */

/* Points per audio sample: both ends and the middle of each sub-interval, and of each cell crossed. */
static inline double relief_readings(const struct contact *c, const struct scene *s, double finest)
{
    return 2 * (s->accuracy.oversampling + motion_speed(&c->motion) / (s->output.sample_rate * finest));
}

#endif
