/* A gallery: one page of HTML for a set of stimuli (its manifest.csv) or for any folder of sounds. No script, no style
   sheet or font from elsewhere; pictures and sounds are linked by relative names, so that the folder can be moved as a
   whole. */
#include <dirent.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/interrupt.h"
#include "base/outfile.h"
#include "base/relpath.h"
#include "base/text.h"
#include "cmd/plot.h"
#include "file/csv.h"
#include "output/gnuplot.h"
#include "output/mark.h"

enum kind { SOUND, SILENT, FAILED }; /* silent: a render that made tables only */

struct item {
    const char *file,
        *name; /* the sound, seen from here (of what is silent: as it would be called); what it is called */
    enum kind kind;
    const char *picture; /* NULL: there is none                          */
    const char *why;     /* ... and why; NULL: it failed                 */
    size_t row;          /* of the manifest                              */
};

struct page {
    const struct plot_gallery *of;
    struct arena *arena;
    const char *folder;         /* of the sounds: "" or "out/"                  */
    const char *output, *files; /* the page, and the folder of its pictures     */
    bool set;                   /* there is a manifest                          */
    struct csv manifest;
    struct item *items;
    int n;
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
        bool sounds = text_ends(sound, ".wav"),
             failed = status >= 0 ? strcmp(cell(g, row, status), "ok") != 0 : !is_there(sound);
        const char *wav = sounds ? sound : arena_format(g->arena, "%s.wav", called);
        g->items[g->n++] = (struct item){arena_format(g->arena, "%s%s", g->folder, wav),
                                         called,
                                         failed ? FAILED : sounds ? SOUND : SILENT,
                                         NULL,
                                         NULL,
                                         row};
    }
    return true;
}

static int is_sound(const struct dirent *entry) { return entry->d_name[0] != '.' && text_ends(entry->d_name, ".wav"); }

static bool from_folder(struct page *g, struct err *e)
{
    struct dirent **entries;
    int n = scandir(*g->folder ? g->folder : ".", &entries, is_sound, alphasort);
    if (n < 0) return err_set(e, ERR_INPUT, "%s: %s", g->of->source, strerror(errno));
    g->items = ARENA_TAKE(g->arena, struct item, n);
    for (int i = 0; i < n; i++) {
        const char *name = entries[i]->d_name;
        g->items[g->n++] = (struct item){arena_format(g->arena, "%s%s", g->folder, name),
                                         arena_format(g->arena, "%.*s", (int)strlen(name) - 4, name),
                                         SOUND,
                                         NULL,
                                         NULL,
                                         0};
        free(entries[i]);
    }
    free(entries);
    return g->n > 0 || err_set(e, ERR_SCENE, "%s: no sound (.wav) is in it", g->of->source);
}

/* The operand: a manifest, or a folder with or without one. */
static bool gather(struct page *g, struct err *e)
{
    const char *source = g->of->source, *slash = strrchr(source, '/');
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
    return access(manifest, F_OK) == 0 ? from_manifest(g, manifest, e) : from_folder(g, e);
}

/* ------------------------------------------------------------------ pictures */

static void draw(void *self, struct gnuplot *g) { plot_draw(self, g); }

/* Of what has no sound the panels that need none; where that leaves none of them, whatever there is. */
static unsigned asked(const struct page *g, const struct item *item)
{
    return item->kind == SILENT ? g->of->asked & ~(1u << PLOT_WAVEFORM | 1u << PLOT_SPECTROGRAM) : g->of->asked;
}

/* s; 0: the manifest does not say. */
static double length(const struct page *g, const struct item *item)
{
    int k = column(g, "duration_s");
    double x;
    return k >= 0 && text_double(cell(g, item->row, k), &x) ? x : 0;
}

/* A sound that cannot be drawn leaves a note on the page; what no picture could be drawn without ends all. */
static bool draw_item(struct page *g, struct item *item, struct err *e)
{
    struct arena *a = arena_open();
    char *flat = arena_text(g->arena, item->name);
    for (char *p = flat; *p; p++)
        *p = *p == '/' ? '=' : *p; /* which no name of a stimulus holds */
    const char *target = arena_format(g->arena, "%s/%s.%s", g->files, flat, g->of->svg ? "svg" : "png");
    struct plot_page p = {.file = item->file,
                          .title = item->name,
                          .from = NAN,
                          .to = NAN,
                          .asked = asked(g, item),
                          .svg = g->of->svg,
                          .channel = 1,
                          .arena = a,
                          .call = g->of->call,
                          .silent = item->kind == SILENT,
                          .length = item->kind == SILENT ? length(g, item) : NAN};
    struct err why = {0};
    bool ok = plot_data(&p, &why);
    if (!ok)
        item->why = arena_text(g->arena, why.text);
    else if (mark_permits(target, NULL, g->of->force, e) && gnuplot_write(target, p.svg, draw, &p, e))
        item->picture = target;
    arena_close(a);
    return e->kind == ERR_NONE;
}

