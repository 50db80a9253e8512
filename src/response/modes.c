/* What is asked of a set of modes, wherever it comes from.

   Direct term: h_a = dh_v/dt holds for t > 0; at t = 0 velocity jumps by h_v(0+) per N s, whose derivative is a delta
   of that weight. h_v(t) = Im(A/s e^(s t)) is the one that dies away, so D = sum Im(A/s); without it low frequencies
   are wrong. A pressure, which follows the acceleration of a surface, likewise. */
#include "response/modes.h"

#include <math.h>
#include <stdlib.h>

#include "num/real.h"
#include "response/mode_table.h"
#include "response/morph.h"
#include "response/object.h"

double modes_at(const struct modes *m, const struct modes_where *where, const struct modes_point *p)
{
    return m->at(m, where, p);
}

struct modes_point modes_point_make(struct arena *a, int n)
{
    return (struct modes_point){ARENA_TAKE(a, double, n), ARENA_TAKE(a, double, n), ARENA_TAKE(a, double, n),
                                ARENA_TAKE(a, double, n)};
}

const char *modes_quantity_name(int quantity)
{
    static const char *const names[MODES_QUANTITIES] = {"displacement", "velocity", "acceleration", "sound pressure",
                                                        "force"};
    return names[quantity];
}

const char *modes_quantity_unit(int quantity)
{
    static const char *const units[MODES_QUANTITIES] = {"m", "m/s", "m/s^2", "Pa", "N"};
    return units[quantity];
}

double modes_direct(int quantity, int n, const double *frequency, const double *decay, const struct modes_point *p)
{
    double sum = 0.0;
    if (quantity != MODES_ACCELERATION && quantity != MODES_PRESSURE) return 0.0;
    for (int i = 0; i < n; i++) {
        double omega = 2.0 * REAL_PI * frequency[i], d = decay[i];
        sum -= (p->im[i] * d + p->re[i] * omega) / (d * d + omega * omega);
    }
    return sum;
}

int modes_drop_above(struct modes *m, double rate) { return m->drop ? m->drop(m, MODES_TOP * rate) : 0; }

double modes_fade(double frequency, double rate)
{
    double u = rate > 0.0 ? (frequency / rate - 0.45) / 0.05 : 0.0;
    return u <= 0.0 ? 1.0 : u < 1.0 ? 0.5 * (1.0 + real_cospi(u)) : 0.0;
}

bool modes_in_band(const struct modes_ask *ask, double lowest, double highest)
{
    const double same = 1.0 - 1e-9; /* what rounding puts beside an end lies at it */
    return !(ask->band[1] > 0.0) || (highest >= same * ask->band[0] && lowest < same * ask->band[1]);
}

double modes_ring_time(const struct modes *m, double decibel)
{
    double slowest = INFINITY;
    if (m->n == 0) return 0.0;
    for (int i = 0; i < m->n; i++)
        slowest = fmin(slowest, m->slowest[i]);
    return slowest > 0.0 ? decibel * (real_log(10.0) / 20.0) / slowest : INFINITY;
}

void modes_to_quantity(int quantity, int n, const struct modes_point *p)
{
    for (int i = 0; i < n && quantity != MODES_VELOCITY; i++) {
        double re = p->re[i], im = p->im[i], a = -p->decay[i], w = 2.0 * REAL_PI * p->frequency[i],
               square = a * a + w * w;
        bool up = quantity == MODES_ACCELERATION;
        p->re[i] = up ? re * a - im * w : (re * a + im * w) / square;
        p->im[i] = up ? re * w + im * a : (im * a - re * w) / square;
    }
}

/* struct modes from a mode table: its places, which modes of different places are one (by id, or morph.h), the
   strongest of them, their gains (morph.h).

   Strength of a mode: its energy per (N s)^2, summed over the places; of one slope the integral of (gain e^(-decay t)
   sin(...))^2 dt ~ gain^2/(4 decay), of several slopes sum_jk g_j g_k cos(phase_j - phase_k)/(2 (decay_j + decay_k)).
   Its slopes become components one after the other, those of equal rank by decay being one and the same at all places.
   Complex gain: A = gain e^(j phase), so that h(t) = Im(A e^(s t)). */

struct rank {
    double energy, lowest, highest; /* Hz, over the places */
    size_t track;
    bool inside; /* somewhere in the band */
};

struct component {
    int chosen, slope; /* index among the modes chosen; which of its slopes */
};

