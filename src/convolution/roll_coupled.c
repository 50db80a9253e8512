/* `contact.model: roll_coupled`: a ball that rolls, may bounce, and pushes back and forth with the surface's modes
   (convolution/coupled.h has the equations, papers/002 equations 1 to 3). This stage gives them what is under the ball,
   and keeps account.

   The motion is the way of the centre of mass (papers/000 equation 18); it goes on under a ball that flies, at the same
   speed.

   Steps. Each sub-interval of the force is K of them, K = ceil(contact_steps / (t_c rate oversampling)), t_c =
   coupled_contact_time of the stiffness and mass at the greatest of: the speed of the drop, sqrt(2 g h); 5 cm/s, the
   fastest of the impacts of papers/002, fig. 7; and the greatest |ds/dt| met where the curve is scouted
   (roll_coupled.c).
   s is read once for the end of each step, in order; the shapes of what gives way as roll_coupled.h says.

   The start. Dropped, the ball is at rest in the air, `drop` clear of the ground, whose modes are at rest, too: on
   rigid ground it touches after sqrt(2 h/g) with sqrt(2 g h), however soft the contact. Otherwise it lies there, bent
   into the ground, with no vertical speed. That the ground bore it before is known to the equations, but not to what
   sounds (ring_*), for which a weight that is there at once is a blow; so
   the force rises over load.approach where the ball lies at the start, and falls over load.release at the motion's end
   (force/approach.c, trajectory/load.h). The equations and the account (ITEM_ROLL) are of the ball without them. */
#include "convolution/roll_coupled.h"

#include <math.h>

#include "convolution/coupled.h"
#include "convolution/ring.h"
#include "force/approach.h"
#include "force/hertz.h"
#include "force/roll.h"
#include "num/real.h"
#include "response/response.h"
#include "scene/rows.h"
#include "scene/scene_part.h"
#include "stage.h"
#include "surface/relief.h"
#include "trajectory/contact.h"
#include "trajectory/spin.h"
#include "trajectory/trajectory.h"

/* The curve under a rolling ball: s(t) = z + rim + rise at the motion's place.

   z is the surface as the ball meets it (surface/tip.c: the rolling curve of papers/002, fig. 1), rise = -r cos(theta)
   that of the centre of mass over the geometric centre, rim that of the rim (trajectory/spin.h): the ball's lowest
   point is at w - R - rise - rim, w the height of the centre of mass, so that with w counted from R it dips into the
   surface by xi = s - w. */

struct roll_curve {
    const struct board *board;
    struct spin spin;
    bool turns;                          /* the ball is not quite round, or its centre of mass is off */
    double *t, *s;                       /* [room] s: instants since the contact's start, m            */
    double *u, *du, *x, *y, *rise, *rim; /* [room] work                                   */
};

enum { ROLL_CURVE_LEAST = 1024 };

enum { STRETCHES = 16 };

/* r: of a stage whose relief and motion are on the board; for up to `room` >= ROLL_CURVE_LEAST instants at a time. */
static void roll_curve_make(struct roll_curve *c, const struct stage_run *r, long room)
{
    double **all[] = {&c->t, &c->s, &c->u, &c->du, &c->x, &c->y, &c->rise, &c->rim};
    *c = (struct roll_curve){.board = r->board,
                             .spin = spin_make(r->contact),
                             .turns = r->contact->ball.offset != 0 || r->contact->ball.lobe_height != 0};
    for (size_t k = 0; k < sizeof all / sizeof all[0]; k++)
        *all[k] = ARENA_TAKE(r->arena, double, room);
}

/* s at the n instants in c->t. */
static void roll_curve_read(const struct roll_curve *c, size_t n)
{
    const struct relief *z = c->board->relief;
    bool path = z->along == ALONG_PATH, plane = z->along == ALONG_PLANE;
    trajectory_at(c->board->trajectory, n, c->t,
                  (struct trajectory_out){.u = c->u, .du = c->du, .x = path ? NULL : c->x, .y = plane ? c->y : NULL});
    relief_at(z, &(struct relief_points){n, path ? c->u : c->x, plane ? c->y : NULL},
              &(struct relief_values){.z = c->s});
    if (!c->turns) return;
    spin_at(&c->spin, n, c->u, c->du, NULL, &(struct spin_out){.rise = c->rise, .rim = c->rim});
    for (size_t i = 0; i < n; i++)
        c->s[i] += c->rim[i] + c->rise[i];
}

