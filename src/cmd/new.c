/* rasp new: a starter scene. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/memory.h"
#include "base/outfile.h"
#include "base/relpath.h"
#include "base/text.h"
#include "cmd/cmd.h"
#include "cmd/starters.h"
#include "output/mark.h"

static int list(void)
{
    for (const struct starter *s = starters_table; s->name; s++)
        printf("%-12s %s\n", s->name, s->summary);
    return 0;
}

static bool unknown(const char *name, struct err *e)
{
    const char *names[32] = {NULL};
    for (int i = 0; starters_table[i].name && i < 31; i++)
        names[i] = starters_table[i].name;
    const char *meant = text_nearest(name, names);
    if (meant)
        return err_set(e, ERR_USAGE, "no starter scene '%s'; did you mean '%s'? (rasp new --list shows all)", name,
                       meant);
    return err_set(e, ERR_USAGE, "no starter scene '%s'; rasp new --list shows all", name);
}

/* "/usr/bin/" of the running program; "": nobody knows. */
static const char *own_folder(struct arena *a)
{
    char self[4096];
    ssize_t n = readlink("/proc/self/exe", self, sizeof self - 1);
    self[n > 0 ? n : 0] = '\0';
    char *slash = strrchr(self, '/');
    return slash ? arena_format(a, "%.*s", (int)(slash - self) + 1, self) : "";
}

/* The folder of the shipped responses, as a scene in `folder` calls it: seen from there where rasp was built in its
   source tree, else as it was installed, else of a source tree that is the current folder. */
static const char *irs_seen(const char *folder, struct arena *a)
{
    const char *self = own_folder(a), *tree = arena_format(a, "%s../irs", self),
               *installed = arena_format(a, "%s../share/rasp/irs", self);
    if (*self && access(arena_format(a, "%s/README.md", tree), F_OK) == 0) return relpath_make(tree, folder, a);
    char *real = *self ? memory_realpath(installed) : NULL;
    const char *seen = real                                 ? arena_text(a, real)
                       : access("irs/README.md", F_OK) == 0 ? relpath_make("irs", folder, a)
                                                            : "irs";
    free(real);
    return seen;
}

static bool write_file(const struct starter *s, const char *file, bool force, struct arena *a, struct err *e)
{
    struct outfile o;
    const char *slash = strrchr(file, '/'),
               *folder = slash ? arena_format(a, "%.*s", slash == file ? 1 : (int)(slash - file), file) : NULL;
    if (!mark_absent(file, force, e) || !outfile_open(&o, file, e)) return false;
    starters_print(o.stream, s, irs_seen(folder, a), a);
    return outfile_commit(&o, e);
}

static int new_run(struct cmd_call *c, struct err *e)
{
    const char *name = c->args.n_operands ? c->args.operands[0] : starters_table[0].name;
    const char *file = args_value(&c->args, "output");
    const struct starter *s = starters_find(name);
    if (args_given(&c->args, "list")) return list();
    if (!s)
        unknown(name, e);
    else if (file && !strcmp(file, "-"))
        err_set(e, ERR_USAGE,
                "--output -: leave it out, and the scene goes to standard output; a file of that name is ./-");
    else if (file)
        write_file(s, file, args_given(&c->args, "force"), c->arena, e);
    else
        starters_print(stdout, s, irs_seen(NULL, c->arena), c->arena);
    return 0;
}

static const struct args_option options[] = {
    {"output", 'o', "FILE", false, "the file to write; without it the scene goes to standard output"},
    {"force", 'f', NULL, false, "replaces FILE if it exists"},
    {"list", 0, NULL, false, "lists the starters"},
    {0},
};

const struct command new_command = {
    .name = "new",
    .summary = "writes a commented starter scene",
    .does = "Writes the starter scene NAME (scrape, if none is named), with every line explained. It can be rendered "
            "as it is; for sound, remove the # before a response, which names a file of rasp's irs/ "
            "that fits the motion (seen from the folder of FILE, or from the current one). NAME design is a starter "
            "design of a set of stimuli (rasp-design(5)), whose base is the scene scrape.yaml beside it.",
    .operands = "[NAME]",
    .least = 0,
    .most = 1,
    .options = options,
    .examples = "rasp new --list                  # which there are\n"
                "rasp new -o scrape.yaml          # the default\n"
                "rasp new grip -o grip.yaml       # a tool held in the hand\n"
                "rasp new design -o set.yaml      # four conditions of scrape.yaml, twice each, for rasp batch\n",
    .run = new_run,
};
