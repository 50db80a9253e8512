/* rasp modes object RECIPE -o FILE.csv: the modes of an object of closed form as a mode table.

   Velocity per N s at A e^(s t), s = -decay + j w; displacement is A/s, acceleration A s (for t > 0: a reader adds the direct term).

   --load: a point mass M where the object is touched adds M phi^2 to a mode's mass m and nothing to its stiffness or damping. As far as each mode keeps
   its shape (Rayleigh's quotient; to first order in M phi^2/m) and for weak damping, f falls by q = (1 + M phi^2/m)^(-1/2), decay and gain by q^2. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/outfile.h"
#include "base/text.h"
#include "cmd/modes.h"
#include "cmd/modes_fit.h"
#include "cmd/modes_output.h"
#include "cmd/tell.h"
#include "num/real.h"
#include "output/mark.h"
#include "response/mode_table_write.h"
#include "scene/units.h"

struct job {
    struct cmd_call *c;
    struct modes_body body;
    struct object object;
    struct modes modes;
    struct modes_fit fit;
    struct modes_places places;
    double error;         /* dB, of interpolation between the places; NAN: of none */
    double listen[2];
    bool heard_elsewhere;
    double load;          /* kg */
    double *phi;          /* [modes.n] */
    const char *note;
    int quantity, *order; /* order: of the modes, by frequency */
};

static bool read_output(struct job *j, struct err *e)
{
    const char *file = args_value(&j->c->args, "output");
    if (!file)
        return err_set(e, ERR_USAGE, "-o FILE.csv is needed: the mode table to write");
    return modes_output_spares(file, j->c->args.operands[0], e) && mark_absent(file, args_given(&j->c->args, "force"), e);
}

static bool read_load(struct job *j, struct err *e)
{
    const char *text = args_value(&j->c->args, "load");
    struct units_fault fault = {NULL, NULL};
    if (text && !units_read(text, KEY_MASS, &j->load, j->c->arena, &fault))
        return err_set(e, ERR_USAGE, "--load %s: %s", fault.text, fault.cure);
    return !text || (j->load > 0 && j->load <= 1000) || err_set(e, ERR_USAGE, "--load: %s is not above 0 and at most 1000 kg", text);
}

/* Modes by rising frequency; those of one frequency as they come. */
static void sort(struct job *j)
{
    const double *f = j->modes.frequency;
    j->order = ARENA_TAKE(j->c->arena, int, j->modes.n);
    for (int i = 0; i < j->modes.n; i++) {
        int k = i;
        for (; k > 0 && f[j->order[k - 1]] > f[i]; k--)
            j->order[k] = j->order[k - 1];
        j->order[k] = i;
    }
}

/* What the mass at the place does to poles and gains of velocity. */
static void load(const struct job *j, double x, double y, const struct modes_point *p)
{
    const struct object *o = j->modes.object;
    if (j->load == 0.0)
        return;
    o->shapes(o, x, y, j->phi);
    for (int i = 0; i < j->modes.n; i++) {
        double less = 1.0 / (1.0 + j->load * j->phi[i] * j->phi[i] / o->mass[i]);
        p->frequency[i] *= sqrt(less);
        p->decay[i] *= less;
        p->re[i] *= less;
        p->im[i] *= less;
    }
}

/* What a table holds at a place in the object's coordinates. */
static double gains_at(const void *self, double x, double y, const struct modes_point *p)
{
    const struct job *j = (const struct job *)self;
    const struct modes *m = &j->modes;
    const double *origin = j->body.response->object.origin;
    double off = modes_at(m, &(struct modes_where){.x = x + origin[0], .y = y + origin[1]}, p);
    memcpy(p->frequency, m->frequency, (size_t)m->n * sizeof *p->frequency);
    memcpy(p->decay, m->decay, (size_t)m->n * sizeof *p->decay);
    load(j, x, y, p);
    modes_to_quantity(j->quantity, m->n, p);
    return off;
}

