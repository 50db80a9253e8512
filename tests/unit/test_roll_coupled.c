/* roll_coupled as a stage: flights and impacts of a dropped ball against parabolas and quadrature, momentum against
   gravity's, the rule of its steps, the sag of a plate under a ball that rolls slowly over its nodal lines, the account
   of energy, diagnostics rows, and what is refused. */
#include <gsl/gsl_integration.h>
#include <unistd.h>

#include "convolution/ring_choice.h"
#include "convolution/roll_coupled.h"
#include "file/csv.h"
#include "force/hertz.h"
#include "output/force_table.h"
#include "pipeline/render.h"
#include "response/object.h"
#include "rig.h"
#include "trajectory/trajectory.h"

static const double g = 9.80665;

/* ------------------------------------------------------------------ surfaces */

static double wave_height, wave_number;

static void wave_add(struct relief_part *p, const struct relief_points *at, const struct relief_values *to)
{
    (void)p;
    for (size_t i = 0; i < at->n; i++) {
        double phase = wave_number * at->x[i];
        if (to->z) to->z[i] += wave_height * (cos(phase) - 1);
        if (to->x) to->x[i] -= wave_height * wave_number * sin(phase);
        if (to->xx) to->xx[i] -= wave_height * wave_number * wave_number * cos(phase);
    }
}

static struct relief_part *wave(struct arena *a, const struct contact *c)
{
    struct relief_part *p = ARENA_TAKE(a, struct relief_part, 1);
    (void)c;
    *p = (struct relief_part){.name = "wave",
                              .finest = wave_number > 0 ? 1 / wave_number : HUGE_VAL,
                              .from = {-HUGE_VAL, -HUGE_VAL},
                              .to = {HUGE_VAL, HUGE_VAL},
                              .add = wave_add};
    return p;
}

static struct scene scene_of(const char *ball, const char *surface, const char *motion, const char *roll,
                             const char *rest)
{
    rig_relief = wave;
    return rig_scene(rig_arena(),
                     arena_format(rig_arena(),
                                  "rasp: 1\nball: {radius: 1 cm, mass: 10 g%s}\nsurface: {roughness: {rms: 1 um}%s}\n"
                                  "motion: {%s}\ncontact: {model: roll_coupled, roll: {%s}}\n%s%s",
                                  ball, surface, motion, roll, rest,
                                  strstr(rest, "output") ? "" : "\noutput: {sample_rate: 48 kHz, diagnostics: {}}\n"));
}

static struct scene on_rigid(const char *motion, const char *roll, const char *rest)
{
    return scene_of("", "", motion, roll, rest);
}

#define PLATE                                                                                                          \
    ", material: steel, modes: 20, "                                                                                   \
    "object: {shape: plate, edges: supported, length: 30 cm, width: 20 cm, thickness: 2 mm}"

/* ------------------------------------------------------------------ impacts */

struct impact {
    double v, k, m, most; /* m/s, N/m^1.5, kg; m: deepest */
};

/* v^2 + 2 g x - (4/5) (k/m) x^2.5: the square of the speed at a penetration of x. */
static double speed2(const struct impact *i, double x)
{
    return i->v * i->v + 2 * g * x - 0.8 * i->k / i->m * x * x * sqrt(x);
}

/* dt at x = most (1 - y^2), whose root at the turning point is no pole. */
static double passing(double y, void *self)
{
    const struct impact *i = self;
    return y > 0 ? 2 * i->most * y / sqrt(speed2(i, i->most * (1 - y * y))) : 0;
}

/* s, of an impact at v without loss, gravity included. */
static double impact_lasts(double v, double k, double m)
{
    struct impact i = {v, k, m, 0};
    double low = 0, high = 1e-2, sum, error;
    for (int n = 0; n < 200; n++) {
        i.most = 0.5 * (low + high);
        *(speed2(&i, i.most) > 0 ? &low : &high) = i.most;
    }
    gsl_integration_workspace *w = gsl_integration_workspace_alloc(1000);
    i.most = low;
    gsl_integration_qags(&(gsl_function){passing, &i}, 0, 1, 0, 1e-9, 1000, w, &sum, &error);
    gsl_integration_workspace_free(w);
    return 2 * sum;
}

/* Rigid flat ground, nothing lost: after a fall from h over the ground, h + x_0 over where the ball lies, x_0 = (m
   g/k)^(2/3) deep, it flies in parabolas from 0 to v and back, the impacts between
   them as long as quadrature says. Heights at all frames in the air: in the n-th flight off by v times n impacts'
   error, 4e-5 of each (order 2, 400 steps), and rounding. */
