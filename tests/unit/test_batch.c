/* A set's machinery: pool, shards, hashes, records, folder, tables. Nothing here renders. */
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "batch/folder.h"
#include "batch/pool.h"
#include "batch/record.h"
#include "batch/set.h"
#include "batch/tables.h"
#include "file/csv.h"
#include "unit.h"

static struct arena *a;

__attribute__((constructor)) static void open_arena(void) { a = arena_open(); }

/* ------------------------------------------------------------------ pool */

struct order {
    int ran[200], taken[200], n, stop_at;
};

static bool run_one(void *context, int i)
{
    struct order *o = context;
    usleep((useconds_t)(i * 7919 % 13) * 100);
    __atomic_fetch_add(&o->ran[i], 1, __ATOMIC_SEQ_CST);
    return i != o->stop_at;
}

static void take_one(void *context, int i)
{
    struct order *o = context;
    o->taken[o->n++] = i;
}

START_TEST(jobs_are_done_once_and_taken_in_order)
{
    for (int threads = 1; threads <= 8; threads *= 2) {
        struct order o = {.stop_at = -1};
        ck_assert_int_eq(pool_run(&(struct pool_work){
                             .n = 200, .threads = threads, .context = &o, .job = run_one, .took = take_one}),
                         200);
        ck_assert_int_eq(o.n, 200);
        for (int i = 0; i < 200; i++) {
            ck_assert_int_eq(o.ran[i], 1);
            ck_assert_int_eq(o.taken[i], i);
        }
    }
}
END_TEST

START_TEST(a_job_that_says_stop_is_the_last_to_begin)
{
    struct order one = {.stop_at = 20}, many = {.stop_at = 20};
    ck_assert_int_eq(
        pool_run(&(struct pool_work){.n = 200, .threads = 1, .context = &one, .job = run_one, .took = take_one}), 21);
    ck_assert_int_eq(one.ran[21], 0);
    int done =
        pool_run(&(struct pool_work){.n = 200, .threads = 4, .context = &many, .job = run_one, .took = take_one});
    ck_assert_int_ge(done, 21);
    ck_assert_int_lt(done, 60);
    ck_assert_int_eq(many.ran[199], 0);
}
END_TEST

/* ------------------------------------------------------------------ shards */

static struct design_stimulus named[1000];

/* A set of stimuli "s0", "s1" ... */
static struct set set_of(const struct design *d)
{
    for (int i = 0; i < d->n_stimuli; i++)
        named[i].name = arena_format(a, "s%d", i);
    return (struct set){.design = d, .n = d->n_stimuli};
}

START_TEST(shards_are_complete_and_of_equal_numbers)
{
    struct design d = {.stimuli = named, .n_stimuli = 1000};
    struct set s = set_of(&d);
    int to[1000];
    for (int n = 1; n <= 2000; n = 2 * n + 1) {
        int *count = ARENA_TAKE(a, int, n + 1);
        set_deal(&s, n, to);
        for (int i = 0; i < 1000; i++) {
            ck_assert(to[i] >= 1 && to[i] <= n);
            count[to[i]]++;
        }
        for (int k = 1; k <= n; k++)
            ck_assert(count[k] == 1000 / n || count[k] == 1000 / n + 1);
    }
}
END_TEST

/* Dealt in the order of SHA-256 of the names, whatever their order in the design: s2 ad32..., s1 e8bc..., s0 ec18... by
 * sha256sum. */
START_TEST(shards_know_names_alone)
{
    struct design d = {.stimuli = named, .n_stimuli = 3};
    struct set s = set_of(&d);
    int to[3], back[3];
    set_deal(&s, 3, to);
    named[0].name = "s2", named[2].name = "s0";
    set_deal(&s, 3, back);
    for (int i = 0; i < 3; i++)
        ck_assert_int_eq(to[i], back[2 - i]);
    ck_assert_int_eq(to[0], 3);
    ck_assert_int_eq(to[1], 2);
    ck_assert_int_eq(to[2], 1);
}
END_TEST

START_TEST(shards_are_read_strictly)
{
    static const char *const wrong[] = {"",     "/",     "0/3", "4/3", "1/0",  "1/10001",       "-1/3",
                                        "1/3/", "1 / 3", "a/3", "3",   "1/3x", "00000000001/3", NULL};
    struct set_shard s;
    struct err e = {0};
    ck_assert(set_shard_read("3/7", &s, &e) && s.i == 3 && s.n == 7);
    ck_assert(set_shard_read("10000/10000", &s, &e) && s.i == 10000);
    for (int i = 0; wrong[i]; i++) {
        struct err f = {0};
        ck_assert_msg(!set_shard_read(wrong[i], &s, &f) && f.kind == ERR_USAGE, "%s", wrong[i]);
    }
}
END_TEST

