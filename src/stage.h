/* What a stage is, and the board that the stages of one contact share.

   A stage file holds its equations and ends in one `const struct stage foo_stage`; pipeline/stages.def lists them in
   the order in which sound is made. The planner (pipeline/plan.h) walks that list backwards from what the scene asks
   for and keeps a stage only if the scene wants it and something later needs what it gives. The runner (pipeline/run.h)
   opens what is kept, lays out the board, and runs blocks. What is not kept is neither opened nor run nor allocated.

   Items of the board are endless signals, of which a window is held: `per_frame` values for each audio sample (frame).
   Frames before 0 are zero. A stage says when it is opened how far around a frame it reads (back, ahead); the runner
   then lets everything before it run that much ahead in time, so that no stage delays or buffers for another. Values of
   sub-sampled items belong to the instant (frame + j / over) / rate, except ITEM_CURVATURE, ITEM_CURVATURE_Y and
   ITEM_SLOPE, which are means weighted by a linear B-spline about it (force/path_integral.h), and ITEM_SUBFORCE, which
   is such a mean where board->bspline says so, else the exact mean over the interval that starts there. Whoever adds
   to it gives the same kind: path_integral_add does. */
#ifndef STAGE_H
#define STAGE_H
#include <assert.h>
#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "base/err.h"
#include "num/filter.h"
#include "scene/scene.h"

enum item {
    ITEM_MOTION,       /* board->trajectory, read at any instant           no signal      */
    ITEM_POSITION,     /* m, signed distance u along the path          over per frame */
    ITEM_VELOCITY,     /* m/s, du/dt                                   over per frame */
    ITEM_ACCELERATION, /* m/s^2, d2u/dt2                               over per frame */
    ITEM_X,
    ITEM_Y, /* m, in the plane (of a motion that is not straight) over per frame */
    ITEM_VX,
    ITEM_VY, /* m/s                                          over per frame */
    ITEM_AX,
    ITEM_AY,            /* m/s^2                                        over per frame */
    ITEM_LOAD,          /* N, normal force; negative: lifted off        over per frame */
    ITEM_ALPHA,         /* m, limiter                                   over per frame */
    ITEM_SURFACE,       /* board->relief, read at any place             no signal      */
    ITEM_CURVATURE,     /* 1/m, limited curvature S_xx (paper force)    over per frame */
    ITEM_CURVATURE_Y,   /* 1/m, S_yy (paper force in the plane)         over per frame */
    ITEM_SLOPE,         /* mean |slope|^beta2 (paper force)             over per frame */
    ITEM_SUBFORCE,      /* N, contact force                             over per frame */
    ITEM_ROLL,          /* what a ball does: enum roll_value            ROLL_VALUES per frame */
    ITEM_FOLLOWED,      /* enum followed_value                          FOLLOWED_VALUES per frame */
    ITEM_FORCE,         /* N                                            1 per frame    */
    ITEM_SURFACE_SOUND, /* board->quantity                              channels per frame, interleaved */
    ITEM_SCRAPER_SOUND, /* board->quantity                              channels per frame */
    ITEM_SOUND,         /* board->quantity                              channels per frame */
    ITEM_TABLE,         /* diagnostics rows                             no signal      */
    ITEM_LISTING,       /* the series of impacts, written down          no signal      */
    ITEM_COUNT
};
#define ITEM_BIT(item) (1u << (item))

#define KNOB_BIT(name) (1u << KNOB_##name) /* a set of knobs of accuracy.def */
static_assert(KNOBS <= 32, "a set of knobs is an unsigned");

/* Of a ball, for each frame: over the frame's time (share, counts), or at its beginning. A kinematic model has the
 * first four. */
