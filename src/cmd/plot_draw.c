/* The page of `rasp plot`, as gnuplot commands with the data inline: panels one above the other on one time axis; below them the plan of the motion and the modes, side by
   side. */
#include <math.h>
#include <stdint.h>

#include "cmd/plot.h"
#include "num/real.h"

enum { WIDTH = 1200, LEFT = 95, RIGHT = 105, TOP = 48, BOTTOM = 58, GAP = 22, KEY = 26, BETWEEN = 195 }; /* pixels; BETWEEN: of two panels side by side */

static const int heights[PLOT_PANELS] = {[PLOT_WAVEFORM] = 180, [PLOT_SPECTROGRAM] = 340, [PLOT_FORCE] = 180, [PLOT_HAND] = 150,
                                         [PLOT_MOTION] = 300,   [PLOT_MODES] = 300,       [PLOT_DECAYS] = 220};

static bool is_timed(int panel)
{
    return panel < PLOT_MOTION;
}

/* Motion and modes share a row. */
static bool has_row(const struct plot_page *p)
{
    return plot_panels_there(p, PLOT_MOTION) || plot_panels_there(p, PLOT_MODES);
}

static int page_height(const struct plot_page *p)
{
    int height = TOP, timed = 0;
    for (int k = 0; is_timed(k); k++)
        timed += plot_panels_there(p, k) ? heights[k] + GAP : 0;
    height += timed ? timed - GAP + BOTTOM : 0;
    height += has_row(p) ? KEY + heights[PLOT_MOTION] + BOTTOM : 0;
    return height + (plot_panels_there(p, PLOT_DECAYS) ? KEY + heights[PLOT_DECAYS] + BOTTOM : 0);
}

/* ------------------------------------------------------------------ data */

static void data_sound(const struct plot_page *p, FILE *f)
{
    const struct plot_sound *o = p->sound;
    double step = (p->to - p->from) / o->n;
    fputs("$sound << END\n", f);
    for (int c = 0; c < o->n; c++)
        fprintf(f, "%.9g %.9g %.9g\n", p->from + (c + 0.5) * step, o->least[c], o->most[c]);
    fputs("END\n", f);
}

static void data_table(const struct plot_table *t, int number, FILE *f)
{
    fprintf(f, "$table%d << END\n", number);
    for (int i = 0; i < t->n; i++) {
        fprintf(f, "%.9g", t->time[i]);
        for (int k = 0; k < PLOT_TABLE_COLUMNS; k++)
            fprintf(f, " %.9g", t->x[k] ? t->x[k][i] * (k == PLOT_ALPHA ? 100 : 1) : 0);
        fputc('\n', f);
    }
    fputs("END\n", f);
}

/* ------------------------------------------------------------------ panels */

static double decibel(double x)
{
    return 20 * real_log10(x);
}

static void draw_waveform(const struct plot_page *p, struct gnuplot *g)
{
    const struct plot_sound *o = p->sound;
    double most = o->peak > 0 ? 1.25 * o->peak : 1;
    const char *which = p->channels > 1 ? arena_format(p->arena, "channel %d of %d, ", p->channel, p->channels) : "";
    fprintf(g->in, "set ylabel 'amplitude / full scale'\nset yrange [%.6g:%.6g]\n", -most, most);
    if (o->peak > 0)
        fprintf(g->in, "set key title '%speak %.1f dBFS, rms %.1f dBFS'\n", which, decibel(o->peak), decibel(o->rms));
    else
        fprintf(g->in, "set key title '%ssilent'\n", which);
    fputs("plot $sound using 1:2:3 with filledcurves fillcolor rgb '#0072b2' notitle, "
          "'' using 1:2 with lines linewidth 0.5 linecolor rgb '#0072b2' notitle, "
          "'' using 1:3 with lines linewidth 0.5 linecolor rgb '#0072b2' notitle\n"
          "unset key\nset key notitle\n", g->in);
}

/* Top of the colours: the loudest place, up to the next 10 dB. */
static double colour_top(const struct spectrogram *s, int bins)
{
    double most = -HUGE_VAL;
    for (size_t i = 0; i < (size_t)bins * (size_t)s->columns; i++)
        most = fmax(most, s->db[i]);
    return isfinite(most) ? 10 * ceil(most / 10) : 0;
}

