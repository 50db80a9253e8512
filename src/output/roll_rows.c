/* Penetration, height and energies are those at the row's first frame; contact is the mean over its frames, lift-offs
 * their sum. */
#include "output/roll_rows.h"

#include <string.h>

#include "scene/ball.h"

static const struct {
    enum column column;
    enum roll_value value;
} sampled[] = {{PENETRATION, ROLL_PENETRATION},
               {HEIGHT, ROLL_HEIGHT},
               {ENERGY, ROLL_ENERGY},
               {SURFACE_WORK, ROLL_SURFACE_WORK},
               {CONTACT_LOSS, ROLL_CONTACT_LOSS},
               {MODE_LOSS, ROLL_MODE_LOSS},
               {RESIDUAL, ROLL_RESIDUAL}};
enum { SAMPLED = sizeof sampled / sizeof sampled[0] };

void roll_rows_make(struct roll_rows *r, const struct contact *c)
{
    *r = (struct roll_rows){0};
    if (ball_rolls(c)) r->spin = spin_make(c);
}

bool roll_rows_reads(const struct contact *c, enum column k)
{
    bool reads = k == CONTACT_SHARE || k == LIFT_OFFS;
    for (int i = 0; i < SAMPLED; i++)
        reads = reads || sampled[i].column == k;
    return reads && ball_rolls(c);
}

void roll_rows_frame(struct roll_rows *r, const double values[ROLL_VALUES], bool first)
{
    if (first) memcpy(r->first, values, sizeof r->first);
    r->contact += values[ROLL_CONTACT];
    r->lift_offs += values[ROLL_LIFT_OFFS];
}

void roll_rows_take(struct roll_rows *r, long frames, double *value)
{
    for (int i = 0; i < SAMPLED; i++)
        value[sampled[i].column] = r->first[sampled[i].value];
    value[CONTACT_SHARE] = frames > 0 ? r->contact / (double)frames : 0;
    value[LIFT_OFFS] = r->lift_offs;
    r->contact = r->lift_offs = 0;
}

double roll_rows_angle(const struct roll_rows *r, double u, double du)
{
    double theta;
    spin_at(&r->spin, 1, &u, &du, NULL, &(struct spin_out){.theta = &theta});
    return theta;
}
