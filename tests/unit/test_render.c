/* From a scene's text to the samples in its WAV. */
#include "file/csv.h"
#include "pipeline/stages.h"
#include "renders.h"

/* The folder, with a bell in it. */
static struct arena *setup(void)
{
    struct arena *a = folder_make();
    folder_write(
        "bell.csv",
        "# poles: shared\n# quantity: velocity\n# normalisation: physical\n# source: test\n"
        "place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad\n"
        "left,0,0,low,1234.5,17.25,2,1.5607963267948966\nright,0.1,0,low,1234.5,17.25,-1,1.5607963267948966\n");
    return a;
}

#define BODY "surface: {roughness: {rms: 5 um}, response: bell.csv}\nscraper: {mass: 20 g}\n"
#define LINE "motion: {path: line, to: [2 cm, 0], speed: 20 cm/s}\n"
#define EXACT "output: {encoding: float64, level: {full_scale: 1}, ramp: 0, tail: 0.6 s}\n"

/* After the force has ended the WAV holds the free decay of the table's one mode: two-sample linear prediction by least
   squares gives its frequency and T60 to 1e-4 (in fact to 1e-9). */
START_TEST(free_decay_is_the_tables)
{
    setup();
    renders_made("rasp: 1\n" BODY LINE EXACT, "decay");
    struct wav w = renders_sound("decay.wav");
    double s11 = 0, s12 = 0, s22 = 0, r1 = 0, r2 = 0, rate = 48000;
    size_t first = (size_t)(0.11 * rate);
    ck_assert_uint_gt(w.frames, first + 20000);
    for (size_t n = first; n < first + 20000; n++) {
        double y = w.x[n], y1 = w.x[n - 1], y2 = w.x[n - 2];
        s11 += y1 * y1, s12 += y1 * y2, s22 += y2 * y2, r1 += y * y1, r2 += y * y2;
    }
    double det = s11 * s22 - s12 * s12, c1 = (r1 * s22 - r2 * s12) / det, c2 = (s11 * r2 - s12 * r1) / det;
    double radius = sqrt(-c2), frequency = acos(c1 / (2 * radius)) / (2 * M_PI) * rate, decay = -log(radius) * rate;
    printf("frequency %.9g Hz, T60 %.9g s (table: %.9g s)\n", frequency, 3 * log(10) / decay, 3 * log(10) / 17.25);
    ck_assert_double_eq_tol(frequency / 1234.5, 1, 1e-4);
    ck_assert_double_eq_tol(decay / 17.25, 1, 1e-4);
    folder_remove();
}
END_TEST

/* Contacts add: two at once, the second later and louder, are the sum of each alone, sample by sample. */
START_TEST(contacts_add)
{
    struct arena *a = setup();
    const char *one = "surface: {roughness: {rms: 5 um}, response: bell.csv}, scraper: {mass: 20 g}, motion: {path: "
                      "line, to: [2 cm, 0], speed: 0.2}";
    const char *two = "surface: {roughness: {rms: 9 um}, response: bell.csv}, scraper: {mass: 5 g}, motion: {path: "
                      "line, from: [9 cm, 0], to: [3 cm, 0], speed: 0.3}";
    renders_made(arena_format(a,
                              "rasp: 1\naccuracy: {oversampling: 4, gain_ramp: 64}\ncontacts:\n  - {name: a, %s}\n  - "
                              "{name: b, start: 50 ms, gain: 3, %s}\n" EXACT,
                              one, two),
                 "both");
    renders_made(
        arena_format(a, "rasp: 1\naccuracy: {oversampling: 4, gain_ramp: 64}\ncontacts:\n  - {name: a, %s}\n" EXACT,
                     one),
        "first");
    renders_made(
        arena_format(a, "rasp: 1\naccuracy: {oversampling: 4, gain_ramp: 64}\ncontacts:\n  - {name: b, %s}\n" EXACT,
                     two),
        "second");
    struct wav both = renders_sound("both.wav"), first = renders_sound("first.wav"),
               second = renders_sound("second.wav");
    for (size_t n = 0; n < first.frames; n++) {
        double want = first.x[n] + (n >= 2400 && n - 2400 < second.frames ? 3 * second.x[n - 2400] : 0);
        ck_assert_double_eq_tol(both.x[n], want, 1e-15);
    }
    ck_assert(second.x[3000] != 0);
    folder_remove();
}
END_TEST

