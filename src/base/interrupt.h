/* SIGINT and SIGTERM end the program within half a second, whatever it does, with exit code 75 (ERR_INTERRUPTED).

   Both are blocked in every thread but one, which waits for them. At the first signal interrupt_seen() becomes true:
   loops that ask it end in order, with words and records of their own. A program that has not ended 0.25 s later, or
   that gets a second signal, is ended by the thread that waits: it kills the child, removes the temporaries that are
   noted here, says so, and exits. What it leaves otherwise is what SIGKILL leaves. That works wherever the program may
   be: in a long computation, in a library, in a read of a pipe that nobody writes. */
#ifndef BASE_INTERRUPT_H
#define BASE_INTERRUPT_H
#include <stdbool.h>
#include <sys/resource.h>
#include <sys/types.h>

void interrupt_catch(void); /* from now on; by main, before there are threads */
bool interrupt_seen(void);

/* Signals are left to the program that is executed next, which catches them in its turn. False: one has come already.
 */
bool interrupt_pass_on(void);

/* Between these two, in any thread, the program is not ended: files get and change their names together. Never for
 * long; they may be nested. */
void interrupt_hold(void);
void interrupt_go(void);

/* Notes a temporary file, or folder with all that is in it: it goes when the program is ended, by a signal or for want
 * of memory. Made and noted within one hold, it is never left behind. */
void interrupt_temporary(const char *path);
void interrupt_forget(const char *path); /* it is gone, or has another name */
void interrupt_remove(void);             /* removes all of them: the program ends next */

/* The child, of which there is one at a time; begun and noted within one hold. interrupt_wait waits until it is over,
 * and returns what wait4 does. */
void interrupt_child(pid_t pid);
pid_t interrupt_wait(pid_t pid, int *status, struct rusage *used);

/* May the interruption be reported? Only the first who asks may: in an orderly end or in the other, and then has 0.1 s
   for its words. It does not return where the program is being ended. */
void interrupt_report(void);

#endif
