/* Impulse responses as samples (papers/000 eq. 10: 0 <= tau < t0).

   Scale: y[n] = (1/rate) sum_{m <= n} h((n-m)/rate) f[m] with half of h(0+) at m = n, the trapezium rule at the jump.
   Here 1/rate and the half are inside h[].

   Sampling modes, h(t) = Im sum_i A_i e^(s_i t): a phasor per mode turns by p = e^(s/rate) from sample to sample; every
   SEGMENT samples it starts afresh from a second phasor that turns by P = e^(s SEGMENT/rate), whose angle is reduced
   exactly (SEGMENT f modulo the rate; SEGMENT is a power of 2) before it is rounded. So rounding grows with SEGMENT +
   length/SEGMENT, not with length. Eight modes are the lanes of a group; sums run over groups in order and then over
   lanes in a fixed tree: same bits on every CPU. */
#include "response/ir.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "file/csv.h"
#include "file/wav.h"
#include "num/lanes.h"
#include "num/real.h"
#include "num/resample.h"
#include "num/scaled.h"
#include "num/vecmath.h"

enum { SEGMENT = 256, SPAN = 4 }; /* samples between fresh starts; samples per visit to a group */

size_t ir_length(double rate, double t0)
{
    double n = t0 * rate, whole = rint(n);
    n = fabs(n - whole) < 1e-9 * whole ? whole
                                       : ceil(n); /* 0.1 s at 44.1 kHz is 4410 samples however the product rounds */
    return n < 1.0 ? 1 : (size_t)n;
}

struct group {
    _Alignas(64) double pr[LANES];
    double pi[LANES];            /* p: one sample              */
    double Pr[LANES], Pi[LANES]; /* P: one segment             */
    double Zr[LANES], Zi[LANES]; /* phasors where it started   */
    double zr[LANES], zi[LANES]; /* phasors now                */
};

struct ir_sampler {
    int n, groups;
    double rate;
    double *frequency, *decay; /* [groups][LANES] those of the phasors */
    struct group *group;
    double sums[SEGMENT][LANES];
};

/* e^(s n/rate) of a group, n a power of 2. The angle is reduced first, exactly: n f and whole multiples of the rate (a
 * whole number) are. */
static void phasors(const struct ir_sampler *s, int k, double n, double *re, double *im)
{
    double size[LANES], turn[LANES];
    for (int l = 0; l < LANES; l++) {
        double x = n * s->frequency[LANES * k + l];
        turn[l] = 2.0 * ((x - s->rate * floor(x / s->rate)) / s->rate);
        size[l] = -s->decay[LANES * k + l] * n / s->rate;
    }
    vecmath_exp(LANES, size, size);
    vecmath_sincospi(LANES, turn, im, re);
    for (int l = 0; l < LANES; l++) {
        re[l] *= size[l];
        im[l] *= size[l];
    }
}

struct ir_sampler *ir_sampler_make(struct arena *a, int n, double rate)
{
    struct ir_sampler *s = ARENA_TAKE(a, struct ir_sampler, 1);
    s->n = n;
    s->rate = rate;
    s->groups = (n + LANES - 1) / LANES;
    s->group = ARENA_TAKE(a, struct group, s->groups + 1);
    s->frequency = ARENA_TAKE(a, double, LANES *(size_t)s->groups);
    s->decay = ARENA_TAKE(a, double, LANES *(size_t)s->groups);
    for (int i = 0; i < n; i++)
        s->frequency[i] = NAN; /* no pole yet */
    return s;
}

static void set_poles(struct ir_sampler *s, const struct modes_point *p)
{
    for (int k = 0; k < s->groups; k++) {
        int from = LANES * k, n = s->n - from < LANES ? s->n - from : LANES;
        size_t bytes = (size_t)n * sizeof(double);
        bool same = memcmp(s->frequency + from, p->frequency + from, bytes) == 0 &&
                    memcmp(s->decay + from, p->decay + from, bytes) == 0;
        if (same) continue;
        memcpy(s->frequency + from, p->frequency + from, bytes);
        memcpy(s->decay + from, p->decay + from, bytes);
        phasors(s, k, 1.0, s->group[k].pr, s->group[k].pi);
        phasors(s, k, SEGMENT, s->group[k].Pr, s->group[k].Pi);
    }
}