/* A contact begins at the nearest sample: 0.29 s x 48 kHz is 13919.999999999998 in binary, and is 13920; the table says
 * so too. */
START_TEST(a_start_is_rounded_to_the_nearest_sample)
{
    struct arena *a = setup();
    struct csv t;
    struct err e = {0};
    double first;
    const char *scene = "rasp: 1\nstart: %s\n" BODY LINE
                        "output: {encoding: float64, level: {full_scale: 1}, ramp: 0, tail: 0.1 s, diagnostics: {}}\n";
    renders_made(arena_format(a, scene, "0 s"), "now");
    renders_made(arena_format(a, scene, "0.29 s"), "later");
    renders_made(arena_format(a, scene, "0.290009 s"), "between"); /* 13920.43 samples */
    struct wav now = renders_sound("now.wav"), later = renders_sound("later.wav");
    ck_assert_uint_eq(later.frames, now.frames + 13920);
    for (size_t n = 0; n < later.frames; n++)
        ck_assert_double_eq_tol(later.x[n], n < 13920 ? 0 : now.x[n - 13920],
                                1e-15); /* of 5e-5: blocks begin elsewhere */
    ck_assert_msg(csv_read(folder_path("between.csv"), a, &t, &e) &&
                      csv_number(&t, 0, csv_column(&t, "time_s"), &first, &e),
                  "%s", e.text);
    ck_assert_double_eq_tol(first, 0.29, 1e-9);
    folder_remove();
}
END_TEST

/* Contacts alike in everything but their names scrape over different roughness of the same recipe: their forces (rows
   of 1 kHz) are as loud, and correlate no more than 100 rows of independent noise do (0.1; the bound is 4 standard
   deviations). */
START_TEST(names_make_the_noise)
{
    struct arena *a = setup();
    const char *one = "surface: {roughness: {rms: 5 um, longest: 0.2 mm}}, scraper: {mass: 20 g}, motion: {path: line, "
                      "to: [2 cm, 0], speed: 0.2}";
    const char *const tables[] = {"pair.a.csv", "pair.b.csv"};
    double f[2][100], products[2][2] = {{0}};
    struct err e = {0};
    renders_made(arena_format(a,
                              "rasp: 1\ncontacts:\n  - {name: a, %s}\n  - {name: b, %s}\noutput: {diagnostics: {}}\n",
                              one, one),
                 "pair");
    for (int k = 0; k < 2; k++) {
        struct csv t;
        ck_assert_msg(csv_read(folder_path(tables[k]), a, &t, &e), "%s", e.text);
        ck_assert_uint_eq(t.rows, 100);
        for (size_t row = 0; row < t.rows; row++)
            ck_assert_msg(csv_number(&t, row, csv_column(&t, "force_peak_n"), &f[k][row], &e), "%s", e.text);
    }
    for (int n = 0; n < 100; n++)
        for (int i = 0; i < 2; i++)
            for (int k = 0; k < 2; k++)
                products[i][k] += f[i][n] * f[k][n];
    double alike = products[0][1] / sqrt(products[0][0] * products[1][1]);
    printf("energies %.3g and %.3g N^2, correlation %.3g\n", products[0][0], products[1][1], alike);
    ck_assert_double_lt(fabs(alike), 0.4);
    ck_assert_double_lt(fabs(log(products[0][0] / products[1][1])), log(2));
    folder_remove();
}
END_TEST

/* Metres per second and metres per second squared are not added. */
START_TEST(quantities_are_not_mixed)
{
    struct arena *a = setup();
    struct scene s;
    struct err e = {0};
    struct render_report report;
    const char *messages, *body = "surface: {roughness: {}, response: %s.csv}, scraper: {mass: 20 g}, motion: {path: "
                                  "line, to: [2 cm, 0], speed: 0.2}";
    folder_write("gong.csv", "# poles: shared\n# quantity: acceleration\n# normalisation: physical\n# source: test\n"
                             "place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad\nonly,0,0,low,997,9,2,0\n");
    const char *text = arena_format(a, "rasp: 1\ncontacts:\n  - {name: a, %s}\n  - {name: b, %s}\n",
                                    arena_format(a, body, "bell"), arena_format(a, body, "gong"));
    ck_assert(scene_read_text(text, strlen(text), folder_path("scene.yaml"), &(struct scene_overrides){0}, a, &s,
                              &messages, &e));
    ck_assert(!render_scene(&s, folder_path("mixed"), a, &report, &e));
    ck_assert_int_eq(e.kind, ERR_SCENE);
    ck_assert_msg(strstr(e.text, "contact 'b' gives acceleration, but contact 'a' velocity") != NULL, "%s", e.text);
    folder_remove();
}
END_TEST

