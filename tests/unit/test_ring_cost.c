/* What engines are predicted to cost, by what must hold of it whatever its constants are; how long a contact is heard; and gains of any size beyond a
   motion's ends. */
#include "convolution/ring_cost.h"

#include "convolution/ring_along.h"
#include "num/real.h"
#include "unit.h"

static double separate_at(const struct modes *m, const struct modes_where *where, const struct modes_point *p)
{
    for (int i = 0; i < m->n; i++) {
        p->frequency[i] = 500 * (i + 1) * (1 + 0.1 * where->x);
        p->decay[i] = m->slowest[i];
        p->re[i] = 0;
        p->im[i] = 1;
    }
    return 0;
}

struct made {
    struct arena *arena;
    struct scene scene;
    struct contact contact;
    struct ring_choice to;
    struct ring_choosing c;
};

/* n modes of one decay along 10 cm in `force` seconds of a sound of `sound` seconds. */
static void make(struct made *d, int n, double decay, double force, double sound)
{
    struct err e = {0};
    d->arena = arena_open();
    d->scene = (struct scene){.output = {.sample_rate = 44100, .tail = sound - force, .duration = NAN}, .accuracy = {.overlap_order = 4, .overlap_hop = 0.01, .morph_error = -70, .gain_ramp = 64},
                              .contacts = &d->contact, .n_contacts = 1};
    d->contact = (struct contact){.name = "rod", .motion = {.path = PATH_LINE, .to = {0.1, 0}, .rate = NAN, .speed = NAN, .duration = force, .law = SPEED_MINIMUM_JERK}};
    d->contact.surface.response.length = NAN;
    d->to = (struct ring_choice){.reading = MOVING_LAUNCH, .moves = true, .forgotten = 90, .ramp = 16, .seconds = 1};
    d->to.modes = (struct modes){.n = n, .moves = true, .at = separate_at, .slowest = ARENA_TAKE(d->arena, double, n), .decay = ARENA_TAKE(d->arena, double, n),
                                 .frequency = ARENA_TAKE(d->arena, double, n), .name = "table"};
    for (int i = 0; i < n; i++)
        d->to.modes.slowest[i] = d->to.modes.decay[i] = decay;
    d->c = (struct ring_choosing){.contact = &d->contact, .scene = &d->scene, .given = &d->contact.surface.response, .key = "surface", .arena = d->arena, .to = &d->to,
                                  .work = d->arena};
    ck_assert_msg(trajectory_make(&d->contact.motion, 1, d->arena, &d->c.trajectory, &e), "%s", e.text);
    d->c.heard.force = force;
    ck_assert_msg(ring_heard(&d->scene, &d->contact, modes_ring_time(&d->to.modes, 80), &d->c.heard, &e), "%s", e.text);
    ring_survey(&(struct ring_survey_ask){&d->to.modes, &d->c.trajectory, false, false, false}, d->arena, &d->c.survey);
    ck_assert(ring_means_choose(&d->c, &e));
}

static double launch_work(int n, double decay, double force, double sound)
{
    struct made d;
    make(&d, n, decay, force, sound);
    ck_assert_int_eq(d.to.engine, RING_LAUNCH);
    arena_close(d.arena);
    return d.to.work;
}

/* What cannot be heard is not paid for: where nothing decays within the sound, it does not matter how slowly. */
START_TEST(long_ringing)
{
    double slow = launch_work(20, 0.2, 0.5, 0.5), slower = launch_work(20, 1e-3, 0.5, 0.5);
    ck_assert_msg(slower < 1.5 * slow && slow < 1.5 * slower, "%g %g", slow, slower);
}
END_TEST

/* The search for hops is made once: all of it, over the samples. Of a motion of 0.5 s and of the same followed by 4.5 s of nothing to do. */
START_TEST(opening)
{
    struct made d, t;
    make(&d, 20, 1000, 0.5, 0.5);
    make(&t, 20, 1000, 0.5, 5);
    double search = ring_cost_search(&d.c);
    ck_assert_msg(search > 100, "%g", search); /* 512 instants of 20 modes at several hops take more than 2 million cycles */
    ck_assert_double_ge(d.to.work, search);
    ck_assert_double_eq_tol(ring_cost_search(&t.c), search / 10, 0.01 * search);
    ck_assert_msg(t.to.work < d.to.work / 3, "%g %g", t.to.work, d.to.work);
    arena_close(d.arena);
    arena_close(t.arena);
}
END_TEST

/* A response that is computed ends with the sound. */
START_TEST(clipped)
{
    struct made d;
    struct err e = {0};
    make(&d, 3, 0.2, 0.5, 1);
    d.contact.surface.response.convolution = ENGINE_OVERLAP_ADD;
    ck_assert(ring_means_choose(&d.c, &e));
    ck_assert_int_eq(d.to.engine, RING_OVERLAP);
    ck_assert_double_ge(d.to.seconds, 1);
    ck_assert_double_le(d.to.seconds, 1.001);
    d.scene.output.tail = NAN; /* as long as it rings, at most 60 s */
    ck_assert(ring_heard(&d.scene, &d.contact, modes_ring_time(&d.to.modes, 80), &d.c.heard, &e));
    ck_assert(ring_means_choose(&d.c, &e));
    ck_assert_double_ge(d.to.seconds, 46);
    arena_close(d.arena);
}
END_TEST

