/* See heightfile.h: which format it is, and what all have in common. */
#include "file/heightfile.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "base/outfile.h"
#include "file/heightfile_formats.h"
#include "file/npy.h"

/* CSV last: it takes any text that begins with a number. */
static const struct {
    const char *ending;
    enum heightfile_format format;
    bool (*is)(const struct bytes *b);
    bool (*read)(const char *path, const struct bytes *b, struct arena *a, struct heightfile *h, struct err *e);
} formats[] = {
    {".npy", HEIGHTFILE_NPY, npy_is, heightfile_formats_npy_read},
    {".gsf", HEIGHTFILE_GSF, heightfile_formats_gsf_is, heightfile_formats_gsf_read},
    {".gwy", HEIGHTFILE_GWY, heightfile_gwy_is, heightfile_gwy_read},
    {".png", HEIGHTFILE_PNG, heightfile_formats_png_is, heightfile_formats_png_read},
    {".sdf", HEIGHTFILE_SDF, heightfile_sdf_is, heightfile_sdf_read},
    {".csv", HEIGHTFILE_CSV, heightfile_formats_csv_is, heightfile_formats_csv_read},
};

bool heightfile_room(const char *path, struct heightfile *h, struct arena *a, struct err *e)
{
    size_t n;
    if (h->columns == 0 || h->rows == 0)
        return err_set(e, ERR_SCENE, "%s: the map is empty (%zu x %zu)", path, h->columns, h->rows);
    if (__builtin_mul_overflow(h->columns, h->rows, &n) || n > HEIGHTFILE_MOST)
        return err_set(e, ERR_SCENE,
                       "%s: a map of %zu x %zu samples; at most %zu are read (16384 x 16384, 2 GiB of memory): crop or "
                       "bin it first",
                       path, h->columns, h->rows, HEIGHTFILE_MOST);
    h->z = ARENA_TAKE(a, double, n);
    return true;
}

/* Counts holes, refuses infinities, finds the quantum. */
static bool look_over(const char *path, struct heightfile *h, struct err *e)
{
    double most = 0;
    int power;
    for (size_t i = 0; i < h->rows * h->columns; i++) {
        if (isinf(h->z[i]))
            return err_set(e, ERR_SCENE,
                           "%s: the height at row %zu, column %zu (counted from 0) is infinite; write NaN for a hole",
                           path, i / h->columns, i % h->columns);
        if (isnan(h->z[i])) {
            h->first_hole = h->holes ? h->first_hole : i;
            h->holes++;
        } else
            most = fmax(most, fabs(h->z[i]));
    }
    frexp(most, &power);
    h->quantum = h->step > 0 ? h->step : h->bits > 0 && most > 0 ? ldexp(1, power - h->bits) : 0;
    return true;
}

bool heightfile_read(const char *path, struct arena *a, struct heightfile *h, struct err *e)
{
    struct bytes b;
    struct stat s;
    size_t k = 0, n = sizeof formats / sizeof formats[0];
    double most = 32 * (double)HEIGHTFILE_MOST; /* text takes at most 32 bytes a number */
    *h = (struct heightfile){.pitch_x = NAN, .pitch_y = NAN};
    if (stat(path, &s) == 0 && (double)s.st_size > most)
        return err_set(e, ERR_SCENE,
                       "%s: has %.3g bytes, more than a height map of %zu samples takes; crop or bin it first", path,
                       (double)s.st_size, HEIGHTFILE_MOST);
    struct arena *file = arena_open();
    bool ok = bytes_read(path, file, &b, e);
    while (ok && k < n && !formats[k].is(&b))
        k++;
    if (ok && k == n)
        ok = err_set(e, ERR_SCENE, "%s: is no height map: neither GSF, GWY, SDF, NPY, PNG nor a CSV grid of numbers%s",
                     path, b.n ? "" : ": it is empty; write it again, or name another file");
    ok = ok && formats[k].read(path, &b, a, h, e) && look_over(path, h, e);
    arena_close(file);
    return ok;
}

