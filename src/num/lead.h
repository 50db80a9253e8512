/* What a linear-phase filter makes of a signal before that signal begins: its lead, of y[n] the part at n < 0.

   There is no sample for it, since nothing sounds before its cause: not at the file's start, nor at a contact's. Cut
   off, it takes momentum along, or leaves too much: of an impulse within the first sample, whose lead is (-1)^n/n or
   so, up to 15 %. So it is folded into the first samples:

     y[m - 1] += y[-m],   m >= 1           reflected half a sample before the start: the sum stays what it is, exactly
     y[0..b) += d/b^2,   y[b..2b) -= d/b^2,   d = sum (2 m - 1) y[-m]

   The reflection comes later by d, which the second line takes back, over a time b as short as the filter lets through.

   Momentum (the sum) and time of arrival (the first moment) are then those of the whole filter's output.

   Why reflected: a lead alternates from sample to sample, and half a sample beside its mirror image it takes the most
   of itself away. Largest error of the spectrum, relative to that of an impulse within the first three samples, four
   sub-intervals a sample (the true kernel of filter_decimator), at 0.001, 0.01, 0.1, 0.2, 0.3 of the rate:

     cut off                               -17  -17  -17  -16  -14 dB, that is 1.2 dB of level
     added to y[0]                         -64  -44  -24  -18  -13
     reflected about y[0]                  -58  -38  -18  -12   -8
     reflected half a sample before        -70  -50  -30  -23  -17
     that, with the first moment           -115 -74  -34  -22  -14   0.2 dB of level up to 0.1, 1.6 dB up to 0.3
     by three moments on y[0..2]           -136 -96  -39  -21  -11   what does not alternate becomes a spike */
#ifndef NUM_LEAD_H
#define NUM_LEAD_H

/* lead[m - 1], m = 1..n, holds y[-m]; it becomes what y[m - 1] is to be raised by. apart: b, 2 b <= n; 0: the first
   moment is left as the reflection has it. That is right where the lead is a smoothing's, which is of one sign: without
   coming before the start it cannot but come later. */
void lead_fold(double *lead, long n, long distance);

#endif
