/* What is to be heard and written, and whether the contacts have it. */
#include <math.h>
#include <string.h>

#include "base/text.h"
#include "output/impact_rows.h"
#include "output/sound.h"
#include "response/listener.h"
#include "response/response.h"
#include "scene/rows.h"
#include "scene/scene_part.h"
#include "trajectory/contact.h"

static const char *const stems[] = {"force", "surface", "scraper", "ball", NULL};

static const char *radiator_word(const struct listen *l)
{
    return keys_find("output.listen.radiator")->choices[l->radiator].word;
}

/* ------------------------------------------------------------------ the scene's own keys */

static void stem_words_check(const struct scene_part *top)
{
    struct yaml *y = top->yaml;
    const struct yaml_node *list = yaml_find(top->map, "output.stems");
    for (const struct yaml_node *item = list && list->kind == YAML_LIST ? list->first : NULL; item; item = item->next) {
        int i = 0;
        while (item->kind == YAML_SCALAR && stems[i] && strcmp(stems[i], item->text) != 0)
            i++;
        if (item->kind != YAML_SCALAR || !*item->text || yaml_null(item) || stems[i]) continue;
        const char *near = text_nearest(item->text, stems);
        diag_add(y->diag, item->at,
                 near ? arena_format(y->arena, "did you mean '%s'?", near) : "stems: force, surface, scraper, ball",
                 "output.stems: there is no stem '%s'", diag_shown(y->diag, item->text));
    }
}

/* A force is heard nowhere, and of what rings under it nothing is computed. */
static void force_check(const struct scene_part *top, const struct output *o)
{
    const char *quantity = "output.quantity", *radiator = "output.listen.radiator";
    const struct yaml_node *list = yaml_find(top->map, "output.stems");
    if (o->listen.given && o->listen.radiator != RADIATOR_CONTACT)
        scene_part_refuse(top, quantity, radiator, "leave output.listen out, or output.quantity",
                          " is force and %s is %s: a force is not radiated, and is the same at all places", radiator,
                          radiator_word(&o->listen));
    for (const struct yaml_node *item = o->stems ? list->first : NULL; item; item = item->next)
        if (strcmp(item->text, "force") != 0)
            diag_add(top->yaml->diag, item->at, "leave the stem out, or set output.quantity to auto",
                     "output.stems: '%s' is a part of what rings, and nothing rings where %s is force",
                     diag_shown(top->yaml->diag, item->text), quantity);
}

/* A plate radiates to its front; an object's own places lie on it. */
static void heights_check(const struct scene_part *top, const struct listen *l)
{
    const struct yaml_node *list = yaml_find(top->map, "output.listen.places"), *place = list ? list->first : NULL;
    for (int i = 0; l->places && place && i < l->n_places; i++, place = place->next) {
        double z = l->places[3 * i + 2];
        if (l->radiator == RADIATOR_PLATE && z <= 0)
            diag_add(top->yaml->diag, place->last->at, "raise z, or set output.listen.radiator to monopole",
                     "z of place %d of output.listen.places must be above 0 m: a plate in a baffle is heard from in "
                     "front of it",
                     i + 1);
        if (l->radiator == RADIATOR_POINT && z != 0)
            diag_add(top->yaml->diag, place->last->at, "write 0, or set output.listen.radiator to monopole or plate",
                     "z of place %d of output.listen.places must be 0 m: a point lies on the object", i + 1);
    }
}

