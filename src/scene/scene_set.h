/* The command line's --set and --seed, laid over a scene's tree. */
#ifndef SCENE_SCENE_SET_H
#define SCENE_SCENE_SET_H
#include "file/yaml.h"

/* Applies one --set "PATH=VALUE", as a file that includes this one would. */
void scene_set(struct yaml *y, struct yaml_node *root, const char *assignment);

/* The same for --seed NUMBER. */
void scene_set_seed(struct yaml *y, struct yaml_node *root, const char *number);

/* Lays a value over the tree at the path, whose parts end with NULL; a part may be an entry of a list: its name or its
 * number from 0. */
void scene_set_put(struct yaml *y, struct yaml_node *root, struct yaml_node *const *path, struct yaml_node *value);

#endif
