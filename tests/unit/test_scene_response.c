/* Responses, objects, the space of materials, impacts, given forces and listening places in scenes: what is said of
   what does not fit, where, and the cure, against messages written down by hand; what fits; what the scene tells of it.
 */
#include "scene/scene_read.h"

#include <sys/stat.h>
#include <unistd.h>

#include "force/given.h"
#include "force/strike.h"
#include "pipeline/stages.h"
#include "response/response.h"
#include "scene/params.h"
#include "scenes.h"
#include "surface/limiter.h"
#include "trajectory/load.h"
#include "trajectory/motion.h"

#define SCRAPE "scraper: {mass: 1 g}\nmotion: {path: line, to: [1 cm, 0], speed: 10 cm/s}\n"
#define CIRCLE "scraper: {mass: 1 g}\nmotion: {path: circle, radius: 1 cm, speed: 10 cm/s}\n"
#define RINGS(surface) "rasp: 1\nsurface: {roughness: {}, " surface "}\n" SCRAPE
#define OBJECT(object) RINGS("material: steel, object: " object)
#define CUSTOM(object) RINGS("object: " object)
#define SCRAPER(scraper)                                                                                               \
    "rasp: 1\nsurface: {roughness: {}}\nscraper: {mass: 1 g, " scraper                                                 \
    "}\nmotion: {path: line, to: [1 cm, 0], speed: 10 cm/s}\n"
#define BAR "{shape: bar, length: 30 cm, width: 2 cm, thickness: 5 mm}"
#define PLATE "{shape: plate, length: 30 cm, width: 20 cm, thickness: 5 mm}"
#define STILL "motion: {path: still, duration: 2 s}\n"
#define STRIKE(strike)                                                                                                 \
    "rasp: 1\nsurface: {response: a.csv}\nscraper: {mass: 1 g}\n" STILL "contact: {model: strike, strike: " strike "}" \
    "\n"
#define GIVEN(given) "rasp: 1\nsurface: {response: a.csv}\n" STILL "contact: {model: given, given: " given "}\n"
#define HEARD(object, output) "rasp: 1\nsurface: {roughness: {}, " object "}\n" SCRAPE "output: " output "\n"

struct row {
    const char *text, *at; /* at: what the caret stands under (its first place in the text) */
    const char *says, *cure;
};

static const struct row responses[] = {
    {RINGS("response: a.csv, object: " PLATE ", material: steel"), "object",
     "surface.object and surface.response exclude each other", "remove one of them"},
    {RINGS("response: a.csv, space: {}"), "space", "surface.space and surface.response exclude each other",
     "remove one of them"},
    {SCRAPER("material: steel, object: " BAR ", response: a.csv"), "response",
     "scraper.response and scraper.object exclude each other", "remove one of them"},
    {RINGS("response: a.wav, convolution: resonators"), "resonators",
     "surface.convolution: resonators need a mode table (.csv) as surface.response, not 'scenes/a.wav'",
     "leave surface.convolution out, or set it to overlap_add"},
    {RINGS("response: folder, convolution: nodes"), "nodes", "surface.convolution: nodes is no longer there",
     "leave it out: surface.moving: launch"},
    {RINGS("response: folder, moving: glide"), "glide",
     "surface.moving: glide needs modes, and 'scenes/folder' is recorded",
     "leave surface.moving out, or set it to launch"},
    {RINGS("response: a.wav, moving: readout"), "readout", "surface.moving: readout needs modes", "launch"},
    {RINGS("response: a.wav, moving: fixed"), "fixed", "surface.moving: fixed needs modes", "launch"},
    {RINGS("response: a.csv, moving: glide, convolution: overlap_add"), "overlap_add",
     "surface.convolution: overlap_add cannot do surface.moving: glide",
     "leave surface.convolution out, or set it to resonators"},
    {RINGS("response: a.csv, convolution: resonators, moving: readout"), "readout",
     "surface.convolution: resonators cannot do surface.moving: readout",
     "leave surface.convolution out, or set it to overlap_add"},
    {RINGS("space: {to: [1, 0]}, convolution: overlap_add"), "overlap_add",
     "surface.convolution: overlap_add cannot do surface.moving: glide, which is auto where surface.space travels",
     "resonators"},
    {RINGS("space: {dimension_to: 3}, moving: fixed"), "fixed",
     "surface.moving: fixed needs an object that stays what it is, and surface.space travels", "glide"},
    {RINGS("response: a.csv, response_length: 1 s, moving: glide"), "glide",
     "surface.moving: what glides rings on for ever, and surface.response_length cannot cut it",
     "leave surface.response_length out"},
    {RINGS("space: {to: [1, 0]}, response_length: 1 s"), "1 s", "what glides rings on for ever",
     "set surface.moving to launch"},
    {RINGS("object: " PLATE ", material: glass, convolution: resonators, response_length: 0.5"), "0.5",
     "resonators ring on for ever, and surface.response_length cannot cut them",
     "set surface.convolution to overlap_add"},
    {SCRAPER("response: a.csv, convolution: nodes"), "nodes", "scraper.convolution: nodes is no longer there",
     "overlap_add"},
    {RINGS("space: {from: [0.8, 0.8]}"), "[0.8",
     "surface.space.from lies 1.13137 from the centre, outside the disk of materials, whose radius is 1", "x^2 + y^2"},
    {RINGS("space: {to: [0, -1.01]}"), "-1.01", "the second number of surface.space.to must be from -1 to 1",
     "place at the motion's end"},
    {RINGS("space: {to: [-0.8, 0.7]}"), "[-0.8", "surface.space.to lies 1.06301 from the centre", "x^2 + y^2"},
    {RINGS("space: {dimension: 4}"), "4", "surface.space.dimension must be from 1 to 3, not '4'", "shape"},
    {RINGS("moving: glides, response: a.csv"), "glides",
     "surface.moving must be one of: auto, fixed, launch, glide, readout", "did you mean 'glide'?"},
    {RINGS("pairing: 0.6, response: a.csv"), "0.6", "surface.pairing must be from 0 to 0.5", "modes of two places"},
    {"rasp: 1\nsurface: {response: a.csv}\n" SCRAPE, "surface",
     "surface.roughness, surface.height_map, surface.ridges, surface.grit or surface.fractal must be given",
     "roughness: {}"},
};

