/* rasp modes material OBJECT STRIKE... -o FILE.yaml: what objects are made of, from the modes of their recordings
   (analysis/material_fit.h; papers/003 section C).

   An operand that is a mesh, or a shape as of --shape, begins an object; those behind it, until the next, are its
   strikes: mode tables of `rasp modes extract`, each FILE.csv or FILE.csv@X,Y, the place that was struck. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "analysis/material_metric.h"
#include "analysis/material_set.h"
#include "base/outfile.h"
#include "base/text.h"
#include "cmd/message.h"
#include "cmd/modes_compute.h"
#include "cmd/report.h"
#include "fem/shapes.h"
#include "fem/topology.h"
#include "num/noise.h"
#include "num/real.h"
#include "output/mark.h"
#include "response/mode_table.h"
#include "scene/units.h"

enum { OBJECTS = 32, STRIKES = 200, PLACES = 1000 };

struct strike {
    const char *file, *shown;
    char hash[HASH_TEXT];
    struct mode_table table;
    bool placed;
    double x, y;             /* m, behind @ */
    int first, places;       /* of the object's points; places 0: not known where it was struck */
    double strength, spread; /* sigma of papers/003 eq. 8 and rms of log(gain/(sigma a)); NAN: not known */
};

struct thing { /* an object */
    const char *text;
    struct compute solid;
    struct boundary_point *point; /* [points] struck places, then the place that is heard */
    int points, ear;              /* ear -1: not given */
    double mass;                  /* kg; NAN: not weighed */
};

struct job {
    struct cmd_call *c;
    int n, strikes;
    struct thing *thing;         /* [n] */
    struct strike *strike;       /* [strikes] */
    struct material_set *set;    /* [strikes] */
    struct solid_family *family; /* [n] */
    double density;              /* kg/m^3; NAN: not known */
    const char *name, *file;
    const struct material *wood; /* a material that keeps its moduli's ratios; NULL: isotropic */
    struct elastic elastic;      /* of that */
    double range[2], poisson, model_error, size_error;
    long modes;
    struct material_fit fit;
    bool paper, polish; /* --method paper, --polish perceptual */
    long starts;
    struct ending {
        double x[MATERIAL_UNKNOWNS];
        struct material_metric metric;
    } * ending;                    /* [starts] of --method paper */
    struct material_metric metric; /* of the result; NAN: where was it struck? */
    int evaluations;
};

/* ------------------------------------------------------------------ operands */

static bool is_shape(const char *text)
{
    size_t n = strspn(text, "abcdefghijklmnopqrstuvwxyz");
    return n > 0 && text[n] == ':';
}

/* STRIKE@X,Y; a file of the whole name goes first. */
static bool read_strike(struct job *j, const char *text, int object, struct err *e)
{
    struct strike *s = &j->strike[j->strikes];
    struct units_fault fault = {NULL, NULL};
    char *name = arena_text(j->c->arena, text), *at = strrchr(name, '@'), *comma = at ? strchr(at, ',') : NULL;
    *s = (struct strike){.shown = text, .file = name, .strength = NAN};
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
    if (!s->table.shared)
        return err_set(e, ERR_SCENE, "%s: its poles differ from place to place; those of an object are one set", name);
    if (s->placed && s->table.places > 1)
        return err_set(e, ERR_USAGE, "%s: the table has %zu places of its own; leave @X,Y out", name, s->table.places);
    j->set[j->strikes++].object = object;
    return true;
}

