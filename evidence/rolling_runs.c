/* Long runs of rasp's coupled rolling (convolution/coupled.h), as rows of evidence/rolling.md's tables. 20 g; modes from 100 Hz up, T60 = 0.9 s (f/100 Hz)^-0.3.

     ringdown                     49 modes up to 0.49 of the rate of steps ring after the ground has left the ball: |q| against exp(-sigma t), worst of all
     cost                         cycles per step, and times real time, by integrator, ground and steps per sample
     ladder                       a ball dropped 1 mm: force over 30 ms against a reference, dB, and CPU per second, by steps per sample
     chaos TABLE.csv RATE KAPPA MU   a ground from a table of penetration_m, height_m: when a height changed by a part of 1e-15 (1e-12) shows
     trace ...                    the same, as a curve: time, s; greatest difference over the rms
     hash                         of the force of a bouncing ball on 50 moving modes: the same from every build

   The ladder's reference: discrete_gradient at 512 and 1024 steps per sample, extrapolated (it is of order 2). */
#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <x86intrin.h>

#include "convolution/coupled.h"
#include "numbers.h"
#include "scene/scene.h"

enum { MODES = 50 };
#define RATE 44100.0
#define MASS 0.02
#define GRAVITY 9.81

static const char *const names[] = {[INTEGRATOR_DISCRETE_GRADIENT] = "discrete_gradient", [INTEGRATOR_RK4] = "rk4", [INTEGRATOR_EXACT_IMPACT] = "exact_impact"};
static const int integrators[] = {INTEGRATOR_DISCRETE_GRADIENT, INTEGRATOR_RK4, INTEGRATOR_EXACT_IMPACT};
static double frequency[MODES], decay[MODES], phi[MODES];

static void die(const char *what)
{
    fprintf(stderr, "rolling_runs: %s\n", what);
    exit(1);
}

static void modes_make(double highest)
{
    for (int i = 0; i < MODES; i++) {
        frequency[i] = 100 * pow(highest / 100, i / (MODES - 1.0));
        decay[i] = log(1000) / (0.9 * pow(frequency[i] / 100, -0.3));
        phi[i] = 1.4 * sin(0.7 * (i + 1)); /* 1/sqrt(kg) */
    }
}

static struct coupled *ball(struct arena *a, int integrator, double rate, double kappa, double mu, int n)
{
    struct err e = {.kind = ERR_NONE};
    struct coupled *c;
    struct coupled_ask ask = {integrator, 1 / rate, MASS, MASS * GRAVITY, kappa * MASS, mu, n, frequency, decay};
    if (!coupled_make(a, &ask, &c, &e))
        die(e.text);
    return c;
}

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* ------------------------------------------------------------------ ringing */

/* With r = exp(-sigma h), c = cos(omega h), q'' - 2 r c q' + r^2 q = 0 keeps Q = (q'^2 - 2 r c q q' + r^2 q^2) / r^2n. */
static void ringdown(void)
{
    struct arena *a = arena_open();
    struct err e = {.kind = ERR_NONE};
    double last[MODES], first[MODES], force, worst = 0, worst_recurrence = 0, away = -10;
    int n = MODES - 1, steps = (int)RATE / 2;
    modes_make(0.49 * RATE);
    frequency[n - 1] = 0.49 * RATE;
    struct coupled *c = ball(a, INTEGRATOR_DISCRETE_GRADIENT, RATE, 5e9, 1, n);
    coupled_start(c, coupled_rest(c, 0, phi), 0, 0, phi, true);
    double before[MODES];
    for (int k = 0; k < steps; k++) {
        double velocity, q;
        if (!coupled_run(c, 1, &away, NULL, &force, &e))
            die(e.text);
        for (int i = 0; i < n; i++) {
            double r = exp(-decay[i] / RATE), turn = 2 * cos(2 * M_PI * frequency[i] / RATE);
            coupled_mode(c, i, &q, &velocity);
            if (k >= 2) {
                double kept = (q * q - r * turn * last[i] * q + r * r * last[i] * last[i]) * exp(2 * decay[i] * (k - 2) / RATE);
                if (k == 2)
                    first[i] = kept;
                worst = fmax(worst, fabs(sqrt(kept / first[i]) - 1));
                worst_recurrence = fmax(worst_recurrence, fabs(q - r * turn * last[i] + r * r * before[i]) / (sqrt(first[i]) * exp(-decay[i] * (k - 2) / RATE)));
            }
            before[i] = last[i];
            last[i] = q;
        }
    }
    printf("amplitude off exp(-sigma t) by at most %.1e of itself, recurrence of the pole by %.1e, over %d steps, modes up to %.0f Hz at %.0f steps per second\n", worst,
           worst_recurrence, steps, frequency[n - 1], RATE);
    arena_close(a);
}

