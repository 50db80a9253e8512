/* What is kept of a stimulus that is done: enough to know that it is, and for its row in the manifest. One line of JSON in the journal. */
#ifndef BATCH_RECORD_H
#define BATCH_RECORD_H
#include <stdbool.h>
#include <stdio.h>

#include "base/arena.h"
#include "base/hash.h"

struct record_file {
    const char *kind;       /* as of render_file: "wav", "scene", "csv" ...; "summary" holds times and has no hash */
    const char *path;       /* from the output folder                                                     */
    const char *sha256;     /* NULL: its bytes may differ from run to run                                 */
};

struct record {
    const char *name;       /* of the stimulus                                                            */
    const char *key;        /* sha256 of all that its samples depend on but a gain that waits for the set */
    const char *job;        /* sha256 of all that its files depend on; NULL: the gain is not known yet, and its files lie in .rasp/raw */
    const char *build;
    const char *place;      /* of the design, seen from the output folder; NULL: of a recording           */
    double full_scale;      /* its level as it was written; NAN: not by this                              */
    double peak, rms, lufs; /* of the raw sound: in the quantity, and LUFS as if that were the file; lufs NAN: not measured, or (loud) too short or too quiet */
    bool loud;              /* lufs was measured: a common peak or rms does not need it                   */
    double rate;            /* Hz                                                                         */
    int channels, encoding; /* of the file, enum encoding                                                 */
    long frames;
    const char *unit;       /* of the sound's quantity; NULL: not stated, or a recording                  */
    bool sounds;            /* there is a WAV                                                             */
    double gain;            /* file value per unit of the quantity                                        */
    double file_peak, file_rms, file_lufs, true_peak; /* of the WAV's samples, re full scale; LUFS (NAN: too short or too quiet) */
    double beyond;          /* samples of the WAV beyond full scale; NAN: not known                       */
    double ramp;            /* s, at both ends                                                            */
    const char *audio;      /* sha256 of the decoded samples; NULL: no WAV                                */
    struct record_file *files;
    int n_files;
    const char **remarks;   /* ends with NULL                                                             */
    double wall, cpu;       /* s that it took; NAN: not known                                             */
};

/* One line without its end. times: also what it took, which differs from run to run. Freed by free. NULL: no memory. */
char *record_text(const struct record *r, bool times);

/* False: not such a line, or not a whole one. */
bool record_read(const char *line, size_t n, struct arena *a, struct record *r);

#endif
