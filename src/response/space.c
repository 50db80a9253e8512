/* Modes of an object in the space of materials and shapes: between wood, metal and glass (a place in a unit disk) and
   between bar, plate and shell (dimension 1 to 3). The anchors, and their shares w_k at a place, follow below;
   what is interpolated, mode by mode in the order of frequency:

     ln f_i = ln f_1 + sum_k w_k ((1 - u) R_dk,i + u R_(d+1)k,i),   d <= dimension = d + u < d + 1,  R = ln(f_i/f_1) of
   the anchor in that shape ln decay_i = sum_k w_k ln decay_k(2 pi f_i)                     the materials' laws of
   damping at the mode's own frequency ln g_i = ln g_1 + (1 - u) G_d,i + u G_(d+1),i                   gains depend on
   the shape only

   (logarithms, since ratios are what is heard; shares of bar, plate and shell as 004 gives none). Modes keep their
   order, none crosses another; every decay lies between those of the anchors, so that all are stable. h_i(t) = g_i
   e^(-s t) (cos w t - (s/w) sin w t), w^2 = (2 pi f_i)^2 - s^2: the velocity of a damped mode.

   A place that moves goes straight from `from` to `to` in proportion to the share of the motion's duration that has
   passed, the dimension likewise. Modes that reach half the sample rate then fade (raised cosine from 0.45 to 0.5 of
   it). The modes are the lowest `modes` ones of those that somewhere on the way lie in the band. */
#include "response/space.h"

#include <gsl/gsl_sort.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "num/real.h"
#include "num/vecmath.h"
#include "scene/material.h"
#include "scene/rows.h"
#include "scene/scene_part.h"

/* Anchors of the space of materials (papers/004, "Intuitive Sound-Synthesis Control"; its source is Aramaki, Besson,
   Kronland-Martinet, Ystad, Controlling the perceived material in an impact sound synthesizer, IEEE TASLP 2011). 004
   puts wood, metal and glass on the rim of a unit disk and says that spectral and damping parameters are interpolated
   by the distance to them; it prints neither their values nor, for materials, the rule. Ours:

   Shares. As 004 does for interactions (equations 8 to 11), with wood, metal, glass at theta_k = 0, 2 pi/3, 4 pi/3 for
   rubbing, scratching, rolling: on the rim P(theta) = sum_k T(theta - theta_k) P_k, T(t) = 1 - 3 |t| / (2 pi) for |t| <
   2 pi/3 (t taken round the circle), else 0; inside P(theta, r) = (1 - r) mean(P_k) + r P(theta). So share w_k = (1 -
   r)/3 + r T(theta - theta_k).

   Materials: wood is basswood, metal steel, glass glass of material.def.

   Damping: material_decay of those figures. (The 2011 paper has decay = exp(a_G + a_R w); two parameters a material,
   whose interpolation is that of ln decay at every w. We interpolate ln decay too, of the materials' own laws, which
   are not exponential.)

   Spectra: what a shape of each material has of closed forms; the material acts through its ratios of stiffness only,
   the size is that of the fundamental asked for.
     bar    free, length l = 30 h, Timoshenko's dispersion (Timoshenko 1921) at the wave numbers b_i/l of the slender
            bar, cosh b cos b = 1 (the ends' near
            field is left as that of the slender bar: an approximation). With a = k^2 h^2/12 and s = E/(5/6 G), w^2 is
              in proportion to the smaller
            root y of s y^2 - (1 + a (1 + s)) y + a^2 = 0. Wood, weak in shear (s = 26; steel 3.1), has its overtones
              lower.
     plate  supported, sides 1 : 0.7, orthotropic (Leissa, NASA SP-160): w^2 ~ m^4 + 2 H/Dx m^2 (n/0.7)^2 + Dy/Dx
       (n/0.7)^4, Dy/Dx = E_y/E,
            H/Dx = nu E_y/E + 2 G (1 - nu^2 E_y/E)/E: 1 of what is isotropic, all ratios of metal and glass are alike.
     shell  closed thin sphere, h = R/50 (Junger, Feit, Sound, Structures, and Their Interaction, ch. 7), the lower root
       W^2, W = w R sqrt(rho (1 - nu^2)/E), of
            W^4 - (1 + 3 nu + L - q (1 - nu - L^2 - nu L)) W^2 + (L - 2) (1 - nu^2) + q (L^3 - 4 L^2 + L (5 - nu^2) - 2
              (1 - nu^2)) = 0,
            L = i (i + 1), i = 2, 3, ..., q = h^2/(12 R^2); wood as if isotropic, nu = sqrt(nu_LT nu_TL) = nu_LT
              sqrt(E_T/E_L).

   Gains: equal modal masses of bar (its end) and plate (on average over it); (2 i + 1)/5 of a shell, whose 2 i + 1
   modes of one frequency move as one where it is touched. */

