/* Surface data files (SDF, ISO 25178-71; NIST's and NPL's pages on their reference data).

     binary   version char[8], ManufacID char[10], CreateDate char[12], ModDate char[12], NumPoints u16, NumProfiles u16
              (version 2.0:
              u32 each), Xscale, Yscale, Zscale, Zresolution f64, Compression u8, DataType u8, CheckType u8; then
                NumProfiles rows of
              NumPoints numbers; all little-endian, packed
     text     the version; lines "Key = value" with the same keys, "; " before remarks; a line "*"; the numbers; a line
              "*"

   The version's first letter says which, a or b; of the rest only ISO-2 counts, for the width of NumPoints: files come
   as BCR-0.0, BC-1.0, NPL-V1.0, ISO-1.0 ... Keys in any case and order. z = number * Zscale in metres; Xscale and
   Yscale are metres between samples, and Yscale is 0 in profiles. What follows the data (a trailer, in text behind the
   second "*") and the dates are not looked at. Some ISO-1.0 files have 8 bytes more of header: a file that is too long
   by just these is taken as one.

   Missing points: NaN; in text also BAD; of whole numbers the highest unsigned, the lowest signed one, of 16 and 32
   bits. */
#include "file/heightfile_formats.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/text.h"

enum { SDF_POINTS, SDF_PROFILES, SDF_XSCALE, SDF_YSCALE, SDF_ZSCALE, SDF_COMPRESSION, SDF_TYPE, SDF_CHECK, SDF_KEYS };

static const char *const sdf_keys[SDF_KEYS] = {"NumPoints", "NumProfiles", "Xscale",   "Yscale",
                                               "Zscale",    "Compression", "DataType", "CheckType"};

struct sdf {
    const char *path;
    double value[SDF_KEYS];
    bool text, there[SDF_KEYS];
    struct err *e;
};

static const struct sdf_type {
    char kind;
    size_t size;
    int bits;
    double missing; /* NAN: no number stands for it */
} sdf_types[] = {{'u', 1, 8, NAN}, {'u', 2, 16, 65535},  {'u', 4, 32, 4294967295.0},  {'f', 4, 24, NAN},
                 {'i', 1, 8, NAN}, {'i', 2, 16, -32768}, {'i', 4, 32, -2147483648.0}, {'f', 8, 53, NAN}};

static bool sdf_text(const struct bytes *b) { return b->n > 0 && (b->at[0] == 'a' || b->at[0] == 'A'); }

/* A text that begins with a or b is not yet an SDF: the header's keys, or the NULs in its numbers, must be there. */
bool heightfile_sdf_is(const struct bytes *b)
{
    if (b->n < 2) return false;
    if (sdf_text(b)) return strcasestr(b->at, "NumPoints") != NULL || strcasestr(b->at, "ManufacID") != NULL;
    return b->at[0] == 'b' && (memchr(b->at, '\0', b->n < 85 ? b->n : 85) || memchr(b->at, '-', b->n < 8 ? b->n : 8));
}

static bool sdf_whole(const struct sdf *s, int key, double low, double high)
{
    double v = s->value[key];
    return (v >= low && v <= high && v == floor(v)) ||
           err_set(s->e, ERR_SCENE, "%s: SDF header: %s must be a whole number from %g to %g, not %g", s->path,
                   sdf_keys[key], low, high, v);
}

static bool sdf_positive(const struct sdf *s, int key, bool zero)
{
    double v = s->value[key];
    return (isfinite(v) && (zero ? v >= 0 : v > 0)) ||
           err_set(s->e, ERR_SCENE, "%s: SDF header: %s is %g, not a positive number of metres%s", s->path,
                   sdf_keys[key], v, zero ? " (or 0, in profiles)" : "");
}

/* The header's counts are there and no larger than the file. */
static bool sdf_counts(const struct sdf *s, const struct bytes *b)
{
    for (int i = 0; s->text && i < SDF_KEYS; i++)
        if (!s->there[i]) return err_set(s->e, ERR_SCENE, "%s: the SDF header has no %s", s->path, sdf_keys[i]);
    return s->value[SDF_POINTS] * s->value[SDF_PROFILES] <= (double)b->n ||
           err_set(s->e, ERR_SCENE, "%s: %g x %g heights should follow the header, and the file has %zu bytes", s->path,
                   s->value[SDF_POINTS], s->value[SDF_PROFILES], b->n);
}

