/* path_cells: the cells of straight, turning and curved motions against the geometry they must keep: they tile what is
   travelled, lie on the path, and cross no line of knots; what is said of each (halves, bulges, directions, slopes)
   against the surface read directly. */
#include "force/path_cells.h"

#include "pipeline/stages.h"
#include "scene/params.h"
#include "surface/height_map.h"
#include "surface/limiter.h"
#include "surface/profile.h"
#include "trajectory/trajectory.h"
#include "unit.h"

enum { MOST = 120000, FRAMES = 600 };

static struct {
    int n, interval[MOST], heading[MOST], flushes;
    double length[MOST], ends[MOST][2][2], e[MOST][2][2], c[MOST][2][2], sagitta[MOST][2], alpha[MOST][2],
        slope[MOST][2], bend[MOST][2], mean[MOST];
} all;

static int first_interval;

static void gather(void *self, const struct cells *p)
{
    (void)self;
    all.flushes++;
    for (int i = 0; i < p->n; i++, all.n++) {
        ck_assert_int_lt(all.n, MOST);
        ck_assert(p->n <= LIMITER_CELLS && p->points <= LIMITER_POINTS && p->at[i] >= 0 && p->at[i] + 1 < p->points);
        all.interval[all.n] = first_interval + p->interval[i];
        all.heading[all.n] = p->heading[i];
        all.length[all.n] = p->length[i];
        all.mean[all.n] = p->mean[0][i];
        for (int k = 0; k < 2; k++) {
            int at = p->at[i] + k;
            all.ends[all.n][k][0] = p->x[at], all.ends[all.n][k][1] = p->y[at];
            all.e[all.n][k][0] = p->ex[at], all.e[all.n][k][1] = p->ey[at];
            all.c[all.n][k][0] = p->curvature[0][at], all.c[all.n][k][1] = p->curvature[1][at];
            all.sagitta[all.n][k] = p->sagitta[k][i], all.alpha[all.n][k] = p->alpha[k][p->at[i]];
            all.slope[all.n][k] = p->slope[at], all.bend[all.n][k] = p->bend[at];
        }
    }
}

/* ------------------------------------------------------------------ a board by hand */

static struct arena *arena;
static struct contact contact;
static struct trajectory motion;
static struct relief relief;
static struct board board;
static struct stage_run run;
static struct path_cells path;

static void prepare(const struct motion *m, double rate, int over)
{
    static const enum item items[6] = {ITEM_POSITION, ITEM_VELOCITY, ITEM_X, ITEM_Y, ITEM_VX, ITEM_VY};
    struct err e = {0};
    size_t n = (size_t)((FRAMES + 1) * over);
    double *t = ARENA_TAKE(arena, double, n), *x[6];
    contact = (struct contact){.motion = *m}; // parameters of an arena that is closed are forgotten
    *(struct limiter *)params_edit(&contact, limiter_stage.params, arena) =
        (struct limiter){.alpha = 0.03, .ratio_y = 0.5, .force_range = {NAN, NAN}};
    contact.load.constant = 1;
    ck_assert_msg(trajectory_make(m, 7, arena, &motion, &e), "%s", e.text);
    board = (struct board){.rate = rate, .over = over, .trajectory = &motion, .relief = &relief};
    for (size_t i = 0; i < n; i++)
        t[i] = (double)i / (rate * over);
    for (int k = 0; k < 6; k++) {
        x[k] = ARENA_TAKE(arena, double, n);
        board.signals[items[k]] = (struct signal){over, 0, FRAMES + 1, 0, x[k]};
    }
    trajectory_at(&motion, n, t,
                  (struct trajectory_out){.u = x[0], .du = x[1], .x = x[2], .y = x[3], .vx = x[4], .vy = x[5]});
    run = (struct stage_run){.contact = &contact, .board = &board, .arena = arena};
}

