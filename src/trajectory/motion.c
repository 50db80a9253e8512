/* A motion as far as the scene alone tells it, what it needs and must not have, and the free one.

   A rigid body that moves freely along a straight line on a slope: it rolls without slipping, or slides (then I = 0).
   Newton's second law for its centre of mass and its turning, the force at the contact eliminated:

     u'' = -g (sin(incline) + c cos(incline) sgn u') / (1 + I / (m R^2))

     u        m, way of the centre of mass from `from` towards `to`, u(0) = 0, u'(0) = start_speed >= 0
     g        m/s^2, gravity                      incline  rad, above 0: `to` lies higher
     c        rolling friction: the couple c N R against the turning of what rolls, or the force c N against what
              slides, N = m g cos(incline)
     I        kg m^2, moment of inertia about the centre; R  m, outer radius

   So u is one parabola up to the stop (if there is one before `to`), then, where g sin(incline) outweighs friction, a
   second one back to `from`, or rest for good. u and u' are continuous; u'' jumps at the stop where there is friction.
   An offset of the centre of mass, air, and the friction of what slips while it rolls are left out.

   Near the stop u = top + pull/2 (t - stop)^2, which is 0 at t = 0 and top at the stop to the last bit, and never more
   than top; without a stop u = t (speed + pull t / 2). Papers/000 has balls that roll up and down a slope (section 5.1)
   and no formula for their motion. */
#include "trajectory/motion.h"

#include <math.h>
#include <string.h>

#include "num/real.h"
#include "scene/rows.h"
#include "scene/scene_part.h"
#include "trajectory/trajectory.h"

/* Least t > 0 with t (speed + pull t / 2) = way, in the form that keeps its digits. */
static double time_to(double distance, double speed, double pull)
{
    return 2 * distance /
           (speed + sqrt(fmax(speed * speed + 2 * pull * distance, 0))); /* arrives at rest: rounding leaves -1e-17 */
}

static void stops(struct incline *i)
{
    i->stop = i->speed / -i->pull;
    i->top = -0.5 * i->pull * (i->stop * i->stop);
    i->over = i->back < 0 ? INCLINE_AT_FROM : INCLINE_RESTS;
    i->end = i->back < 0 ? i->stop + sqrt(2 * i->top / -i->back) : i->stop;
}

struct incline motion_incline(const struct motion *m)
{
    double x = m->to[0] - m->from[0], y = m->to[1] - m->from[1], share = m->gravity / (1 + m->inertia);
    double slope = share * real_sin(m->incline), friction = share * m->rolling_friction * real_cos(m->incline);
    struct incline i = {.length = sqrt(x * x + y * y),
                        .speed = m->start_speed,
                        .pull = 0 - slope - friction,
                        .stop = HUGE_VAL,
                        .top = HUGE_VAL,
                        .over = INCLINE_AT_TO};
    i.back = slope > friction ? friction - slope : 0;
    if (i.speed == 0 && i.pull <= 0) {
        i.over = INCLINE_STUCK;
        i.end = NAN;
    } else if (i.pull < 0 && -0.5 * i.speed * i.speed / i.pull < i.length)
        stops(&i);
    else
        i.end = time_to(i.length, i.speed, i.pull);
    return i;
}

void motion_incline_at(const struct incline *i, double t, double out[3])
{
    bool over = t > i->stop;
    double pull = over ? i->back : i->pull, since = t - i->stop;
    if (i->stop < HUGE_VAL) {
        out[0] = i->top + 0.5 * pull * (since * since);
        out[1] = pull * since;
    } else {
        out[0] = t * (i->speed + 0.5 * pull * t);
        out[1] = i->speed + pull * t;
    }
    out[2] = pull;
}

double motion_incline_lasts(const struct incline *i, const struct motion *m)
{
    return isnan(m->duration) ? i->end : m->duration;
}

/* Does the duration lead beyond `to`, or back beyond `from`? (By more than 1e-9 of it.) */
static bool exits(const struct incline *i, double duration)
{
    return (i->over == INCLINE_AT_TO || i->over == INCLINE_AT_FROM) && duration > i->end * (1 + 1e-9);
}

double motion_incline_distance(const struct incline *i, double t)
{
    double at[3];
    motion_incline_at(i, t, at);
    return t > i->stop ? i->top + (i->top - at[0]) : at[0];
}

/* "reaches motion.to", "is back at motion.from", "rests" */
static const char *event(const struct incline *i)
{
    return i->over == INCLINE_AT_TO     ? "reaches motion.to"
           : i->over == INCLINE_AT_FROM ? "is back at motion.from"
                                        : "rests";
}

