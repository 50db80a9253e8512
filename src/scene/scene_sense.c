/* Values against each other: see scene_sense.h. Each is told at that value among those involved which was laid down last: at the command
   line's rather than the file's. */
#include "scene/scene_sense.h"

#include <math.h>
#include <string.h>

#include "base/text.h"
#include "scene/rules.h"

#define SHORTEST_STROKE 1e-9     /* m */
#define NARROWEST_SMOOTHING 1e-9 /* s: far below a sample, and kernels of it would underflow */
#define WIDEST_BAND 1e5          /* longest over shortest wavelength */

/* ------------------------------------------------------------------ places */

static const struct yaml_node *later(const struct scene_part *p, const char *path, const char *other)
{
    const struct yaml_node *a = yaml_find(p->map, path), *b = yaml_find(p->map, other);
    return !a ? b : !b ? a : scene_part_before(&a->at, &b->at) ? b : a;
}

/* The place of the later of two keys' values. */
static struct diag_place place(const struct scene_part *p, const char *path, const char *other)
{
    const struct yaml_node *node = later(p, path, other);
    return node ? node->at : scene_part_place(p, p->map);
}

/* "path SAYS other", and whether one of them is a default. */
static void contradiction(const struct scene_part *p, const char *const paths[2], const char *says, const char *cure)
{
    const struct yaml_node *a = yaml_find(p->map, paths[0]), *b = yaml_find(p->map, paths[1]);
    diag_add(p->yaml->diag, place(p, paths[0], paths[1]), cure, "%s %s %s%s", scene_part_label(p, paths[0]), says,
             scene_part_label(p, paths[1]), a && b ? "" : " (the other is the default; give both)");
}

/* ------------------------------------------------------------------ motion, surface, grip */

static void stroke_check(const struct scene_part *p, const struct motion *m)
{
    static const char *const ends[2] = {"motion.to", "motion.from"};
    double x = m->to[0] - m->from[0], y = m->to[1] - m->from[1];
    if (sqrt(x * x + y * y) < SHORTEST_STROKE)
        contradiction(p, ends, "must differ from", "the ends are to be at least 1 nm apart: write for instance: to: [3 cm, 0]");
}

static void band_check(const struct scene_part *p, const struct roughness *r)
{
    static const char *const waves[2] = {"surface.roughness.shortest", "surface.roughness.longest"};
    if (!r->given)
        return;
    if (r->shortest >= r->longest)
        contradiction(p, waves, "must be less than", "raise longest, or lower shortest");
    else if (r->longest / r->shortest > WIDEST_BAND)
        diag_add(p->yaml->diag, place(p, waves[0], waves[1]), "lower longest, or raise shortest",
                 "%s is %.3g times %s, and at most 100 000 times are offered", scene_part_label(p, waves[1]), r->longest / r->shortest,
                 scene_part_label(p, waves[0]));
}

static void grip_check(const struct scene_part *p, const struct grip *g)
{
    if (g->given && rules_jams(g))
        diag_add(p->yaml->diag, place(p, "grip.angle", "grip.friction"), "lower grip.angle or grip.friction",
                 "%s: the tool jams: friction x tan(angle) is %.4g, and must stay below 0.999", scene_part_label(p, "grip"),
                 1 - rules_slip(g));
}

/* ------------------------------------------------------------------ limiter and smoothing */

static void alpha_check(const struct scene_part *p, const struct limiter *l)
{
    static const char *const alphas[2] = {"contact.limiter.alpha_min", "contact.limiter.alpha_max"};
    if (l->alpha_min > l->alpha_max)
        contradiction(p, alphas, "must not be greater than", "lower alpha_min, or raise alpha_max");
}

/* The largest alpha there can be: that of the force under a constant load. */
static double alpha_widest(const struct contact *c)
{
    const struct limiter *l = &c->contact.limiter;
    double n = isnan(c->load.constant) ? c->scraper.mass * c->contact.gravity : c->load.constant;
    if (c->grip.given)
        return fmax(l->alpha_max, l->alpha);
    if (isnan(l->force_range[0]))
        return l->alpha;
    double share = (n - l->force_range[0]) / (l->force_range[1] - l->force_range[0]);
    double nu = real_pow(share < 0 ? 0 : share > 1 ? 1 : share, l->zeta);
    return (1 - nu) * l->alpha_max + nu * l->alpha_min;
}

/* Told at the smoothing if it is given, else at the alpha that makes it wide. */
static void smoothing_check(const struct scene_part *p, const struct contact *c)
{
    const char *path = "contact.smoothing";
    double sigma = rules_sigma(&c->contact, alpha_widest(c));
    if (c->contact.smoothing > 0 && c->contact.smoothing < NARROWEST_SMOOTHING)
        diag_add(p->yaml->diag, place(p, path, path), "0 turns it off; or write for instance: smoothing: 50 us",
                 "%s must be 0 or at least 1 ns", scene_part_label(p, path));
    if (sigma > RULES_SMOOTHING_WIDEST)
        diag_add(p->yaml->diag, yaml_find(p->map, path) ? place(p, path, path) : place(p, "contact.limiter.alpha", "contact.limiter.alpha_max"),
                 "lower contact.smoothing or the alpha of contact.limiter; smoothing: 0 turns it off",
                 "%s smooths the force with a sigma of %.3g s (smoothing x alpha / 3 cm), and at most %g s make sense",
                 scene_part_label(p, path), sigma, RULES_SMOOTHING_WIDEST);
}

