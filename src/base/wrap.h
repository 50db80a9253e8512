/* Plain text in lines of at most 100 columns, for help and generated comments. */
#ifndef BASE_WRAP_H
#define BASE_WRAP_H
#include <stdio.h>

/* Prints text and ends the line. The first line begins at `column` (what has been printed before it); further lines
   begin with `margin`. A newline in the text begins a new line. Words are never cut. */
void wrap_print(FILE *f, const char *text, int column, const char *margin);

#endif
