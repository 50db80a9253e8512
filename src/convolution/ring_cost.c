/* Predictions of cost. A sound of T seconds is made by F seconds of force; what rings on, and what is told by nodes, costs only while there is some, and
   the search for hops (ring_survey.h: looked) is made once, so that all is summed up over the sound and divided by its samples.

   Constants are cycles of one core with 256-bit vectors, measured by tests/bench and on whole renders; they hold within a factor of 3 from one machine to
   the next, and for sounds of 0.5 s to 60 s. */
#include "convolution/ring_cost.h"

#include <math.h>

#include "convolution/gammatone.h"
#include "num/lanes.h"
#include "response/listener.h"

#define RESONATOR 0.8          /* a mode and sample, poles fixed                   */
#define GLIDING 1.2            /* ... poles ramped                                 */
#define RAMPED 6.0             /* a mode and ramp                                  */
#define HEARD 20.0             /* a mode where the contact is, with its pole       */
#define DRIVEN 0.8             /* a mode, sample and node under force              */
#define FREED 250.0            /* a node that leaves the force                     */
#define LAUNCHED 0.22          /* a node that rings and sample                     */
#define CLUSTER 2.5            /* ... nodes of one pole, or of near ones           */
#define RECALLED 0.7           /* a node of readout and sample of its past         */
#define READING 9.0            /* ... and sample under its window                  */
#define TRANSFORM 90.0         /* three FFTs, per sample of them                   */
#define SAMPLED 0.7            /* a mode and sample of an impulse response         */
#define PARTITION (1 / 200.0)  /* a sample of a response that is convolved as it is */
#define PANNED (1 / 220.0)     /* ... in the larger blocks of several              */
#define PARTITIONED 40.0       /* the FFT of such a sample                         */
#define NEEDED 6e5             /* a mode and piece: how many nodes it needs        */

static double rate(const struct ring_choosing *c)
{
    return c->scene->output.sample_rate;
}

/* Frames of force, and of sound. */
static double forced(const struct ring_choosing *c)
{
    return fmax(c->heard.force * rate(c), 1);
}

static double sounding(const struct ring_choosing *c)
{
    return fmax(c->heard.sound * rate(c), forced(c));
}

/* Modes as whole groups of lanes. */
static double lanes(const struct ring_choosing *c)
{
    return LANES * ceil((double)c->to->modes.n / LANES);
}

static double point_cost(const struct ring_choosing *c)
{
    return ring_survey_point(&c->survey) + HEARD * c->to->modes.n;
}

double ring_cost_search(const struct ring_choosing *c)
{
    return c->survey.looked ? *c->survey.looked / sounding(c) : 0;
}

double ring_cost_listening(const struct ring_choosing *c)
{
    return listener_cost(&c->scene->output, &c->to->modes, c->given->object.origin) / sounding(c);
}

double ring_cost_resonators(const struct ring_choosing *c)
{
    bool glides = ring_choice_glides(c->to);
    return 10 + lanes(c) * (glides ? GLIDING : RESONATOR * gammatone_cost(c->to->gamma)) + (c->to->moves ? (point_cost(c) + lanes(c) * RAMPED) / c->to->ramp : 0);
}

/* ------------------------------------------------------------------ nodes that ring */

/* Frames of a mode's response until it is forgotten. */
static double ringing(const struct ring_choosing *c, int i)
{
    return c->to->forgotten / 8.686 / fmax(c->to->modes.slowest[i], 1e-3) * rate(c);
}

static double shortest(const struct ring_choosing *c)
{
    double least = HUGE_VAL;
    for (int i = 0; i < c->to->modes.n; i++)
        least = fmin(least, c->to->hops[i]);
    return least;
}

/* Of what begins evenly over the force and then takes `life` frames: how many frames that are before the sound's end, on average. */
static double within(const struct ring_choosing *c, double life)
{
    double all = sounding(c), last = all - forced(c); /* what begins last has that much left */
    if (life <= last)
        return life;
    if (life >= all)
        return 0.5 * (all + last);
    return (0.5 * (life * life - last * last) + life * (all - life)) / (all - last);
}

/* Nodes under force, and until they are forgotten. */
double ring_cost_launch(const struct ring_choosing *c)
{
    double order = ring_means_knob(c, KNOB_overlap_order), nodes = 0, alive = 0;
    for (int i = 0; i < c->to->modes.n; i++) {
        double count = forced(c) / c->to->hops[i] + order, life = within(c, ringing(c, i));
        nodes += count;
        alive += c->to->modes.shared ? sounding(c) * CLUSTER : CLUSTER * fmin(life * count, sounding(c)) + LAUNCHED * life * count;
    }
    double points = (forced(c) / shortest(c) + order) * (point_cost(c));
    return (forced(c) * (20 + lanes(c) * (DRIVEN * order + 1)) + points + FREED * nodes + alive) / sounding(c);
}

/* A node's sum over the past, and the node under its window. */
double ring_cost_recall(const struct ring_choosing *c)
{
    double n = c->to->modes.n, order = ring_means_knob(c, KNOB_overlap_order), past = 0, all = sounding(c);
    for (int i = 0; i < c->to->modes.n; i++)
        past += fmin(ringing(c, i), 0.5 * all) * (all / c->to->hops[i] + order);
    double points = (all / shortest(c) + order) * (point_cost(c));
    return READING * n * order + (points + RECALLED * past) / all;
}

/* ------------------------------------------------------------------ responses that are computed */

static double responding(const struct ring_choosing *c)
{
    return c->to->seconds * rate(c);
}

/* Nodes of launch go as long as there is force; those of readout as long as there is sound. */
double ring_cost_overlap(const struct ring_choosing *c, double hop)
{
    double length = responding(c), order = ring_means_knob(c, KNOB_overlap_order), whole = length + hop * order;
    double count = (c->to->reading == MOVING_READOUT ? sounding(c) : forced(c)) / hop + order;
    return count * (TRANSFORM * whole + SAMPLED * c->to->modes.n * length + point_cost(c)) / sounding(c);
}

double ring_cost_recorded(double samples)
{
    return 70 + samples * PARTITION;
}

static double sampling(const struct ring_choosing *c)
{
    return responding(c) * (SAMPLED * c->to->modes.n + PARTITIONED) / sounding(c);
}

double ring_cost_still(const struct ring_choosing *c)
{
    return ring_cost_recorded(fmin(responding(c), sounding(c))) + sampling(c);
}

/* A response at each node, each convolved whole while the contact is in one of its pieces. */
double ring_cost_nodes(const struct ring_choosing *c)
{
    double n = c->to->nodes.n, pieces = c->to->nodes.pieces, at_work = (n - 1) / pieces + 1;
    double force = forced(c) * (100 + at_work * (PARTITIONED + responding(c) * PANNED));
    return PARTITIONED + force / sounding(c) + n * sampling(c) + NEEDED * pieces * c->to->modes.n / sounding(c);
}
