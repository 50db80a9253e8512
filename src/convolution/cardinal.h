/* The cardinal windows of piecewise polynomial interpolation of order 1, 2, 4 over nodes at multiples of `hop` samples: window k is 1 at
   node k, 0 at all others, and those of all nodes sum to 1 at every sample.

       order 1:  1 for -1/2 <= u < 1/2                       (the nearest node)          u = n/hop - k
       order 2:  1 - |u|                                     (linear)
       order 4:  (1 - u^2)(2 - |u|)/2          for |u| <= 1  (cubic Lagrange over four nodes)
                 (1 - |u|)(2 - |u|)(3 - |u|)/6 for |u| > 1 */
#ifndef CONVOLUTION_CARDINAL_H
#define CONVOLUTION_CARDINAL_H

/* First sample of window k, k hop - order hop/2 rounded up; it has order hop samples. */
long cardinal_start(int order, int hop, long k);

/* window[order hop], the same for every k. */
void cardinal_window(int order, int hop, double *window);

#endif
