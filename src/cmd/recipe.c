/* Reading a recipe of surface keys, or a scene: see recipe.h. */
#include "cmd/recipe.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "cmd/tell.h"
#include "file/yaml_bytes.h"
#include "file/yaml_parse.h"
#include "scene/scene_read.h"

bool recipe_is_scene(struct cmd_call *c, const char *file, bool *is, struct err *e)
{
    size_t size;
    const char *text = yaml_bytes_text(file, c->arena, &size);
    *is = false;
    if (!text)
        return err_set(e, errno == EINTR ? ERR_INTERRUPTED : ERR_INPUT, "%s: %s", file, strerror(errno));
    for (const char *line = text; line && !*is; line = strchr(line, '\n')) {
        line += *line == '\n';
        *is = !strncmp(line, "rasp:", 5) || !strncmp(line, "include:", 8);
    }
    return true;
}

/* A double-quoted YAML string. */
static const char *quoted(struct arena *a, const char *text)
{
    char *out = arena_take(a, 4 * strlen(text) + 4, 1), *p = out;
    *p++ = '"';
    for (; *text; text++) {
        bool plain = (unsigned char)*text >= ' ' && *text != 0x7f && *text != '"' && *text != '\\';
        p += snprintf(p, 5, plain ? "%c" : "\\x%02x", (unsigned char)*text);
    }
    *p++ = '"';
    *p = '\0';
    return out;
}

static bool read_recipe(struct cmd_call *c, const char *file, const char *rest, struct scene *s, struct err *e)
{
    int n;
    const char **set = args_values(&c->args, "set", &n), *messages = "";
    const char *text = arena_format(c->arena, "rasp: 1\nsurface: {recipe: %s}\n%s", quoted(c->arena, file), rest);
    struct scene_overrides over = {.set = set, .n = n, .seed = args_value(&c->args, "seed")};
    struct err cause = {0};
    if (scene_read_made(text, file, &over, c->arena, s, &messages, &cause))
        return true;
    tell_scene(c, s->diag, messages, cause.kind);
    return err_set(e, cause.kind, "%s %s", file, cause.kind == ERR_SCENE ? "is not a valid recipe" : "cannot be read");
}

bool recipe_read(struct cmd_call *c, const char *file, const char *rest, struct scene *s, struct err *e)
{
    bool scene;
    if (!recipe_is_scene(c, file, &scene, e))
        return false;
    return scene ? cmd_read_scene(c, file, s, e) : read_recipe(c, file, rest, s, e);
}

const char *recipe_remark(struct cmd_call *c, const char *file, const char *key)
{
    struct yaml *y = yaml_open(c->arena);
    const struct diag_source *source = yaml_bytes_read(y, file, (struct diag_place){0});
    const struct yaml_node *map = source ? yaml_parse(y, source) : NULL, *value = map && map->kind == YAML_MAP ? yaml_get(map, key) : NULL;
    if (!value || value->kind != YAML_SCALAR)
        return NULL;
    char *line = arena_text(c->arena, value->text);
    for (char *p = line; *p; p++)
        *p = *p == '\n' ? ' ' : *p;
    return line;
}
