/* rasp modes extract RECORDING... -o FILE.csv: the modes of an object from recordings of strikes, or from impulse
   responses, as a mode table. Operands are recordings, each FILE or FILE@X,Y, or one folder whose index.csv has
   file_name,x_m,y_m (and gain_db). */
#include "cmd/modes_extract.h"

#include <math.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/interrupt.h"
#include "base/outfile.h"
#include "file/csv.h"
#include "file/wav.h"
#include "num/real.h"
#include "output/mark.h"
#include "output/gnuplot.h"
#include "scene/rules.h"
#include "scene/units.h"

/* ------------------------------------------------------------------ options */

static bool quantity(struct modes_extract *x, const char *name, enum key_dimension d, double *value, struct err *e)
{
    const char *text = args_value(&x->c->args, name);
    struct units_fault fault = {NULL, NULL};
    *value = NAN;
    if (!text) return true;
    if (!units_read(text, d, value, x->arena, &fault))
        return err_set(e, ERR_USAGE, "--%s %s: %s", name, fault.text, fault.cure);
    return *value >= 0.0 || err_set(e, ERR_USAGE, "--%s: '%s' is below 0", name, text);
}

/* What belongs together. */
static bool together(struct modes_extract *x, struct err *e)
{
    const struct modes_extract_given *g = &x->given;
    const struct args *a = &x->c->args;
    bool radius = !isnan(g->radius), distance = !isnan(g->distance);
    const struct {
        bool broken;
        const char *message;
    } rules[] = {
        {(radius || distance) && g->quantity != MODES_PRESSURE,
         "--radius and --distance are for --quantity pressure, a microphone's"},
        {radius != distance,
         "--radius, of a sphere of the object's size, and --distance, from its middle to the microphone, "
         "belong together"},
        {radius && !(g->radius > 0.0 && g->distance > g->radius),
         arena_format(x->arena, "--distance %g m must be greater than --radius %g m, and both above 0", g->distance,
                      g->radius)},
        {g->impulse && (g->force_channel || g->only || args_given(a, "strike-threshold")),
         "--impulse says that the recording is an impulse response already: --force-channel, --strikes "
         "and --strike-threshold are for strikes"},
        {g->force_channel == g->channel,
         arena_format(x->arena, "--channel and --force-channel are both %ld; sound and force are in different channels",
                      g->channel)},
        {!g->force_channel && args_given(a, "force-scale"),
         "--force-scale needs --force-channel: which channel holds the force"},
        {g->force_channel && isnan(g->scale) != isnan(g->force_scale),
         arena_format(x->arena,
                      "--%s is missing: a level per N s takes --scale and --force-scale; without both it is relative",
                      isnan(g->scale) ? "scale" : "force-scale")},
        {!g->force_channel && !g->impulse && !isnan(g->scale),
         "--scale says nothing without a force: per how many N s? Give --force-channel, or --impulse"},
        {g->low >= g->high, arena_format(x->arena, "--low %g Hz is not below --high %g Hz", g->low, g->high)},
    };
    for (size_t k = 0; k < sizeof rules / sizeof *rules; k++)
        if (rules[k].broken) return err_set(e, ERR_USAGE, "%s", rules[k].message);
    return true;
}

/* Outputs: each may be written (output/mark.h), and no two are one file. */
static bool outputs(struct modes_extract *x, struct err *e)
{
    static const char *const names[MODES_EXTRACT_FILES] = {"output", "residual", "resynthesis", "plot"};
    struct modes_extract_given *g = &x->given;
    bool force = args_given(&x->c->args, "force");
    for (int k = 0; k < MODES_EXTRACT_FILES; k++) {
        const char *file = g->file[k] = args_value(&x->c->args, names[k]);
        if (file && !(k == MODES_EXTRACT_TABLE ? mark_absent(file, force, e) : mark_permits(file, NULL, force, e)))
            return false;
        for (int i = 0; file && i < k; i++)
            if (g->file[i] && !strcmp(file, g->file[i]))
                return err_set(e, ERR_USAGE, "--%s and --%s are both %s", names[i], names[k], file);
    }
    const char *plot = g->file[MODES_EXTRACT_PLOT];
    g->svg = plot && rules_ends_in(plot, ".svg");
    if (plot && !g->svg && !rules_ends_in(plot, ".png"))
        return err_set(e, ERR_USAGE, "--plot: '%s' ends in neither .png nor .svg", plot);
    return g->file[MODES_EXTRACT_TABLE] || err_set(e, ERR_USAGE, "-o FILE.csv is needed: the mode table to write");
}

