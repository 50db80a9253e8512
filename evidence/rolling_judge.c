/* What evidence/rolling.md holds against rasp without a line of rasp's: laws of the contact's duration
   (rolling_closed.h) and statistics of a force.

     laws                         durations and amplitudes of impacts with gravity in the contact, 0.5 mm/s to 1 m/s:
   exponents theta of t0 ~ v^-theta and theta' of t0 ~ A^-theta', by regression of the logarithms over speeds even in
   their logarithm; rows per range curve KAPPA MU               speed, duration with and without gravity shapes raised
   cosines (papers/002, equation 9) fitted to such impacts: R^2 peaks FORCE.csv RATE PART       one column force_mean_n:
   mean force, peaks per second, correlation of amplitude and interval; then of the intervals (ms) and of the amplitudes
   (over the greatest) mean, deviation, correlation of neighbours, a1, b1, sigma (papers/002, section IV) landings
   TABLE.csv RATE      columns penetration_m, height_m: closing speeds of the landings, one per line (m/s) contacts
   TABLE.csv RATE      columns force_mean_n, penetration_m: durations t0 and amplitudes A of the contacts; theta' of t0
   ~ A^-theta' and its R^2 (logarithms), R^2 of t0 = zeta' A^-0.29 with zeta' by least squares, and their number spread
   of lines "speed" on the standard input: number, mean, deviation, quantiles and greatest

   A peak is a local maximum that stands out by PART of the mean force on both sides. */
#include <stdbool.h>
#include <string.h>

#include <gsl/gsl_multimin.h>
#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics_double.h>

#include "numbers.h"
#include "rolling_closed.h"

#define GRAVITY 9.81

static void die(const char *what)
{
    fprintf(stderr, "rolling_judge: %s\n", what);
    exit(1);
}

/* ------------------------------------------------------------------ laws */

enum { SPEEDS = 57, SETS = 10 };

static const double kappas[] = {1e9, 5e9, 1e10}, mus[] = {0.5, 1, 2}; /* papers/002, fig. 4 */

struct row {
    double v[SPEEDS], time[SPEEDS], peak[SPEEDS], bare[SPEEDS]; /* m/s; s; m/s^2; s without gravity */
};

static void row_make(struct row *r, double kappa, double mu)
{
    for (int i = 0; i < SPEEDS; i++) {
        r->v[i] = 5e-4 * pow(2000, i / (SPEEDS - 1.0));
        struct closed_impact o = closed_impact(kappa, mu, GRAVITY, r->v[i], 0);
        r->time[i] = o.duration;
        r->peak[i] = o.peak;
        r->bare[i] = closed_time(kappa, mu, r->v[i]);
    }
}

struct line {
    double power, r2;
};

static struct line line_fit(const struct row *r, const double *x, const double *y, double low, double high)
{
    double sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0, n = 0;
    for (int i = 0; i < SPEEDS; i++)
        if (r->v[i] >= low * 0.999 && r->v[i] <= high * 1.001 && y[i] > 0) {
            double a = log(x[i]), b = log(y[i]);
            n++, sx += a, sy += b, sxx += a * a, sxy += a * b, syy += b * b;
        }
    double cross = n * sxy - sx * sy;
    return (struct line){-cross / (n * sxx - sx * sx), cross * cross / ((n * sxx - sx * sx) * (n * syy - sy * sy))};
}

struct range {
    struct line low, high;
};

static void widen(struct range *g, struct line l, bool first)
{
    if (first) g->low = g->high = l;
    g->low = (struct line){fmin(g->low.power, l.power), fmin(g->low.r2, l.r2)};
    g->high = (struct line){fmax(g->high.power, l.power), fmax(g->high.r2, l.r2)};
}

