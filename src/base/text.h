/* Texts: numbers without leftovers, names that are nearly right, UTF-8, what may stand in a message. Nothing here
 * depends on the locale (none is ever set). */
#ifndef BASE_TEXT_H
#define BASE_TEXT_H
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "base/arena.h"

/* Bytes of the decimal number that s starts with: sign, digits with at most one point, exponent; 0: none. */
size_t text_number_length(const char *s);

/* The number in s[0..n), which must be one as a whole, times 10^power, rounded once (the decimal exponent is moved,
   nothing is multiplied). False: not a number, more than 400 characters, infinite, or not zero but rounded to zero. */
bool text_scaled(const char *s, size_t n, int power, double *x);

/* Whole strings: a decimal number; a whole number from low to high; digits only, up to 2^64 - 1. */
bool text_double(const char *s, double *x);
bool text_int(const char *s, int low, int high, int *x);
bool text_u64(const char *s, uint64_t *x);

/* Shortest decimal digits that read back as the same double: x = 0.DIGITS * 10^*exponent, x finite and >= 0. */
void text_digits(double x, char digits[20], int *exponent);

/* Damerau-Levenshtein distance (insert, delete, replace, exchange neighbours), bytes; 99 for words over 63 bytes. */
int text_distance(const char *a, const char *b);

/* The nearest of the names (NULL-terminated), not farther than 3 and than half the word's length; of equally near ones
   that which begins as the word does for longest; NULL: none. */
const char *text_nearest(const char *word, const char *const *names);

/* Is the word one of the names (NULL-terminated)? */
bool text_is_one(const char *word, const char *const *names);

/* Bytes of the UTF-8 character that s[0..n) starts with, and its code; 0: not valid UTF-8 (or n = 0). */
int text_utf8(const char *s, size_t n, uint32_t *code);

/* Characters in s[0..n); bytes that are not valid UTF-8 count as one each. */
size_t text_utf8_count(const char *s, size_t n);

/* Bytes of the character that s[0..n) starts with, if a message may show it as it is; 0: a control character (a line
 * feed, say), or not valid UTF-8. */
int text_showable(const char *s, size_t n);

/* s for a message, into out[0..room), room > 0: what may not be shown becomes \n, \r, \t, or \xHH for each of its
   bytes. What is too long is cut off. Showing a shown text changes nothing: a backslash stays as it is. */
void text_show(const char *s, char *out, size_t room);

/* The same in the arena, whole. */
const char *text_shown(struct arena *a, const char *s);

/* With what HTML would take for its own written as entities. */
const char *text_html(struct arena *a, const char *s);

/* Does it end so, and is more than the ending? */
bool text_ends(const char *s, const char *ending);

/* The same, whatever the case of the letters. */
bool text_ends_in(const char *s, const char *ending);

/* Is the full stop (or whatever is) at p in text the end of a sentence that another one follows? "et al." is none. */
bool text_ends_sentence(const char *text, const char *p);

/* Prints plain text in lines of at most 100 columns, for help and generated comments, and ends the line. The first line
   begins at `column` (what has been printed before it); further lines begin with `margin`. A newline in the text begins
   a new line. Words are never cut. */
void text_wrap(FILE *f, const char *text, int column, const char *margin);

#endif