/* However long that is. */
START_TEST(long_sound)
{
    struct made d;
    struct err e = {0};
    make(&d, 1, 0.01, 0.5, 80);
    d.contact.surface.response.convolution = ENGINE_OVERLAP_ADD;
    ck_assert(ring_means_choose(&d.c, &e));
    ck_assert_double_ge(d.to.seconds, 80);
    ck_assert_double_le(d.to.seconds, 80.001);
    arena_close(d.arena);
}
END_TEST

/* Nodes take 16 bytes a sample of each response, the longer the sound the more of both: what would be more than 2 GB is refused, and not chosen where the
   choice is open. */
START_TEST(memory)
{
    struct made d;
    struct err e = {0};
    make(&d, 1, 0.3, 0.5, 5);
    d.to.gamma = 1;
    d.contact.surface.response.convolution = ENGINE_NODES;
    ck_assert_msg(ring_means_choose(&d.c, &e), "%s", e.text);
    ck_assert_int_eq(d.to.engine, RING_PANNED);
    double law = d.to.nodes.n * d.to.seconds * 44100 * 16;
    ck_assert_msg(d.to.bytes > law && d.to.bytes < 1.1 * law && d.to.bytes < 2e9, "%d nodes of %g s: %g bytes", d.to.nodes.n, d.to.seconds, d.to.bytes);
    arena_close(d.arena);
    make(&d, 1, 0.3, 0.5, 120);
    d.to.gamma = 1;
    d.contact.surface.response.convolution = ENGINE_NODES;
    ck_assert(!ring_means_choose(&d.c, &e));
    ck_assert_msg(e.kind == ERR_SCENE && strstr(e.text, "GB of memory") && strstr(e.text, "output.tail"), "%s", e.text);
    d.contact.surface.response.convolution = ENGINE_AUTO;
    ck_assert(ring_means_choose(&d.c, &e));
    ck_assert_int_ne(d.to.engine, RING_PANNED);
    arena_close(d.arena);
}
END_TEST

START_TEST(heard)
{
    struct contact two[2] = {{.name = "a", .start = 1, .motion = {.duration = 2}},
                             {.name = "b", .start = 4, .motion = {.path = PATH_LINE, .to = {0.6, 0}, .rate = NAN, .speed = NAN, .duration = 3, .law = SPEED_CONSTANT}}};
    struct scene s = {.contacts = two, .n_contacts = 2, .output = {.tail = 0.5, .duration = NAN}};
    struct ring_heard h = {.force = 2};
    struct err e = {0};
    ck_assert(ring_heard(&s, &two[0], 10, &h, &e));
    ck_assert_double_eq(h.force, 2);
    ck_assert_double_eq(h.sound, 6.5); /* to 4 + 3 + 0.5 s, from 1 s on */
    ck_assert_double_eq(h.most, 6.5);
    two[1].motion.duration = NAN;
    two[1].motion.speed = 0.1; /* 6 s */
    ck_assert_msg(ring_heard(&s, &two[0], 10, &h, &e), "%s", e.text);
    ck_assert_double_eq_tol(h.sound, 9.5, 1e-12);
    ck_assert_double_eq_tol(h.most, 9.5, 1e-12);
    two[1].motion.path = PATH_RECORDED;
    two[1].motion.file = "none.csv";
    ck_assert(!ring_heard(&s, &two[0], 10, &h, &e));
    ck_assert_msg(strstr(e.text, "contact 'b'") && strstr(e.text, "none.csv"), "%s", e.text);
    s.n_contacts = 1;
    s.output.tail = NAN;
    ck_assert(ring_heard(&s, &two[0], 10, &h, &e));
    ck_assert_double_eq(h.sound, 12);
    ck_assert_double_eq(h.most, 62);
}
END_TEST

/* end^2/p, by complex division, for gains whose squares are no numbers. */
START_TEST(mirror)
{
    const double sizes[] = {1, 1e-150, 1e144, 1e200};
    for (int k = 0; k < 4; k++) {
        double er = 3 * sizes[k], ei = 4 * sizes[k], pr = 4 * sizes[k], pi = 3 * sizes[k];
        ring_along_mirror(1, &(struct modes_point){.re = &er, .im = &ei}, &(struct modes_point){.re = &pr, .im = &pi});
        /* (3 + 4j)^2 / (4 + 3j) = (-7 + 24j)(4 - 3j)/25 = (44 + 117j)/25 */
        ck_assert_double_eq_tol(pr / sizes[k], 44.0 / 25, 1e-14);
        ck_assert_double_eq_tol(pi / sizes[k], 117.0 / 25, 1e-14);
    }
}
END_TEST

UNIT("ring_cost", long_ringing, opening, clipped, long_sound, memory, heard, mirror)
