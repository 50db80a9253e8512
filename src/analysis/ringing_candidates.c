/* One round's candidates: what is left of the response in bands (ringing_band.c), the poles of each (ringing_poles.c), those in the band's central half, and of what two
   bands find one. What each alone would take is |sum y[n] conj(zeta)^n|^2 / sum |zeta|^(2n), by Schwarz no more than the band holds: unlike the gains of all together, which cancel
   where poles are near each other, it ranks them. */
#include "analysis/ringing_candidates.h"

#include <math.h>
#include <stdlib.h>

#include "analysis/ringing_band.h"
#include "analysis/ringing_complex.h"
#include "analysis/ringing_poles.h"
#include "num/real.h"

#define REACH 1e-7     /* energy of a band's singular vector over the strongest band's: what is weaker waits until that is taken off, its alias is 80 dB down */
#define ABOVE 10.0     /* energy of it over rounding's */
#define MARGIN 0.05    /* of the half bands, which overlap by it */

static double band_energy(const struct ringing_band *b, int c)
{
    double sum = 0;
    const double complex *y = b->y + (long)c * b->places * b->n;
    for (long i = 0; i < b->places * b->n; i++)
        sum += creal(y[i]) * creal(y[i]) + cimag(y[i]) * cimag(y[i]);
    return sum;
}

static double taken(const struct ringing_band *b, int c, double complex zeta)
{
    double all = 0, size = sqrt(creal(zeta) * creal(zeta) + cimag(zeta) * cimag(zeta));
    if (size > 1)
        zeta /= size;
    for (int p = 0; p < b->places; p++) {
        const double complex *y = b->y + ((long)c * b->places + p) * b->n;
        double complex z = 1, sum = 0;
        double norm = 0;
        for (long i = 0; i < b->n; i++) {
            sum += ringing_complex_product(y[i], conj(z));
            norm += creal(z) * creal(z) + cimag(z) * cimag(z);
            z = ringing_complex_product(z, zeta);
        }
        all += (creal(sum) * creal(sum) + cimag(sum) * cimag(sum)) / norm;
    }
    return all;
}

/* A pole that grows by little, as noise makes it, begins as one that decays by little. */
static bool make(const struct ringing_candidates *s, const struct ringing_band *b, double rate, double complex zeta, struct ringing_candidate *c)
{
    double pole[2], length = (double)(b->n * b->decimation) / rate;
    double size = creal(zeta) * creal(zeta) + cimag(zeta) * cimag(zeta);
    if (!ringing_band_pole(b, c->band, rate, zeta, MARGIN, pole) || size < 0.01)
        return false;
    *c = (struct ringing_candidate){.decay = pole[0], .omega = pole[1], .energy = taken(b, c->band, zeta), .band = c->band};
    if (c->decay < 0.1 / length)
        c->decay = c->decay * length > -3 ? 0.1 / length : -1;
    return c->decay > 0 && c->decay < RINGING_FIT_FASTEST * rate && c->omega > s->low && c->omega < s->high;
}

/* Found in two bands. */
static bool known(const struct ringing_candidates *s, double length, const struct ringing_candidate *c)
{
    for (int i = s->n - 1; i >= 0 && s->list[i].band >= c->band - 1; i--) {
        double wide = 0.1 * (s->list[i].decay + c->decay) + 0.3 / length, x = s->list[i].decay - c->decay, y = s->list[i].omega - c->omega;
        if (s->list[i].band != c->band && x * x + y * y < wide * wide)
            return true;
    }
    return false;
}

static void band_search(struct ringing_candidates *s, const struct ringing *r, const struct ringing_band *b, int band, double least, int most)
{
    struct arena *a = arena_open();
    struct ringing_poles p;
    ringing_poles_decompose(b->y + (long)band * b->places * b->n, b->places, b->n, a, &p);
    int order = ringing_poles_order(&p, least);
    double complex *zeta = ARENA_TAKE(a, double complex, order + 1);
    order = ringing_poles_make(&p, order, a, zeta);
    for (int i = 0; i < order && s->n < most; i++) {
        struct ringing_candidate c = {.band = band};
        if (make(s, b, r->rate, zeta[i], &c) && !known(s, (double)r->n / r->rate, &c))
            s->list[s->n++] = c;
    }
    arena_close(a);
}

void ringing_candidates_find(const struct ringing_fit *f, const struct ringing_noise *noise, struct ringing_candidates *s, struct arena *a)
{
    const struct ringing *r = f->r;
    struct ringing_band b;
    const double **x = ARENA_TAKE(a, const double *, r->places);
    double greatest = 0, rounding = 0;
    int most = f->most - f->m;
    for (int p = 0; p < r->places; p++) {
        x[p] = f->residual + p * r->n;
        rounding += noise->least[p];
    }
    s->n = 0;
    s->list = ARENA_TAKE(a, struct ringing_candidate, most + 1);
    ringing_band_make(x, r->places, s->length, s->decimation, a, &b);
    for (int c = 0; c < b.bands; c++)
        greatest = fmax(greatest, band_energy(&b, c));
    for (int c = 0; c < b.bands && greatest > 0; c++) {
        double centre = REAL_PI * c * r->rate / s->decimation, half = REAL_PI * r->rate / s->decimation;
        if (centre + half >= s->low && centre - half <= s->high && s->n < most)
            band_search(s, r, &b, c, fmax(REACH * greatest * (double)(b.n / 3), ABOVE * rounding * (double)b.n), most);
    }
}

static int falling(const void *x, const void *y)
{
    double a = *(const double *)x, b = *(const double *)y;
    return (a < b) - (a > b);
}

void ringing_candidates_strongest(struct ringing_candidates *c, int room)
{
    if (c->n <= room)
        return;
    struct arena *a = arena_open();
    double *energy = ARENA_TAKE(a, double, c->n);
    for (int i = 0; i < c->n; i++)
        energy[i] = c->list[i].energy;
    qsort(energy, (size_t)c->n, sizeof *energy, falling);
    int kept = 0;
    for (int i = 0; i < c->n; i++)
        if (c->list[i].energy > energy[room])
            c->list[kept++] = c->list[i];
    c->n = kept;
    arena_close(a);
}
