/* curvature: the pieces of a stretch against the geometry of the stretch and against the spline summed from its coefficients; the means
   and moments of the limited curvature over a piece against GSL's adaptive quadrature. */
#include "surface/curvature.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>

#include "scene/scene.h"
#include "unit.h"

/* ------------------------------------------------------------------ pieces */

enum { SAMPLES = 3000, MOST = 20000 };
static const double pitch = 5e-6;
static struct arena *arena;
static struct profile *profile;

static double between(double lo, double hi)
{
    return lo + (hi - lo) * drand48();
}

static void make_profile(void)
{
    double z[SAMPLES];
    arena = arena_open();
    srand48(1);
    for (int i = 0; i < SAMPLES; i++)
        z[i] = 1e-6 * between(-1, 1);
    profile = profile_from_samples(arena, z, SAMPLES, pitch, OFF_MAP_MIRROR);
}

/* All the pieces of one stretch, gathered over as many calls as it takes. */
struct way {
    int n, calls;
    double *length, *bend[2], *slope[2]; /* [n] and, at the two ends of piece i, [n] each */
};

static void gather(struct way *to, const struct curvature_pieces *p, int from)
{
    for (int i = from; i < p->n; i++, to->n++) {
        int a = p->at[i];
        ck_assert_int_lt(to->n, MOST);
        ck_assert(a >= 0 && a + 1 < p->points);
        to->length[to->n] = p->length[i];
        for (int k = 0; k < 2; k++)
            to->bend[k][to->n] = p->bend[a + k], to->slope[k][to->n] = p->slope[a + k];
        if (i > from)
            ck_assert_int_eq(p->at[i], p->at[i - 1] + 1); /* chained */
    }
}

/* `held` pieces of other stretches stand in the buffer already when the first call is made. */
static struct way cut(struct curvature_way *w, double u0, double u1, int held)
{
    static struct curvature_pieces p;
    struct curvature_stretch s = {.u = u0, .end = u1, .alpha = 0.03, .interval = 7};
    struct way to = {.length = ARENA_TAKE(arena, double, MOST)};
    for (int k = 0; k < 2; k++)
        to.bend[k] = ARENA_TAKE(arena, double, MOST), to.slope[k] = ARENA_TAKE(arena, double, MOST);
    p.n = held, p.points = 2 * held;
    for (bool all = false; !all; held = p.n = p.points = 0, to.calls++) {
        all = curvature_cut(w, &s, &p);
        ck_assert(p.n <= CURVATURE_PIECES && p.points <= 2 * CURVATURE_PIECES);
        for (int i = held; i < p.n; i++)
            ck_assert(p.interval[i] == 7 && p.heading[i] == (u1 > u0 ? 1 : -1) && p.alpha[p.at[i]] == 0.03 && p.alpha[p.at[i] + 1] == 0.03);
        ck_assert(all || p.n == CURVATURE_PIECES);
        gather(&to, &p, held);
    }
    return to;
}

/* z' (1) or z'' (2) at q from the coefficients: B-spline polynomials. */
static double spline_at(double q, int derivative)
{
    double c[4], x = q / pitch, sum = 0;
    long first = (long)floor(x) - 1;
    profile->read(profile, first, 4, c);
    for (long i = 0; i < 4; i++) {
        double d = x - (double)(first + i), r = fabs(d), side = d < 0 ? -1 : 1;
        double two = r < 1 ? 3 * r - 2 : 2 - r, one = side * (r < 1 ? -2 * r + 1.5 * r * r : -(2 - r) * (2 - r) / 2);
        sum += c[i] * (r >= 2 ? 0 : derivative == 1 ? one : two);
    }
    return sum / pow(pitch, derivative);
}

/* Rounding: a place q in knots is held to 2^-53 of itself, and is reached by n steps of one rounding each; that, times pitch / |scale|, bounds
   each length; the curvature changes by 12e-6 / pitch^2 per knot at most. */
