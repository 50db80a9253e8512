/* Mass and moment of inertia of what rolls, R its outer radius, h the wall's thickness, q = (R - h) / R:

     solid ball    m = 4/3 pi R^3 rho              I = 2/5 m R^2
     hollow ball   m = 4/3 pi R^3 (1 - q^3) rho    I = 2/5 m R^2 (1 - q^5) / (1 - q^3), 2/3 m R^2 of a thin wall
     hoop          m given                         I = m R^2
     wheel         m given                         I = 1/2 m R^2 */
#include "trajectory/contact.h"

#include <math.h>
#include <string.h>

#include "num/real.h"
#include "scene/keys.h"
#include "scene/material.h"
#include "scene/rows.h"
#include "scene/scene_part.h"

static double density(const struct object_given *o)
{
    const struct material *m = material_given(o);
    return !isnan(o->density) || !m ? o->density : m->density;
}

/* (1 - q^n) for q = 1 - w: the sum w (1 + q + q^2 + ...), which keeps its digits for thin walls. */
static double shell(double w, int n)
{
    double q = 1 - w, sum = 0, power = 1;
    for (int i = 0; i < n; i++, power *= q)
        sum += power;
    return w * sum;
}

/* kg; NAN where it is neither given nor follows from radius, wall and the material's (or object's) density. */
static double ball_mass(const struct ball *b)
{
    double filled = b->body == BODY_SOLID                           ? 1
                    : b->body == BODY_HOLLOW && b->wall < b->radius ? shell(b->wall / b->radius, 3)
                                                                    : NAN;
    if (!isnan(b->mass)) return b->mass;
    return 4.0 / 3 * REAL_PI * b->radius * b->radius * b->radius * filled * density(&b->response.object);
}

/* I / (m R^2) of the body; of what slides, 0. */
static double ball_inertia(const struct contact *c)
{
    const struct ball *b = &c->ball;
    if (!contact_rolls(c)) return 0;
    switch (b->body) {
    case BODY_SOLID:
        return 2.0 / 5;
    case BODY_HOLLOW:
        return isnan(b->wall) ? 2.0 / 3 : 2.0 / 5 * shell(b->wall / b->radius, 5) / shell(b->wall / b->radius, 3);
    case BODY_HOOP:
        return 1;
    default:
        return 1.0 / 2;
    }
}

double contact_gravity(const struct contact *c)
{
    return c->motion.path == PATH_INCLINE ? c->contact.gravity * real_cospi(c->motion.incline / REAL_PI)
                                          : c->contact.gravity;
}

/* ------------------------------------------------------------------ what is left out */

const char *contact_ablation(const struct contact *c, struct arena *a)
{
    const struct ablation *b = &c->ablation;
    const struct {
        const char *key;
        int value;
    } all[] = {{"normal_force", b->normal_force},
               {"nonlinearity", b->nonlinearity},
               {"response", b->response},
               {"sound", b->sound}};
    const char *text = NULL;
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        const struct key *k = keys_find(arena_format(a, "ablation.%s", all[i].key));
        if (all[i].value != 0)
            text = arena_format(a, "%s%s%s: %s", text ? text : "", text ? ", " : "", all[i].key,
                                k->choices[all[i].value].word);
    }
    return text;
}

void contact_derive(struct contact *c, void *own)
{
    const struct ball *b = &c->ball;
    (void)own;
    c->motion.gravity = c->contact.gravity;
    c->motion.inertia = ball_inertia(c);
    if (contact_rolls(c))
        c->scraper = (struct scraper){
            .mass = ball_mass(b), .weight = b->weight, .radius = b->radius, .patch = b->patch, .response = b->response};
}

/* ------------------------------------------------------------------ sizes and mass of a ball */

/* What the mass lacks, with an example of the cure; NULL: it is not the mass. */
static const char *mass_lacks(const struct scene_part *p, const struct ball *b)
{
    bool of_material = material_given(&b->response.object) || !isnan(b->response.object.density);
    if (b->body == BODY_HOOP || b->body == BODY_WHEEL)
        return ": what a hoop or a wheel weighs does not follow from its radius";
    if (b->body == BODY_HOLLOW && !scene_part_given(p, "ball.wall"))
        return ": it is hollow; or give ball.wall and ball.material, from which it follows";
    return of_material ? NULL
                       : ": it is not known what the ball is made of; ball.material, such as glass, would do as well";
}

