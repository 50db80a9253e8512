/* What `rasp plot` shows, and its parts: which panels there are, gathering the data, drawing the page. */
#ifndef CMD_PLOT_H
#define CMD_PLOT_H
#include "base/arena.h"
#include "base/err.h"
#include "cmd/cmd.h"
#include "output/gnuplot.h"
#include "output/spectrogram.h"
#include "scene/scene.h"
#include <stdbool.h>

enum { PLOT_COLUMNS = 1000 }; /* columns of pixels that a panel has, about */

enum plot_panel {
    PLOT_WAVEFORM,
    PLOT_SPECTROGRAM,
    PLOT_FORCE,
    PLOT_HAND,
    PLOT_FOLLOWED,
    PLOT_MOTION,
    PLOT_MODES,
    PLOT_DECAYS,
    PLOT_PANELS
};

enum plot_column { PLOT_PEAK, PLOT_RMS, PLOT_NORMAL, PLOT_ALPHA, PLOT_GROUND, PLOT_TRAJECTORY, PLOT_TABLE_COLUMNS };

struct plot_sound {
    int n;
    double *least, *most; /* [n], samples of a column of pixels, full scale 1     */
    double peak, rms;     /* of the time shown                                    */
    struct spectrogram spectrogram;
    double rate; /* Hz                                                   */
};

struct plot_table {   /* diagnostics of one contact                           */
    const char *name; /* of the contact; "": the only one                     */
    int n;
    double *time;                  /* [n] s, mean of the rows in a column of pixels        */
    double *x[PLOT_TABLE_COLUMNS]; /* [n]; NULL: the table has no such column              */
    double most[PLOT_TABLE_COLUMNS];
};

struct plot_path {    /* of a contact, seen from above                        */
    const char *name; /* of the contact; "": the only one                     */
    int n;
    double (*at)[3]; /* [n] x, y (m), speed (m/s)                            */
};

struct plot_mode {
    double frequency, decay, gain; /* Hz, 1/s, largest where it is touched                 */
};

struct plot_body {    /* what rings                                           */
    const char *name; /* "surface", "ball of contact 2"                       */
    int n;
    struct plot_mode *modes;
};

struct plot_ground {        /* of a contact's surface, seen from above              */
    bool box, round;        /* an object has edges: of low, high; a circle within   */
    double low[2], high[2]; /* m                                                    */
    int n;
    double (*places)[2]; /* [n] m, of the mode table                             */
};

struct plot_page {
    const char *file, *title;
    double from, to; /* s; NAN: as long as the data                          */
    bool svg;
    unsigned asked;           /* bits of panels; 0: all that there are data for       */
    int channel;              /* of the sound, from 1                                 */
    int channels;             /* that it has; 0: no sound                             */
    struct plot_sound *sound; /* NULL: a render without sound                         */
    struct plot_table *tables;
    int n_tables;
    struct plot_path *ways; /* of contacts that move                                */
    int n_ways;
    struct plot_body *bodies;
    int n_bodies;
    bool table_of_modes; /* the file is one                                      */
    struct plot_ground *grounds;
    int n_grounds;
    struct arena *arena;
    struct cmd_call *call; /* for warnings                                         */
};

/* What the summary of a render beside a file says. */
struct plot_summary {
    const char *file;
    const char *title;     /* the scene's; "": none                                  */
    const char **contacts; /* [n_contacts] names                                     */
    int n_contacts;
    bool there;             /* false: there is no summary                             */
    bool lists;             /* false: it does not say what was written                */
    bool sounds;            /* it lists a WAV                                         */
    const char *effective;  /* sha256 of the effective scene; "": not listed          */
    const char **tables[2]; /* [n_tables] contact and sha256 of every table it lists  */
    int n_tables;
};

/* A file that is not there, or is no JSON, gives an empty one. */
struct plot_summary plot_summary_read(const char *file, struct arena *a);

/* Reads the sound or the table p->file and what lies beside it; sets from, to, and the title where they are not given.
   ERR_INPUT, ERR_SCENE, ERR_USAGE (a time outside; a panel that is asked for and has no data). */
bool plot_data(struct plot_page *p, struct err *e);

/* Does some table have the column? */
bool plot_data_has(const struct plot_page *p, enum plot_column column);

/* The panels. */
extern const char *const plot_panels_words[PLOT_PANELS];
bool plot_panels_read(const char *words, unsigned *asked, struct arena *a, struct err *e);
bool plot_panels_there(const struct plot_page *p, int panel); /* asked for, if anything is, and with data */

/* plot_draw.c: writes the whole page to gnuplot. One panel whose box is [left, right] x [bottom, top] in shares of a
   page of `size` pixels. */
struct plot_place {
    double left, right, bottom, top;
    double size[2];
};
void plot_draw(void *page, struct gnuplot *g);

/* plot_gallery.c: rasp plot --gallery, a page of HTML for a folder or manifest. */
int plot_gallery_run(struct cmd_call *c, struct err *e);

/* plot_gallery_page.c: what of that page is the same for all. The script comes in parts and ends with NULL. */
extern const char plot_gallery_page_style[], plot_gallery_page_bar[], *const plot_gallery_page_script[];

#endif
