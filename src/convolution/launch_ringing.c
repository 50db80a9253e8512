/* Which nodes ring in which cluster (launch_cluster.c), and for how long.

   A node freed from the force joins a cluster of its component whose pole s_c is near enough, |s - s_c| c/rate < 0.09 (c half a block); when there
   is none it opens one. Poles move on mostly the way they came, so that the new pole s_c lies ahead of the node's: by half of what the component's
   poles will have moved while the node rings, but at most by 0.8 of that reach. A node whose pole is that of the cluster's last is added
   to its state, which is exact.

   A node of size |z| is dropped after log(|z|/least)/decay seconds; that is looked at every SWEEP blocks, so that it may be SWEEP - 1
   blocks late. What is dropped leaves its row to the lane's last one. Everything depends on frame numbers and states alone: the
   same order of sums however calls are cut. */
#include "convolution/launch_ringing.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "convolution/launch_cluster.h"
#include "num/real.h"
#include "num/vecmath.h"

enum { SWEEP = 8, BLOCK = LAUNCH_RINGING_BLOCK, CENTRE = BLOCK / 2 };

struct lane {
    int component, count; /* nodes; none: free for another cluster */
    int next;             /* lane of the same component, or of the free ones; -1: no other */
    double s[2];          /* the cluster's pole: -decay, 2 f                               */
    double soonest;       /* frame in which the first node is to be dropped                */
    double reach;
};

struct before { /* the node a component freed last */
    double s[2];
    long frame;
    bool any;
};

struct launch_ringing {
    struct arena *arena;
    int groups, room; /* groups of clusters: in use, allocated */
    double rate;
    long now; /* first frame of the coming block */
    struct launch_cluster *group;
    struct lane *lane; /* [room LANES] */
    int *first;        /* [n] a component's newest cluster, -1: none */
    int free;          /* a lane, -1: none                           */
    struct before *before;
    int *place; /* [n] and the following: of the nodes being added */
    double *size, *turn, *rise, *life;
    double *dr, *di, *ar, *ai;
};

struct launch_ringing *launch_ringing_make(struct arena *a, int n, double rate)
{
    struct launch_ringing *r = ARENA_TAKE(a, struct launch_ringing, 1);
    *r = (struct launch_ringing){.arena = a, .rate = rate, .free = -1};
    r->first = ARENA_TAKE(a, int, n + 1);
    r->place = ARENA_TAKE(a, int, n + 1);
    r->before = ARENA_TAKE(a, struct before, n + 1);
    double **rooms[] = {&r->size, &r->turn, &r->rise, &r->life, &r->dr, &r->di, &r->ar, &r->ai};
    for (size_t k = 0; k < sizeof rooms / sizeof rooms[0]; k++)
        *rooms[k] = ARENA_TAKE(a, double, n + 1);
    for (int i = 0; i < n; i++)
        r->first[i] = -1;
    return r;
}

/* ------------------------------------------------------------------ lanes and rows */

static void grow_groups(struct launch_ringing *r)
{
    int room = r->room ? 2 * r->room : 8;
    struct launch_cluster *group = ARENA_TAKE(r->arena, struct launch_cluster, room);
    struct lane *lane = ARENA_TAKE(r->arena, struct lane, room * LANES);
    for (int k = 0; k < r->groups; k++)
        group[k] = r->group[k];
    for (int l = 0; l < r->groups * LANES; l++)
        lane[l] = r->lane[l];
    r->group = group;
    r->lane = lane;
    r->room = room;
}

static int free_lane(struct launch_ringing *r)
{
    if (r->free < 0) {
        if (r->groups == r->room)
            grow_groups(r);
        int at = r->groups++ * LANES;
        for (int l = LANES - 1; l >= 0; l--) { /* the lowest is taken first */
            r->lane[at + l].next = r->free;
            r->free = at + l;
        }
    }
    int l = r->free;
    r->free = r->lane[l].next;
    return l;
}

static void grow_rows(struct launch_cluster *g, struct arena *a)
{
    int room = g->room ? 2 * g->room : 2 * LAUNCH_CLUSTER_ROWS;
    struct launch_cluster_row *rows = ARENA_TAKE(a, struct launch_cluster_row, room);
    for (int k = 0; k < g->used; k++)
        rows[k] = g->rows[k];
    g->rows = rows;
    g->room = room;
}

