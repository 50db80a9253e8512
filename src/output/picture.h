/* Small spectrograms on axes that many sounds share: levels as bytes, and PNGs of 8-bit palettes made of them by
   libpng. Time goes right, frequency goes up in its logarithm. */
#ifndef OUTPUT_PICTURE_H
#define OUTPUT_PICTURE_H
#include <stddef.h>

#include "base/err.h"

/* A byte is a level in steps of PICTURE_STEP dB above PICTURE_LOWEST dB re a full-scale sine; PICTURE_LINE is a line
   between two pictures. */
enum { PICTURE_STEP = 2, PICTURE_LOWEST = -400, PICTURE_RANGE = 80, PICTURE_LINE = 255 };

/* The palette from the weakest to the strongest, with equal steps between, as 0xRRGGBB. */
enum { PICTURE_ANCHORS = 8 };
extern const unsigned picture_palette[PICTURE_ANCHORS];

struct picture_axes {
    double low, high; /* Hz, of the lowest row's lower and the highest row's upper edge */
    int rows;
};

/* The axis for sounds of such rates: from 50 Hz to half the rate, at most 20 kHz. */
struct picture_axes picture_axes_make(double rate, int rows);

/* Levels of a whole sound, cells[rows][columns], the highest frequency first; frequencies that it has not are lowest.
 */
void picture_cells(const double *x, size_t frames, double rate, const struct picture_axes *axes, int columns,
                   unsigned char *cells);

/* The greatest level among n cells. */
int picture_top(const unsigned char *cells, size_t n);

/* Writes cells as colours: `top` and above have the brightest, PICTURE_RANGE dB below it and less the darkest. The
   target bears rasp's mark. ERR_CREATE, ERR_IO */
bool picture_write(const char *target, const unsigned char *cells, int columns, int rows, int top, struct err *e);

#endif
