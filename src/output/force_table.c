/* Penetration, height and energies are those at the row's first frame; contact is the mean over its frames, lift-offs
 * their sum. */
#include "output/force_table.h"

#include <math.h>
#include <string.h>

#include "file/npy.h"
#include "force/impact_series.h"
#include "force/scrape.h"
#include "force/strike.h"
#include "num/decimal.h"
#include "scene/rows.h"
#include "stage.h"
#include "surface/limiter.h"
#include "trajectory/contact.h"
#include "trajectory/load.h"
#include "trajectory/spin.h"
#include "trajectory/trajectory.h"

/* ------------------------------------------------------------------ the columns of every contact */

enum column {
#define COLUMN(id, name, lacks, meaning) id,
#include "output/columns.def"
#undef COLUMN
    COLUMNS,
    MOST = COLUMNS + 64 /* with those of effects (scene/params.h) */
};

static const char *pressed_lacks(const struct contact *c)
{
    return contact_pressed(c) ? "" : "contact.model: scrape or roll";
}

static const char *alpha_lacks(const struct contact *c)
{
    const char *lacks = pressed_lacks(c);
    return *lacks || limiter_of(c)->curve == LIMITER_TANH ? lacks : "contact.limiter.curve: tanh";
}

static const char *followed_lacks(const struct contact *c)
{
    const char *lacks = pressed_lacks(c);
    return *lacks || contact_rolls(c) || scrape_law(c)->force == FORCE_DIRECTIONAL ? lacks
                                                                                   : "contact.force: directional";
}

static const char *lift_lacks(const struct contact *c)
{
    if (contact_rolls(c)) return "";
    if (c->contact.model != CONTACT_SCRAPE) return "contact.model: scrape, roll or roll_coupled";
    return c->grip.given || c->load.recorded ? "" : "a grip or a recorded load";
}

static const char *impacts_lacks(const struct contact *c)
{
    int model = c->contact.model;
    return model == CONTACT_STRIKE || model == CONTACT_IMPACTS ? "" : "contact.model: strike or impacts";
}

static const char *ball_lacks(const struct contact *c)
{
    return contact_rolls(c) ? "" : "contact.model: roll or roll_coupled";
}

static const char *coupled_lacks(const struct contact *c)
{
    return c->contact.model == CONTACT_ROLL_COUPLED ? "" : "contact.model: roll_coupled";
}

static const struct params_column own_columns[] = {
#define COLUMN(id, name, lacks, meaning) {name, meaning, NULL},
#include "output/columns.def"
#undef COLUMN
    {.name = NULL}};

static const char *own_lacks(const struct contact *c, const struct params_column *column)
{
    static const char *(*const lacks_of[])(const struct contact *) = {
#define COLUMN(id, name, lacks, meaning) lacks,
#include "output/columns.def"
#undef COLUMN
    };
    return lacks_of[column - own_columns] ? lacks_of[column - own_columns](c) : "";
}

static const struct choice formats[] = {
    [TABLE_CSV] = {"csv", "NAME.csv (of several contacts NAME.CONTACT.csv): text, %.9g"},
    [TABLE_NPY] = {"npy", "NAME.npy (NAME.CONTACT.npy): NumPy's format, a field of float64 for each column: t = "
                          "numpy.load(\"NAME.npy\"), t[\"force_rms_n\"]; for many rows"},
    {NULL, NULL}};

static const struct key keys[] = {{ROW_NUMBER(scene, output.diagnostics.rate, "output.diagnostics.rate"), KEY_FREQUENCY,
                                   1, 768000, "1 kHz", NULL, "rows per second"},
                                  {ROW_LIST(scene, output.diagnostics.columns, "output.diagnostics.columns"), KEY_NONE,
                                   0, 0, "", NULL, "columns to write; left out: all that the scene has",
                                   .example = "[speed_m_per_s, normal_force_n]",
                                   .shown = "[time_s, speed_m_per_s, normal_force_n]"},
                                  {ROW_CHOICE(scene, output.diagnostics.format, "output.diagnostics.format"), KEY_NONE,
                                   0, 0, "csv", NULL, "how the table is written", formats},
                                  {.path = NULL}};

