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

#include "num/fft.h"
#include "num/real.h"
#include "scene/rules.h"
#include "stage.h"
#include "surface/profile.h"
#include "surface/relief.h"
#include "trajectory/trajectory.h"

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
    long n = (long)rules_fractal_size(f);
    struct arena *a = arena_open();
    double *re = ARENA_TAKE(a, double, n / 2 + 1), *im = ARENA_TAKE(a, double, n / 2 + 1), most = 0;
    struct fft *fft = fft_open((size_t)n);
    lines_draw(f, stream, n, re, im);
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

static struct relief_part *knots_part(struct arena *a, const struct fractal *f, const double *z, long n)
{
    struct knots *s = ARENA_TAKE(a, struct knots, 1);
    bool linear = f->interpolation == INTERPOLATION_LINEAR;
    *s = (struct knots){n, f->pitch, z};
    struct relief_part *part = relief_endless(a, "fractal", f->pitch, linear ? linear_add : nearest_add, s);
    part->kinks = linear ? f->pitch : f->pitch / 2;
    return part;
}

struct relief_part *fractal_part(struct arena *a, const struct fractal *f, struct noise stream, struct err *e)
{
    double size = rules_fractal_size(f), *z;
    if (!rules_fractal_fits(f)) {
        err_set(e, ERR_SCENE,
                "surface.fractal: %g m at a pitch of %g m are %.0f heights, and from %d to %d are offered; %s",
                f->length, f->pitch, size, RULES_FRACTAL_LEAST, RULES_FRACTAL_MOST,
                size < RULES_FRACTAL_LEAST ? "raise length, or lower pitch" : "lower length, or raise pitch");
        return NULL;
    }
    z = ARENA_TAKE(a, double, (size_t)size);
    fractal_heights(f, stream, z);
    if (f->interpolation != INTERPOLATION_SPLINE) return knots_part(a, f, z, (long)size);
    struct profile *p = profile_from_samples(a, z, (size_t)size, f->pitch, OFF_MAP_WRAP);
    p->from = -HUGE_VAL;
    p->to = HUGE_VAL;
    return profile_part(a, p, "fractal", 0);
}

/* ------------------------------------------------------------------ the stage */

static bool fractal_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return c->surface.fractal.given;
}

static double fractal_work(const struct contact *c, const struct scene *s)
{
    return 8 * relief_readings(s, c->surface.fractal.pitch);
}

static bool fractal_fits(const struct stage_run *r, struct err *e)
{
    const struct contact *c = r->contact;
    if (r->board->relief->along == ALONG_PLANE)
        return err_set(e, ERR_SCENE,
                       "contact '%s': surface.fractal is a profile, and this surface lies in the plane; set "
                       "surface.along to path or x%s",
                       c->name,
                       c->surface.height_map ? " (and take one row of the map, with rasp surface convert --row)" : "");
    return c->surface.fractal.interpolation == INTERPOLATION_SPLINE || !isnan(c->scraper.radius) ||
           err_set(e, ERR_SCENE,
                   "contact '%s': surface.fractal.interpolation must be spline under a point, for which kinks and "
                   "steps are no surface; set it "
                   "to spline, or give scraper.radius",
                   c->name);
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
    const struct fractal *f = &r->contact->surface.fractal;
    struct noise stream = noise_make(r->scene->seed, arena_format(r->arena, "fractal/%s", r->contact->name));
    relief_decide(r->board->relief, r->contact);
    if (!fractal_fits(r, e)) return false;
    struct relief_part *part = fractal_part(r->arena, f, stream, e);
    if (!part) return err_at(e, "contact '%s'", r->contact->name);
    fractal_repeats(r, rules_fractal_size(f) * f->pitch);
    relief_add(r->board->relief, part);
    return true;
}

const struct stage fractal_stage = {
    .name = "fractal",
    .does = "fractal profile, heights on an even pitch",
    .paper = "002 sec. II-B, III-B",
    .idle = "no surface.fractal",
    .needs = ITEM_BIT(ITEM_SURFACE),
    .gives = ITEM_BIT(ITEM_SURFACE),
    .wanted = fractal_wanted,
    .work = fractal_work,
    .open = fractal_open,
};
