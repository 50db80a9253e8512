/* rasp new: a starter scene or design. */
#include "cmd/cmd.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/memory.h"
#include "base/outfile.h"
#include "base/relpath.h"
#include "base/text.h"
#include "output/mark.h"
#include "scene/keys_text.h"
#include "scene/keys_yaml.h"

/* Starter scenes as texts of keys and values, which are off behind a #; the comment above a key is its meaning. They
   render as they are: no line that is on names a file. The shipped responses that are off fit the motion: tables with
   places on y = 0 where it is a line along x, else one response that holds everywhere. "-" begins one of several
   contacts, "." ends them. */

#define ROUGHNESS                                                                                                      \
    "surface.roughness.exponent -2.4; surface.roughness.rms 4 um; surface.roughness.longest 2 mm; "                    \
    "surface.roughness.shortest 20 um; "
#define PLANK "#surface.response irs/oak_plank.csv; "
#define TILE "#surface.response irs/ceramic_tile_tap.wav; "
#define SCRAPER "scraper.mass 20 g; #scraper.response irs/pvc_rod.csv; #scraper.weight 0.03; "
#define STROKES                                                                                                        \
    "motion.path back_and_forth; motion.from [0 cm, 0 cm]; motion.to [4.5 cm, 0 cm]; motion.rate 2 Hz; "               \
    "motion.duration 2 s; "
#define LINE "motion.path line; motion.from [0 cm, 0 cm]; motion.to [10 cm, 0 cm]; "
#define CIRCLE                                                                                                         \
    "motion.path circle; motion.center [5 cm, 5 cm]; motion.radius 2 cm; motion.turns 3; motion.speed 20 cm/s; "
#define STROKE_OF_A_PEN                                                                                                \
    "motion.path spline; motion.points [[0 cm, 0 cm], [3 cm, 2 cm], [5 cm, 0 cm], [3 cm, -1 cm], [8 cm, 1 cm]]; "      \
    "motion.duration 1.5 s; motion.law two_thirds; "
#define HAND "grip.angle 30 deg; grip.azimuth 0 deg; grip.friction 0.3; "
#define PLATE                                                                                                          \
    "surface.object.shape plate; surface.object.length 30 cm; surface.object.width 20 cm; surface.object.thickness 3 " \
    "mm; surface.object.origin [-10 cm, -8 cm]; "
#define TAIL "output.sample_rate 48 kHz; output.encoding pcm24; output.diagnostics.rate 1 kHz; accuracy standard; "

