/* rasp modes material OBJECT STRIKE... -o FILE.yaml: what objects are made of, from the modes of their recordings
   (analysis/material_fit.h; papers/003 section C).

   An operand that is a mesh, or a shape as of --shape, begins an object; those behind it, until the next, are its
   strikes: mode tables of `rasp modes extract`, each FILE.csv or FILE.csv@X,Y, the place that was struck. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "analysis/material_fit.h"
#include "base/outfile.h"
#include "base/text.h"
#include "cmd/message.h"
#include "cmd/modes_compute.h"
#include "cmd/report.h"
#include "fem/shapes.h"
#include "fem/topology.h"
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
        return err_set(e, ERR_USAGE, "--mass is given %d times for %d objects: once for each, in their order", n, j->n);
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
    k->order = shape ? shapes_order(t->text) : 2;
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

/* ------------------------------------------------------------------ measured modes */

struct measured {
    double frequency, error, decay, decay_error;
};

static int by_frequency(const void *x, const void *y)
{
    const struct measured *p = x, *q = y;
    return (p->frequency > q->frequency) - (p->frequency < q->frequency);
}

/* Standard errors as `rasp modes extract` writes them: of the noise, and from strike to strike, which many strikes make
   less. Without them: 0.02 % and 5 %, what it states of one strike. */
static void read_errors(const struct strike *s, const char *mode, int slope, double strikes, struct arena *a,
                        struct measured *m)
{
    static const char *const words[] = {"frequency_hz se ", "se_between ", "decay_per_s se ", "se_between "};
    const char *text = csv_comment(&s->table.csv, arena_format(a, "error %s.%d", mode, slope));
    double x[4];
    m->error = 2e-4;
    m->decay_error = 0.05;
    for (int k = 0; k < 4; k++) {
        text = text ? strstr(text, words[k]) : NULL;
        if (!text) return;
        x[k] = strtod(text + strlen(words[k]), NULL);
        text += strlen(words[k]);
    }
    m->error = sqrt(x[0] * x[0] + x[1] * x[1] / strikes) / m->frequency;
    m->decay_error = sqrt(x[2] * x[2] + x[3] * x[3] / strikes) / m->decay;
}

static void read_modes(const struct job *j, const struct strike *s, struct material_set *set)
{
    struct arena *a = j->c->arena;
    const struct mode_table *t = &s->table;
    const struct csv *csv = &t->csv;
    const int column = csv_column(csv, "mode"), n = (int)(t->first[1] - t->first[0]);
    struct measured *m = ARENA_TAKE(a, struct measured, n);
    double strikes = 0.0;
    for (size_t i = 0; i < csv->n_comments; i++)
        if (!strncmp(csv->comments[i].key, "strikes ", 8)) strikes += strtod(csv->comments[i].value, NULL);
    for (int i = 0; i < n; i++) {
        const struct mode_entry *entry = &t->entry[t->first[0] + (size_t)i];
        int best = 0;
        for (int k = 1; k < entry->n; k++) { /* of several slopes the one of the greatest energy */
            const struct mode_slope *p = &entry->slope[k], *q = &entry->slope[best];
            if (p->gain * p->gain * q->decay > q->gain * q->gain * p->decay) best = k;
        }
        m[i].frequency = entry->frequency;
        m[i].decay = entry->slope[best].decay;
        read_errors(s, csv->cells[entry->row * csv->columns + (size_t)column], best + 1, fmax(strikes, 1.0), a, &m[i]);
    }
    qsort(m, (size_t)n, sizeof *m, by_frequency);
    set->log_lambda = ARENA_TAKE(a, double, n);
    set->frequency = ARENA_TAKE(a, double, n);
    set->error = ARENA_TAKE(a, double, n);
    set->decay = ARENA_TAKE(a, double, n);
    set->decay_error = ARENA_TAKE(a, double, n);
    set->match = ARENA_TAKE(a, int, n);
    for (int i = 0; i < n; i++) {
        double w = 2.0 * REAL_PI * m[i].frequency;
        if (!(m[i].decay > 0.0)) continue;
        set->log_lambda[set->n] = real_log(w * w + m[i].decay * m[i].decay);
        set->frequency[set->n] = m[i].frequency;
        set->error[set->n] = m[i].error;
        set->decay[set->n] = m[i].decay;
        set->decay_error[set->n++] = m[i].decay_error;
    }
}

