/* One line on a terminal that says how far a batch is: "[ 37/240] scrape_r2_v10  x12.4  ETA 0:41". */
#ifndef BATCH_PROGRESS_H
#define BATCH_PROGRESS_H
#include <stdbool.h>

struct progress {
    bool shown;         /* a terminal is there to show it                                        */
    double start, last; /* s; when it was last drawn                                             */
    double cost, done;  /* of all that is to be rendered; of what was                            */
    double sound;       /* s of sound rendered                                                   */
    int n, at;
};

/* quiet: nothing is shown; nor where standard error is no terminal, TERM is dumb, or CI is set. cost: in whatever unit,
 * of all n. */
void progress_begin(struct progress *p, int n, double cost, bool quiet);

/* One more is there: rendered at that cost, `sound` seconds long; or it was there already (cost 0 then, and `left` less
 * to do). */
void progress_step(struct progress *p, const char *name, double cost, double left, double sound);

/* Takes the line away, before something else is written and at the end. */
void progress_clear(struct progress *p);

/* "0:41", "1:02:03"; text has room for 24. */
void progress_time(double seconds, char text[24]);

#endif
