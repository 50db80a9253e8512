/* The interpolation error of a mode table.

   Complex gains A_i of all modes i at the places x_q of a test, and what the table's places give there by the rules of
   a scene (response/morph.c):

       error^2 = sum_q sum_i |A_i'(x_q) - A_i(x_q)|^2 / sum_q sum_i |A_i(x_q)|^2.

   The test's places are the same in every run: SPOTS of them, by Kronecker's sequence, on the line or over the box of
   the places; those beside the object or beyond the hull of the table's places are left out.

   As many places as needed: from 5 lines each way that axis gets a quarter more lines, two at least, that brings the
   most decibels for the logarithm of the number of places (or both do; and both get them where no step brings STUCK),
   until the goal is met; then lines are taken away two by two as long as it is. The numbers are odd: what is symmetric
   has a place in its middle. */
#include "cmd/modes.h"

#include <math.h>
#include <stdlib.h>

#include "base/text.h"
#include "cmd/message.h"
#include "num/real.h"
#include "response/morph.h"

enum { SPOTS = 512, FIT_PLACES = 4096, FIT_ROWS = 500000 };
#define STUCK 1.0 /* dB */

static double share(int i, double ratio)
{
    double x = 0.5 + (i + 1) * ratio;
    return x - floor(x);
}

/* Where the test is made, and the gains there, re and im after each other. */
static void make_test(struct modes_fit *f, const struct modes_places *p)
{
    struct modes_point at = modes_point_make(f->arena, f->n);
    f->test = ARENA_TAKE(f->arena, double, 2 * (size_t)SPOTS * (size_t)f->n);
    f->spot = arena_take(f->arena, SPOTS, sizeof *f->spot);
    for (int q = 0; q < SPOTS; q++) {
        double u = share(q, p->line ? 0.6180339887498949 : 0.7548776662466927),
               v = p->line ? u : share(q, 0.5698402909980532);
        double x = p->from[0] + u * (p->to[0] - p->from[0]), y = p->from[1] + v * (p->to[1] - p->from[1]);
        if (!(f->at(f->self, x, y, &at) <= 1e-9)) continue;
        f->spot[f->spots][0] = x;
        f->spot[f->spots][1] = y;
        double *to = f->test + 2 * (size_t)f->spots++ * (size_t)f->n;
        for (int i = 0; i < f->n; i++) {
            to[i] = at.re[i];
            to[f->n + i] = at.im[i];
        }
    }
}

double modes_places_error(struct modes_fit *f, const struct modes_places *p)
{
    struct arena *a = arena_open();
    struct modes_point *at = ARENA_TAKE(a, struct modes_point, p->n);
    struct modes m;
    struct err e = {0};
    double db = NAN;
    if (!f->test) make_test(f, p);
    for (int k = 0; k < p->n; k++) {
        at[k] = modes_point_make(a, f->n);
        f->at(f->self, p->xy[k][0], p->xy[k][1], &at[k]);
    }
    if (p->n > 1 &&
        morph_points(&(struct morph_points_ask){f->n, p->n, (const double(*)[2])p->xy, at, f->shared}, a, &m, &e)) {
        struct modes_point there = modes_point_make(a, f->n);
        double wrong = 0, whole = 0;
        for (int q = 0; q < f->spots; q++) {
            const double *re = f->test + 2 * (size_t)q * (size_t)f->n, *im = re + f->n;
            if (modes_at(&m, &(struct modes_where){.x = f->spot[q][0], .y = f->spot[q][1]}, &there) > 0) continue;
            for (int i = 0; i < f->n; i++) {
                double x = there.re[i] - re[i], y = there.im[i] - im[i];
                wrong += x * x + y * y;
                whole += re[i] * re[i] + im[i] * im[i];
            }
        }
        db = whole > 0 ? 10 * real_log10(fmax(wrong / whole, 1e-30)) : NAN;
    }
    arena_close(a);
    return db;
}

static const char *db_text(double db, struct arena *a)
{
    return db < -200 ? "less than -200 dB" : arena_format(a, "%.1f dB", db);
}