/* Im z now; then z turns on by p. */
static inline __attribute__((always_inline)) double turn_on(double pr, double pi, double *zr, double *zi)
{
    double now = *zi, re = fma(pr, *zr, -(pi * now));
    *zi = fma(pr, now, pi * *zr);
    *zr = re;
    return now;
}

/* Adds Im z of n samples to sums[n][LANES]; n a multiple of SPAN. */
LANES_CLONES
static void ring(struct group *restrict group, int groups, double (*restrict sums)[LANES], size_t n)
{
    for (size_t i = 0; i < n; i += SPAN)
        for (int k = 0; k < groups; k++) {
            struct group *restrict g = &group[k];
#pragma omp simd
            for (int l = 0; l < LANES; l++) {
                double pr = g->pr[l], pi = g->pi[l], zr = g->zr[l], zi = g->zi[l];
                sums[i][l] += turn_on(pr, pi, &zr, &zi);
                sums[i + 1][l] += turn_on(pr, pi, &zr, &zi);
                sums[i + 2][l] += turn_on(pr, pi, &zr, &zi);
                sums[i + 3][l] += turn_on(pr, pi, &zr, &zi);
                g->zr[l] = zr;
                g->zi[l] = zi;
            }
        }
}

void ir_sample(struct ir_sampler *s, int quantity, const struct modes_point *p, double *h, size_t length)
{
    set_poles(s, p);
    for (int i = 0; i < s->n; i++) {
        struct group *g = &s->group[i / LANES];
        g->zr[i % LANES] = g->Zr[i % LANES] = p->re[i] / s->rate;
        g->zi[i % LANES] = g->Zi[i % LANES] = p->im[i] / s->rate;
    }
    memset(s->sums, 0, sizeof s->sums);
    for (size_t at = 0; at < length; at += SEGMENT) {
        size_t n = length - at < SEGMENT ? length - at : SEGMENT;
        ring(s->group, s->groups, s->sums, (n + SPAN - 1) / SPAN * SPAN);
        for (size_t i = 0; i < n; i++)
            h[at + i] = lanes_total(s->sums[i]);
        for (int k = 0; k < s->groups; k++) {
            struct group *g = &s->group[k];
            for (int l = 0; l < LANES; l++)
                turn_on(g->Pr[l], g->Pi[l], &g->Zr[l], &g->Zi[l]);
            memcpy(g->zr, g->Zr, sizeof g->zr);
            memcpy(g->zi, g->Zi, sizeof g->zi);
        }
        memset(s->sums, 0, sizeof s->sums);
    }
    h[0] = 0.5 * h[0] + modes_direct(quantity, s->n, s->frequency, s->decay, p);
}

/* An impulse response from a WAV.

   At the file's own rate r the convolution is y[n] = sum_m k[n - m] f[m], k = {x[0]/2, x[1], x[2], ...}/r: half of the
   first sample is the trapezium rule at the jump from 0 to h(0+) (ir.h). At another rate R the same operator is wanted
   for every force below both Nyquist frequencies, and that is the band-limited signal through {x[0]/2, x[1], ...}, read
   at n/R and divided by R: the half is taken once, before resampling, and the first sample that comes out counts whole.
   A recorded response is band-limited already and begins with silence, so that little depends on it. What a jump at the
   very first sample makes ring before t = 0 is folded into the first samples (num/filter.h), since a response is
   causal: its integral, the answer to what is slow, stays what it is. Values per second stay: nothing is scaled by the
   ratio of rates. */

static size_t cut(double rate, double t0, size_t n)
{
    size_t most = isnan(t0) ? n : ir_length(rate, t0);
    return most < n ? most : n;
}

static bool make(const char *path, const void *how, struct arena *a, void *thing, struct err *e)
{
    const struct ir_ask *ask = how;
    struct ir *ir = thing;
    struct wav w;
    if (!wav_read(path, a, &w, e)) return false;
    if (w.channels != 1)
        return err_set(e, ERR_SCENE,
                       "%s: has %d channels; an impulse response is mono: write one channel into a file of its own",
                       path, w.channels);
    size_t before = cut(w.rate, ask->t0, w.frames), still = 0;
    while (still < before && w.x[still] == 0.0)
        still++;
    if (still == before)
        return err_set(e, ERR_SCENE,
                       "%s: the impulse response is silent%s; give one that rings, or leave the response out", path,
                       before < w.frames ? " before response_length" : "");
    w.x[0] *= 0.5;
    double *h = w.x;
    *ir = (struct ir){.length = w.frames};
    if (w.rate != ask->rate) {
        ir->note = arena_format(a, "%s: resampled from %g Hz to %g Hz", ask->path, w.rate, ask->rate);
        if (!resample(a, w.x, w.frames, w.rate, ask->rate, &h, &ir->length, e)) return err_at(e, "%s", ask->path);
    }
    ir->length = cut(ask->rate, ask->t0, ir->length);
    for (size_t n = 0; n < ir->length; n++)
        h[n] /= ask->rate;
    ir->h = h;
    return true;
}

