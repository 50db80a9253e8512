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
#include "base/relpath.h"
#include "base/text.h"
#include "file/csv.h"
#include "file/wav.h"
#include "num/real.h"
#include "output/mark.h"
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

static const char *const output_names[MODES_EXTRACT_FILES] = {"--output", "--residual", "--resynthesis", "--plot",
                                                              "--envelopes"};

/* Outputs: each may be written (output/mark.h), and no two are one file. */
static bool outputs(struct modes_extract *x, struct err *e)
{
    struct modes_extract_given *g = &x->given;
    bool force = args_given(&x->c->args, "force");
    for (int k = 0; k < MODES_EXTRACT_FILES; k++) {
        const char *file = g->file[k] = args_value(&x->c->args, output_names[k] + 2);
        if (file && !(k == MODES_EXTRACT_TABLE ? mark_absent(file, force, e) : mark_permits(file, NULL, force, e)))
            return false;
        for (int i = 0; file && i < k; i++)
            if (g->file[i] && !strcmp(relpath_make(file, NULL, x->arena), relpath_make(g->file[i], NULL, x->arena)))
                return err_set(e, ERR_USAGE, "%s and %s are both %s", output_names[i], output_names[k], file);
    }
    const char *plot = g->file[MODES_EXTRACT_PLOT];
    g->svg = plot && text_ends_in(plot, ".svg");
    if (plot && !g->svg && !text_ends_in(plot, ".png"))
        return err_set(e, ERR_USAGE, "--plot: '%s' ends in neither .png nor .svg", plot);
    const char *table = g->file[MODES_EXTRACT_TABLE], *falls = g->file[MODES_EXTRACT_ENVELOPES];
    if (falls && !text_ends_in(falls, ".csv"))
        return err_set(e, ERR_USAGE, "--envelopes %s: a table is CSV: write for instance --envelopes fall.csv", falls);
    if (table && !text_ends_in(table, ".csv"))
        return err_set(e, ERR_USAGE, "-o %s: a mode table is CSV: write for instance -o modes.csv", table);
    return table || err_set(e, ERR_USAGE, "-o FILE.csv is needed: the mode table to write");
}

bool modes_extract_options(struct modes_extract *x, struct err *e)
{
    static const char *const quantities[] = {"displacement", "velocity", "acceleration", "pressure", NULL},
                             *const methods[] = {"esprit", "spectrogram", NULL};
    static const double scales[2] = {1e-300, 1e300}, rise[2] = {1, 120};
    static const long channels[2] = {1, 1024};
    const struct args *a = &x->c->args;
    struct modes_extract_given *g = &x->given;
    int method = 0;
    *g = (struct modes_extract_given){.channel = 1, .quantity = MODES_PRESSURE, .threshold = 20.0, .modes = 50};
    g->scale = g->force_scale = g->fastest = NAN;
    g->impulse = args_given(a, "impulse");
    g->only = args_value(a, "strikes");
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
    return together(x, e);
}

/* ------------------------------------------------------------------ places */

static bool folder(struct modes_extract *x, const char *path, struct err *e)
{
    enum { FILE_NAME, X, Y, GAIN, Z, COLUMNS };
    static const char *const names[] = {"file_name", "x_m", "y_m", "gain_db", "z_m"};
    int column[COLUMNS];
    struct csv t;
    x->index = arena_format(x->arena, "%s/index.csv", path);
    if (!csv_read_file(x->index, x->arena, &t, e)) {
        if (e->kind == ERR_INPUT) err_at(e, "a folder of recordings has its places in index.csv (file_name,x_m,y_m)");
        return false;
    }
    if (t.rows == 0) return err_set(e, ERR_SCENE, "%s: has no rows; name at least one recording", t.file);
    for (int c = 0; c < COLUMNS; c++) {
        column[c] = csv_column(&t, names[c]);
        if (column[c] < 0 && c <= Y)
            return err_set(e, ERR_SCENE, "%s: its columns are file_name,x_m,y_m and, if you like, z_m and gain_db",
                           t.file);
    }
    x->place = ARENA_TAKE(x->arena, struct modes_extract_place, t.rows);
    for (size_t k = 0; k < t.rows; k++) {
        struct modes_extract_place *p = &x->place[x->n++];
        double gain = 0.0, z = 0.0, *const to[COLUMNS] = {[X] = &p->x, [Y] = &p->y, [GAIN] = &gain, [Z] = &z};
        const char *name = t.cells[k * t.columns + (size_t)column[FILE_NAME]];
        if (name[0] == '\0' || name[0] == '/' || strstr(name, "../"))
            return err_set(e, ERR_SCENE, "%s:%d: '%s' is not a file in the folder", t.file, t.lines[k], name);
        for (int c = X; c < COLUMNS; c++)
            if (column[c] >= 0 && !csv_number(&t, k, column[c], to[c], e)) return false;
        if (fabs(gain) > 200.0 || z != 0.0)
            return err_set(e, ERR_SCENE,
                           "%s:%d: gain_db lies between -200 and 200 dB, and z_m is 0: places lie in a plane", t.file,
                           t.lines[k]);
        p->file = arena_format(x->arena, "%s/%s", path, name);
        p->shown = name;
        p->placed = true;
        p->gain = real_exp10(gain / 20.0);
    }
    return true;
}