const struct params force_table_params = {
    .section = "output.diagnostics",
    .shown = true,
    .keys = keys,
    .meaning = "a table of the physics behind the sound",
    .flag = offsetof(struct scene, output.diagnostics.given),
    .columns = own_columns,
    .lacks = own_lacks,
};

/* ------------------------------------------------------------------ their values */

struct roll_rows {
    struct spin spin;
    double first[ROLL_VALUES]; /* at the first frame of the row being filled */
    double contact, lift_offs; /* sums over it */
};

enum { ROW_MOTION_SOME = 64 };

struct row_motion {
    const bool *wanted;          /* [COLUMNS]                                */
    const struct load_law *load; /* NULL: nothing is pressed on              */
    double alpha;                /* m, where no limiter varies it            */
    long rows, first, n;         /* of the table; those at hand              */
    double value[COLUMNS][ROW_MOTION_SOME];
};

static const struct {
    enum column column;
    enum roll_value value;
} sampled[] = {{PENETRATION, ROLL_PENETRATION},
               {HEIGHT, ROLL_HEIGHT},
               {ENERGY, ROLL_ENERGY},
               {SURFACE_WORK, ROLL_SURFACE_WORK},
               {CONTACT_LOSS, ROLL_CONTACT_LOSS},
               {MODE_LOSS, ROLL_MODE_LOSS},
               {RESIDUAL, ROLL_RESIDUAL}};
enum { SAMPLED = sizeof sampled / sizeof sampled[0] };

/* What takes more time than the render may have to spare is written only where it is named. */
static bool column_by_name(const struct contact *c, int k)
{
    return k != GROUND && k != TRAJECTORY && !*params_column_lacks(c, k);
}

/* Instants are read ROW_MOTION_SOME at a time: at the audio rate that takes a third of what one by one does. alpha is
 * that of the force without approach and release. */

static const enum column columns[] = {TIME, X, Y, VX, VY, STROKE, SPEED, VELOCITY, ACCELERATION, NORMAL, ALPHA};

static double *asked(struct row_motion *m, enum column k) { return m->wanted[k] ? m->value[k] : NULL; }

static void row_motion_fill(struct row_motion *m, const struct stage_run *r, long row)
{
    double at[ROW_MOTION_SOME], *v[COLUMNS],
        start = (double)contact_first_frame(r->contact, r->board->rate) / r->board->rate;
    m->first = row;
    m->n = m->rows - row < ROW_MOTION_SOME ? m->rows - row : ROW_MOTION_SOME;
    for (int k = 0; k < COLUMNS; k++)
        v[k] = m->value[k];
    for (long i = 0; i < m->n; i++) {
        at[i] = (double)(row + i) / r->scene->output.diagnostics.rate;
        v[TIME][i] = start + at[i];
    }
    trajectory_at(r->board->trajectory, (size_t)m->n, at,
                  (struct trajectory_out){.u = v[STROKE],
                                          .du = v[VELOCITY],
                                          .ddu = asked(m, ACCELERATION),
                                          .x = asked(m, X),
                                          .y = asked(m, Y),
                                          .vx = asked(m, VX),
                                          .vy = asked(m, VY)});
    for (long i = 0; i < m->n; i++)
        v[SPEED][i] = fabs(v[VELOCITY][i]);
    double load[ROW_MOTION_SOME];
    if (!m->load || (!m->wanted[NORMAL] && !m->wanted[ALPHA])) return;
    load_along(m->load, r->board->trajectory, (size_t)m->n, at, load);
    for (long i = 0; i < m->n; i++) {
        load[i] = fmax(load[i], 0);
        m->value[NORMAL][i] = load[i] * load_lowered(m->load, at[i]);
        m->value[ALPHA][i] = m->alpha;
    }
    if (r->board->limiter && m->wanted[ALPHA]) limiter_alpha(r->board->limiter, (size_t)m->n, load, m->value[ALPHA]);
}

/* The stage that writes diagnostics rows. Row k belongs to [t, t + T), t = k T after the contact's first frame, T =
   1/rate: kinematics, normal force and alpha are those at t; forces are the mean, rms and largest magnitude (with its
   sign) of the audio-rate force over the samples in the interval; events are counted in it. Of a ball see
   the top of this file. Rows end with the motion. Numbers are printed with %.9g, lines end in LF; as NPY
   (file/npy.h) they are doubles, and how many rows there will be is known when the header is written. */

