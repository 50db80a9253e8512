/* One render in a process of its own: the program itself, `rasp render SCENE --json`, with the knobs as --set. So peak
   memory (wait4's ru_maxrss) is that of the render alone, and CPU time is what the render's summary says of itself:
   reading responses, choosing engines, running, writing; starting the program is not in it. It is forked, not spawned:
   a process that shares its parent's memory until it becomes another program is charged with its parent's peak. */
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

#include "analysis/agreement.h"
#include "analysis/distance.h"
#include "analysis/log_spectral.h"
#include "base/interrupt.h"
#include "base/scratch.h"
#include "base/text.h"
#include "file/bytes.h"
#include "file/yaml.h"
#include "num/real.h"
#include "scene/accuracy.h"
#include "scene/keys.h"

/* ------------------------------------------------------------------ the folder */

bool accuracy_child_folder(struct accuracy_sweep *s, struct err *e)
{
    s->folder = scratch_make_folder("rasp-accuracy", s->call->arena, e);
    return s->folder != NULL;
}

void accuracy_child_clear(const struct accuracy_sweep *s)
{
    DIR *d = s->folder ? opendir(s->folder) : NULL;
    if (!d) return;
    for (struct dirent *entry; (entry = readdir(d));)
        if (strcmp(entry->d_name, ".") && strcmp(entry->d_name, "..") && strcmp(entry->d_name, "reference.wav"))
            unlinkat(dirfd(d), entry->d_name, 0);
    closedir(d);
}

void accuracy_child_end(const struct accuracy_sweep *s)
{
    if (!s->folder) return;
    accuracy_child_clear(s);
    unlink(arena_format(s->call->arena, "%s/reference.wav", s->folder));
    rmdir(s->folder);
    interrupt_forget(s->folder);
}

static const char *accuracy_child_sound(const struct accuracy_sweep *s)
{
    return arena_format(s->call->arena, "%s/render.wav", s->folder);
}

/* ------------------------------------------------------------------ the process */

struct words {
    const char **list;
    int n;
};

static void put(struct words *w, const char *option, const char *value)
{
    w->list[w->n++] = option;
    if (value) w->list[w->n++] = value;
}

static char **command_line(const struct accuracy_sweep *s, const struct accuracy *set)
{
    struct arena *a = s->call->arena;
    int n;
    const char **given = args_values(&s->call->args, "set", &n), *seed = args_value(&s->call->args, "seed");
    struct words w = {.list = ARENA_TAKE(a, const char *, 2 * (n + KNOBS) + 24)};
    put(&w, "rasp", "render");
    put(&w, "--json", NULL);
    put(&w, "--output", accuracy_child_sound(s));
    for (int i = 0; i < n; i++)
        put(&w, "--set", given[i]);
    if (seed) put(&w, "--seed", seed);
    put(&w, "--set", "output.encoding=float64");
    if (s->force) put(&w, "--set", "output.quantity=force");
    put(&w, "--set", "accuracy=standard");
    for (int k = 0; k < KNOBS; k++)
        put(&w, "--set", arena_format(a, "accuracy.%s=%.17g", keys_knobs[k].name, accuracy_knob(set, (enum knob)k)));
    put(&w, "--", bytes_piped(s->file) ? "/dev/stdin" : s->file);
    return (char **)w.list;
}

static _Noreturn void become(char **argv, int end, FILE *says, FILE *scene)
{
    if (scene) dup2(fileno(scene), STDIN_FILENO);
    dup2(end, STDOUT_FILENO);
    dup2(fileno(says), STDERR_FILENO);
    execv("/proc/self/exe", argv);
    _exit(127);
}

struct text {
    char *x;
    size_t n, room;
};

static void text_take(struct text *t, const char *from, size_t n)
{
    if (t->n + n + 1 > t->room) t->x = realloc(t->x, t->room = 2 * (t->n + n + 1));
    if (!t->x) abort();
    memcpy(t->x + t->n, from, n);
    t->x[t->n += n] = '\0';
}

/* What it prints until it ends. */
static void listen_to(int fd, struct text *t)
{
    char some[4096];
    ssize_t n;
    while ((n = read(fd, some, sizeof some)) > 0 || (n < 0 && errno == EINTR))
        if (n > 0) text_take(t, some, (size_t)n);
}

/* Runs it; its standard output in *out (to be freed), its standard error in the file. The exit code, or -1: it was
 * killed. */
