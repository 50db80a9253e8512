/* See report.h. */
#include "cmd/report.h"

#include <stdarg.h>
#include <string.h>

#include "base/text.h"
#include "file/json_value.h"

enum { LABEL = 20 };

struct report report_open(FILE *out, bool json)
{
    return (struct report){.out = out, .json = json, .open = {{json ? json_object() : NULL}, 0}};
}

struct report report_open_list(FILE *out, bool json)
{
    return (struct report){.out = out, .json = json, .open = {{json ? json_array() : NULL}, 0}};
}

bool report_close(struct report *r, int digits, struct err *e)
{
    if (!r->json) return true;
    bool ok =
        json_dumpf(r->open.at[0], r->out,
                   JSON_INDENT(2) | JSON_REAL_PRECISION((size_t)digits) | (r->ascii ? JSON_ENSURE_ASCII : 0)) == 0;
    fputc('\n', r->out);
    json_decref(r->open.at[0]);
    return ok || ferror(r->out) /* which the end of the program reports */ ||
           err_set(e, ERR_IO, "the report cannot be written as JSON");
}

/* ------------------------------------------------------------------ JSON */

void report_set(struct report *r, const char *members, ...)
{
    va_list list;
    va_start(list, members);
    if (r->json) json_value_put(&r->open, members, &list);
    va_end(list);
}

void report_object(struct report *r, const char *key) { report_set(r, "$:{", key); }
void report_list(struct report *r, const char *key) { report_set(r, "$:[", key); }
void report_end(struct report *r) { report_set(r, "}"); }

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
        report_set(r, "$:n", key, x);
    else
        row(r, label, format, list);
    va_end(list);
}
