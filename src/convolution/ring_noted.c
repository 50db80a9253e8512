/* See ring_noted.h. Noted are the numbers; the modes are read anew, from the shelf too, as a thousand cells' would not fit into memory. */
#include "convolution/ring_noted.h"

#include <math.h>
#include <string.h>

#include "base/hash.h"
#include "base/shelf.h"
#include "scene/scene_write.h"

/* What is left of a contact: of the surface its response; no load and no grip; a scraper of 1 kg. A ball stays whole: how it comes down an incline is its motion. */
static struct contact chosen_by(const struct contact *c)
{
    struct contact to = *c;
    to.gain = 1;
    to.whole = NULL;
    to.surface = (struct surface){.pitch = NAN, .height_scale = NAN, .height_range = NAN, .response = c->surface.response};
    to.grip = (struct grip){0};
    to.load = (struct load){.constant = NAN, .approach = NAN, .release = NAN};
    to.scraper.mass = 1;
    to.scraper.radius = to.scraper.patch = NAN;
    return to;
}

const char *ring_noted_key(const struct scene *s, const struct contact *c, struct arena *a)
{
    if (!s->shelf)
        return NULL;
    struct scene own = *s;
    bool drawn = false;
    for (int i = 0; i < s->n_contacts; i++)
        drawn = drawn || s->contacts[i].motion.path == PATH_SCRIBBLE;
    own.contacts = ARENA_TAKE(a, struct contact, s->n_contacts);
    for (int i = 0; i < s->n_contacts; i++)
        own.contacts[i] = chosen_by(&s->contacts[i]);
    own.title = NULL;
    own.seed = drawn ? s->seed : 0;
    own.output.level = (struct level){.full_scale = 1, .peak = NAN, .rms = NAN, .lufs = NAN, .dbfs_at_1_pa = NAN};
    const char *text = arena_format(a, "%s\n%s", c->name, scene_write(&own, ".", a));
    char *hex = arena_take(a, HASH_TEXT, 1);
    hash_bytes(text, strlen(text), hex);
    return hex;
}

/* The choice, then the arrays: hops [modes.n], breaks [pieces + 1], count [pieces]. */
static void *copied(struct arena *a, const char **from, size_t size)
{
    void *to = memcpy(arena_take(a, size, 1), *from, size);
    *from += size;
    return to;
}

bool ring_noted_find(struct shelf *s, const char *key, struct arena *a, struct ring_choice *to)
{
    const char *from = key ? shelf_noted(s, key, a) : NULL;
    struct ring_choice old = *to;
    if (!from)
        return false;
    memcpy(to, from, sizeof *to);
    from += sizeof *to;
    to->modes = old.modes;
    to->high = old.high;
    to->note = old.note;
    if (to->hops)
        to->hops = copied(a, &from, (size_t)to->modes.n * sizeof *to->hops);
    if (to->nodes.breaks) {
        to->nodes.breaks = copied(a, &from, ((size_t)to->nodes.pieces + 1) * sizeof *to->nodes.breaks);
        to->nodes.count = copied(a, &from, (size_t)to->nodes.pieces * sizeof *to->nodes.count);
    }
    return true;
}

static char *put(char *to, const void *from, size_t size)
{
    return size ? (char *)memcpy(to, from, size) + size : to;
}

void ring_noted_add(struct shelf *s, const char *key, const struct ring_choice *c)
{
    if (!key)
        return;
    size_t hops = c->hops ? (size_t)c->modes.n * sizeof *c->hops : 0, breaks = c->nodes.breaks ? ((size_t)c->nodes.pieces + 1) * sizeof *c->nodes.breaks : 0;
    size_t count = c->nodes.breaks ? (size_t)c->nodes.pieces * sizeof *c->nodes.count : 0;
    struct arena *work = arena_open();
    char *all = arena_take(work, sizeof *c + hops + breaks + count, 1), *end = put(all, c, sizeof *c);
    end = put(end, c->hops, hops);
    end = put(end, c->nodes.breaks, breaks);
    end = put(end, c->nodes.count, count);
    shelf_note(s, key, all, (size_t)(end - all));
    arena_close(work);
}
