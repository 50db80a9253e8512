/* Sounds of several channels and their stems, from samples to WAVs; the level rules of one channel are in
 * test_render.c. */
#include "num/noise.h"
#include "output/sound.h"
#include "output/stems.h"
#include "renders.h"

static const double places[15] = {0, 0, 1, 1, 0, 1, 2, 0, 1, 3, 0, 1, 4, 0, 1};

/* A scene whose sound has so many listening places, as floating point, unscaled. */
static struct scene scene_of(int n, int encoding)
{
    struct scene s = {
        .output = {
            .sample_rate = 48000, .encoding = encoding, .channels = 1, .level = {NAN, NAN, NAN, NAN, NAN, false}}};
    if (n > 1) s.output.listen = (struct listen){true, RADIATOR_POINT, places, n, 1.2, 343};
    return s;
}

/* What sounds at a frame of a channel: other noise on each, louder from channel to channel. */
static double noise_at(long n, int channel)
{
    return (channel + 1) * (noise_uniform(noise_make(5, "sound"), (uint64_t)n, (uint32_t)channel) - 0.5);
}

/* Brings in `frames` frames in uneven pieces, and ends. */
static struct sound_report sounded(struct arena *a, const struct scene *s, const char *name, long frames,
                                   double (*at)(long, int))
{
    struct err e = {0};
    struct sound_report r;
    int places_n = s->output.listen.given ? s->output.listen.n_places : 1;
    struct sound *o = sound_open(s, folder_path(name), frames, a, &e);
    double *x = ARENA_TAKE(a, double, 1024 * places_n);
    ck_assert_msg(o != NULL, "%s", e.text);
    for (long n = 0, some; n < frames; n += some) {
        some = 1 + (n * 7919 + 511) % 1024;
        some = some < frames - n ? some : frames - n;
        for (long i = 0; i < some; i++)
            for (int k = 0; k < places_n; k++)
                x[i * places_n + k] = at(n + i, k);
        ck_assert_msg(sound_add(o, x, some, &e), "%s", e.text);
    }
    ck_assert_msg(sound_finish(o, &r, &e) && track_commit(sound_track(o), &e), "%s", e.text);
    sound_drop(o);
    return r;
}

/* Three channels, each its own sound, by full scale and by a gain found afterwards: every sample in its place, ramped
   alike; peak, rms and each channel's as counted here. */
START_TEST(each_place_is_a_channel)
{
    struct arena *a = folder_make();
    long frames = 9000;
    for (int known = 0; known < 2; known++) {
        struct scene s = scene_of(3, ENCODING_FLOAT64);
        double peak[3] = {0}, squares[3] = {0}, most = 0;
        s.output.ramp = 0.01;
        s.output.level.full_scale = known ? 4 : NAN;
        struct sound_report r = sounded(a, &s, "three.wav", frames, noise_at);
        struct wav w = renders_sound("three.wav");
        ck_assert_int_eq(w.channels, 3);
        ck_assert_uint_eq(w.frames, (size_t)frames);
        for (long n = 0; n < frames; n++)
            for (int k = 0; k < 3; k++) {
                long edge = n < frames - 1 - n ? n : frames - 1 - n;
                double ramp = edge < 480 ? pow(sin(M_PI / 2 * ((double)edge + 0.5) / 480), 2) : 1,
                       want = noise_at(n, k) * ramp;
                ck_assert_double_eq_tol(w.x[3 * n + k], r.gain * want, 1e-15);
                peak[k] = fmax(peak[k], fabs(want));
                squares[k] += want * want;
            }
        for (int k = 0; k < 3; k++) {
            ck_assert_double_eq_tol(r.channel_peak[k], peak[k], 1e-15);
            ck_assert_double_eq_tol(r.channel_rms[k], sqrt(squares[k] / (double)frames), 1e-13);
            most = fmax(most, peak[k]);
        }
        ck_assert_int_eq(r.channels, 3);
        ck_assert_double_eq_tol(r.peak, most, 1e-15);
        ck_assert_double_eq_tol(r.rms, sqrt((squares[0] + squares[1] + squares[2]) / (3.0 * (double)frames)), 1e-13);
        ck_assert_double_eq_tol(r.gain, known ? 0.25 : pow(10, -3 / 20.0) / most, 1e-15);
    }
    folder_remove();
}
END_TEST

static double tone_at(long n, int channel)
{
    (void)channel;
    return 1e-3 * sin(2 * M_PI * 997 / 48000 * (double)n);
}

/* BS.1770: K-weighting is +0.691 dB at 997 Hz, which the formula takes off again, so a tone's loudness is 10 log10 of
   the sum of its channels' mean squares: one channel counts twice (two ears), of more each once, surrounds too (a
   layout's would count 1.41). */
