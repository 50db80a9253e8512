/* The plan of the motion: the way seen from above, coloured by speed, with where it begins and ends, the object's
   edges, and the places of the mode table. One metre is as long along x as along y. An object, or a table's places,
   that reach much farther than the way are cut off by the panel. */
#include "cmd/plot.h"

#include <math.h>
#include <stdint.h>

#include "num/real.h"

enum { FAR = 4 /* times the way's size */ };

struct view {
    double low[2], high[2];
};

static void take(struct view *v, double x, double y)
{
    const double at[2] = {x, y};
    for (int k = 0; k < 2; k++) {
        v->low[k] = fmin(v->low[k], at[k]);
        v->high[k] = fmax(v->high[k], at[k]);
    }
}

static double size_of(const struct view *v) { return fmax(v->high[0] - v->low[0], v->high[1] - v->low[1]); }

/* All of the way, and of what it lies on. */
static struct view view_of(const struct plot_page *p)
{
    struct view path = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}}, all;
    for (int i = 0; i < p->n_ways; i++)
        for (int k = 0; k < p->ways[i].n; k++)
            take(&path, p->ways[i].at[k][0], p->ways[i].at[k][1]);
    all = path;
    for (int i = 0; i < p->n_grounds; i++) {
        const struct plot_ground *g = &p->grounds[i];
        if (g->box) {
            take(&all, g->low[0], g->low[1]);
            take(&all, g->high[0], g->high[1]);
        }
        for (int k = 0; k < g->n; k++)
            take(&all, g->places[k][0], g->places[k][1]);
    }
    return size_of(&all) > FAR * size_of(&path) ? path : all;
}

static void put_curves(const struct plot_page *p, FILE *f)
{
    bool first = true;
    fputs("plot ", f);
    for (int i = 0; i < p->n_grounds; i++)
        if (p->grounds[i].n) {
            fprintf(f, "%s$places%d using 1:2 with points pointtype 2 pointsize 0.6 linecolor rgb '#707070' %s",
                    first ? "" : ", ", i, first ? "title 'places'" : "notitle");
            first = false;
        }
    for (int i = 0; i < p->n_ways; i++) {
        fprintf(f, "%s$way%d using 1:2:3 with lines linewidth 2.5 linecolor palette notitle", first ? "" : ", ", i);
        fprintf(f, ", $way%d using 1:2 every ::0::0 with points pointtype 7 pointsize 1.3 linecolor rgb 'black' %s", i,
                i ? "notitle" : "title 'start'");
        fprintf(f,
                ", $way%d using 1:2 every ::%d::%d with points pointtype 4 pointsize 2.2 linewidth 1.6 linecolor rgb "
                "'black' %s",
                i, p->ways[i].n - 1, p->ways[i].n - 1, i ? "notitle" : "title 'end'");
        first = false;
    }
    fputc('\n', f);
}

/* The colours' scale to the right of a panel, the key above it. */
static void put_scale(const struct plot_place *at, const char *rows, FILE *f)
{
    fprintf(f, "set colorbox user origin screen %.5f, screen %.5f size screen %.5f, screen %.5f\n",
            at->right + 14 / at->size[0], at->bottom, 14 / at->size[0], at->top - at->bottom);
    fprintf(f, "set key at screen %.5f, screen %.5f right bottom%s\n", at->right, at->top + 3 / at->size[1], rows);
}