static const struct material *material_of(int anchor)
{
    static const int names[SPACE_ANCHORS] = {
        [SPACE_WOOD] = MATERIAL_BASSWOOD, [SPACE_METAL] = MATERIAL_STEEL, [SPACE_GLASS] = MATERIAL_GLASS};
    return material_find(names[anchor]);
}

/* ------------------------------------------------------------------ shares */

void space_anchors_shares(double x, double y, double w[SPACE_ANCHORS])
{
    double r = fmin(sqrt(x * x + y * y), 1.0),
           third = 3.0 * real_atan2(y, x) / (2.0 * REAL_PI); /* theta in thirds of a turn, -1.5 .. 1.5 */
    for (int k = 0; k < SPACE_ANCHORS; k++) {
        double t = fabs(third - k);
        t = fmin(t, fabs(t - 3.0));
        w[k] = (1.0 - r) / 3.0 + r * fmax(1.0 - t, 0.0);
    }
}

/* ------------------------------------------------------------------ bar */

/* The i-th root above 0 of cosh b cos b = 1, by Newton's steps on cos b - 1/cosh b. */
static double bar_root(int i)
{
    double b = (i + 1.5) * REAL_PI;
    for (int step = 0; step < 8; step++) {
        double e = real_exp(-b), sech = 2.0 * e / (1.0 + e * e);
        b += (real_cos(b) - sech) / (real_sin(b) - sech * (1.0 - e * e) / (1.0 + e * e));
    }
    return b;
}

static double bar_square(const struct material *m, int i)
{
    double k = bar_root(i) / 30.0, a = k * k / 12.0, s = m->youngs_modulus / (5.0 / 6.0 * m->shear),
           b = 1.0 + a * (1.0 + s);
    return 2.0 * a * a / (b + sqrt(b * b - 4.0 * s * a * a));
}

/* ------------------------------------------------------------------ plate */

struct plate {
    double cross, across; /* 2 H/Dx, Dy/Dx */
};

static double plate_square(const struct plate *p, double m, double n)
{
    double mm = m * m, nn = n * n / 0.49;
    return mm * mm + p->cross * mm * nn + p->across * nn * nn;
}

/* How many (m, n) have a square of at most `most`; the first `room` of them go to `to`. */
static int plate_modes(const struct plate *p, double most, int room, double *to)
{
    int found = 0;
    for (int m = 1; plate_square(p, m, 1) <= most; m++)
        for (int n = 1; plate_square(p, m, n) <= most; n++, found++)
            if (found < room) to[found] = plate_square(p, m, n);
    return found;
}

static void plate_squares(const struct material *m, int n, double *square, struct arena *a)
{
    double across = m->across / m->youngs_modulus, nu = m->poisson;
    struct plate p = {.across = across,
                      .cross = 2.0 * (nu * across + 2.0 * m->shear * (1.0 - nu * nu * across) / m->youngs_modulus)};
    double most = plate_square(&p, 1, 1);
    while (plate_modes(&p, most, 0, NULL) < n)
        most *= 1.5;
    int found = plate_modes(&p, most, 0, NULL);
    double *all = ARENA_TAKE(a, double, found);
    plate_modes(&p, most, found, all);
    gsl_sort(all, 1, (size_t)found);
    for (int i = 0; i < n; i++)
        square[i] = all[i];
}

