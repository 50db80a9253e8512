/* See json_value.h. */
#include "file/json_value.h"

#include <math.h>

#include "base/text.h"

json_t *json_value_number(double x) { return isfinite(x) ? json_real(x) : json_null(); }

json_t *json_value_text(const char *s)
{
    json_t *j = s ? json_string(s) : NULL; /* NULL also for what is not UTF-8 */
    return j ? j : json_null();
}

json_t *json_value_shown(const char *s)
{
    struct arena *a = arena_open();
    json_t *j = json_value_text(text_shown(a, s));
    arena_close(a);
    return j;
}

json_t *json_value_texts(const char *const *list, int n)
{
    json_t *all = json_array();
    for (int i = 0; i < n; i++)
        json_array_append_new(all, json_value_text(list[i]));
    return all;
}

double json_value_number_of(const json_t *object, const char *key)
{
    const json_t *x = json_object_get(object, key);
    return json_is_number(x) ? json_number_value(x) : NAN;
}

const char *json_value_text_of(const json_t *object, const char *key, struct arena *a)
{
    const char *s = json_string_value(json_object_get(object, key));
    return s ? arena_text(a, s) : NULL;
}
