/* What `rasp modes extract` writes of the modes: the mode table, the report, the picture. */
#include <math.h>
#include <stdio.h>

#include "cmd/modes_extract.h"
#include "cmd/report.h"
#include "num/fft.h"
#include "num/real.h"

static double t60(const struct modal_mode *m) { return 3.0 * real_log(10.0) / m->decay; }

/* ------------------------------------------------------------------ table */

static void comments(FILE *f, const struct modes_extract *x)
{
    const struct modes_extract_given *g = &x->given;
    fprintf(f, "# poles: shared\n# quantity: %s\n", modes_quantity_name(x->quantity));
    if (x->why_not)
        fprintf(f, "# normalisation: relative: %s\n", x->why_not);
    else
        fprintf(f, "# normalisation: (%s)/(N s), physical\n", modes_quantity_unit(x->quantity));
    for (int k = 0; k < x->n; k++) {
        const struct modes_extract_place *p = &x->place[k];
        fprintf(f, "# source %d: %s, sha256 %s\n", k + 1, p->name, p->hash);
        if (!g->impulse) fprintf(f, "# strikes %d: %d of %d used\n", k + 1, p->strikes.used, p->strikes.n);
    }
    fprintf(f, "# method: %s, then output error on DFT bins, %.6g to %.6g Hz at %g Hz\n",
            g->spectrogram ? "peaks of the power spectrogram" : "ESPRIT in sub-bands", x->low, x->high, x->rate);
    for (int k = 0; k < x->n; k++)
        fprintf(f, "# explained %d: %.4g of the energy in the band that does not follow the force at once\n", k + 1,
                x->place[k].explained);
    if (g->quantity == MODES_PRESSURE && !isnan(g->radius))
        fprintf(f, "# radiation: a monopole of %.9g m at %.9g m is divided out\n# radius_m: %.9g\n", g->radius,
                g->distance, g->radius);
    for (int i = 0; i < x->found.n; i++) { /* se: by noise; se_between: standard deviation from strike to strike */
        const struct modal_mode *m = &x->found.mode[i];
        double gain = 0.0;
        for (int k = 0; k < x->n; k++)
            gain = fmax(gain, x->gain[i * x->n + k].se);
        fprintf(
            f,
            "# error %d.%d: frequency_hz se %.3g se_between %.3g, decay_per_s se %.3g se_between %.3g, gain se %.3g\n",
            m->mode, m->slope, m->frequency_se, m->frequency_between, m->decay_se, m->decay_between, gain);
    }
    if (!g->force_channel && !g->impulse) fputs("# force: not recorded\n", f);
    if (x->found.undamped) fprintf(f, "# hum: %d\n", x->found.undamped);
    for (int k = 0; k < x->notes; k++)
        fprintf(f, "# note %d: %s\n", k + 1, x->note[k]);
}

/* All slopes of a mode have the frequency of its first. */
static double frequency(const struct modes_extract *x, const struct modal_mode *m)
{
    for (const struct modal_mode *first = x->found.mode; first < x->found.mode + x->found.n; first++)
        if (first->mode == m->mode && first->slope == 1) return first->frequency;
    return m->frequency;
}

static double unsigned_zero(double v) { return v == 0.0 ? 0.0 : v; }

void modes_extract_write_table(FILE *f, const struct modes_extract *x)
{
    bool slopes = x->found.n > x->found.modes;
    comments(f, x);
    fprintf(f, "place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad%s\n", slopes ? ",slope" : "");
    for (int k = 0; k < x->n; k++)
        for (int i = 0; i < x->found.n; i++) {
            const struct modal_mode *m = &x->found.mode[i];
            const struct modal_gain *a = &x->gain[i * x->n + k];
            double along = x->quantity == MODES_VELOCITY       ? a->a.im
                           : x->quantity == MODES_ACCELERATION ? -a->a.re
                                                               : a->a.re,
                   sign = along < 0.0 ? -1.0 : 1.0, gain = sign * cplx_abs(a->a),
                   phase = gain != 0.0 ? real_atan2(sign * a->a.im, sign * a->a.re) : 0.0;
            fprintf(f, "%d,%.9g,%.9g,%d,%.9g,%.9g,%.9g,%.9g", k + 1, unsigned_zero(x->place[k].x),
                    unsigned_zero(x->place[k].y), m->mode, frequency(x, m), m->decay, unsigned_zero(gain),
                    unsigned_zero(phase));
            fprintf(f, slopes ? ",%d\n" : "\n", m->slope);
        }
}