struct making {
    const struct mode_table *t;
    struct arena *arena;
    struct places *places;
    size_t tracks, *track;           /* [entries] of each entry */
    struct rank *rank;               /* [tracks], those of the band first, of these the strongest */
    size_t inside;                   /* how many are in the band */
    int chosen, n;                   /* modes, components */
    const struct mode_entry **entry; /* [chosen][places] or NULL */
    struct component *component;     /* [n] */
};

/* ------------------------------------------------------------------ places, tracks */

static bool make_places(struct making *k, struct err *e)
{
    struct err own = {0};
    int bad;
    if (places_make(k->arena, (int)k->t->places, k->t->xy, &k->places, &bad, &own)) return true;
    return bad < 0 ? err_set(e, own.kind, "%s: %s", k->t->csv.file, own.text)
                   : mode_table_bad_place(k->t, (size_t)bad, own.text, e);
}

static void track_by_frequency(struct making *k, double gate)
{
    const struct mode_table *t = k->t;
    size_t entries = t->first[t->places];
    double *frequency = ARENA_TAKE(k->arena, double, entries), *decay = ARENA_TAKE(k->arena, double, entries);
    int *number = ARENA_TAKE(k->arena, int, entries), **rows = ARENA_TAKE(k->arena, int *, t->places);
    struct morph_list *list = ARENA_TAKE(k->arena, struct morph_list, t->places);
    for (size_t i = 0; i < entries; i++) {
        frequency[i] = t->entry[i].frequency;
        decay[i] = t->entry[i].slope[0].decay;
    }
    for (size_t p = 0; p < t->places; p++) {
        size_t from = t->first[p];
        rows[p] = number + from;
        list[p] = (struct morph_list){(int)(t->first[p + 1] - from), frequency + from, decay + from};
    }
    k->tracks = (size_t)morph_tracks(k->places, (int)t->places, t->xy, list, gate, rows);
    for (size_t i = 0; i < entries; i++)
        k->track[i] = (size_t)number[i];
}

static void make_tracks(struct making *k, double gate)
{
    size_t entries = k->t->first[k->t->places];
    k->track = ARENA_TAKE(k->arena, size_t, entries);
    k->tracks = k->t->modes;
    for (size_t i = 0; i < entries; i++)
        k->track[i] = k->t->entry[i].mode;
    if (k->t->by_frequency && k->t->places > 1) track_by_frequency(k, gate);
}

/* ------------------------------------------------------------------ the strongest */

static double slope_energy(const struct mode_slope *p)
{
    if (p->gain != 0.0 && p->decay == 0.0) return HUGE_VAL; /* without decay: endless energy, unless silent */
    double amplitude = p->gain != 0.0 ? p->gain / (2.0 * sqrt(p->decay)) : 0.0;
    return amplitude * amplitude;
}

static double energy(const struct mode_entry *m)
{
    double sum = 0.0;
    for (int i = 0; i < m->n; i++) {
        const struct mode_slope *p = &m->slope[i];
        sum += slope_energy(p);
        for (int j = 0; j < i && sum < HUGE_VAL; j++) {
            const struct mode_slope *q = &m->slope[j];
            if (p->gain != 0.0 && q->gain != 0.0)
                sum += p->gain * q->gain * real_cos(p->phase - q->phase) / (p->decay + q->decay);
        }
    }
    return fmax(sum, 0.0);
}

static int strongest_first(const void *a, const void *b)
{
    const struct rank *p = a, *q = b;
    if (p->inside != q->inside) return p->inside ? -1 : 1;
    if (p->energy != q->energy) return p->energy > q->energy ? -1 : 1;
    return (p->track > q->track) - (p->track < q->track);
}

static void rank_modes(struct making *k, const struct modes_ask *ask)
{
    const struct mode_table *t = k->t;
    k->rank = ARENA_TAKE(k->arena, struct rank, k->tracks);
    for (size_t i = 0; i < k->tracks; i++)
        k->rank[i] = (struct rank){.lowest = HUGE_VAL, .track = i};
    for (size_t i = 0; i < t->first[t->places]; i++) {
        struct rank *r = &k->rank[k->track[i]];
        r->energy += energy(&t->entry[i]);
        r->lowest = fmin(r->lowest, t->entry[i].frequency);
        r->highest = fmax(r->highest, t->entry[i].frequency);
    }
    for (size_t i = 0; i < k->tracks; i++)
        k->inside += k->rank[i].inside = modes_in_band(ask, k->rank[i].lowest, k->rank[i].highest);
    qsort(k->rank, k->tracks, sizeof *k->rank, strongest_first);
}

