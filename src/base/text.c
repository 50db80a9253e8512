/* Texts: see text.h. Distance: optimal string alignment (Damerau 1964, each stretch edited once), by dynamic
 * programming. */
#include "base/text.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { NUMBER_MAX = 400, WORD_MAX = 63, FAR = 99, ESCAPE_MAX = 4 };

static size_t digits_length(const char *s) { return strspn(s, "0123456789"); }

static size_t mantissa_length(const char *s)
{
    size_t sign = *s == '+' || *s == '-', before = digits_length(s + sign), n = sign + before, after = 0;
    if (s[n] == '.') {
        after = digits_length(s + n + 1);
        n += 1 + after;
    }
    return before + after > 0 ? n : 0;
}

size_t text_number_length(const char *s)
{
    size_t n = mantissa_length(s);
    if (n == 0 || (s[n] != 'e' && s[n] != 'E')) return n;
    size_t sign = s[n + 1] == '+' || s[n + 1] == '-', digits = digits_length(s + n + 1 + sign);
    return digits ? n + 1 + sign + digits : n;
}

bool text_scaled(const char *s, size_t n, int power, double *x)
{
    char copy[NUMBER_MAX + 1], shifted[NUMBER_MAX + 32];
    if (n > NUMBER_MAX || n == 0) return false;
    memcpy(copy, s, n);
    copy[n] = '\0';
    if (text_number_length(copy) != n) return false;
    size_t m = mantissa_length(copy);
    long exponent = m < n ? strtol(copy + m + 1, NULL, 10) : 0;
    if (exponent < -100000 || exponent > 100000) exponent = exponent < 0 ? -100000 : 100000;
    snprintf(shifted, sizeof shifted, "%.*se%ld", (int)m, copy, exponent + power);
    double value = strtod(shifted, NULL);
    if (!isfinite(value) || (value == 0 && strcspn(copy, "123456789") < m)) return false;
    *x = value;
    return true;
}

bool text_double(const char *s, double *x) { return text_scaled(s, strlen(s), 0, x); }

bool text_int(const char *s, int low, int high, int *x)
{
    size_t sign = *s == '-', n = digits_length(s + sign);
    if (n == 0 || n > 10 || s[sign + n]) return false;
    long value = strtol(s, NULL, 10);
    if (value < low || value > high) return false;
    *x = (int)value;
    return true;
}

bool text_u64(const char *s, uint64_t *x)
{
    uint64_t value = 0;
    if (!*s || s[digits_length(s)]) return false;
    for (; *s; s++) {
        uint64_t digit = (uint64_t)(*s - '0');
        if (value > (UINT64_MAX - digit) / 10) return false;
        value = value * 10 + digit;
    }
    *x = value;
    return true;
}

void text_digits(double x, char digits[20], int *exponent)
{
    char form[40];
    for (int precision = 0; precision < 17; precision++) {
        snprintf(form, sizeof form, "%.*e", precision, x);
        if (strtod(form, NULL) == x) break;
    }
    size_t n = 0;
    for (const char *c = form; *c != 'e'; c++)
        if (isdigit((unsigned char)*c)) digits[n++] = *c;
    digits[n] = '\0';
    *exponent = x > 0 ? (int)strtol(strchr(form, 'e') + 1, NULL, 10) + 1 : 1;
}

static int least(int a, int b) { return a < b ? a : b; }

int text_distance(const char *a, const char *b)
{
    int d[WORD_MAX + 1][WORD_MAX + 1];
    size_t n = strlen(a), m = strlen(b);
    if (n > WORD_MAX || m > WORD_MAX) return FAR;
    for (size_t i = 0; i <= n; i++)
        for (size_t j = 0; j <= m; j++) {
            if (i == 0 || j == 0) {
                d[i][j] = (int)(i + j);
                continue;
            }
            d[i][j] = least(d[i - 1][j - 1] + (a[i - 1] != b[j - 1]), least(d[i - 1][j], d[i][j - 1]) + 1);
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                d[i][j] = least(d[i][j], d[i - 2][j - 2] + 1);
        }
    return d[n][m];
}

const char *text_nearest(const char *word, const char *const *names)
{
    const char *best = NULL;
    size_t half = strlen(word) / 2, alike = 0;
    int limit = half > 3 ? 3 : half < 1 ? 1 : (int)half;
    for (; *names; names++) {
        int distance = text_distance(word, *names);
        size_t begins = 0;
        while (word[begins] && word[begins] == (*names)[begins])
            begins++;
        if (distance > limit || (best && distance == limit && begins <= alike)) continue;
        best = *names;
        limit = distance;
        alike = begins;
    }
    return best;
}

