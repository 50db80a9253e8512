/* Where the solid of `rasp modes compute` is touched and heard. */
#include <math.h>
#include <string.h>

#include "base/text.h"
#include "cmd/modes.h"
#include "cmd/modes_compute.h"
#include "fem/touch.h"
#include "file/csv.h"
#include "num/real.h"

#define POINT_OFF                                                                                                      \
    0.01 /* of the solid's size: a point of --points may lie so far off its surface, as it may lie off the flat faces  \
            of a mesh */

static double off(const void *self, double x, double y)
{
    struct boundary_point p;
    return chart_point((const struct chart *)self, x, y, &p) ? 0.0 : (double)INFINITY;
}

/* Gains jump where the surface turns from one of these to the other: by more than half a right angle. */
static bool bends(const void *self, const double from[2], const double to[2])
{
    struct boundary_point p, q;
    return chart_point((const struct chart *)self, from[0], from[1], &p) &&
           chart_point((const struct chart *)self, to[0], to[1], &q) &&
           p.normal[0] * q.normal[0] + p.normal[1] * q.normal[1] + p.normal[2] * q.normal[2] < 0.7071;
}

static double size_of(const struct compute *k)
{
    double square = 0;
    for (int i = 0; i < 3; i++)
        square += (k->boundary.high[i] - k->boundary.low[i]) * (k->boundary.high[i] - k->boundary.low[i]);
    return sqrt(square);
}

static bool read_face(struct compute *k, struct err *e)
{
    const char *word = args_value(&k->c->args, "face");
    int face = CHART_TOP;
    while (word && chart_faces[face] && strcmp(word, chart_faces[face]) != 0)
        face++;
    if (!chart_faces[face])
        return err_set(e, ERR_USAGE, "--face: '%s' is not top, bottom, right, left, back, front, around or inside",
                       word);
    chart_make(&k->mesh, &k->boundary, face, &k->chart);
    const double *low = k->boundary.low, *high = k->boundary.high;
    if (face >= CHART_AROUND && (low[0] >= 0 || high[0] <= 0 || low[1] >= 0 || high[1] <= 0))
        return err_set(e, ERR_SCENE,
                       "--face %s goes round the axis x = y = 0, and the solid lies beside it (x %.6g to %.6g m, y "
                       "%.6g to %.6g m); move the mesh so that the axis runs through "
                       "its middle",
                       word, low[0], high[0], low[1], high[1]);
    return true;
}

/* ------------------------------------------------------------------ --points */

static bool point_row(struct compute *k, const struct csv *t, const int column[5], int row, struct err *e)
{
    double at[3];
    for (int i = 0; i < 3; i++)
        if (!csv_number(t, (size_t)row, column[i], &at[i], e)) return false;
    for (int i = 0; i < 2; i++)
        if (column[3] < 0)
            k->xy[row][i] = at[i];
        else if (!csv_number(t, (size_t)row, column[3 + i], &k->xy[row][i], e))
            return false;
    double far = boundary_nearest(&k->mesh, &k->boundary, at, &k->point[row]);
    return far <= POINT_OFF * size_of(k) ||
           err_set(e, ERR_SCENE,
                   "%s:%d: the point (%g, %g, %g) m lies %.3g m off the surface, which spans x %g to %g, y %g to %g, z "
                   "%g to %g m",
                   t->file, t->lines[row], at[0], at[1], at[2], far, k->boundary.low[0], k->boundary.high[0],
                   k->boundary.low[1], k->boundary.high[1], k->boundary.low[2], k->boundary.high[2]);
}

static bool read_points(struct compute *k, const char *file, struct err *e)
{
    static const char *const names[5] = {"x_m", "y_m", "z_m", "u_m", "v_m"};
    struct csv t;
    int column[5];
    if (!csv_read(file, k->c->arena, &t, e)) return false;
    for (int i = 0; i < 5; i++) {
        column[i] = csv_column(&t, names[i]);
    }
    bool placed = column[3] >= 0 || column[4] >= 0;
    for (int i = 0; i < (placed ? 5 : 3); i++)
        if (column[i] < 0)
            return err_set(e, ERR_SCENE,
                           "%s: there is no column %s; a list of points has x_m,y_m,z_m and may have u_m,v_m, their "
                           "places in the scene",
                           file, names[i]);
    if (t.rows == 0 || t.rows > 100000) return err_set(e, ERR_SCENE, "%s: %zu points; take 1 to 100000", file, t.rows);
    k->places = (int)t.rows;
    k->xy = arena_take(k->c->arena, t.rows, sizeof *k->xy);
    k->point = ARENA_TAKE(k->c->arena, struct boundary_point, t.rows);
    for (int i = 0; i < k->places; i++)
        if (!point_row(k, &t, column, i, e)) return false;
    struct err why = {0};
    int bad;
    if (modes_places_apart(&(struct modes_places){.n = k->places, .xy = k->xy}, k->c->arena, &bad, &why)) return true;
    return err_set(e, ERR_SCENE,
                   "%s:%d: another point has the same place (%.9g, %.9g) m; a scene tells points by their places: give "
                   "each its own u_m,v_m",
                   file, t.lines[bad], k->xy[bad][0], k->xy[bad][1]);
}

