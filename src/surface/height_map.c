/* A measured map or profile under the contact: file, spline, checks of its geometry. */
#include "surface/height_map.h"

#include "base/file_cache.h"
#include "base/stopwatch.h"
#include "file/heightfile.h"
#include "num/lanes.h"
#include "num/real.h"
#include "scene/rows.h"
#include "stage.h"
#include "surface/bicubic.h"
#include "surface/limiter.h"
#include "trajectory/trajectory.h"

/* ------------------------------------------------------------------ parameters */

#define MAP "surface.height_map"

static const struct choice off_maps[] = {[OFF_MAP_MIRROR] = {"mirror", "the profile mirrored at its ends, for ever"},
                                         [OFF_MAP_WRAP] = {"wrap", "the profile repeated"},
                                         [OFF_MAP_ERROR] = {"error", "a motion that leaves the map is refused"},
                                         {NULL, NULL}};

static const struct choice holes[] = {
    [HEIGHTFILE_REFUSE] = {"refuse", "a map with missing points is an error"},
    [HEIGHTFILE_FILL] = {"fill", "missing points are filled from their surroundings (Laplace's equation)"},
    {NULL, NULL}};

static const struct choice levellings[] = {
    [HEIGHTFILE_LEVEL_NONE] = {"none", "heights as they are"},
    [HEIGHTFILE_LEVEL_MEAN] = {"mean", "the mean height is subtracted"},
    [HEIGHTFILE_LEVEL_PLANE] = {"plane", "the least-squares plane (line of a profile) is subtracted"},
    {NULL, NULL}};

static const struct key keys[] = {
    {ROW_FILE(height_map_file, path, MAP), KEY_NONE, 0, 0, "", NULL,
     "measured height map or profile: GSF, SDF, GWY, NPY, 16-bit PNG, or CSV grid; told apart by content",
     .example = "profile.npy", .shown = "plank.npy"},
    {ROW_NUMBER(height_map_file, read.pitch, "surface.pitch"), KEY_LENGTH, 1e-8, 1e-3, "", MAP,
     "distance between two samples of the height map; must be given for NPY, PNG and CSV, which do not hold it",
     .shown = "5 um"},
    {ROW_NUMBER(height_map_file, read.height_scale, "surface.height_scale"), KEY_LENGTH, 1e-12, 1e3, "1 m", MAP,
     "factor on the heights: what one stored unit of NPY or CSV stands for (GSF, SDF and GWY hold metres already)"},
    {ROW_NUMBER(height_map_file, read.height_range, "surface.height_range"), KEY_LENGTH, 1e-9, 1e-1, "", MAP,
     "height that white, 65535, of a PNG stands for; must be given for PNG", .shown = "100 um"},
    {ROW_CHOICE(height_map_file, off_map, "surface.off_map"), KEY_NONE, 0, 0, "mirror", MAP,
     "what lies beyond the ends of a height map", off_maps},
    {ROW_CHOICE(height_map_file, read.holes, "surface.holes"), KEY_NONE, 0, 0, "refuse", MAP,
     "what happens to missing points", holes},
    {ROW_CHOICE(height_map_file, read.levelling, "surface.levelling"), KEY_NONE, 0, 0, "none", MAP,
     "what is subtracted from a height map", levellings},
    {.path = NULL}};

static bool given(const struct contact *c);

/* Only the file has the number of its rows. */
static int directed(const void *own)
{
    (void)own;
    return -1;
}

static double likely_finest(const void *own)
{
    const struct height_map_file *m = own;
    return m->path && !isnan(m->read.pitch) ? m->read.pitch : RELIEF_MAP_PITCH;
}

static double likely_span(const void *own)
{
    (void)own;
    return RELIEF_MAP_SPAN;
}

static const struct params height_map_params = {
    .section = MAP,
    .size = sizeof(struct height_map_file),
    .keys = keys,
    .given = given,
    .ground = &(const struct params_ground){.directed = directed, .finest = likely_finest, .span = likely_span},
};

static const struct height_map_file *map_of(const struct contact *c) { return params_of(c, &height_map_params); }

static bool given(const struct contact *c) { return map_of(c)->path != NULL; }