/* ------------------------------------------------------------------ envelopes

   A_i(t) of papers/000, section 2.4, by heterodyne: y turned back at the mode's frequency, in the mean over a Hann
   window about t. Of a sine of amplitude A at that frequency the mean is A/2 e^(j phase). A window of T seconds has its
   first zero 2/T from its middle; T is 4 over the distance to the next mode, 10 to 200 ms, so that modes less than 20
   Hz apart beat in both columns. The exponential's fall inside the window is in both, too. */

#define WINDOW_LEAST 0.01 /* s */
#define WINDOW_MOST 0.2

static double window_of(const struct modes_extract *x, int of)
{
    double frequency = x->found.mode[of].frequency, gap = 2.0 * frequency;
    for (int i = 0; i < x->found.n; i++)
        if (x->found.mode[i].mode != x->found.mode[of].mode)
            gap = fmin(gap, fabs(x->found.mode[i].frequency - frequency));
    return fmin(fmax(4.0 / gap, WINDOW_LEAST), WINDOW_MOST);
}

/* 2 times the mean of y[0 .. n - 1] e^(-j w i) w(i); per: cycles a sample. */
static cplx turned_back(const double *y, long n, double per)
{
    cplx sum = {0, 0}, turn = {1, 0}, step = {real_cospi(2.0 * per), -real_sinpi(2.0 * per)};
    cplx shape = {1, 0}, swing = {real_cospi(2.0 / (double)n), real_sinpi(2.0 / (double)n)};
    double weight = 0.0;
    for (long i = 0; i < n; i++) {
        double w = 1.0 - shape.re;
        sum = cplx_add(sum, cplx_scale(w * y[i], turn));
        weight += w;
        turn = cplx_mul(turn, step);
        shape = cplx_mul(shape, swing);
    }
    return cplx_scale(2.0 / weight, sum);
}

static void write_envelope(FILE *f, const struct modes_extract *x, int s, int i)
{
    const struct modal_stretch *d = &x->data.stretch[s];
    const struct modal_mode *m = &x->found.mode[i];
    double rate = x->data.rate, window = window_of(x, i), per = m->frequency / rate;
    long n = (long)(window * rate), hop = n / 4 > 0 ? n / 4 : 1;
    for (long at = d->ringing; at + n <= d->n; at += hop) {
        cplx heard = turned_back(d->y + at, n, per), made = turned_back(x->found.model[s] + at, n, per);
        double cycles = (double)(d->first + at) * per; /* phases are those of a sine that begins with the recording */
        double phase = real_atan2(heard.im, heard.re) / REAL_PI + 0.5 - 2.0 * (cycles - floor(cycles));
        fprintf(f, "%d,%d,%d,%.9g,%.9g,%.9g,%.9g,%.9g\n", d->place + 1, d->strike + 1, m->mode,
                ((double)(d->first + at) + 0.5 * (double)n) / rate, m->frequency, cplx_abs(heard),
                unsigned_zero(REAL_PI * (phase - 2.0 * rint(0.5 * phase))), cplx_abs(made));
    }
}

void modes_extract_write_envelopes(FILE *f, const struct modes_extract *x)
{
    fputs("place,strike,mode,time_s,frequency_hz,amplitude,phase_rad,amplitude_of_modes\n", f);
    for (int s = 0; s < x->data.stretches; s++)
        for (int i = 0; x->data.stretch[s].fitted && i < x->found.n; i++)
            if (x->found.mode[i].slope == 1) write_envelope(f, x, s, i);
}

/* ------------------------------------------------------------------ report */