START_TEST(a_ball_that_loses_nothing_bounces_in_parabolas)
{
    struct scene s = on_rigid("path: still, duration: 0.5 s", "stiffness: 1e8 N/m^1.5, mu: 0 s/m, drop: 1 mm",
                              "accuracy: {contact_steps: 400}");
    struct rig *r = rig_record(&s, ITEM_ROLL, 20000, 1024);
    double rest = pow(0.01 * g / 1e8, 2.0 / 3), fall = 1e-3, v = sqrt(2 * g * fall);
    double lasts = impact_lasts(v, 1e8, 0.01), rate = s.output.sample_rate, worst = 0;
    long flown = 0, flights = 0;
    for (long n = 0; n < r->frames; n++) {
        double t = (double)n / rate - v / g, period = 2 * v / g + lasts, k = floor(t / period),
               q = t - k * period - lasts;
        if (t < 0) k = 0, q = t + 2 * v / g;
        if (q <= 0) continue;
        double height = rest + v * q - 0.5 * g * q * q, off = fabs(r->x[n * ROLL_VALUES + ROLL_HEIGHT] - height);
        ck_assert_msg(off < 1e-12 + v * (k + 1) * 4e-5 * lasts, "%ld: %g, %g", n, r->x[n * ROLL_VALUES + ROLL_HEIGHT],
                      height);
        worst = fmax(worst, off);
        flown++;
        flights = (long)k + 1;
    }
    const struct roll_report *o = &r->run.board.roll;
    ck_assert_int_gt(flown, 19000);
    ck_assert_int_eq(o->lift_offs, flights);
    ck_assert_int_eq(o->bounces, flights); /* the fall is none, and the last one still goes on */
    ck_assert_double_eq_tol(o->fastest, v, 1e-3 * v);
    ck_assert_double_eq_tol(o->contact_samples[0], lasts * rate, 1e-3 * lasts * rate);
    ck_assert_double_eq_tol(o->contact_samples[1], lasts * rate, 1e-3 * lasts * rate);
    ck_assert_double_lt(o->residual, 1e-11);
    rig_close(r);
}
END_TEST

/* Dropped from h over the ground, whatever gives way when it lands: before it touches, xi = g t^2 / 2 - h to rounding,
   then it is in contact at once, having come at sqrt(2 g h), up to what gravity adds in a step. Soft contacts (3 mm
   deep at rest) and stiff ones, rigid ground and a plate that sags, every integrator, at random heights. The old
   reading, from where the ball lies, is off by that depth. */
START_TEST(dropped_from_the_ground)
{
    static const char *const integrators[] = {"discrete_gradient", "rk4", "exact_impact"};
    srand48(8);
    for (int trial = 0; trial < 18; trial++) {
        double h = 1e-4 * pow(200, drand48()), k = trial % 3 ? 600 * pow(10, 8 * drand48()) : 600;
        double t = sqrt(2 * h / g), v = g * t;
        bool plate = trial % 2 && trial % 3 != 2;
        const char *roll = arena_format(rig_arena(), "stiffness: %.17g N/m^1.5, drop: %.17g m, integrator: %s", k, h,
                                        integrators[trial % 3]);
        wave_height = 0;
        struct scene s = scene_of("", plate ? PLATE : "", "path: still, at: [10 cm, 8 cm], duration: 0.15 s", roll, "");
        struct rig *r = rig_record(&s, ITEM_ROLL, 4000, 1024);
        double rate = s.output.sample_rate, step = r->run.board.roll.step;
        long lands = (long)floor(t * rate);
        ck_assert_int_lt(lands, 3900);
        for (long n = 0; n <= lands; n++) {
            double xi = 0.5 * g * (double)n / rate * (double)n / rate - h;
            ck_assert_double_eq_tol(r->x[n * ROLL_VALUES + ROLL_PENETRATION], xi, 1e-10 * h);
            ck_assert(n == lands || r->x[n * ROLL_VALUES + ROLL_CONTACT] == 0);
        }
        ck_assert_double_gt(r->x[(lands + 1) * ROLL_VALUES + ROLL_PENETRATION], 0);
        ck_assert_double_eq_tol(r->run.board.roll.fastest, v, 1.01 * g * step + 1e-9 * v);
        rig_close(r);
    }
}
END_TEST

/* The force hands over just the momentum that gravity took away: over a drop that comes to rest (mu 100 s/m: the
   dashpot about rest is mu m g, 1/e in 2 ms), m g t, to rounding of the sum and what is left of e^(-0.3 s mu g / 2);
   then it is m g, step for step. The force rises over 5 ms only where the ball lies at the start, and falls at the end.
 */
