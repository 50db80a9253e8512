/* Which keys a scene may have where: unknown ones are told with the nearest name, or the section they belong to. */
#ifndef SCENE_SCENE_KEYS_H
#define SCENE_SCENE_KEYS_H
#include "file/yaml.h"

enum scene_keys_where {
    SCENE_KEYS_SINGLE, /* the top level of a scene with one contact: keys of the scene and of the contact */
    SCENE_KEYS_TOP,    /* the top level beside a list of contacts: a contact's key there is an error      */
    SCENE_KEYS_ENTRY   /* an entry of contacts                                                            */
};

/* Tells every key of the map (and of the maps in it) that does not belong there, and sections that are not maps.
   `prefix` stands before key names in messages. */
void scene_keys_check(struct yaml *y, const struct yaml_node *map, enum scene_keys_where where, const char *prefix);

#endif
