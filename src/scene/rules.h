/* Rules about a contact's values to each other that the reader tells with their place, and the stages keep to once
 * more. */
#ifndef SCENE_RULES_H
#define SCENE_RULES_H
#include <math.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "num/real.h"
#include "scene/ablation.h"
#include "scene/ball.h"
#include "scene/incline.h"
#include "scene/params.h"
#include "scene/scene.h"

#define RULES_PEAK (-3.0) /* dB re full scale: the level of a sound for which none is given */
#define RULES_SMOOTHING_WIDEST                                                                                         \
    0.1 /* s: a wider sigma leaves nothing to hear, and its kernels cost minutes per second of sound */

/* 1 - mu tan theta, the denominator of papers/000 equations 8 and 9. */
static inline double rules_slip(const struct grip *g) { return 1 - g->friction * real_tan(g->angle); }

/* The tool jams where mu tan theta reaches 1: refused from 0.999 on. (tan 45 degrees is 1 - 1e-16 in binary, and 0.999
   of it is to be refused.) */
static inline bool rules_jams(const struct grip *g) { return rules_slip(g) <= 1e-3 + 1e-12; }

/* Standard deviation in s of the Gaussian smoothing for an alpha in m; without a limiter as for 3 cm. */
static inline double rules_sigma(const struct contact_model *c, double alpha)
{
    return c->smoothing * (c->limiter.curve == LIMITER_TANH ? alpha : 0.03) / 0.03;
}

/* What touches the surface presses on it by its weight: m g cos(incline), N. */
static inline double rules_weight(const struct contact *c) { return c->scraper.mass * ball_gravity(c); }

/* The normal force in N where nothing makes it vary (load_varies): what load.constant says, else the weight; of a grip
   whose variation is left out what it has without acceleration (papers/000 equations 8 and 9 with omega = 0). */
static inline double rules_load(const struct contact *c)
{
    if (ablation_steady(c) && c->grip.given) return rules_weight(c) / rules_slip(&c->grip);
    return isnan(c->load.constant) ? rules_weight(c) : c->load.constant;
}

/* Is the path one straight line, on which the place is from + u e? (Of a contact that stays: at.) */
static inline bool rules_straight(const struct motion *m)
{
    return m->path == PATH_STILL || m->path == PATH_BACK_AND_FORTH || m->path == PATH_LINE ||
           m->path == PATH_FOUR_IN_LINE || m->path == PATH_INCLINE;
}

/* Is no place of the surface come back to? A round tip keeps the heights that it has read. */
static inline bool rules_once(const struct contact *c)
{
    return !isnan(c->scraper.radius) || (rules_straight(&c->motion) && c->motion.path != PATH_BACK_AND_FORTH);
}

static inline double rules_incline_speed(const struct motion *m)
{
    struct incline i = incline_make(m);
    double lasts = incline_lasts(&i, m), speed = incline_distance(&i, lasts) / lasts;
    return isfinite(speed) ? speed : 0.2;
}

/* m: from point to point. */
static inline double rules_chords(const struct motion *m)
{
    double length = 0;
    for (int i = 1; i < m->n_points; i++) {
        double x = m->points[2 * i] - m->points[2 * i - 2], y = m->points[2 * i + 1] - m->points[2 * i - 1];
        length += sqrt(x * x + y * y);
    }
    return length;
}

/* The mean speed in m/s as far as the scene alone tells it, for predictions of cost; 0.2 where only a file would. A
   scribble's sines (trajectory/path.c) make, in the mean over their draws, a velocity along each axis
   of 1.22 times rate and size, rms; the mean of its amount is some 0.8 to 0.89 of that. */