static void plot_motion(const struct plot_page *p, const struct plot_place *at, struct gnuplot *g)
{
    struct view v = view_of(p);
    /* Some air, and then as much more along one axis as makes the scales equal. */
    double pixels[2] = {(at->right - at->left) * at->size[0], (at->top - at->bottom) * at->size[1]}, scale = 0;
    for (int k = 0; k < 2; k++)
        scale = fmax(scale, 1.12 * (v.high[k] - v.low[k]) / pixels[k]);
    for (int k = 0; k < 2; k++) {
        double middle = (v.low[k] + v.high[k]) / 2;
        v.low[k] = middle - scale * pixels[k] / 2;
        v.high[k] = middle + scale * pixels[k] / 2;
    }
    double fastest = 0;
    for (int i = 0; i < p->n_ways; i++)
        for (int k = 0; k < p->ways[i].n; k++)
            fastest = fmax(fastest, p->ways[i].at[k][2]);
    bool small = v.high[0] - v.low[0] < 0.03;
    double unit = small ? 1e-3 : 1e-2;
    for (int i = 0; i < p->n_ways; i++) {
        fprintf(g->in, "$way%d << END\n", i);
        for (int k = 0; k < p->ways[i].n; k++) {
            const double *at3 = p->ways[i].at[k];
            fprintf(g->in, "%.9g %.9g %.9g\n", at3[0] / unit, at3[1] / unit, at3[2]);
        }
        fputs("END\n", g->in);
    }
    for (int i = 0; i < p->n_grounds; i++) {
        fprintf(g->in, "$places%d << END\n", i);
        for (int k = 0; k < p->grounds[i].n; k++) {
            const double *xy = p->grounds[i].places[k];
            if (xy[0] >= v.low[0] && xy[0] <= v.high[0] && xy[1] >= v.low[1] && xy[1] <= v.high[1])
                fprintf(g->in, "%.9g %.9g\n", xy[0] / unit, xy[1] / unit);
        }
        fputs("NaN NaN\nEND\n", g->in);
    }
    fprintf(g->in, "set xlabel 'x / %s'\nset ylabel 'y / %s'\nset format x '%%g'\n", small ? "mm" : "cm",
            small ? "mm" : "cm");
    fprintf(g->in, "set xrange [%.9g:%.9g]\nset yrange [%.9g:%.9g]\nset cbrange [0:%.6g]\n", v.low[0] / unit,
            v.high[0] / unit, v.low[1] / unit, v.high[1] / unit, fastest > 0 ? fastest : 1);
    fputs("set palette defined (0 '#0d0887', 1 '#7e03a8', 2 '#cc4778', 3 '#f0804e', 4 '#f9a242')\nset cblabel 'speed / "
          "(m/s)'\nset cbtics auto\n",
          g->in);
    put_scale(at, " maxrows 1", g->in);
    for (int i = 0; i < p->n_grounds; i++) { /* edges as objects, behind all else */
        const struct plot_ground *ground = &p->grounds[i];
        const double *low = ground->low, *high = ground->high;
        if (!ground->box) continue;
        if (ground->round)
            fprintf(g->in, "set object %d ellipse center %.9g,%.9g size %.9g,%.9g", i + 1,
                    (low[0] + high[0]) / 2 / unit, (low[1] + high[1]) / 2 / unit, (high[0] - low[0]) / unit,
                    (high[1] - low[1]) / unit);
        else
            fprintf(g->in, "set object %d rectangle from %.9g,%.9g to %.9g,%.9g", i + 1, low[0] / unit, low[1] / unit,
                    high[0] / unit, high[1] / unit);
        fputs(" behind fillcolor rgb '#f4efe6' fillstyle solid 1.0 border linecolor rgb '#9a8f7a'\n", g->in);
    }
    put_curves(p, g->in);
    fputs("unset colorbox\nunset object\nset key default\nset key noenhanced top right inside horizontal samplen 2 "
          "spacing 1.0\n",
          g->in);
}

/* Modes: stems of gain over frequency, in decibels below the strongest of all, coloured by the time of decay by 60 dB,
 * T60 = 3 ln 10 / decay; and that time over frequency. */

#define RANGE 80.0 /* dB that are shown */

struct span {
    double low, high;
};

static double t60(const struct plot_mode *m) { return 3 * real_log(10.0) / m->decay; }

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
            if (!shown(m, most)) continue;
            khz->low = fmin(khz->low, m->frequency / 1000 / 1.15);
            khz->high = fmax(khz->high, m->frequency / 1000 * 1.15);
            decay->low = fmin(decay->low, t60(m) / 1.1);
            decay->high = fmax(decay->high, t60(m) * 1.1);
        }
    if (khz->high == 0) *khz = *decay = (struct span){0.1, 10};
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
            if (at < s.low || at > s.high) continue;
            fprintf(f, "%s%.6g", comma, at);
            comma = ", ";
        }
    fprintf(f, ")\n");
}

static void modes_data(const struct plot_page *p, double most, FILE *f)
{
    for (int i = 0; i < p->n_bodies; i++) {
        fprintf(f, "$modes%d << END\n", i);
        for (int k = 0; k < p->bodies[i].n; k++) {
            const struct plot_mode *m = &p->bodies[i].modes[k];
            if (shown(m, most)) fprintf(f, "%.9g %.6g %.6g\n", m->frequency / 1000, level(m, most), t60(m));
        }
        fputs("NaN NaN NaN\nEND\n", f);
    }
}

