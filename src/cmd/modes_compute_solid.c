/* Figures that are in the wrong unit, most likely: the material's by the limits of the scene's keys, the solid's size
   and mass by what one can strike or scrape.

   A bar carries waves at c = sqrt(E/density) (m/s): from some 3 in jelly and 30 in rubber to 18000 in diamond. Pascals
   for gigapascals, or g/cm^3 for kg/m^3, miss this by far. */
#include "cmd/modes_compute.h"

#include <math.h>
#include <string.h>

#include "base/text.h"
#include "fem/grade.h"
#include "fem/mesh_check.h"
#include "fem/shapes.h"
#include "fem/topology.h"
#include "num/real.h"
#include "scene/keys.h"
#include "scene/keys_text.h"
#include "scene/scene_materials.h"
#include "scene/units.h"

static const double usual_size = 3, usual_mass = 1000, slowest = 2, fastest = 20000; /* m, kg, m/s */

static bool within(const struct compute *k, const char *option, double x, struct err *e)
{
    const char *path = option[0] == 'y'   ? "surface.object.youngs_modulus"
                       : option[0] == 'd' ? "surface.object.density"
                                          : "surface.object.poisson";
    const struct key *key = keys_find(path);
    const char *unit = keys_text_unit(key->dimension);
    return (x >= key->low && x <= key->high) ||
           err_set(e, ERR_USAGE,
                   *unit ? "--%s: %g %s is not from %s; a bare number is in %s" : "--%s: %g%s is not from %s", option,
                   x, unit, keys_text_range(key, k->c->arena), unit);
}

static void note(struct compute *k, const char *text) { k->note = arena_line(k->c->arena, k->note, text); }

static bool check_solid(struct compute *k, struct err *e)
{
    const struct boundary *b = &k->boundary;
    const struct compute_material *m = &k->material;
    struct arena *a = k->c->arena;
    bool shape = args_given(&k->c->args, "shape");
    double size = 0, mass = b->volume * m->elastic.density, speed = sqrt(m->youngs_modulus / m->elastic.density);
    const char *cure = shape ? "a length without a unit is in metres: write 30cm or 300mm"
                             : "a mesh file may be in mm or cm: give --unit mm or cm";
    for (int c = 0; c < 3; c++)
        size = fmax(size, b->high[c] - b->low[c]);
    if (shape &&
        !mesh_check_size(k->mesh.name, size, size > usual_size ? cure : "are the units of its lengths right?", e))
        return false;
    if (size > usual_size) note(k, arena_format(a, "the solid is %.4g m large; is the unit right? %s", size, cure));
    if (mass > usual_mass)
        note(k,
             arena_format(a, "the solid has a mass of %.4g kg; are its lengths and its density (kg/m^3) right?", mass));
    if (!(speed >= slowest && speed <= fastest))
        note(k, arena_format(
                    a,
                    "sqrt(Young's modulus/density), the speed of waves along a bar, is %.3g m/s, and in solids some 30 "
                    "(rubber) to 18000 m/s (diamond); are the units right? Bare numbers are Pa and kg/m^3",
                    speed));
    return true;
}

/* The solid of `rasp modes compute`: its mesh, material, what holds it, and its modes. */

/* ------------------------------------------------------------------ mesh */

/* Quadratic, its cells graded. */
static bool finish_mesh(struct compute *k, struct arena *a, struct err *e)
{
    static const long layers_most[2] = {0, GRADE_MOST};
    long layers = GRADE_DEFAULT;
    if (!args_whole(&k->c->args, "grade", layers_most, &layers, e)) return false;
    topology_elevate(&k->mesh, a);
    boundary_make(&k->mesh, a, &k->boundary);
    if (grade_edges(&k->mesh, &k->boundary, (int)layers, a)) boundary_make(&k->mesh, a, &k->boundary);
    return true;
}

bool modes_compute_solid_mesh(struct compute *k, const char *mesh, const char *shape, struct err *e)
{
    const struct args *g = &k->c->args;
    struct arena *a = k->c->arena;
    double unit = 1;
    const char *text = args_value(g, "unit"); /* "mm" or "25.4 mm" */
    struct units_fault fault = {NULL, NULL};
    if (shape && text)
        return err_set(e, ERR_USAGE, "--unit is that of a mesh file; the lengths of --shape have their own units");
    if (text &&
        !units_read(text_number_length(text) > 0 ? text : arena_format(a, "1 %s", text), KEY_LENGTH, &unit, a, &fault))
        return err_set(e, ERR_USAGE, "--unit: '%s' %s; write m, cm, mm or a length such as 25.4 mm", text, fault.text);
    if (!(unit >= 1e-9 && unit <= 1e3)) return err_set(e, ERR_USAGE, "--unit: %s is not from 1 nm to 1 km", text);
    if (!(shape ? shapes_mesh(shape, a, &k->mesh, e)
                : mesh_read(mesh, unit, a, &k->mesh, e) && mesh_check(&k->mesh, a, e)))
        return false;
    return finish_mesh(k, a, e);
}

