/* The reader of heights as a CSV grid of numbers. */
#include "file/heightfile_formats.h"
#include "heights.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    heights_fuzz(heightfile_formats_csv_is, heightfile_formats_csv_read, data, size);
    return 0;
}