struct force_table {
    bool wanted[MOST], npy;
    const struct params_column *of[MOST]; /* all columns there are */
    const struct stage_run *by[MOST];     /* the stage that tells its value; NULL: this one does */
    int n;                                /* columns */
    double value[MOST];
    double sum, squares, peak; /* of the row being filled */
    long samples, lift_offs, row, rows;
    long behind;                      /* sample that is the first behind the row */
    double followed[FOLLOWED_VALUES]; /* at the first frame of the row being filled */
    struct row_motion motion;
    struct strike_train train; /* of what strikes: the impacts from `impact` on     */
    struct strike_impact impact;
    bool struck;                /* there is such a one                               */
    struct impact_train series; /* of model impacts                                  */
    struct roll_rows ball;
};

/* Does the scene ask for any column from `first` to `last`? */
static bool column_asked(const struct contact *c, const struct scene *s, int first, int last)
{
    const char **names = s->output.diagnostics.columns;
    for (int k = first; k <= last; k++) {
        if (!names && column_by_name(c, k)) return true;
        for (int i = 0; names && names[i]; i++)
            if (params_column_find(names[i]) == k) return true;
    }
    return false;
}

static unsigned force_table_asks(const struct contact *c, const struct scene *s)
{
    unsigned items = 0;
    if (load_varies(c) &&
        (column_asked(c, s, NORMAL, NORMAL) || (column_asked(c, s, LIFT_OFFS, LIFT_OFFS) && !contact_rolls(c))))
        items |= ITEM_BIT(ITEM_LOAD);
    bool ball = column_asked(c, s, CONTACT_SHARE, CONTACT_SHARE) || column_asked(c, s, LIFT_OFFS, LIFT_OFFS);
    for (int i = 0; i < SAMPLED; i++)
        ball = ball || column_asked(c, s, (int)sampled[i].column, (int)sampled[i].column);
    if (ball && contact_rolls(c)) items |= ITEM_BIT(ITEM_ROLL);
    if (column_asked(c, s, GROUND, TRAJECTORY) && !*followed_lacks(c)) items |= ITEM_BIT(ITEM_FOLLOWED);
    if (load_varies(c) && column_asked(c, s, ALPHA, ALPHA) && !*params_column_lacks(c, ALPHA))
        items |= ITEM_BIT(ITEM_ALPHA);
    if (column_asked(c, s, MEAN, PEAK)) items |= ITEM_BIT(ITEM_FORCE);
    const struct params *whose;
    for (int k = COLUMNS; params_column(k, &whose); k++)
        if (column_asked(c, s, k, k)) items |= whose->gives;
    return items | ITEM_BIT(ITEM_MOTION); /* read at a row's own instant */
}

static bool force_table_wanted(const struct contact *c, const struct scene *s)
{
    (void)c;
    return s->output.diagnostics.given;
}

static double force_table_work(const struct contact *c, const struct scene *s)
{
    double row = s->output.diagnostics.format == TABLE_NPY ? 600 : 1400; /* measured, of all columns */
    return 4 + (column_asked(c, s, MEAN, PEAK) ? row : 0.6 * row) * s->output.diagnostics.rate / s->output.sample_rate;
}

/* The reader has reported unknown columns, and those that this contact cannot have, with their place: output/output.c.
 */
static bool columns_choose(struct force_table *t, const struct stage_run *r, struct err *e)
{
    const char **names = r->scene->output.diagnostics.columns;
    const struct params *whose;
    while (t->n < MOST && (t->of[t->n] = params_column(t->n, &whose))) {
        t->wanted[t->n] = !names && column_by_name(r->contact, t->n);
        for (int i = 0; i < r->board->n_stages; i++)
            if (r->board->stages[i].stage->params == whose) t->by[t->n] = &r->board->stages[i];
        t->n++;
    }
    for (int i = 0; names && names[i]; i++) {
        int k = params_column_find(names[i]);
        if (k < 0 || *params_column_lacks(r->contact, k))
            return err_set(e, ERR_SCENE, "output.diagnostics.columns: contact '%s' has no column '%s'; take it out",
                           r->contact->name, names[i]);
        t->wanted[k] = true;
    }
    return true;
}

