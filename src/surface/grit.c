/* Grains on flat ground: a Poisson process in the plane, `density` of them per area, each a smooth bump

     h b(r/R),  b(t) = (1 - t^2)^3 for t < 1        R = v diameter/2, h = v height

   v log-normal with mean 1 and the standard deviation `spread`, v = exp(s n - shift), s^2 = log(1 + spread^2), n
   standard normal but cut at 3 (by Box and Muller's method with a radius of at most 3), so that grains have a largest
   size; the deviation of v is 5 % less for it. Second derivatives are continuous. Grains that overlap add up, so that a
   dense coat is rougher than its grains are high: mean height = density pi/4 E[h R^2], variance of the heights =
   density pi/7 E[h^2 R^2] (Campbell's theorem).

   The plane is cut into cells, each with its own counter (column, row), from which come its number of grains (inverting
   the Poisson distribution), their places and sizes. A cell is at least as wide as the largest grain's R, so that the
   nine cells about a place hold all that reach it; their grains are kept until the place leaves the middle cell. */
#include "surface/grit.h"

#include <limits.h>

#include "base/stopwatch.h"
#include "num/real.h"
#include "scene/rows.h"
#include "stage.h"
#include "surface/relief.h"

#define GRIT_MEAN_MOST 100.0 /* grains of a cell, in the mean */

enum { GRIT_MOST = 4096 }; /* of nine cells: 900 in the mean at most, with a standard deviation of 30 */

struct grain {
    double x, y, h, u; /* m; u = 1/R^2 */
};

/* ------------------------------------------------------------------ parameters */

static const struct key keys[] = {
    {ROW_NUMBER(grit, density, "surface.grit.density"), KEY_PER_AREA, 1, 1e13, "1e7 /m^2", NULL, "grains per area"},
    {ROW_NUMBER(grit, diameter, "surface.grit.diameter"), KEY_LENGTH, 1e-6, 1e-2, "125 um", NULL,
     "mean diameter of a grain"},
    {ROW_NUMBER(grit, height, "surface.grit.height"), KEY_LENGTH, 1e-9, 1e-2, "40 um", NULL,
     "mean height of a grain above the ground"},
    {ROW_NUMBER(grit, spread, "surface.grit.spread"), KEY_NONE, 0, 1, "0.2", NULL,
     "standard deviation of a grain's diameter and height, as a share of the mean"},
    {.path = NULL}};

static double likely_finest(const void *own) { return ((const struct grit *)own)->diameter / 8; }

static double likely_span(const void *own)
{
    const struct grit *g = own;
    return g->height * real_exp(4 * g->spread);
}

static const struct params grit_params = {
    .section = "surface.grit",
    .meaning = "scattered grains, as of sandpaper, drawn from the seed",
    .size = sizeof(struct grit),
    .keys = keys,
    .ground = &(const struct params_ground){.finest = likely_finest, .span = likely_span},
};

static const struct grit *grit_of(const struct contact *c) { return params_of(c, &grit_params); }

/* ------------------------------------------------------------------ their heights */

struct grit_state {
    struct noise stream;
    struct grit recipe;
    double sigma, shift; /* log v = sigma n - shift */
    double cell, mean;   /* m; grains of one */
    long column, row;    /* middle cell of what is kept; column LONG_MIN: nothing */
    int n;
    struct grain *grains; /* [GRIT_MOST] */
};

/* Standard normal within 3 standard deviations: Box and Muller's with the radius at most 3. */
static double normal_of(double u, double turns)
{
    double least = 0.011108996538242306; /* exp(-3^2/2) */
    return sqrt(-2 * real_log(least + (1 - least) * u)) * real_cospi(2 * turns);
}

static double uniform_of(uint64_t bits) { return (double)(bits >> 11 | 1) * 0x1p-53; }

/* Number of grains of a cell: the n at which the distribution function passes u. */
static int poisson_of(double mean, double u)
{
    double term = real_exp(-mean), sum = term;
    int n = 0;
    while (sum < u && n < GRIT_MOST / 9) {
        term *= mean / ++n;
        sum += term;
    }
    return n;
}

static void cell_add(struct grit_state *s, long column, long row)
{
    uint64_t bits[2];
    struct noise own;
    noise_bits(s->stream, (uint64_t)column, (uint64_t)row, bits);
    own.key = bits[0];
    for (int i = 0, n = poisson_of(s->mean, uniform_of(bits[1])); i < n; i++) {
        uint64_t place[2], size[2];
        noise_bits(own, (uint64_t)i, 0, place);
        noise_bits(own, (uint64_t)i, 1, size);
        double v = real_exp(s->sigma * normal_of(uniform_of(size[0]), uniform_of(size[1])) - s->shift),
               radius = 0.5 * v * s->recipe.diameter;
        s->grains[s->n++] =
            (struct grain){((double)column + uniform_of(place[0])) * s->cell,
                           ((double)row + uniform_of(place[1])) * s->cell, v * s->recipe.height, 1 / (radius * radius)};
    }
}

static void cells_hold(struct grit_state *s, long column, long row)
{
    if (s->column == column && s->row == row) return;
    s->column = column;
    s->row = row;
    s->n = 0;
    for (long j = row - 1; j <= row + 1; j++)
        for (long i = column - 1; i <= column + 1; i++)
            cell_add(s, i, j);
    stopwatch_spend(9 * 60 + 200.0 * s->n);
}

