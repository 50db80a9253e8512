/* Writing a mode table: A = gain e^(j phase), see mode_table_write.h. Twelve digits of closed forms: what a reader
   needs (relative error 5e-13), and less than what the last bits of sums would show. */
#include "response/mode_table_write.h"

#include <math.h>

#include "num/real.h"

void mode_table_write_header(FILE *f) { fputs("place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad\n", f); }

static double unsigned_zero(double x) { return x == 0.0 ? 0.0 : x; }

void mode_table_write_place(FILE *f, const struct mode_table_place *place, int n, const int *order,
                            const struct modes_point *p, int quantity)
{
    for (int k = 0; k < n; k++) {
        int i = order[k];
        double along = quantity == MODES_VELOCITY ? p->im[i] : quantity == MODES_ACCELERATION ? -p->re[i] : p->re[i];
        double sign = along < 0.0 ? -1.0 : 1.0, gain = sign * sqrt(p->re[i] * p->re[i] + p->im[i] * p->im[i]);
        double phase = gain != 0.0 ? real_atan2(sign * p->im[i], sign * p->re[i]) : 0.0;
        int d = place->digits;
        fprintf(f, "%d,%.*g,%.*g,%d,%.*g,%.*g,%.*g,%.*g\n", place->id, d, unsigned_zero(place->x), d,
                unsigned_zero(place->y), k + 1, d, p->frequency[i], d, p->decay[i], d, unsigned_zero(gain), d,
                unsigned_zero(phase));
    }
}
