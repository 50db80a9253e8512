/* A gallery: one page of HTML for a set of stimuli (its manifest.csv) or for any folder of sounds, with a small
   spectrogram of each, all on the same axes of time, frequency and level. Pictures and sounds are linked by relative
   names, so that the folder can be moved as a whole; nothing comes from elsewhere. What is shown stands in the page as
   JSON, and a script in the page (plot_gallery_page.c) makes rows of the table as they come into view. */
#include <dirent.h>
#include <errno.h>
#include <jansson.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/interrupt.h"
#include "base/outfile.h"
#include "base/relpath.h"
#include "base/text.h"
#include "batch/pool.h"
#include "cmd/plot.h"
#include "file/bytes.h"
#include "file/csv.h"
#include "file/wav.h"
#include "output/mark.h"
#include "output/picture.h"

enum { COLUMNS = 240, ROWS = 72, CELLS = COLUMNS * ROWS }; /* of the longest sound's picture */

enum kind { SOUND, SILENT, FAILED }; /* silent: a render that made tables only */

struct item {
    const char *file, *name; /* the sound, seen from here; what it is called */
    enum kind kind;
    double seconds;  /* of the sound; 0: it cannot be read     */
    int columns;     /* of the picture; 0: there is none       */
    int top;         /* its greatest level                     */
    const char *why; /* it cannot be drawn; NULL: it can       */
    size_t row;      /* of the manifest                        */
};

struct page {
    const char *source;
    bool force;
    struct arena *arena;
    const char *folder;         /* of the sounds: "" or "out/"                  */
    const char *output, *files; /* the page, and the folder of its pictures     */
    bool set;                   /* there is a manifest                          */
    struct csv manifest;
    struct item *items;
    int n;
    double longest; /* s, of all sounds          */
    struct picture_axes axes;
    int top;     /* the greatest level of all */
    FILE *cells; /* of all pictures           */
    struct pool_progress progress;
    pthread_mutex_t lock; /* of the arena and the error while there are threads */
    struct err *e;
};

/* ------------------------------------------------------------------ what is in it */

static int column(const struct page *g, const char *name) { return csv_column(&g->manifest, name); }

static const char *cell(const struct page *g, size_t row, int column)
{
    return g->manifest.cells[row * g->manifest.columns + (size_t)column];
}

static bool is_there(const char *text) { return *text && strcmp(text, "n/a") != 0; }

static bool from_manifest(struct page *g, const char *file, struct err *e)
{
    if (!csv_read(file, g->arena, &g->manifest, e)) return false;
    int name = column(g, "file_name"), id = column(g, "stimulus_id"), status = column(g, "status");
    if (name < 0 || g->manifest.rows == 0)
        return err_set(e, ERR_SCENE, "%s: %s: it is no manifest of a set, as rasp batch writes it", file,
                       name < 0 ? "has no column file_name" : "has no rows");
    g->set = true;
    g->items = ARENA_TAKE(g->arena, struct item, g->manifest.rows);
    for (size_t row = 0; row < g->manifest.rows; row++) {
        const char *sound = cell(g, row, name), *called = id >= 0 ? cell(g, row, id) : sound;
        bool sounds = wav_is_name(sound),
             failed = status >= 0 ? strcmp(cell(g, row, status), "ok") != 0 : !is_there(sound);
        const char *wav = sounds ? sound : arena_format(g->arena, "%s.wav", called);
        g->items[g->n++] = (struct item){arena_format(g->arena, "%s%s", g->folder, wav), called,
                                         failed   ? FAILED
                                         : sounds ? SOUND
                                                  : SILENT,
                                         .row = row};
    }
    return true;
}

static int is_sound(const struct dirent *entry) { return entry->d_name[0] != '.' && wav_is_name(entry->d_name); }

