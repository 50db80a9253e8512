/* The way of a contact: as its table of diagnostics has it, or, where there is none, as the scene's motion goes. Not
 * more places than a panel can show. */
#include "cmd/plot.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

#include "base/hash.h"
#include "base/text.h"
#include "cmd/tell.h"
#include "response/mode_table.h"
#include "response/object.h"
#include "response/space.h"
#include "scene/ball.h"
#include "scene/scene_read.h"
#include "trajectory/trajectory.h"

enum { MOST = 4000 };

static void add(struct plot_page *p, const struct plot_way *way)
{
    bool moves = false;
    for (int i = 1; i < way->n; i++)
        moves = moves || way->at[i][0] != way->at[0][0] || way->at[i][1] != way->at[0][1];
    if (!moves) return;
    p->ways = arena_more(p->arena, p->ways, p->n_ways, sizeof *p->ways);
    p->ways[p->n_ways++] = *way;
}

/* Columns of x, y and speed; the last may be missing. */
static bool find(const struct csv *csv, int column[3])
{
    static const char *const names[3] = {"x_m", "y_m", "speed_m_per_s"};
    for (int k = 0; k < 3; k++)
        column[k] = csv_column(csv, names[k]);
    return column[0] >= 0 && column[1] >= 0;
}

bool plot_bodies_way_table(struct plot_page *p, const char *name, const struct csv *csv, const double *times,
                           struct err *e)
{
    struct plot_way way = {.name = name};
    int column[3];
    size_t shown = 0, each = 0;
    if (!find(csv, column)) return true;
    for (size_t row = 0; row < csv->rows; row++)
        shown += times[row] >= p->from && times[row] <= p->to;
    size_t step = (shown + MOST - 1) / MOST;
    way.at = (double(*)[3])arena_take(p->arena, MOST + 2, sizeof *way.at);
    for (size_t row = 0; row < csv->rows; row++) {
        if (!(times[row] >= p->from && times[row] <= p->to) || (each++ % step && each != shown)) continue;
        double *to = way.at[way.n++];
        for (int k = 0; k < 3; k++)
            if (column[k] >= 0 && !csv_number(csv, row, column[k], &to[k], e)) return false;
    }
    add(p, &way);
    return true;
}

static bool plot_bodies_way_scene(struct plot_page *p, const struct scene *s, const struct contact *c, struct err *e)
{
    struct trajectory tr;
    if (!trajectory_make(&c->motion, trajectory_seed(s, c), p->arena, &tr, e)) return false;
    double from = fmax(p->from - c->start, 0), to = fmin(p->to - c->start, tr.duration),
           *t = ARENA_TAKE(p->arena, double, 4 * MOST), *x = t + MOST, *y = x + MOST, *du = y + MOST;
    struct plot_way way = {s->n_contacts > 1 ? c->name : "", MOST,
                           (double(*)[3])arena_take(p->arena, MOST, sizeof *way.at)};
    if (!(from < to)) return true;
    for (int i = 0; i < MOST; i++)
        t[i] = from + (to - from) * i / (MOST - 1);
    trajectory_at(&tr, MOST, t, (struct trajectory_out){.x = x, .y = y, .du = du});
    for (int i = 0; i < MOST; i++)
        memcpy(way.at[i], (const double[3]){x[i], y[i], fabs(du[i])}, sizeof way.at[i]);
    add(p, &way);
    return true;
}

/* NULL: none */
static const struct plot_way *plot_bodies_way_of(const struct plot_page *p, const struct scene *s,
                                                 const struct contact *c)
{
    for (int i = 0; i < p->n_ways; i++)
        if (s->n_contacts == 1 || !strcmp(p->ways[i].name, c->name)) return &p->ways[i];
    return NULL;
}

/* What rings in a render, for `rasp plot`: the modes that its effective scene names, each with its largest gain along
   the motion; the edges of objects and the places of tables. Or the modes of a mode table, each with its largest gain
   over the places. */

enum { PLACES = 33 /* along the motion */ };

/* ------------------------------------------------------------------ a mode table */

bool plot_bodies_is_table(const struct csv *csv)
{
    return csv_column(csv, "frequency_hz") >= 0 && csv_column(csv, "mode") >= 0;
}

static void count(struct plot_mode *m, double frequency, double decay, double gain)
{
    if (gain > m->gain) *m = (struct plot_mode){frequency, decay, gain};
}

bool plot_bodies_table(struct plot_page *p, struct err *e)
{
    struct mode_table t;
    if (!mode_table_read(p->file, p->arena, &t, e)) return false;
    struct plot_body *b = p->bodies = ARENA_TAKE(p->arena, struct plot_body, 1);
    *b = (struct plot_body){"", (int)t.modes, ARENA_TAKE(p->arena, struct plot_mode, t.modes)};
    for (size_t k = 0; k < t.first[t.places]; k++)
        for (int s = 0; s < t.entry[k].n; s++)
            count(&b->modes[t.entry[k].mode], t.entry[k].frequency, t.entry[k].slope[s].decay,
                  fabs(t.entry[k].slope[s].gain));
    const char *title = csv_comment(&t.csv, "title");
    p->title = p->title ? p->title : title ? title : p->file;
    p->n_bodies = 1;
    p->table_of_modes = true;
    return true;
}

/* ------------------------------------------------------------------ a response */

