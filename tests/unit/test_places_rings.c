/* Rings of places: harmonics round a ring against the periodic spline's closed form; polynomials; any order of places,
   turned, mirrored; value and gradient that go on everywhere; nothing but polynomials between kinks. */
#include "response/places.h"

#include "unit.h"

static struct arena *arena;
static const double pi = 3.14159265358979323846;

static void setup(void)
{
    arena = arena_open();
    srand48(23);
}
static void teardown(void) { arena_close(arena); }

enum { MOST = 4000 };

struct set {
    int n;
    double xy[2 * MOST];
};

static void put(struct set *s, const double centre[2], double radius, double angle)
{
    s->xy[2 * s->n] = centre[0] + radius * cos(angle);
    s->xy[2 * s->n++ + 1] = centre[1] + radius * sin(angle);
}

/* Rings of any numbers of places from `least` on, each beginning anywhere; steps outwards 1 to 1.5 times 1 cm. */
static void lay(struct set *s, int rings, int least, bool middle, const double centre[2])
{
    double radius = middle ? 0 : 0.02 + 0.05 * drand48();
    s->n = 0;
    if (middle) put(s, centre, 0, 0);
    for (int j = 0; j < rings; j++) {
        int n = least + (int)(least * drand48());
        double first = 6 * drand48();
        radius += 0.01 * (1 + 0.5 * drand48());
        for (int k = 0; k < n; k++)
            put(s, centre, radius, first + 2 * pi * k / n);
    }
}

static void shuffle(struct set *s, double *value)
{
    for (int k = s->n - 1; k > 0; k--) {
        int other = (int)((k + 1) * drand48());
        for (int c = 0; c < 3; c++) {
            double *p = c < 2 ? &s->xy[2 * k + c] : &value[k], *q = c < 2 ? &s->xy[2 * other + c] : &value[other],
                   was = *p;
            *p = *q;
            *q = was;
        }
    }
}

struct field {
    struct places *p;
    double *rows;
};

static struct field known(const struct set *s, const double *value)
{
    struct field f;
    struct err e = {0};
    int bad;
    ck_assert_msg(places_make(arena, s->n, s->xy, &f.p, &bad, &e), "%s", e.text);
    ck_assert_int_eq(places_kind(f.p), PLACES_PLANE);
    f.rows = ARENA_TAKE(arena, double, places_rows(f.p));
    memcpy(f.rows, value, (size_t)s->n * sizeof *value);
    places_fill(f.p, 1, f.rows);
    return f;
}

static double off_at(const struct field *f, double x, double y, double *off)
{
    struct places_sum s;
    double sum = 0;
    *off = places_smooth_at(f->p, x, y, &s);
    for (int k = 0; k < s.n; k++)
        sum += s.weight[k] * f->rows[s.index[k]];
    return sum;
}

static double at(const struct field *f, double x, double y)
{
    double off, sum = off_at(f, x, y, &off);
    ck_assert(off == 0);
    return sum;
}

/* Of e^(i w k) at k = 0, 1, ... the spline has the slopes i 3 sin w/(2 + cos w) e^(i w k). Inside the ring it goes
   straight to the mean, outside the nearest point counts. */
START_TEST(harmonics)
{
    static struct set s;
    static double value[MOST];
    const double centre[2] = {0.3, -2};
    setup();
    for (int trial = 0; trial < 200; trial++) {
        int n = 5 + trial / 4, order = (int)(n * drand48() / 2);
        double lag = 6 * drand48(), first = 6 * drand48(), w = 2 * pi * order / n, slope = 3 * sin(w) / (2 + cos(w)),
               off;
        s.n = 0;
        for (int k = 0; k < n; k++) {
            value[k] = cos(w * k + lag);
            put(&s, centre, 0.1, first + 2 * pi * k / n);
        }
        shuffle(&s, value);
        struct field f = known(&s, value);
        ck_assert(places_smooth(f.p));
        for (int q = 0; q < 20; q++) {
            double t = n * drand48(), k = floor(t), u = t - k, v = 1 - u, angle = first + 2 * pi * t / n,
                   mean = order ? 0 : cos(lag);
            double want = v * v * (v + 3 * u) * cos(w * k + lag) + u * u * (u + 3 * v) * cos(w * (k + 1) + lag) -
                          u * v * (v * slope * sin(w * k + lag) - u * slope * sin(w * (k + 1) + lag));
            double radius = 0.1 * drand48(),
                   got = off_at(&f, centre[0] + 0.1 * cos(angle), centre[1] + 0.1 * sin(angle), &off);
            ck_assert_double_eq_tol(got, want, 1e-12);
            got = off_at(&f, centre[0] + 0.15 * cos(angle), centre[1] + 0.15 * sin(angle), &off);
            ck_assert_double_eq_tol(got, want, 1e-12);
            ck_assert_double_eq_tol(off, 0.05, 1e-14);
            got = at(&f, centre[0] + radius * cos(angle), centre[1] + radius * sin(angle));
            ck_assert_double_eq_tol(got, mean + radius / 0.1 * (want - mean), 1e-12);
        }
    }
    teardown();
}
END_TEST

