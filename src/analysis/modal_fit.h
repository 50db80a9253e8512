/* Modes fitted to recordings by output error on exact DFT bins.

   A mode that a force f drives is x[n] = p x[n-1] + f[n], p = e^(s/rate), s = -d + j omega; a recording is
   y[n] = sum_i Re(B_i x_i[n]) + noise. On the bins of the DFT of any stretch [a, b) of it,

       X(w) = (F(w) + H - G)/(1 - p e^(-jw)),   G = sum_{n < b} f[n] p^(b-n),   H = sum_{n < a} f[n] p^(a-n),

   exactly, since e^(-jw(b-a)) = 1 there: no window, no truncation, no decimation. White noise stays independent from
   bin to bin, a band of frequencies is a range of bins, and where the force holds nothing neither does X. Each strike's
   stretch has gains of its own: no hand strikes twice on one point with one delay. Its poles are those of all within
   what strikes differ by, as an object rests anew each time: a random effect, normal in omega/omega and log d, of a
   spread that all modes share and that is 0 unless the strikes show one. What rings on from earlier strikes of a place
   is a state at the stretch's first sample, of their gains. Where no force is known
   a stretch begins after its strike and f is a unit impulse at its first sample. A pulse may lie before its stretch,
   too: then H brings all in, F is 0, and there are no smooth columns (below).

   In a window of bins what modes outside it leave there, and what goes straight from the force to the sound, is smooth
   in frequency but for F: F(w) (c0 + c1 u + c2 u^2), u from -1 to 1 over the window (a local polynomial, as of the
   local polynomial method of system identification). These columns are fitted with the gains, always.

   An object does not decay quite as the model has it, and what the model leaves of it is no noise: neighbouring bins
   are alike. Once the search is over a strike's bins count as fewer, by (1 + r)/(1 - r), r the correlation of
   neighbours in what its modes leave: in chi squared, so that no component stays that only mends the model, and in
   standard errors. Of white noise r is 0. While modes are looked for, a new one in the window of a stronger one must be
   worth that much more. */
#ifndef ANALYSIS_MODAL_FIT_H
#define ANALYSIS_MODAL_FIT_H
#include <stdbool.h>

#include "analysis/modal.h"

/* A window reaches MODAL_REACH half-widths and 2 MODAL_REACH bins to each side of its modes. */
enum {
    MODAL_REACH = 12,
    MODAL_BLOCK = 24,
    MODAL_CHUNK = 64, /* bins that a basis is made of at once */
    MODAL_SMOOTH = 6,
    MODAL_STRETCHES = 256,
    MODAL_COLUMNS = 4 * MODAL_BLOCK + MODAL_SMOOTH + 1
};

struct modal_window { /* of a block in a stretch */
    long from, to;    /* bins, counted from bins.first */
    cplx *rest;       /* [to - from] what is left of the recording without the block's modes */
    double degrees;   /* of freedom, of the block as it was opened */
    double alike;     /* bins of what is left that are as good as one: 1 of white noise */
    double noise;     /* what the block leaves, over the variance: its noise, and what is no mode */
    bool used;        /* it has normal equations of the poles (omega, log d), gains and what is smooth projected out */
    double a[2 * MODAL_BLOCK * 2 * MODAL_BLOCK], right[2 * MODAL_BLOCK];
    double scale[2 * MODAL_BLOCK]; /* the columns' squares before that: what is less than 1e-10 of them is rounding */
};

struct modal_bins { /* of one stretch: its DFT over sqrt(n), bins first ... first + n - 1 */
    long first, n;
    double width;     /* rad/s from bin to bin */
    double *er, *ei;  /* e^(-jw) */
    double *fr, *fi;  /* the force */
    cplx *y;          /* the recording */
    cplx *rest;       /* ... less all modes of the fit */
    cplx *noise;      /* ... and less what is smooth but for the force: noise, and modes that are missing */
    double *variance; /* E |noise|^2 */
    double *floor;    /* the same at least: of the recording where nothing rings, of its rounding */
    double *scale;    /* the lead's noise; 1: there is none */
};

