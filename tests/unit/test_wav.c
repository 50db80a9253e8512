/* wav: bytes on disk against a layout read by hand here, exact round trips, refusals. */
#include <dirent.h>
#include <signal.h>
#include <stdint.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include "base/arena.h"
#include "file/wav.h"
#include "folder.h"

static unsigned char disk[1 << 20];

static size_t slurp(const char *path)
{
    FILE *f = fopen(path, "rb");
    ck_assert_ptr_nonnull(f);
    size_t n = fread(disk, 1, sizeof disk, f);
    fclose(f);
    return n;
}

static void spill(const char *path, size_t n)
{
    FILE *f = fopen(path, "wb");
    ck_assert_ptr_nonnull(f);
    ck_assert_uint_eq(fwrite(disk, 1, n, f), n);
    fclose(f);
}

static void put(const char *path, struct wav_format f, const double *x, size_t frames)
{
    struct err e = {0};
    struct wav_out *w = wav_create(path, &f, &e);
    ck_assert_msg(w != NULL, "%s", e.text);
    ck_assert_msg(wav_write(w, x, frames, &e), "%s", e.text);
    ck_assert_msg(wav_commit(w, &e), "%s", e.text);
}

static uint32_t word(size_t at)
{
    return disk[at] | (uint32_t)disk[at + 1] << 8 | (uint32_t)disk[at + 2] << 16 | (uint32_t)disk[at + 3] << 24;
}

/* Offset of a chunk's content, 0: none. */
static size_t chunk(const char *name, size_t n)
{
    for (size_t at = 12; at + 8 <= n; at += 8 + word(at + 4) + word(at + 4) % 2)
        if (!memcmp(disk + at, name, 4)) return at + 8;
    return 0;
}

START_TEST(layout_of_plain_pcm)
{
    const double x[] = {0, 0.5, -1, 32767.0 / 32768};
    const int want[] = {0, 16384, -32768, 32767};
    folder_enter();
    put("a.wav", (struct wav_format){.rate = 44100, .channels = 2, .bits = 16}, x, 2);
    size_t n = slurp("a.wav");
    ck_assert_uint_eq(n, 44 + 8);
    ck_assert_mem_eq(disk, "RIFF", 4);
    ck_assert_uint_eq(word(4), n - 8);
    ck_assert_mem_eq(disk + 8, "WAVEfmt \x10\0\0\0\1\0\2\0", 16);
    ck_assert_uint_eq(word(24), 44100);
    ck_assert_uint_eq(word(28), 44100 * 4);
    ck_assert_mem_eq(disk + 32, "\4\0\x10\0data\x08\0\0\0", 12);
    for (size_t i = 0; i < 4; i++)
        ck_assert_int_eq((int16_t)(disk[44 + 2 * i] | disk[45 + 2 * i] << 8), want[i]);
    unlink("a.wav");
    folder_leave();
}
END_TEST

START_TEST(rounds_to_nearest_even)
{
    const double q = 1.0 / 8388608,
                 x[] = {0.5 * q, 1.5 * q, -0.5 * q, -1.5 * q, 0.499 * q, 2.501 * q, 1 - 0.51 * q - q};
    const int want[] = {0, 2, 0, -2, 0, 3, 8388606};
    folder_enter();
    put("a.wav", (struct wav_format){.rate = 48000, .channels = 1, .bits = 24}, x, 7);
    size_t n = slurp("a.wav"), data = chunk("data", n);
    for (size_t i = 0; i < 7; i++) {
        int v = disk[data + 3 * i] | disk[data + 3 * i + 1] << 8 | disk[data + 3 * i + 2] << 16;
        ck_assert_int_eq(v >= 8388608 ? v - 16777216 : v, want[i]);
    }
    unlink("a.wav");
    folder_leave();
}
END_TEST

START_TEST(title_comment_and_no_peak)
{
    const double x[] = {0.25, -0.25};
    folder_enter();
    for (int bits = -64; bits <= 24; bits += bits < -32 ? 32 : bits < 0 ? 48 : 8) {
        put("a.wav", (struct wav_format){48000, 1, bits, "a title", "gain \xc2\xb1 3 dB", 0}, x, 2);
        size_t n = slurp("a.wav"), list = chunk("LIST", n);
        ck_assert_uint_ne(list, 0);
        ck_assert_uint_eq(chunk("PEAK", n), 0);
        ck_assert_ptr_nonnull(memmem(disk + list, word(list - 4), "INAM\x08\0\0\0a title", 16));
        ck_assert_ptr_nonnull(memmem(disk + list, word(list - 4), "gain \xc2\xb1 3 dB", 13));
        ck_assert_ptr_null(memmem(disk, n, "libsndfile", 10));
    }
    unlink("a.wav");
    folder_leave();
}
END_TEST