/* ------------------------------------------------------------------ cost */

static double clock_rate(void)
{
    struct timespec x, y;
    clock_gettime(CLOCK_MONOTONIC, &x);
    uint64_t start = __rdtsc();
    do
        clock_gettime(CLOCK_MONOTONIC, &y);
    while ((double)(y.tv_sec - x.tv_sec) + 1e-9 * (double)(y.tv_nsec - x.tv_nsec) < 0.1);
    return (double)(__rdtsc() - start) / ((double)(y.tv_sec - x.tv_sec) + 1e-9 * (double)(y.tv_nsec - x.tv_nsec));
}

/* Least CPU of nine runs of a quarter of a second of audio over bumps of that height at 300 Hz, begun so far above rest; -1: refused. */
static double run_cost(int integrator, int n, int over, double bump, double up, double *share)
{
    enum { PIECE = 512 };
    static double surface[PIECE], force[PIECE];
    double best = HUGE_VAL, rate = RATE * over;
    for (int k = 0; k < 9; k++) {
        struct arena *a = arena_open();
        struct err e = {.kind = ERR_NONE};
        struct coupled *c = ball(a, integrator, rate, 5e9, 1, n);
        double spent = 0;
        coupled_start(c, coupled_rest(c, 0, phi) + up, 0, 0, n ? phi : NULL, up <= 0);
        for (long done = 0; done < (long)(rate / 4); done += PIECE) {
            for (int i = 0; i < PIECE; i++)
                surface[i] = bump * sin(2 * M_PI * 300 * (double)(done + i + 1) / rate) * sin(2 * M_PI * 7 * (double)(done + i + 1) / rate);
            double start = seconds();
            if (!coupled_run(c, PIECE, surface, NULL, force, &e)) {
                arena_close(a);
                return -1;
            }
            spent += seconds() - start;
        }
        const struct coupled_state *s = coupled_state(c);
        *share = s->contact_time / ((double)s->steps / rate);
        best = fmin(best, spent * rate / (double)s->steps);
        arena_close(a);
    }
    return best;
}

/* The prototype's cycles for 50 standing modes and a ball always in contact, which kept no account: another CPU. */
static void cost(void)
{
    double hertz = clock_rate(), share;
    for (int n = 0; n <= MODES; n += MODES)
        for (int i = 0; i < 3; i++) {
            if (n && integrators[i] == INTEGRATOR_EXACT_IMPACT)
                continue;
            modes_make(n && integrators[i] == INTEGRATOR_RK4 ? 3000 : 15000); /* rk4 refuses higher ones at 1x; its cost does not depend on them */
            printf("| %s, %s |", n ? "50 modes" : "rigid", names[integrators[i]]);
            for (int k = 0; k < 5; k++) {
                int over = k % 2 ? 8 : 1;
                double spent = run_cost(integrators[i], n, over, k < 2 ? 1e-7 : 1e-5, k < 4 ? 0 : 10, &share);
                if (spent < 0)
                    printf(" refused |");
                else
                    printf(" %.0f (%.0f, %.0f %%) |", spent * hertz / (RATE * over), 1 / spent, share * 100);
            }
            printf(n && integrators[i] == INTEGRATOR_DISCRETE_GRADIENT ? " 253 (341 and 41) |\n" : " |\n");
        }
}

/* ------------------------------------------------------------------ accuracy against time */

enum { HEARD = 1323 }; /* samples: 30 ms */

/* Means of the force over samples; CPU seconds, or -1: refused. The drop begins at rest 1 mm above the ground. */
static double drop(int integrator, int n, int over, double kappa, double *mean, char *why)
{
    static double surface[1024], force[1024];
    struct arena *a = arena_open();
    struct err e = {.kind = ERR_NONE};
    struct coupled *c = ball(a, integrator, RATE * over, kappa, 1, n);
    bool good = true;
    coupled_start(c, 1e-3, 0, 0, n ? phi : NULL, false);
    double start = seconds();
    for (int k = 0; k < HEARD && good; k++) {
        good = coupled_run(c, over, surface, NULL, force, &e);
        mean[k] = 0;
        for (int i = 0; i < over; i++)
            mean[k] += force[i] / over;
    }
    double spent = seconds() - start;
    if (!good)
        snprintf(why, 80, "%s", strstr(e.text, "needs") ? "refused: under 12 steps" : strstr(e.text, "decay") ? "refused: damps modes" : "refused: mu too stiff");
    arena_close(a);
    return good ? spent : -1;
}

