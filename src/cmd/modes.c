/* rasp modes ACTION: how objects ring, apart from any contact. Each action is a file of its own. */
#include "cmd/modes.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/interrupt.h"
#include "base/outfile.h"
#include "cmd/cmd.h"
#include "scene/units.h"

bool modes_output_spares(const char *output, const char *input, struct err *e)
{
    return cmd_spares(output, "the table", input, "-o OTHER.csv", e);
}

bool modes_output_possible(const char *output, struct err *e)
{
    struct outfile o;
    if (!outfile_open_fd(&o, output, e)) return false;
    outfile_drop(&o);
    return true;
}

void modes_damping_write(FILE *f, const double damping[3], const struct material *m, bool own, bool own_damping)
{
    static const char mixed[] = "the object's own figures, else ";
    fprintf(f, "# damping: decay = (alpha + beta w^2 + loss w)/2, alpha %.9g 1/s, beta %.9g s, loss factor %.9g\n",
            damping[0], damping[1], damping[2]);
    if (m)
        fprintf(f, "# source: %s%s\n# source_of_damping: %s%s\n", own ? mixed : "", m->source, own_damping ? mixed : "",
                m->damping_source);
    else
        fputs("# source: the object's own figures\n", f);
}

/* Runs rasp-modes in place of rasp, with the same words: it stands beside rasp, or, installed, in ../libexec/rasp.

   OpenBLAS reads when it is loaded which of its kernels to use, and each adds in an order of its own. Here are taken
   those that every x86-64 CPU can run, whatever the CPU and the environment say, so that a solid has one table: shapes
   differ by up to 1e-9 between kernels, which no rounding hides in all of thousands of gains. The others are faster by
   a quarter. */

enum { PATH_LENGTH = 4096 };

static int modes_elsewhere_run(struct cmd_call *c, struct err *e)
{
    static const char *const places[] = {"rasp-modes", "../libexec/rasp/rasp-modes"};
    char self[PATH_LENGTH];
    ssize_t n = readlink("/proc/self/exe", self, sizeof self - 1);
    self[n > 0 ? n : 0] = '\0';
    char *slash = strrchr(self, '/');
    if (slash) slash[1] = '\0';
    char **argv = arena_take(c->arena, (size_t)c->argc + 2, sizeof *argv);
    argv[0] = arena_text(c->arena, "rasp-modes");
    memcpy(argv + 1, c->argv, (size_t)c->argc * sizeof *argv);
    argv[c->argc + 1] = NULL;
    if (!interrupt_pass_on()) {
        err_set(e, ERR_INTERRUPTED, "interrupted; run the same command again");
        return (int)e->kind;
    }
    setenv("OPENBLAS_CORETYPE", "Prescott", 1);
    setenv("OPENBLAS_NUM_THREADS", "1", 1);
    for (size_t i = 0; i < sizeof places / sizeof *places; i++)
        execv(arena_format(c->arena, "%s%s", self, places[i]), argv);
    err_set(e, ERR_UNBUILT,
            "cannot run rasp-modes, which stands beside rasp or in ../libexec/rasp: %s; `make` builds it",
            strerror(errno));
    return (int)e->kind;
}

bool modes_lengths(struct cmd_call *c, const char *name, const char *form, int count, double *x, struct err *e)
{
    const char *text = args_value(&c->args, name);
    int n = 0;
    for (char *rest = text ? arena_text(c->arena, text) : NULL, *p; (p = strsep(&rest, ",")); n++) {
        struct units_fault fault = {NULL, NULL};
        if (n < count && !units_read(p, KEY_LENGTH, &x[n], c->arena, &fault))
            return err_set(e, ERR_USAGE, "--%s: '%s': '%s' %s", name, text, p, fault.text);
    }
    return !text || n == count ||
           err_set(e, ERR_USAGE, "--%s: '%s' is not of the form %s, each a length", name, text, form);
}

bool modes_quantity(struct cmd_call *c, int *quantity, struct err *e)
{
    static const char *const words[] = {"displacement", "velocity", "acceleration", NULL};
    *quantity = MODES_VELOCITY;
    return args_word(&c->args, "quantity", words, quantity, e);
}

