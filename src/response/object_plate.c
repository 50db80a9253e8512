/* Thin rectangular plate (Kirchhoff), isotropic or orthotropic with the grain along x (Leissa, Vibration of Plates,
   NASA SP-160, 1969, chapters 4 and 9; Timoshenko and Woinowsky-Krieger, Theory of Plates and Shells, section 85):

       Dx = Ex h^3/(12 (1 - nu_x nu_y)),  Dy likewise,  nu_y = nu_x Ey/Ex,  D1 = nu_x Dy,  Dk = G h^3/12,
       supported all round:  rho h w^2 = Dx kx^4 + 2 (D1 + 2 Dk) kx^2 ky^2 + Dy ky^4,   kx = m pi/a, ky = n pi/b,

   shapes sin(kx x) sin(ky y), masses rho h a b/4. Other edges: object_plate_ritz.

   What thin-plate theory leaves out lowers frequencies, to first order (Mindlin 1951), by k^2/2 (h^2/12 + D/(kappa G
   h)), kappa = 5/6, k^2 = w sqrt(rho h/D), here with D = sqrt(Dx Dy). Across the grain through the thickness wood
   shears more easily than G says. */
#include "response/object_kinds.h"

#include <math.h>

#include "num/eigen.h"
#include "num/real.h"
#include "num/special.h"

struct plate {                      /* of an orthotropic plate; N m, kg/m^2 */
    double dx, dy, coupling, twist; /* E_x h^3/(12(1 - nu_x nu_y)), ..., nu_x dy, G h^3/12 */
    double area_density, thickness, shear;
};

static bool plate_stiffness(const struct object_body *b, struct plate *p, struct err *e)
{
    double h = b->given->thickness, nu = b->poisson, coupled = 1.0 - nu * nu * b->across / b->youngs_modulus;
    if (!(coupled > 0.0))
        return err_set(e, ERR_SCENE,
                       "%s: no material has a poisson of %g with a youngs_modulus_across of %g Pa beside a "
                       "youngs_modulus of %g Pa: poisson^2 must be below the modulus along over the one across",
                       b->key, nu, b->across, b->youngs_modulus);
    double cube = h * h * h / 12.0;
    p->dx = b->youngs_modulus * cube / coupled;
    p->dy = b->across * cube / coupled;
    p->coupling = nu * p->dy;
    p->twist = b->shear * cube;
    p->area_density = b->density * h;
    p->thickness = h;
    p->shear = b->shear;
    return true;
}

static double plate_supported(const void *plate, double kx, double ky)
{
    const struct plate *p = (const struct plate *)plate;
    double x2 = kx * kx, y2 = ky * ky;
    return sqrt((p->dx * x2 * x2 + 2.0 * (p->coupling + 2.0 * p->twist) * x2 * y2 + p->dy * y2 * y2) / p->area_density);
}

static double plate_excess(const void *plate, double w)
{
    const struct plate *p = (const struct plate *)plate;
    double d = sqrt(p->dx * p->dy), k2 = w * sqrt(p->area_density / d), h = p->thickness;
    return 0.5 * k2 * (h * h / 12.0 + d / (5.0 / 6.0 * p->shear * h));
}

/* About how high the modes of a rectangular plate lie: Rayleigh's quotient of products of beam functions (G. B.
   Warburton, Proc. Inst. Mech. Eng. 168, 1954, 371), for orthotropic plates

       rho h w^2 = Dx (pi/a)^4 Gx^4 + Dy (pi/b)^4 Gy^4 + (pi/a)^2 (pi/b)^2 (2 D1 Hx Hy + 4 Dk Jx Jy),

   with his G, H, J of each beam function. A few percent off: it only says how many functions the sums below need.
 */

/* Warburton's G, H, J of the i-th beam function, i = 0, 1, ... */
static void beam_terms(int edges, bool across, int i, double g[3])
{
    bool free_free = edges == EDGES_FREE || across;
    g[0] = edges == EDGES_CANTILEVER && !across ? i + 0.5 : free_free ? i - 0.5 : i + 1.5;
    if (edges == EDGES_CANTILEVER && !across && i == 0) g[0] = 0.597;
    double cross = 2.0 / (g[0] * REAL_PI), twist = free_free ? 6.0 : edges == EDGES_CANTILEVER ? 2.0 : -2.0;
    g[1] = g[0] * g[0] * (1.0 - cross);
    g[2] = g[0] * g[0] * (1.0 + twist / (g[0] * REAL_PI));
    if (free_free && i < 2) {
        g[0] = g[1] = 0.0;
        g[2] = i * 12.0 / (REAL_PI * REAL_PI);
    }
}

