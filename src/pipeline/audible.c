/* The contact is replaced by a strike far shorter than a sample, and its sound by the scene's own stages: whatever
   rings (modes, recordings, an object, scraper and surface) and however it is heard needs no second formula here.

     |H(f)|^2 = sum over channels |FFT of the sound|^2 / (sum of the force's samples)^2      means over 1/512 of the
       band */
#include "pipeline/audible.h"

#include <math.h>
#include <string.h>

#include "convolution/ring_choice.h"
#include "num/fft.h"
#include "num/real.h"
#include "pipeline/run.h"
#include "pipeline/stages.h"
#include "scene/rules.h"

#define SHORT 1e-7   /* s, of the strike */
enum { FIRST = 64 }; /* frames before it: the decimator's reach and more */

static void strike(struct contact *c, const double place[2], double rate)
{
    double mass = 0.01;
    if (c->surface.response.choice && c->surface.response.choice->moves) c->surface.response.choice = NULL;
    c->start = 0;
    c->contact.model = CONTACT_STRIKE;
    c->contact.strike = (struct strike){.pulse = PULSE_HALF_SINE,
                                        .speed = 1,
                                        .stiffness = mass * REAL_PI * REAL_PI / (SHORT * SHORT),
                                        .first = FIRST / rate,
                                        .count = 1,
                                        .interval = NAN,
                                        .restitution = NAN};
    c->contact.gesture.given = false;
    c->scraper.mass = mass;
    c->motion = (struct motion){
        .path = PATH_STILL, .at = {place[0], place[1]}, .duration = AUDIBLE_FRAMES / rate, .speed = NAN};
}

/* One channel's spectrum onto the bands. */
static void power_add(struct fft *f, const double *x, double *work[2], double *power)
{
    enum { WIDE = AUDIBLE_FRAMES / 2 / (AUDIBLE_BINS - 1) };
    fft_forward(f, x, work[0], work[1]);
    for (int k = 0; k <= AUDIBLE_FRAMES / 2; k++)
        power[(k + WIDE / 2) / WIDE] += work[0][k] * work[0][k] + work[1][k] * work[1][k];
}

/* Sum of the force; sound[channels][AUDIBLE_FRAMES] */
static bool record(struct run *r, double *sound, double *pushed, struct err *e)
{
    int channels = r->board.channels;
    for (long from = 0; from < AUDIBLE_FRAMES; from += STAGE_BLOCK) {
        if (!run_block(r, from + STAGE_BLOCK, e)) return false;
        const double *x = board_at(&r->board, ITEM_SOUND, from), *f = board_at(&r->board, ITEM_FORCE, from);
        for (long i = 0; i < STAGE_BLOCK; i++) {
            *pushed += f[i];
            for (int k = 0; k < channels; k++)
                sound[k * (long)AUDIBLE_FRAMES + from + i] = x[i * channels + k];
        }
    }
    return true;
}

static bool measure(struct run *r, struct arena *a, double *power, struct err *e)
{
    int channels = r->board.channels;
    double *sound = ARENA_TAKE(a, double, (size_t)channels *AUDIBLE_FRAMES), pushed = 0;
    double *work[2] = {ARENA_TAKE(a, double, AUDIBLE_FRAMES / 2 + 1), ARENA_TAKE(a, double, AUDIBLE_FRAMES / 2 + 1)};
    if (!record(r, sound, &pushed, e)) return false;
    struct fft *f = fft_open(AUDIBLE_FRAMES);
    memset(power, 0, AUDIBLE_BINS * sizeof *power);
    for (int k = 0; k < channels; k++)
        power_add(f, sound + k * (long)AUDIBLE_FRAMES, work, power);
    fft_close(f);
    for (int k = 0; k < AUDIBLE_BINS; k++)
        power[k] /= pushed * pushed * (k == 0 || k == AUDIBLE_BINS - 1 ? 8.5 : 16);
    return true;
}

bool audible_power(const struct scene *s, const struct contact *c, const double place[2], double *power, struct err *e)
{
    struct scene own = *s;
    struct contact struck = *c;
    struct plan p;
    struct run r;
    for (int k = 0; k < AUDIBLE_BINS; k++)
        power[k] = 1;
    if (s->output.quantity == QUANTITY_FORCE || !rules_rings(c) || c->gain == 0) return true;
    strike(&struck, place, s->output.sample_rate);
    own.contacts = &struck;
    own.n_contacts = 1;
    own.output.stems = NULL;
    own.output.diagnostics.given = false;
    own.output.impacts = LISTING_NONE;
    struct arena *a = arena_open();
    bool ok = plan_make(stages_table, &struck, &own, a, &p, e) && run_open(&r, &p, &own, NULL, e);
    if (ok) {
        ok = measure(&r, a, power, e);
        run_close(&r);
    }
    arena_close(a);
    return ok;
}
