/* The step of y'' + c y' + w^2 y = a, a = start + (end - start) q over 0 <= q <= 1, q = t/dt, is exact: with p = w y,
   v = y' and the integral I of p,

     d(p, v, a dt, slope dt, I)/dq = M (p, v, a dt, slope dt, I)
      dp = w dt v    dv = -w dt p - c dt v + a dt    d(a dt) = slope dt    dI = p

   has the solution exp(M) after a whole step, whatever the poles are, real, double or complex. exp(M) is Taylor's
   series of M / 2^n, |M| / 2^n < 1/2, squared n times (Moler and Van Loan, SIAM Review 45, 2003): the only operations
   are + and *, the same bits everywhere. */
#include "force/roll_follow.h"

#include <math.h>
#include <string.h>

enum { ORDER = 5, TERMS = 16 };

typedef double matrix[ORDER][ORDER];

static void multiply(matrix a, matrix b, matrix to)
{
    matrix product = {{0}};
    for (int i = 0; i < ORDER; i++)
        for (int k = 0; k < ORDER; k++)
            for (int j = 0; j < ORDER; j++)
                product[i][j] += a[i][k] * b[k][j];
    memcpy(to, product, sizeof product);
}

static void exponential(matrix m)
{
    double norm = 0, scale = 1;
    matrix power = {{0}}, sum = {{0}};
    int squarings = 0;
    for (int i = 0; i < ORDER; i++)
        for (int j = 0; j < ORDER; j++)
            norm = fmax(norm, fabs(m[i][j]));
    for (; norm * ORDER * scale > 0.5; scale *= 0.5)
        squarings++;
    for (int i = 0; i < ORDER; i++) {
        power[i][i] = sum[i][i] = 1;
        for (int j = 0; j < ORDER; j++)
            m[i][j] *= scale;
    }
    for (int n = 1; n <= TERMS; n++) {
        multiply(power, m, power);
        for (int i = 0; i < ORDER; i++)
            for (int j = 0; j < ORDER; j++)
                sum[i][j] += power[i][j] /= n;
    }
    memcpy(m, sum, sizeof sum);
    for (; squarings > 0; squarings--)
        multiply(m, m, m);
}

struct roll_follow roll_follow_make(double resonance, double damping, double dt)
{
    enum { P, V, A, SLOPE, I };
    double w = resonance * dt;
    struct roll_follow f = {.dt = dt};
    matrix m = {[P] = {[V] = w}, [V] = {[P] = -w, [V] = -damping * dt, [A] = 1}, [A] = {[SLOPE] = 1}, [I] = {[P] = 1}};
    exponential(m);
    static const int rows[3] = {P, V, I};
    for (int k = 0; k < 3; k++) {
        double unit = rows[k] == V ? dt : 1 / resonance; /* y = p / w; dt y' = dt v */
        const double *row = m[rows[k]];
        f.step[k][0] = unit * row[P] * resonance;
        f.step[k][1] = unit * row[V] / dt;
        f.push[k][0] = unit * (row[A] - row[SLOPE]) * dt;
        f.push[k][1] = unit * row[SLOPE] * dt;
    }
    return f;
}

double roll_follow_step(struct roll_follow *f, double start, double end)
{
    double to[3], y = f->y, rate = f->rate * f->dt;
    for (int k = 0; k < 3; k++)
        to[k] = f->step[k][0] * y + f->step[k][1] * rate + f->push[k][0] * start + f->push[k][1] * end;
    f->y = to[0];
    f->rate = to[1] / f->dt;
    return to[2];
}
