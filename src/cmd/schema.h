/* JSON Schemas (draft 2020-12) of scenes and designs, for editors, made from the tables of keys: parts of `rasp explain
   --schema`.

   They know each key, its type, units, words and, of bare numbers, its range. They do not know which keys go together:
   `rasp check` does. Every key may be null, which stands for "not given". */
#ifndef CMD_SCHEMA_H
#define CMD_SCHEMA_H
#include <jansson.h>

#include "base/arena.h"

json_t *schema_scene(struct arena *a);
json_t *schema_design(struct arena *a);

#endif
