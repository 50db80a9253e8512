/* NPY, NumPy's array format (numpy.lib.format):

     "\x93NUMPY"  major  minor  length (2 bytes, little-endian; 4 from version 2 on)  header  data

   The header is a Python dictionary in ASCII with the keys 'descr' (such as '<f8', or of a table a list of its fields,
   [('time_s', '<f8'), ...]), 'fortran_order' (False: rows one after the other) and 'shape', padded with blanks.
   Written: version 1.0, the data at a multiple of 64. */
#include "file/npy.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

struct npy_reader {
    const char *path, *at, *start, *end; /* of the file's bytes; at .. end: what is left of the header */
    bool has_descr, has_order, has_shape;
    struct npy *to;
    struct arena *arena;
    struct err *e;
};

static bool npy_bad(const struct npy_reader *p, const char *what)
{
    return err_set(p->e, ERR_SCENE, "%s: NPY header, byte %td: %s: write the file anew (numpy.save)", p->path,
                   p->at - p->start, what);
}

static void npy_blanks(struct npy_reader *p)
{
    while (p->at < p->end && strchr(" \t\r\n", *p->at))
        p->at++;
}

static bool npy_next(struct npy_reader *p, char c)
{
    npy_blanks(p);
    if (p->at == p->end || *p->at != c) return false;
    p->at++;
    return true;
}

static bool npy_word(struct npy_reader *p, const char *word)
{
    size_t n = strlen(word);
    npy_blanks(p);
    if ((size_t)(p->end - p->at) < n || memcmp(p->at, word, n) != 0) return false;
    p->at += n;
    return true;
}

/* A string in single or double quotes, without escapes. */
static bool npy_string(struct npy_reader *p, char text[NPY_NAME])
{
    npy_blanks(p);
    const char *s = p->at + 1, *close = NULL;
    if (p->at < p->end && (*p->at == '\'' || *p->at == '"')) close = memchr(s, *p->at, (size_t)(p->end - s));
    if (!close || close - s >= NPY_NAME) return false;
    memcpy(text, s, (size_t)(close - s));
    text[close - s] = '\0';
    p->at = close + 1;
    return true;
}

static bool npy_shape(struct npy_reader *p)
{
    if (!npy_next(p, '(')) return npy_bad(p, "'shape' is not a tuple");
    while (!npy_next(p, ')')) {
        if (p->to->dimensions == 2)
            return npy_bad(p, "the array has more than two dimensions; a height map has one (a profile) or two");
        size_t *n = &p->to->shape[p->to->dimensions++];
        npy_blanks(p);
        const char *first = p->at;
        *n = 0;
        for (; p->at < p->end && *p->at >= '0' && *p->at <= '9'; p->at++)
            if (__builtin_mul_overflow(*n, (size_t)10, n) || __builtin_add_overflow(*n, (size_t)(*p->at - '0'), n))
                return npy_bad(p, "the shape is too large");
        if (p->at == first) return npy_bad(p, "a size in the shape is not a whole number");
        if (!npy_next(p, ',') && (p->at == p->end || *p->at != ')'))
            return npy_bad(p, "the shape is not a list of sizes");
    }
    return p->to->dimensions > 0 || npy_bad(p, "the array has no dimension: it is a single number");
}

/* Behind [: ('time_s', '<f8'), ... ]; the names are kept. */
static bool npy_fields(struct npy_reader *p)
{
    char name[NPY_NAME], type[NPY_NAME];
    while (!npy_next(p, ']')) {
        if (!npy_next(p, '(') || !npy_string(p, name) || !npy_next(p, ',') || !npy_string(p, type) || !npy_next(p, ')'))
            return npy_bad(p, "a field should stand here, as in ('time_s', '<f8')");
        if (strcmp(type, "<f8") != 0)
            return npy_bad(p, "a field that is not of the type '<f8'; save the table with fields of float64");
        if (p->to->n_fields == NPY_FIELDS) return npy_bad(p, "more than 1000 fields");
        p->to->fields[p->to->n_fields++] = arena_text(p->arena, name);
        if (!npy_next(p, ',') && (p->at == p->end || *p->at != ']'))
            return npy_bad(p, "a comma or the end of the list of fields should stand here");
    }
    return p->to->n_fields > 0 || npy_bad(p, "a list without fields");
}

