/* rasp judge ACTION: what listeners, or a program in their place, made of a set of sounds; and the papers' numbers
   beside it. */
#include "cmd/judge.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"

int judge_place(const char *const *words, int n, const char *word)
{
    int i = 0;
    while (i < n && strcmp(words[i], word) != 0)
        i++;
    return i < n ? i : -1;
}

int judge_add(struct arena *a, const char ***words, int *n, const char *word)
{
    int at = judge_place(*words, *n, word);
    if (at >= 0) return at;
    *words = arena_more(a, *words, *n, sizeof **words);
    (*words)[*n] = word;
    return (*n)++;
}

const char **judge_split(struct arena *a, const char *text, char between, int *n)
{
    const char **words = NULL, separator[] = {between, '\0'};
    *n = 0;
    for (char *rest = arena_text(a, text), *word; (word = strsep(&rest, separator)); ++*n) {
        words = arena_more(a, words, *n, sizeof *words);
        words[*n] = word;
    }
    return words;
}

const char **judge_words(const struct cmd_call *c, const char *name, int *n, struct err *e)
{
    const char *given = args_value(&c->args, name), **words = given ? judge_split(c->arena, given, ',', n) : NULL;
    if (!given) *n = 0;
    for (int i = 0; i < *n; i++)
        if (!*words[i] || judge_place(words, i, words[i]) >= 0)
            err_set(e, ERR_USAGE, "--%s: '%s': %s", name, given,
                    *words[i] ? "a word comes twice" : "a word is missing");
    return words;
}

/* ------------------------------------------------------------------ the papers' numbers */

void judge_figure(struct judge *j, double value, const char *format, ...)
{
    char key[512];
    va_list list;
    va_start(list, format);
    vsnprintf(key, sizeof key, format, list);
    va_end(list);
    if (!j->item) return;
    j->figures = arena_more(j->arena, j->figures, j->n_figures, sizeof *j->figures);
    j->figures[j->n_figures++] = (struct judge_figure){arena_text(j->arena, key), value};
}

enum { ITEM, CONDITION, VALUE, DEVIATION, SOURCE, COLUMNS };
static const char *const columns[COLUMNS] = {"item", "condition", "value", "deviation", "source"};

static const char *paper_cell(const struct judge *j, size_t row, int column)
{
    return j->paper.cells[row * j->paper.columns + (size_t)csv_column(&j->paper, columns[column])];
}

static bool paper_open(struct judge *j, struct err *e)
{
    const char *file = args_value(&j->call->args, "paper");
    j->item = args_value(&j->call->args, "item");
    if (!file != !j->item) return err_set(e, ERR_USAGE, "--paper FILE and --item ITEM go together");
    if (!file) return true;
    if (!csv_read(file, j->arena, &j->paper, e)) return false;
    for (int k = 0; k < COLUMNS; k++)
        if (csv_column(&j->paper, columns[k]) < 0)
            return err_set(e, ERR_SCENE, "%s: there is no column '%s'", file, columns[k]);
    for (size_t i = 0; i < j->paper.rows; i++)
        if (!strcmp(paper_cell(j, i, ITEM), j->item)) return true;
    return err_set(e, ERR_USAGE, "--item: %s has no item '%s'", file, j->item);
}

/* Each row of the item beside the figure of that name; a row that has none is reported. */
static void paper_report(struct judge *j)
{
    struct report *r = &j->report;
    if (!j->item) return;
    report_text(r, "\n%s: the paper's numbers and ours\n", j->item);
    report_set(r, "item:s paper:[", j->item);
    for (size_t i = 0; i < j->paper.rows; i++) {
        const char *figure = paper_cell(j, i, CONDITION), *value = paper_cell(j, i, VALUE),
                   *deviation = paper_cell(j, i, DEVIATION), *source = paper_cell(j, i, SOURCE), *text = "none";
        double ours = NAN;
        if (strcmp(paper_cell(j, i, ITEM), j->item) != 0) continue;
        for (int k = 0; k < j->n_figures; k++)
            if (!strcmp(j->figures[k].key, figure)) text = arena_format(j->arena, "%.4g", ours = j->figures[k].value);
        report_text(r, "  %-40s paper %-18s ours %-9s %s\n", figure,
                    arena_format(j->arena, "%s%s%s", value, *deviation ? " +- " : "", deviation), text, source);
        report_set(r, ":{ figure:s paper:s deviation:e ours:n source:s }", figure, value, deviation, ours, source);
    }
    report_end(r);
}

