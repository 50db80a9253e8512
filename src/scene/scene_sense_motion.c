/* A motion's values against each other: how long is its way, what says how long it takes, which speed law fits which
 * path, and what moves freely. */
#include <math.h>
#include <string.h>

#include "scene/keys.h"
#include "scene/rules.h"
#include "scene/scene_part.h"
#include "scene/scene_sense_parts.h"

#define SHORTEST_PATH 1e-9 /* m */

static const char *word(const char *path, int value) { return keys_find(path)->choices[value].word; }

/* Where something is missing in the motion. */
static struct diag_place motion_place(const struct scene_part *p)
{
    const struct yaml_node *map = yaml_get(p->map, "motion");
    return scene_part_place(p, map ? map : p->map);
}

/* ------------------------------------------------------------------ the way */

static void stroke_check(const struct scene_part *p, const struct motion *m)
{
    double x = m->to[0] - m->from[0], y = m->to[1] - m->from[1];
    if (m->path != PATH_STILL && rules_straight(m) && sqrt(x * x + y * y) < SHORTEST_PATH)
        scene_part_contradiction(p, "motion.to", "motion.from", "must differ from",
                                 "the ends are to be at least 1 nm apart: write for instance: to: [3 cm, 0]");
}

static void turns_check(const struct scene_part *p, const struct motion *m)
{
    const char *path = "motion.turns";
    if (m->path == PATH_CIRCLE && 2 * M_PI * m->radius * fabs(m->turns) < SHORTEST_PATH)
        scene_part_refuse(p, path, path, "write for instance: turns: 1, or -1 for clockwise", " must not be 0");
}

/* ------------------------------------------------------------------ how long it takes */

static bool given(const struct scene_part *p, const char *path) { return yaml_find(p->map, path) != NULL; }

/* A speed profile says all of it. (A scribble's rate is its shape's.) */
static void profile_check(const struct scene_part *p, const struct motion *m)
{
    static const char *const times[] = {"motion.speed", "motion.duration", "motion.rate"};
    for (int i = 0; i < (m->path == PATH_BACK_AND_FORTH ? 3 : 2); i++)
        if (given(p, times[i]))
            diag_add(p->yaml->diag, yaml_find(p->map, times[i])->key->at,
                     arena_format(p->yaml->arena, "remove it, or set %smotion.law to another law", p->prefix),
                     "%s must not be given where %s is given: motion.profile says how fast and how long it goes",
                     scene_part_label(p, times[i]), scene_part_label(p, "motion.law"));
}

static void time_check(const struct scene_part *p, const struct motion *m)
{
    static const char duration[] = "motion.duration", example[] = "2 s";
    bool periodic = m->path == PATH_BACK_AND_FORTH || m->path == PATH_SCRIBBLE;
    if (m->path == PATH_SCRIBBLE || (periodic && m->law != SPEED_GIVEN))
        scene_part_missing(p, "motion.rate", "2 Hz", "");
    if (m->law == SPEED_GIVEN && m->path != PATH_STILL)
        profile_check(p, m);
    else if (periodic || m->path == PATH_STILL)
        scene_part_missing(p, duration, example, "");
    else if (m->path == PATH_RECORDED && m->law != SPEED_AUTO)
        scene_part_missing(p, duration, example,
                           arena_format(p->yaml->arena, ": under the law %s a recording gives the path only",
                                        word("motion.law", m->law)));
    else if (m->path != PATH_RECORDED && m->path != PATH_INCLINE && !given(p, duration) && !given(p, "motion.speed"))
        diag_add(p->yaml->diag, motion_place(p), "add for instance: speed: 10 cm/s", "%s or %s must be given",
                 scene_part_label(p, "motion.speed"), scene_part_label(p, duration));
}

/* ------------------------------------------------------------------ the law */