/* ------------------------------------------------------------------ shell */

static double shell_square(const struct material *m, int i)
{
    double nu = m->poisson * sqrt(m->across / m->youngs_modulus), q = 1.0 / (12.0 * 50.0 * 50.0),
           l = (i + 2.0) * (i + 3.0), v = 1.0 - nu * nu;
    double b = 1.0 + 3.0 * nu + l - q * (1.0 - nu - l * l - nu * l);
    double c = (l - 2.0) * v + q * (l * l * l - 4.0 * l * l + l * (5.0 - nu * nu) - 2.0 * v);
    return 2.0 * c / (b + sqrt(b * b - 4.0 * c));
}

/* ------------------------------------------------------------------ all */

static void anchor_spectrum(int shape, int anchor, int n, double *log_ratio, struct arena *a)
{
    const struct material *m = material_of(anchor);
    if (shape == SPACE_PLATE)
        plate_squares(m, n, log_ratio, a);
    else
        for (int i = 0; i < n; i++)
            log_ratio[i] = shape == SPACE_BAR ? bar_square(m, i) : shell_square(m, i);
    double first = log_ratio[0];
    for (int i = 0; i < n; i++)
        log_ratio[i] = 0.5 * real_log(log_ratio[i] / first);
}

/* decay in 1/s at angular frequency w (rad/s) */
static double anchor_decay(int anchor, double w)
{
    const struct material *m = material_of(anchor);
    return material_decay(m->alpha, m->beta, m->loss, w);
}

enum {
    STEPS = 256,
    BLOCK = 64,
    MOST = 200000
}; /* places at which a moving one is looked at; modes at a time; modes looked at */

struct self {
    double from[2], to[2], dimension[2];
    double fundamental, gain, rate;                                         /* rate 0: nothing fades */
    double *low;                                                            /* [n] Hz, lowest on the way */
    double *spectrum[SPACE_SHAPES][SPACE_ANCHORS], *log_gain[SPACE_SHAPES]; /* [n] */
};

/* ------------------------------------------------------------------ reading */

struct mix {                             /* at one share */
    double anchor[SPACE_ANCHORS], upper; /* shares of the anchors, of shape + 1 */
    int shape;
};

static void mix_at(const struct self *s, double share, struct mix *x)
{
    double dimension = s->dimension[0] + share * (s->dimension[1] - s->dimension[0]);
    space_anchors_shares(s->from[0] + share * (s->to[0] - s->from[0]), s->from[1] + share * (s->to[1] - s->from[1]),
                         x->anchor);
    x->shape = dimension < 2.0 ? SPACE_BAR : SPACE_PLATE;
    x->upper = dimension - 1.0 - x->shape;
}

/* f[i] = ln(f_i/f_1), g[i] = ln(g_i/g_1) of n modes from `first`. */
static void logarithms(const struct self *s, const struct mix *x, const int range[2], double *f, double *g)
{
    const double *lower = s->log_gain[x->shape], *upper = s->log_gain[x->shape + 1];
    for (int i = range[0], j = 0; i < range[1]; i++, j++) {
        double sum[2] = {0.0, 0.0};
        for (int k = 0; k < SPACE_ANCHORS; k++) {
            sum[0] += x->anchor[k] * s->spectrum[x->shape][k][i];
            sum[1] += x->anchor[k] * s->spectrum[x->shape + 1][k][i];
        }
        f[j] = (1.0 - x->upper) * sum[0] + x->upper * sum[1];
        g[j] = (1.0 - x->upper) * lower[i] + x->upper * upper[i];
    }
}

