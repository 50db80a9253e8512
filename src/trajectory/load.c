/* Normal force.

   Of a hand-held scraper: papers/000 equations 8 and 9, generalised to any instant and direction:

     N(t) = (m g + m a_out(t) tan theta) / (1 - mu tan theta),   a_out = a_x cos azimuth + a_y sin azimuth

     m      mass of the scraper, kg           theta    angle of the tool above the horizontal, rad
     g      gravity, m/s^2                    mu       coefficient of friction
     a      acceleration, m/s^2               azimuth  horizontal direction from the torso outwards, rad

   For harmonic motion of amplitude L (half the distance between the ends; the paper does not define its L) along that
   direction, a_out runs from -omega^2 L to omega^2 L, which gives equations 9 and 8 at the two ends. N is largest at
   the end near the torso, where the acceleration points outwards.

   The paper's denominator vanishes at mu tan theta = 1 (the tool jams): refused from 0.999 on. N < 0 means that the
   hand lifts the scraper off: no contact, no force; counted by the force stage.

   Recorded: the natural cubic spline (C2) through the file's rows, their end values before and after them. Its times
   are those of the motion's file for a recorded motion, else they count from the start of the contact. Between rows a
   spline overshoots, also below 0.

   Of a ball whose centre of mass is r off its centre, or whose rim has lobes (model roll), Newton's second law along
   the normal of the surface:

     N(t) = m (g cos(incline) + d2/dt2 (-r cos theta + lobe_height cos(lobes theta)))      theta: trajectory/spin.h

   the two terms by which its centre of mass rises and falls over level ground, slowly enough that it stays on it. (With
   contact.roll.penetration: paper the lobes are in the penetration, and not here.) As it turns evenly N is largest
   where the centre of mass is lowest, and least where it is highest: there its acceleration points up, and down.
   Papers/000 section 4.1 has it "maximal when the centre of mass moves downwards, and minimal when it moves up", a
   quarter of a turn earlier, and gives no formula; of a rigid body that does not hold. With load.phase: falling it is
   so,

     N(t) = m (g cos(incline) - |theta'| d/dt(-r cos theta) + the lobes' part as above)

   the formula ours: as it turns evenly, with the swing of Newton's, a quarter of a turn earlier. N < 0: the ball leaves
   the surface; no force, and counted. It is not followed through the air.

   Approach and release: the contact is made over load.approach, p = 10 q^3 - 15 q^4 + 6 q^5 of the force, so that it
   does not begin with a click; the paper has no such thing. Where the motion starts from rest a scraper's force starts
   from 0 by itself. */
#include "trajectory/load.h"

#include <math.h>
#include <string.h>

#include "num/real.h"
#include "scene/rows.h"
#include "scene/scene_part.h"
#include "stage.h"
#include "trajectory/contact.h"
#include "trajectory/motion.h"
#include "trajectory/series.h"

/* ------------------------------------------------------------------ what the scene tells */

/* 1 - mu tan theta, the denominator of papers/000 equations 8 and 9. */
static double slip_of(const struct grip *g) { return 1 - g->friction * real_tan(g->angle); }

/* The tool jams where mu tan theta reaches 1: refused from 0.999 on. (tan 45 degrees is 1 - 1e-16 in binary, and 0.999
   of it is to be refused.) */
static bool jams(const struct grip *g) { return slip_of(g) <= 1e-3 + 1e-12; }

/* What touches the surface presses on it by its weight: m g cos(incline), N. */
static double weight(const struct contact *c) { return c->scraper.mass * contact_gravity(c); }

double load_constant(const struct contact *c)
{
    if (contact_steady(c) && c->grip.given) return weight(c) / slip_of(&c->grip);
    return isnan(c->load.constant) ? weight(c) : c->load.constant;
}

double load_approach(const struct contact *c, bool release)
{
    double given = release ? c->load.release : c->load.approach;
    if (c->contact.model != CONTACT_SCRAPE && !contact_rolls(c) && !contact_driven(c)) return 0;
    if (!isnan(given)) return given;
    bool falls = c->contact.model == CONTACT_ROLL_COUPLED && c->load.falls && !release;
    return falls || (c->contact.model == CONTACT_SCRAPE && motion_rests(&c->motion, release)) ? 0 : LOAD_APPROACH;
}