static void report_strikes(struct report *r, const struct modes_extract *x, const struct modes_extract_place *p)
{
    bool force = x->given.force_channel, text = !x->given.impulse;
    if (text)
        report_text(r, "strikes: %d found, %d used\n%6s %10s %12s %12s %10s\n", p->strikes.n, p->strikes.used, "strike",
                    "onset_s", force ? "peak_force" : "peak_sound", force ? "momentum" : "", "explained");
    report_list(r, "strikes");
    for (int k = 0; k < p->strikes.n; k++) {
        const struct strikes_one *v = &p->strikes.strike[k];
        double onset = (double)v->onset / x->rate, explained = NAN;
        for (int s = p->first; s < p->first + p->stretches; s++)
            if (x->data.stretch[s].strike == k) explained = x->found.explained[s];
        report_object(r, NULL);
        report_set(r, "onset_s:n peak:n momentum:n clipped:b doubled:b used:b left_out:s explained:n", onset, v->peak,
                   v->momentum, v->clipped, v->doubled, !v->left_out, v->left_out, explained);
        report_end(r);
        if (text)
            report_text(r, "%6d %10.4f %12.4g %12s %10s %s%s\n", k + 1, onset, v->peak,
                        force ? arena_format(x->arena, "%.4g", v->momentum) : "",
                        isnan(explained) ? "-" : arena_format(x->arena, "%.1f%%", 100.0 * explained),
                        v->left_out  ? "left out: "
                        : v->doubled ? "doubled"
                                     : "",
                        v->left_out ? v->left_out : "");
    }
    report_end(r);
    if (force) report_text(r, "force: up to %.5g Hz, sound %.3g ms after it\n", p->high, 1e3 * p->delay);
}

static void report_place(struct report *r, const struct modes_extract *x, int k)
{
    const struct modes_extract_place *p = &x->place[k];
    const struct spectral_distance *d = &p->distance;
    double noise = x->found.noise[k];
    report_object(r, NULL);
    report_set(r, "file:s sha256:s x_m:n y_m:n", p->shown, p->hash, p->x, p->y);
    report_text(r, "%s", p->shown);
    if (p->placed) report_text(r, " at x = %.6g m, y = %.6g m", p->x, p->y);
    report_text(r, ": %g Hz, %.4g s\n", x->rate, (double)p->recording.n / x->rate);
    report_strikes(r, x, p);
    report_set(r, "low_hz:n high_hz:n delay_s:n explained:n predicted:n noise_rms:n", 0.0, p->high, p->delay,
               p->explained, p->predicted, noise);
    report_text(r, "modes explain %.2f %% of the energy that does not follow the force at once; noise %.3g rms\n",
                100.0 * p->explained, noise);
    if (!isnan(p->predicted)) report_text(r, "and %.2f %% of the strikes that were not fitted\n", 100.0 * p->predicted);
    report_object(r, "distance");
    report_set(r, "third_octave_mean_db:n third_octave_worst_db:n third_octave_worst_hz:n log_spectral_db:n",
               d->third_octave_mean, d->third_octave_worst, d->worst_at, d->log_spectral);
    report_end(r);
    report_text(r,
                "strike to modes: third octaves %.2f dB (mean of %d), %.2f dB (worst, %g Hz); log-spectral distance "
                "%.2f dB\n",
                d->third_octave_mean, d->bands, d->third_octave_worst, d->worst_at, d->log_spectral);
    report_end(r);
}

static void report_mode(struct report *r, const struct modes_extract *x, int i)
{
    const struct modal_mode *m = &x->found.mode[i];
    const struct modal_gain *gain = &x->gain[i * x->n], *most = gain;
    report_object(r, NULL);
    report_set(r,
               "mode:i slope:i frequency_hz:n frequency_se:n frequency_se_between:n decay_per_s:n decay_se:n "
               "decay_se_between:n t60_s:n share:n",
               m->mode, m->slope, m->frequency, m->frequency_se, m->frequency_between, m->decay, m->decay_se,
               m->decay_between, t60(m), m->share);
    report_list(r, "places");
    for (const struct modal_gain *g = gain; g < gain + x->n; g++) {
        report_object(r, NULL);
        report_set(r, "gain:n gain_se:n phase_rad:n phase_se_rad:n", cplx_abs(g->a), g->se,
                   real_atan2(g->a.im, g->a.re), g->se / cplx_abs(g->a));
        report_end(r);
        most = cplx_abs(g->a) > cplx_abs(most->a) ? g : most;
    }
    report_end(r);
    report_end(r);
    report_text(r, "%5d %13.7g %9.2g %10.2g %11.4g %9.2g %10.2g %12.5g %9.2g", m->mode, m->frequency, m->frequency_se,
                m->frequency_between, t60(m), t60(m) * m->decay_se / m->decay, t60(m) * m->decay_between / m->decay,
                cplx_abs(most->a), most->se);
    report_text(r, x->found.n > x->found.modes ? "%7d\n" : "\n", m->slope);
}

