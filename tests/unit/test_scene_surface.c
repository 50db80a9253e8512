/* Surfaces in scenes: values against each other, and recipes: files of surface keys merged under the scene's own. */
#include "pipeline/stages.h"
#include "scene/params.h"
#include "scene/scene_read.h"
#include "surface/grit.h"
#include "surface/height_map.h"
#include "surface/ridges.h"
#include "surface/roughness.h"

#include <sys/stat.h>

#include "folder.h"
#include "scenes.h"

#define REST "scraper: {mass: 1 g, response: a.csv}\nmotion: {path: line, to: [1 cm, 0], speed: 10 cm/s}\n"

static struct result surface_read(const char *surface)
{
    char text[2048];
    snprintf(text, sizeof text, "rasp: 1\nsurface: %s\n%s", surface, REST);
    return read_with(text, NULL);
}

/* ------------------------------------------------------------------ values */

/* at: what the caret stands under, its first letter being the place. */
static const struct {
    const char *surface, *at, *says, *cure;
} bads[] = {
    {"{}",
     "surface:", "surface.roughness, surface.height_map, surface.ridges, surface.grit or surface.fractal must be given",
     "roughness: {}"},
    {"{roughness: {kurtosis: 2, skewness: 1}}", "1}}",
     "no heights have a skewness of 1 and a kurtosis of 2: it is above skewness^2 + 1, 2", "raise"},
    {"{roughness: {skewness: 2.9}}", "2.9",
     "no heights have a skewness of 2.9 and a kurtosis of 3: it is above skewness^2 + 1, 9.41", "nearer to 0"},
    {"{roughness: {skewness: -1.5, kurtosis: 3.2}}", "3.2", "a kurtosis of 3.2: it is above skewness^2 + 1, 3.25",
     "raise"},
    {"{along: path, roughness: {grain: 5}}", "5}}", "a profile has no grain: it needs surface.along: plane",
     "remove the grain"},
    {"{roughness: {grain: 5}, along: x}", "x}", "a profile has no grain", "plane"},
    {"{roughness: {like: a.gsf, rms: 3 um}}", "rms:",
     "surface.roughness.rms applies only where surface.roughness.like is not given", "remove surface.roughness.like"},
    {"{roughness: {like_pitch: 3 um}}", "like_pitch:",
     "surface.roughness.like_pitch applies only beside surface.roughness.like", "give surface.roughness.like"},
    {"{roughness: {}, continuation: {}}",
     "continuation:", "surface.continuation needs surface.height_map, which it continues", "roughness"},
    {"{height_map: a.gsf, continuation: {from: 7 um}}", "7 um",
     "surface.continuation.shortest must be less than 0.7 times surface.continuation.from (the other is the default",
     "raise from"},
    {"{ridges: {shape: round, width: 0.95 mm}}", "0.95",
     "surface.ridges.width, 0.00095 m, must be at most 0.9 times surface.ridges.spacing, 0.001 m", "raise spacing"},
    {"{ridges: {shape: groove, spacing: 0.1 mm}}", "0.1", "surface.ridges.width, 0.0003 m, must be at most 0.9 times",
     "lower width"},
    {"{ridges: {width: 0.1 mm}}",
     "width:", "surface.ridges.width applies only where surface.ridges.shape is round or groove", "now it is sine"},
    {"{ridges: {shape: square}}", "square", "surface.ridges.shape must be one of: sine, round, groove", "shape: sine"},
    {"{grit: {density: 1e7 m}}", "1e7", "surface.grit.density needs a number per area; m is a unit of length",
     "10 /mm^2"},
    {"{grit: {density: 5 /m}}", "5 /m", "'/m' is not a unit that is known", "/m^2, /cm^2, /mm^2"},
    {"{grit: {density: 0}}", "0}", "surface.grit.density must be from 1 /m^2 to", "grains per area"},
    {"{fractal: {length: 1 mm}}", "1 mm",
     "surface.fractal.length over surface.fractal.pitch is 10, and from 16 to 16777216 heights are offered",
     "lower pitch"},
    {"{fractal: {length: 100 m, pitch: 1 um}}", "1 um", "is 1e+08, and from 16", "lower length"},
    {"{fractal: {}, along: plane}", "plane}", "surface.fractal is a profile, and this surface lies in the plane",
     "to path or x"},
    {"{fractal: {}, ridges: {}}", "fractal:", "surface.fractal is a profile, and this surface lies in the plane",
     "to path or x"},
    {"{fractal: {interpolation: linear}}", "linear",
     "surface.fractal.interpolation must be spline where the scraper is a point", "give scraper.radius"},
    {"{fractal: {spectrum: energy}}", "energy", "surface.fractal.spectrum must be one of: power, amplitude",
     "spectrum: power"},
    {"{height_range: 1 um, roughness: {}}",
     "height_range:", "surface.height_range applies only beside surface.height_map", "give surface.height_map"},
    {"{height_map: a.gsf, holes: ignore}", "ignore", "surface.holes must be one of: refuse, fill", "holes: refuse"},
    {"{height_map: a.gsf, levelling: tilt}", "tilt", "surface.levelling must be one of: none, mean, plane",
     "levelling: none"},
    {"{roughness: {longest: 1 m, shortest: 1 um}}", "1 um",
     "surface.roughness.longest is 1e+06 times surface.roughness.shortest", "raise shortest"},
    {"{roughness: {}, recipe: [a]}", "[a]", "surface.recipe must be a file name, not a list", "rough.yaml"},
};

