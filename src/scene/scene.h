/* What is asked for: a scene as plain structs. Read this first.

   All quantities are SI (angles in radians). Every field a user can set is a row (key path, unit, range, default,
   meaning) of the file that reads it (scene/params.h) or, of knobs, of scene/accuracy.def. From these
   come the reader, the effective scene, `rasp explain`, `rasp new` and man rasp-scene(5).

   "Not given": a text is NULL, a number is NAN, a section's `given` is false. */
#ifndef SCENE_SCENE_H
#define SCENE_SCENE_H
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* ------------------------------------------------------------------ choices */

enum motion_path {
    PATH_BACK_AND_FORTH,
    PATH_LINE,
    PATH_FOUR_IN_LINE,
    PATH_CIRCLE,
    PATH_SCRIBBLE,
    PATH_POLYLINE,
    PATH_SPLINE,
    PATH_RECORDED,
    PATH_STILL,
    PATH_INCLINE
};
enum speed_law { SPEED_AUTO, SPEED_HARMONIC, SPEED_CONSTANT, SPEED_MINIMUM_JERK, SPEED_TWO_THIRDS, SPEED_GIVEN };
enum along { ALONG_AUTO, ALONG_PATH, ALONG_X, ALONG_PLANE };
enum contact_kind {
    CONTACT_SCRAPE,
    CONTACT_STRIKE,
    CONTACT_GIVEN,
    CONTACT_ROLL,
    CONTACT_ROLL_COUPLED,
    CONTACT_IMPACTS,
    CONTACT_PLAYBACK
};
enum impact_listing { LISTING_NONE, LISTING_TABLE };
enum table_format { TABLE_CSV, TABLE_NPY };
enum ball_body { BODY_SOLID, BODY_HOLLOW, BODY_HOOP, BODY_WHEEL };
enum engine { ENGINE_AUTO, ENGINE_RESONATORS, ENGINE_OVERLAP_ADD };
enum moving { MOVING_AUTO, MOVING_FIXED, MOVING_LAUNCH, MOVING_GLIDE, MOVING_READOUT };
enum object_shape {
    OBJECT_BAR,
    OBJECT_ROD,
    OBJECT_STRING,
    OBJECT_PLATE,
    OBJECT_DISK,
    OBJECT_MEMBRANE,
    OBJECT_DRUM,
    OBJECT_SHELL
};
enum object_edges { EDGES_FREE, EDGES_SUPPORTED, EDGES_CLAMPED, EDGES_CANTILEVER };
enum object_waves { WAVES_BENDING, WAVES_LONGITUDINAL };
enum material_name {
    MATERIAL_CUSTOM,
    MATERIAL_BASSWOOD,
    MATERIAL_POPLAR,
    MATERIAL_OAK,
    MATERIAL_PVC,
    MATERIAL_POLYCARBONATE,
    MATERIAL_ACRYLIC,
    MATERIAL_GLASS,
    MATERIAL_CERAMIC,
    MATERIAL_STEEL,
    MATERIAL_ALUMINIUM
};
enum quantity { QUANTITY_AUTO, QUANTITY_DISPLACEMENT, QUANTITY_VELOCITY, QUANTITY_ACCELERATION, QUANTITY_FORCE };
enum sound_envelope { ENVELOPE_NONE, ENVELOPE_APPROACH_RECEDE };
enum radiator { RADIATOR_CONTACT, RADIATOR_POINT, RADIATOR_MONOPOLE, RADIATOR_PLATE };
enum extrapolate { EXTRAPOLATE_ERROR, EXTRAPOLATE_NEAREST };
enum encoding {
    ENCODING_PCM16,
    ENCODING_PCM24,
    ENCODING_FLOAT32,
    ENCODING_FLOAT64,
    ENCODING_FLAC16, /* the samples of PCM16 */
    ENCODING_FLAC24
};

