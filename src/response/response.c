/* How bodies ring: what an object of simple shape needs, readings of a response that moves, and the engines that can do
 * them. */
#include "response/response.h"

#include <math.h>
#include <string.h>

#include "scene/rows.h"
#include "scene/scene_part.h"
#include "trajectory/contact.h"

struct body {
    const struct scene_part *part;
    struct arena *arena;
    const struct response *response;
    const char *name;
};

static const char *path_of(const struct body *b, const char *key)
{
    return arena_format(b->arena, "%s.%s", b->name, key);
}

static const char *label_of(const struct body *b, const char *key)
{
    return scene_part_label(b->part, path_of(b, key));
}

static const char *word(const struct body *b, const char *key, int value)
{
    return keys_find(path_of(b, key))->choices[value].word;
}

static bool known(const struct body *b, const char *key) { return scene_part_known(b->part, path_of(b, key)); }

static const char *leave_out(const struct body *b, const char *key, const char *instead)
{
    return arena_format(b->arena, "leave %s out, or set it to %s", path_of(b, key), instead);
}

/* ------------------------------------------------------------------ an object */

static void needs(const struct body *b, const char *key, const char *example)
{
    const char *material = path_of(b, "material");
    const char *value = arena_format(b->arena, "%s; or name a material, such as %s: steel", example, material);
    scene_part_missing(b->part, path_of(b, key), value,
                       arena_format(b->arena, ": %s is custom", scene_part_label(b->part, material)));
}

/* Sizes, edges and constants that its shape needs. */
static void object_check(const struct body *b)
{
    const struct object_given *o = &b->response->object;
    if (!o->given || !known(b, "object.shape")) return;
    const char *thickness = path_of(b, "object.thickness"), *edges = path_of(b, "object.edges"),
               *shape = path_of(b, "object.shape"), *is = word(b, "object.shape", o->shape);
    bool plate = o->shape == OBJECT_PLATE || o->shape == OBJECT_DISK, rod = o->shape == OBJECT_ROD,
         stretched = o->shape == OBJECT_STRING || o->shape == OBJECT_MEMBRANE || o->shape == OBJECT_DRUM;
    if (o->shape != OBJECT_STRING && !rod)
        scene_part_missing(b->part, thickness, "5 mm", arena_format(b->arena, ": a %s has one", is));
    if ((rod || o->shape == OBJECT_SHELL) && 2 * o->thickness >= o->diameter)
        scene_part_refuse(b->part, thickness, path_of(b, "object.diameter"),
                          rod ? "lower thickness; a rod without one is solid" : "lower thickness",
                          ", %.4g m, must be less than half of %s, %.4g m", o->thickness,
                          label_of(b, "object.diameter"), o->diameter);
    if (o->edges == EDGES_CANTILEVER && plate && scene_part_known(b->part, edges))
        scene_part_refuse(b->part, edges, shape, "edges here: free, supported, clamped",
                          " must not be cantilever where %s is %s: only bars and rods have one end",
                          label_of(b, "object.shape"), is);
    if (o->material == MATERIAL_CUSTOM && known(b, "material")) {
        needs(b, "object.density", "650 kg/m^3");
        if (!stretched) needs(b, "object.youngs_modulus", "12 GPa");
        if (plate || o->shape == OBJECT_SHELL) needs(b, "object.poisson", "0.35");
    }
    /* nu_x nu_y = nu_x^2 E_y / E_x is below 1 in whatever does not fall apart. */
    double coupling = o->poisson * o->poisson * o->youngs_modulus_across / o->youngs_modulus;
    if (coupling >= 1)
        scene_part_refuse(
            b->part, path_of(b, "object.poisson"), path_of(b, "object.youngs_modulus_across"),
            "lower poisson or youngs_modulus_across",
            ": poisson^2 x youngs_modulus_across / youngs_modulus is %.4g, and is below 1 in every material", coupling);
}

/* ------------------------------------------------------------------ readings and engines */

