/* What a shell needs to complete the words of a command line, from the tables of options and keys: parts of `rasp completion`. */
#ifndef CMD_COMPLETION_H
#define CMD_COMPLETION_H
#include <stdbool.h>
#include <stdio.h>

#include "base/arena.h"
#include "cmd/actions.h"
#include "cmd/cmd.h"

enum { COMPLETION_WORDS = 63, COMPLETION_SUFFIXES = 7 };

/* What may stand in a place; all false: anything, of which nothing is known. */
struct completion_place {
    bool files, folders;                           /* any file; folders                                           */
    bool settings, names;                          /* KEY=VALUE as of --set; what `rasp explain` takes            */
    const char *suffixes[COMPLETION_SUFFIXES + 1]; /* files that end so ("yaml"); NULL-terminated                 */
    const char *words[COMPLETION_WORDS + 1];       /* NULL-terminated                                             */
    bool list;                                     /* several of the words, with commas between                   */
};

/* The value of an option; the operands of a command, or of an action of it (NULL: of the command). */
struct completion_place completion_value(const struct args_option *o, struct arena *a);
struct completion_place completion_operands(const struct command *m, const struct action *action, struct arena *a);

/* Does the action (NULL: all do) take the option? */
bool completion_takes(const struct action *action, const struct args_option *o);

/* A key that --set takes, and its words if it has any. */
struct completion_setting {
    const char *path;
    const char *const *words; /* NULL-terminated; NULL: none */
};
const struct completion_setting *completion_settings(struct arena *a); /* ends with path NULL */

/* The text between single quotes, each character of `risky` with a backslash before it, each single quote as `quote` has it. */
const char *completion_quoted(const char *text, const char *risky, const char *quote, struct arena *a);

void completion_bash(FILE *f, struct arena *a);
void completion_zsh(FILE *f, struct arena *a);
void completion_fish(FILE *f, struct arena *a);

#endif