START_TEST(momentum_is_gravitys)
{
    for (int lies = 0; lies < 2; lies++) {
        struct scene s =
            on_rigid("path: still, duration: 0.5 s",
                     arena_format(rig_arena(), "stiffness: 1e8 N/m^1.5, mu: 100 s/m, drop: %s", lies ? "0 m" : "1 mm"),
                     "accuracy: {contact_steps: 400}");
        struct rig *r = rig_record(&s, ITEM_SUBFORCE, 24100, 1024);
        double rate = s.output.sample_rate, weight = 0.01 * g, sum = 0;
        long over = r->per_frame, until = (long)(0.49 * rate);
        for (long i = 0; i < until * over; i++)
            sum += r->x[i] - weight;
        double rise = lies ? -weight * 2.5e-3 : 0; /* half of the 5 ms, the step being odd about its middle */
        ck_assert_double_eq_tol(sum / (rate * (double)over), rise, 1e-9 * weight);
        for (long i = (long)(0.4 * rate) * over; i < until * over; i++)
            ck_assert_double_eq_tol(r->x[i], weight, 1e-9 * weight);
        ck_assert_double_lt(r->x[(long)(0.4999 * rate) * over], 1e-3 * weight);
        for (long i = 24000 * over; i < 24100 * over; i++)
            ck_assert_double_eq(r->x[i], 0);
        ck_assert(lies ? r->x[0] < 1e-6 * weight && r->x[0] > 0 : r->x[0] == 0);
        rig_close(r);
    }
}
END_TEST

/* ------------------------------------------------------------------ steps */

static void step_is(const struct scene *s, double speed, int least)
{
    struct scene own = *s;
    struct rig *r = rig_record(&own, ITEM_ROLL, 100, 100);
    double m = s->contacts[0].scraper.mass, k = hertz_of(&s->contacts[0])->stiffness,
           lasts = 2.9432751843247045 * pow(5 * m / (4 * k), 0.4) * pow(speed, -0.2);
    double sub = s->output.sample_rate * s->accuracy.oversampling, n = ceil(s->accuracy.contact_steps / (lasts * sub));
    ck_assert_double_ge(n, least);
    ck_assert_double_eq_tol(r->run.board.roll.step, 1 / (sub * n), 1e-12 / sub);
    rig_close(r);
}

/* By the drop, by 5 cm/s, and by the surface: 0.1 mm cos(2 pi x / 5 mm) at 2 m/s rises at 0.2513 m/s, on which a ball
 * of 1 mm rides without leaving a hollow out. */
START_TEST(steps_follow_the_fastest_impact)
{
    struct scene s = on_rigid("path: still, duration: 0.1 s", "stiffness: 1e11 N/m^1.5, drop: 20 cm",
                              "accuracy: {contact_steps: 2000}");
    step_is(&s, sqrt(2 * g * 0.2), 200);
    s = on_rigid("path: still, duration: 0.1 s", "stiffness: 1e11 N/m^1.5", "accuracy: {contact_steps: 4000}");
    step_is(&s, 0.05, 100);
    wave_height = 1e-4;
    wave_number = 2 * M_PI / 5e-3;
    s = scene_of("", "", "path: line, to: [20 cm, 0], speed: 2 m/s, law: constant", "stiffness: 1e11 N/m^1.5",
                 "accuracy: {contact_steps: 400}");
    s.contacts[0].scraper.radius = s.contacts[0].ball.radius = 1e-3;
    step_is(&s, wave_height * wave_number * 2, 10);
}
END_TEST

/* Stretches of more than a sample's sub-intervals without force (here each is one step), but for the fall: flights, of
   a ball that the contact does not hold back while it parts, mu xi' > -1. */
static long flights(const struct rig *r)
{
    long clear = 0, n = -1;
    ck_assert_double_eq_tol(r->run.board.roll.step * r->run.board.rate * r->per_frame, 1, 1e-12);
    for (long i = 0; i < r->run.board.moving * r->per_frame; i++) {
        clear = r->x[i] != 0 ? 0 : clear + 1;
        n += clear == r->per_frame + 1;
    }
    return n;
}

/* The same however it is cut into blocks, and with or without the account: rigid, and on a plate under a place that
 * moves. */