/* ------------------------------------------------------------------ running */

/* --column ROLE=NAME has a role that the action knows. */
static bool roles_check(const struct judge *j, const char *const *roles, struct err *e)
{
    const char **given = args_values(&j->call->args, "column", &(int){0}), *all = "";
    for (int k = 0; roles[k]; k++)
        all = arena_format(j->arena, "%s%s%s", all, k ? ", " : "", roles[k]);
    for (; given && *given && !e->kind; given++) {
        const char *role = arena_format(j->arena, "%.*s", (int)strcspn(*given, "="), *given);
        if (!strchr(*given, '=') || !text_is_one(role, roles))
            err_set(e, ERR_USAGE, "--column %s: write ROLE=NAME, where ROLE is one of: %s", *given, all);
    }
    return !e->kind;
}

/* What is printed waits until nothing can fail any more. */
static int act(struct cmd_call *c, bool (*run)(struct judge *j, struct err *e), const char *const *roles, struct err *e)
{
    struct judge j = {.call = c, .arena = c->arena};
    char *text = NULL;
    size_t n = 0;
    FILE *out = open_memstream(&text, &n);
    if (!out) memory_out("the report");
    j.report = report_open(out, args_given(&c->args, "json"));
    if (roles_check(&j, roles, e) && paper_open(&j, e) && run(&j, e)) {
        paper_report(&j);
        report_close(&j.report, 0, e);
    } else if (j.report.json)
        json_decref(j.report.open.at[0]);
    if (fclose(out) != 0) memory_out("the report");
    if (!e->kind) fwrite(text, 1, n, stdout);
    free(text);
    return (int)e->kind;
}

/* An action, and the roles that columns have in it. */
#define ACT(name, run, ...)                                                                                            \
    static int name(struct cmd_call *c, struct err *e)                                                                 \
    {                                                                                                                  \
        return act(c, run, (const char *const[]){__VA_ARGS__, NULL}, e);                                               \
    }
ACT(similarity, judge_choices_similarity, "participant", "condition", "played", "chosen")
ACT(choices, judge_choices_run, "participant", "condition", "played", "chosen")
ACT(ratings, judge_ratings_run, "participant", "rating")
ACT(pairs, judge_ratings_pairs, "participant", "a", "b", "answer", "set", "condition")
ACT(listen, judge_listen_run, "condition")

static const struct action actions[] = {
    {"choices",
     "ANSWERS",
     1,
     1,
     {"column", "design", "classes", "groups", "reference", "confidence", "simultaneous", "bound", "draws", "seed",
      "output", "force", "paper", "item", "json"},
     choices},
    {"similarity",
     "TABLE...",
     1,
     -1,
     {"column", "design", "classes", "groups", "reference", "paper", "item", "json"},
     similarity},
    {"ratings", "RATINGS", 1, 1, {"column", "design", "factors", "tukey", "paper", "item", "json"}, ratings},
    {"pairs", "ANSWERS", 1, 1, {"column", "paper", "item", "json"}, pairs},
    {"listen",
     "SET",
     1,
     1,
     {"templates", "where", "factor", "by", "spread", "column", "reference", "output", "force", "paper", "item",
      "json"},
     listen},
    {NULL, NULL, 0, 0, {NULL}, NULL},
};