/* The operand: a manifest, or a folder with or without one. */
static bool gather(struct page *g, struct err *e)
{
    const char *source = g->source, *slash = strrchr(source, '/');
    struct stat st;
    if (text_ends(source, ".csv")) {
        g->folder = arena_format(g->arena, "%.*s", slash ? (int)(slash - source + 1) : 0, source);
        return from_manifest(g, source, e);
    }
    if (stat(source, &st) != 0) return err_set(e, ERR_INPUT, "%s: %s", source, strerror(errno));
    if (!S_ISDIR(st.st_mode))
        return err_set(e, ERR_USAGE, "%s: neither a folder nor a manifest (.csv): a gallery is made of many sounds",
                       source);
    g->folder = !strcmp(source, ".")
                    ? ""
                    : arena_format(g->arena, "%s%s", source, text_ends(source, "/") || !strcmp(source, "/") ? "" : "/");
    const char *manifest = arena_format(g->arena, "%smanifest.csv", g->folder);
    if (access(manifest, F_OK) == 0) return from_manifest(g, manifest, e);
    struct dirent **entries;
    int n = scandir(*g->folder ? g->folder : ".", &entries, is_sound, alphasort);
    if (n < 0) return err_set(e, ERR_INPUT, "%s: %s", source, strerror(errno));
    g->items = ARENA_TAKE(g->arena, struct item, n);
    for (int i = 0; i < n; i++) {
        const char *name = entries[i]->d_name, *base = relpath_base(name, g->arena);
        bool twice = i > 0 && !strcmp(relpath_base(entries[i - 1]->d_name, g->arena), base); /* WAV and FLAC */
        g->items[g->n++] = (struct item){.file = arena_format(g->arena, "%s%s", g->folder, name),
                                         .name = twice ? arena_text(g->arena, name) : base,
                                         .kind = SOUND};
    }
    for (int i = 0; i < n; i++)
        free(entries[i]);
    free(entries);
    return g->n > 0 || err_set(e, ERR_SCENE, "%s: no sound (.wav) is in it", source);
}

/* ------------------------------------------------------------------ pictures

   Levels of all sounds are known before the first picture has colours: they wait in a file without a name. */

static const char *picture_of(const struct page *g, const struct item *item, struct arena *a)
{
    char *flat = arena_text(a, item->name);
    for (char *p = flat; *p; p++)
        *p = *p == '/' ? '=' : *p; /* which no name of a stimulus holds */
    return arena_format(a, "%s/%s.png", g->files, flat);
}

/* The axes, from the headers. A sound that cannot be read leaves a note on the page. */
static void axes_find(struct page *g)
{
    double rate = 0;
    for (int i = 0; i < g->n; i++) {
        struct item *item = &g->items[i];
        struct wav_stream w;
        struct err why = {0};
        if (item->kind != SOUND || interrupt_seen()) continue;
        if (wav_stream_open(&w, item->file, &why)) {
            item->seconds = (double)w.frames / w.rate;
            g->longest = fmax(g->longest, item->seconds);
            rate = fmax(rate, w.rate);
            wav_stream_close(&w);
        } else
            item->why = arena_text(g->arena, why.text);
    }
    g->axes = picture_axes_make(rate, ROWS);
    for (int i = 0; i < g->n; i++)
        if (g->items[i].seconds > 0)
            g->items[i].columns = (int)fmax(1, rint(COLUMNS * g->items[i].seconds / g->longest));
}

/* By any thread. What is wrong with a sound is its own; what else fails ends all. */
static bool measure(void *page, int i)
{
    struct page *g = page;
    struct item *item = &g->items[i];
    if (!item->columns) return !interrupt_seen();
    struct arena *a = arena_open();
    struct wav w;
    struct err why = {0};
    unsigned char *cells = ARENA_TAKE(a, unsigned char, CELLS);
    size_t n = (size_t)item->columns * ROWS;
    bool ok = wav_read(item->file, a, &w, &why), kept = true;
    if (ok) {
        for (size_t k = 0; k < w.frames; k++)
            w.x[k] = w.x[k * (size_t)w.channels]; /* the first channel */
        picture_cells(w.x, w.frames, w.rate, &g->axes, item->columns, cells);
        item->top = picture_top(cells, n);
        kept = pwrite(fileno(g->cells), cells, n, (off_t)i * CELLS) == (ssize_t)n;
    }
    pthread_mutex_lock(&g->lock);
    if (!kept) err_set(g->e, ERR_IO, "%s: levels cannot be kept: %s", outfile_scratch_folder(), strerror(errno));
    if (!ok) item->why = arena_text(g->arena, why.text);
    if (!ok) item->columns = 0;
    pthread_mutex_unlock(&g->lock);
    arena_close(a);
    return kept && !interrupt_seen();
}

