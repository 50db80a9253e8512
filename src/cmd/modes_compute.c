/* Where the solid of `rasp modes compute` is touched and heard. */
#include "cmd/modes_compute.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/outfile.h"
#include "base/text.h"
#include "cmd/cmd.h"
#include "cmd/message.h"
#include "cmd/modes.h"
#include "fem/shapes.h"
#include "fem/solid.h"
#include "file/bytes.h"
#include "file/csv.h"
#include "num/real.h"
#include "output/mark.h"
#include "response/mode_table.h"

#define POINT_OFF                                                                                                      \
    0.01 /* of the solid's size: a point of --points may lie so far off its surface, as it may lie off the flat faces  \
            of a mesh */

static double off(const void *self, double x, double y)
{
    struct boundary_point p;
    return boundary_map_point(self, x, y, &p) ? 0.0 : (double)INFINITY;
}

/* Gains jump where the surface turns from one of these to the other: by more than half a right angle. */
static bool bends(const void *self, const double from[2], const double to[2])
{
    struct boundary_point p, q;
    return boundary_map_point(self, from[0], from[1], &p) && boundary_map_point(self, to[0], to[1], &q) &&
           p.normal[0] * q.normal[0] + p.normal[1] * q.normal[1] + p.normal[2] * q.normal[2] < 0.7071;
}

static double size_of(const struct compute *k)
{
    double square = 0;
    for (int i = 0; i < 3; i++)
        square += (k->boundary.high[i] - k->boundary.low[i]) * (k->boundary.high[i] - k->boundary.low[i]);
    return sqrt(square);
}

/* ------------------------------------------------------------------ --points */

static bool read_points(struct compute *k, const char *file, struct err *e)
{
    static const char *const names[5] = {"x_m", "y_m", "z_m", "u_m", "v_m"};
    struct csv t;
    int column[5];
    if (!csv_read(file, k->c->arena, &t, e)) return false;
    for (int i = 0; i < 5; i++)
        column[i] = csv_column(&t, names[i]);
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
    for (int row = 0; row < k->places; row++) {
        const double *low = k->boundary.low, *high = k->boundary.high;
        double at[3];
        for (int i = 0; i < 3; i++)
            if (!csv_number(&t, (size_t)row, column[i], &at[i], e)) return false;
        for (int i = 0; i < 2; i++)
            if (!placed)
                k->xy[row][i] = at[i];
            else if (!csv_number(&t, (size_t)row, column[3 + i], &k->xy[row][i], e))
                return false;
        double far = boundary_nearest(&k->mesh, &k->boundary, at, &k->point[row]);
        if (far > POINT_OFF * size_of(k))
            return err_set(e, ERR_SCENE,
                           "%s:%d: the point (%g, %g, %g) m lies %.3g m off the surface, which spans x %g to %g, y %g "
                           "to %g, z %g to %g m",
                           file, t.lines[row], at[0], at[1], at[2], far, low[0], high[0], low[1], high[1], low[2],
                           high[2]);
    }
    struct err why = {0};
    int bad;
    if (modes_places_distinct(&(struct modes_places){.n = k->places, .xy = k->xy}, k->c->arena, &bad, &why))
        return true;
    return err_set(e, ERR_SCENE,
                   "%s:%d: another point has the same place (%.9g, %.9g) m; a scene tells points by their places: give "
                   "each its own u_m,v_m",
                   file, t.lines[bad], k->xy[bad][0], k->xy[bad][1]);
}

/* ------------------------------------------------------------------ --line ..., --listen */

/* What is slender is touched along its middle, all else on a grid. */
static bool read_places(struct compute *k, struct modes_fit *fit, struct err *e)
{
    const struct boundary_map *c = &k->map;
    double wide = c->high[0] - c->low[0], high = c->high[1] - c->low[1];
    struct modes_ground ground = {.self = c,
                                  .off = off,
                                  .bends = bends,
                                  .low = {c->low[0], c->low[1]},
                                  .high = {c->high[0], c->high[1]},
                                  .standard = {17, 9},
                                  .fit = fit};
    struct modes_places p;
    if (c->face >= BOUNDARY_AROUND)
        ground.remark =
            "; x is the arc round the axis x = y = 0 of the mesh's file, y is z, and the solid must be where they lead";
    if (wide > 6 * high) memcpy(ground.standard, (int[2]){33, 1}, sizeof ground.standard);
    if (!modes_places(k->c, &ground, &p, e)) return false;
    k->laid = p;
    k->places = p.n;
    k->xy = p.xy;
    k->point = ARENA_TAKE(k->c->arena, struct boundary_point, p.n);
    for (int i = 0; i < p.n; i++)
        boundary_map_point(c, p.xy[i][0], p.xy[i][1], &k->point[i]);
    return true;
}

