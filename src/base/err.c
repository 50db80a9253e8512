#include "base/err.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

bool err_set(struct err *e, enum err_kind kind, const char *format, ...)
{
    va_list ap;
    if (e->kind != ERR_NONE)
        return false;
    e->kind = kind;
    va_start(ap, format);
    vsnprintf(e->text, sizeof e->text, format, ap);
    va_end(ap);
    return false;
}

bool err_about(struct err *e, const char *contact, const char *key)
{
    if (e->key)
        return false;
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
    memcpy(e->text, whole, sizeof e->text - 1);
    e->text[sizeof e->text - 1] = '\0';
    return false;
}