/* ------------------------------------------------------------------ --line ..., --listen */

/* What is slender is touched along its middle, all else on a grid. */
static bool read_places(struct compute *k, struct modes_fit *fit, struct err *e)
{
    const struct chart *c = &k->chart;
    double wide = c->high[0] - c->low[0], high = c->high[1] - c->low[1];
    struct modes_ground ground = {.self = c,
                                  .off = off,
                                  .bends = bends,
                                  .low = {c->low[0], c->low[1]},
                                  .high = {c->high[0], c->high[1]},
                                  .standard = {17, 9},
                                  .fit = fit};
    struct modes_places p;
    if (c->face >= CHART_AROUND)
        ground.remark =
            "; x is the arc round the axis x = y = 0 of the mesh's file, y is z, and the solid must be where they lead";
    if (wide > 6 * high) memcpy(ground.standard, (int[2]){33, 1}, sizeof ground.standard);
    if (!modes_places(k->c, &ground, &p, e)) return false;
    k->laid = p;
    k->places = p.n;
    k->left_out = p.left_out;
    k->xy = p.xy;
    k->point = ARENA_TAKE(k->c->arena, struct boundary_point, p.n);
    for (int i = 0; i < p.n; i++)
        chart_point(c, p.xy[i][0], p.xy[i][1], &k->point[i]);
    return true;
}

/* Gains and poles of the modes at a place. */
static double gains_at(const void *self, double x, double y, const struct modes_point *to)
{
    const struct compute *k = (const struct compute *)self;
    struct boundary_point at;
    if (!chart_point(&k->chart, x, y, &at)) return (double)INFINITY;
    touch_shapes(&k->modes, &at, k->phi);
    for (int i = 0; i < k->n; i++) {
        to->frequency[i] = k->frequency[i];
        to->decay[i] = k->decay[i];
        to->im[i] = k->phi[k->mode[i]] * (k->elsewhere ? k->ear_phi : k->phi)[k->mode[i]];
        to->re[i] = -to->im[i] * k->decay[i] / (2 * REAL_PI * k->frequency[i]);
    }
    modes_to_quantity(k->quantity, k->n, to);
    return 0;
}

/* Places of a list lie on the chart where the list says, and between them no point of the surface is known. */
bool modes_compute_places_settle(struct compute *k, struct err *e)
{
    const struct args *g = &k->c->args;
    struct modes_fit fit = {.self = k, .at = gains_at, .n = k->n, .shared = true, .arena = k->c->arena};
    k->error = NAN;
    if (args_given(g, "points")) return true;
    k->phi = ARENA_TAKE(k->c->arena, double, k->modes.n);
    k->ear_phi = ARENA_TAKE(k->c->arena, double, k->modes.n);
    if (k->elsewhere) touch_shapes(&k->modes, &k->ear, k->ear_phi);
    if (!read_places(k, &fit, e)) return false;
    k->error = modes_places_error(&fit, &k->laid);
    return true;
}

static bool read_listen(struct compute *k, struct err *e)
{
    const char *text = args_value(&k->c->args, "listen");
    double at[3];
    int commas = 0;
    for (const char *p = text; p && *p; p++)
        commas += *p == ',';
    k->elsewhere = text != NULL;
    if (!text) return true;
    if (commas != 2) {
        if (!modes_lengths(k->c, &(struct modes_lengths){"listen", "X,Y", 2}, at, e)) return false;
        return chart_point(&k->chart, at[0], at[1], &k->ear) ||
               err_set(e, ERR_SCENE,
                       "--listen: the place (%.9g, %.9g) m lies off the object; a point X,Y,Z of space takes the "
                       "nearest of the surface",
                       at[0], at[1]);
    }
    if (!modes_lengths(k->c, &(struct modes_lengths){"listen", "X,Y,Z", 3}, at, e)) return false;
    double far = boundary_nearest(&k->mesh, &k->boundary, at, &k->ear);
    return far <= POINT_OFF * size_of(k) ||
           err_set(e, ERR_SCENE,
                   "--listen: the point lies %.3g m off the surface; it is heard where the surface moves, "
                   "and output.listen of a scene says how that radiates",
                   far);
}

bool modes_compute_places(struct compute *k, struct err *e)
{
    static const char *const others[] = {"line", "circle", "grid", "at", "places", "face"};
    const char *points = args_value(&k->c->args, "points");
    for (size_t i = 0; points && i < sizeof others / sizeof *others; i++)
        if (args_given(&k->c->args, others[i]))
            return err_set(e, ERR_USAGE, "--points and --%s exclude each other", others[i]);
    return modes_lengths(k->c, &(struct modes_lengths){"origin", "X,Y", 2}, k->origin, e) &&
           modes_quantity(k->c, &k->quantity, e) && read_face(k, e) &&
           (points ? read_points(k, points, e) : read_places(k, NULL, e)) && read_listen(k, e);
}
