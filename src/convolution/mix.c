/* Total response: the surface's sound and the scraper's or ball's (papers/000 section 2.4), times the contact's gain,
 * at each listening place. */
#include <string.h>

#include "num/scaled.h"
#include "response/listener.h"
#include "response/modes.h"
#include "response/response.h"
#include "stage.h"

static bool mix_wanted(const struct contact *c, const struct scene *s)
{
    return response_rings(c) && s->output.quantity != QUANTITY_FORCE;
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

/* output.quantity: force. The contact force is played as it is, in newtons times the contact's gain, as papers/002
   section III-B ("raw forces") and 004 do: the part of a rolling sound that is due to the action alone. Nothing rings;
   what a body would do under the force is not computed. */

static bool force_sound_wanted(const struct contact *c, const struct scene *s)
{
    (void)c;
    return s->output.quantity == QUANTITY_FORCE;
}

static bool force_sound_open(struct stage_run *r, struct err *e)
{
    (void)e;
    r->board->quantity = MODES_FORCE;
    return true;
}

static bool force_sound_run(struct stage_run *r, long from, long to, struct err *e)
{
    const struct board *b = r->board;
    const double *x = board_at(b, ITEM_FORCE, from);
    double *y = board_at(b, ITEM_SOUND, from), gain = r->contact->gain;
    (void)e;
    for (long n = 0; n < (to - from) * b->channels; n++)
        y[n] = gain * x[n / b->channels];
    return true;
}

const struct stage mix_force_stage = {
    .name = "force_sound",
    .does = "the contact force itself as the sound",
    .paper = "002 III-B",
    .idle = "output.quantity is not force",
    .needs = ITEM_BIT(ITEM_FORCE),
    .gives = ITEM_BIT(ITEM_SOUND),
    .wanted = force_sound_wanted,
    .cycles = 1,
    .open = force_sound_open,
    .run = force_sound_run,
};
