/* What the key tables say, in words: for `rasp explain`, the reference scene and man rasp-scene(5). */
#ifndef SCENE_KEYS_TEXT_H
#define SCENE_KEYS_TEXT_H
#include <stdbool.h>
#include <stdio.h>

#include "base/arena.h"
#include "scene/keys.h"

/* Keys of a scene that are in no table: they give the others their place. Ends with path NULL. */
struct keys_text_frame {
    const char *path, *type, *meaning;
};
extern const struct keys_text_frame keys_text_frames[];

const char *keys_text_unit(enum key_dimension d);                    /* SI unit; "": none                        */
const char *keys_text_type(const struct key *k, struct arena *a);    /* "length (a bare number is in m)"          */
const char *keys_text_range(const struct key *k, struct arena *a);   /* "1 nm to 1 cm"; NULL: no range           */
const char *keys_text_applies(const struct key *k, struct arena *a); /* "where motion.path is line"; NULL: always */
const char *keys_text_words(const struct key *k, struct arena *a);   /* "circle or scribble"; only with keys_words() */
const char *keys_text_rivals(const struct key_alternative *t, struct arena *a); /* "exactly one of a, b"             */
const char *keys_text_rivals_apply(const struct key_alternative *t,
                                   struct arena *a); /* " where contact.model is scrape"; "": always */

/* Every path a scene may use: keys, sections and the maps between them, knobs, frames. NULL-terminated, each once. */
const char **keys_text_names(struct arena *a);
/* The row for a path as written in a scene or after --set: "contacts.rod.motion.rate" is "motion.rate". */
const char *keys_text_plain(const char *path);

void keys_text_print_key(FILE *f, const struct key *k, struct arena *a);
void keys_text_print_map(FILE *f, const char *path, struct arena *a); /* what a map holds: its keys, a line each   */
void keys_text_print_knob(FILE *f, const struct key_knob *k, struct arena *a);
void keys_text_print_accuracy(FILE *f, struct arena *a); /* the table of presets                      */

/* The keys, sections and accuracy knobs as mdoc(7), for man/rasp-scene.5. */
void keys_text_man(FILE *f, struct arena *a);

#endif
