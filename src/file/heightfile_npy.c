/* Heights from NPY (npy.h): an array of one or two dimensions, of plain numbers. The data must fill the rest of the
 * file exactly. */
#include "file/heightfile_npy.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "file/npy.h"

struct npy_heights {
    const char *path, *at, *start, *end; /* of the file's bytes; at .. end: the numbers */
    struct npy head;
    struct err *e;
};

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
} npy_types[] = {{"f4", 4, npy_f4, 24, 0},
                 {"f8", 8, npy_f8, 53, 0},
                 {"i2", 2, npy_i2, 16, 1},
                 {"u2", 2, npy_u2, 16, 1},
                 {"i4", 4, npy_i4, 32, 1}};

static const struct npy_type *npy_type(const struct npy_heights *p)
{
    for (size_t i = 0; i < sizeof npy_types / sizeof npy_types[0]; i++)
        if (strchr("<>", p->head.descr[0]) && !strcmp(p->head.descr + 1, npy_types[i].name)) return &npy_types[i];
    err_set(p->e, ERR_SCENE, "%s: NPY numbers of type '%s'; f4, f8, i2, u2 and i4 are read: save the array as float64",
            p->path, p->head.descr);
    return NULL;
}

static bool npy_data(const struct npy_heights *p, struct arena *a, struct heightfile *h)
{
    const struct npy_type *type = npy_type(p);
    size_t n, bytes, there = (size_t)(p->end - p->at);
    if (!type) return false;
    h->rows = p->head.dimensions == 2 ? p->head.shape[0] : 1;
    h->columns = p->head.shape[p->head.dimensions - 1];
    if (h->rows == 0 || h->columns == 0)
        return err_set(p->e, ERR_SCENE, "%s: the array is empty (%zu x %zu)", p->path, h->rows, h->columns);
    if (__builtin_mul_overflow(h->rows, h->columns, &n) || __builtin_mul_overflow(n, type->size, &bytes) ||
        bytes != there)
        return err_set(p->e, ERR_SCENE, "%s: %zu x %zu numbers of %zu bytes should follow byte %td, and %zu bytes do",
                       p->path, h->rows, h->columns, type->size, p->at - p->start, there);
    if (!heightfile_room(p->path, h, a, p->e)) return false;
    h->format = "NPY";
    h->bits = type->bits;
    h->step = type->step;
    if (!strcmp(p->head.descr, "<f8")) { /* as in memory: rasp is for x86-64 */
        memcpy(h->z, p->at, bytes);
        return true;
    }
    for (size_t i = 0; i < n; i++)
        h->z[i] = type->value(
            npy_word_at((const unsigned char *)p->at + i * type->size, type->size, p->head.descr[0] == '>'));
    return true;
}

bool heightfile_npy_read(const char *path, const struct bytes *b, struct arena *a, struct heightfile *h, struct err *e)
{
    struct npy_heights p = {.path = path, .start = b->at, .end = b->at + b->n, .e = e};
    if (!npy_read(path, b, a, &p.head, e)) return false;
    if (p.head.n_fields)
        return err_set(e, ERR_SCENE,
                       "%s: a table of %zu fields, not an array of plain numbers; save one of them, as in "
                       "numpy.save(file, t['%s'])",
                       path, p.head.n_fields, p.head.fields[0]);
    p.at = b->at + p.head.data;
    h->pitch_x = h->pitch_y = NAN;
    return npy_data(&p, a, h);
}
