/* Gwyddion Simple Field 1.0 (gwyddion.net, "Gwyddion simple field files"):

     "Gwyddion Simple Field 1.0\n"  lines "name = value\n"  1 to 4 NUL bytes, so that the data begin at a multiple of 4
     XRes * YRes float32, little-endian, row by row

   XRes, YRes: numbers of columns and rows, must be there. XReal, YReal: width and height in XYUnits; the format's
   default of 1 is no size anyone measured, so a file without them does not say its pitch. ZUnits: of the heights.
   Without units: metres. NaN: missing. Other names (XOffset ...) do not matter here. */
#include "file/heightfile_gsf.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "file/heightfile_unit.h"

static const char gsf_magic[] = "Gwyddion Simple Field 1.0";

enum { GSF_XRES, GSF_YRES, GSF_XREAL, GSF_YREAL, GSF_XYUNITS, GSF_ZUNITS, GSF_TITLE, GSF_NAMES };

static const char *const gsf_names[GSF_NAMES] = {"XRes", "YRes", "XReal", "YReal", "XYUnits", "ZUnits", "Title"};

struct gsf {
    const char *path;
    const char *value[GSF_NAMES]; /* NULL: not there */
    int line[GSF_NAMES];
    const char *end; /* of the header: its first NUL */
    struct err *e;
};

static char *gsf_trim(char *s)
{
    s += strspn(s, " \t");
    size_t n = strlen(s);
    while (n > 0 && strchr(" \t", s[n - 1]))
        s[--n] = '\0';
    return s;
}

static bool gsf_line(struct gsf *g, char *s, int line)
{
    char *equals = strchr(s, '=');
    if (strchr(s, '\r'))
        return err_set(g->e, ERR_SCENE, "%s: GSF header, line %d: the line ends in CR LF; the format wants LF alone",
                       g->path, line);
    if (!equals)
        return err_set(g->e, ERR_SCENE, "%s: GSF header, line %d: '%.40s' is not of the form name = value", g->path,
                       line, s);
    *equals = '\0';
    for (int i = 0; i < GSF_NAMES; i++) {
        if (strcmp(gsf_trim(s), gsf_names[i]) != 0) continue;
        if (g->value[i])
            return err_set(g->e, ERR_SCENE, "%s: GSF header, line %d: %s is there already, in line %d", g->path, line,
                           gsf_names[i], g->line[i]);
        g->value[i] = gsf_trim(equals + 1);
        g->line[i] = line;
    }
    return true;
}

/* Takes the header apart; it ends at the first NUL. */
static bool gsf_header(struct gsf *g, char *at)
{
    int line = 2;
    g->end = at;
    for (char *s = at, *stop; *s; s = stop + 1, line++) {
        stop = strchr(s, '\n');
        if (!stop) return err_set(g->e, ERR_SCENE, "%s: GSF header, line %d: the line has no end", g->path, line);
        *stop = '\0';
        if (*gsf_trim(s) && !gsf_line(g, s, line)) return false;
        g->end = stop + 1;
    }
    return true;
}

static bool gsf_bad(const struct gsf *g, int name, const char *wants)
{
    return err_set(g->e, ERR_SCENE, "%s: GSF header, line %d: %s is '%s', not %s", g->path, g->line[name],
                   gsf_names[name], g->value[name], wants);
}

static bool gsf_resolution(const struct gsf *g, int name, size_t *n)
{
    const char *s = g->value[name];
    if (!s) return err_set(g->e, ERR_SCENE, "%s: the GSF header has no %s", g->path, gsf_names[name]);
    if (!*s || strspn(s, "0123456789") != strlen(s) || strlen(s) > 9 || strtol(s, NULL, 10) == 0)
        return gsf_bad(g, name, "a whole number from 1 to 999999999");
    *n = (size_t)strtol(s, NULL, 10);
    return true;
}

/* How many of the unit make a metre. */
static bool gsf_unit(const struct gsf *g, int name, double *per_metre)
{
    return heightfile_unit(g->value[name] ? g->value[name] : "", per_metre) ||
           gsf_bad(g, name, "a length (m, mm, um, nm)");
}

static bool gsf_pitch(const struct gsf *g, int name, size_t n, double *pitch)
{
    const char *s = g->value[name];
    char *end;
    double per_metre;
    *pitch = NAN;
    if (!gsf_unit(g, GSF_XYUNITS, &per_metre)) return false;
    if (!s) return true;
    double size = strtod(s, &end);
    if (!*s || *end || !isfinite(size) || size <= 0) return gsf_bad(g, name, "a positive number");
    *pitch = size / per_metre / (double)n;
    return true;
}

static bool gsf_data(const struct gsf *g, const struct bytes *b, struct arena *a, struct heightfile *h)
{
    double per_metre;
    size_t header = (size_t)(g->end - b->at), n = h->rows * h->columns; /* both below 1e9: no overflow */
    size_t start = header + 4 - header % 4, there = b->n > start ? b->n - start : 0;
    if (!gsf_unit(g, GSF_ZUNITS, &per_metre)) return false;
    for (size_t i = header; i < start; i++)
        if (i >= b->n || b->at[i])
            return err_set(g->e, ERR_SCENE, "%s: %zu NUL bytes should follow the GSF header at byte %zu, and %zu do",
                           g->path, start - header, header, i - header);
    if (b->n < start || there != 4 * n)
        return err_set(g->e, ERR_SCENE, "%s: %zu x %zu float32 (%zu bytes) should follow byte %zu, and %zu bytes do",
                       g->path, h->columns, h->rows, 4 * n, start, there);
    if (!heightfile_room(g->path, h, a, g->e)) return false;
    for (size_t i = 0; i < n; i++)
        h->z[i] = heightfile_unit_f32(b->at + start + 4 * i) / per_metre;
    h->title = g->value[GSF_TITLE] ? arena_text(a, g->value[GSF_TITLE]) : NULL;
    h->format = "GSF";
    h->metric = true;
    h->bits = 24;
    return true;
}

bool heightfile_gsf_is(const struct bytes *b)
{
    return b->n >= 22 && !memcmp(b->at, gsf_magic, 22); /* up to the version */
}

bool heightfile_gsf_read(const char *path, const struct bytes *b, struct arena *a, struct heightfile *h, struct err *e)
{
    struct gsf g = {.path = path, .e = e};
    size_t n = strlen(gsf_magic);
    if (b->n <= n || memcmp(b->at, gsf_magic, n) != 0 || b->at[n] != '\n')
        return err_set(e, ERR_SCENE, "%s: GSF header, line 1: is not '%s' with a line feed%s", path, gsf_magic,
                       b->n > n && b->at[n] == '\r' ? " (it ends in CR LF)" : "");
    if (!memchr(b->at, '\0', b->n))
        return err_set(e, ERR_SCENE, "%s: the GSF header has no end: no NUL byte follows it", path);
    return gsf_header(&g, b->at + n + 1) && gsf_resolution(&g, GSF_XRES, &h->columns) &&
           gsf_resolution(&g, GSF_YRES, &h->rows) && gsf_pitch(&g, GSF_XREAL, h->columns, &h->pitch_x) &&
           gsf_pitch(&g, GSF_YREAL, h->rows, &h->pitch_y) && gsf_data(&g, b, a, h);
}
