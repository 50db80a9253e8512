/* rasp explain: what a scene may say, and what a scene says in full. As JSON ranges are in SI units; null stands for
 * what there is none of: unit, range, default ("" would be a text), condition, words. */
#include <ctype.h>
#include <jansson.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/text.h"
#include "base/wrap.h"
#include "cmd/cmd.h"
#include "cmd/schema.h"
#include "output/force_table.h"
#include "scene/keys_man.h"
#include "scene/keys_reference.h"
#include "scene/keys_text.h"
#include "scene/scene_write.h"

static json_t *text_or_null(const char *s) { return s && *s ? json_string(s) : json_null(); }

static json_t *words(const struct choice *c)
{
    if (!c) return json_null();
    json_t *all = json_array();
    for (; c->word; c++)
        json_array_append_new(all, json_pack("{s:s, s:s}", "word", c->word, "meaning", c->meaning));
    return all;
}

static json_t *key(const struct key *k)
{
    struct arena *a = arena_open();
    bool range = keys_text_range(k, a);
    json_t *o =
        json_pack("{s:s, s:s, s:s, s:o, s:o, s:o, s:b, s:o, s:o, s:o}", "path", k->path, "meaning", k->meaning, "type",
                  k->type == KEY_CHOICE ? "word" : keys_text_type(k), "unit",
                  text_or_null(keys_text_unit(k->dimension)), "low", range ? json_real(k->low) : json_null(), "high",
                  range ? json_real(k->high) : json_null(), "must_be_given", !k->standard, "default",
                  text_or_null(k->standard), "only", text_or_null(keys_text_applies(k, a)), "words", words(k->choices));
    arena_close(a);
    return o;
}

static json_t *knob(const struct key_knob *k)
{
    json_t *presets = json_object();
    for (int i = 0; keys_presets[i]; i++)
        json_object_set_new(presets, keys_presets[i], json_real(k->preset[i]));
    return json_pack("{s:o, s:s, s:s, s:f, s:f, s:o}", "path", json_sprintf("accuracy.%s", k->name), "meaning",
                     k->meaning, "type", k->whole ? "whole number" : "number", "low", k->low, "high", k->high,
                     "presets", presets);
}

/* Is it the path itself, or in its map? */
static bool within(const char *path, const char *map)
{
    size_t n = strlen(map);
    return !n || (!strncmp(path, map, n) && (!path[n] || path[n] == '.'));
}

/* The keys and knobs at a path or in a map of that path, in the order of the tables; "": all. */
static json_t *explain_json(const char *path)
{
    const char *name = strncmp(path, "accuracy.", 9) ? path : path + 9;
    bool all = !*path || !strcmp(path, "accuracy");
    json_t *rows = json_array();
    for (const struct key *k = keys_table; k->path; k++)
        if (within(k->path, path)) json_array_append_new(rows, key(k));
    for (const struct key_knob *k = keys_knobs; k->name; k++)
        if (all || !strcmp(k->name, name)) json_array_append_new(rows, knob(k));
    return rows;
}

static bool is_scene_file(const char *word)
{
    size_t n = strlen(word);
    struct stat s;
    return strchr(word, '/') || (n > 5 && !strcmp(word + n - 5, ".yaml")) || (n > 4 && !strcmp(word + n - 4, ".yml")) ||
           (stat(word, &s) == 0 && !S_ISDIR(s.st_mode));
}

static const struct key_knob *find_knob(const char *path)
{
    const char *name = strncmp(path, "accuracy.", 9) ? path : path + 9;
    for (const struct key_knob *k = keys_knobs; k->name; k++)
        if (!strcmp(k->name, name)) return k;
    return NULL;
}

static bool is_name(const char *path, const char **names)
{
    for (; *names; names++)
        if (!strcmp(*names, path)) return true;
    return false;
}

static void list_columns(void)
{
    fputs("  columns\n", stdout);
    for (const struct table_column *t = force_table_columns; t->name; t++) {
        int n = printf("    %-22s ", t->name);
        wrap_print(stdout, t->meaning, n, "                           ");
    }
}

