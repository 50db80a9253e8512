/* The objects and forces of evidence/responses.sh, without a line of rasp's.

     object make TABLE.csv FORCE.npy RATE SECONDS DMAX [SEED]
         50 modes, 100 Hz to 15 kHz, T60 = 0.9 s (f / 100 Hz)^-0.3, gains random; at the second place each frequency differs by up to +-DMAX,
         each decay by up to +-30 %, each gain by up to +-10 dB (DMAX = same: not at all); white Gaussian force
     object one TABLE.csv F0 D0 G0 PHASE0 F1 D1 G1 PHASE1
         a single mode: frequency, decay, gain, phase at either place */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

#include "numbers.h"

enum { MODES = 50 };

static void die(const char *what)
{
    fprintf(stderr, "object: %s\n", what);
    exit(1);
}

static void npy_write(const char *path, const double *x, long n)
{
    char head[129] = {0};
    int used = snprintf(head + 10, 110, "{'descr': '<f8', 'fortran_order': False, 'shape': (%ld,), }", n);
    FILE *out = fopen(path, "wb");
    memcpy(head, "\x93NUMPY\x01\x00\x76\x00", 10);
    memset(head + 10 + used, ' ', 118 - (size_t)used);
    head[127] = '\n';
    if (!out || fwrite(head, 1, 128, out) != 128 || fwrite(x, sizeof *x, (size_t)n, out) != (size_t)n || fclose(out))
        die(path);
}

static void make(char **arg, int n)
{
    int same = strcmp(arg[4], "same") == 0;
    double rate = number(arg[2]), seconds = number(arg[3]), dmax = same ? 0 : number(arg[4]);
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    FILE *out = fopen(arg[0], "w");
    gsl_rng_set(r, n > 5 ? (unsigned long)number_whole(arg[5]) : 1);
    fprintf(out, "# poles: separate\n# quantity: displacement\nplace,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad\n");
    for (int i = 0; i < MODES; i++) {
        double f = 100 * pow(150, (i + gsl_rng_uniform(r)) / MODES), d = log(1000) / (0.9 * pow(f / 100, -0.3));
        double g = pow(10, gsl_ran_gaussian(r, 0.25)), change[3];
        for (int k = 0; k < 3; k++)
            change[k] = same ? 0 : 2 * gsl_rng_uniform(r) - 1;
        fprintf(out, "0,0,0,%d,%.15g,%.15g,%.15g,0\n", i, f, d, g);
        fprintf(out, "1,1,0,%d,%.15g,%.15g,%.15g,0\n", i, f * (1 + (same ? 0 : dmax) * change[0]), d * (1 + 0.3 * change[1]), g * pow(10, 0.5 * change[2]));
    }
    fclose(out);
    long frames = lround(rate * seconds);
    double *x = malloc((size_t)frames * sizeof *x);
    for (long k = 0; k < frames; k++)
        x[k] = gsl_ran_gaussian(r, 1);
    npy_write(arg[1], x, frames);
}

static void one(char **arg)
{
    FILE *out = fopen(arg[0], "w");
    if (!out)
        die(arg[0]);
    fprintf(out, "# poles: separate\n# quantity: displacement\nplace,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad\n");
    for (int k = 0; k < 2; k++)
        fprintf(out, "%d,%d,0,0,%s,%s,%s,%s\n", k, k, arg[1 + 4 * k], arg[2 + 4 * k], arg[3 + 4 * k], arg[4 + 4 * k]);
    fclose(out);
}

int main(int argc, char **argv)
{
    const char *what = argc > 1 ? argv[1] : "";
    if (strcmp(what, "make") == 0 && argc >= 7)
        make(argv + 2, argc - 2);
    else if (strcmp(what, "one") == 0 && argc == 11)
        one(argv + 2);
    else
        die("usage: see the head of responses_object.c");
    return 0;
}