/* With places u, v counted from the middle of the map in samples, the plane m + p u + q v
   solves the normal equations of least squares; missing points make them a full 3 x 3 system, solved by Cholesky's
   decomposition. */

struct sums {
    double n, u, v, uu, uv, vv, z, zu, zv;
};

/* Row by row, so that rounding errors stay those of short sums. */
static struct sums level_sums(const struct heightfile *h)
{
    struct sums s = {0};
    double cu = 0.5 * (double)(h->columns - 1), cv = 0.5 * (double)(h->rows - 1);
    for (size_t j = 0; j < h->rows; j++) {
        double n = 0, u = 0, uu = 0, z = 0, zu = 0, v = (double)j - cv;
        for (size_t i = 0; i < h->columns; i++) {
            double x = (double)i - cu, height = h->z[j * h->columns + i];
            if (isnan(height)) continue;
            n += 1;
            u += x;
            uu += x * x;
            z += height;
            zu += height * x;
        }
        s.n += n, s.u += u, s.v += n * v, s.uu += uu, s.uv += u * v, s.vv += n * v * v, s.z += z, s.zu += zu,
            s.zv += z * v;
    }
    return s;
}

struct heightfile_plane heightfile_level_fit(const struct heightfile *h)
{
    struct sums s = level_sums(h);
    double x[3] = {0};
    if (s.n > 0) { /* [n u v; u uu uv; v uv vv] x = [z zu zv]; a pivot that is nothing beside its diagonal is a
                      direction without extent */
        double l10 = s.u / s.n, l20 = s.v / s.n, d1 = s.uu - l10 * s.u, b1 = s.zu - l10 * s.z;
        bool wide = d1 > 1e-9 * (s.uu + 1);
        double c21 = s.uv - l10 * s.v, l21 = wide ? c21 / d1 : 0;
        double d2 = s.vv - l20 * s.v - l21 * c21, b2 = s.zv - l20 * s.z - l21 * b1;
        x[2] = d2 > 1e-9 * (s.vv + 1) ? b2 / d2 : 0;
        x[1] = wide ? b1 / d1 - l21 * x[2] : 0;
        x[0] = s.z / s.n - l10 * x[1] - l20 * x[2];
    }
    return (struct heightfile_plane){x[0], isnan(h->pitch_x) ? x[1] : x[1] / h->pitch_x,
                                     isnan(h->pitch_y) ? x[2] : x[2] / h->pitch_y};
}

struct heightfile_plane heightfile_level(struct heightfile *h, enum heightfile_levelling levelling)
{
    struct heightfile_plane p = {0};
    if (levelling == HEIGHTFILE_LEVEL_NONE) return p;
    p = heightfile_level_fit(h);
    if (levelling == HEIGHTFILE_LEVEL_MEAN) {
        struct sums s = level_sums(h);
        p = (struct heightfile_plane){s.n > 0 ? s.z / s.n : 0, 0, 0};
    }
    double sx = isnan(h->pitch_x) ? p.slope_x : p.slope_x * h->pitch_x,
           sy = isnan(h->pitch_y) ? p.slope_y : p.slope_y * h->pitch_y;
    double cu = 0.5 * (double)(h->columns - 1), cv = 0.5 * (double)(h->rows - 1);
    for (size_t j = 0; j < h->rows; j++)
        for (size_t i = 0; i < h->columns; i++)
            h->z[j * h->columns + i] -= p.mean + sx * ((double)i - cu) + sy * ((double)j - cv);
    return p;
}

/* With weights w = 1/pitch^2 of the two directions, each missing height is the weighted mean of
   its neighbours in the map:

     sum over neighbours n of w_n (z_n - z) = 0,        known neighbours on the right-hand side

   a symmetric, positive definite system (every hole touches a known height), solved by conjugate gradients with its
   diagonal as preconditioner, all sums in order: the same bits everywhere. A harmonic polynomial up to the third degree
   solves it exactly. The number of steps goes with the width of the widest hole in samples. */

enum { FILL_KNOWN = -1 };