START_TEST(blocks_do_not_matter)
{
    static const char *const plates[] = {"", ", along: path, material: steel, object: {shape: plate, edges: supported, "
                                             "length: 30 cm, width: 20 cm, thickness: 1 mm}, modes: 20"};
    wave_height = 2e-6;
    wave_number = 2 * M_PI / 5e-4;
    for (int k = 0; k < 2; k++) {
        struct scene s = scene_of("", plates[k], "path: line, from: [1 cm, 2 cm], to: [11 cm, 2 cm], speed: 20 cm/s",
                                  "stiffness: 1e8 N/m^1.5, drop: 0.1 mm",
                                  "output: {sample_rate: 8 kHz, diagnostics: {}}\naccuracy: {contact_steps: 12}");
        struct rig *r = rig_record(&s, ITEM_SUBFORCE, 4200, 1024), *odd;
        rig_probe.also = ITEM_BIT(ITEM_ROLL);
        odd = rig_record(&s, ITEM_SUBFORCE, 4200, 37);
        rig_probe.also = 0;
        ck_assert_int_eq(memcmp(r->x, odd->x, (size_t)(4200 * r->per_frame) * sizeof *r->x), 0);
        ck_assert_double_eq(r->run.board.roll.residual, odd->run.board.roll.residual);
        ck_assert(k > 0 || r->run.board.roll.bounces == flights(r));
        ck_assert(labs(r->run.board.roll.bounces - flights(r)) <= 1); /* a flight of just one frame may be either */
        ck_assert_int_gt(flights(r), 10);
        ck_assert_int_le(flights(r), r->run.board.roll.lift_offs);
        rig_close(r);
        rig_close(odd);
    }
}
END_TEST

/* ------------------------------------------------------------------ out of round */

/* A ball on flat ground that it never leaves follows its own rim and centre of mass: k so large that it hardly sinks
   in. w - w(0) = rise + rim less those at the start; penetration varies by 2/3 x_0 times s''/g (3 %), and rings at
   sqrt(1.5 g / x_0) where that jumps at the start. */
START_TEST(rise_and_bulge_lift_the_ball)
{
    wave_height = 0;
    struct scene s = scene_of(", offset: 1 mm, lobe_height: 0.01 mm, lobes: 3", "",
                              "path: line, to: [20 cm, 0], speed: 20 cm/s, law: minimum_jerk",
                              "stiffness: 1e10 N/m^1.5, mu: 10 s/m", "");
    struct rig *r = rig_record(&s, ITEM_ROLL, 40000, 1024);
    double rest = pow(0.01 * g / 1e10, 2.0 / 3), reach = 0;
    for (long n = 0; n < r->frames; n++) {
        double q = (double)n / s.output.sample_rate, x = 0.2 * q * q * q * (10 - 15 * q + 6 * q * q), theta = x / 0.01;
        for (int i = 0; i < 50; i++)
            theta = (x + 1e-3 * sin(theta)) / 0.01;
        double want = 1e-3 * (1 - cos(theta)) + 1e-5 * (cos(3 * theta) - 1);
        ck_assert_double_eq_tol(r->x[n * ROLL_VALUES + ROLL_HEIGHT], want, 0.2 * rest);
        reach = fmax(reach, want);
    }
    ck_assert_double_gt(reach, 1.9e-3);
    ck_assert_int_eq(r->run.board.roll.lift_offs, 0);
    rig_close(r);
}
END_TEST

/* ------------------------------------------------------------------ ground that gives way */

/* m/N at a place: sum of phi^2 / |s|^2. */
static double give(const struct object *o, double x, double y)
{
    double phi[20], sum = 0;
    o->shapes(o, x, y, phi);
    for (int i = 0; i < o->n; i++) {
        double w = 2 * M_PI * o->frequency[i];
        sum += phi[i] * phi[i] / (o->mass[i] * (w * w + o->decay[i] * o->decay[i]));
    }
    return sum;
}

/* A ball that rolls slowly from near a corner across the plate sinks by m g (C(x) - C(0)), C the sum over its modes:
   within 2 % of the largest, the ball's acceleration and the modes' ringing (lowest at 160 Hz, the way 1 s long). A
   shape without its sign, a place that lags, or a wrong mass would all show. */
START_TEST(a_plate_sags_where_the_ball_is)
{
    wave_height = 0;
    struct scene s =
        scene_of("", PLATE, "path: line, from: [1 cm, 2 cm], to: [28 cm, 17 cm], duration: 1 s, law: minimum_jerk",
                 "mu: 1 s/m, stiffness: 1e10 N/m^1.5", "");
    const struct ring_choice *choice;
    struct err e = {0};
    ck_assert(ring_choice_make(&s.contacts[0], &s, RING_SURFACE, rig_arena(), &choice, &e));
    const struct object *o = choice->modes.object;
    struct rig *r = rig_record(&s, ITEM_ROLL, 48000, 1024);
    double rate = s.output.sample_rate, start = give(o, 0.01, 0.02), most = 0, worst = 0;
    ck_assert_int_eq(o->n, 20);
    for (long n = 0; n < r->frames; n++) {
        double q = (double)n / rate, share = q * q * q * (10 - 15 * q + 6 * q * q);
        double want = -0.01 * g * (give(o, 0.01 + 0.27 * share, 0.02 + 0.15 * share) - start);
        worst = fmax(worst, fabs(r->x[n * ROLL_VALUES + ROLL_HEIGHT] - want));
        most = fmax(most, fabs(want));
    }
    ck_assert_msg(worst < 0.02 * most, "%g of %g", worst, most);
    ck_assert_double_gt(most, 1e-7);
    rig_close(r);
}
END_TEST

