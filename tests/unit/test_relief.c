/* relief: sums of parts, and what decides how a surface lies under the motion. */
#include "surface/relief.h"

#include "pipeline/stages.h"
#include "scene/params.h"
#include "surface/height_map.h"
#include "surface/profile.h"
#include "surface/roughness.h"
#include "trajectory/motion.h"
#include "unit.h"

enum { POINTS = 50, SIDE = 12 };

static const double pitch[2] = {3e-6, 5e-6}, origin[2] = {-1e-6, 2e-6};

/* z = size (x^2 + 3 x y + y^3), added to what is there. */
static void cubic_add(struct relief_part *part, const struct relief_points *p, const struct relief_values *v)
{
    double size = *(double *)part->state;
    for (size_t i = 0; i < p->n; i++) {
        double x = p->x[i], y = p->y ? p->y[i] : 0;
        if (v->z) v->z[i] += size * (x * x + 3 * x * y + y * y * y);
        if (v->x) v->x[i] += size * (2 * x + 3 * y);
        if (v->y) v->y[i] += size * (3 * x + 3 * y * y);
        if (v->xx) v->xx[i] += size * 2;
        if (v->xy) v->xy[i] += size * 3;
        if (v->yy) v->yy[i] += size * 6 * y;
    }
}

static struct relief_part *cubic(struct arena *a, double size, double knots, double finest)
{
    struct relief_part *part = ARENA_TAKE(a, struct relief_part, 1);
    double *state = ARENA_TAKE(a, double, 1);
    *state = size;
    *part =
        (struct relief_part){.name = "cubic", .pitch = {knots, 0}, .finest = finest, .add = cubic_add, .state = state};
    return part;
}

static struct relief_part *random_map(struct arena *a)
{
    double z[SIDE * SIDE];
    for (int i = 0; i < SIDE * SIDE; i++)
        z[i] = 1e-6 * (drand48() - 0.5);
    return height_map_part(
        a, height_map_spline(a, &(struct height_map){z, SIDE, SIDE, {pitch[0], pitch[1]}}, OFF_MAP_WRAP), origin,
        "map");
}

/* Each value is the sum of the parts' own, in the order in which they were added; what was in the arrays before is
   gone; what is not asked for is not touched, and changes nothing of the rest. */
START_TEST(parts_are_summed)
{
    struct arena *a = arena_open();
    double x[POINTS], y[POINTS], one[3][6][POINTS], sum[6][POINTS], some[6][POINTS];
    srand48(1);
    for (int i = 0; i < POINTS; i++) {
        x[i] = 2e-4 * (drand48() - 0.5);
        y[i] = 2e-4 * (drand48() - 0.5);
    }
    struct relief_part *parts[3] = {cubic(a, 0.7, 0, 1), random_map(a), cubic(a, -3, 0, 1)};
    struct relief_points p = {POINTS, x, y};
    memset(one, 0, sizeof one);
    memset(sum, 0x55, sizeof sum);
    for (int k = 0; k < 3; k++)
        parts[k]->add(parts[k], &p,
                      &(struct relief_values){one[k][0], one[k][1], one[k][2], one[k][3], one[k][4], one[k][5]});
    struct relief r = {.along = ALONG_PLANE};
    relief_at(&r, &p, &(struct relief_values){.z = sum[0]});
    for (int i = 0; i < POINTS; i++)
        ck_assert(sum[0][i] == 0); /* of no parts */
    for (int k = 0; k < 3; k++)
        relief_add(&r, parts[k]);
    relief_at(&r, &p, &(struct relief_values){sum[0], sum[1], sum[2], sum[3], sum[4], sum[5]});
    for (int v = 0; v < 6; v++)
        for (int i = 0; i < POINTS; i++)
            ck_assert(sum[v][i] == (one[0][v][i] + one[1][v][i]) + one[2][v][i]);
    for (int v = 0; v < 6; v++) {
        memset(some, 0x55, sizeof some);
        relief_at(&r, &p,
                  &(struct relief_values){v == 0 ? some[0] : NULL, v == 1 ? some[1] : NULL, v == 2 ? some[2] : NULL,
                                          v == 3 ? some[3] : NULL, v == 4 ? some[4] : NULL, v == 5 ? some[5] : NULL});
        ck_assert_mem_eq(some[v], sum[v], sizeof some[v]);
    }
    arena_close(a);
}
END_TEST

START_TEST(finest_of_all)
{
    struct arena *a = arena_open();
    struct relief r = {.along = ALONG_PLANE};
    ck_assert(relief_finest(&r) == HUGE_VAL);
    relief_add(&r, cubic(a, 1, 0, 40e-6));
    ck_assert(relief_finest(&r) == 40e-6);
    relief_add(&r, cubic(a, 1, 20e-6, 80e-6));
    ck_assert(relief_finest(&r) == 20e-6);
    relief_add(&r, random_map(a));
    ck_assert(relief_finest(&r) == 3e-6);
    double z[8] = {0};
    relief_add(&r, profile_part(a, profile_from_samples(a, z, 8, 1e-6, OFF_MAP_WRAP), "profile", 0));
    ck_assert(relief_finest(&r) == 1e-6);
    arena_close(a);
}
END_TEST

/* auto: plane for what has a direction, or under a path that is no straight line; else path. What the scene or a map
 * decided stays. */
START_TEST(settled_along)
{
    static const struct {
        int along, path;
        double grain;
        bool roughness, ridges;
        int want;
    } cases[] = {
        {ALONG_AUTO, PATH_LINE, 1, true, false, ALONG_PATH},
        {ALONG_AUTO, PATH_BACK_AND_FORTH, 1, true, false, ALONG_PATH},
        {ALONG_AUTO, PATH_FOUR_IN_LINE, 1, false, false, ALONG_PATH},
        {ALONG_AUTO, PATH_CIRCLE, 1, true, false, ALONG_PLANE},
        {ALONG_AUTO, PATH_SCRIBBLE, 1, true, false, ALONG_PLANE},
        {ALONG_AUTO, PATH_POLYLINE, 1, true, false, ALONG_PLANE},
        {ALONG_AUTO, PATH_SPLINE, 1, true, false, ALONG_PLANE},
        {ALONG_AUTO, PATH_RECORDED, 1, false, false, ALONG_PLANE},
        {ALONG_AUTO, PATH_LINE, 4, true, false, ALONG_PLANE},
        {ALONG_AUTO, PATH_LINE, 4, false, false, ALONG_PATH},
        {ALONG_AUTO, PATH_LINE, 1, false, true, ALONG_PLANE},
        {ALONG_PATH, PATH_CIRCLE, 4, true, true, ALONG_PATH},
        {ALONG_X, PATH_CIRCLE, 4, true, true, ALONG_X},
        {ALONG_PLANE, PATH_LINE, 1, true, false, ALONG_PLANE},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct relief r = {.along = cases[i].along};
        struct contact c = {.motion = {.path = cases[i].path}};
        struct arena *a = arena_open();
        *(bool *)params_edit(&c, ridges_stage.params, a) = cases[i].ridges;
        *(struct roughness *)params_edit(&c, roughness_stage.params, a) =
            (struct roughness){.given = cases[i].roughness, .grain = cases[i].grain};
        relief_decide(&r, &c);
        ck_assert_msg(r.along == cases[i].want, "case %zu: %d", i, r.along);
        ck_assert(motion_straight(&c.motion) == (cases[i].path <= PATH_FOUR_IN_LINE));
        arena_close(a);
    }
}
END_TEST

UNIT("relief", parts_are_summed, finest_of_all, settled_along)