/* True when there was something of that name to explain. */
static bool explain_path(const char *path, const char **names, struct arena *a)
{
    const struct key *k = keys_find(path);
    const struct key_knob *knob = find_knob(path);
    if (k) {
        keys_text_print_key(stdout, k, a);
        if (!strcmp(path, "output.diagnostics.columns")) list_columns();
    } else if (knob)
        keys_text_print_knob(stdout, knob, a);
    else if (!strcmp(path, "accuracy"))
        keys_text_print_accuracy(stdout, a);
    else if (is_name(path, names))
        keys_text_print_map(stdout, path, a);
    else
        return false;
    return true;
}

/* Every path that ends in the word: "motion.rate or output.diagnostics.rate"; NULL: none. */
static const char *endings(const char *word, const char **names, struct arena *a)
{
    const char *found = NULL;
    for (; *names; names++) {
        const char *dot = strrchr(*names, '.');
        if (dot && !strcmp(dot + 1, word)) found = found ? arena_format(a, "%s or %s", found, *names) : *names;
    }
    return found;
}

static json_t *design_key(json_t *schema, const char *word)
{
    json_t *key = json_object_get(json_object_get(schema, "properties"), word);
    return key && json_object_get(key, "$ref") ? json_object_get(json_object_get(schema, "$defs"), word) : key;
}

static const char *design_text(json_t *key)
{
    const char *text = json_string_value(json_object_get(key, "description"));
    return text ? text : "";
}

/* Every key of designs and what it is for. */
static void list_designs(json_t *schema)
{
    const char *name;
    json_t *unused;
    json_object_foreach(json_object_get(schema, "properties"), name, unused)
    {
        int n = printf("%s: ", name);
        wrap_print(stdout, design_text(design_key(schema, name)), n, "  ");
    }
    printf("\ndesigns: man rasp-design(5), rasp batch --help\n");
}

static bool names_designs(const char *word) { return !strcmp(word, "design") || !strcmp(word, "designs"); }

/* A key of designs, which are explained elsewhere; of scenes there may be one of that name in some section, too. False:
 * there is none. */
static bool explain_design(const char *word, const char **names, struct arena *a)
{
    json_t *schema = schema_design(a), *key = design_key(schema, word);
    const char *text = design_text(key), *scenes = endings(word, names, a);
    bool all = names_designs(word);
    if (all)
        list_designs(schema);
    else if (key) {
        printf("%s\n  a key of designs", word);
        int n = 18 + (*text ? printf(": ") : 0);
        wrap_print(stdout, text, n, "  ");
        printf("%s  designs: man rasp-design(5)%s%s\n", *text ? "" : "\n", scenes ? "; of scenes there is " : "",
               scenes ? scenes : "");
    }
    json_decref(schema);
    return key || all;
}

static const char *nearest_of_designs(const char *word, struct arena *a)
{
    json_t *schema = schema_design(a), *keys = json_object_get(schema, "properties"), *unused;
    const char **names = ARENA_TAKE(a, const char *, json_object_size(keys) + 2), *name;
    int n = 0;
    names[n++] = "design";
    json_object_foreach(keys, name, unused) names[n++] = arena_text(a, name);
    const char *nearest = text_nearest(word, names);
    json_decref(schema);
    return !nearest || nearest == names[0] ? nearest : arena_format(a, "%s of designs", nearest);
}

static void unknown(const char *word, const char **names, struct arena *a, struct err *e)
{
    const char *meant = endings(word, names, a);
    meant = meant ? meant : text_nearest(word, names);
    meant = meant ? meant : nearest_of_designs(word, a);
    if (meant)
        err_set(e, ERR_USAGE, "no key, section or scene file '%s'; did you mean %s?", word, meant);
    else
        err_set(e, ERR_USAGE, "no key, section or scene file '%s'; rasp explain shows every key", word);
}

static void print_man(const char *part, struct arena *a, struct err *e)
{
    if (!strcmp(part, "keys"))
        keys_man_print(stdout, a);
    else if (!strcmp(part, "columns"))
        for (const struct table_column *t = force_table_columns; t->name; t++)
            printf(".It Ic %s\n%c%s.\n", t->name, toupper((unsigned char)t->meaning[0]), t->meaning + 1);
    else
        err_set(e, ERR_USAGE, "--man: '%s' is neither keys nor columns", part);
}

