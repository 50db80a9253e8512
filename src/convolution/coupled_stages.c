/* See coupled_stages.h. Bits do not depend on the instruction set: sums run over LANES accumulators and then in one
 * tree. */
#include "convolution/coupled_stages.h"

/* Where a mode's v is an impulse of 1, e[i] is v after i turns by X = [[0, 1], [-W, -d]]: the row of v in X^i is (-W
 * e[i - 1], e[i]). */
static void mode_rows(double d, double w, double *row)
{
    const double e1 = -d, e2 = d * d - w, e3 = -d * e2 - w * e1, e4 = -d * e3 - w * e2;
    /* R = 1 + 2 X + 2 X^2 + (4/3) X^3 + (2/3) X^4: a step without a force */
    const double across = 2 + 2 * e1 + 4.0 / 3 * e2 + 2.0 / 3 * e3;
    const double r[2][2] = {{1 - w * (2 + 4.0 / 3 * e1 + 2.0 / 3 * e2), across},
                            {-w * across, 1 + 2 * e1 + 2 * e2 + 4.0 / 3 * e3 + 2.0 / 3 * e4}};
    const double sum[SUMS][2] = {
        {1, 0}, {0, 1}, {-w, 1 + e1}, {-w * (1 + e1), 1 + e1 + e2}, {-2 * w * (1 + e1 + e2), 1 + 2 * (e1 + e2 + e3)}};
    const double end[STAGES][2] = {{2.0 / 3 * (1 + e1 + e2), (1 + 2 * (e1 + e2 + e3)) / 3},
                                   {2.0 / 3 * (1 + e1), 2.0 / 3 * (1 + e1 + e2)},
                                   {2.0 / 3, 2.0 / 3 * (1 + e1)},
                                   {0, 1.0 / 3}};
    row[ROW_DAMP * LANES] = d;
    row[ROW_SQUARE * LANES] = w;
    for (int k = 0; k < SUMS; k++) {
        for (int i = 0; i < 2; i++)
            row[(ROW_FAR + 2 * k + i) * LANES] = sum[k][0] * r[0][i] + sum[k][1] * r[1][i];
        for (int j = 0; j < STAGES; j++)
            row[(ROW_REPLY + SUMS * j + k) * LANES] = sum[k][0] * end[j][0] + sum[k][1] * end[j][1];
    }
    row[ROW_TURNS * LANES] = 1;
    row[(ROW_TURNS + 1) * LANES] = e1;
    row[(ROW_TURNS + 2) * LANES] = e2;
}

void coupled_stages_make(struct arena *a, struct coupled *c)
{
    struct coupled_modes *m = &c->modes;
    const double h = c->ask.step;
    m->rows = ARENA_TAKE(a, double, ROWS * m->padded);
    m->standing = ARENA_TAKE(a, struct coupled_stages, 1);
    for (int i = 0; i < m->n; i++) {
        mode_rows(m->decay[i] * h, m->square[i] * (h * h / 4),
                  m->rows + (size_t)(i / LANES * LANES) * ROWS + i % LANES);
        m->drain[i] = 4 * m->decay[i] / (3 * h); /* 2 sigma q'^2 by the stages' shares */
    }
}

/* Sums over the modes of row phi^2, row phi slope_phi, row slope_phi^2. */
LANES_CLONES
static void weigh(const struct coupled_modes *m, int row, double *to)
{
    double sum[3][LANES] = {{0}};
    for (int i = 0; i < m->padded; i += LANES) {
        const double *rows = coupled_stages_rows(m, i) + row * LANES;
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            double phi = m->phi[i + l], slope_phi = m->slope_phi[i + l], r = rows[l];
            sum[0][l] += r * (phi * phi);
            sum[1][l] += r * (phi * slope_phi);
            sum[2][l] += r * (slope_phi * slope_phi);
        }
    }
    for (int k = 0; k < 3; k++)
        to[k] = coupled_stages_sum(sum[k]);
}

/* Answers of phi at n + x to forces at phi of n + y; of slope_phi, those of y alone. */
static void find_answers(const struct coupled_modes *m, struct coupled_stages *s)
{
    static const struct {
        int to, turns;
        double x, y;
    } of[] = {{A1_SELF, 0, 0.5, 0},     {A2_SELF, 0, 0.5, 0.5}, {A2_OLDER, 1, 0.5, 0}, {A3_SELF, 0, 1, 0.5},
              {A3_OLDER, 1, 1, 0},      {A3_MIDDLE, 1, 1, 0.5}, {A3_OLDEST, 2, 1, 0},  {GLIDE2, 0, 0, 0},
              {GLIDE3_SELF, 0, 0, 0.5}, {GLIDE3_OLDER, 1, 0, 0}};
    double sum[3][3];
    for (int i = 0; i < 3; i++)
        weigh(m, ROW_TURNS + i, sum[i]);
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++) {
        const double *c = sum[of[i].turns], both = of[i].x + of[i].y;
        bool glides = of[i].to >= LANES;
        s->answer[0][of[i].to] = glides ? c[1] + of[i].y * c[2] : c[0] + both * c[1] + of[i].x * of[i].y * c[2];
        s->answer[1][of[i].to] = glides ? c[2] : 2 * c[1] + both * c[2];
        s->answer[2][of[i].to] = glides ? 0 : c[2];
    }
}

