/* What `rasp decompose` writes: mode table, source, impacts, scenes, report, picture. */
#include <math.h>
#include <string.h>

#include "base/outfile.h"
#include "cmd/decompose.h"
#include "cmd/report.h"
#include "file/csv.h"
#include "file/wav.h"
#include "output/gnuplot.h"

#define INTERVAL 1.96 /* of a normal distribution, 95 % */

/* ------------------------------------------------------------------ files */

static const char *in_folder(const struct decompose *d, const char *folder, const char *name)
{
    return arena_format(d->arena, "%s/%s", folder, name);
}

/* Along which a filter that changes moves: a metre a second. */
static void put_modes(FILE *f, const struct decompose *d)
{
    const struct source_filter *s = &d->found;
    int places = s->places > 0 ? s->places : 1;
    /* velocity: to that a scene adds nothing, and the click is beside it */
    fputs("# poles: shared\n# quantity: velocity\n", f);
    fprintf(f, "# normalisation: relative: %s\n",
            d->table ? "that of the table"
                     : "a recording does not say how hard was struck; gains are in what it holds, whatever that is");
    fprintf(f, "# source: %s, %.6g to %.6g s, by rasp decompose --method %s\n", d->shown, d->begin,
            d->begin + d->seconds, d->options.method == SOURCE_FILTER_LEE ? "lee" : "lagrange");
    for (int i = 0; i < s->m; i++)
        if (isfinite(s->mode[i].frequency_se))
            fprintf(f, "# error %d: frequency_hz se %.3g, decay_per_s se %.3g\n", i + 1, s->mode[i].frequency_se,
                    s->mode[i].decay_se);
    for (int k = 0; k < d->notes; k++)
        fprintf(f, "# note %d: %s\n", k + 1, d->note[k]);
    fputs("place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad\n", f);
    for (int p = 0; p < places; p++)
        for (int i = 0; i < s->m; i++) {
            cplx gain = s->places > 0 ? s->place_gain[i * s->places + p] : s->mode[i].gain;
            double size = cplx_abs(gain);
            fprintf(f, "%d,%.9g,0,%d,%.9g,%.9g,%.9g,%.9g\n", p + 1, s->places > 0 ? s->place_time[p] : 0, i + 1,
                    s->mode[i].frequency, s->mode[i].decay, size, size > 0 ? real_atan2(gain.im, gain.re) : 0);
        }
}

static void put_impacts(FILE *f, const struct decompose *d)
{
    const struct impact_events *v = &d->found.impacts;
    fputs("time_s,amplitude_n,duration_s\n", f);
    for (int k = 0; k < v->n; k++) {
        csv_put_number(f, v->time[k]);
        fputc(',', f);
        csv_put_number(f, v->amplitude[k]);
        fputc(',', f);
        csv_put_number(f, v->duration[k]);
        fputc('\n', f);
    }
}

/* impacts: those that are drawn; else the source, as it was. */
static void put_scene(FILE *f, const struct decompose *d, bool impacts)
{
    bool moves = d->found.places > 0 && !impacts;
    fprintf(f, "# %s, taken apart by rasp decompose: %s.\nrasp: 1\n", d->shown,
            impacts ? "impacts like those that were found" : "the force that was found");
    if (impacts) fputs("include: [impacts.yaml]\n", f);
    fprintf(f, "surface: {response: modes.csv%s}\n", moves ? ", moving: launch, extrapolate: nearest" : "");
    if (d->found.clicks > 0) fputs("scraper: {response: click.wav}  # what sounds at once, and is in no mode\n", f);
    if (moves)
        fprintf(f, "motion: {path: line, law: constant, to: [%.9g, 0], duration: %.9g s}\n", d->seconds, d->seconds);
    else
        fprintf(f, "motion: {path: still, at: [%.9g, 0], duration: %.9g s}\n",
                d->found.places > 0 ? d->found.place_time[0] : 0, d->seconds);
    if (!impacts) fputs("contact: {model: given, given: {file: source.wav, scale: 1}}\n", f);
    fprintf(f, "output: {sample_rate: %.9g, ramp: 0, tail: 0.2 s}\n", d->rate);
}

