/* Single impacts of rasp's coupled rolling (convolution/coupled.h) beside closed forms (rolling_closed.h), as rows of evidence/rolling.md's tables. No weight,
   20 g (the ratio kappa = k/m alone matters), 32 phases of arrival within a step; error: (speed out - exact)/(speed in).

     grid     six cases at 1, 4, 16, 64 steps per sample of 44.1 kHz: greatest and least error of each integrator, or why it refuses
     order    discrete_gradient: error, its spread over phases, order
     peer     the grid of a public program (k, f = k xi^1.5 (1 + 0.3 xi'), 10 g, 1 m/s), restitution at 44.1, 96, 192 kHz and with contact_steps 40
     paper    papers/002, section III-B: kappa 5e7..5e11, mu 0.1..10, one step per sample, rigid and on 50 modes, 1 cm/s to 1 m/s
     times    duration against equation 10, by discrete_gradient with 400 and 1600 steps in the contact */
#include <float.h>
#include <stdbool.h>
#include <string.h>

#include "convolution/coupled.h"
#include "rolling_closed.h"
#include "scene/scene.h"

enum { PHASES = 32, MODES = 50, STEPS_MOST = 1 << 22 };
#define MASS 0.02

static const char *const names[] = {[INTEGRATOR_DISCRETE_GRADIENT] = "discrete_gradient", [INTEGRATOR_RK4] = "rk4", [INTEGRATOR_EXACT_IMPACT] = "exact_impact"};
static double frequency[MODES], decay[MODES], phi[MODES];

struct shot {
    int integrator;
    double kappa, mu, v, step, phase;
    bool elastic;
};

struct hit {
    enum { HIT, REFUSED, STUCK } how;
    double out, time, energy; /* m/s; s; energy after over before */
    char why[1024];
};

static void die(const char *what)
{
    fprintf(stderr, "rolling_impacts: %s\n", what);
    exit(1);
}

static void modes_make(void)
{
    for (int i = 0; i < MODES; i++) {
        frequency[i] = 100 * pow(150, i / 49.0);
        decay[i] = log(1000) / (0.9 * pow(frequency[i] / 100, -0.3));
        phi[i] = 1.4 * sin(0.7 * (i + 1)); /* 1/sqrt(kg): a mass of 1 kg */
    }
}

static bool fly(struct coupled *c, struct hit *h)
{
    const struct coupled_state *s = coupled_state(c);
    struct err e = {.kind = ERR_NONE};
    double force, zero = 0;
    while (s->lift_offs == 0 && s->steps < STEPS_MOST)
        if (!coupled_run(c, 1, &zero, NULL, &force, &e)) {
            h->how = e.kind == ERR_SCENE ? REFUSED : STUCK;
            snprintf(h->why, sizeof h->why, "%s", e.text);
            return false;
        }
    h->how = s->lift_offs > 0 ? HIT : STUCK;
    return s->lift_offs > 0;
}

/* Lands 2 + phase steps after the start. */
static struct hit fire(const struct shot *o)
{
    struct err e = {.kind = ERR_NONE};
    struct arena *a = arena_open();
    struct coupled *c;
    struct hit h = {.how = HIT};
    struct coupled_ask ask = {o->integrator, o->step, MASS, 0, o->kappa * MASS, o->mu, o->elastic ? MODES : 0, frequency, decay};
    if (!coupled_make(a, &ask, &c, &e))
        die(e.text);
    coupled_start(c, o->v * o->step * (2 + o->phase), -o->v, 0, o->elastic ? phi : NULL, false);
    fly(c, &h);
    const struct coupled_state *s = coupled_state(c);
    h.out = s->speed;
    h.time = s->contact_sum;
    h.energy = s->energy / (0.5 * MASS * o->v * o->v);
    arena_close(a);
    return h;
}

struct spread {
    double most, least;
    struct hit bad; /* the first that was no hit */
};