/* Does it glide: because that is asked for, or because a place in the space of materials that travels does? */
static bool glides(const struct response *r)
{
    return r->moving == MOVING_GLIDE || (r->moving == MOVING_AUTO && response_travels(&r->space));
}

/* What has no modes. */
static void recorded_check(const struct body *b)
{
    const struct response *r = b->response;
    const char *engine = path_of(b, "convolution"), *moving = path_of(b, "moving"), *file = path_of(b, "response"),
               *shown = diag_shown(b->part->yaml->diag, r->file);
    if (r->convolution == ENGINE_RESONATORS)
        scene_part_refuse(b->part, engine, file, leave_out(b, "convolution", "overlap_add"),
                          ": %s need a mode table (.csv) as %s, not '%s'", word(b, "convolution", r->convolution),
                          label_of(b, "response"), shown);
    if (r->moving != MOVING_AUTO && r->moving != MOVING_LAUNCH)
        scene_part_refuse(b->part, moving, file, leave_out(b, "moving", "launch"),
                          ": %s needs modes, and '%s' is recorded", word(b, "moving", r->moving), shown);
}

static void reading_check(const struct body *b)
{
    const struct response *r = b->response;
    int asked = r->convolution;
    const char *engine = path_of(b, "convolution"), *moving = path_of(b, "moving"),
               *length = path_of(b, "response_length");
    bool readout = r->moving == MOVING_READOUT, resonators = asked == ENGINE_RESONATORS,
         clash = (glides(r) && asked == ENGINE_OVERLAP_ADD) || (readout && resonators);
    if (r->moving == MOVING_FIXED && response_travels(&r->space) && known(b, "moving"))
        scene_part_refuse(b->part, moving, path_of(b, "space"),
                          "leave surface.moving out, or set it to launch, glide or readout",
                          ": fixed needs an object that stays what it is, and %s travels", label_of(b, "space"));
    if (clash)
        scene_part_refuse(b->part, engine, moving, leave_out(b, "convolution", readout ? "overlap_add" : "resonators"),
                          ": %s cannot do %s: %s%s", word(b, "convolution", asked), label_of(b, "moving"),
                          glides(r) ? "glide" : "readout",
                          r->moving == MOVING_AUTO ? ", which is auto where surface.space travels" : "");
    if (isnan(r->length) || response_is_recorded(r)) return;
    if (resonators)
        scene_part_refuse(b->part, engine, length,
                          arena_format(b->arena, "leave %s out, or set %s to overlap_add", length, engine),
                          ": resonators ring on for ever, and %s cannot cut them", label_of(b, "response_length"));
    else if (glides(r))
        scene_part_refuse(b->part, moving, length,
                          arena_format(b->arena, "leave %s out, or set %s to launch", length, moving),
                          ": what glides rings on for ever, and %s cannot cut it", label_of(b, "response_length"));
}

static void gammatone_check(const struct body *b)
{
    const struct response *r = b->response;
    const char *path = path_of(b, "gammatone"), *file = path_of(b, "response"), *moving = path_of(b, "moving");
    if (r->gammatone < 2) /* 0: the model is not known, so it is not either */
        return;
    if (response_is_recorded(r))
        scene_part_refuse(b->part, path, file, arena_format(b->arena, "leave %s out", path),
                          " needs a mode table (.csv) as %s, not '%s'", label_of(b, "response"),
                          diag_shown(b->part->yaml->diag, r->file));
    else if (!response_given(r))
        scene_part_refuse(
            b->part, path, path,
            arena_format(b->arena, "give %s (a mode table) or %s, or leave %s out", file, path_of(b, "object"), path),
            " is %d, and nothing rings", r->gammatone);
    else if (glides(r))
        scene_part_refuse(b->part, path, moving,
                          arena_format(b->arena, "set %s to launch or readout, or leave %s out", moving, path),
                          " is %d, and what glides begins at once: %s is glide%s", r->gammatone, label_of(b, "moving"),
                          r->moving == MOVING_AUTO ? ", which is auto where surface.space travels" : "");
}

