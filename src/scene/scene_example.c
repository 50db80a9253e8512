/* Examples: see scene_example.h. */
#include "scene/scene_example.h"

#include <string.h>

#include "scene/units.h"

/* Of files and lists. */
static const char *example_of(const char *path)
{
    static const char *const examples[][2] = {{"surface.recipe", "rough.yaml"},
                                              {"surface.height_map", "profile.npy"},
                                              {"surface.roughness.like", "map.gsf"},
                                              {"motion.file", "recording.csv"},
                                              {"motion.profile", "speed.csv"},
                                              {"load.recorded", "force.csv"},
                                              {"contact.given.file", "force.wav"},
                                              {"output.stems", "[force, surface]"},
                                              {"output.diagnostics.columns", "[speed_m_per_s, normal_force_n]"}};
    for (size_t i = 0; i < sizeof examples / sizeof examples[0]; i++)
        if (strcmp(examples[i][0], path) == 0) return examples[i][1];
    return "modes.csv";
}

const char *scene_example(struct yaml *y, const struct key *k)
{
    const char *one = units_example(k->dimension);
    if (k->standard && *k->standard) return k->standard;
    if (k->example) return k->example;
    switch (k->type) {
    case KEY_NUMBER:
    case KEY_TIME_OR_AUTO:
        return one;
    case KEY_WHOLE:
        return "48 kHz";
    case KEY_COUNT:
    case KEY_SEED:
        return arena_format(y->arena, "%.0f", k->low);
    case KEY_TEXT:
        return "some words";
    case KEY_FILE:
        return example_of(k->path);
    case KEY_POINT:
        return arena_format(y->arena, "[%s, 0]", one);
    case KEY_POINTS:
        return arena_format(y->arena, "[[0, 0], [%s, 0]]", one);
    case KEY_PLACES:
        return "[[0, 0, 1 m]]";
    case KEY_RANGE:
        return arena_format(y->arena, "[%s, %s]", units_text(1, k->dimension, y->arena),
                            units_text(5, k->dimension, y->arena));
    case KEY_LIST:
        return example_of(k->path);
    case KEY_CHOICE:
        return k->choices[0].word;
    }
    return "";
}
