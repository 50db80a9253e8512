/* rasp decompose RECORDING... -o FOLDER: a recording of rolling or scraping as modes, a source, and its impacts; a
   scene of them (analysis/source_filter.h). Of a recording longer than a minute the loudest minute is taken. */
#include "cmd/decompose.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/outfile.h"
#include "base/text.h"
#include "file/wav.h"
#include "response/mode_table.h"

static const double minute = 60;    /* s that are taken at most */
static const double chunk = 1;      /* s, by which the loudest part is looked for */
static const double shortest = 0.1; /* s of a recording */

static void __attribute__((format(printf, 2, 3))) note(struct decompose *d, const char *format, ...)
{
    va_list list;
    char text[600];
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    if (d->notes < DECOMPOSE_NOTES) d->note[d->notes++] = arena_text(d->arena, text);
}

/* ------------------------------------------------------------------ reading */

/* Energies of each second of the channel. */
static bool seconds_of(struct decompose *d, struct wav_stream *w, double **energy, long *n, struct err *e)
{
    long each = (long)(chunk * w->rate), got, at = 0;
    double *x = ARENA_TAKE(d->arena, double, each * w->channels);
    *n = w->frames / each + 1;
    *energy = ARENA_TAKE(d->arena, double, *n);
    for (;; at++) {
        if (!wav_stream_read(w, x, each, &got, e)) return false;
        for (long i = 0; i < got && at < *n; i++)
            (*energy)[at] += x[i * w->channels + d->channel - 1] * x[i * w->channels + d->channel - 1];
        if (got == 0) return true;
    }
}

/* The part that is taken: of the options, else the whole, else the loudest minute. */
static bool part_of(struct decompose *d, const double *energy, long n, struct err *e)
{
    double from = NAN, until = NAN;
    if (!cmd_quantity(d->c, "from", KEY_TIME, &from, e) || !cmd_quantity(d->c, "until", KEY_TIME, &until, e))
        return false;
    d->begin = isnan(from) ? 0 : from;
    d->seconds = fmin(isnan(until) ? HUGE_VAL : until, d->whole) - d->begin;
    if (!(d->begin >= 0) || !(d->seconds >= shortest))
        return err_set(e, isnan(from) && isnan(until) ? ERR_SCENE : ERR_USAGE,
                       "%s: %.3g s are too short to tell modes and impacts; %.3g s are the least%s", d->shown,
                       fmax(d->seconds, 0), shortest, isnan(from) && isnan(until) ? "" : " (--from, --until)");
    if (d->seconds <= minute) return true;
    long width = (long)(minute / chunk), first = (long)(d->begin / chunk), best = first,
         last = (long)((d->begin + d->seconds) / chunk) - width;
    double most = -1;
    for (long k = first; k <= last && k + width <= n; k++) {
        double sum = 0;
        for (long i = k; i < k + width; i++)
            sum += energy[i];
        if (sum > most) best = k;
        most = fmax(most, sum);
    }
    d->begin = fmax(d->begin, (double)best * chunk);
    d->seconds = minute;
    note(d, "of %.4g s the loudest minute is taken, from %.4g s on (--from, --until: another part)", d->whole,
         d->begin);
    return true;
}

/* Runs of three samples and more that stand at the greatest value. */
static void clipping(struct decompose *d)
{
    double top[2] = {0, 0};
    long runs = 0, length = 0;
    for (long i = 0; i < d->n; i++) {
        top[0] = fmax(top[0], d->x[i]);
        top[1] = fmin(top[1], d->x[i]);
    }
    for (long i = 0; i < d->n; i++) {
        length = d->x[i] == top[0] || d->x[i] == top[1] ? length + 1 : 0;
        runs += length == 3;
    }
    if (runs > 5)
        note(d,
             "the recording stands still at its greatest value %ld times: it clips, and how strong those impacts were "
             "is "
             "lost",
             runs);
}

