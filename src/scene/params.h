/* Parameters of an effect, or of a map: what its own file says of its section of the scene, so that nothing else has
   to name it.

   The file holds the struct, whose first member is `bool given`, rows of keys with offsets within it (scene/rows.h),
   rules between them, columns of diagnostics, and one `const struct params` that its stage points to, or that has a
   PARAMS line. In keys_table the maps stand in the order of keys.c, and within a map all that have a section in it in
   the order of pipeline/stages.def; a row that is a place (ROW_PLACE) draws a part of the map to where it stands. The
   structs of a contact lie in one block, contact->params; a contact that is copied shares it, and nobody writes into it
   but params_edit. What many files read (the motion, the response, the output) stands in struct contact or struct scene
   itself, and its params have size 0.

   Keys that no section holds alone have no such bool: those of a height map, of an impact. `given` says then whether
   they count (NULL: always), `section` is the path they have in common, and `meaning` is NULL. */
#ifndef SCENE_PARAMS_H
#define SCENE_PARAMS_H
#include "base/arena.h"
#include "scene/keys.h"
#include "scene/scene.h"

struct scene_part;
struct stage_run;
struct yaml_node;

/* The value of `path` is at most `factor` times that of `other`; both are numbers, NAN: it does not apply. All that is
 * no such multiple is said by `check`. */
struct params_rule {
    const char *path;
    double factor;
    const char *other, *cure;
};

struct params_column {
    const char *name, *meaning;
    /* Of the row that begins t s after the contact's start. The stage has run on past it, by what later stages read
       ahead: what it counts it keeps with its time. */
    double (*at)(const struct stage_run *, double t);
};

/* Of a part of the surface, as far as the scene alone tells. */
struct params_ground {
    bool kinked;                       /* may its heights have kinks or steps? */
    int (*directed)(const void *own);  /* are its heights different along x and y? -1: its file tells; NULL: no */
    double (*finest)(const void *own); /* m, see relief_part.finest */
    double (*span)(const void *own);   /* m between the greatest and least height; NULL: it refines others, and is no
                                          surface by itself */
};

struct params {
    const char *section, *meaning; /* "surface.ridges" */
    size_t size;                   /* of its struct; 0: the keys are fields of struct contact or scene */
    size_t flag;                   /* of a section of size 0: where its bool is, as its fields */
    const struct key *keys;        /* ends with path NULL; NULL: none */
    /* Of what several bodies have: paths and conditions that begin with a dot follow `body`, fields lie in a struct at
       `base` of struct contact, and what has no condition applies where `when` says. NULL: of one alone. */
    const char *body, *when;
    size_t base;
    struct key_alternative alternative;  /* of its keys; paths[0] NULL: none */
    const struct params_rule *rules;     /* ends with path NULL; NULL: none */
    const struct params_column *columns; /* of a contact that has the section; ends with name NULL; NULL: none */
    /* What a contact lacks for one of its columns, "": nothing; NULL: the section, unless it is given. */
    const char *(*lacks)(const struct contact *, const struct params_column *);
    void (*check)(const struct scene_part *, const struct contact *,
                  const void *own);              /* what no row says; may be NULL */
    void (*derive)(struct contact *, void *own); /* sets what follows from the values given, before any check; may be
                                                    NULL */
    /* Of the scene's own keys; contacts: all have been read, and nothing is wrong yet. May be NULL. */
    void (*check_scene)(const struct scene_part *top, bool contacts);
    /* Of each contact, what the scene asks of it; good: nothing is wrong with the contact itself. May be NULL. */
    void (*check_asked)(const struct scene_part *, struct yaml_node *root, const struct scene *, bool good);
    /* Of a key that is not given, nor any of its alternatives: what is done instead, for the effective scene. NAN:
       nothing; may be NULL. */
    double (*instead)(const struct key *, const void *owner);
    unsigned gives;                        /* items that the table asks for where one of its columns is written */
    const struct params_ground *ground;    /* NULL: it is no part of the surface */
    bool (*given)(const struct contact *); /* of keys that make no section of their own, meaning NULL: do they count?
                                              NULL: always */
    bool shown;                            /* on in the reference scene, where it is a section of its own */
};

/* The i-th of all, in the order of pipeline/stages.def; NULL: there are no more. Of pipeline/stages.c, since this layer
 * knows no stage. */
const struct params *stages_params(int i);

/* So many contacts, with all parameters not given: the only way to make one that a scene is read into. */
struct contact *params_contacts(struct arena *a, int n);

/* Where the struct begins in a contact's block; after all of them: the size of the block. */
size_t params_at(const struct params *p);

/* All of them; of a contact that was not read from a scene all zeros: nothing is given. */
const void *params_block(const struct contact *c);
const void *params_of(const struct contact *c, const struct params *p);
bool params_given(const struct contact *c, const struct params *p);

/* The struct, to be changed: the contact gets a block of its own. */
void *params_edit(struct contact *c, const struct params *p, struct arena *a);

/* Of all given parts of the surface: is one directed (-1: its file tells); their finest scale; their span; the span of
 * those with kinks; m. */
int params_directed(const struct contact *c);
double params_finest(const struct contact *c);
double params_span(const struct contact *c);
double params_kinked_span(const struct contact *c);

/* Its rules, and those of its function, of all that are given. */
void params_check(const struct scene_part *p, const struct contact *c);

/* The k-th of all columns there are, and (unless NULL) whose it is; NULL: there are no more. */
const struct params_column *params_column(int k, const struct params **whose);

/* The number of the one of that name; -1: there is none. */
int params_column_find(const char *name);

/* What a contact lacks for that column; "": it has it. */
const char *params_column_lacks(const struct contact *c, int k);

#endif
