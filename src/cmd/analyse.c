/* rasp analyse: the impacts in a force, their statistics, and the scene part that draws impacts like them. */
#include "cmd/analyse.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "analysis/frequency_polygon.h"
#include "base/interrupt.h"
#include "cmd/cmd.h"

const char *const analyse_series_names[STATISTICS_SERIES] = {"amplitude", "interval"};

void analyse_note(struct analysis *a, const char *format, ...)
{
    char text[600];
    va_list list;
    if (a->n_notes == ANALYSE_NOTES)
        return;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    a->notes[a->n_notes++] = arena_text(a->arena, text);
}

bool analyse_tabled(const struct analysis *a, int series)
{
    const struct series_statistics *s = &a->statistics.series[series];
    return !s->flat && a->distribution != ANALYSE_GAUSSIAN &&
           (a->distribution == ANALYSE_TABLE || frequency_polygon_needed(s->white.gaussian_distance, a->statistics.n - 1));
}

bool analyse_one_process(const struct analysis *a)
{
    return a->statistics.one_process >= STATISTICS_ONE_PROCESS;
}

/* ------------------------------------------------------------------ duration */

/* Where theta comes from, in this order: --theta; --single; the impacts of the series that stand alone. */
static bool theta_find(struct cmd_call *c, struct analysis *a, struct err *e)
{
    struct impact_duration *d = &a->duration;
    *d = (struct impact_duration){.theta = NAN, .theta_error = NAN, .theta_single = NAN, .zeta_single = NAN, .r2_single = NAN, .r2_single_log = NAN};
    a->theta = ANALYSE_THETA_GIVEN;
    if (args_given(&c->args, "theta"))
        return args_number(&c->args, "theta", (const double[2]){0, 2}, &d->theta, e);
    a->theta = ANALYSE_THETA_FILE;
    if (a->single.file)
        return impact_duration_single(&a->single.found.events, true, d) ||
               err_set(e, ERR_SCENE, "%s: %ld impact%s alone; theta takes at least %d, of different amplitudes", a->single.file, d->singles,
                       d->singles == 1 ? " stands" : "s stand", IMPACT_DURATION_LEAST);
    a->theta = ANALYSE_THETA_ALONE;
    if (impact_duration_single(&a->source.found.events, true, d))
        return true;
    a->theta = ANALYSE_THETA_NONE;
    d->theta = 0;
    return true;
}

/* A law that does not hold gives way to a constant, the durations' median; so does a theta of 0, which is one, unless all durations are alike. A theta that was
   asked for stays. */
static void constant_instead(struct analysis *a)
{
    struct impact_duration *d = &a->duration;
    double r2 = d->r2_log, theta = d->theta;
    bool given = a->theta == ANALYSE_THETA_GIVEN, few = d->n < IMPACT_DURATION_MANY;
    a->constant = !given && (a->theta == ANALYSE_THETA_NONE || few || (theta > 0 ? r2 < 0 : !isnan(r2)));
    if (a->constant)
        impact_duration_constant(&a->source.found.events, a->arena, d);
    const char *taken = given ? "and zeta means little" : "so the median is taken for all, and theta as 0";
    if (a->theta == ANALYSE_THETA_NONE)
        analyse_note(a, "too few impacts stand alone, or amplitudes are all alike, to tell how durations depend on them: the median is taken for all, and theta as 0. "
                        "Single impacts (--single) help, or --theta");
    else if (few)
        analyse_note(a, "the duration of only %ld of %d impacts is known, where %d tell a law, %s", d->n, a->source.found.events.n, IMPACT_DURATION_MANY, taken);
    else if (a->constant && theta > 0)
        analyse_note(a, "theta %.3g does not hold here (R2 of the logarithm %.4g: a constant does better), %s", theta, r2, taken);
}

static bool duration_find(struct cmd_call *c, struct analysis *a, struct err *e)
{
    struct impact_duration *d = &a->duration;
    if (!theta_find(c, a, e))
        return false;
    if (d->theta < -0.01 && d->theta < -2 * d->theta_error)
        analyse_note(a, "stronger impacts last longer here (theta %.3g); a scene's theta is 0 or more, and 0 is taken", d->theta);
    d->theta = fmax(d->theta, 0);
    a->lasts = impact_duration_series(&a->source.found.events, d);
    if (!a->lasts)
        analyse_note(a, "no duration is known: %s", analyse_notes_unknown(a));
    else
        constant_instead(a);
    if (a->lasts && !a->constant && d->theta > 0 && d->r2 < -0.05)
        analyse_note(a, "theta %.3g does not hold here (R2 %.4g: a constant duration would do better). Where outliers made it, as impacts that run into each other "
                        "do, single impacts (--single) help, or --theta", d->theta, d->r2);
    return true;
}

/* ------------------------------------------------------------------ the command */