static bool take(struct decompose *d, struct err *e)
{
    struct wav_stream w;
    double *energy;
    long seconds;
    if (!wav_stream_open(&w, d->file, e)) return false;
    d->rate = w.rate;
    d->channels = w.channels;
    d->whole = (double)w.frames / w.rate;
    bool ok = d->channel <= w.channels ||
              err_set(e, ERR_USAGE, "--channel: %s has %d channel%s", d->shown, w.channels, w.channels == 1 ? "" : "s");
    ok = ok && seconds_of(d, &w, &energy, &seconds, e) && part_of(d, energy, seconds, e);
    wav_stream_close(&w);
    if (!ok || !wav_stream_open(&w, d->file, e)) return false;
    long skip = (long)rint(d->begin * d->rate), at = 0, got = 1, each = (long)(chunk * w.rate);
    double *x = ARENA_TAKE(d->arena, double, each *w.channels);
    d->n = (long)rint(d->seconds * d->rate);
    d->n = d->n < (long)w.frames - skip ? d->n : (long)w.frames - skip;
    d->x = ARENA_TAKE(d->arena, double, d->n);
    while (ok && got > 0 && at < skip + d->n) {
        ok = wav_stream_read(&w, x, each, &got, e);
        for (long i = 0; ok && i < got; i++)
            if (at + i >= skip && at + i < skip + d->n) {
                d->x[at + i - skip] = x[i * w.channels + d->channel - 1];
                if (!isfinite(d->x[at + i - skip])) {
                    ok = err_set(e, ERR_SCENE, "%s: frame %ld is not a number: the file is damaged", d->shown, at + i);
                    break;
                }
            }
        at += got;
    }
    wav_stream_close(&w);
    double mean = 0, loud = 0;
    for (long i = 0; ok && i < d->n; i++)
        mean += d->x[i] / (double)d->n;
    for (long i = 0; ok && i < d->n; i++)
        loud = fmax(loud, fabs(d->x[i] -= mean));
    if (ok && loud <= 1e-12 * fabs(mean))
        ok = err_set(e, ERR_SCENE, "%s: silent: every sample of channel %ld is %.3g", d->shown, d->channel, mean);
    if (ok && w.channels > 1 && !args_given(&d->c->args, "channel"))
        note(d, "of %d channels the first is taken (--channel: another)", w.channels);
    if (ok) clipping(d);
    return ok;
}

/* The modes of a table, at its first place. */
static bool table_modes(struct decompose *d, struct source_filter_mode **mode, int *n, struct err *e)
{
    struct mode_table t;
    if (!mode_table_read(d->table, d->arena, &t, e)) return false;
    if (t.places > 1)
        note(d, "%s has %zu places: the modes are those at the first, where its gains belong", d->table, t.places);
    *mode = ARENA_TAKE(d->arena, struct source_filter_mode, t.modes + 1);
    *n = 0;
    for (size_t k = t.first[0]; k < t.first[1]; k++) {
        const struct mode_slope *s = &t.entry[k].slope[0];
        if (t.entry[k].frequency < d->options.low || t.entry[k].frequency > d->options.high || s->gain == 0) continue;
        cplx a = {s->gain * real_cos(s->phase), s->gain * real_sin(s->phase)},
             pole = {-s->decay, 2 * REAL_PI * t.entry[k].frequency};
        if (t.quantity == MODES_ACCELERATION) d->options.direct += d->rate * cplx_div(a, pole).im; /* modes_direct */
        (*mode)[(*n)++] = (struct source_filter_mode){
            .frequency = t.entry[k].frequency, .decay = s->decay, .frequency_se = NAN, .decay_se = NAN, .gain = a};
    }
    return *n > 0 ||
           err_set(e, ERR_SCENE, "%s: no mode lies from %.6g to %.6g Hz", d->table, d->options.low, d->options.high);
}

/* ------------------------------------------------------------------ what it says */

/* The lag, 1 to 60 ms, after which most impacts are followed by another: of a reflection. */
static void echo(struct decompose *d)
{
    enum { LAGS = 240 };
    static const double width = 0.25e-3, first = 1e-3; /* s */
    const struct impact_events *v = &d->found.impacts;
    double share[LAGS + 2] = {0}, weaker[LAGS + 2] = {0}, most = 0, chance = v->n / d->seconds * 2 * width;
    int at = 0;
    for (int i = 0; i < v->n; i++)
        for (int k = i + 1; k < v->n && v->time[k] - v->time[i] < LAGS * width; k++) {
            int lag = (int)((v->time[k] - v->time[i]) / width);
            for (int q = lag; q <= lag + 1; q++) { /* each bin with its neighbour */
                share[q] += 1.0 / v->n;
                weaker[q] += fabs(v->amplitude[k] / v->amplitude[i]);
            }
        }
    for (int q = (int)(first / width); q < LAGS; q++)
        if (share[q] > most) most = share[at = q];
    bool follows =
        v->n >= 10 && most > 0.4 && most > 6 * chance && weaker[at] < 0.7 * most * v->n; /* none is as strong */
    d->echo = follows ? at * width : NAN;
    if (!isnan(d->echo))
        note(d,
             "%.0f %% of the impacts are followed by another %.3g ms later, %.0f dB weaker: a reflection of the room, "
             "or "
             "what bounces each time; such impacts are counted twice, and intervals come out too short",
             100 * most, 1e3 * d->echo, -20 * real_log10(weaker[at] / (most * v->n)));
}

