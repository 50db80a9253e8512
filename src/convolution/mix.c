/* Total response: the surface's sound and the scraper's or ball's (papers/000 section 2.4), times the contact's gain,
 * at each listening place. */
#include <string.h>

#include "num/scaled.h"
#include "response/listener.h"
#include "scene/rules.h"
#include "stage.h"

static bool mix_wanted(const struct contact *c, const struct scene *s)
{
    return rules_rings(c) && s->output.quantity != QUANTITY_FORCE;
}

static double mix_work(const struct contact *c, const struct scene *s)
{
    (void)c;
    return 3 * listener_channels(&s->output);
}

static bool mix_open(struct stage_run *r, struct err *e)
{
    (void)r, (void)e;
    return true;
}

static bool mix_run(struct stage_run *r, long from, long to, struct err *e)
{
    struct board *b = r->board;
    double *y = board_at(b, ITEM_SOUND, from), gain = r->contact->gain;
    const enum item parts[] = {ITEM_SURFACE_SOUND, ITEM_SCRAPER_SOUND};
    bool both = board_has(b, parts[0]) && board_has(b, parts[1]);
    (void)e;
    long count = (to - from) * b->channels;
    memset(y, 0, (size_t)count * sizeof *y);
    for (int k = 0; k < 2; k++) {
        if (board_has(b, parts[k])) scaled_add(y, gain, board_at(b, parts[k], from), count);
        if (both) b->energy[k] += scaled_squares(board_at(b, parts[k], from), count);
    }
    return true;
}

const struct stage mix_stage = {
    .name = "mix",
    .does = "sum of the surface's and the scraper's or ball's sound",
    .paper = "000 eq. 11",
    .idle = "nothing rings, or the force is the sound",
    .takes = ITEM_BIT(ITEM_SURFACE_SOUND) | ITEM_BIT(ITEM_SCRAPER_SOUND),
    .gives = ITEM_BIT(ITEM_SOUND),
    .wanted = mix_wanted,
    .work = mix_work,
    .open = mix_open,
    .run = mix_run,
};
