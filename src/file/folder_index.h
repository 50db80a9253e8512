/* A folder whose index.csv says in its column file_name which of the folder's files belong to it. */
#ifndef FILE_FOLDER_INDEX_H
#define FILE_FOLDER_INDEX_H
#include "base/arena.h"

/* index.csv and what it names, by name, each "FOLDER/NAME"; index.csv alone where it cannot be read. *n 0: the folder
 * has none, or is no folder. */
const char **folder_index_files(const char *folder, int *n, struct arena *a);

#endif