static void print_json(json_t *o)
{
    json_dumpf(o, stdout, JSON_INDENT(2));
    putchar('\n');
    json_decref(o);
}

static void print_schema(const char *of, struct arena *a, struct err *e)
{
    if (!strcmp(of, "scene"))
        print_json(schema_scene(a));
    else if (!strcmp(of, "design"))
        print_json(schema_design(a));
    else
        err_set(e, ERR_USAGE, "--schema: '%s' is neither scene nor design", of);
}

static void explain_rows(const char *word, const char **names, struct arena *a, struct err *e)
{
    const char *path = word ? keys_text_plain(word) : "";
    json_t *rows = explain_json(path);
    if (json_array_size(rows) > 0) {
        print_json(rows);
        return;
    }
    json_decref(rows);
    json_t *schema = schema_design(a);
    bool of_designs = design_key(schema, word) != NULL;
    json_decref(schema);
    if (names_designs(word))
        err_set(e, ERR_USAGE, "designs' keys are in rasp explain --schema=design; --json is for scenes");
    else if (of_designs)
        err_set(e, ERR_USAGE, "%s is a key of designs, which rasp explain --schema=design has; --json is for scenes",
                word);
    else if (is_scene_file(word))
        err_set(e, ERR_USAGE, "--json is for keys and sections; an effective scene is YAML");
    else
        unknown(word, names, a, e);
}

static int explain_run(struct cmd_call *c, struct err *e)
{
    const char *word = c->args.n_operands ? c->args.operands[0] : NULL;
    const char **names = keys_text_names(c->arena);
    if (args_given(&c->args, "man"))
        print_man(args_value(&c->args, "man"), c->arena, e);
    else if (args_given(&c->args, "schema"))
        print_schema(args_value(&c->args, "schema"), c->arena, e);
    else if (args_given(&c->args, "json"))
        explain_rows(word, names, c->arena, e);
    else if (!word)
        keys_reference_print(stdout, c->arena);
    else if (explain_path(keys_text_plain(word), names, c->arena)) {
        /* Of scenes and of designs, each with a meaning of its own. */
        json_t *schema = schema_design(c->arena), *key = design_key(schema, word);
        if (key) {
            int n = printf("  designs   have one, too: ");
            wrap_print(stdout, design_text(key), n, "            ");
        }
        json_decref(schema);
    } else if (is_scene_file(word)) {
        struct scene s;
        if (cmd_read_scene(c, word, &s, e)) fputs(scene_write(&s, NULL, c->arena), stdout);
    } else if (!explain_design(word, names, c->arena))
        unknown(word, names, c->arena, e);
    return 0;
}

static const struct args_option options[] = {
    CMD_SCENE_OPTIONS,
    {"json", 'j', NULL, false, "print keys as a JSON array, an object each: all, one, or those of a section"},
    {"schema", 0, "scene|design", false,
     "print the JSON Schema of scenes, or of designs, for editors (installed as share/rasp/*.schema.json)"},
    {"man", 0, "keys|columns", false, "prints a part of man rasp-scene(5), in mdoc"},
    {0},
};

const struct command explain_command = {
    .name = "explain",
    .summary = "says what a key means, or all that a scene leaves unsaid",
    .does =
        "Without an operand: a scene with every key there is, explained. With a key or a section (motion.rate, motion, "
        "accuracy.oversampling): its type, unit, range, default and meaning. With a key of designs (factors, level, "
        "length): what it is for; with design: all of them; rasp-design(5) has the rest. With a scene file: the "
        "effective scene, in which every default and accuracy knob is written out; rendering it gives the same bytes.",
    .operands = "[KEY | SECTION | SCENE]",
    .least = 0,
    .most = 1,
    .options = options,
    .examples = "rasp explain > every-key.yaml\n"
                "rasp explain motion.rate\n"
                "rasp explain accuracy\n"
                "rasp explain --json motion\n"
                "rasp explain design\n"
                "rasp explain --schema=scene > scene.schema.json\n"
                "rasp explain scrape.yaml > effective.yaml\n",
    .run = explain_run,
};