/* z = h w^3, w = 1 - r^2/R^2. */
static void grain_add(const struct grain *g, double dx, double dy, double w, double out[6])
{
    double slope = -6 * g->h * g->u * w * w, bend = 24 * g->h * g->u * g->u * w;
    out[0] += g->h * w * w * w;
    out[1] += slope * dx;
    out[2] += slope * dy;
    out[3] += slope + bend * dx * dx;
    out[4] += bend * dx * dy;
    out[5] += slope + bend * dy * dy;
}

static void grit_add(struct relief_part *part, const struct relief_points *p, const struct relief_values *v)
{
    struct grit_state *s = part->state;
    double *values[6] = {v->z, v->x, v->y, v->xx, v->xy, v->yy};
    for (size_t i = 0; i < p->n; i++) {
        double x = p->x[i], y = p->y ? p->y[i] : 0, out[6] = {0};
        cells_hold(s, (long)floor(x / s->cell), (long)floor(y / s->cell));
        for (int g = 0; g < s->n; g++) {
            const struct grain *one = &s->grains[g];
            double dx = x - one->x, dy = y - one->y, w = 1 - (dx * dx + dy * dy) * one->u;
            if (w > 0) grain_add(one, dx, dy, w, out);
        }
        for (int k = 0; k < 6; k++)
            if (values[k]) values[k][i] += out[k];
    }
}

static double sigma_of(const struct grit *g) { return sqrt(real_log1p(g->spread * g->spread)); }

/* E[exp(t n)] of n as normal_of draws it: over radii by the midpoint rule, over turns by equal steps. */
static double growth(double t)
{
    enum { RADII = 256, TURNS = 32 };
    double sum = 0, all = 0;
    for (int i = 0; i < RADII; i++)
        for (int j = 0; j < TURNS; j++) {
            double radius = 3 * (i + 0.5) / RADII, weight = radius * real_exp(-0.5 * radius * radius);
            sum += weight * real_exp(t * radius * real_cospi(2.0 * j / TURNS));
            all += weight;
        }
    stopwatch_spend(200.0 * RADII * TURNS);
    return sum / all;
}

void grit_moments(const struct grit *g, double *mean, double *square)
{
    double s = sigma_of(g), r = 0.5 * g->diameter, area = g->density * REAL_PI * r * r, one = growth(s);
    *mean = area / 4 * g->height * growth(3 * s) / (one * one * one);
    *square = area / 7 * g->height * g->height * growth(4 * s) / (one * one * one * one) + *mean * *mean;
}

/* Cycles of a point: the grains of the 9 cells about it. */
static double grit_reading(const struct grit *g)
{
    double reach = 0.5 * g->diameter * real_exp(2.5 * sigma_of(g));
    return 40 + 4 * 9 * fmax(1, g->density * reach * reach);
}

struct relief_part *grit_part(struct arena *a, const struct grit *g, struct noise stream, struct err *e)
{
    struct grit_state *s = ARENA_TAKE(a, struct grit_state, 1);
    double sigma = sigma_of(g), shift = real_log(growth(sigma)),
           reach = 0.5 * g->diameter * real_exp(3 * sigma - shift);
    double cell = fmax(reach, 1 / sqrt(g->density)), mean = g->density * cell * cell;
    if (mean > GRIT_MEAN_MOST) {
        err_set(e, ERR_SCENE,
                "surface.grit: %g grains per m^2 of up to %g m diameter lie %.3g deep over each other; lower density, "
                "diameter or spread",
                g->density, 2 * reach, g->density * reach * reach * REAL_PI);
        return NULL;
    }
    *s = (struct grit_state){.stream = stream,
                             .recipe = *g,
                             .sigma = sigma,
                             .shift = shift,
                             .cell = cell,
                             .mean = mean,
                             .column = LONG_MIN,
                             .grains = ARENA_TAKE(a, struct grain, GRIT_MOST)};
    struct relief_part *part =
        relief_endless(a, "grit", 0.5 * g->diameter * real_exp(-2 * sigma - shift) / 4, grit_add, s);
    part->reading = grit_reading(g);
    return part;
}

/* ------------------------------------------------------------------ the stage */

static double grit_work(const struct contact *c, const struct scene *s)
{
    const struct grit *g = grit_of(c);
    return grit_reading(g) * relief_readings(c, s, 0.5 * g->diameter / 4);
}

static bool grit_open(struct stage_run *r, struct err *e)
{
    struct noise stream = noise_make(r->scene->seed, arena_format(r->arena, "grit/%s", r->contact->name));
    struct relief_part *part = grit_part(r->arena, grit_of(r->contact), stream, e);
    if (!part) return err_at(e, "contact '%s'", r->contact->name);
    relief_decide(r->board->relief, r->contact);
    relief_add(r->board->relief, part);
    return true;
}

const struct stage grit_stage = {
    .name = "grit",
    .does = "scattered grains",
    .paper = "",
    .idle = "no surface.grit",
    .params = &grit_params,
    .needs = ITEM_BIT(ITEM_SURFACE),
    .gives = ITEM_BIT(ITEM_SURFACE),
    .work = grit_work,
    .open = grit_open,
};
