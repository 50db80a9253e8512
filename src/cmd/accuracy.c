/* rasp accuracy: what accuracy costs in time: what is rendered, the renders, and what their errors say. */
#include "cmd/accuracy.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "analysis/convergence.h"
#include "analysis/distance.h"
#include "analysis/spectral_distance.h"
#include "base/interrupt.h"
#include "base/outfile.h"
#include "base/text.h"
#include "file/bytes.h"
#include "file/yaml.h"
#include "num/real.h"
#include "output/gnuplot.h"
#include "output/mark.h"
#include "pipeline/error_budget.h"
#include "pipeline/outputs.h"
#include "pipeline/plan.h"
#include "response/response.h"
#include "scene/accuracy.h"
#include "scene/keys.h"
#include "scene/scene_places.h"

/* --values KNOB=N,N... of `rasp accuracy`: which values of which knobs are rendered besides those of the presets. */

static bool values_one(const char *given, struct arena *a, struct accuracy_values *to, struct err *e)
{
    const char *equals = strchr(given, '='), *names[KNOBS + 1] = {NULL}, *all = "";
    if (!equals || !equals[1])
        return err_set(e, ERR_USAGE, "--values: '%s' is not of the form KNOB=NUMBER,NUMBER..., as in oversampling=2,16",
                       given);
    const char *name = arena_format(a, "%.*s", (int)(equals - given), given), *word;
    int knob = -1;
    for (int k = 0; k < KNOBS; k++) {
        names[k] = keys_knobs[k].name;
        all = arena_format(a, "%s%s%s", all, k ? ", " : "", names[k]);
        knob = strcmp(name, names[k]) ? knob : k;
    }
    const char *near = knob < 0 ? text_nearest(name, names) : NULL;
    if (near) return err_set(e, ERR_USAGE, "--values: there is no knob '%s'; did you mean '%s'?", name, near);
    if (knob < 0) return err_set(e, ERR_USAGE, "--values: there is no knob '%s'; there are %s", name, all);
    for (char *rest = arena_text(a, equals + 1); (word = strsep(&rest, ","));) {
        const struct key_knob *k = &keys_knobs[knob];
        double x;
        if (!text_double(word, &x))
            return err_set(e, ERR_USAGE, "--values: '%s' is not a number (in KNOB=NUMBER,NUMBER..., without units)",
                           word);
        if (!accuracy_takes((enum knob)knob, x))
            return err_set(
                e, ERR_USAGE,
                "--values: accuracy.%s cannot be %s: it takes %snumbers from %g to %g; see rasp explain accuracy.%s",
                k->name, word, k->whole ? "whole " : "", k->low, k->high, k->name);
        if (to[knob].n == ACCURACY_VALUES)
            return err_set(e, ERR_USAGE, "--values: accuracy.%s is given more than %d values; leave some out", k->name,
                           ACCURACY_VALUES);
        to[knob].x[to[knob].n++] = x;
    }
    return true;
}

/* What `rasp accuracy` renders: the presets, the scene as it is, and each knob's values, each once with all other knobs
   at `reference` (what it spoils alone) and once as the scene has them (what it costs). Knobs that turn nothing are
   left as they are, so that settings which differ in those are one. */

enum { PRESETS = 4 };

static bool same(const struct accuracy_sweep *s, const struct accuracy *x, const struct accuracy *y)
{
    for (int k = 0; k < KNOBS; k++)
        if (s->knobs & 1u << k && accuracy_knob(x, (enum knob)k) != accuracy_knob(y, (enum knob)k)) return false;
    return true;
}

static int render_of(struct accuracy_sweep *s, const struct accuracy *set, bool timed)
{
    int i = 0;
    while (i < s->n_renders && !same(s, &s->renders[i].set, set))
        i++;
    if (i == s->n_renders)
        s->renders[s->n_renders++] = (struct accuracy_render){.set = *set, .cpu = HUGE_VAL, .contact_share = NAN};
    s->renders[i].timed |= timed;
    return i;
}

