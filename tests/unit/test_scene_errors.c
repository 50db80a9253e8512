/* Errors in scenes against messages written down by hand: what is said, where, and the cure. */
#include "scenes.h"

struct bad {
    const char *text;  /* a line (or more) after MIN; from '#' on: a whole scene */
    const char *place; /* line:column                                             */
    const char *says, *cure;
};

/* Each is one error, and no other. */
static const struct bad bads[] = {
    /* unknown, misplaced, duplicate keys */
    {"titel: x\n", "5:1", "unknown key 'titel'", "did you mean 'title'?"},
    {"trajectory: x\n", "5:1", "unknown key 'trajectory'", "keys here: rasp, written_by, title"},
    {"rate: 3 Hz\n", "5:1", "unknown key 'rate'",
     "'rate' belongs elsewhere: motion.rate or contact.impacts.modulation.rate or contact.given.rate or "
     "contact.modulation.rate"},
    {"lufs: -23\n", "5:1", "unknown key 'lufs'", "output.level.lufs"},
    {"oversampling: 3\n", "5:1", "unknown key 'oversampling'", "accuracy.oversampling"},
    {"output: {ramps: 1 s}\n", "5:10", "unknown key 'ramps' in output", "did you mean 'ramp'?"},
    {"output: {level: {peek: -3}}\n", "5:18", "unknown key 'peek' in output.level", "did you mean 'peak'?"},
    {"output: {ramp:1 s}\n", "5:10", "unknown key 'ramp:1 s' in output", "space after the colon"},
    {"output.ramp: 1 s\n", "5:1", "unknown key 'output.ramp'", "keys here"},
    /* what is missing only because its key, or a section above it, is misspelt is no error of its own */
    {"#rasp: 1\nsurfce: {height_map: a.npy, response: a.csv}\nscraper: {mass: 1 g}\nmotion: {path: line, to: [1, 0], "
     "duration: 1}\n",
     "2:1", "unknown key 'surfce'", "'surface'"},
    {"#rasp: 1\nsurface: {heigth_map: a.npy, response: a.csv}\nscraper: {mass: 1 g}\nmotion: {path: line, to: [1, 0], "
     "duration: 1}\n",
     "2:11", "unknown key 'heigth_map'", "'height_map'"},
    {"#rasp: 1\nsurface: {height_map: a.npy, response: a.csv}\nscraper: {mass: 1 g}\nmotion: {path: line, to: [1, 0], "
     "duraton: 1}\n",
     "4:34", "unknown key 'duraton'", "'duration'"},
    {"#rasp: 1\nsurface: {height_map: a.npy, response: a.csv}\nscraper: {mass: 1 g}\n"
     "motion: {path: back_and_forth, to: [1, 0], frequency: 2 Hz, duration: 1}\n",
     "4:44", "unknown key 'frequency'", "'rate'"},
    {"#rasp: 1\nsurface: {height_map: a.npy, response: a.csv}\nscraper:\n  weight 1 N\n"
     "motion: {path: line, to: [1, 0], duration: 1}\n",
     "4:3", "scraper must be a map of keys", "write: weight: 1 N"},
    {"\"\": 1\n", "5:1", "unknown key ''", "keys here"},
    {"rasp: 1\n", "5:1", "duplicate key 'rasp'", "first set on line 1"},
    {"output: {ramp: 1 s, ramp: 2 s}\n", "5:21", "duplicate key 'ramp'", "first set on line 5"},
    {"output:\n  ramp: 1 s\n  tail: 0\n  ramp: 2 s\n", "8:3", "duplicate key 'ramp'", "first set on line 6"},
    /* kinds */
    {"output: loud\n", "5:9", "output must be a map of keys, not 'loud'", "keys here: sample_rate"},
    {"output:\n", "5:8", "output must be a map of keys, not an empty value", "indent the keys"},
    {"output: {ramp: {x: 1}}\n", "5:16", "output.ramp needs a time, not a map of keys", "10 ms"},
    {"output: {ramp: [1, 2]}\n", "5:16", "output.ramp needs a time, not a list", "10 ms"},
    {"output: {ramp: }\n", "5:16", "output.ramp has no value", "10 ms"},
    {"output: {encoding: [pcm16]}\n", "5:20", "output.encoding must be one of", "encoding: pcm24"},
    {"title: [a]\n", "5:8", "title must be a text, not a list", "title:"},
    {"title: \"\"\n", "5:8", "title must be a text", "title:"},
    {"title:\n", "5:7", "title must be a text, not an empty value", "title:"},
    /* numbers */
    {"seed: -1\n", "5:7", "seed must be a whole number from 0", "seed: 7"},
    {"seed: 1.5\n", "5:7", "seed must be a whole number", "seed: 7"},
    {"seed: 07\n", "5:7", "seed must be a whole number", "seed: 7"},
    {"seed: 18446744073709551616\n", "5:7", "18446744073709551615", "seed: 7"},
    {"gain: 2 dB\n", "5:7", "gain needs a plain number without a unit", "write: 2"},
    {"gain: yes\n", "5:7", "yes/no word", "0.5"},
    {"gain: .inf\n", "5:7", "finite", "0.5"},
    {"gain: .nan\n", "5:7", "finite", "0.5"},
    {"gain: 1e999\n", "5:7", "too large", "0.5"},
    {"gain: 0x10\n", "5:7", "decimal", "0.5"},
    {"gain: 010\n", "5:7", "leading zeros", "write: 10"},
    {"gain: 1_000\n", "5:7", "underscores", "write: 1000"},
    {"gain: 1,5\n", "5:7", "decimal point", "write: 1.5"},
    {"gain: 2000\n", "5:7", "gain must be from -1000 to 1000, not '2000'", "factor on this contact's sound"},
    {"start: 1:30\n", "5:8", "clock time", "90 s"},
    {"start: 2 m\n", "5:8", "start needs a time; m is a unit of length", "10 ms"},
    {"start: -1 s\n", "5:8", "start must be from 0 s to 3600 s, not '-1 s'", "begins"},
    {"output: {sample_rate: 44100.5}\n", "5:23", "output.sample_rate must be a whole number, not '44100.5'",
     "44.1 kHz"},
    {"output: {sample_rate: 4 kHz}\n", "5:23", "output.sample_rate must be from 8 kHz to 768 kHz", "per second"},
    {"output: {channels: 1.5}\n", "5:20", "output.channels must be a whole number", "2"},
    {"output: {channels: 0}\n", "5:20", "output.channels must be from 1 to 64", "channels"},
    {"output: {tail: automatic}\n", "5:16", "output.tail needs a time, not 'automatic'", "10 ms"},
    {"output: {level: {full_scale: 3 s}}\n", "5:30", "unit of time", "1 mm/s"},
    {"output: {level: {full_scale: 3 N}}\n", "5:30", "the sound is no force", "set output.quantity to force"},
    {"output: {level: {peak: 3 dB}}\n", "5:24", "output.level.peak must be from -200 dB to 0 dB", "peak"},
    /* words */
    {"output: {encoding: pcm_24}\n", "5:20",
     "output.encoding must be one of: pcm16, pcm24, float32, float64, flac16, flac24, not 'pcm_24'",
     "did you mean 'pcm24'?"},
    {"output: {encoding: mp3}\n", "5:20", "one of: pcm16", "encoding: pcm24"},
    {"contact: {model: slip}\n", "5:18",
     "contact.model must be one of: scrape, strike, given, roll, roll_coupled, impacts, playback, not 'slip'",
     "model: scrape"},
    {"name: 2nd\n", "5:7", "must not start with a digit, not '2nd'", "left_hand"},
    {"name: my contact\n", "5:7", "letters, digits and _", "left_hand"},
    /* alternatives, keys that do not apply */
    {"grip: {}\nload: {constant: 1 N}\n", "6:8", "load.constant and grip exclude each other",
     "grip stands in scenes/t.yaml line 5"},
    {"output: {level: {lufs: -23, peak: -1 dB}}\n", "5:29", "output.level.peak and output.level.lufs exclude",
     "line 5"},
    {"contact: {force: paper, leak: 1 mm}\n", "5:25", "contact.leak applies only where contact.force is directional",
     "it is paper"},
    {"contact: {limiter: {curve: none, zeta: 1}}\n", "5:34",
     "contact.limiter.zeta applies only where contact.limiter.curve is tanh", "it is none"},
    /* pairs and lists */
    {"contact: {limiter: {force_range: [5 N, 1 N]}}\n", "5:34",
     "first number of contact.limiter.force_range must be less", "[1 N, 5 N]"},
    {"contact: {limiter: {force_range: [1 N, 5 m]}}\n", "5:40",
     "the second number of contact.limiter.force_range needs a force", "1.5 N"},
    {"contact: {limiter: {force_range: [1 N]}}\n", "5:34", "must be a list of 2 numbers, not of 1", "[1 N, 5 N]"},
    {"contact: {limiter: {force_range: 3 N}}\n", "5:34", "must be a list of 2 numbers, not '3 N'", "[1 N, 5 N]"},
    {"contact: {limiter: {alpha_min: 6 cm}}\n", "5:32",
     "contact.limiter.alpha_min must not be greater than contact.limiter.alpha_max", ""},
    {"contact: {limiter: {alpha_max: 5 mm}}\n", "5:32", "must not be greater than contact.limiter.alpha_max", ""},
    {"output: {diagnostics: {columns: [x_m, y_m, x_m]}}\n", "5:44", "output.diagnostics.columns has 'x_m' twice",
     "remove"},
    {"output: {diagnostics: {columns: [x_m, '']}}\n", "5:39", "an entry of output.diagnostics.columns must be a text",
     "columns: ["},
    {"output: {diagnostics: {columns: [[x_m]]}}\n", "5:34", "must be a text, not a list", "columns: ["},
    {"output: {diagnostics: {columns: []}}\n", "5:33", "must be a list of 1 to 1000 texts, not of 0", "columns: ["},
    {"output: {diagnostics: {columns: speed}}\n", "5:33", "must be a list of 1 to 1000 texts, not 'speed'",
     "columns: ["},
    {"output: {diagnostics: yes}\n", "5:23", "output.diagnostics must be a map of keys, not 'yes'", "rate, columns"},
    /* accuracy */
    {"accuracy: best\n", "5:11", "accuracy must be a preset or a map of knobs, not 'best'",
     "draft, standard, high, reference"},
    {"accuracy: hihg\n", "5:11", "accuracy must be a preset", "did you mean 'high'?"},
    {"accuracy: [high]\n", "5:11", "not a list", "presets"},
    {"accuracy: {preset: hi}\n", "5:20", "not 'hi'", "presets"},
    {"accuracy: {error: 3 dB}\n", "5:19", "accuracy.error must be from -240 dB to below 0 dB, not '3 dB'",
     "relative to the sound"},
    {"accuracy: {error: -80 m}\n", "5:19", "accuracy.error", ""},
    {"accuracy: {oversmapling: 4}\n", "5:12", "unknown key 'oversmapling' in accuracy", "did you mean 'oversampling'?"},
    {"accuracy: {oversampling: 100}\n", "5:26", "accuracy.oversampling must be from 1 to 64", "sub-intervals"},
    {"accuracy: {oversampling: 2.5}\n", "5:26", "accuracy.oversampling must be a whole number", "sub-intervals"},
    {"accuracy: {oversampling: 2 s}\n", "5:26", "without a unit", "write: 2"},
    {"accuracy: {overlap_order: 4}\n", "5:12", "accuracy.overlap_order is no longer there",
     "leave it out; accuracy.gain_ramp"},
    /* inputs */
    {"inputs: a.csv\n", "5:9", "inputs must be a list", "sha256"},
    {"inputs: [a.csv]\n", "5:10", "an entry of inputs must be a map", "sha256"},
    {"inputs: [{file: a, sha256: 12}]\n", "5:28", "64 hexadecimal digits", "sha256"},
    {"inputs: [{sha256: 0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef}]\n", "5:10", "has no file",
     "file"},
    {"inputs: [{file: a, md5: 12}]\n", "5:20", "unknown key 'md5' in inputs", "file, sha256"},
    /* contacts beside the top-level form */
    {"#rasp: 1\nscraper: {mass: 1 g}\ncontacts:\n- surface: {height_map: a.npy}\n  scraper: {mass: 1 g}\n  motion: "
     "{path: line, to: [1, 0], duration: 1}\n",
     "2:1", "'scraper' describes one contact and must not stand beside contacts", "contacts.NAME.scraper"},
    {"#rasp: 1\ncontacts: []\n", "2:11", "contacts must be a list of 1 to 1000 contacts, not of 0", "- name"},
    {"#rasp: 1\ncontacts: {rod: {}}\n", "2:11", "contacts must be a list of 1 to 1000 contacts, not a map", "- name"},
    {"#rasp: 1\ncontacts: [rod]\n", "2:12", "an entry of contacts must be a map of keys, not 'rod'", "- name"},
    /* include */
    {"include: a.yaml\n", "5:10", "include must be a list", "include: ["},
    {"include: [[a]]\n", "5:11", "an entry of include must be a file name", "include: ["},
    {"include: [no/such/file.yaml]\n", "5:11", "cannot read 'scenes/no/such/file.yaml': No such file",
     "relative to that file's folder"},
    /* missing */
    {"#surface: {height_map: a.npy, response: a.csv}\nscraper: {mass: 20 g}\nmotion: {path: line, to: [1, 0], "
     "duration: 1 s}\n",
     "1:1", "rasp is missing", "add for instance: rasp: 1"},
    {"#rasp: 1\nsurface: {height_map: a.npy}\nscraper: {weight: 1}\nmotion: {path: line, to: [1, 0], duration: 1}\n",
     "3:1", "scraper.mass is missing", "add for instance: mass: 20 g"},
    {"#rasp: 1\nsurface: {height_map: a.npy}\nmotion: {path: line, to: [1, 0], duration: 1}\n", "1:1",
     "scraper.mass is missing", "scraper: {mass: 20 g}"},
    {"#rasp: 1\nsurface: {along: x}\nscraper: {mass: 1 g}\nmotion: {path: line, to: [1, 0], duration: 1}\n", "2:1",
     "surface.roughness, surface.height_map, surface.ridges, surface.grit or surface.fractal must be given",
     "roughness: {}"},
    {"#rasp: 1\nsurface: {roughness: {}}\nscraper: {mass: 1 g}\nmotion: {path: back_and_forth, to: [1, 0], rate: 2}\n",
     "4:1", "motion.duration is missing", "duration: 2 s"},
    {"#rasp: 1\nsurface: {roughness: {}}\nscraper: {mass: 1 g}\nmotion: {path: back_and_forth, to: [1, 0], duration: "
     "2}\n",
     "4:1", "motion.rate is missing", "rate: 2 Hz"},
    {"#rasp: 1\nsurface: {roughness: {}}\nscraper: {mass: 1 g}\nmotion: {path: line, to: [1, 0]}\n", "4:1",
     "motion.speed or motion.duration must be given", "speed: 10 cm/s"},
    {"#rasp: 1\nsurface: {roughness: {}}\nscraper: {mass: 1 g}\nmotion: {to: [1, 0], duration: 1}\n", "4:1",
     "motion.path is missing", "path: back_and_forth"},
    {"#rasp: 1\nsurface: {roughness: {}}\nscraper: {mass: 1 g}\nmotion: {path: line, duration: 1}\n", "4:1",
     "motion.to is missing", "to: [3 cm, 0]"},
    /* values that contradict */
    {"#rasp: 1\nsurface: {roughness: {}}\nscraper: {mass: 1 g}\nmotion: {path: line, from: [1 cm, 0], to: [10 mm, 0], "
     "duration: 1}\n",
     "4:43", "motion.to must differ from motion.from", ""},
    {"#rasp: 1\nsurface: {roughness: {}}\nscraper: {mass: 1 g}\nmotion: {path: line, to: [0, 0], duration: 1}\n",
     "4:26", "motion.to must differ from motion.from", ""},
    {"#rasp: 1\nsurface: {roughness: {shortest: 3 mm}}\nscraper: {mass: 1 g}\nmotion: {path: line, to: [1, 0], "
     "duration: 1}\n",
     "2:33", "surface.roughness.shortest must be less than surface.roughness.longest", ""},
    {"#rasp: 1\nsurface: {roughness: {}}\nscraper: {mass: 1 g}\nmotion: {path: line, rate: 2 Hz, to: [1, 0], duration: "
     "1}\n",
     "4:22", "motion.rate applies only where motion.path is back_and_forth or scribble", "it is line"},
    {"#rasp: 2\nsurface: {roughness: {}}\nscraper: {mass: 1 g}\nmotion: {path: line, to: [1, 0], duration: 1}\n", "1:7",
     "rasp must be 1, not '2'", "version 1"},
    {"#rasp: 1\nsurface: {roughness: {}, along: path, origin: [1 cm, 0]}\nscraper: {mass: 1 g}\nmotion: {path: line, "
     "to: [1, 0], duration: 1}\n",
     "2:39", "surface.origin applies only where surface.along is auto, x or plane", "now it is path"},
    {"#rasp: 1\nsurface: {roughness: {}}\nscraper: {mass: 1 g}\nmotion: {path: line, to: [1 cm, 2 cm, 3 cm], duration: "
     "1}\n",
     "4:26", "motion.to must be a list of 2 numbers, not of 3", "[3 cm, 0]"},
    {"#rasp: 1\nsurface: {roughness: {}}\nscraper: {mass: 1 g}\nmotion: {path: line, to: [1 cm, {y: 1}], duration: "
     "1}\n",
     "4:33", "the second number of motion.to needs a length, not a map of keys", "3 cm"},
    {"#rasp: 1\nsurface: {height_map: [a]}\nscraper: {mass: 1 g}\nmotion: {path: line, to: [1, 0], duration: 1}\n",
     "2:23", "surface.height_map must be a file name, not a list", "profile.npy"},
    {"#rasp: 1\nsurface: {roughness: {}}\nscraper: {mass: 1 g}\nmotion: {path: line, to: [1e-200, 0], duration: 1}\n",
     "4:26", "motion.to must differ from motion.from (the other is the default", "to: [3 cm, 0]"},
    {"#rasp: 1\nsurface: {roughness: {}}\nscraper: {mass: 1 g}\nmotion: {path: line, from: [1 cm, 0], to: [1 cm, 0.9 "
     "nm], duration: 1}\n",
     "4:43", "motion.to must differ from motion.from", "at least 1 nm apart"},
    {"#rasp: 1\nsurface: {roughness: {longest: 1 m, shortest: 1 um}}\nscraper: {mass: 1 g}\nmotion: {path: line, to: "
     "[1, 0], duration: 1}\n",
     "2:47", "surface.roughness.longest is 1e+06 times surface.roughness.shortest", "lower longest"},
    {"grip: {angle: 80 deg, friction: 0.5}\n", "5:33",
     "grip: the tool jams: friction x tan(angle) is 2.836, and must stay below 0.999", "lower grip.angle"},
    {"grip: {friction: 1.7304}\n", "5:18", "grip: the tool jams: friction x tan(angle) is 0.999", "lower grip.angle"},
    {"output: {diagnostics: {columns: [x_m, speed]}}\n", "5:39", "there is no column 'speed'",
     "rasp explain output.diagnostics.columns"},
    {"output: {diagnostics: {columns: [tims_s]}}\n", "5:34", "there is no column 'tims_s'", "did you mean 'time_s'?"},
    {"output: {diagnostics: {columns: [x_m, lift_offs]}}\n", "5:39",
     "the contact has no lift_offs: it needs a grip or a recorded load", "leave the column out"},
    {"contact: {limiter: {curve: none}}\noutput: {diagnostics: {columns: [alpha_m]}}\n", "6:34",
     "the contact has no alpha_m: it needs contact.limiter.curve: tanh", "leave the column out"},
    {"contact: {limiter: {alpha: 1000}}\n", "5:28", "contact.smoothing smooths the force with a sigma of 1.67 s",
     "smoothing: 0 turns it off"},
    {"contact: {smoothing: 10 ms, limiter: {alpha: 31 cm}}\n", "5:22", "sigma of 0.103 s", "smoothing: 0 turns it off"},
    {"contact: {smoothing: 10 ms, limiter: {alpha_max: 31 cm, force_range: [1 N, 2 N]}}\n", "5:22", "sigma of 0.103 s",
     "lower"},
    {"grip: {}\ncontact: {smoothing: 10 ms, limiter: {alpha_max: 31 cm}}\n", "6:22", "sigma of 0.103 s", "lower"},
    {"contact: {smoothing: 1e-10}\n", "5:22", "contact.smoothing must be 0 or at least 1 ns", "0 turns it off"},
    {"#rasp: 1\nsurface: {height_map: a.npy, pitch: 9 nm, response: a.csv}\nscraper: {mass: 1 g}\nmotion: {path: line, "
     "to: [1, 0], duration: 1}\n",
     "2:37", "surface.pitch must be from 10 nm to 1 mm", "did you mean 9 um?"},
    {"#rasp: 1\nsurface: {roughness: {}, response: a.csv, response_length: 1 s, convolution: resonators}\nscraper: "
     "{mass: 1 g}\n"
     "motion: {path: line, to: [1, 0], duration: 1}\n",
     "2:78", "resonators ring on for ever, and surface.response_length cannot cut them", "overlap_add"},
    {"#rasp: 1\nsurface: {roughness: {}}\nscraper: {mass: 1 g, convolution: resonators, response: a.wav}\n"
     "motion: {path: line, to: [1, 0], duration: 1}\n",
     "3:57", "resonators need a mode table (.csv) as scraper.response", "overlap_add"},
    {"#rasp: 1\nsurface: {roughness: {}}\nscraper: {mass: 1 g}\nmotion: {path: line, to: [1, 0], duration: 1}\n", "2:1",
     "nothing is asked of the contact", "give surface.response"},
    {"#rasp: 1\nsurface: {roughness: {}}\nscraper: {mass: 1 g, response: a.csv, weight: 0}\nmotion: {path: line, to: "
     "[1, 0], duration: 1}\n",
     "2:1", "nothing is asked of the contact", "give surface.response"},
    {"#rasp: 2\nsurfaces: {}\nmotion: fast\n", "1:7", "rasp must be 1, not '2'", "version 1"},
    {"#rasp: 1.1\ntitle: a\ntitle: b\n", "1:7", "rasp must be 1, not '1.1'", "version 1"},
    /* not a scene at all */
    {"#just words\n", "1:1", "a scene must be a map of keys", "title"},
    {"#- a\n- b\n", "1:1", "a scene must be a map of keys", "title"},
    {"#rasp: 1\nsurface: {\n", "3:1", "not valid YAML", "brackets"},
};

