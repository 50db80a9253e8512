/* Numbers as text, as printf's %.9g writes them, many times faster. */
#ifndef NUM_DECIMAL_H
#define NUM_DECIMAL_H
#include <stddef.h>

enum { DECIMAL_ROOM = 24 };

/* The characters that printf("%.9g") writes in the C locale, to the last digit; "nan" has no sign. Returns how many; no
 * NUL follows them. */
size_t decimal_9g(double x, char text[DECIMAL_ROOM]);

#endif
