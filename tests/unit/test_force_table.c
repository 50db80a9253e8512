/* Diagnostics rows of rendered scenes: forces against sums over the samples that a probe kept in the table's place
   (rig.h), with row numbers by whole-number division; kinematics, normal force and alpha against closed forms. Numbers
   are printed with 9 digits: 5e-9 relative. */
#include <unistd.h>

#include "file/csv.h"
#include "pipeline/render.h"
#include "rig.h"
#include "surface/limiter.h"

static const double pi = 3.14159265358979323846;

/* Renders a scene into a fresh folder and reads its table back. */
static struct csv table_of(struct arena *a, const struct scene *s)
{
    char folder[] = "/tmp/rasp_table_XXXXXX";
    struct csv t;
    struct err e = {0};
    struct render_report report;
    ck_assert_ptr_nonnull(mkdtemp(folder));
    ck_assert_msg(render_scene(s, arena_format(a, "%s/t", folder), a, &report, &e), "%s", e.text);
    ck_assert_msg(
        csv_table_read(arena_format(a, "%s/t.%s", folder, s->output.diagnostics.format == TABLE_NPY ? "npy" : "csv"), a,
                       &t, &e),
        "%s", e.text);
    ck_assert_int_eq(system(arena_format(a, "rm -r %s", folder)), 0);
    return t;
}

static const char *cell(const struct csv *t, size_t row, const char *name)
{
    int column = csv_column(t, name);
    ck_assert_msg(column >= 0, "no column %s", name);
    return t->cells[row * t->columns + (size_t)column];
}

static double value(const struct csv *t, size_t row, const char *name)
{
    double x;
    struct err e = {0};
    ck_assert_msg(csv_number(t, row, csv_column(t, name), &x, &e), "%s", e.text);
    return x;
}

static const char *const stroke =
    "scraper: {mass: 20 g}\nsurface: {roughness: {rms: 5 um}}\nstart: 37 ms\n"
    "motion: {path: back_and_forth, from: [1 cm, 2 cm], to: [4 cm, -2 cm], rate: 5 Hz, duration: 0.13 s}\n";

struct rates {
    long audio, table;
    size_t rows; /* 0.13 s of them, rounded up */
};

/* One sample a row; rates that divide the sample rate, and that do not; rows whose last ends after the motion. */
static const struct rates rates[] = {{48000, 1000, 130}, {44100, 700, 91},     {48000, 700, 91},
                                     {22050, 999, 130},  {16000, 16000, 2080}, {16000, 7, 1}};
enum { RATES = sizeof rates / sizeof rates[0] };

static struct scene scene_at(struct arena *a, const struct rates *r, const char *rest)
{
    return rig_scene(a, arena_format(a,
                                     "rasp: 1\nseed: 3\naccuracy: {oversampling: 4}\noutput: {sample_rate: %ld Hz, "
                                     "diagnostics: {rate: %ld Hz}}\n%s",
                                     r->audio, r->table, rest));
}

/* Row k covers the samples n with floor(n rate_d / rate) = k that the motion touches. */
START_TEST(forces_of_a_row)
{
    struct arena *a = rig_arena();
    for (int c = 0; c < RATES; c++) {
        struct scene s = scene_at(a, &rates[c], stroke);
        struct csv t = table_of(a, &s);
        long frames = (rates[c].audio * 13 + 99) / 100 + 1, n = 0, up = 0, down = 0;
        struct rig *g = rig_record(&s, ITEM_FORCE, frames, 1024);
        ck_assert_uint_eq(t.rows, rates[c].rows);
        for (size_t k = 0; k < t.rows; k++) {
            long double sum = 0, squares = 0;
            double peak = 0;
            long first = n;
            for (; n < frames && n * rates[c].table / rates[c].audio == (long)k; n++) {
                sum += g->x[n];
                squares += (long double)g->x[n] * g->x[n];
                peak = fabs(g->x[n]) > fabs(peak) ? g->x[n] : peak;
            }
            ck_assert_int_gt(n, first);
            double rms = (double)sqrtl(squares / (n - first));
            ck_assert_double_eq_tol(value(&t, k, "force_mean_n"), (double)(sum / (n - first)), 1e-8 * rms);
            ck_assert_double_eq_tol(value(&t, k, "force_rms_n"), rms, 1e-8 * rms);
            ck_assert_str_eq(cell(&t, k, "force_peak_n"), arena_format(a, "%.9g", peak));
            up += peak > 0;
            down += peak < 0;
        }
        ck_assert_int_ge(n, frames - 1); /* no samples are left but perhaps the one at the very end */
        ck_assert(t.rows < 9 || (up > (long)t.rows / 5 && down > (long)t.rows / 5)); /* peaks of both signs were seen */
        rig_close(g);
    }
}
END_TEST

