/* The reader of Gwyddion Simple Field. */
#include "file/heightfile_formats.h"
#include "heights.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    heights_fuzz(heightfile_formats_gsf_is, heightfile_formats_gsf_read, data, size);
    return 0;
}
