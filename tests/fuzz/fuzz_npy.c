/* The reader of NumPy's arrays. */
#include "file/heightfile_formats.h"
#include "file/npy.h"
#include "heights.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    heights_fuzz(npy_is, heightfile_formats_npy_read, data, size);
    return 0;
}
