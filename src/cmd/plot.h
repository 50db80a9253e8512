/* What `rasp plot` shows, and its two halves: gathering the data, drawing the page. */
#ifndef CMD_PLOT_H
#define CMD_PLOT_H
#include "base/arena.h"
#include "base/err.h"
#include "output/gnuplot.h"
#include "output/spectrogram.h"

enum { PLOT_COLUMNS = 1000 }; /* columns of pixels that a panel has, about */

enum plot_column { PLOT_PEAK, PLOT_RMS, PLOT_NORMAL, PLOT_ALPHA, PLOT_TABLE_COLUMNS };

struct plot_sound {
    int n;
    double *least, *most;             /* [n], samples of a column of pixels, full scale 1     */
    double peak, rms;                 /* of the time shown                                    */
    struct spectrogram spectrogram;
    double rate;                      /* Hz                                                   */
};

struct plot_table {                   /* diagnostics of one contact                           */
    const char *name;                 /* of the contact; "": the only one                     */
    int n;
    double *time;                     /* [n] s, mean of the rows in a column of pixels        */
    double *x[PLOT_TABLE_COLUMNS];    /* [n]; NULL: the table has no such column              */
    double most[PLOT_TABLE_COLUMNS];
};

struct plot_page {
    const char *file, *title;
    double from, to;                  /* s; NAN: as long as the data                          */
    bool svg;
    int channel;                      /* of the sound, from 1                                 */
    int channels;                     /* that it has; 0: no sound                             */
    struct plot_sound *sound;         /* NULL: a render without sound                         */
    struct plot_table *tables;
    int n_tables;
    struct arena *arena;
};

/* Reads the sound or the table p->file and what lies beside it; sets from, to, and the title where they are not given. ERR_INPUT,
   ERR_SCENE, ERR_USAGE (a time outside). */
bool plot_data(struct plot_page *p, struct err *e);

/* Does some table have the column? */
bool plot_data_has(const struct plot_page *p, enum plot_column column);

/* Writes the whole page to gnuplot. */
void plot_draw(const struct plot_page *p, struct gnuplot *g);

/* What the page shows, as a line. */
void plot_draw_list(const struct plot_page *p, FILE *f);

#endif
