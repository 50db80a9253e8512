/* What is asked of the table of diagnostics, against what the scene has. */
#ifndef SCENE_SCENE_TABLE_H
#define SCENE_SCENE_TABLE_H
#include "scene/params.h"
#include "scene/scene.h"
#include "scene/scene_part.h"

/* The k-th of all columns there are, and whose it is: first those of columns.def, of nobody, then those of effects;
 * NULL: there are no more. */
const struct params_column *scene_table_column(int k, const struct params **whose);

/* Columns that a filled contact does not have: root is the scene's top level, from which s->output has been read. */
void scene_table_columns(const struct scene_part *p, struct yaml_node *root, const struct scene *s);

/* Names of columns that no contact has. */
void scene_table_names(struct yaml *y, struct yaml_node *root);

/* More rows than samples. Of the filled struct scene. */
void scene_table_rate(const struct scene_part *top);

#endif
