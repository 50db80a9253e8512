/* Every subcommand, in the groups and the order of the usage. */
#include "cmd/commands.h"

#include <ctype.h>
#include <string.h>

#include "base/text.h"

struct group {
    const char *title;
    const struct command *members[6];
};

static const struct group groups[] = {
    {"Sound from scenes", {&render_command, &plan_command}},
    {"Sets of stimuli", {&batch_command, &merge_command}},
    {"Writing scenes", {&new_command, &explain_command, &check_command}},
    {"Looking at results", {&compare_command, &golden_command, &plot_command, &accuracy_command, &analyse_command}},
    {"Surfaces and objects", {&surface_command, &modes_command}},
    {"The shell", {&completion_command}},
    {NULL, {NULL}},
};

const struct command *commands_find(const char *name)
{
    for (const struct group *g = groups; g->title; g++)
        for (int i = 0; g->members[i]; i++)
            if (!strcmp(g->members[i]->name, name)) return g->members[i];
    return NULL;
}

const struct command *commands_at(int i)
{
    for (const struct group *g = groups; g->title; g++)
        for (int k = 0; g->members[k]; k++)
            if (i-- == 0) return g->members[k];
    return NULL;
}

const char *commands_nearest(const char *word)
{
    const char *names[33] = {"help"};
    int n = 1;
    for (const struct group *g = groups; g->title; g++)
        for (int i = 0; g->members[i] && n < 32; i++)
            names[n++] = g->members[i]->name;
    return text_nearest(word, names);
}

void commands_print(FILE *f)
{
    fputs("rasp: the sound of things that scrape, from a description of objects and motion\n\n"
          "Examples:\n"
          "  rasp new -o scrape.yaml          # a starter scene, with comments\n"
          "  rasp render scrape.yaml          # its physics, and its sound if anything rings\n"
          "  rasp explain motion.rate         # what a key means, its unit, range and default\n\n"
          "Usage: rasp COMMAND [OPTION]... [OPERAND]...\n",
          f);
    for (const struct group *g = groups; g->title; g++) {
        fprintf(f, "\n%s:\n", g->title);
        for (int i = 0; g->members[i]; i++)
            fprintf(f, "  %-10s %s\n", g->members[i]->name, g->members[i]->summary);
    }
    fputs("\n`rasp help COMMAND` explains a command; `rasp --version --verbose` belongs in bug reports.\n"
          "Manual: man rasp, man rasp-scene, man rasp-design\n",
          f);
}

/* ------------------------------------------------------------------ man rasp(1) */

static void man_command(FILE *f, const struct command *m)
{
    fprintf(f, ".It Nm Cm %s Oo Ar OPTION Oc ...%s%s\n%c%s.\n", m->name, *m->operands ? " " : "", m->operands,
            toupper((unsigned char)m->summary[0]), m->summary + 1);
    /* A full stop ends a sentence and so a line, as mdoc asks for. */
    for (const char *p = m->does; *p; p++) {
        bool ends = *p == '.' && p[1] == ' ';
        fputc(*p, f);
        if (ends) fputc('\n', f);
        p += ends;
    }
    fputc('\n', f);
    struct arena *a = arena_open();
    fputs(".Bl -tag -width Ds\n", f);
    for (const struct args_option *o = cmd_options(m, a); o->name; o++) {
        fputs(".It ", f);
        if (o->letter) fprintf(f, "Fl %c , ", o->letter);
        fprintf(f, "Fl \\-%s", o->name);
        if (o->value) fprintf(f, " Ns = Ns Ar %s", o->value);
        fprintf(f, "\n%c%s.\n", toupper((unsigned char)o->help[0]), o->help + 1);
    }
    fputs(".El\n", f);
    arena_close(a);
}

void commands_print_man(FILE *f)
{
    for (const struct group *g = groups; g->title; g++) {
        fprintf(f, ".Ss %s\n.Bl -tag -width Ds\n", g->title);
        for (int i = 0; g->members[i]; i++)
            man_command(f, g->members[i]);
        fputs(".El\n", f);
    }
}
