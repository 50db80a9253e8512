/* Eight discs at a time against one disc at a time: the same bits. */
#include "unit.h"

#include "surface/rolling_envelope.h"

static double draw(unsigned *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return (double)(*seed >> 8) / 0x1p23 - 1;
}

/* Pieces from all but flat to too hollow for the disc, centres from end to end and beyond; the eight of a group as
 * unlike as can be, so that they are found in unlike numbers of passes. */
START_TEST(the_same_bits)
{
    enum { GROUPS = 20000 };
    unsigned seed = 1;
    int ends = 0, middles = 0;
    for (int g = 0; g < GROUPS; g++) {
        struct disc d = rolling_envelope_disc(1e-3 * (1.1 + draw(&seed)), 5e-5);
        struct rest_lanes at;
        double terms[LANES][ENVELOPE_TERMS];
        for (int l = 0; l < LANES; l++) {
            double rough = pow(10, 1 + 3 * draw(&seed));
            struct height_jet a = {1e-6 * draw(&seed), 1e-4 * rough * draw(&seed), rough * draw(&seed)},
                              b = {1e-6 * draw(&seed), 1e-4 * rough * draw(&seed), rough * draw(&seed)};
            rolling_envelope_terms(&d, &a, &b, terms[l]);
            at.y[l] = draw(&seed) * (g % 4 ? d.half : d.radius + d.half);
            for (int k = 0; k < ENVELOPE_TERMS; k++)
                at.terms[k][l] = terms[l][k];
        }
        rolling_envelope_rest_lanes(&d, &at);
        for (int l = 0; l < LANES; l++) {
            struct height_jet j = rolling_envelope_rest(&d, terms[l], at.y[l]);
            ck_assert(!memcmp(&j.z, &at.z[l], sizeof j.z) && !memcmp(&j.slope, &at.slope[l], sizeof j.slope) &&
                      !memcmp(&j.bend, &at.bend[l], sizeof j.bend));
            ends += j.bend == -1 / d.radius || j.bend < -1e-9 / d.radius;
            middles += j.bend > 0;
        }
    }
    ck_assert(ends > GROUPS && middles > GROUPS / 2);
}
END_TEST

UNIT("rolling_envelope_lanes", the_same_bits)