static int run(char **argv, FILE *says, FILE *scene, struct text *out, double *peak, struct err *e)
{
    struct rusage used;
    int ends[2], status = 0;
    if (pipe2(ends, O_CLOEXEC) != 0)
        return err_set(e, ERR_CREATE, "a render cannot be started: %s", strerror(errno)), -1;
    fflush(NULL);
    interrupt_hold();
    pid_t pid = fork();
    if (pid == 0) become(argv, ends[1], says, scene);
    interrupt_child(pid);
    interrupt_go();
    close(ends[1]);
    if (pid > 0) listen_to(ends[0], out);
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

static bool summary_read(struct accuracy_render *r, const struct text *out, struct err *e)
{
    json_t *j = out->x ? json_loads(out->x, 0, NULL) : NULL, *cpu = json_object_get(j, "cpu_s"),
           *gain = json_object_get(json_object_get(j, "sound"), "gain"), *each;
    size_t i;
    if (json_is_number(cpu)) r->cpu = fmin(r->cpu, json_number_value(cpu));
    json_array_foreach(json_object_get(j, "contacts"), i, each)
    {
        json_t *share = json_object_get(json_object_get(each, "roll"), "contact_share");
        if (isnan(r->contact_share) && json_is_number(share)) r->contact_share = json_number_value(share);
    }
    bool ok = json_is_number(cpu) && json_is_number(gain);
    r->gain = ok ? json_number_value(gain) : 1.0;
    json_decref(j);
    return ok || err_set(e, ERR_NUMBERS, "a render's summary cannot be read");
}

/* A scene that does not take the setting, or numbers that fail with it, are facts about the setting; the rest is not.
 */
static bool refused(struct accuracy_sweep *s, int render, const char *words, struct err *e)
{
    struct accuracy_render *r = &s->renders[render];
    r->words = words;
    if (interrupt_seen() || r->code == ERR_INTERRUPTED)
        return err_set(e, ERR_INTERRUPTED, "interrupted; nothing was written, run the same command again");
    if ((r->code == ERR_SCENE || r->code == ERR_NUMBERS) && render != s->reference) return true;
    return err_set(e, (enum err_kind)r->code, "the render with %s ended with exit code %d: %s",
                   accuracy_rows_name(s, render), r->code, words);
}

bool accuracy_child(struct accuracy_sweep *s, int render, struct err *e)
{
    struct accuracy_render *r = &s->renders[render];
    FILE *says = scratch_open();
    struct text out = {0};
    struct err cause = {0};
    double peak = 0.0;
    if (!says) return err_set(e, ERR_CREATE, "a render cannot be started: %s", strerror(errno));
    /* A scene that came through a pipe, for the child to read once more. NULL: it did not, or *e */
    size_t size;
    const char *text = bytes_piped(s->file) ? yaml_bytes_text(s->file, NULL, &size) : NULL;
    FILE *f = text ? scratch_open() : NULL;
    if (text && (!f || fwrite(text, 1, size, f) != size || fflush(f) != 0))
        err_set((&cause), ERR_CREATE, "a render cannot be started: its scene cannot be kept in %s: %s",
                scratch_folder(), strerror(errno));
    FILE *scene = f;
    r->code = cause.kind ? -1 : run(command_line(s, &r->set), says, scene, &out, &peak, &cause);
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
    bool ok = r->code < 0    ? err_set(e, interrupt_seen() ? ERR_INTERRUPTED : cause.kind, "%s", cause.text)
              : r->code == 0 ? summary_read(r, &out, e)
                             : refused(s, render, words, e);
    free(out.x);
    return ok;
}

/* A render's sound against the reference's, both in the sound's own unit: the level that the scene sets is taken out of
   each. Where the sound diverges (agreement.h: `high` does not follow `reference` to the end), samples are compared up
   to there, and what comes after by what two sounds of one kind have in common. */

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
    o.spectral = log_spectral(&rest[0], &rest[1]);
    o.level = level(&rest[1]) - level(&rest[0]);
    o.follows = (double)agreement(a, b) / a->rate;
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

static bool reference_taken(struct accuracy_sweep *s, const char *path, const struct wav *a, struct err *e)
{
    interrupt_hold(); /* it would slip past what removes the folder */
    bool moved = rename(accuracy_child_sound(s), path) == 0;
    interrupt_go();
    if (!moved) return err_set(e, ERR_IO, "%s: %s", path, strerror(errno));
    s->rate = a->rate;
    s->channels = a->channels;
    s->length = (double)a->frames / a->rate;
    return true;
}

bool accuracy_child_compare(struct accuracy_sweep *s, int render, struct err *e)
{
    struct accuracy_render *r = &s->renders[render];
    const char *path = arena_format(s->call->arena, "%s/reference.wav", s->folder);
    struct arena *arena = arena_open();
    struct wav a, b;
    bool is = render == s->reference;
    bool ok = sound_read(accuracy_child_sound(s), r->gain, arena, &b, e) &&
              (is || sound_read(path, s->renders[s->reference].gain, arena, &a, e));
    if (ok && is) ok = reference_taken(s, path, &b, e);
    if (ok && !is && (a.channels != b.channels || a.rate != b.rate))
        ok = err_set(e, ERR_NUMBERS, "the renders differ in rate or channels and cannot be compared");
    if (ok && render == s->high && !is) {
        size_t until = agreement(&a, &b);
        s->until = until < a.frames && until < b.frames ? (double)until / a.rate : INFINITY;
    }
    if (ok) r->error = accuracy_child_distance(is ? &b : &a, &b, s->until);
    arena_close(arena);
    return ok;
}