bool modes_extract_write_report(const struct modes_extract *x, bool json, struct err *e)
{
    struct report r = report_open(stdout, json);
    report_set(&r,
               "table:s sample_rate:n method:s quantity:s physical:b low_hz:n high_hz:n median_decay_per_s:n "
               "median_decay_by_energy_per_s:n",
               x->given.file[MODES_EXTRACT_TABLE], x->rate, x->given.spectrogram ? "spectrogram" : "esprit",
               modes_quantity_name(x->quantity), !x->why_not, x->low, x->high, x->median_decay, x->median_by_energy);
    report_list(&r, "places");
    for (int k = 0; k < x->n; k++)
        report_place(&r, x, k);
    report_end(&r);
    report_text(&r, "%d mode%s between %.5g and %.5g Hz, median decay %.4g 1/s, by energy %.4g 1/s\n", x->found.modes,
                x->found.modes == 1 ? "" : "s", x->low, x->high, x->median_decay, x->median_by_energy);
    report_text(&r, "%5s %13s %9s %10s %11s %9s %10s %12s %9s%s\n", "mode", "frequency_hz", "se", "se_between", "t60_s",
                "se", "se_between", "largest_gain", "se", x->found.n > x->found.modes ? "  slope" : "");
    report_list(&r, "modes");
    for (int i = 0; i < x->found.n; i++)
        report_mode(&r, x, i);
    report_end(&r);
    if (x->why_not)
        report_text(&r, "gains relative, of %s\n", modes_quantity_name(x->quantity));
    else
        report_text(&r, "gains in (%s)/(N s)\n", modes_quantity_unit(x->quantity));
    report_set(&r, "warnings:t", x->note, x->notes);
    if (x->notes) report_text(&r, "warning%s:\n", x->notes == 1 ? "" : "s");
    for (int k = 0; k < x->notes; k++)
        report_text(&r, "  %s\n", x->note[k]);
    return report_close(&r, 12, e);
}

/* ------------------------------------------------------------------ picture */

#define RED "'#d55e00'"
#define POINTS " pointtype 7 pointsize 0.5 linecolor rgb " RED
#define CURVES /* columns 2 to 4 of the data */                                                                        \
    " using 1:2 with lines linewidth 1.2 linecolor rgb '#888888' title 'strike'"                                       \
    ", '' using 1:4 with lines linewidth 1 linecolor rgb '#f0b48a' title 'what is left'"                               \
    ", '' using 1:3 with lines linewidth 1.2 linecolor rgb '#0072b2' title 'its modes'"

static double decibel(double power) { return power > 0.0 ? 10.0 * real_log10(power) : -400.0; }

/* A row of data: the strike, its modes, what is left. */
static void levels(struct gnuplot *g, double at, const double power[3])
{
    fprintf(g->in, "%.6g %.5g %.5g %.5g\n", at, decibel(power[0]), decibel(power[1]), decibel(power[2]));
}

/* $s: spectra of y[n], in a column of the picture the greatest of its bins: lines stay as high as they are. */
static void spectra(struct gnuplot *g, const double *const y[3], long n, double rate, double low, double high)
{
    struct arena *a = arena_open();
    const int columns = 900;
    long padded = (long)fft_good_size((size_t)(2 * n));
    double *power[3];
    for (int k = 0; k < 3; k++)
        power[k] = modes_extract_find_power(y[k], n, padded, a);
    fputs("$s << END\n", g->in);
    for (int c = 0; c < columns; c++) {
        double from = low * real_pow(high / low, (double)c / columns),
               to = low * real_pow(high / low, (c + 1.0) / columns), most[3] = {0};
        long first = (long)(from / rate * (double)padded), last = (long)(to / rate * (double)padded);
        for (long i = first; i <= last && i <= padded / 2; i++)
            for (int k = 0; k < 3; k++)
                most[k] = fmax(most[k], power[k][i] / (rate * rate));
        levels(g, sqrt(from * to), most);
    }
    fputs("END\n", g->in);
    arena_close(a);
}

