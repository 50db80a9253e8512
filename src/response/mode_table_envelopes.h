/* The envelopes of a mode table of the columns time_s, amplitude. For mode_table.c. */
#ifndef RESPONSE_MODE_TABLE_ENVELOPES_H
#define RESPONSE_MODE_TABLE_ENVELOPES_H
#include "response/mode_table.h"
#include "response/mode_table_rows.h"

/* Fits the slopes of every entry of t; entry k has the rows r->order[from[k]] to before r->order[from[k + 1]]. Sets
   t->note where a fit is not met to -40 dB; ERR_SCENE: not to -20 dB, or less than two samples. With shared poles every
   place must have every mode. */
bool mode_table_envelopes_fit(const struct mode_table_rows *r, const size_t *from, struct arena *a,
                              struct mode_table *t, struct err *e);

#endif
