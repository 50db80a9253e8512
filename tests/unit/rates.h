/* Random scenes whose sound should not depend on the sample rate, and what their sounds have in third octaves. Shared
   by test_rates.c and evidence/rates_judge.c; knows nothing of rasp but how a scene is written. */
#ifndef RATES_H
#define RATES_H
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ------------------------------------------------------------------ numbers: xorshift, from a seed */

struct rates_dice {
    unsigned long long x;
};

static inline double rates_draw(struct rates_dice *d, double low, double high)
{
    d->x ^= d->x << 13, d->x ^= d->x >> 7, d->x ^= d->x << 17;
    return low + (high - low) * ((double)(d->x >> 11) / 9007199254740992.0);
}

static inline double rates_log(struct rates_dice *d, double low, double high)
{
    return low * pow(high / low, rates_draw(d, 0, 1));
}

static inline int rates_pick(struct rates_dice *d, int n) { return (int)rates_draw(d, 0, n); }

static inline struct rates_dice rates_dice(int seed)
{
    struct rates_dice d = {88172645463325252ULL + 2654435761ULL * (unsigned long long)seed};
    for (int i = 0; i < 20; i++)
        rates_draw(&d, 0, 1);
    return d;
}

/* ------------------------------------------------------------------ scenes */

/* A mode table: 5 to 60 modes from 80 Hz to 19 kHz, any phases, of any quantity; 30 % have poles of their own at either
 * end of a line. Returns its length, m. */
static inline void rates_table(struct rates_dice *d, const char *path)
{
    static const char *const quantities[] = {"displacement", "velocity", "acceleration"};
    FILE *f = fopen(path, "w");
    bool separate = rates_draw(d, 0, 1) < 0.3;
    int n = 5 + rates_pick(d, 56), quantity = rates_pick(d, 3);
    double tilt = rates_draw(d, -1.5, 0) + 0.5 * quantity, t60 = rates_log(d, 0.05, 2);
    if (!f) abort();
    fprintf(f, "# poles: %s\n# quantity: %s\nplace,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad\n",
            separate ? "separate" : "shared", quantities[quantity]);
    double pole[64][2], other[64][4];
    for (int i = 0; i < n; i++) {
        pole[i][0] = rates_log(d, 80, 19000);
        pole[i][1] = 6.9 / t60 * pow(pole[i][0] / 1000, rates_draw(d, 0.2, 0.8));
        for (int k = 0; k < 4; k++)
            other[i][k] = rates_draw(d, 0, 1);
    }
    for (int place = 0; place < 2; place++)
        for (int i = 0; i < n; i++) {
            double gain = pow(pole[i][0] / 1000, tilt) * rates_log(d, 0.1, 1), phase = other[i][2] * 6.283;
            double move = place && separate ? 0.97 + 0.06 * other[i][0] : 1;
            fprintf(f, "%d,%.3f,0,%d,%.9g,%.9g,%.9g,%.9g\n", place, 0.1 * place, i, pole[i][0] * move,
                    pole[i][1] * move, separate || other[i][3] < 0.5 ? gain : -gain, phase);
        }
    fclose(f);
}

/* An object: where its middle lies and how far a contact may go from there. */
struct rates_body {
    char text[300];
    const char *material;
    double x, y, reach;
};

