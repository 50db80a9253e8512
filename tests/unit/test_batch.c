/* A set's machinery: pool, shards, job hashes, records, journal, manifest. Nothing here renders. */
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "batch/folder.h"
#include "batch/job.h"
#include "batch/level.h"
#include "batch/manifest_columns.h"
#include "batch/pool.h"
#include "batch/progress.h"
#include "batch/shard.h"
#include "file/csv.h"
#include "unit.h"

static struct arena *a;

__attribute__((constructor)) static void open_arena(void)
{
    a = arena_open();
}

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
        ck_assert_int_eq(pool_run(&(struct pool_work){.n = 200, .threads = threads, .context = &o, .job = run_one, .took = take_one}), 200);
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
    ck_assert_int_eq(pool_run(&(struct pool_work){.n = 200, .threads = 1, .context = &one, .job = run_one, .took = take_one}), 21);
    ck_assert_int_eq(one.ran[21], 0);
    int done = pool_run(&(struct pool_work){.n = 200, .threads = 4, .context = &many, .job = run_one, .took = take_one});
    ck_assert_int_ge(done, 21);
    ck_assert_int_lt(done, 60);
    ck_assert_int_eq(many.ran[199], 0);
}
END_TEST

/* ------------------------------------------------------------------ shards */

static double noise(int i)
{
    return 1 + (double)((unsigned)i * 2654435761u >> 8) / (1 << 24) * 99;
}

/* Every job has one shard; no load is more than the mean plus the dearest job, and Graham's bound on the optimum, of which mean and dearest are lower bounds, holds. */
START_TEST(shards_are_complete_and_balanced)
{
    double cost[1000], whole = 0, dearest = 0;
    int to[1000];
    for (int i = 0; i < 1000; i++) {
        cost[i] = noise(i);
        whole += cost[i];
        dearest = fmax(dearest, cost[i]);
    }
    for (int n = 1; n <= 2000; n = 2 * n + 1) {
        double *load = ARENA_TAKE(a, double, n + 1), most = 0;
        shard_assign(cost, 1000, n, to, a);
        for (int i = 0; i < 1000; i++) {
            ck_assert(to[i] >= 1 && to[i] <= n);
            load[to[i]] += cost[i];
        }
        for (int k = 1; k <= n; k++)
            most = fmax(most, load[k]);
        ck_assert_double_le(most, whole / n + dearest);
        if (n >= 1000)
            ck_assert_double_eq(most, dearest);
        if (n <= 31)
            ck_assert_double_le(most, whole / n * 1.01);
    }
}
END_TEST

/* By hand: 7 6 5 4 3 on two shards: 7, 6, 5 to the one with 6, 4 to the one with 7, 3 to either at 11: the lower. */
START_TEST(the_dearest_goes_first_to_the_least_loaded)
{
    int to[5];
    shard_assign((const double[]){3, 4, 5, 6, 7}, 5, 2, to, a);
    ck_assert_int_eq(to[4], 1);
    ck_assert_int_eq(to[3], 2);
    ck_assert_int_eq(to[2], 2);
    ck_assert_int_eq(to[1], 1);
    ck_assert_int_eq(to[0], 1);
}
END_TEST

START_TEST(shards_are_read_strictly)
{
    static const char *const wrong[] = {"", "/", "0/3", "4/3", "1/0", "1/10001", "-1/3", "1/3/", "1 / 3", "a/3", "3", "1/3x", "00000000001/3", NULL};
    struct shard s;
    struct err e = {0};
    ck_assert(shard_read("3/7", &s, &e) && s.i == 3 && s.n == 7);
    ck_assert(shard_read("10000/10000", &s, &e) && s.i == 10000);
    for (int i = 0; wrong[i]; i++) {
        struct err f = {0};
        ck_assert_msg(!shard_read(wrong[i], &s, &f) && f.kind == ERR_USAGE, "%s", wrong[i]);
    }
}
END_TEST

/* ------------------------------------------------------------------ hashes */