/* ------------------------------------------------------------------ hashes */

/* SHA-256 of "3:abc0:" by sha256sum. Where one text ends and the next begins counts. */
START_TEST(a_hash_knows_its_parts)
{
    ck_assert_str_eq(set_hash((const char *const[]){"abc", ""}, 2, a),
                     "bdf1004d3099a7a3712d12c456e15ebb2b81d43740868f77760be8f639855aad");
    ck_assert_str_ne(set_hash((const char *const[]){"ab", "c"}, 2, a),
                     set_hash((const char *const[]){"a", "bc"}, 2, a));
    ck_assert_str_ne(set_hash((const char *const[]){"abc"}, 1, a), set_hash((const char *const[]){"abc", ""}, 2, a));
}
END_TEST

/* ------------------------------------------------------------------ records */

static struct record_file files[] = {{"scene", "a/b.scene.yaml", false, "12", 34},
                                     {"wav", ".rasp/raw/a/b.wav", true, "56", 1e12}};
static const char *warnings[] = {"it is \"quiet\", \xc3\xa9", NULL};

static struct record a_record(void)
{
    return (struct record){.status = RECORD_WAITS,
                           .key = "k",
                           .program = "rasp",
                           .seen_from = "../d.yaml",
                           .full_scale = 1.0 / 3,
                           .peak = 0.1,
                           .rms = 1e-300,
                           .lufs = NAN,
                           .rate = 48000,
                           .channels = 2,
                           .encoding = ENCODING_PCM24,
                           .frames = 1L << 40,
                           .sounds = true,
                           .gain = 3,
                           .file_peak = 0.7,
                           .file_rms = 0.1,
                           .file_lufs = -23.000001,
                           .ramp = 0.01,
                           .audio = "34",
                           .files = files,
                           .n_files = 2,
                           .warnings = warnings,
                           .render = "{\"scene\": \"t\", \"files\": [{\"kind\": \"wav\", \"name\": \"b.wav\", "
                                     "\"silent\": false}], \"contacts\": [1]}"};
}

START_TEST(a_record_survives_its_text)
{
    struct record r = a_record(), back;
    const char *text = record_text(&r, a);
    ck_assert(record_parse(text, strlen(text), "a/b", a, &back));
    ck_assert(back.status == RECORD_WAITS && !strcmp(back.key, "k") && !strcmp(back.seen_from, "../d.yaml") &&
              !strcmp(back.audio, "34"));
    ck_assert_double_eq(back.full_scale, 1.0 / 3);
    ck_assert_double_eq(back.rms, 1e-300);
    ck_assert(isnan(back.lufs) && isnan(back.beyond) == isnan(r.beyond) && back.frames == 1L << 40 &&
              back.n_files == 2 && back.channels == 2 && !back.unit);
    ck_assert_str_eq(back.warnings[0], warnings[0]);
    for (int i = 0; i < 2; i++)
        ck_assert(!strcmp(back.files[i].path, files[i].path) && !strcmp(back.files[i].sha256, files[i].sha256) &&
                  back.files[i].raw == files[i].raw && back.files[i].size == files[i].size);
    ck_assert_ptr_nonnull(strstr(text, "\"silent\": false"));
    ck_assert_str_eq(text, record_text(&back, a));
}
END_TEST

static void open_folder(char path[64])
{
    struct err e = {0};
    strcpy(path, "/tmp/rasp-test-XXXXXX");
    ck_assert_ptr_nonnull(mkdtemp(path));
    ck_assert_msg(folder_make_for(path, ".rasp/a/", &e) && folder_make_for(path, "a/b", &e) &&
                      folder_make_for(path, "a/b", &e),
                  "%s", e.text);
}

static void remove_folder(const char *path)
{
    char command[128];
    snprintf(command, sizeof command, "rm -rf '%s'", path);
    ck_assert_int_eq(system(command), 0);
}

static void put(const char *path, const char *text, size_t n)
{
    FILE *f = fopen(path, "w");
    fwrite(text, 1, n, f);
    fclose(f);
}

/* What a power cut leaves of it, and whatever somebody changed. */
START_TEST(a_record_that_was_touched_is_none)
{
    char path[64];
    struct err e = {0};
    struct record r = a_record(), back;
    open_folder(path);
    ck_assert(!record_read(path, "a/b", a, &back));
    ck_assert_msg(record_write(path, "a/b", &r, &e), "%s", e.text);
    ck_assert(record_read(path, "a/b", a, &back) && !strcmp(back.files[1].path, files[1].path));
    const char *file = record_path(path, "a/b", a), *text = record_text(&r, a);
    size_t n = strlen(text);
    char *other = arena_text(a, text);
    for (size_t i = 0; i < n; i++) {
        other[i] ^= 1;
        put(file, other, n);
        ck_assert(!record_read(path, "a/b", a, &back));
        other[i] ^= 1;
        put(file, text, i);
        ck_assert(!record_read(path, "a/b", a, &back));
    }
    put(file, text, n);
    ck_assert(record_read(path, "a/b", a, &back));
    remove_folder(path);
}
END_TEST