static struct accuracy_row *row_add(struct accuracy_sweep *s, int knob, const char *name, const char *value)
{
    struct accuracy_row *r = &s->rows[s->n_rows++];
    *r = (struct accuracy_row){.knob = knob, .name = name, .value = value, .alone = -1, .fine = NAN, .order = NAN};
    return r;
}

static int preset_render(struct accuracy_sweep *s, const char *preset)
{
    struct accuracy set = s->scene.accuracy;
    accuracy_preset(&set, preset);
    return render_of(s, &set, true);
}

void accuracy_rows(struct accuracy_sweep *s, const struct accuracy_values *own)
{
    int most = PRESETS + 1;
    for (int k = 0; k < KNOBS; k++)
        most += PRESETS + own[k].n;
    s->rows = ARENA_TAKE(s->call->arena, struct accuracy_row, most);
    s->renders = ARENA_TAKE(s->call->arena, struct accuracy_render, 2 * most + 2);
    s->reference = preset_render(s, "reference"); /* rendered first: the others are compared with it */
    s->high = preset_render(s, "high");           /* then this, which shows until when that means anything */
    bool met = false;
    for (int i = 0; keys_presets[i] || (i == PRESETS && !met); i++) { /* the presets, and the scene if it has none */
        struct accuracy set = s->scene.accuracy;
        if (i < PRESETS) accuracy_preset(&set, keys_presets[i]);
        struct accuracy_row *r = row_add(s, -1, i < PRESETS ? "preset" : "scene", i < PRESETS ? keys_presets[i] : "");
        r->total = render_of(s, &set, true);
        r->chosen = same(s, &set, &s->scene.accuracy);
        met |= r->chosen;
        if (i == PRESETS) break;
    }
    for (int k = 0; k < KNOBS && !s->presets; k++) {
        if (!(s->knobs & 1u << k)) continue;
        double x[PRESETS + ACCURACY_VALUES], sign = keys_knobs[k].scale == KEY_STEPS ? 1.0 : -1.0;
        int n = 0;
        for (int i = 0; i < PRESETS + own[k].n; i++) { /* presets' values and those given, coarse to fine, each once */
            double v = i < PRESETS ? keys_knobs[k].preset[i] : own[k].x[i - PRESETS];
            int at = 0;
            while (at < n && sign * x[at] < sign * v)
                at++;
            if (at < n && x[at] == v) continue;
            memmove(x + at + 1, x + at, (size_t)(n++ - at) * sizeof *x);
            x[at] = v;
        }
        for (int i = 0; i < n; i++) {
            struct accuracy alone = s->renders[s->reference].set, all = s->scene.accuracy;
            struct accuracy_row *r = row_add(s, k, keys_knobs[k].name, arena_format(s->call->arena, "%.9g", x[i]));
            accuracy_turn(&alone, (enum knob)k, x[i]);
            accuracy_turn(&all, (enum knob)k, x[i]);
            r->alone = render_of(s, &alone, false);
            r->total = render_of(s, &all, true);
            r->chosen = x[i] == accuracy_knob(&s->scene.accuracy, (enum knob)k);
            r->fine = sign * real_log(x[i]) / real_log(2.0);
        }
    }
}

const char *accuracy_rows_name(const struct accuracy_sweep *s, int render)
{
    for (int i = 0; i < s->n_rows; i++) {
        const struct accuracy_row *r = &s->rows[i];
        if (r->total == render || r->alone == render)
            return arena_format(s->call->arena, "%s%s%s%s", r->name, *r->value ? " " : "", r->value,
                                r->total == render ? "" : ", else reference");
    }
    return "the scene";
}

