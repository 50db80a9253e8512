/* rasp surface ACTION: height maps on their own, without a scene: what they are like (first what looks like a fault, in
   words that say what to do), in another format, or made from a recipe. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "analysis/surface_heights.h"
#include "base/text.h"
#include "cmd/cmd.h"
#include "cmd/message.h"
#include "cmd/report.h"
#include "file/heightfile.h"
#include "output/mark.h"
#include "pipeline/outputs.h"
#include "pipeline/stages.h"
#include "scene/params.h"
#include "scene/units.h"
#include "surface/relief.h"

/* ------------------------------------------------------------------ options */

/* --NAME as a length in [range[0], range[1]] m, with a unit or bare in metres; *x is left alone when it is not given.
 * ERR_USAGE */
static bool surface_length(struct cmd_call *c, const char *name, const double range[2], double *x, struct err *e)
{
    double value = range[0];
    if (!cmd_quantity(c, name, KEY_LENGTH, &value, e)) return false;
    if (!(value >= range[0] && value <= range[1]))
        return err_set(e, ERR_USAGE, "--%s: %s is not from %s to %s", name, args_value(&c->args, name),
                       units_text(range[0], KEY_LENGTH, c->arena), units_text(range[1], KEY_LENGTH, c->arena));
    if (args_given(&c->args, name)) *x = value;
    return true;
}

/* --pitch, --height-scale, --height-range, --holes (else `holes`), --levelling. ERR_USAGE */
static bool surface_options(struct cmd_call *c, enum heightfile_holes holes, struct heightfile_options *o,
                            struct err *e)
{
    static const char *const hole_words[] = {"refuse", "fill", "keep", NULL}, *const levelling_words[] = {
                                                                                  "none", "mean", "plane", NULL};
    static const double pitch[2] = {1e-8, 1e-3}, scale[2] = {1e-12, 1e3},
                        range[2] = {1e-9, 1e-1}; /* as the key has it */
    *o = (struct heightfile_options){.pitch = NAN,
                                     .height_scale = NAN,
                                     .height_range = NAN,
                                     .holes = (int)holes,
                                     .names = &heightfile_load_option_names};
    return surface_length(c, "pitch", pitch, &o->pitch, e) &&
           surface_length(c, "height-scale", scale, &o->height_scale, e) &&
           surface_length(c, "height-range", range, &o->height_range, e) &&
           args_word(&c->args, "holes", hole_words, &o->holes, e) &&
           args_word(&c->args, "levelling", levelling_words, &o->levelling, e);
}

/* ------------------------------------------------------------------ info */

enum { NOTES = 16, ALPHAS = 2 };

/* m: alpha of the limiter, 1/alpha the curvature it lets through */
static const double alphas[ALPHAS] = {0.01, 0.05};

struct surface_info {
    const char *file;
    struct heightfile h; /* levelled as asked                                   */
    int levelling;
    struct heightfile_plane tilt; /* of the map as it is in the file                     */
    struct surface_heights heights;
    struct surface_heights_steps steps;
    struct surface_heights_band band[2]; /* along the rows, down the columns (of a map)         */
    struct surface_heights_ends ends[2];
    struct surface_heights_period period;
    const char *notes[NOTES]; /* what looks like a fault; NULL-terminated     */
    int n_notes;
    struct arena *arena;
};

#define NOTE(i, ...)                                                                                                   \
    ((i)->n_notes + 1 < NOTES ? (void)((i)->notes[(i)->n_notes++] = arena_format((i)->arena, __VA_ARGS__)) : (void)0)

static const char *len(const struct surface_info *i, double x) { return heightfile_length_text(x, i->arena); }

