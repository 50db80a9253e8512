#include "output/gnuplot.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/child.h"
#include "base/interrupt.h"
#include "base/outfile.h"
#include "output/mark.h"

/* Its standard output goes to the descriptor; no initialisation file is read. ERR_UNBUILT: it is not installed. */
static bool start(struct gnuplot *g, int output, struct err *e)
{
    int ends[2], code;
    *g = (struct gnuplot){.complaints = outfile_scratch_open()};
    if (!g->complaints || pipe2(ends, O_CLOEXEC) != 0) {
        if (g->complaints) fclose(g->complaints);
        return err_set(e, err_system(ERR_CREATE), "gnuplot cannot be started: %s", strerror(errno));
    }
    code = child_spawn(&g->pid, (const char *const[]){"gnuplot", "-d", NULL},
                       (const int[3]){ends[0], output, fileno(g->complaints)});
    close(ends[0]);
    g->in = code == 0 ? fdopen(ends[1], "w") : NULL;
    if (g->in) return true;
    close(ends[1]);
    fclose(g->complaints);
    if (code == 0) interrupt_wait(g->pid, NULL, NULL);
    if (code == ENOENT || code == EACCES)
        return err_set(e, ERR_UNBUILT,
                       "the program gnuplot draws the plot and is not on the PATH: install it (Debian: gnuplot-nox "
                       "and, for the labels, fonts-dejavu-core)");
    return err_set(e, err_system(ERR_CREATE), "gnuplot cannot be started: %s", strerror(code ? code : errno));
}

/* Ends its input and waits. ERR_IO with the first line of its complaints that holds more than blanks and the mark of a
   column. */
static bool finish(struct gnuplot *g, struct err *e)
{
    char line[400];
    int status = 0;
    bool taken = fclose(g->in) == 0; /* false: it ended before it had read all */
    interrupt_wait(g->pid, &status, NULL);
    bool ok = taken && WIFEXITED(status) && WEXITSTATUS(status) == 0;
    if (!ok &&
        (interrupt_seen() || (WIFSIGNALED(status) && (WTERMSIG(status) == SIGINT || WTERMSIG(status) == SIGTERM))))
        err_set(e, ERR_INTERRUPTED, "interrupted; run the same command again");
    else if (!ok) {
        bool says = false;
        rewind(g->complaints);
        while (!says && fgets(line, sizeof line, g->complaints)) {
            line[strcspn(line, "\n")] = '\0';
            says = line[strspn(line, " \t^")];
        }
        err_set(e, ERR_IO, "gnuplot failed: %s", says ? line : "it said nothing");
    }
    fclose(g->complaints);
    return ok;
}

bool gnuplot_draw(struct outfile *o, const char *target, bool svg, void (*draw)(void *self, struct gnuplot *g),
                  void *self, struct err *e)
{
    struct gnuplot g;
    if (!outfile_open_fd(o, target, e)) return false;
    if (!start(&g, o->fd, e)) {
        outfile_drop(o);
        return false;
    }
    draw(self, &g);
    bool ok = finish(&g, e);
    /* gnuplot does not notice a full disk: is the last thing of the format there? */
    char tail[13] = "";
    struct stat s;
    bool whole = ok && fstat(o->fd, &s) == 0 && s.st_size >= 12 && pread(o->fd, tail, 12, s.st_size - 12) == 12 &&
                 (svg ? strstr(tail, "</svg>") != NULL : memcmp(tail + 4, "IEND", 4) == 0);
    if (ok && (!whole || !mark_picture(o->fd, svg)))
        ok = err_set(e, ERR_IO, "%s: cannot be written whole (is the disk full?)", target);
    if (!ok) outfile_drop(o);
    return ok;
}

bool gnuplot_write(const char *target, bool svg, void (*draw)(void *self, struct gnuplot *g), void *self, struct err *e)
{
    struct outfile o;
    return gnuplot_draw(&o, target, svg, draw, self, e) && outfile_commit(&o, e);
}

void gnuplot_put_text(struct gnuplot *g, const char *text)
{
    fputc('\'', g->in);
    for (const char *p = text; *p; p++) {
        if (*p == '\'') fputc('\'', g->in);
        fputc((unsigned char)*p < ' ' || *p == 127 ? '?' : *p, g->in);
    }
    fputc('\'', g->in);
}

void gnuplot_page(struct gnuplot *g, bool svg, int width, int height)
{
    fprintf(g->in, "set terminal %s size %d,%d font 'DejaVu Sans,%d' background rgb 'white'\n",
            svg ? "svg" : "pngcairo", width, height, svg ? 13 : 10);
    fputs("set encoding utf8\nset border linewidth 0.8\nset tics out nomirror scale 0.6\n", g->in);
}

void gnuplot_put_setting(struct gnuplot *g, const char *setting, const char *text)
{
    fprintf(g->in, "set %s ", setting);
    gnuplot_put_text(g, text);
    fputs(" noenhanced\n", g->in);
}