/* What the errors of a sweep say: the order with which each knob's own error falls, the error that the reference has
   itself, and which settings are worth their time.

   The order between neighbours is of the errors with all other knobs at `reference`. The reference's own error is
   extrapolated from them (analysis/convergence.h), knob by knob, and added up as powers: what is smaller cannot be told
   by comparing with this reference. Nothing is extrapolated where the sound diverges: there errors have grown to the
   size of the sound by the end of what is compared, whatever they began with.

   Of a sound that diverges, two renders which are equally right differ by as much as `high` and `reference`: a distance
   below that is no merit. */

#define OCTAVE_DB 6.020599913279624 /* 20 log10 2 */

static const struct accuracy_render *alone(const struct accuracy_sweep *s, const struct accuracy_row *r)
{
    return r->alone >= 0 && s->renders[r->alone].code == 0 ? &s->renders[r->alone] : NULL;
}

/* The reference's own error by a knob, from its row and the two before it; NAN: there are too few. */
static double judge_own(const struct accuracy_sweep *s, int knob)
{
    double fine[3], amplitude[3], order;
    int n = 0;
    bool met = false;
    for (int i = 0; i < s->n_rows && !met; i++) {
        const struct accuracy_row *r = &s->rows[i];
        if (r->knob != knob || !alone(s, r)) continue;
        met = r->alone == s->reference;
        if (n == 2 && !met) {
            fine[0] = fine[1];
            amplitude[0] = amplitude[1];
            n = 1;
        }
        fine[n] = r->fine;
        amplitude[n++] = real_exp10(-s->renders[r->alone].error.snr / 20.0);
    }
    return !met || n < 2 ? NAN : n == 2 ? amplitude[0] : convergence_left(fine, amplitude, &order);
}

double accuracy_judge_error(const struct accuracy_sweep *s, const struct accuracy_render *r)
{
    if (r->code != 0) return NAN;
    return isfinite(s->until) ? fmax(r->error.spectral, s->renders[s->high].error.spectral) : -r->error.snr;
}

bool accuracy_judge_below(const struct accuracy_sweep *s, const struct accuracy_render *r)
{
    return r->code == 0 && isfinite(r->error.snr) && r->error.snr > s->own_db;
}

void accuracy_judge(struct accuracy_sweep *s)
{
    double sum = 0.0;
    for (int i = 1; i < s->n_rows; i++) {
        const struct accuracy_row *before = &s->rows[i - 1], *r = &s->rows[i];
        const struct accuracy_render *reference = &s->renders[s->reference], *x = alone(s, before), *y = alone(s, r);
        if (r->knob < 0 || !x || !y || before->knob != r->knob || y == reference || x == reference) continue;
        double fine[2] = {before->fine, r->fine}, error[2] = {-x->error.snr / OCTAVE_DB, -y->error.snr / OCTAVE_DB};
        s->rows[i].order = convergence_slope(fine, error);
    }
    for (int k = 0; k < KNOBS; k++) {
        s->own[k] = s->knobs & 1u << k && isinf(s->until) ? judge_own(s, k) : NAN;
        sum += isnan(s->own[k]) ? 0.0 : s->own[k] * s->own[k];
    }
    s->own_db = sum > 0.0 ? -10.0 * real_log10(sum) : INFINITY;
    double *cost = ARENA_TAKE(s->call->arena, double, s->n_renders),
           *error = ARENA_TAKE(s->call->arena, double, s->n_renders);
    bool *on = ARENA_TAKE(s->call->arena, bool, s->n_renders);
    for (int i = 0; i < s->n_renders; i++) {
        cost[i] = s->renders[i].timed ? s->renders[i].cpu : NAN;
        error[i] = accuracy_judge_error(s, &s->renders[i]);
    }
    convergence_front(s->n_renders, cost, error, (struct convergence_equal){0.05, 0.1},
                      on); /* what 3 runs tell apart, and an ear by far does not */
    for (int i = 0; i < s->n_renders; i++)
        s->renders[i].front = on[i];
}

