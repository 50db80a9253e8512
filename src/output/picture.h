/* A picture by gnuplot, under a name that appears only when it is whole. */
#ifndef OUTPUT_PICTURE_H
#define OUTPUT_PICTURE_H
#include "output/gnuplot.h"

struct outfile;

/* As picture_write, but without its name yet: o is to be committed, or dropped. Failed: nothing is open. */
bool picture_draw(struct outfile *o, const char *target, bool svg, void (*draw)(void *self, struct gnuplot *g),
                  void *self, struct err *e);

/* `draw` writes all commands, with a terminal that is svg or pngcairo. ERR_UNBUILT, ERR_CREATE, ERR_IO. */
bool picture_write(const char *target, bool svg, void (*draw)(void *self, struct gnuplot *g), void *self,
                   struct err *e);

#endif