void modes_places_write(FILE *f, double db, const struct modes_places *p, struct arena *a)
{
    if (p->ring[1] > 0)
        fprintf(f, "# rings: places at radii from %.9g to %.9g m, where the surface has no edge\n", p->ring[0],
                p->ring[1]);
    if (isnan(db)) return;
    fprintf(f,
            "# interpolation_error: %s, rms of the differences of all modes' gains at %d places %s, relative to the "
            "gains\n",
            db_text(db, a), SPOTS, p->line ? "along the line" : "over the box of these, those beside left out");
}

void modes_places_report(const char *file, const struct modes_places *p, const char *what, double db, int n,
                         const double range[2], struct arena *a)
{
    printf("%s: %d mode%s from %.6g to %.6g Hz at %d place%s", text_shown(a, file), n, n == 1 ? "" : "s", range[0],
           range[1], p->n, p->n == 1 ? "" : "s");
    if (p->left_out) printf(" (%d of the grid lie beside the %s)", p->left_out, what);
    if (!isnan(db)) printf("; between them gains are off by %s", db_text(db, a));
}

void modes_places_warn(struct cmd_call *c, double db, const struct modes_places *p)
{
    if (p->chosen && db > MODES_FIT_GOAL && !args_given(&c->args, "quiet"))
        message_remark(
            c, "modes",
            arena_format(c->arena,
                         "between the places gains are off by %s, and %g dB would take more than %d places or "
                         "%d rows; fewer modes (--modes, --top) need fewer",
                         db_text(db, c->arena), MODES_FIT_GOAL, FIT_PLACES, FIT_ROWS));
}

/* ------------------------------------------------------------------ as many as needed */

/* Lays so many places out. */
typedef void fit_lay(const void *self, const int n[2], struct arena *a, struct modes_places *p);

struct growing {
    struct modes_fit *fit;
    fit_lay *lay;
    const void *self;
    long most;
};

static double error_of(const struct growing *g, const int n[2], int *places)
{
    struct arena *a = arena_open();
    struct modes_places p = {0};
    g->lay(g->self, n, a, &p);
    double db = p.n > g->most ? NAN : p.n > 1 ? modes_places_error(g->fit, &p) : 0;
    *places = p.n;
    arena_close(a);
    return db;
}

static int more(int n) { return n + 2 * (n / 8 > 1 ? n / 8 : 1); }

struct step {
    int n[2], places;
    double db;
};

/* One step; false: there is no room for any. */
static bool grow(const struct growing *g, int axes, struct step *now)
{
    struct step best = {.places = 0}, try = *now;
    double most = -HUGE_VAL;
    for (int which = 1; which < 1 << axes; which++) {
        try.n[0] = which & 1 ? more(now->n[0]) : now->n[0];
        try.n[1] = which & 2 ? more(now->n[1]) : now->n[1];
        try.db = error_of(g, try.n, &try.places);
        double brings = (now->db - try.db) / real_log((double)try.places / now->places);
        if (try.places > g->most || isnan(brings) || brings < most) continue;
        most = brings;
        best = try;
    }
    if (best.places > 0 && best.db > now->db - STUCK && try.places <= g->most && !isnan(try.db))
        best = try; /* the last, all axes */
    if (best.places > 0) *now = best;
    return best.places > 0;
}

static void choose(struct modes_fit *f, fit_lay *lay, const void *self, bool line, struct modes_places *p)
{
    long rows = FIT_ROWS / f->n;
    struct growing g = {f, lay, self, rows < 153 ? 153 : rows > FIT_PLACES ? FIT_PLACES : rows};
    struct step now = {.n = {5, line ? 1 : 5}};
    int axes = line ? 1 : 2;
    now.db = error_of(&g, now.n, &now.places);
    while (now.db > MODES_FIT_GOAL && grow(&g, axes, &now))
        ;
    for (int axis = axes; axis-- > 0 && now.db <= MODES_FIT_GOAL;)
        for (int of; now.n[axis] > 5; now.n[axis] -= 2)
            if (!(error_of(&g, (int[2]){now.n[0] - 2 * (axis == 0), now.n[1] - 2 * (axis == 1)}, &of) <=
                  MODES_FIT_GOAL))
                break;
    lay(self, now.n, f->arena, p);
    p->chosen = true;
}

/* Places on an object: --line, --circle, --grid, --at, else what suits its shape. */

enum { PLACES = 100000 };

static void add(struct modes_places *p, double x, double y)
{
    p->xy[p->n][0] = x;
    p->xy[p->n++][1] = y;
}

