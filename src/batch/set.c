/* See set.h.

   The gain of the whole set, F = full_scale, from sounds that were rendered at full_scale 1, with L the level:

     peak   F = greatest peak / min(10^(L/20), largest value of the encoding)
     rms    F = greatest rms / 10^(L/20)
     lufs   F = 10^((greatest loudness - L)/20) */
#include "batch/set.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/interrupt.h"
#include "base/relpath.h"
#include "base/text.h"
#include "batch/pool.h"
#include "batch/recording.h"
#include "num/real.h"
#include "output/loudness.h"
#include "output/sound.h"
#include "pipeline/outputs.h"
#include "pipeline/plan.h"
#include "response/modes.h"
#include "scene/accuracy.h"
#include "scene/keys_yaml.h"
#include "scene/scene_places.h"
#include "scene/scene_write.h"

struct set set_make(const struct design *d, const char *program)
{
    return (struct set){.design = d,
                        .program = program,
                        .sha256 = d->sha256,
                        .n = d->n_stimuli,
                        .level_rule = d->level_rule,
                        .level = d->level,
                        .length = d->length_rule == DESIGN_LENGTH_FIXED ? d->length : NAN,
                        .encoding = ENCODING_PCM24,
                        .ramp = 0.01};
}

bool set_waits(const struct set *s)
{
    return s->level_rule == DESIGN_LEVEL_COMMON && isnan(s->level.full_scale) && isnan(s->level.dbfs_at_1_pa);
}

void set_lay(const struct set *s, struct scene *over)
{
    if (!isnan(s->length)) over->output.duration = s->length;
    if (s->level_rule != DESIGN_LEVEL_SCENE) over->output.level = s->level;
    if (set_waits(s))
        over->output.level =
            (struct level){.later = true, .full_scale = 1, .peak = NAN, .rms = NAN, .lufs = NAN, .dbfs_at_1_pa = NAN};
}

void set_means(const struct set *s, const struct scene *scene, struct arena *a, char hex[HASH_TEXT])
{
    struct scene own = *scene;
    set_lay(s, &own);
    own.seed = 0;
    if (s->design->length_rule != DESIGN_LENGTH_OWN) own.output.duration = NAN;
    const char *text = outputs_effective(&own, s->design->file, a);
    hash_bytes(text, strlen(text), hex);
}

const char *set_level_text(const struct set *s, struct arena *a)
{
    static const char *const rules[] = {
        [DESIGN_LEVEL_COMMON] = "common", [DESIGN_LEVEL_EACH] = "each", [DESIGN_LEVEL_SCENE] = "scene"};
    const struct level *l = &s->level;
    const char *rule = rules[s->level_rule];
    if (s->level_rule == DESIGN_LEVEL_SCENE) return rule;
    if (!isnan(l->full_scale)) return arena_format(a, "%s full_scale %s", rule, keys_yaml_number(l->full_scale, a));
    if (!isnan(l->dbfs_at_1_pa))
        return arena_format(a, "%s dbfs_at_1_pa %s dB", rule, keys_yaml_number(l->dbfs_at_1_pa, a));
    if (!isnan(l->rms)) return arena_format(a, "%s rms %s dB", rule, keys_yaml_number(l->rms, a));
    if (!isnan(l->lufs)) return arena_format(a, "%s lufs %s LUFS", rule, keys_yaml_number(l->lufs, a));
    return arena_format(a, "%s peak %s dB", rule, keys_yaml_number(l->peak, a));
}

const char *set_hash(const char *const *texts, int n, struct arena *a)
{
    char *hex = arena_take(a, HASH_TEXT, 1), length[32];
    struct hash h = hash_start();
    for (int i = 0; i < n; i++) {
        size_t size = strlen(texts[i]);
        hash_add(&h, length, (size_t)snprintf(length, sizeof length, "%zu:", size));
        hash_add(&h, texts[i], size);
    }
    hash_end(&h, hex);
    return hex;
}

/* ------------------------------------------------------------------ one stimulus */

