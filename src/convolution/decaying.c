/* The energy of sum_k c_k e^(s_k t), s_k = s + delta_k, s = -sigma + j omega the last one's.

   Laguerre's functions phi_r(t) = sqrt(2 sigma) L_r(2 sigma t) e^(s t) are orthonormal on t >= 0, and with z_k = delta_k/(2 sigma)

       <e^(s_k t), phi_r> = (1/sqrt(2 sigma)) (-z_k)^r / (1 - z_k)^(r+1)

   (the Laplace transform of L_r), so by Parseval

       int |sum|^2 dt = (1/(2 sigma)) sum_r |a_r|^2,   a_r = sum_k c_k/(1 - z_k) q_k^r,   q_k = -z_k/(1 - z_k), |q_k| < 1 as long as s_k decays.

   What cancels does so in the amplitudes a_r, to 1e-16 of the c_k: an interpolation error of -240 dB is seen. In the plain sum over pairs,

       sum_jk c_j c_k* / -(s_j + s_k*),

   it cancels in the energies, to 1e-16 of those; that serves where poles lie so far apart (|q|^2 > 1/2) that nothing cancels so well.

   Until an end that comes before the sound has died away the amplitude e^(sigma t) times the sum is followed by multiplication over 32 even steps, and
   |sum|^2 is integrated by Simpson's rule: of x^8, 2e-5 too much. Where phases turn so far that steps might miss it, errors are no longer small, and the
   sum over pairs serves again, each until the end: (1 - e^((s_j + s_k*) end))/-(s_j + s_k*).

   With weights the sum over r is taken at Gauss-Legendre's points of x = 2 sigma t, from 0 to 32 at most: of x^8 e^(-x), as interpolation of order 4
   errs, 1e-7 lies beyond. */
#include "convolution/decaying.h"

#include <math.h>
#include <stdbool.h>

#include "num/real.h"

enum { TERMS = DECAYING_TERMS, HALF = DECAYING_POINTS / 2 };
#define FAR 0.5   /* |q|^2 */

struct series {
    int terms;
    double re[TERMS], im[TERMS], sum; /* a_r; sum of their squares */
};

struct turn {
    double re, im;
};

