/* The report of rasp surface info as text: one fact a line. */
#include <math.h>
#include <stdio.h>

#include "base/wrap.h"
#include "cmd/surface_info.h"

static const char *len(const struct surface_info *i, double x)
{
    return heightfile_doubt_length(x, i->arena);
}

static void print_size(const struct surface_info *i)
{
    const struct heightfile *h = &i->h;
    printf("  %-20s %s", "format", h->format);
    if (h->bits)
        printf(h->step > 0 ? ", integers of %d bits" : ", floating point of %d bits", h->bits == 24 ? 32 : h->bits == 53 ? 64 : h->bits);
    printf("%s%s%s\n", h->title ? ", \"" : "", h->title ? h->title : "", h->title ? "\"" : "");
    if (h->rows > 1) {
        printf("  %-20s map, %zu x %zu samples\n", "samples", h->columns, h->rows);
        printf("  %-20s %.4g mm x %.4g mm\n", "size", h->pitch_x * (double)h->columns * 1e3, h->pitch_y * (double)h->rows * 1e3);
        printf("  %-20s %.7g um x %.7g um\n", "pitch", h->pitch_x * 1e6, h->pitch_y * 1e6);
    } else {
        printf("  %-20s profile, %zu samples\n", "samples", h->columns);
        printf("  %-20s %.5g mm\n", "size", h->pitch_x * (double)h->columns * 1e3);
        printf("  %-20s %.7g um\n", "pitch", h->pitch_x * 1e6);
    }
    printf("  %-20s %zu", "missing points", h->holes);
    if (h->filled)
        printf(", and %zu filled", h->filled);
    putchar('\n');
}

static void print_levelling(const struct surface_info *i)
{
    static const char *const words[] = {"none", "mean", "plane"};
    const char *word = i->levelling == 2 && i->h.rows == 1 ? "line" : words[i->levelling];
    printf("  %-20s %s%s\n", "levelling", word, i->levelling ? " subtracted" : "");
    printf("  %-20s mean %s, slope %.4g um/mm", "as stored", len(i, i->tilt.mean), i->tilt.slope_x * 1e3);
    if (i->h.rows > 1)
        printf(" in x, %.4g um/mm in y", i->tilt.slope_y * 1e3);
    putchar('\n');
}

static void print_heights(const struct surface_info *i)
{
    const struct surface_heights *s = &i->heights;
    char letter = i->h.rows > 1 ? 'S' : 'R';
    printf("  %ca                   %s\n  %cq                   %s\n", letter, len(i, s->sa), letter, len(i, s->sq));
    if (!isnan(s->ssk))
        printf("  %csk                  %.4g\n  %cku                  %.4g\n", letter, s->ssk, letter, s->sku);
    printf("  %cz                   %s\n", letter, len(i, s->sz));
    printf("  %-20s %.4g", "rms slope", s->slope);
    printf(i->h.rows > 1 ? " in x, %.4g in y\n" : "\n", s->slope_y);
    printf("  %-20s %.4g 1/m", "rms curvature", s->curvature);
    printf(i->h.rows > 1 ? " in x, %.4g 1/m in y\n" : "\n", s->curvature_y);
}

static void print_steps(const struct surface_info *i)
{
    const struct surface_heights_steps *s = &i->steps;
    if (s->step == 0) {
        printf("  %-20s none seen (%zu of %zu heights are different)\n", "quantisation", s->levels, s->looked_at);
        return;
    }
    if (2.45 * s->noise < 0.01 / surface_info_alphas[SURFACE_INFO_ALPHAS - 1]) {
        printf("  %-20s steps of %.3g nm: nothing beside the limiter (curvature noise %.2g 1/m)\n", "quantisation", s->step * 1e9, s->noise);
        return;
    }
    printf("  %-20s steps of %.4g nm (%zu of %zu heights are different)\n", "quantisation", s->step * 1e9, s->levels, s->looked_at);
    printf("  %-20s %.3g 1/m, at the spline's knots %.3g 1/m:", "its curvature noise", s->noise, 2.45 * s->noise);
    for (int k = 0; k < SURFACE_INFO_ALPHAS; k++)
        printf("%s %.3g %% of the limiter's %g 1/m", k ? "," : "", 100 * s->noise * surface_info_alphas[k], 1 / surface_info_alphas[k]);
    putchar('\n');
}

static void print_band(const struct surface_info *i, int down)
{
    const struct surface_band *b = &i->band[down];
    const char *where = i->h.rows == 1 ? "" : down ? " in y" : " in x";
    char label[32];
    snprintf(label, sizeof label, "band limit%s", where);
    if (b->segments == 0) {
        printf("  %-20s unknown: %s\n", label, i->heights.sz > 0 ? "too few samples in a row without holes" : "flat");
        return;
    }
    if (isnan(b->limit))
        printf("  %-20s none below the Nyquist frequency, %.4g cycles/mm\n", label, b->nyquist * 1e-3);
    else
        printf("  %-20s %.4g cycles/mm (wavelength %s), where it %s; %.3g times oversampled\n", label, b->limit * 1e-3, len(i, 1 / b->limit),
               b->noise ? "meets the noise floor" : "is 80 dB down", b->nyquist / b->limit);
    double top = isnan(b->limit) ? b->nyquist : b->limit;
    printf("  %-20s %.4g kHz at 10 cm/s\n", "heard up to", top * 0.1e-3);
    snprintf(label, sizeof label, "spectrum%s", where);
    if (!isnan(b->exponent))
        printf("  %-20s falls as k^%.3g from %.4g to %.4g cycles/mm\n", label, b->exponent, b->from * 1e-3, b->to * 1e-3);
}

static void print_ends(const struct surface_info *i, int down)
{
    const struct surface_ends *s = &i->ends[down];
    const char *where = i->h.rows == 1 ? "" : down ? " in y" : " in x";
    char label[32];
    snprintf(label, sizeof label, "repeated%s", where);
    printf("  %-20s jumps by %s at the seam (neighbours differ by %s)\n", label, len(i, s->jump), len(i, s->step));
    snprintf(label, sizeof label, "mirrored%s", where);
    printf("  %-20s slope changes by %.3g at the ends\n", label, s->kink);
}

void surface_info_print(const struct surface_info *i)
{
    printf("%s\n", i->file);
    print_size(i);
    print_levelling(i);
    print_heights(i);
    print_steps(i);
    for (int down = 0; down < (i->h.rows > 1 ? 2 : 1); down++) {
        print_band(i, down);
        print_ends(i, down);
    }
    if (!isnan(i->period.peak))
        printf("  %-20s highest %.2f at %s (%zu samples)\n", "autocorrelation", i->period.peak, len(i, (double)i->period.lag * i->h.pitch_x),
               i->period.lag);
    for (int k = 0; k < i->n_notes; k++) {
        printf("  warning: ");
        wrap_print(stdout, i->notes[k], 11, "           ");
    }
}
