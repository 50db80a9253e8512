/* An impulse response as samples: read from a WAV, or sampled from modes. In both, h is ready for
   convolution/overlap_add.h: scaled by 1/rate, its first sample half of h(0+) (plus the direct term of an acceleration
   table), so that y = sum h[n - m] f[m] is in the response's quantity for f in newtons. See ir.c. */
#ifndef RESPONSE_IR_H
#define RESPONSE_IR_H
#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "base/err.h"
#include "base/file_cache.h"
#include "response/modes.h"
#include "response/places.h"

struct ir {
    size_t length;
    const double *h;  /* [length], quantity per newton and sample */
    const char *note; /* that it was resampled, for a warning; NULL: it was not */
};

/* Number of samples n with n/rate < t0 (t0 > 0, s), at least 1. */
size_t ir_length(double rate, double t0);

/* A mono WAV: sample value x[n] is the response at t = n/rate in its quantity per N s, as it stands (nothing is
   rescaled), the first one h(0+). At another rate than `rate` (Hz) it is resampled, see ir.c. Cut to t < t0 (s);
   NAN: whole. Errors: as wav_read; ERR_SCENE when it is not mono, or silent before t0. */
struct ir_ask {
    const char *path;              /* of a file, or of a folder (ir.h)                              */
    double rate, t0;               /* Hz, s                                                             */
    struct file_cache *file_cache; /* where others may have put it, and h may lie: not to be changed; NULL: none */
};

bool ir_read(const struct ir_ask *ask, struct arena *a, struct ir *ir, struct err *e);

/* Samples modes into impulse responses at that rate (Hz): n components, each below rate/2 while its gain is not 0
 * (modes_drop_above, morph.c). */
struct ir_sampler;

struct ir_sampler *ir_sampler_make(struct arena *a, int n, double rate);

/* The response h[length] of a point with its poles, in that quantity (enum modes_quantity; of acceleration and pressure
   with the direct term). Poles that are those of the call before cost nothing. Absolute error <= 1e-12 sum |gain| /
   rate up to 1e5 samples. */
void ir_sample(struct ir_sampler *s, int quantity, const struct modes_point *p, double *h, size_t length);

/* A folder of impulse responses measured at places: WAVs and index.csv with the columns file_name,x_m,y_m and, if there
   are, z_m (must be 0), gain_db. */
struct ir_set {
    int n;
    struct ir *ir; /* [n], as ir_read gives them; at the rate asked for (resampled where it differs) */
    struct places *places;
    const char *note; /* what was resampled, for a warning; NULL: nothing */
};

/* Errors: ERR_INPUT, ERR_SCENE: no index.csv, unknown columns, a file twice, a place twice, not mono, names that leave
 * the folder. */
bool ir_set_read(const struct ir_ask *ask, struct arena *a, struct ir_set *s, struct err *e);

#endif