/* The greatest |ds/dt| met, m/s: differences over sub-intervals, in 16 stretches of 1024 instants spread evenly over
   the motion, or one of a short one. */
static double roll_curve_fastest(const struct roll_curve *c)
{
    const struct board *b = c->board;
    double dt = 1 / (b->rate * b->over), room = b->trajectory->duration - dt * (ROLL_CURVE_LEAST - 1), fastest = 0;
    for (int k = 0; k < STRETCHES && (k == 0 || room > 0); k++) {
        for (int i = 0; i < ROLL_CURVE_LEAST; i++)
            c->t[i] = fmax(room, 0) * k / (STRETCHES - 1) + i * dt;
        roll_curve_read(c, ROLL_CURVE_LEAST);
        for (int i = 1; i < ROLL_CURVE_LEAST; i++)
            fastest = fmax(fastest, fabs(c->s[i] - c->s[i - 1]) / dt);
    }
    return fastest;
}

#define PAPER_SPEED 0.05   /* m/s */
#define DEEP 0.1           /* of the radius: a rest deeper than that is reported */
#define STILL_BOUNCES 0.01 /* of the drop: a last flight higher than that is reported */
enum { LEG_STEPS = 4096, LEG_FRAMES = 128, SUBSTEPS_MOST = 1000, FEW_STEPS = 4 };

struct rolling {
    struct coupled *ball;
    struct roll_curve curve;
    struct roll_ground ground;
    int substeps, per_frame; /* steps of a sub-interval, of a frame                          */
    long longest;            /* frames of a leg, at most                                     */
    long leg, end;           /* frames: where the leg at hand begins, and ends               */
    double *force;           /* [longest * per_frame] N, over the steps of the leg           */
    struct coupled_state
        *seen; /* [longest + 1] where the board asks for ITEM_ROLL: before each of its frames, and after the last */
    double mass, stiffness, gravity, drop;
    double rest;     /* m, height of the ball that lies where the motion starts           */
    double residual; /* J, greatest at the legs' ends                                */
    bool over;       /* the end has been reported                                   */
};

/* ------------------------------------------------------------------ opening */

/* What gives way (roll_coupled.h). The modes are those that sound (ring_choice.h): the strongest of the band, below
   0.45 of the sample rate; the give of all others is left out. */

static bool is_modal(const struct contact *c)
{
    const struct response *given = &c->surface.response;
    return roll_coupled_of(c)->ground != GROUND_RIGID && response_given(given) && !response_is_recorded(given);
}

static void ground_phi(const struct roll_ground *g, long frame, double *phi)
{
    double t = (double)frame / g->board->rate;
    struct modes_where at = g->first;
    if (g->moves) trajectory_at(g->board->trajectory, 1, &t, (struct trajectory_out){.x = &at.x, .y = &at.y});
    modes_shapes_at(&g->shapes, &at, phi);
}

bool roll_coupled_ground_make(struct roll_ground *g, const struct stage_run *r, struct err *e)
{
    const struct contact *c = r->contact;
    const struct response *given = &c->surface.response;
    const struct ring_choice *choice = given->choice;
    *g = (struct roll_ground){.board = r->board};
    if (!is_modal(c))
        return roll_coupled_of(c)->ground != GROUND_ELASTIC ||
               err_set(e, ERR_SCENE,
                       "contact '%s': contact.roll.ground: elastic needs modes of the surface, and %s; give "
                       "surface.object, or take ground: rigid",
                       c->name, response_given(given) ? "a recorded response has none" : "it has no response");
    if (!choice && !ring_choice_make(c, r->scene, RING_SURFACE, r->arena, &choice, e)) return false;
    if (!modes_shapes_make(&choice->modes, "surface", r->arena, &g->shapes, e))
        return err_at(e, "contact '%s'", c->name);
    g->moves = g->shapes.moves && c->motion.path != PATH_STILL && !contact_one_place(c);
    g->first = ring_first_place(c, g->board->trajectory);
    g->ramp = (long)r->scene->accuracy.gain_ramp;
    g->phi = ARENA_TAKE(r->arena, double, g->shapes.n);
    g->from = ARENA_TAKE(r->arena, double, g->shapes.n);
    g->to = ARENA_TAKE(r->arena, double, g->shapes.n);
    ground_phi(g, 0, g->to);
    return ring_reach(&choice->modes, r, e) || err_about(e, c->name, ring_choice_about(c, RING_SURFACE));
}

