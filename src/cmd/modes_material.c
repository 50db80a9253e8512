/* rasp modes material OBJECT STRIKE... -o FILE.yaml: what objects are made of, from the modes of their recordings
   (analysis/material_fit.h; papers/003 section C).

   An operand that is a mesh, or a shape as of --shape, begins an object; those behind it, until the next, are its
   strikes: mode tables of `rasp modes extract`, each FILE.csv or FILE.csv@X,Y, the place that was struck. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/outfile.h"
#include "base/text.h"
#include "cmd/modes_material.h"
#include "fem/shapes.h"
#include "fem/topology.h"
#include "num/noise.h"
#include "num/real.h"
#include "output/mark.h"
#include "scene/units.h"

enum { OBJECTS = 32, STRIKES = 200, PLACES = 1000, FEW = 4000 }; /* FEW: elements, of order 4 some 150 000 freedoms */

static const double unlike = 0.5; /* of the metrics of papers/003 */

/* ------------------------------------------------------------------ operands */

static bool is_shape(const char *text)
{
    size_t n = strspn(text, "abcdefghijklmnopqrstuvwxyz");
    return n > 0 && text[n] == ':';
}

/* STRIKE@X,Y; a file of the whole name goes first. */
static bool read_strike(struct modes_material *j, const char *text, int object, struct err *e)
{
    struct modes_material_strike *s = &j->strike[j->strikes];
    struct units_fault fault = {NULL, NULL};
    char *name = arena_text(j->c->arena, text), *at = strrchr(name, '@'), *comma = at ? strchr(at, ',') : NULL;
    *s = (struct modes_material_strike){.shown = text, .file = name, .strength = NAN, .spread = NAN};
    if (j->strikes == STRIKES) return err_set(e, ERR_USAGE, "more than %d strikes", STRIKES);
    if (comma) {
        *at = *comma = '\0';
        s->placed = true;
        for (int k = 0; k < 2; k++)
            if (!units_read(k ? comma + 1 : at + 1, KEY_LENGTH, k ? &s->y : &s->x, j->c->arena, &fault))
                return err_set(e, ERR_USAGE, "%s: the place behind @ is X,Y, each a length: '%s' %s", text,
                               k ? comma + 1 : at + 1, fault.text);
    }
    if (!text_ends_in(name, ".csv"))
        return err_set(e, ERR_USAGE,
                       "%s: a strike is a mode table (.csv), as rasp modes extract RECORDING -o FILE.csv writes it",
                       name);
    if (!mode_table_read(name, j->c->arena, &s->table, e) || !hash_file(name, s->hash, e)) return false;
    for (int i = 0; i < j->strikes; i++)
        if (!strcmp(j->strike[i].hash, s->hash))
            return err_set(e, ERR_USAGE, "%s: the same table as %s; a strike that counts twice looks surer than it is",
                           text, j->strike[i].shown);
    if (!s->table.shared)
        return err_set(e, ERR_SCENE, "%s: its poles differ from place to place; those of an object are one set", name);
    if (s->placed && s->table.places > 1)
        return err_set(e, ERR_USAGE, "%s: the table has %zu places of its own; leave @X,Y out", name, s->table.places);
    j->set[j->strikes++].object = object;
    return true;
}

static bool read_operands(struct modes_material *j, struct err *e)
{
    const struct args *g = &j->c->args;
    j->thing = ARENA_TAKE(j->c->arena, struct modes_material_object, OBJECTS);
    j->strike = ARENA_TAKE(j->c->arena, struct modes_material_strike, STRIKES + 1);
    j->set = ARENA_TAKE(j->c->arena, struct material_set, STRIKES + 1);
    for (int i = 0; i < g->n_operands; i++) {
        const char *text = g->operands[i];
        bool object =
            is_shape(text) || text_ends_in(text, ".msh") || text_ends_in(text, ".node") || text_ends_in(text, ".ele");
        if (object && j->n == OBJECTS) return err_set(e, ERR_USAGE, "more than %d objects", OBJECTS);
        if (object)
            j->thing[j->n++] = (struct modes_material_object){.text = text, .ear = -1, .mass = NAN};
        else if (!read_strike(j, text, j->n - 1, e))
            return false;
        if (object && j->n == 1 && j->strikes > 0)
            return err_set(e, ERR_USAGE, "%s stands before its object %s: an object comes first", j->strike[0].shown,
                           text);
        if (object && j->n > 1 && (j->strikes == 0 || j->set[j->strikes - 1].object != j->n - 2))
            return err_set(e, ERR_USAGE, "%s: no strike stands behind it", j->thing[j->n - 2].text);
    }
    if (j->n == 0) return true;
    return (j->strikes > 0 && j->set[j->strikes - 1].object == j->n - 1) ||
           err_set(e, ERR_USAGE, "%s: no strike stands behind it; give mode tables of rasp modes extract",
                   j->thing[j->n - 1].text);
}