static void check_tiling(const struct curvature_way *w, const struct way *c, double u0, double u1)
{
    double far = (fabs(w->offset) + fabs(w->scale) * fmax(fabs(u0), fabs(u1))) / pitch + 1, slip = 4 * far * 0x1p-53;
    double side = u1 > u0 ? 1 : -1, sum = 0, bend = 12e-6 / (pitch * pitch), along = pitch / fabs(w->scale);
    for (int i = 0; i < c->n; i++) {
        double q = w->offset + w->scale * (u0 + side * sum);
        ck_assert_double_gt(c->length[i], 0);
        ck_assert_double_le(c->length[i], fmin(along, w->longest) * (1 + slip) + slip * along);
        sum += c->length[i];
        for (int k = 0; k < 2; k++) {
            double there = k == 0 ? q : w->offset + w->scale * (u0 + side * sum), drift = slip * (i + 4);
            ck_assert_double_eq_tol(c->bend[k][i], spline_at(there, 2), bend * drift);
            ck_assert_double_eq_tol(c->slope[k][i], spline_at(there, 1), bend * pitch * drift);
        }
        if (i > 0)
            ck_assert(c->bend[0][i] == c->bend[1][i - 1] && c->slope[0][i] == c->slope[1][i - 1]);
    }
    ck_assert_double_eq_tol(sum, fabs(u1 - u0), along * slip * (c->n + 4));
}

static const double scales[] = {1, -1, 0.3, -0.3, 0.01};

START_TEST(pieces_tile_the_stretch)
{
    make_profile();
    for (int i = 0; i < 400; i++) {
        struct curvature_way w = curvature_way_make(arena, profile, between(-0.02, 0.03), scales[i % 5], 1);
        if (i % 3 == 0)
            w.longest = between(0.2, 3) * pitch / fabs(w.scale);
        double u0 = between(-0.02, 0.02), u1 = u0 + between(-1, 1) * (i % 2 ? 0.003 : 3e-6) / fabs(w.scale);
        struct arena *outer = arena;
        struct curvature_way local = w;
        arena = arena_open();
        struct way c = cut(&local, u0, u1, 0);
        check_tiling(&w, &c, u0, u1);
        arena_close(arena);
        arena = outer;
    }
    arena_close(arena);
}
END_TEST

/* Longer than the knots that are held (1024), either way, and back and forth over a border of theirs. */
START_TEST(longer_than_the_window)
{
    make_profile();
    struct curvature_way w = curvature_way_make(arena, profile, -0.004, 1, 1);
    double ends[][2] = {{0, 0.02}, {0.02, 0.001}, {0.001, 0.0035}, {0.0035, 0.001}, {0.001, 0.0065}, {0.0065, 0.0063}, {0.0063, 0.0067}};
    for (int i = 0; i < 7; i++) {
        struct way c = cut(&w, ends[i][0], ends[i][1], 0);
        check_tiling(&w, &c, ends[i][0], ends[i][1]);
    }
    arena_close(arena);
}
END_TEST

/* Nothing is cut that need not be: a piece ends at a knot, after `longest`, or where the stretch does. */
START_TEST(pieces_end_at_knots)
{
    make_profile();
    struct curvature_way w = curvature_way_make(arena, profile, 0, 1, 1);
    struct way c = cut(&w, 10.25 * pitch, 14.5 * pitch, 0);
    double want[] = {0.75, 1, 1, 1, 0.5};
    ck_assert_int_eq(c.n, 5);
    for (int i = 0; i < 5; i++)
        ck_assert_double_eq_tol(c.length[i] / pitch, want[i], 1e-14);
    c = cut(&w, 10 * pitch, 12 * pitch, 0);
    ck_assert_int_eq(c.n, 2);
    c = cut(&w, 12 * pitch, 10 * pitch, 0);
    ck_assert_int_eq(c.n, 2);
    c = cut(&w, 3e-6, 3e-6, 0);
    ck_assert_int_eq(c.n, 0);
    w = curvature_way_make(arena, profile, 0, -0.5, 0.75 * pitch); /* 0.375 knots of profile, backwards */
    c = cut(&w, 0.5 * pitch, 3 * pitch, 0);                        /* q from -0.25 to -1.5 knots        */
    double backwards[] = {0.375, 0.375, 0.375, 0.125};
    ck_assert_int_eq(c.n, 4);
    for (int i = 0; i < 4; i++)
        ck_assert_double_eq_tol(c.length[i] / pitch, 2 * backwards[i], 1e-14);
    arena_close(arena);
}
END_TEST

static void check_same(const struct way *a, const struct way *b)
{
    ck_assert_int_eq(a->n, b->n);
    ck_assert_mem_eq(a->length, b->length, (size_t)a->n * sizeof *a->length);
    for (int k = 0; k < 2; k++) {
        ck_assert_mem_eq(a->bend[k], b->bend[k], (size_t)a->n * sizeof *a->length);
        ck_assert_mem_eq(a->slope[k], b->slope[k], (size_t)a->n * sizeof *a->length);
    }
}