static bool read_mesh(struct compute *k, struct err *e)
{
    const struct args *g = &k->c->args;
    const char *shape = args_value(g, "shape");
    if (!shape == !g->n_operands)
        return err_set(e, ERR_USAGE,
                       shape ? "a mesh and --shape exclude each other"
                             : "rasp modes compute takes one MESH, or --shape");
    return modes_compute_solid_mesh(k, shape ? NULL : g->operands[0], shape, e);
}

/* ------------------------------------------------------------------ material */

/* FILE.yaml or FILE.yaml:NAME, an entry of the `materials` of a scene or of a file for one. */
static bool entry_of_file(struct compute *k, const char *word, struct err *e)
{
    struct arena *a = k->c->arena;
    char *file = arena_text(a, word), *name = strstr(file, ".yaml:");
    struct yaml *y = yaml_open(a);
    struct scene s = {0};
    double density = NAN;
    if (name) {
        name += 5;
        *name++ = '\0';
    }
    const struct diag_source *source = yaml_bytes_read(y, file, (struct diag_place){0});
    const struct yaml_node *root = source ? yaml_parse(y, source) : NULL,
                           *map = root ? yaml_get(root, "materials") : NULL;
    if (root && !map) return err_set(e, ERR_SCENE, "--material: %s has no materials", file);
    scene_materials_read(y, map, &s);
    if (y->diag->n) return err_set(e, y->missing ? ERR_INPUT : ERR_SCENE, "--material: %s", diag_first(y->diag));
    for (int i = 0; i < s.n_materials; i++)
        if (name ? !strcmp(name, s.materials[i].m.name) : s.n_materials == 1) {
            if (!cmd_quantity(k->c, "density", KEY_DENSITY, &density, e)) return false;
            k->material.named = isnan(s.materials[i].m.youngs_modulus) && !isnan(density)
                                    ? scene_materials_dense(&s.materials[i], density, a)
                                    : &s.materials[i].m;
        }
    const struct material *m = k->material.named;
    if (!m)
        return err_set(e, ERR_USAGE,
                       name ? "--material: %s has no material '%s'"
                            : "--material: %s has several materials: write %s:NAME",
                       file, name ? name : file);
    return !isnan(m->youngs_modulus) ||
           err_set(e, ERR_USAGE, "--material: '%s' has a wave_speed and no density: give --density", m->name);
}

bool modes_compute_solid_named(struct compute *k, struct err *e)
{
    const char *word = args_value(&k->c->args, "material"), *names[64] = {NULL};
    int n = 0;
    k->material.named = NULL;
    if (!word) return true;
    if (strstr(word, ".yaml")) return entry_of_file(k, word, e);
    for (const struct material *m = material_table; m->name && n < 63; m++) {
        names[n++] = m->name;
        if (!strcmp(word, m->name)) k->material.named = m;
    }
    if (k->material.named) return true;
    const char *meant = text_nearest(word, names), *list = names[0];
    for (int i = 1; i < n; i++)
        list = arena_format(k->c->arena, "%s, %s", list, names[i]);
    return meant ? err_set(e, ERR_USAGE, "--material: no material '%s'; did you mean %s?", word, meant)
                 : err_set(e, ERR_USAGE, "--material: no material '%s'; there are %s", word, list);
}

/* All moduli of a wood keep their ratios to that along the grain. */
bool modes_compute_solid_wooden(const struct material *t, double youngs_modulus, double density,
                                struct elastic *elastic, struct err *e)
{
    const struct material_radial *r = &t->radial;
    double more = youngs_modulus / t->youngs_modulus;
    struct elastic_wood w = {.e = {youngs_modulus, more * t->across, more * r->youngs_modulus},
                             .density = density,
                             .g = {more * r->shear_rt, more * r->shear_lr, more * t->shear}};
    w.nu[0] = r->poisson_rt * t->across / r->youngs_modulus; /* of a pull along y: nu_TR = nu_RT E_T/E_R */
    w.nu[1] = r->poisson_lr;
    w.nu[2] = t->poisson;
    return solid_element_orthotropic(&w, elastic, e);
}

