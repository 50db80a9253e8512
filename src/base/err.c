#include "base/err.h"

#include <errno.h>
#include <poll.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

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

/* ------------------------------------------------------------------ last words */

/* Neither the lock of a stream nor a pipe that is full may hold it up. */
enum { PATIENCE = 100 /* ms */, LONGEST = 1024 };

static bool as_json;

void err_last_words_as_json(void) { as_json = true; }

void err_last_words(enum err_kind kind, const char *text)
{
    char line[LONGEST], inner[LONGEST / 2];
    size_t m = 0; /* the text of a JSON string; what is not plain ASCII becomes ? */
    for (const char *s = text; *s && m + 3 < sizeof inner; s++) {
        if (*s == '"' || *s == '\\') inner[m++] = '\\';
        inner[m++] = (char)(*s >= ' ' && *s <= '~' ? *s : '?');
    }
    inner[m] = '\0';
    const char *anew = isatty(STDERR_FILENO) ? "\r\033[K" : ""; /* where progress is shown */
    if (as_json)
        snprintf(line, sizeof line,
                 "{\"severity\": \"error\", \"file\": null, \"line\": null, \"column\": null, \"width\": null, "
                 "\"message\": \"%s\", \"help\": null, \"code\": %d}\n",
                 inner, kind);
    else
        snprintf(line, sizeof line, "%srasp: error: %.900s\n", anew, text);

    struct pollfd ready = {.fd = STDERR_FILENO, .events = POLLOUT};
    if (poll(&ready, 1, PATIENCE) > 0 && write(STDERR_FILENO, line, strlen(line)) < 0) return;
}
