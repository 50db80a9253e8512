/* Mode tables from texts, for the tests of response/. */
#ifndef TABLES_H
#define TABLES_H
#include <unistd.h>

#include "unit.h"

#include "response/modes.h"

#define COLUMNS "place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad\n"
#define SHARED "# poles: shared\n# quantity: velocity\n# source: a test\n"
#define SEPARATE "# poles: separate\n# quantity: velocity\n# source: a test\n"
#define HEAD SHARED COLUMNS

/* Reads a table from text; false with the message in e. */
static inline bool csv_table_read(const char *text, const struct modes_ask *ask, struct arena *a, struct modes *m,
                                  struct err *e)
{
    char path[] = "modes.XXXXXX";
    int fd = mkstemp(path);
    ck_assert_int_ge(fd, 0);
    ck_assert_int_eq(write(fd, text, strlen(text)), (int)strlen(text));
    close(fd);
    *e = (struct err){0};
    bool ok = modes_table(path, ask, a, m, e);
    unlink(path);
    return ok;
}

/* The same, which must be accepted; the strongest `n`, 48 kHz. */
static inline struct modes table_of(const char *text, int n, struct arena *a)
{
    struct modes m;
    struct err e;
    ck_assert_msg(csv_table_read(text, &(struct modes_ask){.strongest = n, .pairing = 0.03, .rate = 48000}, a, &m, &e),
                  "%s", e.text);
    return m;
}

static inline double table_at(const struct modes *m, double x, double y, const struct modes_point *p)
{
    return modes_at(m, &(struct modes_where){x, y, 0}, p);
}
#endif
