/* The table of `rasp accuracy` as CSV: one row per setting, SI units and dB; a cell is empty where there is no figure,
 * inf where samples are the same. */
#include "cmd/accuracy.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/text.h"
#include "cmd/report.h"
#include "num/real.h"
#include "pipeline/plan.h"
#include "scene/accuracy.h"
#include "scene/keys.h"

static void cells(FILE *f, int n, const double *x)
{
    for (int i = 0; i < n; i++)
        fprintf(f, isnan(x[i]) ? "," : ",%.6g", x[i]);
}

/* NULL: none */
static void errors(FILE *f, const struct accuracy_render *r)
{
    static const struct accuracy_error none = {NAN, NAN, NAN, NAN, NAN, NAN, NAN};
    const struct accuracy_error *o = r && r->code == 0 ? &r->error : &none;
    cells(f, 6, (const double[]){o->snr, o->third, o->third_hz, o->spectral, o->level, o->follows});
}

void accuracy_report_table(const struct accuracy_sweep *s, FILE *f)
{
    fputs("setting,value,scene", f);
    for (int i = 0; i < 2; i++) {
        const char *of = i ? "" : "alone_";
        fprintf(f, ",%ssnr_db,%sthird_octave_db,%sthird_octave_hz,%sspectral_db,%slevel_db,%sfollows_s%s", of, of, of,
                of, of, of, i ? "" : ",order");
    }
    fputs(",cpu_s,real_time_factor,peak_bytes,contact_share,front,below_reference,exit_code,diverges_s,reference_snr_"
          "db\n",
          f);
    for (int i = 0; i < s->n_rows; i++) {
        const struct accuracy_row *w = &s->rows[i];
        const struct accuracy_render *r = &s->renders[w->total];
        bool ran = r->code == 0;
        fprintf(f, "%s,%s,%d", w->name, w->value, w->chosen);
        errors(f, w->alone >= 0 ? &s->renders[w->alone] : NULL);
        cells(f, 1, &w->order);
        errors(f, r);
        cells(f, 2, (const double[]){ran ? r->cpu : NAN, ran ? r->error.length / fmax(r->cpu, 1e-9) : NAN});
        fprintf(f, ran ? ",%.0f" : ",", r->peak);
        cells(f, 1, ran ? &r->contact_share : &(double){NAN});
        fprintf(f, ",%d,%d,%d", r->front, accuracy_judge_below(s, r), r->code);
        cells(f, 2, (const double[]){isfinite(s->until) ? s->until : NAN, s->own_db});
        fputc('\n', f);
    }
}

/* What is printed: as JSON, or for people, in colour on a terminal unless NO_COLOR is set (no-color.org). */

enum { BAR = 8 };

/* ------------------------------------------------------------------ cells */

static const char *bar(const struct accuracy_sweep *s, double share)
{
    int n = isfinite(share) ? (int)rint(BAR * fmin(fmax(share, 0.0), 1.0)) : BAR;
    return arena_format(s->call->arena, "%.*s%*s", n, "########", BAR - n, "");
}

static const char *error_text(const struct accuracy_sweep *s, const struct accuracy_render *r)
{
    if (r->code != 0) return arena_format(s->call->arena, "exit %d", r->code);
    if (r == &s->renders[s->reference]) return "-";
    if (isnan(r->error.snr)) return "none";
    return isfinite(r->error.snr)
               ? arena_format(s->call->arena, "%s%.1f dB", accuracy_judge_below(s, r) ? "<" : "", -r->error.snr)
               : "same bits";
}

/* JSON has no infinities: null. */
static void set_error(struct report *r, const char *key, const struct accuracy_render *x)
{
    const struct accuracy_error *o = &x->error;
    if (x->code != 0)
        report_set(r, "$:{ exit_code:i says:s }", key, x->code, x->words);
    else
        report_set(r,
                   "$:{ snr_db:n same_samples:b third_octave_db:n third_octave_hz:n spectral_db:n level_db:n "
                   "follows_s:n }",
                   key, o->snr, isinf(o->snr) && o->snr > 0, o->third, o->third_hz, o->spectral, o->level, o->follows);
}