/* Shapes at every 64th frame are those of the place there, between them on the straight line, to rounding. */
START_TEST(shapes_follow_the_contact)
{
    struct scene s =
        scene_of("", PLATE, "path: line, from: [1 cm, 2 cm], to: [28 cm, 17 cm], speed: 3 m/s, law: constant",
                 "stiffness: 1e10 N/m^1.5", "");
    struct trajectory tr;
    struct err e = {0};
    struct roll_ground ground;
    ck_assert(trajectory_make(&s.contacts[0].motion, 1, rig_arena(), &tr, &e));
    struct board b = {.rate = 48000, .over = 4, .trajectory = &tr};
    struct stage_run r = {.scene = &s, .contact = &s.contacts[0], .board = &b, .arena = rig_arena()};
    ck_assert_msg(roll_coupled_ground_make(&ground, &r, &e), "%s", e.text);
    const double *phi = roll_coupled_ground_start(&ground);
    double knots[2][20], changes = 0;
    ck_assert_double_eq(s.accuracy.gain_ramp, 64);
    for (long n = 0; n <= 4800; n++) {
        for (long end = 0; end < 2; end++) {
            double at = 3 * (double)(n / 64 + end) * 64 / 48000 / tr.length;
            modes_shapes_at(&ground.shapes, &(struct modes_where){0.01 + 0.27 * at, 0.02 + 0.15 * at, 0}, knots[end]);
        }
        for (int i = 0; i < 20; i++) {
            ck_assert_double_eq_tol(phi[i], knots[0][i] + (double)(n % 64) / 64 * (knots[1][i] - knots[0][i]), 1e-11);
            changes += knots[0][i] * knots[1][i] < 0;
        }
        long frames = n < 2400 ? 1 : 1 + n % 3;
        phi = roll_coupled_ground_next(&ground, n, &frames);
        ck_assert(frames <= 64 - n % 64); /* a leg ends where the shapes bend */
        n += frames - 1;
    }
    ck_assert_double_gt(changes, 64 * 20);
}
END_TEST

/* Energy at a frame, less that at the start and the surface's work, with both losses, is the residual, which stays
   below 1e-10 of the greatest; losses never fall; over nodal lines, bouncing on a wave. */
START_TEST(the_account_is_kept)
{
    wave_height = 5e-6;
    wave_number = 2 * M_PI / 3e-3;
    struct scene s = scene_of("", PLATE, "path: line, from: [1 cm, 2 cm], to: [28 cm, 17 cm], speed: 30 cm/s",
                              "stiffness: 1e9 N/m^1.5, drop: 2 mm", "");
    struct rig *r = rig_record(&s, ITEM_ROLL, 50000, 1024);
    long frames = r->run.board.moving;
    double most = 0, share = 0, lifts = 0;
    for (long n = 0; n < frames; n++) {
        const double *v = r->x + n * ROLL_VALUES;
        most = fmax(most, fabs(v[ROLL_ENERGY]));
        double left =
            v[ROLL_ENERGY] - r->x[ROLL_ENERGY] - v[ROLL_SURFACE_WORK] + v[ROLL_CONTACT_LOSS] + v[ROLL_MODE_LOSS];
        ck_assert_msg(fabs(left - v[ROLL_RESIDUAL]) < 1e-13 * most, "%ld of %ld: %g, %g", n, frames, left,
                      v[ROLL_RESIDUAL]);
        ck_assert_double_lt(fabs(left), 1e-10 * most);
        ck_assert(n == 0 || (v[ROLL_CONTACT_LOSS] >= v[ROLL_CONTACT_LOSS - ROLL_VALUES] &&
                             v[ROLL_MODE_LOSS] >= v[ROLL_MODE_LOSS - ROLL_VALUES]));
        ck_assert(v[ROLL_CONTACT] >= -1e-9 && v[ROLL_CONTACT] <= 1 + 1e-9);
        share += v[ROLL_CONTACT];
        lifts += v[ROLL_LIFT_OFFS];
    }
    const struct roll_report *o = &r->run.board.roll;
    ck_assert_double_gt(r->x[(frames - 1) * ROLL_VALUES + ROLL_MODE_LOSS], 1e-3 * most);
    ck_assert_double_gt(fabs(r->x[(frames - 1) * ROLL_VALUES + ROLL_SURFACE_WORK]), 1e-6 * most);
    ck_assert_double_eq(o->time, (double)frames / s.output.sample_rate);
    ck_assert_double_eq_tol(share / s.output.sample_rate, o->contact, 1e-9 * o->contact);
    ck_assert_double_eq(lifts, (double)o->lift_offs);
    ck_assert_int_gt(o->bounces, 20);
    rig_close(r);
}
END_TEST