const char *modes_per_impulse(int quantity)
{
    static const char *const units[] = {
        [MODES_DISPLACEMENT] = "m/(N s)", [MODES_VELOCITY] = "(m/s)/(N s)", [MODES_ACCELERATION] = "(m/s^2)/(N s)"};
    return units[quantity];
}

/* compute and material are the other program's (modes_elsewhere_run). */
static const struct action actions[] = {
    {"object",
     "one RECIPE or SCENE",
     1,
     1,
     {"output", "force", "line", "circle", "places", "grid", "at", "listen", "load", "modes", "top", "quantity", "body",
      "set", "seed", "quiet"},
     modes_object_run},
    {"compute",
     "one MESH, or --shape",
     0,
     1,
     {"output",  "force",  "shape", "order", "grade",  "estimate", "unit",   "material", "youngs-modulus", "poisson",
      "density", "alpha",  "beta",  "loss",  "clamp",  "support",  "modes",  "top",      "face",           "line",
      "circle",  "places", "grid",  "at",    "points", "listen",   "origin", "quantity", "title",          "quiet"},
     modes_elsewhere_run},
    {"extract",
     "RECORDING...",
     1,
     -1,
     {"output",           "force",   "channel",     "force-channel", "scale", "force-scale", "quantity", "radius",
      "distance",         "delay",   "impulse",     "modes",         "low",   "high",        "fastest",  "method",
      "strike-threshold", "strikes", "resynthesis", "residual",      "plot",  "envelopes",   "json",     "quiet"},
     modes_extract_run},
    {"material",
     "an OBJECT and its STRIKE..., as often as there are objects, or STRIKE... alone",
     1,
     -1,
     {"output", "force",       "name",       "density", "mass",   "poisson", "gamma", "material",
      "modes",  "order",       "grade",      "unit",    "clamp",  "support", "face",  "origin",
      "listen", "model-error", "size-error", "method",  "starts", "polish",  "json",  "quiet"},
     modes_elsewhere_run},
    {"residual",
     "RECORDING and TABLE",
     2,
     2,
     {"output", "force", "channel", "force-channel", "scale", "force-scale", "quantity", "delay", "impulse", "low",
      "high", "strike-threshold", "strikes", "estimated", "residual-domain", "keep-noise", "json", "quiet"},
     modes_residual_run},
    {"list",
     "one FILE: a mode table (.csv), RECIPE or SCENE",
     1,
     1,
     {"at", "modes", "top", "body", "set", "seed"},
     modes_object_list_run},
    {NULL, NULL, 0, 0, {NULL}, NULL},
};

int modes_solids_only(struct cmd_call *c, struct err *e, int (*const run[2])(struct cmd_call *c, struct err *e))
{
    struct action mine[3];
    int n = 0;
    memset(mine, 0, sizeof mine);
    for (const struct action *a = actions; a->name; a++)
        if (a->run == modes_elsewhere_run) {
            mine[n] = *a;
            mine[n].run = run[n];
            n++;
        }
    return cmd_actions("modes", mine, c, e);
}