static void own_check(const struct scene_part *top)
{
    const struct output *o = &((const struct scene *)top->to)->output;
    const char *quantity = "output.quantity", *radiator = "output.listen.radiator", *places = "output.listen.places",
               *at_1_pa = "output.level.dbfs_at_1_pa", *scale = "output.level.full_scale";
    bool pascals = o->listen.given && (o->listen.radiator == RADIATOR_MONOPOLE || o->listen.radiator == RADIATOR_PLATE),
         force = o->quantity == QUANTITY_FORCE, known = scene_part_known(top, quantity);
    const struct yaml_node *node = yaml_find(top->map, scale);
    stem_words_check(top);
    if (o->listen.given && !scene_part_known(top, radiator)) return;
    if (o->channels > 1 && o->listen.n_places > 1)
        scene_part_refuse(
            top, "output.channels", places, "leave output.channels out: each place becomes a channel",
            " is %d and %s has %d places: a scene has either the same sound on all channels or a place for each",
            o->channels, places, o->listen.n_places);
    if (o->quantity != QUANTITY_AUTO && !force && pascals && known)
        scene_part_refuse(
            top, quantity, radiator, "leave output.quantity out, or set output.listen.radiator to contact or point",
            " must be auto where %s is %s: what is heard is a pressure", radiator, radiator_word(&o->listen));
    if (!isnan(o->level.dbfs_at_1_pa) && !pascals)
        diag_add(top->yaml->diag, yaml_find(top->map, at_1_pa)->key->at,
                 "add for instance: listen: {places: [[0, 0, 1 m]]}; or scale by level: {full_scale: ...}",
                 "%s needs a sound in pascals: output.listen with a monopole or a plate", at_1_pa);
    if (force && known) force_check(top, o);
    /* The unit, where one is written, says of what the figure is meant to be. */
    bool newtons = node && !isnan(o->level.full_scale) && strchr(node->text, 'N'),
         unit = newtons || (node && !isnan(o->level.full_scale) && strpbrk(node->text, "mPs"));
    if (unit && newtons != force && known)
        scene_part_refuse(top, scale, quantity,
                          force ? "write for instance: full_scale: 2 N"
                                : "write for instance: full_scale: 1 mm/s; or set output.quantity to force",
                          " is '%s', and the sound is %s", diag_shown(top->yaml->diag, node->text),
                          force ? "a force, in N" : "no force");
    if (o->listen.given) heights_check(top, &o->listen);
}

/* ------------------------------------------------------------------ what the contacts have */

/* What the radiator needs of the surface's response; NULL: nothing that it lacks. */
static const char *lacks(const struct listen *l, const struct response *r)
{
    if (l->radiator == RADIATOR_CONTACT || !response_given(r)) return NULL;
    if (l->radiator == RADIATOR_MONOPOLE) return response_is_recorded(r) ? "a response with modes" : NULL;
    if (!r->object.given) return "surface.object";
    int shape = r->object.shape;
    bool flat = shape == OBJECT_PLATE || shape == OBJECT_DISK || shape == OBJECT_MEMBRANE || shape == OBJECT_DRUM;
    return l->radiator == RADIATOR_PLATE && !flat ? "a surface.object that is flat: a plate, disk, membrane or drum"
                                                  : NULL;
}

static void audible_check(const struct scene_part *p, struct yaml_node *root, const struct scene *s)
{
    const struct contact *c = p->to;
    const struct output *o = &s->output;
    const struct scene_part top = {p->yaml, root, "", KEY_SCENE, (void *)s, s};
    const char *needs = o->listen.given ? lacks(&o->listen, &c->surface.response) : NULL,
               *name = scene_part_contact(p, c->name);
    const char *radiator = "output.listen.radiator", *quantity = "output.quantity", *file = c->surface.response.file;
    if (needs)
        diag_add(p->yaml->diag,
                 yaml_find(root, radiator) ? yaml_find(root, radiator)->at : yaml_find(root, "output.listen")->key->at,
                 "give what it needs, or set output.listen.radiator to contact", "%s: a %s needs %s, which %s has not",
                 radiator, radiator_word(&o->listen), needs, name);
    if (o->quantity != QUANTITY_AUTO && o->quantity != QUANTITY_FORCE && response_is_recorded(&c->surface.response))
        diag_add(p->yaml->diag, scene_part_later(&top, quantity, quantity), "leave output.quantity out",
                 "%s: '%s' of %s is recorded, and of which quantity is not stated", quantity,
                 diag_shown(p->yaml->diag, file), name);
}

