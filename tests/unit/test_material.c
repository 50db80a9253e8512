/* material.def: the words and the order of the scene's materials, sane figures, the law of damping against an
 * oscillator. */
#include "scene/keys.h"
#include "scene/material.h"
#include "unit.h"

static const struct choice *words(void) { return keys_find("surface.material")->choices; }

START_TEST(the_words_of_scenes_in_their_order)
{
    int n = 0;
    ck_assert_str_eq(words()[MATERIAL_CUSTOM].word, "custom");
    ck_assert_ptr_null(material_find(MATERIAL_CUSTOM));
    for (int i = 1; words()[i].word; i++) {
        ck_assert_ptr_nonnull(material_find(i));
        ck_assert_str_eq(material_find(i)->name, words()[i].word);
        n++;
    }
    ck_assert_int_eq(n, MATERIAL_ALUMINIUM);
    ck_assert_ptr_null(material_table[n].name);
    ck_assert_ptr_null(material_find(n + 1));
    ck_assert_ptr_null(material_find(-1));
}
END_TEST

/* Ranges of solids; positive definite elasticity (nu_xy nu_yx < 1); what is isotropic is so in all its figures; plates
 * ring (60 dB at 1 kHz: 0.02 to 20 s). */
START_TEST(figures_are_sane)
{
    for (const struct material *m = material_table; m->name; m++) {
        double nu = m->poisson, w = 2000 * M_PI, decay = material_decay(m->alpha, m->beta, m->loss, w);
        ck_assert_msg(m->youngs_modulus > 1e9 && m->youngs_modulus < 5e11, "%s", m->name);
        ck_assert_msg(m->density > 100 && m->density < 2e4, "%s", m->name);
        ck_assert_msg(m->across > 0.02 * m->youngs_modulus && m->across <= m->youngs_modulus, "%s", m->name);
        ck_assert_msg(nu > 0 && nu < 0.5 && nu * nu * m->across / m->youngs_modulus < 1, "%s", m->name);
        ck_assert_msg(m->shear > 0.02 * m->youngs_modulus && m->shear < 0.5 * m->youngs_modulus, "%s", m->name);
        ck_assert_msg(m->alpha >= 0 && m->beta >= 0 && m->loss >= 0 && m->loss < 0.1, "%s", m->name);
        ck_assert_msg(6.9 / decay > 0.02 && 6.9 / decay < 20, "%s: %g s", m->name, 6.9 / decay);
        if (m->across == m->youngs_modulus)
            ck_assert_double_eq_tol(m->shear * 2 * (1 + nu), m->youngs_modulus, 1e-6 * m->youngs_modulus);
        ck_assert_msg(strlen(m->source) > 20 && strlen(m->damping_source) > 20, "%s", m->name);
        ck_assert_msg(!strpbrk(m->source, "\n\"") && !strpbrk(m->damping_source, "\n\""),
                      "%s: the source is to fit a comment of a table", m->name);
    }
}
END_TEST

/* Speeds of sound along bars, sqrt(E/rho), as tables of physical constants have them, within their scatter of 5 %. */
START_TEST(speeds_of_sound)
{
    static const struct {
        int name;
        double speed; /* m/s */
    } known[] = {{MATERIAL_STEEL, 5170}, {MATERIAL_ALUMINIUM, 5090}, {MATERIAL_GLASS, 5300}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        const struct material *m = material_find(known[i].name);
        ck_assert_double_eq_tol(sqrt(m->youngs_modulus / m->density), known[i].speed, 0.05 * known[i].speed);
    }
}
END_TEST

/* Amplitude after 20 periods of m x'' + c x' + k x = 0, m = 1, by small Runge-Kutta steps (error below 1e-8), c = alpha
 * + beta k. */
START_TEST(decay_of_an_oscillator)
{
    double w = 3000, alpha = 4, beta = 3e-6, c = alpha + beta * w * w, s = material_decay(alpha, beta, 0, w), x = 1,
           v = -s;
    double wd = sqrt(w * w - s * s);
    int n = 20000;
    double h = 20 * 2 * M_PI / wd / n;
    for (int i = 0; i < n; i++) {
        double k1 = v, l1 = -c * v - w * w * x, k2 = v + h / 2 * l1,
               l2 = -c * (v + h / 2 * l1) - w * w * (x + h / 2 * k1);
        double k3 = v + h / 2 * l2, l3 = -c * (v + h / 2 * l2) - w * w * (x + h / 2 * k2), k4 = v + h * l3,
               l4 = -c * (v + h * l3) - w * w * (x + h * k3);
        x += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
        v += h / 6 * (l1 + 2 * l2 + 2 * l3 + l4);
    }
    ck_assert_double_eq_tol(x, exp(-s * n * h), 1e-7);
    /* A loss factor eta is eta = 2 decay/w, and the three add up. */
    ck_assert_double_eq_tol(material_decay(0, 0, 0.01, w), 15, 1e-12);
    ck_assert_double_eq_tol(material_decay(alpha, beta, 0.01, w), s + 15, 1e-12);
}
END_TEST

UNIT("material", the_words_of_scenes_in_their_order, figures_are_sane, speeds_of_sound, decay_of_an_oscillator)
