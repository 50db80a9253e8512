/* Recordings of objects whose modes are known, for evidence/ringing.sh. Shares nothing with rasp: libc and libm only.

     extract_judge cases SET MODES        how many recordings of that set hold that many modes
     extract_judge make SET SEED K NAME   recording K: NAME.wav (floating point), NAME.truth (JSON: its modes, their
                                          bounds), NAME.options (of rasp modes extract, one a line)

   A mode is h(t) = gain e^(-decay t) sin(2 pi frequency t + phase) = Re B e^(st), B = gain e^(i(phase - pi/2)),
   s = -decay + 2 pi i frequency. Driven by v[n] (an impulse; or T force[n]: newton seconds) it makes y = Re B x with
   x[n] = p x[n-1] + v[n], p = e^(sT), and dx/ds = g with g[n] = p (g[n-1] + T x[n-1]). Noise is white and Gaussian.

   The bound is Cramer's and Rao's: with the derivatives of every sample by frequency, decay, gain and phase of all
   modes (of hum: by the frequency and both parts of each line) as the columns of J, no unbiased estimate has less
   variance than the diagonal of deviation^2 (J'J)^-1. Two slopes are two modes whose frequencies are free.

   A mode is called resolvable if the nearest other one is more than 6 bounds of its frequency away (of the same
   frequency: 6 of its decay), its gain is more than 6 of its bounds, and its decay more than 2. */
#include <complex.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define TAU 6.283185307179586
#define LN60 6.907755278982137  /* decay times T60 */
#define PULSE 3e-4              /* s: of a half sine of force */
#define NEWTONS 100.0           /* full scale of the force's channel */
#define LEVELS 1.5              /* decades: 30 dB */

enum { MODES_MOST = 96, HUMS = 4, CHUNK = 128 };

struct mode {
    double frequency, decay, gain, phase, apart;     /* apart: from the nearest, in bounds */
    double bound[4];                                 /* of frequency, decay, gain, phase */
};

struct hum {
    double frequency, cosine, sine;
};

struct series {
    double rate, decibel;
    long n, first;                                   /* samples; the first strike's */
    int count, hums;
    bool force, lead;                                /* a channel of force; a recording rather than a response */
    double hum_decibel, gap;                         /* of hum against the sound; s between strikes */
    struct mode m[MODES_MOST];
    struct hum hum[HUMS];
    float *drive;                                    /* of the force's channel, or the impulse */
    double *sound;
    double deviation;
};

/* ---------------------------------------------------------------- chance: splitmix64 */

static uint64_t state;

