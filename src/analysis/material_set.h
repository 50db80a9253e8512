/* From a mode table to what a material is fitted to. */
#ifndef ANALYSIS_MATERIAL_SET_H
#define ANALYSIS_MATERIAL_SET_H
#include "analysis/material_fit.h"
#include "response/mode_table.h"

/* The table's modes by rising frequency: of several slopes the one of the greatest energy, those that do not decay left
   out. Standard errors are those that `rasp modes extract` writes as comments: of noise, and from strike to strike,
   which many strikes make less; where there are none, what it states of one strike, 0.02 % of frequency and 5 % of
   decay. t: poles shared. */
struct material_set material_set_make(const struct mode_table *t, int object, struct arena *a);

/* How well the places `first` to `first + n - 1` of the family's points show each of its modes: of its shape there (and
   where it is heard, ear >= 0) beside the rms over modes, at most 1. NULL: no place is known (n = 0). */
double *material_set_visible(const struct solid_family *f, int points, int first, int n, int ear, struct arena *a);

#endif
