/* See warnings.h. */
#include "cmd/warnings.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

/* Where a number that stands by itself ends, NULL: none begins here. Those in names, c2 or hit-3.wav, do not stand by themselves. */
static const char *number_end(const char *at, char before)
{
    bool sign = *at == '-' || *at == '+';
    if (!strchr(" (", before) || !isdigit((unsigned char)at[sign]))
        return NULL;
    char *end;
    strtod(at, &end);
    return end;
}

static bool alike(const char *a, const char *b)
{
    char before = 0;
    while (*a && *b) {
        const char *past[2] = {number_end(a, before), number_end(b, before)};
        if (past[0] && past[1]) {
            a = past[0];
            b = past[1];
        } else if (*a++ != *b++)
            return false;
        before = a[-1];
    }
    return *a == *b;
}

static struct warning *same(struct warning **all, const char *file, const char *text, bool exact, struct arena *a)
{
    struct warning **w = all, *near = NULL;
    for (; *w; w = &(*w)->next) {
        bool told = strcmp((*w)->files[(*w)->n - 1], file) == 0;
        if (strcmp((*w)->text, text) == 0 && !(told && (*w)->other)) {
            (*w)->other = false;
            return *w;
        }
        if (!exact && !near && !told && alike((*w)->text, text))
            near = *w;
    }
    if (near) {
        near->numbers = near->other = true;
        return near;
    }
    *w = ARENA_TAKE(a, struct warning, 1);
    (*w)->text = text;
    return *w;
}

struct warning *warnings_add(struct warning **all, const char *file, const char *text, bool exact, struct arena *a)
{
    struct warning *w = same(all, file, text, exact, a);
    if (w->n > 0 && !strcmp(w->files[w->n - 1], file))
        return w;
    if (w->n == w->room) {
        const char **more = ARENA_TAKE(a, const char *, w->room = 2 * w->room + 4);
        if (w->n > 0)
            memcpy(more, w->files, (size_t)w->n * sizeof *more);
        w->files = more;
    }
    w->files[w->n++] = file;
    return w;
}