static bool force_table_open(struct stage_run *r, struct err *e)
{
    struct force_table *t = ARENA_TAKE(r->arena, struct force_table, 1);
    r->state = t;
    t->npy = r->scene->output.diagnostics.format == TABLE_NPY;
    /* Above the sample rate some rows would have no samples to take a force from. */
    const struct output *o = &r->scene->output;
    if (!(o->diagnostics.rate <= o->sample_rate))
        return err_set(e, ERR_SCENE,
                       "output.diagnostics.rate: %.9g Hz is above output.sample_rate, %.9g Hz: some rows would have no "
                       "samples of the force; lower it",
                       o->diagnostics.rate, o->sample_rate);
    if (!columns_choose(t, r, e)) return false;
    /* The law of a varying load is on the board; a constant one's is needed for approach and release. */
    int model = r->contact->contact.model;
    if (contact_pressed(r->contact)) {
        struct load_law *own = ARENA_TAKE(r->arena, struct load_law, 1);
        t->motion.load = r->board->load ? r->board->load : own;
        if (!r->board->load && !load_make(r->contact, r->board->trajectory, r->arena, own, e)) return false;
    }
    if (t->wanted[IMPACTS] && model == CONTACT_IMPACTS) {
        if (!impact_series_train(r, &t->series, e)) return false;
    } else if (t->wanted[IMPACTS]) {
        if (!strike_make(r->contact, r->board->trajectory->duration, &t->train, e)) return false;
        t->struck = strike_next(&t->train, &t->impact);
    }
    if (contact_rolls(r->contact)) t->ball.spin = spin_make(r->contact);
    t->motion.alpha = limiter_constant(r->contact);
    t->motion.wanted = t->wanted;
    t->rows = t->motion.rows = (long)ceil(r->board->trajectory->duration * r->scene->output.diagnostics.rate - 1e-9);
    const char *names[MOST];
    size_t n = 0;
    for (int k = 0; k < t->n; k++)
        if (t->wanted[k]) names[n++] = t->of[k]->name;
    if (t->npy) npy_write(r->board->table->stream, names, n, (size_t)t->rows);
    for (size_t k = 0; k < n && !t->npy; k++)
        fprintf(r->board->table->stream, "%s%c", names[k], k + 1 < n ? ',' : '\n');
    r->ahead = 1;
    r->ends = r->board->moving;
    return true;
}

static void row_write(struct force_table *t, const struct board *b)
{
    double n = t->samples > 0 ? (double)t->samples : 1;
    t->value[MEAN] = t->sum / n;
    t->value[RMS] = sqrt(t->squares / n);
    t->value[PEAK] = t->peak;
    t->value[LIFT_OFFS] = (double)t->lift_offs;
    t->value[GROUND] = t->followed[FOLLOWED_GROUND];
    t->value[TRAJECTORY] = t->followed[FOLLOWED_TRAJECTORY];
    if (board_has(b, ITEM_ROLL)) {
        for (int i = 0; i < SAMPLED; i++)
            t->value[sampled[i].column] = t->ball.first[sampled[i].value];
        t->value[CONTACT_SHARE] = t->samples > 0 ? t->ball.contact / (double)t->samples : 0;
        t->value[LIFT_OFFS] = t->ball.lift_offs;
        t->ball.contact = t->ball.lift_offs = 0;
    }
    if (t->npy) {
        double row[MOST];
        size_t some = 0;
        for (int k = 0; k < t->n; k++)
            if (t->wanted[k]) row[some++] = t->value[k] + 0.0;
        fwrite(row, sizeof *row, some, b->table->stream);
    } else {
        /* -0 is written as 0. */
        char text[MOST * (DECIMAL_ROOM + 1) + 1], *end = text;
        for (int k = 0; k < t->n; k++)
            if (t->wanted[k]) {
                end += decimal_9g(t->value[k] + 0.0, end);
                *end++ = ',';
            }
        *(end > text ? end - 1 : end++) = '\n';
        fwrite(text, 1, (size_t)(end - text), b->table->stream);
    }
    t->sum = t->squares = t->peak = 0;
    t->samples = t->lift_offs = 0;
}

