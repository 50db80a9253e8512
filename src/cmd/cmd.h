/* What a subcommand is. foo.c in this folder exports `const struct command foo_command`; cmd_table in cmd.c lists them.

   main parses the options, calls run, and gives its return value as the exit code. When run leaves an error in *e, main
   prints "rasp foo: error: text" on stderr and the exit code is e->kind. Data goes to stdout (main closes and checks
   it), messages to stderr; stdin is never read. */
#ifndef CMD_CMD_H
#define CMD_CMD_H
#include "base/arena.h"
#include "base/args.h"
#include "base/err.h"
#include "scene/keys.h"
#include "scene/scene.h"
#include <stdbool.h>
#include <stdio.h>

struct messages; /* cmd/message.c */

struct cmd_call {
    struct args args;    /* options and operands, their number already checked */
    struct arena *arena; /* lives until the command ends                       */
    int argc;            /* the words behind the command's name, as they came  */
    char **argv;
    struct messages *messages; /* how errors and warnings are reported; NULL: as text, at once */
};

struct action; /* below */
struct batch_report;
struct keys_line;
struct set_plan;

struct command {
    const char *name;
    const char *group;    /* title of the group that begins with it in the list of commands; NULL: none    */
    const char *summary;  /* half a line for the list of commands, no full stop          */
    const char *does;     /* paragraphs for --help, parted by \n                          */
    const char *also;     /* what does not go into one literal of C (4095 characters); NULL */
    const char *operands; /* as in the usage line: "SCENE...", "A B"; "": none           */
    int least, most;      /* number of operands; most < 0: any number                    */
    const struct args_option *options; /* its own (cmd_options has the rest); ends with {0}; never NULL */
    const struct action *actions;      /* what the first operand may be, ends with name NULL; NULL: no such command */
    const char *examples;              /* shell lines, each ending in \n; a line may end in # comment */
    int (*run)(struct cmd_call *c, struct err *e); /* NULL: that of the action */
};

extern const struct command check_command, explain_command, new_command, render_command, plan_command, compare_command,
    plot_command, accuracy_command, analyse_command, surface_command, modes_command, completion_command, batch_command,
    batch_merge_command, export_command, golden_command, judge_command, decompose_command, play_command;

/* Rows for the option table of every command that reads scenes; cmd_read_scene heeds them. */
#define CMD_SCENE_OPTIONS                                                                                              \
    {"set", 's', "PATH=VALUE", true,                                                                                   \
     "sets a key of the scene, as in --set motion.rate='3 Hz'; may be repeated, the last wins"},                       \
    {                                                                                                                  \
        "seed", 0, "NUMBER", false, "sets the scene's seed; same as --set seed=NUMBER"                                 \
    }

/* Is it an option that every command and action has besides its own? */
bool cmd_shared(const struct args_option *o);

/* The command's options and those that every command has (cmd/message.h heeds them); ends with {0}. */
const struct args_option *cmd_options(const struct command *m, struct arena *a);

/* scene_read with the command line's --set and --seed. Prints the scene's messages on stderr; then *e holds their kind
 * and a summary. */
bool cmd_read_scene(struct cmd_call *c, const char *file, struct scene *s, struct err *e);

enum { CMD_ACTIONS = 8, CMD_ACTION_OPTIONS = 40 };

struct action {
    const char *name;
    const char *operands; /* what it takes, for a message                                          */
    int least, most;      /* number of operands behind the action's name; most < 0: any number     */
    const char
        *options[CMD_ACTION_OPTIONS]; /* those of the command's that it takes; fewer than that many end in NULL */
    int (*run)(struct cmd_call *c, struct err *e);
};

/* Runs the action that the first operand names, with the operands behind it; `table` ends with name NULL. An option
   that belongs to another action is refused. Exit codes as a command's run. ERR_USAGE */
int cmd_actions(const char *command, const struct action *table, struct cmd_call *c, struct err *e);

/* Reads the file as a scene if it has the key of scenes, rasp, or includes one; else as a recipe, through a scene that
   names it and whose other keys are `rest` (YAML lines). --set and --seed count in both. Prints the scene's messages on
   stderr; ERR_INPUT, ERR_SCENE. */
bool cmd_recipe_read(struct cmd_call *c, const char *file, const char *rest, struct scene *s, struct err *e);

