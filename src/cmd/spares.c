/* See spares.h. */
#include "cmd/spares.h"

#include <sys/stat.h>

bool spares(const char *output, const char *what, const char *input, const char *cure, struct err *e)
{
    struct stat o, i;
    if (!output || !input || stat(output, &o) != 0 || stat(input, &i) != 0 || o.st_dev != i.st_dev || o.st_ino != i.st_ino)
        return true;
    return err_set(e, ERR_CREATE, "%s: %s would overwrite the input %s; write elsewhere: %s", output, what, input, cure);
}
