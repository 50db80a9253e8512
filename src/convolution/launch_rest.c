/* z <- p z, eight nodes at a time; sound: sum Im z. */
#include "convolution/launch_rest.h"

LANES_CLONES
static void ring(double *restrict zr, double *restrict zi, const double *restrict pr, const double *restrict pi, double (*restrict sums)[LANES],
                 int frames)
{
    for (int j = 0; j < frames; j++)
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            double re = pr[l] * zr[l] - pi[l] * zi[l];
            zi[l] = pr[l] * zi[l] + pi[l] * zr[l];
            zr[l] = re;
            sums[j][l] += zi[l];
        }
}

void launch_rest(struct launch_freed *freed, int count, double (*sums)[LANES], int frames)
{
    for (int at = 0; at < count; at += LANES) {
        _Alignas(64) double zr[LANES] = {0}, zi[LANES] = {0}, pr[LANES] = {0}, pi[LANES] = {0};
        int used = count - at < LANES ? count - at : LANES;
        for (int l = 0; l < used; l++) {
            zr[l] = freed[at + l].re, zi[l] = freed[at + l].im;
            pr[l] = freed[at + l].pole_re, pi[l] = freed[at + l].pole_im;
        }
        ring(zr, zi, pr, pi, sums, frames);
        for (int l = 0; l < used; l++)
            freed[at + l].re = zr[l], freed[at + l].im = zi[l];
    }
}
