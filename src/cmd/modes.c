/* rasp modes ACTION: how objects ring, apart from any contact. The actions are modes_object.c and modes_list.c. */
#include "cmd/modes.h"

#include <string.h>

#include "cmd/actions.h"
#include "scene/units.h"

bool modes_lengths(struct cmd_call *c, const struct modes_lengths *want, double *x, struct err *e)
{
    const char *text = args_value(&c->args, want->name);
    int n = 0;
    for (char *p = text ? arena_text(c->arena, text) : NULL, *next; p; p = next) {
        struct units_fault fault = {NULL, NULL};
        next = strchr(p, ',');
        if (next)
            *next++ = '\0';
        if (n < want->count && !units_read(p, KEY_LENGTH, &x[n], c->arena, &fault))
            return err_set(e, ERR_USAGE, "--%s: '%s': '%s' %s", want->name, text, p, fault.text);
        n++;
    }
    return !text || n == want->count || err_set(e, ERR_USAGE, "--%s: '%s' is not of the form %s, each a length", want->name, text, want->form);
}

bool modes_quantity(struct cmd_call *c, int *quantity, struct err *e)
{
    const char *text = args_value(&c->args, "quantity");
    *quantity = MODES_VELOCITY;
    if (!text)
        return true;
    for (*quantity = MODES_DISPLACEMENT; *quantity <= MODES_ACCELERATION; ++*quantity)
        if (!strcmp(text, modes_quantity_name(*quantity)))
            return true;
    return err_set(e, ERR_USAGE, "--quantity: '%s' is not displacement, velocity or acceleration", text);
}

const char *modes_per_impulse(int quantity)
{
    static const char *const units[] = {[MODES_DISPLACEMENT] = "m/(N s)", [MODES_VELOCITY] = "(m/s)/(N s)", [MODES_ACCELERATION] = "(m/s^2)/(N s)"};
    return units[quantity];
}

/* compute is the other program's (modes_elsewhere.c). */
static const struct action actions[] = {
    {"object", "one RECIPE or SCENE", 1, 1,
     {"output", "force", "line", "circle", "places", "grid", "at", "listen", "load", "modes", "top", "quantity", "body", "set", "seed", "quiet"}, modes_object_run},
    {"compute", "one MESH, or --shape", 0, 1,
     {"output", "force", "shape", "order", "estimate", "unit", "material", "youngs-modulus", "poisson", "density", "alpha", "beta", "loss", "clamp", "support", "modes", "top", "face",
      "line", "circle", "places", "grid", "at", "points", "listen", "origin", "quantity", "title", "quiet"}, modes_elsewhere_run},
    {"extract", "RECORDING...", 1, -1,
     {"output", "force", "channel", "force-channel", "scale", "force-scale", "quantity", "radius", "distance", "delay", "impulse", "modes", "low", "high", "fastest", "method",
      "strike-threshold", "strikes", "resynthesis", "residual", "plot", "json", "quiet"}, modes_extract_run},
    {"list", "one FILE: a mode table (.csv), RECIPE or SCENE", 1, 1, {"at", "modes", "top", "body", "set", "seed"}, modes_list_run},
    {NULL, NULL, 0, 0, {NULL}, NULL},
};

int modes_dispatch(struct cmd_call *c, int (*compute)(struct cmd_call *c, struct err *e), struct err *e)
{
    struct action mine[sizeof actions / sizeof *actions];
    for (size_t i = 0; i < sizeof actions / sizeof *actions; i++) {
        mine[i] = actions[i];
        if (mine[i].name && !strcmp(mine[i].name, "compute"))
            mine[i].run = compute;
    }
    return actions_run("modes", mine, c, e);
}

static int modes_run(struct cmd_call *c, struct err *e)
{
    return actions_run("modes", actions, c, e);
}

