/* Values that are each in range but make no sense together, as far as the scene's text alone shows it. */
#ifndef SCENE_SCENE_SENSE_H
#define SCENE_SCENE_SENSE_H
#include "scene/scene.h"
#include "scene/scene_part.h"

/* Of a filled contact. A value that could not be read is "not given" and takes part in no check. */
void scene_sense_contact(const struct scene_part *p);

/* A contact that neither rings nor has a table or a stem. To be asked of a contact without errors: a misspelt response
 * is told already. */
void scene_sense_asked(const struct scene_part *p, const struct scene *s);

/* What is to be heard and written: scene_sense_output.c. Of the scene's own keys, when they have been read; */
void scene_sense_output(const struct scene_part *top);
/* of each contact, against what the scene's tree (root) says; */
void scene_sense_output_audible(const struct scene_part *p, struct yaml_node *root, const struct scene *s);
/* of all contacts, when nothing else is wrong. */
void scene_sense_output_stems(const struct scene_part *top);
void scene_sense_output_impacts(const struct scene_part *top);

/* Columns of diagnostics that no contact has, and more rows than samples; columns that a filled contact does not have.
 */
void scene_sense_output_names(struct yaml *y, struct yaml_node *root);
void scene_sense_output_rate(const struct scene_part *top);
void scene_sense_output_columns(const struct scene_part *p, struct yaml_node *root, const struct scene *s);

#endif
