/* rasp surface info: what height maps are like. First what looks like a fault, in words that say what to do. */
#include <math.h>
#include <stdio.h>

#include "analysis/surface_band.h"
#include "analysis/surface_ends.h"
#include "analysis/surface_heights.h"
#include "base/arena.h"
#include "base/wrap.h"
#include "cmd/surface.h"
#include "cmd/tell.h"
#include "file/heightfile_doubt.h"
#include "file/heightfile_level.h"
#include "file/heightfile_load.h"
#include "file/json_value.h"

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

static const char *len(const struct surface_info *i, double x) { return heightfile_doubt_length(x, i->arena); }

static void note_ends(struct surface_info *i, bool down)
{
    static const char *const ends[2][2] = {{"first", "last"}, {"top", "bottom"}};
    const struct surface_ends *s = &i->ends[down];
    for (int k = 0; k < 2; k++)
        if (s->fall[k])
            NOTE(i,
                 "the %s %zu %s fall away by %s, in steps unlike any other: an edge artefact of resampling; cut them "
                 "off (rasp surface convert "
                 "--crop)",
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
    const char *doubts[HEIGHTFILE_DOUBTS];
    int n = heightfile_doubt(&i->h, &heightfile_load_option_names, i->arena, doubts);
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
             "it will be heard; "
             "export more bits (float32), or smooth and resample to a wider pitch",
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
                 "smooth "
                 "it (a Gaussian of %s) before use",
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
             "end, so that neighbours every "
             "%zu samples are none?",
             p->lag, len(i, (double)p->lag * i->h.pitch_x), p->peak, p->lag);
}

/* The report of rasp surface info as text: one fact a line. */

static void print_steps(const struct surface_info *i)
{
    const struct surface_heights_steps *s = &i->steps;
    if (s->step == 0) {
        printf("  %-20s none seen (%zu of %zu heights are different)\n", "quantisation", s->levels, s->looked_at);
        return;
    }
    if (2.45 * s->noise < 0.01 / alphas[SURFACE_INFO_ALPHAS - 1]) {
        printf("  %-20s steps of %.3g nm: nothing beside the limiter (curvature noise %.2g 1/m)\n", "quantisation",
               s->step * 1e9, s->noise);
        return;
    }
    printf("  %-20s steps of %.4g nm (%zu of %zu heights are different)\n", "quantisation", s->step * 1e9, s->levels,
           s->looked_at);
    printf("  %-20s %.3g 1/m, at the spline's knots %.3g 1/m:", "its curvature noise", s->noise, 2.45 * s->noise);
    for (int k = 0; k < SURFACE_INFO_ALPHAS; k++)
        printf("%s %.3g %% of the limiter's %g 1/m", k ? "," : "", 100 * s->noise * alphas[k], 1 / alphas[k]);
    putchar('\n');
}

static void print_band(const struct surface_info *i, int down)
{
    const struct surface_band *b = &i->band[down];
    const char *where = i->h.rows == 1 ? "" : down ? " in y" : " in x";
    char label[32];
    snprintf(label, sizeof label, "band limit%s", where);
    if (b->segments == 0) {
        printf("  %-20s unknown: %s\n", label, i->heights.sz > 0 ? "too few samples in a row without holes" : "flat");
        return;
    }
    if (isnan(b->limit))
        printf("  %-20s none below the Nyquist frequency, %.4g cycles/mm\n", label, b->nyquist * 1e-3);
    else
        printf("  %-20s %.4g cycles/mm (wavelength %s), where it %s; %.3g times oversampled\n", label, b->limit * 1e-3,
               len(i, 1 / b->limit), b->noise ? "meets the noise floor" : "is 80 dB down", b->nyquist / b->limit);
    double top = isnan(b->limit) ? b->nyquist : b->limit;
    printf("  %-20s %.4g kHz at 10 cm/s\n", "heard up to", top * 0.1e-3);
    snprintf(label, sizeof label, "spectrum%s", where);
    if (!isnan(b->exponent))
        printf("  %-20s falls as k^%.3g from %.4g to %.4g cycles/mm\n", label, b->exponent, b->from * 1e-3,
               b->to * 1e-3);
}

static void print_ends(const struct surface_info *i, int down)
{
    const struct surface_ends *s = &i->ends[down];
    const char *where = i->h.rows == 1 ? "" : down ? " in y" : " in x";
    char label[32];
    snprintf(label, sizeof label, "repeated%s", where);
    printf("  %-20s jumps by %s at the seam (neighbours differ by %s)\n", label, len(i, s->jump), len(i, s->step));
    snprintf(label, sizeof label, "mirrored%s", where);
    printf("  %-20s slope changes by %.3g at the ends\n", label, s->kink);
}