static bool options(struct modes_extract *x, struct err *e)
{
    static const char *const quantities[] = {"displacement", "velocity", "acceleration", "pressure", NULL},
                             *const methods[] = {"esprit", "spectrogram", NULL};
    static const double scales[2] = {1e-300, 1e300}, rise[2] = {1, 120};
    static const long channels[2] = {1, 1024}, modes[2] = {1, 100000};
    const struct args *a = &x->c->args;
    struct modes_extract_given *g = &x->given;
    int method = 0;
    *g = (struct modes_extract_given){.channel = 1,
                                      .scale = NAN,
                                      .force_scale = NAN,
                                      .quantity = MODES_PRESSURE,
                                      .fastest = NAN,
                                      .threshold = 20.0,
                                      .modes = 50,
                                      .impulse = args_given(a, "impulse"),
                                      .only = args_value(a, "strikes")};
    if (!args_word(a, "quantity", quantities, &g->quantity, e) || !args_word(a, "method", methods, &method, e) ||
        !args_whole(a, "channel", channels, &g->channel, e) ||
        !args_whole(a, "force-channel", channels, &g->force_channel, e) ||
        !args_number(a, "scale", scales, &g->scale, e) || !args_number(a, "force-scale", scales, &g->force_scale, e) ||
        !args_number(a, "strike-threshold", rise, &g->threshold, e) ||
        !quantity(x, "radius", KEY_LENGTH, &g->radius, e) || !quantity(x, "distance", KEY_LENGTH, &g->distance, e) ||
        !quantity(x, "delay", KEY_TIME, &g->delay, e) || !quantity(x, "low", KEY_FREQUENCY, &g->low, e) ||
        !quantity(x, "high", KEY_FREQUENCY, &g->high, e) || !args_number(a, "fastest", scales, &g->fastest, e))
        return false;
    g->spectrogram = method == 1;
    if (isnan(g->delay) && g->quantity != MODES_PRESSURE && !g->impulse)
        g->delay = 0.0; /* what touches the object has no way to go */
    return together(x, e) && outputs(x, e) && args_whole(a, "modes", modes, &g->modes, e);
}

/* ------------------------------------------------------------------ places */

static bool length(struct modes_extract *x, const char *text, const char *operand, double *m, struct err *e)
{
    struct units_fault fault = {NULL, NULL};
    return units_read(text, KEY_LENGTH, m, x->arena, &fault) ||
           err_set(e, ERR_USAGE, "%s: the place behind @ is X,Y, each a length: '%s' %s", operand, text, fault.text);
}

static bool row(struct modes_extract *x, const struct csv *t, size_t k, const char *folder, struct err *e)
{
    enum { FILE_NAME, X, Y, GAIN, Z, COLUMNS };
    static const char *const names[] = {"file_name", "x_m", "y_m", "gain_db", "z_m"};
    struct modes_extract_place *p = &x->place[x->n++];
    int column[COLUMNS];
    double value[COLUMNS] = {0};
    for (int c = 0; c < COLUMNS; c++) {
        column[c] = csv_column(t, names[c]);
        if (column[c] < 0 && c <= Y)
            return err_set(e, ERR_SCENE, "%s: its columns are file_name,x_m,y_m and, if you like, z_m and gain_db",
                           t->file);
    }
    const char *name = t->cells[k * t->columns + (size_t)column[FILE_NAME]];
    if (name[0] == '\0' || name[0] == '/' || strstr(name, "../"))
        return err_set(e, ERR_SCENE, "%s:%d: '%s' is not a file in the folder", t->file, t->lines[k], name);
    for (int c = X; c < COLUMNS; c++)
        if (column[c] >= 0 && !csv_number(t, k, column[c], &value[c], e)) return false;
    if (fabs(value[GAIN]) > 200.0 || value[Z] != 0.0)
        return err_set(e, ERR_SCENE, "%s:%d: gain_db lies between -200 and 200 dB, and z_m is 0: places lie in a plane",
                       t->file, t->lines[k]);
    *p = (struct modes_extract_place){.file = arena_format(x->arena, "%s/%s", folder, name),
                                      .shown = name,
                                      .placed = true,
                                      .x = value[X],
                                      .y = value[Y],
                                      .gain = real_exp10(value[GAIN] / 20.0)};
    return true;
}

static bool folder(struct modes_extract *x, const char *path, struct err *e)
{
    struct csv t;
    x->index = arena_format(x->arena, "%s/index.csv", path);
    if (!csv_read_file(x->index, x->arena, &t, e))
        return e->kind == ERR_INPUT
                   ? err_at(e, "a folder of recordings has its places in index.csv (file_name,x_m,y_m)")
                   : false;
    if (t.rows == 0) return err_set(e, ERR_SCENE, "%s: has no rows; name at least one recording", t.file);
    x->place = ARENA_TAKE(x->arena, struct modes_extract_place, t.rows);
    for (size_t k = 0; k < t.rows; k++)
        if (!row(x, &t, k, path, e)) return false;
    return true;
}

