/* papers/003 section B: peaks of the power spectrogram (equation 6) in frequency, and a fit of the local shape around
   each, over the frames in which it stands above the noise: in frame m at bin k

     P[m, k] = |A/2|^2 e^(-2 d t_m) |W(omega_k - omega, d)|^2 + N_k,   W(x, d) = sum_j w[j] e^(-(d + j x) j/rate),

   W the window's own transform of a decaying sinusoid, closed for Hann's window (three geometric sums). f, d and |A| by
   least squares of log P (GSL, Levenberg and Marquardt), each bin weighted by its amplitude over its frame's greatest
   (far bins hold the neighbours' skirts) and by 1/(TRUST^2 + N/P)^(1/2), what noise does to log P. A peak whose fit
   leaves more than a tenth of its energy, sum (sqrt P - sqrt model)^2/sum P, is none. The paper says neither window
   nor patch: here Hann of about 0.09 s, hop a quarter, 5 bins. Later frames are searched too: a mode may show only when
   a stronger, faster one has gone. Phases, which the power does not hold, and gains come from the same least squares as
   all modes', the poles as they are. It is the loudest stretch that is looked at, from the hammer's end on. Two modes
   within two bins of each other (20 Hz) are one peak. */
#include <gsl/gsl_multifit_nlinear.h>
#include <gsl/gsl_sort.h>
#include <math.h>
#include <string.h>

#include "analysis/modal_fit.h"
#include "num/fft.h"

enum { SIDE = 2, FRAMES = 40, LEAST = 4, STEPS = 100 };

#define SECONDS 0.08
#define STANDS 30.0 /* power of a peak over the noise */
#define TRUST 0.01
#define MOST_LEFT 0.1 /* share of its energy that a patch's fit leaves, else it is none */
#define FALLEN 8.0    /* ... of the last frame of its patch */

struct spectrogram {
    long size, hop, frames, bins;
    double rate;
    double *power;  /* [frames][bins] summed over places */
    double *noise;  /* [bins] */
    double *window; /* [size] */
};

static void frames_add(struct spectrogram *s, const double *h, struct arena *a)
{
    struct fft *fft = fft_open((size_t)s->size);
    double *x = ARENA_TAKE(a, double, s->size), *re = ARENA_TAKE(a, double, s->bins),
           *im = ARENA_TAKE(a, double, s->bins);
    for (long m = 0; m < s->frames; m++) {
        for (long j = 0; j < s->size; j++)
            x[j] = s->window[j] * h[m * s->hop + j];
        fft_forward(fft, x, re, im);
        for (long k = 0; k < s->bins; k++)
            s->power[m * s->bins + k] += re[k] * re[k] + im[k] * im[k];
    }
    fft_close(fft);
}

/* The median of the last quarter's frames and 2 x 8 + 1 bins: between the peaks of what still rings. */
static void noise_make(struct spectrogram *s, struct arena *a)
{
    long from = s->frames - (s->frames + 3) / 4;
    double *list = ARENA_TAKE(a, double, (s->frames - from) * 17);
    for (long k = 0; k < s->bins; k++) {
        long n = 0;
        for (long m = from; m < s->frames; m++)
            for (long i = k > 8 ? k - 8 : 0; i <= k + 8 && i < s->bins; i++)
                list[n++] = s->power[m * s->bins + i];
        gsl_sort(list, 1, (size_t)n);
        s->noise[k] = list[n / 2] / 0.69; /* median of an exponential distribution: log 2 of its mean */
    }
}

static void spectrogram_open(struct spectrogram *s, const double *y, long n, double rate, struct arena *a)
{
    long size = 16;
    while ((double)size < SECONDS * rate && size * 2 <= n / 4)
        size *= 2;
    *s = (struct spectrogram){.size = size, .hop = size / 4, .bins = size / 2 + 1, .rate = rate};
    s->frames = (n - size) / s->hop + 1;
    s->power = ARENA_TAKE(a, double, s->frames * s->bins);
    s->noise = ARENA_TAKE(a, double, s->bins);
    s->window = ARENA_TAKE(a, double, size);
    for (long j = 0; j < size; j++)
        s->window[j] = 0.5 - 0.5 * real_cospi(2 * (double)j / (double)size);
    frames_add(s, y, a);
    noise_make(s, a);
}

/* (1 - e^(w q))/(1 - e^q), q = -d + j x per sample, d > 0; e^(w q) given. */
static cplx geometric(double d, double x, cplx end)
{
    return cplx_div((cplx){1.0 - end.re, -end.im}, cplx_sub((cplx){1.0, 0.0}, cplx_exp((cplx){-d, x}, 1.0)));
}

/* |W|^2 at x rad per sample off the mode, d per sample: the sums at x, and a bin above and below. */
static double shape(double d, double x, double size)
{
    double bin = 2 * REAL_PI / size;
    cplx end = cplx_exp((cplx){-d, x}, size);
    return cplx_square(cplx_sub(cplx_scale(0.5, geometric(d, x, end)),
                                cplx_scale(0.25, cplx_add(geometric(d, x + bin, end), geometric(d, x - bin, end)))));
}

struct patch {
    const struct spectrogram *s;
    long frame, frames, bin;
};

/* Power of the model: at[0] bins off the patch's middle, at[1] log of the decay per sample, at[2] log |A/2|^2 in its
 * first frame. */
static double model(const struct patch *p, const double at[3], long frame, long k)
{
    double size = (double)p->s->size, bin = 2 * REAL_PI / size, d = real_exp(at[1]);
    return real_exp(at[2] - 2 * d * (double)(frame * p->s->hop)) * shape(d, bin * ((double)(p->bin - k) + at[0]), size);
}

