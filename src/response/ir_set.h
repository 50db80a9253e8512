/* A folder of impulse responses measured at places: WAVs and index.csv with the columns file_name,x_m,y_m and, if there
   are, z_m (must be 0), gain_db. */
#ifndef RESPONSE_IR_SET_H
#define RESPONSE_IR_SET_H
#include <stdbool.h>

#include "base/arena.h"
#include "base/err.h"
#include "response/ir.h"
#include "response/places.h"

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