static const struct row objects[] = {
    {OBJECT("{}"), "object", "surface.object.shape is missing", "add for instance: shape: bar"},
    {OBJECT("{shape: cube}"), "cube",
     "surface.object.shape must be one of: bar, rod, string, plate, disk, membrane, drum, shell", "shape: bar"},
    {OBJECT("{shape: bar, width: 1 cm, thickness: 1 mm}"), "object", "surface.object.length is missing",
     "length: 3 cm"},
    {OBJECT("{shape: plate, length: 1, width: 1}"), "object", "surface.object.thickness is missing: a plate has one",
     "thickness: 5 mm"},
    {OBJECT("{shape: bar, length: 1, width: 1}"), "object", "surface.object.thickness is missing: a bar has one", ""},
    {OBJECT("{shape: disk, diameter: 1}"), "object", "surface.object.thickness is missing: a disk has one", ""},
    {OBJECT("{shape: shell, diameter: 1}"), "object", "surface.object.thickness is missing: a shell has one", ""},
    {OBJECT("{shape: membrane, length: 1, width: 1, surface_tension: 1}"), "object",
     "surface.object.thickness is missing: a membrane has one", ""},
    {OBJECT("{shape: drum, diameter: 1, surface_tension: 1}"), "object",
     "surface.object.thickness is missing: a drum has one", ""},
    {OBJECT("{shape: string, length: 1, tension: 1 N}"), "object", "surface.object.diameter is missing",
     "diameter: 3 cm"},
    {OBJECT("{shape: string, length: 1, diameter: 1 mm}"), "object", "surface.object.tension is missing",
     "tension: 1.5 N"},
    {OBJECT("{shape: drum, diameter: 1, thickness: 1 mm}"), "object", "surface.object.surface_tension is missing",
     "surface_tension: 2 kN/m"},
    {OBJECT("{shape: drum, diameter: 1, thickness: 1 mm, surface_tension: 5 N}"), "5 N",
     "surface.object.surface_tension needs a force per length; N is a unit of force", "2 kN/m"},
    {OBJECT("{shape: rod, length: 1, diameter: 1 cm, thickness: 5 mm}"), "5 mm",
     "surface.object.thickness, 0.005 m, must be less than half of surface.object.diameter, 0.01 m",
     "without one is solid"},
    {OBJECT("{shape: shell, thickness: 6 mm, diameter: 1 cm}"), "1 cm",
     "must be less than half of surface.object.diameter", "lower thickness"},
    {OBJECT("{shape: disk, length: 1, diameter: 1, thickness: 1 mm}"), "length",
     "surface.object.length applies only where surface.object.shape is bar, rod, string, plate or membrane",
     "now it is disk"},
    {OBJECT("{shape: shell, edges: free, diameter: 1, thickness: 1 mm}"), "edges",
     "surface.object.edges applies only where surface.object.shape is bar, rod, plate or disk", "now it is shell"},
    {OBJECT("{shape: plate, edges: cantilever, length: 1, width: 1, thickness: 1 mm}"), "cantilever",
     "surface.object.edges must not be cantilever where surface.object.shape is plate: only bars and rods have one end",
     "free, supported, clamped"},
    {OBJECT("{shape: disk, edges: cantilever, diameter: 1, thickness: 1 mm}"), "cantilever",
     "must not be cantilever where surface.object.shape is disk", ""},
    {OBJECT("{shape: disk, youngs_modulus_across: 1 GPa, diameter: 1, thickness: 1 mm}"), "youngs_modulus_across",
     "surface.object.youngs_modulus_across applies only where", "plate"},
    {CUSTOM("{shape: bar, length: 1, width: 1, thickness: 1 mm, youngs_modulus: 1 GPa}"), "object",
     "surface.object.density is missing: surface.material is custom",
     "density: 650 kg/m^3; or name a material, such as surface.material: steel"},
    {CUSTOM("{shape: bar, length: 1, width: 1, thickness: 1 mm, density: 1000}"), "object",
     "surface.object.youngs_modulus is missing: surface.material is custom", "youngs_modulus: 12 GPa"},
    {CUSTOM("{shape: plate, length: 1, width: 1, thickness: 1 mm, density: 1000, youngs_modulus: 1 GPa}"), "object",
     "surface.object.poisson is missing: surface.material is custom", "poisson: 0.35"},
    {CUSTOM("{shape: string, length: 1, diameter: 1 mm, tension: 1}"), "object",
     "surface.object.density is missing: surface.material is custom", ""},
    {OBJECT("{shape: plate, length: 1, width: 1, thickness: 1 mm, youngs_modulus: 1 GPa, youngs_modulus_across: 10 "
            "GPa, poisson: 0.4}"),
     "0.4",
     "surface.object.poisson: poisson^2 x youngs_modulus_across / youngs_modulus is 1.6, and is below 1 in every "
     "material",
     "lower poisson"},
    {RINGS("material: wood, response: a.csv"), "wood", "surface.material must be one of: custom, basswood",
     "goes under materials"},
    {OBJECT("{shape: bar, length: 1, width: 1, thickness: 1 mm, alpha: 3 Hz}"), "3 Hz",
     "surface.object.alpha needs a rate per second; Hz is a unit of frequency", "10 1/s"},
    {SCRAPER("material: steel, object: {shape: rod, length: 1}"), "object", "scraper.object.diameter is missing", ""},
    {SCRAPER("object: {shape: rod, length: 1, diameter: 1 cm, density: 1000}"), "object",
     "scraper.object.youngs_modulus is missing: scraper.material is custom", "scraper.material: steel"},
};