/* One render in a process of its own: the program itself, `rasp render SCENE --json`, with the knobs as --set. So peak
   memory (wait4's ru_maxrss) is that of the render alone, and CPU time is what the render's summary says of itself:
   reading responses, choosing engines, running, writing; starting the program is not in it. It is forked, not spawned:
   a process that shares its parent's memory until it becomes another program is charged with its parent's peak. */

/* ------------------------------------------------------------------ the folder */

bool accuracy_child_folder(struct accuracy_sweep *s, struct err *e)
{
    s->folder = outfile_scratch_make_folder("rasp-accuracy", s->call->arena, e);
    return s->folder != NULL;
}

/* What a render left. */
static void child_clear(const struct accuracy_sweep *s)
{
    DIR *d = opendir(s->folder);
    if (!d) return;
    for (struct dirent *entry; (entry = readdir(d));)
        if (strcmp(entry->d_name, ".") && strcmp(entry->d_name, "..") && strcmp(entry->d_name, "reference.wav"))
            unlinkat(dirfd(d), entry->d_name, 0);
    closedir(d);
}

void accuracy_child_end(const struct accuracy_sweep *s)
{
    if (!s->folder) return;
    child_clear(s);
    unlink(arena_format(s->call->arena, "%s/reference.wav", s->folder));
    rmdir(s->folder);
    interrupt_forget(s->folder);
}

static const char *child_sound(const struct accuracy_sweep *s)
{
    return arena_format(s->call->arena, "%s/render.wav", s->folder);
}

/* ------------------------------------------------------------------ the process */

static char **command_line(const struct accuracy_sweep *s, const struct accuracy *set)
{
    struct arena *a = s->call->arena;
    int n;
    const char **given = args_values(&s->call->args, "set", &n), *seed = args_value(&s->call->args, "seed");
    const char **words = ARENA_TAKE(a, const char *, n + KNOBS + 16), **to = words;
    *to++ = "rasp";
    *to++ = "render";
    *to++ = "--json";
    *to++ = arena_format(a, "--output=%s", child_sound(s));
    for (int i = 0; i < n; i++)
        *to++ = arena_format(a, "--set=%s", given[i]);
    if (seed) *to++ = arena_format(a, "--seed=%s", seed);
    *to++ = "--set=output.encoding=float64";
    if (s->force) *to++ = "--set=output.quantity=force";
    *to++ = "--set=accuracy=standard";
    for (int k = 0; k < KNOBS; k++)
        *to++ = arena_format(a, "--set=accuracy.%s=%.17g", keys_knobs[k].name, accuracy_knob(set, (enum knob)k));
    *to++ = "--";
    *to = bytes_piped(s->file) ? "/dev/stdin" : s->file;
    return (char **)words;
}

/* Runs it; its standard output in `out`, its standard error in the file. The exit code, or -1: it was
 * killed. */
static int run_child(char **argv, FILE *says, FILE *scene, FILE *out, double *peak, struct err *e)
{
    struct rusage used;
    int ends[2], status = 0;
    if (pipe2(ends, O_CLOEXEC) != 0)
        return err_set(e, ERR_CREATE, "a render cannot be started: %s", strerror(errno)), -1;
    fflush(NULL);
    interrupt_hold();
    pid_t pid = fork();
    if (pid == 0) {
        if (scene) dup2(fileno(scene), STDIN_FILENO);
        dup2(ends[1], STDOUT_FILENO);
        dup2(fileno(says), STDERR_FILENO);
        execv("/proc/self/exe", argv);
        _exit(127);
    }
    interrupt_child(pid);
    interrupt_go();
    close(ends[1]);
    char some[4096];
    ssize_t n = 1;
    while (pid > 0 && n != 0 && (n > 0 || errno == EINTR)) /* what it prints until it ends */
        if ((n = read(ends[0], some, sizeof some)) > 0) fwrite(some, 1, (size_t)n, out);
    close(ends[0]);
    if (pid < 0) return err_set(e, ERR_CREATE, "a render cannot be started: %s", strerror(errno)), -1;
    interrupt_wait(pid, &status, &used);
    *peak = 1024.0 * (double)used.ru_maxrss;
    return WIFEXITED(status) ? WEXITSTATUS(status)
                             : (err_set(e, ERR_NUMBERS, "a render was ended by signal %d (%s)", WTERMSIG(status),
                                        strsignal(WTERMSIG(status))),
                                -1);
}

