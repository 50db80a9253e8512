/* See distance.h.

   Third-octave bands: IEC 61260-1, base 10: centres f_m = 1000 * 10^(x/10) Hz, x = -16 .. 13, edges f_m 10^(-1/20) ..
   f_m 10^(1/20). The power in a band is that of an ideal rectangular filter, from the one-sided spectrum of the whole
   sound:

     P_k = c_k |X_k|^2 / (n N)      X: DFT of the N frames, zero-padded to n;   c_k = 1 for k = 0 and n/2, else 2
     sum over k of P_k = mean square of the N frames (Parseval)

   Bin k stands for the frequencies (k +- 1/2) rate / n, within 0 .. rate / 2; a bin cut by a band's edge is shared out
   by width. A sound longer than PIECE frames is cut into pieces whose powers add up (memory stays small); no window:
   nothing is weighted down, and both sounds are cut alike. */
#include "analysis/distance.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "num/fft.h"
#include "num/real.h"

enum { PIECE = 1 << 20 };

void distance_samples(const struct wav *a, const struct wav *b, struct distance_samples *d)
{
    size_t channels = (size_t)a->channels;
    double signal = 0, noise = 0;
    *d = (struct distance_samples){.frames = a->frames < b->frames ? a->frames : b->frames};
    for (size_t i = 0; i < d->frames * channels; i++) {
        double p = a->x[i], q = b->x[i], off = fabs(q - p);
        struct distance_place here = {i / channels, (int)(i % channels), p, q};
        signal += p * p;
        noise += off * off;
        if (q != p && d->differing++ == 0) d->first = here;
        if (off > d->largest) {
            d->largest = off;
            d->worst = here;
        }
    }
    d->snr_db = d->differing ? 10 * real_log10(signal / noise) : INFINITY;
}

/* The machine is little-endian: x86-64 is the only one that rasp is for. */
void distance_hash_add(struct hash *h, const double *x, size_t n)
{
    double y[512];
    for (size_t done = 0, some; done < n; done += some) {
        some = n - done < 512 ? n - done : 512;
        for (size_t k = 0; k < some; k++)
            y[k] = x[done + k] + 0.0; /* -0 + 0 is +0 */
        hash_add(h, y, some * sizeof *y);
    }
}

void distance_hash(const struct wav *w, char hex[HASH_TEXT])
{
    double form[2] = {w->rate, w->channels};
    struct hash h = hash_start();
    distance_hash_add(&h, form, 2);
    distance_hash_add(&h, w->x, w->frames * (size_t)w->channels);
    hash_end(&h, hex);
}

double distance_step(const struct wav *a, const struct wav *b)
{
    int bits = a->bits && b->bits ? (a->bits < b->bits ? a->bits : b->bits) : a->bits + b->bits;
    return bits ? ldexp(1, 1 - bits) : 0;
}

double distance_band_centre(int band) { return 1000 * real_exp10((band - DISTANCE_BAND_1000) / 10.0); }

double distance_band_nominal(int band)
{
    static const double names[DISTANCE_BANDS] = {25,   31.5, 40,   50,   63,   80,   100,   125,   160,   200,
                                                 250,  315,  400,  500,  630,  800,  1000,  1250,  1600,  2000,
                                                 2500, 3150, 4000, 5000, 6300, 8000, 10000, 12500, 16000, 20000};
    return names[band];
}

static double lower_edge(int band) { return 1000 * real_exp10((2 * (band - DISTANCE_BAND_1000) - 1) / 20.0); }

struct spectrum {
    struct fft *fft;
    size_t n; /* transform length     */
    double *x, *re, *im;
    double width; /* of a bin, Hz         */
};

/* Sum of P_k N over the frequencies from low to high. */
static double band_energy(const struct spectrum *s, double low, double high)
{
    size_t half = s->n / 2, last = (size_t)fmin(high / s->width + 0.5, (double)half);
    double sum = 0;
    for (size_t k = (size_t)(low / s->width + 0.5); k <= last; k++) {
        double from = fmax(0, (double)k - 0.5), to = fmin((double)half, (double)k + 0.5);
        double inside = fmin(to, high / s->width) - fmax(from, low / s->width);
        double c = k == 0 || k == half ? 1 : 2;
        sum += c * (s->re[k] * s->re[k] + s->im[k] * s->im[k]) / (double)s->n * fmax(0, inside) / (to - from);
    }
    return sum;
}

/* Adds the energies of frames [start, start + n) of a channel. */
static void add_piece(struct spectrum *s, const struct wav *w, const size_t at[3], double energy[DISTANCE_BANDS])
{
    size_t start = at[0], n = at[1], channel = at[2];
    memset(s->x, 0, s->n * sizeof *s->x);
    for (size_t i = 0; i < n; i++)
        s->x[i] = w->x[(start + i) * (size_t)w->channels + channel];
    fft_forward(s->fft, s->x, s->re, s->im);
    for (int band = 0; band < DISTANCE_BANDS; band++)
        energy[band] += band_energy(s, lower_edge(band), lower_edge(band + 1));
}