static void row_copy(struct launch_cluster_row *to, const struct launch_cluster_row *from, int l)
{
    to->xr[l] = from->xr[l], to->xi[l] = from->xi[l];
    to->dr[l] = from->dr[l], to->di[l] = from->di[l];
    to->ar[l] = from->ar[l], to->ai[l] = from->ai[l];
    to->until[l] = from->until[l];
}

/* How many rows the group's lanes need, and the reach of those that ring. */
static void measure(struct launch_ringing *r, int k)
{
    int most = 0;
    r->group[k].reach = 0;
    for (int l = k * LANES; l < (k + 1) * LANES; l++)
        if (r->lane[l].count) {
            most = r->lane[l].count > most ? r->lane[l].count : most;
            r->group[k].reach = fmax(r->group[k].reach, r->lane[l].reach);
        }
    r->group[k].used = (most + LAUNCH_CLUSTER_ROWS - 1) / LAUNCH_CLUSTER_ROWS * LAUNCH_CLUSTER_ROWS;
}

/* ------------------------------------------------------------------ dropping */

static void lane_free(struct launch_ringing *r, int l)
{
    int *link = &r->first[r->lane[l].component];
    while (*link != l)
        link = &r->lane[*link].next;
    *link = r->lane[l].next;
    r->lane[l].next = r->free;
    r->free = l;
}

static void lane_sweep(struct launch_ringing *r, int l)
{
    struct lane *v = &r->lane[l];
    struct launch_cluster_row *rows = r->group[l / LANES].rows;
    v->soonest = HUGE_VAL;
    for (int k = 0; k < v->count;)
        if (rows[k].until[l % LANES] <= (double)r->now) {
            row_copy(&rows[k], &rows[--v->count], l % LANES);
            rows[v->count].xr[l % LANES] = rows[v->count].xi[l % LANES] = 0;
        } else {
            v->soonest = fmin(v->soonest, rows[k].until[l % LANES]);
            k++;
        }
    if (v->count == 0)
        lane_free(r, l);
}

static void sweep(struct launch_ringing *r)
{
    for (int k = 0; k < r->groups; k++) {
        bool dropped = false;
        for (int l = k * LANES; l < (k + 1) * LANES; l++)
            if (r->lane[l].count && r->lane[l].soonest <= (double)r->now) {
                lane_sweep(r, l);
                dropped = true;
            }
        if (dropped)
            measure(r, k);
    }
}

/* ------------------------------------------------------------------ adding */

/* The distance of two poles as launch_cluster.h's d, in [0] and [1]. */
static double apart(const struct launch_ringing *r, const double *s, const double *from, double d[2])
{
    double per = CENTRE / r->rate;
    d[0] = (s[0] - from[0]) * per;
    d[1] = (s[1] - from[1]) * REAL_PI * per;
    return sqrt(d[0] * d[0] + d[1] * d[1]);
}

/* A pole ahead of s, see above; `life` in frames. */
static void ahead(const struct launch_ringing *r, const struct launch_freed *node, const double *s, double life, double pole[2])
{
    const struct before *b = &r->before[node->component];
    double d[2], step = b->any ? apart(r, s, b->s, d) : 0, share = 0;
    if (step > 0) {
        double most = 0.8 * LAUNCH_CLUSTER_REACH / step;
        share = fmin(0.5 * fmax(life, 0) / (double)(node->frame - b->frame), most);
    }
    for (int k = 0; k < 2; k++)
        pole[k] = step > 0 ? s[k] + share * (s[k] - b->s[k]) : s[k];
}

static int cluster_open(struct launch_ringing *r, const struct launch_freed *node, const double *s, double life)
{
    int l = free_lane(r);
    struct lane *v = &r->lane[l];
    struct launch_cluster *g = &r->group[l / LANES];
    *v = (struct lane){.component = node->component, .next = r->first[node->component], .soonest = HUGE_VAL};
    r->first[node->component] = l;
    ahead(r, node, s, life, v->s);
    double size = real_exp(v->s[0] / r->rate), turn = v->s[1] / r->rate;
    g->qr[l % LANES] = size * real_cospi(turn);
    g->qi[l % LANES] = size * real_sinpi(turn);
    return l;
}

