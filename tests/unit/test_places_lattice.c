/* Grids and lines of places: polynomials in closed form, which the spline must give to rounding; any order of places;
   mirrored values; the growth of errors against sums of cardinal functions; a plate's mode shapes in closed form
   against the error that a table may have. */
#include "response/places.h"
#include "response/places_smooth.h"

#include "unit.h"

static struct arena *arena;
static const double pi = 3.14159265358979323846;

static void setup(void)
{
    arena = arena_open();
    srand48(11);
}
static void teardown(void) { arena_close(arena); }

static struct places *made(int n, const double *xy, enum places_kind kind)
{
    struct err e = {0};
    struct places *p;
    int bad;
    ck_assert_msg(places_make(arena, n, xy, &p, &bad, &e), "%s", e.text);
    ck_assert_int_eq(places_kind(p), kind);
    return p;
}

/* Knots from 0.1 m on, neighbouring distances 1 to `ratio` times 1 cm. */
static void knots(int n, double ratio, double *at)
{
    at[0] = 0.1;
    for (int k = 1; k < n; k++)
        at[k] = at[k - 1] + 0.01 * (1 + (ratio - 1) * drand48());
}

struct grid {
    int nx, ny, n;
    double x[64], y[64], xy[2 * 64 * 64];
    int column[64 * 64], row[64 * 64];
};

/* In any order; turned by `angle` and rounded to `digits` decimals (0: not). */
static void lay(struct grid *g, int nx, int ny, double ratio, double angle, int digits)
{
    *g = (struct grid){.nx = nx, .ny = ny, .n = nx * ny};
    knots(nx, ratio, g->x);
    knots(ny, ratio, g->y);
    for (int k = 0; k < g->n; k++) {
        int other = (int)(drand48() * (k + 1));
        g->column[k] = g->column[other], g->row[k] = g->row[other];
        g->column[other] = k % nx, g->row[other] = k / nx;
    }
    for (int k = 0; k < g->n; k++) {
        double x = g->x[g->column[k]], y = g->y[g->row[k]],
               to[2] = {x * cos(angle) - y * sin(angle), x * sin(angle) + y * cos(angle)};
        for (int c = 0; c < 2; c++)
            g->xy[2 * k + c] = digits ? rint(to[c] * pow(10, digits)) / pow(10, digits) : to[c];
    }
}

static double *filled(const struct places *p, int n, const double *value)
{
    double *rows = ARENA_TAKE(arena, double, (size_t)places_rows(p));
    memcpy(rows, value, (size_t)n * sizeof *rows);
    places_fill(p, 1, rows);
    return rows;
}

static double smooth(const struct places *p, const double *rows, double x, double y)
{
    struct places_sum s;
    double sum = 0;
    ck_assert(places_smooth_at(p, x, y, &s) == 0);
    for (int k = 0; k < s.n; k++)
        sum += s.weight[k] * rows[s.index[k]];
    return sum;
}

static double mixed(const struct places *p, const double *value, double x, double y)
{
    struct places_mix m;
    double sum = 0;
    places_at(p, x, y, &m);
    for (int k = 0; k < m.n; k++) {
        ck_assert(m.weight[k] >= 0);
        sum += m.weight[k] * value[m.index[k]];
    }
    return sum;
}

/* Of degree n - 1 in a direction of n lines, 3 at most, in decimetres, with random coefficients. */
static double polynomial(const double *c, int nx, int ny, double x, double y)
{
    double sum = 0;
    for (int i = 0; i < 4 && i < nx; i++)
        for (int j = 0; j < 4 && j < ny; j++)
            sum += c[4 * i + j] * pow(10 * x, i) * pow(10 * y, j);
    return sum;
}

/* Everywhere, also in the outermost cells; on grids of 2 to 13 lines, evenly and unevenly spaced, straight and turned.
   The mix gives what is linear in both. Values reach 16 x (10 x 0.4)^6 = 7e4; rounding of shares of that, and of places
   that a turn has rounded, stays below 1e-9. */