void distance_band_levels(const struct wav *w, struct arena *a, double *level)
{
    size_t piece = w->frames < PIECE ? w->frames : PIECE, n = fft_good_size(piece < 2 ? 2 : piece);
    struct spectrum s = {fft_open(n),
                         n,
                         ARENA_TAKE(a, double, n),
                         ARENA_TAKE(a, double, n / 2 + 1),
                         ARENA_TAKE(a, double, n / 2 + 1),
                         w->rate / (double)n};
    for (size_t channel = 0; channel < (size_t)w->channels; channel++) {
        double energy[DISTANCE_BANDS] = {0};
        for (size_t start = 0; start < w->frames; start += piece) {
            size_t left = w->frames - start, at[3] = {start, left < piece ? left : piece, channel};
            add_piece(&s, w, at, energy);
        }
        for (int band = 0; band < DISTANCE_BANDS; band++)
            level[channel * DISTANCE_BANDS + (size_t)band] =
                energy[band] > 0 ? 10 * real_log10(energy[band] / (double)w->frames) : -INFINITY;
    }
    fft_close(s.fft);
}

/* Bands that both sounds have. */
static int shared_bands(const struct wav *a, const struct wav *b)
{
    int n = DISTANCE_BANDS;
    double nyquist = fmin(a->rate, b->rate) / 2;
    while (n > 0 && lower_edge(a->rate == b->rate ? n - 1 : n) >= nyquist)
        n--;
    return n;
}

void distance_bands(const struct wav *a, const struct wav *b, double range_db, struct arena *arena,
                    struct distance_bands *d)
{
    int shared = shared_bands(a, b), channels = a->channels;
    double *la = ARENA_TAKE(arena, double, channels *DISTANCE_BANDS),
           *lb = ARENA_TAKE(arena, double, channels *DISTANCE_BANDS);
    double loudest = -INFINITY;
    distance_band_levels(a, arena, la);
    distance_band_levels(b, arena, lb);
    for (int i = 0; i < channels * DISTANCE_BANDS; i++)
        if (i % DISTANCE_BANDS < shared) loudest = fmax(loudest, fmax(la[i], lb[i]));
    *d = (struct distance_bands){.a_db = -INFINITY, .b_db = -INFINITY};
    for (int i = 0; i < channels * DISTANCE_BANDS; i++) {
        if (i % DISTANCE_BANDS >= shared || loudest == -INFINITY || !(fmax(la[i], lb[i]) >= loudest - range_db))
            continue;
        double off = fabs(lb[i] - la[i]);
        if (d->compared++ == 0 || off > d->worst_db)
            *d = (struct distance_bands){d->compared, i % DISTANCE_BANDS, i / DISTANCE_BANDS, off, la[i], lb[i]};
    }
}

/* ------------------------------------------------------------------ agreement */

/* Two renders of a chaotic system are alike until the difference has grown to the size of the sound itself; from then
   on they are two sounds of the same kind. The instant t* is where the short-time error

     e_w^2 = (sum of (b - a)^2) / (sum of a^2)      over windows w of 10 ms, all channels together

   first reaches 1/4 (6 dB below the sound; two sounds of equal power that have nothing to do with each other differ by
   2), while the same ratio over all from that window to the end reaches 1/4 too: a gap in the sound, where its error
   may be the larger, or one wrong moment is no divergence. Errors of a chaotic system grow exponentially, so t* depends
   on the 1/4 by a few windows at most. */
#define SHARE 0.25

static void energies(const struct wav *a, const struct wav *b, size_t from, size_t to, double sum[2])
{
    for (size_t i = from * (size_t)a->channels; i < to * (size_t)a->channels; i++) {
        double d = b->x[i] - a->x[i];
        sum[0] += a->x[i] * a->x[i];
        sum[1] += d * d;
    }
}

size_t distance_agreement(const struct wav *a, const struct wav *b)
{
    size_t frames = a->frames < b->frames ? a->frames : b->frames,
           window = (size_t)fmax(AGREEMENT_WINDOW * a->rate, 1.0), until = frames;
    double rest[2] = {0};
    for (size_t w = (frames + window - 1) / window; w-- > 0;) {
        double here[2] = {0};
        energies(a, b, w * window, (w + 1) * window < frames ? (w + 1) * window : frames, here);
        rest[0] += here[0];
        rest[1] += here[1];
        if (here[1] > 0.0 && here[1] >= SHARE * here[0] && rest[1] >= SHARE * rest[0]) until = w * window;
    }
    return until;
}
