/* Every subcommand, in the groups and the order of the usage. */
#include "cmd/cmd.h"

#include <ctype.h>
#include <string.h>

#include "base/text.h"
#include "base/wrap.h"

const struct command *const commands_table[] = {
    &render_command,  &plan_command,    &batch_command,      &batch_merge_command,
    &new_command,     &explain_command, &check_command,      &compare_command,
    &golden_command,  &plot_command,    &accuracy_command,   &analyse_command,
    &surface_command, &modes_command,   &completion_command, NULL};

const struct command *commands_find(const char *name)
{
    const struct command *const *m = commands_table;
    while (*m && strcmp((*m)->name, name) != 0)
        m++;
    return *m;
}

const char *commands_nearest(const char *word)
{
    const char *names[sizeof commands_table / sizeof *commands_table + 1] = {"help"};
    for (int i = 0; commands_table[i]; i++)
        names[i + 1] = commands_table[i]->name;
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
    for (const struct command *const *m = commands_table; *m; m++) {
        if ((*m)->group) fprintf(f, "\n%s:\n", (*m)->group);
        fprintf(f, "  %-10s %s\n", (*m)->name, (*m)->summary);
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
    for (const struct command *const *m = commands_table; *m; m++) {
        if ((*m)->group) fprintf(f, "%s.Ss %s\n.Bl -tag -width Ds\n", m == commands_table ? "" : ".El\n", (*m)->group);
        man_command(f, *m);
    }
    fputs(".El\n", f);
}

/* ------------------------------------------------------------------ help */

static void print_option(const struct args_option *o)
{
    char head[96], letter[8] = "    ";
    if (o->letter) snprintf(letter, sizeof letter, "-%c, ", o->letter);
    int n = snprintf(head, sizeof head, "  %s--%s%s%s", letter, o->name, o->value ? "=" : "", o->value ? o->value : "");
    printf("%-26s  ", head);
    wrap_print(stdout, o->help, n > 26 ? n + 2 : 28, "                            ");
}

void commands_print_help(const struct command *m)
{
    static const struct args_option help = {"help", 'h', NULL, false, "this text"};
    printf("rasp %s: %s\n\nExamples:\n", m->name, m->summary);
    for (const char *p = m->examples; *p;) {
        size_t n = strcspn(p, "\n");
        printf("  %.*s\n", (int)n, p);
        p += n + (p[n] == '\n');
    }
    printf("\nUsage: rasp %s [OPTION]...%s%s\n\n", m->name, *m->operands ? " " : "", m->operands);
    wrap_print(stdout, m->does, 0, "");
    printf("\nOptions:\n");
    struct arena *a = arena_open();
    for (const struct args_option *o = cmd_options(m, a); o->name; o++)
        print_option(o);
    arena_close(a);
    print_option(&help);
}