static void body_check(const struct scene_part *p, const char *name, const struct response *r)
{
    const struct body b = {p, p->yaml->arena, r, name};
    object_check(&b);
    if (!response_given(r) || known(&b, "convolution")) gammatone_check(&b);
    if (!response_given(r) || !known(&b, "convolution")) return;
    if (response_is_recorded(r)) recorded_check(&b);
    reading_check(&b);
}

/* ------------------------------------------------------------------ what is heard */

/* Is the body called as this model calls it? */
static bool sound_named(const struct scene_part *p, const struct contact *c)
{
    static const char *const bodies[2] = {"scraper", "ball"};
    const char *path = "ablation.sound", *tool = contact_tool(c);
    int word = c->ablation.sound - ABLATED_SOUND_SCRAPER;
    if (word < 0 || !scene_part_known(p, "contact.model") || !strcmp(bodies[word], tool)) return true;
    scene_part_refuse(p, path, "contact.model", arena_format(p->yaml->arena, "write %s: %s", path, tool),
                      " is %s, and what touches the surface here is called %s", bodies[word], tool);
    return false;
}

static void silence_check(const struct scene_part *p, const struct contact *c)
{
    const char *path = "ablation.sound", *body = contact_mutes_surface(c) ? contact_tool(c) : "surface";
    bool responds =
        response_given(&c->surface.response) || (response_given(&c->scraper.response) && c->scraper.weight != 0);
    if (responds && !response_rings(c) && scene_part_known(p, path))
        scene_part_refuse(p, path, path,
                          arena_format(p->yaml->arena, "give %s.response%s, or leave ablation.sound out", body,
                                       contact_mutes_surface(c) ? " and a weight above 0" : ""),
                          " is %s, which does not ring: nothing would be heard", body);
}

static void response_check(const struct scene_part *p, const struct contact *c, const void *own)
{
    (void)own;
    body_check(p, "surface", &c->surface.response);
    body_check(p, contact_tool(c), &c->scraper.response);
    if (sound_named(p, c)) silence_check(p, c);
}

/* ------------------------------------------------------------------ keys */

static const struct choice engines[] = {
    [ENGINE_AUTO] = {"auto", "resonators; overlap_add for what is recorded, cut by response_length or read out, and "
                             "for gammatones that are launched"},
    [ENGINE_RESONATORS] = {"resonators", "one exact recursion per mode; of launch, at nodes along the motion"},
    [ENGINE_OVERLAP_ADD] = {"overlap_add", "fast convolution with impulse responses that overlap along the motion"},
    {NULL, NULL}};

static const struct choice movings[] = {
    [MOVING_AUTO] =
        {"auto",
         "fixed where the poles are the same everywhere, launch where they differ; glide in the space of materials"},
    [MOVING_FIXED] = {"fixed", "the object keeps its poles; the place decides how strongly each mode is driven"},
    [MOVING_LAUNCH] = {"launch",
                       "every force sample launches the response of its own place, which then rings as it is"},
    [MOVING_GLIDE] = {"glide", "the contact changes the object: all that rings is retuned"},
    [MOVING_READOUT] = {"readout", "all past force is heard through the response of the present place"},
    {NULL, NULL}};

static const struct choice outsides[] = {[EXTRAPOLATE_ERROR] = {"error", "is refused"},
                                         [EXTRAPOLATE_NEAREST] = {"nearest", "rings as at the nearest place"},
                                         {NULL, NULL}};