static void measured(void *page, int i)
{
    struct page *g = page;
    g->top = g->items[i].top > g->top ? g->items[i].top : g->top;
    pool_progress_step(&g->progress, g->items[i].name, 1, 0, g->items[i].seconds);
}

static bool draw(void *page, int i)
{
    struct page *g = page;
    const struct item *item = &g->items[i];
    if (!item->columns) return !interrupt_seen();
    struct arena *a = arena_open();
    struct err why = {0};
    unsigned char *cells = ARENA_TAKE(a, unsigned char, CELLS);
    const char *target = picture_of(g, item, a);
    ssize_t n = (ssize_t)item->columns * ROWS;
    bool ok = (pread(fileno(g->cells), cells, (size_t)n, (off_t)i * CELLS) == n ||
               err_set(&why, ERR_IO, "%s: levels cannot be read", outfile_scratch_folder())) &&
              mark_permits(target, NULL, g->force, &why) &&
              picture_write(target, cells, item->columns, ROWS, g->top, &why);
    pthread_mutex_lock(&g->lock);
    if (!ok) err_set(g->e, why.kind, "%s", why.text);
    pthread_mutex_unlock(&g->lock);
    arena_close(a);
    return ok && !interrupt_seen();
}

/* How many there are. */
static int draw_all(struct page *g, int threads, struct err *e)
{
    int drawn = 0;
    g->e = e;
    g->cells = outfile_scratch_open();
    if (!g->cells) return err_set(e, ERR_CREATE, "%s: %s", outfile_scratch_folder(), strerror(errno));
    if (mkdir(g->files, 0777) != 0 && errno != EEXIST)
        err_set(e, ERR_CREATE, "the folder %s cannot be created: %s", g->files, strerror(errno));
    pthread_mutex_init(&g->lock, NULL);
    axes_find(g);
    pool_progress_begin(&g->progress, g->n, g->n, false);
    if (e->kind == ERR_NONE && pool_run(&(struct pool_work){g->n, threads, g, measure, measured}) == g->n)
        pool_run(&(struct pool_work){g->n, threads, g, draw, NULL});
    pool_progress_clear(&g->progress);
    if (interrupt_seen())
        err_set(e, ERR_INTERRUPTED, "interrupted; the page was not written, run the same command again");
    pthread_mutex_destroy(&g->lock);
    fclose(g->cells);
    for (int i = 0; i < g->n; i++)
        drawn += g->items[i].columns > 0;
    return drawn;
}

/* ------------------------------------------------------------------ the page */

/* A file's name as the page links it: what is no plain character as %XX. */
static const char *encoded(const struct page *g, const char *name)
{
    static const char plain[] = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz-_.~/+";
    char *out = arena_take(g->arena, 3 * strlen(name) + 1, 1), *to = out;
    for (const char *p = name; *p; p++)
        to += snprintf(to, 4, strchr(plain, *p) ? "%c" : "%%%02X", (unsigned char)*p);
    return out;
}

/* A column that the table shows. */
struct shown {
    const char *title;
    int column;         /* of the manifest */
    const char *format; /* of a number that is rounded; NULL: it stands as it is */
};

/* Factors stand between scene_sha256 and text; of the rest what helps to compare, where it is not the same for all. */
static int columns_shown(const struct page *g, struct shown *to)
{
    static const struct {
        const char *name, *title, *format;
    } more[] = {{"split", "split", NULL},
                {"replicate", "replicate", "%g"},
                {"duration_s", "duration / s", "%.3f"},
                {"peak_dbfs", "peak / dBFS", "%.1f"},
                {"rms_dbfs", "rms / dBFS", "%.1f"},
                {"loudness_lufs", "loudness / LUFS", "%.1f"}};
    int first = g->set ? column(g, "scene_sha256") : -1, text = g->set ? column(g, "text") : -1, n = 0;
    for (int k = first + 1; first >= 0 && k < text; k++)
        to[n++] = (struct shown){g->manifest.names[k], k, NULL};
    for (int i = 0; g->set && i < 6; i++) {
        int k = column(g, more[i].name);
        const char *one = NULL;
        bool varies = false;
        for (size_t row = 0; k >= 0 && !varies && row < g->manifest.rows; row++) {
            const char *here = is_there(cell(g, row, k)) ? cell(g, row, k) : one;
            varies = one && strcmp(here, one) != 0;
            one = here;
        }
        if (varies) to[n++] = (struct shown){more[i].title, k, more[i].format};
    }
    return n;
}

