/* rasp modes object, list: modes of objects of closed form as tables, and the strongest modes of anything. */
#include "cmd/modes.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/outfile.h"
#include "base/text.h"
#include "cmd/message.h"
#include "num/real.h"
#include "output/mark.h"
#include "response/mode_table.h"
#include "response/object_kinds.h"
#include "response/space.h"
#include "scene/material.h"
#include "scene/units.h"
#include "trajectory/contact.h"

/* What an object is, as comment lines of a mode table. */

static const char *word(const char *key, int value) { return keys_find(key)->choices[value].word; }

static void length(FILE *f, const char *name, double value)
{
    if (!isnan(value)) fprintf(f, ", %s %.9g m", name, value);
}

static void object(FILE *f, const struct object_given *g)
{
    bool has_edges =
        g->shape == OBJECT_BAR || g->shape == OBJECT_ROD || g->shape == OBJECT_PLATE || g->shape == OBJECT_DISK;
    bool slender = g->shape == OBJECT_BAR || g->shape == OBJECT_ROD;
    fprintf(f, "# object: %s", word("surface.object.shape", g->shape));
    length(f, "length", g->length);
    length(f, "width", g->width);
    length(f, "diameter", g->diameter);
    length(f, g->shape == OBJECT_ROD ? "wall" : "thickness", g->thickness);
    if (!isnan(g->tension)) fprintf(f, ", tension %.9g N", g->tension);
    if (!isnan(g->surface_tension)) fprintf(f, ", tension %.9g N/m", g->surface_tension);
    if (has_edges) fprintf(f, ", edges %s", word("surface.object.edges", g->edges));
    if (slender) fprintf(f, ", %s", word("surface.object.waves", g->waves));
    fputc('\n', f);
}

static void figure(FILE *f, const char *name, double value, const char *unit)
{
    if (!isnan(value)) fprintf(f, ", %s %.9g%s%s", name, value, *unit ? " " : "", unit);
}

static void material(FILE *f, const struct object_body *b)
{
    const struct object_given *g = b->given;
    const struct material *m = material_given(g);
    bool plate = g->shape == OBJECT_PLATE, sheet = plate || g->shape == OBJECT_DISK || g->shape == OBJECT_SHELL;
    bool stiff = g->shape != OBJECT_MEMBRANE && g->shape != OBJECT_DRUM;
    fprintf(f, "# material: %s, density %.9g kg/m^3", g->own ? g->own->name : word("surface.material", g->material),
            b->density);
    figure(f, "Young's modulus", stiff ? b->youngs_modulus : NAN, "Pa");
    if (plate && b->across != b->youngs_modulus) {
        figure(f, "along y", b->across, "Pa");
        figure(f, "shear modulus", b->shear, "Pa");
    }
    figure(f, "Poisson's ratio", sheet ? b->poisson : NAN, "");
    fputc('\n', f);
    modes_damping_write(f, (const double[3]){b->alpha, b->beta, b->loss}, m,
                        !(isnan(g->youngs_modulus) && isnan(g->youngs_modulus_across) && isnan(g->shear_modulus) &&
                          isnan(g->poisson) && isnan(g->density)),
                        !(isnan(g->alpha) && isnan(g->beta) && isnan(g->loss)));
}

/* What `rasp modes` looks at: a body of a scene or recipe, its object, and places on that. */

/* What a body of the operand rings with: the operand is a scene, or a recipe of surface keys. */
struct body {
    struct scene scene;
    const struct response *response;
    const char *key;            /* "surface", "scraper" or "ball" */
    const char *title, *remark; /* the recipe's title and source, the scene's title; NULL: none */
};

/* Of a scene that names a recipe of an object nothing else matters. */
static const char frame[] = "scraper: {mass: 1 g}\nmotion: {path: still, duration: 1 s}\n"
                            "contact: {model: strike, strike: {pulse: half_sine, speed: 1 m/s, stiffness: "
                            "1e6}}\noutput: {diagnostics: {rate: 1 kHz}}\n";

