/* See json_value.h. */
#include "file/json_value.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

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

static json_t *value_of(char type, va_list *list)
{
    switch (type) {
    case 'n':
        return json_value_number(va_arg(*list, double));
    case 's':
    case '?':
        return json_value_text(va_arg(*list, const char *));
    case 'e': {
        const char *text = va_arg(*list, const char *);
        return text && *text ? json_value_text(text) : json_null();
    }
    case 'v': {
        const char *text = va_arg(*list, const char *);
        return text ? json_value_shown(text) : json_null();
    }
    case 'b':
        return json_boolean(va_arg(*list, int));
    case 'i':
        return json_integer(va_arg(*list, int));
    case 'w': {
        int n = va_arg(*list, int);
        return n > 0 ? json_integer(n) : json_null();
    }
    case '{':
        return json_object();
    case '[':
        return json_array();
    case 'l':
        return json_integer(va_arg(*list, long));
    case 'z':
        return json_integer((json_int_t)va_arg(*list, size_t));
    case 'c': {
        long n = va_arg(*list, long);
        return n < 0 ? json_null() : json_integer(n);
    }
    case 'o':
        return va_arg(*list, json_t *);
    case 't': {
        const char *const *texts = va_arg(*list, const char *const *);
        int n = va_arg(*list, int);
        json_t *all = json_array();
        for (int i = 0; i < n; i++)
            json_array_append_new(all, json_value_text(texts[i]));
        return all;
    }
    case 'a': {
        const double *x = va_arg(*list, const double *);
        int n = va_arg(*list, int);
        json_t *all = json_array();
        for (int i = 0; i < n; i++)
            json_array_append_new(all, json_value_number(x[i]));
        return all;
    }
    default:
        return json_null();
    }
}

void json_value_put(struct json_value_open *open, const char *members, va_list *list)
{
    for (const char *p = members; *p; p += strspn(p, " ")) {
        char word[64];
        if (*p == '}' || *p == ']') {
            open->depth--;
            p++;
            continue;
        }
        size_t n = strcspn(p, ":");
        snprintf(word, sizeof word, "%.*s", (int)n, p);
        const char *key = *p == '$' ? va_arg(*list, const char *) : word;
        json_t *to = open->at[open->depth], *value = value_of(p[n + 1], list);
        if (p[n + 1] == '?' && json_is_null(value))
            json_decref(value);
        else if (json_is_array(to))
            json_array_append_new(to, value);
        else
            json_object_set_new(to, key, value);
        if (p[n + 1] == '{' || p[n + 1] == '[') open->at[++open->depth] = value;
        p += n + 2;
    }
}

json_t *json_value_object(const char *members, ...)
{
    struct json_value_open open = {{json_object()}, 0};
    va_list list;
    va_start(list, members);
    json_value_put(&open, members, &list);
    va_end(list);
    return open.at[0];
}

void json_value_set(json_t *to, const char *members, ...)
{
    struct json_value_open open = {{to}, 0};
    va_list list;
    va_start(list, members);
    json_value_put(&open, members, &list);
    va_end(list);
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