static bool read_material(struct compute *k, struct err *e)
{
    struct compute_material *m = &k->material;
    const struct args *g = &k->c->args;
    if (!modes_compute_solid_named(k, e)) return false;
    const struct material none =
                              {.youngs_modulus = NAN, .poisson = NAN, .density = NAN, .alpha = 0, .beta = 0, .loss = 0},
                          *t = m->named ? m->named : &none;
    const struct key *nu = keys_find("surface.object.poisson");
    bool wood = t->radial.youngs_modulus > 0;
    double density = t->density;
    m->youngs_modulus = t->youngs_modulus;
    m->poisson = t->poisson;
    m->alpha = t->alpha;
    m->beta = t->beta;
    m->loss = t->loss;
    m->own = args_given(g, "youngs-modulus") || args_given(g, "poisson") || args_given(g, "density");
    m->own_damping = args_given(g, "alpha") || args_given(g, "beta") || args_given(g, "loss");
    if (!cmd_quantity(k->c, "youngs-modulus", KEY_PRESSURE, &m->youngs_modulus, e) ||
        !cmd_quantity(k->c, "density", KEY_DENSITY, &density, e) ||
        !args_number(g, "poisson", (const double[2]){nu->low, nu->high}, &m->poisson, e) ||
        !cmd_quantity(k->c, "alpha", KEY_PER_TIME, &m->alpha, e) ||
        !cmd_quantity(k->c, "beta", KEY_TIME, &m->beta, e) ||
        !args_number(g, "loss", (const double[2]){0, 2}, &m->loss, e))
        return false;
    if (isnan(m->youngs_modulus) || isnan(m->poisson) || isnan(density))
        return err_set(e, ERR_USAGE, "--material is needed, or all of --youngs-modulus, --poisson and --density");
    if (wood && args_given(g, "poisson"))
        return err_set(e, ERR_USAGE,
                       "--poisson: %s has six of them; leave it out, or give an isotropic material by "
                       "--youngs-modulus, --poisson and --density",
                       t->name);
    if (!(m->alpha >= 0 && m->beta >= 0) || m->alpha + m->beta + m->loss == 0)
        return err_set(e, ERR_USAGE,
                       m->alpha + m->beta + m->loss == 0
                           ? "--alpha, --beta or --loss is needed: without damping a mode rings for ever"
                           : "--alpha and --beta must not be below 0");
    if (!within(k, "youngs-modulus", m->youngs_modulus, e) || !within(k, "density", density, e) ||
        !(wood || within(k, "poisson", m->poisson, e)))
        return false;
    return wood ? modes_compute_solid_wooden(t, m->youngs_modulus, density, &m->elastic, e)
                : solid_element_isotropic(m->youngs_modulus, m->poisson, density, &m->elastic, e);
}

/* ------------------------------------------------------------------ what holds it */

/* The faces of the box's plane "x0" ... "z1". */
static bool plane(const struct compute *k, const char *word, struct solid_fixed *h)
{
    const struct boundary *b = &k->boundary;
    int axis = word[0] - 'x';
    if (axis < 0 || axis > 2 || (word[1] != '0' && word[1] != '1') || word[2]) return false;
    double at = word[1] == '0' ? b->low[axis] : b->high[axis],
           slack = 1e-6 * (b->high[0] - b->low[0] + b->high[1] - b->low[1] + b->high[2] - b->low[2]);
    h->n = 0;
    h->corner = arena_take(k->c->arena, (size_t)b->n, sizeof *h->corner);
    for (int i = 0; i < b->n; i++) {
        bool on = true;
        for (int j = 0; j < 6; j++)
            on = on && fabs(k->mesh.at[b->face[i][j]][axis] - at) <= slack;
        if (on) memcpy(h->corner[h->n++], b->face[i], 3 * sizeof(int));
    }
    return true;
}

