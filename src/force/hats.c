#include "force/hats.h"

#include "force/lift.h"

void hats_add(struct hats *h, struct board *b, long first, int n)
{
    double *force = way_values(b, ITEM_SUBFORCE, first);
    const double *load = lift_load(b, first);
    for (int i = 0; i < n; i++) {
        bool lifted = load && load[i] + load[i + 1] < 0;
        force[i] += h->carried + (lifted ? 0 : h->early[i]);
        h->carried = lifted ? 0 : h->late[i];
    }
}

void hats_lay(struct hats *h, struct board *b, long first, int n)
{
    double *force = way_values(b, ITEM_SUBFORCE, first);
    for (int i = 0; i < n; i++)
        force[i] = 0;
    hats_add(h, b, first, n);
    lift_count(b, first, n);
}