const double *roll_coupled_ground_start(const struct roll_ground *g) { return g->shapes.n > 0 ? g->to : NULL; }

const double *roll_coupled_ground_next(struct roll_ground *g, long frame, long *frames)
{
    if (!g->moves) return NULL;
    if (frame == g->ramp_end) {
        double *from = g->to;
        g->to = g->from;
        g->from = from;
        g->ramp_end += g->ramp;
        ground_phi(g, g->ramp_end, g->to);
    }
    if (frame + *frames >= g->ramp_end) {
        *frames = g->ramp_end - frame;
        return g->to;
    }
    double share = 1 - (double)(g->ramp_end - frame - *frames) / (double)g->ramp;
    for (int i = 0; i < g->shapes.n; i++)
        g->phi[i] = g->from[i] + share * (g->to[i] - g->from[i]);
    return g->phi;
}

double roll_coupled_ground_modes(const struct contact *c)
{
    const struct response *given = &c->surface.response;
    return !is_modal(c) ? 0 : given->choice ? given->choice->modes.n : given->modes;
}

static bool rolling_body(struct rolling *w, const struct contact *c, struct err *e)
{
    w->mass = c->scraper.mass;
    w->gravity = contact_gravity(c);
    w->drop = roll_coupled_of(c)->drop;
    w->stiffness = hertz_given(c);
    return !isnan(w->stiffness) || hertz_stiffness(c, &w->stiffness, e);
}

static double substeps_for(double contact_steps, double contact_time, double sub_rate)
{
    return fmax(ceil(contact_steps / (contact_time * sub_rate) - 1e-9), 1);
}

static bool rolling_steps(struct rolling *w, const struct stage_run *r, struct err *e)
{
    const struct board *b = r->board;
    struct roll_curve scout;
    roll_curve_make(&scout, r, ROLL_CURVE_LEAST);
    double speed = fmax(fmax(PAPER_SPEED, sqrt(2 * w->gravity * w->drop)), roll_curve_fastest(&scout));
    double time = coupled_contact_time(w->mass, w->stiffness, speed),
           substeps = substeps_for(r->scene->accuracy.contact_steps, time, b->rate * b->over);
    if (!(substeps <= SUBSTEPS_MOST))
        return err_about(e, NULL, "accuracy.contact_steps") ||
               err_set(e, ERR_SCENE,
                       "contact '%s': an impact at %.3g m/s lasts %.3g s, and accuracy.contact_steps: %g in it would "
                       "be %.6g steps per audio sample; lower accuracy.contact_steps, "
                       "or contact.roll.stiffness (or kappa)",
                       r->contact->name, speed, time, r->scene->accuracy.contact_steps, substeps * b->over);
    w->substeps = (int)substeps;
    w->per_frame = w->substeps * b->over;
    w->longest = LEG_STEPS / w->per_frame > 1 ? LEG_STEPS / w->per_frame : 1;
    w->longest = w->longest < LEG_FRAMES ? w->longest : LEG_FRAMES;
    long room = w->longest * w->per_frame;
    w->force = ARENA_TAKE(r->arena, double, room);
    w->seen = ARENA_TAKE(r->arena, struct coupled_state, w->longest + 1);
    roll_curve_make(&w->curve, r, room > ROLL_CURVE_LEAST ? room : ROLL_CURVE_LEAST);
    return true;
}