static bool body_read(struct cmd_call *c, const char *file, struct body *b, struct err *e)
{
    static const char *const words[] = {"surface", "scraper", "ball", NULL};
    int word = 0;
    bool scene;
    if (!args_word(&c->args, "body", words, &word, e)) return false;
    bool tool = word > 0;
    b->key = words[word];
    if (!cmd_recipe_is_scene(c, file, &scene, e)) return false;
    if (tool && !scene)
        return err_set(e, ERR_USAGE,
                       "--body %s: %s is a recipe, which describes a surface; it needs a scene (with the key rasp: 1)",
                       b->key, file);
    if (!cmd_recipe_read(c, file, frame, &b->scene, e)) return false;
    if (b->scene.n_contacts > 1)
        return err_set(e, ERR_SCENE, "%s: has %d contacts; rasp modes takes a recipe, or a scene of one contact", file,
                       b->scene.n_contacts);
    if (tool && strcmp(b->key, contact_tool(b->scene.contacts)) != 0)
        return err_set(e, ERR_USAGE, "--body %s: what touches the surface of %s is a %s", b->key, file,
                       contact_tool(b->scene.contacts));
    b->title = scene ? b->scene.title : cmd_recipe_remark(c, file, "title");
    b->remark = scene ? NULL : cmd_recipe_remark(c, file, "source");
    b->response = tool ? &b->scene.contacts[0].scraper.response : &b->scene.contacts[0].surface.response;
    return true;
}

/* The object of closed form that it is, with all modes below --top. *note: how far its theory reaches, NULL: nothing to
 * say. ERR_SCENE: it is none. */
static bool body_object(struct cmd_call *c, const struct body *b, struct object *o, const char **note, struct err *e)
{
    struct object_ask ask = {.key = arena_format(c->arena, "%s.object", b->key), .top = 20000, .most = 10000};
    if (!cmd_quantity(c, "top", KEY_FREQUENCY, &ask.top, e)) return false;
    if (!(ask.top > 0 && ask.top <= 1e7))
        return err_set(e, ERR_USAGE, "--top: %s is not above 0 and at most 10 MHz", args_value(&c->args, "top"));
    if (!b->response->object.given)
        return err_set(e, ERR_SCENE, "%s: there is no %s: it describes no object of simple shape", c->args.operands[0],
                       ask.key);
    if (!object_make(&b->response->object, &ask, c->arena, o, note, e)) return false;
    return o->n < ask.most ||
           err_set(e, ERR_SCENE, "%s has more than %d modes below %g Hz; lower --top", ask.key, ask.most - 1, ask.top);
}

/* ------------------------------------------------------------------ places */

struct footing {
    const struct object *object;
    double *phi;
};

static double off(const void *self, double x, double y)
{
    const struct footing *g = self;
    return g->object->shapes(g->object, x, y, g->phi);
}

/* fit: as in struct modes_ground. What is slender has its places on a line; of a shell any place is like the other. */
static bool body_places(struct cmd_call *c, const struct body *b, const struct object *o, struct modes_fit *fit,
                        struct modes_places *p, struct err *e)
{
    struct footing g = {o, ARENA_TAKE(c->arena, double, o->n)};
    struct modes_ground ground = {.self = &g,
                                  .off = off,
                                  .low = {o->low[0], o->low[1]},
                                  .high = {o->high[0], o->high[1]},
                                  .standard = {33, 1},
                                  .fit = fit};
    const double *at = b->response->object.at;
    bool tool = strcmp(b->key, "surface") != 0;
    if (tool || o->shape == OBJECT_SHELL)
        memcpy(ground.standard, (int[2]){1, 1}, sizeof ground.standard);
    else if (o->flat)
        memcpy(ground.standard, (int[2]){17, 9}, sizeof ground.standard);
    if (tool) memcpy(ground.at, at, sizeof ground.at);
    return modes_places(c, &ground, p, e);
}

/* rasp modes object RECIPE -o FILE.csv: the modes of an object of closed form as a mode table.

   Velocity per N s at A e^(s t), s = -decay + j w; displacement is A/s, acceleration A s (for t > 0: a reader adds the
   direct term).

   --load: a point mass M where the object is touched adds M phi^2 to a mode's mass m and nothing to its stiffness or
   damping. As far as each mode keeps its shape (Rayleigh's quotient; to first order in M phi^2/m) and for weak damping,
   f falls by q = (1 + M phi^2/m)^(-1/2), decay and gain by q^2. */

struct job {
    struct cmd_call *c;
    struct body body;
    struct object object;
    struct modes modes;
    struct modes_fit fit;
    struct modes_places places;
    double error; /* dB, of interpolation between the places; NAN: of none */
    double listen[2];
    bool listens_elsewhere;
    double load; /* kg */
    double *phi; /* [modes.n] */
    const char *note;
    int quantity, *order; /* order: of the modes, by frequency */
};

