/* sincos for the libraries: FFTW takes its twiddle factors from libm's sincos, whose last bits depend on whether the
   CPU has fused multiply-add, so that spectra would differ between CPUs even without SIMD. num/sincos.c defines a
   function of that name on num/real.h; a program's own definition comes before libm's when the dynamic linker binds
   FFTW (and GSL). */
#ifndef NUM_SINCOS_H
#define NUM_SINCOS_H

/* Does nothing: who calls it has num/sincos.c linked into the program. */
void sincos_link(void);

#endif