static bool draw_all(struct page *g, struct err *e)
{
    bool tells = isatty(STDERR_FILENO);
    if (mkdir(g->files, 0777) != 0 && errno != EEXIST)
        return err_set(e, ERR_CREATE, "the folder %s cannot be created: %s", g->files, strerror(errno));
    for (int i = 0; i < g->n; i++) {
        if (interrupt_seen())
            return err_set(e, ERR_INTERRUPTED, "interrupted; the page was not written, run the same command again");
        if (tells) fprintf(stderr, "\r%d of %d", i, g->n);
        if (g->items[i].kind != FAILED && !draw_item(g, &g->items[i], e)) break;
    }
    if (tells) fputs("\r\033[K", stderr);
    return e->kind == ERR_NONE;
}

/* ------------------------------------------------------------------ the page */

static void put(FILE *f, const char *text, struct arena *a)
{
    for (const char *p = text_shown(a, text); *p; p++) {
        const char *name = *p == '<' ? "&lt;" : *p == '>' ? "&gt;" : *p == '&' ? "&amp;" : *p == '"' ? "&quot;" : NULL;
        if (name)
            fputs(name, f);
        else
            fputc(*p, f);
    }
}

/* A file as the page links it: relative, what is no plain character as %XX. */
static void put_link(const struct page *g, const char *file, FILE *f)
{
    static const char plain[] = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz-_.~/+";
    const char *slash = strrchr(g->output, '/');
    const char *from = relpath_make(
        file,
        slash ? arena_format(g->arena, "%.*s", slash == g->output ? 1 : (int)(slash - g->output), g->output) : NULL,
        g->arena);
    for (const char *p = from; *p; p++)
        fprintf(f, strchr(plain, *p) ? "%c" : "%%%02X", (unsigned char)*p);
}

/* Rounded: the manifest has all digits. */
static void put_figure(const struct page *g, size_t row, int k, const char *name, const char *format, FILE *f)
{
    double x;
    if (!text_double(cell(g, row, k), &x)) return;
    fprintf(f, "<dt>%s</dt><dd>", name);
    fprintf(f, format, x);
    fputs("</dd>", f);
}

/* Over those that have it. */
static bool varies(const struct page *g, int k)
{
    const char *first = NULL;
    for (size_t row = 0; row < g->manifest.rows; row++) {
        const char *here = is_there(cell(g, row, k)) ? cell(g, row, k) : first;
        if (first && strcmp(here, first) != 0) return true;
        first = here;
    }
    return false;
}

/* Factors stand between scene_sha256 and text; of the rest what helps to compare. */
static void put_facts(const struct page *g, const struct item *item, FILE *f)
{
    static const char *const more[][3] = {{"replicate", "replicate", "%g"},
                                          {"duration_s", "duration", "%.3f s"},
                                          {"peak_dbfs", "peak", "%.1f dBFS"},
                                          {"rms_dbfs", "rms", "%.1f dBFS"},
                                          {"loudness_lufs", "loudness", "%.1f LUFS"}};
    int first = column(g, "scene_sha256"), text = column(g, "text");
    fputs("<dl>", f);
    for (int k = first + 1; first >= 0 && k < text; k++) {
        fputs("<dt>", f);
        put(f, g->manifest.names[k], g->arena);
        fputs("</dt><dd>", f);
        put(f, cell(g, item->row, k), g->arena);
        fputs("</dd>", f);
    }
    for (int i = 0; i < 5; i++) {
        int k = column(g, more[i][0]);
        if (k >= 0 && (i > 0 || varies(g, k))) put_figure(g, item->row, k, more[i][1], more[i][2], f);
    }
    fputs("</dl>", f);
    if (text >= 0 && is_there(cell(g, item->row, text))) {
        fputs("<p>", f);
        put(f, cell(g, item->row, text), g->arena);
        fputs("</p>", f);
    }
}