static void note_ends(struct surface_info *i, bool down)
{
    static const char *const ends[2][2] = {{"first", "last"}, {"top", "bottom"}};
    const struct surface_heights_ends *s = &i->ends[down];
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
static void find_faults(struct surface_info *i)
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
    for (int k = ALPHAS - 1; k >= 0; k--) {
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
        const struct surface_heights_band *b = &i->band[down];
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
    const struct surface_heights_period *p = &i->period;
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
    report_set(r, "heights:{ mean_m:n", s->mean);
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
    report_set(r, "curvature_rms_y_per_m:n }", s->curvature_y);
}

static void report_steps(struct report *r, const struct surface_info *i)
{
    const struct surface_heights_steps *s = &i->steps;
    const char *shares = "";
    report_set(r,
               "quantisation:{ step_m:n levels:z heights_looked_at:z curvature_noise_per_m:n "
               "curvature_noise_at_knots_per_m:n limiter:[",
               s->step, s->levels, s->looked_at, s->noise, 2.45 * s->noise);
    for (int k = 0; k < ALPHAS; k++) {
        report_set(r, ":{ alpha_m:n noise_over_limit:n }", alphas[k], s->noise * alphas[k]);
        shares = arena_format(i->arena, "%s%s %.3g %% of the limiter's %g 1/m", shares, k ? "," : "",
                              100 * s->noise * alphas[k], 1 / alphas[k]);
    }
    report_set(r, "] }");
    if (s->step == 0)
        report_row(r, "quantisation", "none seen (%zu of %zu heights are different)", s->levels, s->looked_at);
    else if (2.45 * s->noise < 0.01 / alphas[ALPHAS - 1])
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
    const struct surface_heights_band *b = &i->band[down];
    const char *label = arena_format(i->arena, "band limit%s", where);
    bool limit = !isnan(b->limit);
    if (b->segments == 0) {
        report_row(r, label, "unknown: %s", i->heights.sz > 0 ? "too few samples in a row without holes" : "flat");
        return;
    }
    report_set(r,
               "$:{ limit_cycles_per_m:n limit_is_noise_floor:b curvature_above_limit:n nyquist_cycles_per_m:n "
               "oversampling:n exponent:n exponent_from_cycles_per_m:n exponent_to_cycles_per_m:n }",
               down ? "band_y" : "band_x", b->limit, b->noise, b->beyond, b->nyquist,
               limit ? b->nyquist / b->limit : 1.0, b->exponent, b->from, b->to);
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
    const struct surface_heights_period *p = &i->period;
    const struct heightfile *h = &i->h;
    bool map = h->rows > 1;
    double x = h->pitch_x, y = h->pitch_y, columns = (double)h->columns, rows = (double)h->rows;
    const char *bits = h->step > 0 ? ", integers of %d bits" : ", floating point of %d bits", *filled = "";
    report_set(r, ":{ file:s format:s title:s columns:z rows:z pitch_x_m:n pitch_y_m:n missing:z filled:z", i->file,
               h->format, h->title, h->columns, h->rows, x, map ? y : NAN, h->holes, h->filled);
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
        const struct surface_heights_ends *s = &i->ends[down];
        report_set(r, "$:{ step_rms_m:n jump_repeated_m:n slope_jump_mirrored:n fall_samples:[ :z :z ] fall_m:a }",
                   down ? "ends_y" : "ends_x", s->step, s->jump, s->kink, s->fall[0], s->fall[1], s->drop, 2);
        report_row(r, arena_format(i->arena, "repeated%s", where), "jumps by %s at the seam (neighbours differ by %s)",
                   len(i, s->jump), len(i, s->step));
        report_row(r, arena_format(i->arena, "mirrored%s", where), "slope changes by %.3g at the ends", s->kink);
    }
    if (!isnan(p->peak)) {
        report_set(r, "repetition:{ lag_samples:z autocorrelation:n stands_out:b }", p->lag, p->peak, p->stands_out);
        report_row(r, "autocorrelation", "highest %.2f at %s (%zu samples)", p->peak,
                   len(i, (double)p->lag * i->h.pitch_x), p->lag);
    }
    report_set(r, "warnings:t }", i->notes, i->n_notes);
    for (int k = 0; k < i->n_notes; k++)
        report_note(r, "  warning: ", i->notes[k]);
}

/* ------------------------------------------------------------------ the action */

