/* The keys, sections and accuracy knobs as mdoc(7), for man/rasp-scene.5. */
#ifndef SCENE_KEYS_MAN_H
#define SCENE_KEYS_MAN_H
#include <stdio.h>

#include "base/arena.h"

void keys_man_print(FILE *f, struct arena *a);

#endif
