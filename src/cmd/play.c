/* rasp play: what a scene sounds like, through a program that plays sound files. */
#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/child.h"
#include "base/interrupt.h"
#include "cmd/cmd.h"
#include "file/bytes.h"
#include "file/wav.h"

/* Those that are looked for on the PATH, in this order. */
static const char *const players[][3] = {{"play", "-q"}, {"aplay", "-q"}, {"pw-play", NULL}, {"paplay", NULL}};

enum { PLAYERS = sizeof players / sizeof *players };

static bool play_sound(const char *sound, struct err *e)
{
    int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC), code = ENOENT, status = 0;
    pid_t pid = 0;
    if (nothing < 0) return err_set(e, err_system(ERR_CREATE), "/dev/null cannot be opened: %s", strerror(errno));
    int player = -1;
    while (code == ENOENT && ++player < PLAYERS) {
        const char *argv[4] = {players[player][0], players[player][1] ? players[player][1] : sound,
                               players[player][1] ? sound : NULL, NULL};
        code = child_spawn(&pid, argv, (const int[3]){nothing, STDERR_FILENO, STDERR_FILENO});
    }
    close(nothing);
    if (code == ENOENT)
        return err_set(e, ERR_UNBUILT,
                       "no program that plays sounds is on the PATH (play, aplay, pw-play, paplay): "
                       "install one (Debian: sox or alsa-utils), or write the sound with rasp render");
    if (code) return err_set(e, err_system(ERR_CREATE), "%s cannot be started: %s", players[player][0], strerror(code));
    interrupt_wait(pid, &status, NULL);
    if (interrupt_seen() || WIFSIGNALED(status)) return err_set(e, ERR_INTERRUPTED, "interrupted");
    return WEXITSTATUS(status) == 0 ||
           err_set(e, ERR_IO, "%s could not play the sound: is there a sound device? rasp render writes it to a file",
                   players[player][0]);
}

/* A sound file as it is, a scene rendered. */
static bool play_one(struct cmd_call *c, const char *file, struct err *e)
{
    char head[4] = "";
    const char *folder = NULL, *sound = file;
    int fd = bytes_piped(file) ? -1 : open(file, O_RDONLY | O_CLOEXEC);
    bool is_sound = fd >= 0 && read(fd, head, 4) == 4 && wav_begins(head);
    if (fd >= 0) close(fd);
    if (!is_sound) sound = render_scratch(c, file, &folder, e);
    bool ok = sound && play_sound(sound, e);
    render_scratch_end(folder, c->arena);
    return ok;
}

static int play_run(struct cmd_call *c, struct err *e)
{
    bool ok = true;
    for (int i = 0; ok && i < c->args.n_operands; i++)
        ok = play_one(c, c->args.operands[i], e);
    return (int)e->kind;
}

static const struct args_option options[] = {CMD_SCENE_OPTIONS, {0}};

const struct command play_command = {
    .name = "play",
    .summary = "plays scenes, or sound files",
    .does =
        "Renders each scene to a temporary file and plays it, one after another, by the first of these programs that "
        "is on the PATH: play (sox), aplay (ALSA), pw-play, paplay. A sound file is played as it is. Nothing is "
        "kept: rasp render writes files.",
    .operands = "SCENE|SOUND...",
    .least = 1,
    .most = -1,
    .options = options,
    .examples = "rasp play scenes/basswood_scrape.yaml\n"
                "rasp play scrape.yaml --set surface.material=glass --set motion.rate='3 Hz'\n"
                "rasp new wood_on_sandpaper | rasp play /dev/stdin\n",
    .run = play_run,
};