static void laws(void)
{
    static struct row rows[SETS];
    const double ranges[][2] = {{1e-3, 0.05}, {2e-3, 0.05}, {5e-3, 0.05}, {0.01, 0.05}, {1e-3, 0.1},
                                {1e-3, 0.2},  {1e-3, 0.5},  {1e-3, 1},    {0.01, 1}};
    for (int k = 0; k < 9; k++)
        row_make(&rows[k], kappas[k / 3], mus[k % 3]);
    row_make(&rows[9], 2e9, 1); /* section IV-E */
    for (size_t g = 0; g < sizeof ranges / sizeof ranges[0]; g++) {
        struct range bare, heavy, force;
        for (int k = 0; k < 9; k++) {
            widen(&bare, line_fit(&rows[k], rows[k].v, rows[k].bare, ranges[g][0], ranges[g][1]), k == 0);
            widen(&heavy, line_fit(&rows[k], rows[k].v, rows[k].time, ranges[g][0], ranges[g][1]), k == 0);
            widen(&force, line_fit(&rows[k], rows[k].peak, rows[k].time, ranges[g][0], ranges[g][1]), k == 0);
        }
        struct line one = line_fit(&rows[9], rows[9].v, rows[9].time, ranges[g][0], ranges[g][1]);
        struct line two = line_fit(&rows[9], rows[9].peak, rows[9].time, ranges[g][0], ranges[g][1]);
        printf("| %g to %g cm/s | %.3f to %.3f, %.3f | %.3f to %.3f, %.3f | %.3f, %.3f | %.3f to %.3f, %.3f | %.3f, "
               "%.3f |\n",
               ranges[g][0] * 100, ranges[g][1] * 100, bare.low.power, bare.high.power, bare.low.r2, heavy.low.power,
               heavy.high.power, heavy.low.r2, one.power, one.r2, force.low.power, force.high.power, force.low.r2,
               two.power, two.r2);
    }
}

static void curve(double kappa, double mu)
{
    static struct row r;
    row_make(&r, kappa, mu);
    for (int i = 0; i < SPEEDS; i++)
        printf("%.6g %.6g %.6g\n", r.v[i], r.time[i], r.bare[i]);
}

/* ------------------------------------------------------------------ shapes */

enum { POINTS = 400 };

static double cosine_at(double t, double centre, double duration)
{
    double x = (t - centre) / duration;
    return fabs(x) < 0.5 ? 0.5 * (1 + cos(2 * M_PI * x)) : 0;
}

/* 1 - left over / variance, amplitude by least squares unless given. */
static double cosine_r2(const struct closed_impact *o, double centre, double duration, double amplitude)
{
    double wf = 0, ww = 0, left = 0;
    for (int i = 0; i < o->n; i++) {
        double w = cosine_at(o->t[i], centre, duration);
        wf += w * o->f[i];
        ww += w * w;
    }
    if (isnan(amplitude)) amplitude = wf / ww;
    for (int i = 0; i < o->n; i++)
        left += pow(o->f[i] - amplitude * cosine_at(o->t[i], centre, duration), 2);
    return 1 - left / (gsl_stats_variance(o->f, 1, (size_t)o->n) * (o->n - 1));
}

static double cosine_loss(const gsl_vector *p, void *data)
{
    const struct closed_impact *o = data;
    return -cosine_r2(o, gsl_vector_get(p, 0) * o->duration, fabs(gsl_vector_get(p, 1)) * o->duration, NAN);
}

/* Centre, duration and amplitude free. */
static double cosine_best(struct closed_impact *o)
{
    gsl_vector *at = gsl_vector_alloc(2), *step = gsl_vector_alloc(2);
    gsl_vector_set(at, 0, 0.5), gsl_vector_set(at, 1, 1), gsl_vector_set_all(step, 0.1);
    gsl_multimin_function f = {cosine_loss, 2, o};
    gsl_multimin_fminimizer *m = gsl_multimin_fminimizer_alloc(gsl_multimin_fminimizer_nmsimplex2, 2);
    gsl_multimin_fminimizer_set(m, &f, at, step);
    for (int i = 0; i < 200 && gsl_multimin_fminimizer_size(m) > 1e-6; i++)
        gsl_multimin_fminimizer_iterate(m);
    double r2 = -gsl_multimin_fminimizer_minimum(m);
    gsl_multimin_fminimizer_free(m);
    gsl_vector_free(at), gsl_vector_free(step);
    return r2;
}

