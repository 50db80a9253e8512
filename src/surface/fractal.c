/* Fractal profiles. papers/002, section II-B, takes a ground whose power spectrum is proportional to omega^beta, beta <
   0, and in section III-B a maximum height of the asperities of 0.1 um at a resolution of 0.1 mm and beta of -0.5 and
   -1; papers/004 S(omega) ~ 1/omega^beta with beta = 1.2 and a maximum of 1 nm. Here omega is the spatial frequency k,
   `exponent` the beta of 002 (of 004: -beta). n = length / pitch heights z_i at i pitch are

     z_i = sum over j = 1 .. n/2 - 1 of A_j cos(2 pi (i j / n + u_j)),   A_j ~ j^(beta/2) (spectrum: power) or j^beta
       (amplitude)

   with phases u_j, uniform in (0, 1), from the seed, and the sum scaled so that the largest |z_i| is `maximum`.

   What neither paper states, and what is taken here:
     what lies between the heights   `interpolation`; under nearest steps, whose edges belong to the higher side, under
                                     spline the largest height may be passed in between
     maximum of what                 |z| of the heights about their mean, which is 0
     the lowest frequency            1/length; the profile has that period. The highest is below 1/(2 pitch)
     phases or Gaussian amplitudes   phases alone: the periodogram of each draw is the power law itself, not only the
                                     mean of many
     S: of power or amplitude        `spectrum`; 002 says power. 004 says S, and that its amplitude is normalised:
                                     either */
#include "surface/fractal.h"

#include "base/stopwatch.h"
#include "num/fft.h"
#include "num/real.h"
#include "scene/rows.h"
#include "scene/scene_part.h"
#include "stage.h"
#include "surface/profile.h"
#include "surface/relief.h"
#include "trajectory/trajectory.h"

enum { FRACTAL_LEAST = 16, FRACTAL_MOST = 16777216 }; /* heights of a period */

/* ------------------------------------------------------------------ parameters */

static const struct choice spectra[] = {[SPECTRUM_POWER] = {"power", "the power spectrum goes with k^exponent"},
                                        [SPECTRUM_AMPLITUDE] = {"amplitude", "the amplitude spectrum does"},
                                        {NULL, NULL}};

static const struct choice between[] = {[INTERPOLATION_NEAREST] = {"nearest", "the nearest height: a flight of steps"},
                                        [INTERPOLATION_LINEAR] = {"linear", "straight lines"},
                                        [INTERPOLATION_SPLINE] = {"spline", "a cubic spline"},
                                        {NULL, NULL}};

static const struct key keys[] = {
    {ROW_NUMBER(fractal, exponent, "surface.fractal.exponent"), KEY_NONE, -6, 2, "-0.5", NULL,
     "beta of Conan et al. (2014a): slope of the spectrum over spatial frequency; the beta of 2014b is its negative"},
    {ROW_CHOICE(fractal, spectrum, "surface.fractal.spectrum"), KEY_NONE, 0, 0, "power", NULL,
     "of what the exponent is", spectra},
    {ROW_NUMBER(fractal, maximum, "surface.fractal.maximum"), KEY_LENGTH, 1e-12, 1e-3, "0.1 um", NULL,
     "largest height above or below the mean"},
    {ROW_NUMBER(fractal, pitch, "surface.fractal.pitch"), KEY_LENGTH, 1e-6, 1e-2, "0.1 mm", NULL,
     "distance from height to height"},
    {ROW_NUMBER(fractal, length, "surface.fractal.length"), KEY_LENGTH, 1e-3, 1000, "1 m", NULL,
     "length after which the profile repeats itself, to a whole number of heights"},
    {ROW_CHOICE(fractal, interpolation, "surface.fractal.interpolation"), KEY_NONE, 0, 0, "spline", NULL,
     "what lies between the heights; only under a ball or a round tip may it be other than spline", between},
    {.path = NULL}};

double fractal_size(const struct fractal *f) { return 2 * rint(f->length / f->pitch / 2); }

