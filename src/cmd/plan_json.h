/* A scene's plans as JSON: part of `rasp plan --json`. */
#ifndef CMD_PLAN_JSON_H
#define CMD_PLAN_JSON_H
#include <jansson.h>

#include "pipeline/plan.h"

/* plans: [s->n_contacts]; promise: what accuracy.error chose, as text, NULL: nothing was asked. */
json_t *plan_json(const struct scene *s, const struct plan *plans, const char *promise);

#endif
