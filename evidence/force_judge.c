/* A judge of the scraping force that shares no code with rasp: adaptive quadrature (GSL) of the definition on a profile.

     profile OUT.npy N PITCH SEED        writes a self-affine profile: Hurst exponent 0.8, rms 2 um, nothing above a quarter of a cycle per sample
     snr PROFILE.npy PITCH RATE FORCE.csv[:FORCE.csv...] v=SPEED alpha=A|none [beta1=B] [back=RATE_HZ,LENGTH]
                                         prints the signal-to-noise ratio in dB, 20 Hz to 20 kHz, of the force in each FORCE.csv against the judge's over
                                         50 ms (Hann window) from 5 ms on; mass 20 g, leak 2 mm, no smoothing
     bands RATE FORCE.csv                prints third-octave levels (centre in Hz, dB) of the force, 31.5 Hz to 8 kHz, Hann window over all of it

   Definition: z is the cubic spline through the samples; dS'/ds + S'/l = T(z''(s)), T(c) = tanh(alpha c)/alpha;
   f = d/dt (m v dS/du) + beta1 |v dS/du|. The judge has means over 1/64 sample; their droop is taken out of the spectrum. */
#include <gsl/gsl_fft_real.h>
#include <gsl/gsl_fft_halfcomplex.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_randist.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "numbers.h"

enum { FINE = 64 };
static const double mass = 0.02, leak = 2e-3, from = 5e-3, span = 50e-3;

static void fail(const char *what)
{
    fprintf(stderr, "force_judge: %s\n", what);
    exit(1);
}

/* ------------------------------------------------------------------ profile */

static void profile_write(const char *path, size_t n, double pitch, unsigned long seed)
{
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    double *z = calloc(n, sizeof *z), square = 0;
    gsl_rng_set(r, seed);
    for (size_t k = 1; k < n / 2; k++) {
        double frequency = (double)k / ((double)n * pitch), size = pow(fmax(frequency, 500), -1.3);
        z[2 * k - 1] = size * gsl_ran_gaussian(r, 1);
        z[2 * k] = size * gsl_ran_gaussian(r, 1);
    }
    gsl_fft_halfcomplex_wavetable *table = gsl_fft_halfcomplex_wavetable_alloc(n);
    gsl_fft_real_workspace *space = gsl_fft_real_workspace_alloc(n);
    gsl_fft_halfcomplex_inverse(z, 1, n, table, space);
    for (size_t i = 0; i < n; i++)
        square += z[i] * z[i] / (double)n;
    for (size_t i = 0; i < n; i++)
        z[i] *= 2e-6 / sqrt(square);
    FILE *f = fopen(path, "wb");
    char head[119];
    if (!f)
        fail("cannot write the profile");
    memset(head, ' ', sizeof head);
    int length = snprintf(head, sizeof head, "{'descr': '<f8', 'fortran_order': False, 'shape': (%zu,), }", n);
    head[length] = ' ';
    head[117] = '\n';
    fwrite("\x93NUMPY\1\0\x76\0", 1, 10, f);
    fwrite(head, 1, 118, f);
    fwrite(z, sizeof *z, n, f);
    if (fclose(f))
        fail("cannot write the profile");
}

struct spline {
    size_t n;
    double pitch, *bend; /* z'' at the knots */
};

/* Second derivatives of the interpolating spline, by GSL's tridiagonal solver (mirrored ends: z' = 0). */
static struct spline spline_read(const char *path, double pitch)
{
    FILE *f = fopen(path, "rb");
    if (!f || fseek(f, 0, SEEK_END))
        fail("cannot read the profile");
    size_t n = ((size_t)ftell(f) - 128) / sizeof(double);
    gsl_vector *z = gsl_vector_alloc(n), *diagonal = gsl_vector_alloc(n), *above = gsl_vector_alloc(n - 1), *below = gsl_vector_alloc(n - 1),
               *right = gsl_vector_alloc(n), *bend = gsl_vector_alloc(n);
    fseek(f, 128, SEEK_SET);
    if (fread(z->data, sizeof(double), n, f) != n)
        fail("the profile is short");
    fclose(f);
    for (size_t i = 0; i < n; i++) {
        double left = gsl_vector_get(z, i ? i - 1 : 1), next = gsl_vector_get(z, i + 1 < n ? i + 1 : n - 2);
        gsl_vector_set(diagonal, i, 4);
        gsl_vector_set(right, i, 6 * (left - 2 * gsl_vector_get(z, i) + next) / (pitch * pitch));
        if (i + 1 < n) {
            gsl_vector_set(above, i, i == 0 ? 2 : 1);
            gsl_vector_set(below, i, i == n - 2 ? 2 : 1);
        }
    }
    gsl_linalg_solve_tridiag(diagonal, above, below, right, bend);
    return (struct spline){n, pitch, bend->data};
}

