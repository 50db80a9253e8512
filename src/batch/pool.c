/* See pool.h. One lock guards what is shared: the next job to begin, and which are done; a job takes milliseconds, the
   lock none to speak of. Results are handed over under the lock, so that what `took` touches needs no other. */
#include "batch/pool.h"

#include <pthread.h>
#include <stdlib.h>

#include "base/memory.h"

enum { MOST_THREADS = 256 };

struct pool {
    const struct pool_work *work;
    pthread_mutex_t lock;
    int next, taken; /* jobs begun; handed over */
    bool stop;
    bool *done; /* [n] */
};

static bool begin(struct pool *p, int *i)
{
    pthread_mutex_lock(&p->lock);
    bool any = !p->stop && p->next < p->work->n;
    if (any) *i = p->next++;
    pthread_mutex_unlock(&p->lock);
    return any;
}

static void end(struct pool *p, int i, bool go_on)
{
    pthread_mutex_lock(&p->lock);
    p->done[i] = true;
    p->stop = p->stop || !go_on;
    while (p->taken < p->work->n && p->done[p->taken]) {
        if (p->work->took) p->work->took(p->work->context, p->taken);
        p->taken++;
    }
    pthread_mutex_unlock(&p->lock);
}

static void *worker(void *pool)
{
    struct pool *p = pool;
    int i;
    while (begin(p, &i))
        end(p, i, p->work->job(p->work->context, i));
    return NULL;
}

static int start(struct pool *p, pthread_t *threads, int most)
{
    int n = 0;
    while (n < most && pthread_create(&threads[n], NULL, worker, p) == 0)
        n++;
    return n;
}

int pool_run(const struct pool_work *w)
{
    struct pool p = {.work = w, .done = calloc((size_t)w->n + 1, sizeof *p.done)};
    pthread_t threads[MOST_THREADS];
    int most = w->threads < w->n ? w->threads : w->n;
    if (!p.done) memory_out("for %d jobs", w->n);
    pthread_mutex_init(&p.lock, NULL);
    int n = start(&p, threads, (most < MOST_THREADS ? most : MOST_THREADS) - 1);
    worker(&p);
    for (int i = 0; i < n; i++)
        pthread_join(threads[i], NULL);
    pthread_mutex_destroy(&p.lock);
    free(p.done);
    return p.taken;
}
