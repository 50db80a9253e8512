/* Another program, run on our descriptors. */
#ifndef BASE_CHILD_H
#define BASE_CHILD_H
#include <sys/types.h>

/* Runs argv[0] of the PATH on three descriptors (standard input, output, error); 0 or an errno. Signals that we ignore
   or block are not by it. There is one child at a time: interrupt_wait waits for it. */
int child_spawn(pid_t *pid, const char *const argv[], const int fd[3]);

#endif