/* ------------------------------------------------------------------ options */

static bool word_of_material(const char *text)
{
    static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_0123456789";
    return *text && !(*text >= '0' && *text <= '9') && !text[strspn(text, letters)];
}

static bool share(const struct modes_material *j, const char *name, double *x, struct err *e)
{
    const char *text = args_value(&j->c->args, name);
    char *end;
    if (!text) return true;
    *x = strtod(text, &end);
    if (end != text && !strcmp(end, "%")) {
        *x /= 100.0;
        end++;
    }
    return (end != text && !*end && *x >= 0.0 && *x <= 0.5) ||
           err_set(e, ERR_USAGE, "--%s: '%s' is not a share from 0 to 0.5, such as 0.01 or 1%%", name, text);
}

static bool read_range(struct modes_material *j, struct err *e)
{
    const char *text = args_value(&j->c->args, "gamma");
    char *end = NULL;
    j->range[0] = 1e5; /* m^2/s^2: soft rubber ... */
    j->range[1] = 5e8; /* diamond */
    if (!text) return true;
    j->range[0] = strtod(text, &end);
    j->range[1] = *end == ',' ? strtod(end + 1, &end) : NAN;
    return (!*end && j->range[0] > 0.0 && j->range[1] >= 1.2 * j->range[0] && j->range[1] <= 1e12) ||
           err_set(e, ERR_USAGE,
                   "--gamma: '%s' is not LOW,HIGH in m^2/s^2, such as 1e6,1e8, HIGH a fifth above LOW at least", text);
}

static bool read_masses(struct modes_material *j, struct err *e)
{
    int n;
    const char **text = args_values(&j->c->args, "mass", &n);
    struct units_fault fault = {NULL, NULL};
    j->density = NAN;
    if (n > 0 && args_given(&j->c->args, "density"))
        return err_set(e, ERR_USAGE, "--mass and --density exclude each other");
    if (n != 0 && n != j->n)
        return err_set(e, ERR_USAGE, "--mass is given %d times for %d object%s: once for each, in their order", n, j->n,
                       j->n == 1 ? "" : "s");
    for (int i = 0; i < n; i++)
        if (!units_read(text[i], KEY_MASS, &j->thing[i].mass, j->c->arena, &fault) || !(j->thing[i].mass > 0.0))
            return err_set(e, ERR_USAGE, "--mass: '%s' %s", text[i], fault.text ? fault.text : "is not above 0");
    return cmd_quantity(j->c, "density", KEY_DENSITY, &j->density, e) &&
           (isnan(j->density) || (j->density >= 1.0 && j->density <= 1e5) ||
            err_set(e, ERR_USAGE, "--density: %g kg/m^3 is not from 1 to 100000", j->density));
}