static bool find_options(struct cmd_call *c, struct analysis *a, struct err *e)
{
    struct analyse_given *g = &a->given;
    static const char *const words[] = {"auto", "gaussian", "table", NULL};
    static const double positive[2] = {1e-300, 1e300}, rates[2] = {1, 1e9}, share[2] = {0, 1}, quiet[2] = {1e-6, 0.1};
    const char *distribution = args_value(&c->args, "distribution");
    *g = (struct analyse_given){.scale = NAN, .rate = NAN, .channel = 1, .column = args_value(&c->args, "column"), .options = impact_find_options};
    g->options.both = args_given(&c->args, "signed");
    for (a->distribution = 0; distribution && words[a->distribution] && strcmp(words[a->distribution], distribution) != 0;)
        a->distribution++;
    if (!words[a->distribution])
        return err_set(e, ERR_USAGE, "--distribution: '%s' is not auto, gaussian or table", distribution);
    return args_number(&c->args, "scale", positive, &g->scale, e) && args_number(&c->args, "rate", rates, &g->rate, e) &&
           args_whole(&c->args, "channel", (const long[2]){1, 1024}, &g->channel, e) &&
           args_number(&c->args, "threshold", share, &g->options.threshold, e) &&
           args_number(&c->args, "prominence", share, &g->options.prominence, e) && args_number(&c->args, "silence", quiet, &g->options.quiet, e);
}

/* Is there a file of that kind, or, of NULL, one with a force? */
static bool kind_read(const struct analysis *a, const char *kind)
{
    const struct analyse_source *s[2] = {&a->source, &a->single};
    for (int i = 0; i < 2; i++)
        if (s[i]->file && s[i]->has_force && (!kind || strcmp(s[i]->kind, kind) == 0))
            return true;
    return false;
}

/* An option that no file has a use for is an error. */
static bool options_used(struct cmd_call *c, const struct analysis *a, struct err *e)
{
    static const char *const options[][2] = {{"rate", "NPY"}, {"channel", "WAV"}, {"column", "CSV"}, {"scale", NULL}, {"threshold", NULL},
                                             {"prominence", NULL}, {"silence", NULL}, {"signed", NULL}};
    for (size_t i = 0; i < sizeof options / sizeof *options; i++)
        if (args_given(&c->args, options[i][0]) && !kind_read(a, options[i][1]))
            return err_set(e, ERR_USAGE, "--%s means nothing for %s, which is read as %s%s", options[i][0], a->source.file, a->source.kind,
                           a->source.has_force ? "" : " of impacts");
    return true;
}

static bool single_read(struct cmd_call *c, struct analysis *a, struct err *e)
{
    const char *file = args_value(&c->args, "single");
    if (!file)
        return true;
    if (args_given(&c->args, "theta"))
        return err_set(e, ERR_USAGE, "--single and --theta: give one of them");
    return analyse_read(file, &a->given, a->arena, &a->single, e);
}

static bool analyse_all(struct cmd_call *c, struct analysis *a, struct err *e)
{
    if (!find_options(c, a, e) || !analyse_read(c->args.operands[0], &a->given, a->arena, &a->source, e) || !single_read(c, a, e) ||
        !options_used(c, a, e))
        return false;
    if (a->source.has_force)
        analyse_notes_force(a, &a->source);
    if (a->single.file && a->single.has_force)
        analyse_notes_force(a, &a->single);
    analyse_notes_outlier(a);
    if (!duration_find(c, a, e))
        return false;
    if (a->source.has_force)
        impact_shape_make(&a->source.signal, &a->source.found, a->arena, &a->shape);
    analyse_notes_shape(a);
    a->counted = a->source.found.events.n >= STATISTICS_LEAST;
    if (!a->counted)
        analyse_note(a, "%d impact%s: statistics of the series take at least %d, and are left out", a->source.found.events.n, a->source.found.events.n == 1 ? "" : "s",
                     STATISTICS_LEAST);
    else if (impact_statistics_make(&a->source.found.events, !args_given(&c->args, "keep-modulation"), a->arena, &a->statistics, e))
        analyse_notes_statistics(a);
    else
        return err_at(e, "%s", a->source.file);
    return true;
}

static bool plot_format(struct cmd_call *c, bool *svg, struct err *e)
{
    const char *format = args_value(&c->args, "format");
    *svg = format && strcmp(format, "svg") == 0;
    return !format || *svg || strcmp(format, "png") == 0 || err_set(e, ERR_USAGE, "--format: '%s' is neither png nor svg", format);
}

/* All that is written is complete before any of it gets its name. */
static bool analyse_write(struct cmd_call *c, struct analysis *a, bool svg, struct err *e)
{
    struct analyse_files *all = ARENA_TAKE(a->arena, struct analyse_files, 1);
    const char *output = args_value(&c->args, "output"), *plot = args_value(&c->args, "plot");
    if (!output && !plot)
        return true;
    if (!a->counted)
        return err_set(e, ERR_SCENE, "%s: %d impact%s; statistics, of which --output and --plot are made, take at least %d", a->source.file, a->source.found.events.n,
                       a->source.found.events.n == 1 ? "" : "s", STATISTICS_LEAST);
    if (output)
        analyse_part(a, output, all, e);
    if (plot && e->kind == ERR_NONE)
        analyse_plot(a, plot, svg, all, e);
    for (int i = 0; e->kind == ERR_NONE && i < all->n; i++)
        outfile_settle(&all->o[i], e);
    interrupt_hold();
    for (int i = 0; e->kind == ERR_NONE && i < all->n; i++)
        if (outfile_commit(&all->o[i], e))
            a->written[a->n_written++] = all->name[i];
    interrupt_go();
    for (int i = 0; i < all->n; i++)
        outfile_drop(&all->o[i]);
    return e->kind == ERR_NONE;
}