static const struct choice shapes[] = {
    [OBJECT_BAR] = {"bar", "a slender bar of rectangular section"},
    [OBJECT_ROD] = {"rod", "a slender rod of round section, solid or a tube"},
    [OBJECT_STRING] = {"string", "a stretched string with stiffness"},
    [OBJECT_PLATE] = {"plate", "a thin rectangular plate, isotropic or orthotropic"},
    [OBJECT_DISK] = {"disk", "a thin circular plate"},
    [OBJECT_MEMBRANE] = {"membrane", "a stretched rectangular membrane"},
    [OBJECT_DRUM] = {"drum", "a stretched circular membrane"},
    [OBJECT_SHELL] = {"shell", "a thin closed spherical shell, touched from outside"},
    {NULL, NULL}};

static const struct choice waves[] = {
    [WAVES_BENDING] = {"bending", "it bends"},
    [WAVES_LONGITUDINAL] = {"longitudinal", "it is stretched and compressed along its length"},
    {NULL, NULL}};

static const struct choice edges[] = {
    [EDGES_FREE] = {"free", "free all round"},
    [EDGES_SUPPORTED] = {"supported", "simply supported: held in place, free to turn"},
    [EDGES_CLAMPED] = {"clamped", "held in place and direction"},
    [EDGES_CANTILEVER] = {"cantilever", "clamped at x = 0, else free"},
    {NULL, NULL}};

static const struct choice materials[] = {
    [MATERIAL_CUSTOM] = {"custom", "what object.youngs_modulus, density, ... say"},
    [MATERIAL_BASSWOOD] = {"basswood", "American basswood"},
    [MATERIAL_POPLAR] = {"poplar", "yellow-poplar"},
    [MATERIAL_OAK] = {"oak", "northern red oak"},
    [MATERIAL_PVC] = {"pvc", "rigid PVC"},
    [MATERIAL_POLYCARBONATE] = {"polycarbonate", "polycarbonate"},
    [MATERIAL_ACRYLIC] = {"acrylic", "PMMA"},
    [MATERIAL_GLASS] = {"glass", "soda-lime glass"},
    [MATERIAL_CERAMIC] = {"ceramic", "porcelain stoneware"},
    [MATERIAL_STEEL] = {"steel", "structural steel"},
    [MATERIAL_ALUMINIUM] = {"aluminium", "aluminium alloy"},
    {NULL, NULL}};