static void shapes(void)
{
    const double speeds[] = {0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.2, 1};
    for (size_t s = 0; s < sizeof speeds / sizeof speeds[0]; s++) {
        double low[4] = {2, 2, 2, 2}, high[4] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
        int stay = 0;
        for (int k = 0; k < 18; k++) {
            int g = k % 2;
            struct closed_impact o = closed_impact(kappas[k / 6], mus[k / 2 % 3], g * GRAVITY, speeds[s], POINTS);
            if (!o.t) {
                stay++;
                continue;
            }
            double found[2] = {cosine_r2(&o, o.duration / 2, o.duration, o.peak), cosine_best(&o)};
            for (int i = 0; i < 2; i++) {
                low[2 * g + i] = fmin(low[2 * g + i], found[i]);
                high[2 * g + i] = fmax(high[2 * g + i], found[i]);
            }
            free(o.t), free(o.f);
        }
        printf("| %g cm/s |", speeds[s] * 100);
        for (int i = 0; i < 4; i++)
            printf(" %.3f to %.3f |", low[i], high[i]);
        printf(" %d |\n", stay);
    }
}

/* ------------------------------------------------------------------ tables */

struct table {
    long n;
    double *a, *b;
};

static struct table csv_table_read(const char *path, const char *head)
{
    char line[256];
    long room = 0;
    int columns = strchr(head, ',') ? 2 : 1;
    struct table t = {0};
    FILE *f = fopen(path, "r");
    if (!f || !fgets(line, sizeof line, f) || strncmp(line, head, strlen(head)) != 0) die(path);
    while (fgets(line, sizeof line, f)) {
        double row[2] = {0};
        if (t.n == room) {
            room = 2 * room + 65536;
            t.a = realloc(t.a, (size_t)room * sizeof *t.a);
            t.b = realloc(t.b, (size_t)room * sizeof *t.b);
        }
        number_row(line, columns, row);
        t.a[t.n] = row[0];
        t.b[t.n++] = row[1];
    }
    fclose(f);
    return t;
}

/* Peaks by prominence: up by `least` from the valley before, then down by `least`. Returns their number. */
static long peaks_find(const double *f, long n, double least, double *when, double *height)
{
    long count = 0, best = 0;
    double valley = f[0];
    bool rising = false;
    for (long i = 1; i < n; i++) {
        if (rising && f[i] > f[best]) best = i;
        if (rising && f[i] < f[best] - least) {
            when[count] = (double)best;
            height[count++] = f[best];
            rising = false;
            valley = f[i];
        }
        valley = fmin(valley, f[i]);
        if (!rising && f[i] > valley + least) {
            rising = true;
            best = i;
        }
    }
    return count;
}

/* Mean, deviation, and a1, b1, sigma of the process x_n + a1 x_(n-1) = e_n + b1 e_(n-1) (equation 13, p = q = 1), e of
   deviation sigma, from the correlations r1, r2 of neighbours and next but one: a1 = -r2/r1, b1 the root within the
   unit circle of (r1 + a1)(1 + b1^2) = (1 + 2 r1 a1 + a1^2) b1. */
static void series(const double *x, size_t n)
{
    double r1 = gsl_stats_correlation(x, 1, x + 1, 1, n - 1), r2 = gsl_stats_correlation(x, 1, x + 2, 1, n - 2),
           sd = gsl_stats_sd(x, 1, n);
    double a = -r2 / r1, half = (1 + 2 * r1 * a + a * a) / (2 * (r1 + a)),
           b = fabs(half) > 1 ? half - copysign(sqrt(half * half - 1), half) : NAN;
    printf(" %.3f %.3f %.3f %.2f %.2f %.3f", gsl_stats_mean(x, 1, n), sd, r1, a, b,
           sd * sqrt((1 - a * a) / (1 - 2 * a * b + b * b)));
}

