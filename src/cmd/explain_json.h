/* Keys as JSON: part of `rasp explain --json`. */
#ifndef CMD_EXPLAIN_JSON_H
#define CMD_EXPLAIN_JSON_H
#include <jansson.h>

/* The keys and knobs at a path or in a map of that path, in the order of the tables; "": all. */
json_t *explain_json(const char *path);

#endif