START_TEST(test_bad)
{
    ck_assert_uint_ge(sizeof bads / sizeof bads[0], 60);
    for (size_t i = 0; i < sizeof bads / sizeof bads[0]; i++) {
        char text[1024], start[128];
        const struct bad *b = &bads[i];
        snprintf(text, sizeof text, "%s%s", *b->text == '#' ? "" : MIN, *b->text == '#' ? b->text + 1 : b->text);
        snprintf(start, sizeof start, "scenes/t.yaml:%s: error: ", b->place);
        struct result r = read_with(text, NULL);
        one_error(&r, start, b->says, b->cure);
        ck_assert_int_eq(r.err.kind, strstr(b->text, "no/such") ? ERR_INPUT : ERR_SCENE);
        ck_assert_msg(strncmp(r.err.text, start, strlen(start)) == 0, "%s", r.err.text);
        arena_close(r.arena);
    }
}
END_TEST

/* ------------------------------------------------------------------ several errors at once */

START_TEST(test_all_at_once)
{
    struct result r = read_with("rasp: 1\nscraper:\n  mass: 20 cm\n\tx\n", NULL);
    one_error(&r, "scenes/t.yaml:4:1: error: not valid YAML", "tab", "tabs");
    arena_close(r.arena);
    r = read_with("rasp: 1\nsurface: {roughness: {rms: 1 V}}\nscraper:\n  mass: 20 cm\nmotion:\n  path: lin\n  to: [1 "
                  "cm, 2 s]\ntitel: x\n",
                  NULL);
    ck_assert_str_eq(
        r.messages, "scenes/t.yaml:2:28: error: surface.roughness.rms needs a length; 'V' is not a unit that is known\n"
                    "    2 | surface: {roughness: {rms: 1 V}}\n"
                    "      |                            ^~~\n"
                    "      = help: units: m, cm, mm, um, nm; write for instance: 3 cm\n"
                    "scenes/t.yaml:4:9: error: scraper.mass needs a mass; cm is a unit of length\n"
                    "    4 |   mass: 20 cm\n"
                    "      |         ^~~~~\n"
                    "      = help: write for instance: 20 g\n"
                    "scenes/t.yaml:6:9: error: motion.path must be one of: back_and_forth, line, four_in_line, circle, "
                    "scribble, polyline, spline, recorded, still, incline, not 'lin'\n"
                    "    6 |   path: lin\n"
                    "      |         ^~~\n"
                    "      = help: did you mean 'line'?\n"
                    "scenes/t.yaml:7:14: error: the second number of motion.to needs a length; s is a unit of time\n"
                    "    7 |   to: [1 cm, 2 s]\n"
                    "      |              ^~~\n"
                    "      = help: write for instance: 3 cm\n"
                    "scenes/t.yaml:8:1: error: unknown key 'titel'\n"
                    "    8 | titel: x\n"
                    "      | ^~~~~\n"
                    "      = help: did you mean 'title'?\n"
                    "5 errors\n");
    ck_assert_str_eq(r.err.text, "scenes/t.yaml:2:28: error: surface.roughness.rms needs a length; 'V' is not a unit "
                                 "that is known (and 4 more)");
    arena_close(r.arena);
}
END_TEST