/* decay[i] at frequencies f (Hz) */
static void decays(const struct mix *x, int n, const double *f, double *decay)
{
    double law[BLOCK];
    memset(decay, 0, (size_t)n * sizeof *decay);
    for (int k = 0; k < SPACE_ANCHORS; k++) {
        for (int i = 0; i < n; i++)
            law[i] = anchor_decay(k, 2.0 * REAL_PI * f[i]);
        vecmath_log((size_t)n, law, law);
        for (int i = 0; i < n; i++)
            decay[i] += x->anchor[k] * law[i];
    }
    vecmath_exp((size_t)n, decay, decay);
}

static void block(const struct self *s, const struct mix *x, const int range[2], const struct modes_point *p)
{
    double f[BLOCK], g[BLOCK], decay[BLOCK];
    int n = range[1] - range[0];
    logarithms(s, x, range, f, g);
    vecmath_exp((size_t)n, f, f);
    vecmath_exp((size_t)n, g, g);
    for (int j = 0; j < n; j++)
        f[j] *= s->fundamental;
    decays(x, n, f, decay);
    for (int j = 0, i = range[0]; j < n; j++, i++) {
        double w0 = 2.0 * REAL_PI * f[j], rings = w0 * w0 - decay[j] * decay[j],
               w = rings > 0.0 ? sqrt(rings) : INFINITY,
               gain = s->gain * g[j] * modes_fade(w / (2.0 * REAL_PI), s->rate);
        p->re[i] = -gain * decay[j] / w;
        p->im[i] = gain;
        if (p->frequency) {
            p->frequency[i] = w / (2.0 * REAL_PI);
            p->decay[i] = decay[j];
        }
    }
}

static double at(const struct modes *m, const struct modes_where *where, const struct modes_point *p)
{
    const struct self *s = m->self;
    struct mix x;
    mix_at(s, where->share, &x);
    for (int first = 0; first < m->n; first += BLOCK)
        block(s, &x, (int[2]){first, first + BLOCK < m->n ? first + BLOCK : m->n}, p);
    return 0.0;
}

/* ------------------------------------------------------------------ making */

static bool inside(const char *key, const double place[2], struct err *e)
{
    double r = sqrt(place[0] * place[0] + place[1] * place[1]);
    return r <= 1.0 + 1e-6 || err_set(e, ERR_SCENE,
                                      "surface.space.%s: [%.9g, %.9g] lies %.6g from the centre, outside the disk of "
                                      "radius 1 whose rim is that of wood, metal and glass; divide both by that",
                                      key, place[0], place[1], r);
}

static bool ends(const struct space *g, struct self *s, struct err *e)
{
    for (int c = 0; c < 2; c++) {
        s->from[c] = g->from[c];
        s->to[c] = isnan(g->to[c]) ? g->from[c] : g->to[c];
    }
    s->dimension[0] = g->dimension;
    s->dimension[1] = isnan(g->dimension_to) ? g->dimension : g->dimension_to;
    s->fundamental = g->fundamental;
    s->gain = g->gain;
    return inside("from", s->from, e) && inside("to", s->to, e);
}

/* Spectra of `most` modes; returns how many of them can lie below the band's end. */
static int spectra(struct self *s, int most, const struct modes_ask *ask, struct arena *a)
{
    double top = ask->band[1] > 0.0 ? real_log(ask->band[1] / s->fundamental) : INFINITY;
    int n = 0;
    for (int d = 0; d < SPACE_SHAPES; d++) {
        s->log_gain[d] = ARENA_TAKE(a, double, most);
        for (int i = 0; i < most; i++)
            s->log_gain[d][i] = real_log(d == SPACE_SHELL ? (2.0 * i + 5.0) / 5.0 : 1.0);
        for (int k = 0; k < SPACE_ANCHORS; k++) {
            s->spectrum[d][k] = ARENA_TAKE(a, double, most);
            anchor_spectrum(d, k, most, s->spectrum[d][k], a);
            int below = 0;
            while (below < most && s->spectrum[d][k][below] < top)
                below++;
            n = below > n ? below : n;
        }
    }
    return n;
}