static inline struct rates_body rates_object(struct rates_dice *d)
{
    static const char *const materials[] = {"glass", "steel", "ceramic", "basswood", "aluminium", "oak"},
                             *const edges[] = {"free", "supported", "clamped"};
    struct rates_body b = {.reach = 0.01};
    const char *held = edges[rates_pick(d, 3)];
    double l = rates_draw(d, 0.1, 0.4), w = rates_draw(d, 0.05, 0.3), h = rates_log(d, 1.5e-3, 8e-3);
    int kind = rates_pick(d, 8);
    b.x = l * rates_draw(d, 0.2, 0.6), b.y = w * rates_draw(d, 0.2, 0.6), b.reach = 0.2 * fmin(l, w);
    switch (kind) {
    case 0:
        snprintf(b.text, sizeof b.text, "shape: bar, edges: %s, length: %g m, width: %g m, thickness: %g m", held, l,
                 0.1 * l, h);
        b.y = 0.05 * l, b.reach = 0.2 * l;
        break;
    case 1:
        snprintf(b.text, sizeof b.text, "shape: rod, edges: %s, length: %g m, diameter: %g m", held, l, 2 * h);
        b.y = 0, b.reach = 0.2 * l;
        break;
    case 2:
        snprintf(b.text, sizeof b.text, "shape: plate, edges: supported, length: %g m, width: %g m, thickness: %g m", l,
                 w, h);
        break;
    case 3:
        snprintf(b.text, sizeof b.text, "shape: plate, edges: free, length: %g m, width: %g m, thickness: %g m", l, w,
                 h);
        break;
    case 4:
        snprintf(b.text, sizeof b.text, "shape: disk, edges: %s, diameter: %g m, thickness: %g m", held, l, h);
        b.x = 0.1 * l, b.y = 0.07 * l, b.reach = 0.1 * l;
        break;
    case 5:
        snprintf(b.text, sizeof b.text,
                 "shape: membrane, length: %g m, width: %g m, thickness: %g mm, surface_tension: %g", l, w,
                 rates_draw(d, 0.1, 0.3), rates_log(d, 300, 3000));
        break;
    case 6:
        snprintf(b.text, sizeof b.text, "shape: string, length: %g m, diameter: %g mm, tension: %g N", l + 0.2,
                 rates_draw(d, 0.4, 1.2), rates_log(d, 50, 500));
        b.y = 0;
        break;
    default:
        snprintf(b.text, sizeof b.text, "shape: shell, diameter: %g m, thickness: %g m", l, h);
        b.x = b.y = 0.02;
        break;
    }
    b.material = materials[rates_pick(d, 6)];
    return b;
}

/* A force from a file: raised cosines of 0.1 to 2 ms, at 1 MHz. */
static inline void rates_force(struct rates_dice *d, const char *path)
{
    FILE *f = fopen(path, "w");
    double t = 0.02;
    if (!f) abort();
    fputs("time_s,force_n\n0,0\n", f);
    for (int k = 1 + rates_pick(d, 4); k > 0; k--) {
        double long_ = rates_log(d, 1e-4, 2e-3), size = rates_log(d, 0.1, 3),
               step = 1e-6 * fmax(1, floor(long_ / 5e-4));
        for (double u = 0; u < long_; u += step)
            fprintf(f, "%.9f,%.9g\n", t + u, 0.5 * size * (1 - cos(6.283185307179586 * u / long_)));
        fprintf(f, "%.9f,0\n", t + long_);
        t += long_ + rates_draw(d, 5e-3, 4e-2);
    }
    fclose(f);
}

/* Scene `seed`, without its sample rate: the text ends within the map `output`. Files go to the folder. */
static inline void rates_scene(int seed, const char *folder, char *text, size_t size)
{
    struct rates_dice d = rates_dice(seed);
    char path[400], response[500], contact[600];
    struct rates_body b = {.material = "glass", .x = 0.05, .reach = 0.03};
    bool table = rates_draw(&d, 0, 1) < 0.35;
    const int counts[] = {10, 20, 50, 50, 100};
    int modes = counts[rates_pick(&d, 5)], kind = rates_pick(&d, 4);
    if (table) {
        snprintf(path, sizeof path, "%s/table%d.csv", folder, seed);
        rates_table(&d, path);
        snprintf(response, sizeof response, "material: glass, response: %s, modes: %d", path, modes);
    } else {
        b = rates_object(&d);
        snprintf(response, sizeof response, "material: %s, object: {%s}, modes: %d", b.material, b.text, modes);
    }
    bool moves = kind == 3 || (kind == 1 && rates_draw(&d, 0, 1) < 0.5);
    char motion[300], ground[200] = "";
    if (moves)
        snprintf(motion, sizeof motion, "path: line, from: [%g m, %g m], to: [%g m, %g m], duration: 0.15 s", b.x, b.y,
                 b.x + b.reach, b.y);
    else
        snprintf(motion, sizeof motion, "path: still, at: [%g m, %g m], duration: 0.25 s", b.x, b.y);
    switch (kind) {
    case 0:
        snprintf(contact, sizeof contact,
                 "scraper: {mass: %g g, radius: %g mm, material: steel}\ncontact: {model: strike, strike: {speed: %g "
                 "m/s, first: 20 ms}}",
                 rates_log(&d, 0.5, 20), rates_log(&d, 2, 10), rates_log(&d, 0.1, 2));
        break;
    case 1: {
        static const char *const prototypes[] = {"roll", "scratch", "rub"};
        snprintf(contact, sizeof contact, "contact: {model: impacts, impacts: {prototype: %s}}",
                 prototypes[rates_pick(&d, 3)]);
        break;
    }
    case 2:
        snprintf(path, sizeof path, "%s/force%d.csv", folder, seed);
        rates_force(&d, path);
        snprintf(contact, sizeof contact, "contact: {model: given, given: {file: %s}}", path);
        break;
    default:
        snprintf(ground, sizeof ground,
                 "roughness: {exponent: %g, rms: %g um, longest: 2 mm, shortest: %g um}, along: path, ",
                 rates_draw(&d, -3, -1.5), rates_log(&d, 0.5, 5), rates_log(&d, 40, 120));
        snprintf(contact, sizeof contact, "scraper: {mass: %g g}\ncontact: {smoothing: %g us}", rates_log(&d, 2, 50),
                 rates_log(&d, 20, 100));
        break;
    }
    snprintf(text, size,
             "rasp: 1\nseed: %d\nsurface: {%s%s}\nmotion: {%s}\n%s\naccuracy: {preset: high}\noutput: {quantity: %s, "
             "tail: 0.5 s, ramp: 0",
             seed, ground, response, motion, contact, rates_draw(&d, 0, 1) < 0.5 ? "velocity" : "acceleration");
}

