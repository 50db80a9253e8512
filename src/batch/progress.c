/* See progress.h. What is left is told by predicted cost, not by number, since stimuli differ; what was there already
 * counts for neither side. */
#include "batch/progress.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/stopwatch.h"

#define PERIOD 0.1 /* s between two drawings */

void progress_begin(struct progress *p, int n, double cost, bool quiet)
{
    const char *term = getenv("TERM"), *ci = getenv("CI");
    bool dumb = !term || !*term || !strcmp(term, "dumb");
    *p = (struct progress){.shown = !quiet && isatty(STDERR_FILENO) && !dumb && !(ci && *ci),
                           .start = stopwatch_wall(),
                           .cost = cost,
                           .n = n};
}

void progress_time(double seconds, char text[24])
{
    long s = seconds < 1e7 ? (long)ceil(seconds) : 9999999;
    if (s >= 3600)
        snprintf(text, 24, "%ld:%02ld:%02ld", s / 3600, s / 60 % 60, s % 60);
    else
        snprintf(text, 24, "%ld:%02ld", s / 60, s % 60);
}

void progress_step(struct progress *p, const char *name, double cost, double left, double sound)
{
    double now = stopwatch_wall(), spent = now - p->start;
    char eta[24] = "-:--";
    p->at++;
    p->cost -= left;
    p->done += cost;
    p->sound += sound;
    if (!p->shown || (now - p->last < PERIOD && p->at < p->n)) return;
    p->last = now;
    if (p->done > 0) progress_time(spent * fmax(0, p->cost - p->done) / p->done, eta);
    int width = snprintf(NULL, 0, "%d", p->n);
    fprintf(stderr, "\r\033[K[%*d/%d] %.40s  x%.3g  ETA %s", width, p->at, p->n, name, spent > 0 ? p->sound / spent : 0,
            eta);
    fflush(stderr);
}

void progress_clear(struct progress *p)
{
    if (p->shown && p->last > 0) fputs("\r\033[K", stderr);
    p->last = 0;
}