/* All cells of `n` sub-intervals, in chunks of at most `some`. */
static void travel(enum cells_kind kind, double longest, int n, int some)
{
    struct err e = {0};
    memset(&path, 0, sizeof path);
    ck_assert_msg(path_cells_make(&path, &run, kind, longest, &e), "%s", e.text);
    path.integrate = gather;
    all.n = all.flushes = 0;
    for (first_interval = 0; first_interval < n; first_interval += some)
        path_cells_run(&path, &run, first_interval, n - first_interval < some ? n - first_interval : some);
}

static const double pitch[2] = {3e-6, 5e-6}, origin[2] = {-1.3e-6, 2.1e-6};

static struct relief_part *random_map(const double p[2], const double o[2])
{
    static double z[40 * 50];
    for (int i = 0; i < 40 * 50; i++)
        z[i] = 1e-7 * drand48();
    return height_map_part(arena, height_map_spline(arena, &(struct height_map){z, 50, 40, {p[0], p[1]}}, OFF_MAP_WRAP),
                           o, "map");
}

static void surface_plane(int maps)
{
    static const double other[2] = {4.1e-6, 4.7e-6}, there[2] = {1e-3, -2e-3};
    relief = (struct relief){.along = ALONG_PLANE};
    relief_add(&relief, random_map(pitch, origin));
    if (maps > 1) relief_add(&relief, random_map(other, there));
}

static void surface_profile(int along)
{
    static double z[300];
    for (int i = 0; i < 300; i++)
        z[i] = 1e-7 * drand48();
    relief = (struct relief){.along = along};
    relief_add(&relief, profile_part(arena, profile_from_samples(arena, z, 300, pitch[0], OFF_MAP_MIRROR), "profile",
                                     origin[0]));
}

/* ------------------------------------------------------------------ checks */

static double u_at(double t)
{
    double u;
    trajectory_at(&motion, 1, &t, (struct trajectory_out){.u = &u});
    return u;
}

/* Lengths add up to what is travelled in each sub-interval; points are chained. slip: m, by which neighbours' common
 * points may differ. */
static void check_tiling(int n, double slip)
{
    double dt = 1 / (board.rate * board.over), here = 0;
    int i = 0;
    for (int k = 0; k < n; k++) {
        double turn = trajectory_turning(&motion, k * dt, (k + 1) * dt), u0 = u_at(k * dt), u1 = u_at((k + 1) * dt);
        double want = isnan(turn) ? fabs(u1 - u0) : fabs(u_at(turn) - u0) + fabs(u1 - u_at(turn)), sum = 0;
        for (; i < all.n && all.interval[i] == k; i++) {
            ck_assert_double_gt(all.length[i], 0);
            ck_assert_double_le(all.length[i], path.longest * (1 + 1e-9));
            sum += all.length[i];
            here += all.heading[i] * all.length[i];
            for (int axis = 0; axis < 2 && i > 0; axis++)
                ck_assert_double_eq_tol(all.ends[i][0][axis], all.ends[i - 1][1][axis], slip);
        }
        ck_assert_double_eq_tol(sum, want, 1e-12 * want + 1e-17);
        ck_assert_double_eq_tol(here, u1, 1e-12 * fabs(u1) + 1e-16);
    }
    ck_assert_int_eq(i, all.n);
}

/* No piece goes beyond a line of knots by more than `slack` of a pitch; most end at one. */
static void check_knots(double slack)
{
    int met = 0;
    for (int i = 0; i < all.n; i++)
        for (int g = 0; g < path.n_knots; g++) {
            double a = (all.ends[i][0][path.knots[g].axis] - path.knots[g].origin) / path.knots[g].pitch;
            double b = (all.ends[i][1][path.knots[g].axis] - path.knots[g].origin) / path.knots[g].pitch;
            double low = fmin(a, b), high = fmax(a, b), knot = rint(0.5 * (low + high));
            ck_assert_msg(fmin(knot - low, high - knot) < slack, "piece %d from knot %.9g to %.9g", i, a, b);
            met += fabs(b - rint(b)) < 1e-9;
        }
    ck_assert_int_gt(met, all.n / 50);
}