struct fill {
    size_t n;             /* unknowns                                                 */
    uint32_t *place;      /* [n] index in the map, rising                             */
    int32_t (*beside)[4]; /* [n] left, right, up, down: unknown, or FILL_KNOWN      */
    double *diagonal;     /* [n]                                                      */
    double *x, *r, *p, *q;
    double weight[2]; /* along rows, across                                       */
};

static int by_place(const void *a, const void *b)
{
    uint32_t p = *(const uint32_t *)a, q = *(const uint32_t *)b;
    return (p > q) - (p < q);
}

/* The unknowns, their neighbours, the diagonal, and the right-hand side in r: heights from the middle of their range,
 * in units of it. */
static void fill_system(struct fill *f, const struct heightfile *h, double middle, double span)
{
    const size_t step[4] = {(size_t)-1, 1, -h->columns, h->columns};
    size_t k = 0;
    for (size_t i = 0; i < h->rows * h->columns; i++)
        if (isnan(h->z[i])) f->place[k++] = (uint32_t)i;
    for (k = 0; k < f->n; k++)
        for (int side = 0; side < 4; side++) {
            size_t column = f->place[k] % h->columns, row = f->place[k] / h->columns, there = f->place[k] + step[side];
            const bool inside[4] = {column > 0, column + 1 < h->columns, row > 0, row + 1 < h->rows};
            f->beside[k][side] = FILL_KNOWN;
            if (!inside[side]) continue;
            f->diagonal[k] += f->weight[side / 2];
            if (isnan(h->z[there]))
                f->beside[k][side] = (int32_t)((uint32_t *)bsearch(&(uint32_t){(uint32_t)there}, f->place, f->n,
                                                                   sizeof *f->place, by_place) -
                                               f->place);
            else
                f->r[k] += f->weight[side / 2] * ((h->z[there] - middle) / span);
        }
}

/* Largest residual over its diagonal: as a height. Infinite if one is not a number (which fmax would pass over). */
static double fill_residual(const struct fill *f)
{
    double most = 0;
    for (size_t k = 0; k < f->n; k++) {
        double r = fabs(f->r[k]) / f->diagonal[k];
        most = isnan(r) ? HUGE_VAL : fmax(most, r);
    }
    return most;
}

static double fill_product(const struct fill *f)
{
    double sum = 0;
    for (size_t k = 0; k < f->n; k++)
        sum += f->r[k] * f->r[k] / f->diagonal[k];
    return sum;
}

static bool fill_solve(struct fill *f, double tolerance)
{
    double rho = fill_product(f);
    for (size_t k = 0; k < f->n; k++)
        f->p[k] = f->r[k] / f->diagonal[k];
    for (size_t step = 0; step < 100000 && fill_residual(f) > tolerance; step++) {
        double pq = 0, before = rho;
        for (size_t k = 0; k < f->n; k++) { /* q = A p */
            double sum = f->diagonal[k] * f->p[k];
            for (int side = 0; side < 4; side++)
                if (f->beside[k][side] >= 0) sum -= f->weight[side / 2] * f->p[f->beside[k][side]];
            f->q[k] = sum;
            pq += f->p[k] * sum;
        }
        if (!(pq > 0)) return false;
        for (size_t k = 0; k < f->n; k++) {
            f->x[k] += rho / pq * f->p[k];
            f->r[k] -= rho / pq * f->q[k];
        }
        rho = fill_product(f);
        for (size_t k = 0; k < f->n; k++)
            f->p[k] = f->r[k] / f->diagonal[k] + rho / before * f->p[k];
    }
    return fill_residual(f) <= tolerance;
}

/* Missing ones are left out: fmin passes over NaN. */
static void extremes(const struct heightfile *h, double *low, double *high)
{
    *low = HUGE_VAL, *high = -HUGE_VAL;
    for (size_t i = 0; i < h->rows * h->columns; i++) {
        *low = fmin(*low, h->z[i]);
        *high = fmax(*high, h->z[i]);
    }
}