static void check_same_bytes(struct wav_format f)
{
    static unsigned char before[sizeof disk];
    double x[128];
    for (int i = 0; i < 128; i++)
        x[i] = sin(i);
    put("a.wav", f, x, 64);
    size_t n = slurp("a.wav");
    memcpy(before, disk, n);
    nanosleep(&(struct timespec){1, 100000000}, NULL);
    put("a.wav", f, x, 64);
    ck_assert_uint_eq(slurp("a.wav"), n);
    ck_assert_mem_eq(before, disk, n);
}

START_TEST(same_bytes_a_second_later)
{
    folder_enter();
    check_same_bytes((struct wav_format){48000, 1, -32, "t", "c", 0});
    check_same_bytes((struct wav_format){48000, 1, -64, "t", "c", 0});
    check_same_bytes((struct wav_format){48000, 1, 24, "t", "c", 0});
    check_same_bytes((struct wav_format){48000, 1, -32, "t", "c", 1}); /* RF64 */
    check_same_bytes((struct wav_format){48000, 2, -64, "t", NULL, 100});
    unlink("a.wav");
    folder_leave();
}
END_TEST

/* Values that the encoding holds exactly come back exactly; written in pieces of changing length. */
static void check_round_trip(struct wav_format f)
{
    enum { FRAMES = 20011 };
    static double x[FRAMES * 3];
    struct err e = {0};
    struct wav r;
    struct arena *a = arena_open();
    uint32_t s = 1;
    for (size_t i = 0; i < FRAMES * 3; i++) {
        s = s * 1664525 + 1013904223;
        x[i] = f.bits == 16   ? (int16_t)(s >> 16) / 32768.0
               : f.bits == 24 ? ((int)(s >> 8) - 8388608) / 8388608.0
                              : (float)(s * 1e-9);
    }
    struct wav_out *w = wav_create("a.wav", &f, &e);
    ck_assert_msg(w != NULL, "%s", e.text);
    for (size_t at = 0, n = 1; at < FRAMES; at += n, n = 2 * n < FRAMES - at ? 2 * n : FRAMES - at)
        ck_assert_msg(wav_write(w, x + at * (size_t)f.channels, n, &e), "%s", e.text);
    ck_assert_msg(wav_commit(w, &e), "%s", e.text);
    ck_assert_msg(wav_read("a.wav", a, &r, &e), "%s", e.text);
    ck_assert_uint_eq(r.frames, FRAMES);
    ck_assert_int_eq(r.channels, f.channels);
    ck_assert_double_eq(r.rate, f.rate);
    ck_assert_int_eq(r.bits, f.bits > 0 ? f.bits : 0);
    ck_assert_mem_eq(r.x, x, FRAMES * (size_t)f.channels * sizeof *x);
    slurp("a.wav");
    bool outgrown = f.riff_bytes > 0 && FRAMES * f.channels * abs(f.bits) / 8 > f.riff_bytes;
    ck_assert_mem_eq(disk, outgrown ? "RF64" : "RIFF", 4);
    unlink("a.wav");
    arena_close(a);
}

START_TEST(round_trips)
{
    static const int bits[] = {16, 24, -32, -64};
    static const double limits[] = {0, 1, 100000};
    folder_enter();
    for (int k = 0; k < 4; k++)
        for (int channels = 1; channels <= 3; channels++)
            for (int l = 0; l < 3; l++)
                check_round_trip((struct wav_format){44100, channels, bits[k], "t", NULL, limits[l]});
    folder_leave();
}
END_TEST

static void check_write_error(int bits, double x, enum err_kind kind, const char *says)
{
    struct wav_format f = {.rate = 1000, .channels = 2, .bits = bits};
    double y[10000] = {0};
    struct err e = {0};
    struct wav_out *w = wav_create("a.wav", &f, &e);
    ck_assert_ptr_nonnull(w);
    ck_assert(wav_write(w, y, 100, &e));
    y[9001] = x;
    ck_assert(!wav_write(w, y, 5000, &e));
    ck_assert_int_eq(e.kind, kind);
    ck_assert_msg(strstr(e.text, says) && strstr(e.text, "frame 4600 (4.600000 s), channel 2"), "%s", e.text);
    wav_drop(w);
}

START_TEST(nothing_is_clipped)
{
    folder_enter();
    check_write_error(16, 2, ERR_SCENE, "+6.02 dB re full scale");
    check_write_error(24, 1, ERR_SCENE, "+0.00 dB");
    check_write_error(24, -1.0000001, ERR_SCENE, "beyond the range of 24-bit integers");
    check_write_error(-32, 1e39, ERR_SCENE, "too large");
    for (int bits = -64; bits <= 24; bits += bits < -32 ? 32 : bits < 0 ? 48 : 8) {
        check_write_error(bits, NAN, ERR_NUMBERS, "nan");
        check_write_error(bits, -INFINITY, ERR_NUMBERS, "-inf");
    }
    folder_leave();
}
END_TEST

static void check_create(const char *path, struct wav_format f, enum err_kind kind, const char *says)
{
    struct err e = {0};
    ck_assert_ptr_null(wav_create(path, &f, &e));
    ck_assert_int_eq(e.kind, kind);
    ck_assert_msg(strstr(e.text, says) != NULL, "%s", e.text);
}

