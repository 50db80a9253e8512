/* The report of `rasp analyse` as text. */
#include <math.h>
#include <stdio.h>

#include "base/wrap.h"
#include "cmd/analyse.h"

/* Intervals are shown in ms. */
static double shown(int series, double x)
{
    return series == STATISTICS_AMPLITUDE ? x : 1e3 * x;
}

static const char *plural(long n)
{
    return n == 1 ? "" : "s";
}

static void line(const char *name)
{
    printf("  %-22s ", name);
}

/* ------------------------------------------------------------------ what was found */

static void print_force(const struct analyse_source *s, long which)
{
    const struct impact_found *f = &s->found;
    char channel[40] = "";
    if (s->channels > 1)
        snprintf(channel, sizeof channel, ", channel %ld of %d", which, s->channels);
    printf("%s: a force, %s%s, %.6g s at %.6g Hz, from %.4g to %.4g N\n", s->file, s->kind, channel, (double)s->signal.n / s->signal.rate, s->signal.rate, f->least,
           f->greatest);
    line("impacts");
    printf("%d: %ld stand%s alone, %ld run%s into a neighbour, %ld with a shoulder\n", f->events.n, f->alone, f->alone == 1 ? "s" : "", f->touching,
           f->touching == 1 ? "s" : "", f->merged);
    line("left out");
    printf("%ld maxim%s below the threshold, %ld that %s not prominent\n", f->low, f->low == 1 ? "um" : "a", f->ripples, f->ripples == 1 ? "is" : "are");
    line("contact time");
    if (f->feet)
        printf("%.4g times the width at half height (of %ld impact%s; 2: raised cosines, 1.82: Hertz's)\n", f->stretch, f->feet, plural(f->feet));
    else
        printf("taken as twice the width at half height, as of raised cosines (none stands alone, or all are short)\n");
}

static void print_source(const struct analyse_source *s, long which)
{
    const struct impact_events *v = &s->found.events;
    if (s->has_force)
        print_force(s, which);
    else {
        printf("%s: %d impact%s in %.6g s", s->file, v->n, plural(v->n), v->time[v->n - 1] - v->time[0]);
        if (s->found.touching)
            printf(", %ld run%s into the one before", s->found.touching, s->found.touching == 1 ? "s" : "");
        putchar('\n');
    }
}

/* ------------------------------------------------------------------ statistics */

static void print_estimates(const struct analysis *a, const char *name, size_t offset)
{
    line(name);
    for (int k = 0; k < STATISTICS_SERIES; k++) {
        const struct estimate *x = (const void *)((const char *)&a->statistics.series[k] + offset);
        double scale = offset == offsetof(struct series_statistics, a1) || offset == offsetof(struct series_statistics, b1) ? 1 : shown(k, 1);
        char text[64];
        snprintf(text, sizeof text, "%.4g (%.4g to %.4g)", scale * x->value, scale * x->low, scale * x->high);
        printf(k ? "%s\n" : "%-33s ", text);
    }
}

#define PRINT_PAIR(name, format, ...)                                          \
    do {                                                                       \
        line(name);                                                            \
        for (int k = 0; k < STATISTICS_SERIES; k++) {                          \
            const struct series_statistics *s = &a->statistics.series[k];      \
            char text[64];                                                     \
            snprintf(text, sizeof text, format, __VA_ARGS__);                  \
            if (s->flat)                                                       \
                snprintf(text, sizeof text, "all alike");                      \
            printf(k ? "%s\n" : "%-33s ", text);                                \
        }                                                                      \
    } while (0)

static void print_distributions(const struct analysis *a)
{
    PRINT_PAIR("  skewness, kurtosis", "%.3g, %.3g", s->white.skewness, s->white.kurtosis);
    PRINT_PAIR("  normal", "R2 %.3f, distance %.3f%s", s->white.gaussian_r2, s->white.gaussian_distance, analyse_tabled(a, k) ? ": table" : "");
    PRINT_PAIR("series, normal", "R2 %.3f, distance %.3f", s->itself.gaussian_r2, s->itself.gaussian_distance);
    PRINT_PAIR("  exponential", isnan(s->itself.exponential_mean) ? "no values above 0" : "mean %.4g, distance %.3f", shown(k, s->itself.exponential_mean), s->itself.exponential_distance);
    PRINT_PAIR("  gamma", isnan(s->itself.gamma_shape) ? "values below 0" : "%.3g x %.3g, distance %.3f", s->itself.gamma_shape,
               shown(k, s->itself.gamma_scale), s->itself.gamma_distance);
}

