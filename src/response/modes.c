/* What is asked of a set of modes, wherever it comes from.

   Direct term: h_a = dh_v/dt holds for t > 0; at t = 0 velocity jumps by h_v(0+) per N s, whose derivative is a delta
   of that weight. h_v(t) = Im(A/s e^(s t)) is the one that dies away, so D = sum Im(A/s); without it low frequencies
   are wrong. A pressure, which follows the acceleration of a surface, likewise. */
#include "response/modes.h"

#include <math.h>

#include "num/real.h"

double modes_at(const struct modes *m, const struct modes_where *where, const struct modes_point *p)
{
    return m->at(m, where, p);
}

struct modes_point modes_point_make(struct arena *a, int n)
{
    return (struct modes_point){ARENA_TAKE(a, double, n), ARENA_TAKE(a, double, n), ARENA_TAKE(a, double, n),
                                ARENA_TAKE(a, double, n)};
}

const char *modes_quantity_name(int quantity)
{
    static const char *const names[MODES_QUANTITIES] = {"displacement", "velocity", "acceleration", "sound pressure",
                                                        "force"};
    return names[quantity];
}

const char *modes_quantity_unit(int quantity)
{
    static const char *const units[MODES_QUANTITIES] = {"m", "m/s", "m/s^2", "Pa", "N"};
    return units[quantity];
}

double modes_direct(int quantity, int n, const double *frequency, const double *decay, const struct modes_point *p)
{
    double sum = 0.0;
    if (quantity != MODES_ACCELERATION && quantity != MODES_PRESSURE) return 0.0;
    for (int i = 0; i < n; i++) {
        double omega = 2.0 * REAL_PI * frequency[i], d = decay[i];
        sum -= (p->im[i] * d + p->re[i] * omega) / (d * d + omega * omega);
    }
    return sum;
}

int modes_drop_above(struct modes *m, double rate) { return m->drop ? m->drop(m, MODES_TOP * rate) : 0; }

bool modes_in_band(const struct modes_ask *ask, double lowest, double highest)
{
    const double same = 1.0 - 1e-9; /* what rounding puts beside an end lies at it */
    return !(ask->band[1] > 0.0) || (highest >= same * ask->band[0] && lowest < same * ask->band[1]);
}

double modes_ring_time(const struct modes *m, double decibel)
{
    double slowest = INFINITY;
    if (m->n == 0) return 0.0;
    for (int i = 0; i < m->n; i++)
        slowest = fmin(slowest, m->slowest[i]);
    return slowest > 0.0 ? decibel * (real_log(10.0) / 20.0) / slowest : INFINITY;
}

void modes_to_quantity(int quantity, int n, const struct modes_point *p)
{
    for (int i = 0; i < n && quantity != MODES_VELOCITY; i++) {
        double re = p->re[i], im = p->im[i], a = -p->decay[i], w = 2.0 * REAL_PI * p->frequency[i],
               square = a * a + w * w;
        bool up = quantity == MODES_ACCELERATION;
        p->re[i] = up ? re * a - im * w : (re * a + im * w) / square;
        p->im[i] = up ? re * w + im * a : (im * a - re * w) / square;
    }
}
