/* rasp check: what can be known to be wrong with a scene before anything is computed. */
#include <jansson.h>
#include <stdio.h>

#include "base/text.h"
#include "batch/design.h"
#include "cmd/check_design.h"
#include "cmd/cmd.h"
#include "cmd/tell.h"
#include "pipeline/plan_scene.h"
#include "pipeline/promise.h"
#include "scene/scene_places.h"

/* remark: of a design without fault; NULL: none. */
static bool check_scene(struct cmd_call *c, const char *file, const char **remark, struct err *e)
{
    struct scene s, kept;
    const char **warnings = NULL;
    if (design_is(file))
        return check_design(c, file, remark, e);
    if (!cmd_read_scene(c, file, &s, e))
        return false;
    if (!promise_keep(&s, c->arena, &kept, NULL, e) || !plan_scene(&kept, c->arena, &warnings, e))
        return scene_places_tell(&s, e);
    for (int i = 0; warnings[i]; i++)
        tell_warning(c, file, warnings[i]);
    return true;
}

/* The scene's row of --json. */
static json_t *row(const char *file, const struct err *e, json_t *errors)
{
    json_t *o = json_object(), *name = json_string(file);
    json_object_set_new(o, "file", name ? name : json_null());
    json_object_set_new(o, "ok", json_boolean(e->kind == ERR_NONE));
    json_object_set_new(o, "code", json_integer((int)e->kind));
    json_object_set_new(o, "errors", errors);
    return o;
}

static void check_told(struct cmd_call *c, const char *file, json_t *rows, struct err *e)
{
    const char *remark = NULL;
    if (rows)
        tell_keep(c);
    if (!check_scene(c, file, &remark, e))
        tell_error(c, "check", e);
    else if (!rows)
        printf("%s: ok\n", text_shown(c->arena, file));
    if (remark && !rows)
        printf("%s: %s\n", text_shown(c->arena, file), remark);
    if (rows)
        json_array_append_new(rows, row(text_shown(c->arena, file), e, tell_kept(c)));
}

static int check_run(struct cmd_call *c, struct err *e)
{
    int worst = 0;
    json_t *rows = args_given(&c->args, "json") ? json_array() : NULL;
    (void)e;
    for (int i = 0; i < c->args.n_operands; i++) {
        struct err mine = {0};
        check_told(c, c->args.operands[i], rows, &mine);
        worst = (int)mine.kind > worst ? (int)mine.kind : worst;
    }
    if (rows) {
        json_dumpf(rows, stdout, JSON_INDENT(2));
        putchar('\n');
    }
    json_decref(rows);
    return worst;
}

static const struct args_option options[] = {
    CMD_SCENE_OPTIONS,
    {"json", 'j', NULL, false, "print an array with a row for each scene on standard output: file, ok, exit code, errors as of --diagnostics=json"},
    {0},
};

const struct command check_command = {
    .name = "check",
    .summary = "finds what is wrong with scenes, without rendering them",
    .does = "Reads each scene and says all that is wrong with its text, each fault with its line: unknown keys, wrong units, values out of range or at odds "
            "with each other, columns that are not there, nothing to compute. If nothing is, then the first that is wrong with the rest: files that are "
            "missing, damaged or have changed, a motion that leaves them. "
            "Only what shows in the sound itself, such as clipping, it cannot know. "
            "Of a design (rasp-design(5)) the scene of every stimulus is read so, and a fault that many have is told once. "
            "A scene or design without fault is reported on standard output as ok. The exit code is the worst of all.",
    .operands = "SCENE|DESIGN...",
    .least = 1,
    .most = -1,
    .options = options,
    .examples = "rasp check scrape.yaml\n"
                "rasp check scenes/*.yaml\n"
                "rasp check --diagnostics=json scrape.yaml   # for editors and scripts\n"
                "rasp check --set motion.rate='4 Hz' scrape.yaml\n",
    .run = check_run,
};
