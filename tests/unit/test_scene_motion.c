/* Motions in scenes: what each path and law needs, refuses and leaves at its default; lists of points. */
#include "scene/scene_read.h"

#include "scene/keys.h"
#include "scenes.h"

#define HEAD "rasp: 1\nsurface: {roughness: {}, response: a.csv}\nscraper: {mass: 1 g}\nmotion: "

static struct result motion_read(const char *motion, const char *const *set)
{
    char text[1024];
    snprintf(text, sizeof text, "%s%s\n", HEAD, motion);
    return read_with(text, set);
}

/* ------------------------------------------------------------------ which law fits which path */

enum { PATHS = 8, LAWS = 6 };

/* A motion of each path as it is under the law auto, and what another law needs besides. */
static const struct {
    const char *motion, *law_needs,
        *laws; /* laws: a letter for each that fits, in the order of the enum: a h c m t g */
} paths[PATHS] = {
    {"{path: back_and_forth, to: [1 cm, 0], rate: 2 Hz, duration: 1 s}", "", "ahmg"},
    {"{path: line, to: [1 cm, 0], speed: 10 cm/s}", "", "ahcmg"},
    {"{path: four_in_line, to: [1 cm, 0], duration: 1 s}", "", "ahcmg"},
    {"{path: circle, radius: 2 cm, speed: 10 cm/s}", "", "ahcmtg"},
    {"{path: scribble, rate: 2 Hz, duration: 1 s}", "", "ahcmtg"},
    {"{path: polyline, points: [[0, 0], [1 cm, 0], [1 cm, 1 cm]], speed: 10 cm/s}", "", "ahm"},
    {"{path: spline, points: [[0, 0], [1 cm, 0], [1 cm, 1 cm]], duration: 1 s}", "", "ahcmtg"},
    {"{path: recorded, file: a.csv}", "motion.duration=1 s", "ahcmtg"},
};

/* The motion under the law, with and without what the law makes needless or needed. */
static struct result lawful(int path, int law)
{
    static const char letters[] = "ahcmtg";
    static const char *const words[LAWS] = {"auto", "harmonic", "constant", "minimum_jerk", "two_thirds", "given"};
    char law_text[64];
    snprintf(law_text, sizeof law_text, "motion.law=%s", words[law]);
    if (letters[law] == 'g')
        return motion_read(paths[path].motion,
                           SET(law_text, "motion.profile=v.csv", "motion.speed=null", "motion.duration=null",
                               path == PATH_BACK_AND_FORTH ? "motion.rate=null" : "gain=1"));
    return motion_read(paths[path].motion,
                       SET(law_text, *paths[path].law_needs && law != SPEED_AUTO ? paths[path].law_needs : "gain=1"));
}

START_TEST(test_laws)
{
    for (int path = 0; path < PATHS; path++)
        for (int law = 0; law < LAWS; law++) {
            struct result r = lawful(path, law);
            bool fits = strchr(paths[path].laws, "ahcmtg"[law]) != NULL;
            ck_assert_msg(r.good == fits, "%s, law %d:\n%s", paths[path].motion, law, r.messages);
            if (fits)
                ck_assert(r.scene.contacts->motion.law == law && r.scene.contacts->motion.path == path);
            else
                one_error(&r, "--set motion.law: error: motion.law must not be ", "where motion.path is",
                          "laws here: auto, harmonic");
            arena_close(r.arena);
        }
}
END_TEST

START_TEST(test_rounded_corners)
{
    static const char *const laws[] = {"motion.law=constant", "motion.law=two_thirds", "motion.law=minimum_jerk"};
    for (int i = 0; i < 3; i++) {
        struct result r = motion_read(paths[PATH_POLYLINE].motion, SET(laws[i], "motion.corner=1 mm"));
        ck_assert_msg(r.good, "%s", r.messages);
        arena_close(r.arena);
    }
}
END_TEST

/* ------------------------------------------------------------------ defaults and points */

