/* The starter design: what most sets need is on, the rest behind a #. */
#include "cmd/starters.h"

#include <stdbool.h>
#include <string.h>

#include "base/wrap.h"
#include "scene/keys_text.h"

/* Within braces a comma ends a plain text; more than that ends or begins otherwise. */
static const char *response(const char *irs, const char *name, struct arena *a)
{
    const char *file = arena_format(a, "%s/%s", irs, name);
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._/-";
    return file[0] == '-' || file[strspn(file, plain)] ? keys_yaml_quoted(file, a) : file;
}

/* Starter scenes as lines of keys and values; the comment above a key is its meaning in keys.def. They render as they
   are: no line that is on names a file. The shipped responses that are off fit the motion: tables with places on y = 0
   where it is a line along x, else one response that holds everywhere. */

#define ON(where, what)                                                                                                \
    {                                                                                                                  \
        .path = where, .value = what                                                                                   \
    }
#define OFF(where, what)                                                                                               \
    {                                                                                                                  \
        .path = where, .value = what, .off = true                                                                      \
    }
#define END                                                                                                            \
    {                                                                                                                  \
        .path = NULL                                                                                                   \
    }
#define ROUGHNESS                                                                                                      \
    ON("surface.roughness.exponent", "-2.4"), ON("surface.roughness.rms", "4 um"),                                     \
        ON("surface.roughness.longest", "2 mm"), ON("surface.roughness.shortest", "20 um")
#define PLANK OFF("surface.response", "irs/oak_plank.csv")
#define TILE OFF("surface.response", "irs/ceramic_tile_tap.wav")
#define SCRAPER ON("scraper.mass", "20 g"), OFF("scraper.response", "irs/pvc_rod.csv"), OFF("scraper.weight", "0.03")
#define STROKES                                                                                                        \
    ON("motion.path", "back_and_forth"), ON("motion.from", "[0 cm, 0 cm]"), ON("motion.to", "[4.5 cm, 0 cm]"),         \
        ON("motion.rate", "2 Hz"), ON("motion.duration", "2 s")
#define LINE ON("motion.path", "line"), ON("motion.from", "[0 cm, 0 cm]"), ON("motion.to", "[10 cm, 0 cm]")
#define CIRCLE                                                                                                         \
    ON("motion.path", "circle"), ON("motion.center", "[5 cm, 5 cm]"), ON("motion.radius", "2 cm"),                     \
        ON("motion.turns", "3"), ON("motion.speed", "20 cm/s")
#define STROKE_OF_A_PEN                                                                                                \
    ON("motion.path", "spline"),                                                                                       \
        ON("motion.points", "[[0 cm, 0 cm], [3 cm, 2 cm], [5 cm, 0 cm], [3 cm, -1 cm], [8 cm, 1 cm]]"),                \
        ON("motion.duration", "1.5 s"), ON("motion.law", "two_thirds")
#define HAND ON("grip.angle", "30 deg"), ON("grip.azimuth", "0 deg"), ON("grip.friction", "0.3")
#define PLATE                                                                                                          \
    ON("surface.object.shape", "plate"), ON("surface.object.length", "30 cm"), ON("surface.object.width", "20 cm"),    \
        ON("surface.object.thickness", "3 mm"), ON("surface.object.origin", "[-10 cm, -8 cm]")
#define OUTPUT                                                                                                         \
    ON("output.sample_rate", "48 kHz"), ON("output.encoding", "pcm24"), ON("output.diagnostics.rate", "1 kHz")
#define TAIL OUTPUT, ON("accuracy", "standard"), END

static const struct keys_line scrape[] = {ON("rasp", "1"),
                                          ON("title", "a tool scraped back and forth"),
                                          ON("seed", "1"),
                                          ROUGHNESS,
                                          PLANK,
                                          SCRAPER,
                                          STROKES,
                                          OFF("load.constant", "1.5 N"),
                                          TAIL};

static const struct keys_line stroke[] = {ON("rasp", "1"),
                                          ON("title", "one stroke from rest to rest"),
                                          ON("seed", "1"),
                                          ROUGHNESS,
                                          PLANK,
                                          SCRAPER,
                                          LINE,
                                          ON("motion.duration", "0.8 s"),
                                          ON("motion.law", "minimum_jerk"),
                                          TAIL};

static const struct keys_line grip[] = {ON("rasp", "1"),
                                        ON("title", "a tool held in the hand"),
                                        ON("seed", "1"),
                                        ROUGHNESS,
                                        PLANK,
                                        SCRAPER,
                                        STROKES,
                                        HAND,
                                        OFF("contact.limiter.force_range", "[0.2 N, 5 N]"),
                                        TAIL};

