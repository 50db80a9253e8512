#include "scene/scene_materials.h"

#include <math.h>
#include <string.h>

#include "base/text.h"
#include "scene/keys_yaml.h"
#include "scene/scene_values.h"

enum { MATERIALS_MOST = 1000 };

static const char EXAMPLE[] =
    "write for instance: my_glass: {youngs_modulus: 72 GPa, poisson: 0.23, density: 2500 kg/m^3, "
    "alpha: 6 1/s, beta: 4e-8 s}";

/* Numbers of an entry, with the range of the object's key of that name. */
static const struct {
    const char *name;
    size_t offset; /* in struct material */
} numbers[] = {
    {"youngs_modulus", offsetof(struct material, youngs_modulus)},
    {"poisson", offsetof(struct material, poisson)},
    {"density", offsetof(struct material, density)},
    {"alpha", offsetof(struct material, alpha)},
    {"beta", offsetof(struct material, beta)},
    {"loss", offsetof(struct material, loss)},
};

enum { NUMBERS = sizeof numbers / sizeof *numbers };

static double *number_of(const struct material *m, int i) { return (double *)((char *)(size_t)m + numbers[i].offset); }

static bool is_name(const char *s)
{
    static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_0123456789";
    return *s && !(*s >= '0' && *s <= '9') && s[strspn(s, letters)] == '\0';
}

static const struct material *builtin(const char *name)
{
    const struct material *m = material_table;
    while (m->name && strcmp(m->name, name) != 0)
        m++;
    return m->name ? m : NULL;
}

/* ------------------------------------------------------------------ reading */

static void item_read(struct yaml *y, const struct yaml_node *item, const char *label, struct scene_material *t)
{
    const struct scene_part part = {y, NULL, "", KEY_SCENE, NULL, NULL};
    const char *name = item->key->text, *full = arena_format(y->arena, "%s.%s", label, name);
    double speed;
    for (int i = 0; i < NUMBERS; i++)
        if (!strcmp(name, numbers[i].name)) {
            const struct key *k = keys_find(arena_format(y->arena, "surface.object.%s", name));
            scene_values_number(&part, k, item, full, number_of(&t->m, i));
            return;
        }
    if (!strcmp(name, "wave_speed")) {
        if (!scene_values_quantity(y, item, full, KEY_SPEED, &speed)) return;
        if (speed >= 1.0 && speed <= 1e5)
            t->wave_speed = speed;
        else
            diag_add(y->diag, item->at, "it is sqrt(youngs_modulus/density), 5200 m/s of steel",
                     "%s must be from 1 m/s to 100000 m/s, not %s", full, scene_values_kind(y, item));
    } else if (!strcmp(name, "like") || !strcmp(name, "source")) {
        const struct material *wood = item->kind == YAML_SCALAR ? builtin(item->text) : NULL;
        if (item->kind != YAML_SCALAR || !*item->text)
            diag_add(y->diag, item->at, EXAMPLE, "%s must be a text, not %s", full, scene_values_kind(y, item));
        else if (*name == 's')
            t->m.source = item->text;
        else if (wood && wood->radial.youngs_modulus > 0.0)
            t->like = wood->name;
        else
            diag_add(y->diag, item->at, "woods here: basswood, poplar, oak", "%s must be a wood, not %s", full,
                     scene_values_kind(y, item));
    } else
        diag_add(y->diag, item->key->at,
                 "keys here: youngs_modulus, wave_speed, poisson, density, alpha, beta, loss, like, source",
                 "unknown key '%s' in %s", diag_shown(y->diag, name), label);
}

/* Moduli, of a wood all of them, from that along the grain. */
static void moduli(struct scene_material *t)
{
    const struct material *wood = t->like ? builtin(t->like) : NULL;
    t->m.across = t->m.youngs_modulus;
    t->m.shear = t->m.youngs_modulus / (2.0 * (1.0 + t->m.poisson));
    if (!wood) return;
    double ratio = t->m.youngs_modulus / wood->youngs_modulus;
    t->m.across = ratio * wood->across;
    t->m.shear = ratio * wood->shear;
    t->m.poisson = wood->poisson;
    t->m.radial = wood->radial;
    t->m.radial.youngs_modulus *= ratio;
    t->m.radial.shear_lr *= ratio;
    t->m.radial.shear_rt *= ratio;
}

