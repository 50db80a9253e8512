/* A scene into its files. */
#ifndef PIPELINE_RENDER_H
#define PIPELINE_RENDER_H
#include "base/arena.h"
#include "base/err.h"
#include "base/outfile.h"
#include "output/force_table.h"
#include "output/impact_rows.h"
#include "output/sound.h"
#include "output/stems.h"
#include "pipeline/error_budget.h"
#include "pipeline/run.h"

/* The contacts of a render, each with its plan and its run. */
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
    struct arena *arena;
    struct render_part *parts; /* [scene->n_contacts] */
    unsigned asked;            /* items that some contact is asked for */
};

/* Nothing open yet. */
struct render_parts render_parts_make(const struct scene *s, struct arena *a);

/* Makes all plans. ERR_SCENE: of the plans; nothing is left to render. */
bool render_parts_plan(struct render_parts *p, struct err *e);

/* Once all are open: can the contacts' sounds be summed, and does the level fit what they
 * are? ERR_SCENE */
bool render_parts_agree(const struct render_parts *p, struct err *e);

/* Quantity of the sound (enum modes_quantity); -1: not stated. */
int render_parts_quantity(const struct render_parts *p);

/* Once all are open. ERR_SCENE and what making a motion gives. */
bool render_parts_length(const struct render_parts *p, struct render_length *length, struct err *e);

void render_parts_close(struct render_parts *p);

/* ------------------------------------------------------------------ files */

struct render_file {
    const char *kind, *path;           /* "wav", "csv", "npy", "impacts", "scene", "summary", "stem" */
    const char *contact;               /* of a table or a series of impacts; NULL: of the whole */
    const char *stem;                  /* of a stem, which; else NULL      */
    const char *sha256;                /* NULL: not known                  */
    const struct wav_written *written; /* of a WAV; else NULL     */
    const char *temporary;             /* where it lies until it is committed */
    struct outfile *file;              /* on its way; NULL: a WAV          */
    struct track *track;               /* likewise; NULL: no WAV           */
};

struct render_time { /* CPU s of a stage */
    double opened, all;
};

struct render_report {
    long frames;
    double planned;            /* CPU s until the plans were made, once the knobs were chosen */
    struct render_time *times; /* of the stages that ran, contact by contact               */
    struct render_length length;
    double seconds, cpu; /* wall clock and CPU time of the whole render */
    struct sound_report sound;
    bool sounds;  /* there is a WAV */
    int quantity; /* enum modes_quantity of the sound; -1: not stated */
    struct render_file *files;
    int n_files;
    const char **older;               /* files of an earlier render that stay; ends with NULL */
    const char *summary;              /* the JSON text */
    struct error_budget error_budget; /* of the accuracy that was asked for */
    struct accuracy accuracy;         /* the knobs that it was rendered with */
    const char **warnings;
    int n_warnings;
    const char **notes; /* what contacts did, one line each */
    int n_notes;
};

/* Renders to BASE.wav (if anything sounds), BASE.force.wav and so on (stems), BASE.csv or BASE.CONTACT.csv
   (diagnostics; .npy), BASE.impacts.csv or BASE.CONTACT.impacts.csv (series of impacts), BASE.scene.yaml (the effective
   scene) and BASE.json (the summary). Nothing has a name before everything is complete. */
bool render_scene(const struct scene *s, const char *base, struct arena *a, struct render_report *report,
                  struct err *e);

/* The same in two steps, for a set (batch/stimulus.c), which writes its own record in place of the summary. */
struct render_names {
    const char *base;   /* of all files, but for                                                             */
    const char *sounds; /* the WAVs and stems; there is no effective scene then, for it tells the gain; NULL: none */
};

struct render;

/* Renders to files that are complete and have no name yet: report->files, of each where it lies. No summary is among
   them; report->summary tells no times, and nothing of files that an earlier render left. NULL: *e. */
struct render *render_make(const struct scene *s, const struct render_names *names, struct arena *a,
                           struct render_report *report, struct err *e);

/* Gives them their names, or leaves nothing. Either ends it. */
bool render_commit(struct render *r, struct err *e);
void render_drop(struct render *r);

#endif
