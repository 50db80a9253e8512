/* The mode table of `rasp modes extract`, and what of the sound goes into it.

   A microphone's pressure is, without the sizes of a radiator, taken as proportional to the acceleration of the
   surface, as of a small source: gains then hold what the way through the air did to each mode. With them each mode's
   gain is divided by a monopole's H(s), pressure over velocity (response/radiator_monopole.c). */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cmd/modes_extract.h"
#include "num/real.h"
#include "response/radiator_monopole.h"

static const double air_density = 1.204, air_speed = 343.2; /* kg/m^3, m/s: as output.listen has them by default */

static void divide(const struct radiator_monopole *r, int places, struct modes_extract_mode *m)
{
    double h[2], s[2] = {-m->decay, 2.0 * REAL_PI * m->frequency};
    radiator_monopole_at(r, s, h);
    double power = h[0] * h[0] + h[1] * h[1];
    for (int k = 0; k < places; k++) {
        double re = m->re[k], im = m->im[k];
        m->re[k] = (re * h[0] + im * h[1]) / power;
        m->im[k] = (im * h[0] - re * h[1]) / power;
        m->gain_se[k] /= sqrt(power);
    }
}

static double *copy(const double *x, int n, struct arena *a)
{
    double *y = ARENA_TAKE(a, double, n);
    memcpy(y, x, (size_t)n * sizeof *x);
    return y;
}

static void level(struct modes_extract *x)
{
    const struct modes_extract_given *g = &x->given;
    bool air = g->quantity == MODES_PRESSURE && isnan(g->radius);
    if (!g->force_channel && !g->impulse && x->n > 1)
        x->why_not = "no channel holds the force, so that gains at each place are those of a strike whose sound there "
                     "has the peak 1 and the onset 0, and hold the hammer's spectrum: places cannot be "
                     "compared with each other; --force-channel, or impulse responses with --impulse and one --delay "
                     "for all, keep what is between them";
    else if (!g->force_channel && !g->impulse)
        x->why_not = "no channel holds the force, so that gains are those of a strike whose sound's peak is 1, and "
                     "hold the hammer's spectrum";
    else if (air)
        x->why_not = "a microphone's pressure is taken as proportional to the surface's acceleration (--radius and "
                     "--distance would divide a monopole out)";
    else if (isnan(g->scale))
        x->why_not = g->impulse ? "--scale, what the file's full scale is, is not given"
                                : "--scale and --force-scale, what the channels' full scales are, are not given";
    if (air && !g->force_channel && !g->impulse)
        modes_extract_find_note(x, "a microphone's pressure is taken as proportional to the surface's acceleration "
                                   "(--radius and --distance would divide a monopole out)");
    x->physical = !x->why_not;
    if (x->why_not) modes_extract_find_note(x, arena_format(x->arena, "the level is relative: %s", x->why_not));
}

void modes_extract_write_radiation(struct modes_extract *x)
{
    const struct modes_extract_given *g = &x->given;
    bool divides = g->quantity == MODES_PRESSURE && !isnan(g->radius);
    struct radiator_monopole r =
        divides ? radiator_monopole(g->radius, g->distance, air_density, air_speed) : (struct radiator_monopole){0};
    x->quantity = g->quantity != MODES_PRESSURE ? g->quantity : divides ? MODES_VELOCITY : MODES_ACCELERATION;
    x->mode = ARENA_TAKE(x->arena, struct modes_extract_mode, x->components);
    for (int i = 0; i < x->components; i++) {
        struct modes_extract_mode *m = &x->mode[i];
        *m = x->heard[i];
        m->re = copy(m->re, x->n, x->arena);
        m->im = copy(m->im, x->n, x->arena);
        m->gain_se = copy(m->gain_se, x->n, x->arena);
        if (divides) divide(&r, x->n, m);
    }
    level(x);
}

/* ------------------------------------------------------------------ comments */

static void sources(FILE *f, const struct modes_extract *x)
{
    for (int k = 0; k < x->n; k++) {
        const struct modes_extract_place *p = &x->place[k];
        int used = 0;
        for (int i = 0; i < p->strikes.n; i++)
            used += !p->strikes.strike[i].left_out;
        fprintf(f, "# source %d: %s, sha256 %s\n", k + 1, p->name, p->hash);
        if (!x->given.impulse) fprintf(f, "# strikes %d: %d of %d used\n", k + 1, used, p->strikes.n);
    }
}

