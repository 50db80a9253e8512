/* From a fit to the modes that are told of. Left out: the constant; what lies outside the band that was asked for; and hums (ringing_hums.c), which stay in the
   fit: they are told of in a note. */
#include "analysis/ringing_report.h"

#include <math.h>
#include <stdlib.h>

#include "analysis/ringing_blocks.h"
#include "analysis/ringing_hums.h"
#include "analysis/ringing_select.h"
#include "num/real.h"

enum { SHORTEST = 32, TOLD = 5 /* hums, one by one */ };

bool ringing_report_check(const struct ringing *r, const struct ringing_options *o, bool *silent, struct err *e)
{
    *silent = true;
    if (r->places < 1 || r->n < SHORTEST || !(r->rate > 0))
        return err_set(e, ERR_SCENE, "a response of %ld samples is too short to find modes in: at least %d are needed", r->n, SHORTEST);
    if (o->most < 1)
        return err_set(e, ERR_SCENE, "%d modes cannot be looked for: ask for 1 or more", o->most);
    for (int p = 0; p < r->places; p++)
        for (long i = 0; i < r->n; i++) {
            if (!isfinite(r->h[p][i]))
                return err_set(e, ERR_NUMBERS, "sample %ld of response %d is not finite", i, p + 1);
            *silent = *silent && r->h[p][i] == 0;
        }
    return true;
}

void ringing_report_silent(const struct ringing *r, struct arena *a, struct ringing_modes *m)
{
    *m = (struct ringing_modes){.explained = ARENA_TAKE(a, double, r->places), .noise = ARENA_TAKE(a, double, r->places)};
    m->note = "the response is silent: every sample is 0";
}

struct group {           /* components of one mode */
    int first, second;   /* of the fit; second -1: none */
    double energy;
};

static double energy_of(const struct ringing_fit *f, int i)
{
    double sum = 0;
    for (int p = 0; p < f->r->places; p++) {
        double complex b = f->gain[(long)p * f->most + i];
        sum += creal(b) * creal(b) + cimag(b) * cimag(b);
    }
    return f->decay[i] > 0 ? sum / (4 * f->decay[i]) : HUGE_VAL;
}

static int by_energy(const void *x, const void *y)
{
    const struct group *a = x, *b = y;
    return a->energy > b->energy ? -1 : a->energy < b->energy ? 1 : a->first - b->first;
}

/* A line for each that does not decay: rms where it is strongest, and against the whole response there. */
static const char *hums_note(const struct ringing_fit *f, const double band[2], const enum ringing_hums_kind *kind, struct arena *a)
{
    const char *note = NULL;
    int n = 0;
    for (int i = 1; i < f->m; i++) {
        double hertz = f->omega[i] / (2 * REAL_PI), rms = 0, share = 0;
        if (f->held[i] || hertz < band[0] || hertz > band[1] || kind[i] != RINGING_HUMS_HUM || ++n > TOLD)
            continue;
        for (int p = 0; p < f->r->places; p++) {
            double complex b = f->gain[(long)p * f->most + i];
            double here = sqrt((creal(b) * creal(b) + cimag(b) * cimag(b)) / 2), all = 0;
            for (long k = 0; k < f->r->n; k++)
                all += f->r->h[p][k] * f->r->h[p][k] / (double)f->r->n;
            share = here > rms ? here / sqrt(all) : share;
            rms = fmax(rms, here);
        }
        note = arena_format(a, "%s%s%.4g Hz does not decay by more than chance (rms %.3g, %.1f dB of the response's): taken for a hum, left out", note ? note : "", note ? "\n" : "",
                            hertz, rms, 20 * real_log10(share));
    }
    return n > TOLD ? arena_format(a, "%s\n%d more that do not decay are left out", note, n - TOLD) : note;
}

/* Modes whose decay is not known. */
static const char *vague_note(const struct ringing_fit *f, const double band[2], const struct ringing_fit_errors *e, const enum ringing_hums_kind *kind, struct arena *a)
{
    const char *note = NULL;
    for (int i = 1; i < f->m; i++) {
        double hertz = f->omega[i] / (2 * REAL_PI);
        if (kind[i] == RINGING_HUMS_MODE && hertz >= band[0] && hertz <= band[1])
            note = arena_format(a, "%s%s%.5g Hz decays by no more than chance (%.2g 1/s, standard error %.2g), but is no hum, as the noise before the strikes does not hold it; the table has at least that error as its decay", note ? note : "",
                                note ? "\n" : "", hertz, f->decay[i], e->decay[i]);
    }
    return note;
}

/* Their decay is at least its standard error, or they would ring for ever; the gains follow. */
static bool vague_bound(struct ringing_fit *f, const struct ringing_fit_errors *e, const enum ringing_hums_kind *kind)
{
    bool any = false;
    for (int i = 1; i < f->m; i++)
        if (kind[i] == RINGING_HUMS_MODE && f->decay[i] < e->decay[i]) {
            f->decay[i] = e->decay[i];
            any = true;
        }
    if (any) {
        ringing_blocks_renew(f);
        ringing_blocks_gains(f);
    }
    return any;
}