/* What a table holds at a place in the object's coordinates. */
static double gains_at(const void *self, double x, double y, const struct modes_point *p)
{
    const struct job *j = self;
    const struct modes *m = &j->modes;
    const double *origin = j->body.response->object.origin;
    double off = modes_at(m, &(struct modes_where){.x = x + origin[0], .y = y + origin[1]}, p);
    memcpy(p->frequency, m->frequency, (size_t)m->n * sizeof *p->frequency);
    memcpy(p->decay, m->decay, (size_t)m->n * sizeof *p->decay);
    if (j->load != 0.0) m->object->shapes(m->object, x, y, j->phi);
    for (int i = 0; j->load != 0.0 && i < m->n; i++) { /* what the mass at the place does to poles and gains */
        double less = 1.0 / (1.0 + j->load * j->phi[i] * j->phi[i] / m->object->mass[i]);
        p->frequency[i] *= sqrt(less);
        p->decay[i] *= less;
        p->re[i] *= less;
        p->im[i] *= less;
    }
    modes_to_quantity(j->quantity, m->n, p);
    return off;
}

static bool make(struct job *j, struct err *e)
{
    static const long counts[2] = {1, 100000};
    long most = 100000;
    const struct object *o = &j->object;
    for (const char *const *s = (const char *const *)j->body.scene.sources; s && *s; s++) /* what a scene includes */
        if (!modes_output_spares(args_value(&j->c->args, "output"), *s, e)) return false;
    j->listens_elsewhere = args_given(&j->c->args, "listen");
    if (!args_whole(&j->c->args, "modes", counts, &most, e) || !modes_lengths(j->c, "listen", "X,Y", 2, j->listen, e) ||
        !body_object(j->c, &j->body, &j->object, &j->note, e))
        return false;
    double off =
        j->listens_elsewhere ? o->shapes(o, j->listen[0], j->listen[1], ARENA_TAKE(j->c->arena, double, o->n)) : 0.0;
    if (off > 1e-9)
        return err_set(e, ERR_SCENE, "--listen: the place (%.9g, %.9g) m lies %.3g m off the object", j->listen[0],
                       j->listen[1], off);
    object_modes(o, j->body.response->object.origin, j->listens_elsewhere ? j->listen : NULL, (int)most, j->c->arena,
                 &j->modes);
    j->phi = ARENA_TAKE(j->c->arena, double, j->modes.n);
    j->fit =
        (struct modes_fit){.self = j, .at = gains_at, .n = j->modes.n, .shared = j->load == 0.0, .arena = j->c->arena};
    if (!body_places(j->c, &j->body, o, &j->fit, &j->places, e)) return false;
    j->error = modes_places_error(&j->fit, &j->places);
    return true;
}

static void comments(FILE *f, const struct job *j)
{
    const double *origin = j->body.response->object.origin;
    fprintf(f, "# poles: %s\n%s# quantity: %s\n# normalisation: %s, physical; heard at ",
            j->load > 0.0 ? "separate" : "shared", j->load > 0.0 ? "# gains: complex\n" : "",
            modes_quantity_name(j->quantity), modes_per_impulse(j->quantity));
    if (j->listens_elsewhere)
        fprintf(f, "x = %.12g m, y = %.12g m\n", j->listen[0] + origin[0], j->listen[1] + origin[1]);
    else
        fputs("the place that is touched\n", f);
    fprintf(f, "# radius_m: %.12g\n", j->object.radius);
    if (j->body.title) fprintf(f, "# title: %s\n", text_shown(j->c->arena, j->body.title));
    if (j->body.remark) fprintf(f, "# remark: %s\n", text_shown(j->c->arena, j->body.remark));
    /* "# key: value" lines that say what the object is: object, material, damping, holds. */
    const struct object_inside *in = object_inside(&j->object);
    object(f, in->body->given);
    material(f, in->body);
    fprintf(f, "# holds: %s: no shear, no rotation of sections, no radiation\n", in->kind->theory);
    if (j->load > 0.0)
        fprintf(f,
                "# load: %.12g kg rest where the object is touched; each mode keeps its shape (Rayleigh's quotient), "
                "its mass grows by load x shape^2\n",
                j->load);
    modes_places_write(f, j->error, &j->places, j->c->arena);
    if (j->note) fprintf(f, "# note: %s\n", j->note);
}

