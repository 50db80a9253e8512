/* See modes_output.h. */
#include "cmd/modes_output.h"

#include "base/outfile.h"
#include "cmd/spares.h"

bool modes_output_spares(const char *output, const char *input, struct err *e)
{
    return spares(output, "the table", input, "-o OTHER.csv", e);
}

bool modes_output_possible(const char *output, struct err *e)
{
    struct outfile o;
    if (!outfile_open_fd(&o, output, e))
        return false;
    outfile_drop(&o);
    return true;
}
