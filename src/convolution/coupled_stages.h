/* The modes under a ball in the four stages of a step of coupled_rk4.c, from one pass over them a step.

   With v = h q'/2, d = sigma h, W = |s|^2 h^2/4 and g = f h^2/4 a mode goes through a step as

     J_j = phi_j g_j - d v_j - W q_j   (phi at the stage)
     q1 = q + v,  v1 = v + J0;    q2 = q + v1,  v2 = v + J1;    q3 = q + 2 v2,  v3 = v + 2 J2
     q+ = q + 2 v + (2/3)(J0 + J1 + J2),   v+ = v + (J0 + 2 J1 + 2 J2 + J3)/3

   which is linear in (q, v) and in the forces g_j. So what the ball feels of all modes at a stage is a sum known before
   the step, as if no force acted in it, and some coefficients times the forces of the stages before (answers). The
   displacements follow from q and the velocities: five sums are enough, phi q and phi v_j; five more with phi's change
   per step where the place moves. Also known beforehand is what a step's forces add to the sums of the next one
   (replies): so the modes are one step behind the ball, and the pass that ends a step goes on while the next step's
   forces are looked for, which wait for one another. Sums and coefficients are of the weights at the start of a run, in
   which phi is straight, and polynomials of the number of steps since. */
#ifndef CONVOLUTION_COUPLED_STAGES_H
#define CONVOLUTION_COUPLED_STAGES_H
#include "base/arena.h"
#include "convolution/coupled_parts.h"

enum { STAGES = 4 };

/* The sums: of the modes' q, and of v at each stage. */
enum { SUM_Q, SUM_V, SUM_V1, SUM_V2, SUM_V3, SUMS };

/* What forces in the step add to the sums, phi half a step on for A1 and A2, a whole one for A3:
     phi v1: A1_SELF g0;   phi v2: A2_OLDER g0 + A2_SELF g1;   phi v3: 2 (A3_OLDEST g0 + A3_MIDDLE g1 + A3_SELF g2)
     phi q2: A1_SELF g0;   phi q3: 2 (A3_OLDER g0 + A3_SELF g1);   slope_phi q2: GLIDE2 g0;   slope_phi q3: 2
     (GLIDE3_OLDER g0 + GLIDE3_SELF g1) */
enum {
    A1_SELF,
    A2_SELF,
    A2_OLDER,
    A3_SELF,
    A3_OLDER,
    A3_MIDDLE,
    A3_OLDEST,
    GLIDE2 = LANES,
    GLIDE3_SELF,
    GLIDE3_OLDER,
    ANSWERS = 2 * LANES
};

struct coupled_stages {
    _Alignas(64) double now[2 * LANES]; /* the sums at the start of the step to come as if no force acted in it: of
                                           weights phi, then of slope_phi */
    double far[2 * LANES];              /* the same as far as it is known without the forces of the step before */
    double answer[3][ANSWERS];          /* of n^0, n^1, n^2, n the number of steps since the run's start */
    double reply[2][STAGES][2 * LANES]; /* of n^0, n^1: what a stage's g adds to now of the next step */
    double lost[LANES];                 /* J: the modes', of the steps that they have ended since it was emptied */
    bool moves;                         /* phi does: else slope_phi, and what is made with it, is 0 */
};

/* A step's forces: g at the stages, and the number of steps before it in the run. */
struct coupled_push {
    double g[STAGES], on;
};

/* Coefficients of the modes, once. */
void coupled_stages_make(struct arena *a, struct coupled *c);

/* At the start of a run of steps to phi_to (NULL: phi stays). s: zeroed. */
void coupled_stages_open(struct coupled *c, int steps, const double *phi_to, struct coupled_stages *s);

/* The end of the run: the last step, then true displacements and velocities. phi is the caller's. */
void coupled_stages_finish(struct coupled *c, const struct coupled_push *last, struct coupled_stages *s);

/* What the modes' end of a step would be, nothing being moved: their energy, J, and what they have lost until then,
 * beyond what the ledger has. */
void coupled_stages_look(const struct coupled *c, const struct coupled_push *p, const struct coupled_stages *s,
                         struct coupled_account *to);

static inline double coupled_stages_sum(const double *s)
{
    return ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
}

/* Rows of coupled_modes.rows: d, W; the sums' coefficients (of q, of v) in the state two steps on, as if no force
   acted; what a mode's q and v give per phi g in a step to the next step's sums, [stage][sum]; 1, -d, d^2 - W: what v
   holds of a force after no, one and two turns. */
enum {
    ROW_DAMP,
    ROW_SQUARE,
    ROW_FAR,
    ROW_REPLY = ROW_FAR + 2 * SUMS,
    ROW_TURNS = ROW_REPLY + STAGES * SUMS,
    ROWS = ROW_TURNS + 3
};

/* The rows of mode i and of those after it in its LANES; that of mode i + l is at [row * LANES + l]. */
static inline __attribute__((always_inline)) const double *coupled_stages_rows(const struct coupled_modes *m, int i)
{
    return m->rows + (size_t)i * ROWS;
}

/* A mode's step, all of it in scalars, as arrays keep gcc from vectorising over modes. */
struct coupled_stages_mode {
    double q, v, v1, v2, v3; /* v1 to v3: at the stages; q, v at the end on return              */
    double damp, square;
    double begin, middle, finish; /* phi                                                            */
    double lost;                  /* v^2 by the stages' shares, times 6                             */
};

