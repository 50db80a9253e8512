/* rasp surface ACTION: height maps on their own, without a scene. The actions are surface_info.c, surface_convert.c and surface_synth.c. */
#include "cmd/surface.h"

#include <math.h>
#include <string.h>

#include "cmd/actions.h"
#include "file/heightfile_level.h"
#include "scene/units.h"

static const struct action actions[] = {
    {"info", "FILE...", 1, -1, {"pitch", "height-scale", "height-range", "holes", "levelling", "json"}, surface_info_run},
    {"convert", "IN OUT", 2, 2, {"pitch", "height-scale", "height-range", "holes", "levelling", "crop", "row", "text", "force", "quiet"}, surface_convert_run},
    {"synth", "RECIPE OUT", 2, 2, {"size", "pitch", "along", "set", "seed", "force", "quiet"}, surface_synth_run},
    {NULL, NULL, 0, 0, {NULL}, NULL},
};

bool surface_length(struct cmd_call *c, const char *name, const double range[2], double *x, struct err *e)
{
    const char *text = args_value(&c->args, name);
    struct units_fault fault = {NULL, NULL};
    double value;
    if (!text)
        return true;
    if (!units_read(text, KEY_LENGTH, &value, c->arena, &fault))
        return err_set(e, ERR_USAGE, "--%s: '%s' %s", name, text, fault.text);
    if (!(value >= range[0] && value <= range[1]))
        return err_set(e, ERR_USAGE, "--%s: %s is not from %s to %s", name, text, units_text(range[0], KEY_LENGTH, c->arena),
                       units_text(range[1], KEY_LENGTH, c->arena));
    *x = value;
    return true;
}

/* One of the words; its place is the value. */
static bool option_word(struct cmd_call *c, const char *name, const char *const *words, int *value, struct err *e)
{
    const char *text = args_value(&c->args, name);
    if (!text)
        return true;
    for (int i = 0; words[i]; i++)
        if (!strcmp(text, words[i])) {
            *value = i;
            return true;
        }
    return err_set(e, ERR_USAGE, "--%s: '%s' is not %s, %s or %s", name, text, words[0], words[1], words[2]);
}

bool surface_options(struct cmd_call *c, enum heightfile_holes holes, struct heightfile_options *o, struct err *e)
{
    static const char *const hole_words[] = {"refuse", "fill", "keep", NULL}, *const levelling_words[] = {"none", "mean", "plane", NULL};
    static const double pitch[2] = {1e-8, 1e-3}, scale[2] = {1e-12, 1e3}, range[2] = {1e-9, 1e-1}; /* as in scene/keys.def */
    *o = (struct heightfile_options){.pitch = NAN, .height_scale = NAN, .height_range = NAN, .holes = (int)holes,
                                     .names = &heightfile_load_option_names};
    return surface_length(c, "pitch", pitch, &o->pitch, e) && surface_length(c, "height-scale", scale, &o->height_scale, e) &&
           surface_length(c, "height-range", range, &o->height_range, e) && option_word(c, "holes", hole_words, &o->holes, e) &&
           option_word(c, "levelling", levelling_words, &o->levelling, e);
}

static int surface_run(struct cmd_call *c, struct err *e)
{
    return actions_run("surface", actions, c, e);
}

static const struct args_option options[] = {
    {"pitch", 0, "LENGTH", false, "distance between two samples; of read files, only for those that do not hold it (NPY, PNG, CSV)"},
    {"height-scale", 0, "LENGTH", false, "factor on the heights: what one stored unit of NPY or CSV stands for (default 1 m)"},
    {"height-range", 0, "LENGTH", false, "height that white, 65535, of a PNG stands for"},
    {"holes", 0, "refuse|fill|keep", false, "missing points: fill is by Laplace's equation; default: info keep, convert refuse"},
    {"levelling", 0, "none|mean|plane", false, "what is subtracted (plane, of a profile: line); default: none"},
    {"json", 'j', NULL, false, "info: prints the figures as one JSON object; null stands for one that is not there"},
    {"crop", 0, "X,Y,W,H", false, "convert: only this part: left, top, width, height, each a length; of a profile X,W"},
    {"row", 0, "K", false, "convert: only row K, counted from 0, as a profile"},
    {"text", 't', NULL, false, "convert: writes SDF as text (default: binary)"},
    {"size", 0, "SIZE", false, "synth: a length (a profile) or WIDTHxHEIGHT (a map), as in 20mm or 2mmx1mm"},
    {"along", 0, "path|x|plane", false, "synth: what it follows (x: the profile that a straight motion meets); default: that of the scene, or of the size"},
    CMD_SCENE_OPTIONS,
    {"force", 'f', NULL, false, "convert, synth: replaces OUT if it exists"},
    {"quiet", 'q', NULL, false, "convert, synth: prints nothing"},
    {0}};

const struct command surface_command = {
    .name = "surface",
    .summary = "height maps: what they are like, other formats",
    .does = "rasp surface info FILE...: what height maps are like, one fact a line: size, roughness figures, missing points, how finely heights are "
            "stored against what the limiter lets through, how far the spectrum reaches, what repeating or mirroring the map does at its ends, and "
            "what looks like a fault. Nothing is levelled unless it is asked for.\n"
            "rasp surface synth RECIPE OUT: heights of a procedural surface (roughness, ridges, grit of a recipe or scene), by OUT's ending. Rendering "
            "needs no such file: it computes the heights where the contact goes.\n"
            "rasp surface convert IN OUT: the map in another format, by OUT's ending: .gsf (float32), .gwy, .sdf, .npy (float64), .png (16 bits, "
            "0 lowest, 65535 highest; what they stand for is printed), .csv. Heights are metres in all but PNG.\n"
            "Read are GSF, GWY, SDF (text, binary), NPY, 16-bit grey PNG and CSV grids, told apart by content; what else Gwyddion reads, "
            "gwyddion --convert-to-gwy=OUT.gwy IN makes readable. A map has at most 2^28 samples (16384 x 16384), for which 2 GiB of memory and "
            "the size of the file are taken.",
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
