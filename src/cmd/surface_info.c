/* rasp surface info FILE...: gathers; surface_info_notes.c judges, surface_info_print.c and surface_info_json.c print. */
#include "cmd/surface_info.h"

#include <math.h>
#include <stdio.h>

#include "cmd/surface.h"
#include "cmd/tell.h"
#include "file/heightfile_level.h"

const double surface_info_alphas[SURFACE_INFO_ALPHAS] = {0.01, 0.05};

/* The steps show in the heights as they are stored: so levelling comes after. */
static bool gather(struct surface_info *i, struct heightfile_options o, struct err *e)
{
    i->levelling = o.levelling;
    o.levelling = HEIGHTFILE_LEVEL_NONE;
    if (!heightfile_load(i->file, &o, i->arena, &i->h, e))
        return false;
    i->tilt = heightfile_level_fit(&i->h);
    surface_heights_steps(&i->h, &i->steps);
    i->h.levelled = heightfile_level(&i->h, (enum heightfile_levelling)i->levelling);
    surface_heights(&i->h, &i->heights);
    for (int down = 0; down < (i->h.rows > 1 ? 2 : 1); down++) {
        surface_band(&i->h, down, &i->band[down]);
        surface_ends(&i->h, down, &i->ends[down]);
    }
    surface_ends_period(&i->h, &i->period);
    surface_info_notes(i);
    return true;
}

int surface_info_run(struct cmd_call *c, struct err *e)
{
    struct heightfile_options o;
    bool json = args_given(&c->args, "json");
    int worst = 0, n = 0;
    const struct surface_info **list = ARENA_TAKE(c->arena, const struct surface_info *, c->args.n_operands);
    if (!surface_options(c, HEIGHTFILE_KEEP, &o, e))
        return (int)e->kind;
    for (int k = 0; k < c->args.n_operands; k++) {
        struct err mine = {0};
        struct arena *own = json ? c->arena : arena_open(); /* the maps of many files need not all stay */
        struct surface_info *i = ARENA_TAKE(own, struct surface_info, 1);
        *i = (struct surface_info){.file = c->args.operands[k], .arena = own};
        bool ok = gather(i, o, &mine);
        if (!ok)
            tell_error(c, "surface", &mine);
        else if (json)
            list[n++] = i;
        else
            surface_info_print(i);
        worst = (int)mine.kind > worst ? (int)mine.kind : worst;
        if (!json)
            arena_close(own);
    }
    if (json && n > 0 && !surface_info_json(list, n, e))
        return (int)e->kind;
    return worst;
}
