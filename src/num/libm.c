/* The elementary functions that libsoxr finds, see num/libm.h. SLEEF's deterministic ones: at most 1.0 ulp. rasp's own
   objects call none of them (tests/tidy/symbols.sh). */
#include "num/libm.h"

#include "num/real.h"

double exp(double x) { return real_exp(x); }
double log(double x) { return real_log(x); }
double log10(double x) { return real_log10(x); }
double pow(double x, double y) { return real_pow(x, y); }
double sin(double x) { return real_sin(x); }
double cos(double x) { return real_cos(x); }
double asin(double x) { return Sleef_cinz_asind1_u10purec(x); }

void libm_link(void) {}
