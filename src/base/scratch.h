/* A file without a name, for what does not fit into memory: in the folder TMPDIR (/tmp where it is not set), and gone
   when it is closed or the program ends. tmpfile() does not look at TMPDIR. */
#ifndef BASE_SCRATCH_H
#define BASE_SCRATCH_H
#include <stdio.h>

#include "base/arena.h"
#include "base/err.h"

const char *scratch_folder(void);
FILE *scratch_open(void); /* NULL: errno says why */

/* A new folder of that name and six more characters beside such files, which goes with the program until
 * interrupt_forget. NULL: ERR_CREATE */
const char *scratch_make_folder(const char *name, struct arena *a, struct err *e);

#endif