/* What stands in row k is what holds at k / rate_d after the start of the contact, 37 ms after the scene's, to the
 * nearest sample. */
START_TEST(kinematics_of_a_row)
{
    struct arena *a = rig_arena();
    for (int c = 0; c < RATES; c++) {
        struct scene s = scene_at(a, &rates[c], stroke);
        struct csv t = table_of(a, &s);
        double omega = 2 * pi * 5, amplitude = 0.025, top = omega * amplitude,
               start = rint(0.037 * (double)rates[c].audio) / (double)rates[c].audio;
        for (size_t k = 0; k < t.rows; k++) {
            double at = (double)k / (double)rates[c].table, u = amplitude * (1 - cos(omega * at)),
                   v = top * sin(omega * at);
            ck_assert_double_eq_tol(value(&t, k, "time_s"), start + at, 1e-9);
            ck_assert_double_eq_tol(value(&t, k, "stroke_m"), u, 1e-10);
            ck_assert_double_eq_tol(value(&t, k, "x_m"), 0.01 + 0.6 * u, 1e-10);
            ck_assert_double_eq_tol(value(&t, k, "y_m"), 0.02 - 0.8 * u, 1e-10);
            ck_assert_double_eq_tol(value(&t, k, "velocity_m_per_s"), v, 1e-8 * top);
            ck_assert_double_eq_tol(value(&t, k, "speed_m_per_s"), fabs(v), 1e-8 * top);
            ck_assert_double_eq_tol(value(&t, k, "acceleration_m_per_s2"), omega * top * cos(omega * at),
                                    1e-8 * omega * top);
            ck_assert_double_eq_tol(value(&t, k, "vx_m_per_s"), 0.6 * v, 1e-8 * top);
            ck_assert_double_eq_tol(value(&t, k, "vy_m_per_s"), -0.8 * v, 1e-8 * top);
            double q = fmin((0.13 - at) / 5e-3, 1),
                   raised = q * q * q * (10 - 15 * q + 6 * q * q); /* 1.3 strokes: it ends at speed */
            ck_assert_double_eq_tol(value(&t, k, "normal_force_n"), 0.02 * s.contacts[0].contact.gravity * raised,
                                    1e-9);
        }
        /* the last row begins less than a row before the motion's end */
        ck_assert_double_lt(value(&t, t.rows - 1, "time_s"), start + 0.13);
        ck_assert_double_ge(value(&t, t.rows - 1, "time_s") + 1.0 / (double)rates[c].table, start + 0.13 - 1e-9);
    }
}
END_TEST

START_TEST(constant_loads)
{
    static const struct rates r = {16000, 100, 13};
    struct arena *a = rig_arena();
    struct scene s =
        scene_at(a, &r, arena_format(a, "%sload: {constant: 0.75 N}\ncontact: {limiter: {alpha: 4 cm}}\n", stroke));
    struct csv t = table_of(a, &s);
    for (size_t k = 0; k < t.rows; k++) {
        ck_assert_str_eq(cell(&t, k, "normal_force_n"), "0.75");
        ck_assert_str_eq(cell(&t, k, "alpha_m"), "0.04");
    }
    ck_assert_uint_eq(t.rows, 13);
}
END_TEST