struct trial { /* of one scene, until it is taken; it lies in its own arena */
    struct arena *arena;
    const struct diag *diag;
    const char *messages; /* as of scene_read */
    struct scene scene;
    char sha256[HASH_TEXT]; /* of what the scene means */
    struct err e;           /* none: it can be rendered */
    const char **warnings;  /* of what is opened; ends with NULL, NULL: not known */
};

struct look {            /* what is known of a stimulus */
    struct trial *trial; /* NULL: not begun, or taken */
    int fault;           /* from 1; 0: it can be rendered */
    double seconds, cost, rate, ramp;
    int channels, encoding, bits;
    int quantity;      /* of the sound, enum modes_quantity; -1: not stated */
    bool sounds, loud; /* loud: its level is a loudness */
    bool brief;        /* found to be too short for that */
    bool otherwise;    /* found to be of another form than the set's sounds */
    bool drawn; /* its seed says where it goes, too, as a scribble's does: replicates differ in more than their noise */
};

struct planning {
    struct set *set;
    const struct set_plan_ask *ask;
    struct look *looks; /* [n] */
    int *first; /* [n] the stimulus that is read for it: the first of its cell, itself where the seed says where it goes
                 */
    bool *now,
        second; /* [n] those that are read; for the second time: what was drawn otherwise than the first of its cell */
    const char ***endings; /* [n] of the files that those write; each ends with NULL */
    const char **last;     /* the endings that were noted last: most share theirs */
    struct set_plan *out;
    struct arena *arena;
    int first_sound, first_stated; /* of the form of the set; -1: none */
    struct hash scenes;            /* of the design, of all of them and of the recordings, in their order */
};

static const char *recording_of(const struct planning *p, int i) { return p->set->design->stimuli[i].recording; }

static const char *name_of(const struct planning *p, int i) { return p->set->design->stimuli[i].name; }

static struct trial *trial_open(void)
{
    struct arena *a = arena_open();
    struct trial *t = ARENA_TAKE(a, struct trial, 1);
    *t = (struct trial){.arena = a, .messages = ""};
    return t;
}

/* The level that is asked of it in the end, by itself or with the others of a common one. */
static struct level wants(const struct planning *p, const struct scene *s)
{
    return p->set->level_rule == DESIGN_LEVEL_SCENE ? s->output.level : p->set->level;
}

static bool estimate(const struct planning *p, int i, struct look *l)
{
    struct plan_scene_estimate x;
    struct trial *t = l->trial = trial_open();
    struct scene *s = &t->scene;
    bool read = design_scene(p->set->design, i, t->arena, s, &t->messages, &t->e);
    t->diag = s->diag;
    /* The texts it was read from lie in the file cache from now on, which knows whether they change while the set is
       rendered: each stimulus reads them once more. */
    for (const char *const *file = s->sources; read && *file; file++)
        read = file_cache_sha256(p->ask->file_cache, *file, t->arena, &t->e);
    if (!read) return false;
    s->file_cache = p->ask->file_cache;
    /* File names are seen from the base scene: where all lies does not count. */
    const char *text = scene_write(s, relpath_folder(s->sources[0], t->arena), t->arena);
    hash_bytes(text, strlen(text), t->sha256);
    set_means(p->set, s, t->arena, p->set->means[i]);
    for (int k = 0; k < s->n_contacts; k++)
        l->drawn = l->drawn || s->contacts[k].motion.path == PATH_SCRIBBLE;
    set_lay(p->set, s);
    design_scene_places(p->set->design, s, t->arena);
    struct scene coarse = accuracy_coarsest(s);
    if (!plan_scene_estimate(&coarse, t->arena, &x, &t->e)) return scene_places_report(s, &t->e);
    t->warnings = x.warnings;
    struct track_format f = sound_format(s, x.length.frames);
    l->seconds = (double)x.length.frames / f.rate;
    l->cost = fmax(x.cycles, 1);
    l->rate = f.rate;
    l->channels = f.channels;
    l->bits = abs(f.bits);
    l->encoding = s->output.encoding;
    l->ramp = s->output.ramp;
    l->sounds = x.sounds;
    l->quantity = x.quantity;
    l->loud = !isnan(wants(p, s).lufs);
    return true;
}

