/* Names of units of length in files, and numbers as bytes. */
#ifndef FILE_HEIGHTFILE_UNIT_H
#define FILE_HEIGHTFILE_UNIT_H
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* How many of the unit make a metre: "" and m: 1; mm, um (with either micro sign, also in Latin-1), nm, pm. False: not
 * a length. */
bool heightfile_unit(const char *name, double *per_metre);

/* `size` bytes, lowest first, as unsigned. */
uint64_t heightfile_unit_word(const void *bytes, size_t size);
float heightfile_unit_f32(const void *bytes);
double heightfile_unit_f64(const void *bytes);

/* The same the other way round; a failed write shows in the stream. */
void heightfile_unit_put(FILE *f, uint64_t value, size_t size);
void heightfile_unit_put_f64(FILE *f, double value);

/* The shortest of %.15g, %.16g and %.17g that reads back as the same double; nan as it is. */
const char *heightfile_unit_text(char text[32], double value);

#endif
