/* The picture of `rasp accuracy`: what each setting's error is against how many times faster than real time it renders; a line for each knob, the presets by
   name, the front ringed, and the reference's own error as a grey line, below which no figure means much. Of a sound that diverges the error is that of its spectrum. */
#include <math.h>
#include <string.h>

#include "cmd/accuracy.h"
#include "num/real.h"

/* Okabe and Ito's set, told apart by colour-blind people too. */
static const char *const colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"};

static double speed(const struct accuracy_render *r)
{
    return r->error.length / fmax(r->cpu, 1e-9);
}

/* dB; settings that are the reference, or make its samples, have none. */
static bool shown(const struct accuracy_sweep *s, const struct accuracy_row *w, double *error)
{
    const struct accuracy_render *r = &s->renders[w->total];
    *error = accuracy_judge_error(s, r);
    return r->code == 0 && isfinite(*error) && w->total != s->reference;
}

/* Rows [from, to) as data, one block. */
static void put_block(const struct accuracy_sweep *s, int from, int to, struct gnuplot *g)
{
    fprintf(g->in, "$b%d << END\n", from);
    for (int i = from; i < to; i++) {
        double error;
        if (!shown(s, &s->rows[i], &error))
            continue;
        bool named = s->rows[i].knob < 0 || !s->rows[i].chosen; /* all knobs' curves meet where the scene is */
        fprintf(g->in, "%.6g %.6g \"%s\"\n", speed(&s->renders[s->rows[i].total]), error, !named ? "" : *s->rows[i].value ? s->rows[i].value : "scene");
    }
    fputs("END\n", g->in);
}

/* Leading digits of labels, from few to many: the last set has two in whatever spans a factor of 2.25. */
static const double digits[3][11] = {{1}, {1, 2, 5}, {1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9}};

int accuracy_plot_tics(double low, double high, double tics[ACCURACY_PLOT_TICS])
{
    int n = 0;
    for (int set = 0; set < 3 && n < 2; set++) {
        n = 0;
        for (int e = (int)floor(real_log10(low)); e <= (int)ceil(real_log10(high)); e++)
            for (const double *d = digits[set]; *d > 0; d++) {
                double x = *d * real_pow(10, e);
                if (x >= low && x <= high && n < ACCURACY_PLOT_TICS)
                    tics[n++] = x;
            }
    }
    return n;
}

/* From a little below the slowest to a little above the fastest. */
static void put_range(const struct accuracy_sweep *s, struct gnuplot *g)
{
    double low = HUGE_VAL, high = 0.0, error;
    for (int i = 0; i < s->n_rows; i++)
        if (shown(s, &s->rows[i], &error)) {
            low = fmin(low, speed(&s->renders[s->rows[i].total]));
            high = fmax(high, speed(&s->renders[s->rows[i].total]));
        }
    if (!(high > 0.0))
        return;
    double tics[ACCURACY_PLOT_TICS];
    int n = accuracy_plot_tics(low / 1.5, high * 1.5, tics);
    fprintf(g->in, "set xrange [%.4g:%.4g]\nset xtics (", low / 1.5, high * 1.5);
    for (int i = 0; i < n; i++)
        fprintf(g->in, "%s'%.6g' %.6g", i ? ", " : "", tics[i], tics[i]);
    fputs(")\n", g->in);
}

static int put_front(const struct accuracy_sweep *s, struct gnuplot *g)
{
    int n = 0;
    fputs("$front << END\n", g->in);
    for (int i = 0; i < s->n_rows; i++) {
        double error;
        if (!shown(s, &s->rows[i], &error) || !s->renders[s->rows[i].total].front)
            continue;
        fprintf(g->in, "%.6g %.6g\n", speed(&s->renders[s->rows[i].total]), error);
        n++;
    }
    fputs("END\n", g->in);
    return n;
}

static void put_head(const struct accuracy_sweep *s, struct gnuplot *g)
{
    size_t n = s->plot ? strlen(s->plot) : 0;
    bool svg = n > 3 && s->plot[n - 1] == 'g' && s->plot[n - 2] == 'v';
    fprintf(g->in, svg ? "set terminal svg size 1000,640 font 'DejaVu Sans,13' background rgb 'white'\n"
                       : "set terminal pngcairo size 1000,640 font 'DejaVu Sans,10' background rgb 'white'\n");
    fputs("set encoding utf8\nset border linewidth 0.8\nset tics out nomirror scale 0.6\nset grid linewidth 0.5 linecolor rgb '#dddddd'\nset logscale x\n"
          "set key noenhanced outside right top vertical samplen 2\nset xlabel 'times real time'\nset offsets 0, 0, graph 0.06, graph 0.06\nset title ", g->in);
    gnuplot_put_text(g, s->scene.title ? s->scene.title : s->file);
    fprintf(g->in, " noenhanced\nset ylabel '%s'\n", isfinite(s->until) ? "log-spectral distance from reference after divergence / dB" : "error / dB (of the sound, below it)");
    if (isfinite(s->own_db) && !isfinite(s->until))
        fprintf(g->in, "own = %.6g\n", -s->own_db);
}

void accuracy_plot(void *sweep, struct gnuplot *g)
{
    const struct accuracy_sweep *s = sweep;
    const char *between = "plot ";
    put_head(s, g);
    put_range(s, g);
    int front = put_front(s, g), end, colour = 0;
    bool own = isfinite(s->own_db) && !isfinite(s->until);
    for (int i = 0; i < s->n_rows; i = end) {
        for (end = i; end < s->n_rows && s->rows[end].knob == s->rows[i].knob; end++)
            continue;
        put_block(s, i, end, g);
    }
    for (int i = 0; i < s->n_rows; i = end) {
        double error;
        int n = 0;
        for (end = i; end < s->n_rows && s->rows[end].knob == s->rows[i].knob; end++)
            n += shown(s, &s->rows[end], &error);
        if (n == 0)
            continue;
        const char *c = s->rows[i].knob < 0 ? "#888888" : colours[colour++ % (int)(sizeof colours / sizeof *colours)];
        fprintf(g->in, "%s$b%d using 1:2 with linespoints linewidth 1.5 pointtype 7 pointsize 0.8 linecolor rgb '%s' title '%s', "
                       "'' using 1:2:3 with labels noenhanced offset %s font ',%d' textcolor rgb '%s' notitle",
                between, i, c, s->rows[i].knob < 0 ? "presets" : s->rows[i].name, s->rows[i].knob < 0 ? "-0.9,-0.3 right" : "0.6,0.6 left",
                s->rows[i].knob < 0 ? 11 : 8, c);
        between = ", ";
    }
    if (front)
        fprintf(g->in, "%s$front using 1:2 with points pointtype 6 pointsize 2 linewidth 1.2 linecolor rgb 'black' title 'nothing cheaper and better'", between);
    if (own)
        fprintf(g->in, "%sown with lines linewidth 1 dashtype 2 linecolor rgb '#888888' title 'own error of reference'", front ? ", " : between);
    fputs(front || own || colour ? "\n" : "set xrange [1:10]\nset yrange [0:1]\nplot NaN notitle\n", g->in);
}