static void method(FILE *f, const struct modes_extract *x)
{
    fprintf(f, "# method: %s, then output error on DFT bins, %.6g to %.6g Hz at %g Hz\n",
            x->given.spectrogram ? "peaks of the power spectrogram" : "ESPRIT in sub-bands", x->low, x->high, x->rate);
    for (int k = 0; k < x->n; k++)
        fprintf(f, "# explained %d: %.4g of the energy in the band that does not follow the force at once\n", k + 1,
                x->place[k].explained);
    if (x->given.quantity == MODES_PRESSURE && !isnan(x->given.radius))
        fprintf(f, "# radiation: a monopole of %.9g m at %.9g m is divided out\n# radius_m: %.9g\n", x->given.radius,
                x->given.distance, x->given.radius);
}

/* "# error MODE.SLOPE: ...": se is the standard error by noise, se_between the standard deviation from strike to
 * strike. */
static void errors(FILE *f, const struct modes_extract *x)
{
    for (int i = 0; i < x->components; i++) {
        const struct modes_extract_mode *m = &x->mode[i];
        double gain = 0.0;
        for (int k = 0; k < x->n; k++)
            gain = fmax(gain, m->gain_se[k]);
        fprintf(
            f,
            "# error %d.%d: frequency_hz se %.3g se_between %.3g, decay_per_s se %.3g se_between %.3g, gain se %.3g\n",
            m->mode, m->slope, m->frequency_se, m->frequency_between, m->decay_se, m->decay_between, gain);
    }
}

static void comments(FILE *f, const struct modes_extract *x)
{
    fprintf(f, "# poles: shared\n# quantity: %s\n", modes_quantity_name(x->quantity));
    if (x->physical)
        fprintf(f, "# normalisation: (%s)/(N s), physical\n", modes_quantity_unit(x->quantity));
    else
        fprintf(f, "# normalisation: relative: %s\n", x->why_not);
    sources(f, x);
    method(f, x);
    errors(f, x);
    for (int k = 0; k < x->notes; k++)
        fprintf(f, "# note %d: %s\n", k + 1, x->note[k]);
}

/* ------------------------------------------------------------------ rows */

static double unsigned_zero(double v) { return v == 0.0 ? 0.0 : v; }

/* All slopes of a mode have the frequency of its first. */
static double frequency(const struct modes_extract *x, const struct modes_extract_mode *m)
{
    for (int i = 0; i < x->components; i++)
        if (x->mode[i].mode == m->mode && x->mode[i].slope == 1) return x->mode[i].frequency;
    return m->frequency;
}

static void row(FILE *f, const struct modes_extract *x, const struct modes_extract_mode *m, int k, bool slopes)
{
    const struct modes_extract_place *p = &x->place[k];
    double along = x->quantity == MODES_VELOCITY       ? m->im[k]
                   : x->quantity == MODES_ACCELERATION ? -m->re[k]
                                                       : m->re[k],
           sign = along < 0.0 ? -1.0 : 1.0;
    double gain = sign * sqrt(m->re[k] * m->re[k] + m->im[k] * m->im[k]),
           phase = gain != 0.0 ? real_atan2(sign * m->im[k], sign * m->re[k]) : 0.0;
    fprintf(f, "%d,%.9g,%.9g,%d,%.9g,%.9g,%.9g,%.9g", k + 1, unsigned_zero(p->x), unsigned_zero(p->y), m->mode,
            frequency(x, m), m->decay, unsigned_zero(gain), unsigned_zero(phase));
    if (slopes) fprintf(f, ",%d", m->slope);
    fputc('\n', f);
}

void modes_extract_write(FILE *f, const struct modes_extract *x)
{
    bool slopes = x->components > x->modes;
    comments(f, x);
    fprintf(f, "place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad%s\n", slopes ? ",slope" : "");
    for (int k = 0; k < x->n; k++)
        for (int i = 0; i < x->components; i++)
            row(f, x, &x->mode[i], k, slopes);
}
