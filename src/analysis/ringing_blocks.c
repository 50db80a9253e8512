/* Components far apart in frequency hardly couple: the inner product of two of decay d, normalised, is 2 d/|2 d + j (omega_1 - omega_2)|. So a fit of many is made in
   blocks of some BLOCK neighbours, cut at the widest gaps, each with GUESTS more from both sides, to which the response less all others' sound is the response: Schwarz's
   alternating method, the multiplicative one with overlap (Dryja and Widlund 1987), which
   ends where the joint fit ends, as every part's residual is that of the whole. Guests move with their hosts; whether they stay is asked in the block that is theirs. Errors come
   from a part's own Fisher matrix, guests' poles free. */
#include "analysis/ringing_blocks.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "num/real.h"

enum {
    WHOLE = 120,   /* components that are fitted in one */
    BLOCK = 48,
    GUESTS = 12,   /* from each side */
    ROOM = 16,     /* of a part, for what is offered to it */
    SWEEPS = 6     /* of gains */
};

#define FALLS 1e-4 /* share of a residual's energy by which gains still move */

struct blocks {
    struct ringing_fit *f;
    int n, *order;       /* components but the constant, by frequency */
    double *edge;        /* [count + 1] rad/s */
    int count;
};

struct key {
    double omega;
    int i;
};

static int rising(const void *x, const void *y)
{
    const struct key *a = x, *b = y;
    return a->omega > b->omega ? 1 : a->omega < b->omega ? -1 : a->i - b->i;
}

static void order_make(struct blocks *b, struct arena *a)
{
    struct key *key = ARENA_TAKE(a, struct key, b->f->m);
    b->n = b->f->m - 1;
    b->order = ARENA_TAKE(a, int, b->f->m);
    for (int i = 0; i < b->n; i++)
        key[i] = (struct key){b->f->omega[i + 1], i + 1};
    qsort(key, (size_t)b->n, sizeof *key, rising);
    for (int i = 0; i < b->n; i++)
        b->order[i] = key[i].i;
}

/* Cuts at the widest gap within a third of a block around its end. */
static void edges_make(struct blocks *b, struct arena *a)
{
    const double *omega = b->f->omega;
    order_make(b, a);
    b->edge = ARENA_TAKE(a, double, b->n / (BLOCK * 2 / 3) + 3);
    b->edge[0] = 0;
    for (int at = 0; b->n - at > BLOCK * 4 / 3;) {
        int best = at + BLOCK;
        double widest = -1;
        for (int i = at + BLOCK * 2 / 3; i <= at + BLOCK * 4 / 3 && i < b->n; i++) {
            double gap = omega[b->order[i]] - omega[b->order[i - 1]];
            if (gap > widest) {
                widest = gap;
                best = i;
            }
        }
        b->edge[++b->count] = 0.5 * (omega[b->order[best]] + omega[b->order[best - 1]]);
        at = best;
    }
    b->edge[++b->count] = HUGE_VAL;
}

/* Of block c: first and last + 1, in order, own and with guests. */
static void block_find(const struct blocks *b, int c, int own[2], int with[2])
{
    own[0] = own[1] = 0;
    while (own[0] < b->n && b->f->omega[b->order[own[0]]] < b->edge[c])
        own[0]++;
    own[1] = own[0];
    while (own[1] < b->n && b->f->omega[b->order[own[1]]] < b->edge[c + 1])
        own[1]++;
    with[0] = own[0] > GUESTS ? own[0] - GUESTS : 0;
    with[1] = own[1] + GUESTS < b->n ? own[1] + GUESTS : b->n;
}

static void member_add(const struct ringing_fit *f, int i, bool guest, struct ringing_fit *part)
{
    int k = i == 0 ? 0 : part->m;
    if (i > 0)
        ringing_fit_add(part, f->decay[i], f->omega[i]);
    part->held[k] = f->held[i];
    part->guest[k] = guest;
    part->fresh[k] = f->fresh[i];
    part->origin[k] = i;
    for (int p = 0; p < f->r->places; p++)
        part->gain[(long)p * part->most + k] = f->gain[(long)p * f->most + i];
}

/* Ties within a part; the frequency of what is tied to something beyond is held there with its pole. */
static void ties_make(const struct ringing_fit *f, struct ringing_fit *part)
{
    for (int k = 1; k < part->m; k++) {
        int to = f->tie[part->origin[k]];
        for (int x = 1; to >= 0 && x < part->m; x++)
            if (part->origin[x] == to)
                part->tie[k] = x;
        part->held[k] = part->held[k] || (to >= 0 && part->tie[k] < 0);
    }
    for (int i = 1; i < f->m; i++)
        for (int k = 1, inside = 0; f->tie[i] >= 0 && k < part->m; k++) {
            for (int x = 1; x < part->m; x++)
                inside += part->origin[x] == i;
            if (part->origin[k] == f->tie[i] && !inside)
                part->held[k] = true;
        }
}

