#include "base/child.h"

#include <signal.h>
#include <spawn.h>
#include <stddef.h>
#include <unistd.h>

#include "base/interrupt.h"

int child_spawn(pid_t *pid, const char *const argv[], const int fd[3])
{
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
    int code = posix_spawnp(pid, argv[0], &files, &how, (char *const *)argv, environ);
    interrupt_child(code == 0 ? *pid : 0);
    interrupt_go();
    posix_spawnattr_destroy(&how);
    posix_spawn_file_actions_destroy(&files);
    return code;
}
