#include "force/hats.h"

#include "force/lift.h"

void hats_add(struct hats *h, struct board *b, long first, int n)
{
    double *force = way_values(b, ITEM_SUBFORCE, first);
    const double *load = lift_load(b, first);
    if (!load && n > 0) {
        force[0] += h->carried + h->early[0];
        for (int i = 1; i < n; i++)
            force[i] += h->late[i - 1] + h->early[i];
        h->carried = h->late[n - 1];
        return;
    }
    for (int i = 0; i < n; i++) {
        double early = h->early[i], late = h->late[i];
        if (load) lift_cut(load[i], load[i + 1], &early, &late);
        force[i] += h->carried + early;
        h->carried = late;
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
