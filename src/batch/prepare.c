/* See prepare.h. */
#include "batch/prepare.h"

#include <math.h>
#include <string.h>
#include <sys/stat.h>

#include "base/interrupt.h"
#include "batch/claim.h"
#include "batch/pool.h"
#include "batch/prepare_look.h"
#include "batch/recording.h"
#include "batch/spare.h"

struct preparation {
    struct prepare_view view;
    struct prepare_look *looks; /* [n] */
    int *first;              /* [n] the stimulus that is looked at for it: the first of its cell, itself where the seed says where it goes */
    bool *now, second;       /* [n] those that are looked at; for the second time: what was drawn otherwise than the first of its cell */
    struct prepare *out;
    struct arena *arena;
    struct spare *spare;
    struct hash scenes;      /* of the design, of all of them and of the recordings, in their order */
};

/* ------------------------------------------------------------------ faults */

static bool same(const struct prepare_fault *f, const struct prepare_trial *t)
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
static int note(struct preparation *p, int i, struct prepare_trial *t)
{
    struct prepare *o = p->out;
    int k = 0;
    o->worst = t->e.kind > o->worst ? t->e.kind : o->worst;
    while (k < o->n_faults && k < PREPARE_FAULTS && !same(&o->faults[k], t))
        k++;
    if (k == o->n_faults)
        *more_faults(p) = (struct prepare_fault){t->arena, t->diag, t->messages, &t->e, p->view.set->rows[i].name, 0};
    else
        arena_close(t->arena);
    return k;
}

static void remark(struct preparation *p, int i, const char *text)
{
    struct prepare *o = p->out;
    int k = 0;
    while (k < o->n_remarks && strcmp(o->remarks[k].text, text) != 0)
        k++;
    if (k == o->n_remarks && k < PREPARE_FAULTS)
        o->remarks[o->n_remarks++] = (struct prepare_remark){arena_text(p->arena, text), p->view.set->rows[i].name};
}

static void settle(struct preparation *p, int i, struct prepare_look *l)
{
    struct prepare_trial *t = l->trial;
    l->trial = NULL;
    for (int k = 0; t && !t->e.kind && t->warnings && t->warnings[k]; k++)
        remark(p, i, t->warnings[k]);
    if (t && t->e.kind)
        l->fault = note(p, i, t) + 1;
    else if (t)
        arena_close(t->arena);
    if (l->fault)
        p->out->faults[l->fault - 1].n++;
}

/* ------------------------------------------------------------------ scenes */

static bool look(void *context, int i)
{
    struct preparation *p = context;
    if (p->now[i])
        prepare_look_at(&p->view, i, &p->looks[i]);
    return !p->now[i] || !interrupt_seen();
}

static void took(void *context, int i)
{
    struct preparation *p = context;
    struct prepare_look *l = &p->looks[p->first[i]];
    if (p->view.design->stimuli[i].recording || (!p->now[i] && (p->second || l->drawn)))
        return;
    if (l->trial && !p->second)
        hash_add(&p->scenes, l->trial->sha256, HASH_TEXT);
    if (l->trial && !l->trial->e.kind)
        spare_scene(p->spare, p->first[i], &l->trial->scene);
    settle(p, i, l);
}

static void find_first(struct preparation *p)
{
    long cells = 0;
    for (int i = 0; i < p->view.set->n; i++)
        cells = p->view.design->stimuli[i].cell >= cells ? p->view.design->stimuli[i].cell + 1 : cells;
    int *of = ARENA_TAKE(p->arena, int, cells + 1);
    for (int i = 0; i < p->view.set->n; i++) {
        int *first = &of[p->view.design->stimuli[i].cell];
        p->first[i] = i;
        if (p->view.design->stimuli[i].recording)
            continue;
        if (!*first)
            *first = i + 1;
        p->first[i] = *first - 1;
        p->now[i] = p->first[i] == i;
    }
}