bool ir_read(const struct ir_ask *ask, struct arena *a, struct ir *ir, struct err *e)
{
    static const struct file_cache_kind recorded = {"recorded response", sizeof(struct ir), make, false};
    const char *key = ask->file_cache ? arena_format(a, "%a %a", ask->rate, ask->t0) : NULL;
    const struct ir *found =
        file_cache_take(ask->file_cache, &(struct file_cache_ask){&recorded, ask->path, key, ask}, a, e);
    if (found) *ir = *found;
    return found;
}

/* A folder of responses and where they were measured: index.csv, one row per WAV,

       file_name,x_m,y_m[,z_m][,gain_db]

   file_name relative to the folder and inside it; x_m, y_m in the surface's coordinates; z_m, if there is one, 0
   (places lie in the plane); gain_db is applied to the samples (a microphone's gain undone, say). Rates and lengths may
   differ. One row holds everywhere. */

enum { FILE_NAME, X, Y, Z, GAIN, COLUMNS };
static const char *const names[COLUMNS] = {"file_name", "x_m", "y_m", "z_m", "gain_db"};
static const double most_gain = 200.0; /* dB */

struct reader {
    const struct ir_ask *ask;
    struct csv table;
    int column[COLUMNS];
    struct arena *arena;
    struct err *e;
};

static bool at(const struct reader *r, size_t row) { return err_at(r->e, "%s:%d", r->table.file, r->table.lines[row]); }

static const char *cell(const struct reader *r, size_t row, int what)
{
    return r->table.cells[row * r->table.columns + (size_t)r->column[what]];
}

static bool find_columns(struct reader *r)
{
    for (int c = 0; c < COLUMNS; c++) {
        r->column[c] = csv_column(&r->table, names[c]);
        if (r->column[c] < 0 && c <= Y)
            return err_set(r->e, ERR_SCENE,
                           "%s: no column '%s'; its columns are file_name,x_m,y_m and, if you like, z_m and gain_db",
                           r->table.file, names[c]);
    }
    for (size_t k = 0; k < r->table.columns; k++) {
        bool known = false;
        for (int c = 0; c < COLUMNS; c++)
            known = known || r->column[c] == (int)k;
        if (!known)
            return err_set(
                r->e, ERR_SCENE,
                "%s: column '%s' is not known; the columns are file_name,x_m,y_m and, if you like, z_m and gain_db",
                r->table.file, r->table.names[k]);
    }
    return r->table.rows > 0 || err_set(r->e, ERR_SCENE, "%s: has no rows; name at least one response", r->table.file);
}

/* Whether a component of the path is "..", or it starts at the root. */
static bool escapes(const char *name)
{
    if (name[0] == '/') return true;
    for (const char *part = name; part; part = strchr(part, '/') ? strchr(part, '/') + 1 : NULL)
        if (strncmp(part, "..", 2) == 0 && (part[2] == '/' || part[2] == '\0')) return true;
    return false;
}

static bool check_name(const struct reader *r, size_t row)
{
    const char *name = cell(r, row, FILE_NAME);
    if (name[0] == '\0') return err_set(r->e, ERR_SCENE, "file_name is empty") || at(r, row);
    if (escapes(name))
        return err_set(r->e, ERR_SCENE, "'%s' leads out of the folder; name a file inside it", name) || at(r, row);
    for (size_t other = 0; other < row; other++)
        if (strcmp(cell(r, other, FILE_NAME), name) == 0)
            return err_set(r->e, ERR_SCENE, "'%s' is in line %d already; a response has one place: remove one line",
                           name, r->table.lines[other]) ||
                   at(r, row);
    return true;
}

static bool number(const struct reader *r, size_t row, int what, double *value)
{
    *value = 0.0;
    return r->column[what] < 0 || csv_number(&r->table, row, r->column[what], value, r->e);
}