/* How well places show a mode: of its shape there (and where it is heard) beside that of all modes, at most 1. */
static void see(const struct job *j, const struct strike *s, struct material_set *set)
{
    const struct solid_family *f = &j->family[set->object];
    const struct thing *t = &j->thing[set->object];
    int node = f->nodes / 2, used = 0;
    const double *phi = f->phi + (size_t)node * t->points * f->n;
    double rms = 0.0;
    if (s->places == 0) return;
    set->visible = ARENA_TAKE(j->c->arena, double, f->n);
    for (int k = 0; k < f->n; k++) {
        for (int p = s->first; p < s->first + s->places; p++)
            set->visible[k] = fmax(set->visible[k], fabs(phi[(size_t)p * f->n + k]));
        if (t->ear >= 0) set->visible[k] *= fabs(phi[(size_t)t->ear * f->n + k]);
        rms += set->visible[k] * set->visible[k];
        used++;
    }
    rms = sqrt(rms / used);
    for (int k = 0; k < f->n; k++)
        set->visible[k] = fmin(set->visible[k] / (0.5 * rms), 1.0);
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
    fprintf(f, "# matched: %d of %d modes, %.3g %% beside computed ones (rms); %d that should show are missing\n",
            t->matched, t->modes, 100.0 * t->scatter, t->missing);
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
    fprintf(f, "    source: fitted to %d modes of %d strike%s; damping by the law %s\n", t->matched, j->strikes,
            j->strikes == 1 ? "" : "s", t->damping[t->best].name);
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

static bool print(const struct job *j, struct err *e)
{
    struct report r = report_open(stdout, args_given(&j->c->args, "json"));
    const struct material_fit *f = &j->fit;
    struct material_figure modulus = times(&f->gamma, j->density);
    report_text(&r,
                "%s: %d of %d modes match computed ones, %.3g %% beside them (rms); %d that should show are missing\n",
                j->name, f->matched, f->modes, 100.0 * f->scatter, f->missing);
    report_set(&r, "material:s name:s modes:i matched:i missing:i scatter:n birge:n cost:n sure:b unique:b", j->file,
               j->name, f->modes, f->matched, f->missing, f->scatter, f->birge, f->cost, f->sure, f->unique);
    report_figure_of(&r, "youngs_modulus_per_density", "E/density at these sizes", &f->gamma, "m^2/s^2");
    if (!isnan(j->density)) {
        report_figure_of(&r, "youngs_modulus", "Young's modulus", &modulus, "Pa");
        report_figure(&r, "density", j->density, "density", "%.6g kg/m^3", j->density);
    }
    if (!j->wood) report_figure_of(&r, "poisson", "Poisson's ratio", &f->nu, "");
    report_set(&r, "correlation:n", f->correlation);
    report_object(&r, "next");
    report_set(&r, "youngs_modulus_per_density:n poisson:n cost:n", isnan(f->next.cost) ? NAN : f->next.gamma,
               isnan(f->next.cost) ? NAN : f->next.nu, f->next.cost);
    report_end(&r);
    report_damping(&r, j);
    report_matches(&r, j);
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
        read_modes(&j, &j.strike[i], &j.set[i]);
        if (j.set[i].n == 0)
            return err_set(e, ERR_SCENE, "%s: has no mode that decays", j.strike[i].file), (int)e->kind;
        see(&j, &j.strike[i], &j.set[i]);
    }
    struct material_problem p = {.object = j.family,
                                 .sets = j.strikes,
                                 .set = j.set,
                                 .gamma = {j.range[0], j.range[1]},
                                 .poisson = j.poisson,
                                 .model_error = j.model_error,
                                 .size_error = j.size_error};
    if (!material_fit(&p, c->arena, &j.fit, e)) return (int)e->kind;
    for (int i = 0; i < j.strikes; i++)
        strength(&j, &j.strike[i], &j.set[i]);
    if (!outfile_open(&o, j.file, e)) return (int)e->kind;
    write_material(o.stream, &j);
    if (!outfile_commit(&o, e)) return (int)e->kind;
    return args_given(&c->args, "quiet") || print(&j, e) ? 0 : (int)e->kind;
}