static double cubic(const double *c, double x, double y)
{
    double sum = 0;
    for (int i = 0, k = 0; i < 4; i++)
        for (int j = 0; i + j < 4; j++, k++)
            sum += c[k] * pow(10 * x, i) * pow(10 * y, j);
    return sum;
}

/* Polynomials of degree 3 round a middle: their third harmonics come out to (3 h)^4/384 of the angles' step h, 3e-6 at
   150 places. In a ring's width, cubics of the radius come out to rounding: no angle, no error. */
START_TEST(polynomials)
{
    static struct set s;
    static double value[MOST];
    setup();
    for (int trial = 0; trial < 30; trial++) {
        bool middle = trial % 2;
        double centre[2] = {drand48() - 0.5, drand48() - 0.5}, c[16];
        int rings = 3 + (int)(6 * drand48());
        lay(&s, rings, middle ? 150 : 5, middle, centre);
        for (int i = 0; i < 16; i++)
            c[i] = 2 * drand48() - 1;
        c[9] *= middle || rings > 3; /* three knots make a parabola */
        double least = 9, most = 0;
        for (int k = 0; k < s.n; k++) {
            double x = s.xy[2 * k] - centre[0], y = s.xy[2 * k + 1] - centre[1], r = sqrt(x * x + y * y);
            value[k] = middle ? cubic(c, x, y) : cubic(c, r, 0);
            least = fmin(least, r);
            most = fmax(most, r);
        }
        shuffle(&s, value);
        struct field f = known(&s, value);
        for (int q = 0; q < 100; q++) {
            double r = least + (most - least) * drand48(), angle = 6.3 * drand48(), x = r * cos(angle),
                   y = r * sin(angle);
            ck_assert_double_eq_tol(at(&f, centre[0] + x, centre[1] + y), middle ? cubic(c, x, y) : cubic(c, r, 0),
                                    middle ? 1e-5 : 1e-11);
        }
        for (int k = 0; k < s.n; k++)
            ck_assert_double_eq_tol(at(&f, s.xy[2 * k], s.xy[2 * k + 1]), value[k], 1e-11);
    }
    teardown();
}
END_TEST

/* Random values: the same bits from any order; of places turned and mirrored the same to rounding. */
START_TEST(order_tells_nothing)
{
    static struct set s, turned;
    static double value[MOST], other[MOST];
    setup();
    for (int trial = 0; trial < 40; trial++) {
        double centre[2] = {drand48(), drand48()}, angle = 6.3 * drand48(), c = cos(angle), d = sin(angle);
        lay(&s, 1 + trial % 6, 5 + trial % 7, trial % 3 == 0, centre);
        turned.n = s.n;
        for (int k = 0; k < s.n; k++) {
            value[k] = other[k] = drand48() - 0.5;
            turned.xy[2 * k] = c * s.xy[2 * k] + d * s.xy[2 * k + 1] + 0.7; /* a mirror, and a turn */
            turned.xy[2 * k + 1] = d * s.xy[2 * k] - c * s.xy[2 * k + 1];
        }
        struct field f = known(&s, value);
        shuffle(&turned, other);
        struct field m = known(&turned, other);
        shuffle(&s, value);
        struct field g = known(&s, value);
        for (int q = 0; q < 200; q++) {
            double x = centre[0] + 0.3 * (drand48() - 0.5), y = centre[1] + 0.3 * (drand48() - 0.5), off[3];
            double a = off_at(&f, x, y, &off[0]), b = off_at(&g, x, y, &off[1]),
                   e = off_at(&m, c * x + d * y + 0.7, d * x - c * y, &off[2]);
            ck_assert(a == b && off[0] == off[1]);
            ck_assert_double_eq_tol(a, e, 1e-11);
            ck_assert_double_eq_tol(off[0], off[2], 1e-13);
        }
    }
    teardown();
}
END_TEST

