/* The version of rasp, of the compiler and its flags, of the instruction set and of every library.
   The build may define RASP_REVISION, RASP_FLAGS and RASP_PACKAGES ("NAME VERSION;" of each, by pkg-config), quoted
   texts. OpenBLAS and LAPACKE are rasp-modes'. */
#include "base/version.h"
#include "cmd/cmd.h"

#include <ebur128.h>
#include <fftw3.h>
#include <gnu/libc-version.h>
#include <gsl/gsl_version.h>
#include <jansson.h>
#include <openssl/crypto.h>
#include <png.h>
#include <sndfile.h>
#include <soxr.h>
#include <stdio.h>
#include <string.h>
#include <yaml.h>

#include "num/lanes.h"

#ifndef RASP_REVISION
#define RASP_REVISION "unknown"
#endif
#ifndef RASP_PACKAGES
#define RASP_PACKAGES ""
#endif
#ifndef RASP_FLAGS
#define RASP_FLAGS "unknown"
#endif
#ifdef __clang__
#define COMPILER "clang " __clang_version__
#else
#define COMPILER "gcc " __VERSION__
#endif
#ifdef __aarch64__
#define BUILT_FOR "aarch64"
#elif !defined __x86_64__
#define BUILT_FOR "another kind of CPU"
#elif defined __AVX512F__
#define BUILT_FOR "x86-64-v4"
#elif defined __AVX2__
#define BUILT_FOR "x86-64-v3"
#elif defined __SSE4_2__
#define BUILT_FOR "x86-64-v2"
#else
#define BUILT_FOR "x86-64"
#endif

const char version_number[] = VERSION, version_revision[] = RASP_REVISION;

void version_print(bool verbose)
{
    printf("rasp " VERSION "\n");
    if (!verbose) return;
    printf("revision     %s\n", RASP_REVISION);
    printf("compiler     %s\n", COMPILER);
    printf("flags        %s\n", RASP_FLAGS);
    printf("glibc        %s (built with %d.%d)\n", gnu_get_libc_version(), __GLIBC__, __GLIBC_MINOR__);
    /* The best level this CPU has; functions with clones run at it, all with the same results to the bit: that which
       hot functions are compiled for (num/lanes.h), or the one that all is compiled for. */
#define TEXT(...) #__VA_ARGS__
#define TEXT_OF(...) TEXT(__VA_ARGS__)
#ifdef __x86_64__
    __builtin_cpu_init();
    bool v4 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
              __builtin_cpu_supports("avx512vl"),
         v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"), v2 = __builtin_cpu_supports("sse4.2"),
         clones = sizeof TEXT_OF(LANES_CLONES) > 1;
    const char *level = v4 ? "x86-64-v4" : v3 ? "x86-64-v3" : v2 ? "x86-64-v2" : "x86-64";
#else
    bool v4 = false, v3 = false, clones = false;
    const char *level = BUILT_FOR;
#endif
    printf("built for    %s\nthis CPU     %s\nhot loops    %s, %s\n", BUILT_FOR, level,
           !clones    ? BUILT_FOR
           : v4 || v3 ? level
                      : "x86-64",
           clones ? "picked at run time" : "as built");
    char ebur128[32], png[32];
    int major, minor, patch;
    unsigned v = (unsigned)png_access_version_number();
    ebur128_get_version(&major, &minor, &patch);
    snprintf(ebur128, sizeof ebur128, "%d.%d.%d", major, minor, patch);
    snprintf(png, sizeof png, "%u.%u.%u", v / 10000, v / 100 % 100, v % 100);
    const char *const libraries[][3] = {
        {"libsndfile", sf_version_string(), "sndfile"}, /* loaded; NULL: it is headers, or does not say */
        {"libyaml", yaml_get_version_string(), "yaml-0.1"},
        {"FFTW", fftw_version, "fftw3"},
        {"GSL", gsl_version, "gsl"},
        {"SLEEF", NULL, "sleef"},
        {"jansson", jansson_version_str(), "jansson"},
        {"libebur128", ebur128, "libebur128"},
        {"libcrypto", OpenSSL_version(OPENSSL_VERSION), "libcrypto"},
        {"libpng", png, "libpng"},
        {"libsoxr", soxr_version(), "soxr"},
        {"OpenBLAS", NULL, "openblas"},
        {"LAPACKE", NULL, "lapacke"},
    };
    for (size_t i = 0; i < sizeof libraries / sizeof *libraries; i++) {
        /* Of "sndfile 1.2.0;yaml-0.1 0.2.5;" the version of one. */
        const char *loaded = libraries[i][1], *package = libraries[i][2], *built = ";" RASP_PACKAGES;
        size_t n = strlen(package);
        while ((built = strchr(built, ';')) && (strncmp(++built, package, n) != 0 || built[n] != ' '))
            continue;
        built = built ? built + n + 1 : "?";
        printf("%-12s %s%s(built with %.*s)\n", libraries[i][0], loaded ? loaded : "", loaded ? " " : "",
               (int)strcspn(built, ";"), built);
    }
}

bool version_asked(int argc, char **argv)
{
    bool asked = false, verbose = false, other = false;
    for (int i = 0; i < argc; i++) {
        bool is = !strcmp(argv[i], "--version") || !strcmp(argv[i], "-V"),
             more = !strcmp(argv[i], "--verbose") || !strcmp(argv[i], "-v");
        asked = asked || is;
        verbose = verbose || more;
        other = other || (!is && !more);
    }
    if (asked && !other) version_print(verbose);
    return asked && !other;
}
