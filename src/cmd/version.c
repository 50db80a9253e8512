/* The version of rasp, of the compiler and its flags, of the instruction set and of every library.
   The build may define RASP_REVISION and RASP_FLAGS (quoted texts). */
#include "cmd/version.h"

#include <ebur128.h>
#include <fftw3.h>
#include <gsl/gsl_version.h>
#include <jansson.h>
#include <openssl/crypto.h>
#include <sleef.h>
#include <sndfile.h>
#include <stdio.h>
#include <yaml.h>

#define VERSION "0.1.0"
#ifndef RASP_REVISION
#define RASP_REVISION "unknown"
#endif
#ifndef RASP_FLAGS
#define RASP_FLAGS "unknown"
#endif
#ifdef __clang__
#define COMPILER "clang " __clang_version__
#else
#define COMPILER "gcc " __VERSION__
#endif
#if defined __AVX512F__
#define BUILT_FOR "x86-64-v4"
#elif defined __AVX2__
#define BUILT_FOR "x86-64-v3"
#elif defined __SSE4_2__
#define BUILT_FOR "x86-64-v2"
#else
#define BUILT_FOR "x86-64"
#endif

/* The best level this CPU has; functions with clones run at it, all with the same results to the bit. */
static const char *cpu_level(void)
{
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
        return "x86-64-v4";
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        return "x86-64-v3";
    return __builtin_cpu_supports("sse4.2") ? "x86-64-v2" : "x86-64";
}

static void print_libraries(void)
{
    int major, minor, patch;
    ebur128_get_version(&major, &minor, &patch);
    printf("libsndfile   %s\n", sf_version_string());
    printf("libyaml      %s\n", yaml_get_version_string());
    printf("FFTW         %s\n", fftw_version);
    printf("GSL          %s\n", gsl_version);
    printf("SLEEF        %d.%d.%d (headers)\n", SLEEF_VERSION_MAJOR, SLEEF_VERSION_MINOR, SLEEF_VERSION_PATCHLEVEL);
    printf("jansson      %s\n", jansson_version_str());
    printf("libebur128   %d.%d.%d\n", major, minor, patch);
    printf("libcrypto    %s\n", OpenSSL_version(OPENSSL_VERSION));
}

void version_print(bool verbose)
{
    printf("rasp " VERSION "\n");
    if (!verbose)
        return;
    printf("revision     %s\n", RASP_REVISION);
    printf("compiler     %s\n", COMPILER);
    printf("flags        %s\n", RASP_FLAGS);
    printf("built for    %s\n", BUILT_FOR);
    printf("this CPU     %s\n", cpu_level());
    print_libraries();
}
