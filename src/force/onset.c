#include "force/onset.h"

#include <math.h>

void onset_told(struct stage_run *r, const char *what, double at)
{
    const struct contact *c = r->contact;
    double ramp = r->scene->output.ramp;
    if (c->start + at < ramp)
        board_warn(
            r->board,
            arena_format(
                r->arena,
                "contact '%s': %s comes %.4g s after the scene's start and is faded in by output.ramp, %.4g s: let it "
                "come later, or shorten the ramp",
                c->name, what, c->start + at, ramp));
}

size_t onset_largest(size_t n, const double *x)
{
    size_t at = 0;
    for (size_t i = 1; i < n; i++)
        at = fabs(x[i]) > fabs(x[at]) ? i : at;
    return at;
}
