/* SIGINT and SIGTERM as a question that loops ask. The one piece of state that signal handlers need. */
#ifndef BASE_INTERRUPT_H
#define BASE_INTERRUPT_H
#include <stdbool.h>

void interrupt_catch(void);  /* the first signal is remembered, a second one ends the program at once */
bool interrupt_seen(void);

#endif
