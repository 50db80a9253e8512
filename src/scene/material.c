/* The table of materials (material.def) and the law of damping.

   A mode of mass m, stiffness k = m w^2 and damping constant c: m x'' + c x' + k x = 0 decays with c/(2 m). Rayleigh's
   C = alpha M + beta K gives c/m = alpha + beta w^2; a loss factor eta (energy lost per radian over energy held) gives
   c/m = eta w. All three add up:

     decay = (alpha + beta w^2 + loss w) / 2   in 1/s,   60 dB in 3 ln 10 / decay = 6.908 / decay seconds. */
#include "scene/material.h"

#include <stddef.h>

const struct material material_table[] = {
#define MATERIAL(...) {__VA_ARGS__},
#include "scene/material.def"
#undef MATERIAL
    {NULL, 0, 0, 0, 0, 0, 0, 0, 0, NULL, NULL, {0, 0, 0, 0, 0}},
};

const struct material *material_find(int name)
{
    return name > MATERIAL_CUSTOM && name <= MATERIAL_ALUMINIUM ? &material_table[name - MATERIAL_CUSTOM - 1] : NULL;
}

const struct material *material_given(const struct object_given *o)
{
    return o->own ? o->own : material_find(o->material);
}

double material_decay(double alpha, double beta, double loss, double w)
{
    return 0.5 * (alpha + w * (loss + beta * w));
}