static inline double rules_speed(const struct motion *m)
{
    double dx = m->to[0] - m->from[0], dy = m->to[1] - m->from[1], length = sqrt(dx * dx + dy * dy);
    if (m->path == PATH_STILL) return 0;
    if (m->path == PATH_INCLINE) return rules_incline_speed(m);
    if (!isnan(m->speed)) return m->speed;
    if (m->path == PATH_BACK_AND_FORTH && !isnan(m->rate)) return 2 * m->rate * length;
    if (m->path == PATH_CIRCLE && !isnan(m->duration)) return 2 * REAL_PI * m->radius * fabs(m->turns) / m->duration;
    if (m->path == PATH_SCRIBBLE && !isnan(m->rate))
        return 1.05 * m->rate * sqrt(m->size[0] * m->size[0] + m->size[1] * m->size[1]);
    if (m->n_points > 1 && !isnan(m->duration)) return rules_chords(m) / m->duration;
    return rules_straight(m) && !isnan(m->duration) ? length / m->duration : 0.2;
}

/* Which coordinates the surface follows (enum along); ALONG_AUTO where only a height map's number of rows will tell. */
static inline int rules_along(const struct contact *c)
{
    const struct surface *s = &c->surface;
    int directed = params_directed(c);
    if (s->along != ALONG_AUTO || directed < 0) return s->along;
    return directed || !rules_straight(&c->motion) ? ALONG_PLANE : ALONG_PATH;
}

/* May the surface turn out to lie in the plane? */
static inline bool rules_plane(const struct contact *c)
{
    return rules_along(c) == ALONG_PLANE || rules_along(c) == ALONG_AUTO;
}

/* The speed law that applies: SPEED_AUTO resolved; it stays SPEED_AUTO for a scribble's or a recording's own, for what
   is still, and for what moves freely. */
static inline int rules_law(const struct motion *m)
{
    static const int own[] = {[PATH_BACK_AND_FORTH] = SPEED_HARMONIC,
                              [PATH_LINE] = SPEED_CONSTANT,
                              [PATH_FOUR_IN_LINE] = SPEED_HARMONIC,
                              [PATH_CIRCLE] = SPEED_CONSTANT,
                              [PATH_SCRIBBLE] = SPEED_AUTO,
                              [PATH_POLYLINE] = SPEED_MINIMUM_JERK,
                              [PATH_SPLINE] = SPEED_TWO_THIRDS,
                              [PATH_RECORDED] = SPEED_AUTO,
                              [PATH_STILL] = SPEED_AUTO,
                              [PATH_INCLINE] = SPEED_AUTO};
    return m->law == SPEED_AUTO ? own[m->path] : m->law;
}

/* May the path be gone along under the law (auto: always)? back_and_forth turns round at rest, and so does what has
   corners; a straight line has no curvature for two_thirds; what is still has no law, and what moves freely has
   gravity's. */
static inline bool rules_law_fits(const struct motion *m, int law)
{
    bool rests = m->path == PATH_POLYLINE && m->corner == 0 && m->n_points > 2;
    if (m->path == PATH_STILL || m->path == PATH_INCLINE) return law == SPEED_AUTO;
    if (law == SPEED_CONSTANT) return m->path != PATH_BACK_AND_FORTH && !rests;
    if (law == SPEED_TWO_THIRDS) return !rules_straight(m) && !rests;
    return law != SPEED_GIVEN || !rests;
}

static inline bool rules_ends_in(const char *file, const char *ending)
{
    size_t n = strlen(file), m = strlen(ending);
    return n > m && strcasecmp(file + n - m, ending) == 0;
}

/* Is a response given at all? */
static inline bool rules_responds(const struct response *r) { return r->file || r->object.given || r->space.given; }

/* Is it a mode table? */
static inline bool rules_is_table(const struct response *r)
{
    size_t n = r->file ? strlen(r->file) : 0;
    return n > 4 && strcmp(r->file + n - 4, ".csv") == 0;
}

/* Is it recorded: an impulse response, or a folder of them? It has no modes. */
static inline bool rules_is_recorded(const struct response *r) { return r->file && !rules_is_table(r); }

/* Is it a folder of recorded responses, as it is there now? */
static inline bool rules_is_folder(const struct response *r)
{
    struct stat status;
    return rules_is_recorded(r) && stat(r->file, &status) == 0 && S_ISDIR(status.st_mode);
}