/* What the modes leave of the free frames, beside all of them. */
static void judge(struct decompose *d)
{
    const struct source_filter *f = &d->found;
    d->fits = f->onsets > 0 && !d->table ? f->fits : NAN;
    if (f->correlated)
        note(d, "impacts that are alike give little of the recording: modes are those of its autocorrelation, "
                "which takes "
                "the force for white noise; frequencies and decays have no intervals, and gains no phases");
    else if (!d->table && f->longest < 0.05)
        note(d,
             "the object rings freely for %.3g ms at most: modes nearer to each other than %.0f Hz are one, and slow "
             "decays are guesses",
             1e3 * f->longest, 1 / f->longest);
    if (!isnan(f->reflected))
        note(d,
             "a reflection follows each impact by %.3g ms, %.0f dB weaker: modes are of what rings from %.3g ms on, "
             "where "
             "those that decay fast and neighbours are guesses; the room is in what the scene plays",
             1e3 * f->reflected, -20 * real_log10(f->reflection), 1e3 * f->free);
    if (d->fits < 0.5 && !f->correlated)
        note(
            d,
            "impacts and their ringing are only %.0f %% of the recording: noise, speech, or more than one object; what "
            "follows means little",
            100 * d->fits);
    int n = f->impacts.n;
    if (n < STATISTICS_LEAST && d->source != DECOMPOSE_FORCE)
        note(d, "%d impact%s: statistics take at least %d, so the scene has the force itself", n, n == 1 ? "" : "s",
             STATISTICS_LEAST);
    else if (f->struck < 0.5 && d->source == DECOMPOSE_AUTO)
        note(d,
             "impacts are only %.0f %% of the source's energy: the contact does not break, so the scene has the force "
             "itself "
             "(--source impacts draws impacts all the same)",
             100 * f->struck);
    d->impacts =
        n >= STATISTICS_LEAST && (d->source == DECOMPOSE_IMPACTS || (d->source == DECOMPOSE_AUTO && f->struck >= 0.5));
    if (d->impacts && d->options.method == SOURCE_FILTER_LEE)
        note(d,
             "impacts are drawn for the modes' mean gains; with the filter that changes, the force is played as it was "
             "(force.yaml)");
}

/* Impacts as raised cosines of two samples: what they last is in the gains. */
static bool series(struct decompose *d, struct err *e)
{
    struct impact_events *v = &d->found.impacts;
    struct analysis *a = d->series = ARENA_TAKE(d->arena, struct analysis, 1);
    d->lasts = 2 / d->rate;
    for (int k = 0; k < v->n; k++) {
        v->time[k] += d->begin;
        v->amplitude[k] *= 2 / d->lasts;
        v->duration[k] = d->lasts;
    }
    *a = (struct analysis){
        .arena = d->arena,
        .source = {.file = "impacts.csv", .kind = "CSV", .found = {.events = *v}},
        .given = {.scale = NAN, .rate = NAN, .theta = 0, .channel = 1, .options = impact_find_options}};
    return v->n < STATISTICS_LEAST || analyse_make(a, e);
}

/* ------------------------------------------------------------------ the command */

static bool options(struct decompose *d, struct err *e)
{
    static const char *const methods[] = {"lagrange", "lee", NULL}, *const sources[] = {"auto", "impacts", "force",
                                                                                        NULL};
    const struct args *a = &d->c->args;
    struct source_filter_options *o = &d->options;
    long most = 40;
    *o = (struct source_filter_options){.low = NAN, .high = NAN, .fastest = 600, .rise = 6, .snr = NAN};
    d->channel = 1;
    d->table = args_value(a, "table");
    o->both = args_given(a, "signed");
    if (!args_word(a, "method", methods, &o->method, e) || !args_word(a, "source", sources, &d->source, e) ||
        !args_whole(a, "channel", (const long[2]){1, 1024}, &d->channel, e) ||
        !args_whole(a, "modes", (const long[2]){1, 100}, &most, e) ||
        !cmd_quantity(d->c, "low", KEY_FREQUENCY, &o->low, e) ||
        !cmd_quantity(d->c, "high", KEY_FREQUENCY, &o->high, e) ||
        !args_number(a, "fastest", (const double[2]){1, 1e5}, &o->fastest, e) ||
        !args_number(a, "rise", (const double[2]){1, 60}, &o->rise, e) ||
        !args_number(a, "snr", (const double[2]){0, 120}, &o->snr, e))
        return false;
    o->most = (int)most;
    if (d->table && o->method == SOURCE_FILTER_LEE)
        return err_set(e, ERR_USAGE,
                       "--table and --method lee: of lee each impact has gains of its own; give one of them");
    if (!isnan(o->snr) && o->method == SOURCE_FILTER_LEE)
        return err_set(e, ERR_USAGE, "--snr is of the division, which --method lee does not do");
    return true;
}