static long frames_of(const struct look *l, double seconds) { return (long)rint(seconds * l->rate); }

static bool is_short(const struct look *l, double seconds)
{
    return l->sounds && l->loud && frames_of(l, seconds) < loudness_least(l->rate);
}

/* ------------------------------------------------------------------ one form */

/* Players and trial scripts take one rate and one number of channels for all that they play, and resample, or fail,
   where it is another. *key: by which it became so. */
static bool is_of_form(const struct planning *p, const struct look *l, const char **key, struct err *e)
{
    const struct look *first = &p->looks[p->first[p->first_sound]];
    const char *name = name_of(p, p->first_sound);
    *key = "output.sample_rate";
    if (l->rate != first->rate)
        return err_set(
            e, ERR_SCENE,
            "the sound has %g Hz, '%s' of the same set %g Hz: give all one output.sample_rate, or make two sets",
            l->rate, name, first->rate);
    *key = "output.channels";
    if (l->channels != first->channels)
        return err_set(e, ERR_SCENE,
                       "the sound has %d channel%s, '%s' of the same set %d: give all as many (output.channels, "
                       "output.listen), or make two sets",
                       l->channels, l->channels == 1 ? "" : "s", name, first->channels);
    *key = "output.quantity";
    if (p->set->level_rule != DESIGN_LEVEL_COMMON || l->quantity < 0) return true;
    int other = p->looks[p->first[p->first_stated]].quantity;
    return l->quantity == other ||
           err_set(e, ERR_SCENE,
                   "the sound is in %s, '%s' of the same set in %s, and one gain cannot be common to both: choose one "
                   "by output.quantity, or level: {each: ...}",
                   modes_quantity_unit(l->quantity), name_of(p, p->first_stated), modes_quantity_unit(other));
}

static bool is_otherwise(const struct planning *p, int i, struct look *l)
{
    struct err e = {0};
    const char *key;
    if (is_of_form(p, l, &key, &e)) return false;
    struct trial *t = l->trial = trial_open();
    struct scene *s = &t->scene;
    l->otherwise = true;
    if (!design_scene(p->set->design, i, t->arena, s, &t->messages, &t->e)) return true;
    t->e = e;
    if (!strcmp(key, "output.channels") && l->channels != s->output.channels) key = "output.listen";
    bool response = !strcmp(key, "output.quantity") && s->output.quantity == QUANTITY_AUTO;
    err_about(&t->e, response ? s->contacts[0].name : NULL, response ? "surface.response" : key);
    design_scene_places(p->set->design, s, t->arena);
    scene_places_report(s, &t->e);
    return true;
}

/* ------------------------------------------------------------------ faults */

static void conclude(struct planning *p, int i, struct look *l)
{
    struct set_plan *o = p->out;
    struct trial *t = l->trial;
    l->trial = NULL;
    for (int k = 0; t && !t->e.kind && t->warnings && t->warnings[k]; k++) {
        int known = 0;
        while (known < o->n_warnings && strcmp(o->warnings[known].text, t->warnings[k]) != 0)
            known++;
        if (known == o->n_warnings && known < SET_FAULTS)
            o->warnings[o->n_warnings++] = (struct set_warning){arena_text(p->arena, t->warnings[k]), name_of(p, i)};
    }
    int k = 0; /* which fault it is: the first that has it keeps its texts */
    bool bad = t && t->e.kind;
    while (bad && k < o->n_faults && k < SET_FAULTS &&
           (strcmp(o->faults[k].messages, t->messages) != 0 ||
            (!*t->messages && strcmp(o->faults[k].err->text, t->e.text) != 0)))
        k++;
    if (bad) {
        o->worst = t->e.kind > o->worst ? t->e.kind : o->worst;
        l->fault = k + 1;
    }
    if (bad && k == o->n_faults) {
        o->faults = arena_more(p->arena, o->faults, o->n_faults, sizeof *o->faults);
        o->faults[o->n_faults++] = (struct set_fault){t->arena, t->diag, t->messages, &t->e, name_of(p, i), 0};
    } else if (t)
        arena_close(t->arena);
    if (l->fault) o->faults[l->fault - 1].n++;
}