static bool read_options(struct modes_material *j, struct err *e)
{
    static const long counts[2] = {6, 1000};
    static const double ratios[2] = {0.0, 0.45};
    const struct args *g = &j->c->args;
    j->file = args_value(g, "output");
    if (!j->file) return err_set(e, ERR_USAGE, "-o FILE.yaml is needed: the material to write");
    if (!text_ends_in(j->file, ".yaml") && !text_ends_in(j->file, ".yml"))
        return err_set(e, ERR_USAGE, "-o %s: a material is YAML: write for instance -o my_glass.yaml", j->file);
    j->name = args_value(g, "name");
    if (!j->name) {
        const char *slash = strrchr(j->file, '/'), *from = slash ? slash + 1 : j->file;
        char *stem = arena_text(j->c->arena, from);
        stem[strcspn(stem, ".")] = '\0';
        for (char *p = stem; *p; p++)
            *p = *p == '-' || *p == ' ' ? '_' : *p;
        j->name = stem;
    }
    const char *from = args_given(g, "name") ? "--name" : "-o names the material, too, without --name";
    if (!word_of_material(j->name))
        return err_set(e, ERR_USAGE, "%s: '%s' is not a name of letters, digits and _ that begins with a letter", from,
                       j->name);
    for (const struct material *m = material_table; m->name; m++)
        if (!strcmp(m->name, j->name) || !strcmp(j->name, "custom"))
            return err_set(e, ERR_USAGE, "%s: rasp has a material '%s'; give another name", from, j->name);
    j->poisson = NAN;
    j->model_error = 1e-3;
    if (!read_range(j, e) || !args_number(g, "poisson", ratios, &j->poisson, e) ||
        !args_whole(g, "modes", counts, &j->modes, e) || !share(j, "model-error", &j->model_error, e) ||
        !share(j, "size-error", &j->size_error, e))
        return false;
    static const char *const methods[] = {"scan", "paper", NULL}, *const polishes[] = {"perceptual", NULL};
    static const long some[2] = {1, 1000};
    int method = 0, polish;
    j->starts = 10;
    j->polish = args_given(g, "polish");
    if (!args_word(g, "method", methods, &method, e) || !args_word(g, "polish", polishes, &polish, e) ||
        !args_whole(g, "starts", some, &j->starts, e))
        return false;
    j->paper = method == 1;
    if (j->paper && j->polish) return err_set(e, ERR_USAGE, "--polish is for --method scan");
    if (!j->paper && args_given(g, "starts")) return err_set(e, ERR_USAGE, "--starts is for --method paper");
    if (j->paper && !args_given(g, "gamma")) {
        j->range[0] = 1e6;
        j->range[1] = 1e8;
    }
    return j->model_error > 0.0 || err_set(e, ERR_USAGE, "--model-error must be above 0");
}

/* A wood: one modulus is fitted, the others keep their ratios to it. */
static bool read_wood(struct modes_material *j, struct err *e)
{
    struct compute k = {.c = j->c};
    if (!args_given(&j->c->args, "material")) return true;
    if (!modes_compute_solid_named(&k, e)) return false;
    j->wood = k.material.named;
    if (!(j->wood->radial.youngs_modulus > 0.0))
        return err_set(e, ERR_USAGE,
                       "--material %s: what is isotropic is fitted whole; this option is for woods, whose moduli keep "
                       "their ratios (basswood, poplar, oak)",
                       j->wood->name);
    if (!isnan(j->poisson)) return err_set(e, ERR_USAGE, "--poisson: %s has six of them; leave it out", j->wood->name);
    return modes_compute_solid_wooden(j->wood, j->wood->youngs_modulus, j->wood->density, &j->elastic, e);
}

/* ------------------------------------------------------------------ objects */

static bool read_object(struct modes_material *j, struct modes_material_object *t, struct err *e)
{
    struct compute *k = &t->solid;
    bool shape = is_shape(t->text);
    k->c = j->c;
    if (!modes_compute_solid_mesh(k, shape ? NULL : t->text, shape ? t->text : NULL, e) ||
        !modes_compute_solid_fixed(k, e))
        return false;
    k->order = shape ? shapes_order(t->text) : k->mesh.elements > FEW ? 3 : 4;
    static const long orders[2] = {SOLID_LATTICE_LEAST, SOLID_LATTICE_MOST};
    return args_whole(&j->c->args, "order", orders, &k->order, e);
}

static bool point_at(const struct boundary_map *map, const struct modes_material_object *t, double x, double y,
                     const double origin[2], struct boundary_point *p, struct err *e)
{
    return boundary_map_point(map, x - origin[0], y - origin[1], p) ||
           err_set(e, ERR_SCENE, "the place (%.6g, %.6g) m does not lie on %s", x, y, t->text);
}

/* Places that were struck, as far as they are known: of a table of one place that lies at (0, 0) it is not, unless @X,Y
   says so. */
