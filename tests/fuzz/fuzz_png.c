/* The reader of 16-bit grey PNG. Its chunks are given the checksums that they should have, else hardly any input would
 * come past libpng's first look. */
#include "file/heightfile_formats.h"
#include "heights.h"

static uint32_t checksum(const uint8_t *data, size_t n)
{
    uint32_t crc = 0xffffffff;
    for (size_t i = 0; i < n; i++) {
        crc ^= data[i];
        for (int k = 0; k < 8; k++)
            crc = crc & 1 ? 0xedb88320 ^ (crc >> 1) : crc >> 1;
    }
    return ~crc;
}

/* A chunk: 4 bytes of length, 4 of kind, the data, 4 of checksum; the highest byte first. */
static void mend(uint8_t *data, size_t size)
{
    for (size_t at = 8; at + 12 <= size;) {
        size_t n = (size_t)data[at] << 24 | (size_t)data[at + 1] << 16 | (size_t)data[at + 2] << 8 | data[at + 3];
        if (n > size - at - 12) return;
        uint32_t crc = checksum(data + at + 4, n + 4);
        for (int k = 0; k < 4; k++)
            data[at + 8 + n + (size_t)k] = (uint8_t)(crc >> (24 - 8 * k));
        at += n + 12;
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    uint8_t *mended = malloc(size + 1);
    if (!mended) abort();
    memcpy(mended, data, size);
    mend(mended, size);
    heights_fuzz(heightfile_formats_png_is, heightfile_formats_png_read, mended, size);
    free(mended);
    return 0;
}
