/* The judge of evidence/responses.sh: moving responses by their definitions, sample by sample, without a line of rasp's.

     judge make TABLE.csv FORCE.npy RATE SECONDS DMAX [SEED]
         50 modes, 100 Hz to 15 kHz, T60 = 0.9 s (f / 100 Hz)^-0.3, gains random; at the second place each frequency differs by up to +-DMAX,
         each decay by up to +-30 %, each gain by up to +-10 dB (DMAX = same: not at all); white Gaussian force
     judge one TABLE.csv F0 D0 G0 PHASE0 F1 D1 G1 PHASE1
         a single mode: frequency, decay, gain, phase at either place
     judge sum READING TABLE.csv FORCE.npy RATE SECONDS OUT.npy [MOTION]
         READING launch: y(n) = sum_m h_{x(m)}(n - m) f(m) / rate;  readout: h_{x(n)};  glide: z(n) = p(x(n)) z(n - 1) + a(x(n)) f(n)
         MOTION line (default): x goes from 0 to 1 m in SECONDS at constant speed;  jerk: at minimum jerk;  strokes:HZ: to and fro, HZ times a second;
         circle:N: on N turns of a circle from 0 to 1 m and back, of which x counts;  frequency, decay, gain go from place to place in the log, phase evenly
     judge snr A.npy B.wav [FROM TO]
         10 log10 of A's energy over that of B - A; samples FROM to TO

   A sum of 50 modes, 2 s at 44.1 kHz takes about a minute and a half on one core. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <sndfile.h>

#include "numbers.h"

enum { MODES = 50, LANES = 8, GROUPS = (MODES + LANES - 1) / LANES };

struct mode {
    double f[2], d[2], g[2], phase[2];
};

static void die(const char *what)
{
    fprintf(stderr, "judge: %s\n", what);
    exit(1);
}

/* ------------------------------------------------------------------ files */

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

static double *npy_read(const char *path, long *n)
{
    char head[128];
    FILE *in = fopen(path, "rb");
    const char *shape;
    if (!in || fread(head, 1, 128, in) != 128 || !(shape = strstr(head + 10, "'shape': (")))
        die(path);
    char *end;
    *n = (long)number_first(shape + 10, &end);
    double *x = malloc((size_t)*n * sizeof *x);
    if (fread(x, sizeof *x, (size_t)*n, in) != (size_t)*n)
        die(path);
    fclose(in);
    return x;
}

static double *wav_read(const char *path, long *n)
{
    SF_INFO info = {0};
    SNDFILE *in = sf_open(path, SFM_READ, &info);
    if (!in || info.channels != 1)
        die(path);
    double *x = malloc((size_t)info.frames * sizeof *x);
    *n = sf_read_double(in, x, info.frames);
    sf_close(in);
    return x;
}

/* Returns the number of modes. */
static int table_read(const char *path, struct mode *m)
{
    char line[400];
    int n = 0;
    FILE *in = fopen(path, "r");
    if (!in)
        die(path);
    while (fgets(line, sizeof line, in)) {
        int place, mode;
        double x, y, f, d, g, phase;
        if (sscanf(line, "%d,%lf,%lf,%d,%lf,%lf,%lf,%lf", &place, &x, &y, &mode, &f, &d, &g, &phase) == 8) {
            m[mode].f[place] = f;
            m[mode].d[place] = d;
            m[mode].g[place] = g;
            m[mode].phase[place] = phase;
            n = mode + 1 > n ? mode + 1 : n;
        }
    }
    fclose(in);
    return n;
}

/* ------------------------------------------------------------------ make */

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

/* ------------------------------------------------------------------ sums */

static struct mode modes[GROUPS * LANES];
static int used; /* modes */

struct course {
    const char *motion;
    double rate, seconds;
};

static double where(const struct course *c, long frame)
{
    double t = (double)frame / c->rate, u = t / c->seconds;
    if (strncmp(c->motion, "strokes:", 8) == 0)
        return 0.5 - 0.5 * cos(2 * M_PI * number(c->motion + 8) * t);
    if (strncmp(c->motion, "circle:", 7) == 0)
        return 0.5 + 0.5 * cos(2 * M_PI * number(c->motion + 7) * u);
    return strcmp(c->motion, "jerk") == 0 ? u * u * u * (10 + u * (6 * u - 15)) : u;
}