START_TEST(polynomials)
{
    setup();
    static struct grid g;
    static double value[64 * 64], line[64 * 64];
    for (int trial = 0; trial < 120; trial++) {
        int nx = 2 + trial % 12, ny = 2 + (int)(12 * drand48());
        double angle = trial % 3 == 0 ? 0.4 : trial % 3 == 1 ? -1.1 : 0, c[16];
        lay(&g, nx, ny, trial % 4 ? 2.5 : 1, angle, 0);
        for (int i = 0; i < 16; i++)
            c[i] = 2 * drand48() - 1;
        for (int k = 0; k < g.n; k++) {
            value[k] = polynomial(c, nx, ny, g.x[g.column[k]], g.y[g.row[k]]);
            line[k] = polynomial(c, 2, 2, g.x[g.column[k]], g.y[g.row[k]]);
        }
        struct places *p = made(g.n, g.xy, PLACES_GRID);
        ck_assert_int_eq(places_rows(p), g.n * (nx > 2 ? 2 : 1) * (ny > 2 ? 2 : 1));
        const double *rows = filled(p, g.n, value);
        for (int i = 0; i < 100; i++) {
            double x = g.x[0] + (g.x[nx - 1] - g.x[0]) * drand48(), y = g.y[0] + (g.y[ny - 1] - g.y[0]) * drand48();
            double at[2] = {x * cos(angle) - y * sin(angle), x * sin(angle) + y * cos(angle)};
            ck_assert_double_eq_tol(smooth(p, rows, at[0], at[1]), polynomial(c, nx, ny, x, y), 1e-9);
            ck_assert_double_eq_tol(mixed(p, line, at[0], at[1]), polynomial(c, 2, 2, x, y), 1e-11);
        }
        for (int k = 0; k < g.n && angle == 0; k++)
            ck_assert(smooth(p, rows, g.xy[2 * k], g.xy[2 * k + 1]) == value[k]); /* a place's own, to the last bit */
    }
    teardown();
}
END_TEST

/* A line is a grid of one row, wherever it runs. */
START_TEST(lines)
{
    setup();
    for (int n = 2; n < 14; n++) {
        double at[14], xy[28], value[14], c[16] = {1, 0, 0, 0, -2, 0, 0, 0, 0.7, 0, 0, 0, 0.3};
        knots(n, 3, at);
        for (int k = 0; k < n; k++) {
            int j = (k * 5 + 2) % n;
            j = n % 5 ? j : k;
            xy[2 * k] = 0.6 * at[j] - 1, xy[2 * k + 1] = 0.8 * at[j] + 2;
            value[k] = polynomial(c, n, 1, at[j], 0);
        }
        struct places *p = made(n, xy, PLACES_LINE);
        const double *rows = filled(p, n, value);
        for (int i = 0; i < 50; i++) {
            double s = at[0] + (at[n - 1] - at[0]) * drand48();
            ck_assert_double_eq_tol(smooth(p, rows, 0.6 * s - 1, 0.8 * s + 2), polynomial(c, n, 1, s, 0), 1e-11);
        }
    }
    teardown();
}
END_TEST

/* Shares of values sum to 1; values that are all 0 around give 0; beyond the outermost lines the nearest point counts.
 */
START_TEST(shares)
{
    setup();
    static struct grid g;
    static double value[64 * 64];
    for (int trial = 0; trial < 30; trial++) {
        lay(&g, 9, 7, 2, 0, 0);
        struct places *p = made(g.n, g.xy, PLACES_GRID);
        for (int k = 0; k < g.n; k++) /* nodal lines: the fifth of y, and beyond it */
            value[k] = g.row[k] == 4 ? 0 : drand48() - 0.5;
        const double *rows = filled(p, g.n, value);
        for (int i = 0; i < 200; i++) {
            double x = 0.05 + 0.3 * drand48(), y = 0.05 + 0.3 * drand48(), sum = 0;
            struct places_sum s;
            double off = places_smooth_at(p, x, y, &s), dx = fmax(fmax(g.x[0] - x, x - g.x[8]), 0),
                   dy = fmax(fmax(g.y[0] - y, y - g.y[6]), 0);
            ck_assert_double_eq_tol(off, sqrt(dx * dx + dy * dy), 1e-9);
            for (int k = 0; k < s.n; k++)
                sum += s.index[k] < g.n ? s.weight[k] : 0;
            ck_assert_double_eq_tol(sum, 1, 1e-15);
        }
        for (int i = 0; i < 50; i++)
            ck_assert(smooth(p, rows, g.x[0] + (g.x[8] - g.x[0]) * drand48(), g.y[4]) == 0);
    }
    teardown();
}
END_TEST

