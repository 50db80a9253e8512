/* Seconds, and predicted cycles, that only go forward. */
#ifndef BASE_STOPWATCH_H
#define BASE_STOPWATCH_H

double stopwatch_wall(void); /* s, monotonic, from an arbitrary start      */
double stopwatch_cpu(void);  /* s of CPU time of the calling thread so far */

/* A clock that goes by what is done, the same on every machine and in every run: predicted cycles (one core with
   256-bit vectors) of what the calling thread has done so far. Whoever does much tells it, once the size is known. */
double stopwatch_cycles(void);
void stopwatch_spend(double cycles);

#endif