START_TEST(loudness_counts_channels)
{
    static const int counts[] = {1, 2, 5};
    struct arena *a = folder_make();
    for (int k = 0; k < 3; k++) {
        struct scene s = scene_of(counts[k], ENCODING_FLOAT64);
        s.output.level.lufs = -23;
        struct sound_report r = sounded(a, &s, "tone.wav", 96000, tone_at);
        double each = 20 * log10(r.gain * r.rms), whole = each + 10 * log10(counts[k] == 1 ? 2 : counts[k]);
        printf("%d channels: %.4f dB each, %.4f dB together\n", counts[k], each, whole);
        ck_assert_double_eq_tol(whole, -23, 0.02);
    }
    folder_remove();
}
END_TEST

/* 1 Pa is -20 dB of full scale: a tenth, and the WAV says so. */
START_TEST(pascals_have_a_level)
{
    struct arena *a = folder_make();
    struct scene s = scene_of(2, ENCODING_FLOAT64);
    s.output.listen.radiator = RADIATOR_MONOPOLE;
    s.output.level.dbfs_at_1_pa = -20;
    struct sound_report r = sounded(a, &s, "pascals.wav", 500, noise_at);
    struct wav w = renders_sound("pascals.wav");
    char text[80];
    ck_assert_double_eq_tol(r.gain, 0.1, 1e-16);
    ck_assert_double_eq_tol(w.x[2 * 77 + 1], 0.1 * noise_at(77, 1), 1e-16);
    sound_comment(&s, r.gain, text);
    ck_assert_str_eq(text, "rasp: gain 0.1 per Pa (-20.0000 dB)");
    folder_remove();
}
END_TEST

/* One place may be copied to several channels; several places may not be. */
START_TEST(copies_are_of_one_place)
{
    struct arena *a = folder_make();
    struct err e = {0};
    struct scene one = scene_of(1, ENCODING_FLOAT64), two = scene_of(2, ENCODING_FLOAT64);
    one.output.channels = two.output.channels = 3;
    sounded(a, &one, "copies.wav", 5000, noise_at);
    struct wav w = renders_sound("copies.wav");
    ck_assert_int_eq(w.channels, 3);
    for (size_t n = 0; n < 5000; n++)
        ck_assert(w.x[3 * n] == w.x[3 * n + 1] && w.x[3 * n] == w.x[3 * n + 2] && w.x[3 * n] != 0);
    ck_assert_ptr_null(sound_open(&two, folder_path("no.wav"), 10, a, &e));
    ck_assert_msg(strstr(e.text, "leave output.channels out") != NULL, "%s", e.text);
    folder_remove();
}
END_TEST

static const char *const all_stems[] = {"force", "surface", "scraper", NULL};

/* Renders a sound of two parts, the second -0.75 of the first, and a force of 100 N, with the stems. */
static bool stemmed(struct arena *a, const struct scene *s, long frames, struct err *e)
{
    const char *const paths[STEMS] = {folder_path("x.force.wav"), folder_path("x.surface.wav"),
                                      folder_path("x.scraper.wav")};
    struct sound *o = sound_open(s, folder_path("x.wav"), frames, a, e);
    struct stems *p = stems_open(s, paths, frames, a, e);
    struct sound_report r;
    int width = stems_channels(&s->output, STEM_SURFACE);
    ck_assert_msg(o && p, "%s", e->text);
    for (long n = 0; n < frames; n++) {
        double force = 100 + noise_at(n, 0), x[2], y[2], sum[2];
        for (int k = 0; k < width; k++) {
            x[k] = noise_at(n, k);
            y[k] = -0.75 * x[k];
            sum[k] = x[k] + y[k];
        }
        ck_assert_msg(stems_add(p, STEM_FORCE, &force, 1, e) && stems_add(p, STEM_SURFACE, x, 1, e) &&
                          stems_add(p, STEM_SCRAPER, y, 1, e) && sound_add(o, sum, 1, e),
                      "%s", e->text);
    }
    bool ok = sound_finish(o, &r, e) && stems_finish(p, r.gain, e) && track_commit(sound_track(o), e);
    for (int k = 0; k < STEMS && ok; k++)
        ok = !stems_asked(&s->output, (enum stem)k) || track_commit(stems_track(p, (enum stem)k), e);
    sound_drop(o);
    stems_drop(p);
    return ok;
}

/* Surface and scraper have the sound's gain, ramps and channels, so that they sum to it; the force is in newtons, of
   one channel, as floating point whatever the sound is, without ramps. Of a level that is known at once, and of one
   that is found. */
