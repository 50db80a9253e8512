/* What `rasp accuracy` says of two sounds whose differences are known, and what it makes of errors whose order is
 * known. */
#include "cmd/accuracy.h"
#include "file/wav.h"
#include "rig.h"
#include "scene/accuracy.h"
#include "scene/keys.h"
#include "stage.h"
#include "unit.h"

enum { RATE = 48000, N = RATE, CHANNELS = 2 };

static double x[N * CHANNELS], y[N * CHANNELS];

static struct wav wav_of(double *samples)
{
    return (struct wav){.rate = RATE, .channels = CHANNELS, .frames = N, .x = samples};
}

static void make(double size)
{
    unsigned seed = 9;
    for (int i = 0; i < N * CHANNELS; i++) {
        x[i] = (double)((seed = seed * 1103515245u + 12345u) >> 16 & 32767) / 16384 - 1;
        y[i] = x[i] * (1 + size);
    }
}

/* All of it (1 + 1e-3) times as large: 60 dB below the sound, 20 log10(1.001) dB louder in every band. */
START_TEST(a_factor)
{
    struct wav a = wav_of(x), b = wav_of(y);
    double louder = 20 * log10(1.001);
    make(1e-3);
    struct accuracy_error o = accuracy_child_distance(&a, &b, INFINITY);
    ck_assert_double_eq_tol(o.snr, 60, 1e-9);
    ck_assert_double_eq_tol(o.third, louder, 1e-9);
    ck_assert_double_eq_tol(o.spectral, louder, 1e-4);
    ck_assert_double_eq_tol(o.level, louder, 1e-9);
    ck_assert_double_eq(o.follows, 1);
    ck_assert_double_eq(o.length, 1);
}
END_TEST

/* After half a second the level halves: before it samples are compared, after it statistics. */
START_TEST(a_divergence)
{
    struct wav a = wav_of(x), b = wav_of(y);
    make(1e-3);
    for (int i = N; i < N * CHANNELS; i++)
        y[i] = i % CHANNELS ? -0.5 * x[i] : 0.5 * x[i];
    struct accuracy_error o = accuracy_child_distance(&a, &b, 0.5);
    ck_assert_double_eq_tol(o.snr, 60, 1e-9);
    ck_assert_double_eq_tol(o.third, 20 * log10(2), 1e-9);
    ck_assert_double_eq_tol(o.level, -20 * log10(2), 1e-9);
    ck_assert_double_eq_tol(o.spectral, 20 * log10(2), 0.01);
    ck_assert_double_eq_tol(o.follows, 0.5, 1e-9);
    o = accuracy_child_distance(&a, &b, 0); /* nothing to compare pointwise */
    ck_assert_double_nan(o.snr);
}
END_TEST

/* For which presets choose. */
static struct scene scene_of(void)
{
    return rig_scene(rig_arena(),
                     "rasp: 1\nsurface: {roughness: {}}\nscraper: {mass: 1 g}\nmotion: {path: line, to: [1 "
                     "cm, 0], duration: 0.1 s}\noutput: {quantity: force}\n");
}

/* A sweep whose errors are made: oversampling's falls with the square of the steps, and the reference has what that
 * leaves, no more than its neighbour's difference. */
