/* The operands of `rasp modes extract`: recordings, each FILE or FILE@X,Y, or one folder whose index.csv has
 * file_name,x_m,y_m (and gain_db). */
#include <math.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cmd/modes_extract.h"
#include "file/csv.h"
#include "file/wav.h"
#include "num/real.h"
#include "scene/units.h"

static bool is_folder(const char *path)
{
    struct stat s;
    return stat(path, &s) == 0 && S_ISDIR(s.st_mode);
}

/* ------------------------------------------------------------------ places */

static bool length(struct modes_extract *x, const char *text, const char *operand, double *m, struct err *e)
{
    struct units_fault fault = {NULL, NULL};
    return units_read(text, KEY_LENGTH, m, x->arena, &fault) ||
           err_set(e, ERR_USAGE, "%s: the place behind @ is X,Y, each a length: '%s' %s", operand, text, fault.text);
}

/* FILE@X,Y; a file of the whole name goes first. */
static bool operand(struct modes_extract *x, const char *text, struct err *e)
{
    struct modes_extract_place *p = &x->place[x->n++];
    char *name = arena_text(x->arena, text), *at = strrchr(name, '@'), *comma = at ? strchr(at, ',') : NULL;
    *p = (struct modes_extract_place){.file = name, .shown = name, .gain = 1.0};
    if (!comma || access(text, F_OK) == 0) return true;
    *at = *comma = '\0';
    p->placed = true;
    return length(x, at + 1, text, &p->x, e) && length(x, comma + 1, text, &p->y, e);
}

