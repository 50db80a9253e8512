/* What objects are made of: material.def, each figure with its source. */
#ifndef SCENE_MATERIAL_H
#define SCENE_MATERIAL_H
#include "scene/scene.h"

struct material_radial {                       /* of wood, through a flat-sawn board; youngs_modulus 0: isotropic */
    double youngs_modulus, shear_lr, shear_rt; /* Pa */
    double poisson_lr, poisson_rt;             /* -, of pulls along the grain and along the radius */
};

struct material {
    const char *name;                     /* the word of scene.h's enum material_name */
    double youngs_modulus, across, shear; /* Pa: along x (the grain), across, shear modulus in the plane */
    double poisson, density;              /* -, kg/m^3 */
    double alpha, beta, loss;             /* 1/s, s, loss factor: decay = (alpha + beta w^2 + loss w)/2 at w = 2 pi f */
    const char *source, *damping_source;
    struct material_radial radial;
};

/* NULL for MATERIAL_CUSTOM. */
const struct material *material_find(int name);

/* Of a body: the scene's own material that it names, else that of its word. */
const struct material *material_given(const struct object_given *o);

/* All of them; ends with a NULL name. */
extern const struct material material_table[];

/* decay in 1/s of a mode of angular frequency w (rad/s, undamped). */
double material_decay(double alpha, double beta, double loss, double w);

#endif