static bool read_places(struct modes_material *j, struct err *e)
{
    int face = BOUNDARY_TOP;
    double origin[2] = {0, 0}, listen[2];
    if (!args_word(&j->c->args, "face", boundary_map_sides, &face, e) ||
        !modes_lengths(j->c, "origin", "X,Y", 2, origin, e) || !modes_lengths(j->c, "listen", "X,Y", 2, listen, e))
        return false;
    for (int o = 0; o < j->n; o++) {
        struct modes_material_object *t = &j->thing[o];
        struct boundary_map map;
        boundary_map_make(&t->solid.mesh, &t->solid.boundary, face, &map);
        t->point = ARENA_TAKE(j->c->arena, struct boundary_point, PLACES + 1);
        for (int i = 0; i < j->strikes; i++) {
            struct modes_material_strike *s = &j->strike[i];
            const double *xy = s->table.xy;
            if (j->set[i].object != o) continue;
            s->first = t->points;
            s->places = s->placed ? 1 : (int)s->table.places;
            if (!s->placed && s->table.places == 1 && xy[0] == 0.0 && xy[1] == 0.0) s->places = 0;
            if (t->points + s->places > PLACES) return err_set(e, ERR_SCENE, "more than %d places", PLACES);
            for (int k = 0; k < s->places; k++)
                if (!point_at(&map, t, s->placed ? s->x : xy[2 * k], s->placed ? s->y : xy[2 * k + 1], origin,
                              &t->point[t->points++], e))
                    return err_at(e, "%s", s->file), false;
        }
        if (args_given(&j->c->args, "listen")) {
            t->ear = t->points;
            if (!point_at(&map, t, listen[0], listen[1], origin, &t->point[t->points++], e)) return false;
        }
    }
    return true;
}

/* More than the strikes show: not all modes are struck, and those above the highest may be its neighbours. */
static long modes_needed(const struct modes_material *j, int o)
{
    long most = 0;
    for (int i = 0; i < j->strikes; i++)
        if (j->set[i].object == o && (long)j->strike[i].table.modes > most) most = (long)j->strike[i].table.modes;
    return j->modes ? j->modes : 20 + most + most / 2;
}

static bool compute_family(struct modes_material *j, int o, struct err *e)
{
    struct modes_material_object *t = &j->thing[o];
    struct compute coarse = {.c = j->c};
    struct solid_family_ask ask = {.mesh = &t->solid.mesh,
                                   .boundary = &t->solid.boundary,
                                   .fixed = t->solid.fixed,
                                   .n_fixed = t->solid.n_fixed,
                                   .order = (int)t->solid.order,
                                   .most = (int)modes_needed(j, o),
                                   .point = t->point,
                                   .points = t->points};
    if (j->wood) {
        ask.material = &j->elastic;
        ask.youngs_modulus = j->wood->youngs_modulus;
    }
    if (is_shape(t->text)) {
        if (!modes_compute_solid_coarser(&t->solid, t->text, &coarse, e)) return false;
        ask.coarse = &coarse.mesh;
        ask.coarse_boundary = &coarse.boundary;
        ask.coarse_fixed = coarse.fixed;
        ask.coarse_order = (int)t->solid.order;
    } else if (t->solid.order > SOLID_LATTICE_LEAST) {
        ask.coarse = ask.mesh;
        ask.coarse_boundary = ask.boundary;
        ask.coarse_fixed = ask.fixed;
        ask.coarse_order = (int)t->solid.order - 1;
    }
    return solid_family_make(&ask, j->c->arena, &j->family[o], e);
}

static bool find_density(struct modes_material *j, struct err *e)
{
    double mass = 0.0, volume = 0.0, least = INFINITY, most = 0.0;
    for (int o = 0; o < j->n; o++) {
        double own = j->thing[o].mass / j->thing[o].solid.boundary.volume;
        mass += j->thing[o].mass;
        volume += j->thing[o].solid.boundary.volume;
        least = fmin(least, own);
        most = fmax(most, own);
    }
    if (isnan(mass)) return true;
    if (most > 1.2 * least)
        return err_set(e, ERR_USAGE,
                       "--mass: with these masses the objects have densities from %.4g to %.4g kg/m^3, and they are of "
                       "one material: do masses and sizes stand in the order of the objects?",
                       least, most);
    j->density = mass / volume;
    return (j->density >= 1.0 && j->density <= 1e5) ||
           err_set(e, ERR_USAGE,
                   "--mass: %g kg in %.4g m^3 is %.4g kg/m^3, not from 1 to 100000: are mass and sizes right?", mass,
                   volume, j->density);
}

/* ------------------------------------------------------------------ metrics and the search of papers/003 */

