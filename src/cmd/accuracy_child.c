/* rasp accuracy: single renders, and how far each is from the reference. See accuracy.h. */
#include "cmd/accuracy.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "analysis/distance.h"
#include "analysis/spectral_distance.h"
#include "base/interrupt.h"
#include "base/outfile.h"
#include "base/text.h"
#include "file/bytes.h"
#include "file/yaml.h"
#include "num/real.h"
#include "scene/accuracy.h"
#include "scene/keys.h"

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

/* What the last render left. */
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
    const char **words = ARENA_TAKE(a, const char *, n + s->scene.n_contacts + KNOBS + 16), **to = words;
    *to++ = "rasp";
    *to++ = "render";
    *to++ = "--json";
    *to++ = arena_format(a, "--output=%s", child_sound(s));
    for (int i = 0; i < n; i++)
        *to++ = arena_format(a, "--set=%s", given[i]);
    if (seed) *to++ = arena_format(a, "--seed=%s", seed);
    *to++ = "--set=output.encoding=float64";
    if (s->force) *to++ = "--set=output.quantity=force";
    for (int i = 0; s->excerpt > 0 && i < s->scene.n_contacts; i++) {
        const struct contact *c = &s->scene.contacts[i];
        const char *of = s->scene.n_contacts > 1 ? arena_format(a, "contacts.%s.", c->name) : "";
        if (c->motion.until > 0) *to++ = arena_format(a, "--set=%smotion.until=%.17g", of, c->motion.until);
    }
    if (s->excerpt > 0) *to++ = "--set=output.level=null"; /* a loudness needs 0.4 s */
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
    child_clear(s);
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
        if (!r->runs) r->runs = ARENA_TAKE(s->call->arena, double, s->runs + 1);
        if (ok) r->runs[r->n_runs++] = json_number_value(cpu);
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
   each. Where the sound diverges (distance_agreement: the reference's neighbour does not follow it to the end), samples
   are compared up to there, and what comes after by what two sounds of one kind have in common. */

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
    if (ok && render == s->near && !is) {
        size_t until = distance_agreement(&a, &b);
        s->until = until < a.frames && until < b.frames ? (double)until / a.rate : INFINITY;
    }
    if (ok) r->error = accuracy_child_distance(is ? &b : &a, &b, s->until);
    arena_close(arena);
    return ok;
}
