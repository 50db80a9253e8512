/* A design on its way from its text into struct design: what the parts of design_read share. Each part tells its errors
 * and goes on. */
#ifndef BATCH_DESIGN_READING_H
#define BATCH_DESIGN_READING_H
#include "batch/design.h"
#include "file/yaml.h"
#include "scene/scene_merge.h"

enum { DESIGN_READING_CELLS = 1000000 /* stimuli at most */ };

struct design_change { /* what a level, or `set`, changes of the scene       */
    struct scene_layer_key *keys;
    int n;
    const struct yaml_node *base; /* the scene's file name; NULL: not changed           */
};

struct design_made {         /* a factor whose levels are made from the values of a key: design_made.c      */
    struct yaml_node **path; /* of the key; NULL: they are written out                                      */
    struct diag_place at;    /* of all of them; with lines, the table                                       */
    const int *lines;        /* [n_levels] of the table, where each stands first; NULL: in none             */
};

struct design_cell {
    int *level;                    /* [n_factors]                                        */
    int sample;                    /* from 1; 0: nothing is drawn                        */
    const struct yaml_node *entry; /* of `cells` or `recordings`; NULL: it was crossed   */
    const char *recording;         /* as seen from here                                  */
};

struct design_texts {             /* what design_scene and design_text need             */
    const struct yaml_node *base; /* NULL: there is none                                */
    struct design_change set;
    struct design_change **levels; /* [n_factors][n_levels]; NULL: they are made         */
    struct design_made *made;      /* [n_factors]                                        */
    const struct design_cell *cells;
    struct diag_place seed;          /* where the seed is said, or the design is named     */
    struct diag_place level, length; /* the same                                          */
};

struct design_reading {
    struct yaml *yaml;
    struct arena *arena;
    struct yaml_node *root;
    struct design *design;
    struct design_texts *texts;
    const struct yaml_node **factors; /* [n_factors], the value of each                   */
    const char **keys;                /* every path of scenes (keys_text_names)             */
    const int **drawn;                /* [n_factors][samples] the level of each sample; NULL: it is not drawn */
    struct csv *table;                /* cells: FILE.csv; NULL: there is none               */
    struct diag_source *table_source;
    const int **rows;          /* [columns of the table][its rows] levels; NULL: not known yet       */
    struct design_cell *cells; /* in the order of the design, recordings at the end  */
    long n_cells;
    const struct design_template *template; /* of names                                   */
};

/* A value of the top level; NULL: it is not given (or null). */
struct yaml_node *design_reading_value(const struct design_reading *r, const char *key);

/* Tells what the node must be, and what it is; false. */
bool design_reading_must(const struct design_reading *r, const struct yaml_node *node, const char *label,
                         const char *be, const char *cure);

/* Keys of a map that are none of these (NULL-terminated) are reported; `in` follows: "unknown key 'x' in cells". */
void design_reading_known(const struct design_reading *r, const struct yaml_node *map, const char *const *names,
                          const char *in);

/* "a, b, c" */
const char *design_reading_joined(const struct design_reading *r, const char *const *names);

/* The factor of that name, of its key; -1: there is none, which has been reported. */
int design_reading_factor(const struct design_reading *r, const struct yaml_node *key);
/* The factor's level of that label, or with that text; -1: there is none, which has been reported. */
int design_reading_level(const struct design_reading *r, int factor, const struct yaml_node *label, bool recording);

/* What a level was read from: its entry in the list; of levels that are made the factor's value. */
const struct yaml_node *design_reading_item(const struct design_reading *r, int factor, int level);

/* "wood, 2 Hz" */
const char *design_reading_labels(const struct design *d, const int *level, struct arena *a);

struct design_match {      /* an entry of a list that picks stimuli by their levels, as exclude does           */
    unsigned char **named; /* [n_factors][n_levels], is the level named? NULL: every level is meant            */
    const struct yaml_node *entry;
    bool matched; /* something */
};

/* Of design_rows.c: the list (NULL: none) that `label` calls so; is there an entry all of whose pairs the levels match?
 */
struct design_match *design_rows_matches(const struct design_reading *r, const struct yaml_node *list,
                                         const char *label, int *n);
bool design_rows_match(const struct design *d, const int *level, struct design_match *all, int n);

/* Of design_factors.c: can a scene's key be set here, and to this value? Else it is reported. */
bool design_factors_key(const struct design_reading *r, const struct yaml_node *key);
bool design_factors_value(const struct design_reading *r, const struct yaml_node *key, const struct yaml_node *value);

/* Of design_made.c: levels of a factor that is `cells`, or {uniform: [...]} and the like; of {choose: [...]} they are
   the list that is returned, and design_made_choose draws from them once they are read. */
const struct yaml_node *design_made_read(struct design_reading *r, int factor, const struct yaml_node *value);
void design_made_choose(struct design_reading *r, int factor);

/* The table that `cells` names, before the factors; the levels in a row of it, -1 where it has no such column. */
void design_made_table(struct design_reading *r);
void design_made_row(struct design_reading *r, size_t row, int *level);

/* What a level changes; of one that is made the keys lie in the arena. */
struct design_change design_made_change(const struct design *d, int factor, int level, struct arena *a);

/* Of design_factors.c: fills the design's base, set and factors, their texts, and columns, units and values for the
   manifest. The rules of level and length have been read: they decide what may be set. */
void design_factors_read(struct design_reading *r);

/* Of design_rows.c: the cells, once the factors have been read without error; stimuli but for their names; sha256, when
 * all else is there. */
void design_rows_cells(struct design_reading *r);
void design_rows_stimuli(struct design_reading *r);
void design_rows_hash(struct design_reading *r);

/* Of design_names.c: the template into r->template; the name of every stimulus. */
void design_names_template(struct design_reading *r);
void design_names_make(struct design_reading *r);

/* Of design_trials.c: what listeners do with the stimuli, into design->trials. */
void design_trials_read(struct design_reading *r);

#endif