static void print_statistics(const struct analysis *a)
{
    const struct impact_statistics *t = &a->statistics;
    const struct impact_modulation *m = &t->modulation;
    putchar('\n');
    line("");
    printf("%-33s %s\n", "amplitude / N", "interval / ms");
    print_estimates(a, "mean", offsetof(struct series_statistics, mean));
    PRINT_PAIR("standard deviation", "%.4g", shown(k, sqrt(s->variance)));
    print_estimates(a, "a1", offsetof(struct series_statistics, a1));
    print_estimates(a, "b1", offsetof(struct series_statistics, b1));
    print_estimates(a, "white: deviation", offsetof(struct series_statistics, deviation));
    PRINT_PAIR("  whiteness", "Q %.3g, p %.3g", s->whiteness, s->whiteness_p);
    print_distributions(a);
    line("one process");
    if (isnan(t->one_process))
        puts("not told: a series is constant");
    else
        printf("%s: the whitened series' correlation by ranks is %.3f\n", analyse_one_process(a) ? "yes" : "no", t->one_process);
    line("modulation");
    if (m->found)
        printf("depth %.3g at %.4g Hz\n", m->depth, m->rate);
    else if (!m->looked)
        puts("not looked for");
    else if (m->depth == 0)
        puts("none");
    else
        printf("none (the strongest: depth %.3g at %.4g Hz, as strong by chance with probability %.2g)\n", m->depth, m->rate, m->probability);
}

/* ------------------------------------------------------------------ durations and shapes */

static void print_law(const struct impact_duration *d, const char *whose)
{
    printf("%.4g ms", 1e3 * d->zeta_single);
    if (isnan(d->r2_single))
        printf(", all alike");
    else
        printf(" A^%.4f (+- %.4f), R2 %.4f, of its logarithm %.4f", -d->theta_single, d->theta_error, d->r2_single, d->r2_single_log);
    printf(", over %ld impact%s: %s\n", d->singles, plural(d->singles), whose);
}

static void print_duration(const struct analysis *a)
{
    static const char *const from[] = {[ANALYSE_THETA_GIVEN] = "", [ANALYSE_THETA_FILE] = "single impacts",
                                       [ANALYSE_THETA_ALONE] = "those that stand alone", [ANALYSE_THETA_NONE] = ""};
    const struct impact_duration *d = &a->duration;
    const char *whose = a->theta == ANALYSE_THETA_ALONE && !a->source.has_force ? "all" : from[a->theta];
    if (!a->lasts)
        return;
    putchar('\n');
    line("duration, step 1");
    if (d->singles && a->theta != ANALYSE_THETA_NONE)
        print_law(d, whose);
    else
        printf("theta %.4g, %s\n", d->theta, a->theta == ANALYSE_THETA_GIVEN ? "given" : "since it cannot be told");
    line("duration, step 2");
    printf("%.4g ms", 1e3 * d->zeta);
    if (d->theta > 0)
        printf(" A^-%.4f, A in N, R2 %.4f, of its logarithm %.4f", d->theta, d->r2, d->r2_log);
    printf(a->constant ? ", the median of %ld impact%s\n" : ", over %ld impact%s\n", d->n, plural(d->n));
}

static void print_shape(const struct analysis *a)
{
    const struct impact_shape *h = &a->shape;
    if (!a->source.has_force)
        return;
    if (h->fitted == 0) {
        line("shape");
        printf("no impact of %d to %d samples stands alone, to be fitted\n", IMPACT_SHAPE_LEAST, IMPACT_SHAPE_LONGEST);
        return;
    }
    line("raised cosine");
    printf("median R2 %.4f (of %ld impact%s; 5 %%: below %.4f, 95 %%: below %.4f), %.4g times the contact time\n", h->r2[0][1], h->fitted, plural(h->fitted),
           h->r2[0][0], h->r2[0][2], h->stretch);
    line("Meixner window");
    printf("median R2 %.4f (5 %%: below %.4f, 95 %%: below %.4f), ", h->r2[1][1], h->r2[1][0], h->r2[1][2]);
    printf(h->b < 1e4 ? "b %.4g, xi %.4g\n" : "at its limit of large b (xi -> 0)\n", h->b, h->xi);
}

void analyse_print(const struct analysis *a)
{
    print_source(&a->source, a->given.channel);
    if (a->single.file)
        print_source(&a->single, a->given.channel);
    if (a->counted)
        print_statistics(a);
    print_duration(a);
    print_shape(a);
    for (int i = 0; i < a->n_notes; i++) {
        fputs(i ? "" : "\n", stdout);
        fputs("  note: ", stdout);
        wrap_print(stdout, a->notes[i], 8, "        ");
    }
    for (int i = 0; i < a->n_written; i++)
        printf("%s%s\n", i ? "" : "\nwritten:\n", a->written[i]);
}