/* Gains and poles of the modes at a place. */
static double gains_at(const void *self, double x, double y, const struct modes_point *to)
{
    const struct compute *k = self;
    struct boundary_point at;
    if (!boundary_map_point(&k->map, x, y, &at)) return (double)INFINITY;
    solid_participation(&k->modes, &at, k->phi);
    for (int i = 0; i < k->n; i++) {
        to->frequency[i] = k->frequency[i];
        to->decay[i] = k->decay[i];
        to->im[i] = k->phi[k->mode[i]] * (k->elsewhere ? k->ear_phi : k->phi)[k->mode[i]];
        to->re[i] = -to->im[i] * k->decay[i] / (2 * REAL_PI * k->frequency[i]);
    }
    modes_to_quantity(k->quantity, k->n, to);
    return 0;
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
        if (!modes_lengths(k->c, "listen", "X,Y", 2, at, e)) return false;
        return boundary_map_point(&k->map, at[0], at[1], &k->ear) ||
               err_set(e, ERR_SCENE,
                       "--listen: the place (%.9g, %.9g) m lies off the object; a point X,Y,Z of space takes the "
                       "nearest of the surface",
                       at[0], at[1]);
    }
    if (!modes_lengths(k->c, "listen", "X,Y,Z", 3, at, e)) return false;
    double far = boundary_nearest(&k->mesh, &k->boundary, at, &k->ear);
    return far <= POINT_OFF * size_of(k) ||
           err_set(e, ERR_SCENE,
                   "--listen: the point lies %.3g m off the surface; it is heard where the surface moves, and "
                   "output.listen of a scene says how that radiates",
                   far);
}

/* --face, --line ..., --points, --listen, --origin. */
static bool read_all_places(struct compute *k, struct err *e)
{
    static const char *const others[] = {"line", "circle", "grid", "at", "places", "face"};
    const char *points = args_value(&k->c->args, "points");
    for (size_t i = 0; points && i < sizeof others / sizeof *others; i++)
        if (args_given(&k->c->args, others[i]))
            return err_set(e, ERR_USAGE, "--points and --%s exclude each other", others[i]);
    int face = BOUNDARY_TOP;
    if (!modes_lengths(k->c, "origin", "X,Y", 2, k->origin, e) || !modes_quantity(k->c, &k->quantity, e) ||
        !args_word(&k->c->args, "face", boundary_map_sides, &face, e))
        return false;
    boundary_map_make(&k->mesh, &k->boundary, face, &k->map);
    const double *low = k->boundary.low, *high = k->boundary.high;
    if (face >= BOUNDARY_AROUND && (low[0] >= 0 || high[0] <= 0 || low[1] >= 0 || high[1] <= 0))
        return err_set(e, ERR_SCENE,
                       "--face %s goes round the axis x = y = 0, and the solid lies beside it (x %.6g to %.6g m, y "
                       "%.6g to %.6g m); move the mesh so that the axis runs through its middle",
                       boundary_map_sides[face], low[0], high[0], low[1], high[1]);
    return (points ? read_points(k, points, e) : read_places(k, NULL, e)) && read_listen(k, e);
}

/* The mode table of `rasp modes compute`.

   A unit impulse (1 N s) that presses at x makes a mass-normalised mode move, where it is heard, by phi(x) phi(l)/w_d
   e^(-d t) sin(w_d t), displacement along the inward normal; velocity is Im(A e^(s t)) with A = phi(x) phi(l) (j -
   d/w_d), as of objects of closed form (response/object.c).

   One table on every CPU: one kind of kernels (cmd/modes.c), nine digits of frequencies, gains of shapes to seven
   digits of each mode's greatest. So tables agree to these where another version of the library, or another kind of
   processor, adds otherwise.

   The first line is the hash of all that follows, which holds the hash of what the table was made from: a table that is
   current needs no second computation. */

static const char first[] = "# content: ", second[] = "# inputs: ";
enum { DIGITS = 9 };

/* ------------------------------------------------------------------ hashes */

static void add_point(struct hash *h, const struct boundary_point *p)
{
    hash_add(h, p->at, sizeof p->at);
    hash_add(h, p->normal, sizeof p->normal);
}

