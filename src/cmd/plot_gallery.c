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
#include "file/wav.h"
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
    const char *source, *title; /* title NULL: the folder's name */
    unsigned asked;
    int svg;
    bool force;
    struct cmd_call *call;
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
        bool sounds = wav_is_name(sound),
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
        const char *name = entries[i]->d_name;
        g->items[g->n++] = (struct item){.file = arena_format(g->arena, "%s%s", g->folder, name),
                                         .name = relpath_base(name, g->arena),
                                         .kind = SOUND};
        free(entries[i]);
    }
    free(entries);
    return g->n > 0 || err_set(e, ERR_SCENE, "%s: no sound (.wav) is in it", source);
}

/* ------------------------------------------------------------------ pictures */

/* A sound that cannot be drawn leaves a note on the page; what no picture could be drawn without ends all. */
static void draw_item(struct page *g, struct item *item, struct err *e)
{
    struct arena *a = arena_open();
    char *flat = arena_text(g->arena, item->name);
    for (char *p = flat; *p; p++)
        *p = *p == '/' ? '=' : *p; /* which no name of a stimulus holds */
    const char *target = arena_format(g->arena, "%s/%s.%s", g->files, flat, g->svg ? "svg" : "png");
    struct plot_page p = {.file = item->file,
                          .title = item->name,
                          .from = NAN,
                          .to = NAN,
                          .svg = g->svg,
                          .channel = 1,
                          .arena = a,
                          .call = g->call,
                          .silent = item->kind == SILENT,
                          .asked = g->asked,
                          .length = NAN};
    if (p.silent) { /* the panels that need no sound; where that leaves none of them, whatever there is */
        int k = column(g, "duration_s");
        p.asked &= ~(1u << PLOT_WAVEFORM | 1u << PLOT_SPECTROGRAM);
        if (k < 0 || !text_double(cell(g, item->row, k), &p.length)) p.length = 0; /* the manifest does not say */
    }
    struct err why = {0};
    bool ok = plot_data(&p, &why);
    if (!ok)
        item->why = arena_text(g->arena, why.text);
    else if (mark_permits(target, NULL, g->force, e) && gnuplot_write(target, p.svg, plot_draw, &p, e))
        item->picture = target;
    arena_close(a);
}

/* ------------------------------------------------------------------ the page */

static const char *html(const struct page *g, const char *text)
{
    return text_html(g->arena, text_shown(g->arena, text));
}

/* A file as the page links it: relative, what is no plain character as %XX. */
static const char *link_to(const struct page *g, const char *file)
{
    static const char plain[] = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz-_.~/+";
    const char *from = relpath_make(file, relpath_folder(g->output, g->arena), g->arena);
    char *out = arena_take(g->arena, 3 * strlen(from) + 1, 1), *to = out;
    for (const char *p = from; *p; p++)
        to += snprintf(to, 4, strchr(plain, *p) ? "%c" : "%%%02X", (unsigned char)*p);
    return out;
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
    for (int k = first + 1; first >= 0 && k < text; k++)
        fprintf(f, "<dt>%s</dt><dd>%s</dd>", html(g, g->manifest.names[k]), html(g, cell(g, item->row, k)));
    for (int i = 0; i < 5; i++) {
        int k = column(g, more[i][0]);
        double x;            /* rounded: the manifest has all digits */
        bool varies = i > 0; /* replicates, over those that have one */
        const char *one = NULL;
        for (size_t row = 0; k >= 0 && !varies && row < g->manifest.rows; row++) {
            const char *here = is_there(cell(g, row, k)) ? cell(g, row, k) : one;
            varies = one && strcmp(here, one) != 0;
            one = here;
        }
        if (k < 0 || !varies || !text_double(cell(g, item->row, k), &x)) continue;
        fprintf(f, "<dt>%s</dt><dd>", more[i][1]);
        fprintf(f, more[i][2], x);
        fputs("</dd>", f);
    }
    fputs("</dl>", f);
    if (text >= 0 && is_there(cell(g, item->row, text))) fprintf(f, "<p>%s</p>", html(g, cell(g, item->row, text)));
}