static const char *why_not(const struct motion *m)
{
    if (m->path == PATH_POLYLINE) return "it rests at its corners";
    if (m->path == PATH_STILL) return "nothing moves";
    if (m->path == PATH_INCLINE) return "gravity and friction say how fast it goes";
    return m->law == SPEED_CONSTANT ? "it rests where it turns round" : "a straight line has no curvature";
}

static void law_check(const struct scene_part *p, const struct motion *m)
{
    struct arena *a = p->yaml->arena;
    const char *laws = "", *cure = "";
    if (rules_law_fits(m, m->law)) return;
    for (int i = 0; keys_find("motion.law")->choices[i].word; i++)
        if (rules_law_fits(m, i)) laws = arena_format(a, "%s%s%s", laws, *laws ? ", " : "", word("motion.law", i));
    if (m->path == PATH_POLYLINE) cure = arena_format(a, "; or round the corners: %smotion.corner: 5 mm", p->prefix);
    scene_part_refuse(p, "motion.law", "motion.path", arena_format(a, "laws here: %s%s", laws, cure),
                      " must not be %s where %s is %s: %s", word("motion.law", m->law),
                      scene_part_label(p, "motion.path"), word("motion.path", m->path), why_not(m));
}

/* ------------------------------------------------------------------ free motion */

static bool free_grip(const struct scene_part *p)
{
    const struct contact *c = p->to;
    const struct yaml_node *grip = yaml_find(p->map, "grip");
    const char *model = "contact.model", *path = "motion.path";
    if (c->contact.model == CONTACT_GIVEN && scene_part_known(p, model))
        scene_part_refuse(p, path, model, "let it move otherwise, such as path: line",
                          " must not be incline where %s is given: there is no contact.gravity",
                          scene_part_label(p, model));
    else if (grip && c->contact.model == CONTACT_SCRAPE) /* other models have none at all */
        diag_add(p->yaml->diag, grip->key->at, "remove it, or let the hand say how it moves: path: line",
                 "%s must not be given where %s is incline: nothing holds what moves freely",
                 scene_part_label(p, "grip"), scene_part_label(p, path));
    else
        return false;
    return true;
}

static void free_stuck(const struct scene_part *p, const struct motion *m)
{
    const char *cure, *why = incline_stuck(m, &cure), *speed = "motion.start_speed", *slope = "motion.incline";
    diag_add(p->yaml->diag, given(p, speed) || given(p, slope) ? scene_part_later(p, speed, slope) : motion_place(p),
             cure, "%s: %s", scene_part_label(p, "motion"), why);
}

static void free_check(const struct scene_part *p, const struct motion *m)
{
    struct incline i = incline_make(m);
    const char *duration = "motion.duration";
    double lasts = incline_lasts(&i, m);
    double known = m->start_speed + m->incline + m->rolling_friction + m->gravity;
    if (m->path != PATH_INCLINE || free_grip(p) || isnan(known) || !(i.length >= SHORTEST_PATH)) return;
    if (i.over == INCLINE_STUCK)
        free_stuck(p, m);
    else if (incline_exits(&i, lasts))
        scene_part_refuse(p, duration, duration,
                          "lower it, or leave it out: the motion ends there by itself; or make the way longer",
                          " is %.6g s, and the motion %s after %.6g s", lasts, incline_event(&i), i.end);
    else if (lasts > INCLINE_LONGEST)
        diag_add(p->yaml->diag, motion_place(p), "add for instance: duration: 1 min",
                 "%s: it is %.4g s before it %s, and a motion lasts at most %g s", scene_part_label(p, "motion"), lasts,
                 incline_event(&i), INCLINE_LONGEST);
}

void scene_sense_motion(const struct scene_part *p, const struct motion *m)
{
    if (!scene_part_known(p, "motion.path")) return;
    stroke_check(p, m);
    turns_check(p, m);
    if (!scene_part_known(p, "motion.law")) return;
    time_check(p, m);
    law_check(p, m);
    free_check(p, m);
}