/* Of all contacts. */
static void all_check(const struct scene_part *top)
{
    const struct scene *s = top->to;
    const char *path = "output.impacts";
    const struct yaml_node *list = yaml_find(top->map, "output.stems");
    bool listed = s->output.impacts != LISTING_TABLE;
    for (const struct yaml_node *item = s->output.stems ? list->first : NULL; item; item = item->next) {
        bool there = false;
        for (int i = 0; i < s->n_contacts; i++) {
            const struct contact *c = &s->contacts[i];
            bool tool = strcmp(item->text, contact_tool(c)) == 0 && response_tool_rings(c),
                 surface = strcmp(item->text, "surface") == 0 && response_surface_rings(c);
            there |= c->gain != 0 && (strcmp(item->text, "force") == 0 || surface || tool);
        }
        if (!there)
            diag_add(top->yaml->diag, item->at, "leave the stem out, or give what it is of",
                     "output.stems: nothing rings of which '%s' would be the stem", item->text);
    }
    for (int i = 0; i < s->n_contacts; i++)
        listed |= impact_rows_listed(&s->contacts[i], &s->output);
    if (!listed)
        scene_part_refuse(top, path, path, "leave it out, or set contact.model to impacts",
                          " is table, and no contact is of model impacts");
}

/* ------------------------------------------------------------------ the table of diagnostics */

static int column_find(const struct yaml_node *item)
{
    return item->kind == YAML_SCALAR ? params_column_find(item->text) : -1;
}

static const struct yaml_node *column_first(struct yaml_node *root)
{
    const struct yaml_node *list = yaml_find(root, "output.diagnostics.columns");
    return list && list->kind == YAML_LIST ? list->first : NULL;
}

/* ------------------------------------------------------------------ all of it */

enum { FLAC_CHANNELS = 8, FLAC_RATE = 655350 };

static void output_check(const struct scene_part *top, bool contacts)
{
    static const char *const rates[2] = {"output.diagnostics.rate", "output.sample_rate"};
    const struct output *o = &((const struct scene *)top->to)->output;
    if (contacts) {
        all_check(top);
        return;
    }
    struct yaml *y = top->yaml;
    int n = 0;
    while (params_column(n, NULL))
        n++;
    const char **names = ARENA_TAKE(y->arena, const char *, n + 1);
    for (int k = 0; k < n; k++)
        names[k] = params_column(k, NULL)->name;
    for (const struct yaml_node *item = column_first(top->map); item; item = item->next) {
        if (item->kind != YAML_SCALAR || !*item->text || yaml_null(item) || column_find(item) >= 0) continue;
        const char *near = text_nearest(item->text, names);
        diag_add(y->diag, item->at,
                 near ? arena_format(y->arena, "did you mean '%s'?", near)
                      : "rasp explain output.diagnostics.columns lists them",
                 "output.diagnostics.columns: there is no column '%s'", diag_shown(y->diag, item->text));
    }
    if (y->missing) return;
    if (o->diagnostics.given && o->diagnostics.rate > o->sample_rate)
        scene_part_refuse(top, rates[0], rates[1], "lower output.diagnostics.rate",
                          ", %.9g Hz, is above %s, %.9g Hz: some rows would have no samples of the force",
                          o->diagnostics.rate, rates[1], o->sample_rate);
    own_check(top);
    int channels = listener_channels(o) > 1 ? listener_channels(o) : o->channels;
    bool flac = o->encoding == ENCODING_FLAC16 || o->encoding == ENCODING_FLAC24;
    if (flac && (channels > FLAC_CHANNELS || o->sample_rate > FLAC_RATE))
        diag_add(y->diag, scene_part_place(top, yaml_find(top->map, "output.encoding")), "write pcm24, a WAV",
                 "output.encoding: a FLAC has at most %d channels and %d Hz, not %d and %.9g Hz", FLAC_CHANNELS,
                 FLAC_RATE, channels, o->sample_rate);
}

