/* See piped.h. Opening a FIFO waits for a writer, and reading for what is written: a signal ends the program there
 * (base/interrupt.h). */
#include "file/piped.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/memory.h"

enum { PIECE = 1 << 16 };

struct kept {
    struct kept *next;
    char *file, *text;
    size_t size;
};

static struct kept *all;
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

bool piped_is(const char *file)
{
    struct stat s;
    return !strcmp(file, "/dev/stdin") || !strncmp(file, "/dev/fd/", 8) ||
           (!strncmp(file, "/proc/", 6) && strstr(file, "/fd/")) ||
           (stat(file, &s) == 0 && !S_ISREG(s.st_mode) && !S_ISDIR(s.st_mode));
}

static bool read_all(int fd, struct kept *k, size_t most)
{
    for (size_t room = 0;;) {
        if (k->size == room) {
            char *more = memory_take((room = 2 * room + PIECE) + 1);
            if (k->size) memcpy(more, k->text, k->size);
            free(k->text);
            k->text = more;
        }
        ssize_t n = read(fd, k->text + k->size, room - k->size);
        if (n < 0) return false;
        k->size += (size_t)n;
        if (n == 0 || k->size > most) return true;
    }
}

static struct kept *take(const char *file, size_t most)
{
    int fd = open(file, O_RDONLY | O_CLOEXEC);
    if (fd < 0) return NULL;
    struct kept *k = memory_take(sizeof *k);
    *k = (struct kept){.next = all};
    bool ok = read_all(fd, k, most);
    int why = errno;
    close(fd);
    if (!ok) {
        free(k->text);
        free(k);
        errno = why;
        return NULL;
    }
    size_t n = strlen(file) + 1;
    k->size = k->size > most ? most + 1 : k->size;
    k->text[k->size] = '\0';
    k->file = memcpy(memory_take(n), file, n);
    return all = k;
}

const char *piped_read(const char *file, size_t most, size_t *size)
{
    pthread_mutex_lock(&lock);
    struct kept *k = all;
    while (k && strcmp(k->file, file) != 0)
        k = k->next;
    k = k ? k : take(file, most);
    pthread_mutex_unlock(&lock);
    *size = k ? k->size : 0;
    return k ? k->text : NULL;
}
