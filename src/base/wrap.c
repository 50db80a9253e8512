/* See wrap.h. A column is a character. */
#include "base/wrap.h"

#include <stdbool.h>
#include <string.h>

#include "base/text.h"

enum { WIDTH = 100 };

static int columns(const char *s, size_t n) { return (int)text_utf8_count(s, n); }

static int new_line(FILE *f, const char *margin)
{
    fprintf(f, "\n%s", margin);
    return columns(margin, strlen(margin));
}

void wrap_print(FILE *f, const char *text, int column, const char *margin)
{
    bool fresh = true;
    for (const char *p = text; *p;) {
        if (*p == '\n') {
            column = new_line(f, margin);
            fresh = true;
            p++;
            continue;
        }
        size_t n = strcspn(p, " \n");
        int width = columns(p, n);
        if (!fresh && column + 1 + width > WIDTH) {
            column = new_line(f, margin);
            fresh = true;
        }
        column += fprintf(f, "%s%.*s", fresh ? "" : " ", (int)n, p) > 0 ? width + !fresh : 0;
        fresh = false;
        p += n;
        p += strspn(p, " ");
    }
    fputc('\n', f);
}
