/* See params.h. */
#include "scene/params.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "scene/keys_text.h"
#include "scene/scene_part.h"

/* ------------------------------------------------------------------ where they are */

size_t params_at(const struct params *p)
{
    enum { ROOM = _Alignof(max_align_t) };
    size_t at = 0;
    for (int i = 0; stages_params(i) && stages_params(i) != p; i++)
        at += (stages_params(i)->size + ROOM - 1) / ROOM * ROOM;
    return at;
}

struct contact *params_contacts(struct arena *a, int n)
{
    struct contact *all = ARENA_TAKE(a, struct contact, n);
    for (int i = 0; i < n; i++)
        all[i].params = ARENA_TAKE(a, char, params_at(NULL));
    return all;
}

const void *params_block(const struct contact *c)
{
    static const max_align_t nothing[256];
    if (c->params) return c->params;
    assert(params_at(NULL) <= sizeof nothing);
    return nothing;
}

const void *params_of(const struct contact *c, const struct params *p)
{
    return (const char *)params_block(c) + params_at(p);
}

bool params_given(const struct contact *c, const struct params *p)
{
    return p->given ? p->given(c) : !p->meaning || !p->size || *(const bool *)params_of(c, p);
}

void *params_edit(struct contact *c, const struct params *p, struct arena *a)
{
    size_t size = params_at(NULL);
    char *own = memcpy(ARENA_TAKE(a, char, size), params_block(c), size);
    c->params = own;
    return own + params_at(p);
}

/* ------------------------------------------------------------------ checks */

void params_check(const struct scene_part *p, const struct contact *c)
{
    const struct params *one;
    for (int i = 0; (one = stages_params(i)); i++) {
        if (!params_given(c, one)) continue;
        for (const struct params_rule *r = one->rules; r && r->path; r++) {
            const struct key *a = keys_find(r->path), *b = keys_find(r->other);
            double x = *(const double *)keys_field(a, c), y = *(const double *)keys_field(b, c);
            const char *unit[2] = {keys_text_unit(a->dimension), keys_text_unit(b->dimension)};
            if (x > r->factor * y)
                scene_part_refuse(p, r->path, r->other, r->cure, ", %.4g%s%s, must be at most %g times %s, %.4g%s%s", x,
                                  *unit[0] ? " " : "", unit[0], r->factor, scene_part_label(p, r->other), y,
                                  *unit[1] ? " " : "", unit[1]);
        }
        if (one->check) one->check(p, c, params_of(c, one));
    }
}

/* ------------------------------------------------------------------ columns */

const struct params_column *params_column(int k, const struct params **whose)
{
    const struct params *p;
    for (int i = 0; (p = stages_params(i)); i++)
        for (const struct params_column *c = p->columns; c && c->name; c++) {
            if (whose) *whose = p;
            if (k-- == 0) return c;
        }
    return NULL;
}

int params_column_find(const char *name)
{
    const struct params_column *c;
    for (int k = 0; (c = params_column(k, NULL)); k++)
        if (strcmp(c->name, name) == 0) return k;
    return -1;
}

const char *params_column_lacks(const struct contact *c, int k)
{
    const struct params *whose = NULL;
    const struct params_column *column = params_column(k, &whose);
    return whose->lacks ? whose->lacks(c, column) : params_given(c, whose) ? "" : whose->section;
}

/* ------------------------------------------------------------------ parts of the surface */

/* The next that is given from number *i on; NULL: there are no more. */
static const struct params *ground_next(const struct contact *c, int *i)
{
    const struct params *p;
    while ((p = stages_params((*i)++)))
        if (p->ground && params_given(c, p)) return p;
    return NULL;
}

int params_directed(const struct contact *c)
{
    int directed = 0, i = 0;
    for (const struct params *p; (p = ground_next(c, &i));) {
        int is = p->ground->directed ? p->ground->directed(params_of(c, p)) : 0;
        if (is < 0) return is;
        directed |= is;
    }
    return directed;
}

double params_finest(const struct contact *c)
{
    double finest = HUGE_VAL;
    int i = 0;
    for (const struct params *p; (p = ground_next(c, &i));)
        finest = fmin(finest, p->ground->finest(params_of(c, p)));
    return finest;
}

static double span(const struct contact *c, bool kinked)
{
    double sum = 0;
    int i = 0;
    for (const struct params *p; (p = ground_next(c, &i));)
        if (p->ground->span && (p->ground->kinked || !kinked)) sum += p->ground->span(params_of(c, p));
    return sum;
}

double params_span(const struct contact *c) { return span(c, false); }

double params_kinked_span(const struct contact *c) { return span(c, true); }
