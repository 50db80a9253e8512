/* See prepare.h. */
#include "batch/prepare.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/shelf.h"
#include "batch/pool.h"
#include "batch/recording.h"
#include "batch/spare.h"
#include "output/sound.h"
#include "pipeline/plan_scene.h"
#include "scene/scene_places.h"
#include "scene/scene_write.h"

struct trial {               /* of one scene, until it is taken; it lies in its own arena */
    struct arena *arena;
    const struct diag *diag;
    const char *messages;
    struct scene scene;
    char sha256[HASH_TEXT];  /* of what the scene means, and of its inputs */
    struct err e;            /* none: it can be rendered */
};

struct look {                /* at one stimulus */
    struct trial *trial;     /* NULL: not begun, or taken */
    int fault;               /* from 1; 0: it can be rendered */
    double seconds, cost, rate, ramp;
    int channels, encoding, bits;
    bool sounds;
};

struct preparation {
    const struct design *design;
    struct shelf *shelf;
    const struct set *set;
    struct look *looks;      /* [n] */
    int *first;              /* [n] the first stimulus of the cell */
    struct prepare *out;
    struct arena *arena;
    struct spare *spare;
    struct hash scenes;      /* of the design, of all of them and of the recordings, in their order */
};

/* ------------------------------------------------------------------ one */

static struct trial *trial_open(void)
{
    struct arena *a = arena_open();
    struct trial *t = ARENA_TAKE(a, struct trial, 1);
    *t = (struct trial){.arena = a, .messages = ""};
    return t;
}

/* File names are seen from the base scene: where all lies does not count. */
static void hash_scene(struct trial *t)
{
    const struct scene *s = &t->scene;
    const char *slash = strrchr(s->sources[0], '/'), *beside = slash ? arena_format(t->arena, "%.*s", slash == s->sources[0] ? 1 : (int)(slash - s->sources[0]), s->sources[0]) : ".";
    const char *text = scene_write(s, beside, t->arena);
    hash_bytes(text, strlen(text), t->sha256);
}

/* The texts it was read from lie on the shelf from now on, which knows whether they change while the set is rendered: each stimulus reads them once more. */
static bool watch_sources(const struct preparation *p, struct trial *t)
{
    for (const char *const *file = t->scene.sources; *file; file++)
        if (!shelf_sha256(p->shelf, *file, t->arena, &t->e))
            return false;
    return true;
}

static bool estimate(const struct preparation *p, int i, struct look *l)
{
    struct plan_scene_estimate x;
    struct trial *t = l->trial;
    struct scene *s = &t->scene;
    bool read = design_scene(p->design, i, t->arena, s, &t->messages, &t->e);
    t->diag = s->diag;
    if (!read || !watch_sources(p, t))
        return false;
    s->shelf = p->shelf;
    hash_scene(t);
    if (!isnan(p->set->length))
        s->output.duration = p->set->length;
    if (p->set->level_rule != DESIGN_LEVEL_SCENE)
        s->output.level = p->set->level;
    design_scene_places(p->design, s, t->arena);
    if (!plan_scene_estimate(s, t->arena, &x, &t->e))
        return scene_places_tell(s, &t->e);
    struct track_format f = sound_format(s, x.length.frames);
    l->seconds = (double)x.length.frames / f.rate;
    l->cost = fmax(x.cycles, 1);
    l->rate = f.rate;
    l->channels = f.channels;
    l->bits = abs(f.bits);
    l->encoding = s->output.encoding;
    l->ramp = s->output.ramp;
    l->sounds = x.sounds;
    return true;
}

static bool look(void *context, int i)
{
    struct preparation *p = context;
    struct look *l = &p->looks[i];
    if (p->design->stimuli[i].recording || p->first[i] != i)
        return true;
    l->trial = trial_open();
    estimate(p, i, l);
    return !interrupt_seen();
}

/* ------------------------------------------------------------------ faults */

static bool same(const struct prepare_fault *f, const struct trial *t)
{
    return !strcmp(f->messages, t->messages) && (*t->messages || !strcmp(f->err->text, t->e.text));
}

