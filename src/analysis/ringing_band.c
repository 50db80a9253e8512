/* Heterodyne, low-pass and decimation into D + 1 bands at once:

     y_c[n] = sum_m g[m] h[n D + m] e^(-j pi c m/D),   m = 0..10 D - 1,   c = 0..D,

   a short-time Fourier transform of hop D and length 2 D, the window folded to 2 D. The low-pass filter g is a sinc with its edge at pi/D (-6 dB) in Kaiser's
   window of 80 dB: flat within 1e-4 up to pi/(2 D), 80 dB down from 3 pi/(2 D), whose alias is the edge of the half |delta| <= pi/(2 D) that is used. Only outputs whose
   filter lies within the response are made, so that h = sum B z^k gives y_c[n] = sum B' (z^D)^n with no transient (Sirdey and others, DAFx-11; Ege, Boutillon
   and David, J. Sound Vib. 325, 2009). The phase is that of the window's beginning: no factor of c and n is left. White noise stays white within 3 dB. */
#include "analysis/ringing_band.h"

#include <math.h>

#include "analysis/ringing_complex.h"
#include "num/fft.h"
#include "num/real.h"

#define BETA 7.857 /* Kaiser's for 80 dB */

/* I0, by its power series. */
static double bessel(double x)
{
    double sum = 1, term = 1;
    for (int k = 1; k < 60; k++) {
        term *= x * x / (4.0 * k * k);
        sum += term;
    }
    return sum;
}

/* Without decimation there is nothing to filter. */
static int taps_of(int decimation) { return decimation == 1 ? 1 : RINGING_BAND_TAPS * decimation; }

static double *taps_make(int decimation, struct arena *a)
{
    int n = taps_of(decimation);
    double *g = ARENA_TAKE(a, double, n), sum = 0;
    for (int m = 0; m < n; m++) {
        double t = m - (n - 1) / 2.0, u = 2 * t / n;
        g[m] = n == 1 ? 1 : bessel(BETA * sqrt(fmax(1 - u * u, 0))) * real_sinpi(t / decimation) / t;
        sum += g[m];
    }
    for (int m = 0; m < n; m++)
        g[m] /= sum;
    return g;
}

void ringing_band_make(const double *const *x, int places, long length, int decimation, struct arena *a, struct ringing_band *b)
{
    int d = decimation, bands = d + 1, taps = taps_of(d);
    *b = (struct ringing_band){.decimation = d, .bands = bands, .places = places, .n = length < taps ? 0 : (length - taps) / d + 1};
    b->y = ARENA_TAKE(a, double complex, bands * places * (b->n + 1));
    double *g = taps_make(d, a), *folded = ARENA_TAKE(a, double, 2 * d), *re = ARENA_TAKE(a, double, bands), *im = ARENA_TAKE(a, double, bands);
    struct fft *fft = fft_open(2 * d);
    for (int p = 0; p < places; p++)
        for (long n = 0; n < b->n; n++) {
            for (int m = 0; m < 2 * d; m++) {
                folded[m] = 0;
                for (int k = m; k < taps; k += 2 * d)
                    folded[m] += g[k] * x[p][n * d + k];
            }
            fft_forward(fft, folded, re, im);
            for (int c = 0; c < bands; c++)
                b->y[((long)c * places + p) * b->n + n] = ringing_complex(re[c], im[c]);
        }
    fft_close(fft);
}

bool ringing_band_pole(const struct ringing_band *b, int c, double rate, double complex zeta, double margin, double pole[2])
{
    double re = creal(zeta), im = cimag(zeta), size = re * re + im * im, d = b->decimation;
    if (!(size > 1e-12))
        return false;
    double turned = real_atan2(im, re) - REAL_PI * (c % 2);
    turned -= 2 * REAL_PI * rint(turned / (2 * REAL_PI));
    pole[0] = -0.5 * real_log(size) / d * rate;
    pole[1] = (REAL_PI * c + turned) / d * rate;
    return fabs(turned) <= REAL_PI / 2 * (1 + margin);
}
