/* Where in its files a scene's keys stand, for errors that are found only when what they name is opened. */
#ifndef SCENE_SCENE_PLACES_H
#define SCENE_SCENE_PLACES_H
#include "base/arena.h"
#include "base/err.h"
#include "scene/scene.h"
#include "scene/scene_part.h"

/* Adds to s->places all keys and sections of the part that are given; contact: its name, NULL for the scene's own keys. The part's fields have been read. */
void scene_places_note(const struct scene_part *p, const char *contact, struct scene *s);

/* "scene.yaml:12:14", of a key from another file or the command line "scene.yaml: other.yaml:3:5", "scene.yaml: --set surface.response"; of one that is
   not given "scene.yaml". */
const char *scene_places_text(const struct scene *s, const char *contact, const char *key, struct arena *a);

/* Puts that before the text of an error that is set, and the key where the text does not name it; returns false. The key is that of err_about, or that
   which names the file with which the text begins; else it is "scene.yaml" alone. */
bool scene_places_tell(const struct scene *s, struct err *e);

#endif