/* However full the buffer is when a stretch begins, and wherever the knots held lie, the pieces have the same bits. */
START_TEST(resumed_as_in_one)
{
    make_profile();
    for (int i = 0; i < 5; i++)
        for (int turned = 0; turned < 2; turned++) {
            struct curvature_way w = curvature_way_make(arena, profile, 0.002, scales[i], i % 2 ? 1 : 0.4 * pitch / fabs(scales[i]));
            double span = 0.0024 / fabs(w.scale), u0 = turned ? span : 0.1 * span, u1 = turned ? 0.1 * span : span;
            struct way whole = cut(&w, u0, u1, 0);
            for (int held = CURVATURE_PIECES; held > 0; held -= 101) {
                struct curvature_way other = curvature_way_make(arena, profile, 0.002, scales[i], w.longest);
                cut(&other, i * 0.1, i * 0.1 + pitch, 0); /* leaves other knots in the window */
                struct way again = cut(&other, u0, u1, held);
                check_same(&whole, &again);
                ck_assert_int_eq(again.calls, 1 + (whole.n + held - 1) / CURVATURE_PIECES);
            }
        }
    arena_close(arena);
}
END_TEST

START_TEST(backwards_is_forwards_reversed)
{
    make_profile();
    for (int i = 0; i < 100; i++) {
        struct curvature_way w = curvature_way_make(arena, profile, between(-0.01, 0.02), scales[i % 5], 1);
        double u0 = between(-0.01, 0.01), u1 = u0 + between(0, 0.004);
        struct arena *outer = arena;
        arena = arena_open();
        struct way there = cut(&w, u0, u1, 0), back = cut(&w, u1, u0, 0);
        ck_assert_int_eq(there.n, back.n);
        for (int k = 0; k < there.n; k++) {
            int j = there.n - 1 - k;
            ck_assert_double_eq(there.length[k], back.length[j]);
            for (int end = 0; end < 2; end++)
                ck_assert(there.bend[end][k] == back.bend[1 - end][j] && there.slope[end][k] == back.slope[1 - end][j]);
        }
        arena_close(arena);
        arena = outer;
    }
    arena_close(arena);
}
END_TEST

/* ------------------------------------------------------------------ means and moments: one piece from x0 / alpha to x1 / alpha */

static struct curvature_pieces pieces;

static void add_piece(double alpha, double c0, double c1)
{
    int i = pieces.n++, a = pieces.points;
    pieces.points += 2;
    pieces.at[i] = a;
    pieces.alpha[a] = pieces.alpha[a + 1] = alpha;
    pieces.bend[a] = c0, pieces.bend[a + 1] = c1;
}

struct line {
    double x0, x1;
    int power;
};

/* (share - 1/2)^power tanh(x) at a share of the way from x0 to x1. */
static double integrand(double share, void *data)
{
    const struct line *l = data;
    return (l->power ? share - 0.5 : 1) * tanh(l->x0 + share * (l->x1 - l->x0));
}

/* alpha times the mean (power 0) or moment (power 1) of T. The step of tanh is given to the quadrature as break points. */
static double quadrature(double x0, double x1, int power)
{
    static const double steps[] = {-20, -3, 0, 3, 20};
    gsl_integration_workspace *space = gsl_integration_workspace_alloc(1000);
    struct line line = {x0, x1, power};
    gsl_function f = {integrand, &line};
    double sum = 0, from = 0;
    for (int k = 0; k <= 5; k++) {
        double side = x1 > x0 ? 1 : -1, to = k == 5 || x1 == x0 ? 1 : (side * steps[k] - x0) / (x1 - x0), part, error;
        to = to < from ? from : to > 1 ? 1 : to;
        if (to > from) {
            int code = gsl_integration_qags(&f, from, to, 1e-15, 1e-12, 1000, space, &part, &error);
            ck_assert_msg(code == GSL_SUCCESS || (code == GSL_EROUND && error < 1e-13), "%s", gsl_strerror(code));
            sum += part;
        }
        from = to;
    }
    gsl_integration_workspace_free(space);
    return sum;
}

static double signed_power(double lo, double hi)
{
    return (drand48() < 0.5 ? -1 : 1) * pow(10, between(lo, hi));
}