/* ------------------------------------------------------------------ what it said */

bool accuracy_child(struct accuracy_sweep *s, int render, struct err *e)
{
    struct accuracy_render *r = &s->renders[render];
    FILE *says = outfile_scratch_open();
    char *output = NULL;
    size_t output_size;
    FILE *out = open_memstream(&output, &output_size);
    struct err cause = {0};
    double peak = 0.0;
    if (!says || !out) return err_set(e, ERR_CREATE, "a render cannot be started: %s", strerror(errno));
    /* A scene that came through a pipe, for the child to read once more. NULL: it did not, or *e */
    size_t size;
    const char *text = bytes_piped(s->file) ? yaml_bytes_text(s->file, NULL, &size) : NULL;
    FILE *scene = text ? outfile_scratch_open() : NULL;
    if (text && (!scene || fwrite(text, 1, size, scene) != size || fflush(scene) != 0))
        err_set(&cause, ERR_CREATE, "a render cannot be started: its scene cannot be kept in %s: %s",
                outfile_scratch_folder(), strerror(errno));
    r->code = cause.kind ? -1 : run_child(command_line(s, &r->set), says, scene, out, &peak, &cause);
    if (scene) fclose(scene);
    r->peak = fmax(r->peak, peak);
    /* The first line that tells of an error. */
    static const char mark[] = "rasp render: error: ";
    char line[900] = "";
    rewind(says);
    while (fgets(line, sizeof line, says) && !strstr(line, "error: "))
        continue;
    line[strcspn(line, "\n")] = '\0';
    const char *words =
        !*line ? "it said nothing"
               : text_shown(s->call->arena, strncmp(line, mark, sizeof mark - 1) ? line : line + sizeof mark - 1);
    fclose(says);
    fclose(out);
    json_t *j = r->code == 0 ? json_loads(output, 0, NULL) : NULL, *each;
    free(output);
    if (r->code == 0) {
        json_t *cpu = json_object_get(j, "cpu_s"), *gain = json_object_get(json_object_get(j, "sound"), "gain");
        size_t i;
        bool ok = json_is_number(cpu) && json_is_number(gain);
        r->cpu = fmin(r->cpu, ok ? json_number_value(cpu) : HUGE_VAL);
        r->gain = ok ? json_number_value(gain) : 1.0;
        json_array_foreach(json_object_get(j, "contacts"), i, each)
        {
            json_t *share = json_object_get(json_object_get(each, "roll"), "contact_share");
            if (isnan(r->contact_share) && json_is_number(share)) r->contact_share = json_number_value(share);
        }
        json_decref(j);
        return ok || err_set(e, ERR_NUMBERS, "a render's summary cannot be read");
    }
    if (r->code < 0) return err_set(e, interrupt_seen() ? ERR_INTERRUPTED : cause.kind, "%s", cause.text);
    r->words = words;
    if (interrupt_seen() || r->code == ERR_INTERRUPTED)
        return err_set(e, ERR_INTERRUPTED, "interrupted; nothing was written, run the same command again");
    /* A scene that does not take the setting, or numbers that fail with it, are facts about the setting; the rest is
       not. */
    return ((r->code == ERR_SCENE || r->code == ERR_NUMBERS) && render != s->reference) ||
           err_set(e, (enum err_kind)r->code, "the render with %s ended with exit code %d: %s",
                   accuracy_rows_name(s, render), r->code, words);
}