/* Bins up to 20 kHz as 32-bit floats, what lies below the colours' range drawn as its lowest. */
static void draw_spectrogram(const struct plot_page *p, double bottom, double height, struct gnuplot *g)
{
    const struct spectrogram *s = &p->sound->spectrogram;
    double khz = fmin(20e3, p->sound->rate / 2) / 1000, step = (p->to - p->from) / s->columns;
    int bins = (int)fmin(floor(khz * 1000 / s->bin_hz + 0.5) + 1, s->bins);
    double top = colour_top(s, bins);
    fprintf(g->in, "set ylabel 'frequency / kHz'\nset yrange [0:%.6g]\nset cbrange [%g:%g]\nset cblabel 'dB re full-scale sine'\nset cbtics 20\n",
            khz, top - 80, top);
    fprintf(g->in, "set colorbox user origin screen %.5f, screen %.5f size screen %.5f, screen %.5f\n",
            1 - (RIGHT - 14.0) / WIDTH, bottom, 16.0 / WIDTH, height);
    fprintf(g->in, "plot '-' binary array=(%d,%d) dx=%.12g dy=%.12g origin=(%.12g,0) format='%%float32' using 1 with image notitle\n",
            s->columns, bins, step, s->bin_hz / 1000, p->from + 0.5 * step);
    for (size_t i = 0; i < (size_t)bins * (size_t)s->columns; i++) {
        float v = (float)fmax(s->db[i], top - 80);
        fwrite(&v, sizeof v, 1, g->in);
    }
    fputs("unset colorbox\n", g->in);
}

/* Name of a curve in the key: what it is, and of which contact if there are several. */
static void put_name(const struct plot_page *p, int i, const char *what, struct gnuplot *g)
{
    const char *name = p->tables[i].name;
    fputs(" title ", g->in);
    gnuplot_put_text(g, *name ? arena_format(p->arena, "%s, %s", name, what) : what);
}

static double most_of(const struct plot_page *p, enum plot_column column)
{
    double most = 0;
    for (int i = 0; i < p->n_tables; i++)
        most = fmax(most, p->tables[i].most[column]);
    return most > 0 ? most : 1;
}

/* Puts the curve of a column of every table that has it; says whether it put any. */
static bool put_curves(const struct plot_page *p, enum plot_column column, const char *style, bool *any, struct gnuplot *g)
{
    static const char *const what[] = {[PLOT_PEAK] = "peak", [PLOT_RMS] = "rms", [PLOT_NORMAL] = "normal force", [PLOT_ALPHA] = "α, right axis"};
    for (int i = 0; i < p->n_tables; i++) {
        if (!p->tables[i].x[column] || p->tables[i].n == 0)
            continue;
        fprintf(g->in, "%s $table%d using 1:%d with ", *any ? "," : "plot", i, (int)column + 2);
        fprintf(g->in, style, plot_panels_colour(column == PLOT_ALPHA && p->n_tables == 1 ? 1 : i));
        put_name(p, i, what[column], g);
        *any = true;
    }
    return *any;
}

static void draw_force(const struct plot_page *p, struct gnuplot *g)
{
    bool any = false;
    fprintf(g->in, "set ylabel 'contact force / N'\nset yrange [0:%.6g]\n", 1.25 * most_of(p, plot_data_has(p, PLOT_PEAK) ? PLOT_PEAK : PLOT_RMS));
    put_curves(p, PLOT_PEAK, "filledcurves y=0 fillcolor rgb '%s' fillstyle transparent solid 0.35 noborder", &any, g);
    put_curves(p, PLOT_RMS, "lines linewidth 1.2 linecolor rgb '%s'", &any, g);
    fputs(any ? "\n" : "plot NaN notitle\n", g->in);
}

static void draw_normal(const struct plot_page *p, struct gnuplot *g)
{
    bool any = false;
    fprintf(g->in, "set ylabel 'normal force / N'\nset yrange [0:%.6g]\n", 1.25 * most_of(p, PLOT_NORMAL));
    if (plot_data_has(p, PLOT_ALPHA))
        fprintf(g->in, "set y2tics\nset y2label 'α / cm'\nset y2range [0:%.6g]\n", 160 * most_of(p, PLOT_ALPHA));
    put_curves(p, PLOT_NORMAL, "lines linewidth 1.6 linecolor rgb '%s'", &any, g);
    put_curves(p, PLOT_ALPHA, "lines axes x1y2 linewidth 1.6 dashtype 2 linecolor rgb '%s'", &any, g);
    fputs(any ? "\n" : "plot NaN notitle\n", g->in);
}

/* ------------------------------------------------------------------ the page */