/* The WAV is as long with diagnostics as without, when the contact that lasts longest is muted. */
START_TEST(a_muted_contact_lasts_as_long)
{
    struct arena *a = setup();
    const char *scene = "rasp: 1\ncontacts:\n  - {name: a, surface: {roughness: {}, response: bell.csv}, scraper: "
                        "{mass: 20 g}, motion: {path: line, to: [2 cm, 0], "
                        "speed: 0.2}}\n  - {name: b, gain: 0, start: 0.1 s, surface: {roughness: {}, response: "
                        "bell.csv}, scraper: {mass: 20 g}, motion: {path: line, "
                        "to: [4 cm, 0], speed: 0.2}}\noutput: {tail: 0 s, encoding: float64%s}\n";
    ck_assert_int_eq(renders_made(arena_format(a, scene, ""), "muted").frames, 14401);
    ck_assert_int_eq(renders_made(arena_format(a, scene, ", diagnostics: {}"), "watched").frames, 14401);
    folder_remove();
}
END_TEST

/* rms of the difference over rms. */
static double apart(const struct wav *x, const struct wav *y)
{
    double off = 0, all = 0;
    ck_assert_uint_eq(x->frames, y->frames);
    for (size_t n = 0; n < x->frames; n++) {
        off += (x->x[n] - y->x[n]) * (x->x[n] - y->x[n]);
        all += x->x[n] * x->x[n];
    }
    return sqrt(off / all);
}

/* Two engines that share no arithmetic, gains moving across a nodal line: ramps of 64 samples and cubic nodes every ms
   are each within 2e-4 of gains at every sample (measured: 9e-5, 2e-8); a hop or most of a ramp early or late is more.
 */
START_TEST(engines_agree_on_a_moving_contact)
{
    struct arena *a = setup();
    const char *scene =
        "rasp: 1\nsurface: {roughness: {rms: 5 um}, response: bell.csv, convolution: %s}\nscraper: {mass: 20 g}\n"
        "motion: {path: back_and_forth, from: [1 cm, 0], to: [9 cm, 0], rate: 4 Hz, duration: 0.25 s}\n"
        "accuracy: {gain_ramp: %d}\n" EXACT;
    renders_made(arena_format(a, scene, "resonators", 1), "exact");
    renders_made(arena_format(a, scene, "resonators", 64), "ramps");
    renders_made(arena_format(a, scene, "overlap_add", 64), "nodes");
    struct wav exact = renders_sound("exact.wav"), ramps = renders_sound("ramps.wav"),
               nodes = renders_sound("nodes.wav");
    printf("ramps %.3g, nodes %.3g apart\n", apart(&exact, &ramps), apart(&exact, &nodes));
    ck_assert_double_lt(apart(&exact, &ramps), 2e-4);
    ck_assert_double_lt(apart(&exact, &nodes), 2e-4);
    folder_remove();
}
END_TEST

/* The total is the surface's sound plus eta times the scraper's, by either engine. */
START_TEST(the_scraper_rings_with_weight_eta)
{
    struct arena *a = setup();
    const char *scene = "rasp: 1\nsurface: {roughness: {rms: 5 um}%s}\nscraper: {mass: 20 g%s}\n" LINE EXACT;
    const char *const engines[] = {"resonators", "overlap_add"};
    renders_made(arena_format(a, scene, ", response: bell.csv", ""), "surface");
    struct wav surface = renders_sound("surface.wav");
    for (int k = 0; k < 2; k++) {
        renders_made(
            arena_format(a, scene, "", arena_format(a, ", response: bell.csv, weight: 1, convolution: %s", engines[k])),
            "scraper");
        renders_made(arena_format(a, scene, ", response: bell.csv",
                                  arena_format(a, ", response: bell.csv, weight: 0.25, convolution: %s", engines[k])),
                     "both");
        struct wav scraper = renders_sound("scraper.wav"), both = renders_sound("both.wav");
        for (size_t n = 0; n < both.frames; n++)
            scraper.x[n] = surface.x[n] + 0.25 * scraper.x[n];
        ck_assert_double_lt(apart(&both, &scraper), 1e-9);
    }
    folder_remove();
}
END_TEST

