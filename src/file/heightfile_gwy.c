/* Gwyddion's native format (gwyddion.net, "Gwyddion native file format"):

     "GWYP"  object "GwyContainer"
     object     name NUL, size u32 of what follows, components
     component  name NUL, type char, data

   b bool, c char, i int32, q int64, d float64, s text with NUL, o object; capitals are arrays: length u32, then the
   elements. All little-endian. A channel is a component "/N/data" with an object GwyDataField: xres, yres (samples),
   xreal, yreal (size), si_unit_xy, si_unit_z (objects with unitstr), data (float64, rows from the top). Its title is
   "/N/data/title", its mask the data field "/N/mask".

   Read: channel 0, or the first there is. Where the mask is above 0 the height counts as missing: Gwyddion so marks
   points that an instrument did not measure. Everything else in the file is passed over. */
#include "file/heightfile_formats.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

struct gwy {
    const char *path, *start;
    struct err *e;
};

/* A stretch of the file: the components of an object, or what is left of them. */
struct gwy_part {
    const char *at, *end;
};

struct gwy_item {
    const char *name;
    char type;
    const char *data; /* behind an array's length */
    size_t n;         /* bytes                    */
    size_t count;     /* of an array              */
};

struct gwy_field {
    bool given;
    long xres, yres;
    double xreal, yreal;
    const char *unit_xy, *unit_z;
    struct gwy_item data;
};

static bool gwy_bad(const struct gwy *g, const char *at, const char *what)
{
    return err_set(g->e, ERR_SCENE, "%s: GWY file, byte %td: %s", g->path, at - g->start, what);
}

/* A text with its NUL; NULL: it has no end. */
static const char *gwy_text(struct gwy_part *p)
{
    const char *s = p->at, *nul = memchr(s, '\0', (size_t)(p->end - s));
    if (!nul) return NULL;
    p->at = nul + 1;
    return s;
}

/* The name and the components of an object; p moves behind it. */
static bool gwy_object(const struct gwy *g, struct gwy_part *p, const char **name, struct gwy_part *inside)
{
    const char *from = p->at;
    *name = gwy_text(p);
    if (!*name || p->end - p->at < 4) return gwy_bad(g, from, "it is cut short: an object ends inside its head");
    size_t n = (size_t)bytes_word(p->at, 4);
    if ((size_t)(p->end - p->at) - 4 < n)
        return gwy_bad(g, p->at, "an object is larger than what is left of the file: it is cut short");
    *inside = (struct gwy_part){p->at + 4, p->at + 4 + n};
    p->at = inside->end;
    return true;
}

static bool gwy_item(const struct gwy *g, struct gwy_part *p, struct gwy_item *t)
{
    const char *from = p->at;
    t->name = gwy_text(p);
    if (!t->name || p->at == p->end) return gwy_bad(g, from, "it is cut short: a component ends inside its head");
    t->type = *p->at++;
    t->data = p->at;
    t->count = 1;
    if (!strchr("bciqdsoCIQDSO", t->type))
        return gwy_bad(g, p->at - 1, "a component's type is none that the format has");
    if (t->type < 'a') { /* an array, behind its length */
        if (p->end - p->at < 4) return gwy_bad(g, p->at, "an array ends inside its length");
        t->count = (size_t)bytes_word(p->at, 4);
        t->data = p->at += 4;
    }
    /* 0: texts and objects, whose size their contents say */
    size_t size = strchr("bcC", t->type) ? 1 : strchr("iI", t->type) ? 4 : strchr("qQdD", t->type) ? 8 : 0;
    for (size_t i = 0; size == 0 && i < t->count; i++) { /* passes over texts, or objects */
        const char *name;
        struct gwy_part inside;
        bool text = t->type == 's' || t->type == 'S';
        if (text ? !gwy_text(p) && !gwy_bad(g, p->at, "a text has no end") : !gwy_object(g, p, &name, &inside))
            return false;
    }
    if ((size_t)(p->end - p->at) / (size ? size : 1) < (size ? t->count : 0))
        return gwy_bad(g, p->at, "a component is larger than its object: the file is cut short or damaged");
    p->at += size * t->count;
    t->n = (size_t)(p->at - t->data);
    return true;
}

static bool gwy_unit(const struct gwy *g, struct gwy_item *t, const char **unit)
{
    struct gwy_part p = {t->data, t->data + t->n}, inside;
    const char *name;
    if (!gwy_object(g, &p, &name, &inside)) return false;
    while (inside.at < inside.end) {
        struct gwy_item u;
        if (!gwy_item(g, &inside, &u)) return false;
        if (!strcmp(u.name, "unitstr") && u.type == 's') *unit = u.data;
    }
    return true;
}

