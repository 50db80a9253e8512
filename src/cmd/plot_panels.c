/* The panels of `rasp plot`: their words, which have data, which are asked for. */
#include <string.h>

#include "base/text.h"
#include "cmd/plot.h"

const char *const plot_panels_words[PLOT_PANELS] = {"waveform", "spectrogram", "force", "normal", "motion", "modes", "decays"};

/* Told apart by colour-blind people too (Okabe and Ito's set). */
const char *plot_panels_colour(int i)
{
    static const char *const colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7"};
    return colours[i % (int)(sizeof colours / sizeof colours[0])];
}

static bool read_word(const char *word, unsigned *asked, struct err *e)
{
    const char *names[PLOT_PANELS + 1] = {NULL}, *meant;
    memcpy(names, plot_panels_words, sizeof plot_panels_words);
    for (int k = 0; k < PLOT_PANELS; k++)
        if (!strcmp(word, names[k])) {
            *asked |= 1u << k;
            return true;
        }
    meant = text_nearest(word, names);
    return err_set(e, ERR_USAGE, "--panels: '%s' is no panel%s%s; there are waveform, spectrogram, force, normal, motion, modes and decays", word, meant ? "; did you mean " : "",
                   meant ? meant : "");
}

bool plot_panels_read(const char *words, unsigned *asked, struct arena *a, struct err *e)
{
    *asked = 0;
    for (char *p = words ? arena_text(a, words) : NULL, *next; p; p = next) {
        next = strchr(p, ',');
        if (next)
            *next++ = '\0';
        if (!read_word(p, asked, e))
            return false;
    }
    return true;
}

static bool has_data(const struct plot_page *p, int panel)
{
    switch (panel) {
    case PLOT_FORCE: return plot_data_has(p, PLOT_PEAK) || plot_data_has(p, PLOT_RMS);
    case PLOT_HAND: return plot_data_has(p, PLOT_NORMAL) || plot_data_has(p, PLOT_ALPHA);
    case PLOT_MOTION: return p->n_ways > 0;
    case PLOT_MODES: case PLOT_DECAYS: return p->n_bodies > 0;
    default: return p->sound != NULL;
    }
}

bool plot_panels_there(const struct plot_page *p, int panel)
{
    bool wanted = p->asked ? p->asked >> panel & 1 : panel != PLOT_DECAYS || p->table_of_modes;
    return wanted && has_data(p, panel);
}

bool plot_panels_check(const struct plot_page *p, struct err *e)
{
    static const char *const lacks[PLOT_PANELS] = {
        "a sound (a WAV)", "a sound (a WAV)", "a table of diagnostics of the same render with contact forces (in the scene: output: {diagnostics: {rate: 1 kHz}})",
        "a table of diagnostics of the same render with the normal force or alpha (in the scene: output: {diagnostics: {rate: 1 kHz}})",
        "a contact that moves, by a table of diagnostics with x_m and y_m, or by the .scene.yaml and .json of the render beside the sound",
        "a mode table, or, beside a sound, the .scene.yaml and .json of its render, whose responses are modes", NULL};
    for (int k = 0; k < PLOT_PANELS; k++)
        if (p->asked >> k & 1 && !has_data(p, k))
            return err_set(e, ERR_SCENE, "%s: the panel %s needs %s", p->file, plot_panels_words[k], lacks[k == PLOT_DECAYS ? PLOT_MODES : k]);
    return true;
}

void plot_panels_list(const struct plot_page *p, FILE *f)
{
    static const char *const names[PLOT_PANELS] = {"waveform", "spectrogram", "contact force", "normal force", "motion", "modes", "decays"};
    const char *comma = "";
    for (int k = 0; k < PLOT_PANELS; k++)
        if (plot_panels_there(p, k)) {
            fprintf(f, "%s %s%s", comma, names[k], k == PLOT_HAND && plot_data_has(p, PLOT_ALPHA) ? ", alpha" : "");
            comma = ",";
        }
    fputc('\n', f);
}
