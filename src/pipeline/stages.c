#include "pipeline/stages.h"

#include "scene/params.h"

const struct stage *const stages_table[] = {
#define STAGE(name) &name##_stage,
#include "pipeline/stages.def"
#undef STAGE
    NULL,
};

const struct params *stages_params(int i)
{
    for (const struct stage *const *s = stages_table; *s; s++)
        if ((*s)->params && i-- == 0) return (*s)->params;
    return NULL;
}

bool stages_wanted(const struct stage *st, const struct contact *c, const struct scene *s)
{
    return st->wanted ? st->wanted(c, s) : params_given(c, st->params);
}

double stages_work(const struct stage *st, const struct contact *c, const struct scene *s)
{
    return st->work ? st->work(c, s) : st->cycles;
}