static bool gwy_take(const struct gwy *g, struct gwy_item *t, struct gwy_field *f)
{
    if (!strcmp(t->name, "xres") && t->type == 'i')
        f->xres = (int32_t)bytes_word(t->data, 4);
    else if (!strcmp(t->name, "yres") && t->type == 'i')
        f->yres = (int32_t)bytes_word(t->data, 4);
    else if (!strcmp(t->name, "xreal") && t->type == 'd')
        f->xreal = bytes_f64(t->data);
    else if (!strcmp(t->name, "yreal") && t->type == 'd')
        f->yreal = bytes_f64(t->data);
    else if (!strcmp(t->name, "data") && t->type == 'D')
        f->data = *t;
    else if (!strcmp(t->name, "si_unit_xy") && t->type == 'o')
        return gwy_unit(g, t, &f->unit_xy);
    else if (!strcmp(t->name, "si_unit_z") && t->type == 'o')
        return gwy_unit(g, t, &f->unit_z);
    return true;
}

/* The object of an item as a data field; one of another kind is none. */
static bool gwy_field(const struct gwy *g, const struct gwy_item *item, struct gwy_field *f)
{
    struct gwy_part p = {item->data, item->data + item->n}, inside;
    const char *name;
    if (item->type != 'o' || !gwy_object(g, &p, &name, &inside) || strcmp(name, "GwyDataField") != 0)
        return g->e->kind == ERR_NONE;
    *f = (struct gwy_field){.given = true, .unit_xy = "", .unit_z = ""};
    while (inside.at < inside.end) {
        struct gwy_item t;
        if (!gwy_item(g, &inside, &t) || !gwy_take(g, &t, f)) return false;
    }
    if (f->xres < 1 || f->yres < 1 || (size_t)f->xres * (size_t)f->yres != f->data.count)
        return err_set(g->e, ERR_SCENE, "%s: GWY file: the data field %s has %ld x %ld samples, and %zu are there",
                       g->path, item->name, f->xres, f->yres, f->data.count);
    return true;
}

/* The number N of a name "/N/what"; -1: not of that form. */
static long gwy_channel(const char *name, const char *what)
{
    size_t digits = name[0] == '/' ? strspn(name + 1, "0123456789") : 0;
    long n = 0;
    if (digits == 0 || digits > 6 || strcmp(name + 1 + digits, what) != 0) return -1;
    for (size_t i = 1; i <= digits; i++)
        n = 10 * n + (name[i] - '0');
    return n;
}

struct gwy_found {
    long channel;
    struct gwy_field field, mask;
    const char *title;
};

/* Which channel: 0 if there is one, else the first. */
static bool gwy_choose(const struct gwy *g, struct gwy_part p, struct gwy_found *found)
{
    struct gwy_item t;
    for (found->channel = -1; p.at < p.end && found->channel != 0;) {
        struct gwy_field f = {0};
        if (!gwy_item(g, &p, &t)) return false;
        long n = gwy_channel(t.name, "/data");
        if (n < 0 || (n > 0 && found->channel > 0)) continue;
        if (!gwy_field(g, &t, &f)) return false;
        if (f.given) {
            found->channel = n;
            found->field = f;
        }
    }
    return found->channel >= 0 ||
           err_set(g->e, ERR_SCENE,
                   "%s: the GWY file holds no image (no data field /0/data): graphs and spectra are no height maps",
                   g->path);
}

/* The channel's mask and title. */
static bool gwy_beside(const struct gwy *g, struct gwy_part p, struct gwy_found *found)
{
    struct gwy_item t;
    while (p.at < p.end) {
        if (!gwy_item(g, &p, &t)) return false;
        if (gwy_channel(t.name, "/mask") == found->channel && !gwy_field(g, &t, &found->mask)) return false;
        if (gwy_channel(t.name, "/data/title") == found->channel && t.type == 's') found->title = t.data;
    }
    if (found->mask.given && (found->mask.xres != found->field.xres || found->mask.yres != found->field.yres))
        return err_set(g->e, ERR_SCENE, "%s: GWY file: the mask has %ld x %ld samples and its data field %ld x %ld",
                       g->path, found->mask.xres, found->mask.yres, found->field.xres, found->field.yres);
    return true;
}

static bool gwy_heights(const struct gwy *g, const struct gwy_found *found, struct arena *a, struct heightfile *h)
{
    const struct gwy_field *f = &found->field;
    double xy, z;
    if (!heightfile_formats_unit(f->unit_xy, &xy) || !heightfile_formats_unit(f->unit_z, &z))
        return err_set(g->e, ERR_SCENE,
                       "%s: GWY file: the data field's units are '%s' and '%s', not lengths (m, mm, um, nm)", g->path,
                       f->unit_xy, f->unit_z);
    if (!(f->xreal > 0 && isfinite(f->xreal) && f->yreal > 0 && isfinite(f->yreal)))
        return err_set(g->e, ERR_SCENE, "%s: GWY file: the data field's size is %g x %g", g->path, f->xreal, f->yreal);
    *h = (struct heightfile){.columns = (size_t)f->xres,
                             .rows = (size_t)f->yres,
                             .pitch_x = f->xreal / xy / (double)f->xres,
                             .pitch_y = f->yreal / xy / (double)f->yres,
                             .metric = true,
                             .bits = 53,
                             .format = "GWY"};
    if (!heightfile_room(g->path, h, a, g->e)) return false;
    for (size_t i = 0; i < f->data.count; i++) {
        bool masked = found->mask.given && bytes_f64(found->mask.data.data + 8 * i) > 0;
        h->z[i] = masked ? NAN : bytes_f64(f->data.data + 8 * i) / z;
    }
    h->title = found->title ? arena_text(a, found->title) : NULL;
    return true;
}

