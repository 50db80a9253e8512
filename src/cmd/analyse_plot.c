/* The plots of `rasp analyse`, after the figures of papers/002:

     correlations   left the series: amplitude with interval, amplitude, interval (figure 4); right the whitened ones (figures 6 and 8), with the bounds
                    that 95 % of the lags of white noise keep to
     distributions  above of the whitened series, with the normal density of the same deviation (figure 9); below of the series itself, also with an exponential
                    and a gamma density where these are nearer than the normal one
     duration       over amplitude, both logarithmic, with the law (equation 12)
     shape          the mean impact, with the raised cosine (equation 9) and the Meixner window fitted to it */
#include <gsl/gsl_randist.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "cmd/analyse.h"
#include "num/real.h"
#include "output/mark.h"
#include "output/picture.h"

enum { BARS = 40 };

#define BLUE "#0072b2"
#define RED "#d55e00"
#define GREEN "#009e73"

struct picture {
    const struct analysis *a;
    bool svg;
};

static void head(const struct picture *p, const char *size, struct gnuplot *g)
{
    fprintf(g->in, p->svg ? "set terminal svg size %s font 'DejaVu Sans,13' background rgb 'white'\n"
                          : "set terminal pngcairo size %s font 'DejaVu Sans,10' background rgb 'white'\n", size);
    fputs("set encoding utf8\nset border linewidth 0.8\nset tics out nomirror scale 0.6\nset style fill solid 1.0 noborder\n"
          "set key noenhanced top right samplen 2 spacing 1.1\n", g->in);
}

static void title(const struct picture *p, const char *what, struct gnuplot *g)
{
    fputs("set title ", g->in);
    gnuplot_put_text(g, arena_format(p->a->arena, "%s: %s", p->a->source.file, what));
    fputs(" noenhanced\n", g->in);
}

/* ------------------------------------------------------------------ correlations */

static void correlation(const char *what, const double *x, int first, double bound, struct gnuplot *g)
{
    int n = first < 0 ? 2 * STATISTICS_LAGS - 1 : STATISTICS_LAGS;
    fputs("$x << END\n", g->in);
    for (int i = 0; i < n; i++)
        fprintf(g->in, "%d %.9g\n", first + i, x[i]);
    fprintf(g->in, "END\nset title '%s'\nset xrange [%d:%d]\n", what, first < 0 ? first : -1, STATISTICS_LAGS - 1);
    if (bound > 0)
        fprintf(g->in, "set arrow 1 from graph 0, first %.6g to graph 1, first %.6g nohead dashtype 3 linecolor rgb '#888888'\n"
                       "set arrow 2 from graph 0, first %.6g to graph 1, first %.6g nohead dashtype 3 linecolor rgb '#888888'\n", bound, bound, -bound, -bound);
    fputs("plot $x with impulses linewidth 1.6 linecolor rgb '" BLUE "' notitle\nunset arrow\n", g->in);
}

static void draw_correlations(void *self, struct gnuplot *g)
{
    const struct picture *p = self;
    const struct impact_statistics *t = &p->a->statistics;
    double bound = 1.96 / sqrt(t->n);
    head(p, "1000,900", g);
    fputs("set multiplot layout 3,2 title ", g->in);
    gnuplot_put_text(g, arena_format(p->a->arena, "%s: correlations over lags", p->a->source.file));
    fputs(" noenhanced\nset yrange [-1:1.05]\nset xzeroaxis linetype 1 linewidth 0.5 linecolor rgb '#888888'\n", g->in);
    correlation("amplitude with interval", t->cross, 1 - STATISTICS_LAGS, 0, g);
    correlation("whitened amplitude with interval", t->white_cross, 1 - STATISTICS_LAGS, bound, g);
    for (int k = 0; k < STATISTICS_SERIES; k++) {
        correlation(analyse_series_names[k], t->series[k].correlation, 0, 0, g);
        correlation(k ? "whitened interval" : "whitened amplitude", t->series[k].white_correlation, 0, bound, g);
    }
    fputs("unset multiplot\n", g->in);
}

/* ------------------------------------------------------------------ distributions */

struct values {
    const double *x;
    int n;
    double mean, deviation, unit; /* unit: what is drawn for 1 */
    const struct distribution_fits *fits;
};

