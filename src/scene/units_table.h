/* Dimensions and their units, with prefixes: what units.c reads and units_text.c writes. */
#ifndef SCENE_UNITS_TABLE_H
#define SCENE_UNITS_TABLE_H
#include <stdbool.h>

#include "base/arena.h"
#include "scene/keys.h"

enum { UNITS_TABLE_DEGREES = 1000 /* in place of a power of ten */ };

struct units_table_dimension {
    const char *name, *example;
    const char *common[9]; /* units to name in messages; the first is SI's */
};

struct units_table_unit {
    const char *name;
    enum key_dimension dimension;
    int power; /* of ten, to SI */
    const char *prefixes;
};

const struct units_table_dimension *units_table_dimension(enum key_dimension d);

/* The unit of that name, with a prefix or without, and the power of ten to SI; NULL: there is none. */
const struct units_table_unit *units_table_find(const char *text, int *power);

/* What may follow a number of the dimension, as a regular expression: "[numckMG]?m"; "": nothing. */
const char *units_table_pattern(enum key_dimension d, struct arena *a);

/* May a quantity of the dimension have the unit? KEY_OUTPUT takes those of four dimensions, KEY_STIFFNESS those of a
 * force per length too. */
bool units_table_fits(const struct units_table_unit *u, enum key_dimension d);

#endif