/* ------------------------------------------------------------------ rows */

static double cell(const struct csv *t, size_t row, const char *name)
{
    double x;
    struct err e = {0};
    int column = csv_column(t, name);
    ck_assert_msg(column >= 0, "no column %s", name);
    ck_assert_msg(csv_number(t, row, column, &x, &e), "%s", e.text);
    return x;
}

/* Rows against the frames that the probe kept, printed with 9 digits. */
START_TEST(rows_of_a_ball)
{
    static const struct {
        const char *name;
        int value;
    } sampled[] = {{"penetration_m", ROLL_PENETRATION},
                   {"height_m", ROLL_HEIGHT},
                   {"energy_j", ROLL_ENERGY},
                   {"surface_work_j", ROLL_SURFACE_WORK},
                   {"contact_loss_j", ROLL_CONTACT_LOSS},
                   {"mode_loss_j", ROLL_MODE_LOSS},
                   {"energy_residual_j", ROLL_RESIDUAL}};
    char folder[] = "/tmp/rasp_roll_XXXXXX";
    struct arena *a = rig_arena();
    struct csv t;
    struct err e = {0};
    struct render_report report;
    struct scene s =
        scene_of("", PLATE, "path: line, from: [1 cm, 2 cm], to: [28 cm, 17 cm], speed: 30 cm/s",
                 "stiffness: 1e9 N/m^1.5, drop: 0.5 mm", "output: {sample_rate: 48 kHz, diagnostics: {rate: 700 Hz}}");
    rig_relief = NULL;
    ck_assert_ptr_nonnull(mkdtemp(folder));
    ck_assert_msg(render_scene(&s, arena_format(a, "%s/t", folder), a, &report, &e), "%s", e.text);
    ck_assert_msg(csv_read(arena_format(a, "%s/t.csv", folder), a, &t, &e), "%s", e.text);
    ck_assert_int_eq(system(arena_format(a, "rm -r %s", folder)), 0);
    ck_assert_int_eq(report.n_notes, 2);
    ck_assert_msg(strstr(report.notes[0], "a ball bounces"), "%s", report.notes[0]);
    ck_assert_msg(strstr(report.notes[1], "in contact") && strstr(report.notes[1], "energy balances to"), "%s",
                  report.notes[1]);
    ck_assert_msg(strstr(report.summary, "\"contact_samples_mean_least\"") != NULL, "%s", report.summary);
    ck_assert_int_lt(csv_column(&t, "normal_force_n"), 0);
    long frames = (long)ceil(sqrt(0.27 * 0.27 + 0.15 * 0.15) / 0.3 * 48000), n = 0;
    struct rig *r = rig_record(&s, ITEM_ROLL, frames, 1024);
    double lifted = 0;
    for (size_t k = 0; k + 1 < t.rows; k++) {
        double share = 0, lifts = 0, first = (double)n;
        for (int i = 0; i < 7; i++)
            ck_assert_double_eq_tol(cell(&t, k, sampled[i].name), r->x[n * ROLL_VALUES + sampled[i].value],
                                    1e-8 * fabs(r->x[n * ROLL_VALUES + sampled[i].value]) + 1e-30);
        for (; n * 700 / 48000 == (long)k; n++) {
            share += r->x[n * ROLL_VALUES + ROLL_CONTACT];
            lifts += r->x[n * ROLL_VALUES + ROLL_LIFT_OFFS];
        }
        ck_assert_double_eq_tol(cell(&t, k, "contact_share"), share / ((double)n - first), 1e-8);
        ck_assert_double_eq(cell(&t, k, "lift_offs"), lifts);
        ck_assert_double_eq_tol(cell(&t, k, "roll_angle_rad"), 0.3 * (double)k / 700 / 0.01, 1e-7);
        lifted += lifts;
    }
    ck_assert_double_gt(lifted, 5);
    s.output.diagnostics.columns = (const char *[]){"time_s", "roll_angle_rad", NULL}; /* no ball need fall for that */
    struct plan p;
    ck_assert(plan_make(stages_table, &s.contacts[0], &s, a, &p, &e));
    for (int i = 0; i < p.n; i++)
        ck_assert(strcmp(p.rows[i].stage->name, "roll_coupled") != 0 ||
                  p.rows[i].verdict == PLAN_RUNS); /* it sounds all the same */
    s.output.diagnostics.columns = (const char *[]){"penetration_m", NULL};
    ck_assert(plan_make(stages_table, &s.contacts[0], &s, a, &p, &e));
    ck_assert(p.alive & ITEM_BIT(ITEM_ROLL));
    rig_close(r);
}
END_TEST