enum ablated_force { ABLATED_FORCE_VARYING, ABLATED_FORCE_CONSTANT };
enum ablated_nonlinearity { ABLATED_NONLINEARITY_FULL, ABLATED_NONLINEARITY_OMITTED, ABLATED_NONLINEARITY_SMOOTHED };
enum ablated_response { ABLATED_RESPONSE_BY_PLACE, ABLATED_RESPONSE_CONSTANT };
enum ablated_sound { ABLATED_SOUND_BOTH, ABLATED_SOUND_SURFACE, ABLATED_SOUND_SCRAPER, ABLATED_SOUND_BALL };

struct ring_choice;
struct file_cache;

/* ------------------------------------------------------------------ one contact */

struct material;
struct scene_material;

struct object_given { /* an object of simple shape, whose modes are closed forms: response/object.h */
    bool given;
    int shape, edges, waves;      /* enum object_shape, object_edges, object_waves                     */
    int material;                 /* enum material_name: what the figures below are where they are NAN */
    const struct material *own;   /* one of the scene's own materials, in place of that; NULL: none   */
    double length, width;         /* m, along x and y                                                  */
    double thickness;             /* m; of a rod its wall's, NAN: solid                                */
    double diameter;              /* m                                                                 */
    double tension;               /* N, of a string                                                    */
    double surface_tension;       /* N/m, of a membrane or drum                                        */
    double youngs_modulus;        /* Pa, along x                                                       */
    double youngs_modulus_across; /* Pa, along y                                                 */
    double shear_modulus;         /* Pa, in the plane                                                  */
    double poisson;
    double density;   /* kg/m^3                                                            */
    double alpha;     /* 1/s, Rayleigh's: C = alpha M + beta K                             */
    double beta;      /* s                                                                 */
    double loss;      /* loss factor eta                                                   */
    double origin[2]; /* m: where the object's x = y = 0 lies in the scene (surface)       */
    double at[2];     /* m, in the object's coordinates: where it is touched (scraper)     */
};

struct space { /* an object between materials and shapes: response/space.h          */
    bool given;
    double from[2], to[2];          /* places in the disk of materials; to NAN: as from                  */
    double dimension, dimension_to; /* 1 bar, 2 plate, 3 shell                                   */
    double fundamental;             /* Hz                                                                */
    double gain;                    /* m/s per N s, of the lowest mode                                   */
};

struct response {     /* how a body rings: a table of modes, recorded responses, an object, or a place in the space of
                         materials */
    const char *file; /* path, already resolved against the scene file; NULL: none         */
    struct object_given object;
    struct space space;               /* surface only                                                      */
    int modes;                        /* how many of the strongest modes are used                          */
    double band[2];                   /* Hz, from which they are chosen                                    */
    int gammatone;                    /* gamma: onset of each mode t^(gamma - 1); 1: at once                */
    double length;                    /* s, t0 of eq. 10: the response is cut there; NAN: not cut          */
    int convolution;                  /* enum engine                                                       */
    int moving;                       /* enum moving                                                       */
    double pairing;                   /* largest relative difference of frequencies of one mode at two places */
    int extrapolate;                  /* enum extrapolate: contact outside the places' hull                */
    const struct ring_choice *choice; /* the planner's: convolution/ring_choice.h; NULL before   */
};

struct surface {
    const char *recipe; /* YAML of surface keys, already merged under the scene's own        */
    int along;          /* enum along                                                        */
    double origin[2];   /* m: where the surface's own x = y = 0 lies in the scene              */
    double finest;      /* m, no key: its finest scale, where it has been read; 0: it is not known */
    struct response response;
};

struct scraper {   /* what touches the surface; of rolling models the ball, as trajectory/contact.h has settled it */
    double mass;   /* kg, m_p of eq. 1                                                  */
    double weight; /* eta: share of its response in the total                           */
    double radius; /* m of the tip; NAN: a point                                        */
    double patch;  /* m, standard deviation of the Gaussian over the contact patch of a round tip */
    struct response response;
};

struct ball {           /* what rolls: trajectory/contact.h                                          */
    double radius;      /* m, R                                                              */
    double mass;        /* kg; NAN: from body, radius and material                           */
    int body;           /* enum ball_body                                                    */
    double wall;        /* m, of what is hollow; NAN: thin                                   */
    double offset;      /* m, r: of the centre of mass from the geometric centre             */
    double start_angle; /* rad, theta at the start; 0: the centre of mass is lowest          */
    double lobe_height; /* m, amplitude of the out-of-roundness                              */
    int lobes;          /* how often round the ball                                          */
    double patch;       /* m, standard deviation of the Gaussian over the contact patch; 0: none */
    double weight;      /* share of its response in the total                                */
    bool point;         /* no key: it follows the ground itself, as a point does (force/roll.c)      */
    struct response response;
};