static void contact_check(const struct scene_part *p, struct yaml_node *root, const struct scene *s, bool good)
{
    const struct contact *c = p->to;
    const struct yaml_node *surface = yaml_get(p->map, "surface");
    bool asked = !good /* a misspelt response is reported already */ || s->output.diagnostics.given ||
                 impact_rows_listed(c, &s->output) || response_audible(c, &s->output);
    for (int i = 0; s->output.stems && s->output.stems[i]; i++)
        asked = asked || strcmp(s->output.stems[i], "force") == 0;
    if (!asked)
        diag_add(p->yaml->diag, scene_part_place(p, surface ? surface : p->map),
                 arena_format(p->yaml->arena,
                              "give surface.response, surface.object or surface.space (or one of %s) for a sound, set "
                              "output.quantity to force for the sound of the force alone, or ask for "
                              "output.diagnostics, a table of its physics, or the stem force",
                              contact_tool(c)),
                 "nothing is asked of %s", scene_part_contact(p, c->name));
    for (const struct yaml_node *item = column_first(root); item && s->output.diagnostics.given; item = item->next) {
        int k = column_find(item);
        const char *needs = k < 0 ? "" : params_column_lacks(c, k);
        if (*needs)
            diag_add(p->yaml->diag, item->at, "leave the column out, or give what it needs",
                     "output.diagnostics.columns: %s has no %s: it needs %s", scene_part_contact(p, c->name),
                     item->text, needs);
    }
    audible_check(p, root, s);
}

/* The level of what sounds. */
static double output_instead(const struct key *k, const void *owner)
{
    const struct scene *s = owner;
    if (strcmp(k->path, "output.level.peak") != 0) return NAN;
    for (int i = 0; i < s->n_contacts; i++)
        if (s->contacts[i].gain != 0 && response_audible(&s->contacts[i], &s->output)) return SOUND_PEAK;
    return NAN;
}

/* ------------------------------------------------------------------ parameters */

static const struct choice encodings[] = {[ENCODING_PCM16] = {"pcm16", "16-bit integer"},
                                          [ENCODING_PCM24] = {"pcm24", "24-bit integer"},
                                          [ENCODING_FLOAT32] = {"float32", "32-bit floating point"},
                                          [ENCODING_FLOAT64] = {"float64", "64-bit floating point"},
                                          [ENCODING_FLAC16] = {"flac16", "16-bit integer, in a FLAC"},
                                          [ENCODING_FLAC24] = {"flac24", "24-bit integer, in a FLAC"},
                                          {NULL, NULL}};

static const struct choice quantities[] = {
    [QUANTITY_AUTO] = {"auto", "what the mode tables hold; velocity of objects"},
    [QUANTITY_DISPLACEMENT] = {"displacement", "displacement in m"},
    [QUANTITY_VELOCITY] = {"velocity", "velocity in m/s"},
    [QUANTITY_ACCELERATION] = {"acceleration", "acceleration in m/s^2, with its direct term"},
    [QUANTITY_FORCE] =
        {"force",
         "the contact force itself, in N, which Conan et al. (2014a, 2014b) play as a sound; no response is needed, "
         "and none is computed"},
    {NULL, NULL}};

static const struct choice envelopes[] = {
    [ENVELOPE_NONE] = {"none", "as it is"},
    [ENVELOPE_APPROACH_RECEDE] = {"approach_recede",
                                  "a source that comes, passes in the middle of the sound and goes, at constant speed: "
                                  "gain 1 / sqrt(1 + (c (2 t/T - 1))^2), T the whole sound"},
    {NULL, NULL}};

