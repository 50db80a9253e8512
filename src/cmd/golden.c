/* rasp golden: sounds and tables that are kept, and whether scenes still make them. */
#include "cmd/golden.h"

#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "cmd/actions.h"
#include "cmd/batch.h"

static bool begin(struct golden *g, struct cmd_call *c, struct err *e)
{
    *g = (struct golden){.call = c, .kept = args_value(&c->args, "kept"), .hashes = args_value(&c->args, "hashes"), .effective = args_given(&c->args, "effective"),
                         .tap = args_given(&c->args, "tap"), .quiet = args_given(&c->args, "quiet")};
    if ((g->kept && !*g->kept) || (g->hashes && !*g->hashes))
        return err_set(e, ERR_USAGE, "--%s is empty", g->kept && !*g->kept ? "kept" : "hashes");
    if (g->kept && !strcmp(g->kept, "-"))
        return err_set(e, ERR_USAGE, "--kept -: what is kept is a folder of files; one of that name is ./-");
    if (!g->kept && !g->hashes)
        g->kept = "golden";
    if (g->kept)
        g->kept = batch_folder(c->arena, g->kept);
    return batch_threads(c, &g->threads, e) && golden_list(g, e) && golden_render_folder(g, e);
}

static int run(struct cmd_call *c, int (*what)(struct golden *g, struct err *e), struct err *e)
{
    struct golden g;
    int code = begin(&g, c, e) ? what(&g, e) : (int)e->kind;
    golden_render_end(&g);
    for (int i = 0; i < g.n; i++)
        arena_close(g.scenes[i].arena);
    if (e->kind && g.tap)
        printf("Bail out! %s\n", text_shown(c->arena, e->text));
    return code;
}

static int check_run(struct cmd_call *c, struct err *e) { return run(c, golden_check, e); }
static int update_run(struct cmd_call *c, struct err *e) { return run(c, golden_update, e); }

static const struct action actions[] = {
    {"check", "LIST|SCENE.yaml...", 1, -1,
     {"kept", "hashes", "output", "jobs", "effective", "tap", "quiet", "snr", "lsb", "third-octave", "within", "tolerance", "column", "abs", "rel"}, check_run},
    {"update", "LIST|SCENE.yaml...", 1, -1, {"kept", "hashes", "jobs", "force", "quiet"}, update_run},
    {NULL, NULL, 0, 0, {NULL}, NULL},
};

static int golden_run(struct cmd_call *c, struct err *e)
{
    return actions_run("golden", actions, c, e);
}

static const struct args_option options[] = {
    {"kept", 'k', "FOLDER", false, "where the files are kept, FOLDER/NAME/sound.wav and so on; default: golden, unless --hashes is given"},
    {"hashes", 0, "FILE", false, "keeps their SHA-256 in FILE, as sha256sum writes them; with --kept both, alone the hashes only"},
    {"output", 'o', "FOLDER", false, "check: what was rendered of a scene that fails stays there, to be listened to"},
    {"jobs", 'j', "N", false, "how many scenes are rendered at once, 1 to 256; default: one for each core"},
    {"effective", 0, NULL, false, "check: renders each scene's effective scene, too, which has to make the same"},
    {"tap", 0, NULL, false, "check: prints the Test Anything Protocol, version 13"},
    COMPARE_SOUND_LIMITS,
    COMPARE_TABLE_LIMITS,
    {"force", 'f', NULL, false, "update: replaces files in FOLDER that rasp did not write, and writes through symbolic links"},
    {"quiet", 'q', NULL, false, "prints only what fails"},
    {0}};

const struct command golden_command = {
    .name = "golden",
    .summary = "keep what scenes make, and check that they still do",
    .does = "rasp golden update LIST renders every scene, then every scene again, and keeps the sounds and tables; where the two renders of one have not the same bytes, "
            "nothing is written and the exit code is 1. rasp golden check LIST renders every scene and compares with what is kept: the same bytes, or, where the command or a "
            "line of the list gives limits (as of rasp compare), within these. Of a file that is not, rasp compare's report says how far it is off.\n"
            "LIST is a text file, one scene a line, with its own options behind it (limits, --set KEY=VALUE, --seed, and --name, for a scene that stands there twice); # begins a comment, "
            "and names of files start at the list's folder. An operand that ends in .yaml is a scene itself. What is kept is called by the scene's name without .yaml.\n"
            "check fails where nothing is kept of a scene (and says what makes it), where a kept file is not made any more, where a list is empty, and, when all operands are lists, "
            "where something is kept that no scene of theirs makes. With --kept and --hashes, the kept files must have the kept hashes. The exit code is 0 when all is as kept, 1 when it is "
            "not, and where a scene could not be rendered that render's own; the others are checked all the same.",
    .operands = "ACTION LIST|SCENE.yaml...",
    .least = 1,
    .most = -1,
    .options = options,
    .actions = actions,
    .examples = "rasp golden update scenes/strike.yaml\n"
                "rasp golden check scenes/strike.yaml\n"
                "printf 'strike.yaml\\nforces_only.yaml --rel 1e-9  # a table\\n' > scenes/list.txt\n"
                "rasp golden update scenes/list.txt --kept out/golden\n"
                "rasp golden check --tap scenes/list.txt --kept out/golden\n"
                "rasp golden update scenes/strike.yaml --hashes golden.sha256   # a line a file; nothing else is kept\n"
                "rasp golden check scenes/strike.yaml --hashes golden.sha256\n",
    .run = golden_run,
};