static void ball_check(const struct scene_part *p, const struct contact *c, const void *own)
{
    const struct ball *b = &c->ball;
    (void)own;
    const struct {
        const char *path;
        double size;
    } below[] = {{"ball.offset", b->offset},
                 {"ball.wall", b->wall},
                 {"ball.patch", b->patch},
                 {"ball.lobe_height", b->lobe_height}};
    const char *lacks = mass_lacks(p, b);
    for (size_t i = 0; i < sizeof below / sizeof *below; i++)
        if (below[i].size >= b->radius)
            scene_part_contradiction(p, below[i].path, "ball.radius", "must be less than",
                                     arena_format(p->yaml->arena, "lower %s, or raise ball.radius", below[i].path));
    if (isnan(ball_mass(b)) && lacks && scene_part_known(p, "ball.body") && scene_part_known(p, "ball.material"))
        scene_part_missing(p, "ball.mass", "11 g", lacks);
}

/* ------------------------------------------------------------------ what the model has */

static const char *model(const struct contact *c) { return keys_find("contact.model")->choices[c->contact.model].word; }

/* A ball that is dropped may bounce at one place; all else that follows a surface has to move. */
static void still_check(const struct scene_part *p, const struct contact *c)
{
    const char *path = "motion.path", *kind = "contact.model";
    bool rolls = c->contact.model == CONTACT_ROLL,
         follows = rolls || c->contact.model == CONTACT_SCRAPE || c->contact.model == CONTACT_PLAYBACK;
    if (c->motion.path == PATH_STILL && scene_part_known(p, path) && follows)
        scene_part_refuse(
            p, path, kind,
            rolls ? "let it move, such as path: line; or set contact.model to roll_coupled, under which a ball "
                    "may bounce on the spot"
                  : "let it move, such as path: line; or set contact.model to strike or given",
            " is still: nothing would %s where %s is %s", c->contact.model == CONTACT_PLAYBACK ? "sound" : model(c),
            scene_part_label(p, kind), model(c));
}

static void idle_refuse(const struct scene_part *p, const struct contact *c, const char *path, bool keys_say_it)
{
    const struct yaml_node *node = yaml_find(p->map, path);
    if (node && (node->n == 0 || !keys_say_it))
        diag_add(p->yaml->diag, node->key->at,
                 "remove it (a null takes away what another file says), or set contact.model to scrape",
                 "%s has no effect where %s is %s", scene_part_label(p, path), scene_part_label(p, "contact.model"),
                 model(c));
}

static void idle_check(const struct scene_part *p, const struct contact *c)
{
    bool reads = contact_rolls(c) || c->contact.model == CONTACT_PLAYBACK;
    const struct params *own;
    idle_refuse(p, c, "grip", true);
    for (int i = 0; !reads && (own = stages_params(i)); i++)
        if (own->ground) idle_refuse(p, c, own->section, false);
}

static void contact_check(const struct scene_part *p, const struct contact *c, const void *own)
{
    (void)own;
    if (contact_steady(c) && c->load.recorded)
        scene_part_refuse(p, "ablation.normal_force", "load.recorded",
                          "give load.constant in place of load.recorded (load: {recorded: null, constant: 1 N})",
                          " is constant, and a recorded force has no mean that is known before its file is read");
    if (!scene_part_known(p, "contact.model")) return;
    still_check(p, c);
    if (c->contact.model != CONTACT_SCRAPE) idle_check(p, c);
}

/* ------------------------------------------------------------------ keys */

static const struct choice models[] = {
    [CONTACT_SCRAPE] = {"scrape", "a scraper that follows the surface without bouncing"},
    [CONTACT_STRIKE] = {"strike", "impacts: one, several, or a train of bounces, from mass, speed and stiffness"},
    [CONTACT_GIVEN] = {"given", "a force from a file"},
    [CONTACT_ROLL] = {"roll", "a ball that rolls: the force follows from its centre's way over the surface (Agarwal et "
                              "al. 2021, section 4)"},
    [CONTACT_ROLL_COUPLED] =
        {"roll_coupled",
         "a ball that rolls and may bounce: its flight, the contact and the surface's modes are solved together (Conan "
         "et al. 2014a, section II)"},
    [CONTACT_IMPACTS] =
        {"impacts",
         "a series of impacts drawn from its statistics: rubbing, scratching, rolling, and what lies between (Conan et "
         "al. 2014a, sections IV and V; 2014b)"},
    [CONTACT_PLAYBACK] =
        {"playback",
         "the surface's heights are the force, played at the contact's speed (FoleyAutomatic, in Conan et al. 2014a, "
         "section II-B)"},
    {NULL, NULL}};