static void levels_of(const struct wav *w, double *peak, double *rms)
{
    *peak = *rms = 0;
    for (size_t n = 0; n < w->frames; n++) {
        *peak = fmax(*peak, fabs(w->x[n]));
        *rms += w->x[n] * w->x[n] / (double)w->frames;
    }
    *rms = sqrt(*rms);
}

/* The same of a scraper whose response is a WAV: half the weight is half the sound, also beside a surface. (WAV samples
   are multiples of 2^-k here, and so are the weights: nothing is rounded but by the sum.) */
START_TEST(a_wav_scraper_rings_with_weight_eta)
{
    struct arena *a = setup();
    const char *scene = "rasp: 1\nsurface: {roughness: {rms: 5 um}%s}\nscraper: {mass: 20 g%s}\n" LINE EXACT;
    const double h[] = {0.5, -0.25, 0.125, 0, 0.75, -0.5};
    struct err e = {0};
    struct wav_out *out = wav_create(folder_path("tap.wav"), &(struct wav_format){48000, 1, -64, NULL, NULL, 0}, &e);
    ck_assert_msg(out && wav_write(out, h, 6, &e) && wav_commit(out, &e), "%s", e.text);
    renders_made(arena_format(a, scene, ", response: tap.wav", ""), "surface");
    renders_made(arena_format(a, scene, "", ", response: tap.wav, weight: 1"), "whole");
    renders_made(arena_format(a, scene, "", ", response: tap.wav, weight: 0.5"), "half");
    renders_made(arena_format(a, scene, ", response: tap.wav", ", response: tap.wav, weight: 0.5"), "both");
    struct wav surface = renders_sound("surface.wav"), whole = renders_sound("whole.wav"),
               half = renders_sound("half.wav"), both = renders_sound("both.wav");
    ck_assert_double_lt(apart(&surface, &whole), 1e-12); /* the same response, on either body */
    for (size_t n = 0; n < whole.frames; n++) {
        whole.x[n] *= 0.5;
        surface.x[n] *= 1.5;
    }
    ck_assert_double_lt(apart(&half, &whole), 1e-12);
    ck_assert_double_lt(apart(&both, &surface), 1e-12);
    folder_remove();
}
END_TEST

/* Every level rule does what it says; all are the same sound times one gain, which the report gives. */
START_TEST(levels)
{
    static const char *const rules[] = {"",
                                        "level: {peak: -6 dB}",
                                        "level: {rms: -30 dB}",
                                        "level: {lufs: -25}",
                                        "level: {full_scale: 0.5}",
                                        "level: {peak: 0 dB}"};
    struct arena *a = setup();
    renders_made(
        "rasp: 1\n" BODY
        "motion: {path: line, to: [10 cm, 0], speed: 10 cm/s}\noutput: {encoding: float64, level: {full_scale: 1}}\n",
        "plain");
    struct wav plain = renders_sound("plain.wav");
    for (int k = 0; k < 6; k++) {
        double peak, rms;
        struct render_report r =
            renders_made(arena_format(a,
                                      "rasp: 1\n" BODY "motion: {path: line, to: [10 cm, 0], speed: 10 cm/s}\n"
                                      "output: {encoding: float64, %s}\n",
                                      rules[k]),
                         "scaled");
        struct wav w = renders_sound("scaled.wav");
        levels_of(&w, &peak, &rms);
        const double want[] = {20 * log10(peak) + 3, 20 * log10(peak) + 6, 20 * log10(rms) + 30, 0,
                               r.sound.gain - 2,     20 * log10(peak)};
        printf("%s: peak %.4f dB, rms %.4f dB, gain %.6g\n", rules[k], 20 * log10(peak), 20 * log10(rms), r.sound.gain);
        ck_assert_double_eq_tol(want[k], 0, 1e-9);
        ck_assert_uint_eq(w.frames, plain.frames);
        for (size_t n = 0; n < w.frames; n++)
            ck_assert_double_eq_tol(w.x[n], r.sound.gain * plain.x[n], 1e-14 * peak);
    }
    folder_remove();
}
END_TEST

