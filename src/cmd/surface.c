/* rasp surface convert IN OUT: a height map in another format, or a part of it. */
#include "cmd/surface.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "cmd/tell.h"
#include "file/heightfile.h"
#include "output/mark.h"
#include "pipeline/outputs.h"
#include "pipeline/stages.h"
#include "scene/units.h"
#include "surface/relief.h"

static bool surface_length(struct cmd_call *c, const char *name, const double range[2], double *x, struct err *e);

struct convert {
    struct cmd_call *c;
    struct heightfile h;
    double crop[4]; /* m: left, top, width, height */
    bool cropped;
};

/* X,Y,W,H, or X,W, each a length. */
static bool read_crop(struct convert *v, struct err *e)
{
    const char *text = args_value(&v->c->args, "crop");
    double x[4];
    int n = 0;
    v->cropped = text != NULL;
    if (!text) return true;
    for (char *p = arena_text(v->c->arena, text), *next; p; p = next) {
        struct units_fault fault = {NULL, NULL};
        next = strchr(p, ',');
        if (next) *next++ = '\0';
        if (n == 4 || !units_read(p, KEY_LENGTH, &x[n++], v->c->arena, &fault))
            return err_set(e, ERR_USAGE, "--crop: '%s': %s %s", text, fault.text ? p : "has",
                           fault.text ? fault.text : "more than four lengths");
    }
    if (n != 4 && n != 2)
        return err_set(e, ERR_USAGE,
                       "--crop: '%s' is not of the form X,Y,W,H (of a profile X,W), as in 1mm,1mm,5mm,5mm", text);
    v->crop[0] = x[0];
    v->crop[1] = n == 4 ? x[1] : 0;
    v->crop[2] = n == 4 ? x[2] : x[1];
    v->crop[3] = n == 4 ? x[3] : HUGE_VAL;
    return (v->crop[0] >= 0 && v->crop[1] >= 0 && v->crop[2] > 0 && v->crop[3] > 0) ||
           err_set(e, ERR_USAGE, "--crop: '%s': a part begins at 0 or later and is larger than 0", text);
}

/* The first sample and the number of samples of [from, from + size), in samples of one direction; sample i lies at i
 * pitch. */
static bool crop_range(const char *what, double from, double size, double pitch, size_t n, size_t range[2],
                       struct err *e)
{
    double first = ceil(from / pitch - 1e-6), last = ceil((from + size) / pitch - 1e-6);
    if (isinf(size)) last = (double)n;
    if (last > (double)n)
        return err_set(e, ERR_SCENE, "--crop: the %s goes from %g to %g m, and the map to %g m", what, from,
                       from + size, pitch * (double)n);
    if (last - first < 1)
        return err_set(e, ERR_SCENE, "--crop: no sample lies in the %s from %g to %g m; they are %g m apart", what,
                       from, from + size, pitch);
    range[0] = (size_t)first;
    range[1] = (size_t)(last - first);
    return true;
}

/* Keeps columns x[0] .. and rows y[0] ..; in place. */
static void keep(struct heightfile *h, const size_t x[2], const size_t y[2])
{
    for (size_t j = 0; j < y[1]; j++)
        memmove(h->z + j * x[1], h->z + (y[0] + j) * h->columns + x[0], x[1] * sizeof *h->z);
    h->columns = x[1];
    h->rows = y[1];
    h->holes = 0;
    for (size_t i = 0; i < h->columns * h->rows; i++)
        h->holes += isnan(h->z[i]);
}

static bool crop(struct convert *v, struct err *e)
{
    struct heightfile *h = &v->h;
    size_t x[2], y[2] = {0, 1};
    if (!v->cropped) return true;
    if (h->rows == 1 && isfinite(v->crop[3])) return err_set(e, ERR_USAGE, "--crop: a profile has no height: give X,W");
    if (h->rows > 1 && isinf(v->crop[3])) return err_set(e, ERR_USAGE, "--crop: a map needs X,Y,W,H");
    if (!crop_range("width", v->crop[0], v->crop[2], h->pitch_x, h->columns, x, e) ||
        (h->rows > 1 && !crop_range("height", v->crop[1], v->crop[3], h->pitch_y, h->rows, y, e)))
        return false;
    keep(h, x, y);
    return true;
}

static bool take_row(struct convert *v, struct err *e)
{
    static const long range[2] = {0, 0x7fffffff};
    long k = -1;
    size_t x[2] = {0, v->h.columns}, y[2] = {0, 1};
    if (!args_whole(&v->c->args, "row", range, &k, e)) return false;
    if (k < 0) return true;
    if ((size_t)k >= v->h.rows)
        return err_set(e, ERR_SCENE, "--row: row %ld is asked for, and the map has rows 0 to %zu", k, v->h.rows - 1);
    y[0] = (size_t)k;
    keep(&v->h, x, y);
    return true;
}

