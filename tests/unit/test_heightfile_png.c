/* heightfile_png: PNG files put together by hand, with stored (uncompressed) deflate blocks, and their CRC and Adler
   sums made bit by bit from the definitions. */
#include "heights.h"

static void big(uint32_t v, int bytes)
{
    for (int i = bytes - 1; i >= 0; i--)
        put(&(unsigned char){(unsigned char)(v >> 8 * i)}, 1);
}

static uint32_t crc(const unsigned char *p, size_t n)
{
    uint32_t c = 0xffffffff;
    for (size_t i = 0; i < n; i++) {
        c ^= p[i];
        for (int k = 0; k < 8; k++)
            c = c & 1 ? 0xedb88320 ^ (c >> 1) : c >> 1;
    }
    return ~c;
}

static size_t chunk(const char *name)
{
    size_t at = size;
    big(0, 4);
    text(name);
    return at;
}

static void chunk_end(size_t at)
{
    size_t n = size - at - 8, end = size;
    size = at;
    big((uint32_t)n, 4);
    size = end;
    big(crc(file + at + 4, n + 4), 4);
}

static void data(const unsigned char *raw, size_t n)
{
    uint32_t a = 1, b = 0;
    size_t at = chunk("IDAT");
    put("\x78\x01\x01", 3);
    number(n, 2);
    number(~n, 2);
    put(raw, n);
    for (size_t i = 0; i < n; i++) {
        a = (a + raw[i]) % 65521;
        b = (b + a) % 65521;
    }
    big(b << 16 | a, 4);
    chunk_end(at);
}

/* A whole file; the rows begin with their filter type, 0. */
static void png(unsigned width, unsigned height, int bits, int colour, const unsigned char *raw, size_t n)
{
    size = 0;
    put("\x89PNG\r\n\x1a\n", 8);
    size_t at = chunk("IHDR");
    big(width, 4);
    big(height, 4);
    big((unsigned)bits, 1);
    big((unsigned)colour, 1);
    big(0, 3);
    chunk_end(at);
    data(raw, n);
    chunk_end(chunk("IEND"));
}

static const unsigned char grey[] = {0, 0x00, 0x00, 0x12, 0x34, 0xff, 0xff, 0, 0x00, 0x01, 0x01, 0x00, 0x80, 0x00};

START_TEST(grey16)
{
    static const double want[] = {0, 0x1234, 65535, 1, 256, 32768};
    png(3, 2, 16, 0, grey, sizeof grey);
    accepted();
    ck_assert(h.columns == 3 && h.rows == 2 && h.white == 65535 && h.step == 1 && h.bits == 16 && !h.metric &&
              !strcmp(h.format, "PNG"));
    ck_assert(isnan(h.pitch_x) && isnan(h.pitch_y));
    for (int i = 0; i < 6; i++)
        ck_assert_double_eq(h.z[i], want[i]);
}
END_TEST

/* A gamma chunk and one of 72 dpi change nothing. */
START_TEST(other_chunks)
{
    unsigned char whole[400];
    png(3, 2, 16, 0, grey, sizeof grey);
    size_t n = size - 33;
    memcpy(whole, file + 33, n);
    size = 33;
    size_t at = chunk("gAMA");
    big(45455, 4);
    chunk_end(at);
    at = chunk("pHYs");
    big(2835, 4);
    big(2835, 4);
    big(1, 1);
    chunk_end(at);
    put(whole, n);
    accepted();
    ck_assert(h.z[1] == 0x1234 && isnan(h.pitch_x));
}
END_TEST

START_TEST(other_kinds)
{
    png(6, 2, 8, 0, grey, sizeof grey);
    refused("8 bits, so 256 heights: too coarse");
    png(1, 2, 16, 2, grey, sizeof grey);
    refused("in colour");
    png(1, 1, 16, 4, grey, 5);
    refused("transparency");
    png(100000, 100000, 16, 0, grey, sizeof grey);
    refused("100000 x 100000 samples, and has");
}
END_TEST

START_TEST(damaged)
{
    png(3, 2, 16, 0, grey, sizeof grey - 1);
    refused("damaged PNG");
    png(3, 2, 16, 0, grey, sizeof grey);
    file[8 + 8 + 3] ^= 1; /* the width, not its check sum */
    refused("damaged PNG");
    png(3, 2, 16, 0, grey, sizeof grey);
    size_t whole = size;
    for (size = 8; size < whole - 12; size++)
        refused("damaged PNG at byte");
}
END_TEST

UNIT("heightfile_png", grey16, other_chunks, other_kinds, damaged)