static double estimate(const struct object_body *b, const struct plate *p, int i, int k)
{
    double x[3], y[3], sx = REAL_PI / b->given->length, sy = REAL_PI / b->given->width;
    int edges = b->given->edges;
    beam_terms(edges, false, i, x);
    beam_terms(edges, edges == EDGES_CANTILEVER, k, y);
    double x2 = sx * sx * x[0] * x[0], y2 = sy * sy * y[0] * y[0], cross = sx * sx * sy * sy;
    double sum =
        p->dx * x2 * x2 + p->dy * y2 * y2 + cross * (2.0 * p->coupling * x[1] * y[1] + 4.0 * p->twist * x[2] * y[2]);
    return sqrt(fmax(sum, 0.0) / p->area_density);
}

/* (i, k) has at least (i - 1)(k - 1) modes below it. */
static double highest(const struct object_body *b, const struct plate *p, const struct object_limit *limit,
                      struct arena *a)
{
    struct object_list l = {0};
    for (int i = 0; i < limit->most + 2; i++)
        for (int k = 0; k < (limit->most + 4) / (i > 1 ? i - 1 : 1) + 2; k++) {
            double w = estimate(b, p, i, k);
            if (w > 0.0) object_list_add(&l, a, (struct object_mode){.w = w, .a = i, .b = k});
        }
    object_list_cut(&l, limit);
    return l.mode[l.n - 1].w;
}

/* Modes of a thin rectangular plate, isotropic or orthotropic, with any edges, by Rayleigh and Ritz (W. Ritz, Ann.
   Phys. 28, 1909, 737; Leissa, J. Sound Vib. 31, 1973, 257; orthogonal polynomials: R. B. Bhat, J. Sound Vib. 102,
   1985, 493):

       w(x, y) = sum c_mn X_m(xi) Y_n(eta),   xi, eta in [-1, 1],   X, Y orthonormal polynomials that keep the edges'
   geometric conditions (num/special.h: zeros of order 0 free, 1 supported, 2 clamped), K c = rho h w^2 c,   K_(mn)(pq)
   = Dx A_mp d_nq + Dy d_mp A_nq + D1 (B_mp B_qn + B_pm B_nq) + 4 Dk C_mp C_nq, A = int X'' X'',  B_mp = int X_m'' X_p,
   C = int X' X'   (each derivative times 2/length),   M = 1.

   Free edges ask for nothing: their conditions are natural ones, which the sums meet as they converge, exponentially.
   The rigid motions of a free plate are three of the functions; they are left out. Where both ends of an axis are held
   alike, even and odd functions do not mix: two to four smaller problems. K c = mu^-1 c is solved as K^-1 c = mu c, K
   being graded: the low modes are the large mu, so that they, too, have relative precision. Functions are sorted by
   falling degree, which is the order that num/eigen.c likes.

   Functions along x: degree up to k a/2 + MARGIN, k the wave number (rho h w^2/Dx)^(1/4) of the highest mode asked for
   (polynomials need more than pi per wave length); of their products those within a superellipse of degrees. Against
   twice the MARGIN: free and clamped plates, isotropic and orthotropic, 20 to 200 modes, 1:1 to 25:1, are at most 8e-7
   too high, cantilevers 4e-6 (moments are singular in the corners where free and clamped edges meet). The frequency of
   the highest mode is estimated (above); if that was too low all is done again, higher.

   Time grows as the cube of the number of functions per class; at most MOST modes
   are computed, and of plates so narrow that they need more than FUNCTIONS those that FUNCTIONS give (a note says so).
 */

#define MARGIN 9.0

enum { MOST = 400, FUNCTIONS = 700, CLASSES = 4 };

struct axis { /* functions along one axis */
    struct jacobi functions;
    bool halves; /* even and odd ones do not mix */
    int n;
    double *a, *b, *c; /* [n][n], in 1/m^4, 1/m^2, 1/m^2 */
};

struct class
{
    int n, (*term)[2]; /* m, n of each product */
    double *vector;    /* [modes][n], unit length */
    int modes;
};

struct ritz {
    struct plate plate;
    struct axis x, y;
    struct class class[CLASSES];
};

/* ------------------------------------------------------------------ integrals along one axis */

static double dot(const double *w, const double *f, const double *g, int n)
{
    double sum = 0.0;
    for (int i = 0; i < n; i++)
        sum += w[i] * f[i] * g[i];
    return sum;
}