START_TEST(orders_and_own_error)
{
    struct args args = {0};
    struct cmd_call call = {.args = args, .arena = arena_open()};
    struct accuracy_sweep s = {
        .call = &call, .knobs = KNOB_BIT(oversampling), .until = INFINITY, .runs = 1, .single = true};
    struct accuracy_values own[KNOBS] = {{0}};
    struct err e = {0};
    double given[] = {2, 3};
    own[KNOB_oversampling] = (struct accuracy_values){given, 2};
    s.asked = s.scene = scene_of();
    ck_assert(accuracy_rows(&s, own, &e));
    double last = keys_knobs[KNOB_oversampling].preset[3], left = pow(last, -2);
    for (int i = 0; i < s.n_renders; i++) {
        double steps = accuracy_knob(&s.renders[i].set, KNOB_oversampling);
        s.renders[i].error.snr = -20 * log10(fabs(pow(steps, -2) - left));
        s.renders[i].runs = memcpy(ARENA_TAKE(call.arena, double, 1), &steps, sizeof steps);
        s.renders[i].n_runs = 1;
    }
    accuracy_judge(&s);
    int knobs = 0;
    for (int i = 0; i < s.n_rows; i++) {
        const struct accuracy_row *r = &s.rows[i];
        if (r->knob < 0) continue;
        knobs++;
        double steps = accuracy_knob(&s.renders[r->total].set, KNOB_oversampling);
        ck_assert_msg(s.renders[r->total].front, "each costs more and is better");
        if (steps == last || s.rows[i - 1].knob < 0) {
            ck_assert_double_nan(r->order);
            continue;
        }
        double before = accuracy_knob(&s.renders[s.rows[i - 1].total].set, KNOB_oversampling);
        ck_assert_double_lt(before, steps); /* coarse to fine */
        ck_assert_double_eq_tol(r->order,
                                log2((pow(before, -2) - left) / (pow(steps, -2) - left)) / log2(steps / before), 1e-9);
    }
    ck_assert_int_ge(knobs, 4);
    ck_assert_double_eq_tol(s.own_db, -20 * log10(pow(last / 2, -2) - left), 1e-9);
    ck_assert_double_lt(s.own_db, -20 * log10(left));
    for (int i = 0; i < s.n_renders;
         i++) /* no setting is rendered twice, the reference comes first, then its neighbour */
        for (int k = 0; k < i; k++)
            ck_assert_double_ne(accuracy_knob(&s.renders[i].set, KNOB_oversampling),
                                accuracy_knob(&s.renders[k].set, KNOB_oversampling));
    ck_assert_int_eq(s.reference, 0);
    ck_assert_double_eq(accuracy_knob(&s.renders[0].set, KNOB_oversampling), last);
    ck_assert_int_eq(s.near, 1);
    ck_assert_double_eq(accuracy_knob(&s.renders[1].set, KNOB_oversampling), last / 2);
    arena_close(call.arena);
}
END_TEST

/* An unknown knob's row in the table would be one line of accuracy.def: here each knob that turns the scene has its
 * rows, whichever it is. */
START_TEST(every_knob_has_its_rows)
{
    for (int k = 0; k < KNOBS; k++) {
        struct cmd_call call = {.arena = arena_open()};
        struct accuracy_sweep s = {.call = &call, .knobs = 1u << k, .until = INFINITY, .single = true};
        struct accuracy_values own[KNOBS] = {{0}};
        struct err e = {0};
        s.asked = s.scene = scene_of();
        ck_assert(accuracy_rows(&s, own, &e));
        int distinct = 0, rows = 0;
        bool near = false; /* is the reference's neighbour one of them? */
        const double *v = keys_knobs[k].preset;
        for (int i = 0; i < 4; i++) {
            bool met = false;
            for (int j = 0; j < i; j++)
                met |= v[j] == v[i];
            distinct += !met;
            near |= v[i] == accuracy_knob(&s.renders[s.near].set, (enum knob)k);
        }
        for (int i = 0; i < s.n_rows; i++) {
            ck_assert(s.rows[i].knob == -1 || s.rows[i].knob == k);
            rows += s.rows[i].knob == k;
        }
        ck_assert_int_eq(rows, distinct);
        /* Beside the presets', which may choose other values, the scene has its row: nothing was chosen for it here. */
        ck_assert_int_le(s.n_rows - rows, 5);
        ck_assert_int_ge(s.n_renders, distinct + !near);
        ck_assert_int_le(s.n_renders, distinct + !near + 4);
        arena_close(call.arena);
    }
}
END_TEST

UNIT("accuracy_compare", a_factor, a_divergence, orders_and_own_error, every_knob_has_its_rows)
