/* cmd/new.c and scene/keys_yaml.c: what rasp itself writes for people to start from must be scenes, ask for
   something to be computed, name no file, and hide no mistake in what is commented out. */
#include "force/scrape.h"
#include "surface/limiter.h"
#include "unit.h"

#include "cmd/cmd.h"
#include "pipeline/stages.h"
#include "scene/keys.h"
#include "scene/keys_text.h"
#include "scene/keys_yaml.h"
#include "scene/params.h"
#include "scene/scene_read.h"
#include "surface/roughness.h"

static struct arena *a;
static struct scene s;

static char *starter_text(const struct new_starter *starter, size_t *size)
{
    char *text = NULL;
    FILE *f = open_memstream(&text, size);
    new_print(f, starter, a);
    fclose(f);
    return text;
}

static char *reference_text(size_t *size)
{
    char *text = NULL;
    FILE *f = open_memstream(&text, size);
    keys_yaml_reference(f, a);
    fclose(f);
    return text;
}

static void must_read(const char *text, const char *name, const struct scene_overrides *over)
{
    const char *messages = "";
    struct err e = {0};
    ck_assert_msg(scene_read_text(text, strlen(text), name, over, a, &s, &messages, &e), "%s\n%s", messages, text);
}

START_TEST(test_starters_are_scenes)
{
    a = arena_open();
    for (const struct new_starter *starter = new_starters; starter->name; starter++) {
        size_t size;
        char *text = starter_text(starter, &size);
        if (!starter->text) { /* the design, which cli/new and cli/new_renders try */
            free(text);
            continue;
        }
        must_read(text, starter->name, NULL);
        ck_assert_msg(s.output.diagnostics.given, "%s asks for nothing", starter->name);
        for (int i = 0; i < s.n_contacts; i++)
            ck_assert(!s.contacts[i].surface.response.file && !s.contacts[i].scraper.response.file &&
                      !params_given(&s.contacts[i], height_map_stage.params));
        free(text);
    }
    arena_close(a);
}
END_TEST

/* Every "#key: value" line, set by its path from the starter's table, is a value that the key takes. */
START_TEST(test_what_is_off_is_right_too)
{
    a = arena_open();
    for (const struct new_starter *starter = new_starters; starter->name; starter++)
        for (const struct keys_line *l = starter->text ? new_lines(starter->text, a) : NULL; l && l->path && l->value;
             l++) {
            size_t size;
            const char *set[] = {arena_format(a, "%s=%s", l->path, l->value), "surface.roughness=null"};
            const struct key *k = keys_find(l->path);
            bool map = k && (!strcmp(k->path, "surface.height_map") ||
                             (k->applies && !strcmp(k->applies, "surface.height_map")));
            char *text = starter_text(starter, &size);
            const char *both[] = {set[0], set[1], "surface.height_map=x.npy", "surface.pitch=1 um"};
            if (l->off && map)
                must_read(text, starter->name, &(struct scene_overrides){.set = both, .n = 4});
            else if (l->off)
                must_read(text, starter->name, &(struct scene_overrides){.set = set, .n = 1});
            free(text);
        }
    arena_close(a);
}
END_TEST

START_TEST(test_reference_is_a_scene_with_the_defaults)
{
    size_t size;
    struct scene given;
    a = arena_open();
    char *text = reference_text(&size);
    must_read(text, "reference", NULL);
    given = s;
    must_read("rasp: 1\ntitle: a tool scraped back and forth on a rough plank\nsurface: {roughness: {}}\nscraper: "
              "{mass: 20 g}\n"
              "motion: {path: back_and_forth, to: [4.5 cm, 0], rate: 2 Hz, duration: 2 s}\noutput: {diagnostics: {}}\n",
              "short", NULL);
    ck_assert(scrape_law(given.contacts)->leak == scrape_law(s.contacts)->leak);
    ck_assert(limiter_of(given.contacts)->alpha == limiter_of(s.contacts)->alpha);
    const struct roughness *r = params_of(given.contacts, roughness_stage.params),
                           *of_s = params_of(s.contacts, roughness_stage.params);
    ck_assert(r->rms == of_s->rms);
    ck_assert(given.output.sample_rate == s.output.sample_rate && given.output.encoding == s.output.encoding);
    ck_assert(given.output.diagnostics.given && r->given && !given.contacts->grip.given);
    ck_assert(given.accuracy.oversampling == s.accuracy.oversampling && isnan(given.output.tail));
    free(text);
    arena_close(a);
}
END_TEST