/* Checks the header and takes over what it says. */
static bool sdf_header(const struct sdf *s, struct arena *a, struct heightfile *h)
{
    if (!sdf_whole(s, SDF_POINTS, 1, 4294967295.0) || !sdf_whole(s, SDF_PROFILES, 1, 4294967295.0) ||
        !sdf_whole(s, SDF_TYPE, 0, 7) || !sdf_positive(s, SDF_XSCALE, false) || !sdf_positive(s, SDF_YSCALE, true) ||
        !sdf_positive(s, SDF_ZSCALE, false))
        return false;
    if (s->value[SDF_COMPRESSION] != 0)
        return err_set(s->e, ERR_SCENE, "%s: SDF header: Compression is %g; only uncompressed files (0) are read",
                       s->path, s->value[SDF_COMPRESSION]);
    const struct sdf_type *t = &sdf_types[(int)s->value[SDF_TYPE]];
    h->columns = (size_t)s->value[SDF_POINTS];
    h->rows = (size_t)s->value[SDF_PROFILES];
    h->pitch_x = s->value[SDF_XSCALE];
    h->pitch_y = s->value[SDF_YSCALE] > 0 ? s->value[SDF_YSCALE] : NAN;
    h->metric = true;
    h->bits = t->bits;
    h->step = t->kind != 'f' ? s->value[SDF_ZSCALE] : 0;
    return heightfile_room(s->path, h, a, s->e);
}

static double sdf_metres(const struct sdf *s, double v)
{
    return v == sdf_types[(int)s->value[SDF_TYPE]].missing ? NAN : v * s->value[SDF_ZSCALE];
}

/* ------------------------------------------------------------------ binary */

static bool sdf_binary(struct sdf *s, const struct bytes *b, struct arena *a, struct heightfile *h)
{
    size_t wide = b->n > 6 && !memcmp(b->at, "bISO-2", 6) ? 4 : 2, header = 77 + 2 * wide;
    if (b->n < header)
        return err_set(s->e, ERR_SCENE, "%s: the file ends inside its SDF header, at byte %zu of %zu", s->path, b->n,
                       header);
    const char *p = b->at + 42, *scales = p + 2 * wide;
    s->value[SDF_POINTS] = (double)bytes_word(p, wide);
    s->value[SDF_PROFILES] = (double)bytes_word(p + wide, wide);
    for (int i = 0; i < 3; i++)
        s->value[SDF_XSCALE + i] = bytes_f64(scales + 8 * i);
    s->value[SDF_COMPRESSION] = scales[32];
    s->value[SDF_TYPE] = scales[33];
    if (!sdf_counts(s, b) || !sdf_header(s, a, h)) return false;
    const struct sdf_type *t = &sdf_types[(int)s->value[SDF_TYPE]];
    size_t n = h->columns * h->rows;
    if (b->n == header + n * t->size + 8 && !memcmp(b->at, "bISO-1.0", 8)) header += 8;
    if (b->n - header < n * t->size)
        return err_set(s->e, ERR_SCENE, "%s: %zu x %zu numbers of %zu bytes should follow byte %zu, and %zu bytes do",
                       s->path, h->columns, h->rows, t->size, header, b->n - header);
    for (size_t i = 0; i < n; i++)
        h->z[i] = sdf_metres(s, bytes_number(b->at + header + i * t->size, t->kind, t->size));
    h->format = "SDF (binary)";
    return true;
}

/* ------------------------------------------------------------------ text */

static const char *sdf_skip(const char *p) { return p + strspn(p, " \t\r\n"); }

/* "Key = value"; keys that do not matter here are passed over. */
static bool sdf_entry(struct sdf *s, const char *line, size_t n, int number)
{
    const char *equals = memchr(line, '=', n);
    size_t key = strcspn(line, " \t=");
    if (!equals)
        return err_set(s->e, ERR_SCENE, "%s: SDF header, line %d: '%.*s' is not of the form Key = value", s->path,
                       number, (int)(n < 40 ? n : 40), line);
    const char *v = equals + 1 + strspn(equals + 1, " \t");
    for (int i = 0; i < SDF_KEYS; i++) {
        if (key != strlen(sdf_keys[i]) || strncasecmp(line, sdf_keys[i], key) != 0) continue;
        if (text_number_length(v) == 0)
            return err_set(s->e, ERR_SCENE, "%s: SDF header, line %d: %s is not a number", s->path, number,
                           sdf_keys[i]);
        s->value[i] = strtod(v, NULL);
        s->there[i] = true;
    }
    return true;
}