struct modal_line {
    cplx p, g, d;
    double t, force; /* t: 1/rate; force 1, of what rings on 0 */
};

struct modal_component {
    cplx s;           /* the pole that strikes share */
    bool hum;         /* does not decay, and is no mode */
    double spread[2]; /* standard deviations of strikes' own poles: of omega/omega, of log d */
    double moved;     /* how far the pole went since its neighbours were last fitted, in its standard errors */
    double rise;      /* of chi squared without it; NAN: not known */
};

struct modal_part { /* of a component in a stretch */
    cplx gain, pole;
};

struct modal_fit {
    const struct modal_data *data;
    const struct modal_options *options;
    struct arena *a;
    double low, high;        /* rad/s */
    double slowest, fastest; /* 1/s, bounds of a decay */
    double longest;          /* s, of the longest stretch */
    int most;                /* components: the weakest may be none, or leave in the end */
    int strikes;             /* that are fitted */
    bool found;              /* the search is over: what is left now is noise, and what is no mode */
    struct modal_bins *bins; /* [stretches] */
    int m, room;
    struct modal_component *c; /* [room] */
    struct modal_part *part;   /* [room][stretches] */
    double typical[2];         /* spread of a component that is new */
    double tolerance; /* squared standard errors of all poles of a block together that a polish may stop within: 1e-2
                         while modes are looked for, 1e-4 at the end */
};

/* Some components of a fit, the others as they are: their poles and gains, and what is left of the recordings without
 * them. */
struct modal_block {
    const struct modal_fit *fit;
    int m;
    int of[MODAL_BLOCK]; /* components of the fit; -1: new */
    cplx s[MODAL_BLOCK];
    double spread[MODAL_BLOCK][2];
    struct modal_part *part;     /* [MODAL_BLOCK][stretches] */
    struct modal_window *window; /* [stretches] */
    double centre, half;         /* rad/s of the window */
    double fastest;              /* 1/s */
    double chi; /* -2 log likelihood: sum of degrees log noise, and the squares of strikes' poles off the shared ones */
    double normal[2 * MODAL_BLOCK * 2 * MODAL_BLOCK]; /* of the shared poles (omega, log d), all others projected out */
    struct arena *a;
};

/* modal_fit.c */
void modal_fit_open(struct modal_fit *f, const struct modal_data *d, const struct modal_options *o, struct arena *a);
void modal_fit_noise(struct modal_fit *f,
                     double width); /* variance: a running median over that many Hz of what is left */
/* x[n] - F (c0 + c1 u + c2 u^2), c by least squares: what goes straight from the force to the sound, and the skirts of
 * modes that are far away. */
void modal_fit_take_smooth_off(const struct modal_bins *b, long from, long n, const cplx *x, cplx *to);
void modal_fit_add(struct modal_fit *f, cplx s, const struct modal_part *part); /* part NULL: no gains */
void modal_fit_drop(struct modal_fit *f, int i);
/* What a block fits: gains with what rings on from earlier strikes of the place, as if the strike had made it. Of a
   weak strike after a loud one most of what is heard rings on: a pole fitted to the strike's own part alone would
   overshoot by their ratio. */
void modal_fit_totals(const struct modal_fit *f, int i, struct modal_part *total);
void modal_fit_replace(struct modal_fit *f, int i, cplx pole, const struct modal_part *total);
void modal_fit_sizes(const struct modal_fit *f, int i, double *size); /* [stretches] |x B| at their pulses' ends */
/* Amplitude of what a lead holds within a pole's half-width and two bins, with its noise or without. 0 if that is
   another component's: one that is nearer to the strongest of these bins by more than a bin, or, of a pole that decays
   within the lead, as near within a bin and hardly decays. */