/* The node whose Poisson's ratio is nearest. */
static int nearest_node(const struct solid_family *f, double nu)
{
    int best = 0;
    for (int i = 1; i < f->nodes; i++)
        best = fabs(f->nu[i] - nu) < fabs(f->nu[best] - nu) ? i : best;
    return best;
}

/* The first strike whose place is known, as a reference; NULL: there is none. Without --listen a vibration is heard
   where it is struck, and of a pressure all modes alike. */
static struct material_search *open_metric(const struct modes_material *j, double nu)
{
    struct arena *a = j->c->arena;
    int i = 0;
    while (i < j->strikes && j->strike[i].places == 0)
        i++;
    if (i == j->strikes) return NULL;
    const struct modes_material_strike *s = &j->strike[i];
    const struct mode_table *table = &s->table;
    const struct modes_material_object *t = &j->thing[j->set[i].object];
    const struct solid_family *f = &j->family[j->set[i].object];
    int node = nearest_node(f, nu), room = 0;
    const double *phi = f->phi + (size_t)node * t->points * f->n;
    for (size_t k = table->first[0]; k < table->first[1]; k++)
        room += table->entry[k].n;
    struct feature *feature = ARENA_TAKE(a, struct feature, room);
    double *gain = ARENA_TAKE(a, double, room), *phase = ARENA_TAKE(a, double, room);
    struct material_voice v = {.family = f,
                               .nu = nu,
                               .in = phi + (size_t)s->first * f->n,
                               .power = table->quantity - MODES_VELOCITY,
                               .feature = feature,
                               .gain = gain,
                               .phase = phase};
    if (t->ear >= 0)
        v.out = phi + (size_t)t->ear * f->n;
    else if (table->quantity != MODES_ACCELERATION)
        v.out = v.in;
    for (size_t k = table->first[0]; k < table->first[1]; k++)
        for (int m = 0; m < table->entry[k].n; m++) {
            const struct mode_slope *one = &table->entry[k].slope[m];
            if (!(one->decay > 0.0)) continue;
            feature[v.n] =
                (struct feature){table->entry[k].frequency, one->decay, one->gain * one->gain / (4.0 * one->decay)};
            gain[v.n] = one->gain;
            phase[v.n++] = one->phase;
        }
    return material_metric_open(&v, a);
}

/* Both metrics of the result, after --polish perceptual of a result that it moves. */
static bool measure(struct modes_material *j, struct err *e)
{
    struct material_search *s = open_metric(j, j->fit.nu.value);
    double damping[3], x[MATERIAL_UNKNOWNS];
    j->metric = (struct material_metric){NAN, NAN};
    if (!s)
        return !j->polish ||
               err_set(e, ERR_USAGE, "--polish: no strike says which place was struck: write FILE.csv@X,Y");
    material_damping_terms(j->fit.damping, j->fit.best, damping);
    x[MATERIAL_GAMMA] = real_log(j->fit.gamma.value);
    x[MATERIAL_ALPHA_OF] = real_log(fmax(damping[0], 1e-30));
    x[MATERIAL_BETA_OF] = real_log(fmax(damping[1], 1e-30));
    x[MATERIAL_SIGMA] = material_metric_strength(s, x, damping[2]);
    if (j->polish) {
        const double step[MATERIAL_UNKNOWNS] = {0.002, 0.1, 0.1, 0.1};
        struct material_damping *d = &j->fit.damping[j->fit.best];
        j->fit.nu.low = j->fit.nu.high = NAN;
        j->evaluations = material_metric_descend(s, x, step, damping[2]);
        j->fit.gamma = (struct material_figure){real_exp(x[MATERIAL_GAMMA]), NAN, NAN};
        for (int k = 0; k < d->n; k++)
            d->figure[k].low = d->figure[k].high = NAN;
        for (int k = 0; k < d->n; k++)
            for (int of = 0; of < 2; of++)
                if (!strcmp(d->parameter[k], of ? "beta" : "alpha"))
                    d->figure[k] =
                        (struct material_figure){real_exp(x[of ? MATERIAL_BETA_OF : MATERIAL_ALPHA_OF]), NAN, NAN};
    }
    j->metric = material_metric_at(s, x, damping[2]);
    material_metric_close(s);
    return true;
}