/* On a curve: places and velocities in the plane, the way travelled along it, and a force from a table of its own. */
START_TEST(rows_of_a_circle)
{
    static const struct rates r = {16000, 500, 200};
    struct arena *a = rig_arena();
    char file[] = "/tmp/rasp_load_XXXXXX";
    int fd = mkstemp(file);
    ck_assert(fd >= 0 && dprintf(fd, "time_s,normal_force_n\n0,1\n0.2,1.5\n0.4,2\n") > 0 && close(fd) == 0);
    struct scene s = scene_at(a, &r,
                              arena_format(a,
                                           "scraper: {mass: 20 g}\nsurface: {roughness: {rms: 2 um}}\nload: {recorded: "
                                           "%s, approach: 20 ms, release: 40 ms}\n"
                                           "motion: {path: circle, center: [1 cm, 2 cm], radius: 5 cm, start_angle: 30 "
                                           "deg, turns: -1.5, duration: 0.4 s}\n",
                                           file));
    struct csv t = table_of(a, &s);
    ck_assert_int_eq(unlink(file), 0);
    ck_assert_uint_eq(t.rows, 200);
    for (size_t k = 0; k < t.rows; k++) {
        double at = (double)k / 500, angle = pi / 6 - 3 * pi * at / 0.4, v = 3 * pi * 0.05 / 0.4;
        double q = at < 0.02 ? at / 0.02 : at > 0.36 ? (0.4 - at) / 0.04 : 1;
        ck_assert_double_eq_tol(value(&t, k, "x_m"), 0.01 + 0.05 * cos(angle), 1e-10);
        ck_assert_double_eq_tol(value(&t, k, "y_m"), 0.02 + 0.05 * sin(angle), 1e-10);
        ck_assert_double_eq_tol(value(&t, k, "vx_m_per_s"), v * sin(angle), 1e-8);
        ck_assert_double_eq_tol(value(&t, k, "vy_m_per_s"), -v * cos(angle), 1e-8);
        ck_assert_double_eq_tol(value(&t, k, "stroke_m"), v * at, 1e-9);
        ck_assert_double_eq_tol(value(&t, k, "velocity_m_per_s"), v, 1e-8);
        ck_assert_double_eq_tol(value(&t, k, "normal_force_n"), (1 + 2.5 * at) * q * q * q * (10 - 15 * q + 6 * q * q),
                                1e-8);
        ck_assert_double_eq_tol(value(&t, k, "alpha_m"), 0.05 - 0.04 * pow(at / 0.4, 0.95),
                                1e-9); /* of the force before it is lowered */
        ck_assert_double_eq(value(&t, k, "lift_offs"), 0);
    }
}
END_TEST

/* A grip that throws the scraper off the surface: omega^2 L tan theta = 4.2 g. */
static const char *const thrown =
    "scraper: {mass: 20 g}\nsurface: {roughness: {rms: 5 um}}\ngrip: {angle: 30 deg, friction: 0.4, azimuth: 20 deg}\n"
    "contact: {limiter: {alpha_min: 1 cm, alpha_max: 5 cm, zeta: 1.7, force_range: [0.05 N, 0.9 N]}}\n"
    "motion: {path: back_and_forth, from: [1 cm, 0], to: [1.4 cm, 0], rate: 30 Hz, duration: 0.1 s}\n";

/* Papers/000 equations 8 and 9 at any instant: N = (m g + m a tan theta) / (1 - mu tan theta). */
static double thrown_load(const struct scene *s, double at)
{
    double omega = 2 * pi * 30, outwards = 0.002 * omega * omega * cos(omega * fmin(at, 0.1)) * cos(20 * pi / 180),
           tangent = tan(30 * pi / 180);
    return 0.02 * (s->contacts[0].contact.gravity + outwards * tangent) / (1 - 0.4 * tangent);
}