/* The sum of its slopes' sounds, together, is what a mode's energy is: here the sum of each alone, which is what the mode table is sorted by. */
static int groups_make(const struct ringing_fit *f, double low, double high, const enum ringing_hums_kind *kind, struct group *g)
{
    int n = 0;
    for (int i = 1; i < f->m; i++) {
        double hertz = f->omega[i] / (2 * REAL_PI);
        if (f->tie[i] >= 0 || f->held[i] || hertz < low || hertz > high || kind[i] > RINGING_HUMS_MODE)
            continue;
        g[n] = (struct group){i, -1, energy_of(f, i)};
        for (int k = 1; k < f->m; k++)
            if (f->tie[k] == i && kind[k] <= RINGING_HUMS_MODE) {
                g[n].second = k;
                g[n].energy += energy_of(f, k);
            }
        n++;
    }
    qsort(g, (size_t)n, sizeof *g, by_energy);
    return n;
}

static void mode_fill(const struct ringing_fit *f, const struct ringing_fit_errors *e, int i, struct arena *a, struct ringing_mode *m)
{
    int places = f->r->places;
    *m = (struct ringing_mode){.frequency = f->omega[i] / (2 * REAL_PI), .decay = f->decay[i], .frequency_error = e->omega[i] / (2 * REAL_PI),
                               .decay_error = e->decay[i], .energy = energy_of(f, i)};
    m->re = ARENA_TAKE(a, double, places);
    m->im = ARENA_TAKE(a, double, places);
    m->gain_error = ARENA_TAKE(a, double, places);
    for (int p = 0; p < places; p++) {
        double complex b = f->gain[(long)p * f->most + i]; /* Re B e^(s t) = Im j B e^(s t) */
        m->re[p] = -cimag(b);
        m->im[p] = creal(b);
        m->gain_error[p] = e->gain[p * f->m + i];
    }
}

/* The share of the energy in the band that is explained, and the noise: that of the channel, or of what is left in the response's second half. */
static void shares_make(const struct ringing_fit *f, const double band[2], struct arena *a, struct ringing_modes *m)
{
    const struct ringing *r = f->r;
    double *y = ARENA_TAKE(a, double, r->n), *h = ARENA_TAKE(a, double, r->n);
    long half = r->n / 2;
    for (int p = 0; p < r->places; p++) {
        ringing_sound(m, p, r->rate, r->n, y);
        for (long i = 0; i < r->n; i++) {
            h[i] = r->h[p][i] - creal(f->gain[(long)p * f->most]); /* without the constant */
            y[i] = h[i] - y[i];
        }
        bool given = r->noise && r->noise_n >= 64;
        double left = ringing_noise_energy(y, r->n, r->rate, band), all = ringing_noise_energy(h, r->n, r->rate, band);
        double noise = given ? ringing_noise_energy(r->noise[p], r->noise_n, r->rate, band) / (double)r->noise_n
                             : ringing_noise_energy(f->residual + p * r->n + half, r->n - half, r->rate, band) / (double)(r->n - half);
        m->noise[p] = sqrt(noise);
        noise *= (double)r->n;
        m->explained[p] = all > noise ? 1 - fmax(left - noise, 0) / (all - noise) : 0;
    }
}

void ringing_report(struct ringing_fit *f, const struct ringing_noise *noise, const struct ringing_options *o, struct arena *a, struct ringing_modes *m)
{
    struct arena *inner = arena_open();
    struct ringing_fit_errors e, told; /* told: with all of the response's own error */
    struct ringing_noise all = *noise;
    struct group *g = ARENA_TAKE(inner, struct group, f->m);
    double low = fmax(o->low, f->r->low), high = f->r->high > 0 ? f->r->high : f->r->rate / 2;
    if (o->high > 0)
        high = fmin(high, o->high);
    *m = (struct ringing_modes){.explained = ARENA_TAKE(a, double, f->r->places), .noise = ARENA_TAKE(a, double, f->r->places)};
    all.doubt = 1;
    ringing_select_errors(f, noise, inner, &e);
    ringing_select_errors(f, &all, inner, &told);
    enum ringing_hums_kind *kind = ARENA_TAKE(inner, enum ringing_hums_kind, f->m);
    ringing_hums_kinds(f, noise, &e, kind);
    if (vague_bound(f, &e, kind))
        ringing_select_errors(f, &all, inner, &told);
    int n = groups_make(f, low, high, kind, g);
    m->modes = n < o->most ? n : o->most;
    m->mode = ARENA_TAKE(a, struct ringing_mode, 2 * m->modes);
    for (int i = 0; i < m->modes; i++)
        for (int s = 0; s < (g[i].second >= 0 ? 2 : 1); s++) {
            struct ringing_mode *to = &m->mode[m->n++];
            mode_fill(f, &told, s ? g[i].second : g[i].first, a, to);
            to->mode = i + 1;
            to->slope = s + 1;
        }
    shares_make(f, (const double[]){low, high}, inner, m);
    const char *hums = hums_note(f, (const double[]){low, high}, kind, a), *vague = vague_note(f, (const double[]){low, high}, &e, kind, a);
    hums = hums && vague ? arena_format(a, "%s\n%s", hums, vague) : hums ? hums : vague;
    const char *line = hums ? "\n" : "";
    hums = hums ? hums : "";
    m->note = *hums ? hums : NULL;
    if (n > m->modes)
        m->note = arena_format(a, "%d more modes than the %d strongest were found%s%s", n - m->modes, m->modes, line, hums);
    else if (n == 0)
        m->note = arena_format(a, "no mode stands above the noise%s%s", line, hums);
    arena_close(inner);
}