static int surface_info_run(struct cmd_call *c, struct err *e)
{
    struct heightfile_options o;
    int worst = 0, n = 0;
    if (!surface_options(c, HEIGHTFILE_LEAVE, &o, e)) return (int)e->kind;
    struct report r = report_open(stdout, args_given(&c->args, "json"));
    report_set(&r, "surfaces:[");
    for (int k = 0; k < c->args.n_operands; k++) {
        struct err mine = {0};
        struct arena *own = arena_open(); /* the maps of many files need not all stay */
        struct surface_info *i = ARENA_TAKE(own, struct surface_info, 1);
        *i = (struct surface_info){.file = c->args.operands[k], .levelling = o.levelling, .arena = own};
        struct heightfile_options stored = o; /* the steps show in the heights as they are stored: levelling is last */
        stored.levelling = HEIGHTFILE_LEVEL_NONE;
        if (heightfile_load(i->file, &stored, own, &i->h, &mine)) {
            i->tilt = heightfile_level_fit(&i->h);
            surface_heights_steps(&i->h, &i->steps);
            i->h.levelled = heightfile_level(&i->h, (enum heightfile_levelling)i->levelling);
            surface_heights(&i->h, &i->heights);
            for (int down = 0; down < (i->h.rows > 1 ? 2 : 1); down++) {
                surface_heights_band(&i->h, down, &i->band[down]);
                surface_heights_ends(&i->h, down, &i->ends[down]);
            }
            surface_heights_period(&i->h, &i->period);
            find_faults(i);
            report_surface(&r, i);
            n++;
        } else
            message_error(c, "surface", &mine);
        worst = (int)mine.kind > worst ? (int)mine.kind : worst;
        arena_close(own);
    }
    if (n == 0) json_decref(r.open.at[0]);
    return n > 0 && !report_close(&r, 12, e) ? (int)e->kind : worst;
}

/* ------------------------------------------------------------------ convert: in another format, or a part of it */

/* X,Y,W,H, or X,W, each a length, into m: left, top, width, height (INFINITY of X,W). */
static bool read_crop(struct cmd_call *c, double crop[4], struct err *e)
{
    const char *text = args_value(&c->args, "crop");
    double x[4];
    int n = 0;
    if (!text) return true;
    for (char *rest = arena_text(c->arena, text), *p; (p = strsep(&rest, ","));) {
        struct units_fault fault = {NULL, NULL};
        if (n == 4 || !units_read(p, KEY_LENGTH, &x[n++], c->arena, &fault))
            return err_set(e, ERR_USAGE, "--crop: '%s': %s %s", text, fault.text ? p : "has",
                           fault.text ? fault.text : "more than four lengths");
    }
    if (n != 4 && n != 2)
        return err_set(e, ERR_USAGE,
                       "--crop: '%s' is not of the form X,Y,W,H (of a profile X,W), as in 1mm,1mm,5mm,5mm", text);
    crop[0] = x[0];
    crop[1] = n == 4 ? x[1] : 0;
    crop[2] = n == 4 ? x[2] : x[1];
    crop[3] = n == 4 ? x[3] : HUGE_VAL;
    return (crop[0] >= 0 && crop[1] >= 0 && crop[2] > 0 && crop[3] > 0) ||
           err_set(e, ERR_USAGE, "--crop: '%s': a part begins at 0 or later and is larger than 0", text);
}

/* The first sample and the number of samples of [from, from + size), in samples of one direction; sample i lies at i
 * pitch. */
static bool crop_range(const char *what, double from, double size, double pitch, size_t n, size_t range[2],
                       struct err *e)
{
    double first = ceil(from / pitch - 1e-6), last = ceil((from + size) / pitch - 1e-6);
    if (isinf(size)) last = (double)n;
    if (last > (double)n)
        return err_set(e, ERR_SCENE, "--crop: the %s goes from %g to %g m, and the map to %g m", what, from,
                       from + size, pitch * (double)n);
    if (last - first < 1)
        return err_set(e, ERR_SCENE, "--crop: no sample lies in the %s from %g to %g m; they are %g m apart", what,
                       from, from + size, pitch);
    range[0] = (size_t)first;
    range[1] = (size_t)(last - first);
    return true;
}