static void grip_check(const struct scene_part *p, const struct grip *g)
{
    if (g->given && jams(g))
        diag_add(p->yaml->diag, scene_part_later(p, "grip.angle", "grip.friction"), "lower grip.angle or grip.friction",
                 "%s: the tool jams: friction x tan(angle) is %.4g, and must stay below 0.999",
                 scene_part_label(p, "grip"), 1 - slip_of(g));
}

/* Times that are left to the program are short where there is little time. */
static void lowering_check(const struct scene_part *p, const struct contact *c)
{
    const char *approach = "load.approach", *release = "load.release";
    double taken = (isnan(c->load.approach) ? 0 : c->load.approach) + (isnan(c->load.release) ? 0 : c->load.release);
    double lasts = motion_lasts(&c->motion);
    if (taken > lasts * (1 + 1e-9))
        scene_part_refuse(p, approach, release, "lower them, or let the motion last longer",
                          " and %s take %.4g s together, and the motion lasts %.4g s", scene_part_label(p, release),
                          taken, lasts);
}

static void load_check(const struct scene_part *p, const struct contact *c, const void *own)
{
    (void)own;
    if (c->contact.model == CONTACT_SCRAPE) grip_check(p, &c->grip);
    if (c->contact.model == CONTACT_SCRAPE || c->contact.model == CONTACT_ROLL || contact_driven(c))
        lowering_check(p, c);
}

/* Where nothing says how it is pressed: by its weight. */
static double load_instead(const struct key *k, const void *owner)
{
    return strcmp(k->path, "load.constant") == 0 ? weight(owner) : NAN;
}

#define SCRAPES "contact.model=scrape"
static const struct key grip_keys[] = {{ROW_NUMBER(contact, grip.angle, "grip.angle"), KEY_ANGLE, 0, 1.5707, "30 deg",
                                        SCRAPES, "theta, the tool's angle above the horizontal"},
                                       {ROW_NUMBER(contact, grip.azimuth, "grip.azimuth"), KEY_ANGLE, -6.2832, 6.2832,
                                        "0 deg", SCRAPES, "horizontal direction from the torso outwards; 0 is +x"},
                                       {ROW_NUMBER(contact, grip.friction, "grip.friction"), KEY_NONE, 0, 10, "0.3",
                                        SCRAPES, "mu, the coefficient of friction"},
                                       {.path = NULL}};

const struct params load_grip_params = {
    .section = "grip",
    .meaning = "the hand that holds the scraper: the normal force then follows the motion (equations 8 and 9)",
    .flag = offsetof(struct contact, grip.given),
    .keys = grip_keys,
};

static const struct choice phases[] = {
    [LOAD_LOWEST] = {"lowest", "where the centre of mass is lowest, by Newton's second law"},
    [LOAD_FALLING] =
        {"falling",
         "where it moves downwards, a quarter of a turn earlier: Agarwal et al. (2021), section 4.1, as printed"},
    {NULL, NULL}};

#define LOWERED "contact.model=scrape|roll|roll_coupled|impacts|playback"

/* The hand's keys stand first. */
static const struct key keys[] = {
    {ROW_NUMBER(contact, load.constant, "load.constant"), KEY_FORCE, 0, 1e5, "", SCRAPES,
     "constant normal force, which sets alpha when limiter.force_range is given, and nothing else; left out: the "
     "scraper's weight m g",
     .shown = "1.5 N"},
    {ROW_FILE(contact, load.recorded, "load.recorded"), KEY_NONE, 0, 0, "", SCRAPES,
     "normal force over time: CSV with the columns time_s, normal_force_n, in the time of a recorded motion's file, "
     "else from the contact's start; values below 0 lift the scraper off",
     .example = "force.csv"},
    {ROW_CHOICE(contact, load.phase, "load.phase"), KEY_NONE, 0, 0, "lowest", "contact.model=roll",
     "where the normal force of a ball whose centre of mass is off its centre (ball.offset) is greatest", phases},
    {ROW_TIME_OR_AUTO(contact, load.approach, "load.approach"), KEY_TIME, 0, 10, "auto", LOWERED,
     "time over which the force rises at the start, by 10 u^3 - 15 u^4 + 6 u^5 at the share u of it, as the "
     "scraper (or ball) is lowered. With auto it is 5 ms where the motion starts at speed, and where there is a "
     "force at rest too: of a ball that lies on the surface, of impacts and of playback. Else it is 0 (a ball that "
     "is dropped comes down by itself). It must fit into the motion beside load.release"},
    {ROW_TIME_OR_AUTO(contact, load.release, "load.release"), KEY_TIME, 0, 10, "auto", LOWERED,
     "time over which the force falls at the end, by the same law, as the scraper (or ball) is raised. With auto "
     "it is 5 ms where the motion ends at speed, of every ball, of impacts and of playback, else 0. It must fit "
     "into the motion beside load.approach, also where the two are auto: of a motion of a few milliseconds give 0 "
     "s, or shorter ones"},
    {.path = NULL}};

