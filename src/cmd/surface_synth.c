/* rasp surface synth RECIPE OUT: a height map or profile of a procedural surface, that is of the roughness, ridges and grit of a recipe or
   scene, for programs that want files. Made by the stages that scrape it, so that the heights are the same; rasp itself needs no map of
   them: where the contact goes they are computed.

   A recipe is read through a scene that names it, the rest of which does not matter. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cmd/recipe.h"
#include "cmd/spares.h"
#include "cmd/surface.h"
#include "cmd/tell.h"
#include "file/heightfile_write.h"
#include "output/mark.h"
#include "pipeline/outputs.h"
#include "pipeline/stages.h"
#include "scene/units.h"
#include "surface/relief.h"

struct synth {
    struct cmd_call *c;
    struct scene scene;
    double size[2], pitch;  /* m; size[1] = 0: a profile */
    int along;
    struct heightfile h;
};

/* ------------------------------------------------------------------ what is asked for */

/* LENGTH or WxH; no unit has an x in it. */
static bool read_size(struct synth *s, struct err *e)
{
    static const double pitches[2] = {1e-8, 1e-3};
    const char *text = args_value(&s->c->args, "size");
    struct units_fault fault = {NULL, NULL};
    s->pitch = NAN;
    if (!text || !args_given(&s->c->args, "pitch"))
        return err_set(e, ERR_USAGE, "--size and --pitch are needed, as in --size 20mm --pitch 5um, or --size 2mmx1mm for a map");
    char *width = arena_text(s->c->arena, text), *height = strchr(width, 'x');
    if (height)
        *height++ = '\0';
    if (!units_read(width, KEY_LENGTH, &s->size[0], s->c->arena, &fault) || (height && !units_read(height, KEY_LENGTH, &s->size[1], s->c->arena, &fault)))
        return err_set(e, ERR_USAGE, "--size: '%s' %s; write a length (a profile) or WIDTHxHEIGHT (a map)", text, fault.text);
    if (!surface_length(s->c, "pitch", pitches, &s->pitch, e))
        return false;
    s->h.columns = (size_t)fmin(fmax(s->size[0] / s->pitch + 0.5, 0), 1e18);
    s->h.rows = height ? (size_t)fmin(fmax(s->size[1] / s->pitch + 0.5, 0), 1e18) : 1;
    if (s->h.columns < 4 || (height && s->h.rows < 4))
        return err_set(e, ERR_USAGE, "--size: %s at a pitch of %g m is less than 4 samples along a side", text, s->pitch);
    return s->h.columns <= HEIGHTFILE_MOST / s->h.rows ||
           err_set(e, ERR_USAGE, "--size: %s at a pitch of %g m is more than 2^28 samples; ask for a smaller map or a larger pitch", text, s->pitch);
}

/* A word of --along, else the scene's, else what the size asks for. */
static bool read_along(struct synth *s, struct err *e)
{
    static const char *const words[] = {[ALONG_PATH] = "path", [ALONG_X] = "x", [ALONG_PLANE] = "plane"};
    const char *text = args_value(&s->c->args, "along");
    int own = s->scene.contacts[0].surface.along;
    s->along = text ? ALONG_AUTO : own != ALONG_AUTO ? own : s->h.rows > 1 ? ALONG_PLANE : ALONG_PATH;
    for (int k = ALONG_PATH; text && k <= ALONG_PLANE; k++)
        s->along = !strcmp(text, words[k]) ? k : s->along;
    if (s->along == ALONG_AUTO)
        return err_set(e, ERR_USAGE, "--along: '%s' is not path, x or plane", text);
    return s->h.rows == 1 || s->along == ALONG_PLANE ||
           err_set(e, ERR_SCENE, "a surface along %s is a profile: give --size one length, or --along plane", words[s->along]);
}