START_TEST(test_defaults)
{
    struct result r = motion_read(paths[PATH_CIRCLE].motion, NULL);
    const struct motion *m = &r.scene.contacts->motion;
    ck_assert_msg(r.good, "%s", r.messages);
    ck_assert(m->radius == 0.02 && m->center[0] == 0 && m->turns == 1 && m->start_angle == 0 && isnan(m->rate) &&
              isnan(m->to[0]));
    ck_assert(!m->points && m->n_points == 0 && !m->file && m->straight == 0.1 && isnan(m->corner));
    ck_assert(isnan(r.scene.contacts->load.approach) && isnan(r.scene.contacts->load.release) &&
              isnan(r.scene.contacts->scraper.patch));
    arena_close(r.arena);
    r = motion_read(paths[PATH_SCRIBBLE].motion, SET("motion.law=constant"));
    ck_assert(r.good && r.scene.contacts->motion.size[0] == 0.08 && r.scene.contacts->motion.size[1] == 0.05 &&
              isnan(r.scene.contacts->motion.straight));
    arena_close(r.arena);
    r = motion_read(paths[PATH_RECORDED].motion, NULL);
    ck_assert(r.good && r.scene.contacts->motion.cutoff == 12 && isnan(r.scene.contacts->motion.duration));
    ck_assert_str_eq(r.scene.contacts->motion.file, "scenes/a.csv");
    arena_close(r.arena);
}
END_TEST

START_TEST(test_points)
{
    struct result r = motion_read("{path: spline, points: [[0, 1 mm], [-3 cm, 2], [0, 1 mm]], duration: 1}", NULL);
    static const double expected[] = {0, 0.001, -0.03, 2, 0, 0.001};
    ck_assert_msg(r.good, "%s", r.messages);
    ck_assert_int_eq(r.scene.contacts->motion.n_points, 3);
    ck_assert_mem_eq(r.scene.contacts->motion.points, expected, sizeof expected);
    arena_close(r.arena);
    r = motion_read(paths[PATH_SPLINE].motion, SET("motion.points=[[1 cm, 0], [2 cm, 0]]", "motion.points.1.0=3 cm"));
    ck_assert(r.good && r.scene.contacts->motion.n_points == 2 && r.scene.contacts->motion.points[2] == 0.03);
    arena_close(r.arena);
}
END_TEST

/* As many points as there may be, and one more. */
START_TEST(test_many_points)
{
    for (int n = 10000; n <= 10001; n++) {
        char *text = malloc(400000);
        int at = sprintf(text, "%s{path: polyline, duration: 1, points: [", HEAD);
        for (int i = 0; i < n; i++)
            at += sprintf(text + at, "%s[%d mm, 1.5 cm]", i ? ",\n " : "", i % 2000);
        sprintf(text + at, "]}\n");
        struct result r = read_with(text, NULL);
        ck_assert_msg(r.good == (n == 10000), "%s", r.messages);
        if (n == 10000)
            ck_assert(r.scene.contacts->motion.n_points == n && r.scene.contacts->motion.points[2 * n - 2] == 1.999);
        else
            one_error(&r, "scenes/t.yaml:4:47: error: ", "must be a list of 2 to 10000 points [x, y], not of 10001",
                      "[[0, 0], [3 cm, 0]]");
        arena_close(r.arena);
        free(text);
    }
}
END_TEST

/* ------------------------------------------------------------------ errors */

