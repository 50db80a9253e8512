/* The rules of a contact's motion and surface, which scene_sense_contact asks for. */
#ifndef SCENE_SCENE_SENSE_PARTS_H
#define SCENE_SCENE_SENSE_PARTS_H
#include "scene/scene.h"
#include "scene/scene_part.h"

void scene_sense_motion(const struct scene_part *p, const struct motion *m);   /* scene_sense_motion.c  */
void scene_sense_surface(const struct scene_part *p, const struct surface *s); /* scene_sense_surface.c */

#endif