const struct new_starter new_starters[] = {
    {"scrape", "a tool scraped back and forth on a rough surface",
     "The forces of a scrape go into a CSV. For sound, give the surface or the scraper a response: remove the # before "
     "it.",
     "rasp 1; title a tool scraped back and forth; seed 1; " ROUGHNESS PLANK SCRAPER STROKES
     "#load.constant 1.5 N; " TAIL},
    {"stroke", "one straight stroke from rest to rest",
     "One stroke as a hand makes it. For sound, give the surface or the scraper a response.",
     "rasp 1; title one stroke from rest to rest; seed 1; " ROUGHNESS PLANK SCRAPER LINE
     "motion.duration 0.8 s; motion.law minimum_jerk; " TAIL},
    {"grip", "a tool held in the hand: the normal force follows the motion",
     "The tool's inertia presses it down where it turns round (equations 8 and 9), and a harder pressed tool follows "
     "the surface more closely (equation 7). For sound, give the surface or the scraper a response.",
     "rasp 1; title a tool held in the hand; seed 1; " ROUGHNESS PLANK SCRAPER STROKES HAND
     "#contact.limiter.force_range [0.2 N, 5 N]; " TAIL},
    {"circle", "round and round over ridges, with a hand's force",
     "On a curve the contact meets the ridges at every angle, and the hand's force turns with the acceleration. For "
     "sound, give the surface or the scraper a response.",
     "rasp 1; title round and round on a ribbed plate; seed 1; " ROUGHNESS
     "surface.ridges.spacing 1 mm; surface.ridges.height 20 um; surface.ridges.direction 90 deg; " TILE SCRAPER CIRCLE
         HAND TAIL},
    {"pen", "a curve through points, drawn as a hand draws it",
     "Slow in the bends, fast where the curve is straight: the two-thirds power law. On a grain, as of wood, along x. "
     "For sound, give the surface or the scraper a response.",
     "rasp 1; title a curve as a hand draws it; seed 1; " ROUGHNESS
     "surface.roughness.grain 5; surface.roughness.grain_direction 0 deg; " TILE SCRAPER STROKE_OF_A_PEN
     "#load.constant 1.5 N; " TAIL},
    {"sandpaper", "a scribble over grit",
     "Grains lie scattered over fine roughness; the folder surfaces/ has such recipes with measured figures, to be "
     "named by surface.recipe. For sound, give the surface or the scraper a response.",
     "rasp 1; title scribbling on sandpaper; seed 1; surface.roughness.rms 2 um; surface.grit.density 30 /mm^2; "
     "surface.grit.diameter 125 um; surface.grit.height 40 um; " TILE SCRAPER
     "motion.path scribble; motion.size [6 cm, 4 cm]; motion.rate 2 Hz; motion.duration 2 s; " TAIL},
    {"profile", "a measured height profile in place of a synthetic one",
     "Renders with synthetic roughness. For a measured profile, remove the # before height_map (and pitch and "
     "height_scale, which files other than NPY, PNG and CSV hold themselves), and remove the section roughness: else "
     "the two add up.",
     "rasp 1; title a measured surface; #surface.height_map profile.npy; #surface.pitch 5 um; #surface.height_scale 1 "
     "um; surface.along path; #surface.off_map mirror; " ROUGHNESS PLANK SCRAPER LINE "motion.speed 10 cm/s; " TAIL},
    {"paper", "the contact force exactly as the 2021 paper prints it",
     "Equations 2 and 3 as printed, instead of the default, which keeps momentum.",
     "rasp 1; title the equations as printed; seed 1; " ROUGHNESS PLANK SCRAPER STROKES HAND
     "contact.force paper; contact.beta1 0.05; contact.beta2 1; contact.limiter.alpha_min 1 cm; "
     "contact.limiter.alpha_max 5 cm; contact.limiter.zeta 0.95; " TAIL},
    {"object", "a scrape of an object that rings: its modes follow from size and material",
     "The plate's modes are computed from its size and material, which need no file; it is heard where it is touched, "
     "since output.listen says nothing else.",
     "rasp 1; title a stick scraped across a glass plate; seed 1; " ROUGHNESS "surface.material glass; " PLATE
     "scraper.mass 20 g; " LINE "motion.duration 0.8 s; motion.law minimum_jerk; " TAIL},
    {"strike", "an impact on an object that rings",
     "A ball strikes a plate once, and both its stiffness and the plate's modes follow from the materials. With "
     "restitution (remove the #) it bounces.",
     "rasp 1; title a steel ball strikes a glass plate; surface.material glass; " PLATE
     "scraper.mass 4.1 g; scraper.radius 5 mm; scraper.material steel; motion.path still; motion.at [4 cm, 3 cm]; "
     "motion.duration 0.5 s; contact.model strike; contact.strike.speed 1 m/s; #contact.strike.restitution 0.7; " TAIL},
    {"roll", "a ball that rolls: the force follows from its centre's way over the surface",
     "The kinematic model of the 2021 paper: quick, and it never bounces. An offset of the centre of mass (remove the "
     "#) makes the normal force, and with it the ball's, swing with each turn. For sound, give the surface or the ball "
     "a response.",
     "rasp 1; title a marble rolls over a plank; seed 1; " ROUGHNESS PLANK
     "ball.radius 8 mm; ball.material glass; #ball.offset 0.5 mm; #ball.response irs/glass_ball.csv; #ball.weight "
     "10; " LINE "motion.speed 20 cm/s; contact.model roll; contact.roll.mu 1 s/m; #contact.roll.static_penetration 8 "
     "um; contact.roll.scraping 1; " TAIL},
    {"roll_coupled", "a ball that is dropped, bounces and rolls: flight, contact and the plate's modes solved together",
     "The coupled model: the ball lifts off and lands as its mass, the contact and the surface's modes have it, and "
     "the CSV keeps its energy's ledger. A drop of 0 lays the ball down.",
     "rasp 1; title a marble dropped on a glass plate, which it rolls along; seed 1; surface.roughness.rms 0.2 um; "
     "surface.material glass; " PLATE "ball.radius 8 mm; ball.material glass; " LINE
     "motion.speed 20 cm/s; contact.model roll_coupled; contact.roll.mu 1 s/m; #contact.roll.integrator rk4; "
     "#contact.roll.ground rigid; contact.roll.drop 5 mm; " TAIL},
    {"impacts", "a series of impacts drawn from its statistics: rolling, rubbing, scratching",
     "Conan's rolling of 2014: no ball and no surface's shape, but size, velocity and roughness as one hears them. "
     "Other prototypes: rub, scratch, and the space between.",
     "rasp 1; title rolling, drawn from the statistics of its impacts; seed 1; surface.material glass; " PLATE LINE
     "motion.speed 20 cm/s; contact.model impacts; contact.impacts.prototype roll; contact.impacts.size 0.3; "
     "contact.impacts.velocity 0.5; contact.impacts.roughness 0.5; #contact.gesture.cutoff 4 kHz; " TAIL},
    {"contacts", "two contacts whose sounds add up",
     "Every contact has its own surface, scraper and motion; rasp render --set contacts.comb.gain=0.2 changes one.",
     "rasp 1; title two tools on one plank; seed 1; "
     "-; "
     "name rod; " ROUGHNESS PLANK SCRAPER LINE "motion.speed 5 cm/s; "
     "-; "
     "name comb; start 0.5 s; gain 0.5; surface.roughness.rms 9 um; " PLANK "scraper.mass 8 g; " LINE
     "motion.speed 20 cm/s; "
     ".; " TAIL},
    {"design", "not a scene, but a design: a set of stimuli, for rasp batch", NULL, NULL},
    {NULL, NULL, NULL, NULL},
};

