/* See keys_yaml.h. A map's header is written when its first key is, and is itself commented out when all of its keys
 * are. */
#include "scene/keys_yaml.h"

#include <inttypes.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "scene/keys.h"
#include "scene/keys_text.h"
#include "scene/params.h"

static bool under(const char *path, const char *map, size_t length)
{
    return !strncmp(path, map, length) && path[length] == '.';
}

static void print_comment(FILE *f, const char *text, int indent)
{
    char margin[64];
    snprintf(margin, sizeof margin, "%*s# ", indent, "");
    fputs(margin, f);
    text_wrap(f, text, indent + 2, margin);
}

/* Headers of the maps that `path` is in and `last` is not; returns the indent of the key itself. */
static int open_maps(FILE *f, const struct keys_line *lines, int n, int i, const struct keys_style *style)
{
    const char *path = lines[i].path, *last = i > 0 ? lines[i - 1].path : "";
    int indent = style->indent;
    for (const char *dot = strchr(path, '.'); dot; dot = strchr(dot + 1, '.')) {
        size_t length = (size_t)(dot - path);
        const char *meaning = NULL;
        for (const struct key_section *s = keys_sections; style->comments && s->path; s++)
            if (strlen(s->path) == length && !strncmp(s->path, path, length)) meaning = s->meaning;
        bool off = true; /* every line of the map is */
        for (int k = 0; k < n; k++)
            off = off && (lines[k].off || !under(lines[k].path, path, length));
        if (!under(last, path, length)) {
            if (style->comments && indent == style->indent) fputc('\n', f);
            if (meaning) print_comment(f, meaning, indent);
            size_t start = length;
            while (start > 0 && path[start - 1] != '.')
                start--;
            fprintf(f, "%*s%s%.*s:\n", indent, "", off ? "#" : "", (int)(length - start), path + start);
        }
        indent += 2;
    }
    return indent;
}

void keys_yaml_print(FILE *f, const struct keys_line *lines, int n, const struct keys_style *style)
{
    if (style->item) { /* to memory, with "- " over the last two columns before the first key */
        struct keys_style inner = *style;
        char *text = NULL;
        size_t size = 0;
        FILE *memory = memory_stream(&text, &size);
        inner.item = false;
        keys_yaml_print(memory, lines, n, &inner);
        memory_stream_end(memory, &text);
        if (style->indent >= 2 && size > (size_t)style->indent) text[style->indent - 2] = '-';
        fputs(text, f);
        free(text);
        return;
    }
    for (int i = 0; i < n; i++) {
        if (style->comments && !strchr(lines[i].path, '.') && i > 0 && strchr(lines[i - 1].path, '.')) fputc('\n', f);
        const char *dot = strrchr(lines[i].path, '.');
        int indent = open_maps(f, lines, n, i, style);
        if (lines[i].comment) print_comment(f, lines[i].comment, indent);
        fprintf(f, "%*s%s%s: %s\n", indent, "", lines[i].off ? "#" : "", dot ? dot + 1 : lines[i].path, lines[i].value);
    }
}

/* ------------------------------------------------------------------ scalars */

const char *keys_yaml_quoted(const char *text, struct arena *a)
{
    char *memory = NULL;
    size_t size = 0;
    FILE *f = memory_stream(&memory, &size);
    fputc('"', f);
    for (const char *s = text; *s;) {
        uint32_t code = 0;
        int n = text_utf8(s, strlen(s), &code);
        /* May it stand in a YAML stream as it is, on one line? (YAML 1.1, c-printable without line breaks.) */
        bool plain = (code >= 0x20 && code <= 0x7E) || (code >= 0xA0 && code != 0x2028 && code != 0x2029 &&
                                                        code != 0xFEFF && code != 0xFFFE && code != 0xFFFF);
        if (n && !plain)
            fprintf(f, code <= 0xFF ? "\\x%02" PRIX32 : "\\u%04" PRIX32, code);
        else {
            if (*s == '"' || *s == '\\') fputc('\\', f);
            fwrite(s, 1, (size_t)(n ? n : 1), f);
        }
        s += n ? n : 1;
    }
    fputc('"', f);
    memory_stream_end(f, &memory);
    const char *quoted = arena_text(a, memory);
    free(memory);
    return quoted;
}

