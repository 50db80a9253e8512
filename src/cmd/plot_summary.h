/* The summary NAME.json that a render leaves beside its files: what `rasp plot` takes from it, above all which tables are of that render. */
#ifndef CMD_PLOT_SUMMARY_H
#define CMD_PLOT_SUMMARY_H
#include <stdbool.h>

#include "base/arena.h"
#include "base/err.h"

struct plot_summary {
    const char *file;
    const char *title;      /* the scene's; "": none                                  */
    const char **contacts;  /* [n_contacts] names                                     */
    int n_contacts;
    bool there;             /* false: there is no summary                             */
    bool lists;             /* false: it does not say what was written                */
    bool sounds;            /* it lists a WAV                                         */
    const char *effective;  /* sha256 of the effective scene; "": not listed          */
    const char **tables[2]; /* [n_tables] contact and sha256 of every table it lists  */
    int n_tables;
};

/* A file that is not there, or is no JSON, gives an empty one. */
struct plot_summary plot_summary_read(const char *file, struct arena *a);

/* Is that file the table of the contact ("": of the only one) that the summary lists? *why: why not. ERR_INPUT: it cannot be read. */
bool plot_summary_has(const struct plot_summary *s, const char *path, const char *contact, const char **why, struct err *e);

#endif