static void surface_info_print(const struct surface_info *i)
{
    printf("%s\n", i->file);
    const struct heightfile *h = &i->h;
    printf("  %-20s %s", "format", h->format);
    if (h->bits)
        printf(h->step > 0 ? ", integers of %d bits" : ", floating point of %d bits", h->bits == 24   ? 32
                                                                                      : h->bits == 53 ? 64
                                                                                                      : h->bits);
    printf("%s%s%s\n", h->title ? ", \"" : "", h->title ? h->title : "", h->title ? "\"" : "");
    if (h->rows > 1) {
        printf("  %-20s map, %zu x %zu samples\n", "samples", h->columns, h->rows);
        printf("  %-20s %.4g mm x %.4g mm\n", "size", h->pitch_x * (double)h->columns * 1e3,
               h->pitch_y * (double)h->rows * 1e3);
        printf("  %-20s %.7g um x %.7g um\n", "pitch", h->pitch_x * 1e6, h->pitch_y * 1e6);
    } else {
        printf("  %-20s profile, %zu samples\n", "samples", h->columns);
        printf("  %-20s %.5g mm\n", "size", h->pitch_x * (double)h->columns * 1e3);
        printf("  %-20s %.7g um\n", "pitch", h->pitch_x * 1e6);
    }
    printf("  %-20s %zu", "missing points", h->holes);
    if (h->filled) printf(", and %zu filled", h->filled);
    putchar('\n');
    static const char *const words[] = {"none", "mean", "plane"};
    const char *word = i->levelling == 2 && i->h.rows == 1 ? "line" : words[i->levelling];
    printf("  %-20s %s%s\n", "levelling", word, i->levelling ? " subtracted" : "");
    printf("  %-20s mean %s, slope %.4g um/mm", "as stored", len(i, i->tilt.mean), i->tilt.slope_x * 1e3);
    if (i->h.rows > 1) printf(" in x, %.4g um/mm in y", i->tilt.slope_y * 1e3);
    putchar('\n');
    const struct surface_heights *s = &i->heights;
    char letter = i->h.rows > 1 ? 'S' : 'R';
    printf("  %ca                   %s\n  %cq                   %s\n", letter, len(i, s->sa), letter, len(i, s->sq));
    if (!isnan(s->ssk))
        printf("  %csk                  %.4g\n  %cku                  %.4g\n", letter, s->ssk, letter, s->sku);
    printf("  %cz                   %s\n", letter, len(i, s->sz));
    printf("  %-20s %.4g", "rms slope", s->slope);
    printf(i->h.rows > 1 ? " in x, %.4g in y\n" : "\n", s->slope_y);
    printf("  %-20s %.4g 1/m", "rms curvature", s->curvature);
    printf(i->h.rows > 1 ? " in x, %.4g 1/m in y\n" : "\n", s->curvature_y);
    print_steps(i);
    for (int down = 0; down < (i->h.rows > 1 ? 2 : 1); down++) {
        print_band(i, down);
        print_ends(i, down);
    }
    if (!isnan(i->period.peak))
        printf("  %-20s highest %.2f at %s (%zu samples)\n", "autocorrelation", i->period.peak,
               len(i, (double)i->period.lag * i->h.pitch_x), i->period.lag);
    for (int k = 0; k < i->n_notes; k++) {
        printf("  warning: ");
        wrap_print(stdout, i->notes[k], 11, "           ");
    }
}

/* The report of rasp surface info as JSON: SI units, null for what is not there. */

static json_t *json_heights(const struct surface_heights *s)
{
    return json_pack("{s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "mean_m", json_value_number(s->mean), "sa_m",
                     json_value_number(s->sa), "sq_m", json_value_number(s->sq), "ssk", json_value_number(s->ssk),
                     "sku", json_value_number(s->sku), "sz_m", json_value_number(s->sz), "slope_rms_x",
                     json_value_number(s->slope), "slope_rms_y", json_value_number(s->slope_y), "curvature_rms_x_per_m",
                     json_value_number(s->curvature), "curvature_rms_y_per_m", json_value_number(s->curvature_y));
}

static json_t *json_steps(const struct surface_heights_steps *s)
{
    json_t *limits = json_array();
    for (int k = 0; k < SURFACE_INFO_ALPHAS; k++)
        json_array_append_new(limits,
                              json_pack("{s:f, s:f}", "alpha_m", alphas[k], "noise_over_limit", s->noise * alphas[k]));
    return json_pack("{s:f, s:I, s:I, s:f, s:f, s:o}", "step_m", s->step, "levels", (json_int_t)s->levels,
                     "heights_looked_at", (json_int_t)s->looked_at, "curvature_noise_per_m", s->noise,
                     "curvature_noise_at_knots_per_m", 2.45 * s->noise, "limiter", limits);
}

