/* design_print: see design.h. Columns are as wide as their widest cell, in characters. */
#include <string.h>

#include "base/text.h"
#include "batch/design.h"

struct table {
    const struct design *d;
    FILE *f;
    const char *const *states; /* NULL: none */
    int *width;   /* [columns] */
    bool replicates, recordings;
};

enum { COLUMN_NAME, COLUMN_REPLICATE, COLUMN_SEED, COLUMN_RECORDING, COLUMN_STATE, COLUMN_FACTORS };

static bool shown(const struct table *t, int column)
{
    return (column != COLUMN_REPLICATE || t->replicates) && (column != COLUMN_RECORDING || t->recordings) && (column != COLUMN_STATE || t->states);
}

/* The cell's text, row -1 the head; `number` is room for numbers. */
static const char *cell(const struct table *t, int row, int column, char number[24])
{
    static const char *const heads[] = {"name", "replicate", "seed", "recording", "state"};
    const struct design_stimulus *s = row < 0 ? NULL : &t->d->stimuli[row];
    if (column >= COLUMN_FACTORS)
        return s ? design_label(t->d, row, column - COLUMN_FACTORS) : t->d->factors[column - COLUMN_FACTORS].name;
    if (!s || column == COLUMN_NAME)
        return s ? s->name : heads[column];
    if (column == COLUMN_RECORDING)
        return s->recording ? s->recording : "n/a";
    if (column == COLUMN_STATE)
        return t->states ? t->states[row] : "";
    if (s->recording)
        return "n/a";
    snprintf(number, 24, "%llu", column == COLUMN_SEED ? (unsigned long long)s->seed : (unsigned long long)s->replicate);
    return number;
}

static int width_of(const char *text)
{
    return (int)text_utf8_count(text, strlen(text));
}

static void widths(struct table *t)
{
    char number[24];
    for (int row = -1; row < t->d->n_stimuli; row++)
        for (int c = 0; c < COLUMN_FACTORS + t->d->n_factors; c++) {
            int n = width_of(cell(t, row, c, number));
            t->width[c] = n > t->width[c] ? n : t->width[c];
        }
}

static void put(const struct table *t, int row, int column, bool last)
{
    char number[24];
    const char *text = cell(t, row, column, number);
    fprintf(t->f, "  %s%*s", text, last ? 0 : t->width[column] - width_of(text), "");
}

/* Name and labels first, then what follows from them. */
static void put_row(const struct table *t, int row, int digits)
{
    int last = shown(t, COLUMN_STATE) ? COLUMN_STATE : shown(t, COLUMN_RECORDING) ? COLUMN_RECORDING : COLUMN_SEED;
    if (row < 0)
        fprintf(t->f, "%*s", digits, "#");
    else
        fprintf(t->f, "%*d", digits, row + 1);
    put(t, row, COLUMN_NAME, false);
    for (int f = 0; f < t->d->n_factors; f++)
        put(t, row, COLUMN_FACTORS + f, false);
    for (int c = COLUMN_REPLICATE; c <= last; c++)
        if (shown(t, c))
            put(t, row, c, c == last);
    fputc('\n', t->f);
}

void design_print(const struct design *d, const bool *mine, const char *const *states, FILE *f)
{
    struct arena *a = arena_open();
    struct table t = {.d = d, .f = f, .states = states, .width = ARENA_TAKE(a, int, COLUMN_FACTORS + d->n_factors), .replicates = d->replicates > 1};
    int digits = snprintf(NULL, 0, "%d", d->n_stimuli);
    for (int i = 0; i < d->n_stimuli; i++)
        t.recordings = t.recordings || d->stimuli[i].recording;
    widths(&t);
    for (int row = -1; row < d->n_stimuli; row++)
        if (row < 0 || !mine || mine[row])
            put_row(&t, row, digits);
    arena_close(a);
}