static const int marks[] = {7, 5, 9, 13};

/* Told apart by colour-blind people too (Okabe and Ito's set). */
static const char *const colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7"};

static void put_name(const struct plot_page *p, int i, struct gnuplot *g)
{
    fputs(p->n_bodies > 1 ? " title " : " notitle ", g->in);
    if (p->n_bodies > 1) gnuplot_put_text(g, p->bodies[i].name);
}

static void plot_modes(const struct plot_page *p, const struct plot_place *at, struct gnuplot *g)
{
    double most = strongest(p);
    struct span khz, decay;
    spans(p, most, &khz, &decay);
    modes_data(p, most, g->in);
    double least = -11; /* stems go down to the next 10 dB below the weakest */
    for (int i = 0; i < p->n_bodies; i++)
        for (int k = 0; k < p->bodies[i].n; k++)
            if (shown(&p->bodies[i].modes[k], most)) least = fmin(least, level(&p->bodies[i].modes[k], most));
    double bottom = 10 * floor(least / 10);
    fprintf(g->in,
            "set ylabel 'gain / dB re strongest' offset 0,0\nset xlabel 'frequency / kHz'\nset format x '%%g'\nset "
            "xrange [%.6g:%.6g]\nset yrange [%g:4]\nset cbrange [%.6g:%.6g]\n",
            khz.low, khz.high, bottom, decay.low, decay.high);
    put_tics("x", khz, g->in);
    put_tics("cb", decay, g->in);
    fputs("set palette defined (0 '#440154', 1 '#3b528b', 2 '#21918c', 3 '#4db84f', 4 '#b8c31f')\nset cblabel 'T60 / "
          "s' offset 0,0\n",
          g->in);
    put_scale(at, "", g->in);
    for (int i = 0; i < p->n_bodies; i++) {
        fprintf(g->in,
                "%s $modes%d using 1:(%g):(0):($2-(%g)):3 with vectors nohead linewidth 1.3 linecolor palette notitle",
                i ? "," : "plot", i, bottom, bottom);
        fprintf(g->in, ", $modes%d using 1:2:3 with points pointtype %d pointsize 0.8 linecolor palette notitle", i,
                marks[i % 4]);
        fprintf(g->in, ", NaN with points pointtype %d linecolor rgb '#404040'", marks[i % 4]);
        put_name(p, i, g);
    }
    fputc('\n', g->in);
    fputs("unset colorbox\nunset logscale\nset xtics autofreq\n", g->in);
}

static void plot_modes_decays(const struct plot_page *p, const struct plot_place *at, struct gnuplot *g)
{
    double most = strongest(p);
    struct span khz, decay;
    spans(p, most, &khz, &decay);
    modes_data(p, most, g->in);
    fprintf(g->in,
            "set ylabel 'T60 / s' offset 0,0\nset xlabel 'frequency / kHz'\nset format x '%%g'\nset xrange "
            "[%.6g:%.6g]\nset yrange [%.6g:%.6g]\n",
            khz.low, khz.high, decay.low, decay.high);
    put_tics("x", khz, g->in);
    put_tics("y", decay, g->in);
    fprintf(g->in, "set key at screen %.5f, screen %.5f right bottom\n", at->right, at->top + 3 / at->size[1]);
    fputs("set grid xtics ytics linecolor rgb '#d8d8d8'\n", g->in);
    for (int i = 0; i < p->n_bodies; i++) {
        fprintf(g->in, "%s $modes%d using 1:3 with points pointtype %d pointsize 0.8 linecolor rgb '%s'",
                i ? "," : "plot", i, marks[i % 4], colours[i % 4]);
        put_name(p, i, g);
    }
    fputs("\nunset logscale\nset xtics autofreq\nset ytics autofreq\nunset grid\n", g->in);
}

/* The page of `rasp plot`, as gnuplot commands with the data inline: panels one above the other on one time axis; below
   them the plan of the motion and the modes, side by side. */

enum {
    WIDTH = 1200,
    LEFT = 95,
    RIGHT = 105,
    TOP = 48,
    BOTTOM = 58,
    GAP = 22,
    KEY = 26,
    BETWEEN = 195
}; /* pixels; BETWEEN: of two panels side by side */

static const int heights[PLOT_PANELS] = {
    [PLOT_WAVEFORM] = 180, [PLOT_SPECTROGRAM] = 340, [PLOT_FORCE] = 180, [PLOT_HAND] = 150,
    [PLOT_FOLLOWED] = 220, [PLOT_MOTION] = 300,      [PLOT_MODES] = 300, [PLOT_DECAYS] = 220};