/* A value, which is taken, within the page's script: < would end it. */
static void put_json(json_t *value, FILE *f)
{
    char *text = json_dumps(value, JSON_COMPACT | JSON_ENSURE_ASCII | JSON_REAL_PRECISION(9));
    for (const char *p = text ? text : "null"; *p; p++)
        fputs(*p == '<' ? "\\u003c" : (const char[]){*p, '\0'}, f);
    free(text);
    json_decref(value);
}

static json_t *text_json(const struct page *g, const char *text) { return json_string(text_shown(g->arena, text)); }

/* What the script calls an item. */
static json_t *item_json(const struct page *g, const struct item *item, const struct shown *shown, int n)
{
    int status = g->set ? column(g, "status") : -1, error = g->set ? column(g, "error") : -1,
        text = g->set ? column(g, "text") : -1;
    const char *why = item->why;
    if (!why && item->kind == SILENT) why = "no sound";
    if (!why && item->kind == FAILED) {
        why = status >= 0 ? cell(g, item->row, status) : "failed";
        if (error >= 0 && is_there(cell(g, item->row, error)))
            why = arena_format(g->arena, "%s: %s", why, cell(g, item->row, error));
    }
    json_t *o = json_pack("{s:o}", "name", text_json(g, item->name)), *v = json_array();
    if (item->kind == SOUND && !item->why) {
        json_object_set_new(o, "file", json_string(encoded(g, item->file + strlen(g->folder))));
        json_object_set_new(o, "picture",
                            json_string(encoded(g, relpath_stem(picture_of(g, item, g->arena), g->arena))));
        json_object_set_new(o, "columns", json_integer(item->columns));
        json_object_set_new(o, "seconds", json_real(item->seconds));
    }
    if (why) json_object_set_new(o, "why", text_json(g, why));
    if (text >= 0 && is_there(cell(g, item->row, text)))
        json_object_set_new(o, "text", text_json(g, cell(g, item->row, text)));
    for (int k = 0; k < n; k++) {
        const char *here = cell(g, item->row, shown[k].column);
        char rounded[32];
        double x;
        if (shown[k].format && text_double(here, &x)) {
            snprintf(rounded, sizeof rounded, shown[k].format, x);
            here = rounded;
        }
        json_array_append_new(v, text_json(g, here));
    }
    json_object_set_new(o, "values", v);
    return o;
}

/* "4 sounds, 2 without sound, 1 failed" */
static const char *counted(const struct page *g)
{
    int n[] = {[SOUND] = 0, [SILENT] = 0, [FAILED] = 0};
    for (int i = 0; i < g->n; i++)
        n[g->items[i].kind]++;
    const char *text = "";
    if (n[SOUND] || !(n[SILENT] || n[FAILED]))
        text = arena_format(g->arena, "%d sound%s", n[SOUND], n[SOUND] == 1 ? "" : "s");
    if (n[SILENT]) text = arena_format(g->arena, "%s%s%d without sound", text, *text ? ", " : "", n[SILENT]);
    return n[FAILED] ? arena_format(g->arena, "%s%s%d failed", text, *text ? ", " : "", n[FAILED]) : text;
}

/* --title, else that of the design that the folder of the set names, else the folder's name. */
static const char *title_of(const struct page *g, struct cmd_call *c)
{
    const char *title = args_value(&c->args, "title"), *design = NULL;
    struct bytes owner;
    struct err none = {0};
    if (!title && g->set && bytes_read(arena_format(g->arena, "%s.rasp/owner", g->folder), g->arena, &owner, &none)) {
        char *rest = owner.at; /* batch/folder.h: its third line says where the design lies */
        for (int line = 0; line < 3; line++)
            design = strsep(&rest, "\n");
        if (design && *design && strncmp(design, "- ", 2) != 0) {
            design = *design == '/' ? design : arena_format(g->arena, "%s%s", g->folder, design);
            title = access(design, R_OK) == 0 ? cmd_recipe_remark(c, design, "title") : NULL;
        }
    }
    if (title) return title;
    return *g->folder ? arena_format(g->arena, "%.*s", (int)strlen(g->folder) - 1, g->folder) : "sounds";
}