static void choose(struct making *k, int strongest)
{
    const struct mode_table *t = k->t;
    size_t none = k->tracks, *place = ARENA_TAKE(k->arena, size_t, k->tracks);
    k->chosen = (size_t)strongest < k->inside ? strongest : (int)k->inside;
    k->entry = ARENA_TAKE(k->arena, const struct mode_entry *, (size_t)k->chosen * t->places);
    for (size_t i = 0; i < k->tracks; i++)
        place[k->rank[i].track] = i < (size_t)k->chosen ? i : none;
    for (size_t i = 0; i < t->first[t->places]; i++)
        if (place[k->track[i]] != none) k->entry[place[k->track[i]] * t->places + t->entry[i].place] = &t->entry[i];
}

/* Slopes of a chosen mode, at the place where they are most. */
static int most_slopes(const struct making *k, int chosen)
{
    int most = 0;
    for (size_t p = 0; p < k->t->places; p++) {
        const struct mode_entry *m = k->entry[(size_t)chosen * k->t->places + p];
        most = m && m->n > most ? m->n : most;
    }
    return most;
}

/* The entry and slope of component i at a place; NULL: the place lacks it. */
static const struct mode_entry *entry_of(const struct making *k, int i, size_t place, const struct mode_slope **slope)
{
    const struct mode_entry *m = k->entry[(size_t)k->component[i].chosen * k->t->places + place];
    if (!m || k->component[i].slope >= m->n) return NULL;
    *slope = &m->slope[k->component[i].slope];
    return m;
}

/* ------------------------------------------------------------------ gains and poles */

/* The poles of component i where it is strongest, its range of frequencies, largest gain and least decay. */
static void own_poles(const struct making *k, struct modes *m, struct morph *p, int i)
{
    double most = -1.0;
    const struct mode_slope *s;
    p->lowest[i] = m->slowest[i] = HUGE_VAL;
    for (size_t row = 0; row < k->t->places; row++) {
        const struct mode_entry *at = entry_of(k, i, row, &s);
        if (!at) continue;
        p->lowest[i] = fmin(p->lowest[i], at->frequency);
        p->highest[i] = fmax(p->highest[i], at->frequency);
        p->largest[i] = fmax(p->largest[i], fabs(s->gain));
        m->slowest[i] = fmin(m->slowest[i], s->decay);
        if (slope_energy(s) > most) {
            most = slope_energy(s);
            m->frequency[i] = at->frequency;
            m->decay[i] = s->decay;
        }
    }
}

/* Shared poles are those of the first place. */
static void fill_complex(const struct making *k, const struct modes *m, struct morph *p)
{
    const struct mode_slope *s;
    morph_begin(p, m->shared, k->arena);
    for (int i = 0; i < p->n; i++) {
        if (m->shared) {
            m->frequency[i] = entry_of(k, i, 0, &s)->frequency;
            m->decay[i] = m->slowest[i] = s->decay;
        }
        for (int row = 0; row < p->rows; row++) {
            const struct mode_entry *at = entry_of(k, i, (size_t)row, &s);
            if (at)
                morph_set(p, m, row, i,
                          &(struct morph_pole){at->frequency, s->decay, s->gain * real_cos(s->phase),
                                               s->gain * real_sin(s->phase)});
        }
    }
    morph_slopes(p);
}

static void fill_logarithmic(const struct making *k, const struct modes *m, struct morph *p)
{
    double **rows[] = {&p->frequency, &p->decay, &p->gain, &p->phase, &p->there};
    double **work[] = {&p->share, &p->amplitude, &p->torn, &p->size, &p->sine, &p->cosine};
    const struct mode_slope *s;
    for (int c = 0; c < 5; c++)
        *rows[c] = ARENA_TAKE(k->arena, double, (size_t)p->rows * p->n);
    for (int c = 0; c < 6; c++)
        *work[c] = ARENA_TAKE(k->arena, double, (c < 3 ? 1 : 4) * (size_t)p->n);
    p->high = ARENA_TAKE(k->arena, int, p->n);
    for (int i = 0; i < p->n; i++)
        for (int row = 0; row < p->rows; row++) {
            const struct mode_entry *at = entry_of(k, i, (size_t)row, &s);
            if (at) morph_put(p, m, row, i, (double[4]){at->frequency, s->decay, s->gain, s->phase});
        }
    morph_finish(p);
}

static int drop(struct modes *m, double top)
{
    struct morph *p = (struct morph *)m->self;
    struct arena *a = arena_open();
    bool *chosen_ones = ARENA_TAKE(a, bool, m->n);
    for (int i = 0; i < m->n; i++)
        chosen_ones[i] = p->lowest[i] < top;
    int dropped = morph_select(p, m, chosen_ones);
    arena_close(a);
    return dropped;
}