/* ------------------------------------------------------------------ judge */

struct law {
    double v, alpha, beta1, rate, length; /* alpha 0: none; rate 0: constant speed */
};

static double place(const struct law *l, double t)
{
    return l->rate > 0 ? l->length / 2 * (1 - cos(2 * M_PI * l->rate * t)) : l->v * t;
}

static double velocity(const struct law *l, double t)
{
    return l->rate > 0 ? M_PI * l->rate * l->length * sin(2 * M_PI * l->rate * t) : l->v;
}

struct piece {
    const struct spline *s;
    double alpha, start, end, way; /* way: +1, -1 */
};

static double limited(const struct piece *p, double s)
{
    double u = p->start + p->way * s, q = u / p->s->pitch, cell = floor(q), f = q - cell;
    size_t i = (size_t)cell;
    double c = p->s->bend[i] + f * (p->s->bend[i + 1] - p->s->bend[i]);
    return p->alpha > 0 ? tanh(p->alpha * c) / p->alpha : c;
}

static double integrand(double s, void *data)
{
    const struct piece *p = data;
    return limited(p, s) * exp(-(fabs(p->end - p->start) - s) / leak);
}

static gsl_integration_cquad_workspace *space;

/* S' along the way travelled from u0 to u1. */
static double travel(const struct spline *s, const struct law *l, double u0, double u1, double slope)
{
    while (u0 != u1) {
        double way = u1 > u0 ? 1 : -1, q = u0 / s->pitch, knot = (way > 0 ? floor(q + 1e-9) + 1 : ceil(q - 1e-9) - 1) * s->pitch, sum;
        struct piece p = {s, l->alpha, u0, way > 0 ? fmin(knot, u1) : fmax(knot, u1), way};
        gsl_function f = {integrand, &p};
        gsl_integration_cquad(&f, 0, fabs(p.end - p.start), 0, 1e-11, space, &sum, NULL, NULL);
        slope = slope * exp(-fabs(p.end - p.start) / leak) + sum;
        u0 = p.end;
    }
    return slope;
}

/* Means of the force over n intervals of dt from t = 0 on. */
static void judge(const struct spline *s, const struct law *l, size_t n, double dt, double *force)
{
    double slope = 0, momentum = 0;
    for (size_t i = 0; i < n; i++) {
        double t0 = (double)i * dt, t1 = (double)(i + 1) * dt, before = slope, u0 = place(l, t0), u1 = place(l, t1);
        double turn = l->rate > 0 ? (floor(2 * l->rate * t0 + 1e-12) + 1) / (2 * l->rate) : HUGE_VAL, last = u0;
        if (turn > t0 && turn < t1) {
            last = place(l, turn);
            slope = last > u0 ? travel(s, l, u0, last, slope) : -travel(s, l, u0, last, -slope);
        }
        slope = u1 > last ? travel(s, l, last, u1, slope) : u1 < last ? -travel(s, l, last, u1, -slope) : slope;
        double now = mass * velocity(l, t1) * slope;
        force[i] = (now - momentum) / dt + l->beta1 * fabs(velocity(l, (t0 + t1) / 2)) * 0.5 * (fabs(before) + fabs(slope));
        momentum = now;
    }
}

/* ------------------------------------------------------------------ comparison */

/* Spectrum lines 1 / span apart of x at that rate, Hann-windowed; cosine and sine parts of the integral. */
static double *spectrum(const double *x, size_t n)
{
    double *w = malloc(n * sizeof *w);
    for (size_t i = 0; i < n; i++)
        w[i] = x[i] * (1 - cos(2 * M_PI * (double)i / (double)n)) / (double)n;
    gsl_fft_real_wavetable *table = gsl_fft_real_wavetable_alloc(n);
    gsl_fft_real_workspace *work = gsl_fft_real_workspace_alloc(n);
    gsl_fft_real_transform(w, 1, n, table, work);
    return w;
}

