/* See cut.h. */
#include "batch/cut.h"

#include <math.h>
#include <string.h>

#include "num/real.h"

bool cut_open(struct cut *c, const char *path, const struct cut_form *form, struct err *e)
{
    *c = (struct cut){.frames = 0};
    if (!wav_stream_open(&c->in, path, e))
        return false;
    c->own = c->frames = c->in.frames;
    if (!form || isnan(form->seconds))
        return true;
    c->frames = (long)rint(form->seconds * c->in.rate);
    c->ramp = c->frames < c->own ? (long)rint(form->ramp * c->in.rate) : 0;
    c->ramp = c->ramp < c->frames / 2 ? c->ramp : c->frames / 2;
    return true;
}

static double greatest(const double *x, int n)
{
    double most = 0;
    for (int k = 0; k < n; k++)
        most = fmax(most, fabs(x[k]));
    return most;
}

static void shape(struct cut *c, double *x, long n)
{
    long last = c->ramp > 1 ? c->ramp : 1;
    for (long i = 0; i < n; i++) {
        long rest = c->frames - 1 - (c->done + i);
        double *frame = x + i * c->in.channels, size = greatest(frame, c->in.channels);
        c->before = fmax(c->before, size);
        c->end = rest < last ? fmax(c->end, size) : c->end;
        double s = rest < c->ramp ? real_sinpi(0.5 * ((double)rest + 0.5) / (double)c->ramp) : 1;
        for (int k = 0; k < c->in.channels && rest < c->ramp; k++)
            frame[k] *= s * s;
    }
}

bool cut_read(struct cut *c, double *x, long most, long *n, struct err *e)
{
    long some = c->frames - c->done < most ? c->frames - c->done : most, got;
    *n = some;
    memset(x, 0, sizeof *x * (size_t)some * (size_t)c->in.channels);
    if (!wav_stream_read(&c->in, x, some, &got, e))
        return false;
    shape(c, x, some);
    c->done += some;
    return true;
}

void cut_close(struct cut *c)
{
    wav_stream_close(&c->in);
}
