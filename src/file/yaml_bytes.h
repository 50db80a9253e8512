/* The bytes of a YAML text: read from a file, and checked to be one. */
#ifndef FILE_YAML_BYTES_H
#define FILE_YAML_BYTES_H
#include "file/yaml.h"

/* The text of a file, or of a pipe (file/piped.h), with a 0 behind it; of more than 4 MiB not all. NULL: errno */
const char *yaml_bytes_text(const char *file, struct arena *a, size_t *size);

/* The file as a source; NULL: an error, told at the place that names the file (source NULL: none does); y->missing is
   then set. A pipe is read where the command line names it, not where a text does. */
struct diag_source *yaml_bytes_read(struct yaml *y, const char *file, struct diag_place named);

/* UTF-8 without byte order mark, NUL or control characters, at most 4 MiB; else an error is told. */
bool yaml_bytes_good(struct yaml *y, const struct diag_source *source);

#endif
