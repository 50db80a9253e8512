/* The reader of ISO 25178-71, text and binary. */
#include "file/heightfile_formats.h"
#include "heights.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    heights_fuzz(heightfile_sdf_is, heightfile_sdf_read, data, size);
    return 0;
}