/* SHA-256 of all that the table follows from. */
static void inputs_hash(const struct compute *k, char hex[HASH_TEXT])
{
    const struct compute_material *m = &k->material;
    const double numbers[] = {m->alpha, m->beta, m->loss, m->elastic.density, k->top, k->origin[0], k->origin[1]};
    const long wholes[] = {k->most,   k->order,     k->quantity, k->map.face,
                           k->places, k->elsewhere, m->own,      m->own_damping};
    const char *title = args_value(&k->c->args, "title");
    struct hash h = hash_start();
    hash_text(&h, "rasp modes compute, table 2");
    hash_text(&h, k->mesh.name);
    hash_text(&h, title ? title : "");
    hash_text(&h, m->named ? m->named->name : "");
    hash_add(&h, k->mesh.at, (size_t)k->mesh.nodes * sizeof *k->mesh.at);
    hash_add(&h, k->mesh.element, (size_t)k->mesh.elements * sizeof *k->mesh.element);
    hash_add(&h, m->elastic.c, sizeof m->elastic.c);
    hash_add(&h, numbers, sizeof numbers);
    hash_add(&h, wholes, sizeof wholes);
    if (k->boundary.outer < k->boundary.area)
        hash_text(&h, "radius_m of the outer skin"); /* an older table counted walls of cavities */
    for (int i = 0; i < k->n_fixed; i++) {
        hash_add(&h, &k->fixed[i].hold, sizeof k->fixed[i].hold);
        hash_text(&h, k->fixed_names[i]);
        hash_add(&h, k->fixed[i].corner, (size_t)k->fixed[i].n * sizeof *k->fixed[i].corner);
    }
    hash_text(&h, args_given(&k->c->args, "grid") || args_given(&k->c->args, "places") ? "so many places"
                                                                                       : "as many places as needed");
    hash_add(&h, k->xy, (size_t)k->places * sizeof *k->xy);
    for (int i = 0; i < k->places; i++)
        add_point(&h, &k->point[i]);
    if (k->elsewhere) add_point(&h, &k->ear);
    if (args_given(&k->c->args, "estimate")) hash_text(&h, "estimate");
    hash_end(&h, hex);
}

/* Is the file a table made of these inputs and not changed since? A pipe would be waited for. */
static bool is_current(const char *file, const char *inputs, struct arena *a)
{
    size_t head = sizeof first - 1 + HASH_TEXT; /* with its line's end in place of the hash's */
    char hex[HASH_TEXT];
    struct stat s;
    struct bytes b;
    if (stat(file, &s) != 0 || !S_ISREG(s.st_mode) || !bytes_read(file, a, &b, &(struct err){0}) || b.n <= head ||
        memcmp(b.at, first, sizeof first - 1) != 0)
        return false;
    hash_bytes(b.at + head, b.n - head, hex);
    return !memcmp(b.at + sizeof first - 1, hex, HASH_TEXT - 1) &&
           strstr(b.at + head, arena_format(a, "\n%s%s\n", second, inputs));
}

/* ------------------------------------------------------------------ comments */

static void material(FILE *f, const struct compute_material *m)
{
    bool wood = m->named && m->named->radial.youngs_modulus > 0;
    fprintf(f, "# material: %s, density %.9g kg/m^3, Young's modulus %.9g Pa", m->named ? m->named->name : "custom",
            m->elastic.density, m->youngs_modulus);
    if (wood)
        fprintf(f, " along x (the grain), %.9g along y (tangential), %.9g along z (radial)",
                m->youngs_modulus * m->named->across / m->named->youngs_modulus,
                m->youngs_modulus * m->named->radial.youngs_modulus / m->named->youngs_modulus);
    else
        fprintf(f, ", Poisson's ratio %.9g", m->poisson);
    fputc('\n', f);
    modes_damping_write(f, (const double[3]){m->alpha, m->beta, m->loss}, m->named, m->own, m->own_damping);
}

/* ------------------------------------------------------------------ rows */

/* Shapes in steps of 2^-23 (1.2e-7) of a mode's greatest, anywhere on the solid: what is left of a nodal line but
   rounding becomes 0. Up to 1e-9 of it depends on the order of additions, most of slender solids and of equal
   frequencies, whose basis is fixed (fem/solid_eigen.c). */
static void round_to(const struct compute *k, const double *step, double *phi)
{
    for (int i = 0; i < k->modes.n; i++)
        phi[i] = rint(phi[i] / step[i]) * step[i];
}

