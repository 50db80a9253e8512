/* A scene's one tree from its file and the files it includes. */
#ifndef SCENE_SCENE_MERGE_H
#define SCENE_SCENE_MERGE_H
#include "file/yaml.h"

/* The text's tree with its includes merged in (named relative to the source's folder): maps merge deeply, everything
   else is replaced, later includes win over earlier ones and the including file over all of them. NULL: errors. */
struct yaml_node *scene_merge_text(struct yaml *y, const struct diag_source *source);

/* Merges `base` into a map as if the map's file included it: the map's own keys win. `base` is used up. */
void scene_merge_under(struct yaml *y, struct yaml_node *map, struct yaml_node *base);

/* Lays key: value over a map, as a file that includes the map's would. */
void scene_merge_put(struct yaml *y, struct yaml_node *map, struct yaml_node *key, struct yaml_node *value);

/* An entry of the map as a map, if it has such a form: `accuracy: high` becomes {preset: high}. */
struct yaml_node *scene_merge_opened(struct yaml *y, struct yaml_node *map, struct yaml_node *item);

/* Puts a value where an old one stands, in a map or a list. */
void scene_merge_replace(struct yaml_node *in, struct yaml_node *old, struct yaml_node *value);

/* Removes keys with the value null (or ~): they count as not given, whatever an included file says. */
void scene_merge_drop_nulls(struct yaml_node *node);

/* A file name as it is seen from the folder of the source it stands in; options are seen from the current folder. */
const char *scene_merge_path(struct yaml *y, const struct diag_source *source, const char *name);

#endif