static const struct {
    const char *motion, *place, *says, *cure;
} bads[] = {
    {"{path: line, to: [1 cm, 0]}", "4:1", "motion.speed or motion.duration must be given", "speed: 10 cm/s"},
    {"{path: four_in_line, to: [1 cm, 0]}", "4:1", "motion.speed or motion.duration must be given", "speed: 10 cm/s"},
    {"{path: circle, radius: 1 cm}", "4:1", "motion.speed or motion.duration must be given", "speed: 10 cm/s"},
    {"{path: spline, points: [[0, 0], [1 cm, 0]]}", "4:1", "motion.speed or motion.duration must be given",
     "speed: 10 cm/s"},
    {"{path: circle, radius: 1 cm, speed: 1, duration: 1}", "4:48",
     "motion.duration and motion.speed exclude each other", "remove one"},
    {"{path: circle, speed: 1}", "4:1", "motion.radius is missing", "radius: 3 cm"},
    {"{path: circle, radius: 1 cm, speed: 1, turns: 0}", "4:55", "motion.turns must not be 0", "-1 for clockwise"},
    {"{path: circle, radius: 1 cm, speed: 1, to: [1, 0]}", "4:48",
     "motion.to applies only where motion.path is back_and_forth, line, four_in_line or incline", "now it is circle"},
    {"{path: four_in_line, to: [0, 0], speed: 1}", "4:34", "motion.to must differ from motion.from", "1 nm apart"},
    {"{path: scribble, rate: 2}", "4:1", "motion.duration is missing", "duration: 2 s"},
    {"{path: scribble, duration: 2}", "4:1", "motion.rate is missing", "rate: 2 Hz"},
    {"{path: scribble, rate: 2, duration: 2, speed: 1}", "4:48",
     "motion.speed applies only where motion.path is line, four_in_line", "now it is scribble"},
    {"{path: scribble, rate: 2, duration: 2, size: [0, 1 cm]}", "4:55",
     "first number of motion.size must be from 100 um to 100 m", "width and height"},
    {"{path: back_and_forth, to: [1, 0], duration: 2}", "4:1", "motion.rate is missing", "rate: 2 Hz"},
    {"{path: recorded}", "4:1", "motion.file is missing", "file: recording.csv"},
    {"{path: recorded, file: a.csv, law: constant}", "4:1",
     "motion.duration is missing: under the law constant a recording gives the path only", "duration: 2 s"},
    {"{path: recorded, file: a.csv, speed: 1}", "4:39", "motion.speed applies only where motion.path is",
     "now it is recorded"},
    {"{path: line, to: [1, 0], law: given}", "4:1", "motion.profile is missing", "profile: speed.csv"},
    {"{path: line, to: [1, 0], law: given, profile: a.csv, speed: 1}", "4:62",
     "motion.speed must not be given where motion.law is given", "another law"},
    {"{path: recorded, file: a.csv, law: given, profile: a.csv, duration: 1}", "4:67",
     "motion.duration must not be given where motion.law is given", ""},
    {"{path: back_and_forth, to: [1, 0], law: given, profile: a.csv, rate: 1}", "4:72",
     "motion.rate must not be given where motion.law is given", ""},
    {"{path: line, to: [1, 0], speed: 1, profile: a.csv}", "4:44",
     "motion.profile applies only where motion.law is given", "now it is auto"},
    {"{path: line, to: [1, 0], speed: 1, law: constant, straight: 1 m}", "4:59",
     "motion.straight applies only where motion.law is auto or two_thirds", "now it is constant"},
    {"{path: line, to: [1, 0], speed: 1, law: two_thirds}", "4:49",
     "motion.law must not be two_thirds where motion.path is line: a straight line has no",
     "laws here: auto, harmonic, constant, minimum_jerk, given"},
    {"{path: back_and_forth, to: [1, 0], rate: 1, duration: 1, law: constant}", "4:71", "it rests where it turns round",
     "laws here: auto, harmonic, minimum_jerk, given"},
    {"{path: polyline, points: [[0, 0], [1, 0], [2, 1]], speed: 1, law: constant}", "4:75", "it rests at its corners",
     "motion.corner: 5 mm"},
    {"{path: line, to: [1, 0], speed: 1, law: constnat}", "4:49", "motion.law must be one of: auto, harmonic",
     "did you mean 'constant'?"},
    /* points */
    {"{path: polyline, duration: 1}", "4:1", "motion.points is missing", "points: [[0, 0], [3 cm, 0]]"},
    {"{path: polyline, duration: 1, points: [[0, 0], 1]}", "4:56",
     "point 2 of motion.points must be a pair [x, y], not '1'", "[3 cm, 0]"},
    {"{path: polyline, duration: 1, points: 3 cm}", "4:47", "must be a list of 2 to 10000 points [x, y], not '3 cm'",
     "[[0, 0], [3 cm, 0]]"},
    {"{path: polyline, duration: 1, points: [[0, 0]]}", "4:47", "must be a list of 2 to 10000 points [x, y], not of 1",
     ""},
    {"{path: polyline, duration: 1, points: [[0, 0], [1 cm, 2 cm, 3 cm]]}", "4:56",
     "point 2 of motion.points must be a pair [x, y], not a list of 3", ""},
    {"{path: polyline, duration: 1, points: [[0, 0], [1 cm, 2 s]]}", "4:63",
     "y of point 2 of motion.points needs a length; s is a unit of time", "3 cm"},
    {"{path: polyline, duration: 1, points: [[0, 0], [1 cm, 200 m]]}", "4:63",
     "y of point 2 of motion.points must be from -100 m to 100 m", ""},
    {"{path: polyline, duration: 1, points: [[0, 0], [1 cm, 0], [10 mm, 0.5 nm]]}", "4:67",
     "point 3 of motion.points lies where point 2 does", "remove"},
    {"{path: line, to: [1, 0], duration: 1, points: [[0, 0], [1, 0]]}", "4:47",
     "motion.points applies only where motion.path is polyline or spline", ""},
};