static uint64_t mixed(void)
{
    uint64_t z = state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

static void seeded(uint64_t seed, char set, int k)
{
    state = seed;
    state = mixed() ^ (uint64_t)set;
    state = mixed() ^ (uint64_t)k;
    mixed();
}

static double uniform(double from, double to)
{
    return from + (to - from) * ((double)(mixed() >> 11) + 0.5) / 9007199254740992.0;
}

static double uniform_log(double from, double to) { return from * pow(to / from, uniform(0, 1)); }

static double gaussian(void)
{
    double size = sqrt(-2 * log(uniform(0, 1)));
    return size * cos(TAU * uniform(0, 1));
}

/* ---------------------------------------------------------------- the sets */

/* Frequencies anywhere in the band: evenly spread in their logarithm, with no least distance. */
static void modes_anywhere(struct series *s, int count, double low, double high)
{
    s->count = count;
    for (int i = 0; i < count; i++) { /* one at a time: a compiler may draw a list's parts in any order */
        s->m[i].frequency = uniform_log(low, high);
        s->m[i].decay = LN60 / uniform_log(0.2, 1.3);
        s->m[i].gain = pow(10, -LEVELS * uniform(0, 1));
        s->m[i].phase = uniform(0, TAU);
    }
}

/* One in each of equal parts of the band's logarithm, that share of a part from its ends. */
static void modes_spread(struct series *s, int count, double low, double high, double end)
{
    modes_anywhere(s, count, low, high);
    for (int i = 0; i < count; i++)
        s->m[i].frequency = low * pow(high / low, (i + uniform(end, 1 - end)) / count);
}

static void fast(struct series *s, int from, double least, double most)
{
    for (int i = from; i < s->count; i++)
        s->m[i].decay = uniform_log(least, most);
}

static void pairs(struct series *s, double apart)
{
    modes_spread(s, 20, 100, 12000, 0.1);
    for (int i = 0; i < 5; i++) /* every fourth is drawn to the one below */
        s->m[4 * i + 1].frequency = s->m[4 * i].frequency + apart;
}

static void slopes(struct series *s)
{
    modes_spread(s, 8, 200, 10000, 0.1);
    for (int i = 0; i < 8; i++) {
        s->m[i].decay = uniform_log(40, 120);
        s->m[8 + i] = s->m[i];
        s->m[8 + i].decay /= 8;
        s->m[8 + i].gain *= pow(10, -18.0 / 20);
        s->m[8 + i].phase = uniform(0, TAU);
    }
    s->count = 16;
}

static void *memory(long count, size_t size)
{
    void *p = calloc((size_t)count, size);
    if (!p)
        exit(70);
    return p;
}

static void length(struct series *s, double seconds)
{
    s->n = lrint(seconds * s->rate);
    s->drive = memory(s->n, sizeof *s->drive);
    s->sound = memory(s->n, sizeof *s->sound);
}

/* A half sine that begins at that time, between samples as it comes. */
static void pulse(struct series *s, double at)
{
    double share = uniform(0.4, 0.9); /* of full scale */
    for (long k = (long)ceil(at * s->rate); (double)k < (at + PULSE) * s->rate; k++)
        s->drive[k] += (float)(share * sin(TAU / 2 * ((double)k / s->rate - at) / PULSE));
}

static void strike(struct series *s, double at, bool force)
{
    s->force = force;
    s->lead = true;
    s->first = lrint(at * s->rate);
    if (force)
        pulse(s, at);
    else
        s->drive[s->first] = 1;
}

static void lines(struct series *s, double decibel)
{
    const double times[HUMS] = {1, 2, 3, 5};
    double mains = 50 * (1 + 2e-4 * gaussian());
    s->hums = HUMS;
    s->hum_decibel = decibel;
    for (int i = 0; i < HUMS; i++) {
        double phase = uniform(0, TAU);
        s->hum[i] = (struct hum){times[i] * mains, cos(phase), sin(phase)};
    }
}

static int count_of(char set, int k)
{
    const int a[] = {5, 20, 50, 80}, others[] = {20, 15, 16, 20, 15, 30, 20};
    return set == 'A' || set == 'I' ? a[k % 4] : others[set - 'B'];
}

static double decibel_of(char set, int k)
{
    switch (set) {
    case 'A':
    case 'I': return 20 + 20 * ((k / 4 + k) % 4);
    case 'B': return 40 + 20 * ((k / 4 + k) % 3);
    case 'F': return 40 + 20 * ((k / 3 + k) % 3);
    case 'G': return 40 + 20 * ((k / 4 + k) % 2);
    case 'E':
    case 'H': return 40 + 20 * ((k / 3 + k) % 2);
    default: return 40 + 20 * (k % 3);
    }
}

/* Recording K takes its levels in turn, so that a few already hold a bit of everything. */
static void series_make(struct series *s, char set, int k)
{
    const double apart[] = {0.5, 1, 2, 5}, rates[] = {16e3, 24e3, 48e3, 96e3}, gaps[] = {0.6, 0.3, 0.12};
    int count = count_of(set, k);
    bool fastest = (k / 3 + k) % 2;
    *s = (struct series){.rate = set == 'F' ? 24e3 : set == 'G' ? rates[k % 4] : 44100, .gap = gaps[k % 3]};
    s->decibel = decibel_of(set, k);
    length(s, set == 'F' ? 0.25 + s->gap + 1.2 : set == 'E' || set == 'H' ? 2.5 : 1);
    switch (set) {
    case 'A': modes_spread(s, count, 100, 12000, 0); break;
    case 'I': modes_anywhere(s, count, 100, 12000); break;
    case 'B': pairs(s, apart[k % 4]); break;
    case 'C':
        modes_spread(s, count, 200, 12000, 0.1);
        fast(s, 0, fastest ? 200 : 50, fastest ? 2000 : 300);
        break;
    case 'D': slopes(s); break;
    case 'E':
        modes_anywhere(s, count, 100, 10000);
        strike(s, 1 + uniform(0, 0.01), false);
        break;
    case 'F':
        modes_anywhere(s, count, 150, 9600);
        strike(s, 0.25 + uniform(0, 0.01), true);
        pulse(s, 0.25 + s->gap + uniform(0, 0.01));
        break;
    case 'G': modes_anywhere(s, count, 100, fmin(12000, 0.4 * s->rate)); break;
    default:
        modes_anywhere(s, count, 100, 10000);
        fast(s, count / 2, 50, 1000);
        strike(s, 1 + uniform(0, 0.01), true);
    }
    if (set == 'E' || set == 'H')
        lines(s, -60 + 20 * (k % 3));
    if (!s->lead)
        s->drive[0] = 1;
}

/* ---------------------------------------------------------------- what is heard */

/* What drives the modes at a sample. */
static double driven(const struct series *s, long k)
{
    return s->force ? s->drive[k] * NEWTONS / s->rate : s->drive[k];
}

struct turn { /* of one mode: its state and its derivative by s */
    double complex p, x, g;
};

static struct turn turn_from(const struct mode *m, double rate)
{
    return (struct turn){cexp((-m->decay + I * TAU * m->frequency) / rate), 0, 0};
}

static void turn_step(struct turn *t, double v, double rate)
{
    t->g = t->p * (t->g + t->x / rate);
    t->x = t->p * t->x + v;
    if (cabs(t->g) + cabs(t->x) < 1e-150) /* no numbers below what a processor is quick with */
        t->g = t->x = 0;
}

static double complex gain_of(const struct mode *m) { return m->gain * cexp(I * (m->phase - TAU / 4)); }

static double rms(const struct series *s, const double *y)
{
    long n = lrint(0.1 * s->rate);
    double sum = 0;
    for (long k = 0; k < n; k++)
        sum += y[s->first + k] * y[s->first + k];
    return sqrt(sum / (double)n);
}

static double hum_at(const struct hum *h, double t)
{
    double angle = TAU * h->frequency * t;
    return h->cosine * cos(angle) + h->sine * sin(angle);
}

/* The modes' sound, its peak brought to a half of full scale by their gains; then hum and noise, against its rms. */
static void sound_make(struct series *s)
{
    double peak = 0, heard;
    for (int i = 0; i < s->count; i++) {
        struct turn t = turn_from(&s->m[i], s->rate);
        double complex b = gain_of(&s->m[i]);
        for (long k = 0; k < s->n; k++) {
            turn_step(&t, driven(s, k), s->rate);
            s->sound[k] += creal(b * t.x);
        }
    }
    for (long k = 0; k < s->n; k++)
        peak = fmax(peak, fabs(s->sound[k]));
    for (long k = 0; k < s->n; k++)
        s->sound[k] *= 0.5 / peak;
    for (int i = 0; i < s->count; i++)
        s->m[i].gain *= 0.5 / peak;
    heard = rms(s, s->sound);
    s->deviation = heard * pow(10, -s->decibel / 20);
    for (int i = 0; i < s->hums; i++) {
        double size = heard * pow(10, s->hum_decibel / 20) * sqrt(2.0 / s->hums);
        s->hum[i].cosine *= size;
        s->hum[i].sine *= size;
    }
    for (long k = 0; k < s->n; k++) {
        for (int i = 0; i < s->hums; i++)
            s->sound[k] += hum_at(&s->hum[i], (double)k / s->rate);
        s->sound[k] += s->deviation * gaussian();
    }
}

/* ---------------------------------------------------------------- the bound */

static void columns_mode(const struct series *s, const struct mode *m, struct turn *t, long from, int rows, double *out)
{
    double complex b = gain_of(m);
    for (int r = 0; r < rows; r++) {
        turn_step(t, driven(s, from + r), s->rate);
        double complex x = b * t->x, g = b * t->g;
        out[r] = -TAU * cimag(g);            /* by the frequency: Re(2 pi i g) */
        out[CHUNK + r] = -creal(g);          /* by the decay */
        out[2 * CHUNK + r] = creal(x) / m->gain;
        out[3 * CHUNK + r] = -cimag(x);      /* by the phase */
    }
}

static void columns_hum(const struct hum *h, double rate, long from, int rows, double *out)
{
    for (int r = 0; r < rows; r++) {
        double t = (double)(from + r) / rate, angle = TAU * h->frequency * t;
        out[r] = cos(angle);
        out[CHUNK + r] = sin(angle);
        out[2 * CHUNK + r] = TAU * t * (h->sine * cos(angle) - h->cosine * sin(angle));
    }
}

static double product(const double *a, const double *b)
{
    double sum[8] = {0};
    for (int r = 0; r < CHUNK; r += 8)
        for (int l = 0; l < 8; l++)
            sum[l] += a[r + l] * b[r + l];
    return sum[0] + sum[1] + sum[2] + sum[3] + sum[4] + sum[5] + sum[6] + sum[7];
}

/* J'J of all samples; row i, column k <= i at i w + k. */
static void fisher_make(const struct series *s, int w, double *fisher)
{
    struct turn turn[MODES_MOST];
    double *j = memory((long)CHUNK * w, sizeof *j);
    for (int i = 0; i < s->count; i++)
        turn[i] = turn_from(&s->m[i], s->rate);
    for (long from = 0; from < s->n; from += CHUNK) {
        int rows = (int)(s->n - from < CHUNK ? s->n - from : CHUNK);
        memset(j, 0, sizeof *j * CHUNK * (size_t)w);
        for (int i = 0; i < s->count; i++)
            columns_mode(s, &s->m[i], &turn[i], from, rows, j + 4L * CHUNK * i);
        for (int i = 0; i < s->hums; i++)
            columns_hum(&s->hum[i], s->rate, from, rows, j + CHUNK * (4L * s->count + 3 * i));
        for (int i = 0; i < w; i++)
            for (int k = 0; k <= i; k++)
                fisher[(long)i * w + k] += product(j + (long)CHUNK * i, j + (long)CHUNK * k);
    }
    free(j);
}

/* Cholesky's factor in place, of a matrix whose diagonal is 1; false where it is singular to these digits. */
static bool factor(double *a, int w)
{
    for (int i = 0; i < w; i++)
        for (int k = 0; k <= i; k++) {
            double sum = a[(long)i * w + k];
            for (int l = 0; l < k; l++)
                sum -= a[(long)i * w + l] * a[(long)k * w + l];
            if (i > k)
                a[(long)i * w + k] = sum / a[(long)k * w + k];
            else if (sum < 1e-14)
                return false;
            else
                a[(long)i * w + i] = sqrt(sum);
        }
    return true;
}

/* Entry (at, at) of the inverse: the squared length of L^-1 e. */
static double inverse_at(const double *l, int w, int at)
{
    double x[4 * MODES_MOST + 3 * HUMS] = {0}, sum = 0;
    for (int i = at; i < w; i++) {
        double rest = i == at;
        for (int k = at; k < i; k++)
            rest -= l[(long)i * w + k] * x[k];
        x[i] = rest / l[(long)i * w + i];
        sum += x[i] * x[i];
    }
    return sum;
}

static void apart_find(struct series *s)
{
    for (int i = 0; i < s->count; i++) {
        struct mode *m = &s->m[i];
        m->apart = HUGE_VAL;
        for (int k = 0; k < s->count; k++)
            if (k != i) {
                double hertz = fabs(s->m[k].frequency - m->frequency);
                double slope = fabs(s->m[k].decay - m->decay);
                m->apart = fmin(m->apart, hertz > 0 ? hertz / m->bound[0] : slope / m->bound[1]);
            }
    }
}

/* Where modes coincide to all digits nothing bounds them: 1e9 times what they would have alone. */
static void bounds_make(struct series *s)
{
    int w = 4 * s->count + 3 * s->hums;
    double *fisher = memory((long)w * w, sizeof *fisher), *scale = memory(w, sizeof *scale);
    fisher_make(s, w, fisher);
    for (int i = 0; i < w; i++)
        scale[i] = 1 / sqrt(fisher[(long)i * w + i]);
    for (int i = 0; i < w; i++)
        for (int k = 0; k <= i; k++)
            fisher[(long)i * w + k] *= scale[i] * scale[k];
    bool regular = factor(fisher, w);
    for (int i = 0; i < s->count; i++)
        for (int x = 0; x < 4; x++)
            s->m[i].bound[x] =
                s->deviation * scale[4 * i + x] * (regular ? sqrt(inverse_at(fisher, w, 4 * i + x)) : 1e9);
    apart_find(s);
    free(fisher);
    free(scale);
}

/* ---------------------------------------------------------------- files */

static FILE *opened(const char *name, const char *end)
{
    char path[4096];
    snprintf(path, sizeof path, "%s.%s", name, end);
    FILE *f = fopen(path, "wb");
    if (!f) {
        fprintf(stderr, "extract_judge: cannot write %s\n", path);
        exit(74);
    }
    return f;
}

static void put(FILE *f, uint32_t value, int bytes)
{
    for (int i = 0; i < bytes; i++)
        fputc((int)(value >> (8 * i) & 255), f);
}

static void put_float(FILE *f, double value)
{
    float x = (float)value;
    uint32_t bits;
    memcpy(&bits, &x, 4);
    put(f, bits, 4);
}

static void sound_write(const struct series *s, const char *name)
{
    FILE *f = opened(name, "wav");
    uint32_t channels = s->force ? 2 : 1, bytes = (uint32_t)s->n * channels * 4, rate = (uint32_t)s->rate;
    fputs("RIFF", f);
    put(f, 36 + bytes, 4);
    fputs("WAVEfmt ", f);
    put(f, 16, 4);
    put(f, 3, 2);
    put(f, channels, 2);
    put(f, rate, 4);
    put(f, rate * channels * 4, 4);
    put(f, channels * 4, 2);
    put(f, 32, 2);
    fputs("data", f);
    put(f, bytes, 4);
    for (long k = 0; k < s->n; k++) {
        put_float(f, s->sound[k]);
        if (s->force)
            put_float(f, s->drive[k]);
    }
    fclose(f);
}

static void options_write(const struct series *s, const char *name)
{
    FILE *f = opened(name, "options");
    fputs(s->force ? "--force-channel\n2\n--force-scale\n100\n" : s->lead ? "" : "--impulse\n", f);
    fputs(s->force || !s->lead ? "--scale\n1\n--quantity\nvelocity\n" : "--quantity\nvelocity\n", f);
    fclose(f);
}

static bool resolvable(const struct mode *m, double gain)
{
    return m->apart > 6 && m->gain > gain * m->bound[2] && m->decay > 2 * m->bound[1];
}

static void truth_write(const struct series *s, const char *name, char set, const char *seed, int k)
{
    FILE *f = opened(name, "truth");
    fprintf(f, "{\"set\": \"%c\", \"seed\": %s, \"case\": %d, ", set, seed, k);
    fprintf(f, "\"rate\": %g, \"snr_db\": %g, ", s->rate, s->decibel);
    fprintf(f, "\"level_known\": %s, \"modes\": [", s->lead && !s->force ? "false" : "true");
    for (int i = 0; i < s->count; i++) {
        const struct mode *m = &s->m[i];
        fprintf(f, "%s\n {\"f\": %.12g, \"d\": %.12g, \"gain\": %.12g, \"phase\": %.12g, ", i ? "," : "", m->frequency,
                m->decay, m->gain, m->phase);
        fprintf(f, "\"bound_f\": %.6g, \"bound_d\": %.6g, \"bound_gain\": %.6g, \"bound_phase\": %.6g, ", m->bound[0],
                m->bound[1], m->bound[2], m->bound[3]);
        fprintf(f, "\"apart\": %.4g, \"resolvable\": %s, \"plain\": %s}", m->apart,
                resolvable(m, 6) ? "true" : "false", resolvable(m, 8) ? "true" : "false");
    }
    fputs("],\n\"hum\": [", f);
    for (int i = 0; i < s->hums; i++)
        fprintf(f, "%s%.9g", i ? ", " : "", s->hum[i].frequency);
    fputs("]}\n", f);
    fclose(f);
}

static int cases(char set, long modes)
{
    int k = 0;
    for (long sum = 0; sum < modes; k++)
        sum += count_of(set, k);
    return k;
}

int main(int argc, char **argv)
{
    static struct series s;
    char set = argc > 2 ? argv[2][0] : 0;
    if (argc == 4 && !strcmp(argv[1], "cases"))
        printf("%d\n", cases(set, atol(argv[3])));
    else if (argc == 6 && !strcmp(argv[1], "make") && strchr("ABCDEFGHI", set)) {
        int k = (int)strtol(argv[4], NULL, 10);
        seeded(strtoull(argv[3], NULL, 10), set, k);
        series_make(&s, set, k);
        sound_make(&s);
        bounds_make(&s);
        sound_write(&s, argv[5]);
        options_write(&s, argv[5]);
        truth_write(&s, argv[5], set, argv[3], k);
    } else {
        fprintf(stderr, "extract_judge cases SET MODES | make SET SEED K NAME\n");
        return 64;
    }
    return 0;
}