/* Each key has its line in the reference, on or off, with a value; one without a default needs an example. */
START_TEST(test_reference_has_every_key)
{
    size_t size;
    a = arena_open();
    char *text = reference_text(&size);
    for (const struct key *k = keys_table; k->path; k++) {
        const char *dot = strrchr(k->path, '.'), *name = dot ? dot + 1 : k->path;
        ck_assert_msg((k->standard && *k->standard) || keys_yaml_example(k->path), "%s needs an example in keys_yaml.c",
                      k->path);
        ck_assert_msg(strstr(text, arena_format(a, "\n%s: ", name)) || strstr(text, arena_format(a, " %s: ", name)) ||
                          strstr(text, arena_format(a, "#%s: ", name)),
                      "%s is not in the reference", k->path);
    }
    for (const struct key_knob *k = keys_knobs; k->name; k++)
        ck_assert_ptr_nonnull(strstr(text, arena_format(a, "  %s: ", k->name)));
    free(text);
    arena_close(a);
}
END_TEST

#define STRIKE "contact.model=strike", "surface.roughness=null"
#define ROLLS "contact.model=roll_coupled", "scraper=null", "contact.roll.kappa=5e9"
#define IMPACTS "contact.model=impacts", "surface.roughness=null", "scraper.mass=null"
#define GIVEN "contact.model=given", "surface.roughness=null", "scraper.mass=null"

/* What an object's key needs beside it: the shape that has it, and that shape's other sizes. */
static const char *const objects[][2] = {
    {"shape", "{length: 1, width: 1, thickness: 1 mm}"},
    {"length", "{shape: string, diameter: 1 mm, tension: 1}"},
    {"width", "{shape: bar, length: 1, thickness: 1 mm}"},
    {"diameter", "{shape: disk, thickness: 1 mm}"},
    {"thickness", "{shape: rod, length: 1, diameter: 3 cm}"},
    {"tension", "{shape: string, length: 1, diameter: 1 mm}"},
    {"surface_tension", "{shape: drum, diameter: 1, thickness: 0.1 mm}"},
    {"", "{shape: plate, length: 1, width: 1, thickness: 1 mm}"},
};

static int with_object(const char *path, const char **set)
{
    const char *key = strstr(path, ".object.");
    size_t i = 0;
    if (!key) return 0;
    while (*objects[i][0] && strcmp(objects[i][0], key + 8))
        i++;
    set[0] = arena_format(a, "%.*s=%s", (int)(key + 7 - path), path, objects[i][1]);
    set[1] = arena_format(a, "%.*s.material=steel", (int)(key - path), path);
    return 2;
}