START_TEST(test_bad)
{
    for (size_t i = 0; i < sizeof bads / sizeof bads[0]; i++) {
        char start[64], line[256];
        struct result r = surface_read(bads[i].surface);
        snprintf(line, sizeof line, "surface: %s", bads[i].surface);
        snprintf(start, sizeof start, "scenes/t.yaml:2:%d: error: ", (int)(strstr(line, bads[i].at) - line) + 1);
        one_error(&r, start, bads[i].says, bads[i].cure);
        arena_close(r.arena);
    }
}
END_TEST

START_TEST(test_good)
{
    static const char *const goods[] = {
        "{grit: {}}",
        "{ridges: {shape: round, width: 0.9 mm}}",
        "{height_map: a.gwy}",
        "{height_map: a.gsf, continuation: {}, roughness: {}, ridges: {}, grit: {}}",
        "{roughness: {like: a.gsf, like_pitch: 1 um, grain: 3}}",
        "{roughness: {skewness: -1, kurtosis: 2.01}}",
        "{roughness: {grain: 1}, along: path}",
        "{roughness: {grain: 7, grain_direction: 30 deg}, along: plane, origin: [1 cm, 1 cm]}",
    };
    for (size_t i = 0; i < sizeof goods / sizeof goods[0]; i++) {
        struct result r = surface_read(goods[i]);
        ck_assert_msg(r.good, "%s:\n%s", goods[i], r.messages);
        arena_close(r.arena);
    }
    struct result r = surface_read("{roughness: {like: a.gsf}, grit: {density: 12.5 /mm^2}}");
    const struct roughness *rough = params_of(r.scene.contacts, roughness_stage.params);
    const struct grit *grit = params_of(r.scene.contacts, grit_stage.params);
    ck_assert(isnan(rough->rms) && isnan(rough->exponent) && isnan(rough->shortest) && grit->density == 12.5e6);
    arena_close(r.arena);
}
END_TEST

/* ------------------------------------------------------------------ recipes */

static struct result read_file(const char *name, const char *const *set)
{
    struct result r = {.arena = arena_open()};
    struct scene_overrides over = {.set = (const char **)set};
    while (set && set[over.n])
        over.n++;
    r.good = scene_read(folder_path(name), &over, r.arena, &r.scene, &r.messages, &r.err);
    return r;
}

static void make_files(void)
{
    folder_make();
    ck_assert_int_eq(mkdir(folder_path("sub"), 0700), 0);
    folder_write("sub/paper.yaml",
                 "title: sandpaper\nsource: made up\nroughness: {rms: 2 um, exponent: -3, like: null}\n"
                 "grit: {density: 30 /mm^2, height: 50 um}\nresponse: table.csv\n");
    folder_write("sub/map.yaml", "height_map: map.gsf\nroughness: {like: like.gsf}\n");
    folder_write("sub/wood.yaml", "ridges: {spacing: 2 mm}\n");
    folder_write("sub/plank.yaml", "material: poplar\nobject: {shape: plate, length: 30 cm, width: 10 cm, thickness: 5 "
                                   "mm}\nroughness: {rms: 2 um}\n");
    folder_write("sub/plank_wrong.yaml",
                 "roughness: {}\nmaterial: poplar\nobject: {shape: plate, length: 30 cm, width: 10 cm}\n");
    folder_write("sub/wrong.yaml", "title: x\n\nroughness: {rms: 3 g}\n");
    folder_write("sub/unknown.yaml", "roughnes: {}\ngrit: {}\n");
    folder_write("sub/nested.yaml", "grit: {}\nrecipe: paper.yaml\n");
    folder_write("sub/scene.yaml", "surface: {grit: {}}\n");
    folder_write("sub/list.yaml", "- grit\n");
    folder_write("sub/syntax.yaml", "grit: {\n");
    folder_write("sub/title.yaml", "title: [a]\ngrit: {}\n");
    folder_write("sub/empty.yaml", "title: nothing\n");
    folder_write("sub/bare.yaml", "# nothing\n");
    folder_write("one.yaml",
                 "rasp: 1\nsurface: {recipe: sub/paper.yaml, roughness: {rms: 5 um}, grit: {height: 20 um}}\n" REST);
    folder_write("base.yaml", "rasp: 1\nsurface: {recipe: sub/paper.yaml}\n" REST);
    folder_write("sub/including.yaml", "include: [../base.yaml]\nsurface: {grit: ~}\n");
    folder_write("several.yaml", "rasp: 1\ncontacts:\n"
                                 "- {name: a, surface: {recipe: sub/paper.yaml}, scraper: {mass: 1}, motion: {path: "
                                 "line, to: [1, 0], speed: 1}}\n"
                                 "- {name: b, surface: {recipe: sub/wood.yaml}, scraper: {mass: 1, response: a.csv}, "
                                 "motion: {path: line, to: [1, 0], speed: 1}}\n");
}