START_TEST(load_and_alpha_of_a_grip)
{
    static const struct rates r = {48000, 1000, 100};
    struct arena *a = rig_arena();
    struct scene s = scene_at(a, &r, thrown);
    struct csv t = table_of(a, &s);
    int lifted = 0, between = 0;
    ck_assert_uint_eq(t.rows, 100);
    for (size_t k = 0; k < t.rows; k++) {
        double load = thrown_load(&s, (double)k / 1000), nu = fmin(fmax((load - 0.05) / 0.85, 0), 1);
        ck_assert_double_eq_tol(value(&t, k, "normal_force_n"), fmax(load, 0), 1e-8);
        ck_assert_double_eq_tol(value(&t, k, "alpha_m"), 0.05 - 0.04 * pow(nu, 1.7), 1e-9);
        lifted += load < 0;
        between += nu > 0 && nu < 1;
    }
    ck_assert_int_gt(lifted, 20);
    ck_assert_int_gt(between, 20);
}
END_TEST

/* Lift-offs: N >= 0 at one sub-sample, N < 0 at the next; the one that a row's last sample holds is its own. */
START_TEST(lift_offs_are_counted)
{
    static const struct rates all[] = {{48000, 1000, 100}, {44100, 13, 2}, {16000, 16000, 1600}};
    struct arena *a = rig_arena();
    for (int c = 0; c < 3; c++) {
        struct scene s = scene_at(a, &all[c], thrown);
        struct csv t = table_of(a, &s);
        long over = (long)s.accuracy.oversampling, total = 0, *want = calloc(all[c].rows + 1, sizeof *want);
        for (long j = 0; j < all[c].audio / 10 * over; j++)
            if (thrown_load(&s, (double)j / (double)(all[c].audio * over)) >= 0 &&
                thrown_load(&s, (double)(j + 1) / (double)(all[c].audio * over)) < 0)
                want[j / over * all[c].table / all[c].audio]++;
        ck_assert_uint_eq(t.rows, all[c].rows);
        for (size_t k = 0; k < t.rows; k++) {
            ck_assert_double_eq(value(&t, k, "lift_offs"), (double)want[k]);
            total += want[k];
        }
        ck_assert_int_eq(total, 3); /* once a cycle */
        free(want);
    }
}
END_TEST

static const char *header(struct arena *a, const struct csv *t)
{
    const char *all = "";
    for (size_t i = 0; i < t->columns; i++)
        all = arena_format(a, "%s%s%s", all, i ? "," : "", t->names[i]);
    return all;
}

#define KINEMATICS                                                                                                     \
    "time_s,x_m,y_m,vx_m_per_s,vy_m_per_s,stroke_m,speed_m_per_s,velocity_m_per_s,acceleration_m_per_s2,normal_force_" \
    "n"
#define FORCES "force_mean_n,force_rms_n,force_peak_n"

/* All columns that the scene has, or those asked for: always in one order, with the same values, whatever else is
 * computed. */
START_TEST(columns)
{
    static const struct rates r = {16000, 100, 10};
    struct arena *a = rig_arena();
    struct scene s = scene_at(a, &r, thrown), plain = scene_at(a, &r, stroke);
    struct csv full = table_of(a, &s), t = table_of(a, &plain);
    ck_assert_str_eq(header(a, &full), KINEMATICS ",alpha_m," FORCES ",lift_offs");
    ck_assert_str_eq(header(a, &t), KINEMATICS ",alpha_m," FORCES);
    ((struct limiter *)params_edit(plain.contacts, limiter_stage.params, a))->curve = LIMITER_NONE;
    t = table_of(a, &plain);
    ck_assert_str_eq(header(a, &t), KINEMATICS "," FORCES);
    s.output.diagnostics.columns = (const char *[]){"force_peak_n", "lift_offs", "speed_m_per_s", "time_s", NULL};
    t = table_of(a, &s);
    ck_assert_str_eq(header(a, &t), "time_s,speed_m_per_s,force_peak_n,lift_offs");
    for (size_t c = 0; c < full.columns; c++) {
        s.output.diagnostics.columns = (const char *[]){full.names[c], NULL};
        t = table_of(a, &s);
        ck_assert_str_eq(header(a, &t), full.names[c]);
        ck_assert_uint_eq(t.rows, full.rows);
        for (size_t k = 0; k < t.rows; k++)
            ck_assert_str_eq(t.cells[k], cell(&full, k, full.names[c]));
    }
}
END_TEST