/* ------------------------------------------------------------------ scenes */

/* The files that the scene of stimulus i reads, and the endings of those that it writes. */
static void note_files(struct planning *p, int i, const struct scene *scene)
{
    int n;
    struct arena *a = arena_open();
    const struct outputs_source *reads = outputs_sources(scene, &n, a);
    const struct outputs o = outputs_make(scene, "", a);
    for (int k = 0; k < n; k++)
        folder_inputs_add(p->out->inputs, reads[k].file, reads[k].what, reads[k].device, reads[k].inode);
    bool same = p->last; /* most share theirs with the one before */
    for (int k = 0; same && k < o.n; k++)
        same = p->last[k] && !strcmp(o.paths[k], p->last[k]);
    if (!same || p->last[o.n]) {
        p->last = ARENA_TAKE(p->arena, const char *, o.n + 1);
        for (int k = 0; k < o.n; k++)
            p->last[k] = arena_text(p->arena, o.paths[k]);
    }
    p->endings[i] = p->last;
    arena_close(a);
}

static bool look(void *context, int i)
{
    struct planning *p = context;
    if (p->now[i]) estimate(p, i, &p->looks[i]);
    return !p->now[i] || !interrupt_seen();
}

static void took(void *context, int i)
{
    struct planning *p = context;
    struct look *l = &p->looks[p->first[i]];
    if (recording_of(p, i) || (!p->now[i] && (p->second || l->drawn))) return;
    if (l->trial && !p->second) hash_add(&p->scenes, l->trial->sha256, HASH_TEXT);
    if (l->trial && !l->trial->e.kind) note_files(p, p->first[i], &l->trial->scene);
    conclude(p, i, l);
}

static void find_first(struct planning *p)
{
    long cells = 0;
    for (int i = 0; i < p->set->n; i++)
        cells = p->set->design->stimuli[i].cell >= cells ? p->set->design->stimuli[i].cell + 1 : cells;
    int *of = ARENA_TAKE(p->arena, int, cells + 1);
    for (int i = 0; i < p->set->n; i++) {
        int *first = &of[p->set->design->stimuli[i].cell];
        p->first[i] = i;
        if (recording_of(p, i)) continue;
        if (!*first) *first = i + 1;
        p->first[i] = *first - 1;
        p->now[i] = p->first[i] == i;
    }
}

/* The noise decides where a scribble goes, and so how fast it is, and whether it stays on its map. */
static bool find_drawn(struct planning *p)
{
    bool any = false;
    p->second = true;
    for (int i = 0; i < p->set->n; i++) {
        bool other = !recording_of(p, i) && p->first[i] != i && p->looks[p->first[i]].drawn;
        p->now[i] = other;
        p->first[i] = other ? i : p->first[i];
        any = any || other;
    }
    return any;
}

static bool look_at_all(struct planning *p, struct err *e)
{
    int n = p->set->n,
        done =
            pool_run(&(struct pool_work){.n = n, .threads = p->ask->threads, .context = p, .job = look, .took = took});
    for (int i = 0; i < n; i++)
        if (p->looks[i].trial) arena_close(p->looks[i].trial->arena);
    return done == n || err_set(e, ERR_INTERRUPTED, "interrupted; nothing was written, run the same command again");
}

/* ------------------------------------------------------------------ the whole */

static bool is_sound(const struct planning *p, int i) { return !recording_of(p, i) && p->looks[p->first[i]].sounds; }

/* Of recordings alone the form is that of the first of them, in 24 bits. */
static void look_at_forms(struct planning *p)
{
    struct set *s = p->set;
    p->first_sound = p->first_stated = -1;
    for (int i = s->n - 1; i >= 0; i--) { /* the form is that of the first sound */
        const struct look *l = &p->looks[p->first[i]];
        if (!is_sound(p, i)) continue;
        p->first_stated = l->quantity >= 0 ? i : p->first_stated;
        p->first_sound = i;
        s->rate = l->rate;
        s->channels = l->channels;
        s->encoding = l->encoding;
        s->ramp = l->ramp;
    }
    for (int i = 0; i < s->n; i++) {
        struct look *l = &p->looks[p->first[i]];
        if (is_sound(p, i) && (p->first[i] == i ? !l->fault && is_otherwise(p, i, l) : l->otherwise)) conclude(p, i, l);
    }
}

