/* What the tests of series of impacts share: contacts with the defaults of the keys, laws, files. */
#ifndef TESTS_UNIT_IMPACTS_H
#define TESTS_UNIT_IMPACTS_H
#include <unistd.h>

#include "force/impact_series.h"
#include "unit.h"

#define SAMPLE 22.6757e-6 /* s, at 44.1 kHz, as the keys' defaults have it */

/* Of a contact that is made by hand. */
static inline struct impacts *impacts_in(struct contact *c)
{
    static struct arena *a;
    if (!a) a = arena_open();
    return params_edit(c, &impact_law_params, a);
}

static inline struct contact impacts_contact(int prototype)
{
    const struct impact_draws draws = {.mean = NAN, .deviation = NAN, .a1 = NAN, .b1 = NAN};
    struct contact c = {.name = "ball", .gain = 1, .contact = {.model = CONTACT_IMPACTS}};
    *impacts_in(&c) = (struct impacts){.prototype = prototype,
                                       .size = 0.5,
                                       .velocity = 0.5,
                                       .roughness = 0.5,
                                       .unit_force = 1,
                                       .amplitude = draws,
                                       .interval = draws,
                                       .zeta = NAN,
                                       .theta = NAN,
                                       .depth = NAN,
                                       .rate = NAN,
                                       .least_amplitude = NAN,
                                       .least_interval = SAMPLE,
                                       .rub = {0.15, SAMPLE, SAMPLE},
                                       .scratch = {0.15, 0.01, SAMPLE},
                                       .radius = 1,
                                       .angle_to = NAN,
                                       .radius_to = NAN};
    return c;
}

/* A law of what a scene states itself: normal, without modulation. */
static inline struct contact impacts_custom(struct impact_draws amplitude, struct impact_draws interval)
{
    struct contact c = impacts_contact(PROTOTYPE_CUSTOM);
    impacts_in(&c)->amplitude = amplitude;
    impacts_in(&c)->interval = interval;
    impacts_in(&c)->zeta = 1e-5;
    return c;
}

static inline struct impact_law impacts_law(const struct contact *c, double duration, struct arena *a)
{
    struct impact_law l;
    struct err e = {0};
    ck_assert_msg(impact_law_make(c, duration, a, &l, &e), "%s", e.text);
    return l;
}

static inline struct impact_parameters impacts_at(const struct impact_law *l, double t)
{
    struct impact_parameters p;
    impact_law_at(l, t, &p);
    return p;
}

/* A file of that text, whose name is put into `path` (char [32]); the caller unlinks it. */
static inline void impacts_file(char *path, const char *text)
{
    strcpy(path, "impacts.XXXXXX");
    int fd = mkstemp(path);
    ck_assert_int_ge(fd, 0);
    ck_assert_int_eq(write(fd, text, strlen(text)), (int)strlen(text));
    close(fd);
}

#endif