static void find_replies(const struct coupled_modes *m, struct coupled_stages *s)
{
    static const double reach[STAGES] = {0, 0.5, 0.5, 1};
    for (int j = 0; j < STAGES; j++)
        for (int k = 0; k < SUMS; k++) {
            double c[3];
            weigh(m, ROW_REPLY + SUMS * j + k, c);
            for (int w = 0; w < 2; w++) {
                s->reply[0][j][w * LANES + k] = c[w] + reach[j] * c[w + 1];
                s->reply[1][j][w * LANES + k] = c[w + 1];
            }
        }
}

/* Sums of five values a mode with phi and with slope_phi. */
static inline __attribute__((always_inline)) void weigh_five(const struct coupled_modes *m, bool far, double *to)
{
    double s[SUMS][LANES] = {{0}}, t[SUMS][LANES] = {{0}};
    for (int i = 0; i < m->padded; i += LANES) {
        const double *rows = coupled_stages_rows(m, i);
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            const double phi = m->phi[i + l], slope_phi = m->slope_phi[i + l], q = m->q[i + l], v = m->swing[i + l];
            struct coupled_stages_mode at = {.q = q, .v = v}, o = {.q = q,
                                                                   .v = v,
                                                                   .damp = rows[ROW_DAMP * LANES + l],
                                                                   .square = rows[ROW_SQUARE * LANES + l]};
            coupled_stages_step(&o, 0, 0, 0, 0);
            const double f0 = far ? coupled_stages_far(rows, l, SUM_Q, &at) : q,
                         f1 = far ? coupled_stages_far(rows, l, SUM_V, &at) : v,
                         f2 = far ? coupled_stages_far(rows, l, SUM_V1, &at) : o.v1,
                         f3 = far ? coupled_stages_far(rows, l, SUM_V2, &at) : o.v2,
                         f4 = far ? coupled_stages_far(rows, l, SUM_V3, &at) : o.v3;
            s[SUM_Q][l] += phi * f0;
            s[SUM_V][l] += phi * f1;
            s[SUM_V1][l] += phi * f2;
            s[SUM_V2][l] += phi * f3;
            s[SUM_V3][l] += phi * f4;
            t[SUM_Q][l] += slope_phi * f0;
            t[SUM_V][l] += slope_phi * f1;
            t[SUM_V1][l] += slope_phi * f2;
            t[SUM_V2][l] += slope_phi * f3;
            t[SUM_V3][l] += slope_phi * f4;
        }
    }
    coupled_stages_gather(s, to);
    coupled_stages_gather(t, to + LANES);
}

/* now and far, of the first two steps. */
LANES_CLONES
static void find_first(const struct coupled_modes *m, struct coupled_stages *s)
{
    weigh_five(m, false, s->now);
    weigh_five(m, true, s->far);
}

/* Answers and replies, which stay as they are as long as phi does. */
static void find_coefficients(struct coupled_modes *m, struct coupled_stages *s)
{
    if (s->moves || !m->known) {
        find_answers(m, s);
        find_replies(m, s);
        memcpy(m->standing, s, sizeof *s);
    } else
        memcpy(s, m->standing, sizeof *s);
    m->known = !s->moves;
}

void coupled_stages_open(struct coupled *c, int steps, const double *phi_to, struct coupled_stages *s)
{
    struct coupled_modes *m = &c->modes;
    s->moves = phi_to != NULL;
    for (int i = 0; i < m->padded; i++) {
        m->slope_phi[i] = phi_to ? (phi_to[i] - m->phi[i]) / steps : 0;
        m->swing[i] = m->p[i] * (c->ask.step / 2);
    }
    if (m->padded == 0) return;
    find_coefficients(m, s);
    find_first(m, s);
}

LANES_CLONES
void coupled_stages_finish(struct coupled *c, const struct coupled_push *last, struct coupled_stages *s)
{
    struct coupled_modes *m = &c->modes;
    if (s->moves)
        coupled_stages_pass(m, last, true, s);
    else
        coupled_stages_pass(m, last, false, s);
    for (int i = 0; i < m->padded; i++)
        m->p[i] = m->swing[i] * (2 / c->ask.step);
}

static struct coupled_stages_mode mode_of(const struct coupled_modes *m, int i)
{
    const double *rows = coupled_stages_rows(m, i / LANES * LANES);
    return (struct coupled_stages_mode){.q = m->q[i],
                                        .v = m->swing[i],
                                        .damp = rows[ROW_DAMP * LANES + i % LANES],
                                        .square = rows[ROW_SQUARE * LANES + i % LANES]};
}

void coupled_stages_look(const struct coupled *c, const struct coupled_push *p, const struct coupled_stages *s,
                         struct coupled_account *to)
{
    const struct coupled_modes *m = &c->modes;
    const double *g = p->g, rate = 2 / c->ask.step;
    double energy[LANES] = {0}, lost[LANES];
    memcpy(lost, s->lost, sizeof lost);
    for (int i = 0; i < m->padded; i++) {
        struct coupled_stages_mode o = mode_of(m, i);
        o.begin = m->phi[i] + p->on * m->slope_phi[i];
        o.middle = m->phi[i] + (p->on + 0.5) * m->slope_phi[i];
        o.finish = m->phi[i] + (p->on + 1) * m->slope_phi[i];
        coupled_stages_step(&o, g[0], g[1], g[2], g[3]);
        double velocity = o.v * rate;
        lost[i % LANES] += m->drain[i] * o.lost;
        energy[i % LANES] += 0.5 * (m->inertia[i] * velocity * velocity + m->spring[i] * o.q * o.q);
    }
    to->modal = coupled_stages_sum(energy);
    to->mode_loss = coupled_stages_sum(lost);
}
