/* How alike two sounds of a struck object are, as papers/003 supplement C.2 has it in words; the formulas are ours.

   Image domain: power spectrograms (eq. 6; Hann, 2048 samples at 44.1 kHz or as long at other rates, hop a quarter of
   it, the first two seconds) summed into 24 critical bands of 1 Bark, levels by the 40-phon contour of ISO 226:2003 in
   phon, these in sone (2^((L - 40)/10), below 40 phon (L/40)^2.642). Full scale is 94 dB SPL.

       image = sum (N - N')^2 / sum N^2 over frames and bands

   Feature domain: 1 - score of analysis/feature_match.h. The paper says "a combination" of both: here the sum. */
#ifndef ANALYSIS_MATERIAL_METRIC_H
#define ANALYSIS_MATERIAL_METRIC_H
#include "analysis/feature_match.h"
#include "base/arena.h"
#include "fem/solid_family.h"

struct material_voice { /* one strike, and how the object's modes answer it (eq. 8 to 10) */
    const struct solid_family *family;
    double nu;
    const double *in, *out; /* [family->n] shapes where it is struck, and heard; out NULL: all modes are heard alike */
    int power;              /* of w in a mode's gain: displacement -1, velocity 0, acceleration 1 */
    int n;                  /* reference features */
    const struct feature *feature;
    const double *gain, *phase; /* [n] of them: gain e^(-d t) sin(2 pi f t + phase) */
};

struct material_metric {
    double image, feature; /* 0: alike */
};

/* dB SPL of a tone of that frequency (Hz) that is 40 phon loud: ISO 226:2003, between its rows linear over the
   logarithm. */
double material_metric_contour(double frequency);

struct material_search; /* a voice with its reference's loudness; not to be shared by threads */

struct material_search *material_metric_open(const struct material_voice *v, struct arena *a);
void material_metric_close(struct material_search *s);

enum { MATERIAL_GAMMA, MATERIAL_ALPHA_OF, MATERIAL_BETA_OF, MATERIAL_SIGMA, MATERIAL_UNKNOWNS };

/* At logarithms of gamma, alpha, beta and sigma (the strike's strength, of gains sigma |in out| w^power), loss added to
   the damping. */
struct material_metric material_metric_at(struct material_search *s, const double x[MATERIAL_UNKNOWNS], double loss);

/* log sigma at which the estimate is as strong as the reference, by energy. */
double material_metric_strength(struct material_search *s, const double x[MATERIAL_UNKNOWNS], double loss);

/* The search of papers/003: Nelder and Mead from x with those steps, twice again from what it finds, on image +
   feature; x is where it ends. Returns how often the metric was computed. */
int material_metric_descend(struct material_search *s, double x[MATERIAL_UNKNOWNS],
                            const double step[MATERIAL_UNKNOWNS], double loss);

#endif
