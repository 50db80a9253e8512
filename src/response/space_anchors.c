/* Anchors of the space of materials (papers/004, "Intuitive Sound-Synthesis Control"; its source is Aramaki, Besson,
   Kronland-Martinet, Ystad, Controlling the perceived material in an impact sound synthesizer, IEEE TASLP 2011). 004
   puts wood, metal and glass on the rim of a unit disk and says that spectral and damping parameters are interpolated
   by the distance to them; it prints neither their values nor, for materials, the rule. Ours:

   Shares. As 004 does for interactions (equations 8 to 11), with wood, metal, glass at theta_k = 0, 2 pi/3, 4 pi/3 for
   rubbing, scratching, rolling: on the rim P(theta) = sum_k T(theta - theta_k) P_k, T(t) = 1 - 3 |t| / (2 pi) for |t| <
   2 pi/3 (t taken round the circle), else 0; inside P(theta, r) = (1 - r) mean(P_k) + r P(theta). So share w_k = (1 -
   r)/3 + r T(theta - theta_k).

   Materials: wood is basswood, metal steel, glass glass of material.def.

   Damping: material_decay of those figures. (The 2011 paper has decay = exp(a_G + a_R w); two parameters a material,
   whose interpolation is that of ln decay at every w. We interpolate ln decay too, of the materials' own laws, which
   are not exponential.)

   Spectra: what a shape of each material has of closed forms; the material acts through its ratios of stiffness only,
   the size is that of the fundamental asked for. bar    free, length l = 30 h, Timoshenko's dispersion (Timoshenko
   1921) at the wave numbers b_i/l of the slender bar, cosh b cos b = 1 (the ends' near field is left as that of the
   slender bar: an approximation). With a = k^2 h^2/12 and s = E/(5/6 G), w^2 is in proportion to the smaller root y of
   s y^2 - (1 + a (1 + s)) y + a^2 = 0. Wood, weak in shear (s = 26; steel 3.1), has its overtones lower. plate
   supported, sides 1 : 0.7, orthotropic (Leissa, NASA SP-160): w^2 ~ m^4 + 2 H/Dx m^2 (n/0.7)^2 + Dy/Dx (n/0.7)^4,
   Dy/Dx = E_y/E, H/Dx = nu E_y/E + 2 G (1 - nu^2 E_y/E)/E: 1 of what is isotropic, all ratios of metal and glass are
   alike. shell  closed thin sphere, h = R/50 (Junger, Feit, Sound, Structures, and Their Interaction, ch. 7), the lower
   root W^2, W = w R sqrt(rho (1 - nu^2)/E), of W^4 - (1 + 3 nu + L - q (1 - nu - L^2 - nu L)) W^2 + (L - 2) (1 - nu^2)
   + q (L^3 - 4 L^2 + L (5 - nu^2) - 2 (1 - nu^2)) = 0, L = i (i + 1), i = 2, 3, ..., q = h^2/(12 R^2); wood as if
   isotropic, nu = sqrt(nu_LT nu_TL) = nu_LT sqrt(E_T/E_L).

   Gains: equal modal masses of bar (its end) and plate (on average over it); (2 i + 1)/5 of a shell, whose 2 i + 1
   modes of one frequency move as one where it is touched. */
#include "response/space_anchors.h"

#include <stdlib.h>

#include "num/real.h"
#include "scene/material.h"

static const struct material *material_of(int anchor)
{
    static const int names[SPACE_ANCHORS] = {
        [SPACE_WOOD] = MATERIAL_BASSWOOD, [SPACE_METAL] = MATERIAL_STEEL, [SPACE_GLASS] = MATERIAL_GLASS};
    return material_find(names[anchor]);
}

/* ------------------------------------------------------------------ shares */

void space_anchors_shares(double x, double y, double w[SPACE_ANCHORS])
{
    double r = fmin(sqrt(x * x + y * y), 1.0),
           third = 3.0 * real_atan2(y, x) / (2.0 * REAL_PI); /* theta in thirds of a turn, -1.5 .. 1.5 */
    for (int k = 0; k < SPACE_ANCHORS; k++) {
        double t = fabs(third - k);
        t = fmin(t, fabs(t - 3.0));
        w[k] = (1.0 - r) / 3.0 + r * fmax(1.0 - t, 0.0);
    }
}

