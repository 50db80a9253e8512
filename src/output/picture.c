/* See picture.h. A row takes the greatest level of the bins within its band, and what stands at its middle between two
   bins: no narrow line is lost where rows are wide, and none is missing where they are narrow. */
#include "output/picture.h"

#include <math.h>
#include <png.h>
#include <string.h>

#include "base/arena.h"
#include "base/outfile.h"
#include "num/real.h"
#include "output/mark.h"
#include "output/spectrogram.h"

enum { STEPS = PICTURE_RANGE / PICTURE_STEP }; /* the brightest colour's number; behind it stands that of lines */

const unsigned picture_palette[PICTURE_ANCHORS] = {0x000004, 0x280b54, 0x65156e, 0x9f2a63,
                                                   0xd44842, 0xf57d15, 0xfac127, 0xfcffa4};

struct picture_axes picture_axes_make(double rate, int rows)
{
    double high = fmin(rate / 2, 20000);
    return (struct picture_axes){fmin(50, high / 2), high, rows};
}

void picture_cells(const double *x, size_t frames, double rate, const struct picture_axes *axes, int columns,
                   unsigned char *cells)
{
    struct arena *a = arena_open();
    struct spectrogram g;
    spectrogram_make(&(struct spectrogram_of){x, frames, rate, 0, (double)frames / rate, columns}, a, &g);
    memset(cells, 0, (size_t)axes->rows * (size_t)columns);
    for (int row = 0; row < axes->rows; row++) {
        double edge[3]; /* lower edge, middle, upper edge, in bins */
        for (int k = 0; k < 3; k++)
            edge[k] =
                axes->low * real_pow(axes->high / axes->low, (axes->rows - row - 1 + 0.5 * k) / axes->rows) / g.bin_hz;
        int from = (int)ceil(edge[0]), to = (int)fmin(ceil(edge[2]), g.bins), at = (int)edge[1];
        if (at + 1 >= g.bins) continue; /* beyond half the sound's rate */
        for (int c = 0; c < columns; c++) {
            const double *db = g.db + c;
            double low = fmax(db[(size_t)at * (size_t)columns], PICTURE_LOWEST),
                   next = fmax(db[(size_t)(at + 1) * (size_t)columns], PICTURE_LOWEST),
                   level = low + (next - low) * (edge[1] - at);
            for (int k = from; k < to; k++)
                level = fmax(level, db[(size_t)k * (size_t)columns]);
            cells[(size_t)row * (size_t)columns + (size_t)c] =
                (unsigned char)fmin(rint((level - PICTURE_LOWEST) / PICTURE_STEP), PICTURE_LINE - 1);
        }
    }
    arena_close(a);
}

int picture_top(const unsigned char *cells, size_t n)
{
    int top = 0;
    for (size_t i = 0; i < n; i++)
        top = cells[i] > top && cells[i] != PICTURE_LINE ? cells[i] : top;
    return top;
}

bool picture_write(const char *target, const unsigned char *cells, int columns, int rows, int top, struct err *e)
{
    struct arena *a = arena_open();
    size_t n = (size_t)columns * (size_t)rows;
    png_byte *pixels = ARENA_TAKE(a, png_byte, n), colours[STEPS + 2][3];
    for (size_t i = 0; i < n; i++) {
        int step = cells[i] ? cells[i] - top + STEPS : 0; /* of silence nothing is bright */
        pixels[i] = (png_byte)(cells[i] == PICTURE_LINE ? STEPS + 1 : step < 0 ? 0 : step > STEPS ? STEPS : step);
    }
    for (int i = 0; i <= STEPS; i++) {
        double at = (double)i * (PICTURE_ANCHORS - 1) / STEPS;
        int k = (int)fmin(at, PICTURE_ANCHORS - 2);
        for (int c = 0; c < 3; c++) {
            int from = (int)(picture_palette[k] >> (16 - 8 * c) & 255),
                to = (int)(picture_palette[k + 1] >> (16 - 8 * c) & 255);
            colours[i][c] = (png_byte)rint(from + (to - from) * (at - k));
        }
    }
    memset(colours[STEPS + 1], 0xb0, 3);
    png_image image = {.version = PNG_IMAGE_VERSION,
                       .width = (png_uint_32)columns,
                       .height = (png_uint_32)rows,
                       .format = PNG_FORMAT_RGB_COLORMAP,
                       .colormap_entries = STEPS + 2};
    struct outfile o;
    bool ok = outfile_open(&o, target, e);
    if (ok && (!png_image_write_to_stdio(&image, o.stream, 0, pixels, columns, colours) || fflush(o.stream) != 0 ||
               !mark_picture(o.fd, false)))
        ok = err_set(e, ERR_IO, "%s: cannot be written%s%s", target, *image.message ? ": " : "", image.message);
    ok = ok && outfile_commit(&o, e);
    outfile_drop(&o);
    arena_close(a);
    return ok;
}