static bool fill_map(const char *path, struct heightfile *h, struct err *e)
{
    struct arena *own = arena_open();
    struct fill f = {.n = h->holes, .weight = {1, 1}};
    double low, high, **of[] = {&f.diagonal, &f.x, &f.r, &f.p, &f.q};
    if (!isnan(h->pitch_x) && !isnan(h->pitch_y)) f.weight[1] = h->pitch_x * h->pitch_x / (h->pitch_y * h->pitch_y);
    f.place = ARENA_TAKE(own, uint32_t, f.n);
    f.beside = arena_take(own, f.n, sizeof *f.beside);
    for (int k = 0; k < 5; k++)
        *of[k] = ARENA_TAKE(own, double, f.n);
    extremes(h, &low, &high);
    double middle = 0.5 * low + 0.5 * high, span = high > low ? high - low : 1;
    fill_system(&f, h, middle, span);
    bool ok = (isfinite(span) && f.weight[1] > 1e-30 && f.weight[1] < 1e30 && fill_solve(&f, 1e-12)) ||
              err_set(e, ERR_NUMBERS, "%s: its %zu missing points cannot be filled: the solution does not converge",
                      path, h->holes);
    for (size_t k = 0; ok && k < f.n; k++)
        h->z[f.place[k]] = middle + span * f.x[k];
    arena_close(own);
    return ok;
}

bool heightfile_fill(const char *path, struct heightfile *h, struct err *e)
{
    size_t n = h->rows * h->columns;
    if (h->holes == 0) return true;
    if (h->holes > n / 2)
        return err_set(e, ERR_SCENE,
                       "%s: %zu of %zu points are missing: too many to be filled (more than half): cut out a part that "
                       "has them (rasp surface convert --crop), or mend the file",
                       path, h->holes, n);
    if (h->rows > 1 && !fill_map(path, h, e)) return false;
    for (size_t from = 0, to; h->rows == 1 && from < n; from = to + 1) { /* a profile's gaps are straight lines */
        for (to = from; to < n && isnan(h->z[to]); to++)
            ;
        double before = from > 0 ? h->z[from - 1] : h->z[to], after = to < n ? h->z[to] : before;
        for (size_t i = from; i < to; i++) {
            double share = (double)(i - from + 1) / (double)(to - from + 1);
            h->z[i] = before * (1 - share) + after * share;
        }
    }
    h->filled = h->holes;
    h->holes = 0;
    return true;
}

/* Real surfaces are sampled between 10 nm and 1 mm and have heights between 1 nm and 10 mm;
   outside, a unit is wrong: metrology files do slip. */

static const struct heightfile_names scene_names = {"surface.pitch", "surface.height_scale", "surface.height_range",
                                                    "surface.holes: fill"};
const struct heightfile_names heightfile_load_option_names = {"--pitch", "--height-scale", "--height-range",
                                                              "--holes=fill"};

struct load {
    const char *path;
    const struct heightfile_options *o;
    const struct heightfile_names *names;
    struct heightfile *h;
    struct err *e;
};

/* The unit of which x metres are said, of those that bring it into the range: "", or " (were these micrometres ...)".
 */
static void slip(char text[120], double x, const double range[2])
{
    static const struct {
        const char *name;
        double metres;
    } units[] = {{"millimetres", 1e-3}, {"micrometres", 1e-6}, {"nanometres", 1e-9}};
    text[0] = '\0';
    for (int i = 0; i < 3; i++)
        if (x * units[i].metres >= range[0] && x * units[i].metres <= range[1]) {
            snprintf(text, 120, " (taken as %s it would be %g m)", units[i].name, x * units[i].metres);
            return;
        }
    for (int i = 0; i < 3; i++)
        if (x / units[i].metres >= range[0] && x / units[i].metres <= range[1]) {
            snprintf(text, 120, " (%g times that would make sense: was a unit applied twice?)", 1 / units[i].metres);
            return;
        }
}