/* One line: what was written, and what a reader of it has to know. */
static void report(const struct convert *v, const char *out, enum heightfile_format format,
                   const struct heightfile_written *w)
{
    const struct heightfile *h = &v->h;
    printf("%s: ", out);
    if (h->rows > 1)
        printf("%zu x %zu samples, pitch %.9g um x %.9g um", h->columns, h->rows, h->pitch_x * 1e6, h->pitch_y * 1e6);
    else
        printf("%zu samples, pitch %.9g um", h->columns, h->pitch_x * 1e6);
    printf(", heights from %.6g to %.6g um", w->low * 1e6, (w->low + w->range) * 1e6);
    if (h->filled) printf(", missing points filled: %zu", h->filled);
    if (h->holes) printf(", missing points: %zu", h->holes);
    if (format == HEIGHTFILE_PNG)
        printf("; height range %.9g um (--height-range), 0 stands for %.9g um, steps of %.4g nm", w->range * 1e6,
               w->low * 1e6, w->step * 1e9);
    if (format == HEIGHTFILE_NPY || format == HEIGHTFILE_CSV || format == HEIGHTFILE_PNG)
        printf("; the format does not hold the pitch: give it when reading");
    putchar('\n');
}

static bool pick_format(const struct cmd_call *c, enum heightfile_format *format, struct err *e)
{
    if (!heightfile_write_format(c->args.operands[1], format, e)) return false;
    if (args_given(&c->args, "text") && *format != HEIGHTFILE_SDF)
        return err_set(e, ERR_USAGE, "--text is for SDF, which has two forms");
    if (args_given(&c->args, "text")) *format = HEIGHTFILE_SDF_TEXT;
    return true;
}

static int surface_convert_run(struct cmd_call *c, struct err *e)
{
    struct convert v = {.c = c};
    struct heightfile_options o;
    struct heightfile_written w;
    enum heightfile_format format;
    const char *in = c->args.operands[0], *out = c->args.operands[1];
    if (!pick_format(c, &format, e) || !cmd_spares(out, "the heights", in, "a file of another name", e) ||
        !mark_absent(out, args_given(&c->args, "force"), e) || !surface_options(c, HEIGHTFILE_REFUSE, &o, e) ||
        !read_crop(&v, e) || !heightfile_load(in, &o, c->arena, &v.h, e) || !crop(&v, e) || !take_row(&v, e) ||
        !heightfile_write(out, &v.h, format, &w, e))
        return (int)e->kind;
    if (!args_given(&c->args, "quiet")) report(&v, out, format, &w);
    return 0;
}

/* rasp surface synth RECIPE OUT: a height map or profile of a procedural surface, that is of the roughness, ridges and
   grit of a recipe or scene, for programs that want files. Made by the stages that scrape it, so that the heights are
   the same; rasp itself needs no map of them: where the contact goes they are computed.

   A recipe is read through a scene that names it, the rest of which does not matter. */

struct synth {
    struct cmd_call *c;
    struct scene scene;
    double size[2], pitch; /* m; size[1] = 0: a profile */
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
        return err_set(e, ERR_USAGE,
                       "--size and --pitch are needed, as in --size 20mm --pitch 5um, or --size 2mmx1mm for a map");
    char *width = arena_text(s->c->arena, text), *height = strchr(width, 'x');
    if (height) *height++ = '\0';
    if (!units_read(width, KEY_LENGTH, &s->size[0], s->c->arena, &fault) ||
        (height && !units_read(height, KEY_LENGTH, &s->size[1], s->c->arena, &fault)))
        return err_set(e, ERR_USAGE, "--size: '%s' %s; write a length (a profile) or WIDTHxHEIGHT (a map)", text,
                       fault.text);
    if (!surface_length(s->c, "pitch", pitches, &s->pitch, e)) return false;
    s->h.columns = (size_t)fmin(fmax(s->size[0] / s->pitch + 0.5, 0), 1e18);
    s->h.rows = height ? (size_t)fmin(fmax(s->size[1] / s->pitch + 0.5, 0), 1e18) : 1;
    if (s->h.columns < 4 || (height && s->h.rows < 4))
        return err_set(e, ERR_USAGE, "--size: %s at a pitch of %g m is less than 4 samples along a side", text,
                       s->pitch);
    return s->h.columns <= HEIGHTFILE_MOST / s->h.rows ||
           err_set(e, ERR_USAGE,
                   "--size: %s at a pitch of %g m is more than 2^28 samples; ask for a smaller map or a larger pitch",
                   text, s->pitch);
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
    if (s->along == ALONG_AUTO) return err_set(e, ERR_USAGE, "--along: '%s' is not path, x or plane", text);
    return s->h.rows == 1 || s->along == ALONG_PLANE ||
           err_set(e, ERR_SCENE, "a surface along %s is a profile: give --size one length, or --along plane",
                   words[s->along]);
}

