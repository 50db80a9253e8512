/* Recordings of solids whose material is known, and fits of materials to what `rasp modes extract` finds in them.

     make TABLE PLACE SNR SEED OUT.wav [CARELESSNESS=X...]
                                           a strike (0.3 ms half sine) on that place of a mode table of velocity, and
                                           white noise so many dB below the sound's first second; channel 2: the force;
                                           a carelessness is one of those in struct careless
     fit OBJECT ORDER FACE X,Y;... [MODES] < LINES
                                           one family of computed modes (80); each line: label table place-number
                                           E/density nu alpha beta [size-error]; printed: label, what was found, law of
                                           damping, the limits of the four intervals, the fit's CPU time in s, and the warning behind |

   The family is what `rasp modes material` computes: the same code, so that one does for many tables. */
#include <math.h>
#include <sndfile.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "analysis/material_set.h"
#include "base/stopwatch.h"
#include "cmd/modes_compute.h"
#include "fem/grade.h"
#include "fem/mesh_check.h"
#include "fem/shapes.h"
#include "fem/topology.h"
#include "num/noise.h"
#include "numbers.h"

static const double pi = 3.14159265358979323846;

static void stop(const struct err *e)
{
    fprintf(stderr, "%s\n", e->text);
    exit(1);
}

/* ------------------------------------------------------------------ make */

enum { RATE = 44100, LEAD = 13230, LONG = 110250 };

static struct careless {
    const char *name;
    double x;
} careless[] = {
    {"pulse", 3e-4},  /* s: how long the hammer touches */
    {"bounce", 0},    /* s: when it hits again, half as hard; 0: it does not */
    {"hold", 0},      /* 1/s: damping alpha of the hand that holds the object, besides its own */
    {"echo", 0},      /* 1: the room answers after 3, 7 and 15 ms, each -12 dB */
    {"hum", -400},    /* dB beside the first second of the sound: 50 Hz, and its harmonics k by 1/k */
    {"peak", 0.8},    /* of the sound; above 1 it clips */
    {"seconds", 2.5}, /* of the recording from the strike on */
    {"bits", 32},     /* of a sample; 32: floating point */
    {"fade", 0},      /* s after the strike, at which an editor has faded it out, straight; 0: it has not */
};
enum { PULSE, BOUNCE, HOLD, ECHO, HUM, PEAK, SECONDS, BITS, FADE, CARELESS };

static void careless_read(char **argv)
{
    for (; *argv; argv++) {
        int k = 0;
        char *equal = strchr(*argv, '=');
        while (k < CARELESS && !(equal && strncmp(*argv, careless[k].name, (size_t)(equal - *argv)) == 0))
            k++;
        if (k == CARELESS) {
            fprintf(stderr, "'%s' is no carelessness\n", *argv);
            exit(1);
        }
        careless[k].x = number(equal + 1);
    }
}

/* A half sine of 100 N that begins at sample from, times scale: the force at the audio rate is its mean over each sample. */
static void strike(double scale, int from, double *f)
{
    enum { FINE = 64 };
    double pulse = careless[PULSE].x;
    for (int i = 0; i < (int)(pulse * RATE) * FINE; i++) {
        double at = (i + 0.5) / (RATE * FINE * pulse);
        f[from + i / FINE] += scale * sin(pi * at) * 100.0 / FINE;
    }
}

/* z -> r e^(jw) z + f; h = Im gain e^(j phase) e^(s t) */
static void ring(const struct mode_entry *m, const double *f, int n, double *y)
{
    double d = m->slope[0].decay, held = d + careless[HOLD].x / 2.0, w0 = 2.0 * pi * m->frequency,
           w = sqrt(w0 * w0 + d * d - held * held) / RATE, r = exp(-held / RATE), c = r * cos(w), s = r * sin(w),
           ga = m->slope[0].gain * cos(m->slope[0].phase), gb = m->slope[0].gain * sin(m->slope[0].phase), re = 0.0,
           im = 0.0;
    for (int i = LEAD; i < n; i++) {
        double next = c * re - s * im + f[i] / RATE;
        im = s * re + c * im;
        re = next;
        y[i] += ga * im + gb * re;
    }
}