double height_map_pitch(const struct contact *c) { return likely_finest(map_of(c)); }

/* ------------------------------------------------------------------ a map as a part of a relief */

/* ------------------------------------------------------------------ the spline */

/* Height maps as tensor-product cubic splines: C2, so that curvature in any direction is continuous. The coefficients
   are those of surface/profile.c, along rows, then along columns; they are read by surface/bicubic.c. */

struct map {
    struct height_map_spline spline;
    double origin[2];
};

/* The 4 x 4 coefficients around a cell, in rows `stride` numbers apart: in the map, or at its edges gathered. */
static const double *map_around(const struct height_map_spline *m, long column, long row, double edge[16], long *stride)
{
    if (column >= 1 && column + 2 < m->columns && row >= 1 && row + 2 < m->rows) {
        *stride = m->columns;
        return m->c + (row - 1) * m->columns + column - 1;
    }
    *stride = 4;
    long across[4];
    for (long i = 0; i < 4; i++)
        across[i] = profile_folded(column - 1 + i, m->columns, m->off_map);
    for (long j = 0; j < 4; j++) {
        const double *from = m->c + profile_folded(row - 1 + j, m->rows, m->off_map) * m->columns;
        for (long i = 0; i < 4; i++)
            edge[4 * j + i] = from[across[i]];
    }
    return edge;
}

LANES_CLONES
static void places(const struct map *m, int n, const double *x, const double *y, double *p[2])
{
    double *restrict px = p[0], *restrict py = p[1], from[2] = {m->origin[0], m->origin[1]},
                     pitch[2] = {m->spline.pitch[0], m->spline.pitch[1]};
#pragma omp simd
    for (int i = 0; i < n; i++) {
        px[i] = (x[i] - from[0]) / pitch[0];
        py[i] = (y[i] - from[1]) / pitch[1];
    }
}

LANES_CLONES
static void values_put(int n, const double *from, double base, double *to)
{
#pragma omp simd
    for (int i = 0; i < n; i++)
        to[i] += base + from[i];
}

static void map_add(struct relief_part *part, const struct relief_points *p, const struct relief_values *v)
{
    const struct map *m = part->state;
    struct bicubic b;
    double px[BICUBIC_POINTS], py[BICUBIC_POINTS];
    for (size_t at = 0; at < p->n; at += BICUBIC_POINTS) {
        int n = p->n - at < BICUBIC_POINTS ? (int)(p->n - at) : BICUBIC_POINTS;
        places(m, n, p->x + at, p->y + at, (double *[2]){px, py});
        bicubic_cells(&b, n, px, py);
        for (int i = 0, end; i < n; i = end) {
            double edge[16];
            long stride;
            const double *from = map_around(&m->spline, (long)b.column[i], (long)b.row[i], edge, &stride);
            end = bicubic_run(&b, i);
            bicubic_put(&b, i, end, from, stride);
        }
        bicubic_sum(&b, 1 / m->spline.pitch[0], 1 / m->spline.pitch[1], v);
        const double *from[6] = {b.z, b.x, b.y, b.xx, b.xy, b.yy};
        double *to[6] = {v->z, v->x, v->y, v->xx, v->xy, v->yy};
        for (int k = 0; k < 6; k++)
            if (to[k]) values_put(b.n, from[k], k == 0 ? m->spline.base : 0, to[k] + at);
    }
}

/* Along rows into c, then along columns in place, one column at a time; then above the first. */
static void map_coefficients(struct height_map_spline *m, const double *z, struct arena *a)
{
    stopwatch_spend(60 * (double)(m->rows * m->columns));
    double *column = ARENA_TAKE(a, double, m->rows), *smooth = ARENA_TAKE(a, double, m->rows);
    for (long j = 0; j < m->rows; j++)
        profile_coefficients(z + j * m->columns, m->c + j * m->columns, (size_t)m->columns, m->off_map);
    for (long i = 0; i < m->columns; i++) {
        for (long j = 0; j < m->rows; j++)
            column[j] = m->c[j * m->columns + i];
        profile_coefficients(column, smooth, (size_t)m->rows, m->off_map);
        for (long j = 0; j < m->rows; j++)
            m->c[j * m->columns + i] = smooth[j];
    }
    m->base = m->c[0];
    for (long k = 0; k < m->columns * m->rows; k++)
        m->c[k] -= m->base;
}