/* What surface, scraper and ball share: paths and conditions follow the body's name. */
static const struct key body_keys[] = {
    {ROW_COUNT(response, modes, ".modes"), KEY_NONE, 1, 100000, "50", NULL, "how many of the strongest modes ring"},
    {ROW_RANGE(response, band, ".band"), KEY_FREQUENCY, 0, 1e6, "[20 Hz, 20 kHz]", NULL,
     "frequencies between which the strongest modes are chosen, whatever the sample rate. The lower end counts, "
     "the upper does not. Of objects undamped frequencies count; where poles differ from place to place, a mode "
     "counts that somewhere lies inside. What is chosen and nowhere lies below 0.45 of the sample rate does not "
     "ring, and is counted in a warning"},
    {ROW_COUNT(response, gammatone, ".gammatone"), KEY_NONE, 1, 4, "1", NULL,
     "gamma: each mode begins like t^(gamma - 1), its envelope scaled to the same greatest value; 2 is the softer "
     "onset of Hermes for what rolls (Conan et al. 2014a, section II-B); 1: at once"},
    {ROW_TIME_OR_AUTO(response, length, ".response_length"), KEY_TIME, 1e-4, 60, "auto", NULL,
     "t0, at which the impulse response is cut off. With auto what rings is heard until the sound ends. But what "
     "launch lets ring is dropped at -180 dB, and what overlap_add computes ends at -140 dB or after 60 s"},
    {ROW_CHOICE(response, convolution, ".convolution"), KEY_NONE, 0, 0, "auto", NULL, "how force becomes sound",
     engines},
    {ROW_CHOICE(response, object.material, ".material"), KEY_NONE, 0, 0, "custom", NULL,
     "what it is made of: gives the object's elastic constants, density and damping where its own keys do not",
     materials},
    {ROW_CHOICE(response, object.shape, ".object.shape"), KEY_NONE, 0, 0, NULL, NULL, "shape of the object", shapes,
     .shown = "plate"},
    {ROW_CHOICE(response, object.waves, ".object.waves"), KEY_NONE, 0, 0, "bending", ".object.shape=bar|rod",
     "which of its motions sounds", waves},
    {ROW_CHOICE(response, object.edges, ".object.edges"), KEY_NONE, 0, 0, "free", ".object.shape=bar|rod|plate|disk",
     "how its ends or edges are held", edges},
    {ROW_NUMBER(response, object.length, ".object.length"), KEY_LENGTH, 1e-3, 100, NULL,
     ".object.shape=bar|rod|string|plate|membrane", "length along x", .shown = "30 cm"},
    {ROW_NUMBER(response, object.width, ".object.width"), KEY_LENGTH, 1e-4, 100, NULL,
     ".object.shape=bar|plate|membrane", "width along y", .shown = "20 cm"},
    {ROW_NUMBER(response, object.diameter, ".object.diameter"), KEY_LENGTH, 1e-5, 100, NULL,
     ".object.shape=rod|string|disk|drum|shell", "outer diameter", .shown = "10 cm"},
    {ROW_NUMBER(response, object.thickness, ".object.thickness"), KEY_LENGTH, 1e-6, 1, "",
     ".object.shape=bar|rod|plate|disk|membrane|drum|shell",
     "thickness; of a rod that of its wall (left out: it is solid); all others need it", .shown = "5 mm"},
    {ROW_NUMBER(response, object.tension, ".object.tension"), KEY_FORCE, 1e-3, 1e7, NULL, ".object.shape=string",
     "tension of a string", .shown = "80 N"},
    {ROW_NUMBER(response, object.surface_tension, ".object.surface_tension"), KEY_FORCE_PER_LENGTH, 1e-3, 1e7, NULL,
     ".object.shape=membrane|drum", "tension of a membrane, per length of its edge", .shown = "2 kN/m"},
    {ROW_NUMBER(response, object.youngs_modulus, ".object.youngs_modulus"), KEY_PRESSURE, 1e4, 1e13, "", NULL,
     "Young's modulus, along x; left out: the material's", .shown = "12 GPa"},
    {ROW_NUMBER(response, object.youngs_modulus_across, ".object.youngs_modulus_across"), KEY_PRESSURE, 1e4, 1e13, "",
     ".object.shape=plate", "Young's modulus along y of an orthotropic plate; left out: the material's",
     .shown = "0.8 GPa"},
    {ROW_NUMBER(response, object.shear_modulus, ".object.shear_modulus"), KEY_PRESSURE, 1e4, 1e13, "",
     ".object.shape=plate", "shear modulus in the plane of an orthotropic plate; left out: the material's",
     .shown = "0.9 GPa"},
    {ROW_NUMBER(response, object.poisson, ".object.poisson"), KEY_NONE, -0.99, 0.499, "", NULL,
     "Poisson's ratio (along x); left out: the material's", .shown = "0.35"},
    {ROW_NUMBER(response, object.density, ".object.density"), KEY_DENSITY, 1, 1e5, "", NULL,
     "density; left out: the material's", .shown = "650 kg/m^3"},
    {ROW_NUMBER(response, object.alpha, ".object.alpha"), KEY_PER_TIME, 0, 1e6, "", NULL,
     "Rayleigh damping in proportion to mass (C = alpha M + beta K); left out: the material's", .shown = "10 1/s"},
    {ROW_NUMBER(response, object.beta, ".object.beta"), KEY_TIME, 0, 1, "", NULL,
     "Rayleigh damping in proportion to stiffness; left out: the material's", .shown = "0.1 us"},
    {ROW_NUMBER(response, object.loss, ".object.loss"), KEY_NONE, 0, 1, "", NULL,
     "loss factor; left out: the material's", .shown = "0.01"},
    {.path = NULL}};