enum roll_value {
    ROLL_PENETRATION, /* m, rho or xi at the frame; below 0: clear of the surface            */
    ROLL_HEIGHT,      /* m, of the ball's centre of mass, over where it is at rest (roll_coupled); over where it lies at
                         rest, its centre of mass      lowest, on ground of height 0 (roll) */
    ROLL_CONTACT,     /* share of the frame's time in contact                                */
    ROLL_LIFT_OFFS,   /* how often it leaves the surface in the frame                        */
    ROLL_ENERGY,      /* J, of ball, contact and modes                                       */
    ROLL_SURFACE_WORK, /* J since the start: done by the surface's shape and the moving contact place */
    ROLL_CONTACT_LOSS, /* J since the start: lost in the contact                              */
    ROLL_MODE_LOSS,    /* J since the start: lost in the modes' damping                       */
    ROLL_RESIDUAL,     /* J: what the balance of these leaves over                            */
    ROLL_VALUES
};

/* m, at a frame's instant: heights of the ground that is followed, and of the trajectory */
enum followed_value { FOLLOWED_GROUND, FOLLOWED_TRAJECTORY, FOLLOWED_VALUES };

struct roll_report {           /* of a whole render; steps 0: no coupled model                        */
    double contact;            /* s in contact                                                        */
    double time;               /* s in all                                                            */
    long lift_offs;            /* times it left the surface                                           */
    long bounces;              /* times of those it stayed away for longer than a sample               */
    double stiffness;          /* N/m^1.5, k                                                          */
    double rest;               /* m, penetration at rest                                              */
    double resonance;          /* Hz, of the ball's mass on the contact; 0: none (roll)               */
    double roughness, hertz;   /* m, Rq and Hertz's part of the rest; NAN: the scene gives the rest (roll) */
    long steps;                /* of the coupled model                                                */
    double step;               /* s                                                                   */
    double contact_samples[2]; /* audio samples of a contact: mean, least                          */
    double fastest;            /* m/s, greatest speed of an impact                                    */
    double residual;           /* greatest |residual| over greatest energy                            */
    double iterations[2];      /* of a step in contact: mean, greatest                                */
};

struct params;
struct trajectory;
struct load_law;
struct limiter_law;
struct relief;
struct height_map;
struct table_sink;
struct impact_sink;
struct ring;

struct smoothing {          /* of ITEM_SUBFORCE */
    struct smooth *varying; /* of varying width (force/smooth.h); NULL: of constant width, by a kernel of sub-samples */
    struct filter kernel;
    bool taken; /* set by an opening stage that does it with its own kernel: ITEM_SUBFORCE is then as it was before */
};

struct signal {
    int per_frame;        /* 0: not a signal, or not in this plan */
    long first, capacity; /* frames held: [first, first + capacity) */
    long worked;          /* zeros from this frame on: nothing has been written there */
    double *x;
};

struct stage_run;

struct board {
    double rate;                 /* Hz, frames per second                       */
    int over;                    /* sub-intervals per frame                     */
    int channels;                /* listening places                            */
    struct smoothing *smoothing; /* last before the stages that follow; NULL: none */
    bool bspline;   /* ITEM_SUBFORCE: means weighted by linear B-splines; set by the opening stage that gives it */
    long moving;    /* frames that the motion touches              */
    unsigned alive; /* items that some stage of the plan reads     */
    struct signal signals[ITEM_COUNT];
    const struct trajectory *trajectory;
    const struct load_law *load;
    const struct limiter_law *limiter;
    struct relief *relief;
    const struct height_map *height_map; /* NULL: none */
    struct table_sink *table;
    struct impact_sink *listing;     /* where the series of impacts is written; NULL: it is not */
    const struct ring *surface_ring; /* of the stage that makes the surface ring; NULL: none */
    long fade[2];                    /* frames between which the force rises where a run begins (run_skip) */
    int quantity;                    /* enum modes_quantity of the sound; -1: not stated (recorded responses) */
    double ring;                     /* s, until the slowest response has decayed by 80 dB */
    double lifted;                   /* s during which the scraper was lifted off         */
    struct roll_report roll;
    bool rolls;       /* the report holds something                        */
    bool lingers;     /* there is force after the motion's end: contact.enhance */
    bool unstated;    /* a recorded response, whose quantity is not stated, rings */
    double energy[2]; /* quantity^2, summed over frames and channels: of the surface's sound and of the scraper's or
                         ball's, where both are heard */
    const char *warnings[16];
    int n_warnings;                 /* may exceed the room: what is beyond is counted only */
    const struct stage_run *stages; /* of the contact, in their order */
    int n_stages;
};

