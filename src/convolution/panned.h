/* Several impulse responses at once, each fed with its share of the force: y = sum_k h_k * (w_k f). Recorded responses at places (shares from
   places.h) and Chebyshev's nodes along a straight motion (nodes.h) are this. No hop: the shares move from sample to sample. */
#ifndef CONVOLUTION_PANNED_H
#define CONVOLUTION_PANNED_H
#include <stddef.h>

struct panned;

enum { PANNED_BLOCK = 4096 };   /* frames that are asked for at once, at multiples of it; k runs from 0 to n - 1 in between */

/* share(self, first, n, k, w): writes the share of response k at frames first .. first + n - 1 (the last block may reach beyond the end of the
   sound); returns 0 when all are 0 (w is then not read). Not asked where there is no force in the whole block. */
typedef int panned_share(void *self, long first, int n, int k, double *w);
/* response(self, k, h, length): as overlap_add_response; asked for once, when first needed. */
typedef void panned_response(void *self, int k, double *h, size_t length);

struct panned_source {
    int n;                  /* responses */
    size_t length;          /* samples of the longest */
    panned_share *share;
    panned_response *response;
    void *self;
};

/* Memory (bytes) that n responses of so many samples take once all are in use. */
double panned_bytes(int n, size_t length);

struct panned *panned_open(const struct panned_source *source);
void panned_close(struct panned *p);
int panned_ahead(const struct panned *p);   /* as overlap_add_ahead */
void panned_run(struct panned *p, const double *f, double *y, long frames); /* as overlap_add_run; one inverse transform per block */

#endif