static void make_modes(const struct making *k, double rate, struct modes *m)
{
    struct morph *p = ARENA_TAKE(k->arena, struct morph, 1);
    double **own[] = {&m->frequency, &m->decay, &m->slowest, &p->largest, &p->lowest, &p->highest};
    *p = (struct morph){.n = k->n, .rows = (int)k->t->places, .places = k->places, .rate = rate};
    *m = (struct modes){.n = k->n,
                        .quantity = k->t->quantity,
                        .shared = k->t->shared || p->rows == 1,
                        .moves = p->rows > 1,
                        .radius = k->t->radius,
                        .name = k->t->csv.file,
                        .note = k->t->note,
                        .places = k->places,
                        .drop = drop,
                        .self = p};
    for (int c = 0; c < 6; c++)
        *own[c] = ARENA_TAKE(k->arena, double, k->n);
    for (int i = 0; i < k->n; i++)
        own_poles(k, m, p, i);
    if (m->shared || k->t->complex)
        fill_complex(k, m, p);
    else
        fill_logarithmic(k, m, p);
    m->at = p->re ? morph_complex : morph_separate;
    const int(*edge)[2]; /* of a line its first place is the home */
    int edges = places_edges(k->places, &edge),
        first = places_kind(k->places) == PLACES_LINE && edges > 0 ? edge[0][0] : 0;
    m->home[0] = k->t->xy[2 * first];
    m->home[1] = k->t->xy[2 * first + 1];
}

static bool make_table(const char *path, const void *how, struct arena *a, void *table, struct err *e)
{
    (void)how;
    return mode_table_read(path, a, table, e);
}

bool modes_table(const char *path, const struct modes_ask *ask, struct arena *a, struct modes *m, struct err *e)
{
    static const struct file_cache_kind tables = {"mode table", sizeof(struct mode_table), make_table, false};
    struct making k = {
        .t = file_cache_take(ask->file_cache, &(struct file_cache_ask){.kind = &tables, .file = path}, a, e),
        .arena = a};
    if (!k.t || !make_places(&k, e)) return false;
    make_tracks(&k, ask->pairing);
    rank_modes(&k, ask);
    if (k.inside == 0)
        return err_set(e, ERR_SCENE,
                       "%s: none of its modes lies from %g Hz to below %g Hz, the band from which they are chosen: "
                       "widen that band (surface.band, scraper.band or ball.band), or check that frequency_hz is in Hz",
                       path, ask->band[0], ask->band[1]);
    choose(&k, ask->strongest);
    for (int c = 0; c < k.chosen; c++)
        k.n += most_slopes(&k, c);
    k.component = ARENA_TAKE(a, struct component, k.n);
    for (int c = 0, i = 0; c < k.chosen; c++)
        for (int s = 0, most = most_slopes(&k, c); s < most; s++)
            k.component[i++] = (struct component){c, s};
    make_modes(&k, ask->rate, m);
    return true;
}

/* Of an object of closed form: phi = shape / sqrt(modal mass), exact, with its sign. A shell's modes come in families,
   one of which answers a force wherever it is with the same gain (object_kinds.c): phi = 1/sqrt(mass) everywhere, and
   its pattern goes with the contact. Rigid motions of what is free are left out, as they are of what sounds.

   Of a mode table with shared poles, heard where it is touched: a mode of complex gain A, h(t) = Im(A e^(s t)), is in
   displacement A / s^q, q = 0, 1, 2 of displacement, velocity, acceleration, and with q_i'' + 2 sigma q_i' + |s|^2 q_i
   = phi f, w = phi q_i,

     A / s^q = phi^2 / w_d,   w_d = 2 pi f:   real and positive,   phi = sqrt(w_d Re(A / s^q)).

   Gains at two different places are phi(x) phi(l) / w_d, of either sign, from which phi cannot be told; as coupled to a
   ball they could give out more energy than they take. They are refused: at each of the table's places the phase of A /
   s^q may be off by PHASE rad (a table whose velocity starts as a cosine is off by the loss factor over 2), beyond
   FLOOR of the mode's largest, and of what is off the real part counts. The sign of phi is lost on a table. Between
   places A is what morph.c makes of it: in triangles phi is 0 only where a place lies on a nodal line; where a spline
   of phi^2 comes out a little below 0, beside such a line, phi is 0. */

#define PHASE 0.05
#define FLOOR 1e-6 /* -120 dB, below which morph.c takes a gain for none */

struct shape_work {
    const double *scale;       /* [n] of an object: 1/sqrt(modal mass), 1/sqrt(kg)         */
    double origin[2];          /* m: where the object's x = y = 0 lies                     */
    bool family;               /* a shell's                                                */
    double *turn_re, *turn_im; /* [n] of a table: w_d / s^q                                */
    struct modes_point point;  /* of a table: work                                         */
};