static const struct params load_params = {
    .section = "load",
    .keys = keys,
    .alternative = {.most = 1, .paths = {"grip", "load.constant", "load.recorded"}},
    .check = load_check,
    .instead = load_instead,
};

enum { LOAD_SOME = 256 };

struct load_record {
    struct cubic spline;
    double clock; /* s: the file's time at the start of the motion */
};

static bool lobes_press(const struct contact *c) { return c->ball.lobe_height > 0 && !c->load.no_lobes; }

bool load_varies(const struct contact *c)
{
    return !contact_steady(c) && (c->grip.given || c->load.recorded ||
                                  (c->contact.model == CONTACT_ROLL && (c->ball.offset > 0 || lobes_press(c))));
}

static double record_at(const struct load_record *r, size_t *piece, double t)
{
    const struct cubic *c = &r->spline;
    double out[4], x = t + r->clock;
    if (x <= c->at[0] || x >= c->at[c->n - 1]) return x <= c->at[0] ? c->y[0] : c->y[c->n - 1];
    *piece = series_cubic_next(c->n, c->at, *piece, x);
    series_cubic_at(c, *piece, x, out);
    return out[0];
}

static bool load_gripped(const struct load_law *l)
{
    return l->per_acceleration[0] != 0 || l->per_acceleration[1] != 0;
}

void load_at(const struct load_law *l, size_t n, const double *t, const double *ax, const double *ay, double *force)
{
    size_t piece = 0;
    bool gripped = load_gripped(l);
    for (size_t i = 0; i < n; i++)
        force[i] = l->record ? record_at(l->record, &piece, t[i]) : l->still;
    for (size_t i = 0; gripped && i < n; i++)
        force[i] += l->per_acceleration[0] * ax[i] + l->per_acceleration[1] * ay[i];
}

void load_turned(const struct load_law *l, size_t n, const double *u, const double *du, const double *ddu,
                 double *force)
{
    double heave[LOAD_SOME], turning[LOAD_SOME];
    for (size_t first = 0, some; first < n; first += some) {
        double *at = force + first;
        bool lobes = l->spin.lobe_height > 0;
        some = n - first < LOAD_SOME ? n - first : LOAD_SOME;
        spin_at(&l->spin, some, u + first, du + first, ddu + first,
                &(struct spin_out){.lift = l->falling ? NULL : at,
                                   .climb = l->falling ? at : NULL,
                                   .turning = l->falling ? turning : NULL,
                                   .heave = lobes ? heave : NULL});
        for (size_t i = 0; i < some && l->falling; i++)
            at[i] *= -fabs(turning[i]);
        for (size_t i = 0; i < some && lobes; i++)
            at[i] += heave[i];
        for (size_t i = 0; i < some; i++)
            at[i] = l->still + l->turned * at[i];
    }
}

/* At n <= LOAD_SOME instants. */
static void load_moved(const struct load_law *l, const struct trajectory *tr, size_t n, const double *t, double *force)
{
    double a[LOAD_SOME], b[LOAD_SOME], c[LOAD_SOME];
    if (l->turned > 0) {
        trajectory_at(tr, n, t, (struct trajectory_out){.u = a, .du = b, .ddu = c});
        load_turned(l, n, a, b, c, force);
        return;
    }
    if (load_gripped(l)) trajectory_at(tr, n, t, (struct trajectory_out){.ax = a, .ay = b});
    load_at(l, n, t, a, b, force);
}

void load_along(const struct load_law *l, const struct trajectory *tr, size_t n, const double *t, double *force)
{
    for (size_t first = 0; first < n; first += LOAD_SOME)
        load_moved(l, tr, n - first < LOAD_SOME ? n - first : LOAD_SOME, t + first, force + first);
}

double load_of(const struct load_law *l, const struct trajectory *tr, double t)
{
    double n;
    load_along(l, tr, 1, &t, &n);
    return n;
}

static double step(double q) { return q <= 0 ? 0 : q >= 1 ? 1 : q * q * q * (10 + q * (-15 + q * 6)); }

double load_lowered(const struct load_law *l, double t)
{
    double share = l->approach > 0 ? step(t / l->approach) : 1;
    return l->release > 0 ? share * step((l->duration - t) / l->release) : share;
}

