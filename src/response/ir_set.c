/* A folder of responses and where they were measured: index.csv, one row per WAV,

       file_name,x_m,y_m[,z_m][,gain_db]

   file_name relative to the folder and inside it; x_m, y_m in the surface's coordinates; z_m, if there is one, 0
   (places lie in the plane); gain_db is applied to the samples (a microphone's gain undone, say). Rates and lengths may
   differ. One row holds everywhere. */
#include "response/ir_set.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "file/csv.h"
#include "num/real.h"
#include "num/scaled.h"

enum { FILE_NAME, X, Y, Z, GAIN, COLUMNS };
static const char *const names[COLUMNS] = {"file_name", "x_m", "y_m", "z_m", "gain_db"};
static const double most_gain = 200.0; /* dB */

struct reader {
    const struct ir_ask *ask;
    struct csv table;
    int column[COLUMNS];
    struct arena *arena;
    struct err *e;
};

static bool at(const struct reader *r, size_t row) { return err_at(r->e, "%s:%d", r->table.file, r->table.lines[row]); }

static const char *cell(const struct reader *r, size_t row, int what)
{
    return r->table.cells[row * r->table.columns + (size_t)r->column[what]];
}

static bool find_columns(struct reader *r)
{
    for (int c = 0; c < COLUMNS; c++) {
        r->column[c] = csv_column(&r->table, names[c]);
        if (r->column[c] < 0 && c <= Y)
            return err_set(r->e, ERR_SCENE,
                           "%s: no column '%s'; its columns are file_name,x_m,y_m and, if you like, z_m and gain_db",
                           r->table.file, names[c]);
    }
    for (size_t k = 0; k < r->table.columns; k++) {
        bool known = false;
        for (int c = 0; c < COLUMNS; c++)
            known = known || r->column[c] == (int)k;
        if (!known)
            return err_set(
                r->e, ERR_SCENE,
                "%s: column '%s' is not known; the columns are file_name,x_m,y_m and, if you like, z_m and gain_db",
                r->table.file, r->table.names[k]);
    }
    return r->table.rows > 0 || err_set(r->e, ERR_SCENE, "%s: has no rows; name at least one response", r->table.file);
}

/* Whether a component of the path is "..", or it starts at the root. */
static bool leaves(const char *name)
{
    if (name[0] == '/') return true;
    for (const char *part = name; part; part = strchr(part, '/') ? strchr(part, '/') + 1 : NULL)
        if (strncmp(part, "..", 2) == 0 && (part[2] == '/' || part[2] == '\0')) return true;
    return false;
}

static bool check_name(const struct reader *r, size_t row)
{
    const char *name = cell(r, row, FILE_NAME);
    if (name[0] == '\0') return err_set(r->e, ERR_SCENE, "file_name is empty") || at(r, row);
    if (leaves(name))
        return err_set(r->e, ERR_SCENE, "'%s' leads out of the folder; name a file inside it", name) || at(r, row);
    for (size_t other = 0; other < row; other++)
        if (strcmp(cell(r, other, FILE_NAME), name) == 0)
            return err_set(r->e, ERR_SCENE, "'%s' is in line %d already; a response has one place", name,
                           r->table.lines[other]) ||
                   at(r, row);
    return true;
}

static bool number(const struct reader *r, size_t row, int what, double *value)
{
    *value = 0.0;
    return r->column[what] < 0 || csv_number(&r->table, row, r->column[what], value, r->e);
}

static bool read_place(const struct reader *r, size_t row, double xy[2])
{
    double z;
    if (!number(r, row, X, &xy[0]) || !number(r, row, Y, &xy[1]) || !number(r, row, Z, &z)) return false;
    return z == 0.0 || err_set(r->e, ERR_SCENE, "z_m is %g; places lie in the surface's plane, where it is 0", z) ||
           at(r, row);
}

