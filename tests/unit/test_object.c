/* What object_make does for all shapes: material's figures, damping, errors and notes. */
#include "objects.h"
#include "scene/material.h"

static const char *text_of(const struct object_given *g, double top, int most, bool note, struct arena *a)
{
    struct object_ask ask = {.key = "surface.object", .top = top, .most = most};
    struct object o;
    const char *said = NULL;
    struct err e = {0};
    bool good = object_make(g, &ask, a, &o, &said, &e);
    ck_assert_msg(good == note && (good || e.kind == ERR_SCENE), "%s", e.text);
    return note ? (said ? said : "") : arena_text(a, e.text);
}

static void refused(const struct object_given *g, const char *part)
{
    struct arena *a = arena_open();
    const char *text = text_of(g, 20e3, 50, false, a);
    ck_assert_msg(strstr(text, "surface.object") && strstr(text, part), "%s", text);
    arena_close(a);
}

START_TEST(test_errors)
{
    struct object_given g = objects_given(OBJECT_PLATE, EDGES_FREE, 0.3), good = g;
    g.width = NAN;
    refused(&g, "surface.object.width is missing");
    g = good, g.density = NAN;
    refused(&g, "density");
    g = good, g.youngs_modulus = NAN;
    refused(&g, "youngs_modulus");
    g = good, g.poisson = NAN;
    refused(&g, "poisson");
    g = good, g.loss = NAN;
    refused(&g, "alpha, beta or loss");
    g = good, g.youngs_modulus_across = 100.0 * g.youngs_modulus;
    refused(&g, "youngs_modulus_across");
    g = good, g.shape = OBJECT_STRING;
    refused(&g, "surface.object.tension is missing");
    g = good, g.shape = OBJECT_DRUM;
    refused(&g, "surface.object.surface_tension is missing");
    g = good, g.shape = OBJECT_ROD, g.thickness = 1.1;
    refused(&g, "does not fit");
    g = good, g.shape = OBJECT_SHELL, g.thickness = 1.0;
    refused(&g, "does not fit");
    g = good, g.shape = OBJECT_DISK, g.edges = EDGES_CANTILEVER;
    refused(&g, "cantilever");
    g = good, g.length = g.width = 1e-2, g.thickness = 5e-2;
    refused(&g, "no mode of this object below 20000 Hz");
    g = good, g.shape = OBJECT_BAR, g.alpha = 1e6;
    refused(&g, "too damped");
}
END_TEST

/* d = (alpha + beta w^2 + loss w)/2, f = sqrt(w^2 - d^2)/(2 pi), w = n pi c/L of a bar's longitudinal waves. */
START_TEST(test_damping)
{
    struct arena *a = arena_open();
    struct object_given g = objects_given(OBJECT_BAR, EDGES_FREE, 0.3);
    g.waves = WAVES_LONGITUDINAL, g.alpha = 800.0, g.beta = 2e-6, g.loss = 0.05;
    struct object o = objects_make(&g, 10, 1e9, a);
    for (int i = 0; i < 10; i++) {
        double w = (i + 1) * PI * sqrt(g.youngs_modulus / g.density), d = 0.5 * (800.0 + 2e-6 * w * w + 0.05 * w);
        OBJECTS_NEAR(o.decay[i], d, 1e-12);
        OBJECTS_NEAR(o.frequency[i], sqrt(w * w - d * d) / (2.0 * PI), 1e-12);
    }
    arena_close(a);
}
END_TEST

/* Overdamped: from above (stiffness) they end the list, from below (mass) others take their place; near the limit order
 * turns round. */
START_TEST(test_overdamped)
{
    struct arena *a = arena_open();
    struct object_given g = objects_given(OBJECT_BAR, EDGES_FREE, 0.3);
    g.waves = WAVES_LONGITUDINAL;
    double w = PI * sqrt(g.youngs_modulus / g.density);
    g.loss = 0.0, g.beta = 2.0 / (5.5 * w); /* the sixth no longer rings */
    struct object o = objects_make(&g, 50, 1e9, a);
    ck_assert_int_eq(o.n, 5);
    for (int i = 1; i < o.n; i++)
        ck_assert_double_ge(o.frequency[i], o.frequency[i - 1]);
    double top = 0.0, phi[5];
    for (int i = 0; i < o.n; i++)
        top = fmax(top, o.decay[i]);
    ck_assert_double_lt(o.decay[o.n - 1], top); /* not by undamped frequency */
    o.shapes(&o, 0.5, 0.0, phi);
    for (int i = 0; i < 5; i++) { /* cos(n pi/2), n from the decay n^2 w^2 beta/2 */
        int n = (int)rint(sqrt(2.0 * o.decay[i] / g.beta) / w);
        ck_assert_double_lt(fabs(phi[i] - cos(n * PI / 2.0)), 1e-15);
    }
    ck_assert_ptr_nonnull(strstr(text_of(&g, 1e9, 50, true, a), "so damped"));
    g.beta = 0.0, g.alpha = 2.0 * 3.5 * w;
    o = objects_make(&g, 10, 1e9, a);
    ck_assert_int_eq(o.n, 10);
    OBJECTS_NEAR(objects_w(&o, 0), 4.0 * w, 1e-9);
    arena_close(a);
}
END_TEST