static const struct key contact_keys[] = {
    {ROW_CHOICE(contact, contact.model, "contact.model"), KEY_NONE, 0, 0, "scrape", NULL, "model of the contact",
     models},
    {ROW_NUMBER(contact, contact.gravity, "contact.gravity"), KEY_ACCELERATION, 0, 1000, "9.80665 m/s^2",
     "contact.model=scrape|strike|roll|roll_coupled|impacts|playback", "acceleration of gravity"},
    {ROW_PLACE("contact.limiter")},
    {ROW_PLACE("contact.force")},
    {ROW_PLACE("contact.roll")},
    {ROW_PLACE("contact.impacts")},
    {.path = NULL}};

const struct params contact_params = {
    .section = "contact", .keys = contact_keys, .derive = contact_derive, .check = contact_check};

#define SCRAPES "contact.model=scrape|strike|given|impacts|playback"
#define ROLLS "contact.model=roll|roll_coupled"

static const struct key scraper_keys[] = {
    {ROW_NUMBER(contact, scraper.mass, "scraper.mass"), KEY_MASS, 1e-9, 1000, NULL, "contact.model=scrape|strike",
     "mass of the scraper (m_p of equation 1), or of what strikes", .shown = "20 g"},
    {ROW_NUMBER(contact, scraper.weight, "scraper.weight"), KEY_NONE, 0, 1000, "1", SCRAPES,
     "eta, the weight of the scraper's response in the total: where at 1 a light scraper drowns the surface, 0.1 makes "
     "it 20 dB quieter; 0: the scraper is damped and none is computed"},
    {.path = NULL}};

const struct params contact_scraper_params = {.section = "scraper", .keys = scraper_keys};

static const struct choice bodies[] = {
    [BODY_SOLID] = {"solid", "a solid ball: moment of inertia 2/5 m R^2"},
    [BODY_HOLLOW] = {"hollow", "a hollow ball: 2/3 m R^2 where the wall is thin, else as ball.wall has it"},
    [BODY_HOOP] = {"hoop", "a thin hoop or tube: m R^2"},
    [BODY_WHEEL] = {"wheel", "a solid disk or cylinder: 1/2 m R^2"},
    {NULL, NULL}};

static const struct key ball_keys[] = {
    {ROW_NUMBER(contact, ball.radius, "ball.radius"), KEY_LENGTH, 1e-4, 10, NULL, ROLLS, "radius R of the ball",
     .shown = "1 cm"},
    {ROW_NUMBER(contact, ball.mass, "ball.mass"), KEY_MASS, 1e-9, 1e5, "", ROLLS,
     "mass of the ball; left out: from radius and material (of what is hollow, wall too; of a hoop or wheel it must be "
     "given)",
     .shown = "11 g"},
    {ROW_CHOICE(contact, ball.body, "ball.body"), KEY_NONE, 0, 0, "solid", ROLLS,
     "what kind of body rolls: its moment of inertia, for motions of path incline", bodies},
    {ROW_NUMBER(contact, ball.wall, "ball.wall"), KEY_LENGTH, 1e-6, 10, "", "ball.body=hollow",
     "thickness of the hollow ball's wall; left out: thin", .shown = "2 mm"},
    {ROW_NUMBER(contact, ball.offset, "ball.offset"), KEY_LENGTH, 0, 10, "0 m", ROLLS,
     "r, distance of the centre of mass from the geometric centre"},
    {ROW_NUMBER(contact, ball.start_angle, "ball.start_angle"), KEY_ANGLE, -6.2832, 6.2832, "0 deg", ROLLS,
     "theta at the start: 0, the centre of mass is lowest"},
    {ROW_NUMBER(contact, ball.lobe_height, "ball.lobe_height"), KEY_LENGTH, 0, 1e-2, "0 m", ROLLS,
     "amplitude of the ball's out-of-roundness, a sinusoid round it; roll follows it and presses by N(t), under "
     "penetration: paper it is in rho"},
    {ROW_COUNT(contact, ball.lobes, "ball.lobes"), KEY_NONE, 1, 1000, "2", ROLLS,
     "periods of that sinusoid in one turn; 2: an oval"},
    {ROW_NUMBER(contact, ball.patch, "ball.patch"), KEY_LENGTH, 0, 1e-3, "20 um", ROLLS,
     "radius of the contact patch: the rolling curve, which has kinks, is smoothed by a Gaussian of this standard "
     "deviation; 0 (roll_coupled, not in the plane): it is not"},
    {ROW_NUMBER(contact, ball.weight, "ball.weight"), KEY_NONE, 0, 1000, "1", ROLLS,
     "weight of the ball's response in the total: 10 makes it 20 dB louder; 0: none is computed"},
    {.path = NULL}};