static const struct keys_line circle[] = {ON("rasp", "1"),
                                          ON("title", "round and round on a ribbed plate"),
                                          ON("seed", "1"),
                                          ROUGHNESS,
                                          ON("surface.ridges.spacing", "1 mm"),
                                          ON("surface.ridges.height", "20 um"),
                                          ON("surface.ridges.direction", "90 deg"),
                                          TILE,
                                          SCRAPER,
                                          CIRCLE,
                                          HAND,
                                          TAIL};

static const struct keys_line pen[] = {ON("rasp", "1"),
                                       ON("title", "a curve as a hand draws it"),
                                       ON("seed", "1"),
                                       ROUGHNESS,
                                       ON("surface.roughness.grain", "5"),
                                       ON("surface.roughness.grain_direction", "0 deg"),
                                       TILE,
                                       SCRAPER,
                                       STROKE_OF_A_PEN,
                                       OFF("load.constant", "1.5 N"),
                                       TAIL};

static const struct keys_line sandpaper[] = {ON("rasp", "1"),
                                             ON("title", "scribbling on sandpaper"),
                                             ON("seed", "1"),
                                             ON("surface.roughness.rms", "2 um"),
                                             ON("surface.grit.density", "30 /mm^2"),
                                             ON("surface.grit.diameter", "125 um"),
                                             ON("surface.grit.height", "40 um"),
                                             TILE,
                                             SCRAPER,
                                             ON("motion.path", "scribble"),
                                             ON("motion.size", "[6 cm, 4 cm]"),
                                             ON("motion.rate", "2 Hz"),
                                             ON("motion.duration", "2 s"),
                                             TAIL};

static const struct keys_line profile[] = {ON("rasp", "1"),
                                           ON("title", "a measured surface"),
                                           OFF("surface.height_map", "profile.npy"),
                                           OFF("surface.pitch", "5 um"),
                                           OFF("surface.height_scale", "1 um"),
                                           ON("surface.along", "path"),
                                           OFF("surface.off_map", "mirror"),
                                           ROUGHNESS,
                                           PLANK,
                                           SCRAPER,
                                           LINE,
                                           ON("motion.speed", "10 cm/s"),
                                           TAIL};

static const struct keys_line paper[] = {ON("rasp", "1"),
                                         ON("title", "the equations as printed"),
                                         ON("seed", "1"),
                                         ROUGHNESS,
                                         PLANK,
                                         SCRAPER,
                                         STROKES,
                                         HAND,
                                         ON("contact.force", "paper"),
                                         ON("contact.beta1", "0.05"),
                                         ON("contact.beta2", "1"),
                                         ON("contact.limiter.alpha_min", "1 cm"),
                                         ON("contact.limiter.alpha_max", "5 cm"),
                                         ON("contact.limiter.zeta", "0.95"),
                                         TAIL};

static const struct keys_line object[] = {ON("rasp", "1"),
                                          ON("title", "a stick scraped across a glass plate"),
                                          ON("seed", "1"),
                                          ROUGHNESS,
                                          ON("surface.material", "glass"),
                                          PLATE,
                                          ON("scraper.mass", "20 g"),
                                          LINE,
                                          ON("motion.duration", "0.8 s"),
                                          ON("motion.law", "minimum_jerk"),
                                          TAIL};

static const struct keys_line strike[] = {ON("rasp", "1"),
                                          ON("title", "a steel ball strikes a glass plate"),
                                          ON("surface.material", "glass"),
                                          PLATE,
                                          ON("scraper.mass", "4.1 g"),
                                          ON("scraper.radius", "5 mm"),
                                          ON("scraper.material", "steel"),
                                          ON("motion.path", "still"),
                                          ON("motion.at", "[4 cm, 3 cm]"),
                                          ON("motion.duration", "0.5 s"),
                                          ON("contact.model", "strike"),
                                          ON("contact.strike.speed", "1 m/s"),
                                          OFF("contact.strike.restitution", "0.7"),
                                          TAIL};