/* A record that somebody wrote leads to no file that is not the stimulus's own. */
START_TEST(a_record_leads_nowhere_else)
{
    static const char *const wrong[] = {"../b.wav", "/b.wav", "c.wav", "b", "bb.wav", "b.json", "", NULL};
    struct record r = a_record(), back;
    for (int i = 0; wrong[i]; i++) {
        const char *text =
            arena_format(a,
                         "{\"set\": 2, \"status\": \"done\", \"key\": \"k\", \"program\": \"p\", \"files\": "
                         "[{\"kind\": \"wav\", \"name\": \"%s\", \"sha256\": \"1\", \"size\": 1}]}",
                         wrong[i]);
        ck_assert_msg(!record_parse(text, strlen(text), "a/b", a, &back), "%s", wrong[i]);
    }
    const char *text = record_text(&r, a);
    ck_assert(!record_parse(text, strlen(text), "a/c", a, &back));
}
END_TEST

/* ------------------------------------------------------------------ folder */

/* Only what is of a program that is gone is taken away: this one is there, process 1 is another, numbers beyond the
 * greatest are never there, and a zombie is gone. */
START_TEST(a_sweep_leaves_what_is_not_its_own)
{
    pid_t zombie = fork();
    if (zombie == 0) _exit(0);
    const char *const names[] = {arena_format(a, "a/.rasp-%d-0.part", (int)getpid()),
                                 "a/.rasp-x-0.part",
                                 "a/keep.part",
                                 "a/.rasp-99999999999-0.part",
                                 "a/.rasp-2147483647-0.part",
                                 ".rasp-2147483646-1.part",
                                 ".rasp-1-0.part",
                                 arena_format(a, ".rasp-%d-0.part", (int)zombie)};
    static const bool left[] = {true, true, true, true, false, false, false, false};
    char path[64];
    struct folder_stale stale;
    open_folder(path);
    for (int i = 0; i < 8; i++)
        fclose(fopen(arena_format(a, "%s/%s", path, names[i]), "w"));
    usleep(20000);
    folder_stale(&(struct folder_wanted){.folder = path, .inputs = folder_inputs(a)}, a, &stale);
    for (int i = 0; i < 8; i++)
        ck_assert_msg((access(arena_format(a, "%s/%s", path, names[i]), F_OK) == 0) == left[i], "%s", names[i]);
    remove_folder(path);
}
END_TEST

/* ------------------------------------------------------------------ tables */

static const char *printed(void (*print)(FILE *, const void *), const void *what)
{
    char *text = NULL;
    size_t size;
    FILE *f = open_memstream(&text, &size);
    print(f, what);
    fclose(f);
    const char *kept = arena_text(a, text);
    free(text);
    return kept;
}

static void put_number(FILE *f, const void *x) { tables_number(f, *(const double *)x); }

START_TEST(numbers_are_the_shortest_that_read_back)
{
    static const struct {
        double x;
        const char *text;
    } all[] = {{48000, "48000"}, {0.1, "0.1"},      {1.0 / 3, "0.3333333333333333"},
               {-3, "-3"},       {1e300, "1e+300"}, {5e-324, "5e-324"},
               {-0.0, "0"},      {NAN, "n/a"},      {HUGE_VAL, "n/a"}};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        ck_assert_str_eq(printed(put_number, &all[i].x), all[i].text);
}
END_TEST