const char *keys_yaml_number(double x, struct arena *a)
{
    char text[40];
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, x);
        if (strtod(text, NULL) == x) break;
    }
    return arena_text(a, text);
}

/* ------------------------------------------------------------------ the reference scene */

/* From the tables come keys, defaults, ranges, meanings; only what has no default is shown by an
   example from here. A key is commented out when it stands for something else than the scene shows: a rival of a key
   that is given, a section that is not, or a key that does not apply. */

/* A path that begins with a dot stands for those of the surface, the scraper and the ball. */
static const struct {
    const char *path, *value;
    bool off;
} examples[] = {
    {"rasp", "1", false},
    {"title", "\"a tool scraped back and forth on a rough plank\"", false},
    {"surface.recipe", "plank.yaml", true},
    {"surface.height_map", "plank.npy", true},
    {"surface.pitch", "5 um", true},
    {"surface.height_range", "100 um", true},
    {"surface.continuation.exponent", "-2.4", true},
    {"surface.continuation.from", "50 um", true},
    {"surface.roughness.like", "plank.gsf", true},
    {"surface.roughness.like_pitch", "5 um", true},
    {"surface.response", "plank.csv", true},
    {"ablation.place", "[5 cm, 2 cm]", true},
    {"output.duration", "3 s", true},
    {".object.shape", "plate", true},
    {".object.length", "30 cm", true},
    {".object.width", "20 cm", true},
    {".object.diameter", "10 cm", true},
    {".object.thickness", "5 mm", true},
    {".object.tension", "80 N", true},
    {".object.surface_tension", "2 kN/m", true},
    {".object.youngs_modulus", "12 GPa", true},
    {".object.youngs_modulus_across", "0.8 GPa", true},
    {".object.shear_modulus", "0.9 GPa", true},
    {".object.poisson", "0.35", true},
    {".object.density", "650 kg/m^3", true},
    {".object.alpha", "10 1/s", true},
    {".object.beta", "0.1 us", true},
    {".object.loss", "0.01", true},
    {"surface.space.to", "[-0.5, 0.86]", true},
    {"surface.space.dimension_to", "3", true},
    {"scraper.mass", "20 g", false},
    {"scraper.radius", "1 mm", true},
    {"scraper.response", "tool.csv", true},
    {"ball.radius", "1 cm", true},
    {"ball.mass", "11 g", true},
    {"ball.wall", "2 mm", true},
    {"ball.response", "ball.csv", true},
    {"motion.path", "back_and_forth", false},
    {"motion.to", "[4.5 cm, 0 cm]", false},
    {"motion.radius", "2 cm", true},
    {"motion.points", "[[0 cm, 0 cm], [3 cm, 1 cm], [6 cm, 0 cm]]", true},
    {"motion.file", "recording.csv", true},
    {"motion.rate", "2 Hz", false},
    {"motion.speed", "10 cm/s", true},
    {"motion.duration", "2 s", false},
    {"motion.profile", "speed.csv", true},
    {"load.constant", "1.5 N", true},
    {"load.recorded", "force.csv", true},
    {"contact.strike.speed", "1 m/s", true},
    {"contact.strike.stiffness", "1e8 N/m^1.5", true},
    {"contact.strike.interval", "0.5 s", true},
    {"contact.strike.restitution", "0.7", true},
    {"contact.given.file", "force.wav", true},
    {"contact.given.scale", "10 N", true},
    {"contact.given.rate", "48 kHz", true},
    {"contact.roll.stiffness", "2e9 N/m^1.5", true},
    {"contact.roll.kappa", "5e9 N/(m^1.5 kg)", true},
    {"contact.roll.static_penetration", "8 um", true},
    {"contact.impacts.prototype", "roll", true},
    {"contact.impacts.amplitude.mean", "0.35", true},
    {"contact.impacts.amplitude.deviation", "0.04", true},
    {"contact.impacts.amplitude.a1", "-0.95", true},
    {"contact.impacts.amplitude.b1", "0.2", true},
    {"contact.impacts.amplitude.table", "amplitudes.csv", true},
    {"contact.impacts.interval.mean", "5 ms", true},
    {"contact.impacts.interval.deviation", "0.5 ms", true},
    {"contact.impacts.interval.a1", "-0.95", true},
    {"contact.impacts.interval.b1", "0", true},
    {"contact.impacts.interval.table", "intervals.csv", true},
    {"contact.impacts.duration.zeta", "0.4 ms", true},
    {"contact.impacts.duration.theta", "0.29", true},
    {"contact.impacts.modulation.depth", "0.3", true},
    {"contact.impacts.modulation.rate", "3 Hz", true},
    {"contact.impacts.floor.amplitude", "0.01", true},
    {"contact.impacts.space.angle_to", "-120 deg", true},
    {"contact.impacts.space.radius_to", "0.5", true},
    {"contact.impacts.space.walk", "walk.csv", true},
    {"contact.limiter.force_range", "[0.2 N, 5 N]", true},
    {"output.listen.places", "[[0 m, 0 m, 1 m], [20 cm, 0 m, 1 m]]", true},
    {"output.stems", "[force, surface, scraper]", true},
    {"output.level.full_scale", "0.01", true},
    {"output.level.peak", "-3 dB", true},
    {"output.level.rms", "-20 dB", true},
    {"output.level.lufs", "-23 LUFS", true},
    {"output.level.dbfs_at_1_pa", "-20 dB", true},
    {"output.diagnostics.columns", "[time_s, speed_m_per_s, normal_force_n]", true},
    {NULL, NULL, false},
};