static void report_setting(struct report *r, const struct accuracy_sweep *s, const struct accuracy_row *w, bool colour)
{
    const struct accuracy_render *x = &s->renders[w->total];
    struct arena *a = s->call->arena;
    report_set(r, ":{ setting:s value:s scene:b alone:0 order:n total:0 cost:0 front:b below_reference:b", w->name,
               w->value, w->chosen, w->order, x->front, accuracy_judge_below(s, x));
    if (w->alone >= 0) set_error(r, "alone", &s->renders[w->alone]);
    set_error(r, "total", x);
    if (x->code == 0)
        report_set(r, "cost:{ cpu_s:n real_time_factor:n peak_bytes:n contact_share:n }", x->cpu,
                   x->error.length / fmax(x->cpu, 1e-9), x->peak, x->contact_share);
    report_set(r, "}");
    report_text(r, "%s%-24s", colour && x->front ? "\033[1;32m" : "",
                arena_format(a, "%c %s %s%s", w->chosen ? '=' : ' ', w->name, w->value, x->front ? " *" : ""));
    report_text(r, "  %10s %6s", w->alone >= 0 ? error_text(s, &s->renders[w->alone]) : "",
                isnan(w->order) ? "" : arena_format(a, "%.2f", w->order));
    report_text(r, "  %10s ", error_text(s, x)); /* what it sounds like, and what it costs */
    double snr = 1.0, cpu = 0.0;                 /* the most of all renders */
    for (int i = 0; i < s->n_renders; i++) {
        const struct accuracy_render *one = &s->renders[i];
        if (one->code == 0 && isfinite(one->error.snr)) snr = fmax(snr, one->error.snr);
        if (one->timed && isfinite(one->cpu)) cpu = fmax(cpu, one->cpu);
    }
    if (x->code == 0) {
        const struct accuracy_error *o = &x->error;
        report_text(r, "%s  %7.3f %8.3f",
                    x == &s->renders[s->reference] ? bar(s, 1.0) : bar(s, isnan(o->snr) ? 0.0 : o->snr / snr), o->third,
                    o->spectral);
        if (isfinite(s->until))
            report_text(r, " %8.2f %6.3f s %8s", o->level, o->follows,
                        isnan(x->contact_share) ? "" : arena_format(a, "%.1f %%", 100.0 * x->contact_share));
        report_text(r, "  %7.4f s %s %7.4g  %6.1f MB", x->cpu, bar(s, x->cpu / cpu), o->length / fmax(x->cpu, 1e-9),
                    x->peak / 1e6);
    }
    report_text(r, "%s\n", colour && x->front ? "\033[0m" : "");
}