static const struct row contacts[] = {
    {"rasp: 1\nsurface: {roughness: {}, response: a.csv}\nscraper: {mass: 1 g}\n" STILL, "still",
     "motion.path is still: nothing would scrape where contact.model is scrape",
     "set contact.model to strike or given"},
    {"rasp: 1\nsurface: {response: a.csv}\nscraper: {mass: 1 g}\nmotion: {path: still}\ncontact: {model: strike, "
     "strike: {speed: 1, stiffness: 1}}\n",
     "motion", "motion.duration is missing", "duration: 2 s"},
    {"rasp: 1\nsurface: {response: a.csv}\nscraper: {mass: 1 g}\nmotion: {path: still, duration: 1, law: "
     "constant}\ncontact: {model: strike, strike: {speed: 1, stiffness: 1}}\n",
     "constant", "motion.law must not be constant where motion.path is still: nothing moves", "laws here: auto"},
    {"rasp: 1\nsurface: {response: a.csv}\nscraper: {mass: 1 g}\nmotion: {path: line, at: [0, 0], to: [1, 0], "
     "duration: 1}\ncontact: {model: strike, strike: {speed: 1, stiffness: 1}}\n",
     "at:", "motion.at applies only where motion.path is still", "now it is line"},
    {STRIKE("{stiffness: 1e8}"), "strike: {s", "contact.strike.speed is missing", "speed: 10 cm/s"},
    {STRIKE("{speed: 1, pulse: half_sine}"), "strike: {s",
     "contact.strike.stiffness is missing: a half_sine pulse needs it", "stiffness: 2 MN/m"},
    {STRIKE("{speed: 1, stiffness: 2 MN/m}"), "2 MN",
     "contact.strike.stiffness of a hertz pulse is in N/m^1.5, not '2 MN/m'", "set contact.strike.pulse to half_sine"},
    {STRIKE("{speed: 1, pulse: half_sine, stiffness: 2 MN/m^1.5}"), "2 MN",
     "contact.strike.stiffness of a half_sine pulse is in N/m, not '2 MN/m^1.5'", "give it in N/m"},
    {STRIKE("{speed: 1, stiffness: 1e8, count: 3}"), "3}",
     "contact.strike.count is 3, and nothing says when the second impact comes", "interval: 0.5 s; or restitution"},
    {STRIKE("{speed: 1, stiffness: 1e8, interval: 1 s, restitution: 0.5}"), "restitution",
     "contact.strike.restitution and contact.strike.interval exclude each other", "remove one"},
    {STRIKE("{speed: 1, stiffness: 1e8, first: 2 s}"), "2 s}}",
     "contact.strike.first: the first impact comes at 2 s, and the motion lasts 2 s", "lower contact.strike.first"},
    {STRIKE("{speed: 1, stiffness: 1e8, restitution: 0.5}, gravity: 0"), "0}\n",
     "contact.gravity is 0: what bounces never comes back", "contact.strike.interval"},
    {STRIKE("{speed: 1, stiffness: 1e8}, smoothing: 0"), "smoothing",
     "contact.smoothing applies only where contact.model is scrape", "now it is strike"},
    {STRIKE("{speed: 1, stiffness: 1e8}, limiter: {alpha: 1 cm}"), "alpha",
     "contact.limiter.alpha applies only where contact.model is scrape or roll",
     "set contact.model to scrape or roll (now it is strike)"},
    {STRIKE("{speed: 1, stiffness: 1e8}, leak: 1 mm"), "leak",
     "contact.leak applies only where contact.model is scrape", "now it is strike"},
    {STRIKE("{speed: 1, stiffness: 1e8}") "load: {constant: 1}\n", "constant",
     "load.constant applies only where contact.model is scrape", "now it is strike"},
    {STRIKE("{speed: 1, stiffness: 1e8}") "grip: {}\n", "grip", "grip has no effect where contact.model is strike",
     "remove it"},
    {STRIKE("{speed: 1, stiffness: 1e8}") "output: {diagnostics: {columns: [normal_force_n]}}\n", "normal",
     "the contact has no normal_force_n: it needs contact.model: scrape", "leave the column out"},
    {STRIKE("{speed: 1, stiffness: 1e8}") "output: {diagnostics: {columns: [alpha_m]}}\n", "alpha_m",
     "the contact has no alpha_m: it needs contact.model: scrape", ""},
    {STRIKE("{speed: 1, stiffness: 1e8}") "output: {diagnostics: {columns: [lift_offs]}}\n", "lift_offs",
     "the contact has no lift_offs: it needs contact.model: scrape", ""},
    {"rasp: 1\nsurface: {response: a.csv, ridges: {}}\nscraper: {mass: 1 g}\n" STILL
     "contact: {model: strike, strike: {speed: 1, stiffness: 1}}\n",
     "ridges", "surface.ridges has no effect where contact.model is strike", "a null takes away"},
    {"rasp: 1\nsurface: {response: a.csv}\n" STILL "contact: {model: strike, strike: {speed: 1, stiffness: 1}}\n",
     "rasp", "scraper.mass is missing", "scraper: {mass: 20 g}"},
    {"rasp: 1\nsurface: {response: a.csv, material: steel}\nscraper: {mass: 1, material: steel}\n" STILL
     "contact: {model: strike, strike: {speed: 1}}\n",
     "scraper",
     "scraper.radius is missing: the stiffness of the impact follows from it, unless contact.strike.stiffness is given",
     "radius: 5 mm"},
    {"rasp: 1\nsurface: {response: a.csv}\nscraper: {mass: 1, radius: 10 um, material: steel}\n" STILL
     "contact: {model: strike, strike: {speed: 1}}\n",
     "surface",
     "surface.material is missing (or youngs_modulus and poisson of surface.object): the stiffness of the impact "
     "follows from it",
     "material: steel"},
    {"rasp: 1\nsurface: {response: a.csv, material: oak}\nscraper: {mass: 1, radius: 1 mm}\n" STILL
     "contact: {model: strike, strike: {speed: 1}}\n",
     "scraper", "scraper.material is missing", "material: steel"},
    {RINGS("response: a.csv") "contact: {strike: {speed: 1}}\n", "speed: 1}}\n",
     "contact.strike.speed applies only where contact.model is strike", "now it is scrape"},
    {GIVEN("{}"), "given: {", "contact.given.file is missing", "file: force.wav"},
    {GIVEN("{file: a.WAV}"), "given: {",
     "contact.given.scale is missing: a WAV does not say how many newtons its full scale stands for", "scale: 10 N"},
    {GIVEN("{file: a.csv, scale: 0 N}"), "0 N", "contact.given.scale is 0", "10 N"},
    {GIVEN("{file: a.npy}"), "given: {",
     "contact.given.rate is missing: an NPY does not say how many samples a second has", "rate: 48 kHz"},
    {GIVEN("{file: a.csv, rate: 1 kHz}"), "rate", "contact.given.rate is of an NPY, and scenes/a.csv is a CSV",
     "remove it"},
    {GIVEN("{file: a.csv, channel: 2}"), "channel", "contact.given.channel is of a WAV, and scenes/a.csv is a CSV",
     "remove it"},
    {GIVEN("{file: a.npy, rate: 1 kHz, column: x}"), "column",
     "contact.given.column is of a CSV, and scenes/a.npy is an NPY", "remove it"},
    {GIVEN("{file: a.csv}") "scraper: {mass: 1}\n", "mass",
     "scraper.mass applies only where contact.model is scrape or strike", "now it is given"},
    {GIVEN("{file: a.csv}, gravity: 1"), "gravity",
     "contact.gravity applies only where contact.model is scrape, strike, roll, roll_coupled, impacts or playback",
     "now it is given"},
    {GIVEN("{file: a.csv, scale: 3 m}"), "3 m", "contact.given.scale needs a force; m is a unit of length", "1.5 N"},
};

