/* --estimate: how far the frequencies of `rasp modes compute` are off, from a second, coarser computation (fem/solid_estimate.h). */
#include <math.h>
#include <string.h>

#include "base/text.h"
#include "cmd/modes_compute.h"
#include "fem/mesh_raise.h"
#include "fem/shapes.h"

#define LONGER 1.5 /* cells of the coarser mesh */
#define LEAST 1.15 /* of that, where whole numbers of cells allow no more */

enum { BEYOND = 12 }; /* modes more: a coarse mesh has them in another order */

/* The faces that are held in the coarse mesh, by the same names. */
static bool solve_coarse(struct compute *k, struct compute *c, struct err *e)
{
    struct solid_ask ask = {.material = &k->material.elastic, .order = (int)c->order, .most = k->modes.n + BEYOND, .top = 3 * k->top};
    if (c->mesh.at != k->mesh.at && !modes_compute_solid_held(c, e))
        return false;
    ask.held = c->held;
    ask.n_held = c->n_held;
    return solid_modes(&c->mesh, &c->boundary, &ask, k->c->arena, &c->modes, e);
}

static bool coarser(struct compute *k, struct compute *c, struct err *e)
{
    const char *shape = args_value(&k->c->args, "shape");
    *c = (struct compute){.c = k->c, .mesh = k->mesh, .boundary = k->boundary, .held = k->held, .n_held = k->n_held, .order = k->order};
    if (!shape) {
        c->order--;
        return c->order >= SOLID_LATTICE_LEAST ||
               err_set(e, ERR_USAGE, "--estimate of a mesh file compares with the order below, and there is none below 2: add --order 3 (or 4)");
    }
    if (!shapes_mesh_coarser(shape, LONGER, k->c->arena, &c->mesh, e))
        return false;
    mesh_raise(&c->mesh, k->c->arena);
    boundary_make(&c->mesh, k->c->arena, &c->boundary);
    return true;
}

bool modes_compute_estimate(struct compute *k, struct err *e)
{
    struct compute c;
    if (!args_given(&k->c->args, "estimate"))
        return true;
    if (!coarser(k, &c, e) || !solve_coarse(k, &c, e))
        return false;
    const struct solid_side fine = {&k->mesh, &k->boundary, &k->modes}, coarse = {&c.mesh, &c.boundary, &c.modes};
    solid_estimate(&fine, &coarse, k->c->arena, &k->estimate);
    k->estimated = true;
    k->coarse_elements = c.mesh.elements;
    k->coarse_freedoms = c.modes.freedoms;
    k->coarse_order = c.order;
    return (args_given(&k->c->args, "shape") ? k->estimate.ratio >= LEAST : true) ||
           err_set(e, ERR_USAGE, "--estimate: the mesh of %s is as coarse as the shape allows, so that there is none to compare with; give a higher fineness=", text_shown(k->c->arena, k->mesh.name));
}

const char *modes_compute_estimate_says(const struct compute *k)
{
    const struct solid_estimate *s = &k->estimate;
    struct arena *a = k->c->arena;
    const char *of = isnan(s->most) ? "no mode could be compared" : arena_format(a, "median %.2g %%, greatest %.2g %% (mode %d)", 100 * s->median, 100 * s->most, s->worst + 1);
    return s->unpaired && !isnan(s->most) ? arena_format(a, "%s; %d of %d modes have no pair", of, s->unpaired, k->modes.n) : of;
}

/* Modes as the table counts them, ten a line. */
static void figures(FILE *f, const struct compute *k)
{
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

void modes_compute_estimate_write(FILE *f, const struct compute *k)
{
    const struct solid_estimate *s = &k->estimate;
    if (!k->estimated)
        return;
    if (args_given(&k->c->args, "shape"))
        fprintf(f, "# estimate: by how much frequencies are too high, (f_coarse - f)/(r^4 - 1) of a second mesh of %d tetrahedra, %ld freedoms, whose cells are r = %.3g times as long (as if errors fell "
                "with the fourth power of length: flat and free solids converge faster, held edges beside free ones more slowly; cells that are as long in both, as the one through a thin wall, "
                "show no error); ?: no mode of the second mesh moves alike\n", k->coarse_elements, k->coarse_freedoms, s->ratio);
    else
        fprintf(f, "# estimate: by how much frequencies of order %ld (%ld freedoms) are higher on the same mesh: the error of that order, more than that of this one; ?: no mode of that order "
                "moves alike\n", k->coarse_order, k->coarse_freedoms);
    fprintf(f, "# estimate of all: %s\n", modes_compute_estimate_says(k));
    figures(f, k);
}