struct rank {
    double energy, low;     /* the most along the way; Hz, the lowest damped frequency there */
    double lowest, highest; /* Hz, undamped */
    int index;
};

static int strongest_first(const void *a, const void *b)
{
    const struct rank *p = a, *q = b;
    if (p->energy != q->energy) return p->energy > q->energy ? -1 : 1;
    return (p->index > q->index) - (p->index < q->index);
}

/* What the modes are along the way: where each is strongest, the least decay. Leaves m->frequency, decay, slowest as
 * they are there. */
static void walk(struct modes *m, struct rank *rank, struct arena *a)
{
    struct modes_point p = modes_point_make(a, m->n);
    for (int i = 0; i < m->n; i++) {
        m->slowest[i] = INFINITY;
        rank[i] = (struct rank){.energy = -1.0, .low = INFINITY, .lowest = INFINITY, .index = i};
    }
    for (int k = 0; k <= (m->travels ? STEPS : 0); k++) {
        at(m, &(struct modes_where){.share = (double)k / STEPS}, &p);
        for (int i = 0; i < m->n; i++) {
            double energy = p.im[i] * p.im[i] / p.decay[i], damping = p.decay[i] / (2.0 * REAL_PI),
                   undamped = sqrt(p.frequency[i] * p.frequency[i] + damping * damping);
            m->slowest[i] = fmin(m->slowest[i], p.decay[i]);
            rank[i].low = fmin(rank[i].low, p.frequency[i]);
            rank[i].lowest = fmin(rank[i].lowest, undamped);
            rank[i].highest = fmax(rank[i].highest, undamped);
            if (energy <= rank[i].energy) continue;
            rank[i].energy = energy;
            m->frequency[i] = p.frequency[i];
            m->decay[i] = p.decay[i];
        }
    }
}

static void permute(double *v, const int *index, int n, double *room)
{
    for (int i = 0; i < n; i++)
        room[i] = v[index[i]];
    memcpy(v, room, (size_t)n * sizeof *v);
}

/* The modes index[n], in that order. */
static void select_modes(struct modes *m, struct self *s, const int *index, int n, double *room)
{
    double *own[] = {m->frequency, m->decay, m->slowest, s->low};
    for (int c = 0; c < 4; c++)
        permute(own[c], index, n, room);
    for (int d = 0; d < SPACE_SHAPES; d++) {
        permute(s->log_gain[d], index, n, room);
        for (int k = 0; k < SPACE_ANCHORS; k++)
            permute(s->spectrum[d][k], index, n, room);
    }
    m->n = n;
}

static int drop(struct modes *m, double top)
{
    struct self *s = (struct self *)m->self;
    struct arena *a = arena_open();
    int *index = ARENA_TAKE(a, int, m->n + 1), n = 0, all = m->n;
    for (int i = 0; i < all; i++)
        if (s->low[i] < top) index[n++] = i;
    select_modes(m, s, index, n, ARENA_TAKE(a, double, all + 1));
    arena_close(a);
    return all - n;
}

/* The `most` lowest modes of the shapes, without those outside the band, and of these the lowest `strongest`, the
 * strongest first. Returns whether there may be more. */
static bool choose(struct modes *m, struct self *s, const struct modes_ask *ask, int most, struct arena *a)
{
    struct rank *rank = ARENA_TAKE(a, struct rank, most);
    int *index = ARENA_TAKE(a, int, most), n = 0;
    double **own[] = {&m->frequency, &m->decay, &m->slowest, &s->low};
    int below = m->n = spectra(s, most, ask, a);
    for (int c = 0; c < 4; c++)
        *own[c] = ARENA_TAKE(a, double, most);
    walk(m, rank, a);
    for (int i = 0; i < below; i++) {
        s->low[i] = rank[i].low;
        if (n < ask->strongest && modes_in_band(ask, rank[i].lowest, rank[i].highest)) rank[n++] = rank[i];
    }
    qsort(rank, (size_t)n, sizeof *rank, strongest_first);
    for (int i = 0; i < n; i++)
        index[i] = rank[i].index;
    select_modes(m, s, index, n, ARENA_TAKE(a, double, most));
    return n < ask->strongest && below == most && most < MOST;
}

