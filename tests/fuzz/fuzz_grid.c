/* The reader of heights as a CSV grid of numbers. */
#include "file/heightfile_csv.h"
#include "heights.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    heights_fuzz(heightfile_csv_is, heightfile_csv_read, data, size);
    return 0;
}
