/* NPY, NumPy's array format (numpy.lib.format):

     "\x93NUMPY"  major  minor  length (2 bytes, little-endian; 4 from version 2 on)  header  data

   The header is a Python dictionary in ASCII with the keys 'descr' (such as '<f8'), 'fortran_order' (False: rows one after the
   other) and 'shape', padded with blanks. The data must fill the rest of the file exactly. */
#include "file/heightfile_npy.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

struct npy {
    const char *path, *at, *start, *end; /* of the file's bytes; at .. end: what is left of the header */
    char descr[16];
    bool has_descr, has_order, has_shape, fortran;
    size_t shape[2], dimensions;
    struct err *e;
};

static bool npy_bad(const struct npy *p, const char *what)
{
    return err_set(p->e, ERR_SCENE, "%s: NPY header, byte %td: %s", p->path, p->at - p->start, what);
}

static void npy_blanks(struct npy *p)
{
    while (p->at < p->end && strchr(" \t\r\n", *p->at))
        p->at++;
}

static bool npy_next(struct npy *p, char c)
{
    npy_blanks(p);
    if (p->at == p->end || *p->at != c)
        return false;
    p->at++;
    return true;
}

static bool npy_word(struct npy *p, const char *word)
{
    size_t n = strlen(word);
    npy_blanks(p);
    if ((size_t)(p->end - p->at) < n || memcmp(p->at, word, n) != 0)
        return false;
    p->at += n;
    return true;
}

/* A string in single or double quotes, without escapes. */
static bool npy_string(struct npy *p, char text[16])
{
    npy_blanks(p);
    const char *s = p->at + 1, *close = NULL;
    if (p->at < p->end && (*p->at == '\'' || *p->at == '"'))
        close = memchr(s, *p->at, (size_t)(p->end - s));
    if (!close || close - s > 15)
        return false;
    memcpy(text, s, (size_t)(close - s));
    text[close - s] = '\0';
    p->at = close + 1;
    return true;
}

static bool npy_size(struct npy *p, size_t *n)
{
    npy_blanks(p);
    const char *first = p->at;
    *n = 0;
    for (; p->at < p->end && *p->at >= '0' && *p->at <= '9'; p->at++)
        if (__builtin_mul_overflow(*n, (size_t)10, n) || __builtin_add_overflow(*n, (size_t)(*p->at - '0'), n))
            return npy_bad(p, "the shape is too large");
    return p->at > first || npy_bad(p, "a size in the shape is not a whole number");
}

static bool npy_shape(struct npy *p)
{
    if (!npy_next(p, '('))
        return npy_bad(p, "'shape' is not a tuple");
    while (!npy_next(p, ')')) {
        if (p->dimensions == 2)
            return npy_bad(p, "the array has more than two dimensions; a height map has one (a profile) or two");
        if (!npy_size(p, &p->shape[p->dimensions++]))
            return false;
        if (!npy_next(p, ',') && (p->at == p->end || *p->at != ')'))
            return npy_bad(p, "the shape is not a list of sizes");
    }
    return p->dimensions > 0 || npy_bad(p, "the array has no dimension: it is a single number");
}

static bool npy_value(struct npy *p, const char *key)
{
    if (!strcmp(key, "descr")) {
        p->has_descr = true;
        return npy_string(p, p->descr) || npy_bad(p, "'descr' is not a plain number type; save the array as float64");
    }
    if (!strcmp(key, "fortran_order")) {
        p->has_order = true;
        p->fortran = npy_word(p, "True");
        return p->fortran || npy_word(p, "False") || npy_bad(p, "'fortran_order' is neither True nor False");
    }
    p->has_shape = true;
    return strcmp(key, "shape") ? npy_bad(p, "a key that is not 'descr', 'fortran_order' or 'shape'") : npy_shape(p);
}

static bool npy_dictionary(struct npy *p)
{
    char key[16];
    if (!npy_next(p, '{'))
        return npy_bad(p, "a dictionary should begin here");
    while (!npy_next(p, '}')) {
        if (!npy_string(p, key) || !npy_next(p, ':'))
            return npy_bad(p, "a quoted key and a colon should stand here");
        if (!npy_value(p, key))
            return false;
        npy_blanks(p);
        if (!npy_next(p, ',') && (p->at == p->end || *p->at != '}'))
            return npy_bad(p, "a comma or the end of the dictionary should stand here");
    }
    npy_blanks(p);
    if (p->at != p->end)
        return npy_bad(p, "text after the dictionary");
    return (p->has_descr && p->has_order && p->has_shape) || npy_bad(p, "'descr', 'fortran_order' or 'shape' is missing");
}

