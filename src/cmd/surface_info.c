/* rasp surface info: what height maps are like. First what looks like a fault, in words that say what to do. */
#include <math.h>
#include <stdio.h>

#include "analysis/surface_band.h"
#include "analysis/surface_ends.h"
#include "analysis/surface_heights.h"
#include "base/arena.h"
#include "cmd/report.h"
#include "cmd/surface.h"
#include "cmd/tell.h"
#include "file/heightfile.h"

enum { SURFACE_INFO_NOTES = 16, SURFACE_INFO_ALPHAS = 2 };

/* m: alpha of the limiter, 1/alpha the curvature it lets through */
static const double alphas[SURFACE_INFO_ALPHAS] = {0.01, 0.05};

struct surface_info {
    const char *file;
    struct heightfile h; /* levelled as asked                                   */
    int levelling;
    struct heightfile_plane tilt; /* of the map as it is in the file                     */
    struct surface_heights heights;
    struct surface_heights_steps steps;
    struct surface_band band[2]; /* along the rows, down the columns (of a map)         */
    struct surface_ends ends[2];
    struct surface_ends_period period;
    const char *notes[SURFACE_INFO_NOTES]; /* what looks like a fault; NULL-terminated     */
    int n_notes;
    struct arena *arena;
};

#define NOTE(i, ...)                                                                                                   \
    ((i)->n_notes + 1 < SURFACE_INFO_NOTES                                                                             \
         ? (void)((i)->notes[(i)->n_notes++] = arena_format((i)->arena, __VA_ARGS__))                                  \
         : (void)0)

static const char *len(const struct surface_info *i, double x) { return heightfile_length_text(x, i->arena); }

static void note_ends(struct surface_info *i, bool down)
{
    static const char *const ends[2][2] = {{"first", "last"}, {"top", "bottom"}};
    const struct surface_ends *s = &i->ends[down];
    for (int k = 0; k < 2; k++)
        if (s->fall[k])
            NOTE(i,
                 "the %s %zu %s fall away by %s, in steps unlike any other: an edge artefact of resampling; cut them "
                 "off (rasp surface convert --crop)",
                 ends[down][k], s->fall[k],
                 down            ? "rows"
                 : i->h.rows > 1 ? "columns"
                                 : "samples",
                 len(i, s->drop[k]));
    if (s->jump > 8 * s->step)
        NOTE(i,
             "repeated%s it jumps by %s, %.0f times the step between neighbours: a click each time; surface.off_map: "
             "mirror has none",
             i->h.rows == 1 ? ""
             : down         ? " in y"
                            : " in x",
             len(i, s->jump), s->jump / s->step);
}

/* What looks like a fault, into i->notes. */
static void surface_info_notes(struct surface_info *i)
{
    const struct heightfile *h = &i->h;
    if (h->holes)
        NOTE(i,
             "missing points: %zu, the first at row %zu, column %zu (counted from 0): a scene needs surface.holes: "
             "fill, or a mended file",
             h->holes, h->first_hole / h->columns, h->first_hole % h->columns);
    const char *doubts[HEIGHTFILE_WARNINGS];
    int n = heightfile_warnings(&i->h, &heightfile_load_option_names, i->arena, doubts);
    if (i->heights.sz == 0) NOTE(i, "all heights are the same: there is nothing to be heard");
    for (int k = 0; k < n; k++)
        NOTE(i, "%s", doubts[k]);
    /* Above a tenth of what the limiter lets through, rounding is part of the sound. */
    const struct surface_heights_steps *s = &i->steps;
    for (int k = SURFACE_INFO_ALPHAS - 1; k >= 0; k--) {
        double limit = 1 / alphas[k];
        if (s->noise <= 0.1 * limit) continue;
        NOTE(i,
             "steps of %s make a curvature noise of %.3g 1/m, %.0f %% of what the limiter lets through at alpha = %s: "
             "it will be heard; export more bits (float32), or smooth and resample to a wider pitch",
             len(i, s->step), s->noise, 100 * s->noise / limit, len(i, alphas[k]));
        break;
    }
    if (s->levels > 1 && s->levels <= 256 && s->looked_at >= 2048)
        NOTE(i, "heights take only %zu values: an 8-bit original", s->levels);

    double x = fabs(i->tilt.slope_x) * h->pitch_x * (double)(h->columns - 1),
           y = h->rows > 1 ? fabs(i->tilt.slope_y) * h->pitch_y * (double)(h->rows - 1) : 0;
    if (i->levelling != 2 && fmax(x, y) > i->heights.sq)
        NOTE(i, "it is tilted by %s from end to end: surface.levelling: plane", len(i, fmax(x, y)));
    for (int down = 0; down < (i->h.rows > 1 ? 2 : 1); down++) {
        /* The limiter sees curvature, whatever makes it. */
        const struct surface_band *b = &i->band[down];
        if (b->beyond > 0.1)
            NOTE(i,
                 "%.0f %% of the mean square curvature%s lies above the band limit, where there is no surface: %s; "
                 "smooth it (a Gaussian of %s) before use",
                 100 * b->beyond,
                 i->h.rows == 1 ? ""
                 : down         ? " in y"
                                : " in x",
                 b->noise ? "noise of the measurement" : "artefacts of resampling", len(i, 0.25 / b->limit));
        note_ends(i, down);
    }
    const struct surface_ends_period *p = &i->period;
    if (p->stands_out)
        NOTE(i,
             "it resembles itself %zu samples (%s) further on (autocorrelation %.2f): rows of an image laid end to "
             "end, so that neighbours every %zu samples are none?",
             p->lag, len(i, (double)p->lag * i->h.pitch_x), p->peak, p->lag);
}

