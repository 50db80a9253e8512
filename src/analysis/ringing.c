/* The modes' sound. */
#include "analysis/ringing.h"

#include <math.h>
#include <string.h>

#include "num/real.h"

const struct ringing_options ringing_options = {.most = 50, .slope_test = 1e-6, .confidence = 1e-6, .threshold = 0.1};

enum { RENEW = 256 }; /* samples between exact values: what rounding of the recurrence may add up over */

static void mode_add(const struct ringing_mode *m, int place, double rate, long n, double *y)
{
    double step = 2 * m->frequency / rate, shrink = real_exp(-m->decay / rate), c = shrink * real_cospi(step), s = shrink * real_sinpi(step);
    double re = 0, im = 0;
    for (long i = 0; i < n; i++) {
        if (i % RENEW == 0) {
            double t = (double)i / rate, size = real_exp(-m->decay * t), turns = m->frequency * t, half = 2 * (turns - floor(turns));
            double x = size * real_cospi(half), z = size * real_sinpi(half);
            re = m->re[place] * x - m->im[place] * z;
            im = m->re[place] * z + m->im[place] * x;
        }
        y[i] += im;
        double next = re * c - im * s;
        im = re * s + im * c;
        re = next;
    }
}

void ringing_sound(const struct ringing_modes *m, int place, double rate, long n, double *y)
{
    memset(y, 0, (size_t)n * sizeof *y);
    for (int i = 0; i < m->n; i++)
        mode_add(&m->mode[i], place, rate, n, y);
}