/* BS.1770: a stationary 1 kHz-like tone's loudness on both ears is its rms in dB, K-weighting being +0.7 dB there less
   the formula's 0.691: a bell of one endless 997 Hz mode, rung by noise for 50 ms, is that but for the noise itself:
   0.02 dB of the 20 s. */
START_TEST(loudness_is_the_standards)
{
    setup();
    double peak, rms;
    folder_write(
        "bell.csv",
        "# poles: shared\n# quantity: velocity\n# normalisation: physical\n# source: test\n"
        "place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad\nonly,0,0,low,997,0,2,1.5707963267948966\n");
    renders_made("rasp: 1\n" BODY "motion: {path: line, to: [1 cm, 0], speed: 20 cm/s}\noutput: {encoding: float64, "
                 "level: {lufs: -23}, tail: 20 s}\n",
                 "tone");
    struct wav w = renders_sound("tone.wav");
    w.frames -= 24000, w.x += 12000;
    levels_of(&w, &peak, &rms);
    printf("rms %.4f dB at -23 LUFS, tone\n", 20 * log10(rms));
    ck_assert_double_eq_tol(20 * log10(rms) + 3.0103, -23, 0.05); /* two ears: + 3.01 dB */
    folder_remove();
}
END_TEST

/* Ramps: the same sound but for sin^2 edges; integers are the doubles rounded; the table has a row per millisecond. */
START_TEST(edges_and_encodings)
{
    struct arena *a = setup();
    const char *scene =
        "rasp: 1\n" BODY LINE
        "output: {encoding: %s, level: {full_scale: 0.01}, ramp: %s, tail: 0.1 s, channels: %d, diagnostics: {}}\n";
    renders_made(arena_format(a, scene, "float64", "0", 1), "plain");
    renders_made(arena_format(a, scene, "float64", "20 ms", 1), "ramped");
    renders_made(arena_format(a, scene, "pcm16", "0", 2), "integer");
    struct wav plain = renders_sound("plain.wav"), ramped = renders_sound("ramped.wav"),
               integer = renders_sound("integer.wav");
    ck_assert_int_eq(integer.channels, 2);
    for (size_t n = 0; n < plain.frames; n++) {
        size_t edge = n < plain.frames - 1 - n ? n : plain.frames - 1 - n;
        double s = edge < 960 ? sin(M_PI / 2 * ((double)edge + 0.5) / 960) : 1;
        ck_assert_double_eq_tol(ramped.x[n], plain.x[n] * s * s, 1e-15);
        ck_assert_double_eq(integer.x[2 * n], rint(plain.x[n] * 32768) / 32768);
        ck_assert_double_eq(integer.x[2 * n + 1], integer.x[2 * n]);
    }
    struct csv t;
    struct err e = {0};
    ck_assert_msg(csv_read(folder_path("plain.csv"), a, &t, &e), "%s", e.text);
    ck_assert_uint_eq(t.rows, 100);
    folder_remove();
}
END_TEST

/* A failure leaves nothing: here clipping, known only at the end. */
START_TEST(a_failure_leaves_nothing)
{
    struct arena *a = setup();
    struct scene s;
    struct err e = {0};
    const char *messages, *text = "rasp: 1\n" BODY LINE "output: {level: {full_scale: 1e-9}, diagnostics: {}}\n";
    struct render_report report;
    ck_assert(scene_read_text(text, strlen(text), folder_path("scene.yaml"), &(struct scene_overrides){0}, a, &s,
                              &messages, &e));
    ck_assert(!render_scene(&s, folder_path("clips"), a, &report, &e));
    ck_assert_int_eq(e.kind, ERR_SCENE);
    ck_assert_int_eq(system(arena_format(a, "test \"$(ls -A %s)\" = bell.csv", folder_name)), 0);
    folder_remove();
}
END_TEST

/* Its middle is 5 cm right of the scene's origin. */
#define PANE                                                                                                           \
    "surface: {roughness: {rms: 5 um}, material: glass, object: {shape: plate, edges: supported, length: 30 cm, "      \
    "width: 20 cm, thickness: 3 mm, origin: [-10 cm, -10 cm]}}\n"                                                      \
    "scraper: {mass: 20 g}\n"

static const struct render_file *stem_file(const struct render_report *r, const char *stem)
{
    for (int i = 0; i < r->n_files; i++)
        if (strcmp(r->files[i].kind, "stem") == 0 && strcmp(r->files[i].stem, stem) == 0) return &r->files[i];
    return NULL;
}