START_TEST(create_refuses)
{
    folder_enter();
    check_create("no/a.wav", (struct wav_format){.rate = 48000, .channels = 1, .bits = 16}, ERR_CREATE,
                 "folder does not exist");
    check_create("/tmp", (struct wav_format){.rate = 48000, .channels = 1, .bits = 16}, ERR_CREATE, "is a folder");
    check_create("a.wav", (struct wav_format){.rate = 48000, .channels = 1, .bits = 20}, ERR_SCENE, "20 bits");
    check_create("a.wav", (struct wav_format){.rate = 48000.5, .channels = 1, .bits = 16}, ERR_SCENE,
                 "whole number of Hz");
    check_create("a.wav", (struct wav_format){.rate = NAN, .channels = 1, .bits = 16}, ERR_SCENE, "whole number of Hz");
    check_create("a.wav", (struct wav_format){.rate = 48000, .channels = 0, .bits = 16}, ERR_SCENE, "channels");
    wav_drop(NULL);
    folder_leave();
}
END_TEST

static void check_full(double riff_bytes)
{
    static double x[10000];
    struct wav_format f = {48000, 1, 24, "t", "c", riff_bytes};
    struct rlimit small = {.rlim_cur = 10000, .rlim_max = RLIM_INFINITY}, whole = {RLIM_INFINITY, RLIM_INFINITY};
    struct err e = {0};
    struct wav_out *w = wav_create("a.wav", &f, &e);
    ck_assert(w && wav_write(w, x, 2000, &e));
    signal(SIGXFSZ, SIG_IGN);
    ck_assert_int_eq(setrlimit(RLIMIT_FSIZE, &small), 0);
    bool ok = wav_write(w, x, 10000, &e);
    setrlimit(RLIMIT_FSIZE, &whole);
    ck_assert(!ok);
    ck_assert_int_eq(e.kind, ERR_IO);
    ck_assert_msg(strstr(e.text, "a.wav: cannot be written: File too large"), "%s", e.text);
    wav_drop(w);
}

START_TEST(full_disk)
{
    folder_enter();
    check_full(0);
    check_full(8000); /* in the middle of going over to RF64 */
    folder_leave();
}
END_TEST

static void check_read(const char *path, enum err_kind kind, const char *says)
{
    struct err e = {0};
    struct wav w;
    struct arena *a = arena_open();
    ck_assert(!wav_read(path, a, &w, &e));
    ck_assert_msg(e.kind == kind && strstr(e.text, says) && strstr(e.text, path), "%d %s", e.kind, e.text);
    arena_close(a);
}

START_TEST(read_refuses)
{
    static const double x[1000] = {0.5};
    const float bad[2] = {NAN, INFINITY};
    folder_enter();
    check_read("none.wav", ERR_INPUT, "No such file");
    check_read("/tmp", ERR_INPUT, "is not a file");
    spill("a.wav", 0);
    check_read("a.wav", ERR_SCENE, "not a sound file");
    memcpy(disk, "RIFF\xff\xff\xff\xffWAVEfmt \xff\xff\xff\x7f", 20);
    spill("a.wav", 20);
    check_read("a.wav", ERR_SCENE, "a.wav");
    put("a.wav", (struct wav_format){.rate = 48000, .channels = 1, .bits = 16}, x, 0);
    check_read("a.wav", ERR_SCENE, "no samples");
    put("a.wav", (struct wav_format){48000, 2, 24, "title", NULL, 0}, x, 500);
    size_t n = slurp("a.wav");
    spill("a.wav", n - 1);
    check_read("a.wav", ERR_SCENE, "truncated: its last 1 bytes");
    spill("a.wav", 300);
    check_read("a.wav", ERR_SCENE, "truncated");
    put("a.wav", (struct wav_format){48000, 2, 24, NULL, NULL, 1}, x, 500);
    n = slurp("a.wav");
    spill("a.wav", n - 6);
    check_read("a.wav", ERR_SCENE, "truncated");
    put("a.wav", (struct wav_format){48000, 2, -32, NULL, NULL, 0}, x, 500);
    n = slurp("a.wav");
    memcpy(disk + chunk("data", n) + 4 * 41, &bad[0], 4);
    spill("a.wav", n);
    check_read("a.wav", ERR_SCENE, "frame 20, channel 2: nan is not finite");
    unlink("a.wav");
    folder_leave();
}
END_TEST

START_TEST(drop_leaves_nothing)
{
    struct wav_format f = {.rate = 48000, .channels = 1, .bits = -32};
    struct err e = {0};
    double x[100] = {0};
    folder_enter();
    struct wav_out *w = wav_create("a.wav", &f, &e);
    ck_assert(w && wav_write(w, x, 100, &e));
    wav_drop(w);
    folder_leave();
}
END_TEST

UNIT("wav", layout_of_plain_pcm, rounds_to_nearest_even, title_comment_and_no_peak, same_bytes_a_second_later,
     round_trips, nothing_is_clipped, create_refuses, full_disk, read_refuses, drop_leaves_nothing)