bool accuracy_report(const struct accuracy_sweep *s, struct err *e)
{
    const char *no = getenv("NO_COLOR");
    bool colour = isatty(STDOUT_FILENO) && (!no || !*no);
    struct arena *a = s->call->arena;
    struct report r = report_open(stdout, s->json);
    report_set(&r, "scene:s compared:s length_s:n rate_hz:n channels:i runs:i", s->file, s->force ? "force" : "sound",
               s->length, s->rate, s->channels, s->runs);
    report_set(&r, "diverges_s:n reference_error_db:n reference_errors_db:{", s->until, -s->own_db);
    const char *parts = "", *own = "Errors are against the preset reference.";
    for (int k = 0; k < KNOBS; k++) {
        double db = s->own[k] > 0.0 ? 20.0 * real_log10(s->own[k]) : NAN;
        if (s->knobs & 1u << k) report_set(&r, "$:n", keys_knobs[k].name, db);
        if (!isnan(db)) parts = arena_format(a, "%s%s%s %.0f dB", parts, *parts ? ", " : "", keys_knobs[k].name, db);
    }
    bool judged = isinf(s->until) && !s->presets;
    if (judged && isinf(s->own_db))
        own = "Errors are against the preset reference, which has none that these knobs would show.";
    else if (judged)
        own = arena_format(a,
                           "Errors are against the preset reference, whose own is about %.0f dB (%s): of smaller ones "
                           "(<) believe no more than that.",
                           -s->own_db, parts);
    report_set(&r, "} settings:[");
    report_note(&r, "",
                arena_format(a, "%s: %s%.3f s, %.9g Hz, %d channel%s; turned by %s.", text_shown(a, s->file),
                             s->force ? "no sound, so its contact force: " : "", s->length, s->rate, s->channels,
                             s->channels == 1 ? "" : "s", plan_knobs_text(s->knobs, a)));
    report_note(&r, "", own);
    if (isfinite(s->until))
        report_note(
            &r, "",
            arena_format(a,
                         "It is chaotic: from %.2f s on, high and reference are two sounds of one kind. Samples "
                         "are compared up to there (alone, total); third octaves, spectra and levels after it; "
                         "follows: how long each goes with reference. high and reference, equally right, have "
                         "spectra %.2g dB apart: less is no merit.",
                         s->until, s->renders[s->high].error.spectral));
    report_note(&r, "",
                arena_format(a,
                             "total: all other knobs as the scene has them (=); alone: the others at reference. CPU: "
                             "of the render, the least of %d run%s. *: nothing is cheaper and better.",
                             s->runs, s->runs == 1 ? "" : "s"));
    report_text(&r, "\n%-24s  %10s %6s  %10s %-*s  %7s %8s", "", "alone", "order", "total", BAR, "", "3rd oct",
                "spectrum");
    if (isfinite(s->until)) report_text(&r, " %8s %8s %8s", "level", "follows", "contact");
    report_text(&r, "  %9s %-*s %7s  %9s\n", "CPU", BAR, "", "x real", "memory");
    for (int i = 0; i < s->n_rows; i++) {
        if (i > 0 && strcmp(s->rows[i].name, s->rows[i - 1].name) != 0) report_text(&r, "\n");
        report_setting(&r, s, &s->rows[i], colour);
    }
    for (int i = 0; i < s->n_renders; i++)
        if (s->renders[i].code != 0)
            report_text(&r, "exit %d with %s: %s\n", s->renders[i].code, accuracy_rows_name(s, i), s->renders[i].words);
    return report_close(&r, 9, e);
}

/* The picture of `rasp accuracy`: what each setting's error is against how many times faster than real time it renders;
   a line for each knob, the presets by name, the front ringed, and the reference's own error as a grey line, below
   which no figure means much. Of a sound that diverges the error is that of its spectrum. */

/* Okabe and Ito's set, told apart by colour-blind people too. */
static const char *const colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"};

static double speed(const struct accuracy_render *r) { return r->error.length / fmax(r->cpu, 1e-9); }

/* dB; settings that are the reference, or make its samples, have none. */
static bool shown(const struct accuracy_sweep *s, const struct accuracy_row *w, double *error)
{
    const struct accuracy_render *r = &s->renders[w->total];
    *error = accuracy_judge_error(s, r);
    return r->code == 0 && isfinite(*error) && w->total != s->reference;
}

/* Leading digits of labels, from few to many: the last set has two in whatever spans a factor of 2.25. */
static const double digits[3][11] = {{1}, {1, 2, 5}, {1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9}};

int accuracy_report_tics(double low, double high, double tics[ACCURACY_REPORT_TICS])
{
    int n = 0;
    for (int set = 0; set < 3 && n < 2; set++) {
        n = 0;
        for (int e = (int)floor(real_log10(low)); e <= (int)ceil(real_log10(high)); e++)
            for (const double *d = digits[set]; *d > 0; d++) {
                double x = *d * real_pow(10, e);
                if (x >= low && x <= high && n < ACCURACY_REPORT_TICS) tics[n++] = x;
            }
    }
    return n;
}

/* From a little below the slowest to a little above the fastest. */
static void put_range(const struct accuracy_sweep *s, struct gnuplot *g)
{
    double low = HUGE_VAL, high = 0.0, error;
    for (int i = 0; i < s->n_rows; i++)
        if (shown(s, &s->rows[i], &error)) {
            low = fmin(low, speed(&s->renders[s->rows[i].total]));
            high = fmax(high, speed(&s->renders[s->rows[i].total]));
        }
    if (!(high > 0.0)) return;
    double tics[ACCURACY_REPORT_TICS];
    int n = accuracy_report_tics(low / 1.5, high * 1.5, tics);
    fprintf(g->in, "set xrange [%.4g:%.4g]\nset xtics (", low / 1.5, high * 1.5);
    for (int i = 0; i < n; i++)
        fprintf(g->in, "%s'%.6g' %.6g", i ? ", " : "", tics[i], tics[i]);
    fputs(")\n", g->in);
}