/* at, bar, normal, exponential and gamma density, over 4 deviations to each side of the mean */
static void distribution_rows(const struct values *v, struct gnuplot *g)
{
    double sd = v->deviation, step = 8 * sd / BARS, count[BARS] = {0};
    const struct distribution_fits *f = v->fits;
    for (int i = 0; i < v->n; i++) {
        double at = floor((v->x[i] - v->mean) / step + BARS / 2.0);
        if (at >= 0 && at < BARS)
            count[(int)at]++;
    }
    fputs("$x << END\n", g->in);
    for (int i = 0; i < BARS; i++) {
        double d = (i - BARS / 2.0 + 0.5) * step, at = v->mean + d;
        double exponential = at > 0 ? real_exp(-at / f->exponential_mean) / f->exponential_mean : 0;
        double gamma = at > 0 && f->gamma_shape > 0 ? gsl_ran_gamma_pdf(at, f->gamma_shape, f->gamma_scale) : 0;
        fprintf(g->in, "%.9g %.9g %.9g %.9g %.9g\n", at * v->unit, count[i] / v->n / step / v->unit, real_exp(-0.5 * d * d / sd / sd) / sd / sqrt(2 * REAL_PI) / v->unit,
                exponential / v->unit, gamma / v->unit);
    }
    fputs("END\n", g->in);
}

static void distribution(const struct values *v, const char *what, const char *unit, bool white, struct gnuplot *g)
{
    const struct distribution_fits *f = v->fits;
    double low = v->mean - 4 * v->deviation, high = v->mean + 4 * v->deviation;
    distribution_rows(v, g);
    fprintf(g->in, "set xlabel '%s%s / %s'\nset ylabel 'density / (1/%s)'\nset xrange [%.9g:%.9g]\nset yrange [0:*]\nset boxwidth %.9g\n", white ? "whitened " : "", what, unit,
            unit, low * v->unit, high * v->unit, 0.92 * (high - low) / BARS * v->unit);
    fprintf(g->in, "set title 'normal: R² %.3f, Kolmogorov''s distance %.3f' noenhanced\n", f->gaussian_r2, f->gaussian_distance);
    fputs("plot $x using 1:2 with boxes linecolor rgb '#9ecae1' notitle, '' using 1:3 smooth csplines linewidth 2 linecolor rgb '" RED "' title 'normal'", g->in);
    if (!white && f->exponential_distance < f->gaussian_distance)
        fprintf(g->in, ", '' using 1:4 with lines linewidth 2 linecolor rgb '" BLUE "' title 'exponential, distance %.3f'", f->exponential_distance);
    if (!white && f->gamma_distance < f->gaussian_distance) /* NAN: none */
        fprintf(g->in, ", '' using 1:5 with lines linewidth 2 linecolor rgb '" GREEN "' title 'gamma, distance %.3f'", f->gamma_distance);
    fputc('\n', g->in);
}

static double spread(double deviation)
{
    return deviation > 0 ? deviation : 1;
}

static const double *intervals(const struct analysis *a)
{
    const struct impact_events *v = &a->source.found.events;
    double *x = ARENA_TAKE(a->arena, double, v->n);
    for (int i = 0; i + 1 < v->n; i++)
        x[i] = v->time[i + 1] - v->time[i];
    return x;
}

static void draw_distributions(void *self, struct gnuplot *g)
{
    const struct picture *p = self;
    const struct impact_statistics *t = &p->a->statistics;
    const double *itself[STATISTICS_SERIES] = {t->demodulated, intervals(p->a)};
    head(p, "1000,840", g);
    fputs("set multiplot layout 2,2 title ", g->in);
    gnuplot_put_text(g, arena_format(p->a->arena, "%s: distributions", p->a->source.file));
    fputs(" noenhanced\n", g->in);
    for (int panel = 0; panel < 2 * STATISTICS_SERIES; panel++) {
        int k = panel % STATISTICS_SERIES;
        bool white = panel < STATISTICS_SERIES;
        const struct series_statistics *s = &t->series[k];
        struct values v = {white ? t->white[k] : itself[k], white || k ? t->n - 1 : t->n, white ? 0 : s->mean.value,
                           spread(white ? s->deviation.value : sqrt(s->variance)), k ? 1e3 : 1, white ? &s->white : &s->itself};
        distribution(&v, analyse_series_names[k], k ? "ms" : "N", white, g);
    }
    fputs("unset multiplot\n", g->in);
}

/* ------------------------------------------------------------------ duration */

static void points(const char *name, const struct impact_events *v, struct gnuplot *g)
{
    fprintf(g->in, "$%s << END\n", name);
    for (int i = 0; i < v->n; i++)
        if (v->duration[i] > 0 && v->amplitude[i] != 0)
            fprintf(g->in, "%.9g %.9g\n", fabs(v->amplitude[i]), 1e3 * v->duration[i]);
    fputs("END\n", g->in);
}

