#include "pipeline/render_parts.h"

#include <math.h>
#include <string.h>

#include "num/scaled.h"
#include "pipeline/outputs.h"
#include "pipeline/stages.h"
#include "response/listener.h"
#include "response/modes.h"
#include "scene/ball.h"
#include "scene/rules.h"
#include "trajectory/trajectory.h"

struct render_parts render_parts_make(const struct scene *s, const char *base, struct arena *a)
{
    struct render_parts p = {
        .scene = s, .base = base, .arena = a, .parts = ARENA_TAKE(a, struct render_part, s->n_contacts)};
    for (int i = 0; i < s->n_contacts; i++)
        p.parts[i].table.fd = p.parts[i].listing.fd = -1;
    return p;
}

/* ------------------------------------------------------------------ plans */

bool render_parts_plan(struct render_parts *p, struct err *e)
{
    for (int i = 0; i < p->scene->n_contacts; i++) {
        struct render_part *one = &p->parts[i];
        if (!plan_make(stages_table, &p->scene->contacts[i], p->scene, p->arena, &one->plan, e)) return false;
        one->start = rules_first_frame(&p->scene->contacts[i], p->scene->output.sample_rate);
        p->asked |= one->plan.targets;
    }
    return p->asked || err_about(e, p->scene->contacts[0].name, "gain") ||
           err_set(e, ERR_SCENE,
                   "the gain of every contact is 0: nothing is left to render; give one of them another gain");
}

/* ------------------------------------------------------------------ runs */

/* The first run whose sound says its quantity. */
static const struct run *stated(const struct render_parts *p)
{
    for (int i = 0; i < p->scene->n_contacts; i++)
        if (p->parts[i].open && p->parts[i].run.board.quantity >= 0) return &p->parts[i].run;
    return NULL;
}

int render_parts_quantity(const struct render_parts *p)
{
    const struct run *run = stated(p);
    return run ? run->board.quantity : -1;
}

/* What is summed is of one quantity; contacts that ring by WAVs, which do not say theirs, go with any. */
bool render_parts_agree(const struct render_parts *p, struct err *e)
{
    const struct run *first = stated(p);
    for (int i = 0; i < p->scene->n_contacts; i++) {
        const struct run *run = &p->parts[i].run;
        if (p->parts[i].open && run->board.quantity >= 0 && run->board.quantity != first->board.quantity)
            return err_about(e, run->plan.contact->name, "surface.response") ||
                   err_set(e, ERR_SCENE,
                           "contact '%s' gives %s, but contact '%s' %s: they cannot be summed; use mode tables of one "
                           "quantity, or choose one by "
                           "output.quantity",
                           run->plan.contact->name, modes_quantity_name(run->board.quantity), first->plan.contact->name,
                           modes_quantity_name(first->board.quantity));
    }
    if (!isnan(p->scene->output.level.dbfs_at_1_pa) && render_parts_quantity(p) != MODES_PRESSURE)
        return err_set(e, ERR_SCENE,
                       "output.level.dbfs_at_1_pa: the sound is not in pascals but %s: choose output.listen.radiator: "
                       "monopole or plate, or give "
                       "output.level.full_scale",
                       first ? modes_quantity_name(first->board.quantity)
                             : "in what its recorded responses are, which they do not say");
    return true;
}

static bool part_files(const struct render_parts *p, struct render_part *one, struct err *e)
{
    one->table_path = outputs_path(p->scene, p->base, OUTPUT_TABLE, one->plan.contact, p->arena);
    one->listing_path = outputs_path(p->scene, p->base, OUTPUT_LISTING, one->plan.contact, p->arena);
    if ((one->plan.targets & ITEM_BIT(ITEM_TABLE) && !outfile_open(&one->table, one->table_path, e)) ||
        (one->plan.targets & ITEM_BIT(ITEM_LISTING) && !outfile_open(&one->listing, one->listing_path, e)))
        return false;
    one->rows.stream = one->table.stream;
    one->impacts.stream = one->listing.stream;
    return true;
}

bool render_parts_open(struct render_parts *p, struct err *e)
{
    for (int i = 0; i < p->scene->n_contacts; i++) {
        struct render_part *one = &p->parts[i];
        if (!part_files(p, one, e)) return false;
        if (!one->plan.targets) continue;
        if (!run_open(&one->run, &one->plan, p->scene, &(struct run_sinks){&one->rows, &one->impacts}, e)) return false;
        one->open = true;
    }
    return render_parts_agree(p, e);
}

