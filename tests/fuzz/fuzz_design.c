/* The design reader, and the scenes of some stimuli of what it accepts. The input lies in a folder with two scenes,
 * base.yaml and other.yaml. */
#include "batch/design.h"
#include "fuzz.h"

static const char base[] = "rasp: 1\nsurface: {roughness: {rms: 4 um}, response: modes.csv}\nscraper: {mass: 5 g}\n"
                           "motion: {path: back_and_forth, to: [3 cm, 0 m], rate: 2 Hz, duration: 1 s}\n";
static const char other[] =
    "rasp: 1\nseed: 4\nsurface: {roughness: {rms: 1 um}}\nscraper: {mass: 2 g}\nmotion: {path: still, duration: 1 s}\n"
    "contact: {model: strike, strike: {speed: 1 m/s, stiffness: 1e8}}\noutput: {sample_rate: 44100 Hz}\n";

/* Names are of the alphabet, and stay within the folder. */
static void check_name(const char *name)
{
    size_t n = strlen(name);
    if (n == 0 || name[0] == '/' || name[n - 1] == '/' || strstr(name, "..") == name || strstr(name, "/../") ||
        strstr(name, "//") || strspn(name, "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz+/_.-") != n)
        abort();
}

static void check_scene(const struct design *d, int i)
{
    struct arena *a = arena_open();
    struct scene s = {0};
    struct err e = {0};
    const char *messages = NULL;
    bool ok = design_scene(d, i, a, &s, &messages, &e);
    fuzz_check(ok, &e);
    arena_close(a);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[128];
    struct arena *a = arena_open();
    struct design d = {0};
    struct err e = {0};
    const char *messages = NULL;
    fuzz_put(path, "base.yaml", base, sizeof base - 1);
    fuzz_put(path, "other.yaml", other, sizeof other - 1);
    fuzz_put(path, "design.yaml", data, size);
    bool ok = design_read(path, a, &d, &messages, &e);
    fuzz_check(ok, &e);
    for (int i = 0; ok && i < d.n_stimuli; i++) {
        check_name(d.stimuli[i].name);
        for (int k = 0; k < d.n_factors; k++)
            if (!design_label(&d, i, k) || !design_value(&d, i, k)) abort();
        design_text(&d, i, a);
        if (i < 2 || i + 1 == d.n_stimuli) check_scene(&d, i);
    }
    arena_close(a);
    return 0;
}