static void rolling_start(struct rolling *w, struct stage_run *r)
{
    const double *s = w->curve.s, *phi = roll_coupled_ground_start(&w->ground);
    w->curve.t[0] = 0;
    roll_curve_read(&w->curve, 1);
    w->rest = coupled_rest(w->ball, *s, phi);
    coupled_flights(w->ball, 1 / r->board->rate);
    coupled_start(w->ball, w->drop > 0 ? *s + w->drop : w->rest, 0, *s, phi, !(w->drop > 0));
    if (w->drop > 0) approach_warn(r, "the ball's first impact", sqrt(2 * w->drop / w->gravity));
}

static bool rolling_open(struct stage_run *r, struct err *e)
{
    const struct contact *c = r->contact;
    struct rolling *w = ARENA_TAKE(r->arena, struct rolling, 1);
    struct board *b = r->board;
    r->state = w;
    relief_decide(b->relief, c);
    if (!rolling_body(w, c, e) || !roll_coupled_ground_make(&w->ground, r, e) || !rolling_steps(w, r, e)) return false;
    struct coupled_ask ask = {.integrator = roll_coupled_of(c)->integrator,
                              .step = 1 / (b->rate * b->over * w->substeps),
                              .mass = w->mass,
                              .weight = w->mass * w->gravity,
                              .stiffness = w->stiffness,
                              .mu = hertz_of(c)->mu,
                              .n = w->ground.shapes.n,
                              .frequency = w->ground.shapes.frequency,
                              .decay = w->ground.shapes.decay};
    if (!coupled_make(r->arena, &ask, &w->ball, e)) return err_at(e, "contact '%s'", c->name);
    rolling_start(w, r);
    b->rolls = true;
    b->roll = (struct roll_report){.stiffness = w->stiffness,
                                   .rest = real_pow(ask.weight / w->stiffness, 2.0 / 3),
                                   .roughness = NAN,
                                   .hertz = NAN,
                                   .step = ask.step};
    if (b->roll.rest > DEEP * c->scraper.radius)
        board_warn(b, arena_format(r->arena,
                                   "contact '%s': at rest the ball is pressed in by %.3g m, %.3g times its radius, and "
                                   "the contact's law is one of shallow dents: raise contact.roll.stiffness (or kappa)",
                                   c->name, b->roll.rest, b->roll.rest / c->scraper.radius));
    return true;
}

/* ------------------------------------------------------------------ running */

/* The leg from `frame` on. Legs end where the shapes under the ball bend (roll_coupled.h) and where the motion does,
   whatever blocks are asked for, so that these change no bit; what it costs to begin and end a run of steps (shapes,
   the ledger) is paid once a leg: 2000 of 2800 cycles a sample when it was once a frame. */
static bool rolling_leg(struct rolling *w, struct stage_run *r, long frame, struct err *e)
{
    const struct board *b = r->board;
    double before = (double)frame * w->per_frame, per_second = b->rate * w->per_frame;
    long frames = w->longest < b->moving - frame ? w->longest : b->moving - frame;
    const double *phi_to = roll_coupled_ground_next(&w->ground, frame, &frames);
    int steps = (int)frames * w->per_frame;
    for (int i = 0; i < steps; i++)
        w->curve.t[i] = (before + i + 1) / per_second;
    roll_curve_read(&w->curve, (size_t)steps);
    coupled_watch(w->ball, board_has(b, ITEM_ROLL) ? w->per_frame : 0, w->seen);
    if (!coupled_run(w->ball, steps, w->curve.s, phi_to, w->force, e))
        return err_at(e, "contact '%s', %.6g s after its start", r->contact->name,
                      (double)coupled_state(w->ball)->steps / per_second);
    w->residual = fmax(w->residual, fabs(coupled_state(w->ball)->residual));
    w->seen[frames] = *coupled_state(w->ball);
    w->leg = frame;
    w->end = frame + frames;
    return true;
}

