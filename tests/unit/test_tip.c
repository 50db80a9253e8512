/* tip: the stage on surfaces given by a formula. What it gives is held against closed envelopes smoothed by quadrature,
   against a plain search at a finer pitch, and against itself in another order. All tolerances follow from
   surface/contact_patch.c, "Errors". */
#include "stage.h"
#include "surface/relief.h"
#include "trajectory/trajectory.h"
#include "unit.h"

extern const struct stage tip_stage;

/* ------------------------------------------------------------------ surfaces by formula */

typedef double height(double x, double y);

/* Derivatives by central differences, as exact as the tests need; nought where the formula jumps. */
static void formula_add(struct relief_part *part, const struct relief_points *p, const struct relief_values *v)
{
    height *f = *(height **)part->state;
    double e = 1e-7;
    for (size_t i = 0; i < p->n; i++) {
        double x = p->x[i], y = p->y ? p->y[i] : 0, z = f(x, y);
        v->z[i] += z;
        if (!v->xx) continue;
        double l = f(x - e, y), r = f(x + e, y), b = f(x, y - e), a = f(x, y + e),
               smooth = fmax(fabs(l - r), fabs(a - b)) < 1e-6;
        v->x[i] += smooth * (r - l) / (2 * e);
        v->xx[i] += smooth * (l + r - 2 * z) / (e * e);
        if (!v->yy) continue;
        v->y[i] += smooth * (a - b) / (2 * e);
        v->yy[i] += smooth * (a + b - 2 * z) / (e * e);
        v->xy[i] += smooth * (f(x + e, y + e) - f(x - e, y + e) - f(x + e, y - e) + f(x - e, y - e)) / (4 * e * e);
    }
}

struct tip {
    struct arena *arena;
    struct relief relief;
    struct relief_part part;
    height *f;
    struct contact contact;
    struct trajectory trajectory;
    struct board board;
    struct stage_run run;
};

/* A tip on a surface; finest: its finest scale. The motion is a line of 1 mm along +x through 0. */
static double kinked; /* m: where the formula may jump, in one coordinate; 0: nowhere */

static bool tip_try(struct tip *t, height *f, int along, const double radius_patch_finest[3], struct err *e)
{
    *t = (struct tip){.arena = arena_open(), .relief = {.along = along}, .f = f};
    t->part = (struct relief_part){
        .name = "formula", .finest = radius_patch_finest[2], .kinks = kinked, .add = formula_add, .state = &t->f};
    t->contact = (struct contact){.name = "ball",
                                  .scraper = {.radius = radius_patch_finest[0], .patch = radius_patch_finest[1]}};
    t->trajectory = (struct trajectory){.straight = true, .box = {{-5e-4, 0}, {5e-4, 0}}};
    t->board = (struct board){.relief = &t->relief, .trajectory = &t->trajectory};
    static const struct scene scene = {.accuracy = {.tip_heights = 1}};
    t->run = (struct stage_run){
        .stage = &tip_stage, .scene = &scene, .contact = &t->contact, .board = &t->board, .arena = t->arena};
    relief_add(&t->relief, &t->part);
    return tip_stage.open(&t->run, e);
}

static void tip_make(struct tip *t, height *f, int along, double radius, double patch, double finest)
{
    struct err e = {0};
    ck_assert_msg(tip_try(t, f, along, (double[3]){radius, patch, finest}, &e), "%s", e.text);
}

struct read {
    double z, x, y, xx, xy, yy;
};

static struct read tip_read(const struct tip *t, double x, double y)
{
    struct read r = {0};
    bool plane = t->relief.along == ALONG_PLANE;
    relief_at(
        &t->relief, &(struct relief_points){1, &x, plane ? &y : NULL},
        &(struct relief_values){&r.z, &r.x, plane ? &r.y : NULL, &r.xx, plane ? &r.xy : NULL, plane ? &r.yy : NULL});
    return r;
}

/* f smoothed by a Gaussian of standard deviation s, and its second derivative, by a sum over 7 s in steps of s/1000:
   for a kink, off by 1/12 of the step^2. */
