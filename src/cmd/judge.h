/* What the actions of `rasp judge` share: tables of answers, the report, and the papers' numbers beside ours. */
#ifndef CMD_JUDGE_H
#define CMD_JUDGE_H
#include "analysis/anova.h"
#include "cmd/cmd.h"
#include "cmd/report.h"
#include "file/csv.h"

struct judge_figure { /* what a row of --paper may have, too */
    const char *key;
    double value;
};

struct judge {
    struct cmd_call *call;
    struct arena *arena;
    struct report report;
    struct judge_figure *figures;
    int n_figures;
    struct csv paper; /* names NULL: not given */
    const char *item;
};

/* A figure by the name that it has in the papers' table: "F(size)". */
void judge_figure(struct judge *j, double value, const char *format, ...) __attribute__((format(printf, 3, 4)));

/* The words of a text, with a character between. */
const char **judge_split(struct arena *a, const char *text, char between, int *n);

/* --NAME as words with commas between; *n 0: not given. ERR_USAGE: one is empty, or comes twice. */
const char **judge_words(const struct cmd_call *c, const char *name, int *n, struct err *e);

/* The place of a word among n; -1: none. */
int judge_place(const char *const *words, int n, const char *word);

/* The same, where a word that is not among them is put at the end. */
int judge_add(struct arena *a, const char ***words, int *n, const char *word);

/* ------------------------------------------------------------------ judge_table.c */

enum { JUDGE_LEVELS = 10000, JUDGE_CLASSES = 100, JUDGE_COMPARED = 100 /* means, by Tukey's method */ };

struct judge_factor { /* a column whose cells are words */
    const char *name;
    int column;          /* -1: it is not there */
    const char **levels; /* numbers by size, else in the order in which they come */
    int n, *of_row;      /* of_row [rows]: which level it is */
};

/* A table of answers, also as webMUSHRA writes it, less the rows of training where it is from a page of `rasp export`
   (columns trial_id, training), whose rows then are by trial; the report says how many. As csv_table_read. */
bool judge_table_answers(struct judge *j, const char *file, struct csv *t, struct err *e);

/* The column of that role; `--column ROLE=NAME` names another. -1: it is not there (ERR_SCENE if it must be). */
int judge_table_column(const struct judge *j, const struct csv *t, const char *role, bool must, struct err *e);

/* ERR_SCENE: an empty cell, more than JUDGE_LEVELS levels. column < 0: one level, "all". */
bool judge_table_factor(const struct csv *t, int column, struct arena *a, struct judge_factor *f, struct err *e);

/* The factor of a role's column. */
bool judge_table_role(const struct judge *j, const struct csv *t, const char *role, bool must, struct judge_factor *f,
                      struct err *e);

struct judge_choices { /* confusion matrices */
    const char *file;
    int conditions, classes;
    const char **condition, **class_name;
    double *cell; /* [conditions][classes played][classes chosen]: answers, or shares */
    bool counted; /* answers                                                         */
    int people;   /* listeners; 0: not known                                          */
    const char **person;
    double *right, *asked; /* [people][conditions] of answers                                  */
};

/* A table of answers (participant, condition, played, chosen) or of matrices (condition, played, a column a class);
   --classes, --groups. ERR_INPUT, ERR_SCENE, ERR_USAGE */
bool judge_table_choices(struct judge *j, const char *file, struct judge_choices *m, struct err *e);

/* Takes memory for the cells of so many conditions and classes. ERR_SCENE: not 2 to JUDGE_CLASSES classes. */
bool judge_table_open(struct judge *j, struct judge_choices *m, struct err *e);

/* ERR_SCENE: a class was never played in a condition. */
bool judge_table_whole(const struct judge_choices *m, struct err *e);

/* The cells of what was played in a condition. */
double *judge_table_row(const struct judge_choices *m, int condition, int played);

/* Of the condition, a matrix of shares, in the arena. */
const double *judge_table_shares(const struct judge_choices *m, int condition, struct arena *a);

/* Matrices as a table, to -o FILE if that is given. ERR_CREATE, ERR_IO */
bool judge_table_write(struct judge *j, const struct judge_choices *m, struct err *e);

/* ------------------------------------------------------------------ the actions: what is reported is printed at their
 * end, if nothing failed */

bool judge_choices_similarity(struct judge *j, struct err *e);
bool judge_choices_run(struct judge *j, struct err *e);
/* Matrices, their intervals, and with --reference how the other conditions compare with it. ERR_USAGE, ERR_SCENE */
bool judge_choices_report(struct judge *j, const struct judge_choices *m, struct err *e);
bool judge_ratings_run(struct judge *j, struct err *e);
bool judge_ratings_pairs(struct judge *j, struct err *e);
bool judge_listen_run(struct judge *j, struct err *e);

/* ------------------------------------------------------------------ judge_webmushra.c */

/* A table of webMUSHRA's service (it has session_test_id and texts) as a page of `rasp export` gives it, by --design.
   ERR_USAGE, ERR_INPUT, ERR_SCENE */
bool judge_webmushra(struct judge *j, struct csv *t, struct err *e);

#endif
