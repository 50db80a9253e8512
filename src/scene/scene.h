/* What is asked for: a scene as plain structs. Read this first.

   All quantities are SI (angles in radians). Every field a user can set is a row of scene/keys.def (key path, unit, range,
   default, meaning) or, where time is traded for accuracy, of scene/accuracy.def; from those two tables come the reader, the
   effective scene, `rasp explain`, `rasp new` and man rasp-scene(5).

   "Not given": a text is NULL, a number is NAN, a section's `given` is false. */
#ifndef SCENE_SCENE_H
#define SCENE_SCENE_H
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* ------------------------------------------------------------------ choices: same order as the words in keys.def */

enum motion_path { PATH_BACK_AND_FORTH, PATH_LINE };
enum speed_law { SPEED_CONSTANT, SPEED_MINIMUM_JERK };
enum along { ALONG_PATH, ALONG_X };
enum off_map { OFF_MAP_MIRROR, OFF_MAP_WRAP, OFF_MAP_ERROR };
enum contact_kind { CONTACT_SCRAPE };
enum force_kind { FORCE_DIRECTIONAL, FORCE_PAPER };
enum limiter_curve { LIMITER_TANH, LIMITER_NONE };
enum engine { ENGINE_AUTO, ENGINE_RESONATORS, ENGINE_OVERLAP_ADD };
enum extrapolate { EXTRAPOLATE_ERROR, EXTRAPOLATE_NEAREST };
enum encoding { ENCODING_PCM16, ENCODING_PCM24, ENCODING_FLOAT32, ENCODING_FLOAT64 };

/* ------------------------------------------------------------------ one contact */

struct roughness {          /* a procedural profile: surface/roughness.h                         */
    bool given;
    double exponent;        /* power spectral density over spatial frequency ~ k^exponent        */
    double rms;             /* m, of the heights                                                 */
    double longest;         /* m, wavelength above which the spectrum is flat (roll-off)         */
    double shortest;        /* m, wavelength below which it is zero                              */
};

struct response {           /* how a body rings: a mode table (CSV) or an impulse response (WAV) */
    const char *file;       /* path, already resolved against the scene file; NULL: it is silent */
    int modes;              /* how many of the strongest modes are used                          */
    double length;          /* s, t0 of eq. 10: the response is cut there; NAN: not cut          */
    int convolution;        /* enum engine                                                       */
    int extrapolate;        /* enum extrapolate: contact outside the places' hull                */
};

struct surface {
    const char *height_map; /* NPY or GSF, resolved path; NULL: none                             */
    double pitch;           /* m between samples; NAN: the file says it                          */
    double height_scale;    /* m per stored unit                                                 */
    int along;              /* enum along                                                        */
    int off_map;            /* enum off_map                                                      */
    double origin[2];       /* m: where the map's first sample lies in scene coordinates         */
    struct roughness roughness;
    struct response response;
};

struct scraper {
    double mass;            /* kg, m_p of eq. 1                                                  */
    double weight;          /* eta: share of its response in the total                           */
    struct response response;
};

struct motion {
    int path;               /* enum motion_path                                                  */
    double from[2], to[2];  /* m                                                                 */
    double rate;            /* Hz, full back-and-forth cycles                                    */
    double speed;           /* m/s along a line; NAN: duration is given                          */
    double duration;        /* s; NAN: speed is given                                            */
    int law;                /* enum speed_law                                                    */
};

struct grip {               /* N(t) from the hand: eq. 8 and 9 generalised                       */
    bool given;
    double angle;           /* rad, theta: the tool above the horizontal                         */
    double azimuth;         /* rad, horizontal direction from the torso outwards, 0 = +x         */
    double friction;        /* mu                                                                */
};

struct load {
    double constant;        /* N; NAN: the scraper's weight m g                                  */
};

struct limiter {            /* eq. 4 to 7                                                        */
    int curve;              /* enum limiter_curve                                                */
    double alpha;           /* m, for a constant load                                            */
    double alpha_min, alpha_max; /* m                                                            */
    double zeta;
    double force_range[2];  /* N, N_min and N_max of eq. 7; NAN: the scene's own                 */
};

struct contact_model {
    int model;              /* enum contact_kind                                                 */
    int force;              /* enum force_kind                                                   */
    double beta1, beta2;    /* eq. 3                                                             */
    double leak;            /* m: l of dS'/ds + S'/l = T(c)                                      */
    double smoothing;       /* s: sigma at alpha = 0.03 m; 0: none                               */
    double gravity;         /* m/s^2                                                             */
    struct limiter limiter;
};

struct contact {
    const char *name;
    double start;           /* s after the scene's start                                         */
    double gain;            /* factor on this contact's sound                                    */
    struct surface surface;
    struct scraper scraper;
    struct motion motion;
    struct grip grip;
    struct load load;
    struct contact_model contact;
};

/* ------------------------------------------------------------------ the scene */

struct level {              /* at most one is given; none: peak -3 dBFS                          */
    double full_scale;      /* the output quantity's unit that becomes 1.0                       */
    double peak, rms, lufs; /* dB relative to full scale                                         */
};

struct diagnostics {
    bool given;
    double rate;            /* Hz                                                                */
    const char **columns;   /* NULL-terminated; NULL: all that the scene has                     */
};

struct output {
    double sample_rate;     /* Hz, a whole number                                                */
    int encoding;           /* enum encoding                                                     */
    int channels;           /* the same sound on each                                            */
    struct level level;
    double ramp;            /* s, raised-cosine on and off                                       */
    double tail;            /* s; NAN: auto, until the sound has decayed by 80 dB                */
    struct diagnostics diagnostics;
};

struct accuracy {           /* one double per row of accuracy.def                                */
    const char *preset;     /* draft, standard, high, reference: where the knobs start           */
#define KNOB(name, lo, hi, whole, draft, standard, high, reference, meaning) double name;
#include "scene/accuracy.def"
#undef KNOB
};

struct input {              /* a file the scene names; sha256 NULL: not pinned                   */
    const char *file, *sha256;
};

struct scene {
    const char *file;       /* where it was read from                                            */
    int version;
    const char *title;
    uint64_t seed;
    struct contact *contacts;
    int n_contacts;
    struct output output;
    struct accuracy accuracy;
    struct input *inputs;   /* pinned hashes of an effective scene                               */
    int n_inputs;
};

#endif
