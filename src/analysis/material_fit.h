/* What an object is made of, from the modes of its recordings: papers/003 section C, in the domain of features.

   papers/003 looks for alpha, beta, gamma = E/density and a strike's strength at a given Poisson's ratio, by a local
   search from a guess. Here nu is an unknown too, all of gamma and nu is scanned before anything is refined, and
   frequencies fix gamma and nu by themselves (eq. 5 and 7): damping is fitted afterwards, by several laws. */
#ifndef ANALYSIS_MATERIAL_FIT_H
#define ANALYSIS_MATERIAL_FIT_H
#include <stdbool.h>

#include "analysis/material_damping.h"
#include "base/arena.h"
#include "base/err.h"
#include "fem/solid_family.h"

struct material_set {    /* the modes of one table, of one object */
    int object, n;       /* n by rising frequency */
    double *log_lambda;  /* [n] log of lambda = (2 pi f)^2 + d^2, rad^2/s^2 */
    double *frequency;   /* [n] Hz */
    double *error;       /* [n] standard error of the frequency, a share of it */
    double *decay;       /* [n] 1/s */
    double *decay_error; /* [n] its standard error, a share */
    double *visible;     /* [modes of the object] 0 to 1: how well its recordings show a mode; NULL: not known */
    bool hum;            /* of the recordings was left out */
    int *match;          /* [n] output: branch of the object's family, -1: of none */
};

struct material_problem {
    const struct solid_family *object; /* [objects] */
    int sets;
    struct material_set *set;
    double gamma[2];    /* m^2/s^2, the range that is scanned */
    double poisson;     /* given; NAN: to be found */
    double model_error; /* standard error of a computed frequency besides the mesh's, a share */
    double size_error;  /* standard error of the object's lengths, a share: all together too long or too short */
};

struct material_fit {
    int modes, matched, missing; /* of all sets; missing: branches that should show and do not, in the sets' bands */
    int distinct;                /* modes of the objects that are matched, each once however many strikes show it */
    struct material_figure gamma, nu;
    double correlation;    /* of log gamma and nu */
    double scatter, birge; /* rms of log(f/f_model); root of chi^2 by its freedoms */
    double cost;           /* robust, of the best place */
    struct {
        double gamma, nu, cost;
    } next; /* the best place elsewhere (gamma by 1 % or more); cost NAN: none */
    bool unique, nu_at_bound, nu_known;
    struct material_damping damping[MATERIAL_LAWS];
    int best;            /* law of the least BIC of those that a scene can have (the first seven) */
    bool sure;           /* intervals are given: enough matches, unique */
    const char *warning; /* lines; NULL */
};

/* ERR_SCENE: less than three modes, or no place at which three match. */
bool material_fit(const struct material_problem *p, struct arena *a, struct material_fit *f, struct err *e);

/* Laws of damping alone, of all modes of the sets; nothing else of f is set but `modes`, `matched`, `sure` and
   `warning`. */
void material_fit_damping(const struct material_set *set, int sets, struct arena *a, struct material_fit *f);

#endif