static void look_at_recordings(struct planning *p)
{
    struct set *s = p->set;
    for (int i = 0; i < s->n; i++) {
        struct look *l = &p->looks[i];
        const char *file = recording_of(p, i);
        if (!file) continue;
        l->trial = trial_open();
        const char *sha256 = file_cache_sha256(p->ask->file_cache, file, l->trial->arena, &l->trial->e);
        if (sha256) hash_add(&p->scenes, sha256, HASH_TEXT);
        if (!sha256 || !recording_check(file, &s->rate, &s->channels, &l->seconds, &l->trial->e))
            design_scene_recording(p->set->design, i, &l->trial->e);
        folder_inputs_add_file(p->out->inputs, file, "a recording");
        conclude(p, i, l);
        l->cost = fmax(1, 1000 * l->seconds * s->rate);
        l->rate = s->rate;
        l->channels = s->channels;
        l->bits = abs(sound_bits(s->encoding));
        l->sounds = true;
    }
}

static double seconds_of(const struct set *s, const struct look *l)
{
    return isnan(s->length) ? l->seconds : s->length;
}

/* Found out before anything is rendered, too: what keeps one of them from its level, which depends on the set's length.
 */
static void look_at_levels(struct planning *p)
{
    struct set *s = p->set;
    for (int i = 0; i < s->n; i++) {
        struct look *l = &p->looks[i];
        const char *file = recording_of(p, i);
        if (!file || l->fault) continue;
        l->trial = trial_open();
        if (!recording_check_level(file, s, &l->trial->e)) design_scene_recording(s->design, i, &l->trial->e);
        conclude(p, i, l);
    }
    bool some = true; /* of a common loudness one that is long enough is enough */
    for (int i = 0; i < s->n && s->level_rule == DESIGN_LEVEL_COMMON; i++) {
        const struct look *l = &p->looks[p->first[i]];
        some = some && (recording_of(p, i) || !l->sounds || is_short(l, seconds_of(s, l)));
    }
    for (int i = 0; some && i < s->n; i++) {
        struct look *l = &p->looks[p->first[i]];
        double seconds = seconds_of(s, l);
        if (recording_of(p, i) || (p->first[i] == i ? l->fault || !is_short(l, seconds) : !l->brief)) continue;
        if (p->first[i] == i) {
            struct trial *t = l->trial = trial_open();
            bool read = design_scene(s->design, i, t->arena, &t->scene, &t->messages, &t->e);
            if (read) {
                t->scene.output.level = wants(p, &t->scene);
                design_scene_places(s->design, &t->scene, t->arena);
            }
            if (read && !sound_long_enough(&t->scene, frames_of(l, seconds), &t->e))
                scene_places_report(&t->scene, &t->e);
        }
        l->brief = true;
        conclude(p, i, l);
    }
}

static void add_up(const struct planning *p)
{
    struct set *s = p->set;
    struct set_plan *o = p->out;
    for (int i = 0; i < s->n; i++) {
        const struct look *l = &p->looks[p->first[i]];
        double seconds = seconds_of(s, l), samples = l->sounds ? seconds * l->rate * l->channels : 0;
        s->cost[i] = fmax(1, l->seconds > 0 ? l->cost * seconds / l->seconds : l->cost);
        s->lengths[i] = seconds;
        o->seconds += l->sounds ? seconds : 0;
        if (l->sounds && (!o->n_sounds || l->seconds < o->least)) {
            o->least = l->seconds;
            o->shortest = i;
        }
        if (l->sounds && (!o->n_sounds || l->seconds > o->most)) {
            o->most = l->seconds;
            o->longest = i;
        }
        o->n_sounds += l->sounds;
        o->cycles += s->cost[i];
        o->bytes += samples * l->bits / 8;
        o->raw_bytes += set_waits(s) && !s->design->stimuli[i].recording ? samples * 8 : 0;
    }
}