struct trajectory;

struct motion {
    int path;              /* enum motion_path                                                  */
    double at[2];          /* m, of still                                                       */
    double from[2], to[2]; /* m                                                                 */
    int strokes;           /* four_in_line                                                      */
    double center[2];      /* m, of a circle or scribble                                        */
    double radius;         /* m, of a circle                                                    */
    double start_angle;    /* rad, where on the circle                                          */
    double turns;          /* times round; negative: clockwise                                  */
    double size[2];        /* m, width and height of the box of a scribble                      */
    const double *points;  /* m, [n_points][2], of a polyline or spline                         */
    int n_points;
    double corner;           /* m, radius to which a polyline's corners are rounded               */
    const char *file;        /* recorded: CSV of time_s, x_m, y_m                                 */
    double cutoff;           /* Hz, of the recording's smoothing; 0: none                         */
    double rate;             /* Hz: back_and_forth, full cycles; scribble, loops                  */
    double speed;            /* m/s, mean; NAN: duration is given                                 */
    double duration;         /* s; NAN: speed is given, or a file gives it                        */
    double until;            /* s: the motion breaks off there; else (NAN, 0) it goes on to the end*/
    int law;                 /* enum speed_law                                                    */
    const char *profile;     /* law given: CSV of time_s, speed_m_per_s                           */
    double incline;          /* rad, slope of the path incline: above 0, to lies higher than from  */
    double start_speed;      /* m/s, of the path incline                                          */
    double rolling_friction; /* retarding force over normal force, of the path incline           */
    double gravity,
        inertia;     /* of the path incline, from the contact: m/s^2, g; I / (m R^2) of what moves (ball_apply) */
    double straight; /* m, radius of curvature from which on two_thirds counts a path as straight */
    const struct trajectory *made; /* no key: what trajectory_make makes of it, where that is known; NULL: it is not */
};

struct grip { /* N(t) from the hand: eq. 8 and 9 generalised                       */
    bool given;
    double angle;    /* rad, theta: the tool above the horizontal                         */
    double azimuth;  /* rad, horizontal direction from the torso outwards, 0 = +x         */
    double friction; /* mu                                                                */
};

struct load {
    double constant;          /* N; NAN: the scraper's weight m g                                  */
    const char *recorded;     /* CSV of time_s, normal_force_n; NULL: none                         */
    double approach, release; /* s over which contact is made and given up; NAN: auto            */
    int phase;                /* enum load_phase, of a ball off its centre                         */
    bool falls;    /* no keys: a ball is dropped, and comes down by itself (convolution/roll_coupled.c);            */
    bool no_lobes; /* what its lobes press is not in N(t) (force/roll.c) */
};

struct contact_model {
    int model;      /* enum contact_kind */
    double gravity; /* m/s^2             */
};

struct ablation { /* what is left out: trajectory/contact.h                                */
    bool given;
    int normal_force; /* enum ablated_force                                                */
    int nonlinearity; /* enum ablated_nonlinearity                                         */
    int response;     /* enum ablated_response                                             */
    double place[2];  /* m, of the response that is constant; NAN: where the motion starts  */
    int sound;        /* enum ablated_sound                                                */
};

struct contact {
    const char *name;
    double start; /* s after the scene's start                                         */
    double gain;  /* factor on this contact's sound                                    */
    struct surface surface;
    struct scraper scraper;
    struct ball ball;
    struct motion motion;
    struct grip grip;
    struct load load;
    struct contact_model contact;
    struct ablation ablation;
    const void *params; /* of the effects that have a file of their own: scene/params.h            */
};

/* ------------------------------------------------------------------ the scene */

