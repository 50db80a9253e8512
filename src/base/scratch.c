/* See scratch.h. Where the file system has no unnamed files, the name is taken away at once. */
#include "base/scratch.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/interrupt.h"
#include "base/memory.h"

const char *scratch_folder(void)
{
    const char *folder = getenv("TMPDIR");
    return folder && *folder ? folder : "/tmp";
}

static int named_and_forgotten(const char *folder)
{
    char name[4096];
    if (snprintf(name, sizeof name, "%s/rasp-XXXXXX", folder) >= (int)sizeof name) {
        errno = ENAMETOOLONG;
        return -1;
    }
    interrupt_hold();
    int fd = mkostemp(name, O_CLOEXEC);
    if (fd >= 0) unlink(name);
    interrupt_go();
    return fd;
}

FILE *scratch_open(void)
{
    int fd = open(scratch_folder(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
    if (fd < 0) fd = named_and_forgotten(scratch_folder());
    FILE *f = fd >= 0 ? fdopen(fd, "w+") : NULL;
    if (!f && errno == ENOMEM) memory_out("to open a temporary file");
    if (!f && fd >= 0) close(fd);
    return f;
}

const char *scratch_make_folder(const char *name, struct arena *a, struct err *e)
{
    char *path = arena_format(a, "%s/%s-XXXXXX", scratch_folder(), name);
    interrupt_hold();
    bool made = mkdtemp(path) != NULL;
    if (made) interrupt_temporary(path);
    interrupt_go();
    if (!made)
        err_set(e, ERR_CREATE,
                "%s: no temporary folder can be made there: %s; set TMPDIR to a folder that can be written",
                scratch_folder(), strerror(errno));
    return made ? path : NULL;
}