static const char *const sections_off[] = {
    "surface.object", "surface.space", "scraper.object", "ball.object", "grip", "output.listen", NULL};

static const char head[] =
    "# Every key of a scene, with its default. It is a scene: rasp check takes it as it stands.\n"
    "# A line that begins with #key: is an alternative or may be left out; remove the # to use it.\n"
    "# A bare number is in SI units (m, s, kg, N, Hz, rad); with a unit it is what the unit says: 20 g, 5.6 um, 30 "
    "deg.\n"
    "\n";

static const char tail[] =
    "\n"
    "# Several contacts, whose sounds add up, stand in a list instead of at the top level:\n"
    "#contacts:\n"
    "#  - name: rod\n"
    "#    surface: {roughness: {rms: 4 um}}\n"
    "#    scraper: {mass: 20 g}\n"
    "#    motion: {path: line, to: [10 cm, 0 cm], speed: 5 cm/s}\n"
    "#  - name: comb\n"
    "#    start: 0.5 s\n"
    "#    surface: {roughness: {rms: 9 um}}\n"
    "#    scraper: {mass: 8 g}\n"
    "#    motion: {path: line, to: [10 cm, 0 cm], speed: 20 cm/s}\n"
    "\n"
    "# Scene files to build on: maps merge, lists are replaced, this file wins. Names are as seen from this file.\n"
    "#include: [plank.yaml, hand.yaml]\n";

static int example(const char *path)
{
    const char *rest = path + strcspn(path, ".");
    for (int i = 0; examples[i].path; i++)
        if (!strcmp(examples[i].path, examples[i].path[0] == '.' ? rest : path)) return i;
    return -1;
}

const char *keys_yaml_example(const char *path)
{
    int i = example(path);
    const struct key *k = i < 0 ? keys_find(path) : NULL;
    return i >= 0 ? examples[i].value : k ? k->example : NULL;
}