struct level {              /* at most one is given; none: peak -3 dBFS                          */
    double full_scale;      /* the output quantity's unit that becomes 1.0                       */
    double peak, rms, lufs; /* dB relative to full scale                                         */
    double dbfs_at_1_pa;    /* dB: level in the file of 1 Pa, of a sound in pascals              */
    bool later;             /* not a key: full_scale is 1 until that of the set is known (batch)  */
};

struct diagnostics {
    bool given;
    double rate;          /* Hz                                                                */
    int format;           /* enum table_format                                                 */
    const char **columns; /* NULL-terminated; NULL: all that the scene has                     */
};

struct listen { /* where the sound is heard: response/listener.h                     */
    bool given;
    int radiator;         /* enum radiator                                                     */
    const double *places; /* m, [n_places][3], in the scene's coordinates, z above the surface */
    int n_places;         /* channels                                                          */
    double density;       /* kg/m^3, of air                                                    */
    double sound_speed;   /* m/s                                                               */
};

struct output {
    double sample_rate; /* Hz, a whole number                                                */
    int encoding;       /* enum encoding                                                     */
    int channels;       /* the same sound on each                                            */
    int quantity;       /* enum quantity                                                     */
    struct listen listen;
    const char **stems; /* NULL-terminated words: force, surface, scraper, ball; NULL: none  */
    struct level level;
    double ramp;           /* s, raised-cosine on and off                                       */
    int envelope;          /* enum sound_envelope                                                */
    double envelope_depth; /* dB, how far the ends lie below the middle                         */
    double tail;           /* s; NAN: auto, until the sound has decayed by 80 dB                */
    double duration; /* s, exact length of the file, whatever motion and tail would take; NAN: as long as they take */
    struct diagnostics diagnostics;
    int impacts; /* enum impact_listing: is the series of impacts written             */
};

struct accuracy {       /* one double per row of accuracy.def                                */
    const char *preset; /* draft, standard, high, reference: where the knobs start           */
    double
        error; /* dB relative to the sound, rms: the knobs not set by the user follow from it (pipeline/error_budget.h);
                     NAN: not asked for */
    unsigned by_user; /* set of knobs that the scene gives one by one                      */
#define KNOB(name, lo, hi, whole, scale, order, draft, standard, high, reference, meaning) double name;
#include "scene/accuracy.def"
#undef KNOB
};

enum knob { /* the rows of accuracy.def, as of keys_knobs; a set of them: stage.h */
#define KNOB(name, lo, hi, whole, scale, order, draft, standard, high, reference, meaning) KNOB_##name,
#include "scene/accuracy.def"
#undef KNOB
            KNOBS
};

struct input { /* a file the scene names; sha256 NULL: not pinned                   */
    const char *file, *sha256;
};

struct scene_place {         /* where a key that is given stands: scene/scene_places.h            */
    const char *contact;     /* its name; NULL: the key is the scene's own                        */
    const char *key;         /* "surface.response"                                                */
    const char *label;       /* as messages call it: "contacts.rod.surface.response"              */
    const char *value;       /* of a key that names a file: its path, as messages show it; else NULL */
    const char *file;        /* "scene.yaml", or "--set surface.response" with line 0             */
    const char *named;       /* " (named at scene.yaml:4:12)" of a file that the scene names; ""  */
    int line, column, width; /* of the value; of a section, of its name                          */
    struct scene_place *next;
};

struct scene {
    const char *file;     /* where it was read from                                            */
    const char **sources; /* every text file that was read for it, itself first; ends with NULL */
    int version;
    const char *written_by; /* of an effective scene: "rasp 0.2.0"; NULL: by hand                       */
    const char *title;
    uint64_t seed;
    struct contact *contacts;
    int n_contacts;
    struct output output;
    struct accuracy accuracy;
    const struct scene_material *materials; /* its own (scene/scene_materials.h)                   */
    int n_materials;
    struct input *inputs; /* pinned hashes of an effective scene                               */
    int n_inputs;
    bool inputs_known; /* they are as these hashes say, whatever the files hold by now          */
    struct scene_place *places;
    const struct diag *diag;       /* what is wrong with its text; NULL: nothing is                    */
    struct file_cache *file_cache; /* what scenes read of the same files (base/file_cache.h); NULL: nothing is shared */
};

#endif
