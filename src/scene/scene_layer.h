/* Keys that another file than the scene says of it, such as a design of many scenes: laid over its tree as a file that
   includes it would. Errors in them are told where they stand in that file. */
#ifndef SCENE_SCENE_LAYER_H
#define SCENE_SCENE_LAYER_H
#include "file/yaml.h"

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
void scene_layer_put(struct yaml *y, struct yaml_node *root, const struct scene_layer *layer);

/* A dotted path into its parts, each with its place. NULL: one of them is empty, which has been told at the key. */
struct yaml_node **scene_layer_path(struct yaml *y, const struct yaml_node *key);

#endif