/* Is it a scene, rather than a recipe? ERR_INPUT */
bool cmd_recipe_is_scene(struct cmd_call *c, const char *file, bool *is, struct err *e);

/* --NAME as one of two words: *value is 0 or 1. ERR_USAGE */
bool cmd_either(const struct cmd_call *c, const char *name, const char *const words[2], int *value, struct err *e);

/* --NAME with a unit, or bare in SI units. ERR_USAGE. Of both *value is left alone when the option is not given. */
bool cmd_quantity(const struct cmd_call *c, const char *name, enum key_dimension d, double *value, struct err *e);

/* A recipe's remark, `title` or `source`, as one line; NULL: it has none. The file has been read before. */
const char *cmd_recipe_remark(struct cmd_call *c, const char *file, const char *key);

/* Are they one file, under whatever names (same device and inode)? NULL: no file. */
bool cmd_same_file(const char *a, const char *b);

/* The output is not the input, under whatever name (NULL: none is read or written). what: "the
 * table"; cure: "-o OTHER.csv". ERR_CREATE */
bool cmd_spares(const char *output, const char *what, const char *input, const char *cure, struct err *e);

/* The whole of main: standard streams that are closed are filled, signals are set, `run` is called, stdout is closed.
 * Returns the exit code. */
int cmd_main(int (*run)(int argc, char **argv), int argc, char **argv);

/* Runs a command with the words behind its name, and tells of its error. Returns the exit code. */
int cmd_run(const struct command *m, int argc, char **argv);

/* Prints "rasp COMMAND: error: text" ("": of rasp itself) and returns the exit code. */
int cmd_complain(const char *command, const struct err *e);

/* The table of subcommands, in groups as the usage shows them. */
extern const struct command *const cmd_table[];   /* in the order of the usage, ends with NULL */
const struct command *cmd_find(const char *name); /* NULL: none */
const char *cmd_nearest(const char *word);        /* NULL: nothing like it */
void cmd_print(FILE *f);                          /* the usage with all commands */
void cmd_print_man(FILE *f);                      /* the commands and their options, in mdoc */
void cmd_print_help(const struct command *m);     /* --help: summary, examples, usage, options */

/* version.c: `rasp --version`, and with --verbose what a bug report needs. */
void version_print(bool verbose);
/* Prints if the words ask for no more than that: --version and, before or behind it, --verbose (-V, -v). False: they do
 * not. */
bool version_asked(int argc, char **argv);
/* "0.1.0", and of what state of the source the program was built: "f650ae05d2ab"; "unknown". */
extern const char version_number[], version_revision[];

/* render.c: a scene rendered into a folder of its own, which goes with the program or with render_scratch_end. Gives
   the WAV's name; warnings are printed. NULL: it has no sound, or the errors of a render. */
const char *render_scratch(struct cmd_call *c, const char *file, const char **folder, struct err *e);
void render_scratch_end(const char *folder, struct arena *a); /* NULL: there is none */

/* new.c: the starter scenes and designs. */
struct new_starter {
    const char *name, *summary;
    const char *about; /* the comment at its head */
    const char *text;  /* "KEY VALUE; #KEY VALUE; ": see new.c; NULL: it is a design */
};

extern const struct new_starter new_starters[]; /* the first is the default; ends with name NULL */

/* What a starter's text says, ends with path NULL; "-": a contact begins; ".": the contacts are over. */
struct keys_line *new_lines(const char *text, struct arena *a);

void new_print(FILE *f, const struct new_starter *s, struct arena *a);

/* batch.c: what `rasp batch` and `rasp check` say of a design. */
/* What is wrong with the design's own text, if anything is: *e then says that it cannot be used. */
void batch_message_unread(struct cmd_call *c, const char *file, const struct batch_report *r, struct err *e);

/* What renders will warn of, as far as it is known beforehand. */
void batch_message_warnings(struct cmd_call *c, const struct set_plan *p);

/* What is wrong with scenes and recordings of a set, found before any was rendered: each fault once. file: the design.
 */
void batch_message_faults(struct cmd_call *c, const char *command, const char *file, const struct set_plan *p);

/* How many threads do best, 1 to 256. */
int batch_cores(void);

/* --jobs: none: as many as there are cores. ERR_USAGE */
bool batch_threads(const struct cmd_call *c, int *threads, struct err *e);

/* The folder of -o, without a slash at its end. */
const char *batch_folder(struct arena *a, const char *given);

#endif