#define BODY(name, condition)                                                                                          \
    {                                                                                                                  \
        .section = #name ".object",                                                                                    \
        .meaning = "an object of simple shape, whose modes are computed from its size and material",                   \
        .flag = offsetof(struct response, object.given), .keys = body_keys, .body = #name,                             \
        .base = offsetof(struct contact, name.response), .when = condition                                             \
    }

#define SCRAPES "contact.model=scrape|strike|given|impacts|playback"
#define ROLLS "contact.model=roll|roll_coupled"

const struct params response_of_surface_params = BODY(surface, NULL);
const struct params response_of_scraper_params = BODY(scraper, SCRAPES);
const struct params response_of_ball_params = BODY(ball, ROLLS);

static const struct key surface_keys[] = {
    {ROW_FILE(contact, surface.response.file, "surface.response"), KEY_NONE, 0, 0, "", NULL,
     "how the surface's object rings: a mode table (CSV), an impulse response (WAV), or a folder of impulse responses "
     "with an index.csv of their places",
     .shown = "plank.csv"},
    {ROW_PLACE("surface.object")},
    {ROW_POINT(contact, surface.response.object.origin, "surface.object.origin"), KEY_LENGTH, -100, 100, "[0 m, 0 m]",
     NULL,
     "where the object's own x = y = 0 lies in the scene: a corner of a plate, bar or membrane, the centre of what is "
     "round"},
    {ROW_CHOICE(contact, surface.response.moving, "surface.moving"), KEY_NONE, 0, 0, "auto", NULL,
     "what it means that the response depends on the place of a contact that moves", movings},
    {ROW_NUMBER(contact, surface.response.pairing, "surface.pairing"), KEY_NONE, 0, 0.5, "0.03", NULL,
     "largest relative difference of frequencies at which modes of two places may be one and the same, in a table "
     "whose modes are not named alike everywhere"},
    {ROW_CHOICE(contact, surface.response.extrapolate, "surface.extrapolate"), KEY_NONE, 0, 0, "error", NULL,
     "what a contact outside the response's places does", outsides},
    {.path = NULL}};

const struct params response_params = {
    .section = "surface.response",
    .keys = surface_keys,
    .alternative = {.most = 1, .paths = {"surface.response", "surface.object", "surface.space"}},
    .check = response_check};

static const struct key scraper_keys[] = {
    {ROW_FILE(contact, scraper.response.file, "scraper.response"), KEY_NONE, 0, 0, "", SCRAPES,
     "how the scraper rings: a mode table (CSV; of several places the first along their line is used) or an impulse "
     "response (WAV); without it the scraper is silent",
     .shown = "tool.csv"},
    {ROW_PLACE("scraper.object")},
    {ROW_POINT(contact, scraper.response.object.at, "scraper.object.at"), KEY_LENGTH, -100, 100, "[0 m, 0 m]", SCRAPES,
     "where on the scraper's object the contact is, in the object's own coordinates"},
    {.path = NULL}};

const struct params response_scraper_params = {
    .section = "scraper.response",
    .keys = scraper_keys,
    .alternative = {.most = 1, .paths = {"scraper.response", "scraper.object"}}};

static const struct key ball_keys[] = {
    {ROW_FILE(contact, ball.response.file, "ball.response"), KEY_NONE, 0, 0, "", ROLLS,
     "how the ball rings: a mode table (CSV; of several places the first along their line is used) or an impulse "
     "response (WAV); without it the ball is silent",
     .shown = "ball.csv"},
    {ROW_PLACE("ball.object")},
    {ROW_POINT(contact, ball.response.object.at, "ball.object.at"), KEY_LENGTH, -100, 100, "[0 m, 0 m]", ROLLS,
     "where on the ball's object the contact is, in the object's own coordinates"},
    {.path = NULL}};

const struct params response_ball_params = {.section = "ball.response",
                                            .keys = ball_keys,
                                            .alternative = {.most = 1, .paths = {"ball.response", "ball.object"}}};