/* ------------------------------------------------------------------ making */

static bool load_grip(const struct contact *c, struct load_law *l, struct err *e)
{
    double g = contact_gravity(c), m = c->scraper.mass, tangent = real_tan(c->grip.angle), slip = slip_of(&c->grip);
    if (jams(&c->grip))
        return err_set(e, ERR_SCENE,
                       "contact '%s': grip: the tool jams: friction x tan(angle) is %.4g, and must stay below 0.999; "
                       "lower grip.angle or "
                       "grip.friction",
                       c->name, 1 - slip);
    l->still = m * g / slip;
    l->per_acceleration[0] = m * tangent / slip * real_cos(c->grip.azimuth);
    l->per_acceleration[1] = m * tangent / slip * real_sin(c->grip.azimuth);
    return true;
}

static bool load_recorded(const struct contact *c, const struct trajectory *tr, struct arena *a, struct load_law *l,
                          struct err *e)
{
    static const char *const columns[2] = {"normal_force_n", NULL};
    struct load_record *r = ARENA_TAKE(a, struct load_record, 1);
    struct series s;
    if (!series_read(c->load.recorded, columns, a, &s, e) || !series_spaced(&s, c->load.recorded, e)) return false;
    double first = s.time[0], last = s.time[s.n - 1], start = tr->clock, end = tr->clock + tr->duration;
    if (first > start + 1e-9 || last < end - 1e-9)
        return err_set(e, ERR_SCENE,
                       "contact '%s': load.recorded: %s holds the normal force from %.9g s to %.9g s, but the motion "
                       "lasts from %.9g s to %.9g s; "
                       "it must cover the motion",
                       c->name, c->load.recorded, first, last, start, end);
    r->clock = tr->clock;
    series_cubic_natural(&r->spline, s.n, s.time, s.x[0], a);
    l->record = r;
    l->still = NAN;
    return true;
}

/* Rules tell what the scene alone shows; the motion itself tells whether its ends are at rest. */
static bool load_ends(const struct contact *c, const struct trajectory *tr, struct load_law *l, struct err *e)
{
    l->duration = tr->duration;
    bool scrapes = c->contact.model == CONTACT_SCRAPE;
    l->approach = isnan(c->load.approach) && scrapes && tr->starts_at_rest ? 0 : load_approach(c, false);
    l->release = isnan(c->load.release) && scrapes && tr->ends_at_rest ? 0 : load_approach(c, true);
    return l->approach + l->release <= tr->duration * (1 + 1e-9) ||
           err_about(e, c->name,
                     !isnan(c->load.approach)  ? "load.approach"
                     : !isnan(c->load.release) ? "load.release"
                                               : "motion") ||
           err_set(e, ERR_SCENE,
                   "contact '%s': load.approach, %.4g s, and load.release, %.4g s%s, do not fit into the motion, which "
                   "lasts %.4g s; give "
                   "shorter ones, or 0 s",
                   c->name, l->approach, l->release, isnan(c->load.approach) || isnan(c->load.release) ? " (auto)" : "",
                   tr->duration);
}

struct load_scan {
    const struct load_law *law;
    const struct trajectory *tr;
};

static void load_scan_at(const void *self, size_t n, const double *t, double *y)
{
    const struct load_scan *s = self;
    load_along(s->law, s->tr, n, t, y);
}

/* Instants that show each turn of a ball on its own, and each lobe of its rim. x = R theta - r sin theta goes through
   the lowest place of its centre of mass within about (R - r)^1.5 / R^0.5: as r comes near R the force there is a sharp
   pulse. */
static double load_turns(const struct load_law *l, const struct trajectory *tr)
{
    const struct spin *s = &l->spin;
    double turns = tr->cycle * tr->top_speed / (2 * REAL_PI * s->radius), sharp = 1 - s->offset / s->radius;
    return (s->lobe_height > 0 ? fmax(64, 16.0 * s->lobes) : 64) * ceil(turns) / (sharp * sqrt(sharp));
}

/* Extremes over the motion (over its first cycle when it repeats). */
static void load_range(struct load_law *l, const struct trajectory *tr)
{
    struct load_scan s = {l, tr};
    double range[2];
    long detail = 4 * tr->detail + (l->record       ? 4 * (long)l->record->spline.n
                                    : l->turned > 0 ? (long)load_turns(l, tr)
                                                    : 0);
    series_range(&(struct scan){load_scan_at, &s}, 0, l->record ? tr->duration : tr->cycle, detail, range);
    l->least = fmax(range[0], 0);
    l->most = fmax(range[1], 0);
}