const struct params contact_ball_params = {
    .section = "ball", .keys = ball_keys, .check = ball_check, .given = contact_rolls};

static const struct choice forces[] = {
    [ABLATED_FORCE_VARYING] = {"varying", "as the scene has it"},
    [ABLATED_FORCE_CONSTANT] =
        {"constant",
         "held (Agarwal et al. 2021, omitting section 2.3). It is held at its mean over a motion that ends as fast as "
         "it began: of a grip m g / (1 - mu tan theta), of a ball that turns its weight m g cos(incline). Then alpha "
         "is contact.limiter.alpha, or with force_range what that force makes of it"},
    {NULL, NULL}};

static const struct choice limits[] = {
    [ABLATED_NONLINEARITY_FULL] = {"kept", "as the scene has it"},
    [ABLATED_NONLINEARITY_OMITTED] =
        {"omitted",
         "it is not, and the smoothing that follows the limiter is left out, too (Agarwal et al. 2021, omitting "
         "section 2.2): the surface is followed exactly"},
    [ABLATED_NONLINEARITY_SMOOTHED] = {"smoothed", "it is not, but smoothing stays, as for an alpha of 3 cm"},
    {NULL, NULL}};

static const struct choice responses[] = {
    [ABLATED_RESPONSE_BY_PLACE] = {"by_place", "it does, as far as it has places"},
    [ABLATED_RESPONSE_CONSTANT] =
        {"constant",
         "it does not (Agarwal et al. 2021, omitting the morphing of section 2.4): the surface rings everywhere, and "
         "all the time, as at one place"},
    {NULL, NULL}};

static const struct choice sounds[] = {[ABLATED_SOUND_BOTH] = {"both", "both, as far as they have responses"},
                                       [ABLATED_SOUND_SURFACE] = {"surface", "the surface: of the other eta is 0"},
                                       [ABLATED_SOUND_SCRAPER] = {"scraper", "the scraper"},
                                       [ABLATED_SOUND_BALL] = {"ball", "the ball"},
                                       {NULL, NULL}};

static const struct key ablation_keys[] = {
    {ROW_CHOICE(contact, ablation.normal_force, "ablation.normal_force"), KEY_NONE, 0, 0, "varying",
     "contact.model=scrape|roll", "how the normal force goes over the motion", forces},
    {ROW_CHOICE(contact, ablation.nonlinearity, "ablation.nonlinearity"), KEY_NONE, 0, 0, "kept",
     "contact.model=scrape|roll",
     "whether the curvature of the contact's way is limited, as equations 4 and 5 of Agarwal et al. (2021) have it",
     limits},
    {ROW_CHOICE(contact, ablation.response, "ablation.response"), KEY_NONE, 0, 0, "by_place", NULL,
     "whether the surface's response depends on where it is touched", responses},
    {ROW_POINT(contact, ablation.place, "ablation.place"), KEY_LENGTH, -100, 100, "", "ablation.response=constant",
     "the place whose response it is everywhere; left out: where the motion starts", .shown = "[5 cm, 2 cm]"},
    {ROW_CHOICE(contact, ablation.sound, "ablation.sound"), KEY_NONE, 0, 0, "both", NULL,
     "which of the two bodies is heard; the other's response is not computed, and not read unless the force depends on "
     "it",
     sounds},
    {.path = NULL}};

const struct params contact_ablation_params = {
    .section = "ablation",
    .shown = true,
    .keys = ablation_keys,
    .meaning = "what is left out of the model, to hear what it is for: the ablated models of Agarwal et al. (2021), "
               "experiments 1 to 3. All else stays as the scene has it, bit for bit",
    .flag = offsetof(struct contact, ablation.given)};
