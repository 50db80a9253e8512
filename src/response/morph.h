/* Modes between the places where they are known: gains of shared poles, or whole modes with poles of their own (papers/000 section 2.4). */
#ifndef RESPONSE_MORPH_H
#define RESPONSE_MORPH_H
#include "response/modes.h"
#include "response/places.h"

struct morph {
    int n, rows;                   /* components; places */
    struct places *places;
    double *re, *im; /* shared poles: [places_terms()][rows][n] complex gains, then what places_fill makes of them */
    double *frequency, *decay, *gain; /* separate: [rows][n] logarithms, less that of the modes' frequency, decay and largest |gain|; 0 where absent */
    double *phase;                 /* [rows][n] in units of pi, 0 to 2 */
    double *there;                 /* [rows][n] 1, or 0: the place lacks the mode */
    double *largest;               /* [n] |gain| */
    double *lowest, *highest;      /* [n] Hz */
    double rate;                   /* Hz */
    bool gaps;                     /* some place lacks some mode */
    int *high, highs;              /* components that reach 0.45 rate somewhere */
    double *share, *amplitude, *torn; /* [n] work */
    double *size, *sine, *cosine;  /* [4 n] work */
};

/* Shared poles: after the last gain, what morph_shared needs of their slopes. */
void morph_slopes(struct morph *p);

/* Separate poles: a place's frequency and decay (above 0) and gain e^(j phase) of component i, after the modes' own frequency[i], decay[i] and largest[i]
   are set; a gain of 0 is none. */
void morph_put(struct morph *p, const struct modes *m, int row, int i, const double value[4]);

/* After the last: what morph_separate needs to know of the whole. Also after components have been dropped. */
void morph_settle(struct morph *p);

/* modes_at of a struct modes whose self is a struct morph. */
double morph_shared(const struct modes *m, const struct modes_where *where, const struct modes_point *to);
double morph_separate(const struct modes *m, const struct modes_where *where, const struct modes_point *to);

/* Keeps the components for which keep[i] is set, here and in m; returns how many were dropped. */
int morph_keep(struct morph *p, struct modes *m, const bool *keep);

#endif