/* The limits that path_cells_make sets itself, and the pairs of cells that rim: against the surface at the points. */
static void check_pairs(void)
{
    for (int i = 0; i < all.n; i += 2) {
        double h[3][2], size = 0;
        ck_assert(all.interval[i] == all.interval[i + 1] && all.length[i] == all.length[i + 1]);
        for (int k = 0; k < 3; k++) {
            const double *at = all.ends[i + k / 2][k > 0 ? 1 : 0], *e = all.e[i + k / 2][k > 0 ? 1 : 0];
            double xx, xy, yy, ex = e[0], ey = e[1];
            relief_at(&relief, &(struct relief_points){1, &at[0], &at[1]},
                      &(struct relief_values){.xx = &xx, .xy = &xy, .yy = &yy});
            h[k][0] = ex * ex * xx + 2 * ex * ey * xy + ey * ey * yy;
            h[k][1] = -ex * ey * xx + (ex * ex - ey * ey) * xy + ex * ey * yy;
            size = fmax(size, fabs(xx) + fabs(xy) + fabs(yy));
        }
        for (int channel = 0; channel < path.channels; channel++)
            for (int half = 0; half < 2; half++) {
                ck_assert_double_eq_tol(all.c[i + half][0][channel], h[half][channel], 1e-14 * size);
                ck_assert_double_eq_tol(all.c[i + half][1][channel], h[half + 1][channel], 1e-14 * size);
                ck_assert_double_eq_tol(all.sagitta[i + half][channel],
                                        (h[1][channel] - (h[0][channel] + h[2][channel]) / 2) / 4, 1e-14 * size);
            }
    }
}

/* ------------------------------------------------------------------ straight */

/* A profile along the path, along x at an angle, a map at angles: far too, several grids, knots far apart and close. */
START_TEST(straight_paths)
{
    static const double to[][2] = {{2e-3, 0}, {-1e-3, 1.5e-3}, {0, 1e-3}, {1e-3, 1e-3}, {3e-4, -2e-3}, {-1e-3, -1e-9}};
    for (int k = 0; k < 30; k++) {
        double far = k % 5 == 4 ? 3 : 0, *place = (double[]){far + 1e-3, far - 1e-3};
        struct motion m = {.path = PATH_LINE,
                           .from = {place[0], place[1]},
                           .to = {place[0] + to[k % 6][0], place[1] + to[k % 6][1]},
                           .speed = NAN,
                           .duration = 0.01};
        arena = arena_open();
        srand48(k);
        if (k < 12)
            surface_profile(k % 2 ? ALONG_PATH : ALONG_X);
        else
            surface_plane(1 + k % 2);
        prepare(&m, 48000, 1 + k % 4);
        travel(CELLS_ALONG, k % 3 ? 1e-6 : 1e-3, 480 * board.over, CELLS_CHUNK);
        ck_assert(path.halves == (k >= 12) && path.n_knots == (k < 12 ? 1 : 2 + 2 * (k % 2)) && path.channels == 1 &&
                  !path.curved);
        check_tiling(480 * board.over, 1e-16 + 1e-15 * far);
        if (k >= 12) {
            check_knots(2e-7);
            check_pairs();
        } else if (path.e[0] != 0) {
            check_knots(2e-7);
        }
        arena_close(arena);
    }
}
END_TEST

/* Back and forth, turning in the middle of a sub-interval: way and heading on either side. */
START_TEST(turning_paths)
{
    for (int plane = 0; plane < 2; plane++) {
        struct motion m = {.path = PATH_BACK_AND_FORTH, .to = {3e-3, plane * 1e-3}, .rate = 97, .duration = 0.05};
        arena = arena_open();
        srand48(plane);
        if (plane)
            surface_plane(1);
        else
            surface_profile(ALONG_PATH);
        prepare(&m, 8000, 1);
        travel(CELLS_ALONG, 1e-3, 399, CELLS_CHUNK);
        check_tiling(399, 1e-16);
        check_knots(2e-7);
        int turns = 0;
        for (int i = 1; i < all.n; i++)
            turns += all.heading[i] != all.heading[i - 1] && all.interval[i] == all.interval[i - 1];
        ck_assert_int_ge(turns, 8);
        arena_close(arena);
    }
}
END_TEST