static const struct row outputs[] = {
    {HEARD("response: a.csv", "{listen: {}}"), "listen", "output.listen.places is missing", "places: [[0, 0, 1 m]]"},
    {HEARD("response: a.csv", "{listen: {radiator: contact, places: [[0, 0, 1]]}}"), "places",
     "output.listen.places applies only where output.listen.radiator is point, monopole or plate", "now it is contact"},
    {HEARD("response: a.csv", "{listen: {places: []}}"), "[]",
     "output.listen.places must be a list of 1 to 64 places [x, y, z], not of 0", "[[0, 0, 1 m]]"},
    {HEARD("response: a.csv", "{listen: {places: 3 m}}"), "3 m",
     "must be a list of 1 to 64 places [x, y, z], not '3 m'", "[[0, 0, 1 m]]"},
    {HEARD("response: a.csv", "{listen: {places: [[0, 0]]}}"), "[0, 0]]",
     "place 1 of output.listen.places must be three numbers [x, y, z], not a list of 2", "[3 cm, 0, 1 m]"},
    {HEARD("response: a.csv", "{listen: {places: [[0, 0, 1], [0, 0, 1 s]]}}"), "1 s",
     "z of place 2 of output.listen.places needs a length; s is a unit of time", "3 cm"},
    {HEARD("response: a.csv", "{listen: {places: [[0, 0, 2 km]]}}"), "2 km",
     "z of place 1 of output.listen.places must be from -1000 m to 1000 m", ""},
    {HEARD("response: a.csv", "{listen: {places: [[0, 0, 1], [1, 0, 1]]}, channels: 2}"), "2}",
     "output.channels is 2 and output.listen.places has 2 places", "leave output.channels out"},
    {HEARD("response: a.csv", "{listen: {places: [[0, 0, 1]]}, quantity: velocity}"), "velocity",
     "output.quantity must be auto where output.listen.radiator is monopole: what is heard is a pressure",
     "contact or point"},
    {HEARD("object: " PLATE ", material: oak", "{quantity: velocity, listen: {radiator: plate, places: [[0, 0, 1]]}}"),
     "plate, places", "output.quantity must be auto where output.listen.radiator is plate", ""},
    {HEARD("response: a.csv", "{level: {dbfs_at_1_pa: -20 dB}}"), "dbfs",
     "output.level.dbfs_at_1_pa needs a sound in pascals: output.listen with a monopole or a plate", "listen: {places"},
    {HEARD("object: " PLATE ", material: oak",
           "{listen: {radiator: point, places: [[0, 0, 0]]}, level: {dbfs_at_1_pa: -20 dB}}"),
     "dbfs", "output.level.dbfs_at_1_pa needs a sound in pascals", ""},
    {HEARD("response: a.csv", "{listen: {places: [[0, 0, 1]]}, level: {dbfs_at_1_pa: 0, peak: 0}}"), "peak",
     "output.level.peak and output.level.dbfs_at_1_pa exclude each other", "remove one"},
    {HEARD("response: a.csv", "{listen: {radiator: point, places: [[0, 0, 0]]}}"), "point",
     "output.listen.radiator: a point needs surface.object, which the contact has not", "contact"},
    {HEARD("space: {}", "{listen: {radiator: plate, places: [[0, 0, 1]]}}"), "plate",
     "output.listen.radiator: a plate needs surface.object, which the contact has not", "contact"},
    {HEARD("object: " BAR ", material: oak", "{listen: {radiator: plate, places: [[0, 0, 1]]}}"), "plate",
     "a plate needs a surface.object that is flat: a plate, disk, membrane or drum", ""},
    {HEARD("response: a.wav", "{listen: {places: [[0, 0, 1]]}}"), "listen",
     "output.listen.radiator: a monopole needs a response with modes, which the contact has not", "contact"},
    {HEARD("response: a.wav", "{quantity: velocity}"), "velocity",
     "output.quantity: 'scenes/a.wav' of the contact is recorded, and of which quantity is not stated",
     "leave output.quantity out"},
    {HEARD("object: " PLATE ", material: oak", "{listen: {radiator: plate, places: [[0, 0, 1], [0, 0, 0 m]]}}"),
     "0 m]]", "z of place 2 of output.listen.places must be above 0 m", "raise z"},
    {HEARD("object: " PLATE ", material: oak", "{listen: {radiator: point, places: [[0, 0, 1 mm]]}}"), "1 mm]]",
     "z of place 1 of output.listen.places must be 0 m: a point lies on the object", "write 0"},
    {HEARD("response: a.csv", "{listen: {radiator: speaker, places: [[0, 0, 1]]}}"), "speaker",
     "output.listen.radiator must be one of: contact, point, monopole, plate", "radiator: monopole"},
    {HEARD("response: a.csv", "{listen: {density: 1 g, places: [[0, 0, 1]]}}"), "1 g,",
     "output.listen.density needs a density; g is a unit of mass", "650 kg/m^3"},
    {HEARD("response: a.csv", "{stems: [force, surfaces]}"), "surfaces]", "output.stems: there is no stem 'surfaces'",
     "did you mean 'surface'?"},
    {HEARD("response: a.csv", "{stems: [music]}"), "music", "output.stems: there is no stem 'music'",
     "force, surface, scraper"},
    {HEARD("response: a.csv", "{stems: [force, force]}"), "force]", "output.stems has 'force' twice", "remove one"},
    {HEARD("response: a.csv", "{stems: surface}"), "surface}\n",
     "output.stems must be a list of 1 to 1000 texts, not 'surface'", "stems: [force, surface]"},
    {HEARD("response: a.csv", "{stems: [surface, scraper]}"), "scraper]",
     "output.stems: nothing rings of which 'scraper' would be the stem", "leave the stem out"},
    {SCRAPER("response: a.csv, weight: 0") "output: {stems: [scraper], diagnostics: {}}\n", "scraper],",
     "output.stems: nothing rings of which 'scraper' would be the stem", ""},
    {HEARD("response: a.csv", "{quantity: speed}"), "speed}",
     "output.quantity must be one of: auto, displacement, velocity, acceleration", ""},
    {HEARD("response: a.csv", "{}") "accuracy: {morph_error: -80 dB}\n", "morph_error",
     "accuracy.morph_error is no longer there", "accuracy.gain_ramp"},
};