/* ------------------------------------------------------------------ tables */

static void of_table(const struct modes *m, struct arena *a, struct shape_work *self)
{
    *self = (struct shape_work){.turn_re = ARENA_TAKE(a, double, m->n),
                                .turn_im = ARENA_TAKE(a, double, m->n),
                                .point = modes_point_make(a, m->n)};
    for (int i = 0; i < m->n; i++) {
        double w = 2 * REAL_PI * m->frequency[i], d = m->decay[i], size = w * w + d * d, re = w, im = 0;
        for (int q = 0; q < m->quantity; q++) { /* over s: times (-d - j w) / |s|^2 */
            double turned = (im * w - re * d) / size;
            im = -(re * w + im * d) / size;
            re = turned;
        }
        self->turn_re[i] = re;
        self->turn_im[i] = im;
    }
}

/* Of one mode: at every row. */
static bool row_gains(const struct modes *m, const struct shape_work *self, int rows, const double *re,
                      const double *im, struct err *e)
{
    for (int i = 0; i < m->n; i++) {
        double largest = 0, turn_re = self->turn_re[i], turn_im = self->turn_im[i];
        for (int row = 0; row < rows; row++) {
            double x = re[row * m->n + i], y = im[row * m->n + i];
            largest = fmax(largest, sqrt((x * x + y * y) * (turn_re * turn_re + turn_im * turn_im)));
        }
        for (int row = 0; row < rows; row++) {
            double x = re[row * m->n + i], y = im[row * m->n + i], across = x * turn_im + y * turn_re,
                   along = x * turn_re - y * turn_im;
            if (along < -FLOOR * largest || fabs(across) > PHASE * fmax(along, 0) + FLOOR * largest)
                return err_set(e, ERR_SCENE,
                               "%s: its gains are those of another listening place than the one that is touched (that "
                               "of the mode at %.6g Hz is no driving point's), and do not say how the surface gives "
                               "way under the ball; give surface.object, or contact.roll.ground: rigid",
                               m->name, m->frequency[i]);
        }
    }
    return true;
}

bool modes_shapes_make(const struct modes *m, const char *key, struct arena *a, struct modes_shapes *s, struct err *e)
{
    struct shape_work *self = ARENA_TAKE(a, struct shape_work, 1);
    *s = (struct modes_shapes){.n = m->n, .frequency = m->frequency, .decay = m->decay, .modes = m, .self = self};
    if (!m->shared || m->travels)
        return err_set(
            e, ERR_SCENE,
            "%s: %s, and so it cannot give way under a ball; give %s.object or a table with the same frequencies at "
            "all places, or contact.roll.ground: rigid",
            m->name,
            m->travels ? "its modes change over time" : "its frequencies and decays differ from place to place", key);
    s->moves = m->moves;
    if (m->object) {
        const struct object *o = m->object;
        const double *origin = object_modes_origin(m);
        double *scale = ARENA_TAKE(a, double, o->n);
        for (int i = 0; i < o->n; i++)
            scale[i] = 1 / sqrt(o->mass[i]);
        *self =
            (struct shape_work){.scale = scale, .origin = {origin[0], origin[1]}, .family = o->shape == OBJECT_SHELL};
        return true;
    }
    if (m->quantity > MODES_ACCELERATION)
        return err_set(e, ERR_SCENE,
                       "%s: it is of no motion of the surface; give %s.object, or contact.roll.ground: rigid", m->name,
                       key);
    of_table(m, a, self);
    const struct morph *p = m->self;
    if (m->at == morph_complex) return row_gains(m, self, p->rows, p->re, p->im, e);
    modes_at(m, &(struct modes_where){m->home[0], m->home[1], 0}, &self->point);
    return row_gains(m, self, 1, self->point.re, self->point.im, e);
}

void modes_shapes_at(const struct modes_shapes *s, const struct modes_where *where, double *phi)
{
    const struct shape_work *self = s->self;
    const struct modes_point *p = &self->point;
    const struct object *o = s->modes->object;
    if (!o) {
        modes_at(s->modes, where, p);
        for (int i = 0; i < s->n; i++)
            phi[i] = sqrt(fmax(p->re[i] * self->turn_re[i] - p->im[i] * self->turn_im[i], 0));
        return;
    }
    if (!self->family) o->shapes(o, where->x - self->origin[0], where->y - self->origin[1], phi);
    for (int i = 0; i < s->n; i++)
        phi[i] = (self->family ? 1 : phi[i]) * self->scale[i];
}