/* ------------------------------------------------------------------ the report: in text a fact a line, in JSON SI
 * units */

static void report_heights(struct report *r, const struct surface_info *i)
{
    static const char *const words[] = {"none", "mean", "plane"};
    const struct surface_heights *s = &i->heights;
    bool map = i->h.rows > 1;
    const char *word = i->levelling == 2 && !map ? "line" : words[i->levelling];
    report_set(r, "levelling:s slope_x:n slope_y:n", words[i->levelling], i->tilt.slope_x, map ? i->tilt.slope_y : NAN);
    report_row(r, "levelling", "%s%s", word, i->levelling ? " subtracted" : "");
    report_row(r, "as stored", map ? "mean %s, slope %.4g um/mm in x, %.4g um/mm in y" : "mean %s, slope %.4g um/mm",
               len(i, i->tilt.mean), i->tilt.slope_x * 1e3, i->tilt.slope_y * 1e3);
    report_object(r, "heights");
    report_set(r, "mean_m:n", s->mean);
    report_figure(r, "sa_m", s->sa, map ? "Sa" : "Ra", "%s", len(i, s->sa));
    report_figure(r, "sq_m", s->sq, map ? "Sq" : "Rq", "%s", len(i, s->sq));
    if (!isnan(s->ssk) || r->json) {
        report_figure(r, "ssk", s->ssk, map ? "Ssk" : "Rsk", "%.4g", s->ssk);
        report_figure(r, "sku", s->sku, map ? "Sku" : "Rku", "%.4g", s->sku);
    }
    report_figure(r, "sz_m", s->sz, map ? "Sz" : "Rz", "%s", len(i, s->sz));
    report_figure(r, "slope_rms_x", s->slope, "rms slope", map ? "%.4g in x, %.4g in y" : "%.4g", s->slope, s->slope_y);
    report_set(r, "slope_rms_y:n", s->slope_y);
    report_figure(r, "curvature_rms_x_per_m", s->curvature, "rms curvature",
                  map ? "%.4g 1/m in x, %.4g 1/m in y" : "%.4g 1/m", s->curvature, s->curvature_y);
    report_set(r, "curvature_rms_y_per_m:n", s->curvature_y);
    report_end(r);
}

