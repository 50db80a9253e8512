/* rasp modes ACTION: how objects ring, apart from any contact. The actions are modes_object.c and modes_list.c. */
#include "cmd/modes.h"

#include <string.h>

#include "cmd/actions.h"
#include "scene/units.h"

static const struct action actions[] = {
    {"object", "one RECIPE or SCENE", 1, 1,
     {"output", "force", "line", "places", "grid", "at", "listen", "load", "modes", "top", "quantity", "body", "set", "seed", "quiet"}, modes_object_run},
    {"list", "one FILE: a mode table (.csv), RECIPE or SCENE", 1, 1, {"at", "modes", "top", "body", "set", "seed"}, modes_list_run},
    {NULL, NULL, 0, 0, {NULL}, NULL},
};

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

static int modes_run(struct cmd_call *c, struct err *e)
{
    return actions_run("modes", actions, c, e);
}

static const struct args_option options[] = {
    {"output", 'o', "FILE.csv", false, "object: the mode table to write; must be given"},
    {"force", 'f', NULL, false, "object: overwrites FILE.csv if it exists"},
    {"line", 0, "X0,Y0,X1,Y1", false, "object: places on a line, its two ends"},
    {"places", 0, "N", false, "object: how many places on the line (default 33)"},
    {"grid", 0, "NX,NY", false, "object: places on a grid over the object; those beside it (of what is round) are left out"},
    {"at", 0, "X,Y", false, "one place"},
    {"listen", 0, "X,Y", false, "object: the place that is heard; default: the place that is touched"},
    {"load", 0, "MASS", false, "object: a mass that rests where the object is touched and lowers its frequencies: a table of separate poles"},
    {"modes", 0, "N", false, "how many of the strongest modes; default: object all below --top, list 20"},
    {"top", 0, "FREQUENCY", false, "modes of an object above are left out (default 20 kHz)"},
    {"quantity", 0, "WORD", false, "object: displacement, velocity or acceleration per N s (default velocity)"},
    {"body", 0, "WORD", false, "of a scene: surface, scraper or ball (default surface)"},
    CMD_SCENE_OPTIONS,
    {"quiet", 'q', NULL, false, "object: prints nothing; what would be warned of stands in the table's comments all the same"},
    {0}};

const struct command modes_command = {
    .name = "modes",
    .summary = "how objects ring: mode tables",
    .does = "rasp modes object RECIPE -o FILE.csv: the modes of an object of simple shape as a mode table: their frequencies, decays, and gains at places. "
            "RECIPE is a YAML file of surface keys (object, material), as in irs/, or a scene. Places are lengths in the object's own coordinates: "
            "of bars, rods, strings, plates and membranes x from 0 to the length and y from 0 to the width, of what is round from the centre, of a shell "
            "along great circles from a pole. Without --line, --grid or --at they are 33 along what is slender, 17 x 9 on what is flat, a shell's pole, and of a "
            "scraper or ball its object.at. The table has them where they lie in the scene, moved by surface.object.origin. Rendering needs no such file: "
            "a scene's surface.object gives the same modes at any place. A table is for other programs, and to be changed by hand.\n"
            "rasp modes list FILE: the strongest modes of a mode table, recipe or scene: frequency, time of decay by 60 dB, largest gain (in a table over "
            "its places, of an object over a grid of places, or at one place with --at).",
    .operands = "ACTION FILE",
    .least = 1,
    .most = -1,
    .options = options,
    .examples = "rasp modes object irs/glass_ball.yaml -o ball.csv\n"
                "rasp modes object irs/basswood_plank.yaml --line 0,3.7cm,40cm,3.7cm --places 33 --listen 11.7cm,2.9cm -o plank.csv\n"
                "rasp modes object irs/poplar_rod.yaml --set surface.object.length=30cm --at 0,0 -o rod.csv\n"
                "rasp modes object irs/pvc_rod.yaml --load 5g -o loaded.csv\n"
                "rasp modes list irs/pvc_rod.csv\n",
    .run = modes_run,
};