int modes_object_run(struct cmd_call *c, struct err *e)
{
    struct job j = {.c = c};
    struct outfile o;
    const char *file = args_value(&c->args, "output");
    if (!file) return err_set(e, ERR_USAGE, "-o FILE.csv is needed: the mode table to write"), (int)e->kind;
    if (!modes_output_spares(file, c->args.operands[0], e) || !mark_absent(file, args_given(&c->args, "force"), e) ||
        !modes_quantity(c, &j.quantity, e))
        return (int)e->kind;
    const char *load = args_value(&c->args, "load");
    struct units_fault fault = {NULL, NULL};
    if (load && !units_read(load, KEY_MASS, &j.load, c->arena, &fault))
        err_set(e, ERR_USAGE, "--load %s: %s", fault.text, fault.cure);
    else if (load && !(j.load > 0 && j.load <= 1000))
        err_set(e, ERR_USAGE, "--load: %s is not above 0 and at most 1000 kg", load);
    if (e->kind || !body_read(c, c->args.operands[0], &j.body, e) || !make(&j, e)) return (int)e->kind;
    /* Modes by rising frequency; those of one frequency as they come. */
    const double *f = j.modes.frequency;
    j.order = ARENA_TAKE(j.c->arena, int, j.modes.n);
    for (int i = 0; i < j.modes.n; i++) {
        int k = i;
        for (; k > 0 && f[j.order[k - 1]] > f[i]; k--)
            j.order[k] = j.order[k - 1];
        j.order[k] = i;
    }
    if (!outfile_open(&o, file, e)) return (int)e->kind;
    const struct modes *m = &j.modes;
    const double *origin = j.body.response->object.origin;
    struct modes_point p = modes_point_make(j.c->arena, m->n);
    comments(o.stream, &j);
    mode_table_write_header(o.stream);
    for (int i = 0; i < j.places.n; i++) {
        struct mode_table_place place = {12, i + 1, j.places.xy[i][0] + origin[0], j.places.xy[i][1] + origin[1]};
        gains_at(&j, j.places.xy[i][0], j.places.xy[i][1], &p);
        mode_table_write_place(o.stream, &place, m->n, j.order, &p, j.quantity);
    }
    if (!outfile_commit(&o, e)) return (int)e->kind;
    if (!args_given(&c->args, "quiet")) {
        modes_places_report(file, &j.places, "object", j.error, m->n,
                            (const double[2]){f[j.order[0]], f[j.order[m->n - 1]]}, c->arena);
        putchar('\n');
        if (j.note) message_remark(c, "modes", j.note);
    }
    modes_places_warn(c, j.error, &j.places);
    return 0;
}

/* rasp modes list FILE: the strongest modes of a mode table, or of what a recipe or scene has, one a line.

   Strength is energy summed over the places, sum gain^2/(4 decay) (as where a render keeps the strongest); shown are
   the mode's pole and gain where its gain is largest. */

struct line {
    double energy, frequency, decay, gain, x, y;
};

struct list {
    struct cmd_call *c;
    struct line *line;
    int n, places, quantity;
    bool moves;           /* places mean something */
    const char *relative; /* no unit: how a table's gains are normalised */
};

static void start(struct list *l, int n, int quantity)
{
    l->n = n;
    l->quantity = quantity;
    l->line = ARENA_TAKE(l->c->arena, struct line, n);
    for (int i = 0; i < n; i++)
        l->line[i].gain = -1.0;
}

static void count(struct line *at, const struct line *one)
{
    double energy = at->energy + (one->gain != 0.0 ? one->gain * one->gain / (4.0 * one->decay) : 0.0);
    if (one->gain > at->gain) *at = *one;
    at->energy = energy;
}

static bool from_table(struct list *l, const char *file, struct err *e)
{
    struct mode_table t;
    if (!mode_table_read(file, l->c->arena, &t, e)) return false;
    start(l, (int)t.modes, t.quantity);
    l->places = (int)t.places;
    l->moves = t.places > 1;
    const char *normalisation = csv_comment(&t.csv, "normalisation");
    l->relative = normalisation && !strncmp(normalisation, "relative", 8) ? normalisation : NULL;
    for (size_t k = 0; k < t.first[t.places]; k++) {
        const struct mode_entry *v = &t.entry[k];
        for (int i = 0; i < v->n; i++) /* a mode of several slopes counts with each */
            count(&l->line[v->mode], &(struct line){0, v->frequency, v->slope[i].decay, fabs(v->slope[i].gain),
                                                    t.xy[2 * v->place], t.xy[2 * v->place + 1]});
    }
    if (t.note) message_remark(l->c, "modes", t.note);
    return true;
}