static void report_steps(struct report *r, const struct surface_info *i)
{
    const struct surface_heights_steps *s = &i->steps;
    const char *shares = "";
    report_object(r, "quantisation");
    report_set(r, "step_m:n levels:z heights_looked_at:z curvature_noise_per_m:n curvature_noise_at_knots_per_m:n",
               s->step, s->levels, s->looked_at, s->noise, 2.45 * s->noise);
    report_list(r, "limiter");
    for (int k = 0; k < SURFACE_INFO_ALPHAS; k++) {
        report_object(r, NULL);
        report_set(r, "alpha_m:n noise_over_limit:n", alphas[k], s->noise * alphas[k]);
        report_end(r);
        shares = arena_format(i->arena, "%s%s %.3g %% of the limiter's %g 1/m", shares, k ? "," : "",
                              100 * s->noise * alphas[k], 1 / alphas[k]);
    }
    report_end(r);
    report_end(r);
    if (s->step == 0)
        report_row(r, "quantisation", "none seen (%zu of %zu heights are different)", s->levels, s->looked_at);
    else if (2.45 * s->noise < 0.01 / alphas[SURFACE_INFO_ALPHAS - 1])
        report_row(r, "quantisation", "steps of %.3g nm: nothing beside the limiter (curvature noise %.2g 1/m)",
                   s->step * 1e9, s->noise);
    else {
        report_row(r, "quantisation", "steps of %.4g nm (%zu of %zu heights are different)", s->step * 1e9, s->levels,
                   s->looked_at);
        report_row(r, "its curvature noise", "%.3g 1/m, at the spline's knots %.3g 1/m:%s", s->noise, 2.45 * s->noise,
                   shares);
    }
}

/* Along the rows or down the columns; `where`: " in x" or " in y" of a map. */
static void report_band(struct report *r, const struct surface_info *i, int down, const char *where)
{
    const struct surface_band *b = &i->band[down];
    const char *label = arena_format(i->arena, "band limit%s", where);
    bool limit = !isnan(b->limit);
    if (b->segments == 0) {
        report_row(r, label, "unknown: %s", i->heights.sz > 0 ? "too few samples in a row without holes" : "flat");
        return;
    }
    report_object(r, down ? "band_y" : "band_x");
    report_set(
        r, "limit_cycles_per_m:n limit_is_noise_floor:b curvature_above_limit:n nyquist_cycles_per_m:n oversampling:n",
        b->limit, b->noise, b->beyond, b->nyquist, limit ? b->nyquist / b->limit : 1.0);
    report_set(r, "exponent:n exponent_from_cycles_per_m:n exponent_to_cycles_per_m:n", b->exponent, b->from, b->to);
    report_end(r);
    if (limit)
        report_row(r, label, "%.4g cycles/mm (wavelength %s), where it %s; %.3g times oversampled", b->limit * 1e-3,
                   len(i, 1 / b->limit), b->noise ? "meets the noise floor" : "is 80 dB down", b->nyquist / b->limit);
    else
        report_row(r, label, "none below the Nyquist frequency, %.4g cycles/mm", b->nyquist * 1e-3);
    report_row(r, "heard up to", "%.4g kHz at 10 cm/s", (limit ? b->limit : b->nyquist) * 0.1e-3);
    if (!isnan(b->exponent))
        report_row(r, arena_format(i->arena, "spectrum%s", where), "falls as k^%.3g from %.4g to %.4g cycles/mm",
                   b->exponent, b->from * 1e-3, b->to * 1e-3);
}

