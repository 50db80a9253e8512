/* The space of materials and shapes: shares against the printed equations, anchors against the closed forms worked out
 * here, continuity, damping. */
#include "response/space.h"
#include "scene/material.h"
#include "unit.h"

#define RATE 48000.0
static const int materials[] = {MATERIAL_BASSWOOD, MATERIAL_STEEL, MATERIAL_GLASS};

static struct space still(double x, double y, double dimension)
{
    return (struct space){.given = true,
                          .from = {x, y},
                          .to = {NAN, NAN},
                          .dimension = dimension,
                          .dimension_to = NAN,
                          .fundamental = 400,
                          .gain = 2};
}

static struct modes make(struct arena *a, const struct space *s, int most, double rate)
{
    struct modes m;
    struct err e = {0};
    ck_assert_msg(space_modes(s, &(struct modes_ask){.strongest = most, .rate = rate}, a, &m, &e), "%s", e.text);
    return m;
}

struct point { /* by rising frequency */
    int n;
    double f[64], decay[64], re[64], im[64];
};

static struct point read_at(const struct modes *m, double share)
{
    double f[64], decay[64], re[64], im[64];
    struct modes_point p = {f, decay, re, im};
    struct point out = {.n = m->n};
    ck_assert_int_le(m->n, 64);
    ck_assert_double_eq(m->at(m, &(struct modes_where){.share = share}, &p), 0.0);
    for (int i = 0; i < m->n; i++) {
        int rank = 0;
        for (int k = 0; k < m->n; k++)
            rank += f[k] < f[i];
        out.f[rank] = f[i];
        out.decay[rank] = decay[i];
        out.re[rank] = re[i];
        out.im[rank] = im[i];
    }
    return out;
}

static struct point point_at(double x, double y, double dimension)
{
    struct arena *a = arena_open();
    struct space s = still(x, y, dimension);
    struct modes m = make(a, &s, 40, 1e6);
    struct point p = read_at(&m, 0);
    ck_assert_int_eq(p.n, 40);
    arena_close(a);
    return p;
}

/* ------------------------------------------------------------------ shares */

/* T as papers/004 prints it (equation 9), theta in [0, 2 pi). */
static double printed(double theta)
{
    theta -= 2 * M_PI * floor(theta / (2 * M_PI));
    return theta < 2 * M_PI / 3 ? 1 - 3 * theta / (2 * M_PI) : theta < 4 * M_PI / 3 ? 0 : 3 * theta / (2 * M_PI) - 2;
}

START_TEST(shares_are_those_of_the_printed_equations)
{
    for (int i = 0; i < 1000; i++)
        for (int j = 0; j <= 4; j++) {
            double theta = 2 * M_PI * (i + 0.37) / 1000, r = j / 4.0, w[3], sum = 0;
            space_anchors_shares(r * cos(theta), r * sin(theta), w);
            for (int k = 0; k < 3; k++) {
                ck_assert_double_eq_tol(w[k], (1 - r) / 3 + r * printed(theta - k * 2 * M_PI / 3), 1e-14);
                sum += w[k];
            }
            ck_assert_double_eq_tol(sum, 1, 1e-14);
        }
}
END_TEST

/* Not a jump anywhere: across the cut of the angle at theta = 0 and pi, and towards the centre, whatever the direction.
 */
START_TEST(shares_are_continuous)
{
    double w[3], v[3];
    for (int i = 0; i < 360; i++) {
        double theta = i * M_PI / 180, c = cos(theta), s = sin(theta), d = 1e-9;
        space_anchors_shares(0.8 * c - d * s, 0.8 * s + d * c, w);
        space_anchors_shares(0.8 * c + d * s, 0.8 * s - d * c, v);
        for (int k = 0; k < 3; k++)
            ck_assert_double_eq_tol(w[k], v[k], 1e-8);
        space_anchors_shares(d * c, d * s, w);
        for (int k = 0; k < 3; k++)
            ck_assert_double_eq_tol(w[k], 1.0 / 3, 1e-8);
    }
    space_anchors_shares(0, 0, w);
    for (int k = 0; k < 3; k++)
        ck_assert_double_eq_tol(w[k], 1.0 / 3, 1e-15);
}
END_TEST

/* ------------------------------------------------------------------ anchors */

