/* Signed mode shapes at unit modal mass: of plates against their closed form, of tables against the object they were
 * written from, and what is refused. */
#include <unistd.h>

#include "objects.h"
#include "response/modes.h"
#include "response/space.h"

static struct arena *pool;
static void drain(void) { arena_close(pool); }

static struct arena *memory(void)
{
    if (!pool) {
        pool = arena_open();
        atexit(drain);
    }
    return pool;
}

static const double origin[2] = {-0.3, 0.2};

static struct modes *plate_modes(int n)
{
    struct object_given g = objects_given(OBJECT_PLATE, EDGES_SUPPORTED, 0.3);
    struct object *o = ARENA_TAKE(memory(), struct object, 1);
    struct modes *m = ARENA_TAKE(memory(), struct modes, 1);
    g.width = 0.7;
    *o = objects_make(&g, 4 * n, 1e5, memory());
    object_modes(o, origin, NULL, n, memory(), m);
    return m;
}

/* phi = 2/sqrt(M) sin(a pi x/L) sin(b pi y/W), M = 0.7 kg, of the (a, b) whose frequency it has (12 digits; no two are
   alike here), at places all over the plate, so that signs change across nodal lines; one overall sign of a mode is
   free. 1e-12 of the largest: rounding. */
START_TEST(a_plate_is_sines)
{
    const struct modes *m = plate_modes(30);
    struct modes_shapes s;
    struct err e = {0};
    double phi[30], own[30] = {0};
    int changes = 0, matched = 0;
    ck_assert_msg(modes_shapes_make(m, "surface", memory(), &s, &e), "%s", e.text);
    ck_assert_int_eq(s.n, 30);
    ck_assert(s.moves);
    for (int i = 0; i < s.n; i++)
        for (int a = 1; a < 40; a++)
            for (int b = 1; b < 40; b++) {
                double kx = a * M_PI, ky = b * M_PI / 0.7, w = kx * kx + ky * ky;
                double w_d = 2 * M_PI * s.frequency[i], undamped = sqrt(w_d * w_d + s.decay[i] * s.decay[i]);
                if (fabs(undamped / w - 1) > 1e-10) continue;
                matched++;
                for (int k = 0; k < 200; k++) {
                    double x = fmod(0.013 + 0.754877666 * k, 1), y = 0.7 * fmod(0.37 + 0.5698402910 * k, 1);
                    modes_shapes_at(&s, &(struct modes_where){x + origin[0], y + origin[1], 0}, phi);
                    double want = 2 / sqrt(0.7) * sin(kx * x) * sin(ky * y);
                    if (k == 0) own[i] = want * phi[i] < 0 ? -1 : 1;
                    ck_assert_double_eq_tol(phi[i], own[i] * want, 1e-12 * 40);
                    changes += want * own[i] < -0.1;
                }
            }
    ck_assert_int_eq(matched, 30);
    ck_assert_int_gt(changes, 1000);
}
END_TEST

/* A table of the driving point, in each quantity, gives |phi| back: gains are written with 9 digits or more, so 1e-8 of
   the largest, and near a nodal line, where phi is the root of a gain, the root of that. */
static void write_table(const char *file, const struct modes *m, int quantity, int rows, double mirrored)
{
    static const char *const names[] = {"displacement", "velocity", "acceleration"};
    FILE *f = fopen(file, "w");
    struct modes_point p = modes_point_make(memory(), m->n);
    fprintf(f, "# quantity: %s\n# poles: shared\nplace,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad\n",
            names[quantity]);
    for (int row = 0; row < rows; row++) {
        double x = 0.07 + 0.09 * row + origin[0], y = 0.11 + 0.03 * row * row + origin[1];
        modes_at(m, &(struct modes_where){x, y, 0}, &p);
        for (int i = 0; i < m->n; i++) {
            double w = 2 * M_PI * m->frequency[i], turn = atan2(w, -m->decay[i]),
                   size = sqrt(w * w + m->decay[i] * m->decay[i]);
            double phase = atan2(p.im[i], p.re[i]) + (quantity - 1) * turn,
                   gain = sqrt(p.re[i] * p.re[i] + p.im[i] * p.im[i]) * pow(size, quantity - 1);
            fprintf(f, "%d,%.9g,%.9g,%d,%.12g,%.12g,%.12g,%.12g\n", row + 1, x, y, i + 1, m->frequency[i], m->decay[i],
                    gain * (i == 3 && row == 2 ? mirrored : 1), phase);
        }
    }
    fclose(f);
}

static bool read_table(const char *file, struct modes *m, struct modes_shapes *s, struct err *e)
{
    struct modes_ask ask = {.strongest = 100, .pairing = 0.01, .rate = 48000};
    ck_assert_msg(modes_table(file, &ask, memory(), m, e), "%s", e->text);
    return modes_shapes_make(m, "surface", memory(), s, e);
}