/* FILE@X,Y; a file of the whole name goes first. */
static bool operands(struct modes_extract *x, struct err *e)
{
    const struct args *a = &x->c->args;
    struct stat s;
    if (a->n_operands == 1 && stat(a->operands[0], &s) == 0 && S_ISDIR(s.st_mode)) return folder(x, a->operands[0], e);
    x->place = ARENA_TAKE(x->arena, struct modes_extract_place, a->n_operands);
    for (; x->n < a->n_operands; x->n++) {
        struct modes_extract_place *p = &x->place[x->n];
        const char *text = a->operands[x->n];
        char *name = arena_text(x->arena, text), *at = strrchr(name, '@'), *comma = at ? strchr(at, ',') : NULL;
        *p = (struct modes_extract_place){.file = name, .shown = name, .gain = 1.0};
        if (!comma || access(text, F_OK) == 0) continue;
        *at = *comma = '\0';
        p->placed = true;
        if (!length(x, at + 1, text, &p->x, e) || !length(x, comma + 1, text, &p->y, e)) return false;
    }
    return true;
}

/* Several recordings are of as many places; and no output, --force or not, takes the place of what is read. */
static bool distinct(const struct modes_extract *x, struct err *e)
{
    for (int i = 0; x->n > 1 && i < x->n; i++) {
        const struct modes_extract_place *p = &x->place[i];
        if (!p->placed)
            return err_set(e, ERR_USAGE,
                           "%s: which place was struck? With several recordings each is FILE@X,Y, as in %s@10cm,3cm",
                           p->shown, p->shown);
        for (const struct modes_extract_place *q = x->place; q < p; q++)
            if (p->x == q->x && p->y == q->y)
                return err_set(
                    e, ERR_SCENE,
                    "%s and %s are both at (%g, %g) m: several strikes on one place belong into one recording",
                    q->shown, p->shown, p->x, p->y);
    }
    for (int k = 0; k < MODES_EXTRACT_FILES; k++)
        for (int i = 0; i <= x->n; i++) {
            const char *from = i < x->n ? x->place[i].file : x->index, *to = x->given.file[k];
            struct stat s, t;
            if (from && to && stat(from, &s) == 0 && stat(to, &t) == 0 && s.st_dev == t.st_dev && s.st_ino == t.st_ino)
                return err_set(e, ERR_CREATE, "the output %s would overwrite the input %s; give it another name", to,
                               from);
        }
    return true;
}

/* ------------------------------------------------------------------ samples */

static const double *channel(const struct wav *w, long number, double factor, struct arena *a)
{
    double *x = ARENA_TAKE(a, double, w->frames);
    for (size_t i = 0; i < w->frames; i++)
        x[i] = factor * w->x[i * (size_t)w->channels + (size_t)number - 1];
    return x;
}

/* rms of rounding to the file's steps, one step wide, per full scale: of an integer its last bit, of single precision
 * the last of its greatest sample; 0: of neither. */
static double rounding(const struct wav *w, long number)
{
    double most = 0.0;
    int exponent;
    if (w->bits) return ldexp(sqrt(1.0 / 12.0), 1 - w->bits);
    for (size_t i = 0; i < w->frames; i++) {
        double x = w->x[i * (size_t)w->channels + (size_t)number - 1];
        if ((double)(float)x != x) return 0.0;
        most = fmax(most, fabs(x));
    }
    frexp(most, &exponent);
    return ldexp(sqrt(1.0 / 12.0), exponent - 24);
}

static bool samples(struct modes_extract *x, struct modes_extract_place *p, struct arena *scratch, struct err *e)
{
    const struct modes_extract_given *g = &x->given;
    struct wav w;
    if (!wav_read(p->file, scratch, &w, e) || !hash_file(p->file, p->hash, e)) return false;
    if (g->channel > w.channels || g->force_channel > w.channels) {
        bool sound = g->channel > w.channels;
        return err_set(e, ERR_SCENE, "%s has %d channel%s; there is no --%s %ld", p->shown, w.channels,
                       w.channels == 1 ? "" : "s", sound ? "channel" : "force-channel",
                       sound ? g->channel : g->force_channel);
    }
    double scale = p->gain * (isnan(g->scale) ? 1.0 : g->scale),
           force_scale = isnan(g->force_scale) ? 1.0 : g->force_scale;
    struct strikes_recording *r = &p->recording;
    *r = (struct strikes_recording){.name = p->shown, .n = (long)w.frames, .rate = w.rate};
    r->rounding = fabs(scale) * rounding(&w, g->channel);
    r->sound.x = channel(&w, g->channel, scale, x->arena);
    r->sound.full = w.bits ? fabs(scale) : INFINITY;
    if (g->force_channel) r->force.x = channel(&w, g->force_channel, force_scale, x->arena);
    r->force.full = w.bits ? force_scale : INFINITY;
    if (x->rate == 0.0) x->rate = w.rate;
    return x->rate == w.rate ||
           err_set(e, ERR_SCENE,
                   "%s has %g samples a second, %s %g: recordings of one object need one rate; resample one", p->shown,
                   w.rate, x->place[0].shown, x->rate);
}