static bool make(struct job *j, struct err *e)
{
    static const long counts[2] = {1, 100000};
    long most = 100000;
    const struct object *o = &j->object;
    for (const char *const *s = (const char *const *)j->body.scene.sources; s && *s; s++) /* what a scene includes */
        if (!modes_output_spares(args_value(&j->c->args, "output"), *s, e))
            return false;
    j->heard_elsewhere = args_given(&j->c->args, "listen");
    if (!args_whole(&j->c->args, "modes", counts, &most, e) ||
        !modes_lengths(j->c, &(struct modes_lengths){"listen", "X,Y", 2}, j->listen, e) ||
        !modes_body_object(j->c, &j->body, &j->object, &j->note, e))
        return false;
    double off =
        j->heard_elsewhere ? o->shapes(o, j->listen[0], j->listen[1], ARENA_TAKE(j->c->arena, double, o->n)) : 0.0;
    if (off > 1e-9)
        return err_set(e, ERR_SCENE, "--listen: the place (%.9g, %.9g) m lies %.3g m off the object", j->listen[0],
                       j->listen[1], off);
    object_modes(o, j->body.response->object.origin, j->heard_elsewhere ? j->listen : NULL, (int)most, j->c->arena,
                 &j->modes);
    j->phi = ARENA_TAKE(j->c->arena, double, j->modes.n);
    j->fit =
        (struct modes_fit){.self = j, .at = gains_at, .n = j->modes.n, .shared = j->load == 0.0, .arena = j->c->arena};
    if (!modes_body_places(j->c, &j->body, o, &j->fit, &j->places, e))
        return false;
    j->error = modes_fit_error(&j->fit, &j->places);
    return true;
}

static void comments(FILE *f, const struct job *j)
{
    const double *origin = j->body.response->object.origin;
    fprintf(f, "# poles: %s\n%s# quantity: %s\n# normalisation: %s, physical; heard at ", j->load > 0.0 ? "separate" : "shared",
            j->load > 0.0 ? "# gains: complex\n" : "", modes_quantity_name(j->quantity), modes_per_impulse(j->quantity));
    if (j->heard_elsewhere)
        fprintf(f, "x = %.12g m, y = %.12g m\n", j->listen[0] + origin[0], j->listen[1] + origin[1]);
    else
        fputs("the place that is touched\n", f);
    fprintf(f, "# radius_m: %.12g\n", j->object.radius);
    if (j->body.title)
        fprintf(f, "# title: %s\n", text_shown(j->c->arena, j->body.title));
    if (j->body.remark)
        fprintf(f, "# remark: %s\n", text_shown(j->c->arena, j->body.remark));
    modes_describe(f, &j->object);
    if (j->load > 0.0)
        fprintf(f, "# load: %.12g kg rest where the object is touched; each mode keeps its shape (Rayleigh's quotient), its mass grows by load x shape^2\n", j->load);
    modes_fit_write(f, j->error, &j->places, j->c->arena);
    if (j->note)
        fprintf(f, "# note: %s\n", j->note);
}

static void write_table(FILE *f, const struct job *j)
{
    const struct modes *m = &j->modes;
    const double *origin = j->body.response->object.origin;
    struct modes_point p = modes_point_make(j->c->arena, m->n);
    comments(f, j);
    mode_table_write_header(f);
    for (int i = 0; i < j->places.n; i++) {
        struct mode_table_place place = {12, i + 1, j->places.xy[i][0] + origin[0], j->places.xy[i][1] + origin[1]};
        gains_at(j, j->places.xy[i][0], j->places.xy[i][1], &p);
        mode_table_write_place(f, &place, m->n, j->order, &p, j->quantity);
    }
}

static void report(const struct job *j, const char *file)
{
    const struct modes *m = &j->modes;
    printf("%s: %d mode%s from %.6g to %.6g Hz at %d place%s", text_shown(j->c->arena, file), m->n, m->n == 1 ? "" : "s", m->frequency[j->order[0]], m->frequency[j->order[m->n - 1]],
           j->places.n, j->places.n == 1 ? "" : "s");
    if (j->places.left_out)
        printf(" (%d of the grid lie beside the object)", j->places.left_out);
    modes_fit_report(j->error, j->c->arena);
    putchar('\n');
}

int modes_object_run(struct cmd_call *c, struct err *e)
{
    struct job j = {.c = c};
    struct outfile o;
    const char *file = args_value(&c->args, "output");
    if (!read_output(&j, e) || !modes_quantity(c, &j.quantity, e) || !read_load(&j, e) || !modes_body_read(c, c->args.operands[0], &j.body, e) || !make(&j, e))
        return (int)e->kind;
    sort(&j);
    if (!outfile_open(&o, file, e))
        return (int)e->kind;
    write_table(o.stream, &j);
    if (!outfile_commit(&o, e))
        return (int)e->kind;
    if (!args_given(&c->args, "quiet"))
        report(&j, file);
    if (j.note && !args_given(&c->args, "quiet"))
        tell_remark(c, "modes", j.note);
    modes_fit_warn(c, j.error, &j.places);
    return 0;
}
