/* rasp plot: a picture of a render or mode table, or a page of pictures of many. */
#include "cmd/plot.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cmd/cmd.h"
#include "output/mark.h"
#include "output/picture.h"
#include "pipeline/outputs.h"
#include "scene/scene_read.h"

static const struct args_option plot_options[] = {
    {"output", 'o', "FILE", false, "where to write; default: NAME.png beside NAME.wav, or NAME.svg; of a gallery gallery.html in the folder"},
    {"panels", 'p', "PANEL,...", false, "which of waveform, spectrogram, force, normal, motion, modes and decays; default: all that there are data for, of a gallery waveform and spectrogram of what has a sound"},
    {"gallery", 'g', NULL, false, "a page of HTML for a folder of renders, or for the manifest.csv of a set: a picture, the sound and the factors of each"},
    {"format", 'f', "png|svg", false, "format of the picture; default: by the output's ending, else png"},
    {"title", 't', "TEXT", false, "title; default: the file's name and the scene's title, if its summary lies beside the sound, else the file's name"},
    {"from", 0, "SECONDS", false, "start of the time shown; default: 0"},
    {"channel", 'c', "N", false, "which channel of the sound, from 1 (of several listening places each is one); default: 1"},
    {"to", 0, "SECONDS", false, "end of the time shown; default: the end of the sound"},
    {"force", 0, NULL, false, "replaces a file that rasp did not draw, or writes through a link"},
    {0},
};

static bool ends(const char *text, const char *ending)
{
    size_t n = strlen(text), m = strlen(ending);
    return n > m && strcmp(text + n - m, ending) == 0;
}

static bool plot_format(struct cmd_call *c, struct plot_page *p, struct err *e)
{
    const char *format = args_value(&c->args, "format"), *o = args_value(&c->args, "output");
    if (format && strcmp(format, "png") != 0 && strcmp(format, "svg") != 0)
        return err_set(e, ERR_USAGE, "--format: '%s' is neither png nor svg", format);
    if (o && !ends(o, ".png") && !ends(o, ".svg"))
        return err_set(e, ERR_USAGE, "--output %s: must end in .png or .svg", o);
    if (format && o && strcmp(o + strlen(o) - 3, format) != 0)
        return err_set(e, ERR_USAGE, "--output %s: does not end in .%s, the format that is asked for", o, format);
    p->svg = format ? strcmp(format, "svg") == 0 : o && ends(o, ".svg");
    return true;
}

static const char *plot_target(struct cmd_call *c, const struct plot_page *p)
{
    const char *o = args_value(&c->args, "output");
    return o ? o : arena_format(c->arena, "%.*s.%s", (int)strlen(p->file) - 4, p->file, p->svg ? "svg" : "png");
}

/* Nor of the sound, or what lies beside it. */
static bool plot_spares_drawn(const struct plot_page *p, const char *target, const struct stat *t, struct err *e)
{
    static const char *const endings[] = {".wav", ".csv", ".npy", ".json", ".scene.yaml"};
    struct stat s;
    for (int i = 0; i < 5; i++) {
        const char *file = arena_format(p->arena, "%.*s%s", (int)strlen(p->file) - 4, p->file, endings[i]);
        if (stat(file, &s) == 0 && s.st_dev == t->st_dev && s.st_ino == t->st_ino)
            return err_set(e, ERR_CREATE, "%s: the picture would overwrite %s, which it shows; write elsewhere: -o OTHER.png", target, file);
    }
    return true;
}

/* A picture takes the place of no file that the sound was made from. */
static bool plot_spares(const struct plot_page *p, const char *target, struct err *e)
{
    struct scene scene;
    struct stat t;
    struct err unreadable = {0};
    const char *effective = arena_format(p->arena, "%.*s.scene.yaml", (int)strlen(p->file) - 4, p->file), *messages;
    int n = 0;
    const struct outputs_source *sources = NULL;
    if (stat(target, &t) != 0)
        return true;
    if (!plot_spares_drawn(p, target, &t, e))
        return false;
    if (access(effective, F_OK) == 0 && scene_read(effective, NULL, p->arena, &scene, &messages, &unreadable))
        sources = outputs_sources(&scene, &n, p->arena);
    for (int i = 0; i < n; i++)
        if (sources[i].device == t.st_dev && sources[i].inode == t.st_ino)
            return err_set(e, ERR_CREATE, "%s: the picture would overwrite an input of %s (%s); write elsewhere: -o OTHER.png", target, effective, sources[i].what);
    return true;
}

static void plot_page(void *self, struct gnuplot *g)
{
    plot_draw(self, g);
}