static bool read_surface(struct synth *s, struct err *e)
{
    const char *file = s->c->args.operands[0];
    const char *rest = "scraper: {mass: 1 g}\nmotion: {path: line, to: [1 cm, 0], speed: 1 cm/s}\noutput: "
                       "{diagnostics: {rate: 1 kHz}}\n";
    if (!cmd_recipe_read(s->c, file, rest, &s->scene, e)) return false;
    const struct surface *u = &s->scene.contacts[0].surface;
    if (s->scene.n_contacts > 1)
        return err_set(e, ERR_SCENE, "%s: has %d contacts; synth takes a recipe, or a scene of one contact", file,
                       s->scene.n_contacts);
    if (u->height_map)
        return err_set(
            e, ERR_SCENE,
            "%s: surface.height_map is measured, and needs no synth; rasp surface convert writes it in another format",
            file);
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
        run[k] = (struct stage_run){.stage = stages[k],
                                    .scene = &s->scene,
                                    .contact = &s->scene.contacts[0],
                                    .board = &board,
                                    .arena = s->c->arena};
        ok = ok && (!stages[k]->wanted(run[k].contact, &s->scene) || stages[k]->open(&run[k], e));
    }
    for (int k = 0; k < board.n_warnings; k++)
        tell_remark(s->c, "surface", board.warnings[k]);
    if (ok) read_heights(s, &relief);
    for (int k = 0; k < 3; k++)
        if (stages[k]->close) stages[k]->close(&run[k]);
    return ok;
}

static void synth_report(const struct synth *s, const char *out)
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
        if (!cmd_spares(out, "the heights", sources[i].file, "a file of another name", e)) return false;
    return true;
}

static int surface_synth_run(struct cmd_call *c, struct err *e)
{
    struct synth s = {.c = c};
    enum heightfile_format format;
    struct heightfile_written w;
    const char *out = c->args.operands[1];
    if (!heightfile_write_format(out, &format, e) || !read_size(&s, e) || !read_surface(&s, e) ||
        !all_spared(&s, out, e) || !mark_absent(out, args_given(&c->args, "force"), e) || !read_along(&s, e) ||
        !make(&s, e))
        return (int)e->kind;
    s.h.pitch_x = s.h.pitch_y = s.pitch;
    s.h.metric = true;
    s.h.title = s.scene.title;
    if (!heightfile_write(out, &s.h, format, &w, e)) return (int)e->kind;
    if (!args_given(&c->args, "quiet")) synth_report(&s, out);
    return 0;
}

/* rasp surface ACTION: height maps on their own, without a scene. */

static const struct action actions[] = {
    {"info",
     "FILE...",
     1,
     -1,
     {"pitch", "height-scale", "height-range", "holes", "levelling", "json"},
     surface_info_run},
    {"convert",
     "IN OUT",
     2,
     2,
     {"pitch", "height-scale", "height-range", "holes", "levelling", "crop", "row", "text", "force", "quiet"},
     surface_convert_run},
    {"synth", "RECIPE OUT", 2, 2, {"size", "pitch", "along", "set", "seed", "force", "quiet"}, surface_synth_run},
    {NULL, NULL, 0, 0, {NULL}, NULL},
};

/* --NAME as a length in [range[0], range[1]] m, with a unit or bare in metres; *x is left alone when it is not given.
 * ERR_USAGE */
static bool surface_length(struct cmd_call *c, const char *name, const double range[2], double *x, struct err *e)
{
    const char *text = args_value(&c->args, name);
    struct units_fault fault = {NULL, NULL};
    double value;
    if (!text) return true;
    if (!units_read(text, KEY_LENGTH, &value, c->arena, &fault))
        return err_set(e, ERR_USAGE, "--%s: '%s' %s", name, text, fault.text);
    if (!(value >= range[0] && value <= range[1]))
        return err_set(e, ERR_USAGE, "--%s: %s is not from %s to %s", name, text,
                       units_text(range[0], KEY_LENGTH, c->arena), units_text(range[1], KEY_LENGTH, c->arena));
    *x = value;
    return true;
}

