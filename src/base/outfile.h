/* An output that has no name until it is complete: an unnamed file (O_TMPFILE) in the target's folder, linked under a
   temporary name and renamed over the target when it is committed; where the file system has no unnamed files, a hidden
   temporary name. A program that is killed leaves nothing half-written (but for that hidden name, ".rasp-*.part", where
   it had to be used). A target that is a symbolic link replaces what the link points to; a target that is a device, a
   pipe, a folder or is write-protected is refused. */
#ifndef BASE_OUTFILE_H
#define BASE_OUTFILE_H
#include <stdbool.h>
#include <stdio.h>

#include "base/arena.h"
#include "base/err.h"
#include "base/hash.h"

struct outfile {
    FILE *stream;                       /* NULL when only fd is used (libsndfile)          */
    int fd, why;                        /* why: errno of a put that failed; 0: none did    */
    char target[4096], temporary[4200]; /* temporary is empty while the file is unnamed */
};

bool outfile_open(struct outfile *o, const char *target, struct err *e);    /* ERR_CREATE */
bool outfile_open_fd(struct outfile *o, const char *target, struct err *e); /* same, without a stream */
bool outfile_open_hidden(struct outfile *o, const char *target,
                         struct err *e); /* _fd by the hidden name at once, for tests */
void outfile_put(struct outfile *o, const void *data,
                 size_t n); /* into the stream; what goes wrong the settling says */
bool outfile_finalise(
    struct outfile *o,
    struct err *e); /* all of a commit but the rename: with several outputs, settle all, then commit */
bool outfile_commit(struct outfile *o, struct err *e); /* settles and renames; closes either way; ERR_IO */
/* All get their names once all are complete; none is open afterwards. With an error set already none does. How many
   have it. ERR_IO */
int outfile_commit_all(struct outfile *all, int n, struct err *e);
bool outfile_hash(struct outfile *o, char hex[HASH_TEXT],
                  struct err *e);     /* of what is written so far; ERR_IO, then it is dropped */
void outfile_drop(struct outfile *o); /* closes and leaves nothing; harmless when closed */

/* A file without a name, for what does not fit into memory: in the folder TMPDIR (/tmp where it is not set), and gone
   when it is closed or the program ends. tmpfile() does not look at TMPDIR. */
const char *outfile_scratch_folder(void);
FILE *outfile_scratch_open(void); /* NULL: errno says why */

/* A new folder of that name and six more characters beside such files, which goes with the program until
 * interrupt_forget. NULL: ERR_CREATE */
const char *outfile_scratch_make_folder(const char *name, struct arena *a, struct err *e);

/* A folder that has no name until it is complete: a temporary one beside the target, which is returned, is filled, then
   takes its name, in the place of one that is there, which is removed whole. NULL: ERR_CREATE */
const char *outfile_folder_open(const char *target, struct arena *a, struct err *e);
/* ok false: nothing of it stays, and what is there stays. ERR_CREATE */
bool outfile_folder_close(const char *target, const char *temporary, bool ok, struct arena *a, struct err *e);

#endif