/* p = e^(s / rate) and gain / rate of mode i where the contact is at share u. */
static void at(int i, double u, double rate, double p[2], double gain[2])
{
    const struct mode *m = &modes[i];
    double f = m->f[0] * pow(m->f[1] / m->f[0], u), d = m->d[0] * pow(m->d[1] / m->d[0], u);
    p[0] = exp(-d / rate) * cos(2 * M_PI * f / rate);
    p[1] = exp(-d / rate) * sin(2 * M_PI * f / rate);
    double size = m->g[0] * pow(m->g[1] / m->g[0], u) / rate, turn = m->phase[0] + u * (m->phase[1] - m->phase[0]);
    gain[0] = size * cos(turn);
    gain[1] = size * sin(turn);
}

static void sum_glide(const double *f, long n, const struct course *c, double *y)
{
    for (int i = 0; i < used; i++) {
        double re = 0, im = 0;
        for (long k = 0; k < n; k++) {
            double p[2], g[2];
            at(i, where(c, k), c->rate, p, g);
            double next = p[0] * re - p[1] * im + g[0] * f[k];
            im = p[0] * im + p[1] * re + g[1] * f[k];
            re = next;
            y[k] += im - 0.5 * g[1] * f[k];
        }
    }
}

/* launch: from every sample on, its own response, phasor by phasor; readout: the same backwards in time. */
static void sum_all(const double *f, long n, const struct course *c, double *y, int launch)
{
    int groups = (used + LANES - 1) / LANES;
    for (long k = 0; k < n; k++) {
        double pr[GROUPS][LANES] = {{0}}, pi[GROUPS][LANES] = {{0}}, re[GROUPS][LANES] = {{0}}, im[GROUPS][LANES] = {{0}};
        for (int i = 0; i < used; i++) {
            double p[2], g[2];
            at(i, where(c, k), c->rate, p, g);
            pr[i / LANES][i % LANES] = p[0];
            pi[i / LANES][i % LANES] = p[1];
            re[i / LANES][i % LANES] = launch ? g[0] * f[k] : g[0];
            im[i / LANES][i % LANES] = launch ? g[1] * f[k] : g[1];
        }
        double all = 0;
        for (long j = 0; j <= (launch ? n - 1 - k : k); j++) {
            double sums[LANES] = {0}, now = 0;
            for (int q = 0; q < groups; q++)
                for (int l = 0; l < LANES; l++) {
                    double r = re[q][l];
                    sums[l] += im[q][l];
                    re[q][l] = pr[q][l] * r - pi[q][l] * im[q][l];
                    im[q][l] = pr[q][l] * im[q][l] + pi[q][l] * r;
                }
            for (int l = 0; l < LANES; l++)
                now += sums[l];
            now *= j ? 1 : 0.5;
            if (launch)
                y[k + j] += now;
            else
                all += now * f[k - j];
        }
        if (!launch)
            y[k] = all;
    }
}

static void sum(char **arg, int given)
{
    long n;
    struct course c = {given > 6 ? arg[6] : "line", number(arg[3]), number(arg[4])};
    double *f = npy_read(arg[2], &n), *y = calloc((size_t)n, sizeof *y);
    used = table_read(arg[1], modes);
    if (strcmp(arg[0], "glide") == 0)
        sum_glide(f, n, &c, y);
    else
        sum_all(f, n, &c, y, strcmp(arg[0], "launch") == 0);
    npy_write(arg[5], y, n);
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

static void snr(char **arg, int n)
{
    long na, nb;
    double *a = npy_read(arg[0], &na), *b = strstr(arg[1], ".npy") ? npy_read(arg[1], &nb) : wav_read(arg[1], &nb), e = 0, d = 0;
    long from = n > 2 ? number_whole(arg[2]) : 0, to = n > 3 ? number_whole(arg[3]) : na < nb ? na : nb;
    for (long k = from; k < to; k++) {
        e += a[k] * a[k];
        d += (b[k] - a[k]) * (b[k] - a[k]);
    }
    printf("%.1f\n", 10 * log10(e / d));
}

int main(int argc, char **argv)
{
    const char *what = argc > 1 ? argv[1] : "";
    if (strcmp(what, "make") == 0 && argc >= 7)
        make(argv + 2, argc - 2);
    else if (strcmp(what, "sum") == 0 && (argc == 8 || argc == 9))
        sum(argv + 2, argc - 2);
    else if (strcmp(what, "one") == 0 && argc == 11)
        one(argv + 2);
    else if (strcmp(what, "snr") == 0 && argc >= 4)
        snr(argv + 2, argc - 2);
    else
        die("usage: see the head of responses_judge.c");
    return 0;
}
