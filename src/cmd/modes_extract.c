/* rasp modes extract RECORDING... -o FILE.csv: the modes of an object from recordings of strikes, or from impulse
 * responses, as a mode table. */
#include "cmd/modes_extract.h"

#include <math.h>

#include "base/interrupt.h"
#include "file/wav.h"
#include "output/picture.h"

enum { RESYNTHESIS, RESIDUAL, SOUNDS };

struct outputs {
    struct outfile table, picture;
    struct wav_out *wav[SOUNDS];
    bool has_table, has_picture;
};

/* One channel for each place, as long as the longest recording: what the modes make of it, or what they leave. */
static bool sound(const struct modes_extract *x, const char *file, int what, struct wav_out **w, struct err *e)
{
    struct wav_format f = {.rate = x->rate, .channels = x->n, .bits = -32, .comment = "rasp: by rasp modes extract"};
    long length = 0;
    if (!file) return true;
    for (int k = 0; k < x->n; k++)
        length = x->place[k].recording.n > length ? x->place[k].recording.n : length;
    *w = wav_create(file, &f, e);
    if (!*w) return false;
    double *frames = ARENA_TAKE(x->arena, double, length * x->n);
    for (int k = 0; k < x->n; k++)
        for (long i = 0; what == RESIDUAL && i < x->place[k].recording.n; i++)
            frames[i * x->n + k] = x->place[k].recording.sound.x[i];
    for (int s = 0; s < x->data.stretches; s++)
        for (long i = 0; i < x->data.stretch[s].n; i++)
            frames[(x->data.stretch[s].first + i) * x->n + x->data.stretch[s].place] +=
                (what == RESIDUAL ? -1.0 : 1.0) * x->found.model[s][i];
    return wav_write(*w, frames, (size_t)length, e) && wav_settle(*w, e);
}

/* Can the outputs be made at all? Asked before the work. */
static bool possible(const struct modes_extract *x, struct err *e)
{
    const struct modes_extract_given *g = &x->given;
    const char *const to[] = {g->output, g->residual, g->resynthesis, g->plot};
    for (int k = 0; k < 4; k++) {
        struct outfile o;
        if (to[k] && !outfile_open_fd(&o, to[k], e)) return false;
        if (to[k]) outfile_drop(&o);
    }
    return true;
}

static bool prepare(struct modes_extract *x, struct outputs *o, struct err *e)
{
    const struct modes_extract_given *g = &x->given;
    o->has_table = outfile_open(&o->table, g->output, e);
    if (!o->has_table) return false;
    modes_extract_write(o->table.stream, x);
    if (!outfile_settle(&o->table, e)) return false;
    if (!sound(x, g->resynthesis, RESYNTHESIS, &o->wav[RESYNTHESIS], e) ||
        !sound(x, g->residual, RESIDUAL, &o->wav[RESIDUAL], e))
        return false;
    o->has_picture = g->plot && picture_draw(&o->picture, g->plot, g->svg, modes_extract_plot, x, e);
    return !g->plot || (o->has_picture && outfile_settle(&o->picture, e));
}

static bool commit_all(struct outputs *o, struct err *e)
{
    for (int k = 0; k < SOUNDS; k++)
        if (o->wav[k]) {
            bool done = wav_commit(o->wav[k], e);
            o->wav[k] = NULL;
            if (!done) return false;
        }
    return (!o->has_picture || outfile_commit(&o->picture, e)) && outfile_commit(&o->table, e);
}

static bool commit(struct outputs *o, struct err *e)
{
    interrupt_hold();
    bool ok = commit_all(o, e);
    interrupt_go();
    return ok;
}

static void drop(struct outputs *o)
{
    for (int k = 0; k < SOUNDS; k++)
        if (o->wav[k]) wav_drop(o->wav[k]);
    if (o->has_picture) outfile_drop(&o->picture);
    if (o->has_table) outfile_drop(&o->table);
}

static bool report(const struct modes_extract *x, struct err *e)
{
    if (args_given(&x->c->args, "json")) return modes_extract_json(x, e);
    if (!args_given(&x->c->args, "quiet")) modes_extract_print(x);
    return true;
}

int modes_extract_run(struct cmd_call *c, struct err *e)
{
    struct modes_extract *x = ARENA_TAKE(c->arena, struct modes_extract, 1);
    struct outputs *o = ARENA_TAKE(c->arena, struct outputs, 1);
    x->c = c;
    x->arena = c->arena;
    if (!modes_extract_options(x, e) || !modes_extract_read(x, e) || !possible(x, e) || !modes_extract_find(x, e))
        return (int)e->kind;
    modes_extract_write_radiation(x);
    if (!prepare(x, o, e) || !commit(o, e))
        drop(o);
    else
        report(x, e);
    return (int)e->kind;
}
