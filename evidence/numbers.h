/* Numbers as the judges are given them, in arguments and in tables: whole, or the program ends and says which is none. */
#ifndef NUMBERS_H
#define NUMBERS_H
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* The number that text begins with; *end: what follows. */
static inline double number_first(const char *text, char **end)
{
    errno = 0;
    double x = strtod(text, end);
    if (*end == text || errno == ERANGE || !isfinite(x)) {
        fprintf(stderr, "'%s' is no number\n", text);
        exit(1);
    }
    return x;
}

/* The number that text is, but for a line's end. */
static inline double number(const char *text)
{
    char *end;
    double x = number_first(text, &end);
    if (*end != 0 && *end != '\n') {
        fprintf(stderr, "'%s' is no number\n", text);
        exit(1);
    }
    return x;
}

/* A whole number from 0 on. */
static inline long number_whole(const char *text)
{
    double x = number(text);
    if (x < 0 || x > 1e15 || x != rint(x)) {
        fprintf(stderr, "'%s' is no whole number\n", text);
        exit(1);
    }
    return (long)x;
}

/* n numbers with commas between, to x[n]: a row of a table. */
static inline void number_row(const char *text, int n, double *x)
{
    const char *at = text;
    char *end;
    for (int i = 0; i < n; i++, at = end + 1) {
        x[i] = number_first(at, &end);
        if (i + 1 < n ? *end != ',' : *end != 0 && *end != '\n') {
            fprintf(stderr, "'%s' is no row of %d numbers\n", text, n);
            exit(1);
        }
    }
}

#endif
