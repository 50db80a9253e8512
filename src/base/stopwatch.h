/* Seconds that only go forward. */
#ifndef BASE_STOPWATCH_H
#define BASE_STOPWATCH_H

double stopwatch_wall(void); /* s, monotonic, from an arbitrary start      */
double stopwatch_cpu(void);  /* s of CPU time of the calling thread so far */

#endif