/* Gains are phi(x) phi(l). */
static void rows(FILE *f, const struct compute *k)
{
    const int all = k->modes.n;
    struct modes_point at = modes_point_make(k->c->arena, k->n);
    double *step = ARENA_TAKE(k->c->arena, double, all), *phi = ARENA_TAKE(k->c->arena, double, all),
           *ear = ARENA_TAKE(k->c->arena, double, all);
    int *order = ARENA_TAKE(k->c->arena, int, k->n);
    long wide = 3 * k->modes.nodes;
    for (int i = 0; i < all; i++) {
        for (long j = 0; j < wide; j++)
            step[i] = fmax(step[i], fabs(k->modes.shape[i * wide + j]));
        step[i] = ldexp(1.0, ilogb(step[i]) - 23);
    }
    if (k->elsewhere) {
        solid_participation(&k->modes, &k->ear, ear);
        round_to(k, step, ear);
    }
    for (int i = 0; i < k->n; i++)
        order[i] = i;
    mode_table_write_header(f);
    for (int p = 0; p < k->places; p++) {
        struct mode_table_place place = {DIGITS, p + 1, k->xy[p][0] + k->origin[0], k->xy[p][1] + k->origin[1]};
        solid_participation(&k->modes, &k->point[p], phi);
        round_to(k, step, phi);
        for (int i = 0; i < k->n; i++) {
            double gain = phi[k->mode[i]] * (k->elsewhere ? ear : phi)[k->mode[i]];
            at.frequency[i] = k->frequency[i];
            at.decay[i] = k->decay[i];
            at.im[i] = gain;
            at.re[i] = -gain * k->decay[i] / (2.0 * REAL_PI * k->frequency[i]);
        }
        modes_to_quantity(k->quantity, k->n, &at);
        mode_table_write_place(f, &place, k->n, order, &at, k->quantity);
    }
}

static bool write_table(const struct compute *k, const char *file, const char *inputs, struct err *e)
{
    struct outfile o;
    char *text = NULL, hex[HASH_TEXT];
    size_t size = 0;
    FILE *f = open_memstream(&text, &size);
    if (!f) return err_set(e, ERR_MEMORY, "out of memory");
    static const char *const axes[] = {"x, y", "x, y", "y, z", "y, z", "x, z", "x, z", "arc, z", "arc, z"};
    fprintf(f, "# poles: shared\n# quantity: %s\n# normalisation: %s, physical; along the inward normal; heard at ",
            modes_quantity_name(k->quantity), modes_per_impulse(k->quantity));
    if (k->elsewhere)
        fprintf(f, "the point x = %.9g m, y = %.9g m, z = %.9g m of the solid\n", k->ear.at[0], k->ear.at[1],
                k->ear.at[2]);
    else
        fputs("the place that is touched\n", f);
    if (args_given(&k->c->args, "points"))
        fputs("# places: points of a list, the nearest of the surface\n", f);
    else
        fprintf(f, "# places: on the solid as seen from its side '%s': its %s, moved by (%.9g, %.9g) m\n",
                boundary_map_sides[k->map.face], axes[k->map.face], k->origin[0], k->origin[1]);
    modes_places_write(f, k->error, &k->laid, k->c->arena);
    fprintf(f, "# radius_m: %.9g\n", sqrt(k->boundary.outer / (4.0 * REAL_PI)));
    const struct boundary *b = &k->boundary;
    const char *title = args_value(&k->c->args, "title");
    if (title) fprintf(f, "# title: %s\n", text_shown(k->c->arena, title));
    fprintf(f, "# object: %s, x %.9g to %.9g m, y %.9g to %.9g m, z %.9g to %.9g m, %.6g kg\n",
            text_shown(k->c->arena, k->mesh.name), b->low[0], b->high[0], b->low[1], b->high[1], b->low[2], b->high[2],
            k->modes.mass);
    for (int i = 0; i < k->n_fixed; i++)
        fprintf(f, "# %s: %s\n", k->fixed[i].hold == SOLID_CLAMPED ? "clamped" : "supported",
                text_shown(k->c->arena, k->fixed_names[i]));
    material(f, &k->material);
    fprintf(f,
            "# holds: linear elasticity by finite elements, %d tetrahedra of order %ld, %ld freedoms; no radiation\n",
            k->mesh.elements, k->order, k->modes.freedoms);
    modes_compute_solid_estimate_write(f, k);
    for (char *rest = k->note ? arena_text(k->c->arena, k->note) : NULL, *line; (line = strsep(&rest, "\n"));)
        if (*line) fprintf(f, "# note: %s\n", text_shown(k->c->arena, line));
    fprintf(f, "%s%s\n", second, inputs);
    rows(f, k);
    bool whole = fclose(f) == 0;
    if (!whole || !outfile_open(&o, file, e)) {
        free(text);
        return whole ? false : err_set(e, ERR_MEMORY, "out of memory");
    }
    hash_bytes(text, size, hex);
    fprintf(o.stream, "%s%s\n", first, hex);
    fwrite(text, 1, size, o.stream);
    free(text);
    return outfile_commit(&o, e);
}

