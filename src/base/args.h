/* A command line against a table of options, and the help text made from that table.

     --name, --name VALUE, --name=VALUE, -n, -n VALUE, -nVALUE, clusters of flags (-qf); options and operands in any
       order;
     `--` ends the options; `-` alone is an operand. A long name must be written out: an abbreviation is refused with a
       suggestion,
     so that an option added later never changes what an old script means. */
#ifndef BASE_ARGS_H
#define BASE_ARGS_H
#include <stdbool.h>
#include <stdio.h>

#include "base/arena.h"
#include "base/err.h"

struct args_option {
    const char *name;  /* long name without dashes; a table ends with name NULL        */
    char letter;       /* one-letter form, 0: none                                     */
    const char *value; /* what its value is called in the help; NULL: a flag           */
    bool many;         /* may be given several times (else a second one is an error)   */
    const char *help;  /* one sentence, without a full stop                            */
};

struct args {
    const struct args_option *options;
    const char ***values;  /* [options]: the values in the order given, then NULL      */
    int *given;            /* [options]: how often                                     */
    const char **operands; /* then NULL                                                */
    int n_operands;
    bool help; /* --help was met: the rest has not been looked at          */
};

/* Parses argv[0 .. argc-1] (without the program's name). `--help` (-h) is known to every table. ERR_USAGE. */
bool args_parse(struct args *g, const struct args_option *options, int argc, char *const *argv, struct arena *a,
                struct err *e);

/* Was it given? Its (last) value, or NULL. All its values, NULL-terminated, and how many. `name` must be in the table.
 */
bool args_given(const struct args *g, const char *name);
const char *args_value(const struct args *g, const char *name);
const char **args_values(const struct args *g, const char *name, int *n);

/* The value as a finite number in [low, high], a bare decimal number; *value is left alone when the option is not
 * given. ERR_USAGE */
bool args_number(const struct args *g, const char *name, const double range[2], double *value, struct err *e);
/* The same for a whole number. */
bool args_whole(const struct args *g, const char *name, const long range[2], long *value, struct err *e);
/* The same for one of the words (which end in NULL): its place among them. */
bool args_word(const struct args *g, const char *name, const char *const *words, int *chosen, struct err *e);

#endif
