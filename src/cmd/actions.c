/* See actions.h. */
#include "cmd/actions.h"

#include <string.h>

#include "base/text.h"

static int count(const struct action *table)
{
    int n = 0;
    while (table[n].name)
        n++;
    return n;
}

/* "info, convert or synth" */
static const char *all_names(const struct action *table, struct arena *a)
{
    const char *list = table[0].name;
    for (int i = 1, n = count(table); i < n; i++)
        list = arena_format(a, "%s%s%s", list, i + 1 < n ? ", " : " or ", table[i].name);
    return list;
}

static const struct action *find(const char *command, const struct action *table, struct cmd_call *c, struct err *e)
{
    const char *word = c->args.operands[0], **names = ARENA_TAKE(c->arena, const char *, count(table) + 1);
    for (int i = 0; table[i].name; i++) {
        names[i] = table[i].name;
        if (!strcmp(word, table[i].name))
            return &table[i];
    }
    const char *meant = text_nearest(word, names);
    if (meant)
        err_set(e, ERR_USAGE, "no action '%s'; did you mean '%s'?", word, meant);
    else
        err_set(e, ERR_USAGE, "no action '%s': write rasp %s %s", word, command, all_names(table, c->arena));
    return NULL;
}

/* The table of options is shared: one that belongs to another action is refused. */
static bool check_options(const char *command, const struct action *action, const struct args *g, struct err *e)
{
    for (const struct args_option *o = g->options; o->name; o++) {
        bool known = cmd_shared(o);
        for (int i = 0; i < ACTIONS_OPTIONS && action->options[i]; i++)
            known = known || !strcmp(o->name, action->options[i]);
        if (!known && args_given(g, o->name))
            return err_set(e, ERR_USAGE, "--%s is no option of rasp %s %s", o->name, command, action->name);
    }
    return true;
}

int actions_run(const char *command, const struct action *table, struct cmd_call *c, struct err *e)
{
    struct cmd_call inner = *c;
    const struct action *action = find(command, table, c, e);
    inner.args.operands++;
    int n = --inner.args.n_operands;
    if (!action || !check_options(command, action, &c->args, e))
        return (int)e->kind;
    if (n < action->least || (action->most >= 0 && n > action->most)) {
        err_set(e, ERR_USAGE, "rasp %s %s takes %s", command, action->name, action->operands);
        return (int)e->kind;
    }
    return action->run(&inner, e);
}