/* Takes the lines up to the first "*"; returns what follows it, or NULL. */
static const char *sdf_lines(struct sdf *s, const char *p)
{
    int number = 1;
    for (p += strcspn(p, "\n"); *p; p += strcspn(p, "\n")) {
        size_t blank = strspn(++p, " \t\r"), n = strcspn(p, ";\r\n");
        number++;
        if (p[blank] == '*') return p + blank + 1;
        if (n > blank && !sdf_entry(s, p + blank, n - blank, number)) return NULL;
    }
    err_set(s->e, ERR_SCENE, "%s: the SDF header has no end: no line holds the asterisk that the heights follow",
            s->path);
    return NULL;
}

static bool sdf_numbers(const struct sdf *s, const char *p, struct heightfile *h)
{
    size_t n = h->columns * h->rows;
    for (size_t i = 0; i < n; i++) {
        const char *at = sdf_skip(p);
        if (!*at || *at == '*')
            return err_set(s->e, ERR_SCENE, "%s: %zu x %zu heights should stand between the asterisks, and %zu do",
                           s->path, h->columns, h->rows, i);
        size_t size = text_number_length(at);
        bool missing = size == 0 && (!strncasecmp(at, "bad", 3) || !strncasecmp(at, "nan", 3));
        p = at + (missing ? 3 : size);
        if (p == at || (*p && !strchr(" \t\r\n*", *p)))
            return err_set(s->e, ERR_SCENE, "%s: height %zu (counted from 0) is '%.*s': neither a number, NaN nor BAD",
                           s->path, i, (int)strcspn(at, " \t\r\n"), at);
        h->z[i] = sdf_metres(s, missing ? NAN : strtod(at, NULL));
    }
    p = sdf_skip(p);
    return !*p || *p == '*' ||
           err_set(s->e, ERR_SCENE, "%s: more than %zu x %zu heights stand between the asterisks", s->path, h->columns,
                   h->rows);
}

bool heightfile_sdf_read(const char *path, const struct bytes *b, struct arena *a, struct heightfile *h, struct err *e)
{
    struct sdf s = {.path = path, .text = sdf_text(b), .e = e};
    if (!s.text) return sdf_binary(&s, b, a, h);
    s.there[SDF_COMPRESSION] = s.there[SDF_CHECK] = s.there[SDF_TYPE] = true; /* left out: 0, 0, floating point */
    s.value[SDF_TYPE] = 7;
    const char *data = sdf_lines(&s, b->at);
    if (!data || !sdf_counts(&s, b) || !sdf_header(&s, a, h) || !sdf_numbers(&s, data, h)) return false;
    h->bits = h->step > 0 ? h->bits : 0; /* floating point is as fine as it is written */
    h->format = "SDF (text)";
    return true;
}

/* ------------------------------------------------------------------ writing */

void heightfile_sdf_write(FILE *f, const struct heightfile *h, bool binary)
{
    char x[32], y[32];
    double pitch_y = h->rows > 1 && !isnan(h->pitch_y) ? h->pitch_y : 0;
    if (!binary) {
        fprintf(f,
                "aISO-1.0\nManufacID = rasp\nCreateDate = 010120000000\nModDate = 010120000000\nNumPoints = "
                "%zu\nNumProfiles = %zu\n"
                "Xscale = %s\nYscale = %s\nZscale = 1\nZresolution = -1\nCompression = 0\nDataType = 7\nCheckType = "
                "0\n*\n",
                h->columns, h->rows, heightfile_formats_number(x, h->pitch_x), heightfile_formats_number(y, pitch_y));
        for (size_t i = 0; i < h->columns * h->rows; i++)
            fprintf(f, "%s\n", isnan(h->z[i]) ? "BAD" : heightfile_formats_number(x, h->z[i]));
        fputs("*\n", f);
        return;
    }
    fwrite("bISO-1.0rasp\0\0\0\0\0\0"
           "010120000000010120000000",
           1, 42, f);
    bytes_put(f, h->columns, 2);
    bytes_put(f, h->rows, 2);
    const double scales[] = {h->pitch_x, pitch_y, 1, -1};
    for (int i = 0; i < 4; i++)
        bytes_put_f64(f, scales[i]);
    fwrite("\0\7\0", 1, 3, f);
    for (size_t i = 0; i < h->columns * h->rows; i++)
        bytes_put_f64(f, h->z[i]);
}