static const struct key keys[] = {
    {ROW_WHOLE(scene, output.sample_rate, "output.sample_rate"), KEY_FREQUENCY, 8000, 768000, "48 kHz", NULL,
     "audio samples per second"},
    {ROW_CHOICE(scene, output.encoding, "output.encoding"), KEY_NONE, 0, 0, "pcm24", NULL,
     "how samples are stored in the WAV; a FLAC, NAME.flac in its place, is about half as large and has the same "
     "samples, but its bytes are those of one version of libFLAC",
     encodings},
    {ROW_COUNT(scene, output.channels, "output.channels"), KEY_NONE, 1, 64, "1", NULL,
     "channels of the WAV, all with the same sound"},
    {ROW_CHOICE(scene, output.quantity, "output.quantity"), KEY_NONE, 0, 0, "auto", NULL,
     "which quantity is the sound: of the vibration, or the force that excites it", quantities},
    {ROW_PLACE("output.listen")},
    {ROW_LIST(scene, output.stems, "output.stems"), KEY_NONE, 0, 0, "", NULL,
     "parts that are written as WAVs of their own: force, surface, scraper, ball", .example = "[force, surface]",
     .shown = "[force, surface, scraper]"},
    {ROW_NUMBER(scene, output.level.full_scale, "output.level.full_scale"), KEY_OUTPUT, 1e-30, 1e30, "", NULL,
     "physical level: the value, in the response's unit (of quantity: force in N), that becomes 1.0 in the file. "
     "Beyond 1.0, integers are refused, and floating point is written and warned of; so is a file whose samples "
     "are all rounded to 0",
     .shown = "0.01"},
    {ROW_NUMBER(scene, output.level.peak, "output.level.peak"), KEY_DECIBEL, -200, 0, "", NULL,
     "scales the file to this peak, dB re full scale", .shown = "-3 dB"},
    {ROW_NUMBER(scene, output.level.rms, "output.level.rms"), KEY_DECIBEL, -200, 0, "", NULL,
     "scales the file to this rms, dB re full scale", .shown = "-20 dB"},
    {ROW_NUMBER(scene, output.level.lufs, "output.level.lufs"), KEY_LUFS, -200, 0, "", NULL,
     "scales the file to this integrated loudness (BS.1770, which needs 0.4 s; mono counts as dual mono)",
     .shown = "-23 LUFS"},
    {ROW_NUMBER(scene, output.level.dbfs_at_1_pa, "output.level.dbfs_at_1_pa"), KEY_DECIBEL, -200, 100, "", NULL,
     "physical level of a sound in pascals: the level that 1 Pa gets, dB re full scale. Beyond 1.0, integers are "
     "refused, and floating point is written and warned of; so is a file whose samples are all rounded to 0",
     .shown = "-20 dB"},
    {ROW_NUMBER(scene, output.ramp, "output.ramp"), KEY_TIME, 0, 10, "10 ms", NULL,
     "raised-cosine ramps at both ends of the total"},
    {ROW_CHOICE(scene, output.envelope, "output.envelope"), KEY_NONE, 0, 0, "none", NULL,
     "how loud the sound and its stems (but force) are over time, ramps apart; levels are those of the sound under its "
     "envelope",
     envelopes},
    {ROW_NUMBER(scene, output.envelope_depth, "output.envelope_depth"), KEY_DECIBEL, 0, 200, "20 dB",
     "output.envelope=approach_recede", "how far both ends of the sound lie below its middle"},
    {ROW_TIME_OR_AUTO(scene, output.tail, "output.tail"), KEY_TIME, 0, 600, "auto", NULL,
     "how long the sound rings after the last motion; auto: until every response has decayed by 80 dB, at most 60 s"},
    {ROW_NUMBER(scene, output.duration, "output.duration"), KEY_TIME, 1e-3, 36000, "", NULL,
     "exact length of the file, rounded to samples: a sound that would be shorter rings on, one that would be longer "
     "is cut, under output.ramp; left out: as long as motion and tail take",
     .shown = "3 s"},
    {ROW_PLACE("output.diagnostics")},
    {.path = NULL}};

const struct params output_params = {
    .section = "output",
    .keys = keys,
    .alternative = {.most = 1,
                    .paths = {"output.level.full_scale", "output.level.dbfs_at_1_pa", "output.level.peak",
                              "output.level.rms", "output.level.lufs"}},
    .check_scene = output_check,
    .check_asked = contact_check,
    .instead = output_instead};
