/* Values that are each in range but make no sense together, as far as the scene's text alone shows it. */
#ifndef SCENE_SCENE_SENSE_H
#define SCENE_SCENE_SENSE_H
#include "scene/scene.h"
#include "scene/scene_part.h"

/* Of a filled contact. A value that could not be read is "not given" and takes part in no check. */
void scene_sense_contact(const struct scene_part *p);

/* A contact that neither rings nor has a table. To be asked of a contact without errors: a misspelt response is told already. */
void scene_sense_asked(const struct scene_part *p, const struct scene *s);

#endif