static void put_item(const struct page *g, const struct item *item, FILE *f)
{
    fprintf(f, "<figure>\n<figcaption><h2>%s</h2>", html(g, item->name));
    if (g->set) put_facts(g, item, f);
    fputs("</figcaption>\n", f);
    if (item->kind == SOUND)
        fprintf(f, "<audio controls preload=\"none\" src=\"%s\"></audio>\n", link_to(g, item->file));
    if (item->picture) {
        const char *to = link_to(g, item->picture);
        fprintf(f, "<a href=\"%s\"><img loading=\"lazy\" alt=\"plot\" src=\"%s\"></a>\n", to, to);
    } else {
        int status = g->set ? column(g, "status") : -1, error = g->set ? column(g, "error") : -1;
        bool says = !item->why && error >= 0 && is_there(cell(g, item->row, error));
        fprintf(f, "<p class=\"bad\">%s%s%s</p>\n",
                html(g, item->why     ? item->why
                        : status >= 0 ? cell(g, item->row, status)
                                      : "no sound"),
                says ? ": " : "", says ? html(g, cell(g, item->row, error)) : "");
    }
    fputs("</figure>\n", f);
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

static void put_page(const struct page *g, FILE *f)
{
    const char *title = g->title     ? g->title
                        : *g->folder ? arena_format(g->arena, "%.*s", (int)strlen(g->folder) - 1, g->folder)
                                     : "sounds";
    fputs("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n" MARK_PAGE
          "\n<meta name=\"viewport\" content=\"width=device-width\">\n<title>",
          f);
    fputs(html(g, title), f);
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
    fprintf(f, "%s</h1>\n<p>%s</p>\n<main>\n", html(g, title), counted(g));
    for (int i = 0; i < g->n; i++)
        put_item(g, &g->items[i], f);
    fputs("</main>\n</body>\n</html>\n", f);
}

int plot_gallery_run(struct cmd_call *c, struct err *e)
{
    static const char *const others[] = {"from", "to", "channel"}, *const formats[] = {"png", "svg"};
    const char *panels = args_value(&c->args, "panels"), *output = args_value(&c->args, "output");
    struct page g = {.source = c->args.operands[0],
                     .title = args_value(&c->args, "title"),
                     .force = args_given(&c->args, "force"),
                     .call = c,
                     .arena = c->arena};
    struct outfile o;
    int drawn = 0;
    for (int k = 0; k < 3; k++)
        if (args_given(&c->args, others[k]))
            err_set(e, ERR_USAGE, "--%s: not of a gallery, which shows whole sounds", others[k]);
    if (e->kind || !cmd_either(c, "format", formats, &g.svg, e)) return (int)e->kind;
    if (output && !text_ends(output, ".html"))
        err_set(e, ERR_USAGE, "--output %s: a gallery is a page of HTML, its name must end in .html", output);
    if (e->kind || !plot_panels_read(panels ? panels : "waveform,spectrogram", &g.asked, c->arena, e) || !gather(&g, e))
        return (int)e->kind;
    g.output = output ? output : arena_format(c->arena, "%sgallery.html", g.folder);
    g.files = arena_format(c->arena, "%.*s_files", (int)strlen(g.output) - 5, g.output);
    if (!mark_permits(g.output, NULL, g.force, e) || !outfile_open(&o, g.output, e)) return (int)e->kind;
    bool tells = isatty(STDERR_FILENO);
    if (mkdir(g.files, 0777) != 0 && errno != EEXIST)
        err_set(e, ERR_CREATE, "the folder %s cannot be created: %s", g.files, strerror(errno));
    for (int i = 0; i < g.n && e->kind == ERR_NONE; i++) {
        if (interrupt_seen()) {
            err_set(e, ERR_INTERRUPTED, "interrupted; the page was not written, run the same command again");
            break;
        }
        if (tells) fprintf(stderr, "\r%d of %d", i, g.n);
        if (g.items[i].kind != FAILED) draw_item(&g, &g.items[i], e);
        drawn += g.items[i].picture != NULL;
    }
    if (tells) fputs("\r\033[K", stderr);
    if (e->kind == ERR_NONE) {
        put_page(&g, o.stream);
        outfile_commit(&o, e);
    }
    outfile_drop(&o);
    if (e->kind == ERR_NONE)
        printf("%s  %s, %d picture%s in %s/\n", g.output, counted(&g), drawn, drawn == 1 ? "" : "s", g.files);
    return (int)e->kind;
}
