/* What `rasp analyse` finds, and its parts: reading, the report as text and as JSON, the parameter file, the plots. */
#ifndef CMD_ANALYSE_H
#define CMD_ANALYSE_H
#include "analysis/impact_find.h"
#include "analysis/impact_shape.h"
#include "analysis/impact_statistics.h"
#include "base/outfile.h"

enum { ANALYSE_NOTES = 32 };

struct analyse_given {  /* what a file does not say itself, and what counts as an impact */
    double scale, rate; /* N per unit, Hz; NAN: not given                                */
    double theta;       /* NAN: to be found                                              */
    bool keep_modulation;
    long channel;       /* from 1                                                        */
    const char *column; /* NULL: force_n or force_mean_n                                 */
    struct impact_options options;
};

struct analyse_source {      /* a force, or a table of impacts                                */
    const char *file, *kind; /* "WAV", "NPY", "CSV"                                          */
    bool has_force;          /* false: a table of impacts, signal is empty                    */
    int channels;            /* of a WAV                                                      */
    struct impact_signal signal;
    struct impact_found found; /* of a table only found.events                               */
};

/* How theta was found. */
enum analyse_theta { ANALYSE_THETA_GIVEN, ANALYSE_THETA_FILE, ANALYSE_THETA_ALONE, ANALYSE_THETA_NONE };

enum analyse_distribution { ANALYSE_AUTO, ANALYSE_GAUSSIAN, ANALYSE_TABLE };

struct analysis {
    struct arena *arena;
    struct analyse_source source, single; /* single.file NULL: none                          */
    struct analyse_given given;
    bool counted; /* statistics are there: enough impacts                          */
    struct impact_statistics statistics;
    bool lasts; /* durations are known                                           */
    enum analyse_theta theta;
    struct impact_duration duration;
    bool constant; /* no law was taken: theta 0, zeta the durations' median         */
    struct impact_shape shape;
    int distribution;                 /* enum analyse_distribution, as asked                           */
    bool force;                       /* the parameter file and its tables may be overwritten          */
    const char *notes[ANALYSE_NOTES]; /* warnings                                            */
    int n_notes;
    const char **written; /* files                                                           */
    int n_written;
};

extern const char *const analyse_series_names[STATISTICS_SERIES]; /* "amplitude", "interval" */

/* Why no duration is known. */
const char *analyse_notes_unknown(const struct analysis *a);

/* Does the distribution of that whitened series go into a table? */
bool analyse_tabled(const struct analysis *a, int series);

/* One process, or two? */
bool analyse_one_process(const struct analysis *a);

/* Reads the file, and finds the impacts if it holds a force. ERR_INPUT, ERR_SCENE. */
bool analyse_read(const char *file, const struct analyse_given *g, struct arena *a, struct analyse_source *s,
                  struct err *e);

/* Statistics, durations and shape of what was read: arena, source, single, given and distribution are set. ERR_SCENE */
bool analyse_make(struct analysis *a, struct err *e);

/* Prints what was found. ERR_IO */
bool analyse_report(const struct analysis *a, bool json, struct err *e);

/* What is written is opened first and gets its names at the end: all or none, as far as that can be had. */
struct analyse_files {
    struct outfile o[8];
    const char *name[8];
    int n;
};

/* The parameter file and the tables that it needs beside it. ERR_CREATE (also: one of them is what was analysed),
   ERR_IO, ERR_SCENE (a value that no scene may have). */
bool analyse_report_part(struct analysis *a, const char *file, struct analyse_files *all, struct err *e);

/* PREFIX.correlations.png and so on; a folder: FOLDER/NAME.correlations.png. ERR_UNBUILT (no gnuplot), ERR_CREATE,
 * ERR_IO. */
bool analyse_report_plot(struct analysis *a, const char *prefix, bool svg, struct analyse_files *all, struct err *e);

#endif