/* ends: x0, y0, x1, y1. Exact at both ends and in the middle. */
static void line(struct modes_places *p, const double ends[4], int n, struct arena *a)
{
    *p = (struct modes_places){.xy = arena_take(a, (size_t)n, sizeof *p->xy),
                               .line = true,
                               .from = {ends[0], ends[1]},
                               .to = {ends[2], ends[3]}};
    for (int i = 0; i < n; i++) {
        double u = n > 1 ? (double)i / (n - 1) : 0.0;
        add(p, ends[0] + u * (ends[2] - ends[0]), ends[1] + u * (ends[3] - ends[1]));
    }
}

static void grid(struct modes_places *p, const struct modes_ground *g, const int n[2], struct arena *a)
{
    *p = (struct modes_places){.xy = arena_take(a, (size_t)n[0] * (size_t)n[1], sizeof *p->xy),
                               .from = {g->low[0], g->low[1]},
                               .to = {g->high[0], g->high[1]}};
    for (int j = 0; j < n[1]; j++)
        for (int i = 0; i < n[0]; i++) {
            double x = g->low[0] + (g->high[0] - g->low[0]) * i / (n[0] - 1),
                   y = g->low[1] + (g->high[1] - g->low[1]) * j / (n[1] - 1);
            if (g->off(g->self, x, y) <= 1e-9)
                add(p, x, y);
            else
                p->left_out++;
        }
}

static bool all_on(const struct modes_ground *g, const struct modes_places *p, struct err *e)
{
    for (int i = 0; i < p->n; i++) {
        double off = g->off(g->self, p->xy[i][0], p->xy[i][1]);
        if (off > 1e-9 && isfinite(off))
            return err_set(e, ERR_SCENE,
                           "the place (%.9g, %.9g) m lies %.3g m off the object, which spans x from %.9g to %.9g m and "
                           "y from %.9g to %.9g m",
                           p->xy[i][0], p->xy[i][1], off, g->low[0], g->high[0], g->low[1], g->high[1]);
        if (off > 1e-9)
            return err_set(e, ERR_SCENE,
                           "the place (%.9g, %.9g) m lies off the object, which spans x from %.9g to %.9g m and y from "
                           "%.9g to %.9g m%s",
                           p->xy[i][0], p->xy[i][1], g->low[0], g->high[0], g->low[1], g->high[1],
                           g->remark ? g->remark : "");
    }
    return p->n > 0 ||
           err_set(e, ERR_SCENE,
                   "none of the %d places of the grid lies on the object; take a finer one, or --line or --at",
                   p->left_out);
}

struct layout { /* for struct modes_fit */
    const struct modes_ground *ground;
    double ends[4], round[2]; /* m: radii of what is round */
};

enum { RAYS = 120, STEPS = 100, FEW = 2 };
#define ROUND 0.02 /* of the radius: a mesh has corners */

/* Is the ground there, and at `from` (below 0: anywhere) on the same side of all its edges? Shares of a ray. */
static bool goes_on(const struct modes_ground *g, const double middle[2], const double ray[2], double from, double at)
{
    double was[2] = {middle[0] + from * ray[0], middle[1] + from * ray[1]};
    double is[2] = {middle[0] + at * ray[0], middle[1] + at * ray[1]};
    return g->off(g->self, is[0], is[1]) <= 1e-9 && !(from >= 0 && g->bends && g->bends(g->self, was, is));
}

/* The longest stretch of a ray from the middle on which there is ground without an edge, as shares of the ray. */
static void longest(const struct modes_ground *g, const double middle[2], const double ray[2], double edge[2])
{
    double begin = 0, last = -1; /* last: of the stretch; below 0: there is none */
    edge[0] = edge[1] = 0;
    for (int k = 0; k <= STEPS + 1; k++) {
        double at = k == 0 ? 1e-6 : (double)k / STEPS;
        bool on = k <= STEPS && goes_on(g, middle, ray, last, at), was = last >= 0;
        double low = was ? last : (double)(k - 1) / STEPS, high = at;
        for (int pass = 0; pass < 40 && on != was && k > 0; pass++) {
            double half = 0.5 * (low + high);
            *(goes_on(g, middle, ray, last, half) == was ? &low : &high) = half;
        }
        if (was && !on && low - begin > edge[1] - edge[0]) {
            edge[0] = begin;
            edge[1] = low;
        }
        if (was && !on) /* beyond an edge another stretch may begin */
            on = k <= STEPS && goes_on(g, middle, ray, -1, at);
        else if (was || !on)
            high = begin;
        begin = on ? (k == 0 ? 0 : high) : begin;
        last = on ? at : -1;
    }
}

