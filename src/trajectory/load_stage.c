/* The stage that lays the normal force on the board: only a grip, a recording, or a ball that is heavier on one side or
 * not round makes it vary. */
#include "scene/rules.h"
#include "stage.h"
#include "trajectory/load.h"

enum { LOAD_CHUNK = 256 };

static bool stage_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return load_varies(c);
}

static unsigned stage_asks(const struct contact *c, const struct scene *s)
{
    (void)s;
    if (!c->grip.given && !c->load.recorded)
        return ITEM_BIT(ITEM_POSITION) | ITEM_BIT(ITEM_VELOCITY) | ITEM_BIT(ITEM_ACCELERATION);
    if (!c->grip.given) return ITEM_BIT(ITEM_MOTION); /* its duration */
    return rules_straight(&c->motion) ? ITEM_BIT(ITEM_ACCELERATION) : ITEM_BIT(ITEM_AX) | ITEM_BIT(ITEM_AY);
}

static double stage_work(const struct contact *c, const struct scene *s)
{
    return (c->grip.given ? 4 : c->load.recorded ? 12 : 180) * s->accuracy.oversampling;
}

static bool stage_open(struct stage_run *r, struct err *e)
{
    struct load_law *l = ARENA_TAKE(r->arena, struct load_law, 1);
    r->board->load = l;
    return load_make(r->contact, r->board->trajectory, r->arena, l, e);
}

/* Of a ball. A motion does not go on after its end, and the board's u and its derivatives stay at their last values: so
 * does the force. */
static void fill_turned(const struct board *b, long from, long to)
{
    load_turned(b->load, (size_t)((to - from) * b->over), board_at(b, ITEM_POSITION, from),
                board_at(b, ITEM_VELOCITY, from), board_at(b, ITEM_ACCELERATION, from), board_at(b, ITEM_LOAD, from));
}

static bool stage_fill(struct stage_run *r, long from, long to, struct err *e)
{
    const struct board *b = r->board;
    const struct trajectory *tr = b->trajectory;
    bool grip = r->contact->grip.given;
    const double *line = grip && tr->straight ? board_at(b, ITEM_ACCELERATION, from) : NULL;
    const double *x = grip && !tr->straight ? board_at(b, ITEM_AX, from) : NULL,
                 *y = x ? board_at(b, ITEM_AY, from) : NULL;
    double *force = board_at(b, ITEM_LOAD, from), t[LOAD_CHUNK], ax[LOAD_CHUNK], ay[LOAD_CHUNK];
    (void)e;
    if (b->load->turned > 0) {
        fill_turned(b, from, to);
        return true;
    }
    for (long i = 0, n = (to - from) * b->over; i < n; i += LOAD_CHUNK) {
        size_t some = (size_t)(n - i < LOAD_CHUNK ? n - i : LOAD_CHUNK);
        for (size_t j = 0; j < some; j++)
            t[j] = fmin((double)(from * b->over + i + (long)j) / (b->rate * b->over), tr->duration);
        for (size_t j = 0; line && j < some; j++) {
            ax[j] = tr->e[0] * line[i + (long)j];
            ay[j] = tr->e[1] * line[i + (long)j];
        }
        load_at(b->load, some, t, line ? ax : x ? x + i : NULL, line ? ay : y ? y + i : NULL, force + i);
    }
    return true;
}

const struct stage load_stage = {
    .name = "load",
    .does = "normal force on the scraper over time",
    .paper = "000 eq. 8, 9; sec. 4.1",
    .idle = "no grip, no load.recorded, no ball that is off its centre or has lobes: the load is constant",
    .gives = ITEM_BIT(ITEM_LOAD),
    .asks = stage_asks,
    .wanted = stage_wanted,
    .work = stage_work,
    .open = stage_open,
    .run = stage_fill,
};