/* SHA-256 of "3:abc0:" by sha256sum. Where one text ends and the next begins counts. */
START_TEST(a_job_hash_knows_its_parts)
{
    ck_assert_str_eq(job_hash((const char *const[]){"abc", ""}, 2, a), "bdf1004d3099a7a3712d12c456e15ebb2b81d43740868f77760be8f639855aad");
    ck_assert_str_ne(job_hash((const char *const[]){"ab", "c"}, 2, a), job_hash((const char *const[]){"a", "bc"}, 2, a));
    ck_assert_str_ne(job_hash((const char *const[]){"abc"}, 1, a), job_hash((const char *const[]){"abc", ""}, 2, a));
}
END_TEST

/* ------------------------------------------------------------------ records */

static struct record_file files[] = {{"wav", "a/b.wav", "12"}, {"summary", "a/b.json", NULL}};
static const char *remarks[] = {"it is \"quiet\", \xc3\xa9", NULL};

static struct record a_record(const char *name, const char *key, const char *job)
{
    return (struct record){.name = name, .key = key, .job = job, .build = "rasp", .full_scale = 1.0 / 3, .peak = 0.1, .rms = 1e-300, .lufs = NAN, .rate = 48000, .channels = 2,
                           .encoding = ENCODING_PCM24, .frames = 1L << 40, .sounds = true, .gain = 3, .file_peak = 0.7, .file_rms = 0.1, .file_lufs = -23.000001, .ramp = 0.01,
                           .audio = "34", .files = files, .n_files = 2, .remarks = remarks, .wall = 1.5, .cpu = NAN};
}

START_TEST(a_record_survives_its_line)
{
    struct record r = a_record("a/b", "k", "j"), back;
    char *line = record_text(&r, true), *again;
    ck_assert_ptr_null(strchr(line, '\n'));
    ck_assert(record_read(line, strlen(line), a, &back));
    ck_assert_str_eq(back.name, "a/b");
    ck_assert_str_eq(back.job, "j");
    ck_assert_double_eq(back.full_scale, 1.0 / 3);
    ck_assert_double_eq(back.rms, 1e-300);
    ck_assert(isnan(back.lufs) && isnan(back.cpu) && back.wall == 1.5 && back.frames == 1L << 40 && back.n_files == 2);
    ck_assert_str_eq(back.remarks[0], remarks[0]);
    ck_assert(!back.files[1].sha256 && !strcmp(back.files[0].sha256, "12"));
    again = record_text(&back, true);
    ck_assert_str_eq(line, again);
    for (size_t n = 0; n < strlen(line); n++)
        ck_assert(!record_read(line, n, a, &back));
    free(again);
    free(line);
}
END_TEST

/* ------------------------------------------------------------------ journal */

static void open_folder(char path[64])
{
    struct err e = {0};
    strcpy(path, "/tmp/rasp-test-XXXXXX");
    ck_assert_ptr_nonnull(mkdtemp(path));
    ck_assert_msg(folder_make(path, &e), "%s", e.text);
}

static void remove_folder(const char *path)
{
    char command[128];
    snprintf(command, sizeof command, "rm -rf '%s'", path);
    ck_assert_int_eq(system(command), 0);
}