/* ------------------------------------------------------------------ responses */

static bool is_table(const char *file)
{
    size_t n = strlen(file);
    return n > 4 && strcmp(file + n - 4, ".csv") == 0;
}

static void response_check(const struct scene_part *p, const struct response *r, const char *body)
{
    struct arena *a = p->yaml->arena;
    const char *engine = arena_format(a, "%s.convolution", body), *file = arena_format(a, "%s.response", body);
    const char *length = arena_format(a, "%s.response_length", body);
    if (!r->file || r->convolution != ENGINE_RESONATORS)
        return;
    if (!is_table(r->file))
        diag_add(p->yaml->diag, place(p, engine, file), arena_format(a, "leave %s out, or set it to overlap_add", engine),
                 "%s: resonators need a mode table (.csv) as %s, not '%s'", scene_part_label(p, engine), scene_part_label(p, file),
                 diag_shown(p->yaml->diag, r->file));
    if (!isnan(r->length))
        diag_add(p->yaml->diag, place(p, engine, length), arena_format(a, "leave %s out, or set %s to overlap_add", length, engine),
                 "%s: resonators ring on for ever, and %s cannot cut them", scene_part_label(p, engine), scene_part_label(p, length));
}

void scene_sense_contact(const struct scene_part *p)
{
    const struct contact *c = p->to;
    stroke_check(p, &c->motion);
    band_check(p, &c->surface.roughness);
    grip_check(p, &c->grip);
    alpha_check(p, &c->contact.limiter);
    smoothing_check(p, c);
    response_check(p, &c->surface.response, "surface");
    response_check(p, &c->scraper.response, "scraper");
}

/* ------------------------------------------------------------------ diagnostics */

static const char *contact_called(const struct scene_part *p)
{
    const struct contact *c = p->to;
    return *p->prefix && c->name ? arena_format(p->yaml->arena, "contact '%s'", diag_shown(p->yaml->diag, c->name)) : "the contact";
}

static const char *const columns[] = {
#define COLUMN(id, name, exists, needs, meaning) name,
#include "scene/columns.def"
#undef COLUMN
    NULL,
};

/* What a contact lacks for a column; "" if it lacks nothing. */
static const char *lacks(const struct contact *c, int column)
{
    const char *const lacking[] = {
#define COLUMN(id, name, exists, needs, meaning) (exists) ? "" : needs,
#include "scene/columns.def"
#undef COLUMN
    };
    return lacking[column];
}

static int column_find(const struct yaml_node *item)
{
    for (int k = 0; item->kind == YAML_SCALAR && columns[k]; k++)
        if (strcmp(columns[k], item->text) == 0)
            return k;
    return -1;
}

static const struct yaml_node *column_first(struct yaml_node *root)
{
    const struct yaml_node *list = yaml_find(root, "output.diagnostics.columns");
    return list && list->kind == YAML_LIST ? list->first : NULL;
}

void scene_sense_names(struct yaml *y, struct yaml_node *root)
{
    for (const struct yaml_node *item = column_first(root); item; item = item->next) {
        if (item->kind != YAML_SCALAR || !*item->text || yaml_null(item) || column_find(item) >= 0)
            continue;
        const char *near = text_nearest(item->text, columns);
        diag_add(y->diag, item->at, near ? arena_format(y->arena, "did you mean '%s'?", near) : "rasp explain output.diagnostics.columns lists them",
                 "output.diagnostics.columns: there is no column '%s'", diag_shown(y->diag, item->text));
    }
}

void scene_sense_columns(const struct scene_part *p, struct yaml_node *root, const struct scene *s)
{
    const struct contact *c = p->to;
    for (const struct yaml_node *item = column_first(root); item && s->output.diagnostics.given; item = item->next) {
        int k = column_find(item);
        const char *needs = k < 0 ? "" : lacks(c, k);
        if (*needs)
            diag_add(p->yaml->diag, item->at, "leave the column out, or give what it needs", "output.diagnostics.columns: %s has no %s: it needs %s",
                     contact_called(p), item->text, needs);
    }
}

void scene_sense_asked(const struct scene_part *p, const struct scene *s)
{
    const struct contact *c = p->to;
    const struct yaml_node *surface = yaml_get(p->map, "surface");
    if (s->output.diagnostics.given || c->surface.response.file || (c->scraper.response.file && c->scraper.weight != 0))
        return;
    diag_add(p->yaml->diag, scene_part_place(p, surface ? surface : p->map),
             "give surface.response (or scraper.response) for a sound, or output.diagnostics for a table of its physics",
             "nothing is asked of %s", contact_called(p));
}
