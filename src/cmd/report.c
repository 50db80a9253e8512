/* See report.h. */
#include "cmd/report.h"

#include <stdarg.h>
#include <string.h>

#include "base/text.h"
#include "file/json_value.h"

enum { LABEL = 20, KEY = 64 };

struct report report_open(FILE *out, bool json)
{
    return (struct report){.out = out, .json = json, .at = {json ? json_object() : NULL}};
}

struct report report_open_list(FILE *out, bool json)
{
    return (struct report){.out = out, .json = json, .at = {json ? json_array() : NULL}};
}

bool report_close(struct report *r, int digits, struct err *e)
{
    if (!r->json) return true;
    bool ok =
        json_dumpf(r->at[0], r->out,
                   JSON_INDENT(2) | JSON_REAL_PRECISION((size_t)digits) | (r->ascii ? JSON_ENSURE_ASCII : 0)) == 0;
    fputc('\n', r->out);
    json_decref(r->at[0]);
    return ok || err_set(e, ERR_IO, "the report cannot be written as JSON");
}

/* ------------------------------------------------------------------ JSON */

void report_value(struct report *r, const char *key, json_t *value)
{
    json_t *to = r->at[r->depth];
    if (json_is_array(to))
        json_array_append_new(to, value);
    else
        json_object_set_new(to, key, value);
}

static json_t *value_of(char type, va_list *list)
{
    switch (type) {
    case 'n':
        return json_value_number(va_arg(*list, double));
    case 's':
        return json_value_text(va_arg(*list, const char *));
    case 'e': {
        const char *text = va_arg(*list, const char *);
        return text && *text ? json_value_text(text) : json_null();
    }
    case 'b':
        return json_boolean(va_arg(*list, int));
    case 'i':
        return json_integer(va_arg(*list, int));
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
        return json_value_texts(texts, va_arg(*list, int));
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

void report_set(struct report *r, const char *members, ...)
{
    va_list list;
    if (!r->json) return;
    va_start(list, members);
    for (const char *p = members; *p; p += strspn(p, " ")) {
        char key[KEY];
        size_t n = strcspn(p, ":");
        snprintf(key, sizeof key, "%.*s", (int)n, p);
        report_value(r, key, value_of(p[n + 1], &list));
        p += n + 2;
    }
    va_end(list);
}

static void enter(struct report *r, const char *key, json_t *value)
{
    report_value(r, key, value);
    r->at[++r->depth] = value;
}

void report_object(struct report *r, const char *key)
{
    if (r->json) enter(r, key, json_object());
}

void report_list(struct report *r, const char *key)
{
    if (r->json) enter(r, key, json_array());
}

void report_end(struct report *r) { r->depth -= r->json; }

/* ------------------------------------------------------------------ text */

void report_text(struct report *r, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    if (!r->json) vfprintf(r->out, format, list);
    va_end(list);
}

static void row(struct report *r, const char *label, const char *format, va_list list)
{
    fprintf(r->out, "  %-*s ", LABEL, label);
    vfprintf(r->out, format, list);
    fputc('\n', r->out);
}

void report_row(struct report *r, const char *label, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    if (!r->json) row(r, label, format, list);
    va_end(list);
}

void report_note(struct report *r, const char *head, const char *text)
{
    int n = (int)strlen(head);
    char margin[32];
    if (r->json) return;
    snprintf(margin, sizeof margin, "%*s", n, "");
    fputs(head, r->out);
    text_wrap(r->out, text, n, margin);
}

void report_figure(struct report *r, const char *key, double x, const char *label, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    if (r->json)
        report_value(r, key, json_value_number(x));
    else
        row(r, label, format, list);
    va_end(list);
}
