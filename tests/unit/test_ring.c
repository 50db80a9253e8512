/* Responses that move with the contact, through the whole pipeline: every engine and reading against sums of the
   definitions, sample by sample in long double, for a force from a file and a table of two places; what sampling folds
   in is taken out by taps that test_alias.c holds against closed forms. */
#include <unistd.h>

#include "convolution/alias.h"
#include "force_file.h"
#include "rig.h"

enum { RATE = 8000, FRAMES = 2400, FORCED = 2000, MODES = 5, BLOCK = 700 };
#define SECONDS ((double)FORCED / RATE)

struct place {
    double f[MODES], d[MODES], g[MODES], phase[MODES];
};

static const struct place here = {
    {180, 420, 955, 1700, 3100}, {60, 70, 90, 120, 200}, {1, -0.7, 0.5, 0.4, 0.3}, {0, 0.4, 1.5, -0.8, 0}};
static const struct place there = {
    {183, 413, 975, 1690, 3160}, {66, 60, 100, 115, 230}, {0.5, -1, 0.7, 0.3, 0.2}, {0.2, 0.1, 1.5, -1.2, 0.5}};

/* As `here`, but for a little: of gains, of poles. */
static const struct place nearly = {
    {180.01, 420, 955.3, 1700, 3100}, {60, 70, 90, 121, 200}, {1.1, -0.7, 0.5, 0.4, 0.33}, {0, 0.4, 1.5, -0.8, 0.7}};

static const struct place *other = &there;
static const char *course = "path: line, from: [0, 0], to: [1, 0]";
static double strokes; /* Hz; 0: a line at constant speed */

static char folder[] = "/tmp/test_ring.XXXXXX";
static double force[FRAMES];

static FILE *file_open(const char *name)
{
    char path[200];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *f = fopen(path, "w");
    if (!f) abort();
    return f;
}

static void table_write(const char *name, const char *poles, const struct place *p, const struct place *q)
{
    FILE *f = file_open(name);
    fprintf(f, "# poles: %s\n# quantity: displacement\nplace,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad\n",
            poles);
    for (int k = 0; k < 2; k++) {
        const struct place *at = k ? q : p;
        for (int i = 0; i < MODES; i++)
            fprintf(f, "%d,%d,0,%d,%.17g,%.17g,%.17g,%.17g\n", k, k, i, at->f[i], at->d[i], at->g[i], at->phase[i]);
    }
    fclose(f);
}

/* White force for the motion's 0.25 s, at the audio rate. */
static void force_write(void) { force_file_write(file_open("force.npy"), force, FORCED); }

static void setup(void)
{
    if (!mkdtemp(folder)) abort();
    table_write("move.csv", "separate", &here, &there);
    table_write("nearly.csv", "separate", &here, &nearly);
    table_write("same.csv", "separate", &here, &here);
    table_write("shared.csv", "shared", &here, &here);
    force_write();
}

static void teardown(void)
{
    const char *names[] = {"move.csv", "nearly.csv", "same.csv", "shared.csv", "force.npy"};
    char path[200];
    for (int i = 0; i < 5; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, names[i]);
        unlink(path);
    }
    rmdir(folder);
}

/* The sound of FRAMES frames, in blocks of `block`, with these keys of surface and of accuracy. */
static struct rig *render(const char *surface, const char *accuracy, int block)
{
    char text[1000];
    snprintf(
        text, sizeof text,
        "rasp: 1\nsurface: {%s}\nmotion: {%s, duration: %.17g}\n"
        "contact: {model: given, given: {file: %s/force.npy, rate: %d}}\naccuracy: {%s}\noutput: {sample_rate: %d}\n",
        surface, course, SECONDS, folder, RATE, accuracy, RATE);
    struct scene s = rig_scene(rig_arena(), text);
    return rig_record(&s, ITEM_SOUND, FRAMES, block);
}

static struct rig *render_file(const char *name, const char *how, const char *accuracy)
{
    char surface[400];
    snprintf(surface, sizeof surface, "response: %s/%s%s%s", folder, name, *how ? ", " : "", how);
    return render(surface, accuracy, BLOCK);
}

/* ------------------------------------------------------------------ the definitions */

struct at {
    long double f, d, re, im;
};

static struct at mode_at(int i, long double u)
{
    long double size = fabsl((long double)here.g[i]) * powl(fabsl((long double)other->g[i] / here.g[i]), u);
    long double phase =
        here.phase[i] + u * ((long double)other->phase[i] - here.phase[i]) + (here.g[i] < 0 ? M_PIl : 0);
    return (struct at){here.f[i] * powl((long double)other->f[i] / here.f[i], u),
                       here.d[i] * powl((long double)other->d[i] / here.d[i], u), size * cosl(phase),
                       size * sinl(phase)};
}

struct phasors { /* of one place, MODES poles to the power of the frames gone by */
    long double pole[MODES][2], now[MODES][2];
};

