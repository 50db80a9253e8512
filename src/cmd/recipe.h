/* Commands that take a recipe (a YAML file of surface keys) or a scene. */
#ifndef CMD_RECIPE_H
#define CMD_RECIPE_H
#include "cmd/cmd.h"

/* Reads the file as a scene if it has the key of scenes, rasp, or includes one; else as a recipe, through a scene that names it and whose other keys
   are `rest` (YAML lines). --set and --seed count in both. Prints the scene's messages on stderr; ERR_INPUT, ERR_SCENE. */
bool recipe_read(struct cmd_call *c, const char *file, const char *rest, struct scene *s, struct err *e);

/* Is it a scene, rather than a recipe? ERR_INPUT */
bool recipe_is_scene(struct cmd_call *c, const char *file, bool *is, struct err *e);

/* A recipe's remark, `title` or `source`, as one line; NULL: it has none. The file has been read before. */
const char *recipe_remark(struct cmd_call *c, const char *file, const char *key);

#endif