static bool put_sound(const struct decompose *d, const char *file, const double *x, double scale, long n, struct err *e)
{
    struct wav_format w = {.rate = d->rate, .channels = 1, .bits = -32, .comment = "rasp: by rasp decompose"};
    struct wav_out *o = wav_create(file, &w, e);
    double *y = ARENA_TAKE(d->arena, double, n);
    if (!o) return false;
    for (long i = 0; i < n; i++)
        y[i] = x[i] * scale;
    if (wav_write(o, y, (size_t)n, e)) return wav_commit(o, e);
    wav_drop(o);
    return false;
}

struct text_file {
    const char *name;
    void (*put)(FILE *f, const struct decompose *d);
};

static void put_scene_chosen(FILE *f, const struct decompose *d) { put_scene(f, d, d->impacts); }
static void put_scene_force(FILE *f, const struct decompose *d) { put_scene(f, d, false); }

/* ------------------------------------------------------------------ picture */

/* The recording and what is given back, the source with its impacts, the modes. */
static void draw(void *self, struct gnuplot *g)
{
    const struct decompose *d = self;
    const struct source_filter *s = &d->found;
    const struct impact_events *v = &s->impacts;
    double *y = ARENA_TAKE(d->arena, double, d->n), most = 0;
    long step = d->n / 4000 + 1, from = 0, n = (long)(0.25 * d->rate) < d->n ? (long)(0.25 * d->rate) : d->n;
    source_filter_sound(s, y);
    if (v->n > 0) { /* a quarter of a second about the greatest impact */
        int top = 0;
        for (int k = 1; k < v->n; k++)
            top = fabs(v->amplitude[k]) > fabs(v->amplitude[top]) ? k : top;
        from = (long)((v->time[top] - d->begin) * d->rate) - n / 4;
        from = from < 0 ? 0 : from > d->n - n ? d->n - n : from;
    }
    for (long i = 0; i < d->n; i++)
        most = fmax(most, fabs(d->x[i]));
    gnuplot_page(g, false, 1000, 900);
    fputs("set multiplot layout 3,1\n", g->in);
    gnuplot_put_setting(
        g, "title",
        arena_format(d->arena, "%s: recording, and what the source and %d modes give back", d->shown, s->m));
    fprintf(g->in,
            "set xlabel 'time, s'\nset ylabel 'sound'\nplot '-' with lines lc rgb '#999999' title 'recording', '-' "
            "with lines lc rgb '#c03020' title 'given back'\n");
    for (int pass = 0; pass < 2; pass++) {
        for (long i = 0; i < d->n; i += step) {
            double low = HUGE_VAL, high = -HUGE_VAL;
            for (long k = i; k < i + step && k < d->n; k++) {
                low = fmin(low, pass ? y[k] : d->x[k]);
                high = fmax(high, pass ? y[k] : d->x[k]);
            }
            fprintf(g->in, "%.6f %.5g\n%.6f %.5g\n", d->begin + (double)i / d->rate, low,
                    d->begin + (double)i / d->rate, high);
        }
        fputs("e\n", g->in);
    }
    gnuplot_put_setting(g, "title",
                        arena_format(d->arena, "source, a quarter of a second, and its impacts (%d in all)", v->n));
    fputs("set ylabel 'force, relative'\nplot '-' with lines lc rgb '#999999' title 'source', '-' with impulses lc rgb "
          "'#c03020' title 'impacts'\n",
          g->in);
    double scale = 0, greatest = 0;
    for (long i = from; i < from + n; i++) {
        fprintf(g->in, "%.6f %.5g\n", d->begin + (double)i / d->rate, s->source[i]);
        greatest = fmax(greatest, fabs(s->source[i]));
    }
    fputs("e\n", g->in);
    for (int k = 0; k < v->n; k++)
        scale = fmax(scale, fabs(v->amplitude[k]));
    for (int k = 0; k < v->n; k++)
        if (v->time[k] >= d->begin + (double)from / d->rate && v->time[k] < d->begin + (double)(from + n) / d->rate)
            fprintf(g->in, "%.6f %.5g\n", v->time[k], v->amplitude[k] / scale * greatest);
    fputs(v->n == 0 ? "0 0\ne\n" : "e\n", g->in);
    gnuplot_put_setting(g, "title", "modes: time to decay by 60 dB; size: energy");
    fputs("set xlabel 'frequency, Hz'\nset ylabel 'T60, s'\nset logscale xy\nplot '-' with points pt 7 ps variable lc "
          "rgb "
          "'#2060a0' notitle\n",
          g->in);
    double loudest = 0;
    for (int i = 0; i < s->m; i++)
        loudest = fmax(loudest, cplx_square(s->mode[i].gain) / s->mode[i].decay);
    for (int i = 0; i < s->m; i++)
        fprintf(g->in, "%.6g %.5g %.3g\n", s->mode[i].frequency, 3 * real_log(10) / s->mode[i].decay,
                0.4 + 2.5 * sqrt(sqrt(cplx_square(s->mode[i].gain) / s->mode[i].decay / loudest)));
    fputs("e\nunset multiplot\n", g->in);
}

