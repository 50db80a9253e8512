/* Every force sample f(m) adds C_k f(m) to frames m + k, |k| <= ALIAS_REACH, C_k = sum over components of Im(A_i
   kappa_i,k) (alias.c), with A and kappa of the contact's place at frame m; of `readout` at frame m + k, where it is
   heard. That is one filter for all engines: `fixed`, `launch` and their nodes launch each force sample with the
   response of its own place, and the taps are a part of it; of `glide`, which retunes what rings, a sample's taps are
   over after 0.3 ms.

   C is known every accuracy.gain_ramp frames, as gains are, and linear between. What would be heard before the first
   frame at which the contact can be heard, that of the voice's delay, is added to that frame, so that nothing is lost
   at 0 Hz. Pieces and taps stand at fixed frames and are added up in their order: the result does not depend on how the
   sound is cut into calls. */
#include "convolution/ring_alias.h"

#include <string.h>

#include "convolution/alias.h"
#include "num/lanes.h"

enum { ROOM = STAGE_BLOCK + 2 * ALIAS_REACH };

struct known {
    long frame;
    double tap[ALIAS_TAPS];
};

struct ring_alias {
    struct alias *fit;
    bool moves, separate; /* the taps change on the way; poles do */
    bool listens;         /* the taps are those of the place at which is heard */
    long piece;
    struct modes_point at;                       /* [n] */
    double (*re)[ALIAS_TAPS], (*im)[ALIAS_TAPS]; /* [n] kappa of poles that stay, where gains move; else [1] */
    struct known start, end;                     /* of the piece at hand; start.frame < 0: there is none */
    long next;                                   /* force frame */
    double sum[ROOM];                            /* of frames from the call's first on */
};

/* ------------------------------------------------------------------ taps */

static void add(const double *restrict re, const double *restrict im, double a, double b, double *restrict to)
{
    for (int k = 0; k < ALIAS_TAPS; k++)
        to[k] += a * im[k] + b * re[k];
}

static void taps_at(struct ring_alias *s, const struct ring *g, const struct ring_voice *v, long frame,
                    struct known *to)
{
    bool kept = s->moves && !s->separate;
    *to = (struct known){.frame = frame};
    ring_point_at(g, v, (double)frame, &s->at);
    for (int i = 0; i < v->n; i++) {
        if (s->at.re[i] == 0.0 && s->at.im[i] == 0.0) continue;
        if (!s->moves) alias_taps(s->fit, s->at.frequency[i], s->at.decay[i], *s->re, *s->im);
        if (s->moves && s->separate)
            alias_add(s->fit, s->at.frequency[i], s->at.decay[i], (double[2]){s->at.re[i], s->at.im[i]}, to->tap);
        else
            add(s->re[kept ? i : 0], s->im[kept ? i : 0], s->at.re[i], s->at.im[i], to->tap);
    }
}

/* The piece that holds a frame. */
static void find(struct ring_alias *s, const struct ring *g, const struct ring_voice *v, long frame)
{
    if (s->start.frame >= 0 && (!s->moves || (frame >= s->start.frame && frame < s->end.frame))) return;
    long from = frame - frame % s->piece;
    if (s->moves && s->end.frame == from && s->start.frame >= 0)
        s->start = s->end;
    else
        taps_at(s, g, v, from, &s->start);
    s->end = s->start;
    if (!s->moves) return;
    taps_at(s, g, v, from + s->piece, &s->end);
}

