/* Reads a folder of `rasp modes residual`. */
#include "response/residual.h"

#include <dirent.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

#include "base/hash.h"
#include "base/relpath.h"
#include "file/csv.h"
#include "file/wav.h"
#include "file/yaml.h"
#include "num/resample.h"

static const char *const files[] = {RESIDUAL_YAML, RESIDUAL_WAV, RESIDUAL_MODES, RESIDUAL_STRIKE};

enum { FILES = sizeof files / sizeof *files };

/* The top of residual.yaml; NULL: it is none, or not of this format unless any will do. */
static struct yaml_node *top_of(const char *path, bool any, struct arena *a, struct err *e)
{
    struct yaml *y = yaml_open(a);
    size_t size;
    const char *text = yaml_bytes_text(path, a, &size);
    if (!text) {
        err_set(e, ERR_INPUT, "%s: cannot be read", path);
        return NULL;
    }
    struct yaml_node *top = yaml_parse(y, yaml_source(y, path, text, size));
    const struct yaml_node *version = top && top->kind == YAML_MAP ? yaml_get(top, RESIDUAL_FORMAT) : NULL;
    if (!version || version->kind != YAML_SCALAR)
        err_set(e, ERR_SCENE, "%s: is not the " RESIDUAL_YAML " of a folder that rasp modes residual wrote", path);
    else if (!any && strcmp(version->text, RESIDUAL_VERSION) != 0)
        err_set(e, ERR_SCENE,
                "%s: is of format %s, and this rasp reads format " RESIDUAL_VERSION ": make the folder again", path,
                version->text);
    return e->kind ? NULL : top;
}

/* Each file as it was written. */
static bool check_hashes(const char *yaml, const char *folder, const struct yaml_node *top, struct arena *a,
                         struct err *e)
{
    const struct yaml_node *all = yaml_get(top, "files");
    for (int k = 1; k < FILES; k++) {
        const struct yaml_node *hash = NULL;
        for (const struct yaml_node *one = all && all->kind == YAML_LIST ? all->first : NULL; one; one = one->next) {
            const struct yaml_node *name = one->kind == YAML_MAP ? yaml_get(one, "file") : NULL;
            if (name && name->text && !strcmp(name->text, files[k])) hash = yaml_get(one, "sha256");
        }
        const char *path = arena_format(a, "%s/%s", folder, files[k]);
        char hex[HASH_TEXT];
        if (!hash || !hash->text) return err_set(e, ERR_SCENE, "%s: does not list %s with its sha256", yaml, files[k]);
        if (!hash_file(path, hex, e)) return err_at(e, "%s", yaml);
        if (strcmp(hex, hash->text) != 0)
            return err_set(e, ERR_SCENE,
                           "%s: has changed since rasp modes residual wrote it: its sha256 is %s, not %s; make the "
                           "folder again",
                           path, hex, hash->text);
    }
    return true;
}

static bool read_modes(const char *path, struct arena *a, struct residual_modes *m, struct err *e)
{
    static const char *const names[] = {"frequency_hz", "decay_per_s", "gain", "match_ratio", "strike_energy"};
    struct csv t;
    if (!csv_read_file(path, a, &t, e)) return false;
    *m = (struct residual_modes){.n = (int)t.rows,
                                 .frequency = ARENA_TAKE(a, double, t.rows),
                                 .decay = ARENA_TAKE(a, double, t.rows),
                                 .gain = ARENA_TAKE(a, double, t.rows),
                                 .energy = ARENA_TAKE(a, double, t.rows)};
    for (size_t row = 0; row < t.rows; row++) {
        double value[5];
        for (int k = 0; k < 5; k++) {
            int column = csv_column(&t, names[k]);
            if (column < 0) return err_set(e, ERR_SCENE, "%s: no column %s", path, names[k]);
            if (!csv_number(&t, row, column, &value[k], e)) return false;
        }
        if (!(value[0] > 0.0 && value[1] > 0.0))
            return err_set(e, ERR_SCENE, "%s:%d: frequency and decay are above 0", path, t.lines[row]);
        m->frequency[row] = value[0];
        m->decay[row] = value[1];
        m->gain[row] = value[3] > 0.0 ? fabs(value[2]) : 0.0; /* its own, however much of it was represented */
        m->energy[row] = value[4];
    }
    return true;
}

bool residual_read(const char *yaml, double rate, struct arena *a, struct residual *r, struct err *e)
{
    const char *folder = relpath_folder(yaml, a), *path = arena_format(a, "%s/" RESIDUAL_WAV, folder);
    const struct yaml_node *top = top_of(yaml, false, a, e);
    struct wav w;
    *r = (struct residual){.rate = rate};
    if (!top || !check_hashes(yaml, folder, top, a, e) || !wav_read(path, a, &w, e) ||
        !read_modes(arena_format(a, "%s/" RESIDUAL_MODES, folder), a, &r->modes, e))
        return false;
    if (w.channels != 1) return err_set(e, ERR_SCENE, "%s: has %d channels, a residual has one", path, w.channels);
    r->n = (long)w.frames;
    r->x = w.x;
    if (w.rate == rate) return true;
    size_t n;
    r->note = arena_format(a, "%s: its sample rate is %g Hz; it was converted to %g Hz", path, w.rate, rate);
    if (!resample(a, w.x, w.frames, w.rate, rate, &r->x, &n, e)) return err_at(e, "%s", path);
    r->n = (long)n;
    return true;
}

const char *residual_is_folder(const char *folder, struct arena *a)
{
    struct err e = {0};
    DIR *d = opendir(folder);
    if (!d) return "is not a folder";
    const char *other = NULL;
    for (const struct dirent *one; (one = readdir(d));) {
        bool known = !strcmp(one->d_name, ".") || !strcmp(one->d_name, "..");
        for (int k = 0; k < FILES; k++)
            known = known || !strcmp(one->d_name, files[k]);
        if (!known && (!other || strcmp(one->d_name, other) < 0)) other = arena_text(a, one->d_name);
    }
    closedir(d);
    if (other) return arena_format(a, "holds %s, which is no file of a residual", other);
    return top_of(arena_format(a, "%s/" RESIDUAL_YAML, folder), true, a, &e)
               ? NULL
               : "is not a folder that rasp modes residual wrote";
}
