/* A scene's one tree from its file, the files it includes and the command line's --set. */
#ifndef SCENE_SCENE_MERGE_H
#define SCENE_SCENE_MERGE_H
#include "file/yaml.h"

/* The text's tree with its includes merged in (named relative to the source's folder): maps merge deeply, everything else is
   replaced, later includes win over earlier ones and the including file over all of them. NULL: errors. */
struct yaml_node *scene_merge_text(struct yaml *y, const struct diag_source *source);

/* Applies one --set "PATH=VALUE", as a file that includes this one would. */
void scene_merge_set(struct yaml *y, struct yaml_node *root, const char *assignment);

/* The same for --seed NUMBER. */
void scene_merge_seed(struct yaml *y, struct yaml_node *root, const char *number);

/* Merges `base` into a map as if the map's file included it: the map's own keys win. `base` is used up. */
void scene_merge_under(struct yaml *y, struct yaml_node *map, struct yaml_node *base);

/* Removes keys with the value null (or ~): they count as not given, whatever an included file says. */
void scene_merge_drop_nulls(struct yaml_node *node);

/* A file name as it is seen from the folder of the source it stands in; options are seen from the current folder. */
const char *scene_merge_path(struct yaml *y, const struct diag_source *source, const char *name);

#endif