/* The noise decides where a scribble goes, and so how fast it is, and whether it stays on its map. */
static bool find_drawn(struct preparation *p)
{
    bool any = false;
    p->second = true;
    for (int i = 0; i < p->view.set->n; i++) {
        bool other = !p->view.design->stimuli[i].recording && p->first[i] != i && p->looks[p->first[i]].drawn;
        p->now[i] = other;
        p->first[i] = other ? i : p->first[i];
        any = any || other;
    }
    return any;
}

static bool look_at_all(struct preparation *p, int threads, struct err *e)
{
    int n = p->view.set->n, done = pool_run(&(struct pool_work){.n = n, .threads = threads, .context = p, .job = look, .took = took});
    for (int i = 0; i < n; i++)
        if (p->looks[i].trial)
            arena_close(p->looks[i].trial->arena);
    return done == n || err_set(e, ERR_INTERRUPTED, "interrupted; nothing was written, run the same command again");
}

void prepare_close(struct prepare *p)
{
    for (int k = 0; k < p->n_faults; k++)
        arena_close(p->faults[k].arena);
    p->n_faults = 0;
}

/* ------------------------------------------------------------------ the whole */

static bool is_sound(const struct preparation *p, int i)
{
    return !p->view.design->stimuli[i].recording && p->looks[p->first[i]].sounds;
}

/* The form of the set is that of its first sound; recordings alone have that of the first of them, in 24 bits. */
static void find_form(const struct preparation *p, struct set *s, struct prepare_form *f)
{
    s->encoding = ENCODING_PCM24;
    s->ramp = 0.01;
    *f = (struct prepare_form){NULL, NULL, NULL, NULL};
    for (int i = 0; i < s->n && !(f->first && f->stated); i++) {
        const struct prepare_look *l = &p->looks[p->first[i]];
        if (!is_sound(p, i))
            continue;
        if (!f->stated && l->quantity >= 0) {
            f->stated = l;
            f->stated_name = s->rows[i].name;
        }
        if (f->first)
            continue;
        *f = (struct prepare_form){l, f->stated, s->rows[i].name, f->stated_name};
        s->rate = l->rate;
        s->channels = l->channels;
        s->encoding = l->encoding;
        s->ramp = l->ramp;
    }
}

static void look_at_forms(struct preparation *p, struct set *s)
{
    struct prepare_form f;
    find_form(p, s, &f);
    for (int i = 0; i < s->n; i++) {
        struct prepare_look *l = &p->looks[p->first[i]];
        if (is_sound(p, i) && (p->first[i] == i ? !l->fault && prepare_look_otherwise(&p->view, i, &f, l) : l->otherwise))
            settle(p, i, l);
    }
}

static void look_at_recordings(struct preparation *p, struct set *s)
{
    for (int i = 0; i < s->n; i++) {
        struct prepare_look *l = &p->looks[i];
        const char *file = p->view.design->stimuli[i].recording;
        if (!file)
            continue;
        l->trial = prepare_look_open();
        const char *sha256 = shelf_sha256(p->view.shelf, file, l->trial->arena, &l->trial->e);
        if (sha256)
            hash_add(&p->scenes, sha256, HASH_TEXT);
        if (!sha256 || !recording_check(file, &s->rate, &s->channels, &l->seconds, &l->trial->e))
            design_scene_recording(p->view.design, i, &l->trial->e);
        settle(p, i, l);
        l->cost = fmax(1, 1000 * l->seconds * s->rate);
        l->rate = s->rate;
        l->channels = s->channels;
        l->bits = s->encoding == ENCODING_PCM16 ? 16 : s->encoding == ENCODING_PCM24 ? 24 : s->encoding == ENCODING_FLOAT32 ? 32 : 64;
        l->sounds = true;
    }
}

static void look_at_levels_of_recordings(struct preparation *p, const struct set *s)
{
    for (int i = 0; i < s->n; i++) {
        struct prepare_look *l = &p->looks[i];
        const char *file = p->view.design->stimuli[i].recording;
        if (!file || l->fault)
            continue;
        l->trial = prepare_look_open();
        if (!recording_check_level(file, s, &l->trial->e))
            design_scene_recording(p->view.design, i, &l->trial->e);
        settle(p, i, l);
    }
}

static double seconds_of(const struct set *s, const struct prepare_look *l)
{
    return isnan(s->length) ? l->seconds : s->length;
}