/* Of a frame of the leg: what holds at its beginning; and of contacts what happens in it. */
static void rolling_note(const struct rolling *w, const struct board *b, long frame)
{
    const struct coupled_state *s = w->seen + (frame - w->leg);
    double *v = board_at(b, ITEM_ROLL, frame);
    v[ROLL_PENETRATION] = s->penetration;
    v[ROLL_HEIGHT] = s->height - w->rest;
    v[ROLL_ENERGY] = s->energy;
    v[ROLL_SURFACE_WORK] = s->surface_work;
    v[ROLL_CONTACT_LOSS] = s->contact_loss;
    v[ROLL_MODE_LOSS] = s->mode_loss;
    v[ROLL_RESIDUAL] = s->residual;
    v[ROLL_CONTACT] = (s[1].contact_time - s->contact_time) * b->rate;
    v[ROLL_LIFT_OFFS] = (double)(s[1].lift_offs - s->lift_offs);
}

/* Means over the frame's sub-intervals, from those over steps. */
static void rolling_mean_force(const struct rolling *w, const struct board *b, long frame)
{
    const double *force = w->force + (frame - w->leg) * w->per_frame;
    double *to = board_at(b, ITEM_SUBFORCE, frame);
    for (int i = 0; i < b->over; i++, force += w->substeps) {
        double sum = 0;
        for (int k = 0; k < w->substeps; k++)
            sum += force[k];
        to[i] = sum / w->substeps;
    }
}

static void rolling_report(const struct rolling *w, struct board *b)
{
    const struct coupled_state *s = coupled_state(w->ball);
    struct roll_report *o = &b->roll;
    o->contact = s->contact_time;
    o->time = (double)w->end / b->rate;
    o->lift_offs = s->lift_offs;
    o->bounces = s->flights + (s->lift_offs > 0 && s->flight > 1 / b->rate); /* the last one may still go on */
    o->steps = s->steps;
    o->contact_samples[0] = s->lift_offs > 0 ? s->contact_sum / (double)s->lift_offs * b->rate : NAN;
    o->contact_samples[1] = s->lift_offs > 0 ? s->contact_least * b->rate : NAN;
    o->fastest = s->impact_most;
    o->residual = s->highest > 0 ? w->residual / s->highest : 0;
    o->iterations[0] = s->contact_steps > 0 ? (double)s->iterations / (double)s->contact_steps : 0;
    o->iterations[1] = (double)s->iterations_most;
}

/* Remarks at the motion's end. */
static void report_bounces(const struct rolling *w, struct stage_run *r)
{
    const struct coupled_state *s = coupled_state(w->ball);
    struct board *b = r->board;
    const char *name = r->contact->name;
    double still = s->lift_offs > 0 ? fmax(s->hop[0], s->hop[1]) : 0, fastest = s->impact_most;
    double steps = fastest > 0 ? coupled_contact_time(w->mass, w->stiffness, fastest) / b->roll.step : HUGE_VAL;
    if (contact_gravity(r->contact) == 0)
        board_warn(b, arena_format(r->arena,
                                   "contact '%s': nothing presses the ball down: contact.gravity is 0, and once it is "
                                   "off the surface it stays off",
                                   name));
    else if (s->contact_time == 0)
        board_warn(b, arena_format(r->arena,
                                   "contact '%s': the ball never touches the surface: let the motion last longer than "
                                   "the fall, or lower contact.roll.drop",
                                   name));
    else if (w->drop > 0 && still > STILL_BOUNCES * w->drop)
        board_warn(b, arena_format(r->arena,
                                   "contact '%s': the ball still bounces %.3g m high when its motion ends, and is cut "
                                   "off there: let the motion last longer",
                                   name, still));
    if (steps < FEW_STEPS)
        board_warn(
            b, arena_format(
                   r->arena,
                   "contact '%s': the fastest impact, at %.3g m/s, takes %.2g steps only: raise accuracy.contact_steps",
                   name, fastest, steps));
}