/* $m: each mode's frequency, the height that it has there, |A|/(2 decay), and T60, both with two standard errors. */
static void stems(struct gnuplot *g, const struct modes_extract *x)
{
    fputs("$m << END\n", g->in);
    for (int i = 0; i < x->found.n; i++) {
        const struct modal_mode *m = &x->found.mode[i];
        const struct modal_gain *a = &x->sound[i * x->n];
        double gain = cplx_abs(a->a), height = decibel(gain * gain / (4.0 * m->decay * m->decay)),
               off_gain = a->se / gain, off_decay = m->decay_se / m->decay,
               off = 2.0 * sqrt(off_gain * off_gain + off_decay * off_decay);
        fprintf(g->in, "%.7g %.5g %.5g %.5g %.5g %.5g %.5g\n", m->frequency, height,
                height + 20.0 * real_log10(fmax(1.0 - off, 1e-3)), height + 20.0 * real_log10(1.0 + off), t60(m),
                t60(m) / (1.0 + 2.0 * off_decay), t60(m) / fmax(1.0 - 2.0 * off_decay, 0.01));
    }
    fputs("END\n", g->in);
}

/* $l: mean squares of y[n] over time. */
static void decays(struct gnuplot *g, const double *const y[3], long n, double rate)
{
    long step = n / 700 > 16 ? n / 700 : 16;
    fputs("$l << END\n", g->in);
    for (long i = 0; i + step <= n; i += step) {
        double power[3] = {0};
        for (int k = 0; k < 3; k++) {
            for (long j = i; j < i + step; j++)
                power[k] += y[k][j] * y[k][j];
            power[k] /= (double)step;
        }
        levels(g, ((double)i + 0.5 * (double)step) / rate, power);
    }
    fputs("END\n", g->in);
}

/* Of the first place's loudest strike, above: the spectrum of its sound, from the hammer's end on, with its modes' and
   of what is left, and each mode as a stem; below: levels over time, and decays over frequency. */
void modes_extract_write_picture(void *self, struct gnuplot *g)
{
    struct modes_extract *x = self;
    const struct modes_extract_place *p = &x->place[0];
    const struct modal_stretch *st = &x->data.stretch[p->loudest];
    long n = st->n - st->ringing;
    double low = fmax(20.0, 0.7 * x->low), high = fmin(1.4 * x->high, 0.5 * x->rate);
    double *rest = ARENA_TAKE(x->arena, double, n);
    const double *y[3] = {st->y + st->ringing, x->found.model[p->loudest] + st->ringing, rest};
    for (long i = 0; i < n; i++)
        rest[i] = y[0][i] - y[1][i];
    gnuplot_page(g, x->given.svg, 1100, 900);
    fputs("set key noenhanced outside top horizontal center samplen 2\n", g->in);
    gnuplot_put_setting(
        g, "multiplot title",
        arena_format(x->arena, "%s: %d modes explain %.1f %%", p->name, x->found.modes, 100.0 * p->explained));
    spectra(g, y, n, x->rate, low, high);
    stems(g, x);
    decays(g, y, n, x->rate);
    fprintf(g->in,
            "set size 1,0.56\nset origin 0,0.4\nset logscale x\nset xrange [%.6g:%.6g]\n"
            "set xlabel 'frequency / Hz'\nset ylabel 'level / dB'\n"
            "stats $s using 2 nooutput\nset yrange [STATS_max - 90:STATS_max + 6]\nplot $s" CURVES
            ", $m using 1:2:(0):(-200) with vectors nohead linewidth 0.6 linecolor rgb " RED " notitle"
            ", '' using 1:2:3:4 with yerrorbars" POINTS " title 'modes, ± 2 standard errors'\n"
            "unset logscale x\nset size 0.5,0.4\nset origin 0,0\nset xrange [0:%.6g]\nset xlabel 'time / s'\n"
            "set yrange [*:*]\nstats $l using 2 nooutput\nset yrange [STATS_max - 80:STATS_max + 6]\nplot $l" CURVES
            "\nset origin 0.5,0\nset logscale xy\nset xrange [%.6g:%.6g]\nset yrange [*:*]\n"
            "set xlabel 'frequency / Hz'\nset ylabel 'T60 / s'\n"
            "plot $m using 1:5:6:7 with yerrorbars" POINTS " notitle\nunset multiplot\n",
            low, high, (double)n / x->rate, low, high);
}