static void draw_duration(void *self, struct gnuplot *g)
{
    const struct picture *p = self;
    const struct analysis *a = p->a;
    const struct impact_duration *d = &a->duration;
    head(p, "760,560", g);
    title(p, "durations", g);
    points("series", &a->source.found.events, g);
    if (a->single.file)
        points("single", &a->single.found.events, g);
    fprintf(g->in, "set logscale xy\nset xlabel 'amplitude A / N'\nset ylabel 'duration / ms'\nset samples 500\n"
                   "plot $series with points pointtype 7 pointsize 0.35 linecolor rgb '" BLUE "' title 'impacts'");
    if (a->single.file)
        fprintf(g->in, ", $single with points pointtype 6 pointsize 0.7 linecolor rgb '" GREEN "' title 'single impacts', "
                       "%.9g*x**(-(%.9g)) with lines linewidth 1 dashtype 2 linecolor rgb '" GREEN "' title 'step 1'", 1e3 * d->zeta_single, d->theta_single);
    fprintf(g->in, ", %.9g*x**(-%.9g) with lines linewidth 2 linecolor rgb '" RED "' title '%.4g ms A^-%.3f'\n", 1e3 * d->zeta, d->theta, 1e3 * d->zeta,
            d->theta);
}

/* ------------------------------------------------------------------ shape */

static void draw_shape(void *self, struct gnuplot *g)
{
    const struct picture *p = self;
    const struct impact_shape *h = &p->a->shape;
    head(p, "760,560", g);
    title(p, arena_format(p->a->arena, "mean of %ld impacts", h->fitted), g);
    fputs("$x << END\n", g->in);
    for (int j = 0; j < IMPACT_SHAPE_POINTS; j++)
        fprintf(g->in, "%.9g %.9g %.9g %.9g %.9g %.9g\n", h->q[j], h->mean[j], h->mean[j] - h->deviation[j], h->mean[j] + h->deviation[j], h->model[0][j],
                h->model[1][j]);
    fprintf(g->in, "END\nset xlabel 'time from the maximum / duration'\nset ylabel 'force / amplitude'\nset xrange [-0.75:0.75]\nset yrange [-0.1:1.15]\n"
                   "plot $x using 1:3:4 with filledcurves fillcolor rgb '#cfe3f1' title '± 1 standard deviation', '' using 1:2 with lines linewidth 2.5 linecolor "
                   "rgb '" BLUE "' title 'mean', '' using 1:5 with lines linewidth 2 dashtype 2 linecolor rgb '" RED "' title 'raised cosine, R² of the mean %.4f', "
                   "'' using 1:6 with lines linewidth 2 dashtype 4 linecolor rgb '" GREEN "' title 'Meixner window, R² of the mean %.4f'\n",
            h->of_mean[0].r2, h->of_mean[1].r2);
}

/* ------------------------------------------------------------------ files */

/* What the files' names begin with. */
static const char *prefix_of(const struct analysis *a, const char *prefix)
{
    struct stat s;
    size_t n = strlen(prefix);
    const char *slash = strrchr(a->source.file, '/'), *name = slash ? slash + 1 : a->source.file, *dot = strrchr(name, '.');
    if (!(n > 0 && prefix[n - 1] == '/') && (stat(prefix, &s) != 0 || !S_ISDIR(s.st_mode)))
        return prefix;
    return arena_format(a->arena, "%s%s%.*s", prefix, n > 0 && prefix[n - 1] == '/' ? "" : "/", (int)(dot ? dot - name : (long)strlen(name)), name);
}

bool analyse_plot(struct analysis *a, const char *prefix, bool svg, struct analyse_files *to, struct err *e)
{
    struct picture p = {a, svg};
    const struct {
        const char *name;
        void (*draw)(void *, struct gnuplot *);
        bool there;
    } all[] = {{"correlations", draw_correlations, true},
               {"distributions", draw_distributions, true},
               {"duration", draw_duration, a->lasts},
               {"shape", draw_shape, a->shape.fitted > 0}};
    prefix = prefix_of(a, prefix);
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        const char *file = arena_format(a->arena, "%s.%s.%s", prefix, all[i].name, svg ? "svg" : "png");
        if (!all[i].there)
            continue;
        if (!mark_permits(file, NULL, a->force, e) || !picture_draw(&to->o[to->n], file, svg, all[i].draw, &p, e))
            return false;
        to->name[to->n++] = file;
    }
    return true;
}
