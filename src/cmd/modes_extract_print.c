/* The report of `rasp modes extract` on stdout. */
#include <math.h>
#include <stdio.h>

#include "cmd/modes_extract.h"
#include "num/real.h"

static const char *left_out(const struct modes_extract_place *p, int k)
{
    const struct strikes_one *v = &p->strikes.strike[k];
    return !isnan(p->response.explained[k]) ? v->doubled ? "doubled, both pulses divided out" : "" : v->clipped ? "left out: clipped" : v->doubled ? "left out: doubled" : "left out: unlike the others";
}

static void strikes(const struct modes_extract *x, const struct modes_extract_place *p)
{
    bool force = p->recording.force != NULL;
    printf("strikes: %d found, %d used\n%10s %12s %12s %10s\n", p->strikes.n, p->response.used, "onset_s", force ? "peak_force" : "peak_sound", force ? "momentum" : "",
           "explained");
    for (int k = 0; k < p->strikes.n; k++) {
        const struct strikes_one *v = &p->strikes.strike[k];
        printf("%10.4f %12.4g ", (double)v->onset / x->rate, v->peak);
        if (force)
            printf("%12.4g ", v->momentum);
        else
            printf("%12s ", "");
        if (isnan(p->response.explained[k]))
            printf("%10s ", "-");
        else
            printf("%9.1f%% ", 100.0 * p->response.explained[k]);
        printf("%s\n", left_out(p, k));
    }
    printf("response: %.4g s", (double)p->response.n / x->rate);
    if (force)
        printf(", force divided out from %.5g to %.5g Hz (regularisation %.2g), sound %.3g ms after the force", p->response.low, p->response.high, p->response.regularisation,
               1e3 * p->response.delay);
    putchar('\n');
}

static void place(const struct modes_extract *x, int k)
{
    const struct modes_extract_place *p = &x->place[k];
    printf("%s", p->shown);
    if (p->placed)
        printf(" at x = %.6g m, y = %.6g m", p->x, p->y);
    printf(": %g Hz, %.4g s\n", x->rate, (double)p->recording.n / x->rate);
    if (!x->given.impulse)
        strikes(x, p);
    printf("modes hold %.2f %% of the energy; noise %.3g rms\n", 100.0 * x->modes.explained[k], x->modes.noise[k]);
    printf("response to modes: third octaves %.2f dB (mean of %d), %.2f dB (worst, %g Hz); log-spectral distance %.2f dB\n", p->distance.third_octave_mean, p->distance.bands,
           p->distance.third_octave_worst, p->distance.worst_at, p->distance.log_spectral);
}

static void modes(const struct modes_extract *x)
{
    printf("%d mode%s between %.5g and %.5g Hz, median decay %.4g 1/s, by energy %.4g 1/s\n", x->modes.modes, x->modes.modes == 1 ? "" : "s", x->low, x->high, x->median_decay,
           x->median_by_energy);
    printf("%5s %13s %9s %11s %9s %12s %9s%s\n", "mode", "frequency_hz", "error", "t60_s", "error", "largest_gain", "error", x->modes.n > x->modes.modes ? "  slope" : "");
    for (int i = 0; i < x->modes.n; i++) {
        const struct ringing_mode *m = &x->modes.mode[i];
        double gain = -1.0, error = 0.0, t60 = 3.0 * real_log(10.0) / m->decay;
        for (int k = 0; k < x->n; k++) {
            double g = sqrt(m->re[k] * m->re[k] + m->im[k] * m->im[k]);
            error = g > gain ? m->gain_error[k] : error;
            gain = fmax(gain, g);
        }
        printf("%5d %13.7g %9.2g %11.4g %9.2g %12.5g %9.2g", m->mode, m->frequency, m->frequency_error, t60, t60 * m->decay_error / m->decay, gain, error);
        printf(x->modes.n > x->modes.modes ? "%7d\n" : "\n", m->slope);
    }
    if (x->physical)
        printf("gains in (%s)/(N s)\n", modes_quantity_unit(x->quantity));
    else
        printf("gains relative, of %s\n", modes_quantity_name(x->quantity));
}

void modes_extract_print(const struct modes_extract *x)
{
    for (int k = 0; k < x->n; k++)
        place(x, k);
    modes(x);
    if (x->notes)
        printf("warning%s:\n", x->notes == 1 ? "" : "s");
    for (int k = 0; k < x->notes; k++)
        printf("  %s\n", x->note[k]);
}