static struct phasors phasors_of(long double u)
{
    struct phasors p;
    for (int i = 0; i < MODES; i++) {
        struct at m = mode_at(i, u);
        long double size = expl(-m.d / RATE), turn = 2 * M_PIl * m.f / RATE;
        p.pole[i][0] = size * cosl(turn);
        p.pole[i][1] = size * sinl(turn);
        p.now[i][0] = m.re;
        p.now[i][1] = m.im;
    }
    return p;
}

/* h at the next frame: half of it at the first. */
static long double response(struct phasors *p, long frames)
{
    long double sum = 0;
    for (int i = 0; i < MODES; i++) {
        long double re = p->now[i][0], im = p->now[i][1];
        sum += im;
        p->now[i][0] = re * p->pole[i][0] - im * p->pole[i][1];
        p->now[i][1] = im * p->pole[i][0] + re * p->pole[i][1];
    }
    return frames == 0 ? sum / 2 : sum;
}

static long double share_of(long frame)
{
    frame = frame < FORCED ? frame : FORCED;
    return strokes > 0 ? (1 - cosl(2 * M_PIl * strokes * (long double)frame / RATE)) / 2 : (long double)frame / FORCED;
}

static struct alias *alias;

/* The taps of the place u. */
static void taps_of(long double u, long double tap[ALIAS_TAPS])
{
    for (int k = 0; k < ALIAS_TAPS; k++)
        tap[k] = 0;
    for (int i = 0; i < MODES; i++) {
        double re[ALIAS_TAPS], im[ALIAS_TAPS];
        struct at m = mode_at(i, u);
        alias_taps(alias, (double)m.f, (double)m.d, re, im);
        for (int k = 0; k < ALIAS_TAPS; k++)
            tap[k] += m.re * im[k] + m.im * re[k];
    }
}

/* Those of force frame m to what is heard around it; what comes before the first frame is heard in it. */
static void unalias(double *y, long m, double share, long double u)
{
    long double tap[ALIAS_TAPS];
    taps_of(u, tap);
    for (long k = 0, n = m - ALIAS_REACH; k < ALIAS_TAPS; k++, n++)
        if (n < FRAMES) y[n > 0 ? n : 0] += (double)(share * tap[k] * force[m]);
}

static void sum_launch(double *y)
{
    for (long m = 0; m < FORCED; m++) {
        struct phasors p = phasors_of(share_of(m));
        unalias(y, m, 1, share_of(m));
        for (long n = m; n < FRAMES; n++)
            y[n] += (double)(response(&p, n - m) * force[m] / RATE);
    }
}

static void sum_readout(double *y)
{
    for (long n = -ALIAS_REACH; n < FRAMES; n++) {
        long double tap[ALIAS_TAPS];
        taps_of(share_of(n > 0 ? n : 0), tap);
        for (int k = 0; k < ALIAS_TAPS; k++) {
            long m = n + ALIAS_REACH - k;
            y[n > 0 ? n : 0] += m >= 0 && m < FORCED ? (double)(tap[k] * force[m]) : 0;
        }
    }
    for (long n = 0; n < FRAMES; n++) {
        struct phasors p = phasors_of(share_of(n));
        for (long m = n; m >= 0; m--)
            y[n] += (double)(response(&p, n - m) * force[m] / RATE);
    }
}

static void sum_glide(double *y)
{
    for (long m = 0; m < FORCED; m++)
        unalias(y, m, 1, share_of(m));
    for (int i = 0; i < MODES; i++) {
        long double re = 0, im = 0;
        for (long n = 0; n < FRAMES; n++) {
            struct at m = mode_at(i, share_of(n));
            long double size = expl(-m.d / RATE), c = size * cosl(2 * M_PIl * m.f / RATE),
                        s = size * sinl(2 * M_PIl * m.f / RATE);
            long double next = c * re - s * im + m.re * force[n] / RATE;
            im = c * im + s * re + m.im * force[n] / RATE;
            re = next;
            y[n] += (double)(im - m.im * force[n] / RATE / 2);
        }
    }
}

static double decibels(const double *x, const double *judge)
{
    double wrong = 0, whole = 0;
    for (int n = 0; n < FRAMES; n++) {
        wrong += (x[n] - judge[n]) * (x[n] - judge[n]);
        whole += judge[n] * judge[n];
    }
    return 10 * log10(wrong / whole);
}

/* ------------------------------------------------------------------ tests */

/* Hard case 6: where both places ring alike, every reading by every engine is one and the same sound, to 1e-12; of
   resonators at nodes to 1e-7, as they are dropped at -140 dB. Responses are kept until -280 dB where they are cut
   (60/s for 0.55 s). */
