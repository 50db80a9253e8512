/* What makes the estimates of `rasp analyse` doubtful. */
#include <math.h>

#include "cmd/analyse.h"
#include "num/real.h"

const char *analyse_notes_unknown(const struct analysis *a)
{
    const struct impact_events *v = &a->source.found.events;
    if (a->source.has_force)
        return "beside no maximum does the force fall to half of it";
    return isnan(v->duration[0]) ? "there is no column duration_s" : "all amplitudes are 0";
}

/* Are contact times what they seem? */
static void stretch_notes(struct analysis *a, const struct analyse_source *s)
{
    const struct impact_found *f = &s->found;
    if (f->feet == 0)
        analyse_note(a, "%s: no impact of 12 samples and more stands alone: contact times are taken as twice the widths at half height, as raised cosines have them", s->file);
    else if (f->feet < IMPACT_FEET_MANY)
        analyse_note(a, "%s: contact times rest on the ends of %ld impact%s: at least %d are wanted, and single merged ones may have spoilt them", s->file, f->feet,
                     f->feet == 1 ? "" : "s", IMPACT_FEET_MANY);
    if (f->stretch < 1.7 || f->stretch > 2.1)
        analyse_note(a, "%s: contact times come out as %.3g times the widths at half height, where raised cosines have 2 and Hertz's impacts 1.82: many of those that stand "
                        "alone are merged, or of another shape; zeta is as wrong as that", s->file, f->stretch);
}

/* Of raised cosines 1; of Hertz's impacts, to which a raised cosine is fitted, 1.1. */
void analyse_notes_shape(struct analysis *a)
{
    const struct impact_shape *h = &a->shape;
    if (h->fitted > 0 && (h->stretch < 0.95 || h->stretch > 1.15))
        analyse_note(a, "fitted raised cosines last %.3g times the contact times, where it is 1 if the impacts are raised cosines and 1.1 if they are Hertz's", h->stretch);
}

/* Runs of samples, 3 and more, that stand at x. */
static int levels(const struct impact_signal *s, double x)
{
    int runs = 0, length = 0;
    for (long i = 0; i < s->n; i++) {
        length = s->force[i] == x ? length + 1 : 0;
        runs += length == 3;
    }
    return runs;
}

/* A recording that clips stands still at its greatest value, again and again. */
static void clip_notes(struct analysis *a, const struct analyse_source *s)
{
    const struct impact_found *f = &s->found;
    int runs = levels(&s->signal, f->greatest) + (a->given.options.both ? levels(&s->signal, f->least) : 0);
    if (runs > 1)
        analyse_note(a, "%s: the force stands still at its greatest value, %.4g N, %d times, as where a recording clips: how strong those impacts were is lost, and theta with it",
                     s->file, f->greatest, runs);
}

void analyse_notes_force(struct analysis *a, const struct analyse_source *s)
{
    const struct impact_found *f = &s->found;
    const struct impact_events *v = &f->events;
    double n = v->n, samples = 0, known = 0;
    if (!a->given.options.both && f->least < -0.3 * f->greatest)
        analyse_note(a, "%s: the force falls to %.4g N: only impacts above 0 are looked for unless --signed is given", s->file, f->least);
    for (int i = 0; i < v->n; i++)
        if (!isnan(v->duration[i])) {
            samples += real_log(v->duration[i] * s->signal.rate);
            known++;
        }
    if (known > 0 && real_exp(samples / known) < 6)
        analyse_note(a, "%s: impacts last %.2g samples: the low-pass of the sample rate widens them, and its ripples may count as impacts: use a higher rate, or "
                        "raise --prominence to 0.25", s->file, real_exp(samples / known));
    if ((double)f->ripples > 10 * n)
        analyse_note(a, "%s: %ld maxima are left out as not prominent, against %.0f impact%s: a force that ripples without falling between, as of a contact that never "
                        "parts, is no series of impacts; a lower --prominence takes the ripples", s->file, f->ripples, n, v->n == 1 ? "" : "s");
    if ((double)f->touching > 0.05 * n)
        analyse_note(a, "%s: %.0f %% of the impacts run into a neighbour: amplitudes and widths are those of sums", s->file, 100 * (double)f->touching / n);
    if ((double)f->merged > 0.01 * n)
        analyse_note(a, "%s: %.1f %% of the impacts have a shoulder: two that made one maximum, and were taken as one", s->file, 100 * (double)f->merged / n);
    clip_notes(a, s);
    stretch_notes(a, s);
}

/* A force in which one maximum, of which the threshold is a share, hides the others. */
static void hidden_note(struct analysis *a)
{
    const struct impact_found *f = &a->source.found;
    if (f->events.n < STATISTICS_LEAST && f->low >= STATISTICS_LEAST)
        analyse_note(a, "%s: %ld maxima lie below the threshold, %.3g of the greatest force, %.4g N. If they are the impacts, it outweighs them all: is it one? Leave it out of the file, or lower "
                        "--threshold", a->source.file, f->low, a->given.options.threshold, fmax(f->greatest, a->given.options.both ? -f->least : 0));
}

void analyse_notes_outlier(struct analysis *a)
{
    const struct impact_events *v = &a->source.found.events;
    double squares = 0;
    int most = 0;
    hidden_note(a);
    for (int i = 1; i < v->n; i++)
        most = fabs(v->amplitude[i]) > fabs(v->amplitude[most]) ? i : most;
    for (int i = 0; i < v->n; i++)
        squares += i == most ? 0 : v->amplitude[i] / v->amplitude[most] * (v->amplitude[i] / v->amplitude[most]);
    if (v->n >= STATISTICS_LEAST && squares < 1)
        analyse_note(a, "%s: one impact, of %.4g N at %.6g s, outweighs all others together: the amplitudes' mean, deviation and filter are its own. Is it one? Leave it out of the file",
                     a->source.file, v->amplitude[most], v->time[most]);
}

void analyse_notes_statistics(struct analysis *a)
{
    for (int i = 0; i < STATISTICS_WARNINGS && a->statistics.warnings[i]; i++)
        analyse_note(a, "%s", a->statistics.warnings[i]);
}
