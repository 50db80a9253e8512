/* The statistics of a series of impacts, as papers/002 section IV estimates them: means, ARMA(1,1) filters, white
   processes and their distributions, of amplitudes and intervals, with standard errors. */
#ifndef ANALYSIS_IMPACT_STATISTICS_H
#define ANALYSIS_IMPACT_STATISTICS_H
#include "analysis/impact_find.h"
#include "base/arena.h"
#include "base/err.h"

#define STATISTICS_ONE_PROCESS 0.5 /* from this correlation on one process is nearer than two: halfway */

enum { STATISTICS_LAGS = 51, STATISTICS_WARNINGS = 16, STATISTICS_LEAST = 50 };
enum { STATISTICS_AMPLITUDE, STATISTICS_INTERVAL, STATISTICS_SERIES };

struct estimate {
    double value, error; /* standard error                                                     */
    double low, high;    /* of the 95 % confidence interval                                    */
};

struct distribution_fits {    /* of the whitened, and of the series itself                          */
    double gaussian_r2;       /* R^2 of the density against a histogram, as papers/002 figure 9     */
    double gaussian_distance; /* Kolmogorov's distance                                              */
    double exponential_mean, exponential_distance;   /* of values above 0 (Lagrange's amplitudes) */
    double gamma_shape, gamma_scale, gamma_distance; /* Lagrange's intervals; NAN: values below 0 */
    double skewness, kurtosis; /* kurtosis: 3 of Gaussian ones                                      */
};

struct series_statistics {
    struct estimate mean, deviation, a1, b1; /* deviation: of the white process                       */
    double variance;                         /* of the series itself                                               */
    double whiteness, whiteness_p;           /* Ljung and Box's Q of the whitened, over 20 lags; its probability */
    double correlation[STATISTICS_LAGS], white_correlation[STATISTICS_LAGS]; /* lags 0 to 50          */
    struct distribution_fits itself, white;
    bool flat;      /* all values alike: no filter, deviation 0                           */
    bool ridge;     /* a1 is within 2 errors of b1: they cancel, any such pair fits           */
    int iterations; /* of Gauss and Newton                                                */
};

struct impact_modulation {
    double depth, rate;             /* of the strongest sinusoid in the amplitudes: 1, Hz                 */
    double depth_error, rate_error; /* standard errors                                                */
    double probability;             /* that noise of the same spectrum makes one as strong                */
    bool found;                     /* probability < 0.001: the amplitudes were divided by 1 + m sin      */
    bool looked;                    /* false: not asked for, or amplitudes of both signs                  */
};

struct impact_statistics {
    int n; /* impacts                                                            */
    struct series_statistics series[STATISTICS_SERIES];
    double cross[2 * STATISTICS_LAGS - 1],
        white_cross[2 * STATISTICS_LAGS - 1]; /* amplitude with interval, lags -50 to 50: A_n with T_(n+k) */
    double one_process;                       /* correlation of both whitened at lag 0, by ranks                    */
    struct impact_modulation modulation;
    double *white[STATISTICS_SERIES];          /* [n - 1] whitened                                             */
    double *demodulated;                       /* [n] amplitudes                                                     */
    const char *warnings[STATISTICS_WARNINGS]; /* what biases the estimates, in words; ends with NULL */
};

/* At least 50 impacts, else ERR_SCENE. `demodulate` false: amplitudes as they are. No modulation is looked for where
   more than a tenth of the amplitudes have the rarer sign: what multiplies a series about 0 leaves no line in it. */
bool impact_statistics_make(const struct impact_events *v, bool demodulate, struct arena *a,
                            struct impact_statistics *s, struct err *e);

#endif