/* x0 = alpha c0 and the way x1 - x0 over all decades that the two formulas and their border see, both signs; c itself between 1e-9 and 1e9. */
START_TEST(means_and_moments_are_integrals)
{
    double worst[2] = {0, 0};
    gsl_set_error_handler_off();
    srand48(2);
    for (int round = 0; round < 40; round++) {
        double x[CURVATURE_PIECES][2], alpha[CURVATURE_PIECES];
        pieces.n = pieces.points = 0;
        for (int i = 0; i < CURVATURE_PIECES; i++) {
            alpha[i] = pow(10, between(-6, 3));
            double x0 = signed_power(-9, i % 2 ? 6 : 1.3), way = i % 16 == 0 ? 0 : signed_power(i % 3 ? -3.5 : -9, i % 4 ? 2 : 5);
            double x1 = i % 16 == 1 ? -x0 : i % 16 == 2 ? 0 : x0 + way;
            add_piece(alpha[i], x0 / alpha[i], x1 / alpha[i]);
            x[i][0] = alpha[i] * (x0 / alpha[i]), x[i][1] = alpha[i] * (x1 / alpha[i]);
        }
        curvature_limit(&pieces, 1, true);
        for (int i = 0; i < CURVATURE_PIECES; i++) {
            double mean = fabs(alpha[i] * pieces.mean[i] - quadrature(x[i][0], x[i][1], 0));
            double moment = fabs(alpha[i] * pieces.moment[i] - quadrature(x[i][0], x[i][1], 1));
            worst[0] = fmax(worst[0], mean);
            worst[1] = fmax(worst[1], moment);
            ck_assert_msg(mean < 2e-12, "mean from %.17g to %.17g: off by %g", x[i][0], x[i][1], mean);
            ck_assert_msg(moment < 4e-7, "moment from %.17g to %.17g: off by %g", x[i][0], x[i][1], moment);
        }
    }
    printf("curvature: largest error of alpha mean T %.2g, of alpha moment %.2g\n", worst[0], worst[1]);
}
END_TEST

/* Beyond the border at 0.05 the moment is closed form too: x^2 2^-52 of cancellation over dx^2 is left, 1e-11 for x up to 20. */
START_TEST(moments_beyond_the_border)
{
    gsl_set_error_handler_off();
    srand48(3);
    for (int round = 0; round < 10; round++) {
        pieces.n = pieces.points = 0;
        for (int i = 0; i < CURVATURE_PIECES; i++) {
            double x0 = between(-20, 20);
            add_piece(1, x0, x0 + signed_power(-1.3, 4));
        }
        curvature_limit(&pieces, 1, true);
        for (int i = 0; i < CURVATURE_PIECES; i++)
            if (fabs(pieces.bend[2 * i + 1] - pieces.bend[2 * i]) > 0.05)
                ck_assert_double_eq_tol(pieces.moment[i], quadrature(pieces.bend[2 * i], pieces.bend[2 * i + 1], 1), 1e-11);
    }
}
END_TEST

/* |T| and its mean stay within 1/alpha (a rounding apart); the moment of a T between -1/alpha and 1/alpha within 1/(4 alpha). */
START_TEST(bounded_by_one_over_alpha)
{
    srand48(4);
    for (int round = 0; round < 200; round++) {
        pieces.n = pieces.points = 0;
        for (int i = 0; i < CURVATURE_PIECES; i++) {
            double c0 = signed_power(-2, 12);
            add_piece(pow(10, between(-6, 3)), c0, i % 2 ? signed_power(-2, 12) : c0 * (1 + signed_power(-16, 0)));
        }
        curvature_limit(&pieces, 1, true);
        for (int i = 0; i < CURVATURE_PIECES; i++) {
            double limit = (1 + 0x1p-51) / pieces.alpha[2 * i];
            ck_assert_double_le(fabs(pieces.limited[2 * i]), limit);
            ck_assert_double_le(fabs(pieces.limited[2 * i + 1]), limit);
            ck_assert_double_le(fabs(pieces.mean[i]), limit);
            ck_assert_double_le(fabs(pieces.moment[i]), limit / 4 * (1 + 1e-6));
        }
    }
}
END_TEST