static bool one(struct decompose *d, struct err *e)
{
    struct source_filter_options *o = &d->options;
    struct source_filter_mode *mode = NULL;
    int modes = 0;
    if (!take(d, e)) return false;
    if (d->rate < 8000 || d->rate > 768000)
        return err_set(e, ERR_SCENE, "%s: %g samples a second; a scene has 8 kHz to 768 kHz: resample it", d->shown,
                       d->rate);
    o->low = isnan(o->low) ? 40 : o->low;
    o->high = fmin(isnan(o->high) ? 0.45 * d->rate : o->high, 0.49 * d->rate);
    o->fastest = fmin(o->fastest, 0.05 * d->rate);
    if (!(o->low < o->high))
        return err_set(e, ERR_USAGE, "--low %g Hz is not below --high %g Hz (at most 0.49 of the sample rate)", o->low,
                       o->high);
    if (d->rate < 16000)
        note(d, "at %g Hz nothing above %.0f Hz is there: impacts within %.2g ms of each other are one", d->rate,
             o->high, 1e3 / o->high);
    if (d->table && !table_modes(d, &mode, &modes, e)) return false;
    if (!source_filter_find(d->x, d->n, d->rate, o, modes, mode, d->arena, &d->found, e))
        return err_at(e, "%s", d->shown);
    for (const char *line = d->found.note; line && *line; line = strchr(line, '\n') ? strchr(line, '\n') + 1 : NULL)
        note(d, "%.*s", (int)strcspn(line, "\n"), line);
    echo(d);
    judge(d);
    return series(d, e);
}

/* The folder is not there, or is one of these and --force is given. */
static bool folder_free(const struct decompose *d, const char *folder, struct err *e)
{
    struct stat s;
    if (lstat(folder, &s) != 0) return true;
    if (!S_ISDIR(s.st_mode) || lstat(arena_format(d->arena, "%s/decompose.json", folder), &s) != 0)
        return err_set(e, ERR_CREATE, "%s: is there, and is no folder that rasp decompose wrote; choose another name",
                       folder);
    return args_given(&d->c->args, "force") ||
           err_set(e, ERR_CREATE, "%s is there already; --force replaces it", folder);
}

static bool decompose_file(struct cmd_call *c, const char *file, const char *folder, struct err *e)
{
    struct arena *a = arena_open();
    struct decompose *d = ARENA_TAKE(a, struct decompose, 1);
    const char *slash = strrchr(file, '/'), *temporary = NULL;
    *d = (struct decompose){.c = c,
                            .arena = a,
                            .file = file,
                            .shown = text_shown(a, slash ? slash + 1 : file),
                            .folder = folder,
                            .echo = NAN};
    bool ok = options(d, e) && folder_free(d, folder, e) && one(d, e) &&
              (temporary = outfile_folder_open(folder, a, e)) != NULL;
    if (temporary) {
        ok = decompose_write(d, temporary, e);
        ok = outfile_folder_close(folder, temporary, ok, a, e) && ok;
    }
    if (ok && (args_given(&c->args, "json") || !args_given(&c->args, "quiet")))
        ok = decompose_write_report(d, stdout, args_given(&c->args, "json"), e);
    arena_close(a);
    return ok;
}