static void rows_before(struct force_table *t, const struct stage_run *r, long end)
{
    double rate = r->scene->output.diagnostics.rate, *v = t->value;
    for (; t->row < end; t->row++) {
        struct row_motion *m = &t->motion;
        if (t->row >= m->first + m->n) row_motion_fill(m, r, t->row);
        for (size_t k = 0; k < sizeof columns / sizeof columns[0]; k++)
            v[columns[k]] = m->value[columns[k]][t->row - m->first];
        if (t->wanted[ROLL_ANGLE])
            spin_at(&t->ball.spin, 1, &v[STROKE], &v[VELOCITY], NULL, &(struct spin_out){.theta = &v[ROLL_ANGLE]});
        for (int k = COLUMNS; k < t->n; k++)
            if (t->wanted[k]) v[k] = t->by[k] ? t->of[k]->at(t->by[k], (double)t->row / rate) : 0;
        /* Impacts that begin (of a series: whose middle comes) before the row ends, and have not been counted; of those
           before the start, none. */
        double behind = (double)(t->row + 1) / rate;
        v[IMPACTS] = 0;
        while (t->series.any && t->series.next.time < behind)
            v[IMPACTS] += impact_series_take(&t->series).time >= 0;
        while (t->struck && t->impact.start < behind) {
            v[IMPACTS]++;
            t->struck = strike_next(&t->train, &t->impact);
        }
        row_write(t, r->board);
    }
}

/* A sample belongs to row floor(n rate_d / rate). */
static long row_of(const struct stage_run *r, long n)
{
    return (long)floor((double)n * r->scene->output.diagnostics.rate / r->board->rate);
}

/* A row is written when the first sample behind it comes, the last ones with the motion's last sample. */
static bool force_table_run(struct stage_run *r, long from, long to, struct err *e)
{
    struct force_table *t = r->state;
    const struct board *b = r->board;
    for (long n = from; n < to && t->row < t->rows; n++) {
        if (n >= t->behind) {
            long row = row_of(r, n);
            rows_before(t, r, row < t->rows ? row : t->rows);
            /* the first sample behind the row: this one, or one or two later */
            t->behind = (long)((double)(row + 1) * r->board->rate / r->scene->output.diagnostics.rate) - 1;
            while (row_of(r, t->behind) <= row)
                t->behind++;
        }
        if (board_has(b, ITEM_FORCE)) {
            double f = *board_at(b, ITEM_FORCE, n);
            t->sum += f;
            t->squares += f * f;
            t->peak = fabs(f) > fabs(t->peak) ? f : t->peak;
        }
        if (board_has(b, ITEM_ROLL)) {
            const double *values = board_at(b, ITEM_ROLL, n);
            if (t->samples == 0) memcpy(t->ball.first, values, sizeof t->ball.first);
            t->ball.contact += values[ROLL_CONTACT];
            t->ball.lift_offs += values[ROLL_LIFT_OFFS];
        }
        if (board_has(b, ITEM_FOLLOWED) && t->samples == 0)
            memcpy(t->followed, board_at(b, ITEM_FOLLOWED, n), sizeof t->followed);
        t->samples++;
        if (board_has(b, ITEM_LOAD) && t->wanted[LIFT_OFFS]) {
            const double *load = board_at(b, ITEM_LOAD, n);
            for (int j = 0; j < b->over; j++)
                t->lift_offs += load[j] >= 0 && load[j + 1] < 0;
        }
        if (n == r->board->moving - 1) rows_before(t, r, t->rows);
    }
    return ferror(r->board->table->stream)
               ? err_set(e, ERR_IO, "the diagnostics table cannot be written (is the disk full?)")
               : true;
}

const struct stage force_table_stage = {
    .name = "force_table",
    .does = "rows of diagnostics",
    .paper = "",
    .idle = "no output.diagnostics",
    .asks = force_table_asks,
    .gives = ITEM_BIT(ITEM_TABLE),
    .knobs = KNOB_BIT(oversampling),
    .wanted = force_table_wanted,
    .work = force_table_work,
    .open = force_table_open,
    .run = force_table_run,
};