/* Gains 1, 0, 1, 0 on the corners of a rectangle: 0.5 in the middle, in each of the 24 orders of places. */
START_TEST(rectangle)
{
    setup();
    const double corner[4][3] = {{0, 0, 1}, {0.2, 0, 0}, {0.2, 0.1, 1}, {0, 0.1, 0}};
    int orders = 0;
    for (int code = 0; code < 256; code++) {
        int at[4] = {code & 3, code >> 2 & 3, code >> 4 & 3, code >> 6 & 3};
        double xy[8], value[4];
        if ((1 << at[0] | 1 << at[1] | 1 << at[2] | 1 << at[3]) != 15) continue;
        for (int k = 0; k < 4; k++) {
            memcpy(xy + 2 * k, corner[at[k]], 2 * sizeof *xy);
            value[k] = corner[at[k]][2];
        }
        struct places *p = made(4, xy, PLACES_GRID);
        ck_assert_double_eq_tol(mixed(p, value, 0.1, 0.05), 0.5, 1e-15);
        ck_assert_double_eq_tol(smooth(p, filled(p, 4, value), 0.1, 0.05), 0.5, 1e-15);
        ck_assert_double_eq_tol(smooth(p, filled(p, 4, value), 0.05, 0.025), 0.75 * 0.75 + 0.25 * 0.25, 1e-15);
        orders++;
    }
    ck_assert_int_eq(orders, 24);
    teardown();
}
END_TEST

/* Two orders of the same places: the same bits. Mirrored places and values: the same but for rounding (shares at u and
 * 1 - u), values up to 1. */
START_TEST(orders_and_mirrors)
{
    setup();
    static struct grid g;
    static double value[64 * 64], other[2 * 64 * 64], turned[64 * 64], mirror[2 * 64 * 64];
    for (int trial = 0; trial < 30; trial++) {
        double angle = trial % 2 ? 0.3 : 0;
        lay(&g, 3 + trial % 9, 4 + trial % 7, 2, angle, 0);
        for (int k = 0; k < g.n; k++)
            value[k] = drand48() - 0.5;
        for (int k = 0; k < g.n; k++) {
            int j = g.n - 1 - k;
            memcpy(other + 2 * j, g.xy + 2 * k, 2 * sizeof *other);
            turned[j] = value[k];
            mirror[2 * k] = 1 - g.xy[2 * k];
            mirror[2 * k + 1] = g.xy[2 * k + 1];
        }
        struct places *p = made(g.n, g.xy, PLACES_GRID), *q = made(g.n, other, PLACES_GRID),
                      *m = made(g.n, mirror, PLACES_GRID);
        const double *rows = filled(p, g.n, value), *again = filled(q, g.n, turned), *there = filled(m, g.n, value);
        for (int i = 0; i < 200; i++) {
            double s = g.x[0] + (g.x[g.nx - 1] - g.x[0]) * drand48(), t = g.y[0] + (g.y[g.ny - 1] - g.y[0]) * drand48();
            double x = s * cos(angle) - t * sin(angle), y = s * sin(angle) + t * cos(angle);
            ck_assert(smooth(p, rows, x, y) == smooth(q, again, x, y));
            ck_assert(mixed(p, value, x, y) == mixed(q, turned, x, y));
            ck_assert_double_eq_tol(smooth(p, rows, x, y), smooth(m, there, 1 - x, y), 1e-12);
            ck_assert_double_eq_tol(mixed(p, value, x, y), mixed(m, value, 1 - x, y), 1e-12);
        }
    }
    teardown();
}
END_TEST