static struct spread volley(struct shot o)
{
    double exact = closed_out(o.mu, o.v);
    struct spread s = {-HUGE_VAL, HUGE_VAL, {.how = HIT}};
    for (int k = 0; k < PHASES && s.bad.how == HIT; k++) {
        o.phase = (double)k / PHASES;
        struct hit h = fire(&o);
        double error = (h.out - exact) / o.v;
        s.most = fmax(s.most, error);
        s.least = fmin(s.least, error);
        if (h.how != HIT)
            s.bad = h;
    }
    return s;
}

/* ------------------------------------------------------------------ the tables */

static const struct { double kappa, mu, v; } cases[] = {{5e9, 1, 0.05}, {5e11, 0, 0.05}, {5e11, 1, 0.05}, {5e11, 1, 1}, {5e11, 10, 1}, {1e12, 10, 1}};
enum { CASES = sizeof cases / sizeof cases[0] };

static const char *refusal(const char *why)
{
    return strstr(why, "to be trusted") ? "refused: mu too stiff" : strstr(why, "needs 12") ? "refused: under 12 steps" : why;
}

static void grid(void)
{
    const int integrators[] = {INTEGRATOR_DISCRETE_GRADIENT, INTEGRATOR_EXACT_IMPACT, INTEGRATOR_RK4};
    for (int k = 0; k < CASES; k++)
        for (int i = 0; i < 3; i++) {
            printf("| %g, %g, %g m/s (%.1f) | %s |", cases[k].kappa, cases[k].mu, cases[k].v, closed_time(cases[k].kappa, cases[k].mu, cases[k].v) * 44100, names[integrators[i]]);
            for (int over = 1; over <= 64; over *= 4) {
                struct spread s = volley((struct shot){integrators[i], cases[k].kappa, cases[k].mu, cases[k].v, 1 / (44100.0 * over), 0, false});
                if (s.bad.how == HIT)
                    printf(" %+.1e %+.1e |", s.least, s.most);
                else
                    printf(" %s |", s.bad.how == REFUSED ? refusal(s.bad.why) : "no end");
            }
            puts("");
        }
}

static void order(void)
{
    for (int k = 0; k < CASES; k++) {
        double before = 0, spread = 0;
        if (cases[k].mu <= 0)
            continue;
        printf("| %g, %g, %g m/s |", cases[k].kappa, cases[k].mu, cases[k].v);
        double time = closed_time(cases[k].kappa, cases[k].mu, cases[k].v);
        for (int steps = 40; steps <= 2560; steps *= 4) {
            struct spread s = volley((struct shot){INTEGRATOR_DISCRETE_GRADIENT, cases[k].kappa, cases[k].mu, cases[k].v, time / steps, 0, false});
            printf(" %+.2e%s", s.most, before > 0 ? "" : " |");
            if (before > 0)
                printf(" (%.3f) |", log(before / s.most) / log(4));
            before = s.most;
            spread = fmax(spread, s.most - s.least);
        }
        printf(" %.1e |\n", spread);
    }
}

static void peer(void)
{
    const double stiffness[] = {1e6, 1e8, 1e9, 1e10, 1e12}, rates[] = {44100, 96000, 192000};
    const char *const theirs[] = {".8329 .8329 .8329", ".8329 .8330 .8329", ".8358 .8336 .8330", ".9998 .8459 .8350", ".9999 1.0000 .9997"};
    const double mass = 0.01, mu = 0.3;
    for (int k = 0; k < 5; k++) {
        double kappa = stiffness[k] / mass, time = closed_time(kappa, mu, 1);
        printf("| %.0e | %.1f | %.4f | %s |", stiffness[k], time * 1e6, closed_out(mu, 1), theirs[k]);
        for (int i = 0; i < 2; i++) {
            for (int r = 0; r < 3; r++)
                printf(" %.4f", fire(&(struct shot){i ? INTEGRATOR_EXACT_IMPACT : INTEGRATOR_DISCRETE_GRADIENT, kappa, mu, 1, 1 / rates[r], 0.3, false}).out);
            printf(" |");
        }
        printf(" %.5f |\n", fire(&(struct shot){INTEGRATOR_DISCRETE_GRADIENT, kappa, mu, 1, time / 40, 0.3, false}).out);
    }
}

