/* What the tests of the scene reader share: scenes as texts, and messages to be compared. */
#ifndef TESTS_UNIT_SCENES_H
#define TESTS_UNIT_SCENES_H
#include <string.h>

#include "scene/scene_read.h"
#include "unit.h"

/* Four lines to which one more is added. */
#define MIN                                                                                                            \
    "rasp: 1\n"                                                                                                        \
    "surface: {height_map: a.npy, response: a.csv}\n"                                                                  \
    "scraper: {mass: 20 g}\n"                                                                                          \
    "motion: {path: line, to: [1 cm, 0], duration: 1 s}\n"

static const char full[] =
    "rasp: 1\n"
    "title: PVC rod on a plank\n"
    "seed: 18446744073709551615\n"
    "surface:\n"
    "  height_map: ../surfaces/basswood.gsf\n"
    "  response: /irs/plank.csv\n"
    "  along: x\n"
    "  origin: [1 cm, -2 mm]\n"
    "scraper: {mass: 20 g, response: rod.csv, weight: 0.3}\n"
    "motion:\n"
    "  path: back_and_forth\n"
    "  from: [3 cm, 2 cm]\n"
    "  to: [7.5 cm, 2 cm]\n"
    "  rate: 2 Hz\n"
    "  duration: 1.5 s\n"
    "grip: {angle: 0.5 rad}\n"
    "contact: {model: scrape, force: paper, limiter: {alpha_min: 1 cm, alpha_max: 5 cm, zeta: 0.95, force_range: [0.2 "
    "N, 5 N]}}\n"
    "accuracy: {preset: high, oversampling: 16}\n"
    "output: {sample_rate: 44.1 kHz, encoding: pcm16, level: {lufs: -23}, ramp: 20 ms, tail: 2 s,\n"
    "  diagnostics: {columns: [speed_m_per_s, normal_force_n]}}\n"
    "inputs:\n"
    "- file: rod.csv\n"
    "  sha256: 0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef\n"
    "- {file: b.csv}\n";

static const char two[] = "rasp: 1\n"
                          "contacts:\n"
                          "- name: rod\n"
                          "  surface: {roughness: {}, response: a.csv}\n"
                          "  scraper: {mass: 20 g}\n"
                          "  motion: {path: back_and_forth, to: [1 cm, 0], rate: 2 Hz, duration: 1 s}\n"
                          "- name: nail\n"
                          "  start: 0.5 s\n"
                          "  surface: {roughness: {}, response: a.csv}\n"
                          "  scraper: {mass: 1 g}\n"
                          "  motion: {path: line, to: [1 cm, 0], speed: 10 cm/s}\n";

#define SET(...) ((const char *const[]){__VA_ARGS__, NULL})

struct result {
    struct arena *arena;
    struct scene scene;
    const char *messages;
    struct err err;
    bool good;
};

static inline struct result read_with(const char *text, const char *const *set)
{
    struct result r = {.arena = arena_open()};
    struct scene_overrides over = {.set = (const char **)set};
    while (set && set[over.n])
        over.n++;
    r.good = scene_read_text(text, strlen(text), "scenes/t.yaml", &over, r.arena, &r.scene, &r.messages, &r.err);
    ck_assert_msg(r.good == (r.err.kind == ERR_NONE) && r.good == !*r.messages, "%s", r.messages);
    return r;
}

static inline void one_error(const struct result *r, const char *start, const char *says, const char *cure)
{
    const char *line_end = strchr(r->messages, '\n');
    ck_assert_msg(!r->good, "%s %s: accepted", start, says);
    ck_assert_msg(strncmp(r->messages, start, strlen(start)) == 0, "%s %s:\n%s", start, says, r->messages);
    const char *found = strstr(r->messages, says), *help = strstr(r->messages, "= help: ");
    ck_assert_msg(found && found < line_end, "%s %s:\n%s", start, says, r->messages);
    ck_assert_msg(!*cure || (help && strstr(help, cure)), "%s %s:\n%s", start, says, r->messages);
    ck_assert_msg(strstr(r->messages, "\n1 error\n") != NULL, "%s %s:\n%s", start, says, r->messages);
}

#endif