/* --method paper: Nelder and Mead on the metrics, at the Poisson's ratio that is given, from starts that are drawn. */
static bool search(struct modes_material *j, struct err *e)
{
    struct material_fit *f = &j->fit;
    struct arena *a = j->c->arena;
    double nu = isnan(j->poisson) ? 0.3 : j->poisson;
    const double step[MATERIAL_UNKNOWNS] = {0.1, 0.5, 0.5, 0.5}, low[2] = {0.5, 1e-9}, high[2] = {50.0, 1e-6};
    const struct modes_material_ending *best = NULL;
    struct material_search *s = open_metric(j, nu);
    if (!s) return err_set(e, ERR_USAGE, "--method paper: no strike says which place was struck: write FILE.csv@X,Y");
    j->ending = ARENA_TAKE(a, struct modes_material_ending, j->starts);
    for (long k = 0; k < j->starts; k++) {
        struct noise noise = noise_make(0, "starts");
        struct modes_material_ending *end = &j->ending[k];
        for (int i = 0; i < 3; i++) {
            double from = i ? low[i - 1] : j->range[0], to = i ? high[i - 1] : j->range[1];
            end->x[i] = real_log(from) + real_log(to / from) * noise_uniform(noise, (uint64_t)k, (uint64_t)i);
        }
        end->x[MATERIAL_SIGMA] = material_metric_strength(s, end->x, 0.0);
        j->evaluations += material_metric_descend(s, end->x, step, 0.0);
        end->metric = material_metric_at(s, end->x, 0.0);
        if (!best || end->metric.image + end->metric.feature < best->metric.image + best->metric.feature) best = end;
    }
    material_metric_close(s);
    j->metric = best->metric;
    if (best->metric.image > unlike || best->metric.feature > unlike)
        f->warning = arena_format(a,
                                  "the best start's sound is unlike the strike's (metrics %.2g and %.2g, 0: alike): it "
                                  "has not landed; more --starts, a narrower --gamma, or --method scan",
                                  best->metric.image, best->metric.feature);
    f->gamma = (struct material_figure){real_exp(best->x[MATERIAL_GAMMA]), NAN, NAN};
    f->nu = (struct material_figure){nu, NAN, NAN};
    f->best = MATERIAL_RAYLEIGH;
    f->damping[MATERIAL_RAYLEIGH] = (struct material_damping){
        .name = "rayleigh",
        .n = 2,
        .parameter = {"alpha", "beta"},
        .unit = {"1/s", "s"},
        .figure = {{real_exp(best->x[MATERIAL_ALPHA_OF]), NAN, NAN}, {real_exp(best->x[MATERIAL_BETA_OF]), NAN, NAN}},
        .bic = NAN,
        .scatter = NAN};
    return true;
}

/* papers/003 eq. 8, a_j = sigma a_j^0, with a_j^0 of the shapes: by logarithms, over matched modes and places. Heard is
   the place of --listen, else that which is struck. */
static void strength(const struct modes_material *j, struct modes_material_strike *s, const struct material_set *set)
{
    const struct solid_family *f = &j->family[set->object];
    const struct modes_material_object *t = &j->thing[set->object];
    const struct mode_table *table = &s->table;
    double sum = 0.0, square = 0.0;
    int n = 0, node = nearest_node(f, j->fit.nu.value);
    for (int p = 0; p < s->places; p++) {
        const double *phi = f->phi + ((size_t)node * t->points + (size_t)(s->first + p)) * f->n,
                     *ear = t->ear >= 0 ? f->phi + ((size_t)node * t->points + (size_t)t->ear) * f->n : phi;
        for (size_t k = table->first[p]; k < table->first[p + 1]; k++) {
            const struct mode_entry *entry = &table->entry[k];
            int i = 0;
            while (i < set->n && set->frequency[i] != entry->frequency)
                i++;
            if (i == set->n || set->match[i] < 0 || entry->slope[0].gain == 0.0) continue;
            double w = 2.0 * REAL_PI * entry->frequency,
                   unit = fabs(phi[set->match[i]] * ear[set->match[i]]) / (isnan(j->density) ? 1.0 : j->density);
            unit *= table->quantity == MODES_DISPLACEMENT ? 1.0 / w : table->quantity == MODES_ACCELERATION ? w : 1.0;
            if (!(unit > 1e-6 * fabs(phi[set->match[i]]))) continue;
            double x = real_log(fabs(entry->slope[0].gain) / unit);
            sum += x;
            square += x * x;
            n++;
        }
    }
    if (n < 3) return;
    if (!isnan(j->density)) s->strength = real_exp(sum / n);
    s->spread = sqrt(fmax(square / n - sum / n * (sum / n), 0.0));
}

