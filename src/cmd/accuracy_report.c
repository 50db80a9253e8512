/* rasp accuracy: the table as text, JSON and CSV, and the picture. See accuracy.h. */
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

/* Times real time, at a CPU time. */
static double speed(const struct accuracy_render *r, double cpu) { return r->error.length / fmax(cpu, 1e-9); }

/* NULL: none */
static void errors(FILE *f, const struct accuracy_render *r)
{
    static const struct accuracy_error none = {NAN, NAN, NAN, NAN, NAN, NAN, NAN};
    const struct accuracy_error *o = r && r->code == 0 ? &r->error : &none;
    cells(f, 6, (const double[]){o->snr, o->third, o->third_hz, o->spectral, o->level, o->follows});
}

void accuracy_report_table(const struct accuracy_sweep *s, FILE *f)
{
    fputs("setting,value,scene,predicted_db,choosing_s", f);
    for (int k = 0; k < KNOBS; k++)
        fprintf(f, ",%s", keys_knobs[k].name);
    for (int i = 0; i < 1 + s->single; i++) {
        const char *of = i ? "alone_" : "";
        fprintf(f, ",%ssnr_db,%sthird_octave_db,%sthird_octave_hz,%sspectral_db,%slevel_db,%sfollows_s%s", of, of, of,
                of, of, of, i ? ",order" : "");
    }
    fputs(",cpu_s,cpu_from_s,cpu_to_s,runs,real_time_factor,peak_bytes,contact_share,front,below_reference,exit_code,"
          "diverges_s,reference_snr_db,excerpt_s\n",
          f);
    for (int i = 0; i < s->n_rows; i++) {
        const struct accuracy_row *w = &s->rows[i];
        const struct accuracy_render *r = &s->renders[w->total];
        bool ran = r->code == 0;
        fprintf(f, "%s,%s,%d", w->name, w->value, w->chosen);
        cells(f, 2, (const double[]){w->predicted, w->choosing});
        for (int k = 0; k < KNOBS; k++)
            cells(f, 1, &(double){w->refused ? NAN : accuracy_knob(&r->set, (enum knob)k)});
        errors(f, r);
        if (s->single) {
            errors(f, w->alone >= 0 ? &s->renders[w->alone] : NULL);
            cells(f, 1, &w->order);
        }
        cells(f, 3, ran ? (const double[]){r->cpu[1], r->cpu[0], r->cpu[2]} : (const double[]){NAN, NAN, NAN});
        fprintf(f, ",%d", r->n_runs);
        cells(f, 1, &(double){ran ? speed(r, r->cpu[1]) : NAN});
        fprintf(f, ran ? ",%.0f" : ",", r->peak);
        cells(f, 1, ran ? &r->contact_share : &(double){NAN});
        fprintf(f, ",%d,%d,%d", r->front, accuracy_judge_below(s, r), r->code);
        cells(f, 3, (const double[]){isfinite(s->until) ? s->until : NAN, s->own_db, s->excerpt});
        fputc('\n', f);
    }
}

/* What is printed: as JSON, or for people, in colour on a terminal unless NO_COLOR is set (no-color.org). */

/* ------------------------------------------------------------------ cells */