static void axis_integrals(struct axis *s, double length, struct arena *a)
{
    int n = s->n, points = n + 4;
    double *node = ARENA_TAKE(a, double, points), *weight = ARENA_TAKE(a, double, points),
           *row = ARENA_TAKE(a, double, 3 * n);
    double *f[3];
    for (int d = 0; d < 3; d++)
        f[d] = ARENA_TAKE(a, double, n *points);
    special_gauss_legendre(points, node, weight);
    for (int q = 0; q < points; q++) {
        special_jacobi_slopes(&s->functions, n, node[q], row, row + n, row + 2 * n);
        for (int d = 0; d < 3; d++)
            for (int k = 0; k < n; k++)
                f[d][k * points + q] = row[d * n + k];
    }
    double r = 4.0 / (length * length);
    s->a = ARENA_TAKE(a, double, n *n);
    s->b = ARENA_TAKE(a, double, n *n);
    s->c = ARENA_TAKE(a, double, n *n);
    for (int i = 0; i < n; i++)
        for (int k = 0; k < n; k++) {
            s->a[i * n + k] = r * r * dot(weight, f[2] + i * points, f[2] + k * points, points);
            s->b[i * n + k] = r * dot(weight, f[2] + i * points, f[0] + k * points, points);
            s->c[i * n + k] = r * dot(weight, f[1] + i * points, f[1] + k * points, points);
        }
}

static void axis_make(struct axis *s, int ends, double length, double stiffness, double area_density, double w)
{
    double degree = 0.5 * length * sqrt(w * sqrt(area_density / stiffness)) + MARGIN;
    int edge[4][2] = {
        [EDGES_FREE] = {0, 0}, [EDGES_SUPPORTED] = {1, 1}, [EDGES_CLAMPED] = {2, 2}, [EDGES_CANTILEVER] = {0, 2}};
    s->functions = special_jacobi_make(edge[ends][0], edge[ends][1]);
    s->halves = ends != EDGES_CANTILEVER;
    s->n = (int)ceil(fmin(degree, 1e6)) + 1 - edge[ends][0] - edge[ends][1];
}

/* False: too many functions for all modes below w. */
static bool axes_make(struct ritz *r, const struct object_given *g, double w)
{
    int across = g->edges == EDGES_CANTILEVER ? EDGES_FREE : g->edges;
    axis_make(&r->x, g->edges, g->length, r->plate.dx, r->plate.area_density, w);
    axis_make(&r->y, across, g->width, r->plate.dy, r->plate.area_density, w);
    double classes = (r->x.halves ? 2.0 : 1.0) * (r->y.halves ? 2.0 : 1.0);
    return r->x.n <= JACOBI_MOST && r->y.n <= JACOBI_MOST && (double)r->x.n * r->y.n <= FUNCTIONS * classes;
}

/* ------------------------------------------------------------------ one class of symmetry */

static void class_terms(struct class *c, const struct ritz *r, int which, struct arena *a)
{
    int sx = r->x.halves ? 2 : 1, sy = r->y.halves ? 2 : 1;
    if (which >= sx * sy) return;
    c->term = (int(*)[2])arena_take(a, (size_t)(r->x.n * r->y.n), sizeof *c->term);
    for (int m = r->x.n - 1; m >= 0; m--)
        for (int n = r->y.n - 1; n >= 0; n--) {
            if (m % sx != which % sx || n % sy != which / sx) continue;
            double u = (double)m / r->x.n, v = (double)n / r->y.n;
            bool rigid = r->x.functions.b == 0 && r->y.functions.b == 0 && m + n < 2;
            if (rigid || u * u * u + v * v * v > 1.0) continue;
            c->term[c->n][0] = m;
            c->term[c->n++][1] = n;
        }
}

static double stiffness(const struct ritz *r, const int i[2], const int k[2])
{
    const struct plate *p = &r->plate;
    int x = i[0] * r->x.n + k[0], xt = k[0] * r->x.n + i[0], y = i[1] * r->y.n + k[1], yt = k[1] * r->y.n + i[1];
    double sum =
        p->coupling * (r->x.b[x] * r->y.b[yt] + r->x.b[xt] * r->y.b[y]) + 4.0 * p->twist * r->x.c[x] * r->y.c[y];
    if (i[1] == k[1]) sum += p->dx * r->x.a[x];
    if (i[0] == k[0]) sum += p->dy * r->y.a[y];
    return sum / p->area_density;
}

static void make_positive(int n, double *v)
{
    int last = n - 1;
    for (int i = n - 2; i >= 0; i--)
        if (fabs(v[i]) > fabs(v[last]) * (1.0 + 1e-9)) last = i;
    for (int i = 0, turn = v[last] < 0.0; turn && i < n; i++)
        v[i] = -v[i];
}