static int gallery_run(struct cmd_call *c, struct err *e)
{
    const char *format = args_value(&c->args, "format"), *panels = args_value(&c->args, "panels");
    struct plot_gallery g = {.source = c->args.operands[0], .output = args_value(&c->args, "output"), .title = args_value(&c->args, "title"), .arena = c->arena, .call = c,
                             .svg = format && !strcmp(format, "svg"), .force = args_given(&c->args, "force")};
    static const char *const others[] = {"from", "to", "channel"};
    for (int k = 0; k < 3; k++)
        if (args_given(&c->args, others[k]))
            return err_set(e, ERR_USAGE, "--%s: not of a gallery, which shows whole sounds", others[k]), (int)e->kind;
    if (format && strcmp(format, "png") != 0 && !g.svg)
        err_set(e, ERR_USAGE, "--format: '%s' is neither png nor svg", format);
    else if (g.output && !ends(g.output, ".html"))
        err_set(e, ERR_USAGE, "--output %s: a gallery is a page of HTML, its name must end in .html", g.output);
    else if (plot_panels_read(panels ? panels : "waveform,spectrogram", &g.asked, c->arena, e))
        plot_gallery(&g, e);
    return (int)e->kind;
}

static int plot_run(struct cmd_call *c, struct err *e)
{
    struct plot_page p = {.file = c->args.operands[0], .title = args_value(&c->args, "title"), .from = NAN, .to = NAN, .arena = c->arena, .call = c};
    const double range[2] = {0, 1e9};
    long channel = 1;
    if (args_given(&c->args, "gallery"))
        return gallery_run(c, e);
    if (!ends(p.file, ".wav") && !ends(p.file, ".csv") && !ends(p.file, ".npy"))
        return err_set(e, ERR_USAGE, "%s: neither a sound (.wav) nor a table of diagnostics (.csv, .npy) or modes (.csv); of a folder --gallery makes a page", p.file), (int)e->kind;
    if (!plot_format(c, &p, e) || !plot_panels_read(args_value(&c->args, "panels"), &p.asked, c->arena, e) || !args_number(&c->args, "from", range, &p.from, e) || !args_number(&c->args, "to", range, &p.to, e) ||
        !args_whole(&c->args, "channel", (const long[2]){1, 1024}, &channel, e))
        return (int)e->kind;
    p.channel = (int)channel;
    const char *target = plot_target(c, &p);
    if (!plot_data(&p, e) || !plot_spares(&p, target, e) || !mark_permits(target, NULL, args_given(&c->args, "force"), e) || !picture_write(target, p.svg, plot_page, &p, e))
        return (int)e->kind;
    printf("%s ", target);
    plot_panels_list(&p, stdout);
    return 0;
}

const struct command plot_command = {
    .name = "plot",
    .summary = "draws a render: waveform, spectrogram, forces, motion, modes",
    .does = "For NAME.wav writes NAME.png: the waveform, the spectrogram (Hann window of 20 ms, the 80 dB below the loudest place, up to 20 kHz) "
            "and, from the diagnostics beside it (NAME.csv, NAME.npy, or NAME.CONTACT.csv), the contact force and the normal force with alpha, on one time "
            "axis; below them the way of the contact from above, coloured by speed, and the modes of what rings (NAME.scene.yaml): stems of their largest gain on that way, coloured by "
            "their time of decay. A table that is not of the same render, as the hashes in NAME.json tell, is left out with a warning; without NAME.json it is "
            "taken to be. Panels without data are left out; what was drawn is printed. For NAME.csv or NAME.npy, of a render without sound, what the table has; a mode table gives the modes, and "
            "their decays over frequency. Of several channels one is drawn. Needs gnuplot.\n"
            "With --gallery the operand is a folder that rasp batch made, or its manifest.csv, or any folder of sounds. The page shows every stimulus, with its factors, and plays it (of what has no sound: contact and normal force and motion), or says why it failed; it needs no "
            "script, and nothing from elsewhere. Its pictures are drawn anew, into a folder beside it: gallery_files/ of gallery.html. Sounds are linked where they are.",
    .operands = "NAME.wav|NAME.csv|NAME.npy|FOLDER/|manifest.csv",
    .least = 1,
    .most = 1,
    .options = plot_options,
    .examples = "rasp plot out/basswood_scrape.wav\n"
                "rasp plot out/basswood_scrape.wav -o stroke.svg --from 0.25 --to 0.5\n"
                "rasp plot out/basswood_scrape.wav --panels motion,modes -o plan.svg\n"
                "rasp plot out/forces_only.csv\n"
                "rasp plot irs/basswood_plank.csv -o plank.png\n"
                "rasp plot --gallery out/ -o out/gallery.html\n",
    .run = plot_run,
};
