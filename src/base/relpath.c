/* See relpath.h. `..` is a matter of real folders, not of text, hence realpath(3). */
#include "base/relpath.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/memory.h"

static const char *real_one(const char *folder, struct arena *a)
{
    char *real = memory_realpath(folder);
    const char *copy = real ? arena_text(a, real) : NULL;
    free(real);
    return copy;
}

/* Of a folder that is not there, or whose own cannot be looked into, as far as it is, then by its names. */
static const char *real_folder(const char *folder, struct arena *a)
{
    const char *at = real_one(*folder ? folder : ".", a);
    if (at) return at;
    at = *folder == '/' ? "/" : real_one(".", a);
    for (size_t n; at && *folder; folder += n + (folder[n] == '/')) {
        n = strcspn(folder, "/");
        const char *slash = strrchr(at, '/');
        if (n == 0 || (n == 1 && *folder == '.')) continue;
        const char *next = n == 2 && !strncmp(folder, "..", 2)
                               ? (slash == at ? "/" : arena_format(a, "%.*s", (int)(slash - at), at))
                               : arena_format(a, "%s/%.*s", strcmp(at, "/") ? at : "", (int)n, folder);
        const char *real = real_one(next, a);
        at = real ? real : next;
    }
    return at;
}

/* Length of the leading folders that two absolute paths share: /a/b and /a/bc share "/a". */
static size_t shared(const char *x, const char *y)
{
    size_t last = 0, i = 0;
    for (; x[i] && x[i] == y[i]; i++)
        if (x[i] == '/') last = i;
    if ((!x[i] || x[i] == '/') && (!y[i] || y[i] == '/')) last = i;
    return last;
}

const char *relpath_folder(const char *file, struct arena *a)
{
    const char *slash = strrchr(file, '/');
    return slash ? arena_format(a, "%.*s", slash == file ? 1 : (int)(slash - file), file) : ".";
}

const char *relpath_stem(const char *file, struct arena *a)
{
    const char *name = basename(file), *dot = strrchr(name, '.');
    return arena_format(a, "%.*s", (int)(dot && dot > name ? (size_t)(dot - name) : strlen(name)), name);
}

const char *relpath_make(const char *file, const char *folder, struct arena *a)
{
    const char *from = real_folder(folder ? folder : ".", a), *to = real_folder(relpath_folder(file, a), a);
    const char *name = basename(file);
    char here[PATH_MAX];
    if (!from || !to)
        return file[0] == '/' || !getcwd(here, sizeof here) ? arena_text(a, file)
                                                            : arena_format(a, "%s/%s", here, file);
    if (!strcmp(from, to)) return arena_text(a, name);
    size_t n = shared(from, to);
    if (n == 0) return arena_format(a, "%s/%s", strcmp(to, "/") ? to : "", name);
    const char *up = "";
    for (const char *p = from + n; *p; p++)
        if (*p == '/' && p[1]) up = arena_format(a, "../%s", up);
    return arena_format(a, "%s%s%s%s", up, to[n] ? to + n + 1 : "", to[n] ? "/" : "", name);
}

const char *relpath_base(const char *file, struct arena *a)
{
    const char *slash = strrchr(file, '/'), *dot = strrchr(slash ? slash : file, '.');
    return dot ? arena_format(a, "%.*s", (int)(dot - file), file) : file;
}
