/* rasp new: a starter scene or design. */
#include "cmd/cmd.h"

#include <string.h>

#include "base/outfile.h"
#include "base/text.h"
#include "output/mark.h"
#include "scene/keys_text.h"
#include "scene/keys_yaml.h"

/* Starter scenes as texts of keys and values, which are off behind a #; the comment above a key is its meaning. Each
   renders as it is, and what rings is an object of a material, whose modes are made where the motion is. So any
   material, and any path within the object, can take the place of what is written, and no file is needed. "-" begins
   one of several contacts, "." ends them. */

#define ROUGHNESS                                                                                                      \
    "surface.roughness.exponent -2.4; surface.roughness.rms 4 um; surface.roughness.longest 2 mm; "                    \
    "surface.roughness.shortest 20 um; "
#define PLATE                                                                                                          \
    "surface.object.shape plate; surface.object.length 16 cm; surface.object.width 10 cm; surface.object.thickness "   \
    "1.2 mm; surface.object.origin [-4 cm, -4 cm]; "
#define WOOD "surface.material oak; " PLATE
#define GLASS "surface.material glass; " PLATE
#define STEEL "surface.material steel; " PLATE
#define SCRAPER "scraper.mass 20 g; "
#define STROKES                                                                                                        \
    "motion.path back_and_forth; motion.from [0 cm, 0 cm]; motion.to [8 cm, 0 cm]; motion.rate 2 Hz; "                 \
    "motion.duration 2 s; "
#define LINE "motion.path line; motion.from [0 cm, 0 cm]; motion.to [8 cm, 0 cm]; "
#define CIRCLE                                                                                                         \
    "motion.path circle; motion.center [4 cm, 1 cm]; motion.radius 2 cm; motion.turns 3; motion.speed 20 cm/s; "
#define STROKE_OF_A_PEN                                                                                                \
    "motion.path spline; motion.points [[0 cm, 0 cm], [3 cm, 2 cm], [5 cm, 0 cm], [3 cm, -1 cm], [8 cm, 1 cm]]; "      \
    "motion.duration 1.5 s; motion.law two_thirds; "
#define SCRIBBLE "motion.path scribble; motion.size [6 cm, 4 cm]; motion.rate 2 Hz; motion.duration 2 s; "
#define HAND "grip.angle 30 deg; grip.azimuth 0 deg; grip.friction 0.3; "
#define TAIL                                                                                                           \
    "output.tail 1 s; output.sample_rate 48 kHz; output.encoding pcm24; output.diagnostics.rate 1 kHz; accuracy "      \
    "standard; "

