/* See ablation.h. */
#include "scene/ablation.h"

#include <math.h>

#include "scene/keys.h"

void ablation_apply(struct contact *c)
{
    if (c->ablation.nonlinearity == ABLATED_NONLINEARITY_FULL) return;
    struct limiter *l = &c->contact.limiter; /* as of contact.limiter.curve: none, where its other keys do not apply */
    *l = (struct limiter){.curve = LIMITER_NONE,
                          .alpha = NAN,
                          .alpha_min = NAN,
                          .alpha_max = NAN,
                          .zeta = NAN,
                          .ratio_y = l->ratio_y,
                          .force_range = {NAN, NAN}};
    if (c->ablation.nonlinearity == ABLATED_NONLINEARITY_OMITTED) c->contact.smoothing = 0;
}

const char *ablation_text(const struct contact *c, struct arena *a)
{
    const struct ablation *b = &c->ablation;
    const struct {
        const char *key;
        int value;
    } all[] = {{"normal_force", b->normal_force},
               {"nonlinearity", b->nonlinearity},
               {"response", b->response},
               {"sound", b->sound}};
    const char *text = NULL;
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        const struct key *k = keys_find(arena_format(a, "ablation.%s", all[i].key));
        if (all[i].value != 0)
            text = arena_format(a, "%s%s%s: %s", text ? text : "", text ? ", " : "", all[i].key,
                                k->choices[all[i].value].word);
    }
    return text;
}