/* One direction's pitch: the file's, or the one given, which must not be another. */
static bool take_pitch(const struct load *l, double *pitch)
{
    static const double likely[2] = {1e-7, 2e-4};
    char hint[120];
    double given = l->o->pitch;
    if (isnan(given) && isnan(*pitch))
        return err_set(l->e, ERR_SCENE, "%s: the file does not say how far apart its samples are: give %s", l->path,
                       l->names->pitch);
    if (!isnan(given) && !isnan(*pitch) && fabs(given / *pitch - 1) > 1e-6)
        return err_set(l->e, ERR_SCENE, "%s: %s is %g m but the file says %g m: leave %s out, or mend the file",
                       l->path, l->names->pitch, given, *pitch, l->names->pitch);
    *pitch = isnan(*pitch) ? given : *pitch;
    if (*pitch >= 10e-9 && *pitch <= 1e-3) return true;
    slip(hint, *pitch, likely);
    return err_set(l->e, ERR_SCENE,
                   "%s: a pitch of %g m between samples is not that of a surface profile (10 nm to 1 mm); check %s%s",
                   l->path, *pitch, l->names->pitch, hint);
}

/* Stored units into metres. */
static bool take_scale(const struct load *l)
{
    struct heightfile *h = l->h;
    bool scaled = !isnan(l->o->height_scale) && l->o->height_scale != 1, ranged = !isnan(l->o->height_range);
    if (h->white > 0 && !ranged)
        return err_set(l->e, ERR_SCENE, "%s: a %s does not say how high white is: give %s", l->path, h->format,
                       l->names->height_range);
    if (h->white > 0 && scaled)
        return err_set(l->e, ERR_SCENE, "%s: the heights of a %s follow from %s: leave %s out", l->path, h->format,
                       l->names->height_range, l->names->height_scale);
    if (h->white == 0 && ranged)
        return err_set(l->e, ERR_SCENE, "%s: %s is for PNG, where white stands for it; this is %s%s%s", l->path,
                       l->names->height_range, h->format, h->metric ? ", which holds metres: leave it out" : ": give ",
                       h->metric ? "" : l->names->height_scale);
    double white = h->white > 0 ? h->white : 1, factor = ranged ? l->o->height_range : scaled ? l->o->height_scale : 1;
    for (size_t i = 0; (ranged || scaled) && i < h->rows * h->columns; i++)
        h->z[i] = h->z[i] / white * factor;
    h->step *= factor / white;
    h->quantum *= factor / white;
    h->metric = true;
    return true;
}

static bool take_holes(const struct load *l)
{
    const struct heightfile *h = l->h;
    if (h->holes == 0 || l->o->holes == HEIGHTFILE_LEAVE)
        return h->holes < h->rows * h->columns ||
               err_set(l->e, ERR_SCENE, "%s: all heights are missing: give another map", l->path);
    if (l->o->holes == HEIGHTFILE_FILL) return heightfile_fill(l->path, l->h, l->e);
    return err_set(l->e, ERR_SCENE,
                   "%s: missing heights (NaN): %zu of %zu, the first at row %zu, column %zu (counted from 0): set %s, "
                   "or mend the file",
                   l->path, h->holes, h->rows * h->columns, h->first_hole / h->columns, h->first_hole % h->columns,
                   l->names->fill);
}

bool heightfile_load(const char *path, const struct heightfile_options *o, struct arena *a, struct heightfile *h,
                     struct err *e)
{
    struct load l = {path, o, o->names ? o->names : &scene_names, h, e};
    if (!heightfile_read(path, a, h, e)) return false;
    if (h->rows == 1 && h->columns < 4)
        return err_set(e, ERR_SCENE, "%s: %zu samples are too few for a profile (at least 4): give a longer one", path,
                       h->columns);
    if (h->rows > 1 && (h->rows < 4 || h->columns < 4))
        return err_set(e, ERR_SCENE,
                       "%s: %zu x %zu samples are too few for a map (at least 4 x 4); a profile is one row", path,
                       h->columns, h->rows);
    if (!take_pitch(&l, &h->pitch_x) || (h->rows > 1 && !take_pitch(&l, &h->pitch_y)) || !take_scale(&l) ||
        !take_holes(&l))
        return false;
    static const double likely[2] = {2e-8, 2e-3};
    double low, high;
    char hint[120];
    extremes(h, &low, &high);
    double range = high - low;
    if (range != 0 && !(range >= 1e-9 && range <= 10e-3)) {
        slip(hint, range, likely);
        return err_set(e, ERR_SCENE,
                       "%s: heights span %g m, which is not a surface profile's (1 nm to 10 mm); check its unit and "
                       "%s%s",
                       path, range, h->white > 0 ? l.names->height_range : l.names->height_scale, hint);
    }
    h->levelled = heightfile_level(h, o->levelling);
    return true;
}

