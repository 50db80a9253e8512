/* Single values to and from JSON: what cannot stand there is null, what is null or missing is NAN or NULL. */
#ifndef FILE_JSON_VALUE_H
#define FILE_JSON_VALUE_H
#include <jansson.h>
#include <stdarg.h>

#include "base/arena.h"

json_t *json_value_number(double x);     /* null: not finite                     */
json_t *json_value_text(const char *s);  /* null: NULL, or no UTF-8              */
json_t *json_value_shown(const char *s); /* as messages show it (text_shown): what is no UTF-8 is \xHH */

enum { JSON_VALUE_DEPTH = 8 };

struct json_value_open { /* objects and lists that are open, the outermost first */
    json_t *at[JSON_VALUE_DEPTH];
    int depth;
};

/* Into what is open (a later member of the same key takes the place of the first): words "KEY:TYPE" with blanks
   between, of a list ":TYPE", and a value for each; of the key $ it comes first. n: double, null where it is not
   finite; s: text, null for NULL and for what is not UTF-8; e: the same, null for "" too; ?: the same, no member for
   NULL; v: text as messages show it, null for NULL; b, i: int; w: int, null unless above 0; l: long; c: long, null
   below 0; z: size_t; a: const double *, int; t: const char *const *, int; o: json_t *, which is taken; 0: null,
   without a value. { and [ open an object and a list, without a value; the words } and ] close them. */
void json_value_put(struct json_value_open *to, const char *members, va_list *list);
json_t *json_value_object(const char *members, ...);       /* a new object                */
void json_value_set(json_t *to, const char *members, ...); /* the same into an object */

double json_value_number_of(const json_t *object, const char *key);                     /* NAN: no number there */
const char *json_value_text_of(const json_t *object, const char *key, struct arena *a); /* NULL: no text there  */

#endif