START_TEST(test_bad)
{
    for (size_t i = 0; i < sizeof bads / sizeof bads[0]; i++) {
        char start[64];
        struct result r = motion_read(bads[i].motion, NULL);
        snprintf(start, sizeof start, "scenes/t.yaml:%s: error: ", bads[i].place);
        one_error(&r, start, bads[i].says, bads[i].cure);
        ck_assert_int_eq(r.err.kind, ERR_SCENE);
        arena_close(r.arena);
    }
}
END_TEST

/* Each wrong point is told, and the one after a wrong one is not compared with it. */
START_TEST(test_every_point_is_told)
{
    struct result r = motion_read("{path: polyline, duration: 1, points: [[1 s, 0], [0, 0], [0, 0], x]}", NULL);
    static const char *const all[] = {":4:49: error: x of point 1",
                                      ":4:66: error: point 3 of motion.points lies where point 2",
                                      ":4:74: error: point 4", "\n3 errors\n"};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        ck_assert_msg(strstr(r.messages, all[i]) != NULL, "%s:\n%s", all[i], r.messages);
    arena_close(r.arena);
}
END_TEST

/* ------------------------------------------------------------------ free motion */

START_TEST(test_incline)
{
    struct result r = motion_read("{path: incline, to: [1 m, 0], incline: -5 deg, rolling_friction: 0.02}", NULL);
    const struct motion *m = &r.scene.contacts->motion;
    ck_assert_msg(r.good, "%s", r.messages);
    ck_assert(m->start_speed == 0 && m->rolling_friction == 0.02 && m->gravity == 9.80665 && m->inertia == 0);
    arena_close(r.arena);
    r = motion_read("{path: incline, to: [1 m, 0], start_speed: 0.3, rolling_friction: 0.1, duration: 30 s}",
                    NULL); /* rests long before */
    ck_assert_msg(r.good, "%s", r.messages);
    arena_close(r.arena);
}
END_TEST

static const struct {
    const char *motion, *set, *place, *says, *cure;
} bad_free[] = {
    {"{path: incline, to: [1, 0]}", "gain=1", "scenes/t.yaml:4:1",
     "motion: the way is level, and motion.start_speed is 0", "give a motion.start_speed"},
    {"{path: incline, to: [1, 0], incline: 0.1}", "gain=1", "scenes/t.yaml:4:46", "the way leads upwards",
     "swap motion.from and motion.to"},
    {"{path: incline, to: [1, 0], incline: -0.1, rolling_friction: 0.11}", "gain=1", "scenes/t.yaml:4:46",
     "holds it on this slope", "further below 0"},
    {"{path: incline, to: [1, 0], incline: -0.1, start_speed: 0}", "contact.gravity=0", "scenes/t.yaml:4:65",
     "contact.gravity and motion.start_speed are 0", ""},
    {"{path: incline, to: [1, 0], incline: -0.1, duration: 5}", "gain=1", "scenes/t.yaml:4:62",
     "motion.duration is 5 s, and the motion reaches motion.to after 1.42",
     "leave it out: the motion ends there by itself"},
    {"{path: incline, to: [3, 0], incline: 0.1, start_speed: 1, duration: 5}", "gain=1", "scenes/t.yaml:4:77",
     "is back at motion.from after 2.0428", "lower it"},
    {"{path: incline, to: [3, 0], start_speed: 1e-6}", "gain=1", "scenes/t.yaml:4:1",
     "motion: it is 3e+06 s before it reaches motion.to", "duration: 1 min"},
    {"{path: incline, to: [0, 0], start_speed: 1}", "gain=1", "scenes/t.yaml:4:29",
     "motion.to must differ from motion.from", ""},
    {"{path: incline, to: [1, 0], start_speed: 1, law: harmonic}", "gain=1", "scenes/t.yaml:4:58",
     "motion.law must not be harmonic where motion.path is incline: gravity and friction say how fast it goes",
     "laws here: auto"},
    {"{path: incline, to: [1, 0], start_speed: 1, speed: 1}", "gain=1", "scenes/t.yaml:4:53",
     "motion.speed applies only where motion.path is line", ""},
    {"{path: line, to: [1, 0], speed: 1, incline: 0.1}", "gain=1", "scenes/t.yaml:4:44",
     "motion.incline applies only where motion.path is incline", ""},
    {"{path: incline, to: [1, 0], start_speed: 1}", "grip={}", "--set grip",
     "grip must not be given where motion.path is incline", "path: line"},
    {"{path: incline, to: [1, 0], start_speed: 1}", "load={approach: 0.6 s, release: 0.5 s}", "--set load",
     "take 1.1 s together, and the motion lasts 1 s", ""},
};

