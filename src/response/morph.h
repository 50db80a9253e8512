/* Modes between the places where they are known: which modes of different places are one and the same (by frequency,
   as an optimal assignment between neighbouring places), then gains of shared poles, or whole modes with poles of their
   own (papers/000 section 2.4). */
#ifndef RESPONSE_MORPH_H
#define RESPONSE_MORPH_H
#include "response/modes.h"
#include "response/places.h"

/* Rows to columns, each at most once, so that the sum of the pairs' cost[rows][columns] and of `alone` for every row
   and every column without a partner is least. HUGE_VAL: no pair. column[row]: its partner, or -1. Costs finite and >=
   0 otherwise. */
void morph_assign(int rows, int columns, const double *cost, double alone, int *column);

struct morph_list { /* the modes of a place */
    int n;
    const double *frequency, *decay; /* Hz, 1/s, all above 0 */
};

/* Pairs two places' modes: |log f| costs, with a small part for log decay to tell apart what frequency does not; modes
   whose frequencies differ by more than the share `gate` are never a pair. column[row->n]: the other's index, or -1. */
void morph_pair(const struct morph_list *row, const struct morph_list *other, double gate, int *column);

/* Follows modes from place to place: along the shortest tree of the places' edges (by length), from the place with most
   modes; each next place's modes are paired with what is followed so far, taken where it was last met nearest to that
   place. list[places]; xy [places][2]. track[place][mode]: number of the mode, 0 .. returned number - 1. */
int morph_tracks(const struct places *p, int places, const double *xy, const struct morph_list *list, double gate,
                 int *const *track);

struct morph {
    int n, rows; /* components; places */
    struct places *places;
    double *re,
        *im; /* complex gains: [places_rows()][n], then what places_fill makes of them; NULL: logarithmic ones */
    double *frequency, *decay;        /* separate poles: logarithms less those of the modes' own; 0 where absent.
                                         [places_rows()][n] as re, or [rows][n] */
    double *gain;                     /* logarithmic: [rows][n] less that of the largest |gain|; 0 where absent */
    double *phase;                    /* [rows][n] in units of pi, 0 to 2 */
    double *there;                    /* [rows][n] 1, or 0: the place lacks the mode */
    double *largest;                  /* [n] |gain| */
    double *lowest, *highest;         /* [n] Hz */
    double rate;                      /* Hz */
    bool gaps;                        /* some place lacks some mode */
    int *high, highs;                 /* components that reach 0.45 rate somewhere */
    double *share, *amplitude, *torn; /* [n] work */
    double *size, *sine, *cosine;     /* [4 n] work */
};

/* A morph of complex gains: takes its rows, with separate poles or without; then a place's gain and, of separate poles,
   frequency and decay (above 0) of component i (a gain of 0 with the modes' own, where it is left out); after the last,
   what morph_complex needs of their slopes. */
void morph_begin(struct morph *p, bool shared, struct arena *a);

struct morph_pole {
    double frequency, decay, re, im;
};

void morph_set(struct morph *p, const struct modes *m, int row, int i, const struct morph_pole *at);

void morph_slopes(struct morph *p);

/* Logarithmic gains: a place's frequency and decay (above 0) and gain e^(j phase) of component i, after the modes' own
   frequency[i], decay[i] and largest[i] are set; a gain of 0 is none. */
void morph_put(struct morph *p, const struct modes *m, int row, int i, const double value[4]);

/* After the last: what morph_separate needs to know of the whole. Also after components have been dropped. */
void morph_finish(struct morph *p);

/* modes_at of a struct modes whose self is a struct morph. */
double morph_complex(const struct modes *m, const struct modes_where *where, const struct modes_point *to);

double morph_separate(const struct modes *m, const struct modes_where *where, const struct modes_point *to);

/* Keeps the components for which chosen[i] is set, here and in m; returns how many were dropped. */
int morph_select(struct morph *p, struct modes *m, const bool *chosen);

/* Modes between places at which they have been computed, as a mode table of those places and of complex gains would
   give them. */
struct morph_points_ask {
    int n, places;                /* modes, at least 1 */
    const double (*xy)[2];        /* [places] m */
    const struct modes_point *at; /* [places] */
    bool shared;                  /* poles are those of the first place */
};

/* To be read by modes_at of the same arena's lifetime; modes do not fade at half of any rate. ERR_SCENE as places_make.
 */
bool morph_points(const struct morph_points_ask *ask, struct arena *a, struct modes *m, struct err *e);

#endif
