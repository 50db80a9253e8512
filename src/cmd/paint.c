/* See paint.h. Painted are the first "error:" or "warning:" at a line's start or after ": ", and what a message adds below the line it shows. */
#include "cmd/paint.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define RED "\033[1;31m"
#define MAGENTA "\033[1;35m"
#define GREEN "\033[1;32m"
#define CYAN "\033[1;36m"
#define PLAIN "\033[m"

struct piece {
    const char *at; /* NULL: none */
    size_t size;
    const char *colour;
};

bool paint_wanted(FILE *f)
{
    const char *off = getenv("NO_COLOR"), *term = getenv("TERM");
    return !(off && *off) && term && *term && strcmp(term, "dumb") != 0 && isatty(fileno(f));
}

/* The text in line[0..n), at its start or after ": ". */
static const char *find(const char *line, size_t n, const char *text)
{
    size_t m = strlen(text);
    for (size_t i = 0; i + m <= n; i++)
        if (!strncmp(line + i, text, m) && (i == 0 || (i >= 2 && line[i - 1] == ' ' && line[i - 2] == ':')))
            return line + i;
    return NULL;
}

static struct piece piece_of(const char *line, size_t n)
{
    size_t bar = strspn(line, " 0123456789"), mark = bar < n ? bar + 1 + strspn(line + bar + 1, " \t") : n;
    if (bar < n && bar >= 4 && line[bar] == '|')
        return mark < n && line[mark] == '^' && strspn(line, " ") == bar ? (struct piece){line + mark, n - mark, GREEN} : (struct piece){NULL, 0, NULL};
    if (!strncmp(line, "      = help:", 13))
        return (struct piece){line + 8, 5, CYAN};
    const char *error = find(line, n, "error:"), *warning = find(line, n, "warning:");
    if (error && (!warning || error < warning))
        return (struct piece){error, 6, RED};
    return warning ? (struct piece){warning, 8, MAGENTA} : (struct piece){NULL, 0, NULL};
}

static void print_line(FILE *f, const char *line, size_t n)
{
    const struct piece p = piece_of(line, n);
    if (!p.at) {
        fwrite(line, 1, n, f);
        return;
    }
    size_t before = (size_t)(p.at - line);
    fwrite(line, 1, before, f);
    fprintf(f, "%s%.*s%s", p.colour, (int)p.size, p.at, PLAIN);
    fwrite(p.at + p.size, 1, n - before - p.size, f);
}

void paint_lines(FILE *f, const char *lines)
{
    if (!paint_wanted(f)) {
        fputs(lines, f);
        return;
    }
    while (*lines) {
        size_t n = strcspn(lines, "\n");
        print_line(f, lines, n);
        lines += n;
        if (*lines) {
            fputc('\n', f);
            lines++;
        }
    }
}