/* Nothing: a recording, or none. */
static bool modes_of(const struct response *r, double rate, struct arena *a, struct modes *m, struct err *e)
{
    struct modes_ask ask = {
        .strongest = r->modes, .band = {r->band[0], r->band[1]}, .pairing = r->pairing, .rate = rate};
    struct object *o = ARENA_TAKE(a, struct object, 1);
    const char *note;
    bool ok = true;
    m->n = 0;
    if (r->object.given) {
        ok = object_make(
            &r->object,
            &(struct object_ask){.key = "object", .low = r->band[0], .top = r->band[1], .most = 4 * r->modes}, a, o,
            &note, e);
        if (ok) object_modes(o, r->object.origin, NULL, r->modes, a, m);
    } else if (r->space.given) {
        ok = space_modes(&r->space, &ask, a, m, e);
    } else if (r->file && text_ends(r->file, ".csv")) {
        ok = modes_table(r->file, &ask, a, m, e);
    }
    if (ok && m->n) modes_drop_above(m, rate);
    return ok;
}

static void add_body(struct plot_page *p, const struct modes *m, const struct plot_way *way, double share,
                     const char *name)
{
    struct modes_point point = modes_point_make(p->arena, m->n);
    struct plot_body *b = &p->bodies[p->n_bodies++];
    *b = (struct plot_body){name, m->n, ARENA_TAKE(p->arena, struct plot_mode, m->n)};
    for (int k = 0; k < PLACES; k++) {
        int at = way ? (int)((long)k * (way->n - 1) / (PLACES - 1)) : -1;
        struct modes_where where = {at < 0 ? m->home[0] : way->at[at][0], at < 0 ? m->home[1] : way->at[at][1],
                                    (double)k / (PLACES - 1)};
        modes_at(m, &where, &point);
        for (int i = 0; i < m->n; i++)
            count(&b->modes[i], m->shared ? m->frequency[i] : point.frequency[i],
                  m->shared ? m->decay[i] : point.decay[i],
                  share * sqrt(point.re[i] * point.re[i] + point.im[i] * point.im[i]));
    }
}

/* ------------------------------------------------------------------ seen from above */

static bool is_round(int shape) { return shape == OBJECT_DISK || shape == OBJECT_MEMBRANE || shape == OBJECT_DRUM; }

static bool add_ground(struct plot_page *p, const struct response *r, const struct modes *m, struct err *e)
{
    struct plot_ground *g = &p->grounds[p->n_grounds++];
    if (r->object.given && m->object && r->object.shape != OBJECT_SHELL) {
        g->box = true;
        g->round = is_round(r->object.shape);
        for (int k = 0; k < 2; k++) {
            g->low[k] = r->object.origin[k] + m->object->low[k];
            g->high[k] = r->object.origin[k] + m->object->high[k];
        }
    } else if (r->file && text_ends(r->file, ".csv") && !r->object.given && !r->space.given) {
        struct mode_table t;
        if (!mode_table_read(r->file, p->arena, &t, e)) return false;
        g->n = t.places > 1 ? (int)t.places : 0;
        g->places = (double(*)[2])arena_take(p->arena, t.places, sizeof *g->places);
        memcpy(g->places, t.xy, t.places * sizeof *g->places);
    }
    return true;
}

/* ------------------------------------------------------------------ a scene */

static bool add_contact(struct plot_page *p, const struct scene *s, const struct contact *c, struct err *e)
{
    const char *which = s->n_contacts > 1 ? arena_format(p->arena, " of %s", c->name) : "", *tool = ball_tool(c);
    struct modes m = {0};
    if (!plot_bodies_way_of(p, s, c) && !plot_bodies_way_scene(p, s, c, e)) return false;
    if (!modes_of(&c->surface.response, s->output.sample_rate, p->arena, &m, e) ||
        !add_ground(p, &c->surface.response, &m, e))
        return false;
    if (m.n) add_body(p, &m, plot_bodies_way_of(p, s, c), fabs(c->gain), arena_format(p->arena, "surface%s", which));
    if (c->scraper.weight == 0) return true;
    if (!modes_of(&c->scraper.response, s->output.sample_rate, p->arena, &m, e)) return false;
    if (m.n) add_body(p, &m, NULL, fabs(c->gain * c->scraper.weight), arena_format(p->arena, "%s%s", tool, which));
    return true;
}

bool plot_bodies(struct plot_page *p, const struct plot_summary *s, const char *effective, struct err *e)
{
    struct scene *scene = ARENA_TAKE(p->arena, struct scene, 1);
    const char *messages;
    char hex[HASH_TEXT];
    struct err why = {0};
    if (!*s->effective || access(effective, F_OK) != 0) return true;
    if (!hash_file(effective, hex, e)) return false;
    if (strcmp(hex, s->effective) != 0)
        err_set(&why, ERR_SCENE, "it is of another render: %s gives another sha256", s->file);
    else if (scene_read(effective, NULL, p->arena, scene, &messages, &why)) {
        p->bodies = ARENA_TAKE(p->arena, struct plot_body, 2 * scene->n_contacts);
        p->grounds = ARENA_TAKE(p->arena, struct plot_ground, scene->n_contacts);
        for (int i = 0; i < scene->n_contacts && !why.kind; i++)
            add_contact(p, scene, &scene->contacts[i], &why);
    }
    if (why.kind) {
        tell_warning(p->call, effective, arena_format(p->call->arena, "what rings is not drawn: %s", why.text));
        p->n_bodies = p->n_grounds = 0;
    }
    return true;
}
