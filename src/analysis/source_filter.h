/* A recording of rolling or scraping as what rings and what drives it: poles, gains, source, impacts (papers/002
   section II-C).

   Both methods begin with onsets: instants at which the energy of what linear prediction does not foresee rises (the
   papers go by high frequencies, which a smooth impact has none of). Impacts are alike there, and that rest divided by
   the mean of their pulses shows more of them.

   Lagrange et al. (papers/002 [18]): from impacts that are known, times t_k and sizes a_k, the response to an impact of
   1 is that which makes

     x = sum_k a_k h(t - t_k) + rest

   least in squares over the whole recording: what all impacts have in common, however closely they follow each other.
   Its poles, with those of the longest free frames, are found by ESPRIT and output error (analysis/modal.h), from the
   last early reflection on: a room adds copies of what rings, which move no pole. What is left of the response until
   then is the click, which no mode is: the force itself as it sounds, what decays at once, the room. The source
   is the recording divided by the response H of both, where that is loud enough:

     F = X H* / (|H|^2 + eps)      eps: the noise's power over the source's, and a share of the greatest |H|^2: -20 dB
                                   while impacts are looked for, -40 dB in the source that is written

   An impact in it is a pulse, IFFT(|H|^2/(|H|^2 + eps)); the greatest is taken off, and so on down to the noise.
   With these impacts the mean response is found again, until they give no more of the recording. Any sound is that of
   one impact and a response, or of many and another: of these the fewest are taken. 002 takes the poles
   of frames of the recording alone, and prints no eps, no gains and no search of impacts: the mean response and these
   are ours. An impact's own shape (II-C: a Meixner window) is not separated from the click. Impacts are drawn as
   short raised cosines, of series as rasp analyse finds them (002 section IV-E), not of exponential amplitudes and
   gamma intervals as in II-C.

   Lee et al. (papers/002 [19]): the poles by linear prediction of low order in subbands, over all frames together.
   Each impact has gains of its own, which are what the zeros of its spectrum say: modes that it excites little, or
   damps. So there is no common H: impacts are those of the mean response, and the filter changes from one to the next.
   The paper's notches are these gains; it prints no orders and no bands: ours.

   Where impacts give less than 35 % of the recording, since the contact never breaks, the poles are those of the
   recording's autocorrelation: that of what is driven by a white force falls as the object rings. */
#ifndef ANALYSIS_SOURCE_FILTER_H
#define ANALYSIS_SOURCE_FILTER_H
#include "analysis/impact_find.h"
#include "analysis/modal.h"

enum source_filter_method { SOURCE_FILTER_LAGRANGE, SOURCE_FILTER_LEE };

struct source_filter_options {
    int method;
    int most;         /* modes */
    double low, high; /* Hz */
    double fastest;   /* 1/s, of decays */
    double rise;      /* dB, of an onset */
    double snr;       /* dB by which the source's power is above what the division takes for noise; NAN: as measured */
    bool both;        /* impacts in both directions */
    double direct;    /* of modes that are given: what an impact of 1 adds to one sample at once */
};

struct source_filter_mode {
    double frequency, decay;       /* Hz, 1/s */
    double frequency_se, decay_se; /* NAN: not known */
    cplx gain;                     /* A: h(t) = Im A e^(s t) of an impact of 1 */
};

struct source_filter {
    const double *x; /* [n] the recording */
    long n;
    double rate;
    int onsets, frames; /* frames: free ones that poles were taken from */
    long *onset;        /* [onsets] samples */
    double longest;     /* s, of the response or a free frame */
    bool correlated;    /* poles of the autocorrelation */
    const char *note;   /* lines, of the fit; NULL */
    int m;
    struct source_filter_mode *mode; /* [m] by falling energy */
    long clicks;
    double *click;                /* [clicks] what an impact of 1 sounds at once besides, from its time on; none: 0 */
    double free;                  /* s after an impact's time, from which on the modes alone ring */
    double reflected, reflection; /* s after an impact, and its share of it: a room's strongest; NAN: none is clear */
    double noise;                 /* rms of what modes leave of the frames */
    double fits; /* share of the recording that impacts, all alike, give; Lee: of the energy between them the modes' */
    /* Lee: places of a filter that changes */
    int places;
    double *place_time; /* [places] s */
    cplx *place_gain;   /* [m][places] */
    /* the source, of an h of the gains above: its unit is the recording's, since |h| is at most 1 */
    double *source; /* [n] a sample's push; Lee: the impacts alone */
    double rings;   /* share of the recording's energy in the band that the source and the modes give back */
    double struck;  /* share of the source's energy that its impacts are */
    double band[2]; /* Hz, between which half of the source's spectrum is known */
    struct impact_events impacts; /* amplitude: pushes; durations are not known */
};

/* mode [m] given (a table of a strike's): only the source is looked for; NULL: all is. ERR_SCENE: silent, no onset and
   too short, no mode. */
bool source_filter_find(const double *x, long n, double rate, const struct source_filter_options *o, int m,
                        const struct source_filter_mode *mode, struct arena *a, struct source_filter *f, struct err *e);

/* y[n] = source * h: what is given back. */
void source_filter_sound(const struct source_filter *f, double *y);

#endif
