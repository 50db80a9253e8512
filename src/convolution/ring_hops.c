/* Searches for the longest hop. Errors are estimates over some hundred instants (ring_survey.h), and the force is one draw of a noise: hops are chosen for
   MARGIN less than the error asked, so that what is measured in the sound keeps it (evidence/responses.md).

   What a white force does to a mode within the time that it rings is one draw of a noise (chi square, two degrees of freedom): where all of the error
   is made in one such time, at one kink, say, it lies by more than 5 dB above its expectation in 4 of 100 sounds; with more modes and strokes, never.

   One hop: from the longest down by what the order promises, error ~ hop^order, by a factor of 8 at most; then the interval between the shortest
   that failed and the one that keeps it is halved (in the logarithm) until it is narrower than 10 %. */
#include "convolution/ring_hops.h"

#include <math.h>

#include "num/real.h"

#define MARGIN 0.5623 /* -5 dB */
#define NARROW 1.1

static double error_at(const struct ring_survey *s, const struct ring_error_ask *ask, int hop)
{
    struct ring_error_ask own = *ask;
    own.hop = hop;
    return hop > 1 ? ring_error_all(s, &own) : 0;
}

static int power_below(double hop)
{
    int power = 1;
    while (power < 1 << 24 && 2.0 * power <= hop)
        power *= 2;
    return power;
}

int ring_hops_one(const struct ring_survey *s, const struct ring_error_ask *ask, double error, double *reached)
{
    double most = MARGIN * error;
    int hop = ask->hop < 1 ? 1 : ask->hop, failed = 0;
    *reached = error_at(s, ask, hop);
    while (*reached > most) {
        double by = fmin(fmax(real_pow(most / *reached, 1.0 / ask->order), 0.125), 0.95);
        failed = hop;
        hop = hop * by > 1 ? (int)(hop * by) : 1;
        *reached = error_at(s, ask, hop);
    }
    while (failed > NARROW * hop + 1) {
        int middle = (int)sqrt((double)failed * hop);
        double there = error_at(s, ask, middle);
        if (middle <= hop)
            break;
        if (there <= most) {
            hop = middle;
            *reached = there;
        } else {
            failed = middle;
        }
    }
    return hop;
}

int ring_hops_power(const struct ring_survey *s, const struct ring_error_ask *ask, double error, double *reached)
{
    int hop = power_below(ask->hop);
    while ((*reached = error_at(s, ask, hop)) > MARGIN * error && hop > 1)
        hop /= 2;
    return hop;
}

double ring_hops_each(const struct ring_survey *s, const struct ring_error_ask *ask, double error, double *hop)
{
    struct arena *a = arena_open();
    int n = s->along.modes->n, left = n;
    double *wrong = ARENA_TAKE(a, double, n), *whole = ARENA_TAKE(a, double, n), sum = 0, all = 0, most = MARGIN * error;
    bool *done = ARENA_TAKE(a, bool, n);
    struct ring_error_ask own = *ask;
    own.skip = done;
    for (own.hop = power_below(ask->hop); left > 0; own.hop /= 2) {
        ring_error(s, &own, wrong, whole);
        for (int i = 0; i < n; i++)
            if (!done[i] && (wrong[i] <= most * most * whole[i] || own.hop == 1)) {
                done[i] = true;
                hop[i] = own.hop;
                left--;
            }
    }
    for (int i = 0; i < n; i++) {
        sum += wrong[i];
        all += whole[i];
    }
    arena_close(a);
    return all > 0 ? sqrt(sum / all) : 0;
}
