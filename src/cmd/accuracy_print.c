/* The table of `rasp accuracy` for people: plain text, in colour on a terminal unless NO_COLOR is set (no-color.org). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/text.h"
#include "base/wrap.h"
#include "cmd/accuracy.h"
#include "num/real.h"
#include "pipeline/plan.h"
#include "scene/accuracy.h"
#include "scene/keys.h"

enum { BAR = 8 };

static bool coloured(void)
{
    const char *no = getenv("NO_COLOR");
    return isatty(STDOUT_FILENO) && (!no || !*no);
}

/* ------------------------------------------------------------------ what it is about */

static void say(const char *text)
{
    wrap_print(stdout, text, 0, "");
}

static const char *own_text(const struct accuracy_sweep *s)
{
    struct arena *a = s->call->arena;
    const char *parts = "";
    for (int k = 0; k < KNOBS; k++)
        if (s->own[k] > 0.0)
            parts = arena_format(a, "%s%s%s %.0f dB", parts, *parts ? ", " : "", keys_knobs[k].name, 20.0 * real_log10(s->own[k]));
    if (isfinite(s->until) || s->presets)
        return "Errors are against the preset reference.";
    if (isinf(s->own_db))
        return "Errors are against the preset reference, which has none that these knobs would show.";
    return arena_format(a, "Errors are against the preset reference, whose own is about %.0f dB (%s): of smaller ones (<) believe no more than that.", -s->own_db, parts);
}

static const char *divergence_text(const struct accuracy_sweep *s)
{
    return arena_format(s->call->arena, "It is chaotic: from %.2f s on, high and reference are two sounds of one kind. Samples are compared up to there (alone, total); third octaves, spectra "
                                        "and levels after it; follows: how long each goes with reference. high and reference, equally right, have spectra %.2g dB apart: less is no merit.",
                        s->until, s->renders[s->high].error.spectral);
}

static void print_head(const struct accuracy_sweep *s)
{
    struct arena *a = s->call->arena;
    say(arena_format(a, "%s: %s%.3f s, %.9g Hz, %d channel%s; turned by %s.", text_shown(a, s->file), s->force ? "no sound, so its contact force: " : "", s->length, s->rate, s->channels,
                     s->channels == 1 ? "" : "s", plan_knobs_text(s->knobs, a)));
    say(own_text(s));
    if (isfinite(s->until))
        say(divergence_text(s));
    say(arena_format(a, "total: all other knobs as the scene has them (=); alone: the others at reference. CPU: of the render, the least of %d run%s. *: nothing is cheaper and better.", s->runs,
                     s->runs == 1 ? "" : "s"));
    putchar('\n');
}

/* ------------------------------------------------------------------ cells */

static const char *bar(const struct accuracy_sweep *s, double share)
{
    int n = isfinite(share) ? (int)rint(BAR * fmin(fmax(share, 0.0), 1.0)) : BAR;
    return arena_format(s->call->arena, "%.*s%*s", n, "########", BAR - n, "");
}

static const char *error_text(const struct accuracy_sweep *s, const struct accuracy_render *r)
{
    if (r->code != 0)
        return arena_format(s->call->arena, "exit %d", r->code);
    if (r == &s->renders[s->reference])
        return "-";
    if (isnan(r->error.snr))
        return "none";
    return isfinite(r->error.snr) ? arena_format(s->call->arena, "%s%.1f dB", accuracy_judge_below(s, r) ? "<" : "", -r->error.snr) : "same bits";
}

static double most_snr(const struct accuracy_sweep *s)
{
    double most = 1.0;
    for (int i = 0; i < s->n_renders; i++)
        if (s->renders[i].code == 0 && isfinite(s->renders[i].error.snr))
            most = fmax(most, s->renders[i].error.snr);
    return most;
}

static double most_cpu(const struct accuracy_sweep *s)
{
    double most = 0.0;
    for (int i = 0; i < s->n_renders; i++)
        if (s->renders[i].timed && isfinite(s->renders[i].cpu))
            most = fmax(most, s->renders[i].cpu);
    return most;
}

static void print_columns(const struct accuracy_sweep *s)
{
    printf("%-24s  %10s %6s  %10s %-*s  %7s %8s", "", "alone", "order", "total", BAR, "", "3rd oct", "spectrum");
    if (isfinite(s->until))
        printf(" %8s %8s %8s", "level", "follows", "contact");
    printf("  %9s %-*s %7s  %9s\n", "CPU", BAR, "", "x real", "memory");
}

/* What a render sounds like, and what it costs. */
static void print_total(const struct accuracy_sweep *s, const struct accuracy_render *r)
{
    const struct accuracy_error *o = &r->error;
    printf("  %10s ", error_text(s, r));
    if (r->code != 0)
        return;
    printf("%s  %7.3f %8.3f", r == &s->renders[s->reference] ? bar(s, 1.0) : bar(s, isnan(o->snr) ? 0.0 : o->snr / most_snr(s)), o->third, o->spectral);
    if (isfinite(s->until))
        printf(" %8.2f %6.3f s %8s", o->level, o->follows, isnan(r->contact_share) ? "" : arena_format(s->call->arena, "%.1f %%", 100.0 * r->contact_share));
    printf("  %7.4f s %s %7.4g  %6.1f MB", r->cpu, bar(s, r->cpu / most_cpu(s)), o->length / fmax(r->cpu, 1e-9), r->peak / 1e6);
}

static void print_row(const struct accuracy_sweep *s, const struct accuracy_row *w, bool colour)
{
    const struct accuracy_render *r = &s->renders[w->total];
    const char *order = isnan(w->order) ? "" : arena_format(s->call->arena, "%.2f", w->order);
    printf("%s%-24s", colour && r->front ? "\033[1;32m" : "", arena_format(s->call->arena, "%c %s %s%s", w->chosen ? '=' : ' ', w->name, w->value, r->front ? " *" : ""));
    printf("  %10s %6s", w->alone >= 0 ? error_text(s, &s->renders[w->alone]) : "", order);
    print_total(s, r);
    printf("%s\n", colour && r->front ? "\033[0m" : "");
}

static void print_refused(const struct accuracy_sweep *s)
{
    for (int i = 0; i < s->n_renders; i++)
        if (s->renders[i].code != 0)
            printf("exit %d with %s: %s\n", s->renders[i].code, accuracy_rows_name(s, i), s->renders[i].words);
}

void accuracy_print(const struct accuracy_sweep *s)
{
    bool colour = coloured();
    print_head(s);
    print_columns(s);
    for (int i = 0; i < s->n_rows; i++) {
        if (i > 0 && strcmp(s->rows[i].name, s->rows[i - 1].name) != 0)
            putchar('\n');
        print_row(s, &s->rows[i], colour);
    }
    print_refused(s);
}