/* Stems of two contacts, one later and with a gain: surface and scraper sum to the sound; the force, without the gain,
   has the peaks of the tables of diagnostics, which are found on another way (rows of 48 samples, %.9g; the WAV holds
   24 bits). */
START_TEST(stems_are_the_parts)
{
    struct arena *a = setup();
    struct err e = {0};
    const char *one = "surface: {roughness: {rms: 5 um}, response: bell.csv}, scraper: {mass: 20 g, response: "
                      "bell.csv, weight: 0.25}, motion: {path: line, to: [2 cm, 0], speed: 0.2}";
    const char *text = arena_format(a,
                                    "rasp: 1\ncontacts:\n  - {name: a, %s}\n  - {name: b, start: 0.2 s, gain: 3, "
                                    "%s}\noutput: {encoding: float64, level: {full_scale: 1}, tail: 0.1 s, "
                                    "diagnostics: {}%s}\n",
                                    one, one, ", stems: [scraper, force, surface]");
    struct render_report r = renders_made(text, "all");
    struct wav sum = renders_sound("all.wav"), surface = renders_sound("all.surface.wav"),
               scraper = renders_sound("all.scraper.wav"), force = renders_sound("all.force.wav");
    double most = 0;
    ck_assert_uint_eq(force.frames, sum.frames);
    for (size_t n = 0; n < sum.frames; n++)
        most = fmax(most, fabs(sum.x[n]));
    for (size_t n = 0; n < sum.frames; n++)
        ck_assert_double_eq_tol(surface.x[n] + scraper.x[n], sum.x[n], 1e-15 * most);
    ck_assert_double_eq_tol(scraper.x[3000], 0.25 * surface.x[3000], 1e-2 * most); /* still the same place, nearly */
    for (int k = 0; k < 2; k++) {
        struct csv t;
        double want, is;
        ck_assert_msg(csv_read(folder_path(k ? "all.b.csv" : "all.a.csv"), a, &t, &e), "%s", e.text);
        for (size_t row = 5; row < 95; row++) {
            ck_assert_msg(csv_number(&t, row, csv_column(&t, "force_peak_n"), &want, &e), "%s", e.text);
            is = 0;
            for (size_t n = 0; n < 48; n++)
                is = fmax(is, fabs(force.x[9600 * (size_t)k + 48 * row + n]));
            ck_assert_double_eq_tol(is, fabs(want), 1e-7 * fabs(want));
        }
    }
    ck_assert(stem_file(&r, "force") && stem_file(&r, "surface") && stem_file(&r, "scraper"));
    ck_assert(strstr(r.summary, "\"stem\": \"force\"") && strstr(r.summary, "\"name\": \"all.force.wav\""));
    folder_remove();
}
END_TEST

/* A force alone: no response, no table, no sound; the same samples as beside a sound, if the knobs are the same. */
START_TEST(a_force_may_be_all)
{
    setup();
    struct render_report r = renders_made("rasp: 1\nsurface: {roughness: {rms: 5 um}}\nscraper: {mass: 20 g}\n" LINE
                                          "accuracy: {oversampling: 4}\noutput: {stems: [force]}\n",
                                          "alone");
    renders_made("rasp: 1\n" BODY LINE "accuracy: {oversampling: 4}\noutput: {stems: [force], tail: 0 s}\n", "beside");
    struct wav alone = renders_sound("alone.force.wav"), beside = renders_sound("beside.force.wav");
    ck_assert(!r.sounds && stem_file(&r, "force"));
    ck_assert_int_ne(access(folder_path("alone.wav"), F_OK), 0);
    ck_assert_uint_eq(alone.frames, beside.frames);
    ck_assert_mem_eq(alone.x, beside.x, alone.frames * sizeof *alone.x);
    ck_assert_double_gt(fabs(alone.x[2000]), 0);
    folder_remove();
}
END_TEST

/* What is not asked for is not in the plan, and asking for a part of the sound runs no further stage: of a scene that
   sounds the same stages run with stems and without; of one with a table alone, nothing rings. */