/* A profile, whose kinks and steps are a surface for what has a radius alone. */
static void check(const struct scene_part *p, const struct contact *c, const void *own)
{
    const char *section = "surface.fractal", *interpolation = "surface.fractal.interpolation",
               *pitch = "surface.fractal.pitch", *length = "surface.fractal.length", *along = "surface.along";
    const struct fractal *f = own;
    double heights = fractal_size(f); /* NAN: pitch or length is wrong, and that is said */
    if (heights < FRACTAL_LEAST || heights > FRACTAL_MOST)
        scene_part_refuse(p, length, pitch,
                          heights < FRACTAL_LEAST ? "raise length, or lower pitch" : "lower length, or raise pitch",
                          " over %s is %.4g, and from %d to %d heights are offered", scene_part_label(p, pitch),
                          f->length / f->pitch, FRACTAL_LEAST, FRACTAL_MOST);
    if (scene_part_known(p, along) && relief_along(c) == ALONG_PLANE)
        diag_add(p->yaml->diag,
                 yaml_find(p->map, along) ? scene_part_later(p, section, along) : yaml_find(p->map, section)->key->at,
                 "set surface.along to path or x", "%s is a profile, and this surface lies in the plane",
                 scene_part_label(p, section));
    if (f->interpolation != INTERPOLATION_SPLINE && scene_part_known(p, interpolation) &&
        c->contact.model == CONTACT_SCRAPE && !yaml_find(p->map, "scraper.radius"))
        scene_part_refuse(p, interpolation, interpolation, "set it to spline, or give scraper.radius",
                          " must be spline where the scraper is a point: kinks and steps are no surface for it");
}

static double likely_finest(const void *own) { return ((const struct fractal *)own)->pitch; }

static double likely_span(const void *own) { return 2 * ((const struct fractal *)own)->maximum; }

static const struct params fractal_params = {
    .section = "surface.fractal",
    .meaning = "a fractal profile as the papers on rolling have it: heights on an even pitch, drawn from the seed",
    .size = sizeof(struct fractal),
    .keys = keys,
    .check = check,
    .ground = &(const struct params_ground){.kinked = true, .finest = likely_finest, .span = likely_span},
};

static const struct fractal *fractal_of(const struct contact *c) { return params_of(c, &fractal_params); }

/* ------------------------------------------------------------------ the heights */

static void lines_draw(const struct fractal *f, struct noise stream, long n, double *re, double *im)
{
    double power = f->spectrum == SPECTRUM_POWER ? f->exponent / 2 : f->exponent;
    re[0] = im[0] = re[n / 2] = im[n / 2] = 0;
    for (long j = 1; j < n / 2; j++) {
        double amplitude = real_exp(power * real_log((double)j / (double)n)),
               turns = noise_uniform(stream, (uint64_t)j, 0);
        re[j] = amplitude * real_cospi(2 * turns);
        im[j] = amplitude * real_sinpi(2 * turns);
    }
}

void fractal_heights(const struct fractal *f, struct noise stream, double *z)
{
    long n = (long)fractal_size(f);
    struct arena *a = arena_open();
    double *re = ARENA_TAKE(a, double, n / 2 + 1), *im = ARENA_TAKE(a, double, n / 2 + 1), most = 0;
    struct fft *fft = fft_open((size_t)n);
    lines_draw(f, stream, n, re, im);
    stopwatch_spend(120 * (double)n);
    fft_inverse(fft, re, im, z);
    fft_close(fft);
    arena_close(a);
    for (long i = 0; i < n; i++)
        most = fmax(most, fabs(z[i]));
    for (long i = 0; i < n; i++)
        z[i] = z[i] / most * f->maximum;
}

/* ------------------------------------------------------------------ what lies between: steps and straight lines */

struct knots {
    long n;
    double pitch;
    const double *z;
};

static double knot_at(const struct knots *s, double i)
{
    double period = (double)s->n, wrapped = i - period * floor(i / period);
    return s->z[wrapped < period ? (long)wrapped : 0];
}

static void linear_add(struct relief_part *part, const struct relief_points *p, const struct relief_values *v)
{
    const struct knots *s = part->state;
    for (size_t i = 0; i < p->n; i++) {
        double q = p->x[i] / s->pitch, cell = floor(q), from = knot_at(s, cell), rise = knot_at(s, cell + 1) - from;
        if (v->z) v->z[i] += from + (q - cell) * rise;
        if (v->x) v->x[i] += rise / s->pitch;
    }
}

