/* The bytes of a YAML text: read from a file, and checked to be one. */
#ifndef FILE_YAML_BYTES_H
#define FILE_YAML_BYTES_H
#include "file/yaml.h"

/* The file as a source; NULL: an error, told at the place that names the file (source NULL: none does); y->missing is then set. */
struct diag_source *yaml_bytes_read(struct yaml *y, const char *file, struct diag_place named);

/* UTF-8 without byte order mark, NUL or control characters, at most 4 MiB; else an error is told. */
bool yaml_bytes_good(struct yaml *y, const struct diag_source *source);

#endif