/* Does a place in the space of materials change while the motion lasts? */
static inline bool rules_travels(const struct space *s)
{
    return s->given && (!isnan(s->to[0]) || !isnan(s->dimension_to));
}

/* The reading of a moving response (enum moving) that applies: MOVING_AUTO as far as the scene tells; it stays auto for
   a mode table, whose poles are known when it has been read. */
static inline int rules_moving(const struct response *r)
{
    if (r->moving != MOVING_AUTO || rules_is_table(r)) return r->moving;
    return r->file                    ? MOVING_LAUNCH
           : rules_travels(&r->space) ? MOVING_GLIDE
           : rules_responds(r)        ? MOVING_FIXED
                                      : MOVING_AUTO;
}

#define RULES_APPROACH 5e-3 /* s: contact is made and given up where the motion is at speed, unless the scene says */

static inline bool rules_incline_rests(const struct motion *m, bool at_end)
{
    struct incline i = incline_make(m);
    return at_end ? i.over == INCLINE_RESTS && !(incline_lasts(&i, m) < i.end) : m->start_speed == 0;
}

/* Is the motion surely at rest where it starts (or ends)? What a file gives may be, and counts as not. */
static inline bool rules_rests(const struct motion *m, bool at_end)
{
    int law = rules_law(m);
    double strokes = 2 * m->rate * m->duration;
    if (m->path == PATH_INCLINE) return rules_incline_rests(m, at_end);
    if (law != SPEED_HARMONIC && law != SPEED_MINIMUM_JERK) return m->path == PATH_STILL;
    return !at_end || m->path != PATH_BACK_AND_FORTH || fabs(strokes - rint(strokes)) < 1e-9;
}

/* Does it press on the surface with what it draws or reads, whether it moves or not: a series of impacts, heights that
 * are played? */
static inline bool rules_driven(const struct contact *c)
{
    return c->contact.model == CONTACT_IMPACTS || c->contact.model == CONTACT_PLAYBACK;
}

/* Seconds of approach (or release), as far as the scene alone shows them: at least what they will be. What strikes and
   what is given is neither lowered nor raised. A scraper at rest makes no force; all others press at rest too, but a
   ball that is dropped comes down by itself. */
static inline double rules_approach(const struct contact *c, bool release)
{
    double given = release ? c->load.release : c->load.approach;
    if (c->contact.model != CONTACT_SCRAPE && !ball_rolls(c) && !rules_driven(c)) return 0;
    if (!isnan(given)) return given;
    bool falls = c->contact.model == CONTACT_ROLL_COUPLED && c->contact.roll.drop > 0 && !release;
    return falls || (c->contact.model == CONTACT_SCRAPE && rules_rests(&c->motion, release)) ? 0 : RULES_APPROACH;
}

/* Is its series of impacts written? */
static inline bool rules_listed(const struct contact *c, const struct output *o)
{
    return o->impacts == LISTING_TABLE && c->contact.model == CONTACT_IMPACTS;
}

/* Is the surface heard? */
static inline bool rules_surface_rings(const struct contact *c)
{
    return rules_responds(&c->surface.response) && !ablation_mutes_surface(c);
}

/* ... the scraper, or ball? */
static inline bool rules_tool_rings(const struct contact *c)
{
    return rules_responds(&c->scraper.response) && c->scraper.weight != 0 && !ablation_mutes_tool(c);
}

/* Does it make a sound? Its gain may still be 0. */
static inline bool rules_rings(const struct contact *c) { return rules_surface_rings(c) || rules_tool_rings(c); }

/* Is it heard: does it ring, or is its force the sound? Its gain may still be 0. */
static inline bool rules_audible(const struct contact *c, const struct output *o)
{
    return rules_rings(c) || o->quantity == QUANTITY_FORCE;
}

/* The frame of the scene at which the contact begins: `start` to the nearest one, at a rate in Hz. */
static inline long rules_first_frame(const struct contact *c, double rate) { return (long)rint(c->start * rate); }

#endif