/* With alpha c below 1e-9 the limiter's relative effect, (alpha c)^2 / 3, is below a rounding: T, mean and moment are the unlimited ones. */
START_TEST(small_alpha_limits_nothing)
{
    srand48(5);
    pieces.n = pieces.points = 0;
    for (int i = 0; i < CURVATURE_PIECES; i++)
        add_piece(1e-12, between(-1000, 1000), between(-1000, 1000));
    static struct curvature_pieces straight;
    straight = pieces;
    curvature_limit(&pieces, -0.7, true);
    curvature_limit(&straight, -0.7, false);
    for (int i = 0; i < CURVATURE_PIECES; i++) {
        double c0 = -0.7 * pieces.bend[2 * i], c1 = -0.7 * pieces.bend[2 * i + 1];
        ck_assert_double_eq_tol(pieces.limited[2 * i], c0, 1e-12);
        ck_assert_double_eq_tol(pieces.mean[i], (c0 + c1) / 2, 1e-12);
        ck_assert_double_eq_tol(pieces.moment[i], (c1 - c0) / 12, 1e-12);
        ck_assert_double_eq_tol(straight.limited[2 * i + 1], c1, 1e-12);
        ck_assert_double_eq_tol(straight.mean[i], (c0 + c1) / 2, 1e-12);
        ck_assert_double_eq_tol(straight.moment[i], (c1 - c0) / 12, 1e-12);
    }
}
END_TEST

/* T(factor c): as if the curvatures had been multiplied beforehand; swapped ends have the same mean and the opposite moment. */
START_TEST(factor_and_symmetry)
{
    double factors[] = {1, -1, 0.09, 1e-3, -30};
    srand48(6);
    for (int k = 0; k < 5; k++) {
        static struct curvature_pieces plain, swapped;
        memset(&plain, 0, sizeof plain);
        pieces.n = pieces.points = 0;
        for (int i = 0; i < CURVATURE_PIECES; i++)
            add_piece(0.03, signed_power(-3, 5), signed_power(-3, 5));
        plain = swapped = pieces;
        for (int i = 0; i < pieces.points; i++)
            plain.bend[i] *= factors[k], swapped.bend[i] = pieces.bend[i ^ 1];
        curvature_limit(&pieces, factors[k], true);
        curvature_limit(&plain, 1, true);
        curvature_limit(&swapped, factors[k], true);
        for (int i = 0; i < CURVATURE_PIECES; i++) {
            ck_assert_double_eq_tol(0.03 * pieces.mean[i], 0.03 * plain.mean[i], 1e-13);
            ck_assert_double_eq_tol(0.03 * pieces.moment[i], 0.03 * plain.moment[i], 1e-11);
            ck_assert_double_eq_tol(0.03 * pieces.mean[i], 0.03 * swapped.mean[i], 1e-13);
            ck_assert_double_eq_tol(0.03 * pieces.moment[i], -0.03 * swapped.moment[i], 1e-11);
        }
    }
}
END_TEST

/* Pieces chained by the cutter share their points: the momentum of a whole stretch is the sum of mean x length over its pieces, and equals the
   quadrature of T along the path, whichever way it is cut. */
START_TEST(stretch_is_the_sum_of_its_pieces)
{
    make_profile();
    gsl_set_error_handler_off();
    double sums[2];
    for (int fine = 0; fine < 2; fine++) {
        struct curvature_way w = curvature_way_make(arena, profile, 0, 1, fine ? 0.13 * pitch : 1);
        struct curvature_stretch s = {.u = 3.7 * pitch, .end = 41.2 * pitch, .alpha = 2e-5};
        pieces.n = pieces.points = 0;
        ck_assert(curvature_cut(&w, &s, &pieces));
        curvature_limit(&pieces, 1, true);
        double quad = sums[fine] = 0;
        for (int i = 0; i < pieces.n; i++) {
            int a = pieces.at[i];
            sums[fine] += pieces.mean[i] * pieces.length[i];
            quad += quadrature(s.alpha * pieces.bend[a], s.alpha * pieces.bend[a + 1], 0) / s.alpha * pieces.length[i];
        }
        ck_assert_double_eq_tol(sums[fine] / quad, 1, 1e-11);
    }
    ck_assert_double_eq_tol(sums[0] / sums[1], 1, 1e-10);
    arena_close(arena);
}
END_TEST

UNIT("curvature", pieces_tile_the_stretch, longer_than_the_window, pieces_end_at_knots, resumed_as_in_one, backwards_is_forwards_reversed,
     means_and_moments_are_integrals, moments_beyond_the_border, bounded_by_one_over_alpha, small_alpha_limits_nothing, factor_and_symmetry,
     stretch_is_the_sum_of_its_pieces)