bool load_make(const struct contact *c, const struct trajectory *tr, struct arena *a, struct load_law *l, struct err *e)
{
    double n = load_constant(c);
    *l = (struct load_law){.still = n, .least = n, .most = n};
    bool varies = load_varies(c);
    if (varies && !c->grip.given && !c->load.recorded) {
        l->spin = spin_make(c);
        l->spin.lobe_height = lobes_press(c) ? l->spin.lobe_height : 0;
        l->turned = c->scraper.mass;
        l->falling = c->load.phase == LOAD_FALLING;
    }
    if (varies && c->grip.given ? !load_grip(c, l, e) : varies && c->load.recorded && !load_recorded(c, tr, a, l, e))
        return false;
    if (!load_ends(c, tr, l, e)) return false;
    if (varies) load_range(l, tr);
    return true;
}

/* ------------------------------------------------------------------ the stage */

/* The stage that lays the normal force on the board: only a grip, a recording, or a ball that is heavier on one side or
 * not round makes it vary. */

static bool stage_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return load_varies(c);
}

static unsigned stage_asks(const struct contact *c, const struct scene *s)
{
    (void)s;
    if (!c->grip.given && !c->load.recorded)
        return ITEM_BIT(ITEM_POSITION) | ITEM_BIT(ITEM_VELOCITY) | ITEM_BIT(ITEM_ACCELERATION);
    if (!c->grip.given) return ITEM_BIT(ITEM_MOTION); /* its duration */
    return motion_straight(&c->motion) ? ITEM_BIT(ITEM_ACCELERATION) : ITEM_BIT(ITEM_AX) | ITEM_BIT(ITEM_AY);
}

static double stage_work(const struct contact *c, const struct scene *s)
{
    return (c->grip.given ? 4 : c->load.recorded ? 12 : 180) * s->accuracy.oversampling;
}

static bool stage_open(struct stage_run *r, struct err *e)
{
    struct load_law *l = ARENA_TAKE(r->arena, struct load_law, 1);
    r->board->load = l;
    return load_make(r->contact, r->board->trajectory, r->arena, l, e);
}

static bool stage_fill(struct stage_run *r, long from, long to, struct err *e)
{
    const struct board *b = r->board;
    const struct trajectory *tr = b->trajectory;
    bool grip = r->contact->grip.given;
    const double *line = grip && tr->straight ? board_at(b, ITEM_ACCELERATION, from) : NULL;
    const double *x = grip && !tr->straight ? board_at(b, ITEM_AX, from) : NULL,
                 *y = x ? board_at(b, ITEM_AY, from) : NULL;
    double *force = board_at(b, ITEM_LOAD, from), t[LOAD_SOME], ax[LOAD_SOME], ay[LOAD_SOME];
    (void)e;
    if (b->load->turned > 0) { /* of a ball; behind its end the board's motion stays as it is, and so does the force */
        load_turned(b->load, (size_t)((to - from) * b->over), board_at(b, ITEM_POSITION, from),
                    board_at(b, ITEM_VELOCITY, from), board_at(b, ITEM_ACCELERATION, from), force);
        return true;
    }
    for (long i = 0, n = (to - from) * b->over; i < n; i += LOAD_SOME) {
        size_t some = (size_t)(n - i < LOAD_SOME ? n - i : LOAD_SOME);
        for (size_t j = 0; j < some; j++)
            t[j] = fmin((double)(from * b->over + i + (long)j) / (b->rate * b->over), tr->duration);
        for (size_t j = 0; line && j < some; j++) {
            ax[j] = tr->e[0] * line[i + (long)j];
            ay[j] = tr->e[1] * line[i + (long)j];
        }
        load_at(b->load, some, t, line ? ax : x ? x + i : NULL, line ? ay : y ? y + i : NULL, force + i);
    }
    return true;
}

const struct stage load_stage = {
    .name = "load",
    .does = "normal force on the scraper over time",
    .params = &load_params,
    .paper = "000 eq. 8, 9; sec. 4.1",
    .idle = "no grip, no load.recorded, no ball that is off its centre or has lobes: the load is constant",
    .gives = ITEM_BIT(ITEM_LOAD),
    .asks = stage_asks,
    .wanted = stage_wanted,
    .work = stage_work,
    .open = stage_open,
    .run = stage_fill,
};
