/* How far a mass on a damped spring lags behind the ground that it follows, from the ground's vertical acceleration
   alone. */
#ifndef FORCE_ROLL_FOLLOW_H
#define FORCE_ROLL_FOLLOW_H

struct roll_follow {
    double step[3][2]; /* of (y, dt y', mean y) by y and dt y' before              */
    double push[3][2]; /* s^2, of the same by the acceleration at start and end    */
    double dt;         /* s                                                        */
    double y, rate;    /* m, m/s: how deep the ground presses in, and its rate now */
};

/* y'' + damping y' + resonance^2 y = acceleration, in steps of dt (s), from y = y' = 0 on. resonance rad/s, damping
   1/s. */
struct roll_follow roll_follow_make(double resonance, double damping, double dt);

/* One step, in which the acceleration (m/s^2) goes in a straight line from `start` to `end`. Gives the mean of y over
   it, m. */
double roll_follow_step(struct roll_follow *f, double start, double end);

#endif
