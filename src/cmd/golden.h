/* What `rasp golden` knows of its scenes, and its parts: the list, the renders, what is kept, the verdicts, the report.

   Kept of a scene are the sounds and tables that its render writes: KEPT/NAME/sound.wav, KEPT/NAME/sound.csv and so on,
   or, where only hashes are kept, lines "SHA256  NAME/sound.wav" of one file, as sha256sum has them. */
#ifndef CMD_GOLDEN_H
#define CMD_GOLDEN_H
#include "base/hash.h"
#include "cmd/compare.h"

struct golden_file {
    const char *name; /* "sound.wav"                                            */
    char sha256[HASH_TEXT];
};

struct golden_files { /* by name                                               */
    struct golden_file *list;
    int n;
};

struct golden_problem {
    const char *file;          /* "sound.wav"; "": the scene as a whole                  */
    const char *says, *report; /* one line; several, from `rasp compare`, NULL: none     */
};

struct golden_scene {
    const char *file, *name;
    const char *at;                    /* "scenes.txt:3: "; "": it is an operand                 */
    struct args args;                  /* options of its line                                    */
    struct compare_ask sounds, tables; /* how far either may be off; exact: not at all     */
    struct scene scene;
    struct err failed;           /* kind ERR_NONE: read, and rendered so far               */
    struct golden_files made[2]; /* by the first and the second render                     */
    struct golden_problem *problems;
    int n_problems;
    const char *note;    /* of what is within its tolerances; NULL: nothing        */
    struct arena *arena; /* of what one thread at a time finds                     */
};

struct golden {
    struct cmd_call *call;
    struct golden_scene *scenes;
    int n;
    bool whole;               /* all operands are lists: nothing else should be kept    */
    const char *saved;        /* folder of files; NULL: hashes only                     */
    const char *hashes;       /* file of hashes; NULL: none                             */
    struct golden_files sums; /* its lines, NAME/FILE                                   */
    const char *work;         /* folder of the renders                                  */
    bool stays;               /* ... of scenes that fail stays                          */
    const char *junit;        /* file; NULL: none                                       */
    bool effective, tap, quiet;
    int threads;
};

/* What is kept. */
bool golden_read_hashes(struct golden *g, struct err *e); /* the file of hashes. ERR_INPUT, ERR_SCENE */
struct golden_files golden_files_of(const struct golden *g, const char *scene, struct arena *a,
                                    struct err *e);                  /* ERR_INPUT */
const char **golden_strays(const struct golden *g, struct arena *a); /* NAME/FILE of no scene; ends with NULL */

struct golden_file *golden_add(struct golden_files *files, const char *name, struct arena *a);
const struct golden_file *golden_find(const struct golden_files *files, const char *name);
void golden_sort(struct golden_files *files);
bool golden_has(const struct golden *g, const char *name, size_t n); /* is name[0..n) that of a scene? */

/* The folder of the renders. */
bool golden_run_folder(struct golden *g, struct err *e);
void golden_run_end(const struct golden *g);

/* The actions. */
int golden_run_check(struct golden *g, struct err *e);
int golden_run_update(struct golden *g, struct err *e);

/* What is printed. */
void golden_report_scene(const struct golden *g, const struct golden_scene *s, int number);
void golden_report_strays(const struct golden *g, const char *const *strays, int number);
/* As JUnit's XML; strays NULL: they were not looked for. */
void golden_report_junit(const struct golden *g, const char *const *strays, FILE *f);

#endif