/* A root of g between low and high by bisection, one sign change. */
static double root(double (*g)(double x, const double *p), const double *p, double low, double high)
{
    bool up = g(low, p) < 0;
    for (int i = 0; i < 200; i++) {
        double middle = 0.5 * (low + high);
        *((g(middle, p) < 0) == up ? &low : &high) = middle;
    }
    return low;
}

static double free_bar(double b, const double *p)
{
    (void)p;
    return cos(b) - 1 / cosh(b);
}

/* Timoshenko's dispersion, as the two coupled equations of deflection and turn: (k^2 S - w^2)(k^2 E I + S - I w^2) =
   k^2 S^2 for rho = A = 1, S = kappa G; the smaller root lies below the shear cut-off's own branch. p = {k, E, kappa G,
   I}. */
static double timoshenko(double w2, const double *p)
{
    double k2 = p[0] * p[0], shear = p[2];
    return (k2 * shear - w2) * (k2 * p[1] * p[3] + shear - p[3] * w2) - k2 * shear * shear;
}

static double bar_frequency(const struct material *m, int i)
{
    double b = root(free_bar, NULL, (i + 1) * M_PI, (i + 2) * M_PI), h = 1.0 / 30;
    double p[] = {b, m->youngs_modulus / m->density, 5.0 / 6 * m->shear / m->density, h * h / 12};
    return sqrt(root(timoshenko, p, 0, p[0] * p[0] * p[2]));
}

/* Leissa's supported plate with Dx, Dy, H in N m, 1 m x 0.7 m x 1 mm: the (i + 1)-th lowest, by counting. */
static double plate_frequency(const struct material *m, int i)
{
    static double all[10000];
    double nu = m->poisson, h3 = 1e-9, ratio = m->across / m->youngs_modulus,
           dx = m->youngs_modulus * h3 / 12 / (1 - nu * nu * ratio), dy = dx * ratio;
    double twist = dx * nu * ratio + 2 * m->shear * h3 / 12;
    for (int p = 0; p < 100; p++)
        for (int q = 0; q < 100; q++)
            all[100 * p + q] =
                dx * pow(p + 1, 4) + 2 * twist * pow((p + 1) * (q + 1) / 0.7, 2) + dy * pow((q + 1) / 0.7, 4);
    for (int k = 0; k < 10000; k++) {
        int below = 0;
        for (int j = 0; j < 10000 && below <= i; j++)
            below += all[j] < all[k];
        if (below == i) return sqrt(all[k]);
    }
    return NAN;
}

/* Determinant of the two equations of motion of a spherical shell (Junger and Feit), tangential and radial; p = {nu, L,
 * h^2/(12 R^2)}. */
static double shell(double w2, const double *p)
{
    double nu = p[0], l = p[1], q = p[2], n = nu + l - 1;
    return (w2 - (1 + q) * n) * (w2 - 2 * (1 + nu) - q * l * n) - l * pow(q * n + 1 + nu, 2);
}

static double shell_frequency(const struct material *m, int i)
{
    double l = (i + 2) * (i + 3), p[] = {m->poisson * sqrt(m->across / m->youngs_modulus), l, 1 / (12 * 2500.0)};
    double trace = (1 + p[2]) * (p[0] + l - 1) + 2 * (1 + p[0]) + p[2] * l * (p[0] + l - 1);
    return sqrt(root(shell, p, 0, trace / 2)); /* the smaller root lies below the mean of the two */
}

/* At each anchor, in each shape: its own frequencies, damping and gains, to rounding (exp of sums of logs: 1e-12). */
START_TEST(anchors_are_themselves)
{
    double (*const frequency[])(const struct material *, int) = {bar_frequency, plate_frequency, shell_frequency};
    for (int k = 0; k < 3; k++)
        for (int d = 0; d < 3; d++) {
            const struct material *m = material_find(materials[k]);
            struct point p = point_at(cos(k * 2 * M_PI / 3), sin(k * 2 * M_PI / 3), d + 1);
            for (int i = 0; i < 40; i++) {
                double w0 = 2 * M_PI * 400 * frequency[d](m, i) / frequency[d](m, 0),
                       s = (m->alpha + m->beta * w0 * w0 + m->loss * w0) / 2;
                double w = sqrt(w0 * w0 - s * s), gain = d == 2 ? 2 * (2 * i + 5) / 5.0 : 2;
                ck_assert_double_eq_tol(p.f[i], w / (2 * M_PI), 1e-12 * p.f[i]);
                ck_assert_double_eq_tol(p.decay[i], s, 1e-12 * s);
                ck_assert_double_eq_tol(p.im[i], gain, 1e-12 * gain);
                ck_assert_double_eq_tol(p.re[i], -gain * s / w, 1e-12 * gain);
            }
        }
}
END_TEST