/* What the room, the wires and the microphone add. */
static void spoil(double snr, uint64_t seed, int n, double *y, double *gauss)
{
    static const double echoes[] = {3e-3, 7e-3, 15e-3};
    double power = 0.0, harmonics = 0.0;
    for (int i = n - 1; i >= LEAD && careless[ECHO].x != 0.0; i--)
        for (int k = 0; k < 3; k++)
            y[i] += pow(10.0, -12.0 / 20.0) * y[i - (int)rint(echoes[k] * RATE)];
    for (int i = LEAD; i < LEAD + RATE; i++)
        power += y[i] * y[i] / RATE;
    for (int k = 1; k <= 20; k++)
        harmonics += 0.5 / (k * k);
    noise_normal(noise_make(seed, "recording"), 0, (size_t)n, gauss);
    for (int i = 0; i < n; i++) {
        double hum = 0.0;
        for (int k = 1; k <= 20; k++)
            hum += sin(2.0 * pi * 50.0 * k * i / RATE + k * k) / k;
        y[i] += sqrt(power) *
                (pow(10.0, -snr / 20.0) * gauss[i] + pow(10.0, careless[HUM].x / 20.0) / sqrt(harmonics) * hum);
    }
}

static int make(char **argv)
{
    struct arena *a = arena_open();
    struct mode_table t;
    struct err e = {0};
    careless_read(argv + 7);
    if (!mode_table_read(argv[2], a, &t, &e)) stop(&e);
    const int place = (int)number(argv[3]) - 1, n = LEAD + LONG;
    double *y = ARENA_TAKE(a, double, n), *f = ARENA_TAKE(a, double, n), *x = ARENA_TAKE(a, double, 2 * n),
           *gauss = ARENA_TAKE(a, double, n), most = 0.0;
    strike(1.0, LEAD, f);
    if (careless[BOUNCE].x > 0.0) strike(0.5, LEAD + (int)(careless[BOUNCE].x * RATE), f);
    for (size_t k = t.first[place]; k < t.first[place + 1]; k++)
        if (t.entry[k].frequency <= 0.45 * RATE) ring(&t.entry[k], f, n, y);
    spoil(number(argv[4]), (uint64_t)number(argv[5]), n, y, gauss);
    for (int i = LEAD; i < n && careless[FADE].x > 0.0; i++)
        y[i] *= fmax(1.0 - (i - LEAD) / (careless[FADE].x * RATE), 0.0);
    for (int i = 0; i < n; i++)
        most = fmax(most, fabs(y[i]));
    for (int i = 0; i < n; i++) {
        x[2 * i] = careless[PEAK].x * y[i] / most;
        if (careless[PEAK].x > 1.0) x[2 * i] = fmax(-1.0, fmin(x[2 * i], 1.0));
        x[2 * i + 1] = 0.008 * f[i];
    }
    const int bits = (int)careless[BITS].x, kept = LEAD + (int)(careless[SECONDS].x * RATE);
    SF_INFO info = {.samplerate = RATE,
                    .channels = 2,
                    .format = SF_FORMAT_WAV | (bits == 8    ? SF_FORMAT_PCM_U8
                                               : bits == 16 ? SF_FORMAT_PCM_16
                                                            : SF_FORMAT_FLOAT)};
    SNDFILE *out = sf_open(argv[6], SFM_WRITE, &info);
    if (!out || sf_writef_double(out, x, kept) != kept || sf_close(out) != 0) return 1;
    arena_close(a);
    return 0;
}

/* ------------------------------------------------------------------ fit */

static void figure(const struct material_figure *f, double truth)
{
    printf(" %.9g %.9g %d", f->value, f->value / truth - 1.0, isnan(f->low) ? -1 : f->low <= truth && truth <= f->high);
}

static void finish(struct mesh *mesh, struct boundary *boundary, struct arena *a)
{
    topology_elevate(mesh, a);
    boundary_make(mesh, a, boundary);
    if (grade_edges(mesh, boundary, GRADE_DEFAULT, a)) boundary_make(mesh, a, boundary);
}