START_TEST(test_recipe)
{
    make_files();
    struct result r = read_file("one.yaml", NULL);
    const struct surface *s = &r.scene.contacts->surface;
    const struct grit *grit = params_of(r.scene.contacts, grit_stage.params);
    const struct roughness *rough = params_of(r.scene.contacts, roughness_stage.params);
    ck_assert_msg(r.good, "%s", r.messages);
    ck_assert(rough->rms == 5e-6 && rough->exponent == -3 && grit->given && grit->density == 30e6 &&
              grit->height == 20e-6);
    ck_assert(grit->diameter == 125e-6 && !params_given(r.scene.contacts, ridges_stage.params));
    ck_assert_str_eq(s->recipe, folder_path("sub/paper.yaml"));
    ck_assert_str_eq(s->response.file, folder_path("sub/table.csv"));
    arena_close(r.arena);
    r = read_file("sub/including.yaml", NULL); /* the recipe is seen from the file that names it */
    ck_assert_msg(r.good, "%s", r.messages);
    rough = params_of(r.scene.contacts, roughness_stage.params);
    ck_assert(rough->rms == 2e-6 && !params_given(r.scene.contacts, grit_stage.params));
    arena_close(r.arena);
    char set[256];
    snprintf(set, sizeof set, "surface.recipe=%s",
             folder_path("sub/plank.yaml")); /* an object is as much of a surface as a response file */
    r = read_file("base.yaml", SET(set, "surface.object.length=20 cm"));
    ck_assert_msg(r.good, "%s", r.messages);
    const struct object_given *o = &r.scene.contacts->surface.response.object;
    ck_assert(o->given && o->length == 0.2 && o->width == 0.1 && o->material == MATERIAL_POPLAR);
    arena_close(r.arena);
    r = read_file("base.yaml", SET(set, "surface.response=a.csv", "surface.object=null"));
    ck_assert_msg(r.good, "%s", r.messages);
    ck_assert(!r.scene.contacts->surface.response.object.given);
    arena_close(r.arena);
    r = read_file("several.yaml", NULL);
    ck_assert_msg(r.good, "%s", r.messages);
    ck_assert(params_given(&r.scene.contacts[0], grit_stage.params) &&
              !params_given(&r.scene.contacts[0], ridges_stage.params));
    ck_assert(((const struct ridges *)params_of(&r.scene.contacts[1], ridges_stage.params))->spacing == 2e-3 &&
              !params_given(&r.scene.contacts[1], roughness_stage.params));
    arena_close(r.arena);
    folder_remove();
}
END_TEST

START_TEST(test_recipe_set)
{
    char set[256], set_b[256];
    make_files();
    snprintf(set, sizeof set, "surface.recipe=%s", folder_path("sub/map.yaml"));
    struct result r = read_file(
        "base.yaml",
        SET(set, "surface.height_map=mine.gsf")); /* a name on the command line is seen from the current folder */
    ck_assert_msg(r.good, "%s", r.messages);
    ck_assert_str_eq(((const struct height_map_file *)params_of(r.scene.contacts, height_map_stage.params))->path,
                     "mine.gsf");
    const struct roughness *rough = params_of(r.scene.contacts, roughness_stage.params);
    ck_assert_str_eq(rough->like, folder_path("sub/like.gsf"));
    arena_close(r.arena);
    snprintf(set_b, sizeof set_b, "contacts.b.surface.recipe=%s", folder_path("sub/paper.yaml"));
    r = read_file("several.yaml", SET(set_b, "contacts.a.surface={recipe: null, ridges: {}, response: x.csv}"));
    ck_assert_msg(r.good, "%s", r.messages);
    ck_assert(params_given(&r.scene.contacts[1], grit_stage.params) &&
              !params_given(&r.scene.contacts[1], ridges_stage.params) &&
              params_given(&r.scene.contacts[0], ridges_stage.params));
    ck_assert(!params_given(&r.scene.contacts[0], grit_stage.params) && !r.scene.contacts[0].surface.recipe);
    arena_close(r.arena);
    folder_remove();
}
END_TEST

