/* FFTW's planner is one for the whole program: plans are made and given up by one thread at a time. Running a plan
 * needs no lock. */
#ifndef NUM_PLANNER_H
#define NUM_PLANNER_H

/* Between these two: fftw_forget_wisdom and fftw_plan_..., or fftw_destroy_plan. */
void planner_lock(void);
void planner_unlock(void);

#endif