/* Why it is stuck, and what helps. */
static const char *stuck(const struct motion *m, const char **cure)
{
    if (m->incline > 0) {
        *cure = "give a motion.start_speed above 0, such as 1 m/s; or swap motion.from and motion.to and turn "
                "motion.incline's sign";
        return "the way leads upwards, and motion.start_speed is 0: nothing drives it towards motion.to";
    }
    *cure = "give a motion.start_speed above 0, such as 1 m/s, or a motion.incline further below 0, such as -5 deg";
    if (m->incline == 0 || m->gravity == 0)
        return m->gravity == 0 ? "contact.gravity and motion.start_speed are 0: nothing moves it"
                               : "the way is level, and motion.start_speed is 0: nothing moves it";
    return "motion.start_speed is 0, and motion.rolling_friction holds it on this slope";
}

bool motion_incline_can(const struct incline *i, const struct motion *m, struct err *e)
{
    if (isnan(m->gravity))
        return err_set(e, ERR_SCENE, "motion: contact.gravity must be given where motion.path is incline");
    const char *cure, *why = i->over == INCLINE_STUCK ? stuck(m, &cure) : NULL;
    double lasts = motion_incline_lasts(i, m);
    if (why) return err_set(e, ERR_SCENE, "motion: %s; %s", why, cure);
    if (exits(i, lasts))
        return err_set(e, ERR_SCENE,
                       "motion.duration is %.6g s, and the motion %s after %.6g s; lower it or leave it out, or make "
                       "the way longer",
                       lasts, event(i), i->end);
    return lasts <= INCLINE_LONGEST ||
           err_set(e, ERR_SCENE,
                   "motion: it is %.4g s before it %s, and a motion lasts at most %g s; give motion.duration", lasts,
                   event(i), INCLINE_LONGEST);
}

/* ------------------------------------------------------------------ what the scene tells */

/* m: from end to end. */
static double chord(const struct motion *m)
{
    double x = m->to[0] - m->from[0], y = m->to[1] - m->from[1];
    return sqrt(x * x + y * y);
}

/* m: from point to point. */
static double chords(const struct motion *m)
{
    double length = 0;
    for (int i = 1; i < m->n_points; i++) {
        double x = m->points[2 * i] - m->points[2 * i - 2], y = m->points[2 * i + 1] - m->points[2 * i - 1];
        length += sqrt(x * x + y * y);
    }
    return length;
}

double motion_speed(const struct motion *m)
{
    double length = chord(m);
    if (m->path == PATH_STILL) return 0;
    if (m->made) return m->made->mean_speed;
    if (m->path == PATH_INCLINE) {
        struct incline i = motion_incline(m);
        double lasts = motion_incline_lasts(&i, m), speed = motion_incline_distance(&i, lasts) / lasts;
        return isfinite(speed) ? speed : 0.2;
    }
    if (!isnan(m->speed)) return m->speed;
    if (m->path == PATH_BACK_AND_FORTH && !isnan(m->rate)) return 2 * m->rate * length;
    if (m->path == PATH_CIRCLE && !isnan(m->duration)) return 2 * REAL_PI * m->radius * fabs(m->turns) / m->duration;
    if (m->path == PATH_SCRIBBLE && !isnan(m->rate))
        return 1.05 * m->rate * sqrt(m->size[0] * m->size[0] + m->size[1] * m->size[1]);
    if (m->n_points > 1 && !isnan(m->duration)) return chords(m) / m->duration;
    return motion_straight(m) && !isnan(m->duration) ? length / m->duration : 0.2;
}

int motion_law(const struct motion *m)
{
    static const int own[] = {[PATH_BACK_AND_FORTH] = SPEED_HARMONIC,
                              [PATH_LINE] = SPEED_CONSTANT,
                              [PATH_FOUR_IN_LINE] = SPEED_HARMONIC,
                              [PATH_CIRCLE] = SPEED_CONSTANT,
                              [PATH_SCRIBBLE] = SPEED_AUTO,
                              [PATH_POLYLINE] = SPEED_MINIMUM_JERK,
                              [PATH_SPLINE] = SPEED_TWO_THIRDS,
                              [PATH_RECORDED] = SPEED_AUTO,
                              [PATH_STILL] = SPEED_AUTO,
                              [PATH_INCLINE] = SPEED_AUTO};
    return m->law == SPEED_AUTO ? own[m->path] : m->law;
}