/* Published: 2.7565, 5.4039 of a slender free bar (the steel bar of l/h = 30 lies up to 2 % lower), 0.701 = W of a
   shell's first mode for nu = 0.3 (Baker 1961: 0.7010 of a membrane, to which h = R/50 adds less than 0.1 %), against
   its ring frequency's limit. */
START_TEST(known_ratios)
{
    struct point bar = point_at(-0.5, sqrt(3) / 2, 1), wood = point_at(1, 0, 1), plate = point_at(-0.5, sqrt(3) / 2, 2);
    const struct material steel = *material_find(MATERIAL_STEEL);
    ck_assert_double_eq_tol(bar.f[1] / bar.f[0], 2.7565, 0.02 * 2.7565);
    ck_assert_double_eq_tol(bar.f[2] / bar.f[0], 5.4039, 0.04 * 5.4039);
    ck_assert_double_lt(bar.f[2] / bar.f[0], 5.4039);
    ck_assert_double_lt(wood.f[2] / wood.f[0], 0.95 * bar.f[2] / bar.f[0]);
    ck_assert_double_eq_tol(shell_frequency(&steel, 0), 0.7010, 0.001);
    /* (1, 2) and (2, 1) of a plate 1 : 0.7, isotropic: (1 + 4/0.49)/(1 + 1/0.49), (4 + 1/0.49)/(1 + 1/0.49) */
    ck_assert_double_eq_tol(plate.f[1] / plate.f[0], (4 + 1 / 0.49) / (1 + 1 / 0.49), 1e-6);
    ck_assert_double_eq_tol(plate.f[2] / plate.f[0], (1 + 4 / 0.49) / (1 + 1 / 0.49), 1e-6);
}
END_TEST

/* ------------------------------------------------------------------ between */

/* The centre is the mean of all three: the same from whichever direction, and the logs' mean. */
START_TEST(the_centre_is_the_mean)
{
    struct point c = point_at(0, 0, 2), p[3];
    for (int k = 0; k < 3; k++)
        p[k] = point_at(cos(k * 2 * M_PI / 3), sin(k * 2 * M_PI / 3), 2);
    for (int i = 0; i < 40; i++) {
        double w0 = 2 * M_PI * hypot(c.f[i], c.decay[i] / (2 * M_PI)), mean = 0, law = 0;
        for (int k = 0; k < 3; k++) {
            const struct material *m = material_find(materials[k]);
            mean += log(hypot(p[k].f[i], p[k].decay[i] / (2 * M_PI))) / 3;
            law += log(material_decay(m->alpha, m->beta, m->loss, w0)) / 3;
        }
        ck_assert_double_eq_tol(w0 / (2 * M_PI), exp(mean), 1e-11 * c.f[i]);
        ck_assert_double_eq_tol(c.decay[i], exp(law), 1e-11 * c.decay[i]);
    }
}
END_TEST

/* Half-way between two shapes: the geometric mean, mode by mode; next to a whole dimension next to its values. */
START_TEST(dimensions_between)
{
    for (int d = 1; d <= 2; d++) {
        struct point low = point_at(0.3, 0.2, d), half = point_at(0.3, 0.2, d + 0.5), high = point_at(0.3, 0.2, d + 1);
        struct point above = point_at(0.3, 0.2, d + 1e-9), below = point_at(0.3, 0.2, d + 1 - 1e-9);
        for (int i = 0; i < 40; i++) {
            double f[3] = {hypot(low.f[i], low.decay[i] / (2 * M_PI)), hypot(half.f[i], half.decay[i] / (2 * M_PI)),
                           hypot(high.f[i], high.decay[i] / (2 * M_PI))};
            ck_assert_double_eq_tol(f[1], sqrt(f[0] * f[2]), 1e-11 * f[1]);
            ck_assert_double_eq_tol(half.im[i], sqrt(low.im[i] * high.im[i]), 1e-12 * half.im[i]);
            ck_assert_double_eq_tol(above.f[i], low.f[i], 1e-7 * low.f[i]);
            ck_assert_double_eq_tol(below.f[i], high.f[i], 1e-7 * high.f[i]);
        }
    }
}
END_TEST

/* From metal to wood along the rim and along the chord, and from metal to glass: every mode of one frequency is damped
 * more and more. */