/* ------------------------------------------------------------------ refused, told */

static void opened(struct scene *s, const char *refused)
{
    struct plan p;
    struct run run;
    struct err e = {0};
    struct table_sink sink = {fopen("/dev/null", "w")};
    ck_assert_msg(plan_make(stages_table, &s->contacts[0], s, rig_arena(), &p, &e), "%s", e.text);
    bool good = run_open(&run, &p, s, &(struct run_sinks){&sink, NULL}, &e);
    ck_assert(!good);
    ck_assert_int_eq(e.kind, ERR_SCENE);
    ck_assert_msg(strstr(e.text, refused) != NULL, "%s", e.text);
    fclose(sink.stream);
}

START_TEST(what_cannot_be_is_refused)
{
    struct scene s = on_rigid("path: still, duration: 0.1 s", "stiffness: 1e9 N/m^1.5, drop: 1 mm", "");
    ((struct roll_coupled *)params_edit(s.contacts, roll_coupled_stage.params, rig_arena()))->ground = GROUND_ELASTIC;
    opened(&s, "it has no response");
    s = on_rigid("path: still, duration: 0.1 s", "stiffness: 1e9 N/m^1.5", "");
    ((struct hertz *)params_edit(s.contacts, &hertz_params, rig_arena()))->stiffness = NAN;
    opened(&s, "give ball.material (such as steel; one of your own needs a density, too), or youngs_modulus and "
               "poisson of ball.object, or contact.roll.stiffness");
    s = on_rigid("path: still, duration: 0.1 s", "stiffness: 1e18 N/m^1.5", "accuracy: {contact_steps: 100000}");
    opened(&s, "lower accuracy.contact_steps");
    s = scene_of("", PLATE, "path: line, from: [1 cm, 2 cm], to: [28 cm, 17 cm], speed: 30 cm/s",
                 "stiffness: 1e9 N/m^1.5", "");
    s.contacts[0].motion.to[0] = 0.35;
    s.contacts[0].surface.response.extrapolate = EXTRAPOLATE_ERROR;
    opened(&s, "beyond the places of surface.object");
}
END_TEST

static const char *told(struct scene *s, long frames)
{
    struct rig *r = rig_record(s, ITEM_SUBFORCE, frames, 1024);
    const char *text = r->run.board.n_warnings ? arena_text(rig_arena(), r->run.board.warnings[0]) : "";
    rig_close(r);
    return text;
}

START_TEST(what_is_odd_is_told)
{
    wave_height = 0;
    struct scene s = on_rigid("path: still, duration: 0.1 s", "stiffness: 1e9 N/m^1.5, drop: 50 cm", "");
    ck_assert_ptr_nonnull(strstr(told(&s, 5000), "never touches"));
    s = on_rigid("path: still, duration: 0.1 s", "stiffness: 1e9 N/m^1.5, mu: 0.1 s/m, drop: 1 mm", "");
    ck_assert_ptr_nonnull(strstr(told(&s, 5000), "still bounces 0.0009"));
    s = on_rigid("path: still, duration: 0.5 s", "stiffness: 1e9 N/m^1.5, mu: 50 s/m, drop: 1 mm", "");
    ck_assert_str_eq(told(&s, 24100), "");
    s = on_rigid("path: still, duration: 0.5 s", "stiffness: 1e13 N/m^1.5, mu: 50 s/m, drop: 1 mm",
                 "accuracy: {contact_steps: 1, oversampling: 1}");
    ck_assert_ptr_nonnull(strstr(told(&s, 24100), "raise accuracy.contact_steps"));
    s = on_rigid("path: still, duration: 0.5 s", "stiffness: 1e9 N/m^1.5", "");
    ck_assert_str_eq(told(&s, 24100), "");
    s.contacts[0].contact.gravity = 0;
    ck_assert_ptr_nonnull(strstr(told(&s, 24100), "contact.gravity is 0"));
    for (int i = 0; i < 2; i++) { /* at rest 1.1 and 0.9 mm deep, of a radius of 1 cm */
        s = on_rigid("path: still, duration: 0.5 s",
                     arena_format(rig_arena(), "stiffness: %.17g N/m^1.5", 0.01 * g / pow(i ? 0.9e-3 : 1.1e-3, 1.5)),
                     "");
        ck_assert_msg((strstr(told(&s, 24100), "pressed in by 0.0011 m, 0.11 times its radius") != NULL) == !i, "%s",
                      told(&s, 24100));
    }
}
END_TEST