static void place_of(const struct row *b, char *start, size_t n)
{
    int line = 1, column = 1;
    const char *at = strstr(b->text, b->at);
    ck_assert_msg(at != NULL, "%s is not in\n%s", b->at, b->text);
    for (const char *s = b->text; s < at; s++, column++)
        if (*s == '\n') {
            line++;
            column = 0;
        }
    snprintf(start, n, "scenes/t.yaml:%d:%d: error: ", line, column);
}

static void all_bad(const struct row *rows, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        char start[64];
        struct result r = read_with(rows[i].text, NULL);
        place_of(&rows[i], start, sizeof start);
        one_error(&r, start, rows[i].says, rows[i].cure);
        arena_close(r.arena);
    }
}

START_TEST(test_bad_responses) { all_bad(responses, sizeof responses / sizeof responses[0]); }
END_TEST

START_TEST(test_bad_objects) { all_bad(objects, sizeof objects / sizeof objects[0]); }
END_TEST

/* What a force from a file still needs is said of a file that is there; of one that is not, that is what is wrong
 * (tests/cli/check_places.sh). */
START_TEST(test_bad_contacts)
{
    static const char *const there[] = {"scenes/a.WAV", "scenes/a.npy"};
    char folder[] = "/tmp/rasp_scene_XXXXXX";
    ck_assert(mkdtemp(folder) && chdir(folder) == 0 && mkdir("scenes", 0700) == 0);
    struct result absent = read_with(GIVEN("{file: a.WAV}"), NULL);
    ck_assert_msg(absent.good, "%s", absent.messages);
    arena_close(absent.arena);
    for (int i = 0; i < 2; i++)
        fclose(fopen(there[i], "w"));
    all_bad(contacts, sizeof contacts / sizeof contacts[0]);
    ck_assert(unlink(there[0]) == 0 && unlink(there[1]) == 0 && rmdir("scenes") == 0 && chdir("/") == 0 &&
              rmdir(folder) == 0);
}
END_TEST

