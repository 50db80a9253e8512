/* The reader of Gwyddion's own format. */
#include "file/heightfile_formats.h"
#include "heights.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    heights_fuzz(heightfile_gwy_is, heightfile_gwy_read, data, size);
    return 0;
}