/* A drop that the contact stops at once (mu 100 s/m): it creeps out of the hollow, may leave it, and every flight
 * begins with a lift-off. */
START_TEST(flights_are_lift_offs)
{
    wave_height = 0;
    for (int i = 0; i < 4; i++) {
        struct scene s = on_rigid(
            "path: still, duration: 1 s",
            arena_format(rig_arena(), "kappa: 5e9, mu: %g s/m, drop: 1 mm", (const double[]){1, 10, 100, 1000}[i]), "");
        struct rig *r = rig_record(&s, ITEM_ROLL, 48000, 1024);
        const struct roll_report *o = &r->run.board.roll;
        ck_assert_msg(o->bounces <= o->lift_offs && (i > 0 || o->bounces > 3), "%d: %ld of %ld", i, o->bounces,
                      o->lift_offs);
        rig_close(r);
    }
    for (int i = 0; i < 2; i++) { /* nothing lost: flights of 2 sqrt(2 h / g), 81 and 176 us, over samples of 125 us */
        struct scene s =
            on_rigid("path: still, duration: 0.1 s",
                     arena_format(rig_arena(), "stiffness: 1e12 N/m^1.5, mu: 0 s/m, drop: %d nm", i ? 40 : 10),
                     "output: {sample_rate: 8 kHz, diagnostics: {}}");
        struct rig *r = rig_record(&s, ITEM_ROLL, 800, 64);
        const struct roll_report *o = &r->run.board.roll;
        ck_assert_msg(o->lift_offs > 300 && (i ? labs(o->bounces - o->lift_offs) <= 1 : o->bounces == 0),
                      "%d: %ld of %ld", i, o->bounces, o->lift_offs);
        rig_close(r);
    }
}
END_TEST

/* load.approach and load.release are the scene's to set: the force is the ball's own times the two steps (Flash and
 * Hogan's polynomial), at middles of sub-intervals. */
START_TEST(the_force_rises_and_falls_as_told)
{
    wave_height = 0;
    for (int i = 0; i < 4; i++) {
        struct scene s =
            on_rigid("path: still, duration: 0.5 s",
                     i == 3 ? "stiffness: 1e8 N/m^1.5, drop: 1 mm, mu: 100 s/m" : "stiffness: 1e8 N/m^1.5", "");
        double rise = i == 1 ? 0.1 : i == 2 ? 5e-3 : 0, fall = i == 1 ? 0.2 : i >= 2 ? 5e-3 : 0;
        s.contacts[0].load.approach = i < 2 ? rise : NAN;
        s.contacts[0].load.release = i < 2 ? fall : NAN;
        struct rig *r = rig_record(&s, ITEM_SUBFORCE, 24000, 1024);
        for (long k = i == 3 ? 19200 * r->per_frame : 0; k < 24000 * r->per_frame; k++) {
            double t = ((double)k + 0.5) / (s.output.sample_rate * r->per_frame), a = rise > 0 ? fmin(t / rise, 1) : 1,
                   b = fall > 0 ? fmin((0.5 - t) / fall, 1) : 1;
            double want = 0.01 * g * a * a * a * (10 - 15 * a + 6 * a * a) * b * b * b * (10 - 15 * b + 6 * b * b);
            ck_assert_msg(fabs(r->x[k] - want) < 1e-9 * 0.01 * g, "%d, %ld: %g, %g", i, k, r->x[k], want);
        }
        rig_close(r);
    }
}
END_TEST

UNIT("roll_coupled", a_ball_that_loses_nothing_bounces_in_parabolas, dropped_from_the_ground, momentum_is_gravitys,
     steps_follow_the_fastest_impact, blocks_do_not_matter, rise_and_bulge_lift_the_ball,
     a_plate_sags_where_the_ball_is, shapes_follow_the_contact, the_account_is_kept, rows_of_a_ball,
     flights_are_lift_offs, the_force_rises_and_falls_as_told, what_cannot_be_is_refused, what_is_odd_is_told)
