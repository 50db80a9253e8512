/* The options of `rasp modes extract`, and which of them belong together. */
#include <math.h>
#include <string.h>

#include "cmd/modes_extract.h"
#include "output/mark.h"
#include "scene/rules.h"
#include "scene/units.h"

static bool quantity(struct modes_extract *x, const char *name, enum key_dimension d, double *value, struct err *e)
{
    const char *text = args_value(&x->c->args, name);
    struct units_fault fault = {NULL, NULL};
    if (!text) return true;
    if (!units_read(text, d, value, x->arena, &fault))
        return err_set(e, ERR_USAGE, "--%s %s: %s", name, fault.text, fault.cure);
    return *value >= 0.0 || err_set(e, ERR_USAGE, "--%s: '%s' is below 0", name, text);
}

static bool word(struct modes_extract *x, const char *name, const char *const *words, int *chosen, struct err *e)
{
    const char *text = args_value(&x->c->args, name), *all = words[0];
    if (!text) return true;
    for (int k = 0; words[k]; k++)
        if (!strcmp(words[k], text)) {
            *chosen = k;
            return true;
        }
    for (int k = 1; words[k]; k++)
        all = arena_format(x->arena, "%s%s%s", all, words[k + 1] ? ", " : " or ", words[k]);
    return err_set(e, ERR_USAGE, "--%s: '%s' is not %s", name, text, all);
}

static bool numbers(struct modes_extract *x, struct err *e)
{
    struct modes_extract_given *g = &x->given;
    const struct args *a = &x->c->args;
    static const double scales[2] = {1e-300, 1e300}, rise[2] = {1, 120};
    static const long channels[2] = {1, 1024};
    return args_whole(a, "channel", channels, &g->channel, e) &&
           args_whole(a, "force-channel", channels, &g->force_channel, e) &&
           args_number(a, "scale", scales, &g->scale, e) && args_number(a, "force-scale", scales, &g->force_scale, e) &&
           args_number(a, "strike-threshold", rise, &g->threshold, e) &&
           quantity(x, "radius", KEY_LENGTH, &g->radius, e) && quantity(x, "distance", KEY_LENGTH, &g->distance, e) &&
           quantity(x, "delay", KEY_TIME, &g->delay, e) && quantity(x, "low", KEY_FREQUENCY, &g->low, e) &&
           quantity(x, "high", KEY_FREQUENCY, &g->high, e) && args_number(a, "fastest", scales, &g->fastest, e);
}

static bool sizes(const struct modes_extract_given *g, struct err *e)
{
    bool radius = !isnan(g->radius), distance = !isnan(g->distance);
    if (!radius && !distance) return true;
    if (g->quantity != MODES_PRESSURE)
        return err_set(e, ERR_USAGE, "--radius and --distance are for --quantity pressure, a microphone's");
    if (radius != distance)
        return err_set(e, ERR_USAGE,
                       "--radius, of a sphere of the object's size, and --distance, from its middle to the microphone, "
                       "belong together");
    return (g->radius > 0.0 && g->distance > g->radius) ||
           err_set(e, ERR_USAGE, "--distance %g m must be greater than --radius %g m, and both above 0", g->distance,
                   g->radius);
}

/* What belongs together. */
static bool together(struct modes_extract *x, struct err *e)
{
    const struct modes_extract_given *g = &x->given;
    const struct args *a = &x->c->args;
    if (g->impulse && (g->force_channel || g->only || args_given(a, "strike-threshold")))
        return err_set(e, ERR_USAGE,
                       "--impulse says that the recording is an impulse response already: --force-channel, --strikes "
                       "and --strike-threshold are for strikes");
    if (g->force_channel == g->channel)
        return err_set(e, ERR_USAGE,
                       "--channel and --force-channel are both %ld; sound and force are in different channels",
                       g->channel);
    if (!g->force_channel && args_given(a, "force-scale"))
        return err_set(e, ERR_USAGE, "--force-scale needs --force-channel: which channel holds the force");
    if (g->force_channel && isnan(g->scale) != isnan(g->force_scale))
        return err_set(e, ERR_USAGE,
                       "--%s is missing: a level per N s takes --scale and --force-scale; without both it is relative",
                       isnan(g->scale) ? "scale" : "force-scale");
    if (!g->force_channel && !g->impulse && !isnan(g->scale))
        return err_set(e, ERR_USAGE,
                       "--scale says nothing without a force: per how many N s? Give --force-channel, or --impulse");
    return (isnan(g->low) || isnan(g->high) || g->low < g->high) ||
           err_set(e, ERR_USAGE, "--low %g Hz is not below --high %g Hz", g->low, g->high);
}

/* Outputs: each may be written (output/mark.h), and no two are one file. */
static bool outputs(struct modes_extract *x, struct err *e)
{
    struct modes_extract_given *g = &x->given;
    static const char *const names[] = {"output", "residual", "resynthesis", "plot"};
    const char **to[] = {&g->output, &g->residual, &g->resynthesis, &g->plot};
    for (int k = 0; k < 4; k++) {
        const char *file = *to[k] = args_value(&x->c->args, names[k]);
        bool force = args_given(&x->c->args, "force");
        if (file && !(k == 0 ? mark_absent(file, force, e) : mark_permits(file, NULL, force, e))) return false;
        for (int i = 0; i < k; i++)
            if (file && *to[i] && !strcmp(file, *to[i]))
                return err_set(e, ERR_USAGE, "--%s and --%s are both %s", names[i], names[k], file);
    }
    g->svg = g->plot && rules_ends_in(g->plot, ".svg");
    if (g->plot && !g->svg && !rules_ends_in(g->plot, ".png"))
        return err_set(e, ERR_USAGE, "--plot: '%s' ends in neither .png nor .svg", g->plot);
    return g->output || err_set(e, ERR_USAGE, "-o FILE.csv is needed: the mode table to write");
}

bool modes_extract_options(struct modes_extract *x, struct err *e)
{
    static const char *const quantities[] = {"displacement", "velocity", "acceleration", "pressure", NULL},
                             *const methods[] = {"esprit", "spectrogram", NULL};
    struct modes_extract_given *g = &x->given;
    int method = 0;
    *g = (struct modes_extract_given){.channel = 1,
                                      .scale = NAN,
                                      .force_scale = NAN,
                                      .quantity = MODES_PRESSURE,
                                      .radius = NAN,
                                      .distance = NAN,
                                      .delay = NAN,
                                      .fastest = NAN,
                                      .low = NAN,
                                      .high = NAN,
                                      .threshold = 20.0};
    g->impulse = args_given(&x->c->args, "impulse");
    g->only = args_value(&x->c->args, "strikes");
    if (!word(x, "quantity", quantities, &g->quantity, e) || !word(x, "method", methods, &method, e) || !numbers(x, e))
        return false;
    g->spectrogram = method == 1;
    if (isnan(g->delay) && g->quantity != MODES_PRESSURE && !g->impulse)
        g->delay = 0.0; /* what touches the object has no way to go */
    return sizes(g, e) && together(x, e) && outputs(x, e);
}
