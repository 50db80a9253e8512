/* The rules of a contact's parts, which scene_sense_contact asks for. */
#ifndef SCENE_SCENE_SENSE_PARTS_H
#define SCENE_SCENE_SENSE_PARTS_H
#include "scene/scene.h"
#include "scene/scene_part.h"

void scene_sense_motion(const struct scene_part *p, const struct motion *m);    /* scene_sense_motion.c  */
void scene_sense_model(const struct scene_part *p, const struct contact *c);    /* scene_sense_model.c   */
void scene_sense_ball(const struct scene_part *p, const struct contact *c);     /* scene_sense_ball.c    */
void scene_sense_response(const struct scene_part *p, const struct contact *c); /* scene_sense_response.c */
void scene_sense_ablation(const struct scene_part *p, const struct contact *c); /* scene_sense_ablation.c */
void scene_sense_object(const struct scene_part *p, const struct object_given *o,
                        const char *body); /* scene_sense_object.c */

/* Hertz's stiffness needs the moduli of the surface and of what touches it: tells what is missing, and BECAUSE. */
void scene_sense_model_moduli(const struct scene_part *p, const struct contact *c, const char *because);

/* Is a stiffness written with the unit of a linear spring (N/m), or, of a linear one, with that of Hertz's contact
 * (N/m^1.5)? */
bool scene_sense_model_unit(const struct yaml_node *node, bool linear);

/* Of a motion, in s, as far as the scene alone tells; NAN: a file or the length of a curve does. */
double scene_sense_lasts(const struct motion *m);

#endif