START_TEST(test_same)
{
    static const char *const ways[] = {"moving: launch, convolution: resonators",
                                       "moving: launch, convolution: overlap_add, response_length: 0.55 s",
                                       "moving: glide", "moving: readout, response_length: 0.55 s"};
    struct rig *fixed = render_file("shared.csv", "moving: fixed", "preset: standard");
    for (int i = 0; i < 4; i++)
        for (int ramp = 1; ramp <= 64; ramp *= 8) {
            char accuracy[100];
            snprintf(accuracy, sizeof accuracy, "gain_ramp: %d", ramp);
            struct rig *way = render_file("same.csv", ways[i], accuracy);
            ck_assert_msg(decibels(way->x, fixed->x) < (i == 0 ? -140 : -240), "%s, ramp %d: %g dB", ways[i], ramp,
                          decibels(way->x, fixed->x));
            rig_close(way);
        }
    rig_close(fixed);
}
END_TEST

#define LEAST (-140.0) /* dB: what drops, taps and the rounding of hops leave */

/* Errors against a definition at ramps of 64, 16, 4 and 1 frames: at most `coarse` dB at 64, and `finer` dB less for
   each halving: nearly 12, but of what is read out, where the motion's end is a kink, and of hops that are long beside
   the motion. */
static void converges(const char *table, const char *how, const double *y, double coarse, double finer)
{
    for (int halvings = 0; halvings <= 6; halvings += 2) {
        char accuracy[100];
        snprintf(accuracy, sizeof accuracy, "gain_ramp: %d", 64 >> halvings);
        struct rig *way = render_file(table, how, accuracy);
        double db = decibels(way->x, y);
        printf("%s, %s, ramp %d: %.1f dB\n", table, how, 64 >> halvings, db);
        ck_assert_msg(db <= fmax(coarse - finer * halvings, LEAST), "%s, %s, ramp %d: %g dB", table, how,
                      64 >> halvings, db);
        rig_close(way);
    }
}

static void (*const sums[])(double *) = {sum_launch, sum_launch, sum_glide, sum_readout};
static const char *const ways[] = {"moving: launch, convolution: resonators",
                                   "moving: launch, convolution: overlap_add", "moving: glide", "moving: readout"};

/* At constant speed; 64 frames are 8 ms here, and the modes move by up to 5 half bandwidths. */
START_TEST(test_moving)
{
    static const double coarse[] = {-100, -78, -62, -44};
    for (int i = 0; i < 4; i++) {
        double y[FRAMES] = {0};
        sums[i](y);
        converges("move.csv", ways[i], y, coarse[i], i < 3 ? 11 : 3);
    }
}
END_TEST

/* Where the motion is not at constant speed and modes move but little. Strokes of 8 and 40 Hz. */
START_TEST(test_strokes)
{
    static const double coarse[2][4] = {{-65, -45, -61, -43}, {-24, -22, -33, -22}};
    static char path[100];
    course = path;
    other = &nearly;
    for (strokes = 8; strokes <= 40; strokes *= 5) {
        snprintf(path, sizeof path, "path: back_and_forth, from: [0, 0], to: [1, 0], rate: %g Hz", strokes);
        for (int i = 0; i < 4; i++) {
            double y[FRAMES] = {0};
            sums[i](y);
            converges("nearly.csv", ways[i], y, coarse[strokes > 20][i],
                      strokes > 20 ? (i % 2 ? 2.4 : 5.5)
                      : i < 3      ? 11
                                   : 9);
        }
    }
}
END_TEST

/* How the sound is cut into blocks changes not a bit of it. */
START_TEST(test_blocks)
{
    for (int i = 0; i < 4; i++) {
        char surface[400];
        snprintf(surface, sizeof surface, "response: %s/move.csv, %s", folder, ways[i]);
        struct rig *one = render(surface, "preset: standard", 1000), *many = render(surface, "preset: standard", 37);
        ck_assert_msg(memcmp(one->x, many->x, FRAMES * sizeof *one->x) == 0, "%s", ways[i]);
        rig_close(one);
        rig_close(many);
    }
}
END_TEST

/* The scraper's sound comes from its one place, weighted; it does not move. */
START_TEST(test_scraper)
{
    char text[600];
    snprintf(text, sizeof text,
             "rasp: 1\nscraper: {response: %s/move.csv, weight: 0.5}\nmotion: {path: line, from: [0, 0], to: [1, 0], "
             "duration: %.17g}\n"
             "contact: {model: given, given: {file: %s/force.npy, rate: %d}}\noutput: {sample_rate: %d}\n",
             folder, SECONDS, folder, RATE, RATE);
    struct scene s = rig_scene(rig_arena(), text);
    struct rig *way = rig_record(&s, ITEM_SOUND, FRAMES, BLOCK);
    double y[FRAMES] = {0};
    for (long m = 0; m < FORCED; m++) {
        struct phasors p = phasors_of(0);
        unalias(y, m, 0.5, 0);
        for (long n = m; n < FRAMES; n++)
            y[n] += 0.5 * (double)(response(&p, n - m) * force[m] / RATE);
    }
    ck_assert_msg(decibels(way->x, y) < -240, "%g", decibels(way->x, y));
    rig_close(way);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {test_same, test_moving, test_strokes, test_blocks, test_scraper};
    setup();
    alias = alias_make(rig_arena(), 1, RATE);
    int failed = unit_run("ring", tests, sizeof tests / sizeof tests[0]);
    teardown();
    return failed;
}