static const struct args_option options[] = {
    {"output", 'o', "FILE.csv", false, "object, compute, extract: the mode table to write; must be given"},
    {"force", 'f', NULL, false, "object, compute, extract: replaces files that exist"},
    {"shape", 0, "SHAPE", false, "compute: a solid by its sizes, such as plate:length=30cm,width=20cm,thickness=5mm"},
    {"order", 0, "N", false, "compute: of the polynomials that an element moves by, 2 to 4 (default 3, of a bowl and a mug 4, of a mesh file 2)"},
    {"estimate", 0, NULL, false, "compute: estimates the error of every frequency from a second, coarser computation, into the report and the table's comments"},
    {"unit", 0, "LENGTH", false, "compute: what one unit of the mesh file is, such as mm (default m)"},
    {"material", 0, "NAME", false, "compute: a material that rasp knows; the next six put their figures in place of its own"},
    {"youngs-modulus", 0, "PRESSURE", false, "compute: Young's modulus, of a wood that along the grain, x (its other moduli keep their ratios to it)"},
    {"poisson", 0, "NUMBER", false, "compute: Poisson's ratio"},
    {"density", 0, "DENSITY", false, "compute: density"},
    {"alpha", 0, "RATE", false, "compute: Rayleigh's damping C = alpha M + beta K, in 1/s"},
    {"beta", 0, "TIME", false, "compute: Rayleigh's damping, in s"},
    {"loss", 0, "NUMBER", false, "compute: loss factor; a mode of angular frequency w decays with (alpha + beta w^2 + loss w)/2"},
    {"clamp", 0, "FACE", true, "compute: a face that does not move: x0, x1, y0 ... (where the solid ends), or its name in the mesh"},
    {"support", 0, "FACE", true, "compute: a face that moves along its normal only: a hinge, for what is thin"},
    {"face", 0, "top|bottom|right|left|back|front|around|inside", false, "compute: the side on which the places are (around: x is the arc round the z axis, y the height); default: top"},
    {"line", 0, "X0,Y0,X1,Y1", false, "object, compute: places on a line, its two ends"},
    {"circle", 0, "RADIUS", false, "object, compute: places on a circle round (0, 0)"},
    {"places", 0, "N", false, "object, compute: how many places on the line or circle; default: on a circle 33, on a line as --grid says"},
    {"grid", 0, "NX,NY", false, "object, compute: places on a grid over the object; those beside it (of what is round) are left out, and between what is then no full grid gains are linear, else smooth; default: a grid, "
     "over what is round rings as far as its surface has no edge (a bowl: to its lip), with as many places as keep the gains of all modes between the places, as a scene interpolates them, within -40 dB (rms, relative to the gains, at 512 places), at most 4096 and 500000 rows; what is left is told"},
    {"at", 0, "X,Y", false, "one place"},
    {"points", 0, "FILE.csv", false, "compute: places by points of space, columns x_m, y_m, z_m, and u_m, v_m where the scene has them (else x_m, y_m)"},
    {"listen", 0, "X,Y", false, "object, compute: the place that is heard (compute also X,Y,Z); default: the place that is touched"},
    {"origin", 0, "X,Y", false, "compute: where the solid's x = y = 0 lies in the scene"},
    {"load", 0, "MASS", false, "object: a mass that rests where the object is touched and lowers its frequencies: a table of separate poles"},
    {"modes", 0, "N", false, "how many modes, the strongest, of compute the lowest; default: object all below --top, compute 100, extract 50, list 20"},
    {"channel", 0, "N", false, "extract: the channel that holds the sound, from 1 (default 1)"},
    {"force-channel", 0, "N", false, "extract: the channel that holds the hammer's force"},
    {"scale", 0, "NUMBER", false, "extract: what full scale (floating point: 1) of the sound's channel stands for, in m, m/s, m/s^2 or Pa"},
    {"force-scale", 0, "NEWTONS", false, "extract: what full scale (floating point: 1) of the force's channel stands for"},
    {"radius", 0, "LENGTH", false, "extract: of a sphere of the object's size; with --distance a microphone's pressure is turned into the surface's velocity"},
    {"distance", 0, "LENGTH", false, "extract: from that sphere's middle to the microphone"},
    {"delay", 0, "TIME", false, "extract: by which the sound's channel comes after the force's; default: of pressure, and with --impulse behind silence, found in the response, else 0"},
    {"impulse", 0, NULL, false, "extract: the recordings are impulse responses already, sample 0 at the strike"},
    {"low", 0, "FREQUENCY", false, "extract: modes are looked for from here on; default: where the sound stands out of the noise"},
    {"high", 0, "FREQUENCY", false, "extract: ... up to here; default: as far as the hammer's force reaches, 40 dB below its greatest power"},
    {"fastest", 0, "RATE", false, "extract: the fastest decay that is taken for a mode, in 1/s; default: a fiftieth of the sample rate"},
    {"method", 0, "esprit|spectrogram", false, "extract: spectrogram takes the peaks of the power spectrogram; default: esprit"},
    {"strike-threshold", 0, "DECIBEL", false, "extract: by how much a strike must rise above the noise (default 20)"},
    {"strikes", 0, "LIST", false, "extract: only these strikes are fitted, as 1,3,5-7; of the others the report says what the modes explain"},
    {"resynthesis", 0, "FILE.wav", false, "extract: writes what the modes make of the recording, one channel for each place"},
    {"residual", 0, "FILE.wav", false, "extract: writes what they leave of it"},
    {"plot", 0, "FILE", false, "extract: draws spectrum, modes, levels and decays of the first place, as .png or .svg"},
    {"json", 0, NULL, false, "extract: the report as JSON"},
    {"top", 0, "FREQUENCY", false, "modes of an object above are left out (default 20 kHz)"},
    {"quantity", 0, "displacement|velocity|acceleration|pressure", false, "object, compute: the first three, per N s (default velocity); extract: what the sound's channel holds (default pressure)"},
    {"title", 0, "TEXT", false, "compute: a line for the table"},
    {"body", 0, "surface|scraper|ball", false, "of a scene: whose modes; default: surface"},
    CMD_SCENE_OPTIONS,
    {"quiet", 'q', NULL, false, "object, compute, extract: prints nothing; what would be warned of stands in the table's comments all the same"},
    {0}};

