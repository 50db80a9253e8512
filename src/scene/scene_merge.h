/* A scene's one tree from its file and the files it includes. */
#ifndef SCENE_SCENE_MERGE_H
#define SCENE_SCENE_MERGE_H
#include "file/yaml.h"

/* The text's tree with its includes merged in (named relative to the source's folder): maps merge deeply, everything
   else is replaced, later includes win over earlier ones and the including file over all of them. NULL: errors. */
struct yaml_node *scene_merge_text(struct yaml *y, const struct diag_source *source);

/* Merges `base` into a map as if the map's file included it: the map's own keys win. `base` is used up. */
void scene_merge_under(struct yaml *y, struct yaml_node *map, struct yaml_node *base);

/* Removes keys with the value null (or ~): they count as not given, whatever an included file says. */
void scene_merge_drop_nulls(struct yaml_node *node);

/* A file name as it is seen from the folder of the source it stands in; options are seen from the current folder. */
const char *scene_merge_path(struct yaml *y, const struct diag_source *source, const char *name);

/* Lays "motion.rate=3 Hz" of --set, or the number of --seed, over the tree; errors go to the diagnostics. */
void scene_merge_set(struct yaml *y, struct yaml_node *root, const char *text);
void scene_merge_seed(struct yaml *y, struct yaml_node *root, const char *number);

/* Keys that another file than the scene says of it, such as a design of many scenes: laid over its tree as a file that
   includes it would. Errors in them are reported where they stand in that file. */
struct scene_layer_key {
    struct yaml_node **path;       /* the parts of "motion.rate" as scalars; ends with NULL                         */
    const struct yaml_node *value; /* null takes the key away; file names are seen from the folder of its source    */
};

struct scene_layer {
    struct diag_place named; /* where the other file names the scene; its source is the first of all          */
    const struct scene_layer_key *keys; /* in order: a later one wins                                               */
    int n;
};

/* Lays them over the tree. The layer is only read: several threads may use one. */
void scene_merge_layer(struct yaml *y, struct yaml_node *root, const struct scene_layer *layer);

/* A dotted path into its parts, each with its place. NULL: one of them is empty, which has been reported at the key. */
struct yaml_node **scene_merge_layer_path(struct yaml *y, const struct yaml_node *key);

#endif