bool heightfile_gwy_is(const struct bytes *b) { return b->n >= 4 && !memcmp(b->at, "GWYP", 4); }

bool heightfile_gwy_read(const char *path, const struct bytes *b, struct arena *a, struct heightfile *h, struct err *e)
{
    struct gwy g = {path, b->at, e};
    struct gwy_part p = {b->at + 4, b->at + b->n}, inside;
    struct gwy_found found = {0};
    const char *name;
    if (!gwy_object(&g, &p, &name, &inside)) return false;
    if (strcmp(name, "GwyContainer") != 0) return gwy_bad(&g, b->at + 4, "the file does not begin with a GwyContainer");
    return gwy_choose(&g, inside, &found) && gwy_beside(&g, inside, &found) && gwy_heights(&g, &found, a, h);
}

/* Writing Gwyddion's native format: see heightfile_gwy.c. Sizes stand before what they measure, so they are added up
 * first. */

enum {
    GWY_UNIT = 10 + 4 + 8 + 1 + 2, /* "GwySIUnit" size; "unitstr" s "m"          */
    GWY_FIELD = 5 + 5 + 5 + 5 + 6 + 9 + 6 + 9 + (11 + 1) + (10 + 1) + 5 + 1 +
                4 /* names with their NULs, types, numbers, length */
};

static size_t gwy_field_size(const struct heightfile *h)
{
    return GWY_FIELD + 2 * (size_t)GWY_UNIT + 8 * h->columns * h->rows;
}

/* Of the container: a component is name, type, object (name, size, contents). */
static size_t gwy_all(const struct heightfile *h)
{
    size_t field = 1 + sizeof "GwyDataField" + 4 + gwy_field_size(h);
    return sizeof "/0/data" + field + (h->holes ? sizeof "/0/mask" + field : 0) +
           (h->title ? sizeof "/0/data/title" + 1 + strlen(h->title) + 1 : 0);
}

bool heightfile_gwy_write_fits(const struct heightfile *h) { return gwy_all(h) <= UINT32_MAX; }

static void gwy_put_text(FILE *f, const char *s) { fwrite(s, 1, strlen(s) + 1, f); }

static void gwy_put_head(FILE *f, const char *name, char type)
{
    gwy_put_text(f, name);
    fputc(type, f);
}

static void gwy_put_i(FILE *f, const char *name, size_t v)
{
    gwy_put_head(f, name, 'i');
    bytes_put(f, v, 4);
}

static void gwy_put_d(FILE *f, const char *name, double v)
{
    gwy_put_head(f, name, 'd');
    bytes_put_f64(f, v);
}

static void gwy_put_unit(FILE *f, const char *name, const char *unit)
{
    gwy_put_head(f, name, 'o');
    gwy_put_text(f, "GwySIUnit");
    bytes_put(f, 8 + 1 + 2, 4);
    gwy_put_head(f, "unitstr", 's');
    gwy_put_text(f, unit);
}

static void gwy_put_field(FILE *f, const char *name, const struct heightfile *h, bool mask)
{
    size_t n = h->columns * h->rows;
    gwy_put_head(f, name, 'o');
    gwy_put_text(f, "GwyDataField");
    bytes_put(f, gwy_field_size(h), 4);
    gwy_put_i(f, "xres", h->columns);
    gwy_put_i(f, "yres", h->rows);
    gwy_put_d(f, "xreal", h->pitch_x * (double)h->columns);
    gwy_put_d(f, "yreal", (h->rows > 1 ? h->pitch_y : h->pitch_x) * (double)h->rows);
    gwy_put_unit(f, "si_unit_xy", "m");
    gwy_put_unit(f, "si_unit_z", "m");
    gwy_put_head(f, "data", 'D');
    bytes_put(f, n, 4);
    for (size_t i = 0; i < n; i++)
        bytes_put_f64(f, mask ? (isnan(h->z[i]) ? 1 : 0) : isnan(h->z[i]) ? 0 : h->z[i]);
}

void heightfile_gwy_write(FILE *f, const struct heightfile *h)
{
    fwrite("GWYP", 1, 4, f);
    gwy_put_text(f, "GwyContainer");
    bytes_put(f, gwy_all(h), 4);
    gwy_put_field(f, "/0/data", h, false);
    if (h->title) {
        gwy_put_head(f, "/0/data/title", 's');
        gwy_put_text(f, h->title);
    }
    if (h->holes) gwy_put_field(f, "/0/mask", h, true);
}
