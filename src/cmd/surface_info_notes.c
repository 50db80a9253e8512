/* What looks like a fault in a height map, in words that say what to do. */
#include <math.h>

#include "cmd/surface_info.h"

#define NOTE(i, ...) ((i)->n_notes + 1 < SURFACE_INFO_NOTES ? (void)((i)->notes[(i)->n_notes++] = arena_format((i)->arena, __VA_ARGS__)) : (void)0)

static const char *len(const struct surface_info *i, double x)
{
    return heightfile_doubt_length(x, i->arena);
}

static void note_holes(struct surface_info *i)
{
    const struct heightfile *h = &i->h;
    if (h->holes)
        NOTE(i, "missing points: %zu, the first at row %zu, column %zu (counted from 0): a scene needs surface.holes: fill, or a mended file", h->holes,
             h->first_hole / h->columns, h->first_hole % h->columns);
}

/* Above a tenth of what the limiter lets through, rounding is part of the sound. */
static void note_steps(struct surface_info *i)
{
    const struct surface_heights_steps *s = &i->steps;
    for (int k = SURFACE_INFO_ALPHAS - 1; k >= 0; k--) {
        double limit = 1 / surface_info_alphas[k];
        if (s->noise <= 0.1 * limit)
            continue;
        NOTE(i, "steps of %s make a curvature noise of %.3g 1/m, %.0f %% of what the limiter lets through at alpha = %s: it will be heard; "
                "export more bits (float32), or smooth and resample to a wider pitch", len(i, s->step), s->noise, 100 * s->noise / limit,
             len(i, surface_info_alphas[k]));
        break;
    }
    if (s->levels > 1 && s->levels <= 256 && s->looked_at >= 2048)
        NOTE(i, "heights take only %zu values: an 8-bit original", s->levels);
}

static void note_units(struct surface_info *i)
{
    const char *doubts[HEIGHTFILE_DOUBTS];
    int n = heightfile_doubt(&i->h, &heightfile_load_option_names, i->arena, doubts);
    if (i->heights.sz == 0)
        NOTE(i, "all heights are the same: there is nothing to be heard");
    for (int k = 0; k < n; k++)
        NOTE(i, "%s", doubts[k]);
}

static void note_tilt(struct surface_info *i)
{
    const struct heightfile *h = &i->h;
    double x = fabs(i->tilt.slope_x) * h->pitch_x * (double)(h->columns - 1),
           y = h->rows > 1 ? fabs(i->tilt.slope_y) * h->pitch_y * (double)(h->rows - 1) : 0;
    if (i->levelling != 2 && fmax(x, y) > i->heights.sq)
        NOTE(i, "it is tilted by %s from end to end: surface.levelling: plane", len(i, fmax(x, y)));
}

static void note_ends(struct surface_info *i, bool down)
{
    static const char *const ends[2][2] = {{"first", "last"}, {"top", "bottom"}};
    const struct surface_ends *s = &i->ends[down];
    for (int k = 0; k < 2; k++)
        if (s->fall[k])
            NOTE(i, "the %s %zu %s fall away by %s, in steps unlike any other: an edge artefact of resampling; cut them off (rasp surface convert "
                    "--crop)", ends[down][k], s->fall[k], down ? "rows" : i->h.rows > 1 ? "columns" : "samples", len(i, s->drop[k]));
    if (s->jump > 8 * s->step)
        NOTE(i, "repeated%s it jumps by %s, %.0f times the step between neighbours: a click each time; surface.off_map: mirror has none",
             i->h.rows == 1 ? "" : down ? " in y" : " in x", len(i, s->jump), s->jump / s->step);
}

static void note_period(struct surface_info *i)
{
    const struct surface_ends_period *p = &i->period;
    if (p->stands_out)
        NOTE(i, "it resembles itself %zu samples (%s) further on (autocorrelation %.2f): rows of an image laid end to end, so that neighbours every "
                "%zu samples are none?", p->lag, len(i, (double)p->lag * i->h.pitch_x), p->peak, p->lag);
}

/* The limiter sees curvature, whatever makes it. */
static void note_band(struct surface_info *i, bool down)
{
    const struct surface_band *b = &i->band[down];
    if (b->beyond > 0.1)
        NOTE(i, "%.0f %% of the mean square curvature%s lies above the band limit, where there is no surface: %s; smooth it (a Gaussian of %s) before use",
             100 * b->beyond, i->h.rows == 1 ? "" : down ? " in y" : " in x", b->noise ? "noise of the measurement" : "artefacts of resampling",
             len(i, 0.25 / b->limit));
}

void surface_info_notes(struct surface_info *i)
{
    note_holes(i);
    note_units(i);
    note_steps(i);
    note_tilt(i);
    for (int down = 0; down < (i->h.rows > 1 ? 2 : 1); down++) {
        note_band(i, down);
        note_ends(i, down);
    }
    note_period(i);
}
