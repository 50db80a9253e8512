/* Heads of the rows of a `struct params`: where a value is, its path and its type. What follows in a row is dimension,
   low, high, default, applies, meaning, words (scene/keys.h). Only files of stages include this. A field of another C
   type does not compile. */
#ifndef SCENE_ROWS_H
#define SCENE_ROWS_H
#include "scene/params.h"

#define ROW(owner, member, where, kind, c_type)                                                                        \
    .of = _Generic((struct owner *)NULL, struct scene *                                                                \
                   : KEY_SCENE, default                                                                                \
                   : KEY_CONTACT),                                                                                     \
    .offset = offsetof(struct owner, member), .path = where,                                                           \
    .type = _Generic(((struct owner *)NULL)->member, c_type                                                            \
                     : kind)
#define ROW_NUMBER(owner, member, where) ROW(owner, member, where, KEY_NUMBER, double)
#define ROW_WHOLE(owner, member, where) ROW(owner, member, where, KEY_WHOLE, double)
#define ROW_TIME_OR_AUTO(owner, member, where) ROW(owner, member, where, KEY_TIME_OR_AUTO, double)
#define ROW_COUNT(owner, member, where) ROW(owner, member, where, KEY_COUNT, int)
#define ROW_CHOICE(owner, member, where) ROW(owner, member, where, KEY_CHOICE, int)
#define ROW_SEED(owner, member, where) ROW(owner, member, where, KEY_SEED, uint64_t)
#define ROW_TEXT(owner, member, where) ROW(owner, member, where, KEY_TEXT, const char *)
#define ROW_FILE(owner, member, where) ROW(owner, member, where, KEY_FILE, const char *)
#define ROW_LIST(owner, member, where) ROW(owner, member, where, KEY_LIST, const char **)
#define ROW_POINT(owner, member, where) ROW(owner, member, where, KEY_POINT, double *)
#define ROW_RANGE(owner, member, where) ROW(owner, member, where, KEY_RANGE, double *)
#define ROW_POINTS(owner, member, where) ROW(owner, member, where, KEY_POINTS, const double *)
#define ROW_PLACES(owner, member, where) ROW(owner, member, where, KEY_PLACES, const double *)

/* Here stand the rows of all whose section begins so, and with no longer place, in the order of pipeline/stages.def. */
#define ROW_PLACE(map) .path = map, .meaning = NULL

#endif