static bool read_response(const struct reader *r, size_t row, struct ir *ir)
{
    double gain;
    if (!number(r, row, GAIN, &gain)) return false;
    if (fabs(gain) > most_gain)
        return err_set(r->e, ERR_SCENE, "gain_db is %g; it lies between -200 and 200 dB", gain) || at(r, row);
    struct ir_ask one = *r->ask;
    one.path = arena_format(r->arena, "%s/%s", r->ask->path, cell(r, row, FILE_NAME));
    if (!ir_read(&one, r->arena, ir, r->e)) return at(r, row);
    if (gain != 0.0) {
        double *h = ARENA_TAKE(r->arena, double, ir->length);
        scaled_copy(h, real_exp10(gain / 20.0), ir->h, (long)ir->length);
        ir->h = h;
    }
    return true;
}

static const char *note_of(const struct reader *r, const struct ir_set *s)
{
    const char *first = NULL;
    int n = 0;
    for (int k = 0; k < s->n; k++)
        if (s->ir[k].note) {
            first = first ? first : s->ir[k].note;
            n++;
        }
    return n < 2 ? first : arena_format(r->arena, "%s (and %d more of the folder's %d responses)", first, n - 1, s->n);
}

struct spot {
    double x, y;
    size_t row;
};

static int spot_order(const void *a, const void *b)
{
    const struct spot *p = a, *q = b;
    if (p->x != q->x) return p->x < q->x ? -1 : 1;
    return p->y != q->y ? (p->y < q->y ? -1 : 1) : (p->row > q->row) - (p->row < q->row);
}

/* Responses are kept by x, then y: in what order rows stand tells nothing. */
static bool take_in_order(const struct reader *r, const double *xy, struct ir_set *s)
{
    struct spot *spot = ARENA_TAKE(r->arena, struct spot, s->n);
    int *place = ARENA_TAKE(r->arena, int, s->n);
    for (int k = 0; k < s->n; k++)
        spot[k] = (struct spot){xy[2 * k], xy[2 * k + 1], (size_t)k};
    qsort(spot, (size_t)s->n, sizeof *spot, spot_order);
    for (int k = 0; k < s->n; k++)
        place[spot[k].row] = k;
    for (int row = 0; row < s->n; row++)
        if (!read_response(r, (size_t)row, &s->ir[place[row]])) return false;
    double *sorted = ARENA_TAKE(r->arena, double, 2 * (size_t)s->n);
    int bad;
    for (int k = 0; k < s->n; k++) {
        sorted[2 * k] = spot[k].x;
        sorted[2 * k + 1] = spot[k].y;
    }
    return places_make(r->arena, s->n, sorted, &s->places, &bad, r->e);
}

static bool read_rows(const struct reader *r, struct ir_set *s)
{
    int bad = -1;
    double *xy = ARENA_TAKE(r->arena, double, 2 * r->table.rows);
    for (size_t row = 0; row < r->table.rows; row++)
        if (!check_name(r, row) || !read_place(r, row, xy + 2 * row)) return false;
    if (!places_make(r->arena, (int)r->table.rows, xy, &s->places, &bad, r->e))
        return bad < 0 ? err_at(r->e, "%s", r->table.file) : at(r, (size_t)bad);
    s->n = (int)r->table.rows;
    s->ir = ARENA_TAKE(r->arena, struct ir, s->n);
    if (!take_in_order(r, xy, s)) return false;
    s->note = note_of(r, s);
    return true;
}

bool ir_set_read(const struct ir_ask *ask, struct arena *a, struct ir_set *s, struct err *e)
{
    struct reader r = {.ask = ask, .arena = a, .e = e};
    *s = (struct ir_set){0};
    if (!csv_read_file(arena_format(a, "%s/index.csv", ask->path), a, &r.table, e))
        return e->kind == ERR_INPUT ? err_at(e, "a folder of responses has its places in index.csv (file_name,x_m,y_m)")
                                    : false;
    return find_columns(&r) && read_rows(&r, s);
}