/* --pitch, --height-scale, --height-range, --holes (else `holes`), --levelling. ERR_USAGE */
bool surface_options(struct cmd_call *c, enum heightfile_holes holes, struct heightfile_options *o, struct err *e)
{
    static const char *const hole_words[] = {"refuse", "fill", "keep", NULL}, *const levelling_words[] = {
                                                                                  "none", "mean", "plane", NULL};
    static const double pitch[2] = {1e-8, 1e-3}, scale[2] = {1e-12, 1e3},
                        range[2] = {1e-9, 1e-1}; /* as in scene/keys.def */
    *o = (struct heightfile_options){.pitch = NAN,
                                     .height_scale = NAN,
                                     .height_range = NAN,
                                     .holes = (int)holes,
                                     .names = &heightfile_load_option_names};
    return surface_length(c, "pitch", pitch, &o->pitch, e) &&
           surface_length(c, "height-scale", scale, &o->height_scale, e) &&
           surface_length(c, "height-range", range, &o->height_range, e) &&
           args_word(&c->args, "holes", hole_words, &o->holes, e) &&
           args_word(&c->args, "levelling", levelling_words, &o->levelling, e);
}

static int surface_run(struct cmd_call *c, struct err *e) { return cmd_actions("surface", actions, c, e); }

static const struct args_option options[] = {
    {"pitch", 0, "LENGTH", false,
     "distance between two samples; of read files, only for those that do not hold it (NPY, PNG, CSV)"},
    {"height-scale", 0, "LENGTH", false,
     "factor on the heights: what one stored unit of NPY or CSV stands for (default 1 m)"},
    {"height-range", 0, "LENGTH", false, "height that white, 65535, of a PNG stands for"},
    {"holes", 0, "refuse|fill|keep", false,
     "missing points: fill is by Laplace's equation; default: info keep, convert refuse"},
    {"levelling", 0, "none|mean|plane", false, "what is subtracted (plane, of a profile: line); default: none"},
    {"json", 'j', NULL, false, "info: prints the figures as one JSON object; null stands for one that is not there"},
    {"crop", 0, "X,Y,W,H", false, "convert: only this part: left, top, width, height, each a length; of a profile X,W"},
    {"row", 0, "K", false, "convert: only row K, counted from 0, as a profile"},
    {"text", 't', NULL, false, "convert: writes SDF as text (default: binary)"},
    {"size", 0, "SIZE", false, "synth: a length (a profile) or WIDTHxHEIGHT (a map), as in 20mm or 2mmx1mm"},
    {"along", 0, "path|x|plane", false,
     "synth: what it follows (x: the profile that a straight motion meets); default: that of the scene, or of the "
     "size"},
    CMD_SCENE_OPTIONS,
    {"force", 'f', NULL, false, "convert, synth: replaces OUT if it exists"},
    {"quiet", 'q', NULL, false, "convert, synth: prints nothing"},
    {0}};

const struct command surface_command = {
    .name = "surface",
    .group = "Surfaces and objects",
    .summary = "height maps: what they are like, other formats",
    .does = "rasp surface info FILE...: what height maps are like, one fact a line: size, roughness figures, missing "
            "points, how finely heights are stored against what the limiter lets through, how far the spectrum "
            "reaches, what repeating or mirroring the map does at its ends, and what looks like a fault. Nothing is "
            "levelled unless it is asked for.\n"
            "rasp surface synth RECIPE OUT: heights of a procedural surface (roughness, ridges, grit of a recipe or "
            "scene), by OUT's ending. Rendering needs no such file: it computes the heights where the contact goes.\n"
            "rasp surface convert IN OUT: the map in another format, by OUT's ending: .gsf (float32), .gwy, .sdf, .npy "
            "(float64), .png (16 bits, 0 lowest, 65535 highest; what they stand for is printed), .csv. Heights are "
            "metres in all but PNG.\n"
            "Read are GSF, GWY, SDF (text, binary), NPY, 16-bit grey PNG and CSV grids, told apart by content; what "
            "else Gwyddion reads, gwyddion --convert-to-gwy=OUT.gwy IN makes readable. A map has at most 2^28 samples "
            "(16384 x 16384), for which 2 GiB of memory and the size of the file are taken.",
    .operands = "ACTION FILE...",
    .least = 1,
    .most = -1,
    .options = options,
    .actions = actions,
    .examples = "rasp surface info surfaces/ridged_plate.gsf\n"
                "rasp surface info --pitch 1.4um --levelling plane profile.npy\n"
                "rasp surface convert --holes fill map.sdf map.gsf\n"
                "rasp surface convert --crop '1mm,1mm,5mm,5mm' map.gwy part.gsf\n"
                "rasp surface convert --row 128 map.gsf profile.npy\n"
                "rasp surface synth --size 2mmx1mm --pitch 5um surfaces/sandpaper.yaml map.gsf\n",
    .run = surface_run,
};