const struct new_starter new_starters[] = {
    {"scrape", "a tool scraped back and forth on a wooden plate",
     "Any material can take the place of the oak: rasp explain surface.material.",
     "rasp 1; title a tool scraped back and forth; seed 1; " ROUGHNESS WOOD SCRAPER STROKES
     "#load.constant 1.5 N; " TAIL},
    {"stroke", "one straight stroke from rest to rest, as a hand makes it",
     "Once across a pane of glass. A shorter duration is a faster stroke, which sounds louder and brighter.",
     "rasp 1; title one stroke from rest to rest; seed 1; " ROUGHNESS GLASS SCRAPER LINE
     "motion.duration 0.8 s; motion.law minimum_jerk; " TAIL},
    {"grip", "a tool held in the hand: the normal force follows the motion",
     "The tool's inertia presses it down where it turns round (equations 8 and 9), and a harder pressed tool follows "
     "the surface more closely (equation 7).",
     "rasp 1; title a tool held in the hand; seed 1; " ROUGHNESS WOOD SCRAPER STROKES HAND
     "#contact.limiter.force_range [0.2 N, 5 N]; " TAIL},
    {"circle", "round and round over the ridges of a steel plate",
     "On a curve the contact meets the ridges at every angle, and the hand's force turns with the acceleration.",
     "rasp 1; title round and round on a ribbed plate; seed 1; " ROUGHNESS
     "surface.ridges.spacing 1 mm; surface.ridges.height 20 um; surface.ridges.direction 90 deg; " STEEL SCRAPER CIRCLE
         HAND TAIL},
    {"pen", "a curve through points, drawn as a hand draws it",
     "Slow in the bends, fast where the curve is straight: the two-thirds power law. On a grain, as of wood, along x.",
     "rasp 1; title a curve as a hand draws it; seed 1; " ROUGHNESS
     "surface.roughness.grain 5; surface.roughness.grain_direction 0 deg; " WOOD SCRAPER STROKE_OF_A_PEN
     "#load.constant 1.5 N; " TAIL},
    {"nail_on_glass", "a nail scribbles on a pane of glass", "A light tip on a smooth surface.",
     "rasp 1; title a nail scribbles on glass; seed 1; surface.roughness.rms 0.5 um; surface.roughness.shortest 10 "
     "um; " GLASS "scraper.mass 3 g; " SCRIBBLE TAIL},
    {"wood_on_sandpaper", "a thin board rubbed on sandpaper",
     "What rings is the board, since the paper lies on a table. Grains lie scattered over fine roughness; the folder "
     "surfaces/ has such recipes with measured figures, to be named by surface.recipe.",
     "rasp 1; title a thin board rubbed on sandpaper; seed 1; surface.roughness.rms 2 um; surface.grit.density 30 "
     "/mm^2; surface.grit.diameter 125 um; surface.grit.height 40 um; scraper.mass 30 g; scraper.material oak; "
     "scraper.band [20 Hz, 12 kHz]; scraper.object.shape plate; "
     "scraper.object.length 15 cm; scraper.object.width 6 cm; scraper.object.thickness 2 mm; scraper.object.at [3 cm, "
     "1 cm]; " STROKES TAIL},
    {"profile", "a measured height profile in place of a synthetic one",
     "Renders with synthetic roughness. For a measured profile, remove the # before height_map (and pitch and "
     "height_scale, which files other than NPY, PNG and CSV hold themselves), and remove the section roughness: else "
     "the two add up.",
     "rasp 1; title a measured surface; #surface.height_map profile.npy; #surface.pitch 5 um; #surface.height_scale 1 "
     "um; surface.along path; #surface.off_map mirror; " ROUGHNESS WOOD SCRAPER LINE "motion.speed 10 cm/s; " TAIL},
    {"paper", "the contact force exactly as the 2021 paper prints it",
     "Equations 2 and 3 as printed, instead of the default, which keeps momentum.",
     "rasp 1; title the equations as printed; seed 1; " ROUGHNESS WOOD SCRAPER STROKES HAND
     "contact.force paper; contact.beta1 0.05; contact.beta2 1; contact.limiter.alpha_min 1 cm; "
     "contact.limiter.alpha_max 5 cm; contact.limiter.zeta 0.95; " TAIL},
    {"strike", "a steel ball strikes a glass plate",
     "Both the stiffness of the contact and the plate's modes follow from the materials. With restitution (remove the "
     "#) the ball bounces.",
     "rasp 1; title a steel ball strikes a glass plate; " GLASS
     "scraper.mass 4.1 g; scraper.radius 5 mm; scraper.material steel; motion.path still; motion.at [4 cm, 3 cm]; "
     "motion.duration 0.5 s; contact.model strike; contact.strike.speed 1 m/s; #contact.strike.restitution 0.7; " TAIL},
    {"marble_on_wood", "a marble rolls over a wooden plate",
     "The kinematic model of the 2021 paper: the force follows from the way of the ball's centre over the surface. It "
     "is quick, and the ball never bounces. An offset of the centre of mass (remove the #) makes the force swing with "
     "each turn.",
     "rasp 1; title a marble rolls over wood; seed 1; " ROUGHNESS WOOD
     "ball.radius 8 mm; ball.material glass; #ball.offset 0.5 mm; " LINE
     "motion.speed 20 cm/s; contact.model roll; contact.roll.mu 1 s/m; #contact.roll.static_penetration 8 "
     "um; contact.roll.scraping 1; " TAIL},
    {"marble_drop", "a marble is dropped on a glass plate, bounces and rolls",
     "The coupled model solves flight, contact and the plate's modes together: the ball lifts off and lands as its "
     "mass, the contact and the modes have it, and the CSV keeps its energy's ledger. A drop of 0 lays the ball down.",
     "rasp 1; title a marble dropped on a glass plate, which it rolls along; seed 1; surface.roughness.rms 0.2 "
     "um; " GLASS "ball.radius 8 mm; ball.material glass; " LINE
     "motion.speed 20 cm/s; contact.model roll_coupled; contact.roll.mu 1 s/m; #contact.roll.integrator rk4; "
     "#contact.roll.ground rigid; contact.roll.drop 5 mm; " TAIL},
    {"impacts", "a series of impacts drawn from its statistics: rolling, rubbing, scratching",
     "Conan's rolling of 2014: no ball and no surface's shape, but size, velocity and roughness as one hears them. "
     "Other prototypes: rub, scratch, and the space between.",
     "rasp 1; title rolling, drawn from the statistics of its impacts; seed 1; " GLASS LINE
     "motion.speed 20 cm/s; contact.model impacts; contact.impacts.prototype roll; contact.impacts.size 0.3; "
     "contact.impacts.velocity 0.5; contact.impacts.roughness 0.5; #contact.gesture.cutoff 4 kHz; " TAIL},
    {"contacts", "two tools on one plate, whose sounds add up",
     "Every contact has its own surface, scraper and motion; rasp render --set contacts.comb.gain=0.2 changes one.",
     "rasp 1; title two tools on one plate; seed 1; "
     "-; "
     "name rod; " ROUGHNESS WOOD SCRAPER LINE "motion.speed 5 cm/s; "
     "-; "
     "name comb; start 0.5 s; gain 0.5; surface.roughness.rms 9 um; " WOOD "scraper.mass 8 g; " LINE
     "motion.speed 20 cm/s; "
     ".; " TAIL},
    {"design", "not a scene, but a design: a set of stimuli, for rasp batch", NULL, NULL},
    {NULL, NULL, NULL, NULL},
};

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

