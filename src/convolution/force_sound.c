/* output.quantity: force. The contact force is played as it is, in newtons times the contact's gain, as papers/002
   section III-B ("raw forces") and 004 do: the part of a rolling sound that is due to the action alone. Nothing rings;
   what a body would do under the force is not computed. */
#include "response/modes.h"
#include "scene/rules.h"
#include "stage.h"

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

const struct stage force_sound_stage = {
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