static const struct args_option options[] = {
    {"output", 'o', "FILE.csv", false,
     "object, compute, extract: the mode table to write; material: the file of the material; residual: the folder; "
     "must be given"},
    {"force", 'f', NULL, false, "object, compute, extract, material, residual: replaces what exists"},
    {"shape", 0, "SHAPE", false, "compute: a solid by its sizes, such as plate:length=30cm,width=20cm,thickness=5mm"},
    {"order", 0, "N", false,
     "compute, material: of the polynomials that an element moves by, 2 to 4 (default 3, of a bowl and a mug 4; of a "
     "mesh file compute 2, material 4, of more than 4000 tetrahedra 3)"},
    {"grade", 0, "N", false,
     "compute, material: layers of cells, each a fifth as far from it, towards every re-entrant edge (220 degrees or "
     "more inside the solid), 0 to 6 (default 2). Without them frequencies of what has such edges are up to 1 % too "
     "high"},
    {"estimate", 0, NULL, false,
     "compute: estimates the error of every frequency from a second, coarser computation, into the report and the "
     "table's comments"},
    {"unit", 0, "LENGTH", false, "compute, material: what one unit of the mesh file is, such as mm (default m)"},
    {"material", 0, "NAME", false,
     "compute: a material that rasp knows, or FILE.yaml:NAME of a file with materials (of one, FILE.yaml); "
     "--youngs-modulus, --poisson, --density, --alpha, --beta and --loss put their figures in place of its own. For "
     "material: a wood, whose moduli keep their ratios to that along the grain"},
    {"youngs-modulus", 0, "PRESSURE", false,
     "compute: Young's modulus, of a wood that along the grain, x (its other moduli keep their ratios to it)"},
    {"poisson", 0, "NUMBER", false, "compute: Poisson's ratio; material: the same, given and not looked for"},
    {"density", 0, "DENSITY", false, "compute, material: density"},
    {"mass", 0, "MASS", true, "material: what the object weighs; of several objects once for each, in their order"},
    {"name", 0, "NAME", false, "material: its name in the file; default: that of the file"},
    {"gamma", 0, "LOW,HIGH", false, "material: E/density is looked for from LOW to HIGH, m^2/s^2 (default 1e5,5e8)"},
    {"model-error", 0, "SHARE", false,
     "material: standard error of computed frequencies besides the mesh's, such as 0.3% (default 0.1%)"},
    {"size-error", 0, "SHARE", false,
     "material: standard error of the object's lengths, such as 1%: all together too long or too short"},
    {"alpha", 0, "RATE", false, "compute: Rayleigh's damping C = alpha M + beta K, in 1/s"},
    {"beta", 0, "TIME", false, "compute: Rayleigh's damping, in s"},
    {"loss", 0, "NUMBER", false,
     "compute: loss factor; a mode of angular frequency w decays with (alpha + beta w^2 + loss w)/2"},
    {"clamp", 0, "FACE", true,
     "compute, material: a face that does not move: x0, x1, y0 ... (where the solid ends), or its name in the mesh"},
    {"support", 0, "FACE", true,
     "compute, material: a face that moves along its normal only: a hinge, for what is thin"},
    {"face", 0, "top|bottom|right|left|back|front|around|inside", false,
     "compute, material: the side on which the places are (around: x is the arc round the z axis, y the height); "
     "default: top"},
    {"line", 0, "X0,Y0,X1,Y1", false, "object, compute: places on a line, its two ends"},
    {"circle", 0, "RADIUS", false, "object, compute: places on a circle round (0, 0)"},
    {"places", 0, "N", false,
     "object, compute: how many places on the line or circle; default: on a circle 33, on a line as --grid says"},
    {"grid", 0, "NX,NY", false,
     "object, compute: places on a grid over the object. Those beside it (of what is round) are left out, and between "
     "what is then no full grid gains are linear, else smooth. The default is a grid, over what is round rings as far "
     "as its surface has no edge (a bowl: to its lip). It has as many places as keep the gains of all modes between "
     "the places, as a scene interpolates them, within -40 dB (rms, relative to the gains, at 512 places). They are at "
     "most 4096, and 500000 rows; what error is left is reported"},
    {"at", 0, "X,Y", false, "one place"},
    {"points", 0, "FILE.csv", false,
     "compute: places by points of space, columns x_m, y_m, z_m, and u_m, v_m where the scene has them (else x_m, "
     "y_m)"},
    {"listen", 0, "X,Y", false,
     "object, compute, material: the place that is heard (compute also X,Y,Z); default: the place that is touched"},
    {"origin", 0, "X,Y", false, "compute, material: where the solid's x = y = 0 lies in the scene"},
    {"load", 0, "MASS", false,
     "object: a mass that rests where the object is touched and lowers its frequencies: a table of separate poles"},
    {"modes", 0, "N", false,
     "how many modes, the strongest, of compute and material the lowest; default: object all below --top, compute 100, "
     "extract 50, list 20, material 20 and half as many again as a strike has"},
    {"channel", 0, "N", false, "extract: the channel that holds the sound, from 1 (default 1)"},
    {"force-channel", 0, "N", false, "extract: the channel that holds the hammer's force"},
    {"scale", 0, "NUMBER", false,
     "extract: what full scale (floating point: 1) of the sound's channel stands for, in m, m/s, m/s^2 or Pa"},
    {"force-scale", 0, "NEWTONS", false,
     "extract: what full scale (floating point: 1) of the force's channel stands for"},
    {"radius", 0, "LENGTH", false,
     "extract: of a sphere of the object's size; with --distance a microphone's pressure is turned into the surface's "
     "velocity"},
    {"distance", 0, "LENGTH", false, "extract: from that sphere's middle to the microphone"},
    {"delay", 0, "TIME", false,
     "extract: by which the sound's channel comes after the force's; default: of pressure, and with --impulse behind "
     "silence, found in the response, else 0"},
    {"impulse", 0, NULL, false, "extract: the recordings are impulse responses already, sample 0 at the strike"},
    {"low", 0, "FREQUENCY", false, "extract: modes are looked for from here on; default: 20 Hz"},
    {"high", 0, "FREQUENCY", false,
     "extract: ... up to here; default: as far as the hammer's force reaches, 40 dB below its greatest power"},
    {"fastest", 0, "RATE", false,
     "extract: the fastest decay that is taken for a mode, in 1/s; default: 600, or a 20th of the sample rate if that "
     "is less"},
    {"method", 0, "esprit|spectrogram|scan|paper", false,
     "extract: spectrogram takes the peaks of the power spectrogram; default: esprit; material: paper searches as "
     "Ren et al. (2013) do, on both metrics, at --poisson (default 0.3); default: scan"},
    {"starts", 0, "N", false, "material: of --method paper (default 10), the best of which counts"},
    {"polish", 0, "perceptual", false,
     "material: moves what was found to where both metrics are least; it has no intervals then"},
    {"strike-threshold", 0, "DECIBEL", false, "extract: by how much a strike must rise above the noise (default 20)"},
    {"strikes", 0, "LIST", false,
     "extract: only these strikes are fitted, as 1,3,5-7; of the others the report says what the modes explain"},
    {"resynthesis", 0, "FILE.wav", false,
     "extract: writes what the modes make of the recording, one channel for each place"},
    {"residual", 0, "FILE.wav", false, "extract: writes what they leave of it"},
    {"plot", 0, "FILE", false, "extract: draws spectrum, modes, levels and decays of the first place, as .png or .svg"},
    {"envelopes", 0, "FILE.csv", false,
     "extract: writes how each mode of each strike falls, A_i(t): the recording's amplitude and phase about its "
     "frequency through Hann windows, and the amplitude of what the modes make of it through the same"},
    {"estimated", 0, "TABLE", false,
     "residual: the modes of the object as it was fitted, such as by compute; what they do not match stays in the "
     "residual"},
    {"residual-domain", 0, "time|power", false,
     "residual: modes are subtracted as they sound, or (power) from the spectrogram's power, where beats of modes and "
     "phases leave -28 to -40 dB of a sound that is nothing but modes; default: time"},
    {"keep-noise", 0, NULL, false, "residual: what is heard before the strike is not taken off"},
    {"json", 0, NULL, false, "extract, material, residual: the report as JSON"},
    {"top", 0, "FREQUENCY", false, "modes of an object above are left out (default 20 kHz)"},
    {"quantity", 0, "displacement|velocity|acceleration|pressure", false,
     "object, compute: the first three, per N s (default velocity); extract: what the sound's channel holds (default "
     "pressure)"},
    {"title", 0, "TEXT", false, "compute: a line for the table"},
    {"body", 0, "surface|scraper|ball", false, "of a scene: whose modes; default: surface"},
    CMD_SCENE_OPTIONS,
    {"quiet", 'q', NULL, false,
     "object, compute, extract, material, residual: prints nothing; what would be warned of stands in the table's "
     "comments all the same"},
    {0}};