/* At one place and share of the way. */
static void count_modes(struct list *l, const struct modes *m, const struct modes_where *where)
{
    struct modes_point p = modes_point_make(l->c->arena, m->n);
    modes_at(m, where, &p);
    for (int i = 0; i < m->n; i++)
        count(&l->line[i],
              &(struct line){0, m->shared ? m->frequency[i] : p.frequency[i], m->shared ? m->decay[i] : p.decay[i],
                             sqrt(p.re[i] * p.re[i] + p.im[i] * p.im[i]), where->x, where->y});
}

static bool gather(struct list *l, struct err *e)
{
    const char *file = l->c->args.operands[0];
    struct body b;
    if (text_ends(file, ".csv")) return from_table(l, file, e);
    if (!body_read(l->c, file, &b, e)) return false;
    if (b.response->object.given) {
        struct object o;
        struct modes m;
        struct modes_places places;
        const double *origin = b.response->object.origin;
        const char *note;
        if (!body_object(l->c, &b, &o, &note, e) || !body_places(l->c, &b, &o, NULL, &places, e)) return false;
        if (note) message_remark(l->c, "modes", note);
        object_modes(&o, origin, NULL, o.n, l->c->arena, &m);
        start(l, m.n, m.quantity);
        l->places = places.n;
        l->moves = places.n > 1;
        for (int i = 0; i < places.n; i++)
            count_modes(l, &m,
                        &(struct modes_where){.x = places.xy[i][0] + origin[0], .y = places.xy[i][1] + origin[1]});
        return true;
    }
    if (b.response->space.given) {
        struct modes m;
        struct modes_ask ask = {.strongest = b.response->modes,
                                .band = {b.response->band[0], b.response->band[1]},
                                .rate = b.scene.output.sample_rate};
        if (!space_modes(&b.response->space, &ask, l->c->arena, &m, e)) return false;
        start(l, m.n, m.quantity);
        l->places = 1;
        count_modes(l, &m, &(struct modes_where){0});
        return true;
    }
    if (b.response->file && text_ends(b.response->file, ".csv")) return from_table(l, b.response->file, e);
    return err_set(e, ERR_SCENE,
                   b.response->file ? "%s: %s.response is recorded (%s), and has no modes"
                                    : "%s: its %s has no response%s",
                   file, b.key, b.response->file ? b.response->file : "");
}

static int strongest_first(const void *a, const void *b)
{
    const struct line *p = a, *q = b;
    if (p->energy != q->energy) return p->energy > q->energy ? -1 : 1;
    return (p->frequency > q->frequency) - (p->frequency < q->frequency);
}

int modes_object_list_run(struct cmd_call *c, struct err *e)
{
    static const long counts[2] = {1, 100000};
    struct list l = {.c = c};
    long shown = 20;
    if (!args_whole(&c->args, "modes", counts, &shown, e) || !gather(&l, e)) return (int)e->kind;
    qsort(l.line, (size_t)l.n, sizeof *l.line, strongest_first);
    printf("%d mode%s at %d place%s", l.n, l.n == 1 ? "" : "s", l.places, l.places == 1 ? "" : "s");
    if (shown < l.n) printf("; the %ld strongest", shown);
    printf("\n%14s %12s %14s%s\n", "frequency_hz", "t60_s", "largest_gain",
           l.moves ? "          x_m          y_m" : "");
    for (int i = 0; i < l.n && i < shown; i++) {
        const struct line *v = &l.line[i];
        printf("%14.6g %12.4g %14.5g", v->frequency, 3.0 * real_log(10.0) / v->decay, v->gain);
        if (l.moves) printf(" %12.6g %12.6g", v->x, v->y);
        putchar('\n');
    }
    if (l.relative)
        printf("gains of %s, %s\n", modes_quantity_name(l.quantity), l.relative);
    else
        printf("gains in %s/(N s)\n", modes_quantity_unit(l.quantity));
    return 0;
}

