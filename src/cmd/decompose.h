/* Parts of `rasp decompose`: what is found of a recording (decompose.c), and what is written (decompose_write.c). */
#ifndef CMD_DECOMPOSE_H
#define CMD_DECOMPOSE_H
#include "analysis/source_filter.h"
#include "cmd/analyse.h"
#include "cmd/cmd.h"

enum { DECOMPOSE_NOTES = 24 };
enum decompose_source { DECOMPOSE_AUTO, DECOMPOSE_IMPACTS, DECOMPOSE_FORCE };

struct decompose {
    struct cmd_call *c;
    struct arena *arena;
    struct source_filter_options options;
    const char *file, *shown; /* the recording; without its folders */
    const char *table;        /* mode table that is given; NULL */
    const char *folder;
    long channel;
    int channels;
    double rate, begin, seconds,
        whole; /* what is taken: its rate, from where, how long; the whole recording's length */
    double *x; /* [n] */
    long n;
    struct source_filter found;
    double fits;             /* share of the free frames' energy that the modes are */
    int source;              /* enum decompose_source, as asked */
    bool impacts;            /* the scene draws impacts; else it has the source as its force */
    double lasts;            /* s, of an impact's raised cosine in what is written */
    struct analysis *series; /* of the impacts; counted false: too few */
    double echo;             /* s, at which impacts repeat; NAN */
    const char *note[DECOMPOSE_NOTES];
    int notes;
};

/* All files, into a folder that is there. ERR_CREATE, ERR_IO */
bool decompose_write(struct decompose *d, const char *folder, struct err *e);

/* As text or JSON. */
bool decompose_write_report(const struct decompose *d, FILE *to, bool json, struct err *e);

#endif