START_TEST(stems_sum_to_the_sound)
{
    struct arena *a = folder_make();
    struct err e = {0};
    for (int known = 0; known < 2; known++) {
        struct scene s = scene_of(2, ENCODING_PCM24);
        s.output.stems = (const char **)all_stems;
        s.output.ramp = 0.01;
        s.output.level.full_scale = known ? 2 : NAN;
        s.output.level.peak = known ? NAN : -20;
        ck_assert_msg(stemmed(a, &s, 3000, &e), "%s", e.text);
        struct wav sum = renders_sound("x.wav"), force = renders_sound("x.force.wav"),
                   x = renders_sound("x.surface.wav"), y = renders_sound("x.scraper.wav");
        ck_assert(sum.channels == 2 && x.channels == 2 && y.channels == 2 && force.channels == 1);
        ck_assert(sum.bits == 24 && x.bits == 24 && y.bits == 24 && force.bits == 0);
        for (size_t n = 0; n < 6000; n++)
            ck_assert_double_eq_tol(x.x[n] + y.x[n], sum.x[n],
                                    1.5 * ldexp(1, -23)); /* each is rounded to half a step */
        for (size_t n = 0; n < 3000; n++)
            ck_assert(force.x[n] == (float)(100 + noise_at((long)n, 0)));
        ck_assert_double_gt(fabs(x.x[3001]), 3 * fabs(sum.x[3001]));
    }
    folder_remove();
}
END_TEST

/* A part that is louder than the whole is not clipped: the sound peaks at -3 dBFS, its surface four times higher. */
START_TEST(a_stem_that_clips_is_refused)
{
    struct arena *a = folder_make();
    struct err e = {0};
    struct scene s = scene_of(1, ENCODING_PCM16);
    s.output.stems = (const char **)all_stems;
    ck_assert(!stemmed(a, &s, 3000, &e));
    ck_assert_int_eq(e.kind, ERR_SCENE);
    ck_assert_msg(strstr(e.text, "output.stems") && strstr(e.text, "x.surface.wav") && strstr(e.text, "float32"), "%s",
                  e.text);
    ck_assert_int_eq(system(arena_format(a, "test -z \"$(ls -A %s)\"", folder_name)), 0);
    s.output.encoding = ENCODING_FLOAT32;
    e = (struct err){0};
    ck_assert_msg(stemmed(a, &s, 3000, &e), "%s", e.text);
    folder_remove();
}
END_TEST

static double one(long n, int channel)
{
    (void)n, (void)channel;
    return 1;
}

/* Where a source is that passes at constant speed: its least distance is 1, its way from -x to x, with 1 over the
   farthest distance `depth` dB down. The sound of it, and a stem of a body likewise, goes with 1 over that distance;
   the force keeps what it is. */
START_TEST(an_envelope_comes_and_goes)
{
    struct arena *a = folder_make();
    struct err e = {0};
    static const double depths[] = {20, 6, 0};
    for (int i = 0; i < 3; i++) {
        struct scene s = scene_of(2, ENCODING_FLOAT64);
        double far = pow(10, depths[i] / 20), x = sqrt(far * far - 1);
        s.output.level.full_scale = 1;
        s.output.envelope = ENVELOPE_APPROACH_RECEDE;
        s.output.envelope_depth = depths[i];
        struct sound_report r = sounded(a, &s, "passes.wav", 4001, one);
        struct wav w = renders_sound("passes.wav");
        for (long n = 0; n < 4001; n++)
            for (int k = 0; k < 2; k++)
                ck_assert_double_eq_tol(w.x[2 * n + k], 1 / hypot(1, x * (((double)n + 0.5) / 4001 * 2 - 1)), 1e-14);
        ck_assert_double_eq(w.x[4000], 1);                             /* the middle one */
        ck_assert_double_eq_tol(20 * log10(w.x[0]), -depths[i], 0.01); /* half a frame inside */
        ck_assert_double_eq(r.peak, 1);
        s.output.stems = (const char **)all_stems;
        ck_assert_msg(stemmed(a, &s, 3000, &e), "%s", e.text);
        struct wav force = renders_sound("x.force.wav"), surface = renders_sound("x.surface.wav");
        ck_assert_double_eq_tol(surface.x[0] / noise_at(0, 0), w.x[0], 1e-3);
        ck_assert(force.x[0] == (float)(100 + noise_at(0, 0)));
    }
    folder_remove();
}
END_TEST

UNIT("sound", each_place_is_a_channel, loudness_counts_channels, pascals_have_a_level, copies_are_of_one_place,
     stems_sum_to_the_sound, a_stem_that_clips_is_refused, an_envelope_comes_and_goes)