static void report_surface(struct report *r, const struct surface_info *i)
{
    const struct surface_ends_period *p = &i->period;
    report_object(r, NULL);
    const struct heightfile *h = &i->h;
    bool map = h->rows > 1;
    double x = h->pitch_x, y = h->pitch_y, columns = (double)h->columns, rows = (double)h->rows;
    const char *bits = h->step > 0 ? ", integers of %d bits" : ", floating point of %d bits", *filled = "";
    report_set(r, "file:s format:s title:s columns:z rows:z", i->file, h->format, h->title, h->columns, h->rows);
    report_set(r, "pitch_x_m:n pitch_y_m:n missing:z filled:z", x, map ? y : NAN, h->holes, h->filled);
    bits = h->bits ? arena_format(i->arena, bits, h->bits == 24 ? 32 : h->bits == 53 ? 64 : h->bits) : "";
    filled = h->filled ? arena_format(i->arena, ", and %zu filled", h->filled) : "";
    report_text(r, "%s\n", i->file);
    report_row(r, "format", "%s%s%s%s%s", h->format, bits, h->title ? ", \"" : "", h->title ? h->title : "",
               h->title ? "\"" : "");
    if (map) {
        report_row(r, "samples", "map, %zu x %zu samples", h->columns, h->rows);
        report_row(r, "size", "%.4g mm x %.4g mm", x * columns * 1e3, y * rows * 1e3);
        report_row(r, "pitch", "%.7g um x %.7g um", x * 1e6, y * 1e6);
    } else {
        report_row(r, "samples", "profile, %zu samples", h->columns);
        report_row(r, "size", "%.5g mm", x * columns * 1e3);
        report_row(r, "pitch", "%.7g um", x * 1e6);
    }
    report_row(r, "missing points", "%zu%s", h->holes, filled);
    report_heights(r, i);
    report_steps(r, i);
    report_set(r, "band_x:0 band_y:0 ends_x:0 ends_y:0 repetition:0");
    for (int down = 0; down < (i->h.rows > 1 ? 2 : 1); down++) {
        const char *where = i->h.rows == 1 ? "" : down ? " in y" : " in x";
        report_band(r, i, down, where);
        const struct surface_ends *s = &i->ends[down];
        report_object(r, down ? "ends_y" : "ends_x");
        report_set(r, "step_rms_m:n jump_repeated_m:n slope_jump_mirrored:n", s->step, s->jump, s->kink);
        report_list(r, "fall_samples");
        report_set(r, ":z :z", s->fall[0], s->fall[1]);
        report_end(r);
        report_set(r, "fall_m:a", s->drop, 2);
        report_end(r);
        report_row(r, arena_format(i->arena, "repeated%s", where), "jumps by %s at the seam (neighbours differ by %s)",
                   len(i, s->jump), len(i, s->step));
        report_row(r, arena_format(i->arena, "mirrored%s", where), "slope changes by %.3g at the ends", s->kink);
    }
    if (!isnan(p->peak)) {
        report_object(r, "repetition");
        report_set(r, "lag_samples:z autocorrelation:n stands_out:b", p->lag, p->peak, p->stands_out);
        report_end(r);
        report_row(r, "autocorrelation", "highest %.2f at %s (%zu samples)", p->peak,
                   len(i, (double)p->lag * i->h.pitch_x), p->lag);
    }
    report_set(r, "warnings:t", i->notes, i->n_notes);
    for (int k = 0; k < i->n_notes; k++)
        report_note(r, "  warning: ", i->notes[k]);
    report_end(r);
}

/* ------------------------------------------------------------------ the action */

/* The steps show in the heights as they are stored: so levelling comes after. */
static bool gather(struct surface_info *i, struct heightfile_options o, struct err *e)
{
    i->levelling = o.levelling;
    o.levelling = HEIGHTFILE_LEVEL_NONE;
    if (!heightfile_load(i->file, &o, i->arena, &i->h, e)) return false;
    i->tilt = heightfile_level_fit(&i->h);
    surface_heights_steps(&i->h, &i->steps);
    i->h.levelled = heightfile_level(&i->h, (enum heightfile_levelling)i->levelling);
    surface_heights(&i->h, &i->heights);
    for (int down = 0; down < (i->h.rows > 1 ? 2 : 1); down++) {
        surface_band(&i->h, down, &i->band[down]);
        surface_ends(&i->h, down, &i->ends[down]);
    }
    surface_ends_period(&i->h, &i->period);
    surface_info_notes(i);
    return true;
}

int surface_info_run(struct cmd_call *c, struct err *e)
{
    struct heightfile_options o;
    int worst = 0, n = 0;
    if (!surface_options(c, HEIGHTFILE_LEAVE, &o, e)) return (int)e->kind;
    struct report r = report_open(stdout, args_given(&c->args, "json"));
    report_list(&r, "surfaces");
    for (int k = 0; k < c->args.n_operands; k++) {
        struct err mine = {0};
        struct arena *own = arena_open(); /* the maps of many files need not all stay */
        struct surface_info *i = ARENA_TAKE(own, struct surface_info, 1);
        *i = (struct surface_info){.file = c->args.operands[k], .arena = own};
        if (gather(i, o, &mine)) {
            report_surface(&r, i);
            n++;
        } else
            tell_error(c, "surface", &mine);
        worst = (int)mine.kind > worst ? (int)mine.kind : worst;
        arena_close(own);
    }
    report_end(&r);
    if (n == 0) json_decref(r.at[0]);
    return n > 0 && !report_close(&r, 12, e) ? (int)e->kind : worst;
}