bool motion_law_fits(const struct motion *m, int law)
{
    bool rests = m->path == PATH_POLYLINE && m->corner == 0 && m->n_points > 2;
    if (m->path == PATH_STILL || m->path == PATH_INCLINE) return law == SPEED_AUTO;
    if (law == SPEED_CONSTANT) return m->path != PATH_BACK_AND_FORTH && !rests;
    if (law == SPEED_TWO_THIRDS) return !motion_straight(m) && !rests;
    return law != SPEED_GIVEN || !rests;
}

bool motion_rests(const struct motion *m, bool at_end)
{
    int law = motion_law(m);
    double strokes = 2 * m->rate * m->duration;
    if (at_end && motion_breaks_off(m)) return m->path == PATH_STILL;
    if (m->path == PATH_INCLINE) {
        struct incline i = motion_incline(m);
        return at_end ? i.over == INCLINE_RESTS && !(motion_incline_lasts(&i, m) < i.end) : m->start_speed == 0;
    }
    if (law != SPEED_HARMONIC && law != SPEED_MINIMUM_JERK) return m->path == PATH_STILL;
    return !at_end || m->path != PATH_BACK_AND_FORTH || fabs(strokes - rint(strokes)) < 1e-9;
}

double motion_lasts(const struct motion *m)
{
    double whole = !isnan(m->duration)       ? m->duration
                   : m->path == PATH_CIRCLE  ? 2 * M_PI * m->radius * fabs(m->turns) / m->speed
                   : m->path == PATH_INCLINE ? motion_incline(m).end
                   : motion_straight(m)      ? chord(m) / m->speed
                                             : NAN;
    return isnan(whole) ? NAN : motion_cut(m, whole);
}

#define SHORTEST_PATH 1e-9 /* m */

static const char *word(const char *path, int value) { return keys_find(path)->choices[value].word; }

/* Where something is missing in the motion. */
static struct diag_place motion_place(const struct scene_part *p)
{
    const struct yaml_node *map = yaml_get(p->map, "motion");
    return scene_part_place(p, map ? map : p->map);
}

/* ------------------------------------------------------------------ how long it takes */

