/* The plan of the motion: the way seen from above, coloured by speed, with where it begins and ends, the object's edges, and the places of the mode table. One metre is as long
   along x as along y. An object, or a table's places, that reach much farther than the way are cut off by the panel. */
#include <math.h>

#include "cmd/plot.h"

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

static double size_of(const struct view *v)
{
    return fmax(v->high[0] - v->low[0], v->high[1] - v->low[1]);
}

/* All of the way, and of what it lies on. */
static struct view view_of(const struct plot_page *p)
{
    struct view way = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}}, all;
    for (int i = 0; i < p->n_ways; i++)
        for (int k = 0; k < p->ways[i].n; k++)
            take(&way, p->ways[i].at[k][0], p->ways[i].at[k][1]);
    all = way;
    for (int i = 0; i < p->n_grounds; i++) {
        const struct plot_ground *g = &p->grounds[i];
        if (g->box) {
            take(&all, g->low[0], g->low[1]);
            take(&all, g->high[0], g->high[1]);
        }
        for (int k = 0; k < g->n; k++)
            take(&all, g->places[k][0], g->places[k][1]);
    }
    return size_of(&all) > FAR * size_of(&way) ? way : all;
}

/* Some air, and then as much more along one axis as makes the scales equal. */
static void fit(struct view *v, const struct plot_place *at)
{
    double pixels[2] = {(at->right - at->left) * at->size[0], (at->top - at->bottom) * at->size[1]}, scale = 0;
    for (int k = 0; k < 2; k++)
        scale = fmax(scale, 1.12 * (v->high[k] - v->low[k]) / pixels[k]);
    for (int k = 0; k < 2; k++) {
        double middle = (v->low[k] + v->high[k]) / 2;
        v->low[k] = middle - scale * pixels[k] / 2;
        v->high[k] = middle + scale * pixels[k] / 2;
    }
}

static bool seen(const struct view *v, const double at[2])
{
    return at[0] >= v->low[0] && at[0] <= v->high[0] && at[1] >= v->low[1] && at[1] <= v->high[1];
}

static void data(const struct plot_page *p, double unit, const struct view *v, FILE *f)
{
    for (int i = 0; i < p->n_ways; i++) {
        fprintf(f, "$way%d << END\n", i);
        for (int k = 0; k < p->ways[i].n; k++)
            fprintf(f, "%.9g %.9g %.9g\n", p->ways[i].at[k][0] / unit, p->ways[i].at[k][1] / unit, p->ways[i].at[k][2]);
        fputs("END\n", f);
    }
    for (int i = 0; i < p->n_grounds; i++) {
        fprintf(f, "$places%d << END\n", i);
        for (int k = 0; k < p->grounds[i].n; k++)
            if (seen(v, p->grounds[i].places[k]))
                fprintf(f, "%.9g %.9g\n", p->grounds[i].places[k][0] / unit, p->grounds[i].places[k][1] / unit);
        fputs("NaN NaN\nEND\n", f);
    }
}

static double fastest(const struct plot_page *p)
{
    double most = 0;
    for (int i = 0; i < p->n_ways; i++)
        for (int k = 0; k < p->ways[i].n; k++)
            most = fmax(most, p->ways[i].at[k][2]);
    return most > 0 ? most : 1;
}

/* Edges as objects, behind all else. */
static void put_edges(const struct plot_page *p, double unit, FILE *f)
{
    for (int i = 0; i < p->n_grounds; i++) {
        const struct plot_ground *g = &p->grounds[i];
        if (!g->box)
            continue;
        if (g->round)
            fprintf(f, "set object %d ellipse center %.9g,%.9g size %.9g,%.9g", i + 1, (g->low[0] + g->high[0]) / 2 / unit, (g->low[1] + g->high[1]) / 2 / unit,
                    (g->high[0] - g->low[0]) / unit, (g->high[1] - g->low[1]) / unit);
        else
            fprintf(f, "set object %d rectangle from %.9g,%.9g to %.9g,%.9g", i + 1, g->low[0] / unit, g->low[1] / unit, g->high[0] / unit, g->high[1] / unit);
        fputs(" behind fillcolor rgb '#f4efe6' fillstyle solid 1.0 border linecolor rgb '#9a8f7a'\n", f);
    }
}

static void put_curves(const struct plot_page *p, FILE *f)
{
    bool first = true, named = false;
    fputs("plot ", f);
    for (int i = 0; i < p->n_grounds; i++)
        if (p->grounds[i].n) {
            fprintf(f, "%s$places%d using 1:2 with points pointtype 2 pointsize 0.6 linecolor rgb '#707070' %s", first ? "" : ", ", i, named ? "notitle" : "title 'places'");
            first = false;
            named = true;
        }
    for (int i = 0; i < p->n_ways; i++) {
        fprintf(f, "%s$way%d using 1:2:3 with lines linewidth 2.5 linecolor palette notitle", first ? "" : ", ", i);
        fprintf(f, ", $way%d using 1:2 every ::0::0 with points pointtype 7 pointsize 1.3 linecolor rgb 'black' %s", i, i ? "notitle" : "title 'start'");
        fprintf(f, ", $way%d using 1:2 every ::%d::%d with points pointtype 4 pointsize 2.2 linewidth 1.6 linecolor rgb 'black' %s", i, p->ways[i].n - 1, p->ways[i].n - 1,
                i ? "notitle" : "title 'end'");
        first = false;
    }
    fputc('\n', f);
}

void plot_motion(const struct plot_page *p, const struct plot_place *at, struct gnuplot *g)
{
    struct view v = view_of(p);
    fit(&v, at);
    bool small = v.high[0] - v.low[0] < 0.03;
    double unit = small ? 1e-3 : 1e-2;
    data(p, unit, &v, g->in);
    fprintf(g->in, "set xlabel 'x / %s'\nset ylabel 'y / %s'\nset format x '%%g'\n", small ? "mm" : "cm", small ? "mm" : "cm");
    fprintf(g->in, "set xrange [%.9g:%.9g]\nset yrange [%.9g:%.9g]\nset cbrange [0:%.6g]\n", v.low[0] / unit, v.high[0] / unit, v.low[1] / unit, v.high[1] / unit, fastest(p));
    fputs("set palette defined (0 '#0d0887', 1 '#7e03a8', 2 '#cc4778', 3 '#f0804e', 4 '#f9a242')\nset cblabel 'speed / (m/s)'\nset cbtics auto\n", g->in);
    fprintf(g->in, "set colorbox user origin screen %.5f, screen %.5f size screen %.5f, screen %.5f\n", at->right + 14 / at->size[0], at->bottom, 14 / at->size[0], at->top - at->bottom);
    fprintf(g->in, "set key at screen %.5f, screen %.5f right bottom maxrows 1\n", at->right, at->top + 3 / at->size[1]);
    put_edges(p, unit, g->in);
    put_curves(p, g->in);
    fputs("unset colorbox\nunset object\nset key default\nset key noenhanced top right inside horizontal samplen 2 spacing 1.0\n", g->in);
}
