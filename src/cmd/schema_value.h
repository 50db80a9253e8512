/* Values and maps of values in a schema: parts of schema.h. */
#ifndef CMD_SCHEMA_VALUE_H
#define CMD_SCHEMA_VALUE_H
#include <jansson.h>
#include <stdbool.h>

#include "base/arena.h"
#include "scene/keys.h"

/* The value of one key, with what `rasp explain` says of it. */
json_t *schema_value_key(const struct key *k, struct arena *a);

/* A bare number or one with a unit; low = high: any. `word` may stand in its place; NULL: none. */
struct schema_value_quantity {
    enum key_dimension dimension;
    double low, high;
    bool whole;
    const char *word;
};
json_t *schema_value_quantity(const struct schema_value_quantity *q, struct arena *a);

/* {"type": [TYPE, "null"], "description": ...}; type "text": whatever is a text in YAML, be it a number. description may be NULL. */
json_t *schema_value_plain(const char *type, const char *description);
/* {"type": ["array", "null"], "items": items, "minItems": least, "maxItems": most}; takes items. */
json_t *schema_value_list(json_t *items, int least, int most, const char *description);
/* A map that has these keys only; takes properties. */
json_t *schema_value_map(json_t *properties, const char *description);

/* {"$ref": "#/$defs/NAME"} */
json_t *schema_value_ref(const char *name);

#endif