static size_t force_read(const char *path, double *x, size_t room)
{
    char line[4096];
    size_t n = 0;
    FILE *f = fopen(path, "r");
    if (!f || !fgets(line, sizeof line, f) || strcmp(line, "force_mean_n\n"))
        fail("the table is not one column force_mean_n");
    while (n < room && fgets(line, sizeof line, f))
        x[n++] = number(line);
    fclose(f);
    return n;
}

/* Fine means belong to the middle of their interval, half an interval after its start: their phase is turned back. */
static double snr(const double *judged, const double *got, size_t n, double rate)
{
    double *a = spectrum(judged, n * FINE), *b = spectrum(got, n), signal = 0, noise = 0, line = rate / (double)n;
    for (size_t k = (size_t)ceil(20 / line); (double)k * line <= 20000 && 2 * k < n; k++) {
        double x = M_PI * (double)k / ((double)n * FINE), droop = sin(x) / x, re = a[2 * k - 1] / droop, im = a[2 * k] / droop;
        double c = cos(x), s = -sin(x), want_re = re * c - im * s, want_im = re * s + im * c;
        signal += want_re * want_re + want_im * want_im;
        noise += pow(want_re - b[2 * k - 1], 2) + pow(want_im - b[2 * k], 2);
    }
    return 10 * log10(signal / noise);
}

/* NAME=NUMBER, back=RATE,LENGTH, alpha=none. */
static void law_option(struct law *l, const char *option)
{
    const struct {
        const char *name;
        double *value;
    } of[] = {{"v=", &l->v}, {"alpha=", &l->alpha}, {"beta1=", &l->beta1}};
    double back[2];
    if (!strcmp(option, "alpha=none"))
        return;
    if (!strncmp(option, "back=", 5)) {
        number_row(option + 5, 2, back);
        l->rate = back[0];
        l->length = back[1];
        return;
    }
    for (int i = 0; i < 3; i++)
        if (!strncmp(option, of[i].name, strlen(of[i].name))) {
            *of[i].value = number(option + strlen(of[i].name));
            return;
        }
    fail("what is this option?");
}

static void compare(int argc, char **argv)
{
    struct law l = {0};
    double rate = number(argv[4]);
    size_t n = (size_t)rint(span * rate), skip = (size_t)rint(from * rate), all = n + skip;
    struct spline s = spline_read(argv[2], number(argv[3]));
    for (int i = 6; i < argc; i++)
        law_option(&l, argv[i]);
    double *fine = malloc(all * FINE * sizeof *fine), *got = malloc((all + 1000) * sizeof *got);
    space = gsl_integration_cquad_workspace_alloc(100);
    judge(&s, &l, all * FINE, 1 / (rate * FINE), fine);
    for (char *path = strtok(argv[5], ":"); path; path = strtok(NULL, ":")) {
        if (force_read(path, got, all + 1000) < all)
            fail("the table is too short");
        printf("%.1f\n", snr(fine + skip * FINE, got + skip, n, rate));
    }
}

/* Centres 10^(k/10) Hz. */
static void bands(double rate, const char *path)
{
    size_t room = 100000000;
    double *x = malloc(room * sizeof *x);
    size_t n = force_read(path, x, room);
    double *w = spectrum(x, n), line = rate / (double)n;
    for (int k = 15; k <= 39; k++) {
        double centre = pow(10, k / 10.0), lo = centre * pow(10, -0.05), hi = centre * pow(10, 0.05), sum = 0;
        for (size_t i = (size_t)ceil(lo / line); (double)i * line < hi && 2 * i < n; i++)
            sum += w[2 * i - 1] * w[2 * i - 1] + w[2 * i] * w[2 * i];
        printf("%.1f %.4f\n", centre, 10 * log10(sum));
    }
}

int main(int argc, char **argv)
{
    if (argc == 6 && !strcmp(argv[1], "profile"))
        profile_write(argv[2], (size_t)number_whole(argv[3]), number(argv[4]), (unsigned long)number_whole(argv[5]));
    else if (argc == 4 && !strcmp(argv[1], "bands"))
        bands(number(argv[2]), argv[3]);
    else if (argc >= 8 && !strcmp(argv[1], "snr"))
        compare(argc, argv);
    else
        fail("see the head of evidence/force_judge.c");
    return 0;
}