static int fit(char **argv)
{
    struct arena *a = arena_open();
    struct mesh mesh, longer;
    struct boundary boundary, coarse;
    struct boundary_map map;
    struct boundary_point point[16];
    struct solid_family family;
    struct err e = {0};
    const bool shape = strchr(argv[2], ':') != NULL;
    const int order = (int)number(argv[3]);
    int face = 0, points = 0;
    char line[1024], label[256], file[512];
    if (!(shape ? shapes_mesh(argv[2], a, &mesh, &e) : mesh_read(argv[2], 1.0, a, &mesh, &e))) stop(&e);
    finish(&mesh, &boundary, a);
    while (strcmp(boundary_map_sides[face], argv[4]) != 0)
        face++;
    boundary_map_make(&mesh, &boundary, face, &map);
    for (char *p = argv[5]; *p; points++) {
        double xy[2];
        xy[0] = number_first(p, &p);
        xy[1] = number_first(p + 1, &p);
        p += *p == ';';
        if (!boundary_map_point(&map, xy[0], xy[1], &point[points])) return fprintf(stderr, "beside the object\n"), 1;
    }
    struct solid_family_ask ask = {.mesh = &mesh,
                                   .boundary = &boundary,
                                   .order = order,
                                   .most = argv[6] ? (int)number(argv[6]) : 80,
                                   .point = point,
                                   .points = points,
                                   .coarse = &mesh,
                                   .coarse_boundary = &boundary,
                                   .coarse_order = order - 1};
    if (shape) {
        if (!shapes_mesh_coarser(argv[2], 1.5, a, &longer, &e)) stop(&e);
        finish(&longer, &coarse, a);
        ask.coarse = &longer;
        ask.coarse_boundary = &coarse;
        ask.coarse_order = order;
    }
    if (!solid_family_make(&ask, a, &family, &e)) stop(&e);
    while (fgets(line, sizeof line, stdin)) {
        struct arena *room = arena_open();
        struct mode_table t;
        struct material_fit f;
        double truth[4];
        int place, at;
        if (sscanf(line, "%255s %511s %d%n", label, file, &place, &at) != 3) return fprintf(stderr, "%s", line), 1;
        char *rest = line + at;
        for (int k = 0; k < 4; k++)
            truth[k] = number_first(rest, &rest);
        double size_error = rest[strspn(rest, " \n")] ? number_first(rest, &rest) : 0.0;
        printf("%s", label);
        struct material_set set[2];
        int sets = 0;
        bool read = true;
        for (int k = place ? place : 1; k <= (place ? place : 2);
             k++) { /* 0: both places, of FILE-1.csv and FILE-2.csv */
            read = read && mode_table_read(place ? file : arena_format(room, "%s-%d.csv", file, k), room, &t, &e);
            if (!read) break;
            set[sets] = material_set_make(&t, 0, room);
            set[sets++].visible = material_set_visible(&family, points, k - 1, 1, -1, room);
        }
        if (!read) {
            printf(" no-table\n");
        } else {
            struct material_problem p = {.object = &family,
                                         .sets = sets,
                                         .set = set,
                                         .gamma = {1e5, 5e8},
                                         .poisson = NAN,
                                         .model_error = 1e-3,
                                         .size_error = size_error};
            double before = stopwatch_cpu();
            if (!material_fit(&p, room, &f, &e)) {
                printf(" refused: %s\n", e.text);
            } else {
                const struct material_damping *d = &f.damping[MATERIAL_RAYLEIGH];
                printf(" %d %d %d %d %g", f.modes, f.matched, f.missing, f.sure, f.scatter);
                figure(&f.gamma, truth[0]);
                figure(&f.nu, truth[1]);
                figure(&d->figure[0], truth[2]);
                figure(&d->figure[1], truth[3]);
                printf(" %s", f.damping[f.best].name);
                const struct material_figure *figures[] = {&f.gamma, &f.nu, &d->figure[0], &d->figure[1]};
                for (int k = 0; k < 4; k++)
                    printf(" %.6g %.6g", figures[k]->low, figures[k]->high);
                printf(" %.2f | ", stopwatch_cpu() - before);
                for (const char *p = f.warning ? f.warning : ""; *p; p++)
                    putchar(*p == '\n' ? ';' : *p);
                printf("\n");
            }
        }
        fflush(stdout);
        arena_close(room);
    }
    return 0;
}

int main(int argc, char **argv)
{
    if (argc >= 7 && !strcmp(argv[1], "make")) return make(argv);
    if ((argc == 6 || argc == 7) && !strcmp(argv[1], "fit")) return fit(argv);
    fprintf(stderr, "material_judge make TABLE PLACE SNR SEED OUT.wav [CARELESSNESS=X...] | fit OBJECT ORDER FACE "
                    "X,Y;... [MODES]\n");
    return 1;
}
