/* Judges how far one scene's sound depends on the sample rate. Shares no code with rasp (tests/unit/rates.h, which writes the scenes, has none either).

     scene SEED FOLDER           writes FOLDER/SEED.yaml without its end: ", sample_rate: R}" is missing; and what files it needs
     apart LOW.wav HIGH.wav      prints the largest difference, dB, of third octaves that end below 0.4 of LOW's rate and lie within 40 dB of the loudest, and the
                                 centre of that band, Hz. WAVs are mono, float64 */
#include <stdint.h>

#include "../tests/unit/rates.h"
#include "numbers.h"

static void fail(const char *what)
{
    fprintf(stderr, "rates_judge: %s\n", what);
    exit(1);
}

static double *wav(const char *path, long *n, double *rate)
{
    FILE *f = fopen(path, "rb");
    unsigned char head[12], chunk[8];
    double *x = NULL;
    if (!f || fread(head, 1, 12, f) != 12)
        fail(path);
    while (!x && fread(chunk, 1, 8, f) == 8) {
        uint32_t size, r;
        memcpy(&size, chunk + 4, 4);
        unsigned char *body = malloc(size + 1);
        if (!body || fread(body, 1, size, f) != size)
            fail(path);
        if (!memcmp(chunk, "fmt ", 4)) {
            memcpy(&r, body + 4, 4);
            *rate = r;
        }
        if (!memcmp(chunk, "data", 4)) {
            *n = size / 8;
            x = (double *)(void *)body;
        } else {
            free(body);
        }
    }
    fclose(f);
    return x ? x : (fail(path), NULL);
}

int main(int argc, char **argv)
{
    if (argc == 4 && !strcmp(argv[1], "scene")) {
        char text[4000], path[500];
        rates_scene((int)number_whole(argv[2]), argv[3], text, sizeof text);
        snprintf(path, sizeof path, "%s/%s.yaml", argv[3], argv[2]);
        FILE *f = fopen(path, "w");
        if (!f || fputs(text, f) < 0 || fclose(f))
            fail(path);
        return 0;
    }
    if (argc == 4 && !strcmp(argv[1], "apart")) {
        double level[2][RATES_BANDS], rate[2];
        int band;
        for (int k = 0; k < 2; k++) {
            long n;
            double *x = wav(argv[2 + k], &n, &rate[k]);
            rates_bands(x, n, rate[k], level[k]);
            free(x);
        }
        double most = rates_apart(level[0], level[1], rate[0], &band);
        printf("%.3f %.0f\n", most, rates_centre(band));
        return 0;
    }
    fail("scene SEED FOLDER, or apart LOW.wav HIGH.wav");
}
