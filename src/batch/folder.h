/* The folder of a set: whose it is, who is at work in it, what a run must not overwrite, and what it leaves over.

   DIR/.rasp/owner says in four lines: the format, the hash of the design (struct set), where the design lies as seen
   from the folder, and the program. While somebody is at work a fifth line names the machine and the process. The file
   is also the lock (flock): a run of the whole set holds it alone, shards share it. Where there are no locks, nobody
   waits and nobody is refused.

   A design is known by its file, unless that is a pipe: edited, it is the same design, and its set goes on from what is
   there. It is known by its hash, too: moved, renamed or copied with the scenes and files that it builds on, it is the
   same. Any other is refused, for it would replace a set that is not its own. */
#ifndef BATCH_FOLDER_H
#define BATCH_FOLDER_H
#include <stdbool.h>
#include <sys/types.h>

#include "base/arena.h"
#include "base/err.h"

struct folder_owner {
    const char *folder, *design; /* the design's file, seen from here                                      */
    const char *sha256;          /* of struct set                                                          */
    const char *program;
    bool replace; /* another design's folder is taken over; nothing of it is removed by that */
    bool part;    /* of a shard                                                             */
};

/* Makes DIR (its parent must be there) and DIR/.rasp, locks it, and notes the owner. *lock: for folder_leave; -1: there
   are no locks here. ERR_CREATE: it is another design's; ERR_INTERRUPTED: others are at work. */
bool folder_enter(const struct folder_owner *o, struct arena *a, int *lock, struct err *e);
void folder_leave(int lock);

/* Would it be let in, but for others at work? Writes nothing; the folder need not be there. ERR_CREATE */
bool folder_look(const struct folder_owner *o, struct arena *a, struct err *e);

/* Does the folder say whose it is? If not, nothing in it is a set's. */
bool folder_is_recorded(const char *folder, struct arena *a);

/* Where a design lies, seen from its folder, in UTF-8. A key does not know where the folder is, but the file names in
   an effective scene do. What comes through a pipe is called alike whatever comes, and names its files from nowhere:
   then it is the folder that is named, "- /where/it/is". */
const char *folder_place(const char *design, const char *folder, struct arena *a);

/* The folders in which a file named so within `folder` will stand; harmless when they are there, and when several
 * threads do it. ERR_CREATE */
bool folder_make_for(const char *folder, const char *name, struct err *e);

/* The text with the names of files in the folder as they are seen from there: tables of a set do not say where it was
 * made. */
const char *folder_seen(const char *folder, const char *text, struct arena *a);

/* Bytes free for files in it; a great number when that is not known. */
double folder_free(const char *folder);

/* ------------------------------------------------------------------ inputs */

struct folder_inputs; /* the files that a set is made from, each once, by device and inode: links count */

struct folder_inputs *folder_inputs(struct arena *a);
void folder_inputs_add(struct folder_inputs *all, const char *file, const char *what, dev_t device, ino_t inode);
void folder_inputs_add_file(struct folder_inputs *all, const char *file, const char *what);
bool folder_inputs_has(const struct folder_inputs *all, const char *path);

struct folder_output { /* one that a set would write */
    const char *path, *whose;
    const char *folder;
    bool unknown; /* nothing said whose the folder is: what is there may be anybody's */
    bool links;   /* symbolic links are written through                               */
};

/* False: ERR_CREATE, with both names; or it is there already, and nothing says whose it is. */
bool folder_spares(const struct folder_inputs *all, const struct folder_output *o, struct arena *a, struct err *e);

/* No input lies in FOLDER/.rasp, whose files come and go with the set. ERR_CREATE */
bool folder_spares_hidden(const struct folder_inputs *all, const char *folder, const char *design, struct err *e);

/* ------------------------------------------------------------------ stale files */

struct folder_wanted { /* what of the folder is the set's */
    const char *folder;
    const char **names; /* [n] of the stimuli, sorted by strcmp */
    const char **keys;  /* [n] of what has no right record: the key that it would have; NULL: the record is right */
    int n;
    const struct folder_inputs *inputs;
    bool prune; /* stimuli of which no file was changed are removed */
    bool all;   /* the set is whole: raw sounds go, too */
};

struct folder_stale {
    const char **files; /* [n_files] that are there still, seen from the folder */
    int n_files, removed;
};

/* Files of records that the set does not want, of its earlier states. Removes hidden names of programs that were killed
   (.rasp-PID-*.part). Folders that hold a set of their own are not looked into. */
void folder_stale(const struct folder_wanted *w, struct arena *a, struct folder_stale *s);

#endif