static int cluster_for(struct launch_ringing *r, const struct launch_freed *node, const double *s, double life)
{
    double d[2];
    for (int l = r->first[node->component]; l >= 0; l = r->lane[l].next)
        if (apart(r, s, r->lane[l].s, d) < LAUNCH_CLUSTER_REACH)
            return l;
    return cluster_open(r, node, s, life);
}

/* Where each node goes, its d, and the arguments of e^(delta (c+1)/rate) and e^(s block/rate). */
static void place(struct launch_ringing *r, const struct launch_freed *freed, int count)
{
    double wait = (CENTRE + 1) / r->rate, span = BLOCK / r->rate;
    for (int k = 0; k < count; k++)
        r->life[k] = (fabs(freed[k].re) + fabs(freed[k].im)) / freed[k].least;
    vecmath_log((size_t)count, r->life, r->life);
    for (int k = 0; k < count; k++) {
        double s[2] = {-freed[k].decay, 2 * freed[k].frequency};
        r->life[k] = freed[k].decay > 0 ? r->life[k] * r->rate / freed[k].decay : HUGE_VAL;
        r->place[k] = cluster_for(r, &freed[k], s, r->life[k]);
        struct lane *v = &r->lane[r->place[k]];
        double d[2];
        v->reach = fmax(v->reach, apart(r, s, v->s, d));
        r->dr[k] = d[0], r->di[k] = d[1];
        r->size[k] = (s[0] - v->s[0]) * wait, r->turn[k] = (s[1] - v->s[1]) * wait;
        r->ar[k] = s[0] * span, r->ai[k] = s[1] * span;
        r->before[freed[k].component] = (struct before){.s = {s[0], s[1]}, .frame = freed[k].frame, .any = true};
    }
}

/* Row for the k-th of the nodes: that of the lane's last one if it has the same pole. */
static void insert(struct launch_ringing *r, int k, double re, double im)
{
    struct lane *v = &r->lane[r->place[k]];
    struct launch_cluster *g = &r->group[r->place[k] / LANES];
    int l = r->place[k] % LANES, last = v->count - 1;
    double until = (double)r->now + r->life[k];
    if (last >= 0 && g->rows[last].dr[l] == r->dr[k] && g->rows[last].di[l] == r->di[k]) {
        g->rows[last].xr[l] += re;
        g->rows[last].xi[l] += im;
        g->rows[last].until[l] = fmax(g->rows[last].until[l], until);
        return;
    }
    if (v->count == g->room)
        grow_rows(g, r->arena);
    struct launch_cluster_row *row = &g->rows[v->count++];
    row->xr[l] = re, row->xi[l] = im;
    row->dr[l] = r->dr[k], row->di[l] = r->di[k];
    row->ar[l] = r->ar[k], row->ai[l] = r->ai[k];
    row->until[l] = until;
    v->soonest = fmin(v->soonest, until);
    measure(r, r->place[k] / LANES);
}

void launch_ringing_add(struct launch_ringing *r, const struct launch_freed *freed, int count)
{
    size_t n = (size_t)count;
    place(r, freed, count);
    vecmath_exp(n, r->size, r->size);
    vecmath_sincospi(n, r->turn, r->rise, r->turn);
    for (int k = 0; k < count; k++) {
        double re = r->size[k] * r->turn[k], im = r->size[k] * r->rise[k];
        r->turn[k] = freed[k].re * re - freed[k].im * im;
        r->rise[k] = freed[k].re * im + freed[k].im * re;
    }
    vecmath_exp(n, r->ar, r->ar);
    vecmath_sincospi(n, r->ai, r->size, r->ai);
    for (int k = 0; k < count; k++) {
        double size = r->ar[k];
        r->ar[k] = size * r->ai[k];
        r->ai[k] = size * r->size[k];
        insert(r, k, r->turn[k], r->rise[k]);
    }
}

void launch_ringing_run(struct launch_ringing *r, double (*sums)[LANES])
{
    if ((r->now / BLOCK) % SWEEP == 0)
        sweep(r);
    for (int k = 0; k < r->groups; k++)
        if (r->group[k].used) {
            launch_cluster_gather(&r->group[k]);
            launch_cluster_sound(&r->group[k], sums, BLOCK);
        }
    r->now += BLOCK;
}

long launch_ringing_active(const struct launch_ringing *r)
{
    long count = 0;
    for (int l = 0; l < r->groups * LANES; l++)
        count += r->lane[l].count;
    return count;
}
