/* height_map: the stage on files written here: what becomes of their heights, which coordinates the surface follows,
   and what of their geometry and place under the motion is refused. */
#include "file/heightfile.h"
#include "pipeline/stages.h"
#include "rig.h"
#include "scene/params.h"
#include "scene/scene.h"
#include "stage.h"
#include "surface/height_map.h"
#include "surface/limiter.h"
#include "surface/relief.h"
#include "trajectory/trajectory.h"
#include "unit.h"

#include <unistd.h>

extern const struct stage height_map_stage;

static char map[] = "/tmp/test_height_map.XXXXXX";
enum { N = 101 };

static void write_map(size_t columns, size_t rows, double pitch, double height)
{
    static double z[N * N];
    struct heightfile_written w;
    struct err e = {0};
    for (size_t i = 0; i < columns * rows; i++)
        z[i] = height * (i % 2 ? 1.0 : -1.0) * (double)(i % 7);
    struct heightfile h = {.columns = columns,
                           .rows = rows,
                           .pitch_x = pitch,
                           .pitch_y = rows > 1 ? 2 * pitch : pitch,
                           .z = z,
                           .metric = true};
    ck_assert_msg(heightfile_write(map, &h, HEIGHTFILE_GSF, &w, &e), "%s", e.text);
}

static struct height_map_file *asked; /* of the contact of stroke() */

/* A stroke along +x over the first half of a map of 100 intervals of 10 um. */
static struct contact stroke(void)
{
    int handle = mkstemp(map); /* each test is a process of its own */
    ck_assert_int_ge(handle, 0);
    close(handle);
    remove(map);
    struct contact c = {.name = "rod", .motion = {.path = PATH_LINE, .to = {5e-4, 0}, .speed = 0.1, .duration = NAN}};
    *(struct limiter *)params_edit(&c, limiter_stage.params, rig_arena()) =
        (struct limiter){.alpha = 0.03, .alpha_max = 0.05};
    asked = params_edit(&c, height_map_stage.params, rig_arena());
    *asked = (struct height_map_file){.path = map, .read = {.pitch = NAN, .height_scale = NAN, .height_range = NAN}};
    return c;
}

struct opened {
    struct arena *arena;
    struct relief relief;
    struct trajectory motion;
    struct board board;
    struct err err;
    bool good;
};

/* Opens the stage; the surface lives in the arena. */
static void open_map(struct opened *o, const struct contact *c)
{
    *o = (struct opened){.arena = arena_open(),
                         .relief = {.along = c->surface.along, .origin = {c->surface.origin[0], c->surface.origin[1]}}};
    ck_assert_msg(trajectory_make(&c->motion, 1, o->arena, &o->motion, &o->err), "%s", o->err.text);
    o->board = (struct board){.relief = &o->relief, .trajectory = &o->motion};
    static const struct scene none;
    struct stage_run run = {
        .stage = &height_map_stage, .scene = &none, .contact = c, .board = &o->board, .arena = o->arena};
    o->good = height_map_stage.open(&run, &o->err);
}

static void check_refused(const struct contact *c, enum err_kind kind, const char *word)
{
    struct opened o;
    open_map(&o, c);
    ck_assert_msg(!o.good, "not refused: %s", word);
    ck_assert_msg(o.err.kind == kind && strstr(o.err.text, word), "%d: %s", o.err.kind, o.err.text);
    remove(map);
    arena_close(o.arena);
}

static void check_accepted(const struct contact *c)
{
    struct opened o;
    open_map(&o, c);
    ck_assert_msg(o.good, "%s", o.err.text);
    arena_close(o.arena);
}

/* Heights at the samples are the file's times height_scale, within float32, in which GSF stores them. */
START_TEST(heights_are_the_files)
{
    struct contact c = stroke();
    struct opened o;
    write_map(N, 1, 10e-6, 1e-6);
    asked->read.height_scale = 2.5;
    open_map(&o, &c);
    ck_assert_msg(o.good, "%s", o.err.text);
    const struct relief_part *p = o.relief.first;
    ck_assert(p && !p->next && p->linear && p->pitch[1] == 0 && p->from[0] == 0 && o.relief.along == ALONG_PATH);
    ck_assert_double_eq_tol(p->pitch[0], 10e-6, 1e-12);
    for (int i = 0; i < N; i++) {
        double x = i * p->pitch[0], z;
        relief_at(&o.relief, &(struct relief_points){1, &x, NULL}, &(struct relief_values){.z = &z});
        ck_assert_double_eq_tol(z, 2.5e-6 * (i % 2 ? 1 : -1) * (i % 7), 6 * 2.5e-6 * 0x1p-23);
    }
    const struct height_map *kept = o.board.height_map;
    ck_assert(kept->columns == N && kept->rows == 1 && kept->pitch[0] == p->pitch[0]);
    arena_close(o.arena);
    remove(map);
}
END_TEST

/* A map of several rows lies in the plane, its first sample at surface.origin, rows along y at the file's other pitch.
 */
