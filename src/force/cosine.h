/* The shape of an impact: a raised cosine (papers/002 equation 9). */
#ifndef FORCE_COSINE_H
#define FORCE_COSINE_H

/* Share, 0 to 1, of its area that it has covered at q = (t - middle) / duration: 0 up to -1/2, 1 from 1/2 on; absolute
   error <= 4e-16. The area is amplitude duration / 2. */
double cosine_share(double q);

/* The same of q[n], in place, n <= COSINE_MOST. Both are 0 and 1 exactly before and after the impact; between they may
 * differ by rounding. */
enum { COSINE_MOST = 64 };
void cosine_shares(int n, double *q);

#endif
