/* The picture of `rasp modes extract`, of the first place's loudest strike: above the spectrum of its sound with its
   modes' (of each column of the picture the greatest) and of what is left, and each mode as a stem: the height that it
   has at its frequency, |A|/(2 decay), with two standard errors; below levels over time, and decays over frequency. */
#include <math.h>
#include <string.h>

#include "cmd/modes_extract.h"
#include "num/fft.h"
#include "num/real.h"

#define BLUE "#0072b2"
#define RED "#d55e00"
#define GREY "#888888"

enum { COLUMNS = 900, POINTS = 700 };

/* The strike's sound from the hammer's end on, what the modes make of it, and what they leave. */
struct shown {
    const double *y[3];
    long n;
};

static struct shown shown(const struct modes_extract *x, struct arena *a)
{
    int s = x->place[0].shown_stretch;
    const struct modal_stretch *st = &x->data.stretch[s];
    double *rest = ARENA_TAKE(a, double, st->n);
    for (long i = 0; i < st->n; i++)
        rest[i] = st->y[i] - x->found.model[s][i];
    return (struct shown){{st->y + st->ringing, x->found.model[s] + st->ringing, rest + st->ringing},
                          st->n - st->ringing};
}

/* |X|^2 of y[n] in unit^2 s^2: [size/2 + 1]. */
static double *spectrum(const struct modes_extract *x, const double *y, long n, long size, struct arena *a)
{
    double *re = ARENA_TAKE(a, double, size / 2 + 1), *im = ARENA_TAKE(a, double, size / 2 + 1),
           *padded = ARENA_TAKE(a, double, size);
    struct fft *fft = fft_open((size_t)size);
    memcpy(padded, y, (size_t)n * sizeof *y);
    fft_forward(fft, padded, re, im);
    fft_close(fft);
    for (long i = 0; i <= size / 2; i++)
        re[i] = (re[i] * re[i] + im[i] * im[i]) / (x->rate * x->rate);
    return re;
}

static double decibel(double power) { return power > 0.0 ? 10.0 * real_log10(power) : -400.0; }

/* The greatest of a column's bins: lines stay as high as they are. */
static void spectra(const struct modes_extract *x, const struct shown *p, double low, double high, struct gnuplot *g)
{
    struct arena *a = arena_open();
    long size = (long)fft_good_size((size_t)(2 * p->n));
    const double *s[3] = {spectrum(x, p->y[0], p->n, size, a), spectrum(x, p->y[1], p->n, size, a),
                          spectrum(x, p->y[2], p->n, size, a)};
    fputs("$s << END\n", g->in);
    for (int c = 0; c < COLUMNS; c++) {
        double at[2] = {low * real_pow(high / low, (double)c / COLUMNS),
                        low * real_pow(high / low, (c + 1.0) / COLUMNS)},
               most[3] = {0};
        long from = (long)(at[0] / x->rate * (double)size), to = (long)(at[1] / x->rate * (double)size);
        for (long i = from; i <= to && i <= size / 2; i++)
            for (int k = 0; k < 3; k++)
                most[k] = fmax(most[k], s[k][i]);
        fprintf(g->in, "%.6g %.5g %.5g %.5g\n", sqrt(at[0] * at[1]), decibel(most[0]), decibel(most[1]),
                decibel(most[2]));
    }
    fputs("END\n", g->in);
    arena_close(a);
}

static double square(double v) { return v * v; }

static void stems(const struct modes_extract *x, struct gnuplot *g)
{
    fputs("$m << END\n", g->in);
    for (int i = 0; i < x->components; i++) {
        const struct modes_extract_mode *m = &x->heard[i];
        double gain = sqrt(m->re[0] * m->re[0] + m->im[0] * m->im[0]),
               height = decibel(gain * gain / (4.0 * m->decay * m->decay));
        double off = 2.0 * sqrt(square(m->gain_se[0] / gain) + square(m->decay_se / m->decay)),
               t60 = 3.0 * real_log(10.0) / m->decay;
        fprintf(g->in, "%.7g %.5g %.5g %.5g %.5g %.5g %.5g\n", m->frequency, height,
                height + 20.0 * real_log10(fmax(1.0 - off, 1e-3)), height + 20.0 * real_log10(1.0 + off), t60,
                t60 / (1.0 + 2.0 * m->decay_se / m->decay), t60 / fmax(1.0 - 2.0 * m->decay_se / m->decay, 0.01));
    }
    fputs("END\n", g->in);
}