/* What the project's own reader of tables finds in it is what went in. */
START_TEST(a_manifest_is_quoted_as_tables_are)
{
    struct design_level levels[] = {{.label = "wood, light", .value = "wood, light"},
                                    {.label = "\"hard\"", .value = "\"hard\""}};
    struct design_factor factor = {.name = "material", .column = "material", .levels = levels, .n_levels = 2};
    struct design_stimulus stimuli[] = {{.name = "a/b", .level = (int[]){0}, .replicate = 1, .seed = UINT64_MAX},
                                        {.name = "c", .level = (int[]){1}, .replicate = 2}};
    struct design d = {.factors = &factor, .n_factors = 1, .stimuli = stimuli, .n_stimuli = 2, .texts = NULL};
    struct set s = {.design = &d,
                    .sha256 = "d",
                    .program = "rasp",
                    .n = 2,
                    .level = {.full_scale = NAN, .peak = -3, .rms = NAN, .lufs = NAN, .dbfs_at_1_pa = NAN}};
    struct tables_row rows[2] = {{.there = true}, {.kind = ERR_NUMBERS, .text = "it said \"no\",\nand stopped"}};
    struct record r = a_record();
    char path[64];
    const char *no_effect;
    struct csv t;
    struct err e = {0};
    r.status = RECORD_DONE;
    open_folder(path);
    ck_assert(!tables_are_there(path, a));
    ck_assert_msg(record_write(path, "a/b", &r, &e) &&
                      tables_write(&(struct tables){&s, path, rows, a}, &no_effect, &e),
                  "%s", e.text);
    ck_assert_msg(csv_read(arena_format(a, "%s/manifest.csv", path), a, &t, &e), "%s", e.text);
    ck_assert(tables_are_there(path, a));
    tables_remove(path, a);
    ck_assert(!tables_are_there(path, a));
    remove_folder(path);
    ck_assert_str_eq(no_effect, "");
    ck_assert_int_eq((int)t.rows, 2);
    const char *const *second = t.cells + t.columns;
    ck_assert_str_eq(t.cells[csv_column(&t, "material")], "wood, light");
    ck_assert_str_eq(t.cells[csv_column(&t, "seed")], "18446744073709551615");
    ck_assert_str_eq(t.cells[csv_column(&t, "level_mode")], "common peak -3 dB");
    ck_assert_str_eq(t.cells[csv_column(&t, "status")], "ok");
    ck_assert_str_eq(second[csv_column(&t, "material")], "\"hard\"");
    ck_assert_str_eq(second[csv_column(&t, "error")], "it said \"no\",\nand stopped");
    ck_assert_str_eq(second[csv_column(&t, "error_code")], "70");
    ck_assert_str_eq(second[csv_column(&t, "file_name")], "n/a");
}
END_TEST

/* ------------------------------------------------------------------ levels */

static double found(struct level l, const struct set_measured *one, const struct set_measured *other)
{
    struct set s = {.n = 3, .level_rule = DESIGN_LEVEL_COMMON, .level = l};
    const struct set_measured silent = {1e6, 1e6, 99, ENCODING_PCM16, false};
    struct set_loudest g = set_loudest();
    struct err e = {0};
    double full_scale = 0;
    set_loudest_add(&g, one);
    set_loudest_add(&g, other);
    set_loudest_add(&g, &silent);
    ck_assert_msg(set_gain(&s, &g, &full_scale, &e), "%s", e.text);
    return full_scale;
}

/* The louder of two sets it; what makes no sound does not. */
START_TEST(the_common_level_is_that_of_the_loudest)
{
    const struct level none = {NAN, NAN, NAN, NAN, NAN, false};
    struct set_measured one = {2, 0.1, -20, ENCODING_PCM24, true}, other = {1, 0.5, NAN, ENCODING_PCM24, true};
    struct set_loudest quiet = set_loudest();
    struct err e = {0};
    struct level l;
    l = none, l.peak = -20;
    ck_assert_double_eq_tol(found(l, &one, &other), 2 / 0.1, 1e-14);
    l = none, l.peak = 0;
    ck_assert_double_eq_tol(found(l, &one, &other), 2 / (1 - ldexp(1, -23)), 1e-14);
    l = none, l.rms = -20;
    ck_assert_double_eq_tol(found(l, &one, &other), 0.5 / 0.1, 1e-14);
    ck_assert_double_eq_tol(found(l, &other, &one), 0.5 / 0.1, 1e-14);
    l = none, l.lufs = -40;
    set_loudest_add(&quiet, &other);
    ck_assert(
        !set_gain(&(struct set){.n = 2, .level_rule = DESIGN_LEVEL_COMMON, .level = l}, &quiet, &(double){0}, &e) &&
        e.kind == ERR_SCENE);
    ck_assert_double_eq_tol(found(l, &one, &other), 10, 1e-13);
    one.peak = other.peak = 0;
    ck_assert_double_eq(found(l, &one, &other), 1);
}
END_TEST

START_TEST(times_are_short)
{
    static const struct {
        double s;
        const char *text;
    } all[] = {{0, "0:00"}, {0.2, "0:01"}, {61, "1:01"}, {3600, "1:00:00"}, {1e30, "2777:46:39"}};
    char text[24];
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        pool_progress_time(all[i].s, text);
        ck_assert_str_eq(text, all[i].text);
    }
}
END_TEST

UNIT("batch", jobs_are_done_once_and_taken_in_order, a_job_that_says_stop_is_the_last_to_begin,
     shards_are_complete_and_of_equal_numbers, shards_know_names_alone, shards_are_read_strictly,
     a_hash_knows_its_parts, a_record_survives_its_text, a_record_that_was_touched_is_none, a_record_leads_nowhere_else,
     a_sweep_leaves_what_is_not_its_own, numbers_are_the_shortest_that_read_back, a_manifest_is_quoted_as_tables_are,
     the_common_level_is_that_of_the_loudest, times_are_short)
