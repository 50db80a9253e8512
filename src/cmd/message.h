/* How errors and warnings are reported: as text, or, with --diagnostics=json, as JSON on stderr, one object a line:

     {"severity": "error", "file": "scene.yaml", "line": 12, "column": 9, "width": 3, "message": "...", "help": "...",
   "code": 65}

   null stands for what is not known or there is none of; lines and columns count from 1, columns and width in
   characters; code is the exit code that the error alone would make, null of a warning. What an option of the command
   line says wrongly has "option", --set motion.rate say, and no file. What is about one stimulus of a set has
   "stimulus", its name, a warning of several "stimuli". A file that another names has "named_at", the places of its
   name, the nearest first. A warning of several scenes has "files". What is wrong with the command line itself has no
   file; where no command is known yet it is text. */
#ifndef CMD_MESSAGE_H
#define CMD_MESSAGE_H
#include <jansson.h>

#include "base/arena.h"
#include "base/diag.h"
#include "cmd/cmd.h"
#include <stdbool.h>
#include <stdio.h>

/* Heeds --diagnostics. ERR_USAGE */
bool message_begin(struct cmd_call *c, struct err *e);

/* As though --diagnostics=json had been read already: what is wrong with the command line is reported so, too. */
void message_as_json(struct cmd_call *c);

/* The errors in a scene's text; messages: the same as text. */
void message_scene(struct cmd_call *c, const struct diag *d, const char *messages, enum err_kind kind);

/* An error by itself, in text "rasp COMMAND: error: ...". After message_scene, JSON has nothing to add. */
void message_error(struct cmd_call *c, const char *command, const struct err *e);

/* The error of one stimulus of a set, in text "rasp COMMAND: error: STIMULUS: text", in JSON with the key "stimulus".
   Its place is the text's beginning, "design.yaml:3:7: ..."; where there is none, JSON says `file` (NULL: unknown). */
void message_stimulus(struct cmd_call *c, const char *command, const char *stimulus, const char *file,
                      const struct err *e);

/* A warning about a file. Where several scenes are processed (message_group) it waits, so that one that many scenes
   have is reported once, at the end; in text also one that they have with other numbers, which are the first one's. */
void message_warning(struct cmd_call *c, const char *file, const char *text);
/* The same about a stimulus of a set: in JSON the name is its "stimulus", of several "stimuli". */
void message_stimulus_warning(struct cmd_call *c, const char *stimulus, const char *text);
/* The same about what a command does, at once: "rasp COMMAND: warning: text". */
void message_remark(struct cmd_call *c, const char *command, const char *text);
void message_group(struct cmd_call *c);
void message_end(struct cmd_call *c);

/* From here on errors are collected, as an array of objects as above, until they are taken. */
void message_collect(struct cmd_call *c);
json_t *message_collected(struct cmd_call *c);

/* Prints messages as base/diag.h lays them out, in colours if they are wanted: the words error: and warning:, the line
 * of carets, help:. */
void message_paint(FILE *f, const char *lines);

struct warning {
    const char *text, **files; /* of the first; files [n] that have it */
    int n;
    bool numbers, other;  /* some have it with other numbers; so has the last */
    bool stimuli;         /* files are names of stimuli of a set; the caller's */
    struct warning *next; /* in the order they came; NULL: last   */
};

/* A warning about a file goes to what tells the same already; else, unless only exactly the same counts, to what tells
   it of other files with other numbers (those that stand by themselves: not of names); else to the end. Texts are not
   copied. What tells it. */
struct warning *message_add(struct warning **all, const char *file, const char *text, bool exact, struct arena *a);

#endif