static const struct args_option options[] = {
    {"column", 'c', "ROLE=NAME", true,
     "which column is the participant, condition, played, chosen, rating, a, b, answer or set; default: the one called "
     "so"},
    {"design", 0, "DESIGN", false,
     "choices, similarity, ratings: of tables of webMUSHRA's service: the design that was exported"},
    {"classes", 0, "WORD,...", false,
     "choices, similarity: all that could be chosen, in this order; default: all that was played"},
    {"groups", 0, "A+B,...", false, "choices, similarity: these classes count as one"},
    {"reference", 'r', "CONDITION", false, "the condition that the others are compared with, as recordings"},
    {"confidence", 0, "SHARE", false, "choices: of the intervals (default 0.95)"},
    {"simultaneous", 0, NULL, false, "choices: intervals of shares hold for all cells of a matrix at once"},
    {"bound", 0, "POINTS", false,
     "choices: percentage points within which two conditions count as equivalent (default 10)"},
    {"draws", 0, "N", false, "choices: changes of sign that are drawn where not all can be tried (default 10000)"},
    {"seed", 0, "NUMBER", false, "choices: of these draws (default 1)"},
    {"factors", 0, "COLUMN,...", false,
     "ratings: the columns that are factors; default: all but participant and rating, or the design's"},
    {"tukey", 0, "FACTOR:...", true,
     "ratings: compares the means of a factor's levels, or of combinations of levels; 100 means at most"},
    {"templates", 't', "SET", true,
     "listen: sounds whose class is known, a folder of rasp batch or a table with file_name"},
    {"where", 0, "COLUMN=VALUE", true, "listen: only these of the templates"},
    {"factor", 0, "COLUMN", false, "listen: the classes (default motion)"},
    {"by", 0, "motion|material", false,
     "listen: what is compared: how level and brightness change over time (the default), or how fast a sound fades and "
     "how bright it is"},
    {"spread", 0, "X", false, "listen: how far apart takes of one class are; default: as the templates' are"},
    {"output", 'o', "FILE.csv", false, "choices, listen: writes the matrices, too"},
    {"force", 'f', NULL, false, "replaces that file if it exists"},
    {"paper", 0, "FILE.csv", false,
     "a table of printed numbers (item, condition, value, deviation, source), shown beside ours"},
    {"item", 0, "ITEM", false, "which of its items"},
    {"json", 'j', NULL, false, "prints the figures as one JSON object; null stands for one that is not there"},
    {0}};

const struct command judge_command = {
    .name = "judge",
    .summary = "what listeners made of the sounds: confusions, ratings, pairs",
    .does = "What rasp judge choices ANSWERS gives is confusion matrices of forced choices, with Wilson's intervals. "
            "A table has a row for each answer: columns participant, condition, played, chosen, of which the first "
            "two may be missing. Or it is matrices already: condition, played, and a column for each class that could "
            "be chosen, with answers, shares, or percent. A first line '# cells: answers' (or shares, percent) says "
            "which; else whole numbers are answers. Rows for training in the tables that rasp export's pages give do "
            "not count. The tables of webMUSHRA's service (mushra.csv, lms.csv, lss.csv) are taken with --design.\n"
            "With --reference each other condition is compared with it, by equation 14 of Agarwal and others (2021). "
            "The share of right answers is compared by a permutation test over listeners, and by two one-sided t "
            "tests of equivalence. Each row is compared by chi-squared, which takes answers as independent.\n"
            "What rasp judge similarity TABLE... gives is equation 14 by both norms, of all conditions, against the "
            "first table's (or its --reference): 1 is the same matrix. The paper does not say which norm. The "
            "spectral one comes first.\n"
            "What rasp judge ratings RATINGS gives is means, standard errors, and analysis of variance with repeated "
            "measures. The table has participant, rating and up to six factors. Everybody rates every combination "
            "equally often, and several ratings of one are averaged. The column epsilon is Greenhouse and Geisser's.",
    .also = "What rasp judge pairs ANSWERS gives is scores of paired comparisons, as of Conan and others (2014). The "
            "table has participant, a, b and answer (A>B, A=B or B>A); set and condition may be missing. Each "
            "condition, which may have sounds of its own, has an analysis of variance and Tukey's comparisons.\n"
            "In rasp judge listen SET --templates SET a program listens. It compares each sound of a set (rasp batch) "
            "with templates whose class it knows. It gives shares of answers: exp(-d/(2 spread)), d the distance to "
            "the nearest template of a class. By motion, it compares level and brightness over time, each without its "
            "mean. By material (--by material --factor material), it compares how fast a struck object fades and how "
            "bright it is, in octaves. A template among the sounds is judged without itself. It is no model of a "
            "person.\n"
            "Tables of several listeners are joined by awk 'NR == 1 || FNR > 1' answers_p*.csv. What is missing, "
            "unbalanced, unknown or there twice is an error with its place. Nothing else is left out or filled in.",
    .operands = "ACTION FILE...",
    .least = 1,
    .most = -1,
    .options = options,
    .actions = actions,
    .examples = "rasp judge choices answers.csv --reference recorded -o matrices.csv\n"
                "rasp judge choices answers.csv --groups wood+plastic,porcelain+glass\n"
                "rasp judge similarity matrices.csv --reference recorded\n"
                "rasp judge ratings ratings.csv --factors kappa,mu --tukey kappa:mu\n"
                "rasp judge pairs pairs.csv --paper evidence/papers.csv --item 002_VI\n"
                "rasp judge listen out/experiment_2 --templates out/takes --where condition=full\n",
};
