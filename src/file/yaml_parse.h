/* YAML texts into nodes.

   A strict part of YAML 1.1: one document, keys that are words and differ, no tags, no `<<`; anchors and aliases,
   expanded into copies. Limits: 4 MiB a file, 100000 nodes after expansion (over all files of one struct yaml), depth
   64, 1000 keys in a map, 1000 anchors. Every error goes to the diagnostics, with its place and a cure. */
#ifndef FILE_YAML_PARSE_H
#define FILE_YAML_PARSE_H
#include "file/yaml.h"

/* The source's one document; NULL: an error. Errors that leave the rest readable (duplicate keys: the first counts) are
 * only told. */
struct yaml_node *yaml_parse(struct yaml *y, const struct diag_source *source);

/* The value that starts at byte `from` of an option's text: a YAML flow value where it starts with [ { " or ', else the
   whole rest as a plain scalar. NULL: an error. */
struct yaml_node *yaml_parse_value(struct yaml *y, const struct diag_source *source, size_t from);

#endif