static bool npy_value(struct npy_reader *p, const char *key)
{
    if (!strcmp(key, "descr")) {
        p->has_descr = true;
        p->to->descr[0] = '\0';
        p->to->n_fields = 0;
        if (npy_next(p, '[')) return npy_fields(p);
        return npy_string(p, p->to->descr) ||
               npy_bad(p, "'descr' is not a plain number type; save the array as float64");
    }
    if (!strcmp(key, "fortran_order")) {
        p->has_order = true;
        p->to->fortran = npy_word(p, "True");
        return p->to->fortran || npy_word(p, "False") || npy_bad(p, "'fortran_order' is neither True nor False");
    }
    p->has_shape = true;
    return strcmp(key, "shape") ? npy_bad(p, "a key that is not 'descr', 'fortran_order' or 'shape'") : npy_shape(p);
}

static bool npy_dictionary(struct npy_reader *p)
{
    char key[NPY_NAME];
    if (!npy_next(p, '{')) return npy_bad(p, "a dictionary should begin here");
    while (!npy_next(p, '}')) {
        if (!npy_string(p, key) || !npy_next(p, ':')) return npy_bad(p, "a quoted key and a colon should stand here");
        if (!npy_value(p, key)) return false;
        npy_blanks(p);
        if (!npy_next(p, ',') && (p->at == p->end || *p->at != '}'))
            return npy_bad(p, "a comma or the end of the dictionary should stand here");
    }
    npy_blanks(p);
    if (p->at != p->end) return npy_bad(p, "text after the dictionary");
    return (p->has_descr && p->has_order && p->has_shape) ||
           npy_bad(p, "'descr', 'fortran_order' or 'shape' is missing");
}

bool npy_is(const struct bytes *b) { return b->n >= 6 && !memcmp(b->at, "\x93NUMPY", 6); }

bool npy_read(const char *path, const struct bytes *b, struct arena *a, struct npy *to, struct err *e)
{
    struct npy_reader p = {.path = path, .start = b->at, .to = to, .arena = a, .e = e};
    *to = (struct npy){.fields = ARENA_TAKE(a, const char *, NPY_FIELDS)};
    const unsigned char *u = (const unsigned char *)b->at;
    size_t version = b->n > 6 ? u[6] : 0, width = version == 1 ? 2 : 4;
    if (version < 1 || version > 3)
        return err_set(e, ERR_SCENE, "%s: NPY version %zu; 1, 2 and 3 are read", path, version);
    bool whole = b->n >= 8 + width;
    size_t length = whole ? (size_t)bytes_word(u + 8, width) : 0;
    if (!whole || length > b->n - 8 - width)
        return err_set(e, ERR_SCENE,
                       "%s: the file ends inside its NPY header, at byte %zu: write the file anew (numpy.save)", path,
                       b->n);
    p.at = b->at + 8 + width;
    p.end = p.at + length;
    if (!npy_dictionary(&p)) return false;
    if (to->fortran && to->dimensions == 2)
        return err_set(e, ERR_SCENE, "%s: the array is in Fortran order; save numpy.ascontiguousarray(z) instead",
                       path);
    to->data = (size_t)(p.end - b->at);
    return true;
}

/* The header of that dictionary, which ends in a line feed at a multiple of 64. */
static void npy_put(FILE *f, const char *text)
{
    size_t length = (10 + strlen(text) + 1 + 63) / 64 * 64 - 10;
    fwrite("\x93NUMPY\1\0", 1, 8, f);
    bytes_put(f, length, 2);
    fprintf(f, "%-*s\n", (int)length - 1, text);
}

void npy_write(FILE *f, const char *const *fields, size_t n, size_t rows)
{
    char text[NPY_HEADER];
    size_t used = (size_t)snprintf(text, sizeof text, "{'descr': [");
    for (size_t i = 0; i < n; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, "%s('%s', '<f8')", i ? ", " : "", fields[i]);
    snprintf(text + used, sizeof text - used, "], 'fortran_order': False, 'shape': (%zu,), }", rows);
    npy_put(f, text);
}

void npy_write_array(FILE *f, size_t rows, size_t columns)
{
    char text[192], first[32] = "";
    if (rows > 1) snprintf(first, sizeof first, "%zu, ", rows);
    snprintf(text, sizeof text, "{'descr': '<f8', 'fortran_order': False, 'shape': (%s%zu%s), }", first, columns,
             rows > 1 ? "" : ",");
    npy_put(f, text);
}
