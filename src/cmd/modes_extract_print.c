/* The report of `rasp modes extract` on stdout. */
#include <math.h>
#include <stdio.h>

#include "cmd/modes_extract.h"
#include "num/real.h"

static void strikes(const struct modes_extract *x, const struct modes_extract_place *p)
{
    bool force = p->recording.force.x != NULL;
    int used = 0;
    for (int k = 0; k < p->strikes.n; k++)
        used += !p->strikes.strike[k].left_out;
    printf("strikes: %d found, %d used\n%6s %10s %12s %12s %10s\n", p->strikes.n, used, "strike", "onset_s",
           force ? "peak_force" : "peak_sound", force ? "momentum" : "", "explained");
    for (int k = 0; k < p->strikes.n; k++) {
        const struct strikes_one *v = &p->strikes.strike[k];
        double explained = modes_extract_find_explained(x, p, k);
        printf("%6d %10.4f %12.4g ", k + 1, (double)v->onset / x->rate, v->peak);
        printf("%12s %10s ", force ? arena_format(x->arena, "%.4g", v->momentum) : "",
               isnan(explained) ? "-" : arena_format(x->arena, "%.1f%%", 100.0 * explained));
        printf("%s%s\n", v->left_out ? "left out: " : v->doubled ? "doubled" : "", v->left_out ? v->left_out : "");
    }
    if (force) printf("force: up to %.5g Hz, sound %.3g ms after it\n", p->high, 1e3 * p->delay);
}

static void place(const struct modes_extract *x, int k)
{
    const struct modes_extract_place *p = &x->place[k];
    printf("%s", p->shown);
    if (p->placed) printf(" at x = %.6g m, y = %.6g m", p->x, p->y);
    printf(": %g Hz, %.4g s\n", x->rate, (double)p->recording.n / x->rate);
    if (!x->given.impulse) strikes(x, p);
    printf("modes explain %.2f %% of the energy that does not follow the force at once; noise %.3g rms\n",
           100.0 * p->explained, p->noise);
    if (!isnan(p->predicted)) printf("and %.2f %% of the strikes that were not fitted\n", 100.0 * p->predicted);
    printf(
        "strike to modes: third octaves %.2f dB (mean of %d), %.2f dB (worst, %g Hz); log-spectral distance %.2f dB\n",
        p->distance.third_octave_mean, p->distance.bands, p->distance.third_octave_worst, p->distance.worst_at,
        p->distance.log_spectral);
}

static void modes(const struct modes_extract *x)
{
    printf("%d mode%s between %.5g and %.5g Hz, median decay %.4g 1/s, by energy %.4g 1/s\n", x->modes,
           x->modes == 1 ? "" : "s", x->low, x->high, x->median_decay, x->median_by_energy);
    printf("%5s %13s %9s %10s %11s %9s %10s %12s %9s%s\n", "mode", "frequency_hz", "se", "se_between", "t60_s", "se",
           "se_between", "largest_gain", "se", x->components > x->modes ? "  slope" : "");
    for (int i = 0; i < x->components; i++) {
        const struct modes_extract_mode *m = &x->mode[i];
        double gain = -1.0, se = 0.0, t60 = 3.0 * real_log(10.0) / m->decay;
        for (int k = 0; k < x->n; k++) {
            double g = sqrt(m->re[k] * m->re[k] + m->im[k] * m->im[k]);
            se = g > gain ? m->gain_se[k] : se;
            gain = fmax(gain, g);
        }
        printf("%5d %13.7g %9.2g %10.2g %11.4g %9.2g %10.2g %12.5g %9.2g", m->mode, m->frequency, m->frequency_se,
               m->frequency_between, t60, t60 * m->decay_se / m->decay, t60 * m->decay_between / m->decay, gain, se);
        printf(x->components > x->modes ? "%7d\n" : "\n", m->slope);
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
    if (x->notes) printf("warning%s:\n", x->notes == 1 ? "" : "s");
    for (int k = 0; k < x->notes; k++)
        printf("  %s\n", x->note[k]);
}
