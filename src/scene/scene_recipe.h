/* surface.recipe: a file of surface keys, such as

       title: sandpaper, grit 120
       source: where the figures come from
       grit: {density: 30 /mm^2, diameter: 125 um}
       roughness: {rms: 2 um}

   Title and source are for people. Paths in it are seen from its own folder. */
#ifndef SCENE_SCENE_RECIPE_H
#define SCENE_SCENE_RECIPE_H
#include "file/yaml.h"

/* Merges every contact's recipe under its map `surface`, whose own keys win (a null takes a recipe's key away). Errors
   are told with the recipe's file, line and column; keys that are none of a surface's are left for scene_keys_check to
   tell. False: one of them has no keys that could be read, so that nothing is known to be missing in the scene (for a
   file that is not there y->missing says so). */
bool scene_recipe_merge(struct yaml *y, struct yaml_node *root);

#endif