static bool hold(struct compute *k, const char *option, int how, struct err *e)
{
    int n;
    const char **words = args_values(&k->c->args, option, &n);
    for (int i = 0; i < n; i++) {
        struct solid_fixed *h = &k->fixed[k->n_fixed];
        int named = 0;
        h->hold = how;
        while (named < k->mesh.groups && strcmp(k->mesh.group[named].name, words[i]) != 0)
            named++;
        if (named < k->mesh.groups) {
            h->n = k->mesh.group[named].n;
            h->corner = k->mesh.group[named].corner;
        } else if (!plane(k, words[i], h)) {
            const char *list = "";
            for (int j = 0; j < k->mesh.groups; j++)
                list = arena_format(k->c->arena, "%s%s%s", list, j ? ", " : "", k->mesh.group[j].name);
            return err_set(e, ERR_USAGE,
                           "--%s: there is no face '%s'; write x0, x1, y0, y1, z0 or z1 (where the solid ends)%s%s",
                           option, words[i], *list ? ", or one that the mesh names: " : "", list);
        }
        if (h->n == 0)
            return err_set(e, ERR_SCENE,
                           "--%s %s: the solid has no face that lies in that plane; name faces in the mesh (a physical "
                           "surface), or take another",
                           option, words[i]);
        k->fixed_names[k->n_fixed++] = words[i];
    }
    return true;
}

/* --clamp, --support: the faces of k->mesh into k->held. */
bool modes_compute_solid_fixed(struct compute *k, struct err *e)
{
    int clamped, supported;
    args_values(&k->c->args, "clamp", &clamped);
    args_values(&k->c->args, "support", &supported);
    k->fixed = ARENA_TAKE(k->c->arena, struct solid_fixed, clamped + supported + 1);
    k->fixed_names = ARENA_TAKE(k->c->arena, const char *, clamped + supported + 1);
    return hold(k, "clamp", SOLID_CLAMPED, e) && hold(k, "support", SOLID_SUPPORTED, e);
}

bool modes_compute_solid_read(struct compute *k, struct err *e)
{
    static const long counts[2] = {1, 2000}, orders[2] = {SOLID_LATTICE_LEAST, SOLID_LATTICE_MOST};
    k->top = 20000;
    k->most = 100;
    k->order = args_given(&k->c->args, "shape") ? shapes_order(args_value(&k->c->args, "shape")) : 2;
    if (!cmd_quantity(k->c, "top", KEY_FREQUENCY, &k->top, e) ||
        !args_whole(&k->c->args, "modes", counts, &k->most, e) ||
        !args_whole(&k->c->args, "order", orders, &k->order, e))
        return false;
    if (!(k->top > 0 && k->top <= 1e7))
        return err_set(e, ERR_USAGE, "--top: %g Hz is not above 0 and at most 10 MHz", k->top);
    if (!read_material(k, e) || !read_mesh(k, e) || !modes_compute_solid_fixed(k, e)) return false;
    k->note = k->mesh.note;
    return check_solid(k, e);
}

bool modes_compute_solid_solve(struct compute *k, struct err *e)
{
    struct solid_ask ask = {.material = &k->material.elastic,
                            .fixed = k->fixed,
                            .n_fixed = k->n_fixed,
                            .order = (int)k->order,
                            .most = (int)k->most,
                            .top = k->top};
    struct arena *a = k->c->arena;
    if (!solid_modes(&k->mesh, &k->boundary, &ask, a, &k->modes, e)) return false;
    const struct compute_material *m = &k->material;
    k->frequency = ARENA_TAKE(k->c->arena, double, k->modes.n);
    k->decay = ARENA_TAKE(k->c->arena, double, k->modes.n);
    k->mode = ARENA_TAKE(k->c->arena, int, k->modes.n);
    for (int i = 0; i < k->modes.n; i++) {
        double lambda = k->modes.lambda[i], d = material_decay(m->alpha, m->beta, m->loss, sqrt(lambda));
        if (lambda <= d * d) {
            k->overdamped++;
            continue;
        }
        k->mode[k->n] = i;
        k->decay[k->n] = d;
        double f = k->frequency[k->n++] = sqrt(lambda - d * d) / (2.0 * REAL_PI);
        k->least = k->n == 1 ? f : fmin(k->least, f);
        k->greatest = fmax(k->greatest, f);
    }
    if (k->n == 0)
        return err_set(
            e, ERR_SCENE,
            "%s: all %d modes are overdamped: they creep back without ringing; lower --alpha, --beta or --loss",
            k->mesh.name, k->overdamped);
    if (k->overdamped)
        note(k, arena_format(a, "%d overdamped mode%s left out", k->overdamped, k->overdamped == 1 ? " is" : "s are"));
    if (!k->modes.all)
        note(k, arena_format(a, "the %d lowest modes reach up to %.5g Hz; --modes takes more of those below %g Hz",
                             k->modes.n, k->greatest, k->top));
    return true;
}

/* --estimate: how far the frequencies of `rasp modes compute` are off, from a second, coarser computation
 * (fem/solid.h). */

#define LONGER 1.5 /* cells of the coarser mesh */
#define LEAST 1.15 /* of that, where whole numbers of cells allow no more */