enum { STAGE_BLOCK = 1024 }; /* most frames of one call of run */

struct stage_run { /* one stage at work */
    const struct stage *stage;
    const struct scene *scene;
    const struct contact *contact;
    struct board *board;
    struct arena *arena;
    void *state;
    int back, ahead;   /* frames read around a frame; set by open     */
    long ends;         /* from this frame on it gives zeros only; LONG_MAX, unless open sets it. A stage that adds to
                          an item in place may set it with ahead 0 only                         */
    long offset, done; /* the runner's: lead, and frames done         */
    long limit;        /* the runner's: until when it works (run.c) */
    double seconds;    /* CPU time spent                              */
    double opened;     /* of it, on opening                           */
    double once;       /* predicted cycles of opening, and of whatever else is done once */
    double work;       /* predicted cycles per audio sample while it works; NAN until all are open: .work says */
    long works;        /* frames from the first for which it costs that, as predicted; LONG_MAX, unless open sets it */
    size_t bytes;      /* memory taken                                */
    long blocks;       /* calls of run                                */
};

enum { STAGE_WARNINGS = 4 };

/* What a stage says of a whole render, in the summary and on the terminal; key NULL: nothing. Of two reports with one
 * key the later counts. It is asked for several times: it changes nothing, and makes its value anew. */
struct stage_report {
    const char *key;
    struct json_t *value;                 /* under the key, of the contact; whoever asks drops it     */
    const char *note;                     /* "in contact 98 % of the time"; NULL: none                */
    const char *warnings[STAGE_WARNINGS]; /* without the contact's name; ends with NULL, unless it is full */
};

struct stage {
    const char *name, *does;
    const char *paper;           /* equations followed; "" if none                         */
    const char *idle;            /* why a scene may not want it, for `rasp plan`           */
    const struct params *params; /* keys, rules and columns of its own (scene/params.h); NULL: none */
    unsigned needs, takes,
        gives; /* sets of items; takes: read if something gives it; needs and gives: refined in place */
    unsigned (*asks)(const struct contact *, const struct scene *); /* further needs; may be NULL */
    bool spreads;   /* makes zeros of zeros: what it needs reaches no further than it reads */
    unsigned knobs; /* set of knobs (scene/accuracy.def) that what it gives depends on, be it by its own doing only:
                       those of what it reads are theirs */
    unsigned (*turns)(const struct contact *, const struct scene *); /* further knobs, of some scenes; may be NULL */
    bool (*wanted)(const struct contact *, const struct scene *);    /* NULL: where its params are given */
    double (*work)(const struct contact *,
                   const struct scene *); /* predicted cycles per audio sample; NULL: `cycles` */
    double cycles;
    bool (*open)(struct stage_run *, struct err *);
    bool (*run)(struct stage_run *, long from, long to, struct err *); /* frames [from, to); may be NULL */
    void (*skip)(struct stage_run *, long frame); /* to go on at that frame, from an empty board: of what knows which
                                                     frame came last (run_skip); may be NULL */
    struct stage_report (*report)(const struct stage_run *, struct arena *); /* when all has run; may be NULL */
    void (*close)(struct stage_run *);                                       /* may be NULL */
};

/* Values of an item from a frame on; at least up to the frames that the runner has promised. */
static inline double *board_at(const struct board *b, enum item item, long frame)
{
    const struct signal *s = &b->signals[item];
    assert(s->per_frame > 0 && frame >= s->first && frame <= s->first + s->capacity);
    return s->x + (frame - s->first) * s->per_frame;
}

static inline bool board_has(const struct board *b, enum item item) { return b->signals[item].per_frame > 0; }

/* A remark for the summary, printed once at the end; text must live as long as the arena. */
static inline void board_warn(struct board *b, const char *text)
{
    if (b->n_warnings < (int)(sizeof b->warnings / sizeof b->warnings[0])) b->warnings[b->n_warnings] = text;
    b->n_warnings++;
}

#endif