/* Of a common loudness one that is long enough is enough. */
static bool may_be_short(const struct preparation *p, const struct set *s)
{
    for (int i = 0; i < s->n && s->level_rule == DESIGN_LEVEL_COMMON; i++) {
        const struct prepare_look *l = &p->looks[p->first[i]];
        if (!p->view.design->stimuli[i].recording && l->sounds && !prepare_look_is_short(l, seconds_of(s, l)))
            return false;
    }
    return true;
}

/* Found out before anything is rendered, too: what keeps one of them from its level, which depends on the set's length. */
static void look_at_levels(struct preparation *p, const struct set *s)
{
    look_at_levels_of_recordings(p, s);
    for (int i = 0, some = may_be_short(p, s); some && i < s->n; i++) {
        struct prepare_look *l = &p->looks[p->first[i]];
        double seconds = seconds_of(s, l);
        if (p->view.design->stimuli[i].recording || (p->first[i] == i ? l->fault || !prepare_look_is_short(l, seconds) : !l->brief))
            continue;
        if (p->first[i] == i)
            prepare_look_short(&p->view, i, seconds, l);
        l->brief = true;
        settle(p, i, l);
    }
}

static void find_length(const struct preparation *p, struct set *s)
{
    double longest = 0;
    for (int i = 0; i < s->n; i++)
        longest = fmax(longest, p->looks[p->first[i]].seconds);
    if (p->view.design->length_rule == DESIGN_LENGTH_LONGEST)
        s->length = longest;
}

static void add_up(const struct preparation *p, struct set *s)
{
    struct prepare *o = p->out;
    for (int i = 0; i < s->n; i++) {
        const struct prepare_look *l = &p->looks[p->first[i]];
        double seconds = seconds_of(s, l), samples = l->sounds ? seconds * l->rate * l->channels : 0;
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
    for (int k = 0; k < p->n_faults; k++)
        n += p->faults[k].n;
    return !p->n_faults || err_set(e, p->worst, "%d of %d stimuli cannot be rendered%s", n, s->n, folder ? "; nothing was written" : "");
}

/* What the design was read from is known to the shelf, which sees whether it changes; a pipe is read and gone. */
static bool watch_sources(const struct prepare_ask *ask, struct arena *a, struct err *e)
{
    struct stat s;
    for (const char *const *file = ask->design->sources; *file; file++)
        if (stat(*file, &s) == 0 && S_ISREG(s.st_mode) && !shelf_sha256(ask->shelf, *file, a, e))
            return false;
    return true;
}

bool prepare_set(const struct prepare_ask *ask, struct arena *a, struct set *s, struct prepare *out, struct err *e)
{
    struct preparation p = {.view = {ask->design, s, ask->shelf}, .looks = ARENA_TAKE(a, struct prepare_look, s->n), .first = ARENA_TAKE(a, int, s->n),
                            .now = ARENA_TAKE(a, bool, s->n), .out = out, .arena = a, .spare = spare_open(ask->design, a), .scenes = hash_start()};
    *out = (struct prepare){.lengths = ARENA_TAKE(a, double, s->n), .inputs = p.spare};
    if (!watch_sources(ask, a, e))
        return false;
    find_first(&p);
    hash_add(&p.scenes, ask->design->sha256, HASH_TEXT);
    if (!look_at_all(&p, ask->threads, e) || (find_drawn(&p) && !look_at_all(&p, ask->threads, e)))
        return false;
    look_at_forms(&p, s);
    look_at_recordings(&p, s);
    char *sha256 = arena_take(a, HASH_TEXT, 1);
    hash_end(&p.scenes, sha256);
    s->sha256 = sha256;
    find_length(&p, s);
    look_at_levels(&p, s);
    add_up(&p, s);
    const struct spare_place place = {.folder = ask->folder, .shard = ask->shard, .unknown = ask->folder && !ask->replace && !claim_is_noted(ask->folder, a),
                                      .links = ask->links};
    return tell(out, s, ask->folder, e) && (!ask->folder || spare_check(p.spare, s, p.first, &place, e));
}