static double snr(const double *want, const double *got)
{
    double signal = 0, noise = 0;
    for (int k = 0; k < HEARD; k++) {
        signal += want[k] * want[k];
        noise += (want[k] - got[k]) * (want[k] - got[k]);
    }
    return 10 * log10(signal / noise);
}

static void ladder_rows(const char *what, int n, double highest, double kappa)
{
    static double want[HEARD], fine[HEARD], got[HEARD];
    char why[80];
    modes_make(highest);
    drop(INTEGRATOR_DISCRETE_GRADIENT, n, 512, kappa, want, why);
    drop(INTEGRATOR_DISCRETE_GRADIENT, n, 1024, kappa, fine, why);
    for (int k = 0; k < HEARD; k++)
        want[k] = fine[k] + (fine[k] - want[k]) / 3;
    for (int i = 0; i < 3; i++) {
        if (n && integrators[i] == INTEGRATOR_EXACT_IMPACT)
            continue;
        printf("| %s | %s |", what, names[integrators[i]]);
        for (int over = 1; over <= 64; over *= over < 4 ? 2 : 4) {
            double best = HUGE_VAL, spent = 0;
            for (int repeat = 0; repeat < 5 && spent >= 0; repeat++) {
                spent = drop(integrators[i], n, over, kappa, got, why);
                best = fmin(best, spent);
            }
            if (spent < 0)
                printf(" %s |", why);
            else
                printf(" %.1f, %.2f |", snr(want, got), 1e3 * best / (HEARD / RATE));
        }
        puts("");
    }
}

static void ladder(void)
{
    ladder_rows("rigid, kappa 5e9", 0, 100, 5e9);
    ladder_rows("rigid, kappa 5e11", 0, 100, 5e11);
    ladder_rows("50 modes to 3 kHz, 5e9", MODES, 3000, 5e9);
    ladder_rows("50 modes to 15 kHz, 5e9", MODES, 15000, 5e9);
}

/* ------------------------------------------------------------------ chaos */

static double *ground_read(const char *path, long *n)
{
    char line[256];
    long room = 0;
    double *s = NULL;
    FILE *f = fopen(path, "r");
    if (!f || !fgets(line, sizeof line, f) || strcmp(line, "penetration_m,height_m\n") != 0)
        die(path);
    for (*n = 0; fgets(line, sizeof line, f); ++*n) {
        double row[2];
        if (*n == room)
            s = realloc(s, (size_t)(room = 2 * room + 65536) * sizeof *s);
        number_row(line, 2, row);
        s[*n] = row[0] + row[1];
    }
    fclose(f);
    for (long i = *n - 1; i >= 0; i--)
        s[i] -= s[0];
    return s;
}

/* The ball at rest at the start, its height times 1 + change. */
static struct coupled_state roll(int integrator, double rate, double kappa, double mu, const double *s, long n, double change, double *force)
{
    struct arena *a = arena_open();
    struct err e = {.kind = ERR_NONE};
    struct coupled *c = ball(a, integrator, rate, kappa, mu, 0);
    coupled_start(c, coupled_rest(c, s[0], NULL) * (1 + change), 0, s[0], NULL, false);
    for (long i = 0; i + 1 < n; i += 1024)
        if (!coupled_run(c, (int)(n - 1 - i < 1024 ? n - 1 - i : 1024), s + 1 + i, NULL, force + i, &e))
            die(e.text);
    struct coupled_state end = *coupled_state(c);
    arena_close(a);
    return end;
}

/* When two forces differ by a part of `least` of the rms. */
static void apart(const double *x, const double *y, long n, double rate, double least)
{
    double square = 0, most = 0;
    long k = 0;
    for (long i = 0; i < n; i++) {
        square += x[i] * x[i];
        most = fmax(most, fabs(x[i] - y[i]));
    }
    double rms = sqrt(square / (double)n);
    while (k < n && fabs(x[k] - y[k]) <= least * rms)
        k++;
    if (k < n)
        printf(" %.0f ms", 1e3 * (double)k / rate);
    else
        printf(" never (%.0e)", most / rms);
}