START_TEST(stems_not_asked_cost_nothing)
{
    static const char *const outputs[] = {"{}", "{stems: [force, surface]}", "{stems: [force]}"};
    struct arena *a = setup();
    struct plan p[3];
    for (int k = 0; k < 3; k++) {
        struct scene *s = ARENA_TAKE(a, struct scene, 1);
        struct err e = {0};
        const char *messages = "",
                   *text = arena_format(a, "rasp: 1\n%s" LINE "output: %s\n",
                                        k < 2 ? BODY : "surface: {roughness: {}}\nscraper: {mass: 20 g}\n", outputs[k]);
        if (!scene_read_text(text, strlen(text), folder_path("scene.yaml"), &(struct scene_overrides){0}, a, s,
                             &messages, &e))
            ck_abort_msg("%s%s", messages, e.text);
        ck_assert_msg(plan_make(stages_table, &s->contacts[0], s, a, &p[k], &e), "%s", e.text);
    }
    ck_assert_uint_eq(p[0].targets, ITEM_BIT(ITEM_SOUND));
    ck_assert_uint_eq(p[1].targets, ITEM_BIT(ITEM_SOUND) | ITEM_BIT(ITEM_FORCE) | ITEM_BIT(ITEM_SURFACE_SOUND));
    ck_assert_uint_eq(p[2].targets, ITEM_BIT(ITEM_FORCE));
    ck_assert_uint_eq(p[0].alive, p[1].alive);
    ck_assert_uint_eq(p[2].alive & (ITEM_BIT(ITEM_SOUND) | ITEM_BIT(ITEM_SURFACE_SOUND)), 0);
    for (int i = 0; i < p[0].n; i++)
        ck_assert_int_eq(p[0].rows[i].verdict, p[1].rows[i].verdict);
    folder_remove();
}
END_TEST

static struct err fails(struct arena *a, const char *text)
{
    struct scene s;
    struct err e = {0};
    struct render_report report;
    const char *messages = "";
    if (!scene_read_text(text, strlen(text), folder_path("scene.yaml"), &(struct scene_overrides){0}, a, &s, &messages,
                         &e))
        ck_abort_msg("%s%s", messages, e.text);
    ck_assert(!render_scene(&s, folder_path("no"), a, &report, &e));
    ck_assert_int_eq(e.kind, ERR_SCENE);
    ck_assert_int_eq(system(arena_format(a, "test \"$(ls -A %s)\" = bell.csv", folder_name)), 0);
    return e;
}

/* What cannot be had is said, and leaves nothing: a table without a size as a sphere; stems that clip. */
START_TEST(stems_and_radiators_that_cannot_be)
{
    struct arena *a = setup();
    struct err e = fails(a, "rasp: 1\n" BODY LINE "output: {listen: {places: [[0, 0, 1]]}, stems: [force]}\n");
    ck_assert_msg(strstr(e.text, "does not say how large") != NULL, "%s", e.text);
    e = fails(a,
              "rasp: 1\n" BODY LINE "output: {encoding: pcm16, level: {full_scale: 1e-9}, stems: [force, surface]}\n");
    ck_assert_msg(strstr(e.text, "full scale") != NULL, "%s", e.text);
    folder_remove();
}
END_TEST

/* Two places as far from the middle of a struck pane, one on each side, and a third 100 samples of air farther: three
   channels, the first two alike, the third 100 samples later and softer by the ratio of the distances (0.7 and 1.415
   m). Gains at every sample (ramps of 64 would begin elsewhere under a force that is heard later). In pascals. */
START_TEST(places_are_channels)
{
    struct arena *a = setup();
    const char *scene =
        "rasp: 1\n" PANE LINE "accuracy: {gain_ramp: 1}\noutput: {encoding: float64, level: {dbfs_at_1_pa: -40}, ramp: "
        "0, tail: 0.2 s, listen: {radiator: monopole, places: [%s]}}\n";
    double most = 0;
    struct render_report r = renders_made(
        arena_format(a, scene, "[45 cm, 0, 0.574456264653803], [-35 cm, 0, 0.574456264653803], [5 cm, 0, 1.415]"),
        "three");
    renders_made(arena_format(a, scene, "[5 cm, 0, 1.415]"), "one");
    struct wav w = renders_sound("three.wav"), one = renders_sound("one.wav");
    ck_assert_int_eq(w.channels, 3);
    ck_assert_int_eq(one.channels, 1);
    ck_assert_double_eq_tol(r.sound.gain, 0.01, 1e-17);
    ck_assert_int_eq(r.quantity, 3);
    for (size_t n = 0; n < w.frames; n++)
        most = fmax(most, fabs(w.x[3 * n]));
    ck_assert_double_gt(most, 0);
    for (size_t n = 0; n < one.frames; n++) {
        ck_assert_double_eq_tol(w.x[3 * n], w.x[3 * n + 1], 1e-12 * most);
        ck_assert_double_eq_tol(w.x[3 * n + 2], n < 100 ? 0 : one.x[n - 100], 1e-9 * most);
        ck_assert_double_eq_tol(w.x[3 * n + 2] * 1.415, n < 100 ? 0 : w.x[3 * (n - 100)] * 0.7, 1e-9 * most);
    }
    ck_assert(strstr(r.summary, "\"unit\": \"Pa\"") && strstr(r.summary, "\"place_m\""));
    folder_remove();
}
END_TEST

