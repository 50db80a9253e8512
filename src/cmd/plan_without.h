/* rasp plan --without: what each effect of a scene costs, by the scene without it. */
#ifndef CMD_PLAN_WITHOUT_H
#define CMD_PLAN_WITHOUT_H
#include "cmd/cmd.h"
#include "cmd/report.h"

/* Adds the rows to the scene's report; `chosen` has its knobs settled. `measured`: beside what is predicted the CPU
   time of renders, seven of each in turn. ERR_SCENE and what opening a plan gives: of the scene as it stands. */
bool plan_without(struct cmd_call *c, const char *file, const struct scene *chosen, bool measured, struct report *r,
                  struct err *e);

#endif
