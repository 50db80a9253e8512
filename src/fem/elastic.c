/* Hooke's law, stress = C strain, in the order xx yy zz yz zx xy with engineering shear (twice the tensor's).

   Isotropic (E: Young's modulus, nu: Poisson's ratio):  C_ii = L + 2 G, C_ij = L (i, j < 3), C_kk = G (k > 2),
   L = E nu/((1 + nu)(1 - 2 nu)), G = E/(2 (1 + nu)).

   Orthotropic: its inverse, the compliance, is what moduli are measured as: S_ii = 1/E_i, S_ij = -nu_ij/E_i = S_ji,
   S_kk = 1/G_k (Ting, Anisotropic Elasticity, 1996, section 2.3). Energy is positive for every strain if and only if
   all leading minors of S are. */
#include "fem/elastic.h"

#include <math.h>
#include <string.h>

bool elastic_isotropic(double youngs_modulus, double poisson, double density, struct elastic *s, struct err *e)
{
    if (!(youngs_modulus > 0.0) || !isfinite(youngs_modulus) || !(density > 0.0) || !isfinite(density))
        return err_set(e, ERR_USAGE, "a material of Young's modulus %g Pa and density %g kg/m^3: both must be above 0",
                       youngs_modulus, density);
    if (!(poisson > -1.0 && poisson < 0.5))
        return err_set(e, ERR_USAGE,
                       "Poisson's ratio %g: it must be above -1 and below 0.5 (metals 0.3, glass 0.2, rubber 0.49)",
                       poisson);
    memset(s, 0, sizeof *s);
    double lame = youngs_modulus * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)),
           shear = 0.5 * youngs_modulus / (1.0 + poisson);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            s->c[i][j] = i == j ? lame + 2.0 * shear : lame;
        s->c[i + 3][i + 3] = shear;
    }
    s->density = density;
    return true;
}

/* Cofactor of a 3 x 3 matrix, its sign included. */
static double cofactor(const double m[3][3], int i, int j)
{
    int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
    return m[a][c] * m[b][d] - m[a][d] * m[b][c];
}

static bool positive(const struct elastic_wood *w)
{
    for (int i = 0; i < 3; i++)
        if (!(w->e[i] > 0.0) || !isfinite(w->e[i]) || !(w->g[i] > 0.0) || !isfinite(w->g[i]) || !isfinite(w->nu[i]))
            return false;
    return w->density > 0.0 && isfinite(w->density);
}

bool elastic_orthotropic(const struct elastic_wood *w, struct elastic *s, struct err *e)
{
    if (!positive(w))
        return err_set(
            e, ERR_USAGE,
            "an orthotropic material of E %g %g %g Pa, G %g %g %g Pa and density %g kg/m^3: all must be above 0",
            w->e[0], w->e[1], w->e[2], w->g[0], w->g[1], w->g[2], w->density);
    double yz = -w->nu[0] / w->e[1], xz = -w->nu[1] / w->e[0], xy = -w->nu[2] / w->e[0];
    const double compliance[3][3] = {{1.0 / w->e[0], xy, xz}, {xy, 1.0 / w->e[1], yz}, {xz, yz, 1.0 / w->e[2]}};
    double minor = cofactor(compliance, 2, 2), whole = 0.0;
    for (int j = 0; j < 3; j++)
        whole += compliance[0][j] * cofactor(compliance, 0, j);
    if (!(minor > 0.0 && whole > 0.0))
        return err_set(e, ERR_USAGE,
                       "no material has Poisson's ratios yz %g, xz %g, xy %g beside E %g %g %g Pa (some pull would "
                       "give energy out): nu_ij^2 must be well below E_i/E_j",
                       w->nu[0], w->nu[1], w->nu[2], w->e[0], w->e[1], w->e[2]);
    memset(s, 0, sizeof *s);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            s->c[i][j] = cofactor(compliance, i, j) / whole;
        s->c[i + 3][i + 3] = w->g[i];
    }
    s->density = w->density;
    return true;
}