static void entry_read(struct yaml *y, const struct yaml_node *entry, struct scene_material *t)
{
    const char *name = entry->key->text, *label = arena_format(y->arena, "materials.%s", diag_shown(y->diag, name));
    int before = y->diag->n;
    *t = (struct scene_material){.m = {.name = name,
                                       .youngs_modulus = NAN,
                                       .across = NAN,
                                       .shear = NAN,
                                       .poisson = NAN,
                                       .density = NAN,
                                       .source = "given",
                                       .damping_source = "given"},
                                 .wave_speed = NAN};
    if (!is_name(name) || builtin(name) || !strcmp(name, "custom"))
        diag_add(y->diag, entry->key->at, EXAMPLE,
                 is_name(name) ? "rasp has a material '%s' of its own" : "'%s' is not a name of letters, digits and _",
                 diag_shown(y->diag, name));
    if (entry->kind != YAML_MAP) {
        diag_add(y->diag, entry->at, EXAMPLE, "%s must be a map of keys, not %s", label, scene_values_kind(y, entry));
        return;
    }
    for (const struct yaml_node *item = entry->first; item; item = item->next)
        item_read(y, item, label, t);
    if (y->diag->n != before) return;
    if (isnan(t->m.youngs_modulus) == isnan(t->wave_speed))
        diag_add(y->diag, entry->key->at, EXAMPLE,
                 isnan(t->wave_speed) ? "%s needs youngs_modulus, or wave_speed where its density is not known"
                                      : "%s has youngs_modulus and wave_speed, which is sqrt(E/density): leave one out",
                 label);
    else if (t->like ? !isnan(t->m.poisson) : isnan(t->m.poisson))
        diag_add(y->diag, entry->key->at, EXAMPLE,
                 t->like ? "%s is like a wood, which has its own Poisson's ratios: leave poisson out"
                         : "%s needs poisson",
                 label);
    else if (t->m.alpha + t->m.beta + t->m.loss == 0.0)
        diag_add(y->diag, entry->key->at, EXAMPLE, "%s needs alpha, beta or loss: without damping it rings for ever",
                 label);
    if (!isnan(t->wave_speed) && !isnan(t->m.density))
        t->m.youngs_modulus = t->m.density * t->wave_speed * t->wave_speed;
    moduli(t);
}

void scene_materials_read(struct yaml *y, const struct yaml_node *map, struct scene *s)
{
    if (!map) return;
    if (map->kind != YAML_MAP || map->n > MATERIALS_MOST) {
        diag_add(y->diag, map->at, EXAMPLE, "materials must be a map of at most %d names, not %s", MATERIALS_MOST,
                 map->kind == YAML_MAP ? "of more" : scene_values_kind(y, map));
        return;
    }
    struct scene_material *all = ARENA_TAKE(y->arena, struct scene_material, map->n + 1);
    for (const struct yaml_node *entry = map->first; entry; entry = entry->next)
        entry_read(y, entry, &all[s->n_materials++]);
    s->materials = all;
}

/* ------------------------------------------------------------------ use */

static struct object_given *body(struct contact *c, const char *path)
{
    return path[0] == 'b'   ? &c->ball.response.object
           : path[1] == 'u' ? &c->surface.response.object
                            : &c->scraper.response.object;
}

const struct material *scene_materials_dense(const struct scene_material *t, double density, struct arena *a)
{
    struct scene_material *own = ARENA_TAKE(a, struct scene_material, 1);
    *own = *t;
    own->m.density = density;
    own->m.youngs_modulus = density * t->wave_speed * t->wave_speed;
    moduli(own);
    return &own->m;
}

static const char *const keys[] = {"surface.material", "scraper.material", "ball.material"};

void scene_materials_assign(const struct scene_part *p, const struct scene *s, struct contact *c)
{
    struct arena *a = p->yaml->arena;
    for (int i = 0; i < 3; i++) {
        const struct yaml_node *node = yaml_find(p->map, keys[i]);
        struct object_given *o = body(c, keys[i]);
        for (int k = 0; node && node->kind == YAML_SCALAR && k < s->n_materials; k++) {
            const struct scene_material *t = &s->materials[k];
            if (strcmp(node->text, t->m.name) != 0) continue;
            o->own = &t->m;
            if (!isnan(t->m.youngs_modulus)) continue;
            o->own = scene_materials_dense(t, o->density, a);
            if (isnan(o->density) && o->given && !isnan(t->wave_speed))
                scene_part_missing(p, arena_format(a, "%.*s.object.density", (int)strcspn(keys[i], "."), keys[i]),
                                   "2500 kg/m^3",
                                   arena_format(a, ": the material '%s' has a wave_speed and no density", t->m.name));
        }
    }
}

bool scene_materials_key(const struct key *k)
{
    return !strcmp(k->path, keys[0]) || !strcmp(k->path, keys[1]) || !strcmp(k->path, keys[2]);
}

const char *scene_materials_name(const struct key *k, const struct contact *c)
{
    const struct object_given *o = scene_materials_key(k) ? body((struct contact *)(size_t)c, k->path) : NULL;
    return o && o->own ? o->own->name : NULL;
}

void scene_materials_write(FILE *f, const struct scene *s, struct arena *a)
{
    if (s->n_materials) fputs("materials:\n", f);
    for (int k = 0; k < s->n_materials; k++) {
        const struct scene_material *t = &s->materials[k];
        fprintf(f, "  %s:\n", t->m.name);
        if (!isnan(t->wave_speed)) fprintf(f, "    wave_speed: %s\n", keys_yaml_number(t->wave_speed, a));
        for (int i = 0; i < NUMBERS; i++) {
            double x = *number_of(&t->m, i);
            if (isnan(x) || (i == 0 && !isnan(t->wave_speed)) || (i == 1 && t->like)) continue;
            fprintf(f, "    %s: %s\n", numbers[i].name, keys_yaml_number(x, a));
        }
        if (t->like) fprintf(f, "    like: %s\n", t->like);
        if (strcmp(t->m.source, "given") != 0) fprintf(f, "    source: %s\n", keys_yaml_quoted(t->m.source, a));
    }
}