bool space_modes(const struct space *g, const struct modes_ask *ask, struct arena *a, struct modes *m, struct err *e)
{
    struct self *s = ARENA_TAKE(a, struct self, 1);
    if (!ends(g, s, e)) return false;
    bool travels = s->from[0] != s->to[0] || s->from[1] != s->to[1] || s->dimension[0] != s->dimension[1];
    *m = (struct modes){.quantity = MODES_VELOCITY,
                        .shared = !travels,
                        .travels = travels,
                        .radius = NAN,
                        .name = "surface.space",
                        .drop = drop,
                        .at = at,
                        .self = s};
    for (int most = ask->strongest; choose(m, s, ask, most, a); most *= 2)
        continue;
    s->rate = travels ? ask->rate : 0.0; /* only now: what is chosen does not depend on it */
    return m->n > 0 || err_set(e, ERR_SCENE,
                               "surface.space: none of its modes lies from %g Hz to below %g Hz, surface.band: widen "
                               "the band, or change surface.space.fundamental, %g Hz",
                               ask->band[0], ask->band[1], g->fundamental);
}

/* ------------------------------------------------------------------ keys */

static const struct key keys[] = {
    {ROW_POINT(contact, surface.response.space.from, "surface.space.from"), KEY_NONE, -1, 1, "[0, 0]", NULL,
     "place in the disk of materials: wood at [1, 0], metal at 120 degrees, glass at 240 degrees on its rim"},
    {ROW_POINT(contact, surface.response.space.to, "surface.space.to"), KEY_NONE, -1, 1, "", NULL,
     "place at the motion's end, reached along a straight line; left out: it stays", .shown = "[-0.5, 0.86]"},
    {ROW_NUMBER(contact, surface.response.space.dimension, "surface.space.dimension"), KEY_NONE, 1, 3, "2", NULL,
     "shape: 1 bar, 2 plate, 3 shell, and all between"},
    {ROW_NUMBER(contact, surface.response.space.dimension_to, "surface.space.dimension_to"), KEY_NONE, 1, 3, "", NULL,
     "shape at the motion's end; left out: it stays", .shown = "3"},
    {ROW_NUMBER(contact, surface.response.space.fundamental, "surface.space.fundamental"), KEY_FREQUENCY, 20, 5000,
     "400 Hz", NULL, "frequency of the lowest mode: the object's size"},
    {ROW_NUMBER(contact, surface.response.space.gain, "surface.space.gain"), KEY_NONE, 1e-12, 1e12, "1", NULL,
     "velocity per impulse of the lowest mode, in m/s per N s: how light the object is"},
    {.path = NULL}};

static void rim_check(const struct scene_part *p, const char *path, const double place[2])
{
    double r = sqrt(place[0] * place[0] + place[1] * place[1]);
    if (r > 1 + 1e-6)
        scene_part_refuse(p, path, path, "the rim is where x^2 + y^2 is 1",
                          " lies %.6g from the centre, outside the disk of materials, whose radius is 1", r);
}

static void space_check(const struct scene_part *p, const struct contact *c, const void *own)
{
    (void)own;
    rim_check(p, "surface.space.from", c->surface.response.space.from);
    rim_check(p, "surface.space.to", c->surface.response.space.to);
}

const struct params space_params = {
    .section = "surface.space",
    .keys = keys,
    .meaning =
        "an object somewhere between wood, metal and glass, and between bar, plate and shell, which may change while "
        "it sounds. As anchors wood is basswood, metal steel and glass glass, with elastic constants and damping as "
        "surface.material has them. The spacing of their modes is that of a bar, plate and shell of each, by closed "
        "forms. Between anchors the logarithms of frequency ratios and of decays are averaged, by the shares of wood, "
        "metal and glass at the place",
    .flag = offsetof(struct contact, surface.response.space.given),
    .check = space_check};