/* ------------------------------------------------------------------ third octaves */

enum { RATES_BANDS = 31, RATES_FIRST = -15 }; /* of 1 kHz 2^(k/3), from 31.25 Hz on */

static inline double rates_centre(int band) { return 1000 * pow(2, (band + RATES_FIRST) / 3.0); }

/* In place, n a power of two. */
static inline void rates_fft(double (*z)[2], size_t n)
{
    for (size_t i = 1, j = 0; i < n; i++) {
        size_t bit = n / 2;
        for (; j & bit; bit /= 2)
            j ^= bit;
        j ^= bit;
        if (i < j) {
            double swap[2] = {z[i][0], z[i][1]};
            memcpy(z[i], z[j], sizeof swap);
            memcpy(z[j], swap, sizeof swap);
        }
    }
    for (size_t half = 1; half < n; half *= 2)
        for (size_t k = 0; k < half; k++) {
            double c = cos(3.141592653589793 * (double)k / (double)half),
                   s = -sin(3.141592653589793 * (double)k / (double)half);
            for (size_t i = k; i < n; i += 2 * half) {
                double re = z[i + half][0] * c - z[i + half][1] * s, im = z[i + half][0] * s + z[i + half][1] * c;
                z[i + half][0] = z[i][0] - re, z[i + half][1] = z[i][1] - im;
                z[i][0] += re, z[i][1] += im;
            }
        }
}

/* dB of the energy of each third octave. The sound's last fifth is faded out, so that its end, a fraction of a sample
 * apart at two rates, says nothing. */
static inline void rates_bands(const double *x, long n, double rate, double level[RATES_BANDS])
{
    size_t size = 1;
    while (size < 4 * (size_t)n)
        size *= 2;
    double(*z)[2] = calloc(size, sizeof *z);
    double end = (double)n / rate;
    for (long i = 0; i < n; i++) {
        double left = (end - (double)i / rate) / (0.2 * end);
        z[i][0] = x[i] * (left < 1 ? 0.5 * (1 - cos(3.141592653589793 * left)) : 1);
    }
    rates_fft(z, size);
    for (int b = 0; b < RATES_BANDS; b++) {
        double low = rates_centre(b) * pow(2, -1 / 6.0) / rate * (double)size, high = low * pow(2, 1 / 3.0), sum = 0;
        for (size_t k = (size_t)(low + 0.5); (double)k < high + 0.5 && k < size / 2;
             k++) /* a bin counts by what of it lies in the band */
            sum += (fmin((double)k + 0.5, high) - fmax((double)k - 0.5, low)) * (z[k][0] * z[k][0] + z[k][1] * z[k][1]);
        level[b] = 10 * log10(sum / (rate * (double)size) + 1e-300);
    }
    free(z);
}

/* Of the bands that end below 0.4 of the lower rate and lie within 40 dB of the loudest of them: the largest
 * difference, dB; *band: where. */
static inline double rates_apart(const double *lower, const double *higher, double lower_rate, int *band)
{
    double loudest = -HUGE_VAL, worst = 0;
    *band = 0;
    for (int pass = 0; pass < 2; pass++)
        for (int b = 0; b < RATES_BANDS && rates_centre(b) * pow(2, 1 / 6.0) < 0.4 * lower_rate; b++) {
            loudest = fmax(loudest, higher[b]);
            if (pass && higher[b] > loudest - 40 && fabs(lower[b] - higher[b]) >= worst) {
                worst = fabs(lower[b] - higher[b]);
                *band = b;
            }
        }
    return worst;
}

#endif