START_TEST(damping_grows_from_metal_to_wood)
{
    double last[40] = {0}, chord[40] = {0}, glass[40] = {0};
    for (int k = 0; k <= 20; k++) {
        double u = k / 20.0, theta = 2 * M_PI / 3 * (1 - u);
        struct point p = point_at(cos(theta), sin(theta), 2);
        struct point q = point_at(-0.5 + 1.5 * u, (1 - u) * sqrt(3) / 2, 2),
                     g = point_at(cos(2 * M_PI / 3 * (1 + u)), sin(2 * M_PI / 3 * (1 + u)), 2);
        for (int i = 0; i < 40; i++) { /* over the frequency, which changes too */
            ck_assert_double_gt(p.decay[i] / p.f[i], last[i]);
            ck_assert_double_gt(q.decay[i] / q.f[i], chord[i]);
            ck_assert_double_gt(g.decay[i] / g.f[i], glass[i]);
            last[i] = p.decay[i] / p.f[i];
            chord[i] = q.decay[i] / q.f[i];
            glass[i] = g.decay[i] / g.f[i];
        }
    }
}
END_TEST

/* All over the disk and the dimensions: decays and frequencies positive and finite, modes in order, none over another.
 */
START_TEST(always_stable_and_in_order)
{
    for (int i = 0; i < 12; i++)
        for (int j = 0; j <= 4; j++)
            for (int d = 0; d <= 8; d++) {
                double theta = i * M_PI / 6, r = j / 4.0;
                struct point p = point_at(r * cos(theta), r * sin(theta), 1 + d / 4.0);
                for (int k = 0; k < p.n; k++) {
                    ck_assert(isfinite(p.f[k]) && isfinite(p.decay[k]) && p.f[k] > 0 && p.decay[k] > 0);
                    ck_assert(k == 0 || p.f[k] > p.f[k - 1]);
                    ck_assert_double_lt(p.decay[k], 2 * M_PI * p.f[k]);
                }
            }
}
END_TEST

/* ------------------------------------------------------------------ on the way */

START_TEST(a_place_that_stays)
{
    struct arena *a = arena_open();
    struct space s = still(0.2, -0.1, 2);
    struct modes m = make(a, &s, 50, RATE);
    struct err e = {0};
    double re[64], im[64];
    struct modes_point p = {NULL, NULL, re, im};
    ck_assert(m.shared && !m.moves && !m.travels && m.quantity == MODES_VELOCITY && isnan(m.radius) && !m.object);
    ck_assert_int_eq(m.n, 50);
    m.at(&m, &(struct modes_where){.share = 0.7}, &p);
    for (int i = 0; i < m.n; i++) {
        ck_assert_double_eq(m.slowest[i], m.decay[i]);
        ck_assert_double_eq(im[i], 2);
        ck_assert(i == 0 || im[i] * im[i] / m.decay[i] <= im[i - 1] * im[i - 1] / m.decay[i - 1]);
    }
    s.fundamental = 5000;
    ck_assert(space_modes(&s, &(struct modes_ask){.strongest = 50, .band = {20, 20000}, .rate = RATE}, a, &m, &e));
    ck_assert_int_lt(m.n, 50);
    ck_assert_int_gt(m.n, 1);
    /* The second mode at 0.4495 and then at 0.4505 of the rate, where it is left out; chosen it is at any. */
    s = still(-0.5, sqrt(3) / 2, 2);
    for (int k = 0; k <= 1; k++) {
        s.fundamental = (k ? 0.4505 : 0.4495) * RATE * (1 + 1 / 0.49) / (4 + 1 / 0.49);
        m = make(a, &s, 2, RATE);
        ck_assert_int_eq(m.n, 2);
        ck_assert_int_eq(modes_drop_above(&m, RATE), k);
        ck_assert_int_eq(m.n, 2 - k);
    }
    arena_close(a);
}
END_TEST