/* Strikes without an object: laws of damping, over the measured frequencies. The file is then one for surface.recipe,
   with the damping of an object. */
static int damping_only(struct modes_material *j, struct err *e)
{
    static const char *const others[] = {"density",  "mass",   "poisson", "gamma",
                                         "material", "method", "polish",  "size-error"};
    struct outfile o;
    int modes = 0;
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (args_given(&j->c->args, others[i]))
            return err_set(e, ERR_USAGE,
                           "--%s needs an object before the strikes: a mesh, or a shape such as "
                           "plate:length=20cm,width=15cm,thickness=4mm",
                           others[i]),
                   (int)e->kind;
    for (int i = 0; i < j->strikes; i++) {
        j->set[i] = material_set_make(&j->strike[i].table, 0, j->c->arena);
        if (j->set[i].n == 0)
            return err_set(e, ERR_SCENE, "%s: has no mode that decays", j->strike[i].file), (int)e->kind;
    }
    for (int i = 0; i < j->strikes; i++)
        modes += j->set[i].n;
    if (modes <= 2)
        return err_set(e, ERR_SCENE, "%d mode%s: a law of damping needs 3 or more", modes, modes == 1 ? "" : "s"),
               (int)e->kind;
    material_fit_damping(j->set, j->strikes, j->c->arena, &j->fit);
    if (!outfile_open(&o, j->file, e)) return (int)e->kind;
    modes_material_write_damping(o.stream, j);
    if (!outfile_commit(&o, e)) return (int)e->kind;
    if (args_given(&j->c->args, "quiet")) return 0;
    return modes_material_write_damping_report(j, e) ? 0 : (int)e->kind;
}

int modes_material_run(struct cmd_call *c, struct err *e)
{
    struct modes_material j = {.c = c};
    struct outfile o;
    if (!read_options(&j, e) || !mark_absent(j.file, args_given(&c->args, "force"), e) ||
        !modes_output_possible(j.file, e) || !read_operands(&j, e) || !read_masses(&j, e) || !read_wood(&j, e))
        return (int)e->kind;
    for (int i = 0; i < j.strikes; i++)
        if (!modes_output_spares(j.file, j.strike[i].file, e)) return (int)e->kind;
    for (int i = 0; i < j.n; i++)
        if (!read_object(&j, &j.thing[i], e)) return (int)e->kind;
    if (j.n == 0) return damping_only(&j, e);
    if (!find_density(&j, e) || !read_places(&j, e)) return (int)e->kind;
    j.family = ARENA_TAKE(c->arena, struct solid_family, j.n);
    for (int i = 0; i < j.n; i++)
        if (!compute_family(&j, i, e)) return (int)e->kind;
    for (int i = 0; i < j.strikes; i++) {
        const struct modes_material_strike *one = &j.strike[i];
        const struct modes_material_object *t = &j.thing[j.set[i].object];
        j.set[i] = material_set_make(&one->table, j.set[i].object, c->arena);
        if (j.set[i].n == 0)
            return err_set(e, ERR_SCENE, "%s: has no mode that decays", j.strike[i].file), (int)e->kind;
        j.set[i].visible =
            material_set_visible(&j.family[j.set[i].object], t->points, one->first, one->places, t->ear, c->arena);
    }
    struct material_problem p = {.object = j.family,
                                 .sets = j.strikes,
                                 .set = j.set,
                                 .gamma = {j.range[0], j.range[1]},
                                 .poisson = j.poisson,
                                 .model_error = j.model_error,
                                 .size_error = j.size_error};
    if (!(j.paper ? search(&j, e) : material_fit(&p, c->arena, &j.fit, e) && measure(&j, e))) return (int)e->kind;
    for (int i = 0; i < j.strikes; i++)
        if (!j.paper) strength(&j, &j.strike[i], &j.set[i]);
    if (!outfile_open(&o, j.file, e)) return (int)e->kind;
    modes_material_write(o.stream, &j);
    if (!outfile_commit(&o, e)) return (int)e->kind;
    return args_given(&c->args, "quiet") || modes_material_write_report(&j, e) ? 0 : (int)e->kind;
}