/* Motion and modes share a row. */
static bool has_row(const struct plot_page *p)
{
    return plot_panels_there(p, PLOT_MOTION) || plot_panels_there(p, PLOT_MODES);
}

static int page_height(const struct plot_page *p)
{
    int height = TOP, timed = 0;
    for (int k = 0; k < PLOT_MOTION; k++)
        timed += plot_panels_there(p, k) ? heights[k] + GAP : 0;
    height += timed ? timed - GAP + BOTTOM : 0;
    height += has_row(p) ? KEY + heights[PLOT_MOTION] + BOTTOM : 0;
    return height + (plot_panels_there(p, PLOT_DECAYS) ? KEY + heights[PLOT_DECAYS] + BOTTOM : 0);
}

/* ------------------------------------------------------------------ panels */

/* Bins up to 20 kHz as 32-bit floats, what lies below the colours' range drawn as its lowest. */
static void draw_spectrogram(const struct plot_page *p, double bottom, double height, struct gnuplot *g)
{
    const struct spectrogram *s = &p->sound->spectrogram;
    double khz = fmin(20e3, p->sound->rate / 2) / 1000, step = (p->to - p->from) / s->columns;
    int bins = (int)fmin(floor(khz * 1000 / s->bin_hz + 0.5) + 1, s->bins);
    /* Top of the colours: the loudest place, up to the next 10 dB. */
    double most = -HUGE_VAL;
    for (size_t i = 0; i < (size_t)bins * (size_t)s->columns; i++)
        most = fmax(most, s->db[i]);
    double top = isfinite(most) ? 10 * ceil(most / 10) : 0;
    fprintf(g->in,
            "set ylabel 'frequency / kHz'\nset yrange [0:%.6g]\nset cbrange [%g:%g]\nset cblabel 'dB re full-scale "
            "sine'\nset cbtics 20\n",
            khz, top - 80, top);
    fprintf(g->in, "set colorbox user origin screen %.5f, screen %.5f size screen %.5f, screen %.5f\n",
            1 - (RIGHT - 14.0) / WIDTH, bottom, 16.0 / WIDTH, height);
    fprintf(g->in,
            "plot '-' binary array=(%d,%d) dx=%.12g dy=%.12g origin=(%.12g,0) format='%%float32' using 1 with image "
            "notitle\n",
            s->columns, bins, step, s->bin_hz / 1000, p->from + 0.5 * step);
    for (size_t i = 0; i < (size_t)bins * (size_t)s->columns; i++) {
        float v = (float)fmax(s->db[i], top - 80);
        fwrite(&v, sizeof v, 1, g->in);
    }
    fputs("unset colorbox\n", g->in);
}

static double most_of(const struct plot_page *p, enum plot_column column)
{
    double most = 0;
    for (int i = 0; i < p->n_tables; i++)
        most = fmax(most, p->tables[i].most[column]);
    return most > 0 ? most : 1;
}

/* Puts the curve of a column of every table that has it; says whether it put any. */
static bool draw_put_curves(const struct plot_page *p, enum plot_column column, const char *style, bool *any,
                            struct gnuplot *g)
{
    static const char *const what[] = {
        [PLOT_PEAK] = "peak",           [PLOT_RMS] = "rms",       [PLOT_NORMAL] = "normal force",
        [PLOT_ALPHA] = "α, right axis", [PLOT_GROUND] = "ground", [PLOT_TRAJECTORY] = "trajectory S"};
    for (int i = 0; i < p->n_tables; i++) {
        if (!p->tables[i].x[column] || p->tables[i].n == 0) continue;
        fprintf(g->in, "%s $table%d using 1:%d with ", *any ? "," : "plot", i, (int)column + 2);
        fprintf(g->in, style, colours[(column == PLOT_ALPHA && p->n_tables == 1 ? 1 : i) % 4]);
        /* Name of a curve in the key: what it is, and of which contact if there are several. */
        const char *name = p->tables[i].name;
        fputs(" title ", g->in);
        gnuplot_put_text(g, *name ? arena_format(p->arena, "%s, %s", name, what[column]) : what[column]);
        *any = true;
    }
    return *any;
}

/* ------------------------------------------------------------------ the page */