/* A render's sound against the reference's, both in the sound's own unit: the level that the scene sets is taken out of
   each. Where the sound diverges (distance_agreement: `high` does not follow `reference` to the end), samples are
   compared up to there, and what comes after by what two sounds of one kind have in common. */

#define WITHIN 60.0 /* dB: third octaves farther below the loudest are left out */

static struct wav part(const struct wav *w, size_t from, size_t to)
{
    struct wav p = *w;
    from = from < w->frames ? from : w->frames;
    to = to < w->frames ? to : w->frames;
    p.x = w->x + from * (size_t)w->channels;
    p.frames = to - from;
    return p;
}

static double level(const struct wav *w)
{
    double sum = 0.0;
    for (size_t i = 0; i < w->frames * (size_t)w->channels; i++)
        sum += w->x[i] * w->x[i];
    return 10.0 * real_log10(sum / (double)w->frames);
}

struct accuracy_error accuracy_child_distance(const struct wav *a, const struct wav *b, double until)
{
    struct accuracy_error o = {.snr = NAN,
                               .third = NAN,
                               .third_hz = NAN,
                               .spectral = NAN,
                               .level = NAN,
                               .length = (double)b->frames / b->rate};
    struct arena *arena = arena_open();
    size_t frames = a->frames < b->frames ? a->frames : b->frames,
           cut = until * a->rate < (double)frames ? (size_t)rint(until * a->rate) : frames,
           from = cut < frames ? cut : 0;
    struct wav first[2] = {part(a, 0, cut), part(b, 0, cut)}, rest[2] = {part(a, from, frames), part(b, from, frames)};
    struct distance_samples d;
    struct distance_bands bands;
    if (cut > 0) {
        distance_samples(&first[0], &first[1], &d);
        o.snr = d.snr_db;
    }
    distance_bands(&rest[0], &rest[1], WITHIN, arena, &bands);
    o.third = bands.compared ? bands.worst_db : 0.0;
    o.third_hz = bands.compared ? distance_band_nominal(bands.band) : NAN;
    o.spectral = spectral_distance_sounds(&rest[0], &rest[1]);
    o.level = level(&rest[1]) - level(&rest[0]);
    o.follows = (double)distance_agreement(a, b) / a->rate;
    arena_close(arena);
    return o;
}

static bool sound_read(const char *path, double gain, struct arena *a, struct wav *w, struct err *e)
{
    if (!wav_read(path, a, w, e)) return false;
    for (size_t i = 0; i < w->frames * (size_t)w->channels; i++)
        w->x[i] /= gain;
    return true;
}

bool accuracy_child_compare(struct accuracy_sweep *s, int render, struct err *e)
{
    struct accuracy_render *r = &s->renders[render];
    const char *path = arena_format(s->call->arena, "%s/reference.wav", s->folder);
    struct arena *arena = arena_open();
    struct wav a, b;
    bool is = render == s->reference;
    bool ok = sound_read(child_sound(s), r->gain, arena, &b, e) &&
              (is || sound_read(path, s->renders[s->reference].gain, arena, &a, e));
    if (ok && is) {
        interrupt_hold(); /* it would slip past what removes the folder */
        ok = rename(child_sound(s), path) == 0 || err_set(e, ERR_IO, "%s: %s", path, strerror(errno));
        interrupt_go();
        s->rate = b.rate;
        s->channels = b.channels;
        s->length = (double)b.frames / b.rate;
    }
    if (ok && !is && (a.channels != b.channels || a.rate != b.rate))
        ok = err_set(e, ERR_NUMBERS, "the renders differ in rate or channels and cannot be compared");
    if (ok && render == s->high && !is) {
        size_t until = distance_agreement(&a, &b);
        s->until = until < a.frames && until < b.frames ? (double)until / a.rate : INFINITY;
    }
    if (ok) r->error = accuracy_child_distance(is ? &b : &a, &b, s->until);
    arena_close(arena);
    return ok;
}

