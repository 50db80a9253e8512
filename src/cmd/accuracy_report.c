/* The table of `rasp accuracy` as CSV: one row per setting, SI units and dB; a cell is empty where there is no figure,
 * inf where samples are the same. */
#include "cmd/accuracy.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/text.h"
#include "base/wrap.h"
#include "file/json_value.h"
#include "num/real.h"
#include "pipeline/plan.h"
#include "scene/accuracy.h"
#include "scene/keys.h"

static void cell(FILE *f, double x)
{
    if (isnan(x))
        fputc(',', f);
    else
        fprintf(f, ",%.6g", x);
}

static void errors(FILE *f, const struct accuracy_render *r)
{
    const struct accuracy_error *o = r && r->code == 0 ? &r->error : NULL;
    cell(f, o ? o->snr : NAN);
    cell(f, o ? o->third : NAN);
    cell(f, o ? o->third_hz : NAN);
    cell(f, o ? o->spectral : NAN);
    cell(f, o ? o->level : NAN);
    cell(f, o ? o->follows : NAN);
}

static void row(const struct accuracy_sweep *s, const struct accuracy_row *w, FILE *f)
{
    const struct accuracy_render *r = &s->renders[w->total];
    bool ran = r->code == 0;
    fprintf(f, "%s,%s,%d", w->name, w->value, w->chosen);
    errors(f, w->alone >= 0 ? &s->renders[w->alone] : NULL);
    cell(f, w->order);
    errors(f, r);
    cell(f, ran ? r->cpu : NAN);
    cell(f, ran ? r->error.length / fmax(r->cpu, 1e-9) : NAN);
    fprintf(f, ran ? ",%.0f" : ",", r->peak);
    cell(f, ran ? r->contact_share : NAN);
    fprintf(f, ",%d,%d,%d", r->front, accuracy_judge_below(s, r), r->code);
    cell(f, isfinite(s->until) ? s->until : NAN);
    cell(f, s->own_db);
    fputc('\n', f);
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
    for (int i = 0; i < s->n_rows; i++)
        row(s, &s->rows[i], f);
}

/* The table of `rasp accuracy` as JSON. */

/* JSON has no infinities: null. */
static json_t *error_json(const struct accuracy_render *r)
{
    const struct accuracy_error *o = &r->error;
    if (r->code != 0) return json_pack("{s:i, s:o}", "exit_code", r->code, "says", json_value_text(r->words));
    return json_pack("{s:o, s:b, s:o, s:o, s:o, s:o, s:o}", "snr_db", json_value_number(o->snr), "same_samples",
                     isinf(o->snr) && o->snr > 0, "third_octave_db", json_value_number(o->third), "third_octave_hz",
                     json_value_number(o->third_hz), "spectral_db", json_value_number(o->spectral), "level_db",
                     json_value_number(o->level), "follows_s", json_value_number(o->follows));
}

static json_t *cost_json(const struct accuracy_render *r)
{
    if (r->code != 0) return json_null();
    return json_pack("{s:o, s:o, s:o, s:o}", "cpu_s", json_value_number(r->cpu), "real_time_factor",
                     json_value_number(r->error.length / fmax(r->cpu, 1e-9)), "peak_bytes", json_value_number(r->peak),
                     "contact_share", json_value_number(r->contact_share));
}

static json_t *row_json(const struct accuracy_sweep *s, const struct accuracy_row *w)
{
    const struct accuracy_render *r = &s->renders[w->total];
    return json_pack("{s:s, s:s, s:b, s:o, s:o, s:o, s:o, s:b, s:b}", "setting", w->name, "value", w->value, "scene",
                     w->chosen, "alone", w->alone >= 0 ? error_json(&s->renders[w->alone]) : json_null(), "order",
                     json_value_number(w->order), "total", error_json(r), "cost", cost_json(r), "front", r->front,
                     "below_reference", accuracy_judge_below(s, r));
}

static json_t *own_json(const struct accuracy_sweep *s)
{
    json_t *own = json_object();
    for (int k = 0; k < KNOBS; k++)
        if (s->knobs & 1u << k)
            json_object_set_new(own, keys_knobs[k].name,
                                json_value_number(s->own[k] > 0.0 ? 20.0 * real_log10(s->own[k]) : NAN));
    return own;
}

bool accuracy_report_json(const struct accuracy_sweep *s, struct err *e)
{
    json_t *rows = json_array();
    for (int i = 0; i < s->n_rows; i++)
        json_array_append_new(rows, row_json(s, &s->rows[i]));
    json_t *j = json_pack("{s:o, s:s, s:o, s:o, s:i, s:i, s:o, s:o, s:o, s:o}", "scene", json_value_text(s->file),
                          "compared", s->force ? "force" : "sound", "length_s", json_value_number(s->length), "rate_hz",
                          json_value_number(s->rate), "channels", s->channels, "runs", s->runs, "diverges_s",
                          json_value_number(s->until), "reference_error_db", json_value_number(-s->own_db),
                          "reference_errors_db", own_json(s), "settings", rows);
    bool ok = j && json_dumpf(j, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(9)) == 0;
    putchar('\n');
    json_decref(j);
    return ok || err_set(e, ERR_IO, "the report cannot be written as JSON");
}

