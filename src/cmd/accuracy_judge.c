/* What the errors of a sweep say: the order with which each knob's own error falls, the error that the reference has itself, and which settings are worth their time.

   The order between neighbours is of the errors with all other knobs at `reference`. The reference's own error is extrapolated from them (analysis/convergence.h), knob by
   knob, and added up as powers: what is smaller cannot be told by comparing with this reference. Nothing is extrapolated where the sound diverges: there errors have grown to the size of the sound by the end of what is compared, whatever they began with.

   Of a sound that diverges, two renders which are equally right differ by as much as `high` and `reference`: a distance below that is no merit. */
#include <math.h>

#include "analysis/convergence.h"
#include "cmd/accuracy.h"
#include "num/real.h"
#include "scene/accuracy.h"
#include "scene/keys.h"

#define OCTAVE_DB 6.020599913279624 /* 20 log10 2 */

static const struct accuracy_render *alone(const struct accuracy_sweep *s, const struct accuracy_row *r)
{
    return r->alone >= 0 && s->renders[r->alone].code == 0 ? &s->renders[r->alone] : NULL;
}

static void judge_order(const struct accuracy_sweep *s, const struct accuracy_row *before, struct accuracy_row *r)
{
    const struct accuracy_render *x = alone(s, before), *y = alone(s, r);
    if (!x || !y || before->knob != r->knob || y == &s->renders[s->reference] || x == &s->renders[s->reference])
        return;
    double fine[2] = {before->fine, r->fine}, error[2] = {-x->error.snr / OCTAVE_DB, -y->error.snr / OCTAVE_DB};
    r->order = convergence_slope(fine, error);
}

/* The reference's row of a knob, and the two before it, coarsest first; how many there are, 0: the reference has none. */
static int finest(const struct accuracy_sweep *s, int knob, const struct accuracy_row *to[3])
{
    int n = 0;
    for (int i = 0; i < s->n_rows; i++) {
        const struct accuracy_row *r = &s->rows[i];
        if (r->knob != knob || !alone(s, r))
            continue;
        if (n == 2 && r->alone != s->reference) {
            to[0] = to[1];
            n = 1;
        }
        to[n++] = r;
        if (r->alone == s->reference)
            return n;
    }
    return 0;
}

static double amplitude(const struct accuracy_sweep *s, const struct accuracy_row *r)
{
    return real_exp10(-s->renders[r->alone].error.snr / 20.0);
}

static double judge_own(const struct accuracy_sweep *s, int knob)
{
    const struct accuracy_row *r[3];
    int n = finest(s, knob, r);
    double order;
    if (n < 2)
        return NAN;
    if (n == 2)
        return amplitude(s, r[0]);
    double fine[3] = {r[0]->fine, r[1]->fine, r[2]->fine}, difference[2] = {amplitude(s, r[0]), amplitude(s, r[1])};
    return convergence_left(fine, difference, &order);
}

double accuracy_judge_error(const struct accuracy_sweep *s, const struct accuracy_render *r)
{
    if (r->code != 0)
        return NAN;
    return isfinite(s->until) ? fmax(r->error.spectral, s->renders[s->high].error.spectral) : -r->error.snr;
}

bool accuracy_judge_below(const struct accuracy_sweep *s, const struct accuracy_render *r)
{
    return r->code == 0 && isfinite(r->error.snr) && r->error.snr > s->own_db;
}

static void judge_front(struct accuracy_sweep *s)
{
    double *cost = ARENA_TAKE(s->call->arena, double, s->n_renders), *error = ARENA_TAKE(s->call->arena, double, s->n_renders);
    bool *on = ARENA_TAKE(s->call->arena, bool, s->n_renders);
    for (int i = 0; i < s->n_renders; i++) {
        cost[i] = s->renders[i].timed ? s->renders[i].cpu : NAN;
        error[i] = accuracy_judge_error(s, &s->renders[i]);
    }
    convergence_front(s->n_renders, cost, error, (struct convergence_equal){0.05, 0.1}, on); /* what 3 runs tell apart, and an ear by far does not */
    for (int i = 0; i < s->n_renders; i++)
        s->renders[i].front = on[i];
}

void accuracy_judge(struct accuracy_sweep *s)
{
    double sum = 0.0;
    for (int i = 1; i < s->n_rows; i++)
        if (s->rows[i].knob >= 0)
            judge_order(s, &s->rows[i - 1], &s->rows[i]);
    for (int k = 0; k < KNOBS; k++) {
        s->own[k] = s->knobs & 1u << k && isinf(s->until) ? judge_own(s, k) : NAN;
        sum += isnan(s->own[k]) ? 0.0 : s->own[k] * s->own[k];
    }
    s->own_db = sum > 0.0 ? -10.0 * real_log10(sum) : INFINITY;
    judge_front(s);
}
