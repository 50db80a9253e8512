/* Quantities with units, exact to the last bit.

   A quantity is a decimal number, optional spaces, and a unit of the key's dimension; a bare number is SI. Powers of
   ten move the number's decimal exponent before the one rounding to double, so that 20 g is the double nearest to 0.02;
   degrees are multiplied by pi/180, minutes by 60 and hours by 3600, in 64-bit-mantissa arithmetic, and rounded once.
   Prefixes n, u (both code points of micro), m, k, M, G with m, s, Hz, g, N, Pa, rad and what is made of them, c with
   metres; numbers per area are per m^2, cm^2, mm^2 or um^2, rates are per second: 12 1/s or 12 /s. */
#ifndef SCENE_UNITS_H
#define SCENE_UNITS_H
#include <stdbool.h>

#include "base/arena.h"
#include "scene/keys.h"

struct units_fault {
    const char *text; /* follows the key's name: "needs a length; g is a unit of mass" */
    const char *cure;
};

/* *x in SI. False: the fault says why. */
bool units_read(const char *text, enum key_dimension d, double *x, struct arena *a, struct units_fault *fault);

/* "a frequency"; "2 Hz". */
const char *units_name(enum key_dimension d);
const char *units_example(enum key_dimension d);

/* "frequency (a bare number is in Hz)"; "Hz". */
const char *units_type(enum key_dimension d, struct arena *a);
const char *units_si(enum key_dimension d);

/* A value as a person would write it, such as 20 g, 1 nm or 50 us; reads back as the same double. */
const char *units_text(double x, enum key_dimension d, struct arena *a);

struct units_unit {
    const char *name;
    enum key_dimension dimension;
    int power; /* of ten, to SI */
    const char *prefixes;
};

/* The unit of that name, with a prefix or without, and the power of ten to SI; NULL: there is none. */
const struct units_unit *units_find(const char *text, int *power);

/* What may follow a number of the dimension, as a regular expression: "[numckMG]?m"; "": nothing. */
const char *units_pattern(enum key_dimension d, struct arena *a);

#endif