/* The response without all that is not in the part. */
static void response_make(const struct ringing_fit *f, struct ringing *r, struct ringing_fit *part, struct arena *a)
{
    const double **h = ARENA_TAKE(a, const double *, r->places);
    double complex *minus = ARENA_TAKE(a, double complex, part->m);
    ringing_basis_set(&part->basis, part->m, part->decay, part->omega);
    for (int p = 0; p < r->places; p++) {
        double *y = ARENA_TAKE(a, double, r->n);
        for (int i = 0; i < part->m; i++)
            minus[i] = -part->gain[(long)p * part->most + i];
        memcpy(part->residual + p * r->n, f->residual + p * r->n, (size_t)r->n * sizeof *y);
        ringing_basis_subtract(&part->basis, part->residual + p * r->n, minus, y);
        h[p] = y;
        part->weight[p] = f->weight[p];
        part->energy[p] = f->energy[p];
        part->least[p] = f->least[p];
    }
    r->h = h;
}

static void part_make(const struct blocks *b, const int own[2], const int with[2], struct ringing_fit *part, struct arena *a)
{
    struct ringing *r = ARENA_TAKE(a, struct ringing, 1);
    *r = *b->f->r;
    ringing_fit_open(part, r, 3 * (with[1] - with[0]) + ROOM, a);
    part->part = true;
    member_add(b->f, 0, false, part);
    for (int i = with[0]; i < with[1]; i++)
        member_add(b->f, b->order[i], i < own[0] || i >= own[1], part);
    ties_make(b->f, part);
    response_make(b->f, r, part, a);
}

static void member_put(const struct ringing_fit *part, int k, struct ringing_fit *f)
{
    int i = part->origin[k];
    f->decay[i] = part->decay[k];
    f->omega[i] = part->omega[k];
    for (int p = 0; p < f->r->places; p++)
        f->gain[(long)p * f->most + i] = part->gain[(long)p * part->most + k];
}

/* What the part has become; what is new in it is last. */
static void part_put(struct blocks *b, const int with[2], struct ringing_fit *part, bool moved, struct arena *a)
{
    struct ringing_fit *f = b->f;
    bool *drop = ARENA_TAKE(a, bool, f->most), all = true;
    for (int i = with[0]; i < with[1]; i++)
        drop[b->order[i]] = true;
    for (int k = 0; k < part->m; k++) {
        bool is_new = part->origin[k] < 0;
        if (is_new)
            part->origin[k] = f->m;
        all = all && (!is_new || ringing_fit_add(f, part->decay[k], part->omega[k]));
        if (part->origin[k] >= f->m)
            continue;
        drop[part->origin[k]] = false;
        member_put(part, k, f);
        f->fresh[part->origin[k]] = moved || (part->guest[k] && f->fresh[part->origin[k]]);
    }
    for (int k = 1; k < part->m; k++)
        if (part->tie[k] >= 0)
            f->tie[part->origin[k]] = part->origin[part->tie[k]];
    memcpy(f->residual, part->residual, (size_t)(f->r->n * f->r->places) * sizeof *f->residual);
    memcpy(f->weight, part->weight, (size_t)f->r->places * sizeof *f->weight);
    memcpy(f->energy, part->energy, (size_t)f->r->places * sizeof *f->energy);
    ringing_fit_drop(f, drop);
}

static bool block_run(struct blocks *b, int c, bool (*act)(struct ringing_fit *, void *), void *context)
{
    struct arena *a = arena_open();
    struct ringing_fit part;
    int own[2], with[2];
    bool fresh = false, moved = false;
    order_make(b, a);
    block_find(b, c, own, with);
    for (int i = with[0]; i < with[1]; i++)
        fresh = fresh || b->f->fresh[b->order[i]];
    if (fresh && own[1] > own[0]) {
        part_make(b, own, with, &part, a);
        moved = act(&part, context);
        part_put(b, with, &part, moved, a);
    }
    arena_close(a);
    return moved;
}

bool ringing_blocks_many(const struct ringing_fit *f) { return !f->part && f->m > WHOLE; }

void ringing_blocks_run(struct ringing_fit *f, int sweeps, bool (*act)(struct ringing_fit *part, void *context), void *context)
{
    if (!ringing_blocks_many(f)) {
        act(f, context);
        return;
    }
    struct arena *a = arena_open();
    struct blocks b = {.f = f};
    edges_make(&b, a);
    ringing_fit_sound(f);
    for (int s = 0, moved = 1; s < sweeps && moved > 0; s++) {
        moved = 0;
        for (int c = 0; c < b.count; c++)
            moved += block_run(&b, c, act, context);
    }
    arena_close(a);
}

void ringing_blocks_renew(struct ringing_fit *f)
{
    for (int i = 0; i < f->m; i++)
        f->fresh[i] = true;
}

static double energy(const struct ringing_fit *f)
{
    double sum = 0;
    for (int p = 0; p < f->r->places; p++)
        sum += f->energy[p];
    return sum;
}

static bool gains(struct ringing_fit *part, void *context)
{
    (void)context;
    double before = energy(part);
    ringing_fit_gains(part);
    return energy(part) < (1 - FALLS) * before;
}

void ringing_blocks_gains(struct ringing_fit *f) { ringing_blocks_settle(f, SWEEPS, gains, NULL); }

void ringing_blocks_settle(struct ringing_fit *f, int sweeps, bool (*act)(struct ringing_fit *part, void *context), void *context)
{
    struct arena *a = arena_open();
    bool *fresh = ARENA_TAKE(a, bool, f->m);
    memcpy(fresh, f->fresh, sizeof(bool) * (size_t)f->m);
    ringing_blocks_run(f, sweeps, act, context);
    for (int i = 0; i < f->m; i++)
        f->fresh[i] = f->fresh[i] || fresh[i];
    arena_close(a);
}