/* ------------------------------------------------------------------ curved */

/* Circles of a tenth of a millimetre to a metre, from each quadrant's border, either way round: on the circle, tangent,
   and cut at knots. Where a circle touches a line of knots between two places, a piece goes over it by h^2 / (8
   radius). */
START_TEST(circles)
{
    static const double radii[] = {1e-4, 1e-3, 1e-2, 1};
    for (int k = 0; k < 32; k += 1 + k % 2) {
        double radius = radii[k / 8], step = 0.2 / 96000;
        struct motion m = {.path = PATH_CIRCLE,
                           .radius = radius,
                           .center = {0.3e-3, -0.2e-3},
                           .start_angle = (k % 4) * M_PI / 2 - 1e-2 * (k % 3),
                           .turns = k % 8 < 4 ? 1 : -1,
                           .speed = 0.2,
                           .duration = NAN};
        arena = arena_open();
        srand48(k);
        surface_plane(1);
        prepare(&m, 48000, 2);
        int n = (int)fmin(500, floor(motion.duration * 96000));
        travel(CELLS_ALONG, 1e-3, n, CELLS_CHUNK);
        ck_assert(path.halves && path.curved && path.channels == 2);
        check_tiling(n, 1e-15);
        check_knots(2e-7 + step * step / (8 * radius) / pitch[0]);
        check_pairs();
        for (int i = 0; i < all.n; i++)
            for (int end = 0; end < 2; end++) {
                double x = all.ends[i][end][0] - m.center[0], y = all.ends[i][end][1] - m.center[1],
                       r = sqrt(x * x + y * y), way_round = m.turns;
                /* the Hermite curve over h is h^4 / (384 radius^3) off, and turned by less than (h / radius)^3 */
                ck_assert_double_eq_tol(r, radius,
                                        1.01 * pow(step, 4) / (384 * pow(radius, 3)) + 4e-15 * (radius + 1e-3));
                ck_assert_double_eq_tol(all.e[i][end][0], -y / r * way_round,
                                        pow(step / radius, 3) + 8e-16 * (radius + 1e-3) / step);
                ck_assert_double_eq_tol(all.e[i][end][1], x / r * way_round,
                                        pow(step / radius, 3) + 8e-16 * (radius + 1e-3) / step);
            }
        arena_close(arena);
    }
}
END_TEST

/* A circle whose top touches a line of knots: from below, through a little, and not. However it meets, the cells tile
 * it. */
START_TEST(tangent_to_knots)
{
    for (int k = -3; k <= 3; k++) {
        double radius = 1e-3, touch = k == 0 ? 0 : (k < 0 ? -1 : 1) * pow(10, -abs(k) * 3), step = 0.2 / 96000;
        struct motion m = {.path = PATH_CIRCLE,
                           .radius = radius,
                           .center = {0, origin[1] + 10 * pitch[1] - radius + touch * pitch[1]},
                           .start_angle = M_PI / 2 - 0.05,
                           .turns = 0.1,
                           .speed = 0.2,
                           .duration = NAN};
        arena = arena_open();
        srand48(3);
        surface_plane(1);
        prepare(&m, 48000, 2);
        int n = (int)floor(motion.duration * 96000);
        travel(CELLS_ALONG, 1e-3, n, CELLS_CHUNK);
        check_tiling(n, 1e-15);
        check_knots(2e-7 + step * step / (8 * radius) / pitch[0]);
        arena_close(arena);
    }
}
END_TEST

/* A there-and-back of a polyline turns at a point: both ways are travelled, each on its side, though the turn lies
 * inside a sub-interval. */