static bool read_response(const struct reader *r, size_t row, struct ir *ir)
{
    double gain;
    if (!number(r, row, GAIN, &gain)) return false;
    if (fabs(gain) > most_gain)
        return err_set(r->e, ERR_SCENE, "gain_db is %g; it lies between -200 and 200 dB", gain) || at(r, row);
    struct ir_ask one = *r->ask;
    one.path = arena_format(r->arena, "%s/%s", r->ask->path, cell(r, row, FILE_NAME));
    if (!ir_read(&one, r->arena, ir, r->e)) return at(r, row);
    if (gain != 0.0) {
        double *h = ARENA_TAKE(r->arena, double, ir->length);
        scaled_copy(h, real_exp10(gain / 20.0), ir->h, (long)ir->length);
        ir->h = h;
    }
    return true;
}

static const char *note_of(const struct reader *r, const struct ir_set *s)
{
    const char *first = NULL;
    int n = 0;
    for (int k = 0; k < s->n; k++)
        if (s->ir[k].note) {
            first = first ? first : s->ir[k].note;
            n++;
        }
    return n < 2 ? first : arena_format(r->arena, "%s (and %d more of the folder's %d responses)", first, n - 1, s->n);
}

struct spot {
    double x, y;
    size_t row;
};

static int spot_order(const void *a, const void *b)
{
    const struct spot *p = a, *q = b;
    if (p->x != q->x) return p->x < q->x ? -1 : 1;
    return p->y != q->y ? (p->y < q->y ? -1 : 1) : (p->row > q->row) - (p->row < q->row);
}

/* Responses are kept by x, then y: in what order rows stand tells nothing. */
static bool take_in_order(const struct reader *r, const double *xy, struct ir_set *s)
{
    struct spot *spot = ARENA_TAKE(r->arena, struct spot, s->n);
    int *place = ARENA_TAKE(r->arena, int, s->n);
    for (int k = 0; k < s->n; k++)
        spot[k] = (struct spot){xy[2 * k], xy[2 * k + 1], (size_t)k};
    qsort(spot, (size_t)s->n, sizeof *spot, spot_order);
    for (int k = 0; k < s->n; k++)
        place[spot[k].row] = k;
    for (int row = 0; row < s->n; row++)
        if (!read_response(r, (size_t)row, &s->ir[place[row]])) return false;
    double *sorted = ARENA_TAKE(r->arena, double, 2 * (size_t)s->n);
    int bad;
    for (int k = 0; k < s->n; k++) {
        sorted[2 * k] = spot[k].x;
        sorted[2 * k + 1] = spot[k].y;
    }
    return places_make(r->arena, s->n, sorted, &s->places, &bad, r->e);
}

static bool read_rows(const struct reader *r, struct ir_set *s)
{
    int bad = -1;
    double *xy = ARENA_TAKE(r->arena, double, 2 * r->table.rows);
    for (size_t row = 0; row < r->table.rows; row++) {
        double z;
        if (!check_name(r, row) || !number(r, row, X, &xy[2 * row]) || !number(r, row, Y, &xy[2 * row + 1]) ||
            !number(r, row, Z, &z))
            return false;
        if (z != 0.0)
            return err_set(r->e, ERR_SCENE, "z_m is %g; places lie in the surface's plane, where it is 0", z) ||
                   at(r, row);
    }
    if (!places_make(r->arena, (int)r->table.rows, xy, &s->places, &bad, r->e))
        return bad < 0 ? err_at(r->e, "%s", r->table.file) : at(r, (size_t)bad);
    s->n = (int)r->table.rows;
    s->ir = ARENA_TAKE(r->arena, struct ir, s->n);
    if (!take_in_order(r, xy, s)) return false;
    s->note = note_of(r, s);
    return true;
}

bool ir_set_read(const struct ir_ask *ask, struct arena *a, struct ir_set *s, struct err *e)
{
    struct reader r = {.ask = ask, .arena = a, .e = e};
    *s = (struct ir_set){0};
    if (!csv_read_file(arena_format(a, "%s/index.csv", ask->path), a, &r.table, e))
        return e->kind == ERR_INPUT ? err_at(e, "a folder of responses has its places in index.csv (file_name,x_m,y_m)")
                                    : false;
    return find_columns(&r) && read_rows(&r, s);
}
