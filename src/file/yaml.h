/* YAML as a tree in which every node knows its place, read with libyaml (yaml_parse).

   Scalars stay texts: what `yes`, `010` or `1:30` mean is up to who reads them. */
#ifndef FILE_YAML_H
#define FILE_YAML_H
#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "base/diag.h"

enum yaml_kind { YAML_SCALAR, YAML_MAP, YAML_LIST };

struct yaml_node {
    enum yaml_kind kind;
    struct diag_place at;
    const char *text;        /* of a scalar, UTF-8 without NUL        */
    bool plain;              /* a scalar without quotes               */
    struct yaml_node *key;   /* the scalar that is its key in a map   */
    struct yaml_node *next;  /* in the same map or list               */
    struct yaml_node *first; /* of a map or list                      */
    struct yaml_node *last;
    int n; /* items of a map or list                */
};

struct yaml_file { /* a file that was read                        */
    const char *name;
    struct yaml_file *next;
};

struct yaml {
    struct arena *arena;
    struct diag *diag;
    int nodes;                           /* read so far                                     */
    int sources;                         /* made so far                                     */
    struct yaml_file *files, *last_file; /* in the order of reading   */
    bool missing;                        /* a file could not be read (ERR_INPUT)            */
};

struct yaml *yaml_open(struct arena *a);

/* A text in memory as a source; an option's text is shown without line numbers. The name and the text must outlive it.
 */
struct diag_source *yaml_source(struct yaml *y, const char *name, const char *text, size_t size);

/* `null` or `~`. */
bool yaml_null(const struct yaml_node *node);

/* Value of a key of a map; of a dotted path through maps. NULL: there is none (or something on the way is not a map).
 */
struct yaml_node *yaml_get(const struct yaml_node *map, const char *key);

struct yaml_node *yaml_find(struct yaml_node *map, const char *path);

/* A new scalar or an empty map or list. */
struct yaml_node *yaml_make(struct yaml *y, enum yaml_kind kind, struct diag_place at, const char *text);

/* Appends to a map (key is a scalar) or a list (key NULL). */
void yaml_append(struct yaml_node *parent, struct yaml_node *key, struct yaml_node *value);

/* The text of a file, or of a pipe (file/bytes.h), with a 0 behind it; of more than 4 MiB not all. NULL: errno */
const char *yaml_bytes_text(const char *file, struct arena *a, size_t *size);

/* The file as a source; NULL: an error, reported at the place that names the file (source NULL: none does); y->missing
   is then set. A pipe is read where the command line names it, not where a text does. */
struct diag_source *yaml_bytes_read(struct yaml *y, const char *file, struct diag_place named);

/* YAML texts into nodes.

   A strict part of YAML 1.1: one document, keys that are words and differ, no tags, no `<<`; anchors and aliases,
   expanded into copies. Limits: 4 MiB a file, 100000 nodes after expansion (over all files of one struct yaml), depth
   64, 1000 keys in a map, 1000 anchors. Every error goes to the diagnostics, with its place and a cure. */

/* The source's one document; NULL: an error. Errors that leave the rest readable (duplicate keys: the first counts) are
 * only reported. */
struct yaml_node *yaml_parse(struct yaml *y, const struct diag_source *source);

/* The value that starts at byte `from` of an option's text: a YAML flow value where it starts with [ { " or ', else the
   whole rest as a plain scalar. NULL: an error. */
struct yaml_node *yaml_parse_value(struct yaml *y, const struct diag_source *source, size_t from);

#endif