/* Between polished glass (some nm rms) and gravel, and less steep than a wall. */

const char *heightfile_length_text(double x, struct arena *a)
{
    static const struct {
        double from, factor;
        const char *name;
    } units[] = {{1, 1, "m"}, {1e-3, 1e3, "mm"}, {1e-6, 1e6, "um"}, {0, 1e9, "nm"}};
    int k = 0;
    if (isnan(x)) return "unknown";
    while (fabs(x) < units[k].from)
        k++;
    return x == 0 ? "0" : arena_format(a, "%.4g %s", x * units[k].factor, units[k].name);
}

int heightfile_warnings(const struct heightfile *h, const struct heightfile_names *names, struct arena *a,
                        const char *texts[HEIGHTFILE_WARNINGS])
{
    const char *key = (names ? names : &scene_names)->height_scale;
    double number = 0, sum = 0, square = 0, steps = 0, rise = 0, low, high;
    int n = 0;
    extremes(h, &low, &high);
    for (size_t i = 0; i < h->rows * h->columns; i++)
        if (!isnan(h->z[i])) {
            number++;
            sum += h->z[i];
        }
    for (size_t j = 0; j < h->rows; j++)
        for (size_t i = 0; i < h->columns; i++) {
            const double *z = h->z + j * h->columns + i, d = *z - sum / number, step = i > 0 ? z[0] - z[-1] : NAN;
            square += isnan(d) ? 0 : d * d;
            steps += !isnan(step);
            rise += isnan(step) ? 0 : step * step;
        }
    /* root mean square about the mean, without the rounding of the sum, and of the slope along rows */
    double rms = high > low ? sqrt(square / number) : 0, slope = steps > 0 ? sqrt(rise / steps) / h->pitch_x : 0;
    if (rms > 0 && rms < 1e-9)
        texts[n++] =
            arena_format(a,
                         "an rms height of %s is finer than polished glass: were micrometres taken for millimetres "
                         "somewhere? Heights 1000 times as large would be an ordinary surface: check their unit and %s",
                         heightfile_length_text(rms, a), key);
    if (slope > 3)
        texts[n++] = arena_format(
            a,
            "an rms slope of %.3g is steeper than any scraped surface: heights or pitch have the wrong unit: check %s",
            slope, key);
    if (rms > 1e-3 && n < HEIGHTFILE_WARNINGS)
        texts[n++] = arena_format(a, "an rms height of %s is that of gravel: is the unit right? Check %s",
                                  heightfile_length_text(rms, a), key);
    return n;
}

bool heightfile_write_format(const char *path, enum heightfile_format *format, struct err *e)
{
    size_t n = strlen(path);
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++)
        if (n > 4 && !strcasecmp(path + n - 4, formats[i].ending)) {
            *format = formats[i].format;
            return true;
        }
    return err_set(e, ERR_USAGE,
                   "%s: the name's ending says the format, and must be .gsf, .gwy, .sdf, .npy, .png or .csv", path);
}