static bool recordings(struct modes_extract *x, struct err *e)
{
    if (!operands(x, e) || !distinct(x, e)) return false;
    for (struct modes_extract_place *p = x->place; p < x->place + x->n; p++) {
        struct arena *scratch = arena_open();
        const char *slash = strrchr(p->shown, '/');
        char *name = arena_text(x->arena, slash ? slash + 1 : p->shown);
        p->name = name;
        for (; *name; name++)
            *name = (unsigned char)*name < ' ' ? '?' : *name;
        bool ok = samples(x, p, scratch, e);
        arena_close(scratch);
        if (!ok) return false;
    }
    return true;
}

/* ------------------------------------------------------------------ outputs */

struct written {
    struct outfile table, picture;
    struct wav_out *sound[2]; /* resynthesis, residual */
};

/* One channel for each place, as long as the longest recording: what the modes make of it, or what they leave. */
static bool sound(const struct modes_extract *x, int what, struct wav_out **w, struct err *e)
{
    struct wav_format f = {.rate = x->rate, .channels = x->n, .bits = -32, .comment = "rasp: by rasp modes extract"};
    bool residual = what == MODES_EXTRACT_RESIDUAL;
    long length = 0;
    if (!x->given.file[what]) return true;
    *w = wav_create(x->given.file[what], &f, e);
    if (!*w) return false;
    for (int k = 0; k < x->n; k++)
        length = x->place[k].recording.n > length ? x->place[k].recording.n : length;
    double *frames = ARENA_TAKE(x->arena, double, length * x->n);
    for (int k = 0; k < x->n; k++)
        for (long i = 0; residual && i < x->place[k].recording.n; i++)
            frames[i * x->n + k] = x->place[k].recording.sound.x[i];
    for (int s = 0; s < x->data.stretches; s++)
        for (long i = 0; i < x->data.stretch[s].n; i++)
            frames[(x->data.stretch[s].first + i) * x->n + x->data.stretch[s].place] +=
                (residual ? -1.0 : 1.0) * x->found.model[s][i];
    return wav_write(*w, frames, (size_t)length, e) && wav_finish(*w, e);
}

static bool prepare(struct modes_extract *x, struct written *o, struct err *e)
{
    const char *const *file = x->given.file;
    if (!outfile_open(&o->table, file[MODES_EXTRACT_TABLE], e)) return false;
    modes_extract_write_table(o->table.stream, x);
    return outfile_settle(&o->table, e) && sound(x, MODES_EXTRACT_RESYNTHESIS, &o->sound[0], e) &&
           sound(x, MODES_EXTRACT_RESIDUAL, &o->sound[1], e) &&
           (!file[MODES_EXTRACT_PLOT] ||
            (gnuplot_draw(&o->picture, file[MODES_EXTRACT_PLOT], x->given.svg, modes_extract_write_picture, x, e) &&
             outfile_settle(&o->picture, e)));
}

static bool commit(struct written *o, bool picture, struct err *e)
{
    bool ok = true;
    interrupt_hold();
    for (int k = 0; k < 2 && ok; k++) {
        ok = !o->sound[k] || wav_commit(o->sound[k], e);
        o->sound[k] = NULL;
    }
    ok = ok && (!picture || outfile_commit(&o->picture, e)) && outfile_commit(&o->table, e);
    interrupt_go();
    return ok;
}

int modes_extract_run(struct cmd_call *c, struct err *e)
{
    struct modes_extract *x = ARENA_TAKE(c->arena, struct modes_extract, 1);
    struct written *o = ARENA_TAKE(c->arena, struct written, 1);
    x->c = c;
    x->arena = c->arena;
    if (!options(x, e) || !recordings(x, e)) return (int)e->kind;
    for (int k = 0; k < MODES_EXTRACT_FILES; k++) /* before the work */
        if (x->given.file[k] && !modes_output_possible(x->given.file[k], e)) return (int)e->kind;
    if (!modes_extract_find(x, e)) return (int)e->kind;
    bool json = args_given(&c->args, "json");
    if (prepare(x, o, e) && commit(o, x->given.file[MODES_EXTRACT_PLOT], e)) {
        if (json || !args_given(&c->args, "quiet")) modes_extract_write_report(x, json, e);
        return (int)e->kind;
    }
    for (int k = 0; k < 2; k++)
        if (o->sound[k]) wav_drop(o->sound[k]);
    outfile_drop(&o->picture);
    outfile_drop(&o->table);
    return (int)e->kind;
}