static double measured(const struct patch *p, long frame, long k)
{
    return p->s->power[(p->frame + frame) * p->s->bins + k];
}

static int residuals(const gsl_vector *x, void *context, gsl_vector *out)
{
    const struct patch *p = context;
    const double at[3] = {gsl_vector_get(x, 0), gsl_vector_get(x, 1), gsl_vector_get(x, 2)};
    size_t i = 0;
    for (long m = 0; m < p->frames; m++) {
        double most = 1e-290;
        for (long k = p->bin - SIDE; k <= p->bin + SIDE; k++)
            most = fmax(most, measured(p, m, k));
        for (long k = p->bin - SIDE; k <= p->bin + SIDE; k++) {
            double power = fmax(measured(p, m, k), 1e-290), uncertainty = sqrt(TRUST * TRUST + p->s->noise[k] / power);
            gsl_vector_set(out, i++,
                           sqrt(power / most) / uncertainty * real_log((model(p, at, m, k) + p->s->noise[k]) / power));
        }
    }
    return GSL_SUCCESS;
}

/* Share of the patch's energy that the model leaves. */
static double left(const struct patch *p, const double at[3])
{
    double sum = 0, all = 0;
    for (long m = 0; m < p->frames; m++)
        for (long k = p->bin - SIDE; k <= p->bin + SIDE; k++) {
            double x = sqrt(measured(p, m, k)), y = sqrt(model(p, at, m, k) + p->s->noise[k]);
            sum += (x - y) * (x - y);
            all += x * x;
        }
    return all > 0 ? sum / all : 1;
}

/* The fit; pole: decay in 1/s, omega in rad/s. */
static bool patch_fit(const struct patch *p, double pole[2])
{
    const gsl_multifit_nlinear_parameters how = gsl_multifit_nlinear_default_parameters();
    double ratio = measured(p, p->frames - 1, p->bin) / measured(p, 0, p->bin),
           span = (double)((p->frames - 1) * p->s->hop);
    double d = fmax(-real_log(ratio) / (2 * span), 0.1 / span), start[3] = {0, real_log(d), 0}, at[3];
    start[2] = real_log(measured(p, 0, p->bin) / shape(d, 0, (double)p->s->size));
    gsl_multifit_nlinear_fdf fdf = {
        .f = residuals, .n = (size_t)(p->frames * (2 * SIDE + 1)), .p = 3, .params = (void *)(uintptr_t)p};
    gsl_multifit_nlinear_workspace *w = gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &how, fdf.n, 3);
    gsl_vector_view x = gsl_vector_view_array(start, 3);
    int info;
    if (!w) return false;
    bool good = gsl_multifit_nlinear_init(&x.vector, &fdf, w) == GSL_SUCCESS &&
                gsl_multifit_nlinear_driver(STEPS, 1e-9, 1e-9, 0, NULL, NULL, &info, w) == GSL_SUCCESS;
    for (size_t i = 0; i < 3; i++)
        at[i] = gsl_vector_get(gsl_multifit_nlinear_position(w), i);
    gsl_multifit_nlinear_free(w);
    pole[0] = real_exp(at[1]) * p->s->rate;
    pole[1] = 2 * REAL_PI * ((double)p->bin + at[0]) * p->s->rate / (double)p->s->size;
    return good && fabs(at[0]) < 1.5 && pole[0] < p->s->rate && left(p, at) < MOST_LEFT;
}

static bool peak(const struct spectrogram *s, long m, long k)
{
    const double *p = s->power + m * s->bins + k;
    return p[0] > STANDS * s->noise[k] && p[0] > p[-1] && p[0] >= p[1] && p[0] > p[-2] && p[0] >= p[2];
}

static bool taken(const struct modal_fit *f, double omega, double wide)
{
    for (int i = 0; i < f->m; i++)
        if (fabs(f->c[i].s.im - omega) < wide) return true;
    return false;
}

static void frame_search(const struct spectrogram *s, long m, struct modal_fit *f)
{
    double bin = 2 * REAL_PI * s->rate / (double)s->size, pole[2];
    for (long k = SIDE + 1; k < s->bins - SIDE - 1; k++) {
        struct patch p = {s, m, 0, k};
        if (!peak(s, m, k) || taken(f, bin * (double)k, 2 * bin)) continue;
        while (p.frames < FRAMES && m + p.frames < s->frames && measured(&p, p.frames, k) > FALLEN * s->noise[k])
            p.frames++;
        if (p.frames >= LEAST && patch_fit(&p, pole) && pole[0] < f->fastest && pole[1] > f->low && pole[1] < f->high &&
            !taken(f, pole[1], bin))
            modal_fit_add(f, (cplx){-pole[0], pole[1]}, NULL);
    }
}

void modal_spectrogram(struct modal_fit *f)
{
    const struct modal_data *d = f->data;
    struct spectrogram s;
    struct arena *a = arena_open();
    double most = -1.0;
    int loudest = 0;
    for (int k = 0; k < d->stretches; k++) {
        double energy = 0.0;
        for (long i = d->stretch[k].ringing; i < d->stretch[k].n; i++)
            energy += d->stretch[k].y[i] * d->stretch[k].y[i];
        if (d->stretch[k].fitted && energy > most) {
            most = energy;
            loudest = k;
        }
    }
    const struct modal_stretch *st = &d->stretch[loudest];
    spectrogram_open(&s, st->y + st->ringing, st->n - st->ringing, d->rate, a);
    for (long m = 0; m < s.frames; m += m < 4 ? 1 : m / 4)
        frame_search(&s, m, f);
    arena_close(a);
}