/* Keeps columns x[0] .. and rows y[0] ..; in place. */
static void crop_to(struct heightfile *h, const size_t x[2], const size_t y[2])
{
    for (size_t j = 0; j < y[1]; j++)
        memmove(h->z + j * x[1], h->z + (y[0] + j) * h->columns + x[0], x[1] * sizeof *h->z);
    h->columns = x[1];
    h->rows = y[1];
    h->holes = 0;
    for (size_t i = 0; i < h->columns * h->rows; i++)
        h->holes += isnan(h->z[i]);
}

static bool crop(struct heightfile *h, const double part[4], struct err *e)
{
    size_t x[2], y[2] = {0, 1};
    if (h->rows == 1 && isfinite(part[3])) return err_set(e, ERR_USAGE, "--crop: a profile has no height: give X,W");
    if (h->rows > 1 && isinf(part[3])) return err_set(e, ERR_USAGE, "--crop: a map needs X,Y,W,H");
    if (!crop_range("width", part[0], part[2], h->pitch_x, h->columns, x, e) ||
        (h->rows > 1 && !crop_range("height", part[1], part[3], h->pitch_y, h->rows, y, e)))
        return false;
    crop_to(h, x, y);
    return true;
}

/* One line: what was written, and what a reader of it has to know. */
static void report(const struct heightfile *h, const char *out, enum heightfile_format format,
                   const struct heightfile_written *w)
{
    printf("%s: ", out);
    if (h->rows > 1)
        printf("%zu x %zu samples, pitch %.9g um x %.9g um", h->columns, h->rows, h->pitch_x * 1e6, h->pitch_y * 1e6);
    else
        printf("%zu samples, pitch %.9g um", h->columns, h->pitch_x * 1e6);
    printf(", heights from %.6g to %.6g um", w->low * 1e6, (w->low + w->range) * 1e6);
    if (h->filled) printf(", missing points filled: %zu", h->filled);
    if (h->holes) printf(", missing points: %zu", h->holes);
    if (format == HEIGHTFILE_PNG)
        printf("; height range %.9g um (--height-range), 0 stands for %.9g um, steps of %.4g nm", w->range * 1e6,
               w->low * 1e6, w->step * 1e9);
    if (format == HEIGHTFILE_NPY || format == HEIGHTFILE_CSV || format == HEIGHTFILE_PNG)
        printf("; the format does not hold the pitch: give it when reading");
    putchar('\n');
}

static int surface_convert_run(struct cmd_call *c, struct err *e)
{
    struct heightfile h;
    struct heightfile_options o;
    struct heightfile_written w;
    enum heightfile_format format;
    double part[4] = {0};
    long row = -1;
    const char *in = c->args.operands[0], *out = c->args.operands[1];
    if (!heightfile_write_format(out, &format, e)) return (int)e->kind;
    if (args_given(&c->args, "text") && format != HEIGHTFILE_SDF)
        return err_set(e, ERR_USAGE, "--text is for SDF, which has two forms"), (int)e->kind;
    if (args_given(&c->args, "text")) format = HEIGHTFILE_SDF_TEXT;
    if (!cmd_spares(out, "the heights", in, "a file of another name", e) ||
        !mark_absent(out, args_given(&c->args, "force"), e) || !surface_options(c, HEIGHTFILE_REFUSE, &o, e) ||
        !read_crop(c, part, e) || !heightfile_load(in, &o, c->arena, &h, e) ||
        (args_given(&c->args, "crop") && !crop(&h, part, e)) ||
        !args_whole(&c->args, "row", (const long[2]){0, 0x7fffffff}, &row, e))
        return (int)e->kind;
    if (row >= (long)h.rows)
        return err_set(e, ERR_SCENE, "--row: row %ld is asked for, and the map has rows 0 to %zu", row, h.rows - 1),
               (int)e->kind;
    if (row >= 0) crop_to(&h, (const size_t[2]){0, h.columns}, (const size_t[2]){(size_t)row, 1});
    if (!heightfile_write(out, &h, format, &w, e)) return (int)e->kind;
    if (!args_given(&c->args, "quiet")) report(&h, out, format, &w);
    return 0;
}

