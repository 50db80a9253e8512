#include "pipeline/stages.h"

#include <pthread.h>

#include "scene/params.h"

const struct stage *const stages_table[] = {
#define STAGE(name) &name##_stage,
#include "pipeline/stages.def"
#undef STAGE
    NULL,
};

static const struct {
    const struct stage *stage;
    const struct params *params;
} all[] = {
#define STAGE(name) {&name##_stage, NULL},
#define PARAMS(name) {NULL, &name##_params},
#include "pipeline/stages.def"
#undef STAGE
};

static const struct params *found[sizeof all / sizeof *all + 1]; /* asked for thousands of times when a scene is read */

static void find(void)
{
    int n = 0;
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        const struct params *p = all[k].stage ? all[k].stage->params : all[k].params;
        if (p) found[n++] = p;
    }
}

const struct params *stages_params(int i)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, find);
    return found[i];
}

bool stages_wanted(const struct stage *st, const struct contact *c, const struct scene *s)
{
    return st->wanted ? st->wanted(c, s) : params_given(c, st->params);
}

double stages_work(const struct stage *st, const struct contact *c, const struct scene *s)
{
    return st->work ? st->work(c, s) : st->cycles;
}