/* A speed profile says all of it. (A scribble's rate is its shape's.) */
static void profile_check(const struct scene_part *p, const struct motion *m)
{
    static const char *const times[] = {"motion.speed", "motion.duration", "motion.rate"};
    for (int i = 0; i < (m->path == PATH_BACK_AND_FORTH ? 3 : 2); i++)
        if (scene_part_given(p, times[i]))
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
    else if (m->path != PATH_RECORDED && m->path != PATH_INCLINE && !scene_part_given(p, duration) &&
             !scene_part_given(p, "motion.speed") && !scene_part_misspelt(p, duration) &&
             !scene_part_misspelt(p, "motion.speed"))
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
    if (motion_law_fits(m, m->law)) return;
    for (int i = 0; keys_find("motion.law")->choices[i].word; i++)
        if (motion_law_fits(m, i)) laws = arena_format(a, "%s%s%s", laws, *laws ? ", " : "", word("motion.law", i));
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

static void free_check(const struct scene_part *p, const struct motion *m)
{
    struct incline i = motion_incline(m);
    const char *duration = "motion.duration", *speed = "motion.start_speed", *slope = "motion.incline";
    double lasts = motion_incline_lasts(&i, m);
    double known = m->start_speed + m->incline + m->rolling_friction + m->gravity;
    if (m->path != PATH_INCLINE || free_grip(p) || isnan(known) || !(i.length >= SHORTEST_PATH)) return;
    const char *cure, *why = i.over == INCLINE_STUCK ? stuck(m, &cure) : NULL;
    bool given = scene_part_given(p, speed) || scene_part_given(p, slope);
    if (why)
        diag_add(p->yaml->diag, given ? scene_part_later(p, speed, slope) : motion_place(p), cure, "%s: %s",
                 scene_part_label(p, "motion"), why);
    else if (exits(&i, lasts))
        scene_part_refuse(p, duration, duration,
                          "lower it, or leave it out: the motion ends there by itself; or make the way longer",
                          " is %.6g s, and the motion %s after %.6g s", lasts, event(&i), i.end);
    else if (lasts > INCLINE_LONGEST)
        diag_add(p->yaml->diag, motion_place(p), "add for instance: duration: 1 min",
                 "%s: it is %.4g s before it %s, and a motion lasts at most %g s", scene_part_label(p, "motion"), lasts,
                 event(&i), INCLINE_LONGEST);
}

static void motion_check(const struct scene_part *p, const struct contact *c, const void *own)
{
    const struct motion *m = &c->motion;
    (void)own;
    if (!scene_part_known(p, "motion.path")) return;
    if (m->path != PATH_STILL && motion_straight(m) && chord(m) < SHORTEST_PATH)
        scene_part_contradiction(p, "motion.to", "motion.from", "must differ from",
                                 "the ends are to be at least 1 nm apart: write for instance: to: [3 cm, 0]");
    if (m->path == PATH_CIRCLE && 2 * M_PI * m->radius * fabs(m->turns) < SHORTEST_PATH)
        scene_part_refuse(p, "motion.turns", "motion.turns", "write for instance: turns: 1, or -1 for clockwise",
                          " must not be 0");
    if (!scene_part_known(p, "motion.law")) return;
    time_check(p, m);
    law_check(p, m);
    free_check(p, m);
}

/* ------------------------------------------------------------------ parameters */

static const struct choice paths[] = {
    [PATH_BACK_AND_FORTH] = {"back_and_forth", "to and fro between the two ends, starting at the first"},
    [PATH_LINE] = {"line", "one stroke from the first end to the second"},
    [PATH_FOUR_IN_LINE] = {"four_in_line", "strokes one after the other along one line, each from rest to rest"},
    [PATH_CIRCLE] = {"circle", "round a centre"},
    [PATH_SCRIBBLE] = {"scribble", "a hand's wandering loops in a box, drawn from the seed"},
    [PATH_POLYLINE] = {"polyline", "straight from point to point"},
    [PATH_SPLINE] = {"spline", "a smooth curve (cubic spline) through points"},
    [PATH_RECORDED] = {"recorded", "positions over time from a CSV, smoothed"},
    [PATH_STILL] = {"still", "the contact stays at one place"},
    [PATH_INCLINE] =
        {"incline",
         "freely along a straight line, on a slope or level: up, and down again, or slowed by friction until it rests"},
    {NULL, NULL}};

static const struct choice laws[] = {
    [SPEED_AUTO] = {"auto", "back_and_forth and four_in_line: harmonic; line and circle: constant; polyline: "
                            "minimum_jerk; spline: two_thirds; scribble and recorded: their own"},
    [SPEED_HARMONIC] = {"harmonic", "from rest to rest as half a cosine, each stroke"},
    [SPEED_CONSTANT] = {"constant", "the same speed all along; not for paths that rest on the way: back_and_forth, and "
                                    "a polyline of more than two points whose corners are not rounded"},
    [SPEED_MINIMUM_JERK] =
        {"minimum_jerk",
         "a human stroke from rest to rest: 10 p^3 - 15 p^4 + 6 p^5 of the way at share p of the time, each stroke"},
    [SPEED_TWO_THIRDS] = {"two_thirds", "as hands draw: speed in proportion to the radius of curvature to the power "
                                        "1/3; for curved paths without unrounded corners"},
    [SPEED_GIVEN] = {"given", "speed over time from motion.profile"},
    {NULL, NULL}};

#define ENDS "motion.path=back_and_forth|line|four_in_line|incline"

static const struct key keys[] = {
    {ROW_CHOICE(contact, motion.path, "motion.path"), KEY_NONE, 0, 0, NULL, NULL, "shape of the motion", paths,
     .shown = "back_and_forth"},
    {ROW_POINT(contact, motion.at, "motion.at"), KEY_LENGTH, -100, 100, "[0 m, 0 m]", "motion.path=still",
     "where the contact stays"},
    {ROW_POINT(contact, motion.from, "motion.from"), KEY_LENGTH, -100, 100, "[0 m, 0 m]", ENDS,
     "where the motion starts"},
    {ROW_POINT(contact, motion.to, "motion.to"), KEY_LENGTH, -100, 100, NULL, ENDS,
     "the stroke's other end; of four_in_line the last stroke's", .shown = "[4.5 cm, 0 cm]"},
    {ROW_COUNT(contact, motion.strokes, "motion.strokes"), KEY_NONE, 1, 1000, "4", "motion.path=four_in_line",
     "how many strokes"},
    {ROW_POINT(contact, motion.center, "motion.center"), KEY_LENGTH, -100, 100, "[0 m, 0 m]",
     "motion.path=circle|scribble", "centre of the motion"},
    {ROW_NUMBER(contact, motion.radius, "motion.radius"), KEY_LENGTH, 1e-4, 100, NULL, "motion.path=circle",
     "radius of the circle", .shown = "2 cm"},
    {ROW_NUMBER(contact, motion.start_angle, "motion.start_angle"), KEY_ANGLE, -6.2832, 6.2832, "0 deg",
     "motion.path=circle", "where on the circle the motion starts, 0 is the +x side"},
    {ROW_NUMBER(contact, motion.turns, "motion.turns"), KEY_NONE, -10000, 10000, "1", "motion.path=circle",
     "how often round the circle; negative: clockwise"},
    {ROW_POINT(contact, motion.size, "motion.size"), KEY_LENGTH, 1e-4, 100, "[8 cm, 5 cm]", "motion.path=scribble",
     "width and height of the box"},
    {ROW_POINTS(contact, motion.points, "motion.points"), KEY_LENGTH, -100, 100, NULL, "motion.path=polyline|spline",
     "points of the path, in order: [[0, 0], [3 cm, 1 cm], ...]",
     .shown = "[[0 cm, 0 cm], [3 cm, 1 cm], [6 cm, 0 cm]]"},
    {ROW_NUMBER(contact, motion.corner, "motion.corner"), KEY_LENGTH, 0, 1, "0 m", "motion.path=polyline",
     "radius to which corners are rounded; 0: the motion rests at each corner"},
    {ROW_FILE(contact, motion.file, "motion.file"), KEY_NONE, 0, 0, NULL, "motion.path=recorded",
     "recorded positions: CSV with the columns time_s, x_m, y_m", .example = "recording.csv"},
    {ROW_NUMBER(contact, motion.cutoff, "motion.cutoff"), KEY_FREQUENCY, 0, 1e4, "12 Hz", "motion.path=recorded",
     "frequency above which a recording is smoothed away (a smoothing spline's half-power point); 0: it is "
     "interpolated"},
    {ROW_NUMBER(contact, motion.rate, "motion.rate"), KEY_FREQUENCY, 1e-3, 100, "",
     "motion.path=back_and_forth|scribble",
     "full cycles (there and back) per second; of a scribble, about as many loops per second; must be given, unless "
     "back_and_forth follows a given speed",
     .shown = "2 Hz", .on = true},
    {ROW_NUMBER(contact, motion.speed, "motion.speed"), KEY_SPEED, 1e-4, 100, "",
     "motion.path=line|four_in_line|circle|polyline|spline", "mean speed along the path; gives the duration",
     .shown = "10 cm/s"},
    {ROW_NUMBER(contact, motion.duration, "motion.duration"), KEY_TIME, 1e-3, 36000, "", NULL,
     "how long the motion lasts", .shown = "2 s", .on = true},
    {ROW_NUMBER(contact, motion.until, "motion.until"), KEY_TIME, 1e-3, 36000, "", NULL,
     "an excerpt: where the motion breaks off, so much after its start; all before is as in the whole motion",
     .shown = "1 s"},
    {ROW_CHOICE(contact, motion.law, "motion.law"), KEY_NONE, 0, 0, "auto", NULL, "how speed varies along the path",
     laws},
    {ROW_FILE(contact, motion.profile, "motion.profile"), KEY_NONE, 0, 0, NULL, "motion.law=given",
     "speed over time, which says how long the motion lasts: CSV with the columns time_s, speed_m_per_s",
     .example = "speed.csv"},
    {ROW_NUMBER(contact, motion.incline, "motion.incline"), KEY_ANGLE, -1.4, 1.4, "0 deg", "motion.path=incline",
     "slope of the way from `from` to `to`: above 0 it leads upwards"},
    {ROW_NUMBER(contact, motion.start_speed, "motion.start_speed"), KEY_SPEED, 0, 100, "0 m/s", "motion.path=incline",
     "speed at the start, towards `to`"},
    {ROW_NUMBER(contact, motion.rolling_friction, "motion.rolling_friction"), KEY_NONE, 0, 10, "0",
     "motion.path=incline",
     "coefficient of rolling friction (of what slides: of friction): the retarding force over the normal force"},
    {ROW_NUMBER(contact, motion.straight, "motion.straight"), KEY_LENGTH, 1e-4, 100, "10 cm",
     "motion.law=auto|two_thirds",
     "radius of curvature from which on the law two_thirds counts a path as straight: speed ~ (curvature^2 + "
     "1/straight^2)^(-1/6)"},
    {.path = NULL}};

const struct params motion_params = {.section = "motion",
                                     .keys = keys,
                                     .alternative = {.most = 1, .paths = {"motion.speed", "motion.duration"}},
                                     .check = motion_check};
