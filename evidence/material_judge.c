/* Recordings of solids whose material is known, and fits of materials to what `rasp modes extract` finds in them.

     make TABLE PLACE SNR SEED OUT.wav     a strike (0.3 ms half sine) on that place of a mode table of velocity, and
                                           white noise so many dB below the sound's first second; channel 2: the force
     fit OBJECT ORDER FACE X,Y;... < LINES one family of computed modes; each line: label table place-number
                                           E/density nu alpha beta; printed: label, what was found, and its intervals

   The family is what `rasp modes material` computes: the same code, so that one does for many tables. */
#include <math.h>
#include <sndfile.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "analysis/material_set.h"
#include "cmd/modes_compute.h"
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

static int make(char **argv)
{
    struct arena *a = arena_open();
    struct mode_table t;
    struct err e = {0};
    if (!mode_table_read(argv[2], a, &t, &e)) stop(&e);
    const int place = (int)number(argv[3]) - 1, n = LEAD + LONG;
    double *y = ARENA_TAKE(a, double, n), *f = ARENA_TAKE(a, double, n), *x = ARENA_TAKE(a, double, 2 * n),
           *gauss = ARENA_TAKE(a, double, n), power = 0.0, most = 0.0;
    enum { PULSE = 13, FINE = 64 }; /* 0.3 ms: the force at the audio rate is its mean over each sample */
    for (int i = 0; i < PULSE * FINE; i++) {
        double at = (i + 0.5) / (RATE * FINE * 3e-4);
        if (at < 1.0) f[LEAD + i / FINE] += sin(pi * at) * 100.0 / FINE;
    }
    for (size_t k = t.first[place]; k < t.first[place + 1]; k++) {
        const struct mode_entry *m = &t.entry[k];
        double w = 2.0 * pi * m->frequency / RATE, r = exp(-m->slope[0].decay / RATE), re = 0.0, im = 0.0;
        if (m->frequency > 0.45 * RATE) continue;
        double c = r * cos(w), s = r * sin(w), ga = m->slope[0].gain * cos(m->slope[0].phase),
               gb = m->slope[0].gain * sin(m->slope[0].phase);
        for (int i = LEAD; i < n; i++) { /* z -> r e^(jw) z + f; h = Im gain e^(j phase) e^(s t) */
            double next = c * re - s * im + f[i] / RATE;
            im = s * re + c * im;
            re = next;
            y[i] += ga * im + gb * re;
        }
    }
    for (int i = LEAD; i < LEAD + RATE; i++)
        power += y[i] * y[i] / RATE;
    noise_normal(noise_make((uint64_t)number(argv[5]), "recording"), 0, (size_t)n, gauss);
    for (int i = 0; i < n; i++) {
        y[i] += sqrt(power) * pow(10.0, -number(argv[4]) / 20.0) * gauss[i];
        most = fmax(most, fabs(y[i]));
    }
    for (int i = 0; i < n; i++) {
        x[2 * i] = 0.8 * y[i] / most;
        x[2 * i + 1] = 0.008 * f[i];
    }
    SF_INFO info = {.samplerate = RATE, .channels = 2, .format = SF_FORMAT_WAV | SF_FORMAT_FLOAT};
    SNDFILE *out = sf_open(argv[6], SFM_WRITE, &info);
    if (!out || sf_writef_double(out, x, n) != n || sf_close(out) != 0) return 1;
    arena_close(a);
    return 0;
}

/* ------------------------------------------------------------------ fit */

static void figure(const struct material_figure *f, double truth)
{
    printf(" %.9g %.9g %d", f->value, f->value / truth - 1.0, isnan(f->low) ? -1 : f->low <= truth && truth <= f->high);
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
    topology_elevate(&mesh, a);
    boundary_make(&mesh, a, &boundary);
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
                                   .most = 80,
                                   .point = point,
                                   .points = points,
                                   .coarse = &mesh,
                                   .coarse_boundary = &boundary,
                                   .coarse_order = order - 1};
    if (shape) {
        if (!shapes_mesh_coarser(argv[2], 1.5, a, &longer, &e)) stop(&e);
        topology_elevate(&longer, a);
        boundary_make(&longer, a, &coarse);
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
        printf("%s", label);
        if (!mode_table_read(file, room, &t, &e)) {
            printf(" no-table\n");
        } else {
            struct material_set set = material_set_make(&t, 0, room);
            set.visible = material_set_visible(&family, points, place - 1, 1, -1, room);
            struct material_problem p = {
                .object = &family, .sets = 1, .set = &set, .gamma = {1e5, 5e8}, .poisson = NAN, .model_error = 1e-3};
            if (!material_fit(&p, room, &f, &e)) {
                printf(" refused: %s\n", e.text);
            } else {
                const struct material_damping *d = &f.damping[MATERIAL_RAYLEIGH];
                printf(" %d %d %d %d %g", f.modes, f.matched, f.missing, f.sure, f.scatter);
                figure(&f.gamma, truth[0]);
                figure(&f.nu, truth[1]);
                figure(&d->figure[0], truth[2]);
                figure(&d->figure[1], truth[3]);
                printf(" %s\n", f.damping[f.best].name);
            }
        }
        fflush(stdout);
        arena_close(room);
    }
    return 0;
}

int main(int argc, char **argv)
{
    if (argc == 7 && !strcmp(argv[1], "make")) return make(argv);
    if (argc == 6 && !strcmp(argv[1], "fit")) return fit(argv);
    fprintf(stderr, "material_judge make TABLE PLACE SNR SEED OUT.wav | fit OBJECT ORDER FACE X,Y;...\n");
    return 1;
}
