/* The starter design: what most sets need is on, the rest behind a #. */
#include "cmd/starters.h"

#include <string.h>

/* Within braces a comma ends a plain text; more than that ends or begins otherwise. */
static const char *response(const char *irs, const char *name, struct arena *a)
{
    const char *file = arena_format(a, "%s/%s", irs, name);
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._/-";
    return file[0] == '-' || file[strspn(file, plain)] ? keys_yaml_quoted(file, a) : file;
}

void starters_design(FILE *f, const char *irs, struct arena *a)
{
    fputs("# A set of stimuli: every combination of its factors' levels. Its base is the starter scene of the same folder:\n"
          "#   rasp new -o scrape.yaml\n"
          "#   rasp new design -o set.yaml\n"
          "#   rasp check set.yaml\n"
          "#   rasp batch set.yaml -o out\n"
          "# All that can stand here: man rasp-design. Every key of scenes: rasp explain.\n\n"
          "rasp-design: 1\n"
          "title: Two materials scraped at two rates\n"
          "base: scrape.yaml            # the scene of which all are made, seen from this file\n"
          "seed: 1                      # of the noise, which is the same for all conditions of a replicate\n"
          "set:                         # keys that all have otherwise than the base\n"
          "  motion.duration: 1 s\n"
          "  output.diagnostics: null   # no tables of forces\n"
          "factors:\n"
          "  material:                  # a word: each level says what it sets\n",
          f);
    fprintf(f,
            "    - {label: oak, set: {surface.response: %s}}\n"
            "    - {label: stoneware, set: {surface.response: %s}}\n",
            response(irs, "oak_plank.csv", a), response(irs, "stoneware_tile.csv", a));
    fputs("  motion.rate: [1 Hz, 2 Hz]  # a key of scenes: its levels are its values\n"
          "# exclude:                   # cells that the set does not have\n"
          "#   - {material: oak, motion.rate: 2 Hz}\n"
          "replicates: 2                # of each cell, with other noise\n"
          "# order: {seed: 1}           # shuffled; else as written\n"
          "name: \"{material}_{motion.rate}_{replicate}\"\n"
          "text: \"{material}, scraped at {motion.rate}\"   # for the trial; a level may have a text of its own\n"
          "level: {common: {peak: -3 dB}}   # one gain for all; each: one for each; scene: as the scenes say\n"
          "length: longest              # as long as the longest; a time; or own\n"
          "# recordings:                # WAV files that are part of the set\n"
          "#   - {file: real.wav, name: real_oak, material: oak}\n",
          f);
}