struct height_map_spline *height_map_spline(struct arena *a, const struct height_map *h, int off_map)
{
    struct height_map_spline *m = ARENA_TAKE(a, struct height_map_spline, 1);
    *m = (struct height_map_spline){.columns = (long)h->columns,
                                    .rows = (long)h->rows,
                                    .pitch = {h->pitch[0], h->pitch[1]},
                                    .off_map = off_map,
                                    .c = ARENA_TAKE(a, double, h->columns * h->rows)};
    map_coefficients(m, h->z, a);
    return m;
}

struct relief_part *height_map_part(struct arena *a, const struct height_map_spline *spline, const double origin[2],
                                    const char *name)
{
    struct relief_part *part = ARENA_TAKE(a, struct relief_part, 1);
    struct map *m = ARENA_TAKE(a, struct map, 1);
    const double *pitch = spline->pitch;
    *m = (struct map){*spline, {origin[0], origin[1]}};
    *part = (struct relief_part){
        .name = name,
        .pitch = {pitch[0], pitch[1]},
        .origin = {origin[0], origin[1]},
        .finest = pitch[0] < pitch[1] ? pitch[0] : pitch[1],
        .from = {origin[0], origin[1]},
        .to = {origin[0] + pitch[0] * (double)(spline->columns - 1), origin[1] + pitch[1] * (double)(spline->rows - 1)},
        .add = map_add,
        .reading = 40,
        .state = m};
    return part;
}

/* ------------------------------------------------------------------ the stage */

/* Stored steps make curvature noise: steps of size q, rounded evenly, have a standard deviation of q / sqrt(12), their
   second difference sqrt(6) times as much over pitch^2, and the spline through them 1.55 times that on average. Above a
   tenth of the limit 1/alpha it is heard. */
static void height_map_grain(struct stage_run *r, const struct heightfile *h)
{
    const struct limiter *l = limiter_of(r->contact);
    double step = h->step, noise = 1.55 * sqrt(0.5) * step / (h->pitch_x * h->pitch_x),
           limit = 1 / fmax(l->alpha, l->alpha_max);
    if (l->curve == LIMITER_TANH && noise > 0.1 * limit)
        board_warn(r->board, arena_format(r->arena,
                                          "%s: heights are stored in steps of %.3g m, whose curvature noise of %.3g "
                                          "1/m is heard: the limiter's is "
                                          "%.3g 1/m; use a finer file (32-bit), or a coarser pitch",
                                          map_of(r->contact)->path, step, noise, limit));
}

/* A map as it was read, with its spline: what all stimuli of a set share. */
struct height_map_read {
    struct heightfile file;
    struct height_map map;
    struct height_map_spline *plane; /* NULL: a profile                     */
    double *line;                    /* [columns] a profile's coefficients  */
    const char *doubts[HEIGHTFILE_WARNINGS];
    int n_doubts;
};

static bool height_map_make(const char *path, const void *how, struct arena *a, void *thing, struct err *e)
{
    const struct height_map_file *s = how;
    struct height_map_read *m = thing;
    struct heightfile *h = &m->file;
    *m = (struct height_map_read){0};
    if (!heightfile_load(path, &s->read, a, h, e)) return false;
    m->n_doubts = heightfile_warnings(h, NULL, a, m->doubts);
    m->map = (struct height_map){h->z, h->columns, h->rows, {h->pitch_x, h->rows > 1 ? h->pitch_y : h->pitch_x}};
    if (h->rows > 1) {
        m->plane = height_map_spline(a, &m->map, s->off_map);
        return true;
    }
    m->line = ARENA_TAKE(a, double, h->columns);
    profile_coefficients(h->z, m->line, h->columns, s->off_map);
    return true;
}