/* An include that is not there hides no other error, and nothing that may stand in it is called missing or
 * contradictory. */
START_TEST(test_missing_include)
{
    static const char *const all[] = {":2:11: error: cannot read 'scenes/none.yaml'",
                                      ":3:1: error: unknown key 'titel'", ":4:17: error: scraper.mass needs",
                                      "--set gain: error: gain needs a plain number", "\n4 errors\n"};
    struct result r = read_with(
        "rasp: 1\ninclude: [none.yaml]\ntitel: x\nscraper: {mass: 1 m}\nsurface: {pitch: 1 um, origin: [1 cm, 0]}\n"
        "motion: {rate: 1 Hz, to: [0, 0]}\ngrip: {friction: 10}\noutput: {diagnostics: {columns: [x_m]}}\n",
        SET("gain=1 s", "contacts.rod.gain=2"));
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        ck_assert_msg(strstr(r.messages, all[i]) != NULL, "%s:\n%s", all[i], r.messages);
    ck_assert_int_eq(r.err.kind, ERR_INPUT);
    arena_close(r.arena);
}
END_TEST

/* Told of each contact that cannot have the column. */
START_TEST(test_columns_of_contacts)
{
    struct result r = read_with(two, SET("output.diagnostics.columns=[time_s, lift_offs]", "contacts.nail.grip={}"));
    one_error(&r, "--set output.diagnostics.columns: error: ", "contact 'rod' has no lift_offs: it needs a grip",
              "leave the column out");
    arena_close(r.arena);
    r = read_with(two, SET("output.diagnostics.columns=[lift_offs]"));
    ck_assert_msg(strstr(r.messages, "contact 'rod' has") && strstr(r.messages, "contact 'nail' has") &&
                      strstr(r.messages, "\n2 errors\n"),
                  "%s", r.messages);
    arena_close(r.arena);
}
END_TEST