/* The table of `rasp accuracy` for people: plain text, in colour on a terminal unless NO_COLOR is set (no-color.org).
 */

enum { BAR = 8 };

/* ------------------------------------------------------------------ what it is about */

static void say(const char *text) { wrap_print(stdout, text, 0, ""); }

static const char *own_text(const struct accuracy_sweep *s)
{
    struct arena *a = s->call->arena;
    const char *parts = "";
    for (int k = 0; k < KNOBS; k++)
        if (s->own[k] > 0.0)
            parts = arena_format(a, "%s%s%s %.0f dB", parts, *parts ? ", " : "", keys_knobs[k].name,
                                 20.0 * real_log10(s->own[k]));
    if (isfinite(s->until) || s->presets) return "Errors are against the preset reference.";
    if (isinf(s->own_db)) return "Errors are against the preset reference, which has none that these knobs would show.";
    return arena_format(a,
                        "Errors are against the preset reference, whose own is about %.0f dB (%s): of smaller ones (<) "
                        "believe no more than that.",
                        -s->own_db, parts);
}

static const char *divergence_text(const struct accuracy_sweep *s)
{
    return arena_format(s->call->arena,
                        "It is chaotic: from %.2f s on, high and reference are two sounds of one kind. Samples are "
                        "compared up to there (alone, total); third octaves, spectra "
                        "and levels after it; follows: how long each goes with reference. high and reference, equally "
                        "right, have spectra %.2g dB apart: less is no merit.",
                        s->until, s->renders[s->high].error.spectral);
}

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

static double most_snr(const struct accuracy_sweep *s)
{
    double most = 1.0;
    for (int i = 0; i < s->n_renders; i++)
        if (s->renders[i].code == 0 && isfinite(s->renders[i].error.snr)) most = fmax(most, s->renders[i].error.snr);
    return most;
}

static double most_cpu(const struct accuracy_sweep *s)
{
    double most = 0.0;
    for (int i = 0; i < s->n_renders; i++)
        if (s->renders[i].timed && isfinite(s->renders[i].cpu)) most = fmax(most, s->renders[i].cpu);
    return most;
}

/* What a render sounds like, and what it costs. */
static void print_total(const struct accuracy_sweep *s, const struct accuracy_render *r)
{
    const struct accuracy_error *o = &r->error;
    printf("  %10s ", error_text(s, r));
    if (r->code != 0) return;
    printf("%s  %7.3f %8.3f",
           r == &s->renders[s->reference] ? bar(s, 1.0) : bar(s, isnan(o->snr) ? 0.0 : o->snr / most_snr(s)), o->third,
           o->spectral);
    if (isfinite(s->until))
        printf(" %8.2f %6.3f s %8s", o->level, o->follows,
               isnan(r->contact_share) ? "" : arena_format(s->call->arena, "%.1f %%", 100.0 * r->contact_share));
    printf("  %7.4f s %s %7.4g  %6.1f MB", r->cpu, bar(s, r->cpu / most_cpu(s)), o->length / fmax(r->cpu, 1e-9),
           r->peak / 1e6);
}

static void print_row(const struct accuracy_sweep *s, const struct accuracy_row *w, bool colour)
{
    const struct accuracy_render *r = &s->renders[w->total];
    const char *order = isnan(w->order) ? "" : arena_format(s->call->arena, "%.2f", w->order);
    printf("%s%-24s", colour && r->front ? "\033[1;32m" : "",
           arena_format(s->call->arena, "%c %s %s%s", w->chosen ? '=' : ' ', w->name, w->value, r->front ? " *" : ""));
    printf("  %10s %6s", w->alone >= 0 ? error_text(s, &s->renders[w->alone]) : "", order);
    print_total(s, r);
    printf("%s\n", colour && r->front ? "\033[0m" : "");
}

