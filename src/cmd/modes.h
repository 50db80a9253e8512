/* Parts of `rasp modes`: each action is a file of its own, called with its operands only. */
#ifndef CMD_MODES_H
#define CMD_MODES_H
#include <stdio.h>

#include "cmd/cmd.h"
#include "response/object.h"

/* --NAME as `count` lengths with commas between, each with a unit or bare in metres; x is left alone when the option is not given. ERR_USAGE */
struct modes_lengths {
    const char *name, *form; /* "X,Y" */
    int count;
};
bool modes_lengths(struct cmd_call *c, const struct modes_lengths *want, double *x, struct err *e);

/* What a body of the operand rings with: the operand is a scene, or a recipe of surface keys. *key: "surface", "scraper" or "ball". */
struct modes_body {
    struct scene scene;
    const struct response *response;
    const char *key;
    const char *title, *remark; /* the recipe's title and source, the scene's title; NULL: none */
};
bool modes_body_read(struct cmd_call *c, const char *file, struct modes_body *b, struct err *e);

/* The object of closed form that it is, with all modes below --top. *note: how far its theory reaches, NULL: nothing to say. ERR_SCENE: it is none. */
bool modes_body_object(struct cmd_call *c, const struct modes_body *b, struct object *o, const char **note, struct err *e);

/* --line and --places, --grid, --at, else what suits the shape: places in the object's coordinates. ERR_USAGE, ERR_SCENE: off the object. */
struct modes_places {
    int n, left_out;       /* left_out: of a grid, those off the object */
    double (*xy)[2];       /* m */
};
bool modes_body_places(struct cmd_call *c, const struct modes_body *b, const struct object *o, struct modes_places *p, struct err *e);

/* "# key: value" lines that say what the object is: object, material, damping, holds. */
void modes_describe(FILE *f, const struct object *o);

/* The actions; exit codes as a command's run. */
int modes_object_run(struct cmd_call *c, struct err *e);
int modes_list_run(struct cmd_call *c, struct err *e);

#endif
