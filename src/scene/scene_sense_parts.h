/* The rules of a contact's parts, which scene_sense_contact asks for. */
#ifndef SCENE_SCENE_SENSE_PARTS_H
#define SCENE_SCENE_SENSE_PARTS_H
#include "scene/scene.h"
#include "scene/scene_part.h"

void scene_sense_motion(const struct scene_part *p, const struct motion *m);   /* scene_sense_motion.c  */
void scene_sense_surface(const struct scene_part *p, const struct surface *s); /* scene_sense_surface.c */
void scene_sense_model(const struct scene_part *p, const struct contact *c);   /* scene_sense_model.c   */
void scene_sense_response(const struct scene_part *p, const struct contact *c); /* scene_sense_response.c */
void scene_sense_object(const struct scene_part *p, const struct object_given *o, const char *body); /* scene_sense_object.c */

/* Of a motion, in s, as far as the scene alone tells; NAN: a file or the length of a curve does. */
double scene_sense_lasts(const struct motion *m);

#endif