/* One cell: the worst over speeds; the energy of ball and modes must not rise, and the ball not be thrown back faster than it came. */
static void paper_cell(int integrator, bool elastic, double kappa, double mu)
{
    const double speeds[] = {0.01, 0.05, 0.2, 1};
    double worst = 0, energy = 0;
    char text[4][80];
    for (int k = 0; k < 4; k++) {
        struct shot o = {integrator, kappa, mu, speeds[k], 1 / 44100.0, 0, elastic};
        strcpy(text[k], "ok");
        for (int p = 0; p < PHASES; p++) {
            o.phase = (double)p / PHASES;
            struct hit h = fire(&o);
            if (h.how != HIT) {
                snprintf(text[k], sizeof text[k], "%s", h.how == REFUSED ? "refused" : "NO END");
                break;
            }
            worst = fmax(worst, fabs(h.out - closed_out(mu, o.v)) / o.v);
            energy = fmax(energy, h.energy);
        }
    }
    if (!strcmp(text[0], text[3]) && !strcmp(text[0], text[1]) && !strcmp(text[0], text[2]))
        printf(" %s", text[0]);
    else
        printf(" %s/%s/%s/%s", text[0], text[1], text[2], text[3]);
    if (energy > 0)
        printf(elastic ? ", %.3f" : ", %.0e", elastic ? energy : worst);
    printf(" |");
}

static void paper(void)
{
    const double kappas[] = {5e7, 5e9, 5e11}, mus[] = {0.1, 1, 10};
    for (int k = 0; k < 9; k++) {
        printf("| %g, %g |", kappas[k / 3], mus[k % 3]);
        paper_cell(INTEGRATOR_DISCRETE_GRADIENT, false, kappas[k / 3], mus[k % 3]);
        paper_cell(INTEGRATOR_EXACT_IMPACT, false, kappas[k / 3], mus[k % 3]);
        paper_cell(INTEGRATOR_RK4, false, kappas[k / 3], mus[k % 3]);
        paper_cell(INTEGRATOR_DISCRETE_GRADIENT, true, kappas[k / 3], mus[k % 3]);
        paper_cell(INTEGRATOR_RK4, true, kappas[k / 3], mus[k % 3]);
        puts("");
    }
}

static void times(void)
{
    const double mus[] = {0, 0.1, 0.5, 1, 2, 10}, speeds[] = {0.001, 0.01, 0.05, 1};
    for (int m = 0; m < 6; m++) {
        double first = 0, last = 0;
        printf("| %g |", mus[m]);
        for (int k = 0; k < 4; k++) {
            double exact = closed_time(5e9, mus[m], speeds[k]), off[2];
            for (int i = 0; i < 2; i++)
                off[i] = fire(&(struct shot){INTEGRATOR_DISCRETE_GRADIENT, 5e9, mus[m], speeds[k], exact / (i ? 1600 : 400), 0.3, false}).time / exact - 1;
            printf(" %.6f ms, %+.0e %+.0e |", exact * 1e3, off[0], off[1]);
            first = k == 0 ? exact : first;
            last = k == 2 ? exact : last;
        }
        printf(" %.4f |\n", -log(last / first) / log(50));
    }
}

int main(int argc, char **argv)
{
    const struct { const char *name; void (*run)(void); } tables[] = {{"grid", grid}, {"order", order}, {"peer", peer}, {"paper", paper}, {"times", times}};
    modes_make();
    for (int i = 0; argc == 2 && i < 5; i++)
        if (!strcmp(argv[1], tables[i].name)) {
            tables[i].run();
            return 0;
        }
    die("grid, order, peer, paper or times?");
}