static const char *error_text(const struct accuracy_sweep *s, const struct accuracy_render *r)
{
    if (r->code != 0) return arena_format(s->call->arena, "exit %d", r->code);
    if (r == &s->renders[s->reference]) return "-";
    if (isnan(r->error.snr)) return "none";
    return isfinite(r->error.snr) ? arena_format(s->call->arena, "%s%.1f dB", accuracy_judge_below(s, r) ? "<" : "",
                                                 -fmin(r->error.snr, s->own_db))
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

static void set_setting(struct report *r, const struct accuracy_sweep *s, const struct accuracy_row *w)
{
    const struct accuracy_render *x = &s->renders[w->total];
    report_set(r, ":{ setting:s value:s scene:b predicted_db:n choosing_s:n knobs:{", w->name, w->value, w->chosen,
               w->predicted, w->choosing);
    for (int k = 0; k < KNOBS; k++)
        if (s->knobs & 1u << k && !w->refused)
            report_set(r, "$:n", keys_knobs[k].name, accuracy_knob(&x->set, (enum knob)k));
    report_set(r, "} total:0 alone:0 order:n cost:0 front:b below_reference:b", w->order, x->front,
               accuracy_judge_below(s, x));
    set_error(r, "total", x);
    if (w->alone >= 0) set_error(r, "alone", &s->renders[w->alone]);
    if (x->code == 0)
        report_set(r,
                   "cost:{ cpu_s:n cpu_interval_s:[ :n :n ] runs:i real_time_factor:n peak_bytes:n contact_share:n }",
                   x->cpu[1], x->cpu[0], x->cpu[2], x->n_runs, speed(x, x->cpu[1]), x->peak, x->contact_share);
    report_set(r, "}");
}

static void text_setting(struct report *r, const struct accuracy_sweep *s, const struct accuracy_row *w, bool colour)
{
    const struct accuracy_render *x = &s->renders[w->total];
    const struct accuracy_error *o = &x->error;
    struct arena *a = s->call->arena;
    bool again = w->refused && w > s->rows && w->refused == w[-1].refused;
    const char *head = arena_format(a, "%-20s",
                                    arena_format(a, "%c %s %s%s%s", w->chosen ? '=' : ' ', w->name, w->value,
                                                 strcmp(w->name, "asked") ? "" : " dB", x->front ? " *" : ""));
    if (w->refused) { /* without the key, and the error that the row says itself */
        static const char key[] = "accuracy.error: ";
        const char *own = strstr(w->refused, " dB cannot be"), *of = strstr(w->refused, key),
                   *why = own  ? own + strlen(" dB ")
                          : of ? of + strlen(key)
                               : w->refused;
        report_note(r, arena_format(a, "%s  ", head), again ? "nor this" : text_shown(a, why));
        return;
    }
    report_text(r, "%s%s", colour && x->front ? "\033[1;32m" : "", head);
    if (w->knob < 0)
        report_text(r, " %9s", isnan(w->predicted) ? "" : arena_format(a, "%.1f dB", w->predicted));
    else
        report_text(r, " %10s %6s", error_text(s, &s->renders[w->alone]),
                    isnan(w->order) ? "" : arena_format(a, "%.2f", w->order));
    report_text(r, " %10s", error_text(s, x));
    for (int k = 0; k < KNOBS && w->knob < 0; k++)
        if (s->knobs & 1u << k)
            report_text(r, "  %*.6g", (int)strlen(keys_knobs[k].name), accuracy_knob(&x->set, (enum knob)k));
    if (x->code == 0 && isfinite(s->until))
        report_text(r, "  %7.3f %8.3f %8.2f %6.3f s %8s", o->third, o->spectral, o->level, o->follows,
                    isnan(x->contact_share) ? "" : arena_format(a, "%.1f %%", 100.0 * x->contact_share));
    if (w->knob < 0) report_text(r, " %9s", isnan(w->choosing) ? "" : arena_format(a, "%.2f s", w->choosing));
    if (x->code == 0)
        report_text(r, "  %8.4f s %-19s %8.3g %8.1f MB", x->cpu[1],
                    x->n_runs > 1 ? arena_format(a, "(%.4f to %.4f)", x->cpu[0], x->cpu[2]) : "(once)",
                    speed(x, x->cpu[1]), x->peak / 1e6);
    report_text(r, "%s\n", colour && x->front ? "\033[0m" : "");
}

static void text_heads(struct report *r, const struct accuracy_sweep *s, bool knob)
{
    if (knob)
        report_text(r, "\n%-20s %10s %6s %10s", "", "alone", "order", "total");
    else
        report_text(r, "\n%-20s %9s %10s", "", "predicted", "measured");
    for (int k = 0; k < KNOBS && !knob; k++)
        if (s->knobs & 1u << k) report_text(r, "  %s", keys_knobs[k].name);
    if (isfinite(s->until))
        report_text(r, "  %7s %8s %8s %8s %8s", "3rd oct", "spectrum", "level", "follows", "contact");
    if (!knob) report_text(r, " %9s", "choosing");
    report_text(r, "  %-30s %8s %11s\n", "CPU of the render", "x real", "memory");
}

static void notes(struct report *r, const struct accuracy_sweep *s)
{
    struct arena *a = s->call->arena;
    const char *own = "of which nothing more is known", *how = "", *what = "";
    if (isfinite(s->own_db))
        own = arena_format(a,
                           "whose own error is %.0f dB at most: so much changes where its knobs are half as fine. Less "
                           "is not seen (<)",
                           -s->own_db);
    else if (isinf(s->until))
        own = "which has the same bits where its knobs are half as fine";
    for (int k = 0; k < KNOBS; k++)
        if (s->knobs & 1u << k)
            what = arena_format(a, "%s%s%s %.6g", what, *what ? ", " : "", keys_knobs[k].name,
                                accuracy_knob(&s->renders[s->reference].set, (enum knob)k));
    report_note(r, "",
                arena_format(a, "%s: %s%.3f s, %.9g Hz, %d channel%s; turned by %s.", text_shown(a, s->file),
                             s->force ? "no sound, so its contact force: " : "", s->length, s->rate, s->channels,
                             s->channels == 1 ? "" : "s", plan_knobs_text(s->knobs, a)));
    if (s->excerpt > 0) {
        report_note(
            r, "",
            arena_format(a,
                         "An excerpt: knobs are chosen, errors and costs measured of its first %.3g s (motion.until) "
                         "out of %.3g s; --excerpt says how much.",
                         s->excerpt, s->whole));
        report_note(r, "", "What comes later may be faster, and err more.");
    }
    report_note(r, "", arena_format(a, "Errors are against a reference%s%s, %s.", *what ? " of " : "", what, own));
    if (isfinite(s->until))
        report_note(
            r, "",
            arena_format(a,
                         "It is chaotic: from %.2f s on, the reference and one half as fine are two sounds of one "
                         "kind. Samples are compared up to there; third octaves, spectra and levels after it; follows: "
                         "how long each goes with the reference. Those two, equally right, have spectra %.2g dB apart: "
                         "less is no merit.",
                         s->until, s->renders[s->near].error.spectral));
    for (int i = 0; i < s->n_renders; i++)
        if (s->renders[i].n_runs > 1 && !*how)
            how = arena_format(a, "the median of %d runs, and where it lies with %.0f %%", s->renders[i].n_runs,
                               100 * s->renders[i].covers);
    report_note(r, "",
                arena_format(a, "=: the scene as it is.%s CPU: %s. *: nothing is cheaper and better.",
                             s->single ? " total: all other knobs as the scene has them; alone: the others as the "
                                         "reference has them."
                                       : "",
                             *how ? how : "of one run"));
}

bool accuracy_report(const struct accuracy_sweep *s, struct err *e)
{
    const char *no = getenv("NO_COLOR");
    bool colour = isatty(STDOUT_FILENO) && (!no || !*no);
    struct report r = report_open(stdout, s->json);
    report_set(&r, "scene:s compared:s length_s:n rate_hz:n channels:i excerpt_s:n motion_s:n", s->file,
               s->force ? "force" : "sound", s->length, s->rate, s->channels, s->excerpt, s->whole);
    report_set(&r, "diverges_s:n reference_error_db:n reference:{", s->until, -s->own_db);
    for (int k = 0; k < KNOBS; k++)
        if (s->knobs & 1u << k)
            report_set(&r, "$:n", keys_knobs[k].name, accuracy_knob(&s->renders[s->reference].set, (enum knob)k));
    report_set(&r, "} settings:[");
    notes(&r, s);
    for (int i = 0; i < s->n_rows; i++) {
        const struct accuracy_row *w = &s->rows[i];
        if (i == 0 || (w->knob >= 0 && w[-1].knob < 0))
            text_heads(&r, s, w->knob >= 0);
        else if (strcmp(w->name, w[-1].name) != 0)
            report_text(&r, "\n");
        set_setting(&r, s, w);
        text_setting(&r, s, w, colour);
    }
    for (int i = 0; i < s->n_renders; i++)
        if (s->renders[i].code != 0 && s->renders[i].tried)
            report_text(&r, "exit %d with %s: %s\n", s->renders[i].code, accuracy_rows_name(s, i), s->renders[i].words);
    return report_close(&r, 9, e);
}

/* The picture of `rasp accuracy`: what a second of CPU time buys. A curve of asked errors, as measured, with the
   intervals of their times; the presets and the scene beside it; single knobs as curves of their own; the reference's
   own error as a grey line, below which no figure means much. Of a sound that diverges the error is that of its
   spectrum. Both axes are laid out here: labels that would overlap take another place. */

enum { WIDTH = 1000, HEIGHT = 640, TEXT = 13 };                         /* pixels */
static const double left = 0.085, right = 0.97, low = 0.1, high = 0.83; /* the plot within the page */

/* Okabe and Ito's set, told apart by colour-blind people too. */
static const char *const colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"};

struct picture {
    const struct accuracy_sweep *s;
    struct gnuplot *g;
    double x[2], y[2];  /* range of the axes: s (logarithmic), dB */
    double (*taken)[4]; /* pixels: from and to, across and up, [n] of points and labels */
    double (*lines)[4]; /* pixels: two ends of each straight piece of a curve, [n_lines] */
    int n, n_lines;
};

/* dB; settings that are the reference, or make its samples, have none. */
static bool shown(const struct accuracy_sweep *s, const struct accuracy_row *w, double *error)
{
    const struct accuracy_render *r = &s->renders[w->total];
    *error = accuracy_judge_error(s, r);
    return r->code == 0 && isfinite(*error) && w->total != s->reference;
}

/* Leading digits of labels, from few to many: the last set has three in whatever spans a factor of 2.25. */
static const double digits[3][15] = {{1}, {1, 2, 5}, {1, 1.2, 1.5, 2, 2.5, 3, 3.5, 4, 4.5, 5, 6, 7, 8, 9}};

int accuracy_report_tics(double from, double to, double tics[ACCURACY_REPORT_TICS])
{
    int n = 0;
    for (int set = 0; set < 3 && n < 3; set++) {
        n = 0;
        for (int e = (int)floor(real_log10(from)); e <= (int)ceil(real_log10(to)); e++)
            for (const double *d = digits[set]; *d > 0; d++) {
                double x = *d * real_pow(10, e);
                if (x >= from && x <= to && n < ACCURACY_REPORT_TICS) tics[n++] = x;
            }
    }
    return n;
}

static void put_axis(const struct picture *p, const char *axis, double from, double to)
{
    double tics[ACCURACY_REPORT_TICS];
    int n = accuracy_report_tics(fmin(from, to), fmax(from, to), tics);
    fprintf(p->g->in, "set logscale %s\nset %srange [%.6g:%.6g]\nset %stics (", axis, axis, from, to, axis);
    for (int i = 0; i < n; i++)
        fprintf(p->g->in, "%s'%.6g' %.6g", i ? ", " : "", tics[i], tics[i]);
    fputs(")\n", p->g->in);
}

/* A little more than what is shown, a factor of 2.25 and 10 dB at least; nothing shown: some range. */
static void put_axes(struct picture *p)
{
    const struct accuracy_sweep *s = p->s;
    double error;
    p->x[0] = p->y[0] = HUGE_VAL;
    p->x[1] = p->y[1] = -HUGE_VAL;
    for (int i = 0; i < s->n_rows; i++) {
        if (!shown(s, &s->rows[i], &error)) continue;
        const struct accuracy_render *r = &s->renders[s->rows[i].total];
        p->x[0] = fmin(p->x[0], fmax(r->cpu[0], 1e-6));
        p->x[1] = fmax(p->x[1], fmax(r->cpu[2], 1e-6));
        p->y[0] = fmin(p->y[0], error);
        p->y[1] = fmax(p->y[1], error);
    }
    if (!(p->x[1] > 0)) p->x[0] = p->x[1] = p->y[0] = p->y[1] = 1;
    p->x[0] /= 1.5;
    p->x[1] *= 1.8;
    double more = fmax(0.08 * (p->y[1] - p->y[0]), isfinite(s->until) ? 0.5 : 5);
    p->y[0] -= more;
    p->y[1] += more;
    put_axis(p, "x", p->x[0], p->x[1]);
    put_axis(p, "x2", s->length / p->x[0], s->length / p->x[1]);
    fprintf(p->g->in, "set yrange [%.6g:%.6g]\n", p->y[0], p->y[1]);
}

/* Pixels of a point. */
static void place(const struct picture *p, double x, double y, double at[2])
{
    at[0] = WIDTH * (left + (right - left) * real_log(x / p->x[0]) / real_log(p->x[1] / p->x[0]));
    at[1] = HEIGHT * (low + (high - low) * (y - p->y[0]) / (p->y[1] - p->y[0]));
}

static bool crosses(const double line[4], const double box[4])
{
    double length = fmax(fabs(line[2] - line[0]), fabs(line[3] - line[1]));
    for (double at = 0; at <= length; at += 2) {
        double x = line[0] + (line[2] - line[0]) * at / length, y = line[1] + (line[3] - line[1]) * at / length;
        if (x > box[0] - 1 && x < box[1] + 1 && y > box[2] - 1 && y < box[3] + 1) return true;
    }
    return false;
}

static bool is_free(const struct picture *p, const double box[4])
{
    bool ok = box[0] > WIDTH * left && box[1] < WIDTH * right && box[2] > HEIGHT * low && box[3] < HEIGHT * high;
    for (int i = 0; ok && i < p->n; i++)
        ok = box[0] > p->taken[i][1] || box[1] < p->taken[i][0] || box[2] > p->taken[i][3] || box[3] < p->taken[i][2];
    for (int i = 0; ok && i < p->n_lines; i++)
        ok = !crosses(p->lines[i], box);
    return ok;
}

/* Beside a point, right or left of it, higher or lower: the nearest place that is free. */
static void put_label(struct picture *p, double x, double y, const char *text, const char *colour)
{
    double at[2], wide = 7.5 * (double)strlen(text), box[4] = {0};
    place(p, x, y, at);
    for (int i = 0; i < 42; i++) {
        int step = i / 2;
        double up = (0.3 + (step % 2 ? 1 : -1) * ((step + 1) / 2) * 0.5) * TEXT;
        box[0] = i % 2 ? at[0] - 11 - wide : at[0] + 11;
        box[1] = box[0] + wide;
        box[2] = at[1] + up - 0.5 * TEXT;
        box[3] = box[2] + TEXT;
        if (is_free(p, box)) break;
    }
    memcpy(p->taken[p->n++], box, sizeof box);
    fputs("set label ", p->g->in);
    gnuplot_put_text(p->g, text);
    fprintf(p->g->in, " at screen %.5f, screen %.5f left noenhanced front font ',10' textcolor rgb '%s'\n",
            box[0] / WIDTH, 0.5 * (box[2] + box[3]) / HEIGHT, colour);
}

/* The end of the rows of one curve or kind. */
static int kind_end(const struct accuracy_sweep *s, int i)
{
    int end = i;
    while (end < s->n_rows && s->rows[end].knob == s->rows[i].knob &&
           (s->rows[i].knob >= 0 || (s->rows[end].name[0] == 'a') == (s->rows[i].name[0] == 'a')))
        end++;
    return end;
}

static bool is_asked(const struct accuracy_row *w) { return w->name[0] == 'a' && w->knob < 0; }

static void take_curves(struct picture *p)
{
    const struct accuracy_sweep *s = p->s;
    for (int i = 0, end; i < s->n_rows; i = end) {
        double at[2], before[2], error;
        bool first = true;
        end = kind_end(s, i);
        for (int k = i; k < end && (is_asked(&s->rows[i]) || s->rows[i].knob >= 0); k++) {
            if (!shown(s, &s->rows[k], &error)) continue;
            place(p, fmax(s->renders[s->rows[k].total].cpu[1], 1e-6), error, at);
            if (!first)
                memcpy(p->lines[p->n_lines++], (const double[4]){before[0], before[1], at[0], at[1]}, sizeof *p->lines);
            memcpy(before, at, sizeof before);
            first = false;
        }
    }
}

/* Names of the rows [i, end) that are that render, but for those before i: "-40, -60". */
static const char *names(const struct accuracy_sweep *s, int i, int end, int render)
{
    const char *text = "";
    for (; i < end; i++)
        if (s->rows[i].total == render && !(s->rows[i].knob >= 0 && s->rows[i].chosen))
            text = arena_format(s->call->arena, "%s%s%s", text, *text ? ", " : "",
                                *s->rows[i].value ? s->rows[i].value : "scene");
    return text;
}

void accuracy_report_plot(void *sweep, struct gnuplot *g)
{
    const struct accuracy_sweep *s = sweep;
    struct picture p = {.s = s,
                        .g = g,
                        .taken = (double(*)[4])ARENA_TAKE(s->call->arena, double, 8 * s->n_rows + 4),
                        .lines = (double(*)[4])ARENA_TAKE(s->call->arena, double, 4 * s->n_rows + 4)};
    const char *between = "plot ", *title = s->scene.title ? s->scene.title : s->file;
    bool own = isfinite(s->own_db);
    double error, at[2];
    int end, curve = 0;
    if (s->excerpt > 0) title = arena_format(s->call->arena, "%s (its first %.3g s)", title, s->excerpt);
    gnuplot_page(g, s->plot && text_ends(s->plot, ".svg"), WIDTH, HEIGHT);
    fprintf(g->in,
            "set lmargin at screen %g\nset rmargin at screen %g\nset bmargin at screen %g\nset tmargin at screen %g\n"
            "set grid linewidth 0.5 linecolor rgb '#dddddd'\nset key noenhanced inside right top opaque samplen 2\n"
            "set xtics nomirror\nset border 15\nset xlabel 'CPU time of the render / s'\n"
            "set x2label 'times real time'\n",
            left, right, low, high);
    gnuplot_put_setting(g, "title", title);
    fprintf(g->in, "set ylabel '%s'\n",
            isfinite(s->until) ? "log-spectral distance from the reference after divergence / dB"
                               : "measured error / dB (of the sound, below it)");
    put_axes(&p);
    own = own && -s->own_db > p.y[0] && -s->own_db < p.y[1];
    if (own) {
        fprintf(g->in, "own = %.6g\n", -s->own_db);
        place(&p, 1, -s->own_db, at);
        memcpy(p.taken[p.n++], (const double[4]){0, WIDTH, at[1] - 1, at[1] + 1}, sizeof *p.taken);
    }
    for (int i = 0; i < s->n_rows; i++) { /* points and their intervals */
        const struct accuracy_render *r = &s->renders[s->rows[i].total];
        double to[2];
        if (!shown(s, &s->rows[i], &error)) continue;
        place(&p, fmax(r->cpu[0], 1e-6), error, at);
        place(&p, fmax(r->cpu[2], 1e-6), error, to);
        memcpy(p.taken[p.n++], (const double[4]){at[0] - 6, to[0] + 6, at[1] - 5, at[1] + 5}, sizeof *p.taken);
    }
    take_curves(&p);
    for (int i = 0; i < s->n_rows; i = end, curve++) {
        end = kind_end(s, i);
        const char *colour = colours[curve % (int)(sizeof colours / sizeof *colours)];
        fprintf(g->in, "$b%d << END\n", i);
        for (int k = i; k < end; k++) {
            const struct accuracy_render *r = &s->renders[s->rows[k].total];
            if (!shown(s, &s->rows[k], &error)) continue;
            fprintf(g->in, "%.6g %.6g %.6g %.6g\n", fmax(r->cpu[1], 1e-6), error, fmax(r->cpu[0], 1e-6),
                    fmax(r->cpu[2], 1e-6));
        }
        fputs("END\n", g->in);
        for (int k = i; k < end; k++) {
            int first = i;
            while (s->rows[first].total != s->rows[k].total)
                first++;
            const char *text = names(s, i, end, s->rows[k].total);
            if (first == k && *text && shown(s, &s->rows[k], &error))
                put_label(&p, fmax(s->renders[s->rows[k].total].cpu[1], 1e-6), error, text, colour);
        }
    }
    curve = 0;
    for (int i = 0; i < s->n_rows; i = end, curve++) {
        int n = 0;
        end = kind_end(s, i);
        for (int k = i; k < end; k++)
            n += shown(s, &s->rows[k], &error);
        if (n == 0) continue;
        bool asked = is_asked(&s->rows[i]), curved = asked || s->rows[i].knob >= 0;
        fprintf(g->in,
                "%s$b%d using 1:2%s with %s linewidth 1.5 pointtype %d pointsize %s linecolor rgb '%s' title '%s'",
                between, i, curved ? "" : ":3:4", curved ? "linespoints" : "xerrorbars", curved ? 7 : 4,
                curved ? "0.8" : "1.4", colours[curve % (int)(sizeof colours / sizeof *colours)],
                asked                 ? "asked errors (accuracy.error)"
                : s->rows[i].knob < 0 ? "presets"
                                      : s->rows[i].name);
        between = ", ";
        if (asked)
            fprintf(g->in, ", $b%d using 1:2:3:4 with xerrorbars linewidth 1 pointtype 0 linecolor rgb '%s' notitle", i,
                    colours[0]);
    }
    if (own)
        fprintf(g->in,
                "%sown with lines linewidth 1 dashtype 2 linecolor rgb '#888888' title 'own error of the reference, at "
                "most'",
                between);
    fputs(own || *between == ',' ? "\n" : "plot NaN notitle\n", g->in);
}