static struct prepare_fault *more_faults(struct preparation *p)
{
    struct prepare *o = p->out;
    if (o->n_faults == o->room) {
        struct prepare_fault *more = ARENA_TAKE(p->arena, struct prepare_fault, o->room = 2 * o->room + 16);
        if (o->n_faults)
            memcpy(more, o->faults, (size_t)o->n_faults * sizeof *more);
        o->faults = more;
    }
    return &o->faults[o->n_faults++];
}

/* Which fault it is. The first that has it keeps what it is told with. */
static int note(struct preparation *p, int i, struct trial *t)
{
    struct prepare *o = p->out;
    int k = 0;
    while (k < o->n_faults && !same(&o->faults[k], t))
        k++;
    if (k == o->n_faults)
        *more_faults(p) = (struct prepare_fault){t->arena, t->diag, t->messages, &t->e, p->set->rows[i].name, 0};
    else
        arena_close(t->arena);
    return k;
}

static void settle(struct preparation *p, int i, struct look *l)
{
    struct trial *t = l->trial;
    l->trial = NULL;
    if (t && t->e.kind)
        l->fault = note(p, i, t) + 1;
    else if (t)
        arena_close(t->arena);
    if (l->fault)
        p->out->faults[l->fault - 1].n++;
}

static void took(void *context, int i)
{
    struct preparation *p = context;
    struct look *l = &p->looks[p->first[i]];
    if (p->design->stimuli[i].recording)
        return;
    if (l->trial)
        hash_add(&p->scenes, l->trial->sha256, HASH_TEXT);
    if (l->trial && !l->trial->e.kind)
        spare_scene(p->spare, p->first[i], &l->trial->scene);
    settle(p, i, l);
}

void prepare_close(struct prepare *p)
{
    for (int k = 0; k < p->n_faults; k++)
        arena_close(p->faults[k].arena);
    p->n_faults = 0;
}

/* ------------------------------------------------------------------ the whole */

static void find_first(struct preparation *p)
{
    long cells = 0;
    for (int i = 0; i < p->set->n; i++)
        cells = p->design->stimuli[i].cell >= cells ? p->design->stimuli[i].cell + 1 : cells;
    int *of = ARENA_TAKE(p->arena, int, cells + 1);
    for (int i = 0; i < p->set->n; i++) {
        int *first = &of[p->design->stimuli[i].cell];
        if (p->design->stimuli[i].recording) {
            p->first[i] = i;
            continue;
        }
        if (!*first)
            *first = i + 1;
        p->first[i] = *first - 1;
    }
}

/* The form of the set is that of its first sound; recordings alone have that of the first of them, in 24 bits. */
static void find_form(struct preparation *p, struct set *s)
{
    s->encoding = ENCODING_PCM24;
    s->ramp = 0.01;
    for (int i = 0; i < s->n; i++) {
        const struct look *l = &p->looks[p->first[i]];
        if (p->design->stimuli[i].recording || !l->sounds)
            continue;
        s->rate = l->rate;
        s->channels = l->channels;
        s->encoding = l->encoding;
        s->ramp = l->ramp;
        return;
    }
}

static void look_at_recordings(struct preparation *p, struct set *s)
{
    for (int i = 0; i < s->n; i++) {
        struct look *l = &p->looks[i];
        const char *file = p->design->stimuli[i].recording;
        if (!file)
            continue;
        l->trial = trial_open();
        const char *sha256 = shelf_sha256(p->shelf, file, l->trial->arena, &l->trial->e);
        if (sha256)
            hash_add(&p->scenes, sha256, HASH_TEXT);
        if (!sha256 || !recording_check(file, &s->rate, &s->channels, &l->seconds, &l->trial->e))
            design_scene_recording(p->design, i, &l->trial->e);
        settle(p, i, l);
        l->cost = fmax(1, 1000 * l->seconds * s->rate);
        l->rate = s->rate;
        l->channels = s->channels;
        l->bits = s->encoding == ENCODING_PCM16 ? 16 : s->encoding == ENCODING_PCM24 ? 24 : s->encoding == ENCODING_FLOAT32 ? 32 : 64;
        l->sounds = true;
    }
}