const struct command modes_command = {
    .name = "modes",
    .summary = "how objects ring: mode tables",
    .does =
        "rasp modes object RECIPE -o FILE.csv writes the modes of an object of simple shape as a mode table: their "
        "frequencies, decays, and gains at places. RECIPE is a YAML file of surface keys, as in irs/, or a scene. "
        "Rendering needs no such file: a scene's surface.object gives the same modes anywhere.\n"
        "Places are lengths in the object's own coordinates. Of bars, rods, strings, plates and membranes x goes from "
        "0 to the length and y from 0 to the width. Of what is round they go from the centre, and of a shell along "
        "great circles from a pole. Without --line, --grid or --at there is a line along what is slender, a grid on "
        "what is flat, and rings on what is round (as many as --grid says). Of a shell there is its pole, and of a "
        "scraper or ball its object.at. The table has the places where they lie in the scene, moved by "
        "surface.object.origin.\n"
        "rasp modes compute MESH -o FILE.csv writes the modes of any solid, by finite elements. MESH is a mesh of "
        "tetrahedra, of Gmsh (.msh, versions 2.2 and 4.1) or TetGen (.node, .ele). In its place --shape makes one: "
        "plate, bar, rod, ring, bowl, sphere, mug (--shape help lists their sizes).\n"
        "At default fineness and order the 60 lowest modes of steel solids take 4 to 30 s of processor time. Their "
        "frequencies are within about 0.1 % (rods, solid balls), 0.2 % (a mug of 4 mm) and 0.3 % (a plate of 40 x 20 "
        "x 0.5 cm, a hollow ball of 2 mm). They are within 0.5 % for a ring 14 cm wide, 10 x 6 mm (its lowest 0.12 %, "
        "at 14 kHz 0.45 %), and within 0.6 % for a bowl 20 cm wide and 1.5 mm thick.\n"
        "Thinner walls and higher modes want more: frequencies come out too high and fall with fineness, --order and "
        "--grade. The option --estimate says by how much, from a coarser mesh too (Richardson). It cannot see the "
        "error of what both meshes have alike, such as one element through a wall.\n"
        "The solid is touched and heard along its surface's normal. Its places are those of the plane in which a "
        "scene moves: --face says from where that looks at the solid, and --origin where the solid lies in the scene. "
        "Without --line, --circle, --grid, --at or --points they are a grid over what is seen (rings if round), or a "
        "line along what is slender. A table made from the same inputs and not changed since is left as it is.\n"
        "rasp modes list FILE prints the strongest modes of a mode table, recipe or scene: frequency, time of decay "
        "by 60 dB, and largest gain. The gain is the largest of a table over its places, of an object over a grid of "
        "places, or that at one place with --at.",
    .also =
        "rasp modes extract RECORDING... -o FILE.csv writes the modes of an object from recordings in which it is "
        "struck. RECORDING holds one strike or many on one place. Every strike has gains of its own; frequencies and "
        "decays are those of all, within what strikes differ by. A hammer's force (--force-channel) drives the modes, "
        "else a strike is an impulse. Several places are FILE@X,Y each, or one folder with index.csv (columns "
        "file_name,x_m,y_m). They share frequencies and decays. Without a force each has a level and an onset of its "
        "own, so that places cannot be compared.\n"
        "No mode is reported that noise might have made; two decays of one frequency are. A hum, as loud before the "
        "strikes, is no mode. What rings longer than strikes show gets the slowest decay they do. Strikes that clip "
        "or are 30 dB below the loudest sound are left out, and of one doubled by a bouncing hammer the rest is "
        "fitted. Recordings of 8 bits are mostly refused. Modes that explain less than nine tenths of what lags the "
        "force, or less than half in a strike, make no table, nor do those of different objects. Without a force a "
        "second hit within 100 ms is mostly not seen: cut it out.\n"
        "The sound is a microphone's pressure unless --quantity is given. Levels are physical where --scale and "
        "--force-scale are given and the sound is a vibration, or a pressure with --radius and --distance. Else they "
        "are relative, and the table says why.\n"
        "Report and table give two errors. The error se is that by noise, and se_between is the standard deviation "
        "from strike to strike; of one strike that is a stated 0.02 % of frequency and 5 % of decay. Modes come by "
        "energy. Modes that overlap may as well be others: a small change of the recording may bring them out. The "
        "median decay counts all modes alike. The median by energy is for comparing materials: modes that decay more "
        "slowly than it have half of the energy.\n"
        "rasp modes residual RECORDING TABLE -o FOLDER writes what the loudest strike of a recording sounds besides "
        "the modes of TABLE, which extract made of it. It is for surface.residual of a scene. RECORDING, channels, "
        "scales, --quantity, --impulse and --strikes are as for extract. With --estimated a mode is taken off only as "
        "far as a mode of that table matches it (0.1 Bark, a factor of 1.28 in damping): the rest stays. Noise before "
        "the strike is taken off. Where the force was recorded it is divided out, up to a frequency that the report "
        "states.\n"
        "In the folder strike.wav has the represented sound and what is left of the strike, in two channels, as loud "
        "as the recording. The other sound, residual.wav, is a response, in the sound's unit per N s (without a "
        "force, of a strike whose peak is 1): floats that may lie far beyond full scale.\n"
        "rasp modes material OBJECT STRIKE... -o FILE.yaml finds what an object is made of. OBJECT is a mesh, or a "
        "shape as of --shape. Each STRIKE is a table of rasp modes extract, FILE.csv@X,Y where the place that was "
        "struck is known. Several objects of one material stand one after the other, each with its strikes.\n"
        "Found are E/density, Poisson's ratio and damping. All values of E/density are looked through for every "
        "ratio, modes are paired with computed ones, and laws of damping are compared by their BIC. The mass, or the "
        "density, makes E of that. Intervals hold 95 %; where pairs are few, or another material fits nearly as well, "
        "a warning says so and there are none. E/density is that at the sizes given: 1 % of length is 2 % of it, one "
        "length of a bar up to 4 %. Alpha is what material and support take together.\n"
        "The file is an entry of materials, which a scene includes and surface.material names. Strikes without an "
        "object give their damping alone, as a file for surface.recipe.",
    .operands = "ACTION FILE",
    .least = 1,
    .most = -1,
    .options = options,
    .actions = actions,
    .examples = "rasp modes object irs/glass_ball.yaml -o ball.csv\n"
                "rasp modes object irs/basswood_plank.yaml --line 0,3.7cm,40cm,3.7cm --places 33 --listen 11.7cm,2.9cm "
                "-o plank.csv\n"
                "rasp modes object irs/poplar_rod.yaml --set surface.object.length=30cm --at 0,0 -o rod.csv\n"
                "rasp modes object irs/pvc_rod.yaml --load 5g -o loaded.csv\n"
                "rasp modes list irs/pvc_rod.csv\n"
                "rasp modes compute --shape plate:length=20cm,width=15cm,thickness=4mm --material glass --listen "
                "12cm,4cm -o plate.csv\n"
                "rasp modes compute --shape mug:diameter=8cm,height=9cm,wall=4mm --material ceramic --face around --at "
                "3cm,5cm -o mug.csv\n"
                "rasp modes compute --shape bar:length=20cm,width=2cm,thickness=5mm --material steel --order 2 --modes "
                "20 --estimate -o bar.csv\n"
                "rasp modes extract irs/ceramic_tile_tap.wav@15cm,3.7cm --impulse --quantity velocity --scale 1 --plot "
                "tap.png -o tap.csv\n"
                "rasp modes material bar:length=20cm,width=2cm,thickness=5mm bar.csv --order 2 --density 7850 -o "
                "my_steel.yaml\n"
                "rasp render scenes/strike.yaml -o struck.wav\n"
                "rasp modes extract struck.wav --modes 20 --method spectrogram --resynthesis again.wav --residual "
                "rest.wav -o struck.csv\n"
                "rasp modes residual struck.wav struck.csv -o struck.residual\n",
};
