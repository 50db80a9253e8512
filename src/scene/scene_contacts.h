/* The contacts of a scene's tree: its top level, or the list `contacts`. */
#ifndef SCENE_SCENE_CONTACTS_H
#define SCENE_SCENE_CONTACTS_H
#include "file/yaml.h"
#include "scene/scene.h"

/* Reads and checks them into s->contacts; errors go to the diagnostics. Unknown keys of the top level are told here
   too. What the scene says for all contacts (s->output) has been read. */
void scene_contacts_read(struct yaml *y, struct yaml_node *root, struct scene *s);

#endif
