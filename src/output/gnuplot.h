/* A gnuplot that reads commands and data from us and writes its picture into a file of ours. */
#ifndef OUTPUT_GNUPLOT_H
#define OUTPUT_GNUPLOT_H
#include <stdio.h>
#include <sys/types.h>

#include "base/err.h"

struct gnuplot {
    FILE *in;         /* write commands and inline data here      */
    FILE *complaints; /* its stderr, an unnamed temporary file    */
    pid_t pid;
};

/* Starts it with its standard output going to the descriptor; no initialisation file is read. SIGPIPE must be ignored.
   ERR_UNBUILT: it is not installed. */
bool gnuplot_open(struct gnuplot *g, int output, struct err *e);

/* Ends its input and waits. ERR_IO with its first complaint when it failed. */
bool gnuplot_close(struct gnuplot *g, struct err *e);

/* 'text' as gnuplot reads it: single quotes doubled, nothing expanded; control characters are shown as '?'. */
void gnuplot_put_text(struct gnuplot *g, const char *text);

/* The terminal of a page of so many pixels, with the borders and tics of all pages. */
void gnuplot_page(struct gnuplot *g, bool svg, int width, int height);

/* set title 'text' (or another setting), nothing in it expanded. */
void gnuplot_put_setting(struct gnuplot *g, const char *setting, const char *text);

#endif