static int decompose_run(struct cmd_call *c, struct err *e)
{
    const char *output = args_value(&c->args, "output");
    size_t n = output ? strlen(output) : 0;
    while (n > 1 && output[n - 1] == '/')
        n--;
    if (!n) return err_set(e, ERR_USAGE, "-o FOLDER is needed: the folder to write"), (int)e->kind;
    output = arena_format(c->arena, "%.*s", (int)n, output);
    const char **folder = ARENA_TAKE(c->arena, const char *, c->args.n_operands);
    for (int k = 0; k < c->args.n_operands; k++) {
        const char *file = c->args.operands[k], *slash = strrchr(file, '/'), *name = slash ? slash + 1 : file,
                   *dot = strrchr(name, '.');
        int length = dot && dot > name ? (int)(dot - name) : (int)strlen(name);
        folder[k] = c->args.n_operands == 1 ? output : arena_format(c->arena, "%s.%.*s", output, length, name);
        for (int i = 0; i < k; i++)
            if (!strcmp(folder[i], folder[k]))
                return err_set(e, ERR_USAGE, "%s and %s would both be in %s: take one at a time", c->args.operands[i],
                               file, folder[k]),
                       (int)e->kind;
    }
    for (int k = 0; k < c->args.n_operands && decompose_file(c, c->args.operands[k], folder[k], e); k++)
        ;
    return (int)e->kind;
}

static const struct args_option decompose_options[] = {
    {"output", 'o', "FOLDER", false, "the folder to write; of several recordings FOLDER.NAME each; must be given"},
    {"force", 'f', NULL, false, "replaces a folder that rasp decompose wrote"},
    {"method", 0, "lagrange|lee", false,
     "lagrange (default): one filter, and the source by dividing by it; lee: each impact has gains of its own"},
    {"table", 0, "FILE.csv", false,
     "modes that are known, such as of a strike on the same object (rasp modes extract): only the "
     "source is looked for"},
    {"source", 0, "auto|impacts|force", false,
     "what the scene has: impacts that are drawn, or the force as it was; default: auto, impacts if they are half of "
     "the "
     "source's energy"},
    {"signed", 0, NULL, false, "impacts in both directions (rubbing and scratching)"},
    {"channel", 0, "N", false, "channel of the recording, from 1; default: 1"},
    {"from", 0, "TIME", false, "where the part that is taken begins; default: 0"},
    {"until", 0, "TIME", false, "where it ends; default: the end; of more than a minute the loudest is taken"},
    {"modes", 0, "N", false, "modes at most, the strongest; default: 40"},
    {"low", 0, "FREQUENCY", false, "modes are looked for from here on; default: 40 Hz"},
    {"high", 0, "FREQUENCY", false, "and up to here; default: 0.45 of the sample rate"},
    {"fastest", 0, "RATE", false, "the fastest decay that is taken for a mode, in 1/s; default: 600"},
    {"rise", 0, "DECIBEL", false,
     "by which what prediction does not foresee rises at the onsets that the search begins with; default: 6"},
    {"snr", 0, "DECIBEL", false,
     "how far below the filter's greatest power it is still divided by; default: by the noise"},
    {"json", 'j', NULL, false, "prints the report as JSON"},
    {"quiet", 'q', NULL, false, "prints nothing; the report is in the folder all the same"},
    {0},
};

const struct command decompose_command = {
    .name = "decompose",
    .summary = "a recording of rolling or scraping as modes, a source and impacts: a scene",
    .does = "Takes a recording of a contact that lasts apart into what rings and what drives it. It does so after "
            "Lagrange et al. and Lee et al. as Conan et al. (2014) describe them. Impacts are what linear prediction "
            "does not foresee. The modes are fitted to their mean response, by least squares over the recording, and "
            "to what rings freely for long. The source is the recording divided by that response, as far as it is "
            "above the noise. Impacts are its pulses, and with them all is found once more. Their amplitudes and the "
            "times between them are analysed as rasp analyse does.\n"
            "FOLDER gets modes.csv (frequencies and decays with their errors), source.wav (the force) and "
            "impacts.csv. The scene part impacts.yaml draws impacts like them. The scene scene.yaml renders what was "
            "found: impacts, or where the contact does not break the force as it was. The scene force.yaml has the "
            "force in any case. The report is decompose.json, and decompose.png where gnuplot is installed. Levels "
            "are relative: a recording does not say how hard was struck.",
    .also = "What a recording cannot say is said: noise, clipping, echoes of a room, too few impacts for statistics. "
            "So are modes that are little of what rings (speech, several objects). A contact that does not break has "
            "no impacts that are alike: modes are then those of the autocorrelation, with no intervals. Intervals of "
            "modes are by noise and by differences between frames. They do not hold what reflections add.",
    .operands = "RECORDING...",
    .least = 1,
    .most = -1,
    .options = decompose_options,
    .examples = "rasp render scenes/rolling_impacts.yaml -o out/rolling.wav\n"
                "rasp decompose out/rolling.wav -o out/parts\n"
                "rasp render out/parts/scene.yaml -o out/again.wav\n"
                "rasp decompose out/rolling.wav --method lee -o out/lee --json\n",
    .run = decompose_run,
};