static bool row(struct modes_extract *x, const struct csv *t, size_t k, const char *folder, struct err *e)
{
    struct modes_extract_place *p = &x->place[x->n++];
    int column[5];
    static const char *const names[] = {"file_name", "x_m", "y_m", "gain_db", "z_m"};
    double gain = 0.0, z = 0.0;
    for (int c = 0; c < 5; c++)
        column[c] = csv_column(t, names[c]);
    if (column[0] < 0 || column[1] < 0 || column[2] < 0)
        return err_set(e, ERR_SCENE, "%s: its columns are file_name,x_m,y_m and, if you like, z_m and gain_db",
                       t->file);
    const char *name = t->cells[k * t->columns + (size_t)column[0]];
    if (name[0] == '\0' || name[0] == '/' || strstr(name, "../"))
        return err_set(e, ERR_SCENE, "%s:%d: '%s' is not a file in the folder", t->file, t->lines[k], name);
    *p = (struct modes_extract_place){
        .file = arena_format(x->arena, "%s/%s", folder, name), .shown = name, .placed = true};
    if (!csv_number(t, k, column[1], &p->x, e) || !csv_number(t, k, column[2], &p->y, e) ||
        (column[3] >= 0 && !csv_number(t, k, column[3], &gain, e)) ||
        (column[4] >= 0 && !csv_number(t, k, column[4], &z, e)))
        return false;
    if (fabs(gain) > 200.0 || z != 0.0)
        return err_set(e, ERR_SCENE, "%s:%d: gain_db lies between -200 and 200 dB, and z_m is 0: places lie in a plane",
                       t->file, t->lines[k]);
    p->gain = real_exp10(gain / 20.0);
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

static bool places(struct modes_extract *x, struct err *e)
{
    const struct args *a = &x->c->args;
    if (a->n_operands == 1 && is_folder(a->operands[0])) return folder(x, a->operands[0], e);
    x->place = ARENA_TAKE(x->arena, struct modes_extract_place, a->n_operands);
    for (int k = 0; k < a->n_operands; k++)
        if (!operand(x, a->operands[k], e)) return false;
    return true;
}

static bool apart(const struct modes_extract *x, struct err *e)
{
    for (int i = 0; x->n > 1 && i < x->n; i++) {
        const struct modes_extract_place *p = &x->place[i];
        if (!p->placed)
            return err_set(e, ERR_USAGE,
                           "%s: which place was struck? With several recordings each is FILE@X,Y, as in %s@10cm,3cm",
                           p->shown, p->shown);
        for (int k = 0; k < i; k++)
            if (p->x == x->place[k].x && p->y == x->place[k].y)
                return err_set(
                    e, ERR_SCENE,
                    "%s and %s are both at (%g, %g) m: several strikes on one place belong into one recording",
                    x->place[k].shown, p->shown, p->x, p->y);
    }
    return true;
}

static bool same(const char *a, const char *b)
{
    struct stat s, t;
    return a && b && stat(a, &s) == 0 && stat(b, &t) == 0 && s.st_dev == t.st_dev && s.st_ino == t.st_ino;
}

/* No output, --force or not, takes the place of what is read. */
static bool spared(const struct modes_extract *x, struct err *e)
{
    const struct modes_extract_given *g = &x->given;
    const char *const to[] = {g->output, g->residual, g->resynthesis, g->plot};
    for (int k = 0; k < 4; k++)
        for (int i = 0; i <= x->n; i++) {
            const char *from = i < x->n ? x->place[i].file : x->index;
            if (same(to[k], from))
                return err_set(e, ERR_CREATE, "the output %s would overwrite the input %s; give it another name", to[k],
                               from);
        }
    return true;
}

/* ------------------------------------------------------------------ samples */

static double *channel(const struct wav *w, long number, double factor, struct arena *a)
{
    double *x = ARENA_TAKE(a, double, w->frames);
    for (size_t i = 0; i < w->frames; i++)
        x[i] = factor * w->x[i * (size_t)w->channels + (size_t)number - 1];
    return x;
}

static bool has_channels(const struct modes_extract *x, const struct modes_extract_place *p, struct err *e)
{
    const struct modes_extract_given *g = &x->given;
    const char *option = g->channel > p->channels ? "channel" : "force-channel";
    long asked = g->channel > p->channels ? g->channel : g->force_channel;
    return asked <= p->channels || err_set(e, ERR_SCENE, "%s has %d channel%s; there is no --%s %ld", p->shown,
                                           p->channels, p->channels == 1 ? "" : "s", option, asked);
}

/* rms of rounding to the file's steps, one step wide, per full scale: of an integer its last bit, of single precision
 * the last of its greatest sample; 0: of neither. */
static double rounding(const struct wav *w, int channel)
{
    double most = 0.0;
    int exponent;
    if (w->bits) return ldexp(sqrt(1.0 / 12.0), 1 - w->bits);
    for (size_t i = 0; i < w->frames; i++) {
        double x = w->x[i * (size_t)w->channels + (size_t)channel];
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
    p->channels = w.channels;
    p->bits = w.bits;
    if (!has_channels(x, p, e)) return false;
    double scale = p->gain * (isnan(g->scale) ? 1.0 : g->scale),
           force_scale = isnan(g->force_scale) ? 1.0 : g->force_scale;
    struct strikes_recording *r = &p->recording;
    *r = (struct strikes_recording){.name = p->shown, .n = (long)w.frames, .rate = w.rate};
    r->rounding = fabs(scale) * rounding(&w, (int)g->channel - 1);
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

static void name(struct modes_extract_place *p, struct arena *a)
{
    const char *slash = strrchr(p->shown, '/');
    char *text = arena_text(a, slash ? slash + 1 : p->shown);
    for (char *c = text; *c; c++)
        *c = (unsigned char)*c < ' ' ? '?' : *c;
    p->name = text;
}

bool modes_extract_read(struct modes_extract *x, struct err *e)
{
    if (!places(x, e) || !apart(x, e) || !spared(x, e)) return false;
    for (int k = 0; k < x->n && e->kind == ERR_NONE; k++) {
        struct arena *scratch = arena_open();
        name(&x->place[k], x->arena);
        samples(x, &x->place[k], scratch, e);
        arena_close(scratch);
    }
    return e->kind == ERR_NONE;
}
