/* Steps that lower the residual are the only ones a fit takes (ringing_fit.c), so that it cannot come apart: but it may end on its way. Here it goes on for STEPS more, and what then has
   moved by more than FAR standard errors is told of. */
#include "analysis/ringing_settle.h"

#include <math.h>
#include <string.h>

#include "analysis/ringing_blocks.h"
#include "analysis/ringing_select.h"
#include "num/real.h"

enum { STEPS = 6, TOLD = 8 };

#define FAR 3.0

static bool polish(struct ringing_fit *part, void *context)
{
    (void)context;
    ringing_fit_polish(part, STEPS);
    return false;
}

const char *ringing_settle(struct ringing_fit *f, const struct ringing_noise *noise, const double band[2], struct arena *a)
{
    struct arena *inner = arena_open();
    struct ringing_fit_errors e;
    double *decay = ARENA_TAKE(inner, double, f->m), *omega = ARENA_TAKE(inner, double, f->m);
    const char *list = NULL;
    int n = 0;
    memcpy(decay, f->decay, (size_t)f->m * sizeof *decay);
    memcpy(omega, f->omega, (size_t)f->m * sizeof *omega);
    ringing_blocks_renew(f);
    ringing_blocks_settle(f, 1, polish, NULL);
    ringing_select_errors(f, noise, inner, &e);
    for (int i = 1; i < f->m; i++) {
        bool still = fabs(f->decay[i] - decay[i]) <= FAR * e.decay[i] && fabs(f->omega[i] - omega[i]) <= FAR * e.omega[i];
        if (f->held[i] || still || f->omega[i] < band[0] || f->omega[i] > band[1] || ++n > TOLD)
            continue;
        list = arena_format(a, "%s%s%.5g", list ? list : "", list ? ", " : "", f->omega[i] / (2 * REAL_PI));
    }
    arena_close(inner);
    return n == 0 ? NULL : arena_format(a, "the fit had not settled when it ended: %d of its modes still moved by more than their standard errors (%s%s Hz)", n, list, n > TOLD ? ", ..." : "");
}
