/* rasp accuracy: a sweep of renders, what each costs and how wrong it is. accuracy.c reads the command line, chooses
   an excerpt and knobs, lists what is rendered, and finds orders, the error of the reference and the front;
   accuracy_child.c renders and compares; accuracy_report.c prints, writes and draws. */
#ifndef CMD_ACCURACY_H
#define CMD_ACCURACY_H
#include "cmd/cmd.h"
#include "output/gnuplot.h"

/* How far a render is from the reference's. Of a sound that diverges (struct accuracy_sweep) all but the SNR and
 * `follows` are of what comes after. */
struct accuracy_error {
    double snr;             /* dB, of samples; INFINITY: the same */
    double third, third_hz; /* dB, worst difference of third octaves within 60 dB of the loudest, and where */
    double spectral;        /* dB, spectral_distance_sounds */
    double level;           /* dB, of this over the reference */
    double follows;         /* s, distance_agreement */
    double length;          /* s, of the sound */
};

struct accuracy_render { /* one setting of all knobs */
    struct accuracy set;
    bool timed; /* its cost is asked for, too */
    int ahead;  /* renders to come */
    bool tried;
    int code;          /* exit code; not 0: there is no error and no cost */
    const char *words; /* what it said then, the first line */
    struct accuracy_error error;
    double *runs; /* s of CPU time, [n_runs] */
    int n_runs;
    double cpu[3], covers; /* s: median, and before and after it an interval that covers it with that probability */
    double peak;           /* bytes, greatest */
    double gain;           /* file over sound: errors are of sounds, whatever level the scene sets */
    double contact_share;  /* of what rolls; NAN */
    bool front;
};

struct accuracy_row {  /* one line of the table */
    int knob;          /* -1: an asked error, a preset, or the scene as it is */
    const char *name;  /* "asked", "preset", "scene", or the knob's  */
    const char *value; /* "-60", "draft", "16"; ""          */
    struct accuracy set;
    double predicted, choosing; /* dB; s of CPU time; NAN: nothing was chosen */
    const char *refused;        /* why it cannot be had; NULL: it can */
    double fine;                /* of a knob: log2 of its value, its sign so that finer is more */
    int total, alone;           /* in renders: all others as the scene has them, or at reference; alone -1: none */
    bool chosen;                /* the value that the scene has      */
    double order;               /* from the row before; NAN          */
};

enum { ACCURACY_VALUES = 32 }; /* most that may be given of a knob, and errors */

struct accuracy_sweep {
    struct cmd_call *call;
    const char *file;          /* the scene's */
    struct scene asked, scene; /* as it was read, and with its knobs chosen */
    bool force;                /* nothing rings: the contact force is compared */
    unsigned knobs;            /* set of those that turn the scene   */
    double errors[ACCURACY_VALUES];
    int n_errors;
    bool single;                     /* single knobs, too                   */
    double excerpt, whole, estimate; /* s of each motion, NAN: all of it; of the longest one; of all the work */
    int runs;
    const char *folder; /* for the renders, temporary         */
    struct accuracy_render *renders;
    int n_renders, reference, near; /* in renders                  */
    struct accuracy_row *rows;
    int n_rows;
    const char *csv, *plot; /* files; NULL: not asked for         */
    bool json;
    double rate, length; /* Hz, s of the reference's sound     */
    int channels;
    double until;  /* s; INFINITY: the sound does not diverge */
    double own_db; /* dB that the reference's own error lies below the sound, at least; INFINITY: nothing is known */
};

/* No contact is heard: its force is compared, as output.quantity: force plays it. */
bool accuracy_silent(const struct scene *s);

/* --values KNOB=a,b,c: [KNOBS] lists. */
struct accuracy_values {
    double *x;
    int n;
};

/* Chooses knobs and lists rows and renders; equal settings are rendered once. */
bool accuracy_rows(struct accuracy_sweep *s, const struct accuracy_values *own, struct err *e);

/* Makes every knob of a reference at least twice as fine as one's own that is used, as far as its range goes. */
void accuracy_finer(struct accuracy *reference, const struct accuracy *own, unsigned used);

/* "oversampling 16", for messages: what a render is, by its first row. */
const char *accuracy_rows_name(const struct accuracy_sweep *s, int render);

/* Renders one setting into s->folder (accuracy_child_sound) and notes code, words, cpu, peak, contact_share. False:
   interrupted, or a failure that is not the setting's own. */
bool accuracy_child(struct accuracy_sweep *s, int render, struct err *e);
bool accuracy_child_folder(struct accuracy_sweep *s, struct err *e);
void accuracy_child_end(const struct accuracy_sweep *s); /* the folder and what is in it */

/* Takes the sound that was just rendered as the reference, or as its neighbour, whose divergence is
   everyone's; else compares. */
bool accuracy_child_compare(struct accuracy_sweep *s, int render, struct err *e);

/* The same of two sounds: until (s): from when on they are compared by their statistics, INFINITY: never. Their gains
 * are taken out already. */
struct wav;
struct accuracy_error accuracy_child_distance(const struct wav *a, const struct wav *b, double until);

void accuracy_judge(struct accuracy_sweep *s);

/* The figure that stands for a render's error: SNR, or, of what diverges, the log-spectral distance, so that less is
 * better; NAN: none. */
double accuracy_judge_error(const struct accuracy_sweep *s, const struct accuracy_render *r);

/* Is it an error so small that the reference is no judge of it? */
bool accuracy_judge_below(const struct accuracy_sweep *s, const struct accuracy_render *r);

void accuracy_report_table(const struct accuracy_sweep *s, FILE *f);
bool accuracy_report(const struct accuracy_sweep *s, struct err *e); /* prints the table */
void accuracy_report_plot(void *sweep, struct gnuplot *g);

/* Where a logarithmic axis from low to high > 2.25 low has its labels, rising: at powers of ten; where that is not
 * three of them, at 2 and 5 as well, or more. */
enum { ACCURACY_REPORT_TICS = 64 };
int accuracy_report_tics(double low, double high, double tics[ACCURACY_REPORT_TICS]);

#endif
