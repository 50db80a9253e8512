/* Where in its files a scene's keys stand, for errors that are found only when what they name is opened. */
#ifndef SCENE_SCENE_PLACES_H
#define SCENE_SCENE_PLACES_H
#include "base/arena.h"
#include "base/err.h"
#include "scene/scene.h"
#include "scene/scene_part.h"

/* Adds to s->places all keys and sections of the part that are given; contact: its name, NULL for the scene's own keys.
 * The part's fields have been read. */
void scene_places_note(const struct scene_part *p, const char *contact, struct scene *s);

/* Adds a key of the scene that is in no table of keys. */
void scene_places_key(struct yaml *y, const char *key, const struct diag_place *at, struct scene *s);

/* What is laid over the scene stands there: the key, and all that is under it, are as messages call it by label. */
void scene_places_move(struct scene *s, const char *key, const char *label, const struct diag_place *at,
                       struct arena *a);

/* Adds a file that `inputs` names. */
void scene_places_input(struct yaml *y, const char *file, const struct diag_place *at, struct scene *s);

/* The place of a key that names a file; NULL: it is not given. */
const struct scene_place *scene_places_find(const struct scene *s, const char *contact, const char *key,
                                            const char *file);

/* "scene.yaml:12:14", of a key from another file "other.yaml:3:5", from the command line "scene.yaml: --set
 * surface.response"; NULL: "scene.yaml". */
const char *scene_places_text(const struct scene *s, const struct scene_place *p, struct arena *a);

/* Puts that before the text of an error that is set, with the key where the text does not name it, and behind it, of
   another file, where that is named; returns false. A key is written as in the scene: contacts.rod.surface.response in
   one with contacts. It is that of err_about, or that which names the file with which the text begins, or that with
   whose name it begins; of one that is not given the place is that of the section in which it would stand. */
bool scene_places_report(const struct scene *s, struct err *e);

#endif