/* 46 additions and multiplications. */
static inline __attribute__((always_inline)) void coupled_stages_step(struct coupled_stages_mode *o, double g0,
                                                                      double g1, double g2, double g3)
{
    const double q = o->q, v = o->v, d = o->damp, w = o->square;
    double j0 = (o->begin * g0 - w * q) - d * v, v1 = v + j0;
    double j1 = (o->middle * g1 - w * (q + v)) - d * v1, v2 = v + j1;
    double j2 = (o->middle * g2 - w * (q + v1)) - d * v2, v3 = v + (j2 + j2);
    double j3 = (o->finish * g3 - w * (q + (v2 + v2))) - d * v3, two = j1 + j2, three = j0 + two;
    o->lost = (v * v + v3 * v3) + 2 * (v1 * v1 + v2 * v2);
    o->q = q + ((v + v) + (2.0 / 3) * three);
    o->v = v + (1.0 / 3) * ((three + two) + j3);
    o->v1 = v1;
    o->v2 = v2;
    o->v3 = v3;
}

/* Mode l of those whose rows are given: of the sum k two steps on, as if no force acted. */
static inline __attribute__((always_inline)) double coupled_stages_far(const double *rows, int l, int k,
                                                                       const struct coupled_stages_mode *o)
{
    return rows[(ROW_FAR + 2 * k) * LANES + l] * o->q + rows[(ROW_FAR + 2 * k + 1) * LANES + l] * o->v;
}

/* Sums over lanes: coupled_stages_sum, of SUMS of them, halved together. */
static inline __attribute__((always_inline)) void coupled_stages_gather(double (*lanes)[LANES], double *to)
{
    double four[SUMS][4], two[SUMS][2];
    for (int k = 0; k < SUMS; k++)
#pragma omp simd
        for (int l = 0; l < 4; l++)
            four[k][l] = lanes[k][l] + lanes[k][l + 4];
    for (int k = 0; k < SUMS; k++)
#pragma omp simd
        for (int l = 0; l < 2; l++)
            two[k][l] = four[k][l] + four[k][l + 2];
    for (int k = 0; k < SUMS; k++)
        to[k] = two[k][0] + two[k][1];
}

/* The pass over the modes: the end of a step whose forces are known, and far. For callers that are LANES_CLONES. 73
   multiplications and additions a mode, 89 where the place moves. */
static inline __attribute__((always_inline)) void
coupled_stages_pass(const struct coupled_modes *m, const struct coupled_push *p, bool moves, struct coupled_stages *to)
{
    double lost[LANES], s[SUMS][LANES] = {{0}}, t[SUMS][LANES] = {{0}};
    memcpy(lost, to->lost, sizeof lost);
    double *restrict qs = m->q, *restrict vs = m->swing;
    const double *restrict phis = m->phi, *restrict slopes = m->slope_phi, *restrict drain = m->drain;
    const double g0 = p->g[0], g1 = p->g[1], g2 = p->g[2], g3 = p->g[3], begin = p->on, middle = p->on + 0.5,
                 finish = p->on + 1;
    for (int i = 0; i < m->padded; i += LANES) {
        const double *restrict rows = coupled_stages_rows(m, i);
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            const double phi = phis[i + l], slope_phi = moves ? slopes[i + l] : 0;
            struct coupled_stages_mode o = {.q = qs[i + l],
                                            .v = vs[i + l],
                                            .damp = rows[ROW_DAMP * LANES + l],
                                            .square = rows[ROW_SQUARE * LANES + l],
                                            .begin = moves ? phi + begin * slope_phi : phi,
                                            .middle = moves ? phi + middle * slope_phi : phi,
                                            .finish = moves ? phi + finish * slope_phi : phi};
            coupled_stages_step(&o, g0, g1, g2, g3);
            qs[i + l] = o.q;
            vs[i + l] = o.v;
            lost[l] += drain[i + l] * o.lost;
            const double f0 = coupled_stages_far(rows, l, SUM_Q, &o), f1 = coupled_stages_far(rows, l, SUM_V, &o),
                         f2 = coupled_stages_far(rows, l, SUM_V1, &o), f3 = coupled_stages_far(rows, l, SUM_V2, &o),
                         f4 = coupled_stages_far(rows, l, SUM_V3, &o);
            s[SUM_Q][l] += phi * f0;
            s[SUM_V][l] += phi * f1;
            s[SUM_V1][l] += phi * f2;
            s[SUM_V2][l] += phi * f3;
            s[SUM_V3][l] += phi * f4;
            if (moves) {
                t[SUM_Q][l] += slope_phi * f0;
                t[SUM_V][l] += slope_phi * f1;
                t[SUM_V1][l] += slope_phi * f2;
                t[SUM_V2][l] += slope_phi * f3;
                t[SUM_V3][l] += slope_phi * f4;
            }
        }
    }
    memcpy(to->lost, lost, sizeof lost);
    coupled_stages_gather(s, to->far);
    if (moves) coupled_stages_gather(t, to->far + LANES);
}

/* now, of the step after p's. */
static inline __attribute__((always_inline)) void coupled_stages_next(struct coupled_stages *s,
                                                                      const struct coupled_push *p, bool moves)
{
    const double g0 = p->g[0], g1 = p->g[1], g2 = p->g[2], g3 = p->g[3], on = p->on;
    double(*r)[2 * LANES] = s->reply[0], (*t)[2 * LANES] = s->reply[1];
    double *to = s->now, *far = s->far;
#pragma omp simd
    for (int k = 0; k < (moves ? 2 * LANES : LANES); k++)
        to[k] = far[k] + (moves ? ((r[0][k] + on * t[0][k]) * g0 + (r[1][k] + on * t[1][k]) * g1) +
                                      ((r[2][k] + on * t[2][k]) * g2 + (r[3][k] + on * t[3][k]) * g3)
                                : (r[0][k] * g0 + r[1][k] * g1) + (r[2][k] * g2 + r[3][k] * g3));
}

#endif
