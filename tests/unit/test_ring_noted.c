/* Choices that scenes share: of every shipped scene, the one that is found is the one that is made, though heights, load, mass, seed and level be others; whatever a choice
   depends on is in its key. */
#include "convolution/ring_noted.h"

#include <dirent.h>

#include "base/shelf.h"
#include "rig.h"

static struct scene scene_of(const char *name)
{
    struct scene s;
    struct err e = {0};
    const char *messages = "";
    if (!scene_read(arena_format(rig_arena(), "%s/scenes/%s", getenv("ROOT"), name), &(struct scene_overrides){0}, rig_arena(), &s, &messages, &e))
        ck_abort_msg("%s%s", messages, e.text);
    return s;
}

static const struct ring_choice *choice_of(const struct scene *s, int contact)
{
    const struct ring_choice *to;
    struct err e = {0};
    ck_assert_msg(ring_choice_make(&s->contacts[contact], s, RING_SURFACE, rig_arena(), &to, &e), "%s", e.text);
    return to;
}

static void check_equal(const struct ring_choice *x, const struct ring_choice *y)
{
    ck_assert_int_eq(x->engine, y->engine);
    ck_assert_int_eq(x->reading, y->reading);
    ck_assert_int_eq(x->moves, y->moves);
    ck_assert_int_eq(x->modes.n, y->modes.n);
    ck_assert_int_eq(x->high, y->high);
    ck_assert_int_eq(x->order, y->order);
    ck_assert_int_eq(x->hop, y->hop);
    ck_assert_int_eq(x->ramp, y->ramp);
    ck_assert_int_eq(x->nodes.n, y->nodes.n);
    ck_assert_uint_eq(x->knobs, y->knobs);
    ck_assert(!memcmp(&x->error, &y->error, sizeof x->error) && !memcmp(&x->work, &y->work, sizeof x->work) && x->seconds == y->seconds && x->forgotten == y->forgotten);
    ck_assert_int_eq(x->hops != NULL, y->hops != NULL);
    if (x->hops)
        ck_assert_int_eq(memcmp(x->hops, y->hops, (size_t)x->modes.n * sizeof *x->hops), 0);
    if (x->nodes.breaks) {
        ck_assert_int_eq(memcmp(x->nodes.breaks, y->nodes.breaks, ((size_t)x->nodes.pieces + 1) * sizeof *x->nodes.breaks), 0);
        ck_assert_int_eq(memcmp(x->nodes.count, y->nodes.count, (size_t)x->nodes.pieces * sizeof *x->nodes.count), 0);
    }
}

/* All that a choice does not depend on. */
static struct scene otherwise(const struct scene *s)
{
    struct scene o = *s;
    o.contacts = ARENA_TAKE(rig_arena(), struct contact, s->n_contacts);
    memcpy(o.contacts, s->contacts, (size_t)s->n_contacts * sizeof *o.contacts);
    for (int i = 0; i < s->n_contacts; i++) {
        struct contact *c = &o.contacts[i];
        if (c->motion.path != PATH_SCRIBBLE)
            o.seed = s->seed + 1;
        c->scraper.mass *= 2;
        c->load.constant = 3;
        if (c->surface.roughness.given)
            c->surface.roughness.rms *= 0.5;
    }
    for (int i = 0; i < s->n_contacts; i++)
        o.seed = s->contacts[i].motion.path == PATH_SCRIBBLE ? s->seed : o.seed;
    o.output.level.peak = -11;
    o.title = "other";
    return o;
}

START_TEST(what_is_found_is_what_is_made)
{
    DIR *folder = opendir(arena_format(rig_arena(), "%s/scenes", getenv("ROOT")));
    int along = 0;
    ck_assert_ptr_nonnull(folder);
    for (struct dirent *d; (d = readdir(folder));) {
        if (strlen(d->d_name) < 6 || strcmp(d->d_name + strlen(d->d_name) - 5, ".yaml"))
            continue;
        struct scene s = scene_of(d->d_name), o = otherwise(&s), shared = s;
        shared.shelf = o.shelf = shelf_open(1 << 20);
        for (int i = 0; i < s.n_contacts; i++) {
            const struct ring_choice *alone = choice_of(&s, i), *first = choice_of(&shared, i), *found = choice_of(&o, i);
            const char *key = ring_noted_key(&o, &o.contacts[i], rig_arena());
            if (!alone)
                continue;
            check_equal(alone, first);
            check_equal(alone, found);
            struct scene fresh = o;
            fresh.shelf = NULL;
            check_equal(choice_of(&fresh, i), found);
            along += shelf_noted(shared.shelf, key, rig_arena()) != NULL;
        }
        shelf_close(shared.shelf);
    }
    closedir(folder);
    ck_assert_int_ge(along, 5);
}
END_TEST

static bool same_key(const struct scene *s, const struct scene *o)
{
    return !strcmp(ring_noted_key(s, s->contacts, rig_arena()), ring_noted_key(o, o->contacts, rig_arena()));
}

START_TEST(what_a_choice_depends_on_is_in_its_key)
{
    struct scene s = scene_of("morphing.yaml");
    s.shelf = shelf_open(1 << 20);
    struct scene o = s;
    ck_assert(same_key(&s, &o));
    o.accuracy.morph_error -= 1;
    ck_assert(!same_key(&s, &o));
    o = s;
    o.output.duration = 9;
    ck_assert(!same_key(&s, &o));
    o = s;
    o.output.sample_rate = 32000;
    ck_assert(!same_key(&s, &o));
    o = s;
    struct contact c = s.contacts[0];
    o.contacts = &c;
    c.motion.to[0] += 0.01;
    ck_assert(!same_key(&s, &o));
    c = s.contacts[0];
    c.surface.response.modes = 7;
    ck_assert(!same_key(&s, &o));
    shelf_close(s.shelf);
    s = scene_of("scribble.yaml");
    s.shelf = shelf_open(1 << 20);
    o = s;
    o.seed++;
    ck_assert(!same_key(&s, &o));
    shelf_close(s.shelf);
    s.shelf = NULL;
    ck_assert_ptr_null(ring_noted_key(&s, s.contacts, rig_arena()));
}
END_TEST

UNIT("ring_noted", what_is_found_is_what_is_made, what_a_choice_depends_on_is_in_its_key)
