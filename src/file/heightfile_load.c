/* See heightfile_load.h. Real surfaces are sampled between 10 nm and 1 mm and have heights between 1 nm and 10 mm;
   outside, a unit is wrong: metrology files do slip. */
#include "file/heightfile_load.h"

#include <math.h>
#include <stdio.h>

#include "file/heightfile_fill.h"
#include "file/heightfile_level.h"

const struct heightfile_names heightfile_load_scene_names = {"surface.pitch", "surface.height_scale",
                                                             "surface.height_range", "surface.holes: fill"};
const struct heightfile_names heightfile_load_option_names = {"--pitch", "--height-scale", "--height-range",
                                                              "--holes=fill"};

struct load {
    const char *path;
    const struct heightfile_options *o;
    const struct heightfile_names *names;
    struct heightfile *h;
    struct err *e;
};

static bool check_shape(const struct load *l)
{
    const struct heightfile *h = l->h;
    if (h->rows == 1)
        return h->columns >= 4 ||
               err_set(l->e, ERR_SCENE, "%s: %zu samples are too few for a profile (at least 4): give a longer one",
                       l->path, h->columns);
    return (h->rows >= 4 && h->columns >= 4) ||
           err_set(l->e, ERR_SCENE,
                   "%s: %zu x %zu samples are too few for a map (at least 4 x 4); a profile is one row", l->path,
                   h->columns, h->rows);
}

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

static bool check_pitch(const struct load *l, double pitch)
{
    static const double likely[2] = {1e-7, 2e-4};
    char hint[120];
    if (pitch >= 10e-9 && pitch <= 1e-3) return true;
    slip(hint, pitch, likely);
    return err_set(l->e, ERR_SCENE,
                   "%s: a pitch of %g m between samples is not that of a surface profile (10 nm to 1 mm); check %s%s",
                   l->path, pitch, l->names->pitch, hint);
}

/* One direction's pitch: the file's, or the one given, which must not be another. */
static bool take_pitch(const struct load *l, double *pitch)
{
    double given = l->o->pitch;
    if (isnan(given) && isnan(*pitch))
        return err_set(l->e, ERR_SCENE, "%s: the file does not say how far apart its samples are: give %s", l->path,
                       l->names->pitch);
    if (!isnan(given) && !isnan(*pitch) && fabs(given / *pitch - 1) > 1e-6)
        return err_set(l->e, ERR_SCENE, "%s: %s is %g m but the file says %g m: leave %s out, or mend the file",
                       l->path, l->names->pitch, given, *pitch, l->names->pitch);
    *pitch = isnan(*pitch) ? given : *pitch;
    return check_pitch(l, *pitch);
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
    if (h->holes == 0 || l->o->holes == HEIGHTFILE_KEEP)
        return h->holes < h->rows * h->columns ||
               err_set(l->e, ERR_SCENE, "%s: all heights are missing: give another map", l->path);
    if (l->o->holes == HEIGHTFILE_FILL) return heightfile_fill(l->path, l->h, l->e);
    return err_set(l->e, ERR_SCENE,
                   "%s: missing heights (NaN): %zu of %zu, the first at row %zu, column %zu (counted from 0): set %s, "
                   "or mend the file",
                   l->path, h->holes, h->rows * h->columns, h->first_hole / h->columns, h->first_hole % h->columns,
                   l->names->fill);
}

static bool check_heights(const struct load *l)
{
    static const double likely[2] = {2e-8, 2e-3};
    const struct heightfile *h = l->h;
    double low = HUGE_VAL, high = -HUGE_VAL;
    char hint[120];
    for (size_t i = 0; i < h->rows * h->columns; i++) {
        low = fmin(low, h->z[i]);
        high = fmax(high, h->z[i]);
    }
    double range = high - low;
    if (range == 0 || (range >= 1e-9 && range <= 10e-3)) return true;
    slip(hint, range, likely);
    return err_set(l->e, ERR_SCENE,
                   "%s: heights span %g m, which is not a surface profile's (1 nm to 10 mm); check its unit and %s%s",
                   l->path, range, h->white > 0 ? l->names->height_range : l->names->height_scale, hint);
}

bool heightfile_load(const char *path, const struct heightfile_options *o, struct arena *a, struct heightfile *h,
                     struct err *e)
{
    struct load l = {path, o, o->names ? o->names : &heightfile_load_scene_names, h, e};
    if (!heightfile_read(path, a, h, e) || !check_shape(&l) || !take_pitch(&l, &h->pitch_x) ||
        (h->rows > 1 && !take_pitch(&l, &h->pitch_y)) || !take_scale(&l) || !take_holes(&l) || !check_heights(&l))
        return false;
    h->levelled = heightfile_level(h, o->levelling);
    return true;
}