/* Keys beat the material; what is isotropic follows youngs_modulus, wood keeps its own moduli across. */
START_TEST(test_material)
{
    struct arena *a = arena_open();
    const struct material *oak = material_find(MATERIAL_OAK), *steel = material_find(MATERIAL_STEEL);
    struct object_given g = objects_given(OBJECT_PLATE, EDGES_SUPPORTED, NAN),
                        explicit = objects_given(OBJECT_PLATE, EDGES_SUPPORTED, oak->poisson);
    g.material = MATERIAL_OAK, g.width = 0.4, g.youngs_modulus = g.density = g.loss = NAN;
    explicit.width = 0.4, explicit.density = oak->density, explicit.youngs_modulus = oak->youngs_modulus,
    explicit.youngs_modulus_across = oak->across;
    explicit.shear_modulus = oak->shear, explicit.loss = oak->loss, explicit.alpha = oak->alpha,
    explicit.beta = oak->beta;
    struct object o = objects_make(&g, 20, 1e9, a), want = objects_make(&explicit, 20, 1e9, a);
    ck_assert_mem_eq(o.frequency, want.frequency, 20 * sizeof(double));
    ck_assert_mem_eq(o.decay, want.decay, 20 * sizeof(double));
    explicit.youngs_modulus_across = explicit.shear_modulus = NAN;
    want = objects_make(&explicit, 20, 1e9, a);
    ck_assert_double_gt(fabs(o.frequency[2] / want.frequency[2] - 1.0), 0.1);
    g.material = MATERIAL_STEEL, g.youngs_modulus = 4.0 * steel->youngs_modulus, g.width = 1.0;
    o = objects_make(&g, 5, 1e9, a);
    OBJECTS_NEAR(objects_w(&o, 2) / objects_w(&o, 0), 2.5, 1e-9); /* a square of one modulus: 5/2 twice */
    OBJECTS_NEAR(objects_w(&o, 1), objects_w(&o, 2), 1e-9);
    arena_close(a);
}
END_TEST

/* Timoshenko's first-order terms; steel bar 10 mm: the note begins near (k r)^2/2 (1 + 3.12) = 5 %, k = 54/m: 4.6 kHz.
 */
START_TEST(test_notes)
{
    struct arena *a = arena_open();
    struct object_given g = objects_given(OBJECT_BAR, EDGES_SUPPORTED, 0.3);
    g.youngs_modulus = 200e9, g.density = 7850.0, g.length = 0.3, g.width = 0.02, g.thickness = 0.01;
    const char *note = text_of(&g, 20e3, 50, true, a);
    ck_assert_msg(strstr(note, "slender-bar theory") != NULL, "%s", note);
    double from = atof(strstr(note, "from ") + 5), k = sqrt(0.1 / (1.0 + 2.6 * 6.0 / 5.0)) / (0.01 / sqrt(12.0));
    double limit = k * k * sqrt(200e9 * 1e-4 / (12.0 * 7850.0)) / (2.0 * PI);
    ck_assert_msg(from >= limit && from < 1.6 * limit, "%s", note);
    ck_assert_str_eq(text_of(&g, limit, 50, true, a), "");
    g = objects_given(OBJECT_PLATE, EDGES_FREE, 0.3);
    note = text_of(&g, 1e9, 500, true, a);
    ck_assert_msg(strstr(note, "only the lowest 400") != NULL, "%s", note);
    ck_assert_str_eq(text_of(&g, 10.0, 500, true, a), "");
    g.width = 1e-3;
    note = text_of(&g, 1e9, 400, true, a);
    ck_assert_msg(strstr(note, "only the lowest") != NULL, "%s", note);
    arena_close(a);
}
END_TEST

/* `top` and `most`: nothing at or above, no more than. */
START_TEST(test_limits)
{
    struct arena *a = arena_open();
    for (int shape = OBJECT_BAR; shape <= OBJECT_SHELL; shape++) {
        struct object_given g = objects_any(shape);
        struct object many = objects_make(&g, 60, 1e9, a), few = objects_make(&g, 25, 1e9, a),
                      low = objects_make(&g, 60, many.frequency[30], a);
        ck_assert(many.n == 60 && few.n == 25 && low.n > 20 && low.n <= 31);
        for (int i = 0; i < 25; i++)
            OBJECTS_NEAR(few.frequency[i], many.frequency[i], 2e-6);
        for (int i = 0; i < low.n; i++)
            OBJECTS_NEAR(low.frequency[i], many.frequency[i], 2e-6);
        for (int i = 1; i < 60; i++)
            ck_assert(many.frequency[i] >= many.frequency[i - 1] && many.mass[i] > 0.0);
    }
    arena_close(a);
}
END_TEST

UNIT("object", test_errors, test_damping, test_overdamped, test_material, test_notes, test_limits)