/* Nothing that the set writes is one of its inputs, or anybody's. */
static bool spares(const struct planning *p, struct err *e)
{
    const char *const own[] = {".json", sound_ending(p->set->encoding), NULL};
    static const char *const tables[] = {"manifest.csv", "manifest.jsonl", "manifest.json",
                                         "SHA256SUMS",   "timings.csv",    NULL};
    const struct set *s = p->set;
    const struct design *d = s->design;
    const char *folder = p->ask->folder;
    struct stat status;
    struct arena *a = arena_open();
    struct folder_output o = {
        .folder = folder, .unknown = !p->ask->replace && !folder_is_recorded(folder, a), .links = p->ask->links};
    bool ok = true, there = stat(folder, &status) == 0; /* an empty one cannot hold an input */
    arena_close(a);
    for (int i = 0; ok && there && i < s->n; i++) {
        a = arena_open();
        o.whose = d->stimuli[i].name;
        for (const char *const *ending = d->stimuli[i].recording ? own : (const char *const *)p->endings[p->first[i]];
             ok && *ending; ending++) {
            o.path = arena_format(a, "%s/%s%s", folder, o.whose, *ending);
            ok = folder_spares(p->out->inputs, &o, a, e);
        }
        arena_close(a);
    }
    o.whose = d->file;
    for (int k = 0; ok && there && tables[k]; k++) {
        o.path = arena_format(p->arena, "%s/%s", folder, tables[k]);
        ok = folder_spares(p->out->inputs, &o, p->arena, e);
    }
    return ok && (!there || folder_spares_hidden(p->out->inputs, folder, d->file, e));
}

bool set_plan(struct set *s, const struct set_plan_ask *ask, struct arena *a, struct set_plan *out, struct err *e)
{
    struct planning p = {.set = s,
                         .ask = ask,
                         .looks = ARENA_TAKE(a, struct look, s->n),
                         .first = ARENA_TAKE(a, int, s->n),
                         .now = ARENA_TAKE(a, bool, s->n),
                         .endings = ARENA_TAKE(a, const char **, s->n),
                         .out = out,
                         .arena = a,
                         .scenes = hash_start()};
    char *sha256 = arena_take(a, HASH_TEXT, 1);
    *out = (struct set_plan){.inputs = folder_inputs(a)};
    s->cost = ARENA_TAKE(a, double, s->n);
    s->lengths = ARENA_TAKE(a, double, s->n);
    s->means = arena_take(a, (size_t)s->n, HASH_TEXT);
    /* The file cache knows what the design was read from and sees whether it changes; a pipe is read and gone. */
    for (const char *const *file = s->design->sources; *file; file++) {
        struct stat status;
        if (stat(*file, &status) == 0 && S_ISREG(status.st_mode) && !file_cache_sha256(ask->file_cache, *file, a, e))
            return false;
        folder_inputs_add_file(out->inputs, *file, "the design");
    }
    find_first(&p);
    hash_add(&p.scenes, s->design->sha256, HASH_TEXT);
    if (!look_at_all(&p, e) || (find_drawn(&p) && !look_at_all(&p, e))) return false;
    look_at_forms(&p);
    look_at_recordings(&p);
    hash_end(&p.scenes, sha256);
    s->sha256 = sha256;
    double longest = 0;
    for (int i = 0; i < s->n; i++) {
        longest = fmax(longest, p.looks[p.first[i]].seconds);
        if (p.first[i] != i) memcpy(s->means[i], s->means[p.first[i]], HASH_TEXT);
    }
    if (s->design->length_rule == DESIGN_LENGTH_LONGEST) s->length = longest;
    look_at_levels(&p);
    add_up(&p);
    int faults = 0;
    for (int k = 0; k < out->n_faults; k++)
        faults += out->faults[k].n;
    if (out->n_faults)
        return err_set(e, out->worst, "%d of %d stimuli cannot be rendered%s", faults, s->n,
                       ask->folder ? "; nothing was written" : "");
    return !ask->folder || spares(&p, e);
}