/* ------------------------------------------------------------------ the command */

static const struct args_option accuracy_options[] = {
    {"presets", 'p', NULL, false, "render only the presets (and the scene as it is), no single knobs"},
    {"values", 0, "KNOB=N,N...", true,
     "further values of a knob besides those of the presets, as in oversampling=2,16; may be repeated"},
    {"runs", 'n', "N", false, "how often each setting is rendered for its CPU time, in turns; the least counts (3)"},
    {"csv", 0, "FILE", false, "write the table to FILE, which ends in .csv"},
    {"plot", 0, "FILE", false, "draw error against real-time factor into FILE, which ends in .png or .svg"},
    {"json", 0, NULL, false, "print the table as JSON"},
    {"force", 'f', NULL, false, "replaces the files of --csv and --plot if they exist"},
    CMD_SCENE_OPTIONS,
    {0},
};

/* ------------------------------------------------------------------ asking */

bool accuracy_silent(const struct scene *s)
{
    for (int i = 0; i < s->n_contacts; i++)
        if (s->contacts[i].gain != 0 && response_audible(&s->contacts[i], &s->output)) return false;
    return true;
}

static bool ask_scene(struct accuracy_sweep *s, struct err *e)
{
    struct accuracy_values own[KNOBS] = {{0}};
    int n;
    const char **given = args_values(&s->call->args, "values", &n);
    for (int k = 0; k < KNOBS; k++)
        own[k].x = ARENA_TAKE(s->call->arena, double, ACCURACY_VALUES);
    for (int i = 0; i < n; i++)
        if (!values_one(given[i], s->call->arena, own, e)) return false;
    if (!cmd_read_scene(s->call, s->file, &s->scene, e)) return false;
    struct scene asked = s->scene;
    if (!error_budget_apply(&asked, s->call->arena, &s->scene, NULL, e)) return scene_places_report(&asked, e);
    s->scene.contacts = asked.contacts; /* engines are chosen for each setting */
    s->force = accuracy_silent(&s->scene);
    if (s->force) s->scene.output.quantity = QUANTITY_FORCE;
    const char *paths[] = {s->csv, s->plot};
    for (int i = 0; i < 2; i++) { /* what is written must not be what is read; and can it be written? */
        enum output_kind kind = OUTPUT_TABLE;
        struct outputs o = {.scene = &s->scene, .base = "", .paths = &paths[i], .kinds = &kind, .n = 1};
        struct outfile probe;
        if (!paths[i]) continue;
        if (!outputs_check_overwrite(&o, 1, s->call->arena, &(struct err){0}))
            return err_set(e, ERR_CREATE, "%s is a file that the scene reads: give --%s another name", paths[i],
                           i ? "plot" : "csv");
        bool force = args_given(&s->call->args, "force");
        bool may = i ? mark_permits(paths[i], NULL, force, e) : mark_absent(paths[i], force, e);
        if (!may || !outfile_open_fd(&probe, paths[i], e)) return false;
        outfile_drop(&probe);
    }
    if (!plan_scene_knobs(&s->scene, s->call->arena, &s->knobs, e)) return scene_places_report(&s->scene, e);
    accuracy_rows(s, own);
    return true;
}

/* ------------------------------------------------------------------ doing */

static void progress(const struct accuracy_sweep *s, int done, int all)
{
    if (isatty(STDERR_FILENO))
        fprintf(stderr, done < all ? "\r%s: render %d of %d " : "\r\033[K", s->file, done + 1, all);
}

