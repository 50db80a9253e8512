/* Scalar elementary functions that give the same bits on every x86-64 CPU and compiler: SLEEF's deterministic scalar
   versions (no fused multiply-add, no table chosen by CPU; at most 1.0 ulp). libm's last bits depend on FMA, so nothing
   that reaches a sample calls it (src/README.md, "same bytes"). Hot loops use num/vecmath.h. Where SLEEF raises a
   floating-point exception on the way to a result that needs none, the result is given here, the same bits; sinpi and
   cospi of 2.5e8 half turns and more, of which SLEEF makes 0 and 1, are right. */
#ifndef NUM_REAL_H
#define NUM_REAL_H
#include <math.h>
#include <sleef.h>

#define REAL_PI 3.14159265358979323846

static inline double real_exp(double x) { return x < -1000.0 ? 0.0 : Sleef_cinz_expd1_u10purec(x); }
static inline double real_exp10(double x) { return x < -400.0 ? 0.0 : Sleef_cinz_exp10d1_u10purec(x); }
static inline double real_log(double x) { return Sleef_cinz_logd1_u10purec(x); }
static inline double real_log10(double x) { return Sleef_cinz_log10d1_u10purec(x); }
static inline double real_log1p(double x) { return Sleef_cinz_log1pd1_u10purec(x); }
static inline double real_pow(double x, double y)
{
    return x == 0.0 && y > 0.0 && !signbit(x) ? 0.0 : Sleef_cinz_powd1_u10purec(x, y);
}
static inline double real_sin(double x) { return Sleef_cinz_sind1_u10purec(x); }
static inline double real_cos(double x) { return Sleef_cinz_cosd1_u10purec(x); }
static inline double real_tan(double x) { return Sleef_cinz_tand1_u10purec(x); }
static inline double real_tanh(double x) { return fabs(x) > 100.0 ? copysign(1.0, x) : Sleef_cinz_tanhd1_u10purec(x); }
static inline double real_turns(double x) { return fabs(x) < 1e8 ? x : fmod(x, 2.0); } /* exact */
static inline double real_sinpi(double x) { return Sleef_cinz_sinpid1_u05purec(real_turns(x)); }
static inline double real_cospi(double x) { return Sleef_cinz_cospid1_u05purec(real_turns(x)); }
static inline double real_atan2(double y, double x)
{
    return x != 0.0 || y != 0.0 ? Sleef_cinz_atan2d1_u10purec(y, x) : copysign(signbit(x) ? REAL_PI : 0.0, y);
}

#endif