static const struct height_map_read *height_map_load(struct stage_run *r, struct err *e)
{
    static const struct file_cache_kind maps = {"height map", sizeof(struct height_map_read), height_map_make, false};
    const struct height_map_file *s = map_of(r->contact);
    const char *key = arena_format(r->arena, "%a %a %a %d %d %d", s->read.pitch, s->read.height_scale,
                                   s->read.height_range, s->read.holes, s->read.levelling, s->off_map);
    const struct height_map_read *m =
        file_cache_take(r->scene->file_cache, &(struct file_cache_ask){&maps, s->path, key, s}, r->arena, e);
    if (m && m->file.filled)
        board_warn(r->board, arena_format(r->arena, "%s: %zu missing points were filled", s->path, m->file.filled));
    if (m) height_map_grain(r, &m->file);
    for (int k = 0; m && k < m->n_doubts; k++)
        board_warn(r->board, arena_format(r->arena, "%s: %s", s->path, m->doubts[k]));
    return m;
}

/* Decides which coordinates the surface follows, from the number of rows. */
static bool height_map_along(struct relief *r, const struct contact *c, const struct height_map *m, struct err *e)
{
    if (r->along == ALONG_AUTO) r->along = m->rows > 1 ? ALONG_PLANE : ALONG_PATH;
    if (m->rows > 1 && r->along != ALONG_PLANE)
        return err_set(e, ERR_SCENE,
                       "%s: a map of %zu x %zu samples lies in the plane: leave surface.along out, or take one row of "
                       "it with rasp surface convert --row",
                       map_of(c)->path, m->columns, m->rows);
    return m->rows > 1 || r->along != ALONG_PLANE ||
           err_set(e, ERR_SCENE,
                   "%s: a profile has no second dimension: leave surface.along out, or set it to path or x",
                   map_of(c)->path);
}

static struct relief_part *part_of(struct stage_run *r, const struct height_map_read *m)
{
    if (r->board->relief->along == ALONG_PLANE)
        return height_map_part(r->arena, m->plane, (double[]){0, 0}, "height_map");
    struct profile *p =
        profile_from_coefficients(r->arena, m->line, m->map.columns, m->map.pitch[0], map_of(r->contact)->off_map);
    return profile_part(r->arena, p, "height_map", 0);
}

/* surface.off_map: error. */
static bool height_map_inside(const struct stage_run *r, const struct relief_part *p, struct err *e)
{
    const struct trajectory *tr = r->board->trajectory;
    bool path = r->board->relief->along == ALONG_PATH;
    for (int axis = 0; axis < (r->board->relief->along == ALONG_PLANE ? 2 : 1); axis++) {
        const double *least = path ? &tr->reach[0] : &tr->box[0][axis],
                     *most = path ? &tr->reach[1] : &tr->box[1][axis];
        double from = p->from[axis] + relief_shift(r->board->relief, axis),
               to = p->to[axis] + relief_shift(r->board->relief, axis);
        double slack = 1e-9 * p->pitch[axis], out = *least < from - slack ? *least : *most;
        if (*least < from - slack || *most > to + slack)
            return err_about(e, r->contact->name, "motion") ||
                   err_set(e, ERR_SCENE,
                           "contact '%s': the motion leaves the height map: it reaches %g m %s, and the map goes from "
                           "%g to %g m; shorten or move "
                           "the motion, or set surface.off_map to mirror or wrap",
                           r->contact->name, out,
                           path   ? "along the path"
                           : axis ? "in y"
                                  : "in x",
                           from, to);
    }
    return true;
}

static bool height_map_open(struct stage_run *r, struct err *e)
{
    const struct height_map_read *m = height_map_load(r, e);
    if (!m || !height_map_along(r->board->relief, r->contact, &m->map, e)) return false;
    struct relief_part *part = part_of(r, m);
    relief_add(r->board->relief, part);
    r->board->height_map = &m->map;
    r->state = part;
    return map_of(r->contact)->off_map != OFF_MAP_ERROR || height_map_inside(r, part, e);
}

const struct stage height_map_stage = {
    .name = "height_map",
    .does = "measured map as a cubic spline",
    .paper = "000 sec. 2.2",
    .idle = "no surface.height_map",
    .params = &height_map_params,
    .needs = ITEM_BIT(ITEM_SURFACE),
    .gives = ITEM_BIT(ITEM_SURFACE),
    .open = height_map_open,
};
