/* See claim.h. The file is read and written under a lock of its own (flock), held for that time only: of two that begin at once, one is first. Who is at work
   is told by folder_enter's lock, which cannot be had alone while another has it; nobody can enter while the first lock is held. */
#include "batch/claim.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/hash.h"
#include "base/memory.h"
#include "base/relpath.h"
#include "base/text.h"
#include "batch/folder.h"
#include "file/piped.h"

enum { MOST = 4096 + 256 + HASH_TEXT /* bytes of the file */ };

struct owner {
    char text[MOST + 1];
    const char *sha256, *place;  /* in text; NULL: the file is not there, or not whole */
    const char *build;           /* "": an earlier program's, which did not say it */
};

static void parse(struct owner *o, ssize_t n)
{
    o->sha256 = o->place = NULL;
    if (n <= HASH_TEXT || o->text[HASH_TEXT - 1] != '\n' || o->text[n - 1] != '\n')
        return;
    o->text[HASH_TEXT - 1] = o->text[n - 1] = '\0';
    o->sha256 = o->text;
    o->place = o->text + HASH_TEXT;
    char *end = strrchr(o->text + HASH_TEXT, '\n');
    o->build = end ? end + 1 : "";
    if (end)
        *end = '\0';
}

static const char piped[] = "-";

const char *claim_place(const char *design, const char *folder, struct arena *a)
{
    if (!piped_is(design))
        return text_shown(a, relpath_make(design, folder, a));
    char *real = memory_realpath(folder);
    const char *place = arena_format(a, "%s %s", piped, text_shown(a, real ? real : folder));
    free(real);
    return place;
}

static const char *place_of(const struct claim *c, struct arena *a)
{
    return piped_is(c->design) ? piped : claim_place(c->design, c->folder, a);
}

static const char *seen_from_here(const struct claim *c, const char *place, struct arena *a)
{
    if (!strcmp(place, piped))
        return "one that came through a pipe";
    return place[0] == '/' ? place : relpath_make(arena_format(a, "%s/%s", c->folder, place), NULL, a);
}

/* Of another design? */
static bool is_free(const struct claim *c, const struct owner *o, struct arena *a, struct err *e)
{
    static const char what[] = "choose another folder with -o, or say --replace, and the folder is this design's from now on";
    if (c->replace || !o->sha256)
        return true;
    const char *place = place_of(c, a);
    if (!strcmp(o->sha256, c->sha256) || (strcmp(place, piped) != 0 && !strcmp(o->place, place)))
        return true;
    return err_set(e, ERR_CREATE, "%s: holds the set of another design, %s: %s", c->folder, seen_from_here(c, o->place, a), what);
}

static void look(const char *folder, struct arena *a, struct owner *o)
{
    int fd = open(arena_format(a, "%s/.rasp/design", folder), O_RDONLY | O_CLOEXEC);
    parse(o, fd < 0 ? 0 : pread(fd, o->text, MOST, 0));
    if (fd >= 0)
        close(fd);
}

bool claim_is_noted(const char *folder, struct arena *a)
{
    struct owner o;
    look(folder, a, &o);
    return o.sha256 != NULL;
}

bool claim_holds(const char *folder, const char *sha256, struct arena *a)
{
    struct owner o;
    look(folder, a, &o);
    return o.sha256 && strcmp(o.sha256, sha256) == 0;
}

bool claim_look(const struct claim *c, struct arena *a, struct err *e)
{
    struct owner o;
    look(c->folder, a, &o);
    return is_free(c, &o, a, e);
}

/* Enters, and sees whether that is alone. */
static bool enter(const struct claim *c, const struct owner *o, int *entered, struct err *e)
{
    bool same = o->sha256 && !strcmp(o->sha256, c->sha256) && !strcmp(o->build, c->build);
    *entered = folder_enter(c->folder);
    if (same || *entered < 0)
        return true;
    if (folder_is_mine(*entered) && flock(*entered, LOCK_SH) == 0)
        return true;
    return err_set(e, ERR_CREATE, "%s: another rasp is at work in it, for another design, an earlier state of this one, or of another version: wait until it has ended, or choose another folder with -o",
                   c->folder);
}

static bool note(const struct claim *c, const struct owner *o, int fd, struct arena *a, struct err *e)
{
    const char *place = place_of(c, a), *text = arena_format(a, "%s\n%s\n%s\n", c->sha256, place, c->build);
    size_t n = strlen(text);
    if (o->sha256 && !strcmp(o->sha256, c->sha256) && !strcmp(o->place, place) && !strcmp(o->build, c->build))
        return true;
    if (n > MOST)
        return err_set(e, ERR_CREATE, "%s: the path is too long", c->design);
    errno = ENOSPC; /* where less is written than was asked for */
    if (pwrite(fd, text, n, 0) == (ssize_t)n && ftruncate(fd, (off_t)n) == 0)
        return true;
    return err_set(e, err_system(ERR_CREATE), "%s/.rasp/design: cannot be written: %s", c->folder, strerror(errno));
}

/* The file, locked until it is closed. -1: *e */
static int open_owner(const struct claim *c, struct arena *a, struct owner *o, struct err *e)
{
    const char *path = arena_format(a, "%s/.rasp/design", c->folder);
    int fd = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (fd < 0) {
        err_set(e, err_system(ERR_CREATE), "%s: cannot be written: %s", path, strerror(errno));
        return -1;
    }
    flock(fd, LOCK_EX); /* where there are no locks, two that begin at once are not told apart */
    parse(o, pread(fd, o->text, MOST, 0));
    return fd;
}

bool claim_enter(const struct claim *c, struct arena *a, int *entered, struct err *e)
{
    struct owner o;
    *entered = -1;
    int fd = open_owner(c, a, &o, e);
    bool ok = fd >= 0 && is_free(c, &o, a, e) && enter(c, &o, entered, e) && note(c, &o, fd, a, e);
    if (fd >= 0)
        close(fd);
    return ok;
}

bool claim_join(const struct claim *c, struct arena *a, int *entered, struct err *e)
{
    struct owner o;
    *entered = -1;
    int fd = open_owner(c, a, &o, e);
    bool ok = fd >= 0 && (!o.sha256 || !strcmp(o.sha256, c->sha256) || err_set(e, ERR_INPUT, "%s: holds another state of the set by now than its shards: run the shards again", c->folder)) &&
              enter(c, &o, entered, e);
    if (fd >= 0)
        close(fd);
    return ok;
}