/* The report is printed even where a file cannot be written. */
static int analyse_run(struct cmd_call *c, struct err *e)
{
    struct analysis *a = ARENA_TAKE(c->arena, struct analysis, 1);
    const char *output = args_value(&c->args, "output");
    bool json = args_given(&c->args, "json"), svg;
    a->arena = c->arena;
    a->force = args_given(&c->args, "force");
    if (!plot_format(c, &svg, e) || (output && !analyse_part_free(a, output, e)) || !analyse_all(c, a, e))
        return (int)e->kind;
    analyse_write(c, a, svg, e);
    if (!json)
        analyse_print(a);
    else if (!analyse_json(a, e))
        return (int)e->kind;
    return (int)e->kind;
}

static const struct args_option analyse_options[] = {
    {"scale", 0, "NEWTONS", false, "newtons that a unit of the file stands for (full scale of a WAV of integers); a WAV needs it, else 1"},
    {"rate", 0, "HZ", false, "samples per second of an NPY"},
    {"channel", 0, "N", false, "channel of a WAV, from 1; default: 1"},
    {"column", 0, "NAME", false, "column of a CSV with the force; default: force_n, else force_mean_n"},
    {"threshold", 0, "SHARE", false, "least force of an impact, as a share of the greatest; default: 0.001"},
    {"prominence", 0, "SHARE", false,
     "how much a maximum must rise above the valleys beside it, as a share of the greatest force within 24 samples; default: 0.02"},
    {"silence", 0, "SHARE", false, "share of an impact's force that counts as 0: whether it stands alone; default: 0.01"},
    {"signed", 0, NULL, false, "impacts in both directions (rubbing and scratching): maxima of the force's magnitude"},
    {"single", 0, "FILE", false, "single impacts (a bounce train, say), from which theta is taken; read with the same options"},
    {"theta", 0, "NUMBER", false, "theta of zeta A^-theta; default: from --single, else from the impacts that stand alone"},
    {"keep-modulation", 0, NULL, false, "amplitudes as they are: a modulation is neither looked for nor taken out"},
    {"distribution", 0, "auto|gaussian|table", false,
     "of the whitened series in the parameter file; default: auto, a table where it is not normal"},
    {"output", 'o', "FILE.yaml", false, "writes the parameter file, and tables beside it where they are needed"},
    {"force", 'f', NULL, false, "replaces what exists of FILE.yaml, the tables beside it, and the plots"},
    {"plot", 0, "PREFIX", false, "draws PREFIX.correlations.png, .distributions.png, .duration.png and .shape.png; a folder: its files are called as FILE is"},
    {"format", 0, "png|svg", false, "format of the plots; default: png"},
    {"json", 'j', NULL, false, "prints the figures as one JSON object; null stands for one that is not there"},
    {0},
};

const struct command analyse_command = {
    .name = "analyse",
    .summary = "impacts in a force: their statistics, and a scene part that draws impacts like them",
    .does = "Finds the impacts in a force (a WAV, a one-dimensional NPY, or a CSV with time_s and a column of newtons, such as diagnostics at the sample rate), or "
            "takes them from a table (CSV with time_s, amplitude_n and maybe duration_s, as output.impacts writes it). Prints what papers/002 estimates of their "
            "amplitudes and of the times between them, with 95 % intervals: means, ARMA(1,1) filters, the whitened series and their distributions, whether one "
            "process drives both, a modulation; how durations depend on amplitudes, in 002's two steps; which shape impacts have (raised cosine, Meixner window); "
            "and what makes the estimates doubtful. Draws that were raised to a floor bias means (too high) and deviations (too small): they are told in a table of impacts, "
            "but in a force, where weak impacts close together merge, mostly not. In a series of a long tail (marginal lognormal, rough) a slight modulation may be found where "
            "there is none: --keep-modulation leaves it. "
            "The parameter file is a scene part with contact.model impacts: a scene that includes it draws other impacts of the amplitudes, intervals and durations found. "
            "How near it comes depends on how well the force is a series of impacts: bounces are, a contact that never parts is not, and the notes say so. "
            "The force should be whole: what output.ramp, load.approach or load.release fade is weaker but no longer, and theta comes out too small.",
    .operands = "FILE",
    .least = 1,
    .most = 1,
    .options = analyse_options,
    .examples = "rasp analyse out/bouncing.wav --scale 10 -o out/rolling_part.yaml\n"
                "rasp analyse out/rolling.impacts.csv --plot out/\n"
                "rasp analyse rolling.csv --single bounces.csv --json\n",
    .run = analyse_run,
};
