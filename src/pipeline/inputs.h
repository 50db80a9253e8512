/* The files that a scene names, before anything is computed from them. */
#ifndef PIPELINE_INPUTS_H
#define PIPELINE_INPUTS_H
#include <stdbool.h>

#include "base/arena.h"
#include "base/err.h"
#include "base/file_cache.h"
#include "scene/scene.h"

/* Every file that a key names or `inputs` pins can be read (ERR_INPUT: names all that cannot), and what is pinned is as
   it was (ERR_SCENE). */
bool inputs_check(const struct scene *s, struct arena *a, struct err *e);

/* All files that the scene's samples depend on, watched from now on. */
struct watch inputs_watch(const struct scene *s, struct arena *a);

/* Is what was read of them since, by whomever, all of one state? ERR_INPUT */
bool inputs_still(const struct watch *w, struct err *e);

#endif