/* Between the ends: what a place that stays there has. */
START_TEST(a_place_that_moves)
{
    struct arena *a = arena_open();
    struct space s = still(1, 0, 1.2);
    s.to[0] = -0.5;
    s.to[1] = sqrt(3) / 2;
    s.dimension_to = 2.8;
    struct modes m = make(a, &s, 40, 1e6);
    ck_assert(!m.shared && !m.moves && m.travels);
    for (int k = 0; k <= 4; k++) {
        double u = k / 4.0;
        struct point way = read_at(&m, u), there = point_at(1 - 1.5 * u, u * sqrt(3) / 2, 1.2 + 1.6 * u);
        for (int i = 0; i < 40; i++) {
            ck_assert_double_eq_tol(way.f[i], there.f[i], 1e-12 * there.f[i]);
            ck_assert_double_eq_tol(way.decay[i], there.decay[i], 1e-11 * there.decay[i]);
        }
    }
    double f[64], decay[64], re[64], im[64];
    struct modes_point p = {f, decay, re, im};
    for (int k = 0; k <= 1000; k++) {
        m.at(&m, &(struct modes_where){.share = k / 1000.0}, &p);
        for (int i = 0; i < m.n; i++) /* the least is looked for at 257 places: it may lie up to (1/512 of the way)^2 of
                                         its log's curvature lower */
            ck_assert_double_ge(decay[i], m.slowest[i] * (1 - 1e-3));
    }
    arena_close(a);
}
END_TEST

/* Modes that leave the band on the way: full below 0.45 of the rate, gone above 0.5, smooth between; those that never
 * are in it are left out. */
START_TEST(fades_near_half_the_rate)
{
    struct arena *a = arena_open();
    struct space s = still(-0.5, sqrt(3) / 2, 3);
    s.dimension_to = 1; /* a bar's overtones are far higher */
    struct modes m = make(a, &s, 40, RATE);
    double f[64], decay[64], re[64], im[64], last[64];
    struct modes_point p = {f, decay, re, im};
    int faded = 0, between = 0;
    ck_assert_int_gt(m.n, 10);
    for (int k = 0; k <= 4000; k++) {
        m.at(&m, &(struct modes_where){.share = k / 4000.0}, &p);
        for (int i = 0; i < m.n; i++) {
            if (f[i] <= 0.45 * RATE) ck_assert_double_ge(im[i], 2 * (1 - 1e-12));
            if (f[i] >= 0.5 * RATE) ck_assert(im[i] == 0 && re[i] == 0);
            faded += k == 4000 && f[i] >= 0.5 * RATE;
            between += f[i] > 0.45 * RATE && f[i] < 0.5 * RATE;
            if (k > 0)
                ck_assert_double_eq_tol(im[i], last[i],
                                        0.04 * 2 * 17); /* the strongest gain is (2 * 39 + 5)/5 = 17 times the first */
            last[i] = im[i];
        }
    }
    ck_assert_int_gt(faded, 5);
    ck_assert_int_gt(between, 50);
    for (int i = 0; i < m.n; i++)
        ck_assert_double_lt(m.frequency[i], 0.5 * RATE);
    arena_close(a);
}
END_TEST

START_TEST(places_off_the_disk_are_refused)
{
    struct arena *a = arena_open();
    struct modes m;
    struct modes_ask ask = {.strongest = 10, .rate = RATE};
    struct err e = {0};
    struct space s = still(0.8, 0.8, 2);
    ck_assert(!space_modes(&s, &ask, a, &m, &e));
    ck_assert_int_eq(e.kind, ERR_SCENE);
    ck_assert_ptr_nonnull(strstr(e.text, "surface.space.from: [0.8, 0.8] lies 1.13"));
    s = still(0, 0, 2);
    s.to[0] = 1;
    s.to[1] = 0.1;
    e = (struct err){0};
    ck_assert(!space_modes(&s, &ask, a, &m, &e));
    ck_assert_ptr_nonnull(strstr(e.text, "surface.space.to"));
    s = still(0, 0, 2);
    s.fundamental = 5000;
    e = (struct err){0};
    ask.band[1] = 4000;
    ck_assert(!space_modes(&s, &ask, a, &m, &e));
    ck_assert_ptr_nonnull(strstr(e.text, "none of its modes lies from 0 Hz to below 4000 Hz"));
    ask.band[1] = 0;
    s = still(-0.5, 0.8660254, 2); /* metal, as one writes it */
    ask.rate = RATE;
    e = (struct err){0};
    ck_assert(space_modes(&s, &ask, a, &m, &e));
    arena_close(a);
}
END_TEST

UNIT("space", shares_are_those_of_the_printed_equations, shares_are_continuous, anchors_are_themselves, known_ratios,
     the_centre_is_the_mean, dimensions_between, damping_grows_from_metal_to_wood, always_stable_and_in_order,
     a_place_that_stays, a_place_that_moves, fades_near_half_the_rate, places_off_the_disk_are_refused)