/* As a file of 6 decimals leaves it, straight and turned; what is moved by more, or lacks a place, is none. */
START_TEST(recognised)
{
    setup();
    static struct grid g;
    for (int trial = 0; trial < 40; trial++) {
        double angle = 3 * (trial - 20) / 20.0;
        lay(&g, 4 + trial % 20, 3 + trial % 11, 2, angle, 0);
        made(g.n, g.xy, PLACES_GRID);
        for (int i = 0; i < 2 * g.n; i++) /* 1e-6 m of some 0.05 to 0.5 m, of steps of 1 to 2 cm */
            g.xy[i] = rint(g.xy[i] * 1e6) / 1e6;
        made(g.n, g.xy, PLACES_GRID);
        made(g.n - 1, g.xy, PLACES_PLANE);
        g.xy[(int)(2 * g.n * drand48())] += 0.001;
        made(g.n, g.xy, PLACES_PLANE);
    }
    teardown();
}
END_TEST

/* The growth of errors is the largest sum of the absolute values of all cardinal splines, one by one, at eighths of
 * each interval; what lies between those may be a little more. */
START_TEST(growth)
{
    setup();
    for (int trial = 0; trial < 300; trial++) {
        int n = 3 + trial % 45;
        double at[48], most = 0;
        knots(n, trial < 45 ? 1 : 1 + trial / 50.0, at);
        struct places_spline s = places_smooth_spline_make(arena, n, at);
        double found = places_smooth_spline_grows(&s, arena), sum[48 * 7] = {0};
        for (int i = 0; i < n; i++) {
            double f[48] = {0}, m[48];
            const double *from[48];
            double *to[48];
            for (int k = 0; k < n; k++)
                from[k] = &f[k], to[k] = &m[k];
            f[i] = 1;
            places_smooth_spline_slopes(&s, 1, from, to);
            for (int k = 0; k < 7 * (n - 1); k++) {
                int cell = k / 7;
                double h = at[cell + 1] - at[cell], u = (k % 7 + 1) / 8.0, v = 1 - u;
                sum[k] += fabs(v * v * (1 + 2 * u) * f[cell] + u * u * (1 + 2 * v) * f[cell + 1] +
                               h * u * v * (v * m[cell] - u * m[cell + 1]));
                most = fmax(most, sum[k]);
            }
        }
        ck_assert_double_eq_tol(found, most, 1e-8 * most); /* 2^-32 is left out */
        if (trial < 45) ck_assert_double_lt(most, 2);
        if (trial % 50 > 47 || trial == 0)
            printf("distances up to 1:%.1f, %d knots: errors grow %.2f times\n", trial < 45 ? 1.0 : 1 + trial / 50.0, n,
                   most);
    }
    double uneven[] = {0, 0, 0.1, 0, 0.11, 0, 0.21, 0, 0.22, 0, 0.5, 0};
    ck_assert_int_eq(places_rows(made(6, uneven, PLACES_LINE)), 6); /* stays linear */
    teardown();
}
END_TEST

/* Value, slope and curvature go on over the lines of a grid. */
START_TEST(goes_on)
{
    setup();
    static struct grid g;
    static double value[64 * 64];
    for (int trial = 0; trial < 20; trial++) {
        lay(&g, 8, 7, 2, 0, 0);
        for (int k = 0; k < g.n; k++)
            value[k] = drand48() - 0.5;
        struct places *p = made(g.n, g.xy, PLACES_GRID);
        const double *rows = filled(p, g.n, value);
        double h = 1e-5, y = g.y[0] + (g.y[6] - g.y[0]) * drand48();
        for (int line = 1; line < 7; line++) { /* second differences to the left and right; values up to 1, third
                                                  derivatives up to 1/(1 cm)^3 */
            double f[5], x = g.x[line];
            for (int k = 0; k < 5; k++)
                f[k] = smooth(p, rows, x + (k - 2) * h, y);
            ck_assert_double_eq_tol(f[2] - f[1], f[3] - f[2], 1e-4);
            ck_assert_double_eq_tol((f[0] - 2 * f[1] + f[2]) / h / h, (f[2] - 2 * f[3] + f[4]) / h / h,
                                    4 * h * 60 / 1e-6);
        }
    }
}
END_TEST