/* Found out before anything is rendered, too: what keeps one of them from its level, which depends on the set's length. */
static void look_at_levels(struct preparation *p, const struct set *s)
{
    for (int i = 0; i < s->n; i++) {
        struct look *l = &p->looks[i];
        const char *file = p->design->stimuli[i].recording;
        if (!file || l->fault)
            continue;
        l->trial = trial_open();
        if (!recording_check_level(file, s, &l->trial->e))
            design_scene_recording(p->design, i, &l->trial->e);
        settle(p, i, l);
    }
}

static void find_length(const struct preparation *p, struct set *s)
{
    double longest = 0;
    for (int i = 0; i < s->n; i++)
        longest = fmax(longest, p->looks[p->first[i]].seconds);
    if (p->design->length_rule == DESIGN_LENGTH_LONGEST)
        s->length = longest;
}

static void add_up(const struct preparation *p, struct set *s)
{
    struct prepare *o = p->out;
    for (int i = 0; i < s->n; i++) {
        const struct look *l = &p->looks[p->first[i]];
        double seconds = isnan(s->length) ? l->seconds : s->length, samples = l->sounds ? seconds * l->rate * l->channels : 0;
        s->rows[i].cost = fmax(1, l->seconds > 0 ? l->cost * seconds / l->seconds : l->cost);
        o->lengths[i] = seconds;
        o->seconds += l->sounds ? seconds : 0;
        o->n_sounds += l->sounds;
        if (l->sounds)
            lengths_add(&o->own, i, l->seconds);
        o->cycles += s->rows[i].cost;
        o->bytes += samples * l->bits / 8;
        o->raw_bytes += set_waits(s) && !s->rows[i].recording ? samples * 8 : 0;
    }
}

static bool tell(const struct prepare *p, const struct set *s, const char *folder, struct err *e)
{
    int n = 0;
    enum err_kind worst = ERR_NONE;
    for (int k = 0; k < p->n_faults; k++) {
        n += p->faults[k].n;
        worst = p->faults[k].err->kind > worst ? p->faults[k].err->kind : worst;
    }
    return !p->n_faults || err_set(e, worst, "%d of %d stimuli cannot be rendered%s", n, s->n, folder ? "; nothing was written" : "");
}

bool prepare_set(const struct prepare_ask *ask, struct arena *a, struct set *s, struct prepare *out, struct err *e)
{
    struct preparation p = {.design = ask->design, .shelf = ask->shelf, .set = s, .looks = ARENA_TAKE(a, struct look, s->n), .first = ARENA_TAKE(a, int, s->n), .out = out, .arena = a,
                            .spare = spare_open(ask->design, a), .scenes = hash_start()};
    *out = (struct prepare){.lengths = ARENA_TAKE(a, double, s->n), .inputs = p.spare};
    find_first(&p);
    hash_add(&p.scenes, ask->design->sha256, HASH_TEXT);
    int done = pool_run(&(struct pool_work){.n = s->n, .threads = ask->threads, .context = &p, .job = look, .took = took});
    for (int i = 0; i < s->n; i++)
        if (p.looks[i].trial)
            arena_close(p.looks[i].trial->arena);
    if (done < s->n)
        return err_set(e, ERR_INTERRUPTED, "interrupted; nothing was written, run the same command again");
    find_form(&p, s);
    look_at_recordings(&p, s);
    char *sha256 = arena_take(a, HASH_TEXT, 1);
    hash_end(&p.scenes, sha256);
    s->sha256 = sha256;
    find_length(&p, s);
    look_at_levels(&p, s);
    add_up(&p, s);
    return tell(out, s, ask->folder, e) && (!ask->folder || spare_check(p.spare, s, p.first, &(struct spare_place){ask->folder, ask->shard}, e));
}