static struct read smoothed(height *f, double x, double s)
{
    enum { STEPS = 7000 };
    struct read sum = {0};
    double whole = 0;
    for (int k = -STEPS; k <= STEPS; k++) {
        double q = k / 1000.0, g = exp(-0.5 * q * q), z = f(x + q * s, 0);
        whole += g;
        sum.z += g * z;
        sum.x += g * q / s * z;
        sum.xx += g * (q * q - 1) / (s * s) * z;
    }
    return (struct read){.z = sum.z / whole, .x = sum.x / whole, .xx = sum.xx / whole};
}

static double between(double low, double high) { return low + (high - low) * drand48(); }

/* ------------------------------------------------------------------ closed forms */

static double flat(double x, double y)
{
    (void)x, (void)y;
    return 3.1e-4;
}

/* No derivative at all, and the height but for what adding up 57 numbers whose sum is 1 leaves of it. */
START_TEST(flat_stays_flat)
{
    for (int along = ALONG_PATH; along <= ALONG_PLANE; along++) {
        struct tip t;
        tip_make(&t, flat, along, 1e-3, 2e-5, HUGE_VAL);
        for (int k = 0; k < 300; k++) {
            struct read r = tip_read(&t, between(-1, 1), between(-1, 1));
            ck_assert_double_eq_tol(r.z, 3.1e-4, 1e-18);
            ck_assert(r.x == 0 && r.y == 0 && r.xx == 0 && r.xy == 0 && r.yy == 0);
        }
        arena_close(t.arena);
    }
}
END_TEST

#define SPIKE_RADIUS 1e-3
#define SPIKE_HEIGHT 2e-5

static double spike(double x, double y) { return x * x + y * y < 1e-18 ? SPIKE_HEIGHT : 0; }

static double spike_envelope(double x, double y)
{
    double d2 = x * x + y * y,
           cap = d2 < SPIKE_RADIUS * SPIKE_RADIUS ? sqrt(SPIKE_RADIUS * SPIKE_RADIUS - d2) - SPIKE_RADIUS : -1;
    return fmax(SPIKE_HEIGHT + cap, 0);
}

/* Kinks of J = sqrt(2 H/R) = 0.2 where the ball leaves the ground: the curvature peaks there at 0.4 J/patch = 4000 1/m,
   of which 1 %; the height is off by h^2/12 of that and (spline) h^4/384 of a fourth derivative of 4000/patch^2; slope
   by sqrt(3)/216 h^3 of a third derivative of 0.6 4000/patch, and as much again from the kinks. */
START_TEST(spike_is_a_cap)
{
    double patch = 2e-5, h = patch / 4, peak = 4000;
    kinked = h / 2;
    for (int along = ALONG_PATH; along <= ALONG_X; along++) {
        struct tip t;
        tip_make(&t, spike, along, SPIKE_RADIUS, patch, HUGE_VAL);
        for (int k = 0; k < 200; k++) {
            double x = between(-3e-4, 3e-4);
            struct read want = smoothed(spike_envelope, x, patch), got = tip_read(&t, x, 0);
            ck_assert_double_eq_tol(got.z, want.z, peak * h * h * (1 / 12.0 + 1 / 6144.0) + 1e-15);
            ck_assert_double_eq_tol(got.x, want.x, peak * h * h / patch / 12 * 1.5);
            ck_assert_double_eq_tol(got.xx, want.xx, 0.01 * peak);
        }
        arena_close(t.arena);
    }
    kinked = 0;
}
END_TEST

static double ripple(double x, double y)
{
    (void)y;
    return 4e-6 * cos(2 * M_PI * x / 1e-3);
}

/* The curve at a distance of R = 1 mm above the ripple, whose hollows have a radius of curvature of 6.3 mm: x = t - R
   s/sqrt(1 + s^2), E = z(t) + R/sqrt(1 + s^2) - R, solved for t. */
static double ripple_envelope(double x, double y)
{
    double k = 2 * M_PI / 1e-3, t = x;
    (void)y;
    for (int i = 0; i < 16; i++) {
        double s = -4e-6 * k * sin(k * t);
        t = x + 1e-3 * s / sqrt(1 + s * s);
    }
    double s = -4e-6 * k * sin(k * t);
    return ripple(t, 0) + 1e-3 / sqrt(1 + s * s) - 1e-3;
}