START_TEST(test_bad_outputs) { all_bad(outputs, sizeof outputs / sizeof outputs[0]); }
END_TEST

/* ------------------------------------------------------------------ what fits */

static struct result read_good(const char *text)
{
    struct result r = read_with(text, NULL);
    ck_assert_msg(r.good, "%s:\n%s", text, r.messages);
    return r;
}

START_TEST(test_good)
{
    static const char *const goods[] = {
        RINGS("response: folder, moving: launch"),
        RINGS("response: a.wav, convolution: overlap_add, response_length: 1 s"),
        RINGS("response: a.csv, moving: readout, convolution: overlap_add"),
        RINGS("response: a.csv, moving: glide, convolution: resonators"),
        RINGS("response: a.csv, moving: readout, response_length: 1 s"),
        RINGS("space: {}, moving: fixed"),
        RINGS("space: {to: [0, 1]}, moving: launch, convolution: overlap_add"),
        RINGS("space: {to: [-0.6, 0.8]}"),
        RINGS("response: a.csv, material: steel"),
        OBJECT(PLATE),
        OBJECT(BAR ", moving: glide"),
        OBJECT("{shape: rod, edges: cantilever, length: 1, diameter: 1 cm, thickness: 4.9 mm}"),
        OBJECT("{shape: rod, waves: longitudinal, length: 1, diameter: 1 cm}"),
        OBJECT("{shape: shell, diameter: 10 cm, thickness: 3 mm}"),
        OBJECT("{shape: disk, edges: clamped, diameter: 10 cm, thickness: 3 mm}"),
        CUSTOM("{shape: bar, length: 1, width: 1, thickness: 1 mm, youngs_modulus: 1 GPa, density: 1000}"),
        CUSTOM("{shape: string, length: 1, diameter: 1 mm, tension: 80 N, density: 7800}"),
        CUSTOM("{shape: membrane, length: 1, width: 1, thickness: 0.2 mm, surface_tension: 2 kN/m, density: 1400}"),
        OBJECT("{shape: plate, length: 1, width: 1, thickness: 1 mm, youngs_modulus: 1 GPa, youngs_modulus_across: 6 "
               "GPa, poisson: 0.4}"),
        SCRAPER("material: pvc, object: {shape: rod, length: 20 cm, diameter: 2 cm, thickness: 2 mm, at: [20 cm, 0]}"),
        STRIKE("{speed: 1, stiffness: 1e8 N/m^1.5}"),
        STRIKE("{speed: 1, pulse: half_sine, stiffness: 2 MN/m, count: 3, interval: 0.5}"),
        STRIKE("{speed: 1, stiffness: 1e8, restitution: 0.5}"),
        STRIKE("{speed: 1, stiffness: 1e8, count: 1}, gravity: 0"),
        "rasp: 1\nsurface: {response: a.csv, material: glass}\nscraper: {mass: 1, radius: 10 um, object: {shape: rod, "
        "length: 1, diameter: 1 cm, youngs_modulus: 1 GPa, poisson: 0.3,"
        " density: 1000}}\n" STILL "contact: {model: strike, strike: {speed: 1}}\n",
        GIVEN("{file: a.csv}"),
        GIVEN("{file: a.Npy, rate: 48 kHz}"),
        GIVEN("{file: a.wav, scale: -3 N, channel: 2}"),
        GIVEN("{file: a.flac, scale: 1}"),
        HEARD("response: a.csv", "{listen: {places: [[0, 0, 1], [0, 0, 1]]}, level: {dbfs_at_1_pa: -20 dB}}"),
        HEARD("response: a.csv", "{channels: 2, listen: {places: [[0, 0, -1]]}}"),
        HEARD("object: " PLATE ", material: oak",
              "{listen: {radiator: plate, places: [[0, 0, 1]]}, stems: [surface, force]}"),
        HEARD("object: " BAR ", material: oak", "{listen: {radiator: point, places: [[1 cm, 0, 0]]}, quantity: "
                                                "acceleration, level: {full_scale: 1 m/s^2}}"),
        "rasp: 1\nsurface: {roughness: {}}\n" SCRAPE "output: {stems: [force]}\n",
        HEARD("response: a.wav", "{listen: {radiator: contact}, stems: [surface]}"),
        HEARD("response: a.csv", "{quantity: displacement}"),
    };
    for (size_t i = 0; i < sizeof goods / sizeof goods[0]; i++) {
        struct result r = read_good(goods[i]);
        arena_close(r.arena);
    }
}
END_TEST