const struct command modes_command = {
    .name = "modes",
    .summary = "how objects ring: mode tables",
    .does = "rasp modes object RECIPE -o FILE.csv: the modes of an object of simple shape as a mode table: their frequencies, decays, and gains at places. "
            "RECIPE is a YAML file of surface keys (object, material), as in irs/, or a scene. Places are lengths in the object's own coordinates: "
            "of bars, rods, strings, plates and membranes x from 0 to the length and y from 0 to the width, of what is round from the centre, of a shell "
            "along great circles from a pole. Without --line, --grid or --at they are a line along what is slender, a grid on what is flat, rings on what is round (as many as --grid says), a shell's pole, and of a "
            "scraper or ball its object.at. The table has them where they lie in the scene, moved by surface.object.origin. Rendering needs no such file: "
            "a scene's surface.object gives the same modes at any place. A table is for other programs, and to be changed by hand.\n"
            "rasp modes compute MESH -o FILE.csv: the modes of any solid by finite elements. MESH is a mesh of tetrahedra, of Gmsh (.msh, versions 2.2 and 4.1) or "
            "TetGen (.node, .ele); or --shape makes one: plate, bar, rod, ring, bowl, sphere, mug (--shape help lists their sizes). At default fineness and order the 60 lowest modes of steel solids are within about 0.1 % (rods, solid balls), 0.3 % (a plate of 40 x 20 x 0.5 cm, a hollow ball of 2 mm), "
            "0.5 % (a ring 14 cm wide, 10 x 6 mm: its lowest 0.12 %, at 14 kHz 0.45 %) and 0.6 % (a mug of 4 mm, a bowl 20 cm wide and 1.5 mm thick), in 4 to 16 s of processor time; thinner walls and higher modes want more: frequencies come out too high and fall with fineness and --order. --estimate "
            "says by how much, from a coarser mesh too (Richardson); it cannot see the error of what both meshes have alike, such as one element through a wall. "
            "The solid is touched and heard along its surface's normal. Its places are those of the plane in which a scene moves: --face says from where that looks at the solid, and "
            "--origin where the solid lies in the scene. Without --line, --circle, --grid, --at or --points they are a grid over what is seen (rings if round), a line along what is slender. "
            "A table that was made from the same inputs and has not been changed since is left as it is.\n"
            "rasp modes extract RECORDING... -o FILE.csv: the modes of a real object from recordings in which it is struck. RECORDING is a sound file of any kind that libsndfile "
            "reads, with one strike or many on one place. The strikes are found, and the "
            "recording itself is fitted: every strike has gains of its own, frequencies and decays are those of all. A hammer's force (--force-channel) drives the modes, else a strike is an impulse. "
            "No mode is told that noise might have made; two decays of one frequency are told. A second of silence before "
            "the first strike tells noise and hums. Strikes that clip or are 30 dB quieter than the loudest sound are left out; "
            "what modes explain less than half of is refused. "
            "Without a force channel a second hit 5 to 100 ms after the first is mostly not seen, and the table holds "
            "the spectrum of both: listen, and cut such strikes out. Several places are FILE@X,Y each, or one folder with index.csv (columns file_name,x_m,y_m): they share frequencies and decays. The sound is taken for a microphone's pressure unless --quantity says what else it is. Without a force each place has a level and an onset of its own, so that places cannot be compared with each other. Levels are physical where --scale and "
            "--force-scale are given and the sound is a vibration, or a pressure with --radius and --distance; else they are relative, and the table says so and why. Errors "
            "stand in the report and in the table's comments: se, by noise, and se_between, the standard deviation from strike to strike. The report's median decay counts all modes alike, its median by energy is the decay that half of the energy decays no faster than: the "
            "one to compare materials by.\n"
            "rasp modes list FILE: the strongest modes of a mode table, recipe or scene: frequency, time of decay by 60 dB, largest gain (in a table over "
            "its places, of an object over a grid of places, or at one place with --at).",
    .operands = "ACTION FILE",
    .least = 1,
    .most = -1,
    .options = options,
    .actions = actions,
    .examples = "rasp modes object irs/glass_ball.yaml -o ball.csv\n"
                "rasp modes object irs/basswood_plank.yaml --line 0,3.7cm,40cm,3.7cm --places 33 --listen 11.7cm,2.9cm -o plank.csv\n"
                "rasp modes object irs/poplar_rod.yaml --set surface.object.length=30cm --at 0,0 -o rod.csv\n"
                "rasp modes object irs/pvc_rod.yaml --load 5g -o loaded.csv\n"
                "rasp modes list irs/pvc_rod.csv\n"
                "rasp modes compute --shape plate:length=20cm,width=15cm,thickness=4mm --material glass --listen 12cm,4cm -o plate.csv\n"
                "rasp modes compute --shape mug:diameter=8cm,height=9cm,wall=4mm --material ceramic --face around --at 3cm,5cm -o mug.csv\n"
                "rasp modes compute --shape bar:length=20cm,width=2cm,thickness=5mm --material steel --order 2 --modes 20 --estimate -o bar.csv\n"
                "rasp modes extract irs/ceramic_tile_tap.wav@15cm,3.7cm --impulse --quantity velocity --scale 1 --plot tap.png -o tap.csv\n"
                "rasp render scenes/strike.yaml -o struck.wav\n"
                "rasp modes extract struck.wav --modes 20 --method spectrogram --resynthesis again.wav --residual rest.wav -o struck.csv\n",
    .run = modes_run,
};