/* d = 2.5 um: the ball touches up to d^2/8 (1/R + 158 1/m) = 0.9 nm higher between the samples; the mean of
   that stays in the height, and a saw-tooth of it in the curvature, smoothed over the patch: 0.9 nm / 2 / patch^2 at
   most, 1.1 1/m, of 188. */
START_TEST(ripple_is_an_offset_curve)
{
    struct tip t;
    double patch = 2e-5, missed = 2.5e-6 * 2.5e-6 / 8 * 1158;
    tip_make(&t, ripple, ALONG_PATH, 1e-3, patch, 5e-6);
    for (int k = 0; k < 60; k++) {
        double x = between(-2e-3, 2e-3);
        struct read want = smoothed(ripple_envelope, x, patch), got = tip_read(&t, x, 0);
        ck_assert(got.z < want.z + 1e-12 && got.z > want.z - missed);
        ck_assert_double_eq_tol(got.xx, want.xx, missed / 2 / (patch * patch));
    }
    ck_assert(fabs(smoothed(ripple_envelope, 0, patch).xx - smoothed(ripple, 0, patch).xx) >
              15); /* it is not the ripple */
    arena_close(t.arena);
}
END_TEST

static double groove(double x, double y)
{
    (void)y;
    return fabs(x) < 5e-5 - 1e-12 ? -5e-5 : 0;
}

static double groove_envelope(double x, double y)
{
    double from = 5e-5 - fabs(x);
    (void)y;
    return from > 0 ? sqrt(1e-6 - from * from) - 1e-3 : 0;
}

/* 0.1 mm wide, 50 um deep: a ball of 1 mm sinks in by 1.25 um. A kink of 0.1 in the middle, so that the curvature peaks
 * at 2000 1/m. */
START_TEST(groove_is_bridged)
{
    struct tip t;
    tip_make(&t, groove, ALONG_PATH, 1e-3, 2e-5, HUGE_VAL);
    for (int k = 0; k < 200; k++) {
        double x = between(-2e-4, 2e-4);
        struct read want = smoothed(groove_envelope, x, 2e-5), got = tip_read(&t, x, 0);
        ck_assert_double_eq_tol(got.z, want.z, 2000 * 25e-12 / 11);
        ck_assert_double_eq_tol(got.xx, want.xx, 20);
    }
    arena_close(t.arena);
}
END_TEST

/* ------------------------------------------------------------------ in the plane */

#define KNOB_RADIUS 1e-4

static double knob(double x, double y)
{
    double d2 = x * x + y * y,
           cap = d2 < KNOB_RADIUS * KNOB_RADIUS ? sqrt(KNOB_RADIUS * KNOB_RADIUS - d2) - KNOB_RADIUS : -1;
    return fmax(SPIKE_HEIGHT + cap, 0);
}

/* Over a spherical knob the ball's lowest point is on a sphere of both radii. */
static double knob_envelope(double x, double y)
{
    double both = SPIKE_RADIUS + KNOB_RADIUS;
    return fmax(SPIKE_HEIGHT + sqrt(both * both - x * x - y * y) - both, 0);
}

/* Smoothed in both directions: sum over 6 s in steps of s/16. */
static struct read knob_smoothed(double x, double y, double s)
{
    struct read sum = {0};
    double whole = 0;
    for (int i = -96; i <= 96; i++)
        for (int j = -96; j <= 96; j++) {
            double p = i / 16.0, q = j / 16.0, g = exp(-0.5 * (p * p + q * q)), z = knob_envelope(x + p * s, y + q * s);
            whole += g;
            sum.z += g * z;
            sum.xx += g * (p * p - 1) / (s * s) * z;
            sum.xy += g * p * q / (s * s) * z;
            sum.yy += g * (q * q - 1) / (s * s) * z;
        }
    return (struct read){.z = sum.z / whole, .xx = sum.xx / whole, .xy = sum.xy / whole, .yy = sum.yy / whole};
}

