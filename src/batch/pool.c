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