/* All modes below w, and their vectors, of whose largest coefficients (to 1e-9) the last is positive; false: K is not
   positive definite. */
static bool class_solve(struct ritz *r, int which, double w, struct arena *a, struct object_list *l)
{
    struct class *c = &r->class[which];
    class_terms(c, r, which, a);
    struct arena *room = arena_open();
    double *k = ARENA_TAKE(room, double, (size_t)c->n * c->n), *mu = ARENA_TAKE(room, double, c->n);
    for (int i = 0; i < c->n; i++)
        for (int j = 0; j <= i; j++)
            k[(size_t)i * c->n + j] = stiffness(r, c->term[i], c->term[j]);
    c->modes = eigen_inverse(c->n, k) ? eigen_above(c->n, k, 1.0 / (w * w), a, mu, &c->vector) : -1;
    for (int i = 0; i < c->modes; i++) {
        make_positive(c->n, c->vector + (size_t)i * c->n);
        object_list_add(l, a, (struct object_mode){.w = 1.0 / sqrt(mu[i]), .a = which, .b = i});
    }
    arena_close(room);
    return c->modes >= 0;
}

/* ------------------------------------------------------------------ the plate */

/* All modes below w. */
static bool solve(struct ritz *r, const struct object_body *b, double w, struct arena *a, struct object_list *l)
{
    const struct object_given *g = b->given;
    axes_make(r, g, w);
    axis_integrals(&r->x, g->length, a);
    axis_integrals(&r->y, g->width, a);
    for (int i = 0; i < CLASSES; i++)
        if (!class_solve(r, i, w, a, l)) return false;
    for (int i = 0; i < l->n; i++) {
        l->mode[i].mass = r->plate.area_density * g->length * g->width;
        l->mode[i].excess = plate_excess(&r->plate, l->mode[i].w);
    }
    return true;
}

bool object_plate_ritz(const struct object_body *b, const struct object_limit *limit, struct arena *a,
                       struct object_list *l, struct err *e)
{
    struct object_limit few = {limit->w, limit->most < MOST ? limit->most : MOST, limit->low};
    struct ritz *r = ARENA_TAKE(a, struct ritz, 1);
    if (!plate_stiffness(b, &r->plate, e)) return false;
    double w = fmin(1.08 * highest(b, &r->plate, &few, a), few.w);
    for (;; w = fmin(1.2 * w, few.w)) {
        *r = (struct ritz){.plate = r->plate};
        *l = (struct object_list){.work = r};
        while (!axes_make(r, b->given, w))
            few.w = w = 0.95 * w;
        if (!solve(r, b, w, a, l))
            return err_set(e, ERR_SCENE,
                           "%s: this stiffness is not positive, or so different along and across that numbers do not "
                           "reach: youngs_modulus %g Pa, across %g Pa, shear_modulus %g Pa, poisson %g",
                           b->key, b->youngs_modulus, b->across, b->shear, b->poisson);
        if (l->n >= few.most || w >= few.w) break;
    }
    l->capped = l->n < few.most ? few.w < limit->w : limit->most > MOST;
    object_list_cut(l, &few);
    return true;
}

/* ------------------------------------------------------------------ shapes */

/* Products of functions of x and of y: at one y the sums over n are made once, [m][modes], for all x. */
enum { CHUNK = 64, PLACES = 16 }; /* modes of a block, places at a time */

struct block {        /* up to CHUNK modes of one class */
    int modes, width; /* width: modes, rounded up to a multiple of OBJECT_SUM */
    int n, rows;
    int (*term)[2]; /* [n], m falling */
    int (*row)[2];  /* [rows]: an m, how many terms it has */
    double *c;      /* [n][width], times 2: the mean of phi^2 over the plate is 1 */
    int to[CHUNK];  /* place in phi */
};

struct table {
    struct jacobi x, y;
    int nx, ny, blocks;
    struct block *block;
};

/* phi [count][modes] for functions fx [count][JACOBI_MOST], fy. */
static void block_row(const struct block *k, int count, double (*fx)[JACOBI_MOST], const double *fy, int modes,
                      double *phi)
{
    double at_y[JACOBI_MOST * CHUNK], weight[JACOBI_MOST], sum[CHUNK];
    for (int r = 0, t = 0; r < k->rows; t += k->row[r++][1]) {
        for (int i = 0; i < k->row[r][1]; i++)
            weight[i] = fy[k->term[t + i][1]];
        object_sum(k->row[r][1], k->width, k->c + (size_t)t * k->width, weight, at_y + r * k->width);
    }
    for (int p = 0; p < count; p++) {
        for (int r = 0; r < k->rows; r++)
            weight[r] = fx[p][k->row[r][0]];
        object_sum(k->rows, k->width, at_y, weight, sum);
        for (int i = 0; i < k->modes; i++)
            phi[(size_t)p * modes + k->to[i]] = sum[i];
    }
}