/* rasp surface synth RECIPE OUT: a height map or profile of a procedural surface, that is of the roughness, ridges and
   grit of a recipe or scene, for programs that want files. Made by the stages that scrape it, so that the heights are
   the same; rasp itself needs no map of them: where the contact goes they are computed.

   A recipe is read through a scene that names it, the rest of which does not matter. */

struct synth {
    struct cmd_call *c;
    struct scene scene;
    double size[2], pitch; /* m; size[1] = 0: a profile */
    int along;
    struct heightfile h;
};

/* ------------------------------------------------------------------ what is asked for */

/* LENGTH or WxH; no unit has an x in it. */
static bool read_size(struct synth *s, struct err *e)
{
    static const double pitches[2] = {1e-8, 1e-3};
    const char *text = args_value(&s->c->args, "size");
    struct units_fault fault = {NULL, NULL};
    s->pitch = NAN;
    if (!text || !args_given(&s->c->args, "pitch"))
        return err_set(e, ERR_USAGE,
                       "--size and --pitch are needed, as in --size 20mm --pitch 5um, or --size 2mmx1mm for a map");
    char *width = arena_text(s->c->arena, text), *height = strchr(width, 'x');
    if (height) *height++ = '\0';
    if (!units_read(width, KEY_LENGTH, &s->size[0], s->c->arena, &fault) ||
        (height && !units_read(height, KEY_LENGTH, &s->size[1], s->c->arena, &fault)))
        return err_set(e, ERR_USAGE, "--size: '%s' %s; write a length (a profile) or WIDTHxHEIGHT (a map)", text,
                       fault.text);
    if (!surface_length(s->c, "pitch", pitches, &s->pitch, e)) return false;
    s->h.columns = (size_t)fmin(fmax(s->size[0] / s->pitch + 0.5, 0), 1e18);
    s->h.rows = height ? (size_t)fmin(fmax(s->size[1] / s->pitch + 0.5, 0), 1e18) : 1;
    if (s->h.columns < 4 || (height && s->h.rows < 4))
        return err_set(e, ERR_USAGE, "--size: %s at a pitch of %g m is less than 4 samples along a side", text,
                       s->pitch);
    return s->h.columns <= HEIGHTFILE_MOST / s->h.rows ||
           err_set(e, ERR_USAGE,
                   "--size: %s at a pitch of %g m is more than 2^28 samples; ask for a smaller map or a larger pitch",
                   text, s->pitch);
}

/* ------------------------------------------------------------------ making */

static bool make(struct synth *s, struct err *e)
{
    const struct stage *stages[] = {&roughness_stage, &ridges_stage, &grit_stage};
    struct relief relief = {.along = s->along};
    struct board board = {.relief = &relief};
    struct stage_run run[3];
    bool ok = true;
    for (int k = 0; k < 3; k++) {
        run[k] = (struct stage_run){.stage = stages[k],
                                    .scene = &s->scene,
                                    .contact = &s->scene.contacts[0],
                                    .board = &board,
                                    .arena = s->c->arena};
        ok = ok && (!stages_wanted(stages[k], run[k].contact, &s->scene) || stages[k]->open(&run[k], e));
    }
    for (int k = 0; k < board.n_warnings; k++)
        message_remark(s->c, "surface", board.warnings[k]);
    struct heightfile *h = &s->h;
    double *x = ARENA_TAKE(s->c->arena, double, h->columns), *y = ARENA_TAKE(s->c->arena, double, h->columns);
    if (ok) h->z = ARENA_TAKE(s->c->arena, double, h->rows * h->columns);
    for (size_t j = 0; ok && j < h->rows; j++) {
        for (size_t i = 0; i < h->columns; i++) {
            x[i] = (double)i * s->pitch;
            y[i] = (double)j * s->pitch;
        }
        relief_at(&relief, &(struct relief_points){h->columns, x, s->along == ALONG_PLANE ? y : NULL},
                  &(struct relief_values){.z = h->z + j * h->columns});
    }
    for (int k = 0; k < 3; k++)
        if (stages[k]->close) stages[k]->close(&run[k]);
    return ok;
}