void set_plan_close(struct set_plan *p)
{
    for (int k = 0; k < p->n_faults; k++)
        arena_close(p->faults[k].arena);
    p->n_faults = 0;
}

const char *set_lengths_text(const struct set *s, const struct set_plan *p, struct arena *a)
{
    const struct design *d = s->design;
    if (d->length_rule != DESIGN_LENGTH_LONGEST || !p->n_sounds ||
        p->most - p->least < 0.01 * p->most) /* three digits tell them apart */
        return NULL;
    return arena_format(a,
                        "each %.3g s, as long as the longest (%s; the shortest, %s, is %.3g s by itself); length: own, "
                        "or a time, in the design",
                        p->most, d->stimuli[p->longest].name, d->stimuli[p->shortest].name, p->least);
}

/* ------------------------------------------------------------------ shards */

bool set_shard_read(const char *text, struct set_shard *s, struct err *e)
{
    char left[8] = "";
    const char *slash = strchr(text, '/');
    size_t n = slash ? (size_t)(slash - text) : sizeof left;
    if (n < sizeof left) memcpy(left, text, n);
    if (slash && n < sizeof left && text_int(slash + 1, 1, SET_SHARDS, &s->n) && text_int(left, 1, s->n, &s->i))
        return true;
    return err_set(e, ERR_USAGE, "--shard %s: write i/n, with n from 1 to %d and i from 1 to n, as in --shard 3/7",
                   text, SET_SHARDS);
}

struct card {
    char hash[HASH_TEXT];
    int row;
};

static int by_hash(const void *a, const void *b)
{
    return strcmp(((const struct card *)a)->hash, ((const struct card *)b)->hash); /* names differ */
}

void set_deal(const struct set *s, int shards, int *to)
{
    struct arena *own = arena_open();
    struct card *cards = ARENA_TAKE(own, struct card, s->n);
    for (int i = 0; i < s->n; i++) {
        const char *name = s->design->stimuli[i].name;
        hash_bytes(name, strlen(name), cards[i].hash);
        cards[i].row = i;
    }
    qsort(cards, (size_t)s->n, sizeof *cards, by_hash);
    for (int i = 0; i < s->n; i++)
        to[cards[i].row] = i % shards + 1;
    arena_close(own);
}

/* ------------------------------------------------------------------ the common gain */

struct set_loudest set_loudest(void) { return (struct set_loudest){.lufs = -HUGE_VAL, .encoding = ENCODING_FLOAT64}; }

void set_loudest_add(struct set_loudest *l, const struct set_measured *m)
{
    if (!m->sounds) return;
    l->peak = fmax(l->peak, m->peak);
    l->rms = fmax(l->rms, m->rms);
    l->lufs = isnan(m->lufs) ? l->lufs : fmax(l->lufs, m->lufs);
    l->encoding = set_largest(m->encoding) < set_largest(l->encoding) ? m->encoding : l->encoding;
    l->any = l->any || m->peak > 0;
}

double set_largest(int encoding)
{
    int bits = sound_bits(encoding);
    return bits > 0 ? 1 - ldexp(1, 1 - bits) : 1;
}

bool set_gain(const struct set *s, const struct set_loudest *l, double *full_scale, struct err *e)
{
    const struct level *level = &s->level;
    *full_scale = 1;
    if (!l->any) return true;
    if (!isnan(level->rms))
        *full_scale = l->rms / real_exp10(level->rms / 20);
    else if (isnan(level->lufs))
        *full_scale = l->peak / fmin(real_exp10(level->peak / 20), set_largest(l->encoding));
    else if (isinf(l->lufs))
        return err_set(e, ERR_SCENE,
                       "level: lufs: no stimulus of the set has a loudness that BS.1770 can measure (0.4 s or more "
                       "that are not nearly silent): use rms or peak");
    else
        *full_scale = real_exp10((l->lufs - level->lufs) / 20);
    return true;
}
