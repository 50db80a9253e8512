/* What a program says that ends here and now: one line on standard error, made without memory, by any thread. */
#ifndef BASE_LASTWORDS_H
#define BASE_LASTWORDS_H
#include "base/err.h"

/* From now on that line is a JSON object, as of rasp's --diagnostics=json (cmd/message.h). Before there are threads. */
void lastwords_as_json(void);

/* "rasp: error: text". Standard error that takes nothing for 0.1 s gets nothing. */
void lastwords(enum err_kind kind, const char *text);

#endif