#define STEP_EDGE 1e-9 /* of the pitch: nearer to a step than rounding can tell */

static void nearest_add(struct relief_part *part, const struct relief_points *p, const struct relief_values *v)
{
    const struct knots *s = part->state;
    for (size_t i = 0; v->z && i < p->n; i++) {
        double q = p->x[i] / s->pitch, before = floor(q - 0.5 + STEP_EDGE), after = floor(q + 0.5 + STEP_EDGE);
        double z = knot_at(s, after);
        v->z[i] += q - 0.5 - before < STEP_EDGE ? fmax(z, knot_at(s, before)) : z;
    }
}

struct relief_part *fractal_part(struct arena *a, const struct fractal *f, struct noise stream)
{
    long n = (long)fractal_size(f);
    double *z = ARENA_TAKE(a, double, n);
    fractal_heights(f, stream, z);
    if (f->interpolation != INTERPOLATION_SPLINE) {
        struct knots *s = ARENA_TAKE(a, struct knots, 1);
        bool linear = f->interpolation == INTERPOLATION_LINEAR;
        *s = (struct knots){n, f->pitch, z};
        struct relief_part *part = relief_endless(a, "fractal", f->pitch, linear ? linear_add : nearest_add, s);
        part->kinks = linear ? f->pitch : f->pitch / 2;
        return part;
    }
    struct profile *p = profile_from_samples(a, z, (size_t)n, f->pitch, OFF_MAP_WRAP);
    p->from = -HUGE_VAL;
    p->to = HUGE_VAL;
    return profile_part(a, p, "fractal", 0);
}

/* ------------------------------------------------------------------ the stage */

static double fractal_work(const struct contact *c, const struct scene *s)
{
    return 8 * relief_readings(c, s, fractal_of(c)->pitch);
}

static bool surface_fits(const struct stage_run *r, struct err *e)
{
    const struct contact *c = r->contact;
    if (r->board->relief->along == ALONG_PLANE)
        return err_set(e, ERR_SCENE,
                       "contact '%s': surface.fractal is a profile, and this surface lies in the plane; set "
                       "surface.along to path or x%s",
                       c->name,
                       r->board->height_map ? " (and take one row of the map, with rasp surface convert --row)" : "");
    return fractal_of(c)->interpolation == INTERPOLATION_SPLINE || relief_tipped(c) ||
           err_set(e, ERR_SCENE,
                   "contact '%s': surface.fractal.interpolation must be spline under a point, for which kinks and "
                   "steps are no surface; set it "
                   "to spline, or %s",
                   c->name, c->ball.point ? "contact.roll.follows to ball" : "give scraper.radius");
}

/* A whole period and more: the sound repeats itself as the profile does. */
static void fractal_repeats(struct stage_run *r, double period)
{
    const struct trajectory *tr = r->board->trajectory;
    double length = r->board->relief->along == ALONG_PATH ? tr->reach[1] - tr->reach[0] : tr->box[1][0] - tr->box[0][0];
    if (length > period * (1 + 1e-9))
        board_warn(r->board, arena_format(r->arena,
                                          "%s: the motion goes over %.4g m, and surface.fractal repeats itself every "
                                          "%.4g m; raise surface.fractal.length "
                                          "if that is not meant",
                                          r->contact->name, length, period));
}

static bool fractal_open(struct stage_run *r, struct err *e)
{
    const struct fractal *f = fractal_of(r->contact);
    struct noise stream = noise_make(r->scene->seed, arena_format(r->arena, "fractal/%s", r->contact->name));
    relief_decide(r->board->relief, r->contact);
    if (!surface_fits(r, e)) return false;
    fractal_repeats(r, fractal_size(f) * f->pitch);
    relief_add(r->board->relief, fractal_part(r->arena, f, stream));
    return true;
}

const struct stage fractal_stage = {
    .name = "fractal",
    .does = "fractal profile, heights on an even pitch",
    .paper = "002 sec. II-B, III-B",
    .idle = "no surface.fractal",
    .params = &fractal_params,
    .needs = ITEM_BIT(ITEM_SURFACE),
    .gives = ITEM_BIT(ITEM_SURFACE),
    .work = fractal_work,
    .open = fractal_open,
};