/* Greatest difference over the rms, per 20 ms. */
static void trace(const double *x, const double *y, long n, double rate)
{
    double square = 0, most = 0;
    long piece = (long)(20e-3 * rate);
    for (long i = 0; i < n; i++)
        square += x[i] * x[i];
    for (long i = 0; i < n; i++) {
        most = fmax(most, fabs(x[i] - y[i]));
        if (i % piece == piece - 1) {
            printf("%.4g %.3g\n", (double)i / rate, fmax(most / sqrt(square / (double)n), 1e-17));
            most = 0;
        }
    }
}

static void chaos(const char *path, double rate, double kappa, double mu, bool traced)
{
    long n;
    double *s = ground_read(path, &n), *x = calloc((size_t)n, sizeof *x), *y = calloc((size_t)n, sizeof *y);
    struct coupled_state end = roll(INTEGRATOR_DISCRETE_GRADIENT, rate, kappa, mu, s, n, 0, x);
    if (traced) {
        roll(INTEGRATOR_DISCRETE_GRADIENT, rate, kappa, mu, s, n, 1e-15, y);
        trace(x, y, n - 1, rate);
        return;
    }
    printf(" %.3f, %.0f |", end.contact_time / ((double)end.steps / rate), (double)end.lift_offs * rate / (double)end.steps);
    for (int k = 0; k < 2; k++) {
        roll(INTEGRATOR_DISCRETE_GRADIENT, rate, kappa, mu, s, n, k ? 1e-12 : 1e-15, y);
        apart(x, y, n - 1, rate, 0x1p-24);
        printf(",");
        apart(x, y, n - 1, rate, 0.1);
        printf(" |");
    }
    roll(INTEGRATOR_EXACT_IMPACT, rate, kappa, mu, s, n, 0, y);
    apart(x, y, n - 1, rate, 0.1);
    printf(" |\n");
}

/* ------------------------------------------------------------------ the same bits */

static void hash(void)
{
    enum { PIECE = 64, PIECES = 4096 };
    static double surface[PIECE], force[PIECE];
    struct arena *a = arena_open();
    struct err e = {.kind = ERR_NONE};
    uint64_t bits, sum = 14695981039346656037u;
    double sine = 0, cosine = 1;
    for (int i = 0; i < MODES; i++) { /* rational numbers: no libm, whose digits differ by machine */
        frequency[i] = 100 + 11.0 * i * i / 2;
        decay[i] = 7 + i;
        phi[i] = (i % 7 - 3.25) / 3;
    }
    struct coupled *c = ball(a, INTEGRATOR_DISCRETE_GRADIENT, RATE, 5e11, 1, MODES);
    coupled_start(c, coupled_rest(c, 0, phi), 0, 0, phi, true);
    for (int p = 0; p < PIECES; p++) {
        for (int i = 0; i < PIECE; i++) { /* 1 um at about 351 Hz, by a rotation */
            double next = sine + 0.05 * cosine;
            cosine -= 0.05 * next;
            sine = next;
            surface[i] = 1e-6 * sine;
        }
        for (int i = 0; i < MODES; i++)
            phi[i] = (i % 7 - 3.25) / 3 + (p % 128 - 64) / 100.0;
        if (!coupled_run(c, PIECE, surface, phi, force, &e))
            die(e.text);
        for (int i = 0; i < PIECE; i++) {
            memcpy(&bits, &force[i], sizeof bits);
            sum = (sum ^ bits) * 1099511628211u;
        }
    }
    printf("%016llx, %ld lift-offs, energy to %.0e\n", (unsigned long long)sum, coupled_state(c)->lift_offs, fabs(coupled_state(c)->residual) / coupled_state(c)->highest);
    arena_close(a);
}

int main(int argc, char **argv)
{
    if (argc == 2 && !strcmp(argv[1], "ringdown"))
        ringdown();
    else if (argc == 2 && !strcmp(argv[1], "cost"))
        cost();
    else if (argc == 2 && !strcmp(argv[1], "ladder"))
        ladder();
    else if (argc == 6 && (!strcmp(argv[1], "chaos") || !strcmp(argv[1], "trace")))
        chaos(argv[2], number(argv[3]), number(argv[4]), number(argv[5]), argv[1][0] == 't');
    else if (argc == 2 && !strcmp(argv[1], "hash"))
        hash();
    else
        die("see the head of evidence/rolling_runs.c");
    return 0;
}