/* Is the ground a disk round the middle of its box, or a ring? Its radii, inside it by what rounding may take, and by
   as much as radii differ: between rays they may differ a little more. */
static bool is_round(const struct modes_ground *g, double radii[2])
{
    double middle[2] = {0.5 * (g->low[0] + g->high[0]), 0.5 * (g->low[1] + g->high[1])};
    double reach = 0.5 * (g->high[0] - g->low[0]), least[2] = {reach, reach}, most[2] = {0, 0};
    if (!(fabs(g->high[1] - g->low[1] - 2 * reach) <= ROUND * reach)) return false;
    for (int k = 0; k < RAYS; k++) {
        double c = real_cospi(2.0 * k / RAYS), s = real_sinpi(2.0 * k / RAYS), edge[2];
        longest(g, middle, (double[2]){reach * c, reach * s}, edge);
        for (int i = 0; i < 2; i++) {
            least[i] = fmin(least[i], reach * edge[i]);
            most[i] = fmax(most[i], reach * edge[i]);
        }
    }
    radii[0] = most[0] > 0 ? 2 * most[0] - least[0] + 1e-9 * reach : 0;
    radii[1] = 2 * least[1] - most[1] - 1e-9 * reach;
    return most[0] - least[0] <= ROUND * reach && most[1] - least[1] <= ROUND * reach && radii[0] < radii[1];
}

/* n[0] rings, the rim's of 4 n[1] places, the others' in proportion to their radius, and FEW more near the middle.
   Rings are closer together near a rim, where a solid that is seen there from its side bends away, and where the spline
   has neighbours on one side only. Numbers of places are multiples of 4: what is symmetric has its places so. */
static void lay_rings(const void *self, const int n[2], struct arena *a, struct modes_places *p)
{
    const struct layout *l = self;
    const struct modes_ground *g = l->ground;
    double middle[2] = {0.5 * (g->low[0] + g->high[0]), 0.5 * (g->low[1] + g->high[1])};
    *p = (struct modes_places){.xy = arena_take(a, 1 + 4 * (size_t)n[0] * (size_t)(n[1] + FEW), sizeof *p->xy),
                               .from = {g->low[0], g->low[1]},
                               .to = {g->high[0], g->high[1]}};
    bool hole = l->round[0] > 0;
    p->ring[0] = l->round[0], p->ring[1] = l->round[1];
    if (!hole) add(p, middle[0], middle[1]);
    for (int j = !hole; j < n[0] + !hole; j++) {
        double u = hole ? 0.5 - 0.5 * real_cospi((double)j / (n[0] - 1)) : real_sinpi(0.3 * j / n[0]) / real_sinpi(0.3);
        double radius = l->round[0] + u * (l->round[1] - l->round[0]), share = radius / l->round[1];
        int count = 4 * (int)ceil(n[1] * share + FEW * (1 - share) - 1e-9);
        for (int k = 0; k < count; k++)
            add(p, middle[0] + radius * real_cospi(2.0 * k / count), middle[1] + radius * real_sinpi(2.0 * k / count));
    }
}

static void lay_line(const void *self, const int n[2], struct arena *a, struct modes_places *p)
{
    line(p, ((const struct layout *)self)->ends, n[0], a);
}

static void lay_grid(const void *self, const int n[2], struct arena *a, struct modes_places *p)
{
    grid(p, ((const struct layout *)self)->ground, n, a);
}

static void along(struct cmd_call *c, const struct modes_ground *g, const double ends[4], int n, struct modes_places *p)
{
    struct layout l = {.ends = {ends[0], ends[1], ends[2], ends[3]}};
    if (g->fit)
        choose(g->fit, lay_line, &l, true, p);
    else
        line(p, ends, n, c->arena);
}