static bool rolling_run(struct stage_run *r, long from, long to, struct err *e)
{
    struct rolling *w = r->state;
    struct board *b = r->board;
    long end = to < b->moving ? to : b->moving;
    for (long frame = from; frame < end; frame++) {
        if (frame >= w->end && !rolling_leg(w, r, frame, e)) return false;
        if (board_has(b, ITEM_ROLL)) rolling_note(w, b, frame);
        if (board_has(b, ITEM_SUBFORCE)) rolling_mean_force(w, b, frame);
    }
    for (int item = 0; item < ITEM_COUNT; item++) {
        const struct signal *x = &b->signals[item];
        if ((item == ITEM_SUBFORCE || item == ITEM_ROLL) && x->per_frame > 0)
            for (double *v = board_at(b, item, from > end ? from : end), *last = board_at(b, item, to); v < last; v++)
                *v = 0;
    }
    if (from < b->moving) rolling_report(w, b);
    if (to >= b->moving && !w->over) {
        w->over = true;
        report_bounces(w, r);
    }
    return true;
}

/* ------------------------------------------------------------------ the plan */

static bool rolling_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return c->contact.model == CONTACT_ROLL_COUPLED;
}

/* The modes' shapes under the ball are ramped. */
static unsigned rolling_turns(const struct contact *c, const struct scene *s)
{
    (void)s;
    return roll_coupled_ground_modes(c) > 0 && c->motion.path != PATH_STILL ? KNOB_BIT(gain_ramp) : 0;
}

/* Cycles of a step: 160 on rigid ground, 110 of its place on the curve, 2 a mode; of rk4 670 and 12 a mode. */
static double rolling_work(const struct contact *c, const struct scene *s)
{
    double k = hertz_given(c), rate = s->output.sample_rate * s->accuracy.oversampling;
    struct err unknown = {0};
    if (isnan(k) && !hertz_stiffness(c, &k, &unknown)) return 0;
    bool rk4 = roll_coupled_of(c)->integrator == INTEGRATOR_RK4;
    double time = coupled_contact_time(c->scraper.mass, k,
                                       fmax(PAPER_SPEED, sqrt(2 * contact_gravity(c) * roll_coupled_of(c)->drop)));
    return s->accuracy.oversampling * substeps_for(s->accuracy.contact_steps, time, rate) *
           (rk4 ? 670 + 12 * roll_coupled_ground_modes(c) : 270 + 2 * roll_coupled_ground_modes(c));
}

/* ------------------------------------------------------------------ parameters */

#define ROLLS "contact.model=roll_coupled"

static const struct choice integrators[] = {
    [INTEGRATOR_DISCRETE_GRADIENT] = {"discrete_gradient",
                                      "the midpoint rule with a discrete gradient and exact poles: energy is balanced "
                                      "to rounding, stable at any step"},
    [INTEGRATOR_RK4] =
        {"rk4",
         "the explicit fourth-order Runge-Kutta method, as Conan et al. (2014a) have it; refused below 12 steps per "
         "contact"},
    [INTEGRATOR_EXACT_IMPACT] = {"exact_impact", "each impact exact at any step; on rigid ground only"},
    {NULL, NULL}};

static const struct choice grounds[] = {
    [GROUND_AUTO] = {"auto", "elastic where the surface rings by modes, else rigid"},
    [GROUND_ELASTIC] = {"elastic", "the surface's modes give way under the ball and push back"},
    [GROUND_RIGID] = {"rigid", "the surface does not give way; its response only sounds"},
    {NULL, NULL}};

static const struct key keys[] = {{ROW_CHOICE(roll_coupled, integrator, "contact.roll.integrator"), KEY_NONE, 0, 0,
                                   "discrete_gradient", ROLLS, "how the equations of motion are solved", integrators},
                                  {ROW_CHOICE(roll_coupled, ground, "contact.roll.ground"), KEY_NONE, 0, 0, "auto",
                                   ROLLS, "does the surface give way?", grounds},
                                  {ROW_NUMBER(roll_coupled, drop, "contact.roll.drop"), KEY_LENGTH, 0, 100, "0 m",
                                   ROLLS,
                                   "height from which the ball is dropped at the start: the clear distance to the "
                                   "ground before anything gives way; 0: "
                                   "it lies on the surface, at rest on it"},
                                  {.path = NULL}};

/* Why the surface cannot give way; NULL: it may, as far as the scene tells (the poles of a mode table are known when it
 * has been read). */