START_TEST(curved_there_and_back)
{
    static const double points[] = {0, 0, 1e-3, 0.5e-3, 0, 0};
    struct motion m = {.path = PATH_POLYLINE,
                       .points = points,
                       .n_points = 3,
                       .speed = NAN,
                       .duration = 0.0107,
                       .law = SPEED_MINIMUM_JERK};
    arena = arena_open();
    srand48(4);
    surface_plane(1);
    prepare(&m, 48000, 1);
    travel(CELLS_ALONG, 1e-3, 512, CELLS_CHUNK);
    check_tiling(512, 1e-15);
    double furthest = 0;
    for (int i = 0; i < all.n; i++) {
        furthest = fmax(furthest, all.ends[i][1][0]);
        ck_assert_double_eq_tol(all.ends[i][1][1], 0.5 * all.ends[i][1][0], 1e-17);
    }
    ck_assert_double_eq_tol(furthest, 1e-3, 1e-15);
    arena_close(arena);
}
END_TEST

/* ------------------------------------------------------------------ what must not matter */

static void keep(double *to)
{
    size_t n = (size_t)all.n;
    memcpy(to, all.length, n * sizeof *to);
    memcpy(to + n, all.mean, n * sizeof *to);
    memcpy(to + 2 * n, all.ends, 4 * n * sizeof *to);
}

/* However sub-intervals are grouped, and wherever the buffer of cells is full, also in the middle of a long stretch:
 * the same bits. */
START_TEST(chunks_do_not_matter)
{
    static double one[7 * MOST], other[7 * MOST];
    for (int k = 0; k < 4; k++) {
        struct motion line = {.path = PATH_LINE, .to = {9e-2, 5e-2}, .speed = NAN, .duration = 0.05},
                      circle = {.path = PATH_CIRCLE, .radius = 5e-3, .turns = 1, .speed = NAN, .duration = 0.05};
        arena = arena_open();
        srand48(k);
        if (k == 0)
            surface_profile(ALONG_PATH);
        else
            surface_plane(k == 2 ? 2 : 1);
        prepare(k == 3 ? &circle : &line, k == 3 ? 20000 : 1000, 1);
        int n = k == 3 ? 500 : 10;
        travel(CELLS_ALONG, 1e-4, n, CELLS_CHUNK);
        int cells = all.n, flushes = all.flushes;
        ck_assert_int_gt(cells, 3 * LIMITER_CELLS);
        check_tiling(n, 1e-15);
        keep(one);
        travel(CELLS_ALONG, 1e-4, n, k == 3 ? 7 : 1);
        keep(other);
        ck_assert_int_eq(all.n, cells);
        ck_assert_int_ne(all.flushes, flushes);
        ck_assert_mem_eq(one, other, 7 * (size_t)cells * sizeof *one);
        arena_close(arena);
    }
}
END_TEST

/* The printed equations' channels: z_xx and z_yy with alphas of their own, the slope along the path and its derivative.
 */
START_TEST(values_per_axis)
{
    struct motion m = {.path = PATH_CIRCLE, .radius = 1e-3, .turns = 1, .speed = NAN, .duration = 0.02};
    arena = arena_open();
    srand48(5);
    surface_plane(2);
    prepare(&m, 48000, 1);
    travel(CELLS_AXES, HUGE_VAL, 500, CELLS_CHUNK);
    ck_assert(path.channels == 2 && path.ratio == 0.5);
    for (int i = 0; i < all.n; i++) {
        const double *at = all.ends[i][1], *e = all.e[i][1];
        double x, y, xx, xy, yy;
        relief_at(&relief, &(struct relief_points){1, &at[0], &at[1]},
                  &(struct relief_values){NULL, &x, &y, &xx, &xy, &yy});
        ck_assert(all.c[i][1][0] == xx && all.c[i][1][1] == yy && all.alpha[i][0] == 0.03 && all.alpha[i][1] == 0.015);
        ck_assert_double_eq_tol(all.slope[i][1], e[0] * x + e[1] * y, 1e-15 * (fabs(x) + fabs(y)));
        ck_assert_double_eq_tol(all.bend[i][1], e[0] * e[0] * xx + 2 * e[0] * e[1] * xy + e[1] * e[1] * yy,
                                1e-15 * (fabs(xx) + fabs(xy) + fabs(yy)));
    }
    arena_close(arena);
}
END_TEST

UNIT("path_cells", straight_paths, turning_paths, circles, tangent_to_knots, curved_there_and_back,
     chunks_do_not_matter, values_per_axis)
