/* All unit tests in one program: the first argument says which file's run. */
#include <stdio.h>
#include <string.h>

#define TEST(name) int name(void);
#include "table.h"
#undef TEST
#define TEST(name) {#name, name},

static const struct {
    const char *name;
    int (*run)(void);
} files[] = {
#include "table.h"
};

int main(int argc, char **argv)
{
    for (size_t i = 0; argc > 1 && i < sizeof files / sizeof files[0]; i++)
        if (!strcmp(argv[1], files[i].name)) return files[i].run();
    fprintf(stderr, "%s: no file of unit tests is called '%s' (make unit)\n", argv[0], argc > 1 ? argv[1] : "");
    return 2;
}