START_TEST(a_table_gives_its_root)
{
    char file[] = "/tmp/rasp_shapes_XXXXXX.csv";
    close(mkstemps(file, 4));
    const struct modes *m = plate_modes(12);
    double phi[12], own[12];
    for (int quantity = 0; quantity < 3; quantity++) {
        struct modes t;
        struct modes_shapes s, exact;
        struct err e = {0};
        write_table(file, m, quantity, 5, 1);
        ck_assert_msg(read_table(file, &t, &s, &e), "%s", e.text);
        ck_assert(modes_shapes_make(m, "surface", memory(), &exact, &e));
        ck_assert_int_eq(s.n, 12);
        for (int row = 0; row < 5; row++) {
            struct modes_where where = {0.07 + 0.09 * row + origin[0], 0.11 + 0.03 * row * row + origin[1], 0};
            modes_shapes_at(&s, &where, phi);
            modes_shapes_at(&exact, &where, own);
            for (int i = 0; i < 12; i++) {
                int k = 0;
                while (fabs(m->frequency[k] - s.frequency[i]) > 1e-9 * s.frequency[i])
                    k++;
                ck_assert_double_eq_tol(phi[i], fabs(own[k]), 1e-8 * 2.4 + 1e-4 * (fabs(own[k]) < 1e-3));
            }
        }
    }
    unlink(file);
}
END_TEST

static void refused(struct modes *m, const char *why, const char *cure)
{
    struct modes_shapes s;
    struct err e = {0};
    ck_assert(!modes_shapes_make(m, "surface", memory(), &s, &e));
    ck_assert_int_eq(e.kind, ERR_SCENE);
    ck_assert_msg(strstr(e.text, why) && strstr(e.text, cure), "%s", e.text);
}

/* One gain of the wrong sign; heard elsewhere; poles that differ; modes that travel. */
START_TEST(what_cannot_give_way_is_refused)
{
    char file[] = "/tmp/rasp_shapes_XXXXXX.csv";
    close(mkstemps(file, 4));
    struct modes_ask ask = {.strongest = 100, .pairing = 0.01, .rate = 48000};
    struct modes t;
    struct err e = {0};
    write_table(file, plate_modes(12), MODES_VELOCITY, 5, -1);
    ck_assert_msg(modes_table(file, &ask, memory(), &t, &e), "%s", e.text);
    refused(&t, "gains are those of another listening place", "contact.roll.ground: rigid");
    FILE *f = fopen(file, "w");
    fprintf(f,
            "# quantity: velocity\n# poles: "
            "separate\nplace,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad\n1,0,0,1,400,5,1,%.12g\n2,0.1,0,1,"
            "410,5,1,%.12g\n",
            M_PI_2, M_PI_2);
    fclose(f);
    ck_assert_msg(modes_table(file, &ask, memory(), &t, &e), "%s", e.text);
    refused(&t, "differ from place to place", "give surface.object");
    f = fopen(file, "w");
    fprintf(f, "# quantity: velocity\n# poles: "
               "shared\nplace,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad\n1,0,0,1,400,5,1,0\n");
    fclose(f);
    ck_assert_msg(modes_table(file, &ask, memory(), &t, &e), "%s", e.text);
    refused(&t, "at 400 Hz", "give surface.object");
    struct space space = {.given = true,
                          .from = {0.2, 0.1},
                          .to = {0.4, 0.3},
                          .dimension = 2,
                          .dimension_to = NAN,
                          .fundamental = 200,
                          .gain = 1};
    ck_assert_msg(space_modes(&space, &ask, memory(), &t, &e), "%s", e.text);
    refused(&t, "change over time", "contact.roll.ground: rigid");
    unlink(file);
}
END_TEST

/* A cosine of velocity (phase pi/2) is off by decay / w only: taken; and the space of materials that stays gives one
 * phi everywhere, phi^2 = Re(A/s) w. */
START_TEST(what_nearly_fits_is_taken)
{
    struct modes_ask ask = {.strongest = 10, .pairing = 0.01, .rate = 48000};
    struct space space = {.given = true,
                          .from = {0.2, 0.1},
                          .to = {NAN, NAN},
                          .dimension = 2,
                          .dimension_to = NAN,
                          .fundamental = 200,
                          .gain = 4};
    struct modes m;
    struct modes_shapes s;
    struct err e = {0};
    double phi[10];
    ck_assert_msg(space_modes(&space, &ask, memory(), &m, &e), "%s", e.text);
    ck_assert_msg(modes_shapes_make(&m, "surface", memory(), &s, &e), "%s", e.text);
    modes_shapes_at(&s, &(struct modes_where){0.3, 0.1, 0}, phi);
    struct modes_point p = modes_point_make(memory(), m.n);
    modes_at(&m, &(struct modes_where){0, 0, 0}, &p);
    for (int i = 0; i < s.n; i++) /* of h_v = g e^(-d t) (cos - (d/w) sin), A = g (j - d/w): displacement g/w sin */
        ck_assert_double_eq_tol(phi[i], sqrt(p.im[i]), 1e-12 * phi[i]);
    char file[] = "/tmp/rasp_shapes_XXXXXX.csv";
    close(mkstemps(file, 4));
    for (int off = 0; off < 2; off++) {
        FILE *f = fopen(file, "w");
        fprintf(f,
                "# quantity: velocity\n# poles: "
                "shared\nplace,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad\n1,0,0,1,400,5,1,%.12g\n",
                M_PI_2 + (off ? 0.06 : 0));
        fclose(f);
        ck_assert_msg(modes_table(file, &ask, memory(), &m, &e), "%s", e.text);
        ck_assert_int_eq(modes_shapes_make(&m, "surface", memory(), &s, &e), !off);
    }
    unlink(file);
}
END_TEST

UNIT("shapes", a_plate_is_sines, a_table_gives_its_root, what_cannot_give_way_is_refused, what_nearly_fits_is_taken)