/* FILE@X,Y; a file of the whole name goes first. */
static bool operand(struct modes_extract *x, const char *text, struct err *e)
{
    struct modes_extract_place *p = &x->place[x->n++];
    struct units_fault fault = {NULL, NULL};
    char *name = arena_text(x->arena, text), *at = strrchr(name, '@'), *comma = at ? strchr(at, ',') : NULL;
    *p = (struct modes_extract_place){.file = name, .shown = name, .gain = 1.0};
    if (!at || access(text, F_OK) == 0) return true;
    *at = '\0';
    if (!comma && access(name, F_OK) == 0)
        return err_set(e, ERR_USAGE, "%s: the place behind @ is X,Y, as in %s@1cm,2cm", text, name);
    if (!comma) {
        *at = '@';
        return true;
    }
    *comma = '\0';
    p->placed = true;
    for (int k = 0; k < 2; k++) {
        const char *length = k ? comma + 1 : at + 1;
        if (!units_read(length, KEY_LENGTH, k ? &p->y : &p->x, x->arena, &fault))
            return err_set(e, ERR_USAGE, "%s: the place behind @ is X,Y, each a length: '%s' %s", text, length,
                           fault.text);
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
        for (int i = 0; i <= x->n; i++)
            if (!cmd_spares(x->given.file[k], output_names[k], i < x->n ? x->place[i].file : x->index, "another name",
                            e))
                return false;
    return true;
}

/* ------------------------------------------------------------------ samples */

/* A channel of the file, times `scale`. Returns the rms of rounding to the file's steps, one step wide, per full scale:
   of an integer its last bit, of single precision the last of its greatest sample; 0: of neither. */
static double take(struct strikes_channel *c, const struct wav *w, long number, double scale, struct arena *a)
{
    double *x = ARENA_TAKE(a, double, w->frames), most = 0.0;
    bool single = true;
    int exponent;
    for (size_t i = 0; i < w->frames; i++) {
        double sample = w->x[i * (size_t)w->channels + (size_t)number - 1];
        x[i] = scale * sample;
        single = single && (double)(float)sample == sample;
        most = fmax(most, fabs(sample));
    }
    frexp(most, &exponent);
    *c = (struct strikes_channel){.x = x, .full = w->bits ? scale : INFINITY};
    return !w->bits && !single ? 0.0 : ldexp(sqrt(1.0 / 12.0), w->bits ? 1 - w->bits : exponent - 24);
}

static bool recording(struct modes_extract *x, struct modes_extract_place *p, struct arena *scratch, struct err *e)
{
    const struct modes_extract_given *g = &x->given;
    struct strikes_recording *r = &p->recording;
    struct wav w;
    if (!wav_read(p->file, scratch, &w, e) || !hash_file(p->file, p->hash, e)) return false;
    bool sound = g->channel > w.channels;
    if (sound || g->force_channel > w.channels)
        return err_set(e, ERR_SCENE, "%s has %d channel%s; there is no --%s %ld", p->shown, w.channels,
                       w.channels == 1 ? "" : "s", sound ? "channel" : "force-channel",
                       sound ? g->channel : g->force_channel);
    double scale = p->gain * (isnan(g->scale) ? 1.0 : g->scale);
    *r = (struct strikes_recording){.name = p->shown, .n = (long)w.frames, .rate = w.rate};
    r->rounding = scale * take(&r->sound, &w, g->channel, scale, x->arena);
    if (g->force_channel) take(&r->force, &w, g->force_channel, isnan(g->force_scale) ? 1.0 : g->force_scale, x->arena);
    if (x->rate == 0.0) x->rate = w.rate;
    return x->rate == w.rate ||
           err_set(e, ERR_SCENE,
                   "%s has %g samples a second, %s %g: recordings of one object need one rate; resample one", p->shown,
                   w.rate, x->place[0].shown, x->rate);
}

bool modes_extract_recordings(struct modes_extract *x, int operands, struct err *e)
{
    const struct args *a = &x->c->args;
    struct stat s;
    bool ok = true;
    if (operands == 1 && stat(a->operands[0], &s) == 0 && S_ISDIR(s.st_mode))
        ok = folder(x, a->operands[0], e);
    else
        x->place = ARENA_TAKE(x->arena, struct modes_extract_place, operands);
    while (ok && !x->index && x->n < operands)
        ok = operand(x, a->operands[x->n], e);
    ok = ok && distinct(x, e);
    for (int k = 0; k < x->n && ok; k++) {
        struct modes_extract_place *p = &x->place[k];
        struct arena *scratch = arena_open();
        const char *slash = strrchr(p->shown, '/');
        char *name = arena_text(x->arena, slash ? slash + 1 : p->shown);
        p->name = name;
        for (; *name; name++)
            *name = (unsigned char)*name < ' ' ? '?' : *name;
        ok = recording(x, p, scratch, e);
        arena_close(scratch);
    }
    return ok;
}

/* ------------------------------------------------------------------ outputs */

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

/* All of them, or none. */
static bool write_outputs(struct modes_extract *x, struct err *e)
{
    const char *const *file = x->given.file, *plot = file[MODES_EXTRACT_PLOT], *falls = file[MODES_EXTRACT_ENVELOPES];
    struct outfile *table = ARENA_TAKE(x->arena, struct outfile, 3), *picture = table + 1, *envelopes = table + 2;
    struct wav_out *sounds[2] = {NULL, NULL};
    bool ok = outfile_open(table, file[MODES_EXTRACT_TABLE], e);
    if (ok) modes_extract_write_table(table->stream, x);
    ok = ok && outfile_finalise(table, e) && sound(x, MODES_EXTRACT_RESYNTHESIS, &sounds[0], e) &&
         sound(x, MODES_EXTRACT_RESIDUAL, &sounds[1], e) &&
         (!plot || (gnuplot_draw(picture, plot, x->given.svg, modes_extract_write_picture, x, e) &&
                    outfile_finalise(picture, e)));
    ok = ok && (!falls || outfile_open(envelopes, falls, e));
    if (ok && falls) modes_extract_write_envelopes(envelopes->stream, x);
    ok = ok && (!falls || outfile_finalise(envelopes, e));
    interrupt_hold();
    for (int k = 0; k < 2; k++)
        if (sounds[k] && !ok)
            wav_drop(sounds[k]);
        else if (sounds[k])
            ok = wav_commit(sounds[k], e);
    ok = ok && (!plot || outfile_commit(picture, e)) && (!falls || outfile_commit(envelopes, e)) &&
         outfile_commit(table, e);
    interrupt_go();
    outfile_drop(envelopes); /* nothing, of what is committed */
    outfile_drop(picture);
    outfile_drop(table);
    return ok;
}

int modes_extract_run(struct cmd_call *c, struct err *e)
{
    static const long modes[2] = {1, 100000};
    struct modes_extract *x = ARENA_TAKE(c->arena, struct modes_extract, 1);
    bool json = args_given(&c->args, "json"), text = !args_given(&c->args, "quiet");
    x->c = c;
    x->arena = c->arena;
    if (!modes_extract_options(x, e) || !outputs(x, e) || !args_whole(&c->args, "modes", modes, &x->given.modes, e) ||
        !modes_extract_recordings(x, c->args.n_operands, e))
        return (int)e->kind;
    for (int k = 0; k < MODES_EXTRACT_FILES; k++) /* before the work */
        if (x->given.file[k] && !modes_output_possible(x->given.file[k], e)) return (int)e->kind;
    if (modes_extract_find(x, e) && write_outputs(x, e) && (json || text)) modes_extract_write_report(x, json, e);
    return (int)e->kind;
}
