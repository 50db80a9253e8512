/* The contacts of a render, each with its plan and its run. */
#ifndef PIPELINE_RENDER_PARTS_H
#define PIPELINE_RENDER_PARTS_H
#include "base/outfile.h"
#include "output/force_table.h"
#include "output/impact_rows.h"
#include "output/stems.h"
#include "pipeline/run.h"

struct render_part { /* one contact at work */
    struct plan plan;
    struct run run;
    long start; /* frame of the scene at which it begins */
    bool open;
    struct outfile table, listing;
    struct table_sink rows;
    struct impact_sink impacts;
    char *table_path, *listing_path;
};

struct render_parts {
    const struct scene *scene;
    const char *base;
    struct arena *arena;
    struct render_part *parts; /* [scene->n_contacts] */
    unsigned asked;            /* items that some contact is asked for */
};

/* Nothing open yet. */
struct render_parts render_parts_make(const struct scene *s, const char *base, struct arena *a);

/* Makes all plans. ERR_SCENE: of the plans; nothing is left to render. */
bool render_parts_plan(struct render_parts *p, struct err *e);

/* Opens the tables, so that the stages can write their headers, then the stages; all that is summed is of one quantity.
 */
bool render_parts_open(struct render_parts *p, struct err *e);

/* Once all are open (render_parts_open asks too): can the contacts' sounds be summed, and does the level fit what they
 * are? ERR_SCENE */
bool render_parts_agree(const struct render_parts *p, struct err *e);

/* Quantity of the sound (enum modes_quantity); -1: not stated. */
int render_parts_quantity(const struct render_parts *p);

struct render_length { /* frames of the whole                                            */
    long motion;       /* until the last motion's end, also of a muted contact             */
    long natural;      /* with the tail of what rings                                      */
    long frames;       /* as output.duration wants it; without it the natural length       */
};

/* Once all are open. ERR_SCENE and what making a motion gives. */
bool render_parts_length(const struct render_parts *p, struct render_length *length, struct err *e);

/* Runs every contact up to frame `to` of the scene. */
bool render_parts_run(struct render_parts *p, long to, struct err *e);

/* The contacts' sound for frames [from, to), just run, interleaved. */
void render_parts_sum(const struct render_parts *p, long from, long to, double *sum);

/* The contacts' sum of a stem likewise; a body's sound times the contact's gain, like the sound itself. */
void render_parts_stem(const struct render_parts *p, enum stem stem, long from, long to, double *sum);

/* The runs, [n_contacts]; NULL where nothing runs. */
const struct run *const *render_parts_runs(const struct render_parts *p);

void render_parts_close(struct render_parts *p);

#endif
