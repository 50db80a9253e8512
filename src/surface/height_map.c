/* A measured profile under the contact: file, checks of its geometry, spline. */
#include "file/heightfile.h"
#include "num/real.h"
#include "stage.h"
#include "surface/profile.h"
#include "trajectory/trajectory.h"

/* Real surfaces: sampled between 10 nm and 1 mm, heights between 1 nm and 10 mm. Outside, a unit is wrong: metrology files do slip. */
static bool height_map_plausible(const char *file, double pitch, double range, struct err *e)
{
    if (pitch < 10e-9 || pitch > 1e-3)
        return err_set(e, ERR_SCENE, "%s: a pitch of %g m between samples is not that of a surface profile (10 nm to 1 mm); check surface.pitch",
                       file, pitch);
    if (range > 10e-3 || (range > 0 && range < 1e-9))
        return err_set(e, ERR_SCENE,
                       "%s: heights span %g m, which is not a surface profile's (1 nm to 10 mm); check its unit and surface.height_scale", file,
                       range);
    return true;
}

static bool height_map_pitch(const struct surface *s, const struct heightfile *h, double *pitch, struct err *e)
{
    *pitch = isnan(s->pitch) ? h->pitch_x : s->pitch;
    if (isnan(*pitch))
        return err_set(e, ERR_SCENE, "%s: the file does not say how far apart its samples are: give surface.pitch", s->height_map);
    if (!isnan(h->pitch_x) && !isnan(s->pitch) && fabs(s->pitch / h->pitch_x - 1) > 1e-6)
        return err_set(e, ERR_SCENE, "%s: surface.pitch is %g m but the file says %g m: leave surface.pitch out, or mend the file",
                       s->height_map, s->pitch, h->pitch_x);
    if (h->rows != 1)
        return err_set(e, ERR_SCENE, "%s: a map of %zu x %zu samples; this version scrapes profiles (one row)", s->height_map, h->columns,
                       h->rows);
    if (h->columns < 4)
        return err_set(e, ERR_SCENE, "%s: %zu samples are too few for a profile (at least 4)", s->height_map, h->columns);
    return true;
}

/* Coordinate along the profile at the two ends of the stroke. */
static void height_map_reach(const struct contact *c, double q[2])
{
    struct trajectory tr = trajectory_make(&c->motion);
    bool x = c->surface.along == ALONG_X;
    q[0] = x ? c->motion.from[0] - c->surface.origin[0] : 0;
    q[1] = x ? c->motion.to[0] - c->surface.origin[0] : tr.length;
}

static bool height_map_inside(const struct contact *c, const struct profile *p, struct err *e)
{
    double q[2], slack = 1e-9 * p->pitch;
    height_map_reach(c, q);
    if (c->surface.off_map != OFF_MAP_ERROR)
        return true;
    for (int k = 0; k < 2; k++)
        if (q[k] < p->from - slack || q[k] > p->to + slack)
            return err_set(e, ERR_SCENE,
                           "contact '%s': the motion leaves the height map: it reaches %g m along a profile from 0 to %g m; shorten the "
                           "motion, or set surface.off_map to mirror or wrap",
                           c->name, q[k], p->to);
    return true;
}

static bool height_map_open(struct stage_run *r, struct err *e)
{
    const struct surface *s = &r->contact->surface;
    struct heightfile h;
    double pitch, low = HUGE_VAL, high = -HUGE_VAL;
    if (!heightfile_read(s->height_map, r->arena, &h, e) || !height_map_pitch(s, &h, &pitch, e))
        return false;
    for (size_t i = 0; i < h.columns; i++) {
        h.z[i] *= s->height_scale;
        low = fmin(low, h.z[i]);
        high = fmax(high, h.z[i]);
    }
    if (!height_map_plausible(s->height_map, pitch, high - low, e))
        return false;
    r->board->profile = profile_from_samples(r->arena, h.z, h.columns, pitch, s->off_map);
    return height_map_inside(r->contact, r->board->profile, e);
}

static bool height_map_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return c->surface.height_map != NULL;
}

static double height_map_work(const struct contact *c, const struct scene *s)
{
    (void)c, (void)s;
    return 0;
}

const struct stage height_map_stage = {
    .name = "height_map",
    .does = "measured profile as a cubic spline",
    .paper = "000 sec. 2.2",
    .idle = "no surface.height_map",
    .gives = ITEM_BIT(ITEM_SURFACE),
    .wanted = height_map_wanted,
    .work = height_map_work,
    .open = height_map_open,
};