/* Within braces a comma ends a plain text; more than that ends or begins otherwise. */
static const char *response(const char *irs, const char *name, struct arena *a)
{
    const char *file = arena_format(a, "%s/%s", irs, name);
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._/-";
    return file[0] == '-' || file[strspn(file, plain)] ? keys_yaml_quoted(file, a) : file;
}

struct keys_line *new_lines(const char *text, struct arena *a)
{
    int n = 0, most = 1;
    for (const char *p = text; *p; p++)
        most += *p == ';';
    struct keys_line *lines = ARENA_TAKE(a, struct keys_line, most);
    for (char *p = arena_text(a, text), *end; (end = strstr(p, "; ")); p = end + 2, n++) {
        *end = '\0';
        lines[n].off = *p == '#';
        lines[n].path = p + lines[n].off;
        char *blank = strchr(p, ' ');
        if (blank) *blank++ = '\0';
        lines[n].value = blank;
    }
    return lines;
}

void new_print(FILE *f, const struct new_starter *s, const char *irs, struct arena *a)
{
    static const struct keys_style scene = {.comments = true}, contact = {.indent = 4, .item = true};
    if (!s->text) {
        fputs("# A set of stimuli: every combination of its factors' levels. Its base is the starter scene of the same "
              "folder:\n"
              "#   rasp new -o scrape.yaml\n"
              "#   rasp new design -o set.yaml\n"
              "#   rasp check set.yaml\n"
              "#   rasp batch set.yaml -o out\n"
              "# All that can stand here: man rasp-design. Every key of scenes: rasp explain.\n\n"
              "rasp-design: 1\n"
              "title: Two materials scraped at two rates\n"
              "base: scrape.yaml            # the scene of which all are made, seen from this file\n"
              "seed: 1                      # of the noise, which is the same for all conditions of a replicate\n"
              "set:                         # keys that all have otherwise than the base\n"
              "  motion.duration: 1 s\n"
              "  output.diagnostics: null   # no tables of forces\n"
              "factors:\n"
              "  material:                  # a word: each level says what it sets\n",
              f);
        fprintf(f,
                "    - {label: oak, set: {surface.response: %s}}\n"
                "    - {label: stoneware, set: {surface.response: %s}}\n",
                response(irs, "oak_plank.csv", a), response(irs, "stoneware_tile.csv", a));
        fputs("  motion.rate: [1 Hz, 2 Hz]  # a key of scenes: its levels are its values\n"
              "# exclude:                   # cells that the set does not have\n"
              "#   - {material: oak, motion.rate: 2 Hz}\n"
              "replicates: 2                # of each cell, with other noise\n"
              "# order: {seed: 1}           # shuffled; else as written\n"
              "name: \"{material}_{motion.rate}_{replicate}\"\n"
              "text: \"{material}, scraped at {motion.rate}\"   # for the trial; a level may have a text of its own\n"
              "level: {common: {peak: -3 dB}}   # one gain for all; each: one for each; scene: as the scenes say\n"
              "length: longest              # as long as the longest; a time; or own\n"
              "# recordings:                # WAV files that are part of the set\n"
              "#   - {file: real.wav, name: real_oak, material: oak}\n",
              f);
        return;
    }
    fprintf(f, "# ");
    text_wrap(f, s->about, 2, "# ");
    fprintf(f, "# Every key: rasp explain. One key: rasp explain motion.rate. A bare number is in SI units.\n"
               "# Responses to begin with are in irs/ of rasp's folder (installed: share/rasp/), surfaces in "
               "surfaces/. Those named here fit the motion.\n\n");
    const struct keys_style *style = &scene;
    for (struct keys_line *first = new_lines(s->text, a), *l = first; first->path; l++)
        if (!l->path || !l->value) { /* as far as one map goes */
            keys_yaml_print(f, first, (int)(l - first), style);
            if (!l->path) break;
            if (*l->path == '-' && style == &scene) fputs("\ncontacts:\n", f);
            style = *l->path == '-' ? &contact : &scene;
            first = l + 1;
        } else {
            if (!strncmp(l->value, "irs/", 4)) l->value = arena_format(a, "%s/%s", irs, l->value + 4);
            if (style == &contact) continue;
            const struct key *k = keys_find(l->path);
            l->comment = k ? k->meaning : NULL;
            for (const struct keys_text_frame *p = keys_text_frames; p->path; p++)
                if (!strcmp(p->path, l->path)) l->comment = p->meaning;
        }
}