START_TEST(a_journal_forgives_a_torn_line)
{
    char path[64];
    struct err e = {0};
    open_folder(path);
    const char *file = arena_format(a, "%s/.rasp/journal.1-of-2", path);
    FILE *f = fopen(file, "w");
    fputs("{\"name\": \"torn", f);
    fclose(f);
    struct record raw = a_record("x", "kx", NULL), done = a_record("x", "kx", "jx"), newer = a_record("x", "kx", "jx");
    struct journal_ref ref, old;
    newer.gain = 7;
    struct journal *j = journal_open(path, file, a, &e);
    ck_assert(j && journal_add(j, &raw, &ref, &e) && journal_add(j, &done, &old, &e) && journal_add(j, &newer, &ref, &e));
    ck_assert_ptr_null(journal_find(j, "kx", false, a, &ref));
    ck_assert_double_eq(journal_read(j, old, a, &e)->gain, 3);
    journal_close(j);
    j = journal_open(path, NULL, a, &e);
    ck_assert_double_eq(journal_find(j, "kx", false, a, &ref)->gain, 7);
    ck_assert_double_eq(journal_find(j, "jx", false, a, &ref)->gain, 7);
    ck_assert_ptr_null(journal_find(j, "kx", true, a, &ref)->job);
    ck_assert_ptr_null(journal_find(j, "jx", true, a, &ref));
    ck_assert_ptr_null(journal_find(j, "k", false, a, &ref));
    ck_assert(journal_find(j, "kx", false, a, &ref) && journal_settle(j, (const struct journal_ref[]){{0}, ref}, 2, &e));
    journal_close(j);
    ck_assert_int_ne(access(file, F_OK), 0);
    j = journal_open(path, NULL, a, &e);
    ck_assert_double_eq(journal_find(j, "kx", false, a, &ref)->gain, 7);
    ck_assert(isnan(journal_find(j, "kx", false, a, &ref)->wall));
    ck_assert_ptr_null(journal_find(j, "kx", true, a, &ref));
    journal_close(j);
    remove_folder(path);
}
END_TEST

/* Only what is of a program that is gone is taken away: this one is there, process 1 is another, numbers beyond the greatest are never there, and a zombie is gone. */
START_TEST(a_sweep_leaves_what_is_not_its_own)
{
    pid_t zombie = fork();
    if (zombie == 0)
        _exit(0);
    const char *const names[] = {arena_format(a, "a/.rasp-%d-0.part", (int)getpid()), "a/.rasp-x-0.part", "a/keep.part", "a/.rasp-99999999999-0.part", "a/.rasp-2147483647-0.part", ".rasp-2147483646-1.part", ".rasp-1-0.part",
                                 arena_format(a, ".rasp-%d-0.part", (int)zombie)};
    static const bool left[] = {true, true, true, true, false, false, false, false};
    char path[64];
    struct err e = {0};
    open_folder(path);
    ck_assert(folder_make_for(path, "a/b", &e) && folder_make_for(path, "a/b", &e));
    for (int i = 0; i < 8; i++)
        fclose(fopen(arena_format(a, "%s/%s", path, names[i]), "w"));
    usleep(20000);
    folder_sweep(path, (const char *const[]){"a/b", "a/c"}, 2, true);
    for (int i = 0; i < 8; i++)
        ck_assert_msg((access(arena_format(a, "%s/%s", path, names[i]), F_OK) == 0) == left[i], "%s", names[i]);
    remove_folder(path);
}
END_TEST

/* ------------------------------------------------------------------ manifest */

static const char *printed(void (*put)(FILE *, const void *), const void *what)
{
    char *text = NULL;
    size_t size;
    FILE *f = open_memstream(&text, &size);
    put(f, what);
    fclose(f);
    const char *kept = arena_text(a, text);
    free(text);
    return kept;
}

static void put_number(FILE *f, const void *x)
{
    manifest_columns_number(f, *(const double *)x);
}

START_TEST(numbers_are_the_shortest_that_read_back)
{
    static const struct {
        double x;
        const char *text;
    } all[] = {{48000, "48000"}, {0.1, "0.1"}, {1.0 / 3, "0.3333333333333333"}, {-3, "-3"}, {1e300, "1e+300"}, {5e-324, "5e-324"}, {-0.0, "0"}, {NAN, "n/a"}, {HUGE_VAL, "n/a"}};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        ck_assert_str_eq(printed(put_number, &all[i].x), all[i].text);
}
END_TEST

static void put_set(FILE *f, const void *set)
{
    char path[64];
    struct err e = {0};
    struct record r = a_record("a/b", "k", "j");
    struct outcome outcomes[2] = {{.kind = ERR_NONE}, {.kind = ERR_NUMBERS, .text = "it said \"no\",\nand stopped"}};
    open_folder(path);
    struct journal *j = journal_open(path, arena_format(a, "%s/.rasp/journal", path), a, &e);
    ck_assert_msg(j && journal_add(j, &r, &outcomes[0].record, &e), "%s", e.text);
    ck_assert_msg(manifest_print(f, &(struct results){set, outcomes, j}, NULL, &e), "%s", e.text);
    journal_close(j);
    remove_folder(path);
}

