/* One map of a scene on its way into a struct: the top level (into struct scene), or what describes a contact (into struct
   contact): the top level again, or an entry of contacts. */
#ifndef SCENE_SCENE_PART_H
#define SCENE_SCENE_PART_H
#include "file/yaml.h"
#include "scene/keys.h"

struct scene_part {
    struct yaml *yaml;
    struct yaml_node *map;
    const char *prefix;  /* of key names in messages: "", or "contacts.rod." */
    enum key_struct of;
    void *to;            /* struct scene or struct contact */
};

#endif
