/* What is asked of a set of modes once it is read (modes_read.c): gains at a contact, the direct term, ring time.

   A mode is h(t) = Im(A e^(s t)), A = gain e^(j phase), s = -decay + j omega, omega = 2 pi f, t > 0 (papers/000 eq. 10).
   Shared poles: only A depends on the place, and it is interpolated linearly as a signed complex number: a mode shape passes
   through zero at a nodal line, where log amplitudes (papers/000 section 2.4) have no value.

   Direct term: h_a = dh_v/dt holds for t > 0; at t = 0 velocity jumps by h_v(0+) per N s, whose derivative is a delta of that weight.
   h_v(t) = Im(A/s e^(s t)) is the one that dies away, so D = sum Im(A/s); without it low frequencies are wrong. */
#include "response/modes.h"

#include <math.h>
#include <stddef.h>

#include "num/real.h"

/* Index k of the interval [along[k], along[k+1]] that holds s, places >= 2. */
static int interval(const struct modes *m, double s)
{
    int low = 0, high = m->places - 1;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (m->along[middle] <= s)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static void blend(const struct modes *m, int k, double w, double *re, double *im)
{
    const double *ar = m->gain_re + (size_t)k * m->n, *ai = m->gain_im + (size_t)k * m->n;
    const double *br = ar + m->n, *bi = ai + m->n;
    for (int i = 0; i < m->n; i++) {
        re[i] = ar[i] + w * (br[i] - ar[i]);
        im[i] = ai[i] + w * (bi[i] - ai[i]);
    }
}

double modes_gains_at(const struct modes *m, double x, double y, double *gain_re, double *gain_im)
{
    if (m->places == 1) {
        for (int i = 0; i < m->n; i++) {
            gain_re[i] = m->gain_re[i];
            gain_im[i] = m->gain_im[i];
        }
        return 0.0;
    }
    double dx = x - m->base[0], dy = y - m->base[1];
    double s = dx * m->axis[0] + dy * m->axis[1], off_line = dy * m->axis[0] - dx * m->axis[1];
    double inside = fmin(fmax(s, m->along[0]), m->along[m->places - 1]);
    int k = interval(m, inside);
    blend(m, k, (inside - m->along[k]) / (m->along[k + 1] - m->along[k]), gain_re, gain_im);
    double out = sqrt((s - inside) * (s - inside) + off_line * off_line);
    return out > 1e-9 ? out : 0.0;
}

double modes_direct(const struct modes *m, const double *gain_re, const double *gain_im)
{
    double sum = 0.0;
    if (m->quantity != MODES_ACCELERATION)
        return 0.0;
    for (int i = 0; i < m->n; i++) {
        double omega = 2.0 * REAL_PI * m->frequency[i], decay = m->decay[i];
        sum -= (gain_im[i] * decay + gain_re[i] * omega) / (decay * decay + omega * omega);
    }
    return sum;
}

int modes_drop_above(struct modes *m, double rate)
{
    double limit = 0.499 * rate;
    int n = m->n, kept = 0;
    size_t to = 0; /* rows are packed towards the front: nothing is overwritten before it is read */
    for (int p = 0; p < m->places; p++)
        for (int i = 0; i < n; i++)
            if (m->frequency[i] < limit) {
                m->gain_re[to] = m->gain_re[(size_t)p * n + i];
                m->gain_im[to++] = m->gain_im[(size_t)p * n + i];
            }
    for (int i = 0; i < n; i++)
        if (m->frequency[i] < limit) {
            m->frequency[kept] = m->frequency[i];
            m->decay[kept++] = m->decay[i];
        }
    m->n = kept;
    return n - kept;
}

double modes_ring_time(const struct modes *m, double decibel)
{
    double slowest = INFINITY;
    if (m->n == 0)
        return 0.0;
    for (int i = 0; i < m->n; i++)
        slowest = fmin(slowest, m->decay[i]);
    return slowest > 0.0 ? decibel * (real_log(10.0) / 20.0) / slowest : INFINITY;
}