int text_utf8(const char *s, size_t n, uint32_t *code)
{
    static const uint32_t first[5] = {0, 0, 0x80, 0x800, 0x10000};
    const unsigned char *u = (const unsigned char *)s;
    if (n == 0) return 0;
    int length = u[0] < 0x80                   ? 1
                 : u[0] >= 0xc2 && u[0] < 0xe0 ? 2
                 : (u[0] & 0xf0) == 0xe0       ? 3
                 : u[0] >= 0xf0 && u[0] < 0xf5 ? 4
                                               : 0;
    if (length == 0 || (size_t)length > n) return 0;
    uint32_t c = length == 1 ? u[0] : u[0] & (0xffu >> (length + 1));
    for (int i = 1; i < length; i++) {
        if ((u[i] & 0xc0) != 0x80) return 0;
        c = c << 6 | (u[i] & 0x3fu);
    }
    if (c < first[length] || c > 0x10ffff || (c >= 0xd800 && c < 0xe000)) return 0;
    *code = c;
    return length;
}

size_t text_utf8_count(const char *s, size_t n)
{
    size_t count = 0;
    uint32_t code;
    for (size_t i = 0; i < n; count++) {
        int length = text_utf8(s + i, n - i, &code);
        i += length ? (size_t)length : 1;
    }
    return count;
}

int text_showable(const char *s, size_t n)
{
    uint32_t code = 0;
    int length = text_utf8(s, n, &code);
    return code >= 0x20 && (code < 0x7f || code >= 0xa0) ? length : 0;
}

void text_show(const char *s, char *out, size_t room)
{
    size_t size = strlen(s), n = 0;
    for (size_t i = 0, step; i < size; i += step) {
        static const char bytes[] = "\n\r\t", letters[] = "nrt";
        char escaped[ESCAPE_MAX + 1];
        const char *at = strchr(bytes, s[i]);
        size_t length = (size_t)text_showable(s + i, size - i), put = length;
        if (!length && at)
            put = (size_t)snprintf(escaped, sizeof escaped, "\\%c", letters[at - bytes]);
        else if (!length)
            put = (size_t)snprintf(escaped, sizeof escaped, "\\x%02x", (unsigned char)s[i]);
        step = length ? length : 1;
        if (n + put >= room) break;
        memcpy(out + n, length ? s + i : escaped, put);
        n += put;
    }
    out[n] = '\0';
}

const char *text_shown(struct arena *a, const char *s)
{
    size_t room = ESCAPE_MAX * strlen(s) + 1;
    char *out = arena_take(a, room, 1);
    text_show(s, out, room);
    return out;
}

const char *text_html(struct arena *a, const char *s)
{
    char *out = arena_take(a, 6 * strlen(s) + 1, 1), *to = out;
    for (const char *p = s; *p; p++)
        to = stpcpy(to, *p == '<'   ? "&lt;"
                        : *p == '>' ? "&gt;"
                        : *p == '&' ? "&amp;"
                        : *p == '"' ? "&quot;"
                                    : (const char[]){*p, '\0'});
    return out;
}

bool text_is_one(const char *word, const char *const *names)
{
    while (*names && strcmp(*names, word) != 0)
        names++;
    return *names;
}

bool text_ends_in(const char *s, const char *ending)
{
    size_t n = strlen(s), m = strlen(ending);
    return n > m && strcasecmp(s + n - m, ending) == 0;
}

bool text_ends(const char *s, const char *ending)
{
    size_t n = strlen(s), m = strlen(ending);
    return n > m && strcmp(s + n - m, ending) == 0;
}

/* A column is a character. */
enum { WIDTH = 100 };

static int columns(const char *s, size_t n) { return (int)text_utf8_count(s, n); }

static int new_line(FILE *f, const char *margin)
{
    fprintf(f, "\n%s", margin);
    return columns(margin, strlen(margin));
}

bool text_ends_sentence(const char *text, const char *p)
{
    return *p == '.' && p[1] == ' ' && !(p - text >= 5 && !strncmp(p - 5, "et al", 5));
}

void text_wrap(FILE *f, const char *text, int column, const char *margin)
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