/* The folder of the shipped responses, as a scene in `folder` calls it: seen from there where rasp was built in its
   source tree, else as it was installed, else of a source tree that is the current folder. */
static const char *irs_seen(const char *folder, struct arena *a)
{
    char own[4096];
    ssize_t n = readlink("/proc/self/exe", own, sizeof own - 1);
    own[n > 0 ? n : 0] = '\0';
    char *slash = strrchr(own, '/');
    if (slash) slash[1] = '\0';
    const char *self = slash ? own : "", *tree = arena_format(a, "%s../irs", self),
               *installed = arena_format(a, "%s../share/rasp/irs", self);
    if (*self && access(arena_format(a, "%s/README.md", tree), F_OK) == 0) return relpath_make(tree, folder, a);
    char *real = *self ? memory_realpath(installed) : NULL;
    const char *seen = real                                 ? arena_text(a, real)
                       : access("irs/README.md", F_OK) == 0 ? relpath_make("irs", folder, a)
                                                            : "irs";
    free(real);
    return seen;
}

static int new_run(struct cmd_call *c, struct err *e)
{
    const char *name = c->args.n_operands ? c->args.operands[0] : new_starters[0].name, *names[32] = {NULL};
    const char *file = args_value(&c->args, "output");
    const struct new_starter *s = NULL;
    bool list = args_given(&c->args, "list");
    for (int i = 0; new_starters[i].name && i < 31; i++) {
        names[i] = new_starters[i].name;
        if (list) printf("%-12s %s\n", names[i], new_starters[i].summary);
        if (!strcmp(names[i], name)) s = &new_starters[i];
    }
    const char *meant = s ? NULL : text_nearest(name, names);
    if (list) return 0;
    if (meant)
        err_set(e, ERR_USAGE, "no starter scene '%s'; did you mean '%s'? (rasp new --list shows all)", name, meant);
    else if (!s)
        err_set(e, ERR_USAGE, "no starter scene '%s'; rasp new --list shows all", name);
    else if (file && !strcmp(file, "-"))
        err_set(e, ERR_USAGE,
                "--output -: leave it out, and the scene goes to standard output; a file of that name is ./-");
    else if (file) {
        struct outfile o;
        if (!mark_absent(file, args_given(&c->args, "force"), e) || !outfile_open(&o, file, e)) return 0;
        new_print(o.stream, s, irs_seen(relpath_folder(file, c->arena), c->arena), c->arena);
        outfile_commit(&o, e);
    } else
        new_print(stdout, s, irs_seen(NULL, c->arena), c->arena);
    return 0;
}

static const struct args_option options[] = {
    {"output", 'o', "FILE", false, "the file to write; without it the scene goes to standard output"},
    {"force", 'f', NULL, false, "replaces FILE if it exists"},
    {"list", 0, NULL, false, "lists the starters"},
    {0},
};

const struct command new_command = {
    .name = "new",
    .group = "Writing scenes",
    .summary = "writes a commented starter scene",
    .does = "Writes the starter scene NAME (scrape, if none is named), with every line explained. It can be rendered "
            "as it is; for sound, remove the # before a response, which names a file of rasp's irs/ that fits the "
            "motion (seen from the folder of FILE, or from the current one). NAME design is a starter design of a set "
            "of stimuli (rasp-design(5)), whose base is the scene scrape.yaml beside it.",
    .operands = "[NAME]",
    .least = 0,
    .most = 1,
    .options = options,
    .examples = "rasp new --list                  # which there are\n"
                "rasp new -o scrape.yaml          # the default\n"
                "rasp new grip -o grip.yaml       # a tool held in the hand\n"
                "rasp new design -o set.yaml      # four conditions of scrape.yaml, twice each, for rasp batch\n",
    .run = new_run,
};
