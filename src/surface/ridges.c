/* Parallel ridges across the coordinate q (m), which is the line's own, or in the plane, the ridges running in the
   direction d, q = x sin d - y cos d.

   Ridge i has its own place, (i + j_i) spacing, and height, h_i = height v_i, from the counter i: j_i is uniform with
   the standard deviation `jitter` (at most 1.73 of it), v_i log-normal with mean 1 and standard deviation `variation`.

     round    z = sum over i of h_i b((q - place_i)/R),  b(t) = (1 - t^2)^3 for |t| < 1,  R = width/(2 sqrt(1 -
              2^(-1/3))): `width` at half height
     groove   the same, downwards
     sine     z = h(p)/2 cos(2 pi (p - j(p))),  p = q/spacing,  h and j going from ridge to ridge by the step t^3 (10 -
              15 t + 6 t^2)

   All have continuous second derivatives. Ridges that overlap add up. A sine's ridges are where they should be as far
   as the step is flat: within 0.1 j_i at j_i = 0.2; beyond a jitter of 0.15 two of them may melt into one. */
#include "surface/ridges.h"

#include <limits.h>

#include "num/real.h"
#include "scene/rows.h"
#include "stage.h"
#include "surface/relief.h"

enum { RIDGES_CACHED = 16 };

/* ------------------------------------------------------------------ parameters */

static const struct choice shapes[] = {[RIDGE_SINE] = {"sine", "a sine wave"},
                                       [RIDGE_ROUND] = {"round", "separate round ridges on a flat ground"},
                                       [RIDGE_GROOVE] = {"groove", "separate round grooves in a flat ground"},
                                       {NULL, NULL}};

static const struct key keys[] = {
    {ROW_NUMBER(ridges, spacing, "surface.ridges.spacing"), KEY_LENGTH, 1e-6, 0.1, "1 mm", NULL,
     "distance from ridge to ridge"},
    {ROW_NUMBER(ridges, height, "surface.ridges.height"), KEY_LENGTH, 1e-9, 1e-2, "20 um", NULL,
     "height from valley to top"},
    {ROW_CHOICE(ridges, shape, "surface.ridges.shape"), KEY_NONE, 0, 0, "sine", NULL, "shape across the ridges",
     shapes},
    {ROW_NUMBER(ridges, width, "surface.ridges.width"), KEY_LENGTH, 1e-6, 0.1, "0.3 mm",
     "surface.ridges.shape=round|groove", "width of a ridge or groove at half its height"},
    {ROW_NUMBER(ridges, direction, "surface.ridges.direction"), KEY_ANGLE, -6.2832, 6.2832, "90 deg", NULL,
     "direction in which the ridges run, 0 is +x; along a path they lie across it"},
    {ROW_NUMBER(ridges, jitter, "surface.ridges.jitter"), KEY_NONE, 0, 0.3, "0", NULL,
     "standard deviation of a ridge's place, as a share of the spacing"},
    {ROW_NUMBER(ridges, variation, "surface.ridges.variation"), KEY_NONE, 0, 1, "0", NULL,
     "standard deviation of a ridge's height, as a share of the height"},
    {.path = NULL}};

static const struct params_rule rules[] = {
    {"surface.ridges.width", 0.9, "surface.ridges.spacing", "lower width, or raise spacing"}, {.path = NULL}};

static int directed(const void *own)
{
    (void)own;
    return 1;
}

static double likely_finest(const void *own) { return ((const struct ridges *)own)->spacing / 8; }

static double likely_span(const void *own)
{
    const struct ridges *r = own;
    return r->height * (1 + 4 * r->variation);
}

static const struct params ridges_params = {
    .section = "surface.ridges",
    .meaning = "parallel ridges or grooves",
    .size = sizeof(struct ridges),
    .keys = keys,
    .rules = rules,
    .ground = &(const struct params_ground){.directed = directed, .finest = likely_finest, .span = likely_span},
};

static const struct ridges *ridges_of(const struct contact *c) { return params_of(c, &ridges_params); }

/* ------------------------------------------------------------------ their heights */

struct ridge {
    long i;
    bool known;
    double place, height; /* spacings from its own; m */
};

struct ridges_state {
    struct ridges recipe;
    struct noise stream;
    double ex, ey;        /* q = ex x + ey y */
    double radius, sigma; /* R; of the logarithm of v */
    struct ridge cached[RIDGES_CACHED];
};

static const struct ridge *ridge_at(struct ridges_state *s, long i)
{
    struct ridge *r = &s->cached[i & (RIDGES_CACHED - 1)];
    if (!r->known || r->i != i) {
        double normal = 0, even = noise_uniform(s->stream, (uint64_t)i, UINT64_MAX) - 0.5;
        if (s->sigma > 0) noise_normal(s->stream, (uint64_t)i, 1, &normal);
        *r = (struct ridge){i, true, s->recipe.jitter * sqrt(12) * even,
                            s->recipe.height * real_exp(s->sigma * normal - 0.5 * s->sigma * s->sigma)};
    }
    return r;
}