void accuracy_report_print(const struct accuracy_sweep *s)
{
    const char *no = getenv("NO_COLOR");
    bool colour = isatty(STDOUT_FILENO) && (!no || !*no);
    struct arena *a = s->call->arena;
    say(arena_format(a, "%s: %s%.3f s, %.9g Hz, %d channel%s; turned by %s.", text_shown(a, s->file),
                     s->force ? "no sound, so its contact force: " : "", s->length, s->rate, s->channels,
                     s->channels == 1 ? "" : "s", plan_knobs_text(s->knobs, a)));
    say(own_text(s));
    if (isfinite(s->until)) say(divergence_text(s));
    say(arena_format(a,
                     "total: all other knobs as the scene has them (=); alone: the others at reference. CPU: of the "
                     "render, the least of %d run%s. *: nothing is cheaper and better.",
                     s->runs, s->runs == 1 ? "" : "s"));
    putchar('\n');
    printf("%-24s  %10s %6s  %10s %-*s  %7s %8s", "", "alone", "order", "total", BAR, "", "3rd oct", "spectrum");
    if (isfinite(s->until)) printf(" %8s %8s %8s", "level", "follows", "contact");
    printf("  %9s %-*s %7s  %9s\n", "CPU", BAR, "", "x real", "memory");
    for (int i = 0; i < s->n_rows; i++) {
        if (i > 0 && strcmp(s->rows[i].name, s->rows[i - 1].name) != 0) putchar('\n');
        print_row(s, &s->rows[i], colour);
    }
    for (int i = 0; i < s->n_renders; i++)
        if (s->renders[i].code != 0)
            printf("exit %d with %s: %s\n", s->renders[i].code, accuracy_rows_name(s, i), s->renders[i].words);
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

/* Rows [from, to) as data, one block. */
static void put_block(const struct accuracy_sweep *s, int from, int to, struct gnuplot *g)
{
    fprintf(g->in, "$b%d << END\n", from);
    for (int i = from; i < to; i++) {
        double error;
        if (!shown(s, &s->rows[i], &error)) continue;
        bool named = s->rows[i].knob < 0 || !s->rows[i].chosen; /* all knobs' curves meet where the scene is */
        fprintf(g->in, "%.6g %.6g \"%s\"\n", speed(&s->renders[s->rows[i].total]), error,
                !named              ? ""
                : *s->rows[i].value ? s->rows[i].value
                                    : "scene");
    }
    fputs("END\n", g->in);
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

static int put_front(const struct accuracy_sweep *s, struct gnuplot *g)
{
    int n = 0;
    fputs("$front << END\n", g->in);
    for (int i = 0; i < s->n_rows; i++) {
        double error;
        if (!shown(s, &s->rows[i], &error) || !s->renders[s->rows[i].total].front) continue;
        fprintf(g->in, "%.6g %.6g\n", speed(&s->renders[s->rows[i].total]), error);
        n++;
    }
    fputs("END\n", g->in);
    return n;
}

static void put_head(const struct accuracy_sweep *s, struct gnuplot *g)
{
    size_t n = s->plot ? strlen(s->plot) : 0;
    bool svg = n > 3 && s->plot[n - 1] == 'g' && s->plot[n - 2] == 'v';
    fprintf(g->in, svg ? "set terminal svg size 1000,640 font 'DejaVu Sans,13' background rgb 'white'\n"
                       : "set terminal pngcairo size 1000,640 font 'DejaVu Sans,10' background rgb 'white'\n");
    fputs("set encoding utf8\nset border linewidth 0.8\nset tics out nomirror scale 0.6\nset grid linewidth 0.5 "
          "linecolor rgb '#dddddd'\nset logscale x\n"
          "set key noenhanced outside right top vertical samplen 2\nset xlabel 'times real time'\nset offsets 0, 0, "
          "graph 0.06, graph 0.06\nset title ",
          g->in);
    gnuplot_put_text(g, s->scene.title ? s->scene.title : s->file);
    fprintf(g->in, " noenhanced\nset ylabel '%s'\n",
            isfinite(s->until) ? "log-spectral distance from reference after divergence / dB"
                               : "error / dB (of the sound, below it)");
    if (isfinite(s->own_db) && !isfinite(s->until)) fprintf(g->in, "own = %.6g\n", -s->own_db);
}

void accuracy_report_plot(void *sweep, struct gnuplot *g)
{
    const struct accuracy_sweep *s = sweep;
    const char *between = "plot ";
    put_head(s, g);
    put_range(s, g);
    int front = put_front(s, g), end, colour = 0;
    bool own = isfinite(s->own_db) && !isfinite(s->until);
    for (int i = 0; i < s->n_rows; i = end) {
        for (end = i; end < s->n_rows && s->rows[end].knob == s->rows[i].knob; end++)
            continue;
        put_block(s, i, end, g);
    }
    for (int i = 0; i < s->n_rows; i = end) {
        double error;
        int n = 0;
        for (end = i; end < s->n_rows && s->rows[end].knob == s->rows[i].knob; end++)
            n += shown(s, &s->rows[end], &error);
        if (n == 0) continue;
        const char *c = s->rows[i].knob < 0 ? "#888888" : colours[colour++ % (int)(sizeof colours / sizeof *colours)];
        fprintf(
            g->in,
            "%s$b%d using 1:2 with linespoints linewidth 1.5 pointtype 7 pointsize 0.8 linecolor rgb '%s' title '%s', "
            "'' using 1:2:3 with labels noenhanced offset %s font ',%d' textcolor rgb '%s' notitle",
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