/* Examples that the reference shows commented out are values that their keys take. */
START_TEST(test_examples_are_taken)
{
    static const char *const with[][8] = {
        /* a ball's object needs what its mass does */
        {"surface.pitch", "surface.height_map=x.npy", "surface.roughness=null"},
        {"surface.height_map", "surface.pitch=1 um", "surface.roughness=null"},
        {"surface.height_range", "surface.height_map=x.png"},
        {"surface.continuation.exponent", "surface.height_map=x.gsf"},
        {"surface.continuation.from", "surface.height_map=x.gsf"},
        {"surface.roughness.like_pitch", "surface.roughness.like=x.npy"},
        {"surface.residual", "surface.response=a.csv"},
        {"surface.space.dimension_to", "surface.space.from=[0, 1]"},
        {"ablation.place", "ablation.response=constant", "surface.response=a.csv"},
        {"output.duration", "surface.response=a.csv"},
        {"motion.speed", "motion.duration=null"},
        {"ball.radius", ROLLS, "ball.mass=1 kg"},
        {"ball.mass", ROLLS, "ball.radius=1 cm"},
        {"ball.wall", ROLLS, "ball.radius=1 cm", "ball.body=hollow", "ball.material=glass"},
        {"ball.response", ROLLS, "ball.radius=1 cm", "ball.mass=1 kg"},
        {"contact.roll.stiffness", "contact.model=roll", "scraper=null", "ball.radius=1 cm", "ball.mass=1 kg"},
        {"contact.roll.kappa", "contact.model=roll", "scraper=null", "ball.radius=1 cm", "ball.mass=1 kg"},
        {"contact.roll.static_penetration", "contact.model=roll", "scraper=null", "ball.radius=1 cm", "ball.mass=1 kg"},
        {"contact.strike.speed", STRIKE, "contact.strike.stiffness=1e8"},
        {"contact.strike.stiffness", STRIKE, "contact.strike.speed=1"},
        {"contact.strike.interval", STRIKE, "contact.strike.speed=1", "contact.strike.stiffness=1e8"},
        {"contact.strike.restitution", STRIKE, "contact.strike.speed=1", "contact.strike.stiffness=1e8"},
        {"contact.given.file", GIVEN, "contact.given.scale=1"},
        {"contact.given.scale", GIVEN, "contact.given.file=force.csv"},
        {"contact.given.rate", GIVEN, "contact.given.file=force.npy"},
        {"contact.impacts.prototype", IMPACTS},
        {"contact.impacts.amplitude.mean", IMPACTS, "contact.impacts.prototype=roll"},
        {"contact.impacts.amplitude.deviation", IMPACTS, "contact.impacts.prototype=roll"},
        {"contact.impacts.amplitude.a1", IMPACTS, "contact.impacts.prototype=roll"},
        {"contact.impacts.amplitude.b1", IMPACTS, "contact.impacts.prototype=roll"},
        {"contact.impacts.amplitude.table", IMPACTS, "contact.impacts.prototype=roll",
         "contact.impacts.amplitude.distribution=table"},
        {"contact.impacts.interval.mean", IMPACTS, "contact.impacts.prototype=roll"},
        {"contact.impacts.interval.deviation", IMPACTS, "contact.impacts.prototype=roll"},
        {"contact.impacts.interval.a1", IMPACTS, "contact.impacts.prototype=roll"},
        {"contact.impacts.interval.b1", IMPACTS, "contact.impacts.prototype=roll"},
        {"contact.impacts.interval.table", IMPACTS, "contact.impacts.prototype=roll",
         "contact.impacts.interval.distribution=table"},
        {"contact.impacts.duration.zeta", IMPACTS, "contact.impacts.prototype=roll"},
        {"contact.impacts.duration.theta", IMPACTS, "contact.impacts.prototype=roll"},
        {"contact.impacts.modulation.depth", IMPACTS, "contact.impacts.prototype=roll"},
        {"contact.impacts.modulation.rate", IMPACTS, "contact.impacts.prototype=roll"},
        {"contact.impacts.floor.amplitude", IMPACTS, "contact.impacts.prototype=roll"},
        {"contact.impacts.space.angle_to", IMPACTS, "contact.impacts.prototype=space"},
        {"contact.impacts.space.radius_to", IMPACTS, "contact.impacts.prototype=space"},
        {"contact.impacts.space.walk", IMPACTS, "contact.impacts.prototype=space"},
        {"output.level.dbfs_at_1_pa", "output.listen.places=[[0, 0, 1]]"},
        {"output.stems", "surface.response=a.csv", "scraper.response=b.csv"},
        {"motion.radius", "motion.path=circle", "motion.to=null"},
        {"motion.points", "motion.path=spline", "motion.to=null"},
        {"motion.file", "motion.path=recorded", "motion.to=null"},
        {"motion.profile", "motion.law=given", "motion.duration=null"},
    };
    static const char base[] =
        "rasp: 1\nsurface: {roughness: {}}\nscraper: {mass: 1}\nmotion: {path: line, to: [1, 1], duration: 1}\n"
        "output: {diagnostics: {}}\n";
    a = arena_open();
    for (const struct key *k = keys_table; k->path; k++) {
        const char *value = keys_yaml_example(k->path), *set[12];
        struct scene_overrides over = {.set = set};
        if (!value || !strncmp(k->path, "motion.rate", 11) || !strcmp(k->path, "motion.path") ||
            !strcmp(k->path, "surface.recipe")) /* it would be read */
            continue;
        over.n = with_object(k->path, set);
        set[over.n++] = arena_format(a, "%s=%s", k->path, value);
        for (size_t i = 0; i < sizeof with / sizeof with[0]; i++)
            for (int j = 1; (!strcmp(k->path, with[i][0]) ||
                             (!strncmp(k->path, "ball.object.", 12) && !strcmp(with[i][0], "ball.mass"))) &&
                            with[i][j];
                 j++)
                set[over.n++] = with[i][j];
        must_read(base, "base", &over);
    }
    arena_close(a);
}
END_TEST

START_TEST(test_plain_paths)
{
    ck_assert_str_eq(keys_text_plain("motion.rate"), "motion.rate");
    ck_assert_str_eq(keys_text_plain("contacts.rod.motion.rate"), "motion.rate");
    ck_assert_str_eq(keys_text_plain("contacts.motion.rate"), "motion.rate");
    ck_assert_str_eq(keys_text_plain("contacts.rod"), "rod");
    ck_assert_str_eq(keys_text_plain("contacts"), "contacts");
}
END_TEST

UNIT("new", test_starters_are_scenes, test_what_is_off_is_right_too, test_reference_is_a_scene_with_the_defaults,
     test_reference_has_every_key, test_examples_are_taken, test_plain_paths)