static void put_page(const struct page *g, const char *title, FILE *f)
{
    struct shown *shown = ARENA_TAKE(g->arena, struct shown, g->set ? g->manifest.columns + 6 : 1);
    int n = columns_shown(g, shown);
    const char *name = text_html(g->arena, text_shown(g->arena, title)),
               *from = relpath_make(*g->folder ? g->folder : ".", relpath_folder(g->output, g->arena), g->arena);
    json_t *columns = json_array(), *palette = json_array();
    for (int k = 0; k < n; k++)
        json_array_append_new(columns, text_json(g, shown[k].title));
    for (int k = 0; k < PICTURE_ANCHORS; k++)
        json_array_append_new(palette, json_sprintf("#%06x", picture_palette[k]));
    fprintf(f,
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n" MARK_PAGE
            "\n<meta name=\"viewport\" content=\"width=device-width\">\n<title>%s</title>\n<style>\n%s</style>\n"
            "</head>\n<body>\n<header>\n<h1>%s</h1>\n%s<script>\nconst set = ",
            name, plot_gallery_page_style, name, plot_gallery_page_bar);
    put_json(json_pack("{s:s, s:s, s:f, s:i, s:i, s:f, s:f, s:i, s:i, s:o, s:o}", "sounds",
                       arena_format(g->arena, "%s%s", encoded(g, from), *from ? "/" : ""), "pictures",
                       arena_format(g->arena, "%s/", encoded(g, relpath_stem(g->output, g->arena))), "seconds",
                       g->longest, "width", COLUMNS, "height", ROWS, "low", g->axes.low, "high", g->axes.high, "top",
                       g->top * PICTURE_STEP + PICTURE_LOWEST, "range", PICTURE_RANGE, "palette", palette, "columns",
                       columns),
             f);
    fputs(";\nset.items = [\n", f);
    for (int i = 0; i < g->n; i++) {
        put_json(item_json(g, &g->items[i], shown, n), f);
        fputs(",\n", f);
    }
    fputs("];\n", f);
    for (const char *const *part = plot_gallery_page_script; *part; part++)
        fputs(*part, f);
    fputs("</script>\n</body>\n</html>\n", f);
}

int plot_gallery_run(struct cmd_call *c, struct err *e)
{
    static const char *const others[] = {"from", "to", "channel", "panels", "format"};
    const char *output = args_value(&c->args, "output");
    struct page g = {.source = c->args.operands[0], .force = args_given(&c->args, "force"), .arena = c->arena};
    struct outfile o;
    int threads, drawn;
    for (int k = 0; k < 5; k++)
        if (args_given(&c->args, others[k]))
            err_set(e, ERR_USAGE, "--%s: not of a gallery, which shows small spectrograms of whole sounds", others[k]);
    if (output && !text_ends(output, ".html"))
        err_set(e, ERR_USAGE, "--output %s: a gallery is a page of HTML, its name must end in .html", output);
    if (e->kind || !batch_threads(c, &threads, e) || !gather(&g, e)) return (int)e->kind;
    g.output = output ? output : arena_format(c->arena, "%sgallery.html", g.folder);
    g.files = arena_format(c->arena, "%.*s", (int)strlen(g.output) - 5, g.output);
    if (!mark_permits(g.output, NULL, g.force, e) || !outfile_open(&o, g.output, e)) return (int)e->kind;
    drawn = draw_all(&g, threads, e);
    if (e->kind == ERR_NONE) {
        put_page(&g, title_of(&g, c), o.stream);
        outfile_commit(&o, e);
    }
    outfile_drop(&o);
    if (e->kind == ERR_NONE)
        printf("%s  %s, %d picture%s in %s/\n", g.output, counted(&g), drawn, drawn == 1 ? "" : "s", g.files);
    return (int)e->kind;
}
