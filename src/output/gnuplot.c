#include "output/gnuplot.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/interrupt.h"
#include "base/scratch.h"

/* Runs gnuplot on three descriptors; 0 or an errno. Signals that we ignore or block are not by it. */
static int spawn(pid_t *pid, const int fd[3])
{
    char *argv[] = {(char[]){"gnuplot"}, (char[]){"-d"}, NULL};
    posix_spawn_file_actions_t files;
    posix_spawnattr_t how;
    sigset_t pipes, none;
    sigemptyset(&none);
    sigemptyset(&pipes);
    sigaddset(&pipes, SIGPIPE);
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&how);
    posix_spawnattr_setsigdefault(&how, &pipes);
    posix_spawnattr_setsigmask(&how, &none);
    posix_spawnattr_setflags(&how, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
    for (int k = 0; k < 3; k++)
        posix_spawn_file_actions_adddup2(&files, fd[k], k);
    interrupt_hold();
    int code = posix_spawnp(pid, argv[0], &files, &how, argv, environ);
    interrupt_child(code == 0 ? *pid : 0);
    interrupt_go();
    posix_spawnattr_destroy(&how);
    posix_spawn_file_actions_destroy(&files);
    return code;
}

bool gnuplot_open(struct gnuplot *g, int output, struct err *e)
{
    int ends[2], code;
    *g = (struct gnuplot){.complaints = scratch_open()};
    if (!g->complaints || pipe2(ends, O_CLOEXEC) != 0) {
        if (g->complaints) fclose(g->complaints);
        return err_set(e, err_system(ERR_CREATE), "gnuplot cannot be started: %s", strerror(errno));
    }
    code = spawn(&g->pid, (const int[3]){ends[0], output, fileno(g->complaints)});
    close(ends[0]);
    g->in = code == 0 ? fdopen(ends[1], "w") : NULL;
    if (g->in) return true;
    close(ends[1]);
    fclose(g->complaints);
    if (code == 0) interrupt_wait(g->pid, NULL, NULL);
    if (code == ENOENT || code == EACCES)
        return err_set(
            e, ERR_UNBUILT,
            "the program gnuplot draws the plot and is not on the PATH: install it (Debian: gnuplot-nox and, for the "
            "labels, fonts-dejavu-core)");
    return err_set(e, err_system(ERR_CREATE), "gnuplot cannot be started: %s", strerror(code ? code : errno));
}

/* The first line of what it complained about that holds more than blanks and the mark of a column. */
static void first_complaint(FILE *f, char *line, int size)
{
    rewind(f);
    while (fgets(line, size, f)) {
        line[strcspn(line, "\n")] = '\0';
        if (line[strspn(line, " \t^")]) return;
    }
    snprintf(line, (size_t)size, "it said nothing");
}

bool gnuplot_close(struct gnuplot *g, struct err *e)
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
        first_complaint(g->complaints, line, sizeof line);
        err_set(e, ERR_IO, "gnuplot failed: %s", line);
    }
    fclose(g->complaints);
    return ok;
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
