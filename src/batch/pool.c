/* See pool.h. One lock guards what is shared: the next job to begin, and which are done; a job takes milliseconds, the
   lock none to speak of. Results are handed over under the lock, so that what `took` touches needs no other. */
#include "batch/pool.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/memory.h"
#include "base/stopwatch.h"

enum { MOST_THREADS = 256 };

struct pool {
    const struct pool_work *work;
    pthread_mutex_t lock;
    int next, taken; /* jobs begun; handed over */
    bool stop;
    bool *done; /* [n] */
};

static void *worker(void *pool)
{
    struct pool *p = pool;
    const struct pool_work *w = p->work;
    pthread_mutex_lock(&p->lock);
    while (!p->stop && p->next < w->n) {
        int i = p->next++;
        pthread_mutex_unlock(&p->lock);
        bool go_on = w->job(w->context, i);
        pthread_mutex_lock(&p->lock);
        p->done[i] = true;
        p->stop = p->stop || !go_on;
        for (; p->taken < w->n && p->done[p->taken]; p->taken++)
            if (w->took) w->took(w->context, p->taken);
    }
    pthread_mutex_unlock(&p->lock);
    return NULL;
}

int pool_run(const struct pool_work *w)
{
    struct pool p = {.work = w, .done = calloc((size_t)w->n + 1, sizeof *p.done)};
    pthread_t threads[MOST_THREADS];
    int most = w->threads < w->n ? w->threads : w->n, n = 0;
    if (!p.done) memory_out("for %d jobs", w->n);
    pthread_mutex_init(&p.lock, NULL);
    most = (most < MOST_THREADS ? most : MOST_THREADS) - 1;
    while (n < most && pthread_create(&threads[n], NULL, worker, &p) == 0)
        n++;
    worker(&p);
    for (int i = 0; i < n; i++)
        pthread_join(threads[i], NULL);
    pthread_mutex_destroy(&p.lock);
    free(p.done);
    return p.taken;
}

/* ------------------------------------------------------------------ how far they are

   What is left is told by predicted cost, not by number, since stimuli differ; what was there already counts for
   neither side. */

#define PERIOD 0.1 /* s between two drawings */

void pool_progress_begin(struct pool_progress *p, int n, double cost, bool quiet)
{
    const char *term = getenv("TERM"), *ci = getenv("CI");
    bool dumb = !term || !*term || !strcmp(term, "dumb");
    *p = (struct pool_progress){.shown = !quiet && isatty(STDERR_FILENO) && !dumb && !(ci && *ci),
                                .start = stopwatch_wall(),
                                .cost = cost,
                                .n = n};
}

void pool_progress_time(double seconds, char text[24])
{
    long s = seconds < 1e7 ? (long)ceil(seconds) : 9999999;
    if (s >= 3600)
        snprintf(text, 24, "%ld:%02ld:%02ld", s / 3600, s / 60 % 60, s % 60);
    else
        snprintf(text, 24, "%ld:%02ld", s / 60, s % 60);
}

void pool_progress_step(struct pool_progress *p, const char *name, double cost, double left, double sound)
{
    double now = stopwatch_wall(), spent = now - p->start;
    char eta[24] = "-:--";
    p->at++;
    p->cost -= left;
    p->done += cost;
    p->sound += sound;
    if (!p->shown || (now - p->last < PERIOD && p->at < p->n)) return;
    p->last = now;
    if (p->done > 0) pool_progress_time(spent * fmax(0, p->cost - p->done) / p->done, eta);
    int width = snprintf(NULL, 0, "%d", p->n);
    fprintf(stderr, "\r\033[K[%*d/%d] %.40s  x%.3g  ETA %s", width, p->at, p->n, name, spent > 0 ? p->sound / spent : 0,
            eta);
    fflush(stderr);
}

void pool_progress_clear(struct pool_progress *p)
{
    if (p->shown && p->last > 0) fputs("\r\033[K", stderr);
    p->last = 0;
}