START_TEST(test_bad_recipe)
{
    static const struct {
        const char *recipe, *at, *place, *says, *cure;
        enum err_kind kind;
    } rows[] = {
        {"sub/wrong.yaml", "sub/wrong.yaml",
         ":3:18: error: ", "surface.roughness.rms needs a length; g is a unit of mass", "3 cm", ERR_SCENE},
        {"sub/unknown.yaml", "sub/unknown.yaml", ":1:1: error: ", "unknown key 'roughnes' in surface",
         "did you mean 'roughness'?", ERR_SCENE},
        {"sub/nested.yaml", "sub/nested.yaml", ":2:1: error: ", "a recipe must not name a recipe itself", "one file",
         ERR_SCENE},
        {"sub/scene.yaml", "sub/scene.yaml", ":1:1: error: ", "unknown key 'surface' in a recipe",
         "what stands under surface", ERR_SCENE},
        {"sub/list.yaml", "sub/list.yaml", ":1:1: error: ", "a recipe must be a map of keys, not a list",
         "roughness: {rms: 4 um}", ERR_SCENE},
        {"sub/syntax.yaml", "sub/syntax.yaml", ":2:1: error: ", "not valid YAML", "brackets", ERR_SCENE},
        {"sub/title.yaml", "sub/title.yaml", ":1:8: error: ", "title must be a text, not a list", "title:", ERR_SCENE},
        {"sub/bare.yaml", "sub/bare.yaml", ": error: ", "there is nothing in it", "", ERR_SCENE},
        {"sub/plank_wrong.yaml", "sub/plank_wrong.yaml",
         ":3:1: error: ", "surface.object.thickness is missing: a plate has one", "thickness: 5 mm", ERR_SCENE},
        {"sub/none.yaml", "t.yaml", ":2:19: error: ", "none.yaml': No such file", "relative to that file's folder",
         ERR_INPUT},
        {"sub", "t.yaml", ":2:19: error: ", "': Is a directory", "", ERR_INPUT},
        {"sub/empty.yaml", "t.yaml", ":2:1: error: ",
         "surface.roughness, surface.height_map, surface.ridges, surface.grit or surface.fractal must be given", "",
         ERR_SCENE},
    };
    make_files();
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char start[256], text[512];
        snprintf(text, sizeof text, "rasp: 1\nsurface: {recipe: %s}\n" REST, rows[i].recipe);
        folder_write("t.yaml", text);
        struct result r = read_file("t.yaml", NULL);
        snprintf(start, sizeof start, "%s%s", folder_path(rows[i].at), rows[i].place);
        one_error(&r, start, rows[i].says, rows[i].cure);
        ck_assert_int_eq(r.err.kind, rows[i].kind);
        arena_close(r.arena);
    }
    folder_remove();
}
END_TEST

/* Faults of the scene and of its recipe are told together; a recipe that is not there makes nothing else seem wrong. */
START_TEST(test_recipe_and_scene_at_once)
{
    make_files();
    folder_write("t.yaml", "rasp: 1\nsurface: {recipe: sub/wrong.yaml, grit: {spread: 3}}\n" REST);
    struct result r = read_file("t.yaml", NULL);
    ck_assert_msg(strstr(r.messages, "t.yaml:2:50: error: surface.grit.spread must be from 0 to 1") &&
                      strstr(r.messages, "wrong.yaml:3:18: error: ") && strstr(r.messages, "\n2 errors\n"),
                  "%s", r.messages);
    arena_close(r.arena);
    folder_write("t.yaml", "rasp: 1\nsurface: {recipe: sub/none.yaml, pitch: 1 um, continuation: {}}\ntitel: x\n" REST);
    r = read_file("t.yaml", NULL);
    ck_assert_msg(strstr(r.messages, "none.yaml': No such file") && strstr(r.messages, "unknown key 'titel'") &&
                      strstr(r.messages, "\n2 errors\n"),
                  "%s", r.messages);
    ck_assert_int_eq(r.err.kind, ERR_INPUT);
    arena_close(r.arena);
    folder_remove();
}
END_TEST

UNIT("scene_surface", test_bad, test_good, test_recipe, test_recipe_set, test_bad_recipe, test_recipe_and_scene_at_once)