static struct turn times(struct turn a, struct turn b)
{
    return (struct turn){a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}

static double square(struct turn a)
{
    return a.re * a.re + a.im * a.im;
}

/* b[k] = c_k/(1 - z_k), q[k]; returns the largest |q|^2. */
static double begin(const struct decaying *x, int n, struct turn *b, struct turn *q)
{
    double largest = 0, per = 0.5 / x[n - 1].decay;
    for (int k = 0; k < n; k++) {
        struct turn z = {(x[n - 1].decay - x[k].decay) * per, (x[k].omega - x[n - 1].omega) * per}, one = {1 - z.re, z.im};
        double size = square(one);
        one = (struct turn){one.re / size, one.im / size}; /* 1/(1 - z): one was its conjugate */
        b[k] = times((struct turn){x[k].re, x[k].im}, one);
        q[k] = times((struct turn){-z.re, -z.im}, one);
        largest = fmax(largest, square(q[k]));
    }
    return largest;
}

/* False: the poles lie too far apart. */
static bool series_make(const struct decaying *x, int n, struct series *s)
{
    struct turn b[DECAYING_MOST], q[DECAYING_MOST];
    double largest = begin(x, n, b, q), whole = 0, left;
    if (largest > FAR)
        return false;
    for (int k = 0; k < n; k++)
        whole += square(b[k]);
    left = n * whole / (1 - largest);
    s->sum = 0;
    for (s->terms = 0; s->terms < TERMS && (s->terms == 0 || left > fmax(1e-4 * s->sum, 1e-34 * whole)); s->terms++, left *= largest) {
        struct turn a = {0, 0};
        for (int k = 0; k < n; k++) {
            a = (struct turn){a.re + b[k].re, a.im + b[k].im};
            b[k] = times(b[k], q[k]);
        }
        s->re[s->terms] = a.re;
        s->im[s->terms] = a.im;
        s->sum += square(a);
    }
    return true;
}

static double pairs(const struct decaying *x, int n)
{
    double sum = 0;
    for (int j = 0; j < n; j++)
        for (int k = 0; k < n; k++) {
            double decay = x[j].decay + x[k].decay, turn = x[j].omega - x[k].omega;
            double re = x[j].re * x[k].re + x[j].im * x[k].im, im = x[j].im * x[k].re - x[j].re * x[k].im;
            sum += (re * decay - im * turn) / (decay * decay + turn * turn); /* Re (re + j im)/(decay - j turn) */
        }
    return fmax(sum, 0);
}

double decaying_energy(const struct decaying *x, int n)
{
    struct series s;
    return series_make(x, n, &s) ? s.sum / (2 * x[n - 1].decay) : pairs(x, n);
}

/* ------------------------------------------------------------------ until an end */

enum { STEPS = 32 };

/* int_0^end e^(-(decay - j turn) t) dt */
static struct turn integral(double decay, double turn, double end)
{
    double size = real_exp(-decay * end), square = decay * decay + turn * turn;
    struct turn top = {1 - size * real_cos(turn * end), -size * real_sin(turn * end)};
    if (square * end * end < 1e-16)
        return (struct turn){end, 0};
    top = times(top, (struct turn){decay, turn});
    return (struct turn){top.re / square, top.im / square};
}

static double pairs_until(const struct decaying *x, int n, double end)
{
    double sum = 0;
    for (int j = 0; j < n; j++)
        for (int k = 0; k < n; k++) {
            struct turn c = {x[j].re * x[k].re + x[j].im * x[k].im, x[j].im * x[k].re - x[j].re * x[k].im};
            sum += times(c, integral(x[j].decay + x[k].decay, x[j].omega - x[k].omega, end)).re;
        }
    return fmax(sum, 0);
}

/* Simpson's rule, the terms' own decay within them. */
static double stepped(const struct decaying *x, int n, double end)
{
    struct turn now[DECAYING_MOST], step[DECAYING_MOST];
    double sum = 0, h = end / STEPS;
    for (int k = 0; k < n; k++) {
        double size = real_exp(-x[k].decay * h), turn = (x[k].omega - x[n - 1].omega) * h;
        now[k] = (struct turn){x[k].re, x[k].im};
        step[k] = (struct turn){size * real_cos(turn), size * real_sin(turn)};
    }
    for (int i = 0; i <= STEPS; i++) {
        struct turn a = {0, 0};
        for (int k = 0; k < n; k++) {
            a = (struct turn){a.re + now[k].re, a.im + now[k].im};
            now[k] = times(now[k], step[k]);
        }
        sum += square(a) * (i == 0 || i == STEPS ? 1 : i % 2 ? 4 : 2);
    }
    return sum * h / 3;
}

double decaying_energy_until(const struct decaying *x, int n, double end, double *alone)
{
    const struct decaying *last = &x[n - 1];
    double most = 0;
    for (int k = 0; k < n; k++)
        most = fmax(most, fabs(x[k].omega - last->omega) * end);
    *alone = (last->re * last->re + last->im * last->im) * integral(2 * last->decay, 0, end).re;
    return most > DECAYING_APART ? pairs_until(x, n, end) : stepped(x, n, end);
}

/* ------------------------------------------------------------------ with weights */

/* Gauss-Legendre of 24 points on [-1, 1] (Abramowitz and Stegun, table 25.4): the positive half. */
static const double point[HALF] = {0.064056892862605626, 0.191118867473616309, 0.315042679696163374, 0.433793507626045138, 0.545421471388839536,
                                   0.648093651936975569, 0.740124191578554364, 0.820001985973902922, 0.886415527004401034, 0.938274552002732759,
                                   0.974728555971309498, 0.995187219997021360};
static const double share[HALF] = {0.127938195346752157, 0.125837456346828296, 0.121670472927803391, 0.115505668053725601, 0.107444270115965635,
                                   0.097618652104113888, 0.086190161531953276, 0.073346481411080306, 0.059298584915436781, 0.044277438817419806,
                                   0.028531388628933663, 0.012341229799987200};

static double unit_point(int k)
{
    return k < HALF ? 0.5 * (1 - point[HALF - 1 - k]) : 0.5 * (1 + point[k - HALF]);
}

static double unit_share(int k)
{
    return 0.5 * share[k < HALF ? HALF - 1 - k : k - HALF];
}

void decaying_points_make(double range, struct decaying_points *p)
{
    range = fmin(range, DECAYING_RANGE);
    for (int k = 0; k < DECAYING_POINTS; k++) {
        double x = p->x[k] = range * unit_point(k), before = 0, now = 1;
        p->share[k] = range * unit_share(k) * real_exp(-x);
        for (int r = 0; r < TERMS; r++) {
            double next = ((2 * r + 1 - x) * now - r * before) / (r + 1);
            p->laguerre[r][k] = now;
            before = now;
            now = next;
        }
    }
}

double decaying_energy_weighted(const struct decaying *x, int n, const struct decaying_points *p, const double *weight, double *alone)
{
    const struct decaying *last = &x[n - 1];
    struct series s = {0};
    bool near = series_make(x, n, &s);
    double re[DECAYING_POINTS] = {0}, im[DECAYING_POINTS] = {0}, sum = 0, mean = 0, size = last->re * last->re + last->im * last->im;
    for (int r = 0; r < s.terms; r++)
        for (int k = 0; k < DECAYING_POINTS; k++) {
            re[k] += s.re[r] * p->laguerre[r][k];
            im[k] += s.im[r] * p->laguerre[r][k];
        }
    for (int k = 0; k < DECAYING_POINTS; k++) {
        mean += p->share[k] * weight[k];
        sum += p->share[k] * weight[k] * (re[k] * re[k] + im[k] * im[k]);
    }
    *alone = size * mean / (2 * last->decay);
    return near ? sum / (2 * last->decay) : pairs(x, n) * mean;
}