/* ------------------------------------------------------------------ bar */

/* The i-th root above 0 of cosh b cos b = 1, by Newton's steps on cos b - 1/cosh b. */
static double bar_root(int i)
{
    double b = (i + 1.5) * REAL_PI;
    for (int step = 0; step < 8; step++) {
        double e = real_exp(-b), sech = 2.0 * e / (1.0 + e * e);
        b += (real_cos(b) - sech) / (real_sin(b) - sech * (1.0 - e * e) / (1.0 + e * e));
    }
    return b;
}

static double bar_square(const struct material *m, int i)
{
    double k = bar_root(i) / 30.0, a = k * k / 12.0, s = m->youngs_modulus / (5.0 / 6.0 * m->shear),
           b = 1.0 + a * (1.0 + s);
    return 2.0 * a * a / (b + sqrt(b * b - 4.0 * s * a * a));
}

/* ------------------------------------------------------------------ plate */

struct plate {
    double cross, across; /* 2 H/Dx, Dy/Dx */
};

static double plate_square(const struct plate *p, double m, double n)
{
    double mm = m * m, nn = n * n / 0.49;
    return mm * mm + p->cross * mm * nn + p->across * nn * nn;
}

/* How many (m, n) have a square of at most `most`; the first `room` of them go to `to`. */
static int plate_modes(const struct plate *p, double most, int room, double *to)
{
    int found = 0;
    for (int m = 1; plate_square(p, m, 1) <= most; m++)
        for (int n = 1; plate_square(p, m, n) <= most; n++, found++)
            if (found < room) to[found] = plate_square(p, m, n);
    return found;
}

static int rising(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

static void plate_squares(const struct material *m, int n, double *square, struct arena *a)
{
    double across = m->across / m->youngs_modulus, nu = m->poisson;
    struct plate p = {.across = across,
                      .cross = 2.0 * (nu * across + 2.0 * m->shear * (1.0 - nu * nu * across) / m->youngs_modulus)};
    double most = plate_square(&p, 1, 1);
    while (plate_modes(&p, most, 0, NULL) < n)
        most *= 1.5;
    int found = plate_modes(&p, most, 0, NULL);
    double *all = ARENA_TAKE(a, double, found);
    plate_modes(&p, most, found, all);
    qsort(all, (size_t)found, sizeof *all, rising);
    for (int i = 0; i < n; i++)
        square[i] = all[i];
}

/* ------------------------------------------------------------------ shell */

static double shell_square(const struct material *m, int i)
{
    double nu = m->poisson * sqrt(m->across / m->youngs_modulus), q = 1.0 / (12.0 * 50.0 * 50.0),
           l = (i + 2.0) * (i + 3.0), v = 1.0 - nu * nu;
    double b = 1.0 + 3.0 * nu + l - q * (1.0 - nu - l * l - nu * l);
    double c = (l - 2.0) * v + q * (l * l * l - 4.0 * l * l + l * (5.0 - nu * nu) - 2.0 * v);
    return 2.0 * c / (b + sqrt(b * b - 4.0 * c));
}

/* ------------------------------------------------------------------ all */

void space_anchors_spectrum(int shape, int anchor, int n, double *log_ratio, struct arena *a)
{
    const struct material *m = material_of(anchor);
    if (shape == SPACE_PLATE)
        plate_squares(m, n, log_ratio, a);
    else
        for (int i = 0; i < n; i++)
            log_ratio[i] = shape == SPACE_BAR ? bar_square(m, i) : shell_square(m, i);
    double first = log_ratio[0];
    for (int i = 0; i < n; i++)
        log_ratio[i] = 0.5 * real_log(log_ratio[i] / first);
}

double space_anchors_gain(int shape, int i) { return shape == SPACE_SHELL ? (2.0 * i + 5.0) / 5.0 : 1.0; }

double space_anchors_decay(int anchor, double w)
{
    const struct material *m = material_of(anchor);
    return material_decay(m->alpha, m->beta, m->loss, w);
}
