/* What the ends of a map are like, and whether a profile repeats itself: what is heard as clicks and as a buzz. */
#ifndef ANALYSIS_SURFACE_ENDS_H
#define ANALYSIS_SURFACE_ENDS_H
#include "file/heightfile.h"

struct surface_ends {
    double step;    /* m: rms difference of neighbouring heights                                               */
    double jump;    /* m: rms over the rows of first minus last height, which is met when the map is repeated  */
    double kink;    /* m/m: rms of twice the slope at the ends, which changes by as much when it is mirrored   */
    size_t fall[2]; /* samples at the start and at the end over which heights fall away: steps more than 1.5 times the
                       largest anywhere else in the map; 0: none */
    double drop[2]; /* m: by how much they do (rms over the rows)                                              */
};

/* Along the rows, or down the columns. Rows with a hole at an end do not count. */
void surface_ends(const struct heightfile *h, bool down, struct surface_ends *s);

/* The highest peak of a profile's autocorrelation at a lag of at least ten times its correlation length (at which it
   has fallen to a half) and at most half the profile. Rows of an image laid end to end show a peak at the length of a
   row. Over at most 4 million samples; all NAN or 0 for maps, with holes, and when nothing stands out. */
struct surface_ends_period {
    size_t lag, correlation; /* samples; correlation: the length                                 */
    double peak;             /* autocorrelation there                                            */
    double others;           /* rms of the autocorrelation in that range                         */
    bool stands_out; /* peak at least 0.2 and 5 times the others, and as narrow as the one at lag 0: half of it is lost
                        within three correlation lengths to both sides                           */
};
void surface_ends_period(const struct heightfile *h, struct surface_ends_period *p);

#endif
