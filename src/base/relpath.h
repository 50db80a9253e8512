/* File names seen from another folder. */
#ifndef BASE_RELPATH_H
#define BASE_RELPATH_H
#include "base/arena.h"

/* `file` (relative to the current folder, or absolute) as it is called from `folder` (NULL or "": the current one).
   Symbolic links in folders are followed, the file's own is not; folders that are not there are taken by their names,
   so that what is called so once is called so again when they come back. Absolute when the two have no folder but / in
   common. */
const char *relpath_make(const char *file, const char *folder, struct arena *a);

/* The folder that a file's name says, "." where it says none; the name without folder and ending. */
const char *relpath_folder(const char *file, struct arena *a);
const char *relpath_stem(const char *file, struct arena *a);

/* The file's name as it is, without its ending: what all files of a render are called by. */
const char *relpath_base(const char *file, struct arena *a);

#endif