static const struct keys_line roll[] = {ON("rasp", "1"),
                                        ON("title", "a marble rolls over a plank"),
                                        ON("seed", "1"),
                                        ROUGHNESS,
                                        PLANK,
                                        ON("ball.radius", "8 mm"),
                                        ON("ball.material", "glass"),
                                        OFF("ball.offset", "0.5 mm"),
                                        OFF("ball.response", "irs/glass_ball.csv"),
                                        OFF("ball.weight", "10"),
                                        LINE,
                                        ON("motion.speed", "20 cm/s"),
                                        ON("contact.model", "roll"),
                                        ON("contact.roll.mu", "1 s/m"),
                                        OFF("contact.roll.static_penetration", "8 um"),
                                        ON("contact.roll.scraping", "1"),
                                        TAIL};

static const struct keys_line roll_coupled[] = {ON("rasp", "1"),
                                                ON("title", "a marble dropped on a glass plate, which it rolls along"),
                                                ON("seed", "1"),
                                                ON("surface.roughness.rms", "0.2 um"),
                                                ON("surface.material", "glass"),
                                                PLATE,
                                                ON("ball.radius", "8 mm"),
                                                ON("ball.material", "glass"),
                                                LINE,
                                                ON("motion.speed", "20 cm/s"),
                                                ON("contact.model", "roll_coupled"),
                                                ON("contact.roll.mu", "1 s/m"),
                                                OFF("contact.roll.integrator", "rk4"),
                                                OFF("contact.roll.ground", "rigid"),
                                                ON("contact.roll.drop", "5 mm"),
                                                TAIL};

static const struct keys_line impacts[] = {ON("rasp", "1"),
                                           ON("title", "rolling, drawn from the statistics of its impacts"),
                                           ON("seed", "1"),
                                           ON("surface.material", "glass"),
                                           PLATE,
                                           LINE,
                                           ON("motion.speed", "20 cm/s"),
                                           ON("contact.model", "impacts"),
                                           ON("contact.impacts.prototype", "roll"),
                                           ON("contact.impacts.size", "0.3"),
                                           ON("contact.impacts.velocity", "0.5"),
                                           ON("contact.impacts.roughness", "0.5"),
                                           OFF("contact.gesture.cutoff", "4 kHz"),
                                           TAIL};

static const struct keys_line contacts_head[] = {ON("rasp", "1"), ON("title", "two tools on one plank"),
                                                 ON("seed", "1"), END};
static const struct keys_line contacts_rod[] = {
    ON("name", "rod"), ROUGHNESS, PLANK, SCRAPER, LINE, ON("motion.speed", "5 cm/s"), END};
static const struct keys_line contacts_comb[] = {ON("name", "comb"),
                                                 ON("start", "0.5 s"),
                                                 ON("gain", "0.5"),
                                                 ON("surface.roughness.rms", "9 um"),
                                                 PLANK,
                                                 ON("scraper.mass", "8 g"),
                                                 LINE,
                                                 ON("motion.speed", "20 cm/s"),
                                                 END};
static const struct keys_line contacts_tail[] = {TAIL};

