/* See relpath.h. `..` is a matter of real folders, not of text, hence realpath(3). */
#include "base/relpath.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/memory.h"

static const char *real_folder(const char *folder, struct arena *a)
{
    char *real = memory_realpath(*folder ? folder : ".");
    const char *kept = real ? arena_text(a, real) : NULL;
    free(real);
    return kept;
}

static const char *absolute(const char *file, struct arena *a)
{
    char here[PATH_MAX];
    if (file[0] == '/' || !getcwd(here, sizeof here))
        return arena_text(a, file);
    return arena_format(a, "%s/%s", here, file);
}

/* Length of the leading folders that two absolute paths share: /a/b and /a/bc share "/a". */
static size_t shared(const char *x, const char *y)
{
    size_t last = 0, i = 0;
    for (; x[i] && x[i] == y[i]; i++)
        if (x[i] == '/')
            last = i;
    if ((!x[i] || x[i] == '/') && (!y[i] || y[i] == '/'))
        last = i;
    return last;
}

const char *relpath_make(const char *file, const char *folder, struct arena *a)
{
    const char *slash = strrchr(file, '/'), *name = slash ? slash + 1 : file;
    const char *home = slash ? arena_format(a, "%.*s", slash == file ? 1 : (int)(slash - file), file) : ".";
    const char *from = real_folder(folder ? folder : ".", a), *to = real_folder(home, a);
    if (!from || !to)
        return absolute(file, a);
    if (!strcmp(from, to))
        return arena_text(a, name);
    size_t n = shared(from, to);
    if (n == 0)
        return arena_format(a, "%s/%s", strcmp(to, "/") ? to : "", name);
    const char *up = "";
    for (const char *p = from + n; *p; p++)
        if (*p == '/' && p[1])
            up = arena_format(a, "../%s", up);
    return arena_format(a, "%s%s%s%s", up, to[n] ? to + n + 1 : "", to[n] ? "/" : "", name);
}
