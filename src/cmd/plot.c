/* rasp plot: a picture of a render. */
#include "cmd/plot.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cmd/cmd.h"
#include "output/picture.h"

static const struct args_option plot_options[] = {
    {"output", 'o', "FILE", false, "where to write; default: NAME.png beside NAME.wav, or NAME.svg"},
    {"format", 'f', "png|svg", false, "format of the picture; default: by the output's ending, else png"},
    {"title", 't', "TEXT", false, "title; default: the scene's, if its summary lies beside the sound, else the file's name"},
    {"from", 0, "SECONDS", false, "start of the time shown; default: 0"},
    {"channel", 'c', "N", false, "which channel of the sound, from 1 (of several listening places each is one); default: 1"},
    {"to", 0, "SECONDS", false, "end of the time shown; default: the end of the sound"},
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

static void plot_page(void *self, struct gnuplot *g)
{
    plot_draw(self, g);
}

static int plot_run(struct cmd_call *c, struct err *e)
{
    struct plot_page p = {.file = c->args.operands[0], .title = args_value(&c->args, "title"), .from = NAN, .to = NAN, .arena = c->arena};
    const double range[2] = {0, 1e9};
    long channel = 1;
    if (!ends(p.file, ".wav") && !ends(p.file, ".csv"))
        return err_set(e, ERR_USAGE, "%s: neither a sound (.wav) nor a table of diagnostics (.csv)", p.file), (int)e->kind;
    if (!plot_format(c, &p, e) || !args_number(&c->args, "from", range, &p.from, e) || !args_number(&c->args, "to", range, &p.to, e) ||
        !args_whole(&c->args, "channel", (const long[2]){1, 1024}, &channel, e))
        return (int)e->kind;
    p.channel = (int)channel;
    const char *target = plot_target(c, &p);
    if (!plot_data(&p, e) || !picture_write(target, p.svg, plot_page, &p, e))
        return (int)e->kind;
    printf("%s ", target);
    plot_draw_list(&p, stdout);
    return 0;
}

const struct command plot_command = {
    .name = "plot",
    .summary = "draws a render: waveform, spectrogram, forces",
    .does = "For NAME.wav writes NAME.png: the waveform, the spectrogram (Hann window of 20 ms, the 80 dB below the loudest place, up to 20 kHz) "
            "and, from the diagnostics beside it (NAME.csv, or NAME.CONTACT.csv), the contact force and the normal force with alpha, on one time "
            "axis. A table that is not of the same render, as the hashes in NAME.json tell, is left out with a warning; without NAME.json it is "
            "taken to be. Panels without data are left out; what was drawn is printed. For NAME.csv, of a render without sound, only the forces. Of "
            "several channels one is drawn. Needs gnuplot.",
    .operands = "NAME.wav|NAME.csv",
    .least = 1,
    .most = 1,
    .options = plot_options,
    .examples = "rasp plot out/basswood_scrape.wav\n"
                "rasp plot out/basswood_scrape.wav -o stroke.svg --from 0.25 --to 0.5\n"
                "rasp plot out/forces_only.csv\n",
    .run = plot_run,
};