static void draw_head(const struct plot_page *p, struct gnuplot *g)
{
    int height = page_height(p);
    if (p->svg)
        fprintf(g->in, "set terminal svg size %d,%d font 'DejaVu Sans,13' background rgb 'white'\n", WIDTH, height);
    else
        fprintf(g->in, "set terminal pngcairo size %d,%d font 'DejaVu Sans,10' background rgb 'white'\n", WIDTH, height);
    fputs("set encoding utf8\n"
          "set palette defined (0 '#000004', 1 '#280b54', 2 '#65156e', 3 '#9f2a63', 4 '#d44842', 5 '#f57d15', 6 '#fac127', 7 '#fcffa4')\n"
          "set border linewidth 0.8\nset tics out nomirror scale 0.6\nset style fill solid 1.0 noborder\n"
          "set ylabel offset 1,0\nset y2label offset -1,0\nset cblabel offset 1.2,0\n"
          "set key noenhanced top right inside horizontal samplen 2 spacing 1.0\n", g->in);
    fprintf(g->in, "set lmargin at screen %.5f\nset rmargin at screen %.5f\n", (double)LEFT / WIDTH, 1 - (double)RIGHT / WIDTH);
    fputs("set multiplot\nset label 1 ", g->in);
    gnuplot_put_text(g, p->title);
    fprintf(g->in, " at screen %.5f, screen %.5f noenhanced font ',13'\n", (double)LEFT / WIDTH, 1 - 0.5 * TOP / height);
}

/* A panel over time; the last has the axis' numbers. */
static void draw_timed(const struct plot_page *p, int panel, const double place[2], struct gnuplot *g)
{
    fprintf(g->in, "set bmargin at screen %.5f\nset tmargin at screen %.5f\n", place[0], place[0] + place[1]);
    if (panel == PLOT_WAVEFORM)
        draw_waveform(p, g);
    else if (panel == PLOT_SPECTROGRAM)
        draw_spectrogram(p, place[0], place[1], g);
    else if (panel == PLOT_FORCE)
        draw_force(p, g);
    else
        draw_normal(p, g);
    fputs("unset label 1\n", g->in);
}

/* Returns how far down the page it came, in pixels from the top. */
static double draw_all_timed(const struct plot_page *p, double whole, struct gnuplot *g)
{
    double top = whole - TOP;
    int last = -1;
    for (int k = 0; is_timed(k); k++)
        last = plot_panels_there(p, k) ? k : last;
    if (last >= 0)
        fprintf(g->in, "set xrange [%.9g:%.9g]\n", p->from, p->to);
    for (int k = 0; k <= last; k++) {
        if (!plot_panels_there(p, k))
            continue;
        fputs(k == last ? "set format x '%g'\nset xlabel 'time / s'\n" : "set format x ''\nunset xlabel\n", g->in);
        draw_timed(p, k, (const double[2]){(top - heights[k]) / whole, heights[k] / whole}, g);
        top -= heights[k] + (k == last ? BOTTOM : GAP);
    }
    fputs("unset y2tics\nunset y2label\nset autoscale y2\nset key tmargin\n", g->in);
    return top;
}

/* A panel with axes of its own, from pixel to pixel; top: of the page's pixels, from below. */
static void draw_apart(const struct plot_page *p, void (*draw)(const struct plot_page *, const struct plot_place *, struct gnuplot *), const double box[4], struct gnuplot *g)
{
    double whole = page_height(p);
    struct plot_place at = {box[0] / WIDTH, box[1] / WIDTH, box[2] / whole, box[3] / whole, {WIDTH, whole}};
    fprintf(g->in, "set lmargin at screen %.5f\nset rmargin at screen %.5f\nset bmargin at screen %.5f\nset tmargin at screen %.5f\n", at.left, at.right, at.bottom, at.top);
    draw(p, &at, g);
    fputs("unset label 1\n", g->in);
}

/* Alone each takes the whole width. */
static void draw_row(const struct plot_page *p, double top, struct gnuplot *g)
{
    bool motion = plot_panels_there(p, PLOT_MOTION), modes = plot_panels_there(p, PLOT_MODES);
    double bottom = top - heights[PLOT_MOTION], right = WIDTH - RIGHT, middle = (LEFT + right) / 2;
    if (motion)
        draw_apart(p, plot_motion, (const double[4]){LEFT, modes ? middle - BETWEEN / 2.0 : right, bottom, top}, g);
    if (modes)
        draw_apart(p, plot_modes, (const double[4]){motion ? middle + BETWEEN / 2.0 : LEFT, right, bottom, top}, g);
}

void plot_draw(const struct plot_page *p, struct gnuplot *g)
{
    double whole = page_height(p), top;
    if (p->sound)
        data_sound(p, g->in);
    for (int i = 0; i < p->n_tables; i++)
        data_table(&p->tables[i], i, g->in);
    draw_head(p, g);
    top = draw_all_timed(p, whole, g);
    if (has_row(p)) {
        draw_row(p, top - KEY, g);
        top -= KEY + heights[PLOT_MOTION] + BOTTOM;
    }
    if (plot_panels_there(p, PLOT_DECAYS))
        draw_apart(p, plot_modes_decays, (const double[4]){LEFT, WIDTH - RIGHT, top - KEY - heights[PLOT_DECAYS], top - KEY}, g);
    fputs("unset multiplot\n", g->in);
}
