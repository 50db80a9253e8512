#include "base/err.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>

#include "base/text.h"

bool err_set(struct err *e, enum err_kind kind, const char *format, ...)
{
    char text[sizeof e->text];
    va_list ap;
    if (e->kind != ERR_NONE) return false;
    e->kind = kind;
    va_start(ap, format);
    vsnprintf(text, sizeof text, format, ap);
    va_end(ap);
    text_show(text, e->text, sizeof e->text);
    return false;
}

enum err_kind err_system(enum err_kind otherwise) { return errno == ENOMEM ? ERR_MEMORY : otherwise; }

bool err_about(struct err *e, const char *contact, const char *key)
{
    if (e->key) return false;
    e->contact = contact;
    e->key = key;
    return false;
}

bool err_at(struct err *e, const char *format, ...)
{
    char where[sizeof e->text], whole[2 * sizeof e->text + 2];
    va_list ap;
    va_start(ap, format);
    vsnprintf(where, sizeof where, format, ap);
    va_end(ap);
    snprintf(whole, sizeof whole, "%s: %s", where, e->text);
    text_show(whole, e->text, sizeof e->text);
    e->place = (struct err_place){0};
    return false;
}
