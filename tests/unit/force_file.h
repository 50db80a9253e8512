/* White force in a file, for tests of what rings. */
#ifndef FORCE_FILE_H
#define FORCE_FILE_H
#include "unit.h"

/* force[n], drawn from a fixed seed, to the stream as an NPY file, which is closed. */
static inline void force_file_write(FILE *f, double *force, int n)
{
    char head[129] = {0};
    if (!f) abort();
    int used = snprintf(head + 10, 110, "{'descr': '<f8', 'fortran_order': False, 'shape': (%d,), }", n);
    memcpy(head, "\x93NUMPY\x01\x00\x76\x00", 10);
    memset(head + 10 + used, ' ', (size_t)(118 - used));
    head[127] = '\n';
    srand48(5);
    for (int i = 0; i < n; i++)
        force[i] = drand48() + drand48() + drand48() - 1.5;
    fwrite(head, 1, 128, f);
    fwrite(force, sizeof *force, (size_t)n, f);
    fclose(f);
}
#endif
