/* Single values to and from JSON: what cannot stand there is null, what is null or missing is NAN or NULL. */
#ifndef FILE_JSON_VALUE_H
#define FILE_JSON_VALUE_H
#include <jansson.h>

#include "base/arena.h"

json_t *json_value_number(double x);     /* null: not finite                     */
json_t *json_value_text(const char *s);  /* null: NULL, or no UTF-8              */
json_t *json_value_shown(const char *s); /* as messages show it (text_shown): what is no UTF-8 is \xHH */
json_t *json_value_texts(const char *const *list, int n);

double json_value_number_of(const json_t *object, const char *key);                     /* NAN: no number there */
const char *json_value_text_of(const json_t *object, const char *key, struct arena *a); /* NULL: no text there  */

#endif