enum { BEYOND = 12 }; /* modes more: a coarse mesh has them in another order */

bool modes_compute_solid_coarser(const struct compute *k, const char *shape, struct compute *c, struct err *e)
{
    c->c = k->c;
    if (!shapes_mesh_coarser(shape, LONGER, k->c->arena, &c->mesh, e)) return false;
    return finish_mesh(c, k->c->arena, e) &&
           modes_compute_solid_fixed(c, e); /* the faces that are held, by the same names */
}

bool modes_compute_solid_estimate(struct compute *k, struct err *e)
{
    const char *shape = args_value(&k->c->args, "shape");
    struct compute c = {.c = k->c,
                        .mesh = k->mesh,
                        .boundary = k->boundary,
                        .fixed = k->fixed,
                        .n_fixed = k->n_fixed,
                        .order = k->order};
    if (!args_given(&k->c->args, "estimate")) return true;
    if (shape) {
        if (!modes_compute_solid_coarser(k, shape, &c, e)) return false;
    } else if (--c.order < SOLID_LATTICE_LEAST)
        return err_set(
            e, ERR_USAGE,
            "--estimate of a mesh file compares with the order below, and there is none below 2: add --order "
            "3 (or 4)");
    struct solid_ask ask = {
        .material = &k->material.elastic, .order = (int)c.order, .most = k->modes.n + BEYOND, .top = 3 * k->top};
    ask.fixed = c.fixed;
    ask.n_fixed = c.n_fixed;
    if (!solid_modes(&c.mesh, &c.boundary, &ask, k->c->arena, &c.modes, e)) return false;
    const struct solid_side fine = {&k->mesh, &k->boundary, &k->modes}, coarse = {&c.mesh, &c.boundary, &c.modes};
    solid_estimate(&fine, &coarse, k->c->arena, &k->estimate);
    k->estimated = true;
    k->coarse_elements = c.mesh.elements;
    k->coarse_freedoms = c.modes.freedoms;
    k->coarse_order = c.order;
    return !shape || k->estimate.ratio >= LEAST ||
           err_set(e, ERR_USAGE,
                   "--estimate: the mesh of %s is as coarse as the shape allows, so that there is none to compare "
                   "with; give a higher fineness=",
                   text_shown(k->c->arena, k->mesh.name));
}

const char *modes_compute_solid_error_text(const struct compute *k)
{
    const struct solid_estimate *s = &k->estimate;
    struct arena *a = k->c->arena;
    const char *of = isnan(s->most) ? "no mode could be compared"
                                    : arena_format(a, "median %.2g %%, greatest %.2g %% (mode %d)", 100 * s->median,
                                                   100 * s->most, s->worst + 1);
    return s->unpaired && !isnan(s->most)
               ? arena_format(a, "%s; %d of %d modes have no pair", of, s->unpaired, k->modes.n)
               : of;
}

void modes_compute_solid_estimate_write(FILE *f, const struct compute *k)
{
    const struct solid_estimate *s = &k->estimate;
    if (!k->estimated) return;
    if (args_given(&k->c->args, "shape"))
        fprintf(f,
                "# estimate: by how much frequencies are too high, (f_coarse - f)/(r^4 - 1) of a second mesh of %d "
                "tetrahedra, %ld freedoms, whose cells are r = %.3g times as long (as if errors fell with the fourth "
                "power of length: flat and free solids converge faster, held edges beside free ones more slowly; cells "
                "that are as long in both, as the one through a thin wall, show no error); ?: no mode of the second "
                "mesh moves alike\n",
                k->coarse_elements, k->coarse_freedoms, s->ratio);
    else
        fprintf(f,
                "# estimate: by how much frequencies of order %ld (%ld freedoms) are higher on the same mesh: the "
                "error of that order, more than that of this one; ?: no mode of that order moves alike\n",
                k->coarse_order, k->coarse_freedoms);
    fprintf(f, "# estimate of all: %s\n", modes_compute_solid_error_text(k));
    /* Modes as the table counts them, ten a line. */
    for (int i = 0; i < k->n; i++) {
        double x = k->estimate.error[k->mode[i]];
        if (i % 10 == 0)
            fprintf(f, "%s# estimate of modes %d to %d, %%:", i ? "\n" : "", i + 1, i + 10 < k->n ? i + 10 : k->n);
        if (isnan(x))
            fputs(" ?", f);
        else
            fprintf(f, " %+.2g", 100 * x);
    }
    fputc('\n', f);
}