START_TEST(maps_lie_in_the_plane)
{
    struct contact c = stroke();
    struct opened o;
    write_map(40, 30, 10e-6, 1e-6);
    c.surface.origin[0] = 1e-3;
    c.surface.origin[1] = -2e-3;
    open_map(&o, &c);
    ck_assert_msg(o.good, "%s", o.err.text);
    const struct relief_part *p = o.relief.first;
    ck_assert(o.relief.along == ALONG_PLANE && !p->linear && p->origin[0] == 0 && p->origin[1] == 0);
    ck_assert_double_eq_tol(p->pitch[1], 20e-6, 1e-12);
    for (int j = 0; j < 30; j += 7)
        for (int i = 0; i < 40; i += 7) {
            double x = 1e-3 + i * p->pitch[0], y = -2e-3 + j * p->pitch[1], z, k = j * 40 + i;
            relief_at(&o.relief, &(struct relief_points){1, &x, &y}, &(struct relief_values){.z = &z});
            ck_assert_double_eq_tol(z, 1e-6 * (fmod(k, 2) > 0 ? 1 : -1) * fmod(k, 7), 6e-6 * 0x1p-23);
        }
    ck_assert(o.board.height_map->rows == 30);
    arena_close(o.arena);
    c.surface.along = ALONG_PATH;
    check_refused(&c, ERR_SCENE, "in the plane");
    write_map(40, 30, 10e-6, 1e-6);
    c.surface.along = ALONG_X;
    check_refused(&c, ERR_SCENE, "--row");
    write_map(N, 1, 10e-6, 1e-6);
    check_accepted(&c);
    c.surface.along = ALONG_PLANE;
    check_refused(&c, ERR_SCENE, "no second dimension");
}
END_TEST

START_TEST(pitch_is_told_once)
{
    struct contact c = stroke();
    write_map(N, 1, 10e-6, 1e-6);
    check_accepted(&c);
    asked->read.pitch = 11e-6;
    check_refused(&c, ERR_SCENE, "surface.pitch");
}
END_TEST

START_TEST(geometry_is_a_surfaces)
{
    struct contact c = stroke();
    check_refused(&c, ERR_INPUT, map);
    write_map(3, 1, 10e-6, 1e-6);
    check_refused(&c, ERR_SCENE, "at least 4");
    write_map(50, 2, 10e-6, 1e-6);
    check_refused(&c, ERR_SCENE, "at least 4");
    write_map(4, 4, 10e-6, 1e-6);
    check_accepted(&c);
    write_map(N, 1, 10e-6, 0); /* flat is plausible */
    check_accepted(&c);
    remove(map);
}
END_TEST

/* off_map: error. The profile reaches from 0 to 1 mm, along the stroke or, extruded, along x from its origin. */
START_TEST(leaving_the_profile)
{
    struct contact c = stroke();
    struct {
        int along;
        double from, to, origin;
        bool inside;
    } cases[] = {
        {ALONG_PATH, 0, 1e-3, 0, true},
        {ALONG_PATH, 0.5, 0.501, 9, true},
        {ALONG_PATH, 0, 1.001e-3, 0, false},
        {ALONG_PATH, 0, -1e-3, 0, true},
        {ALONG_X, 0, 1e-3, 0, true},
        {ALONG_X, 0, 1e-3, 1e-6, false},
        {ALONG_X, 0, -1e-4, 0, false},
        {ALONG_X, 0.25, 0.2505, 0.25, true},
        {ALONG_X, 0.25, 0.2505, 0.2494999, false},
        {ALONG_X, 0.2505, 0.25, 0.25, true},
        {ALONG_X, 0.2505, 0.25, 0.250001, false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        c.surface.along = cases[i].along;
        c.surface.origin[0] = cases[i].origin;
        c.motion.from[0] = cases[i].from, c.motion.to[0] = cases[i].to;
        write_map(N, 1, 10e-6, 1e-6);
        asked->off_map = OFF_MAP_ERROR;
        if (cases[i].inside)
            check_accepted(&c);
        else
            check_refused(&c, ERR_SCENE, "leaves the height map");
        write_map(N, 1, 10e-6, 1e-6);
        asked->off_map = i % 2 ? OFF_MAP_MIRROR : OFF_MAP_WRAP;
        check_accepted(&c);
    }
    remove(map);
}
END_TEST

/* The same in the plane, where the whole of a curve counts: 40 x 30 samples reach 390 um by 580 um. */
START_TEST(leaving_the_map)
{
    struct contact c = stroke();
    struct {
        double center[2], radius;
        const char *word; /* NULL: inside */
    } cases[] = {
        {{195e-6, 290e-6}, 194e-6, NULL},   {{195e-6, 290e-6}, 196e-6, "in x"}, {{150e-6, 290e-6}, 151e-6, "in x"},
        {{195e-6, 150e-6}, 151e-6, "in y"}, {{195e-6, 430e-6}, 151e-6, "in y"}, {{195e-6, 429e-6}, 150e-6, NULL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        c.motion = (struct motion){.path = PATH_CIRCLE,
                                   .radius = cases[i].radius,
                                   .center = {cases[i].center[0], cases[i].center[1]},
                                   .turns = 1,
                                   .speed = 0.1,
                                   .duration = NAN};
        asked->off_map = OFF_MAP_ERROR;
        write_map(40, 30, 10e-6, 1e-6);
        if (!cases[i].word)
            check_accepted(&c);
        else
            check_refused(&c, ERR_SCENE, cases[i].word);
    }
    remove(map);
}
END_TEST

UNIT("height_map", heights_are_the_files, maps_lie_in_the_plane, pitch_is_told_once, geometry_is_a_surfaces,
     leaving_the_profile, leaving_the_map)