static int up(const void *a, const void *b)
{
    double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

/* Where a straight way meets the rings about the origin and the lines from there through the places; in order, each
 * once. Returns how many. */
static int crossings(const struct set *s, const double from[2], const double to[2], double *u)
{
    double by[2] = {to[0] - from[0], to[1] - from[1]}, square = by[0] * by[0] + by[1] * by[1],
           along = -(from[0] * by[0] + from[1] * by[1]) / square;
    double side = fabs(from[0] * by[1] - from[1] * by[0]) / sqrt(square);
    int all = 0, n = 0;
    u[all++] = along;
    for (int k = 0; k < s->n; k++) {
        const double *p = s->xy + 2 * k;
        double far = hypot(p[0], p[1]), half = far > side ? sqrt((far * far - side * side) / square) : 0,
               across = p[0] * by[1] - p[1] * by[0];
        u[all++] = along - half;
        u[all++] = along + half;
        u[all++] = across != 0 ? (p[1] * from[0] - p[0] * from[1]) / across : along;
    }
    qsort(u, (size_t)all, sizeof *u, up);
    for (int k = 0; k < all; k++)
        if (u[k] > 1e-12 && u[k] < 1 - 1e-12 && (n == 0 || u[k] - u[n - 1] > 1e-9)) u[n++] = u[k];
    return n;
}

/* Random values along random ways: neither value nor slope jumps, through rings and through the middle; and from
   kink to kink it is analytic: 25 Chebyshev points tell what is between them. */
START_TEST(goes_on_everywhere)
{
    static struct set s;
    static double value[MOST], u[3 * MOST + 1];
    setup();
    for (int trial = 0; trial < 60; trial++) {
        double centre[2] = {0, 0};
        lay(&s, 3 + trial % 4, 8, trial % 2, centre);
        for (int k = 0; k < s.n; k++)
            value[k] = drand48() - 0.5;
        struct field f = known(&s, value);
        double reach = 0, from[2], to[2], off;
        for (int k = 0; k < s.n; k++)
            reach = fmax(reach, hypot(s.xy[2 * k], s.xy[2 * k + 1]));
        double angle = 6.3 * drand48(), side = trial % 3 ? (0.15 + 0.35 * drand48()) * reach : 0, along = 0.8 * reach;
        from[0] = -along * cos(angle) - side * sin(angle), from[1] = -along * sin(angle) + side * cos(angle);
        to[0] = along * cos(angle) - side * sin(angle), to[1] = along * sin(angle) + side * cos(angle);
        int n = crossings(&s, from, to, u);
        ck_assert_int_gt(n, 0);
        for (int k = 0; k < n; k++) { /* h = 1e-6: slopes there are up to 1000/m and change by 1e6/m^2 at most */
            double h = 1e-6, w[2] = {(to[0] - from[0]) / (2 * along), (to[1] - from[1]) / (2 * along)}, v[4];
            double x = from[0] + u[k] * (to[0] - from[0]), y = from[1] + u[k] * (to[1] - from[1]);
            for (int i = 0; i < 4; i++)
                v[i] = off_at(&f, x + (i - 1.5) * h * w[0], y + (i - 1.5) * h * w[1], &off);
            ck_assert_double_le(fabs(v[2] - v[1]), 2e-3);
            if (trial % 2) /* without a middle, values go to the mean of the innermost ring straight */
                ck_assert_double_le(fabs((v[3] - v[2]) - (v[1] - v[0])), 4e-5);
        }
        for (int k = 0; k + 1 < n; k++) {
            enum { N = 24 };
            double a = u[k] + 1e-9, b = u[k + 1] - 1e-9, y[N + 1], worst = 0, sum = 0, weight = 0, want;
            double probe = a + (b - a) * 0.03;
            if (b - a < 1e-3) continue;
            for (int i = 0; i <= N; i++) {
                double t = 0.5 * (a + b) - 0.5 * (b - a) * cos(pi * i / N),
                       w = (i % 2 ? -1 : 1) * (i % N ? 1 : 0.5) / (probe - t);
                y[i] = off_at(&f, from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1]), &off);
                worst = fmax(worst, fabs(y[i]));
                sum += w * y[i];
                weight += w;
            }
            want = off_at(&f, from[0] + probe * (to[0] - from[0]), from[1] + probe * (to[1] - from[1]), &off);
            if (trial % 3) /* not through the middle itself, where the angle turns at once */
                ck_assert_msg(fabs(sum / weight - want) < 1e-6 * (1 + worst), "trial %d, piece %d of %d: off by %g",
                              trial, k, n, sum / weight - want);
        }
    }
    teardown();
}
END_TEST

/* A place moved by 1 % of its ring's radius, or one lacking: triangles, linear. Places as a file rounds them: still
 * rings. */
START_TEST(what_is_a_ring)
{
    static struct set s;
    static double value[MOST];
    const double centre[2] = {0.1, 0.2};
    setup();
    for (int trial = 0; trial < 40; trial++) {
        lay(&s, 4, 8, trial % 2, centre);
        for (int i = 0; i < 2 * s.n; i++)
            s.xy[i] = rint(s.xy[i] * 1e6) / 1e6;
        ck_assert(places_smooth(known(&s, value).p));
        int which = trial % 2 + (int)((s.n - 1) * drand48());
        s.xy[2 * which] += 0.01 * hypot(s.xy[2 * which] - centre[0], s.xy[2 * which + 1] - centre[1]);
        struct field f = known(&s, value);
        ck_assert(!places_smooth(f.p) && places_rows(f.p) == s.n);
        memmove(s.xy + 2 * which, s.xy + 2 * which + 2, 2 * (size_t)(s.n - 1 - which) * sizeof *s.xy);
        s.n--;
        ck_assert(!places_smooth(known(&s, value).p));
    }
    teardown();
}
END_TEST

UNIT("places_rings", harmonics, polynomials, order_tells_nothing, goes_on_everywhere, what_is_a_ring)
