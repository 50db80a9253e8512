/* A gnuplot that reads commands and data from us and writes its picture into a file of ours. */
#ifndef OUTPUT_GNUPLOT_H
#define OUTPUT_GNUPLOT_H
#include <stdio.h>
#include <sys/types.h>

#include "base/err.h"

struct outfile;

struct gnuplot {
    FILE *in;         /* write commands and inline data here      */
    FILE *complaints; /* its stderr, an unnamed temporary file    */
    pid_t pid;
};

/* A picture, under a name that appears only when it is whole: `draw` writes all commands, with a terminal that is svg
   or pngcairo. SIGPIPE must be ignored. ERR_UNBUILT: gnuplot is not installed; ERR_CREATE, ERR_IO. */
bool gnuplot_write(const char *target, bool svg, void (*draw)(void *self, struct gnuplot *g), void *self,
                   struct err *e);

/* The same, but without its name yet: o is to be committed, or dropped. Failed: nothing is open. */
bool gnuplot_draw(struct outfile *o, const char *target, bool svg, void (*draw)(void *self, struct gnuplot *g),
                  void *self, struct err *e);

/* 'text' as gnuplot reads it: single quotes doubled, nothing expanded; control characters are shown as '?'. */
void gnuplot_put_text(struct gnuplot *g, const char *text);

/* The terminal of a page of so many pixels, with the borders and tics of all pages. */
void gnuplot_page(struct gnuplot *g, bool svg, int width, int height);

/* set title 'text' (or another setting), nothing in it expanded. */
void gnuplot_put_setting(struct gnuplot *g, const char *setting, const char *text);

#endif
