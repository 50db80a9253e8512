/* libm's functions for the libraries: libsoxr designs its filters with exp, log, log10, pow, sin, cos and asin, whose
   last bits in glibc depend on whether the CPU has fused multiply-add. num/libm.c defines functions of these names on
   num/real.h; a program's own definitions come before libm's when the dynamic linker binds a shared library (GSL and
   libebur128 get them too). As num/sincos.h, which does it for FFTW. */
#ifndef NUM_LIBM_H
#define NUM_LIBM_H

/* Does nothing: who calls it has num/libm.c linked into the program. */
void libm_link(void);

#endif