/* A panel over time; the last has the axis' numbers. */
static void draw_timed(const struct plot_page *p, int panel, const double place[2], struct gnuplot *g)
{
    fprintf(g->in, "set bmargin at screen %.5f\nset tmargin at screen %.5f\n", place[0], place[0] + place[1]);
    if (panel == PLOT_WAVEFORM) {
        const struct plot_sound *o = p->sound;
        double most = o->peak > 0 ? 1.25 * o->peak : 1;
        const char *which =
            p->channels > 1 ? arena_format(p->arena, "channel %d of %d, ", p->channel, p->channels) : "";
        fprintf(g->in, "set ylabel 'amplitude / full scale'\nset yrange [%.6g:%.6g]\n", -most, most);
        if (o->peak > 0)
            fprintf(g->in, "set key title '%speak %.1f dBFS, rms %.1f dBFS'\n", which, 20 * real_log10(o->peak),
                    20 * real_log10(o->rms));
        else
            fprintf(g->in, "set key title '%ssilent'\n", which);
        fputs("plot $sound using 1:2:3 with filledcurves fillcolor rgb '#0072b2' notitle, '' using 1:2 with lines "
              "linewidth 0.5 linecolor rgb '#0072b2' notitle, '' using 1:3 with lines linewidth 0.5 linecolor rgb "
              "'#0072b2' notitle\n"
              "unset key\nset key notitle\n",
              g->in);
    } else if (panel == PLOT_SPECTROGRAM)
        draw_spectrogram(p, place[0], place[1], g);
    else if (panel == PLOT_FORCE) {
        bool any = false;
        fprintf(g->in, "set ylabel 'contact force / N'\nset yrange [0:%.6g]\n",
                1.25 * most_of(p, plot_data_has(p, PLOT_PEAK) ? PLOT_PEAK : PLOT_RMS));
        draw_put_curves(p, PLOT_PEAK, "filledcurves y=0 fillcolor rgb '%s' fillstyle transparent solid 0.35 noborder",
                        &any, g);
        draw_put_curves(p, PLOT_RMS, "lines linewidth 1.2 linecolor rgb '%s'", &any, g);
        fputs(any ? "\n" : "plot NaN notitle\n", g->in);
    } else if (panel == PLOT_FOLLOWED) { /* as figure 2 of papers/000 */
        bool any = false;
        double most = fmax(plot_data_has(p, PLOT_GROUND) ? most_of(p, PLOT_GROUND) : 0,
                           plot_data_has(p, PLOT_TRAJECTORY) ? most_of(p, PLOT_TRAJECTORY) : 0);
        fprintf(g->in, "set ylabel 'height / µm'\nset yrange [%.6g:%.6g]\n", -1.25e6 * most, 1.25e6 * most);
        draw_put_curves(p, PLOT_GROUND, "lines linewidth 1.2 linecolor rgb '#999999'", &any, g);
        draw_put_curves(p, PLOT_TRAJECTORY, "lines linewidth 1.6 linecolor rgb '%s'", &any, g);
        fputs(any ? "\n" : "plot NaN notitle\n", g->in);
    } else {
        bool any = false;
        fprintf(g->in, "set ylabel 'normal force / N'\nset yrange [0:%.6g]\n", 1.25 * most_of(p, PLOT_NORMAL));
        if (plot_data_has(p, PLOT_ALPHA))
            fprintf(g->in, "set y2tics\nset y2label 'α / cm'\nset y2range [0:%.6g]\n", 160 * most_of(p, PLOT_ALPHA));
        draw_put_curves(p, PLOT_NORMAL, "lines linewidth 1.6 linecolor rgb '%s'", &any, g);
        draw_put_curves(p, PLOT_ALPHA, "lines axes x1y2 linewidth 1.6 dashtype 2 linecolor rgb '%s'", &any, g);
        fputs(any ? "\n" : "plot NaN notitle\n", g->in);
    }
    fputs("unset label 1\n", g->in);
}

/* A panel with axes of its own, from pixel to pixel; top: of the page's pixels, from below. */
static void draw_untimed(const struct plot_page *p,
                         void (*draw)(const struct plot_page *, const struct plot_place *, struct gnuplot *),
                         const double box[4], struct gnuplot *g)
{
    double whole = page_height(p);
    struct plot_place at = {box[0] / WIDTH, box[1] / WIDTH, box[2] / whole, box[3] / whole, {WIDTH, whole}};
    fprintf(g->in,
            "set lmargin at screen %.5f\nset rmargin at screen %.5f\nset bmargin at screen %.5f\nset tmargin at screen "
            "%.5f\n",
            at.left, at.right, at.bottom, at.top);
    draw(p, &at, g);
    fputs("unset label 1\n", g->in);
}