static void row(const struct object *o, int count, const double *x, double y, double *phi)
{
    const struct table *t = (const struct table *)object_inside(o)->table;
    double fx[PLACES][JACOBI_MOST], fy[JACOBI_MOST];
    special_jacobi_values(&t->y, t->ny, 2.0 * y / o->high[1] - 1.0, fy);
    for (int first = 0; first < count; first += PLACES) {
        int n = count - first < PLACES ? count - first : PLACES;
        for (int p = 0; p < n; p++)
            special_jacobi_values(&t->x, t->nx, 2.0 * x[first + p] / o->high[0] - 1.0, fx[p]);
        for (int i = 0; i < t->blocks; i++)
            block_row(&t->block[i], n, fx, fy, o->n, phi + (size_t)first * o->n);
    }
}

static double shapes(const struct object *o, double x, double y, double *phi)
{
    double off = object_nearest(o, &x, &y);
    row(o, 1, &x, y, phi);
    return off;
}

/* The modes of class `which` from mode[*from] on, until the block is full. */
static void block_fill(struct block *k, const struct object *o, int which, int *from, struct arena *a)
{
    const struct class *c = &((const struct ritz *)object_inside(o)->list.work)->class[which];
    const struct object_mode *mode = object_inside(o)->list.mode;
    *k = (struct block){.n = c->n, .term = c->term, .row = (int(*)[2])arena_take(a, JACOBI_MOST, sizeof *k->row)};
    for (; *from < o->n && k->modes < CHUNK; ++*from)
        if (mode[*from].a == which) k->to[k->modes++] = *from;
    k->width = (k->modes + OBJECT_SUM - 1) / OBJECT_SUM * OBJECT_SUM;
    k->c = ARENA_TAKE(a, double, k->n * k->width);
    for (int t = 0; t < k->n; t++) {
        if (t == 0 || c->term[t][0] != c->term[t - 1][0]) k->row[k->rows++][0] = c->term[t][0];
        k->row[k->rows - 1][1]++;
        for (int q = 0; q < k->modes; q++)
            k->c[(size_t)t * k->width + q] = 2.0 * c->vector[(size_t)mode[k->to[q]].b * c->n + t];
    }
}

static void ritz_bind(struct arena *a, struct object *o)
{
    const struct ritz *r = (const struct ritz *)object_inside(o)->list.work;
    struct table *t = ARENA_TAKE(a, struct table, 1);
    t->x = r->x.functions;
    t->y = r->y.functions;
    t->nx = r->x.n;
    t->ny = r->y.n;
    t->block = ARENA_TAKE(a, struct block, o->n / CHUNK + CLASSES);
    o->terms = 0;
    for (int i = 0; i < CLASSES; i++)
        for (int from = 0; from < o->n;) {
            struct block *k = &t->block[t->blocks];
            block_fill(k, o, i, &from, a);
            o->terms += (double)k->rows * k->width;
            t->blocks += k->modes > 0;
        }
    o->shapes = shapes;
    o->row = row;
    object_set_table(o, a, t);
}

static bool list(const struct object_body *b, const struct object_limit *limit, struct arena *a, struct object_list *l,
                 struct err *e)
{
    const struct object_given *g = b->given;
    struct plate p;
    if (g->edges != EDGES_SUPPORTED) return object_plate_ritz(b, limit, a, l, e);
    if (!plate_stiffness(b, &p, e)) return false;
    struct object_sine_law law = {plate_supported, plate_excess, &p, 0.25 * p.area_density * g->length * g->width};
    object_sine_list(b, &law, limit, a, l);
    return true;
}

static void bind(struct arena *a, struct object *o)
{
    const struct object_given *g = object_inside(o)->body->given;
    o->high[0] = g->length;
    o->high[1] = g->width;
    o->flat = true;
    o->radius = sqrt(g->length * g->width / (2.0 * REAL_PI));
    if (g->edges == EDGES_SUPPORTED)
        object_sine_bind(a, o);
    else
        ritz_bind(a, o);
}

const struct object_kind object_plate = {"thin-plate theory", list, bind};