static double level(const double *x, long from, long to)
{
    double sum = 0.0;
    for (long i = from; i < to; i++)
        sum += x[i] * x[i];
    return decibel(sum / (double)(to - from));
}

static void levels(const struct modes_extract *x, const struct shown *p, struct gnuplot *g)
{
    long step = p->n / POINTS > 16 ? p->n / POINTS : 16;
    fputs("$l << END\n", g->in);
    for (long i = 0; i + step <= p->n; i += step)
        fprintf(g->in, "%.6g %.5g %.5g %.5g\n", ((double)i + 0.5 * (double)step) / x->rate, level(p->y[0], i, i + step),
                level(p->y[1], i, i + step), level(p->y[2], i, i + step));
    fputs("END\n", g->in);
}

static void curves(const char *data, struct gnuplot *g)
{
    fprintf(g->in,
            "plot %s using 1:2 with lines linewidth 1.2 linecolor rgb '" GREY
            "' title 'strike', '' using 1:4 with lines linewidth 1 linecolor rgb '#f0b48a' title "
            "'what is left', '' using 1:3 with lines linewidth 1.2 linecolor rgb '" BLUE "' title 'its modes'",
            data);
}

void modes_extract_plot(void *self, struct gnuplot *g)
{
    struct modes_extract *x = self;
    const struct modes_extract_place *p = &x->place[0];
    const struct shown now = shown(x, x->arena);
    double low = fmax(20.0, 0.7 * x->low), high = fmin(1.4 * x->high, 0.5 * x->rate);
    fprintf(g->in, x->given.svg ? "set terminal svg size 1100,900 font 'DejaVu Sans,13' background rgb 'white'\n"
                                : "set terminal pngcairo size 1100,900 font 'DejaVu Sans,10' background rgb 'white'\n");
    fputs("set encoding utf8\nset border linewidth 0.8\nset tics out nomirror scale 0.6\nset key noenhanced outside "
          "top horizontal center samplen 2\nset multiplot title ",
          g->in);
    gnuplot_put_text(g,
                     arena_format(x->arena, "%s: %d modes explain %.1f %%", p->name, x->modes, 100.0 * p->explained));
    fprintf(g->in,
            " noenhanced\nset size 1,0.56\nset origin 0,0.4\nset logscale x\nset xrange [%.6g:%.6g]\nset xlabel "
            "'frequency / Hz'\nset ylabel 'level / dB'\n",
            low, high);
    spectra(x, &now, low, high, g);
    stems(x, g);
    fputs("stats $s using 2 nooutput\nset yrange [STATS_max - 90:STATS_max + 6]\n", g->in);
    curves("$s", g);
    fputs(", $m using 1:2:(0):(-200) with vectors nohead linewidth 0.6 linecolor rgb '" RED
          "' notitle, '' using 1:2:3:4 with yerrorbars pointtype 7 pointsize 0.5 linecolor rgb '" RED
          "' title 'modes, ± 2 standard errors'\nunset logscale x\n",
          g->in);
    levels(x, &now, g);
    fprintf(g->in,
            "set size 0.5,0.4\nset origin 0,0\nset xrange [0:%.6g]\nset xlabel 'time / s'\nset yrange [*:*]\nstats $l "
            "using 2 nooutput\nset yrange [STATS_max - 80:STATS_max + 6]\n",
            (double)now.n / x->rate);
    curves("$l", g);
    fprintf(g->in,
            "\nset origin 0.5,0\nset logscale xy\nset xrange [%.6g:%.6g]\nset yrange [*:*]\nset xlabel 'frequency / "
            "Hz'\nset ylabel 'T60 / s'\n"
            "plot $m using 1:5:6:7 with yerrorbars pointtype 7 pointsize 0.5 linecolor rgb '" RED
            "' notitle\nunset multiplot\n",
            low, high);
}
