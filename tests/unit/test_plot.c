/* What `rasp plot` draws of modes and of the motion, against closed forms. */
#include <unistd.h>

#include "base/hash.h"
#include "cmd/plot.h"
#include "file/wav.h"
#include "folder.h"
#include "unit.h"

/* One mode of 1 kHz, decay 60/s, gain 1 at x = 0 and 3 at x = 2 cm; one of 2 kHz that is strongest at x = 0. */
static const char table[] =
    "# poles: shared\n# quantity: velocity\n# title: two "
    "places\nplace,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad\n"
    "a,0,0,1,1000,60,1,0\na,0,0,2,2000,90,-0.5,0\nb,0.02,0,1,1000,60,3,0\nb,0.02,0,2,2000,90,0.25,0\n";

/* Half-way to the second place in 0.1 s, at constant speed. */
static const char stroke[] =
    "rasp: 1\nsurface: {roughness: {}, response: modes.csv}\nscraper: {mass: 10 g}\n"
    "motion: {path: line, to: [1 cm, 0 cm], speed: 10 cm/s, law: constant}\noutput: {sample_rate: 8 kHz}\n";

/* A sound of 0.2 s, its scene, and a summary that lists the scene by that hash. */
static void write_render(const char *hash)
{
    struct err e = {0};
    double silence[1600] = {0};
    char hex[HASH_TEXT], summary[400];
    struct wav_out *w = wav_create("x.wav", &(struct wav_format){.rate = 8000, .channels = 1, .bits = 16}, &e);
    ck_assert(w && wav_write(w, silence, 1600, &e) && wav_commit(w, &e));
    folder_write("modes.csv", table);
    folder_write("x.scene.yaml", stroke);
    hash_bytes(stroke, strlen(stroke), hex);
    snprintf(summary, sizeof summary,
             "{\"scene\": \"\", \"contacts\": [{\"name\": \"contact\"}], \"files\": [{\"kind\": \"wav\"}, {\"kind\": "
             "\"scene\", \"sha256\": \"%s\"}]}",
             hash ? hash : hex);
    folder_write("x.json", summary);
}

static struct plot_page page(const char *file, struct arena *a)
{
    struct cmd_call *call = ARENA_TAKE(a, struct cmd_call, 1);
    call->arena = a;
    return (struct plot_page){.call = call, .file = file, .from = NAN, .to = NAN, .channel = 1, .arena = a};
}

/* Of a table, each mode has its largest magnitude over the places. Numbers are read, not computed: exact. */
START_TEST(table_of_modes)
{
    struct arena *a = folder_make();
    ck_assert_int_eq(chdir(folder_name), 0);
    struct err e = {0};
    struct plot_page p = page("modes.csv", a);
    folder_write("modes.csv", table);
    ck_assert_msg(plot_data(&p, &e), "%s", e.text);
    ck_assert_int_eq(p.n_bodies, 1);
    ck_assert_int_eq(p.bodies[0].n, 2);
    const struct plot_mode *m = p.bodies[0].modes;
    ck_assert(m[0].frequency == 1000 && m[0].decay == 60 && m[0].gain == 3);
    ck_assert(m[1].frequency == 2000 && m[1].decay == 90 && m[1].gain == 0.5);
    ck_assert_str_eq(p.title, "two places");
    ck_assert(plot_panels_there(&p, PLOT_MODES) && plot_panels_there(&p, PLOT_DECAYS) &&
              !plot_panels_there(&p, PLOT_MOTION));
    folder_remove();
}
END_TEST

/* Of a scene, the largest on the way: gains are linear between two places with shared poles, 1 at the start and 2
   half-way; the other mode's, -0.5 to -0.125, is largest at the start. The way is 10 cm/s t. Rounding: 1e-9. */
START_TEST(scene_beside_a_sound)
{
    struct arena *a = folder_make();
    ck_assert_int_eq(chdir(folder_name), 0);
    struct err e = {0};
    struct plot_page p = page("x.wav", a);
    write_render(NULL);
    ck_assert_msg(plot_data(&p, &e), "%s", e.text);
    ck_assert_int_eq(p.n_ways, 1);
    const struct plot_path *way = &p.ways[0];
    for (int i = 0; i < way->n; i++) {
        ck_assert_double_eq_tol(way->at[i][0], 0.01 * i / (way->n - 1), 1e-9);
        ck_assert_double_eq_tol(way->at[i][1], 0, 1e-12);
        ck_assert_double_eq_tol(way->at[i][2], 0.1, 1e-9);
    }
    ck_assert_int_eq(p.n_bodies, 1);
    ck_assert_str_eq(p.bodies[0].name, "surface");
    for (int i = 0; i < 2; i++) {
        const struct plot_mode *m = &p.bodies[0].modes[i];
        ck_assert_double_eq_tol(m->gain, m->frequency == 1000 ? 2 : 0.5, 1e-9);
    }
    ck_assert_int_eq(p.grounds[0].n, 2);
    ck_assert(p.grounds[0].places[1][0] == 0.02);
    folder_remove();
}
END_TEST

/* Only what lies within the time shown: from 0.025 s to 0.05 s, which is from 2.5 mm to 5 mm. */
START_TEST(part_of_the_way)
{
    struct arena *a = folder_make();
    ck_assert_int_eq(chdir(folder_name), 0);
    struct err e = {0};
    struct plot_page p = page("x.wav", a);
    write_render(NULL);
    p.from = 0.025;
    p.to = 0.05;
    ck_assert_msg(plot_data(&p, &e), "%s", e.text);
    ck_assert_double_eq_tol(p.ways[0].at[0][0], 0.0025, 1e-9);
    ck_assert_double_eq_tol(p.ways[0].at[p.ways[0].n - 1][0], 0.005, 1e-9);
    folder_remove();
}
END_TEST

/* A scene of another render is not used; a panel that needs it is refused. */
START_TEST(scene_of_another_render)
{
    struct arena *a = folder_make();
    ck_assert_int_eq(chdir(folder_name), 0);
    struct err e = {0};
    struct plot_page p = page("x.wav", a), asked = p;
    write_render("0000000000000000000000000000000000000000000000000000000000000000");
    ck_assert_msg(plot_data(&p, &e), "%s", e.text);
    ck_assert(p.n_bodies == 0 && p.n_ways == 0);
    ck_assert(plot_panels_read("waveform,motion", &asked.asked, a, &e));
    ck_assert(!plot_data(&asked, &e));
    ck_assert_int_eq(e.kind, ERR_SCENE);
    folder_remove();
}
END_TEST

UNIT("plot", table_of_modes, scene_beside_a_sound, part_of_the_way, scene_of_another_render)
