/* rasp modes compute MESH | --shape ... -o FILE.csv: how a solid rings, by finite elements (papers/003 section A), as a mode table. */
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/text.h"
#include "cmd/modes_compute.h"
#include "cmd/modes_fit.h"
#include "cmd/modes_output.h"
#include "cmd/tell.h"
#include "fem/shapes.h"
#include "output/mark.h"

/* A mesh of TetGen is several files. */
static bool read_output(const struct compute *k, const char **file, struct err *e)
{
    static const char *const endings[] = {"node", "ele", "face"};
    const struct args *g = &k->c->args;
    const char *mesh = g->n_operands ? g->operands[0] : NULL, *dot = mesh ? strrchr(mesh, '.') : NULL;
    *file = args_value(g, "output");
    if (!*file)
        return err_set(e, ERR_USAGE, "-o FILE.csv is needed: the mode table to write");
    for (int i = 0; dot && (!strcmp(dot, ".node") || !strcmp(dot, ".ele")) && i < 3; i++)
        if (!modes_output_spares(*file, arena_format(k->c->arena, "%.*s.%s", (int)(dot - mesh), mesh, endings[i]), e))
            return false;
    return modes_output_spares(*file, mesh, e) && modes_output_spares(*file, args_value(g, "points"), e);
}

static void report(const struct compute *k, const char *file)
{
    printf("%s: %d mode%s from %.6g to %.6g Hz at %d place%s", text_shown(k->c->arena, file), k->n, k->n == 1 ? "" : "s", k->least, k->greatest, k->places,
           k->places == 1 ? "" : "s");
    if (k->left_out)
        printf(" (%d of the grid lie beside the solid)", k->left_out);
    modes_fit_report(k->error, k->c->arena);
    printf("; %d tetrahedra of order %ld, %ld freedoms, %.4g kg, %d rigid motion%s\n", k->mesh.elements, k->order, k->modes.freedoms, k->modes.mass, k->modes.rigid,
           k->modes.rigid == 1 ? "" : "s");
    if (k->estimated)
        printf("%s: %s\n", args_given(&k->c->args, "shape") ? "estimated error of frequencies" : "frequencies of the order below are off by more than these, by", modes_compute_estimate_says(k));
}

static void warn(struct cmd_call *c, const char *note)
{
    while (note && *note) {
        int n = (int)strcspn(note, "\n");
        tell_remark(c, "modes", arena_format(c->arena, "%.*s", n, note));
        note += n + (note[n] == '\n');
    }
}

int modes_compute_run(struct cmd_call *c, struct err *e)
{
    struct compute k = {.c = c};
    const char *file;
    char inputs[HASH_TEXT];
    bool quiet = args_given(&c->args, "quiet");
    if (args_given(&c->args, "shape") && !strcmp(args_value(&c->args, "shape"), "help")) {
        puts(shapes_help());
        return 0;
    }
    if (!read_output(&k, &file, e) || !modes_compute_solid_read(&k, e) || !modes_compute_places(&k, e))
        return (int)e->kind;
    modes_compute_write_inputs(&k, inputs);
    if (access(file, F_OK) == 0 && modes_compute_write_is_current(file, inputs, c->arena)) {
        if (!quiet)
            printf("%s: up to date\n", text_shown(c->arena, file));
        return 0;
    }
    if (!mark_absent(file, args_given(&c->args, "force"), e) || !modes_output_possible(file, e) || !modes_compute_solid_solve(&k, e) ||
        !modes_compute_estimate(&k, e) || !modes_compute_places_settle(&k, e) || !modes_compute_write(&k, file, inputs, e))
        return (int)e->kind;
    if (!quiet) {
        report(&k, file);
        warn(c, k.note);
        modes_fit_warn(c, k.error, &k.laid);
    }
    return 0;
}