/* The lowest mode of a pane in a baffle, struck in the middle and at a quarter of its length: sin(pi/4) of the pressure
   (its shape counts once), in a ratio of far places on the axis that is that of the distances; against the point in the
   middle, the mean velocity of sin sin, (2/pi)^2, by p = rho f S v / r, as a small source in a baffle. The struck
   mode's rms over the last 0.1 s; of 88 Hz, where (k L)^2/12 = 2 %. */
START_TEST(a_pane_in_a_baffle_is_heard)
{
    struct arena *a = setup();
    const char *scene = "rasp: 1\nsurface: {object: {shape: plate, edges: supported, length: 30 cm, width: 20 cm, "
                        "thickness: 1 mm}, material: glass, modes: 1}\n"
                        "scraper: {mass: 1 g}\nmotion: {path: still, at: [%s, 10 cm], duration: 0.3 s}\ncontact: "
                        "{model: strike, strike: {pulse: half_sine, stiffness: 1e4, speed: 0.1}}\n"
                        "output: {encoding: float64, level: {%s: %s}, ramp: 0, tail: 0 s, listen: {radiator: %s, "
                        "places: [[15 cm, 10 cm, %s]]}}\n";
    const char *const at[] = {"15 cm", "7.5 cm", "15 cm", "15 cm"};
    double rms[4] = {0};
    for (int k = 0; k < 4; k++) {
        renders_made(arena_format(a, scene, at[k], k < 3 ? "dbfs_at_1_pa" : "full_scale", k < 3 ? "0 dB" : "1",
                                  k < 3 ? "plate" : "point",
                                  k == 2   ? "6 m"
                                  : k == 3 ? "0"
                                           : "3 m"),
                     "pane");
        struct wav w = renders_sound("pane.wav");
        for (size_t n = w.frames - 4800; n < w.frames; n++)
            rms[k] += w.x[n] * w.x[n] / 4800;
        rms[k] = sqrt(rms[k]);
    }
    printf("pane: a quarter along %.6f, twice as far %.6f of it\n", rms[1] / rms[0], rms[2] / rms[0]);
    ck_assert_double_eq_tol(rms[1] / rms[0], sqrt(0.5), 1e-9);
    ck_assert_double_eq_tol(rms[2] / rms[0], 0.5, 1e-3);
    double frequency = M_PI / 2 * (1 / 0.09 + 1 / 0.04) * sqrt(70e9 * 1e-6 / (12 * 0.96 * 2500)),
           area = 0.06 * 4 / (M_PI * M_PI);
    printf("%.6g Pa, a small source makes %.6g Pa\n", rms[0], 1.204 * frequency * area * rms[3] / 3);
    ck_assert_double_eq_tol(rms[0] / (1.204 * frequency * area * rms[3] / 3), 1, 0.02);
    folder_remove();
}
END_TEST

UNIT("render", free_decay_is_the_tables, contacts_add, a_start_is_rounded_to_the_nearest_sample, names_make_the_noise,
     engines_agree_on_a_moving_contact, the_scraper_rings_with_weight_eta, a_wav_scraper_rings_with_weight_eta,
     quantities_are_not_mixed, a_muted_contact_lasts_as_long, levels, loudness_is_the_standards, edges_and_encodings,
     a_failure_leaves_nothing, stems_are_the_parts, a_force_may_be_all, stems_not_asked_cost_nothing,
     stems_and_radiators_that_cannot_be, places_are_channels, a_pane_in_a_baffle_is_heard)
