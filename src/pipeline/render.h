/* A scene into its files. */
#ifndef PIPELINE_RENDER_H
#define PIPELINE_RENDER_H
#include "base/arena.h"
#include "base/err.h"
#include "output/sound.h"
#include "pipeline/promise.h"
#include "pipeline/render_parts.h"
#include "pipeline/run.h"

struct render_file {
    const char *kind, *path; /* "wav", "csv", "npy", "impacts", "scene", "summary", "stem" */
    const char *contact;     /* of a table or a series of impacts; NULL: of the whole */
    const char *stem;        /* of a stem, which; else NULL      */
    const char *sha256;      /* NULL: not known                  */
    const struct wav_written *written; /* of a WAV; else NULL     */
};

struct render_report {
    long frames;
    struct render_length length;
    double seconds, cpu;           /* wall clock and CPU time of the whole render */
    struct sound_report sound;
    bool sounds;                   /* there is a WAV */
    int quantity;                  /* enum modes_quantity of the sound; -1: not stated */
    struct render_file *files;
    int n_files;
    const char **older;            /* files of an earlier render that stay; ends with NULL */
    const char *summary;           /* the JSON text */
    struct promise promise;        /* of the accuracy that was asked for */
    struct accuracy accuracy;      /* the knobs that it was rendered with */
    const char **warnings;
    int n_warnings;
    const char **notes;            /* what contacts did, one line each */
    int n_notes;
};

/* Renders to BASE.wav (if anything sounds), BASE.force.wav and so on (stems), BASE.csv or BASE.CONTACT.csv (diagnostics; .npy), BASE.impacts.csv
   or BASE.CONTACT.impacts.csv (series of impacts), BASE.scene.yaml (the effective scene) and BASE.json
   (the summary). Nothing has a name before everything is complete. */
bool render_scene(const struct scene *s, const char *base, struct arena *a, struct render_report *report, struct err *e);

#endif