START_TEST(test_bad_incline)
{
    struct result given =
        motion_read("{path: incline, to: [1, 0], start_speed: 1}",
                    SET("contact={model: given, given: {file: f.csv}}", "scraper=null", "surface.roughness=null"));
    one_error(&given, "--set contact: error: ", "motion.path must not be incline where contact.model is given",
              "path: line");
    arena_close(given.arena);
    for (size_t i = 0; i < sizeof bad_free / sizeof bad_free[0]; i++) {
        char start[64];
        struct result r = motion_read(bad_free[i].motion, SET(bad_free[i].set));
        snprintf(start, sizeof start, "%s: error: ", bad_free[i].place);
        one_error(&r, start, bad_free[i].says, bad_free[i].cure);
        arena_close(r.arena);
    }
}
END_TEST

/* ------------------------------------------------------------------ load, tip, table */

static const struct {
    const char *set[3], *start, *says, *cure;
} bad_sets[] = {
    {{"load={approach: 60 ms, release: 50 ms}"},
     "--set load: error: ",
     "load.approach and load.release take 0.11 s together, and the motion lasts 0.1 s",
     "lower them"},
    {{"load={release: 2 s}", "motion.duration=1 s", "motion.speed=null"},
     "--set load: error: ",
     "the motion lasts 1 s",
     "last longer"},
    {{"load={recorded: a.csv, constant: 1 N}"},
     "--set load: error: load.constant and load.recorded exclude each other",
     "",
     "remove one"},
    {{"scraper.patch=3 um"},
     "--set scraper.patch: error: ",
     "scraper.patch applies only beside scraper.radius",
     "give scraper.radius"},
    {{"scraper.radius=10 um"},
     "--set scraper.radius: error: ",
     "scraper.patch must be less than scraper.radius (the other is the default; give both)",
     "lower"},
    {{"contact={force: paper, limiter: {curve: none, ratio_y: 2}}"},
     "--set contact: error: ",
     "contact.limiter.ratio_y has no effect where",
     "tanh"},
    {{"contact.limiter.ratio_y=2"},
     "--set contact.limiter.ratio_y: error: ",
     "contact.limiter.ratio_y applies only where contact.force is paper",
     "directional"},
    {{"contact={smoothing: 10 ms, force: paper, limiter: {ratio_y: 11}}"},
     "--set contact: error: ",
     "sigma of 0.11 s",
     "lower"},
    {{"contact={smoothing: 10 ms, limiter: {alpha_max: 31 cm}}", "load.recorded=a.csv"},
     "--set contact: error: ",
     "sigma of 0.103 s",
     "lower"},
    {{"output.diagnostics.rate=50 kHz"},
     "--set output.diagnostics.rate: error: ",
     "output.diagnostics.rate, 50000 Hz, is above output.sample_rate, 48000 Hz: some rows would have no samples",
     "lower output.diagnostics.rate"},
    {{"output={sample_rate: 8 kHz, diagnostics: {rate: 8001}}"},
     "--set output: error: ",
     "is above output.sample_rate",
     "lower"},
};

START_TEST(test_bad_set)
{
    for (size_t i = 0; i < sizeof bad_sets / sizeof bad_sets[0]; i++) {
        const char *const *s = bad_sets[i].set;
        struct result r = motion_read("{path: line, to: [1 cm, 0], speed: 10 cm/s}", SET(s[0], s[1], s[2]));
        one_error(&r, bad_sets[i].start, bad_sets[i].says, bad_sets[i].cure);
        arena_close(r.arena);
    }
    struct result r =
        motion_read("{path: line, to: [1 cm, 0], speed: 10 cm/s}",
                    SET("load={approach: 60 ms, release: 40 ms}",
                        "output.diagnostics={rate: 48 kHz, columns: [lift_offs]}", "load.recorded=a.csv"));
    ck_assert_msg(r.good && r.scene.contacts->load.approach == 0.06, "%s", r.messages);
    arena_close(r.arena);
}
END_TEST

UNIT("scene_motion", test_laws, test_rounded_corners, test_defaults, test_points, test_many_points, test_bad,
     test_every_point_is_told, test_incline, test_bad_incline, test_bad_set)