double modal_fit_lead(const struct modal_fit *f, int stretch, int i, bool noise);
void modal_fit_put(struct modal_fit *f, int i, double sign); /* rest += sign (component i) */
void modal_fit_rest(struct modal_fit *f);                    /* rest anew */
/* What X of a pole needs on a stretch's bins: p, H - G and its derivative over sqrt(n). */
struct modal_line modal_fit_line(const struct modal_fit *f, int stretch, cplx s);
/* X, dX/ds and the same of the mirror pole at n bins, re and im each. */
void modal_fit_basis(const struct modal_bins *b, const struct modal_line *l, long from, long n,
                     double (*x)[MODAL_CHUNK]);
/* to[n] += the real part of gain times what the line makes. */
void modal_fit_add_line(const struct modal_bins *b, const struct modal_line *line, cplx gain, long from, long n,
                        cplx *to);

/* modal_block.c */
struct modal_block *modal_block_open(const struct modal_fit *f, int m, const int *of, const cplx *extra, int extras,
                                     struct arena *a);
/* A block that modal_block_copy can make like another; both of one fit. */
struct modal_block *modal_block_room(const struct modal_fit *f, struct arena *a);
void modal_block_copy(struct modal_block *to, const struct modal_block *from);
void modal_block_worth(
    struct modal_block *b,
    double *worth); /* the same; worth[m]: by how much chi rises without each, its poles and the others' as they are */
void modal_block_drop(struct modal_block *b, int i);
bool modal_block_polish(struct modal_block *b,
                        int steps); /* poles and gains; true: converged to 0.01 standard errors */
double modal_block_alike(const struct modal_block *b); /* of what it leaves, mean over the stretches */
/* Standard errors of omega and log d, and of each strike's |gain|. */
void modal_block_errors(struct modal_block *b, int i, double se[2], struct modal_gain *gain);
/* How far pole i of each strike is from the shared one by the strike alone (q 0: omega/omega, 1: log d), and the
 * variance of that; returns how many strikes there are. */
int modal_block_deviations(struct modal_block *b, int i, int q, double *by, double *variance);
void modal_block_sweep(double *a, int n, int from, int to, const double *scale);

/* modal_converge.c */
int modal_converge_near(const struct modal_fit *f, int i, int most,
                        int *of); /* components whose bands touch i's, i too, by frequency */
/* Opens a block of those; *at: where i is in it. */
struct modal_block *modal_converge_open(const struct modal_fit *f, int i, int most, int *at, struct arena *a);
double modal_converge_refine(struct modal_fit *f, int n, const int *of,
                             int steps); /* fits them anew, the greatest move in standard errors */
void modal_converge_sweeps(struct modal_fit *f, int most, int rounds);
double modal_converge_rise(struct modal_fit *f, int i); /* of chi when i goes and its neighbours are fitted anew */
void modal_converge_drop(struct modal_fit *f, int i, int most); /* the others of `most` are fitted anew */
/* Drops the component of least worth until that is HUGE_VAL; returns how many went. */
int modal_converge_drop_least(struct modal_fit *f, double (*worth)(struct modal_fit *f, int i), int most);
void modal_converge_eliminate(struct modal_fit *f); /* what the others do without */
void modal_converge(struct modal_fit *f);
int modal_converge_runaways(struct modal_fit *f); /* components at the bound of decays, or far louder than there is */
extern const double modal_converge_leave;         /* chi squared of 4 degrees that a component must be worth to stay */
double modal_converge_limit(const struct modal_fit *f,
                            double chi4); /* of chi squared of 2 + 2 stretches degrees, as likely
                                                                      as chi4 of four */

extern const double modal_converge_stated[2]; /* spreads before they are measured, and where one strike is all */
void modal_converge_spread(struct modal_fit *f);

/* modal_search.c */
void modal_spectrogram(struct modal_fit *f);
double modal_search_round(struct modal_fit *f, double *noise); /* the greatest power of a bin that is left, and the
                                                                  least noise; over the lead's, if there is one */
int modal_search(struct modal_fit *f, double width,
                 double least); /* bands of that width in Hz, components of at least that power: how many came */

#endif