/* As for the spike in one coordinate: where the ball touches between heights it is borne by the surface itself. */
START_TEST(knob_is_a_spherical_cap)
{
    struct tip t;
    double patch = 2e-5, peak = 4000;
    tip_make(&t, knob, ALONG_PLANE, SPIKE_RADIUS, patch, 2e-6);
    for (int k = 0; k < 60; k++) {
        double x = between(-1.5e-4, 1.5e-4), y = between(-1.5e-4, 1.5e-4);
        struct read want = knob_smoothed(x, y, patch), got = tip_read(&t, x, y);
        ck_assert_double_eq_tol(got.z, want.z, peak * 25e-12 / 11);
        ck_assert_double_eq_tol(got.xx, want.xx, 0.01 * peak);
        ck_assert_double_eq_tol(got.xy, want.xy, 0.01 * peak);
        ck_assert_double_eq_tol(got.yy, want.yy, 0.01 * peak);
    }
    arena_close(t.arena);
}
END_TEST

/* Waves whose hollows (radius 0.1 mm) are too narrow for the ball. */
static double waves(double x, double y)
{
    (void)y;
    return 1e-5 * cos(2 * M_PI * x / 2e-4);
}

static double waves_turned(double x, double y) { return waves(x * cos(0.5) + y * sin(0.5), 0); }

/* The same waves across a direction of 0.5 rad: along that, the ball's way is the one in one coordinate. The curvature
   peaks in the hollows at 0.4/patch of a kink of 0.19, 7600 1/m, of which 1 %, or h^2/12 to either side in the height.
 */
START_TEST(ridges_are_as_in_one_coordinate)
{
    struct tip line, plane;
    double patch = 1e-5, c = cos(0.5), s = sin(0.5);
    tip_make(&line, waves, ALONG_PATH, 1e-3, patch, 2e-6);
    tip_make(&plane, waves_turned, ALONG_PLANE, 1e-3, patch, 2e-6);
    for (int k = 0; k < 60; k++) {
        double x = between(-3e-4, 3e-4), y = between(-3e-4, 3e-4);
        struct read want = tip_read(&line, x * c + y * s, 0), got = tip_read(&plane, x, y);
        ck_assert_double_eq_tol(got.z, want.z, 7600 * patch * patch / 16 / 8);
        ck_assert_double_eq_tol(got.x, c * want.x, 0.01 * 0.19);
        ck_assert_double_eq_tol(got.y, s * want.x, 0.01 * 0.19);
        ck_assert_double_eq_tol(got.xx, c * c * want.xx, 0.01 * 7600);
        ck_assert_double_eq_tol(got.xy, c * s * want.xx, 0.01 * 7600);
        ck_assert_double_eq_tol(got.yy, s * s * want.xx, 0.01 * 7600);
    }
    arena_close(line.arena);
    arena_close(plane.arena);
}
END_TEST

static double waves_up(double x, double y) { return waves((x - y) / sqrt(2), 0); }

static double waves_down(double x, double y) { return waves((x + y) / sqrt(2), 0); }

/* Diagonally, with d = 5 um, where the mixed term of Taylor's formula is as large as it gets, 62 nm: the ball stays
   under its way over the line but for 10 nm (h^2/12 of the kinks' curvature, 3800 1/m; d^3/17 z'''), and above it less
   d^2/8 (1/R + |z''|). */
START_TEST(crests_on_the_diagonal)
{
    static height *const formulas[2] = {waves_up, waves_down};
    double patch = 2e-5, off = 1.3 * 3800 * 25e-12 / 12;
    for (int k = 0; k < 2; k++) {
        struct tip line, plane;
        tip_make(&line, waves, ALONG_PATH, 1e-3, patch, 1e-6);
        tip_make(&plane, formulas[k], ALONG_PLANE, 1e-3, patch, 1e-5);
        for (int n = 0; n < 200; n++) {
            double x = between(-1e-3, 1e-3), y = between(-1e-3, 1e-3);
            struct read want = tip_read(&line, (x + (k ? y : -y)) / sqrt(2), 0), got = tip_read(&plane, x, y);
            ck_assert_double_eq_tol(got.z, want.z, off);
        }
        arena_close(line.arena);
        arena_close(plane.arena);
    }
}
END_TEST

/* ------------------------------------------------------------------ rough surfaces */

/* Waves of 40 to 320 um in all directions, heights of about 1 um. */
static double rough(double x, double y)
{
    double z = 0;
    for (int k = 0; k < 9; k++) {
        static const double lengths[] = {4e-5, 1.1e-4, 6.3e-5, 2.9e-4, 4.5e-5, 8e-5, 3.2e-4, 5.2e-5, 1.7e-4};
        double turn = k * 2.399963;
        z += 6e-7 * lengths[k] / 1e-4 * cos(2 * M_PI * (x * cos(turn) + y * sin(turn)) / lengths[k] + k * k);
    }
    return z;
}