static const char *why_rigid(const struct response *r)
{
    if (!response_given(r)) return "the surface has no modes";
    if (response_is_recorded(r)) return "what is recorded has no modes";
    return response_travels(&r->space) ? "a surface.space that travels has no mode shapes" : NULL;
}

static void ground_check(const struct scene_part *p, const struct contact *c)
{
    const char *ground = "contact.roll.ground", *integrator = "contact.roll.integrator",
               *why = why_rigid(&c->surface.response);
    bool elastic = roll_coupled_of(c)->ground == GROUND_ELASTIC,
         exact = roll_coupled_of(c)->integrator == INTEGRATOR_EXACT_IMPACT;
    if (!scene_part_known(p, ground) || !scene_part_known(p, integrator)) return;
    if (elastic && why)
        scene_part_refuse(
            p, ground, ground,
            "give surface.object, or a mode table with shared poles as surface.response; or set it to rigid",
            " is elastic, and %s", why);
    else if (exact && (elastic || (roll_coupled_of(c)->ground == GROUND_AUTO && !why)))
        scene_part_refuse(p, integrator, ground,
                          "set contact.roll.ground to rigid, or leave contact.roll.integrator out",
                          ": exact_impact needs rigid ground, and %s is %s", scene_part_label(p, ground),
                          elastic ? "elastic" : "auto, which is elastic where the surface rings by modes");
}

/* What is dropped without gravity never arrives. */
static void drop_check(const struct scene_part *p, const struct contact *c)
{
    const char *drop = "contact.roll.drop", *gravity = "contact.gravity";
    if (roll_coupled_of(c)->drop > 0 && c->contact.gravity == 0)
        scene_part_refuse(p, drop, gravity, "raise contact.gravity, or lay the ball down with drop: 0",
                          " is %.4g m and %s is 0: the ball never arrives", roll_coupled_of(c)->drop,
                          scene_part_label(p, gravity));
}

static void coupled_check(const struct scene_part *p, const struct contact *c, const void *own)
{
    (void)own;
    if (c->ball.patch == 0 && relief_along(c) == ALONG_PLANE)
        scene_part_refuse(
            p, "ball.patch", "ball.patch",
            "write for instance: patch: 20 um; or let the surface follow the path, by surface.along: path",
            " must be above 0 on a surface in the plane: only along a line is the rolling curve known without "
            "smoothing");
    ground_check(p, c);
    drop_check(p, c);
    if (!scene_part_given(p, "contact.roll.stiffness") && !scene_part_given(p, "contact.roll.kappa"))
        hertz_check(p, c,
                    "the stiffness of the contact follows from it, unless contact.roll.stiffness (or kappa) is given");
}

static void coupled_derive(struct contact *c, void *own)
{
    c->load.falls = ((const struct roll_coupled *)own)->drop > 0;
}

static bool rolls(const struct contact *c) { return c->contact.model == CONTACT_ROLL_COUPLED; }

static const struct params coupled_params = {
    .section = "contact.roll",
    .size = sizeof(struct roll_coupled),
    .keys = keys,
    .derive = coupled_derive,
    .check = coupled_check,
    .given = rolls,
};

const struct roll_coupled *roll_coupled_of(const struct contact *c) { return params_of(c, &coupled_params); }

const struct stage roll_coupled_stage = {
    .name = "roll_coupled",
    .params = &coupled_params,
    .does = "ball, contact and the surface's modes solved together: flights, impacts, rolling",
    .paper = "002 eq. 1 to 4",
    .idle = "contact.model is not roll_coupled",
    .needs = ITEM_BIT(ITEM_SURFACE) | ITEM_BIT(ITEM_MOTION), /* read at the steps' own instants */
    .gives = ITEM_BIT(ITEM_SUBFORCE) | ITEM_BIT(ITEM_ROLL),
    .knobs = KNOB_BIT(oversampling) | KNOB_BIT(contact_steps),
    .turns = rolling_turns,
    .wanted = rolling_wanted,
    .work = rolling_work,
    .open = rolling_open,
    .run = rolling_run,
    .report = roll_report,
};