const struct starter starters_table[] = {
    {"scrape",
     "a tool scraped back and forth on a rough surface",
     "The forces of a scrape go into a CSV. For sound, give the surface or the scraper a response: remove the # before "
     "it.",
     scrape,
     {NULL},
     NULL},
    {"stroke",
     "one straight stroke from rest to rest",
     "One stroke as a hand makes it. For sound, give the surface or the scraper a response.",
     stroke,
     {NULL},
     NULL},
    {"grip",
     "a tool held in the hand: the normal force follows the motion",
     "The tool's inertia presses it down where it turns round (equations 8 and 9), and a harder pressed tool follows "
     "the surface more "
     "closely (equation 7). For sound, give the surface or the scraper a response.",
     grip,
     {NULL},
     NULL},
    {"circle",
     "round and round over ridges, with a hand's force",
     "On a curve the contact meets the ridges at every angle, and the hand's force turns with the acceleration. For "
     "sound, give the surface or the "
     "scraper a response.",
     circle,
     {NULL},
     NULL},
    {"pen",
     "a curve through points, drawn as a hand draws it",
     "Slow in the bends, fast where the curve is straight: the two-thirds power law. On a grain, as of wood, along x. "
     "For sound, give the surface or "
     "the scraper a response.",
     pen,
     {NULL},
     NULL},
    {"sandpaper",
     "a scribble over grit",
     "Grains lie scattered over fine roughness; the folder surfaces/ has such recipes with measured figures, to be "
     "named by surface.recipe. For sound, "
     "give the surface or the scraper a response.",
     sandpaper,
     {NULL},
     NULL},
    {"profile",
     "a measured height profile in place of a synthetic one",
     "Renders with synthetic roughness. For a measured profile, remove the # before height_map (and pitch and "
     "height_scale, which files other than NPY, "
     "PNG and CSV hold themselves), and remove the section roughness: else the two add up.",
     profile,
     {NULL},
     NULL},
    {"paper",
     "the contact force exactly as the 2021 paper prints it",
     "Equations 2 and 3 as printed, instead of the default, which keeps momentum.",
     paper,
     {NULL},
     NULL},
    {"object",
     "a scrape of an object that rings: its modes follow from size and material",
     "The plate's modes are computed from its size and material, which need no file; it is heard where it is touched, "
     "since output.listen says nothing else.",
     object,
     {NULL},
     NULL},
    {"strike",
     "an impact on an object that rings",
     "A ball strikes a plate once, and both its stiffness and the plate's modes follow from the materials. With "
     "restitution (remove the #) it bounces.",
     strike,
     {NULL},
     NULL},
    {"roll",
     "a ball that rolls: the force follows from its centre's way over the surface",
     "The kinematic model of the 2021 paper: quick, and it never bounces. An offset of the centre of mass (remove the "
     "#) makes the normal force, and with it the ball's, swing with each turn. "
     "For sound, give the surface or the ball a response.",
     roll,
     {NULL},
     NULL},
    {"roll_coupled",
     "a ball that is dropped, bounces and rolls: flight, contact and the plate's modes solved together",
     "The coupled model: the ball lifts off and lands as its mass, the contact and the surface's modes have it, and "
     "the CSV keeps its energy's ledger. A drop of 0 lays "
     "the ball down.",
     roll_coupled,
     {NULL},
     NULL},
    {"impacts",
     "a series of impacts drawn from its statistics: rolling, rubbing, scratching",
     "Conan's rolling of 2014: no ball and no surface's shape, but size, velocity and roughness as one hears them. "
     "Other prototypes: rub, scratch, and the space between.",
     impacts,
     {NULL},
     NULL},
    {"contacts",
     "two contacts whose sounds add up",
     "Every contact has its own surface, scraper and motion; rasp render --set contacts.comb.gain=0.2 changes one.",
     contacts_head,
     {contacts_rod, contacts_comb},
     contacts_tail},
    {"design", "not a scene, but a design: a set of stimuli, for rasp batch", NULL, NULL, {NULL}, NULL},
    {NULL, NULL, NULL, NULL, {NULL}, NULL},
};

const struct starter *starters_find(const char *name)
{
    for (const struct starter *s = starters_table; s->name; s++)
        if (!strcmp(s->name, name)) return s;
    return NULL;
}

static const char *meaning(const char *path)
{
    const struct key *k = keys_find(path);
    for (const struct keys_text_frame *p = keys_text_frames; p->path; p++)
        if (!strcmp(p->path, path)) return p->meaning;
    return k ? k->meaning : NULL;
}

/* "irs/oak_plank.csv", in the folder that `irs` names. */
static const char *found_in(const char *irs, const char *value, struct arena *a)
{
    return strncmp(value, "irs/", 4) ? value : arena_format(a, "%s/%s", irs, value + 4);
}

struct printing {
    FILE *f;
    const char *irs;
    struct arena *arena;
};

static void print_lines(const struct printing *p, const struct keys_line *lines, const struct keys_style *style)
{
    int n = 0;
    while (lines[n].path)
        n++;
    struct keys_line *told = ARENA_TAKE(p->arena, struct keys_line, n);
    for (int i = 0; i < n; i++) {
        told[i] = lines[i];
        told[i].value = found_in(p->irs, lines[i].value, p->arena);
        told[i].comment = style->comments ? meaning(lines[i].path) : NULL;
    }
    keys_yaml_print(p->f, told, n, style);
}

void starters_print(FILE *f, const struct starter *s, const char *irs, struct arena *a)
{
    struct printing p = {f, irs, a};
    if (!s->head) {
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
    wrap_print(f, s->about, 2, "# ");
    fprintf(f, "# Every key: rasp explain. One key: rasp explain motion.rate. A bare number is in SI units.\n"
               "# Responses to begin with are in irs/ of rasp's folder (installed: share/rasp/), surfaces in "
               "surfaces/. Those named here fit the motion.\n\n");
    print_lines(&p, s->head, &(struct keys_style){.comments = true});
    if (s->items[0]) fputs("\ncontacts:\n", f);
    for (int i = 0; s->items[i]; i++)
        print_lines(&p, s->items[i], &(struct keys_style){.indent = 4, .item = true});
    if (s->tail) print_lines(&p, s->tail, &(struct keys_style){.comments = true});
}