bool decompose_write(struct decompose *d, const char *folder, struct err *e)
{
    const struct text_file files[] = {{"modes.csv", put_modes},
                                      {"impacts.csv", put_impacts},
                                      {"scene.yaml", put_scene_chosen},
                                      {"force.yaml", put_scene_force}};
    struct err none = {0};
    if (d->series->counted) { /* a series that no scene may have is no reason to write nothing */
        struct analyse_files *all = ARENA_TAKE(d->arena, struct analyse_files, 1);
        bool part = analyse_report_part(d->series, in_folder(d, folder, "impacts.yaml"), all, &none);
        outfile_commit_all(all->o, all->n, &none);
        if (!part && none.kind == ERR_SCENE && d->notes < DECOMPOSE_NOTES) {
            d->note[d->notes++] = arena_format(
                d->arena, "no impacts can be drawn like these, and the scene has the force itself: %s", none.text);
            d->impacts = false;
            none = (struct err){0};
        }
        if (none.kind) {
            *e = none;
            return false;
        }
    }
    if (!gnuplot_write(in_folder(d, folder, "decompose.png"), false, draw, d, &none) && none.kind != ERR_UNBUILT) {
        *e = none;
        return false;
    }
    for (size_t k = 0; k < sizeof files / sizeof *files; k++) {
        struct outfile o;
        if (!outfile_open(&o, in_folder(d, folder, files[k].name), e)) return false;
        files[k].put(o.stream, d);
        if (!outfile_commit(&o, e)) return false;
    }
    const struct source_filter *s = &d->found; /* a push of a sample in newtons, a response per N s */
    if (!put_sound(d, in_folder(d, folder, "source.wav"), s->source, d->rate, d->n, e) ||
        (s->clicks > 0 && !put_sound(d, in_folder(d, folder, "click.wav"), s->click, 1, s->clicks, e)))
        return false;
    struct outfile o;
    if (!outfile_open(&o, in_folder(d, folder, "decompose.json"), e)) return false;
    decompose_write_report(d, o.stream, true, e);
    return outfile_commit(&o, e) && e->kind == ERR_NONE;
}

/* ------------------------------------------------------------------ report */

static void report_modes(struct report *r, const struct decompose *d)
{
    const struct source_filter *s = &d->found;
    report_list(r, "modes");
    for (int i = 0; i < s->m; i++) {
        const struct source_filter_mode *m = &s->mode[i];
        report_object(r, NULL);
        report_set(r, "frequency_hz:n frequency_low:n frequency_high:n decay_per_s:n decay_low:n decay_high:n gain:n",
                   m->frequency, m->frequency - INTERVAL * m->frequency_se, m->frequency + INTERVAL * m->frequency_se,
                   m->decay, m->decay - INTERVAL * m->decay_se, m->decay + INTERVAL * m->decay_se, cplx_abs(m->gain));
        report_end(r);
        if (i < 10)
            report_text(r,
                        isnan(m->frequency_se) ? "  %10.2f Hz            %8.2f 1/s\n"
                                               : "  %10.2f Hz +- %-8.2g %8.2f 1/s +- %.2g\n",
                        m->frequency, isnan(m->frequency_se) ? m->decay : INTERVAL * m->frequency_se, m->decay,
                        INTERVAL * m->decay_se);
    }
    report_end(r);
    if (s->m > 10) report_text(r, "  ... and %d weaker ones\n", s->m - 10);
}