struct plainly {
    double radius, patch, d;  /* d: between heights          */
    long reach, stride, most; /* in d: of the ball, between centres, of the Gaussian */
    bool plane;
};

/* E at lattice point (i, j) by trying every height within reach. */
static double plain_envelope(const struct plainly *p, const double *z, long side, long i, long j)
{
    double most = -HUGE_VAL;
    for (long b = p->plane ? -p->reach : 0; b <= (p->plane ? p->reach : 0); b++)
        for (long a = -p->reach; a <= p->reach; a++) {
            double square = (double)(a * a + b * b) * p->d * p->d;
            most = fmax(most, z[(j + b) * side + i + a] - square / (p->radius + sqrt(p->radius * p->radius - square)));
        }
    return most;
}

/* The way at a place, its own lattice around it: all heights, all envelopes, one sum. */
static struct read plain_way(const struct plainly *p, double x, double y)
{
    long half = p->most + p->reach, side = 2 * half + 1, rows = p->plane ? side : 1, up = p->plane ? p->most : 0;
    double *z = malloc((size_t)(side * rows) * sizeof *z), whole = 0;
    struct read sum = {0};
    for (long j = 0; j < rows; j++)
        for (long i = 0; i < side; i++)
            z[j * side + i] = rough(x + (double)(i - half) * p->d, p->plane ? y + (double)(j - half) * p->d : 0);
    for (long j = -up; j <= up; j += p->stride)
        for (long i = -p->most; i <= p->most; i += p->stride) {
            double a = (double)i * p->d / p->patch, b = (double)j * p->d / p->patch, g = exp(-0.5 * (a * a + b * b));
            double e = plain_envelope(p, z, side, i + half, p->plane ? j + half : 0);
            whole += g;
            sum.z += g * e;
            sum.xx += g * (a * a - 1) / (p->patch * p->patch) * e;
            sum.xy += g * a * b / (p->patch * p->patch) * e;
        }
    free(z);
    return (struct read){.z = sum.z / whole, .xx = sum.xx / whole, .xy = sum.xy / whole};
}

/* An eighth of the pitch between heights, a quarter of the lattice between centres. The curvature of the way reaches
   3000 1/m, of which 1 % for kinks and spline, or h^2/12 of it in the height; and what the ball misses between heights,
   d^2/8 (1/R + 3.5e4 1/m), over 2 patch^2. */
START_TEST(rough_line_against_a_plain_search)
{
    double patch = 1e-5, h = patch / 4, missed = 1.25e-6 * 1.25e-6 / 8 * 37000, largest = 0, worst = 0;
    struct plainly plainly = {.radius = 5e-4, .patch = patch, .d = 1.25e-6 / 8, .reach = 768, .stride = 4, .most = 448};
    struct tip t;
    tip_make(&t, rough, ALONG_PATH, 5e-4, patch, 2.5e-6);
    for (int k = 0; k < 40; k++) {
        double x = between(-1e-2, 1e-2);
        struct read got = tip_read(&t, x, 0), want = plain_way(&plainly, x, 0);
        ck_assert(got.z < want.z + 3000 * h * h / 11 && got.z > want.z - missed - 3000 * h * h / 11);
        largest = fmax(largest, fabs(want.xx));
        worst = fmax(worst, fabs(got.xx - want.xx));
    }
    ck_assert_msg(largest > 1000 && worst < 0.01 * largest + missed / 2 / (patch * patch), "%g %g", largest, worst);
    arena_close(t.arena);
}
END_TEST

/* The same in the plane, at half the pitch. */
START_TEST(rough_plane_against_a_plain_search)
{
    double patch = 1e-5, h = patch / 4, missed = h * h / 8 * 2 * 45000;
    struct plainly plainly = {
        .radius = 1e-4, .patch = patch, .d = h / 2, .reach = 32, .stride = 1, .most = 40, .plane = true};
    struct tip t;
    tip_make(&t, rough, ALONG_PLANE, 1e-4, patch, 5e-6);
    for (int k = 0; k < 4; k++) {
        double x = between(-1e-3, 1e-3), y = between(-1e-3, 1e-3);
        struct read got = tip_read(&t, x, y), want = plain_way(&plainly, x, y);
        ck_assert_double_eq_tol(got.z, want.z, missed + 3000 * h * h / 11);
        ck_assert_double_eq_tol(got.xx, want.xx, 30 + missed / 2 / (patch * patch));
        ck_assert_double_eq_tol(got.xy, want.xy, 30 + missed / 2 / (patch * patch));
    }
    arena_close(t.arena);
}
END_TEST