/* Frames of a contact's motion; of a muted one, which has no run, too. */
static bool part_frames(const struct render_parts *p, const struct render_part *one, long *frames, struct err *e)
{
    struct trajectory tr;
    *frames = one->open ? one->run.board.moving : 0;
    if (one->open) return true;
    if (!trajectory_make(&one->plan.contact->motion, trajectory_seed(p->scene, one->plan.contact), p->arena, &tr, e))
        return err_at(e, "contact '%s'", one->plan.contact->name);
    *frames = trajectory_frames(&tr, p->scene->output.sample_rate);
    return true;
}

bool render_parts_length(const struct render_parts *p, struct render_length *length, struct err *e)
{
    double tail = p->scene->output.tail, ring = 0, rate = p->scene->output.sample_rate;
    long end = 0, moving;
    for (int i = 0; i < p->scene->n_contacts; i++) {
        struct render_part *one = &p->parts[i];
        if (!part_frames(p, one, &moving, e)) return false;
        end = one->start + moving > end ? one->start + moving : end;
        if (one->open) ring = fmax(ring, one->run.board.ring);
    }
    length->motion = end;
    length->natural =
        end + (p->asked & ITEM_BIT(ITEM_SOUND) ? (long)ceil((isnan(tail) ? fmin(ring, 60) : tail) * rate) : 0);
    length->frames = !isnan(p->scene->output.duration) ? (long)rint(p->scene->output.duration * rate) : length->natural;
    return true;
}

bool render_parts_run(struct render_parts *p, long to, struct err *e)
{
    for (int i = 0; i < p->scene->n_contacts; i++) {
        struct render_part *one = &p->parts[i];
        if (one->open && to > one->start && !run_block(&one->run, to - one->start, e)) return false;
    }
    return true;
}

static void part_sum(const struct render_part *p, enum item item, const long range[2], double *sum)
{
    long begin = range[0] > p->start ? range[0] - p->start : 0, end = range[1] - p->start;
    bool body = item == ITEM_SURFACE_SOUND || item == ITEM_SCRAPER_SOUND;
    if (end <= begin || !p->open || !(p->plan.targets & ITEM_BIT(item))) return;
    const double *x = board_at(&p->run.board, item, begin);
    double gain = body ? p->plan.contact->gain : 1;
    int width = p->run.board.signals[item].per_frame;
    sum += (begin + p->start - range[0]) * width;
    scaled_add(sum, gain, x, (end - begin) * width);
}

void render_parts_sum(const struct render_parts *p, long from, long to, double *sum)
{
    memset(sum, 0, (size_t)((to - from) * listener_channels(&p->scene->output)) * sizeof *sum);
    for (int i = 0; i < p->scene->n_contacts; i++)
        part_sum(&p->parts[i], ITEM_SOUND, (const long[2]){from, to}, sum);
}

/* What touches the surface is of one stem or of the other. */
static bool part_of(const struct contact *c, enum stem stem)
{
    return (stem != STEM_BALL || ball_rolls(c)) && (stem != STEM_SCRAPER || !ball_rolls(c));
}

void render_parts_stem(const struct render_parts *p, enum stem stem, long from, long to, double *sum)
{
    static const enum item items[STEMS] = {ITEM_FORCE, ITEM_SURFACE_SOUND, ITEM_SCRAPER_SOUND, ITEM_SCRAPER_SOUND};
    memset(sum, 0, (size_t)((to - from) * stems_channels(&p->scene->output, stem)) * sizeof *sum);
    for (int i = 0; i < p->scene->n_contacts; i++)
        if (part_of(&p->scene->contacts[i], stem)) part_sum(&p->parts[i], items[stem], (const long[2]){from, to}, sum);
}

const struct run *const *render_parts_runs(const struct render_parts *p)
{
    const struct run **runs = ARENA_TAKE(p->arena, const struct run *, p->scene->n_contacts);
    for (int i = 0; i < p->scene->n_contacts; i++)
        runs[i] = p->parts[i].open ? &p->parts[i].run : NULL;
    return runs;
}

void render_parts_close(struct render_parts *p)
{
    for (int i = 0; i < p->scene->n_contacts; i++) {
        outfile_drop(&p->parts[i].table);
        outfile_drop(&p->parts[i].listing);
        if (p->parts[i].open) run_close(&p->parts[i].run);
    }
}
