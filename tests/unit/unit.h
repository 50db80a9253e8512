/* A file of unit tests: START_TEST functions, then UNIT("name", test_a, test_b, ...). Each test runs in its own process
   (Check), so that a crash is one failure. The last line of its output, "name: N passed, N failed", is what
   tests/run.sh counts. UNIT_LONG(test_c) runs where the environment has LONG, and never with sanitizers, which are five
   times as slow: long numbers from code that other tests run too. */
#ifndef UNIT_H
#define UNIT_H
#include <check.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int main(void); /* which the Makefile calls after the file, for tests/unit/unit.c */

static inline int unit_run(const char *name, const TTest *const *tests, size_t n)
{
    Suite *suite = suite_create(name);
    for (size_t i = 0; i < n; i++) {
        if (!tests[i]) continue;
        TCase *one = tcase_create(tests[i]->name);
        tcase_set_timeout(one, 300);
        tcase_add_test(one, tests[i]);
        suite_add_tcase(suite, one);
    }
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    int failed = srunner_ntests_failed(runner), run = srunner_ntests_run(runner);
    srunner_free(runner);
    printf("%s: %d passed, %d failed\n", name, run - failed, failed);
    return failed != 0 || run == 0;
}

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define UNIT_SANITIZED 1
#endif
#endif
#if defined(__SANITIZE_ADDRESS__)
#define UNIT_SANITIZED 1
#endif
#ifdef UNIT_SANITIZED
#define UNIT_LONG(test) ((void)&(test), NULL)
#define UNIT_PLAIN(test) ((void)&(test), NULL)
#else
#define UNIT_PLAIN(test) (test)
#define UNIT_LONG(test) (getenv("LONG") && *getenv("LONG") ? (test) : NULL)
#endif

#define UNIT(name, ...)                                                                                                \
    int main(void)                                                                                                     \
    {                                                                                                                  \
        const TTest *const tests[] = {__VA_ARGS__};                                                                    \
        return unit_run(name, tests, sizeof tests / sizeof tests[0]);                                                  \
    }
#endif