struct jet { /* z, dz/dq, d2z/dq2 */
    double z, d, dd;
};

static struct jet sine_at(struct ridges_state *s, double q)
{
    double l = s->recipe.spacing, p = q / l, i = floor(p), t = p - i, w = 2 * REAL_PI;
    struct ridge a = *ridge_at(s, (long)i), b = *ridge_at(s, (long)i + 1);
    double step = t * t * t * (10 - t * (15 - 6 * t)), step1 = 30 * t * t * (1 - t) * (1 - t),
           step2 = 60 * t * (1 - t) * (1 - 2 * t);
    double rise = 0.5 * (b.height - a.height), move = b.place - a.place, h = 0.5 * a.height + rise * step;
    double turns = t - a.place - move * step, c = real_cospi(2 * turns),
           n = -real_sinpi(2 * turns); /* cos has period 1 in p */
    double f1 = w * (1 - move * step1), f2 = -w * move * step2, h1 = rise * step1, h2 = rise * step2;
    return (struct jet){h * c, (h1 * c + h * n * f1) / l,
                        (h2 * c + 2 * h1 * n * f1 + h * (n * f2 - c * f1 * f1)) / (l * l)};
}

/* The jitter is at most 0.52 spacings. */
static struct jet bumps_at(struct ridges_state *s, double q)
{
    double l = s->recipe.spacing, sign = s->recipe.shape == RIDGE_GROOVE ? -1 : 1,
           far = s->radius / l + sqrt(3) * s->recipe.jitter;
    struct jet sum = {0, 0, 0};
    for (long i = (long)ceil(q / l - far); (double)i <= q / l + far; i++) {
        const struct ridge *r = ridge_at(s, i);
        double t = (q - ((double)i + r->place) * l) / s->radius, u = 1 - t * t, h = sign * r->height;
        if (u <= 0) continue;
        sum.z += h * u * u * u;
        sum.d += h * -6 * t * u * u / s->radius;
        sum.dd += h * 6 * u * (5 * t * t - 1) / (s->radius * s->radius);
    }
    return sum;
}

static void ridges_add(struct relief_part *part, const struct relief_points *p, const struct relief_values *v)
{
    struct ridges_state *s = part->state;
    double *out[6] = {v->z, v->x, v->y, v->xx, v->xy, v->yy};
    double factor[6] = {1, s->ex, s->ey, s->ex * s->ex, s->ex * s->ey, s->ey * s->ey};
    for (size_t i = 0; i < p->n; i++) {
        double q = s->ex * p->x[i] + (p->y ? s->ey * p->y[i] : 0);
        struct jet j = s->recipe.shape == RIDGE_SINE ? sine_at(s, q) : bumps_at(s, q);
        for (int k = 0; k < 6; k++)
            if (out[k]) out[k][i] += factor[k] * (k == 0 ? j.z : k < 3 ? j.d : j.dd);
    }
}

struct relief_part *ridges_part(struct arena *a, const struct ridges *recipe, int along, struct noise stream)
{
    struct ridges_state *s = ARENA_TAKE(a, struct ridges_state, 1);
    double v = recipe->variation, half = sqrt(1 - real_pow(2, -1.0 / 3));
    *s = (struct ridges_state){.recipe = *recipe,
                               .stream = stream,
                               .ex = 1,
                               .sigma = sqrt(real_log1p(v * v)),
                               .radius = 0.5 * recipe->width / half};
    if (along == ALONG_PLANE) {
        s->ex = real_sin(recipe->direction);
        s->ey = -real_cos(recipe->direction);
    }
    double finest = recipe->shape == RIDGE_SINE ? recipe->spacing / 8 : s->radius / 4;
    struct relief_part *part = relief_endless(a, "ridges", finest, ridges_add, s);
    part->reading = 90;
    return part;
}

/* ------------------------------------------------------------------ the stage */

static double ridges_work(const struct contact *c, const struct scene *s)
{
    return 90 * relief_readings(c, s, ridges_of(c)->spacing / 8);
}

static bool ridges_open(struct stage_run *r, struct err *e)
{
    const struct ridges *recipe = ridges_of(r->contact);
    struct noise stream = noise_make(r->scene->seed, arena_format(r->arena, "ridges/%s", r->contact->name));
    if (recipe->shape != RIDGE_SINE && recipe->width > 20 * recipe->spacing)
        return err_set(
            e, ERR_SCENE,
            "contact '%s': surface.ridges: a width of %g m at a spacing of %g m leaves no ridges; lower the width",
            r->contact->name, recipe->width, recipe->spacing);
    relief_decide(r->board->relief, r->contact);
    relief_add(r->board->relief, ridges_part(r->arena, recipe, r->board->relief->along, stream));
    return true;
}

const struct stage ridges_stage = {
    .name = "ridges",
    .does = "parallel ridges",
    .paper = "",
    .idle = "no surface.ridges",
    .params = &ridges_params,
    .needs = ITEM_BIT(ITEM_SURFACE),
    .gives = ITEM_BIT(ITEM_SURFACE),
    .work = ridges_work,
    .open = ridges_open,
};
