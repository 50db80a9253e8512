/* The way of a contact: as its table of diagnostics has it, or, where there is none, as the scene's motion goes. Not more places than a panel can show. */
#include <math.h>
#include <string.h>

#include "cmd/plot.h"
#include "trajectory/trajectory.h"

enum { MOST = 4000 };

static void add(struct plot_page *p, const struct plot_way *way)
{
    bool moves = false;
    for (int i = 1; i < way->n; i++)
        moves = moves || way->at[i][0] != way->at[0][0] || way->at[i][1] != way->at[0][1];
    if (!moves)
        return;
    struct plot_way *ways = ARENA_TAKE(p->arena, struct plot_way, p->n_ways + 1);
    if (p->n_ways)
        memcpy(ways, p->ways, (size_t)p->n_ways * sizeof *ways);
    ways[p->n_ways++] = *way;
    p->ways = ways;
}

/* Columns of x, y and speed; the last may be missing. */
static bool find(const struct csv *csv, int column[3])
{
    static const char *const names[3] = {"x_m", "y_m", "speed_m_per_s"};
    for (int k = 0; k < 3; k++)
        column[k] = csv_column(csv, names[k]);
    return column[0] >= 0 && column[1] >= 0;
}

bool plot_way_table(struct plot_page *p, const char *name, const struct csv *csv, const double *times, struct err *e)
{
    struct plot_way way = {.name = name};
    int column[3];
    size_t shown = 0, each = 0;
    if (!find(csv, column))
        return true;
    for (size_t row = 0; row < csv->rows; row++)
        shown += times[row] >= p->from && times[row] <= p->to;
    size_t step = (shown + MOST - 1) / MOST;
    way.at = (double(*)[3])arena_take(p->arena, MOST + 2, sizeof *way.at);
    for (size_t row = 0; row < csv->rows; row++) {
        if (!(times[row] >= p->from && times[row] <= p->to) || (each++ % step && each != shown))
            continue;
        double *to = way.at[way.n++];
        for (int k = 0; k < 3; k++)
            if (column[k] >= 0 && !csv_number(csv, row, column[k], &to[k], e))
                return false;
    }
    add(p, &way);
    return true;
}

bool plot_way_scene(struct plot_page *p, const struct scene *s, const struct contact *c, struct err *e)
{
    struct trajectory tr;
    if (!trajectory_make(&c->motion, trajectory_seed(s, c), p->arena, &tr, e))
        return false;
    double from = fmax(p->from - c->start, 0), to = fmin(p->to - c->start, tr.duration), *t = ARENA_TAKE(p->arena, double, 4 * MOST), *x = t + MOST, *y = x + MOST, *du = y + MOST;
    struct plot_way way = {s->n_contacts > 1 ? c->name : "", MOST, (double(*)[3])arena_take(p->arena, MOST, sizeof *way.at)};
    if (!(from < to))
        return true;
    for (int i = 0; i < MOST; i++)
        t[i] = from + (to - from) * i / (MOST - 1);
    trajectory_at(&tr, MOST, t, (struct trajectory_out){.x = x, .y = y, .du = du});
    for (int i = 0; i < MOST; i++)
        memcpy(way.at[i], (const double[3]){x[i], y[i], fabs(du[i])}, sizeof way.at[i]);
    add(p, &way);
    return true;
}

const struct plot_way *plot_way_of(const struct plot_page *p, const struct scene *s, const struct contact *c)
{
    for (int i = 0; i < p->n_ways; i++)
        if (s->n_contacts == 1 || !strcmp(p->ways[i].name, c->name))
            return &p->ways[i];
    return NULL;
}