static void put_item(const struct page *g, const struct item *item, FILE *f)
{
    fputs("<figure>\n<figcaption><h2>", f);
    put(f, item->name, g->arena);
    fputs("</h2>", f);
    if (g->set) put_facts(g, item, f);
    fputs("</figcaption>\n", f);
    if (item->kind == SOUND) {
        fputs("<audio controls preload=\"none\" src=\"", f);
        put_link(g, item->file, f);
        fputs("\"></audio>\n", f);
    }
    if (item->picture) {
        fputs("<a href=\"", f);
        put_link(g, item->picture, f);
        fputs("\"><img loading=\"lazy\" alt=\"plot\" src=\"", f);
        put_link(g, item->picture, f);
        fputs("\"></a>\n", f);
    } else {
        int status = g->set ? column(g, "status") : -1, error = g->set ? column(g, "error") : -1;
        fputs("<p class=\"bad\">", f);
        put(f, item->why ? item->why : status >= 0 ? cell(g, item->row, status) : "no sound", g->arena);
        if (!item->why && error >= 0 && is_there(cell(g, item->row, error))) {
            fputs(": ", f);
            put(f, cell(g, item->row, error), g->arena);
        }
        fputs("</p>\n", f);
    }
    fputs("</figure>\n", f);
}

static int count(const struct page *g, enum kind kind)
{
    int n = 0;
    for (int i = 0; i < g->n; i++)
        n += g->items[i].kind == kind;
    return n;
}

/* "4 sounds, 2 without sound, 1 failed" */
static const char *counted(const struct page *g)
{
    int sounds = count(g, SOUND), silent = count(g, SILENT), failed = count(g, FAILED);
    const char *text =
        sounds || !(silent || failed) ? arena_format(g->arena, "%d sound%s", sounds, sounds == 1 ? "" : "s") : "";
    if (silent) text = arena_format(g->arena, "%s%s%d without sound", text, *text ? ", " : "", silent);
    return failed ? arena_format(g->arena, "%s%s%d failed", text, *text ? ", " : "", failed) : text;
}

static void put_page(const struct page *g, FILE *f)
{
    const char *title = g->of->title ? g->of->title
                        : *g->folder ? arena_format(g->arena, "%.*s", (int)strlen(g->folder) - 1, g->folder)
                                     : "sounds";
    fputs("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n" MARK_PAGE
          "\n<meta name=\"viewport\" content=\"width=device-width\">\n<title>",
          f);
    put(f, title, g->arena);
    fputs("</title>\n<style>\n"
          "body { font: 15px/1.4 'DejaVu Sans', sans-serif; margin: 1.5em; color: #222; background: #fafafa }\n"
          "main { display: grid; grid-template-columns: repeat(auto-fill, minmax(26em, 1fr)); gap: 1.2em }\n"
          "figure { margin: 0; padding: 1em; background: #fff; border: 1px solid #ddd; border-radius: 6px; "
          "overflow-wrap: anywhere }\n"
          "h1 { font-size: 1.4em } h2 { font-size: 1em; margin: 0 0 .4em }\n"
          "dl { display: grid; grid-template-columns: auto 1fr; gap: 0 .8em; margin: 0 0 .6em; font-size: .85em } dt { "
          "color: #777 } dd { margin: 0 }\n"
          "img, audio { width: 100% } .bad { color: #b00020 }\n"
          "</style>\n</head>\n<body>\n<h1>",
          f);
    put(f, title, g->arena);
    fprintf(f, "</h1>\n<p>%s</p>\n<main>\n", counted(g));
    for (int i = 0; i < g->n; i++)
        put_item(g, &g->items[i], f);
    fputs("</main>\n</body>\n</html>\n", f);
}

bool plot_gallery(const struct plot_gallery *of, struct err *e)
{
    struct page g = {.of = of, .arena = of->arena};
    struct outfile o;
    int drawn = 0;
    if (!gather(&g, e)) return false;
    g.output = of->output ? of->output : arena_format(of->arena, "%sgallery.html", g.folder);
    g.files = arena_format(of->arena, "%.*s_files", (int)strlen(g.output) - 5, g.output);
    if (!mark_permits(g.output, NULL, of->force, e) || !outfile_open(&o, g.output, e)) return false;
    if (draw_all(&g, e)) {
        put_page(&g, o.stream);
        outfile_commit(&o, e);
    }
    outfile_drop(&o);
    for (int i = 0; i < g.n; i++)
        drawn += g.items[i].picture != NULL;
    if (e->kind == ERR_NONE)
        printf("%s  %s, %d picture%s in %s/\n", g.output, counted(&g), drawn, drawn == 1 ? "" : "s", g.files);
    return e->kind == ERR_NONE;
}