void plot_draw(void *page, struct gnuplot *g)
{
    const struct plot_page *p = page;
    double whole = page_height(p), top = whole - TOP; /* how far down the page is drawn, in pixels from below */
    const struct plot_sound *o = p->sound;
    if (o) fputs("$sound << END\n", g->in);
    for (int c = 0; o && c < o->n; c++)
        fprintf(g->in, "%.9g %.9g %.9g\n", p->from + (c + 0.5) * ((p->to - p->from) / o->n), o->least[c], o->most[c]);
    if (o) fputs("END\n", g->in);
    for (int i = 0; i < p->n_tables; i++) {
        const struct plot_table *t = &p->tables[i];
        fprintf(g->in, "$table%d << END\n", i);
        for (int row = 0; row < t->n; row++) {
            fprintf(g->in, "%.9g", t->time[row]);
            for (int k = 0; k < PLOT_TABLE_COLUMNS; k++)
                fprintf(g->in, " %.9g",
                        t->x[k] ? t->x[k][row] * (k == PLOT_ALPHA    ? 100
                                                  : k >= PLOT_GROUND ? 1e6
                                                                     : 1)
                                : 0);
            fputc('\n', g->in);
        }
        fputs("END\n", g->in);
    }
    int height = (int)whole;
    gnuplot_page(g, p->svg, WIDTH, height);
    fputs("set palette defined (0 '#000004', 1 '#280b54', 2 '#65156e', 3 '#9f2a63', 4 '#d44842', 5 '#f57d15', 6 "
          "'#fac127', 7 '#fcffa4')\n"
          "set style fill solid 1.0 noborder\n"
          "set ylabel offset 1,0\nset y2label offset -1,0\nset cblabel offset 1.2,0\n"
          "set key noenhanced top right inside horizontal samplen 2 spacing 1.0\n",
          g->in);
    fprintf(g->in, "set lmargin at screen %.5f\nset rmargin at screen %.5f\n", (double)LEFT / WIDTH,
            1 - (double)RIGHT / WIDTH);
    fputs("set multiplot\nset label 1 ", g->in);
    gnuplot_put_text(g, p->title);
    fprintf(g->in, " at screen %.5f, screen %.5f noenhanced font ',13'\n", (double)LEFT / WIDTH,
            1 - 0.5 * TOP / height);
    int last = -1; /* of the panels over time */
    for (int k = 0; k < PLOT_MOTION; k++)
        last = plot_panels_there(p, k) ? k : last;
    if (last >= 0) fprintf(g->in, "set xrange [%.9g:%.9g]\n", p->from, p->to);
    for (int k = 0; k <= last; k++) {
        if (!plot_panels_there(p, k)) continue;
        fputs(k == last ? "set format x '%g'\nset xlabel 'time / s'\n" : "set format x ''\nunset xlabel\n", g->in);
        draw_timed(p, k, (const double[2]){(top - heights[k]) / whole, heights[k] / whole}, g);
        top -= heights[k] + (k == last ? BOTTOM : GAP);
    }
    fputs("unset y2tics\nunset y2label\nset autoscale y2\nset key tmargin\n", g->in);
    if (has_row(p)) { /* alone each takes the whole width */
        bool motion = plot_panels_there(p, PLOT_MOTION), modes = plot_panels_there(p, PLOT_MODES);
        double high = top - KEY, low = high - heights[PLOT_MOTION], right = WIDTH - RIGHT, middle = (LEFT + right) / 2;
        if (motion)
            draw_untimed(p, plot_motion, (const double[4]){LEFT, modes ? middle - BETWEEN / 2.0 : right, low, high}, g);
        if (modes)
            draw_untimed(p, plot_modes, (const double[4]){motion ? middle + BETWEEN / 2.0 : LEFT, right, low, high}, g);
        top -= KEY + heights[PLOT_MOTION] + BOTTOM;
    }
    if (plot_panels_there(p, PLOT_DECAYS))
        draw_untimed(p, plot_modes_decays,
                     (const double[4]){LEFT, WIDTH - RIGHT, top - KEY - heights[PLOT_DECAYS], top - KEY}, g);
    fputs("unset multiplot\n", g->in);
}
