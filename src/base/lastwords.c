/* See lastwords.h. Neither the lock of a stream nor a pipe that is full may hold it up. */
#include "base/lastwords.h"

#include <poll.h>
#include <stdio.h>
#include <unistd.h>

enum { PATIENCE = 100 /* ms */, LONGEST = 1024 };

static bool as_json;

void lastwords_as_json(void) { as_json = true; }

/* The text of a JSON string; what is not plain ASCII becomes ?. */
static void escaped(const char *text, char *to, size_t size)
{
    size_t n = 0;
    for (; *text && n + 3 < size; text++) {
        if (*text == '"' || *text == '\\') to[n++] = '\\';
        to[n++] = (char)(*text >= ' ' && *text <= '~' ? *text : '?');
    }
    to[n] = '\0';
}

void lastwords(enum err_kind kind, const char *text)
{
    char line[LONGEST], inner[LONGEST / 2];
    escaped(text, inner, sizeof inner);
    const char *anew = isatty(STDERR_FILENO) ? "\r\033[K" : ""; /* where progress is told */
    if (as_json)
        snprintf(line, sizeof line,
                 "{\"severity\": \"error\", \"file\": null, \"line\": null, \"column\": null, \"width\": null, "
                 "\"message\": \"%s\", \"help\": null, \"code\": %d}\n",
                 inner, kind);
    else
        snprintf(line, sizeof line, "%srasp: error: %.900s\n", anew, text);
    size_t n = 0;
    while (line[n])
        n++;
    struct pollfd ready = {.fd = STDERR_FILENO, .events = POLLOUT};
    if (poll(&ready, 1, PATIENCE) > 0 && write(STDERR_FILENO, line, n) < 0) return;
}
