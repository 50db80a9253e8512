/* See lengths.h. */
#include "batch/lengths.h"

void lengths_add(struct lengths *l, int i, double seconds)
{
    if (!l->n || seconds < l->least) {
        l->least = seconds;
        l->shortest = i;
    }
    if (!l->n || seconds > l->most) {
        l->most = seconds;
        l->longest = i;
    }
    l->n++;
}

const char *lengths_told(const struct lengths *l, const struct design *d, struct arena *a)
{
    if (d->length_rule != DESIGN_LENGTH_LONGEST || !l->n || l->most - l->least < 0.01 * l->most) /* three digits tell them apart */
        return NULL;
    return arena_format(a, "each %.3g s, as long as the longest (%s; the shortest, %s, is %.3g s by itself); length: own, or a time, in the design", l->most, d->stimuli[l->longest].name,
                        d->stimuli[l->shortest].name, l->least);
}