/* What the project's own reader of tables finds in it is what went in. */
START_TEST(a_manifest_is_quoted_as_tables_are)
{
    const char *labels[] = {"wood, light", "\"hard\""};
    struct set_factor factor = {.name = "material", .column = "material", .texts = labels, .values = labels, .n = 2};
    struct set_row rows[] = {{.name = "a/b", .values = &labels[0], .replicate = 1, .seed = UINT64_MAX, .cost = 1}, {.name = "c", .values = &labels[1], .replicate = 2, .cost = 1}};
    struct set s = {.sha256 = "d", .build = "rasp", .factors = &factor, .n_factors = 1, .rows = rows, .n = 2, .level = {.full_scale = NAN, .peak = -3, .rms = NAN, .lufs = NAN, .dbfs_at_1_pa = NAN}};
    char path[] = "/tmp/rasp-test-XXXXXX";
    int fd = mkstemp(path);
    FILE *f = fdopen(fd, "w");
    fputs(printed(put_set, &s), f);
    fclose(f);
    struct csv t;
    struct err e = {0};
    ck_assert_msg(csv_read(path, a, &t, &e), "%s", e.text);
    unlink(path);
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

static double found(struct level l, const struct record *one, const struct record *other)
{
    struct set s = {.n = 3, .level_rule = DESIGN_LEVEL_COMMON, .level = l};
    struct record silent = a_record("c", "k", "j");
    struct level_greatest g = level_start();
    struct err e = {0};
    double full_scale = 0;
    silent.peak = silent.rms = 1e6;
    silent.lufs = 99;
    silent.sounds = false;
    level_look(&g, one);
    level_look(&g, other);
    level_look(&g, &silent);
    ck_assert_msg(level_find(&s, &g, &full_scale, &e), "%s", e.text);
    return full_scale;
}

/* The louder of two sets it; what makes no sound does not. */
START_TEST(the_common_level_is_that_of_the_loudest)
{
    const struct level none = {NAN, NAN, NAN, NAN, NAN, false};
    struct record one = a_record("a", "k", NULL), other = one;
    struct level_greatest g = level_start();
    struct err e = {0};
    struct level l;
    one.peak = 2, one.rms = 0.1, one.lufs = -20;
    other.peak = 1, other.rms = 0.5, other.lufs = NAN;
    l = none, l.peak = -20;
    ck_assert_double_eq_tol(found(l, &one, &other), 2 / 0.1, 1e-14);
    l = none, l.peak = 0;
    ck_assert_double_eq_tol(found(l, &one, &other), 2 / (1 - ldexp(1, -23)), 1e-14);
    l = none, l.rms = -20;
    ck_assert_double_eq_tol(found(l, &one, &other), 0.5 / 0.1, 1e-14);
    ck_assert_double_eq_tol(found(l, &other, &one), 0.5 / 0.1, 1e-14);
    l = none, l.lufs = -40;
    one.loud = true;
    level_look(&g, &one);
    level_look(&g, &other); /* of which it is not known whether it is too quiet or was not measured */
    ck_assert(!level_find(&(struct set){.n = 2, .level_rule = DESIGN_LEVEL_COMMON, .level = l}, &g, &(double){0}, &e) && e.kind == ERR_INPUT);
    other.loud = true;
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
        progress_time(all[i].s, text);
        ck_assert_str_eq(text, all[i].text);
    }
}
END_TEST

UNIT("batch", jobs_are_done_once_and_taken_in_order, a_job_that_says_stop_is_the_last_to_begin, shards_are_complete_and_balanced, the_dearest_goes_first_to_the_least_loaded,
     shards_are_read_strictly, a_job_hash_knows_its_parts, a_record_survives_its_line, a_journal_forgives_a_torn_line, a_sweep_leaves_what_is_not_its_own,
     numbers_are_the_shortest_that_read_back, a_manifest_is_quoted_as_tables_are, the_common_level_is_that_of_the_loudest, times_are_short)