/* A ball much smaller than the waves is a point: what is left is the surface smoothed (each wave by exp(-(k
 * patch)^2/2)), and R s^2/2 at most. */
START_TEST(small_ball_is_a_point)
{
    double patch = 2e-5, damped = exp(-0.5 * pow(2 * M_PI / 2e-4 * patch, 2)), k = 2 * M_PI / 2e-4;
    double lies = 2e-7 * (sqrt(1 + 1e-10 * k * k) - 1); /* on slopes R (sqrt(1 + p^2) - 1) higher */
    for (int along = ALONG_PATH; along <= ALONG_PLANE; along++) {
        struct tip t;
        tip_make(&t, waves, along, 2e-7, patch, HUGE_VAL);
        for (int n = 0; n < 100; n++) {
            double x = between(-1e-3, 1e-3);
            struct read r = tip_read(&t, x, between(-1e-3, 1e-3));
            ck_assert_double_eq_tol(r.z, damped * waves(x, 0), 1e-5 * damped * 1e-4 + lies);
            ck_assert_double_eq_tol(r.xx, -damped * k * k * waves(x, 0),
                                    0.003 * damped * k * k * 1e-5); /* (h k)^2/12 = 0.0021 */
            ck_assert_double_eq_tol(r.yy, 0, 1e-4);
        }
        arena_close(t.arena);
    }
}
END_TEST

/* ------------------------------------------------------------------ what kind of function it is */

enum { PLACES = 40 };

/* One by one in any order, in another instance, alone in a third: the same bits. Places lie far apart, so that blocks
   are forgotten and made again. */
START_TEST(order_does_not_matter)
{
    for (int along = ALONG_PATH; along <= ALONG_PLANE; along += 2) {
        struct tip t, again;
        double x[PLACES], y[PLACES];
        struct read first[PLACES];
        double wide = along == ALONG_PLANE ? 3e-3 : 1;
        tip_make(&t, rough, along, 2e-4, 2e-5, 1e-5);
        tip_make(&again, rough, along, 2e-4, 2e-5, 1e-5);
        for (int k = 0; k < PLACES; k++) {
            x[k] = k % 2 ? x[k - 1] + 1e-5 : between(-wide, wide);
            y[k] = k % 2 ? y[k - 1] : between(-wide, wide);
            first[k] = tip_read(&t, x[k], y[k]);
        }
        for (int k = PLACES - 1; k >= 0; k--) {
            struct read back = tip_read(&t, x[k], y[k]), other = tip_read(&again, x[k], y[k]);
            ck_assert_mem_eq(&back, &first[k], sizeof back);
            ck_assert_mem_eq(&other, &first[k], sizeof other);
        }
        for (int k = 0; k < PLACES; k += 37) {
            struct tip alone;
            tip_make(&alone, rough, along, 2e-4, 2e-5, 1e-5);
            struct read only = tip_read(&alone, x[k], y[k]);
            ck_assert_mem_eq(&only, &first[k], sizeof only);
            arena_close(alone.arena);
        }
        arena_close(t.arena);
        arena_close(again.arena);
    }
}
END_TEST

/* Second derivatives do not jump, at knots (h = 5 um) or where blocks meet, and all are derivatives of the height:
   central differences with steps of 20 nm, whose own errors are 2e-22/eps^2 of rounding and eps z'''/2 where a knot
   lies between. */
