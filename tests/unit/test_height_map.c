/* height_map: the stage on files written here: what becomes of their heights, and what of their geometry is refused. */
#include "file/heightfile.h"
#include "stage.h"
#include "surface/profile.h"
#include "unit.h"

#include <unistd.h>

extern const struct stage height_map_stage;

static char map[] = "/tmp/test_height_map.XXXXXX";
enum { N = 101 };

static void write_map(size_t columns, size_t rows, double pitch, double height)
{
    static double z[N * 2];
    struct err e = {0};
    for (size_t i = 0; i < columns * rows; i++)
        z[i] = height * (i % 2 ? 1.0 : -1.0) * (double)(i % 7);
    struct heightfile h = {.columns = columns, .rows = rows, .pitch_x = pitch, .pitch_y = pitch, .z = z};
    ck_assert_msg(heightfile_write_gsf(map, &h, NULL, &e), "%s", e.text);
}

/* A stroke along +x over the first half of a map of 100 intervals of 10 um. */
static struct contact stroke(void)
{
    int handle = mkstemp(map); /* each test is a process of its own */
    ck_assert_int_ge(handle, 0);
    close(handle);
    remove(map);
    return (struct contact){.name = "rod",
                            .surface = {.height_map = map, .pitch = NAN, .height_scale = 1, .off_map = OFF_MAP_MIRROR},
                            .motion = {.path = PATH_LINE, .to = {5e-4, 0}, .speed = 0.1, .duration = NAN}};
}

/* Opens the stage; the profile lives in the arena. */
static struct profile *opened(const struct contact *c, struct arena *a, struct err *e)
{
    struct board board = {0};
    struct stage_run run = {.stage = &height_map_stage, .contact = c, .board = &board, .arena = a};
    return height_map_stage.open(&run, e) ? board.profile : NULL;
}

static void check_refused(const struct contact *c, enum err_kind kind, const char *word)
{
    struct arena *a = arena_open();
    struct err e = {0};
    ck_assert_msg(!opened(c, a, &e), "not refused: %s", word);
    ck_assert_msg(e.kind == kind && strstr(e.text, word), "%d: %s", e.kind, e.text);
    remove(map);
    arena_close(a);
}

static bool accepted(const struct contact *c)
{
    struct arena *a = arena_open();
    struct err e = {0};
    bool ok = opened(c, a, &e) != NULL;
    arena_close(a);
    return ok;
}

/* Heights at the knots are the file's times height_scale, within float32, in which GSF stores them. */
START_TEST(heights_are_the_files)
{
    struct arena *a = arena_open();
    struct contact c = stroke();
    struct err e = {0};
    double work[N + 2], z[N];
    write_map(N, 1, 10e-6, 1e-6);
    c.surface.height_scale = 2.5;
    struct profile *p = opened(&c, a, &e);
    ck_assert_msg(p != NULL, "%s", e.text);
    ck_assert_double_eq_tol(p->pitch, 10e-6, 1e-12);
    profile_knots(p, 0, N, work, (struct profile_knots){.height = z});
    for (int i = 0; i < N; i++)
        ck_assert_double_eq_tol(z[i], 2.5e-6 * (i % 2 ? 1 : -1) * (i % 7), 6 * 2.5e-6 * 0x1p-23);
    arena_close(a);
    remove(map);
}
END_TEST

START_TEST(pitch_is_told_once)
{
    struct contact c = stroke();
    write_map(N, 1, NAN, 1e-6);
    check_refused(&c, ERR_SCENE, "give surface.pitch");
    write_map(N, 1, NAN, 1e-6);
    c.surface.pitch = 10e-6;
    ck_assert(accepted(&c));
    write_map(N, 1, 10e-6, 1e-6);
    ck_assert(accepted(&c));
    c.surface.pitch = 11e-6;
    check_refused(&c, ERR_SCENE, "the file says");
}
END_TEST

START_TEST(geometry_is_a_profiles)
{
    struct contact c = stroke();
    check_refused(&c, ERR_INPUT, map);
    write_map(50, 2, 10e-6, 1e-6);
    check_refused(&c, ERR_SCENE, "one row");
    write_map(3, 1, 10e-6, 1e-6);
    check_refused(&c, ERR_SCENE, "at least 4");
    write_map(4, 1, 10e-6, 1e-6);
    ck_assert(accepted(&c));
    write_map(N, 1, 2e-3, 1e-6);
    check_refused(&c, ERR_SCENE, "pitch");
    write_map(N, 1, 5e-9, 1e-6);
    check_refused(&c, ERR_SCENE, "pitch");
    write_map(N, 1, 10e-6, 1e-3); /* 12 mm from end to end */
    check_refused(&c, ERR_SCENE, "height_scale");
    write_map(N, 1, 10e-6, 5e-11);
    check_refused(&c, ERR_SCENE, "height_scale");
    write_map(N, 1, 10e-6, 0); /* flat is plausible */
    ck_assert(accepted(&c));
    remove(map);
}
END_TEST

/* off_map: error. The map reaches from 0 to 1 mm, along the stroke or, extruded, along x from its origin. */
START_TEST(leaving_the_map)
{
    struct contact c = stroke();
    c.surface.off_map = OFF_MAP_ERROR;
    struct {
        int along;
        double from, to, origin;
        bool inside;
    } cases[] = {
        {ALONG_PATH, 0, 1e-3, 0, true},       {ALONG_PATH, 0.5, 0.501, 9, true},       {ALONG_PATH, 0, 1.001e-3, 0, false},
        {ALONG_PATH, 0, -1e-3, 0, true},      {ALONG_X, 0, 1e-3, 0, true},             {ALONG_X, 0, 1e-3, 1e-6, false},
        {ALONG_X, 0, -1e-4, 0, false},        {ALONG_X, 0.25, 0.2505, 0.25, true},     {ALONG_X, 0.25, 0.2505, 0.2494999, false},
        {ALONG_X, 0.2505, 0.25, 0.25, true},  {ALONG_X, 0.2505, 0.25, 0.250001, false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        c.surface.along = cases[i].along;
        c.surface.origin[0] = cases[i].origin;
        c.motion.from[0] = cases[i].from, c.motion.to[0] = cases[i].to;
        write_map(N, 1, 10e-6, 1e-6);
        c.surface.off_map = OFF_MAP_ERROR;
        if (cases[i].inside)
            ck_assert_msg(accepted(&c), "case %zu", i);
        else
            check_refused(&c, ERR_SCENE, "leaves the height map");
        write_map(N, 1, 10e-6, 1e-6);
        c.surface.off_map = i % 2 ? OFF_MAP_MIRROR : OFF_MAP_WRAP;
        ck_assert_msg(accepted(&c), "case %zu", i);
    }
    remove(map);
}
END_TEST

UNIT("height_map", heights_are_the_files, pitch_is_told_once, geometry_is_a_profiles, leaving_the_map)
