/* Heads of the rows of a `struct params`: where a value is, its path and its type. What follows in a row is dimension,
   low, high, default, applies, meaning, words (scene/keys.h). Only files of stages include this. A field of another C
   type does not compile. */
#ifndef SCENE_ROWS_H
#define SCENE_ROWS_H
#include "scene/params.h"

#define ROW(owner, member, where, kind, c_type)                                                                        \
    .of = KEY_CONTACT, .offset = offsetof(struct owner, member), .path = where,                                        \
    .type = _Generic(((struct owner *)NULL)->member, c_type                                                            \
                     : kind)
#define ROW_NUMBER(owner, member, where) ROW(owner, member, where, KEY_NUMBER, double)
#define ROW_COUNT(owner, member, where) ROW(owner, member, where, KEY_COUNT, int)
#define ROW_CHOICE(owner, member, where) ROW(owner, member, where, KEY_CHOICE, int)
#define ROW_FILE(owner, member, where) ROW(owner, member, where, KEY_FILE, const char *)
#define ROW_RANGE(owner, member, where) ROW(owner, member, where, KEY_RANGE, double *)
#define ROW_TEXT(owner, member, where) ROW(owner, member, where, KEY_TEXT, const char *)

#endif
