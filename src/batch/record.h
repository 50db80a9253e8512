/* The record of a stimulus, NAME.json in the set's folder: what made it, its files with their hashes, its measured
   levels. It is renamed into place last, so that the records are the journal of a set: whatever a record says is there
   is there, unless somebody changed it since.

     "set": 2      the format
     "status"      making   the files are about to get their names; those of before and those to come are listed
                   waits    the sound waits for the gain of the whole set, as float64 in .rasp/raw
                   done
     "key"         SHA-256 of all that made it but the name and the gain of the whole set (batch/stimulus.c)
     "measured"    what the manifest says of the sound
     "record"      SHA-256 of the text before it: a record that was cut off, or edited, is none

   and what rasp render writes of a render, without times. */
#ifndef BATCH_RECORD_H
#define BATCH_RECORD_H
#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "base/err.h"
#include "base/hash.h"

enum record_status { RECORD_MAKING, RECORD_WAITS, RECORD_DONE };

struct record_file {
    const char *kind; /* as of render_file: "wav", "scene", "csv" ...                          */
    const char *path; /* from the set's folder                                                 */
    bool raw;         /* it lies in .rasp/raw                                                  */
    const char *sha256;
    double size; /* bytes                                                                 */
};

struct record {
    enum record_status status;
    const char *key, *program;
    const char *seen_from; /* the design, as seen from the folder; NULL: of a recording           */
    double full_scale;     /* the gain of the whole set; NAN: it has none, or waits                */
    double rate;           /* Hz                                                                  */
    long frames;
    bool sounds;            /* there is a WAV; what follows is about it                             */
    double peak, rms, lufs; /* of the sound in its quantity; lufs NAN: not needed, or too short or too quiet */
    int channels, encoding; /* of the file, enum encoding                                           */
    const char *unit;       /* of the sound's quantity; NULL: not stated, or a recording            */
    double gain;            /* file value per unit of the quantity                                  */
    double file_peak, file_rms, file_lufs, true_peak; /* of the WAV, re full scale                  */
    double beyond;     /* samples beyond full scale                                            */
    double ramp;       /* s, at the end                                                        */
    const char *audio; /* SHA-256 of the decoded samples                                       */
    struct record_file *files;
    int n_files;
    const char **warnings; /* ends with NULL                                                       */
    const char *render;    /* the JSON text of the render, or of the whole record; NULL: a recording */
};

/* DIR/NAME.json */
const char *record_path(const char *folder, const char *name, struct arena *a);

/* The path of a file of the stimulus from the set's folder; file: its name without folders. */
const char *record_file_path(const char *name, const char *file, bool raw, struct arena *a);

/* False: there is none, or it is not whole. */
bool record_read(const char *folder, const char *name, struct arena *a, struct record *r);

/* The text of a record without regard to its hash. */
bool record_parse(const char *text, size_t n, const char *name, struct arena *a, struct record *r);

/* As it stands in the file. */
const char *record_text(const struct record *r, struct arena *a);

/* Under its name when it is complete. ERR_CREATE, ERR_IO */
bool record_write(const char *folder, const char *name, const struct record *r, struct err *e);

#endif