static void peaks(const char *path, double rate, double part)
{
    struct table t = csv_table_read(path, "force_mean_n\n");
    long skip = (long)(0.05 * rate); /* the force rises and falls at the ends */
    double *f = t.a + skip, mean;
    t.n -= 2 * skip;
    mean = gsl_stats_mean(f, 1, (size_t)t.n);
    double *when = malloc((size_t)t.n * sizeof *when), *height = malloc((size_t)t.n * sizeof *height);
    long count = peaks_find(f, t.n, part * mean, when, height);
    printf("%.5f %.1f", mean, (double)count * rate / (double)t.n);
    if (count < 10) {
        puts(" - - - - - - - - - - -");
        return;
    }
    size_t m = (size_t)count - 1;
    for (size_t i = 0; i < m; i++)
        when[i] = (when[i + 1] - when[i]) / rate * 1e3;
    double most = gsl_stats_max(height, 1, m);
    for (size_t i = 0; i < m; i++)
        height[i] /= most;
    printf(" %.3f", gsl_stats_correlation(height, 1, when, 1, m));
    series(when, m);
    series(height, m);
    puts("");
}

static void landings(const char *path, double rate)
{
    struct table t = csv_table_read(path, "penetration_m,height_m\n");
    for (long i = 1; i < t.n; i++)
        if (t.a[i - 1] <= 0 && t.a[i] > 0) printf("%.6g\n", (t.a[i] - t.a[i - 1]) * rate);
}

/* Ends by linear crossing; a contact of less than four samples has no amplitude. */
static void contacts(const char *path, double rate)
{
    struct table t = csv_table_read(path, "force_mean_n,penetration_m\n");
    double begun = NAN, most = 0, sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0, wt = 0, ww = 0, st = 0, stt = 0, n = 0;
    for (long i = 1; i < t.n; i++) {
        double before = t.b[i - 1], after = t.b[i], at = (double)(i - 1) + before / (before - after);
        if (before <= 0 && after > 0) {
            begun = at;
            most = 0;
        }
        most = fmax(most, t.a[i]);
        if (before > 0 && after <= 0 && at - begun >= 4) {
            double time = (at - begun) / rate, x = log(most), y = log(time), w = pow(most, -0.29);
            n++, sx += x, sy += y, sxx += x * x, sxy += x * y, syy += y * y, wt += w * time, ww += w * w, st += time,
                stt += time * time;
        }
    }
    if (n < 10) {
        puts("- - - 0");
        return;
    }
    double cross = n * sxy - sx * sy, all = stt - st * st / n, left = stt - wt * wt / ww;
    printf("%.3f %.3f %.3f %.0f\n", -cross / (n * sxx - sx * sx),
           cross * cross / ((n * sxx - sx * sx) * (n * syy - sy * sy)), 1 - left / all, n);
}

static void spread(void)
{
    size_t n = 0, room = 0;
    double *v = NULL, x;
    while (scanf("%lf", &x) == 1) {
        if (n == room) v = realloc(v, (room = 2 * room + 65536) * sizeof *v);
        v[n++] = x;
    }
    if (!feof(stdin)) die("standard input holds what is no number");
    if (n < 2) {
        printf("%zu - - - - - -\n", n);
        return;
    }
    gsl_sort(v, 1, n);
    printf("%zu %.4g %.4g %.4g %.4g %.4g %.4g\n", n, gsl_stats_mean(v, 1, n), gsl_stats_sd(v, 1, n),
           gsl_stats_quantile_from_sorted_data(v, 1, n, 0.5), gsl_stats_quantile_from_sorted_data(v, 1, n, 0.99),
           gsl_stats_quantile_from_sorted_data(v, 1, n, 0.999), v[n - 1]);
}

int main(int argc, char **argv)
{
    if (argc == 2 && !strcmp(argv[1], "laws"))
        laws();
    else if (argc == 4 && !strcmp(argv[1], "curve"))
        curve(number(argv[2]), number(argv[3]));
    else if (argc == 2 && !strcmp(argv[1], "shapes"))
        shapes();
    else if (argc == 5 && !strcmp(argv[1], "peaks"))
        peaks(argv[2], number(argv[3]), number(argv[4]));
    else if (argc == 4 && !strcmp(argv[1], "landings"))
        landings(argv[2], number(argv[3]));
    else if (argc == 4 && !strcmp(argv[1], "contacts"))
        contacts(argv[2], number(argv[3]));
    else if (argc == 2 && !strcmp(argv[1], "spread"))
        spread();
    else
        die("see the head of evidence/rolling_judge.c");
    return 0;
}
