/* Cases that break programs of this kind, with floating-point traps on (invalid, division by zero, overflow): each has
   one right outcome: finite, bounded, or refused with a message. */
#include <fenv.h>
#include <unistd.h>

#include "rig.h"

static const char *const head = "rasp: 1\n"
                                "seed: 5\n"
                                "output: {diagnostics: {}}\n"
                                "scraper: {mass: 20 g}\n";

static double peak_of(const struct rig *g)
{
    double most = 0;
    for (long i = 0; i < g->frames * g->per_frame; i++) {
        ck_assert(isfinite(g->x[i]));
        most = fmax(most, fabs(g->x[i]));
    }
    return most;
}

/* Largest |item| of a scene, traps on. */
static double trapped(const char *rest, enum item item, long frames)
{
    struct arena *a = arena_open();
    struct scene s = rig_scene(a, arena_format(a, "%s%s", head, rest));
    feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
    struct rig *g = rig_record(&s, item, frames, 1024);
    fedisableexcept(FE_ALL_EXCEPT);
    double peak = peak_of(g);
    rig_close(g);
    arena_close(a);
    return peak;
}

/* The force on every kind of extreme motion, load and limiter stays finite and, limited, below m (2 v^2 + a leak)/alpha
 * + f_h. */
START_TEST(extremes_of_the_contact)
{
    static const struct {
        const char *scene;
        double most; /* N */
    } cases[] = {
        /* 100 Hz over 1 m: 314 m/s, 2e5 m/s^2 */
        {"surface: {roughness: {}}\nmotion: {path: back_and_forth, to: [1, 0], rate: 100, duration: 0.05}\n",
         0.02 * 2 * 314.2 * 314.2 / 0.03 + 400},
        /* nearly at rest */
        {"surface: {roughness: {}}\nmotion: {path: line, to: [0.1 mm, 0], duration: 1 s}\n", 1e-3},
        /* so slow that a sample crosses a millionth of a knot */
        {"surface: {roughness: {shortest: 1 cm, longest: 10 cm}}\nmotion: {path: line, to: [1 um, 0], speed: 1e-4}\n",
         1e-3},
        /* a limit of curvature far above and far below the surface's */
        {"surface: {roughness: {}}\ncontact: {smoothing: 0, limiter: {alpha: 1000}}\nmotion: {path: line, to: [1, 0], "
         "speed: 2}\n",
         0.1},
        {"surface: {roughness: {rms: 1 mm}}\ncontact: {limiter: {alpha: 1e-6}}\nmotion: {path: line, to: [1, 0], "
         "speed: 2}\n",
         1e6},
        /* a smallest possible roughness, and none but long waves */
        {"surface: {roughness: {rms: 1e-10, exponent: -8}}\nmotion: {path: line, to: [1, 0], speed: 2}\n", 1e-1},
        {"surface: {roughness: {exponent: 2}}\nmotion: {path: line, to: [1, 0], speed: 2}\n", 10},
        /* no gravity, and a grip that neither angle nor friction moves: N is constant, equation 7 is 0/0 */
        {"surface: {roughness: {}}\ngrip: {angle: 0}\nmotion: {path: back_and_forth, to: [5 cm, 0], rate: 3, duration: "
         "0.2}\n",
         1},
        {"surface: {roughness: {}}\ngrip: {}\ncontact: {gravity: 0}\nmotion: {path: back_and_forth, to: [5 cm, 0], "
         "rate: 3, duration: 0.2}\n",
         1},
        {"surface: {roughness: {}}\ngrip: {azimuth: 90 deg}\nmotion: {path: back_and_forth, to: [5 cm, 0], rate: 3, "
         "duration: 0.2}\n",
         1},
        /* equation 7's base at exactly 0 with zeta < 1 */
        {"surface: {roughness: {}}\ngrip: {}\ncontact: {limiter: {zeta: 0.01}}\nmotion: {path: back_and_forth, to: [5 "
         "cm, 0], rate: 1, duration: 0.6}\n",
         1},
        {"surface: {roughness: {}}\ncontact: {beta2: 0.1}\nmotion: {path: back_and_forth, to: [5 cm, 0], rate: 3, "
         "duration: 0.4}\n",
         1},
        {"surface: {roughness: {}}\ncontact: {force: paper, beta2: 10}\nmotion: {path: back_and_forth, to: [5 cm, 0], "
         "rate: 3, duration: 0.4}\n",
         1},
        {"surface: {roughness: {}}\ngrip: {}\ncontact: {force: paper}\nmotion: {path: back_and_forth, to: [5 cm, 0], "
         "rate: 3, duration: 0.4}\n",
         1},
        /* across the profile: along x nothing changes */
        {"surface: {roughness: {}, along: x}\nmotion: {path: line, to: [0, 5 cm], speed: 0.1}\n", 0},
        {"surface: {roughness: {}, along: x}\ncontact: {force: paper}\nmotion: {path: line, to: [0, 5 cm], speed: "
         "0.1}\n",
         0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        double peak = trapped(cases[i].scene, ITEM_FORCE, 4000);
        printf("case %zu: %.3g N of at most %.3g\n", i, peak, cases[i].most);
        ck_assert_msg(peak <= cases[i].most, "case %zu: %g N", i, peak);
    }
}
END_TEST

/* Writes a table of one mode and returns its name. */
static const char *table_of(struct arena *a, double frequency, double decay, double gain)
{
    char name[] = "/tmp/rasp_modes_XXXXXX.csv";
    int fd = mkstemps(name, 4);
    ck_assert_int_ge(fd, 0);
    dprintf(
        fd,
        "# poles: shared\n# quantity: velocity\n# normalisation: physical\n# source: test\n"
        "place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad\n1,0,0,1,%.17g,%.17g,%.17g,1.5707963267948966\n",
        frequency, decay, gain);
    close(fd);
    return arena_text(a, name);
}

START_TEST(extremes_of_modes)
{
    static const double cases[][4] = {
        /* frequency, decay, gain, most: force is below 0.1 N, |sum| below gain 0.1 t for an undamped mode */
        {1e-3, 1, 1, 1},           {21590, 1e-3, 1, 1},     {440, 0, 1, 1},   {440, 1e6, 1, 1},
        {440, 10, 1e-300, 1e-290}, {440, 10, 1e100, 1e100}, {440, 10, -1, 1}, {440, 10, 0, 0},
    };
    struct arena *a = arena_open();
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const double *c = cases[i];
        const char *file = table_of(a, c[0], c[1], c[2]);
        double peak = trapped(arena_format(a,
                                           "surface: {roughness: {}, response: %s, band: [0 Hz, 1 MHz]}\nmotion: "
                                           "{path: line, to: [4 cm, 0], speed: 0.2}\n",
                                           file),
                              ITEM_SOUND, 48000);
        unlink(file);
        printf("mode %g Hz, decay %g, gain %g: %.3g\n", c[0], c[1], c[2], peak);
        ck_assert_double_le(peak, c[3]);
        if (c[3] > 0) ck_assert_double_gt(peak, 0);
    }
    arena_close(a);
}
END_TEST

/* mu tan theta = 1 and beyond: refused before anything is computed, also in a scene that did not come from a text. */
START_TEST(a_jamming_grip_is_refused)
{
    struct arena *a = arena_open();
    static const double degrees[] = {45, 89, 45}, friction[] = {1, 0.5, 0.9991};
    for (int k = 0; k < 3; k++) {
        struct scene s = rig_scene(
            a, arena_format(a, "%ssurface: {roughness: {}}\ngrip: {}\nmotion: {path: line, to: [1, 0], speed: 1}\n",
                            head));
        s.contacts[0].grip.angle = degrees[k] * M_PI / 180;
        s.contacts[0].grip.friction = friction[k];
        struct plan p;
        struct run r;
        struct err e = {0};
        ck_assert(plan_make(stages_table, &s.contacts[0], &s, a, &p, &e));
        ck_assert(!run_open(&r, &p, &s, NULL, &e));
        ck_assert_int_eq(e.kind, ERR_SCENE);
        ck_assert_msg(strstr(e.text, "jams") != NULL, "%s", e.text);
    }
    arena_close(a);
}
END_TEST

UNIT("hard", extremes_of_the_contact, extremes_of_modes, a_jamming_grip_is_refused)