/* Runs of one setting lie apart, so that what slows the machine for a while slows one run of each. */
static bool sweep(struct accuracy_sweep *s, struct err *e)
{
    int all = s->n_renders, done = 0; /* each once, those whose cost counts again and again */
    for (int i = 0; i < s->n_renders; i++)
        all += s->renders[i].timed ? s->runs - 1 : 0;
    bool ok = true;
    for (int run = 0; ok && run < s->runs; run++)
        for (int i = 0; ok && i < s->n_renders; i++) {
            struct accuracy_render *r = &s->renders[i];
            if (run > 0 && (!r->timed || r->code != 0)) continue;
            progress(s, done++, all);
            ok = accuracy_child(s, i, e) && (run > 0 || r->code != 0 || accuracy_child_compare(s, i, e));
            child_clear(s);
        }
    progress(s, all, all);
    return ok;
}

static int accuracy_run(struct cmd_call *c, struct err *e)
{
    const struct args *g = &c->args;
    struct accuracy_sweep s = {.call = c,
                               .file = g->operands[0],
                               .until = INFINITY,
                               .json = args_given(g, "json"),
                               .presets = args_given(g, "presets"),
                               .csv = args_value(g, "csv"),
                               .plot = args_value(g, "plot")};
    long runs = 3;
    if (!args_whole(g, "runs", (const long[2]){1, 1000}, &runs, e)) return (int)e->kind;
    s.runs = (int)runs;
    if (s.presets && args_given(g, "values"))
        err_set(e, ERR_USAGE, "--presets leaves no room for --values");
    else if (s.csv && !text_ends(s.csv, ".csv"))
        err_set(e, ERR_USAGE, "--csv %s: must end in .csv", s.csv);
    else if (s.plot && !text_ends(s.plot, ".png") && !text_ends(s.plot, ".svg"))
        err_set(e, ERR_USAGE, "--plot %s: must end in .png or .svg", s.plot);
    if (e->kind || !ask_scene(&s, e) || !accuracy_child_folder(&s, e)) return (int)e->kind;
    bool ok = sweep(&s, e);
    accuracy_child_end(&s);
    if (!ok) return (int)e->kind;
    accuracy_judge(&s);
    struct outfile files[2]; /* all that can fail is done before the first gets its name */
    int n = 0;
    if (s.plot && gnuplot_draw(&files[n], s.plot, text_ends(s.plot, ".svg"), accuracy_report_plot, &s, e)) n++;
    if (s.csv && e->kind == ERR_NONE && outfile_open(&files[n], s.csv, e)) accuracy_report_table(&s, files[n++].stream);
    outfile_commit_all(files, n, e);
    if (e->kind == ERR_NONE) accuracy_report(&s, e);
    return (int)e->kind;
}

const struct command accuracy_command = {
    .name = "accuracy",
    .summary = "shows what accuracy costs: error and time of each preset and knob",
    .does = "Renders the scene with each preset, and with each value that a preset has of each knob that turns it "
            "(rasp plan lists them), and prints how far each is from the preset reference: the samples' error in dB, "
            "the worst difference of third octaves, the distance of spectra (windows of 5, 20 and 80 ms); and what it "
            "costs: CPU time, times real time, peak memory. alone: all other knobs at reference, so that the knob's "
            "own error shows; order: the power of the knob with which that falls (of a knob in dB, dB per dB); total: "
            "all other knobs as the scene has them. The error that reference has itself is extrapolated from that, and "
            "smaller ones are marked. * marks what nothing else beats in both error and CPU time. Where two renders "
            "diverge, as of a ball that bounces, it says from when on, and compares levels and spectra of what comes "
            "after. A scene without a sound is compared by its contact force. Each render is a process of its own, one "
            "at a time, in a temporary folder.",
    .operands = "SCENE",
    .least = 1,
    .most = 1,
    .options = accuracy_options,
    .examples =
        "rasp accuracy scenes/strike.yaml\n"
        "rasp accuracy scenes/basswood_scrape.yaml --set 'motion.duration=0.5 s' --csv cost.csv --plot cost.png\n"
        "rasp accuracy scenes/strike.yaml --values oversampling=2,16 --runs 1 --json\n",
    .run = accuracy_run,
};