static const char *shown(const struct key *k)
{
    const char *value = keys_yaml_example(k->path);
    return value ? value : k->standard ? k->standard : "";
}

static bool is_off(const struct key *k);

static bool applies(const struct key *k)
{
    const struct key *decides = keys_decider(k);
    if (!decides) return true;
    return applies(decides) &&
           (keys_words(k) ? keys_applies_with(k, shown(decides)) : keys_applies_beside(k, !is_off(decides)));
}

static bool is_off(const struct key *k)
{
    int i = example(k->path);
    for (const char *const *s = sections_off; *s; s++)
        if (!strncmp(k->path, *s, strlen(*s)) && k->path[strlen(*s)] == '.') return true;
    if (k->in && k->in->meaning && !k->in->shown) return true;
    return (i >= 0 && examples[i].off) || (i < 0 && k->standard && !*k->standard) || !applies(k);
}

static const char *comment(const struct key *k, struct arena *a)
{
    const char *range = keys_text_range(k, a), *when = keys_text_applies(k, a);
    const char *all = arena_format(a, "%s%s%s%s%s", k->meaning, range ? "; " : "", range ? range : "",
                                   when ? "; only " : "", when ? when : "");
    const char *rivals = NULL;
    for (const struct key_alternative *t = keys_alternatives; t->paths[0]; t++)
        for (int i = 0; !rivals && t->paths[i]; i++)
            if (!strcmp(t->paths[i], k->path))
                rivals = arena_format(a, "; %s%s", keys_text_rivals(t, a), keys_text_rivals_apply(t, a));
    if (rivals) all = arena_format(a, "%s%s", all, rivals);
    if (keys_same_words(k)) return arena_format(a, "%s; words: see %s", all, keys_same_words(k)->path);
    for (const struct choice *c = k->choices; c && c->word; c++)
        all = arena_format(a, "%s\n- %s: %s", all, c->word, c->meaning);
    return all;
}

static void print_knobs(FILE *f, struct arena *a)
{
    int n = 2, room = 2;
    for (const struct key_knob *k = keys_knobs; k->name; k++)
        room++;
    struct keys_line *lines = ARENA_TAKE(a, struct keys_line, room);
    lines[0] = (struct keys_line){.path = "accuracy.preset", .value = "standard"};
    lines[1] = (struct keys_line){.path = "accuracy.error", .value = "-80 dB", .off = true};
    for (const struct keys_text_frame *p = keys_text_frames; p->path; p++)
        for (int i = 0; i < 2; i++)
            if (!strcmp(p->path, lines[i].path)) lines[i].comment = p->meaning;
    for (const struct key_knob *k = keys_knobs; k->name; k++) {
        const char *all = arena_format(a, "%s; %.6g to %.6g;", k->meaning, k->low, k->high);
        for (int i = 0; i < 4; i++)
            all = arena_format(a, "%s%s %s %s", all, i ? "," : "", keys_presets[i], keys_yaml_number(k->preset[i], a));
        lines[n++] = (struct keys_line){.path = arena_format(a, "accuracy.%s", k->name),
                                        .value = keys_yaml_number(k->preset[1], a),
                                        .comment = all};
    }
    keys_yaml_print(f, lines, n, &(struct keys_style){.comments = true});
}

void keys_yaml_reference(FILE *f, struct arena *a)
{
    int n = 0;
    while (keys_table[n].path)
        n++;
    struct keys_line *lines = ARENA_TAKE(a, struct keys_line, n);
    for (int i = 0; i < n; i++)
        lines[i] = (struct keys_line){keys_table[i].path, shown(&keys_table[i]), comment(&keys_table[i], a),
                                      is_off(&keys_table[i])};
    fputs(head, f);
    keys_yaml_print(f, lines, n, &(struct keys_style){.comments = true});
    print_knobs(f, a);
    fputs(tail, f);
}