struct ring_alias *ring_alias_make(const struct ring *g, const struct ring_voice *v, struct arena *a)
{
    struct ring_alias *s = ARENA_TAKE(a, struct ring_alias, 1);
    s->fit = alias_make(a, g->choice->gamma, g->board->rate);
    s->moves = g->moves;
    s->separate = !v->modes->shared;
    s->listens = g->choice->reading == MOVING_READOUT;
    s->piece = g->ramp;
    s->at = modes_point_make(a, v->n);
    s->start.frame = -1;
    bool keep = s->moves && !s->separate;
    s->re = arena_take(a, (size_t)(keep ? v->n : 1), sizeof *s->re);
    s->im = arena_take(a, (size_t)(keep ? v->n : 1), sizeof *s->im);
    for (int i = 0; keep && i < v->n; i++) {
        alias_add(s->fit, v->frequency[i], v->decay[i], (const double[2]){0, 1}, s->re[i]);
        alias_add(s->fit, v->frequency[i], v->decay[i], (const double[2]){1, 0}, s->im[i]);
    }
    return s;
}

/* ------------------------------------------------------------------ at work */

LANES_CLONES
static void scatter(const double *restrict start, const double *restrict end, double u, double f, double *restrict to)
{
#pragma omp simd
    for (int k = 0; k < ALIAS_TAPS; k++)
        to[k] += f * (start[k] + u * (end[k] - start[k]));
}

static double share(const struct ring_alias *s, long frame)
{
    return s->moves ? (double)(frame - s->start.frame) / (double)(s->end.frame - s->start.frame) : 0;
}

/* What would be heard before frame `least`, from `first` on, is added to that. */
static void launch_early(struct ring_alias *s, double f, double u, long first, long least)
{
    double early[ALIAS_TAPS] = {0};
    scatter(s->start.tap, s->end.tap, u, f, early);
    for (int k = 0; k < ALIAS_TAPS; k++)
        s->sum[first + k > least ? first + k : least] += early[k];
}

/* The force f of a frame, to what is heard around it, from frame `begin` on. */
static void launch(struct ring_alias *s, double f, long frame, long from, long begin)
{
    long first = frame - ALIAS_REACH - from, least = begin > from ? begin - from : 0;
    if (first >= least)
        scatter(s->start.tap, s->end.tap, share(s, frame), f, s->sum + first);
    else
        launch_early(s, f, share(s, frame), first, least);
}

/* What is heard in a frame of the force around it, f[0] the frame's own. */
static double hear(struct ring_alias *s, const struct ring *g, const struct ring_voice *v, const double *f, long frame)
{
    double sum = 0;
    bool any = false;
    long at = frame > v->delay ? frame : v->delay;
    for (int k = -ALIAS_REACH; k <= ALIAS_REACH; k++)
        any = any || (frame + k >= v->delay && f[k] != 0.0);
    if (!any) return 0;
    find(s, g, v, at);
    double u = share(s, at);
    for (int k = 0; k < ALIAS_TAPS; k++)
        if (frame + ALIAS_REACH - k >= v->delay)
            sum += f[ALIAS_REACH - k] * (s->start.tap[k] + u * (s->end.tap[k] - s->start.tap[k]));
    return sum;
}

static void listen(struct ring_alias *s, const struct ring *g, const struct ring_voice *v, double *y, long from,
                   long to)
{
    const double *f = ring_force(g, v, from);
    long begin = v->delay;
    if (to <= begin) return;
    for (long n = from <= begin ? begin - ALIAS_REACH : from; n < to; n++)
        y[(n < begin ? begin : n) - from] += hear(s, g, v, f + (n - from), n);
}

void ring_alias_add(struct ring_alias *s, const struct ring *g, const struct ring_voice *v, double *y, long from,
                    long to)
{
    const double *f = ring_force(g, v, from);
    if (s->listens) {
        listen(s, g, v, y, from, to);
        return;
    }
    for (; s->next < to + ALIAS_REACH; s->next++)
        if (f[s->next - from] != 0.0) {
            find(s, g, v, s->next);
            launch(s, f[s->next - from], s->next, from, v->delay);
        }
    for (long n = 0; n < to - from; n++)
        y[n] += s->sum[n];
    memmove(s->sum, s->sum + (to - from), (size_t)(ROOM - (to - from)) * sizeof *s->sum);
    memset(s->sum + ROOM - (to - from), 0, (size_t)(to - from) * sizeof *s->sum);
}