static bool read_surface(struct synth *s, struct err *e)
{
    const char *file = s->c->args.operands[0];
    const char *rest = "scraper: {mass: 1 g}\nmotion: {path: line, to: [1 cm, 0], speed: 1 cm/s}\noutput: {diagnostics: {rate: 1 kHz}}\n";
    if (!recipe_read(s->c, file, rest, &s->scene, e))
        return false;
    const struct surface *u = &s->scene.contacts[0].surface;
    if (s->scene.n_contacts > 1)
        return err_set(e, ERR_SCENE, "%s: has %d contacts; synth takes a recipe, or a scene of one contact", file, s->scene.n_contacts);
    if (u->height_map)
        return err_set(e, ERR_SCENE, "%s: surface.height_map is measured, and needs no synth; rasp surface convert writes it in another format", file);
    return u->roughness.given || u->ridges.given || u->grit.given ||
           err_set(e, ERR_SCENE, "%s: has no roughness, ridges or grit: there is no procedural surface in it", file);
}

/* ------------------------------------------------------------------ making */

static void read_heights(struct synth *s, const struct relief *relief)
{
    struct heightfile *h = &s->h;
    double *x = ARENA_TAKE(s->c->arena, double, h->columns), *y = ARENA_TAKE(s->c->arena, double, h->columns);
    h->z = ARENA_TAKE(s->c->arena, double, h->rows * h->columns);
    for (size_t i = 0; i < h->columns; i++)
        x[i] = (double)i * s->pitch;
    for (size_t j = 0; j < h->rows; j++) {
        for (size_t i = 0; i < h->columns; i++)
            y[i] = (double)j * s->pitch;
        relief_at(relief, &(struct relief_points){h->columns, x, s->along == ALONG_PLANE ? y : NULL},
                  &(struct relief_values){.z = h->z + j * h->columns});
    }
}

static bool make(struct synth *s, struct err *e)
{
    const struct stage *stages[] = {&roughness_stage, &ridges_stage, &grit_stage};
    struct relief relief = {.along = s->along};
    struct board board = {.relief = &relief};
    struct stage_run run[3];
    bool ok = true;
    for (int k = 0; k < 3; k++) {
        run[k] = (struct stage_run){.stage = stages[k], .scene = &s->scene, .contact = &s->scene.contacts[0], .board = &board, .arena = s->c->arena};
        ok = ok && (!stages[k]->wanted(run[k].contact, &s->scene) || stages[k]->open(&run[k], e));
    }
    for (int k = 0; k < board.n_warnings; k++)
        tell_remark(s->c, "surface", board.warnings[k]);
    if (ok)
        read_heights(s, &relief);
    for (int k = 0; k < 3; k++)
        if (stages[k]->close)
            stages[k]->close(&run[k]);
    return ok;
}

static void report(const struct synth *s, const char *out)
{
    const struct heightfile *h = &s->h;
    double mean = 0, square = 0, n = (double)(h->rows * h->columns);
    for (size_t i = 0; i < h->rows * h->columns; i++)
        mean += h->z[i] / n;
    for (size_t i = 0; i < h->rows * h->columns; i++)
        square += (h->z[i] - mean) * (h->z[i] - mean) / n;
    printf("%s: ", out);
    if (h->rows > 1)
        printf("%zu x %zu", h->columns, h->rows);
    else
        printf("%zu", h->columns);
    printf(" samples, pitch %.9g um, rms height %.4g um\n", s->pitch * 1e6, sqrt(square) * 1e6);
}

/* Neither recipe, nor what it includes, nor the map whose statistics it has. */
static bool all_spared(const struct synth *s, const char *out, struct err *e)
{
    int n;
    const struct outputs_source *sources = outputs_sources(&s->scene, &n, s->c->arena);
    for (int i = 0; i < n; i++)
        if (!spares(out, "the heights", sources[i].file, "a file of another name", e))
            return false;
    return true;
}

int surface_synth_run(struct cmd_call *c, struct err *e)
{
    struct synth s = {.c = c};
    enum heightfile_format format;
    struct heightfile_written w;
    const char *out = c->args.operands[1];
    if (!heightfile_write_format(out, &format, e) || !read_size(&s, e) || !read_surface(&s, e) || !all_spared(&s, out, e) ||
        !mark_absent(out, args_given(&c->args, "force"), e) || !read_along(&s, e) || !make(&s, e))
        return (int)e->kind;
    s.h.pitch_x = s.h.pitch_y = s.pitch;
    s.h.metric = true;
    s.h.title = s.scene.title;
    if (!heightfile_write(out, &s.h, format, &w, e))
        return (int)e->kind;
    if (!args_given(&c->args, "quiet"))
        report(&s, out);
    return 0;
}