START_TEST(derivatives_are_continuous)
{
    struct tip t;
    double tiny = 1e-12, eps = 2e-8, third = 3000 / 5e-6;
    tip_make(&t, rough, ALONG_PLANE, 2e-4, 2e-5, 1e-5);
    for (int k = -40; k < 40; k++) {
        double knot = k * 5e-6, other = between(-1e-3, 1e-3);
        struct read a = tip_read(&t, knot - tiny, other), b = tip_read(&t, knot + tiny, other);
        struct read c = tip_read(&t, other, knot - tiny), d = tip_read(&t, other, knot + tiny);
        ck_assert_double_eq_tol(a.xx, b.xx, 2 * tiny * third + 1e-4);
        ck_assert_double_eq_tol(a.yy, b.yy, 2 * tiny * third + 1e-4);
        ck_assert_double_eq_tol(c.xy, d.xy, 2 * tiny * third + 1e-4);
        ck_assert_double_eq_tol(c.yy, d.yy, 2 * tiny * third + 1e-4);
        double x = between(-1e-3, 1e-3), y = between(-1e-3, 1e-3);
        struct read at = tip_read(&t, x, y), l = tip_read(&t, x - eps, y), r = tip_read(&t, x + eps, y);
        struct read below = tip_read(&t, x, y - eps), above = tip_read(&t, x, y + eps);
        ck_assert_double_eq_tol((r.z - l.z) / (2 * eps), at.x, eps * eps * third + 1e-12);
        ck_assert_double_eq_tol((above.z - below.z) / (2 * eps), at.y, eps * eps * third + 1e-12);
        ck_assert_double_eq_tol((r.x - l.x) / (2 * eps), at.xx, eps * third);
        ck_assert_double_eq_tol((above.x - below.x) / (2 * eps), at.xy, eps * third);
        ck_assert_double_eq_tol((above.y - below.y) / (2 * eps), at.yy, eps * third);
    }
    ck_assert(t.relief.first->next == NULL && t.relief.first->pitch[0] == 5e-6 && t.relief.first->pitch[1] == 5e-6);
    arena_close(t.arena);
}
END_TEST

/* ------------------------------------------------------------------ limits */

static void check_refused(int along, double radius, double patch, double finest, const char *word)
{
    struct tip t;
    struct err e = {0};
    ck_assert(!tip_try(&t, rough, along, (double[3]){radius, patch, finest}, &e));
    ck_assert_msg(e.kind == ERR_SCENE && strstr(e.text, word) && strstr(e.text, "'ball'"), "%s", e.text);
    arena_close(t.arena);
}

START_TEST(too_large_a_ball)
{
    check_refused(ALONG_PATH, 10, 1e-7, HUGE_VAL, "raise scraper.patch");
    check_refused(ALONG_PATH, 10, 1e-6, 1e-9, "coarser surface");
    check_refused(ALONG_PLANE, 1, 1e-6, HUGE_VAL, "raise scraper.patch");
}
END_TEST

static double tower(double x, double y)
{
    return fabs(x - 1.23e-4) < 6e-6 && fabs(y - 3.21e-3) < 6e-6 ? 1e-4 : 1e-6 * cos(x / 1e-4) * cos(y / 1e-4);
}

/* A peak that the first look missed is told, once. */
START_TEST(a_missed_peak_is_told)
{
    struct tip t;
    tip_make(&t, tower, ALONG_PLANE, 1e-3, 2e-5, HUGE_VAL);
    tip_read(&t, 0, 0);
    ck_assert_int_eq(t.board.n_warnings, 0);
    for (int k = -5; k < 5; k++)
        tip_read(&t, 1.23e-4, 3.21e-3 + k * 1e-4);
    ck_assert_int_eq(t.board.n_warnings, 1);
    ck_assert(strstr(t.board.warnings[0], "ball"));
    arena_close(t.arena);
}
END_TEST

START_TEST(wanted_with_a_radius)
{
    ck_assert(tip_stage.wanted(&(struct contact){.scraper = {.radius = 1e-3}}, NULL));
    ck_assert(!tip_stage.wanted(&(struct contact){.scraper = {.radius = NAN}}, NULL));
}
END_TEST

UNIT("tip", flat_stays_flat, spike_is_a_cap, ripple_is_an_offset_curve, groove_is_bridged, knob_is_a_spherical_cap,
     ridges_are_as_in_one_coordinate, crests_on_the_diagonal, rough_line_against_a_plain_search,
     rough_plane_against_a_plain_search, small_ball_is_a_point, order_does_not_matter, derivatives_are_continuous,
     too_large_a_ball, a_missed_peak_is_told, wanted_with_a_radius)