static bool read_operands(struct job *j, struct err *e)
{
    const struct args *g = &j->c->args;
    j->thing = ARENA_TAKE(j->c->arena, struct thing, OBJECTS);
    j->strike = ARENA_TAKE(j->c->arena, struct strike, STRIKES + 1);
    j->set = ARENA_TAKE(j->c->arena, struct material_set, STRIKES + 1);
    for (int i = 0; i < g->n_operands; i++) {
        const char *text = g->operands[i];
        bool object =
            is_shape(text) || text_ends_in(text, ".msh") || text_ends_in(text, ".node") || text_ends_in(text, ".ele");
        if (object && j->n == OBJECTS) return err_set(e, ERR_USAGE, "more than %d objects", OBJECTS);
        if (object)
            j->thing[j->n++] = (struct thing){.text = text, .ear = -1, .mass = NAN};
        else if (j->n == 0)
            return err_set(e, ERR_USAGE,
                           "%s: the object comes first: a mesh (.msh, .node) or a shape, such as "
                           "plate:length=20cm,width=15cm,thickness=4mm",
                           text);
        else if (!read_strike(j, text, j->n - 1, e))
            return false;
        if (object && j->n > 1 && (j->strikes == 0 || j->set[j->strikes - 1].object != j->n - 2))
            return err_set(e, ERR_USAGE, "%s: no strike stands behind it", j->thing[j->n - 2].text);
    }
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

static bool share(const struct job *j, const char *name, double *x, struct err *e)
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

static bool read_range(struct job *j, struct err *e)
{
    const char *text = args_value(&j->c->args, "gamma");
    char *end = NULL;
    j->range[0] = 1e5; /* m^2/s^2: soft rubber ... */
    j->range[1] = 5e8; /* diamond */
    if (!text) return true;
    j->range[0] = strtod(text, &end);
    if (*end == ',') j->range[1] = strtod(end + 1, &end);
    return (!*end && j->range[0] > 0.0 && j->range[1] >= 1.2 * j->range[0] && j->range[1] <= 1e12) ||
           err_set(e, ERR_USAGE,
                   "--gamma: '%s' is not LOW,HIGH in m^2/s^2, such as 1e6,1e8, HIGH a fifth above LOW at least", text);
}

static bool read_masses(struct job *j, struct err *e)
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

static bool read_options(struct job *j, struct err *e)
{
    static const long counts[2] = {6, 1000};
    static const double ratios[2] = {0.0, 0.45};
    const struct args *g = &j->c->args;
    j->file = args_value(g, "output");
    if (!j->file) return err_set(e, ERR_USAGE, "-o FILE.yaml is needed: the material to write");
    j->name = args_value(g, "name");
    if (!j->name) {
        const char *slash = strrchr(j->file, '/'), *from = slash ? slash + 1 : j->file;
        char *stem = arena_text(j->c->arena, from);
        stem[strcspn(stem, ".")] = '\0';
        for (char *p = stem; *p; p++)
            *p = *p == '-' || *p == ' ' ? '_' : *p;
        j->name = stem;
    }
    if (!word_of_material(j->name))
        return err_set(e, ERR_USAGE, "--name: '%s' is not a name of letters, digits and _ that begins with a letter",
                       j->name);
    for (const struct material *m = material_table; m->name; m++)
        if (!strcmp(m->name, j->name) || !strcmp(j->name, "custom"))
            return err_set(e, ERR_USAGE, "--name: rasp has a material '%s'; give another name", j->name);
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
static bool read_wood(struct job *j, struct err *e)
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

static bool read_object(struct job *j, struct thing *t, struct err *e)
{
    struct compute *k = &t->solid;
    bool shape = is_shape(t->text);
    k->c = j->c;
    if (!modes_compute_solid_mesh(k, shape ? NULL : t->text, shape ? t->text : NULL, e) ||
        !modes_compute_solid_fixed(k, e))
        return false;
    k->order = shape ? shapes_order(t->text) : 3;
    static const long orders[2] = {SOLID_LATTICE_LEAST, SOLID_LATTICE_MOST};
    return args_whole(&j->c->args, "order", orders, &k->order, e);
}

static bool point_at(const struct boundary_map *map, const struct job *j, const struct thing *t, double x, double y,
                     const double origin[2], struct boundary_point *p, struct err *e)
{
    (void)j;
    return boundary_map_point(map, x - origin[0], y - origin[1], p) ||
           err_set(e, ERR_SCENE, "the place (%.6g, %.6g) m does not lie on %s", x, y, t->text);
}

/* Places that were struck, as far as they are known: of a table of one place that lies at (0, 0) it is not, unless @X,Y
   says so. */
static bool read_places(struct job *j, struct err *e)
{
    int face = BOUNDARY_TOP;
    double origin[2] = {0, 0}, listen[2];
    if (!args_word(&j->c->args, "face", boundary_map_sides, &face, e) ||
        !modes_lengths(j->c, "origin", "X,Y", 2, origin, e) || !modes_lengths(j->c, "listen", "X,Y", 2, listen, e))
        return false;
    for (int o = 0; o < j->n; o++) {
        struct thing *t = &j->thing[o];
        struct boundary_map map;
        boundary_map_make(&t->solid.mesh, &t->solid.boundary, face, &map);
        t->point = ARENA_TAKE(j->c->arena, struct boundary_point, PLACES + 1);
        for (int i = 0; i < j->strikes; i++) {
            struct strike *s = &j->strike[i];
            const double *xy = s->table.xy;
            if (j->set[i].object != o) continue;
            s->first = t->points;
            s->places = s->placed ? 1 : (int)s->table.places;
            if (!s->placed && s->table.places == 1 && xy[0] == 0.0 && xy[1] == 0.0) s->places = 0;
            if (t->points + s->places > PLACES) return err_set(e, ERR_SCENE, "more than %d places", PLACES);
            for (int k = 0; k < s->places; k++)
                if (!point_at(&map, j, t, s->placed ? s->x : xy[2 * k], s->placed ? s->y : xy[2 * k + 1], origin,
                              &t->point[t->points++], e))
                    return err_at(e, s->file), false;
        }
        if (args_given(&j->c->args, "listen")) {
            t->ear = t->points;
            if (!point_at(&map, j, t, listen[0], listen[1], origin, &t->point[t->points++], e)) return false;
        }
    }
    return true;
}

/* More than the strikes show: not all modes are struck, and those above the highest may be its neighbours. */
static long modes_needed(const struct job *j, int o)
{
    long most = 0;
    for (int i = 0; i < j->strikes; i++)
        if (j->set[i].object == o && (long)j->strike[i].table.modes > most) most = (long)j->strike[i].table.modes;
    return j->modes ? j->modes : 20 + most + most / 2;
}

static bool compute_family(struct job *j, int o, struct err *e)
{
    struct thing *t = &j->thing[o];
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

static void find_density(struct job *j)
{
    double mass = 0.0, volume = 0.0;
    for (int o = 0; o < j->n; o++) {
        mass += j->thing[o].mass;
        volume += j->thing[o].solid.boundary.volume;
    }
    if (!isnan(mass)) j->density = mass / volume;
}

/* ------------------------------------------------------------------ metrics and the search of papers/003 */

/* The first strike whose place is known, as a reference; NULL: there is none. Without --listen a vibration is heard
   where it is struck, and of a pressure all modes alike. */
static struct material_search *open_metric(const struct job *j, double nu)
{
    struct arena *a = j->c->arena;
    int i = 0;
    while (i < j->strikes && j->strike[i].places == 0)
        i++;
    if (i == j->strikes) return NULL;
    const struct strike *s = &j->strike[i];
    const struct mode_table *table = &s->table;
    const struct thing *t = &j->thing[j->set[i].object];
    const struct solid_family *f = &j->family[j->set[i].object];
    int node = f->nodes == 1 ? 0 : (int)rint(nu / (f->nu[1] - f->nu[0])), room = 0;
    node = node < 0 ? 0 : node > f->nodes - 1 ? f->nodes - 1 : node;
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
static bool measure(struct job *j, struct err *e)
{
    struct material_search *s = open_metric(j, j->fit.nu.value);
    double damping[3], x[MATERIAL_UNKNOWNS];
    j->metric = (struct material_metric){NAN, NAN};
    if (!s)
        return !j->polish ||
               err_set(e, ERR_USAGE, "--polish: no strike says which place was struck: write FILE.csv@X,Y");
    material_fit_rayleigh(&j->fit, j->fit.best, damping);
    x[MATERIAL_GAMMA] = real_log(j->fit.gamma.value);
    x[MATERIAL_ALPHA_OF] = real_log(fmax(damping[0], 1e-30));
    x[MATERIAL_BETA_OF] = real_log(fmax(damping[1], 1e-30));
    x[MATERIAL_SIGMA] = material_metric_strength(s, x, damping[2]);
    if (j->polish) {
        const double step[MATERIAL_UNKNOWNS] = {0.002, 0.1, 0.1, 0.1};
        struct material_damping *d = &j->fit.damping[j->fit.best];
        j->evaluations = material_metric_descend(s, x, step, damping[2]);
        j->fit.gamma = (struct material_figure){real_exp(x[MATERIAL_GAMMA]), NAN, NAN};
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
static bool search(struct job *j, struct err *e)
{
    struct material_fit *f = &j->fit;
    struct arena *a = j->c->arena;
    double nu = isnan(j->poisson) ? 0.3 : j->poisson;
    const double step[MATERIAL_UNKNOWNS] = {0.1, 0.5, 0.5, 0.5}, low[2] = {0.5, 1e-9}, high[2] = {50.0, 1e-6};
    const struct ending *best = NULL;
    struct material_search *s = open_metric(j, nu);
    if (!s) return err_set(e, ERR_USAGE, "--method paper: no strike says which place was struck: write FILE.csv@X,Y");
    j->ending = ARENA_TAKE(a, struct ending, j->starts);
    for (long k = 0; k < j->starts; k++) {
        struct noise noise = noise_make(0, "starts");
        struct ending *end = &j->ending[k];
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
static void strength(const struct job *j, struct strike *s, const struct material_set *set)
{
    const struct solid_family *f = &j->family[set->object];
    const struct thing *t = &j->thing[set->object];
    const struct mode_table *table = &s->table;
    double sum = 0.0, square = 0.0;
    int n = 0, node = (int)rint(j->fit.nu.value / 0.0125);
    node = f->nodes == 1 ? 0 : node < 0 ? 0 : node > f->nodes - 1 ? f->nodes - 1 : node;
    if (isnan(j->density)) return;
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
                   unit = fabs(phi[set->match[i]] * ear[set->match[i]]) / j->density;
            unit *= table->quantity == MODES_DISPLACEMENT ? 1.0 / w : table->quantity == MODES_ACCELERATION ? w : 1.0;
            if (!(unit > 1e-6 * fabs(phi[set->match[i]]))) continue;
            double x = real_log(fabs(entry->slope[0].gain) / unit);
            sum += x;
            square += x * x;
            n++;
        }
    }
    if (n < 3) return;
    s->strength = real_exp(sum / n);
    s->spread = sqrt(fmax(square / n - sum / n * (sum / n), 0.0));
}

/* ------------------------------------------------------------------ output */

static double decibel(double log_ratio) { return 20.0 / real_log(10.0) * log_ratio; }

static void put(FILE *f, const char *key, const struct material_figure *x, const char *unit)
{
    fprintf(f, "    %s: %.6g%s%s", key, x->value, *unit ? " " : "", unit);
    if (!isnan(x->low)) fprintf(f, " # 95 %%: %.6g to %.6g", x->low, x->high);
    fputc('\n', f);
}

static struct material_figure times(const struct material_figure *x, double factor)
{
    return (struct material_figure){factor * x->value, factor * x->low, factor * x->high};
}

static void write_material(FILE *f, const struct job *j)
{
    const struct material_fit *t = &j->fit;
    struct arena *a = j->c->arena;
    double damping[3];
    struct material_figure e = times(&t->gamma, j->density),
                           speed = {sqrt(t->gamma.value), sqrt(t->gamma.low), sqrt(t->gamma.high)};
    fprintf(f, "# A material by rasp modes material: include this file in a scene and write material: %s\n", j->name);
    for (int o = 0; o < j->n; o++)
        fprintf(f, "# object %d: %s, %.6g m^3\n", o + 1, text_shown(a, j->thing[o].text),
                j->thing[o].solid.boundary.volume);
    for (int i = 0; i < j->strikes; i++) {
        const char *slash = strrchr(j->strike[i].file, '/');
        fprintf(f, "# strike %d: of object %d, %s, sha256 %s\n", i + 1, j->set[i].object + 1,
                text_shown(a, slash ? slash + 1 : j->strike[i].file), j->strike[i].hash);
    }
    if (j->paper)
        fprintf(f, "# method: the search of Ren et al. (2013), the best of %ld starts\n", j->starts);
    else
        fprintf(f, "# matched: %d of %d modes, %.3g %% beside computed ones (rms); %d that should show are missing\n",
                t->matched, t->modes, 100.0 * t->scatter, t->missing);
    if (!isnan(j->metric.image))
        fprintf(f, "# metrics: image %.4g, feature %.4g (0: alike)\n", j->metric.image, j->metric.feature);
    for (char *rest = t->warning ? arena_text(a, t->warning) : NULL, *line; (line = strsep(&rest, "\n"));)
        fprintf(f, "# warning: %s\n", line);
    fprintf(f, "materials:\n  %s:\n", j->name);
    if (isnan(j->density))
        put(f, "wave_speed", &speed, "m/s"); /* sqrt(E/density) */
    else {
        put(f, "youngs_modulus", &e, "Pa");
        fprintf(f, "    density: %.6g kg/m^3\n", j->density);
    }
    if (j->wood)
        fprintf(f, "    like: %s # moduli across the grain keep their ratios to that along it\n", j->wood->name);
    else
        put(f, "poisson", &t->nu, "");
    material_fit_rayleigh(t, t->best, damping);
    static const char *const names[3] = {"alpha", "beta", "loss"}, *const units[3] = {"1/s", "s", ""};
    for (int k = 0; k < 3; k++) {
        struct material_figure x = {damping[k], NAN, NAN};
        const struct material_damping *d = &t->damping[t->best];
        for (int i = 0; i < d->n; i++)
            if (!strcmp(d->parameter[i], names[k])) x = d->figure[i];
        put(f, names[k], &x, units[k]);
    }
    if (j->paper)
        fputs("    source: fitted to the sound of a strike by the search of Ren et al. (2013)\n", f);
    else
        fprintf(f, "    source: fitted to %d modes of %d strike%s; damping by the law %s%s\n", t->matched, j->strikes,
                j->strikes == 1 ? "" : "s", t->damping[t->best].name, j->polish ? ", polished on the sound" : "");
}

static void report_figure_of(struct report *r, const char *key, const char *label, const struct material_figure *x,
                             const char *unit)
{
    report_object(r, key);
    report_set(r, "value:n low:n high:n", x->value, x->low, x->high);
    report_end(r);
    if (isnan(x->low))
        report_row(r, label, "%.6g%s%s", x->value, *unit ? " " : "", unit);
    else
        report_row(r, label, "%.6g%s%s (95 %%: %.6g to %.6g)", x->value, *unit ? " " : "", unit, x->low, x->high);
}

static void report_damping(struct report *r, const struct job *j)
{
    const struct material_fit *f = &j->fit;
    report_list(r, "damping");
    for (int law = 0; law < MATERIAL_LAWS; law++) {
        const struct material_damping *d = &f->damping[law];
        report_object(r, NULL);
        report_set(r, "law:s bic:n scatter:n chosen:b", d->name, d->bic, d->scatter, law == f->best);
        report_text(r, "  damping %-16s BIC %8.1f, scatter %4.1f %%%s", d->name, d->bic, 100.0 * d->scatter,
                    law == f->best ? ", chosen:" : ":");
        for (int k = 0; k < d->n; k++) {
            const struct material_figure *x = &d->figure[k];
            report_object(r, d->parameter[k]);
            report_set(r, "value:n low:n high:n", x->value, x->low, x->high);
            report_end(r);
            report_text(r, " %s %.4g", d->parameter[k], x->value);
            if (!isnan(x->low)) report_text(r, " (%.4g to %.4g)", x->low, x->high);
            report_text(r, "%s%s%s", *d->unit[k] ? " " : "", d->unit[k], k + 1 < d->n ? "," : "");
        }
        report_text(r, "\n");
        report_end(r);
    }
    report_end(r);
}

static void report_matches(struct report *r, const struct job *j)
{
    double *log_ratio, *slope;
    report_list(r, "strikes");
    for (int i = 0; i < j->strikes; i++) {
        const struct material_set *set = &j->set[i];
        const struct strike *s = &j->strike[i];
        const struct solid_family *f = &j->family[set->object];
        int matched = 0;
        log_ratio = ARENA_TAKE(j->c->arena, double, f->n);
        slope = ARENA_TAKE(j->c->arena, double, f->n);
        solid_family_at(f, j->fit.nu.value, log_ratio, slope);
        report_object(r, NULL);
        report_set(r, "file:s sha256:s object:i strength:n spread_db:n", s->file, s->hash, set->object + 1, s->strength,
                   decibel(s->spread));
        report_list(r, "modes");
        for (int k = 0; k < set->n; k++) {
            int branch = set->match[k];
            double computed = NAN, d = NAN;
            if (branch >= 0) {
                const struct material_damping *law = &j->fit.damping[j->fit.best];
                double parameter[3];
                for (int p = 0; p < law->n; p++)
                    parameter[p] = law->figure[p].value;
                d = material_fit_decay(j->fit.best, parameter, real_exp(set->log_lambda[k]));
                double lambda = real_exp(log_ratio[branch]) * j->fit.gamma.value;
                computed = sqrt(fmax(lambda - d * d, 0.0)) / (2.0 * REAL_PI);
                matched++;
            }
            report_object(r, NULL);
            report_set(r, "frequency_hz:n decay_per_s:n computed_hz:n computed_decay_per_s:n", set->frequency[k],
                       set->decay[k], computed, d);
            report_end(r);
        }
        report_end(r);
        report_end(r);
        report_text(r, "  %s: %d of %d modes match", s->file, matched, set->n);
        if (!isnan(s->strength))
            report_text(r, "; strength %.4g, gains %.3g dB (rms) beside it", s->strength, decibel(s->spread));
        report_text(r, "\n");
    }
    report_end(r);
}

/* Where each start of --method paper ended. */
static void report_endings(struct report *r, const struct job *j)
{
    report_text(r, "  %14s %12s %12s %10s %10s\n", "E/density", "alpha 1/s", "beta s", "image", "feature");
    report_list(r, "endings");
    for (const struct ending *end = j->ending; end < j->ending + j->starts; end++) {
        double gamma = real_exp(end->x[MATERIAL_GAMMA]), alpha = real_exp(end->x[MATERIAL_ALPHA_OF]),
               beta = real_exp(end->x[MATERIAL_BETA_OF]);
        report_object(r, NULL);
        report_set(r, "youngs_modulus_per_density:n alpha:n beta:n metric_image:n metric_feature:n", gamma, alpha, beta,
                   end->metric.image, end->metric.feature);
        report_end(r);
        report_text(r, "  %14.6g %12.4g %12.4g %10.4g %10.4g\n", gamma, alpha, beta, end->metric.image,
                    end->metric.feature);
    }
    report_end(r);
}

static bool print(const struct job *j, struct err *e)
{
    struct report r = report_open(stdout, args_given(&j->c->args, "json"));
    const struct material_fit *f = &j->fit;
    struct material_figure modulus = times(&f->gamma, j->density);
    report_set(&r, "material:s name:s method:s", j->file, j->name, j->paper ? "paper" : "scan");
    report_text(&r, "%s: ", j->name);
    if (j->paper) {
        report_text(&r, "the best of %ld starts\n", j->starts);
    } else {
        report_text(&r,
                    "%d of %d modes match computed ones, %.3g %% beside them (rms); %d that should show are missing\n",
                    f->matched, f->modes, 100.0 * f->scatter, f->missing);
        report_set(&r, "modes:i matched:i missing:i scatter:n birge:n cost:n sure:b unique:b", f->modes, f->matched,
                   f->missing, f->scatter, f->birge, f->cost, f->sure, f->unique);
    }
    report_figure_of(&r, "youngs_modulus_per_density", "E/density at these sizes", &f->gamma, "m^2/s^2");
    if (!isnan(j->density)) {
        report_figure_of(&r, "youngs_modulus", "Young's modulus", &modulus, "Pa");
        report_figure(&r, "density", j->density, "density", "%.6g kg/m^3", j->density);
    }
    if (!j->wood) report_figure_of(&r, "poisson", "Poisson's ratio", &f->nu, "");
    report_set(&r, "metric_image:n metric_feature:n evaluations:i", j->metric.image, j->metric.feature, j->evaluations);
    if (isnan(j->metric.image))
        report_row(&r, "metrics", "not known without the place that was struck (FILE.csv@X,Y)");
    else
        report_row(&r, "metrics (0: alike)", "image %.4g, feature %.4g", j->metric.image, j->metric.feature);
    if (j->paper)
        report_endings(&r, j);
    else {
        report_set(&r, "correlation:n", f->correlation);
        report_object(&r, "next");
        report_set(&r, "youngs_modulus_per_density:n poisson:n cost:n", isnan(f->next.cost) ? NAN : f->next.gamma,
                   isnan(f->next.cost) ? NAN : f->next.nu, f->next.cost);
        report_end(&r);
        report_damping(&r, j);
        report_matches(&r, j);
    }
    report_list(&r, "warnings");
    for (char *rest = f->warning ? arena_text(j->c->arena, f->warning) : NULL, *line; (line = strsep(&rest, "\n"));) {
        report_set(&r, ":s", line);
        report_note(&r, "  warning: ", line);
    }
    report_end(&r);
    return report_close(&r, 10, e);
}

int modes_material_run(struct cmd_call *c, struct err *e)
{
    struct job j = {.c = c};
    struct outfile o;
    if (!read_options(&j, e) || !mark_absent(j.file, args_given(&c->args, "force"), e) ||
        !modes_output_possible(j.file, e) || !read_operands(&j, e) || !read_masses(&j, e) || !read_wood(&j, e))
        return (int)e->kind;
    for (int i = 0; i < j.strikes; i++)
        if (!modes_output_spares(j.file, j.strike[i].file, e)) return (int)e->kind;
    for (int i = 0; i < j.n; i++)
        if (!read_object(&j, &j.thing[i], e)) return (int)e->kind;
    if (!read_places(&j, e)) return (int)e->kind;
    j.family = ARENA_TAKE(c->arena, struct solid_family, j.n);
    for (int i = 0; i < j.n; i++)
        if (!compute_family(&j, i, e)) return (int)e->kind;
    find_density(&j);
    for (int i = 0; i < j.strikes; i++) {
        const struct strike *one = &j.strike[i];
        const struct thing *t = &j.thing[j.set[i].object];
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
    write_material(o.stream, &j);
    if (!outfile_commit(&o, e)) return (int)e->kind;
    return args_given(&c->args, "quiet") || print(&j, e) ? 0 : (int)e->kind;
}