static int surface_synth_run(struct cmd_call *c, struct err *e)
{
    struct synth s = {.c = c};
    enum heightfile_format format;
    struct heightfile_written w;
    const char *out = c->args.operands[1];
    const char *file = c->args.operands[0],
               *rest = "scraper: {mass: 1 g}\nmotion: {path: line, to: [1 cm, 0], speed: 1 cm/s}\noutput: "
                       "{diagnostics: {rate: 1 kHz}}\n";
    if (!heightfile_write_format(out, &format, e) || !read_size(&s, e) || !cmd_recipe_read(c, file, rest, &s.scene, e))
        return (int)e->kind;
    const struct contact *k = &s.scene.contacts[0];
    if (s.scene.n_contacts > 1)
        err_set(e, ERR_SCENE, "%s: has %d contacts; synth takes a recipe, or a scene of one contact", file,
                s.scene.n_contacts);
    else if (params_given(k, height_map_stage.params))
        err_set(e, ERR_SCENE,
                "%s: surface.height_map is measured, and needs no synth; rasp surface convert writes it in another "
                "format",
                file);
    else if (!params_given(k, roughness_stage.params) && !params_given(k, ridges_stage.params) &&
             !params_given(k, grit_stage.params))
        err_set(e, ERR_SCENE, "%s: has no roughness, ridges or grit: there is no procedural surface in it", file);
    if (e->kind) return (int)e->kind;
    int n; /* it is neither the recipe, nor what that includes, nor the map whose statistics it has */
    const struct outputs_source *sources = outputs_sources(&s.scene, &n, c->arena);
    for (int i = 0; i < n; i++)
        if (!cmd_spares(out, "the heights", sources[i].file, "a file of another name", e)) return (int)e->kind;
    static const char *const words[] = {"path", "x", "plane", NULL};
    int own = k->surface.along, word = -1;
    if (!mark_absent(out, args_given(&c->args, "force"), e) || !args_word(&c->args, "along", words, &word, e))
        return (int)e->kind;
    /* A word of --along, else the scene's, else what the size asks for. */
    s.along = word >= 0 ? ALONG_PATH + word : own != ALONG_AUTO ? own : s.h.rows > 1 ? ALONG_PLANE : ALONG_PATH;
    if (s.h.rows > 1 && s.along != ALONG_PLANE)
        err_set(e, ERR_SCENE, "a surface along %s is a profile: give --size one length, or --along plane",
                words[s.along - ALONG_PATH]);
    if (e->kind || !make(&s, e)) return (int)e->kind;
    s.h.pitch_x = s.h.pitch_y = s.pitch;
    s.h.metric = true;
    s.h.title = s.scene.title;
    if (!heightfile_write(out, &s.h, format, &w, e)) return (int)e->kind;
    if (args_given(&c->args, "quiet")) return 0;
    double mean = 0, square = 0;
    size_t all = s.h.rows * s.h.columns;
    for (size_t i = 0; i < all; i++)
        mean += s.h.z[i] / (double)all;
    for (size_t i = 0; i < all; i++)
        square += (s.h.z[i] - mean) * (s.h.z[i] - mean) / (double)all;
    printf("%s: %zu%s samples, pitch %.9g um, rms height %.4g um\n", out, s.h.columns,
           s.h.rows > 1 ? arena_format(c->arena, " x %zu", s.h.rows) : "", s.pitch * 1e6, sqrt(square) * 1e6);
    return 0;
}