/* The bytes of one number, lowest first, as unsigned. */
static uint64_t npy_word_at(const unsigned char *p, size_t size, bool big)
{
    uint64_t v = 0;
    for (size_t i = 0; i < size; i++)
        v = v << 8 | p[big ? i : size - 1 - i];
    return v;
}

static double npy_f4(uint64_t w)
{
    uint32_t half = (uint32_t)w;
    float v;
    memcpy(&v, &half, 4);
    return v;
}

static double npy_f8(uint64_t w)
{
    double v;
    memcpy(&v, &w, 8);
    return v;
}

static double npy_i2(uint64_t w) { return (int16_t)w; }
static double npy_u2(uint64_t w) { return (uint16_t)w; }
static double npy_i4(uint64_t w) { return (int32_t)w; }

static const struct npy_type {
    char name[3];
    size_t size;
    double (*value)(uint64_t);
    int bits;
    double step;
} npy_types[] = {{"f4", 4, npy_f4, 24, 0}, {"f8", 8, npy_f8, 53, 0}, {"i2", 2, npy_i2, 16, 1}, {"u2", 2, npy_u2, 16, 1}, {"i4", 4, npy_i4, 32, 1}};

static const struct npy_type *npy_type(const struct npy *p)
{
    for (size_t i = 0; i < sizeof npy_types / sizeof npy_types[0]; i++)
        if (strchr("<>", p->descr[0]) && !strcmp(p->descr + 1, npy_types[i].name))
            return &npy_types[i];
    err_set(p->e, ERR_SCENE, "%s: NPY numbers of type '%s'; f4, f8, i2, u2 and i4 are read: save the array as float64", p->path, p->descr);
    return NULL;
}

static bool npy_data(const struct npy *p, struct arena *a, struct heightfile *h)
{
    const struct npy_type *type = npy_type(p);
    size_t n, bytes, there = (size_t)(p->end - p->at);
    if (!type)
        return false;
    h->rows = p->dimensions == 2 ? p->shape[0] : 1;
    h->columns = p->shape[p->dimensions - 1];
    if (h->rows == 0 || h->columns == 0)
        return err_set(p->e, ERR_SCENE, "%s: the array is empty (%zu x %zu)", p->path, h->rows, h->columns);
    if (__builtin_mul_overflow(h->rows, h->columns, &n) || __builtin_mul_overflow(n, type->size, &bytes) || bytes != there)
        return err_set(p->e, ERR_SCENE, "%s: %zu x %zu numbers of %zu bytes should follow byte %td, and %zu bytes do", p->path, h->rows,
                       h->columns, type->size, p->at - p->start, there);
    if (!heightfile_room(p->path, h, a, p->e))
        return false;
    h->format = "NPY";
    h->bits = type->bits;
    h->step = type->step;
    for (size_t i = 0; i < n; i++)
        h->z[i] = type->value(npy_word_at((const unsigned char *)p->at + i * type->size, type->size, p->descr[0] == '>'));
    return true;
}

bool heightfile_npy_is(const struct bytes *b)
{
    return b->n >= 6 && !memcmp(b->at, "\x93NUMPY", 6);
}

/* Finds the header: at .. end. */
static bool npy_open(struct npy *p, const struct bytes *b)
{
    const unsigned char *u = (const unsigned char *)b->at;
    size_t version = b->n > 6 ? u[6] : 0, width = version == 1 ? 2 : 4;
    if (version < 1 || version > 3)
        return err_set(p->e, ERR_SCENE, "%s: NPY version %zu; 1, 2 and 3 are read", p->path, version);
    size_t length = b->n >= 8 + width ? (size_t)npy_word_at(u + 8, width, false) : b->n;
    if (length > b->n - (b->n >= 8 + width ? 8 + width : 0) || b->n < 8 + width)
        return err_set(p->e, ERR_SCENE, "%s: the file ends inside its NPY header, at byte %zu", p->path, b->n);
    p->at = b->at + 8 + width;
    p->end = p->at + length;
    return true;
}

bool heightfile_npy_read(const char *path, const struct bytes *b, struct arena *a, struct heightfile *h, struct err *e)
{
    struct npy p = {.path = path, .start = b->at, .e = e};
    if (!npy_open(&p, b) || !npy_dictionary(&p))
        return false;
    if (p.fortran && p.dimensions == 2)
        return err_set(e, ERR_SCENE, "%s: the array is in Fortran order; save numpy.ascontiguousarray(z) instead", path);
    p.end = b->at + b->n;
    h->pitch_x = h->pitch_y = NAN;
    return npy_data(&p, a, h);
}
