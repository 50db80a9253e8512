/* Scalar elementary functions that give the same bits on every x86-64 CPU and compiler: SLEEF's deterministic scalar
   versions (no fused multiply-add, no table chosen by CPU; at most 1.0 ulp). libm's last bits depend on FMA, so nothing
   that reaches a sample calls it (src/README.md, "same bytes"). Hot loops use num/vecmath.h. */
#ifndef NUM_REAL_H
#define NUM_REAL_H
#include <math.h>
#include <sleef.h>

static inline double real_exp(double x) { return Sleef_cinz_expd1_u10purec(x); }
static inline double real_exp10(double x) { return Sleef_cinz_exp10d1_u10purec(x); }
static inline double real_log(double x) { return Sleef_cinz_logd1_u10purec(x); }
static inline double real_log10(double x) { return Sleef_cinz_log10d1_u10purec(x); }
static inline double real_log1p(double x) { return Sleef_cinz_log1pd1_u10purec(x); }
static inline double real_pow(double x, double y) { return Sleef_cinz_powd1_u10purec(x, y); }
static inline double real_sin(double x) { return Sleef_cinz_sind1_u10purec(x); }
static inline double real_cos(double x) { return Sleef_cinz_cosd1_u10purec(x); }
static inline double real_tan(double x) { return Sleef_cinz_tand1_u10purec(x); }
static inline double real_tanh(double x) { return Sleef_cinz_tanhd1_u10purec(x); }
static inline double real_sinpi(double x) { return Sleef_cinz_sinpid1_u05purec(x); }
static inline double real_cospi(double x) { return Sleef_cinz_cospid1_u05purec(x); }
static inline double real_atan2(double y, double x) { return Sleef_cinz_atan2d1_u10purec(y, x); }

#define REAL_PI 3.14159265358979323846

#endif
