/* See mark.h. */
#include "output/mark.h"

#include <fcntl.h>
#include <jansson.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/hash.h"

enum { HEAD = 1 << 16, TAIL = 64, END = 12 /* bytes of a PNG's last chunk */ };

static const char svg_mark[] = MARK_TEXT;

/* The chunk tEXt of PNG (RFC 2083, 4.2.3): its length, type, keyword and text, and the CRC of the last three. */
static const unsigned char png_mark[] = {0,   0,   0,   13, 't', 'E', 'X', 't', 'S',  'o',  'f',  't', 'w',
                                         'a', 'r', 'e', 0,  'r', 'a', 's', 'p', 0xe6, 0x9b, 0x35, 0x82};

struct ends { /* of a file */
    char head[HEAD], tail[TAIL];
    size_t n_head, n_tail;
};

static bool begins(const struct ends *x, const char *with)
{
    size_t n = strlen(with);
    return x->n_head >= n && memcmp(x->head, with, n) == 0;
}

/* A comment of the list INFO that rasp began. */
static bool is_sound(const struct ends *x)
{
    static const char comment[] = {'I', 'C', 'M', 'T'};
    if (!begins(x, "RIFF") && !begins(x, "RF64")) return false;
    for (const char *at = x->head, *end = x->head + x->n_head; (at = memmem(at, (size_t)(end - at), comment, 4));
         at += 4)
        if (end - at >= 12 && memcmp(at + 8, "rasp", 4) == 0) return true;
    return false;
}

/* ------------------------------------------------------------------ summaries */

/* Is it one? It lists the files of a render, and the effective scene is always one of them. */
static bool is_summary(const json_t *whole)
{
    const json_t *file;
    size_t i;
    json_array_foreach(json_object_get(whole, "files"), i, file)
    {
        const char *kind = json_string_value(json_object_get(file, "kind"));
        if (kind && !strcmp(kind, "scene") &&
            (json_object_get(whole, "real_time_factor") || json_object_get(whole, "set")))
            return true;
    }
    return false;
}

static const char *text_of(const json_t *file, const char *key)
{
    const char *text = json_string_value(json_object_get(file, key));
    return text ? text : "";
}

static bool has(const json_t *list, const char *key, const char *value)
{
    const json_t *file;
    size_t i;
    json_array_foreach(list, i, file) if (!strcmp(text_of(file, key), value)) return true;
    return false;
}

/* Adds what stays of one list of the earlier summary. */
static void add_older(json_t *older, const json_t *list, const json_t *files, const char *summary, struct arena *a)
{
    const char *slash = strrchr(summary, '/');
    char hex[HASH_TEXT];
    json_t *file;
    size_t i;
    json_array_foreach(list, i, file)
    {
        const char *name = text_of(file, "name");
        struct err unreadable = {0};
        if (strchr(name, '/') || has(files, "name", name) || has(older, "name", name)) continue;
        if (hash_file(arena_format(a, "%.*s%s", slash ? (int)(slash - summary) + 1 : 0, summary, name), hex,
                      &unreadable) &&
            !strcmp(hex, text_of(file, "sha256")))
            json_array_append_new(older, json_pack("{s:O, s:O}", "name", json_object_get(file, "name"), "sha256",
                                                   json_object_get(file, "sha256")));
    }
}

json_t *mark_older(const char *summary, const json_t *files, struct arena *a)
{
    json_t *whole = json_load_file(summary, 0, NULL), *older = json_array();
    if (is_summary(whole)) {
        add_older(older, json_object_get(whole, "files"), files, summary, a);
        add_older(older, json_object_get(whole, "older"), files, summary, a);
    }
    json_decref(whole);
    return older;
}

/* ------------------------------------------------------------------ files */

static size_t piece(int fd, char *to, size_t n, off_t at)
{
    ssize_t got = pread(fd, to, n, at);
    return got > 0 ? (size_t)got : 0;
}

static bool read_ends(const char *path, struct ends *x)
{
    struct stat s;
    int fd = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    bool ok = fd >= 0 && fstat(fd, &s) == 0 && S_ISREG(s.st_mode);
    if (ok) {
        x->n_head = piece(fd, x->head, HEAD, 0);
        x->n_tail = piece(fd, x->tail, TAIL, s.st_size > TAIL ? s.st_size - TAIL : 0);
    }
    if (fd >= 0) close(fd);
    return ok;
}

/* Does the file bear the mark, or does the summary (NULL: there is none) beside it list its bytes? */
static bool mark_is(const char *path, const char *summary)
{
    struct ends x;
    if (!read_ends(path, &x)) return false;
    bool picture = begins(&x, "\x89PNG") ? memmem(x.tail, x.n_tail, png_mark, sizeof png_mark)
                                         : memmem(x.tail, x.n_tail, svg_mark, sizeof svg_mark - 1);
    bool page = begins(&x, "<!DOCTYPE html>") && memmem(x.head, x.n_head, MARK_PAGE, sizeof MARK_PAGE - 1);
    if (picture || page || is_sound(&x)) return true;
    json_t *whole = begins(&x, "{") ? json_load_file(path, 0, NULL) : NULL;
    bool is = is_summary(whole);
    json_decref(whole);
    if (is || !summary) return is;
    /* Listed by its bytes: files may have been renamed together. */
    char hex[HASH_TEXT];
    struct err unreadable = {0};
    whole = json_load_file(summary, 0, NULL);
    is = is_summary(whole) && hash_file(path, hex, &unreadable) &&
         (has(json_object_get(whole, "files"), "sha256", hex) || has(json_object_get(whole, "older"), "sha256", hex));
    json_decref(whole);
    return is;
}

bool mark_links(const char *path, bool force, struct err *e)
{
    struct stat link, file;
    bool points = !force && lstat(path, &link) == 0 && S_ISLNK(link.st_mode),
         special = points && stat(path, &file) == 0 && !S_ISREG(file.st_mode);
    return !points || special ||
           err_set(e, ERR_CREATE, "%s is a symbolic link; --force writes to where it points", path);
}

static bool is_file(const char *path)
{
    struct stat file;
    return stat(path, &file) == 0 && S_ISREG(file.st_mode);
}

bool mark_permits(const char *path, const char *summary, bool force, struct err *e)
{
    if (!mark_links(path, force, e)) return false;
    return force || !is_file(path) || mark_is(path, summary) ||
           err_set(e, ERR_CREATE, "%s exists already, and nothing says that rasp wrote it; --force replaces it", path);
}

bool mark_absent(const char *path, bool force, struct err *e)
{
    if (!mark_links(path, force, e)) return false;
    return force || !is_file(path) || err_set(e, ERR_CREATE, "%s exists already; --force replaces it", path);
}

/* Before what ends it. */
bool mark_picture(int fd, bool svg)
{
    char end[END + 1] = "";
    const void *mark = svg ? (const void *)svg_mark : png_mark;
    size_t n = svg ? sizeof svg_mark - 1 : sizeof png_mark;
    off_t at = lseek(fd, 0, SEEK_END) - END;
    if (at < 0 || pread(fd, end, END, at) != END) return false;
    const char *from = svg ? strstr(end, "</svg>") : end;
    size_t left = from ? (size_t)(end + END - from) : 0;
    at += END - (off_t)left;
    return left > 0 && pwrite(fd, mark, n, at) == (ssize_t)n && pwrite(fd, from, left, at + (off_t)n) == (ssize_t)left;
}