/* Columns of what does not scrape: no normal force, no alpha; impacts are counted in the row in which they begin: every
 * 30 ms from 21 ms on, at 100 rows a second. */
START_TEST(impacts_are_counted)
{
    struct arena *a = rig_arena();
    struct scene s =
        scene_at(a, &(struct rates){16000, 100, 100},
                 "scraper: {mass: 20 g}\nmotion: {path: still, at: [4 cm, 1 cm], duration: 1 s}\nstart: 50 ms\n"
                 "contact: {model: strike, strike: {speed: 1 m/s, stiffness: 1e8 N/m^1.5, first: 21 ms, interval: 30 "
                 "ms, count: 30}}\n");
    struct csv t = table_of(a, &s);
    ck_assert_uint_eq(t.rows, 100);
    ck_assert(csv_column(&t, "normal_force_n") < 0 && csv_column(&t, "alpha_m") < 0 && csv_column(&t, "lift_offs") < 0);
    for (size_t k = 0; k < t.rows; k++) {
        bool struck = k >= 2 && (k - 2) % 3 == 0 && (k - 2) / 3 < 30;
        ck_assert_str_eq(cell(&t, k, "impacts"), struck ? "1" : "0");
        ck_assert(!struck || value(&t, k, "force_peak_n") > 100);
        ck_assert_str_eq(cell(&t, k, "x_m"), "0.04");
        ck_assert_str_eq(cell(&t, k, "speed_m_per_s"), "0");
    }
}
END_TEST

/* The same numbers, in full: printed with 9 digits they are the CSV's cells. */
START_TEST(npy_is_csv)
{
    struct arena *a = rig_arena();
    for (int c = 0; c < RATES; c++) {
        struct scene s = scene_at(a, &rates[c], stroke);
        struct csv text = table_of(a, &s);
        s.output.diagnostics.format = TABLE_NPY;
        struct csv t = table_of(a, &s);
        ck_assert_ptr_nonnull(t.numbers);
        ck_assert_uint_eq(t.rows, text.rows);
        ck_assert_uint_eq(t.columns, text.columns);
        for (size_t k = 0; k < t.columns; k++)
            ck_assert_str_eq(t.names[k], text.names[k]);
        for (size_t i = 0; i < t.rows * t.columns; i++)
            ck_assert_str_eq(arena_format(a, "%.9g", t.numbers[i]), text.cells[i]);
    }
}
END_TEST

/* Rows without samples would have no force: refused; at the sample rate itself every row has its one sample. */
START_TEST(a_rate_above_the_sample_rate_is_refused)
{
    static const struct rates r = {16000, 16000, 2080};
    struct arena *a = rig_arena();
    struct scene s = scene_at(a, &r, stroke);
    struct plan p;
    struct run run;
    struct err e = {0};
    s.output.diagnostics.rate = 16000.5;
    ck_assert(plan_make(stages_table, &s.contacts[0], &s, a, &p, &e));
    ck_assert(!run_open(&run, &p, &s, NULL, &e)); /* nothing was written: there is nowhere to write to */
    ck_assert_int_eq(e.kind, ERR_SCENE);
    ck_assert_msg(strstr(e.text, "output.diagnostics.rate: 16000.5 Hz is above output.sample_rate, 16000 Hz") != NULL,
                  "%s", e.text);
}
END_TEST

UNIT("force_table", forces_of_a_row, kinematics_of_a_row, constant_loads, rows_of_a_circle, load_and_alpha_of_a_grip,
     lift_offs_are_counted, impacts_are_counted, columns, npy_is_csv, a_rate_above_the_sample_rate_is_refused)