void new_print(FILE *f, const struct new_starter *s, struct arena *a)
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
              "  surface.material: [oak, glass]   # a key of scenes: its levels are its values\n"
              "  motion.rate: [1 Hz, 2 Hz]\n"
              "# exclude:                   # cells that the set does not have\n"
              "#   - {surface.material: oak, motion.rate: 2 Hz}\n"
              "replicates: 2                # of each cell, with other noise\n"
              "# order: {seed: 1}           # shuffled; else as written\n"
              "name: \"{surface.material}_{motion.rate}_{replicate}\"\n"
              "text: \"{surface.material}, scraped at {motion.rate}\"   # for the trial; a level may have a text of "
              "its own\n"
              "level: {common: {peak: -3 dB}}   # one gain for all; each: one for each; scene: as the scenes say\n"
              "length: longest              # as long as the longest; a time; or own\n"
              "# recordings:                # WAV files that are part of the set\n"
              "#   - {file: real.wav, name: real_oak, surface.material: oak}\n",
              f);
        return;
    }
    fprintf(f, "# ");
    text_wrap(f, s->about, 2, "# ");
    fprintf(f, "# Every key: rasp explain. One key: rasp explain motion.rate. A bare number is in SI units.\n\n");
    const struct keys_style *style = &scene;
    for (struct keys_line *first = new_lines(s->text, a), *l = first; first->path; l++)
        if (!l->path || !l->value) { /* as far as one map goes */
            keys_yaml_print(f, first, (int)(l - first), style);
            if (!l->path) break;
            if (*l->path == '-' && style == &scene) fputs("\ncontacts:\n", f);
            style = *l->path == '-' ? &contact : &scene;
            first = l + 1;
        } else {
            if (style == &contact) continue;
            const struct key *k = keys_find(l->path);
            l->comment = k ? k->meaning : NULL;
            for (const struct keys_text_frame *p = keys_text_frames; p->path; p++)
                if (!strcmp(p->path, l->path)) l->comment = p->meaning;
        }
}

static int new_run(struct cmd_call *c, struct err *e)
{
    const char *name = c->args.n_operands ? c->args.operands[0] : new_starters[0].name, *names[32] = {NULL};
    const char *file = args_value(&c->args, "output");
    const struct new_starter *s = NULL;
    bool list = args_given(&c->args, "list");
    for (int i = 0; new_starters[i].name && i < 31; i++) {
        names[i] = new_starters[i].name;
        if (list) printf("%-18s %s\n", names[i], new_starters[i].summary);
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
        new_print(o.stream, s, c->arena);
        outfile_commit(&o, e);
    } else
        new_print(stdout, s, c->arena);
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
    .does =
        "Writes the starter scene NAME (scrape, if none is named), with every line explained. It renders to a sound "
        "as it is and reads no file. NAME design is a starter design of a set of stimuli (rasp-design(5)), whose "
        "base is the scene scrape.yaml beside it.",
    .operands = "[NAME]",
    .least = 0,
    .most = 1,
    .options = options,
    .examples = "rasp new --list                  # which there are\n"
                "rasp new -o scrape.yaml          # the default\n"
                "rasp new wood_on_sandpaper | rasp render /dev/stdin -o sandpaper.wav\n"
                "rasp new design -o set.yaml      # four conditions of scrape.yaml, twice each, for rasp batch\n",
    .run = new_run,
};
