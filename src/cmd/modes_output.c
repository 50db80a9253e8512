/* See modes_output.h. */
#include "cmd/modes_output.h"

#include <sys/stat.h>

#include "base/outfile.h"

bool modes_output_spares(const char *output, const char *input, struct err *e)
{
    struct stat o, i;
    if (!output || !input || stat(output, &o) != 0 || stat(input, &i) != 0 || o.st_dev != i.st_dev || o.st_ino != i.st_ino)
        return true;
    return err_set(e, ERR_CREATE, "%s: the table would overwrite the input %s; write elsewhere: -o OTHER.csv", output, input);
}

bool modes_output_possible(const char *output, struct err *e)
{
    struct outfile o;
    if (!outfile_open_fd(&o, output, e))
        return false;
    outfile_drop(&o);
    return true;
}
