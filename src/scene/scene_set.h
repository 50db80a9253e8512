/* The command line's --set and --seed, laid over a scene's tree. */
#ifndef SCENE_SCENE_SET_H
#define SCENE_SCENE_SET_H
#include "file/yaml.h"

/* Applies one --set "PATH=VALUE", as a file that includes this one would. */
void scene_set(struct yaml *y, struct yaml_node *root, const char *assignment);

/* The same for --seed NUMBER. */
void scene_set_seed(struct yaml *y, struct yaml_node *root, const char *number);

#endif
