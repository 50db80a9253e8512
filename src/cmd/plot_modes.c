/* Modes: stems of gain over frequency, in decibels below the strongest of all, coloured by the time of decay by 60 dB, T60 = 3 ln 10 / decay; and that time over frequency. */
#include <math.h>

#include "cmd/plot.h"
#include "num/real.h"

#define RANGE 80.0 /* dB that are shown */

struct span {
    double low, high;
};

static double t60(const struct plot_mode *m)
{
    return 3 * real_log(10.0) / m->decay;
}

static double strongest(const struct plot_page *p)
{
    double most = 0;
    for (int i = 0; i < p->n_bodies; i++)
        for (int k = 0; k < p->bodies[i].n; k++)
            most = fmax(most, p->bodies[i].modes[k].gain);
    return most > 0 ? most : 1;
}

static double level(const struct plot_mode *m, double most)
{
    return m->gain > 0 ? 20 * real_log10(m->gain / most) : -HUGE_VAL;
}

static bool shown(const struct plot_mode *m, double most)
{
    return m->frequency > 0 && m->decay > 0 && level(m, most) > -RANGE;
}

/* Least and greatest of what is shown, with a little air. */
static void spans(const struct plot_page *p, double most, struct span *khz, struct span *decay)
{
    *khz = *decay = (struct span){HUGE_VAL, 0};
    for (int i = 0; i < p->n_bodies; i++)
        for (int k = 0; k < p->bodies[i].n; k++) {
            const struct plot_mode *m = &p->bodies[i].modes[k];
            if (!shown(m, most))
                continue;
            khz->low = fmin(khz->low, m->frequency / 1000 / 1.15);
            khz->high = fmax(khz->high, m->frequency / 1000 * 1.15);
            decay->low = fmin(decay->low, t60(m) / 1.1);
            decay->high = fmax(decay->high, t60(m) * 1.1);
        }
    if (khz->high == 0)
        *khz = *decay = (struct span){0.1, 10};
}

/* 1, 2 and 5 of each power of ten within; of a narrow span more. */
static void put_tics(const char *axis, struct span s, FILE *f)
{
    static const double coarse[] = {1, 2, 5}, fine[] = {1, 1.5, 2, 2.5, 3, 4, 5, 6, 7, 8, 9};
    bool narrow = s.high < 6 * s.low;
    const double *steps = narrow ? fine : coarse;
    const char *comma = "";
    fprintf(f, "set logscale %s\nset %stics (", axis, axis);
    for (int power = (int)floor(real_log10(s.low)); power <= (int)floor(real_log10(s.high)); power++)
        for (int k = 0; k < (narrow ? 11 : 3); k++) {
            double at = steps[k] * real_exp10(power);
            if (at < s.low || at > s.high)
                continue;
            fprintf(f, "%s%.6g", comma, at);
            comma = ", ";
        }
    fprintf(f, ")\n");
}

static void data(const struct plot_page *p, double most, FILE *f)
{
    for (int i = 0; i < p->n_bodies; i++) {
        fprintf(f, "$modes%d << END\n", i);
        for (int k = 0; k < p->bodies[i].n; k++) {
            const struct plot_mode *m = &p->bodies[i].modes[k];
            if (shown(m, most))
                fprintf(f, "%.9g %.6g %.6g\n", m->frequency / 1000, level(m, most), t60(m));
        }
        fputs("NaN NaN NaN\nEND\n", f);
    }
}

static const int marks[] = {7, 5, 9, 13};

static void put_name(const struct plot_page *p, int i, struct gnuplot *g)
{
    fputs(p->n_bodies > 1 ? " title " : " notitle ", g->in);
    if (p->n_bodies > 1)
        gnuplot_put_text(g, p->bodies[i].name);
}

/* To where the stems go down: the next 10 dB below the weakest. */
static double bottom(const struct plot_page *p, double most)
{
    double least = -11;
    for (int i = 0; i < p->n_bodies; i++)
        for (int k = 0; k < p->bodies[i].n; k++)
            if (shown(&p->bodies[i].modes[k], most))
                least = fmin(least, level(&p->bodies[i].modes[k], most));
    return 10 * floor(least / 10);
}

static void put_stems(const struct plot_page *p, double from, struct gnuplot *g)
{
    for (int i = 0; i < p->n_bodies; i++) {
        fprintf(g->in, "%s $modes%d using 1:(%g):(0):($2-(%g)):3 with vectors nohead linewidth 1.3 linecolor palette notitle", i ? "," : "plot", i, from, from);
        fprintf(g->in, ", $modes%d using 1:2:3 with points pointtype %d pointsize 0.8 linecolor palette notitle", i, marks[i % 4]);
        fprintf(g->in, ", NaN with points pointtype %d linecolor rgb '#404040'", marks[i % 4]);
        put_name(p, i, g);
    }
    fputc('\n', g->in);
}

void plot_modes(const struct plot_page *p, const struct plot_place *at, struct gnuplot *g)
{
    double most = strongest(p);
    struct span khz, decay;
    spans(p, most, &khz, &decay);
    data(p, most, g->in);
    fprintf(g->in, "set ylabel 'gain / dB re strongest' offset 0,0\nset xlabel 'frequency / kHz'\nset format x '%%g'\nset xrange [%.6g:%.6g]\nset yrange [%g:4]\nset cbrange [%.6g:%.6g]\n", khz.low, khz.high,
            bottom(p, most), decay.low, decay.high);
    put_tics("x", khz, g->in);
    put_tics("cb", decay, g->in);
    fputs("set palette defined (0 '#440154', 1 '#3b528b', 2 '#21918c', 3 '#4db84f', 4 '#b8c31f')\nset cblabel 'T60 / s' offset 0,0\n", g->in);
    fprintf(g->in, "set key at screen %.5f, screen %.5f right bottom\n", at->right, at->top + 3 / at->size[1]);
    fprintf(g->in, "set colorbox user origin screen %.5f, screen %.5f size screen %.5f, screen %.5f\n", at->right + 14 / at->size[0], at->bottom, 14 / at->size[0], at->top - at->bottom);
    put_stems(p, bottom(p, most), g);
    fputs("unset colorbox\nunset logscale\nset xtics autofreq\n", g->in);
}

void plot_modes_decays(const struct plot_page *p, const struct plot_place *at, struct gnuplot *g)
{
    double most = strongest(p);
    struct span khz, decay;
    spans(p, most, &khz, &decay);
    data(p, most, g->in);
    fprintf(g->in, "set ylabel 'T60 / s' offset 0,0\nset xlabel 'frequency / kHz'\nset format x '%%g'\nset xrange [%.6g:%.6g]\nset yrange [%.6g:%.6g]\n", khz.low, khz.high, decay.low, decay.high);
    put_tics("x", khz, g->in);
    put_tics("y", decay, g->in);
    fprintf(g->in, "set key at screen %.5f, screen %.5f right bottom\n", at->right, at->top + 3 / at->size[1]);
    fputs("set grid xtics ytics linecolor rgb '#d8d8d8'\n", g->in);
    for (int i = 0; i < p->n_bodies; i++) {
        fprintf(g->in, "%s $modes%d using 1:3 with points pointtype %d pointsize 0.8 linecolor rgb '%s'", i ? "," : "plot", i, marks[i % 4], plot_panels_colour(i));
        put_name(p, i, g);
    }
    fputs("\nunset logscale\nset xtics autofreq\nset ytics autofreq\nunset grid\n", g->in);
}
