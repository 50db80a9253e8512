/* Laws of a mode's decay over its eigenvalue lambda = w^2, fitted to measured decays: in logarithms, by least squares
   with soft L1 (papers/003 eq. 4 and others). */
#ifndef ANALYSIS_MATERIAL_DAMPING_H
#define ANALYSIS_MATERIAL_DAMPING_H

struct material_figure {
    double value, low, high; /* and its 95 % interval; NAN: there is none */
};

enum material_law {                 /* of decay over lambda, w = sqrt(lambda) */
                    MATERIAL_ALPHA, /* alpha/2 */
                    MATERIAL_BETA,  /* beta w^2/2 */
                    MATERIAL_LOSS,  /* loss w/2 */
                    MATERIAL_RAYLEIGH,
                    MATERIAL_ALPHA_LOSS,
                    MATERIAL_BETA_LOSS,
                    MATERIAL_ALL,   /* (alpha + beta w^2 + loss w)/2 */
                    MATERIAL_POWER, /* c w^m */
                    MATERIAL_ZENER, /* strength/2 w^2 t/(1 + w^2 t^2), a standard linear solid */
                    MATERIAL_LAWS
};

struct material_damping {
    const char *name;
    int n;                    /* parameters */
    const char *parameter[3]; /* their names */
    const char *unit[3];
    struct material_figure figure[3];
    double bic, scatter; /* scatter: rms of log(decay/law) */
};

struct material_decay {
    double lambda, log_decay, sigma; /* rad^2/s^2; of 1/s; standard error of log_decay */
};

/* n decays, of which not all need follow the law. Its interval is the wider of the covariance's (times Birge's ratio,
   by Student's t) and of a bootstrap; a term that nowhere makes 1 % of the decay is 0. */
void material_damping_fit(int law, const struct material_decay *d, int n, struct material_damping *g);

/* By how much (standard deviation of logarithms) decays lie beside the law of three terms besides their own errors: as
   much as makes their squares, each by both, what chance has them (R. C. Paule and J. Mandel, Consensus values and
   weighting factors, J. Res. NBS 87, 1982), with the soft L1. */
double material_damping_scatter(const struct material_decay *d, int n);

/* decay of a law at lambda (rad^2/s^2), 1/s, by its parameters. */
double material_damping_decay(int law, const double *parameter, double lambda);

/* alpha, beta, loss of one of the first seven laws, of all fitted ones; 0 where it has none. */
void material_damping_terms(const struct material_damping *all, int law, double damping[3]);

/* How many standard errors hold 95 % with so many freedoms; half of the width that 95 % of MATERIAL_DRAWS values take
   about `value` (sorts them); how often each of n is drawn, of n draws of the number `draw`. */
enum { MATERIAL_DRAWS = 200 };

double material_damping_student(double freedoms);
double material_damping_spread(double *draw, double value);
void material_damping_resample(int draw, const char *what, int n, double *times);

#endif