START_TEST(test_values)
{
    struct result r = read_good("rasp: 1\nsurface: {material: oak, object: {shape: plate, length: 30 cm, width: 20 cm, "
                                "thickness: 5 mm, density: 0.65 g/cm^3,\n"
                                "  youngs_modulus: 12 GPa, alpha: 3 1/s, origin: [1 cm, 2 cm]}}\nscraper: {mass: 1, "
                                "object: {shape: string, length: 1, diameter: 1 mm,\n"
                                "  tension: 3, density: 1000}}\n" STILL
                                "contact: {model: strike, strike: {speed: 2, stiffness: 3e8}}\n"
                                "output: {listen: {places: [[1, 2, 3], [4, 5, 60 cm]]}}\n");
    const struct contact *c = r.scene.contacts;
    const struct object_given *o = &c->surface.response.object, *s = &c->scraper.response.object;
    const double places[6] = {1, 2, 3, 4, 5, 0.6};
    ck_assert(o->given && o->shape == OBJECT_PLATE && o->edges == EDGES_FREE && o->material == MATERIAL_OAK &&
              o->length == 0.3 && o->density == 650);
    ck_assert(o->youngs_modulus == 12e9 && o->alpha == 3 && isnan(o->beta) && isnan(o->diameter) && isnan(o->tension) &&
              o->origin[1] == 0.02);
    ck_assert(s->given && s->shape == OBJECT_STRING && s->material == MATERIAL_CUSTOM && isnan(s->thickness) &&
              s->at[0] == 0);
    const struct strike *k = params_of(c, strike_stage.params);
    ck_assert(c->motion.path == PATH_STILL && c->motion.at[0] == 0 && isnan(c->motion.to[0]) && k->count == 0 &&
              k->pulse == PULSE_HERTZ);
    ck_assert(k->stiffness == 3e8 && isnan(k->interval) &&
              !((const struct given_force *)params_of(c, given_table_stage.params))->file &&
              isnan(limiter_of(c)->alpha));
    ck_assert(isnan(*(const double *)params_of(c, smooth_stage.params)) && isnan(c->load.constant) &&
              c->contact.gravity == 9.80665 && c->surface.response.pairing == 0.03);
    ck_assert(r.scene.output.listen.n_places == 2 && memcmp(r.scene.output.listen.places, places, sizeof places) == 0);
    ck_assert(r.scene.output.listen.radiator == RADIATOR_MONOPOLE && r.scene.output.listen.density == 1.204 &&
              r.scene.output.quantity == QUANTITY_AUTO);
    arena_close(r.arena);
}
END_TEST

