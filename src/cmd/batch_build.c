/* See batch_build.h. */
#include "cmd/batch_build.h"

#include <string.h>

#include "base/hash.h"
#include "cmd/version.h"

const char *batch_build(struct arena *a, struct err *e)
{
    char hex[HASH_TEXT];
    if (!strstr(version_revision, "dirty") && strcmp(version_revision, "unknown") != 0)
        return arena_format(a, "rasp %s %s", version_number, version_revision);
    if (!hash_file("/proc/self/exe", hex, e))
        return NULL;
    return arena_format(a, "rasp %s %s %.12s", version_number, version_revision, hex);
}