void accuracy_report_plot(void *sweep, struct gnuplot *g)
{
    const struct accuracy_sweep *s = sweep;
    const char *between = "plot ";
    bool own = isfinite(s->own_db) && !isfinite(s->until);
    gnuplot_page(g, s->plot && text_ends(s->plot, ".svg"), 1000, 640);
    fputs("set grid linewidth 0.5 linecolor rgb '#dddddd'\nset logscale x\nset key noenhanced outside right top "
          "vertical samplen 2\n"
          "set xlabel 'times real time'\nset offsets 0, 0, graph 0.06, graph 0.06\n",
          g->in);
    gnuplot_put_setting(g, "title", s->scene.title ? s->scene.title : s->file);
    fprintf(g->in, "set ylabel '%s'\n",
            isfinite(s->until) ? "log-spectral distance from reference after divergence / dB"
                               : "error / dB (of the sound, below it)");
    if (own) fprintf(g->in, "own = %.6g\n", -s->own_db);
    put_range(s, g);
    int front = 0, end, colour = 0;
    fputs("$front << END\n", g->in);
    for (int i = 0; i < s->n_rows; i++) {
        double error;
        if (!shown(s, &s->rows[i], &error) || !s->renders[s->rows[i].total].front) continue;
        fprintf(g->in, "%.6g %.6g\n", speed(&s->renders[s->rows[i].total]), error);
        front++;
    }
    fputs("END\n", g->in);
    for (int i = 0; i < s->n_rows; i = end) {
        for (end = i; end < s->n_rows && s->rows[end].knob == s->rows[i].knob; end++)
            continue;
        fprintf(g->in, "$b%d << END\n", i);
        for (int k = i; k < end; k++) {
            const struct accuracy_row *w = &s->rows[k];
            double error;
            if (!shown(s, w, &error)) continue;
            const char *name = *w->value ? w->value : "scene";
            bool named = w->knob < 0 || !w->chosen; /* all knobs' curves meet where the scene is */
            fprintf(g->in, "%.6g %.6g \"%s\"\n", speed(&s->renders[w->total]), error, named ? name : "");
        }
        fputs("END\n", g->in);
    }
    for (int i = 0; i < s->n_rows; i = end) {
        double error;
        int n = 0;
        for (end = i; end < s->n_rows && s->rows[end].knob == s->rows[i].knob; end++)
            n += shown(s, &s->rows[end], &error);
        if (n == 0) continue;
        const char *c = s->rows[i].knob < 0 ? "#888888" : colours[colour++ % (int)(sizeof colours / sizeof *colours)];
        fprintf(g->in,
                "%s$b%d using 1:2 with linespoints linewidth 1.5 pointtype 7 pointsize 0.8 linecolor rgb '%s' title "
                "'%s', '' using 1:2:3 with labels noenhanced offset %s font ',%d' textcolor rgb '%s' notitle",
                between, i, c, s->rows[i].knob < 0 ? "presets" : s->rows[i].name,
                s->rows[i].knob < 0 ? "-0.9,-0.3 right" : "0.6,0.6 left", s->rows[i].knob < 0 ? 11 : 8, c);
        between = ", ";
    }
    if (front)
        fprintf(g->in,
                "%s$front using 1:2 with points pointtype 6 pointsize 2 linewidth 1.2 linecolor rgb 'black' title "
                "'nothing cheaper and better'",
                between);
    if (own)
        fprintf(g->in, "%sown with lines linewidth 1 dashtype 2 linecolor rgb '#888888' title 'own error of reference'",
                front ? ", " : between);
    fputs(front || own || colour ? "\n" : "set xrange [1:10]\nset yrange [0:1]\nplot NaN notitle\n", g->in);
}