/* Errors of text, of values against each other and of columns: none hides another. */
START_TEST(test_sense_at_once)
{
    static const char *const all[] = {":3:33: error: surface.roughness.shortest must be less",
                                      ":4:17: error: scraper.mass needs",
                                      ":5:26: error: motion.to must differ",
                                      ":6:33: error: grip: the tool jams",
                                      ":7:39: error: output.diagnostics.columns: there is no column 'foo'",
                                      "\n5 errors\n"};
    struct result r = read_with("rasp: 1\ntitle: x\nsurface: {roughness: {shortest: 3 mm}}\nscraper: {mass: 1 m}\n"
                                "motion: {path: line, to: [0, 0], duration: 1}\ngrip: {angle: 60 deg, friction: 1}\n"
                                "output: {diagnostics: {columns: [x_m, foo]}}\n",
                                NULL);
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        ck_assert_msg(strstr(r.messages, all[i]) != NULL, "%s:\n%s", all[i], r.messages);
    arena_close(r.arena);
}
END_TEST

/* ------------------------------------------------------------------ --set */

static const struct {
    const char *scene, *set, *start, *says, *cure;
} bad_sets[] = {
    {full, "motion.rate=3 m", "--set motion.rate: error: ", "motion.rate needs a frequency", "2 Hz"},
    {full, "motion.raet=3 Hz", "--set motion.raet: error: ", "unknown key 'raet' in motion", "did you mean 'rate'?"},
    {full, "motoin.rate=3 Hz", "--set motoin.rate: error: ", "unknown key 'motoin'", "did you mean 'motion'?"},
    {full, "rate=3 Hz", "--set rate: error: ", "unknown key 'rate'", "motion.rate"},
    {full, "motion.rate", "--set motion.rate: error: ", "has no '=VALUE'", "motion.rate=3 Hz"},
    {full, "motion..rate=3", "--set motion..rate: error: ", "a part of the path is empty", "motion.rate=3 Hz"},
    {full, "=3", "--set : error: ", "a part of the path is empty", "motion.rate=3 Hz"},
    {full, "motion.rate=", "--set motion.rate: error: ", "motion.rate has no value", "2 Hz"},
    {full, "motion.to=[1 cm, 2 cm", "--set motion.to: error: ", "not valid YAML", "brackets"},
    {full, "motion.to=[1 cm, 2 s]", "--set motion.to: error: ", "the second number of motion.to needs a length",
     "3 cm"},
    {full, "motion.rate.x=1", "--set motion.rate.x: error: ", "motion.rate needs a frequency, not a map of keys",
     "2 Hz"},
    {full, "motion=fast", "--set motion: error: ", "motion must be a map of keys, not 'fast'", "keys here"},
    {full, "motion.speed=1 m/s", "--set motion.speed: error: ",
     "applies only where motion.path is line, four_in_line, circle, polyline or spline", "it is back_and_forth"},
    {full, "include=[x]", "--set include: error: ", "include cannot be set", "scene file"},
    {full, "accuracy.error=0", "--set accuracy.error: error: ", "must be from -240 dB to below 0 dB",
     "relative to the sound"},
    {full, "title=a\x07", "--set title: error: ", "control character U+0007", "remove"},
    {full, "title=\xff", "--set title: error: ", "not valid UTF-8", "UTF-8"},
    {full, "motion.to.2=1 cm", "--set motion.to.2: error: ", "no entry '2' in this list", "from 0 to 1"},
    {two, "contacts.rdo.motion.rate=3 Hz", "--set contacts.rdo.motion.rate: error: ", "no entry 'rdo' in this list",
     "did you mean 'rod'?"},
    {two, "contacts.2.motion.rate=3 Hz", "--set contacts.2.motion.rate: error: ", "no entry '2' in this list",
     "number from 0 to 1"},
    {two, "contacts.rod.motion.rate=3 s",
     "--set contacts.rod.motion.rate: error: ", "contacts.rod.motion.rate needs a frequency", "2 Hz"},
    {two, "contacts.1.motion.sped=3 s",
     "--set contacts.1.motion.sped: error: ", "unknown key 'sped' in contacts.nail.motion", "did you mean 'speed'?"},
    {two, "motion.rate=3 Hz", "--set motion.rate: error: ", "'motion' describes one contact", "contacts.NAME.motion"},
    {two, "contacts.rod.seed=3", "--set contacts.rod.seed: error: ", "'seed' belongs to the whole scene", "top level"},
    {two, "contacts.nail.name=rod", "--set contacts.nail.name: error: ", "two contacts are named 'rod'",
     "name of its own"},
    {full, "grip.angle=80 deg", "--set grip.angle: error: ", "grip: the tool jams", "lower grip.angle"},
    {full, "output.diagnostics.columns=[tims_s]", "--set output.diagnostics.columns: error: ", "no column 'tims_s'",
     "did you mean 'time_s'?"},
    {full, "motion.from=[7.5 cm, 2 cm]", "--set motion.from: error: ", "motion.to must differ", "to: [3 cm, 0]"},
    {full, "rasp=2", "--set rasp: error: ", "rasp must be 1, not '2'", "version 1"},
    {two, "contacts.rod.grip={angle: 89 deg}", "--set contacts.rod.grip: error: ", "contacts.rod.grip: the tool jams",
     "lower grip.angle"},
    {two, "contacts.nail.surface={convolution: resonators, response_length: 1 s}",
     "--set contacts.nail.surface: error: ", "contacts.nail.surface.convolution: resonators ring on for ever",
     "overlap_add"},
    {two, "contacts.1.surface.response=null", "scenes/t.yaml:9:3: error: ", "nothing is asked of contact 'nail'",
     "give surface.response"},
    {two, "contacts.rod.surface=null", "scenes/t.yaml:3:3: error: ",
     "contacts.rod.surface.ridges, contacts.rod.surface.grit or contacts.rod.surface.fractal must be given",
     "surface: {roughness: {}}"},
};

START_TEST(test_bad_set)
{
    for (size_t i = 0; i < sizeof bad_sets / sizeof bad_sets[0]; i++) {
        struct result r = read_with(bad_sets[i].scene, SET(bad_sets[i].set));
        one_error(&r, bad_sets[i].start, bad_sets[i].says, bad_sets[i].cure);
        arena_close(r.arena);
    }
    struct result r = read_with(full, SET("motion.rate=3 m"));
    ck_assert_str_eq(r.messages, "--set motion.rate: error: motion.rate needs a frequency; m is a unit of length\n"
                                 "      | motion.rate=3 m\n"
                                 "      |             ^~~\n"
                                 "      = help: write for instance: 2 Hz\n"
                                 "1 error\n");
    arena_close(r.arena);
}
END_TEST

UNIT("scene_errors", test_bad, test_all_at_once, test_sense_at_once, test_columns_of_contacts, test_missing_include,
     test_bad_set)