static json_t *json_band(const struct surface_band *b)
{
    if (b->segments == 0) return json_null();
    return json_pack("{s:o, s:b, s:o, s:f, s:o, s:o, s:o, s:o}", "limit_cycles_per_m", json_value_number(b->limit),
                     "limit_is_noise_floor", b->noise, "curvature_above_limit", json_value_number(b->beyond),
                     "nyquist_cycles_per_m", b->nyquist, "oversampling",
                     json_value_number(isnan(b->limit) ? 1 : b->nyquist / b->limit), "exponent",
                     json_value_number(b->exponent), "exponent_from_cycles_per_m", json_value_number(b->from),
                     "exponent_to_cycles_per_m", json_value_number(b->to));
}

static json_t *json_ends(const struct surface_ends *s)
{
    return json_pack("{s:o, s:o, s:o, s:[I, I], s:[o, o]}", "step_rms_m", json_value_number(s->step), "jump_repeated_m",
                     json_value_number(s->jump), "slope_jump_mirrored", json_value_number(s->kink), "fall_samples",
                     (json_int_t)s->fall[0], (json_int_t)s->fall[1], "fall_m", json_value_number(s->drop[0]),
                     json_value_number(s->drop[1]));
}

static json_t *json_period(const struct surface_ends_period *p)
{
    if (isnan(p->peak)) return json_null();
    return json_pack("{s:I, s:f, s:b}", "lag_samples", (json_int_t)p->lag, "autocorrelation", p->peak, "stands_out",
                     p->stands_out);
}

static json_t *json_one(const struct surface_info *i)
{
    static const char *const levellings[] = {"none", "mean", "plane"};
    const struct heightfile *h = &i->h;
    bool map = h->rows > 1;
    json_t *notes = json_array();
    for (int k = 0; k < i->n_notes; k++)
        json_array_append_new(notes, json_value_text(i->notes[k]));
    return json_pack(
        "{s:o, s:s, s:o, s:I, s:I, s:o, s:o, s:I, s:I, s:s, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "file",
        json_value_text(i->file), "format", h->format, "title", json_value_text(h->title), "columns",
        (json_int_t)h->columns, "rows", (json_int_t)h->rows, "pitch_x_m", json_value_number(h->pitch_x), "pitch_y_m",
        json_value_number(map ? h->pitch_y : NAN), "missing", (json_int_t)h->holes, "filled", (json_int_t)h->filled,
        "levelling", levellings[i->levelling], "slope_x", json_value_number(i->tilt.slope_x), "slope_y",
        json_value_number(map ? i->tilt.slope_y : NAN), "heights", json_heights(&i->heights), "quantisation",
        json_steps(&i->steps), "band_x", json_band(&i->band[0]), "band_y", map ? json_band(&i->band[1]) : json_null(),
        "ends_x", json_ends(&i->ends[0]), "ends_y", map ? json_ends(&i->ends[1]) : json_null(), "repetition",
        json_period(&i->period), "warnings", notes);
}

/* The report of several files as one object on stdout. ERR_IO */
static bool surface_info_json(const struct surface_info *const *list, int n, struct err *e)
{
    json_t *all = json_array(), *j;
    for (int k = 0; k < n; k++)
        json_array_append_new(all, json_one(list[k]));
    j = json_pack("{s:o}", "surfaces", all);
    bool ok = j && json_dumpf(j, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(12)) == 0;
    putchar('\n');
    json_decref(j);
    return ok || err_set(e, ERR_IO, "the report cannot be written as JSON");
}

/* rasp surface info FILE...: gathers; notes say what looks like a fault.
 */

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
    bool json = args_given(&c->args, "json");
    int worst = 0, n = 0;
    const struct surface_info **list = ARENA_TAKE(c->arena, const struct surface_info *, c->args.n_operands);
    if (!surface_options(c, HEIGHTFILE_KEEP, &o, e)) return (int)e->kind;
    for (int k = 0; k < c->args.n_operands; k++) {
        struct err mine = {0};
        struct arena *own = json ? c->arena : arena_open(); /* the maps of many files need not all stay */
        struct surface_info *i = ARENA_TAKE(own, struct surface_info, 1);
        *i = (struct surface_info){.file = c->args.operands[k], .arena = own};
        bool ok = gather(i, o, &mine);
        if (!ok)
            tell_error(c, "surface", &mine);
        else if (json)
            list[n++] = i;
        else
            surface_info_print(i);
        worst = (int)mine.kind > worst ? (int)mine.kind : worst;
        if (!json) arena_close(own);
    }
    if (json && n > 0 && !surface_info_json(list, n, e)) return (int)e->kind;
    return worst;
}