static bool read(struct cmd_call *c, double ends[4], long *places, int n[2], struct err *e)
{
    static const long counts[2] = {2, PLACES};
    const struct args *g = &c->args;
    if (!modes_lengths(c, "line", "X0,Y0,X1,Y1", 4, ends, e) || !modes_lengths(c, "circle", "RADIUS", 1, ends, e) ||
        !modes_lengths(c, "at", "X,Y", 2, ends, e))
        return false;
    const char *text = args_value(g, "grid");
    char *comma, *end;
    long x = text ? strtol(text, &comma, 10) : 2, y = !text ? 2 : *comma == ',' ? strtol(comma + 1, &end, 10) : 0;
    if (y < 2 || x < 2 || x > 1000 || y > 1000 || x * y > PLACES || (text && *end))
        return err_set(
            e, ERR_USAGE,
            "--grid: '%s' is not of the form NX,NY, whole numbers from 2 to 1000, at most %d places in all, as in 17,9",
            text, PLACES);
    n[0] = (int)x;
    n[1] = (int)y;
    if (!args_whole(g, "places", counts, places, e)) return false;
    if (args_given(g, "line") + args_given(g, "circle") + args_given(g, "at") + args_given(g, "grid") > 1)
        return err_set(e, ERR_USAGE, "--line, --circle, --grid and --at exclude each other");
    return !args_given(g, "places") || args_given(g, "line") || args_given(g, "circle") ||
           err_set(e, ERR_USAGE, "--places needs --line or --circle");
}

struct spot {
    double nm[2];
    int index;
};

static int by_place(const void *p, const void *q)
{
    const struct spot *a = p, *b = q;
    for (int c = 0; c < 2; c++)
        if (a->nm[c] != b->nm[c]) return a->nm[c] < b->nm[c] ? -1 : 1;
    return (a->index > b->index) - (a->index < b->index);
}

bool modes_places_distinct(const struct modes_places *p, struct arena *a, int *bad, struct err *e)
{
    struct spot *s = ARENA_TAKE(a, struct spot, p->n);
    for (int i = 0; i < p->n; i++)
        s[i] = (struct spot){{rint(p->xy[i][0] * 1e9), rint(p->xy[i][1] * 1e9)}, i};
    qsort(s, (size_t)p->n, sizeof *s, by_place);
    for (int i = 1; i < p->n; i++)
        if (s[i].nm[0] == s[i - 1].nm[0] && s[i].nm[1] == s[i - 1].nm[1]) {
            *bad = s[i].index;
            return err_set(
                e, ERR_SCENE,
                "the place (%.9g, %.9g) m is there twice, and a scene takes no table of such; --at X,Y is one place",
                p->xy[*bad][0], p->xy[*bad][1]);
        }
    return true;
}

bool modes_places(struct cmd_call *c, const struct modes_ground *g, struct modes_places *p, struct err *e)
{
    double ends[4] = {0};
    int n[2];
    long places = 33;
    *p = (struct modes_places){0};
    if (!read(c, ends, &places, n, e)) return false;
    if (args_given(&c->args, "at"))
        line(p, ends, 1, c->arena);
    else if (args_given(&c->args, "grid"))
        grid(p, g, n, c->arena);
    else if (args_given(&c->args, "circle")) {
        double radius = ends[0];
        *p = (struct modes_places){.xy = arena_take(c->arena, (size_t)places, sizeof *p->xy),
                                   .from = {-radius, -radius},
                                   .to = {radius, radius}};
        for (int i = 0; i < places; i++)
            add(p, radius * real_cospi(2.0 * i / (int)places), radius * real_sinpi(2.0 * i / (int)places));
    } else if (args_given(&c->args, "line") && args_given(&c->args, "places"))
        line(p, ends, (int)places, c->arena);
    else if (args_given(&c->args, "line"))
        along(c, g, ends, (int)places, p);
    else if (g->standard[0] == 1)
        line(p, (double[4]){g->at[0], g->at[1], g->at[0], g->at[1]}, 1, c->arena);
    else if (g->standard[1] == 1) {
        double middle = 0.5 * (g->low[1] + g->high[1]);
        along(c, g, (double[4]){g->low[0], middle, g->high[0], middle}, g->standard[0], p);
    } else if (g->fit) {
        struct layout l = {.ground = g};
        choose(g->fit, is_round(g, l.round) ? lay_rings : lay_grid, &l, false, p);
    } else
        grid(p, g, g->standard, c->arena);
    int bad;
    return all_on(g, p, e) && modes_places_distinct(p, c->arena, &bad, e);
}