static const struct action actions[] = {
    {"info",
     "FILE...",
     1,
     -1,
     {"pitch", "height-scale", "height-range", "holes", "levelling", "json"},
     surface_info_run},
    {"convert",
     "IN OUT",
     2,
     2,
     {"pitch", "height-scale", "height-range", "holes", "levelling", "crop", "row", "text", "force", "quiet"},
     surface_convert_run},
    {"synth", "RECIPE OUT", 2, 2, {"size", "pitch", "along", "set", "seed", "force", "quiet"}, surface_synth_run},
    {NULL, NULL, 0, 0, {NULL}, NULL},
};

static const struct args_option options[] = {
    {"pitch", 0, "LENGTH", false,
     "distance between two samples; of read files, only for those that do not hold it (NPY, PNG, CSV)"},
    {"height-scale", 0, "LENGTH", false,
     "factor on the heights: what one stored unit of NPY or CSV stands for (default 1 m)"},
    {"height-range", 0, "LENGTH", false, "height that white, 65535, of a PNG stands for"},
    {"holes", 0, "refuse|fill|keep", false,
     "missing points: fill is by Laplace's equation; default: info keep, convert refuse"},
    {"levelling", 0, "none|mean|plane", false, "what is subtracted (plane, of a profile: line); default: none"},
    {"json", 'j', NULL, false, "info: prints the figures as one JSON object; null stands for one that is not there"},
    {"crop", 0, "X,Y,W,H", false, "convert: only this part: left, top, width, height, each a length; of a profile X,W"},
    {"row", 0, "K", false, "convert: only row K, counted from 0, as a profile"},
    {"text", 't', NULL, false, "convert: writes SDF as text (default: binary)"},
    {"size", 0, "SIZE", false, "synth: a length (a profile) or WIDTHxHEIGHT (a map), as in 20mm or 2mmx1mm"},
    {"along", 0, "path|x|plane", false,
     "synth: what it follows (x: the profile that a straight motion meets); default: that of the scene, or of the "
     "size"},
    CMD_SCENE_OPTIONS,
    {"force", 'f', NULL, false, "convert, synth: replaces OUT if it exists"},
    {"quiet", 'q', NULL, false, "convert, synth: prints nothing"},
    {0}};

const struct command surface_command = {
    .name = "surface",
    .group = "Surfaces and objects",
    .summary = "height maps: what they are like, other formats",
    .does =
        "rasp surface info FILE... says what height maps are like, one fact a line: size, roughness figures, missing "
        "points, and what looks like a fault. It also says how finely heights are stored against what the limiter "
        "lets through, how far the spectrum reaches, and what repeating or mirroring the map does at its ends. "
        "Nothing is levelled unless it is asked for.\n"
        "rasp surface synth RECIPE OUT writes the heights of a procedural surface (roughness, ridges, grit of a "
        "recipe or scene), by OUT's ending. Rendering needs no such file: it computes the heights where the contact "
        "goes.\n"
        "rasp surface convert IN OUT writes the map in another format, by OUT's ending: .gsf (float32), .gwy, .sdf, "
        ".npy (float64), .png (16 bits, 0 lowest, 65535 highest; what they stand for is printed), .csv. Heights are "
        "metres in all but PNG.\n"
        "GSF, GWY, SDF (text, binary), NPY, 16-bit grey PNG and CSV grids are read, told apart by content. What else "
        "Gwyddion reads, gwyddion --convert-to-gwy=OUT.gwy IN makes readable. A map has at most 2^28 samples (16384 x "
        "16384), for which 2 GiB of memory and the size of the file are taken.",
    .operands = "ACTION FILE...",
    .least = 1,
    .most = -1,
    .options = options,
    .actions = actions,
    .examples = "rasp surface info surfaces/ridged_plate.gsf\n"
                "rasp surface info --pitch 1.4um --levelling plane profile.npy\n"
                "rasp surface convert --holes fill map.sdf map.gsf\n"
                "rasp surface convert --crop '1mm,1mm,5mm,5mm' map.gwy part.gsf\n"
                "rasp surface convert --row 128 map.gsf profile.npy\n"
                "rasp surface synth --size 2mmx1mm --pitch 5um surfaces/sandpaper.yaml map.gsf\n",
};