static bool check_fits(const char *path, const struct heightfile *h, enum heightfile_format format, struct err *e)
{
    double most = format == HEIGHTFILE_GSF ? (double)FLT_MAX : DBL_MAX;
    if (format == HEIGHTFILE_SDF && (h->columns > 65535 || h->rows > 65535))
        return err_set(
            e, ERR_SCENE,
            "%s: %zu x %zu samples; binary SDF holds at most 65535 x 65535: write SDF as text, or GSF, GWY, NPY", path,
            h->columns, h->rows);
    if (format == HEIGHTFILE_PNG && h->holes)
        return err_set(e, ERR_SCENE, "%s: PNG has no way to say that a point is missing, and %zu are: fill them", path,
                       h->holes);
    if (format == HEIGHTFILE_PNG && (h->columns > 1000000 || h->rows > 1000000))
        return err_set(e, ERR_SCENE, "%s: %zu x %zu samples; a PNG may have 1000000 a side", path, h->columns, h->rows);
    if (format == HEIGHTFILE_GWY && !heightfile_gwy_write_fits(h))
        return err_set(e, ERR_SCENE, "%s: %zu x %zu samples are more than a GWY file holds (4 GiB): write GSF or NPY",
                       path, h->columns, h->rows);
    for (size_t i = 0; i < h->rows * h->columns; i++)
        if (!(fabs(h->z[i]) <= most) && !(isnan(h->z[i]) && h->holes))
            return err_set(e, ERR_NUMBERS, "%s: the height at row %zu, column %zu is %g, which %s", path,
                           i / h->columns, i % h->columns, h->z[i],
                           isfinite(h->z[i]) ? "float32 does not hold" : "is no height");
    return format != HEIGHTFILE_GSF || !h->title || !h->title[strcspn(h->title, "\r\n")] ||
           err_set(e, ERR_SCENE, "%s: the title of a GSF is one line", path);
}

bool heightfile_write(const char *path, const struct heightfile *h, enum heightfile_format format,
                      struct heightfile_written *w, struct err *e)
{
    struct outfile o;
    double low, high;
    size_t n = h->rows * h->columns;
    bool ok = true;
    extremes(h, &low, &high);
    *w = (struct heightfile_written){low, high - low, format == HEIGHTFILE_PNG ? (high - low) / 65535 : 0};
    if (!check_fits(path, h, format, e) || !outfile_open(&o, path, e)) return false;
    /* a failed write shows in the stream, which the commit looks at */
    if (format == HEIGHTFILE_PNG)
        ok = heightfile_formats_png_write(o.stream, h, w->low, w->range, e);
    else if (format == HEIGHTFILE_GSF) {
        char number[32];
        fprintf(o.stream, "Gwyddion Simple Field 1.0\nXRes = %zu\nYRes = %zu\n", h->columns, h->rows);
        if (!isnan(h->pitch_x))
            fprintf(o.stream, "XReal = %s\n", heightfile_formats_number(number, h->pitch_x * (double)h->columns));
        if (!isnan(h->pitch_y))
            fprintf(o.stream, "YReal = %s\n", heightfile_formats_number(number, h->pitch_y * (double)h->rows));
        fprintf(o.stream, "XYUnits = m\nZUnits = m\n");
        if (h->title) fprintf(o.stream, "Title = %s\n", h->title);
        fwrite("\0\0\0\0", 1, (size_t)(4 - ftello(o.stream) % 4), o.stream);
        for (size_t i = 0; i < n; i++) {
            float v = (float)h->z[i];
            uint32_t bits;
            memcpy(&bits, &v, 4);
            bytes_put(o.stream, bits, 4);
        }
    } else if (format == HEIGHTFILE_GWY)
        heightfile_gwy_write(o.stream, h);
    else if (format == HEIGHTFILE_CSV)
        heightfile_formats_csv_write(o.stream, h);
    else if (format != HEIGHTFILE_NPY)
        heightfile_sdf_write(o.stream, h, format == HEIGHTFILE_SDF);
    else
        npy_write_array(o.stream, h->rows, h->columns);
    for (size_t i = 0; format == HEIGHTFILE_NPY && i < n; i++)
        bytes_put_f64(o.stream, h->z[i]);
    if (ok) return outfile_commit(&o, e);
    outfile_drop(&o);
    return err_at(e, "%s", path);
}