static void report_estimate(struct report *r, const char *key, const struct estimate *x, double scale,
                            const char *label, const char *unit)
{
    report_object(r, key);
    report_set(r, "value:n low:n high:n", x->value, x->low, x->high);
    report_end(r);
    report_text(r, "  %-22s %.4g%s (%.4g to %.4g)\n", label, scale * x->value, unit, scale * x->low, scale * x->high);
}

bool decompose_write_report(const struct decompose *d, FILE *to, bool json, struct err *e)
{
    const struct source_filter *s = &d->found;
    const struct impact_events *v = &s->impacts;
    struct report r = report_open(to, json);
    bool lee = d->options.method == SOURCE_FILTER_LEE;
    report_set(
        &r,
        "recording:s channel:i channels:i sample_rate:n whole_s:n begin_s:n seconds:n method:s onsets:i free_frames:i "
        "longest_free_s:n correlated:b modes_given:b",
        d->shown, (int)d->channel, d->channels, d->rate, d->whole, d->begin, d->seconds, lee ? "lee" : "lagrange",
        s->onsets, s->frames, s->longest, s->correlated, d->table != NULL);
    report_set(
        &r, "fits_free_frames:n given_back:n source_impacts_share:n source_low_hz:n source_high_hz:n echo_s:n scene:s",
        d->fits, s->rings, s->struck, s->band[0], s->band[1], d->echo, d->impacts ? "impacts" : "force");
    report_text(&r, "%s, %.4g s from %.4g s on: %d onsets, %d free frames up to %.3g ms\n", d->shown, d->seconds,
                d->begin, s->onsets, s->frames, 1e3 * s->longest);
    report_text(&r, "%d modes%s:\n", s->m, d->table ? " of the table" : s->correlated ? " of the autocorrelation" : "");
    report_modes(&r, d);
    if (lee)
        report_text(&r, "%d impacts, each with gains of its own: they give back %.1f %% of the recording\n", v->n,
                    100 * s->rings);
    else
        report_text(&r,
                    "the source, %.4g to %.4g Hz, gives back %.1f %% of the recording; %d impacts are %.0f %% of it\n",
                    s->band[0], s->band[1], 100 * s->rings, v->n, 100 * s->struck);
    report_object(&r, "impacts");
    report_set(&r, "number:i per_s:n", v->n, v->n / d->seconds);
    if (d->series->counted) {
        const struct impact_statistics *t = &d->series->statistics;
        static const char *const name[] = {"amplitude", "interval"};
        report_estimate(&r, "amplitude_mean_n", &t->series[STATISTICS_AMPLITUDE].mean, 1, "amplitudes, mean", "");
        report_estimate(&r, "interval_mean_s", &t->series[STATISTICS_INTERVAL].mean, 1e3, "intervals, mean", " ms");
        for (int k = 0; k < STATISTICS_SERIES; k++) {
            report_estimate(&r, arena_format(d->arena, "%s_deviation", name[k]), &t->series[k].deviation, k ? 1e3 : 1,
                            arena_format(d->arena, "%ss, deviation", name[k]), k ? " ms" : "");
            report_estimate(&r, arena_format(d->arena, "%s_a1", name[k]), &t->series[k].a1, 1,
                            arena_format(d->arena, "%ss, a1", name[k]), "");
            report_estimate(&r, arena_format(d->arena, "%s_b1", name[k]), &t->series[k].b1, 1,
                            arena_format(d->arena, "%ss, b1", name[k]), "");
        }
    }
    report_end(&r);
    report_set(&r, "warnings:t", d->note, d->notes);
    for (int k = 0; k < d->notes; k++)
        report_note(&r, "warning: ", d->note[k]);
    if (!json)
        report_text(&r, "%s/scene.yaml renders %s\n", d->folder,
                    d->impacts ? "impacts like these" : "the force that was found");
    return report_close(&r, 12, e);
}