/* ------------------------------------------------------------------ a plate */

static double supported(int n, double x) { return sin(n * pi * x); }

/* Free-free beams: two rigid motions, then Euler and Bernoulli's, in the form that does not cancel. */
static double freed(int n, double x)
{
    static const double root[] = {4.730040744862704, 7.853204624095838, 10.995607838001671};
    if (n < 2) return n == 0 ? 1 : sqrt(3) * (1 - 2 * x);
    double b = n < 5 ? root[n - 2] : (2 * n - 1) * pi / 2, s = n < 8 ? (cosh(b) - cos(b)) / (sinh(b) - sin(b)) : 1;
    double end = n < 8 ? 0.5 * ((1 - s) * exp(b * x) + (1 + s) * exp(-b * x))
                       : exp(-b * x) + (n % 2 ? -1 : 1) * exp(-b * (1 - x));
    return cos(b * x) - s * sin(b * x) + end;
}

struct mode {
    int i, j;
    double f;
};

static int lower(const void *a, const void *b)
{
    const struct mode *p = a, *q = b;
    return (p->f > q->f) - (p->f < q->f);
}

/* Decibels of the differences of the gains of the 50 lowest modes of a plate of 3 to 2 at 400 random places, relative
 * to the gains. */
static double missed(bool is_free, int nx, int ny, bool linear)
{
    static struct mode m[20 * 20];
    static double xy[2 * 100 * 100], value[100 * 100];
    int n = 0;
    double (*f)(int, double) = is_free ? freed : supported, wrong = 0, whole = 0, at[400][2];
    for (int i = 0; i < 20; i++)
        for (int j = 0; j < 20; j++) {
            double a = is_free ? fmax(i - 0.5, 0) * (i > 1) : i, b = is_free ? fmax(j - 0.5, 0) * (j > 1) : j;
            if (is_free ? i + j > 1 : i && j)
                m[n++] = (struct mode){i, j, a * a / 9 + b * b / 4 + (is_free && (i < 2 || j < 2) ? i * j / 12.0 : 0)};
        }
    qsort(m, (size_t)n, sizeof *m, lower);
    for (int k = 0; k < nx * ny; k++)
        xy[2 * k] = 0.3 * (k % nx) / (nx - 1), xy[2 * k + 1] = 0.2 * (k / nx) / (ny - 1);
    for (int q = 0; q < 400; q++)
        at[q][0] = 0.3 * drand48(), at[q][1] = 0.2 * drand48();
    struct places *p = made(nx * ny, xy, PLACES_GRID);
    for (int k = 0; k < 50; k++) {
        for (int i = 0; i < nx * ny; i++)
            value[i] = f(m[k].i, xy[2 * i] / 0.3) * f(m[k].j, xy[2 * i + 1] / 0.2);
        const double *rows = linear ? NULL : filled(p, nx * ny, value);
        for (int q = 0; q < 400; q++) {
            double x = at[q][0], y = at[q][1], exact = f(m[k].i, x / 0.3) * f(m[k].j, y / 0.2),
                   found = linear ? mixed(p, value, x, y) : smooth(p, rows, x, y);
            wrong += (found - exact) * (found - exact);
            whole += exact * exact;
        }
    }
    return 10 * log10(wrong / whole);
}

START_TEST(plates)
{
    setup();
    for (int is_free = 0; is_free < 2; is_free++) {
        double fine = missed(is_free, 33, 23, false), dense = missed(is_free, 75, 50, true),
               coarse = missed(is_free, 33, 23, true);
        printf("%s plate, 50 modes: 33 x 23 places %.1f dB, bilinear %.1f dB; bilinear at 75 x 50 %.1f dB\n",
               is_free ? "free" : "supported", fine, coarse, dense);
        ck_assert_double_lt(fine, -40);
        ck_assert_double_lt(fine, dense);
        ck_assert_double_gt(coarse, -40);
    }
    teardown();
}
END_TEST

UNIT("places_lattice", polynomials, lines, shares, rectangle, orders_and_mirrors, recognised, growth, goes_on, plates)
