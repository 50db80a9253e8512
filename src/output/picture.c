#include "output/picture.h"

#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/outfile.h"
#include "output/mark.h"

/* gnuplot does not notice a full disk: is the last thing of the format there? */
static bool picture_whole(int fd, bool svg)
{
    char tail[13] = "";
    struct stat s;
    if (fstat(fd, &s) != 0 || s.st_size < 12 || pread(fd, tail, 12, s.st_size - 12) != 12) return false;
    return svg ? strstr(tail, "</svg>") != NULL : memcmp(tail + 4, "IEND", 4) == 0;
}

bool picture_draw(struct outfile *o, const char *target, bool svg, void (*draw)(void *self, struct gnuplot *g),
                  void *self, struct err *e)
{
    struct gnuplot g;
    if (!outfile_open_fd(o, target, e)) return false;
    if (!gnuplot_open(&g, o->fd, e)) {
        outfile_drop(o);
        return false;
    }
    draw(self, &g);
    bool ok = gnuplot_close(&g, e);
    if (ok && (!picture_whole(o->fd, svg) || !mark_picture(o->fd, svg)))
        ok = err_set(e, ERR_IO, "%s: cannot be written whole (is the disk full?)", target);
    if (!ok) outfile_drop(o);
    return ok;
}

bool picture_write(const char *target, bool svg, void (*draw)(void *self, struct gnuplot *g), void *self, struct err *e)
{
    struct outfile o;
    return picture_draw(&o, target, svg, draw, self, e) && outfile_commit(&o, e);
}