/* ------------------------------------------------------------------ what the scene tells of responses and motion */

START_TEST(test_rules)
{
    static const struct {
        const char *text;
        bool responds, table, recorded, rings, straight;
    } rows[] = {
        {RINGS("response: a.csv"), true, true, false, true, true},
        {RINGS("response: a.csv, moving: launch"), true, true, false, true, true},
        {RINGS("response: a.wav"), true, false, true, true, true},
        {RINGS("response: folder"), true, false, true, true, true},
        {OBJECT(BAR), true, false, false, true, true},
        {RINGS("space: {}"), true, false, false, true, true},
        {RINGS("space: {dimension_to: 1}"), true, false, false, true, true},
        {RINGS("space: {to: [0, 0]}, moving: readout"), true, false, false, true, true},
        {SCRAPER("material: steel, object: " BAR), false, false, false, true, true},
        {"rasp: 1\nsurface: {roughness: {}}\n" CIRCLE "output: {diagnostics: {}}\n", false, false, false, false, false},
        {STRIKE("{speed: 1, stiffness: 1e8}"), true, true, false, true, true},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        struct result r = read_good(rows[i].text);
        const struct contact *c = r.scene.contacts;
        const struct response *s = &c->surface.response;
        ck_assert_msg(response_given(s) == rows[i].responds && response_is_table(s) == rows[i].table, "%s",
                      rows[i].text);
        ck_assert_msg(response_is_recorded(s) == rows[i].recorded && response_rings(c) == rows[i].rings &&
                          motion_straight(&c->motion) == rows[i].straight,
                      "%s", rows[i].text);
        arena_close(r.arena);
    }
    struct result r = read_good(STRIKE("{speed: 1, stiffness: 1e8}"));
    const struct contact *c = r.scene.contacts;
    ck_assert(motion_speed(&c->motion) == 0 && motion_law(&c->motion) == SPEED_AUTO &&
              motion_rests(&c->motion, false) && motion_rests(&c->motion, true));
    ck_assert(!motion_law_fits(&c->motion, SPEED_GIVEN) && load_approach(c, false) == 0 && load_approach(c, true) == 0);
    struct response folder = {.file = "/tmp"}, none = {.file = "/tmp/none"};
    ck_assert(response_is_folder(&folder) && !response_is_folder(&none));
    arena_close(r.arena);
}
END_TEST

/* Nothing is called missing that may stand in an include that is not there, and none of its contradictions is told. */
START_TEST(test_missing_include)
{
    struct result r = read_with("rasp: 1\ninclude: [none.yaml]\nsurface: {object: {shape: plate}, moving: glide, "
                                "convolution: overlap_add}\ncontact: {model: strike, strike: {count: 3}}\n"
                                "output: {listen: {radiator: plate}, stems: [scraper], level: {dbfs_at_1_pa: 0}}\n",
                                NULL);
    one_error(&r, "scenes/t.yaml:2:11: error: ", "cannot read", "");
    arena_close(r.arena);
}
END_TEST

/* Of several contacts each is told by its name, at the scene's key. */
START_TEST(test_of_contacts)
{
    struct result r =
        read_with(two, SET("output.listen={radiator: point, places: [[0, 0, 0]]}", "contacts.rod.surface.response=null",
                           "contacts.rod.surface.object={shape: shell, diameter: 1 cm, thickness: 1 mm}",
                           "contacts.rod.surface.material=glass"));
    one_error(&r, "--set output.listen: error: ",
              "output.listen.radiator: a point needs surface.object, which contact 'nail' has not", "contact");
    arena_close(r.arena);
    r = read_with(two, SET("contacts.rod.surface.response=null",
                           "contacts.rod.surface.object={shape: bar, length: 1, width: 1}",
                           "contacts.rod.surface.material=glass"));
    one_error(&r, "--set contacts.rod.surface.object: error: ", "contacts.rod.surface.object.thickness is missing",
              "thickness: 5 mm");
    arena_close(r.arena);
    r = read_with(two, SET("output.stems=[surface]", "contacts.rod.gain=0", "contacts.nail.surface.response=null",
                           "output.diagnostics={}"));
    one_error(&r, "--set output.stems: error: ", "nothing rings of which 'surface' would be the stem", "");
    arena_close(r.arena);
}
END_TEST

UNIT("scene_response", test_bad_responses, test_bad_objects, test_bad_contacts, test_bad_outputs, test_good,
     test_values, test_rules, test_missing_include, test_of_contacts)