/* rasp modes compute MESH | --shape ... -o FILE.csv: how a solid rings, by finite elements (papers/003 section A), as a
 * mode table. */

/* A mesh of TetGen is several files. */
static bool read_output(const struct compute *k, const char **file, struct err *e)
{
    static const char *const endings[] = {"node", "ele", "face"};
    const struct args *g = &k->c->args;
    const char *mesh = g->n_operands ? g->operands[0] : NULL, *dot = mesh ? strrchr(mesh, '.') : NULL;
    *file = args_value(g, "output");
    if (!*file) return err_set(e, ERR_USAGE, "-o FILE.csv is needed: the mode table to write");
    for (int i = 0; dot && (!strcmp(dot, ".node") || !strcmp(dot, ".ele")) && i < 3; i++)
        if (!modes_output_spares(*file, arena_format(k->c->arena, "%.*s.%s", (int)(dot - mesh), mesh, endings[i]), e))
            return false;
    return modes_output_spares(*file, mesh, e) && modes_output_spares(*file, args_value(g, "points"), e);
}

int modes_compute_run(struct cmd_call *c, struct err *e)
{
    struct compute k = {.c = c};
    const char *file;
    char inputs[HASH_TEXT];
    bool quiet = args_given(&c->args, "quiet");
    if (args_given(&c->args, "shape") && !strcmp(args_value(&c->args, "shape"), "help")) {
        puts(shapes_help());
        return 0;
    }
    if (!read_output(&k, &file, e) || !modes_compute_solid_read(&k, e) || !read_all_places(&k, e)) return (int)e->kind;
    inputs_hash(&k, inputs);
    if (access(file, F_OK) == 0 && is_current(file, inputs, c->arena)) {
        if (!quiet) printf("%s: up to date\n", text_shown(c->arena, file));
        return 0;
    }
    if (!mark_absent(file, args_given(&c->args, "force"), e) || !modes_output_possible(file, e) ||
        !modes_compute_solid_solve(&k, e) || !modes_compute_solid_estimate(&k, e))
        return (int)e->kind;
    /* Places of a list lie on the chart where the list says, and between them no point of the surface is known. */
    struct modes_fit fit = {.self = &k, .at = gains_at, .n = k.n, .shared = true, .arena = c->arena};
    k.error = NAN;
    if (!args_given(&c->args, "points")) {
        k.phi = ARENA_TAKE(c->arena, double, k.modes.n);
        k.ear_phi = ARENA_TAKE(c->arena, double, k.modes.n);
        if (k.elsewhere) solid_participation(&k.modes, &k.ear, k.ear_phi);
        if (!read_places(&k, &fit, e)) return (int)e->kind;
        k.error = modes_places_error(&fit, &k.laid);
    }
    if (!write_table(&k, file, inputs, e)) return (int)e->kind;
    if (!quiet) {
        k.laid.n = k.places;
        modes_places_report(file, &k.laid, "solid", k.error, k.n, (const double[2]){k.least, k.greatest}, c->arena);
        printf("; %d tetrahedra of order %ld, %ld freedoms, %.4g kg, %d rigid motion%s\n", k.mesh.elements, k.order,
               k.modes.freedoms, k.modes.mass, k.modes.rigid, k.modes.rigid == 1 ? "" : "s");
        if (k.estimated)
            printf("%s: %s\n",
                   args_given(&k.c->args, "shape") ? "estimated error of frequencies"
                                                   : "frequencies of the order below are off by more than these, by",
                   modes_compute_solid_error_text(&k));
        for (char *rest = k.note ? arena_text(c->arena, k.note) : NULL, *line; (line = strsep(&rest, "\n"));)
            if (*line) message_remark(c, "modes", line);
        modes_places_warn(c, k.error, &k.laid);
    }
    return 0;
}
